//! Which samples a shape covers. This is the one place where edges are asked; who owns a line that two shapes share is
//! decided in [`crate::geometry::edge`].
//!
//! Positions are fixed-point and edge functions are integers, so every answer is exact and ties are ties. Where samples
//! lie on a grid, a shape becomes spans of a row of samples:
//!
//! ```text
//!      samples of a row:   .  .  #  #  #  #  .  .
//!      its span:                 [start    end)
//! ```
//!
//! # One way to the painters
//!
//! Every shape reaches every painter in one form, [`covered`]: runs of pixels of which all samples are covered, and for each
//! pixel on an edge a mask of its samples. It comes through one door, [`shape_coverage`]:
//!
//! ```text
//!      triangle        polygon_rows, float_shape     mask8x8      free_positions, free_positions_polygon
//!         |                  |                          |                    |
//!         +------------------+-- span_rows -------------+                    |
//!                                    |                                       |
//!                       +------------+-------------+                         |
//!                       |                          |                         |
//!                   pixel_rows               narrow_rows                     |
//!                       |                          |                         |
//!         covered: runs and masks        four masks in a word      covered: runs and masks
//!                       |                          |                         |
//!                  all painters             visibility only             per_sample
//! ```
//!
//! * [`span_rows`] gathers the spans of sample rows by rows of pixels, [`pixel_rows`] makes runs and masks of them.
//! * [`polygon_rows`] finds the spans of polygons, [`simple_polygon_rows`] where two edges cross each row, [`column_windings`]
//!   where thousands do.
//! * [`mask8x8`] and [`mask8x8_simd`] hold small shapes as 64 bits.
//! * [`free_positions`], [`free_positions_triangle`] and [`free_positions_polygon`] serve patterns off the grid, with
//!   [`sample_lanes`], [`row_edges`], [`windings`] and [`edge_bounds`].
//!
//! What was tried to have fewer ways still, in instructions per redraw:
//!
//! | instead | costs |
//! |---|---|
//! | 4 x 4 samples as runs and masks too | 8 to 44 % of scenes at rate 16, as measured before the one form: masks four at a time are most of their speed |
//! | one source of spans that holds any shape, moved by value, rather than one type for each | 6 % of a flat scene at rate 16 with AVX2, 4 % with SSE2 |
//! | the next span of each sample row looked up again, rather than kept | 15 % of slivers at rate 16 |
//! | triangles at all rates by four sample rows at once, as [`narrow_rows`] has them | 3 % of a flat scene at rate 1 |
//!
//! The one form itself costs more than spans did where masks are long or have to be cut into runs again: 15 % of a flat scene at
//! rate 100, 12 % of translucent layers at rate 4 in linear light; it saves 11 % of a textured scene there, 3 % of a flat one at
//! rate 9.
//!
//! Nothing is stored in between, as strips are in `vello_cpu`: a tile is painted while the spans of a shape are found.

pub(in crate::raster) mod area;
mod column_windings;
pub(in crate::raster) mod covered;
pub(in crate::raster) mod edge_bounds;
pub(in crate::raster) mod float_shape;
pub(in crate::raster) mod free_positions;
pub(in crate::raster) mod free_positions_polygon;
mod free_positions_triangle;
pub(in crate::raster) mod mask8x8;
pub(in crate::raster) mod mask8x8_simd;
pub(in crate::raster) mod narrow_rows;
pub(in crate::raster) mod outline_cache;
pub(in crate::raster) mod pixel_rows;
pub(in crate::raster) mod polygon;
pub(in crate::raster) mod polygon_rows;
mod row_edges;
mod sample_lanes;
pub(in crate::raster) mod shape;
pub(in crate::raster) mod shape_coverage;
pub(in crate::raster) mod simple_polygon_rows;
pub(in crate::raster) mod span_rows;
pub(in crate::raster) mod triangle;
pub(in crate::raster) mod windings;
