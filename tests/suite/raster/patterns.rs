//! Sample patterns: where samples lie, that each is covered once, and what a pattern is good for.

use std::collections::BTreeSet;

use glam::DVec2;
use rasterscope::color::Rgba;
use rasterscope::geometry::{FillRule, Polygon, View};
use rasterscope::raster::{Framebuffer, SamplePattern, SampleRate, Seed};
use rasterscope::render::{RenderSettings, Subject, replay};
use rasterscope::rules::Rules;
use rasterscope::scene::{Dialect, Fill, Paint, PrimitiveKind, Scene};
use rasterscope::viewer::patterns;

use crate::support::brute_force;
use crate::support::scenes::{drawn, gallery_scene, one_to_one, scene};

/// Points of the lattice that samples are snapped to, along one side of a pixel.
const LATTICE: f64 = 256.0;

fn settings(pattern: SamplePattern, samples: u32) -> RenderSettings {
    RenderSettings {
        sample_rate: SampleRate::new(samples).expect("a rate"),
        pattern,
        outline: false,
        ..RenderSettings::default()
    }
}

/// Where the samples of a pixel lie.
fn positions(pattern: SamplePattern, samples: u32, pixel: [u32; 2]) -> Vec<[f64; 2]> {
    let empty = Scene::empty(DVec2::ONE, Dialect::Svg);
    let view = View::Default.transform(DVec2::ONE, [64, 64]);
    let subject = Subject {
        scene: &empty,
        view: &view,
        settings: &settings(pattern, samples),
    };
    let found = replay(&subject, [64, 64], pixel).expect("inside");
    found.samples.into_iter().map(|sample| sample.position).collect()
}

/// The cell of an `n x n` division that holds a position.
fn cell(position: [f64; 2], n: u32) -> [u32; 2] {
    position.map(|at| (0..n).rfind(|k| f64::from(*k) <= at * f64::from(n)).unwrap_or(0))
}

/// The star discrepancy of a set of points: how far the share of points in any box from the corner is from its area. A
/// box ends at points' coordinates; from the brute-force definition (Niederreiter, "Random Number Generation and
/// Quasi-Monte Carlo Methods", 1992, chapter 2).
fn discrepancy(points: &[[f64; 2]]) -> f64 {
    let ends = |axis: usize| points.iter().map(move |point| point[axis]).chain([1.0]);
    let mut worst = 0.0_f64;
    for x in ends(0) {
        for y in ends(1) {
            let share = |inside: &dyn Fn(&[f64; 2]) -> bool| {
                points.iter().filter(|point| inside(point)).count() as f64 / points.len() as f64
            };
            let open = share(&|point| point[0] < x && point[1] < y);
            let closed = share(&|point| point[0] <= x && point[1] <= y);
            worst = worst.max(x * y - open).max(closed - x * y);
        }
    }
    worst
}

#[test]
fn patterns_with_cells_have_one_sample_in_each() {
    for pattern in SamplePattern::ALL.into_iter().filter(|pattern| pattern.needs_square()) {
        for n in 1..=16 {
            for pixel in [[0, 0], [1, 0], [17, 40], [63, 63]] {
                let samples = positions(pattern, n * n, pixel);
                let cells: Vec<[u32; 2]> = samples.iter().map(|position| cell(*position, n)).collect();
                let row_by_row: Vec<[u32; 2]> = (0..n * n).map(|i| [i % n, i / n]).collect();
                assert_eq!(cells, row_by_row, "{pattern:?} {n} x {n} in {pixel:?}");
            }
        }
    }
}

#[test]
fn rotated_grid_has_as_many_columns_and_rows_as_samples() {
    for n in 1..=16 {
        let samples = positions(SamplePattern::Rotated, n * n, [3, 4]);
        for axis in [0, 1] {
            let places: BTreeSet<u64> = samples.iter().map(|position| position[axis].to_bits()).collect();
            assert_eq!(places.len(), (n * n) as usize, "axis {axis} of {n} x {n}");
        }
    }
    let four = positions(SamplePattern::Rotated, 4, [0, 0]);
    let expected = [[0.125, 0.375], [0.625, 0.125], [0.375, 0.875], [0.875, 0.625]];
    for (found, expected) in four.iter().zip(expected) {
        let near = (0..2).all(|axis| (found[axis] - expected[axis]).abs() < 1.0 / LATTICE);
        assert!(near, "{found:?} is the hardware's {expected:?}");
    }
}

#[test]
fn sequences_are_more_even_than_random_points() {
    for samples in [16, 37, 64, 128] {
        let mean = |pattern| {
            let of_pixel = |i: u32| discrepancy(&positions(pattern, samples, [i % 5, i / 5]));
            (0..20).map(of_pixel).sum::<f64>() / 20.0
        };
        let random = mean(SamplePattern::Random);
        let of_pixels = mean(SamplePattern::Sobol);
        assert!(
            of_pixels < 0.8 * random,
            "scrambled {samples}: {of_pixels} against {random}"
        );
        for pattern in [
            SamplePattern::Halton,
            SamplePattern::R2,
            SamplePattern::Hammersley,
            SamplePattern::SobolSame,
        ] {
            let found = discrepancy(&positions(pattern, samples, [5, 5]));
            // Few points are never even.
            let most = if samples < 64 { 0.95 } else { 0.6 };
            assert!(found < most * random, "{pattern:?} {samples}: {found} against {random}");
        }
    }
}

#[test]
fn random_points_are_anywhere_alike() {
    let mut bins = [[0_u32; 16]; 2];
    for pixel in (0..64 * 64).map(|i| [i % 64, i / 64]) {
        for position in positions(SamplePattern::Random, 3, pixel) {
            for (bins, at) in bins.iter_mut().zip(position) {
                let bin = (0..16).rfind(|bin| f64::from(*bin) <= at * 16.0).unwrap_or(0);
                bins[usize::try_from(bin).expect("small")] += 1;
            }
        }
    }
    for bin in bins.as_flattened() {
        // 768 are expected; five standard deviations are 134.
        assert!(bin.abs_diff(768) < 134, "{bins:?}");
    }
}

#[test]
fn seeds_choose_other_places_where_chance_decides() {
    for pattern in SamplePattern::ALL {
        let places = |seed: u32| {
            let empty = Scene::empty(DVec2::ONE, Dialect::Svg);
            let view = View::Default.transform(DVec2::ONE, [64, 64]);
            let settings = RenderSettings {
                seed: Seed::new(seed).expect("a seed"),
                ..settings(pattern, 16)
            };
            let subject = Subject {
                scene: &empty,
                view: &view,
                settings: &settings,
            };
            let found = replay(&subject, [64, 64], [7, 9]).expect("inside");
            found
                .samples
                .into_iter()
                .map(|sample| sample.position)
                .collect::<Vec<_>>()
        };
        assert_eq!(
            places(0),
            positions(pattern, 16, [7, 9]),
            "{pattern:?}: the first by default"
        );
        assert_eq!(places(1) != places(0), pattern.is_seeded(), "{pattern:?}");
        assert_eq!(places(1), places(1), "{pattern:?}: again the same");
    }
    assert_eq!(Seed::new(Seed::MAX + 1), None, "no such seed");
}

#[test]
fn jitter_fills_its_cells_evenly_and_differs_from_pixel_to_pixel() {
    // A histogram of 16 bins over all jitters of a 2 x 2 pattern, per axis and cell.
    let mut bins = [[0_u32; 16]; 8];
    let mut seen = BTreeSet::new();
    for pixel in (0..64 * 64).map(|i| [i % 64, i / 64]) {
        let samples = positions(SamplePattern::Jittered, 4, pixel);
        seen.insert(samples.iter().flatten().map(|at| at.to_bits()).collect::<Vec<u64>>());
        for (i, position) in samples.iter().enumerate() {
            for axis in [0, 1] {
                let inside = position[axis] * 2.0 - f64::from(cell(*position, 2)[axis]);
                let bin = (0..16).rfind(|bin| f64::from(*bin) <= inside * 16.0).unwrap_or(0);
                bins[i * 2 + axis][usize::try_from(bin).expect("small")] += 1;
            }
        }
    }
    assert!(seen.len() > 4000, "{} of 4096 pixels differ", seen.len());
    for bin in bins.as_flattened() {
        // 256 are expected; five standard deviations are 77.
        assert!(bin.abs_diff(256) < 77, "{bins:?}");
    }
    let same = positions(SamplePattern::JitteredSame, 16, [0, 0]);
    assert_eq!(
        positions(SamplePattern::JitteredSame, 16, [40, 7]),
        same,
        "alike in every pixel"
    );
}

/// A fan of triangles about a point, which together fill a square; all of them translucent, so that a sample painted
/// twice shows, and so does one that is left out.
fn fan(corners: &[DVec2], middle: DVec2, as_polygons: bool) -> Scene {
    let color = Rgba::from_bytes([0, 0, 0, 128]);
    let kinds = corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| {
        let points = [middle, *a, *b];
        if as_polygons {
            let polygon = Polygon::new(vec![points.to_vec()], FillRule::NonZero);
            return PrimitiveKind::Polygon {
                polygon: polygon.into(),
                fill: Fill::Solid(color),
            };
        }
        let paint = Paint::Solid(color);
        PrimitiveKind::Triangle { points, paint }
    });
    scene(30.0, kinds.collect())
}

#[test]
fn shared_edges_cover_each_sample_once_in_every_pattern() {
    const SIZE: [u32; 2] = [30, 30];
    arbtest::arbtest(|u| {
        let pattern = *u.choose(&SamplePattern::ALL)?;
        let samples = *u.choose(if pattern.needs_square() {
            &[1, 4, 9, 16][..]
        } else {
            &[1, 3, 5, 16]
        })?;
        // On points of the lattice, where ties are, or anywhere.
        let unit = *u.choose(&[1.0, 0.5, 1.0 / LATTICE, 0.013])?;
        let mut inside = || -> arbtest::arbitrary::Result<f64> {
            let steps: u16 = u.int_in_range(0..=1000)?;
            Ok((f64::from(steps) / 1000.0 * 28.0 / unit).round() * unit + 1.0 + 0.5 / LATTICE)
        };
        let middle = DVec2::new(inside()?, inside()?);
        let mut corners = Vec::new();
        for side in 0..4 {
            // Along one side of a frame that holds everything, clockwise.
            let mut along = [inside()?, inside()?];
            along.sort_by(f64::total_cmp);
            corners.extend(along.map(|at| match side {
                0 => DVec2::new(at, -2.0),
                1 => DVec2::new(32.0, at),
                2 => DVec2::new(31.0 - at, 32.0),
                _ => DVec2::new(-2.0, 31.0 - at),
            }));
        }
        // The square's own corners, so that the fan covers the frame.
        let (low, high) = (-2.0, 32.0);
        corners.insert(6, DVec2::new(low, high));
        corners.insert(4, DVec2::new(high, high));
        corners.insert(2, DVec2::new(high, low));
        corners.insert(0, DVec2::new(low, low));
        let once = 0xFF7F_7F7F;
        for as_polygons in [false, true] {
            let frame = drawn(
                &fan(&corners, middle, as_polygons),
                &one_to_one(SIZE),
                &settings(pattern, samples),
                SIZE,
            );
            let wrong = frame.pixels().iter().position(|pixel| *pixel != once);
            assert_eq!(
                wrong, None,
                "{pattern:?} {samples} {as_polygons} about {middle}: {corners:?}"
            );
        }
        Ok(())
    })
    .budget_ms(1500);
}

#[test]
fn patterns_that_are_the_same_in_every_pixel_move_with_the_scene() {
    const SIZE: [u32; 2] = [40, 30];
    let points = [DVec2::new(3.2, 1.7), DVec2::new(17.9, 6.1), DVec2::new(6.3, 18.4)];
    let colors = [Rgba::BLACK, Rgba::opaque(1.0, 0.5, 0.0), Rgba::opaque(0.0, 0.5, 1.0)];
    let triangle = |by: DVec2| {
        let points = points.map(|point| point + by);
        scene(
            40.0,
            vec![PrimitiveKind::Triangle {
                points,
                paint: Paint::Vertex(colors),
            }],
        )
    };
    for pattern in SamplePattern::ALL {
        let settings = settings(pattern, 16);
        let picture = |by| drawn(&triangle(by), &one_to_one(SIZE), &settings, SIZE);
        let (here, there) = (picture(DVec2::ZERO), picture(DVec2::new(9.0, 5.0)));
        let moved = (0..22).all(|y| (0..22).all(|x| here.rgba(x, y) == there.rgba(x + 9, y + 5)));
        assert_eq!(moved, !pattern.differs_by_pixel(), "{pattern:?}");
    }
}

#[test]
fn pictures_of_every_pattern_are_those_of_one_thread() {
    const SIZE: [u32; 2] = [150, 90];
    let corners: Vec<DVec2> = (0..40)
        .map(|i| {
            DVec2::from_angle(f64::from(i) * 0.157) * if i % 2 == 0 { 70.0 } else { 25.0 } + DVec2::new(75.0, 45.0)
        })
        .collect();
    let star = Polygon::new(vec![corners], FillRule::EvenOdd);
    let kind = PrimitiveKind::Polygon {
        polygon: star.into(),
        fill: Fill::Solid(Rgba::from_bytes([20, 60, 200, 170])),
    };
    let scene = scene(150.0, vec![kind]);
    for pattern in SamplePattern::ALL {
        for rules in Rules::ALL {
            let settings = RenderSettings {
                rules,
                ..settings(pattern, 9)
            };
            let on = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new()
                    .num_threads(threads)
                    .build()
                    .expect("threads");
                pool.install(|| drawn(&scene, &one_to_one(SIZE), &settings, SIZE))
            };
            assert!(on(1) == on(3), "{pattern:?} {rules:?}");
        }
    }
}

const STUDY: [u32; 2] = [1024, 1024];

/// A scene of the gallery, drawn at 1024 x 1024 in the default view.
fn study(name: &str, pattern: SamplePattern, samples: u32) -> Framebuffer {
    let scene = gallery_scene(name);
    let view = View::Default.transform(scene.canvas, STUDY);
    drawn(&scene, &view, &settings(pattern, samples), STUDY)
}

/// Red of a pixel.
fn red(frame: &Framebuffer, x: u32, y: u32) -> f64 {
    frame.rgba(x, y).expect("inside")[0].into()
}

/// Root mean square of the errors in red of means over blocks of `side x side` pixels.
fn block_error(found: &Framebuffer, truth: &Framebuffer, side: u32) -> f64 {
    let blocks = (STUDY[0] / side) * (STUDY[1] / side);
    let of_block = |i: u32| {
        let (left, top) = (i % (STUDY[0] / side) * side, i / (STUDY[0] / side) * side);
        let pixels = (0..side * side).map(|i| (left + i % side, top + i / side));
        let sum: f64 = pixels.map(|(x, y)| red(found, x, y) - red(truth, x, y)).sum();
        sum / f64::from(side * side)
    };
    let squares: f64 = (0..blocks).map(|i| of_block(i).powi(2)).sum();
    (squares / f64::from(blocks)).sqrt()
}

#[test]
fn study_of_thin_rays_is_where_jitter_beats_the_grid() {
    let name = "study/13_thin_rays.svg";
    let truth = study(name, SamplePattern::Grid, 256);
    for (samples, of_jittered) in [(1, 0.9), (4, 0.6)] {
        // What is left from a step back, where grain is a shade and dashes are still dashes.
        let error = |pattern| block_error(&study(name, pattern, samples), &truth, 8);
        let (grid, jittered) = (error(SamplePattern::Grid), error(SamplePattern::Jittered));
        assert!(
            jittered < 0.8 * grid,
            "rate {samples}: jittered {jittered}, grid {grid}"
        );
        // What pixels get wrong cancels out among neighbours.
        let blue = error(SamplePattern::BlueNoise);
        assert!(
            blue < of_jittered * jittered,
            "rate {samples}: blue noise {blue}, jittered {jittered}"
        );
    }
}

#[test]
fn study_of_one_edge_has_a_shade_for_every_column_of_samples() {
    let shades = |pattern, samples| {
        let frame = study("study/14_one_edge.svg", pattern, samples);
        // Where nothing but the edge is.
        let pixels = (490..534).flat_map(|x| (114..910).map(move |y| (x, y)));
        pixels.map(|(x, y)| frame.rgba(x, y)).collect::<BTreeSet<_>>().len()
    };
    for (pattern, of_four, of_sixteen) in [
        (SamplePattern::Grid, 3, 5),
        (SamplePattern::Rotated, 5, 17),
        (SamplePattern::Halton, 5, 17),
        (SamplePattern::R2, 5, 17),
    ] {
        let found = (shades(pattern, 4), shades(pattern, 16));
        assert_eq!(found, (of_four, of_sixteen), "{pattern:?} at 4 and at 16");
    }
    assert_eq!(shades(SamplePattern::Grid, 1), 2, "one sample, two colours");
}

#[test]
fn study_of_upright_bars_is_where_jitter_loses() {
    let name = "study/15_upright_bars.svg";
    let truth = study(name, SamplePattern::Grid, 256);
    let error = |pattern| block_error(&study(name, pattern, 1), &truth, 1);
    let (grid, jittered) = (error(SamplePattern::Grid), error(SamplePattern::Jittered));
    assert!(jittered > 1.2 * grid, "rate 1: jittered {jittered}, grid {grid}");
    // How many columns change along the upright bars.
    let ragged = |pattern, samples| {
        let frame = study(name, pattern, samples);
        let changes = |x: &u32| (131..450).any(|y| frame.rgba(*x, y) != frame.rgba(*x, 130));
        (140..880).filter(changes).count()
    };
    for samples in [1, 4, 16] {
        for straight in [SamplePattern::Grid, SamplePattern::JitteredSame, SamplePattern::R2] {
            assert_eq!(ragged(straight, samples), 0, "{straight:?} {samples}");
        }
        for frayed in [SamplePattern::Jittered, SamplePattern::BlueNoise] {
            let columns = ragged(frayed, samples);
            assert!(
                columns > 40,
                "{frayed:?}: both edges of 24 bars are ragged: {columns} columns at {samples}"
            );
        }
    }
}

/// A custom pattern with the samples of a pixel that are written out so.
fn custom(text: &str) -> SamplePattern {
    patterns::named(text).expect("a pattern")
}

#[test]
fn custom_patterns_sample_as_brute_force_does() {
    let triangle = |points: [[f64; 2]; 3], paint| PrimitiveKind::Triangle {
        points: points.map(DVec2::from),
        paint: Paint::Solid(paint),
    };
    let scene = scene(
        16.0,
        vec![
            triangle([[1.0, 2.0], [14.0, 3.1], [6.0, 13.0]], Rgba::opaque(1.0, 0.0, 0.0)),
            triangle([[2.0, 12.0], [13.0, 6.0], [15.3, 15.0]], Rgba::opaque(0.0, 0.0, 1.0)),
        ],
    );
    let view = one_to_one([16, 16]);
    for text in [
        "msaa-2",
        "msaa-8",
        "middle:128/128",
        "cross:128/128x2+64/128+192/128",
        "corners:0/0+255/255+255/0x3+0/255",
    ] {
        let SamplePattern::Custom(pattern) = custom(text) else {
            panic!("{text} is custom");
        };
        let settings = settings(custom(text), pattern.rate().samples());
        let (fast, slow) = (
            drawn(&scene, &view, &settings, [16, 16]),
            brute_force::draw(&scene, &view, &settings, [16, 16]),
        );
        assert_eq!(fast.pixels(), slow.pixels(), "{text}");
    }
}

#[test]
fn custom_weights_count_samples_as_often() {
    // Left of the middle of the first column of pixels.
    let points = [[-8.0, -40.0], [0.5, -40.0], [0.5, 4000.0]].map(DVec2::from);
    let paint = Paint::Solid(Rgba::opaque(0.0, 0.0, 0.0));
    let scene = scene(4.0, vec![PrimitiveKind::Triangle { points, paint }]);
    let view = one_to_one([4, 4]);
    let red = |text: &str, samples: u32| {
        let picture = drawn(&scene, &view, &settings(custom(text), samples), [4, 4]);
        picture.rgba(0, 1).expect("inside")[0]
    };
    assert_eq!(red("plain:64/128+192/128", 2), 128, "half of the pixel");
    assert_eq!(red("heavy:64/128x3+192/128", 4), 64, "three of four samples are black");
    let same = "own:96/32+224/96+32/160+160/224";
    let points = |text: &str| positions(custom(text), 4, [0, 0]);
    assert_eq!(points("msaa-4"), points(same), "the same samples by another name");
}

#[test]
fn studies_of_edges_are_where_msaa_8_wins_and_where_it_loses() {
    const SMALL: [u32; 2] = [512, 384];
    let frame = |name: &str, pattern, samples| {
        let scene = gallery_scene(name);
        let view = View::Default.transform(scene.canvas, SMALL);
        drawn(&scene, &view, &settings(pattern, samples), SMALL)
    };
    // Root of the mean square of what reds differ by.
    let error = |name: &str, pattern, samples| {
        let (found, truth) = (frame(name, pattern, samples), frame(name, SamplePattern::Grid, 256));
        let places = (0..SMALL[1]).flat_map(|y| (0..SMALL[0]).map(move |x| (x, y)));
        let sum: f64 = places
            .map(|(x, y)| (red(&found, x, y) - red(&truth, x, y)).powi(2))
            .sum();
        (sum / f64::from(SMALL[0] * SMALL[1])).sqrt()
    };
    for (name, wins) in [
        ("study/33_nearly_level_edges.svg", true),
        ("study/34_leaning_edges.svg", false),
    ] {
        let eight = error(name, custom("msaa-8"), 8);
        let [four, nine] = [4, 9].map(|samples| error(name, SamplePattern::Grid, samples));
        if wins {
            assert!(
                2.0 * eight < nine && 3.0 * eight < four,
                "{name}: {eight}, grid {four} and {nine}"
            );
        } else {
            assert!(eight > 1.3 * nine, "{name}: {eight}, grid {nine}");
        }
    }
}
