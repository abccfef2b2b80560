//! What stands on a board: whole settings, and in words what tells them apart.

use std::cmp::Reverse;
use std::collections::HashSet;

use crate::render::RenderSettings;
use crate::scene::DialectChoice;
use crate::viewer::export::sheet::axes::Axis;
use crate::viewer::settings::picture::{PictureSetting, SettingChange};
use crate::viewer::settings::{Settings, picture};

/// What stands for settings that change nothing of A.
pub const AS_A: &str = "A";

/// Most entries of a board.
pub const MAX_ENTRIES: usize = 9;

/// Everything about a picture that is neither scene nor view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoardEntry {
    /// How it is drawn.
    pub render: RenderSettings,
    /// How its document is read.
    pub dialect: DialectChoice,
}

impl BoardEntry {
    /// The settings of this moment.
    pub fn of(settings: &Settings) -> Self {
        Self {
            render: settings.render,
            dialect: settings.dialect,
        }
    }

    /// The same as the settings that menus change; those that no picture shows have their defaults.
    fn settings(self) -> Settings {
        Settings::of(self.render, self.dialect)
    }

    /// The same with changes such as `sample-rate 16, pattern sobol`; [`AS_A`] changes nothing.
    ///
    /// # Errors
    /// One line for the first that is none, and for a rate that the pattern does not take.
    pub fn with(self, text: &str) -> Result<Self, String> {
        if text.trim() == AS_A {
            return Ok(self);
        }
        match self.changed(&picture::changes(text)?) {
            (_, Some(remark)) => Err(format!("{}: {remark}", text.trim())),
            (entry, None) => Ok(entry),
        }
    }

    /// The same with these changes, and in one line what else had to change.
    pub(in crate::viewer) fn changed(self, changes: &[SettingChange]) -> (Self, Option<String>) {
        let mut settings = self.settings();
        let remark = picture::apply_all(changes, &mut settings);
        (Self::of(&settings), remark)
    }

    /// An entry for each value of an axis, all else as in this one; of values that are drawn alike the first.
    ///
    /// # Errors
    /// One line for the first value that is none.
    pub fn vary(self, axis: &Axis) -> Result<Vec<Self>, String> {
        let mut entries: Vec<Self> = Vec::new();
        for value in &axis.values {
            let mut settings = self.settings();
            // A rate that the pattern does not take is drawn as the nearest one.
            SettingChange::of(&axis.name, value)?.apply(&mut settings);
            let entry = Self::of(&settings);
            if !entries.iter().any(|known| known.is_like(entry)) {
                entries.push(entry);
            }
        }
        Ok(entries)
    }

    /// What is said of the first value of an axis that no entry has: a rate that the pattern does not take.
    pub(in crate::viewer) fn not_as_asked(self, axis: &Axis) -> Option<String> {
        let setting = picture::find(&axis.name)?;
        axis.values.iter().find_map(|value| {
            let (entry, remark) = self.changed(&[SettingChange::of(&axis.name, value).ok()?]);
            remark.filter(|_| entry.value(setting) != *value)
        })
    }

    /// As [`BoardEntry::vary`], for values that somebody asked for by their names.
    ///
    /// # Errors
    /// As [`BoardEntry::vary`], and for a rate that the pattern does not take.
    pub fn vary_as_asked(self, axis: &Axis) -> Result<Vec<Self>, String> {
        for value in &axis.values {
            if let (_, Some(remark)) = self.changed(&[SettingChange::of(&axis.name, value)?]) {
                return Err(format!("{} {}: {remark}", axis.name, axis.short(value)));
            }
        }
        self.vary(axis)
    }

    /// Names and values of the settings in which it differs from `other`, as options have them.
    pub fn changes(self, other: Self) -> Vec<(&'static str, String)> {
        let (own, other) = (self.settings(), other.settings());
        let changed = picture::all().filter(|setting| setting.value(&own) != setting.value(&other));
        changed.map(|setting| (setting.option, setting.value(&own))).collect()
    }

    /// The same in one line, as [`BoardEntry::with`] of `other` takes it; empty where nothing differs.
    pub fn change_text(self, other: Self) -> String {
        let changes = self.changes(other).into_iter();
        let changes: Vec<String> = changes.map(|(name, value)| format!("{name} {value}")).collect();
        changes.join(", ")
    }

    /// Whether every setting has one value in both; the outline follows the view.
    pub fn is_like(self, other: Self) -> bool {
        self.changes(other).is_empty()
    }

    /// Why people would take one for the other: two patterns of one name. `None` where they would not.
    pub fn mistaken_for(self, other: Self) -> Option<String> {
        let (own, other) = (self.settings(), other.settings());
        picture::all().find_map(|setting| {
            let values = [setting.value(&own), setting.value(&other)];
            setting.mistaken(values.each_ref().map(|value| (value.as_str(), value.as_str())))
        })
    }

    /// The value of a setting.
    pub fn value(self, setting: &PictureSetting) -> String {
        setting.value(&self.settings())
    }
}

/// The settings that are not the same in all entries; of a single one those that are not at their defaults.
pub(in crate::viewer) fn differing(entries: &[BoardEntry]) -> Vec<&'static PictureSetting> {
    let Some((first, rest)) = entries.split_first() else {
        return Vec::new();
    };
    let first = first.settings();
    let rest: Vec<Settings> = rest.iter().map(|entry| entry.settings()).collect();
    let differs = |setting: &&PictureSetting| match rest.as_slice() {
        [] => !setting.is_default(&first),
        rest => rest.iter().any(|other| setting.value(other) != setting.value(&first)),
    };
    picture::all().filter(differs).collect()
}

/// What all entries have that is not at its default, such as `sample rate 16`, but for what has no effect in any of them.
pub(in crate::viewer) fn shared_words(entries: &[BoardEntry]) -> String {
    let Some((first, rest)) = entries.split_first() else {
        return String::new();
    };
    let first = first.settings();
    let rest: Vec<Settings> = rest.iter().map(|entry| entry.settings()).collect();
    let is_shared = |setting: &&PictureSetting| {
        let mut others = rest.iter();
        // One alone says in its caption what it is.
        !rest.is_empty()
            && !setting.is_default(&first)
            && others.all(|other| setting.value(other) == setting.value(&first))
    };
    let counts = |setting: &&PictureSetting| {
        let mut all = std::iter::once(&first).chain(&rest);
        all.any(|settings| setting.idle(settings, None).is_none())
    };
    let told = picture::all().filter(is_shared).filter(counts);
    joined(told.map(|setting| setting.words(&first)))
}

/// What tells each entry from the others, such as `pattern sobol, sample rate 16`: first what has most values. What has no effect
/// is told only where nothing else tells two entries apart.
pub(in crate::viewer) fn captions(entries: &[BoardEntry]) -> Vec<String> {
    let all: Vec<Settings> = entries.iter().map(|entry| entry.settings()).collect();
    let mut told = differing(entries);
    told.sort_by_cached_key(|setting| {
        let values: HashSet<String> = all.iter().map(|settings| setting.value(settings)).collect();
        Reverse(values.len())
    });
    let counting = |settings: &Settings| {
        let counting = told.iter().filter(|setting| setting.idle(settings, None).is_none());
        joined(counting.map(|setting| setting.words(settings)))
    };
    let few: Vec<String> = all.iter().map(counting).collect();
    let caption = |(settings, own): (&Settings, &String)| {
        let tells = !own.is_empty() && few.iter().filter(|other| *other == own).count() == 1;
        if tells {
            return own.clone();
        }
        let words = joined(told.iter().map(|setting| setting.candid_words(settings)));
        if words.is_empty() {
            "first settings".to_owned()
        } else {
            words
        }
    };
    all.iter().zip(&few).map(caption).collect()
}

fn joined(words: impl Iterator<Item = String>) -> String {
    words.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(changes: &[(&str, &str)]) -> BoardEntry {
        let mut settings = Settings::default();
        for (option, value) in changes {
            SettingChange::of(option, value).expect(option).apply(&mut settings);
        }
        BoardEntry::of(&settings)
    }

    #[test]
    fn captions_tell_what_differs_and_no_more() {
        let entries = [
            entry(&[("sample-rate", "16")]),
            entry(&[("sample-rate", "16"), ("pattern", "sobol")]),
            entry(&[("sample-rate", "16"), ("pattern", "r2"), ("resolve", "linear")]),
        ];
        assert_eq!(
            captions(&entries),
            [
                "pattern grid, resolve stored",
                "pattern sobol, resolve stored",
                "pattern r2, resolve linear"
            ],
            "no rate, which all share"
        );
        assert_eq!(captions(&entries[..1]), ["sample rate 16"], "one alone says what it is");
        assert_eq!(captions(&[entry(&[])]), ["first settings"], "of which nothing was set");
        assert!(captions(&[]).is_empty(), "nothing of nothing");
    }

    #[test]
    fn captions_begin_with_what_differs_most() {
        let entries = ["grid", "sobol", "r2"].map(|pattern| entry(&[("pattern", pattern)]));
        let other = entry(&[("sample-rate", "16"), ("pattern", "jittered")]);
        let told = captions(&[entries[0], entries[1], entries[2], other]);
        assert_eq!(told[1], "pattern sobol, sample rate 1", "four patterns, two rates");
    }

    #[test]
    fn captions_tell_what_has_no_effect_only_where_nothing_else_differs() {
        let exact = entry(&[("coverage", "exact"), ("pattern", "sobol")]);
        let sampled = entry(&[("sample-rate", "4"), ("pattern", "r2")]);
        let told = captions(&[exact, sampled]);
        assert_eq!(told[0], "coverage exact", "neither rate nor pattern");
        assert!(told[1].contains("pattern r2"), "{}", told[1]);
        let other = entry(&[("coverage", "exact"), ("pattern", "r2")]);
        assert_eq!(
            captions(&[exact, other]),
            ["pattern sobol (no effect)", "pattern r2 (no effect)"],
            "one picture"
        );
    }

    #[test]
    fn boards_say_what_all_entries_share() {
        let entries = ["sobol", "r2"].map(|pattern| entry(&[("pattern", pattern), ("sample-rate", "64")]));
        assert_eq!(shared_words(&entries), "sample rate 64", "no pattern, which differs");
        assert_eq!(shared_words(&entries[..1]), "", "one alone says it itself");
        let exact =
            ["sobol", "r2"].map(|pattern| entry(&[("pattern", pattern), ("sample-rate", "64"), ("coverage", "exact")]));
        assert_eq!(shared_words(&exact), "coverage exact", "no rate without samples");
    }

    #[test]
    fn entries_are_told_by_their_changes() {
        let own = entry(&[("sample-rate", "16")]);
        assert_eq!(own.with("A"), Ok(own), "nothing");
        let other = entry(&[("sample-rate", "16"), ("pattern", "sobol")]);
        assert_eq!(own.with(" pattern sobol "), Ok(other), "one");
        for wrong in [
            "",
            "pattern",
            "pattern poisson",
            "colour red",
            "pattern r2,",
            "sample-rate 5",
        ] {
            let problem = own.with(wrong).expect_err(wrong);
            assert!(!problem.contains('\n') && !problem.is_empty(), "{wrong}: {problem}");
        }
        assert!(
            own.with("sample-rate 5, pattern r2").is_ok(),
            "the pattern takes any rate"
        );
        let axis = Axis::of("sample-rate", "1,4,5,16").expect("an axis");
        let rates = own.vary(&axis).expect("values");
        assert_eq!(rates.len(), 3, "five samples of a grid are four");
        assert_eq!(rates[2], own, "the last is A's");
        let problem = own.vary_as_asked(&axis).expect_err("no five samples of a grid");
        assert_eq!(Err(problem), own.with("sample-rate 5"), "as one by one");
        let axis = Axis::of("sample-rate", "1,4,16").expect("an axis");
        assert_eq!(own.vary_as_asked(&axis), own.vary(&axis), "all as asked");
    }

    #[test]
    fn entries_are_alike_whatever_the_view_outlines() {
        let mut other = entry(&[("pattern", "r2")]);
        assert_eq!(
            other.changes(entry(&[])),
            [("pattern", "r2".to_owned())],
            "one setting differs"
        );
        other = entry(&[]);
        other.render.outline = false;
        assert!(other.is_like(entry(&[])), "the outline is the view's");
    }
}
