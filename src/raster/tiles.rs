//! The tiles of a frame, each painted and resolved by the painter that it gets.

use std::ops::Range;
use std::sync::atomic::Ordering;
use std::time::Instant;

use crate::color::Premultiplied16;
use crate::raster::binning::tile_command::{TileCommand, Work};
use crate::raster::binning::visible::{EntryIndex, first_visible, visible};
use crate::raster::coverage::shape_coverage::ShapeCoverage;
use crate::raster::display_list::{DisplayList, Pass};
use crate::raster::frame::block::{PixelBlock, fill};
use crate::raster::frame::row::FrameRow;
use crate::raster::paint::direct::DirectPainter;
use crate::raster::paint::method::{Method, Rounding};
use crate::raster::paint::per_sample::PerSamplePainter;
use crate::raster::paint::visibility::painter::{Crowds, VisibilityPainter};
use crate::raster::span::{Span, SpanRect};
use crate::raster::stats::Tally;

/// Of so many chunks it is looked up for whole rows of tiles what these are filled with.
const FEW_CHUNKS: usize = 16;

/// One tile of so many is timed.
const TIMED: usize = 7;

/// Commands that are painted sample by sample before it is looked again whether anybody still waits for them.
const BETWEEN_LOOKS: usize = 16;

/// A painter for each method.
#[derive(Debug)]
pub(in crate::raster) struct Painters<'a> {
    direct: DirectPainter<'a>,
    pub(in crate::raster) visibility: VisibilityPainter<'a>,
    pub(in crate::raster) per_sample: PerSamplePainter<'a>,
    pub(in crate::raster) shape_coverage: ShapeCoverage,
    pub(in crate::raster) tally: Tally,
}

impl DisplayList<'_> {
    /// Painters for one thread.
    pub(in crate::raster) fn painters(&self) -> Painters<'_> {
        self.painters_of(Span {
            start: 0,
            end: self.context.size[0].cast_signed(),
        })
    }

    /// Painters of tiles for which these columns of pixels are painted.
    pub(in crate::raster) fn painters_of(&self, columns: Span) -> Painters<'_> {
        Painters {
            direct: DirectPainter::new(self.shade_context()),
            visibility: VisibilityPainter::new(self.shade_context(), self.places()),
            per_sample: PerSamplePainter::new(self.shade_context(), self.places()),
            shape_coverage: self.shape_coverage(columns),
            tally: Tally::default(),
        }
    }

    /// How a tile is painted, of which the commands from `first` on are to be seen.
    pub(in crate::raster) fn method(&self, pass: &Pass<'_>, tile: usize, first: EntryIndex) -> Method {
        let commands = visible(&pass.bins, tile, first).map(|(chunk, commands)| (&self.chunks[chunk], commands));
        self.kinds
            .method(&self.context, self.settings.filter, self.settings.space, &commands)
    }

    /// The colour of a tile in which nothing else is to be seen, of the commands from `first` on.
    fn only_color(&self, pass: &Pass<'_>, tile: usize, first: EntryIndex) -> Option<Premultiplied16> {
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
    pub(in crate::raster) fn tile_row<'s>(
        &'s self,
        pass: &Pass<'_>,
        painters: &mut Painters<'s>,
        mut row: FrameRow<'_>,
    ) {
        let stride = self.context.frame_size[0] as usize;
        let columns = self.context.tiles.columns;
        let first = ((row.number - pass.first_row) * columns) as usize;
        let shown = self.common_start(pass, first..first + columns as usize);
        if let Some(pixel) = shown {
            fill(row.pixels, pixel);
        }
        for (column, tile) in (0..columns).zip(first..) {
            if pass.cancelled.load(Ordering::Relaxed) {
                return;
            }
            let rect = self.context.tiles.pixels(column, row.number, self.context.frame_size);
            let mut block = PixelBlock::in_rows(rect, row.pixels, stride).showing(shown);
            self.numbered_tile(pass, painters, tile, &mut block);
        }
        if pass.cancelled.load(Ordering::Relaxed) {
            return;
        }
        row.keep();
        pass.tally.take(&mut painters.tally);
    }

    /// The pixel that most of some tiles are filled with, if it is worth filling all of their rows with it at once: tile by
    /// tile the same takes twice the time, since a tile's rows lie far from each other in memory.
    fn common_start(&self, pass: &Pass<'_>, tiles: Range<usize>) -> Option<u32> {
        if self.settings.recolor.is_some() || pass.bins.len() > FEW_CHUNKS {
            return None;
        }
        // Whoever has more than half of the votes is left (Boyer and Moore, MJRTY, 1991); three quarters leave half of them over.
        let least = tiles.len() / 2;
        let (mut pixel, mut votes) = (None, 0);
        for tile in tiles {
            let start = self.start(pass, tile);
            match votes {
                0 => (pixel, votes) = (start, 1),
                _ if pixel == start => votes += 1,
                _ => votes -= 1,
            }
        }
        pixel.filter(|_| votes >= least)
    }

    /// The pixel that a tile is filled with before anything else is painted, if it is.
    fn start(&self, pass: &Pass<'_>, tile: usize) -> Option<u32> {
        let first = first_visible(&pass.bins, tile);
        let mut entries = visible(&pass.bins, tile, first)
            .flat_map(|(chunk, entries)| entries.iter().map(move |entry| (chunk, entry)));
        let color = match entries.next() {
            Some((chunk, entry)) if entry.hides_tile() => match entry.work(&self.chunks[chunk]) {
                Work::Flat(_, color) if self.is_direct() || entries.next().is_none() => color,
                _ => return None,
            },
            Some(_) if !self.is_direct() => return None,
            _ => self.background(),
        };
        Some(color.to_pixel(self.settings.sampling.rules))
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
        Some(self.settings.recolor.map_or(pixel, |recolor| recolor.unclamped(pixel)))
    }

    /// As [`DisplayList::numbered_tile`], with all samples painted; the block is unfinished once the pass is cancelled.
    pub(in crate::raster) fn paint_tile<'s>(
        &'s self,
        pass: &Pass<'_>,
        painters: &mut Painters<'s>,
        tile: usize,
        block: &mut PixelBlock<'_>,
    ) {
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
        let painted = self.context.tiles.painted(block.rect);
        let mut method = if self.tells_clamped() {
            // Others know colours without sums.
            Method::PerSample
        } else {
            self.method(pass, tile, first)
        };
        if let Method::Visibility(rounding) = method
            && !self.paint_surfaces(painters, &visible(&pass.bins, tile, first), painted, rounding)
        {
            method = Method::PerSample;
        }
        match method {
            Method::Direct => {
                let covered = pass.bins[first.chunk].of_tile(tile).get(first.entry);
                let mut rest = first;
                match covered.filter(|entry| entry.hides_tile()) {
                    None => block.fill(background.to_pixel(rules)),
                    Some(covered) => {
                        if let Work::Flat(_, color) = covered.work(&self.chunks[first.chunk]) {
                            block.fill(color.to_pixel(rules));
                            rest.entry += 1;
                        }
                    }
                }
                for (chunk, entries) in visible(&pass.bins, tile, rest) {
                    painters
                        .direct
                        .paint(&self.chunks[chunk], entries, &mut painters.shape_coverage, block);
                }
                painters.tally.counters.samples_shaded += std::mem::take(&mut painters.direct.samples_shaded);
            }
            Method::Visibility(_) => {
                resolving = start.map(|_| Instant::now());
                if let Some((colors, wide)) = painters.per_sample.begin_wide(painted) {
                    painters.visibility.resolve_wide(colors, wide, block);
                } else {
                    // Shading comes in between, and is none of it.
                    let shading = painters.visibility.resolve(block, start.is_some());
                    resolving = resolving.and_then(|start| start.checked_add(shading));
                }
                painters.tally.counters.samples_shaded += std::mem::take(&mut painters.visibility.samples_shaded);
            }
            Method::PerSample => {
                painters.per_sample.begin(painted, background);
                if !self.paint_samples(pass, painters, visible(&pass.bins, tile, first)) {
                    return;
                }
                resolving = start.map(|_| Instant::now());
                painters.per_sample.resolve_tile(block);
                painters.tally.counters.samples_shaded += std::mem::take(&mut painters.per_sample.samples_shaded);
            }
        }
        if let Some(start) = start {
            painters.tally.timed += start.elapsed();
            painters.tally.resolving += resolving.map(|start| start.elapsed()).unwrap_or_default();
        }
        // What takes samples of its neighbours knows what it clamped.
        if let Some(recolor) = self.settings.recolor.filter(|_| !self.tells_clamped()) {
            block.map(|pixel| recolor.unclamped(pixel));
        }
    }

    /// Paints samples one by one by these commands, chunk by chunk; false where the pass is cancelled meanwhile: thousands of
    /// paints over hundreds of samples a pixel take seconds.
    fn paint_samples<'c>(
        &self,
        pass: &Pass<'_>,
        painters: &mut Painters<'_>,
        commands: impl Iterator<Item = (usize, &'c [TileCommand])>,
    ) -> bool {
        for (chunk, entries) in commands {
            for entries in entries.chunks(BETWEEN_LOOKS) {
                if pass.cancelled.load(Ordering::Relaxed) {
                    return false;
                }
                painters
                    .per_sample
                    .paint(&self.chunks[chunk], entries, &mut painters.shape_coverage);
            }
        }
        true
    }

    /// Finds the surfaces that the samples of the tile `painted` show under these commands, chunk by chunk; false where they are
    /// better blended one by one.
    fn paint_surfaces<'s, 'c>(
        &'s self,
        painters: &mut Painters<'s>,
        commands: &(impl Iterator<Item = (usize, &'c [TileCommand])> + Clone),
        painted: SpanRect,
        rounding: Rounding,
    ) -> bool {
        let mut paint = |crowds| {
            let Painters {
                visibility,
                shape_coverage,
                ..
            } = &mut *painters;
            visibility.begin(painted, self.background(), (rounding, crowds));
            let mut commands = commands.clone();
            commands.all(|(chunk, entries)| visibility.paint(&self.chunks[chunk], entries, shape_coverage))
        };
        if paint(Crowds::GivenUp) {
            return true;
        }
        let is_flat = || {
            let mut commands = commands.clone();
            commands.all(|(chunk, entries)| {
                let mut work = entries.iter().map(|entry| entry.work(&self.chunks[chunk]));
                work.all(|work| !matches!(work, Work::Shaded(..)))
            })
        };
        // Sums of flat colours are those of the samples; of those of what is shaded no other method gives the same bytes.
        rounding == Rounding::Sums && !is_flat() && paint(Crowds::Painted)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicBool;

    use glam::DVec2;

    use super::*;
    use crate::color::Rgba;
    use crate::raster::list::builder::ChunkBuilder;
    use crate::raster::list::context::ListContext;
    use crate::raster::shading::Paint;
    use crate::raster::{PixelCoverage, RasterSettings};

    #[test]
    fn tiles_that_are_cancelled_stay_as_they_were() {
        let size = [5, 3];
        // Such areas are blended sample by sample.
        let settings = RasterSettings {
            coverage: PixelCoverage::Exact,
            ..RasterSettings::default()
        };
        let context = ListContext::new(size, &settings);
        let mut builder = ChunkBuilder::new(&context, 1);
        let all = [DVec2::new(-9.0, -9.0), DVec2::new(30.0, 0.0), DVec2::new(0.0, 30.0)];
        let veil = Rgba {
            a: 0.5,
            ..Rgba::opaque(1.0, 0.3, 0.9)
        };
        builder.triangle(all, &Paint::solid(veil));
        let list = DisplayList::new(context, settings, vec![builder.finish()], Vec::new().into());
        let rect = list.context.tiles.pixels(0, 0, size);
        for is_cancelled in [false, true] {
            let cancelled = AtomicBool::new(is_cancelled);
            let pass = list.pass(&list.plan(), Span { start: 0, end: 1 }, &cancelled);
            let before = [0x1234_5678; 15];
            let mut pixels = before;
            let mut painters = list.painters();
            list.paint_tile(&pass, &mut painters, 0, &mut PixelBlock::new(rect, &mut pixels, 5));
            assert_eq!(pixels == before, is_cancelled, "cancelled: {is_cancelled}");
        }
    }
}
