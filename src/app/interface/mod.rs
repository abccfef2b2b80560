//! The interface: egui panels that show the viewer's state and answer with commands. It holds nothing that the
//! viewer should know: only what was typed, what is folded, and textures.
//!
//! The frame of the scene fills the whole window in device pixels, as in the course, so that a picture's size never
//! depends on panels. The panels lie over it. Lest they hide the canvas unasked, the side panel starts folded where
//! it would reach into the canvas of the default view; the viewer is told what area is free, and brings a canvas that no
//! hand has moved there.

mod board;
mod board_tiles;
mod chooser;
mod compare;
mod compare_letters;
mod compare_marks;
mod compare_numbers;
mod contributions;
mod controls;
mod corner;
mod dialogs;
mod document;
mod explanation;
mod explanation_side;
mod floating;
mod focus;
mod gallery;
mod hits;
mod hovered;
mod lesson;
mod look;
mod menu;
mod messages;
mod modal;
mod open_dialog;
mod palette;
mod panels;
mod pattern;
mod pin;
mod places;
mod profile;
mod profile_line;
mod profile_plot;
mod report;
mod room;
mod samples;
mod sampling;
mod scenes;
mod scrubber;
mod sheet;
mod side_panel;
mod spectrum;
mod spectrum_plot;
mod spectrum_wave;
mod standing;
mod start;
mod status;
mod texture_view;
mod view_numbers;
mod waiting;
mod way_back;
mod widths;

use egui::{Area, Context, Event, Frame, Id, Margin, Order, Panel, Pos2, Rect, Sense, Ui};
use glam::DVec2;

use crate::viewer::{Chrome, Command, KeyPress, PixelRect, Theme, ViewNumbers, Viewer, WindowCommand};
use board::BoardCard;
use compare_marks::Marks;
use dialogs::Dialogs;
use explanation::ExplanationPanel;
use explanation_side::Side;
use floating::CloseOfInset;
use focus::FocusPanel;
use hovered::Hovered;
use messages::{Messages, Taken};
use profile::ProfileCard;
use scenes::Thumbnails;
use side_panel::PanelMemory;
use spectrum::SpectrumCard;
use spectrum_wave::WaveOverPicture;
use widths::SizedPanel;

pub(super) use report::Sections;
pub(super) use widths::PanelWidths;

/// Width of the picture that two panels leave at least, in points.
const LEAST_PICTURE: f32 = 160.0;
/// Width of the picture below which panels give way to each other, in points.
const USEFUL_PICTURE: f32 = 560.0;

/// egui's context and what the panels remember.
#[derive(Debug)]
pub(super) struct Interface {
    ctx: Context,
    /// At how many percent the desktop shows the window, where it scales that by itself.
    pub(super) shown_at: Option<u32>,
    look: Option<(Theme, bool)>,
    /// Whether times of redraws are shown: pictures that must be alike leave them out.
    timed: bool,
    thumbnails: Thumbnails,
    /// The view of the scene that was read last.
    view: ViewNumbers,
    dialogs: Dialogs,
    explanation: ExplanationPanel,
    messages: Messages,
    close_of_inset: CloseOfInset,
    profile: ProfileCard,
    board: BoardCard,
    spectrum: SpectrumCard,
    wave: WaveOverPicture,
    /// How wide panels are.
    pub(super) widths: PanelWidths,
    /// What the side panel remembers.
    panel: PanelMemory,
    /// Whether the panel of the comparison is on the right, while there is one.
    comparison_on_right: Option<bool>,
    /// On which side the explanation is, while there is one.
    explanation_side: Option<Side>,
    /// Whether a lesson was open in the last pass.
    in_lesson: bool,
    /// What the panels covered in the last pass, in points.
    covered: Vec<Rect>,
    /// Where cards were that measure the picture, in points.
    cards: Vec<Rect>,
    /// Where words stood over the picture in the last pass, in points.
    labels: Vec<Rect>,
    /// Where the parts of the line of a wipe were, in points.
    line: Vec<Rect>,
    /// Whether the next panel is to have the keyboard, or the one before.
    wanted_step: Option<bool>,
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
    /// What the next pass is to begin with.
    pub(super) scroll: Option<Event>,
    /// Whether the focus is on its way round, and wants another pass.
    pub(super) goes_round: bool,
}

impl Interface {
    /// `timed` is false for pictures that must not depend on time.
    pub(super) fn new(timed: bool) -> Self {
        let ctx = Context::default();
        look::install(&ctx, timed);
        Self {
            ctx,
            shown_at: None,
            look: None,
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
            profile: ProfileCard::default(),
            board: BoardCard::default(),
            spectrum: SpectrumCard::default(),
            wave: WaveOverPicture::default(),
            widths: PanelWidths::default(),
            panel: PanelMemory::default(),
            comparison_on_right: None,
            explanation_side: None,
            in_lesson: false,
            covered: Vec::new(),
            cards: Vec::new(),
            labels: Vec::new(),
            line: Vec::new(),
            wanted_step: None,
            handle: None,
            told: Vec::new(),
        }
    }

    /// What the user folded and unfolded in the explanation.
    pub(super) fn sections(&self) -> Sections {
        report::sections(&self.ctx)
    }

    /// Sections begin as they were left.
    pub(super) fn set_sections(&mut self, sections: Sections) {
        report::set_sections(&self.ctx, sections);
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

    /// Whether a card lies at `at`, in points: nothing of these comes or goes with the pointer.
    pub(super) fn card_covers(&self, at: Pos2) -> bool {
        self.cards.iter().any(|card| card.contains(at))
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

    /// Takes the viewer's theme; to be called before a pass, which keeps the one that it begins with.
    pub(super) fn follow_theme(&mut self, chrome: &Chrome) {
        let look = (chrome.theme(), chrome.presenter());
        if self.look != Some(look) {
            self.look = Some(look);
            look::set_look(&self.ctx, look);
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
                .show(ui, |ui| {
                    FocusPanel::Status.head(ui);
                    status::show(ui, viewer, self.shown_at, &mut asked.commands)
                });
            self.covered.push(line.response.rect);
            if let Some(spec) = line.inner {
                self.dialogs.ask_for(spec, &mut asked.commands);
            }
            if self.has_room_for_lesson(viewer, whole.width()) {
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
        let cards = self.float(ui, viewer, free, asked);
        let taken = Taken {
            free,
            things: &cards,
            words: &words,
        };
        self.words(ui, viewer, taken, asked);
        self.hold_clicks();
        let ctx = self.ctx.clone();
        let thumbnails = self.dialogs.show(&ctx, viewer, &mut asked.commands);
        asked.thumbnails.extend(thumbnails);
        self.take_step();
        asked.scroll = focus::scroll_to(&ctx);
        asked.goes_round = focus::goes_round(&ctx);
        focus::outline(&ctx);
    }

    /// The next panel has the keyboard, or the one before; behind the last the picture. What a dialog asked for waits until that
    /// has gone, which keeps the focus to itself.
    pub(super) fn step_focus(&mut self, viewer: &Viewer, back: bool) {
        if viewer.chrome().dialog().is_none() && !self.list_is_open() {
            self.wanted_step = Some(back);
            self.take_step();
        }
    }

    fn take_step(&mut self) {
        let is_free = self.ctx.memory(|memory| memory.top_modal_layer().is_none());
        if let Some(back) = self.wanted_step.take_if(|_| is_free) {
            focus::step(&self.ctx, back);
            self.ctx.request_repaint();
        }
    }

    /// Keys go into the list that is open.
    pub(super) fn enter_list(&self) {
        focus::enter_list(&self.ctx);
    }

    /// The picture has the keyboard.
    pub(super) fn leave_panels(&self) {
        focus::leave(&self.ctx);
    }

    /// Whether the control that has the focus wants this key.
    pub(super) fn takes_key(&self, press: &KeyPress) -> bool {
        focus::takes(&self.ctx, press)
    }

    /// What floats over the picture, but for words. Returns where cards are.
    fn float(&mut self, ui: &Ui, viewer: &Viewer, free: Rect, asked: &mut Asked) -> Vec<Rect> {
        let mut cards = Vec::new();
        self.cards.clear();
        let hidden = viewer.chrome().everything_hidden();
        if !hidden {
            floating::progress(ui, viewer, free);
            pin::show(ui, viewer, free);
        }
        floating::pixel_labels(ui, viewer);
        if !hidden {
            floating::unread(ui, viewer, free);
            waiting::show(ui, viewer, free, &mut asked.commands);
            start::card(ui, viewer, free, &mut asked.commands);
            let profile = self.profile.show(ui, viewer, free, &mut asked.commands);
            self.cards.extend(profile.card);
            cards.extend(profile.taken);
            profile_line::show(ui, viewer, free, profile.pixel);
            let board = self.board.show(ui, viewer, (free, self.timed), &mut asked.commands);
            self.cards.extend(board);
            cards.extend(board);
            let spectrum = self.spectrum.show(ui, viewer, free, &mut asked.commands);
            self.cards.extend(spectrum.taken);
            cards.extend(spectrum.taken);
            let beside: Vec<Rect> = profile.card.into_iter().chain(spectrum.taken).collect();
            cards.extend(way_back::show(ui, viewer, (free, &beside), &mut asked.commands));
            self.wave
                .show(ui, viewer, free, spectrum.reading.map(|reading| reading.wave));
        }
        contributions::show(ui, viewer, free);
        hits::hits(ui, viewer);
        self.close_of_inset.show(ui, viewer, free, &mut asked.commands);
        cards
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
        let cards: Vec<Rect> = before.things.iter().copied().chain(about).collect();
        let things = floating::things(viewer, ui.pixels_per_point());
        let things = things.into_iter().chain(cards.iter().copied());
        let things: Vec<Rect> = things.chain(dialogs::place(ui.ctx(), viewer)).collect();
        let taken = Taken {
            things: &things,
            ..before
        };
        let messages = self.messages.show(ui, viewer, taken, &mut asked.commands);
        if !hidden {
            let told: Vec<Rect> = messages.iter().chain(&cards).copied().collect();
            let Marks { labels, line, handle } = compare_marks::show(ui, viewer, free, &told);
            let taken: Vec<Rect> = labels
                .iter()
                .chain(&messages)
                .chain(&line)
                .chain(&cards)
                .copied()
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
