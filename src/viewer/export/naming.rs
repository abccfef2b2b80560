//! Names of screenshots: a template whose fields are filled in from the picture.

use crate::viewer::export::spec::PictureSpec;

/// The longest name without number and ending, in characters.
const MOST: usize = 120;

/// Names that are tried for one file: others may have been saved in the same millisecond.
const ATTEMPTS: u32 = 1000;

/// Names without ending for a new file, to be tried in turn: `stem`, then `stem-2` and so on.
pub(in crate::viewer) fn names_to_try(stem: &str) -> impl Iterator<Item = String> {
    let numbered = (2..=ATTEMPTS).map(move |number| format!("{stem}-{number}"));
    std::iter::once(stem.to_owned()).chain(numbered)
}

/// How screenshots are called, without the ending: words and fields such as `{scene}`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameTemplate(Vec<Part>);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Part {
    Words(String),
    Field(Field),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Field {
    Scene,
    Rate,
    Pixel,
    Level,
    Pattern,
    Time,
}

impl Field {
    const ALL: [(&'static str, Self); 6] = [
        ("scene", Self::Scene),
        ("rate", Self::Rate),
        ("pixel", Self::Pixel),
        ("level", Self::Level),
        ("pattern", Self::Pattern),
        ("time", Self::Time),
    ];

    fn value(self, spec: Option<&PictureSpec>, time: &str) -> String {
        let Some(spec) = spec.filter(|_| self != Self::Time) else {
            return if self == Self::Time {
                time.to_owned()
            } else {
                "none".to_owned()
            };
        };
        let render = &spec.render;
        match self {
            Self::Scene => {
                let address = spec.scene.address();
                let file = address.rsplit(['/', '\\', ':']).next().unwrap_or(&address);
                file.rsplit_once('.').map_or(file, |(stem, _)| stem).to_owned()
            }
            Self::Rate => render.sample_rate.samples().to_string(),
            Self::Pixel => render.pixel_sampling.name().to_owned(),
            Self::Level => render.level_sampling.name().to_owned(),
            Self::Pattern => render.pattern.name().to_owned(),
            Self::Time => time.to_owned(),
        }
    }
}

impl NameTemplate {
    /// Reads a template: fields in braces are `scene`, `rate`, `pixel`, `level`, `pattern` and `time`.
    ///
    /// # Errors
    /// One line when there is an unknown field, an open brace, nothing at all, or a folder in it.
    pub fn parse(text: &str) -> Result<Self, String> {
        let fields = || Field::ALL.map(|(name, _)| format!("{{{name}}}")).join(" ");
        if text.trim().is_empty() {
            return Err(format!(
                "a name is needed, such as {{scene}}-{{rate}}; fields are {}",
                fields()
            ));
        }
        if text.contains(['/', '\\']) {
            return Err("a name holds no folder; give the folder with --screenshot-dir".to_owned());
        }
        let (mut parts, mut rest) = (Vec::new(), text);
        while let Some((before, after)) = rest.split_once('{') {
            let Some((name, after)) = after.split_once('}') else {
                return Err(format!("`{{{after}` has no closing brace; fields are {}", fields()));
            };
            let known = Field::ALL.iter().find(|(known, _)| *known == name);
            let (_, field) = known.ok_or_else(|| format!("there is no field {{{name}}}; there are {}", fields()))?;
            parts.extend([Part::Words(before.to_owned()), Part::Field(*field)]);
            rest = after;
        }
        parts.push(Part::Words(rest.to_owned()));
        Ok(Self(parts))
    }

    /// The name of a picture that was taken at `time`; what no file system likes becomes `_`.
    pub(in crate::viewer) fn name(&self, spec: Option<&PictureSpec>, time: &str) -> String {
        let filled = self.0.iter().map(|part| match part {
            Part::Words(words) => words.clone(),
            Part::Field(field) => field.value(spec, time),
        });
        let harmless = |c: char| {
            if c.is_alphanumeric() || "-_.+, ()".contains(c) {
                c
            } else {
                '_'
            }
        };
        let name: String = filled.collect::<String>().chars().map(harmless).take(MOST).collect();
        // A leading dot would hide the file, and a trailing one or a space is lost on some systems.
        let name = name.trim_start_matches(['.', '-', ' ']).trim_end_matches(['.', ' ']);
        if name.is_empty() {
            "picture".to_owned()
        } else if is_device(name) {
            format!("_{name}")
        } else {
            name.to_owned()
        }
    }
}

/// Whether Windows takes a file of this name for a device, whatever its extension: a picture would be printed, or lost.
fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or(name).trim_end().to_ascii_uppercase();
    let numbered = |device: &str| {
        let mut number = stem.strip_prefix(device).unwrap_or_default().chars();
        number.next().is_some_and(|digit| "0123456789¹²³".contains(digit)) && number.next().is_none()
    };
    matches!(stem.as_str(), "CON" | "PRN" | "AUX" | "NUL") || numbered("COM") || numbered("LPT")
}

impl Default for NameTemplate {
    fn default() -> Self {
        Self(vec![Part::Words("rasterscope-".to_owned()), Part::Field(Field::Time)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::View;
    use crate::raster::SampleRate;
    use crate::render::RenderSettings;
    use crate::scene::DialectChoice;
    use crate::viewer::SceneSource;

    #[test]
    fn names_are_tried_as_they_are_and_then_by_number() {
        let names: Vec<String> = names_to_try("a.b").collect();
        assert_eq!(names[..3], ["a.b", "a.b-2", "a.b-3"], "a name may hold points");
        assert_eq!(names.last().map(String::as_str), Some("a.b-1000"), "and then no more");
    }

    #[test]
    fn names_are_filled_in_and_harmless() {
        let spec = PictureSpec {
            scene: SceneSource::File("some/where/te:st4.svg".into()),
            size: [4, 4],
            view: View::Default,
            render: RenderSettings {
                sample_rate: SampleRate::new(16).expect("a rate"),
                ..RenderSettings::default()
            },
            dialect: DialectChoice::Auto,
            insets: Vec::new(),
            legend: true,
        };
        let name = |text: &str| {
            NameTemplate::parse(text)
                .expect("a template")
                .name(Some(&spec), "10:30")
        };
        assert_eq!(
            name("{scene}-{rate}-{pixel}-{level}-{pattern}"),
            "st4-16-nearest-zero-grid",
            "settings"
        );
        assert_eq!(name("at {time}?"), "at 10_30_", "no colon, no question mark");
        assert_eq!(name("..-{rate}."), "16", "neither hidden nor an option");
        assert_eq!(name(". ."), "picture", "something at least");
        for device in ["con", "NUL.v2", "COM1", "lpt³.a"] {
            assert_eq!(name(device), format!("_{device}"), "no device of Windows");
        }
        for file in ["console", "COM", "COM12", "lpt-1"] {
            assert_eq!(name(file), file, "a file like any other");
        }
        assert_eq!(name(&"long ".repeat(100)).len(), 119, "not endless");
        assert_eq!(NameTemplate::default().name(None, "now"), "rasterscope-now", "as ever");
        let without = NameTemplate::parse("{scene}").expect("a template").name(None, "now");
        assert_eq!(without, "none", "without a scene");
    }

    #[test]
    fn names_at_fault_are_refused() {
        for (text, word) in [
            ("", "needed"),
            ("a/b", "folder"),
            ("{rat}", "{rat}"),
            ("{rate", "brace"),
            ("..\\x", "folder"),
        ] {
            let problem = NameTemplate::parse(text).expect_err("refused");
            assert!(problem.contains(word), "{text}: {problem}");
        }
    }
}
