//! An axis of a chart: from numbers to pixels, with the ticks that it has room for.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use super::ticks::{Tick, even, logarithmic};

/// How numbers are spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scale {
    /// Equal differences take equal room.
    Even,
    /// Equal factors do; above zero.
    Logarithmic,
}

/// An axis.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    scale: Scale,
    ends: [f64; 2],
    ticks: Vec<Tick>,
}

impl Axis {
    /// The axis from end to end; `has_room` says of two neighbouring ticks whether both have it so far from each other, in parts
    /// of the axis.
    pub(super) fn new(scale: Scale, ends: [f64; 2], has_room: impl Fn([&Tick; 2], f64) -> bool) -> Self {
        let mut axis = Self {
            scale,
            ends,
            ticks: Vec::new(),
        };
        let all_have = |ticks: &[Tick]| {
            let mut pairs = ticks.windows(2);
            pairs.all(|two| has_room([&two[0], &two[1]], axis.part(two[1].at) - axis.part(two[0].at)))
        };
        axis.ticks = match scale {
            Scale::Even => even(ends, all_have),
            Scale::Logarithmic => logarithmic(ends, all_have),
        };
        axis
    }

    /// Its ticks.
    pub(super) fn ticks(&self) -> &[Tick] {
        &self.ticks
    }

    /// How far along it a number lies, from 0 to 1.
    pub(super) fn part(&self, value: f64) -> f64 {
        let [first, last] = self.ends;
        match self.scale {
            Scale::Even => (value - first) / (last - first),
            Scale::Logarithmic => (value / first).ln() / (last / first).ln(),
        }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (first, last): (i32, i32)) -> i32 {
        let along = self.part(*value) * f64::from(last - first);
        #[expect(
            clippy::cast_possible_truncation,
            reason = "a place in a picture, and close to it beyond"
        )]
        let along = along.round() as i32;
        first.saturating_add(along)
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        // There are no lines between those of ticks.
        if hint.weight().allow_light_points() {
            return Vec::new();
        }
        self.ticks.iter().map(|tick| tick.at).collect()
    }

    fn range(&self) -> Range<f64> {
        self.ends[0]..self.ends[1]
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        let known = self.ticks.iter().find(|tick| tick.at.total_cmp(value).is_eq());
        known.map_or(String::new(), |tick| tick.label.clone())
    }
}
