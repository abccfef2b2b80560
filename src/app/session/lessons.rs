//! A lesson walked through by mouse: what its text speaks of can be reached, in small windows too.

use crate::viewer::{InspectorCommand, SceneCommand};
use std::path::PathBuf;

use super::hands::{key, place_of, session};
use super::small_windows::{click_on, right_click, says};
use super::*;
use crate::viewer::Toggle;
use crate::viewer::script::Stage as _;

/// What opens the explanation where it is a page of the lesson's panel, and what opens the text.
const PAGES: [&str; 2] = ["Page: Why this colour", "Page: Text"];
/// The third step of the lesson about six tasks, which explains a pixel.
const EXPLAINED: usize = 2;

/// The lesson at one of its steps, from 0.
pub(super) fn at_step(step: usize, window: [u32; 2]) -> Session {
    let mut session = session(vec![PathBuf::from("lesson:six-tasks")], window);
    for _ in 0..step {
        click_on(&mut session, "Next scene");
    }
    session
}

#[test]
fn explanation_that_a_lesson_speaks_of_is_a_click_away() {
    for window in [[480, 480], [640, 480], [800, 600], [900, 700]] {
        let mut session = at_step(EXPLAINED, window);
        let text = |session: &mut Session| says(session, "sixteen");
        let explained = |session: &mut Session| says(session, "Sample by sample") || says(session, "user units");
        assert!(says(&mut session, "sixteen"), "the text comes first in {window:?}");
        let places = |session: &mut Session| ["Next scene", PAGES[0], PAGES[1]].map(|name| place_of(session, name));
        let (before, free) = (places(&mut session), session.free_area);
        click_on(&mut session, PAGES[0]);
        assert!(
            explained(&mut session) && !text(&mut session),
            "explained in {window:?}"
        );
        assert_eq!(
            (places(&mut session), session.free_area),
            (before, free),
            "nothing moves"
        );
        click_on(&mut session, PAGES[1]);
        assert!(text(&mut session), "back to the text in {window:?}");
        assert!(!session.viewer.pixels().explains(), "and that is all");
        key(&mut session, "e");
        session.settle();
        assert!(explained(&mut session), "the key turns the page, too, in {window:?}");
        click_on(&mut session, "Next scene");
        assert!(
            says(&mut session, "Groups move together"),
            "the next step begins with its text"
        );
    }
}

#[test]
fn key_turns_the_page_of_a_step_that_explains() {
    let mut session = at_step(EXPLAINED, [800, 600]);
    key(&mut session, "e");
    session.settle();
    assert!(says(&mut session, "user units"), "what nobody saw is not closed");
    key(&mut session, "e");
    session.settle();
    assert!(
        !says(&mut session, "user units") && says(&mut session, "sixteen"),
        "the text again"
    );
}

#[test]
fn pixel_that_is_clicked_in_a_lesson_is_explained_in_small_windows() {
    let mut session = at_step(3, [800, 600]);
    right_click(&mut session, [550.0, 300.0]);
    assert!(says(&mut session, "Pixel 550, 300"), "in the lesson's panel");
    assert!(!says(&mut session, "no room"), "so there is room");
    session.command(Command::Inspector(InspectorCommand::Unpin));
    session.settle();
    assert!(
        says(&mut session, "Groups move together"),
        "without a pin the text is there"
    );
    right_click(&mut session, [550.0, 300.0]);
    session.resize([1280, 800]);
    session.settle();
    assert!(
        says(&mut session, "Groups move together") && session.viewer.inspector().explanation().is_some(),
        "both"
    );
    session.command(Command::Inspector(InspectorCommand::Explanation(Toggle::Off)));
    session.command(Command::Scenes(SceneCommand::Next));
    session.settle();
    assert!(!session.viewer.pixels().explains(), "as the step says");
}
