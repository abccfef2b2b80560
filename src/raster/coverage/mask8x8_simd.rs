//! The coverage of many small triangles at a time, a lane of a vector for each.
//!
//! As [`CoverageMask::new`], for boxes of at most [`SIDE`] columns and rows of samples that lie in the frame. Everything is
//! reckoned in 64-bit floats: coordinates of the grid and edge values of small triangles are whole numbers far below
//! `2^53`, so nothing is ever rounded but on purpose.
#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f64x8, i32x8, mask64x8, u32x8};
use glam::DVec2;

use crate::geometry::subpixel::{GUARD, SubpixelGrid, WHOLE};
use crate::raster::coverage::mask8x8::CoverageMask;
use crate::raster::span::SpanRect;
use crate::rules::Rules;
use crate::simd;

/// Triangles in a batch: lanes of a vector.
pub(crate) const LANES: usize = 8;

/// Sample columns and rows of the box that a triangle must fit in.
const SIDE: i32 = 4;

/// A number of each triangle.
type Lanes = [f64; LANES];

/// Corners in screen space.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TriangleBatch {
    /// Of the first, second and third corners.
    x: [Lanes; 3],
    y: [Lanes; 3],
}

/// What the triangles of a batch cover.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BatchCoverage {
    columns: [i32; LANES],
    rows: [i32; LANES],
    /// The lower half of the masks: rows beyond the fourth are empty.
    masks: [u32; LANES],
    /// Which triangles are small enough to be decided, and which have no area: a bit each.
    decided: u64,
    flat: u64,
}

/// The lattice of samples as floats.
#[derive(Clone, Copy, Debug)]
struct Lattice {
    units_per_pixel: f64,
    /// Units between two samples, and what to multiply with in place of dividing by it.
    distance: f64,
    inverse: f64,
    /// What an edge loses that does not own its samples.
    tie: f64,
    /// What is added to the greatest coordinate, so that samples there count where all edges own theirs.
    beyond: f64,
    /// One beyond the last column and row of the frame.
    ends: [f64; 2],
}

/// The same number for all triangles.
#[derive(Clone, Copy)]
struct Splats<S: Simd> {
    simd: S,
    lattice: Lattice,
}

/// A coordinate of the three corners of each triangle on the sub-pixel grid, and its samples.
#[derive(Clone, Copy)]
struct Axis<S: Simd> {
    corners: [f64x8<S>; 3],
    /// The first column or row of the box, and its coordinate.
    start: f64x8<S>,
    first: f64x8<S>,
    /// Whether the box is small and in the frame.
    fits: mask64x8<S>,
}

/// A [`SampleEdge`](crate::geometry::edge::SampleEdge) of each triangle, with the same tie rule.
#[derive(Clone, Copy)]
struct Edge<S: Simd> {
    value: i32x8<S>,
    right: i32x8<S>,
    down: i32x8<S>,
}

impl TriangleBatch {
    /// Puts a triangle into a lane.
    #[inline]
    pub(crate) fn set(&mut self, lane: usize, points: [DVec2; 3]) {
        for (corner, point) in points.into_iter().enumerate() {
            self.x[corner][lane] = point.x;
            self.y[corner][lane] = point.y;
        }
    }

    /// The triangle of a lane.
    pub(crate) fn get(&self, lane: usize) -> [DVec2; 3] {
        [0, 1, 2].map(|corner| DVec2::new(self.x[corner][lane], self.y[corner][lane]))
    }

    /// What the triangles cover of a frame of these samples.
    pub(crate) fn coverage(&self, frame: SpanRect, grid: SubpixelGrid, rules: Rules) -> BatchCoverage {
        let lattice = Lattice::new(frame, grid, rules);
        dispatch!(simd::level(), simd => coverage(simd, self, &lattice))
    }
}

impl BatchCoverage {
    /// How many triangles are decided.
    pub(crate) fn decided(&self) -> usize {
        self.decided.count_ones() as usize
    }

    /// What the triangle of a lane covers; `None` where it may be larger than what a batch is for, or leave the frame.
    #[inline]
    pub(crate) fn get(&self, lane: usize) -> Option<CoverageMask> {
        let mask = if self.flat >> lane & 1 == 0 {
            self.masks[lane]
        } else {
            0
        };
        (self.decided >> lane & 1 != 0).then(|| CoverageMask {
            column: self.columns[lane],
            row: self.rows[lane],
            mask: u64::from(mask),
        })
    }
}

impl Lattice {
    fn new(frame: SpanRect, grid: SubpixelGrid, rules: Rules) -> Self {
        let distance = f64::from(1 << grid.bits());
        let (tie, beyond) = match rules {
            Rules::Standard | Rules::Float => (1.0, 0.0),
            Rules::Course => (0.0, 1.0),
        };
        Self {
            units_per_pixel: grid.units_per_pixel(),
            distance,
            inverse: 1.0 / distance,
            tie,
            beyond,
            ends: [frame.x.end, frame.y.end].map(f64::from),
        }
    }
}

impl<S: Simd> Splats<S> {
    #[inline(always)]
    fn number(self, number: f64) -> f64x8<S> {
        f64x8::splat(self.simd, number)
    }

    /// The whole number at or below a multiple of the lattice's inverse.
    #[inline(always)]
    fn floor(self, value: f64x8<S>) -> f64x8<S> {
        let whole = self.number(WHOLE);
        (value - self.number(self.below_half()) + whole) - whole
    }

    /// What to take from a multiple of the lattice's inverse so that the nearest whole number is the one at or below it.
    #[inline(always)]
    fn below_half(self) -> f64 {
        0.5 - 0.5 * self.lattice.inverse
    }

    /// The nearest numbers of the sub-pixel grid; halves go up, as in [`SubpixelGrid::snap`].
    #[inline(always)]
    fn snap(self, pixels: f64x8<S>) -> f64x8<S> {
        let whole = self.number(WHOLE);
        let value = pixels * self.number(self.lattice.units_per_pixel) + self.number(0.5);
        let near = (value + whole) - whole;
        near.simd_gt(value).select(near - self.number(1.0), near)
    }

    /// The first sample column or row at or after a coordinate; as [`SubpixelGrid::sample_at_or_after`].
    #[inline(always)]
    fn at_or_after(self, coordinate: f64x8<S>) -> f64x8<S> {
        let half = self.number(0.5 * self.lattice.distance);
        let before = (half - coordinate) * self.number(self.lattice.inverse);
        self.number(0.0) - self.floor(before)
    }

    /// One coordinate of the corners, in pixels, and one beyond the frame's last sample.
    #[inline(always)]
    fn axis(self, pixels: &[Lanes; 3], end: f64) -> Axis<S> {
        let [a, b, c] = pixels.map(
            #[inline(always)]
            |pixels| f64x8::simd_from(self.simd, pixels),
        );
        // Comparing lets nothing pass that is no number; the greatest and least of some might.
        let (low, high) = (self.number(GUARD.0), self.number(GUARD.1));
        let in_guard =
            (a.simd_ge(low) & b.simd_ge(low) & c.simd_ge(low)) & (a.simd_le(high) & b.simd_le(high) & c.simd_le(high));
        let corners = [self.snap(a), self.snap(b), self.snap(c)];
        let [a, b, c] = corners;
        let start = self.at_or_after(a.min(b).min(c));
        let after = self.at_or_after(a.max(b).max(c) + self.number(self.lattice.beyond));
        let few = (after - start).simd_le(self.number(f64::from(SIDE)));
        let distance = self.number(self.lattice.distance);
        Axis {
            corners,
            start,
            first: start * distance + self.number(0.5 * self.lattice.distance),
            fits: in_guard & few & start.simd_ge(self.number(0.0)) & after.simd_le(self.number(end)),
        }
    }

    /// The edge `from -> to` of clockwise triangles, standing at their first samples.
    #[inline(always)]
    fn edge(self, first: [f64x8<S>; 2], from: [f64x8<S>; 2], to: [f64x8<S>; 2]) -> Edge<S> {
        let zero = self.number(0.0);
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let (right, down) = (first[0] - from[0], first[1] - from[1]);
        let owns_ties = dy.simd_lt(zero) | (dy.simd_eq(zero) & dx.simd_gt(zero));
        let exact = dx * down - dy * right - owns_ties.select(zero, self.number(self.lattice.tie));
        Edge {
            value: whole(self.simd, self.floor(exact * self.number(self.lattice.inverse))),
            right: whole(self.simd, zero - dy),
            down: whole(self.simd, dx),
        }
    }
}

#[inline(always)]
fn coverage<S: Simd>(simd: S, batch: &TriangleBatch, lattice: &Lattice) -> BatchCoverage {
    let splats = Splats {
        simd,
        lattice: *lattice,
    };
    let zero = splats.number(0.0);
    let x = splats.axis(&batch.x, lattice.ends[0]);
    let y = splats.axis(&batch.y, lattice.ends[1]);
    let [ax, bx, cx] = x.corners;
    let [ay, by, cy] = y.corners;
    let area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    // Clockwise from here on.
    let turned = area.simd_lt(zero);
    let a = [ax, ay];
    let b = [turned.select(cx, bx), turned.select(cy, by)];
    let c = [turned.select(bx, cx), turned.select(by, cy)];
    let first = [x.first, y.first];
    let edges = [
        splats.edge(first, a, b),
        splats.edge(first, b, c),
        splats.edge(first, c, a),
    ];
    BatchCoverage {
        columns: whole(simd, x.start).into(),
        rows: whole(simd, y.start).into(),
        masks: masks(simd, edges).into(),
        decided: (x.fits & y.fits).to_bitmask(),
        flat: area.simd_eq(zero).to_bitmask(),
    }
}

/// The samples outside of no edge: bit `8 j + i` for the sample `i` columns to the right and `j` rows down.
#[inline(always)]
fn masks<S: Simd>(simd: S, [a, b, c]: [Edge<S>; 3]) -> u32x8<S> {
    let mut outside = i32x8::splat(simd, 0);
    let mut row = [a.value, b.value, c.value];
    for j in 0..SIDE {
        let mut values = row;
        for i in 0..SIDE {
            let signs = (values[0] | values[1] | values[2]) >> 31;
            outside |= signs & i32x8::splat(simd, 1 << (8 * j + i));
            values = [values[0] + a.right, values[1] + b.right, values[2] + c.right];
        }
        row = [row[0] + a.down, row[1] + b.down, row[2] + c.down];
    }
    (!outside & i32x8::splat(simd, 0x0F0F_0F0F)).bitcast()
}

/// Whole numbers of `i32`, whose lower halves are taken from others.
#[inline(always)]
fn whole<S: Simd>(simd: S, value: f64x8<S>) -> i32x8<S> {
    let (low, high) = (value + f64x8::splat(simd, WHOLE)).split();
    simd.narrow_i64x4(low.bitcast(), high.bitcast())
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};

    use super::*;
    use crate::raster::span::Span;

    #[test]
    fn triangles_are_covered_as_one_by_one_on_every_level() {
        let (mut known, mut covered, mut left) = (0_u32, 0_u32, 0_u32);
        arbtest::arbtest(|u| {
            let grid = SubpixelGrid::new(u.int_in_range(1..=16)?);
            let rules = *u.choose(&Rules::ALL)?;
            let size = [u.int_in_range(1..=40)?, u.int_in_range(1..=40)?];
            let [columns, rows] = size.map(|end| Span {
                start: 0,
                end: end * grid.side(),
            });
            let frame = SpanRect { x: columns, y: rows };
            let mut batch = TriangleBatch::default();
            for lane in 0..LANES {
                batch.set(lane, triangle(u, size, grid)?);
            }
            let lattice = Lattice::new(frame, grid, rules);
            for (name, level) in simd::tested() {
                let found = dispatch!(level, simd => coverage(simd, &batch, &lattice));
                for lane in 0..LANES {
                    let points = batch.get(lane);
                    let Some(found) = found.get(lane) else {
                        left += 1;
                        continue;
                    };
                    known += 1;
                    covered += u32::from(found.mask != 0);
                    let corners = points.map(|point| grid.snap(point));
                    let samples = SpanRect::of_samples(corners, grid, rules);
                    assert!(
                        samples.is_small() && samples.intersection(frame) == samples,
                        "{points:?} fits"
                    );
                    let expected = CoverageMask::new(corners, samples, grid, rules);
                    assert_eq!(found.mask, expected.mask, "{name}: {points:?}, {grid:?}, {rules:?}");
                    if found.mask != 0 {
                        assert_eq!(found, expected, "{name}: {points:?}, {grid:?}, {rules:?}");
                    }
                }
            }
            Ok(())
        })
        .budget_ms(600);
        assert!(
            known > 5000 && covered > 1000 && left > 1000,
            "of {known} known {covered} cover a sample, {left} were left"
        );
    }

    /// Around the frame, on a lattice full of ties, or something hostile.
    fn triangle(u: &mut Unstructured<'_>, size: [i32; 2], grid: SubpixelGrid) -> Result<[DVec2; 3]> {
        let side = f64::from(grid.side());
        let mut at = |end: i32| Ok(f64::from(u.int_in_range(-1..=end * grid.side())?) / side);
        let corner = DVec2::new(at(size[0])?, at(size[1])?);
        let fine = u.ratio(1, 2)?;
        let mut near = || {
            Ok(if fine {
                f64::from(u.int_in_range(0..=50_000)?) / 10_000.0
            } else {
                f64::from(u.int_in_range(0..=9)?) / 2.0
            } / side)
        };
        let mut point = || Ok(corner + DVec2::new(near()?, near()?));
        let mut points = [point()?, point()?, point()?];
        if u.ratio(1, 30)? {
            let hostile = [
                f64::NAN,
                f64::INFINITY,
                f64::NEG_INFINITY,
                1e300,
                -1e300,
                50_000.0,
                -5e9,
            ];
            points[u.choose_index(3)?][u.choose_index(2)?] = *u.choose(&hostile)?;
        }
        Ok(points)
    }
}
