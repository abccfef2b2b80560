//! Painting one tile: every command of the display list that touches it, in painter's order.

use crate::color::Premultiplied16;
use crate::raster::binning::tile_command::{TileCommand, Work};
use crate::raster::coverage::covered::Covered;
use crate::raster::coverage::free_positions::FreePositions;
use crate::raster::coverage::mask8x8::CoverageMask;
use crate::raster::coverage::pixel_rows::{PixelRow, each_pixel_row_of_few};
use crate::raster::coverage::shape_rows::{Shape, ShapeRows};
use crate::raster::layers::stack::LayerStack;
use crate::raster::list::chunk::Chunk;
use crate::raster::paint::recorder::{PaintedCommand, PaintedKind, Recorder};
use crate::raster::paint::sample_colors::SampleColors;
use crate::raster::sampling::mask::SampleMask;
use crate::raster::sampling::positions::Position;
use crate::raster::shading::Shader;
use crate::raster::shading::context::ShadeContext;
use crate::raster::span::{PixelRect, Span, scaled};

/// Paints tiles, one after the other, reusing its memory.
#[derive(Debug)]
pub(crate) struct PerSamplePainter<'a> {
    context: ShadeContext<'a>,
    layers: LayerStack<SampleColors>,
    /// The samples at work and their colours.
    points: Vec<[u16; 2]>,
    colors: Vec<Premultiplied16>,
    /// Finds coverage where samples are not those of the grid, and the parts of pixels at work there.
    free_positions: Option<Box<FreePositions>>,
    parts: Vec<([i32; 2], SampleMask)>,
    /// Samples whose colours were computed.
    pub(crate) samples_shaded: u64,
    /// When a single pixel is replayed: what was painted.
    recorder: Option<Recorder>,
}

impl<'a> PerSamplePainter<'a> {
    /// A painter for one drawing; `free_positions` where samples are not those of the grid.
    pub(crate) fn new(context: ShadeContext<'a>, free_positions: Option<FreePositions>) -> Self {
        Self {
            context,
            layers: LayerStack::new(buffer(&context)),
            points: Vec::new(),
            colors: Vec::new(),
            free_positions: free_positions.map(Box::new),
            parts: Vec::new(),
            samples_shaded: 0,
            recorder: None,
        }
    }

    /// Starts a tile.
    pub(crate) fn begin(&mut self, rect: PixelRect, background: Premultiplied16) {
        self.layers.restart().reset(rect, background);
    }

    /// Paints the commands of one chunk that touch the tile.
    pub(crate) fn paint(&mut self, chunk: &Chunk, entries: &[TileCommand], shape_rows: &mut ShapeRows) {
        for entry in entries {
            if self.recorder.is_some() {
                self.record(chunk, *entry);
            }
            match entry.work(chunk) {
                Work::Samples(coverage, color) => self.samples(coverage, color),
                Work::Pixels(pixels, color) => {
                    let PixelRect { x, y } = self.layers.base().rect;
                    pixels
                        .moved(x.start, y.start)
                        .each_run(|row, xs| self.fill(xs, row, color));
                }
                Work::Flat(shape, color) => self.covered((shape, *entry), shape_rows, |_| Shader::flat(color)),
                Work::Shaded(shape, corners, paint) => {
                    self.covered((shape, *entry), shape_rows, |context| {
                        Shader::new(context, corners, paint)
                    });
                }
                Work::BeginLayer => {
                    let rect = self.layers.base().rect;
                    let layer = self.layers.push(|| buffer(&self.context));
                    layer.reset(rect, Premultiplied16::TRANSPARENT);
                }
                Work::EndLayer(compositing) => {
                    if let Some((below, layer)) = self.layers.pop() {
                        below.composite(layer, compositing);
                    }
                }
            }
        }
    }

    /// Resolves one row of the finished tile.
    pub(crate) fn resolve(&self, y: i32, pixels: &mut [u32]) {
        self.layers.base().resolve(y, pixels);
    }

    /// Paints a tile of a single pixel and says what each command did there, and what its samples hold then.
    pub(crate) fn replay(
        &mut self,
        chunks: &[(&Chunk, &[TileCommand])],
        (pixel, background): ([i32; 2], Premultiplied16),
        shape_rows: &mut ShapeRows,
    ) -> (Vec<PaintedCommand>, Vec<(Premultiplied16, usize)>) {
        let one = |start: i32| Span { start, end: start + 1 };
        self.recorder = Some(Recorder::new(self.samples_per_pixel()));
        let rect = PixelRect {
            x: one(pixel[0]),
            y: one(pixel[1]),
        };
        self.begin(rect, background);
        for (chunk, entries) in chunks {
            self.paint(chunk, entries, shape_rows);
        }
        let samples = self.pixel_samples(self.layers.base());
        let recorded = self.recorder.take().map(|recorder| recorder.finish(&samples));
        let (painted, depths) = recorded.unwrap_or_default();
        (painted, samples.into_iter().zip(depths).collect())
    }

    fn samples_per_pixel(&self) -> usize {
        self.context.rate.samples() as usize
    }

    /// The samples of a buffer's first pixel.
    fn pixel_samples(&self, buffer: &SampleColors) -> Vec<Premultiplied16> {
        let PixelRect { x, y } = buffer.rect;
        let sample = |i| buffer.sample(x.start, y.start, i);
        (0..self.samples_per_pixel()).map(sample).collect()
    }

    /// Tells the recorder which command comes next.
    fn record(&mut self, chunk: &Chunk, entry: TileCommand) {
        let (top, below) = self.layers.topmost();
        let now = self.pixel_samples(top);
        let work = entry.work(chunk);
        // The end of a layer paints on what lies below it.
        let (on, layer) = match (&work, below) {
            (Work::EndLayer(compositing), Some(below)) => {
                let layer = now.iter().map(|color| compositing.fragment(*color)).collect();
                (self.pixel_samples(below), Some(layer))
            }
            _ => (now.clone(), None),
        };
        if let Some(recorder) = &mut self.recorder {
            recorder.next(
                (chunk.sources[entry.command()], entry.command()),
                PaintedKind::of(&work),
                &now,
                on,
            );
            if let Some(colors) = layer {
                recorder.paint_all(colors);
            }
        }
    }

    /// What covers all of the tile.
    fn whole_tile(&mut self, shader: &Shader<'_>) {
        let PixelRect { x, y } = self.layers.base().rect;
        let side = self.context.grid.side();
        let columns = scaled(x, side);
        for row in y.start..y.end {
            if let Some(color) = shader.constant() {
                self.fill(x, row, color);
            } else if self.free_positions.is_some() {
                self.gather(row, Covered::Whole(x));
            } else {
                if shader.opaque {
                    self.layers.top().split_unfilled(x, row);
                }
                for line in row * side..(row + 1) * side {
                    self.shaded(shader, columns, line);
                }
            }
        }
        self.shade_parts(shader);
    }

    /// A shape, shaded by what `shader` makes once it is needed.
    fn covered(
        &mut self,
        (shape, entry): (Shape<'_>, TileCommand),
        shape_rows: &mut ShapeRows,
        shader: impl Fn(&ShadeContext<'a>) -> Shader<'a>,
    ) {
        if entry.covers_tile() {
            return self.whole_tile(&shader(&self.context));
        }
        if self.free_positions.is_some() {
            return self.scattered(shape, shader);
        }
        let rect = self.layers.base().rect;
        let mut prepared = None;
        shape_rows.each_pixel_row(shape, rect, |row| {
            let shader = prepared.get_or_insert_with(|| shader(&self.context));
            self.pixel_row(shader, row);
        });
    }

    /// A shape whose samples are not those of the grid.
    fn scattered(&mut self, shape: Shape<'_>, shader: impl Fn(&ShadeContext<'a>) -> Shader<'a>) {
        let Some(mut free_positions) = self.free_positions.take() else {
            return;
        };
        let mut prepared = None;
        free_positions.each(shape, self.layers.base().rect, |y, covered| {
            let shader = prepared.get_or_insert_with(|| shader(&self.context));
            match (shader.constant(), covered) {
                (Some(color), Covered::Whole(xs)) => self.fill(xs, y, color),
                (Some(color), Covered::Part(x, mask)) => {
                    self.layers.top().fill_mask(x, y, mask, color);
                    if let Some(recorder) = &mut self.recorder {
                        recorder.paint_mask(mask, |_| color);
                    }
                }
                _ => self.gather(y, covered),
            }
        });
        self.free_positions = Some(free_positions);
        if let Some(shader) = prepared {
            self.shade_parts(&shader);
        }
    }

    /// Notes what is to be shaded.
    fn gather(&mut self, y: i32, covered: Covered) {
        match covered {
            Covered::Whole(xs) => {
                let all = SampleMask::all(self.samples_per_pixel());
                self.parts.extend((xs.start..xs.end).map(|x| ([x, y], all)));
            }
            Covered::Part(x, mask) => self.parts.push(([x, y], mask)),
        }
    }

    /// Shades what was noted, all samples together.
    fn shade_parts(&mut self, shader: &Shader<'_>) {
        let Some(free_positions) = &mut self.free_positions else {
            return;
        };
        let PixelRect { x, y } = self.layers.base().rect;
        let side = self.context.grid.side();
        let all = SampleMask::all(self.context.rate.samples() as usize);
        self.points.clear();
        for (pixel, mask) in &self.parts {
            let first = [(pixel[0] - x.start) * side, (pixel[1] - y.start) * side];
            let places = free_positions.places(*pixel);
            // No tile has more than `2^14` points of a lattice along a side.
            let [left, top] = first.map(|at| u16::try_from(at).unwrap_or(u16::MAX));
            let point = |[column, row]: Position| {
                let (column, row) = (left.saturating_add(column.into()), top.saturating_add(row.into()));
                [column, row]
            };
            if *mask == all {
                self.points.extend(places.iter().map(|place| point(*place)));
            } else {
                mask.each(|sample| self.points.push(point(places[sample])));
            }
        }
        let count = self.points.len();
        if self.colors.len() < count {
            self.colors.resize(count, Premultiplied16::TRANSPARENT);
        }
        self.samples_shaded += count as u64;
        let grid = self.context.samples_from([x.start, y.start]);
        shader.points(grid, &self.points, &mut self.colors[..count]);
        let mut first = 0;
        for ([x, y], mask) in &self.parts {
            let colors = &self.colors[first..first + mask.count()];
            first += colors.len();
            self.layers.top().write_mask((*x, *y), *mask, colors, shader.opaque);
            if let Some(recorder) = &mut self.recorder {
                recorder.paint_mask(*mask, |i| colors[i]);
            }
        }
        self.parts.clear();
    }

    /// Samples of one colour, counted from the tile's first.
    fn samples(&mut self, coverage: CoverageMask, color: Premultiplied16) {
        let side = self.context.grid.side();
        let rect = self.layers.base().rect;
        let coverage = coverage.moved(rect.x.start * side, rect.y.start * side);
        let shader = Shader::flat(color);
        each_pixel_row_of_few(coverage, side, rect, |row| self.pixel_row(&shader, row));
    }

    /// Paints one row of pixels: solid colours pixel by pixel, shaded ones by sample rows.
    fn pixel_row(&mut self, shader: &Shader<'_>, pixels: &PixelRow<'_>) {
        let (side, row) = (self.context.grid.side(), pixels.y);
        if let Some(color) = shader.constant() {
            self.fill(pixels.full, row, color);
            for x in pixels.partial() {
                self.layers.top().fill_part(x, row, pixels.spans(), color);
            }
            if let Some(recorder) = &mut self.recorder {
                for (span, line) in pixels.spans().iter().zip(row * side..) {
                    recorder.paint(*span, line, side, |_| color);
                }
            }
        } else {
            if shader.opaque {
                self.layers.top().split_unfilled(pixels.full, row);
            }
            for (span, line) in pixels.spans().iter().zip(row * side..) {
                self.shaded(shader, *span, line);
            }
        }
    }

    fn fill(&mut self, xs: Span, y: i32, color: Premultiplied16) {
        self.layers.top().fill(xs, y, color);
        if let Some(recorder) = &mut self.recorder
            && !xs.is_empty()
        {
            recorder.fill(color);
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
        self.samples_shaded += count as u64;
        let colors = &mut self.colors[..count];
        let PixelRect { x, y } = self.layers.base().rect;
        let side = self.context.grid.side();
        let inside = |from: i32, to: i32| u16::try_from(to - from * side).unwrap_or(u16::MAX);
        let row = inside(y.start, line);
        self.points.clear();
        self.points
            .extend((inside(x.start, columns.start)..inside(x.start, columns.end)).map(|column| [column, row]));
        shader.points(self.context.samples_from([x.start, y.start]), &self.points, colors);
        self.layers.top().write_samples(columns, line, colors, shader.opaque);
        if let Some(recorder) = &mut self.recorder {
            recorder.paint(columns, line, side, |i| colors[i]);
        }
    }
}

/// A buffer of no pixels.
fn buffer(context: &ShadeContext<'_>) -> SampleColors {
    let settings = (context.sampling.rules, context.filter, context.space);
    SampleColors::new(context.rate, context.grid.side(), settings)
}
