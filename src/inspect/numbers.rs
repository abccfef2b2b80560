//! Numbers and lists as people read them.

use crate::plain;

/// Numbers of samples, from 1, as runs: `1-3, 5`.
pub(super) fn runs(samples: &[usize]) -> String {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for sample in samples.iter().map(|sample| sample + 1) {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == sample => *last = sample,
            _ => runs.push((sample, sample)),
        }
    }
    let words: Vec<String> = runs
        .into_iter()
        .map(|(first, last)| match last - first {
            0 => first.to_string(),
            1 => format!("{first}, {last}"),
            _ => format!("{first}-{last}"),
        })
        .collect();
    words.join(", ")
}

/// A part of a whole.
pub(super) fn percent(part: f64) -> String {
    let percent = part * 100.0;
    if percent > 0.0 && percent < 0.01 {
        return "under 0.01 %".to_owned();
    }
    if percent < 0.0 && percent > -0.01 {
        return "above -0.01 %".to_owned();
    }
    format!("{percent:.2}")
        .trim_end_matches('0')
        .trim_end_matches('.')
        .to_owned()
        + " %"
}

/// With at most four digits after the point, and none that say nothing.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    unsigned_zero(text)
}

/// A number without the sign of a zero.
fn unsigned_zero(text: &str) -> String {
    let is_zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    text.trim_start_matches(if is_zero { "-" } else { "" }).to_owned()
}

/// A barycentric weight, with four digits after the point.
pub(super) fn weight(value: f64) -> String {
    unsigned_zero(&format!("{value:.4}"))
}

/// Some of the samples of a pixel that has so many: `2 of 4 samples: 1, 3`.
pub(super) fn which(samples: &[usize], all: usize) -> String {
    if samples.len() == 1 && all == 1 {
        return "the only sample".to_owned();
    }
    format!("{} of {}: {}", samples.len(), counted(all, "sample"), runs(samples))
}

/// A part that was counted by samples: `about 4 %`.
pub(super) fn about(part: f64) -> String {
    let percents = (part * 100.0).round();
    if percents < 1.0 {
        "less than 1 %".to_owned()
    } else {
        format!("about {percents} %")
    }
}

/// So many of something: `1 level`, `2 levels`. The plural of `one` ends in s.
pub fn counted(count: usize, one: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {one}{plural}")
}

/// With five digits after the point, cut off and not rounded: what lies before a whole number stays before it.
pub(super) fn cut(value: f64) -> String {
    format!("{:.5}", (value * 1e5).floor() / 1e5)
}

/// With three significant digits.
pub(super) fn significant(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return unsigned_zero(&format!("{value}"));
    }
    let digits = 2.0 - value.abs().log10().floor().clamp(-12.0, 12.0);
    if digits <= 0.0 {
        return format!("{value:.0}");
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0..=14"
    )]
    let text = format!("{value:.*}", digits as usize);
    unsigned_zero(text.trim_end_matches('0').trim_end_matches('.'))
}

/// What a document says, at most 200 characters of it and without control characters.
pub(super) fn one_line(text: &str) -> String {
    const MOST: usize = 200;
    let mut characters = text.chars();
    let blank = |c: char| if c == '\t' { ' ' } else { c };
    let kept: String = characters.by_ref().take(MOST).map(blank).collect();
    let mut kept = plain::line(&kept).into_owned();
    if characters.next().is_some() {
        kept.push_str("...");
    }
    kept
}

/// A colour as style sheets write it.
pub(super) fn hex([r, g, b, a]: [u8; 4]) -> String {
    if a == 255 {
        format!("#{r:02X}{g:02X}{b:02X}")
    } else {
        format!("#{r:02X}{g:02X}{b:02X}{a:02X}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_say_no_more_than_they_know() {
        for (value, expected) in [
            (255.0, "255"),
            (127.5, "127.5"),
            (0.123_456_7, "0.1235"),
            (-0.00001, "0"),
            (-0.0, "0"),
            (10.0, "10"),
        ] {
            assert_eq!(number(value), expected, "{value}");
        }
        for (value, expected) in [
            (0.0, "0"),
            (0.012_345, "0.0123"),
            (123.45, "123"),
            (-1.5, "-1.5"),
            (-0.0, "0"),
            (-1e-20, "0"),
            (1e9, "1000000000"),
        ] {
            assert_eq!(significant(value), expected, "{value}");
        }
        assert_eq!(weight(-1e-9), "0.0000", "a weight");
        assert_eq!(weight(-0.25), "-0.2500", "a weight");
        assert_eq!([counted(1, "place"), counted(2, "place")], ["1 place", "2 places"]);
        assert_eq!(percent(0.375), "37.5 %", "a part");
        assert_eq!(percent(1e-7), "under 0.01 %", "a small part");
    }

    #[test]
    fn samples_are_told_out_of_all() {
        assert_eq!(which(&[0, 2], 4), "2 of 4 samples: 1, 3", "some");
        assert_eq!(which(&[0], 1), "the only sample", "one");
    }

    #[test]
    fn runs_count_from_one() {
        assert_eq!(runs(&[0, 1, 2, 4, 8, 9]), "1-3, 5, 9, 10", "runs");
        assert_eq!(runs(&[]), "", "nothing");
    }

    #[test]
    fn long_lines_are_cut() {
        let long = "\u{e9}\t".repeat(10_000);
        let cut = one_line(&long);
        assert!(cut.chars().count() <= 203 && cut.ends_with("..."), "{cut}");
        assert!(!cut.contains('\t'), "no control characters");
    }
}
