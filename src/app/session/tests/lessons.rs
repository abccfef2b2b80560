//! A lesson walked through by mouse: what its text speaks of can be reached, in small windows too.

use std::path::PathBuf;

use glam::dvec2;

use super::hands::{click_on, key, place_of, right_click, says, session};
use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{
    AbCommand, Against, Arrangement, InspectorCommand, InterfaceScale, LessonCommand, LessonSource, PixelZoom,
    SceneCommand, Toggle, ViewCommand, WindowCommand,
};

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
        let explained = |session: &mut Session| says(session, "Sample by sample") || says(session, "canvas units");
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
    assert!(says(&mut session, "canvas units"), "what nobody saw is not closed");
    key(&mut session, "e");
    session.settle();
    assert!(
        !says(&mut session, "canvas units") && says(&mut session, "sixteen"),
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

#[test]
fn keys_in_a_lesson_are_clicked_where_nobody_knows_them() {
    let mut session = at_step(1, [1280, 800]);
    let rate = |session: &Session| session.viewer.settings().render.sample_rate.samples();
    let before = rate(&session);
    click_on(&mut session, "Key: Higher sample rate");
    assert!(rate(&session) > before, "as the key does");
    click_on(&mut session, "Key: Lower sample rate");
    assert_eq!(rate(&session), before, "and back");
}

#[test]
fn steps_of_a_lesson_compare_as_their_author_meant_it() {
    let mut session = session(Vec::new(), [1280, 800]);
    for command in [
        AbCommand::Compare(Against::Settings),
        AbCommand::SetWipe(0.9),
        AbCommand::SetGain(32.0),
    ] {
        session.command(Command::Ab(command));
    }
    let source = LessonSource::BuiltIn(1);
    session.command(Command::Lesson(LessonCommand::Open(source)));
    session.settle();
    session.command(Command::Ab(AbCommand::Compare(Against::Settings)));
    session.command(Command::Ab(AbCommand::Arrange(Arrangement::Wipe)));
    session.settle();
    let (line, free) = (session.viewer.both().wipe_line(), session.free_area);
    let (line, free) = (line.expect("a wipe"), free.expect("there is room"));
    let part = (line - free.x as f64) / f64::from(free.width);
    assert!((0.25..0.75).contains(&part), "nobody moved this line: {part}");
    session.command(Command::Ab(AbCommand::Arrange(Arrangement::Difference)));
    session.settle();
    assert_eq!(session.viewer.ab().difference_gain(), Some(1.0), "nor its gain");
}

#[test]
fn steps_show_what_they_showed_after_a_window_was_small() {
    // Each step in one window or the other: all of them in both take longer than they tell.
    let ways = [
        ([1280, 800], 100, &[[500, 400], [1280, 800]][..]),
        ([800, 600], 125, &[[640, 480], [500, 380], [800, 600]]),
    ];
    for (first, (window, scale, sizes)) in ways.into_iter().enumerate() {
        for (lesson, steps) in [("six-tasks", 10), ("anisotropy", 6), ("patterns", 7), ("thin-ray", 8)] {
            for step in (first..steps).step_by(2) {
                let mut session = session(vec![PathBuf::from(format!("lesson:{lesson}"))], window);
                let scale = InterfaceScale::from_percent(scale);
                session.command(Command::Window(WindowCommand::SetInterfaceScale(scale)));
                session.command(Command::Lesson(LessonCommand::Step(step)));
                session.settle();
                let before = session.viewer.both().view_numbers().expect("a picture");
                for size in sizes {
                    session.resize(*size);
                    session.settle();
                }
                let after = session.viewer.both().view_numbers().expect("a picture");
                let same =
                    (after.scale / before.scale - 1.0).abs() < 1e-3 && after.center.distance(before.center) < 1.0;
                assert!(
                    same,
                    "step {step} of {lesson} in {window:?}: {after:?} instead of {before:?}"
                );
            }
        }
    }
}

#[test]
fn needles_that_the_first_steps_speak_of_are_hit_in_every_window() {
    for window in [
        [500, 400],
        [800, 600],
        [801, 601],
        [1280, 800],
        [1366, 768],
        [1919, 1079],
    ] {
        for step in 0..=EXPLAINED {
            let session = at_step(step, window);
            let pixel = session.viewer.pixels().pinned().expect("a pin");
            let status = session.viewer.pixels().status_of(pixel).expect("a picture");
            let color = status.decimal_text().expect("a colour");
            assert!(
                !color.starts_with("247 241 227"),
                "step {step} in {window:?} pins paper"
            );
        }
    }
}

#[test]
fn pictures_of_the_last_steps_are_free_to_be_compared() {
    for window in [[800, 600], [1280, 800], [1920, 1080]] {
        for step in [8, 9] {
            let session = at_step(step, window);
            let viewer = &session.viewer;
            let layout = viewer.both().layout();
            let [low, high] = viewer.scene_list().canvas_in_frame(&layout).expect("a picture");
            let inspector = viewer.inspector();
            for placed in inspector.inset().into_iter().chain(inspector.other_inset()) {
                let beside = [
                    placed.rect.x as f64 >= high.x,
                    placed.rect.y as f64 >= high.y,
                    placed.rect.right() as f64 <= low.x,
                    placed.rect.bottom() as f64 <= low.y,
                ];
                assert!(
                    beside.contains(&true),
                    "{placed:?} over the picture of step {step} in {window:?}"
                );
            }
        }
    }
}

#[test]
fn lessons_show_pixels_of_their_own_size_and_no_old_messages() {
    for window in [[800, 600], [1280, 800]] {
        let mut session = session(Vec::new(), window);
        session.command(Command::View(ViewCommand::SetPixelZoom(
            PixelZoom::new(2).expect("a zoom"),
        )));
        session.command(Command::Scenes(SceneCommand::Open(vec![PathBuf::from(
            "lesson:six-tasks",
        )])));
        session.settle();
        assert_eq!(session.viewer.settings().pixel_zoom.factor(), 1, "in {window:?}");
        assert!(
            session.viewer.pixels().pinned().is_some(),
            "the needle's tip in {window:?}"
        );
        let outside = "the pinned pixel is outside";
        let told = |session: &Session| {
            session
                .viewer
                .chrome()
                .messages()
                .iter()
                .any(|told| told.text.starts_with(outside))
        };
        assert!(!told(&session), "in {window:?}");
        // A hand drags it away, and goes on.
        session.command(Command::View(ViewCommand::PanBy { by: dvec2(9e4, 0.0) }));
        session.settle();
        assert!(told(&session), "outside in {window:?}");
        session.command(Command::Lesson(LessonCommand::Step(3)));
        session.settle();
        assert!(!told(&session), "step 4 pins nothing, in {window:?}");
        session.command(Command::Window(WindowCommand::Escape));
        session.settle();
        assert_eq!(session.viewer.settings().pixel_zoom.factor(), 2, "as before the lesson");
    }
}

#[test]
fn explanation_comes_back_on_its_side_behind_a_lesson() {
    for at in [[600.0, 450.0], [850.0, 540.0]] {
        let mut session = session(Vec::new(), [1280, 800]);
        session.command(Command::Ab(AbCommand::Compare(Against::Truth(None))));
        session.settle();
        right_click(&mut session, at);
        let state = |session: &Session| {
            let numbers = session.viewer.both().view_numbers().expect("a scene");
            (session.free_area, session.viewer.pixels().pinned(), numbers)
        };
        let before = state(&session);
        session.command(Command::Lesson(LessonCommand::Open(LessonSource::BuiltIn(0))));
        session.settle();
        for _ in 0..2 {
            session.command(Command::Scenes(SceneCommand::Next));
            session.settle();
        }
        session.command(Command::Lesson(LessonCommand::Close));
        session.settle();
        assert_eq!(state(&session), before, "room, pin and view of the pixel at {at:?}");
    }
}

/// Scenes that a hand opens.
const FILES: [&str; 2] = ["svg/basic/test1.svg", "svg/basic/test4.svg"];

fn open(session: &mut Session, file: &str) {
    session.command(Command::Scenes(SceneCommand::Open(vec![PathBuf::from(file)])));
    session.settle();
}

/// The scene that is shown.
fn shown(session: &Session) -> String {
    session.viewer.scene_list().current().expect("a scene").source.address()
}

#[test]
fn file_that_is_opened_lies_beside_the_panels() {
    let numbers = |session: &Session| session.viewer.both().view_numbers().expect("a picture");
    let ways: [fn() -> Session; 3] = [
        || at_step(0, [1000, 700]),
        // A step with a pin.
        || at_step(EXPLAINED, [1280, 800]),
        // A pin of a hand's, with its explanation.
        || {
            let mut session = session(vec![PathBuf::from(FILES[0])], [1000, 700]);
            right_click(&mut session, [500.0, 350.0]);
            session
        },
    ];
    for (way, begin) in ways.into_iter().enumerate() {
        let mut session = begin();
        open(&mut session, FILES[1]);
        let opened = numbers(&session);
        session.command(Command::View(ViewCommand::Reset));
        session.settle();
        assert_eq!(opened, numbers(&session), "as Space shows it, in way {way}");
    }
}

#[test]
fn file_that_is_opened_in_a_lesson_stays_when_that_is_closed() {
    let mut session = session(vec![PathBuf::from(FILES[0])], [1280, 800]);
    let open_lesson = Command::Lesson(LessonCommand::Open(LessonSource::BuiltIn(0)));
    let before = session.viewer.settings().render;
    session.command(open_lesson.clone());
    session.settle();
    click_on(&mut session, "Close the lesson");
    assert_eq!(shown(&session), FILES[0], "nothing else was opened");
    for goes_on in [false, true] {
        session.command(open_lesson.clone());
        session.settle();
        open(&mut session, FILES[1]);
        if goes_on {
            click_on(&mut session, "Next scene");
        }
        click_on(&mut session, "Close the lesson");
        assert_eq!(shown(&session), FILES[1], "goes on: {goes_on}");
        let list = session.viewer.scene_list().scenes();
        let sources: Vec<String> = list.iter().map(|entry| entry.source.address()).collect();
        assert_eq!(sources, FILES, "what was there, and what was opened");
        assert_eq!(session.viewer.settings().render, before, "as before the lesson");
        open(&mut session, FILES[0]);
    }
}

#[test]
fn pin_of_a_step_goes_with_its_scene_and_comes_back_with_it() {
    const SAYS: &str = "the text is about another scene";
    for window in [[800, 600], [1280, 800]] {
        let mut session = at_step(EXPLAINED, window);
        let step = shown(&session);
        let has_pin = session.viewer.pixels().pinned().is_some();
        assert!(has_pin && !says(&mut session, SAYS), "the step's own in {window:?}");
        open(&mut session, FILES[1]);
        assert!(says(&mut session, SAYS), "in {window:?}");
        let inspector = session.viewer.inspector();
        assert!(
            session.viewer.pixels().pinned().is_none() && inspector.inset().is_none(),
            "nothing of the step's beside a file in {window:?}"
        );
        // What a hand pins there stays.
        session.command(Command::Inspector(InspectorCommand::Pin([
            i64::from(window[0]) * 2 / 3,
            i64::from(window[1]) / 2,
        ])));
        session.settle();
        assert!(session.viewer.pixels().pinned().is_some(), "a hand's pin in {window:?}");
        click_on(&mut session, "Show the scene of the step");
        assert_eq!(shown(&session), step, "back in {window:?}");
        assert!(session.viewer.pixels().pinned().is_some(), "its pin in {window:?}");
        assert!(!says(&mut session, SAYS), "as the text says in {window:?}");
    }
}
