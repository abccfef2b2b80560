//! Painting one tile: every op of the display list that touches it, in painter's order.

use super::SampleHit;
use super::display_list::Chunk;
use super::entry::{Entry, Work};
use super::rows::{SortedTriangle, Span};
use super::shade::{ShadeContext, Shader, ShaderKind};
use super::small::{SmallCoverage, small_coverage};
use super::tile::{PixelRect, Tile};
use crate::color::Premultiplied16;
use crate::geometry::subpixel::GridPoint;

/// Most samples along one side of a pixel.
const MAX_SIDE: usize = 16;

/// Paints tiles, one after the other, reusing its memory.
#[derive(Debug)]
pub(crate) struct TilePainter<'a> {
    context: ShadeContext<'a>,
    /// The base and above it the open layers.
    layers: Vec<Tile>,
    /// How many of `layers` are in use.
    depth: usize,
    colors: Vec<Premultiplied16>,
    /// When a pixel is probed: which source painted each sample last.
    probe: Option<Probe>,
}

/// Follows the samples of a single-pixel tile.
#[derive(Debug)]
struct Probe {
    source: u32,
    hits: Vec<Option<u32>>,
}

/// The samples that one row of pixels owns.
struct PixelRow {
    /// Sample columns per sample row.
    spans: [Span; MAX_SIDE],
    /// Sample rows in use.
    side: usize,
    /// Pixels of which any sample is covered, and among them those of which all are; where these are none, they are an
    /// empty span at the end.
    touched: Span,
    full: Span,
}

impl<'a> TilePainter<'a> {
    /// A painter for one drawing.
    pub(crate) fn new(context: ShadeContext<'a>) -> Self {
        Self {
            context,
            layers: Vec::new(),
            depth: 0,
            colors: Vec::new(),
            probe: None,
        }
    }

    /// Starts a tile.
    pub(crate) fn begin(&mut self, rect: PixelRect, background: Premultiplied16) {
        self.depth = 0;
        self.push_layer(rect, background);
    }

    /// Paints the ops of one chunk that touch the tile.
    pub(crate) fn paint(&mut self, chunk: &Chunk, entries: &[Entry]) {
        for entry in entries {
            if let Some(probe) = &mut self.probe {
                probe.source = chunk.sources[entry.op()];
            }
            match entry.work(chunk) {
                Work::Samples(coverage, color) => self.samples(coverage, color),
                Work::Pixels(pixels, color) => {
                    let PixelRect { x, y } = self.layers[0].rect;
                    pixels
                        .moved(x.start, y.start)
                        .each_run(|row, xs| self.fill(xs, row, color));
                }
                Work::Flat(corners, color) => self.triangle(*entry, corners, |_| Shader::flat(color)),
                Work::Shaded(triangle, paint) => {
                    self.triangle(*entry, &triangle.corners, |context| {
                        Shader::new(context, triangle, paint)
                    });
                }
                Work::BeginLayer => self.push_layer(self.layers[0].rect, Premultiplied16::TRANSPARENT),
                Work::EndLayer(opacity) => self.pop_layer(opacity),
            }
        }
    }

    /// Resolves one row of the finished tile.
    pub(crate) fn resolve(&self, y: i32, pixels: &mut [u32]) {
        self.layers[0].resolve(y, pixels);
    }

    /// Paints a tile of a single pixel and says what each of its samples holds.
    pub(crate) fn probe(
        &mut self,
        chunks: &[(&Chunk, &[Entry])],
        pixel: [i32; 2],
        background: Premultiplied16,
    ) -> Vec<SampleHit> {
        let one = |start: i32| Span { start, end: start + 1 };
        let side = self.context.grid.side().cast_unsigned() as usize;
        self.probe = Some(Probe {
            source: 0,
            hits: vec![None; side * side],
        });
        self.begin(
            PixelRect {
                x: one(pixel[0]),
                y: one(pixel[1]),
            },
            background,
        );
        for (chunk, entries) in chunks {
            self.paint(chunk, entries);
        }
        let hits = self.probe.take().map(|probe| probe.hits).unwrap_or_default();
        let place = |index: usize| (index as f64 + 0.5) / side as f64;
        hits.into_iter()
            .enumerate()
            .map(|(i, source)| SampleHit {
                position: [place(i % side), place(i / side)],
                color: self.layers[0].sample(pixel[0], pixel[1], i),
                source,
            })
            .collect()
    }

    fn push_layer(&mut self, rect: PixelRect, color: Premultiplied16) {
        if self.layers.len() == self.depth {
            self.layers
                .push(Tile::new(self.context.grid.side(), self.context.sampling.rules));
        }
        self.layers[self.depth].reset(rect, color);
        self.depth += 1;
    }

    fn pop_layer(&mut self, opacity: u16) {
        if self.depth < 2 {
            return;
        }
        self.depth -= 1;
        let (below, above) = self.layers.split_at_mut(self.depth);
        below[self.depth - 1].composite(&above[0], opacity);
    }

    /// What covers all of the tile.
    fn whole_tile(&mut self, shader: &Shader<'_>) {
        let PixelRect { x, y } = self.layers[0].rect;
        let side = self.context.grid.side();
        let columns = Span {
            start: x.start * side,
            end: x.end * side,
        };
        for row in y.start..y.end {
            if let ShaderKind::Solid(color) = shader.kind {
                self.fill(x, row, color);
            } else {
                if shader.opaque {
                    self.layers[self.depth - 1].split_unfilled(x, row);
                }
                for line in row * side..(row + 1) * side {
                    self.shaded(shader, columns, line);
                }
            }
        }
    }

    /// A triangle, shaded by what `shader` makes once it is needed.
    fn triangle(
        &mut self,
        entry: Entry,
        corners: &[GridPoint; 3],
        shader: impl FnOnce(&ShadeContext<'a>) -> Shader<'a>,
    ) {
        if entry.covers_tile() {
            return self.whole_tile(&shader(&self.context));
        }
        let grid = self.context.grid;
        if let Some(coverage) = small_coverage(*corners, grid, self.context.sampling.rules) {
            if coverage.mask != 0 {
                self.few_samples(&shader(&self.context), coverage);
            }
            return;
        }
        let PixelRect { x, y } = self.layers[0].rect;
        let Some(sorted) = SortedTriangle::new(*corners, self.context.sampling.rules) else {
            return;
        };
        let side = grid.side();
        let columns = Span {
            start: x.start * side,
            end: x.end * side,
        };
        let rows = sorted.rows(grid).intersection(Span {
            start: y.start * side,
            end: y.end * side,
        });
        if rows.is_empty() {
            return;
        }
        let shader = shader(&self.context);
        let mut walker = sorted.walk_from(grid, rows.start);
        let mut line = rows.start;
        while line < rows.end {
            let row = line.div_euclid(side);
            let end = rows.end.min((row + 1) * side);
            let mut spans = [Span::default(); MAX_SIDE];
            for line in line..end {
                spans[line.rem_euclid(side).cast_unsigned() as usize] = walker.next_span(columns);
            }
            self.pixel_row(&shader, &PixelRow::new(spans, side), row);
            line = end;
        }
    }

    /// Samples of one colour, counted from the tile's first.
    fn samples(&mut self, coverage: SmallCoverage, color: Premultiplied16) {
        let side = self.context.grid.side();
        let PixelRect { x, y } = self.layers[0].rect;
        let coverage = coverage.moved(x.start * side, y.start * side);
        if side == 1 {
            coverage.each_run(|row, xs| self.fill(xs, row, color));
        } else {
            self.few_samples(&Shader::flat(color), coverage);
        }
    }

    /// The few samples of a small triangle.
    fn few_samples(&mut self, shader: &Shader<'_>, coverage: SmallCoverage) {
        let side = self.context.grid.side();
        let PixelRect { x, y } = self.layers[0].rect;
        let samples = |pixels: Span| Span {
            start: pixels.start * side,
            end: pixels.end * side,
        };
        let rows = samples(y).intersection(coverage.rows());
        let mut line = rows.start;
        while line < rows.end {
            let row = line.div_euclid(side);
            let end = rows.end.min((row + 1) * side);
            let mut spans = [Span::default(); MAX_SIDE];
            for line in line..end {
                spans[line.rem_euclid(side).cast_unsigned() as usize] = coverage.span(line).intersection(samples(x));
            }
            self.pixel_row(shader, &PixelRow::new(spans, side), row);
            line = end;
        }
    }

    /// Paints one row of pixels: solid colours pixel by pixel, shaded ones by sample rows.
    fn pixel_row(&mut self, shader: &Shader<'_>, pixels: &PixelRow, row: i32) {
        let side = self.context.grid.side();
        if let ShaderKind::Solid(color) = &shader.kind {
            self.fill(pixels.full, row, *color);
            for x in (pixels.touched.start..pixels.full.start).chain(pixels.full.end..pixels.touched.end) {
                self.layers[self.depth - 1].fill_part(x, row, &pixels.spans[..pixels.side], *color);
            }
            if self.probe.is_some() {
                for (span, line) in pixels.spans[..pixels.side].iter().zip(row * side..) {
                    self.note(*span, line);
                }
            }
        } else {
            if shader.opaque {
                self.layers[self.depth - 1].split_unfilled(pixels.full, row);
            }
            for (span, line) in pixels.spans[..pixels.side].iter().zip(row * side..) {
                self.shaded(shader, *span, line);
            }
        }
    }

    fn fill(&mut self, xs: Span, y: i32, color: Premultiplied16) {
        self.layers[self.depth - 1].fill(xs, y, color);
        if let Some(probe) = &mut self.probe
            && !xs.is_empty()
        {
            probe.hits.fill(Some(probe.source));
        }
    }

    fn shaded(&mut self, shader: &Shader<'_>, columns: Span, line: i32) {
        if columns.is_empty() {
            return;
        }
        let count = (columns.end - columns.start).cast_unsigned() as usize;
        if self.colors.len() < count {
            self.colors.resize(count, Premultiplied16::TRANSPARENT);
        }
        let colors = &mut self.colors[..count];
        shader.shade(&self.context, columns.start, line, colors);
        self.layers[self.depth - 1].write_samples(columns, line, colors, shader.opaque);
        self.note(columns, line);
    }

    /// Tells the probe that samples were painted.
    fn note(&mut self, columns: Span, line: i32) {
        let side = self.context.grid.side();
        if let Some(probe) = &mut self.probe {
            for column in columns.start..columns.end {
                let sample = line.rem_euclid(side) * side + column.rem_euclid(side);
                probe.hits[sample.cast_unsigned() as usize] = Some(probe.source);
            }
        }
    }
}

impl PixelRow {
    fn new(spans: [Span; MAX_SIDE], side: i32) -> Self {
        let count = side.cast_unsigned() as usize;
        let (mut outer, mut inner) = (
            Span {
                start: i32::MAX,
                end: 0,
            },
            Span {
                start: 0,
                end: i32::MAX,
            },
        );
        for span in &spans[..count] {
            // A sample row without samples leaves no pixel full.
            inner = inner.intersection(*span);
            if !span.is_empty() {
                outer = Span {
                    start: outer.start.min(span.start),
                    end: outer.end.max(span.end),
                };
            }
        }
        // Columns of a frame are never negative, so that division rounds down.
        let touched = if outer.is_empty() {
            Span::default()
        } else {
            Span {
                start: outer.start / side,
                end: (outer.end + side - 1) / side,
            }
        };
        let mut full = Span {
            start: (inner.start + side - 1) / side,
            end: inner.end / side,
        };
        if full.is_empty() {
            full = Span {
                start: touched.end,
                end: touched.end,
            };
        }
        Self {
            spans,
            side: count,
            touched,
            full,
        }
    }
}
