//! Paths of lines and curves: what a shape's outline is before it is flattened for a view.
//!
//! A path is filled, or its stroke is ([`Stroke`]). Both end as contours of straight edges that are as near to the curve as
//! the view asks for ([`CurvedArea::flattened`]). Flattening by distance and dashes are `kurbo`'s, outlines of strokes
//! [`super::stroke_outline`]'s.

use glam::{DAffine2, DVec2};
use kurbo::{BezPath, PathEl, PathSeg, Point};

use super::curve_steps::{Fineness, Step, Walk, keep_area, leaving};
use super::{LineCap, LineJoin, StrokeStyle, stroke_outline};

/// Longest path that has a stroke, in its widths: beyond, floats no longer tell its sides apart.
const LONGEST: f64 = 1e12;

/// Most dashes of a path; with more of them it is drawn without gaps.
const MAX_DASHES: f64 = 200_000.0;

/// Length of a dash that is to be a dot, in widths.
const SHORTEST_DASH: f64 = 1e-6;

/// About the most points of a flattened area; what would have more is flattened more coarsely.
const MAX_POINTS: f64 = 4_000_000.0;

/// Subpaths of lines, quadratic and cubic Bézier curves, in coordinates of its own. All coordinates are finite.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path(BezPath);

/// What a path covers: its inside, or its stroke; in user space.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvedArea {
    /// In its own coordinates.
    pub path: Path,
    /// Its stroke, whose style is given in the path's own units; `None` for the inside of the path.
    pub stroke: Option<Stroke>,
    /// The path's own coordinates to user space.
    pub to_user: DAffine2,
}

/// How a path is stroked.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Width, caps and joins.
    pub style: StrokeStyle,
    /// Lengths of dashes and gaps by turns, none negative; empty for a line without gaps.
    pub dashes: Vec<f64>,
    /// How far into the pattern of dashes the line begins.
    pub dash_offset: f64,
}

impl Path {
    /// Begins a subpath.
    pub fn move_to(&mut self, to: DVec2) {
        self.0.move_to(point(to));
    }

    /// A straight line from where the path has come to; [`Path::move_to`] must have been called before, as for all that
    /// follow.
    pub fn line_to(&mut self, to: DVec2) {
        self.0.line_to(point(to));
    }

    /// A quadratic curve with one control point.
    pub fn quad_to(&mut self, control: DVec2, to: DVec2) {
        self.0.quad_to(point(control), point(to));
    }

    /// A cubic curve with two control points.
    pub fn cubic_to(&mut self, controls: [DVec2; 2], to: DVec2) {
        let [first, second] = controls.map(point);
        self.0.curve_to(first, second, point(to));
    }

    /// Closes the subpath.
    pub fn close(&mut self) {
        self.0.close_path();
    }

    /// The same path in other coordinates.
    #[must_use]
    pub fn transformed(&self, to: DAffine2) -> Self {
        Self(kurbo::Affine::new(to.to_cols_array()) * &self.0)
    }

    /// Whether it has no segments.
    pub fn is_empty(&self) -> bool {
        self.0.segments().next().is_none()
    }

    /// How many segments it has.
    pub fn segments(&self) -> usize {
        self.0.elements().len()
    }

    /// Whether all its segments are straight, so that flattening changes nothing.
    pub fn is_straight(&self) -> bool {
        let curved = |element: &PathEl| matches!(element, PathEl::QuadTo(..) | PathEl::CurveTo(..));
        !self.0.elements().iter().any(curved)
    }

    /// Its contours with straight edges as near to the curves as is asked for.
    fn contours(&self, fineness: Fineness) -> Vec<Vec<DVec2>> {
        match fineness {
            Fineness::Distance(most) => self.contours_near(most),
            Fineness::Area { .. } => self.contours_of_same_area(fineness),
        }
    }

    /// Its contours with straight edges that enclose what the curves enclose.
    fn contours_of_same_area(&self, fineness: Fineness) -> Vec<Vec<DVec2>> {
        let (mut contours, mut contour) = (Vec::new(), Vec::new());
        let (mut tangents, mut areas) = (Vec::new(), Vec::new());
        let mut start = DVec2::ZERO;
        for element in self.0.elements() {
            let at = contour.last().copied().unwrap_or(start);
            let curve = match *element {
                PathEl::MoveTo(to) => {
                    contours.push(std::mem::take(&mut contour));
                    start = vector(to);
                    contour.push(start);
                    continue;
                }
                PathEl::ClosePath => {
                    contours.push(std::mem::take(&mut contour));
                    continue;
                }
                PathEl::LineTo(to) => {
                    if contour.is_empty() {
                        contour.push(start);
                    }
                    contour.push(vector(to));
                    continue;
                }
                PathEl::QuadTo(control, to) => {
                    let [control, to] = [control, to].map(vector);
                    [at, at.lerp(control, 2.0 / 3.0), to.lerp(control, 2.0 / 3.0), to]
                }
                PathEl::CurveTo(first, second, to) => [at, vector(first), vector(second), vector(to)],
            };
            let Some(tangent) = leaving(curve) else {
                continue;
            };
            if contour.is_empty() {
                contour.push(start);
            }
            let begin = contour.len() - 1;
            tangents.clear();
            tangents.push(tangent);
            let mut walk = Walk {
                fineness,
                half: 0.0,
                at,
                tangent,
                visit: |step| {
                    let (to, tangent) = match step {
                        Step::To(to, tangent)
                        | Step::Cusp {
                            to, direction: tangent, ..
                        } => (to, tangent),
                    };
                    contour.push(to);
                    tangents.push(tangent);
                },
            };
            walk.along(curve);
            keep_area(&mut contour[begin..], &tangents, &mut areas);
        }
        contours.push(contour);
        contours
    }

    /// Its contours with straight edges that are nowhere further than `tolerance` from the curves.
    fn contours_near(&self, tolerance: f64) -> Vec<Vec<DVec2>> {
        let mut contours: Vec<Vec<DVec2>> = Vec::new();
        kurbo::flatten(&self.0, tolerance, |element| match element {
            PathEl::MoveTo(to) => contours.push(vec![DVec2::new(to.x, to.y)]),
            PathEl::LineTo(to) => {
                if let Some(contour) = contours.last_mut() {
                    contour.push(DVec2::new(to.x, to.y));
                }
            }
            // Flattening leaves straight lines; every contour closes itself.
            PathEl::ClosePath | PathEl::QuadTo(..) | PathEl::CurveTo(..) => {}
        });
        contours
    }
}

impl CurvedArea {
    /// Whether its contours are the same at every tolerance.
    pub fn is_straight(&self) -> bool {
        let round = |stroke: &Stroke| stroke.style.cap == LineCap::Round || stroke.style.join == LineJoin::Round;
        self.path.is_straight() && !self.stroke.as_ref().is_some_and(round)
    }

    /// Closed contours in user space whose edges are as near to the area's border as is asked for in canvas units; a stroke's
    /// are to be filled by the non-zero rule.
    pub fn flattened(&self, fineness: Fineness) -> Vec<Vec<DVec2>> {
        let matrix = self.to_user.matrix2;
        let stretch = matrix.x_axis.length().max(matrix.y_axis.length());
        let own = fineness.scaled(stretch.recip(), matrix.determinant().abs().recip());
        if !own.is_valid() {
            return Vec::new();
        }
        let own = own.with_fewer_steps((self.points_at(own) / MAX_POINTS).max(1.0));
        if !own.is_valid() {
            return Vec::new();
        }
        let mut contours = match &self.stroke {
            None => self.path.contours(own),
            Some(stroke) => stroke.outline(&self.path, own),
        };
        for point in contours.iter_mut().flatten() {
            *point = self.to_user.transform_point2(*point);
        }
        contours
    }

    /// About how many points the contours have at a fineness in the path's own units; rather too many than too few.
    fn points_at(&self, fineness: Fineness) -> f64 {
        let segments = self.path.segments() as f64;
        let sum = |each: &dyn Fn(PathSeg) -> f64| self.path.0.segments().map(each).sum::<f64>();
        let curves = sum(&|segment| points_of(&segment, fineness));
        let Some(stroke) = &self.stroke else {
            return segments + curves;
        };
        let half_circle = stroke_outline::edges_of_half_circle(fineness.in_units(stroke.style.width));
        let round = stroke.style.cap == LineCap::Round || stroke.style.join == LineJoin::Round;
        // A half circle at each end and corner.
        let arc = if round { half_circle } else { 0.0 };
        let dashes = if stroke.dashes.is_empty() {
            0.0
        } else {
            stroke.dash_count(&self.path).min(MAX_DASHES)
        };
        2.0 * (curves + half_circle * sum(&|segment| turn_of(&segment))) + (segments + 2.0 * dashes) * (4.0 + arc)
    }
}

impl Stroke {
    /// Whether the dashes are so many that they are left out.
    pub fn is_too_fine(&self, path: &Path) -> bool {
        let count = self.dash_count(path);
        !self.dashes.is_empty() && (count.is_nan() || count > MAX_DASHES)
    }

    /// How many dashes and gaps there are along a path.
    fn dash_count(&self, path: &Path) -> f64 {
        let period: f64 = self.dashes.iter().sum();
        // Control polygons are longer than their curves, and cost nothing to measure.
        let length: f64 = path.0.segments().map(|segment| control_length(&segment)).sum();
        length * (self.dashes.len() as f64) / period
    }

    /// Contours of the stroke in the path's own coordinates.
    fn outline(&self, path: &Path, fineness: Fineness) -> Vec<Vec<DVec2>> {
        let width = self.style.width;
        let Some(origin) = path.0.elements().first().and_then(PathEl::end_point) else {
            return Vec::new();
        };
        // The first point is the origin and the width is one, so that tolerances fit lines of any size.
        let local = kurbo::Affine::scale(1.0 / width) * kurbo::Affine::translate(-origin.to_vec2());
        let path_in_widths = local * &path.0;
        let reach = |point: Point| point.x.abs().max(point.y.abs());
        if path_in_widths.control_box().union_pt(Point::ORIGIN).is_nan()
            || path_in_widths
                .elements()
                .iter()
                .filter_map(PathEl::end_point)
                .any(|end| reach(end).is_nan() || reach(end) > LONGEST)
        {
            return Vec::new();
        }
        let fineness = fineness.in_units(width).between(1e-9, 0.25);
        let mut contours = Vec::new();
        let mut lines = BezPath::new();
        for subpath in subpaths(&path_in_widths) {
            match dot(subpath) {
                Some(center) => contours.extend(self.dot(center, fineness)),
                None => lines.extend(subpath.iter().copied()),
            }
        }
        match self.dashes_in_widths(path) {
            Some((offset, pattern)) => {
                let dashes = kurbo::dash(lines.into_iter(), offset, &pattern);
                stroke_outline::append(dashes, &self.style, fineness, &mut contours);
            }
            None => stroke_outline::append(lines, &self.style, fineness, &mut contours),
        }
        for point in contours.iter_mut().flatten() {
            *point = DVec2::new(origin.x, origin.y) + *point * width;
        }
        contours
    }

    /// How far into the pattern of dashes and gaps the line begins, and the pattern, unless the line has no gaps.
    fn dashes_in_widths(&self, path: &Path) -> Option<(f64, Vec<f64>)> {
        if self.dashes.is_empty() || self.is_too_fine(path) {
            return None;
        }
        // An odd number of lengths is gone through twice.
        let twice = if self.dashes.len() % 2 == 1 { 2 } else { 1 };
        let width = self.style.width;
        // A dash without length has caps, and a direction for them.
        let pattern: Vec<f64> = (0..twice)
            .flat_map(|_| &self.dashes)
            .map(|length| (length / width).max(SHORTEST_DASH))
            .collect();
        let period: f64 = pattern.iter().sum();
        Some(((self.dash_offset / width).rem_euclid(period), pattern))
    }

    /// A subpath without length, in widths.
    fn dot(&self, center: Point, fineness: Fineness) -> Option<Vec<DVec2>> {
        let center = DVec2::new(center.x, center.y);
        match self.style.cap {
            LineCap::Butt => None,
            LineCap::Square => Some(stroke_outline::square_dot(center)),
            LineCap::Round => Some(stroke_outline::round_dot(center, fineness)),
        }
    }
}

/// About how many points a segment needs, rather too many than too few: the error of one edge falls with the square of its
/// length, and is an eighth of the curve's second derivative at first.
fn points_of(segment: &PathSeg, fineness: Fineness) -> f64 {
    let bend = |a: Point, b: Point, c: Point| (a.to_vec2() - 2.0 * b.to_vec2() + c.to_vec2()).hypot();
    let second = match segment {
        PathSeg::Line(_) => return 0.0,
        PathSeg::Quad(curve) => 2.0 * bend(curve.p0, curve.p1, curve.p2),
        PathSeg::Cubic(curve) => 6.0 * bend(curve.p0, curve.p1, curve.p2).max(bend(curve.p1, curve.p2, curve.p3)),
    };
    let by_distance = |most: f64| (second / (8.0 * most)).sqrt();
    match fineness {
        Fineness::Distance(most) => by_distance(most).ceil(),
        // No derivative is longer than three times all legs.
        Fineness::Area { area, distance } => {
            let by_area = (3.0 * control_length(segment) * second / (8.0 * area)).cbrt();
            by_area.min(by_distance(distance)).ceil() + 1.0
        }
    }
}

/// By how much a segment turns at most, in half circles.
fn turn_of(segment: &PathSeg) -> f64 {
    let curve = match segment {
        PathSeg::Line(_) => return 0.0,
        PathSeg::Quad(curve) => curve.raise(),
        PathSeg::Cubic(curve) => *curve,
    };
    let legs = [curve.p1 - curve.p0, curve.p2 - curve.p1, curve.p3 - curve.p2];
    let angle = |a: kurbo::Vec2, b: kurbo::Vec2| a.cross(b).atan2(a.dot(b)).abs();
    (angle(legs[0], legs[1]) + angle(legs[1], legs[2])) / std::f64::consts::PI
}

/// The length of the lines between a segment's control points.
fn control_length(segment: &PathSeg) -> f64 {
    match segment {
        PathSeg::Line(line) => line.p0.distance(line.p1),
        PathSeg::Quad(curve) => curve.p0.distance(curve.p1) + curve.p1.distance(curve.p2),
        PathSeg::Cubic(curve) => {
            curve.p0.distance(curve.p1) + curve.p1.distance(curve.p2) + curve.p2.distance(curve.p3)
        }
    }
}

/// The subpaths of a path.
fn subpaths(path: &BezPath) -> impl Iterator<Item = &[PathEl]> {
    let elements = path.elements();
    elements
        .chunk_by(|_, next| !matches!(next, PathEl::MoveTo(_)))
        .filter(|subpath| subpath.len() > 1)
}

/// Where a subpath lies that has no length.
fn dot(subpath: &[PathEl]) -> Option<Point> {
    let start = subpath.first()?.end_point()?;
    let stays = |element: &PathEl| match *element {
        PathEl::MoveTo(to) | PathEl::LineTo(to) => to == start,
        PathEl::QuadTo(control, to) => control == start && to == start,
        PathEl::CurveTo(first, second, to) => first == start && second == start && to == start,
        PathEl::ClosePath => true,
    };
    subpath.iter().all(stays).then_some(start)
}

fn vector(at: Point) -> DVec2 {
    DVec2::new(at.x, at.y)
}

fn point(at: DVec2) -> Point {
    Point::new(at.x, at.y)
}

#[cfg(test)]
mod tests {
    use kurbo::Shape as _;

    use super::*;
    use crate::geometry::{FillRule, triangulate};

    const PI: f64 = std::f64::consts::PI;

    fn line(points: &[[f64; 2]]) -> Path {
        let mut path = Path::default();
        path.move_to(points[0].into());
        for to in &points[1..] {
            path.line_to((*to).into());
        }
        path
    }

    fn circle(radius: f64) -> Path {
        Path(kurbo::Circle::new(Point::ORIGIN, radius).to_path(1e-9))
    }

    fn filled(path: Path) -> CurvedArea {
        CurvedArea {
            path,
            stroke: None,
            to_user: DAffine2::IDENTITY,
        }
    }

    fn stroked(path: Path, style: StrokeStyle, dashes: &[f64]) -> CurvedArea {
        CurvedArea {
            stroke: Some(Stroke {
                style,
                dashes: dashes.to_vec(),
                dash_offset: 0.0,
            }),
            ..filled(path)
        }
    }

    const STYLE: StrokeStyle = StrokeStyle {
        width: 2.0,
        cap: LineCap::Butt,
        join: LineJoin::Miter,
        miter_limit: 4.0,
    };

    fn measured(area: &CurvedArea, tolerance: f64) -> f64 {
        let triangles = triangulate(&area.flattened(Fineness::Distance(tolerance)), FillRule::NonZero);
        triangles
            .iter()
            .map(|[a, b, c]| (b - a).perp_dot(c - a).abs() / 2.0)
            .sum()
    }

    #[test]
    fn strokes_have_the_areas_of_their_style() {
        let straight = line(&[[0.0, 0.0], [10.0, 0.0]]);
        let corner = line(&[[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]]);
        let mut square = line(&[[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]]);
        square.close();
        let spot = line(&[[3.0, 3.0], [3.0, 3.0]]);
        // A subpath without length, at the end of a line.
        let mut dotted = straight.clone();
        dotted.move_to(DVec2::new(10.0, 0.0));
        dotted.line_to(DVec2::new(10.0, 0.0));
        let cap = |cap| StrokeStyle { cap, ..STYLE };
        let join = |join| StrokeStyle { join, ..STYLE };
        let short_miter = StrokeStyle {
            miter_limit: 1.0,
            ..STYLE
        };
        for (what, path, style, dashes, expected) in [
            ("butt", &straight, STYLE, &[][..], 20.0),
            ("round", &straight, cap(LineCap::Round), &[], 20.0 + PI),
            ("square", &straight, cap(LineCap::Square), &[], 24.0),
            ("miter", &corner, STYLE, &[], 40.0),
            ("round join", &corner, join(LineJoin::Round), &[], 39.0 + PI / 4.0),
            ("bevel", &corner, join(LineJoin::Bevel), &[], 39.5),
            ("miter beyond its limit", &corner, short_miter, &[], 39.5),
            ("closed", &square, STYLE, &[], 80.0),
            ("dashes", &straight, STYLE, &[2.0, 1.0], 14.0),
            ("an odd number of dashes", &straight, STYLE, &[3.0], 12.0),
            (
                "dashes with round caps",
                &straight,
                cap(LineCap::Round),
                &[1.0, 4.0],
                4.0 + 2.0 * PI,
            ),
            ("dots", &straight, cap(LineCap::Round), &[0.0, 4.0], 3.0 * PI),
            ("no length, butt", &spot, STYLE, &[], 0.0),
            ("no length, round", &spot, cap(LineCap::Round), &[], PI),
            ("no length, square", &spot, cap(LineCap::Square), &[], 4.0),
            ("a dot on a round cap", &dotted, cap(LineCap::Round), &[], 20.0 + PI),
            ("a dot on a square cap", &dotted, cap(LineCap::Square), &[], 24.0),
            ("a ring", &circle(10.0), STYLE, &[], 40.0 * PI),
        ] {
            let found = measured(&stroked(path.clone(), style, dashes), 1e-3);
            assert!((found - expected).abs() < 0.05, "{what}: {found}, not {expected}");
        }
    }

    #[test]
    fn edges_are_as_near_to_the_curve_as_they_are_asked_to_be() {
        let radius = 100.0;
        for tolerance in [1.0, 0.1, 0.01, 0.001] {
            for (what, area, [inner, outer]) in [
                ("a circle", filled(circle(radius)), [radius, radius]),
                (
                    "a ring",
                    stroked(circle(radius), STYLE, &[]),
                    [radius - 1.0, radius + 1.0],
                ),
            ] {
                let contours = area.flattened(Fineness::Distance(tolerance));
                for contour in &contours {
                    for (i, to) in contour.iter().enumerate() {
                        let from = contour[(i + contour.len() - 1) % contour.len()];
                        for at in [from.lerp(*to, 0.5), *to] {
                            let away = (at.length() - inner).abs().min((at.length() - outer).abs());
                            assert!(away <= tolerance * 1.01, "{what} at {tolerance}: {away} away");
                        }
                    }
                }
                let points: usize = contours.iter().map(Vec::len).sum();
                assert!(points < 4000, "{what} at {tolerance}: {points} points");
            }
        }
    }

    #[test]
    fn extremes_end() {
        for scale in [1e-30, 1e30] {
            for width in [1e-30, 1.0, 1e30] {
                for dashes in [&[][..], &[1e-9, 1e-9], &[0.0, 1e30]] {
                    let path = line(&[[0.0, 0.0], [scale, 0.0], [scale, scale]]);
                    let style = StrokeStyle {
                        width,
                        cap: LineCap::Round,
                        join: LineJoin::Round,
                        miter_limit: 1e30,
                    };
                    let contours = stroked(path, style, dashes).flattened(Fineness::Distance(0.01));
                    let count: usize = contours.iter().map(Vec::len).sum();
                    assert!(count as f64 <= 2.0 * MAX_POINTS, "{count} points at {scale}, {width}");
                }
            }
        }
        let mut far = Path::default();
        far.move_to(DVec2::ZERO);
        far.cubic_to([DVec2::splat(1e30), DVec2::new(-1e30, 1e30)], DVec2::new(1e30, 0.0));
        for area in [filled(far.clone()), stroked(far, STYLE, &[])] {
            let count: usize = area.flattened(Fineness::Distance(1e-6)).iter().map(Vec::len).sum();
            assert!(
                count as f64 <= 2.0 * MAX_POINTS,
                "{count} points of a curve without end"
            );
        }
        let fine = stroked(line(&[[0.0, 0.0], [1000.0, 0.0]]), STYLE, &[1e-9, 1e-9]);
        assert!(
            (measured(&fine, 0.01) - 2000.0).abs() < 1e-6,
            "dashes too fine to be seen: a solid line"
        );
    }
}
