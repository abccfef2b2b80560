//! The file of a lesson: TOML to steps. Settings have the names and the values of the command line's options. Every
//! mistake is told with line, column and cure.

use std::ops::Range;
use std::path::Path;

use glam::DVec2;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::plain;
use crate::viewer::ab::other::{Against, Arrangement};
use crate::viewer::lesson::markdown::blocks;
use crate::viewer::lesson::model::{Lesson, LessonError, LessonStep};
use crate::viewer::library::{SceneSource, gallery};
use crate::viewer::settings::document::{Found, Mistake, mistake, place, short};
use crate::viewer::settings::picture::SettingChange;
use crate::viewer::settings::values::{named, point, toggle};
use crate::viewer::settings::{Settings, Toggle, picture};
use crate::viewer::view::camera::ViewNumbers;

/// Most steps of a lesson.
const MOST_STEPS: usize = 200;

/// Longest text of a step, in bytes.
const LONGEST_TEXT: usize = 20_000;

/// Longest title, in bytes.
const LONGEST_TITLE: usize = 200;

/// Longest value of a setting, in bytes: a sample pattern of 256 samples that are written out.
const LONGEST_VALUE: usize = 4000;

/// The setting that not every pattern takes all values of.
const RATE: &str = "sample-rate";

/// The keys of a step besides settings.
const KEYS: [&str; 8] = [
    "title",
    "text",
    "scene",
    "view",
    "pin",
    "explanation",
    "against",
    "arrange",
];

/// The lesson in `document`, which is called `file`; scenes are found from `folder`, or in the gallery alone without one.
pub(in crate::viewer) fn parse(document: &str, file: &str, folder: Option<&Path>) -> Result<Lesson, LessonError> {
    let table = DeTable::parse(document).map_err(|error| Mistake {
        at: error.span().unwrap_or(0..0),
        problem: format!("not TOML: {}; see https://toml.io", error.message().replace('\n', " ")),
    });
    let lesson = table.and_then(|table| lesson(table.get_ref(), folder));
    lesson.map_err(|Mistake { at, problem }| LessonError {
        file: file.to_owned(),
        at: Some(place(document, at.start)),
        problem,
    })
}

impl Lesson {
    /// Reads the lesson in the TOML `document`, called `name` in messages. Its scenes are those of the gallery.
    ///
    /// # Errors
    /// For the first mistake, with its place.
    pub fn parse(document: &str, name: &str) -> Result<Self, LessonError> {
        parse(document, name, None)
    }
}

type Key<'i> = Spanned<DeString<'i>>;

type Value<'i> = Spanned<DeValue<'i>>;

fn lesson(table: &DeTable<'_>, folder: Option<&Path>) -> Found<Lesson> {
    let (mut title, mut steps) = (None, Vec::new());
    for (key, value) in table {
        match key.get_ref().as_ref() {
            "title" => title = Some(shown(value)?),
            "step" => steps = self::steps(value, folder)?,
            other => {
                let cure = "a lesson has a `title` and tables `[[step]]`";
                return mistake(key.span(), format!("`{}` is unknown; {cure}", short(other)));
            }
        }
    }
    match title {
        Some(_) if steps.is_empty() => mistake(0..0, "no step; add a table `[[step]]`"),
        Some(title) => Ok(Lesson { title, steps }),
        None => mistake(0..0, "no title; add `title = \"...\"` above the first step"),
    }
}

fn steps(value: &Value<'_>, folder: Option<&Path>) -> Found<Vec<LessonStep>> {
    let Some(tables) = value.get_ref().as_array() else {
        return mistake(
            value.span(),
            "`step` is not a list of tables; write `[[step]]` above each",
        );
    };
    let mut steps: Vec<LessonStep> = Vec::new();
    for value in tables {
        if steps.len() >= MOST_STEPS {
            return mistake(value.span(), format!("more than {MOST_STEPS} steps; split the lesson"));
        }
        let Some(table) = value.get_ref().as_table() else {
            return mistake(value.span(), "a step is a table; write `[[step]]` above it");
        };
        let before = steps.last().map(|step| step.scene.clone());
        steps.push(step(table, value.span(), before, folder)?);
    }
    Ok(steps)
}

/// One step; without a scene of its own it shows the one `before`.
fn step(
    table: &DeTable<'_>,
    at: Range<usize>,
    before: Option<SceneSource>,
    folder: Option<&Path>,
) -> Found<LessonStep> {
    let (mut scene, mut against, mut arrangement) = (before, None, None);
    let mut step = LessonStep {
        title: String::new(),
        text: Vec::new(),
        scene: SceneSource::Gallery(0),
        settings: Vec::new(),
        view: None,
        pin: None,
        explained: false,
        against: None,
    };
    for (key, value) in table {
        match key.get_ref().as_ref() {
            "title" => step.title = shown(value)?,
            "text" => step.text = blocks(&words(value, LONGEST_TEXT)?),
            "scene" => scene = Some(self::scene(value, folder)?),
            "view" => {
                step.view = match text(value)?.trim() {
                    "default" => None,
                    text => Some(of_form(value, ViewNumbers::parse(text), ViewNumbers::FORM)?),
                }
            }
            "pin" => step.pin = Some(pin(value)?),
            "explanation" => {
                let shown = toggle(text(value)?.trim());
                step.explained = of_form(value, shown, Toggle::FORM)? == Toggle::On;
            }
            "against" => against = Some((self::against(value, folder)?, value.span())),
            "arrange" => arrangement = Some((arrange(value)?, key.span())),
            name => step.settings.push(setting(name, (key, value), folder)?),
        }
    }
    check_rates(table, &step.settings, against.as_ref())?;
    let against = against.map(|(against, _)| against);
    step.against = match (against, arrangement) {
        (Some(against), Some((arrangement, _))) => Some((against, arrangement)),
        (Some(against), None) => Some((against, Arrangement::Wipe)),
        (None, Some((_, at))) => return mistake(at, "nothing to compare with; add `against`, such as \"truth\""),
        (None, None) => None,
    };
    match scene {
        Some(scene) => Ok(LessonStep { scene, ..step }),
        None => mistake(
            at,
            "no scene; add `scene = \"gallery:basic/test4.svg\"`, or a path from the lesson's folder",
        ),
    }
}

/// Refuses a sample rate that was written and that the pattern beside it does not take. A rate that nobody wrote becomes the
/// pattern's own.
fn check_rates(table: &DeTable<'_>, changes: &[SettingChange], against: Option<&(Against, Range<usize>)>) -> Found<()> {
    let mut settings = Settings::default();
    let refusal = picture::apply_all(changes, &mut settings);
    let written = table.get(RATE).map(Spanned::span);
    if let Some((refusal, at)) = refusal.zip(written.clone()) {
        return mistake(at, refusal);
    }
    let Some((Against::Changed(changes), at)) = against else {
        return Ok(());
    };
    let refusal = if changes.iter().any(|change| change.option() == RATE) {
        picture::apply_all(changes, &mut settings)
    } else {
        // The rate of A, which changes as soon as it is refused.
        let mut refusals = changes.iter().filter_map(|change| change.apply(&mut settings));
        refusals.next().filter(|_| written.is_some())
    };
    refusal.map_or(Ok(()), |refusal| mistake(at.clone(), refusal))
}

fn setting(name: &str, (key, value): (&Key<'_>, &Value<'_>), folder: Option<&Path>) -> Found<SettingChange> {
    let Some(setting) = picture::find(name) else {
        let options = picture::all().map(|setting| setting.option);
        let known: Vec<&str> = KEYS.into_iter().chain(options).collect();
        let problem = format!("`{}` is unknown; a step has {}", short(name), known.join(", "));
        return mistake(key.span(), problem);
    };
    let text = text(value)?;
    // Without a folder of its own a lesson reads no files.
    let read = folder.map_or(Ok(text.clone()), |folder| setting.read(&text, Some(folder)));
    meant(value, read.and_then(|text| setting.to(&text)))
}

/// A title.
fn shown(value: &Value<'_>) -> Found<String> {
    Ok(plain::line(&words(value, LONGEST_TITLE)?).into_owned())
}

/// What a value asks for, or its mistake in its place.
fn meant<T>(value: &Value<'_>, parsed: Result<T, String>) -> Found<T> {
    parsed.or_else(|problem| mistake(value.span(), format!("{}; write it as that", short(&problem))))
}

/// What was read, or the form that a value does not have.
fn of_form<T>(value: &Value<'_>, read: Option<T>, form: &str) -> Found<T> {
    match read {
        Some(read) => Ok(read),
        None => meant(value, Err(format!("\"{}\" is not {form}", text(value)?.trim()))),
    }
}

fn scene(value: &Value<'_>, folder: Option<&Path>) -> Found<SceneSource> {
    let address = words(value, LONGEST_TITLE * 10)?;
    let source = SceneSource::from_address(Path::new(&address));
    let missing = |cure: &str| mistake(value.span(), format!("{}: no such scene; {cure}", short(&address)));
    match (source, folder) {
        (SceneSource::Gallery(index), _) => Ok(SceneSource::Gallery(index)),
        (SceneSource::File(path), Some(folder)) if folder.join(&path).is_file() => {
            Ok(SceneSource::File(folder.join(path)))
        }
        (SceneSource::File(_), _) => match address.strip_prefix("gallery:") {
            Some(name) => missing(&gallery::cure(name)),
            None => missing("give a path from the lesson's folder, or gallery:NAME"),
        },
    }
}

fn pin(value: &Value<'_>) -> Found<DVec2> {
    match point(&text(value)?) {
        Some(place) => Ok(place),
        None => mistake(value.span(), "a pin is a place of the scene, \"X,Y\" in canvas units"),
    }
}

fn against(value: &Value<'_>, folder: Option<&Path>) -> Found<Against> {
    let text = text(value)?;
    let read = folder.map_or(Ok(text.clone()), |folder| picture::read_files(&text, Some(folder)));
    match Against::from_text(&meant(value, read)?) {
        Some(against @ (Against::Truth(_) | Against::Changed(_))) => Ok(against),
        _ => mistake(
            value.span(),
            "compare with \"truth\", or with settings such as \"sample-rate 16, level-sampling linear\"",
        ),
    }
}

fn arrange(value: &Value<'_>) -> Found<Arrangement> {
    let arrangement = named(&Arrangement::ALL, Arrangement::name, text(value)?.trim());
    of_form(value, arrangement, Arrangement::FORM)
}

/// A string that is not longer than this many bytes.
fn words(value: &Value<'_>, most: usize) -> Found<String> {
    match value.get_ref().as_str() {
        Some(text) if text.len() > most => mistake(
            value.span(),
            format!("longer than {most} bytes; shorten it or split the step"),
        ),
        Some(text) => Ok(text.to_owned()),
        None => mistake(value.span(), "not a string; put it in quotes"),
    }
}

/// A value as it would stand on the command line.
fn text(value: &Value<'_>) -> Found<String> {
    match value.get_ref() {
        DeValue::String(text) if text.len() <= LONGEST_VALUE => Ok(text.to_string()),
        DeValue::Integer(number) if number.radix() == 10 => Ok(number.as_str().to_owned()),
        DeValue::Float(number) => Ok(number.as_str().to_owned()),
        DeValue::Boolean(true) => Ok("on".to_owned()),
        DeValue::Boolean(false) => Ok("off".to_owned()),
        _ => mistake(
            value.span(),
            "not a value of an option; write it as on the command line, in quotes",
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(document: &str) -> Result<Lesson, String> {
        parse(document, "lesson.toml", None).map_err(|error| error.to_string())
    }

    #[test]
    fn lessons_are_steps_with_settings_of_the_command_line() {
        let document = r#"
            title = "Two steps"
            [[step]]
            title = "One"
            scene = "gallery:basic/test4.svg"
            sample-rate = 16
            lod-bias = -1.5
            background = "white"
            view = "10,20,2.5,90"
            pin = "3,4.5"
            explanation = true
            text = "Look **here**."
            [[step]]
            against = "sample-rate 4, dialect svg"
            arrange = "side"
        "#;
        let lesson = read(document).expect("a good one");
        assert_eq!((lesson.title.as_str(), lesson.steps.len()), ("Two steps", 2));
        let [first, second] = lesson.steps.as_slice() else {
            panic!("{lesson:?}")
        };
        assert_eq!(first.settings.len(), 3, "{:?}", first.settings);
        let rate = SettingChange::of("sample-rate", "16").expect("a square number");
        assert!(first.settings.contains(&rate), "{:?}", first.settings);
        assert_eq!(first.view.map(|view| view.rotation), Some(90.0), "the view");
        assert_eq!(
            (first.pin, first.explained),
            (Some(DVec2::new(3.0, 4.5)), true),
            "the pin"
        );
        assert_eq!(first.text.len(), 1, "a paragraph");
        assert_eq!(second.scene, first.scene, "the scene before");
        let (against, arrangement) = second.against.clone().expect("a comparison");
        assert_eq!(arrangement, Arrangement::SideBySide);
        assert!(
            matches!(against, Against::Changed(changes) if changes.len() == 2),
            "B's settings"
        );
    }

    #[test]
    fn lessons_at_fault_are_told_the_place_and_the_cure() {
        let step = |line: &str| format!("title = \"T\"\n[[step]]\nscene = \"gallery:basic/test4.svg\"\n{line}\n");
        let long = "x".repeat(LONGEST_TEXT + 1);
        for (document, place, word) in [
            (String::new(), "1:1", "title"),
            ("title = \"T\"".to_owned(), "1:1", "[[step]]"),
            ("title = ".to_owned(), "1:", "not TOML"),
            ("title = \"T\"\ncolour = 3".to_owned(), "2:1", "`colour` is unknown"),
            ("title = 3".to_owned(), "1:9", "quotes"),
            ("title = \"T\"\nstep = 3".to_owned(), "2:8", "[[step]]"),
            ("title = \"T\"\n[[step]]\n".to_owned(), "2:1", "no scene"),
            (step("samplerate = 4"), "4:1", "sample-rate"),
            (step("sample-rate = 257"), "4:15", "1 to 256"),
            (step("sample-rate = 0x10"), "4:15", "command line"),
            (
                step("sample-rate = 3"),
                "4:15",
                "takes a square number of samples, not 3",
            ),
            (
                step("pattern = \"msaa-8\"\nsample-rate = 4"),
                "5:15",
                "msaa-8 takes 8 samples, not 4",
            ),
            (step("against = \"sample-rate 3\""), "4:11", "not 3"),
            (
                step("sample-rate = 5\npattern = \"sobol\"\nagainst = \"pattern grid\""),
                "6:11",
                "not 5",
            ),
            (step("sample-rate = [4]"), "4:15", "command line"),
            (step("pattern = \"poisson\""), "4:11", "grid|rotated"),
            (step("view = \"1,2\""), "4:8", "X,Y,SCALE"),
            (step("pin = \"1\""), "4:7", "canvas units"),
            (step("pin = \"nan,0\""), "4:7", "canvas units"),
            (step("arrange = \"wipe\""), "4:1", "against"),
            (step("against = \"/etc/passwd\""), "4:11", "truth"),
            (step("sample-rate = 4\nsample-rate = 9"), "5:1", "not TOML"),
            (step(&format!("text = \"{long}\"")), "4:8", "longer"),
            (
                "title = \"T\"\n[[step]]\nscene = \"gallery:nowhere.svg\"".to_owned(),
                "3:9",
                "no such scene",
            ),
            (
                "title = \"T\"\n[[step]]\nscene = \"a.svg\"".to_owned(),
                "3:9",
                "no such scene",
            ),
        ] {
            let problem = read(&document).expect_err(&document);
            assert!(
                problem.starts_with(&format!("lesson.toml:{place}")),
                "{document}: {problem}"
            );
            assert!(
                problem.contains(word) && !problem.contains('\n'),
                "{document}: {problem}"
            );
        }
    }

    #[test]
    fn rates_that_nobody_wrote_are_the_pattern_s() {
        for line in [
            "pattern = \"msaa-8\"",
            "against = \"pattern msaa-8\"",
            "sample-rate = 5\npattern = \"sobol\"",
            "sample-rate = 5\npattern = \"sobol\"\nagainst = \"pattern grid, sample-rate 4\"",
        ] {
            let document = format!("title = \"T\"\n[[step]]\nscene = \"gallery:basic/test4.svg\"\n{line}\n");
            assert_eq!(read(&document).map(|lesson| lesson.steps.len()), Ok(1), "{line}");
        }
    }

    #[test]
    fn lessons_of_hostile_make_end_soon() {
        let deep = format!("title = \"T\"\nstep = {}", "[".repeat(100_000));
        assert!(read(&deep).is_err(), "however deep");
        let many =
            "title = \"T\"\n".to_owned() + &"[[step]]\nscene = \"gallery:basic/test4.svg\"\n".repeat(MOST_STEPS + 1);
        let problem = read(&many).expect_err("too many");
        assert!(problem.contains("200 steps"), "{problem}");
        let keys = "title = \"T\"\n[[step]]\n".to_owned() + &"a.".repeat(50_000) + "b = 1";
        assert!(read(&keys).is_err(), "however long a key");
    }

    #[test]
    fn limits_are_those_of_the_help_page() {
        let page = include_str!("../../cli/help/lessons.md").replace('\n', " ");
        let line = format!("at most {MOST_STEPS} steps, and a step at most {LONGEST_TEXT} bytes of text");
        assert!(page.contains(&line), "{line}");
    }

    #[test]
    fn built_in_lessons_are_whole() {
        for (index, (name, _)) in crate::viewer::BUILT_IN.iter().enumerate() {
            let lesson = crate::viewer::LessonSource::BuiltIn(index).read();
            let lesson = lesson.unwrap_or_else(|error| panic!("{error}"));
            for step in &lesson.steps {
                assert!(
                    !step.title.is_empty() && !step.text.is_empty(),
                    "{name}: {}",
                    step.title
                );
            }
        }
    }
}
