//! Where the samples of a pixel stand in a level: the same for all pixels of a triangle, but for where the pixel is.

use super::PixelSampling;
use super::filter_plan::{Axis, GridLevel, Plan};
use super::fixed_point::{MASS, MASS_BITS, WHOLE};
use super::wrap::Endless;

/// The most samples along one side of a pixel.
pub(super) const MAX_SIDE: usize = 16;
/// Texels in one direction that a pixel's samples may read.
pub(super) const TEXELS: u32 = 4;

/// How numbers are scaled for a number of samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// Samples along one side of a pixel.
    pub(super) side: u32,
    /// Fractional bits of positions. As many as leave room for the sum of all samples' products in 31 bits.
    pub(super) bits: u32,
    /// A sample weighs `1 << sample_bits` in both levels together, and all samples together weigh at most [`MASS`].
    pub(super) sample_bits: u32,
}

/// One level as the samples of all pixels see it.
#[derive(Clone, Debug)]
pub(super) struct Footing<'a> {
    pub(super) level: GridLevel<'a>,
    pub(super) scale: Scale,
    pub(super) x: Offsets,
    pub(super) y: Offsets,
    /// Both axes, where the texture goes on for ever.
    pub(super) endless: [Option<Endless>; 2],
    /// From a sum of products to a weight.
    pub(super) per_product: f32,
    /// Whether one axis depends on the sample's column only, and the other on its row only.
    pub(super) lines: Option<Lines>,
}

/// The level that is read, and the next coarser one where two are mixed.
#[derive(Clone, Debug)]
pub(super) struct Footings<'a> {
    pub(super) finer: Footing<'a>,
    pub(super) coarser: Option<Footing<'a>>,
}

/// Which axis depends on the sample's column only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lines {
    /// x on the column and y on the row.
    Upright,
    /// x on the row and y on the column.
    Turned,
}

/// Where samples lie on an axis, relative to the centre of their pixel, in fixed point: sample `(i, j)` at
/// `columns[i] + rows[j]`.
#[derive(Clone, Debug)]
pub(super) struct Offsets {
    pub(super) columns: [i16; MAX_SIDE],
    pub(super) rows: [i16; MAX_SIDE],
    /// The least of all sums, and how far the greatest is from it.
    pub(super) least: i32,
    pub(super) span: i32,
}

impl Scale {
    /// For `side x side` samples.
    pub(super) fn new(side: u32) -> Self {
        let count = side * side;
        Self {
            side,
            bits: match count {
                0..=16 => 13,
                17..=64 => 12,
                _ => 11,
            },
            sample_bits: MASS_BITS - count.next_power_of_two().trailing_zeros(),
        }
    }
}

impl<'a> Footings<'a> {
    /// Those of a plan; `None` where each sample must be filtered: where samples are too far apart, have
    /// several taps, or read other texels than the four around them.
    pub(super) fn of_plan(plan: &Plan<'a>, scale: Scale) -> Option<Self> {
        if plan.pixel != PixelSampling::Bilinear || plan.line.taps.count > 1 {
            return None;
        }
        Some(Self {
            finer: Footing::new(plan, &plan.finer, scale)?,
            coarser: match &plan.coarser {
                None => None,
                Some(level) => Some(Footing::new(plan, level, scale)?),
            },
        })
    }
}

impl<'a> Footing<'a> {
    fn new(plan: &Plan<'a>, level: &GridLevel<'a>, scale: Scale) -> Option<Self> {
        let (x, y) = (Offsets::new(&level.x, scale)?, Offsets::new(&level.y, scale)?);
        let zero = |offsets: &[i16]| offsets.iter().all(|offset| *offset == 0);
        let lines = if zero(&x.rows) && zero(&y.columns) {
            Some(Lines::Upright)
        } else if zero(&x.columns) && zero(&y.rows) {
            Some(Lines::Turned)
        } else {
            None
        };
        let one = (1_u32 << scale.bits) as f32;
        Some(Self {
            level: *level,
            scale,
            x,
            y,
            endless: [plan.endless(&level.x), plan.endless(&level.y)],
            per_product: (level.mass << scale.sample_bits) as f32 / MASS as f32 / (one * one),
            lines,
        })
    }

    /// Whether three texels in each direction are enough.
    pub(super) fn is_narrow(&self) -> bool {
        self.x.span.max(self.y.span) <= 1 << self.scale.bits
    }
}

impl Offsets {
    fn new(axis: &Axis, scale: Scale) -> Option<Self> {
        let one = f64::from(1 << scale.bits);
        let widest = (axis.right.abs() + axis.down.abs()) * f64::from(scale.side - 1);
        // The distances between four texels are three, and a pixel starts anywhere in the first one.
        if widest > f64::from(TEXELS - 2) {
            return None;
        }
        let middle = f64::from(scale.side - 1) / 2.0;
        let line = |step: f64| {
            let mut offsets = [0; MAX_SIDE];
            for (i, offset) in offsets.iter_mut().enumerate().take(scale.side as usize) {
                *offset = round((i as f64 - middle) * step * one);
            }
            offsets
        };
        let (columns, rows) = (line(axis.right), line(axis.down));
        let ends = |offsets: &[i16]| {
            let (first, last) = (i32::from(offsets[0]), i32::from(offsets[scale.side as usize - 1]));
            (first.min(last), first.max(last))
        };
        let (columns_ends, rows_ends) = (ends(&columns), ends(&rows));
        let least = columns_ends.0 + rows_ends.0;
        let span = columns_ends.1 + rows_ends.1 - least;
        (span <= (TEXELS.cast_signed() - 2) << scale.bits).then_some(Self {
            columns,
            rows,
            least,
            span,
        })
    }
}

/// To nearest. By adding, because rounding is a call on machines without an instruction for it.
#[expect(
    clippy::cast_possible_truncation,
    reason = "an offset is two texels at most: 16 bits, which stand lowest"
)]
fn round(value: f64) -> i16 {
    (value + WHOLE).to_bits() as i16
}
