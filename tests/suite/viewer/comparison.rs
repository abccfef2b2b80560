//! A against B without a window: which settings each has, what the window shows of both, what Esc closes.

use rasterscope::viewer::{
    AbCommand, ExportCommand, InspectorCommand, PointerCommand, SceneCommand, ViewCommand, WindowCommand,
};
use std::path::PathBuf;
use std::time::{Duration, Instant};

use glam::dvec2;
use rasterscope::color::ResolveSpace;
use rasterscope::compare::{Cause, DifferencePaint, DifferenceStyle, Gain, Measure, Pair};
use rasterscope::figure::save_png;
use rasterscope::geometry::View;
use rasterscope::raster::{Framebuffer, SampleRate};
use rasterscope::render::{self, CancelToken, RenderSettings};
use rasterscope::texture::PixelSampling;
use rasterscope::viewer::script::{Script, ViewerStage, play};
use rasterscope::viewer::{
    Against, Arrangement, Command, Effect, MessageKind, Other, PixelRect, PixelZoom, PointerButton, Toggle,
};

use crate::support::session::{SQUARE, Session, TRIANGLES, set, step};

const WINDOW: [u32; 2] = [160, 120];

/// A at rate 16, B at rate 1.
fn sixteen_against_one(window: [u32; 2]) -> Session {
    let mut session = Session::open(&[TRIANGLES, SQUARE], window);
    session.keys(&["r"]);
    session.run(set("sample-rate", "16"));
    session
}

/// Both frames.
fn frames(session: &Session) -> [Framebuffer; 2] {
    let other = session.viewer.ab().other_pixels().unwrap().clone();
    [session.pixels().clone(), other]
}

#[test]
fn comparison_swaps_settings_and_frames() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    let one = session.pixels().clone();
    session.keys(&["r"]);
    assert_eq!(
        session.viewer.chrome().messages().len(),
        1,
        "the first press says what it did"
    );
    assert!(
        session.viewer.both().title().contains("A against B: the same settings"),
        "{}",
        session.viewer.both().title()
    );
    session.keys(&["=", "=", "=", "p"]);
    let sixteen = session.pixels().clone();
    assert!(sixteen != one, "keys change A");
    let title = session.viewer.both().title();
    assert!(
        title.starts_with("1.svg - A against B: sample rate 16 | 1, pixel sampling bilinear | nearest - "),
        "{title}"
    );
    for (front, back, rate) in [(&one, &sixteen, 1), (&sixteen, &one, 16), (&one, &sixteen, 1)] {
        session.keys(&["r"]);
        assert!(session.pixels() == front, "rate {rate} is on the screen");
        assert!(session.viewer.window().picture() == *front, "all of the window is A's");
        assert!(frames(&session)[1] == *back, "the other is B");
        assert_eq!(
            session.viewer.settings().render.sample_rate.samples(),
            rate,
            "its settings"
        );
        session.assert_frame_is_current();
    }
    assert_eq!(
        session.viewer.settings().render.pixel_sampling,
        PixelSampling::Nearest,
        "all settings"
    );
}

#[test]
fn comparison_keeps_view_and_scene_together() {
    let mut session = sixteen_against_one(WINDOW);
    session.keys(&["w"]);
    for command in [
        Command::View(ViewCommand::PanBy { by: dvec2(9.0, 4.0) }),
        Command::View(ViewCommand::ZoomAt { at: None, factor: 1.7 }),
        Command::View(ViewCommand::RotateBy { degrees: 20.0 }),
        Command::Scenes(SceneCommand::Next),
        Command::Window(WindowCommand::Resize([200, 90])),
        Command::View(ViewCommand::SetPixelZoom(PixelZoom::new(2).unwrap())),
    ] {
        session.run(command.clone());
        let [a, b] = frames(&session);
        session.assert_frame_is_current();
        session.keys(&["r"]);
        session.assert_frame_is_current();
        assert!(frames(&session) == [b, a], "B was as current as A after {command:?}");
        session.keys(&["r"]);
    }
}

#[test]
fn comparison_wipe_is_pixel_exact() {
    // A third of 160 window pixels are 54 frame pixels.
    for (zoom, columns) in [(1, [80, 0, 160, 40]), (3, [27, 0, 54, 14])] {
        let mut session = sixteen_against_one(WINDOW);
        session.run(Command::View(ViewCommand::SetPixelZoom(PixelZoom::new(zoom).unwrap())));
        session.run(Command::Ab(AbCommand::Arrange(Arrangement::Wipe)));
        for (part, column) in [0.5, 0.0, 1.0, 0.25].into_iter().zip(columns) {
            session.run(Command::Ab(AbCommand::SetWipe(part)));
            let [a, b] = frames(&session);
            assert_eq!(
                session.viewer.both().wipe_line(),
                Some(f64::from(column * zoom)),
                "the line"
            );
            let window = session.viewer.window().picture();
            for y in 0..WINDOW[1] {
                for x in 0..WINDOW[0] {
                    let from = if x / zoom < column { &a } else { &b };
                    assert_eq!(
                        window.rgba(x, y),
                        from.rgba(x / zoom, y / zoom),
                        "{x}, {y} at {part}, zoom {zoom}"
                    );
                }
            }
        }
    }
}

#[test]
fn comparison_line_is_dragged() {
    let mut session = sixteen_against_one(WINDOW);
    session.keys(&["w"]);
    let view = session.viewer.both().view_numbers();
    for command in [
        Command::Pointer(PointerCommand::Moved { at: dvec2(82.0, 60.0) }),
        Command::Pointer(PointerCommand::Pressed(PointerButton::Primary)),
        Command::Pointer(PointerCommand::Moved { at: dvec2(40.0, 70.0) }),
        Command::Pointer(PointerCommand::Released(PointerButton::Primary)),
        Command::Pointer(PointerCommand::Moved { at: dvec2(100.0, 70.0) }),
    ] {
        session.run(command);
    }
    assert_eq!(
        session.viewer.both().wipe_line(),
        Some(40.0),
        "the line went with the pointer until the button went up"
    );
    assert_eq!(session.viewer.both().view_numbers(), view, "the picture stayed");
    session.run(Command::Pointer(PointerCommand::Pressed(PointerButton::Primary)));
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(110.0, 70.0) }));
    assert_ne!(
        session.viewer.both().view_numbers(),
        view,
        "away from the line a drag moves the picture"
    );
    assert_eq!(session.viewer.both().wipe_line(), Some(40.0), "and not the line");
}

#[test]
fn comparison_difference_is_the_pairs_picture() {
    let mut session = sixteen_against_one(WINDOW);
    session.keys(&["d"]);
    let shows = |session: &Session, style: DifferenceStyle, what: &str| {
        let [a, b] = frames(session);
        let mut expected = Framebuffer::default();
        let gain = Pair::new(&a, &b).unwrap().show(style, &mut expected);
        assert!(session.viewer.window().picture() == expected, "{what}");
        assert_eq!(session.viewer.ab().difference_gain(), Some(gain), "{what}: the gain");
    };
    let mut style = DifferenceStyle::default();
    shows(&session, style, "absolute");
    for measure in Measure::ALL {
        style.measure = measure;
        session.run(Command::Ab(AbCommand::SetMeasure(measure)));
        shows(&session, style, measure.name());
    }
    style.gain = Gain::Factor(8.0);
    session.run(Command::Ab(AbCommand::SetGain(4.0)));
    session.run(Command::Ab(AbCommand::StepGain(1)));
    shows(&session, style, "a gain of 8");
    style.gain = Gain::Normalize;
    session.keys(&["Shift+D"]);
    shows(&session, style, "normalised");
    session.run(Command::View(ViewCommand::ZoomAt { at: None, factor: 1.4 }));
    shows(&session, style, "normalised anew for another view");
    session.keys(&["r"]);
    shows(&session, style, "normalised anew for the swapped pair");
    session.keys(&["Shift+D"]);
    style.gain = Gain::Factor(8.0);
    shows(&session, style, "back to the gain of before");
    session.run(Command::Ab(AbCommand::Normalize(Toggle::On)));
    style.gain = Gain::Factor(session.viewer.ab().difference_gain().unwrap() / 2.0);
    session.run(Command::Ab(AbCommand::StepGain(-1)));
    shows(&session, style, "half of the normalised gain");
    session.keys(&["d"]);
    assert!(session.viewer.window().picture() == *session.pixels(), "A alone again");
}

#[test]
fn comparison_side_by_side_shows_all_of_both() {
    let mut session = sixteen_against_one([400, 200]);
    session.run(Command::Window(WindowCommand::SetFreeArea(Some(PixelRect {
        x: 40,
        y: 10,
        width: 301,
        height: 180,
    }))));
    session.run(Command::Ab(AbCommand::ToggleArrangement(Arrangement::SideBySide)));
    let [a, b] = frames(&session);
    assert_eq!(
        [a.width(), a.height()],
        [149, 180],
        "half of the free area less the gap"
    );
    session.assert_frame_is_current();
    let window = session.viewer.window().picture();
    for y in 0..180 {
        for x in 0..149 {
            assert_eq!(window.rgba(40 + x, 10 + y), a.rgba(x, y), "A at {x}, {y}");
            assert_eq!(window.rgba(40 + 149 + 2 + x, 10 + y), b.rgba(x, y), "B at {x}, {y}");
        }
    }
    for (at, pixel) in [([45.0, 12.0], [5, 2]), ([40.0 + 151.0 + 7.0, 13.0], [7, 3])] {
        session.run(Command::Pointer(PointerCommand::Moved { at: at.into() }));
        assert_eq!(
            session.viewer.pixels().hovered(),
            Some(pixel),
            "the same pixel of both at {at:?}"
        );
    }
    // Zooming about a place in B's half keeps what is there.
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(260.5, 60.5) }));
    let before = session.viewer.pixels().status().unwrap().user;
    session.run(Command::Pointer(PointerCommand::Wheel { clicks: 2.0 }));
    let after = session.viewer.pixels().status().unwrap().user;
    assert!(after.abs_diff_eq(before, 1e-9), "{before} moved to {after}");
    session.run(Command::Export(ExportCommand::Screenshot));
    let saved = image::open(&session.pictures()[0]).unwrap().into_rgba8();
    assert_eq!(
        saved.dimensions(),
        (300, 180),
        "both and the gap, without what lies below the panels"
    );
}

#[test]
fn comparison_escape_leaves_the_mode_first_and_b_last() {
    let mut session = sixteen_against_one([400, 300]);
    session.run(Command::Inspector(InspectorCommand::Pin([20, 30])));
    session.keys(&["w", "d"]);
    let state = |session: &Session| {
        let viewer = &session.viewer;
        (
            viewer.ab().arrangement(),
            viewer.pixels().pinned().is_some(),
            viewer.inspector().magnifier().open,
            viewer.ab().other().is_some(),
        )
    };
    assert_eq!(
        state(&session),
        (Arrangement::Difference, true, true, true),
        "one arrangement at a time"
    );
    for expected in [
        (Arrangement::Alone, true, true, true),
        (Arrangement::Alone, false, true, true),
        (Arrangement::Alone, false, false, true),
        (Arrangement::Alone, false, false, false),
    ] {
        assert_eq!(session.run(Command::Window(WindowCommand::Escape)), [], "not yet");
        assert_eq!(state(&session), expected, "arrangement, pin, inspector, B");
    }
    assert!(session.viewer.ab().other_pixels().is_none(), "B's frame is let go");
    assert_eq!(
        session.run(Command::Window(WindowCommand::Escape)),
        [],
        "nothing is open any more: it asks"
    );
    assert_eq!(
        session.run(Command::Window(WindowCommand::Escape)),
        [Effect::Quit],
        "and ends"
    );
}

#[test]
fn comparison_saves_what_is_on_the_screen() {
    let mut session = sixteen_against_one(WINDOW);
    session.keys(&["w", "s", "d"]);
    let window = session.viewer.window().picture();
    session.keys(&["s"]);
    let [wipe, difference] = [0, 1].map(|i| image::open(&session.pictures()[i]).unwrap().into_rgba8());
    let [a, b] = frames(&session);
    for (x, y, pixel) in wipe.enumerate_pixels() {
        let from = if x < 80 { &a } else { &b };
        assert_eq!(Some(pixel.0), from.rgba(x, y), "{x}, {y} of the wipe");
    }
    for (x, y, pixel) in difference.enumerate_pixels() {
        assert_eq!(Some(pixel.0), window.rgba(x, y), "{x}, {y} of the difference");
    }
}

#[test]
fn comparison_inspects_both_at_the_same_pixel() {
    let mut session = sixteen_against_one([640, 480]);
    let [x, y] = session.viewer.both().measures().unwrap().0.places[0].at;
    session.run(Command::Inspector(InspectorCommand::Pin([x.into(), y.into()])));
    assert!(session.viewer.inspector().other_inset().is_none(), "A alone");
    session.keys(&["d"]);
    let (a, b) = (
        session.viewer.inspector().inset().unwrap(),
        session.viewer.inspector().other_inset().unwrap(),
    );
    assert_eq!(a.inset.center, b.inset.center, "the same pixel");
    let window = session.viewer.window().picture();
    let frames = frames(&session);
    let mut unequal = 0;
    for (placed, frame) in [(a, &frames[0]), (b, &frames[1])] {
        for x in x - 3..x + 3 {
            // The pixel in the middle may have its samples drawn over it.
            let y = y - 1;
            let block = placed.block([x.into(), y.into()]).unwrap();
            let middle = [
                block.x + i64::from(block.width) / 2,
                block.y + i64::from(block.height) / 2,
            ];
            let [u, v] = middle.map(|at| u32::try_from(at).unwrap());
            assert_eq!(window.rgba(u, v), frame.rgba(x, y), "pixel {x}, {y}");
            unequal += u32::from(frames[0].rgba(x, y + 1) != frames[1].rgba(x, y + 1));
        }
        let corner = placed.rect;
        session.run(Command::Pointer(PointerCommand::Moved {
            at: dvec2((corner.x + 20) as f64, (corner.y + 20) as f64),
        }));
        assert!(session.viewer.pixels().over_inset(), "both can be read");
        assert!(session.viewer.pixels().hovered().is_some(), "magnified pixels");
    }
    assert!(unequal > 0, "an edge runs there");
}

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

#[test]
fn comparison_flips_in_time() {
    let mut session = sixteen_against_one(WINDOW);
    let [a, b] = frames(&session);
    session.run(Command::Ab(AbCommand::ToggleArrangement(Arrangement::Flip)));
    assert!(session.viewer.window().picture() == a, "A first");
    let due = session.viewer.due().expect("something is to happen");
    std::thread::sleep(due.saturating_duration_since(Instant::now()));
    assert!(session.viewer.poll(), "it is time");
    assert!(session.viewer.window().picture() == b, "then B");
    session.run(Command::Window(WindowCommand::Escape));
    assert!(session.viewer.window().picture() == a, "A alone");
    assert_eq!(session.viewer.due(), None, "nothing to wait for");
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

#[test]
fn comparison_flips_by_hand() {
    let mut session = sixteen_against_one(WINDOW);
    let [a, b] = frames(&session);
    session.keys(&["b"]);
    assert!(session.viewer.window().picture() == b, "B, where A alone was");
    assert_eq!(session.viewer.due(), None, "until the key is pressed again");
    session.keys(&["b"]);
    assert!(session.viewer.window().picture() == a, "A");
    session.run(Command::Ab(AbCommand::ToggleArrangement(Arrangement::Flip)));
    session.run(Command::Ab(AbCommand::ToggleArrangement(Arrangement::Flip)));
    assert!(session.viewer.due().is_some(), "from alone both flip in time");
    session.keys(&["b"]);
    assert!(session.viewer.window().picture() == b, "the other of both");
    assert_eq!(session.viewer.due(), None, "a hand stops the time");
    session.run(Command::Window(WindowCommand::Escape));
    assert!(session.viewer.window().picture() == a, "A alone");
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
fn comparison_copies_both_colours() {
    let mut session = sixteen_against_one(WINDOW);
    let [x, y] = session.viewer.both().measures().unwrap().0.places[0].at;
    session.run(Command::Inspector(InspectorCommand::Pin([x.into(), y.into()])));
    let [r, g, b, _] = frames(&session)[1].rgba(x, y).unwrap();
    let effects = session.run(Command::Export(ExportCommand::CopyPixel));
    let [Effect::CopyText(text)] = effects.as_slice() else {
        panic!("{effects:?}")
    };
    assert!(text.ends_with(&format!("  B {r} {g} {b}")), "{text}");
}

#[test]
fn comparison_commands_open_b_by_themselves() {
    for key in ["w", "d", "Shift+D", "r"] {
        let mut session = Session::open(&[TRIANGLES], WINDOW);
        assert!(
            session.viewer.ab().other_pixels().is_none(),
            "nothing is drawn for nobody"
        );
        session.keys(&[key]);
        assert!(
            session.viewer.ab().other().is_some() && session.viewer.ab().other_pixels().is_some(),
            "{key} opens B"
        );
    }
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

#[test]
fn comparison_without_a_window_or_a_scene_ends() {
    let mut session = Session::open(&[TRIANGLES, "<svg"], WINDOW);
    session.run(Command::Window(WindowCommand::Resize([0, 0])));
    session.keys(&["r", "w", "n", "="]);
    session.run(Command::Window(WindowCommand::Resize(WINDOW)));
    session.assert_frame_is_current();
    assert!(session.viewer.ab().other_pixels().is_some(), "B too");
    session.run(Command::Scenes(SceneCommand::Next));
    session.keys(&["d", "r", "n", "w"]);
    assert!(
        session.viewer.ab().other_pixels().is_none(),
        "no picture of a scene that cannot be read"
    );
    session.run(Command::Scenes(SceneCommand::Previous));
    session.keys(&["d"]);
    session.assert_frame_is_current();
}

#[test]
fn comparison_with_the_truth() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    session.keys(&["p", "l", "t", "."]);
    session.run(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    assert_eq!(
        session.viewer.ab().arrangement(),
        Arrangement::Wipe,
        "to be seen at once"
    );
    let truth = RenderSettings {
        sample_rate: SampleRate::new(256).unwrap(),
        pixel_sampling: PixelSampling::Bilinear,
        ..RenderSettings::default()
    };
    assert_eq!(
        session.viewer.ab().other_settings(session.viewer.settings()),
        Some(truth),
        "level zero, no anisotropy, no bias, averaged as A"
    );
    let title = session.viewer.both().title();
    assert!(title.contains("A against the truth: sample rate 1 | 256"), "{title}");
    session.run(step("pixel-sampling", 1.0));
    let truth = RenderSettings {
        pixel_sampling: PixelSampling::Nearest,
        ..truth
    };
    assert_eq!(
        session.viewer.ab().other_settings(session.viewer.settings()),
        Some(truth),
        "textures are continued as in A"
    );
    let [a, b] = frames(&session);
    let entry = session.viewer.scene_list().current().unwrap();
    let scene = entry.scene().unwrap();
    let mut expected = Framebuffer::new(WINDOW[0], WINDOW[1]);
    let view = entry.camera.view().transform(scene.canvas, WINDOW);
    render::draw(scene, &view, &truth, &mut expected);
    assert!(b == expected, "what the renderer makes of 256 samples");
    session.run(Command::Window(WindowCommand::Escape));
    assert!(session.viewer.window().picture() == a, "A alone");
    session.keys(&["r"]);
    assert!(
        session.viewer.window().picture() == b,
        "R shows the truth in place of A"
    );
    assert_eq!(
        session.viewer.settings().render.sample_rate.samples(),
        1,
        "whose settings stay"
    );
    session.keys(&["="]);
    assert_eq!(
        session.viewer.settings().render.sample_rate.samples(),
        4,
        "and go on being changed"
    );
    session.keys(&["w"]);
    let window = session.viewer.window().picture();
    assert_eq!(window.rgba(79, 60), b.rgba(79, 60), "the truth on the left");
    assert_eq!(window.rgba(80, 60), session.pixels().rgba(80, 60), "A on the right");
    assert_eq!(session.run(Command::Window(WindowCommand::Escape)), [], "the wipe");
    assert!(
        session.viewer.window().picture() == *session.pixels(),
        "A in front again"
    );
}

#[test]
fn truth_averages_as_a_does_unless_asked() {
    use ResolveSpace::{Linear, Stored};
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    let psnr = |session: &Session| {
        let [a, b] = frames(session);
        Pair::new(&a, &b).unwrap().levels().psnr()
    };
    for own in ResolveSpace::ALL {
        session.run(set("resolve", own.name()));
        session.run(set("sample-rate", "64"));
        let mut ratios = Vec::new();
        for (text, resolve) in [("truth", own), ("truth stored", Stored), ("truth linear", Linear)] {
            session.run(Command::Ab(AbCommand::Compare(Against::from_text(text).unwrap())));
            assert_eq!(
                session
                    .viewer
                    .ab()
                    .other_settings(session.viewer.settings())
                    .unwrap()
                    .resolve,
                resolve,
                "{text}"
            );
            let [_, told] = session.viewer.ab().sides(session.viewer.settings()).unwrap();
            let words = if resolve == Linear {
                "linear light"
            } else {
                "stored values"
            };
            assert!(told.contains(words), "{text}: {told}");
            ratios.push(psnr(&session));
        }
        let other = if own == Stored { ratios[2] } else { ratios[1] };
        assert!(
            ratios[0] > other + 3.0,
            "{own:?}: the same values leave sampling alone: {ratios:?}"
        );
    }
    session.run(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    session.run(set("resolve", Stored.name()));
    assert_eq!(
        session
            .viewer
            .ab()
            .other_settings(session.viewer.settings())
            .unwrap()
            .resolve,
        Stored,
        "it follows A"
    );
}

/// A picture of [`TRIANGLES`] with four samples per pixel, in the session's folder.
fn picture_of_rate_four(session: &Session, size: [u32; 2]) -> (PathBuf, Framebuffer) {
    let scene = session.viewer.scene_list().current().unwrap().scene().unwrap();
    let settings = RenderSettings {
        sample_rate: SampleRate::new(4).unwrap(),
        ..RenderSettings::default()
    };
    let mut picture = Framebuffer::new(size[0], size[1]);
    let view = View::Default.transform(scene.canvas, size);
    render::draw(scene, &view, &settings, &mut picture);
    let path = session.folder.path().join("theirs.png");
    save_png(&picture, &path).unwrap();
    (path, picture)
}

#[test]
fn comparison_with_a_picture_from_outside() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    let (path, picture) = picture_of_rate_four(&session, [90, 70]);
    // Dropped on the window.
    session.run(Command::Scenes(SceneCommand::Open(vec![path])));
    assert_eq!(session.viewer.scene_list().scenes().len(), 1, "a picture is no scene");
    assert_eq!(
        session.viewer.both().layout().frame_size(),
        [90, 70],
        "A takes its size"
    );
    session.assert_frame_is_current();
    assert!(
        *session.viewer.ab().other_pixels().unwrap() == picture,
        "B is the picture"
    );
    let title = session.viewer.both().title();
    assert!(
        title.contains("A against theirs.png: sample rate 1, pixel sampling nearest"),
        "{title}"
    );
    let guess = session.viewer.both().measures().unwrap().0.guess.clone().unwrap();
    assert_eq!(
        guess.causes,
        [Cause::SampleRate(SampleRate::new(4).unwrap())],
        "why it differs"
    );
    session.keys(&["="]);
    let (measures, is_current) = session.viewer.both().measures().unwrap();
    assert!(is_current && measures.levels.differing() == 0, "then nothing does");
    assert_eq!(measures.guess, None, "and there is nothing to guess");
    // Both in the middle of the window, (160 - 90) / 2 and (120 - 70) / 2 pixels from its corner.
    session.run(Command::Window(WindowCommand::Escape));
    let shows = |session: &Session, [left, top]: [u32; 2], what: &str| {
        let window = session.viewer.window().picture();
        for (x, y) in [(0, 0), (17, 40), (45, 35), (60, 12)] {
            let shown = window.rgba(left + x, top + y);
            assert_eq!(shown, session.pixels().rgba(x, y), "{what}: {x}, {y}");
        }
    };
    shows(&session, [35, 25], "in the middle");
    let beside = session.viewer.window().picture().rgba(34, 40);
    assert_eq!(beside, Some([128, 128, 128, 255]), "grey beside it");
    let view = session.viewer.both().view_numbers();
    session.run(Command::View(ViewCommand::PanBy { by: dvec2(-5.0, 12.0) }));
    shows(&session, [30, 37], "moved by the hand");
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(47.0, 77.0) }));
    assert_eq!(session.viewer.pixels().hovered(), Some([17, 40]), "read where it is");
    session.run(Command::Pointer(PointerCommand::Wheel { clicks: 1.0 }));
    assert_eq!(session.viewer.settings().pixel_zoom.factor(), 2, "the wheel magnifies");
    assert_eq!(session.viewer.pixels().hovered(), Some([17, 40]), "about the pointer");
    assert_eq!(
        session.viewer.both().view_numbers(),
        view,
        "the scene's view stays: it is the picture's"
    );
    session.run(Command::Ab(AbCommand::Compare(Against::Nothing)));
    assert_eq!(
        session.viewer.both().layout().frame_size(),
        [80, 60],
        "the window's size again, at a zoom of 2"
    );
}

#[test]
fn comparison_with_what_is_no_picture_says_so() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    session.keys(&["r"]);
    let folder = session.folder.path().to_owned();
    let start = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff\x08\x06\0\0\0";
    std::fs::write(folder.join("huge.png"), [&start[..], &[0; 20]].concat()).unwrap();
    std::fs::write(folder.join("text.png"), "no picture").unwrap();
    std::fs::create_dir(folder.join("folder.png")).unwrap();
    for name in ["huge.png", "text.png", "folder.png", "nowhere.png"] {
        let before = session.viewer.chrome().messages().last().map(|message| message.id);
        session.run(Command::Ab(AbCommand::Compare(Against::File(folder.join(name)))));
        let message = session.viewer.chrome().messages().last().unwrap();
        assert!(before < Some(message.id), "{name} is told");
        assert_eq!(message.kind, MessageKind::Error, "{name}");
        assert!(
            message.text.contains(name) && !message.text.contains('\n'),
            "{}",
            message.text
        );
        assert!(message.text.contains("give a"), "the cure: {}", message.text);
        let kept = matches!(session.viewer.ab().other(), Some(Other::Settings { .. }));
        assert!(kept, "B stays after {name}");
    }
}

#[test]
fn comparison_newest_picture_wins() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    let (path, _) = picture_of_rate_four(&session, [90, 70]);
    let _ = session
        .viewer
        .apply(Command::Ab(AbCommand::Compare(Against::File(path.clone()))));
    let _ = session
        .viewer
        .apply(Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)));
    let _ = session.viewer.apply(Command::Ab(AbCommand::Swap));
    session.viewer.finish();
    assert!(
        matches!(session.viewer.ab().other(), Some(Other::Picture(_))),
        "what is being read becomes B"
    );
    assert_eq!(
        session.viewer.ab().arrangement(),
        Arrangement::SideBySide,
        "arranged as asked meanwhile"
    );
    let _ = session
        .viewer
        .apply(Command::Ab(AbCommand::Compare(Against::File(path))));
    let _ = session
        .viewer
        .apply(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    session.viewer.finish();
    assert_eq!(
        session.viewer.ab().other(),
        Some(&Other::Truth(None)),
        "what was asked for last"
    );
}

#[test]
fn comparison_by_a_script() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    let (path, _) = picture_of_rate_four(&session, [90, 70]);
    let text = format!(
        "against settings; rate 16; arrange difference; difference signed; gain 4; normalize on
        truth; wipe 0.25; against \"{}\"; next-difference; side",
        path.display()
    );
    let script = Script::parse(&text, "s").unwrap();
    play(&script, "s", &mut ViewerStage::new(&mut session.viewer)).unwrap();
    assert!(
        matches!(session.viewer.ab().other(), Some(Other::Picture(_))),
        "the last B"
    );
    assert_eq!(
        session.viewer.ab().arrangement(),
        Arrangement::SideBySide,
        "the last arrangement"
    );
    let style = session.viewer.ab().difference_style();
    assert_eq!(
        (style.measure, style.gain),
        (Measure::Signed, Gain::Normalize),
        "the style"
    );
    assert_eq!(
        session.viewer.pixels().pinned_difference(),
        Some(0),
        "where they differ most"
    );
}
