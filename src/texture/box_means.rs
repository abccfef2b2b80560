//! Means over boxes at samples, from a table of sums of bytes.
//!
//! ```text
//!      f0                f1      of the columns of corners around the left border, and around the right one, the parts f0 and
//!     |~~#|############|~~|      f1 of a texel lie left of them; rows likewise
//! ```
//!
//! Beyond a border where the outermost texels go on, sums go on as in the last column or row, and nothing else changes.
//!
//! Differences of sums are whole numbers and exact; parts of a texel are weighed in 32-bit floats, and a mean errs by less than
//! one part in a million of the brightest: a tenth of the steps in which channels are stored.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x4, f32x8, i32x4, i32x8, u32x8};
use glam::DVec2;

use super::box_sums;
use super::few_texels::FewTexels;
use super::filter_plan::{PixelList, Plan};
use super::fixed_point::{REACH, WHOLE};
use super::sample_places::{LANES, PixelPlaces, Places, ROUNDING, whole, whole_sum};
use super::summed_area::SummedAreaTable;
use super::texel_blocks::EndlessLevel;
use super::{TexelBox, UvMap, Wrap};
use crate::color::Premultiplied16;

/// A level read by a box.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxFilter<'a> {
    pub(super) table: &'a SummedAreaTable,
    /// What was summed.
    pub(super) texels: EndlessLevel<'a>,
    pub(super) area: TexelBox,
}

/// Where the two borders of boxes lie between the table's columns, or rows.
struct Borders {
    /// The last ones before them. Beyond the level, where its outermost texels go on, sums go on as in them.
    at: [[u32; LANES]; 2],
    /// What to weigh sums by, besides those from the last one before the left border to the last one before the right border:
    /// how much more there is from the next ones to the next, and from the last one before the left border to the next.
    parts: [[f32; LANES]; 2],
    /// Whether that is what the box holds.
    is_inside: [bool; LANES],
}

impl<'a> BoxFilter<'a> {
    /// What reads the texels themselves, where the samples of a pixel have few enough of them below.
    pub(super) fn few_texels(&self, map: &UvMap, is_opaque: bool) -> Option<FewTexels<'a>> {
        let size = DVec2::from(self.table.size().map(f64::from));
        let pixel = (map.dx.abs() + map.dy.abs()) * size;
        let is_quicker = self.table.of_bytes().is_some() && FewTexels::are_enough(self.area.sides, pixel);
        is_quicker.then_some(FewTexels {
            texels: self.texels,
            sides: self.area.sides,
            is_opaque,
        })
    }

    /// Whether a box is one texel of bytes: its mean mixes the four texels around its middle, as [`super::PixelSampling::Bilinear`]
    /// does.
    pub(super) fn is_bilinear(&self) -> bool {
        self.area.sides == DVec2::ONE && self.table.of_bytes().is_some()
    }

    /// The colours at some places; those of the lanes that repeat the first are any.
    pub(super) fn colors(&self, simd: Level, places: &Places) -> [Premultiplied16; LANES] {
        let mut out = [Premultiplied16::TRANSPARENT; LANES];
        let taken = &mut out[..places.count.min(LANES)];
        if let Some(sums) = self.table.of_bytes() {
            dispatch!(simd, simd => simd.vectorize(
                #[inline(always)]
                || {
                    let means = Means::new(self, sums, places);
                    for (lane, out) in taken.iter_mut().enumerate() {
                        *out = match means.of(simd, lane) {
                            Some(mean) => Premultiplied16(<[f32; 4]>::from(mean).map(whole)),
                            None => self.anywhere(simd, places, lane),
                        };
                    }
                },
            ));
        } else {
            dispatch!(simd, simd => simd.vectorize(
                #[inline(always)]
                || {
                    for (lane, out) in taken.iter_mut().enumerate() {
                        *out = self.anywhere(simd, places, lane);
                    }
                },
            ));
        }
        out
    }

    /// The sums of the colours of pixels' samples; see [`super::Filter::sums`].
    pub(super) fn sums(&self, simd: Level, (plan, side): (&Plan<'_>, u32), list: PixelList<'_>, sums: &mut [[u32; 4]]) {
        let samples = PixelPlaces::new(side);
        let add = |color: Premultiplied16, sum: &mut [u32; 4]| {
            for (sum, channel) in sum.iter_mut().zip(color.0) {
                *sum += u32::from(channel);
            }
        };
        let Some(numbers) = self.table.of_bytes() else {
            return dispatch!(simd, simd => simd.vectorize(
                #[inline(always)]
                || samples.each_of(plan, list, sums, |places, sum| {
                    (0..places.count).for_each(|lane| add(self.anywhere(simd, places, lane), sum));
                }),
            ));
        };
        dispatch!(simd, simd => simd.vectorize(
            #[inline(always)]
            || samples.each_of(plan, list, sums, |places, sum| {
                let all = total(simd, self, numbers, places, |color| add(color, sum));
                for (sum, all) in sum.iter_mut().zip(all) {
                    *sum += whole_sum(all);
                }
            }),
        ));
    }

    /// The colour at a place whose box may lie across a border, of any table.
    // Outlined: in the callers' loops it would not be inlined, and would lose the vector instructions.
    #[inline(never)]
    fn anywhere<S: Simd>(&self, simd: S, places: &Places, lane: usize) -> Premultiplied16 {
        simd.vectorize(
            #[inline(always)]
            || box_sums::mean(simd, self.table, places.at(lane) + 0.5, &self.area, self.texels.wrap),
        )
    }
}

impl Borders {
    /// On an axis of so many texels, of boxes that are twice `half` long about these places.
    #[inline(always)]
    fn new(wrap: Wrap, side: u32, at: &[f64; LANES], half: f64) -> Self {
        let last = f64::from(side - 1);
        let side = f64::from(side);
        let mut found = Self {
            at: [[0; LANES]; 2],
            parts: [[0.0; LANES]; 2],
            is_inside: [true; LANES],
        };
        for (i, at) in at.iter().enumerate() {
            let middle = match wrap {
                // Farther away there is nothing but the border.
                Wrap::Clamp => (at + 0.5).max(-half).min(side + half),
                Wrap::Repeat => at + 0.5 - ((at + 0.5) / side).floor() * side,
                Wrap::Mirror => {
                    let in_both = at + 0.5 - ((at + 0.5) / (2.0 * side)).floor() * (2.0 * side);
                    in_both.min(2.0 * side - in_both)
                }
            };
            let (from, to) = (middle - half, middle + half);
            if wrap != Wrap::Clamp {
                found.is_inside[i] = from >= 0.0 && to <= side;
            }
            // A border on a column of corners may as well be the end of one texel as the start of the next.
            let before = |border: f64| (border - 0.5).max(0.0).min(last) + WHOLE;
            let [first, second] = [before(from), before(to)];
            let [f0, f1] = [narrow(from - (first - WHOLE)), narrow(to - (second - WHOLE))];
            (found.at[0][i], found.at[1][i]) = (lowest(first), lowest(second));
            (found.parts[0][i], found.parts[1][i]) = (f1, f1 - f0);
        }
        found
    }
}

/// The boxes of some samples, and the table that they are read from.
struct Means<'t> {
    sums: &'t [[u32; 4]],
    stride: usize,
    x: Borders,
    y: Borders,
    per_texel: f32,
}

impl<'t> Means<'t> {
    #[inline(always)]
    fn new(filter: &BoxFilter<'_>, sums: &'t [[u32; 4]], places: &Places) -> Self {
        let [width, height] = filter.table.size();
        let half = (filter.area.sides * 0.5).min(DVec2::splat(REACH));
        let wrap = filter.texels.wrap;
        Self {
            sums,
            stride: width as usize + 1,
            x: Borders::new(wrap, width, &places.x, half.x),
            y: Borders::new(wrap, height, &places.y, half.y),
            per_texel: narrow(f64::from(Premultiplied16::PER_BYTE) / (half * 2.0).element_product()),
        }
    }

    /// The channels of a mean, which are whole numbers; `None` where the box lies across a border.
    // No callback for each of them: what it adds up would be stored and loaded again for every sample.
    #[inline(always)]
    fn of<S: Simd>(&self, simd: S, lane: usize) -> Option<f32x4<S>> {
        let Self { stride, x, y, .. } = self;
        let lane = lane % LANES;
        if !(x.is_inside[lane] && y.is_inside[lane]) {
            return None;
        }
        let (left, right) = (x.at[0][lane] as usize, x.at[1][lane] as usize);
        let (top, bottom) = (y.at[0][lane] as usize * stride, y.at[1][lane] as usize * stride);
        let left = strips(simd, self.sums, *stride, [top + left, bottom + left]);
        let right = strips(simd, self.sums, *stride, [top + right, bottom + right]);
        let weights = [1.0, y.parts[0][lane], y.parts[1][lane]];
        let mut wide = f32x8::splat(simd, 0.0);
        let mut narrow = f32x4::splat(simd, 0.0);
        for i in 0..3 {
            let (before, after) = (right[i] - left[i]).split();
            let signed: i32x8<S> = before.combine(after - before).bitcast();
            wide += signed.to_float::<f32x8<S>>() * weights[i];
            let (before, after) = left[i].split();
            let signed: i32x4<S> = (after - before).bitcast();
            narrow += signed.to_float::<f32x4<S>>() * weights[i];
        }
        let (all, more) = wide.split();
        let sum = all + more * x.parts[0][lane] + narrow * x.parts[1][lane];
        Some(sum * self.per_texel + ROUNDING - ROUNDING)
    }
}

/// The sum of the channels at places, whole numbers; the colours of those whose boxes lie across a border are given to `add`.
#[inline(always)]
fn total<S: Simd>(
    simd: S,
    filter: &BoxFilter<'_>,
    sums: &[[u32; 4]],
    places: &Places,
    mut add: impl FnMut(Premultiplied16),
) -> [f32; 4] {
    let means = Means::new(filter, sums, places);
    let mut all = f32x4::splat(simd, 0.0);
    for lane in 0..places.count.min(LANES) {
        match means.of(simd, lane) {
            Some(mean) => all += mean,
            None => add(filter.anywhere(simd, places, lane)),
        }
    }
    all.into()
}

/// A number of a table and the next, and those of the next row.
#[inline(always)]
fn four<S: Simd>(simd: S, sums: &[[u32; 4]], stride: usize, at: usize) -> [u32x8<S>; 2] {
    let rows = &sums[at..][..stride + 2];
    [
        u32x8::from_slice(simd, rows[..2].as_flattened()),
        u32x8::from_slice(simd, rows[stride..].as_flattened()),
    ]
}

/// From four rows of a table, each of the last and the next numbers before a border, the differences that [`Borders::parts`]
/// weighs: both rows above the box and both below it begin at `[above, below]` and one row later.
#[inline(always)]
fn strips<S: Simd>(simd: S, sums: &[[u32; 4]], stride: usize, [above, below]: [usize; 2]) -> [u32x8<S>; 3] {
    let [first, second] = four(simd, sums, stride, above);
    let [third, fourth] = four(simd, sums, stride, below);
    [third - first, (fourth - third) - (second - first), second - first]
}

/// The whole number in the lowest bits.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "it is that of a column or a row")]
fn lowest(at: f64) -> u32 {
    at.to_bits() as u32
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "parts of a texel, and of a box")]
fn narrow(part: f64) -> f32 {
    part as f32
}
