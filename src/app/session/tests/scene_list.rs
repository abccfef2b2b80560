//! The list of scenes under a hand: nothing moves under the pointer, whatever the next scene has to say.

use glam::{DVec2, dvec2};

use super::hands::{click, click_on, nodes, place_of, right_click, says, session};
use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{AbCommand, Against, LessonCommand, LessonSource, SceneCommand, Toggle, WindowCommand};

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
fn messages_about_a_scene_go_with_it() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let paths = ["3.svg", "1.svg", "4.svg", "5.svg"].map(path);
    let mut session = session(paths.to_vec(), [1280, 800]);
    let told = |session: &Session, words: &str| {
        let messages = session.viewer.chrome().messages();
        messages.iter().any(|message| message.text.contains(words))
    };
    session.settle();
    assert!(told(&session, NOT_ALL), "of the scene with a note");
    session.command(Command::Scenes(SceneCommand::Next));
    session.settle();
    assert!(!told(&session, NOT_ALL), "the next has none");
    session.command(Command::Scenes(SceneCommand::Next));
    session.settle();
    assert!(told(&session, "4.svg:"), "the one that cannot be read");
    session.command(Command::Scenes(SceneCommand::Next));
    session.settle();
    assert!(!told(&session, "4.svg:"), "the one behind it can");
    session.command(Command::Scenes(SceneCommand::Show(0)));
    session.settle();
    assert!(told(&session, NOT_ALL), "told again where it is shown again");
    std::fs::copy(path("1.svg"), path("3.svg")).expect("a file");
    session.command(Command::Scenes(SceneCommand::Reload));
    session.settle();
    assert!(!told(&session, NOT_ALL), "read anew without notes");
}

#[test]
fn scene_without_a_picture_says_so() {
    let folder = folder();
    let point = "point at a pixel";
    let mut other = session(Vec::new(), [1280, 800]);
    assert!(says(&mut other, point), "beside a picture");
    let mut session = session(vec![folder.path().join("4.svg")], [1280, 800]);
    assert!(!says(&mut session, point), "there is none to point at");
    assert!(says(&mut session, "? shows all keys"), "but there are keys");
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

#[test]
fn panel_begins_anew_with_another_list() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    session.pointer(Some(dvec2(1150.0, 500.0)));
    for _ in 0..40 {
        session.wheel(-10.0);
        session.settle();
    }
    let top_of_settings = |session: &mut Session| place_of(session, "Sample pattern").y;
    assert!(top_of_settings(&mut session) < 0.0, "scrolled to the end");
    session.command(Command::Window(WindowCommand::Panel(Toggle::Off)));
    session.settle();
    session.command(Command::Lesson(LessonCommand::Open(LessonSource::BuiltIn(1))));
    session.wait(Duration::from_secs(10));
    session.settle();
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    let seen = place_of(&mut session, "Centre x").y;
    assert!(
        (0.0..800.0).contains(&seen),
        "the panel shows its end, not nothing: {seen}"
    );
}

#[test]
fn clicked_scene_stays_below_the_pointer() {
    // High enough for a row of the list that neither end cuts.
    let mut session = session(Vec::new(), [1920, 1110]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    let shown = |session: &mut Session| -> Vec<(String, DVec2)> {
        let scenes = nodes(session).into_iter().filter_map(|node| {
            let (name, bounds) = (node.label()?.to_owned(), node.bounds()?);
            let is_scene = name.starts_with("Scene ") && name.contains(".svg");
            is_scene.then(|| (name, dvec2(bounds.x0 + bounds.x1, bounds.y0 + bounds.y1) / 2.0))
        });
        scenes.collect()
    };
    let places = shown(&mut session);
    // Rows at the ends of the list are cut.
    let middle = places.iter().map(|(_, at)| *at).sum::<DVec2>() / places.len() as f64;
    for clicks in [-1.0, -2.0, -1.0, -0.5] {
        session.pointer(Some(middle));
        session.wheel(clicks);
        session.settle();
        let places = shown(&mut session);
        let near = |(_, at): &&(String, DVec2)| (at.y - middle.y).abs();
        let nearest = places.iter().min_by(|a, b| near(a).total_cmp(&near(b)));
        let (name, before) = nearest.expect("a scene").clone();
        click(&mut session, before);
        session.settle();
        assert_eq!(place_of(&mut session, &name), before, "{name}");
    }
}
