//! Outlines of strokes: contours of straight edges at half a width to both sides of a path.
//!
//! Each curve is cut where its offset curves ask for it, and the vertices of the outline lie on the curve's normals:
//!
//! ```text
//!   left    o───o───o──.                   o────o····x  miter
//!           |   |   |   o.                 |    |  ···
//!   path    •───•───•.   \                 •────•   ·   At a corner, the outer side gets its join; the inner
//!           |   |     \ .o                 |   /|  ·    side is cut where the two offset lines meet or, where
//!   right   o───o──.o  '•                  o──i \ ·     pieces are too short for that, led through the corner.
//!                    \ / \                     \  •
//! ```
//!
//! So the outline is put together from pieces that all turn the same way round, and the non-zero rule fills what the line
//! sweeps, also where a curve is tighter than the line is wide. There the inner offset curve runs backwards: that part of it
//! becomes a triangle of its own.
//!
//! [`Walk`] says where to cut.

use glam::DVec2;
use kurbo::{PathEl, Point};

use super::curve_steps::{Fineness, Step, Walk, keep_area, leaving, whole_steps};
use super::{LineCap, LineJoin, StrokeStyle};

/// Appends the contours of a stroke that is one unit wide, to be filled by the non-zero rule. Edges are about as near to
/// the area's border as `fineness` says. `elements` are a path without dashes; `style.width` is not read.
pub(super) fn append(
    elements: impl IntoIterator<Item = PathEl>,
    style: &StrokeStyle,
    fineness: Fineness,
    contours: &mut Vec<Vec<DVec2>>,
) {
    let mut pen = Pen {
        style: *style,
        fineness,
        contours,
        sides: [Vec::new(), Vec::new()],
        start: DVec2::ZERO,
        first: None,
        at: DVec2::ZERO,
        tangent: DVec2::X,
        line: 0.0,
        chains: [Chain::default(); 2],
        tangents: Vec::new(),
        areas: Vec::new(),
    };
    for element in elements {
        match element {
            PathEl::MoveTo(to) => {
                pen.end();
                pen.start = vector(to);
                pen.at = pen.start;
            }
            PathEl::LineTo(to) => pen.line_to(vector(to)),
            PathEl::QuadTo(control, to) => {
                let (from, control, to) = (pen.at, vector(control), vector(to));
                pen.curve([from, from.lerp(control, 2.0 / 3.0), to.lerp(control, 2.0 / 3.0), to]);
            }
            PathEl::CurveTo(first, second, to) => pen.curve([pen.at, vector(first), vector(second), vector(to)]),
            PathEl::ClosePath => pen.close(),
        }
    }
    pen.end();
}

/// The outline of a dot: a circle of one unit's diameter.
pub(super) fn round_dot(center: DVec2, fineness: Fineness) -> Vec<DVec2> {
    let right = DVec2::new(HALF, 0.0);
    let mut points = vec![center + right];
    arc(center, right, -std::f64::consts::TAU, fineness, &mut points);
    points
}

/// The outline of a dot: a square of one unit's side.
pub(super) fn square_dot(center: DVec2) -> Vec<DVec2> {
    let corners = [[-HALF, -HALF], [-HALF, HALF], [HALF, HALF], [HALF, -HALF]];
    corners.map(|corner| center + DVec2::from(corner)).to_vec()
}

/// About how many edges half a circle has.
pub(super) fn edges_of_half_circle(fineness: Fineness) -> f64 {
    (std::f64::consts::PI / arc_step(fineness)).ceil()
}

/// Half the width.
const HALF: f64 = 0.5;

/// Goes along a subpath and leaves the vertices of both sides behind.
struct Pen<'a> {
    style: StrokeStyle,
    fineness: Fineness,
    contours: &'a mut Vec<Vec<DVec2>>,
    /// Of the subpath so far: on the side of the normals, and on the other.
    sides: [Vec<DVec2>; 2],
    /// Where the subpath begins.
    start: DVec2,
    /// How it begins, once it has a piece of some length: its tangent and the length of its line.
    first: Option<Piece>,
    /// Where it has come to.
    at: DVec2,
    /// Its direction there, one unit long.
    tangent: DVec2,
    /// How long the line is on which it came, zero for a curve.
    line: f64,
    /// Where the vertices begin that stand for the curve at work, on both sides.
    chains: [Chain; 2],
    /// Those of the curve at work at its vertices.
    tangents: Vec<DVec2>,
    areas: Vec<f64>,
}

/// Where vertices begin that stand for a curve, and its tangents there.
#[derive(Clone, Copy, Default)]
struct Chain {
    vertex: usize,
    tangent: usize,
}

/// How a piece of a path begins.
#[derive(Clone, Copy)]
struct Piece {
    /// One unit long.
    tangent: DVec2,
    /// Its length where it is a line, zero for a curve.
    line: f64,
}

/// Which way a side is from the path, in normals.
const SIGNS: [f64; 2] = [1.0, -1.0];

impl Pen<'_> {
    fn line_to(&mut self, to: DVec2) {
        let length = self.at.distance(to);
        let tangent = (to - self.at) / length;
        if !tangent.is_finite() {
            return;
        }
        let piece = Piece { tangent, line: length };
        self.begin_piece(piece, self.style.join);
        self.advance(to, tangent);
        self.line = length;
    }

    fn curve(&mut self, curve: [DVec2; 4]) {
        let Some(tangent) = leaving(curve) else {
            return;
        };
        self.begin_piece(Piece { tangent, line: 0.0 }, self.style.join);
        self.line = 0.0;
        self.begin_chains(tangent);
        let mut walk = Walk {
            fineness: self.fineness,
            half: HALF,
            at: self.at,
            tangent,
            visit: |step| match step {
                Step::To(point, tangent) => self.advance(point, tangent),
                // The line turns on the spot.
                Step::Cusp { chord, to, direction } => {
                    let turn = |tangent| Piece { tangent, line: 0.0 };
                    self.end_chains();
                    self.begin_piece(turn(chord), LineJoin::Round);
                    self.advance(to, chord);
                    self.begin_piece(turn(direction), LineJoin::Round);
                    self.begin_chains(direction);
                }
            },
        };
        walk.along(curve);
        self.end_chains();
        // Rounding in the halves does not move the end.
        self.at = curve[3];
    }

    /// Begins vertices of both sides that stand for curves.
    fn begin_chains(&mut self, tangent: DVec2) {
        self.tangents.clear();
        self.tangents.push(tangent);
        self.chains = self.sides.each_ref().map(|side| Chain {
            vertex: side.len() - 1,
            tangent: 0,
        });
    }

    /// Ends them.
    fn end_chains(&mut self) {
        if self.fineness.keeps_area() {
            for (side, chain) in self.sides.iter_mut().zip(self.chains) {
                keep_area(
                    &mut side[chain.vertex..],
                    &self.tangents[chain.tangent..],
                    &mut self.areas,
                );
            }
        }
    }

    /// Lets the outline turn to the direction of the next piece, or begins it.
    fn begin_piece(&mut self, piece: Piece, join: LineJoin) {
        if self.first.is_some() {
            self.join(piece, join);
        } else {
            self.first = Some(piece);
            for (side, sign) in self.sides.iter_mut().zip(SIGNS) {
                side.push(self.at + sign * HALF * piece.tangent.perp());
            }
        }
        self.tangent = piece.tangent;
    }

    /// One edge on both sides, to a point whose tangent is given.
    fn advance(&mut self, to: DVec2, tangent: DVec2) {
        let chord = to - self.at;
        for ((side, chain), sign) in self.sides.iter_mut().zip(&mut self.chains).zip(SIGNS) {
            let [before, after] =
                [(self.at, self.tangent), (to, tangent)].map(|(at, tangent)| at + sign * HALF * tangent.perp());
            if (after - before).dot(chord) < 0.0 {
                // The normals cross before they reach the offset curve.
                let along = chord.perp_dot(tangent.perp()) / self.tangent.perp().perp_dot(tangent.perp());
                let crossing = self.at + along * self.tangent.perp();
                if along.is_finite() && along.abs() <= HALF {
                    if self.fineness.keeps_area() {
                        keep_area(
                            &mut side[chain.vertex..],
                            &self.tangents[chain.tangent..],
                            &mut self.areas,
                        );
                        *chain = Chain {
                            vertex: side.len() + 1,
                            tangent: self.tangents.len(),
                        };
                    }
                    side.push(crossing);
                    if before.distance(after) > self.fineness.least_length() {
                        self.contours.push(turning_like_outlines([crossing, before, after]));
                    }
                }
            }
            side.push(after);
        }
        self.at = to;
        self.tangent = tangent;
        self.tangents.push(tangent);
    }

    /// Turns from the pen's tangent to that of the next piece.
    fn join(&mut self, next: Piece, join: LineJoin) {
        let [from, to] = [self.tangent, next.tangent];
        let (sine, cosine) = (from.perp_dot(to), from.dot(to));
        // Where what a bevel would cut off is too small to matter, it is as if the path were smooth. Corners between lines are
        // the same at every tolerance, unless they are round.
        let is_between_lines = self.line > 0.0 && next.line > 0.0 && join != LineJoin::Round;
        let cut_off = HALF * (1.0 - cosine);
        let is_smooth = if is_between_lines {
            cut_off <= 1e-12
        } else {
            self.fineness.neglects(cut_off, from.distance(to))
        };
        if is_smooth {
            return;
        }
        let inner = usize::from(sine <= 0.0);
        self.turn_inside(inner, next);
        self.turn_outside(1 - inner, next, join);
    }

    fn turn_inside(&mut self, side: usize, next: Piece) {
        let [from, to] = [self.tangent, next.tangent];
        let cosine = from.dot(to);
        let half_tangent = ((1.0 - cosine) / (1.0 + cosine)).sqrt();
        let normal = SIGNS[side] * HALF * to.perp();
        let inner = &mut self.sides[side];
        if HALF * half_tangent <= 0.5 * self.line.min(next.line) {
            inner.pop();
            inner.push(self.at + SIGNS[side] * HALF * (from + to).perp() / (1.0 + cosine));
        } else {
            inner.extend([self.at, self.at + normal]);
        }
    }

    fn turn_outside(&mut self, side: usize, next: Piece, join: LineJoin) {
        let [from, to] = [self.tangent, next.tangent];
        let cosine = from.dot(to);
        let [before, after] = [from, to].map(|tangent| SIGNS[side] * HALF * tangent.perp());
        let outer = &mut self.sides[side];
        match join {
            // 1 / sin(φ / 2) of the angle φ between the edges is the miter's length in widths.
            LineJoin::Miter if 2.0 <= (1.0 + cosine) * self.style.miter_limit.powi(2) => {
                let tip = self.at + (before + after) / (1.0 + cosine);
                if self.line > 0.0 {
                    outer.pop();
                }
                outer.push(tip);
                if next.line == 0.0 {
                    outer.push(self.at + after);
                }
            }
            LineJoin::Miter | LineJoin::Bevel => outer.push(self.at + after),
            LineJoin::Round => {
                let angle = from.perp_dot(to).atan2(cosine).abs();
                arc(self.at, before, -SIGNS[side] * angle, self.fineness, outer);
                outer.push(self.at + after);
            }
        }
    }

    /// Ends an open subpath with caps.
    fn end(&mut self) {
        let Some(first) = self.first.take() else {
            return;
        };
        let [mut contour, back] = std::mem::take(&mut self.sides);
        self.cap(self.at, self.tangent, &mut contour);
        contour.extend(back.into_iter().rev());
        self.cap(self.start, -first.tangent, &mut contour);
        self.contours.push(contour);
    }

    /// The vertices of a cap, those of the line's end left out.
    fn cap(&self, at: DVec2, tangent: DVec2, contour: &mut Vec<DVec2>) {
        let normal = HALF * tangent.perp();
        match self.style.cap {
            LineCap::Butt => {}
            LineCap::Square => contour.extend([normal, -normal].map(|side| at + side + HALF * tangent)),
            LineCap::Round => arc(at, normal, -std::f64::consts::PI, self.fineness, contour),
        }
    }

    /// Ends a closed subpath, and begins another where it began.
    fn close(&mut self) {
        if self.at != self.start {
            self.line_to(self.start);
        }
        if let Some(first) = self.first.take() {
            let ends = self.sides.each_ref().map(Vec::len);
            self.join(first, self.style.join);
            for (side, end) in self.sides.iter_mut().zip(ends) {
                // A corner that is one vertex is that of the first line, too.
                if side.len() == end
                    && let Some(corner) = side.pop()
                    && let Some(begin) = side.first_mut()
                {
                    *begin = corner;
                }
            }
            let [front, mut back] = std::mem::take(&mut self.sides);
            back.reverse();
            self.contours.extend([front, back]);
        }
        self.at = self.start;
        self.line = 0.0;
    }
}

/// Appends points on an arc around `center`, from `center + from` on, without its ends; `angle` is in radians, in the sense of
/// [`DVec2::perp`].
fn arc(center: DVec2, from: DVec2, angle: f64, fineness: Fineness, points: &mut Vec<DVec2>) {
    let steps = whole_steps(angle.abs() / arc_step(fineness));
    let turn = DVec2::from_angle(angle / f64::from(steps));
    let mut arm = from;
    if fineness.keeps_area() {
        arm *= reach_of_inner_vertices(angle.abs(), steps);
    }
    for _ in 1..steps {
        arm = turn.rotate(arm);
        points.push(center + arm);
    }
}

/// How many radii the vertices of an arc are away from its center, all but the two at its ends, so that its edges enclose what it
/// encloses.
fn reach_of_inner_vertices(angle: f64, steps: u32) -> f64 {
    // Of n triangles between arms, two have an arm of one radius: (n - 2) r² + 2 r = n θ / sin θ.
    let steps = f64::from(steps);
    let step = angle / steps;
    let area = steps * step / step.sin();
    let reach = area / (1.0 + (1.0 + (steps - 2.0) * area).max(0.0).sqrt());
    if reach.is_finite() { reach } else { 1.0 }
}

/// The angle of an edge of a circle of one unit's diameter; at most a sixth of a turn where its vertices lie off the circle.
fn arc_step(fineness: Fineness) -> f64 {
    match fineness {
        Fineness::Distance(most) => 2.0 * (1.0 - (most / HALF).min(1.0)).acos(),
        Fineness::Area { .. } => fineness
            .steps_per_radian(HALF)
            .max(std::f64::consts::FRAC_1_PI * 3.0)
            .recip(),
    }
}

/// A triangle that turns the way outlines do.
fn turning_like_outlines([a, b, c]: [DVec2; 3]) -> Vec<DVec2> {
    if (b - a).perp_dot(c - a) > 0.0 {
        vec![a, c, b]
    } else {
        vec![a, b, c]
    }
}

fn vector(point: Point) -> DVec2 {
    DVec2::new(point.x, point.y)
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};

    use super::*;
    use crate::geometry::curve_steps::point_at;

    const STYLE: StrokeStyle = StrokeStyle {
        width: 1.0,
        cap: LineCap::Round,
        join: LineJoin::Round,
        miter_limit: 4.0,
    };

    fn outline(elements: &[PathEl], style: StrokeStyle, tolerance: f64) -> Vec<Vec<DVec2>> {
        let mut contours = Vec::new();
        append(
            elements.iter().copied(),
            &style,
            Fineness::Distance(tolerance),
            &mut contours,
        );
        contours
    }

    /// How often the contours go around a point.
    fn winding(contours: &[Vec<DVec2>], at: DVec2) -> i32 {
        let mut winding = 0;
        for contour in contours {
            for (i, to) in contour.iter().enumerate() {
                let from = contour[(i + contour.len() - 1) % contour.len()];
                if (from.y <= at.y) != (to.y <= at.y) {
                    let is_right = (*to - from).perp_dot(at - from) > 0.0;
                    winding += match (to.y > from.y, is_right) {
                        (true, true) => 1,
                        (false, false) => -1,
                        _ => 0,
                    };
                }
            }
        }
        winding
    }

    /// Distance from a point to a polygonal line.
    fn distance(line: &[DVec2], at: DVec2) -> f64 {
        let to_edge = |edge: &[DVec2]| {
            let along = edge[1] - edge[0];
            let share = ((at - edge[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            at.distance(edge[0] + if share.is_nan() { 0.0 } else { share } * along)
        };
        line.windows(2).map(to_edge).fold(f64::INFINITY, f64::min)
    }

    fn place(u: &mut Unstructured<'_>, reach: f64) -> Result<DVec2> {
        let mut coordinate =
            || Ok::<_, arbtest::arbitrary::Error>(f64::from(u.int_in_range(-1000..=1000)?) / 1000.0 * reach);
        Ok(DVec2::new(coordinate()?, coordinate()?))
    }

    /// Round strokes cover what is nearer than half a width to the path, and nothing else.
    #[test]
    fn round_strokes_are_what_is_near_the_path() {
        arbtest::arbtest(|u| {
            let reach = *u.choose(&[0.3, 1.0, 5.0])?;
            let tolerance = *u.choose(&[0.05, 0.01, 0.001])?;
            let point = |at: DVec2| Point::new(at.x, at.y);
            let mut at = place(u, reach)?;
            let mut elements = vec![PathEl::MoveTo(point(at))];
            let mut line = vec![at];
            for _ in 0..u.int_in_range(1..=3)? {
                let [first, second, to] = [place(u, reach)?, place(u, reach)?, place(u, reach)?];
                let curve = if u.arbitrary()? {
                    elements.push(PathEl::LineTo(point(to)));
                    [at, at.lerp(to, 1.0 / 3.0), at.lerp(to, 2.0 / 3.0), to]
                } else {
                    elements.push(PathEl::CurveTo(point(first), point(second), point(to)));
                    [at, first, second, to]
                };
                line.extend((1..=500).map(|i| point_at(curve, f64::from(i) / 500.0)));
                at = to;
            }
            if u.arbitrary()? {
                elements.push(PathEl::ClosePath);
                line.push(line[0]);
            }
            let contours = outline(&elements, STYLE, tolerance);
            for _ in 0..50 {
                let at = place(u, reach + 1.0)?;
                let away = distance(&line, at) - HALF;
                if away.abs() > tolerance * 1.5 + 1e-4 {
                    let inside = winding(&contours, at) != 0;
                    assert_eq!(inside, away < 0.0, "{away} away at {at}, {tolerance}: {elements:?}");
                }
            }
            Ok(())
        })
        .size_min(2048);
    }

    /// A bend much shorter than its curve lies between the places where the curve is looked at.
    #[test]
    fn short_bends_at_the_end_of_a_curve_are_followed() {
        let point = |x: f64, y: f64| Point::new(x, y);
        let path = [
            PathEl::MoveTo(point(-0.072, -0.0333)),
            PathEl::CurveTo(point(0.2691, -0.1059), point(-0.1647, -0.0309), point(-0.1671, -0.0294)),
            PathEl::LineTo(point(0.1647, 0.2283)),
        ];
        let contours = outline(&path, STYLE, 0.001);
        assert_ne!(winding(&contours, DVec2::new(-0.3484, -0.4901)), 0);
    }

    /// A hook that is tighter than the line is wide: all of what the line sweeps, also behind its bend.
    #[test]
    fn tight_bends_have_no_holes() {
        let point = |x: f64, y: f64| Point::new(x, y);
        let hook = [
            PathEl::MoveTo(point(-3.0, 0.0)),
            PathEl::LineTo(point(0.0, 0.0)),
            PathEl::CurveTo(point(0.27, 0.0), point(0.27, 0.2), point(0.0, 0.2)),
        ];
        let style = StrokeStyle {
            cap: LineCap::Butt,
            ..STYLE
        };
        let contours = outline(&hook, style, 1e-3);
        for x in [-0.2, -0.1, 0.1, 0.3] {
            for y in [-0.2, 0.0, 0.1, 0.3] {
                assert_ne!(winding(&contours, DVec2::new(x, y)), 0, "{x}, {y}");
            }
        }
    }

    #[test]
    fn steps_are_as_long_as_the_tolerance_allows() {
        let quarter = 4.0 / 3.0 * (2.0_f64.sqrt() - 1.0);
        let radius = 10.0;
        let at = |x: f64, y: f64| Point::new(radius * x, radius * y);
        let arc = [
            PathEl::MoveTo(at(1.0, 0.0)),
            PathEl::CurveTo(at(1.0, quarter), at(quarter, 1.0), at(0.0, 1.0)),
        ];
        let butt = StrokeStyle {
            cap: LineCap::Butt,
            ..STYLE
        };
        for tolerance in [0.1, 0.01, 0.001] {
            let fewest = std::f64::consts::FRAC_PI_2 / (2.0 * (1.0 - tolerance / (radius + HALF)).acos());
            let points: usize = outline(&arc, butt, tolerance).iter().map(Vec::len).sum();
            let steps = (points / 2 - 1) as f64;
            assert!(
                steps >= fewest * 0.9 && steps <= fewest + 8.0,
                "{steps}, at least {fewest}"
            );
        }
    }

    /// Contours that are kept for all views must not depend on the first one's.
    #[test]
    fn corners_between_lines_are_the_same_at_every_tolerance() {
        let at = |x: f64, y: f64| PathEl::LineTo(Point::new(x, y));
        let line = [PathEl::MoveTo(Point::ZERO), at(10.0, 0.0), at(20.0, 1.0), at(30.0, 0.5)];
        for join in [LineJoin::Miter, LineJoin::Bevel] {
            let style = StrokeStyle {
                cap: LineCap::Butt,
                join,
                ..STYLE
            };
            assert_eq!(outline(&line, style, 0.25), outline(&line, style, 1e-6), "{join:?}");
        }
    }

    /// Where both neighbours are long enough, a corner is one vertex inside, and one outside under a miter.
    #[test]
    fn corners_of_long_lines_are_single_vertices() {
        let at = |x: f64, y: f64| Point::new(x, y);
        let mut corner = vec![
            PathEl::MoveTo(at(0.0, 0.0)),
            PathEl::LineTo(at(10.0, 0.0)),
            PathEl::LineTo(at(10.0, 10.0)),
        ];
        let style = StrokeStyle {
            cap: LineCap::Butt,
            join: LineJoin::Miter,
            ..STYLE
        };
        let count = |elements: &[PathEl]| outline(elements, style, 0.01).iter().map(Vec::len).sum::<usize>();
        assert_eq!(count(&corner), 6);
        corner.extend([PathEl::LineTo(at(0.0, 10.0)), PathEl::ClosePath]);
        assert_eq!(count(&corner), 8, "a frame of four corners");
    }
}
