//! The first minute: what the program is for in one sentence, and four ways on. A card over the first scene has them, and
//! the help.

use egui::{Align, Button, Frame, Id, LayerId, Layout, Margin, Order, Rect, Response, RichText, ScrollArea, Ui, vec2};

use super::focus;
use super::look;
use super::places::card_area;
use crate::viewer::{
    Command, Dialog, InspectorCommand, LessonCommand, LessonSource, SceneCommand, SceneSource, Toggle, Viewer,
};
use crate::viewer::{WindowCommand, gallery};

/// What the program is for.
const PURPOSE: &str = "See how a picture is sampled: put any pixel under a microscope and learn why it has its colour.";
/// What keys and clicks do to the card.
const KEYS: &str =
    "Tab goes from button to button. Any other key, or a click beside this card, closes it; ? shows them again.";
/// Widest card, in points, its margin included.
const WIDTH: f32 = 372.0;
/// Free space inside, in points.
const MARGIN: i8 = 16;
/// Height of a way, in points.
const HEIGHT: f32 = 40.0;
/// What stays free above and below the card, with its outline, in points.
const AROUND: f32 = 12.0;
/// The scene that shows what too few samples do.
const STUDY: &str = "study/01_zone_plate.svg";

/// A way on: its name, what to expect, and what it does.
struct Way {
    name: &'static str,
    words: &'static str,
    does: Vec<Command>,
}

/// What became of the ways.
#[derive(Debug, Default)]
pub(super) struct Ways {
    /// What the way does that was taken.
    pub(super) taken: Vec<Command>,
    /// The control of the first.
    first: Option<Id>,
}

/// The card, while it is to be seen.
pub(super) fn card(ui: &Ui, viewer: &Viewer, free: Rect, commands: &mut Vec<Command>) {
    if !viewer.chrome().start_card() || viewer.chrome().dialog().is_some() {
        return;
    }
    let width = WIDTH.min(free.width() - 16.0);
    let card = ui.ctx().memory(|memory| memory.area_rect(Id::unique("start card")));
    let pressed = ui.input(|input| {
        input
            .pointer
            .any_pressed()
            .then(|| input.pointer.latest_pos())
            .flatten()
    });
    if let Some((card, at)) = card.zip(pressed)
        && !card.contains(at)
    {
        // Panels take clicks that are no commands of their own, such as that on the menu.
        commands.push(Command::Window(WindowCommand::StartCard(Toggle::Off)));
    }
    let height = (free.height() - 2.0 * f32::from(MARGIN) - AROUND).max(HEIGHT);
    let ways = card_area("start card", free.center(), free)
        .show(ui.ctx(), |ui| {
            let frame = Frame::popup(ui.style()).inner_margin(Margin {
                // The bar's room is a part of it.
                right: MARGIN - look::BAR_ROOM,
                ..Margin::same(MARGIN)
            });
            frame
                .show(ui, |ui| {
                    ui.set_width(width - 2.0 * f32::from(MARGIN) + f32::from(look::BAR_ROOM));
                    look::bars_beside(ui);
                    // An area keeps the height that it had: without a least height, the card of a window that grew stays low.
                    let area = ScrollArea::vertical().max_height(height).min_scrolled_height(height);
                    area.show(ui, |ui| contents(ui, viewer)).inner
                })
                .inner
        })
        .inner;
    if let Some(first) = ways.first {
        let layer = LayerId::new(Order::Middle, Id::unique("start card"));
        focus::keep_in(ui.ctx(), layer, first);
    }
    commands.extend(ways.taken);
}

/// What the card says and offers.
fn contents(ui: &mut Ui, viewer: &Viewer) -> Ways {
    ui.label(RichText::new("Rasterscope").heading().strong());
    ui.add_space(2.0);
    ui.label(PURPOSE);
    ui.add_space(8.0);
    let ways = ways(ui, viewer, 1);
    ui.add_space(6.0);
    ui.label(RichText::new(KEYS).weak().small());
    ways
}

/// The ways side by side in columns.
pub(super) fn ways(ui: &mut Ui, viewer: &Viewer, columns: usize) -> Ways {
    let mut found = Ways::default();
    let gap = ui.spacing().item_spacing.x;
    let width = ((ui.available_width() - gap * (columns - 1) as f32) / columns as f32).floor();
    let ways = ways_of(viewer);
    for row in ways.chunks(columns) {
        ui.horizontal(|ui| {
            for way in row {
                let button = button(ui, way, width);
                if button.clicked() {
                    found.taken.clone_from(&way.does);
                }
                found.first.get_or_insert(button.id);
            }
        });
    }
    found
}

/// One way, with what to expect below its name.
fn button(ui: &mut Ui, way: &Way, width: f32) -> Response {
    let size = vec2(width, HEIGHT);
    let button = ui.add(Button::new("").min_size(size)).accessible_name(way.name);
    let room = button.rect.shrink2(vec2(10.0, 3.0));
    let mut inside = ui.new_child(
        egui::UiBuilder::new()
            .max_rect(room)
            .layout(Layout::top_down(Align::Min)),
    );
    inside.spacing_mut().item_spacing.y = 1.0;
    inside.add(
        egui::Label::new(RichText::new(way.name).strong())
            .truncate()
            .sense(egui::Sense::empty()),
    );
    inside.add(
        egui::Label::new(RichText::new(way.words).weak().small())
            .truncate()
            .sense(egui::Sense::empty()),
    );
    button
}

/// The ways that are open: the study is one of the gallery.
fn ways_of(viewer: &Viewer) -> Vec<Way> {
    let lesson = LessonCommand::Open(LessonSource::BuiltIn(0));
    let mut ways = vec![Way {
        name: "Follow a lesson",
        words: "six tasks of a rasterizer, from edges to filters",
        does: vec![Command::Lesson(lesson)],
    }];
    ways.push(Way {
        name: "Open your file",
        words: if viewer.chrome().takes_drops() {
            "an SVG or a folder of them; or drop it on the window"
        } else {
            "an SVG or a folder of them"
        },
        does: vec![Command::Window(WindowCommand::ToggleDialog(Dialog::Open))],
    });
    let is_study = |source: &SceneSource| match source {
        SceneSource::Gallery(index) => gallery::SCENES.get(*index).is_some_and(|scene| scene.name == STUDY),
        SceneSource::File(_) => false,
    };
    if let Some(index) = viewer
        .scene_list()
        .scenes()
        .iter()
        .position(|entry| is_study(&entry.source))
    {
        ways.push(Way {
            name: "Look at a study of aliasing",
            words: "rings finer than the pixels, and what becomes of them",
            does: vec![
                Command::Scenes(SceneCommand::Show(index)),
                Command::Window(WindowCommand::About(Toggle::On)),
            ],
        });
    }
    ways.push(Way {
        name: "Explain a pixel",
        words: "one at an edge; a right click explains any other",
        does: vec![Command::Inspector(InspectorCommand::PinEdge)],
    });
    ways
}
