//! Which parts of the window must be put together anew, as a grid of cells: any number of small changes costs no more
//! than the grid.

use crate::figure::PixelRect;

/// Sides of a cell, in window pixels.
const CELL: u32 = 32;

/// A set of cells of the window.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Damage {
    size: [u32; 2],
    columns: u32,
    cells: Vec<bool>,
}

impl Damage {
    /// No part of a window of `size` pixels.
    pub(super) fn none(size: [u32; 2]) -> Self {
        let [columns, rows] = size.map(|side| side.div_ceil(CELL));
        Self {
            size,
            columns,
            cells: vec![false; columns as usize * rows as usize],
        }
    }

    /// All of it.
    pub(super) fn all(size: [u32; 2]) -> Self {
        let mut damage = Self::none(size);
        damage.cells.fill(true);
        damage
    }

    /// Whether it is about a window of this size.
    pub(super) fn is_for(&self, size: [u32; 2]) -> bool {
        self.size == size
    }

    /// Adds the cells that `part` touches.
    pub(super) fn add(&mut self, part: &PixelRect) {
        let part = part.intersection(&PixelRect::of_size(self.size));
        if part.width == 0 || part.height == 0 {
            return;
        }
        let cells = |start: i64, length: u32| {
            let start = u32::try_from(start).unwrap_or(0);
            start / CELL..=(start + length - 1) / CELL
        };
        for row in cells(part.y, part.height) {
            for column in cells(part.x, part.width) {
                self.cells[(row * self.columns + column) as usize] = true;
            }
        }
    }

    /// Adds what another holds; one for another size damages everything.
    pub(super) fn join(&mut self, other: &Self) {
        if self.size != other.size {
            self.cells.fill(true);
            return;
        }
        for (cell, other) in self.cells.iter_mut().zip(&other.cells) {
            *cell |= other;
        }
    }

    /// Its pixels as few rectangles; no two share a pixel.
    pub(super) fn rects(&self) -> Vec<PixelRect> {
        let mut done: Vec<PixelRect> = Vec::new();
        // Those that end with the row of cells before: a run that lies below one of them makes it longer.
        let mut open: Vec<PixelRect> = Vec::new();
        for (row, cells) in (0..).zip(self.cells.chunks(self.columns.max(1) as usize)) {
            let mut next = Vec::new();
            for run in self.runs(row, cells) {
                let same = |rect: &PixelRect| rect.x == run.x && rect.width == run.width;
                next.push(match open.iter().position(same) {
                    Some(at) => {
                        let above = open.swap_remove(at);
                        PixelRect {
                            height: above.height + run.height,
                            ..above
                        }
                    }
                    None => run,
                });
            }
            done.append(&mut open);
            open = next;
        }
        done.append(&mut open);
        done
    }

    /// The runs of cells in one row of the grid.
    fn runs(&self, row: u32, cells: &[bool]) -> Vec<PixelRect> {
        let mut runs = Vec::new();
        let mut column = 0;
        for run in cells.chunk_by(|a, b| a == b) {
            let length = u32::try_from(run.len()).unwrap_or(0);
            if run[0] {
                let (x, y) = (column * CELL, row * CELL);
                runs.push(PixelRect {
                    x: x.into(),
                    y: y.into(),
                    width: (length * CELL).min(self.size[0] - x),
                    height: CELL.min(self.size[1] - y),
                });
            }
            column += length;
        }
        runs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damage_holds_what_was_added() {
        arbtest::arbtest(|u| {
            let size = [u.int_in_range(0..=150)?, u.int_in_range(0..=150)?];
            let mut damage = Damage::none(size);
            let mut parts = Vec::new();
            for _ in 0..u.int_in_range(0..=5)? {
                let part = PixelRect {
                    x: u.int_in_range(-20..=160)?,
                    y: u.int_in_range(-20..=160)?,
                    width: u.int_in_range(0..=60)?,
                    height: u.int_in_range(0..=60)?,
                };
                damage.add(&part);
                parts.push(part);
            }
            let rects = damage.rects();
            for y in 0..i64::from(size[1]) {
                for x in 0..i64::from(size[0]) {
                    let count = rects.iter().filter(|rect| rect.contains([x, y])).count();
                    assert!(count <= 1, "{x}, {y} stands in one: {rects:?}");
                    let is_damaged = parts.iter().any(|part| part.contains([x, y]));
                    assert!(count == 1 || !is_damaged, "{x}, {y} of {parts:?} is in {rects:?}");
                }
            }
            let window = PixelRect::of_size(size);
            assert!(
                rects.iter().all(|rect| rect.intersection(&window) == *rect),
                "inside: {rects:?}"
            );
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn damage_of_everything_is_one_rectangle() {
        let mut damage = Damage::all([100, 70]);
        assert_eq!(damage.rects(), [PixelRect::of_size([100, 70])], "one");
        damage = Damage::none([100, 70]);
        assert_eq!(damage.rects(), [], "none");
        damage.join(&Damage::none([10, 10]));
        assert_eq!(damage, Damage::all([100, 70]), "another size");
    }
}
