//! Lines with a width: the outline of a stroke, to be filled by the non-zero rule.
//!
//! The outline comes from `kurbo`; its round parts are flattened here. It may cross itself, which the rule forgives.

use glam::DVec2;
use kurbo::{BezPath, Cap, Join, PathEl, Point, Stroke, StrokeOpts};

/// How far a flattened arc may be from the true one, in stroke widths.
const TOLERANCE: f64 = 1e-3;

/// Longest line that has an outline, in stroke widths: beyond, floats no longer tell its sides apart.
const LONGEST: f64 = 1e12;

/// How an open line ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LineCap {
    /// At its end point.
    #[default]
    Butt,
    /// In a half circle around its end point.
    Round,
    /// Half a width past its end point.
    Square,
}

/// What fills the outer side of a corner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LineJoin {
    /// The edges prolonged until they meet, up to the miter limit; else as [`LineJoin::Bevel`].
    #[default]
    Miter,
    /// A circle around the corner.
    Round,
    /// A straight cut.
    Bevel,
}

/// What turns a line into an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrokeStyle {
    /// In the units of the line's points, finite and above zero.
    pub width: f64,
    /// Of both ends.
    pub cap: LineCap,
    /// Of all corners.
    pub join: LineJoin,
    /// How many widths long a miter may be, at least 1.
    pub miter_limit: f64,
}

/// Closed contours around the stroke of the line through `points`, to be filled by the non-zero rule.
///
/// A closed line has a corner instead of ends. A line whose points all coincide is a dot if its caps are round or
/// square, and nothing otherwise, as in SVG. A line more than 10^12 times as long as it is wide has no outline.
///
/// # Tolerance
/// Arcs are within a thousandth of the width.
pub fn stroke_outline(points: &[DVec2], closed: bool, style: &StrokeStyle) -> Vec<Vec<DVec2>> {
    let mut line: Vec<DVec2> = Vec::with_capacity(points.len());
    for &point in points {
        if line.last() != Some(&point) {
            line.push(point);
        }
    }
    if closed && line.len() > 1 && line.first() == line.last() {
        line.pop();
    }
    match line.as_slice() {
        [] => Vec::new(),
        [dot] => outline_of_dot(*dot, style),
        [from, to] if closed => outline(&[*from, *to, *from], false, style),
        line => outline(line, closed, style),
    }
}

fn outline(line: &[DVec2], closed: bool, style: &StrokeStyle) -> Vec<Vec<DVec2>> {
    // The first point is the origin and the width is one, so that tolerances fit lines of any size.
    let Some(&origin) = line.first() else {
        return Vec::new();
    };
    let local = |p: &DVec2| (*p - origin) / style.width;
    if line
        .iter()
        .any(|p| local(p).abs().max_element() > LONGEST || local(p).is_nan())
    {
        return Vec::new();
    }
    let point = |p: &DVec2| Point::new(local(p).x, local(p).y);
    let mut path = BezPath::new();
    for (i, p) in line.iter().enumerate() {
        path.push(if i == 0 {
            PathEl::MoveTo(point(p))
        } else {
            PathEl::LineTo(point(p))
        });
    }
    if closed {
        path.close_path();
    }
    let cap = match style.cap {
        LineCap::Butt => Cap::Butt,
        LineCap::Round => Cap::Round,
        LineCap::Square => Cap::Square,
    };
    let join = match style.join {
        LineJoin::Miter => Join::Miter,
        LineJoin::Round => Join::Round,
        LineJoin::Bevel => Join::Bevel,
    };
    let stroke = Stroke::new(1.0)
        .with_caps(cap)
        .with_join(join)
        .with_miter_limit(style.miter_limit);
    let mut contours = contours(&kurbo::stroke(path, &stroke, &StrokeOpts::default(), TOLERANCE));
    for point in contours.iter_mut().flatten() {
        *point = origin + *point * style.width;
    }
    contours
}

/// A line without length.
fn outline_of_dot(center: DVec2, style: &StrokeStyle) -> Vec<Vec<DVec2>> {
    let radius = style.width / 2.0;
    let corner = |angle: f64, radius: f64| center + DVec2::from_angle(angle) * radius;
    match style.cap {
        LineCap::Butt => Vec::new(),
        LineCap::Square => {
            let offsets = [
                DVec2::new(-1.0, -1.0),
                DVec2::new(1.0, -1.0),
                DVec2::ONE,
                DVec2::new(-1.0, 1.0),
            ];
            vec![offsets.map(|offset| center + offset * radius).to_vec()]
        }
        LineCap::Round => {
            // The sagitta of one of 72 arcs is a thousandth of the radius.
            const ARCS: u32 = 72;
            let step = std::f64::consts::TAU / f64::from(ARCS);
            vec![(0..ARCS).map(|i| corner(f64::from(i) * step, radius)).collect()]
        }
    }
}

/// A path as contours of straight edges.
fn contours(path: &BezPath) -> Vec<Vec<DVec2>> {
    let mut contours: Vec<Vec<DVec2>> = Vec::new();
    kurbo::flatten(path, TOLERANCE, |element| match element {
        PathEl::MoveTo(p) => contours.push(vec![DVec2::new(p.x, p.y)]),
        PathEl::LineTo(p) => {
            if let Some(contour) = contours.last_mut() {
                contour.push(DVec2::new(p.x, p.y));
            }
        }
        // Flattening leaves straight lines; every contour closes itself.
        PathEl::ClosePath | PathEl::QuadTo(..) | PathEl::CurveTo(..) => {}
    });
    contours
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{FillRule, triangulate};

    const STYLE: StrokeStyle = StrokeStyle {
        width: 2.0,
        cap: LineCap::Butt,
        join: LineJoin::Miter,
        miter_limit: 4.0,
    };

    fn area(points: &[[f64; 2]], closed: bool, style: StrokeStyle) -> f64 {
        let points: Vec<DVec2> = points.iter().copied().map(DVec2::from).collect();
        let outline = stroke_outline(&points, closed, &style);
        let triangles = triangulate(&outline, FillRule::NonZero);
        triangles
            .iter()
            .map(|[a, b, c]| (b - a).perp_dot(c - a).abs() / 2.0)
            .sum()
    }

    #[test]
    fn stroke_outline_areas() {
        const PI: f64 = std::f64::consts::PI;
        let line = [[0.0, 0.0], [10.0, 0.0]];
        let corner = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]];
        let square = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
        let dot = [[3.0, 3.0], [3.0, 3.0]];
        let round = StrokeStyle {
            cap: LineCap::Round,
            ..STYLE
        };
        let square_cap = StrokeStyle {
            cap: LineCap::Square,
            ..STYLE
        };
        let round_join = StrokeStyle {
            join: LineJoin::Round,
            ..STYLE
        };
        let bevel = StrokeStyle {
            join: LineJoin::Bevel,
            ..STYLE
        };
        let short_miter = StrokeStyle {
            miter_limit: 1.0,
            ..STYLE
        };
        for (what, found, expected) in [
            ("butt", area(&line, false, STYLE), 20.0),
            ("round", area(&line, false, round), 20.0 + PI),
            ("square", area(&line, false, square_cap), 24.0),
            ("miter", area(&corner, false, STYLE), 40.0),
            ("round join", area(&corner, false, round_join), 39.0 + PI / 4.0),
            ("bevel", area(&corner, false, bevel), 39.5),
            ("miter beyond its limit", area(&corner, false, short_miter), 39.5),
            ("closed", area(&square, true, STYLE), 80.0),
            ("there and back", area(&line, true, STYLE), 20.0),
            ("no length, butt", area(&dot, false, STYLE), 0.0),
            ("no length, round", area(&dot, false, round), PI),
            ("no length, square", area(&dot, false, square_cap), 4.0),
            ("nothing", area(&[], false, round), 0.0),
        ] {
            assert!((found - expected).abs() < 0.01, "{what}: {found}, not {expected}");
        }
    }

    #[test]
    fn stroke_outline_survives_extremes() {
        for scale in [1e-30, 1e30] {
            for width in [1e-30, 1.0, 1e30] {
                let points = [DVec2::ZERO, DVec2::new(scale, 0.0), DVec2::new(scale, scale)];
                for cap in [LineCap::Butt, LineCap::Round] {
                    let style = StrokeStyle {
                        width,
                        cap,
                        join: LineJoin::Round,
                        miter_limit: 1e30,
                    };
                    let outline = stroke_outline(&points, false, &style);
                    let count: usize = outline.iter().map(Vec::len).sum();
                    assert!(count < 10_000, "{count} points at {scale}, {width}");
                }
            }
        }
    }
}
