//! `rasterscope pattern`: where samples lie, and how even they are.

use serde::Serialize;

use super::failure::{Failure, print, print_json};
use super::options::pattern::PatternOptions;
use crate::raster::{PatternStatistics, PowerSpectrum, SamplePattern, SampleRate, Seed};
use crate::viewer::{patterns, picture};

/// Samples per pixel where nothing is said.
const USUAL_RATE: u32 = 16;

/// What is told of a pattern.
#[derive(Debug, Serialize)]
struct Report {
    pattern: &'static str,
    samples: u32,
    seed: u32,
    pixel: [u32; 2],
    star_discrepancy: f64,
    /// In pixels.
    least_distance: f64,
    columns: usize,
    rows: usize,
    /// The mean of `spectrum.power` up to half of the square root of the number of samples, in cycles per pixel, but for zero:
    /// random points have 1.
    low_power: f64,
    spectrum: Spectrum,
    /// That of 8 x 8 pixels together, in eighths of cycles per pixel.
    together: Spectrum,
    /// Right and down from the pixel's corner, in pixels.
    points: Vec<[f64; 2]>,
}

/// The mean power by distance from frequency zero.
#[derive(Debug, Serialize)]
struct Spectrum {
    /// The last frequency of the list, in cycles per pixel; the first is zero.
    reach: usize,
    power: Vec<f64>,
}

impl Spectrum {
    fn of(spectrum: &PowerSpectrum) -> Self {
        Self {
            reach: spectrum.reach(),
            power: spectrum.radial(),
        }
    }
}

/// Prints what was measured of each pattern.
pub(super) fn run(options: &PatternOptions) -> Result<(), Failure> {
    let number = options.sample_rate.unwrap_or(USUAL_RATE);
    let rate = SampleRate::new(number).ok_or_else(|| Failure::input(format!("--sample-rate {number}: 1 to 256")))?;
    let named: Result<Vec<SamplePattern>, Failure> = options.patterns.iter().map(|text| named(text)).collect();
    let mut patterns = named?;
    if options.sample_rate.is_some()
        && let Some(refusal) = patterns.iter().find_map(|pattern| pattern.refusal(rate))
    {
        return Err(Failure::input(format!("--sample-rate {number}: {refusal}")));
    }
    if patterns.is_empty() {
        let all = SamplePattern::ALL.iter().chain(patterns::shipped()).copied();
        patterns = all.filter(|pattern| pattern.takes(rate)).collect();
    }
    let reports: Vec<Report> = patterns
        .into_iter()
        .map(|pattern| report(pattern, pattern.nearest(rate), options))
        .collect();
    if options.json {
        let json = match reports.as_slice() {
            [report] => serde_json::to_string(report),
            several => serde_json::to_string(several),
        };
        return print_json(&json.map_err(Failure::other)?);
    }
    let head = "pattern         samples  discrepancy  distance  columns  rows  low power".to_owned();
    let lines: Vec<String> = std::iter::once(head).chain(reports.iter().map(Report::line)).collect();
    print(&lines.join("\n"))
}

/// The pattern that a name or a file means.
fn named(text: &str) -> Result<SamplePattern, Failure> {
    let setting = picture::find("pattern").ok_or_else(|| Failure::other("no setting of patterns"))?;
    let value = setting.read(text, None).map_err(Failure::Input)?;
    patterns::named(&value).ok_or_else(|| Failure::input(format!("{text}: no pattern; give {}", setting.form())))
}

fn report(pattern: SamplePattern, rate: SampleRate, options: &PatternOptions) -> Report {
    let seed = Seed::new(options.seed.into()).unwrap_or_default();
    let pixel @ [x, y] = options.pixel.0;
    let statistics = PatternStatistics::new(pattern, rate, seed, [x.cast_signed(), y.cast_signed()]);
    let [columns, rows] = statistics.projections;
    Report {
        pattern: pattern.name(),
        samples: rate.samples(),
        seed: seed.number(),
        pixel,
        star_discrepancy: statistics.star_discrepancy,
        least_distance: statistics.least_distance,
        columns,
        rows,
        low_power: statistics.spectrum.low_power(),
        spectrum: Spectrum::of(&statistics.spectrum),
        together: Spectrum::of(&statistics.together),
        points: statistics.points,
    }
}

impl Report {
    /// The columns of the table.
    fn line(&self) -> String {
        format!(
            "{:<14}  {:>7}  {:>11.4}  {:>8.4}  {:>7}  {:>4}  {:>9.3}",
            self.pattern,
            self.samples,
            self.star_discrepancy,
            self.least_distance,
            self.columns,
            self.rows,
            self.low_power
        )
    }
}
