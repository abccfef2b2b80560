//! What a board shows is drawn and measured in a thread, entry by entry: each is to be seen as soon as it is there. Another view
//! or scene gives the rest up and begins anew; what is known of the same place is not measured twice.

use std::io;
use std::sync::Arc;
use std::time::Duration;

use crate::raster::Framebuffer;
use crate::render::{CancelToken, Repeats};
use crate::scene::{DialectChoice, Scene};
use crate::viewer::board::entry::BoardEntry;
use crate::viewer::board::measure::{BoardMeasure, BoardPlace, BoardTile};
use crate::viewer::board::report::BoardCommandLine;
use crate::viewer::export::sheet::preview::KnownScene;
use crate::viewer::jobs::mailbox::Mailbox;
use crate::viewer::jobs::pool::{AtEnd, WorkerPool, guarded};

/// How often an entry's frame is drawn for its time: few slow ones, so that nine entries do not take minutes.
const REPEATS: Repeats = Repeats {
    frames: BoardCommandLine::FRAMES,
    patience: Duration::from_millis(400),
};

/// What a board shows.
#[derive(Clone, Debug)]
pub(in crate::viewer) struct BoardQuestion {
    pub(in crate::viewer) place: BoardPlace,
    pub(in crate::viewer) known: KnownScene,
    /// What A is read in; it is known in that.
    pub(in crate::viewer) own_dialect: DialectChoice,
    pub(in crate::viewer) entries: Vec<BoardEntry>,
}

/// What the thread does.
pub(in crate::viewer) struct Job {
    number: u64,
    question: BoardQuestion,
    /// Where that is known already.
    truth: Option<Arc<Framebuffer>>,
    cancel: Arc<CancelToken>,
}

/// What the thread has to say.
#[derive(Debug)]
pub(in crate::viewer) struct BoardNews {
    number: u64,
    news: News,
}

#[derive(Debug)]
enum News {
    Truth(Arc<Framebuffer>),
    Tile(Box<(BoardEntry, BoardTile)>),
    /// Nothing more comes; in one line why, where that is told.
    Ended(Option<String>),
}

/// What is known of a place.
#[derive(Clone, Debug)]
pub(in crate::viewer) struct Found {
    pub(in crate::viewer) place: BoardPlace,
    document: u64,
    pub(in crate::viewer) truth: Option<Arc<Framebuffer>>,
    tiles: Vec<(BoardEntry, BoardTile)>,
    /// Why there is less than was asked for.
    pub(in crate::viewer) problem: Option<String>,
}

/// The state of measuring.
#[derive(Debug)]
pub(in crate::viewer) struct BoardMeasuring {
    workers: WorkerPool<Job>,
    wanted: Option<BoardQuestion>,
    running: Option<(u64, Arc<CancelToken>)>,
    jobs: u64,
    found: Option<Found>,
    /// What was shown before the place changed, until something of the new one is there.
    before: Option<Found>,
    /// Grows with every change of what is found.
    number: u64,
}

impl PartialEq for BoardQuestion {
    fn eq(&self, other: &Self) -> bool {
        let dialects = |question: &Self| (question.known.document, question.known.dialect, question.own_dialect);
        self.place == other.place && dialects(self) == dialects(other) && self.entries == other.entries
    }
}

impl Found {
    /// What is known of an entry.
    pub(in crate::viewer) fn tile(&self, entry: BoardEntry) -> Option<&BoardTile> {
        let known = self.tiles.iter().find(|(known, _)| *known == entry);
        known.map(|(_, tile)| tile)
    }

    fn is_of(&self, question: &BoardQuestion) -> bool {
        self.place == question.place && self.document == question.known.document
    }
}

impl BoardMeasuring {
    /// Starts the thread.
    ///
    /// # Errors
    /// When the system gives none.
    pub(in crate::viewer) fn start(mailbox: Mailbox<BoardNews>) -> io::Result<Self> {
        let work = move |job: Job| {
            let number = job.number;
            let ended = guarded(|| job.work(&mailbox)).unwrap_or_else(|| Err(FAILED.to_owned()));
            let news = News::Ended(ended.err());
            mailbox.post(BoardNews { number, news });
        };
        Ok(Self {
            workers: WorkerPool::start("board", 1, AtEnd::Detach, work)?,
            wanted: None,
            running: None,
            jobs: 0,
            found: None,
            before: None,
            number: 0,
        })
    }

    /// What is known of the place that is shown.
    pub(in crate::viewer) fn found(&self) -> Option<&Found> {
        self.found.as_ref()
    }

    /// The tile of an entry, and whether it is of another place than the one that is shown now.
    pub(in crate::viewer) fn tile(&self, entry: BoardEntry) -> Option<(&BoardTile, bool)> {
        let of = |found: &'_ Option<Found>| found.as_ref().and_then(|found| found.tile(entry)).is_some();
        let stale = !of(&self.found);
        let found = if stale { &self.before } else { &self.found };
        Some((found.as_ref()?.tile(entry)?, stale || self.wanted.is_none()))
    }

    /// The truth, and whether it is that of another place.
    pub(in crate::viewer) fn truth(&self) -> Option<(&Framebuffer, bool)> {
        let now = self.found.as_ref().and_then(|found| found.truth.as_deref());
        let before = || self.before.as_ref().and_then(|found| found.truth.as_deref());
        let stale = now.is_none();
        Some((now.or_else(before)?, stale || self.wanted.is_none()))
    }

    /// Grows with every change of what is found.
    pub(in crate::viewer) fn number(&self) -> u64 {
        self.number
    }

    /// Whether everything that was asked is answered.
    pub(in crate::viewer) fn is_current(&self) -> bool {
        self.running.is_none()
    }

    /// Gives up what is at work: what it would show is of yesterday, or not to be seen.
    pub(in crate::viewer) fn pause(&mut self) {
        self.wanted = None;
        if let Some((_, cancel)) = self.running.take() {
            cancel.cancel();
        }
    }

    /// Asks.
    pub(in crate::viewer) fn want(&mut self, question: BoardQuestion) {
        if self.wanted.as_ref() == Some(&question) {
            return;
        }
        self.pause();
        self.number += 1;
        if !self.found.as_ref().is_some_and(|found| found.is_of(&question)) {
            let new = Found {
                place: question.place.clone(),
                document: question.known.document,
                truth: None,
                tiles: Vec::new(),
                problem: None,
            };
            let old = self.found.replace(new);
            // Of several places in a row the last that was seen.
            if old.as_ref().is_some_and(|found| !found.tiles.is_empty()) {
                self.before = old;
            }
        }
        self.wanted = Some(question.clone());
        let Some(found) = &mut self.found else { return };
        found.problem = None;
        found.tiles.retain(|(entry, _)| question.entries.contains(entry));
        let missing = question.entries.iter().copied();
        let missing: Vec<BoardEntry> = missing.filter(|entry| found.tile(*entry).is_none()).collect();
        if missing.is_empty() && found.truth.is_some() {
            return;
        }
        self.jobs += 1;
        let cancel = Arc::new(CancelToken::default());
        self.running = Some((self.jobs, Arc::clone(&cancel)));
        self.workers.push(Job {
            number: self.jobs,
            truth: found.truth.clone(),
            question: BoardQuestion {
                entries: missing,
                ..question
            },
            cancel,
        });
    }

    /// Takes in what the thread says.
    pub(in crate::viewer) fn take_in(&mut self, BoardNews { number, news }: BoardNews) {
        if self.running.as_ref().is_none_or(|(running, _)| *running != number) {
            return;
        }
        self.number += 1;
        let Some(found) = &mut self.found else { return };
        match news {
            News::Truth(truth) => found.truth = Some(truth),
            News::Tile(tile) => found.tiles.push(*tile),
            News::Ended(problem) => {
                found.problem = problem;
                self.running = None;
                self.before = None;
            }
        }
    }
}

/// Said where drawing broke down.
const FAILED: &str = "measuring failed inside the program";

impl Job {
    /// # Errors
    /// One line where the document cannot be read in the dialect of an entry.
    fn work(&self, mailbox: &Mailbox<BoardNews>) -> Result<(), String> {
        let BoardQuestion {
            place,
            known,
            entries,
            own_dialect,
        } = &self.question;
        let post = |news| {
            let number = self.number;
            mailbox.post(BoardNews { number, news });
        };
        let drawn = || place.draw_truth(&known.scene, &self.cancel).map(Arc::new);
        // Nobody waits for what is given up.
        let Some(truth) = self.truth.clone().or_else(drawn) else {
            return Ok(());
        };
        post(News::Truth(Arc::clone(&truth)));
        let by = BoardMeasure {
            truth: &truth,
            repeats: REPEATS,
            cancel: &self.cancel,
        };
        let mut other: Option<(BoardEntry, Arc<Scene>)> = None;
        for entry in entries {
            if self.cancel.is_cancelled() {
                return Ok(());
            }
            let read_before = other.as_ref().filter(|(of, _)| of.dialect == entry.dialect);
            let scene = match read_before {
                Some((_, scene)) => Arc::clone(scene),
                None if entry.dialect == *own_dialect => Arc::clone(&known.scene),
                None => known.read_in(entry.dialect, &place.truth)?,
            };
            let measured = place.measure(&scene, *entry, &by);
            let Some(tile) = measured else { return Ok(()) };
            post(News::Tile(Box::new((*entry, tile))));
            other = Some((*entry, scene));
        }
        Ok(())
    }
}
