//! Triangulation against the definition: a point is covered once if the winding number says inside, else never.

use std::collections::HashMap;

use arbtest::arbitrary::{Result, Unstructured};
use glam::DVec2;
use rasterscope::geometry::{FillRule, estimate_crossings, triangulate};

/// Contours on a coarse lattice, where repeated points, touching edges and overlaps are common.
fn contours(u: &mut Unstructured<'_>) -> Result<Vec<Vec<DVec2>>> {
    let side = *u.choose(&[3, 6, 20])?;
    let coordinate = |u: &mut Unstructured<'_>| Ok(f64::from(u.int_in_range(0..=side)?));
    let mut contours = Vec::new();
    for _ in 0..u.int_in_range(1..=3)? {
        let mut contour = Vec::new();
        for _ in 0..u.int_in_range(0..=12)? {
            contour.push(DVec2::new(coordinate(u)?, coordinate(u)?));
        }
        contours.push(contour);
    }
    Ok(contours)
}

/// How often the contours wind around `point`, which lies on none of them.
fn winding(contours: &[Vec<DVec2>], point: DVec2) -> i32 {
    let edge = |(a, b): (&DVec2, &DVec2)| {
        let left = (*b - *a).perp_dot(point - *a);
        match (a.y <= point.y, b.y <= point.y) {
            (true, false) if left > 0.0 => 1,
            (false, true) if left < 0.0 => -1,
            _ => 0,
        }
    };
    let of_contour = |contour: &Vec<DVec2>| {
        contour
            .iter()
            .zip(contour.iter().cycle().skip(1))
            .map(edge)
            .sum::<i32>()
    };
    contours.iter().map(of_contour).sum()
}

fn inside(contours: &[Vec<DVec2>], point: DVec2, rule: FillRule) -> bool {
    match rule {
        FillRule::NonZero => winding(contours, point) != 0,
        FillRule::EvenOdd => winding(contours, point) % 2 != 0,
    }
}

/// The three edge values of a point, in the triangle's own direction.
fn edge_values([a, b, c]: [DVec2; 3], point: DVec2) -> [f64; 3] {
    let direction = (b - a).perp_dot(c - a).signum();
    [(a, b), (b, c), (c, a)].map(|(from, to)| (to - from).perp_dot(point - from) * direction)
}

#[test]
fn triangulation_covers_the_inside_once() {
    arbtest::arbtest(|u| {
        let contours = contours(u)?;
        for rule in [FillRule::NonZero, FillRule::EvenOdd] {
            let triangles = triangulate(&contours, rule);
            for i in 0..60 {
                // Low-discrepancy probes off the lattice.
                let unit = |step: f64| (f64::from(i) * step + 0.137_531).fract();
                let point = DVec2::new(unit(0.754_877_666), unit(0.569_840_291)) * 21.0 - 0.5;
                let values: Vec<[f64; 3]> = triangles.iter().map(|triangle| edge_values(*triangle, point)).collect();
                if values.iter().flatten().any(|value| value.abs() < 1e-9) {
                    continue;
                }
                let covering = values
                    .iter()
                    .filter(|values| values.iter().all(|value| *value > 0.0))
                    .count();
                let expected = usize::from(inside(&contours, point, rule));
                assert_eq!(covering, expected, "{point} in {contours:?} by {rule:?}");
            }
        }
        Ok(())
    })
    .budget_ms(1_000);
}

#[test]
fn triangulation_keeps_vertices_and_conforms() {
    arbtest::arbtest(|u| {
        let contours = contours(u)?;
        let triangles = triangulate(&contours, FillRule::NonZero);
        let vertices: Vec<DVec2> = triangles.iter().flatten().copied().collect();
        for vertex in &vertices {
            let near = contours
                .iter()
                .flatten()
                .find(|original| original.distance(*vertex) < 1e-9);
            assert!(
                near.is_none_or(|original| original == vertex),
                "{vertex} is almost {near:?}"
            );
        }
        // A single contour of three points on a line comes back as it is.
        if triangles.len() == 1 {
            return Ok(());
        }
        // An edge of a single triangle is an edge of the whole: were it inside, there would be a seam. Crossings that
        // fall together but for the grid's last bit count as one vertex.
        let place = |vertex: DVec2| (vertex * 1e9).round().to_array().map(f64::to_bits);
        let mut uses: HashMap<[[u64; 2]; 2], (usize, [DVec2; 2])> = HashMap::new();
        for [a, b, c] in &triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let mut key = [place(*from), place(*to)];
                key.sort_unstable();
                uses.entry(key).or_insert((0, [*from, *to])).0 += 1;
            }
        }
        for ([start, end], (count, [from, to])) in uses {
            if start == end || count % 2 == 0 {
                continue;
            }
            let aside = (to - from).perp().normalize() * 1e-6;
            // Not the middle, where the lattice's diagonals cross.
            let amid = from.lerp(to, 0.437_129);
            let [left, right] = [aside, -aside].map(|aside| inside(&contours, amid + aside, FillRule::NonZero));
            assert!(left != right, "a seam at {from} {to}: {contours:?}");
        }
        Ok(())
    })
    .budget_ms(1_000);
}

#[test]
fn triangulation_crossing_estimate_is_near_the_truth() {
    let random = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 12);
    let scribble: Vec<DVec2> = (0..500)
        .map(|i| DVec2::new(random(2 * i + 1), random(9 * i + 4)))
        .collect();
    let edges: Vec<[DVec2; 2]> = scribble
        .iter()
        .zip(scribble.iter().cycle().skip(1))
        .map(|(a, b)| [*a, *b])
        .collect();
    let side = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a) > 0.0;
    let cross =
        |[a, b]: [DVec2; 2], [c, d]: [DVec2; 2]| side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
    let pairs = (0..edges.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let truth = pairs.filter(|&(i, j)| i - j > 1 && cross(edges[i], edges[j])).count();
    let estimate = estimate_crossings(&[scribble]);
    assert!(
        estimate > truth / 2 && estimate < truth * 2,
        "{estimate} is not about {truth}"
    );
}
