//! Numbers as C reads them, which is how the course's reader does: as much of the text as looks like one.

use super::Problem;

/// The number at the start of `text` after blanks, as a 32-bit float; `None` if there is none.
///
/// # Errors
/// [`Problem::NotFinite`] for `nan` and `inf`, [`Problem::TooLarge`] for what is too large for 32 bits.
pub(super) fn leading(attribute: &str, text: &str) -> Result<Option<f32>, Problem> {
    let start = text.trim_start();
    let number = &start[..length(start.as_bytes())];
    if number.is_empty() {
        if says_not_finite(start.as_bytes()) {
            return Err(not_finite(attribute, text));
        }
        return Ok(None);
    }
    finite(number).map(Some).ok_or_else(|| too_large(attribute, text))
}

/// Whether `text` is one number and nothing else, but perhaps the unit of pixels.
pub(super) fn is_plain(text: &str) -> bool {
    let text = text.trim();
    text.strip_suffix("px").unwrap_or(text).parse::<f32>().is_ok()
}

/// All numbers in `text`, separated by anything.
///
/// # Errors
/// As [`leading`].
pub(super) fn all(attribute: &str, text: &str) -> Result<Vec<f32>, Problem> {
    let mut numbers = Vec::new();
    let bytes = text.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        let length = length(&bytes[at..]);
        if length > 0 {
            let number = text.get(at..at + length).and_then(finite);
            numbers.push(number.ok_or_else(|| too_large(attribute, text))?);
            at += length;
        } else if says_not_finite(&bytes[at..]) {
            return Err(not_finite(attribute, text));
        } else {
            // A word at once, so that a long one is looked at once.
            at += letters(&bytes[at..]).max(1);
        }
    }
    Ok(numbers)
}

/// Where in `text` the first number stands that is too large for 32 bits. Words are no numbers here, whatever they say.
pub(super) fn too_large_at(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    // Most values are short and plain: only what may be too large is looked at.
    let has_exponent = || bytes.iter().any(|byte| matches!(byte, b'e' | b'E'));
    let is_long = || bytes.split(|byte| !byte.is_ascii_digit()).any(|run| run.len() > 37);
    if !has_exponent() && !is_long() {
        return None;
    }
    let mut at = 0;
    while at < bytes.len() {
        let length = length(&bytes[at..]);
        if length > 0 && text.get(at..at + length).and_then(finite).is_none() {
            return Some(at);
        }
        at += length.max(letters(&bytes[at..])).max(1);
    }
    None
}

fn not_finite(attribute: &str, value: &str) -> Problem {
    Problem::NotFinite {
        attribute: attribute.to_owned(),
        value: value.to_owned(),
    }
}

fn too_large(attribute: &str, value: &str) -> Problem {
    Problem::TooLarge {
        attribute: attribute.to_owned(),
        value: value.to_owned(),
    }
}

fn finite(number: &str) -> Option<f32> {
    number.parse().ok().filter(|number: &f32| number.is_finite())
}

/// Whether the text begins with a word for what is no finite number.
fn says_not_finite(bytes: &[u8]) -> bool {
    let unsigned = bytes.strip_prefix(b"-").or(bytes.strip_prefix(b"+")).unwrap_or(bytes);
    let word = &unsigned[..letters(unsigned)];
    [b"nan".as_slice(), b"inf", b"infinity"]
        .iter()
        .any(|name| word.eq_ignore_ascii_case(name))
}

/// How many letters the text begins with.
fn letters(bytes: &[u8]) -> usize {
    bytes.iter().take_while(|b| b.is_ascii_alphabetic()).count()
}

/// How many bytes at the start form a decimal number: sign, digits with at most one point, exponent.
fn length(bytes: &[u8]) -> usize {
    let digits = |from: usize| {
        bytes[from.min(bytes.len())..]
            .iter()
            .take_while(|b| b.is_ascii_digit())
            .count()
    };
    let sign = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let whole = digits(sign);
    let mut end = sign + whole;
    if bytes.get(end) == Some(&b'.') {
        let fraction = digits(end + 1);
        if whole + fraction > 0 {
            end += 1 + fraction;
        }
    }
    if end == sign {
        return 0;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits(end + 1 + sign);
        if exponent > 0 {
            end += 1 + sign + exponent;
        }
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leading_number_as_c() {
        for (text, expected) in [
            ("272.863px", Some(272.863)),
            (" .5", Some(0.5)),
            ("-3.", Some(-3.0)),
            ("+1e2x", Some(100.0)),
            ("1e", Some(1.0)),
            ("", None),
            ("px", None),
            (".", None),
            ("-", None),
            ("1e-999", Some(0.0)),
        ] {
            assert_eq!(leading("a", text).expect("finite"), expected, "{text:?}");
        }
    }

    #[test]
    fn plain_numbers_have_no_unit_but_that_of_pixels() {
        for (text, is) in [
            (" 10 ", true),
            ("-.5e1px", true),
            ("10cm", false),
            ("100%", false),
            ("1,000", false),
            ("", false),
        ] {
            assert_eq!(is_plain(text), is, "{text:?}");
        }
    }

    #[test]
    fn leading_number_finite_or_refused() {
        for text in ["nan", "-inf", "INFINITY", "1e400", "1e39", "-9e99px"] {
            assert!(leading("a", text).is_err(), "{text}");
            assert!(all("a", text).is_err(), "{text}");
        }
        for (text, word) in [("-1e300", "too large"), ("1e400", "too large"), ("-inf", "not finite")] {
            let told =
                [leading("a", text).err(), all("a", text).err()].map(|problem| problem.expect("refused").to_string());
            assert!(told.iter().all(|line| line.contains(word)), "{text}: {told:?}");
        }
        assert_eq!(leading("a", "1e30").expect("finite"), Some(1e30), "large is legal");
    }

    #[test]
    fn numbers_that_are_too_large_have_a_place() {
        let long = "9".repeat(39);
        for (text, expected) in [
            ("1e38 -3e38,.5e1", None),
            ("nan inf 1e5", None),
            ("1em 2ex", None),
            ("M0 0L1e39 5", Some(5)),
            ("translate(1e400px)", Some(10)),
            ("\u{e9}-1e39", Some(2)),
            (&format!("1 {long}"), Some(2)),
            (&"0".repeat(60), None),
        ] {
            assert_eq!(too_large_at(text), expected, "{text}");
        }
    }

    #[test]
    fn all_numbers_separated_by_anything() {
        for text in ["1,2 3,4", "1 2 3 4", "1;2/3x4", " 1.0+2,\n\t3 4 ", "1.,2,,3 - 4"] {
            assert_eq!(all("a", text).expect("finite"), [1.0, 2.0, 3.0, 4.0], "{text:?}");
        }
        assert_eq!(
            all("a", "1-2.5.5").expect("finite"),
            [1.0, -2.5, 0.5],
            "no separator needed"
        );
        assert_eq!(all("a", "\u{e9}1\u{4e2d}").expect("finite"), [1.0], "foreign letters");
    }
}
