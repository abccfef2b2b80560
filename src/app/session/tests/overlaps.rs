//! What lies over the picture lies beside each other: magnifiers, rings of pins, words, legends, messages, the handle of a
//! wipe. In small windows above all.

#![expect(clippy::cast_possible_truncation, reason = "inside the window")]

use egui::{pos2, vec2};
use glam::dvec2;

use super::hands::{comparing, right_click, session};
use super::lessons::at_step;
use super::*;
use crate::viewer::picture::SettingChange;
use crate::viewer::script::Stage as _;
use crate::viewer::{
    AbCommand, Arrangement, Dialog, ExportCommand, InspectorCommand, InterfaceScale, LessonCommand, LessonSource,
    MessageKind, ProfileCommand, SpectrumCommand, Toggle, ViewCommand, WindowCommand,
};

/// A message that takes more than one line in a small window, and that nothing takes back.
const LONG: &str = "a message that is as long as the longest of those that are told: be it seen";

/// Everything over the picture, by name.
fn things(session: &Session) -> Vec<(&'static str, Rect)> {
    let (viewer, scale) = (&session.viewer, session.scale());
    let interface = &session.interface;
    let rect = |place: &PixelRect| {
        let corner = pos2(place.x as f32, place.y as f32) / scale;
        Rect::from_min_size(corner, vec2(place.width as f32, place.height as f32) / scale)
    };
    let mut things = Vec::new();
    let insets = viewer
        .inspector()
        .inset()
        .into_iter()
        .chain(viewer.inspector().other_inset());
    things.extend(insets.map(|placed| ("inset", rect(&placed.rect))));
    things.extend(
        viewer
            .frames()
            .legend_places()
            .iter()
            .map(|place| ("legend", rect(place))),
    );
    things.extend(interface.rings(viewer).into_iter().map(|ring| ("ring", ring)));
    things.extend(interface.labels().iter().map(|label| ("words", *label)));
    things.extend(interface.told().iter().map(|message| ("message", *message)));
    things.extend(interface.handle().map(|handle| ("handle", handle)));
    things
}

/// No two of them may overlap.
fn nothing_overlaps(session: &Session, what: &str) {
    let things = things(session);
    for (index, (name, rect)) in things.iter().enumerate() {
        for (other, place) in &things[..index] {
            let apart = !rect.shrink(0.5).intersects(*place);
            assert!(apart, "{name} {rect:?} over {other} {place:?}, {what}");
        }
    }
}

/// Places all over the free part of the window.
fn places(session: &Session) -> Vec<[i64; 2]> {
    let free = session.free_area.expect("there is room");
    let part = |start: i64, length: u32, part: i64| start + i64::from(length) * part / 12;
    let rows = (0..12).map(|row| part(free.y, free.height, row) + 20);
    rows.flat_map(|y| (0..12).map(move |column| [part(free.x, free.width, column) + 15, y]))
        .collect()
}

#[test]
fn nothing_lies_over_the_ring_of_a_pin() {
    for (step, what) in [(2, "in a lesson"), (5, "in a visualisation"), (9, "in a comparison")] {
        let mut session = at_step(step, [800, 600]);
        nothing_overlaps(&session, what);
        for at in places(&session) {
            session.command(Command::Inspector(InspectorCommand::Pin(at)));
            session.settle();
            nothing_overlaps(&session, &format!("{what}, at {at:?}"));
        }
    }
}

#[test]
fn nothing_lies_over_the_ring_of_a_pin_beside_panels() {
    for arrangement in [Arrangement::Wipe, Arrangement::SideBySide, Arrangement::Difference] {
        for window in [[800, 600], [1280, 800]] {
            let mut session = comparing(window);
            session.command(Command::Ab(AbCommand::Arrange(arrangement)));
            session.settle();
            let layout = session.viewer.both().layout();
            for at in places(&session).into_iter().step_by(5) {
                let at = layout.nearest_in_frame(at).expect("a frame").map(i64::from);
                session.command(Command::Inspector(InspectorCommand::Pin(at)));
                session.settle();
                nothing_overlaps(&session, &format!("{arrangement:?} of {window:?} at {at:?}"));
            }
        }
    }
}

#[test]
fn messages_lie_beside_magnifiers_words_and_legends() {
    for step in 0..10 {
        let mut session = at_step(step, [800, 600]);
        session.viewer.tell(MessageKind::Done, LONG.to_owned());
        session.command(Command::Export(ExportCommand::CopyPixel));
        session.quiet_turn();
        session.quiet_turn();
        assert!(session.interface.told().len() >= 2, "messages");
        nothing_overlaps(&session, &format!("in step {step}"));
        let before = session.interface.told().to_vec();
        session.quiet_turn();
        assert_eq!(session.interface.told(), before, "and they stay there");
    }
}

#[test]
fn messages_in_a_small_window_lie_in_it_and_beside_each_other() {
    for window in [[420, 300], [330, 260]] {
        let mut session = session(Vec::new(), window);
        session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
        session.command(Command::Inspector(InspectorCommand::Show(Toggle::On)));
        session.command(Command::Lesson(LessonCommand::Open(LessonSource::BuiltIn(0))));
        session.viewer.tell(MessageKind::Done, LONG.to_owned());
        session.settle();
        session.quiet_turn();
        let told = session.interface.told();
        assert!(told.len() >= 2, "messages in {window:?}");
        let all = Rect::from_min_size(pos2(0.0, 0.0), vec2(window[0] as f32, window[1] as f32));
        for (index, message) in told.iter().enumerate() {
            assert!(all.contains_rect(*message), "{message:?} in {window:?}");
            for other in &told[..index] {
                assert!(!message.shrink(0.5).intersects(*other), "{message:?} over {other:?}");
            }
        }
    }
}

#[test]
fn words_of_a_wipe_in_a_lesson_are_whole() {
    let mut session = at_step(9, [800, 600]);
    // A hand left A little room.
    session.command(Command::Ab(AbCommand::SetWipe(0.5)));
    session.settle();
    let first = session.interface.labels().first().copied().expect("words about A");
    // "A: sample rate 1, level sampling linear" takes five lines there.
    assert!(first.height() > 70.0, "{first:?}");
}

#[test]
fn letters_of_magnifiers_stay_in_the_picture() {
    let mut session = at_step(7, [800, 600]);
    session.command(Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)));
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    let free = session.free_area.expect("there is room");
    assert!(free.width < 250, "a lesson and a panel leave little: {free:?}");
    let labels = session.interface.labels();
    assert!(labels.len() >= 2, "{labels:?}");
    for label in labels {
        let inside = [label.min, label.max - vec2(1.0, 1.0)];
        let inside = inside.map(|at| free.contains([at.x as i64, at.y as i64]));
        assert_eq!(inside, [true; 2], "{label:?} in {free:?}");
    }
}

/// A card over the picture by its name.
fn card(session: &Session, name: &str) -> Rect {
    let rect = session.ctx().memory(|memory| memory.area_rect(egui::Id::unique(name)));
    rect.expect(name)
}

/// What of the window is free, in points.
fn free(session: &Session) -> Rect {
    let free = session.free_area.expect("there is room");
    let scale = session.scale();
    let corner = pos2(free.x as f32, free.y as f32) / scale;
    Rect::from_min_size(corner, vec2(free.width as f32, free.height as f32) / scale)
}

#[test]
fn words_of_a_scene_leave_pins_free_in_large_letters() {
    for (window, percent) in [
        ([1366, 768], 200),
        ([1366, 768], 150),
        ([1024, 700], 150),
        ([1920, 1080], 250),
    ] {
        let mut session = session(Vec::new(), window);
        let scale = InterfaceScale::from_percent(percent);
        session.command(Command::Window(WindowCommand::SetInterfaceScale(scale)));
        session.command(Command::Window(WindowCommand::About(Toggle::On)));
        session.settle();
        for at in places(&session).into_iter().step_by(7) {
            session.command(Command::Inspector(InspectorCommand::Pin(at)));
            session.settle();
            let words = card(&session, "words").shrink(0.5);
            for (name, rect) in things(&session) {
                let what = format!("{name} {rect:?} under {words:?}, {at:?} of {window:?} at {percent} %");
                assert!(!rect.intersects(words), "{what}");
            }
        }
    }
}

#[test]
fn way_back_lies_in_what_is_free_and_beside_all_words() {
    for percent in [100, 150, 200, 250] {
        for window in [[800, 600], [1280, 800]] {
            let mut session = session(Vec::new(), window);
            let scale = InterfaceScale::from_percent(percent);
            session.command(Command::Window(WindowCommand::SetInterfaceScale(scale)));
            session.command(Command::View(ViewCommand::PanBy { by: dvec2(9e4, 0.0) }));
            session.command(Command::Set(SettingChange::of("rules", "float").expect("a setting")));
            session.viewer.tell(MessageKind::Done, LONG.to_owned());
            session.settle();
            let area = free(&session);
            if area.width() < 190.0 || area.height() < 104.0 {
                continue;
            }
            let card = card(&session, "way back");
            assert!(
                area.expand(0.5).contains_rect(card),
                "{card:?} in {area:?} at {percent} % of {window:?}"
            );
            for (name, rect) in things(&session) {
                let apart = !rect.shrink(0.5).intersects(card);
                assert!(apart, "{name} {rect:?} over {card:?} at {percent} % of {window:?}");
            }
            for message in session.interface.told() {
                assert!(area.contains_rect(*message), "{message:?} in {area:?} at {percent} %");
            }
        }
    }
}

#[test]
fn messages_lie_beside_dialogs_where_there_is_room() {
    for window in [[800, 600], [1280, 800]] {
        let mut session = session(Vec::new(), window);
        session.viewer.tell(MessageKind::Done, LONG.to_owned());
        session.command(Command::Window(WindowCommand::ToggleDialog(Dialog::GoToPixel)));
        session.settle();
        session.quiet_turn();
        let dialog = card(&session, "Go to pixel");
        let told = session.interface.told();
        assert!(!told.is_empty(), "a message");
        for message in told {
            assert!(!message.intersects(dialog), "{message:?} over {dialog:?}");
        }
    }
}

#[test]
fn way_back_lies_beside_cards_that_measure() {
    let open = [
        ("edge profile", Command::Profile(ProfileCommand::Show(Toggle::On))),
        ("spectrum", Command::Spectrum(SpectrumCommand::Show(Toggle::On))),
    ];
    for window in [[1280, 800], [1000, 700]] {
        for cards in [&open[..1], &open[1..], &open] {
            let mut session = session(Vec::new(), window);
            session.command(Command::View(ViewCommand::PanBy { by: dvec2(9e4, 0.0) }));
            right_click(&mut session, [f64::from(window[0]) / 2.0, f64::from(window[1]) / 2.0]);
            for (_, command) in cards {
                session.command(command.clone());
            }
            session.settle();
            let back = card(&session, "way back");
            for (name, _) in cards {
                let other = card(&session, name);
                assert!(!back.intersects(other), "{back:?} and {name} {other:?} in {window:?}");
            }
        }
    }
}
