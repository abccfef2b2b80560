//! What is left to be shaded in a tile once everything is painted, sorted by primitive.

use std::ops::Range;

use crate::color::Light;
use crate::raster::paint::visibility::packed::{PER_WORD, equal, lanes, splat};
pub(super) use crate::raster::sampling::mask::MASK_BITS;
use crate::raster::shading::context::PixelRun;
use crate::raster::surface_id::SurfaceId;

/// Some samples of one pixel that show one primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fragment {
    /// The sample that the lowest bit of the mask stands for: row by row, 64 of them.
    pub(crate) first: u16,
    /// The pixel's index among those that wait for their sums.
    pub(crate) pixel: u32,
    pub(crate) mask: u64,
}

/// The pixels of a tile that wait for something to be shaded.
#[derive(Debug, Default)]
pub(crate) struct ShadingQueue {
    /// The places of split ones, counted from the tile's first pixel.
    pub(crate) places: Vec<[u16; 2]>,
    /// The sums of their samples as far as they are known, or of their samples' light.
    pub(crate) sums: Vec<[u32; 4]>,
    pub(crate) lights: Vec<Light>,
    found: Found,
    pub(crate) sorted: Sorted,
    /// The parts of the pixel at work.
    parts: Vec<(SurfaceId, u16, u64)>,
}

/// The pixels of a tile that several surfaces share: their places, and what their samples add up to as far as it is known.
#[derive(Debug)]
pub(crate) struct SharedPixels<'q> {
    pub(crate) places: &'q [[u16; 2]],
    pub(crate) sums: &'q mut [[u32; 4]],
    pub(crate) lights: &'q mut [Light],
}

/// What is to be shaded, as it was found, row by row, each with the primitive that it shows.
#[derive(Debug, Default)]
struct Found {
    /// Pixels that show nothing else.
    runs: Vec<(SurfaceId, PixelRun)>,
    fragments: Vec<(SurfaceId, Fragment)>,
}

/// The same in the order of surfaces, and of each surface as it was found.
#[derive(Debug, Default)]
pub(crate) struct Sorted {
    runs: BySurface<PixelRun>,
    fragments: BySurface<Fragment>,
}

/// All that is to be shaded of one primitive.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ToShade<'q> {
    pub(crate) surface: SurfaceId,
    /// Pixels of which all samples show it.
    pub(crate) runs: &'q [PixelRun],
    pub(crate) fragments: &'q [Fragment],
}

/// Things in the order of their surfaces.
#[derive(Debug)]
struct BySurface<T> {
    sorted: Vec<T>,
    /// Where those of each surface begin.
    starts: Vec<u32>,
}

impl ShadingQueue {
    /// Forgets everything.
    pub(crate) fn clear(&mut self) {
        self.places.clear();
        self.sums.clear();
        self.lights.clear();
        self.found.runs.clear();
        self.found.fragments.clear();
    }

    /// Whether nothing waits.
    pub(crate) fn is_empty(&self) -> bool {
        self.found.runs.is_empty() && self.found.fragments.is_empty() && self.places.is_empty()
    }

    /// All samples of pixels side by side show the primitive of `surface`.
    #[inline]
    pub(crate) fn whole(&mut self, surface: SurfaceId, row: u16, columns: Range<usize>) {
        // No tile is so wide.
        let [start, end] = [columns.start, columns.end].map(|column| u16::try_from(column).unwrap_or(u16::MAX));
        self.found.runs.push((surface, PixelRun { row, start, end }));
    }

    /// The samples of the pixel at `place` show these surfaces, row by row; as [`ShadingQueue::parts`].
    #[inline]
    pub(crate) fn split(
        &mut self,
        place: [u16; 2],
        samples: impl Iterator<Item = SurfaceId>,
        take: impl FnMut(SurfaceId, u32) -> bool,
    ) {
        let mut parts = std::mem::take(&mut self.parts);
        parts.clear();
        for (i, surface) in samples.enumerate() {
            let (first, bit) = (i / MASK_BITS * MASK_BITS, 1 << (i % MASK_BITS));
            let first = u16::try_from(first).unwrap_or(u16::MAX);
            match parts.iter_mut().rev().find(|part| part.0 == surface && part.1 == first) {
                Some(part) => part.2 |= bit,
                None => parts.push((surface, first, bit)),
            }
        }
        self.parts(place, parts.iter().copied(), take);
        self.parts = parts;
    }

    /// The same where each of these words holds a row of samples, as many as there are rows.
    #[inline]
    pub(crate) fn split_rows(&mut self, place: [u16; 2], rows: &[u64], take: impl FnMut(SurfaceId, u32) -> bool) {
        let side = rows.len();
        debug_assert!((1..=PER_WORD).contains(&side), "a row of samples is a word");
        let of_row = (1 << side) - 1;
        let mut rest = u64::MAX >> (64 - side * side);
        let parts = std::iter::from_fn(|| {
            let first = rest.trailing_zeros() as usize;
            let surface = lanes(*rows.get(first / side)?)[first % side];
            let all = splat(surface);
            let mut mask = 0;
            for (word, shift) in rows.iter().zip((0..).step_by(side)) {
                mask |= (equal(*word, all) & of_row) << shift;
            }
            rest &= !mask;
            Some((surface, 0, mask))
        });
        self.parts(place, parts, take);
    }

    /// The samples of the pixel at `place` show these surfaces: for each part the surface, the sample that the lowest bit of the
    /// mask stands for, and the mask. What is flat is not to be shaded: `take` is told how many samples show a surface, and says
    /// whether it took them.
    #[inline]
    pub(crate) fn parts(
        &mut self,
        place: [u16; 2],
        parts: impl Iterator<Item = (SurfaceId, u16, u64)>,
        mut take: impl FnMut(SurfaceId, u32) -> bool,
    ) {
        let pixel = u32::try_from(self.places.len()).unwrap_or(u32::MAX);
        for (surface, first, mask) in parts {
            if !take(surface, mask.count_ones()) {
                self.found.fragments.push((surface, Fragment { first, pixel, mask }));
            }
        }
        self.places.push(place);
    }

    /// Sorts everything by surface, of which there are `surfaces`.
    pub(crate) fn sort(&mut self, surfaces: usize) {
        self.sorted.runs.sort(&self.found.runs, surfaces);
        self.sorted.fragments.sort(&self.found.fragments, surfaces);
    }
}

impl Sorted {
    /// What is to be shaded of each surface of which anything is.
    pub(crate) fn by_surface(&self) -> impl Iterator<Item = ToShade<'_>> + '_ {
        let surfaces = self.runs.starts.len().saturating_sub(1);
        let all = (0..=SurfaceId::MAX).take(surfaces).map(|surface| ToShade {
            surface,
            runs: self.runs.of(surface),
            fragments: self.fragments.of(surface),
        });
        all.filter(|of| !of.runs.is_empty() || !of.fragments.is_empty())
    }
}

impl<T> Default for BySurface<T> {
    fn default() -> Self {
        Self {
            sorted: Vec::new(),
            starts: Vec::new(),
        }
    }
}

impl<T: Copy> BySurface<T> {
    /// A counting sort.
    fn sort(&mut self, found: &[(SurfaceId, T)], surfaces: usize) {
        self.starts.clear();
        self.starts.resize(surfaces + 1, 0);
        for (surface, _) in found {
            self.starts[usize::from(*surface)] += 1;
        }
        let mut next = 0;
        for start in &mut self.starts {
            next += *start;
            *start = next;
        }
        self.sorted.clear();
        self.sorted.extend(found.iter().map(|(_, one)| *one));
        // From the last one down, so that each surface's end becomes its start.
        for (surface, one) in found.iter().rev() {
            let place = &mut self.starts[usize::from(*surface)];
            *place -= 1;
            self.sorted[*place as usize] = *one;
        }
    }

    /// Those of one surface.
    #[inline]
    fn of(&self, surface: SurfaceId) -> &[T] {
        let surface = usize::from(surface);
        &self.sorted[self.starts[surface] as usize..self.starts[surface + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::paint::visibility::packed::joined;

    #[test]
    fn sort_keeps_the_order_inside_a_surface() {
        let mut unresolved = ShadingQueue::default();
        for (surface, row) in [3, 1, 3, 0, 1, 3].into_iter().zip(0..) {
            unresolved.whole(surface, row, 0..5);
        }
        unresolved.sort(5);
        let found: Vec<(SurfaceId, Vec<u16>)> = unresolved
            .sorted
            .by_surface()
            .map(|of| (of.surface, of.runs.iter().map(|run| run.row).collect()))
            .collect();
        assert_eq!(
            found,
            [(0, vec![3]), (1, vec![1, 4]), (3, vec![0, 2, 5])],
            "surfaces without anything are left out"
        );
    }

    #[test]
    fn split_gathers_samples_by_primitive() {
        let mut unresolved = ShadingQueue::default();
        let samples = (0..256).map(|i| if i % 2 == 0 { 7 } else { 1 + SurfaceId::from(i >= 128) });
        let mut flat = 0;
        unresolved.split([4, 2], samples, |surface, count| {
            flat += if surface == 7 { count } else { 0 };
            surface == 7
        });
        assert_eq!(flat, 128, "half of the samples are flat");
        let mask = 0xAAAA_AAAA_AAAA_AAAA;
        let expected =
            [(1, 0), (1, 64), (2, 128), (2, 192)].map(|(surface, first)| (surface, Fragment { first, pixel: 0, mask }));
        let found = &unresolved.found.fragments;
        assert_eq!(*found, expected, "the others are to be shaded, 64 at a time");
    }

    #[test]
    fn rows_of_words_are_split_as_samples_are() {
        arbtest::arbtest(|u| {
            let side = u.int_in_range(1..=PER_WORD)?;
            let mut word = || -> arbtest::arbitrary::Result<[SurfaceId; PER_WORD]> {
                let mut surface = || u.int_in_range(0..=3);
                Ok([surface()?, surface()?, surface()?, surface()?])
            };
            let rows = (0..side)
                .map(|_| word())
                .collect::<arbtest::arbitrary::Result<Vec<_>>>()?;
            let words: Vec<u64> = rows.iter().map(|row| joined(*row)).collect();
            let (mut by_rows, mut by_samples) = (ShadingQueue::default(), ShadingQueue::default());
            let take = |surface: SurfaceId, _: u32| surface == 2;
            by_rows.split_rows([7, 3], &words, take);
            by_samples.split([7, 3], rows.iter().flat_map(|row| &row[..side]).copied(), take);
            assert_eq!(by_rows.places, by_samples.places, "the pixel");
            let [found, expected] = [&by_rows, &by_samples].map(|queue| &queue.found.fragments);
            assert_eq!(found, expected, "{rows:?}");
            Ok(())
        })
        .budget_ms(200);
    }
}
