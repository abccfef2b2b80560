//! Samples exactly on the edge of a shape that does not own it: the top-left rule gives them to the neighbour.
//!
//! Whether a point lies just inside is asked from three sides, without a rounding: left of it, above it, and both. Which one
//! finds the shape tells which edge it is.

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
    /// The shape only has a corner there, on its upper left.
    Corner,
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

/// The edge that a point lies on, where the shape of these edges has it and does not own it; `None` where the point is inside,
/// or off the shape.
fn not_owned(slopes: &[Slope], rule: FillRule, point: GridPoint) -> Option<NotOwned> {
    let [mut own, mut left, mut above, mut corner] = [0; 4];
    for slope in slopes {
        let value = edge_value(slope.top, slope.bottom, point);
        // To the left on the screen, since the edge runs down.
        let is_left = value < 0;
        if slope.top.y <= point.y && point.y < slope.bottom.y {
            own += slope.winding * i32::from(value <= 0);
            left += slope.winding * i32::from(is_left);
        }
        if slope.top.y < point.y && point.y <= slope.bottom.y {
            // A little above the point, an edge through it lies on the side that it comes from.
            let comes_from_left = value == 0 && slope.top.x <= slope.bottom.x;
            above += slope.winding * i32::from(is_left || comes_from_left);
            corner += slope.winding * i32::from(is_left);
        }
    }
    let is_inside = |winding: i32| match rule {
        FillRule::NonZero => winding != 0,
        FillRule::EvenOdd => winding % 2 != 0,
    };
    let sides = [
        (left, NotOwned::Right),
        (above, NotOwned::Bottom),
        (corner, NotOwned::Corner),
    ];
    let found = sides.into_iter().find(|(winding, _)| is_inside(*winding));
    found.filter(|_| !is_inside(own)).map(|(_, side)| side)
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
            ([8, 16], Some(NotOwned::Bottom)),
            ([16, 8], Some(NotOwned::Right)),
            ([13, 4], None),
        ] {
            assert_eq!(of(&diamond, point), expected, "{point:?}");
        }
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
