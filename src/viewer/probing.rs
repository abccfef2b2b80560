//! What the samples of the inspected pixel hit. Scenes with few primitives are probed at once, others in a thread:
//! the newest pixel next, like frames.

use std::fmt;
use std::io;

use super::background::{AtEnd, Crew, Mailbox, guarded};
use super::state::Finished;
use super::{Picture, Viewer};
use crate::figure::SampleMark;
use crate::inspect::{SampleHit, pixel_samples};
use crate::scene::Shape;

/// Probing so many primitives takes less than a millisecond: dots that come at once do not flicker.
const FEW: usize = 4000;

/// One sample of the inspected pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbedSample {
    /// Its place and colour, as the inset draws them.
    pub mark: SampleMark,
    /// What painted it last.
    pub hit: Hit,
}

/// What painted a sample last.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Hit {
    /// Nothing but the background.
    Background,
    /// The outline around the canvas.
    Outline,
    /// This shape.
    Shape(Shape),
}

/// The state of probing.
#[derive(Debug)]
pub(super) struct Probing {
    crew: Crew<Target>,
    wanted: Option<Target>,
    found: Option<Probed>,
    is_running: bool,
    /// Grows with every change of what [`Probing::samples`] answers.
    number: u64,
}

/// A pixel of a frame.
#[derive(Clone, Debug, PartialEq)]
struct Target {
    picture: Picture,
    pixel: [u32; 2],
}

/// A pixel that was probed.
#[derive(Debug)]
pub(super) struct Probed {
    target: Target,
    samples: Vec<ProbedSample>,
}

impl fmt::Display for Hit {
    /// Such as `background`, or `polygon "left", line 12`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Background => f.write_str("background"),
            Self::Outline => f.write_str("outline of the canvas"),
            Self::Shape(Shape { element, id, location }) => {
                f.write_str(element)?;
                if let Some(id) = id {
                    write!(f, " \"{id}\"")?;
                }
                write!(f, ", line {}", location.line)
            }
        }
    }
}

impl Probing {
    pub(super) fn start(mailbox: &Mailbox<Finished>) -> io::Result<Self> {
        let mailbox = mailbox.clone();
        let work = move |target: Target| mailbox.post(Finished::Probed(target.probe()));
        Ok(Self {
            crew: Crew::start("probe", 1, AtEnd::Detach, work)?,
            wanted: None,
            found: None,
            is_running: false,
            number: 0,
        })
    }

    /// The samples that are wanted, once they are there.
    fn samples(&self) -> &[ProbedSample] {
        match (&self.found, &self.wanted) {
            (Some(found), Some(wanted)) if found.target == *wanted => &found.samples,
            _ => &[],
        }
    }

    /// Another number, other samples.
    pub(super) fn number(&self) -> u64 {
        self.number
    }

    /// Whether what is wanted was found.
    pub(super) fn is_current(&self) -> bool {
        let found = self.found.as_ref().map(|found| &found.target);
        self.wanted.is_none() || found == self.wanted.as_ref()
    }

    fn want(&mut self, target: Option<Target>) {
        if self.wanted != target {
            self.wanted = target;
            self.number += 1;
            self.next();
        }
    }

    pub(super) fn finished(&mut self, probed: Probed) {
        self.is_running = false;
        self.found = Some(probed);
        self.number += 1;
        self.next();
    }

    fn next(&mut self) {
        if self.is_running || self.is_current() {
            return;
        }
        let Some(target) = self.wanted.clone() else { return };
        if target.picture.scene.primitives.len() <= FEW {
            self.found = Some(target.probe());
        } else {
            self.is_running = true;
            self.crew.push(target);
        }
    }
}

impl Target {
    /// A pixel that cannot be probed has no samples.
    fn probe(self) -> Probed {
        let samples = guarded(|| self.samples()).unwrap_or_default();
        Probed { target: self, samples }
    }

    fn samples(&self) -> Vec<ProbedSample> {
        let Picture {
            scene,
            view,
            settings,
            size,
        } = &self.picture;
        let samples = pixel_samples(scene, view, settings, *size, self.pixel).unwrap_or_default();
        let own = samples.iter().map(|sample| {
            let hit = match sample.hit {
                SampleHit::Background => Hit::Background,
                SampleHit::Outline => Hit::Outline,
                SampleHit::Shape(shape) => Hit::Shape(shape.clone()),
            };
            ProbedSample {
                mark: SampleMark {
                    at: sample.position,
                    color: sample.color,
                    covered: hit != Hit::Background,
                },
                hit,
            }
        });
        own.collect()
    }
}

impl Viewer {
    /// The samples of the pixel in the middle of the open inspector, in the order of the sample pattern; empty until
    /// they were found out.
    pub fn pixel_samples(&self) -> &[ProbedSample] {
        self.probing.samples()
    }

    /// What the samples of the inspected pixel hit, and how many each, in the order of the samples.
    pub fn hits(&self) -> Vec<(&Hit, usize)> {
        let mut hits: Vec<(&Hit, usize)> = Vec::new();
        for sample in self.pixel_samples() {
            match hits.iter_mut().find(|(hit, _)| **hit == sample.hit) {
                Some((_, count)) => *count += 1,
                None => hits.push((&sample.hit, 1)),
            }
        }
        hits
    }

    /// As the inset draws them.
    pub(super) fn sample_marks(&self) -> Vec<SampleMark> {
        self.pixel_samples().iter().map(|sample| sample.mark).collect()
    }

    /// Sees to it that the samples of the pixel in the middle of the inset are found out, for the frame on the screen.
    pub(super) fn want_samples(&mut self) {
        let center = self.inset.map(|placed| placed.inset.center);
        let pixel = center.and_then(|center| self.in_frame(center));
        let target = pixel.zip(self.frame()).map(|(pixel, frame)| Target {
            picture: frame.picture.clone(),
            pixel,
        });
        self.probing.want(target);
    }
}
