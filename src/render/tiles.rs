//! Tiles of patterns, drawn for the view that shows them: a texel for each sample, so that edges in a tile lie where they
//! would without it, however the tile is turned.

use std::sync::Arc;

use glam::{DAffine2, DVec2};

use super::{RenderSettings, Visualisation, draw};
use crate::color::Rgba;
use crate::geometry::ViewTransform;
use crate::raster::{Framebuffer, PixelCoverage, PlacedPattern, ResolveFilter, SampleRate};
use crate::scene::Pattern;
use crate::texture::Tile;

/// Largest side of a tile in texels; one that is shown larger is stretched.
const MAX_SIDE: f64 = 4096.0;
/// Texels of a tile that has one for each sample, at most: 32 MB. Larger ones have one for each pixel.
const MOST_TEXELS: f64 = 4_194_304.0;
/// Least side of a tile whose texels show one sample each: of fewer the colour of the whole would depend on where they lie.
const LEAST_SIDE: f64 = 8.0;

/// A pattern as it lies in a view.
pub(super) fn placed(pattern: &Pattern, view: &ViewTransform, settings: &RenderSettings) -> PlacedPattern {
    // Areas are those of what a tile fills; the tile itself is read in the middle of a pixel.
    let settings = &RenderSettings {
        coverage: PixelCoverage::Sampled,
        ..settings.in_effect()
    };
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
    let samples = sides * f64::from(settings.sample_rate.side());
    let is_small = samples.max_element() <= MAX_SIDE && samples.element_product() <= MOST_TEXELS;
    let size = if is_small { samples } else { sides };
    let size = size.ceil().clamp(DVec2::ONE, DVec2::splat(MAX_SIDE));
    // One sample is enough for a texel that is one; not where the tile has hardly any, and not for one that is a pixel.
    let sample_rate = if is_small && samples.min_element() >= LEAST_SIDE {
        SampleRate::ONE
    } else {
        settings.sample_rate
    };
    let settings = RenderSettings {
        sample_rate,
        visualisation: Visualisation::Color,
        background: Rgba::TRANSPARENT,
        outline: false,
        // Its texels become samples, which are weighted then.
        resolve_filter: ResolveFilter::default(),
        filter_radius: None,
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
