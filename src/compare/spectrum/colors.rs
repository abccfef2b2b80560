//! Spectra in colours: lighter is stronger, and a hue tells which band a wave comes from.

use std::ops::Range;

use rayon::prelude::*;

use super::waves::decibels;
use super::{Band, SpectrumAnalysis};
use crate::raster::Framebuffer;

/// What is dark and what is white, in dB, where a wave from black to white has 0: pictures have few waves that are stronger, or none.
pub const DECIBELS: [f64; 2] = [-80.0, -20.0];
/// What has no wave, and what has the strongest: opaque `0xAARRGGBB`.
const ENDS: [u32; 2] = [0xff0a_0c10, 0xffff_ffff];

impl SpectrumAnalysis {
    /// The spectrum as a square of `side` pixels from the lowest frequency to the highest, frequency zero in the middle. A pixel
    /// shows the strongest wave of those that it covers.
    pub fn picture(&self, side: u32) -> Framebuffer {
        let mut picture = Framebuffer::new(side, side);
        let [columns, rows] = [0, 1].map(|axis| self.covered(axis, side));
        let lines = picture.pixels_mut().par_chunks_mut(side.max(1) as usize).zip(&rows);
        lines.for_each(|(line, rows)| {
            for (columns, pixel) in columns.iter().zip(line) {
                let orders = rows.clone().flat_map(|y| columns.clone().map(move |x| [x, y]));
                let powers = orders.map(|order| (self.power(order), order));
                let strongest = powers.max_by(|a, b| a.0.total_cmp(&b.0));
                *pixel = strongest.map_or(ENDS[0], |(power, order)| {
                    mixed(part(decibels(power.sqrt())), self.shares(order))
                });
            }
        });
        picture
    }

    /// For each of `side` pixels along an axis which numbers of periods it covers: one at least.
    fn covered(&self, axis: usize, side: u32) -> Vec<Range<i64>> {
        let all = self.own.orders(axis);
        let count = all.end - all.start;
        let side = i64::from(side);
        // Half a step early: a pixel's middle is what it shows.
        let edge = |pixel: i64| all.start + (pixel * count + side / 2) / side;
        let pixels = 0..side;
        pixels
            .map(|pixel| {
                let start = edge(pixel).min(all.end - 1);
                start..edge(pixel + 1).clamp(start + 1, all.end.max(start + 1))
            })
            .collect()
    }
}

/// The colour of so many dB, of what is not finer than the pixels, or of a band: opaque `0xAARRGGBB`.
pub fn scale_color(decibels: f64, band: Option<Band>) -> u32 {
    let shares = Band::ALL.map(|other| if band == Some(other) { 1.0 } else { 0.0 });
    mixed(part(decibels), shares)
}

/// How light so many dB are, from 0 to 1.
fn part(decibels: f64) -> f64 {
    let [low, high] = DECIBELS;
    ((decibels - low) / (high - low)).clamp(0.0, 1.0)
}

/// The colour of so light a wave, of which so much is of each band.
fn mixed(part: f64, shares: [f64; 3]) -> u32 {
    let [_, dark @ ..] = ENDS[0].to_be_bytes().map(f64::from);
    let [_, white @ ..] = ENDS[1].to_be_bytes().map(f64::from);
    let rest = (1.0 - shares.iter().sum::<f64>()).max(0.0);
    let channel = |i: usize| {
        let bands = Band::ALL.iter().zip(shares).map(|(band, share)| {
            let [_, hue @ ..] = band.color().to_be_bytes();
            f64::from(hue[i]) * share
        });
        let light = white[i] * rest + bands.sum::<f64>();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
        let byte = (dark[i] + (light - dark[i]) * part).round().clamp(0.0, 255.0) as u8;
        byte
    };
    u32::from_be_bytes([0xff, channel(0), channel(1), channel(2)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_are_lighter_where_stronger_and_of_their_band() {
        let [low, high] = DECIBELS;
        assert_eq!(scale_color(low, None), ENDS[0], "nothing");
        assert_eq!(scale_color(high, None), ENDS[1], "all");
        assert_eq!(scale_color(high, Some(Band::Down)), Band::Down.color(), "a band's own");
        assert_eq!(scale_color(low - 50.0, Some(Band::Down)), ENDS[0], "nothing of it");
        let light = |color: u32| {
            color.to_be_bytes()[1..]
                .iter()
                .map(|byte| u32::from(*byte))
                .sum::<u32>()
        };
        let steps = [-80.0, -65.0, -50.0, -35.0, -20.0].map(|decibels| light(scale_color(decibels, None)));
        assert!(steps.is_sorted_by(|a, b| a < b), "{steps:?}");
        let both = mixed(1.0, [0.5, 0.0, 0.0]).to_be_bytes();
        assert_eq!(both, [255, 243, 207, 128], "half white, half orange");
    }
}
