//! Where frames lie in the screen: over all of it, in two halves, or, where B is a picture from outside, in its own size
//! and where the hand moved them.

use glam::DVec2;

use crate::figure::PixelRect;
use crate::raster::Region;
use crate::viewer::view::camera::Camera;

/// Where a frame lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) struct Pane {
    /// The part of the screen that it may fill.
    pub(in crate::viewer) area: PixelRect,
    /// The screen pixel of the frame's upper left corner; it may lie outside the area.
    pub(in crate::viewer) corner: [i64; 2],
}

impl Pane {
    /// Where pixels of the frame lie in the screen, as if the pane had no end.
    pub(in crate::viewer) fn place(&self, region: Region) -> PixelRect {
        PixelRect {
            x: i64::from(region.x) + self.corner[0],
            y: i64::from(region.y) + self.corner[1],
            width: region.width,
            height: region.height,
        }
    }
}

/// Where frames lie in the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) struct Panes {
    /// Width and height of every frame.
    pub(in crate::viewer) frame: [u32; 2],
    /// Where the first lies.
    pub(in crate::viewer) first: Pane,
    /// Where B lies, where it has a place of its own.
    pub(in crate::viewer) second: Option<Pane>,
}

impl Panes {
    /// The pane that a screen pixel belongs to, the first where it belongs to none.
    pub(in crate::viewer) fn at(&self, pixel: [i64; 2]) -> Pane {
        let in_second = self.second.filter(|pane| pane.area.contains(pixel));
        in_second.unwrap_or(self.first)
    }
}

/// The view that a hand has set, while A and B are arranged in other ways than there.
#[derive(Clone, Copy, Debug)]
pub(in crate::viewer) struct Arranged {
    /// That view.
    pub(in crate::viewer) own: Camera,
    /// What the explanation keeps of it.
    pub(in crate::viewer) kept: Option<[Camera; 2]>,
    /// Where its frames lay.
    pub(in crate::viewer) panes: Panes,
    /// The middle of the free part of the first of them, in screen pixels.
    pub(in crate::viewer) middle: Option<DVec2>,
    /// The views that stand in its place now, before and after a pin was brought into sight; they count until a hand sets
    /// another.
    pub(in crate::viewer) set: [Camera; 2],
}

/// Screen pixels of a picture from outside that stay in sight.
const LEAST_IN_SIGHT: i64 = 16;

/// Where the hand moved pictures that have a size of their own.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::viewer) struct Moved {
    /// Screen pixels from the middle of the pane.
    by: DVec2,
    /// What of it keeps an explained pixel where it was, until the explanation is closed.
    kept: DVec2,
    /// Where pictures were moved to when the room for an explanation took its pixel away from under the pointer.
    slid: Option<DVec2>,
    /// What is left of a zoom that did not reach the next step.
    pub(in crate::viewer) rest: f64,
}

impl Moved {
    /// The corner of a picture of `size` in the middle of `area`, moved.
    pub(in crate::viewer) fn corner(&self, area: &PixelRect, size: [u32; 2]) -> [i64; 2] {
        #[expect(clippy::cast_possible_truncation, reason = "pixels of a screen")]
        let [x, y] = self.by.round().to_array().map(|by| by as i64);
        let middle = |from: i64, room: u32, side: u32| from + (i64::from(room) - i64::from(side)).div_euclid(2);
        [
            middle(area.x, area.width, size[0]) + x,
            middle(area.y, area.height, size[1]) + y,
        ]
    }

    /// Moves on for as long as a pixel is explained.
    pub(in crate::viewer) fn keep(&mut self, by: DVec2, area: &PixelRect, size: [u32; 2]) {
        let before = self.by;
        self.add(by, area, size);
        self.kept += self.by - before;
    }

    /// Takes back what an explanation moved.
    pub(in crate::viewer) fn let_go(&mut self) {
        self.by -= std::mem::take(&mut self.kept);
        self.slid = None;
    }

    /// The room for an explanation takes its pixel away from under the pointer.
    pub(in crate::viewer) fn slide(&mut self) {
        self.slid = Some(self.by);
    }

    /// Whether it did, and no hand has moved the pictures since.
    pub(in crate::viewer) fn has_slid(&self) -> bool {
        self.slid == Some(self.by)
    }

    /// Moves on; some of the picture stays in sight.
    pub(in crate::viewer) fn add(&mut self, by: DVec2, area: &PixelRect, size: [u32; 2]) {
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
