//! The axes of a sheet: settings by the names of the command line's options, each with a list of values.

use crate::viewer::settings::picture::{self, PictureSetting, SettingChange};

/// Settings with their values, in the order they were given in.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct AxisLists {
    lists: Vec<Axis>,
    /// Whether the values of the only axis follow each other from top to bottom.
    stacked: bool,
}

/// A setting and its values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axis {
    /// The option without its dashes.
    pub name: String,
    /// As they were written, at least one.
    pub values: Vec<String>,
}

/// One value of every list.
pub type Choice = Vec<(String, String)>;

impl Axis {
    /// Reads the values of the option `name`, such as `1,4,16`; what each of them means is not looked at.
    ///
    /// # Errors
    /// One line when a value is empty or comes twice.
    pub fn parse(name: &str, text: &str) -> Result<Self, String> {
        let values: Vec<String> = text.split(',').map(|value| value.trim().to_owned()).collect();
        if values.iter().any(String::is_empty) {
            let what = match text.trim() {
                "" => "the list is empty".to_owned(),
                text => format!("\"{text}\" has an empty value"),
            };
            return Err(format!("{what}; a list is values with commas between them"));
        }
        for (index, value) in values.iter().enumerate() {
            if values[..index].contains(value) {
                return Err(format!("{value} is there twice; give it once"));
            }
        }
        if let Some(setting) = picture::find(name) {
            let written: Vec<(&str, &str)> = values.iter().map(|value| (value.as_str(), value.as_str())).collect();
            setting.told_apart(&written)?;
        }
        Ok(Self {
            name: name.to_owned(),
            values,
        })
    }

    /// The same of a picture setting, with values that it takes or that lie in files. Only what a user typed comes here.
    ///
    /// # Errors
    /// As [`Axis::of`], and one line where a file holds no value.
    pub fn read(name: &str, text: &str) -> Result<Self, String> {
        let setting = picture::known(name)?;
        Self::of(name, &setting.read_list(text)?)
    }

    /// The same of a picture setting, with values that it takes.
    ///
    /// # Errors
    /// One line when there is no such setting, or a value is none of it.
    pub fn of(name: &str, text: &str) -> Result<Self, String> {
        let axis = Self::parse(name, text)?;
        for value in &axis.values {
            SettingChange::of(name, value)?;
        }
        Ok(axis)
    }

    /// An axis to begin with: every value where they have names.
    pub fn first(setting: &PictureSetting) -> Self {
        Self {
            name: setting.option.to_owned(),
            values: setting.some_values().into_iter().map(str::to_owned).collect(),
        }
    }

    /// The word of the command line.
    pub fn word(&self) -> String {
        format!("--{}={}", self.name, self.values.join(","))
    }

    /// A value in words, such as `sample rate 4`.
    pub fn words(&self, value: &str) -> String {
        format!("{} {}", self.title(), self.short(value))
    }

    /// What people are shown of a value.
    pub fn short<'v>(&self, value: &'v str) -> &'v str {
        picture::find(&self.name).map_or(value, |setting| setting.short(value))
    }

    /// The setting in words, such as `sample rate`: what it is called everywhere.
    pub fn title(&self) -> String {
        picture::find(&self.name).map_or_else(|| self.name.replace('-', " "), |setting| setting.label.to_owned())
    }
}

impl FromIterator<Axis> for AxisLists {
    fn from_iter<I: IntoIterator<Item = Axis>>(lists: I) -> Self {
        Self {
            lists: lists.into_iter().collect(),
            stacked: false,
        }
    }
}

impl AxisLists {
    /// The same; the values of the only axis follow each other from top to bottom if `stacked`.
    #[must_use]
    pub fn stacked(self, stacked: bool) -> Self {
        Self { stacked, ..self }
    }

    /// Whether there is one axis, from top to bottom.
    pub fn is_stack(&self) -> bool {
        self.stacked && self.axes().count() == 1
    }

    /// The lists of several values: what differs between panels.
    pub fn axes(&self) -> impl Iterator<Item = &Axis> {
        self.lists.iter().filter(|axis| axis.values.len() > 1)
    }

    /// The words of the command line, in their order.
    pub fn words(&self) -> Vec<String> {
        let stacked = self.is_stack().then(|| "--stacked".to_owned());
        self.lists.iter().map(Axis::word).chain(stacked).collect()
    }

    /// How many choices there are; a huge number where they cannot be counted.
    pub fn count(&self) -> usize {
        self.lists
            .iter()
            .fold(1, |count, axis| count.saturating_mul(axis.values.len()))
    }

    /// Every combination, the first axis changing fastest.
    pub fn choices(&self) -> Vec<Choice> {
        let mut choices: Vec<Choice> = vec![Vec::new()];
        for axis in self.lists.iter().rev() {
            let value = |value: &String| (axis.name.clone(), value.clone());
            choices = choices
                .iter()
                .flat_map(|rest| {
                    axis.values
                        .iter()
                        .map(move |chosen| [&[value(chosen)], rest.as_slice()].concat())
                })
                .collect();
        }
        choices
    }

    /// The labels of rows that several axes make, the first of them changing fastest; `words` says what a value is called.
    pub(in crate::viewer) fn rows(axes: &[&Axis], words: impl Fn(&Axis, &str) -> String) -> Vec<String> {
        let mut labels = vec![String::new()];
        for axis in axes.iter().rev() {
            labels = labels
                .iter()
                .flat_map(|rest| {
                    let words = &words;
                    axis.values.iter().map(move |value| match rest.as_str() {
                        "" => words(axis, value),
                        rest => format!("{}, {rest}", words(axis, value)),
                    })
                })
                .collect();
        }
        labels
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_at_fault_are_refused() {
        for (text, why) in [
            ("1,,4", "\"1,,4\" has an empty value"),
            (" ", "the list is empty"),
            ("1,4,1", "twice"),
        ] {
            let problem = Axis::parse("sample-rate", text).expect_err(text);
            assert!(problem.contains(why), "{text}: {problem}");
        }
    }

    #[test]
    fn axes_have_values_of_their_setting() {
        assert!(Axis::of("sample-rate", "1, 4").is_ok(), "numbers");
        assert!(Axis::of("sample-rate", "1, many").is_err(), "no number");
        assert!(Axis::of("colour", "red, blue").is_err(), "no setting");
    }

    #[test]
    fn rows_of_two_axes_are_labelled_in_the_order_of_the_choices() {
        let axes = [("pattern", "grid,r2"), ("rules", "standard,course")];
        let lists: AxisLists = axes
            .iter()
            .map(|(name, values)| Axis::parse(name, values).expect("a list"))
            .collect();
        let labels = AxisLists::rows(&lists.axes().collect::<Vec<_>>(), Axis::words);
        let choices = lists.choices().into_iter().map(|choice| {
            let words: Vec<String> = choice.iter().map(|(name, value)| format!("{name} {value}")).collect();
            words.join(", ")
        });
        assert_eq!(labels, choices.collect::<Vec<_>>(), "row by row");
    }
}
