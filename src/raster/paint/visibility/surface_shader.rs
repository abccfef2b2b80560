//! What gives samples of one surface their colours, where each of them is rounded for itself: the primitives that are shaded, and what
//! is painted over them.

use crate::color::Premultiplied16;
use crate::raster::paint::visibility::paint_stack::{PaintStacks, Primitive, Translucent};
use crate::raster::paint::visibility::surface_color::{Shaded, SurfaceColor};
use crate::raster::shading::Shader;
use crate::raster::shading::context::ShadeContext;
use crate::rules::Rules;
use crate::texture::SampleGrid;

/// What the samples of one surface show, prepared to be shaded: an opaque colour for each.
#[derive(Debug)]
pub(super) struct SurfaceShader<'a> {
    /// What lies below everything that is shaded.
    ground: Premultiplied16,
    lowest: Shader<'a>,
    /// What is painted over it, in that order.
    above: Vec<Shader<'a>>,
    /// Their colours, where these are flat and the lowest paint hides the ground.
    tints: Option<Vec<Premultiplied16>>,
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
        let lowest = prepared(primitive);
        let tints = lowest.opaque.then(|| above.iter().map(Shader::constant).collect());
        Some(Self {
            ground: surface.flat,
            lowest,
            tints: tints.flatten(),
            above,
            rules: context.sampling.rules,
        })
    }

    /// The only paint that is shaded and the flat colours over it, where nothing is seen through it.
    pub(super) fn tinted(&self) -> Option<(&Shader<'a>, &[Premultiplied16])> {
        Some((&self.lowest, self.tints.as_ref()?))
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
