//! In words, what a pixel takes of its neighbours where a filter is wider than a pixel.

use std::fmt::Write as _;

use super::model::{Around, Explanation, Resolve, Rounding, Taken};
use super::numbers::{counted, number};
use crate::color::{ResolveSpace, encoded};

/// Neighbours that are told one by one at most: those that add most.
const MOST_TOLD: usize = 8;
/// Samples along the side of a pixel whose weights are drawn as a map at most.
const MOST_COLUMNS: usize = 8;

impl Explanation {
    /// How the samples of this and other pixels became the colour.
    pub(super) fn around_lines(&self, around: &Around) -> Vec<String> {
        let count = around.pixels.len();
        let plural = if count == 1 { "" } else { "s" };
        let samples = match self.resolve.samples {
            _ if around.is_own_mean => {
                "set aside here, for its weights add up to less than an eighth of what even ones do: the pixel is the mean of its own samples.".to_owned()
            }
            _ if self.exact && count == 1 => "this pixel weighs 1, and no other weighs anything.".to_owned(),
            _ if self.exact => format!("{count} pixels weigh 1 together, each by its place around this one."),
            1 => "1 sample weighs 1, wherever it lies around the pixel's middle.".to_owned(),
            samples => format!(
                "{samples} samples of {count} pixel{plural} weigh 1 together, each by its place around the pixel's middle."
            ),
        };
        let mut lines = vec![format!(
            "Filter {}, radius {}: {samples}",
            around.filter,
            number(around.radius),
        )];
        if self.resolve.space() == ResolveSpace::Linear {
            let words = "Their light is summed, each weighted by its alpha too: sRGB values are decoded before and encoded after.";
            lines.push(words.to_owned());
        }
        if !self.exact || count > 1 {
            let weigh = if self.exact {
                "Each pixel weighs, this one in the middle:"
            } else {
                "The samples of each pixel weigh together, this one in the middle:"
            };
            lines.push(weigh.to_owned());
            lines.extend(around.map());
        }
        lines.extend(around.own_lines());
        lines.extend(around.neighbour_lines());
        let names = ["red", "green", "blue", "alpha"];
        let channels = if self.resolved()[3] == 255 && self.resolve.mean[3] < 255.5 {
            0..3
        } else {
            0..4
        };
        lines.extend(channels.map(|channel| format!("{:5}  {}", names[channel], self.taken_channel(around, channel))));
        lines
    }

    /// A channel from what the pixel's own samples and its neighbours' add, to its byte.
    fn taken_channel(&self, around: &Around, channel: usize) -> String {
        let Resolve { mean, rounding, .. } = &self.resolve;
        let own = around.own().map_or(0.0, |own| own.adds[channel]);
        let is_light = channel < 3 && self.resolve.space() == ResolveSpace::Linear;
        let light = if is_light { "light " } else { "" };
        let sum = mean[channel];
        let mut words = format!(
            "{light}own {} + neighbours {} = {}",
            number(own),
            number(sum - own),
            number(sum)
        );
        let opacity = mean[3].clamp(0.0, 255.0);
        let most = if channel < 3 { opacity } else { 255.0 };
        let clamped = sum.clamp(0.0, most);
        // Less is the rounding of these numbers; and writing to a `String` cannot fail.
        if (clamped - sum).abs() > 1e-6 {
            let _ = write!(words, ", clamped to {}", number(clamped));
        }
        let mut last = clamped;
        if channel < 3 && self.resolved()[3] < 255 && opacity > 0.0 {
            last = clamped * 255.0 / opacity;
            let _ = write!(words, ", / alpha = {}", number(last));
        }
        if is_light {
            last = encoded(last);
            let _ = write!(words, ", encoded {}", number(last));
        }
        let byte = self.resolved()[channel];
        if (last - f64::from(byte)).abs() > 1e-9 {
            let how = match rounding {
                Rounding::Nearest => "rounded",
                Rounding::Truncated => "truncated",
            };
            let _ = write!(words, ", {how} to {byte}");
        }
        words
    }
}

impl Around {
    fn own(&self) -> Option<&Taken> {
        self.pixels.iter().find(|pixel| pixel.beside == [0, 0])
    }

    /// What each pixel weighs, where it lies.
    fn map(&self) -> Vec<String> {
        let margin = self
            .pixels
            .iter()
            .flat_map(|pixel| pixel.beside)
            .map(i32::abs)
            .max()
            .unwrap_or(0);
        let weight = |beside: [i32; 2]| {
            let found = self.pixels.iter().find(|pixel| pixel.beside == beside);
            format!("{:>8}", part(found.map_or(0.0, |found| found.weight)))
        };
        let row = |y: i32| (-margin..=margin).map(|x| weight([x, y])).collect::<String>();
        (-margin..=margin).map(row).collect()
    }

    /// What the samples of the pixel itself weigh, by rows if they lie on a grid.
    fn own_lines(&self) -> Vec<String> {
        let Some(own) = self.own().filter(|own| own.weights.len() > 1) else {
            return Vec::new();
        };
        let words: Vec<String> = own
            .weights
            .iter()
            .map(|weight| format!("{:>8}", part(*weight)))
            .collect();
        let side = (2..=MOST_COLUMNS).find(|side| side * side == words.len());
        let mut lines = vec!["Its own samples weigh:".to_owned()];
        lines.extend(words.chunks(side.unwrap_or(MOST_COLUMNS)).map(<[String]>::concat));
        lines
    }

    /// What the neighbours add that add most, and what the others do.
    fn neighbour_lines(&self) -> Vec<String> {
        let mut neighbours: Vec<&Taken> = self.pixels.iter().filter(|pixel| pixel.beside != [0, 0]).collect();
        let most = |taken: &Taken| taken.adds.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
        neighbours.sort_by(|a, b| {
            most(b)
                .total_cmp(&most(a))
                .then(b.weight.abs().total_cmp(&a.weight.abs()))
        });
        let (told, others) = neighbours.split_at(neighbours.len().min(MOST_TOLD));
        let mut lines: Vec<String> = told
            .iter()
            .map(|taken| {
                let [x, y] = taken.beside;
                format!(
                    "neighbour ({x:+}, {y:+})  weighs {}, adds {}",
                    part(taken.weight),
                    levels(taken.adds)
                )
            })
            .collect();
        if !others.is_empty() {
            let adds = [0, 1, 2, 3].map(|k| others.iter().map(|taken| taken.adds[k]).sum());
            let weight = others.iter().map(|taken| taken.weight).sum();
            lines.push(format!(
                "{}  weigh {}, add {}",
                counted(others.len(), "other"),
                part(weight),
                levels(adds)
            ));
        }
        lines
    }
}

/// A weight as a part of the whole, below zero too.
fn part(weight: f64) -> String {
    let percent = format!("{:.2}", weight * 100.0);
    let percent = if percent == "-0.00" { "0.00" } else { &percent };
    format!("{percent}%")
}

/// Red, green and blue in levels.
fn levels([r, g, b, _]: [f64; 4]) -> String {
    let level = |value: f64| number((value * 100.0).round() / 100.0);
    format!("{}, {}, {}", level(r), level(g), level(b))
}
