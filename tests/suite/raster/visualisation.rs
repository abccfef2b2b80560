//! Visualisations: each number that colours stand for is compared with what the explanation of the pixel, or plain
//! arithmetic, says of it.

use rasterscope::color::{Colormap, ResolveSpace};
use rasterscope::figure::{PixelRect, add_legends, place_legends};
use rasterscope::geometry::View;
use rasterscope::inspect::{Interpolated, Texture as ReadTexture, View as ViewOfSample};
use rasterscope::raster::{Framebuffer, ResolveFilter, SamplePattern, SampleRate};
use rasterscope::render::{ClampedPixels, LegendKey, RenderSettings, Subject, Visualisation, draw, replay};
use rasterscope::rules::Rules;
use rasterscope::scene::{Composite, DialectChoice, PrimitiveKind, Scene};
use rasterscope::texture::{Anisotropy, LevelSampling, PixelSampling};
use rasterscope::viewer::gallery::{SCENES, Textures};
use rayon::prelude::*;

use crate::support::documents::{read, svg};
use crate::support::explaining::explained;
use crate::support::golden::check;

/// What a colour may be off: it is stored in bytes, and `(u, v)` comes in steps of 1/256.
const NEAR: f64 = 2.6;
/// What goldens may differ by: logarithms are not the same on every machine.
const TOLERANCE: u8 = 1;
/// What one fragment is worth in the byte that is counted in.
const FRAGMENT: f64 = 8.0;

/// Scenes of textured triangles.
const TEXTURED: [&str; 2] = ["texmap/test1.svg", "study/11_city_floor.svg"];

fn rate(samples: u32) -> SampleRate {
    SampleRate::new(samples).unwrap()
}

fn showing(visualisation: Visualisation) -> RenderSettings {
    RenderSettings {
        visualisation,
        ..RenderSettings::default()
    }
}

fn gallery(name: &str) -> Scene {
    let scene = SCENES.iter().find(|scene| scene.name == name).unwrap();
    read_own(scene.name, scene.document)
}

fn read_own(name: &str, document: &str) -> Scene {
    let options = rasterscope::scene::ReadOptions {
        dialect: DialectChoice::Auto,
    };
    rasterscope::scene::read(document.as_bytes(), name, options, &Textures).unwrap()
}

fn picture(scene: &Scene, settings: &RenderSettings, view: View, size: [u32; 2]) -> Framebuffer {
    let mut frame = Framebuffer::new(size[0], size[1]);
    draw(scene, &view.transform(scene.canvas, size), settings, &mut frame);
    frame
}

fn pixel(frame: &Framebuffer, x: u32, y: u32) -> u32 {
    frame.pixels()[(y * frame.width() + x) as usize]
}

/// Red, green, blue.
fn bytes(pixel: u32) -> [i32; 3] {
    let [_, r, g, b] = pixel.to_be_bytes();
    [r, g, b].map(i32::from)
}

fn is_near(a: u32, b: u32, most: i32) -> bool {
    a >> 24 == b >> 24 && bytes(a).iter().zip(bytes(b)).all(|(a, b)| (a - b).abs() <= most)
}

/// The byte that a mean becomes.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a byte")]
fn resolved(mean: f64, rules: Rules) -> u8 {
    match rules {
        Rules::Standard | Rules::Float => mean.round() as u8,
        Rules::Course => mean.floor() as u8,
    }
}

/// Samplings under which pixels are counted.
fn samplings() -> Vec<RenderSettings> {
    let plain = RenderSettings::default();
    let mut all = Vec::new();
    for (samples, pattern) in [
        (1, SamplePattern::Grid),
        (16, SamplePattern::Grid),
        (4, SamplePattern::Jittered),
        (5, SamplePattern::R2),
    ] {
        for rules in Rules::ALL {
            all.push(RenderSettings {
                sample_rate: rate(samples),
                pattern,
                rules,
                outline: false,
                ..plain
            });
        }
    }
    all
}

#[test]
fn visualised_coverage_and_overdraw_count_the_fragments_of_every_scene() {
    let size = [19, 15];
    let scale = |visualisation: Visualisation, scene: &Scene| match visualisation.legend(scene).unwrap().key {
        LegendKey::Scale(colors, _) => colors,
        key => panic!("{key:?} is no scale"),
    };
    SCENES.par_iter().for_each(|own| {
        let scene = read_own(own.name, own.document);
        let is_clip = |kind: &PrimitiveKind| {
            matches!(
                kind,
                PrimitiveKind::EndLayer {
                    composite: Composite::Clip
                }
            )
        };
        if scene.primitives.iter().any(|primitive| is_clip(&primitive.kind)) {
            // What clip paths take away is not counted: `clip_paths_take_fragments_away`.
            return;
        }
        let masks = scene.parts_of_masks().unwrap_or_default();
        for settings in samplings() {
            let view = View::Default.transform(scene.canvas, size);
            let subject = Subject {
                scene: &scene,
                view: &view,
                settings: &settings,
            };
            let [covered, overdrawn] = [Visualisation::Coverage, Visualisation::Overdraw].map(|visualisation| {
                let settings = RenderSettings {
                    visualisation,
                    ..settings
                };
                picture(&scene, &settings, View::Default, size)
            });
            let colors = scale(Visualisation::Overdraw, &scene);
            for (x, y) in (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))) {
                let found = replay(&subject, size, [x, y]).unwrap();
                let count = found.samples.len();
                let mut fragments = vec![0_u32; count];
                for op in &found.painted {
                    let in_mask = masks.get(op.source as usize).is_some_and(|part| *part);
                    if op.kind == rasterscope::raster::PaintedKind::Primitive && !in_mask {
                        for fragment in &op.fragments {
                            fragments[fragment.sample] += 1;
                        }
                    }
                }
                let at = (own.name, &settings, x, y, &fragments);
                let part = fragments.iter().filter(|count| **count > 0).count() as f64 / count as f64;
                let byte = resolved(part * 255.0, settings.rules);
                let expected = Colormap::Sequential.color(f32::from(byte) / 255.0);
                assert_eq!(pixel(&covered, x, y), expected, "coverage of {at:?}");
                let most = |count: &u32| (f64::from(*count) * FRAGMENT).min(255.0);
                let sum: f64 = fragments.iter().map(most).sum();
                let mean = f64::from(resolved(sum / count as f64, settings.rules)) / FRAGMENT;
                // The scale of the legend is logarithmic, from no fragment to 31.
                let step = ((mean.min(31.0) + 1.0).log2() / 5.0 * 255.0).round();
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
                let expected = colors[step as usize];
                assert!(is_near(pixel(&overdrawn, x, y), expected, 3), "overdraw of {at:?}");
            }
        }
    });
}

#[test]
fn visualised_coverage_does_not_see_colours_and_layers() {
    let body = "<g opacity='0.25'><rect x='0' y='0' width='5' height='10' fill='#fff'/></g>
                <rect x='5' y='0' width='2.5' height='10' fill='#000' fill-opacity='0.01'/>";
    let scene = read(&svg("width='10' height='10'", body), DialectChoice::Svg);
    let settings = RenderSettings {
        sample_rate: rate(16),
        resolve: ResolveSpace::Linear,
        ..showing(Visualisation::Coverage)
    };
    let frame = picture(&scene, &settings, View::Canvas, [10, 10]);
    let full = Colormap::Sequential.color(1.0);
    assert_eq!(pixel(&frame, 2, 5), full, "in a layer");
    assert_eq!(pixel(&frame, 6, 5), full, "nearly transparent");
    assert_eq!(pixel(&frame, 7, 5), Colormap::Sequential.color(128.0 / 255.0), "half");
    assert_eq!(pixel(&frame, 8, 5), Colormap::Sequential.color(0.0), "nothing");
}

#[test]
fn visualised_overdraw_tells_edges_that_the_course_paints_twice() {
    let body = "<polygon points='0,0 8,0 8,8' fill='#f00'/><polygon points='0,0 8,8 0,8' fill='#f00'/>";
    let scene = read(&svg("width='8' height='8'", body), DialectChoice::Course);
    let counts = |rules| {
        let settings = RenderSettings {
            rules,
            outline: false,
            ..showing(Visualisation::Overdraw)
        };
        let frame = picture(&scene, &settings, View::Canvas, [8, 8]);
        [(3, 3), (5, 2)].map(|(x, y)| pixel(&frame, x, y))
    };
    let [once, alone] = counts(Rules::Standard);
    assert_eq!(once, alone, "the shared edge belongs to one triangle");
    let [twice, alone] = counts(Rules::Course);
    assert_ne!(twice, alone, "to both");
    let [none, alone] = counts(Rules::Float);
    assert_ne!(none, alone, "to none");
}

#[test]
fn visualised_primitives_have_the_colours_of_the_legend() {
    let body = "<polygon id='low' points='0,0 8,0 8,8 0,8' fill='#123456' fill-opacity='0.5'/>
                <polygon points='4,0 8,0 8,8 4,8' fill='#123456'/>";
    let scene = read(&svg("width='8' height='8'", body), DialectChoice::Svg);
    let frame = picture(&scene, &showing(Visualisation::Primitive), View::Canvas, [8, 8]);
    let Some(LegendKey::Swatches(swatches)) = Visualisation::Primitive.legend(&scene).map(|legend| legend.key) else {
        panic!("swatches");
    };
    let names: Vec<&str> = swatches.iter().map(|(_, name)| name.as_str()).collect();
    assert_eq!(names, ["polygon \"low\"", "polygon, line 2"], "both");
    assert_eq!(
        [pixel(&frame, 1, 4), pixel(&frame, 6, 4)],
        [swatches[0].0, swatches[1].0],
        "opaque"
    );
    assert_ne!(swatches[0].0, swatches[1].0, "told apart");
}

/// Red, green and blue as a mix.
fn mixed(colors: &[u32], parts: &[f64]) -> [f64; 3] {
    let channel = |i: usize| -> f64 {
        let parts = colors.iter().zip(parts);
        parts.map(|(color, part)| f64::from(bytes(*color)[i]) * part).sum()
    };
    [0, 1, 2].map(channel)
}

fn distance(pixel: u32, expected: [f64; 3]) -> f64 {
    let apart = bytes(pixel)
        .into_iter()
        .zip(expected)
        .map(|(a, b)| (f64::from(a) - b).abs());
    apart.fold(0.0, f64::max)
}

/// Colours of a legend that is no scale, in order.
fn legend_colors(visualisation: Visualisation, scene: &Scene) -> Vec<u32> {
    match visualisation.legend(scene).unwrap().key {
        LegendKey::Triangle(corners) => corners.iter().map(|(color, _)| *color).collect(),
        LegendKey::Square(axes) => axes.iter().map(|(color, _)| *color).collect(),
        LegendKey::Swatches(swatches) => swatches.iter().map(|(color, _)| *color).collect(),
        key @ LegendKey::Scale(..) => panic!("{key:?} is a scale"),
    }
}

/// One scene under every visualisation.
struct Shown {
    frames: [Framebuffer; Visualisation::ALL.len()],
    /// Colours of triangle corners, of the axes of `(u, v)`, of mip levels.
    legends: [Vec<u32>; 3],
}

impl Shown {
    fn new(scene: &Scene, sampling: &RenderSettings, size: [u32; 2]) -> Self {
        Self {
            frames: Visualisation::ALL.map(|visualisation| {
                let settings = RenderSettings {
                    visualisation,
                    ..*sampling
                };
                picture(scene, &settings, View::Default, size)
            }),
            legends: [Visualisation::Barycentric, Visualisation::Uv, Visualisation::MipLevels]
                .map(|visualisation| legend_colors(visualisation, scene)),
        }
    }

    fn pixel(&self, visualisation: Visualisation, [x, y]: [u32; 2]) -> u32 {
        let index = Visualisation::ALL.iter().position(|known| *known == visualisation);
        pixel(&self.frames[index.unwrap()], x, y)
    }

    /// Compares the pixel with barycentric weights and texture coordinates.
    fn check_place(&self, at: [u32; 2], weights: &[f64], uv: [f64; 2]) {
        let expected = mixed(&self.legends[0], weights);
        let found = self.pixel(Visualisation::Barycentric, at);
        assert!(distance(found, expected) < NEAR, "weights {weights:?} at {at:?}");
        let expected = mixed(&self.legends[1], &uv.map(|part| part.clamp(0.0, 1.0)));
        assert!(
            distance(self.pixel(Visualisation::Uv, at), expected) < NEAR,
            "{uv:?} at {at:?}"
        );
    }

    /// Compares the pixel with how a texture is read there.
    #[expect(clippy::cast_possible_truncation, reason = "numbers that become colours")]
    fn check_reading(&self, at: [u32; 2], texture: &ReadTexture) {
        let lod = texture.level_of_detail.unwrap() as f32;
        let found = self.pixel(Visualisation::LevelOfDetail, at);
        assert!(
            is_near(found, Colormap::Diverging.color(lod / 8.0), 1),
            "level of detail at {at:?}: {texture:?}"
        );
        let ratio = (texture.major / texture.minor).min(texture.major).clamp(1.0, 64.0);
        let expected = Colormap::Sequential.color((ratio.log2() / 6.0) as f32);
        assert!(
            is_near(self.pixel(Visualisation::Anisotropy, at), expected, 1),
            "ratio {ratio} at {at:?}"
        );
        let read: Vec<u32> = texture
            .levels
            .iter()
            .map(|level| self.legends[2][level.number])
            .collect();
        let parts: Vec<f64> = texture.levels.iter().map(|level| level.weight).collect();
        let (tint, below) = (mixed(&read, &parts), bytes(self.pixel(Visualisation::Color, at)));
        let expected = [0, 1, 2].map(|i| 0.7 * tint[i] + 0.3 * f64::from(below[i]));
        let found = self.pixel(Visualisation::MipLevels, at);
        assert!(distance(found, expected) < NEAR, "levels at {at:?}: {texture:?}");
    }
}

/// Every so many pixels of a scene of textured triangles: each visualisation against the explanation of the pixel.
fn compare_with_explanations(name: &str, sampling: RenderSettings) {
    const SIDE: u32 = 120;
    let (scene, size) = (gallery(name), [SIDE; 2]);
    let settings = RenderSettings {
        outline: false,
        ..sampling
    };
    let shown = Shown::new(&scene, &settings, size);
    let mut seen = 0;
    for pixel in (0..SIDE)
        .step_by(5)
        .flat_map(|y| (0..SIDE).step_by(5).map(move |x| [x, y]))
    {
        let explanation = explained(&scene, &settings, size, pixel);
        let Some(top) = explanation.samples[0].stack.last() else {
            continue;
        };
        let paint = &explanation.paints[*top];
        let (Some(texture), [ViewOfSample::Triangle { weights, value, .. }]) = (&paint.texture, &paint.views[..])
        else {
            continue;
        };
        let Interpolated::Texture { uv, .. } = value else {
            continue;
        };
        seen += 1;
        shown.check_place(pixel, weights, *uv);
        shown.check_reading(pixel, texture);
    }
    assert!(seen > 100, "{seen} textured pixels of {name}");
}

#[test]
fn visualised_numbers_are_those_of_the_explanation() {
    let plain = RenderSettings::default();
    let trilinear = RenderSettings {
        pixel_sampling: PixelSampling::Bilinear,
        level_sampling: LevelSampling::Linear,
        ..plain
    };
    for name in TEXTURED {
        compare_with_explanations(name, plain);
        compare_with_explanations(name, trilinear);
    }
    let detail = rasterscope::texture::LevelOfDetail {
        bias: rasterscope::texture::LodBias::new(1.5).unwrap(),
        ..plain.detail
    };
    compare_with_explanations(TEXTURED[0], RenderSettings { detail, ..trilinear });
    let anisotropy = Anisotropy::new(16).unwrap();
    compare_with_explanations(
        TEXTURED[0],
        RenderSettings {
            anisotropy,
            ..trilinear
        },
    );
}

/// Which pixels are shown as clamped, below 0 and above 1, against the mean that the explanation has before it is clamped.
#[test]
fn clamped_pixels_are_those_whose_mean_no_pixel_can_show() {
    const SIDE: u32 = 70;
    let body = "<rect width='70' height='70' fill='#fff'/><circle cx='20' cy='30' r='12'/>\
                <rect x='40.3' y='12' width='21' height='33' fill='#ff0'/><rect x='52' y='5.5' width='9' height='60' fill='#00f'/>";
    let scene = read(&svg("width='70' height='70'", body), DialectChoice::Svg);
    let shown = |settings: &RenderSettings| picture(&scene, settings, View::Default, [SIDE; 2]);
    for (pattern, resolve, resolve_filter) in [
        (SamplePattern::Grid, ResolveSpace::Stored, ResolveFilter::Lanczos3),
        (SamplePattern::Grid, ResolveSpace::Linear, ResolveFilter::Mitchell),
        (SamplePattern::Sobol, ResolveSpace::Stored, ResolveFilter::CatmullRom),
        (SamplePattern::Jittered, ResolveSpace::Linear, ResolveFilter::Lanczos2),
    ] {
        let settings = RenderSettings {
            sample_rate: rate(4),
            pattern,
            resolve,
            resolve_filter,
            ..showing(Visualisation::Clamped)
        };
        let frame = shown(&settings);
        let mut expected = ClampedPixels::default();
        for [x, y] in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| [x, y])) {
            let mean = explained(&scene, &settings, [SIDE; 2], [x, y]).resolve.mean;
            let [below, above] = [
                mean.iter().any(|channel| *channel <= -0.5),
                mean.iter().any(|channel| *channel >= 255.5),
            ];
            let own = ClampedPixels {
                below: u64::from(below && !above),
                above: u64::from(above && !below),
                both: u64::from(below && above),
                all: 1,
            };
            let found = ClampedPixels::of(&[pixel(&frame, x, y)]);
            assert_eq!(found, own, "{resolve_filter:?} at {x},{y}: {mean:?}");
            expected.below += own.below;
            expected.above += own.above;
            expected.both += own.both;
            expected.all += 1;
        }
        assert_eq!(ClampedPixels::of(frame.pixels()), expected);
        let counts = [expected.below, expected.above, expected.both];
        assert!(counts.iter().all(|count| *count > 10), "{resolve_filter:?}: {counts:?}");
    }
    // Weights that are never below zero clamp nothing.
    for resolve_filter in [ResolveFilter::Box, ResolveFilter::Tent, ResolveFilter::BSpline] {
        let settings = RenderSettings {
            sample_rate: rate(4),
            resolve_filter,
            ..showing(Visualisation::Clamped)
        };
        let expected = ClampedPixels {
            all: u64::from(SIDE * SIDE),
            ..ClampedPixels::default()
        };
        assert_eq!(
            ClampedPixels::of(shown(&settings).pixels()),
            expected,
            "{resolve_filter:?}"
        );
    }
}

#[test]
fn visualised_edges_run_where_the_primitives_do() {
    let body =
        "<polygon points='2,2 14,2 14,14 2,14' fill='#000'/><rect x='20' y='4' width='0' height='0' fill='#0f0'/>";
    let scene = read(&svg("width='24' height='16'", body), DialectChoice::Course);
    let settings = RenderSettings {
        outline: false,
        ..showing(Visualisation::Wireframe)
    };
    let frame = picture(&scene, &settings, View::Canvas, [24, 16]);
    let colors = legend_colors(Visualisation::Wireframe, &scene);
    for (x, y) in [(2, 8), (14, 8), (8, 2), (8, 14)] {
        assert_eq!(pixel(&frame, x, y), colors[1], "outline at {x},{y}");
    }
    assert_eq!(pixel(&frame, 20, 4), colors[2], "the point");
    assert_eq!(
        bytes(pixel(&frame, 8, 8)),
        [204; 3],
        "the inside is paled by four fifths"
    );
    assert_eq!(bytes(pixel(&frame, 18, 12)), [255; 3], "white stays white");
    let course = RenderSettings {
        rules: Rules::Course,
        ..settings
    };
    let frame = picture(&scene, &course, View::Canvas, [24, 16]);
    let diagonal = [pixel(&frame, 8, 8), pixel(&frame, 8, 7), pixel(&frame, 7, 8)];
    assert!(
        diagonal.contains(&colors[0]),
        "the course paints two triangles: {diagonal:x?}"
    );
}

#[test]
fn visualised_pictures_do_not_depend_on_regions() {
    let scene = gallery("texmap/test2.svg");
    let size = [90, 70];
    let view = View::Default.transform(scene.canvas, size);
    for visualisation in Visualisation::ALL {
        let settings = RenderSettings {
            sample_rate: rate(4),
            ..showing(visualisation)
        };
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        };
        let whole = picture(&scene, &settings, View::Default, size);
        let mut parts = Framebuffer::new(size[0], size[1]);
        let half = |x| rasterscope::raster::Region {
            x,
            y: 0,
            width: 45,
            height: 70,
        };
        let cancel = rasterscope::render::CancelToken::default();
        rasterscope::render::draw_regions(&subject, &mut parts, &[half(0), half(45)], &cancel).unwrap();
        assert!(whole == parts, "{visualisation:?}");
    }
}

#[test]
fn visualisations_are_explained_by_legends() {
    let scene = gallery("texmap/test1.svg");
    assert_eq!(Visualisation::Color.legend(&scene), None, "the picture explains itself");
    for visualisation in Visualisation::ALL.into_iter().skip(1) {
        let legend = visualisation.legend(&scene).unwrap();
        if let LegendKey::Scale(colors, ticks) = &legend.key {
            assert!(ticks.len() >= 5 && colors.len() == 256, "{visualisation:?}");
            assert!(ticks.iter().all(|(at, _)| (0.0..=1.0).contains(at)), "{ticks:?}");
            assert!(ticks.is_sorted_by(|a, b| a.0 < b.0), "{ticks:?}");
        }
        let mut picture = Framebuffer::new(640, 480);
        picture.pixels_mut().fill(0xFF80_8080);
        let spared = PixelRect {
            x: 10,
            y: 400,
            width: 20,
            height: 20,
        };
        let all = PixelRect::of_size([640, 480]);
        let placed = place_legends(&[legend.clone(), legend.clone()], [640, 480], &all, &[spared]);
        let [(first, _), (second, _)] = &placed[..] else {
            panic!("room for two: {visualisation:?}")
        };
        for rect in [first, second] {
            assert!(
                !rect.overlaps(&spared) && rect.intersection(&all) == *rect,
                "{visualisation:?} {rect:?}"
            );
        }
        assert!(!first.overlaps(second), "{visualisation:?} side by side");
        assert_eq!(add_legends(&mut picture, std::slice::from_ref(&legend), &[]), 1, "room");
        assert_eq!(add_legends(&mut Framebuffer::new(60, 60), &[legend], &[]), 0, "no room");
    }
}

#[test]
fn golden_visualisations() {
    let mut problems = Vec::new();
    let scene = gallery("study/16_what_is_painted.svg");
    for visualisation in Visualisation::ALL.into_iter().skip(1) {
        let settings = RenderSettings {
            sample_rate: rate(4),
            pixel_sampling: PixelSampling::Bilinear,
            level_sampling: LevelSampling::Linear,
            resolve_filter: if visualisation == Visualisation::Clamped {
                ResolveFilter::Lanczos3
            } else {
                ResolveFilter::Box
            },
            ..showing(visualisation)
        };
        let mut frame = picture(&scene, &settings, View::Default, [400, 400]);
        let legend = visualisation.legend_of(&scene, visualisation.clamped(frame.pixels()));
        add_legends(&mut frame, &[legend.unwrap()], &[]);
        let name = format!("visualised_{}", visualisation.name());
        problems.extend(check(&name, &frame, TOLERANCE).err());
    }
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

#[test]
fn clip_paths_take_fragments_away() {
    let document = "<svg xmlns='http://www.w3.org/2000/svg' width='20' height='10'>\
        <clipPath id='left'><rect width='10' height='10'/></clipPath>\
        <g clip-path='url(#left)' opacity='.5'><rect width='20' height='5'/><rect width='20' height='10'/></g></svg>";
    let scene = read(document, DialectChoice::Svg);
    let settings = RenderSettings {
        visualisation: Visualisation::Overdraw,
        outline: false,
        ..RenderSettings::default()
    };
    let LegendKey::Scale(colors, _) = Visualisation::Overdraw.legend(&scene).unwrap().key else {
        panic!("a scale");
    };
    let shown = picture(&scene, &settings, View::Canvas, [20, 10]);
    for (at, count) in [([5, 2], 2.0_f64), ([5, 7], 1.0), ([15, 2], 0.0), ([15, 7], 0.0)] {
        let step = ((count + 1.0).log2() / 5.0 * 255.0).round();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
        let expected = colors[step as usize];
        assert_eq!(pixel(&shown, at[0], at[1]), expected, "{count} fragments at {at:?}");
    }
}

#[test]
fn visualisations_count_what_the_picture_counts() {
    let scene = gallery("texmap/test1.svg");
    let view = View::Default.transform(scene.canvas, [64, 64]);
    let count = |visualisation| {
        let mut frame = Framebuffer::new(64, 64);
        draw(&scene, &view, &showing(visualisation), &mut frame).triangles
    };
    let of_picture = count(Visualisation::Color);
    for visualisation in Visualisation::ALL {
        // Edges are lines.
        let found = count(visualisation);
        assert!(
            found <= of_picture && (found > 0 || visualisation == Visualisation::Wireframe),
            "{found}, not {of_picture} as {}",
            visualisation.name()
        );
    }
}
