//! What floats over the picture without taking part in the layout: overlay text, pixel numbers in the inspector's
//! inset, progress.

use egui::{
    Align2, Area, Button, Color32, FontId, Frame, Id, Label, Order, Pos2, Rect, RichText, ScrollArea, TextStyle, Ui,
    Vec2,
};
use egui::{pos2, vec2};

use super::controls::tip;
use super::document::{AS_BEFORE, failed_line};
use super::focus::FocusPanel;
use super::look::{self, CONTROL};
use super::pin;
use super::places::{insets, points};
use crate::raster::SamplePattern;
use crate::viewer::picture::{self, About, Told, changed_words, reads_textures};
use crate::viewer::{Arrangement, Command, InspectorCommand, Other, Toggle, Viewer, WindowCommand};

/// How far a pointer moves that rests no more, in points.
const REST: f32 = 5.0;

/// Height of the progress bar, in points.
const BAR_HEIGHT: f32 = 3.0;
/// Widths of a scene's own words at most, in points; a narrower one is taken where a wider one has no room.
const WORDS_WIDTHS: [f32; 3] = [320.0, 230.0, 150.0];
/// What the frame, the name and the button of these words add to their size, in points.
const WORDS_FRAME: Vec2 = vec2(16.0, 84.0);
/// Width of what is said of a file that cannot be read at most, in points.
const OUTDATED_WIDTH: f32 = 520.0;
/// Free space around the text over the picture, in points.
const TEXT_MARGIN: f32 = 10.0;

/// The text over the picture: scene and settings. It gives way to the inspector's inset and to what is `taken`
/// besides, and is left out where there is no room. Returns where it stands.
pub(super) fn overlay_text(ui: &Ui, viewer: &Viewer, free: Rect, taken: &[Rect]) -> Option<Rect> {
    let entry = viewer.scene_list().current()?;
    // Never across the line between two pictures.
    let free = match viewer.ab().arrangement() {
        Arrangement::SideBySide => free.with_max_x(free.center().x),
        _ => free,
    };
    let mut lines = vec![entry.label.clone()];
    lines.extend(overlay_words(viewer));
    if entry.is_reading() {
        lines.push("reading …".to_owned());
    } else if let Some(text) = viewer.frames().waiting_text() {
        lines.push(text.to_owned());
    }
    let text = lines.join("\n");
    let galley = ui.painter().layout(
        text,
        FontId::proportional(12.0),
        Color32::WHITE,
        (free.width() - 40.0).max(60.0),
    );
    // The button beside a magnifier comes and goes with the pointer, and this text is not to.
    let insets = insets(viewer, ui.pixels_per_point());
    let buttons: Vec<Rect> = insets
        .first()
        .map(|inset| place_of_close(*inset, insets.get(1).copied(), free))
        .into_iter()
        .collect();
    let taken = [taken, &things(viewer, ui.pixels_per_point()), &buttons].concat();
    let back = free_corner(free, galley.size() + vec2(16.0, 10.0), &taken)?;
    ui.painter().rect_filled(back, 5.0, Color32::from_black_alpha(170));
    ui.painter().galley(back.min + vec2(8.0, 5.0), galley, Color32::WHITE);
    Some(back)
}

/// The settings; none while A and B share the window, where tags tell them, nor while a B fills it that has others.
fn overlay_words(viewer: &Viewer) -> Vec<String> {
    if viewer.ab().arrangement() != Arrangement::Alone || shows_other_than_set(viewer) {
        return Vec::new();
    }
    let render = &viewer.settings().render;
    let count = render.sample_rate.samples();
    let pattern = match render.pattern {
        SamplePattern::Grid => String::new(),
        other => format!(", {}", other.name()),
    };
    let mut lines = vec![if render.covers_areas() {
        "exact areas, one colour per pixel".to_owned()
    } else {
        let samples = if count == 1 { "sample" } else { "samples" };
        format!("{count} {samples} per pixel{pattern}")
    }];
    let scene = viewer.scene_list().scene();
    if reads_textures(scene) {
        lines.push(format!(
            "pixel {}, level {}",
            render.pixel_sampling.name(),
            render.level_sampling.name()
        ));
    }
    let words = changed_words(viewer.settings(), About::Textures, scene);
    if !words.is_empty() {
        lines.push(words.join(", "));
    }
    let others = picture::all().filter(|setting| setting.told == Told::IfChanged && setting.about == About::Samples);
    for setting in others {
        // The pattern stands beside the number of samples, and in place of both stands that areas are exact.
        let is_told = setting.option == "pattern" || (setting.option == "coverage" && render.covers_areas());
        let counts = setting.idle(viewer.settings(), scene).is_none();
        if !is_told && counts && !setting.is_default(viewer.settings()) {
            lines.push(format!("{}: {}", setting.label, setting.shown(viewer.settings())));
        }
    }
    lines
}

/// Whether the window is filled by a B that is no picture of the current settings: the truth, or a picture from outside.
pub(super) fn shows_other_than_set(viewer: &Viewer) -> bool {
    let ab = viewer.ab();
    ab.shows_b() && matches!(ab.other(), Some(Other::Truth(_) | Other::Picture(_)))
}

/// A thin bar along the picture's upper edge: how far a refinement is that takes long. Nothing but the clock tells when a scene takes
/// long.
pub(super) fn progress(ui: &Ui, viewer: &Viewer, free: Rect) {
    let waits = [viewer.frames().wait_is_told_in(), viewer.ab().wait_is_told_in()];
    for wait in waits.into_iter().flatten().filter(|wait| !wait.is_zero()) {
        ui.ctx().request_repaint_after(wait);
    }
    let Some(done) = viewer.frames().long_refinement() else {
        return;
    };
    #[expect(clippy::cast_possible_truncation, reason = "between 0 and 1")]
    let done = done as f32;
    let track = Rect::from_min_size(free.min, vec2(free.width(), BAR_HEIGHT));
    let bar = Rect::from_min_size(free.min, vec2(free.width() * done, BAR_HEIGHT));
    ui.painter().rect_filled(track, 0.0, Color32::from_black_alpha(60));
    ui.painter().rect_filled(bar, 0.0, ui.visuals().selection.bg_fill);
}

/// What the scene says about itself, until it is closed. Returns where it stands.
pub(super) fn words(ui: &Ui, viewer: &Viewer, free: Rect, commands: &mut Vec<Command>) -> Option<Rect> {
    let text = viewer.scene_list().words().filter(|_| viewer.chrome().about())?;
    let (corner, size) = place_of_words(ui, viewer, free, text);
    let id = Id::unique("words");
    let area = Area::new(id)
        .order(Order::Middle)
        .fixed_pos(corner.pos_in_rect(&free.shrink(TEXT_MARGIN)))
        .pivot(corner)
        .constrain_to(free)
        .fade_in(false)
        .show(ui.ctx(), |ui| {
            FocusPanel::Words.head_of_area(ui, id);
            Frame::popup(ui.style()).show(ui, |ui| {
                ui.set_width(size.x);
                ui.horizontal(|ui| {
                    let name = viewer.scene_list().current().map_or("", |entry| entry.label.as_str());
                    ui.add(Label::new(RichText::new(name).small().weak()).truncate());
                });
                look::bars_beside(ui);
                // Another scene's words begin at their beginning.
                let area = ScrollArea::vertical().id_salt(("words", viewer.scene_list().current_index()));
                let area = area.max_height(size.y).min_scrolled_height(size.y);
                area.show(ui, |ui| {
                    for paragraph in text.lines() {
                        // A key and the colon behind it stay on one line.
                        ui.label(paragraph.replace(" : ", "\u{a0}: "));
                    }
                });
                ui.add_space(2.0);
                let close = ui
                    .add(Button::new("Close").min_size(CONTROL))
                    .on_hover_text(tip("about"));
                if close.accessible_name("Close the scene's words").clicked() {
                    commands.push(Command::Window(WindowCommand::About(Toggle::Off)));
                }
            });
        });
    Some(area.response.rect)
}

/// The corner of `free` in which a scene's words cover no pinned pixel and no magnifier of it, and how large they may be there:
/// as large as they are or, where no corner has room for that, as it has. What follows the pointer gives way by itself.
fn place_of_words(ui: &Ui, viewer: &Viewer, free: Rect, text: &str) -> (Align2, Vec2) {
    /// Less of a text is not worth its frame, in points.
    const LEAST: f32 = 34.0;
    let font = TextStyle::Body.resolve(ui.style());
    let size = |width: f32| {
        let lines = text.lines().map(|line| {
            let galley = ui
                .painter()
                .layout(line.to_owned(), font.clone(), Color32::WHITE, width);
            galley.size().y + ui.spacing().item_spacing.y
        });
        vec2(width, lines.sum::<f32>().min((free.height() * 0.5).max(60.0)))
    };
    let widths = WORDS_WIDTHS.map(|width| width.min(free.width() - 4.0 * TEXT_MARGIN));
    let first = (Align2::LEFT_BOTTOM, size(widths[0]));
    if viewer.pixels().pinned().is_none() {
        return first;
    }
    let (taken, room) = (things(viewer, ui.pixels_per_point()), free.shrink(TEXT_MARGIN));
    // What is free of the room's height in a corner.
    let height = |corner: Align2, width: f32| {
        let column = corner.align_size_within_rect(vec2(width + WORDS_FRAME.x, room.height()), room);
        let beside = taken
            .iter()
            .filter(|other| other.x_range().intersects(column.x_range()));
        if corner.y() == egui::Align::TOP {
            beside.fold(room.bottom(), |end, other| end.min(other.top())) - room.top()
        } else {
            room.bottom() - beside.fold(room.top(), |end, other| end.max(other.bottom()))
        }
    };
    let corners = [
        Align2::LEFT_BOTTOM,
        Align2::LEFT_TOP,
        Align2::RIGHT_BOTTOM,
        Align2::RIGHT_TOP,
    ];
    let mut best: Option<(Align2, Vec2)> = None;
    for size in widths.map(size) {
        for corner in corners {
            let height = height(corner, size.x) - WORDS_FRAME.y;
            if height >= size.y {
                return (corner, size);
            }
            let smaller = vec2(size.x, height);
            if height >= LEAST && best.is_none_or(|(_, best)| best.x * best.y < smaller.x * smaller.y) {
                best = Some((corner, smaller));
            }
        }
    }
    best.unwrap_or(first)
}

/// Over a picture whose file cannot be read any more, and in place of one whose file could never be read: why, for as long as that
/// is so.
pub(super) fn unread(ui: &Ui, viewer: &Viewer, free: Rect) {
    let Some(entry) = viewer.scene_list().current() else {
        return;
    };
    let is_told = |problem: &str| viewer.chrome().messages().iter().any(|message| message.text == problem);
    let has_picture = entry.scene().is_some();
    // What is told as a message already is not told twice.
    let Some(problem) = entry.failure().filter(|problem| has_picture || !is_told(problem)) else {
        return;
    };
    let (place, pivot) = if has_picture {
        (free.center_top() + vec2(0.0, TEXT_MARGIN), Align2::CENTER_TOP)
    } else {
        (free.center(), Align2::CENTER_CENTER)
    };
    Area::new(Id::unique("unread"))
        .order(Order::Middle)
        .fixed_pos(place)
        .pivot(pivot)
        .interactable(false)
        .fade_in(false)
        .show(ui.ctx(), |ui| {
            Frame::popup(ui.style()).show(ui, |ui| {
                ui.set_max_width(OUTDATED_WIDTH.min(free.width() - 4.0 * TEXT_MARGIN));
                ui.label(RichText::new(problem).color(ui.visuals().error_fg_color));
                failed_line(ui, entry);
                if has_picture {
                    ui.label(RichText::new(AS_BEFORE).small());
                }
            });
        });
}

/// Where a box of `size` goes: the first corner of `area` where nothing is `taken`.
fn free_corner(area: Rect, size: Vec2, taken: &[Rect]) -> Option<Rect> {
    let room = area.shrink(TEXT_MARGIN);
    [
        Align2::LEFT_TOP,
        Align2::LEFT_BOTTOM,
        Align2::RIGHT_TOP,
        Align2::RIGHT_BOTTOM,
    ]
    .into_iter()
    .map(|corner| corner.align_size_within_rect(size, room))
    .find(|place| room.contains_rect(*place) && taken.iter().all(|other| !other.intersects(*place)))
}

/// What words over the picture must not cover: insets, legends and the rings of pins, in points.
pub(super) fn things(viewer: &Viewer, scale: f32) -> Vec<Rect> {
    let legends = viewer.frames().legend_places();
    let legends = legends.iter().map(|place| points(place, scale));
    let things = insets(viewer, scale).into_iter().chain(legends);
    things.chain(pin::rings(viewer, scale)).collect()
}

/// The numbers on the inset's pixels, where they fit.
pub(super) fn pixel_labels(ui: &Ui, viewer: &Viewer) {
    let scale = ui.pixels_per_point();
    let font = FontId::monospace(9.0);
    let sample = ui
        .painter()
        .layout_no_wrap("0".to_owned(), font.clone(), Color32::WHITE);
    let character = [sample.size().x * scale, 9.5 * scale];
    for label in viewer.pixels().pixel_labels(character) {
        let center = pos2(
            middle(label.block.x, label.block.width) / scale,
            middle(label.block.y, label.block.height) / scale,
        );
        let color = if label.dark { Color32::WHITE } else { Color32::BLACK };
        let [r, g, b, _] = label.rgba;
        for (value, row) in [r, g, b].into_iter().zip([-1.0, 0.0, 1.0]) {
            let at = pos2(center.x, center.y + row * 9.5);
            ui.painter().text(at, Align2::CENTER_CENTER, value, font.clone(), color);
        }
    }
}

/// The button that closes the inspector, while the pointer is over a pinned inset: unpinned it gives way to the pointer.
/// An inset that comes to lie under a resting pointer has none until the pointer moves: the second half of a double click
/// on what was there before is not meant for it.
#[derive(Debug, Default)]
pub(super) struct CloseOfInset {
    /// What the pointer was to be over, and the pointer, in the last pass.
    last: Option<(Rect, Pos2)>,
    /// Where the pointer rests since the inset came.
    rests_at: Option<Pos2>,
    /// Whether the button was to be seen.
    shown: bool,
}

/// Where the button goes: beside the inset's upper end, so that it covers no magnified pixel of this inset or the `other`;
/// in the inset where no side has room.
fn place_of_close(inset: Rect, other: Option<Rect>, free: Rect) -> Rect {
    const APART: f32 = 3.0;
    let size = CONTROL;
    let right = inset.right_top() + vec2(APART, 0.0);
    let left = inset.left_top() - vec2(APART + size.x, 0.0);
    let above = inset.right_top() - vec2(size.x, APART + size.y);
    // On the outer side of one of two is its letter.
    let places = if other.is_some() {
        [right, above, left]
    } else {
        [right, left, above]
    };
    let mut places = places.map(|corner| Rect::from_min_size(corner, size)).into_iter();
    let inside = Rect::from_min_size(inset.right_top() + vec2(-APART - size.x, APART), size);
    let is_free = |place: &Rect| free.contains_rect(*place) && !other.is_some_and(|other| other.intersects(*place));
    places.find(is_free).unwrap_or(inside)
}

impl CloseOfInset {
    /// Shows it.
    pub(super) fn show(&mut self, ui: &Ui, viewer: &Viewer, free: Rect, commands: &mut Vec<Command>) {
        let scale = ui.pixels_per_point();
        let pinned = viewer
            .inspector()
            .inset()
            .filter(|_| viewer.pixels().pinned().is_some());
        let inset = pinned.map_or(Rect::NOTHING, |placed| points(&placed.rect, scale));
        let pointer = ui.input(|input| input.pointer.latest_pos());
        let other = viewer.inspector().other_inset();
        let other = other.map(|placed| points(&placed.rect, scale));
        let button = place_of_close(inset, other, free);
        // On the way to the button the pointer leaves the inset.
        let around = if self.shown { inset.union(button) } else { inset };
        let before = std::mem::replace(&mut self.last, pointer.map(|at| (around, at)));
        let over = pointer.filter(|at| around.contains(*at));
        self.shown = false;
        let Some(at) = over else {
            self.rests_at = None;
            return;
        };
        if before.is_some_and(|(around, pointer)| pointer == at && !around.contains(at)) {
            self.rests_at = Some(at);
        }
        self.rests_at = self.rests_at.filter(|rest| rest.distance(at) < REST);
        if self.rests_at.is_none() {
            self.shown = true;
            close_of_inset(ui, button, commands);
        }
    }
}

fn close_of_inset(ui: &Ui, place: Rect, commands: &mut Vec<Command>) {
    let button = Area::new(Id::unique("close inspector"))
        .order(Order::Middle)
        .fixed_pos(place.min)
        .fade_in(false)
        .show(ui.ctx(), |ui| ui.add_sized(place.size(), Button::new("\u{d7}")))
        .inner
        .on_hover_text("Closes the pixel inspector, and forgets the pinned pixel")
        .accessible_name("Close the pixel inspector");
    if button.clicked() {
        commands.push(Command::Inspector(InspectorCommand::Show(Toggle::Off)));
    }
}

fn middle(start: i64, length: u32) -> f32 {
    i32::try_from(start).unwrap_or_default() as f32 + length as f32 / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn close_covers_no_magnified_pixel() {
        let free = Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 300.0));
        let inset = |x, y| Rect::from_min_size(pos2(x, y), vec2(100.0, 100.0));
        let place = |inset, other| place_of_close(inset, other, free);
        for (own, other) in [
            (inset(100.0, 100.0), None),
            (inset(100.0, 100.0), Some(inset(204.0, 100.0))),
            (inset(204.0, 100.0), Some(inset(100.0, 100.0))),
            (inset(100.0, 12.0), Some(inset(204.0, 12.0))),
            (inset(290.0, 100.0), Some(inset(186.0, 100.0))),
        ] {
            let close = place(own, other);
            assert!(free.contains_rect(close), "{close:?}");
            assert!(!close.intersects(own), "{close:?} beside {own:?}");
            assert!(
                other.is_none_or(|other| !close.intersects(other)),
                "{close:?} beside {other:?}"
            );
        }
        let all = inset(0.0, 0.0).union(free);
        assert!(
            all.contains_rect(place(all, None)),
            "inside where there is no room beside it"
        );
    }

    #[test]
    fn text_goes_where_nothing_is() {
        let area = Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 300.0));
        let size = vec2(100.0, 60.0);
        let place = |taken: &[Rect]| free_corner(area, size, taken).map(|place| place.min);
        let [left, right] = [0.0, 200.0].map(|x| Rect::from_min_size(pos2(x, 0.0), vec2(200.0, 200.0)));
        assert_eq!(place(&[]), Some(pos2(10.0, 10.0)), "the upper left corner, if it may");
        assert_eq!(place(&[left]), Some(pos2(10.0, 230.0)), "below the inset");
        let below = Rect::from_min_size(pos2(0.0, 220.0), vec2(200.0, 80.0));
        assert_eq!(
            place(&[left, below]),
            Some(pos2(290.0, 10.0)),
            "beside inset and message"
        );
        assert_eq!(
            place(&[left, below, right]),
            Some(pos2(290.0, 230.0)),
            "the last corner"
        );
        assert_eq!(place(&[area]), None, "no room");
        assert_eq!(free_corner(area, vec2(390.0, 20.0), &[]), None, "too wide");
    }
}
