//! Filters that weigh an area of a texture: against integrals and direct sums, and where each of them wins.

use glam::{DMat2, DVec2};
use rasterscope::color::{Premultiplied16, ResolveSpace};
use rasterscope::simd;
use rasterscope::texture::{
    Anisotropy, Area, AreaFilter, Filter, LevelSampling, MipLevel, MipPyramid, PixelList, PixelSampling, PyramidFilter,
    Reading, SampleGrid, SamplingSettings, Texture, UvMap, Wrap,
};

const AREAS: [LevelSampling; 3] = [LevelSampling::Ewa, LevelSampling::SummedArea, LevelSampling::Ripmap];
const GRID: SampleGrid = SampleGrid {
    side: 4,
    origin: [0, 0],
};

/// Soft blobs, some of them translucent.
fn blobs(width: u32, height: u32) -> Texture {
    let wave = |x: u32, y: u32, k: f64| {
        let (x, y) = (f64::from(x), f64::from(y));
        (127.0 + 120.0 * (x * 0.21 * k + (y * 0.13 * k).sin() * 3.0).sin()).round()
    };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "waves are bytes")]
    let texel = |i: u32| {
        let (x, y) = (i % width, i / width);
        let alpha = wave(y, x, 0.3).max(200.0) as u8;
        [1.0, 1.7, 2.3]
            .map(|k| (wave(x, y, k) as u8).min(alpha))
            .into_iter()
            .chain([alpha])
            .collect::<Vec<_>>()
    };
    let texels = (0..width * height).map(|i| texel(i).try_into().expect("four channels"));
    Texture::new(
        "blobs",
        MipPyramid::build(MipLevel::new(width, height, texels.collect())),
    )
}

/// A footprint of so many texels along and across, turned, on a texture.
fn map(texture: &Texture, [long, short]: [f64; 2], turned: f64) -> UvMap {
    let base = &texture.pyramid.levels()[0];
    let size = DVec2::new(f64::from(base.width()), f64::from(base.height()));
    let along = DVec2::from_angle(turned);
    UvMap {
        pivot: DVec2::ZERO,
        uv: DVec2::splat(0.4),
        dx: along * long / size,
        dy: along.perp() * short / size,
    }
}

fn settings(level: LevelSampling) -> SamplingSettings {
    SamplingSettings {
        pixel: PixelSampling::Bilinear,
        level,
        ..SamplingSettings::default()
    }
}

fn point(texture: &Texture, map: &UvMap, settings: &SamplingSettings, at: [u16; 2]) -> [f64; 4] {
    let mut color = [Premultiplied16::TRANSPARENT];
    match AreaFilter::new(texture, map, settings) {
        Some(filter) => filter.points(simd::level(), GRID, &[at], &mut color),
        None => Filter::new(&texture.pyramid, map, settings).points(simd::level(), GRID, &[at], &mut color),
    }
    color[0]
        .0
        .map(|channel| f64::from(channel) / f64::from(Premultiplied16::PER_BYTE))
}

/// The texture between its texels' centres, premultiplied.
fn between(texture: &Texture, at: DVec2) -> [f64; 4] {
    let level = &texture.pyramid.levels()[0];
    let corner = (at - 0.5).floor();
    let part = at - 0.5 - corner;
    #[expect(clippy::cast_possible_truncation, reason = "places in a small texture")]
    let texel = |x: f64, y: f64| level.texel((corner.x + x) as i32, (corner.y + y) as i32).map(f64::from);
    std::array::from_fn(|i| {
        let row = |y: f64| texel(0.0, y)[i] * (1.0 - part.x) + texel(1.0, y)[i] * part.x;
        row(0.0) * (1.0 - part.y) + row(1.0) * part.y
    })
}

/// The integral of the texture over the unit circle that a footprint made an ellipse of, by a weight of the squared radius.
fn integral(texture: &Texture, middle: DVec2, to_texels: DMat2, weight: impl Fn(f64) -> f64) -> [f64; 4] {
    const STEPS: i32 = 60;
    let (mut sum, mut total) = ([0.0; 4], 0.0);
    for (x, y) in (-STEPS..=STEPS).flat_map(|y| (-STEPS..=STEPS).map(move |x| (x, y))) {
        let at = DVec2::new(f64::from(x), f64::from(y)) / f64::from(STEPS);
        let weight = weight(at.length_squared());
        if weight > 0.0 {
            total += weight;
            let color = between(texture, middle + to_texels * at);
            sum = std::array::from_fn(|i| sum[i] + color[i] * weight);
        }
    }
    sum.map(|channel| channel / total)
}

/// Where the first sample of the grid reads, in texels.
fn middle(texture: &Texture, map: &UvMap) -> DVec2 {
    let base = &texture.pyramid.levels()[0];
    (map.uv + (map.dx + map.dy) * 0.125) * DVec2::new(f64::from(base.width()), f64::from(base.height()))
}

fn largest(a: [f64; 4], b: [f64; 4]) -> f64 {
    (0..4).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
}

#[test]
fn ewa_is_the_integral_of_its_gaussian_and_taps_are_near_it() {
    let texture = blobs(256, 256);
    let gaussian = |q: f64| ((-2.0 * q).exp() - (-2.0_f64).exp()).max(0.0);
    for (axes, turned) in [
        ([3.0, 3.0], 0.0),
        ([12.0, 2.0], 0.0),
        ([12.0, 2.0], 0.7),
        ([20.0, 4.0], -1.1),
        ([7.5, 1.2], 2.0),
    ] {
        let map = map(&texture, axes, turned);
        let base = DVec2::splat(256.0);
        let to_texels = DMat2::from_cols(map.dx * base, map.dy * base);
        let expected = integral(&texture, middle(&texture, &map), to_texels, gaussian);
        let found = point(&texture, &map, &settings(LevelSampling::Ewa), [0, 0]);
        // The circle of a texel that is added, and a level's texels instead of the base's, soften waves of thirty texels by this.
        let error = largest(found, expected);
        assert!(
            error < 9.0,
            "{axes:?} turned {turned}: {found:?}, not {expected:?}: {error}"
        );
        let taps = SamplingSettings {
            anisotropy: Anisotropy::new(16).expect("a maximum"),
            ..settings(LevelSampling::Linear)
        };
        let flat = integral(&texture, middle(&texture, &map), to_texels * 0.5, |q| {
            f64::from(u8::from(q <= 1.0))
        });
        let taps = point(&texture, &map, &taps, [0, 0]);
        let error = largest(taps, flat);
        assert!(
            error < 16.0,
            "taps, {axes:?} turned {turned}: {taps:?}, not {flat:?}: {error}"
        );
    }
}

#[test]
fn sums_over_boxes_are_those_of_their_texels() {
    let texture = blobs(23, 17);
    let level = &texture.pyramid.levels()[0];
    for wrap in Wrap::ALL {
        for (axes, turned, uv) in [
            ([5.3, 2.1], 0.4, 0.4),
            ([40.0, 9.0], 0.0, 0.9),
            ([0.2, 0.1], 0.0, -0.3),
            ([70.0, 60.0], 1.0, 1.7),
        ] {
            let map = UvMap {
                uv: DVec2::splat(uv),
                ..map(&texture, axes, turned)
            };
            let settings = SamplingSettings {
                wrap,
                ..settings(LevelSampling::SummedArea)
            };
            let reading = Reading::new(&map.footprint(), &texture.pyramid, &settings);
            let Some(Area::Box(area)) = reading.area else {
                panic!("no box: {reading:?}");
            };
            let at = (map.uv + (map.dx + map.dy) * 0.125) * DVec2::new(23.0, 17.0);
            let (from, to) = (at - area.sides / 2.0, at + area.sides / 2.0);
            let mut expected = [0.0; 4];
            #[expect(clippy::cast_possible_truncation, reason = "a small box")]
            let range = |from: f64, to: f64| from.floor() as i32..to.ceil() as i32;
            let place = |at: i32, side: i32| match wrap {
                Wrap::Clamp => at.clamp(0, side - 1),
                Wrap::Repeat => at.rem_euclid(side),
                Wrap::Mirror => at.rem_euclid(2 * side).min(2 * side - 1 - at.rem_euclid(2 * side)),
            };
            let part = |k: i32, from: f64, to: f64| to.min(f64::from(k + 1)) - from.max(f64::from(k));
            for y in range(from.y, to.y) {
                for x in range(from.x, to.x) {
                    let part = part(x, from.x, to.x) * part(y, from.y, to.y) / (area.sides.x * area.sides.y);
                    let texel = level.texel(place(x, 23), place(y, 17));
                    expected = std::array::from_fn(|i| expected[i] + f64::from(texel[i]) * part);
                }
            }
            let found = point(&texture, &map, &settings, [0, 0]);
            // A stored channel has 256 steps a byte.
            let error = largest(found, expected);
            assert!(
                error < 0.51 / 256.0,
                "{wrap:?} {axes:?}: {found:?}, not {expected:?}: {error}"
            );
        }
    }
}

#[test]
fn levels_of_a_ripmap_are_means_of_what_they_cover() {
    let texture = blobs(16, 8);
    let ripmap = texture.ripmap(ResolveSpace::Stored, PyramidFilter::Box);
    let base = &texture.pyramid.levels()[0];
    assert_eq!(
        (texture.ripmap_widths(), ripmap.levels().len()),
        (5, 20),
        "16, 8, 4, 2, 1 by 8, 4, 2, 1"
    );
    for (number, level) in ripmap.levels().iter().enumerate() {
        let (wide, high) = (1_i32 << (number % 5), 1_i32 << (number / 5));
        assert_eq!(
            [level.width().cast_signed() * wide, level.height().cast_signed() * high],
            [16, 8],
            "the size of level {number}"
        );
        for (x, y) in
            (0..level.height().cast_signed()).flat_map(|y| (0..level.width().cast_signed()).map(move |x| (x, y)))
        {
            let mut mean = [0.0; 4];
            for (dx, dy) in (0..high).flat_map(|dy| (0..wide).map(move |dx| (dx, dy))) {
                let texel = base.texel(x * wide + dx, y * high + dy);
                mean = std::array::from_fn(|i| mean[i] + f64::from(texel[i]) / f64::from(wide * high));
            }
            let error = largest(level.texel(x, y).map(f64::from), mean);
            assert!(error <= 0.501, "level {number}, texel ({x}, {y}): {error}");
        }
    }
}

#[test]
fn constants_stay_and_sums_are_those_of_points_by_every_area() {
    let texel = [13, 200, 77, 255];
    let flat = Texture::new("flat", MipPyramid::build(MipLevel::new(37, 21, vec![texel; 37 * 21])));
    let blobs = blobs(64, 64);
    let points: Vec<[u16; 2]> = (0..16).map(|i| [i % 4 + 8, i / 4 + 4]).collect();
    for (level, wrap) in AREAS.into_iter().flat_map(|level| Wrap::ALL.map(|wrap| (level, wrap))) {
        let settings = SamplingSettings {
            wrap,
            ..settings(level)
        };
        for (axes, turned) in [([9.0, 2.0], 0.6), ([0.3, 0.2], 0.0), ([300.0, 1.0], 1.0)] {
            for (name, simd) in simd::available() {
                let what = format!("{level:?} {wrap:?} {axes:?} {name}");
                let list = PixelList {
                    pixels: &[[2, 1]],
                    masks: None,
                };
                let run = |texture: &Texture| {
                    let map = map(texture, axes, turned);
                    let filter = AreaFilter::new(texture, &map, &settings).expect("an area");
                    let (mut sums, mut colors) = ([[0; 4]], [Premultiplied16::TRANSPARENT; 16]);
                    filter.sums(simd, GRID, list, &mut sums);
                    filter.points(simd, GRID, &points, &mut colors);
                    (sums[0], colors)
                };
                let (sums, colors) = run(&flat);
                assert_eq!(colors, [Premultiplied16::from_bytes(texel); 16], "{what}");
                assert_eq!(sums, texel.map(|channel| u32::from(channel) * 256 * 16), "{what}");
                let (sums, colors) = run(&blobs);
                for (i, sum) in sums.into_iter().enumerate() {
                    let points: u32 = colors.iter().map(|color| u32::from(color.0[i])).sum();
                    // A tenth of a byte of 16 samples.
                    assert!(sum.abs_diff(points) < 400, "{what}: {sum}, not {points}");
                }
                let best = simd::available().last().map(|(_, simd)| *simd).expect("a level");
                let map = map(&blobs, axes, turned);
                let filter = AreaFilter::new(&blobs, &map, &settings).expect("an area");
                let (mut here, mut there) = ([[0; 4]], [[0; 4]]);
                filter.sums(simd, GRID, list, &mut here);
                filter.sums(best, GRID, list, &mut there);
                assert_eq!(here, there, "{what}: the same by all vectors");
            }
        }
    }
}

#[test]
fn absurd_footprints_end_quickly() {
    let texture = blobs(64, 3);
    let absurd = [0.0, 1e-300, 1e30, -1e150, 1e300, f64::INFINITY, f64::NAN];
    let points: Vec<[u16; 2]> = (0..16).map(|i| [i * 4000, 60_000 - i]).collect();
    let started = std::time::Instant::now();
    for level in AREAS {
        for (a, b) in absurd.into_iter().flat_map(|a| absurd.map(|b| (a, b))) {
            for wrap in Wrap::ALL {
                let map = UvMap {
                    pivot: DVec2::new(3.0, 4.0),
                    uv: DVec2::new(a, 0.3),
                    dx: DVec2::new(a, b),
                    dy: DVec2::new(b, 1.0),
                };
                let settings = SamplingSettings {
                    wrap,
                    ..settings(level)
                };
                let filter = AreaFilter::new(&texture, &map, &settings).expect("an area");
                let mut colors = [Premultiplied16::TRANSPARENT; 16];
                filter.points(simd::level(), GRID, &points, &mut colors);
                let mut sums = [[0; 4]];
                let list = PixelList {
                    pixels: &[[9, 9]],
                    masks: None,
                };
                filter.sums(simd::level(), GRID, list, &mut sums);
                for color in colors {
                    assert!(
                        color.0[3] > 190 * 256,
                        "{level:?} {a} {b}: every texel is nearly opaque: {color:?}"
                    );
                }
            }
        }
    }
    assert!(started.elapsed().as_secs() < 20, "bounded work, even on a busy machine");
}
