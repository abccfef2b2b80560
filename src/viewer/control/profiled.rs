//! The edge profile at this moment: its line in the window, and what A, B and the truth have along it.

use glam::DVec2;

use crate::compare::{Line, Profile, ProfileChannel};
use crate::raster::Framebuffer;
use crate::viewer::PixelRect;
use crate::viewer::ProfileCommand;
use crate::viewer::ab::other::Other;
use crate::viewer::chrome::Chrome;
use crate::viewer::control::both::Both;
use crate::viewer::control::hand::Hand;
use crate::viewer::profile::truth::LineOfPicture;
use crate::viewer::profile::{LineDrag, Profiling};
use crate::viewer::view::layout::magnified;
use crate::viewer::view::pointer::window_pixel;

/// Window pixels around the middle of an end where a press takes hold of it, on a display with a pixel per point.
const GRIP: f64 = 9.0;

/// Whose values a curve has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ProfileSide {
    /// A's.
    A,
    /// B's, unless that is the truth.
    B,
    /// 256 samples per pixel.
    Truth,
}

/// The values along the line of one picture.
#[derive(Clone, Debug, PartialEq)]
pub struct ProfileCurve {
    /// Whose.
    pub side: ProfileSide,
    /// The pixels.
    pub profile: Profile,
    /// Whether they are those of this moment, and no preview's.
    pub is_final: bool,
}

/// Where the line is in a pane of the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinePlace {
    /// The middles of its ends, in window pixels; they may lie outside the pane.
    pub ends: [DVec2; 2],
    /// The pane.
    pub area: PixelRect,
}

/// The edge profile over A and B.
#[derive(Clone, Copy, Debug)]
pub struct Profiled<'a> {
    pub(in crate::viewer) both: Both<'a>,
    pub(in crate::viewer) chrome: &'a Chrome,
    pub(in crate::viewer) profiling: &'a Profiling,
}

impl Profiled<'_> {
    /// Whether a drag over the picture draws the line.
    pub fn is_open(&self) -> bool {
        self.profiling.open && !self.chrome.hidden
    }

    /// What of colours is plotted.
    pub fn channel(&self) -> ProfileChannel {
        self.profiling.channel
    }

    /// The line, in frame pixels; `None` until one was drawn, and while the profile is closed.
    pub fn line(&self) -> Option<Line> {
        self.profiling.line()
    }

    /// Whether the pointer is drawing the line, or drags an end of it.
    pub fn is_dragging(&self) -> bool {
        self.profiling.drag.is_some()
    }

    /// Where the line is to be seen: in every pane.
    pub fn places(&self) -> Vec<LinePlace> {
        self.line().map_or_else(Vec::new, |line| self.places_of(line.ends))
    }

    /// Where in the window the middle of a frame pixel is, in every pane.
    pub fn middles(&self, pixel: [u32; 2]) -> Vec<LinePlace> {
        self.places_of([pixel.map(i64::from); 2])
    }

    fn places_of(&self, ends: [[i64; 2]; 2]) -> Vec<LinePlace> {
        let layout = &self.both.layout;
        let zoom = f64::from(layout.zoom());
        let panes = layout.panes();
        let all = std::iter::once(panes.first).chain(panes.second);
        let place = all.map(|pane| LinePlace {
            ends: ends.map(|[x, y]| {
                let corner = DVec2::new(pane.corner[0] as f64, pane.corner[1] as f64);
                (DVec2::new(x as f64, y as f64) + corner + 0.5) * zoom
            }),
            area: magnified(&pane.area, layout.zoom()),
        });
        place.collect()
    }

    /// The end that a press at a window pixel takes hold of, in whichever pane.
    pub fn end_at(&self, at: DVec2) -> Option<usize> {
        if !self.is_open() {
            return None;
        }
        let inside = |place: &LinePlace| place.area.contains(window_pixel(at));
        let places = self.places();
        let ends = places.iter().filter(|place| inside(place)).flat_map(|place| {
            let distance = |end: usize| (end, place.ends[end].distance(at));
            [distance(0), distance(1)]
        });
        let near = ends.min_by(|a, b| a.1.total_cmp(&b.1));
        near.filter(|(_, distance)| *distance <= GRIP * f64::from(self.chrome.interface_factor()))
            .map(|(end, _)| end)
    }

    /// What is to be plotted; nothing without a line or a picture.
    pub fn curves(&self) -> Vec<ProfileCurve> {
        let Some((line, frame)) = self.line().zip(self.both.frames.frame()) else {
            return Vec::new();
        };
        let settled = self.both.frames.drawing.is_current();
        let curve = |side: ProfileSide, pixels: &Framebuffer, is_final: bool| ProfileCurve {
            side,
            profile: Profile::of(pixels, line),
            is_final,
        };
        let mut curves = vec![curve(ProfileSide::A, &frame.pixels, settled)];
        let is_truth = matches!(self.both.ab.other(), Some(Other::Truth(_)));
        if let Some([front, back]) = self.both.pair().filter(|_| self.both.ab.other().is_some()) {
            let b = if self.both.ab.is_swapped() { front } else { back };
            let side = if is_truth { ProfileSide::Truth } else { ProfileSide::B };
            curves.push(curve(side, b, settled && self.both.ab.is_current()));
        }
        if !is_truth && let Some(Some(truth)) = self.profiling.truth.newest() {
            curves.push(ProfileCurve {
                side: ProfileSide::Truth,
                profile: truth.clone(),
                is_final: settled && self.profiling.truth.is_current(),
            });
        }
        curves
    }

    /// What the truth is asked for; `None` where it is B already.
    pub(in crate::viewer) fn question(&self) -> Option<LineOfPicture> {
        let line = self.line()?;
        let picture = self.both.frames.frame()?.picture.clone();
        let is_b = matches!(self.both.ab.other(), Some(Other::Truth(_)));
        let space = self.both.ab.truth_space();
        (!is_b).then_some(LineOfPicture { picture, line, space })
    }
}

impl Hand<'_> {
    pub(in crate::viewer) fn profiled(&self) -> Profiled<'_> {
        Profiled {
            both: self.both(),
            chrome: self.chrome,
            profiling: self.profiling,
        }
    }

    pub(in crate::viewer) fn apply_profile(&mut self, command: ProfileCommand) {
        match command {
            ProfileCommand::Show(toggle) => {
                // What is hidden is not open to the eye.
                let open = self.profiled().is_open();
                self.profiling.show(toggle.of(open));
            }
            ProfileCommand::SetLine(ends) => self.profiling.set_line(Line { ends }),
            ProfileCommand::SetChannel(channel) => {
                self.profiling.channel = channel;
                self.profiling.show(true);
            }
        }
        self.chrome.hidden &= !self.profiling.open;
        self.spectrum.open &= !self.profiling.open;
    }

    /// Takes hold of an end of the line, or of the pixel where a new one begins.
    pub(in crate::viewer) fn press_on_line(&mut self) {
        let Some(at) = self.pointer.at.filter(|_| self.profiled().is_open()) else {
            return;
        };
        if self.pixels().over_inset() {
            return;
        }
        let end = self.profiled().end_at(at).map(LineDrag::End);
        let layout = self.layout();
        let begins = || Some(LineDrag::From(layout.frame_pixel(window_pixel(at))));
        self.profiling.drag = match end {
            None if self.pixels().over_line() => None,
            None => begins(),
            end => end,
        };
    }

    /// The line follows the pointer, within the frame.
    pub(in crate::viewer) fn drag_profile(&mut self, to: DVec2) {
        let layout = self.layout();
        if let Some(pixel) = layout.nearest_in_frame(layout.frame_pixel(window_pixel(to))) {
            self.profiling.drag_to(pixel.map(i64::from));
        }
    }

    /// Asks what the truth has along the line. While the picture moves, the last answer stays: drawing others would only slow
    /// it down.
    pub(in crate::viewer) fn want_truth_along_line(&mut self) {
        if self.profiling.open && !self.frames.drawing.is_current() {
            return;
        }
        let question = self.profiled().question();
        self.profiling.truth.want(question, |_| None);
    }
}
