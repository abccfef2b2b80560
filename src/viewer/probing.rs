//! What the samples of the inspected pixel hit. Scenes with few primitives are probed at once, others in a thread:
//! the newest pixel next, like frames.

use std::fmt;
use std::io;

use super::background::guarded;
use super::latest::Latest;
use super::mailbox::Mailbox;
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
pub(super) type Probing = Latest<Target, Vec<ProbedSample>>;

/// A pixel of a frame.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Target {
    pub(super) picture: Picture,
    pub(super) pixel: [u32; 2],
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

/// Starts the thread that probes.
pub(super) fn start(mailbox: Mailbox<(Target, Vec<ProbedSample>)>) -> io::Result<Probing> {
    Latest::start("probe", move |target: Target| {
        let samples = target.probe();
        mailbox.post((target, samples));
    })
}

impl Target {
    /// A pixel that cannot be probed has no samples.
    fn probe(&self) -> Vec<ProbedSample> {
        guarded(|| self.samples()).unwrap_or_default()
    }

    fn samples(&self) -> Vec<ProbedSample> {
        let Picture {
            scene,
            view,
            settings,
            size,
            ..
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
        self.probing.answer().map_or(&[], Vec::as_slice)
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
        self.probing.want(target, |target| {
            (target.picture.scene.primitives.len() <= FEW).then(|| target.probe())
        });
    }
}
