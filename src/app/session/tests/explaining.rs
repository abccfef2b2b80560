//! The explanation of a pixel under the pointer: nothing moves or is cut, and what is told is of the samples that there are.

use std::path::PathBuf;

use egui::accesskit::Node;
use glam::{DVec2, dvec2};

use super::hands::{click, click_on, nodes, place_of, right_click, says, session};
use super::*;
use crate::viewer::script::Stage as _;

/// Width of the panel.
const PANEL: f64 = 312.0;
/// What stands beside the picture of the pixel while no sample is told.
const INVITATION: &str = "Point at a sample";

/// A place in the picture of the pixel, given in parts of its side.
fn in_pixel(session: &mut Session, [x, y]: [f64; 2]) -> DVec2 {
    let nodes = nodes(session);
    let words = nodes
        .iter()
        .find(|node| node.value().is_some_and(|text| text.starts_with(INVITATION)));
    let words = words.and_then(Node::bounds).expect("an explanation");
    // The picture is 132 points wide and stands eight points to the left of the words.
    dvec2(words.x0 - 140.0 + 132.0 * x, words.y0 + 132.0 * y)
}

fn explained(file: &str, rate: &str) -> Session {
    let scene = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("svg").join(file);
    let mut session = session(vec![scene], [1280, 800]);
    session.command(Command::set("sample-rate", rate).expect("a rate"));
    session.settle();
    right_click(&mut session, [700.0, 300.0]);
    assert!(session.viewer().inspector().explanation().is_some(), "explained");
    session
}

#[test]
fn chosen_sample_is_forgotten_with_the_samples_that_it_was_one_of() {
    let mut session = explained("basic/test4.svg", "16");
    let last = in_pixel(&mut session, [0.9, 0.9]);
    click(&mut session, last);
    session.pointer(Some(dvec2(700.0, 20.0)));
    session.settle();
    assert!(says(&mut session, "sample 16 at"), "the last of sixteen");
    session.command(Command::set("sample-rate", "4").expect("a rate"));
    session.settle();
    assert!(!says(&mut session, "sample 16 at"), "there are four");
    assert!(says(&mut session, INVITATION), "and none of them is chosen");
}

#[test]
fn pointing_at_a_sample_moves_nothing() {
    // Two hundred shapes lie over each other there.
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("deep.svg");
    let shape = |i: u32| format!("<rect width='800' height='800' fill='#{:06x}'/>", i * 1000);
    let shapes: String = (0..200).map(shape).collect();
    let document = format!("<svg xmlns='http://www.w3.org/2000/svg' width='800' height='800'>{shapes}</svg>");
    std::fs::write(&path, document).expect("a file");
    let mut session = explained(path.to_str().expect("a name"), "16");
    let before = place_of(&mut session, "Sample by sample");
    for part in [[0.1, 0.1], [0.6, 0.4]] {
        let at = in_pixel(&mut session, part);
        session.pointer(Some(at));
        session.settle();
        assert!(says(&mut session, "more over the background"), "told in short");
        assert_eq!(place_of(&mut session, "Sample by sample"), before, "under the pointer");
        session.pointer(Some(dvec2(700.0, 20.0)));
        session.settle();
    }
}

#[test]
fn explanation_of_a_texture_stays_in_its_panel() {
    for window in [[1280, 800], [1366, 768], [1920, 1080]] {
        let mut session = explained("texmap/test1.svg", "16");
        session.resize(window);
        session.settle();
        right_click(&mut session, [f64::from(window[0]) / 2.0, f64::from(window[1]) / 2.0]);
        let report = nodes(&mut session);
        let of_texture = |node: &&Node| node.value().is_some_and(|text| text.contains("level of detail"));
        let of_texture = report.iter().filter(of_texture).filter_map(Node::bounds);
        let widest = of_texture.map(|bounds| bounds.x1 - bounds.x0).fold(0.0, f64::max);
        assert!(
            widest > 0.0 && widest < PANEL - 16.0,
            "{widest} points wide in {window:?}"
        );
    }
}

#[test]
fn what_a_click_unfolds_comes_into_sight() {
    const FOLD: &str = "Sample by sample";
    let mut seen = 0;
    for height in (420..900).step_by(24) {
        let mut session = session(Vec::new(), [1280, height]);
        session.command(Command::set("sample-rate", "16").expect("a rate"));
        session.settle();
        right_click(&mut session, [900.0, 300.0]);
        let end = f64::from(height);
        let before = place_of(&mut session, FOLD).y;
        if !(end - 90.0..end - 50.0).contains(&before) {
            continue;
        }
        seen += 1;
        click_on(&mut session, FOLD);
        let after = place_of(&mut session, FOLD).y;
        assert!(
            after < before - 10.0 && after > 0.0,
            "{before}, then {after} of {height}"
        );
    }
    assert!(seen > 0, "a window in which the fold is the last that is to be seen");
}

#[test]
fn title_of_a_long_fold_stays_under_the_click_that_opens_it() {
    const FOLD: &str = "How samples became the colour";
    for window in [[1366, 768], [1280, 800], [1920, 1080]] {
        let mut session = session(Vec::new(), window);
        for (setting, value) in [("sample-rate", "64"), ("resolve-filter", "lanczos3")] {
            session.command(Command::set(setting, value).expect("a value"));
        }
        session.settle();
        right_click(&mut session, [550.0, 400.0]);
        session.wait(Duration::from_secs(10));
        session.settle();
        let before = place_of(&mut session, FOLD);
        assert!(before.y < f64::from(window[1]) / 2.0, "{before} in {window:?}");
        for turn in ["opened", "closed", "opened again"] {
            click_on(&mut session, FOLD);
            assert_eq!(place_of(&mut session, FOLD), before, "{turn} in {window:?}");
        }
    }
}
