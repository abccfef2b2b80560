//! The state of comparing.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::color::ResolveSpace;
use crate::compare::{DifferencePaint, DifferenceStyle};
use crate::raster::Framebuffer;
use crate::viewer::ab::measuring::{Measured, Measuring, Stage};
use crate::viewer::ab::other::{Arrangement, Other};
use crate::viewer::chrome::Chrome;
use crate::viewer::frames::drawing::{Changes, Drawing};
use crate::viewer::frames::frame::{Frame, PreviewQuality};
use crate::viewer::frames::job::Drawn;
use crate::viewer::jobs::mailbox::Mailbox;
use crate::viewer::settings::PixelZoom;
use crate::viewer::view::layout::{Sharing, WindowLayout};
use crate::viewer::view::panes::{Arranged, Moved};

impl Comparison {
    pub(in crate::viewer) fn new(drawn: Mailbox<Drawn>, measuring: Measuring) -> Self {
        Self {
            other: None,
            truth_space: None,
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
            arranged: None,
            others: 0,
            swaps: 0,
            measuring,
            stages: None,
            number: 0,
        }
    }
}

/// The state of comparing.
#[derive(Debug)]
pub struct Comparison {
    pub(in crate::viewer) other: Option<Other>,
    /// In which values the truth is averaged, where that was chosen and B says nothing else.
    pub(in crate::viewer) truth_space: Option<ResolveSpace>,
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
    /// The view that a hand set in another arrangement.
    pub(in crate::viewer) arranged: Option<Arranged>,
    /// How many B there were.
    pub(in crate::viewer) others: u64,
    /// How often both changed places.
    pub(in crate::viewer) swaps: u64,
    /// How both frames were made that are not final, where their difference is to be seen.
    pub(in crate::viewer) stages: Option<[Option<PreviewQuality>; 2]>,
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

/// A comparison that is put aside.
#[derive(Debug)]
pub(in crate::viewer) struct Kept {
    other: Option<Other>,
    swapped: bool,
    arrangement: Arrangement,
    style: DifferenceStyle,
    gain: f32,
    wipe: Option<f64>,
}

impl Comparison {
    /// What a lesson puts aside.
    pub(in crate::viewer) fn keep(&self) -> Kept {
        Kept {
            other: self.other.clone(),
            swapped: self.swapped,
            arrangement: self.arrangement,
            style: self.style,
            gain: self.gain,
            wipe: self.wipe,
        }
    }

    /// Takes up what was put aside.
    pub(in crate::viewer) fn take_up(&mut self, kept: Kept) {
        self.set_other(kept.other);
        (self.swapped, self.arrangement, self.wipe) = (kept.swapped, kept.arrangement, kept.wipe);
        (self.style, self.gain) = (kept.style, kept.gain);
    }

    /// What A is compared with.
    pub fn other(&self) -> Option<&Other> {
        self.other.as_ref()
    }

    /// How A and B share the window.
    pub fn arrangement(&self) -> Arrangement {
        match self.other {
            Some(_) => self.arrangement,
            None => Arrangement::Alone,
        }
    }

    /// How differences are shown.
    pub fn difference_style(&self) -> DifferenceStyle {
        self.style
    }

    /// What shown differences are multiplied with; `None` while they are not to be seen.
    pub fn difference_gain(&self) -> Option<f32> {
        Some(self.paint.as_ref()?.colors.gain())
    }

    /// Whether B stands where A else does.
    pub fn is_swapped(&self) -> bool {
        self.swapped
    }

    /// Whether all of B is to be seen, in place of A.
    pub fn shows_b(&self) -> bool {
        self.swapped != self.flip_shows_back()
    }

    /// The picture that is being read as B.
    pub fn loading_picture(&self) -> Option<&Path> {
        self.loading.as_deref()
    }

    /// B's pixels as they are on the screen or would be; they may be a preview's.
    pub fn other_pixels(&self) -> Option<&Framebuffer> {
        match (self.other.as_ref()?, &self.held) {
            (Other::Picture(picture), _) => Some(&picture.pixels),
            (_, Some([_, b])) => Some(&b.pixels),
            (_, None) => Some(&self.drawing.as_ref()?.frame()?.pixels),
        }
    }

    /// A pixel of B, straight `[r, g, b, a]`, if it is final.
    pub(in crate::viewer) fn other_final_rgba(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        match (self.other.as_ref()?, &self.held) {
            (Other::Picture(picture), _) => picture.pixels.rgba(x, y),
            (_, Some([_, b])) => b.final_rgba(x, y),
            (_, None) => self.drawing.as_ref()?.frame()?.final_rgba(x, y),
        }
    }

    /// The size of both frames, where a picture from outside gives it.
    pub(in crate::viewer) fn fixed_size(&self) -> Option<[u32; 2]> {
        match self.other.as_ref()? {
            Other::Picture(picture) => Some([picture.pixels.width(), picture.pixels.height()]),
            Other::Settings { .. } | Other::Truth(_) => None,
        }
    }

    /// Where frames lie in the window.
    pub(in crate::viewer) fn layout(&self, zoom: PixelZoom, chrome: &Chrome) -> WindowLayout {
        let sharing = Sharing {
            side_by_side: self.arrangement() == Arrangement::SideBySide,
            fixed_size: self.fixed_size(),
            moved: &self.moved,
        };
        WindowLayout::new(zoom, chrome, sharing)
    }

    /// Whether the one in the back is to be seen of both that flip.
    pub(in crate::viewer) fn flip_shows_back(&self) -> bool {
        matches!(self.flip, Some((_, true)))
    }

    /// When something about comparing is to be done: flipping, measuring, looking at B again.
    pub(in crate::viewer) fn due(&self) -> Option<Instant> {
        let flip = self.flip.and_then(|(due, _)| due);
        let drawing = self.drawing.as_ref().and_then(Drawing::due);
        let other = self.postponed.filter(|_| self.other.is_some());
        let all = [flip, drawing, other, self.measuring.due()];
        all.into_iter().flatten().min()
    }

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

    /// B's drawing, where B is to be seen.
    fn seen_other(&self) -> Option<&Drawing> {
        self.drawn_other().filter(|_| self.shows_both())
    }

    /// What the status line says where B is to be seen and is not final, such as `refining 20 %`.
    pub fn preview_text(&self) -> Option<String> {
        self.seen_other()?.preview_text()
    }

    /// As [`Frames::wait_is_told_in`](crate::viewer::Frames::wait_is_told_in), of B where it is to be seen.
    pub fn wait_is_told_in(&self) -> Option<Duration> {
        self.seen_other()?.wait_is_told_in()
    }

    /// Whether B is there, or nothing of it is wanted: no scene, or no window to show it in.
    pub(in crate::viewer) fn is_current(&self) -> bool {
        let waits = self.loading.is_some() || self.measuring.rereads > 0 || self.postponed.is_some();
        !waits && self.drawn_other().is_none_or(Drawing::is_current)
    }

    /// What is to be drawn later is decided anew.
    pub(in crate::viewer) fn forget_postponed(&mut self) {
        self.postponed = None;
    }

    pub(in crate::viewer) fn touch(&mut self) {
        self.number += 1;
    }

    /// Takes in what the thread found out; true if that is news of these two.
    pub(in crate::viewer) fn measured(&mut self, measured: Measured) -> bool {
        let measuring = &mut self.measuring;
        if measured.stage != Stage::More {
            measuring.running = None;
        }
        if self.other.is_none() || measured.stage == Stage::GivenUp {
            return false;
        }
        if let Some(measures) = measured.measures {
            measuring.found = Some((measured.which, measures));
        }
        if measured.stage == Stage::Ended {
            measuring.complete = Some(measured.which);
        }
        true
    }

    /// The line of the wipe is where nobody moved it, and differences are coloured as at first.
    pub(in crate::viewer) fn forget_looks(&mut self) {
        (self.wipe, self.style, self.gain) = (None, DifferenceStyle::default(), 1.0);
        self.touch();
    }

    /// Takes pictures of a size of their own back to the middle.
    pub(in crate::viewer) fn center(&mut self) {
        self.moved = Moved::default();
        self.touch();
    }
}
