//! What was done to one pixel, step by step.

use super::areas::ONE;
use super::blend::{Around, Values};
use super::edges::{Edges, LEFT, TOP, contrast};
use super::lines::{Axis, End, Line};
use super::smaa::smaa;
use super::weights::{Found, Weights};

/// What SMAA did to a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// The pixel `0xAARRGGBB` before.
    pub before: u32,
    /// And after.
    pub after: u32,
    /// Its sides: left, above, right, below; those at the frame's border are left out.
    pub sides: Vec<SideTrace>,
    /// What it consists of: the pixel itself and its neighbours, with their weights, which are 1 together.
    pub blended: Vec<(Neighbour, f64)>,
}

/// A pixel, or one beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Neighbour {
    /// The pixel itself.
    Own,
    /// The one on its left.
    Left,
    /// The one above.
    Above,
    /// The one on its right.
    Right,
    /// The one below.
    Below,
}

/// A side of a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct SideTrace {
    /// The neighbour there.
    pub neighbour: Neighbour,
    /// That pixel `0xAARRGGBB`.
    pub pixel: u32,
    /// How far the lumas are apart, `0.0..=1.0`.
    pub contrast: f64,
    /// The pattern that the edge there is part of; `None` where there is no edge.
    pub pattern: Option<Pattern>,
    /// The part of the pixel that lies on the other side of the line that the pattern stands for, `0.0..=1.0`.
    pub weight: f64,
}

/// A pattern of edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// A line along a row or a column.
    Line {
        /// How many pixels it goes on to the left or upwards, and to the right or downwards.
        lengths: [u8; 2],
        /// Its form.
        form: Form,
        /// Whether a corner was found at either end, which takes away from the weight.
        corner: bool,
    },
    /// Stairs of single pixels: how many steps they go on to the left, and to the right.
    Diagonal([u8; 2]),
    /// None of its own: a diagonal at the other edge of the pixel to which the edge belongs has taken care of it.
    Taken,
}

/// The form of a line, by what crosses its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Nothing, or edges on both sides: no line is guessed.
    Straight,
    /// One end, as in an L.
    L,
    /// Both ends, on the same side, as in a U.
    U,
    /// Both ends, on different sides, as in a Z.
    Z,
}

impl Form {
    fn of([begin, end]: [End; 2]) -> Self {
        let is_open = |end: End| end.near == end.far;
        let is_double = |end: End| end.near && end.far;
        match (is_open(begin), is_open(end)) {
            (false, false) if begin.near == end.near => Self::U,
            (false, false) => Self::Z,
            (true, false) if is_double(begin) => Self::Z,
            (false, true) if is_double(end) => Self::Z,
            (true, true) => Self::Straight,
            _ => Self::L,
        }
    }

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Straight => "straight",
            Self::L => "L",
            Self::U => "U",
            Self::Z => "Z",
        }
    }
}

impl Pattern {
    fn of(found: Found) -> Self {
        match found {
            Found::Line(line) => Self::of_line(line),
            Found::Diagonals(diagonals) => {
                let lengths = diagonals.into_iter().flatten().map(|diagonal| diagonal.lengths);
                Self::Diagonal(
                    lengths
                        .max_by_key(|lengths| lengths[0] + lengths[1])
                        .unwrap_or_default(),
                )
            }
        }
    }

    fn of_line(line: Line) -> Self {
        Self::Line {
            lengths: line.lengths,
            form: Form::of(line.ends),
            corner: line.kept_by_corners() != [8; 2],
        }
    }
}

impl Neighbour {
    const SIDES: [Self; 4] = [Self::Left, Self::Above, Self::Right, Self::Below];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Own => "own",
            Self::Left => "left",
            Self::Above => "above",
            Self::Right => "right",
            Self::Below => "below",
        }
    }

    /// Where it stands.
    const fn beside(self, [x, y]: [i32; 2]) -> [i32; 2] {
        match self {
            Self::Own => [x, y],
            Self::Left => [x - 1, y],
            Self::Above => [x, y - 1],
            Self::Right => [x + 1, y],
            Self::Below => [x, y + 1],
        }
    }
}

/// What [`smaa`] does to the pixel in column and row `at` of a picture; `None` outside it.
pub fn trace(pixels: &[u32], size: [u32; 2], at: [u32; 2], values: Values) -> Option<Trace> {
    let sides = size.map(|side| side as usize);
    let own = [i32::try_from(at[0]).ok()?, i32::try_from(at[1]).ok()?];
    let pixel = |[x, y]: [i32; 2]| {
        let (x, y) = (usize::try_from(x).ok()?, usize::try_from(y).ok()?);
        (x < sides[0] && y < sides[1]).then(|| pixels[y * sides[0] + x])
    };
    let before = pixel(own)?;
    let edges = Edges::new(pixels, sides);
    let around = Around::new(
        Weights::of(&edges, own),
        Weights::of(&edges, Neighbour::Right.beside(own)),
        Weights::of(&edges, Neighbour::Below.beside(own)),
    );
    let side = |neighbour: Neighbour| {
        let other = pixel(neighbour.beside(own))?;
        Some(SideTrace {
            neighbour,
            pixel: other,
            contrast: contrast(before, other),
            pattern: pattern(&edges, own, neighbour),
            weight: f64::from(around.of(neighbour)) / f64::from(ONE),
        })
    };
    let blended = around.blend().map_or(Vec::new(), |blend| {
        let neighbours = if blend.is_across {
            [Neighbour::Left, Neighbour::Right]
        } else {
            [Neighbour::Above, Neighbour::Below]
        };
        let shares = blend.shares();
        let all = shares.iter().sum::<i64>() as f64;
        [Neighbour::Own, neighbours[0], neighbours[1]]
            .into_iter()
            .zip(shares)
            .filter(|(_, share)| *share > 0)
            .map(|(neighbour, share)| (neighbour, share as f64 / all))
            .collect()
    });
    let mut smoothed = pixels.to_vec();
    smaa(&mut smoothed, size, values);
    Some(Trace {
        before,
        after: smoothed[at[1] as usize * sides[0] + at[0] as usize],
        sides: Neighbour::SIDES.into_iter().filter_map(side).collect(),
        blended,
    })
}

/// The pattern at a side of a pixel. Right and lower sides are edges of the next pixel.
fn pattern(edges: &Edges, own: [i32; 2], neighbour: Neighbour) -> Option<Pattern> {
    let (at, side) = match neighbour {
        Neighbour::Own => return None,
        Neighbour::Left => (own, LEFT),
        Neighbour::Above => (own, TOP),
        Neighbour::Right => (neighbour.beside(own), LEFT),
        Neighbour::Below => (neighbour.beside(own), TOP),
    };
    if !edges.has(at, side) {
        return None;
    }
    let top = edges.has(at, TOP).then(|| Found::at_top(edges, at));
    Some(match (side, top) {
        (TOP, Some(found)) => Pattern::of(found),
        (_, Some(Found::Diagonals(_))) => Pattern::Taken,
        _ => Pattern::of_line(Line::through(edges, Axis::Column, Axis::Column.place(at))),
    })
}

impl Around {
    fn of(self, neighbour: Neighbour) -> u16 {
        match neighbour {
            Neighbour::Own => 0,
            Neighbour::Left => self.left,
            Neighbour::Above => self.above,
            Neighbour::Right => self.right,
            Neighbour::Below => self.below,
        }
    }
}
