//! How much of each other two pixels beside an edge take.

use super::areas::{self, Areas, ONE};
use super::bits::{self, BAND, Words};
use super::diagonals::{Diagonal, Diagonals};
use super::edges::{Edges, LEFT, TOP};
use super::lines::{Axis, Line, LineWords};

/// Weights at the edges of a pixel, in parts of [`ONE`]: what the pixel takes of its neighbour there, and that of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Weights {
    pub(super) top: Areas,
    pub(super) left: Areas,
}

/// What lies at an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    /// Diagonals, of which there may be one that rises and one that falls.
    Diagonals([Option<Diagonal>; 2]),
    Line(Line),
}

/// The edges of 64 pixels of a row, and what is around them.
struct RowWord<'e> {
    edges: &'e Edges,
    word: usize,
    y: i32,
    sides: Words,
    diagonals: Diagonals<'e>,
    lines: LineWords,
}

impl Found {
    /// At the top edge of a pixel, through which diagonals go, if any do.
    pub(super) fn at_top(edges: &Edges, [x, y]: [i32; 2]) -> Self {
        let (word, bit) = bits::place(x);
        RowWord::new(edges, word, y).top(bit).0
    }
}

impl<'e> RowWord<'e> {
    /// Of word number `word` in row `y`.
    fn new(edges: &'e Edges, word: usize, y: i32) -> Self {
        Self {
            edges,
            word,
            y,
            sides: edges.rows.word(word, y),
            diagonals: Diagonals::new(edges, word, y),
            lines: LineWords::new(edges, Axis::Row, word, y),
        }
    }

    fn pixel(&self, bit: u32) -> [i32; 2] {
        [bits::along(self.word, bit), self.y]
    }

    /// The diagonals through the top edge of the pixel with this bit, and their weights, if there are any.
    #[inline]
    fn diagonals_at(&self, bit: u32) -> Option<([Option<Diagonal>; 2], Areas)> {
        let diagonals = self.diagonals.through(bit);
        let weights = diagonals_weights(diagonals);
        // Some patterns of diagonals cover nothing.
        (weights != [0; 2]).then_some((diagonals, weights))
    }

    /// What lies at the top edge of the pixel with this bit, and its weights.
    #[inline]
    fn top(&self, bit: u32) -> (Found, Areas) {
        if let Some((diagonals, weights)) = self.diagonals_at(bit) {
            return (Found::Diagonals(diagonals), weights);
        }
        let line = self.lines.line(bit);
        (Found::Line(line), line_weights(line))
    }

    /// The weights at the edges of the pixel with this bit.
    #[inline]
    fn weights(&self, bit: u32) -> Weights {
        let has = |side: usize| self.sides[side] >> bit & 1 != 0;
        let mut weights = Weights::default();
        if has(TOP) {
            let (found, top) = self.top(bit);
            weights.top = top;
            // A diagonal has taken care of both edges.
            if matches!(found, Found::Diagonals(_)) {
                return weights;
            }
        }
        if has(LEFT) {
            let column = Axis::Column.place(self.pixel(bit));
            weights.left = line_weights(Line::through(self.edges, Axis::Column, column));
        }
        weights
    }
}

#[inline]
fn line_weights(line: Line) -> Areas {
    let kept = line.kept_by_corners();
    let areas = areas::of_line(line);
    let weight = |side: usize| areas[side] - areas[side] / 8 * (8 - kept[side]);
    [weight(0), weight(1)]
}

fn diagonals_weights(diagonals: [Option<Diagonal>; 2]) -> Areas {
    let mut sum = [0; 2];
    for areas in diagonals.into_iter().flatten().map(areas::of_diagonal) {
        for (sum, area) in sum.iter_mut().zip(areas) {
            *sum = ONE.min(*sum + area);
        }
    }
    sum
}

impl Weights {
    /// At the edges of a pixel.
    pub(super) fn of(edges: &Edges, [x, y]: [i32; 2]) -> Self {
        let (word, bit) = bits::place(x);
        RowWord::new(edges, word, y).weights(bit)
    }
}

/// The weights at the top edges of a row of pixels, and where there are any.
#[derive(Debug)]
pub(super) struct TopWeights {
    pub(super) weights: Vec<Areas>,
    /// A bit for each that is any.
    pub(super) weighed: Vec<u64>,
}

impl TopWeights {
    /// Without any.
    pub(super) fn new(width: usize) -> Self {
        Self {
            weights: vec![[0; 2]; width],
            weighed: vec![0; width.div_ceil(64)],
        }
    }

    /// Takes those of row `y`, which may be the one below the last; calls `taken` with the columns in which a diagonal has
    /// taken care of the left edge, too.
    pub(super) fn fill(&mut self, edges: &Edges, y: i32, mut taken: impl FnMut(usize)) {
        let words = self.weighed.iter_mut().zip(self.weights.chunks_mut(64));
        for (word, (weighed, weights)) in (0..).zip(words) {
            if *weighed != 0 {
                weights.fill([0; 2]);
                *weighed = 0;
            }
            if edges.rows.word(word + 1, y)[TOP] == 0 {
                continue;
            }
            let row = RowWord::new(edges, word + 1, y);
            let mut put = |bit: u32, areas: Areas| {
                weights[bit as usize] = areas;
                *weighed = *weighed & !(1 << bit) | u64::from(areas != [0; 2]) << bit;
            };
            row.lines.for_each_line(|bit, line| put(bit, line_weights(line)));
            for bit in bits::ones(row.diagonals.candidates()) {
                if let Some((_, areas)) = row.diagonals_at(bit) {
                    put(bit, areas);
                    taken(word * 64 + bit as usize);
                }
            }
        }
    }
}

/// The weights at the left edges of a band of rows, and where there are any.
#[derive(Debug)]
pub(super) struct LeftWeights {
    /// Row by row, each longer than there are pixels.
    weights: Vec<Areas>,
    stride: usize,
    /// A bit for each that is any: a word of each row for the first 64 columns, then those of the next.
    weighed: Vec<[u64; BAND]>,
}

impl LeftWeights {
    /// Without any.
    pub(super) fn new(width: usize) -> Self {
        // With rows of a power of two a column would lie in the same few lines of a cache.
        let stride = width + 17;
        Self {
            weights: vec![[0; 2]; stride * BAND],
            stride,
            weighed: vec![[0; BAND]; width.div_ceil(64)],
        }
    }

    /// Takes those of a band.
    pub(super) fn fill(&mut self, edges: &Edges, band: usize) {
        let width = edges.size[0];
        for (first, weighed) in (0..width).step_by(64).zip(&mut self.weighed) {
            for (row, weighed) in weighed.iter_mut().enumerate() {
                if std::mem::take(weighed) != 0 {
                    let start = row * self.stride + first;
                    self.weights[start..row * self.stride + width.min(first + 64)].fill([0; 2]);
                }
            }
            for (column, weighed) in (first..width).zip(weighed.iter_mut()) {
                let at = i32::try_from(column).unwrap_or(i32::MAX);
                if edges.columns.word(band + 1, at)[LEFT] == 0 {
                    continue;
                }
                LineWords::new(edges, Axis::Column, band + 1, at).for_each_line(|bit, line| {
                    let areas = line_weights(line);
                    self.weights[bit as usize * self.stride + column] = areas;
                    *weighed |= u64::from(areas != [0; 2]) << bit;
                });
            }
            bits::turn(weighed);
        }
    }

    /// The weights in a row of the band, of one more than there are pixels.
    pub(super) fn row(&self, row: usize) -> &[Areas] {
        &self.weights[row * self.stride..][..self.stride]
    }

    /// Which of the 64 pixels of a word in that row may have any.
    pub(super) fn weighed(&self, word: usize, row: usize) -> u64 {
        self.weighed[word][row]
    }

    /// Lets a pixel have none.
    pub(super) fn clear(&mut self, column: usize, row: usize) {
        self.weights[row * self.stride + column] = [0; 2];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 200;
    const HEIGHT: usize = 150;

    /// Pictures of two greys: stairs of all lengths, diagonals, long lines, and noise.
    fn pictures() -> impl Iterator<Item = Vec<u32>> {
        let shapes: [fn(usize, usize) -> bool; 6] = [
            |x, y| y * 7 > x + 200,
            |x, y| x > 60 + y / 40,
            |x, y| (x + y) % 23 < 9,
            |x, y| (x * x / 40 + y * y / 9) % 37 < 15,
            |x, y| {
                (x as u64 * 0x9E37 + y as u64 * 0x79B9)
                    .wrapping_mul(0x7F4A_7C15_F39C_C060)
                    .leading_zeros()
                    == 0
            },
            |x, y| y % 50 == 3 && x % 90 > 4 || x == 130 && y % 71 > 2,
        ];
        shapes.into_iter().map(|is_black| {
            let places = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
            places
                .map(|(x, y)| if is_black(x, y) { 0xFF00_0000 } else { 0xFFC0_C0C0 })
                .collect()
        })
    }

    #[test]
    fn weights_of_whole_bands_are_those_of_each_pixel() {
        for (picture, pixels) in pictures().enumerate() {
            let edges = Edges::new(&pixels, [WIDTH, HEIGHT]);
            let (mut left, mut top) = (LeftWeights::new(WIDTH), TopWeights::new(WIDTH));
            let mut weighed = 0;
            for band in 0..HEIGHT.div_ceil(BAND) {
                left.fill(&edges, band);
                for row in 0..BAND.min(HEIGHT - band * BAND) {
                    let y = i32::try_from(band * BAND + row).expect("small");
                    top.fill(&edges, y, |x| left.clear(x, row));
                    for x in 0..WIDTH {
                        let at = [i32::try_from(x).expect("small"), y];
                        let found = Weights {
                            top: top.weights[x],
                            left: left.row(row)[x],
                        };
                        assert_eq!(found, Weights::of(&edges, at), "picture {picture} at {at:?}");
                        let bit = |word: u64| word >> (x % 64) & 1 != 0;
                        assert_eq!(bit(top.weighed[x / 64]), found.top != [0; 2], "{picture} at {at:?}");
                        let may_be = bit(left.weighed(x / 64, row));
                        assert!(may_be || found.left == [0; 2], "{picture} at {at:?}");
                        weighed += usize::from(found != Weights::default());
                    }
                }
            }
            assert!(weighed > 20, "{picture} shows {weighed} pixels that blend");
        }
    }
}
