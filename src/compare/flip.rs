//! FLIP, the error that people see when they flip between two pictures: P. Andersson, J. Nilsson, T. Akenine-Möller,
//! M. Oskarsson, K. Åström, M. D. Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proceedings of the
//! ACM on Computer Graphics and Interactive Techniques 3(2), 2020. Sections and equations below are the paper's.
//!
//! Own code: the authors' is C++ and would need a compiler on every machine that builds this program.

use std::f64::consts::PI;

use glam::{DMat3, DVec3, Vec3};

use super::Pair;
use super::flip_lanes::{Filtered, LANES, QC, Seen, Spaces, hyab, lengths};
use super::gaussian::{gaussian, normalized, single};
use super::plane::Plane;
use super::tiles::{sum, with_margin};
use crate::color::srgb_to_linear;
use crate::raster::{Framebuffer, Region};
use crate::render::CancelToken;
use crate::simd;

/// Pixels per degree of vision on the paper's display: 3840 pixels on 0.7 m, seen from 0.7 m (section 4.1).
const PIXELS_PER_DEGREE: f64 = 3840.0 * PI / 180.0;
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
            let errors = |part| observer.errors(self, part).into_iter().map(f64::from).sum();
            self.sum_where_unlike(tile, MARGIN, 0.0, &errors)
        });
        let total = total?;
        Some(if pixels > 0.0 { total / pixels } else { 0.0 })
    }
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
    spaces: Spaces,
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
            spaces: Spaces {
                to_xyz: to_xyz.as_mat3(),
                to_rgb: to_xyz.inverse().as_mat3(),
            },
            linear: linear_bytes(),
            largest: 1.0,
        };
        let seen = |rgb| observer.spaces.lab_of(rgb);
        observer.largest = hyab(seen(Vec3::Y), seen(Vec3::Z)).powf(QC);
        observer
    }

    /// FLIP's error of each pixel of a tile, row by row.
    fn errors(&self, pair: Pair<'_>, tile: Region) -> Vec<f32> {
        let mut errors = self
            .see(pair.a, tile)
            .errors(simd::level(), &self.see(pair.b, tile), self.largest);
        errors.truncate(tile.width as usize * tile.height as usize);
        errors
    }

    /// Both pipelines for a tile of a picture.
    fn see(&self, frame: &Framebuffer, tile: Region) -> Seen {
        let (width, level) = ((tile.width + 2 * MARGIN) as usize, simd::level());
        let pixels = with_margin(frame, tile, MARGIN);
        let mut opponents = [0, 1, 2].map(|channel| {
            let light = pixels.iter().map(|pixel| self.linear[usize::from(pixel[channel])]);
            in_vectors(light.collect())
        });
        self.spaces.opponents(level, &mut opponents);
        let [lightness, red_green, blue_yellow] = opponents.map(|mut values| {
            values.truncate(pixels.len());
            Plane::new(width, values)
        });
        let margin = MARGIN as usize;
        let blurred = |plane: &Plane, kernel: &[f32]| {
            let plane = plane.across(kernel, margin).down(kernel, margin);
            in_vectors(plane.into_values())
        };
        let yellow = [0, 1].map(|i| {
            let (share, kernel) = &self.blue_yellow[i];
            (*share, blurred(&blue_yellow, kernel))
        });
        let [(first, blue), (second, yellow)] = &yellow;
        let filtered = Filtered {
            lightness: &blurred(&lightness, &self.lightness),
            red_green: &blurred(&red_green, &self.red_green),
            blue_yellow: [(*first, blue), (*second, yellow)],
        };
        Seen {
            lab: self.spaces.lab(level, &filtered),
            features: self.features(&lightness),
        }
    }

    /// Section 4.2: how strong edges and points are, from the luminance that `lightness` stands for.
    fn features(&self, lightness: &Plane) -> [Vec<f32>; 2] {
        let margin = MARGIN as usize;
        let along = lightness.across(&self.along, margin);
        [&self.edge, &self.point].map(|kernel| {
            let x = in_vectors(lightness.across(kernel, margin).down(&self.along, margin).into_values());
            let y = in_vectors(along.down(kernel, margin).into_values());
            // A luminance of 1 is a lightness of 116; its zero does not matter, since these weights sum up to none.
            lengths(simd::level(), [&x, &y], 116.0)
        })
    }
}

/// Numbers with so many behind them that they fill whole vectors.
fn in_vectors(mut numbers: Vec<f32>) -> Vec<f32> {
    numbers.resize(numbers.len().next_multiple_of(LANES), 0.0);
    numbers
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
            // Where pictures are flat, features are what rounding leaves, of which a root is taken: of the two greys the authors' own
            // number is 4.3e-5 away from the exact one, 0.247_898_3, and ours half as much.
            assert!((found - mean).abs() < 3e-5, "{name}: mean {found} instead of {mean}");
            let place = Region::of_pixel([149.min(a.width() - 1), 70.min(a.height() - 1)]);
            let error = Observer::new().errors(pair, place)[0];
            assert!((error - pixel).abs() < 1e-4, "{name}: {error} instead of {pixel}");
            let back = pair.swapped().flip(&CancelToken::default()).expect("not cancelled");
            assert!((found - back).abs() < 1e-12, "{name}: the same both ways");
        }
    }

    /// Both pipelines of a tile's pixels, one by one: their colours and features.
    fn seen_one_by_one(observer: &Observer, frame: &Framebuffer, tile: Region) -> Vec<(Vec3, [f32; 2])> {
        let width = (tile.width + 2 * MARGIN) as usize;
        let opponents: Vec<Vec3> = with_margin(frame, tile, MARGIN)
            .into_iter()
            .map(|pixel| {
                let xyz = observer.spaces.to_xyz * Vec3::from(pixel.map(|byte| observer.linear[usize::from(byte)]));
                Vec3::new(116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z))
            })
            .collect();
        let plane = |channel: usize| Plane::new(width, opponents.iter().map(|color| color[channel]).collect());
        let margin = MARGIN as usize;
        let filtered =
            |channel: usize, across: &[f32], down: &[f32]| plane(channel).across(across, margin).down(down, margin);
        let lightness = filtered(0, &observer.lightness, &observer.lightness);
        let red_green = filtered(1, &observer.red_green, &observer.red_green);
        let yellow = [0, 1].map(|i| filtered(2, &observer.blue_yellow[i].1, &observer.blue_yellow[i].1));
        let features = [&observer.edge, &observer.point].map(|kernel| {
            [
                filtered(0, kernel, &observer.along),
                filtered(0, &observer.along, kernel),
            ]
        });
        let pixels = 0..lightness.values().len();
        let seen = pixels.map(|i| {
            let blue_yellow = [0, 1].map(|k| observer.blue_yellow[k].0 * yellow[k].values()[i]);
            let y = (lightness.values()[i] + 16.0) / 116.0;
            let z = y - (blue_yellow[0] + blue_yellow[1]) / 200.0;
            let rgb = observer.spaces.to_rgb * Vec3::new(red_green.values()[i] / 500.0 + y, y, z);
            let lab = observer.spaces.lab_of(rgb.clamp(Vec3::ZERO, Vec3::ONE));
            let strength = |[x, y]: &[Plane; 2]| x.values()[i].hypot(y.values()[i]) / 116.0;
            (lab, [strength(&features[0]), strength(&features[1])])
        });
        seen.collect()
    }

    #[test]
    fn errors_of_vectors_are_those_of_pixels_one_by_one() {
        let observer = Observer::new();
        let a = waves(SIZE);
        for b in [dimmed(&a), shifted(&a, 1), hatch(SIZE)] {
            // No vector ends where this tile does.
            let tile = Region {
                x: 3,
                y: 20,
                width: 61,
                height: 37,
            };
            let found = observer.errors(Pair::new(&a, &b).expect("one size"), tile);
            let [a, b] = [&a, &b].map(|frame| seen_one_by_one(&observer, frame, tile));
            assert_eq!(found.len(), a.len(), "one of each pixel");
            for (i, found) in found.into_iter().enumerate() {
                let ((a, of_a), (b, of_b)) = (a[i], b[i]);
                let color = hyab(a, b).powf(QC) / observer.largest;
                let color = if color < 0.4 {
                    color * 0.95 / 0.4
                } else {
                    0.95 + (color - 0.4) / 0.6 * 0.05
                };
                let feature = (of_a[0] - of_b[0]).abs().max((of_a[1] - of_b[1]).abs());
                let expected = color.powf(1.0 - (feature / 2.0_f32.sqrt()).sqrt());
                assert!(
                    (found - expected).abs() < 2e-5,
                    "pixel {i}: {found} instead of {expected}"
                );
            }
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
            observer.errors(pair, tile).iter().all(|error| *error == 0.0),
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
