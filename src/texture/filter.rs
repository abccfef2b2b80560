//! Filtering many fragments of one triangle: which levels its footprint reads, and where its samples lie in them.

use glam::DVec2;

use super::cell;
use super::sampler::LevelChoice;
use super::{LevelSampling, MipLevel, MipPyramid, PixelSampling, UvMap};
use crate::color::Premultiplied16;
use crate::rules::Rules;
use crate::simd::Level;

/// Coefficients beyond this are no triangle's: with them, sums of products could become infinite or no number.
const LARGEST: f64 = 1e200;

/// One texture read at the fragments of one triangle, under the standard rules.
///
/// A fragment's colour depends on its own position only, never on the others it is filtered with; and it is the same to
/// the last bit for every [`Level`].
#[derive(Clone, Copy, Debug)]
pub struct Filter<'a> {
    pixel: PixelSampling,
    pivot: DVec2,
    finer: FilterLevel<'a>,
    /// The next coarser level, when two are mixed.
    coarser: Option<FilterLevel<'a>>,
}

/// What the positions of samples or pixels in a list are counted from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleGrid {
    /// Samples along one side of a pixel, `1..=16`.
    pub side: u32,
    /// Column and row of the pixel whose first sample is sample `[0, 0]` of a list, and which is pixel `[0, 0]`.
    pub origin: [i32; 2],
}

/// Some pixels, and which of their samples count.
#[derive(Clone, Copy, Debug)]
pub struct PixelList<'a> {
    /// Column and row of each pixel, counted from the grid's origin.
    pub pixels: &'a [[u16; 2]],
    /// Bit `j` of `masks[i]`: whether sample `j` of `pixels[i]`, counted row by row, takes part. At most 64 samples per
    /// pixel then. Without masks all take part.
    pub masks: Option<&'a [u64]>,
}

/// One level, its weight, and the map from the screen to its texels.
#[derive(Clone, Copy, Debug)]
struct FilterLevel<'a> {
    level: &'a MipLevel,
    /// Its part of [`cell::MASS`].
    mass: i32,
    /// Coordinates at the pivot, in texels; whole numbers are corners of texels for [`PixelSampling::Nearest`], their
    /// centres for [`PixelSampling::Bilinear`].
    at_pivot: DVec2,
    /// Change per pixel.
    dx: DVec2,
    dy: DVec2,
}

/// Sample columns and rows counted from the pivot of a map.
#[derive(Clone, Copy, Debug)]
struct Grid {
    /// The sample `[0, 0]` of a list, relative to the pivot, in samples.
    first: DVec2,
    /// Samples along one side of a pixel.
    side: f64,
}

impl Grid {
    fn new(pivot: DVec2, grid: SampleGrid) -> Self {
        /// The finest part of a sample that a pivot is rounded to, far below the grid that vertices lie on: it takes
        /// back what dividing by `side` lost, so that distances are exact.
        const UNITS: f64 = (1 << 20) as f64;
        let side = f64::from(grid.side);
        let pivot = (pivot * side * UNITS).round() / UNITS;
        let origin = DVec2::new(f64::from(grid.origin[0]), f64::from(grid.origin[1]));
        Self {
            first: origin * side + 0.5 - pivot,
            side,
        }
    }
}

impl<'a> Filter<'a> {
    /// Prepares reading `pyramid` through `map`.
    pub fn new(pyramid: &'a MipPyramid, map: &UvMap, pixel: PixelSampling, level: LevelSampling) -> Self {
        let levels = pyramid.levels();
        let size = DVec2::new(f64::from(levels[0].width()), f64::from(levels[0].height()));
        let choice = LevelChoice::new(&map.footprint(), size, pyramid.last_level(), level);
        let mass = choice.next_mass();
        let prepare = |number: usize, mass| FilterLevel::new(&levels[number], mass, map, pixel);
        let (finer, coarser) = match mass {
            0 => (prepare(choice.level, cell::MASS), None),
            cell::MASS => (prepare(choice.level + 1, cell::MASS), None),
            _ => (
                prepare(choice.level, cell::MASS - mass),
                Some(prepare(choice.level + 1, mass)),
            ),
        };
        Self {
            pixel,
            pivot: map.pivot,
            finer,
            coarser,
        }
    }

    /// The premultiplied colours at samples.
    ///
    /// `points[i]` is a sample column and row counted from the first sample of the grid's origin; sample column `c` of
    /// the screen lies at `(c + 0.5) / side`. The colour at `points[i]` is written to `out[i]`.
    pub fn points(&self, simd: Level, grid: SampleGrid, points: &[[u16; 2]], out: &mut [Premultiplied16]) {
        let _ = simd;
        let grid = Grid::new(self.pivot, grid);
        for (color, point) in out.iter_mut().zip(points) {
            *color = self.point(&grid, *point);
        }
    }

    /// As [`Filter::points`], but as pixels `0xAARRGGBB`: [`Premultiplied16::to_pixel`] of the colours, which must be
    /// opaque.
    pub fn pixels(&self, simd: Level, grid: SampleGrid, points: &[[u16; 2]], out: &mut [u32]) {
        let _ = simd;
        let grid = Grid::new(self.pivot, grid);
        for (pixel, point) in out.iter_mut().zip(points) {
            *pixel = self.point(&grid, *point).to_pixel(Rules::Standard);
        }
    }

    /// The sums of the premultiplied colours over the samples of pixels, channels as in [`Premultiplied16`]. The sum over
    /// `list.pixels[i]` is written to `sums[i]`.
    ///
    /// A pixel's mean is a weighted mean of texels, so its samples are not filtered one by one where the footprint is
    /// small enough: a sum may differ from the sum of [`Filter::points`] by rounding, far below one level of a byte
    /// per sample. Where every sample reads the same colour `c`, it is exactly the number of samples times `256 c`.
    pub fn sums(&self, simd: Level, grid: SampleGrid, list: PixelList<'_>, sums: &mut [[u32; 4]]) {
        let _ = simd;
        let side = grid.side;
        let grid = Grid::new(self.pivot, grid);
        for (i, (sum, pixel)) in sums.iter_mut().zip(list.pixels).enumerate() {
            *sum = [0; 4];
            for j in 0..side * side {
                if list.masks.is_none_or(|masks| masks[i] >> j & 1 == 1) {
                    let at = [
                        u32::from(pixel[0]) * side + j % side,
                        u32::from(pixel[1]) * side + j / side,
                    ];
                    let color = self.point_at(&grid, at.map(f64::from));
                    for (sum, channel) in sum.iter_mut().zip(color.0) {
                        *sum += u32::from(channel);
                    }
                }
            }
        }
    }

    fn point(&self, grid: &Grid, point: [u16; 2]) -> Premultiplied16 {
        self.point_at(grid, point.map(f64::from))
    }

    fn point_at(&self, grid: &Grid, point: [f64; 2]) -> Premultiplied16 {
        let from_pivot = grid.first + DVec2::from_array(point);
        let mut sums = [0; 4];
        for level in [Some(&self.finer), self.coarser.as_ref()].into_iter().flatten() {
            let at = level.fixed(from_pivot, grid.side);
            cell::add(level.level, self.pixel, at, level.mass, &mut sums);
        }
        Premultiplied16(sums.map(cell::to_channel))
    }
}

impl<'a> FilterLevel<'a> {
    fn new(level: &'a MipLevel, mass: i32, map: &UvMap, pixel: PixelSampling) -> Self {
        let size = DVec2::new(f64::from(level.width()), f64::from(level.height()));
        let centre = match pixel {
            PixelSampling::Nearest => 0.0,
            PixelSampling::Bilinear => 0.5,
        };
        let (at_pivot, dx, dy) = (map.uv * size - centre, map.dx * size, map.dy * size);
        let usable = |vector: DVec2| vector.abs().max_element() < LARGEST && !vector.is_nan();
        let (at_pivot, dx, dy) = if usable(at_pivot) && usable(dx) && usable(dy) {
            (at_pivot, dx, dy)
        } else {
            (DVec2::ZERO, DVec2::ZERO, DVec2::ZERO)
        };
        Self {
            level,
            mass,
            at_pivot,
            dx,
            dy,
        }
    }

    /// Where a sample lies, in fixed point; `from_pivot` in samples.
    fn fixed(&self, from_pivot: DVec2, side: f64) -> [u32; 2] {
        let (dx, dy) = (self.dx / side, self.dy / side);
        let at = (self.at_pivot + from_pivot.x * dx) + from_pivot.y * dy;
        [
            cell::to_fixed(at.x, f64::from(self.level.width() - 1)),
            cell::to_fixed(at.y, f64::from(self.level.height() - 1)),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd;

    #[test]
    fn constant_texture_stays_constant() {
        let texel = [13, 200, 77, 255];
        let pyramid = MipPyramid::build(MipLevel::new(37, 21, vec![texel; 37 * 21]));
        let map = UvMap {
            pivot: DVec2::new(3.25, 4.5),
            uv: DVec2::new(0.1, 0.7),
            dx: DVec2::new(0.02, 0.05),
            dy: DVec2::new(-0.07, 0.03),
        };
        let grid = SampleGrid {
            side: 3,
            origin: [-2, 1],
        };
        for pixel in PixelSampling::ALL {
            for level in LevelSampling::ALL {
                let filter = Filter::new(&pyramid, &map, pixel, level);
                for (name, simd) in simd::tested() {
                    let expected = Premultiplied16(texel.map(|channel| u16::from(channel) * 256));
                    let points: Vec<_> = (0..50).map(|i| [i * 7, i * 3]).collect();
                    let mut colors = [Premultiplied16::TRANSPARENT; 50];
                    filter.points(simd, grid, &points, &mut colors);
                    assert_eq!(colors, [expected; 50], "{pixel:?} {level:?} {name}");
                    let mut pixels = [0; 50];
                    filter.pixels(simd, grid, &points, &mut pixels);
                    assert_eq!(pixels, [0xFF0D_C84D; 50], "{pixel:?} {level:?} {name}");
                    for masks in [None, Some(&[0b101_u64; 50][..])] {
                        let mut sums = [[0; 4]; 50];
                        let list = PixelList { pixels: &points, masks };
                        filter.sums(simd, grid, list, &mut sums);
                        let count = if masks.is_some() { 2 } else { 9 };
                        let expected = texel.map(|channel| u32::from(channel) * 256 * count);
                        assert_eq!(sums, [expected; 50], "{pixel:?} {level:?} {name}");
                    }
                }
            }
        }
    }
}
