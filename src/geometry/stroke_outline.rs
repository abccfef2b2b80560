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
//! Where to cut: an edge that turns by a small angle θ is θ²/8 times the radius away from the arc that it stands for, so the
//! steps are made equal in ∫ √((R + w/2) / 8ε) dθ, with the radius of curvature R, the width w and the tolerance ε. Levien
//! and Uguray, "GPU-friendly Stroke Expansion" (2024), has the same error for circular arcs.

use glam::DVec2;
use kurbo::{PathEl, Point};

use super::{LineCap, LineJoin, StrokeStyle};

/// A curve is halved until no corner of its control polygon turns by more than half a radian: the cosine of that.
const GENTLE: f64 = 0.877_582_561_890_372_8;

/// How far an edge may be from its arc, in tolerances, before it is split: the steps that are planned differ by less.
const MOST_DEPARTURE: f64 = 1.25;

/// How often a step along a gentle curve is halved.
const MOST_SPLITS: u32 = 12;

/// How often a curve is halved. What still turns by more than half a radian then is a cusp.
const MOST_HALVINGS: u32 = 16;

/// Appends the contours of a stroke that is one unit wide, to be filled by the non-zero rule. No edge is further than about
/// `tolerance` from the area's border. `elements` are a path without dashes; `style.width` is not read.
pub(super) fn append(
    elements: impl IntoIterator<Item = PathEl>,
    style: &StrokeStyle,
    tolerance: f64,
    contours: &mut Vec<Vec<DVec2>>,
) {
    let mut pen = Pen {
        style: *style,
        tolerance,
        contours,
        sides: [Vec::new(), Vec::new()],
        start: DVec2::ZERO,
        first: None,
        at: DVec2::ZERO,
        tangent: DVec2::X,
        line: 0.0,
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
pub(super) fn round_dot(center: DVec2, tolerance: f64) -> Vec<DVec2> {
    let right = DVec2::new(HALF, 0.0);
    let mut points = vec![center + right];
    arc(center, right, -std::f64::consts::TAU, tolerance, &mut points);
    points
}

/// The outline of a dot: a square of one unit's side.
pub(super) fn square_dot(center: DVec2) -> Vec<DVec2> {
    let corners = [[-HALF, -HALF], [-HALF, HALF], [HALF, HALF], [HALF, -HALF]];
    corners.map(|corner| center + DVec2::from(corner)).to_vec()
}

/// About how many edges half a circle has.
pub(super) fn edges_of_half_circle(tolerance: f64) -> f64 {
    (std::f64::consts::PI / arc_step(tolerance)).ceil()
}

/// Half the width.
const HALF: f64 = 0.5;

/// Goes along a subpath and leaves the vertices of both sides behind.
struct Pen<'a> {
    style: StrokeStyle,
    tolerance: f64,
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
        let [from, first, second, to] = curve;
        let leaving = [first, second, to]
            .into_iter()
            .find_map(|next| (next - from).try_normalize());
        let Some(tangent) = leaving else {
            return;
        };
        self.begin_piece(Piece { tangent, line: 0.0 }, self.style.join);
        self.line = 0.0;
        self.curve_part(curve, MOST_HALVINGS);
        // Rounding in the halves does not move the end.
        self.at = to;
    }

    /// Goes along a curve whose first tangent is already the pen's.
    fn curve_part(&mut self, curve: [DVec2; 4], halvings: u32) {
        let [from, first, second, to] = curve;
        let legs = [first - from, second - first, to - second].map(DVec2::try_normalize);
        let (mut direction, mut is_gentle) = (self.tangent, true);
        for next in legs.into_iter().flatten() {
            is_gentle &= direction.dot(next) >= GENTLE;
            direction = next;
        }
        if is_gentle {
            self.gentle_curve(curve, direction);
        } else if halvings > 0 {
            let [front, back] = halves(curve);
            self.curve_part(front, halvings - 1);
            self.curve_part(back, halvings - 1);
        } else {
            // A cusp: the line turns on the spot.
            let chord = (to - from).try_normalize().unwrap_or(direction);
            self.begin_piece(
                Piece {
                    tangent: chord,
                    line: 0.0,
                },
                LineJoin::Round,
            );
            self.advance(to, chord);
            self.begin_piece(
                Piece {
                    tangent: direction,
                    line: 0.0,
                },
                LineJoin::Round,
            );
        }
    }

    /// Goes along a curve that turns by little, and ends in a direction.
    fn gentle_curve(&mut self, curve: [DVec2; 4], end: DVec2) {
        // Not the very ends, where a curve may stand still.
        let densities = [1.0 / 64.0, 0.5, 63.0 / 64.0].map(|t| step_density(curve, t, self.tolerance));
        let [front, back] = [
            f64::midpoint(densities[0], densities[1]) / 2.0,
            f64::midpoint(densities[1], densities[2]) / 2.0,
        ];
        let steps = whole_steps(front + back);
        let mut from = 0.0;
        for step in 1..steps {
            let done = (front + back) * f64::from(step) / f64::from(steps);
            let t = if done < front {
                0.5 * share_of_trapezoid(densities[0], densities[1], done / front)
            } else {
                0.5 + 0.5 * share_of_trapezoid(densities[1], densities[2], (done - front) / back)
            };
            if let Some(tangent) = derivative(curve, t).try_normalize() {
                self.steps_to(curve, [from, t], (point_at(curve, t), tangent), MOST_SPLITS);
                from = t;
            }
        }
        self.steps_to(curve, [from, 1.0], (curve[3], end), MOST_SPLITS);
    }

    /// One edge along a part of a curve, up to a point whose tangent is given, or more where the curve turns within it: three
    /// densities do not show a bend that is much shorter than the curve.
    fn steps_to(&mut self, curve: [DVec2; 4], [from, to]: [f64; 2], (point, tangent): (DVec2, DVec2), splits: u32) {
        if splits > 0 && self.departure(point, tangent) > MOST_DEPARTURE * self.tolerance {
            let middle = f64::midpoint(from, to);
            if let Some(tangent) = derivative(curve, middle).try_normalize() {
                self.steps_to(curve, [from, middle], (point_at(curve, middle), tangent), splits - 1);
                self.steps_to(curve, [middle, to], (point, tangent), splits - 1);
                return;
            }
        }
        self.advance(point, tangent);
    }

    /// How far the outer of two edges to a point is from its arc, if the path goes there in an arc.
    fn departure(&self, to: DVec2, tangent: DVec2) -> f64 {
        // (R + 1/2) (1 - cos θ/2), with the chord 2 R sin θ/2.
        let cosine = self.tangent.dot(tangent).clamp(-1.0, 1.0);
        let half = (f64::midpoint(1.0, cosine)).sqrt();
        let chord = self.at.distance(to);
        HALF * (1.0 - half) + 0.5 * chord * ((1.0 - half) / (1.0 + half)).sqrt()
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
        for (side, sign) in self.sides.iter_mut().zip(SIGNS) {
            let [before, after] =
                [(self.at, self.tangent), (to, tangent)].map(|(at, tangent)| at + sign * HALF * tangent.perp());
            if (after - before).dot(chord) < 0.0 {
                // The normals cross before they reach the offset curve.
                let along = chord.perp_dot(tangent.perp()) / self.tangent.perp().perp_dot(tangent.perp());
                let crossing = self.at + along * self.tangent.perp();
                if along.is_finite() && along.abs() <= HALF {
                    side.push(crossing);
                    if before.distance(after) > self.tolerance / 2.0 {
                        self.contours.push(turning_like_outlines([crossing, before, after]));
                    }
                }
            }
            side.push(after);
        }
        self.at = to;
        self.tangent = tangent;
    }

    /// Turns from the pen's tangent to that of the next piece.
    fn join(&mut self, next: Piece, join: LineJoin) {
        let [from, to] = [self.tangent, next.tangent];
        let (sine, cosine) = (from.perp_dot(to), from.dot(to));
        // Where what a bevel would cut off is too small to matter, it is as if the path were smooth. Corners between lines are
        // the same at every tolerance, unless they are round.
        let is_between_lines = self.line > 0.0 && next.line > 0.0 && join != LineJoin::Round;
        let least = if is_between_lines { 1e-12 } else { self.tolerance / 4.0 };
        if HALF * (1.0 - cosine) <= least {
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
                arc(self.at, before, -SIGNS[side] * angle, self.tolerance, outer);
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
            LineCap::Round => arc(at, normal, -std::f64::consts::PI, self.tolerance, contour),
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
fn arc(center: DVec2, from: DVec2, angle: f64, tolerance: f64, points: &mut Vec<DVec2>) {
    let steps = whole_steps(angle.abs() / arc_step(tolerance));
    let turn = DVec2::from_angle(angle / f64::from(steps));
    let mut arm = from;
    for _ in 1..steps {
        arm = turn.rotate(arm);
        points.push(center + arm);
    }
}

/// At least so many steps, and not more than a million.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between one and a million"
)]
fn whole_steps(steps: f64) -> u32 {
    steps.ceil().clamp(1.0, 1e6) as u32
}

/// The angle at which the middle of a chord is `tolerance` away from a circle of one unit's diameter.
fn arc_step(tolerance: f64) -> f64 {
    2.0 * (1.0 - (tolerance / HALF).min(1.0)).acos()
}

/// How many steps a curve needs per unit of its parameter, at a place.
fn step_density(curve: [DVec2; 4], t: f64, tolerance: f64) -> f64 {
    let speed = derivative(curve, t);
    let [from, first, second, to] = curve;
    let bends = [from - 2.0 * first + second, first - 2.0 * second + to];
    let acceleration = 6.0 * bends[0].lerp(bends[1], t);
    let squared = speed.length_squared();
    // Radians per unit of the parameter.
    let turning = speed.perp_dot(acceleration).abs() / squared;
    let density = (turning * (squared.sqrt() + HALF * turning) / (8.0 * tolerance)).sqrt();
    if density.is_finite() { density } else { 0.0 }
}

/// Where `share` of the area lies to the left, under a straight line from one height to another over a unit's length.
fn share_of_trapezoid(from: f64, to: f64, share: f64) -> f64 {
    // from x + (to - from) x² / 2 = share (from + to) / 2, in the form that holds for a level line, too.
    let area = share * (from + to);
    let root = (from * from + (to - from) * area).max(0.0).sqrt();
    let place = area / (from + root);
    if place.is_finite() {
        place.clamp(0.0, 1.0)
    } else {
        share
    }
}

fn point_at([from, first, second, to]: [DVec2; 4], t: f64) -> DVec2 {
    let s = 1.0 - t;
    s * s * s * from + 3.0 * s * s * t * first + 3.0 * s * t * t * second + t * t * t * to
}

fn derivative([from, first, second, to]: [DVec2; 4], t: f64) -> DVec2 {
    let s = 1.0 - t;
    3.0 * (s * s * (first - from) + 2.0 * s * t * (second - first) + t * t * (to - second))
}

fn halves([from, first, second, to]: [DVec2; 4]) -> [[DVec2; 4]; 2] {
    let [a, b, c] = [from.midpoint(first), first.midpoint(second), second.midpoint(to)];
    let [d, e] = [a.midpoint(b), b.midpoint(c)];
    let middle = d.midpoint(e);
    [[from, a, d, middle], [middle, e, c, to]]
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

    const STYLE: StrokeStyle = StrokeStyle {
        width: 1.0,
        cap: LineCap::Round,
        join: LineJoin::Round,
        miter_limit: 4.0,
    };

    fn outline(elements: &[PathEl], style: StrokeStyle, tolerance: f64) -> Vec<Vec<DVec2>> {
        let mut contours = Vec::new();
        append(elements.iter().copied(), &style, tolerance, &mut contours);
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
