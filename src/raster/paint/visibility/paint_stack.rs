//! Translucent paints over a primitive that is shaded, where every sample is rounded for itself: no sum says what is left of the
//! primitive, so that each sample has to be painted over, in painter's order, once its colour is known.
//!
//! Surfaces share the paints that they have in common:
//!
//! ```text
//! surface 7 ── veil ──┐
//! surface 8 ── glow ──┴── tint ── the primitive
//! ```

use std::num::NonZeroU32;

use crate::color::Premultiplied16;
use crate::geometry::subpixel::GridPoint;
use crate::raster::shading::Paint;

/// A primitive that is to be shaded: the corners between which its paint lies, and the paint.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Primitive<'a> {
    pub(crate) corners: &'a [GridPoint; 3],
    pub(crate) paint: &'a Paint,
}

/// What is painted over a surface that may be seen through it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Translucent<'a> {
    Flat(Premultiplied16),
    Shaded(Primitive<'a>),
}

/// The number of a paint in its [`PaintStacks`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct StackedPaint(NonZeroU32);

/// The paints over all primitives of a tile.
#[derive(Debug, Default)]
pub(crate) struct PaintStacks<'a> {
    /// Each paint, and the one that it was painted over, if that is not the primitive itself.
    all: Vec<(Translucent<'a>, Option<StackedPaint>)>,
}

/// Paints of one tile: about as many as there are surfaces. A tile that has more is painted without any, in memory that does not
/// grow.
pub(super) const MOST: usize = 1 << 13;

impl<'a> PaintStacks<'a> {
    /// Forgets all paints.
    pub(crate) fn clear(&mut self) {
        self.all.clear();
    }

    /// Whether there is no room for what another command paints.
    pub(crate) fn is_full(&self) -> bool {
        self.all.len() >= MOST
    }

    /// Paints over a stack.
    pub(crate) fn push(&mut self, paint: Translucent<'a>, below: Option<StackedPaint>) -> Option<StackedPaint> {
        self.all.push((paint, below));
        let number = u32::try_from(self.all.len()).ok().and_then(NonZeroU32::new);
        number.map(StackedPaint)
    }

    /// The paints of a stack, from its top down.
    pub(super) fn down_from(&self, top: Option<StackedPaint>) -> impl Iterator<Item = Translucent<'a>> + '_ {
        let mut next = top;
        std::iter::from_fn(move || {
            let StackedPaint(number) = next?;
            let (paint, below) = *self.all.get(number.get() as usize - 1)?;
            next = below;
            Some(paint)
        })
    }
}
