//! Advice is checked by following it: on pixels of every scene of ours, at many settings, by the code that explains frames.

use glam::DVec2;
use rasterscope::color::ResolveSpace;
use rasterscope::geometry::{View as SceneView, ViewTransform};
use rasterscope::inspect::{Cure, Explanation, Interpolated, Question, Setting, View};
use rasterscope::post::PostProcess;
use rasterscope::raster::{
    CustomPattern, Framebuffer, PixelCoverage, ResolveFilter, SamplePattern, SampleRate, ShadingRate,
};
use rasterscope::render::{RenderSettings, Subject, draw, replay};
use rasterscope::rules::Rules;
use rasterscope::scene::{self, DialectChoice, PrimitiveKind, ReadOptions, Scene};
use rasterscope::texture::{
    Anisotropy, Derivatives, FixedLevel, FootprintExtent, LevelSampling, LodBias, PixelSampling, PyramidFilter,
};
use rasterscope::viewer::gallery::{SCENES, Textures};
use rayon::prelude::*;

use crate::support::explaining::{advised, advised_by_default};

/// Pixels of each scene with each setting.
const PIXELS: u64 = 1;
const SIZE: [u32; 2] = [96, 64];

fn rate(samples: u32) -> SampleRate {
    SampleRate::new(samples).unwrap()
}

fn settings() -> Vec<RenderSettings> {
    let plain = RenderSettings::default();
    let with = |change: &dyn Fn(&mut RenderSettings)| {
        let mut settings = plain;
        change(&mut settings);
        settings
    };
    vec![
        plain,
        with(&|own| own.sample_rate = rate(4)),
        with(&|own| own.rules = Rules::Course),
        with(&|own| {
            own.sample_rate = rate(16);
            own.rules = Rules::Course;
            own.pixel_sampling = PixelSampling::Bilinear;
        }),
        with(&|own| {
            own.sample_rate = rate(4);
            own.pixel_sampling = PixelSampling::Bilinear;
            own.level_sampling = LevelSampling::Linear;
        }),
        with(&|own| {
            own.level_sampling = LevelSampling::Nearest;
            own.detail.bias = LodBias::new(2.0).unwrap();
        }),
        with(&|own| {
            own.sample_rate = rate(9);
            own.level_sampling = LevelSampling::Linear;
            own.detail.fixed = FixedLevel::new(3.0);
            own.resolve = ResolveSpace::Linear;
        }),
        with(&|own| {
            own.sample_rate = rate(64);
            own.pixel_sampling = PixelSampling::Bilinear;
            own.level_sampling = LevelSampling::Linear;
            own.anisotropy = Anisotropy::new(16).unwrap();
        }),
        with(&|own| {
            own.sample_rate = rate(16);
            own.pattern = SamplePattern::Jittered;
            own.background = rasterscope::color::Rgba::TRANSPARENT;
        }),
        with(&|own| {
            own.sample_rate = rate(4);
            own.resolve_filter = ResolveFilter::Mitchell;
        }),
        with(&|own| {
            own.sample_rate = rate(16);
            own.shading = ShadingRate::Centre;
        }),
        with(&|own| {
            own.sample_rate = rate(4);
            own.shading = ShadingRate::Centroid;
            own.pattern = SamplePattern::Rotated;
        }),
        with(&|own| own.post_process = PostProcess::Smaa),
        with(&|own| {
            own.sample_rate = rate(256);
            own.level_sampling = LevelSampling::Nearest;
        }),
    ]
}

fn read(name: &str, document: &str) -> Scene {
    read_as(DialectChoice::Auto, name, document)
}

fn read_as(dialect: DialectChoice, name: &str, document: &str) -> Scene {
    scene::read(document.as_bytes(), name, ReadOptions { dialect }, &Textures).unwrap()
}

/// A pixel drawn by the code that explains frames.
fn color(scene: &Scene, view: &ViewTransform, settings: &RenderSettings, pixel: [u32; 2]) -> [u8; 4] {
    if settings.post_process != PostProcess::None {
        let mut frame = Framebuffer::new(SIZE[0], SIZE[1]);
        draw(scene, view, settings, &mut frame);
        return frame.rgba(pixel[0], pixel[1]).unwrap();
    }
    let subject = Subject { scene, view, settings };
    let [a, r, g, b] = replay(&subject, SIZE, pixel).unwrap().pixel.to_be_bytes();
    [r, g, b, a]
}

/// The largest difference of a channel, of premultiplied colours.
fn distance(a: [u8; 4], b: [u8; 4]) -> f64 {
    let premultiplied =
        |c: [u8; 4]| [c[0], c[1], c[2], 255].map(|channel| f64::from(channel) * f64::from(c[3]) / 255.0);
    let (a, b) = (premultiplied(a), premultiplied(b));
    (0..4).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
}

/// What following a piece of advice makes of the settings.
fn follow(cure: &Cure, own: &RenderSettings) -> RenderSettings {
    let mut settings = *own;
    let value = cure.value.as_str();
    match cure.setting {
        Setting::Rules => settings.rules = Rules::ALL.into_iter().find(|rules| rules.name() == value).unwrap(),
        Setting::LodLevel => settings.detail.fixed = None,
        Setting::LodBias => settings.detail.bias = LodBias::new(value.parse().unwrap()).unwrap(),
        Setting::LodPer => settings.detail.derivatives = Derivatives::Sample,
        Setting::Pyramid => {
            settings.pyramid = ResolveSpace::ALL
                .into_iter()
                .find(|space| space.name() == value)
                .unwrap();
        }
        Setting::PyramidFilter => settings.pyramid_filter = PyramidFilter::Box,
        Setting::LodBy => settings.detail.extent = FootprintExtent::Longer,
        Setting::LevelSampling => {
            settings.level_sampling = LevelSampling::ALL
                .into_iter()
                .find(|level| level.name() == value)
                .unwrap();
        }
        Setting::Anisotropy => settings.anisotropy = Anisotropy::new(value.parse().unwrap()).unwrap(),
        Setting::PixelSampling => {
            settings.pixel_sampling = PixelSampling::ALL
                .into_iter()
                .find(|sampling| sampling.name() == value)
                .unwrap();
        }
        Setting::SampleRate => settings.sample_rate = rate(value.parse().unwrap()),
        Setting::ShadingRate => {
            settings.shading = ShadingRate::ALL
                .into_iter()
                .find(|shading| shading.name() == value)
                .unwrap();
        }
        Setting::PostProcess => {
            settings.post_process = PostProcess::ALL
                .into_iter()
                .find(|process| process.name() == value)
                .unwrap();
        }
        Setting::Coverage => {
            settings.coverage = PixelCoverage::ALL
                .into_iter()
                .find(|coverage| coverage.name() == value)
                .unwrap();
            if let Some(samples) = cure.samples {
                settings.sample_rate = rate(samples);
            }
        }
        Setting::Pattern => {
            settings.pattern = SamplePattern::ALL
                .into_iter()
                .find(|pattern| pattern.name() == value)
                .unwrap();
        }
    }
    settings
}

/// All that may be advised, and more.
fn changes(own: &RenderSettings) -> Vec<RenderSettings> {
    let mut all = vec![RenderSettings {
        rules: Rules::Standard,
        ..*own
    }];
    all.extend(PixelSampling::ALL.map(|pixel_sampling| RenderSettings { pixel_sampling, ..*own }));
    let mut automatic = *own;
    automatic.detail.fixed = None;
    let mut unbiased = *own;
    unbiased.detail.bias = LodBias::default();
    all.extend([automatic, unbiased]);
    all.extend(LevelSampling::ALL.map(|level_sampling| RenderSettings { level_sampling, ..*own }));
    for anisotropy in Anisotropy::STEPS.into_iter().filter(|taps| *taps > own.anisotropy) {
        all.push(RenderSettings { anisotropy, ..*own });
    }
    for sample_rate in [4, 9, 16, 25, 36, 49, 64, 256].map(rate) {
        if sample_rate > own.sample_rate {
            all.push(RenderSettings { sample_rate, ..*own });
        }
    }
    for shading in [ShadingRate::Sample, ShadingRate::Centroid] {
        if own.shading.is_once() {
            all.push(RenderSettings { shading, ..*own });
        }
    }
    // Samples of other patterns share no lines either.
    if own.sample_rate > SampleRate::ONE && own.pattern == SamplePattern::Grid {
        all.push(RenderSettings {
            pattern: SamplePattern::Rotated,
            ..*own
        });
    }
    all
}

/// Pixels of a frame where something happens, or any where it is all of one colour.
fn pixels(frame: &Framebuffer, seed: u64) -> Vec<[u32; 2]> {
    let all = || (0..SIZE[1] - 1).flat_map(|y| (0..SIZE[0] - 1).map(move |x| [x, y]));
    let at = |x: u32, y: u32| frame.pixels()[(y * SIZE[0] + x) as usize];
    let busy: Vec<[u32; 2]> = all()
        .filter(|[x, y]| at(*x, *y) != at(x + 1, *y) || at(*x, *y) != at(*x, y + 1))
        .collect();
    let among = if busy.is_empty() { all().collect() } else { busy };
    (0..PIXELS)
        .map(|i| {
            let hash = (seed * PIXELS + i + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 20;
            among[usize::try_from(hash).unwrap() % among.len()]
        })
        .collect()
}

#[test]
fn advice_helps_where_it_stands_and_stands_where_it_helps() {
    let all = settings();
    let counts = SCENES.par_iter().enumerate().map(|(number, scene)| {
        let read = read(scene.name, scene.document);
        let view = SceneView::Default.transform(read.canvas, SIZE);
        let mut cures = 0;
        for (i, settings) in all.iter().enumerate() {
            let mut frame = Framebuffer::new(SIZE[0], SIZE[1]);
            draw(&read, &view, settings, &mut frame);
            for pixel in pixels(&frame, (number * all.len() + i) as u64) {
                let place = format!("{} {pixel:?} {settings:?}", scene.name);
                cures += check(&read, &view, settings, (pixel, &place));
            }
        }
        cures
    });
    let cures: usize = counts.sum();
    assert!(cures > 300, "only {cures} pieces of advice");
}

/// Checks all that is said of one pixel; how many settings are advised.
fn check(scene: &Scene, view: &ViewTransform, settings: &RenderSettings, (pixel, place): ([u32; 2], &str)) -> usize {
    let question = Question {
        subject: Subject { scene, view, settings },
        file: "scene.svg",
        size: SIZE,
        pixel,
    };
    let found = Explanation::advised(&question).unwrap();
    let truth = found.truth.as_ref().unwrap();
    let true_settings = RenderSettings {
        resolve: settings.resolve,
        ..settings.truth()
    };
    assert_eq!(truth.color, color(scene, view, &true_settings, pixel), "{place}");
    let away = distance(found.color, truth.color);
    assert!((away - truth.distance).abs() < 1e-9, "{place}: {away} {truth:?}");
    let hints = found.hints();
    for cure in &truth.cures {
        let made = color(scene, view, &follow(cure, settings), pixel);
        let nearer = away - distance(made, truth.color);
        assert_eq!(made, cure.color, "{place}: {cure:?}");
        assert!(
            nearer > truth.unsure.max(1.0) && (nearer - cure.nearer).abs() < 1e-9,
            "{place}: {cure:?} brings {nearer}"
        );
        let levels = (nearer * 10.0).round() / 10.0;
        let plural = if levels.to_string() == "1" { "" } else { "s" };
        let figure = format!(" {levels} level{plural} nearer");
        assert!(hints.iter().any(|hint| hint.contains(&figure)), "{place}: {hints:?}");
    }
    let elsewhere = RenderSettings {
        pattern: SamplePattern::Sobol,
        ..true_settings
    };
    let unsure = distance(color(scene, view, &elsewhere, pixel), truth.color);
    assert!((unsure - truth.unsure).abs() < 1e-9, "{place}: {unsure} {truth:?}");
    // Nothing can bring it nearer by more than it is away.
    if truth.cures.is_empty() && away >= 16.0 {
        for other in changes(settings) {
            let nearer = away - distance(color(scene, view, &other, pixel), truth.color);
            assert!(
                nearer < 16.0_f64.max(unsure + 1.0),
                "{place}: {other:?} brings {nearer}, and nobody says so"
            );
        }
    }
    for hint in &hints {
        check_words(&found, scene, view, (hint, place));
    }
    truth.cures.len()
}

/// Checks what a hint says of this pixel.
fn check_words(found: &Explanation, scene: &Scene, view: &ViewTransform, (hint, place): (&str, &str)) {
    if hint.contains("leaves a gap") {
        let number = |after: &str| -> usize {
            let rest = &hint[hint.find(after).unwrap() + after.len()..];
            rest.split(' ').next().unwrap().parse().unwrap()
        };
        let (sample, first, second) = (number("Sample "), number("between "), number(") and "));
        let stack = &found.samples[sample - 1].stack;
        let below = first.min(second) - 1;
        assert!(stack.iter().all(|paint| *paint < below), "{place}: {hint}");
    }
    if hint.contains("breaks up") {
        let step = 1.0 / (found.samples.len() as f64).sqrt();
        // A rim of few points lies in what is a little narrower.
        let is_thin = |primitive: u32| !holds_disc(scene, view, (primitive, found.pixel, step * 1.03));
        let thin = if hint.contains("px wide, less") {
            let mut seen = found.paints.iter().rev();
            let topmost = seen.find(|paint| paint.fragments.iter().any(|fragment| fragment.seen));
            topmost.is_some_and(|paint| is_thin(paint.primitive))
        } else {
            found.missed.iter().any(|missed| is_thin(missed.primitive))
        };
        assert!(thin, "{place}: {hint} {:?}", found.missed);
    }
    if hint.contains("only the nearest texel") {
        let texture = found.paints.iter().rev().find(|paint| paint.texture.is_some()).unwrap();
        for view in &texture.views {
            if let View::Triangle {
                value: Interpolated::Texture { texels, .. },
                ..
            } = view
            {
                assert_eq!(texels.len(), 1, "{place}: {hint}");
            }
        }
    }
}

/// Whether a primitive is as thick as the samples are apart, in or near the pixel: a disc of that diameter lies in it.
fn holds_disc(scene: &Scene, view: &ViewTransform, (primitive, pixel, diameter): (u32, [u32; 2], f64)) -> bool {
    let place = |points: &[DVec2; 3]| points.map(|point| view.to_pixels(point));
    let triangles: Vec<[DVec2; 3]> = match &scene.primitives[primitive as usize].kind {
        PrimitiveKind::Triangle { points, .. } => vec![place(points)],
        PrimitiveKind::Polygon { polygon, .. } => polygon.triangles().unwrap().iter().map(place).collect(),
        _ => return false,
    };
    let inside = |point: DVec2| {
        triangles.iter().any(|[a, b, c]| {
            let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| (*to - *from).perp_dot(point - *from));
            sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
        })
    };
    let corner = DVec2::from(pixel.map(f64::from));
    let centres = (0..=24).flat_map(|y| (0..=24).map(move |x| corner + DVec2::new(f64::from(x), f64::from(y)) / 24.0));
    let disc = |centre: DVec2| {
        // So many that no gap between needles goes unnoticed.
        let rim = (0..256).map(|i| DVec2::from_angle(f64::from(i) * std::f64::consts::TAU / 256.0) * (diameter / 2.0));
        rim.chain([DVec2::ZERO]).all(|from| inside(centre + from))
    };
    centres.into_iter().any(disc)
}

#[test]
fn advice_is_silent_about_neighbours_that_share_an_edge() {
    // The red one covers 45 % of the pixel and not its centre; the blue one has the rest.
    let mesh = r##"<svg width="8" height="8"><polygon points="0,0 4.45,0 4.45,8 0,8" fill="#FF0000"/><polygon points="4.45,0 8,0 8,8 4.45,8" fill="#0000FF"/></svg>"##;
    let found = advised(&read("mesh.svg", mesh), &RenderSettings::default(), [8, 8], [4, 4]);
    assert_eq!(found.missed.len(), 1, "one is met by no sample");
    let told = found.hints().join("\n");
    assert!(!told.contains("thin") && !told.contains("breaks up"), "{told}");
    assert!(
        told.contains("samples (key = steps to it in the window): "),
        "more samples mix both: {told}"
    );
}

#[test]
fn advice_knows_no_gap_that_a_third_one_covers() {
    // Two strips with a gap that the samples of the middle column lie in; a third one closes it, before them or after.
    let strips = r##"<polygon points="0,0 4.48,0 4.48,12" fill="#802060"/><polygon points="4.53,0 4.53,12 12,0" fill="#208060"/>"##;
    let wedge = r##"<polygon points="4.48,0 4.53,0 4.53,12 4.48,12" fill="#FFFF00"/>"##;
    let sheet = r##"<polygon points="0,0 12,0 12,12 0,12" fill="#FFFF00"/>"##;
    for (body, is_gap, why) in [
        (strips.to_owned(), true, "the background shows"),
        (format!("{sheet}{strips}"), true, "what lies below both shows"),
        (format!("{wedge}{strips}"), false, "closed before"),
        (format!("{strips}{wedge}"), false, "closed after"),
        (format!("{strips}{sheet}"), false, "covered"),
    ] {
        let document = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="12" height="12">{body}</svg>"#);
        let settings = RenderSettings {
            sample_rate: rate(9),
            ..RenderSettings::default()
        };
        let told = advised(&read("gap.svg", &document), &settings, [12, 12], [4, 2])
            .hints()
            .concat();
        assert_eq!(told.contains("leaves a gap"), is_gap, "{why}: {told}");
    }
}

#[test]
fn advice_on_a_pattern_says_how_many_samples_go_with_it() {
    // The bar lies between the columns of the cross, and crosses a fourth of the pixel.
    let bar = r##"<svg width="8" height="8"><polygon points="4.1,0 4.35,0 4.35,8 4.1,8" fill="#FF0000"/></svg>"##;
    let scene = read("bar.svg", bar);
    let hints = |pattern: SamplePattern| {
        let settings = RenderSettings {
            sample_rate: rate(4),
            pattern,
            ..RenderSettings::default()
        };
        let found = advised(&scene, &settings, [8, 8], [4, 4]);
        let cures = found.truth.as_ref().map_or(&[][..], |truth| &truth.cures);
        let samples = cures.iter().filter(|cure| cure.setting == Setting::Pattern);
        (
            found.hints().concat(),
            samples.map(|cure| cure.samples).collect::<Vec<_>>(),
        )
    };
    let cross = CustomPattern::parse("cross:128/128x2+128/64+128/192").expect("a pattern");
    let (told, samples) = hints(SamplePattern::Custom(cross));
    assert!(told.contains("Pattern rotated with 4 samples (key A"), "{told}");
    assert_eq!(samples, [Some(4)], "it is no pattern of its own rate");
    let (told, samples) = hints(SamplePattern::Grid);
    assert!(!told.contains("Pattern rotated with"), "the rate stays: {told}");
    assert!(samples.iter().all(Option::is_none), "{samples:?}");
}

#[test]
fn exact_areas_of_upright_edges_are_right() {
    for (edge, width) in [(8.03, 8.0), (8.2, 0.06), (8.5, 0.31)] {
        let body = format!(r#"<rect x="{edge}" width="{width}" height="16"/>"#);
        let document = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="16" height="16">{body}</svg>"#);
        let scene = read_as(DialectChoice::Svg, "edge.svg", &document);
        let settings = RenderSettings {
            coverage: PixelCoverage::Exact,
            ..RenderSettings::default()
        };
        let told = advised(&scene, &settings, [16, 16], [8, 8]).help_lines().concat();
        assert!(told.starts_with("This pixel is what it should be"), "{body}: {told}");
    }
}

#[test]
fn what_is_hardly_seen_is_no_reason() {
    // The polygon covers more than a third of the pixel and not its centre; the bar is thin, and hardly there.
    let polygon = r#"<polygon points="0,4.6 8,4.6 8,8 0,8"/>"#;
    let bar = r#"<rect x="4.6" y="0" width="0.1" height="8" fill-opacity="0.004"/>"#;
    for (body, expected, why) in [
        (
            format!("{bar}{polygon}"),
            "No sample meets some of what is here, about 40 % of the pixel",
            "the polygon is missed",
        ),
        (
            r#"<rect x="4.6" y="0" width="0.1" height="8"/>"#.to_owned(),
            "What is thin passes",
            "the bar is",
        ),
    ] {
        let document = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="8" height="8">{body}</svg>"#);
        let told = advised(
            &read("missed.svg", &document),
            &RenderSettings::default(),
            [8, 8],
            [4, 4],
        )
        .hints()
        .concat();
        assert!(told.contains(expected), "{why}: {told}");
    }
    // By its samples the triangle covers all of the pixel; a neighbour of the same colour has the rest, and all is well but for
    // the bar.
    let halves = r#"<polygon points="0,0 4.8,0 4.8,8 0,8"/><polygon points="4.8,0 8,0 8,8 4.8,8"/>"#;
    let white = r##"<rect x="4" y="4" width="1" height="0.3" fill="#FFFFFF"/>"##;
    let document = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="8" height="8">{halves}{white}</svg>"#);
    let told = advised(
        &read("halves.svg", &document),
        &RenderSettings::default(),
        [8, 8],
        [4, 4],
    )
    .hints()
    .concat();
    assert!(
        told.contains("levels nearer") && !told.contains("By its samples"),
        "{told}"
    );
}

#[test]
fn advice_on_the_rules_says_which_dialect_goes_with_them() {
    let greys = SCENES
        .iter()
        .find(|scene| scene.name.contains("30_exact_greys"))
        .expect("a study");
    let settings = RenderSettings {
        rules: Rules::Course,
        coverage: PixelCoverage::Exact,
        ..RenderSettings::default()
    };
    let scene = read_as(DialectChoice::Course, greys.name, greys.document);
    let told = advised_by_default(&scene, &settings, [64, 64], [46, 47])
        .hints()
        .concat();
    assert!(told.contains("Rules standard with dialect course"), "{told}");
}

#[test]
fn opacity_is_no_seam() {
    let seam = |opacity: f64| {
        let halves = format!(
            r#"<g fill-opacity="{opacity}"><polygon points="0,0 4.5,0 4.5,8 0,8"/><polygon points="4.5,0 8,0 8,8 4.5,8"/></g>"#
        );
        let document = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="8" height="8">{halves}</svg>"#);
        let settings = RenderSettings {
            coverage: PixelCoverage::Exact,
            ..RenderSettings::default()
        };
        let scene = read_as(DialectChoice::Svg, "halves.svg", &document);
        advised(&scene, &settings, [8, 8], [4, 4]).hints().concat()
    };
    let translucent = seam(0.5);
    assert!(
        translucent.contains("56.25 % of what is below shows through, where their opacity alone lets 50 % through"),
        "{translucent}"
    );
    let opaque = seam(1.0);
    assert!(
        opaque.contains("= 25 % of what is below shows through: a seam"),
        "{opaque}"
    );
    assert!(!seam(0.05).contains("a seam"), "less than can be told from none");
}

#[test]
fn advice_says_that_a_pixel_is_right() {
    let whole = r##"<svg width="8" height="8"><polygon points="0,0 8,0 8,8 0,8" fill="#FF0000"/></svg>"##;
    let found = advised(&read("whole.svg", whole), &RenderSettings::default(), [8, 8], [4, 4]);
    assert!(found.hints().is_empty(), "{:?}", found.hints());
    let told = found.text(rasterscope::inspect::Detail::Telling);
    assert!(told.contains("This pixel is what it should be"), "{told}");
}

#[test]
fn texels_are_decided_by_the_point_that_is_shown() {
    // One pixel shows 1/8 of a texel: many points lie close to where texels meet.
    let document = r#"<svg xmlns="http://www.w3.org/2000/svg" width="96" height="64">
        <texture texid="map" filename="../../assets/textures/map.png"/>
        <textri texid="map" uvs="0.1 0.1 0.1234 0.1 0.1 0.1156" points="0,0 96,0 0,64"/></svg>"#;
    let scene = read("texels.svg", document);
    for rules in Rules::ALL {
        let settings = RenderSettings {
            rules,
            ..RenderSettings::default()
        };
        for pixel in (0..40).map(|i| [i * 2, i / 2]) {
            let found = advised(&scene, &settings, SIZE, pixel);
            for paint in (0..found.paints.len()).filter(|paint| found.paints[*paint].texture.is_some()) {
                let lines = found.fragment_lines(paint, 0).join("\n");
                let numbers = |start: &str| -> Vec<f64> {
                    let rest = &lines[lines.find(start).unwrap() + start.len()..];
                    let pair = rest.split(')').next().unwrap();
                    pair.split(", ").map(|number| number.parse().unwrap()).collect()
                };
                let (point, texel) = (numbers("point     ("), numbers("of texel ("));
                let whole: Vec<f64> = point.iter().map(|at| at.floor()).collect();
                assert_eq!(whole, texel, "{pixel:?} {rules:?}: {lines}");
            }
        }
    }
}
