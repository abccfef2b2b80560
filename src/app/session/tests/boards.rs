//! The board under a hand: its tiles lie in the window, are pressed, sorted and removed, and the picture goes on being moved.

use std::path::{Path, PathBuf};

use egui::accesskit::Node;
use glam::dvec2;

use super::hands::{click_on, key, nodes, place_of, says, session};
use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{Axis, BoardCommand, BoardSort, InspectorCommand, LessonCommand, SceneCommand, Toggle};

const CLOSE: &str = "Close the board";

fn rings() -> Vec<PathBuf> {
    vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/study/01_zone_plate.svg")]
}

fn vary(session: &mut Session, name: &str, values: &str) {
    let axis = Axis::of(name, values).expect("an axis");
    session.command(Command::Board(BoardCommand::Vary(axis)));
    session.settle();
}

fn rate(session: &Session) -> u32 {
    session.viewer.settings().render.sample_rate.samples()
}

#[test]
fn numbers_of_what_is_not_there_are_told() {
    let mut session = session(rings(), [1280, 800]);
    vary(&mut session, "sample-rate", "1,4");
    session.command(Command::Board(BoardCommand::MakeA(4)));
    session.settle();
    assert!(says(&mut session, "there is no tile 5: the board has 2"), "to make A");
    session.command(Command::Board(BoardCommand::Remove(2)));
    session.settle();
    assert!(says(&mut session, "there is no tile 3: the board has 2"), "to remove");
    session.command(Command::Scenes(SceneCommand::Show(98)));
    session.settle();
    assert!(says(&mut session, "there is no scene 99: the list has 1"), "to show");
    session.command(Command::Lesson(LessonCommand::Step(0)));
    session.settle();
    assert!(
        says(&mut session, "no lesson is open that has steps"),
        "no lesson is open"
    );
    session.command(Command::Inspector(InspectorCommand::Pin([9999, 5])));
    session.settle();
    assert!(
        says(
            &mut session,
            "no pixel (9999, 5) in a picture of 1280 x 800: pinned its nearest, (1279, 5)"
        ),
        "beside the picture"
    );
    session.command(Command::Inspector(InspectorCommand::Pin([99, 5])));
    session.settle();
    assert!(
        !says(&mut session, "pinned its nearest"),
        "a pixel of the picture makes no words"
    );
}

#[test]
fn buttons_of_a_board_stay_where_they_are_while_it_fills() {
    let mut session = session(rings(), [640, 480]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::Off)));
    session.command(Command::Board(BoardCommand::Show(Toggle::On)));
    session.settle();
    let places = |session: &mut Session| [CLOSE, "Add to the board"].map(|name| place_of(session, name));
    let before = places(&mut session);
    for (setting, values) in [
        ("sample-rate", "1,4,16,25"),
        ("pattern", "grid,r2,sobol,halton,rotated"),
        ("sample-rate", "4"),
    ] {
        vary(&mut session, setting, values);
        assert_eq!(places(&mut session), before, "{setting} {values}");
    }
    let mut session = hands::session(rings(), [1280, 800]);
    vary(&mut session, "sample-rate", "1,4,16,25");
    let before = places(&mut session);
    vary(&mut session, "sample-rate", "1,4");
    assert_eq!(places(&mut session), before, "fewer entries");
}

#[test]
fn board_is_worked_by_hand() {
    let mut session = session(rings(), [1280, 800]);
    vary(&mut session, "sample-rate", "1,4,16");
    assert!(says(&mut session, "the truth"), "beside the truth");
    assert!(says(&mut session, "RMSE") && says(&mut session, "FLIP"), "in numbers");
    assert!(
        says(&mut session, "truth: 256 samples in stored values, as A"),
        "which says what it is"
    );
    click_on(&mut session, "Make tile 1 A");
    assert_eq!(rate(&session), 16, "the nearest to the truth");
    click_on(&mut session, "Remove tile 3");
    assert_eq!(session.viewer.board().tiles().len(), 2, "one is gone");
    click_on(&mut session, "Sort by: FLIP");
    assert_eq!(session.viewer.board().sort(), BoardSort::Flip, "sorted otherwise");
    click_on(&mut session, "Truth averaged: linear");
    assert!(
        says(&mut session, "truth: 256 samples in linear light") && !says(&mut session, ", as A"),
        "chosen"
    );
    let view = session.viewer.both().view_numbers();
    let card = place_of(&mut session, CLOSE);
    session.pointer(Some(card + dvec2(-200.0, 0.0)));
    session.button(PointerButton::Primary, true);
    session.pointer(Some(card + dvec2(-260.0, 30.0)));
    session.button(PointerButton::Primary, false);
    session.settle();
    assert_eq!(
        session.viewer.both().view_numbers(),
        view,
        "a drag on the card moves nothing"
    );
    click_on(&mut session, CLOSE);
    assert!(!session.viewer.board().is_open(), "closed");
}

#[test]
fn board_lies_in_every_window() {
    for window in [[640, 480], [800, 600], [1280, 800], [1920, 1080]] {
        for pinned in [false, true] {
            let mut session = session(rings(), window);
            if pinned {
                session.command(Command::Inspector(InspectorCommand::Pin([200, 200])));
            }
            vary(&mut session, "seed", "0,1,2,3,4,5,6,7,8");
            assert_eq!(session.viewer.board().tiles().len(), 9, "a full board");
            let leaves = ["Clear the board", "More of the board"];
            let nodes = nodes(&mut session);
            let has = |name: &&str| nodes.iter().any(|node| node.label() == Some(*name));
            let leaves = leaves.into_iter().find(has).expect("a way to clear it");
            for name in [CLOSE, "Sort by: time", leaves, "Make tile 1 A"] {
                let at = place_of(&mut session, name);
                let inside = at.cmpge(dvec2(0.0, 0.0)).all() && at.x < window[0].into() && at.y < window[1].into();
                assert!(inside, "{name} at {at} of {window:?}, pinned: {pinned}");
            }
        }
    }
}

#[test]
fn narrow_board_has_what_leaves_it_in_a_list() {
    let mut session = session(rings(), [640, 480]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    vary(&mut session, "sample-rate", "1,4");
    let [sort, more] = ["Sort by: RMSE", "More of the board"].map(|name| place_of(&mut session, name).y);
    assert!(more - sort < 40.0, "two rows: {sort} and {more}");
    assert!(says(&mut session, "in stored values, as A"), "the whole title");
    click_on(&mut session, "More of the board");
    click_on(&mut session, "Clear the board");
    assert!(session.viewer.board().tiles().is_empty(), "cleared");
}

#[test]
fn board_with_more_rows_has_a_bar_before_the_pointer_is_there() {
    let mut session = session(rings(), [640, 480]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    vary(&mut session, "seed", "0,1,2,3,4,5,6,7,8");
    let nodes = nodes(&mut session);
    let close = nodes.iter().find(|node| node.label() == Some(CLOSE));
    let right = close.and_then(Node::bounds).expect("the card's right end").x1;
    let y = place_of(&mut session, "Make tile 1 A").y;
    let picture = session.picture();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "inside of the window"
    )]
    let [right, y] = [right, y].map(|at| at as u32);
    let at = |x: u32| picture.rgba(x, y).expect("inside");
    let ground = at(right + 3);
    let bar = (right - 8..right).filter(|x| at(*x) != ground).count();
    assert!(bar >= 3, "{bar} columns of a bar left of {right}");
}

#[test]
fn tip_of_a_tile_leaves_its_numbers_free() {
    let mut session = session(rings(), [1280, 800]);
    vary(&mut session, "sample-rate", "1,4,16");
    let tile = place_of(&mut session, "Make tile 1 A");
    session.pointer(Some(tile));
    session.wait(Duration::from_secs(3));
    session.settle();
    let nodes = nodes(&mut session);
    let places = |text: &str| {
        let holds = |node: &&Node| node.value().is_some_and(|value| value.contains(text));
        let found: Vec<_> = nodes.iter().filter(holds).filter_map(Node::bounds).collect();
        found
    };
    let tip = places("Gives A the settings of this tile: sample rate 16.");
    let tip = tip.first().expect("a tip");
    for words in ["RMSE", "FLIP", "16"] {
        let below = places(words).into_iter().filter(|place| place.y0 > tile.y);
        let tops: Vec<f64> = below.map(|place| place.y0).collect();
        assert!(!tops.is_empty(), "{words} below the tile");
        assert!(
            tops.iter().all(|top| *top >= tip.y1),
            "{words} at {tops:?} below {tip:?}"
        );
    }
}

#[test]
fn pixel_under_a_board_is_not_told() {
    let mut session = session(rings(), [1280, 800]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::Off)));
    session.pointer(Some(dvec2(900.0, 700.0)));
    session.settle();
    assert!(
        session.viewer.pixels().status().is_some(),
        "the pixel under the pointer"
    );
    vary(&mut session, "sample-rate", "1,4");
    assert!(session.viewer.pixels().pointer().is_none(), "a tile lies there");
    assert!(session.viewer.pixels().status().is_none(), "no pixel is told");
    click_on(&mut session, CLOSE);
    session.pointer(Some(dvec2(900.0, 700.0)));
    session.settle();
    assert!(session.viewer.pixels().status().is_some(), "it is to be seen again");
}

#[test]
fn board_without_entries_says_what_to_do() {
    let mut session = session(rings(), [800, 600]);
    vary(&mut session, "sample-rate", "1,4");
    click_on(&mut session, "Clear the board");
    assert!(says(&mut session, "Nothing to compare yet"), "a hint");
    click_on(&mut session, "Add to the board");
    assert_eq!(session.viewer.board().tiles().len(), 1, "A");
    assert!(says(&mut session, "RMSE"), "measured");
}

#[test]
fn board_grows_again_with_what_it_holds_and_with_its_window() {
    let filled = |window: [u32; 2]| {
        let mut session = session(rings(), window);
        session.command(Command::Window(WindowCommand::Panel(Toggle::Off)));
        vary(&mut session, "sample-rate", "1,4");
        session
    };
    let top = |session: &mut Session| {
        // The area finds its place by the size that it had in the pass before.
        session.settle();
        place_of(session, CLOSE).y
    };
    let fresh = top(&mut filled([800, 600]));
    let mut cleared = filled([800, 600]);
    click_on(&mut cleared, "Clear the board");
    let low = top(&mut cleared);
    assert!(low > fresh + 60.0, "{low} without tiles, {fresh} with them");
    vary(&mut cleared, "sample-rate", "1,4");
    let again = top(&mut cleared);
    assert!((again - fresh).abs() < 1.0, "{again} after it was empty, not {fresh}");
    let mut grown = filled([320, 240]);
    grown.resize([800, 600]);
    let again = top(&mut grown);
    assert!(
        (again - fresh).abs() < 1.0,
        "{again} in a window that grew, not {fresh}"
    );
}

#[test]
fn other_entries_are_shown_from_the_truth_on() {
    let mut session = session(rings(), [640, 360]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::Off)));
    vary(&mut session, "seed", "0,1,2,3,4,5,6,7,8");
    let first = place_of(&mut session, "Make tile 1 A");
    session.pointer(Some(first));
    for _ in 0..6 {
        session.wheel(-1.0);
        session.settle();
    }
    let scrolled = place_of(&mut session, "Make tile 1 A");
    assert!(
        scrolled.y < first.y - 20.0,
        "{scrolled} after the wheel, {first} before"
    );
    // A is among them as it was among the first.
    vary(&mut session, "seed", "0,11,12,13,14,15,16,17,18");
    session.settle();
    let again = place_of(&mut session, "Make tile 1 A");
    assert!((again.y - first.y).abs() < 1.0, "{again}, not {first}");
}

#[test]
fn list_of_what_varies_opens_at_its_top() {
    let mut session = session(rings(), [800, 600]);
    vary(&mut session, "sample-rate", "1,4");
    let open = |session: &mut Session| {
        click_on(session, "Vary on the board");
        session.settle();
        place_of(session, "sample rate")
    };
    let first = open(&mut session);
    session.pointer(Some(first));
    for _ in 0..6 {
        session.wheel(-1.0);
        session.settle();
    }
    let scrolled = place_of(&mut session, "sample rate");
    assert!(
        scrolled.y < first.y - 20.0,
        "{scrolled} after the wheel, {first} before"
    );
    key(&mut session, "Escape");
    session.settle();
    assert!(!session.interface.list_is_open(), "closed");
    let again = open(&mut session);
    assert!((again.y - first.y).abs() < 1.0, "{again}, not {first}");
}

#[test]
fn escape_closes_the_board_before_the_words_below_it() {
    let mut session = session(rings(), [1280, 800]);
    session.command(Command::Window(WindowCommand::About(Toggle::On)));
    vary(&mut session, "sample-rate", "1,4");
    assert!(session.viewer.board().is_open(), "the board is open");
    key(&mut session, "Escape");
    session.settle();
    assert!(!session.viewer.board().is_open(), "the board is closed");
    assert!(session.viewer.chrome().about(), "the words are there again");
    key(&mut session, "Escape");
    session.settle();
    assert!(!session.viewer.chrome().about(), "and then they are closed");
}
