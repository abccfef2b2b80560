//! The numbers by which a tile's samples name the surface that they show, and how many make a row.

/// A primitive's number inside a tile.
pub(crate) type SurfaceId = u16;

/// Stands for a pixel that is split: each of its samples has a surface of its own.
pub(crate) const SPLIT: SurfaceId = SurfaceId::MAX;

/// Stands for a pixel whose samples show two surfaces.
pub(crate) const TWO_SURFACES: SurfaceId = SurfaceId::MAX - 1;

/// The most surfaces of a tile.
pub(crate) const MAX_SURFACES: usize = TWO_SURFACES as usize;

/// Pixels from one row of a tile to the next: no tile is wider. A word has a bit for each.
pub(crate) const ROW: usize = 64;

/// Pixels that a vector holds.
pub(crate) const GROUP: usize = 4;

/// The number of the first of the last four pixels of a row.
pub(crate) const LAST_GROUP: usize = ROW - GROUP;
