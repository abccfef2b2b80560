//! Tiles of patterns, drawn for the view that shows them: a texel for each sample, so that edges in a tile lie where they
//! would without it, however the tile is turned.

use std::sync::Arc;

use glam::{DAffine2, DVec2};

use super::{RenderSettings, Visualisation, draw};
use crate::color::Rgba;
use crate::geometry::ViewTransform;
use crate::raster::{Framebuffer, PixelCoverage, PlacedPattern, ResolveFilter, SampleRate};
use crate::scene::Pattern;
use crate::texture::{Tile, TileBudget};

/// Texels of a tile that has one for each sample, at most: 32 MB. Larger ones have one for each pixel.
const MOST_TEXELS: f64 = 4_194_304.0;
/// Least side of a tile whose texels show one sample each: of fewer the colour of the whole would depend on where they lie.
const LEAST_SIDE: f64 = 8.0;

/// Patterns as they lie in a view.
pub(super) fn placed(patterns: &[Pattern], view: &ViewTransform, settings: &RenderSettings) -> Vec<PlacedPattern> {
    // Areas are those of what a tile fills; the tile itself is read in the middle of a pixel.
    let settings = &RenderSettings {
        coverage: PixelCoverage::Sampled,
        ..settings.in_effect()
    };
    let to_pixels =
        |pattern: &Pattern| view.scene_to_pixels * pattern.to_user * DAffine2::from_scale(pattern.tile.canvas);
    let sides = patterns.iter().map(|pattern| {
        let matrix = to_pixels(pattern).matrix2;
        DVec2::new(matrix.x_axis.length(), matrix.y_axis.length())
    });
    let sizes = sizes(&sides.collect::<Vec<_>>(), settings.sample_rate);
    let place = |(pattern, size): (&Pattern, Size)| {
        let from_pixels = to_pixels(pattern).inverse();
        let is_flat = !from_pixels.is_finite() || !size.texels.is_finite();
        PlacedPattern {
            tile: if is_flat { None } else { tile(pattern, size, settings) },
            from_pixels,
            opacity: pattern.opacity,
        }
    };
    patterns.iter().zip(sizes).map(place).collect()
}

/// How large a tile is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Size {
    /// Width and height.
    texels: DVec2,
    /// Whether a texel shows one sample: there is one for each, and more than a few along both sides.
    is_sampled: bool,
}

/// How large tiles are drawn whose sides have these lengths in pixels: where their samples together have no room, by their
/// pixels, and where those have none, by a part of them.
fn sizes(sides: &[DVec2], sample_rate: SampleRate) -> Vec<Size> {
    let of_samples = |sides: &DVec2| {
        let samples = *sides * f64::from(sample_rate.side());
        let is_small = samples.max_element() <= TileBudget::MAX_SIDE && samples.element_product() <= MOST_TEXELS;
        Size {
            texels: if is_small { samples } else { *sides },
            is_sampled: is_small && samples.min_element() >= LEAST_SIDE,
        }
    };
    let fine: Vec<Size> = sides.iter().map(of_samples).collect();
    let have_room = TileBudget::wanted(fine.iter().map(|size| size.texels)) <= TileBudget::TEXELS;
    let part = TileBudget::part(TileBudget::wanted(sides.iter().copied()));
    let coarse = sides.iter().map(|sides| Size {
        texels: sides.min(DVec2::splat(TileBudget::MAX_SIDE)) * part,
        is_sampled: false,
    });
    let sizes = if have_room { fine } else { coarse.collect() };
    let whole = |Size { texels, is_sampled }: Size| Size {
        texels: if texels.is_finite() {
            texels.ceil().clamp(DVec2::ONE, DVec2::splat(TileBudget::MAX_SIDE))
        } else {
            texels
        },
        is_sampled,
    };
    sizes.into_iter().map(whole).collect()
}

/// The tile in this size; `None` where nothing is drawn.
fn tile(
    pattern: &Pattern,
    Size {
        texels: size,
        is_sampled,
    }: Size,
    settings: &RenderSettings,
) -> Option<Arc<Tile>> {
    // One sample is enough for a texel that is one; not where the tile has hardly any, and not for one that is a pixel.
    let sample_rate = if is_sampled {
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
        // What lies in a tile is not asked for again, but for another size of it.
        pattern.tile.patterns.iter().for_each(|inside| inside.drawn.clear());
        Tile::new([width, height], frame.pixels())
    })
}

/// A side in texels, at most [`TileBudget::MAX_SIDE`].
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped by the caller"
)]
fn whole(side: f64) -> u32 {
    side as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_have_their_samples_their_pixels_or_what_room_there_is() {
        let sizes = |count: usize, side: f64, rate| sizes(&vec![DVec2::splat(side); count], rate);
        let rate = SampleRate::new(16).expect("a rate");
        for (count, side, expected, is_sampled) in [
            (1, 99.5, 398.0, true),
            (1, 2000.5, 2001.0, false),
            (4, 9000.0, 4096.0, false),
            (1, 0.1, 1.0, false),
            // Hardly any samples, though as many whole texels.
            (1, 1.9, 8.0, false),
            (1, 2.0, 8.0, true),
            // One for each sample would be 77 million.
            (30, 400.0, 400.0, false),
        ] {
            let expected = Size {
                texels: DVec2::splat(expected),
                is_sampled,
            };
            let found = sizes(count, side, rate);
            assert!(
                found.iter().all(|size| *size == expected),
                "{count} of {side}: {found:?}"
            );
        }
        let many = sizes(300, 1000.0, SampleRate::ONE);
        let together: f64 = many.iter().map(|size| size.texels.element_product()).sum();
        assert!(together < TileBudget::TEXELS * 1.01, "{together}");
        assert!(!sizes(1, f64::INFINITY, rate)[0].texels.is_finite(), "it is not drawn");
    }
}
