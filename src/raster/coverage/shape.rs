//! What covers samples: a shape, as the commands of a tile name it.

use crate::geometry::subpixel::GridPoint;
use crate::raster::coverage::float_shape::FloatShape;
use crate::raster::coverage::mask8x8::CoverageMask;
use crate::raster::coverage::polygon::OutlineWithEdges;

/// Spans of outlines that are remembered at most, about 8 MB.
pub(in crate::raster) const MAX_SPANS: usize = 1 << 20;

/// What covers samples in a tile.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shape<'c> {
    /// All of the tile.
    Tile,
    /// A few samples of a grid, each row of them side by side, counted from the tile's first; all lie in the tile.
    Samples(CoverageMask),
    /// A few pixels, counted from the tile's first; all lie in the tile.
    Pixels(CoverageMask),
    /// The corners of a triangle.
    Triangle(&'c [GridPoint; 3]),
    /// A polygon.
    Outline(NumberedOutline<'c>),
    /// A triangle by the rules of first drafts.
    Float(&'c FloatShape),
}

/// An outline and how it is remembered.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NumberedOutline<'c> {
    pub(crate) outline: OutlineWithEdges<'c>,
    /// Its number among all outlines of the drawing.
    pub(crate) number: usize,
}
