//! What a hand does that has nothing but a mouse: what it clicks is explained, and what it opens it can close.

use crate::viewer::{AbCommand, InspectorCommand, SceneCommand, ViewCommand, WindowCommand};
use std::path::PathBuf;

use glam::{DVec2, dvec2};

use super::hands::{click, nodes, place_of, session};
use super::small_windows::{click_on, comparing, right_click, says};
use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{Against, Arrangement, Toggle};

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
    let button = place_of(&mut session, "Close the inspector");
    assert!(
        button.x < inset.x as f64 || button.x > inset.right() as f64,
        "{button} covers no pixel of {inset:?}"
    );
    click_on(&mut session, "Close the inspector");
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

/// A folder of scenes: one that is read in two ways, one that is plain, one with notes, one that cannot be read.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let shape = r##"<polygon fill="#1f6feb" points="5,5 45,9 20,45"/>"##;
    let circle = r#"<circle cx="35" cy="35" r="9"/>"#;
    let boxed = r#" viewBox="0 0 50 50""#;
    for (name, attributes, body) in [
        ("1.svg", "", shape.to_owned()),
        ("2.svg", boxed, format!("{shape}{circle}")),
        ("3.svg", "", format!("{shape}<blink/>")),
        ("4.svg", "", "<polygon".to_owned()),
        ("5.svg", "", shape.to_owned()),
    ] {
        let document =
            format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100"{attributes}>{body}</svg>"#);
        std::fs::write(folder.path().join(name), document).expect("a file");
    }
    folder
}

#[test]
fn arrows_of_the_scenes_stay_under_the_pointer() {
    let folder = folder();
    for window in [[1366, 768], [1600, 1300]] {
        let mut session = session(vec![folder.path().to_owned()], window);
        session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
        session.settle();
        let before = place_of(&mut session, "Next scene");
        let mut noted = 0;
        for _ in 0..session.viewer.scene_list().scenes().len() {
            session.command(Command::Scenes(SceneCommand::Next));
            session.settle();
            noted += usize::from(
                session
                    .viewer
                    .scene_list()
                    .reading_note(session.viewer.settings().dialect)
                    .is_some(),
            );
            let scene = session.viewer.scene_list().current_index();
            let now = place_of(&mut session, "Next scene");
            assert!((now - before).length() < 1.0, "{now}, not {before}, at scene {scene}");
        }
        assert!(noted > 0, "some scene has two readings");
    }
}

#[test]
fn scene_without_a_picture_says_so() {
    let folder = folder();
    let mut session = session(vec![folder.path().join("4.svg")], [1280, 800]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    right_click(&mut session, [500.0, 300.0]);
    assert!(!session.viewer.pixels().explains(), "there is nothing to explain");
    assert!(says(&mut session, "no picture to explain"), "and it says why");
    assert!(!says(&mut session, "finding out"), "nothing is found out");
    session.command(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    session.settle();
    assert!(says(&mut session, "no picture to measure"), "nor measured");
    assert!(!says(&mut session, "measuring"), "ever");
}

#[test]
fn missing_room_for_an_explanation_is_told() {
    let mut session = session(Vec::new(), [600, 400]);
    right_click(&mut session, [300.0, 200.0]);
    assert!(session.viewer.pixels().pinned().is_some(), "pinned");
    assert!(says(&mut session, "make the window wider"), "why there is no more");
    session.resize([1280, 800]);
    session.settle();
    assert!(
        session.viewer.inspector().explanation().is_some(),
        "explained where there is room"
    );
}

#[test]
fn scene_change_leaves_a_scrolled_panel_where_it_is() {
    let folder = folder();
    let paths = ["2.svg", "1.svg"].map(|name| folder.path().join(name)).to_vec();
    for window in [[800, 600], [1280, 800], [1366, 768], [1600, 1300]] {
        let mut session = session(paths.clone(), window);
        session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
        session.pointer(Some(dvec2(f64::from(window[0]) - 100.0, 300.0)));
        for _ in 0..40 {
            session.wheel(-3.0);
        }
        session.settle();
        let names = ["Next scene", "Scene 1.svg", "Scene 2.svg"];
        let places = |session: &mut Session| names.map(|name| place_of(session, name));
        let before = places(&mut session);
        assert!(
            before[0].y > 0.0 && before[0].y < f64::from(window[1]),
            "{before:?} in {window:?}"
        );
        for name in ["Next scene", "Next scene", "Scene 1.svg", "Scene 2.svg"] {
            let at = place_of(&mut session, name);
            click(&mut session, at);
            for what in ["at once", "at the next turn"] {
                assert_eq!(places(&mut session), before, "{name}, {what}, in {window:?}");
            }
            session.settle();
            assert_eq!(places(&mut session), before, "{name} in {window:?}");
        }
    }
}

#[test]
fn other_reading_moves_nothing_and_draws_its_folder_anew() {
    let folder = folder();
    let boxed = std::fs::read_to_string(folder.path().join("2.svg")).expect("a file");
    std::fs::write(folder.path().join("6.svg"), boxed).expect("a file");
    let paths = ["2.svg", "6.svg"].map(|name| folder.path().join(name)).to_vec();
    let mut session = session(paths, [1600, 1300]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    let pictures = |session: &Session| {
        let scenes = session.viewer.scene_list().scenes().iter();
        scenes
            .map(|entry| entry.thumbnail.clone().expect("in sight"))
            .collect::<Vec<_>>()
    };
    let names = ["Read in the other dialect", "Scene 2.svg"];
    let before = names.map(|name| place_of(&mut session, name));
    let drawn = pictures(&session);
    click_on(&mut session, names[0]);
    assert_eq!(
        names.map(|name| place_of(&mut session, name)),
        before,
        "after its first use"
    );
    for (old, new) in drawn.iter().zip(pictures(&session)) {
        assert!(**old != *new, "drawn as it is read now");
    }
}

#[test]
fn thumbnails_stay_where_they_are_when_another_scene_has_two_readings() {
    let folder = folder();
    let plain = folder.path().join("1.svg");
    let boxed = folder.path().join("7.svg");
    let document = std::fs::read_to_string(&plain).expect("a file");
    std::fs::write(&boxed, document.replace("width=", r#"viewBox="0 0 50 50" width="#)).expect("a file");
    let mut session = session(vec![plain, boxed], [1600, 1300]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    let names = ["Scene 1.svg", "Scene 7.svg"];
    let before = names.map(|name| place_of(&mut session, name));
    click_on(&mut session, names[1]);
    session.settle();
    assert!(
        session
            .viewer
            .scene_list()
            .reading_note(session.viewer.settings().dialect)
            .is_some(),
        "it has two"
    );
    assert_eq!(
        names.map(|name| place_of(&mut session, name)),
        before,
        "under the pointer"
    );
}

#[test]
fn thumbnails_stay_where_they_are_for_a_longer_report() {
    let folder = folder();
    let plain = folder.path().join("1.svg");
    let document = std::fs::read_to_string(&plain).expect("a file");
    for (name, notes) in [("6.svg", 2), ("7.svg", 30)] {
        let notes = "<blink/><marquee/>".repeat(notes);
        let noted = document.replace("</svg>", &format!("{notes}</svg>"));
        std::fs::write(folder.path().join(name), noted).expect("a file");
    }
    let paths = ["1.svg", "6.svg", "7.svg", "4.svg"].map(|name| folder.path().join(name));
    let names = ["Scene 1.svg", "Scene 6.svg", "Scene 7.svg"];
    for window in [[1366, 768], [1600, 1300], [1920, 1600]] {
        let mut session = session(paths.to_vec(), window);
        session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
        session.pointer(Some(dvec2(f64::from(window[0]) - 100.0, 300.0)));
        for _ in 0..40 {
            session.wheel(-3.0);
        }
        session.settle();
        let places = |session: &mut Session| names.map(|name| place_of(session, name));
        let before = places(&mut session);
        for scene in 1..paths.len() {
            session.command(Command::Scenes(SceneCommand::Show(scene)));
            session.settle();
            assert_eq!(places(&mut session), before, "with scene {scene} in {window:?}");
        }
    }
}

#[test]
fn list_of_scenes_ends_below_a_row() {
    for height in [1000, 1040, 1080, 1111, 1200] {
        let mut session = session(Vec::new(), [1600, height]);
        session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
        session.settle();
        let status = f64::from(height) - 30.0;
        let list = nodes(&mut session);
        let scenes = list
            .iter()
            .filter(|node| node.label().is_some_and(|name| name.starts_with("Scene ")));
        let bounds = scenes.filter_map(egui::accesskit::Node::bounds);
        let cut = bounds.filter(|bounds| bounds.y0 < status && bounds.y1 > status);
        assert_eq!(cut.count(), 0, "a row is cut in a window {height} high");
    }
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
fn drag_that_begins_in_the_magnifier_moves_the_picture() {
    let mut session = session(Vec::new(), [1366, 768]);
    right_click(&mut session, [570.0, 300.0]);
    let inset = session.viewer.inspector().inset().expect("a magnifier").rect;
    let middle = |from: i64, size: u32| from as f64 + f64::from(size) / 2.0;
    let at = dvec2(middle(inset.x, inset.width), middle(inset.y, inset.height));
    session.pointer(Some(at));
    assert!(session.viewer.pixels().over_inset(), "the pointer is in the magnifier");
    let before = session.viewer.both().view_numbers().expect("a view").center;
    session.button(PointerButton::Primary, true);
    session.pointer(Some(at + dvec2(40.0, 0.0)));
    session.button(PointerButton::Primary, false);
    let after = session.viewer.both().view_numbers().expect("a view").center;
    assert!(
        after.x < before.x,
        "{after} from {before}: the picture follows the hand"
    );
}

#[test]
fn arrows_that_lead_nowhere_are_grey() {
    let folder = tempfile::tempdir().expect("a folder");
    let document = r#"<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>"#;
    for name in ["a.svg", "b.svg"] {
        std::fs::write(folder.path().join(name), document).expect("a file");
    }
    for count in [1, 2] {
        let files = ["a.svg", "b.svg"].map(|name| folder.path().join(name));
        let mut session = session(files[..count].to_vec(), [1600, 1300]);
        session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
        session.settle();
        for name in ["Next scene", "Previous scene"] {
            let nodes = nodes(&mut session);
            let arrow = nodes.iter().find(|node| node.label() == Some(name)).expect("an arrow");
            assert_eq!(arrow.is_disabled(), count == 1, "{name} of {count}");
        }
    }
}
