//! A triangle row of tiles by row of tiles: the tiles it touches and the tiles it covers, without looking at any other.
//!
//! In a few sample rows each edge moves between the columns where it crosses the first row and the last. What lies
//! left of every left edge's least column holds no covered sample; what lies right of their greatest is inside them.
//! The columns are computed in 64-bit floats, which are off by less than a millionth of the grid's unit inside the
//! frame, and widened or narrowed by a whole unit: the first answer may name a tile too many, the second one too few,
//! never the other way round. Which samples are covered is decided exactly when a tile is painted.

use crate::geometry::edge::doubled_area;
use crate::geometry::subpixel::GridPoint;

/// What may be wrong with a column, in units of the sub-pixel grid.
pub(crate) const MARGIN: f64 = 1.0;

/// The edges of a triangle with an area.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileRows {
    /// One left edge, twice, or two.
    pub(super) left: [Line; 2],
    pub(super) right: [Line; 2],
}

/// The columns of some rows, in units of the sub-pixel grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ColumnBounds {
    /// No covered sample lies before the first or after the second.
    pub(crate) touched: [f64; 2],
    /// In every row, all from the first to the second lies inside; nothing where the first is the greater one.
    pub(crate) covered: [f64; 2],
}

/// The line of an edge that is not horizontal.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Line {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) slope: f64,
}

impl Line {
    #[inline]
    pub(crate) fn new(from: GridPoint, to: GridPoint) -> Self {
        let [x, y] = [from.x, from.y].map(f64::from);
        Self {
            x,
            y,
            slope: (f64::from(to.x) - x) / (f64::from(to.y) - y),
        }
    }

    #[inline]
    pub(crate) fn at(self, y: f64) -> f64 {
        self.x + (y - self.y) * self.slope
    }
}

impl TileRows {
    /// Prepares a triangle, which must have an area.
    pub(crate) fn new([a, b, c]: [GridPoint; 3]) -> Self {
        let corners = if doubled_area([a, b, c]) < 0 {
            [a, c, b]
        } else {
            [a, b, c]
        };
        let (mut left, mut right) = ([None; 2], [None; 2]);
        for i in 0..3 {
            let (from, to) = (corners[i], corners[(i + 1) % 3]);
            // Clockwise on the screen: a left edge runs up.
            let edges = match to.y.cmp(&from.y) {
                std::cmp::Ordering::Less => &mut left,
                std::cmp::Ordering::Greater => &mut right,
                std::cmp::Ordering::Equal => continue,
            };
            edges[1] = edges[0];
            edges[0] = Some(Line::new(from, to));
        }
        // An area needs an edge on either side.
        let both = |[first, second]: [Option<Line>; 2]| {
            let first = first.unwrap_or_default();
            [first, second.unwrap_or(first)]
        };
        Self {
            left: both(left),
            right: both(right),
        }
    }

    /// The columns in the rows from coordinate `first` to `last`, which must lie between the triangle's top and bottom.
    #[inline]
    pub(crate) fn between(&self, first: i32, last: i32) -> ColumnBounds {
        let (first, last) = (f64::from(first), f64::from(last));
        let ends = |line: Line| {
            let (a, b) = (line.at(first), line.at(last));
            (a.min(b), a.max(b))
        };
        let (left, right) = (self.left.map(ends), self.right.map(ends));
        ColumnBounds {
            touched: [left[0].0.max(left[1].0) - MARGIN, right[0].1.min(right[1].1) + MARGIN],
            covered: [left[0].1.max(left[1].1) + MARGIN, right[0].0.min(right[1].0) - MARGIN],
        }
    }
}
