//! The numbers of a comparison, and the way from difference to difference.

use std::time::{Duration, Instant};

use glam::dvec2;
use rasterscope::compare::{DifferencePaint, Measure, Pair};
use rasterscope::raster::Framebuffer;
use rasterscope::render::{self, CancelToken};
use rasterscope::viewer::{
    AbCommand, Against, Arrangement, Command, InspectorCommand, PixelRect, Toggle, ViewCommand, WindowCommand,
};

use super::{WINDOW, frames, sixteen_against_one};
use crate::support::session::{Session, set, step};

#[test]
fn comparison_draws_the_parts_that_changed() {
    let mut session = sixteen_against_one(WINDOW);
    let mut window = session.viewer.window().picture();
    assert!(session.viewer.take_damage().is_none(), "at first everything");
    for command in [
        Command::Ab(AbCommand::Arrange(Arrangement::Wipe)),
        Command::Ab(AbCommand::SetWipe(0.3)),
        Command::Ab(AbCommand::Swap),
        step("sample-rate", -1.0),
        Command::Ab(AbCommand::Arrange(Arrangement::Difference)),
        Command::Ab(AbCommand::Normalize(Toggle::On)),
        Command::View(ViewCommand::PanBy { by: dvec2(3.0, 0.0) }),
        Command::Ab(AbCommand::Compare(Against::Nothing)),
        Command::Ab(AbCommand::Compare(Against::Settings)),
        Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)),
    ] {
        session.run(command.clone());
        let parts = session.viewer.take_damage();
        let all = [PixelRect::of_size(WINDOW)];
        let parts = parts.as_deref().unwrap_or(&all);
        session
            .viewer
            .window()
            .draw_parts(parts, &mut rasterscope::viewer::WindowPixels::of(&mut window));
        assert!(window == session.viewer.window().picture(), "after {command:?}");
    }
}

#[test]
fn comparison_of_a_moving_view_never_mixes_two_views() {
    let mut session = sixteen_against_one([400, 300]);
    // Previews differ by more.
    session.run(Command::View(ViewCommand::Progressive(Toggle::Off)));
    session.run(set("sample-rate", "64"));
    session.keys(&["d"]);
    // A difference of one view has few pixels that differ; one of two views differs along every edge by several pixels.
    let black = DifferencePaint::new(Measure::Absolute, 1.0).pixel(0, 0);
    let strong = |session: &Session| {
        let picture = session.viewer.window().picture();
        picture.pixels().iter().filter(|pixel| **pixel != black).count()
    };
    let calm = strong(&session);
    for step in 0..60 {
        let _ = session.viewer.apply(Command::View(ViewCommand::PanBy {
            by: dvec2(if step % 20 < 10 { 9.0 } else { -9.0 }, 0.0),
        }));
        session.viewer.poll();
        std::thread::sleep(Duration::from_millis(2));
        session.viewer.poll();
        let seen = strong(&session);
        assert!(seen < calm * 2, "{seen} pixels differ in step {step}, {calm} at rest");
    }
}

/// A pixel that is jumped to is not left below a panel.
#[test]
fn comparison_jumps_to_what_can_be_seen() {
    let mut session = sixteen_against_one(WINDOW);
    // A view that no hand has moved makes room for panels by itself.
    session.run(Command::View(ViewCommand::PanBy { by: dvec2(1.0, 0.0) }));
    session.run(Command::Ab(AbCommand::NextDifference));
    let first = session.viewer.pixels().pinned().expect("the largest difference");
    session.run(Command::Inspector(InspectorCommand::Unpin));
    // A panel over the half that holds it.
    let half = WINDOW[0] / 2;
    let free = PixelRect {
        x: if first[0] < half { i64::from(half) } else { 0 },
        y: 0,
        width: half,
        height: WINDOW[1],
    };
    session.run(Command::Window(WindowCommand::SetFreeArea(Some(free))));
    let place = session.viewer.pixels().status_of(first).unwrap().user;
    session.run(Command::Ab(AbCommand::NextDifference));
    let pinned = session.viewer.pixels().pinned().expect("the same again");
    let shown = session.viewer.both().layout().shown_at(pinned);
    assert!(free.contains([shown.x, shown.y]), "{shown:?} in {free:?}");
    let now = session.viewer.pixels().status_of(pinned).unwrap().user;
    assert!(
        now.distance(place) < 1e-6,
        "the same place of the scene: {now}, {place}"
    );
    let view = session.viewer.both().view_numbers();
    session.run(Command::Inspector(InspectorCommand::Pin([
        first[0].into(),
        first[1].into(),
    ])));
    assert_eq!(
        session.viewer.both().view_numbers(),
        view,
        "a pixel that is named stays where it is"
    );
}

/// What nobody sees is drawn when the hand rests.
#[test]
fn comparison_draws_b_in_the_back_at_rest() {
    let mut session = sixteen_against_one(WINDOW);
    let view = session.viewer.frames().frame().unwrap().picture.view;
    let is_in_step = |session: &mut Session| {
        session.viewer.poll();
        let picture = &session.viewer.frames().frame().unwrap().picture;
        let mut expected = Framebuffer::new(WINDOW[0], WINDOW[1]);
        let settings = session.viewer.ab().other_settings(session.viewer.settings()).unwrap();
        render::draw(&picture.scene, &picture.view, &settings, &mut expected);
        picture.view != view && *session.viewer.ab().other_pixels().unwrap() == expected
    };
    let start = Instant::now();
    let _ = session
        .viewer
        .apply(Command::View(ViewCommand::PanBy { by: dvec2(5.0, 5.0) }));
    while !is_in_step(&mut session) {
        assert!(start.elapsed() < Duration::from_secs(20), "in the end");
        assert!(!session.viewer.is_settled(), "there is something to wait for");
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(start.elapsed() >= Duration::from_millis(90), "at rest");
}

#[test]
fn comparison_measures_are_the_pairs() {
    let mut session = sixteen_against_one(WINDOW);
    for key in ["r", "w", "d", "="] {
        session.keys(&[key]);
        let [a, b] = frames(&session);
        let pair = Pair::new(&a, &b).unwrap();
        let (measures, is_current) = session.viewer.both().measures().expect("measured");
        assert!(is_current, "of the pictures after {key}");
        assert_eq!(measures.levels, pair.levels(), "counts after {key}");
        assert_eq!(measures.places, pair.places(64), "places after {key}");
        let never = CancelToken::default();
        let seen = measures.seen.unwrap();
        assert_eq!(Some(seen.ssim), pair.ssim(&never), "SSIM after {key}");
        assert_eq!(Some(seen.flip), pair.flip(&never), "FLIP after {key}");
    }
    // Numbers of an older picture say so.
    let _ = session
        .viewer
        .apply(Command::View(ViewCommand::PanBy { by: dvec2(5.0, 5.0) }));
    assert!(
        session
            .viewer
            .both()
            .measures()
            .is_some_and(|(_, is_current)| !is_current),
        "stale"
    );
    session.viewer.finish();
    assert!(
        session
            .viewer
            .both()
            .measures()
            .is_some_and(|(_, is_current)| is_current),
        "found out anew"
    );
    session.run(Command::Ab(AbCommand::Compare(Against::Nothing)));
    assert!(session.viewer.both().measures().is_none(), "nothing is compared");
}

#[test]
fn comparison_measures_wait_for_rest() {
    let mut session = sixteen_against_one(WINDOW);
    let _ = session
        .viewer
        .apply(Command::View(ViewCommand::PanBy { by: dvec2(5.0, 5.0) }));
    let start = Instant::now();
    while !session
        .viewer
        .both()
        .measures()
        .is_some_and(|(_, is_current)| is_current)
    {
        let due = session.viewer.due();
        assert!(
            start.elapsed() < Duration::from_secs(20),
            "somebody measures in the end"
        );
        let wait = due.map_or(Duration::from_millis(5), |due| {
            due.saturating_duration_since(Instant::now())
        });
        std::thread::sleep(wait.min(Duration::from_millis(50)));
        session.viewer.poll();
    }
    assert!(
        start.elapsed() >= Duration::from_millis(100),
        "not while the hand moves"
    );
    session.viewer.finish();
    assert_eq!(session.viewer.due(), None, "nothing is left to wait for");
}

#[test]
fn comparison_goes_from_difference_to_difference() {
    let mut session = sixteen_against_one([320, 240]);
    let places: Vec<[u32; 2]> = session
        .viewer
        .both()
        .measures()
        .unwrap()
        .0
        .places
        .iter()
        .map(|place| place.at)
        .collect();
    assert!(places.len() > 3, "{places:?}");
    for place in places.iter().chain(places.first()) {
        session.keys(&["n"]);
        assert_eq!(
            session.viewer.pixels().pinned(),
            Some(*place),
            "the next, round and round"
        );
    }
    session.run(Command::Inspector(InspectorCommand::Unpin));
    // Asked for before anything is known of the new picture.
    let _ = session
        .viewer
        .apply(Command::View(ViewCommand::PanBy { by: dvec2(7.0, 2.0) }));
    let _ = session.viewer.apply(Command::Ab(AbCommand::NextDifference));
    session.viewer.finish();
    let first = session.viewer.both().measures().unwrap().0.places[0].at;
    assert_eq!(
        session.viewer.pixels().pinned(),
        Some(first),
        "the one that differs most of the new picture"
    );
    session.run(Command::Inspector(InspectorCommand::Unpin));
    session.run(set("sample-rate", "1"));
    session.keys(&["n"]);
    assert_eq!(session.viewer.pixels().pinned(), None, "nothing differs");
    let message = &session.viewer.chrome().messages().last().unwrap().text;
    assert!(message.contains("equal"), "{message}");
}
