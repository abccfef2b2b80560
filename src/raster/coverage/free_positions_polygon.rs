//! What outlines enclose in one row of tiles, where samples lie anywhere in their pixels.
//!
//! A row of pixels is swept from left to right. Pixels that an edge may cross are looked at sample by sample: an edge
//! winds around a sample between its ends that does not lie left of it, by the integer edge function, exactly as the
//! grid's crossings are rounded. To the right of all it crosses, an edge winds around each of its rows alike. So between
//! edges whole runs of pixels are inside or outside; all rows of lattice points agree, but where an edge ends in between.

use std::ops::Range;

use crate::geometry::FillRule;
use crate::geometry::edge::edge_value;
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::SampleRate;
use crate::raster::coverage::covered::Covered;
use crate::raster::coverage::edge_bounds::{Line, MARGIN};
use crate::raster::coverage::outline_cache::OutlineCache;
use crate::raster::coverage::polygon::{Outline, OutlineEdge};
use crate::raster::coverage::shape::{MAX_SPANS, OutlineOf};
use crate::raster::coverage::windings::RowWindings;
use crate::raster::sampling::mask::SampleMask;
use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::span::{PixelRect, Span};

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
    windings: RowWindings,
    memory: Vec<Position>,
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

/// Edges of an outline in one row of pixels, reusing its memory.
#[derive(Debug, Default)]
struct Sweep {
    /// The edges, and pixels that each may cross.
    edges: Vec<LocalEdge>,
    crossings: Vec<(i32, u32)>,
    /// Pixels from which on an edge winds around all samples of some rows, those rows, and how.
    passed: Vec<(i32, Span, i32)>,
    /// How often each sample of a pixel is wound around, and each row.
    around: Vec<i32>,
    rows: Vec<i32>,
}

/// An edge and the lattice rows of a pixel that it crosses.
#[derive(Clone, Copy, Debug)]
struct LocalEdge {
    top: GridPoint,
    bottom: GridPoint,
    rows: Span,
    winding: i32,
}

impl FreePositionsPolygon {
    /// For a drawing of `outlines` outlines, in some columns of pixels with `count` samples each.
    pub(in crate::raster) fn new(outlines: usize, columns: Span, count: usize) -> Self {
        Self {
            columns,
            found: OutlineCache::new(outlines),
            starts: Vec::new(),
            runs: Vec::new(),
            masks: Vec::new(),
            all: SampleMask::all(count),
            sweep: Sweep::default(),
            windings: RowWindings::default(),
            memory: Vec::with_capacity(SampleRate::MAX as usize),
        }
    }

    /// Makes sure that an outline is known in some rows of pixels.
    pub(in crate::raster) fn find(&mut self, of: OutlineOf<'_>, places: (SubpixelGrid, &SamplePositions), rows: Span) {
        let Self { found, runs, .. } = self;
        if found.go_to(rows, runs.len() > MAX_SPANS / 4) {
            self.starts.clear();
            self.runs.clear();
            self.masks.clear();
        }
        // Where it is found the first time, its runs come last.
        let (first, mut is_new) = (self.starts.len(), false);
        let area = self.area(&of, places.0, rows);
        self.found.get_or(of.number, || {
            is_new = true;
            Stored { rows: area.y, first }
        });
        if is_new {
            self.scan(of, places, area);
        }
    }

    /// The pixels that an outline may touch in some rows of pixels.
    fn area(&self, of: &OutlineOf<'_>, grid: SubpixelGrid, rows: Span) -> PixelRect {
        let side = grid.side();
        let pixels = |span: Span| Span {
            start: span.start.div_euclid(side),
            end: (span.end - 1).div_euclid(side) + 1,
        };
        PixelRect {
            x: pixels(of.outline.samples.columns).intersection(self.columns),
            y: pixels(of.outline.samples.rows).intersection(rows),
        }
    }

    /// Adds the runs of an outline, row by row.
    fn scan(&mut self, of: OutlineOf<'_>, places: (SubpixelGrid, &SamplePositions), area: PixelRect) {
        for y in area.y.start..area.y.end {
            self.starts.push(self.runs.len());
            self.sweep.gather((of.outline, of.edges), places.0, area.x, y);
            self.row(of.outline.rule, places, area.x, y);
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

    /// Adds the runs of row `y`, whose edges were gathered.
    fn row(&mut self, rule: FillRule, (grid, places): (SubpixelGrid, &SamplePositions), columns: Span, y: i32) {
        let first_run = self.runs.len();
        self.windings.begin(grid.side());
        let (mut crossings, mut passed) = (0, 0);
        let mut x = columns.start;
        while x < columns.end {
            while let Some((from, rows, winding)) = self.sweep.passed.get(passed)
                && *from <= x
            {
                self.windings.add(*rows, *winding);
                passed += 1;
            }
            let here = crossings..crossings + self.sweep.crossings[crossings..].partition_point(|(at, _)| *at <= x);
            crossings = here.end;
            if here.is_empty()
                && let Some(winding) = self.windings.even()
            {
                let next = [
                    self.sweep.passed.get(passed).map(|edge| edge.0),
                    self.sweep.crossings.get(crossings).map(|edge| edge.0),
                ];
                let end = next.into_iter().flatten().fold(columns.end, i32::min);
                if rule.encloses(winding) {
                    self.push(first_run, Span { start: x, end }, None);
                }
                x = end;
                continue;
            }
            let mask = {
                let places = places.of_pixel([x, y], &mut self.memory);
                self.sweep
                    .enclosed((rule, &self.windings), here, (grid, [x, y]), places)
            };
            let pixel = Span { start: x, end: x + 1 };
            if mask == self.all {
                self.push(first_run, pixel, None);
            } else if !mask.is_empty() {
                self.push(first_run, pixel, Some(mask));
            }
            x += 1;
        }
        self.windings
            .forget(self.sweep.passed[..passed].iter().map(|(_, rows, _)| *rows));
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
    /// Finds where the edges of an outline lie in row `y` of pixels, of which only `columns` count.
    fn gather(&mut self, (outline, all): (&Outline, &[OutlineEdge]), grid: SubpixelGrid, columns: Span, y: i32) {
        self.edges.clear();
        self.crossings.clear();
        self.passed.clear();
        let (top, width) = (y * grid.side(), grid.units_per_pixel());
        let rows = Span {
            start: top,
            end: top + grid.side(),
        };
        for (edge, inside) in outline.edges_in(all, rows) {
            let line = Line::new(edge.top, edge.bottom);
            let at = |row| line.at(f64::from(grid.sample_coordinate(row)));
            let (first, last) = (at(inside.start), at(inside.end - 1));
            let from = pixel((first.min(last) - MARGIN) / width, columns);
            let to = pixel((first.max(last) + MARGIN) / width, columns);
            let rows = Span {
                start: inside.start - top,
                end: inside.end - top,
            };
            let number = u32::try_from(self.edges.len()).unwrap_or(u32::MAX);
            self.edges.push(LocalEdge {
                top: edge.top,
                bottom: edge.bottom,
                rows,
                winding: edge.winding,
            });
            let crossed = from.max(columns.start)..(to + 1).min(columns.end);
            self.crossings.extend(crossed.map(|x| (x, number)));
            self.passed.push((to + 1, rows, edge.winding));
        }
        self.crossings.sort_unstable_by_key(|(x, _)| *x);
        self.passed.sort_unstable_by_key(|(x, ..)| *x);
    }

    /// The samples of a pixel that are inside, where the edges `here` may cross it.
    fn enclosed(
        &mut self,
        (rule, windings): (FillRule, &RowWindings),
        here: Range<usize>,
        (grid, pixel): (SubpixelGrid, [i32; 2]),
        places: &[Position],
    ) -> SampleMask {
        self.around.clear();
        if let Some(winding) = windings.even() {
            self.around.resize(places.len(), winding);
        } else {
            windings.of_rows(&mut self.rows);
            let rows = places.iter().map(|place| self.rows[usize::from(place[1])]);
            self.around.extend(rows);
        }
        let [x, y] = pixel.map(|pixel| grid.sample_coordinate(pixel * grid.side()));
        for (_, number) in &self.crossings[here] {
            let edge = &self.edges[*number as usize];
            let value = edge_value(edge.top, edge.bottom, GridPoint { x, y });
            let [dx, dy] = [edge.bottom.x - edge.top.x, edge.bottom.y - edge.top.y];
            let [right, down] = [-i64::from(dy), i64::from(dx)].map(|step| step << grid.bits());
            // Downwards, the right of the edge on the screen is where the edge function is negative.
            let winding = |[column, row]: [i64; 2]| {
                let left_of_sample = value + right * column + down * row <= 0;
                if left_of_sample { edge.winding } else { 0 }
            };
            let samples = self.around.iter_mut().zip(places);
            let samples = samples.map(|(around, place)| (around, place.map(i64::from)));
            if edge.rows.end - edge.rows.start == grid.side() {
                samples.for_each(|(around, place)| *around += winding(place));
            } else {
                let rows = i64::from(edge.rows.start)..i64::from(edge.rows.end);
                let in_rows = samples.filter(|(_, place)| rows.contains(&place[1]));
                in_rows.for_each(|(around, place)| *around += winding(place));
            }
        }
        // Of a winding number all bits count, or the lowest.
        let counted = match rule {
            FillRule::NonZero => -1,
            FillRule::EvenOdd => 1,
        };
        let mut mask = SampleMask::default();
        mask.set_each(places.len(), |sample| self.around[sample] & counted != 0);
        mask
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
