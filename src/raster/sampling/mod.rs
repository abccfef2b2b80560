//! Where the samples of a pixel lie: how many, in which pattern, at which positions, and sets of them.

pub(in crate::raster) mod mask;
pub(in crate::raster) mod pattern;
pub(in crate::raster) mod positions;
pub(in crate::raster) mod rate;
