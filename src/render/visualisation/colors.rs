//! Numbers and things to colours, and scales of them for legends.

use crate::color::{Rgba, unit_to_byte};
use crate::render::LegendKey;
use crate::rules::Rules;

/// Where a primitive has no number to show.
pub(super) const NONE: u32 = 0xFF9A_9A9A;

/// What [`NONE`] stands for where textures are shown.
pub(super) const NO_TEXTURE: (u32, &str) = (NONE, "no texture");

/// Steps of a scale.
const STEPS: u16 = 256;

/// The part that `value` is of `most` on a logarithmic scale that begins with 1.
pub(super) fn logarithmic(value: f32, most: f32) -> f32 {
    value.max(1.0).log2() / most.log2()
}

/// A pixel's colour.
pub(super) fn rgba(pixel: u32) -> Rgba {
    let [a, r, g, b] = pixel.to_be_bytes().map(|byte| f32::from(byte) / 255.0);
    Rgba { r, g, b, a }
}

/// A colour's pixel, opaque.
pub(super) fn pixel(color: Rgba) -> u32 {
    let [r, g, b] = [color.r, color.g, color.b].map(|channel| unit_to_byte(channel, Rules::Standard));
    u32::from_be_bytes([0xFF, r, g, b])
}

/// One of some colours; beyond the last they repeat, half-way to white.
pub(super) fn shade_of(colors: &[u32], index: usize) -> Rgba {
    let color = rgba(colors[index % colors.len()]);
    if (index / colors.len()).is_multiple_of(2) {
        color
    } else {
        mix(color, Rgba::WHITE, 0.5)
    }
}

/// From `first` to `second`, in stored values.
pub(super) fn mix(first: Rgba, second: Rgba, part: f32) -> Rgba {
    let channel = |a: f32, b: f32| a + (b - a) * part;
    Rgba {
        r: channel(first.r, second.r),
        g: channel(first.g, second.g),
        b: channel(first.b, second.b),
        a: channel(first.a, second.a),
    }
}

/// A scale whose colour at a part `0.0..=1.0` of its length is `color`.
pub(super) fn scale(color: impl Fn(f32) -> u32, ticks: impl IntoIterator<Item = (f32, String)>) -> LegendKey {
    let colors = (0..STEPS).map(|step| color(f32::from(step) / f32::from(STEPS - 1)));
    LegendKey::Scale(colors.collect(), ticks.into_iter().collect())
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "what becomes a colour needs no more digits"
)]
pub(super) fn single(value: f64) -> f32 {
    value as f32
}
