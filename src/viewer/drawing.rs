//! Frames: which one is wanted, which is being drawn, when to give one up.
//!
//! One frame is drawn at a time, in a thread of its own; the newest wish is drawn next. A quick frame is left to
//! finish even if a newer one is wanted, since a drag would otherwise show nothing until it ends; a slow one is given
//! up, but never for so long that the window seems dead.

use std::io;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::background::{AtEnd, Crew, Mailbox, guarded};
use super::state::Finished;
use super::{Frame, Picture};
use crate::raster::Framebuffer;
use crate::render::{CancelToken, draw_cancellable};

/// A frame that takes longer is given up for a newer wish.
const SLOW: Duration = Duration::from_millis(400);
/// After so long without a new frame, the one that is drawn is left to finish.
const PATIENCE: Duration = Duration::from_secs(2);

/// The state of drawing.
#[derive(Debug)]
pub(super) struct Drawing {
    crew: Crew<Job>,
    /// The frame on the screen.
    frame: Option<Arc<Frame>>,
    /// What is to be on the screen.
    wanted: Option<Picture>,
    running: Option<Running>,
    /// A picture whose drawing failed: not tried again.
    failed: Option<Picture>,
    last_finished: Instant,
    /// Grows with every change of `frame`.
    number: u64,
    /// Memory of an old frame.
    spare: Option<Framebuffer>,
}

#[derive(Debug)]
struct Running {
    picture: Picture,
    cancel: Arc<CancelToken>,
    started: Instant,
}

/// A frame to be drawn.
struct Job {
    picture: Picture,
    cancel: Arc<CancelToken>,
    spare: Option<Framebuffer>,
}

/// What became of a frame.
#[derive(Debug)]
pub(super) enum Drawn {
    /// It is there.
    Frame(Box<Frame>),
    /// It was given up.
    GivenUp,
    /// The renderer failed, which is a defect.
    Failed,
}

impl Drawing {
    pub(super) fn start(mailbox: &Mailbox<Finished>) -> io::Result<Self> {
        let mailbox = mailbox.clone();
        let work = move |job: Job| mailbox.post(Finished::Drawn(job.draw()));
        Ok(Self {
            crew: Crew::start("draw", 1, AtEnd::Abandon, work)?,
            frame: None,
            wanted: None,
            running: None,
            failed: None,
            last_finished: Instant::now(),
            number: 0,
            spare: None,
        })
    }

    pub(super) fn frame(&self) -> Option<&Frame> {
        self.frame.as_deref()
    }

    /// Another number, another frame.
    pub(super) fn number(&self) -> u64 {
        self.number
    }

    /// The frame for threads that outlive this state of the viewer.
    pub(super) fn shared_frame(&self) -> Option<&Arc<Frame>> {
        self.frame.as_ref()
    }

    /// Whether the frame shows what is wanted, or never will.
    pub(super) fn is_current(&self) -> bool {
        match &self.wanted {
            None => true,
            Some(wanted) => self.shows(wanted) || self.failed.as_ref() == Some(wanted),
        }
    }

    fn shows(&self, picture: &Picture) -> bool {
        self.frame.as_ref().is_some_and(|frame| frame.picture == *picture)
    }

    /// Nothing is to be seen: there is no scene.
    pub(super) fn clear(&mut self) {
        self.wanted = None;
        self.number += u64::from(self.frame.take().is_some());
        if let Some(running) = &self.running {
            running.cancel.cancel();
        }
    }

    /// This is to be on the screen.
    pub(super) fn want(&mut self, picture: Picture) {
        if self.wanted.as_ref() == Some(&picture) {
            return;
        }
        if let Some(running) = &self.running
            && running.picture != picture
            && self.gives_up(running, &picture)
        {
            running.cancel.cancel();
        }
        self.wanted = Some(picture);
        self.next();
    }

    /// Whether a running frame is not worth finishing, now that `newer` is wanted.
    fn gives_up(&self, running: &Running, newer: &Picture) -> bool {
        let other = !Arc::ptr_eq(&running.picture.scene, &newer.scene) || running.picture.size != newer.size;
        let last_took = self.frame.as_ref().map_or(Duration::ZERO, |frame| frame.stats.total());
        let takes = running.started.elapsed().max(last_took);
        other || is_too_slow(takes, self.last_finished.elapsed())
    }

    /// Takes in what became of the running frame; true if there is a new one on the screen.
    pub(super) fn finished(&mut self, drawn: Drawn) -> bool {
        let Some(running) = self.running.take() else {
            return false;
        };
        let fresh = match drawn {
            Drawn::Frame(frame) if self.wanted.is_some() => {
                self.last_finished = Instant::now();
                self.number += 1;
                let old = self.frame.replace(Arc::from(frame));
                self.spare = old.and_then(Arc::into_inner).map(|frame| frame.pixels);
                true
            }
            Drawn::Frame(_) | Drawn::GivenUp => false,
            Drawn::Failed => {
                self.failed = Some(running.picture);
                true
            }
        };
        self.next();
        fresh
    }

    /// Whether the renderer failed on what is wanted.
    pub(super) fn has_failed(&self) -> bool {
        self.failed.is_some() && self.failed == self.wanted
    }

    /// Starts the wanted frame, if nothing is being drawn and it is not there yet.
    fn next(&mut self) {
        if self.running.is_some() || self.is_current() {
            return;
        }
        let Some(picture) = self.wanted.clone() else { return };
        let cancel = Arc::new(CancelToken::default());
        self.crew.push(Job {
            picture: picture.clone(),
            cancel: Arc::clone(&cancel),
            spare: self.spare.take(),
        });
        self.running = Some(Running {
            picture,
            cancel,
            started: Instant::now(),
        });
    }
}

/// Whether a frame that `takes` so long is given up for a newer one, `since` the last finished one.
fn is_too_slow(takes: Duration, since: Duration) -> bool {
    takes > SLOW && since < PATIENCE
}

impl Drop for Drawing {
    fn drop(&mut self) {
        // The crew, dropped next, waits for the thread.
        if let Some(running) = &self.running {
            running.cancel.cancel();
        }
    }
}

impl Job {
    fn draw(self) -> Drawn {
        let Self { picture, cancel, spare } = self;
        let [width, height] = picture.size;
        let work = move || {
            let fits = |pixels: &Framebuffer| [pixels.width(), pixels.height()] == [width, height];
            let mut pixels = spare.filter(fits).unwrap_or_else(|| Framebuffer::new(width, height));
            let stats = draw_cancellable(&picture.scene, &picture.view, &picture.settings, &mut pixels, &cancel);
            match stats {
                Some(stats) => Drawn::Frame(Box::new(Frame { pixels, picture, stats })),
                None => Drawn::GivenUp,
            }
        };
        guarded(work).unwrap_or(Drawn::Failed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drag_always_shows_something() {
        let ms = Duration::from_millis;
        assert!(
            !is_too_slow(ms(30), ms(0)),
            "a quick frame is left to finish, or a drag would show nothing"
        );
        assert!(is_too_slow(ms(900), ms(100)), "a slow one makes room for the newest");
        assert!(!is_too_slow(ms(900), ms(2500)), "but the window must not seem dead");
    }
}
