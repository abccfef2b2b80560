//! How much of each other two pixels beside an edge take.

use super::areas::{self, Areas, ONE};
use super::diagonals::Diagonal;
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
    /// At the top edge of a pixel.
    pub(super) fn at_top(edges: &Edges, pixel: [i32; 2]) -> Self {
        let diagonals = Diagonal::through(edges, pixel);
        // Some patterns of diagonals cover nothing.
        if diagonals_weights(diagonals) != [0; 2] {
            return Self::Diagonals(diagonals);
        }
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
        let flags = edges.at(pixel);
        let mut found = Self::default();
        if flags & TOP != 0 {
            let top = Found::at_top(edges, pixel);
            found.top = top.weights();
            // A diagonal has taken care of both edges.
            if matches!(top, Found::Diagonals(_)) {
                return found;
            }
        }
        if flags & LEFT != 0 {
            found.left = Found::at_left(edges, pixel).weights();
        }
        found
    }
}
