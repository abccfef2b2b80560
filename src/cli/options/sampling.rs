//! How a scene is read and sampled: the options of every command that draws, one for each row of the table of picture settings.

use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches, Parser};

use crate::cli::failure::one_line;
use crate::geometry::View;
use crate::raster::SampleRate;
use crate::render::RenderSettings;
use crate::rules::Rules;
use crate::scene::DialectChoice;
use crate::viewer::picture::{self, Values};
use crate::viewer::{PictureSetting, Settings};

/// How a scene is read and sampled.
#[derive(Clone, Debug)]
pub(in crate::cli) struct SamplingOptions {
    settings: Settings,
    /// Options that stand on the command line.
    given: Vec<&'static str>,
}

impl SamplingOptions {
    /// The options that were given, by their names.
    pub(in crate::cli) fn given(&self) -> &[&'static str] {
        &self.given
    }

    /// How documents are read: the course's rules ask for the course's dialect where nothing else is said.
    pub(in crate::cli) fn reading(&self) -> DialectChoice {
        match (self.settings.dialect, self.settings.render.rules) {
            (DialectChoice::Auto, Rules::Course) => DialectChoice::Course,
            (dialect, _) => dialect,
        }
    }

    /// The dialect that was asked for.
    pub(in crate::cli) fn dialect(&self) -> DialectChoice {
        self.settings.dialect
    }

    /// Samples per pixel.
    pub(in crate::cli) fn sample_rate(&self) -> SampleRate {
        self.settings.render.sample_rate
    }

    /// Which options do not go together, and the cure.
    pub(in crate::cli) fn refusal(&self) -> Option<String> {
        let rate = self.sample_rate();
        let refusal = self.settings.render.pattern.refusal(rate)?;
        Some(format!("--sample-rate {}: {refusal}", rate.samples()))
    }

    /// The same as settings of the engine; the outline belongs to every view but the canvas view.
    pub(in crate::cli) fn settings(&self, view: View) -> RenderSettings {
        RenderSettings {
            outline: view != View::Canvas,
            ..self.settings.render
        }
    }
}

/// The option of a setting.
fn option(setting: &'static PictureSetting) -> Arg {
    let option = Arg::new(setting.option)
        .long(setting.option)
        .help(setting.help)
        .default_value(setting.default_value())
        // A number may start with a minus.
        .allow_negative_numbers(true);
    let option = match setting.placeholder {
        "" => option.value_name(setting.option.replace('-', "_").to_uppercase()),
        name => option.value_name(name),
    };
    match setting.values {
        Values::Named(names) => {
            let names = names()
                .into_iter()
                .map(|name| PossibleValue::new(name).aliases((setting.former)(name)));
            option.value_parser(PossibleValuesParser::new(names))
        }
        Values::Open { form, .. } => option.value_parser(move |text: &str| match setting.to(text) {
            Ok(_) => Ok(text.to_owned()),
            Err(_) => Err(format!("the value is {form}")),
        }),
        Values::NamedOrWritten { .. } => option.value_parser(move |text: &str| match setting.to(text) {
            Ok(_) => Ok(text.to_owned()),
            Err(_) => Err(format!("the value is {}", setting.form())),
        }),
    }
}

impl Args for SamplingOptions {
    fn augment_args(command: Command) -> Command {
        command.args(picture::all().map(option))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for SamplingOptions {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut settings = Settings::default();
        let mut given = Vec::new();
        for setting in picture::all() {
            let Some(value) = matches.get_one::<String>(setting.option) else {
                continue;
            };
            if !setting.set(&mut settings, value) {
                let problem = format!("--{} {value}: not {}", setting.option, setting.form());
                return Err(clap::Error::raw(ErrorKind::InvalidValue, problem));
            }
            if matches.value_source(setting.option) == Some(ValueSource::CommandLine) {
                given.push(setting.option);
            }
        }
        if !given.contains(&"sample-rate") {
            // A custom pattern tells how many samples it has.
            let render = &mut settings.render;
            render.sample_rate = render.pattern.nearest(render.sample_rate);
        }
        Ok(Self { settings, given })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The options of sampling alone.
#[derive(Debug, Parser)]
#[command(no_binary_name = true)]
struct SamplingOnly {
    #[command(flatten)]
    sampling: SamplingOptions,
}

/// Reads options of sampling.
pub(in crate::cli) fn sampling_of(words: impl Iterator<Item = String>) -> Result<SamplingOptions, String> {
    let read = SamplingOnly::try_parse_from(words);
    let sampling = read.map_err(|error| one_line(&error.to_string(), None))?.sampling;
    match sampling.refusal() {
        // It has its cure, whichever command asks.
        Some(refusal) => Err(refusal),
        None => Ok(sampling),
    }
}
