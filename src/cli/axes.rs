//! Lists of settings: every option of sampling as an axis of a sheet, read by the grammar of single pictures.

use clap::builder::{OsStr, Resettable};
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches, value_parser};

use super::arguments::{SamplingOptions, sampling_of};
use super::failure::Failure;

/// The lists that were given, in the order they were written in.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct AxisLists {
    lists: Vec<Axis>,
}

/// A setting and its values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Axis {
    /// The option without its dashes.
    pub(super) name: String,
    /// As they were written, at least one.
    pub(super) values: Vec<String>,
}

/// One value of every list.
pub(super) type Choice = Vec<(String, String)>;

impl Axis {
    /// A value in words, such as `sample rate 4`.
    pub(super) fn words(&self, value: &str) -> String {
        format!("{} {value}", self.title())
    }

    /// The setting in words, such as `sample rate`.
    pub(super) fn title(&self) -> String {
        self.name.replace('-', " ")
    }
}

impl AxisLists {
    /// The lists of several values: what differs between panels.
    pub(super) fn axes(&self) -> impl Iterator<Item = &Axis> {
        self.lists.iter().filter(|axis| axis.values.len() > 1)
    }

    /// The words of the command line, in their order.
    pub(super) fn words(&self) -> Vec<String> {
        let word = |axis: &Axis| format!("--{}={}", axis.name, axis.values.join(","));
        self.lists.iter().map(word).collect()
    }

    /// How many choices there are; a huge number where they cannot be counted.
    pub(super) fn count(&self) -> usize {
        self.lists
            .iter()
            .fold(1, |count, axis| count.saturating_mul(axis.values.len()))
    }

    /// Every combination, the first axis changing fastest.
    pub(super) fn choices(&self) -> Vec<Choice> {
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

    /// The sampling of a choice.
    pub(super) fn sampling(choice: &Choice) -> Result<SamplingOptions, Failure> {
        sampling_of(choice.iter().map(|(name, value)| format!("--{name}={value}")))
    }

    /// Reads one list.
    fn list(name: &str, text: &str) -> Result<Axis, clap::Error> {
        let refused = |why: String| clap::Error::raw(clap::error::ErrorKind::InvalidValue, format!("--{name}: {why}"));
        let values: Vec<String> = text.split(',').map(|value| value.trim().to_owned()).collect();
        if values.iter().any(String::is_empty) {
            return Err(refused(format!(
                "`{text}` has an empty value; a list is values with commas between them"
            )));
        }
        for (index, value) in values.iter().enumerate() {
            if values[..index].contains(value) {
                return Err(refused(format!("{value} is there twice; give it once")));
            }
        }
        Ok(Axis {
            name: name.to_owned(),
            values,
        })
    }
}

/// The options of sampling, which each take a list here.
fn options() -> Command {
    SamplingOptions::augment_args(Command::new("sampling"))
}

impl Args for AxisLists {
    fn augment_args(command: Command) -> Command {
        let as_list = |option: &Arg| {
            let names: Vec<String> = option
                .get_possible_values()
                .iter()
                .map(|value| value.get_name().to_owned())
                .collect();
            let mut help = option.get_help().map(ToString::to_string).unwrap_or_default();
            if !names.is_empty() {
                help = format!("{help}: {}", names.join(", "));
            }
            option
                .clone()
                .value_parser(value_parser!(String))
                .default_value(Resettable::<OsStr>::Reset)
                .value_name("LIST")
                .help(help)
                .help_heading("Settings, each a list of values with commas")
                .allow_hyphen_values(true)
        };
        command.args(options().get_arguments().map(as_list))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for AxisLists {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut lists = Vec::new();
        for option in options().get_arguments() {
            let (id, Some(name)) = (option.get_id().as_str(), option.get_long()) else {
                continue;
            };
            if let Some(text) = matches.get_one::<String>(id) {
                lists.push((matches.index_of(id), Self::list(name, text)?));
            }
        }
        lists.sort_by_key(|(index, _)| *index);
        Ok(Self {
            lists: lists.into_iter().map(|(_, axis)| axis).collect(),
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Result<AxisLists, clap::Error> {
        let command = AxisLists::augment_args(Command::new("test"));
        let matches = command.try_get_matches_from(std::iter::once("test").chain(line.split_whitespace()))?;
        AxisLists::from_arg_matches(&matches)
    }

    #[test]
    fn axes_multiply_in_the_order_they_are_written() {
        let lists = read("--pixel-sampling nearest,bilinear --sample-rate=1,4,16 --lod-bias -1").expect("lists");
        assert_eq!(lists.count(), 6, "all combinations");
        let names: Vec<&str> = lists.axes().map(|axis| axis.name.as_str()).collect();
        assert_eq!(names, ["pixel-sampling", "sample-rate"], "what differs");
        let choices = lists.choices();
        let rates: Vec<u32> = choices
            .iter()
            .map(|choice| AxisLists::sampling(choice).expect("valid").sample_rate.samples())
            .collect();
        assert_eq!(rates, [1, 1, 4, 4, 16, 16], "the first axis changes fastest");
        let words = [
            "--pixel-sampling=nearest,bilinear",
            "--sample-rate=1,4,16",
            "--lod-bias=-1",
        ];
        assert_eq!(lists.words(), words, "as words again");
    }

    #[test]
    fn axes_at_fault_are_refused() {
        for line in [
            "--sample-rate 1,,4",
            "--sample-rate=",
            "--pattern grid,grid",
            "--no-such 1,2",
            "--sample-rate",
        ] {
            assert!(read(line).is_err(), "{line}");
        }
        let lists = read("--sample-rate 1,5").expect("only each value knows");
        assert!(AxisLists::sampling(&lists.choices()[1]).is_err(), "5 is no square");
    }
}
