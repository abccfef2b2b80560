//! Where a resolve filter made colours that no pixel can show: below 0 or above 1.
//!
//! Weights below zero overshoot beside edges, and what is beyond black or white is clamped:
//!
//! ```text
//!                    ,-.  above 1, clamped
//!      white  ------'   `-----
//!                   |
//!      black  ----. |
//!                  `  below 0, clamped
//! ```

use crate::color::Rgba;
use crate::raster::{RasterSettings, Recolor};
use crate::render::visualisation::colors::{mix, pixel, rgba};
use crate::render::visualisation::show::{Show, Source, Target};
use crate::render::{Legend, LegendKey, add};
use crate::scene::Scene;

/// What is less beyond a pixel's range than rounding takes away was not clamped in effect, in levels.
const LEAST: f64 = 0.5;

/// So many levels beyond, and further, colours are as dark as they get.
const MOST: f64 = 32.0;

/// Below 0, above 1, both in different channels, each a little beyond and far; no channel of any is that of another. Colours of Okabe
/// and Ito and paler ones.
const BELOW: [u32; 2] = [0xFF9C_CBE8, 0xFF00_5A96];
const ABOVE: [u32; 2] = [0xFFF5_C38A, 0xFFC8_5000];
const BOTH: [u32; 2] = [0xFFE3_B4D8, 0xFF8E_2C78];

pub(super) struct Clamped;

impl Show for Clamped {
    fn meaning(&self) -> &'static str {
        "what the resolve filter made that no pixel can show, over the paled picture: below 0 in some channel, above 1, or both; the darker the further, up to 32 levels; with counts in the legend"
    }

    fn legend(&self, _: &Scene) -> Option<Legend> {
        Some(legend(None))
    }

    fn change(&self, settings: &mut RasterSettings) {
        settings.recolor = Some(Recolor::Clamped(color));
    }

    fn keeps_layers(&self) -> bool {
        true
    }

    fn add(&self, source: &Source<'_>, (builder, screen): Target<'_, '_>, index: usize) {
        add(builder, screen, source.kind(index));
    }
}

/// How many pixels of a picture were clamped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ClampedPixels {
    /// That had a channel below 0, and none above 1.
    pub below: u64,
    /// That had a channel above 1, and none below 0.
    pub above: u64,
    /// That had one of either.
    pub both: u64,
    /// Of the picture.
    pub all: u64,
}

impl ClampedPixels {
    /// Of the pixels of a picture that shows them ([`Visualisation::Clamped`](super::Visualisation::Clamped)).
    pub fn of(pixels: &[u32]) -> Self {
        let mut counts = Self::default();
        for pixel in pixels {
            let [_, r, g, b] = pixel.to_be_bytes();
            counts.all += 1;
            // The order of channels is that of their ends. What was not clamped is grey.
            if r < g && g < b {
                counts.below += 1;
            } else if b < g && g < r {
                counts.above += 1;
            } else if g < r && g < b {
                counts.both += 1;
            }
        }
        counts
    }
}

/// Its legend, with counts where there are any.
pub(super) fn legend(counts: Option<ClampedPixels>) -> Legend {
    let words = |what: &str, count: fn(ClampedPixels) -> u64| {
        counts.map_or_else(|| what.to_owned(), |counts| format!("{what}: {}", count(counts)))
    };
    Legend {
        title: "clamped pixels, the darker the further",
        key: LegendKey::Swatches(vec![
            (BELOW[1], words("below 0", |counts| counts.below)),
            (ABOVE[1], words("above 1", |counts| counts.above)),
            (BOTH[1], words("both", |counts| counts.both)),
        ]),
        others: Vec::new(),
    }
}

/// The colour of a pixel that was clamped by so many levels, below 0 and above 1: grey where it was not.
fn color([below, above]: [f64; 2], own: u32) -> u32 {
    let ends = match [below >= LEAST, above >= LEAST] {
        [false, false] => return paled(own),
        [true, false] => BELOW,
        [false, true] => ABOVE,
        [true, true] => BOTH,
    };
    #[expect(clippy::cast_possible_truncation, reason = "a part of a colour")]
    let part = (below.max(above) / MOST).min(1.0) as f32;
    pixel(mix(rgba(ends[0]), rgba(ends[1]), part))
}

/// A light grey, the darker the darker a pixel is.
fn paled(own: u32) -> u32 {
    let Rgba { r, g, b, a } = rgba(own);
    let luma = a * (0.299 * r + 0.587 * g + 0.114 * b) + (1.0 - a);
    let grey = 0.7 + 0.3 * luma;
    pixel(Rgba {
        r: grey,
        g: grey,
        b: grey,
        a: 1.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_counted_by_the_colours_that_they_have() {
        let mut pixels = Vec::new();
        let levels = [0.0, 0.4, 0.5, 1.0, 17.3, 32.0, 400.0];
        for below in levels {
            for above in levels {
                pixels.push(color([below, above], 0xFF12_34F6));
            }
        }
        // Two of seven were not clamped in effect.
        let expected = ClampedPixels {
            below: 10,
            above: 10,
            both: 25,
            all: 49,
        };
        assert_eq!(ClampedPixels::of(&pixels), expected);
        let grey = (0..=255).flat_map(|byte| [byte << 16, byte << 8, byte, 0x00FF_FFFF]);
        let grey: Vec<u32> = grey.map(|own| color([0.0; 2], 0xFF00_0000 | own)).collect();
        assert_eq!(
            ClampedPixels::of(&grey),
            ClampedPixels {
                all: 1024,
                ..ClampedPixels::default()
            }
        );
    }
}
