//! A filled area: contours and the rule that says which points they enclose.
//!
//! Where the contours stand for curves ([`Polygon::curved`]), the polygon knows the curves too, and gives finer contours to
//! views that show it larger.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use glam::{DAffine2, DVec2};

use super::{CurvedArea, FillRule, Fineness, estimate_crossings, triangulate};

/// Most crossings of edges, as estimated, of contours that are cut into triangles.
const MAX_CROSSINGS: usize = 200_000;

/// How far an edge may be from the curve that it stands for, in distances between samples.
const TOLERANCE: f64 = 0.1;

/// Where areas count, the most of an edge's length times its distance from its curve, in pixels: a third of it is less than a tenth
/// of a level of a byte.
const AREA_TOLERANCE: f64 = 8e-4;

/// How near to its curve an edge may be however long it is, in pixels: two thirds of that along a pixel's diagonal.
const AREA_DISTANCE: f64 = 4e-4;

/// How often the scale for which a curve is flattened is doubled at most.
const MAX_DOUBLINGS: u32 = 24;

/// Closed contours with a fill rule. All coordinates are finite.
#[derive(Debug)]
pub struct Polygon {
    /// All points, contour by contour.
    points: Vec<DVec2>,
    /// Where each contour ends in `points`.
    ends: Vec<usize>,
    rule: FillRule,
    /// The box around all points.
    bounds: [DVec2; 2],
    /// The triangles, once somebody asked for them.
    triangles: OnceLock<Option<Vec<[DVec2; 3]>>>,
    curves: Option<Box<Curves>>,
    is_stroke: bool,
    is_crisp: bool,
}

/// The curves that contours stand for.
#[derive(Debug)]
struct Curves {
    area: CurvedArea,
    /// Samples per canvas unit for which the contours are fine enough.
    scale: f64,
    /// Those of last time.
    finer: Mutex<Option<Finer>>,
    /// The same of edges that enclose the areas of the curves.
    same_area: Mutex<Option<Finer>>,
}

/// The step of scales, and the contours for it.
type Finer = (i32, Arc<Polygon>);

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
        let bounds = points
            .iter()
            .fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], point: &DVec2| {
                [low.min(*point), high.max(*point)]
            });
        Self {
            bounds,
            points,
            ends,
            rule,
            triangles: OnceLock::new(),
            curves: None,
            is_stroke: false,
            is_crisp: false,
        }
    }

    /// The contours of an area with curved edges, good for views of up to `scale` samples per canvas unit;
    /// [`Polygon::at_scale`] gives finer ones. A stroke is filled by the non-zero rule, whatever `rule` says.
    pub fn curved(area: CurvedArea, rule: FillRule, scale: f64) -> Self {
        let is_stroke = area.stroke.is_some();
        let rule = if is_stroke { FillRule::NonZero } else { rule };
        let flat = Self::new(area.flattened(Fineness::Distance(TOLERANCE / scale)), rule);
        let curves = (!area.is_straight()).then(|| {
            Box::new(Curves {
                area,
                scale,
                finer: Mutex::new(None),
                same_area: Mutex::new(None),
            })
        });
        // Curves bulge a little beyond the edges that stand for them.
        let bulge = DVec2::splat(if curves.is_some() { TOLERANCE / scale } else { 0.0 });
        let bounds = [flat.bounds[0] - bulge, flat.bounds[1] + bulge];
        Self {
            bounds,
            curves,
            is_stroke,
            ..flat
        }
    }

    /// The same area with edges fine enough for a view of so many samples per canvas unit: nowhere further from the curve
    /// than a tenth of the distance between samples. `None` where this one is fine enough itself.
    ///
    /// Scales are taken in steps of two, so that a view that moves sees the same edges.
    pub fn at_scale(&self, scale: f64) -> Option<Arc<Self>> {
        let curves = self.curves.as_ref()?;
        let doublings = doublings(scale / curves.scale)?;
        let tolerance = TOLERANCE / (curves.scale * f64::from(1_u32 << doublings));
        let step = doublings.cast_signed();
        Some(self.finer(&curves.finer, step, Fineness::Distance(tolerance)))
    }

    /// The same area with edges for a view of so many pixels per canvas unit where areas count: what one curve covers of a pixel is
    /// less than a tenth of a level off. `None` where all edges are straight.
    pub fn of_same_area(&self, scale: f64) -> Option<Arc<Self>> {
        let curves = self.curves.as_ref()?;
        let step = half_octaves(scale);
        let scale = (f64::from(step) / 2.0).exp2();
        let fineness = Fineness::Area {
            area: AREA_TOLERANCE / (scale * scale),
            distance: AREA_DISTANCE / scale,
        };
        Some(self.finer(&curves.same_area, step, fineness))
    }

    fn finer(&self, last: &Mutex<Option<Finer>>, step: i32, fineness: Fineness) -> Arc<Self> {
        let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((found, polygon)) = last.as_ref()
            && *found == step
        {
            return Arc::clone(polygon);
        }
        let contours = self.curves().map(|area| area.flattened(fineness)).unwrap_or_default();
        let polygon = Arc::new(Self::new(contours, self.rule));
        *last = Some((step, Arc::clone(&polygon)));
        polygon
    }

    /// The same polygon moved by some canvas units.
    #[must_use]
    pub fn moved(&self, by: DVec2) -> Self {
        if let Some(curves) = &self.curves {
            let mut area = curves.area.clone();
            area.to_user = DAffine2::from_translation(by) * area.to_user;
            let moved = Self::curved(area, self.rule, curves.scale);
            return Self {
                is_crisp: self.is_crisp,
                ..moved
            };
        }
        let contours = self.contours().map(|contour| contour.iter().map(|point| *point + by));
        Self {
            is_crisp: self.is_crisp,
            is_stroke: self.is_stroke,
            ..Self::new(contours, self.rule)
        }
    }

    /// The same area, to be drawn with crisp edges.
    #[must_use]
    pub fn with_crisp_edges(self) -> Self {
        Self { is_crisp: true, ..self }
    }

    /// Whether it covers whole pixels, those whose middles it holds (`shape-rendering: crispEdges` of SVG).
    pub fn is_crisp(&self) -> bool {
        self.is_crisp
    }

    /// Whether it is the stroke of a path.
    pub fn is_stroke(&self) -> bool {
        self.is_stroke
    }

    /// The curves that the contours stand for, if they stand for any.
    pub fn curves(&self) -> Option<&CurvedArea> {
        self.curves.as_ref().map(|curves| &curves.area)
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

    /// The box around the area, curves included: its least and its greatest corner; the former is not below the latter where there is none.
    pub fn bounds(&self) -> [DVec2; 2] {
        self.bounds
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

/// The least step of scales, two to an octave, that is not below one; far from any that is met, one of those.
#[expect(clippy::cast_possible_truncation, reason = "clamped")]
fn half_octaves(scale: f64) -> i32 {
    (2.0 * scale.log2()).ceil().clamp(-100.0, 100.0) as i32
}

/// How often 1 must be doubled to be at least `factor`; `None` for not at all.
fn doublings(factor: f64) -> Option<u32> {
    (1..=MAX_DOUBLINGS)
        .find(|doublings| factor <= f64::from(1_u32 << doublings))
        .or(Some(MAX_DOUBLINGS))
        .filter(|_| factor > 1.0)
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
    use crate::geometry::{LineCap, LineJoin, Path, Stroke, StrokeStyle, cut_to_window};

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
    fn curves_get_finer_edges_where_a_view_shows_them_larger() {
        let mut path = Path::default();
        path.move_to(DVec2::ZERO);
        path.quad_to(DVec2::new(50.0, 100.0), DVec2::new(100.0, 0.0));
        let area = CurvedArea {
            path: path.clone(),
            stroke: None,
            to_user: DAffine2::IDENTITY,
        };
        let polygon = Polygon::curved(area, FillRule::NonZero, 1.0);
        assert_eq!(polygon.at_scale(0.5), None, "fine enough");
        assert_eq!(polygon.at_scale(1.0), None, "just fine enough");
        let larger = polygon.at_scale(3.0).expect("finer edges");
        assert!(larger.points().len() > polygon.points().len(), "more of them");
        let same = polygon.at_scale(4.0).expect("finer edges");
        assert!(Arc::ptr_eq(&larger, &same), "the same up to the next step");
        // The area under the parabola is two thirds of its box.
        let exact = 100.0 * 50.0 * 2.0 / 3.0;
        let error = |polygon: &Polygon| (polygon.area().expect("no crossings") - exact).abs();
        assert!(error(&polygon.at_scale(1e4).expect("finer")) < 1e-2, "nearly exact");
        assert!(error(&polygon) < 15.0, "a tenth of a unit along its edge");
        assert!(polygon.at_scale(f64::INFINITY).is_some(), "as fine as it gets");
    }

    /// Fills and strokes of random curves, in random pixels that they pass through, some of them several times.
    #[test]
    fn edges_of_the_same_area_err_by_less_than_a_quarter_of_a_level() {
        let (mut worst, mut count) = (0.0_f64, 0);
        arbtest::arbtest(|u| {
            let reach = *u.choose(&[1.0, 4.0, 30.0])?;
            let mut place = || {
                let mut part = || Ok::<_, arbtest::arbitrary::Error>(f64::from(u.int_in_range(-1000..=1000)?) / 1000.0);
                Ok::<_, arbtest::arbitrary::Error>(reach * DVec2::new(part()?, part()?))
            };
            let mut path = Path::default();
            path.move_to(place()?);
            path.cubic_to([place()?, place()?], place()?);
            path.quad_to(place()?, place()?);
            path.close();
            let style = StrokeStyle {
                width: 0.25 * reach,
                cap: LineCap::Round,
                join: LineJoin::Round,
                miter_limit: 4.0,
            };
            let stroke = Stroke {
                style,
                dashes: Vec::new(),
                dash_offset: 0.0,
            };
            let area = CurvedArea {
                path,
                stroke: u.arbitrary::<bool>()?.then_some(stroke),
                to_user: DAffine2::IDENTITY,
            };
            let exact = Polygon::new(area.flattened(Fineness::Distance(2e-5)), FillRule::NonZero);
            let polygon = Polygon::curved(area, FillRule::NonZero, 1.0);
            let same_area = polygon.of_same_area(1.0).expect("curves");
            for _ in 0..4 {
                let corner = u.choose(exact.points())?.floor();
                let covered = |polygon: &Polygon| {
                    let contours = polygon.contours().map(|contour| contour.iter().copied());
                    cut_to_window(contours, polygon.rule(), [corner, corner + 1.0]).area()
                };
                if let (Some(found), Some(expected)) = (covered(&same_area), covered(&exact)) {
                    worst = worst.max((found - expected).abs());
                    count += 1;
                }
            }
            Ok(())
        })
        .size_min(1024)
        .budget_ms(1000);
        assert!(count > 20 && worst < 0.25 / 255.0, "{worst} of {count} pixels");
    }

    #[test]
    fn rules_differ_on_what_is_wound_twice() {
        for (winding, non_zero, even_odd) in [(0, false, false), (1, true, true), (-2, true, false), (-3, true, true)] {
            assert_eq!(FillRule::NonZero.encloses(winding), non_zero, "{winding}");
            assert_eq!(FillRule::EvenOdd.encloses(winding), even_odd, "{winding}");
        }
    }
}
