//! Chance that is the same every time: a counter-based generator and smooth value noise.

/// A stream of numbers that depends on its seed alone.
#[derive(Debug)]
pub(crate) struct Chance(u64);

impl Chance {
    /// The stream of `seed`.
    pub(crate) const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number in `0.0..1.0`.
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        fraction(scramble(self.0))
    }

    /// The next number in `from..to`.
    pub(crate) fn range(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }

    /// Roughly normal: mean 0, deviation 1, never beyond 6.
    pub(crate) fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.unit()).sum::<f64>() - 6.0
    }

    /// One of `items`.
    pub(crate) fn pick<T: Copy>(&mut self, items: &[T]) -> T {
        items[(self.unit() * items.len() as f64) as usize]
    }
}

/// The finisher of `SplitMix64` (Steele, Lea, Flood 2014).
const fn scramble(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

fn fraction(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// A number in `0.0..1.0` that belongs to the cell `(x, y)`.
pub(crate) fn cell(seed: u64, x: i64, y: i64) -> f64 {
    let mixed = scramble(seed ^ scramble((x as u64) ^ scramble((y as u64).wrapping_add(0x9E37_79B9))));
    fraction(mixed)
}

/// Value noise in `0.0..1.0`: cell values at whole coordinates, smooth in between.
pub(crate) fn noise(seed: u64, x: f64, y: f64) -> f64 {
    let (left, top) = (x.floor(), y.floor());
    let ease = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let (u, v) = (ease(x - left), ease(y - top));
    let (i, j) = (left as i64, top as i64);
    let above = cell(seed, i, j) * (1.0 - u) + cell(seed, i + 1, j) * u;
    let below = cell(seed, i, j + 1) * (1.0 - u) + cell(seed, i + 1, j + 1) * u;
    above * (1.0 - v) + below * v
}

/// `octaves` of noise, each half as large and twice as fine, in `0.0..1.0`.
pub(crate) fn fractal(seed: u64, octaves: u32, x: f64, y: f64) -> f64 {
    let (mut sum, mut weight, mut total, mut scale) = (0.0, 1.0, 0.0, 1.0);
    for octave in 0..octaves {
        sum += weight * noise(seed + u64::from(octave), x * scale, y * scale);
        total += weight;
        weight *= 0.5;
        scale *= 2.03;
    }
    sum / total
}
