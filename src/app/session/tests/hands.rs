//! What a hand does to the panels, and what an eye finds there: controls are looked up by the names that screen readers
//! are told, so that no test knows where they lie.

use std::path::PathBuf;

use egui::accesskit::Node;
use glam::{DVec2, dvec2};

use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{
    AbCommand, Against, Dialog, InspectorCommand, KeyPress, Toggle, ViewCommand, ViewerOptions, WindowCommand,
};

/// A session at rest on these files, or on the gallery.
pub(super) fn session(paths: Vec<PathBuf>, window: [u32; 2]) -> Session {
    let options = ViewerOptions {
        paths,
        window,
        ..ViewerOptions::default()
    };
    let viewer = Viewer::new(options).expect("threads");
    let mut session = Session::new(viewer, 1.0, Clock::Simulated(0.0));
    session.ctx().enable_accesskit();
    session.settle();
    session
}

/// A session with the side panel open, and with a comparison.
pub(super) fn comparing(window: [u32; 2]) -> Session {
    let mut session = session(Vec::new(), window);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.command(Command::Ab(AbCommand::Compare(Against::Settings)));
    session.command(Command::set("sample-rate", "4").expect("a value"));
    session.wait(Duration::from_secs(10));
    session.settle();
    session
}

/// Everything that a screen reader is told of.
pub(super) fn nodes(session: &mut Session) -> Vec<Node> {
    let update = session.quiet_turn().platform.accesskit_update;
    let nodes = update.expect("screen readers are served").nodes;
    nodes.into_iter().map(|(_, node)| node).collect()
}

/// The middle of the control with this name.
pub(super) fn place_of(session: &mut Session, name: &str) -> DVec2 {
    let nodes = nodes(session);
    let node = nodes.iter().find(|node| node.label() == Some(name));
    let bounds = node.and_then(Node::bounds).unwrap_or_else(|| {
        let names: Vec<&str> = nodes.iter().filter_map(Node::label).collect();
        panic!("no {name} among {names:?}")
    });
    dvec2(bounds.x0 + bounds.x1, bounds.y0 + bounds.y1) / 2.0
}

pub(super) fn click(session: &mut Session, at: DVec2) {
    session.pointer(Some(at));
    for down in [true, false] {
        session.button(PointerButton::Primary, down);
    }
}

pub(super) fn right_click(session: &mut Session, at: [f64; 2]) {
    session.pointer(Some(DVec2::from(at)));
    for down in [true, false] {
        session.button(PointerButton::Secondary, down);
    }
    session.settle();
}

pub(super) fn click_on(session: &mut Session, name: &str) {
    let at = place_of(session, name);
    click(session, at);
    session.settle();
}

pub(super) fn key(session: &mut Session, name: &str) {
    session.key(KeyPress::from_name(name).expect("a key"));
}

/// Whether this text is to be seen.
pub(super) fn says(session: &mut Session, text: &str) -> bool {
    let holds = |node: &Node| node.value().is_some_and(|value| value.contains(text));
    nodes(session).iter().any(holds)
}

/// The fields of numbers, with an own number in each.
const NUMBERS: [&str; 6] = [
    "Centre x",
    "Scale in pixels per unit",
    "Rotation in degrees, clockwise",
    "Level of detail bias",
    "Fixed level",
    "Gain",
];

/// A session in which all these fields are to be seen.
fn with_numbers() -> Session {
    let mut session = session(Vec::new(), [1600, 1300]);
    for command in [
        Command::Window(WindowCommand::Panel(Toggle::On)),
        Command::Ab(AbCommand::Swap),
        Command::Ab(AbCommand::SetMeasure(crate::compare::Measure::Signed)),
    ] {
        session.command(command);
    }
    session.settle();
    session
}

/// All that these fields set.
fn numbers(session: &Session) -> impl PartialEq + std::fmt::Debug + use<> {
    let viewer = session.viewer();
    let render = viewer.settings().render;
    (
        viewer.both().view_numbers(),
        render.detail,
        viewer.ab().difference_gain(),
    )
}

fn type_number(session: &mut Session, name: &str, text: &str, end: &str) {
    let at = place_of(session, name);
    click(session, at);
    key(session, "Ctrl+A");
    session.type_text(text);
    key(session, end);
    session.settle();
}

#[test]
fn number_fields_keep_the_old_number_on_escape() {
    let mut session = with_numbers();
    for name in NUMBERS {
        let before = numbers(&session);
        for (end, is_taken) in [("Escape", false), ("Enter", true)] {
            type_number(&mut session, name, "3", end);
            assert_eq!(numbers(&session) != before, is_taken, "{name} after {end}");
        }
    }
}

#[test]
fn number_fields_take_finite_numbers_alone() {
    let mut session = with_numbers();
    for name in NUMBERS {
        let before = numbers(&session);
        for text in ["nan", "-nan", "inf", "-inf", "1e999"] {
            type_number(&mut session, name, text, "Enter");
            assert_eq!(numbers(&session), before, "{text} as {name}");
        }
    }
}

#[test]
fn number_fields_of_the_view_say_what_is_possible() {
    let scale = "the scale of the view: from";
    let mut session = with_numbers();
    for (name, text, words) in [
        ("Scale in pixels per unit", "abc", Some(scale)),
        ("Scale in pixels per unit", "0", Some(scale)),
        ("Scale in pixels per unit", "1e99", Some(scale)),
        ("Scale in pixels per unit", "2.5", None),
        ("Centre x", "1e15", Some("the centre of the view: at this scale up to")),
        ("Centre x", " ", Some("the centre of the view")),
        ("Centre x", "20", None),
        (
            "Rotation in degrees, clockwise",
            "north",
            Some("the rotation of the view"),
        ),
    ] {
        session.command(Command::View(ViewCommand::Reset));
        session.wait(Duration::from_secs(30));
        session.settle();
        type_number(&mut session, name, text, "Enter");
        let messages = session.viewer().chrome().messages();
        let told = messages.iter().any(|message| message.text.starts_with("the "));
        assert_eq!(told, words.is_some(), "{text} as {name}: {messages:?}");
        if let Some(words) = words {
            assert!(says(&mut session, words), "{text} as {name}");
        }
    }
}

#[test]
fn lines_of_a_sheet_keep_the_old_text_on_escape() {
    let mut session = session(Vec::new(), [1000, 800]);
    session.command(Command::Window(WindowCommand::ToggleDialog(Dialog::Sheet)));
    session.settle();
    let sheet = |session: &Session| format!("{:?}", session.viewer().sheet().draft());
    for name in ["Values of the columns", "Caption"] {
        let before = sheet(&session);
        for (end, is_taken) in [("Escape", false), ("Tab", true)] {
            let at = place_of(&mut session, name);
            click(&mut session, at);
            key(&mut session, "Ctrl+A");
            session.type_text("9");
            key(&mut session, end);
            session.settle();
            assert_eq!(sheet(&session) != before, is_taken, "{name} after {end}");
        }
    }
}

#[test]
fn sheet_with_a_wrong_value_is_not_saved() {
    let mut session = session(Vec::new(), [1000, 800]);
    session.command(Command::Window(WindowCommand::ToggleDialog(Dialog::Sheet)));
    session.settle();
    let disabled = |session: &mut Session| {
        session.settle();
        let nodes = nodes(session);
        ["Save", "Copy command line", "Close"].map(|name| {
            let node = nodes.iter().find(|node| node.label() == Some(name));
            node.map(Node::is_disabled)
        })
    };
    assert_eq!(disabled(&mut session), [Some(false); 3], "nothing is wrong yet");
    let at = place_of(&mut session, "Values of the columns");
    click(&mut session, at);
    key(&mut session, "Ctrl+A");
    session.type_text("1,4,abc");
    assert_eq!(
        disabled(&mut session),
        [Some(true), Some(true), Some(false)],
        "it would not be what the field says"
    );
    key(&mut session, "Ctrl+A");
    session.type_text("1,4");
    assert_eq!(disabled(&mut session), [Some(false); 3], "mended");
}

#[test]
fn explained_pixel_leaves_the_numbers_of_a_comparison() {
    for window in [[1280, 800], [1366, 768], [1920, 1080]] {
        let mut session = session(Vec::new(), window);
        session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
        session.command(Command::Ab(AbCommand::Swap));
        session.command(Command::set("sample-rate", "16").expect("a value"));
        session.settle();
        let mut told = |what| {
            let nodes = nodes(&mut session);
            let rmse = nodes.iter().filter(|node| node.value() == Some("RMSE"));
            assert_eq!(rmse.count(), 1, "the numbers once, {what} at {window:?}");
            session.command(Command::Inspector(InspectorCommand::Pin([500, 300])));
            session.settle();
        };
        told("beside the picture alone");
        told("beside a pixel that is explained");
    }
}

#[test]
fn palette_grows_again_after_a_filter() {
    let filtered = |texts: &[&str]| {
        let mut session = session(Vec::new(), [1000, 700]);
        key(&mut session, "Ctrl+Shift+P");
        for text in texts {
            key(&mut session, "Ctrl+A");
            session.type_text(text);
            session.settle();
        }
        session.picture()
    };
    assert!(
        filtered(&["compare", "a"]) == filtered(&["a"]),
        "a short list before leaves no trace"
    );
}

#[test]
fn pin_is_ringed_in_the_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    for (ground, name) in [
        ("#000000", "dark.svg"),
        ("#ffffff", "light.svg"),
        ("#ff3b30", "red.svg"),
    ] {
        let document = format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100"><rect width="100" height="100" fill="{ground}"/></svg>"#
        );
        let path = folder.path().join(name);
        std::fs::write(&path, document).expect("a file");
        let mut session = session(vec![path], [600, 400]);
        session.command(Command::Inspector(InspectorCommand::Explanation(Toggle::Off)));
        let pin = [300_i64, 200];
        session.command(Command::Inspector(InspectorCommand::Pin(pin)));
        session.settle();
        let (shown, plain) = (session.picture(), session.viewer().window().picture());
        // How much a pixel of the window differs from the picture, in levels.
        let differs = |x: i64, y: i64| {
            let at = |frame: &Framebuffer| {
                let place = (u32::try_from(pin[0] + x), u32::try_from(pin[1] + y));
                let (Ok(x), Ok(y)) = place else { panic!("inside") };
                frame.rgba(x, y).expect("inside")
            };
            let (a, b) = (at(&shown), at(&plain));
            a.into_iter().zip(b).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
        };
        let around = |radius: i64| {
            let square = (-radius..=radius).flat_map(move |y| (-radius..=radius).map(move |x| (x, y)));
            square.filter(|(x, y)| differs(*x, *y) > 60).count()
        };
        assert_eq!(around(4), 0, "the pixel and its neighbours as they are, on {ground}");
        assert!(around(12) > 40, "{} pixels of a ring on {ground}", around(12));
        session.command(Command::Inspector(InspectorCommand::Unpin));
        session.command(Command::Inspector(InspectorCommand::Show(Toggle::Off)));
        session.settle();
        assert!(
            session.picture().rgba(300, 191) == session.viewer().window().picture().rgba(300, 191),
            "no pin, no ring"
        );
    }
}
