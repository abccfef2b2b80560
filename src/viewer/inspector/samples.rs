//! What the samples of a pixel hit. Scenes with few primitives are probed at once, others in a thread: the newest pixel next,
//! like frames.

use std::{fmt, io};

use crate::figure::SampleMark;
use crate::inspect::{SampleHit, pixel_samples};
use crate::scene::Shape;
use crate::viewer::frames::frame::Picture;
use crate::viewer::jobs::latest::Latest;
use crate::viewer::jobs::mailbox::Mailbox;
use crate::viewer::jobs::pool::guarded;

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
pub(in crate::viewer) type Probing = Latest<Target, Vec<ProbedSample>>;

/// A pixel of a frame.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::viewer) struct Target {
    pub(in crate::viewer) picture: Picture,
    pub(in crate::viewer) pixel: [u32; 2],
}

impl fmt::Display for Hit {
    /// Such as `background`, or `polygon "left", line 12`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Background => f.write_str("background"),
            Self::Outline => f.write_str("outline of the canvas"),
            Self::Shape(Shape {
                element, id, location, ..
            }) => {
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
pub(in crate::viewer) fn start(mailbox: Mailbox<(Target, Vec<ProbedSample>)>) -> io::Result<Probing> {
    Latest::answering("probe", mailbox, Target::samples)
}

impl Target {
    /// A pixel that cannot be probed has no samples.
    pub(in crate::viewer) fn probe(&self) -> Vec<ProbedSample> {
        guarded(|| self.samples()).unwrap_or_default()
    }

    /// None where areas are covered.
    fn samples(&self) -> Vec<ProbedSample> {
        let Picture {
            scene,
            view,
            settings,
            size,
            ..
        } = &self.picture;
        if settings.covers_areas() {
            return Vec::new();
        }
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
