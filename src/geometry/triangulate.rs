//! Closed contours to triangles by fill rule: concave, self-touching and self-crossing ones too.
//!
//! Strictly convex contours become a fan. All others go to the integer core of `i_triangle`, on a grid at least as fine
//! as the largest coordinate's last bit; a vertex that comes back is exactly the vertex that went in, so that polygons
//! with a common edge keep it.

use std::collections::HashMap;

use glam::DVec2;
use i_triangle::i_overlay::core::fill_rule::FillRule as OverlayRule;
use i_triangle::i_overlay::core::overlay::IntOverlayOptions;
use i_triangle::i_overlay::i_float::int::point::IntPoint;
use i_triangle::int::custom::IntCustomTriangulatable as _;
use i_triangle::int::validation::Validation;

/// Bits of the integer grid's coordinates: at most 61 by the library's contract, at least 53 to keep all of a float.
const GRID_BITS: i32 = 58;
/// Contours with fewer edges cannot cross often enough to matter.
const FEW_EDGES: usize = 64;
/// Pairs of edges that are looked at per edge, to estimate how often all of them cross.
const PAIRS_PER_EDGE: usize = 4;
/// A corner counts as convex from this sine of its angle on.
const CONVEX_SINE: f64 = 1e-9;

/// Which points are inside contours that wind around them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FillRule {
    /// Those with a winding number other than zero.
    #[default]
    NonZero,
    /// Those with an odd winding number.
    EvenOdd,
}

/// Triangles that cover exactly the inside of the `contours`, without overlap, of either winding.
///
/// Contours close themselves. A contour with a coordinate that is not finite counts as absent. Time grows with the
/// number of crossings: see [`estimate_crossings`] for contours from strangers.
pub fn triangulate(contours: &[Vec<DVec2>], rule: FillRule) -> Vec<[DVec2; 3]> {
    let finite = |contour: &&Vec<DVec2>| contour.len() >= 3 && contour.iter().all(|point| point.is_finite());
    let contours: Vec<&[DVec2]> = contours
        .iter()
        .filter(finite)
        .map(|contour| without_closing(contour))
        .collect();
    match contours.as_slice() {
        [] => Vec::new(),
        [contour] if contour.len() == 3 || is_convex(contour) => fan(contour),
        _ => on_grid(&contours, rule),
    }
}

/// About how many times the edges of the contours cross, touch or overlap: exact enough to refuse contours whose
/// triangulation would take too long.
///
/// The estimate looks at a sample of all pairs, always the same for the same contours.
pub fn estimate_crossings(contours: &[Vec<DVec2>]) -> usize {
    let edges: Vec<[DVec2; 2]> = contours
        .iter()
        .flat_map(|contour| {
            let next = contour.iter().cycle().skip(1);
            contour.iter().zip(next).map(|(from, to)| [*from, *to])
        })
        .collect();
    let count = edges.len();
    if count < FEW_EDGES {
        return 0;
    }
    let samples = PAIRS_PER_EDGE * count;
    // Two low-discrepancy sequences (the plastic number's powers, Roberts 2018) choose the pairs.
    let index = |i: usize, step: f64| scaled_index((i as f64 * step).fract(), count);
    let hits = (0..samples)
        .filter(|&i| {
            cross(
                edges[index(i, 0.754_877_666_246_693)],
                edges[index(i, 0.569_840_290_998_053_3)],
            )
        })
        .count();
    // Of count^2 / 2 pairs, `samples` were looked at.
    hits * count / (2 * PAIRS_PER_EDGE)
}

/// `unit`, in `0.0..1.0`, as an index below `count`.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "0 <= unit < 1; clamped to the last index"
)]
fn scaled_index(unit: f64, count: usize) -> usize {
    ((unit * count as f64) as usize).min(count - 1)
}

/// Whether a sweep over both edges has to split one of them.
fn cross([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    let (abc, abd, cda, cdb) = (side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b));
    if abc == 0.0 && abd == 0.0 {
        let along = |p: DVec2| (p - a).dot(b - a);
        let (low, high) = (along(c).min(along(d)), along(c).max(along(d)));
        return low < along(b) && high > 0.0 && [a, b] != [c, d];
    }
    let shared = a == c || a == d || b == c || b == d;
    !shared && abc * abd <= 0.0 && cda * cdb <= 0.0
}

/// A contour without its last point, if that repeats the first.
fn without_closing(contour: &[DVec2]) -> &[DVec2] {
    match contour {
        [first, rest @ .., last] if first == last && rest.len() >= 2 => &contour[..contour.len() - 1],
        _ => contour,
    }
}

/// Whether a contour turns the same way at every corner, clearly, and once around in all.
fn is_convex(contour: &[DVec2]) -> bool {
    let n = contour.len();
    let edge = |i: usize| contour[(i + 1) % n] - contour[i % n];
    let mut winding = 0.0;
    let mut turns_back = 0;
    for i in 0..n {
        let (before, after) = (edge(i), edge(i + 1));
        let sine = before.perp_dot(after) / (before.length() * after.length());
        if sine.is_nan() || sine.abs() < CONVEX_SINE || sine * winding < 0.0 {
            return false;
        }
        winding = sine;
        // Once around, edges change between rightward and leftward twice.
        turns_back += usize::from((before.x < 0.0) != (after.x < 0.0));
    }
    turns_back == 2
}

fn fan(contour: &[DVec2]) -> Vec<[DVec2; 3]> {
    let (Some(&first), Some(rest)) = (contour.first(), contour.get(1..)) else {
        return Vec::new();
    };
    rest.windows(2).map(|pair| [first, pair[0], pair[1]]).collect()
}

/// Triangulates on an integer grid.
fn on_grid(contours: &[&[DVec2]], rule: FillRule) -> Vec<[DVec2; 3]> {
    let largest = contours
        .iter()
        .copied()
        .flatten()
        .fold(0.0, |max: f64, point| max.max(point.abs().max_element()));
    if largest == 0.0 {
        return Vec::new();
    }
    let grid = Grid::covering(largest);
    let mut originals: HashMap<(i64, i64), DVec2> = HashMap::new();
    let mut snap = |point: &DVec2| {
        let snapped = grid.snap(*point);
        originals.entry((snapped.x, snapped.y)).or_insert(*point);
        snapped
    };
    let shape: Vec<Vec<IntPoint<i64>>> = contours.iter().map(|c| c.iter().map(&mut snap).collect()).collect();
    let validation = Validation {
        fill_rule: match rule {
            FillRule::NonZero => OverlayRule::NonZero,
            FillRule::EvenOdd => OverlayRule::EvenOdd,
        },
        options: IntOverlayOptions {
            // A vertex amid a straight edge may be a neighbour's corner: dropping it would open a seam.
            preserve_input_collinear: true,
            ..IntOverlayOptions::keep_output_points()
        },
    };
    let mesh = shape.custom_triangulate(validation).into_triangulation::<u32>();
    let points: Vec<DVec2> = mesh
        .points
        .iter()
        .map(|point| {
            originals
                .get(&(point.x, point.y))
                .copied()
                .unwrap_or_else(|| grid.unsnap(*point))
        })
        .collect();
    let (triangles, _) = mesh.indices.as_chunks::<3>();
    triangles
        .iter()
        .map(|corners| corners.map(|i| points[i as usize]))
        .collect()
}

/// An integer grid around the origin.
#[derive(Clone, Copy, Debug)]
struct Grid {
    /// Grid steps per unit: a power of two.
    scale: f64,
}

impl Grid {
    /// The grid whose coordinates use [`GRID_BITS`] bits at `largest`, which is finite and above zero.
    fn covering(largest: f64) -> Self {
        // Beyond these exponents powers of two are no longer finite and normal floats.
        const EXPONENTS: std::ops::RangeInclusive<i32> = -1000..=1000;
        let (low, high) = (*EXPONENTS.start(), *EXPONENTS.end());
        #[expect(
            clippy::cast_possible_truncation,
            reason = "the logarithm of a finite float is below 1100"
        )]
        let exponent = largest.log2().floor() as i32 + 1;
        Self {
            scale: 2.0_f64.powi((GRID_BITS - exponent).clamp(low, high)),
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "scaled to less than GRID_BITS bits")]
    fn snap(self, point: DVec2) -> IntPoint<i64> {
        let scaled = (point * self.scale).round();
        IntPoint::new(scaled.x as i64, scaled.y as i64)
    }

    fn unsnap(self, point: IntPoint<i64>) -> DVec2 {
        DVec2::new(point.x as f64, point.y as f64) / self.scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contour(points: &[[f64; 2]]) -> Vec<DVec2> {
        points.iter().copied().map(DVec2::from).collect()
    }

    fn area(triangles: &[[DVec2; 3]]) -> f64 {
        triangles
            .iter()
            .map(|[a, b, c]| (b - a).perp_dot(c - a).abs() / 2.0)
            .sum()
    }

    fn area_of(points: &[[f64; 2]], rule: FillRule) -> f64 {
        area(&triangulate(&[contour(points)], rule))
    }

    fn assert_area(points: &[[f64; 2]], rule: FillRule, expected: f64, what: &str) {
        let found = area_of(points, rule);
        assert!((found - expected).abs() < 1e-12, "{what}: {found}, not {expected}");
    }

    #[test]
    fn triangulate_known_areas() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let closed = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 0.0]];
        let repeated = [
            [0.0, 0.0],
            [0.0, 0.0],
            [2.0, 0.0],
            [1.0, 0.0],
            [2.0, 0.0],
            [2.0, 2.0],
            [0.0, 2.0],
        ];
        let arrow = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [3.0, 1.0]];
        let bow_tie = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
        let twice = [
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 2.0],
            [0.0, 2.0],
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 2.0],
            [0.0, 2.0],
        ];
        for rule in [FillRule::NonZero, FillRule::EvenOdd] {
            assert_area(&square, rule, 4.0, "square");
            assert_area(&closed, rule, 4.0, "closed square");
            assert_area(&repeated, rule, 4.0, "repeated and collinear points");
            assert_area(&arrow, rule, 4.0, "concave");
            assert_area(&bow_tie, rule, 2.0, "crossing");
        }
        assert_area(&twice, FillRule::NonZero, 4.0, "wound twice is inside");
        assert_area(&twice, FillRule::EvenOdd, 0.0, "wound twice is outside");
    }

    #[test]
    fn triangulate_star_by_rule() {
        let corner = |i: u32| DVec2::from_angle(f64::from(i * 2 % 5) * std::f64::consts::TAU / 5.0);
        let star: Vec<DVec2> = (0..5).map(corner).collect();
        let all = area(&triangulate(std::slice::from_ref(&star), FillRule::NonZero));
        let arms = area(&triangulate(&[star], FillRule::EvenOdd));
        assert!(
            (all - 1.122_569_941_449_644).abs() < 1e-9,
            "pentagram with its heart: {all}"
        );
        assert!(
            (all - arms - 0.346_893_189).abs() < 1e-9,
            "the heart is a pentagon: {}",
            all - arms
        );
    }

    #[test]
    fn triangulate_nothing_from_nothing() {
        assert!(triangulate(&[], FillRule::NonZero).is_empty(), "no contour");
        assert_area(&[[0.0, 0.0], [1.0, 1.0]], FillRule::NonZero, 0.0, "two points");
        assert_area(&[[1.0, 1.0]; 9], FillRule::NonZero, 0.0, "one point nine times");
        assert_area(&[[0.0; 2]; 9], FillRule::NonZero, 0.0, "the origin nine times");
        let line: Vec<[f64; 2]> = (0..9).map(|i| [f64::from(i * 5 % 9), 0.0]).collect();
        assert_area(&line, FillRule::NonZero, 0.0, "a line");
        let broken = [[0.0, 0.0], [f64::NAN, 0.0], [1.0, 1.0], [0.0, f64::INFINITY]];
        assert_area(&broken, FillRule::NonZero, 0.0, "not finite");
    }

    #[test]
    fn triangulate_at_any_scale() {
        let arrow = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [3.0, 1.0], [2.0, 0.5]];
        let expected = area_of(&arrow, FillRule::NonZero);
        for scale in [1e-30, 1e-3, 1e3, 1e30, 1e38] {
            let points = arrow.map(|[x, y]| [x * scale, y * scale]);
            let found = area_of(&points, FillRule::NonZero) / scale / scale;
            assert!((found - expected).abs() < 1e-9, "at {scale}: {found} is not {expected}");
        }
    }

    #[test]
    fn triangulate_gives_vertices_back_exactly() {
        let points = contour(&[
            [0.1, 0.2],
            [0.3, 1e-20],
            [0.7, 0.9],
            [0.35, 0.25],
            [0.123_456_789, 0.98],
        ]);
        let triangles = triangulate(std::slice::from_ref(&points), FillRule::NonZero);
        for corner in triangles.iter().flatten() {
            assert!(points.contains(corner), "{corner} is none of the vertices");
        }
        assert_eq!(triangles.len(), 3, "five corners");
    }

    #[test]
    fn estimate_crossings_tells_simple_from_wild() {
        let circle: Vec<DVec2> = (0..10_000).map(|i| DVec2::from_angle(f64::from(i) * 1e-4)).collect();
        assert!(estimate_crossings(&[circle]) < 20_000, "about none");
        let random = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 8);
        let scribble: Vec<DVec2> = (0..10_000)
            .map(|i| DVec2::new(random(2 * i + 1), random(7 * i + 3)))
            .collect();
        assert!(estimate_crossings(&[scribble]) > 4_000_000, "millions");
        let line: Vec<DVec2> = (0..10_000).map(|i| DVec2::new(random(i), 0.0)).collect();
        assert!(estimate_crossings(&[line]) > 4_000_000, "all over each other");
    }
}
