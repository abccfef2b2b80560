//! Sample patterns by their texts: the program's own by name, custom ones written out, or in a TOML file such as
//!
//! ```toml
//! name = "cross"
//! grid = 4                        # x and y count fourths of a pixel; without it they lie between 0 and 1
//! samples = [
//!     { x = 2, y = 2, weight = 2 },
//!     { x = 1, y = 2 },
//! ]
//! ```
//!
//! Records, captions and scripts carry the samples themselves, not the file, in a form that [`named`] reads.

use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex, PoisonError};

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::geometry::subpixel::SubpixelGrid;
use crate::plain;
use crate::raster::{CustomPattern, CustomSample, CustomWords, SamplePattern};
use crate::viewer::settings::document::{self, Found, Mistake, mistake, place, short};

/// Largest file that is read, in KiB.
const MOST_KIB: u64 = 64;
/// Longest description or source, in bytes.
const LONGEST_WORDS: usize = 200;
/// Points of the lattice along one side of a pixel.
const LATTICE: f64 = SubpixelGrid::FINE_SIDE as f64;
/// What a pattern is called that is no name.
pub(super) const FORM: &str = "NAME:X/Y+X/YxWEIGHT in 1/256 of a pixel, or a TOML file of samples";

/// The custom patterns that come with the program: names and documents.
static DOCUMENTS: [(&str, &str); 4] = [
    ("msaa-2", include_str!("../../../assets/patterns/msaa-2.toml")),
    ("msaa-4", include_str!("../../../assets/patterns/msaa-4.toml")),
    ("msaa-8", include_str!("../../../assets/patterns/msaa-8.toml")),
    ("msaa-16", include_str!("../../../assets/patterns/msaa-16.toml")),
];

static SHIPPED: LazyLock<Vec<SamplePattern>> = LazyLock::new(|| {
    let read = DOCUMENTS
        .iter()
        .filter_map(|(name, document)| parse(document, name).ok());
    read.map(SamplePattern::Custom).collect()
});

/// The custom patterns that come with the program.
pub fn shipped() -> &'static [SamplePattern] {
    &SHIPPED
}

/// Their names.
pub(super) fn shipped_names() -> Vec<&'static str> {
    shipped().iter().map(|pattern| pattern.name()).collect()
}

/// The pattern that a text means: a name, or a custom pattern written out.
pub fn named(text: &str) -> Option<SamplePattern> {
    let own = SamplePattern::ALL.iter().chain(shipped());
    if let Some(pattern) = own.into_iter().find(|pattern| pattern.name() == text) {
        return Some(*pattern);
    }
    CustomPattern::parse(text)
        .filter(|pattern| is_free(pattern))
        .map(SamplePattern::Custom)
}

/// Whether no pattern of the program's own is called the same, but that itself.
fn is_free(pattern: &'static CustomPattern) -> bool {
    let mut own = SamplePattern::ALL.iter().chain(shipped());
    own.all(|own| own.name() != pattern.name() || *own == SamplePattern::Custom(pattern))
}

/// Whether a pattern is custom and does not come with the program.
pub(super) fn is_own(pattern: SamplePattern) -> bool {
    matches!(pattern, SamplePattern::Custom(_)) && !shipped().contains(&pattern)
}

/// The text that [`named`] reads.
pub(super) fn value_of(pattern: SamplePattern) -> String {
    match pattern {
        SamplePattern::Custom(custom) if is_own(pattern) => custom.to_string(),
        pattern => pattern.name().to_owned(),
    }
}

/// The name in a text that [`value_of`] wrote.
pub(super) fn name_in(value: &str) -> &str {
    value.split(':').next().unwrap_or(value)
}

/// Whether a text names a TOML file.
pub fn is_file_name(text: &str) -> bool {
    let ending = Path::new(text).extension();
    ending.is_some_and(|ending| ending.eq_ignore_ascii_case("toml"))
}

/// Whether a TOML file holds a pattern, and no lesson: it has `samples` and no step.
pub fn is_pattern_file(path: &Path) -> bool {
    let text = is_file_name(&path.to_string_lossy()).then(|| document::read(path, MOST_KIB, "").ok());
    let text = text.flatten().unwrap_or_default();
    let begins = |word: &str| {
        let mut rests = text.lines().filter_map(|line| line.trim_start().strip_prefix(word));
        rests.any(|rest| rest.trim_start().starts_with('='))
    };
    begins("samples") && !text.contains("[[step]]")
}

/// Patterns that were read from files, and from which; as the patterns themselves, these are of the whole process.
static FILES: Mutex<Vec<(SamplePattern, PathBuf)>> = Mutex::new(Vec::new());

/// The file that a pattern was read from, the last one where several hold the same.
pub(in crate::viewer) fn file_of(pattern: SamplePattern) -> Option<PathBuf> {
    let files = FILES.lock().unwrap_or_else(PoisonError::into_inner);
    let known = files.iter().find(|(known, _)| *known == pattern);
    known.map(|(_, file)| file.clone())
}

/// Notes the file of a pattern.
fn note_file(pattern: SamplePattern, file: &Path) {
    let mut files = FILES.lock().unwrap_or_else(PoisonError::into_inner);
    files.retain(|(known, _)| *known != pattern);
    files.push((pattern, file.to_owned()));
}

/// The pattern in a file, as text that [`named`] reads.
///
/// # Errors
/// One line with the file, the place and the cure.
pub fn of_file(path: &Path) -> Result<String, String> {
    let name = path.display().to_string();
    let text = document::read(path, MOST_KIB, "give a sample pattern in TOML")
        .map_err(|problem| format!("{name}: {problem}"))?;
    let pattern = parse(&text, &name)?;
    if !is_free(pattern) {
        // It was read a moment ago.
        let table = DeTable::parse(&text).ok();
        let at = table.and_then(|table| Some(table.get_ref().get("name")?.span().start));
        let [line, column] = place(&text, at.unwrap_or(0));
        return Err(format!(
            "{name}:{line}:{column}: `{}` is a pattern of the program's own, with other samples; take another name",
            pattern.name()
        ));
    }
    let pattern = SamplePattern::Custom(pattern);
    note_file(pattern, path);
    Ok(value_of(pattern))
}

/// The pattern in the TOML `document`, which is called `file`.
///
/// # Errors
/// One line with the file, the place and the cure.
pub fn parse(document: &str, file: &str) -> Result<&'static CustomPattern, String> {
    let table = DeTable::parse(document).map_err(|error| Mistake {
        at: error.span().unwrap_or(0..0),
        problem: format!("not TOML: {}; see https://toml.io", error.message().replace('\n', " ")),
    });
    table
        .and_then(|table| pattern(table.get_ref()))
        .map_err(|Mistake { at, problem }| {
            let [line, column] = place(document, at.start);
            format!("{file}:{line}:{column}: {problem}")
        })
}

type Value<'i> = Spanned<DeValue<'i>>;

fn pattern(table: &DeTable<'_>) -> Found<&'static CustomPattern> {
    let (mut name, mut description, mut source) = (None, String::new(), String::new());
    let (mut grid, mut samples) = (1.0, None);
    for (key, value) in table {
        match key.get_ref().as_ref() {
            "name" => name = Some(words(value)?),
            "description" => description = words(value)?,
            "source" => source = words(value)?,
            "grid" => grid = f64::from(whole(value, "a grid")?),
            "samples" => samples = Some(value),
            other => {
                let cure = "a pattern has `name`, `samples` and perhaps `grid`, `description`, `source`";
                return mistake(key.span(), format!("`{}` is unknown; {cure}", short(other)));
            }
        }
    }
    let Some(name) = name else {
        return mistake(0..0, "no name; add `name = \"...\"`");
    };
    let Some(samples) = samples else {
        return mistake(0..0, "no samples; add `samples = [ { x = 0.5, y = 0.5 } ]`");
    };
    let Some(list) = samples.get_ref().as_array() else {
        return mistake(
            samples.span(),
            "`samples` is not a list; write `[ { x = 0.5, y = 0.5 } ]`",
        );
    };
    let read: Found<Vec<CustomSample>> = list.iter().map(|value| sample(value, grid)).collect();
    let words = CustomWords {
        name: &name,
        description: &description,
        source: &source,
    };
    CustomPattern::new(words, &read?).or_else(|error| mistake(samples.span(), error.to_string()))
}

fn sample(value: &Value<'_>, grid: f64) -> Found<CustomSample> {
    let Some(table) = value.get_ref().as_table() else {
        return mistake(value.span(), "a sample is a table; write `{ x = 0.5, y = 0.5 }`");
    };
    let (mut places, mut weight) = ([None; 2], 1);
    for (key, value) in table {
        match key.get_ref().as_ref() {
            "x" => places[0] = Some(point(value, grid)?),
            "y" => places[1] = Some(point(value, grid)?),
            "weight" => weight = whole(value, "a weight")?,
            other => {
                let problem = format!(
                    "`{}` is unknown; a sample has `x`, `y` and perhaps `weight`",
                    short(other)
                );
                return mistake(key.span(), problem);
            }
        }
    }
    match places {
        [Some(x), Some(y)] => Ok(CustomSample { place: [x, y], weight }),
        _ => mistake(value.span(), "a sample without its place; give it `x` and `y`"),
    }
}

/// A place along an axis, as the point of the lattice that it lies at or after.
fn point(value: &Value<'_>, grid: f64) -> Found<u8> {
    let number = match value.get_ref() {
        DeValue::Integer(number) if number.radix() == 10 => number.as_str().parse::<f64>().ok(),
        DeValue::Float(number) => number.as_str().parse().ok(),
        _ => None,
    };
    // Decimals such as 0.1 that are meant to lie at a point are not always the next number above it.
    let at = number.map(|number| (number / grid * LATTICE + 1e-9).floor());
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
    match at.filter(|at| (0.0..LATTICE).contains(at)) {
        Some(at) => Ok(at as u8),
        None => mistake(
            value.span(),
            format!("not a place in the pixel; give a number from 0 to below {grid}"),
        ),
    }
}

/// A whole number from 1 to 256.
fn whole(value: &Value<'_>, what: &str) -> Found<u32> {
    let number = match value.get_ref() {
        DeValue::Integer(number) if number.radix() == 10 => number.as_str().parse().ok(),
        _ => None,
    };
    match number.filter(|number| (1..=256).contains(number)) {
        Some(number) => Ok(number),
        None => mistake(
            value.span(),
            format!("{what} is a whole number from 1 to 256; write one"),
        ),
    }
}

/// A short string.
fn words(value: &Value<'_>) -> Found<String> {
    match value.get_ref().as_str() {
        Some(text) if text.len() <= LONGEST_WORDS => Ok(plain::line(text).into_owned()),
        Some(_) => mistake(value.span(), format!("longer than {LONGEST_WORDS} bytes; shorten it")),
        None => mistake(value.span(), "not a string; put it in quotes"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::SampleRate;
    use crate::viewer::settings::{Settings, picture};

    #[test]
    fn patterns_that_come_with_the_program_are_read() {
        assert_eq!(shipped_names(), DOCUMENTS.map(|(name, _)| name), "all of them");
        let rates: Vec<u32> = DOCUMENTS
            .iter()
            .map(|(name, document)| parse(document, name).expect(name).rate().samples())
            .collect();
        assert_eq!(rates, [2, 4, 8, 16], "as their names say");
        for pattern in shipped() {
            assert_eq!(value_of(*pattern), pattern.name(), "short");
            assert_eq!(named(pattern.name()), Some(*pattern), "by its name");
        }
        // Vulkan: (0.5625, 0.3125) is the first of 8.
        let SamplePattern::Custom(eight) = shipped()[2] else {
            panic!("a custom one");
        };
        assert_eq!(eight.samples()[0].place, [144, 80], "9/16 and 5/16");
    }

    #[test]
    fn own_pattern_stays_in_the_list() {
        let pattern = picture::find("pattern").expect("a setting");
        let own = "own:128/26+0/255x3";
        let mut settings = Settings::default();
        assert!(!pattern.offered(&settings).contains(&own.to_owned()), "unknown yet");
        for value in [own, "grid", "msaa-8"] {
            assert!(pattern.set(&mut settings, value), "{value}");
            assert_eq!(
                pattern.offered(&settings).last().map(String::as_str),
                Some(own),
                "beside {value}"
            );
        }
        let given = Settings::of(settings.render, settings.dialect);
        assert!(
            !pattern.offered(&given).contains(&own.to_owned()),
            "as a command line begins"
        );
        assert!(pattern.set(&mut settings, own), "once more");
        let given = Settings::of(settings.render, settings.dialect);
        assert_eq!(given.own_pattern, Some(settings.render.pattern), "named by it");
        // The key goes from the last pattern with as many samples to it, and on to the first.
        settings.render.sample_rate = SampleRate::new(4).expect("a rate");
        assert!(pattern.set(&mut settings, "msaa-4"), "4 samples, too");
        for next in [own, "grid"] {
            pattern.step(1.0).apply(&mut settings);
            assert_eq!(pattern.value(&settings), next, "in turn");
        }
    }

    #[test]
    fn patterns_of_files_are_written_out() {
        let read = parse(
            "name = \"own\"\nsamples = [{ x = 0.5, y = 0.1 }, { x = 0, y = 0.999, weight = 3 }]",
            "f",
        )
        .expect("a pattern");
        assert_eq!(value_of(SamplePattern::Custom(read)), "own:128/25+0/255x3", "in 1/256");
        assert_eq!(
            named("own:128/25+0/255x3"),
            Some(SamplePattern::Custom(read)),
            "the same"
        );
        assert_eq!(named("grid:1/1"), None, "a name of the program's own");
        assert_eq!(named("msaa-4:1/1"), None, "with other samples");
        let four = shipped()[1];
        assert_eq!(named("msaa-4:96/32+224/96+32/160+160/224"), Some(four), "with its own");
    }

    #[test]
    fn patterns_at_fault_are_told_with_their_place() {
        for (document, told) in [
            ("name =", "f:1:"),
            ("name = 3", "f:1:8: not a string"),
            ("name = \"a\"", "no samples"),
            ("samples = []", "no name"),
            ("name = \"\"\nsamples = [{ x = 0, y = 0 }]", "\"\" is not a name"),
            ("name = \"a b\"\nsamples = [{ x = 0, y = 0 }]", "\"a b\" is not a name"),
            (
                "name = \"a\"\nsamples = []",
                "f:2:11: 0 samples; a pattern has 1 to 256",
            ),
            ("name = \"a\"\nsamples = 3", "not a list"),
            ("name = \"a\"\nsamples = [1]", "a sample is a table"),
            ("name = \"a\"\nsamples = [{ x = 1, y = 0 }]", "f:2:18: not a place"),
            ("name = \"a\"\nsamples = [{ x = nan, y = 0 }]", "not a place"),
            ("name = \"a\"\nsamples = [{ x = -0.1, y = 0 }]", "not a place"),
            ("name = \"a\"\nsamples = [{ x = 0 }]", "without its place"),
            (
                "name = \"a\"\nsamples = [{ x = 0, y = 0, weight = 0 }]",
                "a weight is a whole number",
            ),
            (
                "name = \"a\"\nsamples = [{ x = 0, y = 0, weight = 256 }, { x = 0, y = 0 }]",
                "257 samples",
            ),
            ("name = \"a\"\nsamples = [{ x = 0, y = 0, z = 0 }]", "`z` is unknown"),
            ("name = \"a\"\ncolour = 3", "`colour` is unknown"),
        ] {
            let problem = parse(document, "f").expect_err(document);
            assert!(
                problem.contains(told) && !problem.contains('\n'),
                "{document}: {problem}"
            );
        }
    }
}
