//! The whole way from a display list to pixels: bins, then rows of tiles on all threads.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use crate::raster::Framebuffer;
use crate::raster::display_list::{DisplayList, Pass};
use crate::raster::frame::row::FrameRow;
use crate::raster::stats::RasterTimes;

impl DisplayList<'_> {
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
            self.context.frame_size,
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
        let [width, height] = self.context.frame_size;
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
        // Painters cost memory and time: a thread makes its own once it gets a row.
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
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};

    use super::*;
    use crate::color::ResolveSpace;
    use crate::raster::list::builder::ChunkBuilder;
    use crate::raster::list::context::ListContext;
    use crate::raster::random::{any_filter, fill, noise};
    use crate::raster::tile_layout::TileLayout;
    use crate::raster::{PixelCoverage, RasterSettings, SamplePattern, SampleRate};
    use crate::rules::Rules;
    use crate::texture::{LevelSampling, PixelSampling, SamplingSettings};

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
                coverage: *u.choose(&[PixelCoverage::Sampled, PixelCoverage::Sampled, PixelCoverage::Exact])?,
                sampling: SamplingSettings { rules, ..sampling },
                filter: any_filter(u)?,
                space: *u.choose(&ResolveSpace::ALL)?,
                ..RasterSettings::default()
            };
            let seed: Vec<u8> = (0..1500).map(|_| u.arbitrary()).collect::<Result<_>>()?;
            let draw = |tiles: TileLayout| -> Result<Framebuffer> {
                let context = ListContext::with_tiles(SIZE, &settings, tiles);
                let mut builder = ChunkBuilder::new(&context, 12);
                fill(&mut builder, &mut Unstructured::new(&seed))?;
                let list = DisplayList::new(context, settings, vec![builder.finish()], vec![&texture].into());
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
            let expected = draw(TileLayout::for_rate(
                settings.sampled().0,
                settings.filter.margin(),
                SIZE,
            ))?;
            for sides in [[0, 0], [3, 3], [2, 4], [5, 1], [6, 7]] {
                assert!(
                    draw(TileLayout::new(sides, SIZE))? == expected,
                    "tiles of 2^{sides:?} pixels, {settings:?}"
                );
            }
            Ok(())
        })
        .budget_ms(1000);
    }
}
