//! `rasterscope help PAGE`: the reference, which is too long for the help of single commands.

use std::ffi::OsString;

use clap::Command;
use clap_mangen::Man;

use crate::plain;
use crate::raster::SamplePattern;
use crate::render::Visualisation;
use crate::viewer::picture::{self, Values};
use crate::viewer::{PictureSetting, commands, patterns};

/// Where the page of keys holds the table that every command has its line in.
const KEYS: &str = "<!-- keys -->";

/// Where the page of options holds a line for each picture setting.
const SETTINGS: &str = "<!-- settings -->";

/// Where the page of pixels holds the table of sample patterns.
const PATTERNS: &str = "<!-- patterns -->";

/// Where it holds the table of visualisations.
const VISUALISATIONS: &str = "<!-- visualisations -->";

/// The pages with their names.
pub(super) const PAGES: [(&str, &str); 9] = [
    ("options", include_str!("help/options.md")),
    ("keys", include_str!("help/keys.md")),
    ("pixels", include_str!("help/pixels.md")),
    ("values", include_str!("help/values.md")),
    ("figures", include_str!("help/figures.md")),
    ("records", include_str!("help/records.md")),
    ("lessons", include_str!("help/lessons.md")),
    ("scripts", include_str!("help/scripts.md")),
    ("json", include_str!("help/json.md")),
];

/// Names all pages, at the end of the program's help.
pub(super) const LIST: &str = "Without a command, `rasterscope [PATH...]` opens the window: see `rasterscope view --help`.\n\
    The reference: `rasterscope help options`, `keys`, `pixels`, `values`, `figures`, `records`, `lessons`, `scripts`, `json`.\n\
    Man pages: `rasterscope help man [COMMAND] | man -l -`; completions: `rasterscope help completions SHELL`.";

/// The page that the words of a command line ask for, if they ask for one.
pub(super) fn page(words: &[OsString]) -> Option<String> {
    let [_, help, name] = words else {
        return None;
    };
    let (_, text) = PAGES.iter().find(|(page, _)| help == "help" && name == page)?;
    let text = text
        .replace(KEYS, commands::markdown().trim())
        .replace(SETTINGS, settings().trim_end())
        .replace(PATTERNS, patterns().trim_end())
        .replace(VISUALISATIONS, visualisations().trim_end());
    // What is left of comments tells where a measured table begins and ends.
    let lines = text.split_inclusive('\n').filter(|line| !line.starts_with("<!--"));
    Some(lines.collect())
}

/// The man page that the words of a command line ask for, if they ask for one: of the program or of one of its commands.
///
/// # Errors
/// One line where there is no such command.
pub(super) fn man_page(words: &[OsString], program: &Command) -> Option<Result<String, String>> {
    let command = match words {
        [_, help, man] if help == "help" && man == "man" => program.clone(),
        [_, help, man, name] if help == "help" && man == "man" => {
            let mut program = program.clone();
            // So that its usage begins with the program's name.
            program.build();
            let Some(command) = program.find_subcommand(name).cloned() else {
                let name = name.to_string_lossy();
                return Some(Err(format!(
                    "{}: no such command; see `rasterscope --help`",
                    plain::line(&name)
                )));
            };
            let name = format!("{}-{}", program.get_name(), command.get_name());
            command.name(name).version(env!("CARGO_PKG_VERSION"))
        }
        _ => return None,
    };
    let mut page = Vec::new();
    // Writing to memory cannot fail.
    let _ = Man::new(command).render(&mut page);
    Some(Ok(String::from_utf8_lossy(&page).into_owned()))
}

/// The picture settings as lines of a table in Markdown: option, values, default, what it means.
fn settings() -> String {
    let code = |text: &str| format!("`{text}`");
    let number = |text: &str| text.parse::<f64>().is_ok();
    let line = |setting: &PictureSetting| {
        let values = match setting.values {
            Values::Named(names) => names().into_iter().map(code).collect::<Vec<_>>().join(", "),
            Values::NamedOrWritten { names, more, .. } => {
                let names: Vec<String> = names().into_iter().chain(more()).map(code).collect();
                format!("{}, `FILE.toml`", names.join(", "))
            }
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
    picture::all().map(line).collect()
}

/// The sample patterns as a table in Markdown.
fn patterns() -> String {
    let line = |pattern: SamplePattern| {
        let [name, description, source] = [pattern.name(), pattern.description(), pattern.source()];
        let counts = match pattern {
            SamplePattern::Custom(custom) => custom.rate().samples().to_string(),
            _ if pattern.needs_square() => "squares".to_owned(),
            _ => "any".to_owned(),
        };
        format!("| `{name}` | {description} | {counts} | {source} |\n")
    };
    let all = SamplePattern::ALL
        .into_iter()
        .chain(patterns::shipped().iter().copied());
    let lines: String = all.map(line).collect();
    format!("| pattern | samples of a pixel | how many | after |\n|---|---|---|---|\n{lines}")
}

/// The visualisations as a table in Markdown.
fn visualisations() -> String {
    let line = |kind: Visualisation| format!("| `{}` | {} |\n", kind.name(), kind.meaning());
    let lines: String = Visualisation::ALL.into_iter().map(line).collect();
    format!("| shows | what a pixel's colour is |\n|---|---|\n{lines}")
}
