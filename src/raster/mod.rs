//! Primitives to pixels: exact edges, sample patterns, tiles, shading, resolve.
//!
//! The way of a picture: a [`ChunkBuilder`] snaps and clips screen-space primitives into [`Chunk`]s; a [`DisplayList`]
//! sorts them into tiles; each tile paints its samples in painter's order in memory that stays in the cache, is
//! resolved at once and written to the [`Framebuffer`]. Tiles are independent, so they run on all threads, and every
//! sample depends on its own position only, so neither threads nor tiles show in the result.

mod band_spans;
mod bins;
mod chunk_builder;
mod deferred;
mod direct;
mod display_list;
mod entry;
mod explain;
mod float_shape;
mod four;
mod fragments;
mod frame_row;
mod framebuffer;
mod hairline;
mod hidden;
mod known;
mod outline;
mod outline_tiles;
mod paint;
mod pairs;
mod pattern;
mod pixel_block;
mod pixel_row;
mod places;
mod plain_rows;
mod planes;
mod quads;
#[cfg(test)]
mod random;
mod rasterize;
mod recorder;
mod regions;
mod replay;
mod row_windings;
mod rows;
mod sample_mask;
mod sample_rate;
mod scattered;
mod scattered_outline;
mod shade;
mod slots;
mod small;
mod small_batch;
mod tally;
mod tile;
mod tile_rows;
mod vertex;
mod visibility;
mod walk;
mod words;

pub use chunk_builder::ChunkBuilder;
pub use display_list::{Chunk, Fill, ListContext};
pub use explain::{Attributes, Piece, PieceShape, SampleOfTriangle, TextureUse};
pub use framebuffer::Framebuffer;
pub use hidden::Hidden;
pub use pattern::SamplePattern;
pub use rasterize::{DisplayList, RasterSettings, RasterTimes};
pub use recorder::{PaintedKind, PaintedOp, PaintedSample};
pub use regions::Region;
pub use replay::{PixelReplay, ReplayedSample};
pub use sample_rate::SampleRate;
pub use tally::Counters;
