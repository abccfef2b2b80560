//! The oracle of filters that weigh an area: each texel asked by itself how much of it counts, in 64-bit floats.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the oracle states the rules in plain arithmetic on small numbers"
)]

use glam::{DMat2, DVec2};
use rasterscope::render::RenderSettings;
use rasterscope::texture::{Derivatives, FixedLevel, LevelSampling, MipLevel, Texture, Wrap};

use super::brute_force::{Color, read_level};

/// The mean of an area, premultiplied.
pub(super) fn filtered(texture: &Texture, uv: DVec2, per_pixel: [DVec2; 2], settings: &RenderSettings) -> Color {
    let base = size(&texture.pyramid.levels()[0]);
    let step = match settings.detail.derivatives {
        Derivatives::Pixel => 1.0,
        Derivatives::Sample => 1.0 / f64::from(settings.sample_rate.samples()).sqrt(),
    };
    let bias = settings.detail.bias.levels().exp2();
    let steps = match settings.detail.fixed.map(FixedLevel::level) {
        Some(level) => [DVec2::X, DVec2::Y].map(|axis| axis * level.exp2() * bias / base),
        None => per_pixel.map(|side| side * step * bias),
    };
    let sides = (steps[0].abs() + steps[1].abs()) * base;
    match settings.level_sampling {
        LevelSampling::Ewa => {
            let levels = texture.pyramid_in(settings.pyramid, settings.pyramid_filter).levels();
            let [_, short] = axes(steps.map(|side| side * base));
            let lod = short.log2().clamp(0.0, (levels.len() - 1) as f64);
            let level = &levels[lod.floor() as usize];
            ellipse(level, uv, steps.map(|side| side * size(level)), settings.texture_wrap)
        }
        LevelSampling::SummedArea => {
            let level = &texture.pyramid.levels()[0];
            boxed(level, uv * base, sides.max(DVec2::ONE), settings.texture_wrap)
        }
        _ => ripmap(texture, uv, sides.max(DVec2::ONE), settings),
    }
}

fn size(level: &MipLevel) -> DVec2 {
    DVec2::new(f64::from(level.width()), f64::from(level.height()))
}

/// How long and wide the ellipse of two steps is, of which the shorter is at least an eighth.
fn axes([right, down]: [DVec2; 2]) -> [f64; 2] {
    let area = right.perp_dot(down).abs();
    let (sum, difference) = (
        (right.length_squared() + down.length_squared() + 2.0 * area).sqrt(),
        (right.length_squared() + down.length_squared() - 2.0 * area)
            .max(0.0)
            .sqrt(),
    );
    let long = f64::midpoint(sum, difference);
    [long, (area / long).max(long / 8.0)]
}

fn texel(level: &MipLevel, [x, y]: [i64; 2], wrap: Wrap) -> Color {
    let inside = |at: i64, side: u32| {
        let side = i64::from(side);
        let (copy, within) = (at.div_euclid(side), at.rem_euclid(side));
        let at = match wrap {
            Wrap::Clamp => at.clamp(0, side - 1),
            Wrap::Mirror if copy.rem_euclid(2) == 1 => side - 1 - within,
            Wrap::Repeat | Wrap::Mirror => within,
        };
        at as i32
    };
    let texel = level.texel(inside(x, level.width()), inside(y, level.height()));
    texel.map(|byte| f64::from(byte) / 255.0)
}

/// Every texel under the ellipse by the Gaussian: the pixel's circle, and a circle of one texel.
fn ellipse(level: &MipLevel, uv: DVec2, steps: [DVec2; 2], wrap: Wrap) -> Color {
    let [long, short] = axes(steps).map(|axis| axis.min(16.0));
    // The direction in which a turning step is longest.
    let [right, down] = steps;
    let doubled = (2.0 * right.dot(down)).atan2(right.length_squared() - down.length_squared());
    let (sin, cos) = (doubled / 2.0).sin_cos();
    let along = (right * cos + down * sin).try_normalize().unwrap_or(DVec2::X);
    let to_circle = DMat2::from_cols(
        along * (long * long + 1.0).sqrt(),
        along.perp() * (short * short + 1.0).sqrt(),
    )
    .inverse();
    let at = uv * size(level);
    let reach = (long * long + 1.0).sqrt().ceil() + 1.0;
    let (mut sum, mut total) = ([0.0; 4], 0.0);
    let range = |at: f64| (at - reach).floor() as i64..=(at + reach).ceil() as i64;
    for y in range(at.y) {
        for x in range(at.x) {
            let from_middle = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) - at;
            let q = (to_circle * from_middle).length_squared();
            let weight = ((-2.0 * q).exp() - (-2.0_f64).exp()).max(0.0);
            if weight > 0.0 {
                total += weight;
                let texel = texel(level, [x, y], wrap);
                sum = std::array::from_fn(|i| sum[i] + texel[i] * weight);
            }
        }
    }
    sum.map(|channel| channel / total)
}

/// The part of each column and row that a box holds, then every texel.
fn boxed(level: &MipLevel, at: DVec2, sides: DVec2, wrap: Wrap) -> Color {
    let axis = |at: f64, side: f64| {
        let half = side.min(32_768.0) / 2.0;
        let (from, to) = (at - half, at + half);
        (from.floor() as i64..to.ceil() as i64)
            .map(|k| (k, (to.min((k + 1) as f64) - from.max(k as f64)) / (to - from)))
            .collect::<Vec<_>>()
    };
    let mut sum = [0.0; 4];
    for (y, down) in axis(at.y, sides.y) {
        for (x, across) in axis(at.x, sides.x) {
            let texel = texel(level, [x, y], wrap);
            sum = std::array::from_fn(|i| sum[i] + texel[i] * across * down);
        }
    }
    sum
}

/// Four levels, of which those of one height are mixed first.
fn ripmap(texture: &Texture, uv: DVec2, sides: DVec2, settings: &RenderSettings) -> Color {
    let ripmap = texture.ripmap(settings.pyramid, settings.pyramid_filter);
    let widths = texture.ripmap_widths();
    let heights = ripmap.levels().len() / widths;
    let lod = |side: f64, count: usize| side.log2().clamp(0.0, (count - 1) as f64);
    let (u, v) = (lod(sides.x, widths), lod(sides.y, heights));
    let read = |i: usize, j: usize| {
        let level = &ripmap.levels()[j.min(heights - 1) * widths + i.min(widths - 1)];
        let sampling = texture.asks.unwrap_or(settings.pixel_sampling);
        read_level(level, uv, sampling, settings.texture_wrap)
    };
    let mix = |a: Color, b: Color, part: f64| std::array::from_fn(|k| a[k] * (1.0 - part) + b[k] * part);
    let (i, j) = (u.floor() as usize, v.floor() as usize);
    let row = |j: usize| {
        let [r, g, b, alpha]: Color = mix(read(i, j), read(i + 1, j), u.fract());
        let alpha = alpha.clamp(0.0, 1.0);
        [r.clamp(0.0, alpha), g.clamp(0.0, alpha), b.clamp(0.0, alpha), alpha]
    };
    mix(row(j), row(j + 1), v.fract())
}
