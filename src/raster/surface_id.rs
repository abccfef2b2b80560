//! The numbers by which a tile's samples name the surface that they show, and how many make a row.

/// A primitive's number inside a tile.
pub(crate) type Slot = u16;

/// Stands for a pixel that is split.
pub(crate) const SPLIT: Slot = Slot::MAX;

/// Stands for a pixel that shows a [`Pair`].
pub(crate) const PAIR: Slot = Slot::MAX - 1;

/// Most slots of a tile.
pub(crate) const MAX_SLOTS: usize = PAIR as usize;

/// Pixels from one row of a tile to the next: no tile is wider. A word has a bit for each.
pub(crate) const ROW: usize = 64;

/// Pixels of a [`Quad`].
pub(crate) const QUAD: usize = 4;

/// The number of the first of the last four pixels of a row.
pub(crate) const LAST_QUAD: usize = ROW - QUAD;
