//! Spectra of scenes whose waves are known.

use super::*;
use crate::geometry::View;
use crate::raster::SampleRate;
use crate::render::RenderSettings;
use crate::scene::{self, DialectChoice, FolderResources, ReadOptions, Scene};

const SIZE: [u32; 2] = [160, 120];

/// A triangle wave of so many periods per unit, from black to white, whose first wave has 8 / pi^2 of its amplitude.
fn stripes(frequency: f64) -> Scene {
    let half = 0.5 / frequency;
    let text = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="160" height="120">
          <linearGradient id="g" gradientUnits="userSpaceOnUse" x1="0" x2="{half}" spreadMethod="reflect">
            <stop offset="0" stop-color="#000"/><stop offset="1" stop-color="#fff"/>
          </linearGradient>
          <rect x="-10" y="-10" width="180" height="140" fill="url(#g)"/>
        </svg>"##
    );
    read(&text)
}

fn read(text: &str) -> Scene {
    let options = ReadOptions {
        dialect: DialectChoice::Svg,
    };
    let resources = FolderResources::beside("stripes.svg".as_ref());
    scene::read(text.as_bytes(), "stripes.svg", options, &resources).expect("a drawing")
}

fn analysis(
    scene: &Scene,
    settings: &RenderSettings,
    of: impl Fn(&Subject<'_>, [u32; 2], Region) -> Option<SpectrumAnalysis>,
) -> SpectrumAnalysis {
    let view = View::Canvas.transform(scene.canvas, SIZE);
    let subject = Subject {
        scene,
        view: &view,
        settings,
    };
    of(&subject, SIZE, Region::of_size(SIZE)).expect("pixels")
}

fn at_rate(samples: u32) -> RenderSettings {
    RenderSettings {
        sample_rate: SampleRate::new(samples).expect("a rate"),
        outline: false,
        ..RenderSettings::default()
    }
}

/// The amplitude of a triangle wave's first wave.
const FIRST: f64 = 127.5 * 8.0 / (std::f64::consts::PI * std::f64::consts::PI);

#[test]
fn scene_has_its_frequency_and_the_frame_its_alias() {
    let scene = stripes(0.7);
    let found = analysis(&scene, &at_rate(1), SpectrumAnalysis::of_scene).peaks(1)[0];
    assert!((found.wave.frequency[0] - 0.7).abs() < 1e-9, "{found:?}");
    assert!(
        (found.wave.amplitude / FIRST - 1.0).abs() < 0.02,
        "{found:?} for {FIRST}"
    );
    let lands = found.lands.expect("outside of the box");
    assert!((lands[0] + 0.3).abs() < 1e-9 && lands[1].abs() < 1e-9, "{lands:?}");
    let frame = analysis(&scene, &at_rate(1), SpectrumAnalysis::of_frame);
    let found = frame.peaks(1)[0];
    assert!((found.wave.frequency[0] - 0.3).abs() < 1e-9, "{found:?}");
    assert!(
        (found.wave.amplitude / FIRST - 1.0).abs() < 0.02,
        "point samples keep it: {found:?}"
    );
    let (source, part) = found.source.expect("a scene beside it");
    assert!(
        (source.frequency[0].abs() - 0.7).abs() < 1e-9 && part > 0.95,
        "{source:?}, {part}"
    );
    assert_eq!(found.lands, None, "it lies in the box");
    let near = frame.strongest_near([0.32, -0.01], 0.025).expect("in the box");
    assert_eq!(near, found, "what is pointed at nearly");
    let far = frame.strongest_near([0.35, 0.0], 0.025);
    assert_ne!(far, Some(found), "but not from afar");
}

#[test]
fn no_wave_is_named_that_comes_back_from_finer_ones() {
    // Of bars of 0.625 cycles per pixel there are 1.875 and 3.125, which a grid of three points per pixel takes for 1.125 and
    // 0.125.
    let bar = |index: u32| format!(r#"<rect x="{}" width=".8" height="64"/>"#, f64::from(index) * 1.6);
    let bars: String = (0..40).map(bar).collect();
    let text = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="64" height="64">{bars}</svg>"#);
    let scene = read(&text);
    let view = View::Canvas.transform(scene.canvas, [64, 64]);
    let settings = at_rate(1);
    let subject = Subject {
        scene: &scene,
        view: &view,
        settings: &settings,
    };
    let region = Region::of_size([64, 64]);
    let own = SpectrumAnalysis::of_scene(&subject, [64, 64], region).expect("pixels");
    let peaks = own.peaks(9);
    assert_eq!(peaks.len(), 1, "no ghosts: {peaks:?}");
    assert!((peaks[0].wave.frequency[0] - 0.625).abs() < 1e-9, "{peaks:?}");
    let frame = SpectrumAnalysis::of_frame(&subject, [64, 64], region).expect("pixels");
    let third = frame.at([0.125, 0.0]).expect("in the box");
    let (source, part) = third.source.expect("a scene beside it");
    assert!(
        (source.frequency[0].abs() - 1.875).abs() < 1e-9 && part > 0.9,
        "{third:?}"
    );
}

/// Waves above -40 dB, at most six, that are listed of bars with so many pixels from one to the next, as periods per bar.
fn waves_of_bars(side: u32, period: f64) -> Vec<f64> {
    let bar = |index: u32| {
        let left = 0.13 + f64::from(index) * period;
        format!(r#"<rect x="{left}" y="-9" width="{}" height="40"/>"#, period / 2.0)
    };
    let bars: String = (0..side).map(bar).collect();
    let text = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="{side}" height="4">{bars}</svg>"#);
    let (scene, settings) = (read(&text), at_rate(1));
    let view = View::Canvas.transform(scene.canvas, [side, 4]);
    let subject = Subject {
        scene: &scene,
        view: &view,
        settings: &settings,
    };
    let region = Region::of_size([side, 4]);
    let found = SpectrumAnalysis::of_scene(&subject, [side, 4], region).expect("pixels");
    let strong = found.peaks(6).into_iter().filter(|peak| peak.wave.decibels() > -40.0);
    strong.map(|peak| peak.wave.frequency[0] * period).collect()
}

#[test]
fn bars_have_odd_waves_only() {
    // A wave between two frequencies that fit is listed at the nearer one.
    for (side, period) in [
        (64, 4.0),
        (71, 2.5),
        (100, 2.0),
        (100, 2.5),
        (134, 5.0),
        (160, 3.2),
        (300, 2.0),
        (300, 3.0),
        (500, 2.0),
        (500, 5.0),
    ] {
        let found = waves_of_bars(side, period);
        assert!(!found.is_empty(), "{side} pixels, bars of {period}");
        for wave in found {
            let odd = 2.0 * ((wave - 1.0) / 2.0).round() + 1.0;
            let off = (wave - odd).abs() * f64::from(side) / period;
            assert!(off <= 1.0, "{side} pixels, bars of {period}: {wave} periods");
        }
    }
}

#[test]
fn waves_at_the_limit_of_pixels_are_not_too_fine() {
    // Every other pixel, by bars and by rows: half a cycle per pixel is what pixels can just show.
    for (bar, frequency) in [(["1", "100"], [0.5, 0.0]), (["100", "1"], [0.0, 0.5])] {
        let bars = (0..50).map(|index| {
            let at = frequency.map(|along| 4.0 * along * f64::from(index));
            format!(
                r#"<rect x="{}" y="{}" width="{}" height="{}"/>"#,
                at[0], at[1], bar[0], bar[1]
            )
        });
        let bars: String = bars.collect();
        let text = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">{bars}</svg>"#);
        let (scene, settings, size) = (read(&text), at_rate(1), [100, 100]);
        let view = View::Canvas.transform(scene.canvas, size);
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        };
        let frame = SpectrumAnalysis::of_frame(&subject, size, Region::of_size(size)).expect("pixels");
        let found = frame.peaks(4);
        assert_eq!(found.len(), 1, "one wave: {found:?}");
        let (wave, lands) = (found[0].wave, found[0].lands);
        assert_eq!(
            (wave.frequency, lands),
            (frequency, None),
            "a frame holds no wave that is too fine"
        );
        assert!(wave.decibels().abs() < 0.01, "{found:?}");
        assert_eq!(
            frame.strongest_near(frequency, 0.03),
            Some(found[0]),
            "what is pointed at"
        );
        let (source, _) = found[0].source.expect("a scene beside it");
        let of_source = source.frequency[0].abs().max(source.frequency[1].abs());
        assert!(of_source > 1.0, "it is no alias of itself: {source:?}");
        let scene = SpectrumAnalysis::of_scene(&subject, size, Region::of_size(size)).expect("pixels");
        let found = scene.peaks(1)[0];
        assert_eq!((found.wave.frequency, found.lands), (frequency, None), "{found:?}");
    }
}

#[test]
fn samples_take_what_is_too_fine() {
    let scene = stripes(0.7);
    let amplitude = |settings: &RenderSettings| {
        let frame = analysis(&scene, settings, SpectrumAnalysis::of_frame);
        frame.at([0.3, 0.0]).expect("in the box").wave.amplitude
    };
    // Dirichlet's kernel of four columns.
    let expected = (std::f64::consts::PI * 0.7).sin() / (4.0 * (std::f64::consts::PI * 0.7 / 4.0).sin());
    let found = amplitude(&at_rate(16)) / amplitude(&at_rate(1));
    assert!((found - expected).abs() < 0.02, "{found} for {expected}");
    let difference = analysis(&scene, &at_rate(1), SpectrumAnalysis::of_difference);
    let error = difference.at([0.3, 0.0]).expect("in the box").wave.amplitude;
    let truth = amplitude(&at_rate(256));
    assert!(
        (error - (amplitude(&at_rate(1)) - truth)).abs() < 1.0,
        "the difference of both: {error}"
    );
}

#[test]
fn coarse_stripes_are_their_own() {
    let scene = stripes(0.2);
    let frame = analysis(&scene, &at_rate(1), SpectrumAnalysis::of_frame);
    let found = frame.peaks(1)[0];
    assert!((found.wave.frequency[0] - 0.2).abs() < 1e-9, "{found:?}");
    let (_, part) = found.source.expect("a scene beside it");
    assert!(part < 0.1, "nothing finer lands there: {part}");
    // Its third wave, at 0.6, lands at 0.4, and weaker ones on top of it: 1/9 + 1/49 + 1/169 + ...
    let third = frame.at([0.4, 0.0]).expect("in the box");
    let (source, part) = third.source.expect("a scene beside it");
    assert!(
        (source.frequency[0].abs() - 0.6).abs() < 1e-9 && part > 0.9,
        "{third:?}"
    );
    assert!((third.wave.amplitude / FIRST - 0.15).abs() < 0.01, "{third:?}");
}

#[test]
fn colors_tell_where_the_strongest_waves_lie() {
    let scene = stripes(0.7);
    let picture = |analysis: SpectrumAnalysis, side: u32, frequency: f64| {
        let picture = analysis.picture(side);
        let reach = analysis.reach();
        let at = ((frequency + reach) / (2.0 * reach) * f64::from(side)).round();
        picture.rgba(whole(at), side / 2).expect("inside")
    };
    let orange = |[r, g, b, _]: [u8; 4]| r > 150 && r > g + 40 && g > b;
    for side in [160, 61] {
        let frame = analysis(&scene, &at_rate(1), SpectrumAnalysis::of_frame);
        let found = picture(frame, side, 0.3);
        assert!(orange(found), "an alias, at {side}: {found:?}");
    }
    for (frequency, what) in [(0.7, "outside"), (0.3, "where it lands")] {
        let finer = analysis(&scene, &at_rate(1), SpectrumAnalysis::of_scene);
        let found = picture(finer, 480, frequency);
        assert!(orange(found), "{what}: {found:?}");
    }
    let own = analysis(&stripes(0.2), &at_rate(1), SpectrumAnalysis::of_frame);
    let [r, g, b, _] = picture(own, 160, 0.2);
    assert!(
        r > 200 && r.abs_diff(g) < 20 && r.abs_diff(b) < 20,
        "its own is white: {r} {g} {b}"
    );
}

#[test]
fn textures_have_cycles_per_texel_and_the_box_of_their_footprint() {
    // Stripes of 4 texels, seen three texels to a pixel across and one down.
    let texels = (0..64 * 64).map(|i| if (i % 4) < 2 { [0, 0, 0, 255] } else { [255; 4] });
    let level = MipLevel::new(64, 64, texels.collect());
    let to_texels = DAffine2::from_scale(DVec2::new(3.0, 1.0));
    let found = SpectrumAnalysis::of_level(&level, [10, 20], to_texels);
    assert_eq!(found.region(), Region::of_size([64, 64]), "all of it");
    let peak = found.peaks(1)[0];
    assert!((peak.wave.frequency[0] - 0.25).abs() < 1e-9, "{peak:?}");
    assert!((peak.in_pixels[0] - 0.75).abs() < 1e-9, "{peak:?}");
    let lands = peak.lands.expect("too fine for pixels");
    assert!((lands[0] + 0.25).abs() < 1e-9, "{lands:?}");
    let [corner, ..] = found.nyquist().expect("a box");
    assert!(
        (corner[0] + 0.5 / 3.0).abs() < 1e-9 && (corner[1] + 0.5).abs() < 1e-9,
        "{corner:?}"
    );
    // A black texel, then a white one: the wave is at its middle values there, and dark to light.
    let wave = SpectrumAnalysis::of_level(&level, [10, 20], DAffine2::IDENTITY);
    let peak = wave.peaks(1)[0].wave;
    let [dark, light] = [[4, 9], [6, 9]].map(|pixel| wave.value_at(&peak, pixel));
    assert!(dark < -50.0 && light > 50.0, "{dark} {light}");
}

#[test]
fn regions_are_cut_to_what_there_is() {
    let middle = SpectrumAnalysis::middle_of(Region::of_size([1001, 300]));
    let expected = Region {
        x: 244,
        y: 0,
        width: 512,
        height: 300,
    };
    assert_eq!(middle, expected, "the middle");
    let scene = stripes(0.2);
    let outside = Region {
        x: 500,
        y: 0,
        width: 5,
        height: 5,
    };
    let view = View::Canvas.transform(scene.canvas, SIZE);
    let settings = at_rate(1);
    let subject = Subject {
        scene: &scene,
        view: &view,
        settings: &settings,
    };
    assert_eq!(SpectrumAnalysis::of_frame(&subject, SIZE, outside), None, "no pixel");
    for side in [1, 2, 3] {
        let region = Region::of_size([side, side]);
        let small = SpectrumAnalysis::of_frame(&subject, SIZE, region).expect("pixels");
        assert_eq!(small.picture(7).width(), 7, "any size, of {side} pixels");
        assert!(small.peaks(3).len() <= 3, "few");
    }
}
