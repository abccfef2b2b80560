//! Panels without a mouse: a key goes from panel to panel, Tab inside them.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "inside the window"
)]

use std::path::PathBuf;

use glam::dvec2;

use super::hands::{click_on, key, nodes, right_click, says, session};
use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{
    AbCommand, Against, BoardCommand, Dialog, Group, LessonCommand, LessonSource, ProfileCommand, SpectrumCommand,
    Toggle, commands,
};

/// The name of what has the keyboard; `None` for the picture.
fn focused(session: &mut Session) -> Option<String> {
    let update = session.quiet_turn().platform.accesskit_update?;
    let (_, node) = update.nodes.into_iter().find(|(id, _)| *id == update.focus)?;
    node.label().map(str::to_owned).filter(|name| !name.is_empty())
}

#[test]
fn a_key_goes_through_all_panels_and_back_to_the_picture() {
    let mut session = session(Vec::new(), [1920, 1080]);
    session.command(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    session.settle();
    right_click(&mut session, [800.0, 500.0]);
    let nobody = focused(&mut session);
    let mut seen = Vec::new();
    for _ in 0..6 {
        key(&mut session, "F6");
        seen.push(focused(&mut session));
    }
    let expected = ["explanation", "comparison", "settings", "status"].map(|name| Some(format!("Panel: {name}")));
    assert_eq!(seen[..4], expected);
    assert_eq!(seen[4], nobody, "behind the last the picture");
    assert_eq!(seen[5], expected[0], "and round");
    key(&mut session, "Shift+F6");
    assert_eq!(focused(&mut session), nobody, "one back");
    key(&mut session, "Shift+F6");
    assert_eq!(focused(&mut session), expected[3], "and round");
}

#[test]
fn the_key_reaches_what_floats_over_the_picture() {
    for (open, card) in [
        (Command::Window(WindowCommand::About(Toggle::On)), "scene's words"),
        (Command::Board(BoardCommand::Show(Toggle::On)), "board"),
        (Command::Profile(ProfileCommand::Show(Toggle::On)), "edge profile"),
        (Command::Spectrum(SpectrumCommand::Show(Toggle::On)), "spectrum"),
    ] {
        let mut session = session(Vec::new(), [1280, 800]);
        session.command(open);
        session.settle();
        let mut seen = Vec::new();
        for _ in 0..3 {
            key(&mut session, "F6");
            seen.extend(focused(&mut session));
        }
        let expected = ["settings", "status", card].map(|name| format!("Panel: {name}"));
        assert_eq!(seen, expected);
        key(&mut session, "Tab");
        let control = focused(&mut session).expect("a control");
        let place = |session: &mut Session, name: &str| {
            let mut found = nodes(session).into_iter().filter(|node| node.label() == Some(name));
            found.next().and_then(|node| node.bounds()).expect("its place")
        };
        let [around, button] = [&expected[2], &control].map(|name| place(&mut session, name));
        assert!(
            around.contains(button.origin()),
            "Tab goes into the {card} at {around:?}: {control} at {button:?}"
        );
        key(&mut session, "Shift+F6");
        assert_eq!(
            focused(&mut session).as_ref(),
            Some(&expected[1]),
            "one back from a control of the {card}"
        );
    }
}

#[test]
fn tab_goes_from_left_to_right_in_a_row() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    // Its second step has other settings: no button is disabled.
    session.command(Command::Lesson(LessonCommand::Open(LessonSource::BuiltIn(0))));
    session.command(Command::Lesson(LessonCommand::Step(1)));
    session.settle();
    key(&mut session, "F6");
    let mut names = Vec::new();
    for _ in 0..100 {
        key(&mut session, "Tab");
        session.settle();
        names.extend(focused(&mut session));
    }
    let at = |id: &str| {
        let spec = commands::find(id).expect("a command");
        names.iter().position(|known| known == spec.name)
    };
    for row in [
        &["previous-scene", "next-scene", "close-lesson"][..],
        &["default-settings", "pattern-view"],
        &["spectrum", "profile", "board"],
    ] {
        let places: Vec<usize> = row.iter().filter_map(|id| at(id)).collect();
        assert_eq!(places.len(), row.len(), "{row:?} among {names:?}");
        assert!(places.is_sorted(), "{row:?} among {names:?}");
    }
}

#[test]
fn tab_goes_round_the_ways_of_the_start_card() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::Window(WindowCommand::StartCard(Toggle::On)));
    session.settle();
    let mut seen = Vec::new();
    for _ in 0..5 {
        key(&mut session, "Tab");
        session.settle();
        seen.extend(focused(&mut session));
    }
    assert_eq!(seen[0], "Follow a lesson");
    assert_eq!(seen[3], "Explain a pixel");
    assert_eq!(seen[4], seen[0], "and round");
    assert!(!session.viewer.chrome().everything_hidden() && session.viewer.chrome().start_card());
    key(&mut session, "Enter");
    session.settle();
    assert!(session.viewer.lesson().is_some(), "Enter takes the way");
    session.command(Command::Window(WindowCommand::StartCard(Toggle::On)));
    session.settle();
    key(&mut session, "Tab");
    key(&mut session, "Escape");
    session.settle();
    assert!(!session.viewer.chrome().start_card(), "Esc closes the card at once");
}

#[test]
fn tab_goes_through_a_panel_that_has_the_keyboard_and_hides_panels_otherwise() {
    let mut session = session(Vec::new(), [1280, 800]);
    let nobody = focused(&mut session);
    key(&mut session, "F6");
    assert_eq!(focused(&mut session).as_deref(), Some("Panel: settings"));
    let mut controls = Vec::new();
    for _ in 0..4 {
        key(&mut session, "Tab");
        controls.push(focused(&mut session).expect("a control"));
    }
    assert!(!session.viewer.chrome().everything_hidden(), "Tab is the panel's");
    assert!(controls.iter().all(|name| !name.starts_with("Panel: ")), "{controls:?}");
    let rate = session.viewer.settings().render.sample_rate;
    // The fourth is the fourth of the sample rates; the space bar presses it and does not show the canvas.
    key(&mut session, "Space");
    session.settle();
    assert_ne!(
        session.viewer.settings().render.sample_rate,
        rate,
        "pressed {controls:?}"
    );
    key(&mut session, "Shift+Tab");
    assert_eq!(focused(&mut session).as_ref(), Some(&controls[2]), "one back");
    key(&mut session, "v");
    session.settle();
    assert_ne!(
        session.viewer.settings().render.visualisation,
        crate::render::Visualisation::Color,
        "other keys do what they always do"
    );
    key(&mut session, "Escape");
    assert_eq!(
        focused(&mut session),
        nobody,
        "Esc gives the keyboard back to the picture"
    );
    assert!(!session.viewer.chrome().everything_hidden());
    key(&mut session, "Tab");
    assert!(
        session.viewer.chrome().everything_hidden(),
        "there Tab hides the panels"
    );
}

#[test]
fn keys_press_the_buttons_of_cards_and_nothing_behind_them() {
    for name in ["?", "Shift+S"] {
        let mut session = session(Vec::new(), [1280, 800]);
        let nobody = focused(&mut session);
        key(&mut session, name);
        session.settle();
        assert!(session.viewer.chrome().dialog().is_some(), "{name} opens a card");
        key(&mut session, "Tab");
        session.settle();
        let first = focused(&mut session);
        assert_ne!(first, nobody, "a control of the card of {name}");
        key(&mut session, "Tab");
        session.settle();
        assert_ne!(focused(&mut session), first, "the next of {name}");
        assert!(!session.viewer.chrome().everything_hidden(), "Tab is the card's");
        let pins = session.viewer.pixels().pinned();
        key(&mut session, "Escape");
        session.settle();
        assert_eq!(session.viewer.chrome().dialog(), None, "Esc closes the card of {name}");
        assert_eq!(session.viewer.pixels().pinned(), pins, "nothing was pinned");
    }
}

#[test]
fn keys_do_nothing_behind_the_sheet_of_all_keys() {
    for closes in ["?", "F1", "Escape"] {
        let mut session = session(Vec::new(), [640, 480]);
        let before = (*session.viewer.settings(), session.viewer.both().view_numbers());
        key(&mut session, "?");
        session.settle();
        let top = |session: &mut Session| {
            let is_line = |node: &egui::accesskit::Node| {
                node.value()
                    .is_some_and(|value| value.contains("Reads the scene again"))
            };
            let line = nodes(session).into_iter().find(is_line);
            line.and_then(|node| node.bounds()).map(|bounds| bounds.y0)
        };
        let at_first = top(&mut session);
        for name in ["=", "Left", "PageDown", "w"] {
            key(&mut session, name);
            session.settle();
        }
        let after = (*session.viewer.settings(), session.viewer.both().view_numbers());
        assert_eq!(before, after, "the picture stays");
        assert_eq!(session.viewer.scene_list().current_index(), 0, "and the scene");
        assert!(session.viewer.ab().other().is_none(), "nothing is compared");
        assert_ne!(top(&mut session), at_first, "a page further down");
        key(&mut session, closes);
        session.settle();
        assert_eq!(session.viewer.chrome().dialog(), None, "{closes} closes it");
        key(&mut session, "=");
        session.settle();
        assert_ne!(*session.viewer.settings(), before.0, "then keys are the picture's");
    }
}

#[test]
fn lesson_without_room_is_told() {
    let mut session = session(Vec::new(), [400, 300]);
    session.command(Command::Lesson(LessonCommand::Open(LessonSource::BuiltIn(0))));
    session.settle();
    let told = |session: &Session| {
        let messages = session.viewer.chrome().messages();
        messages
            .iter()
            .any(|message| message.text.contains("text of the lesson"))
    };
    assert!(told(&session), "there is no room for it");
    session.resize([1280, 800]);
    session.settle();
    assert!(!told(&session), "by now there is");
    let mut wide = hands::session(Vec::new(), [1280, 800]);
    wide.command(Command::Lesson(LessonCommand::Open(LessonSource::BuiltIn(0))));
    wide.settle();
    assert!(!told(&wide), "here is");
}

#[test]
fn what_has_the_keyboard_is_outlined_and_a_click_on_the_picture_takes_it() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::Window(WindowCommand::StartCard(Toggle::Off)));
    session.settle();
    let before = session.picture();
    key(&mut session, "F6");
    key(&mut session, "Tab");
    session.quiet_turn();
    let focus = session.picture();
    let name = focused(&mut session).expect("a control");
    let bounds = nodes(&mut session)
        .into_iter()
        .find(|node| node.label() == Some(&name))
        .and_then(|node| node.bounds())
        .expect("its place");
    let changed = |x: u32, y: u32| before.rgba(x, y) != focus.rgba(x, y);
    let around = (bounds.x0 as u32 - 2..bounds.x1 as u32 + 2).filter(|x| changed(*x, bounds.y0 as u32 - 2));
    assert!(
        around.count() + 4 >= (bounds.x1 - bounds.x0) as usize,
        "{name} is outlined at {bounds:?}"
    );
    session.pointer(Some(dvec2(500.0, 400.0)));
    for down in [true, false] {
        session.button(PointerButton::Primary, down);
    }
    session.settle();
    session.pointer(None);
    session.quiet_turn();
    assert!(session.picture() == before, "the click took the keyboard away");
}

/// Whether no edge of what scrolls, nor of the window, cuts off the control that has the focus.
fn is_outlined(session: &mut Session) -> bool {
    session.settle();
    let ctx = session.ctx().clone();
    let response = ctx
        .memory(egui::Memory::focused)
        .and_then(|id| ctx.read_response(id))
        .expect("something has the focus");
    let window = session.viewer.chrome().window_size().map(|side| side as f32);
    let window = Rect::from_min_size(Pos2::ZERO, window.into());
    response.interact_rect.expand(1.0).contains_rect(response.rect) && window.contains_rect(response.interact_rect)
}

#[test]
fn what_gets_the_keyboard_comes_into_sight() {
    let mut low = session(Vec::new(), [1280, 500]);
    key(&mut low, "F6");
    key(&mut low, "F6");
    key(&mut low, "Shift+F6");
    assert_eq!(focused(&mut low).as_deref(), Some("Panel: settings"));
    for step in 0..90 {
        key(&mut low, "Tab");
        assert!(is_outlined(&mut low), "{:?} after {step} steps", focused(&mut low));
    }
    for step in 0..20 {
        key(&mut low, "Shift+Tab");
        assert!(is_outlined(&mut low), "{:?} after {step} steps back", focused(&mut low));
    }
}

#[test]
fn lines_of_the_menu_and_of_a_sheet_come_into_sight() {
    let mut menu = session(Vec::new(), [640, 400]);
    click_on(&mut menu, "Menu");
    click_on(&mut menu, Group::Compare.name());
    menu.pointer(None);
    let mut seen = std::collections::BTreeSet::new();
    for name in ["Down", "Right"].into_iter().chain([("Down"); 30]) {
        key(&mut menu, name);
        assert!(is_outlined(&mut menu), "{:?}", focused(&mut menu));
        seen.extend(focused(&mut menu));
    }
    assert!(seen.contains("Zoom out"), "down to the end of the list: {seen:?}");
    let mut sheet = session(Vec::new(), [640, 400]);
    key(&mut sheet, "Shift+S");
    for _ in 0..40 {
        key(&mut sheet, "Tab");
        assert!(is_outlined(&mut sheet), "{:?}", focused(&mut sheet));
    }
}

#[test]
fn tab_reaches_every_button_of_the_dialogs_that_ask() {
    for (dialog, line, buttons) in [
        (
            Dialog::Open,
            "File",
            ["Up", "Home", "Open this folder", "Cancel"].as_slice(),
        ),
        (Dialog::ComparePicture, "Path", ["Up", "Cancel"].as_slice()),
        (Dialog::GoToPixel, "Pixel", ["Cancel"].as_slice()),
    ] {
        let mut session = session(Vec::new(), [800, 600]);
        let nobody = focused(&mut session);
        session.command(Command::Window(WindowCommand::ToggleDialog(dialog)));
        session.settle();
        assert_eq!(
            focused(&mut session).as_deref(),
            Some(line),
            "what is typed is the line's"
        );
        let mut seen = Vec::new();
        for _ in 0..buttons.len() {
            key(&mut session, "Tab");
            seen.extend(focused(&mut session));
        }
        let missing = buttons.iter().filter(|name| !seen.iter().any(|seen| seen == *name));
        assert_eq!(missing.count(), 0, "{dialog:?} reaches {seen:?}");
        key(&mut session, "Tab");
        assert_eq!(focused(&mut session).as_deref(), Some(line), "and round");
        key(&mut session, "Shift+Tab");
        assert_ne!(focused(&mut session).as_deref(), Some(line), "back to the last");
        session.type_text("7");
        session.settle();
        assert_eq!(focused(&mut session).as_deref(), Some(line), "typing goes to the line");
        let holds = nodes(&mut session).iter().any(|node| node.value() == Some("7"));
        assert!(holds, "and is taken in there");
        key(&mut session, "Tab");
        key(&mut session, "Escape");
        session.settle();
        assert_eq!(session.viewer.chrome().dialog(), None, "Esc closes it");
        assert_eq!(focused(&mut session), nobody, "and gives nothing else the focus");
    }
}

#[test]
fn keys_press_what_tab_reached_in_a_dialog() {
    let mut session = session(Vec::new(), [800, 600]);
    key(&mut session, "Ctrl+O");
    session.settle();
    for name in ["Shift+Tab", "Enter"] {
        key(&mut session, name);
    }
    session.settle();
    assert_eq!(
        session.viewer.chrome().dialog(),
        None,
        "the last button closes the dialog"
    );
    key(&mut session, "g");
    session.settle();
    key(&mut session, "Tab");
    assert_eq!(
        focused(&mut session).as_deref(),
        Some("Scene"),
        "the page has the line alone"
    );
    key(&mut session, "Escape");
    session.settle();
    assert!(session.viewer.chrome().dialog().is_none());
    assert!(
        session.ctx().memory(|memory| memory.focused().is_none()),
        "no panel has the focus"
    );
}

/// Goes on with Tab until this control has the keyboard.
fn tab_to(session: &mut Session, name: &str) {
    for _ in 0..60 {
        if focused(session).as_deref() == Some(name) {
            session.settle();
            return;
        }
        key(session, "Tab");
    }
    panic!("Tab never reached {name}");
}

#[test]
fn arrows_choose_a_sample() {
    let scene = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("svg/basic/test4.svg");
    let mut session = session(vec![scene], [1280, 800]);
    session.command(Command::set("sample-rate", "16").expect("a rate"));
    session.settle();
    right_click(&mut session, [700.0, 300.0]);
    key(&mut session, "F6");
    session.pointer(None);
    tab_to(&mut session, "Samples of the pixel");
    let pin = session.viewer.pixels().pinned();
    for (name, sample) in [
        ("Right", "sample 6 at"),
        ("Right", "sample 7 at"),
        ("Down", "sample 11 at"),
        ("Left", "sample 10 at"),
        ("Space", "sample 10 at"),
    ] {
        key(&mut session, name);
        session.settle();
        assert!(says(&mut session, sample), "{name} leads to {sample}");
    }
    assert_eq!(
        focused(&mut session).as_deref(),
        Some("Samples of the pixel"),
        "still there"
    );
    key(&mut session, "Escape");
    assert!(
        session.ctx().memory(|memory| memory.focused().is_none()),
        "Esc leaves it"
    );
    assert_eq!(session.viewer.pixels().pinned(), pin, "nothing else moved");
}

#[test]
fn arrows_move_a_frequency() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::Spectrum(SpectrumCommand::Show(Toggle::On)));
    session.settle();
    for _ in 0..3 {
        key(&mut session, "F6");
    }
    tab_to(&mut session, "Strength of each frequency");
    let invitation = "Point at a frequency";
    assert!(says(&mut session, invitation), "none is chosen");
    key(&mut session, "Up");
    session.settle();
    assert!(!says(&mut session, invitation), "one is told");
    assert_eq!(
        focused(&mut session).as_deref(),
        Some("Strength of each frequency"),
        "the arrow is the plot's"
    );
    key(&mut session, "Tab");
    session.settle();
    assert!(says(&mut session, invitation), "until Tab leads on");
}
