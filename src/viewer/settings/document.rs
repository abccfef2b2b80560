//! Documents in TOML: how their files are read, and where in them a mistake lies.

use std::fs;
use std::io::Read as _;
use std::ops::Range;
use std::path::Path;

use crate::plain;

/// What is wrong, and where in the document.
pub(in crate::viewer) struct Mistake {
    /// Its bytes.
    pub(in crate::viewer) at: Range<usize>,
    /// What is wrong, and the cure.
    pub(in crate::viewer) problem: String,
}

/// What was read, or the first mistake.
pub(in crate::viewer) type Found<T> = Result<T, Mistake>;

/// A mistake in this place.
pub(in crate::viewer) fn mistake<T>(at: Range<usize>, problem: impl Into<String>) -> Found<T> {
    Err(Mistake {
        at,
        problem: problem.into(),
    })
}

/// Line and column of a byte, from 1.
pub(in crate::viewer) fn place(document: &str, byte: usize) -> [usize; 2] {
    let mut end = byte.min(document.len());
    while !document.is_char_boundary(end) {
        end -= 1;
    }
    let before = &document[..end];
    let line = before.rsplit('\n').next().unwrap_or_default();
    [before.matches('\n').count() + 1, line.chars().count() + 1]
}

/// What is quoted in a message, in one short line.
pub(in crate::viewer) fn short(text: &str) -> String {
    const MOST: usize = 160;
    let blank = |c: char| if c.is_ascii_whitespace() { ' ' } else { c };
    let line: String = text.chars().map(blank).take(MOST).collect();
    let mut line = plain::line(&line).into_owned();
    if text.chars().count() > MOST {
        line.push('\u{2026}');
    }
    line
}

/// The text of a file of at most `most` KiB.
///
/// # Errors
/// What is wrong, and `cure`, without the file's name.
pub(in crate::viewer) fn read(path: &Path, most: u64, cure: &str) -> Result<String, String> {
    let unreadable = |error: std::io::Error| format!("cannot be read: {error}; {cure}");
    // A pipe would be waited for.
    if !fs::metadata(path).map_err(unreadable)?.is_file() {
        return Err(format!("is not a file; {cure}"));
    }
    let mut bytes = Vec::new();
    let file = fs::File::open(path).map_err(unreadable)?;
    file.take((most << 10) + 1)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    if bytes.len() as u64 > most << 10 {
        return Err(format!("is larger than {most} KiB; {cure}"));
    }
    String::from_utf8(bytes).map_err(|_| "is not text in UTF-8; save it in that encoding".to_owned())
}
