//! All pixels of a picture.

use rayon::prelude::*;

use super::bits::{self, BAND};
use super::blend::{Around, Values};
use super::edges::Edges;
use super::weights::{LeftWeights, TopWeights, Weights};

/// How far beside a pixel others may lie that decide about it: the end of the longest line that it or the next pixel is part
/// of, what crosses it there, and the neighbours by which that is an edge.
pub const REACH: u32 = 36;

/// Smooths the edges of a picture of `size` pixels `0xAARRGGBB`, row by row, on the current rayon pool.
///
/// # Panics
/// When there are fewer pixels.
pub fn smaa(pixels: &mut [u32], size: [u32; 2], values: Values) {
    let size = size.map(|side| side as usize);
    if size.contains(&0) {
        return;
    }
    let edges = Edges::new(pixels, size);
    let [width, height] = size;
    let pixels = &mut pixels[..width * height];
    // Bands are smoothed in place, each beside rows of others as they were.
    let row = |y: Option<usize>| y.and_then(|y| pixels.chunks_exact(width).nth(y)).unwrap_or_default();
    let starts = (0..height).step_by(BAND);
    let beside: Vec<[Vec<u32>; 2]> = starts
        .map(|y| [row(y.checked_sub(1)).to_vec(), row(Some(y + BAND)).to_vec()])
        .collect();
    let bands = pixels.par_chunks_mut(BAND * width).zip(beside).enumerate();
    bands.for_each_init(
        || Smoother::new(&edges, values),
        |smoother, (band, (pixels, beside))| smoother.smooth(band, pixels, beside),
    );
}

/// A row; frames have far fewer than `2^31`.
fn place(at: usize) -> i32 {
    i32::try_from(at).unwrap_or(i32::MAX)
}

/// Smooths one band after the other.
struct Smoother<'e> {
    edges: &'e Edges,
    values: Values,
    left: LeftWeights,
    /// Of a row, and of the next.
    top: [TopWeights; 2],
}

impl<'e> Smoother<'e> {
    fn new(edges: &'e Edges, values: Values) -> Self {
        let width = edges.size[0];
        Self {
            edges,
            values,
            left: LeftWeights::new(width),
            top: [TopWeights::new(width), TopWeights::new(width)],
        }
    }

    /// Smooths the rows of a band; `beside` are the rows above and below them, empty beyond the frame.
    fn smooth(&mut self, band: usize, pixels: &mut [u32], beside: [Vec<u32>; 2]) {
        let width = self.edges.size[0];
        let [mut above, last] = beside;
        // A neighbour beyond the frame weighs nothing.
        above.resize(width, 0);
        let mut before = vec![0; width];
        let Self {
            edges,
            values,
            left,
            top: [own, below],
        } = self;
        left.fill(edges, band);
        below.fill(edges, place(band * BAND), |x| left.clear(x, 0));
        for (y, start) in (0..pixels.len()).step_by(width).enumerate() {
            std::mem::swap(own, below);
            below.fill(edges, place(band * BAND + y + 1), |x| {
                if y + 1 < BAND {
                    left.clear(x, y + 1);
                }
            });
            let (row, rest) = pixels[start..].split_at_mut(width);
            before.copy_from_slice(row);
            let next = if rest.is_empty() { &*last } else { rest };
            let lefts = left.row(y);
            let mut right = 0;
            for (word, (top, under)) in own.weighed.iter().zip(&below.weighed).enumerate().rev() {
                let weighed = left.weighed(word, y);
                // Those with weights of their own, those left of one, and those above one.
                let touched = top | weighed | weighed >> 1 | right << 63 | under;
                right = weighed;
                for x in bits::ones(touched)
                    .map(|bit| word * 64 + bit as usize)
                    .filter(|x| *x < width)
                {
                    let at = |left: usize| Weights {
                        top: own.weights[x],
                        left: lefts[left],
                    };
                    let under = Weights {
                        top: below.weights[x],
                        left: [0; 2],
                    };
                    let around = Around::new(at(x), at(x + 1), under);
                    if let Some(blend) = around.blend() {
                        let at = |x: Option<usize>| x.and_then(|x| before.get(x)).copied().unwrap_or(0);
                        let neighbours = if blend.is_across {
                            [at(x.checked_sub(1)), at(Some(x + 1))]
                        } else {
                            [above[x], next.get(x).copied().unwrap_or(0)]
                        };
                        row[x] = blend.pixel(before[x], neighbours, *values);
                    }
                }
            }
            std::mem::swap(&mut above, &mut before);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::ResolveSpace;
    use crate::post::{Form, Neighbour, Pattern, trace};
    use crate::rules::Rules;

    const SIZE: [u32; 2] = [64, 24];
    const VALUES: Values = Values {
        space: ResolveSpace::Stored,
        rules: Rules::Standard,
    };

    /// Black where `is_black`, and grey of this level elsewhere.
    fn picture(level: u8, is_black: impl Fn(i32, i32) -> bool) -> Vec<u32> {
        let places = (0..24).flat_map(|y| (0..64).map(move |x| (x, y)));
        let grey = u32::from_be_bytes([255, level, level, level]);
        places
            .map(|(x, y)| if is_black(x, y) { 0xFF00_0000 } else { grey })
            .collect()
    }

    /// The red channel of a smoothed picture.
    fn smoothed(pixels: &[u32]) -> impl Fn(i32, i32) -> u8 + use<> {
        let mut pixels = pixels.to_vec();
        smaa(&mut pixels, SIZE, VALUES);
        move |x, y| pixels[usize::try_from(y * 64 + x).expect("inside")].to_be_bytes()[1]
    }

    #[test]
    fn a_long_step_becomes_an_even_ramp() {
        // Stairs of 20 pixels, black below: a Z from column 20 to 40, whose line goes from half a pixel above to half below.
        let pixels = picture(255, |x, y| y >= 12 - x / 20);
        let found = smoothed(&pixels);
        for i in 0..10 {
            let part = 0.5 - (f64::from(i) + 0.5) / 20.0;
            let expected = 255.0 * part;
            let [begin, end] = [found(20 + i, 11), found(39 - i, 10)].map(f64::from);
            assert!((begin - expected).abs() <= 1.0, "{i}: {begin} for {expected}");
            assert!((255.0 - end - expected).abs() <= 1.0, "{i}: {end} for {expected}");
        }
        let told = trace(&pixels, SIZE, [24, 11], VALUES).expect("inside");
        let above = told.sides.iter().find(|side| side.neighbour == Neighbour::Above);
        let form = Pattern::Line {
            lengths: [4, 15],
            form: Form::Z,
            corner: false,
        };
        assert_eq!(above.and_then(|side| side.pattern), Some(form), "its pattern");
    }

    #[test]
    fn an_l_goes_to_its_middle_and_a_u_to_both_ends() {
        // A block one pixel high and 16 wide on a plane that goes on: a U; one that goes on to the border is an L.
        let u = smoothed(&picture(255, |x, y| y >= 13 || (y == 12 && (20..36).contains(&x))));
        assert!(
            u(20, 12) > 60 && u(35, 12) > 60,
            "both ends are rounded: {} {}",
            u(20, 12),
            u(35, 12)
        );
        assert_eq!([u(20, 12), u(27, 12)], [u(35, 12), u(28, 12)], "alike");
        assert!(u(27, 12) < u(20, 12), "less in the middle");
        let l = smoothed(&picture(255, |x, y| y >= 13 || (y == 12 && x >= 44)));
        // 20 pixels to the border: the line comes down over the first ten.
        for i in 0..10 {
            let part = (0.5 - f64::from(i) / 20.0 + 0.5 - f64::from(i + 1) / 20.0) / 2.0;
            let found = f64::from(l(44 + i, 12));
            assert!((found - 255.0 * part).abs() <= 1.0, "{i}: {found} for {part}");
        }
        assert_eq!(l(56, 12), 0, "beyond the middle nothing is blended in");
    }

    #[test]
    fn diagonals_are_straight_and_corners_stay() {
        let diagonal = smoothed(&picture(255, |x, y| y > 30 - x));
        // Far from both ends every pixel of the stairs is the same: a quarter of the other side, whatever shape ends it.
        let values: Vec<u8> = (17..22).map(|x| diagonal(x, 31 - x)).collect();
        assert!(values.iter().all(|value| *value == 64), "{values:?}");
        let square = smoothed(&picture(255, |x, y| x >= 20 && y >= 8));
        assert!(
            square(20, 8) < 40,
            "a corner keeps most of its colour: {}",
            square(20, 8)
        );
        // The corner counts as stairs up to the middle of the side.
        assert_eq!(square(50, 8), 0, "a long side is no stairs");
    }

    #[test]
    fn little_contrast_is_no_edge_and_strong_edges_hide_weak_ones() {
        let step = |level: u8| picture(level, |x, y| y >= 12 - x / 20);
        for (level, is_edge) in [(25, false), (26, true)] {
            let pixels = step(level);
            let found = smoothed(&pixels);
            assert_eq!(found(20, 11) != 0, is_edge, "a step of {level}");
        }
        // Beside a column of white, a step of less than half of that is none.
        let mut pixels = step(90);
        for row in pixels.chunks_exact_mut(64) {
            row[22] = 0xFFFF_FFFF;
        }
        let told = trace(&pixels, SIZE, [21, 11], VALUES).expect("inside");
        let above = told.sides.iter().find(|side| side.neighbour == Neighbour::Above);
        let above = above.expect("a side");
        assert!(above.contrast > 0.3 && above.pattern.is_none(), "{above:?}");
    }

    #[test]
    fn what_is_told_of_a_pixel_makes_its_bytes() {
        let pixels = picture(200, |x, y| (x * 7 + y * 5) % 31 < 12 || y > 20 - x / 9);
        let mut smoothed = pixels.clone();
        smaa(&mut smoothed, SIZE, VALUES);
        for (i, expected) in (0..).zip(&smoothed) {
            let at = [i % 64, i / 64];
            let told = trace(&pixels, SIZE, at, VALUES).expect("inside");
            assert_eq!(told.after, *expected, "{at:?}");
            let level = |neighbour: Neighbour| {
                let side = told.sides.iter().find(|side| side.neighbour == neighbour);
                f64::from(side.map_or(told.before, |side| side.pixel).to_be_bytes()[1])
            };
            if !told.blended.is_empty() {
                let sum: f64 = told
                    .blended
                    .iter()
                    .map(|(neighbour, weight)| level(*neighbour) * weight)
                    .sum();
                let byte = f64::from(expected.to_be_bytes()[1]);
                assert!((sum - byte).abs() <= 0.51, "{at:?}: {sum} for {byte}");
            }
        }
        assert_eq!(trace(&pixels, SIZE, [64, 0], VALUES), None, "outside");
    }
}
