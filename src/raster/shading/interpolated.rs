//! What a shader tells of the way to a sample's colour.

use crate::color::Mix;
use crate::texture::{Reading, TextureReads, TileRead};

/// What is interpolated at a sample.
#[derive(Clone, Debug, PartialEq)]
pub enum Attributes {
    /// Nothing: one colour.
    None,
    /// Straight red, green, blue, alpha, `0.0..=1.0`.
    Color([f64; 4]),
    /// Texture coordinates.
    Texture {
        /// `(u, v)`.
        uv: [f64; 2],
        /// The texels read there.
        reads: TextureReads,
    },
    /// Texels of a tile that is repeated.
    Pattern {
        /// Width and height of the tile in texels.
        size: [u32; 2],
        /// What is read.
        read: TileRead,
    },
    /// A place on a ramp.
    Gradient {
        /// Before spreading.
        place: f64,
        /// What is mixed there.
        mix: Mix,
    },
    /// No place on the ramp: none of a radial gradient's circles goes through the sample.
    OffRamp,
}

/// How a triangle reads its texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureUse {
    /// Index into the textures of the drawing.
    pub texture: u32,
    /// The same for all its samples, because its map is affine.
    pub reading: Reading,
    /// Multiplies the texels, `0.0..=1.0`.
    pub opacity: f32,
}
