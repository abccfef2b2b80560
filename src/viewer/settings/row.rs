//! A row of [the table of picture settings](super::table), and changes of a setting as data.

use std::fmt;
use std::path::{Path, PathBuf};

use super::{Settings, values};
use crate::plain;
use crate::raster::SamplePattern;
use crate::render::RenderSettings;
use crate::scene::Scene;
use crate::viewer::key_chords::Chord;

/// Longest value that is quoted as it was written, in characters.
const MAX_WRITTEN: usize = 80;

/// Said behind a value that has no effect beside those of the other settings, where it is told all the same.
pub(in crate::viewer) const NO_EFFECT: &str = "(no effect)";

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
    /// Whether the value takes a sign in words: `level bias +1`.
    pub signed: bool,
    /// Whether steps go round and round instead of ending at the first and the last value.
    pub goes_round: bool,
    /// Why its value makes no difference beside those of the other settings, to go behind "no effect:"; `None` where it does, or may.
    pub(super) idle: fn(&RenderSettings) -> Option<&'static str>,
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
    /// These, by name, and others that are written out or lie in a file.
    NamedOrWritten {
        /// Those that the key steps through.
        names: fn() -> Vec<&'static str>,
        /// Those that menus, lists and help have, too.
        more: fn() -> Vec<&'static str>,
        /// One more that they go on offering once it was chosen.
        kept: fn(&Settings) -> Option<String>,
        /// What others look like.
        form: &'static str,
        /// What people are shown of a value: its name.
        short: fn(&str) -> &str,
        /// Whether a text names a file.
        is_file: fn(&str) -> bool,
        /// The value in a file; one line where there is none.
        of_file: fn(&Path) -> Result<String, String>,
    },
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
    /// A button for every value, this many in a row, below the label.
    WideButtons(usize),
    /// A list that drops down.
    List,
    /// The same of short names, which leave room to the control beside it.
    ShortList,
    /// A number to drag or to type.
    Number {
        /// The smallest and the largest.
        range: [f64; 2],
        /// Digits behind its point.
        digits: u8,
        /// Before the number.
        prefix: &'static str,
        /// What stands for no number at all; half a step below the smallest.
        none: Option<&'static str>,
    },
}

impl Control {
    /// How much of a row it takes beside others: names are longer than numbers.
    pub fn part(&self) -> f32 {
        match self {
            Self::Buttons => 2.7,
            Self::List => 1.7,
            Self::ShortList => 1.25,
            _ => 1.0,
        }
    }
}

impl PanelRow {
    /// A row that shows `label`, and that readers of screens call `name`.
    pub(super) const fn new(label: &'static str, name: &'static str, control: Control) -> Self {
        Self { label, name, control }
    }
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

impl SettingCommand {
    /// A command without keys that does nothing yet.
    pub(super) const fn new(id: &'static str, name: &'static str, help: &'static str) -> Self {
        Self {
            id,
            name,
            help,
            more: "",
            keys: &[],
            step: None,
            takes_value: false,
        }
    }
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

/// Whether a picture of this scene may read textures; one that is not known may.
pub fn reads_textures(scene: Option<&Scene>) -> bool {
    // The tiles of patterns are read as textures are.
    scene.is_none_or(|scene| !scene.textures.is_empty() || !scene.patterns.is_empty())
}

impl PictureSetting {
    /// The value as text, as [`PictureSetting::to`] takes it.
    pub fn value(&self, settings: &Settings) -> String {
        (self.get)(settings)
    }

    /// The value where nothing is said about the setting.
    pub fn default_value(&self) -> String {
        self.value(&Settings::default())
    }

    /// Whether it is at its default.
    pub fn is_default(&self, settings: &Settings) -> bool {
        self.value(settings) == self.default_value()
    }

    /// Why its value makes no difference to a picture of this scene with these settings, in words that go behind "no effect:";
    /// `None` where it makes one, or may.
    pub fn idle(&self, settings: &Settings, scene: Option<&Scene>) -> Option<&'static str> {
        let is_spare = self.about == About::Textures && !reads_textures(scene);
        is_spare
            .then_some("this scene has no texture")
            .or_else(|| (self.idle)(&settings.render))
    }

    /// Such as `sample rate 16` or `level bias +1`.
    pub fn words(&self, settings: &Settings) -> String {
        format!("{} {}", self.label, self.shown(settings))
    }

    /// The same, and that it has no effect where it has none: for what is told in spite of that.
    pub fn candid_words(&self, settings: &Settings) -> String {
        let words = self.words(settings);
        match self.idle(settings, None) {
            Some(_) => format!("{words} {NO_EFFECT}"),
            None => words,
        }
    }

    /// The value as people read it.
    pub fn shown(&self, settings: &Settings) -> String {
        let value = self.value(settings);
        if let Values::NamedOrWritten { short, .. } = self.values {
            return short(&value).to_owned();
        }
        match values::number(&value).filter(|_| self.signed) {
            Some(number) => format!("{number:+}"),
            None => value,
        }
    }

    /// The names of its values, in the order of menus; none where they cannot be listed.
    pub fn names(&self) -> Vec<&'static str> {
        match self.values {
            Values::Named(names) | Values::NamedOrWritten { names, .. } => names(),
            Values::Open { .. } => Vec::new(),
        }
    }

    /// Names of other values, which bring a sample rate of their own.
    pub fn names_besides(&self) -> Vec<&'static str> {
        match self.values {
            Values::NamedOrWritten { more, .. } => more(),
            Values::Named(_) | Values::Open { .. } => Vec::new(),
        }
    }

    /// The values that have buttons or lines of a list.
    pub fn offered(&self, settings: &Settings) -> Vec<String> {
        match self.values {
            Values::Named(names) => names().into_iter().map(str::to_owned).collect(),
            Values::NamedOrWritten { names, more, kept, .. } => {
                let mut all: Vec<String> = names().into_iter().chain(more()).map(str::to_owned).collect();
                for value in kept(settings).into_iter().chain([self.value(settings)]) {
                    if !all.contains(&value) {
                        all.push(value);
                    }
                }
                all
            }
            Values::Open { offered, .. } => offered(settings),
        }
    }

    /// The form of a value, such as `nearest|bilinear` or `a whole number from 1 to 256`.
    pub fn form(&self) -> String {
        match self.values {
            Values::Named(names) => names().join("|"),
            Values::NamedOrWritten { names, more, form, .. } => {
                format!("{}|{}, {form}", names().join("|"), more().join("|"))
            }
            Values::Open { form, .. } => form.to_owned(),
        }
    }

    /// The values of an axis to begin with.
    pub fn some_values(&self) -> Vec<&'static str> {
        match self.values {
            Values::Named(names) | Values::NamedOrWritten { names, .. } => names(),
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

    /// The value that a text means which may name a file, from `folder` where the name is not absolute.
    ///
    /// Only what the user typed or opened comes here: a record or a pin of a stranger names no file.
    ///
    /// # Errors
    /// One line where the file holds no value.
    pub fn read(&self, text: &str, folder: Option<&Path>) -> Result<String, String> {
        let text = values::unquoted(text);
        match self.values {
            Values::NamedOrWritten { is_file, of_file, .. } if is_file(text) => {
                let path: PathBuf = values::path(text.trim());
                of_file(&folder.map_or(path.clone(), |folder| folder.join(path)))
            }
            _ => Ok(text.to_owned()),
        }
    }

    /// The same for a list of values with commas between them, from the folder of the process. The name of a file may have
    /// commas of its own: where double quotes are around it, or where it is the only value.
    ///
    /// # Errors
    /// As [`PictureSetting::read`].
    pub fn read_list(&self, text: &str) -> Result<String, String> {
        if values::path(text.trim()).is_file() {
            return self.read(text, None);
        }
        let typed = values::list(text);
        let values: Result<Vec<String>, String> = typed.iter().map(|value| self.read(value, None)).collect();
        let values = values?;
        let told: Vec<(&str, &str)> = typed.into_iter().zip(values.iter().map(String::as_str)).collect();
        self.told_apart(&told)?;
        Ok(values.join(","))
    }

    /// Says which two of some values people would take for one: each as it was written, and the value itself.
    ///
    /// # Errors
    /// One line with both and the cure.
    pub fn told_apart(&self, values: &[(&str, &str)]) -> Result<(), String> {
        let before = |index: usize| values[..index].iter().map(move |known| [*known, values[index]]);
        let mut pairs = (0..values.len()).flat_map(before);
        match pairs.find_map(|two| self.mistaken(two)) {
            Some(problem) => Err(problem),
            None => Ok(()),
        }
    }

    /// Why people would take one value for the other, which are shown by the same name; `None` where they would not.
    pub fn mistaken(&self, [(one, a), (other, b)]: [(&str, &str); 2]) -> Option<String> {
        let name = self.short(a);
        if a == b || name != self.short(b) || self.as_given(a) == self.as_given(b) {
            return None;
        }
        let [one, other] = [one, other].map(|written| plain::short_line(written.trim(), MAX_WRITTEN));
        Some(format!(
            "{one} and {other} differ, and both are called `{name}`; give one of them another name"
        ))
    }

    /// A value as [`PictureSetting::value`] gives it, and a text that is none as it is.
    fn as_given(&self, text: &str) -> String {
        let mut settings = Settings::default();
        if self.set(&mut settings, text) {
            self.value(&settings)
        } else {
            text.to_owned()
        }
    }

    /// Whether a value may lie in a file.
    pub fn reads_files(&self) -> bool {
        matches!(self.values, Values::NamedOrWritten { .. })
    }

    /// What people are shown of a value.
    pub fn short<'v>(&self, value: &'v str) -> &'v str {
        match self.values {
            Values::NamedOrWritten { short, .. } => short(value),
            _ => value,
        }
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
    /// The option's name of the setting that it changes.
    pub fn option(&self) -> &'static str {
        self.setting.option
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
        // Who chooses a pattern that has one rate alone chooses that, too.
        let chooses_rate = self.setting.reads_files() && matches!(render.pattern, SamplePattern::Custom(_));
        let refusal = render.pattern.refusal(render.sample_rate).filter(|_| !chooses_rate);
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
