//! The elliptical weighted average summed over the samples of a pixel: their ellipses are alike and lie close together, so that
//! a texel is fetched once for all of them, and its weights are found for sixteen samples at a time.
//!
//! Loops over [`LANES`] become vector instructions by themselves; what they calculate is the same whatever their width.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use glam::DVec2;

use super::ellipse::weight;
use super::ewa_filter::{EwaFilter, SHIFT, WHOLE};

/// Samples that are weighed together.
pub(super) const LANES: usize = 16;

type Lanes = [f32; LANES];

/// What the samples of a pixel weigh, kept from pixel to pixel so that its memory is.
#[derive(Debug, Default)]
pub(super) struct SharedWeights {
    /// Row, first column and number of columns of the texels under any of the ellipses, from [`Samples::base`].
    rows: Vec<[i32; 3]>,
    /// Of each texel, row by row.
    parts: Vec<Lanes>,
    /// Of each sample.
    totals: Lanes,
}

/// Some samples, in texels from a texel near them. The last ones are the first one again where there are fewer than lanes.
struct Samples {
    base: [i32; 2],
    x: Lanes,
    y: Lanes,
    count: usize,
}

/// Adds the colours of up to [`LANES`] samples of a pixel, channels as in [`crate::color::Premultiplied16`], to `sums`; `false`
/// where they lie too far apart for that.
#[inline(always)]
pub(super) fn add(filter: &EwaFilter<'_>, at: &[DVec2], weights: &mut SharedWeights, sums: &mut [u32; 4]) -> bool {
    let Some(samples) = Samples::new(filter, at) else {
        return false;
    };
    weights.fill(filter, &samples);
    let mut found = [0; 4];
    let mut add = |[x, y]: [i32; 2], weight: i32| {
        let texel = filter.texel([samples.base[0] + x, samples.base[1] + y]);
        for (sum, channel) in found.iter_mut().zip(texel) {
            *sum += i32::from(channel) * weight;
        }
    };
    let mut scales = [0.0; LANES];
    for (scale, total) in scales.iter_mut().zip(weights.totals).take(samples.count) {
        *scale = WHOLE as f32 / total;
    }
    let mut rests = [0; LANES];
    rests[..samples.count].fill(WHOLE);
    let mut parts = weights.parts.iter();
    for [y, first, count] in &weights.rows {
        for (x, parts) in (*first..first + count).zip(&mut parts) {
            let mut sum = 0;
            for ((part, scale), rest) in parts.iter().zip(&scales).zip(&mut rests) {
                let weight = rounded(part * scale);
                *rest -= weight;
                sum += weight;
            }
            add([x, *y], sum);
        }
    }
    for (i, rest) in rests.iter().enumerate().take(samples.count) {
        add([nearest(samples.x[i]), nearest(samples.y[i])], *rest);
    }
    for (sum, found) in sums.iter_mut().zip(found) {
        *sum += u32::try_from((found + (1 << (SHIFT - 1))) >> SHIFT).unwrap_or(0);
    }
    true
}

impl Samples {
    #[inline(always)]
    fn new(filter: &EwaFilter<'_>, at: &[DVec2]) -> Option<Self> {
        let first = *at.first()?;
        let inside = filter.inside(first);
        let base = inside.floor();
        let [mut x, mut y] = [[narrow(inside.x - base.x); LANES], [narrow(inside.y - base.y); LANES]];
        let far = filter.ellipse.half() * 2.0;
        for ((at, x), y) in at.iter().zip(&mut x).zip(&mut y) {
            let from_first = *at - first;
            // No number is not near, either.
            if !from_first.abs().cmple(far).all() {
                return None;
            }
            let from_base = from_first + (inside - base);
            (*x, *y) = (narrow(from_base.x), narrow(from_base.y));
        }
        Some(Self {
            base: [whole(base.x), whole(base.y)],
            x,
            y,
            count: at.len(),
        })
    }
}

impl SharedWeights {
    #[inline(always)]
    fn fill(&mut self, filter: &EwaFilter<'_>, samples: &Samples) {
        let ellipse = &filter.ellipse;
        let half = narrow(ellipse.half().y);
        let [down, lean, growth] = ellipse.factors().map(narrow);
        let [top, bottom] = bounds(&samples.y);
        self.rows.clear();
        self.parts.clear();
        self.totals = [0.0; LANES];
        for y in ceil(top - half)..=floor(bottom + half) {
            let (mut least, mut middle) = ([0.0; LANES], [0.0; LANES]);
            let (mut left, mut right) = ([0.0; LANES], [0.0; LANES]);
            for i in 0..LANES {
                let below = y as f32 - samples.y[i];
                least[i] = below * below * down;
                middle[i] = samples.x[i] + below * lean;
                let half = ((1.0 - least[i]).max(0.0) / growth).sqrt();
                (left[i], right[i]) = (middle[i] - half, middle[i] + half);
            }
            let (first, last) = (ceil(bounds(&left)[0]), floor(bounds(&right)[1]));
            self.rows.push([y, first, (last - first + 1).max(0)]);
            for x in first..=last {
                let mut parts = [0.0; LANES];
                for i in 0..LANES {
                    let beside = x as f32 - middle[i];
                    parts[i] = weight(least[i] + growth * beside * beside);
                    self.totals[i] += parts[i];
                }
                self.parts.push(parts);
            }
        }
    }
}

/// The least and the greatest.
#[inline(always)]
fn bounds(lanes: &Lanes) -> [f32; 2] {
    let fold = |by: fn(f32, f32) -> f32| {
        let mut halves = *lanes;
        for half in [8, 4, 2, 1] {
            for i in 0..half {
                halves[i] = by(halves[i], halves[i + half]);
            }
        }
        halves[0]
    };
    [fold(least), fold(greatest)]
}

#[inline(always)]
fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn greatest(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// A weight from 0 to [`WHOLE`], rounded to nearest: adding a large number leaves the whole part in the lower bits.
#[inline(always)]
fn rounded(weight: f32) -> i32 {
    const LARGE: f32 = 12_582_912.0;
    ((weight + LARGE).to_bits() - LARGE.to_bits()).cast_signed()
}

#[inline(always)]
fn nearest(at: f32) -> i32 {
    floor(at + 0.5)
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a place within a hundred texels")]
fn floor(at: f32) -> i32 {
    at.floor() as i32
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a place within a hundred texels")]
fn ceil(at: f32) -> i32 {
    at.ceil() as i32
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a place near a level")]
fn whole(at: f64) -> i32 {
    at as i32
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "distances of few texels")]
fn narrow(at: f64) -> f32 {
    at as f32
}
