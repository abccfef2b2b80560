//! An edge's profile under a hand: its card is never in the way of its line, and says what the line crosses.

use std::path::{Path, PathBuf};

use egui::pos2;
use glam::{DVec2, dvec2};

use super::hands::{click_on, place_of, says, session};
use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{AbCommand, Against, Arrangement, ProfileCommand, SpectrumCommand, Toggle};

const CLOSE: &str = "Close the edge profile";

fn one_edge() -> Vec<PathBuf> {
    vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/study/14_one_edge.svg")]
}

fn profile(command: ProfileCommand) -> Command {
    Command::Profile(command)
}

fn drag(session: &mut Session, from: DVec2, to: DVec2) {
    session.pointer(Some(from));
    session.button(PointerButton::Primary, true);
    session.pointer(Some(from.lerp(to, 0.5)));
    session.pointer(Some(to));
    session.button(PointerButton::Primary, false);
    session.settle();
}

#[test]
fn profile_is_drawn_by_hand_and_closed_by_its_button() {
    let mut session = session(one_edge(), [1280, 800]);
    let view = session.viewer.both().view_numbers();
    session.command(profile(ProfileCommand::Show(Toggle::On)));
    session.settle();
    assert!(says(&mut session, "Drag a line across an edge"), "what to do");
    let middle = session.viewer.both().layout().shown_at([640, 400]);
    let (x, y) = (middle.x as f64, middle.y as f64 - 150.0);
    drag(&mut session, dvec2(x - 20.0, y), dvec2(x + 20.0, y));
    assert_eq!(session.viewer.both().view_numbers(), view, "the picture stays");
    assert!(says(&mut session, "0.80 px"), "a step between two pixels");
    assert!(says(&mut session, "truth"), "beside the truth");
    let card = place_of(&mut session, CLOSE);
    drag(&mut session, card + dvec2(-90.0, 0.0), card + dvec2(-300.0, 0.0));
    let ends = session.viewer.profile().line().map(|line| line.ends[0]);
    assert_eq!(ends, Some([620, 250]), "a drag on the card draws nothing");
    // Somewhere below the channels is the plot.
    let plot = place_of(&mut session, "Profile of: green") + dvec2(0.0, 60.0);
    session.pointer(Some(plot));
    session.settle();
    assert!(
        says(&mut session, "px: A "),
        "the values of the pixel that is pointed at"
    );
    click_on(&mut session, "Profile of: red");
    assert_eq!(session.viewer.profile().channel().name(), "red", "another channel");
    click_on(&mut session, CLOSE);
    assert!(!session.viewer.profile().is_open(), "closed");
    drag(&mut session, dvec2(x, y), dvec2(x + 30.0, y));
    assert_ne!(
        session.viewer.both().view_numbers(),
        view,
        "a drag moves the picture again"
    );
}

#[test]
fn profile_out_of_sight_says_so() {
    let mut session = session(one_edge(), [800, 600]);
    session.command(profile(ProfileCommand::SetLine([[-50, 10], [-20, 10]])));
    session.settle();
    assert!(says(&mut session, "out of sight"), "nothing to plot");
    session.command(profile(ProfileCommand::SetLine([[20, 10], [40, 10]])));
    session.settle();
    assert!(
        says(
            &mut session,
            "No width, over or under where both ends of the line are alike"
        ),
        "nothing to measure but the shades"
    );
}

#[test]
fn card_of_a_profile_leaves_its_line_free() {
    for window in [[640, 480], [800, 600], [1280, 800], [1920, 1080]] {
        let mut session = session(one_edge(), window);
        session.command(Command::Ab(AbCommand::Compare(Against::Settings)));
        session.settle();
        for (x, y) in [1, 3, 5, 7].into_iter().flat_map(|x| [1, 4, 7].map(|y| (x, y))) {
            let free = session.free_area.expect("room");
            let eighths = |from: i64, side: u32, part: i64| from + i64::from(side) * part / 8;
            let (x, y) = (eighths(free.x, free.width, x), eighths(free.y, free.height, y));
            session.command(profile(ProfileCommand::SetLine([[x - 12, y], [x + 12, y + 5]])));
            session.settle();
            for at in [[x - 12, y], [x, y + 2], [x + 12, y + 5]] {
                let covered = session.interface.covers(pos2(at[0] as f32 + 0.5, at[1] as f32 + 0.5));
                assert!(!covered, "{at:?} of {free:?} in {window:?}");
            }
        }
        session.command(Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)));
        session.settle();
        assert!(says(&mut session, "Edge profile"), "side by side, too, in {window:?}");
    }
}

#[test]
fn profile_of_false_colours_says_so() {
    let mut session = session(one_edge(), [1280, 800]);
    session.command(profile(ProfileCommand::SetLine([[600, 300], [640, 300]])));
    session.settle();
    assert!(!says(&mut session, "visualise"), "the scene's colours");
    session.command(Command::set("visualise", "overdraw").expect("a value"));
    session.settle();
    assert!(says(&mut session, "In all: visualise overdraw."), "false ones");
    session.command(Command::Spectrum(SpectrumCommand::Show(Toggle::On)));
    session.settle();
    assert!(says(&mut session, "In all: visualise overdraw."), "of a spectrum, too");
}

#[test]
fn words_leave_the_line_of_a_profile_free() {
    let mut session = session(one_edge(), [1280, 800]);
    for y in [90, 200, 400, 600] {
        session.command(profile(ProfileCommand::SetLine([[300, y], [340, y]])));
        session.command(Command::Ab(AbCommand::Swap));
        session.settle();
        let line = Rect::from_min_max(pos2(300.0, y as f32), pos2(341.0, y as f32 + 1.0));
        let words = session.interface.told().iter().chain(session.interface.labels());
        for place in words {
            assert!(!place.intersects(line), "{place:?} over the line at {y}");
        }
    }
}
