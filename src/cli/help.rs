//! `rasterscope help PAGE`: the reference, which is too long for the help of single commands.

use std::ffi::OsString;

use crate::raster::SamplePattern;
use crate::viewer::picture::{self, Values};
use crate::viewer::{PictureSetting, commands};

/// Where the page of keys holds the table that every command has its line in.
const KEYS: &str = "<!-- keys -->";

/// Where the page of options holds a line for each picture setting.
const SETTINGS: &str = "<!-- settings -->";

/// Where the page of pixels holds the table of sample patterns.
const PATTERNS: &str = "<!-- patterns -->";

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
    Some(
        text.replace(KEYS, commands::markdown().trim())
            .replace(SETTINGS, settings().trim_end())
            .replace(PATTERNS, patterns().trim_end()),
    )
}

/// The picture settings as lines of a table in Markdown: option, values, default, what it means.
fn settings() -> String {
    let code = |text: &str| format!("`{text}`");
    let number = |text: &str| text.parse::<f64>().is_ok();
    let line = |setting: &PictureSetting| {
        let values = match setting.values {
            Values::Named(names) => names().into_iter().map(code).collect::<Vec<_>>().join(", "),
            Values::Open { range, .. } => range.to_owned(),
        };
        let default = setting.default_value();
        let default = if number(&default) { default } else { code(&default) };
        let mut means = setting.help.to_owned();
        if let Some(first) = means.get_mut(..1) {
            first.make_ascii_lowercase();
        }
        format!("| `--{}` | {values} | {default} | {means} |\n", setting.option)
    };
    picture::all().iter().map(line).collect()
}

/// The sample patterns as a table in Markdown.
fn patterns() -> String {
    let line = |pattern: SamplePattern| {
        let [name, description, source] = [pattern.name(), pattern.description(), pattern.source()];
        let counts = if pattern.needs_square() { "squares" } else { "any" };
        format!("| `{name}` | {description} | {counts} | {source} |\n")
    };
    let lines: String = SamplePattern::ALL.into_iter().map(line).collect();
    format!("| pattern | samples of a pixel | how many | after |\n|---|---|---|---|\n{lines}")
}
