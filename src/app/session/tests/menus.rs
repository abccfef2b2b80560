//! The menu by mouse: every command is in it, lists stay in the window, and a click beside them presses nothing else.

#![expect(clippy::cast_possible_truncation, reason = "points of a window")]

use egui::accesskit::{Node, Toggled};
use glam::{DVec2, dvec2};

use super::hands::{click, click_on, key, nodes, place_of, says, session};
use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{
    AbCommand, Action, Against, Arrangement, CommandSpec, Dialog, Group, InspectorCommand, Toggle, ViewCommand,
    ViewNumbers, WindowCommand, commands, picture,
};

/// The names of everything that can be pressed.
fn names(session: &mut Session) -> Vec<String> {
    let nodes = nodes(session);
    nodes.iter().filter_map(Node::label).map(str::to_owned).collect()
}

/// Opens the menu and the lists below each other with these names.
fn open(session: &mut Session, lists: &[&str]) {
    click_on(session, "Menu");
    for name in lists {
        click_on(session, name);
    }
}

#[test]
fn menu_has_every_command_in_every_window() {
    for window in [[480, 360], [800, 600], [1280, 800]] {
        let mut session = session(Vec::new(), window);
        for group in Group::ALL {
            open(&mut session, &[group.name()]);
            let [width, height] = window.map(f64::from);
            let mut seen = names(&mut session);
            let lists: Vec<String> = picture::all()
                .map(|setting| capital(setting.label))
                .filter(|name| seen.contains(name))
                .collect();
            for name in &lists {
                if window[1] >= 600 {
                    let at = place_of(&mut session, name);
                    assert!(at.x < width && at.y < height, "{name} at {at} of {window:?}");
                    click_on(&mut session, name);
                    seen.extend(names(&mut session));
                }
            }
            for _ in 0..3 {
                if session.interface.list_is_open() {
                    key(&mut session, "Escape");
                    session.settle();
                }
            }
            assert!(!session.interface.list_is_open(), "Esc closes all lists of {group:?}");
            let missing = commands::all()
                .iter()
                .filter(|spec| spec.group == group)
                .filter(|spec| {
                    let is_setting = matches!(spec.action, Action::Step(..)) || spec.argument.is_some();
                    let is_given = spec.command().is_some() || spec.argument.is_some();
                    let is_shown = window[1] >= 600 || !is_setting;
                    is_given && is_shown && spec.id != "escape" && !seen.iter().any(|name| name == spec.name)
                });
            let missing: Vec<&str> = missing.map(|spec: &CommandSpec| spec.name).collect();
            assert_eq!(missing, [""; 0], "{group:?} in {window:?}");
        }
    }
}

/// As menus write it.
fn capital(label: &str) -> String {
    label[..1].to_uppercase() + &label[1..]
}

#[test]
fn menu_does_what_keys_do() {
    let mut session = session(Vec::new(), [800, 600]);
    open(&mut session, &["Help"]);
    assert_eq!(session.viewer.chrome().dialog(), Some(Dialog::Help), "a command");
    key(&mut session, "Escape");
    open(&mut session, &[Group::Sampling.name(), "Sample rate"]);
    click_on(&mut session, "sample rate: 16");
    assert_eq!(session.viewer.settings().render.sample_rate.samples(), 16, "a value");
    assert!(!session.interface.list_is_open(), "which closes the lists");
    open(&mut session, &[Group::Inspector.name(), "Pin pixel"]);
    assert_eq!(session.viewer.chrome().dialog(), None, "it needs no argument");
    open(&mut session, &[Group::View.name(), "Rotate by"]);
    assert_eq!(
        session.viewer.chrome().dialog(),
        Some(Dialog::Palette),
        "it asks for the angle"
    );
    assert!(says(&mut session, "type DEGREES"), "and says so");
    key(&mut session, "Escape");
    open(&mut session, &[Group::Scenes.name(), "Open"]);
    assert_eq!(
        session.viewer.chrome().dialog(),
        Some(Dialog::Open),
        "it has a dialog of its own"
    );
}

#[test]
fn click_beside_a_list_presses_nothing_else() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::Inspector(InspectorCommand::Show(Toggle::Off)));
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    let before = session.viewer.both().view_numbers();
    let beside: [(&str, DVec2); 2] = [
        ("the panel's switch", place_of(&mut session, "Side panel")),
        ("the picture", dvec2(500.0, 300.0)),
    ];
    for list in ["Menu", "Visualisation"] {
        for (what, at) in beside {
            click_on(&mut session, list);
            assert!(session.interface.list_is_open(), "{list} hangs open");
            click(&mut session, at);
            session.settle();
            assert!(
                !session.interface.list_is_open(),
                "{list} is closed by a click on {what}"
            );
            assert!(session.viewer.chrome().panel(), "and {what} is not pressed");
            assert_eq!(session.viewer.both().view_numbers(), before, "nor moved");
        }
    }
    click(&mut session, beside[0].1);
    session.settle();
    assert!(!session.viewer.chrome().panel(), "the next click counts");
}

#[test]
fn lost_canvas_has_a_way_back() {
    let mut session = session(Vec::new(), [800, 600]);
    let nothing = "Nothing to see here";
    assert!(!says(&mut session, nothing), "at first");
    session.command(Command::View(ViewCommand::PanBy { by: dvec2(5000.0, 0.0) }));
    session.settle();
    assert!(says(&mut session, nothing), "far off");
    click_on(&mut session, "Reset view");
    assert!(!says(&mut session, nothing), "back again");
    assert!(
        session
            .viewer
            .scene_list()
            .canvas_in_sight(&session.viewer.both().layout()),
        "and to be seen"
    );
}

#[test]
fn empty_part_of_a_canvas_has_a_way_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("corner.svg");
    let text = r#"<svg width="100" height="100"><rect width="50" height="100" fill="red"/></svg>"#;
    std::fs::write(&scene, text).expect("a scene");
    let mut session = session(vec![scene], [800, 600]);
    let empty = "every pixel in sight is white";
    assert!(!says(&mut session, empty), "at first");
    let look = |x: f64, session: &mut Session| {
        session.command(Command::View(ViewCommand::Set(ViewNumbers {
            center: dvec2(x, 50.0),
            scale: 400.0,
            rotation: 0.0,
        })));
        session.settle();
    };
    for (x, is_empty) in [(80.0, true), (20.0, false), (50.0, false)] {
        look(x, &mut session);
        assert_eq!(says(&mut session, empty), is_empty, "at {x}");
    }
    look(80.0, &mut session);
    assert!(says(&mut session, empty), "there again");
    click_on(&mut session, "Reset view");
    assert!(!says(&mut session, empty), "back again");
}

#[test]
fn menu_says_what_is_on_and_what_does_nothing() {
    let mut session = session(Vec::new(), [1280, 800]);
    let entry = |lists: &[&str], name: &str, session: &mut Session| {
        open(session, lists);
        let named: Vec<Node> = nodes(session)
            .into_iter()
            .filter(|node| node.label() == Some(name))
            .collect();
        assert!(!named.is_empty(), "{name} is in the menu");
        while session.interface.list_is_open() {
            key(session, "Escape");
            session.settle();
        }
        // A panel may have a button of that name, too.
        let is_on = named.iter().any(|node| node.toggled() == Some(Toggled::True));
        (is_on, named.iter().all(Node::is_disabled))
    };
    let compare = [Group::Compare.name()];
    assert_eq!(entry(&compare, "Wipe", &mut session), (false, false), "no B yet");
    assert_eq!(
        entry(&compare, "Next difference", &mut session),
        (false, true),
        "from what"
    );
    let scenes = [Group::Scenes.name()];
    assert_eq!(
        entry(&scenes, "Close the lesson", &mut session),
        (false, true),
        "none open"
    );
    assert_eq!(
        entry(&scenes, "Step of the lesson", &mut session),
        (false, true),
        "of which"
    );
    session.command(Command::Ab(AbCommand::Compare(Against::Settings)));
    session.command(Command::Ab(AbCommand::Arrange(Arrangement::Wipe)));
    session.settle();
    assert_eq!(
        entry(&compare, "Wipe", &mut session),
        (true, false),
        "so they share the window"
    );
    assert_eq!(
        entry(&compare, "Side by side", &mut session),
        (false, false),
        "and not so"
    );
    assert_eq!(
        entry(&compare, "Next difference", &mut session),
        (false, false),
        "now there is B"
    );
    assert_eq!(
        entry(&compare, "Stronger difference", &mut session),
        (false, true),
        "which nobody sees"
    );
}

#[test]
fn pointer_that_rests_is_on_the_picture_once_a_list_is_closed() {
    for name in ["Theme", "Larger interface"] {
        let mut session = session(Vec::new(), [800, 600]);
        session.pointer(Some(dvec2(700.0, 500.0)));
        session.settle();
        open(&mut session, &[Group::Window.name()]);
        let at = place_of(&mut session, name);
        click(&mut session, at);
        session.settle();
        assert!(!session.interface.list_is_open(), "{name} closes the lists");
        assert_eq!(
            session.viewer.pixels().pointer(),
            Some(at),
            "under no list after {name}"
        );
        session.button(PointerButton::Secondary, true);
        session.button(PointerButton::Secondary, false);
        let pinned = session.viewer.pixels().pinned().expect("a pixel");
        assert_eq!(
            DVec2::from(pinned.map(f64::from)),
            at.floor(),
            "{name}: what is under the pointer"
        );
    }
}

#[test]
fn menu_fits_windows_with_large_letters() {
    for window in [[480, 360], [800, 600], [1280, 800]] {
        let mut session = session(Vec::new(), window);
        for _ in 0..8 {
            session.command(Command::Window(WindowCommand::StepInterfaceScale { up: true }));
            session.settle();
            let scale = f64::from(session.scale());
            // Screen readers are told points.
            let button = place_of(&mut session, "Menu") * scale;
            click(&mut session, button);
            session.settle();
            assert!(session.interface.list_is_open(), "open at {scale} in {window:?}");
            let bottom = f64::from(window[1]) / scale;
            session.pointer(Some(dvec2(60.0, 60.0)));
            session.wheel(-9.0);
            session.settle();
            let last = place_of(&mut session, "Command palette").y;
            assert!(last < bottom - 8.0, "{last} of {bottom} at {scale} in {window:?}");
            click(&mut session, button);
            session.settle();
            assert!(!session.interface.list_is_open(), "closed at {scale} in {window:?}");
            assert_eq!(session.viewer.chrome().dialog(), None, "nothing else is hit");
        }
    }
}

#[test]
fn lists_lie_beside_the_lists_that_they_open_from() {
    for (window, steps) in [([800, 600], 0), ([800, 684], 4), ([800, 684], 8), ([1280, 1092], 8)] {
        let mut session = session(Vec::new(), window);
        for _ in 0..steps {
            session.command(Command::Window(WindowCommand::StepInterfaceScale { up: true }));
        }
        session.settle();
        let scale = f64::from(session.scale());
        let of_samples = ["Sample rate", "Pattern", "Filter"].map(|name| (Group::Sampling, name));
        let of_textures = ["Pixel sampling", "Level sampling"].map(|name| (Group::Textures, name));
        for (group, name) in of_samples.into_iter().chain(of_textures) {
            for step in ["Menu", group.name(), name] {
                let at = place_of(&mut session, step) * scale;
                click(&mut session, at);
                session.settle();
            }
            // Everything of the line can still be pressed, from its first letter to its arrow.
            let all = nodes(&mut session);
            let line = all
                .iter()
                .find(|node| node.label() == Some(name))
                .and_then(Node::bounds)
                .unwrap_or_else(|| panic!("no line for {name} at {scale} in {window:?}"));
            let layer = |x: f64| {
                let at = egui::pos2(x as f32, f64::midpoint(line.y0, line.y1) as f32);
                session.ctx().layer_id_at(at)
            };
            assert_eq!(
                layer(line.x0 + 3.0),
                layer(line.x1 - 3.0),
                "{name} at {scale} in {window:?}"
            );
            for _ in 0..3 {
                if session.interface.list_is_open() {
                    key(&mut session, "Escape");
                    session.settle();
                }
            }
        }
    }
}

#[test]
fn values_tell_what_they_do_and_cost_while_the_pointer_rests_on_them() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    for (lists, line) in [
        (&["Sample pattern"][..], "sobol"),
        (&["Menu", Group::Sampling.name(), "Pattern"][..], "pattern: sobol"),
    ] {
        assert!(!says(&mut session, "Costs about"), "nothing is hovered");
        for name in lists {
            click_on(&mut session, name);
        }
        let at = place_of(&mut session, line);
        session.pointer(Some(at));
        session.wait(Duration::from_secs(1));
        assert!(says(&mut session, "scrambled otherwise"), "{line}: what it does");
        assert!(says(&mut session, "Costs about"), "{line}: and costs");
        assert!(
            says(&mut session, "Wins on study/33_nearly_level_edges"),
            "{line}: and where"
        );
        while session.interface.list_is_open() {
            key(&mut session, "Escape");
            session.settle();
        }
        session.pointer(Some(dvec2(400.0, 300.0)));
        session.wait(Duration::from_secs(1));
    }
}
