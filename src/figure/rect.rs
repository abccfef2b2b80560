//! Rectangles of whole pixels.

/// A half-open rectangle: it covers `[x, x + width) x [y, y + height)`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PixelRect {
    /// Left edge.
    pub x: i64,
    /// Upper edge.
    pub y: i64,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl PixelRect {
    /// A rectangle of `size` with its upper left corner in the origin.
    pub const fn of_size([width, height]: [u32; 2]) -> Self {
        Self {
            x: 0,
            y: 0,
            width,
            height,
        }
    }

    /// The first column to the right.
    pub fn right(&self) -> i64 {
        self.x.saturating_add(i64::from(self.width))
    }

    /// The first row below.
    pub fn bottom(&self) -> i64 {
        self.y.saturating_add(i64::from(self.height))
    }

    /// Whether the pixel `(x, y)` lies inside.
    pub fn contains(&self, [x, y]: [i64; 2]) -> bool {
        x >= self.x && x < self.right() && y >= self.y && y < self.bottom()
    }

    /// Whether the two share a pixel.
    pub fn overlaps(&self, other: &Self) -> bool {
        let both = self.intersection(other);
        both.width > 0 && both.height > 0
    }

    /// The pixels that both cover; empty where there are none.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        let (x, y) = (self.x.max(other.x), self.y.max(other.y));
        let length = |from: i64, to: i64| u32::try_from(to.saturating_sub(from)).unwrap_or(0);
        Self {
            x,
            y,
            width: length(x, self.right().min(other.right())),
            height: length(y, self.bottom().min(other.bottom())),
        }
    }

    /// The smallest rectangle that holds both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        let (x, y) = (self.x.min(other.x), self.y.min(other.y));
        let length = |from: i64, to: i64| u32::try_from(to.saturating_sub(from)).unwrap_or(0);
        Self {
            x,
            y,
            width: length(x, self.right().max(other.right())),
            height: length(y, self.bottom().max(other.bottom())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rect_is_half_open() {
        let rect = PixelRect {
            x: 2,
            y: 3,
            width: 4,
            height: 1,
        };
        assert!(rect.contains([2, 3]) && rect.contains([5, 3]), "first and last");
        assert!(!rect.contains([6, 3]) && !rect.contains([2, 4]), "one beyond");
        let beside = PixelRect { x: 6, ..rect };
        assert!(!rect.overlaps(&beside), "sharing an edge is not overlapping");
        assert_eq!(
            rect.intersection(&PixelRect::of_size([4, 9])).width,
            2,
            "columns 2 and 3"
        );
    }
}
