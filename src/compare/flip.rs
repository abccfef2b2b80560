//! FLIP, the error that people see when they flip between two pictures: P. Andersson, J. Nilsson, T. Akenine-Möller,
//! M. Oskarsson, K. Åström, M. D. Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proceedings of the
//! ACM on Computer Graphics and Interactive Techniques 3(2), 2020. Sections and equations below are the paper's.
//!
//! Own code: the authors' is C++ and would need a compiler on every machine that builds this program.

use std::f64::consts::PI;

use glam::{DMat3, DVec3, Mat3, Vec3};

use super::Pair;
use super::gaussian::{gaussian, normalized, single};
use super::plane::Plane;
use super::tiles::{sum, with_margin};
use crate::color::srgb_to_linear;
use crate::raster::{Framebuffer, Region};
use crate::render::CancelToken;

/// Pixels per degree of vision on the paper's display: 3840 pixels on 0.7 m, seen from 0.7 m (section 4.1).
const PIXELS_PER_DEGREE: f64 = 3840.0 * PI / 180.0;
/// Exponent of colour differences (section 4.1.3).
const QC: f32 = 0.7;
/// The share of the largest colour difference that small ones take, and where they end (section 4.1.3).
const PC: f32 = 0.4;
const PT: f32 = 0.95;
/// Width in degrees of the features that eyes detect (section 4.2).
const FEATURE_WIDTH: f64 = 0.082;
/// Pixels around a tile that its filters read: three standard deviations of the widest one.
const MARGIN: u32 = 10;

impl Pair<'_> {
    /// The mean FLIP error from 0, for equal pictures, to 1, on white paper and at the paper's 67 pixels per degree.
    /// `None` once `cancel` says so.
    pub fn flip(self, cancel: &CancelToken) -> Option<f64> {
        let [width, height] = self.size();
        let pixels = f64::from(width) * f64::from(height);
        let observer = Observer::new();
        let total = sum(Region::of_size([width, height]), cancel, |tile| {
            let errors = |part| observer.errors(self, part).map(f64::from).sum();
            self.sum_where_unlike(tile, MARGIN, 0.0, &errors)
        });
        let total = total?;
        Some(if pixels > 0.0 { total / pixels } else { 0.0 })
    }
}

/// What a picture looks like: the two pipelines of figure 1.
struct Seen {
    /// Filtered colours in L*a*b* with the Hunt effect.
    lab: Vec<Vec3>,
    /// Strength of edges and of points.
    features: [Vec<f32>; 2],
}

/// The paper's eye: its filters and colour spaces.
struct Observer {
    /// Contrast sensitivity to lightness, red against green, blue against yellow: the last is a sum of two Gaussians,
    /// each with its share.
    lightness: Vec<f32>,
    red_green: Vec<f32>,
    blue_yellow: [(f32, Vec<f32>); 2],
    /// Along and across features: a Gaussian, its first and its second derivative.
    along: Vec<f32>,
    edge: Vec<f32>,
    point: Vec<f32>,
    /// Linear sRGB to XYZ over that of white, and back.
    to_xyz: Mat3,
    to_rgb: Mat3,
    /// Linear light of a byte.
    linear: [f32; 256],
    /// The largest colour difference in sRGB: from green to blue.
    largest: f32,
}

impl Observer {
    fn new() -> Self {
        let sigma = |b: f64| (b / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE;
        // Table 1: the filter is a sum of a_i sqrt(pi / b_i) exp(-pi^2 x^2 / b_i), with x in degrees.
        let yellow = [(34.1, 0.04), (13.5, 0.025)].map(|(a, b)| {
            let kernel = gaussian(sigma(b), MARGIN);
            // In two dimensions each Gaussian weighs as the square of its sum along one.
            let sum: f64 = kernel.iter().sum();
            (a * (PI / b).sqrt() * sum * sum, kernel)
        });
        let both: f64 = yellow.iter().map(|(weight, _)| weight).sum();
        let feature = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
        let bell = gaussian(feature, reach(feature));
        let position = |i: usize| i as f64 - f64::from(reach(feature));
        let derivative = |factor: &dyn Fn(f64) -> f64| {
            let weights = bell.iter().enumerate().map(|(i, g)| factor(position(i)) * g);
            balanced(&weights.collect::<Vec<_>>())
        };
        let to_xyz = xyz_of_rgb();
        let mut observer = Self {
            lightness: normalized(&gaussian(sigma(0.0047), MARGIN)),
            red_green: normalized(&gaussian(sigma(0.0053), MARGIN)),
            blue_yellow: yellow.map(|(weight, kernel)| (single(weight / both), normalized(&kernel))),
            edge: derivative(&|x| -x),
            point: derivative(&|x| x * x / (feature * feature) - 1.0),
            along: normalized(&bell),
            to_xyz: to_xyz.as_mat3(),
            to_rgb: to_xyz.inverse().as_mat3(),
            linear: linear_bytes(),
            largest: 1.0,
        };
        observer.largest = hyab(observer.lab(Vec3::Y), observer.lab(Vec3::Z)).powf(QC);
        observer
    }

    /// FLIP's error of each pixel of a tile, row by row.
    fn errors<'o>(&'o self, pair: Pair<'_>, tile: Region) -> impl Iterator<Item = f32> + 'o {
        let a = self.see(pair.a, tile);
        let b = self.see(pair.b, tile);
        (0..a.lab.len()).map(move |i| {
            let feature = a.features.iter().zip(&b.features);
            let feature = feature.map(|(a, b)| (a[i] - b[i]).abs()).fold(0.0, f32::max);
            self.error(a.lab[i], b.lab[i], feature)
        })
    }

    /// Equations 3 to 6: colours and features that differ by so much, as one error.
    fn error(&self, a: Vec3, b: Vec3, feature: f32) -> f32 {
        if a == b {
            return 0.0;
        }
        let color = hyab(a, b).powf(QC);
        let bend = PC * self.largest;
        let color = if color < bend {
            color * PT / bend
        } else {
            PT + (color - bend) / (self.largest - bend) * (1.0 - PT)
        };
        let feature = (feature * std::f32::consts::FRAC_1_SQRT_2).sqrt();
        color.powf(1.0 - feature)
    }

    /// Both pipelines for a tile of a picture.
    fn see(&self, frame: &Framebuffer, tile: Region) -> Seen {
        let width = (tile.width + 2 * MARGIN) as usize;
        let opponents: Vec<Vec3> = with_margin(frame, tile, MARGIN)
            .into_iter()
            .map(|pixel| opponent(self.to_xyz * Vec3::from(pixel.map(|byte| self.linear[usize::from(byte)]))))
            .collect();
        let plane = |channel: fn(&Vec3) -> f32| Plane::new(width, opponents.iter().map(channel).collect());
        let margin = MARGIN as usize;
        let blurred = |plane: &Plane, kernel: &[f32]| plane.across(kernel, margin).down(kernel, margin);
        let lightness = plane(|color| color.x);
        let achromatic = blurred(&lightness, &self.lightness);
        let red_green = blurred(&plane(|color| color.y), &self.red_green);
        let raw = plane(|color| color.z);
        let yellow = [0, 1].map(|i| blurred(&raw, &self.blue_yellow[i].1));
        let [first, second] = [0, 1].map(|i| self.blue_yellow[i].0);
        let lab = (0..achromatic.values().len()).map(|i| {
            let blue_yellow = first * yellow[0].values()[i] + second * yellow[1].values()[i];
            let filtered = Vec3::new(achromatic.values()[i], red_green.values()[i], blue_yellow);
            let rgb = self.to_rgb * from_opponent(filtered);
            self.lab(rgb.clamp(Vec3::ZERO, Vec3::ONE))
        });
        Seen {
            lab: lab.collect(),
            features: self.features(&lightness),
        }
    }

    /// Section 4.2: how strong edges and points are, from the luminance that `lightness` stands for.
    fn features(&self, lightness: &Plane) -> [Vec<f32>; 2] {
        let margin = MARGIN as usize;
        let along = lightness.across(&self.along, margin);
        [&self.edge, &self.point].map(|kernel| {
            let x = lightness.across(kernel, margin).down(&self.along, margin);
            let y = along.down(kernel, margin);
            let pairs = x.values().iter().zip(y.values());
            // A luminance of 1 is a lightness of 116; its zero does not matter, since these weights sum up to none.
            pairs.map(|(x, y)| x.hypot(*y) / 116.0).collect()
        })
    }

    /// L*a*b* of linear sRGB, its chroma scaled by lightness as in equation 2 (the Hunt effect).
    fn lab(&self, rgb: Vec3) -> Vec3 {
        const DELTA: f32 = 6.0 / 29.0;
        let xyz = self.to_xyz * rgb;
        let f = xyz.map(|t| {
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
}

/// Linear sRGB (IEC 61966-2-1) to XYZ over that of white: white becomes (1, 1, 1).
fn xyz_of_rgb() -> DMat3 {
    let rows = DMat3::from_cols(
        DVec3::new(10_135_552.0, 8_788_810.0, 4_435_075.0) / 24_577_794.0,
        DVec3::new(2_613_072.0, 8_788_810.0, 887_015.0) / 12_288_897.0,
        DVec3::new(1_425_312.0, 8_788_810.0, 70_074_185.0) / 73_733_382.0,
    );
    let matrix = rows.transpose();
    DMat3::from_diagonal((matrix * DVec3::ONE).recip()) * matrix
}

fn linear_bytes() -> [f32; 256] {
    let mut byte = 0.0;
    [(); 256].map(|()| {
        let linear = srgb_to_linear(byte / 255.0);
        byte += 1.0;
        linear
    })
}

/// The opponent space Y Cx Cz of an XYZ colour over white (equation 1).
fn opponent(xyz: Vec3) -> Vec3 {
    Vec3::new(116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z))
}

/// The inverse of [`opponent`].
fn from_opponent(color: Vec3) -> Vec3 {
    let y = (color.x + 16.0) / 116.0;
    Vec3::new(color.y / 500.0 + y, y, y - color.z / 200.0)
}

/// The distance `HyAB`: city block in lightness, Euclidean in chroma.
fn hyab(a: Vec3, b: Vec3) -> f32 {
    let d = a - b;
    d.x.abs() + d.y.hypot(d.z)
}

/// The pixels that a Gaussian is cut at: three standard deviations.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a few pixels, above zero"
)]
fn reach(sigma: f64) -> u32 {
    (3.0 * sigma).ceil() as u32
}

/// Weights with positive ones that sum up to 1 and negative ones that sum up to -1.
fn balanced(weights: &[f64]) -> Vec<f32> {
    let sum = |sign: f64| weights.iter().map(|weight| (weight * sign).max(0.0)).sum::<f64>();
    let (above, below) = (sum(1.0), sum(-1.0));
    let scaled = |weight: &f64| single(weight / if *weight > 0.0 { above } else { below });
    weights.iter().map(scaled).collect()
}

/// Pictures that a few lines of any language make anew, for values from other programs.
#[cfg(test)]
pub(super) mod test_pictures {
    use crate::raster::Framebuffer;

    /// A picture whose pixel in column `x` and row `y` is `color(x, y)`, modulo 256.
    pub(crate) fn picture([width, height]: [u32; 2], color: impl Fn(u32, u32) -> [u32; 3]) -> Framebuffer {
        let mut frame = Framebuffer::new(width, height);
        for (i, pixel) in (0..).zip(frame.pixels_mut()) {
            let [r, g, b] = color(i % width, i / width).map(|channel| channel % 256);
            *pixel = 0xFF00_0000 | r << 16 | g << 8 | b;
        }
        frame
    }

    /// One grey.
    pub(crate) fn flat(size: [u32; 2], level: u32) -> Framebuffer {
        picture(size, |_, _| [level; 3])
    }

    /// All colours, and ever finer waves.
    pub(crate) fn waves(size: [u32; 2]) -> Framebuffer {
        picture(size, |x, y| [x * x / 7 + y * 5, x * 3 + y * y / 5, x * y / 3 + 40])
    }

    /// A checkerboard of cells of 3 x 4 pixels.
    pub(crate) fn hatch(size: [u32; 2]) -> Framebuffer {
        picture(size, |x, y| [if (x / 3 + y / 4) % 2 == 0 { 230 } else { 30 }; 3])
    }

    /// Three quarters of every channel, rounded down.
    pub(crate) fn dimmed(frame: &Framebuffer) -> Framebuffer {
        let old = |x, y| frame.rgba(x, y).unwrap_or_default();
        picture([frame.width(), frame.height()], |x, y| {
            let [r, g, b, _] = old(x, y).map(u32::from);
            [r, g, b].map(|channel| channel * 3 / 4)
        })
    }

    /// Moved to the right by `columns`; the first column repeats.
    pub(crate) fn shifted(frame: &Framebuffer, columns: u32) -> Framebuffer {
        let old = |x: u32, y| frame.rgba(x.saturating_sub(columns), y).unwrap_or_default();
        picture([frame.width(), frame.height()], |x, y| {
            let [r, g, b, _] = old(x, y).map(u32::from);
            [r, g, b]
        })
    }

    /// White with one black column in the middle.
    pub(crate) fn line(size: [u32; 2]) -> Framebuffer {
        picture(size, |x, _| [if x == size[0] / 2 { 0 } else { 255 }; 3])
    }
}

#[cfg(test)]
mod tests {
    use super::test_pictures::{dimmed, flat, hatch, line, shifted, waves};
    use super::*;

    const SIZE: [u32; 2] = [300, 150];

    /// What the authors' own program says: the package `flip-evaluator` 1.7 of the Python Package Index,
    /// `evaluate(a / 255, b / 255, "LDR", applyMagma=False)` at its default of 67.0206 pixels per degree, the mean of its
    /// map taken in 64 bits, and the map at (149, 70) or, in the small picture, at its last pixel.
    #[test]
    fn flip_is_what_its_authors_compute() {
        let (waves, hatch, white) = (waves(SIZE), hatch(SIZE), flat(SIZE, 255));
        let small = test_pictures::waves([7, 5]);
        for (name, a, b, mean, pixel) in [
            ("waves, dimmed", &waves, &dimmed(&waves), 0.556_729_3, 0.559_342),
            ("waves, moved", &waves, &shifted(&waves, 1), 0.247_054_5, 0.324_517),
            ("hatch, moved", &hatch, &shifted(&hatch, 2), 0.326_232_2, 0.0),
            ("a line on white", &white, &line(SIZE), 0.007_768_0, 0.487_028),
            ("two greys", &flat(SIZE, 100), &flat(SIZE, 120), 0.247_941_4, 0.247_941),
            ("black and white", &flat(SIZE, 0), &white, 0.967_388_3, 0.967_388),
            ("hatch and waves", &hatch, &waves, 0.681_093_2, 0.632_193),
            ("small", &small, &dimmed(&small), 0.100_052_3, 0.152_545),
        ] {
            let pair = Pair::new(a, b).expect("one size");
            let found = pair.flip(&CancelToken::default()).expect("not cancelled");
            assert!((found - mean).abs() < 2e-5, "{name}: mean {found} instead of {mean}");
            let place = Region::of_pixel([149.min(a.width() - 1), 70.min(a.height() - 1)]);
            let error = Observer::new().errors(pair, place).next().expect("a pixel");
            assert!((error - pixel).abs() < 1e-4, "{name}: {error} instead of {pixel}");
            let back = pair.swapped().flip(&CancelToken::default()).expect("not cancelled");
            assert!((found - back).abs() < 1e-12, "{name}: the same both ways");
        }
    }

    #[test]
    fn flip_of_equal_pictures_is_nothing() {
        let waves = waves(SIZE);
        let observer = Observer::new();
        let pair = Pair::new(&waves, &waves).expect("one size");
        assert_eq!(pair.flip(&CancelToken::default()), Some(0.0), "whole");
        let tile = Region {
            x: 40,
            y: 40,
            width: 20,
            height: 9,
        };
        assert!(
            observer.errors(pair, tile).all(|error| error == 0.0),
            "pixel by pixel, without the short cut"
        );
        let none = Framebuffer::new(3, 0);
        let pair = Pair::new(&none, &none).expect("one size");
        assert_eq!(pair.flip(&CancelToken::default()), Some(0.0), "no pixels");
        let cancel = CancelToken::default();
        cancel.cancel();
        let pair = Pair::new(&waves, &waves).expect("one size");
        assert_eq!(pair.flip(&cancel), None, "cancelled");
    }
}
