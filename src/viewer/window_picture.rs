//! The window's pixels below the panels, and which of them changed.

use super::drawing::Changes;
use super::present::{paste, show};
use super::{PixelRect, PlacedInset, Viewer, WindowPixels};
use crate::raster::{Framebuffer, Region};

impl Viewer {
    /// The window's pixels below the panels: the frame as the pixel zoom shows it, and the inspector's inset.
    pub fn window_picture(&self) -> Framebuffer {
        let [width, height] = self.screen.window.map(|side| side.min(Framebuffer::MAX_SIDE));
        let mut window = Framebuffer::new(width, height);
        self.draw_window(&mut window);
        window
    }

    /// As [`Viewer::window_picture`], into pixels that are there already.
    pub fn draw_window(&self, window: &mut Framebuffer) {
        let all = PixelRect::of_size([window.width(), window.height()]);
        self.draw_parts(&[all], &mut WindowPixels::of(window));
    }

    /// As [`Viewer::draw_window`], but only the pixels in `parts`.
    pub fn draw_parts(&self, parts: &[PixelRect], window: &mut WindowPixels<'_>) {
        let empty = Framebuffer::default();
        let pixels = self.frame().map_or(&empty, |frame| &frame.pixels);
        for part in parts {
            show(pixels, self.settings.pixel_zoom, window, part);
        }
        let Some((placed, frame)) = self.inset.zip(self.frame()) else {
            return;
        };
        let mut inset = None;
        for part in parts.iter().filter(|part| part.overlaps(&placed.rect)) {
            // What is not final yet is hatched: the inspector shows nothing that is not so.
            let inset = inset.get_or_insert_with(|| {
                placed
                    .inset
                    .draw_pixels(&|x, y| frame.final_rgba(x, y), &self.sample_marks())
            });
            paste(inset, [placed.rect.x, placed.rect.y], window, part);
        }
    }

    /// The parts of the window in which [`Viewer::draw_window`] may draw other pixels than when this was asked last;
    /// `None` stands for all of it.
    pub fn take_damage(&mut self) -> Option<Vec<PixelRect>> {
        let (now, changes) = (self.drawn_state(), self.drawing.take_changes());
        let before = self.last_shown.replace(now)?;
        if before.pixel_zoom != now.pixel_zoom || before.window != now.window {
            return None;
        }
        let Changes::Regions(regions) = changes else {
            return None;
        };
        let zoom = self.settings.pixel_zoom.factor();
        let mut parts: Vec<PixelRect> = regions.into_iter().map(|region| magnified(region, zoom)).collect();
        let inset_changed = before.inset != now.inset || before.samples != now.samples || before.frame != now.frame;
        if inset_changed {
            let rect = |placed: Option<PlacedInset>| placed.map(|placed| placed.rect);
            parts.extend(rect(before.inset).into_iter().chain(rect(now.inset)));
        }
        Some(parts)
    }
}

/// Frame pixels as window pixels.
fn magnified(region: Region, zoom: u32) -> PixelRect {
    PixelRect {
        x: i64::from(region.x) * i64::from(zoom),
        y: i64::from(region.y) * i64::from(zoom),
        width: region.width.saturating_mul(zoom),
        height: region.height.saturating_mul(zoom),
    }
}
