//! The interface: egui panels that show the viewer's state and answer with commands. It holds nothing that the
//! viewer should know: only what was typed, what is folded, and textures.
//!
//! The frame of the scene fills the whole window in device pixels, as in the course, so that a picture's size never
//! depends on panels. The panels lie over it. Lest they hide the canvas unasked, the side panel starts folded where
//! it would reach into the canvas of the default view, and the inspector's inset is told what area is free.

mod compare;
mod compare_marks;
mod controls;
mod detail;
mod dialogs;
mod document;
mod explanation;
mod fed;
mod floating;
mod hits;
mod lesson;
mod look;
mod pin;
mod sampling;
mod scenes;
mod scrubber;
mod sheet;
mod status;
mod twin;
mod view_numbers;

use egui::style::ScrollStyle;
use egui::{Context, Frame, Margin, Panel, Pos2, Rect, ScrollArea, Ui};

use crate::viewer::{Command, PixelRect, Theme, Viewer};
use dialogs::Dialogs;
use explanation::{ExplanationPanel, Hovered};
use floating::MessageClock;
use scenes::{Thumbnails, Wishes};

/// Width of the picture that two panels leave at least, in points.
const LEAST_PICTURE: f32 = 160.0;
/// Width of the picture below which panels give way to each other, in points.
const USEFUL_PICTURE: f32 = 560.0;
/// Height that the scenes need lest the whole panel scrolls instead of the list alone, in points.
const LEAST_LIST: f32 = 170.0;
/// The same for the reader's report.
const LEAST_REPORT: f32 = 96.0;
/// Longest report in a panel that scrolls as a whole, in points.
const LONG_REPORT: f32 = 240.0;

/// egui's context and what the panels remember.
#[derive(Debug)]
pub(super) struct Interface {
    ctx: Context,
    theme: Option<Theme>,
    /// Whether times of redraws are shown: pictures that must be alike leave them out.
    timed: bool,
    thumbnails: Thumbnails,
    dialogs: Dialogs,
    explanation: ExplanationPanel,
    clock: MessageClock,
    /// What the panels covered in the last pass, in points.
    covered: Vec<Rect>,
    heights: Heights,
}

/// How much the parts of the side panel needed in the last pass, in points.
#[derive(Clone, Copy, Debug)]
struct Heights {
    /// Everything above the scenes but the report.
    settings: f32,
    /// The whole report.
    report: f32,
    /// All scenes, with their heading.
    list: f32,
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
            dialogs: Dialogs::default(),
            explanation: ExplanationPanel::default(),
            clock: MessageClock::default(),
            covered: Vec::new(),
            heights: Heights {
                settings: 400.0,
                report: 0.0,
                list: LEAST_LIST,
            },
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
            .is_some_and(|layer| layer.order != egui::Order::Background);
        above || self.covered.iter().any(|rect| rect.contains(at))
    }

    /// Whether a line of text has the keyboard.
    pub(super) fn has_keyboard(&self) -> bool {
        self.ctx.text_edit_focused()
    }

    /// Whether a side panel beside the canvas of the default view leaves all of it free, in a window of `size` points.
    pub(super) fn panel_fits(size: [f32; 2]) -> bool {
        let canvas = size[0].min(size[1]) / 1.2;
        (size[0] - canvas) / 2.0 >= look::PANEL_WIDTH
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
        let whole = ui.max_rect();
        let hidden = viewer.everything_hidden();
        self.explanation.has_numbers = false;
        if !hidden {
            let line = Panel::bottom("status")
                .resizable(false)
                .frame(panel_frame(ui, Margin::symmetric(look::MARGIN, 4)))
                .show(ui, |ui| status::show(ui, viewer, &mut asked.commands));
            self.covered.push(line.response.rect);
            if viewer.lesson().is_some() && ui.available_width() >= lesson::WIDTH + LEAST_PICTURE {
                self.lesson_panel(ui, viewer, asked);
            }
            if viewer.panel() {
                self.side_panel(ui, viewer, asked);
                // Why a pixel has its colour tells the same of A and B, for that pixel: it goes first where there is not room
                // for both.
                let room = ui.available_rect_before_wrap();
                let beside = if explanation::side(viewer, room, ui.pixels_per_point()).is_some() {
                    explanation::WIDTH + USEFUL_PICTURE
                } else {
                    LEAST_PICTURE
                };
                let fits = ui.available_width() >= look::PANEL_WIDTH + beside;
                if viewer.other().is_some() && fits {
                    self.compare_panel(ui, viewer, asked);
                }
                self.explanation.has_numbers = viewer.other().is_some() && !fits;
            }
        }
        let hovered = self.explanation(ui, viewer, whole, asked);
        let free = ui.available_rect_before_wrap().intersect(whole);
        hovered.outline(ui, viewer, free);
        hovered.point_at_texel(viewer, &mut asked.commands);
        asked
            .commands
            .push(Command::SetFreeArea(Some(device_rect(free, ui.pixels_per_point()))));
        if !hidden {
            floating::progress(ui, viewer, free);
        }
        if !hidden {
            pin::show(ui, viewer, free);
        }
        floating::pixel_labels(ui, viewer);
        fed::show(ui, viewer, free);
        hits::hits(ui, viewer);
        let messages = self.clock.show(ui, viewer, free, &mut asked.commands);
        if !hidden {
            let mut taken = compare_marks::show(ui, viewer, free, &messages);
            taken.extend(&messages);
            if viewer.overlay_text() {
                floating::overlay_text(ui, viewer, free, &taken);
            }
        }
        self.covered.extend(messages);
        let ctx = self.ctx.clone();
        self.dialogs.show(&ctx, viewer, &mut asked.commands);
    }

    fn lesson_panel(&mut self, ui: &mut Ui, viewer: &Viewer, asked: &mut Asked) {
        let panel = Panel::left("lesson panel")
            .resizable(false)
            .exact_size(lesson::WIDTH)
            .frame(panel_frame(ui, Margin::symmetric(look::MARGIN, 8)))
            .show(ui, |ui| lesson::show(ui, viewer, &mut asked.commands));
        self.covered.push(panel.response.rect);
    }

    fn compare_panel(&mut self, ui: &mut Ui, viewer: &Viewer, asked: &mut Asked) {
        let panel = Panel::left("compare panel")
            .resizable(false)
            .exact_size(look::PANEL_WIDTH)
            .frame(panel_frame(ui, Margin::symmetric(look::MARGIN, 4)))
            .show(ui, |ui| {
                let area = ScrollArea::vertical().id_salt("compare").auto_shrink(false);
                area.show(ui, |ui| compare::show(ui, viewer, &mut asked.commands));
            });
        self.covered.push(panel.response.rect);
    }

    /// Why the pinned pixel has its colour, beside the picture.
    fn explanation(&mut self, ui: &mut Ui, viewer: &Viewer, whole: Rect, asked: &mut Asked) -> Hovered {
        let free = ui.available_rect_before_wrap().intersect(whole);
        let panel = match explanation::side(viewer, free, ui.pixels_per_point()) {
            None => return Hovered::default(),
            Some(true) => Panel::left("explanation"),
            Some(false) => Panel::right("explanation on the right"),
        };
        let memory = &mut self.explanation;
        let panel = panel
            .resizable(false)
            .exact_size(explanation::WIDTH)
            .frame(panel_frame(ui, Margin::symmetric(look::MARGIN, 8)))
            .show(ui, |ui| memory.show(ui, viewer, &mut asked.commands));
        self.covered.push(panel.response.rect);
        panel.inner
    }

    fn side_panel(&mut self, ui: &mut Ui, viewer: &Viewer, asked: &mut Asked) {
        let before = self.heights;
        let panel = Panel::right("side panel")
            .resizable(false)
            .exact_size(look::PANEL_WIDTH)
            .frame(panel_frame(ui, Margin::symmetric(look::MARGIN, 4)))
            .show(ui, |ui| {
                let room = ui.available_height() - before.settings - before.list.min(LEAST_LIST);
                if room >= before.report.min(LEAST_REPORT) {
                    self.settings(ui, viewer, room, asked);
                    self.scenes(ui, viewer, true, asked);
                } else {
                    ScrollArea::vertical()
                        .id_salt("panel")
                        .auto_shrink(false)
                        .show(ui, |ui| {
                            self.settings(ui, viewer, LONG_REPORT, asked);
                            // Scrolling to the scene would scroll the settings away.
                            self.scenes(ui, viewer, false, asked);
                        });
                }
            });
        if self.heights.differs_from(before) {
            ui.ctx().request_repaint();
        }
        self.covered.push(panel.response.rect);
    }

    /// What lies above the scenes; the report is at most `report_room` points high.
    fn settings(&mut self, ui: &mut Ui, viewer: &Viewer, report_room: f32, asked: &mut Asked) {
        let top = ui.cursor().top();
        sampling::show(ui, viewer, &mut asked.commands);
        if viewer.other().is_none() {
            compare::offer(ui, &mut asked.commands);
        }
        view_numbers::show(ui, viewer, &mut asked.commands);
        let report = ui.scope(|ui| {
            // A bar that is always to be seen tells that there is more.
            ui.spacing_mut().scroll = ScrollStyle {
                floating_width: 4.0,
                foreground_color: true,
                ..ScrollStyle::thin()
            };
            ScrollArea::vertical()
                .id_salt("report")
                .auto_shrink([false, true])
                .max_height(report_room)
                .show(ui, |ui| document::report(ui, viewer))
        });
        document::timing(ui, viewer, self.timed);
        self.heights.report = report.inner.content_size.y;
        self.heights.settings = ui.cursor().top() - top - report.inner.inner_rect.height();
    }

    /// The scenes with their heading. With `own_scroll` the list scrolls by itself and follows the current scene.
    fn scenes(&mut self, ui: &mut Ui, viewer: &Viewer, own_scroll: bool, asked: &mut Asked) {
        let top = ui.cursor().top();
        scenes::title(ui, viewer, &mut asked.commands);
        let title = ui.cursor().top() - top;
        let mut wishes = Wishes {
            follow: own_scroll,
            ..Wishes::default()
        };
        let mut list = |ui: &mut Ui| {
            let thumbnails = &mut self.thumbnails;
            let list = ui.scope(|ui| scenes::list(ui, viewer, thumbnails, &mut wishes, &mut asked.commands));
            list.response.rect.height()
        };
        let list = if own_scroll {
            let area = ScrollArea::vertical().id_salt("scenes").auto_shrink(false);
            area.show(ui, list).inner
        } else {
            list(ui)
        };
        self.heights.list = title + list;
        asked.thumbnails.extend(wishes.thumbnails);
    }
}

impl Heights {
    /// Whether the parts moved.
    fn differs_from(self, other: Self) -> bool {
        let moved = |a: f32, b: f32| (a - b).abs() > 0.5;
        moved(self.settings, other.settings) || moved(self.report, other.report) || moved(self.list, other.list)
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
