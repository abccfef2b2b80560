//! What a hand finds while A and B share the window: pictures, panels and magnifiers stay where they are under it.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "inside the window"
)]

use std::path::PathBuf;

use egui::accesskit::Toggled;
use glam::dvec2;

use super::hands::{click, click_on, comparing, key, nodes, place_of, right_click, says, session};
use super::*;
use crate::color::ResolveSpace;
use crate::render::Visualisation;
use crate::viewer::script::Stage as _;
use crate::viewer::{
    AbCommand, Against, Arrangement, InspectorCommand, SceneCommand, Toggle, ViewCommand, WindowCommand,
};

/// The windows that a hand goes through.
pub(super) const WINDOWS: [[u32; 2]; 4] = [[800, 600], [1280, 800], [1366, 768], [1920, 1080]];

/// What closes the explanation.
pub(super) const CLOSE: &str = "Explanation";

/// A comparison side by side.
pub(super) fn side_by_side(window: [u32; 2]) -> Session {
    let mut session = comparing(window);
    session.command(Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)));
    session.settle();
    session
}

/// Columns of the part of the window that no panel covers, from left to right.
fn columns(session: &Session) -> Vec<f64> {
    const COUNT: usize = 9;
    let free = session.free_area.expect("there is room");
    let step = free.width as usize / COUNT;
    let all = (free.x + 6..free.right() - 6).step_by(step);
    all.map(|x| x as f64).collect()
}

#[test]
fn row_of_the_truth_shows_what_it_is_averaged_in() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::Ab(AbCommand::SetTruthSpace(Some(ResolveSpace::Linear))));
    session.command(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    let lit = |session: &mut Session| -> Vec<String> {
        session.settle();
        let nodes = nodes(session);
        let row = nodes.iter().filter(|node| node.toggled() == Some(Toggled::True));
        let names = row.filter_map(|node| node.label()?.strip_prefix("The truth averages: "));
        names.map(str::to_owned).collect()
    };
    assert_eq!(lit(&mut session), ["linear"], "as it was chosen for every truth");
    click_on(&mut session, "The truth averages: as A");
    assert_eq!(session.viewer.ab().truth_space(), None, "it is chosen anew");
    assert_eq!(lit(&mut session), ["as A"], "and shown");
}

#[test]
fn second_click_on_the_same_spot_unpins_side_by_side() {
    for window in WINDOWS {
        let mut session = side_by_side(window);
        let before = session.viewer.both().view_numbers();
        for x in columns(&session) {
            let at = [x, f64::from(window[1]) * 0.4];
            right_click(&mut session, at);
            assert!(session.viewer.pixels().explains(), "explained at {at:?} of {window:?}");
            right_click(&mut session, at);
            let pinned = session.viewer.pixels().pinned();
            assert_eq!(pinned, None, "unpinned at {at:?} of {window:?}");
            assert_eq!(session.viewer.both().view_numbers(), before, "{at:?} of {window:?}");
        }
    }
}

#[test]
fn clicked_pixel_stays_under_the_pointer_side_by_side() {
    for (window, all) in [
        ([1280, 800], &[300.0, 400.0, 500.0, 600.0, 750.0, 900.0, 990.0][..]),
        ([1366, 768], &[280.0, 400.0, 600.0, 700.0, 900.0, 1080.0]),
        ([1920, 1080], &[300.0, 700.0, 900.0, 1000.0, 1200.0, 1400.0, 1640.0]),
    ] {
        for x in all {
            let mut session = side_by_side(window);
            let at = [*x, 300.0];
            right_click(&mut session, at);
            let (hovered, pinned) = (session.viewer.pixels().hovered(), session.viewer.pixels().pinned());
            assert!(
                pinned.is_some() && hovered == pinned,
                "{pinned:?} pinned, {hovered:?} under the pointer at {at:?} of {window:?}"
            );
            let under = |place: &PixelRect| place.x == at[0] as i64 && place.y == at[1] as i64;
            assert!(
                session.viewer.pixels().pinned_places().iter().any(under),
                "{at:?} of {window:?}"
            );
        }
    }
}

#[test]
fn key_that_makes_b_says_that_it_is_shown() {
    let mut session = session(Vec::new(), WINDOWS[1]);
    key(&mut session, "b");
    session.settle();
    assert!(session.viewer().ab().shows_b(), "B instead of A");
    assert!(
        says(&mut session, "and is what you see"),
        "what settings change is not to be seen"
    );
    key(&mut session, "b");
    session.settle();
    assert!(!session.viewer().ab().shows_b(), "A again");
}

#[test]
fn another_view_of_both_moves_no_panel() {
    let buttons = [CLOSE, "Show: wipe", "Show: side", "Show: diff", "Show: flip", "Show: A"];
    for window in WINDOWS {
        for first in [Arrangement::Wipe, Arrangement::SideBySide, Arrangement::Difference] {
            for part in [0.1, 0.45, 0.9] {
                let mut session = comparing(window);
                session.command(Command::Ab(AbCommand::Arrange(first)));
                session.settle();
                let free = session.free_area.expect("there is room");
                let x = (free.x as f64 + f64::from(free.width) * part).round();
                right_click(&mut session, [x, 250.0]);
                let places = |session: &mut Session| buttons.map(|name| place_of(session, name));
                let before = places(&mut session);
                for name in ["Show: side", "Show: diff", "Show: side", "Show: wipe", "Show: A"] {
                    click_on(&mut session, name);
                    let now = places(&mut session);
                    assert_eq!(now, before, "{name} after {first:?} at {x} of {window:?}");
                    let free = session.free_area.expect("there is room");
                    let pins = session.viewer.pixels().pinned_places();
                    let in_sight = |pin: &PixelRect| free.contains([pin.x, pin.y]);
                    assert!(
                        !pins.is_empty() && pins.iter().all(in_sight),
                        "{pins:?} in {free:?} with {name} after {first:?} at {x} of {window:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn explanation_keeps_its_side_for_a_pin_that_leaves_a_half() {
    for window in WINDOWS {
        let mut session = comparing(window);
        session.command(Command::Ab(AbCommand::Arrange(Arrangement::Wipe)));
        session.pointer(Some(dvec2(500.0, 250.0)));
        for _ in 0..3 {
            session.wheel(3.0);
        }
        let free = session.free_area.expect("there is room");
        right_click(&mut session, [free.x as f64 + 12.0, 250.0]);
        let before = place_of(&mut session, CLOSE);
        for name in ["Show: side", "Show: diff", "Show: side"] {
            click_on(&mut session, name);
            assert!(
                says(&mut session, "canvas units"),
                "explained with {name} of {window:?}"
            );
            assert_eq!(place_of(&mut session, CLOSE), before, "{name} of {window:?}");
        }
    }
}

#[test]
fn double_click_on_close_leaves_the_pin() {
    for window in WINDOWS {
        for x in [290.0, 420.0] {
            let mut session = session(Vec::new(), window);
            right_click(&mut session, [x, 250.0]);
            let at = place_of(&mut session, CLOSE);
            for _ in 0..2 {
                click(&mut session, at);
                session.settle();
            }
            assert!(!session.viewer.pixels().explains(), "closed in {window:?}");
            assert!(session.viewer.pixels().pinned().is_some(), "still pinned in {window:?}");
        }
    }
}

#[test]
fn text_over_the_picture_leaves_legends_free() {
    for (window, arrangement) in [
        ([800, 600], Arrangement::Alone),
        ([800, 600], Arrangement::Flip),
        ([1920, 1080], Arrangement::SideBySide),
    ] {
        let mut session = session(Vec::new(), window);
        session.command(Command::set("visualise", Visualisation::Primitive.name()).expect("a value"));
        if arrangement != Arrangement::Alone {
            session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
            session.command(Command::Ab(AbCommand::Arrange(arrangement)));
        }
        right_click(&mut session, [500.0, 300.0]);
        let legends = session.viewer.frames().legend_places();
        assert!(!legends.is_empty(), "a legend in {window:?}");
        let labels = session.interface.labels();
        let labels: Vec<PixelRect> = labels.iter().map(|label| device_rect(*label)).collect();
        for label in &labels {
            let apart = legends.iter().all(|legend| !legend.overlaps(label));
            assert!(apart, "{label:?} over {legends:?} in {window:?} {arrangement:?}");
            let free = session.free_area.expect("there is room");
            let middle = free.x + i64::from(free.width / 2);
            let is_whole = label.x > middle || label.right() < middle;
            assert!(
                is_whole || arrangement != Arrangement::SideBySide,
                "{label:?} in both halves"
            );
        }
    }
}

/// A rectangle in points where a point is a pixel.
fn device_rect(rect: Rect) -> PixelRect {
    PixelRect {
        x: rect.left().floor() as i64,
        y: rect.top().floor() as i64,
        width: rect.width().ceil() as u32,
        height: rect.height().ceil() as u32,
    }
}

#[test]
fn text_over_the_picture_leaves_the_line_of_a_wipe_free() {
    for part in [0.0, 0.1, 0.2, 0.5] {
        let mut session = comparing([1280, 800]);
        session.command(Command::Ab(AbCommand::SetWipe(part)));
        session.command(Command::Inspector(InspectorCommand::Pin([700, 300])));
        session.settle();
        nothing_across_the_line(&session);
        // Beside the magnifiers, where their letters stand.
        let inset = session.viewer.inspector().inset().expect("there is room").rect;
        for x in [inset.x - 10, inset.right() + 10] {
            session.command(Command::Ab(AbCommand::SetWipe(x as f64 / 1280.0)));
            session.settle();
            nothing_across_the_line(&session);
        }
    }
}

fn nothing_across_the_line(session: &Session) {
    let line = session.interface.line();
    assert!(!line.is_empty(), "there is a line");
    for label in session.interface.labels() {
        let apart = line.iter().all(|part| !part.intersects(label.shrink(1.0)));
        assert!(apart, "{label:?} across {line:?}");
    }
}

#[test]
fn lesson_goes_back_only_where_there_is_a_step() {
    let mut session = session(vec![PathBuf::from("lesson:six-tasks")], [1280, 800]);
    let is_disabled = |session: &mut Session| {
        let nodes = nodes(session);
        let back = nodes.iter().find(|node| node.label() == Some("Previous scene"));
        back.expect("Back").is_disabled()
    };
    assert!(is_disabled(&mut session), "on the first step");
    session.command(Command::Scenes(SceneCommand::Next));
    session.settle();
    assert!(!is_disabled(&mut session), "on the second");
}

#[test]
fn lesson_explains_a_pixel_on_an_edge_in_every_window() {
    for window in [
        [640, 480],
        [800, 600],
        [1024, 768],
        [1280, 800],
        [1366, 768],
        [1600, 900],
        [1920, 1080],
        [2560, 1440],
    ] {
        let mut session = session(vec![PathBuf::from("lesson:six-tasks")], window);
        for _ in 0..2 {
            session.command(Command::Scenes(SceneCommand::Next));
            session.settle();
        }
        let explanation = session.viewer.inspector().explanation().expect("the step explains");
        let mut colors: Vec<[u8; 4]> = explanation.samples.iter().map(|sample| sample.bytes).collect();
        colors.sort_unstable();
        colors.dedup();
        assert!(colors.len() > 1, "only {colors:?} in {window:?}");
    }
}

#[test]
fn explanation_leaves_a_picture_from_outside_where_it_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let [empty, same] = ["empty.png", "same.png"].map(|name| folder.path().join(name));
    crate::figure::save_png(&Framebuffer::new(640, 400), &empty).expect("a file");
    let mut first = session(Vec::new(), WINDOWS[0]);
    first.command(Command::Ab(AbCommand::Compare(Against::File(empty.clone()))));
    first.settle();
    let own = first.viewer().frames().frame().expect("a picture");
    crate::figure::save_png(&own.pixels, &same).expect("a file");
    for window in WINDOWS {
        // Why a picture differs is guessed for seconds: once is enough for its words.
        let path = if window == WINDOWS[0] { &empty } else { &same };
        for arrangement in [Arrangement::Wipe, Arrangement::SideBySide] {
            let mut session = session(Vec::new(), window);
            session.command(Command::Ab(AbCommand::Compare(Against::File(path.clone()))));
            session.settle();
            session.command(Command::Ab(AbCommand::Arrange(arrangement)));
            session.settle();
            let free = session.free_area.expect("there is room");
            let [x, y] = [free.x + i64::from(free.width / 3), i64::from(window[1] / 2)].map(|at| at as f64);
            session.pointer(Some(dvec2(x, y)));
            let hovered = session.viewer().pixels().status().expect("a pixel").pixel;
            let place = |session: &Session| {
                session
                    .viewer()
                    .pixels()
                    .pinned_places()
                    .first()
                    .map(|place| (place.x, place.y))
            };
            right_click(&mut session, [x, y]);
            assert_eq!(
                session.viewer().pixels().pinned(),
                Some(hovered),
                "what was clicked in {window:?}"
            );
            if arrangement == Arrangement::Wipe {
                let under = (x as i64, y as i64);
                assert_eq!(place(&session), Some(under), "it stays under the pointer in {window:?}");
            }
            right_click(&mut session, [x, y]);
            assert_eq!(
                session.viewer().pixels().pinned(),
                None,
                "a second click unpins, {arrangement:?} in {window:?}"
            );
            assert_eq!(
                session.viewer().pixels().status().map(|status| status.pixel),
                Some(hovered),
                "and the picture is where it was, {arrangement:?} in {window:?}"
            );
        }
    }
}

#[test]
fn panel_says_whose_settings_it_has() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    assert!(!says(&mut session, "Sampling of A"), "there is no B");
    session.command(Command::Ab(AbCommand::Compare(Against::Settings)));
    session.settle();
    assert!(says(&mut session, "Sampling of A"), "whichever is to be seen");
}

#[test]
fn line_that_nobody_moved_leaves_both_pictures_room() {
    for window in [[1280, 800], [1366, 768], [1920, 1080]] {
        for x in [0.24, 0.6] {
            let mut session = comparing(window);
            session.command(Command::Ab(AbCommand::Arrange(Arrangement::Wipe)));
            session.settle();
            right_click(&mut session, [x * f64::from(window[0]), 90.0]);
            let free = session.free_area.expect("room");
            let line = session.viewer.both().wipe_line().expect("a line") - free.x as f64;
            let part = line / f64::from(free.width);
            assert!((0.29..0.71).contains(&part), "{part} of {free:?} in {window:?}");
            // A hand may put it nearer.
            session.command(Command::Ab(AbCommand::SetWipe(0.0)));
            session.settle();
            let line = session.viewer.both().wipe_line().expect("a line") - free.x as f64;
            assert!(line < 49.0, "{line} in {free:?}");
        }
    }
}

#[test]
fn next_difference_without_b_says_what_is_missing() {
    let mut session = session(Vec::new(), [1280, 800]);
    key(&mut session, "n");
    session.settle();
    assert!(session.viewer.ab().other().is_none(), "nothing begins by itself");
    assert!(says(&mut session, "no B yet"), "but the user is told");
    session.command(Command::Ab(AbCommand::Compare(Against::Settings)));
    session.settle();
    assert!(session.viewer.ab().other().is_some(), "B was asked for");
    assert!(!says(&mut session, "no B yet"), "which is true no more");
}

#[test]
fn side_by_side_and_back_moves_no_picture() {
    for window in WINDOWS {
        for x in [300.0, 600.0] {
            let mut session = session(Vec::new(), window);
            session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
            session.settle();
            right_click(&mut session, [x, 0.6 * f64::from(window[1])]);
            session.command(Command::Ab(AbCommand::Compare(Against::Truth(None))));
            session.wait(Duration::from_secs(10));
            session.settle();
            let before = session.viewer.both().view_numbers();
            let pin = session.viewer.pixels().pinned();
            session.command(Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)));
            session.settle();
            session.command(Command::Ab(AbCommand::Arrange(Arrangement::Wipe)));
            session.settle();
            assert_eq!(session.viewer.both().view_numbers(), before, "{x} in {window:?}");
            assert_eq!(session.viewer.pixels().pinned(), pin, "{x} in {window:?}");
        }
    }
}

#[test]
fn another_arrangement_keeps_the_middle_of_a_dragged_picture() {
    use Arrangement::{Alone, Difference, SideBySide, Wipe};
    for window in WINDOWS {
        for (first, pinned) in [(Wipe, false), (Wipe, true), (SideBySide, false), (SideBySide, true)] {
            let mut session = comparing(window);
            session.command(Command::Ab(AbCommand::Arrange(first)));
            session.command(Command::View(ViewCommand::PanBy { by: dvec2(33.0, -21.0) }));
            session.settle();
            if pinned {
                let free = session.free_area.expect("room");
                let middle = [free.x as f64 + f64::from(free.width) * 0.3, f64::from(window[1]) * 0.5];
                right_click(&mut session, middle);
                session.settle();
            }
            // The place in the middle of the free picture, and where samples lie in their pixels.
            let seen = |session: &Session| {
                let both = session.viewer.both();
                let view = both.view_numbers().expect("a scene");
                let frame = both.layout().frame_size();
                let ([corner, size], half) = (both.layout().free_part(), DVec2::from(frame.map(f64::from)) / 2.0);
                let middle = view.center + (corner + size / 2.0 - half) / view.scale;
                (middle, (half - view.center * view.scale).fract_gl(), view.scale)
            };
            let (middle, phase, scale) = seen(&session);
            let (view, pin) = (session.viewer.both().view_numbers(), session.viewer.pixels().pinned());
            for next in [Wipe, SideBySide, Difference, SideBySide, Alone, first] {
                session.command(Command::Ab(AbCommand::Arrange(next)));
                session.settle();
                let (now, now_phase, _) = seen(&session);
                let apart = (now - middle).abs() * scale;
                // An explained pixel near the edge of a narrow half comes into sight.
                assert!(
                    pinned || apart.max_element() <= 1.0,
                    "{apart} pixels, {first:?} to {next:?} in {window:?}"
                );
                let slip = (now_phase - phase).abs();
                let slip = slip.min(DVec2::ONE - slip);
                assert!(
                    slip.max_element() < 1e-6,
                    "{slip}, {first:?} to {next:?} in {window:?}, {pinned}"
                );
            }
            assert_eq!(
                session.viewer.both().view_numbers(),
                view,
                "{first:?} in {window:?}, {pinned}"
            );
            assert_eq!(session.viewer.pixels().pinned(), pin, "{first:?} in {window:?}");
        }
    }
}

#[test]
fn a_window_that_was_small_for_a_while_gives_back_the_view() {
    for window in [[1366, 768], [1920, 1080]] {
        let mut session = comparing(window);
        session.command(Command::View(ViewCommand::PanBy { by: dvec2(33.0, -21.0) }));
        session.settle();
        right_click(&mut session, [500.0, 300.0]);
        let (before, pin) = (session.viewer.both().view_numbers(), session.viewer.pixels().pinned());
        session.command(Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)));
        for size in [[1001, 707], window] {
            session.settle();
            session.resize(size);
        }
        session.settle();
        session.command(Command::Ab(AbCommand::Arrange(Arrangement::Wipe)));
        session.settle();
        assert_eq!(session.viewer.both().view_numbers(), before, "{window:?}");
        assert_eq!(session.viewer.pixels().pinned(), pin, "{window:?}");
    }
}

#[test]
fn words_over_the_picture_are_about_what_it_shows() {
    let mut session = session(Vec::new(), [1920, 1080]);
    for (name, value) in [("resolve-filter", "mitchell"), ("rules", "course")] {
        session.command(Command::set(name, value).expect("a value"));
    }
    right_click(&mut session, [700.0, 500.0]);
    session.command(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    session.wait(Duration::from_secs(10));
    session.command(Command::Ab(AbCommand::Arrange(Arrangement::Alone)));
    session.settle();
    let note = "The explanation is about A";
    assert!(!says(&mut session, note), "A fills the window");
    let is_high = |label: &Rect| label.height() > 40.0;
    assert!(session.interface.labels().iter().any(is_high), "the settings, in lines");
    session.command(Command::Ab(AbCommand::Swap));
    session.settle();
    assert!(session.viewer.ab().shows_b(), "B fills the window");
    assert!(says(&mut session, note), "and the explanation says that it is about A");
    let labels = session.interface.labels();
    assert!(
        !labels.iter().any(is_high),
        "no settings of A over the picture of B: {labels:?}"
    );
}

#[test]
fn status_line_tells_of_the_picture_that_is_seen() {
    let mut session = session(Vec::new(), [1920, 1080]);
    for name in ["r", "=", "="] {
        key(&mut session, name);
    }
    session.settle();
    let told = |session: &mut Session| {
        let nodes = nodes(session);
        ["B", "1\u{d7}", "9\u{d7}"].map(|word| nodes.iter().any(|node| node.value() == Some(word)))
    };
    assert_eq!(told(&mut session), [false, false, true], "A fills the window");
    session.command(Command::Ab(AbCommand::FlipByHand));
    session.settle();
    assert!(session.viewer.ab().shows_b());
    assert_eq!(told(&mut session), [true, true, false], "B does");
}
