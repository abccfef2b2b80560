//! What was drawn at a pixel, for the inspector: the [`pieces`] of a list that touch it, and a [`replay`] of how its
//! samples were painted.

pub(in crate::raster) mod pieces;
pub(in crate::raster) mod replay;
