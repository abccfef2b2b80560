//! Where a primitive is shaded that is shaded once for all of its samples in a pixel.
//!
//! Neither the middle of a pixel nor the mean of some samples need be a sample itself. So shaders are prepared on other grids of
//! the same units: one that has a sample in the middle of each pixel, and one that is dense enough for any mean.

use crate::color::Premultiplied16;
use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::shading::context::{ShadeContext, ShadedSample};
use crate::texture::SampleGrid;

/// A place in a pixel where a primitive is shaded for all of its samples there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShadingPlace {
    /// The grid that it lies on, and the column and row of the sample there.
    pub(in crate::raster) grid: SubpixelGrid,
    pub(in crate::raster) at: [u16; 2],
}

impl ShadingPlace {
    /// The middle of a pixel.
    pub(in crate::raster) fn centre(grid: SubpixelGrid) -> Self {
        let grid = grid.with_centres();
        // At most 15 samples.
        let middle = u16::try_from(grid.side() / 2).unwrap_or(0);
        Self { grid, at: [middle; 2] }
    }

    /// The mean of so many samples of a grid, by the sums of their columns and rows; to the nearest place of a dense grid, no
    /// further from it than 1/256 of a pixel along either axis. The middle of the pixel where there are none.
    pub(in crate::raster) fn centroid(grid: SubpixelGrid, count: u32, sums: [u32; 2]) -> Self {
        if count == 0 {
            return Self::centre(grid);
        }
        let dense = grid.dense();
        let finer = dense.side().cast_unsigned() / grid.side().cast_unsigned();
        // Sample `i` lies at `i + 1/2`, and so does what is looked for: the whole part of the mean is its number.
        let at = sums.map(|sum| u16::try_from((2 * sum + count) * finer / (2 * count)).unwrap_or(u16::MAX));
        Self { grid: dense, at }
    }

    /// Where it is: `(0, 0)` is the pixel's top left corner, `(1, 1)` its bottom right one.
    pub fn position(self) -> [f64; 2] {
        self.at.map(|at| self.grid.sample_position(at.into()))
    }

    /// It in the pixel whose first sample on its grid is the origin's of `context`, which is on its grid.
    pub(in crate::raster) fn in_pixel(self, context: &ShadeContext<'_>, pixel: [i32; 2]) -> ShadedSample {
        ShadedSample {
            grid: context.samples_from(pixel),
            place: self.at,
        }
    }
}

/// The centres of pixels as samples of a grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Centres(ShadingPlace);

impl Centres {
    pub(super) fn new(context: &ShadeContext<'_>) -> Self {
        Self(ShadingPlace::centre(context.grid))
    }

    /// The grid that they are samples of.
    pub(super) fn grid(self) -> SubpixelGrid {
        self.0.grid
    }

    /// The centres of pixels of a tile, counted from the first sample of the first pixel of `tile`; and from which those are.
    pub(super) fn of_pixels(self, tile: SampleGrid, pixels: &[[u16; 2]]) -> (SampleGrid, Vec<[u16; 2]>) {
        let side = self.0.grid.side().cast_unsigned();
        let first = u16::try_from(side).unwrap_or(1);
        let centre = |pixel: [u16; 2]| [0, 1].map(|axis| pixel[axis] * first + self.0.at[axis]);
        (
            SampleGrid { side, ..tile },
            pixels.iter().map(|pixel| centre(*pixel)).collect(),
        )
    }

    /// Gives samples of a tile the colours of their pixels' centres, which `shade` finds: once for samples of the same pixel that
    /// follow each other.
    pub(super) fn points(
        self,
        tile: SampleGrid,
        points: &[[u16; 2]],
        colors: &mut [Premultiplied16],
        shade: impl FnOnce(SampleGrid, &[[u16; 2]], &mut [Premultiplied16]),
    ) {
        let pixel_of = |point: &[u16; 2]| point.map(|at| u16::try_from(u32::from(at) / tile.side).unwrap_or(0));
        let mut pixels: Vec<[u16; 2]> = points.iter().map(pixel_of).collect();
        pixels.dedup();
        let (grid, centres) = self.of_pixels(tile, &pixels);
        let mut found = vec![Premultiplied16::TRANSPARENT; centres.len()];
        shade(grid, &centres, &mut found);
        let mut all = pixels.iter().zip(found).peekable();
        for (point, color) in points.iter().zip(colors) {
            let pixel = pixel_of(point);
            while let Some((known, shaded)) = all.peek() {
                if **known == pixel {
                    *color = *shaded;
                    break;
                }
                all.next();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn centres_are_in_the_middle_of_any_grid() {
        let grids = (1..=16).map(SubpixelGrid::new).chain([SubpixelGrid::fine()]);
        for grid in grids {
            let [x, y] = ShadingPlace::centre(grid).position();
            assert!((x - 0.5).abs() < 1e-12 && (y - 0.5).abs() < 1e-12, "{grid:?}: {x}, {y}");
        }
    }

    #[test]
    fn samples_get_the_colours_of_their_pixels_centres() {
        let context = SubpixelGrid::new(6);
        let centres = Centres(ShadingPlace::centre(context));
        let tile = SampleGrid {
            side: 6,
            origin: [7, 2],
        };
        let points = [[0, 0], [5, 5], [6, 5], [11, 0], [3, 3], [3, 6]];
        let mut colors = [Premultiplied16::TRANSPARENT; 6];
        let mut asked = 0;
        centres.points(tile, &points, &mut colors, |grid, points, colors| {
            asked = points.len();
            assert_eq!(
                grid,
                SampleGrid {
                    side: 3,
                    origin: [7, 2]
                },
                "half as dense: 3 is odd"
            );
            for ([x, y], color) in points.iter().zip(colors) {
                assert!(x % 3 == 1 && y % 3 == 1, "{x}, {y} is in the middle of a pixel");
                *color = Premultiplied16([*x, *y, 0, 0]);
            }
        });
        let found = colors.map(|color| [color.0[0], color.0[1]]);
        assert_eq!(found, [[1, 1], [1, 1], [4, 1], [4, 1], [1, 1], [1, 4]], "{points:?}");
        assert_eq!(asked, 4, "the same pixel twice in a row is asked for once");
    }

    #[test]
    fn centroids_are_means_of_samples() {
        arbtest::arbtest(|u| {
            let side = u.int_in_range(1..=16_u8)?;
            let grid = if u.arbitrary()? {
                SubpixelGrid::new(side.into())
            } else {
                SubpixelGrid::fine()
            };
            let last = u8::try_from(grid.side() - 1).expect("at most 256");
            let count = u.int_in_range(1..=256_u32)?;
            let samples = (0..count)
                .map(|_| Ok([u.int_in_range(0..=last)?, u.int_in_range(0..=last)?]))
                .collect::<arbtest::arbitrary::Result<Vec<[u8; 2]>>>()?;
            let sums = [0, 1].map(|axis| samples.iter().map(|sample| u32::from(sample[axis])).sum());
            let found = ShadingPlace::centroid(grid, count, sums).position();
            for axis in [0, 1] {
                let places = samples.iter().map(|sample| grid.sample_position(sample[axis].into()));
                let mean = places.sum::<f64>() / f64::from(count);
                assert!(
                    (found[axis] - mean).abs() <= 1.0 / 256.0 + 1e-12,
                    "{grid:?}, {samples:?}: {} instead of {mean}",
                    found[axis]
                );
            }
            Ok(())
        })
        .budget_ms(200);
    }
}
