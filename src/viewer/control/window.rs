//! The window's pixels below the panels.

use crate::raster::Framebuffer;
use crate::viewer::PixelRect;
use crate::viewer::control::both::Both;
use crate::viewer::frames::present::{WindowPixels, paste, show};
use crate::viewer::inspector::PlacedInset;
use crate::viewer::inspector::state::Inspection;
use crate::viewer::state::DrawnState;

/// What the window shows below the panels: the frame as the pixel zoom shows it, the inspector's inset, legends.
#[derive(Clone, Copy, Debug)]
pub struct WindowContent<'a> {
    pub(in crate::viewer) both: Both<'a>,
    pub(in crate::viewer) inspector: &'a Inspection,
}

/// Pastes an inset as far as it lies in `parts`; it is drawn only where it does.
fn draw_inset(placed: PlacedInset, parts: &[PixelRect], window: &mut WindowPixels<'_>, draw: impl Fn() -> Framebuffer) {
    let mut inset = None;
    for part in parts.iter().filter(|part| part.overlaps(&placed.rect)) {
        paste(
            inset.get_or_insert_with(&draw),
            [placed.rect.x, placed.rect.y],
            window,
            part,
        );
    }
}

impl WindowContent<'_> {
    /// All of it as a picture.
    pub fn picture(&self) -> Framebuffer {
        let [width, height] = self.both.layout.window().map(|side| side.min(Framebuffer::MAX_SIDE));
        let mut window = Framebuffer::new(width, height);
        self.draw(&mut window);
        window
    }

    /// As [`WindowContent::picture`], into pixels that are there already.
    pub fn draw(&self, window: &mut Framebuffer) {
        let all = PixelRect::of_size([window.width(), window.height()]);
        self.draw_parts(&[all], &mut WindowPixels::of(window));
    }

    /// As [`WindowContent::draw`], but only the pixels in `parts`.
    pub fn draw_parts(&self, parts: &[PixelRect], window: &mut WindowPixels<'_>) {
        let composite = self.both.composite();
        for part in parts {
            show(&composite, self.both.settings.pixel_zoom, window, part);
        }
        self.draw_over(parts, window);
    }

    /// The part of [`WindowContent::draw_parts`] that comes over the frame: the inspector's inset and legends.
    pub fn draw_over(&self, parts: &[PixelRect], window: &mut WindowPixels<'_>) {
        if let Some((placed, frame)) = self.inspector.inset.zip(self.both.frames.frame()) {
            // What is not final yet is hatched: the inspector shows nothing that is not so.
            let rgba = |x, y| frame.final_rgba(x, y);
            let marks = self.inspector.sample_marks();
            draw_inset(placed, parts, window, || placed.inset.draw_pixels(&rgba, &marks));
        }
        if let Some(placed) = self.inspector.other_inset {
            let rgba = |x, y| self.both.ab.other_final_rgba(x, y);
            draw_inset(placed, parts, window, || placed.inset.draw_pixels(&rgba, &[]));
        }
        self.both.frames.legends.draw(parts, window);
    }

    /// What decides these pixels.
    pub(in crate::viewer) fn drawn_state(&self) -> DrawnState {
        DrawnState {
            frame: self.both.frames.drawing.number(),
            comparison: self.both.ab.state(),
            panes: self.both.layout.panes(),
            samples: self.inspector.samples.number(),
            inset: self.inspector.inset,
            other_inset: self.inspector.other_inset,
            legends: self.both.frames.legends.places(),
            pixel_zoom: self.both.settings.pixel_zoom,
            window: self.both.layout.window(),
        }
    }
}
