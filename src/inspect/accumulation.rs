//! A pixel sample by sample: its mean so far, and how coverage comes closer to the true area.

use super::model::{Explanation, Rounding};
use crate::color::Premultiplied16;
use crate::rules::Rules;

/// How the part of the samples that a primitive covers comes closer to the part of the pixel that it covers.
#[derive(Clone, Debug, PartialEq)]
pub struct Convergence {
    /// The primitive in words.
    pub name: String,
    /// The covered part of the first sample, of the first two and so on, `0.0..=1.0`.
    pub parts: Vec<f64>,
    /// What they come closer to: the part of the pixel's area.
    pub area: f64,
}

impl Explanation {
    /// The pixel, straight red, green, blue, alpha, that the first `count` samples make; `count` is at least 1.
    pub fn mean_of_first(&self, count: usize) -> [u8; 4] {
        let samples = self.samples.iter().take(count.max(1));
        let samples: Vec<_> = samples
            .map(|sample| Premultiplied16(sample.color.map(stored)))
            .collect();
        if samples.is_empty() {
            return [0; 4];
        }
        let rules = match self.resolve.rounding {
            Rounding::Nearest => Rules::Standard,
            Rounding::Truncated => Rules::Course,
        };
        let [a, r, g, b] = self.resolve.space().resolve(&samples, rules).to_be_bytes();
        [r, g, b, a]
    }

    /// Of the topmost primitive that is seen and whose area is known.
    pub fn convergence(&self) -> Option<Convergence> {
        let seen = |paint: &&super::Paint| paint.fragments.iter().any(|fragment| fragment.seen);
        let mut known = self
            .paints
            .iter()
            .rev()
            .filter(seen)
            .filter_map(|paint| Some((paint, paint.area?)));
        let (paint, area) = known.next()?;
        let covered = paint.samples();
        let mut found = 0;
        let parts = (0..self.samples.len()).map(|sample| {
            found += usize::from(covered.contains(&sample));
            found as f64 / (sample + 1) as f64
        });
        Some(Convergence {
            name: paint.name(),
            parts: parts.collect(),
            area,
        })
    }
}

/// A channel in levels as samples store it: exact, because levels are multiples of 1/256.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a channel is 0 to 255 levels"
)]
fn stored(levels: f64) -> u16 {
    (levels * f64::from(Premultiplied16::PER_BYTE)) as u16
}
