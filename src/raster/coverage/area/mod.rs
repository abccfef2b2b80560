//! How much of each pixel a shape covers, exactly: areas instead of samples.
//!
//! Every edge adds to the pixels that it crosses the area between itself and their right sides, and to all pixels right of them
//! the height that it has there; the sum over all edges of a shape, each counted as it enters or leaves it from left to right, is
//! the covered area. That is how fonts are drawn (Raph Levien, "Inside the fastest font renderer in the world", 2016; Sean
//! Barrett, "How the `stb_truetype` anti-aliased software rasterizer v2 works", 2015).
//!
//! ```text
//!     +-----+-----+-----+
//!     |     |   /#|#####|      an edge that crosses one pixel: its part right of the edge,
//!     |     |  /##|#####|      and all of the pixels beyond
//!     |     | /###|#####|
//!     +-----+-----+-----+
//! ```
//!
//! Such sums are right where contours do not overlap. So [`outline`] cuts a row of pixels into bands at every corner and every
//! crossing of edges; inside a band edges keep their order, the fill rule tells between which of them the shape lies, and only
//! those are added.
//!
//! Where edges cross the sides of pixels is rounded to `2^-20` of a pixel, sums are whole numbers, and what comes out has 16 bits:
//! neither tiles nor the order of edges show, and shapes that share an edge have areas that add up to the whole pixel.

pub(in crate::raster) mod edge;
pub(in crate::raster) mod outline;
pub(in crate::raster) mod row;
pub(in crate::raster) mod shape_area;
