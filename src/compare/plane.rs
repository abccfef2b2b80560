//! One channel of a tile as floats, and filters along rows and columns.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x16};

use crate::simd;

/// Numbers in rows of `width`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plane {
    width: usize,
    values: Vec<f32>,
}

impl Plane {
    /// Rows of `width` numbers each.
    pub(super) fn new(width: usize, values: Vec<f32>) -> Self {
        Self { width, values }
    }

    /// All numbers, row by row.
    pub(super) fn values(&self) -> &[f32] {
        &self.values
    }

    /// The same, and nothing else is kept.
    pub(super) fn into_values(self) -> Vec<f32> {
        self.values
    }

    /// Each number becomes the sum of its neighbours in the row times `kernel`, which has an odd length and is not
    /// mirrored: its first weight is that of the leftmost neighbour. `margin` numbers at either end of a row are left
    /// out; it is at least half of the kernel's length.
    pub(super) fn across(&self, kernel: &[f32], margin: usize) -> Self {
        let width = self.width - 2 * margin;
        let first = margin - kernel.len() / 2;
        let mut values = vec![0.0; self.values.len() / self.width * width];
        for (row, out) in self.values.chunks_exact(self.width).zip(values.chunks_exact_mut(width)) {
            weigh(simd::level(), out, kernel, &row[first..], 1);
        }
        Self { width, values }
    }

    /// As [`Plane::across`] along columns: the first weight is that of the uppermost neighbour, and `margin` rows at
    /// either end are left out.
    pub(super) fn down(&self, kernel: &[f32], margin: usize) -> Self {
        let height = self.values.len() / self.width - 2 * margin;
        let first = margin - kernel.len() / 2;
        let mut values = vec![0.0; height * self.width];
        for (out, y) in values.chunks_exact_mut(self.width).zip(first..) {
            weigh(simd::level(), out, kernel, &self.values[y * self.width..], self.width);
        }
        Self { values, ..*self }
    }
}

/// Sums that are in registers at once: two vectors, so that one is added to while the other waits for its product.
const AT_ONCE: usize = 32;

/// Each of `out` becomes the sum of the numbers `stride` apart from its place in `from` on, times `kernel`: added in the
/// kernel's order, whatever the instructions.
fn weigh(level: Level, out: &mut [f32], kernel: &[f32], from: &[f32], stride: usize) {
    dispatch!(level, simd => simd.vectorize(
        #[inline(always)]
        || weigh_by(simd, out, kernel, from, stride),
    ));
}

#[inline(always)]
fn weigh_by<S: Simd>(simd: S, out: &mut [f32], kernel: &[f32], from: &[f32], stride: usize) {
    let mut at = 0;
    let (blocks, rest) = out.as_chunks_mut::<AT_ONCE>();
    for block in blocks {
        let mut sums = [f32x16::splat(simd, 0.0); 2];
        let mut tap = at;
        for weight in kernel {
            let near = &from[tap..tap + AT_ONCE];
            sums[0] += f32x16::from_slice(simd, &near[..16]) * *weight;
            sums[1] += f32x16::from_slice(simd, &near[16..]) * *weight;
            tap += stride;
        }
        sums[0].store_slice(&mut block[..16]);
        sums[1].store_slice(&mut block[16..]);
        at += AT_ONCE;
    }
    for out in rest {
        let mut tap = at;
        for weight in kernel {
            *out += weight * from[tap];
            tap += stride;
        }
        at += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plane_filters_by_hand() {
        let plane = Plane::new(4, vec![1.0, 2.0, 4.0, 8.0, 0.0, 1.0, 0.0, 0.0, 3.0, 0.0, 0.0, 5.0]);
        let across = plane.across(&[-1.0, 0.0, 10.0], 1);
        assert_eq!(
            across.values(),
            [39.0, 78.0, 0.0, -1.0, -3.0, 50.0],
            "two columns are left"
        );
        let down = plane.down(&[1.0, 2.0, 3.0], 1);
        assert_eq!(down.values(), [10.0, 4.0, 4.0, 23.0], "one row is left");
        assert_eq!(
            plane.down(&[2.0], 1).values(),
            [0.0, 2.0, 0.0, 0.0],
            "a margin wider than the kernel"
        );
    }

    #[test]
    fn plane_filters_the_same_on_every_level() {
        let mut number = 0.0_f32;
        let plane = Plane::new(
            83,
            std::iter::repeat_with(|| {
                number = (number * 7.3 + 0.37).fract();
                number
            })
            .take(83 * 9)
            .collect(),
        );
        let kernel = [0.1, -0.7, 1.3, 0.2, 1e-3];
        for (name, level) in simd::tested() {
            for stride in [1, 83] {
                let mut found = vec![0.0; 79];
                weigh(level, &mut found, &kernel, plane.values(), stride);
                for (x, found) in found.iter().enumerate() {
                    let sum = kernel.iter().enumerate().fold(0.0_f32, |sum, (k, weight)| {
                        sum + weight * plane.values()[x + k * stride]
                    });
                    assert_eq!(
                        found.to_bits(),
                        sum.to_bits(),
                        "number {x}, {stride} apart, with {name}"
                    );
                }
            }
        }
    }
}
