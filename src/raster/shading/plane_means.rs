//! Pixels of colours that lie in planes, from the places of all their samples: the same as by shading each sample for itself and painting
//! flat colours over it, where there are some.
//!
//! A pixel nearly always follows from the colour at the middle of its samples and from how far these are spread around it
//! ([`crate::color::ValueSpread`]). What that leaves open is shaded sample by sample.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f64x8, u64x8};

use crate::color::{Premultiplied16, SampleMean, SpreadLimits, ValueLimits, ValueSpread};
use crate::raster::SampleRate;
use crate::raster::attributes::Planes;
use crate::raster::sampling::place_sums::PlaceSums;
use crate::raster::sampling::positions::Position;
use crate::raster::shading::context::{BoundedPixels, Pixels, PlacedPixels};
use crate::raster::shading::kernel::{LANES, ONE, columns_and_rows, first_sample, low_word, number};
use crate::raster::shading::kind::Shade;
use crate::rules::Rules;
use crate::simd;

/// Samples of a pixel that take little memory, and as many as there may be.
const FEW: usize = 16;
const MANY: usize = SampleRate::MAX as usize;

/// How the samples of [`LANES`] pixels are spread, in points of the lattice.
pub(super) struct PlaceSpreads {
    /// Of columns and of rows.
    pub(super) mean: [[f64; LANES]; 2],
    /// The mean squares of how far columns and rows are from there, and between these the mean of their products.
    pub(super) squares: [[f64; LANES]; 3],
}

/// Opaque colours in planes.
#[derive(Clone, Copy)]
pub(super) struct PlaneColors<'a> {
    /// Red, green and blue in units of [`Premultiplied16`].
    pub(super) planes: &'a Planes<3>,
    /// What gives single samples their colours.
    pub(super) shade: &'a dyn Shade,
}

/// Planes through what samples show once flat colours are painted over them.
pub(super) struct TintedPlanes {
    /// In units of [`Premultiplied16`].
    pub(super) planes: Planes<3>,
    pub(super) limits: [ValueLimits; 3],
}

impl PlaneColors<'_> {
    /// All of the pixels.
    pub(super) fn means(self, pixels: PlacedPixels<'_>, mean: &SampleMean, values: &mut [u32]) {
        dispatch!(simd::level(), simd => means_with(simd, self, pixels, mean, values));
    }

    /// Those of the pixels for which it does not matter where between these ends the means of their samples lie, and the numbers of all
    /// others; `false` where these would be most.
    pub(super) fn bounded(
        self,
        pixels: BoundedPixels<'_>,
        mean: &SampleMean,
        values: &mut [u32],
        open: &mut Vec<usize>,
    ) -> bool {
        let [least, most] = pixels.mean_range;
        let (middle, half) = (f64::midpoint(least, most), (most - least) / 2.0);
        let shown = TintedPlanes::new(self.planes, pixels.tints).weighted(pixels.unsigned);
        let Some(shown) = shown.moved_by(half) else {
            return false;
        };
        let is_linear = matches!(mean, SampleMean::Linear(_));
        let limits = shown.spread_limits(f64::from(pixels.pixels.grid.side * (2 * pixels.margin + 1)));
        let shown = (&shown, &limits, middle);
        dispatch!(simd::level(), simd => bounded_with(simd, shown, pixels.pixels, is_linear, (values, open)));
        true
    }
}

#[inline(always)]
fn means_with<S: Simd>(
    simd: S,
    colors: PlaneColors<'_>,
    placed: PlacedPixels<'_>,
    mean: &SampleMean,
    values: &mut [u32],
) {
    let grid = placed.pixels.grid;
    let (first, side) = (first_sample(grid), f64::from(grid.side));
    let is_linear = matches!(mean, SampleMean::Linear(_));
    let planes = colors.planes;
    let shown = TintedPlanes::new(planes, placed.tints);
    let limits = shown.spread_limits(side);
    let per_sample = 1.0 / f64::from(u32::try_from(placed.count.max(1)).unwrap_or(u32::MAX));
    let mut spread = PlaceSpreads::of_all(simd, placed.inside(0));
    for (block, values) in values.chunks_mut(LANES).enumerate() {
        let at = block * LANES;
        let places = &placed.pixels.places[at..at + values.len()];
        let means = if placed.are_same() {
            spread.means(simd)
        } else if is_linear {
            for i in 0..places.len() {
                spread.set(i, &PlaceSums::of_all(simd, placed.inside(at + i)));
            }
            spread.means(simd)
        } else {
            // What is stored does not depend on squares.
            let inside = placed.part(at..at + places.len()).inside;
            let both = PlaceSums::places_of_pixels(simd, placed.count, inside);
            [number(both & 0xFFFF) * per_sample, number(both >> 16) * per_sample]
        };
        let [columns, rows] = columns_and_rows(simd, places);
        let right = columns * side + (first[0] - planes.pivot[0]) + means[0];
        let down = rows * side + (first[1] - planes.pivot[1]) + means[1];
        let (pixels, certain) = shown.pixels(
            [right, down],
            &limits,
            #[inline(always)]
            |values, [dx, dy]| {
                if !is_linear {
                    return values.bytes(simd);
                }
                values.bytes_of_light(
                    simd,
                    #[inline(always)]
                    || [spread.squares_along(simd, [dx, dy]); 2],
                )
            },
        );
        let pixels = pixels.to_array();
        for (i, value) in values.iter_mut().enumerate() {
            *value = if certain >> i & 1 == 1 {
                low_word(pixels[i])
            } else if placed.count <= FEW {
                one_by_one::<FEW>(colors.shade, placed, at + i, mean)
            } else {
                one_by_one::<MANY>(colors.shade, placed, at + i, mean)
            };
        }
    }
}

#[inline(always)]
fn bounded_with<S: Simd>(
    simd: S,
    (shown, limits, middle): (&TintedPlanes, &[SpreadLimits; 3], f64),
    Pixels { grid, places }: Pixels<'_>,
    is_linear: bool,
    (values, open): (&mut [u32], &mut Vec<usize>),
) {
    let (first, side) = (first_sample(grid), f64::from(grid.side));
    let from_pivot = [0, 1].map(|axis| first[axis] + middle - shown.planes.pivot[axis]);
    let blocks = values.chunks_mut(LANES).zip(places.chunks(LANES));
    for (block, (values, places)) in blocks.enumerate() {
        let [columns, rows] = columns_and_rows(simd, places);
        let middle = [columns * side + from_pivot[0], rows * side + from_pivot[1]];
        let (pixels, certain) = shown.pixels(
            middle,
            limits,
            #[inline(always)]
            |values, _| {
                if is_linear {
                    // No values are spread wider than when half of them lie at either end.
                    let squares = f64x8::splat(simd, values.limits.reach * values.limits.reach / 4.0);
                    values.bytes_of_light(
                        simd,
                        #[inline(always)]
                        || [f64x8::splat(simd, 0.0), squares],
                    )
                } else {
                    values.bytes(simd)
                }
            },
        );
        let pixels = pixels.to_array();
        for (i, value) in values.iter_mut().enumerate() {
            *value = low_word(pixels[i]);
            if certain >> i & 1 == 0 {
                open.push(block * LANES + i);
            }
        }
    }
}

/// Pixel `i` of the list, from each of its samples, of which there are at most `N`.
#[inline(never)]
fn one_by_one<const N: usize>(shade: &dyn Shade, placed: PlacedPixels<'_>, i: usize, mean: &SampleMean) -> u32 {
    let Pixels { grid, places } = placed.pixels;
    let (place, inside) = (places[i], placed.inside(i));
    let (mut points, mut colors) = ([[0; 2]; N], [Premultiplied16::TRANSPARENT; N]);
    let side = u16::try_from(grid.side).unwrap_or(u16::MAX);
    for (point, inside) in points.iter_mut().zip(inside) {
        *point = [0, 1].map(|axis| place[axis].wrapping_mul(side).wrapping_add(inside[axis].into()));
    }
    let (points, colors) = (&points[..inside.len()], &mut colors[..inside.len()]);
    shade.points(grid, points, colors);
    for tint in placed.tints {
        tint.over_all(colors, Rules::Standard);
    }
    mean.pixel(colors)
}

impl TintedPlanes {
    /// Source-over of one after the other keeps planes plane. Every one rounds what it leaves of what was rounded before it.
    #[inline(always)]
    pub(super) fn new(planes: &Planes<3>, tints: &[Premultiplied16]) -> Self {
        let (mut planes, mut limits) = (*planes, [ValueLimits::STORED; 3]);
        for tint in tints {
            let left = 1.0 - f64::from(tint.0[3]) / ONE;
            planes = planes.scaled(left);
            for ((at_pivot, limits), channel) in planes.at_pivot.iter_mut().zip(&mut limits).zip(tint.0) {
                let channel = f64::from(channel);
                *at_pivot += channel;
                limits.rounded = limits.rounded * left + 0.5;
                for end in &mut limits.range {
                    *end = (*end * left + channel).min(ONE);
                }
            }
        }
        Self { planes, limits }
    }

    /// The same where samples have weights that add up to so much without their signs: each moves the sum by what rounding moved it,
    /// times its weight.
    fn weighted(mut self, unsigned: f64) -> Self {
        for limits in &mut self.limits {
            limits.rounded *= unsigned;
        }
        self
    }

    /// The same where nobody knows how far samples have moved together, up to `points` of the lattice on each axis; `None` where few
    /// pixels would be certain.
    fn moved_by(mut self, points: f64) -> Option<Self> {
        /// Units, of the 256 of a byte, between the ends of all channels: beyond, half of the pixels are asked for twice.
        const MOST: f64 = 64.0;
        let mut all = 0.0;
        for (k, limits) in self.limits.iter_mut().enumerate() {
            limits.rounded += (self.planes.dx[k].abs() + self.planes.dy[k].abs()) * points;
            all += limits.rounded;
        }
        (all < MOST).then_some(self)
    }

    /// The pixels whose samples have these means, from the pivot, and a bit for each that is certain; `bytes` says the bytes of a
    /// channel that changes so much from one point of the lattice to the next, across and down.
    #[inline(always)]
    fn pixels<S: Simd>(
        &self,
        [right, down]: [f64x8<S>; 2],
        limits: &[SpreadLimits; 3],
        bytes: impl Fn(ValueSpread<S>, [f64; 2]) -> (u64x8<S>, u64),
    ) -> (u64x8<S>, u64) {
        let (mut pixels, mut certain) = (u64x8::splat(right.simd, 0xFF), u64::MAX);
        for k in 0..3 {
            let (found, of_channel) = bytes(
                self.spread(k, [right, down], limits),
                [self.planes.dx[k], self.planes.dy[k]],
            );
            certain &= of_channel;
            pixels = pixels << 8 | found;
        }
        (pixels, certain)
    }

    /// What is known of the channels of a square of a lattice with so many points along a side.
    pub(super) fn spread_limits(&self, side: f64) -> [SpreadLimits; 3] {
        let Self { planes, limits } = self;
        [0, 1, 2].map(|k| limits[k].within((planes.dx[k].abs() + planes.dy[k].abs()) * (side - 1.0)))
    }

    /// A channel of pixels whose samples have these means, from the pivot.
    #[inline(always)]
    pub(super) fn spread<S: Simd>(
        &self,
        k: usize,
        [right, down]: [f64x8<S>; 2],
        limits: &[SpreadLimits; 3],
    ) -> ValueSpread<S> {
        let planes = &self.planes;
        ValueSpread {
            // In the order of `Planes::at`.
            mean: down * planes.dy[k] + planes.at_pivot[k] + right * planes.dx[k],
            limits: limits[k],
        }
    }
}

impl PlaceSpreads {
    pub(super) const NONE: Self = Self {
        mean: [[0.0; LANES]; 2],
        squares: [[0.0; LANES]; 3],
    };

    /// Of samples that lie there in every pixel.
    #[inline(always)]
    fn of_all<S: Simd>(simd: S, places: &[Position]) -> Self {
        let mut spread = Self::NONE;
        spread.set(0, &PlaceSums::of_all(simd, places));
        spread.mean = spread.mean.map(|[first, ..]| [first; LANES]);
        spread.squares = spread.squares.map(|[first, ..]| [first; LANES]);
        spread
    }

    /// The mean columns and rows.
    #[inline(always)]
    fn means<S: Simd>(&self, simd: S) -> [f64x8<S>; 2] {
        [
            f64x8::simd_from(simd, self.mean[0]),
            f64x8::simd_from(simd, self.mean[1]),
        ]
    }

    /// Of values that change so much from one point of the lattice to the next, across and down, the mean squares of how far they are
    /// from their mean.
    #[inline(always)]
    pub(super) fn squares_along<S: Simd>(&self, simd: S, [dx, dy]: [f64; 2]) -> f64x8<S> {
        let [xx, xy, yy] = &self.squares;
        f64x8::simd_from(simd, *xx) * (dx * dx)
            + f64x8::simd_from(simd, *xy) * (2.0 * dx * dy)
            + f64x8::simd_from(simd, *yy) * (dy * dy)
    }

    /// In the lane of a pixel, or of a part of one, of whose samples this is known.
    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, sums: &PlaceSums) {
        let per_sample = 1.0 / f64::from(sums.count.max(1));
        let mean = |sum: u32| f64::from(sum) * per_sample;
        let [x, y] = sums.places.map(mean);
        (self.mean[0][lane], self.mean[1][lane]) = (x, y);
        let [xx, xy, yy] = sums.squares;
        self.squares[0][lane] = mean(xx) - x * x;
        self.squares[1][lane] = mean(xy) - x * y;
        self.squares[2][lane] = mean(yy) - y * y;
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};

    use super::*;
    use crate::color::{Light, ResolveSpace, SumBounds};
    use crate::geometry::edge::doubled_area;
    use crate::geometry::subpixel::GridPoint;
    use crate::raster::sampling::place_sums::{PlaceSums, PlaceSumsByMask};
    use crate::raster::sampling::positions::{SamplePositions, lattice};
    use crate::raster::shading::context::PlacedParts;
    use crate::raster::shading::vertex_kernel::point_kernel;
    use crate::raster::{SamplePattern, Seed};
    use crate::texture::SampleGrid;

    /// Colours that are rounded to nearest.
    #[derive(Debug)]
    struct OfPlanes<'a>(&'a Planes<3>);

    impl Shade for OfPlanes<'_> {
        fn points(&self, grid: SampleGrid, points: &[[u16; 2]], colors: &mut [Premultiplied16]) {
            dispatch!(simd::level(), simd => point_kernel(simd, self.0, grid, points, colors));
        }
    }

    /// A pattern's samples at some pixels, and planes through random colours on a random triangle.
    struct Case {
        pattern: SamplePattern,
        rate: SampleRate,
        planes: Planes<3>,
        grid: SampleGrid,
        places: Vec<[u16; 2]>,
        inside: Vec<Position>,
        tints: Vec<Premultiplied16>,
    }

    impl Case {
        /// `None` where the triangle has no area.
        fn new(u: &mut Unstructured<'_>) -> Result<Option<Self>> {
            let pattern = *u.choose(&SamplePattern::ALL)?;
            let rates: &[u32] = if pattern.needs_square() {
                &[1, 4, 9, 16, 64]
            } else {
                &[2, 3, 5, 16, 33, 70]
            };
            let rate = SampleRate::new(*u.choose(rates)?).expect("a rate");
            let positions = SamplePositions::new(pattern, rate, Seed::default());
            let subpixels = lattice(pattern, rate);
            let far = *u.choose(&[2_000, 40_000, 2_000_000])?;
            let mut corner = || -> Result<GridPoint> {
                let mut at = || u.int_in_range(-far..=far);
                Ok(GridPoint { x: at()?, y: at()? })
            };
            let corners = [corner()?, corner()?, corner()?];
            if doubled_area(corners) == 0 {
                return Ok(None);
            }
            let mut unit = || -> Result<f32> { Ok(f32::from(u.arbitrary::<u8>()?) / 255.0) };
            let values = [
                [unit()?, unit()?, unit()?],
                [unit()?, 0.0, unit()?],
                [unit()?, unit()?, 1.0],
            ];
            let grid = SampleGrid {
                side: subpixels.side().cast_unsigned(),
                origin: [u.int_in_range(-20..=20)?, 2],
            };
            let places: Vec<[u16; 2]> = (0..9).map(|i| [i * 3 % 7, i % 4]).collect();
            let pixels = if positions.are_same() { 1 } else { places.len() };
            let mut inside = Vec::new();
            for place in &places[..pixels] {
                let pixel = [0, 1].map(|i| grid.origin[i] + i32::from(place[i]));
                inside.extend_from_slice(positions.of_pixel(pixel, &mut Vec::new()));
            }
            let count = u.int_in_range(0..=3)?;
            let mut tint = |_| -> Result<Premultiplied16> {
                let alpha = u.int_in_range(0..=Premultiplied16::ONE)?;
                let mut channel = || u.int_in_range(0..=alpha);
                Ok(Premultiplied16([channel()?, channel()?, channel()?, alpha]))
            };
            let tints = (0..count).map(&mut tint).collect::<Result<_>>()?;
            Ok(Some(Self {
                pattern,
                rate,
                planes: Planes::new(subpixels, &corners, values).scaled(ONE),
                grid,
                places,
                inside,
                tints,
            }))
        }

        fn placed(&self) -> PlacedPixels<'_> {
            PlacedPixels {
                pixels: Pixels {
                    grid: self.grid,
                    places: &self.places,
                },
                count: self.rate.samples() as usize,
                inside: &self.inside,
                tints: &self.tints,
            }
        }

        fn colors<'a>(&'a self, shade: &'a OfPlanes<'_>) -> PlaneColors<'a> {
            PlaneColors {
                planes: &self.planes,
                shade,
            }
        }

        /// Pixel `i`, sample by sample.
        fn one_by_one(&self, i: usize, mean: &SampleMean) -> u32 {
            mean.pixel(&self.colors_of(i))
        }

        /// The colours of the samples of pixel `i`.
        fn colors_of(&self, i: usize) -> Vec<Premultiplied16> {
            let side = u16::try_from(self.grid.side).expect("at most 256");
            let inside = self.placed().inside(i).iter();
            let points: Vec<[u16; 2]> = inside
                .map(|inside| [0, 1].map(|axis| self.places[i][axis] * side + u16::from(inside[axis])))
                .collect();
            let mut colors = vec![Premultiplied16::TRANSPARENT; points.len()];
            OfPlanes(&self.planes).points(self.grid, &points, &mut colors);
            for color in &mut colors {
                for tint in &self.tints {
                    *color = tint.over(*color, Rules::Standard);
                }
            }
            colors
        }
    }

    #[test]
    fn pixels_are_those_of_their_samples_one_by_one() {
        let mut pixels_met = 0;
        arbtest::arbtest(|u| {
            let Some(case) = Case::new(u)? else {
                return Ok(());
            };
            let shade = OfPlanes(&case.planes);
            for (space, rules) in [
                (ResolveSpace::Stored, Rules::Standard),
                (ResolveSpace::Linear, Rules::Standard),
                (ResolveSpace::Linear, Rules::Float),
            ] {
                let mean = SampleMean::new(space, case.rate.samples(), rules);
                let expected: Vec<u32> = (0..case.places.len()).map(|i| case.one_by_one(i, &mean)).collect();
                for (name, level) in simd::tested() {
                    let mut found = vec![0; expected.len()];
                    dispatch!(level, simd => means_with(simd, case.colors(&shade), case.placed(), &mean, &mut found));
                    pixels_met += found.len();
                    assert_eq!(
                        found, expected,
                        "{name}, {:?}, {space:?}: {:?}",
                        case.pattern, case.planes
                    );
                }
            }
            Ok(())
        })
        .budget_ms(800);
        assert!(pixels_met > 0, "something was compared");
    }

    #[test]
    fn samples_of_parts_add_up_to_what_lies_in_their_bounds() {
        let (mut known, mut all) = (0, 0);
        arbtest::arbtest(|u| {
            let Some(case) = Case::new(u)? else {
                return Ok(());
            };
            let placed = case.placed();
            let shade = OfPlanes(&case.planes);
            let masks: Vec<u64> = (0..case.places.len())
                .map(|_| Ok(u.arbitrary::<u64>()? >> 64_usize.saturating_sub(placed.count)))
                .collect::<Result<_>>()?;
            let sums: Vec<PlaceSums> = (0..masks.len())
                .map(|i| PlaceSumsByMask::new(placed.inside(i)).of(0, masks[i]))
                .collect();
            let parts = PlacedParts {
                pixels: placed.pixels,
                sums: &sums,
                tints: &case.tints,
            };
            for space in ResolveSpace::ALL {
                let mean = SampleMean::new(space, case.rate.samples(), Rules::Standard);
                let mut bounds = vec![SumBounds::default(); masks.len()];
                case.colors(&shade).part_bounds(parts, &mean, &mut bounds);
                for (i, bounds) in bounds.iter().enumerate() {
                    let colors = case.colors_of(i);
                    let named: Vec<_> = (0..64)
                        .zip(colors)
                        .filter(|(bit, _)| masks[i] >> bit & 1 == 1)
                        .collect();
                    let light = |channel: u16| match mean {
                        SampleMean::Stored(_) => u64::from(channel),
                        SampleMean::Linear(_) => {
                            Light::new(Premultiplied16([channel, 0, 0, Premultiplied16::ONE])).opaque_red()
                        }
                    };
                    assert_eq!(bounds.count, masks[i].count_ones(), "the samples of part {i}");
                    for k in 0..3 {
                        let sum: u64 = named.iter().map(|(_, color)| light(color.0[k])).sum();
                        assert!(
                            (bounds.least[k]..=bounds.most[k]).contains(&sum),
                            "{sum}, {bounds:?}, {:?}, {space:?}: {:?}",
                            case.pattern,
                            case.planes
                        );
                    }
                    all += 1;
                    known += usize::from(*bounds != SumBounds::unknown(bounds.count, &mean));
                }
            }
            Ok(())
        })
        .budget_ms(800);
        assert!(known * 20 > all && all > 200, "{known} of {all} are known");
    }

    #[test]
    fn pixels_are_certain_only_where_all_places_give_the_same() {
        let (mut certain, mut all) = (0, 0);
        arbtest::arbtest(|u| {
            let Some(case) = Case::new(u)? else {
                return Ok(());
            };
            let positions = SamplePositions::new(case.pattern, case.rate, Seed::default());
            let bounded = BoundedPixels::new(case.placed().pixels, positions.mean_range(), &case.tints);
            let shade = OfPlanes(&case.planes);
            for space in ResolveSpace::ALL {
                let mean = SampleMean::new(space, case.rate.samples(), Rules::Standard);
                let (mut found, mut open) = (vec![0; case.places.len()], Vec::new());
                if !case.colors(&shade).bounded(bounded, &mean, &mut found, &mut open) {
                    continue;
                }
                all += found.len();
                certain += found.len() - open.len();
                for (i, found) in found.into_iter().enumerate().filter(|(i, _)| !open.contains(i)) {
                    let expected = case.one_by_one(i, &mean);
                    assert_eq!(found, expected, "{:?}, {space:?}: {:?}", case.pattern, case.planes);
                }
            }
            Ok(())
        })
        .budget_ms(800);
        assert!(certain * 5 > all && all > 200, "{certain} of {all} are certain");
    }
}
