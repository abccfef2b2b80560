//! Tiles in which something is to be shaded, where pixels weigh samples of their neighbours, too.
//!
//! Where colours lie in a plane few samples are needed: the weights of a filter are symmetric, so that a weighted sum is the colour in
//! the pixel's middle, but for the rounding of each sample.
//!
//! ```text
//!      g g g g g        all samples around the pixel show one gradient on one stretch of its ramp, or one triangle:
//!      g g # g g        its pixel nearly always follows from the colour in its middle
//!      g g g g g
//! ```
//!
//! Around all other pixels every sample that is seen is shaded, primitive by primitive.

use std::ops::Range;

use fearless_simd::dispatch;

use crate::color::Premultiplied16;
use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::sample_colors::SampleColors;
use crate::raster::paint::visibility::by_samples::{BySamples, SampleShades, TOGETHER, TileSamples, points_of};
use crate::raster::paint::visibility::painter::VisibilityPainter;
use crate::raster::paint::visibility::shading_queue::{Fragment, ShadingQueue, ToShade};
use crate::raster::paint::visibility::surface_shader::SurfaceShader;
use crate::raster::paint::visibility::two_surfaces::TwoSurfaces;
use crate::raster::paint::wide::WideResolve;
use crate::raster::paint::wide::flat::PixelBits;
use crate::raster::shading::context::{BoundedPixels, PixelRun, Pixels, PlacedPixels};
use crate::raster::surface_id::{ROW, SurfaceId, TWO_SURFACES};
use crate::simd;

/// If less than one pixel in so many is known without its samples, all samples of the tile are shaded. Then pixels among others of
/// the same colour are found as well, which helps inside magnified texels.
const FEW: usize = 8;

impl VisibilityPainter<'_> {
    /// Resolves the finished tile. `wide` has found the pixels that lie in the middle of others with the same surface; where that is
    /// flat, `block` has them already.
    pub(super) fn resolve_wide_shaded(
        &mut self,
        colors: &mut SampleColors,
        wide: &mut WideResolve,
        block: &mut PixelBlock<'_>,
    ) {
        let margin = wide.margin();
        self.put_planes(wide, block);
        let flat = wide.flat();
        let mixed: usize = (0..flat.height()).map(|y| flat.mixed(y).count()).sum();
        let all = flat.width() * flat.height();
        // A pixel alone may be asked for all samples around it, whatever it needs.
        if (all - mixed) * FEW < all || all == 1 {
            self.put_shaded_colors(colors, |_| PixelBits::ALL);
            return wide.resolve(colors, block);
        }
        if mixed == 0 {
            return;
        }
        let rows = self.layers.base().rect.y.length();
        let needed: Vec<_> = (0..rows).map(|y| flat.around(y, margin).widened(2 * margin)).collect();
        self.put_shaded_colors(colors, |y| needed[y]);
        wide.flat().note_split(colors);
        wide.resolve_mixed(colors, block);
    }

    /// Puts the pixels in the middle of others with the same surface if its colours lie in a plane there, and tells `wide` which of them
    /// need their samples after all.
    fn put_planes(&mut self, wide: &mut WideResolve, block: &mut PixelBlock<'_>) {
        let margin = wide.margin();
        self.queue_even(wide, margin);
        let unsigned = wide.unsigned();
        let Self {
            context,
            layers,
            surfaces,
            unresolved,
            by_samples,
            ..
        } = self;
        let BySamples { mean, shades, .. } = by_samples;
        let rect = layers.base().rect;
        let grid = context.samples_from([rect.x.start, rect.y.start]);
        let middle = f64::from(grid.side - 1) / 2.0;
        for ToShade { surface, runs, .. } in unresolved.sorted.by_surface() {
            let shader = SurfaceShader::new(context, surfaces.get(surface), &surfaces.stacks);
            let tinted = shader.as_ref().and_then(SurfaceShader::tinted);
            shades.whole.clear();
            for run in runs {
                shades.whole.extend(run.places());
            }
            shades.pixels.clear();
            shades.pixels.resize(shades.whole.len(), 0);
            shades.open.clear();
            let places = &shades.whole;
            let is_known = tinted.zip(unsigned).is_some_and(|((lowest, tints), unsigned)| {
                let bounded = BoundedPixels {
                    margin: u32::try_from(margin).unwrap_or(0),
                    unsigned,
                    ..BoundedPixels::new(Pixels { grid, places }, [middle; 2], tints)
                };
                lowest.bounded_pixels(bounded, mean, &mut shades.pixels, &mut shades.open)
            });
            if !is_known {
                shades.open.clear();
                shades.open.extend(0..shades.whole.len());
            }
            let of_block = |place: [u16; 2]| place.map(|at| usize::from(at) - margin);
            if is_known {
                for (place, pixel) in shades.whole.iter().zip(&shades.pixels) {
                    let [x, y] = of_block(*place);
                    block.line(block.rect.y.start + i32::try_from(y).unwrap_or(0))[x] = *pixel;
                }
            }
            for open in &shades.open {
                wide.flat().mix(of_block(shades.whole[*open]));
            }
        }
    }

    /// Queues the pixels in the middle of others with the same surface, if that is to be shaded.
    fn queue_even(&mut self, wide: &mut WideResolve, margin: usize) {
        let (tile, surfaces) = (self.layers.base(), &self.surfaces);
        self.unresolved.clear();
        let flat = wide.flat();
        let painted = tile.rect.y.start..tile.rect.y.end;
        for (y, (row, of_frame)) in (0..flat.height()).zip((0_u16..).zip(painted).skip(margin)) {
            let shown = &tile.row(of_frame)[margin..];
            for run in flat.mixed(y).others(flat.width()).runs() {
                for alike in alike(&shown[..run.end], run) {
                    let surface = shown[alike.start];
                    if surfaces.get(surface).shaded.is_some() {
                        let columns = alike.start + margin..alike.end + margin;
                        self.unresolved.whole(surface, row, columns);
                    }
                }
            }
        }
        self.unresolved.sort(surfaces.len());
    }

    /// Puts the colours of all samples of the pixels that are needed of each row into `colors`, a tile of the same rectangle.
    fn put_shaded_colors(&mut self, colors: &mut SampleColors, needed: impl Fn(usize) -> PixelBits) {
        self.put_colors(colors, &needed);
        self.queue(needed);
        let Self {
            context,
            layers,
            surfaces,
            unresolved,
            by_samples,
            samples_shaded,
            ..
        } = self;
        let BySamples {
            positions,
            mean,
            shades,
            ..
        } = by_samples;
        let rect = layers.base().rect;
        let grid = context.samples_from([rect.x.start, rect.y.start]);
        let samples = TileSamples { positions, mean, grid };
        let ShadingQueue { places, sorted, .. } = unresolved;
        for ToShade {
            surface,
            runs,
            fragments,
        } in sorted.by_surface()
        {
            let Some(shader) = SurfaceShader::new(context, surfaces.get(surface), &surfaces.stacks) else {
                continue;
            };
            for run in runs {
                colors.put_samples(*run, |colors| shades.shade_run(&shader, samples, *run, colors));
                let shaded = (run.len() * positions.count()) as u64;
                *samples_shaded += shader.evaluations(shaded, run.len());
            }
            for fragments in fragments.chunks(TOGETHER) {
                let shaded = shades.put_fragments(&shader, samples, (fragments, places), colors);
                *samples_shaded += shader.evaluations(shaded as u64, fragments.len());
            }
        }
    }

    /// Queues what is to be shaded of the pixels that are needed of each row.
    fn queue(&mut self, needed: impl Fn(usize) -> PixelBits) {
        let Self {
            layers,
            surfaces,
            unresolved,
            ..
        } = self;
        let tile = layers.base();
        unresolved.clear();
        let is_shaded = |surface: SurfaceId| surfaces.get(surface).shaded.is_some();
        let take = |surface, _| !is_shaded(surface);
        for (row, y) in (0_u16..).zip(tile.rect.y.start..tile.rect.y.end) {
            let shown = tile.shown(y);
            for run in needed(row.into()).first(tile.rect.x.length()).runs() {
                for alike in alike(&shown.whole[..run.end], run) {
                    let surface = shown.whole[alike.start % ROW];
                    if surface < TWO_SURFACES {
                        if is_shaded(surface) {
                            unresolved.whole(surface, row, alike);
                        }
                        continue;
                    }
                    for x in alike {
                        let place = [u16::try_from(x).unwrap_or(u16::MAX), row];
                        if surface == TWO_SURFACES {
                            let TwoSurfaces { mask, first, second } = shown.two_surfaces.get(x);
                            if is_shaded(first) || is_shaded(second) {
                                let parts = [(first, 0, tile.all() & !mask), (second, 0, mask)];
                                unresolved.parts(place, parts.into_iter(), take);
                            }
                        } else if let Some(rows) = tile.word_rows(x, y) {
                            unresolved.split_rows(place, rows, take);
                        } else {
                            unresolved.split(place, tile.samples(x, y), take);
                        }
                    }
                }
            }
        }
        unresolved.sort(surfaces.len());
    }
}

impl SampleShades {
    /// Shades all samples of pixels side by side.
    fn shade_run(
        &mut self,
        shader: &SurfaceShader<'_>,
        TileSamples { positions, grid, .. }: TileSamples<'_>,
        run: PixelRun,
        colors: &mut [Premultiplied16],
    ) {
        self.whole.clear();
        self.whole.extend(run.places());
        self.place(positions, grid);
        let placed = PlacedPixels {
            pixels: Pixels {
                grid,
                places: &self.whole,
            },
            count: positions.count(),
            inside: &self.inside,
            tints: &[],
        };
        if self.points.len() < colors.len() {
            self.points.resize(colors.len(), [0; 2]);
        }
        let points = &mut self.points[..colors.len()];
        dispatch!(simd::level(), simd => points_of(simd, placed, points));
        shader.points(grid, points, colors, &mut self.above);
    }

    /// Shades the samples of fragments of pixels at these places, and puts their colours. How many samples.
    fn put_fragments(
        &mut self,
        shader: &SurfaceShader<'_>,
        samples: TileSamples<'_>,
        (fragments, places): (&[Fragment], &[[u16; 2]]),
        colors: &mut SampleColors,
    ) -> usize {
        self.whole.clear();
        self.whole
            .extend(fragments.iter().map(|part| places[part.pixel as usize]));
        self.place(samples.positions, samples.grid);
        self.gather(fragments, samples.positions, samples.grid);
        self.shade(shader, samples.grid);
        let mut shaded = self.colors[..self.points.len()].iter();
        for (Fragment { first, mask, .. }, place) in fragments.iter().zip(&self.whole) {
            let of_pixel = &mut colors.split_samples(*place)[usize::from(*first)..];
            let mut rest = *mask;
            while rest != 0
                && let Some(color) = shaded.next()
            {
                of_pixel[rest.trailing_zeros() as usize] = *color;
                rest &= rest - 1;
            }
        }
        self.points.len()
    }
}

/// The parts of a run of pixels that show the same.
fn alike(shown: &[SurfaceId], run: Range<usize>) -> impl Iterator<Item = Range<usize>> {
    let mut rest = run;
    std::iter::from_fn(move || {
        let first = shown.get(rest.start).filter(|_| !rest.is_empty())?;
        let length = shown[rest.clone()]
            .iter()
            .take_while(|surface| *surface == first)
            .count();
        let found = rest.start..rest.start + length;
        rest.start = found.end;
        Some(found)
    })
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicBool;

    use arbtest::arbitrary::{self, Result, Unstructured};
    use glam::DVec2;

    use super::*;
    use crate::color::{ResolveSpace, Rgba};
    use crate::raster::list::builder::ChunkBuilder;
    use crate::raster::list::context::ListContext;
    use crate::raster::paint::method::{Method, Rounding};
    use crate::raster::random::{any_filter, check_until, fill, noise};
    use crate::raster::shading::Paint;
    use crate::raster::span::Span;
    use crate::raster::{DisplayList, RasterSettings, SamplePattern, SampleRate, ShadingRate};
    use crate::rules::Rules;
    use crate::texture::SamplingSettings;

    const SIZE: [u32; 2] = [70, 50];

    fn any_settings(u: &mut Unstructured<'_>) -> Result<RasterSettings> {
        Ok(RasterSettings {
            rate: SampleRate::new(*u.choose(&[1, 4, 9, 16, 25, 64])?).expect("a square number"),
            pattern: if u.arbitrary()? {
                SamplePattern::Grid
            } else {
                *u.choose(&SamplePattern::ALL)?
            },
            shading: if u.ratio(1, 4)? {
                ShadingRate::Centre
            } else {
                ShadingRate::Sample
            },
            sampling: SamplingSettings {
                rules: *u.choose(&Rules::ALL)?,
                ..SamplingSettings::default()
            },
            filter: any_filter(u)?,
            space: *u.choose(&ResolveSpace::ALL)?,
            ..RasterSettings::default()
        })
    }

    #[test]
    fn tiles_are_those_of_samples_that_are_painted_one_by_one() {
        let texture = noise();
        let tried = std::cell::Cell::new(0);
        check_until(
            2000,
            || tried.get() > 200,
            |u| {
                let settings = any_settings(u)?;
                if settings.filter.is_plain() {
                    return Ok(());
                }
                let context = ListContext::new(SIZE, &settings);
                let mut builder = ChunkBuilder::new(&context, 12);
                // Below the others something whose colours lie in planes nearly everywhere.
                let mut color = || {
                    let [r, g, b] = u.arbitrary()?;
                    Ok::<_, arbitrary::Error>(Rgba::from_bytes([r, g, b, 255]))
                };
                let corners = [(-20.0, -20.0), (200.0, -20.0), (-20.0, 200.0)].map(|(x, y)| DVec2::new(x, y));
                builder.triangle(corners, &Paint::vertex([color()?, color()?, color()?]));
                fill(&mut builder, u)?;
                let list = DisplayList::new(context, settings, vec![builder.finish()], vec![&texture].into());
                let cancelled = AtomicBool::new(false);
                let tiles = context.tiles;
                let rows = Span {
                    start: 0,
                    end: tiles.rows.cast_signed(),
                };
                let plan = list.plan();
                let pass = list.pass(&plan, rows, &cancelled);
                let (mut painters, chunk) = (list.painters(), &list.chunks[0]);
                for tile in 0..(tiles.columns * tiles.rows) as usize {
                    let first = crate::raster::binning::visible::first_visible(&pass.bins, tile);
                    if list.method(&pass, tile, first) != Method::Visibility(Rounding::Samples) {
                        continue;
                    }
                    let number = u32::try_from(tile).expect("few");
                    let rect = tiles.pixels(number % tiles.columns, number / tiles.columns, SIZE);
                    let (width, height) = (rect.x.length(), rect.y.length());
                    let [mut found, mut expected] = [(); 2].map(|()| vec![0x1234_5678; width * height]);
                    list.paint_tile(
                        &pass,
                        &mut painters,
                        tile,
                        &mut PixelBlock::new(rect, &mut found, width),
                    );
                    let per_sample = &mut painters.per_sample;
                    per_sample.begin(tiles.painted(rect), list.background());
                    per_sample.paint(chunk, pass.bins[0].of_tile(tile), &mut painters.shape_coverage);
                    per_sample.resolve_tile(&mut PixelBlock::new(rect, &mut expected, width));
                    assert_eq!(found, expected, "tile {tile}, {settings:?}");
                    tried.set(tried.get() + 1);
                }
                Ok(())
            },
        );
        assert!(tried.get() > 200, "{} tiles", tried.get());
    }
}
