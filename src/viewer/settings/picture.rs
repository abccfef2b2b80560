//! Settings of a picture by their names: what a row of [the table](super::table) holds, and changes as data.
//!
//! Keys, palette, panel, command line, records, lessons, captions and the axes of sheets know settings only by their rows: a
//! value is its text, such as `16` or `bilinear`, in all of them.

use std::fmt;

use super::table::PICTURE_SETTINGS;
use super::{Settings, values};
use crate::viewer::key::Chord;

/// A setting that decides the pixels of a picture, besides scene and view.
pub struct PictureSetting {
    /// The option's name without its dashes.
    pub option: &'static str,
    /// What it is called beside a value, as in `sample rate 16`.
    pub label: &'static str,
    /// What the value stands for in the help of an option, such as `N`.
    pub placeholder: &'static str,
    /// Its line in the help of the command line: no full stop.
    pub help: &'static str,
    /// Which values there are.
    pub values: Values,
    /// What it is about.
    pub about: About,
    /// Where its value is told besides the panel.
    pub told: Told,
    /// Its control in the panel, if it has one.
    pub panel: Option<PanelRow>,
    /// Its lines in the table of commands.
    pub commands: &'static [SettingCommand],
    /// Whether the value takes a sign in words: `bias +1`.
    pub signed: bool,
    /// Whether steps go round and round instead of ending at the first and the last value.
    pub goes_round: bool,
    /// The name that a value had once, by its name of today.
    pub former: fn(&str) -> Option<&'static str>,
    /// The value as text, which `set` takes.
    pub(super) get: fn(&Settings) -> String,
    /// Takes a value; `None` where the text is none.
    pub(super) set: fn(&mut Settings, &str) -> Option<()>,
    /// Steps to the next value, or to the one before where the number is below zero.
    pub(super) step: fn(&mut Settings, f64),
}

/// Which values a setting has.
#[derive(Debug)]
pub enum Values {
    /// These, by name.
    Named(fn() -> Vec<&'static str>),
    /// More than can be listed.
    Open {
        /// In words, such as `a whole number from 1 to 256`.
        form: &'static str,
        /// In the table of options, such as `1 ... 64`.
        range: &'static str,
        /// A few of them, for the first axis of a sheet.
        some: &'static [&'static str],
        /// Those that the panel offers as buttons; a number's field has none.
        offered: fn(&Settings) -> Vec<String>,
    },
}

/// Where the value of a setting is told in status line, title and the texts over the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Told {
    /// Always.
    Always,
    /// Where it is not the default.
    IfChanged,
    /// Only where A and B differ in it.
    IfDifferent,
}

/// What a setting is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum About {
    /// Where samples lie, how they are averaged and what they show.
    Samples,
    /// How textures are read.
    Textures,
    /// How the document is read.
    Document,
}

/// A setting in the panel.
#[derive(Debug)]
pub struct PanelRow {
    /// On the left, or above where the control is as wide as the panel. A setting without one stands beside the one before it.
    pub label: &'static str,
    /// For screen readers.
    pub name: &'static str,
    /// What is pressed or dragged.
    pub control: Control,
}

/// What sets a value in the panel.
#[derive(Debug)]
pub enum Control {
    /// A button for every value, beside the label.
    Buttons,
    /// A button for every value, so many in a row, below the label.
    WideButtons(usize),
    /// A list that drops down.
    List,
    /// A number to drag or to type.
    Number {
        /// The smallest and the largest.
        range: [f64; 2],
        /// Before the number.
        prefix: &'static str,
        /// What stands for no number at all; half a step below the smallest.
        none: Option<&'static str>,
    },
}

/// A command that keys, palette and scripts know a setting by.
#[derive(Debug)]
pub struct SettingCommand {
    /// The word in scripts and in the palette.
    pub id: &'static str,
    /// The name in menus and in the palette.
    pub name: &'static str,
    /// What it does: one sentence without a full stop.
    pub help: &'static str,
    /// What else a tool tip says: one sentence without a full stop, or nothing.
    pub more: &'static str,
    /// Its keys.
    pub keys: &'static [Chord],
    /// What it does without a value: steps so far. `None` where it needs its value.
    pub step: Option<f64>,
    /// Whether a value may follow.
    pub takes_value: bool,
}

/// A change of a picture's settings.
#[derive(Clone, Debug, PartialEq)]
pub struct SettingChange {
    setting: &'static PictureSetting,
    to: To,
}

#[derive(Clone, Debug, PartialEq)]
enum To {
    /// A text that the setting takes.
    Value(String),
    Step(f64),
}

/// The settings, in the order of menus and of the command line.
pub fn all() -> &'static [PictureSetting] {
    PICTURE_SETTINGS
}

/// The setting with the option `name`.
pub fn find(name: &str) -> Option<&'static PictureSetting> {
    PICTURE_SETTINGS.iter().find(|setting| setting.option == name)
}

/// The settings about this that are not at their defaults and that are not told always, in few words each, such as `pattern
/// halton`.
pub fn changed_words(settings: &Settings, about: About) -> Vec<String> {
    let told = told(Told::IfChanged, about).filter(|setting| !setting.is_default(settings));
    told.map(|setting| setting.words(settings)).collect()
}

/// The same after those that are told always.
pub fn told_words(settings: &Settings, about: About) -> Vec<String> {
    let always = told(Told::Always, about).map(|setting| setting.words(settings));
    always.chain(changed_words(settings, about)).collect()
}

fn told(told: Told, about: About) -> impl Iterator<Item = &'static PictureSetting> {
    PICTURE_SETTINGS
        .iter()
        .filter(move |setting| (setting.told, setting.about) == (told, about))
}

/// The changes that settings such as `sample-rate 16, dialect svg` ask for; `None` where one of them is none.
pub(in crate::viewer) fn parse_changes(text: &str) -> Option<Vec<SettingChange>> {
    let one = |part: &str| {
        let (name, value) = part.trim().split_once(char::is_whitespace)?;
        find(name)?.to(value).ok()
    };
    text.split(',').map(one).collect()
}

/// Whether a text is meant to be settings: it starts with an option's name and a blank.
pub(in crate::viewer) fn are_meant(text: &str) -> bool {
    text.trim_start()
        .split_once(char::is_whitespace)
        .is_some_and(|(name, _)| find(name).is_some())
}

impl PictureSetting {
    /// The value as text, as [`PictureSetting::to`] takes it.
    pub fn value(&self, settings: &Settings) -> String {
        (self.get)(settings)
    }

    /// The value of a picture of which nothing is said.
    pub fn default_value(&self) -> String {
        self.value(&Settings::default())
    }

    /// Whether it is at its default.
    pub fn is_default(&self, settings: &Settings) -> bool {
        self.value(settings) == self.default_value()
    }

    /// Such as `sample rate 16` or `bias +1`.
    pub fn words(&self, settings: &Settings) -> String {
        format!("{} {}", self.label, self.shown(settings))
    }

    /// The value as people read it.
    pub fn shown(&self, settings: &Settings) -> String {
        let value = self.value(settings);
        match values::number(&value).filter(|_| self.signed) {
            Some(number) => format!("{number:+}"),
            None => value,
        }
    }

    /// The names of its values, in the order of menus; none where they cannot be listed.
    pub fn names(&self) -> Vec<&'static str> {
        match self.values {
            Values::Named(names) => names(),
            Values::Open { .. } => Vec::new(),
        }
    }

    /// The values that have buttons or lines of a list.
    pub fn offered(&self, settings: &Settings) -> Vec<String> {
        match self.values {
            Values::Named(names) => names().into_iter().map(str::to_owned).collect(),
            Values::Open { offered, .. } => offered(settings),
        }
    }

    /// The form of a value, such as `nearest|bilinear` or `a whole number from 1 to 256`.
    pub fn form(&self) -> String {
        match self.values {
            Values::Named(names) => names().join("|"),
            Values::Open { form, .. } => form.to_owned(),
        }
    }

    /// The values of an axis to begin with.
    pub fn some_values(&self) -> Vec<&'static str> {
        match self.values {
            Values::Named(names) => names(),
            Values::Open { some, .. } => some.to_vec(),
        }
    }

    /// Takes a value; false where the text is none.
    pub fn set(&self, settings: &mut Settings, value: &str) -> bool {
        let value = value.trim();
        let mut names = self.names().into_iter();
        let renamed = names.find(|name| (self.former)(name) == Some(value));
        (self.set)(settings, renamed.unwrap_or(value)).is_some()
    }

    /// The change that sets this value.
    ///
    /// # Errors
    /// One line that quotes the text and gives the form.
    pub fn to(&'static self, value: &str) -> Result<SettingChange, String> {
        let value = value.trim();
        let mut settings = Settings::default();
        if !self.set(&mut settings, value) {
            return Err(format!("\"{value}\" is not {}", self.form()));
        }
        Ok(SettingChange {
            setting: self,
            to: To::Value(self.value(&settings)),
        })
    }

    /// The change that steps to the next value, or to the one before where `by` is below zero.
    pub const fn step(&'static self, by: f64) -> SettingChange {
        SettingChange {
            setting: self,
            to: To::Step(by),
        }
    }
}

impl SettingChange {
    /// The setting `option` to this value.
    ///
    /// # Errors
    /// One line where there is no such setting or no such value.
    pub fn of(option: &str, value: &str) -> Result<Self, String> {
        find(option)
            .ok_or_else(|| format!("there is no setting {option}"))?
            .to(value)
    }

    /// Whether it is worth to be repeated while a key is held: a step that ends somewhere.
    pub fn repeats(&self) -> bool {
        matches!(self.to, To::Step(_)) && !self.setting.goes_round
    }

    /// Changes the settings; tells what else had to change, in one line.
    pub fn apply(&self, settings: &mut Settings) -> Option<String> {
        match &self.to {
            // It was tried when the change was made.
            To::Value(value) => {
                self.setting.set(settings, value);
            }
            To::Step(by) => (self.setting.step)(settings, *by),
        }
        let render = &mut settings.render;
        let refusal = render.pattern.refusal(render.sample_rate);
        render.sample_rate = render.pattern.nearest(render.sample_rate);
        refusal
    }
}

impl PartialEq for PictureSetting {
    fn eq(&self, other: &Self) -> bool {
        self.option == other.option
    }
}

impl fmt::Debug for PictureSetting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("PictureSetting").field(&self.option).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(option: &str, value: &str) -> Settings {
        let mut settings = Settings::default();
        SettingChange::of(option, value).expect(option).apply(&mut settings);
        settings
    }

    #[test]
    fn every_setting_takes_what_it_gives() {
        for setting in all() {
            assert_eq!(find(setting.option), Some(setting), "{setting:?} stands once");
            for value in setting.some_values() {
                let settings = after(setting.option, value);
                assert_eq!(setting.value(&settings), value, "{setting:?}");
                let others = all().iter().filter(|other| *other != setting);
                for other in others {
                    assert!(other.is_default(&settings), "{setting:?} leaves {other:?} alone");
                }
            }
            assert!(setting.some_values().len() > 1, "{setting:?} can be an axis");
            let refused = setting.to("no such value").expect_err("no value");
            assert!(refused.contains(&setting.form()), "{refused}");
        }
    }

    #[test]
    fn steps_reach_every_name_and_lead_back() {
        for setting in all() {
            let names = setting.names();
            let mut settings = Settings::default();
            let mut seen: Vec<String> = Vec::new();
            for _ in &names {
                seen.push(setting.value(&settings));
                setting.step(1.0).apply(&mut settings);
            }
            assert_eq!(seen, names, "{setting:?} from its first name on");
            assert!(setting.is_default(&settings), "{setting:?} ends where it began");
            let Some(last) = names.last() else { continue };
            setting.step(-1.0).apply(&mut settings);
            assert_eq!(setting.value(&settings), *last, "{setting:?} back");
        }
    }

    #[test]
    fn rates_that_a_pattern_refuses_become_the_nearest() {
        let mut settings = after("pattern", "r2");
        let five = SettingChange::of("sample-rate", "5").expect("a rate");
        assert_eq!(five.apply(&mut settings), None, "as asked");
        assert_eq!(settings.render.sample_rate.samples(), 5, "any number");
        let grid = SettingChange::of("pattern", "grid").expect("a pattern");
        assert!(grid.apply(&mut settings).is_some(), "the user is told");
        assert_eq!(settings.render.sample_rate.samples(), 4, "the nearest square");
    }

    #[test]
    fn words_are_short_and_only_where_something_differs() {
        assert_eq!(changed_words(&Settings::default(), About::Samples), [""; 0], "nothing");
        assert_eq!(
            changed_words(&after("pattern", "halton"), About::Samples),
            ["pattern halton"]
        );
        assert_eq!(changed_words(&after("lod-bias", "0.5"), About::Textures), ["bias +0.5"]);
        assert_eq!(told_words(&Settings::default(), About::Samples), ["sample rate 1"]);
    }

    #[test]
    fn visualisations_by_old_names() {
        assert_eq!(
            after("visualise", "color"),
            after("visualise", "colour"),
            "as it was called once"
        );
    }
}
