//! Where the samples of each pixel lie, on the lattice of a sub-pixel grid.

use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::{SamplePattern, SampleRate};

/// Chooses one of all possible jitters.
const SEED: u64 = 0x5261_7374_6572_7363;

/// Column and row of a sample inside its pixel, in points of the lattice.
pub(crate) type Position = [u8; 2];

/// Where the samples of each pixel lie.
#[derive(Clone, Debug)]
pub(crate) struct SamplePositions {
    /// How many samples a pixel has.
    count: usize,
    /// Where they lie in every pixel; empty where each pixel has its own.
    same: Vec<Position>,
    /// For two samples at a time the cells in which they may lie: where each begins and how long it is, in the order in which
    /// random bits are taken; of jittered samples only.
    jitter: Vec<[[u16; 2]; 4]>,
    /// The column and the row of the frame's first pixel in what is painted.
    margin: i32,
}

/// The lattice that the samples of a pattern lie on.
pub(crate) fn lattice(pattern: SamplePattern, rate: SampleRate) -> SubpixelGrid {
    match pattern {
        SamplePattern::Grid => SubpixelGrid::new(rate.side()),
        _ => SubpixelGrid::fine(),
    }
}

impl SamplePositions {
    /// The places of a pattern on its [`lattice`].
    pub(crate) fn new(pattern: SamplePattern, rate: SampleRate) -> Self {
        let (count, side) = (rate.samples(), rate.side());
        let of = |place: &dyn Fn(u32) -> [u32; 2]| (0..count).map(|sample| place(sample).map(byte)).collect();
        let cells = cells(side);
        let same = match pattern {
            SamplePattern::Grid => of(&|i| [i % side, i / side]),
            SamplePattern::Rotated => of(&|i| rotated(i, side)),
            SamplePattern::Jittered => Vec::new(),
            SamplePattern::JitteredSame => jittered(&cells, SEED).collect(),
            SamplePattern::Halton => of(&|i| [halton(i + 1, 2), halton(i + 1, 3)]),
            SamplePattern::R2 => of(&r2),
        };
        Self {
            count: count as usize,
            same,
            jitter: if pattern == SamplePattern::Jittered {
                pairs(&cells)
            } else {
                Vec::new()
            },
            margin: 0,
        }
    }

    /// The same in a frame around which so many pixels are painted on each side.
    pub(crate) fn with_margin(self, margin: u32) -> Self {
        Self {
            margin: margin.cast_signed(),
            ..self
        }
    }

    /// How many samples a pixel has.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Whether they lie at the same places in every pixel.
    pub(crate) fn are_same(&self) -> bool {
        !self.same.is_empty()
    }

    /// Where the samples of a pixel lie, by its column and row in what is painted; `memory` is overwritten.
    #[inline]
    pub(crate) fn of_pixel<'s>(&'s self, [x, y]: [i32; 2], memory: &'s mut Vec<Position>) -> &'s [Position] {
        if !self.same.is_empty() {
            return &self.same;
        }
        // A pixel of the frame has the same ones however much is painted around it.
        let [x, y] = [x - self.margin, y - self.margin];
        let pixel = mix((u64::from(x.cast_unsigned()) | u64::from(y.cast_unsigned()) << 32) ^ SEED);
        memory.clear();
        for (number, cells) in (0..).zip(&self.jitter) {
            let random = hash(pixel, number);
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| {
                let [start, length] = cells[i].map(u32::from);
                byte(start + ((low_quarter(random >> (16 * i)) * length) >> 16))
            });
            memory.extend_from_slice(&[[a, b], [c, d]]);
        }
        memory.truncate(self.count);
        memory
    }
}

/// The canonical arrangement of `n x n` samples: in cell `(i, j)`, each axis is moved by what the other one counts.
fn rotated(sample: u32, n: u32) -> [u32; 2] {
    let (i, j) = (sample % n, sample / n);
    // Point `k` of `n^2` in a row of as many has its middle at `(k + 1/2) / n^2`.
    let at = |k: u32| (2 * k + 1) * SubpixelGrid::FINE_SIDE / (2 * n * n);
    [at(i * n + j), at(j * n + n - 1 - i)]
}

/// Where `n` cells begin along one side of a pixel, as ranges of points whose middles lie in them: start and length.
fn cells(n: u32) -> Vec<[u32; 2]> {
    // The first point of the lattice whose middle lies in cell `k` or later.
    let first = |k: u32| (2 * k * SubpixelGrid::FINE_SIDE).saturating_sub(n).div_ceil(2 * n);
    (0..n).map(|k| [first(k), first(k + 1) - first(k)]).collect()
}

/// The cells of an even number of samples, two at a time: columns and rows as [`jittered`] takes them from random bits.
fn pairs(cells: &[[u32; 2]]) -> Vec<[[u16; 2]; 4]> {
    let narrow = |cell: [u32; 2]| cell.map(|at| u16::try_from(at).unwrap_or(u16::MAX));
    let all: Vec<[[u16; 2]; 2]> = cells
        .iter()
        .flat_map(|row| cells.iter().map(|column| [narrow(*column), narrow(*row)]))
        .collect();
    let pair = |pair: &[[[u16; 2]; 2]]| {
        let [first, second] = [pair[0], pair[pair.len() - 1]];
        [first[0], first[1], second[0], second[1]]
    };
    all.chunks(2).map(pair).collect()
}

/// A place anywhere in each of `n x n` cells, as a seed says.
fn jittered(cells: &[[u32; 2]], seed: u64) -> impl Iterator<Item = Position> {
    let along = |[start, length]: [u32; 2], random: u64| byte(start + ((low_quarter(random) * length) >> 16));
    let rows = cells.iter().enumerate();
    rows.flat_map(move |(j, row)| {
        let first = j * cells.len();
        cells.iter().zip(first..).map(move |(column, sample)| {
            // 32 bits are enough for a sample.
            let random = hash(seed, sample as u64 / 2) >> (sample % 2 * 32);
            [along(*column, random), along(*row, random >> 16)]
        })
    })
}

/// The lowest 16 of some random bits.
#[inline]
fn low_quarter(random: u64) -> u32 {
    let [low, high, ..] = random.to_le_bytes();
    u16::from_le_bytes([low, high]).into()
}

/// The radical inverse of a number, in points of the lattice: its digits mirrored at the point.
fn halton(mut number: u32, base: u32) -> u32 {
    let (mut digits, mut one) = (0, 1);
    while number > 0 {
        digits = digits * base + number % base;
        one *= base;
        number /= base;
    }
    digits * SubpixelGrid::FINE_SIDE / one
}

/// Point `i` of the recurrence, in points of the lattice.
fn r2(i: u32) -> [u32; 2] {
    /// The inverse of the plastic number and of its square, as parts of `2^64`.
    const STEPS: [u64; 2] = [0xC13F_A9A9_02A6_328F, 0x91E1_0DA5_C79E_7B1D];
    STEPS.map(|step| {
        let [top, ..] = step.wrapping_mul(i.into()).wrapping_add(1 << 63).to_be_bytes();
        u32::from(top)
    })
}

/// Random bits, number by number, of a pixel.
#[inline]
fn hash(pixel: u64, number: u64) -> u64 {
    mix(pixel.wrapping_add((number + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15)))
}

/// The finaliser of `SplitMix` (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
#[inline]
fn mix(mut bits: u64) -> u64 {
    bits = (bits ^ bits >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ bits >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^ bits >> 31
}

/// A point of the lattice, which has 256 along each side at most.
#[inline]
fn byte(point: u32) -> u8 {
    debug_assert!(point < 256, "{point} lies on the lattice");
    let [low, ..] = point.to_le_bytes();
    low
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jitter_two_by_two_is_that_of_one_sample_after_the_other() {
        arbtest::arbtest(|u| {
            let side = u.int_in_range(1..=16)?;
            let rate = SampleRate::new(side * side).expect("a rate");
            let positions = SamplePositions::new(SamplePattern::Jittered, rate);
            let [x, y] = [u.int_in_range(0..=70_000)?, u.int_in_range(0..=70_000)?];
            let mut memory = vec![[9, 9]; 3];
            let found = positions.of_pixel([x, y], &mut memory);
            let pixel = mix((u64::from(x.cast_unsigned()) | u64::from(y.cast_unsigned()) << 32) ^ SEED);
            let expected: Vec<Position> = jittered(&cells(side), pixel).collect();
            assert_eq!(found, expected, "{side} x {side} in {x}, {y}");
            Ok(())
        })
        .budget_ms(200);
    }
}
