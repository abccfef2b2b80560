//! The textures, a file each.

mod foliage;
mod map;
mod measures;
mod picture;
mod plan;
mod seal;

use super::TextureFile;

/// Every texture.
pub(crate) fn textures() -> Vec<TextureFile> {
    let file = |path, make| TextureFile { path, make };
    vec![
        file("assets/textures/grid.png", measures::grid),
        file("assets/textures/checker.png", measures::checker),
        file("assets/textures/lanes.png", measures::lanes),
        file("assets/textures/zone.png", measures::zone_plate),
        file("assets/textures/seal.png", seal::seal),
        file("assets/textures/picture.png", picture::picture),
        file("assets/textures/foliage.jpg", foliage::foliage),
        file("assets/textures/map.png", map::map),
        file("assets/textures/plan.png", plan::plan),
    ]
}
