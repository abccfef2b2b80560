//! In words, how a pixel's own samples became its colour.

use std::fmt::Write as _;

use super::model::{Explanation, Resolve, Rounding};
use super::numbers::{number, runs};
use super::smoothing::Smoothing;
use crate::color::{ResolveSpace, encoded};

/// Different colours that a sum is written out for at most.
const MOST_TERMS: usize = 4;
/// Places that several samples share of which each is told at most.
const MOST_PLACES: usize = 8;

impl Explanation {
    /// How the samples became the colour.
    pub fn resolve_lines(&self) -> Vec<String> {
        let mut lines = match &self.resolve.around {
            Some(around) => self.around_lines(around),
            None => self.mean_lines(),
        };
        lines.extend(self.smoothing.iter().flat_map(Smoothing::lines));
        lines
    }

    /// How its own samples became their mean.
    fn mean_lines(&self) -> Vec<String> {
        let resolve = &self.resolve;
        let mut lines = Vec::new();
        if self.exact {
            lines.push(
                "The pixel holds one colour, to which each primitive added its own by its alpha times the area that it covers.".to_owned(),
            );
        } else if resolve.samples == 1 {
            lines.push("One sample is the pixel.".to_owned());
        } else {
            let weight = format!("1/{}", resolve.samples);
            lines.push(format!(
                "Each of the {} samples weighs {weight}; the pixel is their mean.",
                resolve.samples
            ));
            lines.extend(self.weighted_places());
        }
        if self.averages_light() {
            let words = "Their light is averaged, each weighted by its alpha: sRGB values are decoded before and encoded after.";
            lines.push(words.to_owned());
        }
        if resolve.summed_exactly && resolve.samples > 1 {
            lines.push("Shaded samples are summed before they are rounded to 1/256 of a level.".to_owned());
        }
        let names = ["red", "green", "blue", "alpha"];
        // An opaque pixel's alpha has no story.
        let channels = if self.resolved()[3] == 255 { 0..3 } else { 0..4 };
        for channel in channels {
            lines.push(format!("{:5}  {}", names[channel], self.channel(channel)));
        }
        lines
    }

    /// The places that several samples share: by that a place of a custom pattern weighs more than others.
    fn weighted_places(&self) -> Vec<String> {
        let mut places: Vec<([f64; 2], Vec<usize>)> = Vec::new();
        for (number, sample) in self.samples.iter().enumerate() {
            match places
                .iter_mut()
                .find(|(at, _)| at.map(f64::to_bits) == sample.position.map(f64::to_bits))
            {
                Some((_, samples)) => samples.push(number),
                None => places.push((sample.position, vec![number])),
            }
        }
        places.retain(|(_, samples)| samples.len() > 1);
        let line = |(at, samples): &([f64; 2], Vec<usize>)| {
            let weight = format!("{}/{}", samples.len(), self.samples.len());
            format!(
                "Samples {} are one place, ({}, {}), which weighs {weight}.",
                runs(samples),
                number(at[0]),
                number(at[1])
            )
        };
        let mut lines: Vec<String> = places.iter().take(MOST_PLACES).map(line).collect();
        if places.len() > MOST_PLACES {
            lines.push(match places.len() - MOST_PLACES {
                1 => "So are those of one other place.".to_owned(),
                others => format!("So are those of {others} other places."),
            });
        }
        lines
    }

    /// Whether several samples are averaged in linear light.
    fn averages_light(&self) -> bool {
        self.resolve.space() == ResolveSpace::Linear && self.resolve.samples > 1
    }

    /// A colour channel from its light, or the sum of it, to its byte.
    fn light_channel(&self, channel: usize) -> String {
        let Resolve {
            sums, samples, mean, ..
        } = &self.resolve;
        let (mean, alpha) = (mean[channel], self.resolve.mean[3]);
        let mut text = if self.averages_light() {
            format!("light {} / {samples} = {}", number(sums[channel]), number(mean))
        } else {
            format!("light {}", number(mean))
        };
        let straight = if alpha > 0.0 { mean * 255.0 / alpha } else { 0.0 };
        if self.resolved()[3] < 255 {
            let _ = write!(text, ", / alpha = {}", number(straight));
        }
        let rounding = match self.resolve.rounding {
            Rounding::Nearest => "rounded",
            Rounding::Truncated => "truncated",
        };
        // Writing to a `String` cannot fail.
        let _ = write!(
            text,
            ", encoded {}, {rounding} to {}",
            number(encoded(straight)),
            self.resolved()[channel]
        );
        text
    }

    /// A channel from its sum to its byte.
    fn channel(&self, channel: usize) -> String {
        if channel < 3 && self.resolve.space() == ResolveSpace::Linear {
            return self.light_channel(channel);
        }
        let Resolve {
            sums,
            samples,
            mean,
            rounding,
            ..
        } = &self.resolve;
        let terms = self.terms(channel).unwrap_or_else(|| number(sums[channel]));
        let mean = mean[channel];
        let alpha = self.resolve.mean[3];
        let (shown, straight) = if channel < 3 && self.resolved()[3] < 255 && alpha > 0.0 {
            let straight = mean * 255.0 / alpha;
            (format!("{} / alpha = {}", number(mean), number(straight)), straight)
        } else {
            (number(mean), mean)
        };
        let byte = self.resolved()[channel];
        let rounded = match rounding {
            _ if (straight - f64::from(byte)).abs() < 1e-9 => String::new(),
            Rounding::Nearest => format!(", rounded to {byte}"),
            Rounding::Truncated => format!(", truncated to {byte}"),
        };
        if *samples == 1 {
            return format!("{shown}{rounded}");
        }
        format!("{terms} / {samples} = {shown}{rounded}")
    }

    /// The sum of a channel over the samples, equal ones together; `None` where there are too many different ones.
    fn terms(&self, channel: usize) -> Option<String> {
        if self.resolve.summed_exactly {
            return None;
        }
        let mut terms: Vec<(f64, usize)> = Vec::new();
        for sample in &self.samples {
            let value = sample.color[channel];
            match terms.iter().position(|(other, _)| (other - value).abs() < 1e-9) {
                Some(known) => terms[known].1 += 1,
                None if terms.len() == MOST_TERMS => return None,
                None => terms.push((value, 1)),
            }
        }
        let words: Vec<String> = terms
            .iter()
            .map(|(value, count)| format!("{count} x {}", number(*value)))
            .collect();
        Some(if words.len() > 1 {
            format!("({})", words.join(" + "))
        } else {
            words.concat()
        })
    }
}
