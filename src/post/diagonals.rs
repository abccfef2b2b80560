//! Diagonal lines of edges: stairs of one pixel each, which lie at 45 degrees and which lines along rows and columns would
//! smooth into waves.

use super::edges::{Edges, LEFT, TOP};

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
    /// Whether the pixel there has a top edge.
    top: bool,
}

impl Reached {
    /// Where the pixel itself has one of the two edges only.
    const NOWHERE: Self = Self {
        steps: 0,
        ended: true,
        top: false,
    };

    /// What crosses the diagonal there; unknown where its end was not found.
    fn crossed(&self, [horizontal, vertical]: [bool; 2]) -> u8 {
        u8::from(self.ended) * (HORIZONTAL * u8::from(horizontal) + VERTICAL * u8::from(vertical))
    }
}

/// Follows a diagonal by `step` as long as `stair`, the two edges of each pixel, says that it goes on.
fn follow([x, y]: [i32; 2], step: [i32; 2], stair: impl Fn([i32; 2]) -> [bool; 2]) -> Reached {
    let mut steps = 0;
    loop {
        let ahead = i32::from(steps) + 1;
        let [side, top] = stair([x + ahead * step[0], y + ahead * step[1]]);
        if !(side && top) || steps == LONGEST - 1 {
            return Reached {
                steps,
                ended: !(side && top),
                top,
            };
        }
        steps += 1;
    }
}

impl Diagonal {
    /// The diagonals that go through a pixel with a top edge: the one that rises, and the one that falls.
    pub(super) fn through(edges: &Edges, pixel: [i32; 2]) -> [Option<Self>; 2] {
        [Self::rising(edges, pixel), Self::falling(edges, pixel)]
    }

    fn rising(edges: &Edges, [x, y]: [i32; 2]) -> Option<Self> {
        let has = |x: i32, y: i32, side: u8| edges.at_place(edges.place([x, y])) & side != 0;
        let stair = |[x, y]: [i32; 2]| [has(x, y, LEFT), has(x, y, TOP)];
        let left = if has(x, y, LEFT) {
            follow([x, y], [-1, 1], stair)
        } else {
            Reached::NOWHERE
        };
        let right = follow([x, y], [1, -1], stair);
        let lengths = [left.steps + u8::from(left.top), right.steps];
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
        let has = |x: i32, y: i32, side: u8| edges.at_place(edges.place([x, y])) & side != 0;
        let stair = |[x, y]: [i32; 2]| [has(x + 1, y, LEFT), has(x, y, TOP)];
        let left = follow([x, y], [-1, -1], stair);
        let right = if has(x + 1, y, LEFT) {
            follow([x, y], [1, 1], stair)
        } else {
            Reached::NOWHERE
        };
        let lengths = [left.steps, right.steps + u8::from(right.top)];
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
