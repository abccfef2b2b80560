//! Lists of settings: every option of sampling as an axis of a sheet, read by the grammar of single pictures.

use clap::builder::{OsStr, Resettable};
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches, value_parser};

use super::sampling::{SamplingOptions, sampling_of};
use crate::scene::DialectChoice;
use crate::viewer::{Axis, AxisLists, Choice};

/// The lists that were given, in the order they were written in.
#[derive(Clone, Debug, Default)]
pub(in crate::cli) struct Lists(pub(in crate::cli) AxisLists);

impl Lists {
    /// How the document is read for one of the combinations. Where rules are compared, all show one reading of it; else the
    /// course's rules ask for the course's.
    pub(in crate::cli) fn reading(&self, sampling: &SamplingOptions) -> DialectChoice {
        let compares_rules = self.0.axes().any(|axis| axis.name == "rules");
        if compares_rules {
            sampling.dialect()
        } else {
            sampling.reading()
        }
    }
}

/// The sampling of a choice.
///
/// # Errors
/// One line.
pub(in crate::cli) fn sampling(choice: &Choice) -> Result<SamplingOptions, String> {
    sampling_of(choice.iter().map(|(name, value)| format!("--{name}={value}")))
}

/// Reads one list; whether its values go together with others is seen later.
fn list(name: &str, text: &str) -> Result<Axis, clap::Error> {
    Axis::of(name, text)
        .map_err(|why| clap::Error::raw(clap::error::ErrorKind::InvalidValue, format!("--{name}: {why}")))
}

/// The options of sampling, which each take a list here.
fn options() -> Command {
    SamplingOptions::augment_args(Command::new("sampling"))
}

impl Args for Lists {
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

impl FromArgMatches for Lists {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut lists = Vec::new();
        for option in options().get_arguments() {
            let (id, Some(name)) = (option.get_id().as_str(), option.get_long()) else {
                continue;
            };
            if let Some(text) = matches.get_one::<String>(id) {
                lists.push((matches.index_of(id), list(name, text)?));
            }
        }
        lists.sort_by_key(|(index, _)| *index);
        Ok(Self(lists.into_iter().map(|(_, axis)| axis).collect()))
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
        let command = Lists::augment_args(Command::new("test"));
        let matches = command.try_get_matches_from(std::iter::once("test").chain(line.split_whitespace()))?;
        Lists::from_arg_matches(&matches).map(|Lists(lists)| lists)
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
            .map(|choice| sampling(choice).expect("valid").sample_rate().samples())
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
            "--sample-rate 1-4",
            "--no-such 1,2",
            "--sample-rate",
        ] {
            assert!(read(line).is_err(), "{line}");
        }
        let lists = read("--sample-rate 1,5").expect("only each value knows");
        assert!(sampling(&lists.choices()[1]).is_err(), "5 is no square");
    }
}
