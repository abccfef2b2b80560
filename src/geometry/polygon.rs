//! A filled area of one colour: contours and the rule that says which points they enclose.

use std::sync::OnceLock;

use glam::DVec2;

use super::{FillRule, estimate_crossings, triangulate};

/// Most crossings of edges, as estimated, of contours that are cut into triangles.
const MAX_CROSSINGS: usize = 200_000;

/// Closed contours with a fill rule. All coordinates are finite.
#[derive(Debug)]
pub struct Polygon {
    /// All points, contour by contour.
    points: Vec<DVec2>,
    /// Where each contour ends in `points`.
    ends: Vec<usize>,
    rule: FillRule,
    /// The triangles, once somebody asked for them.
    triangles: OnceLock<Option<Vec<[DVec2; 3]>>>,
}

impl Polygon {
    /// Contours that close themselves; those of fewer than three points enclose nothing and are left out.
    pub fn new(contours: impl IntoIterator<Item = impl IntoIterator<Item = DVec2>>, rule: FillRule) -> Self {
        let (mut points, mut ends) = (Vec::new(), Vec::new());
        for contour in contours {
            let start = points.len();
            points.extend(contour);
            if points.len() - start < 3 {
                points.truncate(start);
            } else {
                ends.push(points.len());
            }
        }
        points.shrink_to_fit();
        Self {
            points,
            ends,
            rule,
            triangles: OnceLock::new(),
        }
    }

    /// The contours; the last point of each is joined to its first.
    pub fn contours(&self) -> impl Iterator<Item = &[DVec2]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| &self.points[start..*end])
    }

    /// All points of all contours.
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// Which points the contours enclose.
    pub fn rule(&self) -> FillRule {
        self.rule
    }

    /// Triangles that cover the same area without overlap, found when first asked for; `None` where the edges cross too
    /// often to find them in reasonable time.
    pub fn triangles(&self) -> Option<&[[DVec2; 3]]> {
        let cut = || {
            let contours: Vec<Vec<DVec2>> = self.contours().map(<[DVec2]>::to_vec).collect();
            (estimate_crossings(&contours) <= MAX_CROSSINGS).then(|| triangulate(&contours, self.rule))
        };
        self.triangles.get_or_init(cut).as_deref()
    }

    /// The area in square units, each part counted once.
    ///
    /// `None` where [`Polygon::triangles`] is.
    pub fn area(&self) -> Option<f64> {
        let area = |[a, b, c]: &[DVec2; 3]| (*b - *a).perp_dot(*c - *a).abs() / 2.0;
        Some(self.triangles()?.iter().map(area).sum())
    }
}

impl PartialEq for Polygon {
    fn eq(&self, other: &Self) -> bool {
        (&self.points, &self.ends, self.rule) == (&other.points, &other.ends, other.rule)
    }
}

impl FillRule {
    /// Whether points around which the contours wind `winding` times lie inside.
    #[inline]
    pub fn encloses(self, winding: i32) -> bool {
        match self {
            Self::NonZero => winding != 0,
            Self::EvenOdd => winding & 1 != 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(side: f64) -> Vec<DVec2> {
        [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]
            .map(DVec2::from)
            .to_vec()
    }

    #[test]
    fn contours_come_back_without_those_that_enclose_nothing() {
        let line = vec![DVec2::ZERO, DVec2::ONE];
        let polygon = Polygon::new([square(4.0), line, square(2.0)], FillRule::EvenOdd);
        let contours: Vec<&[DVec2]> = polygon.contours().collect();
        assert_eq!(contours, [&square(4.0)[..], &square(2.0)[..]], "both squares");
        assert_eq!(polygon.points().len(), 8, "all their points");
        assert_eq!(polygon.area(), Some(12.0), "a square ring");
        let none = Polygon::new([Vec::new()], FillRule::NonZero);
        assert_eq!((none.contours().count(), none.area()), (0, Some(0.0)), "nothing");
    }

    #[test]
    fn contours_that_cross_everywhere_have_no_triangles() {
        let random = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 8);
        let scribble = (0..10_000).map(|i| DVec2::new(random(2 * i + 1), random(7 * i + 3)));
        let polygon = Polygon::new([scribble.collect::<Vec<_>>()], FillRule::NonZero);
        assert_eq!(polygon.triangles(), None, "too many crossings");
    }

    #[test]
    fn rules_differ_on_what_is_wound_twice() {
        for (winding, non_zero, even_odd) in [(0, false, false), (1, true, true), (-2, true, false), (-3, true, true)] {
            assert_eq!(FillRule::NonZero.encloses(winding), non_zero, "{winding}");
            assert_eq!(FillRule::EvenOdd.encloses(winding), even_odd, "{winding}");
        }
    }
}
