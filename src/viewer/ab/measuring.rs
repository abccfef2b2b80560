//! How far A and B are apart, in numbers, in a thread of its own: once both pictures are final and the hand rests.
//!
//! Quick answers come first: counts and places, then what eyes see. Numbers of the pictures before stay until there are
//! new ones, and say so.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::compare;
use crate::compare::{Guess, Levels, Pair, Place};
use crate::raster::Framebuffer;
use crate::render::CancelToken;
use crate::viewer::ab::outside::ReadPicture;
use crate::viewer::frames::drawing::DrawingId;
use crate::viewer::frames::frame::{Frame, Picture};
use crate::viewer::jobs::mailbox::Mailbox;
use crate::viewer::jobs::pool::{AtEnd, WorkerPool, guarded};

/// How long after the last change both pictures count as resting.
pub(in crate::viewer) const REST: Duration = Duration::from_millis(120);

/// Places that can be gone to one after the other.
const PLACES: usize = 64;

/// A picture that outlives this state of the viewer.
pub(in crate::viewer) type SharedPicture = Arc<dyn AsRef<Framebuffer> + Send + Sync>;

/// How far B is from A.
#[derive(Clone, Debug, PartialEq)]
pub struct Measures {
    /// Counts, largest differences, mean errors.
    pub levels: Levels,
    /// Where they differ most, the largest first, one from each block of 16 x 16 pixels.
    pub places: Vec<Place>,
    /// Structural similarity and FLIP; `None` until they are there.
    pub seen: Option<Seen>,
    /// Why a picture from outside differs; `None` until that was guessed, and for other B.
    pub guess: Option<Guess>,
}

/// What eyes make of the difference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Structural similarity; 1 for equal pictures.
    pub ssim: f64,
    /// The mean FLIP error; 0 for equal pictures.
    pub flip: f64,
}

impl AsRef<Framebuffer> for Frame {
    fn as_ref(&self) -> &Framebuffer {
        &self.pixels
    }
}

/// Which two pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) struct Which {
    pub(in crate::viewer) a: (DrawingId, u64),
    /// Nothing where B is a picture from outside.
    pub(in crate::viewer) b: Option<(DrawingId, u64)>,
    /// Which B it is.
    pub(in crate::viewer) other: u64,
}

/// The state of measuring.
#[derive(Debug)]
pub(in crate::viewer) struct Measuring {
    measured: Mailbox<Measured>,
    read: Mailbox<ReadPicture>,
    /// Started with the first work.
    workers: Option<WorkerPool<Work>>,
    pub(in crate::viewer) wanted: Option<(Which, Instant)>,
    pub(in crate::viewer) running: Option<(Which, Arc<CancelToken>)>,
    pub(in crate::viewer) found: Option<(Which, Measures)>,
    /// The two pictures that nothing more will be found about.
    pub(in crate::viewer) complete: Option<Which>,
    /// How often B's picture is still to be read again.
    pub(in crate::viewer) rereads: u64,
    /// Somebody waits: no rest.
    pub(in crate::viewer) hurry: bool,
    /// Somebody wants to go to a place that is not known yet.
    pub(in crate::viewer) jumps: bool,
}

/// What the thread does.
pub(in crate::viewer) enum Work {
    Measure(Box<Job>),
    /// The picture in a file, and whether it is B already.
    Read(PathBuf, bool),
}

pub(in crate::viewer) struct Job {
    pub(in crate::viewer) which: Which,
    pub(in crate::viewer) pictures: [SharedPicture; 2],
    /// What A is, where the cause of the difference is to be guessed.
    pub(in crate::viewer) subject: Option<Picture>,
    pub(in crate::viewer) cancel: Arc<CancelToken>,
}

/// What the thread has to say about two pictures.
#[derive(Debug)]
pub(in crate::viewer) struct Measured {
    pub(in crate::viewer) which: Which,
    pub(in crate::viewer) measures: Option<Measures>,
    pub(in crate::viewer) stage: Stage,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) enum Stage {
    /// There is more to come.
    More,
    /// That is all.
    Ended,
    /// It was given up.
    GivenUp,
}

impl Measuring {
    pub(in crate::viewer) fn new(measured: Mailbox<Measured>, read: Mailbox<ReadPicture>) -> Self {
        Self {
            measured,
            read,
            workers: None,
            wanted: None,
            running: None,
            found: None,
            complete: None,
            rereads: 0,
            hurry: false,
            jumps: false,
        }
    }

    /// Whether somebody waits.
    pub(in crate::viewer) fn hurries(&self) -> bool {
        self.hurry
    }

    /// Another B: what is known is of no use.
    pub(in crate::viewer) fn forget(&mut self) {
        self.cancel();
        (self.wanted, self.found, self.complete) = (None, None, None);
    }

    /// Reads a picture, before anything else is measured.
    pub(in crate::viewer) fn load(&mut self, path: PathBuf) -> io::Result<()> {
        self.cancel();
        self.push(Work::Read(path, false))
    }

    /// The same for one that is B already.
    pub(in crate::viewer) fn load_again(&mut self, path: PathBuf) -> io::Result<()> {
        self.cancel();
        self.push(Work::Read(path, true))?;
        self.rereads += 1;
        Ok(())
    }

    /// Somebody waits, or waits no more.
    pub(in crate::viewer) fn set_hurry(&mut self, hurry: bool) {
        self.hurry = hurry;
    }

    pub(in crate::viewer) fn cancel(&mut self) {
        if let Some((_, cancel)) = &self.running {
            cancel.cancel();
        }
    }

    /// Nothing is compared any more.
    pub(in crate::viewer) fn close(&mut self) {
        self.forget();
        self.jumps = false;
    }

    /// When the hand will have rested long enough.
    pub(in crate::viewer) fn due(&self) -> Option<Instant> {
        let (which, since) = self.wanted.filter(|_| self.running.is_none())?;
        (self.complete != Some(which))
            .then(|| since.checked_add(REST))
            .flatten()
    }

    pub(in crate::viewer) fn start(&mut self, job: Job) -> io::Result<()> {
        let running = Some((job.which, Arc::clone(&job.cancel)));
        self.push(Work::Measure(Box::new(job)))?;
        self.running = running;
        Ok(())
    }

    /// Starts the thread with the first work.
    pub(in crate::viewer) fn push(&mut self, work: Work) -> io::Result<()> {
        if self.workers.is_none() {
            let (measured, read) = (self.measured.clone(), self.read.clone());
            let serve = move |work: Work| match work {
                Work::Measure(job) => job.measure(&measured),
                Work::Read(path, again) => read.post(ReadPicture::read(path, again)),
            };
            self.workers = Some(WorkerPool::start("compare", 1, AtEnd::Detach, serve)?);
        }
        if let Some(workers) = &self.workers {
            workers.push(work);
        }
        Ok(())
    }
}

impl Drop for Measuring {
    fn drop(&mut self) {
        self.cancel();
    }
}

impl Job {
    /// Posts what is found as it comes; the last message ends the job.
    fn measure(&self, mailbox: &Mailbox<Measured>) {
        let post = |measures, stage| {
            mailbox.post(Measured {
                which: self.which,
                measures,
                stage,
            });
        };
        let measures = guarded(|| self.work(&|measures| post(Some(measures), Stage::More))).flatten();
        let given_up = measures.is_none() && self.cancel.is_cancelled();
        post(measures, if given_up { Stage::GivenUp } else { Stage::Ended });
    }

    fn work(&self, post: &impl Fn(Measures)) -> Option<Measures> {
        let [a, b] = [&self.pictures[0], &self.pictures[1]].map(|picture| (**picture).as_ref());
        let pair = Pair::new(a, b).ok()?;
        let mut measures = Measures {
            levels: pair.levels(),
            places: pair.places(PLACES),
            seen: None,
            guess: None,
        };
        post(measures.clone());
        let (ssim, flip) = pair.ssim(&self.cancel).zip(pair.flip(&self.cancel))?;
        measures.seen = Some(Seen { ssim, flip });
        if let Some(subject) = self.subject.as_ref().filter(|_| measures.levels.differing() > 0) {
            post(measures.clone());
            measures.guess = Some(compare::guess(&subject.subject(), b, Guess::BUDGET, &self.cancel)?);
        }
        Some(measures)
    }
}
