//! What is left to be shaded in a tile once everything is painted, sorted by primitive.

use std::ops::Range;

use crate::raster::surface_id::SurfaceId;

/// Which samples of a pixel show a primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    /// All of them: the pixel, counted from the tile's first.
    Whole { place: [u16; 2] },
    /// Some: the pixel's index among those that wait for their sums, and one bit per sample, row by row, of the 64
    /// samples from `first` on.
    Masked { pixel: u32, first: u16, mask: u64 },
}

/// The samples of one pixel that show one primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fragment {
    /// The primitive.
    pub(crate) surface: SurfaceId,
    pub(crate) part: Part,
}

/// Pixels side by side of which all samples show a primitive that has one colour along a row of samples.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct LevelRun {
    /// The primitive.
    pub(crate) surface: SurfaceId,
    /// Row and columns, counted from the tile's first pixel.
    pub(crate) row: u16,
    pub(crate) columns: Range<u16>,
}

/// The pixels of a tile that wait for something to be shaded.
#[derive(Debug, Default)]
pub(crate) struct ShadingQueue {
    /// The places of split ones, counted from the tile's first pixel.
    pub(crate) places: Vec<[u16; 2]>,
    /// The sums of their samples as far as they are known.
    pub(crate) sums: Vec<[u32; 4]>,
    found: Vec<Fragment>,
    /// Those that are alike along their row, and in none of the other lists.
    pub(crate) level: Vec<LevelRun>,
    pub(crate) sorted: SortedFragments,
    /// The parts of the pixel at work.
    parts: Vec<(SurfaceId, u16, u64)>,
}

/// Fragments in the order of their surfaces.
#[derive(Debug, Default)]
pub(crate) struct SortedFragments {
    fragments: Vec<Fragment>,
    /// Where the fragments of each surface begin.
    starts: Vec<u32>,
}

/// Samples that a mask has bits for.
const MASK_BITS: usize = 64;

impl ShadingQueue {
    /// Forgets everything.
    pub(crate) fn clear(&mut self) {
        self.places.clear();
        self.sums.clear();
        self.found.clear();
        self.level.clear();
    }

    /// Whether nothing waits.
    pub(crate) fn is_empty(&self) -> bool {
        self.found.is_empty() && self.places.is_empty() && self.level.is_empty()
    }

    /// All samples of the pixel at `place` show the primitive of `surface`.
    #[inline]
    pub(crate) fn whole(&mut self, surface: SurfaceId, place: [u16; 2]) {
        let part = Part::Whole { place };
        self.found.push(Fragment { surface, part });
    }

    /// All samples of pixels of a row show the primitive of `surface`, which has one colour along each row of samples.
    #[inline]
    pub(crate) fn level_run(&mut self, surface: SurfaceId, row: u16, columns: Range<usize>) {
        // No tile is so wide.
        let [start, end] = [columns.start, columns.end].map(|column| u16::try_from(column).unwrap_or(u16::MAX));
        self.level.push(LevelRun {
            surface,
            row,
            columns: start..end,
        });
    }

    /// The samples of the pixel at `place` show these surfaces, row by row; those with a colour in `flat` are known already.
    #[inline]
    pub(crate) fn split(
        &mut self,
        place: [u16; 2],
        samples: impl Iterator<Item = SurfaceId>,
        flat: impl Fn(SurfaceId) -> Option<[u32; 4]>,
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
        self.parts(place, parts.iter().copied(), flat);
        self.parts = parts;
    }

    /// The samples of the pixel at `place` show these surfaces: for each part the surface, the sample that the lowest bit of the
    /// mask stands for, and the mask.
    #[inline]
    pub(crate) fn parts(
        &mut self,
        place: [u16; 2],
        parts: impl Iterator<Item = (SurfaceId, u16, u64)>,
        flat: impl Fn(SurfaceId) -> Option<[u32; 4]>,
    ) {
        let pixel = u32::try_from(self.places.len()).unwrap_or(u32::MAX);
        let mut sums = [0; 4];
        for (surface, first, mask) in parts {
            match flat(surface) {
                None => self.found.push(Fragment {
                    surface,
                    part: Part::Masked { pixel, first, mask },
                }),
                Some(color) => {
                    for (sum, channel) in sums.iter_mut().zip(color) {
                        *sum += channel * mask.count_ones();
                    }
                }
            }
        }
        self.places.push(place);
        self.sums.push(sums);
    }

    /// Sorts the fragments by surface, of which there are `surfaces`.
    pub(crate) fn sort(&mut self, surfaces: usize) {
        // In a surface by row, as they were found.
        self.level.sort_by_key(|run| run.surface);
        self.sorted.sort(&self.found, surfaces);
    }
}

impl SortedFragments {
    /// A counting sort.
    fn sort(&mut self, found: &[Fragment], surfaces: usize) {
        self.starts.clear();
        self.starts.resize(surfaces + 1, 0);
        for fragment in found {
            self.starts[usize::from(fragment.surface)] += 1;
        }
        let mut next = 0;
        for start in &mut self.starts {
            next += *start;
            *start = next;
        }
        self.fragments.clear();
        self.fragments.extend_from_slice(found);
        // From the last one down, so that each surface's end becomes its start.
        for fragment in found.iter().rev() {
            let place = &mut self.starts[usize::from(fragment.surface)];
            *place -= 1;
            self.fragments[*place as usize] = *fragment;
        }
    }

    /// The fragments of each surface that has any, in the order in which they were added.
    pub(crate) fn by_surface(&self) -> impl Iterator<Item = &[Fragment]> + '_ {
        self.starts
            .windows(2)
            .map(|range| &self.fragments[range[0] as usize..range[1] as usize])
            .filter(|fragments| !fragments.is_empty())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sort_keeps_the_order_inside_a_surface() {
        let mut unresolved = ShadingQueue::default();
        for (surface, x) in [3, 1, 3, 0, 1, 3].into_iter().zip(0..) {
            unresolved.whole(surface, [x, 0]);
        }
        unresolved.sort(5);
        let found: Vec<Vec<Fragment>> = unresolved.sorted.by_surface().map(<[Fragment]>::to_vec).collect();
        let whole = |surface, x| Fragment {
            surface,
            part: Part::Whole { place: [x, 0] },
        };
        assert_eq!(
            found,
            [
                vec![whole(0, 3)],
                vec![whole(1, 1), whole(1, 4)],
                vec![whole(3, 0), whole(3, 2), whole(3, 5)]
            ],
            "surfaces without fragments are left out"
        );
    }

    #[test]
    fn split_gathers_samples_by_primitive() {
        let mut unresolved = ShadingQueue::default();
        let samples = (0..256).map(|i| if i % 2 == 0 { 7 } else { 1 + SurfaceId::from(i >= 128) });
        unresolved.split([4, 2], samples, |surface| (surface == 7).then_some([1, 2, 3, 4]));
        assert_eq!(unresolved.sums, [[128, 256, 384, 512]], "half of the samples are flat");
        let odd = 0xAAAA_AAAA_AAAA_AAAA;
        let parts: Vec<(SurfaceId, Part)> = unresolved
            .found
            .iter()
            .map(|found| (found.surface, found.part))
            .collect();
        let expected: Vec<(SurfaceId, Part)> = [(1, 0), (1, 64), (2, 128), (2, 192)]
            .map(|(surface, first)| {
                (
                    surface,
                    Part::Masked {
                        pixel: 0,
                        first,
                        mask: odd,
                    },
                )
            })
            .to_vec();
        assert_eq!(parts, expected, "the others are to be shaded, 64 at a time");
    }
}
