//! The sums of the gallery: a line for each scene and group of settings with the SHA-256 of all of its pictures. Work on the
//! engine that must not move a pixel leaves every line as it is; `benches/frozen/run` compares them.
//!
//! The groups: six patterns and each resolve space at five rates for each of the rules (`standard`, `course`, `float`), the
//! other patterns (`patterns`), shading once per pixel (`shaded`), ways of reading textures (`filters`), cubic kernels and wraps
//! (`kernels`), exact areas, textures averaged over areas, and smoothed pixels (`areas`), every visualisation (`visualised`), and what
//! the inspector says of some pixels (`explained`).

use std::fmt::Write as _;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use rasterscope::color::{ResolveSpace, Rgba};
use rasterscope::geometry::View;
use rasterscope::inspect::{Explanation, Question};
use rasterscope::post::PostProcess;
use rasterscope::raster::{Framebuffer, PixelCoverage, SamplePattern, SampleRate, Seed, ShadingRate};
use rasterscope::render::{RenderSettings, Subject, Visualisation, draw};
use rasterscope::rules::Rules;
use rasterscope::scene::{self, DialectChoice, FolderResources, ReadOptions, Scene};
use rasterscope::texture::{Anisotropy, LevelSampling, PixelSampling, Wrap};
use rayon::prelude::*;
use sha2::{Digest, Sha256};

/// Neither side is a multiple of a tile's.
const SIZE: [u32; 2] = [101, 75];
/// Where a pixel has many samples.
const SMALL_SIZE: [u32; 2] = [37, 29];
const RATES: [u32; 5] = [1, 4, 9, 16, 64];
/// The patterns that the groups of rules go through.
const PATTERNS: [SamplePattern; 6] = [
    SamplePattern::Grid,
    SamplePattern::Rotated,
    SamplePattern::Jittered,
    SamplePattern::JitteredSame,
    SamplePattern::Halton,
    SamplePattern::R2,
];
const VIEWS: [View; 2] = [View::Default, View::Canvas];

fn main() -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg");
    let mut documents = Vec::new();
    for folder in fs::read_dir(root)? {
        for document in fs::read_dir(folder?.path())? {
            documents.push(document?.path());
        }
    }
    documents.sort();
    let lines: Vec<String> = documents.par_iter().map(|path| lines(path)).collect();
    io::stdout().write_all(lines.concat().as_bytes())
}

/// Every line of a scene.
fn lines(path: &Path) -> String {
    let options = ReadOptions {
        dialect: DialectChoice::Auto,
    };
    let document = fs::read(path).expect("a readable document");
    let resources = FolderResources::beside(path);
    let scene = scene::read(&document, "scene.svg", options, &resources).expect("the gallery is sound");
    let name = path.iter().rev().take(2).collect::<PathBuf>();
    let name = name
        .iter()
        .rev()
        .map(|part| part.to_string_lossy())
        .collect::<Vec<_>>()
        .join("/");
    let mut groups: Vec<(String, Vec<RenderSettings>)> = Rules::ALL
        .iter()
        .map(|rules| (rules.name().to_owned(), sampled(*rules)))
        .collect();
    groups.push(("areas".to_owned(), areas()));
    groups.push(("filters".to_owned(), filtered()));
    groups.push(("kernels".to_owned(), kernels()));
    groups.push(("patterns".to_owned(), patterned()));
    groups.push(("shaded".to_owned(), shaded()));
    groups.push(("visualised".to_owned(), visualised()));
    let mut text = String::new();
    let mut line = |group: &str, sum: Sha256| {
        let hex = sum
            .finalize()
            .iter()
            .fold(String::new(), |hex, byte| hex + &format!("{byte:02x}"));
        writeln!(text, "{name} {group} {hex}").expect("text grows");
    };
    for (group, all) in &groups {
        let mut sum = Sha256::new();
        for (settings, view) in all.iter().zip(VIEWS.into_iter().cycle()) {
            sum.update(picture(&scene, view, settings));
        }
        line(group, sum);
    }
    line("explained", explained(&scene));
    text
}

/// The bytes of a frame.
fn picture(scene: &Scene, view: View, settings: &RenderSettings) -> Vec<u8> {
    let size = if settings.sample_rate.samples() < 16 {
        SIZE
    } else {
        SMALL_SIZE
    };
    let mut frame = Framebuffer::new(size[0], size[1]);
    draw(scene, &view.transform(scene.canvas, size), settings, &mut frame);
    frame.pixels().iter().flat_map(|pixel| pixel.to_be_bytes()).collect()
}

/// Patterns and resolve spaces at every rate, by one of the rules.
fn sampled(rules: Rules) -> Vec<RenderSettings> {
    let mut all = Vec::new();
    for sample_rate in rates() {
        for pattern in patterns(rules) {
            for resolve in ResolveSpace::ALL {
                all.push(RenderSettings {
                    sample_rate,
                    pattern: *pattern,
                    resolve,
                    rules,
                    ..RenderSettings::default()
                });
            }
        }
    }
    all
}

/// The float rules change edges only; one pattern on the grid and one off it show that.
fn patterns(rules: Rules) -> &'static [SamplePattern] {
    match rules {
        Rules::Float => &[SamplePattern::Grid, SamplePattern::Jittered],
        Rules::Standard | Rules::Course => &PATTERNS,
    }
}

/// Ways of reading textures at two rates, over nothing.
fn filtered() -> Vec<RenderSettings> {
    let mut all = Vec::new();
    for sample_rate in rates().take(2) {
        for pixel_sampling in [PixelSampling::Nearest, PixelSampling::Bilinear] {
            for level_sampling in [LevelSampling::Zero, LevelSampling::Nearest, LevelSampling::Linear] {
                for anisotropy in [Anisotropy::OFF].into_iter().chain(Anisotropy::STEPS.last().copied()) {
                    for rules in Rules::ALL {
                        all.push(RenderSettings {
                            sample_rate,
                            pixel_sampling,
                            level_sampling,
                            anisotropy,
                            rules,
                            background: Rgba::TRANSPARENT,
                            ..RenderSettings::default()
                        });
                    }
                }
            }
        }
    }
    all
}

/// Every kernel beyond every kind of border, with one tap and several, over nothing.
fn kernels() -> Vec<RenderSettings> {
    let mut all = Vec::new();
    for pixel_sampling in PixelSampling::ALL {
        for texture_wrap in Wrap::ALL {
            // As it is without being asked for: those are `filters`.
            if pixel_sampling.cubic().is_none() && texture_wrap == Wrap::Clamp {
                continue;
            }
            for (sample_rate, rules) in rates().skip(1).zip(Rules::ALL) {
                for anisotropy in [Anisotropy::OFF].into_iter().chain(Anisotropy::STEPS.last().copied()) {
                    all.push(RenderSettings {
                        sample_rate,
                        pixel_sampling,
                        texture_wrap,
                        level_sampling: LevelSampling::Linear,
                        anisotropy,
                        rules,
                        background: Rgba::TRANSPARENT,
                        ..RenderSettings::default()
                    });
                }
            }
        }
    }
    all
}

/// Exact areas of pixels, areas of textures, and pixels that are smoothed afterwards, in each resolve space.
fn areas() -> Vec<RenderSettings> {
    let mut all = Vec::new();
    for resolve in ResolveSpace::ALL {
        for background in [Rgba::WHITE, Rgba::TRANSPARENT] {
            let plain = RenderSettings {
                resolve,
                background,
                ..RenderSettings::default()
            };
            all.push(RenderSettings {
                coverage: PixelCoverage::Exact,
                ..plain
            });
            all.push(RenderSettings {
                post_process: PostProcess::Smaa,
                ..plain
            });
            for level_sampling in [LevelSampling::Ewa, LevelSampling::SummedArea, LevelSampling::Ripmap] {
                all.push(RenderSettings {
                    sample_rate: SampleRate::new(4).expect("a square"),
                    level_sampling,
                    pyramid: resolve,
                    texture_wrap: Wrap::Mirror,
                    ..plain
                });
            }
        }
    }
    all
}

/// Colours that are computed once for all samples of a pixel, on the grid and off it, in each resolve space.
fn shaded() -> Vec<RenderSettings> {
    let mut all = Vec::new();
    for (sample_rate, pattern) in rates()
        .skip(1)
        .zip([SamplePattern::Grid, SamplePattern::Jittered].into_iter().cycle())
    {
        for shading in [ShadingRate::Centre, ShadingRate::Centroid] {
            for resolve in ResolveSpace::ALL {
                all.push(RenderSettings {
                    sample_rate,
                    pattern,
                    shading,
                    resolve,
                    ..RenderSettings::default()
                });
            }
        }
    }
    all
}

/// The other patterns at two rates, by two seeds.
fn patterned() -> Vec<RenderSettings> {
    let others = SamplePattern::ALL
        .into_iter()
        .filter(|pattern| !PATTERNS.contains(pattern));
    let settings = others.flat_map(|pattern| {
        rates()
            .skip(1)
            .step_by(2)
            .enumerate()
            .map(move |(seed, sample_rate)| RenderSettings {
                sample_rate,
                pattern,
                seed: u32::try_from(seed).ok().and_then(Seed::new).unwrap_or_default(),
                ..RenderSettings::default()
            })
    });
    settings.collect()
}

/// Every visualisation at two rates.
fn visualised() -> Vec<RenderSettings> {
    let both = Visualisation::ALL.into_iter().flat_map(|visualisation| {
        rates().take(2).map(move |sample_rate| RenderSettings {
            sample_rate,
            visualisation,
            ..RenderSettings::default()
        })
    });
    both.collect()
}

/// What is said of pixels across the picture.
fn explained(scene: &Scene) -> Sha256 {
    let mut sum = Sha256::new();
    let view = View::Default.transform(scene.canvas, SIZE);
    for rules in Rules::ALL {
        let settings = RenderSettings {
            sample_rate: SampleRate::new(4).expect("a square number"),
            pixel_sampling: PixelSampling::Bilinear,
            level_sampling: LevelSampling::Linear,
            rules,
            ..RenderSettings::default()
        };
        for i in 0..6 {
            let pixel = [i * 67 % SIZE[0], i * 41 % SIZE[1]];
            let question = Question {
                subject: Subject {
                    scene,
                    view: &view,
                    settings: &settings,
                },
                file: "scene.svg",
                size: SIZE,
                pixel,
            };
            let found = Explanation::new(&question).expect("a pixel of the picture");
            sum.update(serde_json::to_vec(&found).expect("numbers and words"));
        }
    }
    sum
}

fn rates() -> impl Iterator<Item = SampleRate> {
    RATES
        .into_iter()
        .map(|samples| SampleRate::new(samples).expect("a square number"))
}
