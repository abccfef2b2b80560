//! How far A and B are apart, in numbers, in a thread of its own: once both pictures are final and the hand rests.
//!
//! Quick answers come first: counts and places, then what eyes see. Numbers of the pictures before stay until there are
//! new ones, and say so.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::super::background::{AtEnd, Crew, guarded};
use super::super::drawing::{Drawing, DrawingId};
use super::super::mailbox::Mailbox;
use super::super::{Frame, Picture, Viewer};
use super::{Against, Other, ReadPicture};
use crate::compare::{self, Guess, Levels, Pair, Place};
use crate::raster::Framebuffer;
use crate::render::CancelToken;

/// So long after the last change both pictures count as at rest.
const REST: Duration = Duration::from_millis(120);
/// Places that can be gone to one after the other.
const PLACES: usize = 64;

/// A picture that outlives this state of the viewer.
pub(super) type SharedPicture = Arc<dyn AsRef<Framebuffer> + Send + Sync>;

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
pub(in super::super) struct Which {
    a: (DrawingId, u64),
    /// Nothing where B is a picture from outside.
    b: Option<(DrawingId, u64)>,
    /// Which B it is.
    other: u64,
}

/// The state of measuring.
#[derive(Debug)]
pub(in super::super) struct Measuring {
    measured: Mailbox<Measured>,
    read: Mailbox<ReadPicture>,
    /// Started with the first work.
    crew: Option<Crew<Work>>,
    wanted: Option<(Which, Instant)>,
    running: Option<(Which, Arc<CancelToken>)>,
    found: Option<(Which, Measures)>,
    /// The two pictures that nothing more will be found about.
    complete: Option<Which>,
    /// Somebody waits: no rest.
    hurry: bool,
    /// Somebody wants to go to a place that is not known yet.
    jumps: bool,
}

/// What the thread does.
enum Work {
    Measure(Job),
    Read(PathBuf),
}

struct Job {
    which: Which,
    pictures: [SharedPicture; 2],
    /// What A is, where the cause of the difference is to be guessed.
    subject: Option<Picture>,
    cancel: Arc<CancelToken>,
}

/// What the thread has to say about two pictures.
#[derive(Debug)]
pub(in super::super) struct Measured {
    which: Which,
    measures: Option<Measures>,
    stage: Stage,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// There is more to come.
    More,
    /// That is all.
    Ended,
    /// It was given up.
    GivenUp,
}

impl Measuring {
    pub(in super::super) fn new(measured: Mailbox<Measured>, read: Mailbox<ReadPicture>) -> Self {
        Self {
            measured,
            read,
            crew: None,
            wanted: None,
            running: None,
            found: None,
            complete: None,
            hurry: false,
            jumps: false,
        }
    }

    /// Whether somebody waits.
    pub(super) fn hurries(&self) -> bool {
        self.hurry
    }

    /// Another B: what is known is of no use.
    pub(super) fn forget(&mut self) {
        self.cancel();
        (self.wanted, self.found, self.complete) = (None, None, None);
    }

    /// Reads a picture, before anything else is measured.
    pub(super) fn load(&mut self, path: PathBuf) -> io::Result<()> {
        self.cancel();
        self.push(Work::Read(path))
    }

    /// Somebody waits, or waits no more.
    pub(super) fn set_hurry(&mut self, hurry: bool) {
        self.hurry = hurry;
    }

    fn cancel(&mut self) {
        if let Some((_, cancel)) = &self.running {
            cancel.cancel();
        }
    }

    /// Nothing is compared any more.
    fn close(&mut self) {
        self.forget();
        self.jumps = false;
    }

    /// When the hand will have rested long enough.
    pub(in super::super) fn due(&self) -> Option<Instant> {
        let (which, since) = self.wanted.filter(|_| self.running.is_none())?;
        (self.complete != Some(which))
            .then(|| since.checked_add(REST))
            .flatten()
    }

    fn start(&mut self, job: Job) -> io::Result<()> {
        let running = Some((job.which, Arc::clone(&job.cancel)));
        self.push(Work::Measure(job))?;
        self.running = running;
        Ok(())
    }

    /// Starts the thread with the first work.
    fn push(&mut self, work: Work) -> io::Result<()> {
        if self.crew.is_none() {
            let (measured, read) = (self.measured.clone(), self.read.clone());
            let serve = move |work: Work| match work {
                Work::Measure(job) => job.measure(&measured),
                Work::Read(path) => read.post(ReadPicture::read(path)),
            };
            self.crew = Some(Crew::start("compare", 1, AtEnd::Detach, serve)?);
        }
        if let Some(crew) = &self.crew {
            crew.push(work);
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

impl Viewer {
    /// How far A and B are apart, and whether that is about the pictures of this moment; `None` until it was found out.
    pub fn measures(&self) -> Option<(&Measures, bool)> {
        let (which, measures) = self.comparison.measuring.found.as_ref()?;
        Some((measures, self.measurable() == Some(*which)))
    }

    /// Whether nothing is to be found out about A and B any more.
    pub(in super::super) fn is_measured(&self) -> bool {
        let which = self.measurable();
        which.is_none() || which == self.comparison.measuring.complete
    }

    /// The place among those that differ most that is pinned, counted from 0.
    pub fn pinned_place(&self) -> Option<usize> {
        let pinned = self.pinned_pixel()?;
        let (measures, _) = self.measures()?;
        measures.places.iter().position(|place| place.at == pinned)
    }

    /// Both pictures, if they are final and belong together.
    fn measurable(&self) -> Option<Which> {
        let settled = self.drawing.is_current() && self.comparison.is_current();
        self.pair_in_step().filter(|_| settled)?;
        let number = |drawing: &Drawing| (drawing.id(), drawing.number());
        Some(Which {
            a: number(&self.drawing),
            b: self.comparison.drawn_other().map(number),
            other: self.comparison.others,
        })
    }

    /// Finds out how far both are apart once they rest.
    pub(in super::super) fn want_measures(&mut self) {
        if self.comparison.other.is_none() {
            return self.comparison.measuring.close();
        }
        let which = self.measurable();
        let measuring = &mut self.comparison.measuring;
        let Some(which) = which else {
            measuring.wanted = None;
            return measuring.cancel();
        };
        if measuring.running.as_ref().is_some_and(|(running, _)| *running != which) {
            measuring.cancel();
        }
        if measuring.wanted.is_none_or(|(wanted, _)| wanted != which) {
            measuring.wanted = Some((which, Instant::now()));
        }
        let waits = measuring.hurry || measuring.jumps;
        let rests = measuring.wanted.is_some_and(|(_, since)| since.elapsed() >= REST);
        if measuring.running.is_some() || measuring.complete == Some(which) || !(waits || rests) {
            return;
        }
        let Some(pictures) = self.shared_pair() else { return };
        let is_outside = matches!(self.comparison.other, Some(Other::Picture(_)));
        let job = Job {
            which,
            pictures,
            subject: self.frame().filter(|_| is_outside).map(|frame| frame.picture.clone()),
            cancel: Arc::default(),
        };
        if let Err(error) = self.comparison.measuring.start(job) {
            self.comparison.measuring.complete = Some(which);
            self.messages
                .error(format!("cannot measure A against B: {error}; close other programs"));
        }
    }

    /// Takes in what the thread found out.
    pub(in super::super) fn measured(&mut self, measured: Measured) {
        let measuring = &mut self.comparison.measuring;
        if measured.stage != Stage::More {
            measuring.running = None;
        }
        if self.comparison.other.is_none() || measured.stage == Stage::GivenUp {
            return;
        }
        if let Some(measures) = measured.measures {
            measuring.found = Some((measured.which, measures));
        }
        if measured.stage == Stage::Ended {
            measuring.complete = Some(measured.which);
        }
        self.jump();
    }

    /// Goes to the pixel that differs most, or from there to the next; at once, or when it is known.
    pub(super) fn next_difference(&mut self) {
        if self.comparison.other.is_none() {
            self.compare(Against::Settings);
            return;
        }
        self.comparison.measuring.jumps = true;
        self.jump();
    }

    fn jump(&mut self) {
        let next = self.pinned_place().map_or(0, |place| place + 1);
        let Some((measures, true)) = self.measures().filter(|_| self.comparison.measuring.jumps) else {
            return;
        };
        let place = measures.places.get(next).or(measures.places.first()).copied();
        self.comparison.measuring.jumps = false;
        match place {
            Some(place) => {
                self.pin(place.at.map(i64::from));
                self.inspector.revealed = true;
                self.reveal_pin();
            }
            None => self
                .messages
                .done("A and B are equal in this view: no pixel differs".to_owned()),
        }
    }
}
