//! Which commands each tile draws: the [`binner`] walks over a shape's tiles, [`bins`] keep each tile's commands in
//! painter's order.

pub(in crate::raster) mod binner;
pub(in crate::raster) mod bins;
pub(in crate::raster) mod polygon_tiles;
pub(in crate::raster) mod tile_command;
mod touched_tiles;
pub(in crate::raster) mod visible;
