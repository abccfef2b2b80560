//! Golden pictures of every own scene at several settings. `BLESS=1 cargo test golden` makes them anew.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use rasterscope::geometry::View;
use rasterscope::raster::{SamplePattern, SampleRate};
use rasterscope::render::RenderSettings;
use rasterscope::rules::Rules;
use rasterscope::scene::{DialectChoice, Paint, PrimitiveKind, Scene};
use rasterscope::texture::{Anisotropy, Derivatives, FixedLevel, LevelOfDetail, LevelSampling, LodBias, PixelSampling};
use rasterscope::viewer::{SceneSource, list_scenes};
use rayon::prelude::*;

use crate::support::golden::{check, folder};
use crate::support::scenes::drawn;

/// Small enough to be looked at in a review, large enough to show what a scene is about.
const SIZE: [u32; 2] = [160, 160];

/// What the pictures of other tests begin with.
const OTHERS: [&str; 4] = ["overlay_", "visualised_", "figure_", "lesson_"];

fn settings(samples: u32, pixel_sampling: PixelSampling, level_sampling: LevelSampling) -> RenderSettings {
    let sample_rate = SampleRate::new(samples).expect("a square number");
    RenderSettings {
        sample_rate,
        pixel_sampling,
        level_sampling,
        ..RenderSettings::default()
    }
}

/// The settings of the goldens and their names.
fn all_settings() -> [(&'static str, RenderSettings); 4] {
    let course = RenderSettings {
        rules: Rules::Course,
        ..RenderSettings::default()
    };
    [
        ("1spp", settings(1, PixelSampling::Nearest, LevelSampling::Zero)),
        ("4spp", settings(4, PixelSampling::Bilinear, LevelSampling::Nearest)),
        ("16spp", settings(16, PixelSampling::Bilinear, LevelSampling::Linear)),
        ("course", course),
    ]
}

/// What scenes about texture footprints are drawn with besides.
fn further_settings(topic: &str) -> Vec<(&'static str, RenderSettings)> {
    let trilinear = settings(1, PixelSampling::Bilinear, LevelSampling::Linear);
    let detail = |detail: LevelOfDetail| RenderSettings { detail, ..trilinear };
    match topic {
        "study_11_city_floor" => [
            ("trilinear", 1),
            ("anisotropy4", 4),
            ("anisotropy16", 16),
            ("anisotropy64", 64),
        ]
        .map(|(name, taps)| {
            let anisotropy = Anisotropy::new(taps).expect("a maximum");
            let settings = RenderSettings {
                anisotropy,
                ..trilinear
            };
            (name, settings)
        })
        .to_vec(),
        "study_12_sharp_or_still" => vec![
            (
                "sharper",
                detail(LevelOfDetail {
                    bias: LodBias::new(-1.0).expect("a bias"),
                    ..LevelOfDetail::default()
                }),
            ),
            (
                "level2",
                detail(LevelOfDetail {
                    fixed: FixedLevel::new(2.0),
                    ..LevelOfDetail::default()
                }),
            ),
            (
                "per_sample",
                RenderSettings {
                    sample_rate: SampleRate::new(16).expect("a square number"),
                    ..detail(LevelOfDetail {
                        derivatives: Derivatives::Sample,
                        ..LevelOfDetail::default()
                    })
                },
            ),
        ],
        "study_13_thin_rays" => patterns(),
        _ => Vec::new(),
    }
}

/// Every sample pattern but the grid, with a rate that only some take where they do.
fn patterns() -> Vec<(&'static str, RenderSettings)> {
    let others = SamplePattern::ALL.into_iter().skip(1);
    let of_pattern = |pattern: SamplePattern| {
        let samples = if pattern.needs_square() { 4 } else { 5 };
        let settings = settings(samples, PixelSampling::Nearest, LevelSampling::Zero);
        (pattern.name(), RenderSettings { pattern, ..settings })
    };
    others.map(of_pattern).collect()
}

/// Everything that a scene is drawn with.
fn settings_of(topic: &str) -> impl Iterator<Item = (&'static str, RenderSettings)> {
    all_settings().into_iter().chain(further_settings(topic))
}

/// Flat scenes are integer arithmetic from end to end. Where levels of detail (a logarithm) and interpolated attributes
/// take part, another platform's mathematics may round a byte the other way.
fn tolerance(scene: &Scene) -> u8 {
    let shaded = |kind: &PrimitiveKind| {
        matches!(
            kind,
            PrimitiveKind::Triangle {
                paint: Paint::Vertex(_) | Paint::Texture { .. },
                ..
            }
        )
    };
    u8::from(scene.primitives.iter().any(|primitive| shaded(&primitive.kind)))
}

fn own_scenes() -> Vec<PathBuf> {
    let (entries, problems) = list_scenes(&[Path::new(env!("CARGO_MANIFEST_DIR")).join("svg")]);
    assert!(problems.is_empty(), "{problems:?}");
    let file = |source| match source {
        SceneSource::File(path) => Some(path),
        SceneSource::Gallery(_) => None,
    };
    entries.into_iter().filter_map(|entry| file(entry.source)).collect()
}

/// `svg/basic/test4.svg` is `basic_test4`.
fn topic(path: &Path) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg");
    let inner = path.strip_prefix(root).expect("below svg").with_extension("");
    inner
        .components()
        .map(|part| part.as_os_str().to_string_lossy().into_owned())
        .collect::<Vec<_>>()
        .join("_")
}

#[test]
fn golden_pictures_of_every_own_scene() {
    let problems: Vec<String> = own_scenes()
        .par_iter()
        .flat_map_iter(|path| {
            let scene = rasterscope::scene::load(path, DialectChoice::Auto).expect("our own scenes can be read");
            let view = View::Default.transform(scene.canvas, SIZE);
            settings_of(&topic(path))
                .filter_map(|(name, settings)| {
                    let frame = drawn(&scene, &view, &settings, SIZE);
                    check(&format!("{}_{name}", topic(path)), &frame, tolerance(&scene)).err()
                })
                .collect::<Vec<_>>()
        })
        .collect();
    assert!(
        problems.is_empty(),
        "{} pictures differ:\n{}",
        problems.len(),
        problems.join("\n")
    );
}

#[test]
fn golden_pictures_all_belong_to_a_scene() {
    let expected: BTreeSet<String> = own_scenes()
        .iter()
        .flat_map(|path| {
            let topic = topic(path);
            settings_of(&topic)
                .map(|(name, _)| format!("{topic}_{name}.png"))
                .collect::<Vec<_>>()
        })
        .collect();
    let entries = std::fs::read_dir(folder()).expect("golden pictures");
    let orphans: Vec<String> = entries
        .map(|entry| {
            entry
                .expect("a readable entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .filter(|name| !OTHERS.iter().any(|other| name.starts_with(other)) && !expected.contains(name))
        .collect();
    assert!(orphans.is_empty(), "without a scene: {orphans:?}");
    assert!(
        expected.len() >= 120,
        "every own scene has its pictures: {}",
        expected.len()
    );
}
