//! How much of each other two pixels beside an edge take.

use super::areas::{self, Areas, ONE};
use super::bits;
use super::diagonals::{self, Diagonal};
use super::edges::{Edges, LEFT, TOP};
use super::lines::{Axis, Line};

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

impl Found {
    /// At the top edge of a pixel, through which diagonals go, if any do.
    pub(super) fn at_top(edges: &Edges, pixel: [i32; 2]) -> Self {
        let diagonals = Diagonal::through(edges, pixel);
        // Some patterns of diagonals cover nothing.
        if diagonals_weights(diagonals) != [0; 2] {
            return Self::Diagonals(diagonals);
        }
        Self::along_row(edges, pixel)
    }

    /// At the top edge of a pixel that no diagonal goes through.
    #[inline]
    fn along_row(edges: &Edges, pixel: [i32; 2]) -> Self {
        Self::Line(Line::through(edges, Axis::Row, Axis::Row.place(pixel)))
    }

    /// At the left edge of a pixel.
    pub(super) fn at_left(edges: &Edges, pixel: [i32; 2]) -> Self {
        Self::Line(Line::through(edges, Axis::Column, Axis::Column.place(pixel)))
    }

    pub(super) fn weights(self) -> Areas {
        match self {
            Self::Diagonals(diagonals) => diagonals_weights(diagonals),
            Self::Line(line) => {
                let kept = line.kept_by_corners();
                let areas = areas::of_line(line);
                [0, 1].map(|side| areas[side] - areas[side] / 8 * (8 - kept[side]))
            }
        }
    }
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
    pub(super) fn of(edges: &Edges, pixel: [i32; 2]) -> Self {
        Self::at(edges, pixel, [LEFT, TOP].map(|side| edges.has(pixel, side)), true)
    }

    /// At those edges of a pixel: `sides` says whether the left one and the top one are any.
    #[inline]
    fn at(edges: &Edges, pixel: [i32; 2], sides: [bool; 2], may_be_diagonal: bool) -> Self {
        let mut found = Self::default();
        if sides[TOP] {
            let top = if may_be_diagonal {
                Found::at_top(edges, pixel)
            } else {
                Found::along_row(edges, pixel)
            };
            found.top = top.weights();
            // A diagonal has taken care of both edges.
            if matches!(top, Found::Diagonals(_)) {
                return found;
            }
        }
        if sides[LEFT] {
            found.left = Found::at_left(edges, pixel).weights();
        }
        found
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
            let sides = edges.rows.word(word + 1, y);
            if sides == [0; 2] {
                continue;
            }
            let diagonals = diagonals::candidates(edges, word + 1, y);
            let start = i32::try_from(word * 64).unwrap_or(i32::MAX);
            for bit in bits::ones(sides[LEFT] | sides[TOP]) {
                let x = start + bit.cast_signed();
                let has = |word: u64| word >> bit & 1 != 0;
                let found = Weights::at(edges, [x, y], sides.map(has), has(diagonals));
                weights[bit as usize] = found;
                *weighed |= u64::from(found != Weights::default()) << bit;
            }
        }
    }
}
