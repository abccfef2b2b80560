//! What is said of textures under a pixel: footprints, levels and areas, and why other settings read them better.

use rasterscope::color::ResolveSpace;
use rasterscope::inspect::{Cure, Explanation, Setting};
use rasterscope::raster::{PixelCoverage, SampleRate, ShadingRate};
use rasterscope::render::RenderSettings;
use rasterscope::scene::{self, ReadOptions, Scene};
use rasterscope::texture::{Anisotropy, FixedLevel, LevelSampling, LodBias, Wrap};
use rasterscope::viewer::gallery::{SCENES, Textures};

use crate::support::explaining::{advised, advised_by_default, explained};
use crate::support::scenes::gallery_scene;

fn with(samples: u32, level_sampling: LevelSampling) -> RenderSettings {
    RenderSettings {
        sample_rate: SampleRate::new(samples).unwrap(),
        level_sampling,
        ..RenderSettings::default()
    }
}

/// A texture of the gallery over 8 x 8 pixels, of which one holds so many copies of it in width and in height; the point (0, 0) of the
/// texture lies in the middle.
fn textured(name: &str, copies: f64) -> Scene {
    textured_below(name, copies, "")
}

/// The same below something else.
fn textured_below(name: &str, copies: f64, above: &str) -> Scene {
    stretched_below(name, [copies; 2], above)
}

/// The same with other numbers of copies in width and in height.
fn stretched_below(name: &str, copies: [f64; 2], above: &str) -> Scene {
    let [left, top] = copies.map(|copies| -4.0 * copies);
    let [right, bottom] = copies.map(|copies| 12.0 * copies);
    let document = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="8" height="8">
        <texture texid="map" filename="../../assets/textures/{name}"/>
        <textri texid="map" uvs="{left} {top} {right} {top} {left} {bottom}" points="0,0 16,0 0,16"/>{above}</svg>"#
    );
    scene::read(document.as_bytes(), "textured.svg", ReadOptions::default(), &Textures).unwrap()
}

fn hints(found: &Explanation) -> String {
    found.hints().join("\n")
}

#[test]
fn advice_on_derivatives_says_what_follows_a_pixel() {
    let read = |name: &str| {
        let scene = SCENES.iter().find(|scene| scene.name.ends_with(name)).unwrap();
        scene::read(scene.document.as_bytes(), name, ReadOptions::default(), &Textures).unwrap()
    };
    let (size, seal, map) = ([61, 77], read("texmap/test4.svg"), read("texmap/test2.svg"));
    let taps = |count, own| RenderSettings {
        anisotropy: Anisotropy::new(count).unwrap(),
        ..own
    };
    let mut fixed = taps(2, with(4, LevelSampling::Zero));
    fixed.detail.fixed = FixedLevel::new(0.0);
    let level = "The level of detail is that of a whole pixel, for each of its samples. Level of detail per sample: ";
    let along =
        "The taps of each sample lie along the footprint of a whole pixel, not of the sample's part of it. Level of";
    for (scene, pixel, settings, expected) in [
        (&seal, [20, 40], with(9, LevelSampling::Linear), level),
        (
            &seal,
            [20, 40],
            with(9, LevelSampling::SummedArea),
            "The box that each sample averages is that of a whole pixel, not of the sample's part of it. Level of",
        ),
        (
            &seal,
            [20, 40],
            with(9, LevelSampling::Ewa),
            "The ellipse that each sample weighs is that of a whole pixel, not of the sample's part of it. Level of",
        ),
        (
            &seal,
            [20, 40],
            with(9, LevelSampling::Ripmap),
            "The ripmap's levels are those of a whole pixel's footprint, for each of its samples. Level of",
        ),
        (&map, [14, 35], taps(2, with(4, LevelSampling::Zero)), along),
        (&map, [14, 35], fixed, along),
    ] {
        let told = hints(&advised_by_default(scene, &settings, size, pixel));
        assert!(told.contains(expected), "{expected} {settings:?}: {told}");
    }
}

#[test]
fn advice_on_the_pyramid_says_what_was_averaged_and_what_is() {
    let scene = textured("checker.png", 0.3);
    let light = |own: RenderSettings| RenderSettings {
        resolve: ResolveSpace::Linear,
        ..own
    };
    let exact = RenderSettings {
        coverage: PixelCoverage::Exact,
        ..with(1, LevelSampling::Linear)
    };
    for (settings, expected) in [
        (
            with(16, LevelSampling::Linear),
            "Mip levels were averaged in stored values, and samples are averaged in linear light. Pyramid linear",
        ),
        (
            with(16, LevelSampling::SummedArea),
            "The table was summed in stored values, and samples are averaged in linear light. Pyramid linear",
        ),
        (
            with(16, LevelSampling::Ripmap),
            "The ripmap's levels were averaged in stored values, and samples are averaged in linear light. Pyramid",
        ),
        (
            with(1, LevelSampling::Linear),
            "Mip levels were averaged in stored values, and the truth's samples are averaged in linear light. Pyramid",
        ),
        (
            exact,
            "Mip levels were averaged in stored values, and areas are mixed in linear light. Pyramid linear",
        ),
    ] {
        let told = hints(&advised(&scene, &light(settings), [8, 8], [5, 5]));
        assert!(told.contains(expected), "{expected} {settings:?}: {told}");
    }
}

#[test]
fn a_pyramid_unlike_the_samples_is_called_luck() {
    let mut found = advised(
        &textured("checker.png", 0.3),
        &with(4, LevelSampling::Linear),
        [8, 8],
        [5, 5],
    );
    found.truth.as_mut().unwrap().cures = vec![Cure {
        setting: Setting::Pyramid,
        value: ResolveSpace::Linear.name().to_owned(),
        color: [255; 4],
        nearer: 9.0,
        samples: None,
        dialect: None,
    }];
    assert_eq!(
        hints(&found),
        "Mip levels were averaged in stored values, as samples of the truth are: that another average comes nearer happens to be so here. Pyramid linear: 9 levels nearer to the truth."
    );
}

#[test]
fn a_kernel_is_said_to_move_the_truth() {
    let mut found = advised(
        &textured("checker.png", 0.3),
        &with(4, LevelSampling::Linear),
        [8, 8],
        [5, 5],
    );
    for (setting, value, end) in [
        (
            Setting::PixelSampling,
            "catmull-rom",
            "3 levels nearer to the truth, which it moves, too.",
        ),
        (Setting::LevelSampling, "zero", "3 levels nearer to the truth."),
    ] {
        found.truth.as_mut().unwrap().cures = vec![Cure {
            setting,
            value: value.to_owned(),
            color: [255; 4],
            nearer: 3.0,
            samples: None,
            dialect: None,
        }];
        let told = hints(&found);
        assert!(told.ends_with(end), "{setting:?}: {told}");
    }
}

#[test]
fn level_0_is_advised_where_samples_read_all_of_it() {
    // One pixel shows 12 x 8 texels.
    let scene = textured("picture.png", 0.0125);
    let told = |samples| hints(&advised(&scene, &with(samples, LevelSampling::Linear), [8, 8], [7, 5]));
    let expected = "Samples lie only about 1.5 texels apart here, close enough to read level 0 as it is: to average it before blurs. Level sampling zero (key L";
    let close = told(64);
    assert!(close.contains(expected), "{close}");
    let far = told(4);
    assert!(!far.contains("Level sampling zero"), "it would be luck: {far}");
}

#[test]
fn footprints_hold_no_more_texels_than_the_texture() {
    // The texture is a quarter of that pixel; the rest repeats its border.
    let told = hints(&advised(
        &textured("map.png", 2.0),
        &with(1, LevelSampling::Zero),
        [8, 8],
        [4, 4],
    ));
    let expected = "The pixel's footprint holds about 2097152 texels, of which its only sample reads one.";
    assert!(told.contains(expected), "{told}");
}

#[test]
fn a_fixed_level_of_detail_tells_its_bias() {
    let scene = textured("map.png", 0.05);
    let told = |bias: f64| {
        let mut settings = with(1, LevelSampling::Linear);
        settings.detail.fixed = FixedLevel::new(2.0);
        settings.detail.bias = LodBias::new(bias).unwrap();
        let found = explained(&scene, &settings, [8, 8], [4, 4]);
        let lines = (0..found.paints.len()).flat_map(|paint| found.paint_lines(paint));
        lines
            .into_iter()
            .find(|line| line.starts_with("level of detail"))
            .unwrap()
    };
    for (bias, expected) in [
        (
            1.5,
            "level of detail  2.000 as the settings say + 1.5 of bias = 3.500, ",
        ),
        (
            -0.5,
            "level of detail  2.000 as the settings say - 0.5 of bias = 1.500, ",
        ),
        (0.0, "level of detail  2.000 as the settings say, "),
    ] {
        let told = told(bias);
        assert!(told.starts_with(expected), "{told}");
    }
}

/// The strip on top has one colour, wherever it is shaded; what is wrong is the texture below it.
#[test]
fn what_is_shaded_once_is_named_by_whose_colour_is_wrong() {
    let strip = r#"<colortri points="-4,4.7 20,4.7 20,5.4" colors="1 0.9 0 1 1 0.9 0 1 1 0.9 0 1"/>"#;
    let scene = textured_below("checker.png", 0.3, strip);
    for shading in [ShadingRate::Centre, ShadingRate::Centroid] {
        let settings = RenderSettings {
            shading,
            ..with(16, LevelSampling::Zero)
        };
        let told = hints(&advised(&scene, &settings, [8, 8], [5, 4]));
        let expected = "For the whole pixel 1 (triangle of textri, line 3) is shaded once, not at each of its samples. Shading per";
        assert!(told.contains(expected), "{shading:?}: {told}");
        assert!(!told.contains("extrapolated"), "{shading:?}: {told}");
    }
}

/// Along a footprint that is longer than wide a level averages too much across; that is the reason where as many samples as the
/// truth has of the same level are wrong, too.
#[test]
fn a_level_is_said_to_blur_where_more_samples_of_it_are_no_better() {
    let scenes = [("map.png", [0.03, 0.005]), ("checker.png", [0.006, 0.0024])];
    let (mut blurred, mut few) = (0, 0);
    let settings = |samples| RenderSettings {
        texture_wrap: Wrap::Repeat,
        ..with(samples, LevelSampling::Nearest)
    };
    let pixels = scenes
        .iter()
        .flat_map(|(name, copies)| (0..64).map(move |i| (name, copies, [i % 8, i / 8])));
    for (name, copies, pixel) in pixels {
        let scene = stretched_below(name, *copies, "");
        let found = advised(&scene, &settings(1), [8, 8], pixel);
        let truth = found.truth.as_ref().expect("little to draw");
        let often = advised(&scene, &settings(256), [8, 8], pixel);
        let often = often.truth.as_ref().expect("little to draw").distance;
        for (cure, hint) in truth.cures.iter().zip(found.hints()) {
            if hint.contains("that blurs") {
                assert!(often > cure.nearer * 0.4, "{pixel:?}, {often}: {hint}");
                blurred += 1;
            }
            if hint.contains("Of level ") {
                assert!(hint.contains(" its only sample reads just 1 texel."), "{hint}");
                assert!(often < cure.nearer * 0.6, "{pixel:?}, {often}: {hint}");
                few += 1;
            }
        }
    }
    assert!(blurred > 3 && few > 3, "{blurred} blurred, {few} too few");
}

/// The triangles of a floor share its texture: which of them a sample meets changes little, and what is wrong is how few texels are
/// read.
#[test]
fn what_one_texture_goes_on_across_is_not_wrongly_covered() {
    let scene = gallery_scene("study/11_city_floor.svg");
    for pixel in [[110, 141], [195, 71]] {
        let told = hints(&advised(&scene, &with(1, LevelSampling::Zero), [200, 160], pixel));
        for wrong in ["by area", "No sample meets", "breaks up"] {
            assert!(!told.contains(wrong), "{pixel:?}: {told}");
        }
        let expected = "texels apart here, and what is between them is not read. ";
        assert!(told.contains(expected), "{pixel:?}: {told}");
    }
}
