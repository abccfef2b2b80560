//! What painting a frame did, and where its time went.

use std::ops::AddAssign;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// What painting a frame did. A block is the part of a tile that one primitive touches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Blocks that are whole tiles, accepted without looking at an edge.
    pub blocks_whole: u64,
    /// Blocks that an edge splits.
    pub blocks_split: u64,
    /// Samples whose colours were interpolated or read from a texture; flat colours need no shading.
    pub samples_shaded: u64,
}

/// Where the time went.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RasterTimes {
    /// Ops to tiles.
    pub bin: Duration,
    /// Coverage and shading.
    pub raster: Duration,
    /// Samples to pixels; estimated from the time that a part of the tiles took.
    pub resolve: Duration,
    /// What was done.
    pub counters: Counters,
}

/// What one thread did so far.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::raster) struct Tally {
    pub(in crate::raster) counters: Counters,
    /// How long the tiles that were timed took, and what of it was resolving.
    pub(in crate::raster) timed: Duration,
    pub(in crate::raster) resolving: Duration,
}

/// What all threads did.
#[derive(Debug, Default)]
pub(in crate::raster) struct SharedTally(Mutex<Tally>);

impl AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.counters.blocks_whole += other.counters.blocks_whole;
        self.counters.blocks_split += other.counters.blocks_split;
        self.counters.samples_shaded += other.counters.samples_shaded;
        self.timed += other.timed;
        self.resolving += other.resolving;
    }
}

impl Tally {
    /// The part of the time that resolving took, `0.0..=1.0`.
    pub(in crate::raster) fn resolving_share(&self) -> f64 {
        if self.timed.is_zero() {
            return 0.0;
        }
        (self.resolving.as_secs_f64() / self.timed.as_secs_f64()).min(1.0)
    }
}

impl SharedTally {
    /// Adds what one thread did, and lets it start anew.
    pub(in crate::raster) fn take(&self, tally: &mut Tally) {
        // A sum of numbers is whole even if a thread panicked meanwhile.
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) += std::mem::take(tally);
    }

    pub(in crate::raster) fn total(&self) -> Tally {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl RasterTimes {
    /// Adds the painting of some tiles that took `time`.
    pub(in crate::raster) fn painted(&mut self, time: Duration, tally: &Tally) {
        let resolve = time.mul_f64(tally.resolving_share());
        self.resolve += resolve;
        self.raster += time.saturating_sub(resolve);
        self.counters.blocks_whole += tally.counters.blocks_whole;
        self.counters.blocks_split += tally.counters.blocks_split;
        self.counters.samples_shaded += tally.counters.samples_shaded;
    }
}
