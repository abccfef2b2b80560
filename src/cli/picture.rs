//! From options to a picture: reading a scene, drawing it on as many threads as were asked for.

use super::arguments::PictureOptions;
use super::failure::{Failure, print_error};
use crate::geometry::ViewTransform;
use crate::raster::Framebuffer;
use crate::render::{self, FrameStats, RenderSettings, Subject};
use crate::scene::Scene;
use crate::viewer::SceneSource;

/// A scene and everything that its picture depends on.
pub(super) struct Picture {
    pub(super) scene: Scene,
    view: ViewTransform,
    settings: RenderSettings,
    frame: Framebuffer,
}

impl Picture {
    /// Reads the scene; what the reader skipped is said on stderr, line by line.
    pub(super) fn read(source: &SceneSource, options: &PictureOptions) -> Result<Self, Failure> {
        let scene = source.read(options.sampling.dialect).map_err(Failure::input)?;
        for line in scene.report.lines() {
            print_error(&format!("{}:{line}", source.address()));
        }
        let [width, height] = options.size.0;
        Ok(Self {
            view: options.framing.view.transform(scene.canvas, options.size.0),
            settings: options.sampling.settings(options.framing.view),
            frame: Framebuffer::new(width, height),
            scene,
        })
    }

    /// Draws the picture, on the pool that this is called in.
    pub(super) fn draw(&mut self) -> FrameStats {
        render::draw(&self.scene, &self.view, &self.settings, &mut self.frame)
    }

    /// What the picture is of.
    pub(super) fn subject(&self) -> Subject<'_> {
        Subject {
            scene: &self.scene,
            view: &self.view,
            settings: &self.settings,
        }
    }

    /// What was drawn last.
    pub(super) fn frame(&self) -> &Framebuffer {
        &self.frame
    }
}

/// Runs `work` on a pool of as many threads as the option says, or one per core.
pub(super) fn on_threads<T: Send>(threads: Option<u16>, work: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    let threads = threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| Failure::other(format!("cannot start {threads} threads: {error}; use fewer --threads")))?;
    Ok(pool.install(work))
}
