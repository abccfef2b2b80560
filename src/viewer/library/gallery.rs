//! The scenes and textures that are built into the program.
//!
//! They are the files of `svg` and `assets/textures`; the suite holds this table against the folders.

use crate::scene::{ResourceError, Resources, spelling};

/// A scene of the built-in gallery.
#[derive(Clone, Copy, Debug)]
pub struct GalleryScene {
    /// Its name, such as `basic/test4.svg`.
    pub name: &'static str,
    /// The document.
    pub document: &'static str,
}

/// A texture of the built-in gallery.
#[derive(Clone, Copy, Debug)]
pub struct GalleryTexture {
    /// Its file name, such as `map.png`.
    pub name: &'static str,
    /// The file, PNG or JPEG.
    pub bytes: &'static [u8],
}

/// Where the gallery's scenes look for their textures.
const TEXTURE_FOLDER: &str = "../../assets/textures/";

macro_rules! scenes {
    ($($name:literal),* $(,)?) => {
        &[$(GalleryScene { name: $name, document: include_str!(concat!("../../../svg/", $name)) }),*]
    };
}

macro_rules! textures {
    ($($name:literal),* $(,)?) => {
        &[$(GalleryTexture { name: $name, bytes: include_bytes!(concat!("../../../assets/textures/", $name)) }),*]
    };
}

/// Every scene of the gallery, in the order of the list: the handsome ones first, the cruel ones last.
pub static SCENES: &[GalleryScene] = scenes![
    "illustration/01_lighthouse.svg",
    "illustration/02_fox.svg",
    "illustration/03_night_city.svg",
    "illustration/04_balloons.svg",
    "illustration/05_swell.svg",
    "illustration/06_rosette.svg",
    "illustration/07_guilloche.svg",
    "illustration/08_veils.svg",
    "illustration/09_poster.svg",
    "vector/01_icon_sheet.svg",
    "vector/02_city_map.svg",
    "vector/03_plot.svg",
    "vector/04_poster.svg",
    "vector/05_small_print.svg",
    "vector/06_clips_and_masks.svg",
    "basic/test1.svg",
    "basic/test2.svg",
    "basic/test3.svg",
    "basic/test4.svg",
    "basic/test5.svg",
    "basic/test6.svg",
    "basic/test7.svg",
    "basic/test8.svg",
    "texmap/test1.svg",
    "texmap/test2.svg",
    "texmap/test3.svg",
    "texmap/test4.svg",
    "texmap/test5.svg",
    "texmap/test6.svg",
    "transforms/robot.svg",
    "transforms/runner.svg",
    "study/01_zone_plate.svg",
    "study/02_siemens_star.svg",
    "study/03_edge_fan.svg",
    "study/04_picket_fence.svg",
    "study/05_seams.svg",
    "study/06_zone_texture.svg",
    "study/07_checker_floor.svg",
    "study/08_checker_fan.svg",
    "study/09_mip_lanes.svg",
    "study/10_pixel_centres.svg",
    "study/11_city_floor.svg",
    "study/12_sharp_or_still.svg",
    "study/13_thin_rays.svg",
    "study/14_one_edge.svg",
    "study/15_upright_bars.svg",
    "study/16_what_is_painted.svg",
    "study/17_half_the_light.svg",
    "study/18_text_at_8_px.svg",
    "study/19_banding.svg",
    "study/20_conflation.svg",
    "study/21_fine_spokes.svg",
    "study/22_what_filters_cost.svg",
    "study/23_one_colour_a_pixel.svg",
    "study/24_what_one_colour_misses.svg",
    "study/25_few_texels.svg",
    "study/26_hard_texels.svg",
    "study/27_beyond_the_border.svg",
    "study/28_guessed_edges.svg",
    "study/29_what_guesses_miss.svg",
    "study/30_exact_greys.svg",
    "study/31_seams_of_a_mesh.svg",
    "study/32_checker_fan_turned.svg",
    "study/33_nearly_level_edges.svg",
    "study/34_leaning_edges.svg",
    "subdiv/triangle0.svg",
    "subdiv/triangle1.svg",
    "subdiv/triangle2.svg",
    "subdiv/triangle3.svg",
    "subdiv/triangle4.svg",
    "subdiv/triangle5.svg",
    "subdiv/triangle6.svg",
    "hardcore/01_degenerate_square1.svg",
    "hardcore/02_degenerate_square2.svg",
    "hardcore/03_concave.svg",
    "hardcore/04_repeated_points.svg",
    "hardcore/05_far_away.svg",
    "hardcore/06_t_junctions.svg",
    "hardcore/07_needles.svg",
];

/// Every texture of the gallery.
pub static TEXTURES: &[GalleryTexture] = textures![
    "checker.png",
    "foliage.jpg",
    "grid.png",
    "lanes.png",
    "map.png",
    "picture.png",
    "plan.png",
    "seal.png",
    "zone.png",
];

/// The gallery's textures, by the addresses that its scenes use.
#[derive(Clone, Copy, Debug)]
pub struct Textures;

impl Resources for Textures {
    fn read(&self, address: &str) -> Result<Vec<u8>, ResourceError> {
        let name = address.strip_prefix(TEXTURE_FOLDER).ok_or(ResourceError::NotFound)?;
        let texture = TEXTURES.iter().find(|texture| texture.name == name);
        texture
            .map(|texture| texture.bytes.to_vec())
            .ok_or(ResourceError::NotFound)
    }
}

/// What to give instead of a name that no scene has: those that hold it in theirs are meant, if there are any.
pub(in crate::viewer) fn cure(name: &str) -> String {
    let name = name.to_lowercase();
    let mut meant = SCENES
        .iter()
        .filter(|scene| scene.name.contains(name.trim_end_matches('/')));
    match (meant.next(), meant.count()) {
        (Some(scene), 0) => format!("is gallery:{} meant?", scene.name),
        (Some(scene), others) => format!("give one of {} in full, such as gallery:{}", others + 1, scene.name),
        (None, _) => {
            if let Some(scene) = nearest(&name) {
                return format!("is gallery:{scene} meant?");
            }
            let some = SCENES.first().map_or("", |scene| scene.name);
            format!("give one that is there, such as gallery:{some}")
        }
    }
}

/// The scene whose name is the same but for a slip or two: one without its folder, too.
fn nearest(name: &str) -> Option<&'static str> {
    let last = |name: &'static str| name.rsplit('/').next().unwrap_or(name).trim_end_matches(".svg");
    let asked = name.rsplit('/').next().unwrap_or(name).trim_end_matches(".svg");
    let found = spelling::nearest(asked, SCENES.iter().map(|scene| last(scene.name)))?;
    SCENES.iter().map(|scene| scene.name).find(|name| last(name) == found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cures_name_scenes_that_are_meant() {
        let first = SCENES[0].name;
        let study = SCENES.iter().filter(|scene| scene.name.starts_with("study/")).count();
        for (name, expected) in [
            ("02_FOX", "is gallery:illustration/02_fox.svg meant?".to_owned()),
            (
                "study/01_zone_plaet",
                "is gallery:study/01_zone_plate.svg meant?".to_owned(),
            ),
            (
                "1_zone_plate.svg",
                "is gallery:study/01_zone_plate.svg meant?".to_owned(),
            ),
            (
                "nothing like it",
                format!("give one that is there, such as gallery:{first}"),
            ),
        ] {
            assert_eq!(cure(name), expected, "{name}");
        }
        let folder = cure("study/");
        assert!(folder.starts_with(&format!("give one of {study} in full")), "{folder}");
        assert!(folder.contains("such as gallery:study/"), "{folder}");
    }
}
