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
use crate::geometry::edge::edge_value;
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::coverage::covered::Covered;
use crate::raster::coverage::edge_bounds::{Line, MARGIN};
use crate::raster::coverage::outline_cache::OutlineCache;
use crate::raster::coverage::polygon::OutlineWithEdges;
use crate::raster::coverage::sample_lanes::{EdgeSteps, SampleLanes};
use crate::raster::coverage::shape::{MAX_SPANS, NumberedOutline};
use crate::raster::coverage::windings::RowWindings;
use crate::raster::sampling::mask::SampleMask;
use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::span::{Span, SpanRect};
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
    /// The mask of a pixel that is enclosed in part.
    mask: Option<u32>,
}

/// An outline in one row of pixels, reusing its memory.
#[derive(Debug)]
struct Sweep {
    grid: SubpixelGrid,
    rule: FillRule,
    /// The row, and its pixels that the outline may touch.
    y: i32,
    columns: Span,
    /// By the first pixel that each may cross.
    edges: Vec<LocalEdge>,
    /// Those that may cross the pixel at work, by number.
    active: Vec<u32>,
    /// The last pixel that all of those may cross.
    last: i32,
    /// How often those edges wind around each row of lattice points that lie left of the pixel at work as a whole.
    windings: RowWindings,
    /// The same as what changes from row to row, where that is known.
    changes: Vec<(i32, i32)>,
    are_changes_known: bool,
    /// How often each sample of a pixel is wound around, and each row.
    around: Vec<i32>,
    rows: Vec<i32>,
}

/// An edge, the lattice rows of a pixel that it crosses, and the pixels that it may cross.
#[derive(Clone, Copy, Debug)]
struct LocalEdge {
    /// The edge function at the first point of the row's pixel in column 0, and its steps: not below zero where the edge does not
    /// lie right of a sample.
    value: i64,
    steps: EdgeSteps,
    rows: Span,
    winding: i32,
    from: i32,
    to: i32,
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
        for y in area.y.start..area.y.end {
            self.starts.push(self.runs.len());
            self.sweep.gather(outline, area.x, y);
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
            visit(match run.mask {
                None => Covered::Whole(run.pixels.intersection(xs)),
                Some(mask) => Covered::Part(run.pixels.start, self.masks[mask as usize]),
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
            next = self.sweep.go_to(x, next);
            if self.sweep.active.is_empty() {
                let next_edge = self.sweep.edges.get(next);
                let end = next_edge.map_or(columns.end, |edge| edge.from.min(columns.end));
                if let Some(winding) = self.sweep.windings.even() {
                    if rule.encloses(winding) {
                        self.push(first_run, Span { start: x, end }, None);
                    }
                    x = end;
                    continue;
                }
                if let PixelSamples::Few(lanes) = samples
                    && x >= uneven_end
                {
                    lanes.prepare((x..end).map(|x| [x, y]));
                    uneven_end = end;
                }
            }
            let pixel = Span { start: x, end: x + 1 };
            match samples {
                PixelSamples::Few(lanes) => {
                    lanes.go_to([x, y]);
                    let bits = self.sweep.enclosed_bits(simd, x, lanes);
                    if bits == lanes.all() {
                        self.push(first_run, pixel, None);
                    } else if bits != 0 {
                        self.push(first_run, pixel, Some(SampleMask::of_bits(bits)));
                    }
                }
                PixelSamples::Many(places, memory) => {
                    let mask = self.sweep.enclosed(x, places.of_pixel([x, y], memory));
                    if mask == self.all {
                        self.push(first_run, pixel, None);
                    } else if !mask.is_empty() {
                        self.push(first_run, pixel, Some(mask));
                    }
                }
            }
            x += 1;
        }
        self.sweep
            .windings
            .forget(self.sweep.edges.iter().map(|edge| edge.rows));
    }

    #[inline]
    fn push(&mut self, first_run: usize, pixels: Span, mask: Option<SampleMask>) {
        let mask = mask.map(|mask| {
            self.masks.push(mask);
            u32::try_from(self.masks.len() - 1).unwrap_or(u32::MAX)
        });
        match self.runs[first_run..].last_mut() {
            Some(last) if mask.is_none() && last.mask.is_none() && last.pixels.end == pixels.start => {
                last.pixels.end = pixels.end;
            }
            _ => self.runs.push(Run { pixels, mask }),
        }
    }
}

impl Sweep {
    fn new(grid: SubpixelGrid) -> Self {
        Self {
            grid,
            rule: FillRule::NonZero,
            y: 0,
            columns: Span::EMPTY,
            edges: Vec::new(),
            active: Vec::new(),
            last: i32::MAX,
            windings: RowWindings::default(),
            changes: Vec::new(),
            are_changes_known: false,
            around: Vec::new(),
            rows: Vec::new(),
        }
    }

    /// Finds where the edges of an outline lie in row `y` of pixels, of which only `columns` count.
    #[inline(always)]
    fn gather(&mut self, outline: OutlineWithEdges<'_>, columns: Span, y: i32) {
        let grid = self.grid;
        (self.rule, self.columns, self.y) = (outline.outline.rule, columns, y);
        self.edges.clear();
        self.active.clear();
        (self.last, self.are_changes_known) = (i32::MAX, false);
        let first_point = self.first_point(0);
        let (top, width) = (y * grid.side(), grid.units_per_pixel());
        let rows = Span {
            start: top,
            end: top + grid.side(),
        };
        for (edge, inside) in outline.edges_in(rows) {
            let line = Line::new(edge.top, edge.bottom);
            let at = |row| line.at(f64::from(grid.sample_coordinate(row)));
            let (first, last) = (at(inside.start), at(inside.end - 1));
            self.edges.push(LocalEdge {
                // What the function gains from sample to sample are multiples of their distance: divided by that, and rounded
                // down, the side does not change. Downwards, the right of the edge on the screen is where it is negative.
                value: -edge_value(edge.top, edge.bottom, first_point) >> grid.bits(),
                steps: EdgeSteps::new(edge.bottom.y - edge.top.y, edge.top.x - edge.bottom.x),
                rows: Span {
                    start: inside.start - top,
                    end: inside.end - top,
                },
                winding: edge.winding,
                from: pixel((first.min(last) - MARGIN) / width, columns),
                to: pixel((first.max(last) + MARGIN) / width, columns),
            });
        }
        self.edges.sort_unstable_by_key(|edge| edge.from);
    }

    /// The pixels of the row that edges may cross, from left to right.
    fn crossed(&self) -> impl Iterator<Item = [i32; 2]> {
        let (y, Span { start, end }) = (self.y, self.columns);
        let mut next = start;
        self.edges.iter().flat_map(move |edge| {
            let xs = edge.from.max(next)..(edge.to + 1).min(end);
            next = next.max(xs.end);
            xs.map(move |x| [x, y])
        })
    }

    /// Finds the edges that may cross a pixel, where `next` is the first edge that none before it reached: those that lie left
    /// of it from now on wind around whole rows. The first edge that this pixel does not reach.
    #[inline(always)]
    fn go_to(&mut self, x: i32, mut next: usize) -> usize {
        while let Some(edge) = self.edges.get(next)
            && edge.from <= x
        {
            self.active.push(u32::try_from(next).unwrap_or(u32::MAX));
            self.last = self.last.min(edge.to);
            next += 1;
        }
        if self.last >= x {
            return next;
        }
        self.last = i32::MAX;
        self.are_changes_known = false;
        let Self {
            edges, windings, last, ..
        } = self;
        self.active.retain(|number| {
            let edge = &edges[*number as usize];
            let is_here = edge.to >= x;
            if is_here {
                *last = edge.to.min(*last);
            } else {
                windings.add(edge.rows, edge.winding);
            }
            is_here
        });
        next
    }

    /// The first lattice point of the pixel in column `x`.
    #[inline(always)]
    fn first_point(&self, x: i32) -> GridPoint {
        let first = |pixel: i32| self.grid.sample_coordinate(pixel * self.grid.side());
        GridPoint {
            x: first(x),
            y: first(self.y),
        }
    }

    /// The samples of the pixel in column `x` that are inside, as bits; `lanes` stand at it.
    #[inline(always)]
    fn enclosed_bits<S: Simd>(&mut self, simd: S, x: i32, lanes: &SampleLanes) -> u64 {
        if !self.are_changes_known {
            self.windings.changes(&mut self.changes);
            self.are_changes_known = true;
        }
        let (side, number) = (self.grid.side(), |number| i32x16::splat(simd, number));
        let mut bits = 0;
        for (first, samples) in lanes.blocks(simd) {
            let (rows, mut around) = (samples.rows(), number(self.windings.of_first()));
            for (row, change) in &self.changes {
                around = rows.simd_ge(number(*row)).select(around + number(*change), around);
            }
            for active in &self.active {
                let edge = &self.edges[*active as usize];
                let mut winds = samples.gains(edge.steps).inside(edge.value_at(x, side));
                let Span { start, end } = edge.rows;
                if end - start != side {
                    winds &= rows.simd_ge(number(start)) & rows.simd_lt(number(end));
                }
                around = winds.select(around + number(edge.winding), around);
            }
            let counted = match self.rule {
                FillRule::NonZero => around,
                FillRule::EvenOdd => around & number(1),
            };
            bits |= (!counted.simd_eq(number(0))).to_bitmask() << first;
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
            let edge = &self.edges[*number as usize];
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

impl LocalEdge {
    /// The edge function at the first point of the row's pixel in column `x`, where pixels have so many columns.
    #[inline(always)]
    fn value_at(&self, x: i32, side: i32) -> i64 {
        self.value + i64::from(self.steps.right) * i64::from(x) * i64::from(side)
    }
}

/// The pixel that holds a column; just before the first of `columns` or just after the last at most.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "clamped to the pixels of a frame")]
fn pixel(column: f64, columns: Span) -> i32 {
    let pixel = column.clamp(f64::from(columns.start) - 1.0, f64::from(columns.end));
    // Rounded down: `floor` is not a single instruction on every machine.
    (pixel + 1.0) as i32 - 1
}
