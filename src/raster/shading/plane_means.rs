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
use fearless_simd::{Simd, dispatch, f32x16, i32x16, u16x32, u32x16};

use crate::color::{PIXELS, Premultiplied16, SampleMean, SpreadLimits, ValueLimits, ValueSpread};
use crate::raster::SampleRate;
use crate::raster::attributes::Planes;
use crate::raster::sampling::place_sums::PlaceSums;
use crate::raster::shading::context::{BoundedPixels, Pixels, PlacedPixels};
use crate::raster::shading::kernel::{ONE, first_sample};
use crate::raster::shading::kind::Shade;
use crate::rules::Rules;
use crate::simd;

/// Samples of a pixel that take little memory, and as many as there may be.
const FEW: usize = 16;
const MANY: usize = SampleRate::MAX as usize;

/// How the samples of [`PIXELS`] pixels are spread, in points of the lattice.
pub(super) struct PlaceSpreads<S: Simd> {
    /// How many these are.
    pub(super) counts: f32x16<S>,
    /// Of columns and of rows.
    pub(super) means: [f32x16<S>; 2],
    /// The mean squares of how far columns and rows are from there, and between these the mean of their products.
    squares: [f32x16<S>; 3],
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
    planes: Planes<3>,
    limits: [ValueLimits; 3],
}

/// The same as seen from the first of some pixels: near it 32 bits are enough, and how far they are not is known.
pub(super) struct NearPlanes {
    first: [u16; 2],
    /// At some point of that pixel.
    at_first: [f32; 3],
    /// Change from one pixel to the next on its right, and to the one below.
    right: [f32; 3],
    down: [f32; 3],
    /// Change from one point of the lattice to the next.
    pub(super) dx: [f32; 3],
    pub(super) dy: [f32; 3],
    /// What is known of the values of each pixel.
    limits: [SpreadLimits; 3],
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
        let reach = f64::from(pixels.pixels.grid.side * (2 * pixels.margin + 1) - 1);
        let near = &shown.near(pixels.pixels, [middle; 2], reach);
        dispatch!(simd::level(), simd => bounded_with(simd, near, pixels.pixels.places, is_linear, (values, open)));
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
    let is_linear = matches!(mean, SampleMean::Linear(_));
    let all = PlaceSums::of_all(simd, placed.inside(0));
    // Of samples whose places differ from pixel to pixel, the lattice's first point.
    let known = if placed.are_same() { all.means() } else { [0.0; 2] };
    let reach = f64::from(placed.pixels.grid.side - 1);
    let near = TintedPlanes::new(colors.planes, placed.tints).near(placed.pixels, known, reach);
    let mut spread = PlaceSpreads::new(simd, &[all; PIXELS]);
    for (block, values) in values.chunks_mut(PIXELS).enumerate() {
        let range = block * PIXELS..block * PIXELS + values.len();
        let means = if placed.are_same() {
            None
        } else if is_linear {
            let mut sums = [PlaceSums::default(); PIXELS];
            for (sums, i) in sums.iter_mut().zip(range.clone()) {
                *sums = PlaceSums::of_all(simd, placed.inside(i));
            }
            spread = PlaceSpreads::new(simd, &sums);
            Some(spread.means)
        } else {
            // What is stored does not depend on squares.
            Some(mean_places(simd, placed.part(range.clone())))
        };
        let (pixels, certain) = near.pixels(
            near.columns_and_rows(simd, &placed.pixels.places[range.clone()]),
            means,
            #[inline(always)]
            |values, k| {
                if !is_linear {
                    return values.bytes(simd);
                }
                values.bytes_of_light(
                    simd,
                    #[inline(always)]
                    || [spread.squares_along(near.dx[k], near.dy[k]); 2],
                )
            },
        );
        put(pixels, values);
        for i in lanes_without(certain, values.len()) {
            values[i] = if placed.count <= FEW {
                one_by_one::<FEW>(colors.shade, placed, range.start + i, mean)
            } else {
                one_by_one::<MANY>(colors.shade, placed, range.start + i, mean)
            };
        }
    }
}

#[inline(always)]
fn bounded_with<S: Simd>(
    simd: S,
    near: &NearPlanes,
    places: &[[u16; 2]],
    is_linear: bool,
    (values, open): (&mut [u32], &mut Vec<usize>),
) {
    let blocks = values.chunks_mut(PIXELS).zip(places.chunks(PIXELS));
    for (block, (values, places)) in blocks.enumerate() {
        let (pixels, certain) = near.pixels(
            near.columns_and_rows(simd, places),
            None,
            #[inline(always)]
            |values, _| {
                if is_linear {
                    // No values are spread wider than when half of them lie at either end.
                    let squares = f32x16::splat(simd, values.limits.most_squares());
                    values.bytes_of_light(
                        simd,
                        #[inline(always)]
                        || [f32x16::splat(simd, 0.0), squares],
                    )
                } else {
                    values.bytes(simd)
                }
            },
        );
        put(pixels, values);
        open.extend(lanes_without(certain, values.len()).map(|i| block * PIXELS + i));
    }
}

/// Puts as many of the pixels as there is room for.
#[inline(always)]
fn put<S: Simd>(pixels: u32x16<S>, values: &mut [u32]) {
    if let Some(values) = values.first_chunk_mut() {
        pixels.store_array(values);
    } else {
        values.copy_from_slice(&pixels.as_slice()[..values.len()]);
    }
}

/// Of the first lanes, so many of them, those that have no bit.
#[inline(always)]
fn lanes_without(bits: u64, count: usize) -> impl Iterator<Item = usize> {
    let mut rest = !bits & ((1 << count) - 1);
    std::iter::from_fn(move || {
        let lane = rest.trailing_zeros() as usize;
        let is_one = rest != 0;
        rest &= rest.wrapping_sub(1);
        is_one.then_some(lane)
    })
}

/// The mean columns and rows of the samples of up to [`PIXELS`] pixels, each of which has its own.
#[inline(always)]
fn mean_places<S: Simd>(simd: S, placed: PlacedPixels<'_>) -> [f32x16<S>; 2] {
    let half = placed.inside.len().min(placed.count * (PIXELS / 2));
    let (first, second) = placed.inside.split_at(half);
    let both = PlaceSums::places_of_pixels(simd, placed.count, first).combine(PlaceSums::places_of_pixels(
        simd,
        placed.count,
        second,
    ));
    let per_sample = 1.0 / placed.count.max(1) as f32;
    [number(both & 0xFFFF) * per_sample, number(both >> 16) * per_sample]
}

/// Whole numbers as floats.
#[inline(always)]
fn number<S: Simd>(whole: u32x16<S>) -> f32x16<S> {
    f32x16::float_from(whole.bitcast::<i32x16<S>>())
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

    /// As seen from the first of these pixels, at this point of the lattice inside of it; no two samples that count for a pixel lie
    /// farther apart than `reach` on each axis.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "what is lost is told")]
    pub(super) fn near(&self, Pixels { grid, places }: Pixels<'_>, inside: [f64; 2], reach: f64) -> NearPlanes {
        /// Numbers of 32 bits are off by `2^-24` of themselves; each is, as well as up to five sums, and products of two.
        const OFF: f64 = 1.0 / (1_u32 << 21) as f64;
        let Self { planes, limits } = self;
        let (side, first) = (f64::from(grid.side), places.first().copied().unwrap_or_default());
        let from_pivot =
            |axis: usize| first_sample(grid)[axis] + f64::from(first[axis]) * side + inside[axis] - planes.pivot[axis];
        let (right, down) = (from_pivot(0), from_pivot(1));
        let [width, height] = farthest(first, places);
        let at_first = [0, 1, 2].map(|k| planes.at_pivot[k] + planes.dy[k] * down + planes.dx[k] * right);
        let of = |k: usize| {
            let [dx, dy] = [planes.dx[k].abs(), planes.dy[k].abs()];
            let most = at_first[k].abs() + (dx * (width + 1.0) + dy * (height + 1.0)) * side;
            limits[k].within((dx + dy) * reach, most * OFF)
        };
        let limits = [of(0), of(1), of(2)];
        NearPlanes {
            first,
            at_first: at_first.map(|value| value as f32),
            right: planes.dx.map(|value| (value * side) as f32),
            down: planes.dy.map(|value| (value * side) as f32),
            dx: planes.dx.map(|value| value as f32),
            dy: planes.dy.map(|value| value as f32),
            limits,
        }
    }
}

/// How many columns and rows from the first one the farthest of some pixels are.
#[inline(always)]
fn farthest(first: [u16; 2], places: &[[u16; 2]]) -> [f64; 2] {
    let (mut least, mut most) = (first, first);
    for place in places {
        for axis in 0..2 {
            least[axis] = least[axis].min(place[axis]);
            most[axis] = most[axis].max(place[axis]);
        }
    }
    [0, 1].map(|axis| f64::from((first[axis] - least[axis]).max(most[axis] - first[axis])))
}

impl NearPlanes {
    /// Columns and rows of up to [`PIXELS`] pixels, from the first one; what is left over repeats the first of them.
    #[inline(always)]
    pub(super) fn columns_and_rows<S: Simd>(&self, simd: S, places: &[[u16; 2]]) -> [f32x16<S>; 2] {
        let all = if let Some(places) = places.first_chunk() {
            *places
        } else {
            let mut all = [self.first; PIXELS];
            for (all, place) in all.iter_mut().zip(places) {
                *all = *place;
            }
            all
        };
        let both: u32x16<S> = u16x32::from_slice(simd, all.as_flattened()).bitcast();
        let [column, row] = self.first.map(f32::from);
        [number(both & 0xFFFF) - column, number(both >> 16) - row]
    }

    /// The pixels there, and a bit for each that is certain. Where samples lie at other places in each, `means` says where their
    /// middles are; `bytes` says the bytes of a channel by its number.
    #[inline(always)]
    fn pixels<S: Simd>(
        &self,
        at: [f32x16<S>; 2],
        means: Option<[f32x16<S>; 2]>,
        bytes: impl Fn(ValueSpread<S>, usize) -> (u32x16<S>, u64),
    ) -> (u32x16<S>, u64) {
        let (mut pixels, mut certain) = (u32x16::splat(at[0].simd, 0xFF), u64::MAX);
        for k in 0..3 {
            let (found, of_channel) = bytes(self.spread(k, at, means), k);
            certain &= of_channel;
            pixels = pixels << 8 | found;
        }
        (pixels, certain)
    }

    /// A channel of the pixels there.
    #[inline(always)]
    pub(super) fn spread<S: Simd>(
        &self,
        k: usize,
        [columns, rows]: [f32x16<S>; 2],
        means: Option<[f32x16<S>; 2]>,
    ) -> ValueSpread<S> {
        let mut mean = columns * self.right[k] + self.at_first[k] + rows * self.down[k];
        if let Some([columns, rows]) = means {
            mean = mean + columns * self.dx[k] + rows * self.dy[k];
        }
        ValueSpread {
            mean,
            limits: self.limits[k],
        }
    }
}

impl<S: Simd> PlaceSpreads<S> {
    /// Of samples whose places add up to this.
    #[inline(always)]
    pub(super) fn new(simd: S, sums: &[PlaceSums; PIXELS]) -> Self {
        let [mut counts, mut right, mut down] = [[0; PIXELS]; 3];
        let mut squares = [[0; PIXELS]; 3];
        for (i, sums) in sums.iter().enumerate() {
            counts[i] = sums.count;
            [right[i], down[i]] = sums.places;
            for (squares, of_sums) in squares.iter_mut().zip(sums.squares) {
                squares[i] = of_sums;
            }
        }
        let counts = number(u32x16::simd_from(simd, counts));
        let per_sample = f32x16::splat(simd, 1.0) / counts.max(f32x16::splat(simd, 1.0));
        let mean = |sums: [u32; PIXELS]| number(u32x16::simd_from(simd, sums)) * per_sample;
        let (x, y) = (mean(right), mean(down));
        let [xx, xy, yy] = squares;
        Self {
            counts,
            means: [x, y],
            squares: [mean(xx) - x * x, mean(xy) - x * y, mean(yy) - y * y],
        }
    }

    /// Of values that change so much from one point of the lattice to the next, across and down, the mean squares of how far they are
    /// from their mean.
    #[inline(always)]
    pub(super) fn squares_along(&self, dx: f32, dy: f32) -> f32x16<S> {
        let [xx, xy, yy] = self.squares;
        xx * (dx * dx) + xy * (2.0 * dx * dy) + yy * (dy * dy)
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
    use crate::raster::sampling::positions::{Position, SamplePositions, lattice};
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
            let step = *u.choose(&[1, 7])?;
            let places: Vec<[u16; 2]> = (0..21).map(|i| [i * 3 % 7 * step, i % 4 * step]).collect();
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
