//! What the program wrote down of the pictures that it showed.

use std::path::Path;
use std::time::SystemTime;

/// A line of the log; times in milliseconds.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    pub(crate) at: f64,
    pub(crate) shows: String,
    pub(crate) behind: f64,
    pub(crate) draw: f64,
    pub(crate) onto: f64,
    pub(crate) layout: f64,
    pub(crate) tessellate: f64,
    pub(crate) paint: f64,
    pub(crate) compose: f64,
    pub(crate) present: f64,
    pub(crate) pixels: f64,
}

impl Line {
    fn parse(line: &str) -> Option<Self> {
        let words: Vec<&str> = line.split(',').collect();
        let [at, shows, rest @ ..] = words.as_slice() else {
            return None;
        };
        let numbers: Vec<f64> = rest.iter().filter_map(|word| word.parse().ok()).collect();
        let [
            behind,
            draw,
            onto,
            layout,
            tessellate,
            paint,
            compose,
            present,
            _,
            pixels,
        ] = *numbers.as_slice()
        else {
            return None;
        };
        Some(Self {
            at: at.parse().ok()?,
            shows: (*shows).to_owned(),
            behind,
            draw,
            onto,
            layout,
            tessellate,
            paint,
            compose,
            present,
            pixels,
        })
    }

    /// What the panels cost.
    pub(crate) fn panels(&self) -> f64 {
        self.layout + self.tessellate + self.paint
    }

    /// What the thread of the window was busy with.
    pub(crate) fn work(&self) -> f64 {
        self.onto + self.panels() + self.compose + self.present
    }

    pub(crate) fn is_panels(&self) -> bool {
        self.shows == "panels"
    }
}

/// All lines so far; the last may be half written.
pub(crate) fn read(path: &Path) -> Vec<Line> {
    let text = std::fs::read_to_string(path).unwrap_or_default();
    text.split_inclusive('\n')
        .filter(|line| line.ends_with('\n'))
        .filter_map(|line| Line::parse(line.trim_end()))
        .collect()
}

/// The log's clock.
pub(crate) fn now() -> f64 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap();
    since.as_secs_f64() * 1e3
}

/// Median, 95th percentile and maximum.
pub(crate) fn spread(mut numbers: Vec<f64>) -> [f64; 3] {
    if numbers.is_empty() {
        return [f64::NAN; 3];
    }
    numbers.sort_by(f64::total_cmp);
    let at = |percent: usize| numbers[(numbers.len() - 1) * percent / 100];
    [at(50), at(95), at(100)]
}
