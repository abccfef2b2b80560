//! What the samples of a tile show, one by one: for pixels that weigh samples of their neighbours, too.
//!
//! Most pixels lie in the middle of others that show the same surface. Where that is flat they need no samples: they are found, and put,
//! by their surfaces, and colours are looked up only around the rest. Of what is to be shaded see `wide_shades`.

use fearless_simd::{Simd, dispatch};

use crate::color::Premultiplied16;
use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::sample_colors::SampleColors;
use crate::raster::paint::visibility::buffer::VisibilityBuffer;
use crate::raster::paint::visibility::packed::{PER_WORD, lanes};
use crate::raster::paint::visibility::painter::VisibilityPainter;
use crate::raster::paint::visibility::row_bits::{equal, equal_to_next, whole};
use crate::raster::paint::visibility::surfaces::SurfaceTable;
use crate::raster::paint::wide::WideResolve;
use crate::raster::paint::wide::flat::{FlatPixels, PixelBits, RowLikeness};
use crate::raster::span::SpanRect;
use crate::raster::surface_id::{ROW, SPLIT, SurfaceId, TWO_SURFACES};
use crate::simd;

impl VisibilityPainter<'_> {
    /// Resolves the finished tile: `colors` is one of the same rectangle, with a margin around the pixels of `block`.
    pub(crate) fn resolve_wide(
        &mut self,
        colors: &mut SampleColors,
        wide: &mut WideResolve,
        block: &mut PixelBlock<'_>,
    ) {
        let margin = wide.margin();
        dispatch!(simd::level(), simd => resolve_flat(simd, self, (wide.flat(), margin), block));
        if self.surfaces.any_shaded {
            return self.resolve_wide_shaded(colors, wide, block);
        }
        // A pixel alone may be asked for all samples around it, flat or not.
        let is_alone = block.rect.x.length() * block.rect.y.length() == 1;
        if is_alone {
            self.put_colors(colors, |_| PixelBits::ALL);
        } else if !wide.flat().are_all() {
            let flat = wide.flat();
            self.put_colors(colors, |y| flat.around(y, margin).widened(2 * margin));
        }
        wide.resolve_mixed(colors, block);
    }

    /// Puts the colours of samples of the finished tile into one of the same rectangle: of those pixels of each row that are needed.
    /// Samples that are still to be shaded get an arbitrary colour.
    pub(super) fn put_colors(&self, colors: &mut SampleColors, needed: impl Fn(usize) -> PixelBits) {
        dispatch!(simd::level(), simd => put_colors(simd, self, colors, &needed));
    }
}

/// Finds the pixels in the middle of others that show the same surface, and puts those whose surface is flat.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn resolve_flat<S: Simd>(
    simd: S,
    painter: &VisibilityPainter<'_>,
    (flat, margin): (&mut FlatPixels, usize),
    block: &mut PixelBlock<'_>,
) {
    simd.vectorize(
        #[inline(always)]
        || {
            let (tile, surfaces) = (painter.layers.base(), &painter.surfaces);
            find_flat(simd, tile, flat, margin);
            let rows = tile.rect.y.start..tile.rect.y.end;
            for ((row, painted), y) in rows.skip(margin).enumerate().zip(block.rect.y.start..block.rect.y.end) {
                let (shown, line) = (&tile.row(painted)[margin..], block.line(y));
                // Pixels that are still to be shaded get an arbitrary colour.
                for run in flat.mixed(row).others(flat.width()).runs() {
                    put_flat(surfaces, &shown[run.clone()], &mut line[run], margin);
                }
            }
        },
    );
}

/// Puts flat pixels side by side, which show these surfaces.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn put_flat(surfaces: &SurfaceTable<'_>, shown: &[SurfaceId], pixels: &mut [u32], margin: usize) {
    if margin > 0 {
        // They are among each other's neighbours, and so of one surface.
        pixels.fill(surfaces.get(shown[0]).pixel);
        return;
    }
    for (pixel, surface) in pixels.iter_mut().zip(shown) {
        *pixel = surfaces.get(*surface).pixel;
    }
}

/// Finds the pixels in the middle of others that show the same surface.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn find_flat<S: Simd>(simd: S, tile: &VisibilityBuffer, flat: &mut FlatPixels, margin: usize) {
    let SpanRect { x, y } = tile.rect;
    let unused = !PixelBits::ALL.first(x.length()).word();
    flat.begin(x.length(), margin);
    let mut last: Option<&[SurfaceId; ROW]> = None;
    for y in y.start..y.end {
        let row = tile.shown(y).whole;
        let above = last.map_or(0, |above| equal(simd, row, above));
        last = Some(row);
        if above | unused == u64::MAX {
            flat.repeat();
            continue;
        }
        let whole = whole(simd, row);
        let pairs = equal_to_next(simd, row) & whole & whole >> 1;
        flat.push(
            RowLikeness {
                whole: whole.into(),
                pairs: pairs.into(),
                above: above.into(),
            },
            margin,
        );
    }
    flat.finish(margin);
}

/// Puts the colours of the samples of some pixels of each row.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn put_colors<S: Simd>(
    simd: S,
    painter: &VisibilityPainter<'_>,
    colors: &mut SampleColors,
    needed: &impl Fn(usize) -> PixelBits,
) {
    simd.vectorize(
        #[inline(always)]
        || {
            let (tile, surfaces) = (painter.layers.base(), &painter.surfaces);
            let per_pixel = colors.per_pixel();
            let rect = tile.rect;
            for (row, y) in (rect.y.start..rect.y.end).enumerate() {
                let needed = needed(row).first(rect.x.length());
                if needed.is_empty() {
                    continue;
                }
                let (whole, split, samples) = colors.row_to_put(y);
                let shown = tile.shown(y);
                for run in needed.runs() {
                    split[run.clone()].fill(false);
                    let mut latest = (SPLIT, Premultiplied16::TRANSPARENT);
                    for x in run {
                        let surface = shown.whole[x % ROW];
                        if surface < TWO_SURFACES {
                            if surface != latest.0 {
                                latest = (surface, surfaces.get(surface).flat);
                            }
                            whole[x] = latest.1;
                            continue;
                        }
                        split[x] = true;
                        let samples = &mut samples[x * per_pixel..][..per_pixel];
                        if surface == TWO_SURFACES {
                            let two = shown.two_surfaces.get(x);
                            let both = [two.first, two.second].map(|surface| surfaces.get(surface).flat);
                            choose(two.mask, both, samples);
                        } else {
                            put_each(tile.rows_of_words(x, y).zip(samples.chunks_mut(tile.side())), surfaces);
                        }
                    }
                }
            }
        },
    );
}

/// Puts the colours of a split pixel's samples, row by row.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn put_each<'p>(rows: impl Iterator<Item = (&'p [u64], &'p mut [Premultiplied16])>, surfaces: &SurfaceTable<'_>) {
    for (words, samples) in rows {
        for (samples, word) in samples.chunks_mut(PER_WORD).zip(words) {
            for (sample, surface) in samples.iter_mut().zip(lanes(*word)) {
                *sample = surfaces.get(surface).flat;
            }
        }
    }
}

/// Lets samples show the second colour where the bit of their number is set, and else the first.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn choose(mask: u64, [first, second]: [Premultiplied16; 2], samples: &mut [Premultiplied16]) {
    let color = |bits: u64| if bits & 1 == 1 { second } else { first };
    let (eights, rest) = samples.as_chunks_mut::<8>();
    let mut bits = mask;
    // Written out eight at a time, which compilers make vectors of.
    for [a, b, c, d, e, f, g, h] in eights {
        (*a, *b, *c, *d) = (color(bits), color(bits >> 1), color(bits >> 2), color(bits >> 3));
        (*e, *f, *g, *h) = (color(bits >> 4), color(bits >> 5), color(bits >> 6), color(bits >> 7));
        bits >>= 8;
    }
    for sample in rest {
        *sample = color(bits);
        bits >>= 1;
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicBool;

    use super::*;
    use crate::color::{ResolveSpace, Rgba};
    use crate::raster::binning::tile_command::Work;
    use crate::raster::list::builder::ChunkBuilder;
    use crate::raster::list::context::ListContext;
    use crate::raster::paint::method::Rounding;
    use crate::raster::paint::visibility::painter::Crowds;
    use crate::raster::random::{any_filter, fill, noise};
    use crate::raster::span::Span;
    use crate::raster::{DisplayList, RasterSettings, SamplePattern, SampleRate};
    use crate::rules::Rules;
    use crate::texture::SamplingSettings;

    const SIZE: [u32; 2] = [70, 50];

    #[test]
    fn tiles_are_those_whose_colors_are_all_looked_at() {
        let texture = noise();
        let mut tried = 0;
        arbtest::arbtest(|u| {
            let settings = RasterSettings {
                rate: SampleRate::new(*u.choose(&[1, 4, 9, 16, 25, 64, 100])?).expect("a square number"),
                pattern: *u.choose(&SamplePattern::ALL)?,
                sampling: SamplingSettings {
                    rules: *u.choose(&Rules::ALL)?,
                    ..SamplingSettings::default()
                },
                filter: any_filter(u)?,
                space: *u.choose(&ResolveSpace::ALL)?,
                background: *u.choose(&[Rgba::WHITE, Rgba::TRANSPARENT])?,
                ..RasterSettings::default()
            };
            let context = ListContext::new(SIZE, &settings);
            let mut builder = ChunkBuilder::new(&context, 12);
            fill(&mut builder, u)?;
            let list = DisplayList::new(context, settings, vec![builder.finish()], vec![&texture].into());
            let cancelled = AtomicBool::new(false);
            let tiles = context.tiles;
            let rows = Span {
                start: 0,
                end: tiles.rows.cast_signed(),
            };
            let pass = list.pass(&list.plan(), rows, &cancelled);
            let (mut painters, chunk) = (list.painters(), &list.chunks[0]);
            for tile in 0..tiles.columns * tiles.rows {
                let commands = pass.bins[0].of_tile(tile as usize);
                if commands
                    .iter()
                    .any(|command| matches!(command.work(chunk), Work::Shaded(..)))
                {
                    continue;
                }
                let rect = tiles.pixels(tile % tiles.columns, tile / tiles.columns, SIZE);
                let painted = tiles.painted(rect);
                let visibility = &mut painters.visibility;
                visibility.begin(painted, list.background(), (Rounding::Sums, Crowds::Painted));
                assert!(
                    visibility.paint(chunk, commands, &mut painters.shape_coverage),
                    "not so many"
                );
                let (width, height) = (rect.x.length(), rect.y.length());
                let [mut found, mut expected] = [(); 2].map(|()| vec![0x1234_5678; width * height]);
                let Some((colors, wide)) = painters.per_sample.begin_wide(painted) else {
                    continue;
                };
                // First, as long as the colours are those of the tile before.
                visibility.resolve_wide(colors, wide, &mut PixelBlock::new(rect, &mut found, width));
                visibility.put_colors(colors, |_| PixelBits::ALL);
                wide.resolve(colors, &mut PixelBlock::new(rect, &mut expected, width));
                assert_eq!(found, expected, "tile {tile}, {settings:?}");
                tried += 1;
            }
            Ok(())
        })
        .budget_ms(2000);
        assert!(tried > 20, "{tried} tiles");
    }
}
