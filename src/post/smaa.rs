//! All pixels of a picture.

use rayon::prelude::*;

use super::blend::{Around, Values};
use super::edges::{BAND, CHUNK, Edges};
use super::weights::Weights;

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
    let bands = (0..size[1].div_ceil(BAND)).into_par_iter();
    let changed: Vec<Vec<(usize, u32)>> = bands.map(|band| changes(pixels, &edges, values, band)).collect();
    for (at, pixel) in changed.into_iter().flatten() {
        pixels[at] = pixel;
    }
}

/// The weights at the edges of a row of pixels, and where there are any.
#[derive(Debug)]
struct WeightRow {
    /// One more than there are pixels.
    weights: Vec<Weights>,
    weighed: Vec<usize>,
}

impl WeightRow {
    fn new(width: usize) -> Self {
        Self {
            weights: vec![Weights::default(); width + 1],
            weighed: Vec::new(),
        }
    }

    /// Takes those of row `y`, which may be the one below the last.
    fn fill(&mut self, edges: &Edges, y: usize) {
        for x in self.weighed.drain(..) {
            self.weights[x] = Weights::default();
        }
        for (start, flags) in (0..).step_by(CHUNK).zip(edges.row(y).chunks(CHUNK)) {
            if flags.iter().fold(0, |any, flags| any | flags) == 0 {
                continue;
            }
            for (x, _) in (start..).zip(flags).filter(|(_, flags)| **flags != 0) {
                let found = Weights::of(edges, [x, y].map(place));
                if found != Weights::default() {
                    self.weights[x] = found;
                    self.weighed.push(x);
                }
            }
        }
    }
}

/// A column or a row; frames have far fewer than `2^31`.
fn place(at: usize) -> i32 {
    i32::try_from(at).unwrap_or(i32::MAX)
}

/// The pixels of some rows that change, by their index, and what they become.
fn changes(pixels: &[u32], edges: &Edges, values: Values, band: usize) -> Vec<(usize, u32)> {
    let [width, height] = edges.size;
    let mut changed = Vec::new();
    let (mut own, mut below) = (WeightRow::new(width), WeightRow::new(width));
    below.fill(edges, band * BAND);
    for y in (band * BAND..height).take(BAND) {
        std::mem::swap(&mut own, &mut below);
        below.fill(edges, y + 1);
        let mut change = |x: usize| {
            let around = Around::new(own.weights[x], own.weights[x + 1], below.weights[x]);
            if let Some(blend) = around.blend() {
                let at = y * width + x;
                // A neighbour beyond the frame weighs nothing.
                let step = if blend.is_across { 1 } else { width };
                let pixel = |at: Option<usize>| at.and_then(|at| pixels.get(at)).copied().unwrap_or(0);
                let neighbours = [at.checked_sub(step), Some(at + step)].map(pixel);
                changed.push((at, blend.pixel(pixels[at], neighbours, values)));
            }
        };
        // Each once: those with weights of their own, those left of one, and those above one.
        let is_alone = |x: usize| own.weights[x] == Weights::default();
        for x in own.weighed.iter().copied() {
            change(x);
            if own.weights[x].left[1] != 0 && x > 0 && is_alone(x - 1) {
                change(x - 1);
            }
        }
        for x in below.weighed.iter().copied() {
            if below.weights[x].top[1] != 0 && is_alone(x) && own.weights[x + 1].left[1] == 0 {
                change(x);
            }
        }
    }
    changed
}
