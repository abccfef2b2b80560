//! The interface: egui panels that show the viewer's state and answer with commands. It holds nothing that the
//! viewer should know: only what was typed, what is folded, and textures.
//!
//! The frame of the scene fills the whole window in device pixels, as in the course, so that a picture's size never
//! depends on panels. The panels lie over it. Lest they hide the canvas unasked, the side panel starts folded where
//! it would reach into the canvas of the default view; the viewer is told what area is free, and brings a canvas that no
//! hand has moved there.

mod chooser;
mod compare;
mod compare_marks;
mod compare_numbers;
mod contributions;
mod controls;
mod dialogs;
mod document;
mod explanation;
mod explanation_side;
mod floating;
mod hits;
mod lesson;
mod look;
mod menu;
mod messages;
mod modal;
mod open_dialog;
mod palette;
mod pin;
mod places;
mod sampling;
mod scenes;
mod scrubber;
mod sheet;
mod side_panel;
mod standing;
mod start;
mod status;
mod texture_view;
mod view_numbers;
mod widths;

use crate::viewer::WindowCommand;
use egui::{Area, Context, Frame, Id, Margin, Order, Panel, Pos2, Rect, ScrollArea, Sense, Ui};
use glam::DVec2;

use crate::viewer::{Arrangement, Command, PixelRect, Theme, ViewNumbers, Viewer};
use compare_marks::Marks;
use dialogs::Dialogs;
use explanation::{ExplanationPanel, Hovered};
use explanation_side::{Room, Side};
use floating::CloseOfInset;
use messages::{Messages, Taken};
use scenes::Thumbnails;
use side_panel::PanelMemory;
pub(super) use widths::PanelWidths;
use widths::SizedPanel;

/// Width of the picture that two panels leave at least, in points.
const LEAST_PICTURE: f32 = 160.0;
/// Width of the picture below which panels give way to each other, in points.
const USEFUL_PICTURE: f32 = 560.0;

/// egui's context and what the panels remember.
#[derive(Debug)]
pub(super) struct Interface {
    ctx: Context,
    theme: Option<Theme>,
    /// Whether times of redraws are shown: pictures that must be alike leave them out.
    timed: bool,
    thumbnails: Thumbnails,
    /// The view of the scene that was read last.
    view: ViewNumbers,
    dialogs: Dialogs,
    explanation: ExplanationPanel,
    messages: Messages,
    close_of_inset: CloseOfInset,
    /// How wide panels are.
    pub(super) widths: PanelWidths,
    /// What the side panel remembers.
    panel: PanelMemory,
    /// Whether the panel of the comparison is on the right, while there is one.
    comparison_on_right: Option<bool>,
    /// On which side the explanation is, while there is one.
    explanation_side: Option<Side>,
    /// What the panels covered in the last pass, in points.
    covered: Vec<Rect>,
    /// Where words stood over the picture in the last pass, in points.
    labels: Vec<Rect>,
    /// Where the parts of the line of a wipe were, in points.
    line: Vec<Rect>,
    /// Where its handle was.
    handle: Option<Rect>,
    /// Where messages were, in points.
    told: Vec<Rect>,
}

/// What a pass asks for.
#[derive(Debug, Default)]
pub(super) struct Asked {
    /// What the user did in the panels, and what the layout tells the viewer.
    pub(super) commands: Vec<Command>,
    /// Scenes whose thumbnails are in sight and missing.
    pub(super) thumbnails: Vec<usize>,
}

impl Interface {
    /// `timed` is false for pictures that must not depend on time.
    pub(super) fn new(timed: bool) -> Self {
        let ctx = Context::default();
        look::install(&ctx, timed);
        Self {
            ctx,
            theme: None,
            timed,
            thumbnails: Thumbnails::default(),
            view: ViewNumbers {
                center: DVec2::ZERO,
                scale: 1.0,
                rotation: 0.0,
            },
            dialogs: Dialogs::default(),
            explanation: ExplanationPanel::default(),
            messages: Messages::default(),
            close_of_inset: CloseOfInset::default(),
            widths: PanelWidths::default(),
            panel: PanelMemory::default(),
            comparison_on_right: None,
            explanation_side: None,
            covered: Vec::new(),
            labels: Vec::new(),
            line: Vec::new(),
            handle: None,
            told: Vec::new(),
        }
    }

    /// egui's context.
    pub(super) fn ctx(&self) -> &Context {
        &self.ctx
    }

    /// Whether a panel or a dialog lies at `at`, in points.
    pub(super) fn covers(&self, at: Pos2) -> bool {
        let above = self
            .ctx
            .layer_id_at(at)
            .is_some_and(|layer| layer.order != Order::Background);
        above || self.covered.iter().any(|rect| rect.contains(at))
    }

    /// Where words stand over the picture, in points.
    #[cfg(test)]
    pub(super) fn labels(&self) -> &[Rect] {
        &self.labels
    }

    /// Where the parts of the line of a wipe are, in points.
    #[cfg(test)]
    pub(super) fn line(&self) -> &[Rect] {
        &self.line
    }

    /// Where the handle of that line is, in points.
    #[cfg(test)]
    pub(super) fn handle(&self) -> Option<Rect> {
        self.handle
    }

    /// Where messages are, in points.
    #[cfg(test)]
    pub(super) fn told(&self) -> &[Rect] {
        &self.told
    }

    /// Where the rings of the pinned pixel are, in points.
    #[cfg(test)]
    pub(super) fn rings(&self, viewer: &Viewer) -> Vec<Rect> {
        pin::rings(viewer, self.ctx.pixels_per_point()).collect()
    }

    /// Whether a line of text has the keyboard.
    pub(super) fn has_keyboard(&self) -> bool {
        self.ctx.text_edit_focused()
    }

    /// Whether a list of values hangs open, which Esc closes.
    pub(super) fn list_is_open(&self) -> bool {
        egui::Popup::is_any_open(&self.ctx)
    }

    /// Whether a side panel beside the canvas of the default view leaves all of it free, in a window of `size` points.
    pub(super) fn panel_fits(size: [f32; 2]) -> bool {
        let canvas = size[0].min(size[1]) / 1.2;
        (size[0] - canvas) / 2.0 >= SizedPanel::Side.first()
    }

    /// Whether the explanation of a pixel has room in a window of that many points in width only without the side panel.
    pub(super) fn explanation_needs_panel(&self, viewer: &Viewer, window: f32) -> bool {
        let width = self.beside_lesson(viewer, window);
        explanation::fits(width) && !explanation::fits(width - self.widths.of(SizedPanel::Side, window))
    }

    /// What a lesson leaves of a window of that many points in width.
    fn beside_lesson(&self, viewer: &Viewer, window: f32) -> f32 {
        let lesson = self.widths.of(SizedPanel::Lesson, window);
        let has_panel = viewer.lesson().is_some() && window >= lesson + LEAST_PICTURE;
        if has_panel { window - lesson } else { window }
    }

    /// Whether a lesson leaves no room for the explanation of a pixel in a window of that many points in width: then both
    /// are pages of one panel.
    pub(super) fn lesson_shares_panel(&self, viewer: &Viewer, window: f32) -> bool {
        let beside = self.beside_lesson(viewer, window);
        beside < window && !explanation::fits(beside)
    }

    /// Whether a lesson and the side panel leave too little of the picture in a window of that many points in width.
    pub(super) fn lesson_crowds_panel(&self, viewer: &Viewer, window: f32) -> bool {
        let beside = self.beside_lesson(viewer, window);
        beside < window && beside - self.widths.of(SizedPanel::Side, window) < USEFUL_PICTURE / 2.0
    }

    /// Whether the explanation of a pixel has room in a window of that many points in width.
    pub(super) fn has_room_to_explain(&self, viewer: &Viewer, window: f32) -> bool {
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

    /// Whether the side panel of a window of that many points in width leaves the pinned pixel in sight.
    pub(super) fn panel_leaves_pin(&self, viewer: &Viewer, window: f32, pixels_per_point: f32) -> bool {
        let left = window - self.widths.of(SizedPanel::Side, window) - pin::ROOM;
        let places = viewer.pixels().pinned_places();
        places
            .iter()
            .all(|place| places::points(place, pixels_per_point).right() < left)
    }

    /// Takes the viewer's theme; to be called before a pass, which keeps the one that it begins with.
    pub(super) fn follow_theme(&mut self, theme: Theme) {
        if self.theme != Some(theme) {
            self.theme = Some(theme);
            look::set_theme(&self.ctx, theme);
        }
    }

    /// Lays out all panels.
    pub(super) fn show(&mut self, ui: &mut Ui, viewer: &Viewer, asked: &mut Asked) {
        self.covered.clear();
        let words: Vec<Rect> = self.labels.drain(..).chain(self.handle.take()).collect();
        self.line.clear();
        let whole = ui.max_rect();
        let hidden = viewer.chrome().everything_hidden();
        let mut has_comparison = false;
        let mut page = None;
        if !hidden {
            let line = Panel::bottom("status")
                .resizable(false)
                .frame(panel_frame(ui, Margin::symmetric(look::MARGIN, 4)))
                .show(ui, |ui| status::show(ui, viewer, &mut asked.commands));
            self.covered.push(line.response.rect);
            if let Some(spec) = line.inner {
                self.dialogs.ask_for(spec, &mut asked.commands);
            }
            if self.beside_lesson(viewer, whole.width()) < whole.width() {
                page = self.lesson_panel(ui, viewer, whole.width(), asked);
            }
            if viewer.chrome().panel() {
                self.side_panel(ui, viewer, whole.width(), asked);
                // Why a pixel has its colour tells the same of A and B, for that pixel: it goes first where there is not room
                // for both.
                let room = ui.available_rect_before_wrap();
                let beside = if explanation::is_shown(viewer, room.width()) {
                    explanation::WIDTH + USEFUL_PICTURE
                } else {
                    LEAST_PICTURE
                };
                let fits = ui.available_width() >= self.widths.of(SizedPanel::Comparison, whole.width()) + beside;
                has_comparison = viewer.ab().other().is_some() && fits;
                if has_comparison {
                    self.compare_panel(ui, viewer, whole.width(), asked);
                }
            }
        }
        if !has_comparison {
            self.comparison_on_right = None;
        }
        self.explanation.has_comparison = viewer.ab().other().is_some() && !has_comparison;
        let hovered = match page {
            Some(hovered) => hovered,
            None => self.explanation(ui, viewer, whole, asked),
        };
        let free = ui.available_rect_before_wrap().intersect(whole);
        hovered.outline(ui, viewer, free);
        hovered.point_at_texel(viewer, &mut asked.commands);
        asked
            .commands
            .push(Command::Window(WindowCommand::SetFreeArea(Some(device_rect(
                free,
                ui.pixels_per_point(),
            )))));
        self.float(ui, viewer, free, asked);
        let taken = Taken {
            free,
            things: &[],
            words: &words,
        };
        self.words(ui, viewer, taken, asked);
        self.hold_clicks();
        let ctx = self.ctx.clone();
        self.dialogs.show(&ctx, viewer, &mut asked.commands);
    }

    /// What floats over the picture, but for words.
    fn float(&mut self, ui: &Ui, viewer: &Viewer, free: Rect, asked: &mut Asked) {
        let hidden = viewer.chrome().everything_hidden();
        if !hidden {
            floating::progress(ui, viewer, free);
            pin::show(ui, viewer, free);
        }
        floating::pixel_labels(ui, viewer);
        if !hidden {
            floating::outdated(ui, viewer, free);
            floating::way_back(ui, viewer, free, &mut asked.commands);
            start::card(ui, viewer, free, &mut asked.commands);
        }
        contributions::show(ui, viewer, free);
        hits::hits(ui, viewer);
        self.close_of_inset.show(ui, viewer, free, &mut asked.commands);
    }

    /// A click beside an open list closes it, and presses nothing that lies below.
    fn hold_clicks(&self) {
        if !self.list_is_open() {
            return;
        }
        let whole = self.ctx.content_rect();
        Area::new(Id::unique("beside an open list"))
            .order(Order::Middle)
            .fixed_pos(whole.min)
            .fade_in(false)
            .show(&self.ctx, |ui| ui.allocate_response(whole.size(), Sense::click()));
    }

    /// Messages, tags and the text over the picture, each where nothing else lies; `before` has the words of the last pass.
    fn words(&mut self, ui: &Ui, viewer: &Viewer, before: Taken<'_>, asked: &mut Asked) {
        let free = before.free;
        let hidden = viewer.chrome().everything_hidden();
        let about = if hidden {
            None
        } else {
            floating::words(ui, viewer, free, &mut asked.commands)
        };
        let things = floating::things(viewer, ui.pixels_per_point());
        let things: Vec<Rect> = things.into_iter().chain(about).collect();
        let taken = Taken {
            things: &things,
            ..before
        };
        let messages = self.messages.show(ui, viewer, taken, &mut asked.commands);
        if !hidden {
            let told: Vec<Rect> = messages.iter().copied().chain(about).collect();
            let Marks { labels, line, handle } = compare_marks::show(ui, viewer, free, &told);
            let taken: Vec<Rect> = labels
                .iter()
                .chain(&messages)
                .chain(&line)
                .copied()
                .chain(about)
                .collect();
            (self.labels, self.line, self.handle) = (labels, line, handle);
            // The card would cover it in a small window.
            if viewer.chrome().overlay_text() && !viewer.chrome().start_card() {
                self.labels.extend(floating::overlay_text(ui, viewer, free, &taken));
            }
        }
        self.covered.extend(&messages);
        self.told = messages;
    }

    /// The lesson beside the picture. Where it leaves no room for the explanation of a pixel, that is a page of its panel,
    /// and what the pointer is over there is returned.
    fn lesson_panel(&mut self, ui: &mut Ui, viewer: &Viewer, window: f32, asked: &mut Asked) -> Option<Hovered> {
        let shares = self.lesson_shares_panel(viewer, window);
        let commands = &mut asked.commands;
        let memory = &mut self.explanation;
        let panel = Panel::left("lesson panel")
            .resizable(false)
            .exact_size(self.widths.of(SizedPanel::Lesson, window))
            .frame(panel_frame(ui, look::scrolling_margin(8)))
            .show(ui, |ui| {
                look::bars_beside(ui);
                look::beside_bar(ui, |ui| lesson::head(ui, viewer, commands));
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
    fn compare_panel(&mut self, ui: &mut Ui, viewer: &Viewer, window: f32, asked: &mut Asked) {
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
                look::bars_beside(ui);
                let area = ScrollArea::vertical().id_salt("compare").auto_shrink(false);
                area.show(ui, |ui| compare::show(ui, viewer, &mut asked.commands));
            });
        self.cover(ui, SizedPanel::Comparison, !on_right, panel.response.rect);
    }

    /// Notes that a panel covers the picture, and lets its edge be dragged.
    fn cover(&mut self, ui: &Ui, panel: SizedPanel, is_left: bool, rect: Rect) {
        let grip = self.widths.edge(ui, panel, is_left, rect);
        self.covered.extend([rect, grip]);
    }

    /// Why the pinned pixel has its colour, beside the picture.
    fn explanation(&mut self, ui: &mut Ui, viewer: &Viewer, whole: Rect, asked: &mut Asked) -> Hovered {
        let free = ui.available_rect_before_wrap().intersect(whole);
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
                look::bars_beside(ui);
                memory.show(ui, viewer, &mut asked.commands)
            });
        self.cover(ui, SizedPanel::Explanation, side.is_left, panel.response.rect);
        panel.inner
    }
}

fn panel_frame(ui: &Ui, margin: Margin) -> Frame {
    Frame::new().fill(ui.visuals().panel_fill).inner_margin(margin)
}

/// A rectangle in points as the device pixels that lie wholly inside.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to the longest side of a frame"
)]
fn device_rect(points: Rect, scale: f32) -> PixelRect {
    let edge = |at: f32| (at * scale).clamp(0.0, 65536.0);
    let (left, top) = (edge(points.left()).ceil(), edge(points.top()).ceil());
    PixelRect {
        x: left as i64,
        y: top as i64,
        width: (edge(points.right()).floor() - left).max(0.0) as u32,
        height: (edge(points.bottom()).floor() - top).max(0.0) as u32,
    }
}
