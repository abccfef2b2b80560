//! Exact areas of pixels: what they show better than samples, what they get wrong, and what is said of it.

use std::time::{Duration, Instant};

use rasterscope::color::{ResolveSpace, Rgba};
use rasterscope::geometry::View;
use rasterscope::glam::DVec2;
use rasterscope::inspect::{Explanation, Question};
use rasterscope::raster::{Framebuffer, PixelCoverage, SamplePattern, ShadingRate};
use rasterscope::render::{RenderSettings, Subject};
use rasterscope::rules::Rules;
use rasterscope::scene::{DialectChoice, ReadOptions, Scene, read};
use rasterscope::viewer::gallery::{SCENES, Textures};

use crate::support::explaining::advised;
use crate::support::scenes::{at_rate, drawn, rmse};

const SIZE: [u32; 2] = [512, 384];

fn gallery(name: &str) -> Scene {
    let found = SCENES.iter().find(|scene| scene.name == name);
    document(found.expect("a scene of the gallery").document)
}

fn document(text: &str) -> Scene {
    let options = ReadOptions {
        dialect: DialectChoice::Auto,
    };
    read(text.as_bytes(), "scene.svg", options, &Textures).expect("a good document")
}

fn svg(inner: &str) -> Scene {
    document(&format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="8" height="8" viewBox="0 0 8 8">{inner}</svg>"#
    ))
}

fn exact() -> RenderSettings {
    RenderSettings {
        coverage: PixelCoverage::Exact,
        outline: false,
        ..at_rate(1)
    }
}

fn sampled(samples: u32) -> RenderSettings {
    RenderSettings {
        outline: false,
        ..at_rate(samples)
    }
}

fn picture(scene: &Scene, settings: &RenderSettings, size: [u32; 2]) -> Framebuffer {
    drawn(scene, &View::Canvas.transform(scene.canvas, size), settings, size)
}

#[test]
fn study_scenes_show_where_areas_win_and_where_they_lose() {
    for (name, wins) in [
        ("study/30_exact_greys.svg", true),
        ("study/31_seams_of_a_mesh.svg", false),
    ] {
        let scene = gallery(name);
        let truth = picture(&scene, &sampled(256), SIZE);
        let error = |settings: &RenderSettings| rmse(&picture(&scene, settings, SIZE), &truth);
        let [areas, four, sixteen] = [exact(), sampled(4), sampled(16)].map(|settings| error(&settings));
        if wins {
            assert!(2.0 * areas < sixteen, "{name}: {areas} and {sixteen} with 16 samples");
        } else {
            assert!(
                areas > 2.0 * sixteen,
                "{name}: {areas}, {four} and {sixteen} with samples"
            );
        }
    }
}

#[test]
fn pixels_inside_shapes_are_those_of_one_sample() {
    // No neighbours share edges in these: along such edges there are seams.
    for name in ["basic/test4.svg", "study/30_exact_greys.svg"] {
        let scene = gallery(name);
        let [areas, one, many] = [exact(), sampled(1), sampled(64)].map(|settings| picture(&scene, &settings, SIZE));
        let row = SIZE[0] as usize;
        let mut inside = 0;
        for i in row + 1..many.pixels().len() - row - 1 {
            let around = [
                i - row - 1,
                i - row,
                i - row + 1,
                i - 1,
                i + 1,
                i + row - 1,
                i + row,
                i + row + 1,
            ];
            if around.iter().all(|other| many.pixels()[*other] == many.pixels()[i]) {
                assert_eq!(
                    areas.pixels()[i],
                    one.pixels()[i],
                    "{name}: pixel {}, {}",
                    i % row,
                    i / row
                );
                inside += 1;
            }
        }
        assert!(inside > 10_000, "{name}: {inside} pixels");
    }
}

#[test]
fn samples_are_without_effect() {
    let scene = gallery("study/31_seams_of_a_mesh.svg");
    let plain = picture(&scene, &exact(), [64, 48]);
    let other = RenderSettings {
        pattern: SamplePattern::Sobol,
        shading: ShadingRate::Centroid,
        coverage: PixelCoverage::Exact,
        ..sampled(16)
    };
    assert!(
        picture(&scene, &other, [64, 48]) == plain,
        "rate, pattern and shading rate"
    );
    assert!(picture(&scene, &sampled(16), [64, 48]) != plain, "coverage is not");
}

#[test]
fn a_pixel_is_mixed_by_what_is_covered_of_it() {
    // A quarter of a pixel by the fill rule in force, and a third of what is below it there.
    let shape = |rule: &str| {
        svg(&format!(
            r#"<path fill-rule="{rule}" d="M2 2h2v2h-2zM3.5 3h.25v1h-.25zM3.5 3h.25v1h-.25z"/><path d="M5 5h.5v.5h-.5z" fill-opacity=".5"/>"#
        ))
    };
    let gray = |scene: &Scene, settings: &RenderSettings, [x, y]: [usize; 2]| {
        picture(scene, settings, [8, 8]).pixels()[8 * y + x] & 0xFF
    };
    let linear = RenderSettings {
        resolve: ResolveSpace::Linear,
        ..exact()
    };
    for (rule, settings, at, expected) in [
        ("nonzero", exact(), [3, 3], 0),
        ("evenodd", exact(), [3, 3], 0),
        ("nonzero", exact(), [5, 5], 255 - 32),
        // Half of a stored 255 is what covers a quarter of the light.
        ("nonzero", linear, [5, 5], 231),
    ] {
        let found = gray(&shape(rule), &settings, at);
        assert!(
            found.abs_diff(expected) <= 1,
            "{rule} at {at:?}: {found}, not {expected}"
        );
    }
    let hole = svg(r#"<path fill-rule="evenodd" d="M2 2h2v2h-2zM3.5 3h.25v1h-.25z"/>"#);
    assert_eq!(gray(&hole, &exact(), [3, 3]), 64, "a hole of a quarter");
}

/// The part of a pixel between the axis and the parabola `y = x (200 - x) / 200`, by the middles of many columns.
fn under_parabola([x, y]: [u32; 2], scale: f64) -> f64 {
    const COLUMNS: u32 = 2000;
    let height = |column: u32| {
        let x = (f64::from(x) + (f64::from(column) + 0.5) / f64::from(COLUMNS)) / scale;
        (x * (200.0 - x) / 200.0 * scale - f64::from(y)).clamp(0.0, 1.0)
    };
    (0..COLUMNS).map(height).sum::<f64>() / f64::from(COLUMNS)
}

#[test]
fn areas_under_curves_are_those_of_the_curves() {
    let scene = document(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="200" height="50"><path d="M0 0Q100 100 200 0z"/></svg>"#,
    );
    for scale in [0.3, 1.0, 3.7, 16.0] {
        // The frame shows the left corner: as the scene is in its own size, times the scale.
        let size = [400, 300];
        let view = View::At {
            center: DVec2::new(200.0, 150.0) / scale,
            scale,
            rotation: 0.0,
        };
        let frame = drawn(&scene, &view.transform(scene.canvas, size), &exact(), size);
        let (mut sum, mut count) = (0.0, 0);
        for (i, pixel) in (0..).zip(frame.pixels()) {
            let at = [i % size[0], i / size[0]];
            let truth = under_parabola(at, scale);
            if truth > 0.0 && truth < 1.0 && f64::from(at[0]) < 200.0 * scale {
                let off = f64::from(pixel & 0xff) - 255.0 * (1.0 - truth);
                assert!(off.abs() <= 0.56, "{at:?}, times {scale}: {off} levels");
                (sum, count) = (sum + off, count + 1);
            }
        }
        let mean = sum / f64::from(count);
        assert!(
            count > 50 && mean.abs() < 0.12,
            "times {scale}: {mean} levels of {count} pixels"
        );
    }
}

#[test]
fn explanations_tell_the_area_that_the_picture_has() {
    let scene = svg(r#"<circle cx="3.2" cy="4.1" r="2.9"/>"#);
    let mut cut = 0;
    for i in 0..64 {
        let found = advised(&scene, &exact(), [8, 8], [i % 8, i / 8]);
        for paint in &found.paints {
            if let (Some(area), Some(covered)) = (paint.area, paint.covered) {
                assert!((area - covered).abs() < 1e-4, "pixel {i}: {area} and {covered}");
                cut += u32::from(covered < 1.0);
            }
        }
    }
    assert!(cut > 10, "{cut} pixels at the edge");
}

#[test]
fn explanations_end_in_the_frames_bytes() {
    let names = [
        "basic/test5.svg",
        "texmap/test3.svg",
        "vector/06_clips_and_masks.svg",
        "study/20_conflation.svg",
    ];
    let translucent = RenderSettings {
        background: Rgba::TRANSPARENT,
        resolve: ResolveSpace::Linear,
        ..exact()
    };
    let size = [17, 13];
    let mut composited = 0;
    for (name, settings) in names.iter().flat_map(|name| [(name, exact()), (name, translucent)]) {
        let scene = gallery(name);
        let view = View::Default.transform(scene.canvas, size);
        let frame = drawn(&scene, &view, &settings, size);
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        };
        for (i, pixel) in (0..).zip(frame.pixels()) {
            let pixel_at = [i % size[0], i / size[0]];
            let question = Question {
                subject,
                file: "scene.svg",
                size,
                pixel: pixel_at,
            };
            let found = Explanation::new(&question).expect("in the frame");
            let [a, r, g, b] = pixel.to_be_bytes();
            assert_eq!(found.color, [r, g, b, a], "{name} at {pixel_at:?}");
            assert!(
                found.exact && found.samples.len() == 1 && found.missed.is_empty(),
                "one colour"
            );
            let linear = settings.resolve == ResolveSpace::Linear;
            for paint in found.paints.iter().filter(|paint| paint.covered.is_some() && !linear) {
                let (fragment, covered) = (&paint.fragments[0], paint.covered.expect("an area"));
                let alpha = fragment.color[3] / 255.0 * covered;
                for k in 0..4 {
                    let expected = fragment.color[k] * covered + fragment.before[k] * (1.0 - alpha);
                    assert!((expected - fragment.after[k]).abs() < 0.02, "{name}: {paint:?}");
                }
                composited += 1;
            }
        }
    }
    assert!(composited > 300, "{composited} primitives");
}

#[test]
fn a_layer_beside_a_pixel_does_not_show() {
    let part = r##"<path d="M0 0H3.3V8H0z" fill="#4A7B21"/>"##;
    let layer = r#"<g opacity=".5"><path d="M6 6h1v1h-1z"/></g>"#;
    for rules in Rules::ALL {
        for resolve in ResolveSpace::ALL {
            let settings = RenderSettings {
                rules,
                resolve,
                ..exact()
            };
            let [alone, beside] =
                ["", layer].map(|layer| picture(&svg(&format!("{part}{layer}")), &settings, [8, 8]).pixels()[8 + 3]);
            assert_eq!(alone, beside, "{rules:?}, {resolve:?}");
        }
    }
}

#[test]
fn a_comparison_counts_areas() {
    let scene = svg(r##"<path id="half" d="M0 0H3.3V8H0z" fill="#0000FF"/>"##);
    let [areas, samples] = [exact(), sampled(4)].map(|settings| advised(&scene, &settings, [8, 8], [3, 4]));
    let found = areas.differences(&samples);
    let row = |what: &str| {
        let row = found.iter().find(|row| row.what.contains(what));
        row.map(|row| [row.a.as_str(), row.b.as_str()])
    };
    assert_eq!(row("samples"), Some(["none: exact areas", "4"]), "{found:?}");
    assert_eq!(row("covers"), Some(["30 %", "50 %"]), "{found:?}");
    assert_eq!(row("background"), Some(["70 %", "50 %"]), "{found:?}");
    let outside = areas.differences(&advised(&scene, &exact(), [8, 8], [5, 4]));
    let covers = outside.iter().find(|row| row.what.contains("covers"));
    assert_eq!(covers.map(|row| row.b.as_str()), Some("nothing"), "{outside:?}");
}

#[test]
fn a_seam_is_called_one_and_advice_knows_better() {
    let red = r##"<rect width="8" height="8" fill="#FF0000"/>"##;
    let neighbours = r##"<path d="M0 0H3.5V8H0z" fill="#0000FF"/><path d="M3.5 0H8V8H3.5z" fill="#0000FF"/>"##;
    let scene = svg(&format!("{red}{neighbours}"));
    assert_eq!(
        picture(&scene, &exact(), [8, 8]).pixels()[8 * 4 + 3],
        0xFF40_00BF,
        "a quarter is red"
    );
    assert_eq!(
        picture(&scene, &sampled(4), [8, 8]).pixels()[8 * 4 + 3],
        0xFF00_00FF,
        "samples have owners"
    );
    let seam = advised(&scene, &exact(), [8, 8], [3, 4]);
    let conflation = seam.conflation.as_ref().expect("neighbours");
    assert_eq!(conflation.paints, [1, 2], "both halves");
    assert!((conflation.through - 0.25).abs() < 1e-4, "a quarter: {conflation:?}");
    let text = seam.to_string();
    for words in ["conflation", "supersampling has no", "Coverage by 16 samples"] {
        assert!(
            text.replace('\n', " ").replace("      ", " ").contains(words),
            "{words}: {text}"
        );
    }
    let inside = advised(&scene, &exact(), [8, 8], [1, 4]);
    assert!(inside.conflation.is_none(), "nobody meets there: {inside}");
    // Two halves that lie on each other leave the other half as it is.
    let twice = svg(&format!(r#"{red}<path d="M0 0H3.5V8H0z"/><path d="M0 0H3.5V8H0z"/>"#));
    let found = advised(&twice, &exact(), [8, 8], [3, 4]);
    assert!(found.conflation.is_none(), "no neighbours: {found}");
}

#[test]
fn advice_is_exact_only_where_that_helps() {
    // A thousandth of a pixel more than samples of the grid tell.
    let scene = svg(r#"<path d="M0 0H3.499V8H0z"/>"#);
    let found = advised(&scene, &sampled(16), [8, 8], [3, 4]);
    let advises = |found: &Explanation| found.to_string().contains("Coverage by exact areas");
    assert!(!advises(&found), "samples are right there: {found}");
    let thin = svg(r#"<path d="M3.4 0h.2v8h-.2z"/>"#);
    let found = advised(&thin, &sampled(16), [8, 8], [3, 4]);
    assert!(advises(&found), "16 samples miss a fifth: {found}");
}

#[test]
fn tangles_take_no_time() {
    // Each edge crosses nearly all others in few rows of pixels.
    let points: Vec<String> = (0..6000_u32)
        .map(|i| {
            format!(
                "{},{}",
                (i * 7919) % 5003,
                3.0 + f64::from((i * 104_729) % 1009) / 1009.0
            )
        })
        .collect();
    let tangle = svg(&format!(
        r#"<g transform="scale(.0015 1)"><polygon points="{}" fill-rule="evenodd"/></g>"#,
        points.join(" ")
    ));
    let start = Instant::now();
    let drawn = picture(&tangle, &exact(), [8, 8]);
    assert!(drawn.pixels().iter().any(|pixel| *pixel != 0xFFFF_FFFF), "it is there");
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
}
