//! Rasterscope itself as a rival: `render::draw` on a pool of one or two threads.

use std::sync::OnceLock;

use rasterscope::color::Rgba;
use rasterscope::geometry::{View, ViewTransform};
use rasterscope::raster::{Framebuffer, SampleRate};
use rasterscope::render::{FrameStats, RenderSettings, draw};
use rasterscope::scene::Scene;
use rasterscope::texture::{LevelSampling, PixelSampling};
use rayon::{ThreadPool, ThreadPoolBuilder};

/// A scene, how it is drawn, and where to.
pub(crate) struct Ours<'a> {
    scene: &'a Scene,
    view: ViewTransform,
    settings: RenderSettings,
    frame: Framebuffer,
    pool: &'a ThreadPool,
}

/// A pool of one or two threads, always the same ones. Of two, the caller is one, as on the command line: nobody is woken
/// up only to begin.
pub(crate) fn pool(threads: usize) -> &'static ThreadPool {
    static ONE: OnceLock<ThreadPool> = OnceLock::new();
    static TWO: OnceLock<ThreadPool> = OnceLock::new();
    let (pool, builder) = match threads {
        1 => (&ONE, ThreadPoolBuilder::new().num_threads(1)),
        _ => (&TWO, ThreadPoolBuilder::new().num_threads(2).use_current_thread()),
    };
    pool.get_or_init(|| builder.build().expect("threads can be started"))
}

/// How the tables draw: trilinear on white, no outline.
pub(crate) fn settings(samples: u32) -> RenderSettings {
    RenderSettings {
        sample_rate: SampleRate::new(samples).expect("a square number"),
        pixel_sampling: PixelSampling::Bilinear,
        level_sampling: LevelSampling::Linear,
        background: Rgba::WHITE,
        outline: false,
        ..RenderSettings::default()
    }
}

impl<'a> Ours<'a> {
    /// The canvas of `scene` fills a frame of `size` pixels.
    pub(crate) fn new(scene: &'a Scene, size: [u32; 2], settings: RenderSettings, pool: &'a ThreadPool) -> Self {
        Self {
            scene,
            view: View::Canvas.transform(scene.canvas, size),
            settings,
            frame: Framebuffer::new(size[0], size[1]),
            pool,
        }
    }

    /// Draws one frame.
    pub(crate) fn draw(&mut self) -> FrameStats {
        let Self {
            scene,
            view,
            settings,
            frame,
            pool,
        } = self;
        pool.install(|| draw(scene, view, settings, frame))
    }

    /// What was drawn last.
    pub(crate) fn frame(&self) -> &Framebuffer {
        &self.frame
    }
}
