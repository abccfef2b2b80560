//! Differences as a picture.

use rayon::prelude::*;

use super::Pair;
use super::levels::compared;
use crate::color::Colormap;
use crate::raster::Framebuffer;
use crate::render::{Legend, LegendKey};

/// How the difference of a pixel is measured. A is the reference; channels run from 0 to 1. The pixel's number is that
/// of the channel, red, green, blue or alpha, for which it is largest, so that no difference cancels another or hides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Measure {
    /// `b - a`: blue where B is darker, orange where it is lighter.
    Signed,
    /// `|b - a|`.
    #[default]
    Absolute,
    /// `|b - a| / (a + 0.01)`: the same step counts more in the dark; the hundredth keeps black finite.
    Relative,
    /// `(b - a)^2`: what RMSE and PSNR add up.
    Squared,
}

/// How differences become colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gain {
    /// Differences times this number, which is finite and above zero; 1 and more take the colour map's last colour.
    Factor(f32),
    /// The largest difference takes the colour map's last colour.
    Normalize,
}

/// How a difference picture looks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DifferenceStyle {
    /// What is shown.
    pub measure: Measure,
    /// How bright.
    pub gain: Gain,
}

impl Default for Gain {
    fn default() -> Self {
        Self::Factor(1.0)
    }
}

impl Measure {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 4] = [Self::Signed, Self::Absolute, Self::Relative, Self::Squared];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Signed => "signed",
            Self::Absolute => "absolute",
            Self::Relative => "relative",
            Self::Squared => "squared",
        }
    }

    /// The colour map it is shown in; for legends.
    pub const fn colormap(self) -> Colormap {
        match self {
            Self::Signed => Colormap::Diverging,
            Self::Absolute | Self::Relative | Self::Squared => Colormap::Sequential,
        }
    }

    /// What the ends of its colours stand for where differences are multiplied with `gain`; of signed ones the middle, too.
    /// Where that is so that the largest difference is at the end (`is_normalized`), there is no more than that.
    pub fn marks(self, gain: f32, is_normalized: bool) -> Vec<String> {
        let end = 1.0 / f64::from(gain);
        // No difference of levels is larger than all of the scale.
        let clips = !is_normalized && (self == Self::Relative || end < 1.0);
        let more = if clips { " and more" } else { "" };
        let zero = "0".to_owned();
        let levels = short(end * 255.0);
        match self {
            Self::Signed => {
                let least = if clips { more } else { " levels" };
                vec![format!("−{levels}{least}"), zero, format!("+{levels} levels{more}")]
            }
            Self::Absolute => vec![zero, format!("{levels} levels{more}")],
            Self::Relative => vec![zero, format!("{} % of A{more}", short(end * 100.0))],
            Self::Squared => vec![zero, format!("{} levels²{more}", short(end * 255.0 * 255.0))],
        }
    }
}

/// A number with about three digits and no zeros behind the point.
fn short(value: f64) -> String {
    let decimals = match value {
        v if v >= 100.0 => 0,
        v if v >= 10.0 => 1,
        v if v >= 1.0 => 2,
        _ => 4,
    };
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Pixels that one thread colours at a time.
const CHUNK: usize = 16_384;
/// Pixels that are compared at once before any of them is coloured.
const BLOCK: usize = 64;
/// Colours of a legend's scale.
const LEGEND_COLORS: u16 = 256;
/// Colours that relative differences are rounded to.
const STEPS: u16 = 1023;

/// The colours of differences in one style: what a picture that is put together row by row needs.
#[derive(Clone, Debug)]
pub struct DifferencePaint {
    measure: Measure,
    gain: f32,
    /// Of the differences from -255 to 255 levels; for relative ones, of `STEPS + 1` steps from 0 to 1.
    colors: Vec<u32>,
    relative: RelativeTable,
}

impl DifferencePaint {
    /// Differences times `gain`, which is finite and above zero.
    pub fn new(measure: Measure, gain: f32) -> Self {
        let colors = if measure == Measure::Relative {
            let last = f32::from(STEPS);
            (0..=STEPS)
                .map(|step| Colormap::Sequential.color(f32::from(step) / last))
                .collect()
        } else {
            level_colors(measure, gain)
        };
        Self {
            measure,
            gain,
            colors,
            relative: RelativeTable::new(gain * f32::from(STEPS)),
        }
    }

    /// What differences are multiplied with.
    pub fn gain(&self) -> f32 {
        self.gain
    }

    /// What is shown.
    pub fn measure(&self) -> Measure {
        self.measure
    }

    /// What its colours mean; see [`Measure::marks`].
    pub fn legend(&self, is_normalized: bool) -> Legend {
        let map = self.measure.colormap();
        let last = f32::from(LEGEND_COLORS - 1);
        let colors = (0..LEGEND_COLORS).map(|step| match (map, f32::from(step) / last) {
            (Colormap::Diverging, part) => map.color(2.0 * part - 1.0),
            (Colormap::Sequential, part) => map.color(part),
        });
        let marks = self.measure.marks(self.gain, is_normalized);
        let last = marks.len().saturating_sub(1).max(1) as f32;
        let ticks = (0_u16..).zip(marks).map(|(i, mark)| (f32::from(i) / last, mark));
        Legend {
            title: "difference of the channel where it is largest",
            key: LegendKey::Scale(colors.collect(), ticks.collect()),
            others: Vec::new(),
        }
    }

    /// The colour of a pixel, `0xAARRGGBB` all three.
    #[inline]
    pub fn pixel(&self, a: u32, b: u32) -> u32 {
        let index = if self.measure == Measure::Relative {
            step(self.relative.difference(a, b).min(f32::from(STEPS)))
        } else {
            level_index(signed_level(a, b))
        };
        self.colors.get(index).copied().unwrap_or_default()
    }

    /// The colours of pixels of A and B, as many as all three have.
    pub fn row(&self, a: &[u32], b: &[u32], out: &mut [u32]) {
        let equal = self.pixel(0, 0);
        let blocks = a.chunks(BLOCK).zip(b.chunks(BLOCK)).zip(out.chunks_mut(BLOCK));
        for ((a, b), out) in blocks {
            if a == b {
                out.fill(equal);
            } else if self.measure == Measure::Relative {
                for (out, (a, b)) in out.iter_mut().zip(a.iter().zip(b)) {
                    *out = if a == b { equal } else { self.pixel(*a, *b) };
                }
            } else {
                let mut levels = [0; BLOCK];
                signed_levels(a, b, &mut levels);
                for (out, level) in out.iter_mut().zip(levels) {
                    *out = self.colors[level_index(level)];
                }
            }
        }
    }
}

impl Pair<'_> {
    /// Draws the difference into `out`, which takes the pair's size; no memory is taken where it has it already. Gives
    /// the gain that the picture has: what it was asked for, or what makes the largest difference 1, and 1 for equal
    /// pictures.
    pub fn show(self, style: DifferenceStyle, out: &mut Framebuffer) -> f32 {
        let [width, height] = self.size();
        if [out.width(), out.height()] != [width, height] {
            *out = Framebuffer::new(width, height);
        }
        let paint = self.paint(style);
        let pixels = self.a.pixels().par_chunks(CHUNK).zip(self.b.pixels().par_chunks(CHUNK));
        let outs = out.pixels_mut().par_chunks_mut(CHUNK);
        outs.zip(pixels).for_each(|(out, (a, b))| paint.row(a, b, out));
        paint.gain()
    }

    /// The colours of this pair's differences, which normalised ones depend on.
    pub fn paint(self, style: DifferenceStyle) -> DifferencePaint {
        let gain = match style.gain {
            Gain::Factor(factor) => factor,
            Gain::Normalize => match self.largest(style.measure) {
                largest if largest > 0.0 => largest.recip(),
                _ => 1.0,
            },
        };
        DifferencePaint::new(style.measure, gain)
    }

    /// The largest difference of any pixel.
    pub fn largest(self, measure: Measure) -> f32 {
        let pixels = self.a.pixels().par_chunks(CHUNK).zip(self.b.pixels().par_chunks(CHUNK));
        if measure == Measure::Relative {
            let table = RelativeTable::new(1.0);
            return pixels
                .map(|(a, b)| {
                    let unequal = a.iter().zip(b).filter(|(a, b)| a != b);
                    unequal.fold(0.0, |most, (a, b)| table.difference(*a, *b).max(most))
                })
                .reduce(|| 0.0, f32::max);
        }
        let level = pixels
            .map(|(a, b)| {
                let blocks = a.chunks(BLOCK).zip(b.chunks(BLOCK)).filter(|(a, b)| a != b);
                blocks.fold(0, |most, (a, b)| {
                    let mut levels = [0; BLOCK];
                    signed_levels(a, b, &mut levels);
                    levels.iter().fold(most, |most: i32, level| most.max(level.abs()))
                })
            })
            .reduce(|| 0, i32::max);
        measured_level(measure, level).abs()
    }
}

/// [`signed_level`] of up to [`BLOCK`] pixels, in loops that compilers turn into vector code.
#[inline]
fn signed_levels(a: &[u32], b: &[u32], levels: &mut [i32; BLOCK]) {
    let mut ties = false;
    for (level, (a, b)) in levels.iter_mut().zip(a.iter().zip(b)) {
        let [a, b] = compared(*a, *b);
        let channel = |shift: u32| (b >> shift & 0xff).cast_signed() - (a >> shift & 0xff).cast_signed();
        let [one, two, three, four] = [16, 8, 0, 24].map(channel);
        let most = one.max(two).max(three.max(four));
        let least = one.min(two).min(three.min(four));
        *level = if most >= -least { most } else { least };
        ties |= most == -least && most != 0;
    }
    if ties {
        // Which of two channels comes first decides the sign.
        for (level, (a, b)) in levels.iter_mut().zip(a.iter().zip(b)) {
            *level = signed_level(*a, *b);
        }
    }
}

/// The index of a difference of levels among the colours of all.
#[inline]
fn level_index(level: i32) -> usize {
    (255 + level).unsigned_abs() as usize
}

/// The difference `b - a` in levels of the channel that differs most; of equal ones red comes before green, blue, alpha.
#[inline]
fn signed_level(a: u32, b: u32) -> i32 {
    let [a, b] = compared(a, b);
    let ([aa, ar, ag, ab], [ba, br, bg, bb]) = (a.to_be_bytes(), b.to_be_bytes());
    let pairs = [(ar, br), (ag, bg), (ab, bb), (aa, ba)];
    pairs.into_iter().fold(0, |most: i32, (a, b)| {
        let level = i32::from(b) - i32::from(a);
        if level.abs() > most.abs() { level } else { most }
    })
}

/// What a difference of levels is worth; not for relative ones, which also depend on where they start.
fn measured_level(measure: Measure, level: i32) -> f32 {
    let difference = level as f32 / 255.0;
    match measure {
        Measure::Signed => difference,
        Measure::Absolute | Measure::Relative => difference.abs(),
        Measure::Squared => difference * difference,
    }
}

/// The colours of the differences from -255 to 255 levels.
fn level_colors(measure: Measure, gain: f32) -> Vec<u32> {
    let color = |level| measure.colormap().color(measured_level(measure, level) * gain);
    (-255..=255).map(color).collect()
}

/// `gain / (a + 0.01)` per level of difference, for every level of A.
#[derive(Clone, Debug)]
struct RelativeTable([f32; 256]);

impl RelativeTable {
    fn new(gain: f32) -> Self {
        let mut level = 0.0;
        Self([(); 256].map(|()| {
            // The hundredth of white is 2.55 levels.
            let scale = gain / (level + 2.55);
            level += 1.0;
            scale
        }))
    }

    /// The largest relative difference among four channels, times the gain.
    #[inline]
    fn difference(&self, a: u32, b: u32) -> f32 {
        let [a, b] = compared(a, b).map(u32::to_be_bytes);
        a.into_iter().zip(b).fold(0.0, |most, (a, b)| {
            let difference = f32::from(a.abs_diff(b)) * self.0[usize::from(a)];
            difference.max(most)
        })
    }
}

/// A number from 0 to [`STEPS`] rounded to nearest, as an index.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "`as` saturates at both ends of u16"
)]
fn step(value: f32) -> usize {
    usize::from((value + 0.5) as u16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (255.0, "255"),
            (31.875, "31.9"),
            (2.5, "2.5"),
            (0.25, "0.25"),
            (1000.0, "1000"),
        ] {
            assert_eq!(short(value), text);
        }
    }

    #[test]
    fn legend_has_the_colours_of_the_differences() {
        for measure in Measure::ALL {
            let paint = DifferencePaint::new(measure, 4.0);
            let LegendKey::Scale(colors, ticks) = paint.legend(false).key else {
                panic!("{measure:?} has a scale");
            };
            let white = paint.pixel(0xff00_0000, 0xffff_ffff);
            assert_eq!(colors.last(), Some(&white), "{measure:?}: the last colour");
            let places: Vec<f32> = ticks.iter().map(|(place, _)| *place).collect();
            let signed = measure == Measure::Signed;
            assert_eq!(places, if signed { vec![0.0, 0.5, 1.0] } else { vec![0.0, 1.0] });
            let zero = usize::from(signed);
            assert_eq!(ticks[zero].1, "0", "{measure:?}");
        }
    }

    #[test]
    fn legend_says_more_only_where_there_may_be_more() {
        for (measure, gain, is_normalized, expected) in [
            (Measure::Signed, 1.0, false, "−255 levels | 0 | +255 levels"),
            (Measure::Signed, 3.0, false, "−85 and more | 0 | +85 levels and more"),
            (Measure::Signed, 3.0, true, "−85 levels | 0 | +85 levels"),
            (Measure::Absolute, 1.0, false, "0 | 255 levels"),
            (Measure::Absolute, 4.0, false, "0 | 63.8 levels and more"),
            (Measure::Absolute, 2.0, true, "0 | 128 levels"),
            (Measure::Squared, 1.0, false, "0 | 65025 levels²"),
            (Measure::Relative, 1.0, false, "0 | 100 % of A and more"),
        ] {
            let words = measure.marks(gain, is_normalized).join(" | ");
            assert_eq!(words, expected, "{measure:?} times {gain}");
        }
    }

    #[test]
    fn what_is_transparent_shows_its_alpha_alone() {
        for measure in Measure::ALL {
            let paint = DifferencePaint::new(measure, 1.0);
            for (a, b) in [(0x0aff_ffff, 0), (0x00ff_ffff, 0x0aff_0000)] {
                let expected = paint.pixel(a & 0xff00_0000, b & 0xff00_0000);
                assert_eq!(paint.pixel(a, b), expected, "{measure:?}");
                let mut row = [0; 1];
                paint.row(&[a], &[b], &mut row);
                assert_eq!(row[0], expected, "{measure:?}, in a row");
            }
            assert_ne!(
                paint.pixel(0x0aff_ffff, 0),
                paint.pixel(0xff00_0000, 0xffff_ffff),
                "{measure:?}: ten levels, not all"
            );
        }
    }

    const A: [u32; 4] = [0xFF64_6464, 0xFF64_6464, 0xFF64_6464, 0xFF00_0000];
    const B: [u32; 4] = [0xFF64_6464, 0xFF97_6464, 0xFF64_3F69, 0xFF00_0001];

    fn frame(pixels: &[u32]) -> Framebuffer {
        let mut frame = Framebuffer::new(u32::try_from(pixels.len()).expect("few"), 1);
        frame.pixels_mut().copy_from_slice(pixels);
        frame
    }

    fn shown(measure: Measure, gain: Gain) -> (f32, Vec<u32>) {
        let (a, b) = (frame(&A), frame(&B));
        let mut out = Framebuffer::default();
        let gain = Pair::new(&a, &b)
            .expect("one size")
            .show(DifferenceStyle { measure, gain }, &mut out);
        (gain, out.pixels().to_vec())
    }

    #[test]
    fn show_maps_each_measure_by_hand() {
        let sequential = |value| Colormap::Sequential.color(value);
        let diverging = |value| Colormap::Diverging.color(value);
        let one = Gain::Factor(1.0);
        assert_eq!(
            shown(Measure::Signed, one).1,
            [
                diverging(0.0),
                diverging(0.2),
                diverging(-37.0 / 255.0),
                diverging(1.0 / 255.0)
            ],
            "+51, -37 and +5, +1 level"
        );
        assert_eq!(
            shown(Measure::Absolute, one).1,
            [
                sequential(0.0),
                sequential(0.2),
                sequential(37.0 / 255.0),
                sequential(1.0 / 255.0)
            ],
            "the largest channel"
        );
        assert_eq!(
            shown(Measure::Squared, Gain::Factor(5.0)).1[..2],
            [sequential(0.0), sequential(0.2)],
            "0.04 times five"
        );
        // 51 / (100 + 2.55) and 1 / 2.55.
        let relative = shown(Measure::Relative, one).1;
        for (pixel, value) in [(1, 0.497_318_4), (3, 0.392_156_9)] {
            let close = [-0.5, 0.0, 0.5].map(|shift| sequential(value + shift / 1023.0));
            assert!(
                close.contains(&relative[pixel]),
                "pixel {pixel}: {:08x}",
                relative[pixel]
            );
        }
    }

    #[test]
    fn show_normalizes_to_the_largest() {
        for measure in Measure::ALL {
            let (gain, pixels) = shown(measure, Gain::Normalize);
            assert_eq!(
                pixels[1],
                measure.colormap().color(1.0),
                "{measure:?}: the end of the map"
            );
            assert_eq!(pixels[0], measure.colormap().color(0.0), "{measure:?}: equal ones stay");
            let largest = match measure {
                Measure::Signed | Measure::Absolute => 0.2,
                Measure::Squared => 0.04,
                Measure::Relative => 51.0 / 102.55,
            };
            assert!((gain * largest - 1.0).abs() < 1e-5, "{measure:?}: gain {gain}");
        }
        let a = frame(&A);
        let style = DifferenceStyle {
            measure: Measure::Squared,
            gain: Gain::Normalize,
        };
        let mut out = Framebuffer::new(9, 9);
        let gain = Pair::new(&a, &a).expect("one size").show(style, &mut out);
        assert_eq!((gain, out.width()), (1.0, 4), "equal pictures, another size");
        assert_eq!(out.pixels(), [Colormap::Sequential.color(0.0); 4], "nothing to see");
    }

    #[test]
    fn show_rows_are_their_pixels() {
        arbtest::arbtest(|u| {
            let mut a: Vec<u32> = Vec::new();
            let mut b: Vec<u32> = Vec::new();
            for _ in 0..u.int_in_range(0..=3 * BLOCK)? {
                let pixel: u32 = u.arbitrary()?;
                a.push(pixel);
                // Equal ones, ties between channels, anything.
                b.push(match u.int_in_range(0..=3)? {
                    0 => pixel,
                    1 => pixel ^ 0x0080_0080,
                    2 => pixel.rotate_left(8),
                    _ => u.arbitrary()?,
                });
            }
            for measure in Measure::ALL {
                let paint = DifferencePaint::new(measure, 2.5);
                let mut out = vec![0; a.len()];
                paint.row(&a, &b, &mut out);
                let pixels: Vec<u32> = a.iter().zip(&b).map(|(a, b)| paint.pixel(*a, *b)).collect();
                assert_eq!(out, pixels, "{measure:?}");
            }
            if !a.is_empty() {
                let (a, b) = (frame(&a), frame(&b));
                let pair = Pair::new(&a, &b).expect("one size");
                let pixels = || a.pixels().iter().zip(b.pixels());
                let level = pixels().map(|(a, b)| signed_level(*a, *b).abs()).max();
                let expected = measured_level(Measure::Absolute, level.unwrap_or(0));
                assert!((pair.largest(Measure::Absolute) - expected).abs() < 1e-9, "the largest");
            }
            Ok(())
        });
    }

    #[test]
    fn show_is_symmetric_but_for_the_sign() {
        arbtest::arbtest(|u| {
            let (a, b): ([u32; 8], [u32; 8]) = (u.arbitrary()?, u.arbitrary()?);
            let (a, b) = (frame(&a), frame(&b));
            let pair = Pair::new(&a, &b).expect("one size");
            let show = |pair: Pair<'_>, measure| {
                let mut out = Framebuffer::default();
                pair.show(
                    DifferenceStyle {
                        measure,
                        gain: Gain::Factor(3.0),
                    },
                    &mut out,
                );
                out
            };
            for measure in [Measure::Absolute, Measure::Squared] {
                assert_eq!(show(pair, measure), show(pair.swapped(), measure), "{measure:?}");
            }
            for (a, b) in a.pixels().iter().zip(b.pixels()) {
                assert_eq!(signed_level(*a, *b), -signed_level(*b, *a), "{a:08x} and {b:08x}");
            }
            Ok(())
        });
    }
}
