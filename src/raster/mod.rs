//! Primitives to pixels: exact edges, sample patterns, tiles, shading, resolve.
//!
//! The way of a picture: a [`ChunkBuilder`] snaps and clips screen-space primitives into [`Chunk`]s; a [`DisplayList`]
//! sorts them into tiles; each tile paints its samples in painter's order in memory that stays in the cache, is
//! resolved at once and written to the [`Framebuffer`]. Tiles are independent, so they run on all threads, and every
//! sample depends on its own position only, so neither threads nor tiles show in the result.
//!
//! The room has floors, from the bottom up; each imports from those below only:
//!
//! | floor | what is decided there |
//! |---|---|
//! | `sampling` | how many samples a pixel has, and where they lie |
//! | `resolve` | what each sample weighs in its pixel, and in those around |
//! | `settings`, `stats`, `span`, `tile_layout`, `surface_id`, `attributes` | what the floors above share: runs of samples, tiles, surface numbers, planes |
//! | `shading` | the colour of a paint at a sample |
//! | `layers` | how a layer is composited with what is below it |
//! | `coverage` | which samples a shape covers |
//! | `list` | screen-space primitives as chunks; what is hidden is dropped |
//! | `binning` | which commands each tile draws |
//! | `frame` | where pixels go |
//! | `paint` | a tile's commands in painter's order, and its resolve |
//! | `display_list` | all that a frame needs |
//! | `tiles` | one tile: by which painter |
//! | `rasterizer` | all tiles, on all threads |
//! | `refine`, `explain` | the rectangles of a frame that are drawn first; what was drawn at a pixel |

mod attributes;
mod binning;
mod coverage;
mod display_list;
mod explain;
mod frame;
mod layers;
mod list;
mod paint;
#[cfg(test)]
mod random;
mod rasterizer;
mod refine;
mod resolve;
mod sampling;
mod settings;
mod shading;
mod span;
mod stats;
mod surface_id;
mod tile_layout;
mod tiles;

pub use display_list::DisplayList;
pub use explain::pieces::{Piece, PieceShape, SampleOfTriangle};
pub use explain::replay::{Around, PixelReplay, ReplayedSample, WeighedPixel};
pub use frame::framebuffer::Framebuffer;
pub use frame::region::Region;
pub use layers::Compositing;
pub use list::builder::ChunkBuilder;
pub use list::chunk::Chunk;
pub use list::context::ListContext;
pub use list::hidden::Hidden;
pub use paint::recorder::{PaintedCommand, PaintedKind, PaintedSample};

pub use resolve::{FilterRadius, ResolveFilter, SizedFilter};
pub use sampling::pattern::{CustomPattern, CustomPatternError, CustomSample, CustomWords, SamplePattern, Seed};
pub use sampling::pixel_coverage::PixelCoverage;
pub use sampling::rate::SampleRate;
pub use sampling::shading_rate::ShadingRate;
pub use sampling::statistics::{PatternStatistics, PowerSpectrum};
pub use settings::{RasterSettings, Recolor};
pub use shading::Paint;
pub use shading::interpolated::{Attributes, TextureUse};
pub use shading::once::ShadingPlace;
pub use shading::sources::{PaintSources, PlacedGradient, PlacedPattern};
pub use stats::{Counters, RasterTimes};
