//! The panels beside the side panel: a lesson, the comparison, and why a pixel has its colour.

use egui::{Panel, Rect, ScrollArea, Ui};

use super::explanation_side::{Room, Side};
use super::focus::FocusPanel;
use super::widths::SizedPanel;
use super::{Asked, Hovered, Interface, compare, explanation, lesson, look, panel_frame, pin, places};
use crate::viewer::{Arrangement, Viewer};

impl Interface {
    /// The lesson beside the picture. Where it leaves no room for the explanation of a pixel, that is a page of its panel,
    /// and what the pointer is over there is returned.
    pub(super) fn lesson_panel(
        &mut self,
        ui: &mut Ui,
        viewer: &Viewer,
        window: f32,
        asked: &mut Asked,
    ) -> Option<Hovered> {
        let shares = self.lesson_shares_panel(viewer, window);
        let commands = &mut asked.commands;
        let memory = &mut self.explanation;
        let panel = Panel::left("lesson panel")
            .resizable(false)
            .exact_size(self.widths.of(SizedPanel::Lesson, window))
            .frame(panel_frame(ui, look::scrolling_margin(8)))
            .show(ui, |ui| {
                FocusPanel::Lesson.head(ui);
                look::bars_beside(ui);
                look::beside_bar(ui, |ui| {
                    lesson::head(ui, viewer, commands);
                    lesson::other_scene(ui, viewer, commands);
                });
                if shares && viewer.pixels().pinned().is_some() {
                    look::beside_bar(ui, |ui| lesson::pages(ui, viewer, commands));
                    if lesson::is_turned(viewer) {
                        (memory.has_comparison, memory.is_page) = (viewer.ab().other().is_some(), true);
                        return memory.show(ui, viewer, commands);
                    }
                }
                lesson::text(ui, viewer, commands);
                Hovered::default()
            });
        self.cover(ui, SizedPanel::Lesson, true, panel.response.rect);
        shares.then_some(panel.inner)
    }

    /// On the left, unless that would cover the pinned pixel. The panel keeps its side as long as it is to be seen, so that
    /// its buttons stay under the pointer.
    pub(super) fn compare_panel(&mut self, ui: &mut Ui, viewer: &Viewer, window: f32, asked: &mut Asked) {
        let width = self.widths.of(SizedPanel::Comparison, window);
        let room = ui.available_rect_before_wrap();
        let scale = ui.pixels_per_point();
        let on_right = *self.comparison_on_right.get_or_insert_with(|| {
            if viewer.ab().arrangement() == Arrangement::SideBySide {
                // Both halves lie beside it, wherever it is.
                return false;
            }
            let places = viewer.pixels().pinned_places();
            let pin = places.first().map(|place| places::points(place, scale).center().x);
            pin.is_some_and(|x| {
                let beside_left = x - room.left() - width;
                let beside_right = room.right() - width - x;
                beside_left < pin::ROOM && beside_left < beside_right
            })
        });
        let panel = if on_right {
            Panel::right("compare panel on the right")
        } else {
            Panel::left("compare panel")
        };
        let panel = panel
            .resizable(false)
            .exact_size(width)
            .frame(panel_frame(ui, look::scrolling_margin(4)))
            .show(ui, |ui| {
                FocusPanel::Comparison.head(ui);
                look::bars_beside(ui);
                let area = ScrollArea::vertical().id_salt("compare").auto_shrink(false);
                area.show(ui, |ui| compare::show(ui, viewer, &mut asked.commands));
            });
        self.cover(ui, SizedPanel::Comparison, !on_right, panel.response.rect);
    }

    /// Notes that a panel covers the picture, and lets its edge be dragged.
    pub(super) fn cover(&mut self, ui: &Ui, panel: SizedPanel, is_left: bool, rect: Rect) {
        let grip = self.widths.edge(ui, panel, is_left, rect);
        self.covered.extend([rect, grip]);
    }

    /// Why the pinned pixel has its colour, beside the picture.
    pub(super) fn explanation(&mut self, ui: &mut Ui, viewer: &Viewer, whole: Rect, asked: &mut Asked) -> Hovered {
        let free = ui.available_rect_before_wrap().intersect(whole);
        let in_lesson = viewer.lesson().is_some();
        if std::mem::replace(&mut self.in_lesson, in_lesson) && !in_lesson {
            // A lesson's side is for its pin.
            self.explanation_side = None;
        }
        if !explanation::is_shown(viewer, free.width()) {
            self.explanation_side = None;
            return Hovered::default();
        }
        let width = self.widths.of(SizedPanel::Explanation, whole.width());
        let width = explanation::fitted(width, free.width());
        let room = Room {
            free,
            panel: width,
            window: whole.width(),
        };
        let side = Side::choose(self.explanation_side, viewer, room, ui.pixels_per_point());
        // The place of a pin is not known before its scene is.
        self.explanation_side = Some(side).filter(|_| viewer.both().view_numbers().is_some());
        let panel = if side.is_left {
            Panel::left("explanation")
        } else {
            Panel::right("explanation on the right")
        };
        let memory = &mut self.explanation;
        memory.is_page = false;
        let panel = panel
            .resizable(false)
            .exact_size(width)
            .frame(panel_frame(ui, look::scrolling_margin(8)))
            .show(ui, |ui| {
                FocusPanel::Explanation.head(ui);
                look::bars_beside(ui);
                memory.show(ui, viewer, &mut asked.commands)
            });
        self.cover(ui, SizedPanel::Explanation, side.is_left, panel.response.rect);
        panel.inner
    }
}
