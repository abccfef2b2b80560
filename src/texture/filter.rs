//! Filtering many fragments of one triangle: which levels its footprint reads, and where its samples lie in them.

use glam::DVec2;

use super::bilinear::mass;
use super::bilinear_values::BilinearList;
use super::filter_plan::{Axis, GridLevel, PixelList, Plan, TapLine};
use super::filtered_samples::SampleKernel;
use super::nearest_values::ValueList;
use super::pixel_filter::PixelWork;
use super::pyramid::NumberedLevel;
use super::{MipLevel, MipPyramid, PixelSampling, Reading, SamplingSettings, Taps, UvMap, Wrap};
use super::{fixed_point, nearest_light, nearest_scattered, nearest_values, pixel_filter};
use crate::color::{LightResolver, NearLight, Premultiplied16};
use crate::simd::Level;

/// Coefficients beyond this are no triangle's: with them, sums of products could become infinite or no number.
const LARGEST: f64 = 1e200;
/// Pivots beyond this, in pixels, are nowhere near a frame.
const FARTHEST: f64 = 1e9;
/// The most samples along one side of a pixel; those of scattered patterns are points of so fine a grid.
const MAX_SIDE: u32 = 256;

/// One texture read at the fragments of one triangle, under the standard rules.
///
/// A fragment's colour depends on its own position only, never on the others it is filtered with; and it is the same to
/// the last bit for every [`Level`].
#[derive(Clone, Copy, Debug)]
pub struct Filter<'a> {
    pixel: PixelSampling,
    wrap: Wrap,
    pivot: DVec2,
    taps: Taps,
    /// Length of the side that taps lie along, in steps of the map.
    tap_steps: f64,
    finer: FilterLevel<'a>,
    /// The next coarser level, when two are mixed.
    coarser: Option<FilterLevel<'a>>,
}

/// What the positions of samples or pixels in a list are counted from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleGrid {
    /// Samples along one side of a pixel, `1..=16`; up to 256 where each is filtered alone.
    pub side: u32,
    /// Column and row of the pixel whose first sample is sample `[0, 0]` of a list, and which is pixel `[0, 0]`.
    pub origin: [i32; 2],
}

/// One level, its weight, and the map from the screen to its texels.
#[derive(Clone, Copy, Debug)]
struct FilterLevel<'a> {
    level: &'a MipLevel,
    /// Its number in the pyramid.
    number: usize,
    /// Its part of [`fixed_point::MASS`].
    mass: i32,
    /// Coordinates at the pivot, in texels; whole numbers are corners of texels for [`PixelSampling::Nearest`], their
    /// centres for all others.
    at_pivot: DVec2,
    /// Change per pixel.
    dx: DVec2,
    dy: DVec2,
}

impl<'a> Filter<'a> {
    /// Prepares reading `pyramid` through `map` as the settings say; their rules count as the standard ones.
    pub fn new(pyramid: &'a MipPyramid, map: &UvMap, settings: &SamplingSettings) -> Self {
        let levels = pyramid.levels();
        let reading = Reading::new(&map.footprint(), pyramid, settings);
        let choice = reading.levels;
        let mass = mass(choice.next_weight);
        let numbered = |number: usize| NumberedLevel {
            level: &levels[number],
            number,
        };
        let read = match mass {
            0 => (numbered(choice.level), None),
            fixed_point::MASS => (numbered(choice.level + 1), None),
            _ => (numbered(choice.level), Some((numbered(choice.level + 1), mass))),
        };
        Self::of_levels(map, settings, reading.taps, read)
    }

    /// Prepares reading a level, and where there is one a next coarser one of so much of [`fixed_point::MASS`].
    pub(super) fn of_levels(
        map: &UvMap,
        settings: &SamplingSettings,
        taps: Taps,
        (finer, coarser): (NumberedLevel<'a>, Option<(NumberedLevel<'a>, i32)>),
    ) -> Self {
        let pixel = settings.pixel;
        let near = map.pivot.is_finite() && map.pivot.abs().max_element() < FARTHEST;
        let prepare = |level, mass| {
            let level = FilterLevel::new(level, mass, map, pixel);
            if near { level } else { level.flat() }
        };
        let rest = coarser.map_or(0, |(_, mass)| mass);
        Self {
            pixel,
            wrap: settings.wrap,
            pivot: if near { map.pivot } else { DVec2::ZERO },
            taps,
            tap_steps: settings.detail.derivatives.step(settings.sample_step),
            finer: prepare(finer, fixed_point::MASS - rest),
            coarser: coarser.map(|(level, mass)| prepare(level, mass)),
        }
    }

    /// The premultiplied colours at samples.
    ///
    /// `points[i]` is a sample column and row counted from the first sample of the grid's origin; sample column `c` of
    /// the screen lies at `(c + 0.5) / side`. The colour at `points[i]` is written to `out[i]`.
    pub fn points(&self, simd: Level, grid: SampleGrid, points: &[[u16; 2]], out: &mut [Premultiplied16]) {
        SampleKernel::new(&self.plan(grid)).filter(simd, points, out);
    }

    /// As [`Filter::points`], but as pixels `0xAARRGGBB`: [`Premultiplied16::to_pixel`] of the colours, which must be
    /// opaque.
    pub fn pixels(&self, simd: Level, grid: SampleGrid, points: &[[u16; 2]], out: &mut [u32]) {
        SampleKernel::new(&self.plan(grid)).filter(simd, points, out);
    }

    /// The sums of the premultiplied colours over the samples of pixels, channels as in [`Premultiplied16`]. The sum over
    /// `list.pixels[i]` is written to `sums[i]`.
    ///
    /// A pixel's mean is a weighted mean of texels, so its samples are not filtered one by one where the footprint is
    /// small enough: a sum may differ from the sum of [`Filter::points`] by rounding, far below one level of a byte
    /// per sample. Where every sample reads the same colour `c`, it is exactly the number of samples times `256 c`.
    pub fn sums(&self, simd: Level, grid: SampleGrid, list: PixelList<'_>, sums: &mut [[u32; 4]]) {
        pixel_filter::find(simd, &self.plan(grid), grid.side, PixelWork::of_list(list, sums));
    }

    /// [`Filter::sums`] of two lists, prepared once for both. Where there is a shorter way to the means of the first list's pixels,
    /// these are found instead of their sums; whether they are.
    pub fn sums_or_means(&self, simd: Level, grid: SampleGrid, work: PixelWork<'_>) -> bool {
        pixel_filter::find(simd, &self.plan(grid), grid.side, work)
    }

    /// For each of the pixels what red, green and blue of the texels of its samples count, or of those that take part, where each of
    /// these reads the nearest texel of one level; whether that is so. Sums over `list.pixels[i]` are written to `sums[i]`.
    pub fn value_sums(&self, simd: Level, grid: SampleGrid, list: ValueList<'_>, sums: &mut [[u64; 3]]) -> bool {
        let plan = self.plan(grid);
        if self.pixel != PixelSampling::Nearest {
            return BilinearList::new(&plan, grid.side, list).is_some_and(|list| list.sums(simd, sums));
        }
        if list.inside.len() == list.count {
            nearest_values::sum(simd, &plan, grid.side, list, sums)
        } else {
            nearest_scattered::sum(simd, &plan, grid.side, list, sums)
        }
    }

    /// The pixels of all samples of a list, which are opaque and lie in the same places in every pixel, as the means of their light, where
    /// each sample reads the nearest texel of one level; whether that is so. The pixel at `list.pixels[i]` is written to `pixels[i]`.
    pub fn light_pixels(
        &self,
        simd: Level,
        grid: SampleGrid,
        (list, resolver): (ValueList<'_>, &LightResolver),
        pixels: &mut [u32],
    ) -> bool {
        let plan = self.plan(grid);
        if self.pixel != PixelSampling::Nearest {
            let list = BilinearList::new(&plan, grid.side, list);
            return list.is_some_and(|list| list.light_pixels(simd, &NearLight::new(resolver), pixels));
        }
        list.inside.len() == list.count && nearest_light::pixels(simd, (&plan, grid.side), (list, resolver), pixels)
    }

    pub(super) fn plan(&self, grid: SampleGrid) -> Plan<'a> {
        /// Adding and subtracting this rounds to multiples of `2^-20`, far finer than the grid that vertices lie on: it
        /// takes back what dividing by `side` lost, so that distances are exact.
        const ROUND: f64 = 1.5 * (1_u64 << 32) as f64;
        let samples = grid.side;
        assert!(
            (1..=MAX_SIDE).contains(&samples),
            "{samples} x {samples} samples are not supported"
        );
        let side = f64::from(samples);
        let pivot = (self.pivot * side + ROUND) - ROUND;
        let origin = DVec2::new(f64::from(grid.origin[0]), f64::from(grid.origin[1]));
        Plan {
            pixel: self.pixel,
            wrap: self.wrap,
            first: origin * side + 0.5 - pivot,
            line: TapLine {
                taps: self.taps,
                steps: self.tap_steps * side,
            },
            finer: self.finer.on_grid(1.0 / side),
            coarser: self.coarser.map(|level| level.on_grid(1.0 / side)),
        }
    }
}

impl<'a> FilterLevel<'a> {
    fn new(numbered: NumberedLevel<'a>, mass: i32, map: &UvMap, pixel: PixelSampling) -> Self {
        let NumberedLevel { level, number } = numbered;
        let size = DVec2::new(f64::from(level.width()), f64::from(level.height()));
        let at_pivot = map.uv * size - fixed_point::first_centre(pixel);
        let (dx, dy) = (map.dx * size, map.dy * size);
        let usable = |vector: DVec2| vector.is_finite() && vector.abs().max_element() < LARGEST;
        let map = Self {
            level,
            number,
            mass,
            at_pivot,
            dx,
            dy,
        };
        if usable(at_pivot) && usable(dx) && usable(dy) {
            map
        } else {
            map.flat()
        }
    }

    /// The first texel everywhere: what is left of a map that is none.
    fn flat(self) -> Self {
        Self {
            at_pivot: DVec2::ZERO,
            dx: DVec2::ZERO,
            dy: DVec2::ZERO,
            ..self
        }
    }

    fn on_grid(&self, sample: f64) -> GridLevel<'a> {
        let axis = |at_pivot, right: f64, down: f64, size: u32| Axis {
            at_pivot,
            right: right * sample,
            down: down * sample,
            last: f64::from(size - 1),
        };
        GridLevel {
            level: self.level,
            number: self.number,
            mass: self.mass,
            x: axis(self.at_pivot.x, self.dx.x, self.dy.x, self.level.width()),
            y: axis(self.at_pivot.y, self.dx.y, self.dy.y, self.level.height()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Anisotropy, LevelSampling};
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
            for (level, taps) in LevelSampling::ALL.into_iter().zip([1, 2, 64]) {
                let settings = SamplingSettings {
                    pixel,
                    level,
                    anisotropy: Anisotropy::new(taps).expect("a maximum"),
                    ..SamplingSettings::default()
                };
                let filter = Filter::new(&pyramid, &map, &settings);
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
