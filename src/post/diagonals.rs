//! Diagonal lines of edges: stairs of one pixel each, which lie at 45 degrees and which lines along rows and columns would
//! smooth into waves.

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

/// Follows a diagonal by `step` as long as pixels have steps of its kind.
#[inline]
fn follow(edges: &Edges, kind: usize, [x, y]: [i32; 2], step: [i32; 2]) -> Reached {
    let mut steps = 0;
    loop {
        let ahead = i32::from(steps) + 1;
        let goes_on = edges.has_step([x + ahead * step[0], y + ahead * step[1]], kind);
        if !goes_on || steps == LONGEST - 1 {
            return Reached { steps, ended: !goes_on };
        }
        steps += 1;
    }
}

/// Which of the 64 pixels of a word in row `y` diagonals may go through that rise, and which that fall: no others have three
/// steps.
pub(super) fn candidates(edges: &Edges, word: usize, y: i32) -> [u64; 2] {
    let [left, top] = edges.rows.word(word, y);
    if top == 0 {
        return [0; 2];
    }
    // Of the pixels that lie so far to the right, in a row.
    let moved = |x: i32, y: i32, kind: usize| {
        let words = |word: usize| edges.stairs.word(word, y)[kind];
        match x.unsigned_abs() {
            0 => words(word),
            by if x > 0 => words(word) >> by | words(word + 1) << (64 - by),
            by => words(word) << by | words(word - 1) >> (64 - by),
        }
    };
    let rises = |step: i32| moved(step, y - step, RISE);
    let falls = |step: i32| moved(step, y + step, FALL);
    let right = left >> 1 | edges.rows.word(word + 1, y)[LEFT] << 63;
    let rising = may_go(left, [rises(1), rises(2), rises(3)], [rises(-1), rises(-2)]);
    let falling = may_go(right, [falls(-1), falls(-2), falls(-3)], [falls(1), falls(2)]);
    [top & rising, top & falling]
}

/// Whether the stairs of a diagonal may be three: upwards from a pixel, and downwards where it has the `side` for that.
fn may_go(side: u64, up: [u64; 3], down: [u64; 2]) -> u64 {
    up[0] & up[1] & (up[2] | side) | side & down[0] & (up[0] | down[1])
}

impl Diagonal {
    /// The diagonals that go through a pixel with a top edge, the one that rises and the one that falls, if it is among the
    /// [`candidates`] of either.
    #[inline]
    pub(super) fn through(edges: &Edges, pixel: [i32; 2], [may_rise, may_fall]: [bool; 2]) -> [Option<Self>; 2] {
        let rising = may_rise.then(|| Self::rising(edges, pixel));
        let falling = may_fall.then(|| Self::falling(edges, pixel));
        [rising.flatten(), falling.flatten()]
    }

    fn rising(edges: &Edges, [x, y]: [i32; 2]) -> Option<Self> {
        let has = |x: i32, y: i32, side: usize| edges.has([x, y], side);
        let mut lengths = [0; 2];
        let left = if has(x, y, LEFT) {
            let left = follow(edges, RISE, [x, y], [-1, 1]);
            let ahead = i32::from(left.steps) + 1;
            lengths[0] = left.steps + u8::from(!left.ended || has(x - ahead, y + ahead, TOP));
            left
        } else {
            Reached::NOWHERE
        };
        let right = follow(edges, RISE, [x, y], [1, -1]);
        lengths[1] = right.steps;
        let [before, after] = lengths.map(i32::from);
        (lengths[0] + lengths[1] >= FEWEST).then(|| Self {
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

    fn falling(edges: &Edges, [x, y]: [i32; 2]) -> Option<Self> {
        let has = |x: i32, y: i32, side: usize| edges.has([x, y], side);
        let left = follow(edges, FALL, [x, y], [-1, -1]);
        let mut lengths = [left.steps, 0];
        let right = if has(x + 1, y, LEFT) {
            let right = follow(edges, FALL, [x, y], [1, 1]);
            let ahead = i32::from(right.steps) + 1;
            lengths[1] = right.steps + u8::from(!right.ended || has(x + ahead, y + ahead, TOP));
            right
        } else {
            Reached::NOWHERE
        };
        let [before, after] = lengths.map(i32::from);
        (lengths[0] + lengths[1] >= FEWEST).then(|| Self {
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
