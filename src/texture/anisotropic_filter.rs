//! Filtering samples with several taps each: the mean of points along the longer side of the footprint.
//!
//! Taps lie at the same distances from every sample, because the map is affine: a sample's place is rounded once, and a
//! tap adds whole numbers to it. Sums of all taps fit 32 bits, so that they are rounded only once. Each number is that of
//! `bilinear`, whatever the vectors' width.

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i32x8};

use super::PixelSampling;
use super::bilinear::per_tap;
use super::filter_plan::{GridLevel, Plan};
use super::fixed_point::{FRACTION_BITS, tap_offset, to_fixed};
use super::sample_filter::{BLOCK, Cells, SampleVector, Source, by_fours};
use super::simd_channels::{FromColors, Spread, both_columns, mean};
use super::texel_coordinates::{Positions, columns_and_rows};

/// Samples that are filtered together, and how.
#[derive(Clone, Copy)]
struct Block<'b> {
    plan: &'b Plan<'b>,
    points: &'b [[u16; 2]],
}

/// Where the samples of a block lie in a level, in fixed point: columns, then rows.
type Centres = [[i32; BLOCK]; 2];

/// Filters samples of several taps each; see [`super::Filter::points`].
#[inline(always)]
pub(super) fn filter_with<S: Simd, C: FromColors>(simd: S, plan: &Plan<'_>, points: &[[u16; 2]], out: &mut [C]) {
    let spread = Spread::new(simd);
    let scale = per_tap(plan.line.taps.count);
    for (points, out) in points.chunks(BLOCK).zip(out.chunks_mut(BLOCK)) {
        // Left and right columns of each sample.
        let mut sums = [i32x8::splat(simd, 0); BLOCK];
        let block = Block { plan, points };
        add(simd, block, &plan.finer, spread, &mut sums);
        if let Some(level) = &plan.coarser {
            add(simd, block, level, spread, &mut sums);
        }
        by_fours!(simd, out, |i| {
            let at = |k: usize| sums[(i + k) % BLOCK];
            mean(simd, both_columns(at(0), at(1)), both_columns(at(2), at(3)), scale)
        });
    }
}

/// Adds all taps of one level.
#[inline(always)]
fn add<S: Simd>(
    simd: S,
    Block { plan, points }: Block<'_>,
    level: &GridLevel<'_>,
    spread: Spread<S>,
    sums: &mut [i32x8<S>; BLOCK],
) {
    let lanes = S::u32s::LEN;
    let last = points.len().saturating_sub(lanes);
    let mut centres: Centres = [[0; BLOCK]; 2];
    for first in (0..points.len()).step_by(lanes) {
        // The last vector begins earlier rather than to be short.
        let first = first.min(last);
        let at = Positions::new(simd, columns_and_rows(simd, &points[first..]), plan.first);
        at.far(simd, &level.x)
            .store_slice(&mut centres[0][first..first + lanes]);
        at.far(simd, &level.y)
            .store_slice(&mut centres[1][first..first + lanes]);
    }
    let number = |value| S::i32s::splat(simd, value);
    // Without its fraction a coordinate weighs its own texel alone.
    let kept = match plan.pixel {
        PixelSampling::Nearest => number(-1 << FRACTION_BITS),
        _ => number(-1),
    };
    let mut cells = Cells::EMPTY;
    for tap in 0..plan.line.taps.count {
        let [x, y] = [&level.x, &level.y].map(|axis| number(tap_offset(axis.tap(&plan.line, tap))));
        let [right, bottom] = [&level.x, &level.y].map(|axis| number(to_fixed(axis.last, axis.last).cast_signed()));
        for first in (0..points.len()).step_by(lanes) {
            let first = first.min(last);
            let columns = S::i32s::from_slice(simd, &centres[0][first..first + lanes]);
            let rows = S::i32s::from_slice(simd, &centres[1][first..first + lanes]);
            let columns = (columns + x).max(number(0)).min(right) & kept;
            let rows = (rows + y).max(number(0)).min(bottom) & kept;
            let vector = SampleVector {
                at: [columns, rows],
                first,
            };
            cells.note(simd, PixelSampling::Bilinear, level, vector);
        }
        let source = Source::new(level, &cells);
        for (i, sum) in sums.iter_mut().enumerate().take(points.len()) {
            *sum += source.bilinear(simd, spread, i);
        }
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};
    use glam::DVec2;

    use super::super::{Anisotropy, Filter, LevelSampling, MipLevel, MipPyramid, SampleGrid, SamplingSettings, UvMap};
    use super::super::{PixelSampling, oracle};
    use crate::color::Premultiplied16;
    use crate::simd;

    const SIDE: u32 = 128;

    /// A texture whose texel `(x, y)` is red, of `SIDE x SIDE`.
    fn texture(red: impl Fn(u32, u32) -> u8) -> MipPyramid {
        let texels = (0..SIDE * SIDE).map(|i| [red(i % SIDE, i / SIDE), 0, 0, 255]).collect();
        MipPyramid::build(MipLevel::new(SIDE, SIDE, texels))
    }

    /// A pixel somewhere in the middle that sees `long x short` texels, turned anyhow.
    fn pixel(u: &mut Unstructured<'_>, long: [f64; 2], short: [f64; 2]) -> Result<UvMap> {
        let mut number = |[least, most]: [f64; 2]| -> Result<f64> {
            Ok(least + (most - least) * f64::from(u.int_in_range(0..=1_000_000)?) / 1e6)
        };
        let direction = DVec2::from_angle(number([0.0, 6.3])?);
        let (long, short) = (direction * number(long)?, direction.perp() * number(short)?);
        let uv = DVec2::new(number([0.35, 0.65])?, number([0.35, 0.65])?);
        let (dx, dy) = if u.arbitrary()? { (long, short) } else { (short, long) };
        Ok(UvMap {
            pivot: DVec2::splat(0.5),
            uv,
            dx: dx / f64::from(SIDE),
            dy: dy / f64::from(SIDE),
        })
    }

    fn settings(level: LevelSampling, taps: u32) -> SamplingSettings {
        SamplingSettings {
            pixel: PixelSampling::Bilinear,
            level,
            anisotropy: Anisotropy::new(taps).expect("a maximum"),
            ..SamplingSettings::default()
        }
    }

    /// Red of the pixel, in bytes, as the kernels have it.
    fn red(pyramid: &MipPyramid, map: &UvMap, settings: &SamplingSettings) -> f64 {
        let grid = SampleGrid {
            side: 1,
            origin: [0, 0],
        };
        let mut color = [Premultiplied16::TRANSPARENT];
        Filter::new(pyramid, map, settings).points(simd::level(), grid, &[[0, 0]], &mut color);
        f64::from(color[0].0[0]) / 256.0
    }

    /// The mean of the base level over the pixel's footprint: 256 points.
    fn footprint_mean(pyramid: &MipPyramid, map: &UvMap) -> f64 {
        let grid = SampleGrid {
            side: 16,
            origin: [0, 0],
        };
        let filter = Filter::new(pyramid, map, &settings(LevelSampling::Zero, 1));
        let plan = filter.plan(grid);
        let points = (0..256).map(|i| oracle::point(&plan, [i % 16, i / 16]));
        points.map(|color| f64::from(color.0[0]) / 256.0).sum::<f64>() / 256.0
    }

    #[test]
    fn taps_come_near_the_footprint_where_trilinear_filtering_does_not() {
        // Blocks of 2 x 2 texels, black, white or between.
        let pyramid = texture(|x, y| {
            let bits = (x / 2 + y / 2 * SIDE).wrapping_mul(0x9E37_79B1);
            (bits ^ bits >> 15).wrapping_mul(0x85EB_CA77).to_be_bytes()[0]
        });
        let (mut isotropic, mut anisotropic, mut worst, mut count) = (0.0, 0.0, 0.0_f64, 0.0);
        arbtest::arbtest(|u| {
            let map = pixel(u, [4.0, 28.0], [1.0, 2.0])?;
            let truth = footprint_mean(&pyramid, &map);
            let square = |taps| (red(&pyramid, &map, &settings(LevelSampling::Linear, taps)) - truth).powi(2);
            let error = square(64);
            anisotropic += error;
            isotropic += square(1);
            worst = worst.max(error.sqrt());
            count += 1.0;
            Ok(())
        })
        .budget_ms(500);
        let (isotropic, anisotropic) = (f64::sqrt(isotropic / count), f64::sqrt(anisotropic / count));
        assert!(
            anisotropic * 2.0 < isotropic && anisotropic < 10.0 && worst < 60.0,
            "root mean squares of the errors: {anisotropic} with taps, {isotropic} without; {worst} at worst, of {count}"
        );
    }

    #[test]
    fn taps_reproduce_gradients() {
        let pyramid = texture(|x, y| u8::try_from(x + y).expect("a byte"));
        arbtest::arbtest(|u| {
            let map = pixel(u, [1.0, 16.0], [0.1, 2.0])?;
            let expected = (map.uv * f64::from(SIDE) - 0.5).element_sum();
            for level in LevelSampling::ALL {
                let settings = settings(level, u.int_in_range(1..=64)?);
                let found = red(&pyramid, &map, &settings);
                // Texels of coarser levels are rounded to bytes.
                assert!(
                    (found - expected).abs() < 0.6,
                    "{found}, not {expected}: {settings:?} {map:?}"
                );
            }
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn taps_read_what_their_places_say() {
        // One white column; the pixel is 8 texels long and centred on it.
        let pyramid = texture(|x, _| if x == 64 { 255 } else { 0 });
        let map = UvMap {
            pivot: DVec2::splat(0.5),
            uv: DVec2::new(64.5, 64.5) / f64::from(SIDE),
            dx: DVec2::new(8.0, 0.0) / f64::from(SIDE),
            dy: DVec2::new(0.0, 1.0) / f64::from(SIDE),
        };
        let read = |pixel, taps| {
            let settings = SamplingSettings {
                pixel,
                ..settings(LevelSampling::Linear, taps)
            };
            red(&pyramid, &map, &settings)
        };
        // Three taps, 2 texels apart, between levels 1 and 2: there 1 texel apart, where the middle one is on the column's
        // texel, and half a texel apart, where the right one is on it too.
        let part = (8.0_f64 / 3.0).log2() - 1.0;
        let expected = 255.0 / 2.0 / 3.0 * (1.0 - part) + 255.0 / 4.0 * 2.0 / 3.0 * part;
        assert!(
            (read(PixelSampling::Nearest, 3) - expected).abs() < 0.5,
            "one of three, and two of three"
        );
        // Eight taps at level 0, 8/9 of a texel apart, so half a step beside the column: two read 5/9 of it each.
        let expected = 255.0 * 10.0 / 9.0 / 8.0;
        assert!(
            (read(PixelSampling::Bilinear, 64) - expected).abs() < 0.1,
            "two of eight"
        );
    }
}
