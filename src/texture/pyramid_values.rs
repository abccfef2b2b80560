//! From texels to the values whose means make coarser ones, and back.

use super::PyramidFilter;
use crate::color::{Light, LightResolver, Premultiplied16, ResolveSpace};
use crate::rules::Rules;

/// In which values texels are averaged, and by which filter.
pub(super) struct PyramidValues {
    filter: PyramidFilter,
    /// What makes bytes of light, where light is averaged.
    light: Option<LightResolver>,
}

impl PyramidValues {
    pub(super) fn new(space: ResolveSpace, filter: PyramidFilter) -> Self {
        let is_light = space == ResolveSpace::Linear;
        Self {
            filter,
            light: is_light.then(|| LightResolver::new(1, Rules::Standard)),
        }
    }

    /// The value of a texel: of bytes 0 to 255, of light 0 to 1.
    #[inline]
    pub(super) fn value(&self, texel: [u8; 4]) -> [f32; 4] {
        match self.light {
            None => texel.map(f32::from),
            Some(_) => light(texel),
        }
    }

    /// The texel of a mean of values.
    pub(super) fn texel(&self, mean: [f32; 4]) -> [u8; 4] {
        let Some(resolver) = &self.light else {
            return kept(self.filter, mean, 255.0).map(to_byte);
        };
        let light = Light::of_weighted(kept(self.filter, mean, 1.0));
        let [b, g, r, alpha] = resolver.pixel(light).to_le_bytes();
        let weighted = |channel: u8| to_byte(f32::from(channel) * f32::from(alpha) / 255.0);
        [weighted(r), weighted(g), weighted(b), alpha]
    }
}

/// Light of a texel, weighted by its alpha.
pub(super) fn light(texel: [u8; 4]) -> [f32; 4] {
    Light::new(Premultiplied16::from_bytes(texel)).weighted()
}

/// A premultiplied colour that is one: alpha from nothing to `most`, and no channel above it. Means of colours are always that.
fn kept(filter: PyramidFilter, mean: [f32; 4], most: f32) -> [f32; 4] {
    if filter == PyramidFilter::Box {
        return mean;
    }
    let [r, g, b, alpha] = mean;
    let alpha = alpha.clamp(0.0, most);
    let [r, g, b] = [r, g, b].map(|channel| channel.clamp(0.0, alpha));
    [r, g, b, alpha]
}

/// Rounded to nearest.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "means of bytes stay bytes; `as` saturates"
)]
fn to_byte(channel: f32) -> u8 {
    (channel + 0.5) as u8
}
