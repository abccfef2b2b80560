//! A against B: what the picture that keys change (A) is compared with (B), and how both share the window.
//!
//! A and B show the same scene from the same place. A comparison that was closed costs nothing: B has no frame then, and
//! its thread sleeps.

mod asked;
mod change;
mod composite;
mod magnifiers;
mod measuring;
mod outside;
mod pair;
mod panes;
mod showing;
mod words;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::background::Mailbox;
use super::drawing::Drawing;
use super::state::Finished;
use super::{Command, Frame};
use crate::color::ResolveSpace;
use crate::compare::{DifferencePaint, DifferenceStyle};
use crate::render::RenderSettings;
use crate::scene::DialectChoice;

pub(super) use composite::{BEYOND, Composite};
pub(super) use measuring::Measured;
pub use measuring::{Measures, Seen};
pub use outside::OutsidePicture;
pub(super) use outside::{ReadPicture, is_picture};
use panes::Moved;
pub(super) use panes::Panes;

use measuring::Measuring;

/// How long each of both is to be seen while they flip.
const FLIP: Duration = Duration::from_millis(700);

/// What A is compared with.
#[derive(Clone, Debug, PartialEq)]
pub enum Other {
    /// The same scene under these settings, read in this dialect.
    Settings {
        /// Sampling, rules, background.
        render: RenderSettings,
        /// Where it is not A's, the scene is read a second time.
        dialect: DialectChoice,
    },
    /// The same scene with 256 samples per pixel that read textures at level zero, averaged in these values or in those
    /// of A; else as A.
    Truth(Option<ResolveSpace>),
    /// A picture from outside: A then has its size.
    Picture(Arc<OutsidePicture>),
}

/// What a command compares A with.
#[derive(Clone, Debug, PartialEq)]
pub enum Against {
    /// A copy of the settings of this moment.
    Settings,
    /// A copy of the settings of this moment, to which these commands are given.
    Changed(Vec<Command>),
    /// The same scene with 256 samples per pixel, averaged in these values or in those of A.
    Truth(Option<ResolveSpace>),
    /// The PNG or JPEG in this file.
    File(PathBuf),
    /// Nothing: the comparison is closed.
    Nothing,
}

/// How A and B share the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Arrangement {
    /// A alone.
    #[default]
    Alone,
    /// A on the left of a line, B on its right.
    Wipe,
    /// The whole of both, each in its half.
    SideBySide,
    /// What differs, in colours.
    Difference,
    /// A and B in turn.
    Flip,
}

/// The state of comparing.
#[derive(Debug)]
pub(super) struct Comparison {
    pub(super) other: Option<Other>,
    /// Whether B stands where A else does; settings change places instead.
    swapped: bool,
    pub(super) arrangement: Arrangement,
    pub(super) style: DifferenceStyle,
    /// The gain that normalising goes back to.
    gain: f32,
    /// Where the line of the wipe is: the part of the frame's width that is A's, `0.0..=1.0`.
    pub(super) wipe: f64,
    /// Whether the pointer drags that line.
    pub(super) drags_line: bool,
    /// When both change places next (never by themselves where a hand flips them), and whether the one in the back is to
    /// be seen now.
    flip: Option<(Option<Instant>, bool)>,
    mailbox: Mailbox<Finished>,
    /// B's frames: started for the first B, and kept.
    drawing: Option<Drawing>,
    /// What is to be seen while one of both frames shows where the other was before.
    held: Option<[Arc<Frame>; 2]>,
    /// How differences are coloured, for the style and the frames that it was made for.
    paint: Option<Paint>,
    measuring: Measuring,
    /// When B, which nobody sees, is to be drawn.
    postponed: Option<Instant>,
    /// The picture that is being read.
    loading: Option<PathBuf>,
    /// Where pictures from outside are.
    moved: Moved,
    /// How many B there were.
    others: u64,
    /// How often both changed places.
    swaps: u64,
    /// Grows with every change of what is to be seen that no frame's number tells.
    number: u64,
}

/// Colours of differences.
#[derive(Debug)]
struct Paint {
    colors: DifferencePaint,
    style: DifferenceStyle,
    /// The frames' numbers and who is in front, where the colours depend on them.
    frames: Option<[u64; 3]>,
}

impl Arrangement {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 5] = [Self::Alone, Self::Wipe, Self::SideBySide, Self::Difference, Self::Flip];

    /// The name used in the interface and in scripts.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Alone => "alone",
            Self::Wipe => "wipe",
            Self::SideBySide => "side",
            Self::Difference => "difference",
            Self::Flip => "flip",
        }
    }
}
