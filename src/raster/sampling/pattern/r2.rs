//! The additive recurrence with the plastic number (Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).

use std::sync::Arc;

use super::arrange::{Arrange, Fixed, Place};
use crate::raster::sampling::rate::SampleRate;

/// The inverse of the plastic number and of its square, as parts of `2^64`.
const STEPS: [u64; 2] = [0xC13F_A9A9_02A6_328F, 0x91E1_0DA5_C79E_7B1D];

/// Its first points, beginning in the pixel's centre.
pub(super) struct R2;

impl Arrange for R2 {
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place> {
        Fixed::by(rate, |i| {
            STEPS.map(|step| {
                let [top, ..] = step.wrapping_mul(i.into()).wrapping_add(1 << 63).to_be_bytes();
                u32::from(top)
            })
        })
    }
}
