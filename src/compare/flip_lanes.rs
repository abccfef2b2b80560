//! The steps of FLIP that each pixel takes by itself, for vectors of pixels; see `flip` for what they mean. Lists of numbers are
//! as long as whole vectors: what lies behind the last pixel is computed and never read.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x16};
use glam::{Mat3, Vec3};

use super::powers::{cube_root, power};

/// Pixels of a vector.
pub(super) const LANES: usize = 16;
/// Exponent of colour differences (section 4.1.3).
pub(super) const QC: f32 = 0.7;
/// The share of the largest colour difference that small ones take, and where they end (section 4.1.3).
const PC: f32 = 0.4;
const PT: f32 = 0.95;
/// Below its cube, the function of L*a*b* is a line.
const DELTA: f32 = 6.0 / 29.0;

/// Three numbers of each pixel, one list each.
pub(super) type Channels = [Vec<f32>; 3];

/// Linear sRGB to XYZ over that of white, and back.
pub(super) struct Spaces {
    pub(super) to_xyz: Mat3,
    pub(super) to_rgb: Mat3,
}

/// What the filters of contrast sensitivity leave: lightness, red against green, and blue against yellow as two parts of so much
/// each.
pub(super) struct Filtered<'f> {
    pub(super) lightness: &'f [f32],
    pub(super) red_green: &'f [f32],
    pub(super) blue_yellow: [(f32, &'f [f32]); 2],
}

/// What a picture looks like: the two pipelines of figure 1.
pub(super) struct Seen {
    /// Filtered colours in L*a*b* with the Hunt effect.
    pub(super) lab: Channels,
    /// Strength of edges and of points.
    pub(super) features: [Vec<f32>; 2],
}

impl Spaces {
    /// Linear sRGB becomes the opponent space Y Cx Cz (equation 1).
    pub(super) fn opponents(&self, level: Level, rgb: &mut Channels) {
        dispatch!(level, simd => self.opponents_with(simd, rgb));
    }

    /// What is seen of filtered opponents, in L*a*b* with the Hunt effect (equation 2).
    pub(super) fn lab(&self, level: Level, filtered: &Filtered<'_>) -> Channels {
        let mut lab = [(); 3].map(|()| vec![0.0; filtered.lightness.len()]);
        dispatch!(level, simd => self.lab_with(simd, filtered, &mut lab));
        lab
    }

    /// The same of one pixel's linear sRGB.
    pub(super) fn lab_of(&self, rgb: Vec3) -> Vec3 {
        let f = (self.to_xyz * rgb).map(|t| {
            if t > DELTA.powi(3) {
                t.cbrt()
            } else {
                t / (3.0 * DELTA * DELTA) + 4.0 / 29.0
            }
        });
        let lightness = 116.0 * f.y - 16.0;
        let hunt = 0.01 * lightness;
        Vec3::new(lightness, 500.0 * (f.x - f.y) * hunt, 200.0 * (f.y - f.z) * hunt)
    }

    #[inline(always)]
    fn opponents_with<S: Simd>(&self, simd: S, [r, g, b]: &mut Channels) {
        let others = g.as_chunks_mut::<LANES>().0.iter_mut().zip(b.as_chunks_mut().0);
        for (r, (g, b)) in r.as_chunks_mut::<LANES>().0.iter_mut().zip(others) {
            let rgb = [load(simd, r), load(simd, g), load(simd, b)];
            let [x, y, z] = transformed(&self.to_xyz, rgb);
            (y * 116.0 - 16.0).store_array(r);
            ((x - y) * 500.0).store_array(g);
            ((y - z) * 200.0).store_array(b);
        }
    }

    #[inline(always)]
    fn lab_with<S: Simd>(&self, simd: S, filtered: &Filtered<'_>, [l, a, b]: &mut Channels) {
        let (none, all) = (f32x16::splat(simd, 0.0), f32x16::splat(simd, 1.0));
        let [(first, blue), (second, yellow)] = filtered.blue_yellow;
        let (lightness, red_green) = (filtered.lightness.as_chunks().0, filtered.red_green.as_chunks().0);
        let (blue, yellow) = (blue.as_chunks().0, yellow.as_chunks().0);
        let opponents = lightness.iter().zip(red_green).zip(blue.iter().zip(yellow));
        let chroma = a.as_chunks_mut::<LANES>().0.iter_mut().zip(b.as_chunks_mut().0);
        let lab = l.as_chunks_mut::<LANES>().0.iter_mut().zip(chroma);
        for (((lightness, red_green), (blue, yellow)), (l, (a, b))) in opponents.zip(lab) {
            let y = (load(simd, lightness) + 16.0) / 116.0;
            let x = load(simd, red_green) / 500.0 + y;
            let z = y - (load(simd, blue) * first + load(simd, yellow) * second) / 200.0;
            let [red, green, blue] = transformed(&self.to_rgb, [x, y, z]);
            let rgb = [
                red.max(none).min(all),
                green.max(none).min(all),
                blue.max(none).min(all),
            ];
            let [x, y, z] = transformed(&self.to_xyz, rgb);
            let (x, y, z) = (perceived(simd, x), perceived(simd, y), perceived(simd, z));
            let lightness = y * 116.0 - 16.0;
            let hunt = lightness * 0.01;
            lightness.store_array(l);
            ((x - y) * 500.0 * hunt).store_array(a);
            ((y - z) * 200.0 * hunt).store_array(b);
        }
    }
}

impl Seen {
    /// Equations 3 to 6: FLIP's error of each pixel, where `largest` is the largest colour difference.
    pub(super) fn errors(&self, level: Level, other: &Self, largest: f32) -> Vec<f32> {
        let mut errors = vec![0.0; self.lab[0].len()];
        dispatch!(level, simd => self.errors_with(simd, other, largest, &mut errors));
        errors
    }

    #[inline(always)]
    fn errors_with<S: Simd>(&self, simd: S, other: &Self, largest: f32, errors: &mut [f32]) {
        let none = f32x16::splat(simd, 0.0);
        let bend = PC * largest;
        for (i, errors) in errors.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
            let distance = apart(simd, i, &self.lab[0], &other.lab[0]).abs()
                + length(
                    apart(simd, i, &self.lab[1], &other.lab[1]),
                    apart(simd, i, &self.lab[2], &other.lab[2]),
                );
            let color = power(simd, distance, f32x16::splat(simd, QC));
            let small = color * (PT / bend);
            let large = (color - bend) * ((1.0 - PT) / (largest - bend)) + PT;
            let color = color.simd_lt(f32x16::splat(simd, bend)).select(small, large);
            let edge = apart(simd, i, &self.features[0], &other.features[0]).abs();
            let point = apart(simd, i, &self.features[1], &other.features[1]).abs();
            let feature = (edge.max(point) * std::f32::consts::FRAC_1_SQRT_2).sqrt();
            let error = power(simd, color, f32x16::splat(simd, 1.0) - feature);
            distance.simd_gt(none).select(error, none).store_array(errors);
        }
    }
}

/// The lengths of vectors of these coordinates, in units of so much.
pub(super) fn lengths(level: Level, [x, y]: [&[f32]; 2], unit: f32) -> Vec<f32> {
    let mut lengths = vec![0.0; x.len()];
    dispatch!(level, simd => lengths_with(simd, [x, y], unit, &mut lengths));
    lengths
}

#[inline(always)]
fn lengths_with<S: Simd>(simd: S, [x, y]: [&[f32]; 2], unit: f32, lengths: &mut [f32]) {
    let coordinates = x.as_chunks::<LANES>().0.iter().zip(y.as_chunks().0);
    for (lengths, (x, y)) in lengths.as_chunks_mut::<LANES>().0.iter_mut().zip(coordinates) {
        (length(load(simd, x), load(simd, y)) / unit).store_array(lengths);
    }
}

/// The distance `HyAB`: city block in lightness, Euclidean in chroma.
pub(super) fn hyab(a: Vec3, b: Vec3) -> f32 {
    let d = a - b;
    d.x.abs() + d.y.hypot(d.z)
}

/// The function of L*a*b*: a cube root, and a line near zero.
#[inline(always)]
fn perceived<S: Simd>(simd: S, light: f32x16<S>) -> f32x16<S> {
    let line = light / (3.0 * DELTA * DELTA) + 4.0 / 29.0;
    // Where the root is read, its number is no less.
    let least = f32x16::splat(simd, DELTA * DELTA * DELTA);
    light.simd_gt(least).select(cube_root(simd, light.max(least)), line)
}

#[inline(always)]
fn length<S: Simd>(x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
    (x * x + y * y).sqrt()
}

/// How far vector `i` of two lists is apart.
#[inline(always)]
fn apart<S: Simd>(simd: S, i: usize, a: &[f32], b: &[f32]) -> f32x16<S> {
    let part = i * LANES..(i + 1) * LANES;
    f32x16::from_slice(simd, &a[part.clone()]) - f32x16::from_slice(simd, &b[part])
}

#[inline(always)]
fn load<S: Simd>(simd: S, numbers: &[f32; LANES]) -> f32x16<S> {
    f32x16::load_array_ref(simd, numbers)
}

/// A matrix times vectors of its columns' units.
#[inline(always)]
fn transformed<S: Simd>(matrix: &Mat3, [x, y, z]: [f32x16<S>; 3]) -> [f32x16<S>; 3] {
    let [first, second, third] = matrix.to_cols_array_2d();
    [
        x * first[0] + y * second[0] + z * third[0],
        x * first[1] + y * second[1] + z * third[1],
        x * first[2] + y * second[2] + z * third[2],
    ]
}
