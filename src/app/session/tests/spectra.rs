//! A spectrum under a hand: its choices, what is told of the wave that is pointed at, its stripes over the picture.

use std::path::{Path, PathBuf};

use egui::accesskit::Node;
use glam::dvec2;

use super::hands::{click_on, nodes, place_of, says, session};
use super::*;
use crate::compare::SpectrumOf;
use crate::viewer::script::Stage as _;
use crate::viewer::{AbCommand, Against};
use crate::viewer::{InspectorCommand, SpectrumCommand, SpectrumPart, Toggle};

const CLOSE: &str = "Close the spectrum";

fn floor() -> Vec<PathBuf> {
    vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/study/07_checker_floor.svg")]
}

fn open(session: &mut Session) {
    session.command(Command::Spectrum(SpectrumCommand::Show(Toggle::On)));
    session.settle();
}

#[test]
fn spectrum_is_read_by_hand_and_closed_by_its_button() {
    let mut session = session(floor(), [1280, 800]);
    open(&mut session);
    assert!(says(&mut session, "512 \u{d7} 512 pixels from"), "what was transformed");
    click_on(&mut session, "Spectrum of: scene");
    session.settle();
    assert_eq!(session.viewer.spectrum().of(), SpectrumOf::Scene, "another");
    let middle = place_of(&mut session, "Strength of each frequency") + dvec2(14.0, -7.0);
    session.pointer(Some(middle + dvec2(0.0, -80.0)));
    session.settle();
    assert!(says(&mut session, "Too fine for pixels: seen at"), "outside of the box");
    session.pointer(Some(middle + dvec2(3.0, 12.0)));
    session.settle();
    assert!(!says(&mut session, "Too fine for pixels"), "inside");
    assert!(says(&mut session, " dB"), "a wave");
    session.command(Command::Inspector(InspectorCommand::Pin([300, 500])));
    session.command(Command::Inspector(InspectorCommand::Explanation(Toggle::Off)));
    session.settle();
    click_on(&mut session, "Part: around the pin");
    session.settle();
    assert_eq!(session.viewer.spectrum().part(), SpectrumPart::Pin, "a part of it");
    assert!(says(&mut session, "128 \u{d7} 128 pixels from"), "so many");
    click_on(&mut session, CLOSE);
    assert!(!session.viewer.spectrum().is_open(), "closed");
}

#[test]
fn spectrum_of_a_texture_is_that_of_the_pin() {
    let mut session = session(floor(), [1280, 800]);
    session.command(Command::Spectrum(SpectrumCommand::Of(SpectrumOf::Texture)));
    session.command(Command::Inspector(InspectorCommand::Pin([300, 60])));
    session.settle();
    assert!(says(&mut session, "shows no texture"), "nothing is there");
    session.command(Command::Inspector(InspectorCommand::Pin([500, 500])));
    session.settle();
    assert!(says(&mut session, "level 0 of checker.png"), "the floor");
}

#[test]
fn spectrum_beside_b_says_whose_it_is() {
    let mut session = session(floor(), [1280, 800]);
    open(&mut session);
    assert!(!says(&mut session, "Spectrum of A"), "there is no B");
    session.command(Command::Ab(AbCommand::Compare(Against::Settings)));
    session.settle();
    assert!(says(&mut session, "Spectrum of A"), "A's");
    session.command(Command::Spectrum(SpectrumCommand::Of(SpectrumOf::Difference)));
    session.settle();
    assert!(says(&mut session, "A \u{2212} truth"), "not less B");
}

#[test]
fn card_of_a_spectrum_is_as_high_while_it_is_computed() {
    for window in [[640, 480], [1280, 800]] {
        let mut session = session(floor(), window);
        session.command(Command::Spectrum(SpectrumCommand::Show(Toggle::On)));
        // Of the texture of a pixel that shows none, nothing is found for certain.
        session.command(Command::Spectrum(SpectrumCommand::Of(SpectrumOf::Texture)));
        session.command(Command::Inspector(InspectorCommand::Pin([300, 5])));
        session.command(Command::Inspector(InspectorCommand::Explanation(Toggle::Off)));
        session.settle();
        assert!(says(&mut session, "shows no texture"), "nothing is found");
        let before = [CLOSE, "Spectrum of: scene"].map(|name| place_of(&mut session, name));
        session.command(Command::Spectrum(SpectrumCommand::Of(SpectrumOf::Scene)));
        session.settle();
        assert!(!says(&mut session, "shows no texture"), "something is");
        let after = [CLOSE, "Spectrum of: scene"].map(|name| place_of(&mut session, name));
        assert_eq!(before, after, "its buttons stay in {window:?}");
    }
}

#[test]
fn spectrum_of_nothing_has_no_wave_to_point_at() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/study/14_one_edge.svg");
    let mut session = session(vec![path], [900, 650]);
    for (name, value) in [("sample-rate", "256"), ("pattern", "hammersley")] {
        session.command(Command::set(name, value).expect("a value"));
    }
    session.command(Command::Spectrum(SpectrumCommand::Of(SpectrumOf::Difference)));
    session.settle();
    let nothing = "The frame is the truth here: no error";
    assert!(says(&mut session, nothing), "A is the truth");
    let middle = place_of(&mut session, "Strength of each frequency");
    session.pointer(Some(middle + dvec2(40.0, -20.0)));
    session.settle();
    assert!(says(&mut session, nothing), "whatever is pointed at");
    assert!(
        !says(&mut session, "-160 dB") && !says(&mut session, "no single wave"),
        "no error that is none"
    );
    session.command(Command::set("sample-rate", "4").expect("a value"));
    session.settle();
    assert!(!says(&mut session, nothing), "four samples are not the truth");
}

#[test]
fn narrow_card_of_a_spectrum_is_as_wide_as_its_frame() {
    let mut session = session(floor(), [1100, 700]);
    session.command(Command::Inspector(InspectorCommand::Pin([560, 440])));
    open(&mut session);
    let right = |name: &str, nodes: &[Node]| {
        let node = nodes
            .iter()
            .find(|node| [node.label(), node.value()].contains(&Some(name)));
        node.and_then(Node::bounds).map(|bounds| bounds.x1)
    };
    let nodes = nodes(&mut session);
    let legend = right("both", &nodes).expect("the legend");
    for name in [CLOSE, "Spectrum of: scene", "Part: around the pin"] {
        let end = right(name, &nodes).expect(name);
        assert!(
            (end - legend).abs() < 4.0,
            "{name} ends at {end}, the card's contents at {legend}"
        );
    }
}

#[test]
fn card_of_a_spectrum_finds_room_in_any_window() {
    for window in [[640, 480], [800, 600], [1280, 800], [1920, 1080]] {
        let mut session = session(floor(), window);
        open(&mut session);
        for pin in [None, Some([300, 300])] {
            if let Some(pin) = pin {
                session.command(Command::Inspector(InspectorCommand::Pin(pin)));
                session.settle();
            }
            let close = place_of(&mut session, CLOSE);
            let plot = place_of(&mut session, "Strength of each frequency");
            for at in [close, plot] {
                let [width, height] = window.map(f64::from);
                let inside = (0.0..width).contains(&at.x) && (0.0..height).contains(&at.y);
                assert!(inside, "{at} in {window:?}, pinned {pin:?}");
            }
        }
    }
}

/// Whether each of the parts of this name can be chosen.
fn parts(session: &mut Session, whole: &str) -> [Option<bool>; 2] {
    session.settle();
    let nodes = nodes(session);
    [whole, "Part: around the pin"].map(|name| {
        let node = nodes.iter().find(|node| node.label() == Some(name));
        node.map(|node| !node.is_disabled())
    })
}

#[test]
fn parts_of_a_spectrum_are_offered_where_there_are_some() {
    let mut session = session(floor(), [1280, 800]);
    open(&mut session);
    let (middle, whole) = ("Part: free middle", "Part: free picture");
    assert_eq!(parts(&mut session, middle), [Some(true), Some(false)], "no pin");
    session.command(Command::Inspector(InspectorCommand::Pin([500, 500])));
    assert_eq!(parts(&mut session, middle), [Some(true); 2], "a pin");
    session.command(Command::Spectrum(SpectrumCommand::Of(SpectrumOf::Texture)));
    assert_eq!(parts(&mut session, middle), [Some(false); 2], "a texture has none");
    let mut small = hands::session(floor(), [500, 400]);
    open(&mut small);
    assert_eq!(parts(&mut small, whole), [Some(true), Some(false)], "all of it");
}

#[test]
fn spectrum_is_of_pixels_that_no_panel_covers() {
    for window in [[640, 480], [900, 650], [1280, 800]] {
        let mut session = session(floor(), window);
        open(&mut session);
        for panel in [Toggle::Off, Toggle::On] {
            session.command(Command::Window(WindowCommand::Panel(panel)));
            session.settle();
            let found = session.viewer.spectrum().found().expect("a spectrum");
            let (region, free) = (found.analysis.region(), session.free_area.expect("room"));
            let x = i64::from(region.x)..=i64::from(region.right());
            let y = i64::from(region.y)..=i64::from(region.bottom());
            let columns = free.x..=free.right();
            let rows = free.y..=free.bottom();
            let is_inside = columns.contains(x.start())
                && columns.contains(x.end())
                && rows.contains(y.start())
                && rows.contains(y.end());
            assert!(is_inside, "{region:?} of {free:?} in {window:?}, panel {panel:?}");
            let left = x.start() - columns.start();
            let right = columns.end() - x.end();
            assert!(
                (left - right).abs() <= 1,
                "{left} and {right} columns beside it in {window:?}"
            );
        }
    }
}
