//! Where frames lie in the screen: over all of it, in two halves, or, where B is a picture from outside, in its own size
//! and where the hand moved them.

use glam::DVec2;

use super::super::{PixelRect, PixelZoom, Viewer};
use super::composite::Pane;
use super::{Arrangement, Other};

/// Screen pixels between two pictures side by side.
const GAP: u32 = 2;

/// Where frames lie in the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) struct Panes {
    /// Width and height of every frame.
    pub(in super::super) frame: [u32; 2],
    /// Where the first lies.
    pub(in super::super) first: Pane,
    /// Where B lies, where it has a place of its own.
    pub(in super::super) second: Option<Pane>,
}

impl Panes {
    /// The pane that a screen pixel belongs to, the first where it belongs to none.
    pub(in super::super) fn at(&self, pixel: [i64; 2]) -> Pane {
        let in_second = self.second.filter(|pane| pane.area.contains(pixel));
        in_second.unwrap_or(self.first)
    }
}

/// Screen pixels of a picture from outside that stay in sight.
const LEAST_IN_SIGHT: i64 = 16;
/// What two fingers must spread by to reach the next pixel zoom.
const ZOOM_STEP: f64 = 1.25;

/// Where the hand moved pictures that have a size of their own.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moved {
    /// Screen pixels from the middle of the pane.
    by: DVec2,
    /// What is left of a zoom that did not reach the next step.
    rest: f64,
}

impl Viewer {
    /// Where frames lie in the screen: the window's pixels divided by the pixel zoom.
    pub(in super::super) fn panes(&self) -> Panes {
        let screen = self.settings.pixel_zoom.frame_size(self.screen.window);
        let whole = PixelRect::of_size(screen);
        let side_by_side = self.arrangement() == Arrangement::SideBySide;
        let halves = side_by_side.then(|| self.halves()).flatten();
        if let Some(frame) = self.fixed_size() {
            let pane = |area: PixelRect, middle: &PixelRect| Pane {
                area,
                corner: self.comparison.moved.corner(middle, frame),
            };
            return match halves {
                Some([left, right]) => Panes {
                    frame,
                    first: pane(left, &left),
                    second: Some(pane(right, &right)),
                },
                None => Panes {
                    frame,
                    first: pane(whole, &self.free_screen().unwrap_or(whole)),
                    second: None,
                },
            };
        }
        let pane = |area: PixelRect| Pane {
            area,
            corner: [area.x, area.y],
        };
        match halves {
            Some([left, right]) => Panes {
                frame: [left.width, left.height],
                first: pane(left),
                second: Some(pane(right)),
            },
            None => Panes {
                frame: screen,
                first: pane(whole),
                second: None,
            },
        }
    }

    /// The size of both frames, where a picture from outside gives it.
    pub(in super::super) fn fixed_size(&self) -> Option<[u32; 2]> {
        match self.comparison.other.as_ref()? {
            Other::Picture(picture) => Some([picture.pixels.width(), picture.pixels.height()]),
            Other::Settings { .. } | Other::Truth(_) => None,
        }
    }

    /// The free area in whole screen pixels; `None` where there is none.
    pub(in super::super) fn free_screen(&self) -> Option<PixelRect> {
        let window = PixelRect::of_size(self.screen.window);
        let free = self.screen.free_area.map_or(window, |free| free.intersection(&window));
        if free.width == 0 || free.height == 0 {
            return None;
        }
        let zoom = i64::from(self.settings.pixel_zoom.factor());
        let (x, y) = ((free.x + zoom - 1) / zoom, (free.y + zoom - 1) / zoom);
        let side = |from: i64, to: i64| u32::try_from(to / zoom - from).ok().filter(|side| *side > 0);
        let (width, height) = (side(x, free.right())?, side(y, free.bottom())?);
        Some(PixelRect { x, y, width, height })
    }

    /// The free area's left and right half, of one size, in screen pixels; `None` where there is no room.
    fn halves(&self) -> Option<[PixelRect; 2]> {
        let free = self.free_screen()?;
        let width = free.width.checked_sub(GAP)? / 2;
        let first = PixelRect { width, ..free };
        let second = PixelRect {
            x: free.x + i64::from(width + GAP),
            ..first
        };
        (width > 0).then_some([first, second])
    }

    /// Moves pictures that have a size of their own; false where there are none.
    pub(in super::super) fn move_fixed(&mut self, by: DVec2) -> bool {
        let Some(frame) = self.fixed_size() else { return false };
        let area = self.panes().first.area;
        self.comparison.moved.add(by, &area, frame);
        self.comparison.touch();
        true
    }

    /// Takes them back to the middle.
    pub(in super::super) fn center_fixed(&mut self) {
        self.comparison.moved = Moved::default();
        self.comparison.touch();
    }

    /// Zooms pictures that have a size of their own by steps of the pixel zoom; `at` is a window pixel that stays. False
    /// where there are none.
    pub(in super::super) fn zoom_fixed(&mut self, at: Option<DVec2>, factor: f64) -> bool {
        if self.fixed_size().is_none() {
            return false;
        }
        let moved = &mut self.comparison.moved;
        let steps = moved.rest + factor.ln() / ZOOM_STEP.ln();
        if !steps.is_finite() {
            return true;
        }
        let whole = steps.round().clamp(-10.0, 10.0);
        moved.rest = (steps - whole).clamp(-1.0, 1.0);
        let now = self.settings.pixel_zoom;
        let mut place = PixelZoom::ALL.iter().position(|zoom| *zoom == now).unwrap_or(0);
        for step in 0..10 {
            if f64::from(step) < whole.abs() {
                place = if whole > 0.0 {
                    place + 1
                } else {
                    place.saturating_sub(1)
                };
            }
        }
        let next = PixelZoom::ALL[place.min(PixelZoom::ALL.len() - 1)];
        self.zoom_fixed_to(at, next);
        true
    }

    /// The same to a certain pixel zoom.
    pub(in super::super) fn zoom_fixed_to(&mut self, at: Option<DVec2>, zoom: PixelZoom) {
        let window = DVec2::from(self.screen.window.map(f64::from));
        // The centre of a window pixel, so that the frame pixel there stays whatever the corner is rounded to.
        let at = at.unwrap_or(window / 2.0).floor() + 0.5;
        let before = self.frame_position(at);
        self.settings.pixel_zoom = zoom;
        let after = self.frame_position(at);
        self.move_fixed(after - before);
    }
}

impl Moved {
    /// The corner of a picture of `size` in the middle of `area`, moved.
    fn corner(&self, area: &PixelRect, size: [u32; 2]) -> [i64; 2] {
        #[expect(clippy::cast_possible_truncation, reason = "pixels of a screen")]
        let [x, y] = self.by.round().to_array().map(|by| by as i64);
        let middle = |from: i64, room: u32, side: u32| from + (i64::from(room) - i64::from(side)).div_euclid(2);
        [
            middle(area.x, area.width, size[0]) + x,
            middle(area.y, area.height, size[1]) + y,
        ]
    }

    /// Moves on; some of the picture stays in sight.
    fn add(&mut self, by: DVec2, area: &PixelRect, size: [u32; 2]) {
        let moved = self.by + by;
        if !moved.is_finite() {
            return;
        }
        let room = |room: u32, side: u32| {
            let both = i64::midpoint(room.into(), side.into()) - LEAST_IN_SIGHT;
            both.max(0) as f64
        };
        let limit = DVec2::new(room(area.width, size[0]), room(area.height, size[1]));
        self.by = moved.clamp(-limit, limit);
    }
}
