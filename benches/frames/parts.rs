//! Single parts of drawing: stages of a frame as the engine counts them; texture filters, pyramids and explanations of
//! pixels by divan.

use std::path::Path;
use std::time::Duration;

use divan::Bencher;
use divan::counter::ItemsCount;
use glam::DVec2;
use rasterscope::color::Premultiplied16;
use rasterscope::geometry::View;
use rasterscope::inspect::{Explanation, Question};
use rasterscope::render::{FrameStats, RenderSettings, Subject};
use rasterscope::scene::{self, DialectChoice, Scene};
use rasterscope::simd;
use rasterscope::texture::{
    Filter, LevelSampling, MipLevel, MipPyramid, PixelSampling, SampleGrid, SamplingSettings, UvMap,
};

use crate::ours::{Ours, pool, settings};
use crate::race::Timing;
use crate::scenes::{FRAMES, flat, mesh};
use crate::table::say;

/// Frames per line of the table of stages.
const FRAMES_PER_LINE: usize = 9;

/// A stage's name and where a frame's statistics hold it.
type Stage = (&'static str, fn(&FrameStats) -> Duration);

const STAGES: [Stage; 4] = [
    ("transform", |stats| stats.transform),
    ("bin", |stats| stats.bin),
    ("raster+shade", |stats| stats.raster),
    ("resolve", |stats| stats.resolve),
];

/// Every way to read a texture.
const FILTERS: [(PixelSampling, LevelSampling); 6] = [
    (PixelSampling::Nearest, LevelSampling::Zero),
    (PixelSampling::Nearest, LevelSampling::Nearest),
    (PixelSampling::Nearest, LevelSampling::Linear),
    (PixelSampling::Bilinear, LevelSampling::Zero),
    (PixelSampling::Bilinear, LevelSampling::Nearest),
    (PixelSampling::Bilinear, LevelSampling::Linear),
];

/// Each stage alone, on one thread: of flat scenes, and of textured meshes under each filter.
pub(crate) fn stages() {
    say("\nstages on one thread at 1024x1024: median (minimum) in milliseconds");
    let size = FRAMES[0];
    for rate in [1, 16] {
        for scene in flat::all(size).iter().chain([&flat::slivers(size)]) {
            line(scene.name, &scene.read(), settings(rate));
        }
        for mesh::MeshScene { name, scene } in mesh::textured(size) {
            for (pixel, level) in FILTERS {
                let settings = RenderSettings {
                    pixel_sampling: pixel,
                    level_sampling: level,
                    ..settings(rate)
                };
                line(&format!("{name}, {}, {}", pixel.name(), level.name()), &scene, settings);
            }
        }
        let points = mesh::points(size);
        line(points.name, &points.scene, settings(rate));
    }
}

fn line(name: &str, scene: &Scene, settings: RenderSettings) {
    let pool = pool(1);
    let mut ours = Ours::new(scene, FRAMES[0], settings, pool);
    ours.draw();
    let frames: Vec<FrameStats> = (0..FRAMES_PER_LINE).map(|_| ours.draw()).collect();
    let stages = STAGES.map(|(stage, time)| {
        let Timing { median, min } = Timing::of(frames.iter().map(time).collect());
        format!("{stage} {median:.3} ({min:.3})")
    });
    say(&format!(
        "{name:32} @{:<3} {}",
        settings.sample_rate.samples(),
        stages.join("  ")
    ));
}

/// Filters and pyramids: what is marked with `divan::bench` below.
pub(crate) fn parts() {
    divan::Divan::default().run_benches();
}

/// Samples in a list.
const SIDE: u16 = 64;

#[divan::bench(args = FILTERS.map(|(pixel, level)| format!("{} {}", pixel.name(), level.name())))]
fn filter(bencher: Bencher<'_, '_>, name: &str) {
    let (pixel, level) = FILTERS
        .into_iter()
        .find(|(pixel, level)| name == format!("{} {}", pixel.name(), level.name()))
        .expect("one of the filters");
    let sampling = SamplingSettings {
        pixel,
        level,
        ..SamplingSettings::default()
    };
    let texture = mesh::texture();
    // 1.4 texels per pixel, turned: two levels are mixed.
    let side = f64::from(mesh::TEXTURE_SIDE);
    let map = UvMap {
        pivot: DVec2::ZERO,
        uv: DVec2::new(0.3, 0.4),
        dx: DVec2::new(1.3, 0.5) / side,
        dy: DVec2::new(-0.5, 1.3) / side,
    };
    let grid = SampleGrid {
        side: 1,
        origin: [0, 0],
    };
    let points: Vec<[u16; 2]> = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| [x, y])).collect();
    let mut colors = vec![Premultiplied16::default(); points.len()];
    bencher.counter(ItemsCount::new(points.len())).bench_local(|| {
        Filter::new(&texture.pyramid, &map, &sampling).points(simd::level(), grid, &points, &mut colors);
    });
}

/// The scene of ours with the most triangles.
const LARGEST: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/svg/hardcore/02_degenerate_square2.svg");

/// Why a pixel of it has its colour.
#[divan::bench(args = [1, 16, 64])]
fn explanation(bencher: Bencher<'_, '_>, rate: u32) {
    let scene = scene::load(Path::new(LARGEST), DialectChoice::Auto).expect("a scene of ours");
    let settings = RenderSettings {
        pixel_sampling: PixelSampling::Bilinear,
        level_sampling: LevelSampling::Linear,
        ..settings(rate)
    };
    let size = FRAMES[0];
    let view = View::Default.transform(scene.canvas, size);
    let question = Question {
        subject: Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        },
        file: "scene.svg",
        size,
        pixel: size.map(|side| side / 2),
    };
    bencher.bench_local(|| Explanation::new(&question));
}

#[divan::bench(args = [256, 1024])]
fn pyramid(bencher: Bencher<'_, '_>, side: u32) {
    let texels = vec![[10, 20, 30, 255]; side as usize * side as usize];
    bencher
        .counter(ItemsCount::new(texels.len()))
        .with_inputs(|| MipLevel::new(side, side, texels.clone()))
        .bench_local_values(MipPyramid::build);
}
