//! Capital letters and figures of single strokes, drawn for this project.
//!
//! A glyph is a list of strokes on a grid 4 wide and 6 high; each pair of digits is a point `xy`, y down, baseline at 6.

use glam::{DVec2, dvec2};

use super::canvas::Canvas;
use super::palette::Color;
use super::steady::{TAU, polar, turned};

/// Where a text goes: its middle on the baseline.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Baseline {
    /// A straight line through a point, turned by an angle in radians.
    Straight { at: DVec2, angle: f64 },
    /// A circle, read clockwise from outside; the middle of the text lies at `angle`.
    Circle { center: DVec2, radius: f64, angle: f64 },
}

/// How letters look.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pen {
    /// Height of a capital in texels.
    pub(crate) height: f64,
    /// Line width in texels.
    pub(crate) width: f64,
    /// Blank between letters, in units of a sixth of the height.
    pub(crate) tracking: f64,
    /// Ink.
    pub(crate) color: Color,
}

impl Pen {
    /// Letters of this height with a line and blanks that suit it.
    pub(crate) fn new(height: f64, color: Color) -> Self {
        Self {
            height,
            width: (height / 7.5).max(0.95),
            tracking: 1.6,
            color,
        }
    }

    /// The same with wide blanks.
    pub(crate) fn spaced(self, tracking: f64) -> Self {
        Self { tracking, ..self }
    }
}

/// The length that `text` takes on its baseline, in texels.
pub(crate) fn length(text: &str, pen: Pen) -> f64 {
    let units: f64 = text.chars().map(|c| width(c) + pen.tracking).sum();
    (units - pen.tracking).max(0.0) * pen.height / 6.0
}

/// Writes `text`.
pub(crate) fn write(canvas: &mut Canvas, text: &str, baseline: Baseline, pen: Pen) {
    let scale = pen.height / 6.0;
    let mut x = -length(text, pen) / 2.0;
    for letter in text.chars() {
        for stroke in strokes(letter).split_ascii_whitespace() {
            let points: Vec<DVec2> = stroke
                .as_bytes()
                .chunks_exact(2)
                .map(|pair| dvec2(f64::from(pair[0] - b'0'), f64::from(pair[1] - b'0') - 6.0))
                .map(|p| place(baseline, x, p * scale, width(letter) * scale))
                .collect();
            canvas.stroke(&points, pen.width, pen.color);
        }
        x += (width(letter) + pen.tracking) * scale;
    }
}

/// From a letter's own frame, `x` along the baseline, to the picture.
fn place(baseline: Baseline, x: f64, p: DVec2, width: f64) -> DVec2 {
    match baseline {
        Baseline::Straight { at, angle } => at + turned(dvec2(x + p.x, p.y), angle),
        Baseline::Circle { center, radius, angle } => {
            // Each letter stands upright on the circle at its own middle.
            let middle = angle + (x + width / 2.0) / radius;
            center + polar(radius, middle) + turned(dvec2(p.x - width / 2.0, p.y), middle + TAU / 4.0)
        }
    }
}

fn width(letter: char) -> f64 {
    match letter {
        'I' | '.' | ',' | '\'' | ':' | '!' => 1.0,
        ' ' | '1' | '-' => 2.0,
        'J' | 'L' | 'E' | 'F' => 3.4,
        _ => 4.0,
    }
}

const fn strokes(letter: char) -> &'static str {
    match letter {
        'A' => "062046 1333",
        'B' => "06003041423303 3344453606",
        'C' => "4130100105163645",
        'D' => "06003041453606",
        'E' => "40000646 0333",
        'F' => "400006 0333",
        'G' => "413010010516364543 4323",
        'H' => "0006 4046 0343",
        'I' => "0006",
        'J' => "3035261605",
        'K' => "0006 4003 1346",
        'L' => "000636",
        'M' => "0600234046",
        'N' => "06004640",
        'O' => "100105163645413010",
        'P' => "06003041423303",
        'Q' => "100105163645413010 2446",
        'R' => "06003041423303 2346",
        'S' => "413010010213334445361605",
        'T' => "0040 2026",
        'U' => "000516364540",
        'V' => "002640",
        'W' => "0016233640",
        'X' => "0046 4006",
        'Y' => "002340 2326",
        'Z' => "00400646",
        '0' => "100105163645413010 0541",
        '1' => "011016",
        '2' => "01103041420646",
        '3' => "004013334445361605",
        '4' => "36300444",
        '5' => "400003334445361605",
        '6' => "3020020516364544331304",
        '7' => "004016",
        '8' => "100102133342413010 130405163645443313",
        '9' => "1626444130100102133342",
        '-' => "0323",
        '+' => "0343 2125",
        '.' => "0506",
        ',' => "0507",
        ':' => "0202 0505",
        '\'' => "0001",
        '/' => "0640",
        '*' => "2125 0343 0244 0442",
        '!' => "0004 0606",
        _ => "",
    }
}
