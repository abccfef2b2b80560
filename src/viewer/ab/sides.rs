//! What B is beside A: its settings and dialect, and in words which settings differ.

use crate::color::ResolveSpace;
use crate::render::RenderSettings;
use crate::scene::DialectChoice;
use crate::viewer::ab::comparison::Comparison;
use crate::viewer::ab::other::{Arrangement, Other};
use crate::viewer::library::dialects::WantedDialects;
use crate::viewer::settings::{Settings, picture};

/// What the truth is whose samples are averaged so.
pub(in crate::viewer) fn truth_words(resolve: ResolveSpace) -> String {
    let values = match resolve {
        ResolveSpace::Stored => "stored values",
        ResolveSpace::Linear => "linear light",
    };
    format!("256 samples in {values}")
}

/// A setting by its name, its value in A, its value in B.
type Differing = (&'static str, String, String);

/// What differs.
fn differing(a: &Settings, b: &Settings) -> Vec<Differing> {
    let unequal = picture::all().filter(|setting| setting.value(a) != setting.value(b));
    unequal
        .map(|setting| (setting.label, setting.shown(a), setting.shown(b)))
        .collect()
}

/// Whose picture fills the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) enum Filling {
    A,
    B,
    /// B, which is a picture from outside.
    Outside,
    /// Both share it, or their difference does.
    Shared,
}

impl Comparison {
    /// Whose picture fills the frame at this moment.
    pub(in crate::viewer) fn filling(&self) -> Filling {
        match (self.arrangement(), self.other()) {
            (Arrangement::Wipe | Arrangement::SideBySide | Arrangement::Difference, _) => Filling::Shared,
            (Arrangement::Alone | Arrangement::Flip, Some(other)) if self.shows_both() && self.shows_b() => match other
            {
                Other::Picture(_) => Filling::Outside,
                Other::Settings { .. } | Other::Truth(_) => Filling::B,
            },
            (Arrangement::Alone | Arrangement::Flip, _) => Filling::A,
        }
    }

    /// B's settings, where it is drawn; `own` are A's.
    pub fn other_settings(&self, own: &Settings) -> Option<RenderSettings> {
        match self.other()? {
            Other::Settings { render, .. } => Some(*render),
            Other::Truth(_) => Some(own.render.truth_in(self.truth_space())),
            Other::Picture(_) => None,
        }
    }

    /// In which values the truth is averaged, where not in those of A: as B was chosen, if that is the truth, or as it was
    /// chosen for every truth.
    pub fn truth_space(&self) -> Option<ResolveSpace> {
        let of_b = match self.other() {
            Some(Other::Truth(space)) => *space,
            _ => None,
        };
        of_b.or(self.truth_space)
    }

    /// The dialect that B's scene is read in, where that is not A's.
    pub fn own_dialect_of_b(&self, own: &Settings) -> Option<DialectChoice> {
        match self.other()? {
            Other::Settings { dialect, .. } => Some(*dialect).filter(|dialect| *dialect != own.dialect),
            Other::Truth(_) | Other::Picture(_) => None,
        }
    }

    /// In which dialects A and B are to be read.
    pub(in crate::viewer) fn wanted_dialects(&self, own: &Settings) -> WantedDialects {
        WantedDialects {
            own: own.dialect,
            other: self.own_dialect_of_b(own),
        }
    }

    /// Which settings of A and B differ, in words such as `sample rate 1 | 16`; `None` without B, and for a picture from
    /// outside, whose settings nobody knows.
    pub fn words(&self, own: &Settings) -> Option<Vec<String>> {
        let words = self.differing_settings(own)?.into_iter();
        Some(words.map(|(name, a, b)| format!("{name} {a} | {b}")).collect())
    }

    /// A against B in one line, for the window's title; `None` without B.
    pub(in crate::viewer) fn title(&self, own: &Settings) -> Option<String> {
        let other = match self.other()? {
            Other::Settings { .. } => "B".to_owned(),
            Other::Truth(_) => "the truth".to_owned(),
            Other::Picture(picture) => picture.name(),
        };
        let words = match self.words(own) {
            Some(words) if words.is_empty() => vec!["the same settings".to_owned()],
            Some(words) => words,
            None => picture::title_words(own),
        };
        Some(format!("A against {other}: {}", words.join(", ")))
    }

    /// What A is and what B is, each for itself, such as `A: sample rate 16`; `None` without B.
    pub fn sides(&self, own: &Settings) -> Option<[String; 2]> {
        let differing = self.differing_settings(own).unwrap_or_default();
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
            Other::Truth(_) => {
                let space = self.truth_space().unwrap_or(own.render.resolve);
                format!("B: the truth, {}", truth_words(space))
            }
            Other::Picture(picture) => format!("B: {}", picture.name()),
        };
        Some([a, b])
    }

    fn differing_settings(&self, own: &Settings) -> Option<Vec<Differing>> {
        let other = Settings {
            render: self.other_settings(own)?,
            dialect: self.own_dialect_of_b(own).unwrap_or(own.dialect),
            ..*own
        };
        Some(differing(own, &other))
    }
}
