//! Diagonal lines of edges: stairs of one pixel each, which lie at 45 degrees and which lines along rows and columns would
//! smooth into waves.

use super::bits;
use super::edges::{Edges, FALL, LEFT, RISE, TOP};

/// Pixels that a diagonal is followed in each direction.
pub(super) const LONGEST: u8 = 8;
/// Steps of a diagonal that are enough to be one.
const FEWEST: u8 = 3;

/// What crosses a diagonal at its end: a bit for a vertical edge that goes on, and one for a horizontal edge.
const VERTICAL: u8 = 1;
const HORIZONTAL: u8 = 2;

/// A diagonal, as a pixel with a top edge sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Diagonal {
    /// Whether it goes up to the right; else it goes down to the right.
    pub(super) rises: bool,
    /// How many steps it goes on to the left, and to the right.
    pub(super) lengths: [u8; 2],
    /// What crosses it there: [`VERTICAL`] and [`HORIZONTAL`]; nothing where its end was not found.
    pub(super) ends: [u8; 2],
}

/// How far a diagonal goes on.
struct Reached {
    steps: u8,
    /// Whether that is its end.
    ended: bool,
}

impl Reached {
    /// Where the pixel itself has one of the two edges only.
    const NOWHERE: Self = Self { steps: 0, ended: true };

    /// What crosses the diagonal there; unknown where its end was not found.
    fn crossed(&self, [horizontal, vertical]: [bool; 2]) -> u8 {
        u8::from(self.ended) * (HORIZONTAL * u8::from(horizontal) + VERTICAL * u8::from(vertical))
    }
}

/// Follows a diagonal from the pixel with this bit as long as there are steps.
#[inline]
fn follow(stairs: &[u64; REACH], bit: u32) -> Reached {
    let goes_on = |word: &&u64| *word >> bit & 1 != 0;
    let steps = stairs[1..].iter().take_while(goes_on).count();
    let steps = u8::try_from(steps).unwrap_or(LONGEST);
    Reached {
        steps: steps.min(LONGEST - 1),
        ended: steps < LONGEST,
    }
}

/// Steps that are looked at in each direction: all, and the one that ends them.
const REACH: usize = LONGEST as usize + 1;

/// The steps of one kind around the 64 pixels of a word: the `k`th words are of the pixels `k` steps to the right, or to the
/// left, moved to the bits of the word's own.
#[derive(Clone, Copy, Debug, Default)]
struct Stairs {
    right: [u64; REACH],
    left: [u64; REACH],
}

/// The diagonals through the top edges of 64 pixels of a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Diagonals<'e> {
    edges: &'e Edges,
    word: usize,
    y: i32,
    /// Which pixels diagonals may go through that rise, and which that fall: no others have three steps.
    candidates: [u64; 2],
    stairs: [Stairs; 2],
}

/// How many rows further below the next step is to the right, by [`RISE`] and [`FALL`].
const DOWN: [i32; 2] = [-1, 1];

impl<'e> Diagonals<'e> {
    /// Of word number `word` of row `y`.
    pub(super) fn new(edges: &'e Edges, word: usize, y: i32) -> Self {
        let mut found = Self {
            edges,
            word,
            y,
            candidates: [0; 2],
            stairs: [Stairs::default(); 2],
        };
        let [left, top] = edges.rows.word(word, y);
        if top == 0 {
            return found;
        }
        let right = left >> 1 | edges.rows.word(word + 1, y)[LEFT] << 63;
        let [rises, falls] = [RISE, FALL].map(|kind| move |steps: i32| found.moved(kind, steps));
        let rising = may_go(left, [rises(1), rises(2), rises(3)], [rises(-1), rises(-2)]);
        let falling = may_go(right, [falls(-1), falls(-2), falls(-3)], [falls(1), falls(2)]);
        found.candidates = [top & rising, top & falling];
        for kind in [RISE, FALL] {
            if found.candidates[kind] != 0 {
                for (at, steps) in (0..REACH).zip(0..) {
                    found.stairs[kind].right[at] = found.moved(kind, steps);
                    found.stairs[kind].left[at] = found.moved(kind, -steps);
                }
            }
        }
        found
    }

    /// The steps of the pixels that lie so many steps to the right, in the bits of those from which they do.
    fn moved(&self, kind: usize, steps: i32) -> u64 {
        let words = |word: usize| self.edges.stairs.word(word, self.y + steps * DOWN[kind])[kind];
        match steps.unsigned_abs() {
            0 => words(self.word),
            by if steps > 0 => words(self.word) >> by | words(self.word + 1) << (64 - by),
            by => words(self.word) << by | words(self.word - 1) >> (64 - by),
        }
    }

    /// Pixels through which diagonals may go.
    pub(super) fn candidates(&self) -> u64 {
        self.candidates[RISE] | self.candidates[FALL]
    }

    /// The diagonals that go through the pixel with this bit: the one that rises, and the one that falls.
    #[inline]
    pub(super) fn through(&self, bit: u32) -> [Option<Diagonal>; 2] {
        let may = |kind: usize| self.candidates[kind] >> bit & 1 != 0;
        let rising = may(RISE).then(|| self.rising(bit));
        let falling = may(FALL).then(|| self.falling(bit));
        [rising.flatten(), falling.flatten()]
    }

    fn rising(&self, bit: u32) -> Option<Diagonal> {
        let (x, y) = (bits::along(self.word, bit), self.y);
        let has = |x: i32, y: i32, side: usize| self.edges.has([x, y], side);
        let stairs = &self.stairs[RISE];
        let mut lengths = [0; 2];
        let left = if has(x, y, LEFT) {
            let left = follow(&stairs.left, bit);
            let ahead = i32::from(left.steps) + 1;
            lengths[0] = left.steps + u8::from(!left.ended || has(x - ahead, y + ahead, TOP));
            left
        } else {
            Reached::NOWHERE
        };
        let right = follow(&stairs.right, bit);
        lengths[1] = right.steps;
        let [before, after] = lengths.map(i32::from);
        (lengths[0] + lengths[1] >= FEWEST).then(|| Diagonal {
            rises: true,
            lengths,
            ends: [
                left.crossed([has(x - before - 1, y + before, TOP), has(x - before, y + before, LEFT)]),
                right.crossed([
                    has(x + after + 1, y - after, TOP),
                    has(x + after + 1, y - after - 1, LEFT),
                ]),
            ],
        })
    }

    fn falling(&self, bit: u32) -> Option<Diagonal> {
        let (x, y) = (bits::along(self.word, bit), self.y);
        let has = |x: i32, y: i32, side: usize| self.edges.has([x, y], side);
        let stairs = &self.stairs[FALL];
        let left = follow(&stairs.left, bit);
        let mut lengths = [left.steps, 0];
        let right = if has(x + 1, y, LEFT) {
            let right = follow(&stairs.right, bit);
            let ahead = i32::from(right.steps) + 1;
            lengths[1] = right.steps + u8::from(!right.ended || has(x + ahead, y + ahead, TOP));
            right
        } else {
            Reached::NOWHERE
        };
        let [before, after] = lengths.map(i32::from);
        (lengths[0] + lengths[1] >= FEWEST).then(|| Diagonal {
            rises: false,
            lengths,
            ends: [
                left.crossed([
                    has(x - before - 1, y - before, TOP),
                    has(x - before, y - before - 1, LEFT),
                ]),
                right.crossed([has(x + after + 1, y + after, TOP), has(x + after + 1, y + after, LEFT)]),
            ],
        })
    }
}

/// Whether the stairs of a diagonal may be three: upwards from a pixel, and downwards where it has the `side` for that.
fn may_go(side: u64, up: [u64; 3], down: [u64; 2]) -> u64 {
    up[0] & up[1] & (up[2] | side) | side & down[0] & (up[0] | down[1])
}
