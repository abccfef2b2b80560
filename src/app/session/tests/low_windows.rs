//! Low and narrow windows: what closes a card stays in sight, and no button lies over another.

use std::path::{Path, PathBuf};

use egui::accesskit::Node;
use glam::dvec2;

use super::hands::{click, click_on, key, nodes, place_of, session};
use super::*;
use crate::compare::{ProfileChannel, SpectrumOf};
use crate::viewer::script::Stage as _;
use crate::viewer::{
    AbCommand, Against, Axis, BoardCommand, Dialog, ProfileCommand, SpectrumCommand, Toggle, WindowCommand,
};

fn rings() -> Vec<PathBuf> {
    vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/study/01_zone_plate.svg")]
}

#[test]
fn cards_keep_their_titles_in_the_window() {
    let axis = Axis::of("sample-rate", "1,4,16").expect("an axis");
    for (command, close) in [
        (
            Command::Spectrum(SpectrumCommand::Show(Toggle::On)),
            "Close the spectrum",
        ),
        (Command::Board(BoardCommand::Vary(axis)), "Close the board"),
        (
            Command::Profile(ProfileCommand::SetLine([[20, 20], [150, 90]])),
            "Close the edge profile",
        ),
    ] {
        for window in [[300, 180], [300, 250], [2500, 300], [900, 200]] {
            let mut session = session(rings(), window);
            session.command(command.clone());
            session.settle();
            session.settle();
            let top = place_of(&mut session, close).y;
            assert!(
                top > 10.0 && top < f64::from(window[1]) - 10.0,
                "{close} in {window:?}: {top}"
            );
        }
    }
}

/// A click near the left end of the control with this name.
fn click_at_left_end(session: &mut Session, name: &str) {
    let nodes = nodes(session);
    let node = nodes.iter().find(|node| node.label() == Some(name));
    let bounds = node.and_then(Node::bounds).unwrap_or_else(|| panic!("no {name}"));
    click(session, dvec2(bounds.x0 + 3.0, f64::midpoint(bounds.y0, bounds.y1)));
    session.settle();
}

#[test]
fn cards_beside_panels_stay_within_reach() {
    for window in [[700, 1200], [520, 420], [420, 300], [320, 240]] {
        let mut session = session(rings(), window);
        session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
        session.command(Command::Ab(AbCommand::Compare(Against::Truth(None))));
        session.command(Command::Spectrum(SpectrumCommand::Show(Toggle::On)));
        session.settle();
        session.settle();
        for of in SpectrumOf::ALL.into_iter().rev() {
            click_at_left_end(&mut session, &format!("Spectrum of: {}", of.name()));
            assert_eq!(session.viewer.spectrum().of(), of, "in {window:?}");
        }
        click_on(&mut session, "Close the spectrum");
        assert!(!session.viewer.spectrum().is_open(), "closed in {window:?}");
        session.command(Command::Profile(ProfileCommand::SetLine([[20, 20], [90, 60]])));
        session.settle();
        session.settle();
        for channel in ProfileChannel::ALL.into_iter().rev() {
            click_at_left_end(&mut session, &format!("Profile of: {}", channel.name()));
            assert_eq!(session.viewer.profile().channel(), channel, "in {window:?}");
        }
        click_on(&mut session, "Close the edge profile");
        assert!(!session.viewer.profile().is_open(), "closed in {window:?}");
    }
}

#[test]
fn buttons_of_narrow_dialogs_lie_beside_each_other() {
    for window in [[240, 220], [300, 200], [360, 240], [800, 600]] {
        let mut session = session(rings(), window);
        session.command(Command::Window(WindowCommand::ToggleDialog(Dialog::Open)));
        session.settle();
        let nodes = nodes(&mut session);
        let found = ["Up", "Home", "Cancel", "Open this folder"].map(|name| {
            let node = nodes.iter().find(|node| node.label() == Some(name));
            let bounds = node.and_then(Node::bounds);
            bounds.unwrap_or_else(|| panic!("no {name} in {window:?}"))
        });
        for (i, one) in found.iter().enumerate() {
            assert!(
                one.x0 >= 0.0 && one.y1 <= f64::from(window[1]),
                "{i} in {window:?}: {one:?}"
            );
            for other in &found[..i] {
                let apart = one.x0 >= other.x1 || other.x0 >= one.x1 || one.y0 >= other.y1 || other.y0 >= one.y1;
                assert!(apart, "{one:?} over {other:?} in {window:?}");
            }
        }
    }
}

#[test]
fn difference_without_room_for_its_numbers_says_so() {
    for (window, is_told) in [([640, 400], true), ([1280, 800], false)] {
        let mut session = session(Vec::new(), window);
        session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
        for name in ["r", "=", "d"] {
            key(&mut session, name);
        }
        let messages = session.viewer.chrome().messages();
        let told = messages
            .iter()
            .any(|message| message.text.contains("no room here for numbers"));
        assert_eq!(told, is_told, "{window:?}: {messages:?}");
    }
}
