//! `rasterscope help PAGE`: the reference, which is too long for the help of single commands.

use std::ffi::OsString;

use crate::viewer::commands;

/// Where the page of keys holds the table that every command has its line in.
const KEYS: &str = "<!-- keys -->";

/// The pages with their names.
const PAGES: [(&str, &str); 8] = [
    ("options", include_str!("help/options.md")),
    ("keys", include_str!("help/keys.md")),
    ("pixels", include_str!("help/pixels.md")),
    ("figures", include_str!("help/figures.md")),
    ("records", include_str!("help/records.md")),
    ("lessons", include_str!("help/lessons.md")),
    ("scripts", include_str!("help/scripts.md")),
    ("json", include_str!("help/json.md")),
];

/// Names all pages, at the end of the program's help.
pub(super) const LIST: &str = "Without a command, `rasterscope [PATH...]` opens the window: see `rasterscope view --help`.\n\
    The reference: `rasterscope help options`, `keys`, `pixels`, `figures`, `records`, `lessons`, `scripts`, `json`.";

/// The page that the words of a command line ask for, if they ask for one.
pub(super) fn page(words: &[OsString]) -> Option<String> {
    let [_, help, name] = words else {
        return None;
    };
    let (_, text) = PAGES.iter().find(|(page, _)| help == "help" && name == page)?;
    Some(text.replace(KEYS, commands::markdown().trim()))
}
