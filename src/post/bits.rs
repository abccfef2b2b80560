//! Edges as bits: 64 pixels of a row or of a column in each word, so that searches go by words and not by pixels.

/// Rows that are worked on at once: as many as a word of a column has bits.
pub(super) const BAND: usize = 64;
/// Rows beside the frame that can be asked; none has edges.
const BESIDE: u32 = 4;

/// The edges of 64 pixels: those on the left, and those at the top.
pub(super) type Words = [u64; 2];

/// Rows of words, or columns: then "row" means a column, and "along" is downwards.
#[derive(Debug)]
pub(super) struct Bits {
    words: Vec<Words>,
    /// How far the next word of a row is, and that of the next row.
    steps: [usize; 2],
}

impl Bits {
    /// Rows of so many pixels, without edges: all words of a row lie side by side.
    pub(super) fn rows(length: usize, count: usize) -> Self {
        let stride = words_of(length);
        Self {
            words: vec![[0; 2]; stride * (count + 2 * Self::BEFORE)],
            steps: [1, stride],
        }
    }

    /// Columns of so many pixels, without edges: the first words of all columns lie side by side, then the second ones.
    pub(super) fn columns(length: usize, count: usize) -> Self {
        let stride = count + 2 * Self::BEFORE;
        Self {
            words: vec![[0; 2]; stride * words_of(length)],
            steps: [stride, 1],
        }
    }

    /// The words of rows from the frame's first on, and how many each has: the first lies before the frame.
    pub(super) fn rows_mut(&mut self) -> (&mut [Words], usize) {
        let stride = self.steps[1];
        (&mut self.words[Self::BEFORE * stride..], stride)
    }

    /// First words of columns, then second ones and so on, and how many there are of each: the first [`Self::BEFORE`] lie
    /// before the frame.
    pub(super) fn columns_mut(&mut self) -> (&mut [Words], usize) {
        let stride = self.steps[0];
        (&mut self.words[stride..], stride)
    }

    /// Rows or columns before the frame.
    pub(super) const BEFORE: usize = BESIDE as usize;

    /// The word of number `word` in a row: number 1 is the frame's first.
    #[inline]
    pub(super) fn word(&self, word: usize, row: i32) -> Words {
        let row = usize::try_from(row + BESIDE.cast_signed()).unwrap_or(0);
        let at = word * self.steps[0] + row * self.steps[1];
        self.words.get(at).copied().unwrap_or_default()
    }

    /// The words of that number in the two rows before `row`, in it, and in the next.
    #[inline]
    pub(super) fn around(&self, word: usize, row: i32) -> [Words; 4] {
        let beside = |rows: i32| self.word(word, row + rows);
        [beside(-2), beside(-1), beside(0), beside(1)]
    }
}

/// Words of a row: one before it, and one after that of the pixel beyond its end.
fn words_of(length: usize) -> usize {
    length / 64 + 3
}

/// The number of the word that has a pixel of a row, and the pixel's bit there. It may lie 64 pixels before the frame.
#[inline]
pub(super) fn place(along: i32) -> (usize, u32) {
    let along = (along + 64).unsigned_abs();
    ((along / 64) as usize, along % 64)
}

/// A pixel of a row, by the number of its word and its bit there.
#[inline]
pub(super) fn along(word: usize, bit: u32) -> i32 {
    i32::try_from(word * 64).unwrap_or(i32::MAX) - 64 + bit.cast_signed()
}

/// The bits up to one, from the highest downwards: of the word before, and of its own.
#[inline]
pub(super) fn up_to(bit: u32, [before, own]: [u64; 2]) -> u64 {
    own << (63 - bit) | before >> 1 >> bit
}

/// The bits after one, from the lowest upwards: of its own word, and of the next.
#[inline]
pub(super) fn after(bit: u32, [own, next]: [u64; 2]) -> u64 {
    own >> 1 >> bit | next << (63 - bit)
}

/// The bits of a word that are set, from the lowest on.
#[inline]
pub(super) fn ones(mut word: u64) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        let bit = word.trailing_zeros();
        word &= word.wrapping_sub(1);
        (bit < 64).then_some(bit)
    })
}

/// Turns 64 rows of 64 bits over their diagonal.
pub(super) fn turn(rows: &mut [u64; 64]) {
    let mut half = 32;
    let mut low = u64::MAX >> 32;
    while half > 0 {
        for at in (0..64).filter(|at| at & half == 0) {
            let swapped = (rows[at] >> half ^ rows[at + half]) & low;
            rows[at] ^= swapped << half;
            rows[at + half] ^= swapped;
        }
        half /= 2;
        low ^= low << half;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turned_rows_are_columns() {
        let rows: [u64; 64] =
            std::array::from_fn(|y| (y as u64 + 3).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(17));
        let mut columns = rows;
        turn(&mut columns);
        for (x, column) in columns.iter().enumerate() {
            for (y, row) in rows.iter().enumerate() {
                assert_eq!(column >> y & 1, row >> x & 1, "{x}, {y}");
            }
        }
    }

    #[test]
    fn neighbours_are_found_across_words() {
        let (before, own, next) = (1 << 63, 0b101, 0b10);
        assert_eq!(
            up_to(1, [before, own]),
            0b011 << 61,
            "the first two, and the last of the word before"
        );
        assert_eq!(up_to(63, [before, own]), own, "all of its own");
        assert_eq!(after(0, [own, 0]), 0b10, "the rest of its own");
        assert_eq!(after(63, [own, next]), next, "all of the next");
        assert_eq!(after(62, [own, next]), next << 1, "its last, and the next");
    }
}
