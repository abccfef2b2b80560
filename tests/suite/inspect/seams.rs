//! Hints about seams: they say what a pixel's samples show, and are silent where neighbours meet as they should.

use rasterscope::geometry::View as SceneView;
use rasterscope::raster::SampleRate;
use rasterscope::render::RenderSettings;
use rasterscope::rules::Rules;
use rasterscope::scene::{self, DialectChoice, ReadOptions};
use rasterscope::texture::{LevelSampling, PixelSampling};
use rasterscope::viewer::gallery::{SCENES, Textures};

use crate::support::explaining::{advised, advised_in};

const TWICE: &str = "a line belongs to both";
const GAP: &str = "leaves a gap of";
const LEVELS: &str = "the level of detail changes from";

/// What would help at a pixel of a document that is drawn at one unit per pixel.
fn hints(body: &str, settings: &RenderSettings, size: [u32; 2], pixel: [u32; 2]) -> String {
    let [width, height] = size;
    let document = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="{width}" height="{height}">{body}</svg>"#
    );
    let options = ReadOptions {
        dialect: DialectChoice::Auto,
    };
    let scene = scene::read(document.as_bytes(), "scene.svg", options, &Textures).unwrap();
    advised(&scene, settings, size, pixel).hints().join("\n")
}

fn settings(rules: Rules, samples: u32) -> RenderSettings {
    RenderSettings {
        rules,
        sample_rate: SampleRate::new(samples).unwrap(),
        ..RenderSettings::default()
    }
}

/// Two triangles that share the diagonal of a square.
fn square(opacity: &str) -> String {
    format!(
        r##"<polygon fill="#802060" fill-opacity="{opacity}" points="0,0 8,0 8,8"/><polygon fill="#802060" fill-opacity="{opacity}" points="0,0 8,8 0,8"/>"##
    )
}

#[test]
fn seams_of_edges_that_are_drawn_twice() {
    let at = |body: &str, rules, samples, pixel| hints(body, &settings(rules, samples), [8, 8], pixel);
    let shining = square("0.5");
    let told = at(&shining, Rules::Course, 1, [3, 3]);
    assert!(
        told.contains(TWICE) && told.starts_with("Its only sample lies"),
        "{told}"
    );
    assert!(
        told.contains("2 (triangle of polygon, line 1)"),
        "it names the neighbours: {told}"
    );
    let told = at(&shining, Rules::Course, 16, [3, 3]);
    assert!(told.starts_with("4 of 16 samples lie"), "the diagonal's: {told}");
    for (body, rules, pixel, why) in [
        (
            &shining,
            Rules::Standard,
            [3, 3],
            "the standard rules give the line to one of them",
        ),
        (&shining, Rules::Course, [5, 3], "no sample on the line"),
        (
            &square("1"),
            Rules::Course,
            [3, 3],
            "what is opaque hides what was painted before",
        ),
    ] {
        let told = at(body, rules, 1, pixel);
        assert!(!told.contains(TWICE), "{why}: {told}");
    }
    // One over the other: both own the line by anybody's rules, at least in part.
    let over = r##"<polygon fill="#802060" fill-opacity="0.5" points="0,0 8,0 8,8"/><polygon fill="#802060" fill-opacity="0.5" points="0,0 8,0 8,8"/>"##;
    let told = at(over, Rules::Course, 1, [3, 3]);
    assert!(!told.contains(TWICE), "these are no neighbours: {told}");
}

/// The diagonals of both squares lie on one line: those of the paper meet there, too, and are opaque.
#[test]
fn seams_name_the_halves_of_what_shines_through() {
    let paper = r##"<rect x="0" y="0" width="20" height="20" fill="#FFFFFF"/>"##;
    let square = r##"<rect x="5" y="5" width="10" height="10" fill="#FF0000" fill-opacity="0.5"/>"##;
    let at = |body: &str| hints(body, &settings(Rules::Course, 1), [20, 20], [7, 12]);
    let told = at(&format!("{paper}{square}"));
    let pair = "on the line between 3 (triangle of rect, line 1) and 4 (triangle of rect, line 1).";
    assert!(told.contains(TWICE) && told.contains(pair), "{told}");
    let half = r##"<polygon points="5,5 15,5 5,15" fill="#FF0000" fill-opacity="0.5"/>"##;
    let told = at(&format!("{paper}{half}"));
    assert!(!told.contains(TWICE), "one half has no neighbour: {told}");
}

#[test]
fn seams_of_gaps_in_the_document() {
    let two = |left: f64, right: f64| {
        format!(
            r##"<polygon fill="#802060" points="0,0 {left},0 {left},12"/><polygon fill="#208060" points="{right},0 {right},12 12,0"/>"##
        )
    };
    let at = |body: &str, samples| hints(body, &settings(Rules::Standard, samples), [12, 12], [4, 2]);
    let told = at(&two(4.48, 4.53), 9);
    assert!(told.contains(GAP) && told.contains("gap of 0.05 pixels"), "{told}");
    for (body, samples, why) in [
        (two(4.5, 4.5), 9, "they meet"),
        (two(4.48, 4.53), 4, "no sample lies in the gap"),
        (two(4.3, 4.7), 9, "as wide as this it is meant"),
        (two(4.53, 4.48), 9, "they overlap"),
    ] {
        let told = at(&body, samples);
        assert!(!told.contains(GAP), "{why}: {told}");
    }
    // The same edges, but that one leans: narrow at the top, and wide at the foot.
    let wedge = r##"<polygon fill="#802060" points="0,0 4.48,0 4.1,12"/><polygon fill="#208060" points="4.53,0 4.9,12 12,0"/>"##;
    let told = at(wedge, 9);
    assert!(!told.contains(GAP), "a wedge is meant: {told}");
}

#[test]
fn seams_of_levels_that_jump_between_triangles() {
    // The lower triangle's texture coordinates run `more` times as fast.
    let two = |more: f64| {
        let far = 0.5 * more;
        format!(
            r#"<texture texid="map" filename="../../assets/textures/map.png"/>
            <textri texid="map" uvs="0 0 0.5 0 0 0.5" points="0,0 64,0 0,64"/>
            <textri texid="map" uvs="{far} 0 {far} {far} 0 {far}" points="64,0 64,64 0,64"/>"#
        )
    };
    let at = |body: &str, level_sampling, pixel| {
        let settings = RenderSettings {
            level_sampling,
            pixel_sampling: PixelSampling::Bilinear,
            ..settings(Rules::Standard, 16)
        };
        hints(body, &settings, [64, 64], pixel)
    };
    let jump = two(4.0);
    let told = at(&jump, LevelSampling::Nearest, [31, 32]);
    assert!(told.contains(LEVELS), "{told}");
    // Rounding 5.52 to 6 is what mixing the levels cures.
    let told = at(&two(2.86), LevelSampling::Nearest, [55, 8]);
    assert!(
        told.contains(LEVELS) && told.contains("Level sampling linear (key L steps to it in the window): "),
        "{told}"
    );
    for (body, sampling, pixel, why) in [
        (&jump, LevelSampling::Linear, [31, 32], "levels are mixed"),
        (&jump, LevelSampling::Zero, [31, 32], "both read level zero"),
        (&jump, LevelSampling::Nearest, [10, 10], "one triangle alone"),
        (
            &two(1.0),
            LevelSampling::Nearest,
            [31, 32],
            "the same level on both sides",
        ),
    ] {
        let told = at(body, sampling, pixel);
        assert!(!told.contains(LEVELS), "{why}: {told}");
    }
}

#[test]
fn seams_scene_shows_seams_by_the_courses_rules_only() {
    let scene = SCENES.iter().find(|scene| scene.name == "study/05_seams.svg").unwrap();
    let options = ReadOptions {
        dialect: DialectChoice::Auto,
    };
    let scene = scene::read(scene.document.as_bytes(), scene.name, options, &Textures).unwrap();
    for (size, from) in [
        ([1280, 800], SceneView::Default),
        ([1024, 1024], SceneView::Default),
        (
            [1000, 560],
            SceneView::At {
                center: scene.canvas / 2.0,
                scale: 1.0,
                rotation: 0.0,
            },
        ),
    ] {
        let view = from.transform(scene.canvas, size);
        for samples in [1, 4, 16] {
            let draw = |rules| {
                let mut frame = rasterscope::raster::Framebuffer::new(size[0], size[1]);
                rasterscope::render::draw(&scene, &view, &settings(rules, samples), &mut frame);
                frame
            };
            let [standard, course] = [Rules::Standard, Rules::Course].map(draw);
            // Far from edges both agree but for rounding.
            let differs = |at: &(usize, (&u32, &u32))| {
                let [[_, r, g, b], [_, s, t, u]] = [at.1.0, at.1.1].map(|pixel| pixel.to_be_bytes());
                r.abs_diff(s).max(g.abs_diff(t)).max(b.abs_diff(u)) > 4
            };
            let both = standard.pixels().iter().zip(course.pixels()).enumerate();
            let first = both
                .filter(differs)
                .map(|(at, _)| u32::try_from(at).unwrap())
                .collect::<Vec<u32>>();
            assert!(first.len() > 1000, "{size:?}, rate {samples}: {} pixels", first.len());
            let pixel = first.iter().map(|at| [at % size[0], at / size[0]]).find(|pixel| {
                let user = view.to_scene(glam::DVec2::from(pixel.map(f64::from)) + 0.5);
                (user.x - 800.0).abs() < 30.0 && (user.y - 300.0).abs() < 30.0
            });
            let pixel = pixel.unwrap();
            let told = |rules| {
                advised_in(&scene, &settings(rules, samples), (from, size), pixel)
                    .hints()
                    .concat()
            };
            assert!(
                told(Rules::Course).contains(TWICE),
                "{size:?} {samples} {pixel:?}: {}",
                told(Rules::Course)
            );
            assert!(!told(Rules::Standard).contains(TWICE), "{pixel:?}");
        }
    }
}
