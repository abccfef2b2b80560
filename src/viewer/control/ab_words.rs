//! A and B in words: which settings differ, and what each of both is.

use crate::color::ResolveSpace;
use crate::viewer::ab::other::Other;
use crate::viewer::settings::picture::{About, told_words};
use crate::viewer::settings::{Settings, picture};
use crate::viewer::state::Viewer;

/// What the truth is.
fn truth_words(resolve: ResolveSpace) -> String {
    let values = match resolve {
        ResolveSpace::Stored => "stored values",
        ResolveSpace::Linear => "linear light",
    };
    format!("B: the truth, 256 samples in {values}")
}

/// A setting by its name, its value in A, its value in B.
type Differing = (&'static str, String, String);

/// What differs.
fn differing(a: &Settings, b: &Settings) -> Vec<Differing> {
    let unequal = picture::all()
        .iter()
        .filter(|setting| setting.value(a) != setting.value(b));
    unequal
        .map(|setting| (setting.label, setting.shown(a), setting.shown(b)))
        .collect()
}

impl Viewer {
    /// Which settings of A and B differ, in words such as `sample rate 1 | 16`; `None` without B, and for a picture from
    /// outside, whose settings nobody knows.
    pub fn comparison_words(&self) -> Option<Vec<String>> {
        let words = self.differing_settings()?.into_iter();
        Some(words.map(|(name, a, b)| format!("{name} {a} | {b}")).collect())
    }

    /// A against B in one line, for the window's title; `None` without B.
    pub fn comparison_title(&self) -> Option<String> {
        let other = match self.other()? {
            Other::Settings { .. } => "B".to_owned(),
            Other::Truth(_) => "the truth".to_owned(),
            Other::Picture(picture) => picture.name(),
        };
        let words = match self.comparison_words() {
            Some(words) if words.is_empty() => vec!["the same settings".to_owned()],
            Some(words) => words,
            None => self.own_words(),
        };
        Some(format!("A against {other}: {}", words.join(", ")))
    }

    /// What A is and what B is, each for itself, such as `A: sample rate 16`; `None` without B.
    pub fn comparison_sides(&self) -> Option<[String; 2]> {
        let differing = self.differing_settings().unwrap_or_default();
        let a: Vec<String> = differing.iter().map(|(name, a, _)| format!("{name} {a}")).collect();
        let b: Vec<String> = differing.iter().map(|(name, _, b)| format!("{name} {b}")).collect();
        let a = match self.other()? {
            Other::Picture(_) => "A: drawn here".to_owned(),
            _ if a.is_empty() => "A".to_owned(),
            _ => format!("A: {}", a.join(", ")),
        };
        let b = match self.other()? {
            Other::Settings { .. } if b.is_empty() => "B".to_owned(),
            Other::Settings { .. } => format!("B: {}", b.join(", ")),
            Other::Truth(resolve) => truth_words(resolve.unwrap_or(self.settings.render.resolve)),
            Other::Picture(picture) => format!("B: {}", picture.name()),
        };
        Some([a, b])
    }

    /// A's settings as the title tells them.
    pub(in crate::viewer) fn own_words(&self) -> Vec<String> {
        [About::Samples, About::Textures]
            .into_iter()
            .flat_map(|about| told_words(&self.settings, about))
            .collect()
    }

    fn differing_settings(&self) -> Option<Vec<Differing>> {
        let other = Settings {
            render: self.other_settings()?,
            dialect: self.own_dialect_of_b().unwrap_or(self.settings.dialect),
            ..self.settings
        };
        Some(differing(&self.settings, &other))
    }
}
