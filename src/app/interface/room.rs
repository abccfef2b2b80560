//! Which panels have room beside each other in a window of some width, and beside a pinned pixel.

use super::widths::SizedPanel;
use super::{Interface, LEAST_PICTURE, USEFUL_PICTURE, explanation, pin, places};
use crate::viewer::Viewer;

impl Interface {
    /// Whether a side panel beside the canvas of the default view leaves all of it free, in a window of `size` points.
    pub(in crate::app) fn panel_fits(size: [f32; 2]) -> bool {
        let canvas = size[0].min(size[1]) / 1.2;
        (size[0] - canvas) / 2.0 >= SizedPanel::Side.first()
    }

    /// Whether the explanation of a pixel has room in a window of that many points in width only without the side panel.
    pub(in crate::app) fn explanation_needs_panel(&self, viewer: &Viewer, window: f32) -> bool {
        let width = self.beside_lesson(viewer, window);
        explanation::fits(width) && !explanation::fits(width - self.widths.of(SizedPanel::Side, window))
    }

    /// What a lesson leaves of a window of that many points in width.
    pub(super) fn beside_lesson(&self, viewer: &Viewer, window: f32) -> f32 {
        let lesson = self.widths.of(SizedPanel::Lesson, window);
        let has_panel = viewer.lesson().is_some() && window >= lesson + LEAST_PICTURE;
        if has_panel { window - lesson } else { window }
    }

    /// Whether the text of a lesson is to be seen in a window of that many points in width.
    pub(in crate::app) fn has_room_for_lesson(&self, viewer: &Viewer, window: f32) -> bool {
        self.beside_lesson(viewer, window) < window
    }

    /// Whether a lesson leaves no room for the explanation of a pixel in a window of that many points in width: then both
    /// are pages of one panel.
    pub(in crate::app) fn lesson_shares_panel(&self, viewer: &Viewer, window: f32) -> bool {
        let beside = self.beside_lesson(viewer, window);
        beside < window && !explanation::fits(beside)
    }

    /// Whether a lesson and the side panel leave too little of the picture in a window of that many points in width.
    pub(in crate::app) fn lesson_crowds_panel(&self, viewer: &Viewer, window: f32) -> bool {
        let beside = self.beside_lesson(viewer, window);
        beside < window && beside - self.widths.of(SizedPanel::Side, window) < USEFUL_PICTURE / 2.0
    }

    /// Whether the explanation of a pixel has room in a window of that many points in width.
    pub(in crate::app) fn has_room_to_explain(&self, viewer: &Viewer, window: f32) -> bool {
        if self.lesson_shares_panel(viewer, window) {
            return true;
        }
        let panel = if viewer.chrome().panel() {
            self.widths.of(SizedPanel::Side, window)
        } else {
            0.0
        };
        explanation::fits(self.beside_lesson(viewer, window) - panel)
    }

    /// Whether the numbers of a comparison, and what the colours of a difference mean, have room in a window of that many points in
    /// width: beside the side panel, or in the explanation of a pixel.
    pub(in crate::app) fn has_room_to_compare(&self, viewer: &Viewer, window: f32) -> bool {
        let beside = self.beside_lesson(viewer, window) - self.widths.of(SizedPanel::Side, window);
        let explains = viewer.pixels().has_explanation_open() && self.has_room_to_explain(viewer, window);
        explains || beside >= self.widths.of(SizedPanel::Comparison, window) + LEAST_PICTURE
    }

    /// Whether the side panel of a window of that many points in width leaves the pinned pixel in sight.
    pub(in crate::app) fn panel_leaves_pin(&self, viewer: &Viewer, window: f32, pixels_per_point: f32) -> bool {
        let left = window - self.widths.of(SizedPanel::Side, window) - pin::ROOM;
        let places = viewer.pixels().pinned_places();
        places
            .iter()
            .all(|place| places::points(place, pixels_per_point).right() < left)
    }
}
