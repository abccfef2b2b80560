//! The whole way from chunks to pixels: bins, tiles in parallel, resolve.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::color::{Premultiplied16, ResolveSpace, Rgba};
use crate::raster::binning::bins::{Bins, Plan};
use crate::raster::binning::tile_command::{TileCommand, Work};
use crate::raster::coverage::free_positions::FreePositions;
use crate::raster::coverage::shape_rows::ShapeRows;
use crate::raster::frame::block::PixelBlock;
use crate::raster::frame::row::FrameRow;
use crate::raster::list::chunk::{Chunk, ListContext, measure_layers};
use crate::raster::paint::direct::DirectPainter;
use crate::raster::paint::per_sample::PerSamplePainter;
use crate::raster::paint::visibility::painter::VisibilityPainter;
use crate::raster::sampling::positions::{SamplePositions, lattice};
use crate::raster::shading::context::ShadeContext;
use crate::raster::span::Span;
use crate::raster::stats::{Counters, SharedTally, Tally};
use crate::raster::tile_layout::TileLayout;
use crate::raster::{Framebuffer, SamplePattern, SampleRate};
use crate::rules::Rules;
use crate::texture::{SamplingSettings, Texture};

/// One tile of so many is timed.
const TIMED: usize = 7;

/// Everything that decides how primitives become pixels.
#[derive(Clone, Copy, Debug)]
pub struct RasterSettings {
    /// Samples per pixel.
    pub rate: SampleRate,
    /// Where they lie; where the pattern does not take the rate, it has the nearest one that it takes.
    pub pattern: SamplePattern,
    /// How textures are read, and by whose rules.
    pub sampling: SamplingSettings,
    /// In which values samples are averaged.
    pub space: ResolveSpace,
    /// What lies below the first primitive.
    pub background: Rgba,
    /// Where it is given, the red of each resolved pixel is a number and becomes the colour of that index.
    pub palette: Option<&'static [u32; 256]>,
}

/// A display list ready to be drawn.
#[derive(Debug)]
pub struct DisplayList<'a> {
    pub(in crate::raster) context: ListContext,
    pub(in crate::raster) settings: RasterSettings,
    pub(in crate::raster) chunks: Vec<Chunk>,
    pub(in crate::raster) textures: Vec<&'a Texture>,
    kinds: Kinds,
}

/// Where the time went.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RasterTimes {
    /// Ops to tiles.
    pub bin: Duration,
    /// Coverage and shading.
    pub raster: Duration,
    /// Samples to pixels; estimated from the time that a part of the tiles took.
    pub resolve: Duration,
    /// What was done.
    pub counters: Counters,
}

impl RasterTimes {
    /// Adds the painting of some tiles that took `time`.
    pub(in crate::raster) fn painted(&mut self, time: Duration, tally: &Tally) {
        let resolve = time.mul_f64(tally.resolving_share());
        self.resolve += resolve;
        self.raster += time.saturating_sub(resolve);
        self.counters.blocks_whole += tally.counters.blocks_whole;
        self.counters.blocks_split += tally.counters.blocks_split;
        self.counters.samples_shaded += tally.counters.samples_shaded;
    }
}

/// What the primitives of a list are like.
#[derive(Clone, Copy, Debug)]
struct Kinds {
    /// All are opaque, and none is in a layer.
    opaque: bool,
    /// Samples that are shaded must be blended one by one.
    blended: bool,
}

/// How a tile is painted.
///
/// With one sample per pixel, and where everything is flat, all methods give the same bytes, so each tile takes the
/// fastest. Where samples are shaded, the deferred method rounds once per primitive and pixel, blending once per
/// sample: tiles that shade anything take the one or the other for the whole list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::raster) enum Method {
    /// Opaque primitives straight into the frame.
    Direct,
    /// What each sample shows, then its colour.
    Deferred,
    /// The colour of each sample, primitive by primitive.
    Blended,
}

/// A painter for each method.
#[derive(Debug)]
pub(in crate::raster) struct Painters<'a> {
    direct: DirectPainter<'a>,
    pub(in crate::raster) deferred: VisibilityPainter<'a>,
    pub(in crate::raster) blended: PerSamplePainter<'a>,
    pub(in crate::raster) bands: ShapeRows,
    pub(in crate::raster) tally: Tally,
}

/// One group of tile rows on its way to the frame.
pub(in crate::raster) struct Pass<'a> {
    /// The entries of each chunk.
    pub(in crate::raster) bins: Vec<Arc<Bins>>,
    pub(in crate::raster) first_row: u32,
    pub(in crate::raster) cancelled: &'a AtomicBool,
    pub(in crate::raster) tally: SharedTally,
}

impl ListContext {
    /// For a frame of `size` pixels.
    pub fn new(size: [u32; 2], settings: &RasterSettings) -> Self {
        Self::with_tiles(
            size,
            settings,
            TileLayout::for_rate(settings.pattern.nearest(settings.rate), size),
        )
    }

    pub(crate) fn with_tiles(size: [u32; 2], settings: &RasterSettings, tiles: TileLayout) -> Self {
        let rate = settings.pattern.nearest(settings.rate);
        let pattern = settings.pattern.simplest(rate);
        Self {
            grid: lattice(pattern, rate),
            pattern,
            rate,
            rules: settings.sampling.rules,
            size,
            tiles,
        }
    }
}

impl Kinds {
    fn of(chunks: &[Chunk], textures: &[&Texture], rules: Rules) -> Self {
        let layers = chunks.iter().any(Chunk::has_layers);
        let translucent = chunks.iter().any(|chunk| chunk.translucent);
        // A few are looked at faster than another thread wakes up.
        let (shaded, shaded_opaque) = chunks
            .par_iter()
            .with_min_len(8)
            .map(|chunk| {
                let mut shaded = chunk.paints.iter().filter(|paint| paint.constant.is_none()).peekable();
                let any = shaded.peek().is_some();
                (any, shaded.all(|paint| paint.is_opaque(textures)))
            })
            .reduce(|| (false, true), |a, b| (a.0 || b.0, a.1 && b.1));
        Self {
            opaque: !translucent && shaded_opaque && !layers,
            // The course truncates every sample; layers do not know what would be below a sample that shows through.
            blended: !shaded_opaque || shaded && (layers || rules == Rules::Course),
        }
    }
}

impl<'a> DisplayList<'a> {
    /// Chunks in painter's order, built with `context`; [`crate::raster::Paint::texture`] points into `textures`.
    pub fn new(
        context: ListContext,
        settings: RasterSettings,
        mut chunks: Vec<Chunk>,
        textures: Vec<&'a Texture>,
    ) -> Self {
        measure_layers(&mut chunks, &context);
        let mut outlines = 0;
        for chunk in &mut chunks {
            chunk.first_outline = outlines;
            outlines += chunk.outlines.len();
        }
        let kinds = Kinds::of(&chunks, &textures, settings.sampling.rules);
        Self {
            context,
            settings,
            chunks,
            textures,
            kinds,
        }
    }

    /// Triangles in the list.
    pub fn triangles(&self) -> u64 {
        self.chunks.iter().map(|chunk| chunk.triangle_count).sum()
    }

    /// Draws everything into `frame`, which must have the size of the list's context; `None` when `cancelled` was set
    /// meanwhile and the frame is unfinished.
    ///
    /// # Panics
    /// When the frame has another size.
    pub fn rasterize(&self, frame: &mut Framebuffer, cancelled: &AtomicBool) -> Option<RasterTimes> {
        self.assert_size(frame);
        self.rasterize_rows(frame.pixels_mut(), None, cancelled)
    }

    /// As [`DisplayList::rasterize`], but resolves into `surface`, which has as many pixels as the frame; `frame` gets its
    /// copy of every row of tiles while that is still in the processor's cache.
    ///
    /// # Panics
    /// When the frame or the surface has another size.
    pub fn rasterize_onto(
        &self,
        surface: &mut [u32],
        frame: &mut Framebuffer,
        cancelled: &AtomicBool,
    ) -> Option<RasterTimes> {
        self.assert_size(frame);
        assert_eq!(surface.len(), frame.pixels().len(), "a surface as large as the frame");
        self.rasterize_rows(surface, Some(frame.pixels_mut()), cancelled)
    }

    fn assert_size(&self, frame: &Framebuffer) {
        assert_eq!(
            [frame.width(), frame.height()],
            self.context.size,
            "the list is made for a frame of one size"
        );
    }

    fn rasterize_rows(
        &self,
        pixels: &mut [u32],
        mut kept: Option<&mut [u32]>,
        cancelled: &AtomicBool,
    ) -> Option<RasterTimes> {
        let mut times = RasterTimes::default();
        let [width, height] = self.context.size;
        if width == 0 || height == 0 {
            return Some(times);
        }
        let row_pixels = (width * self.context.tiles.tile_height()) as usize;
        let start = Instant::now();
        let plan = self.plan();
        times.bin += start.elapsed();
        for group in plan.groups() {
            let start = Instant::now();
            let pass = self.pass(&plan, group, cancelled);
            times.bin += start.elapsed();
            let start = Instant::now();
            let count = (group.end - group.start).cast_unsigned() as usize;
            let rows = FrameRow::all(pixels, kept.as_deref_mut(), row_pixels);
            let rows = rows.skip(group.start.cast_unsigned() as usize).take(count);
            self.tile_rows(&pass, count, rows);
            times.painted(start.elapsed(), &pass.tally.total());
            if cancelled.load(Ordering::Relaxed) {
                return None;
            }
        }
        Some(times)
    }

    /// Paints and resolves so many rows of tiles; every thread takes the next one that is left.
    fn tile_rows<'f>(&self, pass: &Pass<'_>, count: usize, rows: impl Iterator<Item = FrameRow<'f>> + Send) {
        let threads = rayon::current_num_threads().min(count);
        let rows = Mutex::new(rows);
        let next = || rows.lock().unwrap_or_else(PoisonError::into_inner).next();
        // Painters are dear: one set for each thread that comes in time.
        let work = || {
            if let Some(row) = next() {
                let mut painters = self.painters();
                self.tile_row(pass, &mut painters, row);
                while let Some(row) = next() {
                    self.tile_row(pass, &mut painters, row);
                }
            }
        };
        rayon::in_place_scope(|scope| {
            for _ in 1..threads {
                scope.spawn(|_| work());
            }
            work();
        });
    }

    pub(in crate::raster) fn background(&self) -> Premultiplied16 {
        Premultiplied16::from_straight(self.settings.background, self.settings.sampling.rules)
    }

    /// Counts what each tile will hold.
    pub(in crate::raster) fn plan(&self) -> Plan {
        Plan::new(&self.chunks, &self.context, &self.textures)
    }

    /// Sorts everything into the tiles of some tile rows.
    pub(in crate::raster) fn pass<'p>(&self, plan: &Plan, rows: Span, cancelled: &'p AtomicBool) -> Pass<'p> {
        Pass {
            bins: plan.bins(&self.chunks, &self.context, &self.textures, rows),
            first_row: rows.start.cast_unsigned(),
            cancelled,
            tally: SharedTally::default(),
        }
    }

    pub(in crate::raster) fn shade_context(&self) -> ShadeContext<'_> {
        ShadeContext {
            grid: self.context.grid,
            rate: self.context.rate,
            space: self.settings.space,
            sampling: self.settings.sampling,
            textures: &self.textures,
        }
    }

    /// What finds coverage in some columns of pixels where samples are not those of the grid.
    fn free_positions(&self, columns: Span) -> Option<FreePositions> {
        (!self.context.is_grid()).then(|| self.scatter_in(columns))
    }

    /// As [`DisplayList::free_positions`], also for the samples of a grid.
    pub(in crate::raster) fn scatter_in(&self, columns: Span) -> FreePositions {
        let context = &self.context;
        let places = SamplePositions::new(context.pattern, context.rate);
        FreePositions::new((context.grid, context.rules), places, self.outlines(), columns)
    }

    /// How many outlines there are.
    pub(in crate::raster) fn outlines(&self) -> usize {
        self.chunks.iter().map(|chunk| chunk.outlines.len()).sum()
    }

    pub(in crate::raster) fn bands(&self) -> ShapeRows {
        let columns = self.context.samples().columns.end;
        ShapeRows::new((self.context.grid, self.context.rules), columns, self.outlines())
    }

    /// Painters for one thread.
    pub(in crate::raster) fn painters(&self) -> Painters<'_> {
        self.painters_of(Span {
            start: 0,
            end: self.context.size[0].cast_signed(),
        })
    }

    /// Painters of tiles in these columns of pixels.
    pub(in crate::raster) fn painters_of(&self, columns: Span) -> Painters<'_> {
        Painters {
            direct: DirectPainter::new(self.shade_context()),
            deferred: VisibilityPainter::new(self.shade_context()),
            blended: PerSamplePainter::new(self.shade_context(), self.free_positions(columns)),
            bands: self.bands(),
            tally: Tally::default(),
        }
    }

    /// How a tile is painted, of which the ops from `first` on are to be seen: see [`Method`].
    pub(in crate::raster) fn method(&self, pass: &Pass<'_>, tile: usize, first: (usize, usize)) -> Method {
        let all = |kind: fn(&TileCommand, &Chunk) -> bool| {
            visible(&pass.bins, tile, first)
                .all(|(chunk, entries)| entries.iter().all(|entry| kind(entry, &self.chunks[chunk])))
        };
        let rate_one = self.context.rate == SampleRate::ONE;
        // Neither samples off the grid nor their light can be summed up before all are painted.
        if !self.context.is_grid() || self.settings.space != ResolveSpace::Stored && !rate_one {
            return Method::Blended;
        }
        if rate_one && (self.kinds.opaque || all(|entry, _| entry.is_opaque())) {
            Method::Direct
        } else if !self.kinds.blended || all(|entry, chunk| !matches!(entry.work(chunk), Work::Shaded(..))) {
            Method::Deferred
        } else {
            Method::Blended
        }
    }

    /// The colour of a tile in which nothing else is to be seen, of the ops from `first` on.
    fn only_color(&self, pass: &Pass<'_>, tile: usize, first: (usize, usize)) -> Option<Premultiplied16> {
        let mut entries = visible(&pass.bins, tile, first)
            .flat_map(|(chunk, entries)| entries.iter().map(move |entry| (chunk, entry)));
        let (chunk, only) = entries.next()?;
        if !only.hides_tile() || entries.next().is_some() {
            return None;
        }
        match only.work(&self.chunks[chunk]) {
            Work::Flat(_, color) => Some(color),
            _ => None,
        }
    }

    /// Paints and resolves the tiles of one row.
    fn tile_row<'s>(&'s self, pass: &Pass<'_>, painters: &mut Painters<'s>, mut row: FrameRow<'_>) {
        let stride = self.context.size[0] as usize;
        let columns = self.context.tiles.columns;
        let first = ((row.number - pass.first_row) * columns) as usize;
        for (column, tile) in (0..columns).zip(first..) {
            if pass.cancelled.load(Ordering::Relaxed) {
                return;
            }
            let rect = self.context.tiles.pixels(column, row.number, self.context.size);
            let mut block = PixelBlock::in_rows(rect, row.pixels, stride);
            self.numbered_tile(pass, painters, tile, &mut block);
        }
        row.keep();
        pass.tally.take(&mut painters.tally);
    }

    /// Paints and resolves the tile in `column` and `row`.
    pub(in crate::raster) fn tile<'s>(
        &'s self,
        pass: &Pass<'_>,
        painters: &mut Painters<'s>,
        [column, row]: [u32; 2],
        block: &mut PixelBlock<'_>,
    ) {
        let tile = (row - pass.first_row) * self.context.tiles.columns + column;
        self.numbered_tile(pass, painters, tile as usize, block);
    }

    /// As [`DisplayList::tile`], for a tile counted from the first one of the pass.
    pub(in crate::raster) fn numbered_tile<'s>(
        &'s self,
        pass: &Pass<'_>,
        painters: &mut Painters<'s>,
        tile: usize,
        block: &mut PixelBlock<'_>,
    ) {
        match self.even_pixel(pass, painters, tile) {
            Some(pixel) => block.fill(pixel),
            None => self.paint_tile(pass, painters, tile, block),
        }
    }

    /// The pixel that all of a tile shows, where no sample needs to be looked at to know it.
    fn even_pixel(&self, pass: &Pass<'_>, painters: &mut Painters<'_>, tile: usize) -> Option<u32> {
        let color = if pass.bins.iter().all(|bins| bins.of_tile(tile).is_empty()) {
            self.background()
        } else {
            let first = first_visible(&pass.bins, tile);
            let color = self.only_color(pass, tile, first)?;
            painters.tally.counters.blocks_whole += 1;
            color
        };
        let pixel = color.to_pixel(self.settings.sampling.rules);
        Some(self.settings.palette.map_or(pixel, |palette| recolor(palette, pixel)))
    }

    fn paint_tile<'s>(&'s self, pass: &Pass<'_>, painters: &mut Painters<'s>, tile: usize, block: &mut PixelBlock<'_>) {
        let background = self.background();
        let rules = self.settings.sampling.rules;
        let first = first_visible(&pass.bins, tile);
        for (_, entries) in visible(&pass.bins, tile, first) {
            let whole = entries.iter().filter(|entry| entry.covers_tile()).count() as u64;
            painters.tally.counters.blocks_whole += whole;
            painters.tally.counters.blocks_split += entries.len() as u64 - whole;
        }
        // Looking at the clock costs as much as resolving a few rows.
        let start = tile.is_multiple_of(TIMED).then(Instant::now);
        let mut resolving = None;
        match self.method(pass, tile, first) {
            Method::Direct => {
                let covered = pass.bins[first.0].of_tile(tile).get(first.1);
                if !covered.is_some_and(|entry| entry.hides_tile()) {
                    block.fill(background.to_pixel(rules));
                }
                for (chunk, entries) in visible(&pass.bins, tile, first) {
                    painters
                        .direct
                        .paint((&self.chunks[chunk], entries), &mut painters.bands, block);
                }
                painters.tally.counters.samples_shaded += std::mem::take(&mut painters.direct.samples_shaded);
            }
            Method::Deferred => {
                painters.deferred.begin(block.rect, background);
                for (chunk, entries) in visible(&pass.bins, tile, first) {
                    painters
                        .deferred
                        .paint(&self.chunks[chunk], entries, &mut painters.bands);
                }
                resolving = start.map(|_| Instant::now());
                // Shading comes in between, and is none of it.
                let shading = painters.deferred.resolve(block, start.is_some());
                resolving = resolving.and_then(|start| start.checked_add(shading));
                painters.tally.counters.samples_shaded += std::mem::take(&mut painters.deferred.samples_shaded);
            }
            Method::Blended => {
                painters.blended.begin(block.rect, background);
                for (chunk, entries) in visible(&pass.bins, tile, first) {
                    painters
                        .blended
                        .paint(&self.chunks[chunk], entries, &mut painters.bands);
                }
                resolving = start.map(|_| Instant::now());
                for y in block.rect.y.start..block.rect.y.end {
                    painters.blended.resolve(y, block.line(y));
                }
                painters.tally.counters.samples_shaded += std::mem::take(&mut painters.blended.samples_shaded);
            }
        }
        if let Some(start) = start {
            painters.tally.timed += start.elapsed();
            painters.tally.resolving += resolving.map(|start| start.elapsed()).unwrap_or_default();
        }
        if let Some(palette) = self.settings.palette {
            block.map(|pixel| recolor(palette, pixel));
        }
    }
}

/// What a palette makes of a pixel: its colour number red.
fn recolor(palette: &[u32; 256], pixel: u32) -> u32 {
    let [_, red, ..] = pixel.to_be_bytes();
    palette[usize::from(red)]
}

/// The chunk and the entry in it that painting a tile may start with: the last opaque shape that covers it wholly.
pub(in crate::raster) fn first_visible(bins: &[Arc<Bins>], tile: usize) -> (usize, usize) {
    for (chunk, bins) in bins.iter().enumerate().rev() {
        if let Some(entry) = bins.of_tile(tile).iter().rposition(|entry| entry.hides_tile()) {
            return (chunk, entry);
        }
    }
    (0, 0)
}

/// The entries of a tile from `first` on, chunk by chunk.
fn visible(
    bins: &[Arc<Bins>],
    tile: usize,
    (chunk, entry): (usize, usize),
) -> impl Iterator<Item = (usize, &[TileCommand])> + Clone {
    bins.iter().enumerate().skip(chunk).map(move |(i, bins)| {
        let skip = if i == chunk { entry } else { 0 };
        (i, &bins.of_tile(tile)[skip..])
    })
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};

    use super::*;
    use crate::raster::list::builder::ChunkBuilder;
    use crate::raster::random::{fill, noise};
    use crate::texture::{LevelSampling, PixelSampling};

    const SIZE: [u32; 2] = [70, 50];

    #[test]
    fn tiles_of_any_size_make_the_same_bytes() {
        let texture = noise();
        let sampling = SamplingSettings {
            pixel: PixelSampling::Bilinear,
            level: LevelSampling::Linear,
            ..SamplingSettings::default()
        };
        arbtest::arbtest(|u| {
            let pattern = *u.choose(&SamplePattern::ALL)?;
            let rate = SampleRate::new(*u.choose(&[1, 4, 5, 9, 16, 64, 100])?).expect("a rate");
            let rules = *u.choose(&Rules::ALL)?;
            let settings = RasterSettings {
                rate,
                pattern,
                sampling: SamplingSettings { rules, ..sampling },
                space: *u.choose(&ResolveSpace::ALL)?,
                background: Rgba::WHITE,
                palette: None,
            };
            let seed: Vec<u8> = (0..1500).map(|_| u.arbitrary()).collect::<Result<_>>()?;
            let draw = |tiles: TileLayout| -> Result<Framebuffer> {
                let context = ListContext::with_tiles(SIZE, &settings, tiles);
                let mut builder = ChunkBuilder::new(&context, 12);
                fill(&mut builder, &mut Unstructured::new(&seed))?;
                let list = DisplayList::new(context, settings, vec![builder.finish()], vec![&texture]);
                let mut frame = Framebuffer::new(SIZE[0], SIZE[1]);
                list.rasterize(&mut frame, &AtomicBool::new(false))
                    .expect("not cancelled");
                let mut surface = vec![0x1234_5678; frame.pixels().len()];
                let mut kept = Framebuffer::new(SIZE[0], SIZE[1]);
                list.rasterize_onto(&mut surface, &mut kept, &AtomicBool::new(false))
                    .expect("not cancelled");
                assert!(surface == frame.pixels() && kept == frame, "the same on a surface");
                Ok(frame)
            };
            let expected = draw(TileLayout::for_rate(pattern.nearest(rate), SIZE))?;
            for sides in [(0, 0), (3, 3), (2, 4), (5, 1), (6, 7)] {
                assert!(
                    draw(TileLayout::new(sides, SIZE))? == expected,
                    "tiles of 2^{sides:?} pixels, {pattern:?} {rate:?}"
                );
            }
            Ok(())
        })
        .budget_ms(1000);
    }
}
