//! Tiles of patterns, drawn for the view that shows them: a texel for each pixel.

use std::sync::Arc;

use glam::{DAffine2, DVec2};

use super::{RenderSettings, Visualisation, draw};
use crate::color::Rgba;
use crate::geometry::ViewTransform;
use crate::raster::{Framebuffer, PlacedPattern};
use crate::scene::Pattern;
use crate::texture::Tile;

/// Largest side of a tile in texels; one that is shown larger is stretched.
const MAX_SIDE: f64 = 4096.0;

/// A pattern as it lies in a view.
pub(super) fn placed(pattern: &Pattern, view: &ViewTransform, settings: &RenderSettings) -> PlacedPattern {
    let to_pixels = view.scene_to_pixels * pattern.to_user * DAffine2::from_scale(pattern.tile.canvas);
    PlacedPattern {
        tile: pattern_tile(pattern, to_pixels, settings),
        from_pixels: to_pixels.inverse(),
        opacity: pattern.opacity,
    }
}

/// The tile, whose sides go to `to_pixels`; `None` where it is flat or lies beyond all numbers.
fn pattern_tile(pattern: &Pattern, to_pixels: DAffine2, settings: &RenderSettings) -> Option<Arc<Tile>> {
    let matrix = to_pixels.matrix2;
    let sides = DVec2::new(matrix.x_axis.length(), matrix.y_axis.length());
    if !to_pixels.inverse().is_finite() || !sides.is_finite() {
        return None;
    }
    let size = sides.ceil().clamp(DVec2::ONE, DVec2::splat(MAX_SIDE));
    let settings = RenderSettings {
        visualisation: Visualisation::Color,
        background: Rgba::TRANSPARENT,
        outline: false,
        ..*settings
    };
    pattern.drawn.get(&format!("{size} {settings:?}"), || {
        let [width, height] = size.to_array().map(whole);
        let view = ViewTransform {
            scene_to_pixels: DAffine2::from_scale(size / pattern.tile.canvas),
        };
        let mut frame = Framebuffer::new(width, height);
        draw(&pattern.tile, &view, &settings, &mut frame);
        Tile::new([width, height], frame.pixels())
    })
}

/// A side in texels, at most [`MAX_SIDE`].
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped by the caller"
)]
fn whole(side: f64) -> u32 {
    side as u32
}
