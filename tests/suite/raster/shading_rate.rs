//! Shading once per primitive and pixel: what it saves, what it gets wrong, and what is said of it.

use glam::DVec2;
use rasterscope::color::ResolveSpace;
use rasterscope::geometry::View;
use rasterscope::inspect::Setting;
use rasterscope::raster::{Framebuffer, SamplePattern, ShadingRate};
use rasterscope::render::RenderSettings;
use rasterscope::scene::{DialectChoice, ReadOptions, Scene, read};
use rasterscope::viewer::gallery::{SCENES, Textures};

use crate::support::explaining::advised;
use crate::support::scenes::{at_rate, drawn};

const SIZE: [u32; 2] = [512, 512];

/// A colour that grows steeply to the right, on a sliver of a pixel's width: below column 2 black, from 3.2 on white.
const SLIVER: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="12" height="12">
    <colortri points="2.7,-50 3.2,60 2.7,60" colors="0,0,0,1 1,1,1,1 0,0,0,1"/></svg>"#;

fn scene(name: &str) -> Scene {
    let found = SCENES
        .iter()
        .find(|scene| scene.name == name)
        .expect("a scene of the gallery");
    document(name, found.document)
}

fn document(name: &str, text: &str) -> Scene {
    let options = ReadOptions {
        dialect: DialectChoice::Auto,
    };
    read(text.as_bytes(), name, options, &Textures).expect("a good document")
}

fn picture(scene: &Scene, settings: &RenderSettings) -> Framebuffer {
    let view = View::Canvas.transform(scene.canvas, SIZE);
    drawn(scene, &view, settings, SIZE)
}

/// The root of the mean square of differences in some rows.
fn rmse(a: &Framebuffer, b: &Framebuffer, rows: std::ops::Range<usize>) -> f64 {
    let row = SIZE[0] as usize;
    let range = rows.start * row..rows.end * row;
    let (a, b) = (&a.pixels()[range.clone()], &b.pixels()[range]);
    let mut sum = 0.0;
    for (a, b) in a.iter().zip(b) {
        for (a, b) in a.to_be_bytes().iter().zip(b.to_be_bytes()) {
            sum += f64::from(a.abs_diff(b)).powi(2);
        }
    }
    (sum / (4 * a.len()) as f64).sqrt()
}

fn with(shading: ShadingRate) -> RenderSettings {
    RenderSettings {
        shading,
        outline: false,
        ..at_rate(16)
    }
}

#[test]
fn study_scenes_show_where_one_colour_is_enough_and_where_it_is_not() {
    let petals = scene("study/23_one_colour_a_pixel.svg");
    let truth = picture(&petals, &with(ShadingRate::Sample).truth());
    let error = |shading| rmse(&picture(&petals, &with(shading)), &truth, 0..512);
    let all = ShadingRate::ALL.map(error);
    assert!(
        all.iter().all(|found| (found - all[0]).abs() < 0.01 * all[0]),
        "petals: {all:?}"
    );
    let misses = scene("study/24_what_one_colour_misses.svg");
    let truth = picture(&misses, &with(ShadingRate::Sample).truth());
    let [sails, slats] = [0..270, 280..512]
        .map(|rows| ShadingRate::ALL.map(|shading| rmse(&picture(&misses, &with(shading)), &truth, rows.clone())));
    let [sample, centre, centroid] = sails;
    assert!(centre > 3.0 * sample && centroid > 3.0 * sample, "sails: {sails:?}");
    let [sample, centre, centroid] = slats;
    assert!(centre > 1.5 * centroid && centre > 2.0 * sample, "slats: {slats:?}");
}

#[test]
fn pixels_inside_have_the_colour_of_one_sample_in_the_middle() {
    // Texels and colours, all of the frame inside of them.
    for name in ["texmap/test5.svg", "basic/test7.svg"] {
        let scene = scene(name);
        let around = View::At {
            center: scene.canvas * 0.5 + DVec2::new(0.37, 0.11),
            scale: 8.0,
            rotation: 20.0,
        };
        let size = [96, 64];
        let view = around.transform(scene.canvas, size);
        let draw = |settings: &RenderSettings| drawn(&scene, &view, settings, size);
        for (shading, pattern, resolve) in [
            (ShadingRate::Centre, SamplePattern::Grid, ResolveSpace::Stored),
            (ShadingRate::Centre, SamplePattern::Jittered, ResolveSpace::Linear),
            (ShadingRate::Centroid, SamplePattern::Grid, ResolveSpace::Linear),
            (ShadingRate::Centroid, SamplePattern::Sobol, ResolveSpace::Stored),
        ] {
            let once = draw(&RenderSettings {
                pattern,
                resolve,
                ..with(shading)
            });
            let one = draw(&RenderSettings {
                outline: false,
                ..at_rate(1)
            });
            let same = once.pixels().iter().zip(one.pixels()).filter(|(a, b)| a == b).count();
            let all = one.pixels().len();
            assert!(
                same * 10 > all * 8,
                "{name}, {shading:?}, {pattern:?}: {same} of {all} pixels"
            );
        }
    }
}

#[test]
fn explanations_tell_where_a_primitive_is_shaded_and_what_helps() {
    let scene = document("sliver.svg", SLIVER);
    let told = |shading, pixel| {
        let found = advised(&scene, &with(shading), [12, 12], pixel);
        let paint = found.paints.len() - 1;
        let sample = found.telling_sample(paint).expect("it paints");
        (found.fragment_lines(paint, sample).join("\n"), found)
    };
    let (lines, found) = told(ShadingRate::Sample, [2, 6]);
    assert!(!lines.contains("shaded"), "{lines}");
    assert_eq!(
        found.paints.last().and_then(|paint| paint.shaded_at),
        None,
        "at each sample"
    );
    let (lines, found) = told(ShadingRate::Centre, [2, 6]);
    assert!(
        lines.contains("shaded    once for all its samples, at (0.5, 0.5): the pixel's centre"),
        "{lines}"
    );
    // The pixel's centre lies left of the sliver, which is black there and darker than black on the left of that.
    let weights = lines
        .lines()
        .find(|line| line.starts_with("weights"))
        .expect("a triangle has some");
    assert!(weights.contains('-'), "outside: {weights}");
    let hints = found.hints().join("\n");
    assert!(
        hints.contains("in its centre, which lies outside: its colour is extrapolated."),
        "{hints}"
    );
    let cures = &found.truth.as_ref().expect("asked for").cures;
    assert!(
        cures.iter().any(|cure| cure.setting == Setting::ShadingRate),
        "{cures:?}"
    );
    let (lines, _) = told(ShadingRate::Centroid, [2, 6]);
    let [x, y] = told(ShadingRate::Centroid, [2, 6])
        .1
        .paints
        .last()
        .and_then(|paint| paint.shaded_at)
        .expect("once");
    assert!(
        (0.7..1.0).contains(&x) && (0.4..0.6).contains(&y),
        "in the sliver: {x}, {y}"
    );
    assert!(lines.contains("the mean of the samples that it covers"), "{lines}");
}
