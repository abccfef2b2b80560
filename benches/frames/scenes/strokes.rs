//! Lines of thousands of segments, thinner than two pixels: a coast and a measured series.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use glam::DVec2;
use rasterscope::scene::{DialectChoice, NoResources, ReadOptions, Scene, read};

use super::chance::Chance;

/// A line in black on a canvas.
#[derive(Debug)]
pub(crate) struct StrokeScene {
    /// What lines of its width are called.
    pub(crate) kind: &'static str,
    /// What tables call it.
    pub(crate) name: &'static str,
    /// Width and height in user units, in the proportions of the frame.
    pub(crate) canvas: [f64; 2],
    /// Its corners in user units.
    pub(crate) points: Vec<[f64; 2]>,
    /// Whether the last corner is joined to the first.
    pub(crate) closed: bool,
    /// In user units; none of a hairline, which is one pixel wide.
    pub(crate) width: Option<f64>,
}

/// Height of every canvas in user units: a unit is about one and a half pixels.
const HEIGHT: f64 = 700.0;

/// Times that the coast's edges are broken.
const LEVELS: u32 = 5;

/// Segments of the series.
const STEPS: u32 = 4000;

/// The lines of the table in all widths, for frames of `size` pixels.
pub(crate) fn all(size: [u32; 2]) -> Vec<StrokeScene> {
    let canvas = [HEIGHT * f64::from(size[0]) / f64::from(size[1]), HEIGHT];
    let lines = [("coast", coast(canvas), true), ("series", series(canvas), false)];
    let widths = [("strokes", Some(1.0)), ("fine", Some(0.2)), ("hairlines", None)];
    let scenes = widths.iter().flat_map(|(kind, width)| {
        lines.iter().map(|(name, points, closed)| StrokeScene {
            kind,
            name,
            canvas,
            points: points.clone(),
            closed: *closed,
            width: *width,
        })
    });
    scenes.collect()
}

impl StrokeScene {
    fn svg(&self) -> String {
        let [width, height] = self.canvas;
        let element = if self.closed { "polygon" } else { "polyline" };
        let mut text = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='{width}' height='{height}' viewBox='0 0 {width} {height}'>\
             <{element} fill='none' stroke='#000000' stroke-width='{}' points='",
            self.width.unwrap_or(1.0)
        );
        for [x, y] in &self.points {
            let _ = write!(text, "{x},{y} ");
        }
        text.push_str("'/></svg>");
        text
    }

    /// The scene as the program reads it. Strokes are hairlines in the dialect `course` alone.
    pub(crate) fn read(&self) -> Scene {
        let dialect = match self.width {
            Some(_) => DialectChoice::Svg,
            None => DialectChoice::Course,
        };
        read(self.svg().as_bytes(), self.name, ReadOptions { dialect }, &NoResources).expect("a good document")
    }
}

/// Koch's curve around a triangle: 3072 segments.
fn coast(canvas: [f64; 2]) -> Vec<[f64; 2]> {
    let center = DVec2::from_array(canvas) / 2.0;
    let corner = |i: u32| center + DVec2::from_angle(TAU * (f64::from(i) / 3.0 - 0.25)) * HEIGHT * 0.47;
    let mut points: Vec<DVec2> = (0..3).map(corner).collect();
    for _ in 0..LEVELS {
        let edges = points.iter().zip(points.iter().cycle().skip(1));
        points = edges
            .flat_map(|(from, to)| {
                let third = (to - from) / 3.0;
                let out = DVec2::from_angle(-TAU / 6.0).rotate(third);
                [*from, from + third, from + third + out, to - third]
            })
            .collect();
    }
    points.iter().map(DVec2::to_array).collect()
}

/// A value that wanders around the middle, from the left edge to the right.
fn series([width, height]: [f64; 2]) -> Vec<[f64; 2]> {
    let mut chance = Chance::new(51);
    let mut value = 0.0;
    (0..=STEPS)
        .map(|step| {
            value = 0.99 * value + chance.range(-20.0, 20.0);
            [width * f64::from(step) / f64::from(STEPS), height / 2.0 + value]
        })
        .collect()
}
