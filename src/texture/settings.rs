//! How textures are sampled.

use super::{Anisotropy, LevelOfDetail, LevelSampling, PixelSampling, PyramidFilter, Wrap};
use crate::color::ResolveSpace;
use crate::rules::Rules;

/// How textures are read: what a user chooses, and how close samples are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SamplingSettings {
    /// Inside a level.
    pub pixel: PixelSampling,
    /// Beyond the border.
    pub wrap: Wrap,
    /// Between levels.
    pub level: LevelSampling,
    /// In which values levels were averaged.
    pub pyramid: ResolveSpace,
    /// By which filter.
    pub pyramid_filter: PyramidFilter,
    /// Along a footprint.
    pub anisotropy: Anisotropy,
    /// How large a footprint counts.
    pub detail: LevelOfDetail,
    /// Distance between samples in pixels, for [`super::Derivatives::Sample`].
    pub sample_step: f64,
    /// How texels are addressed.
    pub rules: Rules,
}

impl Default for SamplingSettings {
    fn default() -> Self {
        Self {
            pixel: PixelSampling::default(),
            wrap: Wrap::default(),
            level: LevelSampling::default(),
            pyramid: ResolveSpace::default(),
            pyramid_filter: PyramidFilter::default(),
            anisotropy: Anisotropy::OFF,
            detail: LevelOfDetail::default(),
            sample_step: 1.0,
            rules: Rules::default(),
        }
    }
}
