//! Tiles of patterns: the textures that they share, and those that are too large together to be drawn as finely as they are
//! shown.

use std::collections::HashMap;
use std::sync::Arc;

use glam::DVec2;

use super::{Dialect, Pattern, Scene, ShapeId};
use crate::texture::{Texture, TileBudget};

/// Gives the textures of a scene to the tiles of its patterns too. They share one list, since a small document may have
/// thousands of textures and a hundred thousand tiles.
pub(super) fn hand_down(patterns: &mut [Pattern], textures: &Arc<[Arc<Texture>]>) {
    // A tile of several patterns is taken out once, so that it has one owner and need not be copied to be changed.
    let none = Arc::new(Scene::empty(DVec2::ONE, Dialect::Svg));
    let mut tiles: HashMap<*const Scene, Arc<Scene>> = HashMap::new();
    let mut take_out = |pattern: &mut Pattern| {
        let tile = std::mem::replace(&mut pattern.tile, Arc::clone(&none));
        let key = Arc::as_ptr(&tile);
        tiles.entry(key).or_insert(tile);
        key
    };
    let keys: Vec<_> = patterns.iter_mut().map(&mut take_out).collect();
    for tile in tiles.values_mut() {
        let tile = Arc::make_mut(tile);
        tile.textures = Arc::clone(textures);
        hand_down(&mut tile.patterns, textures);
    }
    for (pattern, key) in patterns.iter_mut().zip(keys) {
        pattern.tile = Arc::clone(&tiles[&key]);
    }
}

/// What is to be said of patterns whose tiles have no room together even where a unit is a pixel, and the shape of the first.
pub(super) fn too_large(patterns: &[Pattern]) -> Option<(ShapeId, String)> {
    let sides = |pattern: &Pattern| {
        let matrix = pattern.to_user.matrix2;
        pattern.tile.canvas * DVec2::new(matrix.x_axis.length(), matrix.y_axis.length())
    };
    let wanted = TileBudget::wanted(patterns.iter().map(sides));
    let part = TileBudget::part(wanted);
    let first = patterns.first().filter(|_| part < 1.0)?;
    let message = format!(
        "{} patterns have {:.0} million pixels together, more than {:.0}: they are drawn {:.1} times as coarsely; make their tiles smaller",
        patterns.len(),
        wanted / 1e6,
        TileBudget::TEXELS / 1e6,
        1.0 / part
    );
    Some((first.shape, message))
}
