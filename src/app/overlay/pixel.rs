//! Arithmetic on premultiplied pixels, two channels of a `u32` at a time.
//!
//! Everything here is branch-free on purpose: loops over rows of pixels then turn into vector code. Values are
//! sRGB-encoded and are mixed as they are, which is what egui expects of its renderers.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::{Simd, dispatch};

use crate::simd;

/// From this many pixels on a row is worth the choice of vector instructions: most rows of letters are shorter.
const LONG: usize = 32;
/// Pixels that are looked at together, whether anything is to be mixed.
const STRETCH: usize = 64;
/// Red and blue, or alpha and green shifted down: two channels with room for carries between them.
const LANES: u32 = 0x00ff_00ff;

/// A premultiplied pixel, `0xAARRGGBB`, from an egui colour.
pub(super) fn from_color(color: egui::Color32) -> u32 {
    let [r, g, b, a] = color.to_array();
    u32::from_be_bytes([a, r, g, b])
}

/// Both lanes times `factor / 255`, rounded to nearest.
///
/// `(t + 128 + ((t + 128) >> 8)) >> 8` is the exact rounding of `t / 255` for `t <= 255 * 255`
/// (Jim Blinn, "Three Wrongs Make a Right").
#[inline(always)]
fn scale_lanes(lanes: u32, factor: u32) -> u32 {
    let t = (lanes & LANES) * factor + 0x0080_0080;
    ((t + ((t >> 8) & LANES)) >> 8) & LANES
}

/// Lane-wise sum that stops at 255.
#[inline(always)]
fn add_lanes(a: u32, b: u32) -> u32 {
    let sum = a + b;
    let over = (sum >> 8) & 0x0001_0001;
    (sum | ((over << 8) - over)) & LANES
}

/// `source` over `below`. Channels above alpha (egui's additive colours) saturate.
#[inline(always)]
pub(super) fn over(source: u32, below: u32) -> u32 {
    let rest = 255 - (source >> 24);
    let rb = add_lanes(source & LANES, scale_lanes(below, rest));
    let ag = add_lanes((source >> 8) & LANES, scale_lanes(below >> 8, rest));
    rb | (ag << 8)
}

/// Channel by channel product of two pixels, `255` standing for one.
#[inline]
pub(super) fn modulate(a: u32, b: u32) -> u32 {
    let channel = |shift: u32| {
        let t = ((a >> shift) & 255) * ((b >> shift) & 255) + 128;
        ((t + (t >> 8)) >> 8) << shift
    };
    channel(0) | channel(8) | channel(16) | channel(24)
}

/// Mixes four pixels, rows from the top, by the fractions of a position between them in 1/65536.
pub(super) fn bilinear(rows: [[u32; 2]; 2], x: u32, y: u32) -> u32 {
    let channel = |shift: u32| {
        let [top, bottom] = rows.map(|[a, b]| {
            let [a, b] = [a, b].map(|pixel| u64::from((pixel >> shift) & 255));
            a * (65536 - u64::from(x)) + b * u64::from(x)
        });
        let sum = top * (65536 - u64::from(y)) + bottom * u64::from(y) + (1 << 31);
        u32::try_from(sum >> 32).unwrap_or(255) << shift
    };
    channel(0) | channel(8) | channel(16) | channel(24)
}

/// Paints `source` over every pixel of `row`.
pub(super) fn fill(row: &mut [u32], source: u32) {
    if source >> 24 == 255 {
        row.fill(source);
    } else if source != 0 && row.len() < LONG {
        for pixel in row {
            *pixel = over(source, *pixel);
        }
    } else if source != 0 {
        dispatch!(simd::level(), simd => fill_long(simd, row, source));
    }
}

/// Paints `sources` over `row`, pixel by pixel, up to the end of the shorter one.
pub(super) fn fill_from(row: &mut [u32], sources: &[u32]) {
    if row.len() < LONG {
        for (pixel, source) in row.iter_mut().zip(sources) {
            *pixel = over(*source, *pixel);
        }
    } else {
        dispatch!(simd::level(), simd => fill_long_from(simd, row, sources));
    }
}

/// As [`fill`], with the vector instructions of `simd`.
#[inline(always)]
fn fill_long<S: Simd>(simd: S, row: &mut [u32], source: u32) {
    simd.vectorize(
        #[inline(always)]
        || {
            for pixel in row {
                *pixel = over(source, *pixel);
            }
        },
    );
}

/// As [`fill_from`], with the vector instructions of `simd`. An interface is opaque or not there over long stretches,
/// where nothing is to be mixed.
#[inline(always)]
fn fill_long_from<S: Simd>(simd: S, row: &mut [u32], sources: &[u32]) {
    simd.vectorize(
        #[inline(always)]
        || {
            for (pixels, sources) in row.chunks_mut(STRETCH).zip(sources.chunks(STRETCH)) {
                let (all, any) = sources.iter().fold((u32::MAX, 0), |(all, any), s| (all & s, any | s));
                if all >> 24 == 255 && pixels.len() == sources.len() {
                    pixels.copy_from_slice(sources);
                } else if any != 0 {
                    for (pixel, source) in pixels.iter_mut().zip(sources) {
                        *pixel = over(*source, *pixel);
                    }
                }
            }
        },
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn channels(pixel: u32) -> [u32; 4] {
        pixel.to_be_bytes().map(u32::from)
    }

    #[test]
    fn over_rounds_to_nearest_for_every_pair() {
        for alpha in 0..=255_u32 {
            for below in 0..=255_u32 {
                let source = (alpha << 24) | (alpha << 16) | ((alpha / 2) << 8);
                let got = channels(over(source, 0xff00_0000 | (below << 16) | (below << 8) | below));
                let expect = |s: u32| s + (2 * below * (255 - alpha) + 255) / 510;
                assert_eq!(
                    got[1..],
                    [expect(alpha), expect(alpha / 2), expect(0)],
                    "alpha {alpha} over {below}"
                );
                assert_eq!(got[0], 255, "an opaque pixel stays opaque");
            }
        }
    }

    #[test]
    fn rows_are_what_their_pixels_are() {
        arbtest::arbtest(|u| {
            let length = u.int_in_range(0..=200)?;
            let mut below = vec![0_u32; length];
            let mut sources = vec![0_u32; u.int_in_range(0..=200)?];
            for pixel in &mut below {
                *pixel = u.arbitrary()?;
            }
            // Runs of what interfaces consist of, and anything between them.
            let mut rest = sources.as_mut_slice();
            while !rest.is_empty() {
                let (run, after) = rest.split_at_mut(u.int_in_range(1..=rest.len())?);
                let kind = u.int_in_range(0..=3)?;
                for pixel in run {
                    *pixel = match kind {
                        0 => 0,
                        1 => 0xff00_0000 | u.arbitrary::<u32>()?,
                        2 => 0x00ff_ffff & u.arbitrary::<u32>()?,
                        _ => u.arbitrary()?,
                    };
                }
                rest = after;
            }
            let mut expected = below.clone();
            for (pixel, source) in expected.iter_mut().zip(&sources) {
                *pixel = over(*source, *pixel);
            }
            let color = sources.first().copied().unwrap_or_default();
            let filled: Vec<u32> = below.iter().map(|pixel| over(color, *pixel)).collect();
            for (name, level) in simd::tested() {
                let mut row = below.clone();
                dispatch!(level, simd => fill_long_from(simd, &mut row, &sources));
                assert_eq!(row, expected, "{name}: {sources:08x?} over {below:08x?}");
                let mut row = below.clone();
                dispatch!(level, simd => fill_long(simd, &mut row, color));
                assert_eq!(row, filled, "{name}: {color:08x} over {below:08x?}");
            }
            let mut row = below.clone();
            fill_from(&mut row, &sources);
            assert_eq!(row, expected, "any length");
            let mut row = below;
            fill(&mut row, color);
            assert_eq!(row, filled, "any length");
            Ok(())
        })
        .budget_ms(500);
    }

    #[test]
    fn over_saturates_additive_colours() {
        assert_eq!(
            over(0x00ff_8001, 0xffff_c0fe),
            0xffff_ffff,
            "no carry into the next channel"
        );
    }

    #[test]
    fn modulate_by_white_is_identity() {
        for value in [0, 0x0102_0304, 0xfffe_fdfc, 0x8040_20ff] {
            assert_eq!(modulate(value, u32::MAX), value, "{value:08x}");
        }
    }

    #[test]
    fn bilinear_corners_and_middle() {
        let rows = [[0x1234_5678, 0xff00_ff00], [0x0102_0304, 0xffff_ffff]];
        assert_eq!(bilinear(rows, 0, 0), rows[0][0], "on the first texel");
        assert_eq!(
            bilinear([[0, 0xff00_0100], [0, 0xff00_0100]], 32768, 77),
            0x8000_0100,
            "half-way, rounded up"
        );
    }
}
