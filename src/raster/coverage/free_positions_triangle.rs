//! What a triangle covers in one tile where samples lie anywhere in their pixels.
//!
//! Of each row of pixels the edges bound what the triangle touches and what it covers for certain, many rows at once. Pixels in
//! between are noted together with the values of the edges there; then their samples are asked, all of a pixel at once by
//! [`SampleLanes`]. Where there are too many of them, or no edge crosses the pixel, its corners decide first.
//!
//! ```text
//!     touched   inside    touched
//!    |- - - - |=========|- - - - -|     one row: `before`, `inside`, `after`
//! ```

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, u64x8};

use crate::geometry::edge::{SampleEdge, doubled_area};
use crate::geometry::subpixel::{GridPoint, SubpixelGrid, WHOLE};
use crate::raster::coverage::edge_bounds::{Line, MARGIN, TileRows};
use crate::raster::coverage::sample_lanes::{EdgeGains, EdgeSteps, SampleBlock, SampleLanes};
use crate::raster::sampling::positions::Position;
use crate::raster::span::{Span, SpanRect};
use crate::rules::Rules;

/// A triangle and the pixels of a tile that it may touch.
#[derive(Debug)]
pub(super) struct TriangleScan {
    grid: SubpixelGrid,
    edges: [LatticeEdge; 3],
    /// What bounds the columns of rows of pixels; `None` where there are so few columns that looking at each pixel costs less.
    lines: Option<TileRows>,
    columns: Span,
    pub(super) rows: Span,
    /// Rows of samples between the highest and the lowest corner.
    sample_rows: Span,
}

/// Pixels side by side of which the same samples are covered.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FoundRun {
    pub(super) y: i32,
    pub(super) xs: Span,
    /// A bit for each sample.
    pub(super) bits: u64,
}

/// The pixels of one row that are to be looked at one by one, and those between them that are covered for certain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct RowParts {
    pub(super) before: Span,
    pub(super) inside: Span,
    pub(super) after: Span,
}

/// What is found in a tile, reusing its memory.
#[derive(Debug, Default)]
pub(super) struct FoundPixels {
    pub(super) parts: Vec<RowParts>,
    runs: Vec<FoundRun>,
    /// The values of the edges at each of these; those that keep nothing out where it is covered for certain.
    values: Vec<[i64; 3]>,
    /// How many of these were found; others are left over.
    count: usize,
    /// Which of them are to be looked at, and how many these are, where that was asked for.
    open: Vec<usize>,
    open_count: usize,
}

/// Rows that are bounded together.
const ROWS: usize = 8;

/// A [`SampleEdge`], whose samples are all points of the lattice.
#[derive(Clone, Copy, Debug)]
struct LatticeEdge {
    /// At the first point of the frame's first pixel.
    value: i64,
    steps: EdgeSteps,
    /// What it gains from a pixel to the one on its right.
    right_pixel: i64,
    /// What it gains from a pixel's first point to the point where it is least and greatest.
    least: i64,
    most: i64,
}

/// How much of a pixel a triangle covers by the values of its edges at the corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PixelReach {
    Nothing,
    All,
    /// The values of the edges at the pixel's first point; those that do not cross the pixel have one that keeps nothing out.
    Part([i64; 3]),
}

/// The value of an edge that keeps nothing out.
const INSIDE: i64 = i64::MAX / 2;

impl TriangleScan {
    /// Prepares a triangle; `None` where it touches nothing of the tile `rect`.
    pub(super) fn new(corners: [GridPoint; 3], rect: SpanRect, grid: SubpixelGrid, rules: Rules) -> Option<Self> {
        let area = doubled_area(corners);
        if area == 0 {
            return None;
        }
        let side = grid.side();
        let samples = SpanRect::of_samples(corners, grid, rules);
        if samples.is_empty() {
            return None;
        }
        let pixels = |span: Span, within: Span| {
            Span {
                start: span.start.div_euclid(side),
                end: (span.end - 1).div_euclid(side) + 1,
            }
            .intersection(within)
        };
        let (columns, rows) = (pixels(samples.x, rect.x), pixels(samples.y, rect.y));
        if columns.is_empty() || rows.is_empty() {
            return None;
        }
        let first = grid.sample_coordinate(0);
        let first = GridPoint { x: first, y: first };
        let edges = SampleEdge::of_triangle(corners, area, first, grid, rules);
        Some(Self {
            grid,
            edges: edges.map(|edge| LatticeEdge::new(edge, side)),
            lines: (columns.end - columns.start > 2).then(|| TileRows::new(corners)),
            columns,
            rows,
            sample_rows: samples.y,
        })
    }

    /// Finds the parts of all rows, from the first to the last.
    #[inline(always)]
    pub(super) fn find_parts<S: Simd>(&self, simd: S, parts: &mut Vec<RowParts>) {
        parts.clear();
        let rows = usize::try_from(self.rows.end - self.rows.start).unwrap_or(0);
        parts.resize(
            rows,
            RowParts {
                before: self.columns,
                ..RowParts::default()
            },
        );
        let Some(lines) = &self.lines else {
            return;
        };
        for (y, parts) in (self.rows.start..).step_by(ROWS).zip(parts.chunks_mut(ROWS)) {
            let [touched, covered] = self.rows_from(simd, lines, y);
            for (i, parts) in parts.iter_mut().enumerate() {
                let span = |[start, end]: &[[i32; ROWS]; 2]| Span {
                    start: start[i],
                    end: end[i],
                };
                *parts = RowParts::new(span(&touched), span(&covered));
            }
        }
    }

    /// The first pixels and the ends of what it may touch in [`ROWS`] rows from `y` on, and of what it covers for certain.
    #[inline(always)]
    fn rows_from<S: Simd>(&self, simd: S, lines: &TileRows, y: i32) -> [[[i32; ROWS]; 2]; 2] {
        const NUMBERS: [f64; ROWS] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
        let number = |value: f64| f64x8::splat(simd, value);
        let side = f64::from(self.grid.side());
        let [least_row, end_row] = [self.sample_rows.start, self.sample_rows.end].map(f64::from);
        let top = (f64x8::simd_from(simd, NUMBERS) + f64::from(y)) * side;
        let rows = [top.max(number(least_row)), (top + side).min(number(end_row)) - 1.0];
        let is_whole = top.simd_ge(number(least_row)) & (top + side).simd_le(number(end_row));
        // Samples lie in the middle between two lines of their own grid.
        let unit = f64::from(1 << self.grid.bits());
        let coordinates = [(rows[0] + 0.5) * unit, (rows[1] + 0.5) * unit];
        let left = [ends_of(lines.left[0], coordinates), ends_of(lines.left[1], coordinates)];
        let right = [
            ends_of(lines.right[0], coordinates),
            ends_of(lines.right[1], coordinates),
        ];
        let (least, most) = (f64::from(self.columns.start), f64::from(self.columns.end));
        let column = Column {
            per_unit: 1.0 / self.grid.units_per_pixel(),
            ends: [number(least), number(most)],
        };
        let touched = [
            left[0][0].max(left[1][0]) - MARGIN,
            right[0][1].min(right[1][1]) + MARGIN,
        ];
        let covered = [
            left[0][1].max(left[1][1]) + MARGIN,
            right[0][0].min(right[1][0]) - MARGIN,
        ];
        // Half a pixel less than a number and it is rounded down, half a pixel more and it is rounded up. Where it is whole it may be
        // rounded to the next one: then one pixel more is looked at.
        let first = nearest((column.at(touched[0]) - 0.5).max(column.ends[0]));
        let after = nearest((column.at(touched[1]) + 0.5).min(column.ends[1]));
        let (start, end) = (
            nearest(column.at(covered[0]) + 0.5),
            nearest(column.at(covered[1]) - 0.5),
        );
        let is_inside = is_whole & start.simd_lt(end);
        let end = is_inside.select(end, start);
        [[whole(first), whole(after)], [whole(start), whole(end)]]
    }

    /// The values of its edges at a pixel's first point.
    #[inline(always)]
    pub(super) fn values(&self, x: i32, y: i32) -> [i64; 3] {
        let side = i64::from(self.grid.side());
        let (column, row) = (i64::from(x) * side, i64::from(y) * side);
        self.edges.map(|LatticeEdge { value, steps, .. }| {
            value + i64::from(steps.right) * column + i64::from(steps.down) * row
        })
    }

    /// What its edges say of a pixel by their [`TriangleScan::values`] there.
    #[inline(always)]
    pub(super) fn reach(&self, here: [i64; 3]) -> PixelReach {
        let (mut values, mut crossed) = ([INSIDE; 3], false);
        for ((value, here), LatticeEdge { least, most, .. }) in values.iter_mut().zip(here).zip(&self.edges) {
            if here + most < 0 {
                return PixelReach::Nothing;
            }
            if here + least < 0 {
                *value = here;
                crossed = true;
            }
        }
        if crossed {
            PixelReach::Part(values)
        } else {
            PixelReach::All
        }
    }

    /// What each edge gains from a pixel's first point to another.
    #[inline]
    pub(super) fn gains(&self, [column, row]: Position) -> [i64; 3] {
        self.edges.map(|LatticeEdge { steps, .. }| {
            i64::from(steps.right) * i64::from(column) + i64::from(steps.down) * i64::from(row)
        })
    }

    /// Finds all that is covered, row by row.
    #[inline(always)]
    pub(super) fn find<S: Simd>(&self, simd: S, lanes: &mut SampleLanes, found: &mut FoundPixels) {
        let mut parts = std::mem::take(&mut found.parts);
        self.find_parts(simd, &mut parts);
        found.begin(self.columns, self.rows);
        if lanes.are_same() {
            self.note_rows::<false>(&parts, lanes.all(), found);
        } else {
            self.note_rows::<true>(&parts, lanes.all(), found);
        }
        found.parts = parts;
        let (runs, values) = (&mut found.runs[..found.count], &found.values[..found.count]);
        if lanes.are_same() {
            for (first, samples) in lanes.blocks(simd) {
                let gains = self.gains_of(samples);
                for (run, values) in runs.iter_mut().zip(values) {
                    run.bits |= inside_all(gains, *values) << first & lanes.all();
                }
            }
            return;
        }
        let open = &found.open[..found.open_count];
        lanes.prepare(open.iter().map(|i| (runs[*i].xs, runs[*i].y)));
        for i in open {
            let (run, values) = (&mut runs[*i], values[*i]);
            lanes.go_to([run.xs.start, run.y]);
            for (first, samples) in lanes.blocks(simd) {
                run.bits |= inside_all(self.gains_of(samples), values) << first & lanes.all();
            }
        }
    }

    /// Notes the pixels of all rows that it may touch; those that are covered for certain have `all` samples. Which are to be looked
    /// at is noted where they are `OPEN`.
    #[inline(never)]
    fn note_rows<const OPEN: bool>(&self, parts: &[RowParts], all: u64, found: &mut FoundPixels) {
        for (y, RowParts { before, inside, after }) in (self.rows.start..).zip(parts) {
            self.note::<OPEN>(*before, y, found);
            if !inside.is_empty() {
                let (xs, bits) = (*inside, all);
                found.put(FoundRun { y, xs, bits }, [INSIDE; 3]);
                found.count += 1;
            }
            self.note::<OPEN>(*after, y, found);
        }
    }

    /// What each edge gains from a pixel's first point to some of its samples.
    #[inline(always)]
    fn gains_of<S: Simd>(&self, samples: SampleBlock<S>) -> [EdgeGains<S>; 3] {
        // The closure of a `map` would not be inlined.
        let [a, b, c] = &self.edges;
        [samples.gains(a.steps), samples.gains(b.steps), samples.gains(c.steps)]
    }

    /// Notes the pixels of a row that it may touch, with the values of the edges there.
    #[inline(always)]
    fn note<const OPEN: bool>(&self, xs: Span, y: i32, found: &mut FoundPixels) {
        if xs.is_empty() {
            // An empty span may start anywhere, where no edge has a value.
            return;
        }
        let mut values = self.values(xs.start, y);
        for x in xs.start..xs.end {
            let xs = Span { start: x, end: x + 1 };
            // Noted first and kept where it may be touched: a branch here would be taken by chance.
            found.put(FoundRun { y, xs, bits: 0 }, values);
            let mut farthest = 0;
            for (value, edge) in values.iter_mut().zip(&self.edges) {
                farthest |= *value + edge.most;
                *value += edge.right_pixel;
            }
            let is_open = usize::from(farthest >= 0);
            if OPEN {
                found.open[found.open_count] = found.count;
                found.open_count += is_open;
            }
            found.count += is_open;
        }
    }
}

impl FoundPixels {
    /// What was found, some of it without any samples.
    pub(super) fn runs(&self) -> &[FoundRun] {
        &self.runs[..self.count]
    }

    /// Makes room for so many pixels, and one more.
    fn begin(&mut self, columns: Span, rows: Span) {
        let most = (columns.end - columns.start) * (rows.end - rows.start);
        let most = usize::try_from(most).unwrap_or(0) + 1;
        if self.runs.len() < most {
            self.runs.resize(most, FoundRun::default());
            self.values.resize(most, [0; 3]);
            self.open.resize(most, 0);
        }
        (self.count, self.open_count) = (0, 0);
    }

    /// Writes a run that counts once it is counted.
    #[inline(always)]
    fn put(&mut self, run: FoundRun, values: [i64; 3]) {
        self.runs[self.count] = run;
        self.values[self.count] = values;
    }
}

/// Makes columns of pixels of columns of the sub-pixel grid.
#[derive(Clone, Copy)]
struct Column<S: Simd> {
    per_unit: f64,
    /// The least and the greatest.
    ends: [f64x8<S>; 2],
}

impl<S: Simd> Column<S> {
    #[inline(always)]
    fn at(&self, units: f64x8<S>) -> f64x8<S> {
        (units * self.per_unit).max(self.ends[0]).min(self.ends[1])
    }
}

/// What a line's columns lie between from one coordinate to another.
#[inline(always)]
fn ends_of<S: Simd>(line: Line, coordinates: [f64x8<S>; 2]) -> [f64x8<S>; 2] {
    let [first, last] = coordinates;
    let (a, b) = (
        (first - line.y) * line.slope + line.x,
        (last - line.y) * line.slope + line.x,
    );
    [a.min(b), a.max(b)]
}

/// The nearest whole numbers, so much more that they stand in the lower bits: far quicker than what rounds down or up where
/// there is no instruction for it.
#[inline(always)]
fn nearest<S: Simd>(values: f64x8<S>) -> f64x8<S> {
    values + WHOLE
}

/// What stands in the lower bits of [`nearest`] ones.
#[inline(always)]
fn whole<S: Simd>(values: f64x8<S>) -> [i32; ROWS] {
    let bits: u64x8<S> = values.bitcast();
    let (bits, mut numbers) = (bits.to_array(), [0; ROWS]);
    for (number, bits) in numbers.iter_mut().zip(bits) {
        *number = low_half(bits);
    }
    numbers
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the lower half is meant")]
fn low_half(bits: u64) -> i32 {
    bits as i32
}

/// The samples that lie on the inner side of each edge, by the edges' values at their pixel's first point.
#[inline(always)]
fn inside_all<S: Simd>([a, b, c]: [EdgeGains<S>; 3], values: [i64; 3]) -> u64 {
    (a.inside(values[0]) & b.inside(values[1]) & c.inside(values[2])).to_bitmask()
}

impl RowParts {
    /// Of a row of which so much may be touched, and so much of it is covered.
    #[inline(always)]
    fn new(touched: Span, inside: Span) -> Self {
        if inside.is_empty() {
            return Self {
                before: touched,
                inside: Span::EMPTY,
                after: Span::EMPTY,
            };
        }
        Self {
            before: Span {
                start: touched.start,
                end: inside.start,
            },
            inside,
            after: Span {
                start: inside.end,
                end: touched.end,
            },
        }
    }
}

impl LatticeEdge {
    fn new(edge: SampleEdge, side: i32) -> Self {
        let SampleEdge { value, right, down } = edge;
        let last = i64::from(side - 1);
        let (all_right, all_down) = (i64::from(right) * last, i64::from(down) * last);
        Self {
            value,
            steps: EdgeSteps::new(right, down),
            right_pixel: i64::from(right) * i64::from(side),
            least: all_right.min(0) + all_down.min(0),
            most: all_right.max(0) + all_down.max(0),
        }
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};
    use fearless_simd::dispatch;
    use glam::DVec2;

    use super::*;
    use crate::raster::sampling::positions::SamplePositions;
    use crate::raster::{SamplePattern, SampleRate, Seed};
    use crate::simd;

    /// Around a tile: on a lattice full of ties, anywhere, or as far away as triangles reach.
    fn triangle(u: &mut Unstructured<'_>, rect: SpanRect) -> Result<[DVec2; 3]> {
        let kind = u.int_in_range(0..=9)?;
        let mut at = |span: Span| -> Result<f64> {
            Ok(match kind {
                0 => f64::from(u.int_in_range(-24_576..=40_960)?),
                1..=5 => f64::from(u.int_in_range((span.start - 4) * 2..=(span.end + 4) * 2)?) / 2.0,
                _ => f64::from(u.int_in_range((span.start - 4) * 1000..=(span.end + 4) * 1000)?) / 1000.0,
            })
        };
        let mut point = || -> Result<DVec2> { Ok(DVec2::new(at(rect.x)?, at(rect.y)?)) };
        Ok([point()?, point()?, point()?])
    }

    #[test]
    fn triangles_are_covered_as_one_by_one_on_every_level() {
        let grid = SubpixelGrid::fine();
        let (mut parts, mut wholes, mut inside) = (0_u32, 0_u32, 0_u32);
        arbtest::arbtest(|u| {
            let rules = *u.choose(&Rules::ALL)?;
            let pattern = *u.choose(&SamplePattern::ALL)?;
            let rates: &[u32] = if pattern.needs_square() {
                &[1, 4, 16, 64]
            } else {
                &[1, 3, 16, 33, 64]
            };
            let rate = SampleRate::new(*u.choose(rates)?).expect("a rate");
            let positions = SamplePositions::new(pattern, rate, Seed::default());
            let mut lanes = SampleLanes::new(positions.clone()).expect("few samples");
            let mut side = || -> Result<Span> {
                let start = u.int_in_range(0..=300)?;
                let end = start + u.int_in_range(1..=32)?;
                Ok(Span { start, end })
            };
            let rect = SpanRect { x: side()?, y: side()? };
            let points = triangle(u, rect)?;
            let Some(scan) = TriangleScan::new(points.map(|point| grid.snap(point)), rect, grid, rules) else {
                return Ok(());
            };
            let mut expected = Vec::new();
            for y in rect.y.start..rect.y.end {
                for x in rect.x.start..rect.x.end {
                    let (here, mut memory) = (scan.values(x, y), Vec::new());
                    let places = positions.of_pixel([x, y], &mut memory);
                    let is_inside = |place: &Position| {
                        let gains = scan.gains(*place);
                        here.iter().zip(gains).all(|(here, gain)| here + gain >= 0)
                    };
                    let bits = places.iter().map(is_inside).map(u64::from);
                    expected.push((0..).zip(bits).map(|(sample, bit)| bit << sample).sum::<u64>());
                }
            }
            for (name, level) in simd::tested() {
                let mut found = FoundPixels::default();
                dispatch!(level, simd => scan.find(simd, &mut lanes, &mut found));
                let mut masks = vec![0; expected.len()];
                for FoundRun { y, xs, bits } in found.runs() {
                    inside += u32::from(xs.end - xs.start > 1);
                    for x in xs.start..xs.end {
                        let at = (y - rect.y.start) * (rect.x.end - rect.x.start) + x - rect.x.start;
                        let mask: &mut u64 = &mut masks[usize::try_from(at).expect("in the tile")];
                        assert_eq!(*mask, 0, "{name}: pixel {x}, {y} comes once");
                        *mask = *bits;
                    }
                }
                assert_eq!(masks, expected, "{name}: {points:?}, {rect:?}, {pattern:?}, {rules:?}");
                wholes += u32::from(masks.contains(&lanes.all()));
                parts += u32::from(masks.iter().any(|bits| ![0, lanes.all()].contains(bits)));
            }
            Ok(())
        })
        .budget_ms(800);
        assert!(
            parts > 200 && wholes > 100 && inside > 100,
            "{parts} tiles with parts of pixels, {wholes} with whole ones, {inside} spans known to be whole"
        );
    }
}
