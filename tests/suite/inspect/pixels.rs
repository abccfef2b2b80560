//! Explanations of pixels: each is the frame's pixel, byte for byte, and every number in it leads to the next.

#![expect(
    clippy::float_cmp,
    reason = "stored colours are multiples of 1/256, which floats hold exactly"
)]

use std::sync::atomic::{AtomicUsize, Ordering};

use rasterscope::color::ResolveSpace;
use rasterscope::geometry::View as SceneView;
use rasterscope::inspect::{Around, Explanation, Fragment, Interpolated, Paint, Question, Shape, View};
use rasterscope::post::PostProcess;
use rasterscope::raster::{FilterRadius, Framebuffer, ResolveFilter, SamplePattern, SampleRate, ShadingRate};
use rasterscope::render::{RenderSettings, Subject, draw, replay};
use rasterscope::rules::Rules;
use rasterscope::scene::{self, DialectChoice, Paint as ScenePaint, PrimitiveKind, ReadOptions, Scene};
use rasterscope::texture::{Anisotropy, LevelSampling, PixelSampling};
use rasterscope::viewer::gallery::{SCENES, Textures};
use rayon::prelude::*;

use crate::support::explaining::advised;

/// What pictures are drawn with.
fn settings() -> [RenderSettings; 10] {
    let rate = |samples| SampleRate::new(samples).unwrap();
    let plain = RenderSettings::default();
    [
        plain,
        RenderSettings {
            sample_rate: rate(4),
            pixel_sampling: PixelSampling::Bilinear,
            level_sampling: LevelSampling::Linear,
            ..plain
        },
        RenderSettings {
            sample_rate: rate(16),
            pixel_sampling: PixelSampling::Bilinear,
            level_sampling: LevelSampling::Nearest,
            anisotropy: Anisotropy::new(8).unwrap(),
            outline: false,
            ..plain
        },
        RenderSettings {
            sample_rate: rate(4),
            pixel_sampling: PixelSampling::Bilinear,
            level_sampling: LevelSampling::Linear,
            rules: Rules::Course,
            ..plain
        },
        RenderSettings {
            sample_rate: rate(9),
            level_sampling: LevelSampling::Linear,
            background: rasterscope::color::Rgba::TRANSPARENT,
            ..plain
        },
        RenderSettings {
            sample_rate: rate(4),
            pattern: SamplePattern::Jittered,
            level_sampling: LevelSampling::Linear,
            ..plain
        },
        RenderSettings {
            sample_rate: rate(4),
            resolve: ResolveSpace::Linear,
            background: rasterscope::color::Rgba::TRANSPARENT,
            ..plain
        },
        RenderSettings {
            sample_rate: rate(5),
            pattern: SamplePattern::Halton,
            pixel_sampling: PixelSampling::Bilinear,
            rules: Rules::Course,
            ..plain
        },
        RenderSettings {
            rules: Rules::Float,
            ..plain
        },
        RenderSettings {
            sample_rate: rate(5),
            pattern: SamplePattern::R2,
            level_sampling: LevelSampling::Linear,
            rules: Rules::Float,
            ..plain
        },
    ]
}

/// Those in which textures are averaged over areas.
fn averaged_over_areas() -> [RenderSettings; 3] {
    let plain = RenderSettings::default();
    [
        RenderSettings {
            sample_rate: SampleRate::new(4).unwrap(),
            level_sampling: LevelSampling::Ewa,
            ..plain
        },
        RenderSettings {
            level_sampling: LevelSampling::SummedArea,
            ..plain
        },
        RenderSettings {
            sample_rate: SampleRate::new(4).unwrap(),
            pixel_sampling: PixelSampling::Bilinear,
            level_sampling: LevelSampling::Ripmap,
            ..plain
        },
    ]
}

/// Those in which primitives are shaded once in a pixel.
fn shaded_once() -> [RenderSettings; 2] {
    let rate = |samples| SampleRate::new(samples).unwrap();
    let plain = RenderSettings::default();
    [
        RenderSettings {
            sample_rate: rate(16),
            shading: ShadingRate::Centre,
            pixel_sampling: PixelSampling::Bilinear,
            ..plain
        },
        RenderSettings {
            sample_rate: rate(9),
            pattern: SamplePattern::Jittered,
            shading: ShadingRate::Centroid,
            resolve: ResolveSpace::Linear,
            ..plain
        },
    ]
}

/// Those in which a pixel takes samples of its neighbours.
fn wide_settings() -> [RenderSettings; 3] {
    let four = SampleRate::new(4).unwrap();
    let plain = RenderSettings::default();
    [
        RenderSettings {
            sample_rate: four,
            resolve_filter: ResolveFilter::Mitchell,
            ..plain
        },
        RenderSettings {
            sample_rate: four,
            resolve_filter: ResolveFilter::Lanczos3,
            resolve: ResolveSpace::Linear,
            background: rasterscope::color::Rgba::TRANSPARENT,
            ..plain
        },
        RenderSettings {
            pattern: SamplePattern::Jittered,
            resolve_filter: ResolveFilter::CatmullRom,
            filter_radius: FilterRadius::new(1.25),
            rules: Rules::Course,
            ..plain
        },
    ]
}

fn read(name: &str, document: &str) -> Scene {
    let options = ReadOptions {
        dialect: DialectChoice::Auto,
    };
    scene::read(document.as_bytes(), name, options, &Textures).unwrap()
}

/// Explains every pixel of a small picture and hands each explanation to `check`, with the frame's pixel.
fn every_pixel(scene: &Scene, settings: &RenderSettings, size: [u32; 2], check: impl Fn(&Explanation, u32) + Sync) {
    let view = SceneView::Default.transform(scene.canvas, size);
    let mut frame = Framebuffer::new(size[0], size[1]);
    draw(scene, &view, settings, &mut frame);
    let subject = Subject {
        scene,
        view: &view,
        settings,
    };
    (0..size[0] * size[1]).into_par_iter().for_each(|i| {
        let question = Question {
            subject,
            file: "scene.svg",
            size,
            pixel: [i % size[0], i / size[0]],
        };
        let explanation = Explanation::new(&question).unwrap();
        check(&explanation, frame.pixels()[i as usize]);
    });
}

#[test]
fn every_explanation_of_every_scene_ends_in_the_frames_bytes() {
    for scene in SCENES {
        let read = read(scene.name, scene.document);
        for settings in settings()
            .into_iter()
            .chain(shaded_once())
            .chain(wide_settings())
            .chain(averaged_over_areas())
        {
            every_pixel(&read, &settings, [13, 10], |found, pixel| {
                let [a, r, g, b] = pixel.to_be_bytes();
                let at = (scene.name, &settings, found.pixel);
                assert_eq!(found.color, [r, g, b, a], "{at:?}");
                check_resolve(found, settings.rules);
                check_samples(found);
                check_accumulation(found);
                for paint in &found.paints {
                    check_coverage(paint, found, settings.rules);
                    check_colors(paint, settings.rules);
                }
            });
        }
    }
}

#[test]
fn explanations_of_smoothed_pixels_end_in_the_frames_bytes() {
    let settings = RenderSettings {
        post_process: PostProcess::Smaa,
        ..RenderSettings::default()
    };
    let mut smoothed = 0;
    for scene in SCENES.iter().filter(|scene| scene.name.starts_with("study/2")) {
        let read = read(scene.name, scene.document);
        let blended = AtomicUsize::new(0);
        every_pixel(&read, &settings, [40, 13], |found, pixel| {
            let [a, r, g, b] = pixel.to_be_bytes();
            assert_eq!(found.color, [r, g, b, a], "{} {:?}", scene.name, found.pixel);
            check_resolve(found, settings.rules);
            let smoothing = found.smoothing.as_ref().expect("SMAA was asked for");
            blended.fetch_add(usize::from(!smoothing.blended.is_empty()), Ordering::Relaxed);
        });
        smoothed += blended.into_inner();
    }
    assert!(smoothed > 100, "only {smoothed} pixels were smoothed");
}

/// Sums, mean and rounding lead to the colour.
fn check_resolve(found: &Explanation, rules: Rules) {
    let resolve = &found.resolve;
    let linear = resolve.space == "linear";
    if let Some(around) = &resolve.around {
        return check_around(found, around, rules);
    }
    let total: [f64; 4] = found.samples.iter().fold([0.0; 4], |sum, sample| {
        let averaged = if linear { light(sample.color) } else { sample.color };
        std::array::from_fn(|i| sum[i] + averaged[i])
    });
    for (sum, total) in resolve.sums.iter().zip(total) {
        // Up to a quarter of a level per sample where shaded samples are rounded last.
        let tolerance = match () {
            () if resolve.summed_exactly => 0.26 * resolve.samples as f64,
            // The straight value of what is translucent is rounded to 1/256.
            () if linear => 0.02 * resolve.samples as f64,
            () => 1e-9,
        };
        assert!(
            (sum - total).abs() <= tolerance,
            "{sum} is the sum of samples, not {total}: {found:?}"
        );
    }
    if !resolve.summed_exactly {
        assert_eq!(
            found.mean_of_first(resolve.samples),
            found.resolved(),
            "sample by sample: {found:?}"
        );
    }
    if linear {
        let lines = found.resolve_lines();
        let red = lines.iter().find(|line| line.starts_with("red")).unwrap();
        assert!(
            red.contains(" light ") && red.ends_with(&format!(" to {}", found.resolved()[0])),
            "{red}"
        );
    }
    let alpha = resolve.mean[3];
    for (i, byte) in found.resolved().iter().enumerate() {
        let exact = match i {
            3 => alpha,
            _ if alpha > 0.0 && linear => stored(resolve.mean[i] / alpha) * 255.0,
            _ if alpha > 0.0 => resolve.mean[i] * 255.0 / alpha,
            _ => 0.0,
        };
        // What a sample's straight value was rounded by counts most in the dark.
        let slack = match () {
            () if linear && alpha < 255.0 => 0.3,
            () if linear => 1e-3,
            () => 1e-9,
        };
        let byte = f64::from(*byte);
        let right = match rules {
            Rules::Standard | Rules::Float => (byte - exact).abs() <= 0.5 + slack,
            Rules::Course => byte <= exact + slack && exact < byte + 1.0 + slack,
        };
        assert!(right, "{exact} is rounded to {byte}: {found:?}");
    }
}

/// What is taken of each pixel adds up to the mean, which is clamped and rounded to the colour.
fn check_around(found: &Explanation, around: &Around, rules: Rules) {
    let linear = found.resolve.space == "linear";
    let weights: f64 = around.pixels.iter().flat_map(|pixel| &pixel.weights).sum();
    assert!((weights - 1.0).abs() < 1e-9, "all weigh one together: {around:?}");
    let mut sums = [0.0; 4];
    for pixel in &around.pixels {
        assert_eq!(pixel.weights.len(), found.samples.len(), "a weight for each sample");
        let mut adds = [0.0; 4];
        for (weight, color) in pixel.weights.iter().zip(&pixel.colors) {
            let averaged = if linear { light(*color) } else { *color };
            adds = std::array::from_fn(|i| adds[i] + averaged[i] * weight);
        }
        for (adds, told) in adds.iter().zip(pixel.adds) {
            assert!(
                (adds - told).abs() < if linear { 0.02 } else { 1e-9 },
                "{adds} and not {told}: {pixel:?}"
            );
        }
        sums = std::array::from_fn(|i| sums[i] + pixel.adds[i]);
    }
    for (sum, mean) in sums.iter().zip(found.resolve.mean) {
        assert!((sum - mean).abs() < 1e-6, "{sum} and not {mean}: {around:?}");
    }
    let own = around.pixels.iter().find(|pixel| pixel.beside == [0, 0]);
    assert!(
        own.is_none_or(|own| own
            .colors
            .iter()
            .zip(&found.samples)
            .all(|(own, sample)| *own == sample.color)),
        "its own samples: {around:?}"
    );
    let alpha = sums[3].clamp(0.0, 255.0);
    for (i, byte) in found.resolved().iter().enumerate() {
        let clamped = sums[i].clamp(0.0, if i < 3 { alpha } else { 255.0 });
        let exact = match i {
            3 => alpha,
            _ if alpha <= 0.0 => 0.0,
            _ if linear => stored(clamped / alpha) * 255.0,
            _ => clamped * 255.0 / alpha,
        };
        let slack = match () {
            () if linear && alpha < 255.0 => 0.3,
            () if linear => 1e-3,
            () => 1e-6,
        };
        let byte = f64::from(*byte);
        let right = match rules {
            Rules::Standard | Rules::Float => (byte - exact).abs() <= 0.5 + slack,
            Rules::Course => byte <= exact + slack && exact < byte + 1.0 + slack,
        };
        assert!(right, "{exact} is rounded to {byte}: {found:?}");
    }
    let lines = found.resolve_lines();
    assert!(lines[0].contains(around.filter), "the filter is named: {lines:?}");
    let red = lines.iter().find(|line| line.starts_with("red")).expect("red is told");
    let byte = format!(" {}", found.resolved()[0]);
    assert!(
        red.contains(" neighbours ") && red.ends_with(&byte),
        "{red} and not {byte}"
    );
}

/// The light of a premultiplied colour, weighted by its alpha, by IEC 61966-2-1.
fn light([r, g, b, alpha]: [f64; 4]) -> [f64; 4] {
    let of = |channel: f64| {
        let stored = if alpha > 0.0 { (channel / alpha).min(1.0) } else { 0.0 };
        alpha
            * if stored <= 0.040_45 {
                stored / 12.92
            } else {
                ((stored + 0.055) / 1.055).powf(2.4)
            }
    };
    [of(r), of(g), of(b), alpha]
}

/// The inverse of the curve.
fn stored(light: f64) -> f64 {
    if light <= 0.003_130_8 {
        light * 12.92
    } else {
        1.055 * light.powf(1.0 / 2.4) - 0.055
    }
}

/// All samples together are the pixel, one alone is that sample, and the covered part ends with what is covered.
fn check_accumulation(found: &Explanation) {
    // Its own samples are a part of the pixel only.
    if found.resolve.around.is_some() {
        return;
    }
    let all = found.mean_of_first(found.samples.len());
    for (all, color) in all.iter().zip(found.resolved()) {
        // What is off by a quarter of a level counts more where little is opaque.
        let rounding = match found.resolved()[3] {
            _ if !found.resolve.summed_exactly => 0,
            alpha => 1 + 80 / alpha.max(1),
        };
        assert!(all.abs_diff(color) <= rounding, "all samples are the pixel: {found:?}");
    }
    assert_eq!(
        found.mean_of_first(1),
        found.samples[0].bytes,
        "the first sample: {found:?}"
    );
    if let Some(convergence) = found.convergence() {
        assert_eq!(convergence.parts.len(), found.samples.len(), "a part per sample");
        assert!((0.0..=1.0).contains(&convergence.area), "a part of the pixel");
        let covered = |paint: &Paint| {
            paint.name() == convergence.name && {
                let part = paint.fragments.len() as f64 / found.samples.len() as f64;
                convergence.parts.last().is_some_and(|last| (last - part).abs() < 1e-9)
            }
        };
        assert!(
            found.paints.iter().any(covered),
            "in the end what is covered: {convergence:?}"
        );
    }
}

/// For each paint whether it is part of a clip path or mask.
fn parts_of_masks(found: &Explanation) -> Vec<bool> {
    let mut parts = vec![false; found.paints.len()];
    for (end, paint) in found.paints.iter().enumerate() {
        if matches!(paint.shape, Shape::EndClip | Shape::EndMask { .. }) {
            let begins = |i: &usize| {
                let begin = &found.paints[*i];
                matches!(begin.shape, Shape::BeginLayer) && begin.layers + 1 == paint.layers
            };
            let begin = (0..end).rev().find(begins).expect("it began");
            parts[begin..=end].fill(true);
        }
    }
    parts
}

/// Stacks and fragments tell the same story, and it ends with the sample's colour.
fn check_samples(found: &Explanation) {
    let parts_of_masks = parts_of_masks(found);
    for (number, sample) in found.samples.iter().enumerate() {
        let touched: Vec<(usize, &Fragment)> = found
            .paints
            .iter()
            .enumerate()
            .flat_map(|(i, paint)| paint.fragments.iter().map(move |fragment| (i, fragment)))
            .filter(|(_, fragment)| fragment.sample == number)
            .collect();
        let stack: Vec<usize> = touched.iter().map(|(i, _)| *i).collect();
        let listed = |paint: &&usize| !parts_of_masks[**paint];
        let on_samples: Vec<usize> = stack.iter().filter(listed).copied().collect();
        assert_eq!(sample.stack, on_samples, "in painter's order");
        let on_base = touched.iter().rev().find(|(i, _)| match found.paints[*i].shape {
            Shape::EndLayer { .. } | Shape::EndClip | Shape::EndMask { .. } => found.paints[*i].layers == 1,
            _ => found.paints[*i].layers == 0,
        });
        if let Some((_, last)) = on_base {
            assert_eq!(last.after, sample.color, "what the last fragment left: {found:?}");
        }
        if let Some(seen) = sample.seen {
            assert!(stack.contains(&seen), "what is seen touched it");
        }
        for pair in touched.windows(2) {
            let same_layer = found.paints[pair[0].0].layers == found.paints[pair[1].0].layers;
            let marks = |i: usize| found.paints[i].shape.is_layer_mark();
            if same_layer && !marks(pair[0].0) && !marks(pair[1].0) && found.paints[pair[0].0].layers == 0 {
                assert_eq!(pair[0].1.after, pair[1].1.before, "one after the other: {found:?}");
            }
        }
    }
}

/// Edges and windings say what the painter painted.
fn check_coverage(paint: &Paint, found: &Explanation, rules: Rules) {
    let samples = found.samples.len();
    let painted = |number: usize| paint.fragments.iter().any(|fragment| fragment.sample == number);
    match &paint.shape {
        Shape::Triangle { .. } | Shape::Polygon { .. } => assert_eq!(paint.views.len(), samples, "{paint:?}"),
        Shape::WholePixel | Shape::CanvasOutline => assert_eq!(paint.fragments.len(), samples, "{paint:?}"),
        Shape::BeginLayer | Shape::EndLayer { .. } | Shape::EndClip | Shape::EndMask { .. } => {}
    }
    for (number, view) in paint.views.iter().enumerate() {
        let inside = match (view, &paint.shape) {
            (View::Triangle { edges, weights, .. }, _) => {
                assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-6, "{weights:?}");
                if let Some(place) = paint.shaded_at {
                    check_weights(
                        paint,
                        *weights,
                        [0, 1].map(|axis| f64::from(found.pixel[axis]) + place[axis]),
                    );
                }
                for (edge, weight) in edges.iter().zip([weights[2], weights[0], weights[1]]) {
                    assert_eq!(edge.value > 0, edge.distance > 0.0, "{edge:?}");
                    assert!(
                        rules == Rules::Course
                            || edge.value == 0
                            || weight.abs() < 1e-6
                            || paint_is_clipped(paint)
                            || paint.shaded_at.is_some()
                            || (edge.value > 0) == (weight > 0.0),
                        "{edge:?} {weight}"
                    );
                }
                edges.iter().all(|edge| edge.verdict.is_inside())
            }
            (View::Polygon { winding, .. }, Shape::Polygon { rule, .. }) if *rule == "evenodd" => winding % 2 != 0,
            (View::Polygon { winding, .. }, _) => *winding != 0,
        };
        assert_eq!(painted(number), inside, "sample {number} of {paint:?}");
    }
}

/// Weights are those of a place of the frame.
fn check_weights(paint: &Paint, weights: [f64; 3], place: [f64; 2]) {
    let Shape::Triangle { corners } = &paint.shape else {
        return;
    };
    for (axis, place) in place.into_iter().enumerate() {
        let found: f64 = corners
            .iter()
            .zip(weights)
            .map(|(corner, weight)| corner[axis] * weight)
            .sum();
        assert!(
            (found - place).abs() < 1e-3 || paint_is_clipped(paint),
            "{weights:?} are those of {found}, not of {place}: {paint:?}"
        );
    }
}

/// Whether the corners lie where only clipping puts them.
fn paint_is_clipped(paint: &Paint) -> bool {
    let Shape::Triangle { corners } = &paint.shape else {
        return false;
    };
    corners.iter().flatten().any(|at| at.abs() > 20_000.0)
}

/// Interpolated colours and texels are the fragments' colours.
fn check_colors(paint: &Paint, rules: Rules) {
    for fragment in &paint.fragments {
        let Some(View::Triangle { value, .. } | View::Polygon { value, .. }) = paint.views.get(fragment.sample) else {
            continue;
        };
        let expected = match value {
            Interpolated::Flat | Interpolated::OffRamp | Interpolated::Pattern { .. } => continue,
            Interpolated::Color { rgba } => {
                let alpha = rgba[3].clamp(0.0, 1.0);
                let channel = |i: usize| rgba[i].clamp(0.0, 1.0) * alpha * 255.0;
                [channel(0), channel(1), channel(2), alpha * 255.0]
            }
            Interpolated::Gradient {
                at,
                stops,
                weight,
                rgba,
                ..
            } => {
                let [from, to] = stops.map(|stop| f64::from(stop.offset));
                let place = from + (to - from) * weight;
                // Before the first stop and beyond the last one nothing is mixed.
                assert!(stops[0] == stops[1] || (place - at).abs() < 1e-9, "{value:?}");
                let [r, g, b, alpha] = rgba.map(f64::from);
                [r, g, b, 1.0].map(|channel| channel * alpha * 255.0)
            }
            Interpolated::Texture {
                texels, taps, summed, ..
            } => {
                let texture = paint.texture.as_ref().unwrap();
                let weights: f64 = texels.iter().map(|texel| texel.weight).sum();
                let is_listed = !texels.is_empty() || summed.is_none();
                assert!((weights - 1.0).abs() < 1e-5 || !is_listed, "weights sum to {weights}");
                assert_eq!(taps.len() % texture.taps as usize, 0, "taps per level");
                for texel in texels {
                    assert!(
                        texture.levels.iter().any(|level| level.number == texel.level),
                        "{texture:?}"
                    );
                }
                std::array::from_fn(|i| {
                    if let Some(summed) = summed.as_ref().filter(|summed| !summed.light) {
                        return summed.sum[i] / summed.area * texture.opacity;
                    }
                    let read = texels.iter().map(|texel| f64::from(texel.color[i]) * texel.weight);
                    read.sum::<f64>() * texture.opacity
                })
            }
        };
        for (found, expected) in fragment.color.iter().zip(expected) {
            let right = match rules {
                Rules::Standard | Rules::Float => (found - expected).abs() < 0.01,
                Rules::Course => *found < expected + 0.01 && expected < found + 1.01,
            };
            assert!(
                right,
                "{expected} became {found}: {fragment:?} {value:?} {:?}",
                paint.texture
            );
        }
    }
}

#[test]
fn what_is_thin_is_told_where_a_sample_meets_it_too() {
    let told = |points: &str| {
        let document = format!(r##"<svg width="8" height="8"><polygon points="{points}" fill="#FF0000"/></svg>"##);
        let found = advised(&read("thin.svg", &document), &RenderSettings::default(), [8, 8], [1, 2]);
        assert!(found.missed.is_empty(), "it meets the centre");
        found.hints().concat()
    };
    let thin = told("1.4,0 1.6,0 1.5,8");
    let words = "px wide, less than samples are apart (1 px): it breaks up where it passes between them";
    assert!(thin.contains(words), "{thin}");
    let wide = told("1.2,0 8,0 8,8 1.2,8");
    assert!(!wide.contains("wide here"), "a wide one: {wide}");
    assert!(wide.contains("samples (key ="), "though more samples help: {wide}");
}

#[test]
fn hints_name_a_cure_and_vanish_with_it() {
    let document = r##"<svg width="8" height="8"><polygon points="1.1,0 1.3,0 1.2,8" fill="#FF0000"/></svg>"##;
    let thin = read("thin.svg", document);
    let at = |samples| RenderSettings {
        sample_rate: SampleRate::new(samples).unwrap(),
        ..RenderSettings::default()
    };
    let missed = advised(&thin, &at(1), [8, 8], [1, 2]);
    assert_eq!(missed.missed.len(), 1, "it passes beside the centre");
    assert!(
        (missed.missed[0].area - 0.1375).abs() < 1e-5,
        "a trapezium: {:?}",
        missed.missed
    );
    assert!(missed.hints().concat().contains("breaks up"), "{:?}", missed.hints());
    let found = advised(&thin, &at(64), [8, 8], [1, 2]);
    assert!(
        found.missed.is_empty() && !found.hints().concat().contains("breaks up"),
        "more samples find it: {:?}",
        found.hints()
    );
    assert!(
        missed
            .text(rasterscope::inspect::Detail::Telling)
            .contains("What would help"),
        "it is told"
    );

    let floor = SCENES
        .iter()
        .find(|scene| scene.name == "study/07_checker_floor.svg")
        .unwrap();
    let floor = read(floor.name, floor.document);
    let hints = |level_sampling, taps, pixel| {
        let settings = RenderSettings {
            pixel_sampling: PixelSampling::Bilinear,
            level_sampling,
            anisotropy: Anisotropy::new(taps).unwrap(),
            ..RenderSettings::default()
        };
        advised(&floor, &settings, [1000, 640], pixel).hints().concat()
    };
    // Nearer to the horizon averages blur so much that a single sample is as good.
    let shimmering = hints(LevelSampling::Zero, 1, [400, 330]);
    assert!(shimmering.contains("(key L steps to it in the window)"), "{shimmering}");
    let blurred = hints(LevelSampling::Linear, 1, [400, 310]);
    assert!(blurred.contains("(key T steps to it in the window)"), "{blurred}");
    let cured = hints(LevelSampling::Linear, 16, [400, 310]);
    let levels = LevelSampling::ALL.into_iter().filter(|level| !level.weighs_area());
    for level in levels {
        let told = format!("Level sampling {} ", level.name());
        assert!(!cured.contains(&told), "an area at most: {cured}");
    }
    assert!(!cured.contains("(key T steps to it in the window)"), "{cured}");
}

#[test]
fn explanations_know_what_lies_far_away() {
    // The translucent triangle on the left decides how the textures on the right are blended.
    let document = r#"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="60">
        <texture texid="map" filename="../../assets/textures/map.png"/>
        <textri texid="map" uvs="0 0 1 0 0 1" points="0,0 8,0 0,60"/>
        <textri texid="map" uvs="0 0 1 0 1 1" points="20,0 100,0 100,60"/>
        <textri texid="map" uvs="0 0 1 1 0 1" points="20,0 100,60 20,60"/></svg>"#;
    let mut scene = read("far.svg", document);
    if let PrimitiveKind::Triangle {
        paint: ScenePaint::Texture { opacity, .. },
        ..
    } = &mut scene.primitives[0].kind
    {
        *opacity = 0.5;
    }
    let [_, trilinear, ..] = settings();
    let size = [300, 200];
    let view = SceneView::Canvas.transform(scene.canvas, size);
    let mut frame = Framebuffer::new(size[0], size[1]);
    draw(&scene, &view, &trilinear, &mut frame);
    let subject = Subject {
        scene: &scene,
        view: &view,
        settings: &trilinear,
    };
    (0..size[0] * size[1]).into_par_iter().for_each(|i| {
        let pixel = [i % size[0], i / size[0]];
        let found = replay(&subject, size, pixel).unwrap().pixel;
        assert_eq!(found, frame.pixels()[i as usize], "{pixel:?}");
    });
}

#[test]
fn deep_stacks_of_one_line_stay_small() {
    let body: Vec<String> = (0..20_000)
        .map(|i| {
            format!(
                "<rect x='{}' width='9' height='9' fill='#0{}{}040' fill-opacity='.5'/>",
                i % 3,
                i % 10,
                i % 7
            )
        })
        .collect();
    let body = body.concat();
    let document = format!("<svg width='8' height='8'>{body}<rect width='9' height='9' fill='none'/></svg>");
    let scene = read("one-line.svg", &document);
    let settings = RenderSettings {
        sample_rate: SampleRate::new(4).unwrap(),
        ..RenderSettings::default()
    };
    let found = advised(&scene, &settings, [8, 8], [4, 4]);
    assert_eq!(found.paints.len() + found.unlisted, 20_000, "all are counted");
    assert!(found.paints.len() <= 400, "{} are listed", found.paints.len());
    for sample in &found.samples {
        assert_eq!(sample.stack.len() + sample.unlisted, 20_000, "at each sample too");
    }
    let last = found.paints.last().unwrap();
    assert_eq!(last.primitive, 19_999, "the uppermost");
    for paint in &found.paints {
        let source = paint.source.as_ref().unwrap();
        let text = source.text.as_deref().unwrap();
        assert!(text.chars().count() <= 206 && text.starts_with("..."), "{text}");
        let start = document.char_indices().nth(source.column as usize - 1).unwrap().0;
        let tag: String = document[start..].chars().take(60).collect();
        assert!(text.contains(&tag), "around {tag}: {text}");
    }
    let json = serde_json::to_string(&found).unwrap();
    assert!(json.len() < 2_000_000, "{} bytes", json.len());
    let text = found.text(rasterscope::inspect::Detail::Telling);
    assert!(
        text.contains(&format!("{} more paint this pixel below", found.unlisted)),
        "summed up"
    );
    assert!(text.len() < 1_000_000, "{} bytes", text.len());
}

#[test]
fn deep_stacks_keep_what_is_seen_at_the_bottom() {
    let covers = "<rect width='4' height='8' fill='#102030' fill-opacity='.5'/>".repeat(2000);
    let document = format!(
        "<svg width='8' height='8'><g opacity='.5'><rect width='8' height='8' fill='#ff0000'/>\
         <rect x='7' width='1' height='1'/></g>{covers}</svg>"
    );
    let options = ReadOptions {
        dialect: DialectChoice::Svg,
    };
    let scene = scene::read(document.as_bytes(), "bottom.svg", options, &Textures).unwrap();
    let settings = RenderSettings {
        sample_rate: SampleRate::new(4).unwrap(),
        outline: false,
        ..RenderSettings::default()
    };
    // Left and right half of the pixel differ.
    let found = advised(&scene, &settings, [1, 1], [0, 0]);
    let right = found.samples.last().unwrap();
    let seen = right.seen.unwrap();
    assert_eq!(
        found.paints[seen].source.as_ref().unwrap().element,
        "rect",
        "the red one, in its layer"
    );
    assert_eq!(found.paints[seen].layers, 1, "which is listed with it");
    assert!(found.unlisted > 1000, "{}", found.unlisted);
}
