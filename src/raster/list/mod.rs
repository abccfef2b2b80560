//! Screen-space primitives as plain arrays: a [`builder`] snaps and clips them into a [`chunk`], [`hairline`]s become
//! triangles there, and what lies below a shape that hides it is dropped ([`hidden`]).

pub(in crate::raster) mod builder;
pub(in crate::raster) mod chunk;
pub(in crate::raster) mod context;
pub(in crate::raster) mod hairline;
pub(in crate::raster) mod hidden;
