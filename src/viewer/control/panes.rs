//! Where frames lie in the screen now, and how pictures with a size of their own are moved.

use glam::DVec2;

use crate::viewer::PixelRect;
use crate::viewer::ab::other::{Arrangement, Other};
use crate::viewer::settings::PixelZoom;
use crate::viewer::state::Viewer;
use crate::viewer::view::panes::{Moved, Pane, Panes};

/// Screen pixels between two pictures side by side.
const GAP: u32 = 2;

/// What two fingers must spread by to reach the next pixel zoom.
const ZOOM_STEP: f64 = 1.25;

impl Viewer {
    /// Where frames lie in the screen: the window's pixels divided by the pixel zoom.
    pub(in crate::viewer) fn panes(&self) -> Panes {
        let screen = self.settings.pixel_zoom.frame_size(self.chrome.window);
        let whole = PixelRect::of_size(screen);
        let side_by_side = self.arrangement() == Arrangement::SideBySide;
        let halves = side_by_side.then(|| self.halves()).flatten();
        if let Some(frame) = self.fixed_size() {
            let pane = |area: PixelRect, middle: &PixelRect| Pane {
                area,
                corner: self.ab.moved.corner(middle, frame),
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
    pub(in crate::viewer) fn fixed_size(&self) -> Option<[u32; 2]> {
        match self.ab.other.as_ref()? {
            Other::Picture(picture) => Some([picture.pixels.width(), picture.pixels.height()]),
            Other::Settings { .. } | Other::Truth(_) => None,
        }
    }

    /// The free area in whole screen pixels; `None` where there is none.
    pub(in super::super) fn free_screen(&self) -> Option<PixelRect> {
        let window = PixelRect::of_size(self.chrome.window);
        let free = self.chrome.free_area.map_or(window, |free| free.intersection(&window));
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
    pub(in crate::viewer) fn move_fixed(&mut self, by: DVec2) -> bool {
        let Some(frame) = self.fixed_size() else { return false };
        let area = self.panes().first.area;
        self.ab.moved.add(by, &area, frame);
        self.ab.touch();
        true
    }

    /// Takes them back to the middle.
    pub(in crate::viewer) fn center_fixed(&mut self) {
        self.ab.moved = Moved::default();
        self.ab.touch();
    }

    /// Zooms pictures that have a size of their own by steps of the pixel zoom; `at` is a window pixel that stays. False
    /// where there are none.
    pub(in crate::viewer) fn zoom_fixed(&mut self, at: Option<DVec2>, factor: f64) -> bool {
        if self.fixed_size().is_none() {
            return false;
        }
        let moved = &mut self.ab.moved;
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
    pub(in crate::viewer) fn zoom_fixed_to(&mut self, at: Option<DVec2>, zoom: PixelZoom) {
        let window = DVec2::from(self.chrome.window.map(f64::from));
        // The centre of a window pixel, so that the frame pixel there stays whatever the corner is rounded to.
        let at = at.unwrap_or(window / 2.0).floor() + 0.5;
        let before = self.frame_position(at);
        self.settings.pixel_zoom = zoom;
        let after = self.frame_position(at);
        self.move_fixed(after - before);
    }
}
