//! How much of a pixel an area covers, exactly: what more and more samples come closer to.
//!
//! A polygon is cut by the pixel's four sides one after the other (Sutherland and Hodgman, "Reentrant polygon clipping",
//! 1974), and what is left is measured by the shoelace formula.

use glam::DVec2;

use super::{FillRule, Polygon};

/// The area that a triangle and pixel `[x, y]` have in common, `0.0..=1.0`; corners in pixels, anything else than a finite
/// number counts as no triangle.
pub fn area_in_pixel(corners: [DVec2; 3], pixel: [u32; 2]) -> f64 {
    let origin = DVec2::new(f64::from(pixel[0]), f64::from(pixel[1]));
    let polygon: Vec<DVec2> = corners.iter().map(|corner| *corner - origin).collect();
    if !polygon.iter().all(|corner| corner.is_finite()) {
        return 0.0;
    }
    area(&cut(&polygon, [DVec2::ZERO, DVec2::ONE])).clamp(0.0, 1.0)
}

/// What closed contours and a window have in common; the window is given by its least and its greatest corner.
///
/// Contours are cut before anything else is done with them, so that those that reach far beyond any pixel, or have many
/// points elsewhere, are measured as well as small ones.
pub fn cut_to_window(
    contours: impl Iterator<Item = impl Iterator<Item = DVec2>>,
    rule: FillRule,
    window: [DVec2; 2],
) -> Polygon {
    let inside = contours.map(|contour| {
        let contour: Vec<DVec2> = contour.collect();
        let is_finite = contour.iter().all(|corner| corner.is_finite());
        if is_finite { cut(&contour, window) } else { Vec::new() }
    });
    Polygon::new(inside, rule)
}

/// The part of a closed contour in a window, which is given by its least and its greatest corner. Parts of one that is not convex
/// stay joined along the window's border, back and forth.
pub(super) fn cut(contour: &[DVec2], [low, high]: [DVec2; 2]) -> Vec<DVec2> {
    let mut kept = contour.to_vec();
    for axis in [0, 1] {
        kept = cut_side(&kept, axis, low[axis], |distance| distance >= 0.0);
        kept = cut_side(&kept, axis, high[axis], |distance| distance <= 0.0);
    }
    kept
}

/// The part of a closed contour on one side of the line where a coordinate has the value `line`.
fn cut_side(contour: &[DVec2], axis: usize, line: f64, is_kept: fn(f64) -> bool) -> Vec<DVec2> {
    let mut kept = Vec::with_capacity(contour.len() + 1);
    let next = contour.iter().cycle().skip(1);
    for (from, to) in contour.iter().zip(next) {
        let (here, there) = (from[axis] - line, to[axis] - line);
        if is_kept(here) {
            kept.push(*from);
        }
        if is_kept(here) != is_kept(there) {
            // From the nearer end: the other one may be so far away that floats there know no pixels.
            let mut crossing = if here.abs() <= there.abs() {
                *from + (*to - *from) * (here / (here - there))
            } else {
                *to + (*from - *to) * (there / (there - here))
            };
            crossing[axis] = line;
            kept.push(crossing);
        }
    }
    kept
}

fn area(polygon: &[DVec2]) -> f64 {
    let Some(first) = polygon.first() else {
        return 0.0;
    };
    let doubled: f64 = polygon
        .windows(2)
        .map(|side| (side[0] - *first).perp_dot(side[1] - *first))
        .sum();
    doubled.abs() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_of_known_triangles() {
        let at = |x: f64, y: f64| DVec2::new(x, y);
        let cases = [
            (
                [at(-100.0, -100.0), at(300.0, -100.0), at(-100.0, 300.0)],
                1.0,
                "all of it",
            ),
            (
                [at(3.0, 4.0), at(4.0, 4.0), at(3.0, 5.0)],
                0.5,
                "half along the diagonal",
            ),
            ([at(3.25, 4.25), at(3.25, 4.75), at(3.75, 4.25)], 0.125, "inside"),
            ([at(5.0, 4.0), at(6.0, 4.0), at(5.0, 5.0)], 0.0, "beside it"),
            ([at(3.5, -1e9), at(3.5, 1e9), at(1e9, 0.0)], 0.5, "the right half"),
            (
                [at(3.0, 4.0), at(9e29, 1e30), at(1e30, 0.0)],
                0.55,
                "half way round the sky",
            ),
            (
                [at(0.0, 0.0), at(1e30, 0.0), at(0.0, 1e30)],
                1.0,
                "all, from the corner of the frame",
            ),
            (
                [at(0.0, 0.0), at(-1e30, 0.0), at(0.0, -1e30)],
                0.0,
                "the other side of it",
            ),
            ([at(3.0, 4.0), at(9.0, 10.0), at(6.0, 7.0)], 0.0, "a line"),
            ([at(f64::NAN, 4.0), at(9.0, 10.0), at(6.0, 7.0)], 0.0, "no triangle"),
        ];
        for (corners, expected, what) in cases {
            let found = area_in_pixel(corners, [3, 4]);
            assert!((found - expected).abs() < 1e-6, "{what}: {found}");
        }
    }

    #[test]
    fn contours_are_cut_before_they_are_measured() {
        let at = |x: f64, y: f64| DVec2::new(x, y);
        let window = [at(3.0, 4.0), at(4.0, 5.0)];
        let area = |contours: &[&[DVec2]], rule| {
            let contours = contours.iter().map(|contour| contour.iter().copied());
            cut_to_window(contours, rule, window).area().expect("few crossings")
        };
        let far = [at(-1e30, -1e30), at(1e30, -1e30), at(1e30, 1e30), at(-1e30, 1e30)];
        let hole = [at(3.25, 4.25), at(3.75, 4.25), at(3.75, 4.75), at(3.25, 4.75)];
        for (contours, rule, expected) in [
            (&[&far[..]][..], FillRule::NonZero, 1.0),
            (&[&far[..], &hole], FillRule::EvenOdd, 0.75),
            (&[&far[..], &hole], FillRule::NonZero, 1.0),
            (&[&far[..], &far], FillRule::EvenOdd, 0.0),
            (&[&hole[..]], FillRule::EvenOdd, 0.25),
        ] {
            let found = area(contours, rule);
            assert!((found - expected).abs() < 1e-6, "{contours:?} by {rule:?}: {found}");
        }
        // Two teeth of a comb reach into the window; what joins them lies below it.
        let comb = [
            at(3.0, 9.0),
            at(3.0, 4.5),
            at(3.25, 4.5),
            at(3.25, 8.0),
            at(3.75, 8.0),
            at(3.75, 4.5),
            at(4.0, 4.5),
            at(4.0, 9.0),
        ];
        assert!((area(&[&comb], FillRule::NonZero) - 0.25).abs() < 1e-6, "two teeth");
    }

    #[test]
    fn areas_of_all_pixels_sum_to_the_triangle() {
        arbtest::arbtest(|u| {
            let mut at = || Ok(f64::from(u.int_in_range(0..=80_000)?) / 1e4);
            let mut point = || -> arbtest::arbitrary::Result<DVec2> { Ok(DVec2::new(at()?, at()?)) };
            let corners = [point()?, point()?, point()?];
            let whole = (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]).abs() / 2.0;
            let sum: f64 = (0..64).map(|i| area_in_pixel(corners, [i % 8, i / 8])).sum();
            assert!((sum - whole).abs() < 1e-9, "{corners:?}: {sum} of {whole}");
            Ok(())
        })
        .budget_ms(100);
    }
}
