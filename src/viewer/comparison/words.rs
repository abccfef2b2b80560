//! A and B in words: which settings differ, and what each of both is.

use super::super::Viewer;
use super::super::settings::{sample_words, settings_words, texture_words};
use super::Other;
use crate::color::ResolveSpace;
use crate::render::RenderSettings;

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
    pub(in super::super) fn own_words(&self) -> Vec<String> {
        let render = &self.settings.render;
        let mut words = vec![format!("sample rate {}", render.sample_rate.samples())];
        words.extend(sample_words(render));
        words.extend([
            format!("pixel sampling {}", render.pixel_sampling.name()),
            format!("level sampling {}", render.level_sampling.name()),
        ]);
        words.extend(texture_words(render));
        words
    }

    fn differing_settings(&self) -> Option<Vec<Differing>> {
        let mut words = differing(&self.settings.render, &self.other_settings()?);
        if let Some(dialect) = self.own_dialect_of_b() {
            let names = [self.settings.dialect, dialect].map(|dialect| dialect.name().to_owned());
            let [a, b] = names;
            words.push(("dialect", a, b));
        }
        Some(words)
    }
}

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
fn differing(a: &RenderSettings, b: &RenderSettings) -> Vec<Differing> {
    let (a, b) = (settings_words(a), settings_words(b));
    let unequal = a.into_iter().zip(b).filter(|(a, b)| a != b);
    unequal.map(|((name, a), (_, b))| (name, a, b)).collect()
}
