//! Sampling eight points at once: the same arithmetic as one by one, in loops that compilers turn into vector code.
//!
//! What depends on a branch or on a saturating conversion is written without either. Each lane gives the very number
//! that [`Sampler::sample`] gives for its point; a test holds them together.

use super::sampler::lerp;
use super::{MipLevel, PixelSampling, Sampler};
use crate::rules::Rules;

/// How many points are sampled at once.
pub const LANES: usize = 8;

/// `2^23`: a 32-bit float of this size has no bits for fractions, so adding it rounds to a whole number, which then
/// stands in the lower bits.
const WHOLE: f32 = 8_388_608.0;

/// Where a coordinate lies between two neighbouring texels, for each lane.
struct Between {
    /// The texel at or before the point, and the next one; both clamped to the level.
    first: [u32; LANES],
    second: [u32; LANES],
    /// Weight of the second.
    weight: [f32; LANES],
}

impl Sampler<'_> {
    /// The premultiplied colours at eight points `(u, v)`, channels in `0.0..=255.0`; as [`Sampler::sample`] for each.
    #[inline]
    pub fn sample_lanes(&self, u: &[f32; LANES], v: &[f32; LANES]) -> [[f32; 4]; LANES] {
        let mut colors = self.lanes_of_level(self.finer, u, v);
        if let Some((level, weight)) = self.coarser {
            let coarse = self.lanes_of_level(level, u, v);
            for (color, coarse) in colors.iter_mut().zip(coarse) {
                *color = lerp(*color, coarse, weight);
            }
        }
        colors
    }

    #[inline]
    fn lanes_of_level(&self, level: &MipLevel, u: &[f32; LANES], v: &[f32; LANES]) -> [[f32; 4]; LANES] {
        let texels = level.texels();
        let (width, stride) = (level.width(), level.stride());
        match self.pixel {
            PixelSampling::Nearest => {
                let (scale, shift) = match self.rules {
                    Rules::Standard => (0.0, 0.0),
                    Rules::Course => (1.0, 0.5),
                };
                let x = between(u, width, scale, shift).first;
                let y = between(v, level.height(), scale, shift).first;
                std::array::from_fn(|i| texels[(y[i] * stride + x[i]) as usize].map(f32::from))
            }
            PixelSampling::Bilinear => {
                let (scale, shift) = match self.rules {
                    Rules::Standard => (0.0, -0.5),
                    Rules::Course => (1.0, 0.0),
                };
                let x = between(u, width, scale, shift);
                let y = between(v, level.height(), scale, shift);
                std::array::from_fn(|i| {
                    let texel = |x: u32, y: u32| texels[(y * stride + x) as usize].map(f32::from);
                    let upper = lerp(
                        texel(x.first[i], y.first[i]),
                        texel(x.second[i], y.first[i]),
                        x.weight[i],
                    );
                    let lower = lerp(
                        texel(x.first[i], y.second[i]),
                        texel(x.second[i], y.second[i]),
                        x.weight[i],
                    );
                    lerp(upper, lower, y.weight[i])
                })
            }
        }
    }
}

/// Places `at (size - scale) + shift` between the texels `0..size`.
#[inline]
fn between(at: &[f32; LANES], size: u32, scale: f32, shift: f32) -> Between {
    let (factor, last) = (size as f32 - scale, size as f32 - 1.0);
    let mut between = Between {
        first: [0; LANES],
        second: [0; LANES],
        weight: [0.0; LANES],
    };
    for (i, at) in at.iter().enumerate() {
        // In this order a point that is no number reads texel 0.
        let x = (at * factor + shift).max(0.0).min(last);
        let nearest = x + WHOLE;
        let rounded = nearest - WHOLE;
        let too_far = u32::from(rounded > x);
        let first = (nearest.to_bits() & 0x007F_FFFF) - too_far;
        between.first[i] = first;
        between.second[i] = (first + 1).min(size - 1);
        between.weight[i] = x - (rounded - too_far as f32);
    }
    between
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::super::{Footprint, LevelSampling, MipPyramid, SamplingSettings};
    use super::*;

    #[test]
    fn lanes_give_the_very_numbers_of_single_points() {
        let texels = (0..23 * 14_u32)
            .map(|i| [(i * 7).to_le_bytes()[0], (i * 31).to_le_bytes()[0], 9, 200])
            .collect();
        let pyramid = MipPyramid::build(MipLevel::new(23, 14, texels));
        arbtest::arbtest(|u| {
            let settings = SamplingSettings {
                pixel: *u.choose(&PixelSampling::ALL)?,
                level: *u.choose(&LevelSampling::ALL)?,
                rules: *u.choose(&Rules::ALL)?,
            };
            let step = f64::from(u.int_in_range(1..=4000)?) / 1000.0;
            let footprint = Footprint {
                dx: DVec2::new(step / 23.0, 0.0),
                dy: DVec2::ZERO,
            };
            let sampler = Sampler::new(&pyramid, &footprint, settings);
            let mut lane = || -> arbtest::arbitrary::Result<f32> {
                Ok(match u.int_in_range(0..=9)? {
                    0 => *u.choose(&[0.0, 1.0, -1e30, 1e30, f32::INFINITY, f32::NAN, 0.5])?,
                    1 => u.int_in_range(-3..=26)? as f32 / 23.0,
                    _ => u.int_in_range(-100_000..=1_100_000)? as f32 / 1e6,
                })
            };
            let (mut us, mut vs) = ([0.0; LANES], [0.0; LANES]);
            for i in 0..LANES {
                (us[i], vs[i]) = (lane()?, lane()?);
            }
            let together = sampler.sample_lanes(&us, &vs);
            for i in 0..LANES {
                let alone = sampler.sample_floats(us[i], vs[i]).map(f32::to_bits);
                assert_eq!(
                    together[i].map(f32::to_bits),
                    alone,
                    "{settings:?} at {}, {}",
                    us[i],
                    vs[i]
                );
            }
            Ok(())
        })
        .budget_ms(400);
    }
}
