//! What is said about gradients, patterns, clip paths, masks and blend modes.

use rasterscope::geometry::View;
use rasterscope::inspect::{Explanation, Interpolated, Shape, View as Seen};
use rasterscope::raster::{Framebuffer, SamplePattern};
use rasterscope::render::{RenderSettings, Subject, draw, replay};
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
    let Some(Seen::Polygon { value, .. }) = found.paints[0].views.first() else {
        panic!("a polygon: {:?}", found.paints[0]);
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
    // Outside of it nothing of the group is left, and that is said too.
    let (outside, text) = told([5, 26], &at_rate(4));
    assert_eq!(outside.color, [255; 4]);
    assert!(text.contains("it takes away all samples"), "{text}");
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
