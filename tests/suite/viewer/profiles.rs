//! The profile of an edge: a drag draws its line, its numbers follow what is set, and Esc gives the mouse back.

use glam::dvec2;
use rasterscope::compare::{Edge, Line, ProfileChannel};
use rasterscope::viewer::script::{Script, ViewerStage, play};
use rasterscope::viewer::{AbCommand, InspectorCommand, PointerCommand, ProfileCommand, ViewCommand, WindowCommand};
use rasterscope::viewer::{Against, Command, PointerButton, ProfileSide, Toggle, ViewNumbers};

use crate::support::session::{Session, set};

/// An upright edge a quarter into pixel 50, from 100 to 200.
const EDGE: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">
  <rect width="100" height="100" fill="#646464"/><rect x="50.25" width="49.75" height="100" fill="#c8c8c8"/>
</svg>"##;
const LINE: [[i64; 2]; 2] = [[30, 50], [70, 50]];

/// A window in which a canvas unit is a pixel.
fn session() -> Session {
    let mut session = Session::open(&[EDGE], [100, 100]);
    session.run(Command::View(ViewCommand::Set(ViewNumbers {
        center: dvec2(50.0, 50.0),
        scale: 1.0,
        rotation: 0.0,
    })));
    session
}

/// Shades and edge of each curve.
fn measured(session: &Session) -> Vec<(ProfileSide, usize, Option<Edge>)> {
    let profile = session.viewer.profile();
    let curves = profile.curves();
    assert!(curves.iter().all(|curve| curve.is_final), "the picture is finished");
    let measure = |curve: &rasterscope::viewer::ProfileCurve| {
        (
            curve.side,
            curve.profile.shades(),
            curve.profile.edge(profile.channel()),
        )
    };
    curves.iter().map(measure).collect()
}

fn sides(session: &Session) -> Vec<ProfileSide> {
    measured(session).into_iter().map(|(side, ..)| side).collect()
}

/// Shades and width of one side.
fn of(session: &Session, side: ProfileSide) -> (usize, f64) {
    let all = measured(session);
    let (_, shades, edge) = all.into_iter().find(|(found, ..)| *found == side).unwrap();
    (shades, edge.unwrap().width())
}

fn assert_is((shades, width): (usize, f64), expected: (usize, f64), what: &str) {
    assert_eq!(shades, expected.0, "shades, {what}");
    assert!((width - expected.1).abs() < 1e-9, "{what}: {width}, not {}", expected.1);
}

/// 0.1 / 0.75 into the edge's pixel, and from 0.75 on 0.6 of the next.
const COVERED: f64 = 1.6 - 0.1 / 0.75;

#[test]
fn profile_measures_a_and_the_truth_and_follows_settings() {
    let mut session = session();
    session.run(Command::Profile(ProfileCommand::SetLine(LINE)));
    assert_eq!(sides(&session), [ProfileSide::A, ProfileSide::Truth], "both");
    assert_is(of(&session, ProfileSide::A), (2, 0.8), "one sample");
    assert_is(
        of(&session, ProfileSide::Truth),
        (3, COVERED),
        "three quarters of a pixel",
    );
    session.run(set("sample-rate", "16"));
    assert_is(of(&session, ProfileSide::A), (3, COVERED), "sixteen samples");
    session.run(set("resolve-filter", "lanczos3"));
    let (_, _, edge) = measured(&session).remove(0);
    assert!(edge.unwrap().overshoot > 0.02, "it rings: {edge:?}");
    let truth = measured(&session).remove(1).2.unwrap();
    assert!(truth.overshoot > 0.02, "with the picture's filter: {truth:?}");
}

#[test]
fn profile_has_a_curve_for_b_and_the_truth_once() {
    let mut session = session();
    session.run(Command::Profile(ProfileCommand::SetLine(LINE)));
    session.run(Command::Ab(AbCommand::Compare(Against::Settings)));
    session.run(set("sample-rate", "16"));
    assert_eq!(
        sides(&session),
        [ProfileSide::A, ProfileSide::B, ProfileSide::Truth],
        "all three"
    );
    assert_is(of(&session, ProfileSide::A), (3, COVERED), "A");
    assert_is(of(&session, ProfileSide::B), (2, 0.8), "B keeps one sample");
    session.run(Command::Ab(AbCommand::Swap));
    assert_is(of(&session, ProfileSide::A), (2, 0.8), "A and B changed places");
    assert_is(of(&session, ProfileSide::B), (3, COVERED), "both");
    session.run(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    assert_eq!(sides(&session), [ProfileSide::A, ProfileSide::Truth], "B is the truth");
    assert_is(of(&session, ProfileSide::Truth), (3, COVERED), "as it was");
    session.run(Command::Ab(AbCommand::Swap));
    assert_is(of(&session, ProfileSide::A), (2, 0.8), "A in the back");
}

#[test]
fn profile_stays_at_its_place_in_the_scene() {
    let mut session = session();
    session.run(Command::Profile(ProfileCommand::SetLine(LINE)));
    session.run(Command::View(ViewCommand::PanBy { by: dvec2(7.0, -11.0) }));
    let line = session.viewer.profile().line();
    assert_eq!(
        line,
        Some(Line {
            ends: [[37, 39], [77, 39]]
        }),
        "moved with it"
    );
    assert_is(of(&session, ProfileSide::Truth), (3, COVERED), "the same edge");
    session.run(Command::View(ViewCommand::PanBy { by: dvec2(500.0, 0.0) }));
    let curves = session.viewer.profile().curves();
    assert!(
        curves.iter().all(|curve| curve.profile.points().is_empty()),
        "out of sight"
    );
}

/// Presses, moves there and releases.
fn drag(session: &mut Session, from: [f64; 2], to: [f64; 2]) {
    for command in [
        PointerCommand::Moved { at: from.into() },
        PointerCommand::Pressed(PointerButton::Primary),
        PointerCommand::Moved { at: to.into() },
        PointerCommand::Released(PointerButton::Primary),
    ] {
        session.run(Command::Pointer(command));
    }
}

fn ends(session: &Session) -> Option<[[i64; 2]; 2]> {
    session.viewer.profile().line().map(|line| line.ends)
}

#[test]
fn profile_is_drawn_by_a_drag_and_changed_by_its_ends() {
    let mut session = session();
    let view = session.viewer.both().view_numbers();
    session.run(Command::Profile(ProfileCommand::Show(Toggle::Flip)));
    assert_eq!(ends(&session), None, "nothing is drawn yet");
    drag(&mut session, [30.5, 50.5], [70.2, 52.9]);
    assert_eq!(ends(&session), Some([[30, 50], [70, 52]]), "from pixel to pixel");
    drag(&mut session, [72.0, 50.0], [80.0, 20.0]);
    assert_eq!(ends(&session), Some([[30, 50], [80, 20]]), "its second end");
    drag(&mut session, [28.0, 54.0], [10.0, 90.0]);
    assert_eq!(ends(&session), Some([[10, 90], [80, 20]]), "its first");
    drag(&mut session, [50.0, 60.0], [50.4, 60.4]);
    assert_eq!(ends(&session), Some([[10, 90], [80, 20]]), "a click leaves it");
    drag(&mut session, [50.0, 60.0], [500.0, -60.0]);
    assert_eq!(ends(&session), Some([[50, 60], [99, 0]]), "another, within the frame");
    assert_eq!(session.viewer.both().view_numbers(), view, "the picture stays");
    session.run(Command::Inspector(InspectorCommand::Pin([20, 20])));
    session.run(Command::Window(WindowCommand::Escape));
    assert_eq!(ends(&session), None, "Esc ends it first");
    assert!(session.viewer.pixels().pinned().is_some(), "and nothing else");
    session.run(Command::Inspector(InspectorCommand::Show(Toggle::Off)));
    drag(&mut session, [30.0, 50.0], [33.0, 50.0]);
    assert_ne!(
        session.viewer.both().view_numbers(),
        view,
        "a drag moves the picture again"
    );
    session.run(Command::Profile(ProfileCommand::Show(Toggle::On)));
    assert_eq!(
        ends(&session),
        Some([[53, 60], [102, 0]]),
        "it comes back, at its place"
    );
}

#[test]
fn profile_is_named_in_scripts() {
    let mut session = session();
    let text = "profile 30,50 70,50; profile red; rate 16";
    let script = Script::parse(text, "s").unwrap();
    play(&script, "s", &mut ViewerStage::new(&mut session.viewer)).unwrap();
    assert_eq!(ends(&session), Some(LINE), "the line");
    assert_eq!(session.viewer.profile().channel(), ProfileChannel::Red, "the channel");
    assert_is(of(&session, ProfileSide::A), (3, COVERED), "measured");
    let script = Script::parse("profile off; profile 5,x 1,2", "s");
    let error = script.unwrap_err();
    assert!(error.to_string().contains("whole pixels"), "{error}");
    let script = Script::parse("profile off; drag 10,10 20,20", "s").unwrap();
    play(&script, "s", &mut ViewerStage::new(&mut session.viewer)).unwrap();
    assert!(!session.viewer.profile().is_open(), "closed");
    session.run(Command::Window(WindowCommand::HideEverything(Toggle::On)));
    session.run(Command::Profile(ProfileCommand::Show(Toggle::On)));
    assert!(session.viewer.profile().is_open(), "it brings back what is hidden");
    session.run(Command::Window(WindowCommand::HideEverything(Toggle::On)));
    assert!(!session.viewer.profile().is_open(), "and is hidden with all else");
}
