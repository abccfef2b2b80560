//! What outlines enclose in one row of tiles, where samples lie anywhere in their pixels.
//!
//! A row of pixels is swept from left to right. Of pixels that an edge may cross the samples are looked at: an edge
//! winds around a sample between its ends that does not lie left of it, by the integer edge function, exactly as the
//! grid's crossings are rounded. To the right of all it crosses, an edge winds around each of its rows alike. So between
//! edges whole runs of pixels are inside or outside; all rows of lattice points agree, but where an edge ends in between.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, i32x16};

use crate::geometry::FillRule;
use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::coverage::covered::Covered;
use crate::raster::coverage::outline_cache::OutlineCache;
use crate::raster::coverage::polygon::OutlineWithEdges;
use crate::raster::coverage::row_edges::{RowEdge, RowEdges};
use crate::raster::coverage::sample_lanes::{SampleBlock, SampleLanes};
use crate::raster::coverage::shape::{MAX_SPANS, NumberedOutline};
use crate::raster::coverage::windings::RowWindings;
use crate::raster::sampling::mask::SampleMask;
use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::span::{Span, SpanRect, to_index};
use crate::simd;

/// Remembers what outlines enclose in the tile row at work.
#[derive(Debug)]
pub(in crate::raster) struct FreePositionsPolygon {
    /// The pixel columns at work.
    columns: Span,
    found: OutlineCache<Stored>,
    /// Where the runs of each row begin, and one more.
    starts: Vec<usize>,
    runs: Vec<Run>,
    masks: Vec<SampleMask>,
    /// All samples of a pixel.
    all: SampleMask,
    sweep: Sweep,
}

/// What was found for one outline.
#[derive(Clone, Copy, Debug, Default)]
struct Stored {
    rows: Span,
    first: usize,
}

/// Some pixels side by side.
#[derive(Clone, Copy, Debug)]
struct Run {
    pixels: Span,
    enclosed: Enclosed,
}

/// What is enclosed of each pixel of a run.
#[derive(Clone, Copy, Debug)]
enum Enclosed {
    All,
    /// These samples, or all of them.
    Bits(u64),
    /// The mask of that number.
    Mask(u32),
}

/// An outline in one row of pixels, reusing its memory.
#[derive(Debug)]
struct Sweep {
    grid: SubpixelGrid,
    rule: FillRule,
    /// The row, and its pixels that the outline may touch.
    y: i32,
    columns: Span,
    edges: RowEdges,
    /// Those that may cross the pixel at work, by number, and maybe some that lie left of it.
    active: Vec<u32>,
    /// The last pixel that all of those may cross, and the last one that any may.
    last: i32,
    farthest: i32,
    /// How often all others that lie left of the pixel at work wind around each row of lattice points.
    windings: RowWindings,
    /// The same as what changes from row to row, where that is known.
    changes: Vec<(i32, i32)>,
    are_changes_known: bool,
    /// How often each sample of a pixel is wound around, and each row.
    around: Vec<i32>,
    rows: Vec<i32>,
}

/// The samples of pixels: few enough to look at all of them at once, or many.
pub(in crate::raster) enum PixelSamples<'p> {
    Few(&'p mut SampleLanes),
    Many(&'p SamplePositions, &'p mut Vec<Position>),
}

impl FreePositionsPolygon {
    /// For a drawing of `outlines` outlines, in some columns of pixels with `count` samples each.
    pub(in crate::raster) fn new(grid: SubpixelGrid, outlines: usize, columns: Span, count: usize) -> Self {
        Self {
            columns,
            found: OutlineCache::new(outlines),
            starts: Vec::new(),
            runs: Vec::new(),
            masks: Vec::new(),
            all: SampleMask::all(count),
            sweep: Sweep::new(grid),
        }
    }

    /// Makes sure that an outline is known in some rows of pixels.
    pub(in crate::raster) fn find(&mut self, of: NumberedOutline<'_>, mut samples: PixelSamples<'_>, rows: Span) {
        let Self { found, runs, .. } = self;
        if found.go_to(rows, runs.len() > MAX_SPANS / 4) {
            self.starts.clear();
            self.runs.clear();
            self.masks.clear();
        }
        // Where it is found the first time, its runs come last.
        let (first, mut is_new) = (self.starts.len(), false);
        let area = self.area(of.outline.outline.samples, rows);
        self.found.get_or(of.number, || {
            is_new = true;
            Stored { rows: area.y, first }
        });
        if is_new {
            dispatch!(simd::level(), simd => self.scan(simd, of.outline, &mut samples, area));
        }
    }

    /// The pixels that hold any of an outline's samples in some rows of pixels.
    fn area(&self, samples: SpanRect, rows: Span) -> SpanRect {
        let side = self.sweep.grid.side();
        let pixels = |span: Span| Span {
            start: span.start.div_euclid(side),
            end: (span.end - 1).div_euclid(side) + 1,
        };
        SpanRect {
            x: pixels(samples.x).intersection(self.columns),
            y: pixels(samples.y).intersection(rows),
        }
    }

    /// Adds the runs of an outline, row by row.
    #[inline(always)]
    fn scan<S: Simd>(
        &mut self,
        simd: S,
        outline: OutlineWithEdges<'_>,
        samples: &mut PixelSamples<'_>,
        area: SpanRect,
    ) {
        self.sweep.begin(outline, area);
        for y in area.y.start..area.y.end {
            self.starts.push(self.runs.len());
            self.sweep.begin_row(y);
            if let PixelSamples::Few(lanes) = samples {
                lanes.prepare(self.sweep.crossed());
            }
            self.row(simd, samples);
        }
        self.starts.push(self.runs.len());
    }

    /// Calls `visit` with what outline `number`, which must be known, encloses of the pixels `xs` in row `y`.
    pub(in crate::raster) fn each(&self, number: usize, y: i32, xs: Span, mut visit: impl FnMut(Covered)) {
        let Stored { rows, first } = self.found.get(number);
        if y < rows.start || y >= rows.end {
            return;
        }
        let row = first + usize::try_from(y - rows.start).unwrap_or(0);
        let runs = &self.runs[self.starts[row]..self.starts[row + 1]];
        let skipped = runs.partition_point(|run| run.pixels.end <= xs.start);
        for run in runs[skipped..].iter().take_while(|run| run.pixels.start < xs.end) {
            visit(match run.enclosed {
                Enclosed::Bits(bits) if bits != self.all.low() => {
                    Covered::Part(run.pixels.start, SampleMask::of_bits(bits))
                }
                Enclosed::Mask(number) => Covered::Part(run.pixels.start, self.masks[number as usize]),
                Enclosed::All | Enclosed::Bits(_) => Covered::Whole(run.pixels.intersection(xs)),
            });
        }
    }

    /// Adds the runs of the row whose edges were gathered.
    #[inline(always)]
    fn row<S: Simd>(&mut self, simd: S, samples: &mut PixelSamples<'_>) {
        let first_run = self.runs.len();
        let Sweep {
            grid, rule, y, columns, ..
        } = self.sweep;
        self.sweep.windings.begin(grid.side());
        let mut next = 0;
        let mut x = columns.start;
        // Where pixels end that no edge crosses, but whose rows are wound around otherwise, each by its samples.
        let mut uneven_end = x;
        while x < columns.end {
            if self.sweep.active.is_empty()
                && let Some(winding) = self.sweep.windings.even()
            {
                let end = self.sweep.edges.here().get(next).map_or(columns.end, |edge| edge.from);
                let end = end.min(columns.end);
                if x < end {
                    if rule.encloses(winding) {
                        self.push(first_run, Span { start: x, end }, Enclosed::All);
                    }
                    x = end;
                    continue;
                }
                if let PixelSamples::Few(lanes) = samples
                    && let Some(after) = self.edges_alone(simd, lanes, (x, next), winding)
                {
                    (x, next) = after;
                    continue;
                }
            }
            next = self.sweep.go_to(x, next);
            if self.sweep.active.is_empty()
                && self.sweep.windings.even().is_none()
                && let PixelSamples::Few(lanes) = samples
                && x >= uneven_end
            {
                let next_edge = self.sweep.edges.here().get(next);
                uneven_end = next_edge.map_or(columns.end, |edge| edge.from.min(columns.end));
                let columns = Span {
                    start: x,
                    end: uneven_end,
                };
                lanes.prepare(std::iter::once((columns, y)));
            }
            let pixel = Span { start: x, end: x + 1 };
            match samples {
                PixelSamples::Few(lanes) => {
                    lanes.go_to([x, y]);
                    let bits = self.sweep.enclosed_bits(simd, x, lanes);
                    if bits == lanes.all() {
                        self.push(first_run, pixel, Enclosed::All);
                    } else if bits != 0 {
                        self.push(first_run, pixel, Enclosed::Bits(bits));
                    }
                }
                PixelSamples::Many(places, memory) => {
                    let mask = self.sweep.enclosed(x, places.of_pixel([x, y], memory));
                    if mask == self.all {
                        self.push(first_run, pixel, Enclosed::All);
                    } else if !mask.is_empty() {
                        let number = u32::try_from(self.masks.len()).unwrap_or(u32::MAX);
                        self.masks.push(mask);
                        self.push(first_run, pixel, Enclosed::Mask(number));
                    }
                }
            }
            x += 1;
        }
        self.sweep
            .windings
            .forget(self.sweep.edges.here().iter().map(|edge| edge.rows));
    }

    /// Adds the pixels from `x` on that edge number `next` may cross, and the one after it where it reaches into these; the pixel
    /// and the edge that come next. `None` where more edges do.
    #[inline(always)]
    fn edges_alone<S: Simd>(
        &mut self,
        simd: S,
        lanes: &mut SampleLanes,
        at: (i32, usize),
        winding: i32,
    ) -> Option<(i32, usize)> {
        match self.sweep.alone(at.1)? {
            1 => Some(self.few_edges::<S, 1>(simd, lanes, at, winding)),
            _ => Some(self.few_edges::<S, 2>(simd, lanes, at, winding)),
        }
    }

    /// As [`FreePositionsPolygon::edges_alone`] where `N` edges are; all that lies left of them winds around each sample as often
    /// as `winding` says.
    ///
    /// Processors cannot predict what is true of a single pixel, so no branch here depends on it.
    #[inline(always)]
    fn few_edges<S: Simd, const N: usize>(
        &mut self,
        simd: S,
        lanes: &mut SampleLanes,
        (x, next): (i32, usize),
        winding: i32,
    ) -> (i32, usize) {
        let sweep = &mut self.sweep;
        let Some(edges) = sweep.edges.here()[next..].first_chunk::<N>().copied() else {
            return (x, next);
        };
        let farthest = edges.iter().fold(i32::MIN, |farthest, edge| farthest.max(edge.to));
        let end = (farthest + 1).min(sweep.columns.end).max(x);
        let mut kept = self.runs.len();
        self.runs.resize(kept + to_index(end - x), Run::NONE);
        for x in x..end {
            lanes.go_to([x, sweep.y]);
            let mut bits = 0;
            for (first, samples) in lanes.blocks(simd) {
                let mut around = i32x16::splat(simd, winding);
                for edge in &edges {
                    around = wind(simd, (samples, around), edge, (x, sweep.grid.side()));
                }
                bits |= enclosed(simd, sweep.rule, around) << first;
            }
            bits &= lanes.all();
            self.runs[kept] = Run {
                pixels: Span { start: x, end: x + 1 },
                enclosed: Enclosed::Bits(bits),
            };
            kept += usize::from(bits != 0);
        }
        self.runs.truncate(kept);
        let takes_back = N == 2 && edges[0].winding == -edges[1].winding && edges[0].rows == edges[1].rows;
        if !takes_back {
            for edge in &edges {
                sweep.windings.add(edge.rows, edge.winding);
                sweep.are_changes_known = false;
            }
        }
        (end, next + N)
    }

    #[inline]
    fn push(&mut self, first_run: usize, pixels: Span, enclosed: Enclosed) {
        match self.runs[first_run..].last_mut() {
            Some(Run {
                pixels: last,
                enclosed: Enclosed::All,
            }) if matches!(enclosed, Enclosed::All) && last.end == pixels.start => {
                last.end = pixels.end;
            }
            _ => self.runs.push(Run { pixels, enclosed }),
        }
    }
}

impl Run {
    const NONE: Self = Self {
        pixels: Span::EMPTY,
        enclosed: Enclosed::Bits(0),
    };
}

/// How often samples are wound around with one more edge, in the pixel in column `x`, which has `side` rows of lattice points.
#[inline(always)]
fn wind<S: Simd>(
    simd: S,
    (samples, around): (SampleBlock<S>, i32x16<S>),
    edge: &RowEdge,
    (x, side): (i32, i32),
) -> i32x16<S> {
    let number = |number| i32x16::splat(simd, number);
    let mut winds = samples.gains(edge.steps).inside(edge.value_at(x, side));
    let Span { start, end } = edge.rows;
    if end - start != side {
        let rows = samples.rows();
        winds &= rows.simd_ge(number(start)) & rows.simd_lt(number(end));
    }
    winds.select(around + number(edge.winding), around)
}

/// Which samples are enclosed that are wound around so often, as bits.
#[inline(always)]
fn enclosed<S: Simd>(simd: S, rule: FillRule, around: i32x16<S>) -> u64 {
    let number = |number| i32x16::splat(simd, number);
    let counted = match rule {
        FillRule::NonZero => around,
        FillRule::EvenOdd => around & number(1),
    };
    (!counted.simd_eq(number(0))).to_bitmask()
}

impl Sweep {
    fn new(grid: SubpixelGrid) -> Self {
        Self {
            grid,
            rule: FillRule::NonZero,
            y: 0,
            columns: Span::EMPTY,
            edges: RowEdges::new(grid),
            active: Vec::new(),
            last: i32::MAX,
            farthest: i32::MIN,
            windings: RowWindings::default(),
            changes: Vec::new(),
            are_changes_known: false,
            around: Vec::new(),
            rows: Vec::new(),
        }
    }

    /// Begins with an outline in some pixels.
    #[inline(always)]
    fn begin(&mut self, outline: OutlineWithEdges<'_>, area: SpanRect) {
        (self.rule, self.columns) = (outline.outline.rule, area.x);
        self.edges.begin(outline, area);
    }

    /// Goes to a row of these pixels, one after the other.
    #[inline(always)]
    fn begin_row(&mut self, y: i32) {
        self.y = y;
        self.edges.go_to(y);
        self.active.clear();
        (self.last, self.farthest, self.are_changes_known) = (i32::MAX, i32::MIN, false);
    }

    /// The pixels of the row that edges may cross, from left to right.
    fn crossed(&self) -> impl Iterator<Item = (Span, i32)> {
        let (y, Span { start, end }) = (self.y, self.columns);
        let mut next = start;
        self.edges.here().iter().map(move |edge| {
            let columns = Span {
                start: edge.from.max(next),
                end: (edge.to + 1).min(end),
            };
            next = next.max(columns.end);
            (columns, y)
        })
    }

    /// How many edges from number `next` on reach into each other's pixels, if these are one or two.
    #[inline(always)]
    fn alone(&self, next: usize) -> Option<usize> {
        let edges = &self.edges.here()[next..];
        let first = edges.first()?;
        let is_beyond = |number: usize, reach: i32| edges.get(number).is_none_or(|edge| edge.from > reach);
        if is_beyond(1, first.to) {
            return Some(1);
        }
        is_beyond(2, first.to.max(edges[1].to)).then_some(2)
    }

    /// Finds the edges that may cross a pixel, where `next` is the first edge that none before it reached: those that lie left
    /// of it from now on wind around whole rows. The first edge that this pixel does not reach.
    #[inline(always)]
    fn go_to(&mut self, x: i32, mut next: usize) -> usize {
        /// So few are asked for as long as any may cross the pixel: all answers are exact.
        const FEW: usize = 3;
        while let Some(edge) = self.edges.here().get(next)
            && edge.from <= x
        {
            self.active.push(u32::try_from(next).unwrap_or(u32::MAX));
            (self.last, self.farthest) = (self.last.min(edge.to), self.farthest.max(edge.to));
            next += 1;
        }
        if self.last >= x || self.farthest >= x && self.active.len() <= FEW {
            return next;
        }
        self.leave_behind(x);
        next
    }

    /// Retires the edges that lie left of a pixel: from now on they wind around whole rows.
    fn leave_behind(&mut self, x: i32) {
        (self.last, self.farthest) = (i32::MAX, i32::MIN);
        self.are_changes_known = false;
        let mut kept = 0;
        for i in 0..self.active.len() {
            let number = self.active[i];
            let edge = &self.edges.here()[number as usize];
            if edge.to < x {
                self.windings.add(edge.rows, edge.winding);
                continue;
            }
            (self.last, self.farthest) = (self.last.min(edge.to), self.farthest.max(edge.to));
            self.active[kept] = number;
            kept += 1;
        }
        self.active.truncate(kept);
    }

    /// The samples of the pixel in column `x` that are inside, as bits; `lanes` stand at it.
    #[inline(always)]
    fn enclosed_bits<S: Simd>(&mut self, simd: S, x: i32, lanes: &SampleLanes) -> u64 {
        if !self.are_changes_known {
            self.windings.changes(&mut self.changes);
            self.are_changes_known = true;
        }
        let (side, number) = (self.grid.side(), |number| i32x16::splat(simd, number));
        let edges = self.edges.here();
        let mut bits = 0;
        for (first, samples) in lanes.blocks(simd) {
            let (rows, mut around) = (samples.rows(), number(self.windings.of_first()));
            for (row, change) in &self.changes {
                around = rows.simd_ge(number(*row)).select(around + number(*change), around);
            }
            for active in &self.active {
                around = wind(simd, (samples, around), &edges[*active as usize], (x, side));
            }
            bits |= enclosed(simd, self.rule, around) << first;
        }
        bits & lanes.all()
    }

    /// The samples of the pixel in column `x` that are inside, one after the other.
    fn enclosed(&mut self, x: i32, places: &[Position]) -> SampleMask {
        self.around.clear();
        if let Some(winding) = self.windings.even() {
            self.around.resize(places.len(), winding);
        } else {
            self.windings.of_rows(&mut self.rows);
            let rows = places.iter().map(|place| self.rows[usize::from(place[1])]);
            self.around.extend(rows);
        }
        for number in &self.active {
            let edge = &self.edges.here()[*number as usize];
            let value = edge.value_at(x, self.grid.side());
            let [right, down] = [edge.steps.right, edge.steps.down].map(i64::from);
            let rows = i64::from(edge.rows.start)..i64::from(edge.rows.end);
            for (around, place) in self.around.iter_mut().zip(places) {
                let [column, row] = place.map(i64::from);
                let left_of_sample = value + right * column + down * row >= 0;
                *around += if left_of_sample && rows.contains(&row) {
                    edge.winding
                } else {
                    0
                };
            }
        }
        let mut mask = SampleMask::default();
        mask.set_each(places.len(), |sample| self.rule.encloses(self.around[sample]));
        mask
    }
}
