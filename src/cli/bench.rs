//! `rasterscope bench`: how long redraws take, as median and minimum, in total and per stage.

use std::path::Path;
use std::time::{Duration, Instant};

use serde::Serialize;

use super::failure::{Failure, print, print_json};
use super::memory::peak_megabytes;
use super::options::bench::BenchOptions;
use super::picture::{Picture, on_threads, spec};
use super::progress;
use super::rounded::rounded;
use crate::inspect::counted;
use crate::plain;
use crate::render::{FrameStats, median, milliseconds};

/// The answer of `bench --json`. Times are milliseconds of wall time.
#[derive(Debug, Serialize)]
struct Report {
    scene: String,
    width: u32,
    height: u32,
    sample_rate: u32,
    threads: usize,
    frames: u32,
    median_ms: f64,
    min_ms: f64,
    /// Median of each stage.
    stages_ms: Stages,
    /// Triangles that reached the tiles in one frame.
    triangles: u64,
    counters: Counters,
    /// The most memory that the process has had so far, in megabytes of 2^20 bytes; `null` where the system does not tell.
    peak_mb: Option<f64>,
}

/// What one frame did.
#[derive(Debug, Serialize)]
struct Counters {
    triangles: u64,
    /// Tiles that a primitive covered wholly.
    blocks_whole: u64,
    /// Parts of tiles that an edge bounds.
    blocks_split: u64,
    /// Samples whose colours were interpolated or read from a texture.
    samples_shaded: u64,
}

#[derive(Debug, Serialize)]
struct Stages {
    transform: f64,
    bin: f64,
    /// Coverage and shading.
    raster: f64,
    /// Samples to pixels.
    resolve: f64,
    /// Bringing the frame to a screen: `null`, because there is none here.
    present: Option<f64>,
}

/// How long frames are drawn that do not count yet.
const WARM_UP: Duration = Duration::from_millis(100);

/// Draws each scene as often as asked and prints what it took, when all are done.
pub(super) fn run(options: &BenchOptions) -> Result<(), Failure> {
    progress::count(options.scenes.len() * options.frames as usize);
    let reports = on_threads(options.picture.framing.threads, || -> Result<Vec<Report>, Failure> {
        options.scenes.iter().map(|scene| measure(scene, options)).collect()
    })??;
    if options.json {
        let json = match reports.as_slice() {
            [report] => serde_json::to_string(report),
            several => serde_json::to_string(several),
        };
        print_json(&json.map_err(Failure::other)?)
    } else {
        let texts: Vec<String> = reports.iter().map(Report::text).collect();
        print(&texts.join("\n\n"))
    }
}

fn measure(scene: &Path, options: &BenchOptions) -> Result<Report, Failure> {
    let mut picture = Picture::read(spec(scene, &options.picture))?;
    // The first frame pays for memory that later ones find in place.
    picture.draw();
    // It takes the system a while to give every thread a core of its own. A single frame is no measure of time anyway.
    let start = Instant::now();
    while options.frames > 1 && rayon::current_num_threads() > 1 && start.elapsed() < WARM_UP {
        picture.draw();
    }
    let draw = |_| {
        let stats = picture.draw();
        progress::done();
        stats
    };
    let frames: Vec<FrameStats> = (0..options.frames).map(draw).collect();
    let stage = |time: fn(&FrameStats) -> Duration| median(frames.iter().map(time).collect());
    let last = frames.last().copied().unwrap_or_default();
    let min = frames.iter().map(FrameStats::total).min().unwrap_or_default();
    Ok(Report {
        scene: scene.display().to_string(),
        width: picture.frame().width(),
        height: picture.frame().height(),
        sample_rate: options.picture.sampling.sample_rate().samples(),
        threads: rayon::current_num_threads(),
        frames: options.frames,
        median_ms: rounded(milliseconds(stage(FrameStats::total))),
        min_ms: rounded(milliseconds(min)),
        stages_ms: Stages {
            transform: rounded(milliseconds(stage(|frame| frame.transform))),
            bin: rounded(milliseconds(stage(|frame| frame.bin))),
            raster: rounded(milliseconds(stage(|frame| frame.raster))),
            resolve: rounded(milliseconds(stage(|frame| frame.resolve))),
            present: None,
        },
        triangles: last.triangles,
        counters: Counters {
            triangles: last.triangles,
            blocks_whole: last.counters.blocks_whole,
            blocks_split: last.counters.blocks_split,
            samples_shaded: last.counters.samples_shaded,
        },
        peak_mb: peak_megabytes(),
    })
}

impl Report {
    fn text(&self) -> String {
        format!(
            "{}\n{} x {} pixels, {} per pixel, {}, {}, {} triangles and polygons\n\
             median     {:9.3} ms\nminimum    {:9.3} ms\ntransform  {:9.3} ms\nbin        {:9.3} ms\nraster     {:9.3} ms\n\
             resolve    {:9.3} ms\npresent         none\n\
             blocks covered whole {}, blocks split {}, samples shaded {}",
            plain::line(&self.scene),
            self.width,
            self.height,
            counted(self.sample_rate as usize, "sample"),
            counted(self.threads, "thread"),
            counted(self.frames as usize, "frame"),
            self.triangles,
            self.median_ms,
            self.min_ms,
            self.stages_ms.transform,
            self.stages_ms.bin,
            self.stages_ms.raster,
            self.stages_ms.resolve,
            self.counters.blocks_whole,
            self.counters.blocks_split,
            self.counters.samples_shaded,
        )
    }
}
