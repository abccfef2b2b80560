//! Pixels of colours that lie in planes, from the places of all their samples: the same as by shading each sample for itself and painting
//! flat colours over it, where there are some.
//!
//! A pixel nearly always follows from the colour at the middle of its samples and from how far these are spread around it
//! ([`crate::color::ValueSpread`]). What that leaves open is shaded sample by sample.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f32x16};

use crate::color::{PIXELS, Premultiplied16, SampleMean};
use crate::raster::SampleRate;
use crate::raster::attributes::Planes;
use crate::raster::sampling::place_sums::PlaceSums;
use crate::raster::shading::context::{BoundedPixels, Pixels, PlacedPixels};
use crate::raster::shading::kind::Shade;
use crate::raster::shading::near_planes::{PlaceSpreads, TintedPlanes, blocks, number};
use crate::rules::Rules;
use crate::simd;

/// The most samples that are shaded together: those of one pixel, or of some pixels that have fewer.
const MOST_SAMPLES: usize = SampleRate::MAX as usize;
/// Most pixels have no more, and few are open in a list: clearing memory for more takes as long as to shade them.
const FEW_SAMPLES: usize = 16;

/// Opaque colours in planes.
#[derive(Clone, Copy)]
pub(super) struct PlaneColors<'a> {
    /// Red, green and blue in units of [`Premultiplied16`].
    pub(super) planes: &'a Planes<3>,
    /// What gives single samples their colours.
    pub(super) shade: &'a dyn Shade,
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
        dispatch!(simd::level(), simd => bounded_with(simd, &shown, (pixels, middle), is_linear, (values, open)));
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
    let same = if placed.are_same() {
        PlaceSums::of_all(simd, placed.inside)
    } else {
        PlaceSums::default()
    };
    // Of samples whose places differ from pixel to pixel, the lattice's first point.
    let known = same.means();
    let reach = f64::from(placed.pixels.grid.side - 1);
    let near = TintedPlanes::new(colors.planes, placed.tints).near(placed.pixels, known, reach);
    let (mut spread, mut open) = (PlaceSpreads::of_each(simd, &same), Vec::new());
    for (range, known) in blocks(values.len()) {
        let values = &mut values[range.clone()];
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
        simd::put_lanes(pixels, values);
        open.extend(lanes_without(certain, known..values.len()).map(|i| range.start + i));
    }
    if !open.is_empty() {
        by_samples(colors.shade, placed, &open, mean, values);
    }
}

#[inline(always)]
fn bounded_with<S: Simd>(
    simd: S,
    shown: &TintedPlanes,
    (bounded, middle): (BoundedPixels<'_>, f64),
    is_linear: bool,
    (values, open): (&mut [u32], &mut Vec<usize>),
) {
    let Pixels { grid, places } = bounded.pixels;
    let reach = f64::from(grid.side * (2 * bounded.margin + 1) - 1);
    let near = shown.near(bounded.pixels, [middle; 2], reach);
    for (range, known) in blocks(values.len()) {
        let (values, places) = (&mut values[range.clone()], &places[range.clone()]);
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
        simd::put_lanes(pixels, values);
        open.extend(lanes_without(certain, known..values.len()).map(|i| range.start + i));
    }
}

/// Of some lanes those that have no bit.
#[inline(always)]
fn lanes_without(bits: u64, lanes: Range<usize>) -> impl Iterator<Item = usize> {
    let mut rest = !bits & ((1 << lanes.end) - 1) & (u64::MAX << lanes.start);
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

/// The pixels of these numbers, from each of their samples.
fn by_samples(shade: &dyn Shade, placed: PlacedPixels<'_>, open: &[usize], mean: &SampleMean, values: &mut [u32]) {
    if placed.count <= FEW_SAMPLES {
        by_some_samples::<{ 4 * FEW_SAMPLES }>(shade, placed, open, mean, values);
    } else {
        by_some_samples::<MOST_SAMPLES>(shade, placed, open, mean, values);
    }
}

/// The same, up to `MOST` samples at once.
#[inline(never)]
fn by_some_samples<const MOST: usize>(
    shade: &dyn Shade,
    placed: PlacedPixels<'_>,
    open: &[usize],
    mean: &SampleMean,
    values: &mut [u32],
) {
    let Pixels { grid, places } = placed.pixels;
    let side = u16::try_from(grid.side).unwrap_or(u16::MAX);
    let (mut points, mut colors) = ([[0; 2]; MOST], [Premultiplied16::TRANSPARENT; MOST]);
    let mut pixels = [0; PIXELS];
    let together = (MOST / placed.count.max(1)).clamp(1, PIXELS);
    for open in open.chunks(together) {
        for (i, points) in open.iter().zip(points.chunks_exact_mut(placed.count)) {
            for (point, inside) in points.iter_mut().zip(placed.inside(*i)) {
                *point = [0, 1].map(|axis| places[*i][axis].wrapping_mul(side).wrapping_add(inside[axis].into()));
            }
        }
        let samples = open.len() * placed.count;
        let (points, colors) = (&points[..samples], &mut colors[..samples]);
        shade.points(grid, points, colors);
        for tint in placed.tints {
            tint.over_all(colors, Rules::Standard);
        }
        mean.opaque_pixels(colors, &mut pixels[..open.len()]);
        for (i, pixel) in open.iter().zip(pixels) {
            values[*i] = pixel;
        }
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
    use crate::raster::shading::kernel::ONE;
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
            let mut values = [
                [unit()?, unit()?, unit()?],
                [unit()?, 0.0, unit()?],
                [unit()?, unit()?, 1.0],
            ];
            // Pure colours have channels that are black everywhere.
            if u.ratio(1, 4)? {
                for corner in &mut values {
                    corner[1] = 0.0;
                }
            }
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
