//! What B is beside A: its settings and dialect, and in words which settings differ.

use crate::color::ResolveSpace;
use crate::render::RenderSettings;
use crate::scene::{DialectChoice, Scene};
use crate::viewer::ab::comparison::Comparison;
use crate::viewer::ab::other::{Arrangement, Other};
use crate::viewer::library::dialects::WantedDialects;
use crate::viewer::settings::picture::NO_EFFECT;
use crate::viewer::settings::{Settings, picture};

/// What the truth is whose samples are averaged so.
pub(in crate::viewer) fn truth_words(resolve: ResolveSpace) -> String {
    let values = match resolve {
        ResolveSpace::Stored => "stored values",
        ResolveSpace::Linear => "linear light",
    };
    format!("256 samples in {values}")
}

/// A setting whose value in A is not that in B.
struct Differing {
    name: &'static str,
    /// What is told of A, and of B: nothing where the value has no effect.
    told: [Option<String>; 2],
}

impl Differing {
    /// Such as `sample rate 1 | 16`, with a dash where there is nothing to tell.
    fn words(&self) -> String {
        let [a, b] = self.told.each_ref().map(|told| told.as_deref().unwrap_or("\u{2013}"));
        format!("{} {a} | {b}", self.name)
    }
}

/// What differs; values without effect are told only where nothing else is.
fn differing(a: &Settings, b: &Settings) -> Vec<Differing> {
    let unequal = || picture::all().filter(|setting| setting.value(a) != setting.value(b));
    let counting = unequal().map(|setting| Differing {
        name: setting.label,
        told: [a, b].map(|side| setting.idle(side, None).is_none().then(|| setting.shown(side))),
    });
    let counting: Vec<Differing> = counting
        .filter(|differing| differing.told.iter().any(Option::is_some))
        .collect();
    if !counting.is_empty() {
        return counting;
    }
    let idle = unequal().map(|setting| Differing {
        name: setting.label,
        told: [a, b].map(|side| Some(format!("{} {NO_EFFECT}", setting.shown(side)))),
    });
    idle.collect()
}

/// What is told of one side.
fn words_of(side: usize, differing: &[Differing]) -> String {
    let words = differing
        .iter()
        .filter_map(|setting| Some(format!("{} {}", setting.name, setting.told[side].as_ref()?)));
    words.collect::<Vec<_>>().join(", ")
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

    /// The key that brings A into sight, where B fills the frame until somebody presses it.
    pub(in crate::viewer) fn key_to_a(&self) -> Option<&'static str> {
        match (self.filling(), self.flip) {
            (Filling::A | Filling::Shared, _) | (_, Some((Some(_), _))) => None,
            (Filling::B | Filling::Outside, Some((None, _))) => Some("B"),
            (Filling::B | Filling::Outside, None) => Some("R"),
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

    /// Which settings of A and B differ, in words such as `sample rate 1 | 16`, but for those without effect in both; `None`
    /// without B, and for a picture from outside, whose settings nobody knows.
    pub fn words(&self, own: &Settings) -> Option<Vec<String>> {
        Some(self.differing_settings(own)?.iter().map(Differing::words).collect())
    }

    /// What A and B share that is not at its default and has an effect, such as `sample rate 4`; `None` where that is nothing, and
    /// where B's settings are not known or are the truth's, which no picture shares.
    pub fn shared_words(&self, own: &Settings) -> Option<String> {
        let Other::Settings { .. } = self.other()? else {
            return None;
        };
        let b = self.settings_of_b(own)?;
        let shared = picture::all().filter(|setting| {
            let is_told = !setting.is_default(own) && setting.value(own) == setting.value(&b);
            is_told && [own, &b].iter().any(|side| setting.idle(side, None).is_none())
        });
        let words: Vec<String> = shared.map(|setting| setting.words(own)).collect();
        (!words.is_empty()).then(|| words.join(", "))
    }

    /// A against B in one line, for the window's title; `None` without B.
    pub(in crate::viewer) fn title(&self, own: &Settings, scene: Option<&Scene>) -> Option<String> {
        let other = match self.other()? {
            Other::Settings { .. } => "B".to_owned(),
            Other::Truth(_) => "the truth".to_owned(),
            Other::Picture(picture) => picture.name(),
        };
        let words = match self.words(own) {
            Some(words) if words.is_empty() => vec!["the same settings".to_owned()],
            Some(words) => words,
            None => picture::title_words(own, scene),
        };
        Some(format!("A against {other}: {}", words.join(", ")))
    }

    /// What A is and what B is, each for itself, such as `A: sample rate 16`; `None` without B.
    pub fn sides(&self, own: &Settings) -> Option<[String; 2]> {
        let differing = self.differing_settings(own).unwrap_or_default();
        let [a, b] = [0, 1].map(|side| words_of(side, &differing));
        let a = match self.other()? {
            Other::Picture(_) => "A: drawn here".to_owned(),
            _ if a.is_empty() => "A".to_owned(),
            _ => format!("A: {a}"),
        };
        let b = match self.other()? {
            Other::Settings { .. } if b.is_empty() => "B".to_owned(),
            Other::Settings { .. } => format!("B: {b}"),
            Other::Truth(_) => {
                let space = self.truth_space().unwrap_or(own.render.resolve);
                // A's pattern stands beside it, where that is another.
                let pattern = own.render.truth().pattern.name();
                format!("B: the truth, {}, pattern {pattern}", truth_words(space))
            }
            Other::Picture(picture) => format!("B: {}", picture.name()),
        };
        Some([a, b])
    }

    fn differing_settings(&self, own: &Settings) -> Option<Vec<Differing>> {
        Some(differing(own, &self.settings_of_b(own)?))
    }

    /// The settings of B, where it is drawn.
    fn settings_of_b(&self, own: &Settings) -> Option<Settings> {
        Some(Settings {
            render: self.other_settings(own)?,
            dialect: self.own_dialect_of_b(own).unwrap_or(own.dialect),
            ..*own
        })
    }
}
