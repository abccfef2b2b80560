//! The arguments as written: the commands, and what they are when read.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

use super::completions::completions;
use super::examples::with_examples;
use super::failure::{Failure, one_line};
use super::help;
use super::options::bench::BenchOptions;
use super::options::board::BoardOptions;
use super::options::diff::DiffOptions;
use super::options::inspect::InspectOptions;
use super::options::lesson::LessonOptions;
use super::options::pattern::PatternOptions;
use super::options::profile::ProfileOptions;
use super::options::render::RenderOptions;
use super::options::rerun::RerunOptions;
use super::options::sampling::SamplingOptions;
use super::options::sheet::SheetOptions;
use super::options::spectrum::SpectrumOptions;
use super::options::sweep::SweepOptions;
use super::options::view::ViewerOptions;
use super::options::writeup::WriteupOptions;

/// See how a picture is sampled.
#[derive(Debug, Parser)]
#[command(
    name = "rasterscope",
    version,
    about = "See how a picture is sampled: a rasterizer with a pixel microscope.",
    override_usage = "rasterscope [OPTIONS] [COMMAND]\n       rasterscope [OPTIONS] [SCENE]..."
)]
#[command(after_help = help::LIST)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) verb: Verb,
    /// Set text in the typefaces of this file, or of all files in this folder, too; may be given several times
    #[arg(long = "font", global = true, value_name = "PATH")]
    pub(super) fonts: Vec<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub(super) enum Verb {
    /// Open scenes in the window; without a path the built-in gallery
    View(ViewerOptions),
    /// Draw a scene, or every scene in a folder, into PNG files, without a window
    Render(RenderOptions),
    /// Draw one picture for each combination of settings, in a labelled grid
    #[command(after_help = SHEET_FILES)]
    Sheet(SheetOptions),
    /// Measure each combination of settings: time, memory, and how far the picture is from the truth
    #[command(after_help = SWEEP_FILES)]
    Sweep(SweepOptions),
    /// Compare up to nine settings of one region with the truth: RMSE, FLIP, time, as a table and a picture
    Board(BoardOptions),
    /// Draw every figure of a write-up, and a page that shows them
    #[command(after_help = WRITEUP_FILES)]
    Writeup(WriteupOptions),
    /// Draw again what a picture of this program shows, by the command line that its file carries
    #[command(after_help = RERUN_STATUS)]
    Rerun(RerunOptions),
    /// Explain why a pixel has its colour: samples, primitives, edges, weights, texels
    Inspect(InspectOptions),
    /// Compare two pictures, or a scene with a picture: how many pixels differ, by how much, where, perhaps why
    #[command(after_help = DIFF_STATUS)]
    Diff(DiffOptions),
    /// Walk through a lesson in the window, or draw its steps as slides
    Lesson(LessonOptions),
    /// Time redraws of scenes: median, minimum, milliseconds per stage
    Bench(BenchOptions),
    /// Tell where the samples of a pattern lie, and how even they are: discrepancy, distance, projections, spectrum
    Pattern(PatternOptions),
    /// Measure an edge along a line, beside the truth: shades, 10-90 % width, overshoot
    Profile(ProfileOptions),
    /// Tell which waves a picture is made of, and which of them are aliases; a picture of its spectrum
    Spectrum(SpectrumOptions),
}

impl Verb {
    /// How it reads and samples scenes.
    fn sampling(&self) -> Option<&SamplingOptions> {
        match self {
            Self::View(options) => Some(&options.sampling),
            Self::Render(options) => Some(&options.picture.sampling),
            // Each panel has its own.
            Self::Sheet(_) | Self::Sweep(_) | Self::Writeup(_) | Self::Rerun(_) | Self::Pattern(_) => None,
            Self::Lesson(options) => Some(&options.view.sampling),
            Self::Board(options) => Some(&options.picture.sampling),
            Self::Inspect(options) => Some(&options.picture.sampling),
            Self::Diff(options) => Some(&options.sampling),
            Self::Bench(options) => Some(&options.picture.sampling),
            Self::Profile(options) => Some(&options.picture.sampling),
            Self::Spectrum(options) => Some(&options.picture.sampling),
        }
    }

    /// The scene, where a picture may stand for it.
    pub(super) fn scene(&mut self) -> Option<&mut PathBuf> {
        match self {
            Self::View(options) if options.paths.len() == 1 => options.paths.first_mut(),
            Self::Render(options) => Some(&mut options.scene),
            Self::Sheet(options) => Some(&mut options.scene),
            Self::Sweep(options) => Some(&mut options.scene),
            Self::Board(options) => Some(&mut options.scene),
            Self::Inspect(options) => Some(&mut options.scene),
            Self::Profile(options) => Some(&mut options.scene),
            Self::Spectrum(options) => Some(&mut options.scene),
            _ => None,
        }
    }
}

const SHEET_FILES: &str = "Every option of sampling takes a list with commas; the first list of several values makes the columns. \
                           Beside OUT.png a folder OUT gets the single panels, and figures.md, figures.html and \
                           figures.tex with captions and alternative text.";

const SWEEP_FILES: &str = "Every option of sampling takes a list with commas; the first list of several values makes the lines of the \
                           chart, which lies beside the table unless --plot says otherwise. Ctrl+C leaves what is measured.";

const WRITEUP_FILES: &str = "The folder OUT gets a PNG for each figure, named by task, with the panels of sheets in folders of \
                             their names; index.html, figures.md and figures.tex; pins.toml, which tells where insets look \
                             and may be edited; and the scenes that were made for it.";

const RERUN_STATUS: &str = "Exit status: 0 done, with --check: every pixel is the same; 1 pixels differ; 2 the picture \
                            carries no record or one that cannot be compared so, as of a board or a window, or a file or \
                            an argument is at fault.";

const DIFF_STATUS: &str = "Exit status: 0 the pictures agree within the tolerance, 1 they differ, 2 a file or an \
                           argument is at fault.";

/// Reads words that name a command; `repeated` allows options to come again, so that the last counts.
pub(super) fn parse_words(words: Vec<OsString>, repeated: bool) -> Result<Arguments, Failure> {
    if let Some(page) = help::page(&words) {
        return Err(Failure::Text(page));
    }
    let program = with_examples(Arguments::command());
    for made in [help::man_page, completions] {
        if let Some(page) = made(&words, &program) {
            return Err(page.map_or_else(Failure::Input, Failure::Text));
        }
    }
    let named = words.get(1).and_then(|word| word.to_str());
    let command = named
        .filter(|name| program.find_subcommand(name).is_some())
        .map(str::to_owned);
    let command = command.as_deref();
    let matches = program.args_override_self(repeated).try_get_matches_from(words);
    let read = matches.and_then(|matches| Arguments::from_arg_matches(&matches));
    let arguments = read.map_err(|error| match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            Failure::Text(error.to_string())
        }
        _ => Failure::Input(one_line(&error.to_string(), command)),
    })?;
    match arguments.verb.sampling().and_then(SamplingOptions::refusal) {
        Some(refusal) => Err(Failure::Input(one_line(&refusal, command))),
        None => Ok(arguments),
    }
}

/// `rasterscope PATH` means `rasterscope view PATH`.
///
/// # Errors
/// When the first word is the mistyped name of a command rather than a path.
pub(super) fn with_default_command(mut arguments: Vec<OsString>) -> Result<Vec<OsString>, Failure> {
    let named = |word: &OsStr| {
        let general = ["help", "-h", "--help", "-V", "--version"]
            .iter()
            .any(|other| word == *other);
        general
            || Arguments::command()
                .get_subcommands()
                .any(|verb| word == verb.get_name())
    };
    if !arguments.get(1).is_some_and(|word| named(word)) {
        if let Some(mistake) = arguments.get(1).and_then(|word| mistyped(word)) {
            return Err(mistake);
        }
        arguments.insert(1.min(arguments.len()), "view".into());
    }
    Ok(arguments)
}

/// What is wrong with a word that names no file and is nearly the name of a command; `None` for any other.
fn mistyped(word: &OsStr) -> Option<Failure> {
    let text = word.to_str()?;
    // Paths of scenes have an ending or a folder.
    let is_plain = text.chars().all(|letter| letter.is_ascii_alphabetic());
    if !is_plain || Path::new(word).exists() {
        return None;
    }
    let error = Arguments::command().try_get_matches_from(["rasterscope", text]).err()?;
    let Some(ContextValue::Strings(names)) = error.get(ContextKind::SuggestedSubcommand) else {
        return None;
    };
    // The nearest comes last.
    let nearest = names.last()?;
    Some(Failure::input(format!(
        "there is no command {text}, nor a file of this name; did you mean `rasterscope {nearest}`?"
    )))
}

#[cfg(test)]
mod tests {

    use super::*;
    use crate::cli::restore::parse;
    use crate::cli::size::FrameSize;
    use crate::color::ResolveSpace;
    use crate::raster::SamplePattern;
    use crate::render::Visualisation;
    use crate::rules::Rules;
    use crate::texture::{
        Derivatives, FixedLevel, FootprintExtent, LevelOfDetail, LevelSampling, LodBias, PixelSampling,
    };

    fn parsed(line: &str) -> Result<Arguments, Failure> {
        parse(line.split(' ').map(OsString::from)).map(|(arguments, _)| arguments)
    }

    #[test]
    fn arguments_are_well_formed() {
        Arguments::command().debug_assert();
        let help = Arguments::command().render_help().to_string();
        let usage = "rasterscope [OPTIONS] [COMMAND]\n       rasterscope [OPTIONS] [SCENE]...";
        assert!(help.contains(usage), "without a command the window opens: {help}");
    }

    #[test]
    fn arguments_of_render_become_settings() {
        let line = "rasterscope render a.svg -o b.png --size 300x200 --sample-rate 16 --pixel-sampling bilinear \
                    --pattern jittered-same --level-sampling linear --anisotropy 16 --lod-bias -1.5 --lod-level 2.25 --lod-per sample --lod-by shorter \
                    --view=-5,10,2.5,-90 --background #ff8000 --dialect course --rules course --resolve linear --visualise mip --threads 2";
        let Ok(Arguments {
            verb: Verb::Render(options),
            ..
        }) = parsed(&line.split_whitespace().collect::<Vec<_>>().join(" "))
        else {
            panic!("a good line");
        };
        let settings = options.picture.sampling.settings(options.picture.framing.view);
        assert_eq!(options.picture.size, FrameSize([300, 200]), "size");
        assert_eq!(settings.sample_rate.samples(), 16, "rate");
        assert_eq!(settings.pattern, SamplePattern::JitteredSame, "pattern");
        assert_eq!(settings.pixel_sampling, PixelSampling::Bilinear, "pixel sampling");
        assert_eq!(settings.level_sampling, LevelSampling::Linear, "level sampling");
        assert_eq!(settings.anisotropy.taps(), 16, "anisotropy");
        let detail = LevelOfDetail {
            bias: LodBias::new(-1.5).expect("a bias"),
            fixed: FixedLevel::new(2.25),
            derivatives: Derivatives::Sample,
            extent: FootprintExtent::Shorter,
        };
        assert_eq!(settings.detail, detail, "level of detail");
        assert_eq!(
            settings.background.to_bytes(Rules::Standard),
            [255, 128, 0, 255],
            "background"
        );
        assert_eq!(settings.rules, Rules::Course, "rules");
        assert_eq!(settings.resolve, ResolveSpace::Linear, "resolve");
        assert_eq!(settings.visualisation, Visualisation::MipLevels, "visualisation");
        assert!(settings.outline, "a free view has the outline");
        assert_eq!(options.picture.framing.threads, Some(2), "threads");
    }

    #[test]
    fn visualisation_takes_its_former_name() {
        for name in ["colour", "color"] {
            let line = format!("rasterscope render a.svg -o b.png --visualise {name}");
            match parsed(&line) {
                Ok(Arguments {
                    verb: Verb::Render(options),
                    ..
                }) => assert_eq!(
                    options
                        .picture
                        .sampling
                        .settings(crate::geometry::View::Default)
                        .visualisation,
                    Visualisation::Color,
                    "{name}"
                ),
                other => panic!("{line}: {other:?}"),
            }
        }
    }

    #[test]
    fn arguments_at_fault_get_one_line() {
        for line in [
            "rasterscope render a.svg",
            "rasterscope render",
            "rasterscope render a.svg -o b.png --sample-rate 5",
            "rasterscope render a.svg -o b.png --sample-rate 289",
            "rasterscope bench a.svg --sample-rate 5 --pattern rotated",
            "rasterscope diff a.svg b.png --sample-rate 12 --pattern jittered",
            "rasterscope a.svg --sample-rate 2 --pattern jittered-same",
            "rasterscope render a.svg -o b.png --sample-rate 257 --pattern r2",
            "rasterscope render a.svg -o b.png --pattern poisson",
            "rasterscope render a.svg -o b.png --resolve gamma",
            "rasterscope render a.svg -o b.png --visualise depth",
            "rasterscope render a.svg -o b.png --size 0x5",
            "rasterscope render a.svg -o b.png --background red",
            "rasterscope render a.svg -o b.png --background #ff80é",
            "rasterscope render a.svg -o b.png --pixel-sampling cubic",
            "rasterscope render a.svg -o b.png --anisotropy 0",
            "rasterscope render a.svg -o b.png --anisotropy 65",
            "rasterscope render a.svg -o b.png --anisotropy 2.5",
            "rasterscope render a.svg -o b.png --lod-bias 16.5",
            "rasterscope render a.svg -o b.png --lod-bias nan",
            "rasterscope render a.svg -o b.png --lod-level -1",
            "rasterscope render a.svg -o b.png --lod-level 1e9",
            "rasterscope render a.svg -o b.png --lod-per texel",
            "rasterscope render a.svg -o b.png --unknown",
            "rasterscope render a.svg -o b.png --inset 5",
            "rasterscope render a.svg -o b.png --inset 5,5:16@8:middle",
            "rasterscope render a.svg -o b.png --inset 5,5:4@8",
            "rasterscope sheet a.svg -o b.png --sample-rate 1,,4",
            "rasterscope sheet a.svg -o b.png --pattern grid,grid",
            "rasterscope sheet a.svg -o b.png --axis 1,4",
            "rasterscope sheet a.svg --sample-rate 1,4",
            "rasterscope writeup course",
            "rasterscope writeup thesis -o out",
            "rasterscope rerun a.png --check -o b.png",
            "rasterscope render a.svg -o b.png --size 5x5 --size 6x6",
            "rasterscope diff a.png",
            "rasterscope diff a.png b.png --gain 0",
            "rasterscope diff a.png b.png --gain nan",
            "rasterscope diff a.png b.png --gain 2 --normalize",
            "rasterscope diff a.png b.png --tolerance 256",
            "rasterscope diff a.png b.png --mode other",
            "rasterscope view a.svg --against none",
            "rasterscope bench",
            "rasterscope bench a.svg --frames 0",
            "rasterscope bench a.svg --threads 0",
            "rasterscope pattern --sample-rate 0",
            "rasterscope pattern --sample-rate 257",
            "rasterscope pattern --seed 65536",
            "rasterscope pattern --pixel 5",
            "rasterscope spectrum a.svg --of image",
            "rasterscope spectrum a.svg --region 1,2,0,3",
            "rasterscope profile a.svg",
            "rasterscope profile a.svg --line 1,2,3",
            "rasterscope profile a.svg --line 1,2,3,x",
            "rasterscope profile a.svg --line 1,2,3,4 --channel alpha",
            "rasterscope profile a.svg --line 1,2,3,4 --sample-rate 5",
        ] {
            assert_at_fault(line);
        }
    }

    #[test]
    fn arguments_of_a_board_at_fault_get_one_line() {
        for line in [
            "rasterscope board a.svg --with sample-rate=16 --sort ssim",
            "rasterscope board a.svg --vary pattern --region 1,2,3",
            "rasterscope board a.svg --vary pattern --region 1,2,0,3",
            "rasterscope board a.svg --vary pattern --region -1,2,3,3",
            "rasterscope board a.svg --vary pattern --truth-space gamma",
            "rasterscope board a.svg --vary pattern --markdown --csv",
            "rasterscope board a.svg --vary pattern --frames 0",
            "rasterscope board a.svg --vary pattern --sample-rate 5",
        ] {
            assert_at_fault(line);
        }
    }

    /// One line, which names the way to help.
    fn assert_at_fault(line: &str) {
        match parsed(line) {
            Err(Failure::Input(message)) => {
                let command = line.split(' ').nth(1).filter(|word| *word != "a.svg").unwrap_or("view");
                let help = format!("; see `rasterscope {command} --help`");
                assert!(
                    !message.contains('\n') && message.ends_with(&help) && !message.contains("to pass"),
                    "{line}: {message}"
                );
            }
            other => panic!("{line}: {other:?}"),
        }
    }

    #[test]
    fn arguments_default_to_the_window() {
        let words = |line: &str| {
            let arguments = with_default_command(line.split_whitespace().map(OsString::from).collect());
            arguments
                .expect("no mistyped command")
                .iter()
                .map(|word| word.to_string_lossy().into_owned())
                .collect::<Vec<_>>()
                .join(" ")
        };
        assert_eq!(words("rasterscope"), "rasterscope view", "nothing at all");
        assert_eq!(words("rasterscope a.svg"), "rasterscope view a.svg", "a path");
        assert_eq!(
            words("rasterscope --headless"),
            "rasterscope view --headless",
            "an option of view"
        );
        assert_eq!(
            words("rasterscope render a.svg"),
            "rasterscope render a.svg",
            "a command"
        );
        assert_eq!(words("rasterscope --help"), "rasterscope --help", "the help");
        for line in ["rasterscope rendr.svg", "rasterscope ./rendr", "rasterscope teapot"] {
            assert_eq!(words(line), line.replace("scope ", "scope view "), "a path");
        }
    }
}
