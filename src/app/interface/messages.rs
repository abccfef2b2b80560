//! Messages over the picture: each stays for some seconds, where it covers nothing that one looks at.

use std::collections::HashMap;

use egui::{Align2, Area, Color32, Frame, Id, Order, Rect, RichText, Sense, TextStyle, Ui, Vec2, vec2};

use crate::viewer::{ASKS_FOR, Command, ExportCommand, Message, MessageKind, Viewer, WindowCommand};

/// Seconds that a message stays.
const DONE_SECONDS: f64 = 5.0;
/// Seconds that a message stays which offers something.
const OFFER_SECONDS: f64 = 12.0;
/// Seconds that a message about a fault stays.
const ERROR_SECONDS: f64 = 15.0;
/// Widths of a message at most, in points; a narrower one is taken where a wider one has no room.
const WIDTHS: [f32; 5] = [520.0, 400.0, 300.0, 220.0, 160.0];
/// Free space between a message and what is beside it, in points.
const GAP: f32 = 6.0;
/// Free space between messages and the border of the picture, in points.
const MARGIN: f32 = 10.0;
/// What stays free around the pointer where a message comes, in points.
const POINTER: f32 = 48.0;
/// Space inside a message, in points.
const PADDING: f32 = 8.0;

/// Where messages may lie, and what lies over the picture besides, in points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taken<'a> {
    /// The picture that no panel covers.
    pub(super) free: Rect,
    /// What a message never covers where there is any other room.
    pub(super) things: &'a [Rect],
    /// What would give way to a message: it moves only where there is no other room.
    pub(super) words: &'a [Rect],
}

/// A message on the screen.
#[derive(Clone, Copy, Debug)]
struct Shown {
    /// When it vanishes, in egui's seconds.
    end: f64,
    /// Where it is, in points.
    place: Rect,
    /// What panels left free when it came there.
    free: Rect,
}

/// The messages on the screen.
#[derive(Debug, Default)]
pub(super) struct Messages {
    shown: HashMap<u64, Shown>,
}

impl Messages {
    /// Shows the messages, at the foot of the picture where there is room, and dismisses the old ones. None moves while it
    /// can stay and panels leave the same free: what came while they moved may lie where the picture is looked at.
    pub(super) fn show(
        &mut self,
        ui: &Ui,
        viewer: &Viewer,
        taken: Taken<'_>,
        commands: &mut Vec<Command>,
    ) -> Vec<Rect> {
        let free = taken.free;
        let window = ui.ctx().content_rect();
        let now = ui.input(|input| input.time);
        self.shown
            .retain(|id, _| viewer.chrome().messages().iter().any(|message| message.id == *id));
        let mut covered: Vec<Rect> = Vec::new();
        for message in viewer.chrome().messages() {
            let seconds = match message.kind {
                MessageKind::Done => DONE_SECONDS,
                MessageKind::Saved | MessageKind::TakenAway => OFFER_SECONDS,
                MessageKind::Error => ERROR_SECONDS,
                MessageKind::Question => ASKS_FOR.as_secs_f64(),
            };
            let things = [taken.things, &covered].concat();
            let before = self.shown.get(&message.id).copied();
            let place = before
                .filter(|shown| shown.free == free && is_free(free, shown.place, &things))
                .map(|shown| shown.place)
                .or_else(|| {
                    let size = |width| size(ui, viewer, message, width);
                    // One that comes under the pointer would take its clicks and the turns of its wheel.
                    let pointer = ui.input(|input| input.pointer.latest_pos());
                    let pointer = pointer.map(|at| Rect::from_center_size(at, Vec2::splat(POINTER)));
                    let things: Vec<Rect> = things.iter().copied().chain(pointer).collect();
                    let all = [&things, taken.words].concat();
                    let beside = [(&all, free), (&things, free)];
                    // Where that has no room: over the picture's things, or over panels, but never over each other.
                    let over = [free, window].map(|room| (&covered, room));
                    let mut rooms = beside.into_iter().chain(over).filter(|(_, room)| is_wide(*room));
                    rooms.find_map(|(taken, room)| place(room, taken, size))
                })
                .unwrap_or_else(|| {
                    let width = WIDTHS[0].min(window.width() - 2.0 * MARGIN);
                    above(window, &covered, size(ui, viewer, message, width))
                });
            let end = before.map_or(now + seconds, |shown| shown.end);
            self.shown.insert(message.id, Shown { end, place, free });
            let offer = offer(viewer, message);
            let (rect, clicked) = toast(ui, message, place, offer.as_ref().map(|(name, _)| *name));
            if clicked == Some(Clicked::Offer) {
                commands.extend(offer.map(|(_, command)| command));
            }
            if now >= end || clicked.is_some() {
                commands.push(Command::Window(WindowCommand::DismissMessage(message.id)));
            } else {
                let rest = std::time::Duration::from_secs_f64((end - now).clamp(0.02, 60.0));
                ui.ctx().request_repaint_after(rest);
            }
            covered.push(rect);
        }
        covered
    }
}

/// How large a message is that may be so wide.
fn size(ui: &Ui, viewer: &Viewer, message: &Message, width: f32) -> Vec2 {
    let font = TextStyle::Body.resolve(ui.style());
    let text = message.text.clone();
    let galley = ui.painter().layout(text, font, Color32::WHITE, width - 2.0 * PADDING);
    let frame = 2.0 * (PADDING + ui.visuals().window_stroke.width);
    let button = if offer(viewer, message).is_some() {
        ui.spacing().interact_size.y + ui.spacing().item_spacing.y
    } else {
        0.0
    };
    galley.size().ceil() + Vec2::splat(frame) + vec2(0.0, button)
}

/// What the button of a message says and does, where it has one: the last that tells of such a thing, so that there is no doubt
/// which folder it shows or what it brings back.
fn offer(viewer: &Viewer, message: &Message) -> Option<(&'static str, Command)> {
    let offer = match message.kind {
        MessageKind::Saved => ("Open folder", Command::Export(ExportCommand::OpenFolder)),
        MessageKind::TakenAway => ("Undo", Command::Window(WindowCommand::BringBack)),
        MessageKind::Done | MessageKind::Error | MessageKind::Question => return None,
    };
    let mut messages = viewer.chrome().messages().iter().rev();
    let last = messages.find(|other| other.kind == message.kind);
    last.is_some_and(|last| last.id == message.id).then_some(offer)
}

/// What was clicked of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Clicked {
    /// Itself, to close it.
    Message,
    /// Its button.
    Offer,
}

/// Whether a message may be there.
fn is_free(free: Rect, place: Rect, taken: &[Rect]) -> bool {
    free.contains_rect(place) && taken.iter().all(|other| !other.expand(GAP - 1.0).intersects(place))
}

/// The lowest place inside `free` beside what is taken, on the left if it can be.
fn place(free: Rect, taken: &[Rect], size: impl Fn(f32) -> Vec2) -> Option<Rect> {
    let room = free.shrink(MARGIN);
    let widths = WIDTHS.into_iter().map(|width| width.min(room.width()));
    widths.map(size).find_map(|size| {
        let mut bottoms: Vec<f32> = taken.iter().map(|other| other.top() - GAP).collect();
        bottoms.retain(|bottom| *bottom < room.bottom());
        bottoms.sort_by(|a, b| b.total_cmp(a));
        bottoms.insert(0, room.bottom());
        let lefts = [room.left(), room.right() - size.x];
        let beside = taken
            .iter()
            .flat_map(|other| [other.right() + GAP, other.left() - GAP - size.x]);
        let lefts: Vec<f32> = lefts.into_iter().chain(beside).collect();
        let places = bottoms.iter().flat_map(|bottom| {
            let at = move |left: &f32| Rect::from_min_size(egui::pos2(*left, bottom - size.y), size);
            lefts.iter().map(at)
        });
        places.into_iter().find(|place| is_free(room, *place, taken))
    })
}

/// Whether a message has room in this width.
fn is_wide(room: Rect) -> bool {
    room.width() >= WIDTHS[4] + 2.0 * MARGIN
}

/// The place above other messages at the foot of the window, whatever is there, but not above its upper edge.
fn above(window: Rect, messages: &[Rect], size: Vec2) -> Rect {
    let foot = messages.iter().map(|other| other.top() - GAP);
    let bottom = foot.fold(window.bottom() - MARGIN, f32::min);
    let bottom = bottom.max(window.top() + MARGIN + size.y);
    Align2::LEFT_BOTTOM.anchor_size(egui::pos2(window.left() + MARGIN, bottom), size)
}

fn toast(ui: &Ui, message: &Message, place: Rect, offer: Option<&'static str>) -> (Rect, Option<Clicked>) {
    let visuals = ui.visuals();
    let color = match message.kind {
        MessageKind::Error => visuals.error_fg_color,
        _ => visuals.strong_text_color(),
    };
    let mut takes = false;
    let text = RichText::new(&message.text).color(color);
    let frame = vec2(PADDING, PADDING) + Vec2::splat(ui.visuals().window_stroke.width);
    let response = Area::new(Id::unique(("message", message.id)))
        .order(Order::Foreground)
        .fixed_pos(place.left_bottom())
        .pivot(Align2::LEFT_BOTTOM)
        .fade_in(false)
        .accessible_name("Message")
        .sense(Sense::click())
        .show(ui.ctx(), |ui| {
            Frame::popup(ui.style()).inner_margin(PADDING).show(ui, |ui| {
                ui.set_max_width(place.width() - 2.0 * frame.x);
                ui.label(text);
                takes = offer.is_some_and(|name| ui.button(name).clicked());
            });
        })
        .response;
    let response = response.on_hover_text("Click to close");
    let clicked = takes
        .then_some(Clicked::Offer)
        .or_else(|| response.clicked().then_some(Clicked::Message));
    (response.rect, clicked)
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    #[test]
    fn messages_go_where_nothing_is() {
        let free = Rect::from_min_size(pos2(0.0, 0.0), vec2(500.0, 400.0));
        // As much text on fewer points takes more lines.
        let size = |width: f32| vec2(width, (9000.0 / width).ceil());
        let found = |taken: &[Rect]| place(free, taken, size);
        let rect = |left, top, right, bottom| Rect::from_min_max(pos2(left, top), pos2(right, bottom));
        assert_eq!(
            found(&[]).map(|place| place.left_bottom()),
            Some(pos2(10.0, 390.0)),
            "the foot"
        );
        let inset = rect(250.0, 150.0, 490.0, 390.0);
        let beside = found(&[inset]).expect("there is room");
        assert!(!beside.intersects(inset) && free.contains_rect(beside), "{beside:?}");
        let legend = rect(10.0, 300.0, 240.0, 390.0);
        for taken in [
            vec![inset, legend],
            vec![legend],
            vec![inset, legend, rect(0.0, 0.0, 500.0, 60.0)],
        ] {
            let place = found(&taken).expect("there is room");
            assert!(
                taken.iter().all(|other| !other.intersects(place)),
                "{place:?} beside {taken:?}"
            );
        }
        assert_eq!(found(&[free]), None, "no room");
    }

    #[test]
    fn messages_begin_in_the_window() {
        let window = Rect::from_min_size(pos2(0.0, 0.0), vec2(300.0, 100.0));
        let below = Rect::from_min_max(pos2(10.0, 40.0), pos2(290.0, 90.0));
        let place = above(window, &[below], vec2(200.0, 60.0));
        assert!(window.contains_rect(place), "{place:?}");
    }
}
