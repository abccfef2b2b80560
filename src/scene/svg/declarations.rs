//! The declarations of a `style` attribute, in time that grows with its length and no faster.

/// Names and values in the order of the text, without comments around them and without `!important`. What is no declaration
/// is left out.
pub(super) fn declarations(style: &str) -> impl Iterator<Item = (&str, &str)> {
    let mut rest = style;
    let parts = std::iter::from_fn(move || {
        let end = length(rest)?;
        let part = &rest[..end];
        rest = rest.get(end + 1..).unwrap_or("");
        Some(part)
    });
    parts.filter_map(|part| {
        let (name, value) = bare(part).split_once(':')?;
        // A star before the name is an old trick for one browser.
        let name = bare(name);
        let value = bare(value);
        let value = match value.rsplit_once('!') {
            Some((before, mark)) if bare(mark).eq_ignore_ascii_case("important") => bare(before),
            _ => value,
        };
        let name = name.strip_prefix('*').unwrap_or(name);
        (!name.is_empty() && !value.is_empty()).then_some((name, value))
    })
}

/// How many bytes the first declaration has: up to a semicolon outside of quotes, brackets and comments. `None` at the end.
fn length(text: &str) -> Option<usize> {
    if text.is_empty() {
        return None;
    }
    let bytes = text.as_bytes();
    let mut quote = None;
    let mut brackets = 0_usize;
    let mut i = 0;
    while let Some(&byte) = bytes.get(i) {
        match (quote, byte) {
            (Some(open), byte) => quote = quote.filter(|_| open != byte),
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'(') => brackets += 1,
            (None, b')') => brackets = brackets.saturating_sub(1),
            (None, b';') if brackets == 0 => return Some(i),
            (None, b'/') if bytes.get(i + 1) == Some(&b'*') => {
                i = text[i + 2..].find("*/").map_or(text.len(), |end| i + 3 + end);
            }
            _ => {}
        }
        i += 1;
    }
    Some(text.len())
}

/// The text without blanks and comments at its ends.
fn bare(text: &str) -> &str {
    let mut text = text.trim();
    while let Some(comment) = text.strip_prefix("/*") {
        text = comment.split_once("*/").map_or("", |(_, after)| after).trim_start();
    }
    while let Some(comment) = text.strip_suffix("*/") {
        text = comment.rsplit_once("/*").map_or("", |(before, _)| before).trim_end();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declarations_in_their_order() {
        for (style, expected) in [
            ("fill:red;stroke : blue ", vec![("fill", "red"), ("stroke", "blue")]),
            (";; fill : #fff !important ;", vec![("fill", "#fff")]),
            ("/* a;b:c */fill:red/* d */;", vec![("fill", "red")]),
            ("*fill:red", vec![("fill", "red")]),
            (
                "a:url(data:x;base64,y);b:';'",
                vec![("a", "url(data:x;base64,y)"), ("b", "';'")],
            ),
            ("nothing;fill:;:red;fill:blue", vec![("fill", "blue")]),
            ("fill:red;/*", vec![("fill", "red")]),
            ("", vec![]),
        ] {
            assert_eq!(declarations(style).collect::<Vec<_>>(), expected, "{style:?}");
        }
    }

    #[test]
    fn long_styles_take_no_longer_than_their_length() {
        let started = std::time::Instant::now();
        for piece in [
            "fill:red;",
            "fill:#1 ",
            "/**/",
            "/*",
            "*/",
            "a:url(",
            "!important",
            "\u{e9};",
        ] {
            let style = piece.repeat(400_000);
            assert!(declarations(&style).count() <= 400_000, "{piece}");
        }
        let seconds = started.elapsed().as_secs_f64();
        assert!(seconds < 10.0, "{seconds} s for 20 MB");
    }
}
