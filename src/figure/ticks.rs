//! Ticks of a chart's axes: where they stand, and numbers with as many digits as tell them apart.

/// A tick and its number.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// Its place on the axis.
    pub(super) at: f64,
    /// What stands beside it.
    pub(super) label: String,
}

/// Most ticks of an axis that are tried.
const MOST: usize = 20;
/// Digits behind a point, and before it, beyond which a number is written with its power of ten.
const PLAIN_DIGITS: i32 = 6;
/// From this part of the last end to the first on, ticks of a logarithmic axis follow decades.
const DECADE: f64 = 10.0;

/// The closest ticks of an axis with even steps that have room; two at least, where numbers can tell two places apart.
pub(super) fn even([low, high]: [f64; 2], has_room: impl Fn(&[Tick]) -> bool) -> Vec<Tick> {
    let span = high - low;
    if !span.is_finite() || span <= 0.0 {
        return Vec::new();
    }
    let finest = exponent(span) - 2;
    let steps = (finest..finest + 4).flat_map(|exponent| [1.0, 2.0, 5.0].map(|digit| (digit, exponent)));
    let candidates = steps.map(|(digit, exponent)| {
        let step = scaled(digit, exponent);
        let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
        if last - first >= MOST as f64 {
            return Vec::new();
        }
        let numbers = std::iter::successors(Some(first), |number| Some(number + 1.0)).take_while(|at| *at <= last);
        let tick = |number: f64| Tick::new(number * step, exponent);
        numbers.map(tick).collect()
    });
    chosen(candidates, has_room)
}

/// The same of a logarithmic axis, above zero: within less than a decade even steps, else the same digits in each.
pub(super) fn logarithmic([low, high]: [f64; 2], has_room: impl Fn(&[Tick]) -> bool) -> Vec<Tick> {
    if high / low < DECADE {
        return even([low, high], has_room);
    }
    let (first, last) = (exponent(low), exponent(high));
    let every = |decades: usize, digits: &'static [f64]| {
        let exponents = (first..=last).step_by(decades);
        let all = exponents.flat_map(|exponent| digits.iter().map(move |digit| (*digit, exponent)));
        let ticks = all.map(|(digit, exponent)| Tick::new(scaled(digit, exponent), exponent));
        ticks.filter(|tick| (low..=high).contains(&tick.at)).collect()
    };
    let digits: [&[f64]; 4] = [
        &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0],
        &[1.0, 2.0, 5.0],
        &[1.0, 3.0],
        &[1.0],
    ];
    let within = digits.map(|digits| every(1, digits)).into_iter();
    chosen(within.chain((2..MOST).map(|decades| every(decades, &[1.0]))), has_room)
}

/// The first of candidates, the closest ticks before others, that has room; else the one with the fewest ticks, but two.
fn chosen(candidates: impl Iterator<Item = Vec<Tick>>, has_room: impl Fn(&[Tick]) -> bool) -> Vec<Tick> {
    let mut fewest = Vec::new();
    for ticks in candidates.filter(|ticks| ticks.len() > 1) {
        if has_room(&ticks) {
            return ticks;
        }
        fewest = ticks;
    }
    fewest
}

impl Tick {
    /// A tick whose number is a multiple of this power of ten.
    fn new(at: f64, step: i32) -> Self {
        let size = if at == 0.0 {
            step
        } else {
            exponent(at.abs() * (1.0 + 1e-9))
        };
        let label = if at == 0.0 {
            "0".to_owned()
        } else if size >= PLAIN_DIGITS || step < -PLAIN_DIGITS {
            // A number beside zero that is none is the rounding of a step.
            let digits = usize::try_from(size - step).unwrap_or(0).min(MOST);
            format!("{at:.digits$e}")
        } else {
            let digits = usize::try_from(-step).unwrap_or(0);
            format!("{at:.digits$}")
        };
        Self { at, label }
    }
}

/// `digit` times this power of ten, as exact as a written number.
fn scaled(digit: f64, exponent: i32) -> f64 {
    format!("{digit}e{exponent}").parse().unwrap_or(digit)
}

/// The power of ten of a number's first digit.
fn exponent(number: f64) -> i32 {
    #[expect(clippy::cast_possible_truncation, reason = "within -324 and 308")]
    let exponent = number.log10().floor() as i32;
    exponent
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().map(|tick| tick.label.as_str()).collect()
    }

    #[test]
    fn ticks_have_the_digits_that_tell_them_apart() {
        let at_most = |count: usize| move |ticks: &[Tick]| ticks.len() <= count;
        let ticks = even([0.008_30, 0.008_34], at_most(5));
        assert_eq!(
            labels(&ticks),
            ["0.00830", "0.00831", "0.00832", "0.00833", "0.00834"],
            "close values"
        );
        assert_eq!(
            labels(&even([0.0, 0.11], at_most(4))),
            ["0", "0.05", "0.10"],
            "from zero"
        );
        assert_eq!(
            labels(&even([40.29, 40.38], at_most(3))),
            ["40.30", "40.35"],
            "one value and its room"
        );
        assert_eq!(
            labels(&even([-1e300, 1e300], at_most(3))),
            ["-1e300", "0", "1e300"],
            "huge"
        );
        assert!(even([1.0, 1.0], at_most(9)).is_empty(), "nothing between");
        assert!(even([0.0, f64::INFINITY], at_most(9)).is_empty(), "no end");
    }

    #[test]
    fn ticks_of_a_logarithmic_axis_are_never_alone() {
        let at_most = |count: usize| move |ticks: &[Tick]| ticks.len() <= count;
        for (range, expected) in [
            ([0.018, 0.055], &["0.02", "0.03", "0.04", "0.05"][..]),
            ([0.7, 12.0], &["1", "2", "5", "10"]),
            ([0.05, 300.0], &["0.1", "1", "10", "100"]),
            ([1.01, 1.9], &["1.2", "1.4", "1.6", "1.8"]),
            ([1e-9, 1e9], &["1e-9", "0.0001", "10", "1e6"]),
        ] {
            let ticks = logarithmic(range, at_most(4));
            assert_eq!(labels(&ticks), expected, "{range:?}");
        }
        // No room at all.
        assert_eq!(logarithmic([1.0, 40.0], at_most(0)).len(), 2, "two are the least");
    }
}
