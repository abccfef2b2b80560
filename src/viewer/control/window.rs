//! The window's pixels below the panels, and which of them changed.

use rayon::ThreadPoolBuilder;

use crate::figure::SampleMark;
use crate::raster::{Framebuffer, Region};
use crate::viewer::PixelRect;
use crate::viewer::frames::drawing::Changes;
use crate::viewer::frames::job::Drawn;
use crate::viewer::frames::present::{WindowPixels, paste, show};
use crate::viewer::inspector::PlacedInset;
use crate::viewer::settings::PixelZoom;
use crate::viewer::state::{Finished, Viewer};

/// Draws an inset with `marks` as far as it lies in `parts`.
fn draw_inset(
    (placed, rgba): (PlacedInset, &dyn Fn(u32, u32) -> Option<[u8; 4]>),
    marks: &[SampleMark],
    parts: &[PixelRect],
    window: &mut WindowPixels<'_>,
) {
    let mut inset = None;
    for part in parts.iter().filter(|part| part.overlaps(&placed.rect)) {
        // What is not final yet is hatched: the inspector shows nothing that is not so.
        let inset = inset.get_or_insert_with(|| placed.inset.draw_pixels(rgba, marks));
        paste(inset, [placed.rect.x, placed.rect.y], window, part);
    }
}

/// Screen pixels as window pixels.
pub(in crate::viewer) fn magnified(rect: &PixelRect, zoom: u32) -> PixelRect {
    PixelRect {
        x: rect.x * i64::from(zoom),
        y: rect.y * i64::from(zoom),
        width: rect.width.saturating_mul(zoom),
        height: rect.height.saturating_mul(zoom),
    }
}

impl Viewer {
    /// The window's pixels below the panels: the frame as the pixel zoom shows it, and the inspector's inset.
    pub fn window_picture(&self) -> Framebuffer {
        let [width, height] = self.chrome.window.map(|side| side.min(Framebuffer::MAX_SIDE));
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
        let composite = self.composite();
        for part in parts {
            show(&composite, self.settings.pixel_zoom, window, part);
        }
        self.draw_over(parts, window);
    }

    /// The part of [`Viewer::draw_parts`] that comes over the frame: the inspector's inset and legends.
    pub fn draw_over(&self, parts: &[PixelRect], window: &mut WindowPixels<'_>) {
        if let Some((placed, frame)) = self.inspector.inset.zip(self.frame()) {
            let rgba = |x, y| frame.final_rgba(x, y);
            draw_inset((placed, &rgba), &self.sample_marks(), parts, window);
        }
        if let Some(placed) = self.inspector.other_inset {
            let rgba = |x, y| self.other_final_rgba(x, y);
            draw_inset((placed, &rgba), &[], parts, window);
        }
        self.draw_legends(parts, window);
    }

    /// From now on the caller draws quick frames with [`Viewer::draw_frame`], soon after [`Viewer::waits_for_surface`] says
    /// so. Otherwise, or where the system gives no threads for it, all frames come from a thread.
    pub fn lend_surface(&mut self) {
        // Threads of their own: in the pool of all others, what is quick would wait for what is slow.
        let threads = rayon::current_num_threads();
        let name = |_| "surface".to_owned();
        let pool = ThreadPoolBuilder::new().num_threads(threads).thread_name(name).build();
        self.frames.surface_pool = pool.ok();
        self.update();
    }

    /// Whether a frame is quick to draw and waits for [`Viewer::draw_frame`].
    pub fn waits_for_surface(&self) -> bool {
        self.frames.drawing.waits_for_surface()
    }

    /// Draws the frame that waits for it, if there is one, so that it is resolved in the window and need not be copied
    /// there. True if `window` holds all of it now, without what [`Viewer::draw_over`] draws; then [`Viewer::take_damage`]
    /// tells what changes from then on. Otherwise the window's pixels are of no use where a frame waited.
    pub fn draw_frame(&mut self, window: &mut WindowPixels<'_>) -> bool {
        let Some(pool) = self.frames.surface_pool.as_ref().filter(|_| self.waits_for_surface()) else {
            return false;
        };
        let drawn = self.frames.drawing.draw_onto(window.size, window.pixels, pool);
        let holds_frame = matches!(drawn, Some(Drawn::Frame { .. }));
        match drawn {
            Some(drawn) => self.take_in(Finished::Drawn(self.frames.drawing.id(), drawn)),
            None => self.frames.drawing.lend_surface(false),
        }
        self.last_shown = None;
        self.update();
        if holds_frame {
            self.take_damage();
        }
        holds_frame
    }

    /// Whether frames are what the window shows, pixel by pixel.
    pub(in crate::viewer) fn shows_plain_frame(&self) -> bool {
        let panes = self.panes();
        self.settings.pixel_zoom == PixelZoom::ONE
            && !self.ab.shows_both()
            && panes.first.corner == [0, 0]
            && panes.frame == self.chrome.window
            && !panes.frame.contains(&0)
            && self.settings.render.background.a >= 1.0
    }

    /// The parts of the window in which [`Viewer::draw_window`] may draw other pixels than when this was asked last;
    /// `None` stands for all of it.
    pub fn take_damage(&mut self) -> Option<Vec<PixelRect>> {
        let (now, changes) = (self.drawn_state(), self.frames.drawing.take_changes());
        let others = self.ab.take_changes();
        let before = self.last_shown.replace(now)?;
        let same_place = before.pixel_zoom == now.pixel_zoom && before.window == now.window;
        let same_comparison = before.comparison[0] == now.comparison[0] && before.panes == now.panes;
        if !same_place || !same_comparison {
            return None;
        }
        let Changes::Regions(mut regions) = changes else {
            return None;
        };
        if self.ab.shows_both() {
            match others {
                Changes::All => return None,
                Changes::Regions(others) => regions.extend(others),
            }
        }
        let mut parts: Vec<PixelRect> = regions.into_iter().flat_map(|region| self.in_window(region)).collect();
        let frame_changed = before.frame != now.frame || before.comparison != now.comparison;
        let inset_changed = before.inset != now.inset
            || before.other_inset != now.other_inset
            || before.samples != now.samples
            || frame_changed;
        if inset_changed {
            let insets = [before.inset, now.inset, before.other_inset, now.other_inset];
            parts.extend(insets.into_iter().flatten().map(|placed| placed.rect));
        }
        if before.legends != now.legends {
            let legends = before.legends.rects.into_iter().chain(now.legends.rects);
            parts.extend(legends.flatten());
        }
        Some(parts)
    }

    /// Where the pinned pixel is to be seen in the window: in every pane that shows it.
    pub fn pinned_places(&self) -> Vec<PixelRect> {
        let Some([x, y]) = self.pinned_pixel() else {
            return Vec::new();
        };
        let (width, height) = (1, 1);
        let places = self.in_window(Region { x, y, width, height }).into_iter();
        places.filter(|place| place.width > 0 && place.height > 0).collect()
    }

    /// Where frame pixels are to be seen in the window: in every pane.
    fn in_window(&self, region: Region) -> Vec<PixelRect> {
        let (zoom, panes) = (self.settings.pixel_zoom.factor(), self.panes());
        let shown = std::iter::once(panes.first).chain(panes.second);
        let places = shown.map(|pane| {
            let moved = PixelRect {
                x: i64::from(region.x) + pane.corner[0],
                y: i64::from(region.y) + pane.corner[1],
                width: region.width,
                height: region.height,
            };
            magnified(&moved.intersection(&pane.area), zoom)
        });
        places.collect()
    }
}
