//! What the kernels are held against: random textures and maps, filtering one sample at a time in integers, and
//! filtering in 64-bit floats by the definition.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_possible_wrap,
    reason = "an oracle is short and plain; its numbers are small"
)]

use arbtest::arbitrary::{Result, Unstructured};
use glam::DVec2;

use super::filter_plan::Plan;
use super::nearest_values::{ByteValues, ValueList};
use super::sample_offsets::{Footing, Footings, Scale};
use super::wrap::Endless;
use super::{
    Anisotropy, Derivatives, FixedLevel, FootprintExtent, LevelOfDetail, LevelSampling, LodBias, PixelSampling, Wrap,
};
use super::{Filter, MipLevel, MipPyramid, SampleGrid, SamplingSettings, UvMap, bilinear, fixed_point, trace};
use crate::color::Premultiplied16;

/// The colour at one sample: what the kernels do for many.
pub(super) fn point(plan: &Plan<'_>, point: [u32; 2]) -> Premultiplied16 {
    let point = point.map(|at| at as u16);
    let count = plan.line.taps.count;
    let mut sums = [0; 4];
    for level in [Some(&plan.finer), plan.coarser.as_ref()].into_iter().flatten() {
        for tap in 0..count {
            let place = trace::place(plan, level, point, tap);
            bilinear::add(level.level, (plan.pixel, plan.wrap), place, level.mass, &mut sums);
        }
    }
    let sums = bilinear::clamped(sums, count);
    Premultiplied16(match count {
        1 => sums.map(bilinear::to_channel),
        _ => sums.map(|sum| bilinear::mean(sum, count)),
    })
}

/// The colour at one sample by the definition, channels in `0.0..=255.0`; `None` where a texture is repeated so often that its
/// coordinates have few digits left.
pub(super) fn exact_point(plan: &Plan<'_>, point: [u32; 2]) -> Option<[f64; 4]> {
    let from_pivot = plan.first + DVec2::new(f64::from(point[0]), f64::from(point[1]));
    let count = plan.line.taps.count;
    let mut sums = [0.0; 4];
    for level in [Some(&plan.finer), plan.coarser.as_ref()].into_iter().flatten() {
        let mass = f64::from(level.mass) / f64::from(fixed_point::MASS) / f64::from(count);
        for tap in 0..count {
            let [x, y] = [&level.x, &level.y].map(|axis| {
                let at = axis.at_pivot + from_pivot.x * axis.right + from_pivot.y * axis.down;
                let offset = axis.tap(&plan.line, tap).clamp(-fixed_point::REACH, fixed_point::REACH);
                match plan.wrap {
                    Wrap::Clamp => {
                        let at = at.clamp(-fixed_point::REACH, axis.last + fixed_point::REACH) + offset;
                        at.clamp(-4.0, axis.last + 4.0)
                    }
                    Wrap::Repeat | Wrap::Mirror => at + offset,
                }
            });
            let far = x.abs() + y.abs();
            if far.is_nan() || far > 1e6 {
                return None;
            }
            for (right, down) in (0..16).map(|i| (f64::from(i % 4 - 1), f64::from(i / 4 - 1))) {
                let (column, row) = (x.floor() + right, y.floor() + down);
                let kernel = |distance: f64| match plan.pixel.cubic() {
                    Some(cubic) => cubic.weight(distance.abs()),
                    None => (1.0 - distance.abs()).max(0.0),
                };
                let weight = kernel(x - column) * kernel(y - row);
                let texel = level.level.wrapped(plan.wrap, [column as i32, row as i32]);
                for (sum, channel) in sums.iter_mut().zip(texel) {
                    *sum += f64::from(channel) * weight * mass;
                }
            }
        }
    }
    let [r, g, b, alpha] = sums;
    let alpha = alpha.clamp(0.0, 255.0);
    Some([r, g, b, 255.0].map(|channel| channel.clamp(0.0, alpha)))
}

/// The sum over the samples of a pixel that `covered` says; what the kernel does for many, by tents instead of tails.
pub(super) fn pixel_sum(plan: &Plan<'_>, side: u32, pixel: [u32; 2], covered: impl Fn(u32) -> bool) -> [u32; 4] {
    let samples: Vec<[u32; 2]> = (0..side * side)
        .filter(|j| covered(*j))
        .map(|j| [j % side, j / side])
        .collect();
    let scale = Scale::new(side);
    let Some(Footings { finer, coarser }) = Footings::of_plan(plan, scale) else {
        let mut sums = [0; 4];
        for sample in samples {
            let color = point(plan, [pixel[0] * side + sample[0], pixel[1] * side + sample[1]]);
            for (sum, channel) in sums.iter_mut().zip(color.0) {
                *sum += u32::from(channel);
            }
        }
        return sums;
    };
    let total = (samples.len() as i32) << scale.sample_bits;
    let part = coarser.as_ref().map_or(0, |coarser| {
        (total * coarser.level.mass + fixed_point::MASS / 2) / fixed_point::MASS
    });
    let middle = f64::from(scale.side - 1) / 2.0;
    let center = pixel.map(|pixel| f64::from(pixel) * f64::from(scale.side) + middle);
    let center = plan.first + DVec2::from_array(center);
    let mut sums = [0; 4];
    for (footing, total) in [(Some(&finer), total - part), (coarser.as_ref(), part)] {
        if let Some(footing) = footing {
            add_block((footing, plan.wrap), total, center, &samples, &mut sums);
        }
    }
    let unit = f64::from(1 << scale.sample_bits);
    sums.map(|sum| (f64::from(sum) * 256.0 / unit + 0.5).floor() as u32)
}

/// Adds the 4 x 4 texels under the pixel around `center`, weighed so that the weights sum to `total`.
fn add_block(
    (footing, wrap): (&Footing<'_>, Wrap),
    total: i32,
    center: DVec2,
    samples: &[[u32; 2]],
    sums: &mut [i32; 4],
) {
    let one = 1 << footing.scale.bits;
    let level = &footing.level;
    let axes = [(&level.x, &footing.x), (&level.y, &footing.y)];
    let placed = axes.map(|(axis, offsets)| {
        let at = (axis.at_pivot + center.x * axis.right) + center.y * axis.down;
        let at = match Endless::new(wrap, axis.last, PixelSampling::Bilinear) {
            None => at.clamp(-2.0, axis.last + 2.0),
            Some(Endless { period, inverse, .. }) => {
                let from_corner = at + 0.5;
                (from_corner - (from_corner * inverse).floor() * period)
                    .max(0.0)
                    .min(period)
                    - 0.5
            }
        };
        let at = (at * f64::from(one)).round_ties_even() as i32;
        let first = (at + offsets.least).div_euclid(one);
        if wrap != Wrap::Clamp {
            return (first, at - first * one, 3 * one);
        }
        let last = axis.last as i32;
        let first = first.clamp(0, last);
        (first, at - first * one, (last - first).min(3) * one)
    });
    let mut products = [[0_i64; 4]; 4];
    for [i, j] in samples {
        let [x, y] = [0, 1].map(|axis| {
            let (offsets, (_, at, last)) = (axes[axis].1, placed[axis]);
            let at = at + i32::from(offsets.columns[*i as usize]) + i32::from(offsets.rows[*j as usize]);
            let at = at.clamp(0, last);
            [0, 1, 2, 3].map(|k| i64::from((one - (at - k * one).abs()).max(0)))
        });
        for (row, y) in products.iter_mut().zip(y) {
            for (product, x) in row.iter_mut().zip(x) {
                *product += x * y;
            }
        }
    }
    let rounded = |sum: i64| (sum as f32 * footing.per_product).round_ties_even() as i32;
    let mut below = total;
    for (r, row) in products.iter().enumerate() {
        let next = rounded(products[r + 1..].iter().flatten().sum()).min(below);
        let mut beyond = below - next;
        for c in 0..4 {
            let left = rounded(row[c + 1..].iter().sum()).min(beyond);
            let texel = level
                .level
                .wrapped(wrap, [placed[0].0 + c as i32, placed[1].0 + r as i32]);
            for (sum, channel) in sums.iter_mut().zip(texel) {
                *sum += i32::from(channel) * (beyond - left);
            }
            beyond = left;
        }
        below = next;
    }
}

/// A texture of few or many texels, smooth or as rough as can be.
pub(super) fn pyramid(u: &mut Unstructured<'_>) -> Result<MipPyramid> {
    let side = |u: &mut Unstructured<'_>| match u.int_in_range(0..=5)? {
        0 => Ok(1),
        1 => u.int_in_range(1..=3),
        2 => Ok(32),
        _ => u.int_in_range(1..=70),
    };
    let (width, height) = (side(u)?, side(u)?);
    let rough = u.arbitrary()?;
    let seed: u32 = u.arbitrary()?;
    let texels = (0..width * height)
        .map(|i: u32| {
            let mut bits = (i ^ seed).wrapping_mul(0x9E37_79B1);
            bits ^= bits >> 15;
            bits = bits.wrapping_mul(0x85EB_CA77);
            bits ^= bits >> 13;
            let [r, g, b, alpha] = if rough {
                bits.to_le_bytes().map(|byte| if byte > 127 { 255 } else { 0 })
            } else {
                bits.to_le_bytes()
            };
            [r.min(alpha), g.min(alpha), b.min(alpha), alpha]
        })
        .collect();
    Ok(MipPyramid::build(MipLevel::new(width, height, texels)))
}

/// A map from pixels to the texture: magnified, minified, turned, mirrored, flat, or absurd.
pub(super) fn map(u: &mut Unstructured<'_>, base: &MipLevel) -> Result<UvMap> {
    let size = DVec2::new(f64::from(base.width()), f64::from(base.height()));
    let number = |u: &mut Unstructured<'_>, range: f64| -> Result<f64> {
        Ok(f64::from(u.int_in_range(-1_000_000..=1_000_000)?) / 1e6 * range)
    };
    let scale = number(u, 6.0)?.exp2();
    let (dx, dy) = match u.int_in_range(0..=6)? {
        0 => (DVec2::new(scale, 0.0), DVec2::new(0.0, scale)),
        1 => (DVec2::new(0.0, scale), DVec2::new(-scale, 0.0)),
        2 => (DVec2::new(scale, 0.0), DVec2::new(0.0, -number(u, 2.0)?)),
        3 => (DVec2::splat(scale), DVec2::splat(scale)),
        4 => {
            let absurd = [0.0, 1e30, -1e30, 1e-30, f64::INFINITY, f64::NAN, 1e300];
            let mut any = || Ok(DVec2::new(*u.choose(&absurd)?, *u.choose(&absurd)?));
            (any()?, any()?)
        }
        _ => {
            let turned = DVec2::from_angle(number(u, 3.2)?);
            (turned * scale, turned.perp() * scale * number(u, 1.5)?)
        }
    };
    let pivot = match u.int_in_range(0..=20)? {
        0 => DVec2::new(f64::NAN, 3.0),
        1 => DVec2::new(-1e300, f64::INFINITY),
        _ => DVec2::new(number(u, 100.0)?, number(u, 100.0)?),
    };
    let uv = match u.int_in_range(0..=20)? {
        0 => DVec2::new(1e30, f64::NAN),
        1 => DVec2::new(-1e30, 1e30),
        _ => DVec2::new(number(u, 1.5)?, number(u, 1.5)?),
    };
    Ok(UvMap {
        pivot: (pivot * 256.0).round() / 256.0,
        uv,
        dx: dx / size,
        dy: dy / size,
    })
}

/// A grid of samples not far from the pivot, so that textures are seen.
pub(super) fn grid(u: &mut Unstructured<'_>, map: &UvMap) -> Result<SampleGrid> {
    let near = |u: &mut Unstructured<'_>, pivot: f64| -> Result<i32> {
        Ok(pivot.clamp(-1e6, 1e6) as i32 + u.int_in_range(-60..=5)?)
    };
    Ok(SampleGrid {
        side: u.int_in_range(1..=16)?,
        origin: [near(u, map.pivot.x)?, near(u, map.pivot.y)?],
    })
}

pub(super) fn filter<'a>(u: &mut Unstructured<'_>, pyramid: &'a MipPyramid, map: &UvMap) -> Result<Filter<'a>> {
    Ok(Filter::new(pyramid, map, &settings(u)?))
}

/// A filter that reads the nearest texel of the first level.
pub(super) fn nearest<'a>(u: &mut Unstructured<'_>, pyramid: &'a MipPyramid, map: &UvMap) -> Result<Filter<'a>> {
    let settings = SamplingSettings {
        pixel: PixelSampling::Nearest,
        level: LevelSampling::Zero,
        ..settings(u)?
    };
    Ok(Filter::new(pyramid, map, &settings))
}

/// What all samples of each pixel count, sample by sample.
pub(super) fn value_sums(plan: &Plan<'_>, side: u32, list: ValueList<'_>) -> Vec<[u64; 3]> {
    let of_pixel = |(i, pixel): (usize, &[u16; 2])| {
        let mut sum = [0; 3];
        let first = if list.inside.len() == list.count {
            0
        } else {
            i * list.count
        };
        for (j, inside) in list.inside[first..first + list.count].iter().enumerate() {
            if list.masks.is_some_and(|masks| masks[i] >> j & 1 == 0) {
                continue;
            }
            let at = |axis: usize| u32::from(pixel[axis]) * side + u32::from(inside[axis]);
            let color = point(plan, [at(0), at(1)]);
            for (sum, channel) in sum.iter_mut().zip(color.0) {
                *sum += u64::from(match list.values {
                    ByteValues::Stored => u32::from(channel),
                    ByteValues::Table(values) => values[usize::from(channel >> 8)],
                });
            }
        }
        sum
    };
    list.pixels.iter().enumerate().map(of_pixel).collect()
}

/// Any way to read a texture under the standard rules; half of them with one tap and no more than the footprint says.
pub(super) fn settings(u: &mut Unstructured<'_>) -> Result<SamplingSettings> {
    // As often those that have kernels of their own as any.
    let is_simple: bool = u.arbitrary()?;
    let plain = SamplingSettings {
        pixel: *u.choose(if is_simple {
            &PixelSampling::ALL[..2]
        } else {
            &PixelSampling::ALL
        })?,
        wrap: if is_simple { Wrap::Clamp } else { *u.choose(&Wrap::ALL)? },
        level: *u.choose(&LevelSampling::ALL)?,
        ..SamplingSettings::default()
    };
    if u.arbitrary()? {
        return Ok(plain);
    }
    let quarters = |u: &mut Unstructured<'_>, least: i32| Ok(f64::from(u.int_in_range(least..=64)?) / 4.0);
    let detail = LevelOfDetail {
        bias: if u.arbitrary()? {
            LodBias::new(quarters(u, -64)?).unwrap_or_default()
        } else {
            LodBias::default()
        },
        fixed: if u.int_in_range(0..=3)? == 0 {
            FixedLevel::new(quarters(u, 0)?)
        } else {
            None
        },
        derivatives: *u.choose(&Derivatives::ALL)?,
        extent: *u.choose(&FootprintExtent::ALL)?,
    };
    Ok(SamplingSettings {
        anisotropy: Anisotropy::new(u.int_in_range(1..=Anisotropy::MAX)?).unwrap_or_default(),
        detail,
        sample_step: 1.0 / f64::from(u.int_in_range(1..=16)?),
        ..plain
    })
}
