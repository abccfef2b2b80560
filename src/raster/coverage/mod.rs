//! Which samples a shape covers. This is the one place where edges are decided.
//!
//! Positions are fixed-point and edge functions are integers, so every answer is exact and ties are ties. Where samples
//! lie on a grid, a shape becomes spans of a row of samples:
//!
//! ```text
//!      samples of a row:   .  .  #  #  #  #  .  .
//!      its span:                 [start    end)
//! ```
//!
//! * [`triangle`], [`polygon_rows`] (and [`simple_polygon_rows`], where two edges cross a row) and [`float_shape`] give spans;
//!   [`shape_rows`] asks whichever it is.
//! * [`pixel_rows`] and [`pixel_rows_4x4`] turn the spans of the rows of a row of pixels into whole pixels and edges.
//! * [`mask8x8`] and [`mask8x8_simd`] hold small shapes as 64 bits.
//! * [`free_positions`] and [`free_positions_polygon`] serve patterns off the grid, with [`windings`] and [`edge_bounds`].

pub(in crate::raster) mod covered;
pub(in crate::raster) mod edge_bounds;
pub(in crate::raster) mod float_shape;
pub(in crate::raster) mod free_positions;
pub(in crate::raster) mod free_positions_polygon;
pub(in crate::raster) mod mask8x8;
pub(in crate::raster) mod mask8x8_simd;
pub(in crate::raster) mod outline_cache;
pub(in crate::raster) mod pixel_rows;
pub(in crate::raster) mod pixel_rows_4x4;
pub(in crate::raster) mod polygon;
pub(in crate::raster) mod polygon_rows;
pub(in crate::raster) mod shape;
pub(in crate::raster) mod shape_rows;
pub(in crate::raster) mod simple_polygon_rows;
pub(in crate::raster) mod span_rows;
pub(in crate::raster) mod triangle;
pub(in crate::raster) mod windings;
