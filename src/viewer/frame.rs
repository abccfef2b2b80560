//! What a frame shows, and a finished frame.

use std::sync::Arc;

use crate::geometry::ViewTransform;
use crate::raster::Framebuffer;
use crate::render::{FrameStats, RenderSettings};
use crate::scene::Scene;

/// All that decides a frame's pixels.
#[derive(Clone, Debug)]
pub struct Picture {
    /// What is drawn.
    pub scene: Arc<Scene>,
    /// From where.
    pub view: ViewTransform,
    /// How.
    pub settings: RenderSettings,
    /// Width and height in frame pixels.
    pub size: [u32; 2],
}

/// A finished frame.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Its pixels.
    pub pixels: Framebuffer,
    /// What they show.
    pub picture: Picture,
    /// Where the time went.
    pub stats: FrameStats,
}

impl PartialEq for Picture {
    /// Scenes are never changed, so the same scene is the same memory.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
            && self.view == other.view
            && self.settings == other.settings
            && self.size == other.size
    }
}
