//! Frames: which one is wanted, what is drawn in its stead while the view moves, when to give one up.
//!
//! One frame is drawn at a time, in a thread of its own; the newest request is drawn next. While the view moves and final
//! frames would take longer than the budget, previews are drawn; when the hand rests, final tiles replace them, those
//! nearest to the pointer first. A newer request ends that at once. Without previews a quick frame is left to finish even
//! if a newer one is wanted, since a drag would otherwise show nothing until it ends; a slow one is given up, but
//! never for so long that the window seems dead.
//!
//! Frames that are known to be quick can be drawn by the event loop, straight into the surface that it presents.

#[cfg(test)]
mod surface_tests;
#[cfg(test)]
pub(super) mod tests;

use std::io;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::raster::{Framebuffer, Region};
use crate::render::{CancelToken, FrameStats};
use crate::viewer::frames::budget::{BUDGET, FrameBudget};
use crate::viewer::frames::frame::{ExactCells, Frame, Picture, Preview, PreviewQuality};
use crate::viewer::frames::job::{Drawn, Job, Plan, TilePixels};
use crate::viewer::frames::preview::whole_pixels;
use crate::viewer::frames::request::FrameRequest;
use crate::viewer::jobs::mailbox::Mailbox;
use crate::viewer::jobs::pool::{AtEnd, WorkerPool};

/// Who draws quick frames: the worker, or the event loop straight into the surface that it presents.
#[derive(Debug)]
pub(in crate::viewer) enum Surface {
    /// The worker: the surface stays with the event loop.
    Kept,
    /// The event loop, when a frame is asked for.
    Lent,
    /// The event loop; this frame waits for it.
    Awaited(Box<Job>),
}

/// A final frame that takes longer is given up for a newer request.
const SLOW: Duration = Duration::from_millis(400);

/// Once no new frame has come for this long, the one that is being drawn is left to finish.
const PATIENCE: Duration = Duration::from_secs(2);

/// How long after the last request the hand counts as resting.
pub(in crate::viewer) const REST: Duration = Duration::from_millis(100);

/// Which of the viewer's drawings: the results of all arrive in one channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) enum DrawingId {
    /// There from the start.
    First,
    /// There since a comparison needed it.
    Second,
}

/// The state of drawing.
#[derive(Debug)]
pub(in crate::viewer) struct Drawing {
    id: DrawingId,
    pub(in crate::viewer) workers: WorkerPool<Job>,
    /// The frame on the screen, and the number of the request that it came of.
    frame: Option<Arc<Frame>>,
    frame_wish: u64,
    /// When that was wished.
    frame_since: Instant,
    /// What is to be on the screen.
    wanted: Option<FrameRequest>,
    pub(in crate::viewer) running: Option<Running>,
    /// A picture whose drawing failed: not tried again.
    failed: Option<Picture>,
    pub(in crate::viewer) budget: FrameBudget,
    /// Whether previews may be shown.
    progressive: bool,
    /// Somebody waits for the final frame: no previews, no rest.
    hurry: bool,
    pub(in crate::viewer) surface: Surface,
    last_finished: Instant,
    /// Grows with every change of `frame`.
    number: u64,
    requests: u64,
    changes: Changes,
    /// Memory of an old frame.
    pub(in crate::viewer) spare: Option<Framebuffer>,
}

#[derive(Debug)]
pub(in crate::viewer) struct Running {
    pub(in crate::viewer) request: FrameRequest,
    pub(in crate::viewer) stage: Stage,
    cancel: Arc<CancelToken>,
    pub(in crate::viewer) started: Instant,
    /// Pixels that are final.
    done: u64,
}

/// What a running drawing is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) enum Stage {
    Whole,
    Preview,
    /// Final tiles, as they come.
    Fine,
}

/// What of the frame changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::viewer) enum Changes {
    /// There is another frame.
    All,
    /// These parts.
    Regions(Vec<Region>),
}

impl Drawing {
    pub(in crate::viewer) fn start(mailbox: Mailbox<Drawn>, id: DrawingId) -> io::Result<Self> {
        let work = move |job: Job| job.draw(&|drawn| mailbox.post(drawn));
        Ok(Self {
            id,
            workers: WorkerPool::start("draw", 1, AtEnd::Detach, work)?,
            frame: None,
            frame_wish: 0,
            frame_since: Instant::now(),
            wanted: None,
            running: None,
            failed: None,
            budget: FrameBudget::default(),
            progressive: true,
            hurry: false,
            surface: Surface::Kept,
            last_finished: Instant::now(),
            number: 0,
            requests: 0,
            changes: Changes::All,
            spare: None,
        })
    }

    pub(in crate::viewer) fn id(&self) -> DrawingId {
        self.id
    }

    pub(in crate::viewer) fn frame(&self) -> Option<&Frame> {
        self.frame.as_deref()
    }

    /// When the frame on the screen was wanted.
    pub(in crate::viewer) fn frame_since(&self) -> Instant {
        self.frame_since
    }

    /// The frame for whoever keeps it longer than this state.
    pub(in crate::viewer) fn shared_frame(&self) -> Option<&Arc<Frame>> {
        self.frame.as_ref()
    }

    /// Whether the frame, final or not, shows the scene from where it is wanted, or never will.
    pub(in crate::viewer) fn has_arrived(&self) -> bool {
        let Some(wanted) = &self.wanted else { return true };
        let arrived = |frame: &Frame| frame.picture.is_seen_as(&wanted.picture);
        self.frame().is_some_and(arrived) || self.failed.as_ref() == Some(&wanted.picture)
    }

    /// Since when a scene has been wanted of which nothing is on the screen yet: there is no picture, or another scene's.
    pub(in crate::viewer) fn awaited_since(&self) -> Option<Instant> {
        let wanted = self.wanted.as_ref().filter(|_| !self.has_failed())?;
        let is_seen = self
            .frame()
            .is_some_and(|frame| Arc::ptr_eq(&frame.picture.scene, &wanted.picture.scene));
        (!is_seen).then_some(wanted.since)
    }

    /// What is wanted.
    pub(in crate::viewer) fn wanted(&self) -> Option<&Picture> {
        self.wanted.as_ref().map(|request| &request.picture)
    }

    /// Another number, another frame.
    pub(in crate::viewer) fn number(&self) -> u64 {
        self.number
    }

    /// The frame for threads that outlive this state of the viewer, if it is final and no older than the request of this
    /// number.
    pub(in crate::viewer) fn final_frame(&self, request: u64) -> Option<&Arc<Frame>> {
        let frame = self.frame.as_ref()?;
        (frame.preview.is_none() && self.frame_wish >= request).then_some(frame)
    }

    /// The number of the newest request.
    pub(in crate::viewer) fn newest_request(&self) -> u64 {
        self.requests
    }

    /// Whether the frame shows what is wanted and is final, or never will.
    pub(in crate::viewer) fn is_current(&self) -> bool {
        match &self.wanted {
            None => true,
            Some(wanted) => {
                let is_final = self.frame().is_some_and(|frame| frame.preview.is_none());
                (self.shows(&wanted.picture) && is_final) || self.failed.as_ref() == Some(&wanted.picture)
            }
        }
    }

    fn shows(&self, picture: &Picture) -> bool {
        self.frame().is_some_and(|frame| frame.picture == *picture)
    }

    /// What changed since the last call.
    pub(in crate::viewer) fn take_changes(&mut self) -> Changes {
        std::mem::replace(&mut self.changes, Changes::Regions(Vec::new()))
    }

    /// Since when final tiles are drawn over what is on the screen, and which part of them is there, `0.0..=1.0`.
    pub(in crate::viewer) fn refinement(&self) -> Option<(Instant, f64)> {
        let running = self.running.as_ref()?;
        let is_fine = running.stage == Stage::Fine;
        let [width, height] = running.request.picture.size.map(f64::from);
        is_fine.then_some((running.started, running.done as f64 / (width * height).max(1.0)))
    }

    /// When the drawing is to be asked again: then the hand rests, or nobody came to draw what waits for him. `None` while
    /// there is nothing to wait for.
    pub(in crate::viewer) fn due(&self) -> Option<Instant> {
        if let Some(running) = self.running.as_ref().filter(|_| self.waits_for_surface()) {
            return running.started.checked_add(REST);
        }
        let wanted = self.wanted.as_ref().filter(|_| self.running.is_none())?;
        if self.is_current() {
            return None;
        }
        wanted.since.checked_add(REST)
    }

    /// When the hand counts as resting, if nothing else is wanted until then.
    pub(in crate::viewer) fn rest(&self) -> Option<Instant> {
        self.wanted.as_ref()?.since.checked_add(REST)
    }

    /// Starts what is due.
    pub(in crate::viewer) fn look(&mut self) {
        let waited = self.running.as_ref().map(|running| running.started.elapsed());
        if waited.is_some_and(|waited| waited >= REST) {
            self.wait_no_longer();
        }
        self.next();
    }

    /// Whether previews may be shown.
    pub(in crate::viewer) fn set_progressive(&mut self, progressive: bool) {
        if self.progressive != progressive {
            self.progressive = progressive;
            self.next();
        }
    }

    /// Whether somebody waits for a final frame.
    pub(in crate::viewer) fn set_hurry(&mut self, hurry: bool) {
        if self.hurry != hurry {
            self.hurry = hurry;
            if hurry {
                self.wait_no_longer();
            }
            self.next();
        }
    }

    /// Nothing is to be seen: there is no scene.
    pub(in crate::viewer) fn clear(&mut self) {
        self.wanted = None;
        self.forget_waiting();
        if self.frame.take().is_some() {
            self.changed(Changes::All);
        }
        if let Some(running) = &self.running {
            running.cancel.cancel();
        }
    }

    /// As [`Drawing::clear`], and keeps no memory for the next frame.
    pub(in crate::viewer) fn close(&mut self) {
        self.clear();
        self.spare = None;
    }

    /// This is to be on the screen.
    pub(in crate::viewer) fn want(&mut self, request: FrameRequest) {
        if let Some(wanted) = self.wanted.as_mut().filter(|wanted| wanted.picture == request.picture) {
            (wanted.from, wanted.focus) = (request.from, request.focus);
            return;
        }
        self.forget_waiting();
        if let Some(running) = &self.running
            && running.request.picture != request.picture
            && self.gives_up(running, &request.picture)
        {
            running.cancel.cancel();
        }
        self.requests += 1;
        self.wanted = Some(FrameRequest {
            number: self.requests,
            ..request
        });
        self.next();
    }

    /// Whether a running frame is not worth finishing, now that `newer` is wanted.
    fn gives_up(&self, running: &Running, newer: &Picture) -> bool {
        let before = &running.request.picture;
        let other = !Arc::ptr_eq(&before.scene, &newer.scene) || before.size != newer.size;
        let elapsed = running.started.elapsed();
        match running.stage {
            Stage::Fine => true,
            // Whoever waits is not to be kept waiting for ever by a view that goes on moving.
            Stage::Whole if self.hurry => false,
            Stage::Whole if self.progressive => other || elapsed > 2 * BUDGET,
            _ => {
                let last_took = self.frame().map_or(Duration::ZERO, |frame| frame.stats.total());
                other || is_too_slow(elapsed.max(last_took), self.last_finished.elapsed())
            }
        }
    }

    /// Takes in what the thread has to say; true if there is news for the screen.
    pub(in crate::viewer) fn finished(&mut self, drawn: Drawn) -> bool {
        match drawn {
            Drawn::Frame { frame, ended } => {
                self.note(&frame);
                let fresh = self.wanted.is_some();
                if let Some(running) = self.running.as_ref().filter(|_| fresh) {
                    self.last_finished = Instant::now();
                    (self.frame_wish, self.frame_since) = (running.request.number, running.request.since);
                    let old = self.frame.replace(Arc::from(frame));
                    self.spare = old.and_then(Arc::into_inner).map(|frame| frame.pixels);
                    self.changed(Changes::All);
                }
                if ended {
                    self.end();
                }
                fresh
            }
            Drawn::Tiles { tiles, ended } => {
                let fresh = self.take_tiles(&tiles, ended);
                if ended.is_some() {
                    self.end();
                }
                fresh
            }
            Drawn::GivenUp => {
                if let Some(running) = self.running.take()
                    && running.stage != Stage::Preview
                {
                    self.budget
                        .note_given_up(&running.request.picture, running.started.elapsed());
                }
                self.next();
                false
            }
            Drawn::Failed => {
                self.failed = self.running.take().map(|running| running.request.picture);
                self.next();
                true
            }
        }
    }

    /// Puts final tiles into the frame.
    fn take_tiles(&mut self, tiles: &[TilePixels], ended: Option<FrameStats>) -> bool {
        let (Some(running), Some(frame)) = (&mut self.running, &mut self.frame) else {
            return false;
        };
        let picture = &running.request.picture;
        if self.wanted.is_none() || frame.picture.size != picture.size {
            return false;
        }
        let frame = Arc::make_mut(frame);
        if frame.picture != *picture {
            frame.picture = picture.clone();
            frame.preview = None;
            (self.frame_wish, self.frame_since) = (running.request.number, running.request.since);
        }
        let exact = ExactCells::new(picture.size);
        let quality = PreviewQuality::Earlier;
        let preview = frame.preview.get_or_insert(Preview { quality, exact });
        let mut regions = Vec::with_capacity(tiles.len());
        for tile in tiles {
            tile.put(&mut frame.pixels);
            preview.exact.mark(tile.region);
            running.done += u64::from(tile.region.width) * u64::from(tile.region.height);
            regions.push(tile.region);
        }
        if let Some(stats) = ended {
            (frame.preview, frame.stats) = (None, stats);
            (self.frame_wish, self.frame_since) = (running.request.number, running.request.since);
            self.budget.note(&running.request.picture, None, stats.total());
            self.last_finished = Instant::now();
        }
        self.changed(Changes::Regions(regions));
        true
    }

    /// Learns from the times of a frame.
    fn note(&mut self, frame: &Frame) {
        let quality = frame.preview.as_ref().map(|preview| preview.quality);
        self.budget.note(&frame.picture, quality, frame.stats.total());
    }

    fn end(&mut self) {
        self.running = None;
        self.next();
    }

    fn changed(&mut self, changes: Changes) {
        self.number += 1;
        match (&mut self.changes, changes) {
            (Changes::Regions(all), Changes::Regions(more)) => all.extend(more),
            (_, Changes::All) => self.changes = Changes::All,
            (Changes::All, Changes::Regions(_)) => {}
        }
    }

    /// Whether the renderer failed on what is wanted.
    pub(in crate::viewer) fn has_failed(&self) -> bool {
        let wanted = self.wanted.as_ref().map(|request| &request.picture);
        self.failed.is_some() && self.failed.as_ref() == wanted
    }

    /// Starts what is to be drawn now, if nothing is being drawn.
    fn next(&mut self) {
        if self.running.is_some() || self.is_current() {
            return;
        }
        let Some(request) = self.wanted.clone() else { return };
        let Some(plan) = self.plan(&request) else { return };
        let stage = plan.stage();
        let quick = self.is_quick(&plan, &request);
        let cancel = Arc::new(CancelToken::default());
        let job = Job {
            picture: request.picture.clone(),
            plan,
            cancel: Arc::clone(&cancel),
            spare: self.spare.take(),
            from: request.from,
            focus: request.focus,
        };
        if quick && matches!(self.surface, Surface::Lent) && !self.hurry {
            self.surface = Surface::Awaited(Box::new(job));
        } else {
            self.workers.push(job);
        }
        self.running = Some(Running {
            request,
            stage,
            cancel,
            started: Instant::now(),
            done: 0,
        });
    }

    /// How to come to what is wanted; `None` while a preview of it is on the screen and the hand does not rest.
    fn plan(&self, request: &FrameRequest) -> Option<Plan> {
        let picture = &request.picture;
        if self.hurry || !self.progressive {
            return Some(Plan::Whole);
        }
        if self.shows(picture) {
            return (request.since.elapsed() >= REST).then_some(Plan::Fine);
        }
        let expected = self.budget.whole_frame(picture);
        let before = self
            .frame
            .as_ref()
            .filter(|frame| Arc::ptr_eq(&frame.picture.scene, &picture.scene) && frame.picture.size == picture.size);
        let moved = before.and_then(|frame| Some((frame, whole_pixels(frame, picture)?)));
        if let Some((frame, by)) = moved.filter(|_| expected.is_some() && self.budget.moves(picture)) {
            return Some(Plan::Moved(Arc::clone(frame), by));
        }
        if expected.is_some_and(|expected| expected <= BUDGET) {
            return Some(Plan::Whole);
        }
        // Other settings do not move anything: the picture stays until its final tiles are there.
        if before.is_some_and(|frame| frame.picture.view == picture.view) {
            return Some(Plan::Fine);
        }
        let step = self.budget.step(picture);
        Some(if expected.is_some() && before.is_some() {
            Plan::Coarse(step)
        } else {
            Plan::CoarseThenFine(step)
        })
    }
}

impl Plan {
    fn stage(&self) -> Stage {
        match self {
            Self::Whole => Stage::Whole,
            Self::Coarse(_) | Self::Moved(..) => Stage::Preview,
            Self::CoarseThenFine(_) | Self::Fine => Stage::Fine,
        }
    }
}

/// Whether a frame that takes as long as `takes` is given up for a newer one, `since` the last finished one.
fn is_too_slow(takes: Duration, since: Duration) -> bool {
    takes > SLOW && since < PATIENCE
}

impl Drop for Drawing {
    fn drop(&mut self) {
        // Nobody waits for the thread: a tile of a hundred thousand curves takes seconds, and is looked up from only at its end.
        if let Some(running) = &self.running {
            running.cancel.cancel();
        }
    }
}
