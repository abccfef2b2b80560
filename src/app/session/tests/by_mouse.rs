//! What a hand does that has nothing but a mouse: what it clicks is explained, and what it opens it can close.

use std::path::PathBuf;

use egui::{pos2, vec2};
use glam::{DVec2, dvec2};

use super::hands::{click_on, comparing, key, place_of, right_click, says, session};
use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{AbCommand, Arrangement, Axis, BoardCommand, InspectorCommand, Toggle, ViewCommand, WindowCommand};

/// What closes the explanation.
const CLOSE: &str = "Explanation";

/// Colour and place of a frame pixel.
fn content(session: &Session, pixel: [u32; 2]) -> ([u8; 4], DVec2) {
    let status = session.viewer.pixels().status_of(pixel).expect("a scene");
    (status.rgba.expect("a picture"), status.user)
}

/// Clicks at a place in the window: what is explained then must be what was there.
fn explains_what_is_clicked(session: &mut Session, at: [f64; 2]) {
    let window = session.window();
    session.pointer(Some(DVec2::from(at)));
    let clicked = session.viewer.pixels().hovered().expect("the picture");
    let (color, place) = content(session, clicked);
    right_click(session, at);
    let explained = session.viewer.inspector().explanation().expect("an explanation");
    assert_eq!(explained.color, color, "{clicked:?} at {at:?} of {window:?}");
    let pixel = explained.pixel;
    let off = (content(session, pixel).1 - place).length();
    assert!(off < 1e-6, "{off} units from {clicked:?} to {pixel:?} of {window:?}");
}

#[test]
fn clicked_pixel_is_the_one_that_is_explained() {
    for at in [[585.0, 80.0], [586.0, 81.0], [700.0, 300.0], [900.0, 420.0]] {
        let mut session = session(vec![PathBuf::from("lesson:six-tasks")], [1280, 800]);
        let before = session.viewer.both().view_numbers();
        explains_what_is_clicked(&mut session, at);
        explains_what_is_clicked(&mut session, [at[0] + 20.0, at[1] + 10.0]);
        click_on(&mut session, CLOSE);
        assert_eq!(session.viewer.both().view_numbers(), before, "the view is fitted again");
    }
}

#[test]
fn clicked_pixel_is_the_one_that_is_explained_side_by_side() {
    for window in [[1280, 800], [1366, 768]] {
        for at in [[75.0, 329.0], [330.0, 329.0], [301.0, 402.0], [700.0, 300.0]] {
            let mut session = comparing(window);
            session.command(Command::Window(WindowCommand::Panel(Toggle::Off)));
            session.command(Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)));
            session.settle();
            let before = session.viewer.both().view_numbers();
            explains_what_is_clicked(&mut session, at);
            click_on(&mut session, CLOSE);
            assert_eq!(session.viewer.both().view_numbers(), before, "as before, in {window:?}");
        }
    }
}

#[test]
fn pinned_pixel_is_explained_again_after_close() {
    let mut session = session(Vec::new(), [1280, 800]);
    let at = [700.0, 300.0];
    right_click(&mut session, at);
    assert!(says(&mut session, "Pixel 700, 300"), "explained");
    click_on(&mut session, CLOSE);
    assert!(!says(&mut session, "Pixel 700, 300"), "closed");
    right_click(&mut session, at);
    assert!(says(&mut session, "Pixel 700, 300"), "explained again");
    right_click(&mut session, at);
    assert_eq!(session.viewer.pixels().pinned(), None, "a second click unpins it");
    assert!(
        session.viewer.inspector().inset().is_none(),
        "and closes what the first one opened"
    );
    session.command(Command::Inspector(InspectorCommand::Show(Toggle::On)));
    right_click(&mut session, at);
    right_click(&mut session, at);
    assert!(
        session.viewer.inspector().inset().is_some(),
        "but not what was open before"
    );
}

#[test]
fn magnifier_has_a_button_that_closes_it() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::Inspector(InspectorCommand::Show(Toggle::On)));
    right_click(&mut session, [700.0, 300.0]);
    let inset = session.viewer.inspector().inset().expect("there is room").rect;
    session.pointer(Some(dvec2(inset.x as f64 + 20.0, inset.y as f64 + 20.0)));
    session.settle();
    let button = place_of(&mut session, "Close the pixel inspector");
    assert!(
        button.x < inset.x as f64 || button.x > inset.right() as f64,
        "{button} covers no pixel of {inset:?}"
    );
    click_on(&mut session, "Close the pixel inspector");
    assert!(session.viewer.inspector().inset().is_none(), "closed");
}

#[test]
fn line_of_a_wipe_stays_beside_panels() {
    for window in [[800, 600], [1280, 800], [1366, 768]] {
        let mut session = comparing(window);
        session.command(Command::Ab(AbCommand::Arrange(Arrangement::Wipe)));
        session.settle();
        let line = |session: &Session| session.viewer.both().wipe_line().expect("a wipe");
        let in_sight = |session: &Session, what: &str| {
            let (line, free) = (line(session), session.free_area.expect("there is room"));
            let (left, right) = (free.x as f64, free.right() as f64);
            assert!(
                left + 20.0 < line && line < right - 20.0,
                "{what}: {line} in {free:?} of {window:?}"
            );
        };
        in_sight(&session, "at first");
        let free = session.free_area.expect("there is room");
        let y = free.y as f64 + 40.0;
        for (x, what) in [(100.0, "far left"), (f64::from(window[0]) - 60.0, "far right")] {
            session.pointer(Some(dvec2(line(&session), y)));
            session.button(PointerButton::Primary, true);
            session.pointer(Some(dvec2(x, y)));
            session.button(PointerButton::Primary, false);
            session.settle();
            in_sight(&session, what);
        }
        let middle = (free.x + free.right()) as f64 / 2.0;
        session.pointer(Some(dvec2(line(&session), y)));
        session.button(PointerButton::Primary, true);
        session.pointer(Some(dvec2(middle, y)));
        session.button(PointerButton::Primary, false);
        assert!((line(&session) - middle).abs() <= 1.0, "and back in {window:?}");
        for part in [0.0, 1.0] {
            session.command(Command::Ab(AbCommand::SetWipe(part)));
            right_click(&mut session, [middle, y]);
            in_sight(&session, "beside an explanation");
        }
    }
}

#[test]
fn missing_room_for_an_explanation_is_told() {
    let mut session = session(Vec::new(), [600, 400]);
    right_click(&mut session, [300.0, 200.0]);
    assert!(session.viewer.pixels().pinned().is_some(), "pinned");
    assert!(says(&mut session, "make the window wider"), "why there is no more");
    let mut by_key = hands::session(Vec::new(), [600, 400]);
    key(&mut by_key, "e");
    by_key.settle();
    assert!(says(&mut by_key, "make the window wider"), "by a key, too");
    session.resize([1280, 800]);
    session.settle();
    assert!(
        session.viewer.inspector().explanation().is_some(),
        "explained where there is room"
    );
}

#[test]
fn wheel_goes_on_turning_the_inset_that_it_moved_away() {
    let mut session = session(Vec::new(), [1280, 800]);
    right_click(&mut session, [570.0, 300.0]);
    let view = session.viewer.both().view_numbers();
    let inset = session.viewer.inspector().inset().expect("a magnifier").rect;
    let [x, y] = [
        inset.x + i64::from(inset.width) / 2,
        inset.y + i64::from(inset.height) / 2,
    ];
    let at = dvec2(x as f64, y as f64);
    session.pointer(Some(at));
    assert!(session.viewer.pixels().over_inset(), "the pointer is in the magnifier");
    session.wheel(1.0);
    assert_eq!(session.viewer.both().view_numbers(), view, "the magnifier took it");
    // A pin below it sends it away from the pointer, which rests.
    session.command(Command::Inspector(InspectorCommand::Pin([x, y])));
    session.settle();
    assert!(!session.viewer.pixels().over_inset(), "it gave way");
    session.wheel(1.0);
    assert_eq!(
        session.viewer.both().view_numbers(),
        view,
        "the magnifier takes it still"
    );
    session.pointer(Some(at + 1.0));
    session.wheel(1.0);
    assert_ne!(session.viewer.both().view_numbers(), view, "the wheel zooms again");
}

#[test]
fn message_about_a_pin_goes_with_it() {
    let mut session = session(Vec::new(), [1280, 800]);
    right_click(&mut session, [570.0, 300.0]);
    session.command(Command::View(ViewCommand::PanBy {
        by: dvec2(-3000.0, 0.0),
    }));
    let tells = |session: &Session| {
        let mut all = session.viewer.chrome().messages().iter();
        all.any(|message| message.text.contains("outside the window"))
    };
    assert!(tells(&session), "the pin is out of sight");
    session.command(Command::Inspector(InspectorCommand::Pin([500, 300])));
    assert!(!tells(&session), "another one is in sight");
}

#[test]
fn second_click_in_the_inset_unpins_what_the_first_one_pinned() {
    let mut session = session(Vec::new(), [800, 600]);
    right_click(&mut session, [200.0, 300.0]);
    let inset = session.viewer.inspector().inset().expect("a magnifier").rect;
    let mut moved = false;
    for part in [0.04, 0.2, 0.35, 0.65, 0.8, 0.96] {
        let across = |from: i64, size: u32| from as f64 + (f64::from(size) * part).floor();
        let at = [across(inset.x, inset.width), across(inset.y, inset.height)];
        session.pointer(Some(DVec2::from(at)));
        let (hovered, before) = (session.viewer.pixels().hovered(), session.viewer.pixels().pinned());
        if !session.viewer.pixels().over_inset() || hovered.is_none() || hovered == before {
            continue;
        }
        right_click(&mut session, at);
        let pinned = session.viewer.pixels().pinned();
        moved |= !session.viewer.pixels().over_inset();
        assert!(pinned.is_some(), "a pixel of the inset");
        right_click(&mut session, at);
        assert_eq!(session.viewer.pixels().pinned(), None, "{pinned:?} at {at:?}");
        right_click(&mut session, [200.0, 300.0]);
    }
    assert!(moved, "the inset left the pointer once");
}

#[test]
fn drag_moves_the_magnifier_to_another_corner() {
    for window in [[800, 600], [1366, 768]] {
        let mut session = session(Vec::new(), window);
        right_click(&mut session, [300.0, 300.0]);
        let rect = |session: &Session| session.viewer.inspector().inset().expect("a magnifier").rect;
        let middle = |rect: PixelRect| {
            let middle = |from: i64, size: u32| from as f64 + f64::from(size) / 2.0;
            dvec2(middle(rect.x, rect.width), middle(rect.y, rect.height))
        };
        let before = session.viewer.both().view_numbers();
        let pin = session.viewer.pixels().pinned();
        let first = rect(&session);
        let free = session.free_area.expect("there is room");
        let right = free.right() as f64 - 5.0;
        let below = f64::from(free.height) - 5.0;
        let mut places = vec![first];
        for to in [dvec2(right, below), dvec2(right, 5.0)] {
            session.pointer(Some(middle(rect(&session))));
            assert!(session.viewer.pixels().over_inset(), "the pointer is in the magnifier");
            session.button(PointerButton::Primary, true);
            session.pointer(Some(to));
            session.button(PointerButton::Primary, false);
            session.settle();
            places.push(rect(&session));
        }
        assert_ne!(places[1], places[2], "{places:?} in {window:?}");
        assert!(places[1].y > places[2].y, "below, then above: {places:?} in {window:?}");
        assert_eq!(
            session.viewer.both().view_numbers(),
            before,
            "the picture stays in {window:?}"
        );
        assert_eq!(session.viewer.pixels().pinned(), pin, "and the pin in {window:?}");
    }
}

#[test]
fn wheel_that_zooms_goes_on_zooming() {
    // A large magnifier, and a pin that the zoom drives into its corner: it has to go elsewhere.
    for at in [[300.0, 310.0], [250.0, 450.0], [420.0, 120.0]] {
        let mut session = session(Vec::new(), [800, 600]);
        session.command(Command::Inspector(InspectorCommand::SetMagnification(24)));
        right_click(&mut session, [200.0, 300.0]);
        session.pointer(Some(DVec2::from(at)));
        if session.viewer.pixels().over_inset() {
            continue;
        }
        for notch in 0..8 {
            let before = session.viewer.both().view_numbers().expect("a view").scale;
            session.wheel(1.0);
            session.settle();
            let after = session.viewer.both().view_numbers().expect("a view").scale;
            assert!(after > 1.2 * before, "notch {notch} at {at:?}: {after} from {before}");
            assert!(
                !session.viewer.pixels().over_inset(),
                "notch {notch} at {at:?}: the magnifier came"
            );
        }
    }
}

#[test]
fn magnifier_leaves_the_ring_of_its_pin_free() {
    for window in [[800, 600], [1280, 800], [1366, 768], [1920, 1080]] {
        for magnification in [20, 28, 48, 96] {
            for [x, y] in [[0.2, 0.5], [0.4, 0.66], [0.3, 0.3], [0.15, 0.65]] {
                let mut session = session(Vec::new(), window);
                session.command(Command::Inspector(InspectorCommand::SetMagnification(magnification)));
                right_click(&mut session, [x * f64::from(window[0]), y * f64::from(window[1])]);
                let inset = session.viewer.inspector().inset().expect("a magnifier").rect;
                for ring in session.interface.rings(&session.viewer) {
                    let inset = Rect::from_min_size(
                        pos2(inset.x as f32, inset.y as f32),
                        vec2(inset.width as f32, inset.height as f32),
                    );
                    assert!(
                        !ring.intersects(inset),
                        "{ring:?} under {inset:?} in {window:?} at {magnification}"
                    );
                }
            }
        }
    }
}

#[test]
fn defaults_and_a_cleared_board_are_undone_by_their_messages() {
    let mut session = session(Vec::new(), [1600, 1000]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    for (option, value) in [("sample-rate", "16"), ("pattern", "jittered")] {
        session.command(Command::set(option, value).expect("a value"));
    }
    session.settle();
    let before = *session.viewer.settings();
    click_on(&mut session, "Default settings");
    assert_ne!(*session.viewer.settings(), before, "the defaults");
    click_on(&mut session, "Undo");
    assert_eq!(*session.viewer.settings(), before, "back");
    assert!(session.viewer.chrome().messages().is_empty(), "nothing more to undo");
    let axis = Axis::of("sample-rate", "1,4,16").expect("an axis");
    session.command(Command::Board(BoardCommand::Vary(axis)));
    session.settle();
    click_on(&mut session, "Clear the board");
    assert!(session.viewer.board().tiles().is_empty(), "cleared");
    click_on(&mut session, "Undo");
    assert_eq!(session.viewer.board().tiles().len(), 3, "back");
}
