//! Where curves are cut into edges: by how far an edge may be from its curve, or by the area between them.
//!
//! ```text
//!           .-''''-.   s
//!        .'-----------'.      an edge of length L and its arc, which is s away in the middle,
//!       /      L        \     with two thirds of s L between them
//! ```
//!
//! An edge that turns by a small angle θ is θ²/8 times the radius away from the arc that it stands for. So the steps are made
//! equal in ∫ √((R + w/2) / 8ε) dθ where ε is the most distance, and in ∫ ∛((R + w/2)² / 8α) dθ where α is the most of s L,
//! with the radius of curvature R and the width w of a stroke. Levien and Uguray, "GPU-friendly Stroke Expansion" (2024), has the
//! former for circular arcs; without a width, the latter is the affine arc length.

use glam::DVec2;

/// A curve is halved until no corner of its control polygon turns by more than half a radian: the cosine of that.
const GENTLE: f64 = 0.877_582_561_890_372_8;

/// How far an edge may be from its arc, or how large the area between them, in tolerances, before it is split: the steps that
/// are planned differ by less.
const MOST_DEPARTURE: f64 = 1.25;

/// How often a step along a gentle curve is halved.
const MOST_SPLITS: u32 = 12;

/// How often a curve is halved. What still turns by more than half a radian then is a cusp.
const MOST_HALVINGS: u32 = 16;

/// A curve of fewer steps is one edge; from there on it has a vertex that makes up for its area.
const LEAST_STEPS: f64 = 0.2;

/// How near edges are to the curves that they stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fineness {
    /// No edge is further from its curve.
    Distance(f64),
    /// Edges enclose the areas that curves enclose: their vertices lie off the curve, by as much as makes up for what lies
    /// between edges and curve.
    Area {
        /// The most of an edge's length times its distance from the curve. Any part of an edge errs by at most a third of it.
        area: f64,
        /// An edge that is no further from its curve may be longer.
        distance: f64,
    },
}

impl Fineness {
    /// The same where lengths are `stretch` times as long and areas `area` times as large.
    pub(super) fn scaled(self, stretch: f64, by_area: f64) -> Self {
        match self {
            Self::Distance(most) => Self::Distance(most * stretch),
            Self::Area { area, distance } => Self::Area {
                area: area * by_area,
                distance: distance * stretch,
            },
        }
    }

    /// The same in a unit of so many of the present ones.
    pub(super) fn in_units(self, of: f64) -> Self {
        self.scaled(of.recip(), of.powi(-2))
    }

    /// The nearest one whose distance lies between two.
    pub(super) fn between(self, least: f64, most: f64) -> Self {
        match self {
            Self::Distance(distance) => Self::Distance(distance.clamp(least, most)),
            Self::Area { area, distance } => Self::Area {
                area: area.max(least * least),
                distance: distance.max(least),
            },
        }
    }

    /// So coarse that there are about so many times fewer steps.
    pub(super) fn with_fewer_steps(self, times: f64) -> Self {
        self.scaled(times.powi(2), times.powi(3))
    }

    /// Whether it is a number above zero.
    pub(super) fn is_valid(self) -> bool {
        let is_valid = |most: f64| most > 0.0 && most.is_finite();
        match self {
            Self::Distance(most) => is_valid(most),
            Self::Area { area, distance } => is_valid(area) && is_valid(distance),
        }
    }

    /// Whether vertices lie off the curve.
    pub(super) fn keeps_area(self) -> bool {
        matches!(self, Self::Area { .. })
    }

    /// How many steps a turn has, in radians, along a curve of this radius.
    pub(super) fn steps_per_radian(self, radius: f64) -> f64 {
        let by_distance = |most: f64| (radius / (8.0 * most)).sqrt();
        match self {
            Self::Distance(most) => by_distance(most),
            Self::Area { area, distance } => by_distance(distance).min((radius * radius / (8.0 * area)).cbrt()),
        }
    }

    /// Whether an edge of a length may be so far away from its curve.
    fn allows(self, away: f64, length: f64) -> bool {
        match self {
            Self::Distance(most) => away <= MOST_DEPARTURE * most,
            Self::Area { area, distance } => {
                away <= MOST_DEPARTURE * distance || away * length <= MOST_DEPARTURE * area
            }
        }
    }

    /// Edges of parts of no more than one unit's height may be left out where they are no longer.
    pub(super) fn least_length(self) -> f64 {
        match self {
            Self::Distance(most) => most / 2.0,
            Self::Area { area, .. } => area / 2.0,
        }
    }

    /// Whether what lies between an edge of a length and a corner does not show.
    pub(super) fn neglects(self, away: f64, length: f64) -> bool {
        match self {
            Self::Distance(most) => away <= most / 4.0,
            Self::Area { area, .. } => away * length <= area / 16.0,
        }
    }
}

/// A step along a curve.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    /// To a point, with the curve's direction there, one unit long.
    To(DVec2, DVec2),
    /// To the end of a cusp, straight along `chord`, from where the curve goes on in another direction.
    Cusp {
        /// One unit long.
        chord: DVec2,
        to: DVec2,
        /// One unit long.
        direction: DVec2,
    },
}

/// Goes along curves and says where to step.
pub(super) struct Walk<V> {
    pub(super) fineness: Fineness,
    /// Half the width of the stroke: how far from the curve the outer edge lies.
    pub(super) half: f64,
    /// Where it has come to.
    pub(super) at: DVec2,
    /// Its direction there, one unit long.
    pub(super) tangent: DVec2,
    /// Takes the steps.
    pub(super) visit: V,
}

/// The direction in which a curve begins, one unit long; `None` for one that stays where it is.
pub(super) fn leaving([from, first, second, to]: [DVec2; 4]) -> Option<DVec2> {
    [first, second, to]
        .into_iter()
        .find_map(|next| (next - from).try_normalize())
}

impl<V: FnMut(Step)> Walk<V> {
    /// Goes along a curve that begins where it is and in its direction.
    pub(super) fn along(&mut self, curve: [DVec2; 4]) {
        self.along_part(curve, MOST_HALVINGS);
    }

    fn along_part(&mut self, curve: [DVec2; 4], halvings: u32) {
        let [from, first, second, to] = curve;
        let legs = [first - from, second - first, to - second].map(DVec2::try_normalize);
        let (mut direction, mut is_gentle) = (self.tangent, true);
        for next in legs.into_iter().flatten() {
            is_gentle &= direction.dot(next) >= GENTLE;
            direction = next;
        }
        if is_gentle {
            self.along_gentle(curve, direction);
        } else if halvings > 0 {
            let [front, back] = halves(curve);
            self.along_part(front, halvings - 1);
            self.along_part(back, halvings - 1);
        } else {
            let chord = (to - from).try_normalize().unwrap_or(direction);
            (self.visit)(Step::Cusp { chord, to, direction });
            (self.at, self.tangent) = (to, direction);
        }
    }

    /// Goes along a curve that turns by little, and ends in a direction.
    fn along_gentle(&mut self, curve: [DVec2; 4], end: DVec2) {
        // Not the very ends, where a curve may stand still.
        let densities = [1.0 / 64.0, 0.5, 63.0 / 64.0].map(|t| self.step_density(curve, t));
        let [front, back] = [
            f64::midpoint(densities[0], densities[1]) / 2.0,
            f64::midpoint(densities[1], densities[2]) / 2.0,
        ];
        let mut steps = whole_steps(front + back);
        if steps == 1 && self.fineness.keeps_area() && front + back > LEAST_STEPS {
            steps = 2;
        }
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
        if splits > 0 && !self.reaches(point, tangent) {
            let middle = f64::midpoint(from, to);
            if let Some(tangent) = derivative(curve, middle).try_normalize() {
                self.steps_to(curve, [from, middle], (point_at(curve, middle), tangent), splits - 1);
                self.steps_to(curve, [middle, to], (point, tangent), splits - 1);
                return;
            }
        }
        (self.visit)(Step::To(point, tangent));
        (self.at, self.tangent) = (point, tangent);
    }

    /// Whether one edge may go to a point, if the curve goes there in an arc.
    fn reaches(&self, to: DVec2, tangent: DVec2) -> bool {
        // The outer edge is (R + w/2) (1 - cos θ/2) away from its arc, with the chord 2 R sin θ/2.
        let cosine = self.tangent.dot(tangent).clamp(-1.0, 1.0);
        let half = (f64::midpoint(1.0, cosine)).sqrt();
        let chord = self.at.distance(to);
        let away = self.half * (1.0 - half) + 0.5 * chord * ((1.0 - half) / (1.0 + half)).sqrt();
        let sine = f64::midpoint(1.0, -cosine).sqrt();
        self.fineness.allows(away, chord + 2.0 * self.half * sine)
    }

    /// How many steps a curve needs per unit of its parameter, at a place.
    fn step_density(&self, curve: [DVec2; 4], t: f64) -> f64 {
        let speed = derivative(curve, t);
        let [from, first, second, to] = curve;
        let bends = [from - 2.0 * first + second, first - 2.0 * second + to];
        let acceleration = 6.0 * bends[0].lerp(bends[1], t);
        let squared = speed.length_squared();
        // Radians per unit of the parameter.
        let turning = speed.perp_dot(acceleration).abs() / squared;
        let density = match self.fineness {
            Fineness::Distance(most) => (turning * (squared.sqrt() + self.half * turning) / (8.0 * most)).sqrt(),
            Fineness::Area { .. } => turning * self.fineness.steps_per_radian(squared.sqrt() / turning + self.half),
        };
        if density.is_finite() { density } else { 0.0 }
    }
}

/// At least so many steps, and not more than a million.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between one and a million"
)]
pub(super) fn whole_steps(steps: f64) -> u32 {
    steps.ceil().clamp(1.0, 1e6) as u32
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

/// Moves the inner vertices of a chain of edges off its curve, outwards from each bend, so that the edges enclose the area that
/// the curve encloses. `tangents` are those of the curve at the vertices.
///
/// ```text
///        o_____o          An edge of length L that turns by α to its curve at one end and by β at the other leaves out
///      .'       '.        L² (sin α + sin β) / 12, which is right for parabolas, and up to θ² for arcs. Each end takes
///     o           o       half of it, except those of the chain.
/// ```
pub(super) fn keep_area(vertices: &mut [DVec2], tangents: &[DVec2], areas: &mut Vec<f64>) {
    let Some(last) = vertices.len().checked_sub(2).filter(|last| *last > 0) else {
        return;
    };
    areas.clear();
    areas.extend(vertices.windows(2).zip(tangents.windows(2)).map(|(ends, tangents)| {
        let edge = ends[1] - ends[0];
        let turns = tangents[0].perp_dot(edge) + edge.perp_dot(tangents[1]);
        edge.length() * turns / 12.0
    }));
    let mut before = vertices[0];
    for number in 1..=last {
        let [left, right] = [(number - 1, 0), (number, last)].map(|(edge, end)| {
            let share = if edge == end { 1.0 } else { 0.5 };
            areas[edge] * share
        });
        let own = vertices[number];
        let across = vertices[number + 1] - before;
        before = own;
        let by = -across.perp() * (2.0 * (left + right) / across.length_squared());
        if by.length_squared() < across.length_squared() {
            vertices[number] += by;
        }
    }
}

pub(super) fn point_at([from, first, second, to]: [DVec2; 4], t: f64) -> DVec2 {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola's arc from -1 to 1, an eighth of whose area is a sixth.
    #[test]
    fn vertices_off_the_curve_make_up_for_what_edges_leave_out() {
        let curve = |t: f64| DVec2::new(t, 1.0 - t * t);
        let tangent = |t: f64| DVec2::new(1.0, -2.0 * t).normalize();
        for steps in [2, 3, 10] {
            let places: Vec<f64> = (0..=steps).map(|i| f64::from(2 * i) / f64::from(steps) - 1.0).collect();
            let mut vertices: Vec<DVec2> = places.iter().map(|t| curve(*t)).collect();
            let tangents: Vec<DVec2> = places.iter().map(|t| tangent(*t)).collect();
            let below = |vertices: &[DVec2]| -> f64 {
                let trapezoid = |ends: &[DVec2]| (ends[1].x - ends[0].x) * f64::midpoint(ends[0].y, ends[1].y);
                vertices.windows(2).map(trapezoid).sum()
            };
            let left_out = 4.0 / 3.0 - below(&vertices);
            keep_area(&mut vertices, &tangents, &mut Vec::new());
            let off = 4.0 / 3.0 - below(&vertices);
            assert!(off.abs() < 0.12 * left_out, "{off} of {left_out}, {steps} steps");
            assert_eq!(
                [vertices[0], vertices[vertices.len() - 1]],
                [curve(-1.0), curve(1.0)],
                "its ends"
            );
        }
    }

    #[test]
    fn longer_edges_are_allowed_where_areas_count() {
        let quarter = 4.0 / 3.0 * (2.0_f64.sqrt() - 1.0);
        let arc = [[1.0, 0.0], [1.0, quarter], [quarter, 1.0], [0.0, 1.0]].map(|at| 10.0 * DVec2::from(at));
        let edges = |fineness| {
            let mut count = 0;
            let mut walk = Walk {
                fineness,
                half: 0.0,
                at: arc[0],
                tangent: DVec2::Y,
                visit: |_| count += 1,
            };
            walk.along(arc);
            count
        };
        // A length of (8 R α)^(1/3), or of (8 R ε)^(1/2).
        let area = Fineness::Area {
            area: 1e-3,
            distance: 1e-9,
        };
        let expected = 5.0 * std::f64::consts::PI / 0.08_f64.cbrt();
        assert!(
            (f64::from(edges(area)) - expected).abs() < 4.0,
            "{} of {expected}",
            edges(area)
        );
        let distance = Fineness::Area {
            area: 1e-9,
            distance: 1e-3,
        };
        assert_eq!(edges(distance), edges(Fineness::Distance(1e-3)), "whichever is longer");
    }
}
