//! What is fuzzed: every way by which a stranger's bytes enter the program, each as a function of those bytes.
//!
//! libFuzzer calls these functions through `fuzz_targets`, and the test suite calls them with mutated seeds, so both hold
//! the same promises. A target fails by a panic; time and memory are watched by the caller.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use rasterscope::cli::{GRAMMAR, check_pins};
use rasterscope::figure::Record;
use rasterscope::geometry::View;
use rasterscope::inspect::{Detail, Explanation, Question};
use rasterscope::raster::{CustomPattern, Framebuffer};
use rasterscope::render::{self, RenderSettings, Subject, Visualisation};
use rasterscope::scene::{self, DialectChoice, NoResources, ReadOptions, Scene};
use rasterscope::texture::Texture;
use rasterscope::viewer::script::Script;
use rasterscope::viewer::{Lesson, Settings, patterns, picture};

/// Width and height of the pictures that are drawn, in pixels.
const SIZE: [u32; 2] = [24, 20];
/// Longest message, in characters.
const LONGEST_LINE: usize = 1000;

/// One way into the program.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    /// Its name, which is that of its file in `fuzz_targets`.
    pub(crate) name: &'static str,
    /// Takes the bytes in.
    pub(crate) run: fn(&[u8]),
    /// Files and folders of the repository that hold inputs to begin with.
    pub(crate) seeds: &'static [&'static str],
}

/// All of them.
pub(crate) const TARGETS: [Target; 8] = [
    Target {
        name: "scene",
        run: scene,
        seeds: &[
            "tests/broken",
            "svg/basic",
            "svg/hardcore",
            "svg/texmap",
            "fuzz/seeds/scene",
        ],
    },
    Target {
        name: "image",
        run: image,
        seeds: &["fuzz/seeds/image"],
    },
    Target {
        name: "record",
        run: record,
        seeds: &["fuzz/seeds/record"],
    },
    Target {
        name: "lesson",
        run: lesson,
        seeds: &["assets/lessons"],
    },
    Target {
        name: "pattern",
        run: pattern,
        seeds: &["assets/patterns", "fuzz/seeds/pattern"],
    },
    Target {
        name: "script",
        run: script,
        seeds: &["fuzz/seeds/script"],
    },
    Target {
        name: "pins",
        run: pins,
        seeds: &["fuzz/seeds/pins"],
    },
    Target {
        name: "arguments",
        run: arguments,
        seeds: &["fuzz/seeds/arguments"],
    },
];

impl Target {
    /// The seeds, in the order of their names.
    pub(crate) fn inputs(&self) -> Vec<Vec<u8>> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut paths: Vec<PathBuf> = Vec::new();
        for folder in self.seeds {
            let entries = fs::read_dir(root.join(folder)).unwrap_or_else(|error| panic!("{folder}: {error}"));
            paths.extend(entries.map(|entry| entry.expect("an entry of a folder of seeds").path()));
        }
        paths.sort();
        let read = |path: PathBuf| fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        paths.into_iter().filter(|path| path.is_file()).map(read).collect()
    }
}

/// A document: read in every dialect, drawn, and explained at a pixel, which must be the frame's.
pub(crate) fn scene(bytes: &[u8]) {
    let mut choices = Choices::of(bytes);
    let settings = choices.settings();
    for dialect in DialectChoice::ALL {
        match scene::read(bytes, "fuzz.svg", ReadOptions { dialect }, &NoResources) {
            Ok(scene) => {
                scene.report.lines().for_each(|line| one_line(&line));
                let pixel = [choices.below(SIZE[0]), choices.below(SIZE[1])];
                explain(&scene, &settings, pixel);
            }
            Err(error) => one_line(&error.to_string()),
        }
    }
}

fn explain(scene: &Scene, settings: &RenderSettings, pixel: [u32; 2]) {
    let view = View::Default.transform(scene.canvas, SIZE);
    let draw = |settings: &RenderSettings| {
        let mut frame = Framebuffer::new(SIZE[0], SIZE[1]);
        render::draw(scene, &view, settings, &mut frame);
        frame
    };
    let mut frame = draw(settings);
    // Of a visualisation no more is asked than that it is drawn: explanations are about colours.
    let shown = &RenderSettings {
        visualisation: Visualisation::Color,
        ..*settings
    };
    if settings.visualisation != Visualisation::Color {
        frame = draw(shown);
    }
    let subject = Subject {
        scene,
        view: &view,
        settings: shown,
    };
    let explanation = Explanation::advised(&Question {
        subject,
        file: "fuzz.svg",
        size: SIZE,
        pixel,
    });
    let explanation = explanation.expect("a pixel of the frame");
    let [a, r, g, b] = frame.pixels()[(pixel[1] * SIZE[0] + pixel[0]) as usize].to_be_bytes();
    assert_eq!(
        explanation.color,
        [r, g, b, a],
        "the explanation at {pixel:?} is the frame's pixel, under {shown:?}"
    );
    assert!(
        !explanation.text(Detail::Sample(0)).is_empty(),
        "an explanation in words"
    );
    serde_json::to_string(&explanation).expect("an explanation in JSON");
}

/// A PNG or JPEG, as a texture.
pub(crate) fn image(bytes: &[u8]) {
    let opaque = Texture::decode_opaque("fuzz", bytes).map(|(texture, _)| texture);
    for decoded in [Texture::decode("fuzz", bytes), opaque] {
        match decoded {
            Ok(texture) => assert!(!texture.pyramid.levels().is_empty(), "a texture has a level"),
            Err(error) => one_line(&error.to_string()),
        }
    }
}

/// The record of a picture: in a PNG file, and as the words of its command line.
pub(crate) fn record(bytes: &[u8]) {
    match Record::read(&mut Cursor::new(bytes)) {
        Ok(Some(record)) => {
            if let Err(problem) = (GRAMMAR.picture)(&record) {
                one_line(&problem);
            }
        }
        Ok(None) => {}
        Err(error) => one_line(&error.to_string()),
    }
}

/// A lesson in TOML.
pub(crate) fn lesson(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match Lesson::parse(text, "fuzz.toml") {
        Ok(lesson) => assert!(!lesson.steps.is_empty(), "a lesson has a step"),
        Err(error) => one_line(&error.to_string()),
    }
}

/// A sample pattern in TOML, and the text that records have of it.
pub(crate) fn pattern(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match patterns::parse(text, "fuzz.toml") {
        Ok(pattern) => {
            let again = CustomPattern::parse(&pattern.to_string());
            assert_eq!(again, Some(pattern), "a record has the same samples");
        }
        Err(problem) => one_line(&problem),
    }
    let _ = patterns::named(text);
}

/// A script. It is read and not played, because its commands may save files.
pub(crate) fn script(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    if let Err(error) = Script::parse(text, "fuzz") {
        one_line(&error.to_string());
    }
}

/// The pins of a write-up in TOML.
pub(crate) fn pins(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    if let Err(problem) = check_pins(text) {
        one_line(&problem);
    }
}

/// The words of a command line, one a line.
pub(crate) fn arguments(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let words: Vec<String> = text.lines().map(str::to_owned).collect();
    let record = Record {
        arguments: words.clone(),
        ..Record::default()
    };
    let problems = [(GRAMMAR.picture)(&record).err(), (GRAMMAR.sheet)(&words).err()];
    problems.iter().flatten().for_each(|problem| one_line(problem));
}

/// Control characters are escaped where a message is printed, so only breaks of lines count here.
fn one_line(message: &str) {
    let short = message.chars().count() <= LONGEST_LINE;
    assert!(
        short && !message.trim_end().contains(['\n', '\r']),
        "a message is one short line: {message:?}"
    );
}

/// Settings that follow from the input, so that the seeds are files as people have them.
struct Choices(u64);

impl Choices {
    /// FNV-1a over the bytes (Fowler, Noll, Vo).
    fn of(bytes: &[u8]) -> Self {
        let mix = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3);
        Self(bytes.iter().fold(0xcbf2_9ce4_8422_2325, mix))
    }

    /// A number below `end`, which is above zero.
    fn below(&mut self, end: u32) -> u32 {
        // A step of Knuth's MMIX generator; its high bits are the good ones.
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        u32::try_from((self.0 >> 33) % u64::from(end)).unwrap_or(0)
    }

    fn among<T: Copy>(&mut self, choices: &[T]) -> T {
        let count = u32::try_from(choices.len()).expect("a short list");
        choices[self.below(count) as usize]
    }

    /// One of the few values of every setting in the table, so that a new setting is tried without a word here.
    fn settings(&mut self) -> RenderSettings {
        let mut settings = Settings::default();
        for setting in picture::all() {
            let value = self.among(&setting.some_values());
            let change = setting
                .to(value)
                .unwrap_or_else(|problem| panic!("{}: {problem}", setting.option));
            change.apply(&mut settings);
        }
        settings.render
    }
}
