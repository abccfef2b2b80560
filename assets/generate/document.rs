//! Writes scene documents: one element a line, numbers as short as their precision allows.

use std::fmt::Write as _;

use glam::DVec2;

use super::palette::Color;

/// A scene document that is being written.
#[derive(Debug)]
pub(crate) struct Document {
    text: String,
    decimals: usize,
    depth: usize,
}

/// Paint of a [`Document::shape`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Style {
    /// Inside, and how opaque.
    pub(crate) fill: Option<(Color, f64)>,
    /// Outline, and how opaque.
    pub(crate) stroke: Option<(Color, f64)>,
    /// Attributes beyond these, such as `stroke-width="3"`.
    pub(crate) more: &'static str,
}

impl Style {
    /// Opaque fill, no outline.
    pub(crate) fn fill(color: Color) -> Self {
        Self {
            fill: Some((color, 1.0)),
            ..Self::default()
        }
    }

    /// Opaque outline, no fill.
    pub(crate) fn stroke(color: Color) -> Self {
        Self {
            stroke: Some((color, 1.0)),
            ..Self::default()
        }
    }

    /// The same with an outline.
    pub(crate) fn outlined(self, color: Color) -> Self {
        Self {
            stroke: Some((color, 1.0)),
            ..self
        }
    }

    /// The same with this opacity of the fill.
    pub(crate) fn opacity(self, opacity: f64) -> Self {
        Self {
            fill: self.fill.map(|(color, _)| (color, opacity)),
            ..self
        }
    }

    /// The same with this opacity of the outline.
    pub(crate) fn stroke_opacity(self, opacity: f64) -> Self {
        Self {
            stroke: self.stroke.map(|(color, _)| (color, opacity)),
            ..self
        }
    }

    /// The same with further attributes.
    pub(crate) fn with(self, more: &'static str) -> Self {
        Self { more, ..self }
    }
}

impl Document {
    /// A document with a canvas of this size. `comment` says what to look at, a line each.
    pub(crate) fn new(width: f64, height: f64, comment: &[&str]) -> Self {
        let mut text = String::from("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!--\n");
        for line in comment {
            let _ = writeln!(text, "  {line}");
        }
        let (w, h) = (number(width, 3), number(height, 3));
        let _ = writeln!(
            text,
            "-->\n<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\">"
        );
        Self {
            text,
            decimals: 2,
            depth: 0,
        }
    }

    /// Decimals of the coordinates that follow; 2 at first.
    pub(crate) fn decimals(&mut self, decimals: usize) {
        self.decimals = decimals;
    }

    /// The finished text.
    pub(crate) fn finish(mut self) -> String {
        while self.depth > 0 {
            self.close();
        }
        self.text.push_str("</svg>\n");
        self.text
    }

    /// A line as it stands.
    pub(crate) fn raw(&mut self, line: &str) {
        for _ in 0..self.depth {
            self.text.push(' ');
        }
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Begins a group; `attributes` such as `transform="rotate(30)"`.
    pub(crate) fn open(&mut self, attributes: &str) {
        let blank = if attributes.is_empty() { "" } else { " " };
        self.raw(&format!("<g{blank}{attributes}>"));
        self.depth += 1;
    }

    /// Ends the last group.
    pub(crate) fn close(&mut self) {
        self.depth -= 1;
        self.raw("</g>");
    }

    /// A filled rectangle.
    pub(crate) fn rect(&mut self, corner: DVec2, size: DVec2, style: Style) {
        let [x, y, w, h] = [corner.x, corner.y, size.x, size.y].map(|v| number(v, self.decimals));
        let paint = paint(style);
        self.raw(&format!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"{paint}/>"
        ));
    }

    /// A closed shape.
    pub(crate) fn polygon(&mut self, points: &[DVec2], style: Style) {
        let (points, paint) = (self.list(points), paint(style));
        self.raw(&format!("<polygon points=\"{points}\"{paint}/>"));
    }

    /// A chain of lines.
    pub(crate) fn polyline(&mut self, points: &[DVec2], style: Style) {
        let (points, paint) = (self.list(points), paint(style));
        self.raw(&format!("<polyline points=\"{points}\"{paint}/>"));
    }

    /// A line.
    pub(crate) fn line(&mut self, ends: [DVec2; 2], style: Style) {
        let [x1, y1, x2, y2] = [ends[0].x, ends[0].y, ends[1].x, ends[1].y].map(|v| number(v, self.decimals));
        let paint = paint(style);
        self.raw(&format!(
            "<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"{paint}/>"
        ));
    }

    /// A triangle with a colour at each corner.
    pub(crate) fn color_triangle(&mut self, points: [DVec2; 3], colors: [Color; 3]) {
        let list = self.list(&points);
        let mut values = String::new();
        for color in colors {
            let [r, g, b] = color.0.map(|c| number(c, 3));
            let _ = write!(values, "{r} {g} {b} 1  ");
        }
        self.raw(&format!(
            "<colortri points=\"{list}\" colors=\"{}\"/>",
            values.trim_end()
        ));
    }

    /// Two triangles with a colour at each corner, corners in order round the quad.
    pub(crate) fn color_quad(&mut self, points: [DVec2; 4], colors: [Color; 4]) {
        let pick = |i: [usize; 3]| (i.map(|i| points[i]), i.map(|i| colors[i]));
        for corners in [[0, 1, 2], [0, 2, 3]] {
            let (points, colors) = pick(corners);
            self.color_triangle(points, colors);
        }
    }

    /// Names a texture of the folder `assets/textures`.
    pub(crate) fn texture(&mut self, id: &str, file: &str) {
        self.raw(&format!(
            "<texture texid=\"{id}\" filename=\"../../assets/textures/{file}\"/>"
        ));
    }

    /// A triangle of a texture.
    pub(crate) fn texture_triangle(&mut self, id: &str, points: [DVec2; 3], uv: [DVec2; 3]) {
        let list = self.list(&points);
        let uvs = uv.map(|p| format!("{} {}", number(p.x, 4), number(p.y, 4))).join(" ");
        self.raw(&format!("<textri texid=\"{id}\" uvs=\"{uvs}\" points=\"{list}\"/>"));
    }

    /// Two triangles of a texture, corners in order round the quad.
    pub(crate) fn texture_quad(&mut self, id: &str, points: [DVec2; 4], uv: [DVec2; 4]) {
        for corners in [[0, 1, 2], [0, 2, 3]] {
            self.texture_triangle(id, corners.map(|i| points[i]), corners.map(|i| uv[i]));
        }
    }

    fn list(&self, points: &[DVec2]) -> String {
        let pair = |p: &DVec2| format!("{},{}", number(p.x, self.decimals), number(p.y, self.decimals));
        points.iter().map(pair).collect::<Vec<_>>().join(" ")
    }
}

fn paint(style: Style) -> String {
    let mut text = String::new();
    for (name, value) in [("fill", style.fill), ("stroke", style.stroke)] {
        if let Some((color, opacity)) = value {
            let [r, g, b] = color.bytes();
            let _ = write!(text, " {name}=\"#{r:02X}{g:02X}{b:02X}\"");
            if opacity < 1.0 {
                let _ = write!(text, " {name}-opacity=\"{}\"", number(opacity, 3));
            }
        } else if name == "fill" && style.stroke.is_some() {
            text.push_str(" fill=\"none\"");
        }
    }
    if !style.more.is_empty() {
        text.push(' ');
        text.push_str(style.more);
    }
    text
}

/// `value` with at most so many decimals, no trailing zeros, no negative zero.
pub(crate) fn number(value: f64, decimals: usize) -> String {
    let mut text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    }
    if text == "-0" { "0".to_owned() } else { text }
}
