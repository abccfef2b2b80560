//! What morphological antialiasing did to a pixel after its samples were averaged, in numbers and in words.

use serde::Serialize;

use super::numbers::{hex, significant};
use crate::post::{self, FACTOR, Form, Neighbour, Pattern, SideTrace, THRESHOLD, Trace};
use crate::raster::Region;
use crate::render::{RenderSettings, Subject, Visualisation, resolved_part, widened};

/// What was done to the finished pixel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Smoothing {
    /// By what: `smaa`.
    pub by: &'static str,
    /// The colour before: straight red, green, blue, alpha.
    pub before: [u8; 4],
    /// And after.
    pub after: [u8; 4],
    /// The sides of the pixel, but for those at the frame's border.
    pub sides: Vec<PixelSide>,
    /// What the pixel consists of; empty where nothing was done.
    pub blended: Vec<Blended>,
}

/// A side of a pixel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PixelSide {
    /// `left`, `above`, `right` or `below`.
    pub side: &'static str,
    /// The colour there: straight red, green, blue, alpha.
    pub color: [u8; 4],
    /// How far the lumas are apart, `0.0..=1.0`.
    pub contrast: f64,
    /// The pattern that the edge is part of; `None` where it is no edge.
    pub edge: Option<EdgePattern>,
    /// The part of the pixel that lies beyond the line that the pattern stands for, `0.0..=1.0`.
    pub weight: f64,
}

/// The pattern that an edge is part of.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EdgePattern {
    /// The form of a line: `straight`, `L`, `U` or `Z`; or `diagonal`, for stairs of single pixels; or `other`, where a diagonal
    /// at another edge has taken care of this one.
    pub form: &'static str,
    /// How many pixels it goes on to the left or upwards, and to the right or downwards.
    pub lengths: [u8; 2],
    /// Whether it has a corner at an end, which takes away from the weight.
    pub corner: bool,
}

/// A pixel that is part of the smoothed one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Blended {
    /// `own`, `left`, `above`, `right` or `below`.
    pub pixel: &'static str,
    /// Its part; all parts are 1.
    pub weight: f64,
}

/// What was done to a pixel of a picture of `size` pixels; `None` where the settings do nothing.
pub(super) fn smoothing(subject: &Subject<'_>, size: [u32; 2], [x, y]: [u32; 2]) -> Option<Smoothing> {
    let values = subject.settings.smoothing()?;
    // It is the picture that is told of, whatever the settings show instead.
    let settings = RenderSettings {
        visualisation: Visualisation::Color,
        ..*subject.settings
    };
    let subject = Subject {
        settings: &settings,
        ..*subject
    };
    let around = widened(Region::of_pixel([x, y]), size);
    let at = [x.checked_sub(around.x)?, y.checked_sub(around.y)?];
    let part = resolved_part(&subject, size, around);
    let trace = post::trace(part.pixels(), [around.width, around.height], at, values)?;
    Some(Smoothing::new(&trace, settings.post_process.name()))
}

impl Smoothing {
    fn new(trace: &Trace, by: &'static str) -> Self {
        let blended = trace.blended.iter().map(|(neighbour, weight)| Blended {
            pixel: neighbour.name(),
            weight: *weight,
        });
        Self {
            by,
            before: straight(trace.before),
            after: straight(trace.after),
            sides: trace.sides.iter().map(PixelSide::new).collect(),
            blended: blended.collect(),
        }
    }

    /// What was found at the pixel, and what was made of it.
    pub(super) fn lines(&self) -> Vec<String> {
        let mut lines = vec![format!(
            "SMAA goes over the finished pixels. Before it, this one was {}.",
            channels(self.before)
        )];
        lines.extend(self.sides.iter().filter_map(PixelSide::line));
        if self.blended.is_empty() {
            lines.push(self.why_nothing().to_owned());
            return lines;
        }
        let parts: Vec<String> = self.blended.iter().map(|part| self.part(part)).collect();
        lines.extend(self.left_out());
        lines.push(format!("{} = {}", parts.join(" + "), channels(self.after)));
        lines.push(
            "How much is blended in is guessed from the form of the edges: no sample was taken there.".to_owned(),
        );
        lines
    }

    /// Why sides with a weight are not blended: SMAA blends across or down, whichever weighs more.
    fn left_out(&self) -> Option<String> {
        let is_blended = |side: &PixelSide| self.blended.iter().any(|part| part.pixel == side.side);
        let left_out = self.sides.iter().filter(|side| side.weight > 0.0 && !is_blended(side));
        let left_out: Vec<&str> = left_out.map(PixelSide::place).collect();
        (!left_out.is_empty()).then(|| {
            format!(
                "What lies {} is left out: a pixel is blended along one axis only, the one with the greatest weight.",
                left_out.join(" and ")
            )
        })
    }

    fn why_nothing(&self) -> &'static str {
        if self.sides.iter().all(|side| side.edge.is_none()) {
            "No side of it is an edge: it stays as it is."
        } else {
            "No line that could be guessed from its edges cuts it: it stays as it is."
        }
    }

    /// Such as `0.154 of the one above (#FFFFFF)`.
    fn part(&self, part: &Blended) -> String {
        let weight = significant(part.weight);
        match self.sides.iter().find(|side| side.side == part.pixel) {
            Some(side) => format!("{weight} of the one {} ({})", side.place(), hex(side.color)),
            None => format!("{weight} of itself"),
        }
    }
}

impl PixelSide {
    fn new(trace: &SideTrace) -> Self {
        Self {
            side: trace.neighbour.name(),
            color: straight(trace.pixel),
            contrast: trace.contrast,
            edge: trace.pattern.map(EdgePattern::new),
            weight: trace.weight,
        }
    }

    /// Where the neighbour is, in words.
    fn place(&self) -> &'static str {
        match self.side {
            side if side == Neighbour::Left.name() => "on the left",
            side if side == Neighbour::Right.name() => "on the right",
            side => side,
        }
    }

    /// What was found there; `None` where there is too little contrast for any.
    fn line(&self) -> Option<String> {
        if self.edge.is_none() && self.contrast < THRESHOLD {
            return None;
        }
        let found = match &self.edge {
            None => format!("no edge, as it differs by more than {FACTOR} times as much right beside"),
            Some(edge) => {
                let weight = match self.weight {
                    weight if weight > 0.0 => format!("; {} of the pixel lies beyond", significant(weight)),
                    _ => "; none of the pixel lies beyond".to_owned(),
                };
                format!("an edge, {}{weight}", edge.words())
            }
        };
        Some(format!(
            "{:5}  luma differs by {}: {found}",
            self.side,
            significant(self.contrast)
        ))
    }
}

impl EdgePattern {
    fn new(pattern: Pattern) -> Self {
        let (form, lengths, corner) = match pattern {
            Pattern::Line { lengths, form, corner } => (form.name(), lengths, corner),
            Pattern::Diagonal(lengths) => ("diagonal", lengths, false),
            Pattern::Taken => ("other", [0; 2], false),
        };
        Self { form, lengths, corner }
    }

    fn words(&self) -> String {
        let [before, after] = self.lengths;
        let long = format!(
            "{} long, {before} before and {after} after",
            u32::from(before) + u32::from(after) + 1
        );
        match self.form {
            "diagonal" => format!("part of a diagonal {long}"),
            "other" => "which a diagonal at its other edge takes care of".to_owned(),
            form if form == Form::Straight.name() => {
                format!("part of a line {long}, without an end that tells anything")
            }
            form => {
                let corner = if self.corner {
                    ", with a corner that stays sharp"
                } else {
                    ""
                };
                format!(
                    "part of a line {long}, in the form of a{} {form}{corner}",
                    if form == "L" { "n" } else { "" }
                )
            }
        }
    }
}

fn straight(pixel: u32) -> [u8; 4] {
    let [a, r, g, b] = pixel.to_be_bytes();
    [r, g, b, a]
}

/// Such as `red 1, green 2, blue 3`.
fn channels([r, g, b, a]: [u8; 4]) -> String {
    let alpha = if a == 255 {
        String::new()
    } else {
        format!(", alpha {a}")
    };
    format!("red {r}, green {g}, blue {b}{alpha}")
}
