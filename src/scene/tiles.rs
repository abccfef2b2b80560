//! Tiles of patterns that are too large together to be drawn as finely as they are shown.

use glam::DVec2;

use super::{Pattern, ShapeId};
use crate::texture::TileBudget;

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
