//! Text from outside, made fit to be shown: what would steer a terminal, or turn the direction of writing, becomes visible.
//!
//! Names of files, documents, records, scripts and pins come from anywhere. Whatever prints them, on a terminal, in a window
//! title, a caption or a message, passes them through here.

use std::borrow::Cow;
use std::fmt::Write as _;

/// Longest line that is shown, in characters; the middle of a longer one is left out, since causes stand at the start and
/// cures at the end.
pub const MAX_LINE: usize = 2000;

/// Whether a character only shows, and steers nothing: no control character, no sign that orders the direction of writing
/// (Unicode Standard Annex 9), none that is invisible. Joiners of letters and emoji are part of how words are written.
pub fn is_plain(character: char) -> bool {
    !character.is_control()
        && !matches!(
            character,
            '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}'
                | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}'
        )
}

/// `text` as one line: every character that is not plain, line breaks too, is written as in `\u{1b}`.
pub fn line(text: &str) -> Cow<'_, str> {
    escaped(text, is_plain)
}

/// As [`line()`], but line breaks stay.
pub fn lines(text: &str) -> Cow<'_, str> {
    escaped(text, |character| character == '\n' || is_plain(character))
}

/// As [`line()`], of a text that stays as it is where it can.
pub fn into_line(text: String) -> String {
    if text.chars().all(is_plain) {
        return text;
    }
    line(&text).into_owned()
}

/// As [`lines`], of a text that stays as it is where it can.
pub fn into_lines(text: String) -> String {
    if text.chars().all(|character| character == '\n' || is_plain(character)) {
        return text;
    }
    lines(&text).into_owned()
}

/// As [`line()`], with at most about `limit` characters as they are shown: the middle of a longer text is left out.
pub fn short_line(text: &str, limit: usize) -> String {
    if text.chars().map(shown_width).sum::<usize>() <= limit {
        return line(text).into_owned();
    }
    let (head, tail) = (limit - limit / 4, limit / 4);
    let start = &text[..bytes_within(text.chars(), head)];
    let rest = &text[start.len()..];
    let end = &rest[rest.len() - bytes_within(rest.chars().rev(), tail)..];
    format!("{} ... {}", line(start), line(end))
}

/// Bytes of the first of `characters` that are shown within `width` characters.
fn bytes_within(characters: impl Iterator<Item = char>, mut width: usize) -> usize {
    characters
        .map_while(|character| {
            width = width.checked_sub(shown_width(character))?;
            Some(character.len_utf8())
        })
        .sum()
}

/// Characters that [`line()`] shows for one.
fn shown_width(character: char) -> usize {
    if is_plain(character) {
        1
    } else {
        character.escape_unicode().len()
    }
}

/// JSON whose strings hold no character that is not plain: they are written as JSON's own escapes, which mean the same.
pub fn json(text: &str) -> Cow<'_, str> {
    // Line breaks of a pretty layout stand between strings.
    if text.chars().all(|character| character == '\n' || is_plain(character)) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        if character == '\n' || is_plain(character) {
            out.push(character);
            continue;
        }
        for unit in character.encode_utf16(&mut [0; 2]) {
            // Writing to a `String` cannot fail.
            let _ = write!(out, "\\u{unit:04x}");
        }
    }
    Cow::Owned(out)
}

fn escaped(text: &str, stays: impl Fn(char) -> bool) -> Cow<'_, str> {
    if text.chars().all(&stays) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for character in text.chars() {
        if stays(character) {
            out.push(character);
        } else {
            out.extend(character.escape_unicode());
        }
    }
    Cow::Owned(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_text_stays_as_it_is() {
        for text in ["", "a.svg", "ä ö 北京 \u{1f600}", "क्\u{200d}ष", "\"quotes\" \\ and all"] {
            assert!(matches!(line(text), Cow::Borrowed(_)), "{text}");
        }
        assert_eq!(lines("a\nb"), "a\nb", "lines of ours");
    }

    #[test]
    fn plain_shows_what_steers() {
        assert_eq!(line("a\u{1b}[2Jb"), "a\\u{1b}[2Jb", "an escape sequence");
        assert_eq!(line("a\nb\r\t"), "a\\u{a}b\\u{d}\\u{9}", "line breaks");
        assert_eq!(lines("a\r\nb\u{9b}"), "a\\u{d}\nb\\u{9b}", "but those of lines");
        assert_eq!(line("cod.\u{202e}gvs"), "cod.\\u{202e}gvs", "direction of writing");
        for character in [
            '\0',
            '\u{7f}',
            '\u{85}',
            '\u{200f}',
            '\u{2066}',
            '\u{2028}',
            '\u{feff}',
            '\u{e0041}',
        ] {
            assert!(!is_plain(character), "{character:?}");
        }
    }

    #[test]
    fn plain_lines_are_short() {
        let long = format!("{}\u{1b}{}", "x".repeat(5000), "y".repeat(5000));
        let short = short_line(&long, 100);
        assert!(short.starts_with("xxx") && short.ends_with("yyy"), "both ends: {short}");
        assert!(short.chars().count() < 110, "short: {short}");
        assert_eq!(short_line("a\nb", 100), "a\\u{a}b", "as it is");
    }

    #[test]
    fn plain_json_means_the_same() {
        let text = "{\n  \"a\": \"x\u{7f}\u{202e}y\u{e0041}\"\n}";
        let plain = json(text);
        assert_eq!(plain, "{\n  \"a\": \"x\\u007f\\u202ey\\udb40\\udc41\"\n}", "escaped");
        assert!(
            matches!(json("{\n  \"a\": \"\u{e9}\"}"), Cow::Borrowed(_)),
            "what needs nothing"
        );
    }

    /// Found by libFuzzer: a word of 200 zeros was short as it was read and 1000 characters as it was shown.
    #[test]
    fn short_line_is_short_as_it_is_shown() {
        for text in [
            "\0".repeat(200),
            "ä".repeat(400),
            format!("head{}tail", "\u{202e}b".repeat(90)),
        ] {
            let short = short_line(&text, 100);
            let count = short.chars().count();
            assert!((80..=105).contains(&count), "{count} characters: {short}");
            assert!(short.contains(" ... "), "{short}");
            assert!(
                !short.replace("\\u{0}", "").contains(['\\', '{']) || !text.starts_with('\0'),
                "whole escapes: {short}"
            );
        }
        assert_eq!(short_line("\0\0", 10), "\\u{0}\\u{0}", "what fits stays");
        assert_eq!(
            short_line("abcdefghijklmnop", 8),
            "abcdef ... op",
            "its start and its end"
        );
    }
}
