//! The guess at a cause, against a renderer that makes each mistake by itself, alone and in pairs, on six scenes.

use std::path::Path;
use std::time::Duration;

use rasterscope::color::ResolveSpace;
use rasterscope::compare::{Cause, CellCorner, Guess, guess};
use rasterscope::geometry::{View, ViewTransform};
use rasterscope::post::PostProcess;
use rasterscope::raster::{Framebuffer, PixelCoverage, SampleRate, ShadingRate};
use rasterscope::render::{CancelToken, RenderSettings, Subject};
use rasterscope::rules::Rules;
use rasterscope::scene::{DialectChoice, Scene, load};
use rasterscope::texture::{LevelSampling, PixelSampling};

use crate::support::foreign::Foreign;
use crate::support::scenes::{at_rate, drawn};

const SIZE: [u32; 2] = [104, 90];
/// Enough for all of it on a slow machine.
const LONG: Duration = Duration::from_mins(10);
/// Polygons; lines, points and groups; colours between corners; textures large, and small; many small triangles.
const SCENES: [&str; 6] = [
    "basic/test4.svg",
    "basic/test6.svg",
    "basic/test7.svg",
    "basic/test8.svg",
    "texmap/test1.svg",
    "illustration/02_fox.svg",
];

struct Study {
    name: &'static str,
    scene: Scene,
    view: ViewTransform,
}

fn study(name: &'static str) -> Study {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg").join(name);
    let scene = load(&path, DialectChoice::Course).unwrap();
    let view = View::At {
        center: scene.canvas * 0.49,
        scale: 84.0 / scene.canvas.max_element(),
        rotation: 0.0,
    };
    let view = view.transform(scene.canvas, SIZE);
    Study { name, scene, view }
}

impl Study {
    fn guess(&self, settings: &RenderSettings, other: &Framebuffer) -> Guess {
        let subject = Subject {
            scene: &self.scene,
            view: &self.view,
            settings,
        };
        guess(&subject, other, LONG, &CancelToken::default()).unwrap()
    }

    /// What the foreign renderer makes of the scene with these mistakes.
    fn foreign(&self, settings: RenderSettings, causes: &[Cause]) -> Framebuffer {
        let mut renderer = Foreign::new(settings);
        for cause in causes {
            match *cause {
                Cause::Shifted(pixels) => renderer.shift = pixels,
                Cause::Corners(CellCorner::UpperLeft) => renderer.at = 0.0,
                Cause::Corners(CellCorner::LowerRight) => renderer.at = 1.0,
                Cause::Rules(rules) => renderer.rules = rules,
                Cause::Truncated => renderer.truncates = true,
                Cause::SampleRate(rate) => renderer.side = rate.side(),
                Cause::PixelSampling(sampling) => renderer.reads.pixel_sampling = sampling,
                Cause::LevelSampling(sampling) => renderer.reads.level_sampling = sampling,
                Cause::FlippedV => renderer.flips_v = true,
                Cause::Resolve(space) => renderer.resolve = space,
                Cause::Shading(shading) => renderer.shading = shading,
                Cause::Coverage(coverage) => (renderer.coverage, renderer.side) = (coverage, 1),
                Cause::PostProcess(process) => (renderer.post_process, renderer.side) = (process, 1),
                _ => {}
            }
        }
        let mut frame = renderer.draw(&self.scene, &self.view, SIZE);
        for cause in causes {
            spoil(&mut frame, *cause);
        }
        frame
    }
}

/// What may happen to a finished picture.
fn spoil(frame: &mut Framebuffer, cause: Cause) {
    let each = |frame: &mut Framebuffer, change: &dyn Fn([u8; 3]) -> [u8; 3]| {
        for pixel in frame.pixels_mut() {
            let [a, r, g, b] = pixel.to_be_bytes();
            let [r, g, b] = change([r, g, b]);
            *pixel = u32::from_be_bytes([a, r, g, b]);
        }
    };
    let through = |curve: fn(f64) -> f64| {
        move |rgb: [u8; 3]| {
            rgb.map(|byte| {
                let levels = (curve(f64::from(byte) / 255.0) * 255.0).round();
                (0..=255).find(|level| f64::from(*level) >= levels).unwrap_or(255)
            })
        }
    };
    match cause {
        Cause::UpsideDown => {
            let width = SIZE[0] as usize;
            let rows: Vec<u32> = frame.pixels().chunks(width).rev().flatten().copied().collect();
            frame.pixels_mut().copy_from_slice(&rows);
        }
        Cause::SwappedChannels => each(frame, &|[r, g, b]| [b, g, r]),
        Cause::EncodedTwice => each(frame, &through(|v| 1.055 * v.max(0.0031).powf(1.0 / 2.4) - 0.055)),
        Cause::NotEncoded => each(frame, &through(|v| ((v + 0.055) / 1.055).powf(2.4))),
        _ => {}
    }
}

fn rate(samples: u32) -> SampleRate {
    SampleRate::new(samples).unwrap()
}

/// Whether exactly these causes were found, in any order.
fn is_found(guess: &Guess, causes: &[Cause]) -> bool {
    guess.causes.len() == causes.len() && causes.iter().all(|cause| guess.causes.contains(cause))
}

/// The sum of squared differences.
fn error(a: &Framebuffer, b: &Framebuffer) -> u64 {
    let bytes =
        |frame: &Framebuffer| -> Vec<u8> { frame.pixels().iter().flat_map(|pixel| pixel.to_be_bytes()).collect() };
    let pairs = bytes(a).into_iter().zip(bytes(b));
    pairs.map(|(a, b)| u64::from(a.abs_diff(b)).pow(2)).sum()
}

/// Tries combinations of causes on all scenes; all that was not found, told together.
fn all_are_found(samples: u32, combinations: &[Vec<Cause>]) {
    let mut wrong = Vec::new();
    for study in SCENES.map(study) {
        let settings = at_rate(samples);
        let own = drawn(&study.scene, &study.view, &settings, SIZE);
        // Two renderers differ here and there by rounding alone.
        let by_itself = error(&own, &study.foreign(settings, &[]));
        for causes in combinations {
            let other = study.foreign(settings, causes);
            // A mistake that cannot be seen in this scene, beside others or at all, cannot be found.
            let without =
                |cause: &Cause| -> Vec<Cause> { causes.iter().copied().filter(|known| known != cause).collect() };
            // Nor is one missed that is a five hundredth of all that differs.
            let least = (10 * by_itself.max(10)).max(error(&own, &other) / 500);
            let shows = |cause: &Cause| error(&other, &study.foreign(settings, &without(cause))) > least;
            if !causes.iter().all(shows) {
                continue;
            }
            let guess = study.guess(&settings, &other);
            // One cause that leaves nothing is as good as another, and better than two.
            let leaves_nothing = !guess.causes.is_empty() && guess.after <= 10 * by_itself.max(10);
            let is_equivalent = || leaves_nothing && guess.causes.len() <= causes.len();
            if !is_found(&guess, causes) && !is_equivalent() {
                wrong.push(format!("{}: {causes:?} taken for {guess:?}", study.name));
            }
        }
    }
    assert!(wrong.is_empty(), "rate {samples}:\n{}", wrong.join("\n"));
}

const MISTAKES: [Cause; 12] = [
    Cause::Corners(CellCorner::UpperLeft),
    Cause::Corners(CellCorner::LowerRight),
    Cause::Shifted([1.0, 0.0]),
    Cause::Shifted([-0.5, 0.5]),
    Cause::Truncated,
    Cause::Rules(Rules::Course),
    Cause::FlippedV,
    Cause::PixelSampling(PixelSampling::Bilinear),
    Cause::UpsideDown,
    Cause::SwappedChannels,
    Cause::EncodedTwice,
    Cause::NotEncoded,
];

#[test]
fn guess_finds_samples_in_corners_at_rate_1() {
    let corners = [CellCorner::UpperLeft, CellCorner::LowerRight].map(|corner| vec![Cause::Corners(corner)]);
    all_are_found(1, &corners);
}

#[test]
fn guess_finds_each_mistake_of_another_renderer() {
    let more = [
        Cause::Coverage(PixelCoverage::Exact),
        Cause::PostProcess(PostProcess::Smaa),
    ];
    let all: Vec<Vec<Cause>> = MISTAKES.into_iter().chain(more).map(|cause| vec![cause]).collect();
    all_are_found(1, &all);
    let more = [
        Cause::Coverage(PixelCoverage::Exact),
        Cause::Resolve(ResolveSpace::Linear),
        Cause::SampleRate(rate(1)),
        Cause::SampleRate(rate(16)),
        Cause::Shading(ShadingRate::Centre),
        Cause::LevelSampling(LevelSampling::Linear),
        Cause::PostProcess(PostProcess::Smaa),
    ];
    let all: Vec<Vec<Cause>> = MISTAKES.into_iter().chain(more).map(|cause| vec![cause]).collect();
    all_are_found(4, &all);
}

#[test]
fn guess_finds_pairs_of_mistakes() {
    let corner = Cause::Corners(CellCorner::UpperLeft);
    all_are_found(
        4,
        &[
            vec![corner, Cause::SwappedChannels],
            vec![corner, Cause::FlippedV],
            vec![corner, Cause::SampleRate(rate(1))],
            vec![corner, Cause::Truncated],
            vec![Cause::FlippedV, Cause::Truncated],
            vec![Cause::FlippedV, Cause::PixelSampling(PixelSampling::Bilinear)],
            vec![Cause::UpsideDown, Cause::SwappedChannels],
            vec![Cause::UpsideDown, Cause::Truncated],
            vec![Cause::EncodedTwice, Cause::SampleRate(rate(1))],
            vec![Cause::Shifted([0.5, 0.0]), Cause::NotEncoded],
            vec![Cause::Resolve(ResolveSpace::Linear), corner],
            vec![Cause::PostProcess(PostProcess::Smaa), Cause::UpsideDown],
            vec![Cause::Coverage(PixelCoverage::Exact), Cause::SwappedChannels],
        ],
    );
}

#[test]
fn guess_at_noise_names_no_cause() {
    let noise = |index: usize| u32::try_from(index).unwrap().wrapping_mul(2_654_435_761) >> 13;
    let shifted = |pixel: u32, by: [i16; 3]| {
        let [a, r, g, b] = pixel.to_be_bytes();
        let near = |byte: u8, by: i16| u8::try_from((i16::from(byte) + by).clamp(0, 255)).unwrap();
        u32::from_be_bytes([a, near(r, by[0]), near(g, by[1]), near(b, by[2])])
    };
    let level =
        |index: usize, most: u32| i16::try_from(noise(index) % (2 * most + 1)).unwrap() - i16::try_from(most).unwrap();
    let kinds = [
        "nine levels",
        "all of it",
        "one level",
        "one lower here and there",
        "every byte lower",
    ];
    for (index, study) in SCENES.map(study).into_iter().enumerate() {
        let settings = at_rate(if index % 2 == 0 { 1 } else { 4 });
        let own = drawn(&study.scene, &study.view, &settings, SIZE);
        // The first of them on every scene, the others on the one with colours between corners.
        for what in &kinds[..if index == 2 { kinds.len() } else { 1 }] {
            let mut other = own.clone();
            for (index, pixel) in other.pixels_mut().iter_mut().enumerate() {
                let three = |most: u32| [0, 1, 2].map(|k| level(index * 3 + k, most));
                *pixel = match *what {
                    "nine levels" => shifted(*pixel, three(9)),
                    "one level" => shifted(*pixel, three(1)),
                    "one lower here and there" => shifted(*pixel, three(1).map(|level| level.min(0))),
                    "every byte lower" => shifted(*pixel, [-1; 3]),
                    _ => 0xFF00_0000 | noise(index * 5),
                };
            }
            let guess = study.guess(&settings, &other);
            assert_eq!(guess.causes, [], "{}, {what}: {guess:?}", study.name);
        }
    }
    let [fox, wheel] = ["illustration/02_fox.svg", "basic/test7.svg"].map(study);
    let settings = at_rate(1);
    let other = drawn(&wheel.scene, &wheel.view, &settings, SIZE);
    let guess = fox.guess(&settings, &other);
    assert_eq!(guess.causes, [], "another scene: {guess:?}");
}
