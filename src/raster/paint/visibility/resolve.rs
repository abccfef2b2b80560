//! The second step of a tile: pixels of flat colours are averaged, and what is seen of other paints is shaded, primitive by
//! primitive.

use std::ops::Range;
use std::time::{Duration, Instant};

use fearless_simd::{Simd, dispatch};

use crate::color::{Light, LightResolver, Premultiplied16, Resolver, SampleMean};
use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::method::Rounding;
use crate::raster::paint::put_runs::put_runs;
use crate::raster::paint::short_runs::fill_run;
use crate::raster::paint::visibility::buffer::{Run, Shown, VisibilityBuffer};
use crate::raster::paint::visibility::fragments::Fragments;
use crate::raster::paint::visibility::packed::{lanes, splat};
use crate::raster::paint::visibility::paint_stack::Primitive;
use crate::raster::paint::visibility::painter::VisibilityPainter;
use crate::raster::paint::visibility::shading_queue::ShadingQueue;
use crate::raster::paint::visibility::surface_color::{Shaded, Spread, SurfaceColor};
use crate::raster::paint::visibility::surfaces::SurfaceTable;
use crate::raster::paint::visibility::two_surfaces::TwoSurfaces;
use crate::raster::shading::Shader;
use crate::raster::span::SpanRect;
use crate::raster::surface_id::{MAX_SURFACES, ROW, SurfaceId, TWO_SURFACES};
use crate::simd;

/// What is known of a pixel before anything is shaded: sums over its samples.
trait Known: Default {
    /// Makes pixels of them.
    type Resolver: Copy;

    /// Adds so many samples of a flat colour.
    fn add(&mut self, shown: &SurfaceColor<'_>, count: u32);

    /// The pixel, once all of its samples were added.
    fn pixel(&self, resolver: Self::Resolver) -> u32;

    /// Lets the pixel that was noted last wait with it.
    fn keep(self, unresolved: &mut ShadingQueue);

    /// Adds samples of a surface, unless it is to be shaded.
    #[inline]
    fn taking(&mut self, surfaces: &SurfaceTable<'_>) -> impl FnMut(SurfaceId, u32) -> bool {
        |surface, count| {
            let shown = surfaces.get(surface);
            let is_flat = shown.shaded.is_none();
            if is_flat {
                self.add(shown, count);
            }
            is_flat
        }
    }
}

/// Of what samples store.
impl Known for Spread {
    type Resolver = Resolver;

    #[inline]
    fn add(&mut self, shown: &SurfaceColor<'_>, count: u32) {
        Self::add(self, shown.spread, count);
    }

    #[inline]
    fn pixel(&self, resolver: Resolver) -> u32 {
        resolver.pixel_of_halves(self.halves())
    }

    #[inline]
    fn keep(self, unresolved: &mut ShadingQueue) {
        unresolved.sums.push(self.channels());
    }
}

/// Of their light.
impl Known for Light {
    type Resolver = LightResolver;

    #[inline]
    fn add(&mut self, shown: &SurfaceColor<'_>, count: u32) {
        *self += Self::new(shown.flat).times(count);
    }

    #[inline]
    fn pixel(&self, resolver: LightResolver) -> u32 {
        resolver.pixel(*self)
    }

    #[inline]
    fn keep(self, unresolved: &mut ShadingQueue) {
        unresolved.lights.push(self);
    }
}

/// A row of a tile's pixels.
struct RowRuns {
    /// In the frame, and in the tile.
    y: i32,
    row: u16,
    /// The last pixels of its runs, a bit for each.
    ends: u64,
}

/// Where whole pixels go once they are shaded.
enum Whole<'b, 'p> {
    /// Resolved, into the frame.
    Put(&'b mut PixelBlock<'p>),
    /// The sum of the first one, for whoever asked.
    Keep(Option<[u32; 4]>),
}

impl VisibilityPainter<'_> {
    /// Shades what is seen and resolves the finished tile; how long shading took, if that is to be `timed`.
    pub(crate) fn resolve(&mut self, block: &mut PixelBlock<'_>, timed: bool) -> Duration {
        self.unresolved.clear();
        let SpanRect { x, y } = self.layers.base().rect;
        if !self.surfaces.any_shaded {
            if self.by_samples.is_linear() {
                self.resolve_light(block);
            } else {
                dispatch!(simd::level(), simd => resolve_flat(simd, self, block));
            }
            return Duration::ZERO;
        }
        let mut run_ends = std::mem::take(&mut self.run_ends);
        dispatch!(simd::level(), simd => self.layers.base().run_ends(simd, &mut run_ends));
        for ((y, row), ends) in (y.start..y.end).zip(0..).zip(&run_ends) {
            let row = RowRuns { y, row, ends: *ends };
            match self.by_samples.mean {
                SampleMean::Stored(resolver) => self.resolve_row::<Spread>(row, block.line(y), resolver),
                SampleMean::Linear(resolver) => self.resolve_row::<Light>(row, block.line(y), resolver),
            }
        }
        self.run_ends = run_ends;
        if self.unresolved.is_empty() {
            return Duration::ZERO;
        }
        let start = timed.then(Instant::now);
        self.unresolved.sort(self.surfaces.len());
        let origin = [x.start, y.start];
        if self.rounding == Rounding::Samples {
            self.shade_samples(origin, block);
        } else {
            self.shade(origin, &mut Whole::Put(block));
            self.put_shared(block, |_| true);
        }
        start.map(|start| start.elapsed()).unwrap_or_default()
    }

    /// Puts those of the pixels that several surfaces share, by their numbers, once all of their samples were added up.
    #[inline]
    pub(super) fn put_shared(&self, block: &mut PixelBlock<'_>, is_put: impl Fn(usize) -> bool) {
        let ShadingQueue {
            places, sums, lights, ..
        } = &self.unresolved;
        match &self.by_samples.mean {
            SampleMean::Stored(resolver) => {
                for (_, (place, sums)) in (0..).zip(places.iter().zip(sums)).filter(|(i, _)| is_put(*i)) {
                    block.put(*place, resolver.pixel(*sums));
                }
            }
            SampleMean::Linear(resolver) => {
                for (_, (place, light)) in (0..).zip(places.iter().zip(lights)).filter(|(i, _)| is_put(*i)) {
                    block.put(*place, resolver.pixel(*light));
                }
            }
        }
    }

    /// After a tile of a single pixel was resolved: the sums of its samples' channels, if any of them was shaded.
    pub(crate) fn shaded_sums(&mut self) -> Option<[u32; 4]> {
        if self.unresolved.is_empty() || self.rounding == Rounding::Samples {
            return None;
        }
        self.unresolved.clear();
        let SpanRect { x, y } = self.layers.base().rect;
        let row = RowRuns {
            y: y.start,
            row: 0,
            ends: 0,
        };
        self.resolve_row::<Spread>(row, &mut [0], self.resolver);
        self.unresolved.sort(self.surfaces.len());
        let mut whole = Whole::Keep(None);
        self.shade([x.start, y.start], &mut whole);
        match whole {
            Whole::Keep(Some(sum)) => Some(sum),
            _ => self.unresolved.sums.first().copied(),
        }
    }

    /// Resolves a row in which nothing is to be shaded.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn resolve_flat_row<S: Simd>(&self, simd: S, y: i32, line: &mut [u32]) {
        let Some(flat) = self.surfaces.flat_resolve() else {
            return self.resolve_row_of_many(y, line);
        };
        let shown = self.layers.base().shown(y);
        flat.row(shown.whole, line);
        // Where pixels are shared, what they got there is written over.
        match flat.mixer(simd) {
            Some(mixer) => each_shared(
                &shown,
                line,
                #[inline(always)]
                |two| mixer.pixel(two.first, two.second, two.mask.count_ones()),
                #[inline(always)]
                |x| match self.layers.base().full_packed(x, y) {
                    Some(words) => mixer.pixel_of_packed(words),
                    None => self.resolve_split(x, y),
                },
            ),
            None => each_shared(
                &shown,
                line,
                |two| {
                    self.resolver
                        .pixel_of_halves(self.two_surface_sum(two, two.mask.count_ones()))
                },
                |x| self.resolve_split(x, y),
            ),
        }
    }

    /// As [`VisibilityPainter::resolve_flat_row`] where there are many surfaces.
    #[cold]
    fn resolve_row_of_many(&self, y: i32, line: &mut [u32]) {
        let tile = self.layers.base();
        let row_of_two = tile.two_surfaces(y);
        for ((x, surface), pixel) in tile.row(y).iter().enumerate().zip(line) {
            *pixel = match *surface {
                TWO_SURFACES => {
                    let two = row_of_two.get(x);
                    self.resolver
                        .pixel_of_halves(self.two_surface_sum(two, two.mask.count_ones()))
                }
                surface if usize::from(surface) < MAX_SURFACES => self.surfaces.get(surface).pixel,
                _ => self.resolve_split(x, y),
            };
        }
    }

    /// The pixel in column `x` of the tile and row `y`, which is split and all flat.
    #[inline(never)]
    fn resolve_split(&self, x: usize, y: i32) -> u32 {
        self.resolver
            .pixel_of_halves(flat_sum(self.layers.base(), &self.surfaces, x, y))
    }

    /// The sum of the samples of a pixel that shows two flat colours, `of_second` times the second one.
    #[inline]
    fn two_surface_sum(&self, two: TwoSurfaces, of_second: u32) -> [u64; 2] {
        let [first, second] = [two.first, two.second].map(|surface| self.surfaces.get(surface).spread);
        first.mixed(self.resolver.count(), second, of_second)
    }

    /// Resolves what is flat, and notes what is to be shaded with the sums of what it shares its pixels with.
    fn resolve_row<K: Known>(&mut self, RowRuns { y, row, ends }: RowRuns, line: &mut [u32], resolver: K::Resolver) {
        let (tile, surfaces) = (self.layers.base(), &self.surfaces);
        let unresolved = &mut self.unresolved;
        for (run, range) in tile.runs(y, ends) {
            match run {
                Run::Whole(surface) => {
                    let shown = surfaces.get(surface);
                    if shown.shaded.is_none() {
                        fill_run(&mut line[range], shown.pixel);
                    } else {
                        unresolved.whole(surface, row, range);
                    }
                }
                Run::TwoSurfacePixels => {
                    let row_of_two = tile.two_surfaces(y);
                    for x in columns(range) {
                        let TwoSurfaces { mask, first, second } = row_of_two.get(usize::from(x));
                        let parts = [(first, 0, tile.all() & !mask), (second, 0, mask)];
                        let mut known = K::default();
                        if [first, second]
                            .iter()
                            .all(|surface| surfaces.get(*surface).shaded.is_none())
                        {
                            for (surface, _, mask) in parts {
                                known.add(surfaces.get(surface), mask.count_ones());
                            }
                            line[usize::from(x)] = known.pixel(resolver);
                            continue;
                        }
                        unresolved.parts([x, row], parts.into_iter(), known.taking(surfaces));
                        known.keep(unresolved);
                    }
                }
                Run::Split => {
                    for x in columns(range) {
                        let mut known = K::default();
                        let place = [x, row];
                        if let Some(rows) = tile.word_rows(usize::from(x), y) {
                            unresolved.split_rows(place, rows, known.taking(surfaces));
                        } else {
                            let samples = tile.samples(usize::from(x), y);
                            unresolved.split(place, samples, known.taking(surfaces));
                        }
                        known.keep(unresolved);
                    }
                }
            }
        }
    }

    /// Shades everything that waits; parts of pixels have the colours added to their sums. `origin` is the tile's first pixel.
    fn shade(&mut self, origin: [i32; 2], target: &mut Whole<'_, '_>) {
        let Self {
            context,
            resolver,
            surfaces,
            unresolved,
            fragments: shading,
            values,
            samples_shaded,
            ..
        } = self;
        let ShadingQueue {
            places, sums, sorted, ..
        } = unresolved;
        let grid = context.samples_from(origin);
        for to_shade in sorted.by_surface() {
            let (runs, parts) = (to_shade.runs, to_shade.fragments);
            let shown = surfaces.get(to_shade.surface);
            let Some(Shaded { primitive, kept, .. }) = shown.shaded else {
                continue;
            };
            let Primitive { corners, paint } = primitive;
            let shader = Shader::new(context, corners, paint);
            let pixels: usize = runs.iter().map(|run| run.len()).sum();
            values.resize(values.len().max(pixels), 0);
            let count = resolver.count();
            let mut whole = Fragments {
                runs,
                is_level: paint.is_level(context),
                parts,
                places,
                count,
            };
            let (mut means, nothing_above) = (None, kept == Premultiplied16::ONE);
            if let Whole::Put(block) = target
                && nothing_above
            {
                if shader.runs(runs, grid, resolver, &mut values[..pixels]) {
                    *samples_shaded += shader.evaluations(pixels as u64 * u64::from(count), pixels);
                    put_runs(runs, false, values, block);
                    whole.runs = &[];
                } else {
                    means = Some((&*resolver, &mut values[..pixels]));
                }
            }
            let are_means = shading.find(whole, grid, &shader, means);
            let found = shading.whole_sums();
            *samples_shaded += shader.evaluations(found.len() as u64 * u64::from(count), found.len());
            if !are_means {
                shown.over_each_shaded(found, kept, count);
            }
            match target {
                Whole::Keep(kept) => *kept = found.first().copied().or(*kept),
                Whole::Put(block) => {
                    if !are_means {
                        resolver.pixels(found, values);
                    }
                    put_runs(whole.runs, whole.is_level, values, block);
                }
            }
            let of_parts = shading.each_part(whole, grid, &shader, |pixel, found, samples| {
                let found = shown.over_shaded(found, kept, samples);
                for (sum, channel) in sums[pixel as usize].iter_mut().zip(found) {
                    *sum += channel;
                }
            });
            *samples_shaded += shader.evaluations(of_parts, parts.len());
        }
    }
}

/// Columns of a tile as numbers as short as the queue has them.
pub(super) fn columns(range: Range<usize>) -> impl Iterator<Item = u16> {
    (0_u16..).take(range.end).skip(range.start)
}

/// Resolves the pixels of a row that show two surfaces or are split, by what each is and by its column.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
pub(super) fn each_shared(
    shown: &Shown<'_>,
    pixels: &mut [u32],
    mut of_two: impl FnMut(TwoSurfaces) -> u32,
    of_split: impl Fn(usize) -> u32,
) {
    let mut rest = shown.shared;
    while rest != 0 {
        let x = rest.trailing_zeros() as usize;
        rest &= rest - 1;
        let Some(pixel) = pixels.get_mut(x) else {
            return;
        };
        let surface = shown.whole[x % ROW];
        if surface == TWO_SURFACES {
            *pixel = of_two(shown.two_surfaces.get(x));
        } else if usize::from(surface) > MAX_SURFACES {
            *pixel = of_split(x);
        }
    }
}

/// Resolves a tile in which nothing is to be shaded.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn resolve_flat<S: Simd>(simd: S, painter: &VisibilityPainter<'_>, block: &mut PixelBlock<'_>) {
    simd.vectorize(
        #[inline(always)]
        || {
            let rows = block.rect.y;
            for y in rows.start..rows.end {
                painter.resolve_flat_row(simd, y, block.line(y));
            }
        },
    );
}

/// The sum of a split pixel's samples where all of them are flat.
#[inline]
fn flat_sum(tile: &VisibilityBuffer, surfaces: &SurfaceTable<'_>, x: usize, y: i32) -> [u64; 2] {
    let mut sum = Spread::default();
    tile.each_packed(x, y, |word, used| {
        let shown = lanes(word);
        if word == splat(shown[0]) {
            sum.add(surfaces.get(shown[0]).spread, used);
        } else {
            for surface in &shown[..used as usize] {
                sum.add_one(surfaces.get(*surface).spread);
            }
        }
    });
    sum.halves()
}
