//! The way back to a canvas that is out of sight: a notice over the picture, with a button.

use egui::{Frame, Id, LayerId, Order, Rect, Ui, vec2};

use super::controls::command_button;
use super::places::{beside, card_area, insets};
use crate::viewer::{Arrangement, Command, ViewCommand, Viewer};

/// What its area is called.
const NAME: &str = "way back";
/// Its width, in points.
const WIDTH: f32 = 230.0;
/// The least width in which it can be read, in points.
const LEAST_WIDTH: f32 = 170.0;
/// Its height, in points.
const HEIGHT: f32 = 84.0;
/// Free space around it, in points.
const MARGIN: f32 = 10.0;

/// Why there is nothing to see, where that is the view's doing.
fn nothing_to_see(viewer: &Viewer) -> Option<&'static str> {
    if !viewer.scene_list().canvas_in_sight(&viewer.both().layout()) {
        return Some("the canvas lies outside the free part of the window");
    }
    let is_moved = viewer.scene_list().view_is_moved();
    let is_whole = viewer.frames().preview().is_none() && viewer.ab().arrangement() == Arrangement::Alone;
    let is_empty = || {
        viewer
            .frames()
            .frame()
            .is_some_and(|frame| frame.pixels.pixels().iter().all(|pixel| *pixel == u32::MAX))
    };
    (is_moved && is_whole && is_empty()).then_some("every pixel in sight is white")
}

/// Where nothing of the canvas is in sight, or nothing but white: how to come back to it; left out where there is no room. It lies
/// beside `cards`, or over them where it cannot. Returns where it stands.
pub(super) fn show(
    ui: &Ui,
    viewer: &Viewer,
    (free, cards): (Rect, &[Rect]),
    commands: &mut Vec<Command>,
) -> Option<Rect> {
    let room = free.shrink(MARGIN);
    let has_room = room.width() >= LEAST_WIDTH && room.height() >= HEIGHT;
    let why = nothing_to_see(viewer).filter(|_| has_room)?;
    let taken = [&insets(viewer, ui.pixels_per_point()), cards].concat();
    let found = place(free, &taken);
    if found.is_none() {
        ui.ctx().move_to_top(LayerId::new(Order::Middle, Id::unique(NAME)));
    }
    let place = found.unwrap_or(free);
    let area = card_area(NAME, place.center(), free).show(ui.ctx(), |ui| {
        Frame::popup(ui.style()).show(ui, |ui| {
            ui.vertical_centered(|ui| {
                ui.set_max_width(WIDTH.min(free.width() - 2.0 * MARGIN));
                ui.label(format!("Nothing to see here: {why}."));
                if command_button(ui, "reset-view", "Show the canvas (Space)").clicked() {
                    commands.push(Command::View(ViewCommand::Reset));
                }
            });
        });
    });
    Some(area.response.rect)
}

/// Where the way back lies beside what is `taken`: in the middle if it can, else above, below, or as near to the middle as there is
/// room. `None` where there is none.
fn place(free: Rect, taken: &[Rect]) -> Option<Rect> {
    let size = vec2(WIDTH + 2.0 * MARGIN, HEIGHT);
    let middle = Rect::from_center_size(free.center(), size);
    let above = middle.translate(vec2(0.0, free.top() + MARGIN - middle.top()));
    let below = middle.translate(vec2(0.0, free.bottom() - MARGIN - middle.bottom()));
    let is_free = |place: &Rect| taken.iter().all(|other| !other.intersects(*place));
    [middle, above, below].into_iter().find(is_free).or_else(|| {
        let parts = beside(free, taken.iter().copied()).into_iter();
        let centers = parts
            .map(|part| part.shrink2(size / 2.0))
            .filter(|part| !part.is_negative());
        let places = centers.map(|part| Rect::from_center_size(part.clamp(free.center()), size));
        let distance = |place: &Rect| place.center().distance_sq(free.center());
        places.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    })
}
