//! Whoever presents the window lends its surface to quick frames, and hears which parts of it are to be painted again.

use rayon::ThreadPoolBuilder;

use crate::viewer::PixelRect;
use crate::viewer::frames::drawing::Changes;
use crate::viewer::frames::job::Drawn;
use crate::viewer::frames::present::WindowPixels;
use crate::viewer::state::{Finished, Viewer};

impl Viewer {
    /// From now on the caller draws quick frames with [`Viewer::draw_frame`], soon after [`Frames::waits_for_surface`](crate::viewer::Frames::waits_for_surface) says
    /// so. Otherwise, or where the system gives no threads for it, all frames come from a thread.
    pub fn lend_surface(&mut self) {
        // Threads of their own: in the pool of all others, what is quick would wait for what is slow.
        let threads = rayon::current_num_threads();
        let name = |_| "surface".to_owned();
        let pool = ThreadPoolBuilder::new().num_threads(threads).thread_name(name).build();
        self.frames.surface_pool = pool.ok();
        self.update();
    }

    /// Draws the frame that waits for it, if there is one, so that it is resolved in the window and need not be copied
    /// there. True if `window` holds all of it now, without what [`WindowContent::draw_over`](crate::viewer::WindowContent::draw_over) draws; then [`Viewer::take_damage`]
    /// tells what changes from then on. Otherwise the window's pixels are of no use where a frame waited.
    pub fn draw_frame(&mut self, window: &mut WindowPixels<'_>) -> bool {
        let Some(pool) = self
            .frames
            .surface_pool
            .as_ref()
            .filter(|_| self.frames.waits_for_surface())
        else {
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

    /// The parts of the window in which [`WindowContent::draw`](crate::viewer::WindowContent::draw) may draw other pixels than when this was asked last;
    /// `None` stands for all of it.
    pub fn take_damage(&mut self) -> Option<Vec<PixelRect>> {
        let (now, changes) = (self.window().drawn_state(), self.frames.drawing.take_changes());
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
        let layout = self.both().layout;
        let mut parts: Vec<PixelRect> = regions
            .into_iter()
            .flat_map(|region| layout.in_window(region))
            .collect();
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
}
