//! How much of each other two pixels beside an edge take.

use super::areas::{self, Areas, ONE};
use super::bits::{self, Words};
use super::diagonals::{self, Diagonal};
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
    /// Where a diagonal may rise, and where one may fall.
    diagonals: [u64; 2],
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
            diagonals: diagonals::candidates(edges, word, y),
            lines: LineWords::new(edges, Axis::Row, word, y),
        }
    }

    fn pixel(&self, bit: u32) -> [i32; 2] {
        [bits::along(self.word, bit), self.y]
    }

    /// What lies at the top edge of the pixel with this bit, and its weights.
    #[inline]
    fn top(&self, bit: u32) -> (Found, Areas) {
        let [rises, falls] = self.diagonals;
        let may_be = [rises >> bit & 1 != 0, falls >> bit & 1 != 0];
        if may_be != [false; 2] {
            let diagonals = Diagonal::through(self.edges, self.pixel(bit), may_be);
            let weights = diagonals_weights(diagonals);
            // Some patterns of diagonals cover nothing.
            if weights != [0; 2] {
                return (Found::Diagonals(diagonals), weights);
            }
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

/// The weights at the edges of a row of pixels, and where there are any.
#[derive(Debug)]
pub(super) struct WeightRow {
    /// One more than there are pixels.
    pub(super) weights: Vec<Weights>,
    /// A bit for each that is any.
    pub(super) weighed: Vec<u64>,
}

impl WeightRow {
    /// Without any.
    pub(super) fn new(width: usize) -> Self {
        Self {
            weights: vec![Weights::default(); width + 1],
            weighed: vec![0; width / 64 + 1],
        }
    }

    /// Takes those of row `y`, which may be the one below the last.
    pub(super) fn fill(&mut self, edges: &Edges, y: i32) {
        let words = self.weighed.iter_mut().zip(self.weights.chunks_mut(64));
        for (word, (weighed, weights)) in (0..).zip(words) {
            if *weighed != 0 {
                weights.fill(Weights::default());
                *weighed = 0;
            }
            if edges.rows.word(word + 1, y) == [0; 2] {
                continue;
            }
            let row = RowWord::new(edges, word + 1, y);
            for bit in bits::ones(row.sides[LEFT] | row.sides[TOP]) {
                let found = row.weights(bit);
                weights[bit as usize] = found;
                *weighed |= u64::from(found != Weights::default()) << bit;
            }
        }
    }
}
