//! Which area of a texture a sample weighs, by the samplings that weigh one: an ellipse, a box, or the levels of a ripmap.
//!
//! A bias makes the footprint larger or smaller; a fixed level stands for a footprint of as many texels as one of its texels has.
//! Nothing else is asked of the settings: these filters find a footprint's shape themselves.

use glam::DVec2;

use super::detail_settings::FixedLevel;
use super::{Ellipse, Footprint, LevelChoice, LevelSampling, MipPyramid, SamplingSettings};

/// The most texels of which sums and ripmaps are made. Of a larger texture they are made of its first level that is small
/// enough: 64 megabytes for sums of bytes, 128 for those of light, 64 for a ripmap.
const MOST_TEXELS: u64 = 1 << 22;

/// What of a texture a sample weighs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Area {
    /// By the elliptical weighted average.
    Ellipse(Ellipse),
    /// By sums.
    Box(TexelBox),
    /// By the levels of a ripmap, along `u` and along `v`; numbers count from the level that it is made of.
    Ripmap([LevelChoice; 2]),
}

/// A box of texels, about the point that is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexelBox {
    /// Number of the level whose texels are summed; 0 unless the texture is very large.
    pub level: usize,
    /// Width and height in the level's texels: those of the footprint's box, at least one texel.
    pub sides: DVec2,
}

impl Area {
    /// What a footprint weighs, and its level of detail: of the ellipse's minor axis, or of the box's longer side.
    pub(super) fn new(footprint: &Footprint, pyramid: &MipPyramid, settings: &SamplingSettings) -> (Self, f64) {
        let size = size(pyramid, 0);
        let detail = &settings.detail;
        let steps = detail.fixed.map(FixedLevel::level).map(|level| Footprint {
            dx: DVec2::new(level.exp2() / size.x, 0.0),
            dy: DVec2::new(0.0, level.exp2() / size.y),
        });
        let footprint = steps.unwrap_or(*footprint).scaled(detail.bias.levels().exp2());
        if settings.level == LevelSampling::Ewa {
            let (ellipse, lod) = Ellipse::new(&footprint, pyramid);
            return (Self::Ellipse(ellipse), lod);
        }
        let lod = sides(&footprint, size).max_element().log2();
        let level = tabled_level(pyramid);
        let base = self::size(pyramid, level);
        let sides = sides(&footprint, base).max(DVec2::ONE);
        let area = if settings.level == LevelSampling::SummedArea {
            Self::Box(TexelBox { level, sides })
        } else {
            let choice = |side: f64, texels: f64| {
                let last = whole(texels.log2());
                LevelChoice::new(side.log2(), last, LevelSampling::Linear)
            };
            Self::Ripmap([choice(sides.x, base.x), choice(sides.y, base.y)])
        };
        (area, lod)
    }
}

/// The level of a pyramid that sums and ripmaps are made of.
pub(super) fn tabled_level(pyramid: &MipPyramid) -> usize {
    let texels = |level: &super::MipLevel| u64::from(level.width()) * u64::from(level.height());
    let small = pyramid.levels().iter().position(|level| texels(level) <= MOST_TEXELS);
    small.unwrap_or(0)
}

/// Width and height of a level in texels.
fn size(pyramid: &MipPyramid, level: usize) -> DVec2 {
    let level = &pyramid.levels()[level];
    DVec2::new(f64::from(level.width()), f64::from(level.height()))
}

/// Width and height in texels of the box around the parallelogram of both steps. A footprint that is not finite is far larger
/// than any texture.
fn sides(footprint: &Footprint, size: DVec2) -> DVec2 {
    /// Larger than the largest level by far.
    const HUGE: f64 = 1e9;
    let sides = (footprint.dx.abs() + footprint.dy.abs()) * size;
    let side = |side: f64| if side.is_nan() { HUGE } else { side.min(HUGE) };
    DVec2::new(side(sides.x), side(sides.y))
}

/// Of the logarithm of a number of texels the whole part: how often it can be halved.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a level has 1 to 16 384 texels a side"
)]
fn whole(halvings: f64) -> usize {
    halvings as usize
}
