//! What samples that are shaded and rounded one by one are averaged with, and the memory for it: `resolve_by_samples` uses it.

use crate::color::{Light, LightResolver, Premultiplied16, ResolveSpace, Resolver};
use crate::raster::paint::visibility::shading_queue::{Fragment, Part};
use crate::raster::sampling::positions::{Position, SamplePositions};
use crate::raster::shading::Shader;
use crate::raster::shading::context::ShadeContext;
use crate::texture::SampleGrid;

/// What samples are averaged with, and memory.
#[derive(Debug)]
pub(super) struct BySamples {
    pub(super) positions: SamplePositions,
    /// Whether the positions are those of the grid.
    is_grid: bool,
    pub(super) mean: Mean,
    /// The light of surfaces.
    pub(super) lights: Vec<Light>,
    /// The samples of pixels that several primitives share.
    pub(super) shared: Vec<Premultiplied16>,
    pub(super) shades: SampleShades,
}

/// The samples of some fragments of a primitive.
#[derive(Debug, Default)]
pub(super) struct SampleShades {
    pub(super) points: Vec<[u16; 2]>,
    pub(super) colors: Vec<Premultiplied16>,
    /// The positions of samples, where they are the same in every pixel.
    same: Vec<[u16; 2]>,
    memory: Vec<Position>,
}

/// How samples are averaged.
#[derive(Clone, Copy, Debug)]
pub(super) enum Mean {
    Stored(Resolver),
    Linear(LightResolver),
}

impl Mean {
    #[inline]
    pub(super) fn pixel(&self, samples: &[Premultiplied16]) -> u32 {
        match self {
            Self::Stored(resolver) => resolver.pixel(Premultiplied16::sums(samples)),
            Self::Linear(resolver) => resolver.mean(samples),
        }
    }

    /// The same of opaque samples.
    #[inline]
    pub(super) fn opaque_pixel(&self, samples: &[Premultiplied16]) -> u32 {
        match self {
            Self::Stored(resolver) => resolver.pixel(Premultiplied16::sums(samples)),
            Self::Linear(resolver) => resolver.opaque_mean(samples),
        }
    }
}

impl BySamples {
    pub(super) fn new(context: &ShadeContext<'_>, positions: SamplePositions) -> Self {
        let side = context.rate.side();
        let rules = context.sampling.rules;
        let same = if positions.are_same() {
            let places = positions.of_pixel([0; 2], &mut Vec::new()).to_vec();
            places.into_iter().map(|place| place.map(u16::from)).collect()
        } else {
            Vec::new()
        };
        Self {
            positions,
            is_grid: context.grid.side().cast_unsigned() == side,
            mean: match context.space {
                // The mean of one sample is that sample in either.
                ResolveSpace::Linear if side > 1 => Mean::Linear(LightResolver::new(side * side, rules)),
                _ => Mean::Stored(Resolver::new(side * side, rules)),
            },
            lights: Vec::new(),
            shared: Vec::new(),
            shades: SampleShades {
                same,
                ..SampleShades::default()
            },
        }
    }

    /// Whether light is averaged.
    pub(super) fn is_linear(&self) -> bool {
        matches!(self.mean, Mean::Linear(_))
    }

    /// Whether tiles in which anything is shaded are resolved here.
    pub(super) fn is_meant(&self) -> bool {
        self.is_linear() || !self.is_grid
    }
}

impl SampleShades {
    /// Adds the samples of a fragment of a tile whose samples `grid` counts.
    #[inline]
    pub(super) fn gather(
        &mut self,
        fragment: &Fragment,
        places: &[[u16; 2]],
        positions: &SamplePositions,
        grid: SampleGrid,
    ) {
        let place = match fragment.part {
            Part::Whole { place } => place,
            Part::Masked { pixel, .. } => places[pixel as usize],
        };
        let pixel = [0, 1].map(|i| grid.origin[i] + i32::from(place[i]));
        // No tile has more than `2^14` points of a lattice along a side.
        let [left, top] = place.map(|at| u16::try_from(u32::from(at) * grid.side).unwrap_or(u16::MAX));
        let first = self.points.len();
        match fragment.part {
            Part::Whole { .. } if !self.same.is_empty() => self.points.extend_from_slice(&self.same),
            Part::Whole { .. } => {
                let of_pixel = positions.of_pixel(pixel, &mut self.memory);
                self.points.extend(of_pixel.iter().map(|place| place.map(u16::from)));
            }
            Part::Masked { first, mask, .. } => {
                let of_pixel = positions.of_pixel(pixel, &mut self.memory);
                let mut rest = mask;
                while rest != 0 {
                    let sample = usize::from(first) + rest.trailing_zeros() as usize;
                    self.points.push(of_pixel[sample].map(u16::from));
                    rest &= rest - 1;
                }
            }
        }
        for point in &mut self.points[first..] {
            *point = [point[0].wrapping_add(left), point[1].wrapping_add(top)];
        }
    }

    /// Shades the samples.
    pub(super) fn shade(&mut self, shader: &Shader<'_>, grid: SampleGrid) {
        let count = self.points.len();
        if self.colors.len() < count {
            self.colors.resize(count, Premultiplied16::TRANSPARENT);
        }
        let colors = &mut self.colors[..count];
        match shader.constant() {
            Some(color) => colors.fill(color),
            None => shader.points(grid, &self.points, colors),
        }
    }
}
