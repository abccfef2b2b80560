//! When A and B are measured, and the way from one difference to the next.

use std::sync::Arc;
use std::time::Instant;

use crate::viewer::ab::measuring::{Job, Measured, Measures, REST, Stage, Which};
use crate::viewer::ab::other::{Against, Other};
use crate::viewer::frames::drawing::Drawing;
use crate::viewer::state::Viewer;

impl Viewer {
    /// How far A and B are apart, and whether that is about the pictures of this moment; `None` until it was found out.
    pub fn measures(&self) -> Option<(&Measures, bool)> {
        let (which, measures) = self.ab.measuring.found.as_ref()?;
        Some((measures, self.measurable() == Some(*which)))
    }

    /// Whether nothing is to be found out about A and B any more.
    pub(in crate::viewer) fn is_measured(&self) -> bool {
        let which = self.measurable();
        which.is_none() || which == self.ab.measuring.complete
    }

    /// The place among those that differ most that is pinned, counted from 0.
    pub fn pinned_place(&self) -> Option<usize> {
        let pinned = self.pinned_pixel()?;
        let (measures, _) = self.measures()?;
        measures.places.iter().position(|place| place.at == pinned)
    }

    /// Both pictures, if they are final and belong together.
    fn measurable(&self) -> Option<Which> {
        let settled = self.frames.drawing.is_current() && self.ab.is_current();
        self.pair_in_step().filter(|_| settled)?;
        let number = |drawing: &Drawing| (drawing.id(), drawing.number());
        Some(Which {
            a: number(&self.frames.drawing),
            b: self.ab.drawn_other().map(number),
            other: self.ab.others,
        })
    }

    /// Finds out how far both are apart once they rest.
    pub(in crate::viewer) fn want_measures(&mut self) {
        if self.ab.other.is_none() {
            return self.ab.measuring.close();
        }
        let which = self.measurable();
        let measuring = &mut self.ab.measuring;
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
        let is_outside = matches!(self.ab.other, Some(Other::Picture(_)));
        let job = Job {
            which,
            pictures,
            subject: self.frame().filter(|_| is_outside).map(|frame| frame.picture.clone()),
            cancel: Arc::default(),
        };
        if let Err(error) = self.ab.measuring.start(job) {
            self.ab.measuring.complete = Some(which);
            self.chrome
                .messages
                .error(format!("cannot measure A against B: {error}; close other programs"));
        }
    }

    /// Takes in what the thread found out.
    pub(in crate::viewer) fn measured(&mut self, measured: Measured) {
        let measuring = &mut self.ab.measuring;
        if measured.stage != Stage::More {
            measuring.running = None;
        }
        if self.ab.other.is_none() || measured.stage == Stage::GivenUp {
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
    pub(in crate::viewer) fn next_difference(&mut self) {
        if self.ab.other.is_none() {
            self.compare(Against::Settings);
            return;
        }
        self.ab.measuring.jumps = true;
        self.jump();
    }

    fn jump(&mut self) {
        let next = self.pinned_place().map_or(0, |place| place + 1);
        let Some((measures, true)) = self.measures().filter(|_| self.ab.measuring.jumps) else {
            return;
        };
        let place = measures.places.get(next).or(measures.places.first()).copied();
        self.ab.measuring.jumps = false;
        match place {
            Some(place) => {
                self.pin(place.at.map(i64::from));
                self.inspector.magnifier.revealed = true;
                self.reveal_pin();
            }
            None => self
                .chrome
                .messages
                .done("A and B are equal in this view: no pixel differs".to_owned()),
        }
    }
}
