//! A and B in words: which settings differ, and what each of both is.

use super::super::Viewer;
use super::super::settings::settings_words;
use super::Other;
use crate::render::RenderSettings;

impl Other {
    /// What it is, in few words.
    pub fn name(&self) -> &str {
        match self {
            Self::Settings(_) => "other settings",
        }
    }
}

impl Viewer {
    /// Which settings of A and B differ, in words such as `sample rate 1 | 16`; `None` without B.
    pub fn comparison_words(&self) -> Option<Vec<String>> {
        let words = self.differing_settings()?.into_iter();
        Some(words.map(|(name, a, b)| format!("{name} {a} | {b}")).collect())
    }

    /// A against B in one line, for the window's title; `None` without B.
    pub fn comparison_title(&self) -> Option<String> {
        let words = self.comparison_words()?;
        if words.is_empty() {
            return Some("A against B: the same settings".to_owned());
        }
        Some(format!("A against B: {}", words.join(", ")))
    }

    /// What A is and what B is, each for itself, such as `A: sample rate 16`; `None` without B.
    pub fn comparison_sides(&self) -> Option<[String; 2]> {
        let differing = self.differing_settings()?;
        let a: Vec<String> = differing.iter().map(|(name, a, _)| format!("{name} {a}")).collect();
        let b: Vec<String> = differing.iter().map(|(name, _, b)| format!("{name} {b}")).collect();
        if differing.is_empty() {
            return Some(["A", "B"].map(str::to_owned));
        }
        Some([format!("A: {}", a.join(", ")), format!("B: {}", b.join(", "))])
    }

    fn differing_settings(&self) -> Option<Vec<Differing>> {
        Some(differing(&self.settings.render, &self.other_settings()?))
    }
}

/// A setting by its name, its value in A, its value in B.
type Differing = (&'static str, String, String);

/// What differs.
fn differing(a: &RenderSettings, b: &RenderSettings) -> Vec<Differing> {
    let (a, b) = (settings_words(a), settings_words(b));
    let unequal = a.into_iter().zip(b).filter(|(a, b)| a != b);
    unequal.map(|((name, a), (_, b))| (name, a, b)).collect()
}
