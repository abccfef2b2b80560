//! Where the samples of a pixel lie: how many, in which pattern, at which positions, sets of them, and how even they are.

pub(in crate::raster) mod mask;
pub(in crate::raster) mod pattern;
pub(in crate::raster) mod pixel_coverage;
pub(in crate::raster) mod place_sums;
pub(in crate::raster) mod positions;
pub(in crate::raster) mod rate;
pub(in crate::raster) mod shading_rate;
pub(in crate::raster) mod statistics;
