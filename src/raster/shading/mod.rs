//! The colour of a paint at a sample: solid, interpolated between vertices, or read from a texture.

pub(in crate::raster) mod shader;
pub(in crate::raster) mod vertex;
