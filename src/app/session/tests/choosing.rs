//! Lists, menus and dialogs under a quick or careless hand.

use std::path::{Path, PathBuf};

use egui::accesskit::{Node, Toggled};
use glam::dvec2;

use super::hands::{click, click_on, key, nodes, place_of, says, session};
use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{Dialog, ExportCommand, LessonCommand, LessonSource, Other, Theme, Toggle, ViewerOptions};

/// Two clicks at one place, as fast as a hand makes them.
fn double_click(session: &mut Session, name: &str) {
    let at = place_of(session, name);
    click(session, at);
    click(session, at);
    session.settle();
}

/// Whether there is a control of this name.
fn has(session: &mut Session, name: &str) -> bool {
    nodes(session).iter().any(|node| node.label() == Some(name))
}

fn open_dialog(session: &mut Session, dialog: Dialog) {
    session.command(Command::Window(WindowCommand::ToggleDialog(dialog)));
    session.settle();
}

/// Folders one in the other, the inner ones with a file at the place of the outer one's line.
fn folders() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let inner = folder.path().join("outer/inner");
    std::fs::create_dir_all(&inner).expect("folders");
    let scene = "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'/>";
    for place in [&folder.path().join("outer.svg"), &inner.join("first.svg")] {
        std::fs::write(place, scene).expect("a file");
    }
    folder
}

#[test]
fn double_click_on_a_folder_opens_the_folder_alone() {
    let folder = folders();
    for window in [[800, 600], [1280, 800]] {
        let mut session = session(vec![folder.path().join("outer.svg")], window);
        open_dialog(&mut session, Dialog::Open);
        double_click(&mut session, "outer");
        assert_eq!(
            session.viewer().chrome().dialog(),
            Some(Dialog::Open),
            "nothing is opened"
        );
        let lists = ["inner", "first.svg"].map(|name| has(&mut session, name));
        assert_eq!(lists, [true, false], "one folder further in {window:?}");
    }
}

#[test]
fn double_click_on_what_opens_a_dialog_leaves_it_open() {
    let mut session = session(Vec::new(), [1280, 800]);
    click_on(&mut session, "Menu");
    double_click(&mut session, "Help");
    assert_eq!(session.viewer().chrome().dialog(), Some(Dialog::Help), "the help");
}

#[test]
fn picture_to_compare_with_is_chosen_by_mouse() {
    let folder = folders();
    let picture = folder.path().join("other.png");
    let mut session = session(vec![folder.path().join("outer.svg")], [800, 600]);
    let frame = session.viewer().frames().frame().expect("a frame").pixels.clone();
    crate::figure::save_png(&frame, &picture).expect("saved");
    open_dialog(&mut session, Dialog::ComparePicture);
    assert!(!has(&mut session, "outer.svg"), "no scenes");
    click_on(&mut session, "other.png");
    let viewer = session.viewer();
    assert_eq!(viewer.chrome().dialog(), None, "chosen");
    assert!(
        matches!(viewer.ab().other(), Some(Other::Picture(_))),
        "{:?}",
        viewer.ab().other()
    );
}

#[test]
fn picture_to_compare_with_is_chosen_by_keys() {
    let folder = folders();
    let mut session = session(vec![folder.path().join("outer.svg")], [800, 600]);
    let frame = session.viewer().frames().frame().expect("a frame").pixels.clone();
    for name in ["one.png", "two.png"] {
        crate::figure::save_png(&frame, &folder.path().join(name)).expect("saved");
    }
    open_dialog(&mut session, Dialog::ComparePicture);
    // Folders come first.
    for name in ["Down", "Down", "Down", "Enter"] {
        key(&mut session, name);
        session.settle();
    }
    let viewer = session.viewer();
    assert_eq!(viewer.chrome().dialog(), None, "chosen");
    let name = match viewer.ab().other() {
        Some(Other::Picture(picture)) => format!("{picture:?}").contains("two.png"),
        other => panic!("{other:?}"),
    };
    assert!(name, "the second picture below the folder");
}

#[test]
fn click_between_lines_of_the_menu_closes_nothing() {
    let mut session = session(Vec::new(), [800, 600]);
    click_on(&mut session, "Menu");
    let [help, palette] = ["Help", "Command palette"].map(|name| place_of(&mut session, name));
    click(&mut session, dvec2(help.x, f64::midpoint(help.y, palette.y)));
    session.settle();
    assert!(has(&mut session, "Command palette"), "still there");
    click_on(&mut session, "Help");
    assert_eq!(
        session.viewer().chrome().dialog(),
        Some(Dialog::Help),
        "a line closes it"
    );
    assert!(!has(&mut session, "Command palette"), "the menu is gone");
}

#[test]
fn start_card_goes_when_the_menu_opens() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::Window(WindowCommand::StartCard(Toggle::On)));
    session.settle();
    click_on(&mut session, "Menu");
    assert!(!session.viewer().chrome().start_card(), "any click closes it");
    assert!(has(&mut session, "Command palette"), "and the menu is open");
}

#[test]
fn picture_alone_says_how_the_panels_come_back() {
    let mut session = session(Vec::new(), [800, 600]);
    session.command(Command::Window(WindowCommand::HideEverything(Toggle::On)));
    session.settle();
    assert!(says(&mut session, "brings the panels back"), "one line");
    session.command(Command::Window(WindowCommand::HideEverything(Toggle::Off)));
    session.settle();
    assert!(!says(&mut session, "brings the panels back"), "they are back");
}

#[test]
fn lesson_leaves_room_for_the_picture_in_small_windows() {
    let mut session = session(Vec::new(), [800, 600]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    let lesson = LessonSource::from_address(Path::new("lesson:anisotropy")).expect("a lesson");
    session.command(Command::Lesson(LessonCommand::Open(lesson)));
    session.settle();
    assert!(!session.viewer().chrome().panel(), "the panel makes way");
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    assert!(session.viewer().chrome().panel(), "asked for, it comes");
}

#[test]
fn steps_of_a_lesson_are_a_list_to_choose_from() {
    let mut session = session(vec![PathBuf::from("lesson:six-tasks")], [800, 600]);
    click_on(&mut session, "step 1 of 10");
    let title = {
        let (lesson, _) = session.viewer().lesson().expect("a lesson");
        format!("5. {}", lesson.steps[4].title)
    };
    click_on(&mut session, &title);
    assert_eq!(session.viewer().lesson().map(|(_, at)| at), Some(4), "the fifth");
    assert!(has(&mut session, "step 5 of 10"), "as the button says");
}

#[test]
fn message_of_a_saved_picture_opens_its_folder() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for window in comparing::WINDOWS {
        let options = ViewerOptions {
            window,
            screenshot_dir: Some(folder.path().to_owned()),
            ..ViewerOptions::default()
        };
        let viewer = Viewer::new(options).expect("threads");
        let mut session = Session::new(viewer, 1.0, Clock::Simulated(0.0));
        session.ctx().enable_accesskit();
        session.settle();
        for _ in 0..2 {
            session.command(Command::Export(ExportCommand::Screenshot));
            session.settle();
        }
        let offers = nodes(&mut session);
        let offers = offers.iter().filter(|node| node.label() == Some("Open folder"));
        assert_eq!(offers.count(), 1, "the last message offers it in {window:?}");
        click_on(&mut session, "Open folder");
        assert_eq!(session.take_folder().as_deref(), Some(folder.path()), "{window:?}");
        assert_eq!(session.take_folder(), None, "once");
    }
}

#[test]
fn page_of_all_scenes_finds_one_by_its_name_or_by_a_click() {
    for window in [[800, 600], [1280, 800], [1920, 1080]] {
        let mut session = session(Vec::new(), window);
        key(&mut session, "g");
        session.settle();
        assert_eq!(
            session.viewer.chrome().dialog(),
            Some(Dialog::Scenes),
            "open in {window:?}"
        );
        session.type_text("zone pl");
        session.settle();
        let shown = nodes(&mut session);
        let shown = shown.iter().filter_map(|node| node.label());
        assert!(
            shown.into_iter().any(|name| name == "Scene study/01_zone_plate.svg"),
            "found"
        );
        key(&mut session, "Enter");
        session.settle();
        let label = |session: &Session| session.viewer.scene_list().current().map(|entry| entry.label.clone());
        assert_eq!(
            label(&session).as_deref(),
            Some("study/01_zone_plate.svg"),
            "{window:?}"
        );
        assert_eq!(session.viewer.chrome().dialog(), None, "and closed");
        key(&mut session, "g");
        session.settle();
        session.type_text("transforms");
        session.settle();
        key(&mut session, "Right");
        key(&mut session, "Enter");
        session.settle();
        let second = session.viewer.scene_list().scenes();
        let second = second
            .iter()
            .filter(|entry| entry.label.starts_with("transforms/"))
            .nth(1);
        assert_eq!(
            label(&session),
            second.map(|entry| entry.label.clone()),
            "the second of them"
        );
        key(&mut session, "g");
        session.settle();
        session.type_text("edge_fan");
        session.settle();
        let found = nodes(&mut session).into_iter();
        let found = found.filter(|node| node.label() == Some("Scene study/03_edge_fan.svg"));
        let place = found
            .filter_map(|node| node.bounds())
            .max_by(|a, b| a.width().total_cmp(&b.width()));
        let place = place.expect("its picture");
        assert!(place.width() > 130.0, "a large one: {place:?}");
        click(&mut session, dvec2(place.x0 + place.x1, place.y0 + place.y1) / 2.0);
        session.settle();
        assert_eq!(label(&session).as_deref(), Some("study/03_edge_fan.svg"), "by a click");
        key(&mut session, "g");
        session.settle();
        key(&mut session, "Escape");
        assert_eq!(session.viewer.chrome().dialog(), None, "Esc closes it");
    }
}

#[test]
fn page_of_all_scenes_begins_with_what_was_found() {
    let mut session = session(Vec::new(), [800, 600]);
    key(&mut session, "g");
    session.settle();
    session.pointer(Some(dvec2(400.0, 350.0)));
    for _ in 0..15 {
        session.wheel(-1.0);
        session.quiet_turn();
    }
    session.settle();
    session.type_text("map");
    session.settle();
    let page = egui::Id::unique("all scenes");
    let page = session.ctx().memory(|memory| memory.area_rect(page)).expect("the page");
    let place = place_of(&mut session, "Scene vector/02_city_map.svg");
    let below = place.y - f64::from(page.top());
    assert!(
        (100.0..200.0).contains(&below),
        "the first that was found is whole: {below} points below the page's upper edge"
    );
}

#[test]
fn pattern_by_itself_follows_the_keys_and_closes() {
    for window in [[500, 600], [800, 600], [1280, 800], [1920, 1080]] {
        let mut session = session(Vec::new(), window);
        session.command(Command::set("sample-rate", "16").expect("a value"));
        session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
        session.settle();
        // Its name is that of the command, as in the menu.
        if window[0] >= 800 {
            click_on(&mut session, "Sample pattern by itself");
        } else {
            open_dialog(&mut session, Dialog::Pattern);
        }
        assert_eq!(
            session.viewer().chrome().dialog(),
            Some(Dialog::Pattern),
            "open in {window:?}"
        );
        assert!(
            has(&mut session, "16 points in 4 columns and 4 rows"),
            "the grid in {window:?}"
        );
        assert!(says(&mut session, "0.2344"), "its discrepancy in {window:?}");
        key(&mut session, "a");
        session.settle();
        assert!(
            has(&mut session, "16 points in 16 columns and 16 rows"),
            "the next pattern, in {window:?}"
        );
        assert!(has(&mut session, "Power spectrum"), "it has a name in {window:?}");
        assert!(
            has(&mut session, "Spectrum of: 8 \u{d7} 8 pixels"),
            "of neighbours, too, in {window:?}"
        );
        key(&mut session, "Escape");
        session.settle();
        assert_eq!(session.viewer().chrome().dialog(), None, "closed in {window:?}");
    }
}

#[test]
fn scene_that_arrows_choose_is_to_be_seen() {
    for theme in [Theme::Dark, Theme::Light] {
        let mut session = session(Vec::new(), [1280, 800]);
        session.command(Command::Window(WindowCommand::SetTheme(theme)));
        key(&mut session, "g");
        session.settle();
        let before = session.picture();
        key(&mut session, "Right");
        session.settle();
        let after = session.picture();
        let distance = |(a, b): (&u32, &u32)| {
            let channels = a.to_be_bytes().into_iter().zip(b.to_be_bytes());
            channels.map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
        };
        let pixels = before.pixels().iter().zip(after.pixels());
        let changed = pixels.filter(|pair| distance(*pair) > 60).count();
        // Both rings are about as long as four widths of a picture, and the one that was there goes.
        assert!(changed > 1500, "{theme:?}: {changed} pixels");
    }
}

#[test]
fn line_that_is_chosen_is_what_enter_opens() {
    let [there, typed] = [(); 2].map(|()| tempfile::tempdir().expect("a folder"));
    let scene = "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'/>";
    for (folder, names) in [(&there, &["here.svg"][..]), (&typed, &["one.svg", "two.svg"])] {
        for name in names {
            std::fs::write(folder.path().join(name), scene).expect("a file");
        }
    }
    let mut session = session(vec![there.path().join("here.svg")], [800, 600]);
    let folder = format!("{}/", typed.path().display());
    let begin = |session: &mut Session, text: &str| {
        open_dialog(session, Dialog::Open);
        key(session, "Ctrl+A");
        session.type_text(text);
        session.settle();
    };
    let chosen = |session: &mut Session| {
        let nodes = nodes(session);
        let is_chosen = |node: &&Node| node.toggled() == Some(Toggled::True);
        let chosen = nodes
            .iter()
            .find(is_chosen)
            .and_then(|node| node.label().map(str::to_owned));
        chosen.filter(|name| Path::new(name).extension().is_some_and(|kind| kind == "svg"))
    };
    let opened = |session: &mut Session| {
        key(session, "Enter");
        session.settle();
        let entry = session.viewer.scene_list().current().expect("a scene");
        (session.viewer.chrome().dialog(), entry.label.clone())
    };
    begin(&mut session, &folder);
    let lists = ["here.svg", "one.svg", "two.svg"].map(|name| has(&mut session, name));
    assert_eq!(lists, [false, true, true], "the folder that was typed");
    assert_eq!(chosen(&mut session), None, "Enter goes there");
    for _ in 0..2 {
        key(&mut session, "Down");
        session.settle();
    }
    assert_eq!(
        chosen(&mut session).as_deref(),
        Some("two.svg"),
        "arrows lead through it"
    );
    assert_eq!(opened(&mut session), (None, "two.svg".to_owned()), "the chosen line");
    begin(&mut session, &format!("{folder}on"));
    assert_eq!(chosen(&mut session).as_deref(), Some("one.svg"), "part of its name");
    assert!(!has(&mut session, "two.svg"), "the others are gone");
    assert_eq!(opened(&mut session), (None, "one.svg".to_owned()), "the first");
    begin(&mut session, &folder);
    assert_eq!(opened(&mut session).0, Some(Dialog::Open), "no line is chosen");
    assert!(has(&mut session, "one.svg"), "so the folder is gone into");
    key(&mut session, "Escape");
    begin(&mut session, &format!("{folder}no such folder/x"));
    assert!(says(&mut session, "nothing here"), "and nothing is listed of another");
}
