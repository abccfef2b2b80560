//! The line of an edge profile: where it lies, what the pointer drags of it, what the truth has along it.

pub(in crate::viewer) mod truth;

use glam::DVec2;

use crate::compare::{Line, ProfileChannel};
use crate::viewer::library::state::SceneList;
use crate::viewer::profile::truth::TruthAlong;
use crate::viewer::view::layout::WindowLayout;
use crate::viewer::view::pointer::window_pixel;

/// The state of profiles.
#[derive(Debug)]
pub(in crate::viewer) struct Profiling {
    /// Whether a drag draws the line, and the plot is to be seen.
    pub(in crate::viewer) open: bool,
    /// What of colours is plotted.
    pub(in crate::viewer) channel: ProfileChannel,
    line: Option<PlacedLine>,
    /// What the pointer does to it.
    pub(in crate::viewer) drag: Option<LineDrag>,
    pub(in crate::viewer) truth: TruthAlong,
}

/// A line that stays at its place in the scene, as a pin does.
#[derive(Clone, Copy, Debug, PartialEq)]
struct PlacedLine {
    /// The frame pixels that its ends fall in now; they may lie outside the frame.
    line: Line,
    /// The ends in canvas units, and the scene's number and generation; `None` until the scene was read.
    places: Option<([DVec2; 2], (usize, u64))>,
}

/// What a pointer that is down does to the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) enum LineDrag {
    /// It went down at this frame pixel: from there a new line begins once it moves, so that a click leaves the old one.
    From([i64; 2]),
    /// It moves the end with this number.
    End(usize),
}

impl Profiling {
    pub(in crate::viewer) fn new(truth: TruthAlong) -> Self {
        Self {
            open: false,
            channel: ProfileChannel::default(),
            line: None,
            drag: None,
            truth,
        }
    }

    /// The line, in frame pixels.
    pub(in crate::viewer) fn line(&self) -> Option<Line> {
        self.line.map(|placed| placed.line).filter(|_| self.open)
    }

    /// Begins to draw lines, or ends that; the line that was drawn last comes back.
    pub(in crate::viewer) fn show(&mut self, open: bool) {
        (self.open, self.drag) = (open, None);
    }

    /// Shows the profile along this line.
    pub(in crate::viewer) fn set_line(&mut self, line: Line) {
        self.open = true;
        self.line = Some(PlacedLine { line, places: None });
    }

    /// Ends drawing lines; true if one could be drawn.
    pub(in crate::viewer) fn escape(&mut self) -> bool {
        self.drag = None;
        std::mem::take(&mut self.open)
    }

    /// The pointer that is down came to this frame pixel.
    pub(in crate::viewer) fn drag_to(&mut self, pixel: [i64; 2]) {
        match (self.drag, self.line()) {
            (Some(LineDrag::From(start)), _) if start != pixel => {
                self.set_line(Line { ends: [start, pixel] });
                self.drag = Some(LineDrag::End(1));
            }
            (Some(LineDrag::End(end)), Some(mut line)) => {
                if let Some(end) = line.ends.get_mut(end) {
                    *end = pixel;
                }
                self.set_line(line);
            }
            _ => {}
        }
    }

    /// Keeps the line at its place in the scene, whatever the view and the window do. Another scene has other places: there it
    /// stays at its pixels.
    pub(in crate::viewer) fn keep_in_place(&mut self, scenes: &SceneList, layout: &WindowLayout) {
        let context = scenes.view_context(layout.frame_size());
        let context = context.filter(|context| !context.frame.contains(&0));
        let (Some(placed), Some(context), Some(camera)) = (&mut self.line, context, scenes.camera()) else {
            return;
        };
        let view = camera.transform(&context);
        let scene = scenes.identity();
        match placed.places {
            Some((places, of)) if of == scene => {
                placed.line.ends = places.map(|place| window_pixel(view.to_pixels(place)));
            }
            _ => {
                let middle = |end: [i64; 2]| DVec2::new(end[0] as f64, end[1] as f64) + 0.5;
                placed.places = Some((placed.line.ends.map(|end| view.to_scene(middle(end))), scene));
            }
        }
    }
}
