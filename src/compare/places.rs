//! The places where two pictures differ most: to jump from one to the next.

use rayon::prelude::*;

use super::Pair;
use super::levels::channel_levels;

/// Side in pixels of the blocks of which each gives one place, so that the next place is not just the next pixel.
const BLOCK: usize = 16;

/// A pixel that differs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Column and row.
    pub at: [u32; 2],
    /// How far red, green, blue and alpha are apart, in levels of 255.
    pub levels: [u8; 4],
}

impl Place {
    /// The largest of its channels' differences, in levels.
    pub fn largest(self) -> u8 {
        self.levels.into_iter().max().unwrap_or(0)
    }

    /// What places are sorted by: the largest channel first, then all channels together.
    fn rank(self) -> (u8, u16) {
        (self.largest(), self.levels.into_iter().map(u16::from).sum())
    }
}

impl Pair<'_> {
    /// The pixels that differ most, at most one from each block of 16 x 16 pixels and at most `count` in all. They are
    /// sorted by their largest channel, then by the sum over channels, then in reading order, so the first is the
    /// pixel of the whole picture that differs most. Empty for equal pictures.
    pub fn places(self, count: usize) -> Vec<Place> {
        let width = self.a.width() as usize;
        let length = (width * BLOCK).max(1);
        let bands = self
            .a
            .pixels()
            .par_chunks(length)
            .zip(self.b.pixels().par_chunks(length));
        let mut places: Vec<Place> = bands
            .enumerate()
            .flat_map_iter(|(i, (a, b))| band(a, b, width, i * BLOCK))
            .collect();
        places.par_sort_by_key(|place| (std::cmp::Reverse(place.rank()), place.at[1], place.at[0]));
        places.truncate(count);
        places
    }
}

/// The best place of each block in a band of rows, of which the first is `top`.
fn band(a: &[u32], b: &[u32], width: usize, top: usize) -> Vec<Place> {
    let mut best: Vec<Option<Place>> = vec![None; width.div_ceil(BLOCK)];
    for (row, (a, b)) in a.chunks_exact(width).zip(b.chunks_exact(width)).enumerate() {
        for (column, (a, b)) in a.iter().zip(b).enumerate().filter(|(_, (a, b))| a != b) {
            let place = Place {
                at: [column, top + row].map(|side| u32::try_from(side).unwrap_or(u32::MAX)),
                levels: channel_levels(*a, *b),
            };
            let best = &mut best[column / BLOCK];
            if best.is_none_or(|best| place.rank() > best.rank()) {
                *best = Some(place);
            }
        }
    }
    best.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::Framebuffer;

    #[test]
    fn places_come_largest_first_one_per_block() {
        let mut a = Framebuffer::new(40, 20);
        a.pixels_mut().fill(0xFF00_0000);
        let mut b = a.clone();
        for (x, y, pixel) in [
            (3, 2, 0x0000_0005),
            (4, 2, 0x0000_0004),
            (39, 19, 0x0009_0000),
            (20, 0, 0x0005_0100),
            (16, 15, 0x0000_0900),
            (15, 17, 0x0000_0900),
        ] {
            b.pixels_mut()[y * 40 + x] |= pixel;
        }
        let pair = Pair::new(&a, &b).expect("one size");
        let at: Vec<[u32; 2]> = pair.places(10).iter().map(|place| place.at).collect();
        assert_eq!(
            at,
            [[16, 15], [15, 17], [39, 19], [3, 2]],
            "equal ones in reading order; (4, 2) and (20, 0) share their blocks with larger ones"
        );
        assert_eq!(pair.places(1).len(), 1, "no more than asked for");
        assert_eq!(
            pair.places(1)[0].largest(),
            pair.levels().largest_level(),
            "the largest"
        );
        assert!(Pair::new(&a, &a).expect("one size").places(9).is_empty(), "nowhere");
        let none = Framebuffer::new(0, 5);
        assert!(
            Pair::new(&none, &none).expect("one size").places(9).is_empty(),
            "no pixels"
        );
    }
}
