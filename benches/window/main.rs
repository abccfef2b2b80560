//! What the window costs: the release program under Xvfb, 1920x1080 pixels, and a hand on its mouse and keys.
//!
//! `cargo bench --bench window` plays all; `-- drag hover` only these; `-- svg/texmap/test5.svg anisotropy=16` with
//! another scene and other options of the program; `RASTERSCOPE_PROGRAM` names another build of it. The program writes
//! down every picture that it shows (`--frame-log`); this reads it and prints median, 95th percentile and maximum. Leave
//! the machine alone meanwhile: X server, hand and program share its processors.

#![expect(clippy::unwrap_used, reason = "a measurement that cannot be made has failed")]
#![expect(clippy::print_stdout, reason = "what it is for")]

#[expect(dead_code, reason = "it has what the tests need, too")]
#[path = "../../tests/window/desktop.rs"]
mod desktop;
mod hand;
mod log;
mod report;

use hand::{Hand, Play};

/// The largest of the gallery's textured scenes, larger than the window.
const SCENE: &str = "svg/texmap/test6.svg";
const OPTIONS: [&str; 4] = [
    "sample-rate=16",
    "pixel-sampling=bilinear",
    "level-sampling=linear",
    "view=500,500,1.92",
];

/// Something to measure.
struct Measurement {
    name: &'static str,
    /// What the hand does.
    does: &'static str,
    /// What it starts with.
    script: Option<&'static str>,
    play: Play,
}

impl Measurement {
    const fn new(name: &'static str, does: &'static str, script: Option<&'static str>, play: Play) -> Self {
        Self {
            name,
            does,
            script,
            play,
        }
    }
}

/// All that is measured, in order.
const MEASUREMENTS: [Measurement; 10] = [
    Measurement::new("drag", "drags the picture, 125 motions a second", None, Hand::drag),
    Measurement::new(
        "stutter",
        "drags and rests by turns: refinements begin and are given up",
        None,
        Hand::stutter,
    ),
    Measurement::new("zoom", "turns the wheel, 60 clicks a second", None, Hand::zoom),
    Measurement::new(
        "inspector",
        "drags with a pixel pinned and explained",
        Some("pin 700,540; key z"),
        Hand::drag,
    ),
    Measurement::new(
        "lesson",
        "drags with a lesson open",
        Some("lesson lesson:anisotropy"),
        Hand::drag,
    ),
    Measurement::new(
        "wipe",
        "drags with A and B on both sides of a line",
        Some("against sample-rate 4; arrange wipe"),
        Hand::drag,
    ),
    Measurement::new("status", "moves over the picture", None, Hand::status),
    Measurement::new("hover", "moves over the panel", None, Hand::hover),
    Measurement::new(
        "palette",
        "opens the palette, types into it, closes it",
        None,
        Hand::palette,
    ),
    Measurement::new("tick", "ticks a box of the panel", None, Hand::tick),
];

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let is_scene = |word: &&String| word.contains('/') && !word.contains('=');
    let scene = words.iter().find(is_scene);
    let scene = scene.map_or(SCENE, String::as_str);
    let mut options: Vec<&str> = OPTIONS.to_vec();
    for word in words.iter().filter(|word| word.contains('=')) {
        let name = word.split('=').next();
        options.retain(|option| option.split('=').next() != name);
        options.push(word);
    }
    let named: Vec<&String> = words
        .iter()
        .filter(|word| !is_scene(word) && !word.contains('='))
        .collect();
    println!("{scene}, {}, 1920x1080\n", options.join(", "));
    report::head();
    let options: Vec<String> = options.iter().map(|option| format!("--{option}")).collect();
    for measurement in &MEASUREMENTS {
        if named.is_empty() || named.iter().any(|name| *name == measurement.name) {
            let mut hand = Hand::start(scene, &options, measurement.script);
            let spans = (measurement.play)(&mut hand);
            report::rows(measurement, &hand.lines(), &spans);
        }
    }
}
