//! What paints point to: the textures, gradients and patterns of a drawing.

use std::sync::Arc;

use glam::{DAffine2, DVec2};

use crate::color::Ramp;
use crate::geometry::GradientShape;
use crate::texture::{Texture, Tile};

/// The textures, gradients and patterns that the paints of a display list name by number.
#[derive(Debug, Default)]
pub struct PaintSources<'a> {
    /// What [`crate::raster::Paint::texture`] points to.
    pub textures: Vec<&'a Texture>,
    /// What [`crate::raster::Paint::gradient`] points to.
    pub gradients: Vec<PlacedGradient<'a>>,
    /// What [`crate::raster::Paint::pattern`] points to.
    pub patterns: Vec<PlacedPattern>,
}

/// A pattern as it lies on the screen.
#[derive(Clone, Debug)]
pub struct PlacedPattern {
    /// Its tile, drawn for this view; `None` where there is nothing to be seen.
    pub tile: Option<Arc<Tile>>,
    /// Pixels of the frame to copies of the tile.
    pub from_pixels: DAffine2,
    /// Multiplies the tile's own, `0.0..=1.0`.
    pub opacity: f32,
}

/// A gradient as it lies on the screen.
#[derive(Clone, Copy, Debug)]
pub struct PlacedGradient<'a> {
    /// Where on the ramp a point lies, in the gradient's own coordinates.
    pub geometry: GradientShape,
    /// The colours.
    pub ramp: &'a Ramp,
    /// Pixels of the frame to the gradient's own coordinates.
    pub from_pixels: DAffine2,
}

impl<'a> From<Vec<&'a Texture>> for PaintSources<'a> {
    fn from(textures: Vec<&'a Texture>) -> Self {
        Self {
            textures,
            ..Self::default()
        }
    }
}

impl PaintSources<'_> {
    /// Moves what lies on the screen by so many pixels.
    pub(in crate::raster) fn shift(&mut self, by: DVec2) {
        if by == DVec2::ZERO {
            return;
        }
        let back = DAffine2::from_translation(-by);
        for gradient in &mut self.gradients {
            gradient.from_pixels *= back;
        }
        for pattern in &mut self.patterns {
            pattern.from_pixels *= back;
        }
    }
}

impl PlacedGradient<'_> {
    /// Whether every point has a colour that lets nothing shine through.
    pub(in crate::raster) fn is_opaque(&self) -> bool {
        self.geometry.is_everywhere() && self.ramp.is_opaque()
    }
}
