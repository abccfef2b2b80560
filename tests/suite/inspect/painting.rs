//! What is said about gradients, patterns, clip paths, masks and blend modes.

use rasterscope::color::Rgba;
use rasterscope::geometry::View;
use rasterscope::inspect::{Explanation, Interpolated, Shape, View as Seen};
use rasterscope::raster::{Framebuffer, PixelCoverage, SamplePattern};
use rasterscope::render::{Explainer, RenderSettings, Subject, draw, replay};
use rasterscope::scene::{DialectChoice, Scene};

use crate::support::documents::read;
use crate::support::explaining::advised;
use crate::support::scenes::at_rate;

/// Every way to paint, on a canvas of 40 by 30 units; what is tested below names its places.
const DOCUMENT: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 30" width="40" height="30">
<linearGradient id="sky" x1="0" y1="0" x2="1" y2="0">
<stop offset="0" stop-color="#000"/><stop offset=".5" stop-color="#f00"/><stop offset="1" stop-color="#fff" stop-opacity=".5"/>
</linearGradient>
<radialGradient id="sun"><stop offset="0" stop-color="#ff0"/><stop offset="1" stop-color="#00f"/></radialGradient>
<pattern id="dots" width="3" height="3" patternUnits="userSpaceOnUse"><rect width="2" height="2" fill="#080"/></pattern>
<clipPath id="round"><circle cx="10" cy="20" r="6"/></clipPath>
<mask id="grey" maskUnits="userSpaceOnUse" x="20" y="12" width="10" height="16"><rect x="20" y="12" width="10" height="16" fill="#808080"/></mask>
<rect width="20" height="10" fill="url(#sky)"/>
<circle cx="30" cy="5" r="5" fill="url(#sun)"/>
<g clip-path="url(#round)"><rect x="2" y="12" width="16" height="16" fill="url(#dots)"/><rect x="2" y="20" width="16" height="8" fill="#00f"/></g>
<rect x="20" y="12" width="10" height="16" fill="#f00" mask="url(#grey)"/>
<rect x="31" y="12" width="8" height="16" fill="#fc0"/>
<rect x="33" y="14" width="8" height="10" fill="#0cf" style="mix-blend-mode:multiply"/>
<path d="M2 11C12 5 28 17 38 11" fill="none" stroke="#000" stroke-width=".7" stroke-dasharray="2 1"/>
</svg>"##;

const SIZE: [u32; 2] = [80, 60];

fn scene() -> Scene {
    let scene = read(DOCUMENT, DialectChoice::Svg);
    assert_eq!(scene.report.skipped.len(), 0, "all is drawn: {:?}", scene.report);
    scene
}

/// All lines about a pixel of the document, at a scale of two pixels for each unit.
fn told(pixel: [u32; 2], settings: &RenderSettings) -> (Explanation, String) {
    let found = advised(&scene(), settings, SIZE, pixel);
    let text = found.to_string();
    (found, text)
}

#[test]
fn gradients_tell_their_place_and_the_stops_around_it() {
    let (found, text) = told([10, 5], &at_rate(1));
    let first = found.paints.iter().find_map(|paint| paint.views.first());
    let Some(Seen::Polygon { value, .. }) = first else {
        panic!("a polygon: {first:?}");
    };
    let Interpolated::Gradient { t, stops, weight, .. } = value else {
        panic!("a gradient: {value:?}");
    };
    // The pixel's middle is 5.25 units of 20 to the right.
    assert!((t - 0.2625).abs() < 1e-6, "{t}");
    assert_eq!([stops[0].number, stops[1].number], [0, 1]);
    assert!((weight - 0.525).abs() < 1e-6, "{weight}");
    assert_eq!(found.color, [134, 0, 0, 255], "0.525 of red");
    for line in [
        "t         0.26250",
        "ramp      47.5 % of stop 1 (#000000 at 0), 52.5 % of stop 2 (#FF0000 at 0.5)",
    ] {
        assert!(text.contains(line), "{line} in {text}");
    }
    assert!(
        text.contains("filled by linearGradient \"sky\", line 2: 3 stops, spread pad"),
        "{text}"
    );
}

#[test]
fn clips_tell_which_path_took_samples_away() {
    // On the border of the circle, below on the right.
    let (found, text) = told([28, 48], &at_rate(16));
    let clip = found
        .paints
        .iter()
        .find(|paint| paint.shape == Shape::EndClip)
        .expect("a clip");
    let kept = clip.fragments.iter().filter(|fragment| fragment.color[3] > 0.0).count();
    assert!(0 < kept && kept < 16, "some are inside: {kept}");
    assert!(text.contains("clip of clipPath \"round\", line 7"), "{text}");
    assert!(text.contains(&format!("{kept} of 16 samples stay")), "{text}");
    let shown = found.samples.iter().filter(|sample| sample.seen.is_some()).count();
    assert_eq!(shown, kept, "the others show the background");
    assert!(!text.contains("circle\" paints"), "what clips is not painted: {text}");
    // Areas have no samples to count.
    let areas = RenderSettings {
        coverage: PixelCoverage::Exact,
        ..at_rate(1)
    };
    let (_, text) = told([28, 48], &areas);
    let told_area = text.contains("stays where the clip path covers it:") && text.contains("% of it");
    assert!(told_area && !text.contains("samples stay"), "{text}");
    // Outside of it nothing of the group is left, and that is said too.
    let (outside, text) = told([5, 26], &at_rate(4));
    assert_eq!(outside.color, [255; 4]);
    assert!(text.contains("it takes away all samples"), "{text}");
    assert!(
        text.contains("paints 4 of 4 samples: 1-4; all are taken away again"),
        "{text}"
    );
    assert!(text.contains("and is taken away by"), "{text}");
    assert!(!text.contains("hidden"), "nothing lies over it: {text}");
}

/// A mark on a line, a gradient in a mask, a mask whose region is the canvas, and a symbol.
const PARTS: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 30" width="40" height="30">
<marker id="arrow" markerUnits="userSpaceOnUse" markerWidth="6" markerHeight="6"><rect width="6" height="6" fill="#f00"/></marker>
<linearGradient id="fade"><stop stop-color="#fff"/><stop offset="1" stop-color="#000"/></linearGradient>
<mask id="half" maskUnits="userSpaceOnUse" x="0" y="0" width="40" height="30"><rect y="10" width="20" height="10" fill="url(#fade)"/></mask>
<symbol id="box" viewBox="0 0 10 10"><rect width="10" height="10" fill="#00f"/></symbol>
<path d="M2 4H20" stroke="#000" marker-end="url(#arrow)"/>
<rect y="10" width="20" height="10" fill="#080" mask="url(#half)"/>
<use href="#box" x="30" y="20" width="10" height="10"/>
</svg>"##;

#[test]
fn parts_name_what_they_are() {
    let scene = read(PARTS, DialectChoice::Svg);
    let told = |pixel| {
        let text = advised(&scene, &at_rate(4), SIZE, pixel).to_string();
        // However lines are wrapped.
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let mark = told([46, 14]);
    assert!(mark.contains("of marker \"arrow\", line 2"), "{mark}");
    assert!(mark.contains("put here as a mark of the line in line 6"), "{mark}");
    let masked = told([11, 30]);
    assert!(
        masked.contains("filled by linearGradient \"fade\", line 3: 2 stops"),
        "in a mask: {masked}"
    );
    assert!(masked.contains("it takes a part of 4 of 4 samples"), "{masked}");
    assert!(!masked.contains("takes away none"), "{masked}");
    let beside = told([70, 10]);
    assert!(
        beside.contains("Nothing paints this pixel"),
        "no mask of others: {beside}"
    );
    let symbol = told([65, 45]);
    assert!(!symbol.contains("clip path covers it"), "there is none: {symbol}");
}

#[test]
fn curves_cover_what_they_cover_in_truth() {
    let document =
        "<svg xmlns='http://www.w3.org/2000/svg' width='200' height='200'><circle cx='100' cy='100' r='90.3'/></svg>";
    let scene = read(document, DialectChoice::Svg);
    let view = View::Canvas.transform(scene.canvas, [200, 200]);
    let settings = at_rate(4);
    let subject = Subject {
        scene: &scene,
        view: &view,
        settings: &settings,
    };
    for pixel in [[10_u32, 90_u32], [40, 32], [100, 9], [163, 164]] {
        let mut inside = 0_u32;
        for (i, j) in (0..1000).flat_map(|i| (0..1000).map(move |j| (i, j))) {
            let at = |of: u32, part: i32| f64::from(of) + (f64::from(part) + 0.5) / 1000.0 - 100.0;
            inside += u32::from(at(pixel[0], i).hypot(at(pixel[1], j)) < 90.3);
        }
        let found = Explainer::new(subject, [200, 200], pixel).area(0).expect("an area");
        let expected = f64::from(inside) / 1e6;
        assert!((found - expected).abs() < 2e-3, "{found}, not {expected}, at {pixel:?}");
    }
}

#[test]
fn masks_and_blend_modes_tell_their_numbers() {
    let (found, text) = told([50, 40], &at_rate(4));
    assert!(
        text.contains("what is below stays as far as the mask's luminance lets it"),
        "{text}"
    );
    assert!(text.contains("keeps     50.2 % of 255, 0, 0"), "{text}");
    assert_eq!(found.color, [255, 127, 127, 255], "half a red on white");
    let (found, text) = told([70, 35], &at_rate(1));
    assert_eq!(found.color, [0, 163, 0, 255], "#fc0 times #0cf");
    for line in [
        "blended with what is below by multiply",
        "multiply: below * above",
        "mixed     red 0.0000, green 0.6400, blue 0.0000",
    ] {
        assert!(text.contains(line), "{line} in {text}");
    }
}

#[test]
fn patterns_tell_the_texel_of_their_tile() {
    let (found, text) = told([17, 38], &at_rate(1));
    assert!(
        text.contains("filled by pattern \"dots\", line 6: tiles of 3 x 3 units"),
        "{text}"
    );
    let of_pattern = |paint: &&rasterscope::inspect::Paint| paint.pattern.is_some();
    let paint = found.paints.iter().find(of_pattern).expect("a pattern");
    let Some(Seen::Polygon {
        value: Interpolated::Pattern { copy, size, texels },
        ..
    }) = paint.views.first()
    else {
        panic!("a pattern: {paint:?}");
    };
    assert_eq!((*copy, *size), ([2, 6], [6, 6]), "8.75 and 19.25 units by 3");
    assert_eq!(texels[0].at, [5, 2], "2.75 and 1.25 units into the copy");
}

#[test]
fn every_explained_pixel_is_the_frame_s() {
    let scene = scene();
    let view = View::Canvas.transform(scene.canvas, SIZE);
    for (rate, pattern) in [
        (1, SamplePattern::Grid),
        (4, SamplePattern::Grid),
        (16, SamplePattern::Jittered),
    ] {
        let settings = RenderSettings {
            pattern,
            ..at_rate(rate)
        };
        let mut frame = Framebuffer::new(SIZE[0], SIZE[1]);
        draw(&scene, &view, &settings, &mut frame);
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        };
        for (i, expected) in (0..).zip(frame.pixels()) {
            let [x, y] = [i % SIZE[0], i / SIZE[0]];
            let found = replay(&subject, SIZE, [x, y]).expect("inside");
            assert_eq!(found.pixel, *expected, "{x}, {y} at rate {rate} of {pattern:?}");
        }
    }
}

/// All lines about a pixel of a document of 20 by 10 units, each a pixel.
fn told_of(shapes: &str, pixel: [u32; 2], rate: u32) -> String {
    let document = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="20" height="10">{shapes}</svg>"#);
    let settings = RenderSettings {
        background: Rgba::WHITE,
        outline: false,
        ..at_rate(rate)
    };
    let scene = read(&document, DialectChoice::Svg);
    assert_eq!(scene.report.skipped.len(), 0, "all is drawn: {:?}", scene.report);
    // The canvas fills the frame.
    advised(&scene, &settings, [20, 10], pixel).to_string()
}

#[test]
fn sentences_are_true_of_their_pixel() {
    let crisp = r##"<rect x="2" y="2.2" width="9" height=".1" shape-rendering="crispEdges" fill="#f00"/>"##;
    let stroke = r##"<path d="M2 5.06H18" fill="none" stroke="#00f" stroke-width=".1"/>"##;
    let clear = r#"<linearGradient id="c"><stop offset=".6" stop-opacity="0"/><stop offset="1"/></linearGradient><rect width="9" height="9" fill="url(#c)"/>"#;
    let alone = r##"<g style="isolation:isolate"><rect width="9" height="9" fill="#fa0" style="mix-blend-mode:multiply"/></g>"##;
    let half = r##"<rect width="20" height="10" fill="#fff"/><rect width="20" height="5" fill="#f00"/><rect x="0" y="0" width="3.5" height="10" fill="#00f"/>"##;
    let clips = r##"<clipPath id="a"><path d="M0 0H9L0 9"/></clipPath><clipPath id="b"><path d="M0 0H5L0 5"/></clipPath>
<g clip-path="url(#a)"><g clip-path="url(#b)"><rect width="9" height="9" fill="#f00"/></g></g>"##;
    let soft = r##"<rect width="9" height="9" fill="#1a1a1a"/><rect width="9" height="9" fill="#fff" style="mix-blend-mode:soft-light"/>"##;
    let cone = r##"<radialGradient id="r" gradientUnits="userSpaceOnUse" cx="5" cy="5" r="1" fx="9" fy="5"><stop stop-color="#f00"/><stop offset="1"/></radialGradient>
<rect width="20" height="10" fill="url(#r)"/>"##;
    let tiles = r##"<pattern id="p" patternUnits="userSpaceOnUse" width="4" height="4"><rect width="2" height="4" fill="#0a0"/></pattern>
<rect width="20" height="10" fill="url(#p)"/>"##;
    for (shapes, pixel, rate, sentence) in [
        (cone, [18, 5], 1, "no circle of the gradient goes through this sample"),
        (tiles, [5, 5], 1, "of texel (1, 1): #00AA00"),
        (
            crisp,
            [5, 2],
            16,
            "of the pixel, and not its middle, where shape-rendering asks for its one sample",
        ),
        (stroke, [9, 5], 1, "stroke of path at scene.svg:1:"),
        (clear, [4, 4], 4, "paints 4 of 4 samples: 1-4; all are transparent"),
        (
            alone,
            [4, 4],
            4,
            "nothing is below: the layer's colour stays as it is, whatever the mode",
        ),
        (half, [3, 2], 4, "paints 4 of 4 samples: 1-4; hidden on 1, 3"),
        (
            clips,
            [4, 4],
            4,
            "finds nothing on this sample: there is nothing to take",
        ),
        (
            clips,
            [1, 4],
            4,
            "counts for the clip path or mask, and is not seen itself",
        ),
        (
            soft,
            [4, 4],
            4,
            "or ((16 * below - 12) * below + 4) * below where below <= 1/4",
        ),
    ] {
        let text = told_of(shapes, pixel, rate);
        // However lines are wrapped.
        let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(sentence), "{sentence}: {text}");
    }
    assert!(!told_of(clear, [4, 4], 4).contains("hidden"), "nothing lies over it");
}

#[test]
fn more_samples_are_not_advised_where_the_truth_is_no_surer() {
    let edge = r##"<rect width="20" height="5.7" fill="#000"/>"##;
    for (rate, is_advised) in [(16, true), (100, false)] {
        let text = told_of(edge, [4, 5], rate);
        let advised = text.contains(" samples (key = steps to it in the window): ");
        assert_eq!(advised, is_advised, "{rate} samples: {text}");
    }
}

#[test]
fn modes_at_the_root_leave_the_paper_alone() {
    for mode in ["multiply", "screen", "difference", "exclusion", "lighten"] {
        let document = format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" width="20" height="10">
<rect width="9" height="9" fill="#f00" style="mix-blend-mode:{mode}"/><g><rect x="5" width="9" height="9" fill="#00f" style="mix-blend-mode:{mode}"/></g></svg>"##
        );
        let scene = read(&document, DialectChoice::Svg);
        let settings = RenderSettings {
            background: Rgba::WHITE,
            outline: false,
            ..at_rate(4)
        };
        let mut frame = Framebuffer::new(20, 10);
        draw(
            &scene,
            &View::Canvas.transform(scene.canvas, [20, 10]),
            &settings,
            &mut frame,
        );
        // As browsers have it, and resvg.
        let both = if mode == "multiply" { [0; 3] } else { [255, 0, 255] };
        let found = [[2, 4], [7, 4], [12, 4], [18, 4]].map(|[x, y]| frame.rgba(x, y).expect("inside"));
        let expected = [[255, 0, 0], both, [0, 0, 255], [255; 3]].map(|[r, g, b]| [r, g, b, 255]);
        assert_eq!(found, expected, "{mode}");
        let text = advised(&scene, &settings, [20, 10], [2, 4]).to_string();
        assert!(
            text.contains("nothing is below: the layer's colour stays as it is, whatever the mode"),
            "{mode}: {text}"
        );
    }
}
