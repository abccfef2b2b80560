//! The interface: egui panels that show the viewer's state and answer with commands. It holds nothing that the
//! viewer should know: only what was typed, what is folded, and textures.
//!
//! The frame of the scene fills the whole window in device pixels, as in the course, so that a picture's size never
//! depends on panels. The panels lie over it. Lest they hide the canvas unasked, the side panel starts folded where
//! it would reach into the canvas of the default view, and the inspector's inset is told what area is free.

mod controls;
mod dialogs;
mod document;
mod floating;
mod hits;
mod look;
mod sampling;
mod scenes;
mod status;
mod view_numbers;

use egui::{Context, Frame, Margin, Panel, Pos2, Rect, ScrollArea, Ui};

use crate::viewer::{Command, PixelRect, Theme, Viewer};
use dialogs::Dialogs;
use floating::MessageClock;
use scenes::{Thumbnails, Wishes};

/// Height left for the scenes below which the whole panel scrolls instead of the list alone, in points.
const LEAST_LIST: f32 = 170.0;

/// egui's context and what the panels remember.
#[derive(Debug)]
pub(super) struct Interface {
    ctx: Context,
    theme: Option<Theme>,
    /// Whether times of redraws are shown: pictures that must be alike leave them out.
    timed: bool,
    thumbnails: Thumbnails,
    dialogs: Dialogs,
    clock: MessageClock,
    /// What the panels covered in the last pass, in points.
    covered: Vec<Rect>,
    /// Height of the settings in the last pass, in points.
    settings_height: f32,
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
            clock: MessageClock::default(),
            covered: Vec::new(),
            settings_height: 400.0,
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
        if !hidden {
            let line = Panel::bottom("status")
                .resizable(false)
                .frame(panel_frame(ui, Margin::symmetric(look::MARGIN, 4)))
                .show(ui, |ui| status::show(ui, viewer, &mut asked.commands));
            self.covered.push(line.response.rect);
            if viewer.panel() {
                self.side_panel(ui, viewer, asked);
            }
        }
        let free = ui.available_rect_before_wrap().intersect(whole);
        asked
            .commands
            .push(Command::SetFreeArea(Some(device_rect(free, ui.pixels_per_point()))));
        floating::pixel_labels(ui, viewer);
        hits::hits(ui, viewer);
        let messages = self.clock.show(ui, viewer, free, &mut asked.commands);
        if viewer.overlay_text() && !hidden {
            floating::overlay_text(ui, viewer, free, &messages);
        }
        self.covered.extend(messages);
        let ctx = self.ctx.clone();
        self.dialogs.show(&ctx, viewer, &mut asked.commands);
    }

    fn side_panel(&mut self, ui: &mut Ui, viewer: &Viewer, asked: &mut Asked) {
        let panel = Panel::right("side panel")
            .resizable(false)
            .exact_size(look::PANEL_WIDTH)
            .frame(panel_frame(ui, Margin::symmetric(look::MARGIN, 4)))
            .show(ui, |ui| {
                let room = ui.available_height() - self.settings_height;
                if room >= LEAST_LIST {
                    self.settings(ui, viewer, asked);
                    scenes::title(ui, viewer, &mut asked.commands);
                    ScrollArea::vertical()
                        .id_salt("scenes")
                        .auto_shrink(false)
                        .show(ui, |ui| {
                            self.scenes(ui, viewer, true, asked);
                        });
                } else {
                    ScrollArea::vertical()
                        .id_salt("panel")
                        .auto_shrink(false)
                        .show(ui, |ui| {
                            self.settings(ui, viewer, asked);
                            scenes::title(ui, viewer, &mut asked.commands);
                            // Scrolling to the scene would scroll the settings away.
                            self.scenes(ui, viewer, false, asked);
                        });
                }
            });
        self.covered.push(panel.response.rect);
    }

    fn settings(&mut self, ui: &mut Ui, viewer: &Viewer, asked: &mut Asked) {
        let top = ui.cursor().top();
        sampling::show(ui, viewer, &mut asked.commands);
        view_numbers::show(ui, viewer, &mut asked.commands);
        ScrollArea::vertical()
            .id_salt("report")
            .max_height(96.0)
            .show(ui, |ui| document::report(ui, viewer));
        document::timing(ui, viewer, self.timed);
        self.settings_height = ui.cursor().top() - top;
    }

    fn scenes(&mut self, ui: &mut Ui, viewer: &Viewer, follow: bool, asked: &mut Asked) {
        let mut wishes = Wishes {
            follow,
            ..Wishes::default()
        };
        scenes::list(ui, viewer, &mut self.thumbnails, &mut wishes, &mut asked.commands);
        asked.thumbnails.extend(wishes.thumbnails);
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
