//! Magnifiers under a hand: where they lie, what closes them, what the wheel does over them.

#![expect(clippy::cast_possible_truncation, reason = "inside the window")]

use glam::{DVec2, dvec2};

use super::comparing::{CLOSE, WINDOWS, side_by_side};
use super::hands::{click_on, comparing, right_click, session};
use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{AbCommand, Against, Arrangement, InspectorCommand, Toggle};

#[test]
fn magnifiers_lie_beside_both_pictures() {
    for window in WINDOWS {
        for part in [0.25, 0.3, 0.7, 0.8] {
            let mut session = side_by_side(window);
            let free = session.free_area.expect("there is room");
            let x = (free.x as f64 + f64::from(free.width) * part).round();
            right_click(&mut session, [x, f64::from(window[1]) * 0.45]);
            click_on(&mut session, CLOSE);
            let insets = [
                session.viewer.inspector().inset(),
                session.viewer.inspector().other_inset(),
            ];
            let insets = insets.map(|placed| placed.expect("there is room").rect);
            let free = session.free_area.expect("there is room");
            let half = free.width / 2;
            let corner = |place: DVec2| place.to_array().map(|at| at.floor() as i64);
            let canvas = session
                .viewer
                .scene_list()
                .canvas_in_frame(&session.viewer.both().layout())
                .expect("a scene");
            let [low, high] = canvas.map(corner);
            for (index, inset) in insets.iter().enumerate() {
                let left = free.x + i64::from(half + 2) * i64::try_from(index).expect("two");
                let pane = PixelRect {
                    x: left,
                    width: half - 1,
                    ..free
                };
                assert_eq!(inset.intersection(&pane), *inset, "in its half of {window:?}");
                let picture = PixelRect {
                    x: pane.x + low[0],
                    y: pane.y + low[1],
                    width: u32::try_from(high[0] - low[0]).expect("a width"),
                    height: u32::try_from(high[1] - low[1]).expect("a height"),
                };
                let common = inset.intersection(&picture);
                let covered = f64::from(common.width) * f64::from(common.height);
                let whole = f64::from(picture.width) * f64::from(picture.height);
                assert!(covered < whole * 0.05, "{inset:?} over {picture:?} in {window:?}");
            }
        }
    }
}

#[test]
fn magnifiers_follow_their_pictures_to_the_other_half() {
    let mut session = side_by_side([1366, 768]);
    session.command(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    session.command(Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)));
    session.settle();
    let free = session.free_area.expect("there is room");
    right_click(&mut session, [free.x as f64 + f64::from(free.width) * 0.3, 350.0]);
    click_on(&mut session, CLOSE);
    for own_is_left in [true, false] {
        let free = session.free_area.expect("there is room");
        let middle = free.x + i64::from(free.width / 2);
        let [own, other] = [
            session.viewer.inspector().inset(),
            session.viewer.inspector().other_inset(),
        ]
        .map(|placed| placed.expect("room").rect);
        assert_eq!(
            own.right() <= middle,
            own_is_left,
            "A's lies in A's half: {own:?} of {free:?}"
        );
        assert_eq!(
            other.right() <= middle,
            !own_is_left,
            "B's in B's: {other:?} of {free:?}"
        );
        session.command(Command::Ab(AbCommand::Swap));
        session.settle();
    }
}

#[test]
fn outline_lies_over_the_first_of_both() {
    let session = side_by_side([1280, 800]);
    let free = session.free_area.expect("there is room");
    let [low, _] = session
        .viewer
        .scene_list()
        .canvas_in_frame(&session.viewer.both().layout())
        .expect("a scene");
    // The ground of the scene: half of its canvas.
    let outline = session.viewer.both().outline_of(0).concat();
    let corner = outline.into_iter().map(DVec2::from).reduce(DVec2::min);
    let expected = low + dvec2(free.x as f64, free.y as f64);
    let off = corner.expect("a triangle") - expected;
    assert!(off.length() < 1.5, "{corner:?}, not {expected}");
}

#[test]
fn magnifier_is_closed_with_a_pin_out_of_sight() {
    let mut session = comparing([1280, 800]);
    session.command(Command::Inspector(InspectorCommand::Explanation(Toggle::Off)));
    session.pointer(Some(dvec2(640.0, 380.0)));
    for _ in 0..3 {
        session.wheel(3.0);
    }
    session.command(Command::Inspector(InspectorCommand::Pin([290, 300])));
    session.command(Command::Inspector(InspectorCommand::Explanation(Toggle::Off)));
    session.settle();
    assert!(
        session.viewer.inspector().inset().is_some(),
        "magnified while it is in sight"
    );
    session.command(Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)));
    session.settle();
    assert_eq!(session.viewer.pixels().pinned(), None, "outside of both halves");
    assert!(session.viewer.inspector().inset().is_none() && session.viewer.inspector().other_inset().is_none());
    session.command(Command::Ab(AbCommand::Arrange(Arrangement::Wipe)));
    session.settle();
    assert!(
        session.viewer.inspector().inset().is_some(),
        "it comes back with the pin"
    );
}

#[test]
fn magnifier_that_follows_the_pointer_has_a_button_that_closes_it() {
    for window in WINDOWS {
        let mut session = session(Vec::new(), window);
        session.command(Command::Inspector(InspectorCommand::Show(Toggle::On)));
        session.pointer(Some(dvec2(300.0, 300.0)));
        session.settle();
        assert!(session.viewer.inspector().inset().is_some(), "open in {window:?}");
        click_on(&mut session, "Close the pixel inspector");
        assert!(session.viewer.inspector().inset().is_none(), "closed in {window:?}");
    }
}

#[test]
fn magnifiers_stay_where_the_wheel_turns_over_them() {
    for arrangement in [Arrangement::SideBySide, Arrangement::Wipe] {
        for window in [[800, 600], [1280, 800], [1920, 1080]] {
            let mut session = comparing(window);
            session.command(Command::Ab(AbCommand::Arrange(arrangement)));
            session.settle();
            let free = session.free_area.expect("there is room");
            let at = [free.x as f64 + 60.0, free.y as f64 + f64::from(free.height) / 2.0];
            right_click(&mut session, at);
            let placed = |session: &Session| session.viewer.inspector().inset().expect("there is room").rect;
            let first = placed(&session);
            let middle = dvec2(
                first.x as f64 + f64::from(first.width) / 2.0,
                first.y as f64 + f64::from(first.height) / 2.0,
            );
            session.pointer(Some(middle));
            for clicks in [1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0, -1.0] {
                session.wheel(clicks);
                session.settle();
                let now = placed(&session);
                let touches =
                    now.x < first.right() && first.x < now.right() && now.y < first.bottom() && first.y < now.bottom();
                assert!(touches, "{now:?} after {first:?} at {window:?}, {arrangement:?}");
            }
        }
    }
}

#[test]
fn magnifiers_of_a_wipe_leave_both_sides_in_sight() {
    for window in WINDOWS {
        for part in [0.2, 0.4, 0.6, 0.8] {
            let mut session = comparing(window);
            session.command(Command::Ab(AbCommand::Arrange(Arrangement::Wipe)));
            session.settle();
            let free = session.free_area.expect("there is room");
            let x = (free.x as f64 + f64::from(free.width) * part).round();
            right_click(&mut session, [x, f64::from(window[1]) * 0.45]);
            let free = session.free_area.expect("there is room");
            let line = session.viewer.both().wipe_line().expect("a wipe") as i64;
            let insets = [
                session.viewer.inspector().inset(),
                session.viewer.inspector().other_inset(),
            ]
            .map(|placed| placed.expect("there is room").rect);
            assert!(insets[0].right() <= insets[1].x, "A's to the left: {insets:?}");
            for (left, right) in [(free.x, line), (line, free.right())] {
                let side = PixelRect {
                    x: left,
                    width: u32::try_from(right - left).unwrap_or_default(),
                    ..free
                };
                let area = |rect: &PixelRect| f64::from(rect.width) * f64::from(rect.height);
                let covered: f64 = insets.iter().map(|inset| area(&inset.intersection(&side))).sum();
                assert!(
                    covered <= 0.6 * area(&side),
                    "{covered} of {} in {window:?} at {part}",
                    area(&side)
                );
            }
        }
    }
}

/// Where the magnifiers lie that are to be seen.
fn lying(session: &Session) -> Vec<PixelRect> {
    let inspector = session.viewer.inspector();
    let insets = inspector.inset().into_iter().chain(inspector.other_inset());
    insets.map(|placed| placed.rect).collect()
}

/// A pinned pixel of one picture, and of two in both arrangements.
fn magnifying(window: [u32; 2], at: [f64; 2]) -> Vec<Session> {
    let mut alone = session(Vec::new(), window);
    alone.settle();
    let mut wiped = comparing(window);
    wiped.command(Command::Ab(AbCommand::Arrange(Arrangement::Wipe)));
    let mut sessions = vec![alone, wiped, side_by_side(window)];
    for session in &mut sessions {
        session.settle();
        let free = session.free_area.expect("there is room");
        let place = |axis: usize, start: i64, length: u32| (start as f64 + f64::from(length) * at[axis]).round();
        right_click(session, [place(0, free.x, free.width), place(1, free.y, free.height)]);
    }
    sessions
}

#[test]
fn magnifiers_stay_under_a_wheel_and_the_hand_at_it() {
    for window in WINDOWS {
        for at in [[0.3, 0.4], [0.45, 0.5], [0.2, 0.75]] {
            for mut session in magnifying(window, at) {
                let Some(first) = lying(&session).first().copied() else {
                    continue;
                };
                let near = |at: i64, length: u32| (at + i64::from(length / 2)) as f64;
                let hand = dvec2(near(first.x, first.width), near(first.y, first.height));
                let canvas = |session: &Session| {
                    let layout = session.viewer.both().layout();
                    session.viewer.scene_list().canvas_in_frame(&layout)
                };
                let before = canvas(&session);
                for (turn, clicks) in [1.0; 9].into_iter().chain([-1.0; 9]).zip(1..).map(|(a, b)| (b, a)) {
                    // Between two turns a hand is never quite still.
                    let shake = f64::from(turn % 2);
                    session.pointer(Some(hand + dvec2(shake, 0.0)));
                    session.wheel(clicks);
                    session.settle();
                    session.pointer(Some(hand + dvec2(1.0 - shake, 0.0)));
                    session.settle();
                    let now = lying(&session);
                    let over = |rect: &PixelRect| rect.contains([hand.x as i64, hand.y as i64]);
                    assert!(
                        now.iter().any(over),
                        "turn {turn}: {now:?}, from {first:?} in {window:?}"
                    );
                    assert_eq!(canvas(&session), before, "the picture does not move");
                }
            }
        }
    }
}

#[test]
fn wheel_turns_back_from_the_largest_magnifier_at_once() {
    for window in WINDOWS {
        for mut session in magnifying(window, [0.3, 0.4]) {
            let Some(first) = lying(&session).first().copied() else {
                continue;
            };
            session.pointer(Some(dvec2(first.x as f64 + 30.0, first.y as f64 + 30.0)));
            for _ in 0..12 {
                session.wheel(1.0);
                session.settle();
            }
            let shown = |session: &Session| session.viewer.inspector().inset().map(|placed| placed.inset);
            let largest = shown(&session);
            session.wheel(-1.0);
            session.settle();
            assert_ne!(shown(&session), largest, "the first turn back is seen in {window:?}");
        }
    }
}

/// Drags from the middle of A's magnifier to a place of the window; where it lies before and after.
fn drag(session: &mut Session, to: [f64; 2]) -> [PixelRect; 2] {
    let before = lying(session)[0];
    let middle = |from: i64, length: u32| from as f64 + f64::from(length / 2);
    session.pointer(Some(dvec2(
        middle(before.x, before.width),
        middle(before.y, before.height),
    )));
    session.button(PointerButton::Primary, true);
    session.pointer(Some(DVec2::from(to)));
    session.button(PointerButton::Primary, false);
    session.settle();
    [before, lying(session)[0]]
}

#[test]
fn magnifier_that_is_dragged_to_the_pin_stays_where_it_was() {
    let mut session = session(Vec::new(), [1280, 800]);
    right_click(&mut session, [400.0, 150.0]);
    let free = session.free_area.expect("there is room");
    let left = free.x as f64 + 60.0;
    for turn in 0..2 {
        let [first, below] = drag(&mut session, [left, 700.0]);
        assert!(turn > 0 || first.y < below.y, "{first:?}, {below:?}");
        let [_, after] = drag(&mut session, [left, 200.0]);
        assert_eq!(after, below, "no room beside the pin");
        // Neither after the wheel turned over it.
        session.pointer(Some(dvec2(below.x as f64 + 40.0, below.y as f64 + 40.0)));
        session.wheel(1.0);
        session.wheel(-1.0);
        session.settle();
    }
}

#[test]
fn magnifiers_side_by_side_are_dragged_to_other_corners() {
    let mut session = side_by_side([1280, 800]);
    let free = session.free_area.expect("there is room");
    right_click(&mut session, [free.x as f64 + f64::from(free.width) * 0.7, 300.0]);
    let free = session.free_area.expect("there is room");
    let half = [free.x as f64, free.x as f64 + f64::from(free.width) / 2.0];
    for (to, is_above) in [([half[0] + 20.0, 20.0], true), ([half[1] - 20.0, 700.0], false)] {
        let [_, after] = drag(&mut session, to);
        assert_eq!(after.y < 300, is_above, "{after:?} after a drag to {to:?}");
        let is_left = (after.x as f64) - half[0] < half[1] - after.right() as f64;
        assert_eq!(is_left, is_above, "{after:?} after a drag to {to:?}, in {half:?}");
        assert_eq!(lying(&session)[1].y, after.y, "B's lies alike");
    }
}
