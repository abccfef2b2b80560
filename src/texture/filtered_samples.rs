//! Samples of one triangle that are filtered each by itself, in the one way that their plan asks for.
//!
//! Whoever needs such samples calls this, and nobody inlines it: there are four kernels for each kind of vectors, and copies of them
//! took a fifth of the time that compiling the library takes.

use fearless_simd::dispatch;

use super::cubic::TexelWeights;
use super::filter_plan::Plan;
use super::simd_channels::FromColors;
use super::{anisotropic_filter, block_filter, sample_filter};
use crate::simd::Level;

/// How samples are filtered one by one.
pub(super) enum SampleKernel<'p> {
    /// From blocks of texels, with any number of taps.
    Blocks(&'p Plan<'p>, TexelWeights),
    /// From the nearest texel, or the four around each.
    OneTap(&'p Plan<'p>),
    /// The same with several taps each.
    SeveralTaps(&'p Plan<'p>),
}

impl<'p> SampleKernel<'p> {
    /// What this plan asks for.
    pub(super) fn new(plan: &'p Plan<'p>) -> Self {
        match plan.block() {
            Some(weights) => Self::Blocks(plan, weights),
            None if plan.line.taps.count == 1 => Self::OneTap(plan),
            None => Self::SeveralTaps(plan),
        }
    }

    /// The colours at samples, as many as there is room for; see [`super::Filter::points`] and [`super::Filter::pixels`].
    #[inline(never)]
    pub(super) fn filter<C: FromColors>(&self, level: Level, points: &[[u16; 2]], out: &mut [C]) {
        match self {
            Self::Blocks(plan, weights) => {
                dispatch!(level, simd => block_filter::filter_with(simd, plan, weights, points, out));
            }
            Self::OneTap(plan) => dispatch!(level, simd => sample_filter::filter_with(simd, plan, points, out)),
            Self::SeveralTaps(plan) => {
                dispatch!(level, simd => anisotropic_filter::filter_with(simd, plan, points, out));
            }
        }
    }
}
