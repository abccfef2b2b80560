//! The elliptical weighted average at samples: weights in floats, made whole numbers whose sum is always the same, so that a
//! constant texture stays constant and an explanation can repeat each sample exactly.

use glam::DVec2;

use super::ellipse::{Ellipse, Row};
use super::fixed_point::REACH;
use super::{MipLevel, Wrap};
use crate::color::Premultiplied16;

/// The sum of the weights of one sample. Sums of 16 samples fit 32 bits with a sign.
pub(super) const WHOLE: i32 = 1 << WHOLE_BITS;
const WHOLE_BITS: u32 = 18;
/// From a sum of bytes times weights to the bits that are stored.
pub(super) const SHIFT: u32 = WHOLE_BITS - 8;

/// A level read by an ellipse.
#[derive(Clone, Copy, Debug)]
pub(super) struct EwaFilter<'a> {
    pub(super) level: &'a MipLevel,
    pub(super) wrap: Wrap,
    pub(super) ellipse: Ellipse,
}

/// The weights of a sample, kept from list to list so that their memory is.
#[derive(Debug, Default)]
pub(super) struct Weights {
    rows: Vec<(i32, Row)>,
    /// One after the other, row by row.
    parts: Vec<f32>,
}

impl EwaFilter<'_> {
    /// The colour at a point, in texels; whole coordinates are centres.
    pub(super) fn color(&self, at: DVec2, weights: &mut Weights) -> Premultiplied16 {
        let mut sums = [1 << (SHIFT - 1); 4];
        self.each(at, weights, |texel, weight| {
            for (sum, channel) in sums.iter_mut().zip(texel.1) {
                *sum += i32::from(channel) * weight;
            }
        });
        Premultiplied16(sums.map(|sum| channel(sum >> SHIFT)))
    }

    /// Calls `read` with each texel under the ellipse about a point, its column and row and colour, and with its weight; they
    /// sum to [`WHOLE`].
    #[inline]
    pub(super) fn each(&self, at: DVec2, weights: &mut Weights, mut read: impl FnMut(([i32; 2], [u8; 4]), i32)) {
        let at = self.inside(at);
        let total = weights.fill(&self.ellipse, at);
        let scale = WHOLE as f32 / total;
        let mut rest = WHOLE;
        let mut parts = weights.parts.iter();
        for (y, row) in &weights.rows {
            for (x, part) in (row.columns[0]..row.columns[1]).zip(&mut parts) {
                let weight = rounded(part * scale);
                rest -= weight;
                read(([x, *y], self.texel([x, *y])), weight);
            }
        }
        // The nearest texel takes what rounding left.
        let nearest = [at.x, at.y].map(nearest);
        read((nearest, self.texel(nearest)), rest);
    }

    /// What stands in a column and a row.
    #[inline]
    pub(super) fn texel(&self, at: [i32; 2]) -> [u8; 4] {
        self.level.wrapped(self.wrap, at)
    }

    /// A point near the level, where what is repeated is the same.
    #[inline]
    pub(super) fn inside(&self, at: DVec2) -> DVec2 {
        let axis = |at: f64, side: u32| {
            let side = f64::from(side);
            if !at.is_finite() {
                return 0.0;
            }
            match self.wrap {
                Wrap::Clamp => at.clamp(-REACH, side + REACH),
                // Two copies, of which the second one may be turned round.
                Wrap::Repeat | Wrap::Mirror => at - (at / (2.0 * side)).floor() * (2.0 * side),
            }
        };
        DVec2::new(axis(at.x, self.level.width()), axis(at.y, self.level.height()))
    }
}

impl Weights {
    /// Those of the texels under an ellipse about a point; their sum.
    #[inline]
    fn fill(&mut self, ellipse: &Ellipse, at: DVec2) -> f32 {
        self.rows.clear();
        self.parts.clear();
        let mut total = 0.0;
        for y in ellipse.rows(at) {
            let row = ellipse.row(at, y);
            for x in row.columns[0]..row.columns[1] {
                let part = row.weight(x);
                total += part;
                self.parts.push(part);
            }
            self.rows.push((y, row));
        }
        total
    }
}

/// A weight, rounded to nearest.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "at most WHOLE")]
fn rounded(weight: f32) -> i32 {
    weight.round_ties_even() as i32
}

#[inline]
#[expect(clippy::cast_possible_truncation, reason = "a place near a level")]
fn nearest(at: f64) -> i32 {
    (at + 0.5).floor() as i32
}

#[inline]
fn channel(sum: i32) -> u16 {
    u16::try_from(sum).unwrap_or(Premultiplied16::ONE)
}
