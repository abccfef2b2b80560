//! Quick frames that the event loop draws itself, straight into the surface that it presents.

use std::time::{Duration, Instant};

use rayon::ThreadPool;

use crate::viewer::frames::budget::{BUDGET, QUICK};
use crate::viewer::frames::drawing::{Drawing, Stage, Surface};
use crate::viewer::frames::frame::PreviewQuality;
use crate::viewer::frames::job::{Drawn, Job, Plan};
use crate::viewer::frames::request::FrameRequest;

/// When a frame that is drawn into the surface is given up: the window must not stand still.
const LONGEST: Duration = BUDGET.saturating_mul(2);

impl Drawing {
    /// Whether the event loop draws quick frames with [`Drawing::draw_onto`]: a frame is what the surface shows, pixel by pixel.
    pub(in crate::viewer) fn lend_surface(&mut self, lends: bool) {
        match (lends, &self.surface) {
            (true, Surface::Kept) => self.surface = Surface::Lent,
            (false, _) => {
                self.wait_no_longer();
                self.surface = Surface::Kept;
            }
            _ => {}
        }
    }

    /// Whether a frame waits for [`Drawing::draw_onto`].
    pub(in crate::viewer) fn waits_for_surface(&self) -> bool {
        matches!(self.surface, Surface::Awaited(_))
    }

    /// Draws the frame that waits for that into `surface`, rows of the frame's `size`, in `pool`, which must have nothing
    /// else to do: in another the caller would wait for that, too. What comes of it is to be taken in with
    /// [`Drawing::finished`]. `None` where none waits or it has another size.
    pub(in crate::viewer) fn draw_onto(
        &mut self,
        size: [u32; 2],
        surface: &mut [u32],
        pool: &ThreadPool,
    ) -> Option<Drawn> {
        if !matches!(&self.surface, Surface::Awaited(job) if job.picture.size == size) {
            return None;
        }
        let job = self.take_waiting()?;
        let running = self.running.as_mut()?;
        running.started = Instant::now();
        let drawn = job.draw_onto(surface, pool, LONGEST);
        if matches!(drawn, Drawn::GivenUp) && running.stage == Stage::Preview {
            let (picture, took) = (&running.request.picture, running.started.elapsed());
            self.budget.note(picture, Some(PreviewQuality::RateOne), took);
        }
        Some(drawn)
    }

    pub(in crate::viewer) fn take_waiting(&mut self) -> Option<Job> {
        if !self.waits_for_surface() {
            return None;
        }
        match std::mem::replace(&mut self.surface, Surface::Lent) {
            Surface::Awaited(job) => Some(*job),
            Surface::Kept | Surface::Lent => None,
        }
    }

    /// Hands what waits to be drawn where it is shown to the thread.
    pub(in crate::viewer) fn wait_no_longer(&mut self) {
        if let Some(job) = self.take_waiting() {
            self.workers.push(job);
        }
    }

    /// Drops it.
    pub(in crate::viewer) fn forget_waiting(&mut self) {
        if let Some(job) = self.take_waiting() {
            (self.running, self.spare) = (None, job.spare);
        }
    }

    /// Whether a frame is known to take so little time that it can be drawn where it is shown.
    pub(in crate::viewer) fn is_quick(&self, plan: &Plan, request: &FrameRequest) -> bool {
        let expected = match plan {
            Plan::Whole => self.budget.whole_frame(&request.picture),
            // What the inspector shows is drawn over the preview, which takes two steps.
            Plan::Coarse(PreviewQuality::RateOne) if request.focus.is_none() => {
                self.budget.step_cost(&request.picture, PreviewQuality::RateOne)
            }
            _ => None,
        };
        expected.is_some_and(|expected| expected <= QUICK)
    }
}
