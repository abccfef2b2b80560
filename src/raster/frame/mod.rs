//! Where resolved pixels go: the [`framebuffer`], rectangles of it, and rows of tiles that threads write on their own.

pub(in crate::raster) mod block;
pub(in crate::raster) mod framebuffer;
pub(in crate::raster) mod region;
pub(in crate::raster) mod row;
