//! Numbers about shapes: views, sub-pixel grid, clipping, outlines, polygons, triangulation.
//!
//! Knows no XML, file, clock or window. User space and screen space are both y down.

mod area;
pub mod clip;
mod curve_steps;
pub mod edge;
pub mod float_edge;
mod gradient;
mod path;
mod polygon;
mod stroke;
mod stroke_outline;
pub mod subpixel;
mod triangulate;
mod view;
mod width;

pub use area::{area_in_pixel, cut_to_window};
pub use curve_steps::Fineness;
pub use gradient::{Circles, GradientShape, PlacedShape};
pub use path::{CurvedArea, Path, Stroke};
pub use polygon::Polygon;
pub use stroke::{LineCap, LineJoin, StrokeStyle};
pub use triangulate::{FillRule, estimate_crossings, triangulate};
pub use view::{View, ViewTransform, rounded_place};
pub use width::{BEYOND, width_in_window, width_of_part};
