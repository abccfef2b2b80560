//! One channel of a tile as floats, and filters along rows and columns.

/// Numbers in rows of `width`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plane {
    width: usize,
    values: Vec<f32>,
}

impl Plane {
    /// Rows of `width` numbers each.
    pub(super) fn new(width: usize, values: Vec<f32>) -> Self {
        Self { width, values }
    }

    /// All numbers, row by row.
    pub(super) fn values(&self) -> &[f32] {
        &self.values
    }

    /// Each number becomes the sum of its neighbours in the row times `kernel`, which has an odd length and is not
    /// mirrored: its first weight is that of the leftmost neighbour. `margin` numbers at either end of a row are left
    /// out; it is at least half of the kernel's length.
    pub(super) fn across(&self, kernel: &[f32], margin: usize) -> Self {
        let width = self.width - 2 * margin;
        let first = margin - kernel.len() / 2;
        let mut values = Vec::with_capacity(self.values.len() / self.width * width);
        for row in self.values.chunks_exact(self.width) {
            let start = values.len();
            values.resize(start + width, 0.0);
            for (weight, shift) in kernel.iter().zip(first..) {
                add(&mut values[start..], &row[shift..shift + width], *weight);
            }
        }
        Self { width, values }
    }

    /// As [`Plane::across`] along columns: the first weight is that of the uppermost neighbour, and `margin` rows at
    /// either end are left out.
    pub(super) fn down(&self, kernel: &[f32], margin: usize) -> Self {
        let height = self.values.len() / self.width - 2 * margin;
        let first = margin - kernel.len() / 2;
        let mut values = vec![0.0; height * self.width];
        for (y, out) in values.chunks_exact_mut(self.width).enumerate() {
            for (weight, shift) in kernel.iter().zip(first + y..) {
                add(out, &self.values[shift * self.width..(shift + 1) * self.width], *weight);
            }
        }
        Self { values, ..*self }
    }
}

/// `out += weight * row`, in a loop that compilers turn into vector code.
#[inline]
fn add(out: &mut [f32], row: &[f32], weight: f32) {
    for (out, value) in out.iter_mut().zip(row) {
        *out += weight * value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plane_filters_by_hand() {
        let plane = Plane::new(4, vec![1.0, 2.0, 4.0, 8.0, 0.0, 1.0, 0.0, 0.0, 3.0, 0.0, 0.0, 5.0]);
        let across = plane.across(&[-1.0, 0.0, 10.0], 1);
        assert_eq!(
            across.values(),
            [39.0, 78.0, 0.0, -1.0, -3.0, 50.0],
            "two columns are left"
        );
        let down = plane.down(&[1.0, 2.0, 3.0], 1);
        assert_eq!(down.values(), [10.0, 4.0, 4.0, 23.0], "one row is left");
        assert_eq!(
            plane.down(&[2.0], 1).values(),
            [0.0, 2.0, 0.0, 0.0],
            "a margin wider than the kernel"
        );
    }
}
