//! What the window shows of both, and what keys and the mouse do to it.

use std::time::Instant;

use glam::dvec2;
use rasterscope::compare::{DifferenceStyle, Gain, Measure, Pair};
use rasterscope::raster::Framebuffer;
use rasterscope::texture::PixelSampling;
use rasterscope::viewer::{
    AbCommand, Against, Arrangement, Command, Effect, ExportCommand, InspectorCommand, PixelRect, PixelZoom,
    PointerButton, PointerCommand, SceneCommand, Toggle, ViewCommand, WindowCommand,
};

use super::{WINDOW, frames, sixteen_against_one};
use crate::support::session::{Session, TRIANGLES};

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
fn what_is_said_of_b_goes_with_the_next_step() {
    for step in ["=", "r", "w", "d", "Shift+D"] {
        let mut session = Session::open(&[TRIANGLES], WINDOW);
        let says = |session: &Session| {
            let mut messages = session.viewer.chrome().messages().iter();
            messages.any(|message| message.text.starts_with("B keeps these settings"))
        };
        session.keys(&["r"]);
        assert!(says(&session), "what the first press did");
        session.keys(&[step]);
        assert!(!says(&session), "{step} is what it told of");
    }
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
    let tag = |session: &Session| {
        let tags = session.viewer.both().tags([0.0, 400.0], None);
        tags.first().map_or(String::new(), |tag| tag.text.clone())
    };
    assert_eq!(tag(&session), "B \u{2212} A, absolute: 0 \u{2026} 255 levels");
    for measure in Measure::ALL {
        style.measure = measure;
        session.run(Command::Ab(AbCommand::SetMeasure(measure)));
        shows(&session, style, measure.name());
    }
    style.gain = Gain::Factor(8.0);
    session.run(Command::Ab(AbCommand::SetGain(4.0)));
    session.run(Command::Ab(AbCommand::StepGain(1)));
    shows(&session, style, "a gain of 8");
    assert!(
        tag(&session).contains(" levels\u{b2} and more"),
        "the level of the last colour: {}",
        tag(&session)
    );
    style.gain = Gain::Normalize;
    session.keys(&["Shift+D"]);
    shows(&session, style, "normalised");
    assert!(
        !tag(&session).contains("more"),
        "no more than the largest: {}",
        tag(&session)
    );
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
    // The column that is left over belongs to the gap: B ends where the free area does.
    let second = 40 + 301 - 149;
    session.assert_frame_is_current();
    let window = session.viewer.window().picture();
    for y in 0..180 {
        for x in 0..149 {
            assert_eq!(window.rgba(40 + x, 10 + y), a.rgba(x, y), "A at {x}, {y}");
            assert_eq!(window.rgba(second + x, 10 + y), b.rgba(x, y), "B at {x}, {y}");
        }
    }
    for (at, pixel) in [([45.0, 12.0], [5, 2]), ([f64::from(second) + 7.0, 13.0], [7, 3])] {
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
        (301, 180),
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
    // Above, tags say which is whose.
    let below_tags = |(_, y, _): &(u32, u32, &image::Rgba<u8>)| *y >= 44;
    for (x, y, pixel) in wipe.enumerate_pixels().filter(below_tags) {
        let from = if x < 80 { &a } else { &b };
        assert_eq!(Some(pixel.0), from.rgba(x, y), "{x}, {y} of the wipe");
    }
    for (x, y, pixel) in difference.enumerate_pixels().filter(below_tags) {
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

#[test]
fn settings_that_change_behind_b_are_told() {
    let told = |session: &Session| {
        let messages = session.viewer.chrome().messages();
        let found = messages.iter().find(|message| message.text.starts_with("A changed"));
        found.map(|message| message.text.clone())
    };
    let mut session = sixteen_against_one(WINDOW);
    session.keys(&["="]);
    assert_eq!(told(&session), None, "A is seen");
    session.keys(&["b", "="]);
    let by_flip = told(&session).expect("a key that seems to do nothing");
    assert!(by_flip.ends_with("; press B to see A"), "{by_flip}");
    session.keys(&["b"]);
    assert_eq!(told(&session), None, "it is seen now");
    session.run(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    session.run(Command::Ab(AbCommand::Arrange(Arrangement::Alone)));
    session.keys(&["r"]);
    session.run(Command::Window(WindowCommand::NextTheme));
    assert_eq!(told(&session), None, "the theme is no picture's");
    session.keys(&["="]);
    let swapped = told(&session).expect("behind the truth");
    assert!(swapped.ends_with("; press R to see A"), "{swapped}");
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
