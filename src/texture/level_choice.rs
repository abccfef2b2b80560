//! From a level of detail to the levels that are read.

use super::LevelSampling;

/// Which levels a footprint reads: the finer one, and where two are mixed the next coarser and its weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelChoice {
    /// Number of the (finer) level.
    pub level: usize,
    /// Weight of level `level + 1`; zero when only one level is read.
    pub next_weight: f32,
}

impl LevelChoice {
    /// One level.
    pub(super) fn alone(level: usize) -> Self {
        Self {
            level,
            next_weight: 0.0,
        }
    }

    /// The levels that are read at a level of detail, of levels `0..=last`.
    pub fn new(lod: f64, last: usize, sampling: LevelSampling) -> Self {
        let lod = lod.clamp(0.0, last as f64);
        match sampling {
            LevelSampling::Zero => Self::alone(0),
            LevelSampling::Nearest => Self::alone(whole(lod + 0.5).min(last)),
            LevelSampling::Ewa | LevelSampling::SummedArea => Self::alone(whole(lod).min(last)),
            LevelSampling::Linear | LevelSampling::Ripmap => {
                let level = whole(lod).min(last);
                Self {
                    level,
                    next_weight: fraction(lod - level as f64),
                }
            }
        }
    }
}

/// The whole part of a clamped level of detail.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a level of detail is clamped to 0..=30"
)]
fn whole(lod: f64) -> usize {
    lod as usize
}

/// The fractional part of a level of detail as a weight.
#[expect(clippy::cast_possible_truncation, reason = "a weight in 0..1 loses only digits")]
fn fraction(weight: f64) -> f32 {
    weight as f32
}
