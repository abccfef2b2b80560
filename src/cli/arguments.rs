//! The arguments as written: commands, options, their help.

use std::ffi::{OsStr, OsString};
use std::path::PathBuf;

use clap::builder::PossibleValue;
use clap::error::ErrorKind;
use clap::{Args, CommandFactory as _, FromArgMatches as _, Parser, Subcommand, ValueEnum};

use super::axes::Lists;
use super::failure::Failure;
use super::help;
use super::recorded;
use super::size::FrameSize;
use super::sweep::Quality;
use super::view_option;
use crate::color::{ResolveSpace, Rgba};
use crate::compare::Measure;
use crate::figure::{Ground, InsetSpec};
use crate::geometry::View;
use crate::raster::{SamplePattern, SampleRate};
use crate::render::{RenderSettings, Visualisation};
use crate::rules::Rules;
use crate::scene::DialectChoice;
use crate::texture::{Anisotropy, Derivatives, FixedLevel, LevelOfDetail, LevelSampling, LodBias, PixelSampling};
use crate::viewer::{Against, NameTemplate, Restored, Theme};

/// Longest side of a window that comes back from a picture, in pixels.
const MAX_RESTORED_WINDOW: u32 = 4096;

/// See how a picture is sampled.
#[derive(Debug, Parser)]
#[command(
    name = "rasterscope",
    version,
    about = "See how a picture is sampled: a rasterizer with a pixel microscope."
)]
#[command(after_help = help::LIST)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) verb: Verb,
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
}

impl Verb {
    /// How it reads and samples scenes.
    fn sampling(&self) -> Option<&SamplingOptions> {
        match self {
            Self::View(options) => Some(&options.sampling),
            Self::Render(options) => Some(&options.picture.sampling),
            // Each panel has its own.
            Self::Sheet(_) | Self::Sweep(_) | Self::Writeup(_) | Self::Rerun(_) => None,
            Self::Lesson(options) => Some(&options.view.sampling),
            Self::Inspect(options) => Some(&options.picture.sampling),
            Self::Diff(options) => Some(&options.sampling),
            Self::Bench(options) => Some(&options.picture.sampling),
        }
    }

    /// The scene, where a picture may stand for it.
    fn scene(&mut self) -> Option<&mut PathBuf> {
        match self {
            Self::View(options) if options.paths.len() == 1 => options.paths.first_mut(),
            Self::Render(options) => Some(&mut options.scene),
            Self::Sheet(options) => Some(&mut options.scene),
            Self::Sweep(options) => Some(&mut options.scene),
            Self::Inspect(options) => Some(&mut options.scene),
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
                            carries no record, or a file or an argument is at fault.";

const DIFF_STATUS: &str = "Exit status: 0 the pictures agree within the tolerance, 1 they differ, 2 a file or an \
                           argument is at fault.";

#[derive(Clone, Debug, Args)]
pub(super) struct ViewerOptions {
    /// SVG files and folders of them, or a PNG of this program: its scene, view and settings
    pub(super) paths: Vec<PathBuf>,
    /// The window's size in device pixels [default: 1280x800]
    #[arg(long, value_name = "WxH")]
    pub(super) size: Option<FrameSize>,
    /// Compare with this from the start: `truth` (or `truth stored`, `truth linear`), `settings`, settings such as "sample-rate 16, dialect svg", or the file of a
    /// PNG or JPEG
    #[arg(long, value_name = "FILE|truth|SETTINGS", value_parser = against)]
    pub(super) against: Option<Against>,
    #[command(flatten)]
    pub(super) sampling: SamplingOptions,
    #[command(flatten)]
    pub(super) framing: FramingOptions,
    /// Panels light or dark [default: as the desktop]
    #[arg(long, value_enum)]
    pub(super) theme: Option<Theme>,
    /// The folder that screenshots go to [default: the current one]
    #[arg(long, value_name = "DIR")]
    pub(super) screenshot_dir: Option<PathBuf>,
    /// How they are called: words and {scene} {rate} {pixel} {level} {pattern} {time} [default: rasterscope-{time}]
    #[arg(long, value_name = "TEMPLATE", value_parser = NameTemplate::parse)]
    pub(super) screenshot_name: Option<NameTemplate>,
    /// Play a script from a file
    #[arg(long, value_name = "FILE", conflicts_with = "commands")]
    pub(super) script: Option<PathBuf>,
    /// Play a script, such as "key =; pin 512,300; key z; shot out.png"
    #[arg(long = "do", id = "commands", value_name = "SCRIPT")]
    pub(super) commands: Option<String>,
    /// Play the script, or save one picture of the window, without a window
    #[arg(long)]
    pub(super) headless: bool,
    /// Write a line of CSV for each picture that the window shows: what it shows, milliseconds per stage
    #[arg(long, value_name = "FILE", conflicts_with = "headless")]
    pub(super) frame_log: Option<PathBuf>,
    /// Replace files of another making too: the frame log, slides; never what is read
    #[arg(long)]
    pub(super) force: bool,
    /// Device pixels per point of the panels, with --headless only
    #[arg(long, value_name = "FACTOR", value_parser = scale, requires = "headless")]
    pub(super) scale: Option<f32>,
}

#[derive(Debug, Args)]
pub(super) struct LessonOptions {
    /// A lesson in TOML, or one of the program's: six-tasks, anisotropy
    pub(super) lesson: PathBuf,
    /// Draw each step into a numbered PNG in this folder [size by default: 1600x900]
    #[arg(long, value_name = "DIR")]
    pub(super) slides: Option<PathBuf>,
    /// Draw only this step, counted from 1
    #[arg(long, value_name = "N", requires = "slides", value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) step: Option<u32>,
    #[command(flatten)]
    pub(super) view: ViewerOptions,
}

#[derive(Debug, Args)]
pub(super) struct RenderOptions {
    /// An SVG file, a folder whose scenes are all drawn, or a PNG of this program: its scene and settings
    pub(super) scene: PathBuf,
    /// The PNG file to write; for a folder, the folder to write into
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,
    /// Replace pictures of another making too, in the folder to write into; never what is read
    #[arg(long)]
    pub(super) force: bool,
    /// Leave the legend of a visualisation away
    #[arg(long)]
    pub(super) no_legend: bool,
    #[command(flatten)]
    pub(super) picture: PictureOptions,

    /// Magnify a region in a corner: X,Y is its middle in pixels, uX,Y in user units; may come several times
    #[arg(long = "inset", value_name = "X,Y[:REGION@FACTOR[:CORNER]]")]
    pub(super) insets: Vec<InsetSpec>,
}

#[derive(Clone, Debug, Args)]
pub(super) struct SheetOptions {
    /// An SVG file, a scene of the gallery, or a PNG of this program: its scene and settings
    pub(super) scene: PathBuf,
    /// The PNG file to write
    #[arg(short, long, value_name = "OUT.png")]
    pub(super) output: PathBuf,
    /// Pixels of each panel [default: squares that make the sheet 1890 pixels wide, 16 cm at 300 dpi]
    #[arg(long, value_name = "WxH")]
    pub(super) size: Option<FrameSize>,
    /// Magnify a region of every panel: X,Y is its middle in pixels, uX,Y in user units; may come several times
    #[arg(long = "inset", value_name = "X,Y[:REGION@FACTOR[:CORNER]]")]
    pub(super) insets: Vec<InsetSpec>,
    /// Dark ink on white for print, or light ink on black for slides
    #[arg(long, default_value = Ground::Light.name(), value_enum)]
    pub(super) theme: Ground,
    /// Replace panels and snippets of another making too; never what is read
    #[arg(long)]
    pub(super) force: bool,
    /// A sentence that the caption ends with
    #[arg(long, value_name = "TEXT")]
    pub(super) note: Option<String>,
    #[command(flatten)]
    pub(super) axes: Lists,
    #[command(flatten)]
    pub(super) framing: FramingOptions,
}

#[derive(Debug, Args)]
pub(super) struct SweepOptions {
    /// An SVG file, a scene of the gallery, or a PNG of this program: its scene and settings
    pub(super) scene: PathBuf,
    /// The table to write
    #[arg(long, value_name = "OUT.csv")]
    pub(super) csv: PathBuf,
    /// The chart to write [default: the table's name, ending in .png]
    #[arg(long, value_name = "OUT.png")]
    pub(super) plot: Option<PathBuf>,
    /// Replace a table or chart of another making too; never what is read
    #[arg(long)]
    pub(super) force: bool,
    /// What the chart shows over the time
    #[arg(long, default_value = Quality::default().name(), value_enum)]
    pub(super) quality: Quality,
    /// Frames whose time is taken, for each combination
    #[arg(long, default_value = "5", value_name = "K", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub(super) frames: u32,
    /// Pixels of the pictures
    #[arg(long, default_value = "1024x1024", value_name = "WxH")]
    pub(super) size: FrameSize,
    #[command(flatten)]
    pub(super) axes: Lists,
    #[command(flatten)]
    pub(super) framing: FramingOptions,
}

#[derive(Debug, Args)]
pub(super) struct WriteupOptions {
    /// Which write-up
    #[arg(value_enum, default_value = Assignment::Course.name())]
    pub(super) assignment: Assignment,
    /// The folder to write into; it is made where there is none
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,
    /// The course's scenes, with folders such as basic and texmap; those that are missing come from the gallery
    #[arg(long, value_name = "DIR")]
    pub(super) scenes: Option<PathBuf>,
    /// Your own picture, PNG or JPEG, for the task of levels
    #[arg(long, value_name = "PHOTO")]
    pub(super) own: Option<PathBuf>,
    /// Your own robot
    #[arg(long, value_name = "ROBOT.svg")]
    pub(super) robot: Option<PathBuf>,
    /// Replace files of another making too; never what is read
    #[arg(long)]
    pub(super) force: bool,
    /// Where insets look [default: OUT/pins.toml]
    #[arg(long, value_name = "FILE")]
    pub(super) pins: Option<PathBuf>,
    /// Threads that draw [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(super) threads: Option<u16>,
}

/// A write-up that the program knows the figures of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Assignment {
    /// A course on rasterization: six tasks and the competition.
    Course,
}

impl Assignment {
    const ALL: [Self; 1] = [Self::Course];

    const fn name(self) -> &'static str {
        match self {
            Self::Course => "course",
        }
    }
}

#[derive(Debug, Args)]
pub(super) struct RerunOptions {
    /// A PNG that this program wrote
    pub(super) shot: PathBuf,
    /// Compare with the picture instead of writing a file
    #[arg(long, required_unless_present = "output")]
    pub(super) check: bool,
    /// The PNG file to write
    #[arg(short, long, value_name = "OUT.png", conflicts_with = "check")]
    pub(super) output: Option<PathBuf>,
    /// The scene, where it is no longer at its place
    #[arg(long, value_name = "FILE")]
    pub(super) scene: Option<PathBuf>,
    /// Threads that draw [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(super) threads: Option<u16>,
}

#[derive(Debug, Args)]
pub(super) struct InspectOptions {
    /// An SVG file, or a scene of the gallery such as gallery:basic/test4.svg
    pub(super) scene: PathBuf,
    /// Column and row of the pixel, from 0
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pub(super) pixel: PixelPlace,
    /// The sample that is told in full of every primitive, from 1 [default: the most telling one]
    #[arg(long, value_name = "K")]
    pub(super) sample: Option<u32>,
    /// Print JSON instead of text: everything about every sample
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) picture: PictureOptions,
}

/// Column and row of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PixelPlace(pub(super) [u32; 2]);

#[derive(Debug, Args)]
pub(super) struct DiffOptions {
    /// The reference: a PNG or JPEG, or a scene (.svg, gallery:...) that is drawn at the size of B
    pub(super) a: PathBuf,
    /// What is compared with it: a PNG or JPEG of the same size
    pub(super) b: PathBuf,
    /// A PNG file to write the difference into, as a picture
    #[arg(short, long, value_name = "DIFF.png")]
    pub(super) output: Option<PathBuf>,
    /// Which difference the picture shows
    #[arg(long, default_value = Measure::default().name(), value_enum)]
    pub(super) mode: Measure,
    /// What the shown difference is multiplied with
    #[arg(long, default_value = "1", value_name = "G", value_parser = gain, allow_negative_numbers = true)]
    pub(super) gain: f32,
    /// Choose the gain that makes the largest difference the last colour
    #[arg(long, conflicts_with = "gain")]
    pub(super) normalize: bool,
    /// Levels of 255 that a channel may differ by without an exit status of 1
    #[arg(long, default_value_t = 0, value_name = "T")]
    pub(super) tolerance: u8,
    /// Most pixels of a picture; comparing takes about 16 bytes of memory for each
    #[arg(long, default_value_t = MAX_PIXELS, value_name = "N")]
    pub(super) max_pixels: u64,
    /// Print JSON instead of text
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten, next_help_heading = "How a scene is drawn")]
    pub(super) sampling: SamplingOptions,
    #[command(flatten)]
    pub(super) framing: FramingOptions,
}

/// Pixels of pictures that `diff` compares unasked: with all that it makes of them about 1.6 GB.
pub(super) const MAX_PIXELS: u64 = 100_000_000;

#[derive(Debug, Args)]
pub(super) struct BenchOptions {
    /// SVG files, or scenes of the gallery such as gallery:basic/test4.svg
    #[arg(required = true, value_name = "SCENE")]
    pub(super) scenes: Vec<PathBuf>,
    /// How often each scene is drawn
    #[arg(long, default_value_t = 30, value_name = "K", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(super) frames: u32,
    /// Print JSON instead of text: an object, or for several scenes a list of objects
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) picture: PictureOptions,
}

/// What every command that draws understands.
#[derive(Debug, Args)]
pub(super) struct PictureOptions {
    /// Pixels of the picture
    #[arg(long, default_value = "1024x1024", value_name = "WxH")]
    pub(super) size: FrameSize,
    #[command(flatten)]
    pub(super) sampling: SamplingOptions,
    #[command(flatten)]
    pub(super) framing: FramingOptions,
}

/// What part of a scene is drawn, and on how many threads.
#[derive(Clone, Debug, Args)]
pub(super) struct FramingOptions {
    /// Which part of the scene: a name, or centre, pixels per user unit and degrees
    #[arg(long, default_value = "default", value_name = "default|canvas|CX,CY,SCALE[,ROTATION]", value_parser = view_option::parse, allow_hyphen_values = true)]
    pub(super) view: View,
    /// Threads that draw or compare [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(super) threads: Option<u16>,
}

/// How a scene is read and sampled.
#[derive(Clone, Debug, Args)]
pub(super) struct SamplingOptions {
    /// Samples per pixel: a square number up to 256; with the patterns halton and r2 any number up to that
    #[arg(long, default_value = "1", value_name = "N", value_parser = sample_rate)]
    pub(super) sample_rate: SampleRate,
    /// Where the samples of a pixel lie
    #[arg(long, default_value = SamplePattern::default().name(), value_enum)]
    pub(super) pattern: SamplePattern,
    /// How a texture is read inside a mip level
    #[arg(long, default_value = PixelSampling::default().name(), value_enum)]
    pub(super) pixel_sampling: PixelSampling,
    /// Which mip levels of a texture are read
    #[arg(long, default_value = LevelSampling::default().name(), value_enum)]
    pub(super) level_sampling: LevelSampling,
    /// The most taps along a footprint that is longer than wide: 1 (off) to 64
    #[arg(long, default_value = "1", value_name = "N", value_parser = anisotropy)]
    pub(super) anisotropy: Anisotropy,
    /// Levels added to a texture's level of detail: -16 to 16
    #[arg(long, default_value = "0", value_name = "B", value_parser = lod_bias, allow_hyphen_values = true)]
    pub(super) lod_bias: LodBias,
    /// The level of detail instead of the footprint's: 0 to 16 [default: the footprint's]
    #[arg(long, value_name = "L", value_parser = lod_level, allow_hyphen_values = true)]
    pub(super) lod_level: Option<FixedLevel>,
    /// Whether a footprint is a pixel's or a sample's
    #[arg(long, default_value = Derivatives::default().name(), value_enum)]
    pub(super) lod_per: Derivatives,
    /// white, transparent or #RRGGBB
    #[arg(long, default_value = "white", value_name = "COLOUR", value_parser = background)]
    pub(super) background: Rgba,
    /// How documents are read
    #[arg(long, default_value = DialectChoice::default().name(), value_enum)]
    pub(super) dialect: DialectChoice,
    /// In which values the samples of a pixel are averaged
    #[arg(long, default_value = ResolveSpace::default().name(), value_enum)]
    pub(super) resolve: ResolveSpace,
    /// What the pixels show; all but colour come with a legend
    #[arg(long, default_value = Visualisation::default().name(), value_enum, value_name = "WHAT")]
    pub(super) visualise: Visualisation,
    /// Whose conventions decide edges, texels and bytes
    #[arg(long, default_value = Rules::default().name(), value_enum)]
    pub(super) rules: Rules,
}

impl SamplingOptions {
    /// How documents are read: the course's rules ask for the course's dialect where nothing else is said.
    pub(super) fn reading(&self) -> DialectChoice {
        match (self.dialect, self.rules) {
            (DialectChoice::Auto, Rules::Course) => DialectChoice::Course,
            (dialect, _) => dialect,
        }
    }

    /// Which options do not go together, and the cure.
    fn refusal(&self) -> Option<String> {
        let refusal = self.pattern.refusal(self.sample_rate)?;
        Some(format!("--sample-rate {}: {refusal}", self.sample_rate.samples()))
    }

    /// The same as settings of the engine; the outline belongs to every view but the canvas view.
    pub(super) fn settings(&self, view: View) -> RenderSettings {
        RenderSettings {
            sample_rate: self.sample_rate,
            pattern: self.pattern,
            pixel_sampling: self.pixel_sampling,
            level_sampling: self.level_sampling,
            anisotropy: self.anisotropy,
            detail: LevelOfDetail {
                bias: self.lod_bias,
                fixed: self.lod_level,
                derivatives: self.lod_per,
            },
            rules: self.rules,
            resolve: self.resolve,
            visualisation: self.visualise,
            background: self.background,
            outline: view != View::Canvas,
        }
    }
}

/// Gives a settings enum its names on the command line, which are its names everywhere.
macro_rules! named_values {
    ($($kind:ty),*) => {$(
        impl ValueEnum for $kind {
            fn value_variants<'a>() -> &'a [Self] {
                &Self::ALL
            }

            fn to_possible_value(&self) -> Option<PossibleValue> {
                Some(PossibleValue::new(self.name()))
            }
        }
    )*};
}

named_values!(
    Quality,
    ResolveSpace,
    SamplePattern,
    PixelSampling,
    LevelSampling,
    Derivatives,
    Rules,
    DialectChoice,
    Theme,
    Measure,
    Ground,
    Assignment
);

impl ValueEnum for Visualisation {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.name()).aliases(self.former_name()))
    }
}

fn sample_rate(text: &str) -> Result<SampleRate, String> {
    let rate = text.parse().ok().and_then(SampleRate::new);
    rate.ok_or_else(|| "the sample rate is a whole number from 1 to 256".to_owned())
}

fn pixel(text: &str) -> Result<PixelPlace, String> {
    let place = text
        .split_once(',')
        .and_then(|(x, y)| Some(PixelPlace([x.trim().parse().ok()?, y.trim().parse().ok()?])));
    place.ok_or_else(|| "a pixel is its column and row from 0, such as 300,200".to_owned())
}

fn anisotropy(text: &str) -> Result<Anisotropy, String> {
    let taps = text.parse().ok().and_then(Anisotropy::new);
    taps.ok_or_else(|| "anisotropy is a whole number from 1, which is off, to 64".to_owned())
}

fn lod_bias(text: &str) -> Result<LodBias, String> {
    let bias = text.parse().ok().and_then(LodBias::new);
    bias.ok_or_else(|| "the bias is a number of levels from -16 to 16".to_owned())
}

fn lod_level(text: &str) -> Result<FixedLevel, String> {
    let level = text.parse().ok().and_then(FixedLevel::new);
    level.ok_or_else(|| "a fixed level is a number from 0, the base, to 16".to_owned())
}

fn against(text: &str) -> Result<Against, String> {
    let against = Against::from_text(text).filter(|against| *against != Against::Nothing);
    against.ok_or_else(|| "compare with truth, \"truth stored\", \"truth linear\", settings, settings such as \"sample-rate 16, dialect svg\", or the file of a PNG or JPEG".to_owned())
}

fn gain(text: &str) -> Result<f32, String> {
    let gain = text.parse().ok().filter(|gain| (1e-6..=1e6).contains(gain));
    gain.ok_or_else(|| "the gain is a number from 0.000001 to 1000000".to_owned())
}

fn scale(text: &str) -> Result<f32, String> {
    let factor = text.parse().ok().filter(|factor| (0.5..=8.0).contains(factor));
    factor.ok_or_else(|| "the scale of the panels is a factor from 0.5 to 8".to_owned())
}

fn background(text: &str) -> Result<Rgba, String> {
    let hex = |digits: &str| {
        let value = u32::from_str_radix(digits, 16)
            .ok()
            .filter(|_| digits.len() == 6 && digits.is_ascii())?;
        let [_, r, g, b] = value.to_be_bytes();
        digits
            .bytes()
            .all(|digit| digit.is_ascii_hexdigit())
            .then(|| Rgba::from_bytes([r, g, b, 255]))
    };
    match text {
        "white" => Ok(Rgba::WHITE),
        "transparent" => Ok(Rgba::TRANSPARENT),
        _ => text
            .strip_prefix('#')
            .and_then(hex)
            .ok_or_else(|| "a background is white, transparent or #RRGGBB in hexadecimal".to_owned()),
    }
}

/// Reads the arguments, the program's name first. Where a picture that tells how it was made stands for the scene, its
/// options come before those that were written, so that these count.
pub(super) fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<(Arguments, Option<Restored>), Failure> {
    let words = with_default_command(arguments.into_iter().collect());
    let mut arguments = parse_words(words.clone(), false)?;
    let is_view = matches!(arguments.verb, Verb::View(_));
    let Some(restored) = arguments
        .verb
        .scene()
        .map_or(Ok(None), |scene| recorded::restored(scene))?
    else {
        return Ok((arguments, None));
    };
    let mut options = restored.spec.options();
    if is_view && restored.spec.size.iter().any(|side| *side > MAX_RESTORED_WINDOW) {
        // `--size` and its value: no screen is that large.
        options.drain(..2);
    }
    if matches!(arguments.verb, Verb::Render(_) | Verb::Sheet(_)) {
        options.extend(restored.spec.inset_options());
    }
    if matches!(arguments.verb, Verb::Render(_)) {
        options.extend(restored.spec.legend_option());
    }
    let command = words.len().min(2);
    let words = [
        &words[..command],
        &options.iter().map(OsString::from).collect::<Vec<_>>(),
        &words[command..],
    ]
    .concat();
    let mut arguments = parse_words(words, true)?;
    if let Some(scene) = arguments.verb.scene() {
        *scene = recorded::scene_path(&restored);
    }
    Ok((arguments, Some(restored)))
}

/// The options of sampling alone.
#[derive(Debug, Parser)]
#[command(no_binary_name = true)]
struct SamplingOnly {
    #[command(flatten)]
    sampling: SamplingOptions,
}

/// Reads options of sampling.
pub(super) fn sampling_of(words: impl Iterator<Item = String>) -> Result<SamplingOptions, String> {
    let read = SamplingOnly::try_parse_from(words);
    let sampling = read.map_err(|error| one_line(&error.to_string()))?.sampling;
    match sampling.refusal() {
        Some(refusal) => Err(one_line(&refusal)),
        None => Ok(sampling),
    }
}

/// Reads words that name a command; `repeated` allows options to come again, so that the last counts.
pub(super) fn parse_words(words: Vec<OsString>, repeated: bool) -> Result<Arguments, Failure> {
    if let Some(page) = help::page(&words) {
        return Err(Failure::Text(page));
    }
    let matches = Arguments::command()
        .args_override_self(repeated)
        .try_get_matches_from(words);
    let read = matches.and_then(|matches| Arguments::from_arg_matches(&matches));
    let arguments = read.map_err(|error| match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            Failure::Text(error.to_string())
        }
        _ => Failure::Input(one_line(&error.to_string())),
    })?;
    match arguments.verb.sampling().and_then(SamplingOptions::refusal) {
        Some(refusal) => Err(Failure::Input(one_line(&refusal))),
        None => Ok(arguments),
    }
}

/// `rasterscope PATH` means `rasterscope view PATH`.
fn with_default_command(mut arguments: Vec<OsString>) -> Vec<OsString> {
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
        arguments.insert(1.min(arguments.len()), "view".into());
    }
    arguments
}

/// What is wrong and how to find the cure, out of a message of several paragraphs.
fn one_line(message: &str) -> String {
    let message = message.strip_prefix("error: ").unwrap_or(message);
    let usage = message.find("\n\nUsage:").unwrap_or(message.len());
    let hint = message.find("\n\nFor more information").unwrap_or(message.len());
    let words: Vec<&str> = message[..usage.min(hint)].split_whitespace().collect();
    format!(
        "{}; see `rasterscope --help`",
        words.join(" ").replace(" tip: ", "; tip: ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Result<Arguments, Failure> {
        parse(line.split(' ').map(OsString::from)).map(|(arguments, _)| arguments)
    }

    #[test]
    fn arguments_are_well_formed() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn arguments_of_render_become_settings() {
        let line = "rasterscope render a.svg -o b.png --size 300x200 --sample-rate 16 --pixel-sampling bilinear \
                    --pattern jittered-same --level-sampling linear --anisotropy 16 --lod-bias -1.5 --lod-level 2.25 --lod-per sample \
                    --view=-5,10,2.5,-90 --background #ff8000 --dialect course --rules course --resolve linear --visualise mip --threads 2";
        let Ok(Arguments {
            verb: Verb::Render(options),
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
                }) => assert_eq!(options.picture.sampling.visualise, Visualisation::Color, "{name}"),
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
            "rasterscope rerun a.png",
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
        ] {
            match parsed(line) {
                Err(Failure::Input(message)) => {
                    assert!(
                        !message.contains('\n') && message.ends_with("--help`"),
                        "{line}: {message}"
                    );
                }
                other => panic!("{line}: {other:?}"),
            }
        }
    }

    #[test]
    fn arguments_that_sample_are_the_viewers_options() {
        use crate::viewer::options;
        let sampling = SamplingOptions::augment_args(clap::Command::new("options"));
        let here: Vec<&str> = sampling
            .get_arguments()
            .filter_map(|argument| argument.get_long())
            .collect();
        let there: Vec<&str> = options::names().collect();
        for name in here.iter().chain(&there) {
            let known = here.contains(name) && there.contains(name);
            assert!(
                known,
                "--{name} is written on the command line and elsewhere, or nowhere"
            );
        }
    }

    #[test]
    fn arguments_default_to_the_window() {
        let words = |line: &str| {
            let arguments = with_default_command(line.split_whitespace().map(OsString::from).collect());
            arguments
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
    }
}
