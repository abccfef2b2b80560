//! What shaders are asked about: a drawing, and samples and pixels of a tile.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, u16x16, u32x8};

use crate::color::{Premultiplied16, ResolveSpace, Resolver};
use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::resolve::SizedFilter;
use crate::raster::sampling::place_sums::PlaceSums;
use crate::raster::sampling::positions::Position;
use crate::raster::shading::sources::PaintSources;
use crate::raster::{SampleRate, ShadingRate};
use crate::simd;
use crate::texture::{SampleGrid, SamplingSettings};

/// What shading needs to know besides the triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadeContext<'a> {
    pub(crate) grid: SubpixelGrid,
    /// Samples per pixel.
    pub(crate) rate: SampleRate,
    /// What each of them weighs in its pixel, and in which values they are averaged.
    pub(crate) filter: SizedFilter,
    pub(crate) space: ResolveSpace,
    /// How often a primitive is shaded in a pixel.
    pub(crate) shading: ShadingRate,
    pub(crate) sampling: SamplingSettings,
    /// What becomes of pixels by how far they were clamped, where that is shown.
    pub(crate) clamped: Option<fn([f64; 2], u32) -> u32>,
    pub(crate) sources: &'a PaintSources<'a>,
}

/// Pixels side by side in a row of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PixelRun {
    /// Row and columns, counted from the tile's first pixel; the last column lies just after the run.
    pub(crate) row: u16,
    pub(crate) start: u16,
    pub(crate) end: u16,
}

/// Some pixels of a tile, counted from the first pixel of the grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pixels<'p> {
    pub(crate) grid: SampleGrid,
    pub(crate) places: &'p [[u16; 2]],
}

/// All samples of some pixels, whose places in their pixels are those of a pattern.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedPixels<'p> {
    pub(crate) pixels: Pixels<'p>,
    /// Samples per pixel.
    pub(crate) count: usize,
    /// Where those of each pixel lie, one pixel after the other; only once where that is the same in all.
    pub(crate) inside: &'p [Position],
    /// Flat colours that are painted over them, in that order.
    pub(crate) tints: &'p [Premultiplied16],
}

/// All samples of some pixels, of whose places no more is known than where their means are; or also those of pixels around them, with
/// weights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoundedPixels<'p> {
    pub(crate) pixels: Pixels<'p>,
    /// Between what the mean column of the samples of each pixel lies, and the mean row; of weighted samples that of their weights.
    pub(crate) mean_range: [f64; 2],
    /// So many pixels on each side have samples that count, too.
    pub(crate) margin: u32,
    /// What the weights of all samples add up to without their signs, in parts of what they do with these.
    pub(crate) unsigned: f64,
    /// Flat colours that are painted over them, in that order.
    pub(crate) tints: &'p [Premultiplied16],
}

/// Some samples of some pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedParts<'p> {
    pub(crate) pixels: Pixels<'p>,
    /// What the places of the samples of each add up to.
    pub(crate) sums: &'p [PlaceSums],
    /// Flat colours that are painted over them, in that order.
    pub(crate) tints: &'p [Premultiplied16],
}

/// Some samples of some pixels, by their numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MaskedPixels<'p> {
    pub(crate) pixels: Pixels<'p>,
    /// For each pixel a bit for each of its 64 samples from `first` on.
    pub(crate) masks: &'p [u64],
    pub(crate) first: u32,
}

/// Where sums of samples go: those of all samples of some pixels, and of some samples of others.
#[derive(Debug)]
pub(crate) struct Wanted<'p> {
    pub(crate) sums: [&'p mut [[u32; 4]]; 2],
    /// What makes pixels of the former, which are opaque, and where these may go instead.
    pub(crate) means: Option<(&'p Resolver, &'p mut [u32])>,
}

/// A single sample of the frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadedSample {
    /// Whose origin is the sample's pixel.
    pub(crate) grid: SampleGrid,
    /// Its column and row in the pixel.
    pub(crate) place: [u16; 2],
}

impl ShadeContext<'_> {
    /// The same on another grid of the same units, on which every sample that is asked for is shaded.
    pub(crate) fn on(self, grid: SubpixelGrid) -> Self {
        let shading = ShadingRate::Sample;
        Self { grid, shading, ..self }
    }

    /// The samples of a tile whose first pixel is `origin`.
    pub(crate) fn samples_from(&self, origin: [i32; 2]) -> SampleGrid {
        SampleGrid {
            side: self.grid.side().cast_unsigned(),
            origin,
        }
    }
}

impl PixelRun {
    /// The columns of its pixels.
    #[inline]
    pub(crate) fn columns(self) -> Range<u16> {
        self.start..self.end
    }

    /// How many pixels these are.
    #[inline]
    pub(crate) fn len(self) -> usize {
        usize::from(self.end - self.start)
    }

    /// The places of its pixels.
    #[inline]
    pub(crate) fn places(self) -> impl ExactSizeIterator<Item = [u16; 2]> {
        let row = self.row;
        self.columns().map(move |column| [column, row])
    }

    /// Adds the places of the pixels of all these runs, one after the other.
    pub(crate) fn add_places(runs: &[Self], places: &mut Vec<[u16; 2]>) {
        dispatch!(simd::level(), simd => add_places(simd, runs, places));
    }

    /// The places of the pixels of all these runs.
    pub(crate) fn all_places(runs: &[Self]) -> Vec<[u16; 2]> {
        let mut places = Vec::new();
        Self::add_places(runs, &mut places);
        places
    }

    /// The place of the first one.
    #[inline]
    pub(crate) fn first(self) -> [u16; 2] {
        [self.start, self.row]
    }
}

/// Pixels of a run whose places are found together: most runs are so short that it takes longer to count than to take back those that
/// are too many.
const TOGETHER: usize = 8;

/// [`PixelRun::add_places`].
#[inline(always)]
fn add_places<S: Simd>(simd: S, runs: &[PixelRun], places: &mut Vec<[u16; 2]>) {
    const STEPS: [u32; TOGETHER] = [0, 1, 2, 3, 4, 5, 6, 7];
    const NEXT: u32 = STEPS[TOGETHER - 1] + 1;
    let mut next = places.len();
    let count: usize = runs.iter().map(|run| run.len()).sum();
    let end = next + count;
    places.resize(end + TOGETHER, [0; 2]);
    for PixelRun { row, start, end } in runs {
        let last = next + usize::from(end - start);
        let mut eight = u32x8::simd_from(simd, STEPS) + (u32::from(*start) | u32::from(*row) << 16);
        while next < last {
            if let Some(places) = places[next..].first_chunk_mut::<TOGETHER>() {
                eight.bitcast::<u16x16<S>>().store_slice(places.as_flattened_mut());
            }
            eight += NEXT;
            next += TOGETHER;
        }
        next = last;
    }
    places.truncate(end);
}

impl<'p> PlacedPixels<'p> {
    /// Whether samples lie at the same places in all pixels.
    pub(crate) fn are_same(&self) -> bool {
        self.inside.len() == self.count
    }

    /// Where the samples of pixel `i` of the list lie in it.
    #[inline]
    pub(crate) fn inside(&self, i: usize) -> &'p [Position] {
        if self.are_same() {
            self.inside
        } else {
            &self.inside[i * self.count..][..self.count]
        }
    }

    /// Some that follow each other in the list.
    pub(crate) fn part(self, range: Range<usize>) -> Self {
        let inside = if self.are_same() {
            self.inside
        } else {
            &self.inside[range.start * self.count..range.end * self.count]
        };
        let pixels = self.pixels.part(range);
        Self { pixels, inside, ..self }
    }
}

impl PlacedParts<'_> {
    /// Some that follow each other in the list.
    pub(crate) fn part(self, range: Range<usize>) -> Self {
        Self {
            pixels: self.pixels.part(range.clone()),
            sums: &self.sums[range],
            ..self
        }
    }
}

impl<'p> BoundedPixels<'p> {
    /// Of pixels whose own samples alone count, all alike.
    pub(crate) fn new(pixels: Pixels<'p>, mean_range: [f64; 2], tints: &'p [Premultiplied16]) -> Self {
        Self {
            pixels,
            mean_range,
            margin: 0,
            unsigned: 1.0,
            tints,
        }
    }
}

impl<'p> Pixels<'p> {
    /// Some that follow each other in the list.
    pub(crate) fn part(self, range: Range<usize>) -> Self {
        Self {
            places: &self.places[range],
            ..self
        }
    }

    /// Of each pixel those samples that its mask names, of the 64 from `first` on.
    pub(crate) fn masked(self, masks: &'p [u64], first: u32) -> MaskedPixels<'p> {
        MaskedPixels {
            pixels: self,
            masks,
            first,
        }
    }
}

impl ShadedSample {
    /// Its column and row in the frame.
    pub(crate) fn in_frame(self) -> [i32; 2] {
        let side = self.grid.side.cast_signed();
        [0, 1].map(|i| self.grid.origin[i] * side + i32::from(self.place[i]))
    }

    /// Where it lies, in samples.
    pub(crate) fn position(self) -> [f64; 2] {
        self.in_frame().map(|at| f64::from(at) + 0.5)
    }
}
