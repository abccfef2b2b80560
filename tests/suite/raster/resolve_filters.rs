//! Resolve filters: what all of them must keep, whatever they weigh. The oracle has their weights.

use glam::DVec2;
use rasterscope::color::{ResolveSpace, Rgba};
use rasterscope::geometry::{View, ViewTransform};
use rasterscope::raster::{FilterRadius, Framebuffer, Region, ResolveFilter, SamplePattern};
use rasterscope::render::{CancelToken, Nearby, RenderSettings, Subject, draw_regions, replay};
use rasterscope::rules::Rules;
use rasterscope::scene::{DialectChoice, PrimitiveKind, ReadOptions, Scene, read};
use rasterscope::viewer::gallery::{SCENES, Textures};

use crate::support::scenes::{Fills, at_rate, drawn, one_to_one, random, scene, triangle};

const SIZE: [u32; 2] = [40, 30];

fn filters() -> impl Iterator<Item = RenderSettings> {
    let radii = [None, FilterRadius::new(0.75), FilterRadius::new(FilterRadius::MAX)];
    ResolveFilter::ALL.into_iter().flat_map(move |resolve_filter| {
        radii.map(|filter_radius| RenderSettings {
            resolve_filter,
            filter_radius,
            ..at_rate(1)
        })
    })
}

/// Anything, in a filter that takes samples of neighbours.
fn any(u: &mut arbtest::arbitrary::Unstructured<'_>) -> arbtest::arbitrary::Result<RenderSettings> {
    let pattern = *u.choose(&SamplePattern::ALL)?;
    let radius = f64::from(u.int_in_range(0..=16)?) / 4.0;
    Ok(RenderSettings {
        pattern,
        resolve_filter: *u.choose(&ResolveFilter::ALL)?,
        filter_radius: FilterRadius::new(radius),
        resolve: *u.choose(&ResolveSpace::ALL)?,
        rules: *u.choose(&Rules::ALL)?,
        background: *u.choose(&[Rgba::WHITE, Rgba::TRANSPARENT])?,
        ..at_rate(*u.choose(&[1, 4, 9, 16, 36])?)
    })
}

#[test]
fn one_colour_stays_that_colour() {
    let shades = [
        Rgba::from_bytes([200, 13, 90, 255]),
        Rgba::from_bytes([200, 13, 90, 77]),
        Rgba::from_bytes([255, 255, 255, 255]),
        Rgba::from_bytes([1, 2, 3, 4]),
    ];
    for shade in shades {
        let far = 900.0;
        let scene = scene(
            40.0,
            vec![triangle([(-far, -far), (3.0 * far, -far), (-far, 3.0 * far)], shade)],
        );
        for filter in filters() {
            for (pattern, rate) in [
                (SamplePattern::Grid, 1),
                (SamplePattern::Grid, 16),
                (SamplePattern::Jittered, 1),
                (SamplePattern::Jittered, 4),
                (SamplePattern::Halton, 5),
            ] {
                for (resolve, rules) in ResolveSpace::ALL
                    .into_iter()
                    .flat_map(|space| Rules::ALL.map(|rules| (space, rules)))
                {
                    let settings = RenderSettings {
                        pattern,
                        resolve,
                        rules,
                        background: Rgba::TRANSPARENT,
                        sample_rate: at_rate(rate).sample_rate,
                        ..filter
                    };
                    let found = drawn(&scene, &one_to_one([9, 7]), &settings, [9, 7]);
                    let mean = RenderSettings {
                        resolve_filter: ResolveFilter::Box,
                        filter_radius: None,
                        ..settings
                    };
                    let expected = drawn(&scene, &one_to_one([9, 7]), &mean, [9, 7]);
                    assert!(found == expected, "{shade:?} {settings:?}");
                }
            }
        }
    }
}

#[test]
fn a_box_by_its_own_radius_is_the_mean() {
    arbtest::arbtest(|u| {
        let (scene, settings) = (random(u, 30, Fills::Everything)?, any(u)?);
        let with = |filter_radius| RenderSettings {
            resolve_filter: ResolveFilter::Box,
            filter_radius,
            ..settings
        };
        let [own, asked] =
            [None, FilterRadius::new(0.5)].map(|radius| drawn(&scene, &one_to_one(SIZE), &with(radius), SIZE));
        assert!(own == asked, "{settings:?}");
        Ok(())
    })
    .budget_ms(300);
}

/// A view one to one, whose frame's corner is this pixel.
fn from(corner: [i32; 2], size: [u32; 2]) -> ViewTransform {
    let corner = DVec2::from(corner.map(f64::from));
    View::At {
        center: corner + DVec2::from(size.map(f64::from)) / 2.0,
        scale: 1.0,
        rotation: 0.0,
    }
    .transform(DVec2::ONE, size)
}

#[test]
fn a_part_of_the_picture_is_the_picture_up_to_its_border() {
    let mut wide = 0;
    // A busy machine draws few at a time.
    while wide <= 2 {
        arbtest::arbtest(|u| {
            let (mut scene, mut settings) = (random(u, 40, Fills::Flat)?, any(u)?);
            // Lines of one pixel are stepped along in 32 bits, as the course does, and so round by where they lie in the frame.
            scene
                .primitives
                .retain(|primitive| !matches!(primitive.kind, PrimitiveKind::Hairline { .. }));
            // By other rules, places are rounded to 32 bits; and in some patterns each pixel has samples of its own.
            settings.rules = Rules::Standard;
            if settings.pattern.differs_by_pixel() {
                settings.pattern = SamplePattern::JitteredSame;
            }
            wide += 1;
            let whole = drawn(&scene, &from([0, 0], SIZE), &settings, SIZE);
            let corner = [u.int_in_range(0..=20)?, u.int_in_range(0..=15)?];
            let size = [u.int_in_range(1..=20)?, u.int_in_range(1..=15)?];
            let part = drawn(&scene, &from(corner, size), &settings, size);
            for y in 0..size[1] {
                for x in 0..size[0] {
                    let [left, top] = corner.map(i32::cast_unsigned);
                    let at = format!("{x}, {y} of {size:?} at {corner:?}, {settings:?}");
                    assert_eq!(part.rgba(x, y), whole.rgba(left + x, top + y), "{at}");
                }
            }
            Ok(())
        })
        .budget_ms(1500);
    }
}

/// The same pixels by regions, by themselves, and replayed; on one thread and on several.
fn check_all_ways(scene: &Scene, settings: &RenderSettings, (pixel, region): ([u32; 2], Region)) {
    let view = one_to_one(SIZE);
    let pool = |threads| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("a pool")
    };
    let whole = pool(1).install(|| drawn(scene, &view, settings, SIZE));
    let by_three = pool(3).install(|| drawn(scene, &view, settings, SIZE));
    assert!(whole == by_three, "threads: {settings:?}");
    let subject = Subject {
        scene,
        view: &view,
        settings,
    };
    let mut frame = whole.clone();
    frame.copy_from(region, &vec![0; (region.width * region.height) as usize], region);
    draw_regions(&subject, &mut frame, &[region], &CancelToken::default()).expect("not cancelled");
    assert!(frame == whole, "{region:?} of {settings:?}");
    let expected = whole.pixels()[(pixel[1] * SIZE[0] + pixel[0]) as usize];
    let other = Subject {
        settings: &RenderSettings::default(),
        ..subject
    };
    let near = Nearby::new(&other, SIZE, pixel).pixel(settings);
    assert_eq!(near, Some(expected), "alone: {pixel:?} {settings:?}");
    let replayed = replay(&subject, SIZE, pixel).expect("in the frame");
    assert_eq!(replayed.pixel, expected, "replayed: {pixel:?} {settings:?}");
    let Some(around) = replayed.around else {
        return;
    };
    let weights = around
        .pixels
        .iter()
        .flat_map(|pixel| &pixel.samples)
        .map(|(weight, _)| *weight);
    assert_eq!(
        weights.sum::<i64>(),
        around.sum.weight,
        "all weigh one together: {settings:?}"
    );
    let own = around.pixels.iter().find(|pixel| pixel.beside == [0, 0]);
    for (index, sample) in replayed.samples.iter().enumerate() {
        let weight = own.map_or(0, |own| own.samples[index].0) as f64 / around.sum.weight as f64;
        assert!((sample.weight - weight).abs() < 1e-12, "{pixel:?} {settings:?}");
        assert!(
            own.is_none_or(|own| own.samples[index].1 == sample.color),
            "{pixel:?} {settings:?}"
        );
    }
    let summed = settings.resolve.weighted_pixel(around.sum, settings.rules);
    let is_alike = around
        .pixels
        .iter()
        .flat_map(|pixel| &pixel.samples)
        .all(|(_, color)| *color == around.pixels[0].samples[0].1);
    assert!(
        is_alike || summed == expected,
        "the sum is the pixel: {pixel:?} {settings:?}"
    );
}

#[test]
fn pixels_are_the_same_on_every_way() {
    arbtest::arbtest(|u| {
        let (scene, settings) = (random(u, 36, Fills::Everything)?, any(u)?);
        let pixel = [u.int_in_range(0..=SIZE[0] - 1)?, u.int_in_range(0..=SIZE[1] - 1)?];
        let region = Region {
            x: u.int_in_range(0..=30)?,
            y: u.int_in_range(0..=20)?,
            width: u.int_in_range(1..=9)?,
            height: u.int_in_range(1..=9)?,
        };
        check_all_ways(&scene, &settings, (pixel, region));
        Ok(())
    })
    .budget_ms(3000);
}

#[test]
fn a_hard_edge_rings_where_weights_go_below_zero_and_nowhere_else() {
    let grey = |value| Rgba::from_bytes([value, value, value, 255]);
    let right = triangle([(20.0, -900.0), (900.0, 15.0), (20.0, 900.0)], grey(192));
    let all = triangle([(-900.0, -900.0), (2700.0, -900.0), (-900.0, 2700.0)], grey(64));
    let scene = scene(40.0, vec![all, right]);
    for filter in ResolveFilter::ALL {
        let settings = RenderSettings {
            resolve_filter: filter,
            ..at_rate(16)
        };
        let frame: Framebuffer = drawn(&scene, &one_to_one(SIZE), &settings, SIZE);
        let row: Vec<u8> = (0..SIZE[0]).filter_map(|x| Some(frame.rgba(x, 15)?[0])).collect();
        let rings = row.iter().any(|value| *value < 64 || *value > 192);
        let has_lobes = matches!(
            filter,
            ResolveFilter::CatmullRom | ResolveFilter::Mitchell | ResolveFilter::Lanczos2 | ResolveFilter::Lanczos3
        );
        assert_eq!(rings, has_lobes, "{filter:?}: {row:?}");
        assert!(row[10] == 64 && row[30] == 192, "far away nothing changes: {filter:?}");
        // What is lost on one side is won on the other.
        let mirrored = row.iter().rev().map(|value| 256 - u16::from(*value));
        let alike = row.iter().zip(mirrored).all(|(a, b)| u16::from(*a).abs_diff(b) <= 1);
        assert!(alike, "{filter:?} is even: {row:?}");
    }
}

/// How far the green of pixels is spread around its mean.
fn spread(greens: &[f64]) -> f64 {
    let count = greens.len() as f64;
    let mean = greens.iter().sum::<f64>() / count;
    (greens.iter().map(|green| (green - mean).powi(2)).sum::<f64>() / count).sqrt()
}

/// The greens of a study scene's pixels, one unit each, that lie where `wanted` says.
fn greens(name: &str, filter: ResolveFilter, wanted: impl Fn(DVec2) -> bool) -> Vec<f64> {
    let found = SCENES
        .iter()
        .find(|scene| scene.name == name)
        .expect("a scene of the gallery");
    let options = ReadOptions {
        dialect: DialectChoice::Auto,
    };
    let scene = read(found.document.as_bytes(), name, options, &Textures).expect("a good document");
    let settings = RenderSettings {
        resolve_filter: filter,
        ..at_rate(16)
    };
    let size = [512, 384];
    let frame = drawn(
        &scene,
        &View::Canvas.transform(DVec2::from(size.map(f64::from)), size),
        &settings,
        size,
    );
    let places = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
    places
        .filter(|at| wanted(DVec2::from(at.map(f64::from)) + 0.5))
        .filter_map(|[x, y]| Some(f64::from(frame.rgba(x, y)?[1])))
        .collect()
}

#[test]
fn study_scenes_show_where_wide_filters_win_and_where_they_lose() {
    let too_fine = |at: DVec2| (45.0..100.0).contains(&at.distance(DVec2::new(256.0, 206.0)));
    let lines = |at: DVec2| (264.0..288.0).contains(&at.x) && (256.0..304.0).contains(&at.y);
    let disc = |at: DVec2| (142.0..234.0).contains(&at.x) && (30.0..122.0).contains(&at.y);
    let of = |filter| {
        let aliases = spread(&greens("study/21_fine_spokes.svg", filter, too_fine));
        let lines = spread(&greens("study/22_what_filters_cost.svg", filter, lines));
        let mut edges = greens("study/22_what_filters_cost.svg", filter, disc);
        edges.sort_by(f64::total_cmp);
        (aliases, lines, edges[edges.len() - 1] - edges[0])
    };
    let (aliases, contrast, step) = of(ResolveFilter::Box);
    for filter in ResolveFilter::ALL.into_iter().skip(1) {
        let found = of(filter);
        assert!(
            found.0 < 0.6 * aliases,
            "fewer aliases by {filter:?}: {found:?}, {aliases}"
        );
        match filter {
            ResolveFilter::CatmullRom | ResolveFilter::Lanczos2 | ResolveFilter::Lanczos3 => {
                assert!(found.2 > step + 4.0, "{filter:?} rings: {found:?}, {step}");
            }
            ResolveFilter::Mitchell => {}
            _ => assert!(found.1 < 0.85 * contrast, "{filter:?} blurs: {found:?}, {contrast}"),
        }
    }
}
