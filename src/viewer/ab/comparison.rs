//! The state of comparing.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use crate::compare::{DifferencePaint, DifferenceStyle};
use crate::viewer::ab::measuring::Measuring;
use crate::viewer::ab::other::{Arrangement, Other};
use crate::viewer::frames::drawing::{Changes, Drawing};
use crate::viewer::frames::frame::Frame;
use crate::viewer::frames::job::Drawn;
use crate::viewer::jobs::mailbox::Mailbox;
use crate::viewer::view::panes::Moved;

impl Comparison {
    pub(in crate::viewer) fn new(drawn: Mailbox<Drawn>, measuring: Measuring) -> Self {
        Self {
            other: None,
            arrangement: Arrangement::Alone,
            style: DifferenceStyle::default(),
            gain: 1.0,
            wipe: None,
            drags_line: false,
            flip: None,
            drawn,
            drawing: None,
            held: None,
            paint: None,
            swapped: false,
            postponed: None,
            loading: None,
            moved: Moved::default(),
            others: 0,
            swaps: 0,
            measuring,
            number: 0,
        }
    }
}

/// The state of comparing.
#[derive(Debug)]
pub(in crate::viewer) struct Comparison {
    pub(in crate::viewer) other: Option<Other>,
    /// Whether B stands where A else does; settings change places instead.
    pub(in crate::viewer) swapped: bool,
    pub(in crate::viewer) arrangement: Arrangement,
    pub(in crate::viewer) style: DifferenceStyle,
    /// The gain that normalising goes back to.
    pub(in crate::viewer) gain: f32,
    /// Where somebody put the line of the wipe: the part of the frame's width that is A's, `0.0..=1.0`.
    pub(in crate::viewer) wipe: Option<f64>,
    /// Whether the pointer drags that line.
    pub(in crate::viewer) drags_line: bool,
    /// When both change places next (never by themselves where a hand flips them), and whether the one in the back is to
    /// be seen now.
    pub(in crate::viewer) flip: Option<(Option<Instant>, bool)>,
    /// Where B's frames arrive.
    pub(in crate::viewer) drawn: Mailbox<Drawn>,
    /// B's frames: started for the first B, and kept.
    pub(in crate::viewer) drawing: Option<Drawing>,
    /// What is to be seen while one of both frames shows where the other was before.
    pub(in crate::viewer) held: Option<[Arc<Frame>; 2]>,
    /// How differences are coloured, for the style and the frames that it was made for.
    pub(in crate::viewer) paint: Option<Paint>,
    pub(in crate::viewer) measuring: Measuring,
    /// When B, which nobody sees, is to be drawn.
    pub(in crate::viewer) postponed: Option<Instant>,
    /// The picture that is being read.
    pub(in crate::viewer) loading: Option<PathBuf>,
    /// Where pictures from outside are.
    pub(in crate::viewer) moved: Moved,
    /// How many B there were.
    pub(in crate::viewer) others: u64,
    /// How often both changed places.
    pub(in crate::viewer) swaps: u64,
    /// Grows with every change of what is to be seen that no frame's number tells.
    number: u64,
}

/// Colours of differences.
#[derive(Debug)]
pub(in crate::viewer) struct Paint {
    pub(in crate::viewer) colors: DifferencePaint,
    pub(in crate::viewer) style: DifferenceStyle,
    /// The frames' numbers and who is in front, where the colours depend on them.
    pub(in crate::viewer) frames: Option<[u64; 3]>,
}

impl Comparison {
    /// Whether B is needed on the screen.
    pub(in crate::viewer) fn shows_both(&self) -> bool {
        self.other.is_some() && (self.arrangement != Arrangement::Alone || self.swapped)
    }

    /// B's drawing, where B is drawn.
    pub(in crate::viewer) fn drawn_other(&self) -> Option<&Drawing> {
        self.drawing
            .as_ref()
            .filter(|_| matches!(self.other, Some(Other::Settings { .. } | Other::Truth(_))))
    }

    pub(in crate::viewer) fn drawing_mut(&mut self) -> Option<&mut Drawing> {
        self.drawing.as_mut()
    }

    /// What tells B's frame and everything else about comparing from what was to be seen before.
    pub(in crate::viewer) fn state(&self) -> [u64; 2] {
        [self.number, self.drawing.as_ref().map_or(0, Drawing::number)]
    }

    /// What changed of B's frame since this was asked last.
    pub(in crate::viewer) fn take_changes(&mut self) -> Changes {
        let none = Changes::Regions(Vec::new());
        self.drawing.as_mut().map_or(none, Drawing::take_changes)
    }

    /// Whether B is there, or nothing of it is wanted: no scene, or no window to show it in.
    pub(in crate::viewer) fn is_current(&self) -> bool {
        let waits = self.loading.is_some() || self.postponed.is_some();
        !waits && self.drawn_other().is_none_or(Drawing::is_current)
    }

    /// What is to be drawn later is decided anew.
    pub(in crate::viewer) fn forget_postponed(&mut self) {
        self.postponed = None;
    }

    pub(in crate::viewer) fn touch(&mut self) {
        self.number += 1;
    }
}
