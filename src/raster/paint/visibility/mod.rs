//! Deferred shading: first which surface each sample of a tile shows, then each surface's colour, once per pixel.
//!
//! The [`buffer`] holds surface ids, [`packed`] four to a word; [`two_surfaces`] compresses a pixel of two surfaces as
//! GPUs do with an FMASK; [`paint_stack`] keeps what is painted over shaded primitives where each sample is rounded for itself, since
//! no sum tells that; [`flat_resolve`] averages surfaces of one colour without shading.
//! [`row_bits`] tells where a row's pixels show the same.
//! [`sample_colors`] tells the colour of each sample instead, for resolve filters that reach beyond a pixel; [`wide_shades`] that of
//! samples which are shaded.

mod bounded_parts;
pub(in crate::raster) mod buffer;
mod by_samples;
pub(in crate::raster) mod flat_light;
mod flat_resolve;
mod fragment_points;
mod fragment_sums;
mod fragments;
mod known_pixels;
mod layer_end;
pub(in crate::raster) mod packed;
pub(in crate::raster) mod paint_stack;
pub(in crate::raster) mod painter;
mod resolve;
mod resolve_by_samples;
mod row_bits;
mod sample_colors;
pub(in crate::raster) mod shading_queue;
pub(in crate::raster) mod surface_color;
mod surface_shader;
pub(in crate::raster) mod surfaces;
pub(in crate::raster) mod two_surfaces;
mod wide_shades;
