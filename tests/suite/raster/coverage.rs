//! Who owns a sample: shared edges, handedness, shifts, huge geometry.

use std::sync::Arc;

use arbtest::arbitrary::{Result, Unstructured};
use glam::DVec2;
use rasterscope::color::Rgba;
use rasterscope::geometry::{FillRule, Polygon, View};
use rasterscope::raster::Framebuffer;
use rasterscope::rules::Rules;
use rasterscope::scene::{Fill, Paint, PrimitiveKind};

use crate::support::scenes::{Fills, at_rate, drawn, one_to_one, random, scene, triangle};

/// Black where a pixel is `#`, white elsewhere; anything between is `+`.
fn picture(frame: &Framebuffer) -> Vec<String> {
    let mark = |pixel: &u32| match pixel & 0xFF {
        0 => '#',
        255 => '.',
        _ => '+',
    };
    frame
        .pixels()
        .chunks(frame.width() as usize)
        .map(|row| row.iter().map(mark).collect())
        .collect()
}

fn black(points: [(f64, f64); 3], rules: Rules) -> Vec<String> {
    let settings = rasterscope::render::RenderSettings { rules, ..at_rate(1) };
    picture(&drawn(
        &scene(6.0, vec![triangle(points, Rgba::BLACK)]),
        &one_to_one([6, 5]),
        &settings,
        [6, 5],
    ))
}

#[test]
fn coverage_of_ties_is_top_left() {
    // All corners on pixel centres: every edge passes through samples.
    let down = black([(0.5, 0.5), (4.5, 0.5), (0.5, 4.5)], Rules::Standard);
    assert_eq!(
        down,
        ["####..", "###...", "##....", "#.....", "......"],
        "top and left edges belong to it"
    );
    let up = black([(4.5, 0.5), (4.5, 4.5), (0.5, 4.5)], Rules::Standard);
    assert_eq!(
        up,
        ["......", "...#..", "..##..", ".###..", "......"],
        "bottom and right edges do not"
    );
    let mirrored = black([(0.5, 0.5), (4.5, 0.5), (4.5, 4.5)], Rules::Standard);
    assert_eq!(
        mirrored,
        ["####..", ".###..", "..##..", "...#..", "......"],
        "a falling diagonal is a left edge"
    );
}

#[test]
fn coverage_under_course_rules_is_inclusive() {
    let found = black([(0.5, 0.5), (4.5, 0.5), (0.5, 4.5)], Rules::Course);
    assert_eq!(
        found,
        ["#####.", "####..", "###...", "##....", "#....."],
        "every edge belongs to it"
    );
}

#[test]
fn coverage_is_the_same_for_both_windings_and_every_first_corner() {
    let points = [(0.7, 0.2), (5.1, 1.9), (1.3, 4.8)];
    let expected = black(points, Rules::Standard);
    for order in [[1, 2, 0], [2, 0, 1], [0, 2, 1], [1, 0, 2], [2, 1, 0]] {
        assert_eq!(
            black(order.map(|i| points[i]), Rules::Standard),
            expected,
            "corners in order {order:?}"
        );
    }
}

#[test]
fn coverage_of_no_area_is_nothing() {
    for points in [
        [(1.0, 1.0); 3],
        [(0.5, 0.5), (2.5, 2.5), (4.5, 4.5)],
        [(0.5, 2.5), (5.5, 2.5), (1.5, 2.5)],
    ] {
        for rules in Rules::ALL {
            assert!(
                black(points, rules).iter().all(|row| row == "......"),
                "{points:?} under {rules:?}"
            );
        }
    }
}

/// A mesh over more than the frame whose corners are shaken, some onto a coarse lattice.
fn mesh(u: &mut Unstructured<'_>, paint: Paint) -> Result<Vec<PrimitiveKind>> {
    const CELLS: usize = 6;
    let cell = 5.0;
    let mut corners = vec![[DVec2::ZERO; CELLS + 1]; CELLS + 1];
    for (j, row) in corners.iter_mut().enumerate() {
        for (i, corner) in row.iter_mut().enumerate() {
            let mut shake = || -> Result<f64> {
                let step = u.int_in_range(-4..=4)?;
                Ok(f64::from(step) * if u.ratio(3, 4)? { 0.5 } else { 0.499_371 })
            };
            *corner = DVec2::new(i as f64, j as f64) * cell - 5.0 + DVec2::new(shake()?, shake()?);
        }
    }
    let mut kinds = Vec::new();
    for j in 0..CELLS {
        for i in 0..CELLS {
            let (a, b, c, d) = (
                corners[j][i],
                corners[j][i + 1],
                corners[j + 1][i],
                corners[j + 1][i + 1],
            );
            // Of the two diagonals the one that lies well inside the cell. A triangle without area could turn over when its
            // corners are snapped, and lie on its neighbours.
            let least = |halves: [[DVec2; 3]; 2]| {
                let area = |[p, q, r]: [DVec2; 3]| (q - p).perp_dot(r - p);
                halves.map(area).into_iter().fold(f64::INFINITY, f64::min)
            };
            let (across, along) = ([[a, b, c], [b, d, c]], [[a, b, d], [a, d, c]]);
            let halves = if least(across) > least(along) { across } else { along };
            kinds.extend(halves.map(|points| PrimitiveKind::Triangle { points, paint }));
        }
    }
    Ok(kinds)
}

#[test]
fn coverage_of_a_shared_edge_is_once() {
    // Half transparent black: a sample hit once is mid grey, a hole stays white, a double hit is darker.
    let paint = Paint::Solid(Rgba { a: 0.5, ..Rgba::BLACK });
    arbtest::arbtest(|u| {
        let kinds = mesh(u, paint)?;
        let settings = at_rate(*u.choose(&[1, 4, 9, 16])?);
        let shift = f64::from(u.int_in_range(-8..=8)?) / 8.0;
        let rotation = f64::from(*u.choose(&[0, 0, 0, 90, 45, 17])?);
        let view = View::At {
            center: DVec2::splat(10.0 + shift),
            scale: 1.0,
            rotation,
        }
        .transform(DVec2::ONE, [12, 12]);
        let frame = drawn(&scene(20.0, kinds), &view, &settings, [12, 12]);
        let odd: Vec<u32> = frame
            .pixels()
            .iter()
            .copied()
            .filter(|pixel| *pixel != 0xFF80_8080)
            .collect();
        assert!(odd.is_empty(), "pixels {odd:X?} under {settings:?} and {view:?}");
        Ok(())
    })
    .budget_ms(1500);
}

#[test]
fn coverage_moves_by_whole_pixels_with_the_scene() {
    let fills = Fills::Translucent;
    arbtest::arbtest(|u| {
        let (mut before, settings) = (random(u, 20, fills)?, at_rate(*u.choose(&[1, 4, 9, 16])?));
        // The course's hairlines count their steps in 32-bit floats, which a shift changes.
        before
            .primitives
            .retain(|primitive| !matches!(primitive.kind, PrimitiveKind::Hairline { .. }));
        let (dx, dy) = (u.int_in_range(0..=9)?, u.int_in_range(0..=9)?);
        let mut after = before.clone();
        let shift = DVec2::new(f64::from(dx), f64::from(dy));
        for primitive in &mut after.primitives {
            match &mut primitive.kind {
                PrimitiveKind::Triangle { points, .. } => *points = points.map(|point| point + shift),
                PrimitiveKind::Polygon { polygon, .. } => {
                    let contours = polygon
                        .contours()
                        .map(|contour| contour.iter().map(|point| *point + shift));
                    *polygon = Arc::new(Polygon::new(contours, polygon.rule()));
                }
                PrimitiveKind::Point { at, .. } => *at += shift,
                _ => {}
            }
        }
        let view = one_to_one([40, 40]);
        let (before, after) = (
            drawn(&before, &view, &settings, [40, 40]),
            drawn(&after, &view, &settings, [40, 40]),
        );
        for y in 0..40 - dy {
            for x in 0..40 - dx {
                assert_eq!(
                    before.rgba(x, y),
                    after.rgba(x + dx, y + dy),
                    "pixel {x}, {y} moved by {dx}, {dy}"
                );
            }
        }
        Ok(())
    })
    .budget_ms(800);
}

#[test]
fn coverage_of_huge_geometry_is_clipped_never_wrapped() {
    for size in [1e5, 1e9, 1e30, 1e300] {
        // Two triangles whose shared edge runs through the frame cover all of it, once.
        let half = Rgba { a: 0.5, ..Rgba::BLACK };
        let kinds = vec![
            triangle([(-size, 3.0), (size, 3.0), (0.0, -size)], half),
            triangle([(-size, 3.0), (size, 3.0), (0.0, size)], half),
        ];
        let frame = drawn(&scene(6.0, kinds), &one_to_one([6, 6]), &at_rate(4), [6, 6]);
        assert!(
            frame.pixels().iter().all(|pixel| *pixel == 0xFF80_8080),
            "{size}: {:X?}",
            frame.pixels()
        );
    }
    let beside = vec![triangle([(1e30, 1e30), (2e30, 1e30), (1e30, 2e30)], Rgba::BLACK)];
    let frame = drawn(&scene(6.0, beside), &one_to_one([6, 6]), &at_rate(1), [6, 6]);
    assert!(
        frame.pixels().iter().all(|pixel| *pixel == 0xFFFF_FFFF),
        "nothing wraps into the frame"
    );
}

#[test]
fn coverage_of_a_polygon_is_that_of_its_triangles() {
    let inked = std::cell::Cell::new(0);
    let property = |u: &mut Unstructured<'_>| {
        // Corners of a star on a lattice full of ties: simple, so that its triangles have no corners of their own.
        let corners = u.int_in_range(3..=14)?;
        let mut contour = Vec::new();
        for i in 0..corners {
            let angle = f64::from(i) / f64::from(corners) * std::f64::consts::TAU;
            let radius = f64::from(u.int_in_range(4..=40)?) / 2.0;
            let corner = DVec2::splat(20.0) + DVec2::from_angle(angle) * radius;
            contour.push((corner * 4.0).round() / 4.0);
        }
        let polygon = Polygon::new([contour], FillRule::EvenOdd);
        let color = Rgba::BLACK.faded(0.5);
        let whole = vec![PrimitiveKind::Polygon {
            polygon: Arc::new(polygon),
            fill: Fill::Solid(color),
        }];
        let PrimitiveKind::Polygon { polygon, .. } = &whole[0] else {
            return Ok(());
        };
        let triangles = polygon.triangles().expect("few crossings").to_vec();
        let lattice = |points: &[DVec2; 3]| points.iter().all(|point| (*point * 4.0).fract() == DVec2::ZERO);
        if !triangles.iter().all(lattice) {
            // Rounding made the star cross itself.
            return Ok(());
        }
        let paint = Paint::Solid(color);
        let cut = triangles
            .into_iter()
            .map(|points| PrimitiveKind::Triangle { points, paint });
        let (whole, cut) = (scene(40.0, whole), scene(40.0, cut.collect()));
        let settings = at_rate(*u.choose(&[1, 4, 16, 25])?);
        let view = one_to_one([40, 40]);
        let found = drawn(&whole, &view, &settings, [40, 40]);
        assert!(
            found == drawn(&cut, &view, &settings, [40, 40]),
            "{:?}",
            whole.primitives
        );
        let found = found.pixels().iter().filter(|pixel| **pixel & 0xFF < 255).count();
        inked.set(inked.get() + found);
        Ok(())
    };
    // A busy machine draws few in one round.
    for _ in 0..10 {
        arbtest::arbtest(property).budget_ms(2_000);
        if inked.get() > 10_000 {
            return;
        }
    }
    panic!("{} pixels are too few to tell", inked.get());
}
