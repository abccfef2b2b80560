//! Reading a ripmap: levels of one height are mixed along `u`, then both heights along `v`.

use super::bilinear;
use super::filter_plan::PixelList;
use super::fixed_point::MASS;
use super::{
    Filter, LevelChoice, PixelSampling, Ripmap, SampleGrid, SamplingSettings, Taps, TextureReads, UvMap, Wrap,
};
use crate::color::Premultiplied16;
use crate::simd::Level;

/// What gives the colours of samples; see [`Filter`].
pub(super) trait ReadSamples {
    fn points(&self, simd: Level, grid: SampleGrid, points: &[[u16; 2]], out: &mut [Premultiplied16]);
    fn sums(&self, simd: Level, grid: SampleGrid, list: PixelList<'_>, sums: &mut [[u32; 4]]);
    fn reads(&self, grid: SampleGrid, point: [u16; 2]) -> TextureReads;
}

/// One of them, or two that are mixed.
#[derive(Debug)]
pub(super) struct Mixed<T> {
    first: T,
    /// The second with its part of [`MASS`].
    second: Option<(T, i32)>,
}

/// Levels of one height, and of the next one.
pub(super) type RipmapFilter<'a> = Mixed<Mixed<Filter<'a>>>;

impl<'a> RipmapFilter<'a> {
    /// Prepares reading the levels that are chosen along `u` and along `v`.
    pub(super) fn new(
        ripmap: &'a Ripmap,
        map: &UvMap,
        settings: &SamplingSettings,
        [along_u, along_v]: [LevelChoice; 2],
    ) -> Self {
        let mass = bilinear::mass(along_u.next_weight);
        // The sums of samples that fetch one texel each are found quickly.
        let is_fetched = settings.pixel == PixelSampling::Nearest && settings.wrap == Wrap::Clamp;
        let of_height = |height: usize| {
            let (wide, narrow) = ripmap.mixed(along_u, height);
            let filter = |levels| Filter::of_levels(map, settings, Taps::ONE, levels);
            let (levels, second) = match (mass, narrow) {
                (MASS, Some(narrow)) => ((narrow, None), None),
                (0, _) | (_, None) => ((wide, None), None),
                (_, Some(narrow)) if is_fetched => ((wide, None), Some((filter((narrow, None)), mass))),
                (_, Some(narrow)) => ((wide, Some((narrow, mass))), None),
            };
            Mixed {
                first: filter(levels),
                second,
            }
        };
        let next = bilinear::mass(along_v.next_weight);
        Self {
            first: of_height(along_v.level),
            second: (next > 0).then(|| (of_height(along_v.level + 1), next)),
        }
    }
}

impl ReadSamples for Filter<'_> {
    fn points(&self, simd: Level, grid: SampleGrid, points: &[[u16; 2]], out: &mut [Premultiplied16]) {
        Filter::points(self, simd, grid, points, out);
    }

    fn sums(&self, simd: Level, grid: SampleGrid, list: PixelList<'_>, sums: &mut [[u32; 4]]) {
        Filter::sums(self, simd, grid, list, sums);
    }

    fn reads(&self, grid: SampleGrid, point: [u16; 2]) -> TextureReads {
        Filter::reads(self, grid, point)
    }
}

impl<T: ReadSamples> ReadSamples for Mixed<T> {
    fn points(&self, simd: Level, grid: SampleGrid, points: &[[u16; 2]], out: &mut [Premultiplied16]) {
        self.first.points(simd, grid, points, out);
        if let Some((second, mass)) = &self.second {
            let mut others = vec![Premultiplied16::TRANSPARENT; points.len()];
            second.points(simd, grid, points, &mut others);
            for (color, other) in out.iter_mut().zip(others) {
                *color = mixed(*color, other, *mass);
            }
        }
    }

    fn sums(&self, simd: Level, grid: SampleGrid, list: PixelList<'_>, sums: &mut [[u32; 4]]) {
        self.first.sums(simd, grid, list, sums);
        if let Some((second, mass)) = &self.second {
            let mut others = vec![[0; 4]; sums.len()];
            second.sums(simd, grid, list, &mut others);
            for (sum, other) in sums.iter_mut().zip(others) {
                *sum = std::array::from_fn(|i| mixed_sum(sum[i], other[i], *mass));
            }
        }
    }

    fn reads(&self, grid: SampleGrid, point: [u16; 2]) -> TextureReads {
        let mut reads = self.first.reads(grid, point);
        if let Some((second, mass)) = &self.second {
            let part = f64::from(*mass) / f64::from(MASS);
            let mut others = second.reads(grid, point);
            reads.texels.iter_mut().for_each(|texel| texel.weight *= 1.0 - part);
            others.texels.iter_mut().for_each(|texel| texel.weight *= part);
            reads.texels.extend(others.texels);
            reads.taps.extend(others.taps);
        }
        reads
    }
}

/// Two colours mixed, `mass` of [`MASS`] of the second.
#[inline]
fn mixed(first: Premultiplied16, second: Premultiplied16, mass: i32) -> Premultiplied16 {
    let channel = |i: usize| {
        let sum = mixed_sum(u32::from(first.0[i]), u32::from(second.0[i]), mass);
        u16::try_from(sum).unwrap_or(Premultiplied16::ONE)
    };
    Premultiplied16(std::array::from_fn(channel))
}

/// The same of sums of colours.
#[inline]
fn mixed_sum(first: u32, second: u32, mass: i32) -> u32 {
    let [mass, whole] = [mass, MASS].map(|mass| u64::from(mass.cast_unsigned()));
    let sum = u64::from(first) * (whole - mass) + u64::from(second) * mass + whole / 2;
    u32::try_from(sum / whole).unwrap_or(u32::MAX)
}
