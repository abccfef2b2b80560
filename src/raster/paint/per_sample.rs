//! Painting one tile: every command of the display list that touches it, in painter's order.

use crate::color::Premultiplied16;
use crate::raster::binning::tile_command::{TileCommand, Work};
use crate::raster::coverage::covered::Covered;
use crate::raster::coverage::shape::Shape;
use crate::raster::coverage::shape_coverage::ShapeCoverage;
use crate::raster::frame::block::PixelBlock;
use crate::raster::layers::stack::LayerStack;
use crate::raster::list::chunk::Chunk;
use crate::raster::paint::by_area::AreaQueue;
use crate::raster::paint::recorder::{PaintedCommand, PaintedKind, Recorder};
use crate::raster::paint::sample_colors::{SampleColors, ShadedColors};
use crate::raster::paint::shade_once::{OnceQueue, merge_parts};
use crate::raster::paint::wide::{WeighedPixels, WideResolve};
use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::sampling::shading_rate::ShadingRate;
use crate::raster::shading::Shader;
use crate::raster::shading::context::ShadeContext;
use crate::raster::span::{Span, SpanRect};

/// Paints tiles, one after the other, reusing its memory.
#[derive(Debug)]
pub(crate) struct PerSamplePainter<'a> {
    context: ShadeContext<'a>,
    layers: LayerStack<SampleColors>,
    /// What resolves tiles where pixels take samples of their neighbours.
    wide: Option<WideResolve>,
    /// Where the samples of a pixel lie.
    positions: SamplePositions,
    memory: Vec<Position>,
    /// What is to be shaded: rows of pixels and what is covered there, the places of these samples, and their colours.
    covered: Vec<(i32, Covered)>,
    points: Vec<[u16; 2]>,
    colors: Vec<Premultiplied16>,
    /// The same where a primitive is shaded once in a pixel.
    once: OnceQueue<'a>,
    /// The same where areas count.
    areas: AreaQueue,
    /// Samples whose colours were computed.
    pub(crate) samples_shaded: u64,
    /// When a single pixel is replayed: what was painted.
    recorder: Option<Recorder>,
}

impl<'a> PerSamplePainter<'a> {
    /// A painter for one drawing.
    pub(crate) fn new(context: ShadeContext<'a>, positions: SamplePositions) -> Self {
        Self {
            context,
            layers: LayerStack::new(buffer(&context)),
            wide: (!context.filter.is_plain()).then(|| WideResolve::new(&context, &positions)),
            positions,
            memory: Vec::new(),
            covered: Vec::new(),
            points: Vec::new(),
            colors: Vec::new(),
            once: OnceQueue::new(context),
            areas: AreaQueue::default(),
            samples_shaded: 0,
            recorder: None,
        }
    }

    /// Starts a tile.
    pub(crate) fn begin(&mut self, rect: SpanRect, background: Premultiplied16) {
        self.layers.restart().reset(rect, background);
    }

    /// Paints the commands of one chunk that touch the tile.
    pub(crate) fn paint(&mut self, chunk: &Chunk, entries: &[TileCommand], shape_coverage: &mut ShapeCoverage) {
        for entry in entries {
            if self.recorder.is_some() {
                self.record(chunk, *entry);
            }
            match entry.work(chunk) {
                Work::Flat(shape, color) if shape_coverage.has_areas() => self.flat_area(shape, shape_coverage, color),
                Work::Shaded(shape, corners, paint) if shape_coverage.has_areas() => {
                    self.area(shape, shape_coverage, |context| Shader::new(context, corners, paint));
                }
                Work::Flat(shape, color) => self.shape(shape, shape_coverage, |_| Shader::flat(color)),
                Work::Shaded(shape, corners, paint) if self.context.shading.is_once() => {
                    self.shape_once(shape, shape_coverage, |context| Shader::new(context, corners, paint));
                }
                Work::Shaded(shape, corners, paint) => {
                    self.shape(shape, shape_coverage, |context| Shader::new(context, corners, paint));
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

    /// Where pixels take samples of their neighbours: where to put what those of a tile show that was painted elsewhere, and what
    /// resolves it.
    pub(crate) fn begin_wide(&mut self, rect: SpanRect) -> Option<(&mut SampleColors, &mut WideResolve)> {
        let wide = self.wide.as_mut()?;
        let tile = self.layers.restart();
        tile.reset_to_put(rect);
        Some((tile, wide))
    }

    /// Resolves the finished tile, of which `block` are the pixels that it has in the frame.
    pub(crate) fn resolve_tile(&mut self, block: &mut PixelBlock<'_>) {
        if let Some(wide) = &mut self.wide {
            return wide.resolve(self.layers.base(), block);
        }
        for y in block.rect.y.start..block.rect.y.end {
            self.resolve(y, block.line(y));
        }
    }

    /// After a tile of one pixel was resolved that takes samples of its neighbours: all of them.
    pub(crate) fn neighbourhood(&self) -> Option<WeighedPixels> {
        let wide = self.wide.as_ref()?;
        Some(wide.neighbourhood(self.layers.base()))
    }

    /// Resolves one row of the finished tile, each pixel the mean of its own samples.
    pub(crate) fn resolve(&self, y: i32, pixels: &mut [u32]) {
        self.layers.base().resolve(y, pixels);
    }

    /// Paints a tile of a single pixel and says what each command did there, and what its samples hold then.
    pub(crate) fn replay(
        &mut self,
        chunks: &[(&Chunk, &[TileCommand])],
        pixel: [i32; 2],
        background: Premultiplied16,
        shape_coverage: &mut ShapeCoverage,
    ) -> (Vec<PaintedCommand>, Vec<(Premultiplied16, usize)>) {
        let one = |start: i32| Span { start, end: start + 1 };
        self.recorder = Some(Recorder::new(self.samples_per_pixel()));
        let rect = SpanRect {
            x: one(pixel[0]),
            y: one(pixel[1]),
        };
        self.begin(rect, background);
        for (chunk, entries) in chunks {
            self.paint(chunk, entries, shape_coverage);
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
        let SpanRect { x, y } = buffer.rect;
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
            let index = entry.command();
            recorder.next(chunk.sources[index], index, PaintedKind::of(&work), &now);
            recorder.paint_on(on);
            if let Some(colors) = layer {
                recorder.paint_all(colors);
            }
        }
    }

    /// Paints a shape with the shader that `shader` makes once it is needed.
    fn shape(
        &mut self,
        shape: Shape<'_>,
        shape_coverage: &mut ShapeCoverage,
        shader: impl Fn(&ShadeContext<'a>) -> Shader<'a>,
    ) {
        let rect = self.layers.base().rect;
        let (mut prepared, mut painted) = (None, SpanRect::EMPTY);
        shape_coverage.each(shape, rect, |y, covered| {
            painted = painted.union(covered.pixels(y));
            let shader = prepared.get_or_insert_with(|| shader(&self.context));
            match shader.constant() {
                Some(color) => self.fill(y, covered, color),
                None => self.gather(y, covered, shader.is_level()),
            }
        });
        self.layers.top().note_painted(painted.intersection(rect));
        if let Some(shader) = prepared {
            self.shade(&shader);
        }
    }

    /// As [`PerSamplePainter::shape`], with one colour for all samples of a pixel that the shape covers.
    fn shape_once(
        &mut self,
        shape: Shape<'_>,
        shape_coverage: &mut ShapeCoverage,
        shader: impl Fn(&ShadeContext<'a>) -> Shader<'a>,
    ) {
        let rect = self.layers.base().rect;
        let (mut prepared, mut painted) = (None, SpanRect::EMPTY);
        let mut visit = |this: &mut Self, y: i32, covered: Covered| {
            painted = painted.union(covered.pixels(y));
            let shader = prepared.get_or_insert_with(|| shader(&this.once.at_centres()));
            if let Some(color) = shader.constant() {
                return this.fill(y, covered, color);
            }
            let place = this.once.note(rect, (y, covered), &this.positions, shader.is_level());
            if let Some(recorder) = &mut this.recorder {
                recorder.shaded_at(place);
            }
        };
        if self.context.shading == ShadingRate::Centroid {
            // A pixel may come several times, but has one centroid.
            let mut found = std::mem::take(&mut self.covered);
            shape_coverage.each(shape, rect, |y, covered| found.push((y, covered)));
            merge_parts(&mut found, self.positions.count());
            found.drain(..).for_each(|(y, covered)| visit(self, y, covered));
            self.covered = found;
        } else {
            shape_coverage.each(shape, rect, |y, covered| visit(self, y, covered));
        }
        self.layers.top().note_painted(painted.intersection(rect));
        if let Some(at_centre) = prepared {
            self.samples_shaded += self.once.shade([rect.x.start, rect.y.start], &at_centre, shader);
            self.once.paint(self.layers.top(), &at_centre, self.recorder.as_mut());
        }
    }

    /// Paints the areas of pixels that a shape covers with one colour.
    fn flat_area(&mut self, shape: Shape<'_>, shape_coverage: &mut ShapeCoverage, color: Premultiplied16) {
        let rect = self.layers.base().rect;
        let (tile, mut recorder) = (self.layers.top(), self.recorder.as_mut());
        let mut painted = SpanRect::EMPTY;
        shape_coverage.each_area(shape, rect, |y, covered| {
            painted = painted.union(covered.pixels(y));
            tile.fill_area(y, covered, color);
            if let Some(recorder) = &mut recorder {
                recorder.paint_area(covered.area, color);
            }
        });
        tile.note_painted(painted.intersection(rect));
    }

    /// As [`PerSamplePainter::shape`], where the shape covers areas of pixels.
    fn area(
        &mut self,
        shape: Shape<'_>,
        shape_coverage: &mut ShapeCoverage,
        shader: impl Fn(&ShadeContext<'a>) -> Shader<'a>,
    ) {
        let rect = self.layers.base().rect;
        let (mut prepared, mut painted) = (None, SpanRect::EMPTY);
        shape_coverage.each_area(shape, rect, |y, covered| {
            painted = painted.union(covered.pixels(y));
            let shader = prepared.get_or_insert_with(|| shader(&self.context));
            let Some(color) = shader.constant() else {
                return self.areas.note(rect, y, covered);
            };
            self.layers.top().fill_area(y, covered, color);
            if let Some(recorder) = &mut self.recorder {
                recorder.paint_area(covered.area, color);
            }
        });
        self.layers.top().note_painted(painted.intersection(rect));
        if let Some(shader) = prepared {
            let recorder = self.recorder.as_mut();
            self.samples_shaded += self.areas.paint(self.layers.top(), &self.context, &shader, recorder);
        }
    }

    /// Paints samples of row `y` of pixels with one colour.
    #[inline]
    fn fill(&mut self, y: i32, covered: Covered, color: Premultiplied16) {
        match covered {
            Covered::Whole(xs) => self.layers.top().fill(xs, y, color),
            Covered::Part(x, mask) => self.layers.top().fill_mask(x, y, mask, color),
        }
        if let Some(recorder) = &mut self.recorder {
            recorder.paint(covered, |_| color);
        }
    }

    /// Notes samples of row `y` of pixels that are to be shaded: of the first pixel only, where all those beside it get the same
    /// colours, as along a level gradient.
    fn gather(&mut self, y: i32, covered: Covered, is_level: bool) {
        let side = self.context.grid.side();
        let rect = self.layers.base().rect;
        // No tile has more than `2^14` points of a lattice along a side.
        let inside = |pixels: i32| u16::try_from(pixels * side).unwrap_or(u16::MAX);
        let top = inside(y - rect.y.start);
        // A place inside a pixel is less than 256: nothing here overflows.
        let point =
            |left: u16, [column, row]: Position| [left.wrapping_add(column.into()), top.wrapping_add(row.into())];
        match covered {
            Covered::Whole(xs) => {
                let end = if is_level && self.positions.are_same() {
                    xs.start + 1
                } else {
                    xs.end
                };
                for x in xs.start..end {
                    let left = inside(x - rect.x.start);
                    let places = self.positions.of_pixel([x, y], &mut self.memory);
                    self.points.extend(places.iter().map(|place| point(left, *place)));
                }
            }
            Covered::Part(x, mask) => {
                let left = inside(x - rect.x.start);
                let places = self.positions.of_pixel([x, y], &mut self.memory);
                mask.each(|sample| self.points.push(point(left, places[sample])));
            }
        }
        self.covered.push((y, covered));
    }

    /// Shades what was noted, all samples together.
    fn shade(&mut self, shader: &Shader<'_>) {
        let count = self.points.len();
        if self.colors.len() < count {
            self.colors.resize(count, Premultiplied16::TRANSPARENT);
        }
        self.samples_shaded += count as u64;
        let SpanRect { x, y } = self.layers.base().rect;
        let grid = self.context.samples_from([x.start, y.start]);
        shader.points(grid, &self.points, &mut self.colors[..count]);
        self.points.clear();
        let per_pixel = self.samples_per_pixel();
        let repeats = shader.is_level() && self.positions.are_same();
        let mut rest = &self.colors[..count];
        for (y, covered) in self.covered.drain(..) {
            let count = match covered {
                Covered::Whole(_) if repeats => per_pixel,
                covered => covered.count(per_pixel),
            };
            let (colors, others) = rest.split_at(count);
            rest = others;
            let shaded = ShadedColors {
                colors,
                opaque: shader.opaque,
            };
            match covered {
                Covered::Whole(xs) if repeats => self.layers.top().repeat(xs, y, shaded),
                Covered::Whole(xs) => self.layers.top().write(xs, y, shaded),
                Covered::Part(x, mask) => self.layers.top().write_mask(x, y, mask, shaded),
            }
            if let Some(recorder) = &mut self.recorder {
                recorder.paint(covered, |i| colors[i]);
            }
        }
    }
}

/// A buffer of no pixels.
fn buffer(context: &ShadeContext<'_>) -> SampleColors {
    SampleColors::new(context.rate, context.sampling.rules, context.space)
}
