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
use crate::raster::paint::visibility::surface_color::{Shaded, SurfaceColor};
use crate::raster::shading::context::ShadeContext;
use crate::raster::shading::{Paint, Shader};
use crate::rules::Rules;
use crate::texture::SampleGrid;

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

    /// Whether no command more may be painted.
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
    fn down_from(&self, top: Option<StackedPaint>) -> impl Iterator<Item = Translucent<'a>> + '_ {
        let mut next = top;
        std::iter::from_fn(move || {
            let StackedPaint(number) = next?;
            let (paint, below) = *self.all.get(number.get() as usize - 1)?;
            next = below;
            Some(paint)
        })
    }
}

/// What the samples of one surface show, prepared to be shaded: an opaque colour for each.
#[derive(Debug)]
pub(super) struct SurfaceShader<'a> {
    /// What lies below everything that is shaded.
    ground: Premultiplied16,
    lowest: Shader<'a>,
    /// What is painted over it, in that order.
    above: Vec<Shader<'a>>,
    rules: Rules,
}

impl<'a> SurfaceShader<'a> {
    /// `None` where nothing is to be shaded.
    pub(super) fn new(
        context: &ShadeContext<'a>,
        surface: &SurfaceColor<'_>,
        stacks: &PaintStacks<'_>,
    ) -> Option<Self> {
        let Shaded { primitive, above, .. } = surface.shaded?;
        let prepared = |Primitive { corners, paint }| Shader::new(context, corners, paint);
        let from_top = stacks.down_from(above).map(|paint| match paint {
            Translucent::Flat(color) => Shader::flat(color),
            Translucent::Shaded(primitive) => prepared(primitive),
        });
        let mut above: Vec<_> = from_top.collect();
        above.reverse();
        Some(Self {
            ground: surface.flat,
            lowest: prepared(primitive),
            above,
            rules: context.sampling.rules,
        })
    }

    /// The only shader, where nothing is painted over it and nothing is seen through it.
    pub(super) fn alone(&self) -> Option<&Shader<'a>> {
        (self.lowest.opaque && self.above.is_empty()).then_some(&self.lowest)
    }

    fn shaders(&self) -> impl Iterator<Item = &Shader<'a>> {
        std::iter::once(&self.lowest).chain(&self.above)
    }

    /// Whether all samples of a line from left to right get the same colour.
    pub(super) fn is_level(&self) -> bool {
        self.shaders().all(Shader::is_level)
    }

    /// How many colours are computed for so many samples of so many pixels.
    pub(super) fn evaluations(&self, samples: u64, pixels: usize) -> u64 {
        let shaded = self.shaders().filter(|shader| shader.constant().is_none());
        shaded.map(|shader| shader.evaluations(samples, pixels)).sum()
    }

    /// The colours of samples, counted from the first sample of the grid's origin. `memory` is for the colours of one paint.
    pub(super) fn points(
        &self,
        grid: SampleGrid,
        points: &[[u16; 2]],
        colors: &mut [Premultiplied16],
        memory: &mut Vec<Premultiplied16>,
    ) {
        let covered = if self.lowest.opaque && self.lowest.constant().is_none() {
            self.lowest.points(grid, points, colors);
            1
        } else {
            colors.fill(self.ground);
            0
        };
        if memory.len() < colors.len() {
            memory.resize(colors.len(), Premultiplied16::TRANSPARENT);
        }
        let shaded = &mut memory[..colors.len()];
        for shader in self.shaders().skip(covered) {
            match shader.constant() {
                Some(color) if color.is_opaque() => colors.fill(color),
                Some(color) => color.over_all(colors, self.rules),
                None => {
                    shader.points(grid, points, shaded);
                    Premultiplied16::each_over(shaded, colors, self.rules);
                }
            }
        }
    }
}
