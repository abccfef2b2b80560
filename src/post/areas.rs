//! Which parts of a pixel, and of its neighbour beyond an edge, lie on the other side of the line that a pattern of edges
//! stands for.
//!
//! What the script `AreaTex.py` of the reference code writes into a texture: its patterns have these numbers there, too. Areas
//! below diagonals are exact here; the script counts points.

use std::sync::LazyLock;

use super::diagonals::{self, Diagonal};
use super::lines::{self, Line};

/// A whole pixel.
pub(super) const ONE: u16 = 1 << 15;

/// The parts of a pixel itself, and of its neighbour beyond the edge, in parts of [`ONE`].
pub(super) type Areas = [u16; 2];

/// Short shapes of the form of a U are rounded more, up to this length.
const SMOOTH: f64 = 32.0;

const SIDE: usize = lines::LONGEST as usize + 1;
const DIAGONAL_SIDE: usize = diagonals::LONGEST as usize + 1;

/// By pattern, and by how far a line goes on to both sides.
static LINES: LazyLock<Vec<Areas>> = LazyLock::new(|| {
    all(SIDE, |pattern, [before, after]| {
        under_line(pattern, [before, after]).map(whole)
    })
});

static DIAGONALS: LazyLock<Vec<Areas>> = LazyLock::new(|| {
    all(DIAGONAL_SIDE, |pattern, lengths| {
        let [first, second] = ENDS[pattern].map(|ends| under_diagonal(ends, lengths));
        [0, 1].map(|side| whole(f64::midpoint(first[side], second[side])))
    })
});

fn all(side: usize, areas: impl Fn(usize, [f64; 2]) -> Areas) -> Vec<Areas> {
    let lengths = (0..side * side).map(|at| [(at / side) as f64, (at % side) as f64]);
    (0..16)
        .flat_map(|pattern| lengths.clone().map(move |lengths| (pattern, lengths)))
        .map(|(pattern, lengths)| areas(pattern, lengths))
        .collect()
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 1")]
fn whole(area: f64) -> u16 {
    (area * f64::from(ONE)).round() as u16
}

/// The areas at a pixel of a line.
pub(super) fn of_line(line: Line) -> Areas {
    let [before, after] = line.lengths.map(usize::from);
    LINES[(line.pattern() * SIDE + before) * SIDE + after]
}

/// The areas at a pixel of a diagonal.
pub(super) fn of_diagonal(diagonal: Diagonal) -> Areas {
    let [before, after] = diagonal.lengths.map(usize::from);
    let [begin, end] = diagonal.ends.map(usize::from);
    let [below, above] = DIAGONALS[((begin + 4 * end) * DIAGONAL_SIDE + before) * DIAGONAL_SIDE + after];
    // One that falls is one that rises, upside down.
    if diagonal.rises { [below, above] } else { [above, below] }
}

/// The area below a height over `0..=1` that goes evenly from one value to another, where that is above zero.
fn above_zero([from, to]: [f64; 2]) -> f64 {
    if from >= 0.0 && to >= 0.0 {
        f64::midpoint(from, to)
    } else if from <= 0.0 && to <= 0.0 {
        0.0
    } else {
        let top = from.max(to);
        top * top / (2.0 * (from - to).abs())
    }
}

/// A line from one point to another, heights counted upwards from the edge.
struct Segment([[f64; 2]; 2]);

impl Segment {
    /// The areas below and above the edge that it cuts off from column `x..=x + 1`: of the pixel itself, and of its neighbour.
    fn areas(&self, x: f64) -> [f64; 2] {
        let Self([[x0, y0], [x1, y1]]) = *self;
        let (left, right) = (x.max(x0), (x + 1.0).min(x1));
        if right <= left {
            return [0.0; 2];
        }
        let height = |x: f64| y0 + (y1 - y0) * (x - x0) / (x1 - x0);
        let heights = [height(left), height(right)];
        let above = above_zero(heights);
        let below = above_zero(heights.map(|height| -height));
        [below, above].map(|area| area * (right - left))
    }
}

/// The areas of a pattern of a line that goes on so far to both sides. Crossing edges are half a pixel high: the line that
/// was drawn goes through their middles.
fn under_line(pattern: usize, [before, after]: [f64; 2]) -> [f64; 2] {
    let length = before + after + 1.0;
    let middle = [length / 2.0, 0.0];
    let to_middle = |height: f64| Segment([[0.0, height], middle]).areas(before);
    let from_middle = |height: f64| Segment([middle, [length, height]]).areas(before);
    let across = |from: f64, to: f64| Segment([[0.0, from], [length, to]]).areas(before);
    match pattern {
        // The shape of an L: the line leaves the edge in its middle.
        1 if before <= after => to_middle(-0.5),
        4 if before <= after => to_middle(0.5),
        2 if before >= after => from_middle(-0.5),
        8 if before >= after => from_middle(0.5),
        // Of a U: on one side at both ends.
        3 => smooth(length, [to_middle(-0.5), from_middle(-0.5)]),
        12 => smooth(length, [to_middle(0.5), from_middle(0.5)]),
        // Of a Z: from one side to the other; so it is taken to be where only one of the ends is crossed on both sides.
        6 | 7 | 14 => across(0.5, -0.5),
        9 | 11 | 13 => across(-0.5, 0.5),
        // Nothing crosses the ends, or nothing says on which side they lie.
        _ => [0.0; 2],
    }
}

/// Rounds the two halves of a U the more, the shorter it is.
fn smooth(length: f64, halves: [[f64; 2]; 2]) -> [f64; 2] {
    let part = (length / SMOOTH).min(1.0);
    let rounded = |area: f64| {
        let most = (area * 2.0).sqrt() * 0.5;
        most + (area - most) * part
    };
    [0, 1].map(|side| rounded(halves[0][side]) + rounded(halves[1][side]))
}

/// Where the lines of each pattern of a diagonal begin and end, as corners of the first and of the last pixel: two guesses,
/// whose mean is taken, since ends that nothing or too much crosses may belong to several shapes. A pattern's number is the
/// crossing of its beginning and four times that of its end: 1 vertical, 2 horizontal.
const ENDS: [[[[f64; 2]; 2]; 2]; 16] = {
    const A: [f64; 2] = [0.0, 0.0];
    const B: [f64; 2] = [1.0, 0.0];
    const C: [f64; 2] = [1.0, 1.0];
    [
        [[C, C], [B, B]],
        [[B, A], [B, B]],
        [[C, A], [C, B]],
        [[C, A], [B, B]],
        [[A, C], [B, C]],
        [[B, C], [B, C]],
        [[C, C], [C, C]],
        [[C, C], [B, C]],
        [[A, B], [B, B]],
        [[B, B], [B, B]],
        [[C, B], [C, B]],
        [[C, B], [B, B]],
        [[A, C], [B, B]],
        [[B, C], [B, B]],
        [[C, C], [C, B]],
        [[C, C], [B, B]],
    ]
};

/// The areas at a pixel of a diagonal that rises to the right: what of the pixel lies above the line, and what of its upper
/// neighbour below.
fn under_diagonal([from, to]: [[f64; 2]; 2], [before, after]: [f64; 2]) -> [f64; 2] {
    let length = before + after + 1.0;
    let (width, height) = (to[0] + length - from[0], to[1] + length - from[1]);
    let below = |[x, y]: [f64; 2]| {
        let over = |x: f64| from[1] + height * (x - from[0]) / width - y;
        let heights = [over(x), over(x + 1.0)];
        above_zero(heights) - above_zero(heights.map(|height| height - 1.0))
    };
    [1.0 - below([1.0 + before, before]), below([1.0 + before, 1.0 + before])]
}
