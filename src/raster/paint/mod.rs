//! The painters, which draw a tile's commands in painter's order and resolve it.
//!
//! | painter | for | keeps |
//! |---|---|---|
//! | [`direct`] | one sample per pixel | pixels |
//! | [`visibility`] | opaque shapes on a grid | which surface each sample shows; shades once per pixel and surface |
//! | [`per_sample`] | everything | the colour of each sample ([`sample_colors`]) |
//!
//! Where areas count instead of samples, [`per_sample`] paints everything, with [`by_area`].
//!
//! Where pixels take samples of their neighbours, [`wide`] resolves what [`visibility`] has found, or what [`per_sample`] has painted
//! in tiles with shaded layers or on a ground that shows through.
//!
//! [`per_sample`] is the simple one that the others are tested against; it also feeds the [`recorder`], from which pixels
//! are explained.

mod by_area;
pub(in crate::raster) mod direct;
pub(in crate::raster) mod method;
pub(in crate::raster) mod per_sample;
mod put_runs;
pub(in crate::raster) mod recorder;
pub(in crate::raster) mod sample_colors;
mod shade_once;
mod short_runs;
pub(in crate::raster) mod visibility;
pub(in crate::raster) mod wide;
