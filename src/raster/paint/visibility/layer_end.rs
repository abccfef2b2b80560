//! The end of a layer, where samples show flat colours by number.

use std::collections::HashMap;

use crate::raster::layers::Compositing;
use crate::raster::paint::visibility::buffer::Composer;
use crate::raster::paint::visibility::surfaces::SurfaceTable;
use crate::raster::surface_id::SurfaceId;

/// Makes one surface for each pair of a surface below the layer and one of the layer.
pub(super) struct LayerEnd<'s, 'a> {
    surfaces: &'s mut SurfaceTable<'a>,
    compositing: Compositing,
    /// What was made so far.
    made: HashMap<[SurfaceId; 2], SurfaceId>,
    /// The latest, each in the [place] of its pair: most samples are like their neighbours, or those above them.
    latest: [Option<([SurfaceId; 2], SurfaceId)>; LATEST],
}

/// How many pairs are found without a search; a power of two.
const LATEST: usize = 64;

/// The place of a pair among the latest.
#[inline]
fn place([below, above]: [SurfaceId; 2]) -> usize {
    (usize::from(below) * 7 + usize::from(above)) % LATEST
}

impl<'s, 'a> LayerEnd<'s, 'a> {
    pub(super) fn new(surfaces: &'s mut SurfaceTable<'a>, compositing: Compositing) -> Self {
        Self {
            surfaces,
            compositing,
            made: HashMap::new(),
            latest: [None; LATEST],
        }
    }
}

impl Composer for LayerEnd<'_, '_> {
    fn keeps_below(&self, above: SurfaceId) -> bool {
        self.compositing.keeps_under(self.surfaces.get(above).flat)
    }

    fn composited(&mut self, below: SurfaceId, above: SurfaceId) -> SurfaceId {
        let pair = [below, above];
        if let Some((known, result)) = self.latest[place(pair)]
            && known == pair
        {
            return result;
        }
        if self.keeps_below(above) {
            return below;
        }
        let sample = self.surfaces.get(above).flat;
        let make = || self.surfaces.composited(below, sample, self.compositing);
        let result = *self.made.entry(pair).or_insert_with(make);
        self.latest[place(pair)] = Some((pair, result));
        result
    }
}
