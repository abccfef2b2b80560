//! Samples exactly on the edge of a shape that does not own it: the top-left rule gives them to the neighbour.
//!
//! Whether the shape lies beside a point is asked without a rounding: left of it, above it, and between the edges that run down
//! from it or up. Which one finds the shape tells which edge it is.

use glam::DVec2;

use super::replay::{Explainer, placed};
use crate::geometry::FillRule;
use crate::geometry::clip::in_guard;
use crate::geometry::edge::edge_value;
use crate::geometry::subpixel::GridPoint;
use crate::raster::{PieceShape, SampleOfTriangle};
use crate::scene::PrimitiveKind;

/// Edges times samples of a primitive beyond which nothing is looked for.
const MOST_WORK: usize = 1_000_000;

/// Which edge of a shape a sample lies on that is not the shape's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotOwned {
    /// The shape is on the left of it.
    Right,
    /// The shape is above it.
    Bottom,
    /// The shape only has a corner there, with which it ends below.
    Corner,
    /// The shape only has a corner there, from which it goes down: the edge on the right of that begins there, too.
    Peak,
}

/// An edge of a contour that is not level.
#[derive(Clone, Copy, Debug)]
struct Slope {
    top: GridPoint,
    bottom: GridPoint,
    winding: i32,
}

impl Explainer<'_> {
    /// Which edge of a primitive each sample at these places in the pixel lies on, where it is not the primitive's own by the
    /// top-left rule.
    pub fn not_owned(&self, source: u32, positions: &[DVec2]) -> Vec<Option<NotOwned>> {
        let mut edges = Vec::new();
        let rule = self.slopes_of(source, &mut edges);
        let Some(rule) = rule.filter(|_| edges.len().saturating_mul(positions.len()) <= MOST_WORK) else {
            return vec![None; positions.len()];
        };
        let corner = DVec2::from(self.pixel.map(f64::from));
        // Samples lie on the grid.
        let point = |position: &DVec2| self.context.grid.snap(corner + *position);
        let side = |position: &DVec2| not_owned(&edges, rule, point(position));
        positions.iter().map(side).collect()
    }

    /// The edges of a primitive as they are snapped, and what is inside them; `None` where it has none, or reaches so far that it
    /// is cut before.
    fn slopes_of(&self, source: u32, edges: &mut Vec<Slope>) -> Option<FillRule> {
        let (screen, grid) = (self.screen(), self.context.grid);
        let mut add = |contour: &mut dyn Iterator<Item = DVec2>| {
            let snapped = contour.map(|point| in_guard(point).then(|| grid.snap(point)));
            let points: Vec<GridPoint> = snapped.collect::<Option<_>>()?;
            edges.extend(slopes(&points));
            Some(())
        };
        match &self.subject.scene.primitives.get(source as usize)?.kind {
            PrimitiveKind::Triangle { points, .. } => {
                add(&mut points.iter().map(|point| screen.place(*point)))?;
                Some(FillRule::NonZero)
            }
            PrimitiveKind::Polygon { polygon, .. } => screen.with_edges(polygon, |polygon| {
                placed(polygon, &screen).try_for_each(|mut contour| add(&mut contour))?;
                Some(polygon.rule())
            }),
            _ => None,
        }
    }

    /// For each sample of the pixel whether it lies on an edge of a primitive by the float rules, which give it to nobody.
    pub fn on_float_edges(&self, source: u32, samples: usize) -> Vec<bool> {
        let is_on_edge = |view: &SampleOfTriangle| {
            let floats = view.floats.unwrap_or([1.0; 3]);
            floats.iter().all(|value| *value >= 0.0) && floats.contains(&0.0)
        };
        let mut found = vec![false; samples];
        let primitive = self.subject.scene.primitives.get(source as usize);
        let pieces = primitive.map(|primitive| self.all_pieces_of(primitive).1);
        for piece in pieces.into_iter().flatten() {
            if let PieceShape::Triangle { samples, .. } = piece.shape {
                for (found, view) in found.iter_mut().zip(&samples) {
                    *found |= is_on_edge(view);
                }
            }
        }
        found
    }
}

/// The edges of a closed contour.
fn slopes(contour: &[GridPoint]) -> impl Iterator<Item = Slope> {
    let next = contour.iter().cycle().skip(1);
    contour
        .iter()
        .zip(next)
        .filter_map(|(from, to)| match from.y.cmp(&to.y) {
            std::cmp::Ordering::Less => Some(Slope {
                top: *from,
                bottom: *to,
                winding: 1,
            }),
            std::cmp::Ordering::Equal => None,
            std::cmp::Ordering::Greater => Some(Slope {
                top: *to,
                bottom: *from,
                winding: -1,
            }),
        })
}

/// What of a shape lies just above or just below a point.
#[derive(Debug, Default)]
struct Half {
    /// The winding left of all edges through the point.
    left: i32,
    /// Those edges: how far each goes to the right, and how far up or down, and its winding.
    through: Vec<(i64, i64, i32)>,
}

impl Half {
    /// Adds an edge that reaches the row just above or below the point; `end` is its end there, `value` its edge function.
    fn add(&mut self, slope: &Slope, end: GridPoint, (value, point): (i64, GridPoint)) {
        if value == 0 {
            let across = i64::from(end.x) - i64::from(point.x);
            let along = (i64::from(end.y) - i64::from(point.y)).abs();
            self.through.push((across, along, slope.winding));
        } else if value < 0 {
            // To the left on the screen, since the edge runs down.
            self.left += slope.winding;
        }
    }

    /// The windings from left to right: left of the edges through the point, between them, and right of them.
    fn windings(mut self) -> Vec<i32> {
        // Leaning as two edges do: by the sign of how they turn.
        let lean = |a: &(i64, i64, i32), b: &(i64, i64, i32)| (a.0 * b.1).cmp(&(b.0 * a.1));
        self.through.sort_by(lean);
        let mut windings = vec![self.left];
        let mut winding = self.left;
        for alike in self.through.chunk_by(|a, b| lean(a, b).is_eq()) {
            winding += alike.iter().map(|(.., winding)| winding).sum::<i32>();
            windings.push(winding);
        }
        windings
    }
}

/// The edge that a point lies on, where the shape of these edges has it and does not own it; `None` where the point is inside,
/// or off the shape.
fn not_owned(slopes: &[Slope], rule: FillRule, point: GridPoint) -> Option<NotOwned> {
    let [mut above, mut below] = [Half::default(), Half::default()];
    for slope in slopes {
        let value = edge_value(slope.top, slope.bottom, point);
        if slope.top.y <= point.y && point.y < slope.bottom.y {
            below.add(slope, slope.bottom, (value, point));
        }
        if slope.top.y < point.y && point.y <= slope.bottom.y {
            above.add(slope, slope.top, (value, point));
        }
    }
    let is_inside = |winding: &i32| match rule {
        FillRule::NonZero => *winding != 0,
        FillRule::EvenOdd => winding % 2 != 0,
    };
    let (below, above) = (below.windings(), above.windings());
    let (left, own) = (below.first()?, below.last()?);
    let (upper_left, upper_right) = (above.first()?, above.last()?);
    if is_inside(own) {
        None
    } else if is_inside(left) {
        Some(NotOwned::Right)
    } else if is_inside(upper_right) {
        Some(NotOwned::Bottom)
    } else if is_inside(upper_left) || above.iter().any(is_inside) {
        Some(NotOwned::Corner)
    } else {
        below.iter().any(is_inside).then_some(NotOwned::Peak)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(contour: &[[i32; 2]], [x, y]: [i32; 2]) -> Option<NotOwned> {
        let points: Vec<GridPoint> = contour.iter().map(|[x, y]| GridPoint { x: *x, y: *y }).collect();
        let slopes: Vec<Slope> = slopes(&points).collect();
        not_owned(&slopes, FillRule::NonZero, GridPoint { x, y })
    }

    #[test]
    fn edges_on_the_right_and_at_the_bottom_are_not_owned() {
        let square = [[0, 0], [8, 0], [8, 8], [0, 8]];
        let mut turned = square;
        turned.reverse();
        for contour in [square, turned] {
            for (point, expected) in [
                ([4, 4], None),
                ([0, 4], None),
                ([4, 0], None),
                ([0, 0], None),
                ([8, 4], Some(NotOwned::Right)),
                ([8, 0], Some(NotOwned::Right)),
                ([4, 8], Some(NotOwned::Bottom)),
                ([0, 8], Some(NotOwned::Bottom)),
                ([8, 8], Some(NotOwned::Corner)),
                ([9, 4], None),
                ([4, 9], None),
                ([-1, 8], None),
            ] {
                assert_eq!(of(&contour, point), expected, "{point:?} of {contour:?}");
            }
        }
    }

    #[test]
    fn slanted_edges_have_a_side() {
        // A square on its corner: its upper and lower left edges own their lines.
        let diamond = [[8, 0], [16, 8], [8, 16], [0, 8]];
        for (point, expected) in [
            ([4, 4], None),
            ([4, 12], None),
            ([12, 4], Some(NotOwned::Right)),
            ([12, 12], Some(NotOwned::Right)),
            ([8, 0], Some(NotOwned::Peak)),
            ([8, 16], Some(NotOwned::Corner)),
            ([16, 8], Some(NotOwned::Right)),
            ([0, 8], None),
            ([13, 4], None),
        ] {
            assert_eq!(of(&diamond, point), expected, "{point:?}");
        }
    }

    #[test]
    fn corners_that_only_go_up_or_down_are_not_owned() {
        // To both sides, with an upright edge on either, and leaning either way.
        for [left, right] in [[-4, 4], [0, 4], [-4, 0], [2, 4], [-4, -2]] {
            for (end, expected) in [(8, NotOwned::Peak), (-8, NotOwned::Corner)] {
                let mut contour = [[0, 0], [left, end], [right, end]];
                assert_eq!(of(&contour, [0, 0]), Some(expected), "{contour:?}");
                contour.reverse();
                assert_eq!(of(&contour, [0, 0]), Some(expected), "{contour:?}");
                assert_eq!(of(&contour, [0, -end]), None, "{contour:?}");
            }
        }
        // The left end of a bottom edge under a side that leans out.
        assert_eq!(of(&[[0, 0], [8, 0], [8, -8], [4, -8]], [0, 0]), Some(NotOwned::Bottom));
        // There and back again is nothing.
        assert_eq!(of(&[[0, 0], [4, 8]], [0, 0]), None);
        assert_eq!(of(&[[0, 0], [4, -8]], [0, 0]), None);
    }

    #[test]
    fn of_two_neighbours_one_owns_what_the_other_does_not() {
        let (left, right) = ([[0, 0], [5, 9], [0, 9]], [[0, 0], [9, 0], [5, 9]]);
        // On the edge that they share, which runs down to the right, are points of the grid.
        let wide = [left, right].map(|contour| contour.map(|[x, y]| [x * 9, y * 9]));
        for y in 1..9 {
            let point = [y * 5, y * 9];
            assert_eq!(of(&wide[0], point), Some(NotOwned::Right), "{point:?}");
            assert_eq!(of(&wide[1], point), None, "{point:?}");
        }
    }
}
