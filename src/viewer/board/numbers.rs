//! What is measured of an entry, and the order that entries are shown in by it.

use std::cmp::Ordering;
use std::time::Duration;

/// How far an entry is from the truth, over the region, and what a frame of it costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoardNumbers {
    /// Root mean square error in levels of 255.
    pub rmse: f64,
    /// The mean FLIP error; 0 for equal pictures.
    pub flip: f64,
    /// Of drawing the whole frame: the median of several.
    pub time: Duration,
}

/// What the entries of a board are sorted by; the least comes first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BoardSort {
    /// The root mean square error against the truth.
    #[default]
    Rmse,
    /// What people see of the difference from the truth.
    Flip,
    /// The time of a frame.
    Time,
}

impl BoardSort {
    /// The names, as people are told them.
    pub(in crate::viewer) const FORM: &str = "rmse|flip|time";
    /// Every value, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Rmse, Self::Flip, Self::Time];

    /// The name in scripts and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rmse => "rmse",
            Self::Flip => "flip",
            Self::Time => "time",
        }
    }

    /// Which of two comes first; what is not measured yet comes last.
    pub fn order(self, a: Option<&BoardNumbers>, b: Option<&BoardNumbers>) -> Ordering {
        let key = |numbers: &BoardNumbers| match self {
            Self::Rmse => numbers.rmse,
            Self::Flip => numbers.flip,
            Self::Time => numbers.time.as_secs_f64(),
        };
        match (a, b) {
            (Some(a), Some(b)) => key(a).total_cmp(&key(b)),
            (a, b) => a.is_none().cmp(&b.is_none()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boards_are_sorted_with_the_best_first_and_the_unknown_last() {
        let numbers = |rmse, flip, time| BoardNumbers {
            rmse,
            flip,
            time: Duration::from_millis(time),
        };
        let all = [
            Some(numbers(3.0, 0.1, 2)),
            None,
            Some(numbers(1.0, 0.3, 3)),
            Some(numbers(2.0, 0.2, 1)),
        ];
        for (sort, expected) in [
            (BoardSort::Rmse, [2, 3, 0, 1]),
            (BoardSort::Flip, [0, 3, 2, 1]),
            (BoardSort::Time, [3, 0, 2, 1]),
        ] {
            let mut order = [0, 1, 2, 3];
            order.sort_by(|a: &usize, b| sort.order(all[*a].as_ref(), all[*b].as_ref()));
            assert_eq!(order, expected, "{sort:?}");
        }
    }
}
