//! How a scene is read and sampled: the options of every command that draws.

use clap::{Args, Parser};

use crate::cli::failure::one_line;
use crate::color::{ResolveSpace, Rgba};
use crate::geometry::View;
use crate::raster::{SamplePattern, SampleRate};
use crate::render::{RenderSettings, Visualisation};
use crate::rules::Rules;
use crate::scene::DialectChoice;
use crate::texture::{Anisotropy, Derivatives, FixedLevel, LevelOfDetail, LevelSampling, LodBias, PixelSampling};

/// How a scene is read and sampled.
#[derive(Clone, Debug, Args)]
pub(in crate::cli) struct SamplingOptions {
    /// Samples per pixel: a square number up to 256; with the patterns halton and r2 any number up to that
    #[arg(long, default_value = "1", value_name = "N", value_parser = sample_rate)]
    pub(in crate::cli) sample_rate: SampleRate,
    /// Where the samples of a pixel lie
    #[arg(long, default_value = SamplePattern::default().name(), value_enum)]
    pub(in crate::cli) pattern: SamplePattern,
    /// How a texture is read inside a mip level
    #[arg(long, default_value = PixelSampling::default().name(), value_enum)]
    pub(in crate::cli) pixel_sampling: PixelSampling,
    /// Which mip levels of a texture are read
    #[arg(long, default_value = LevelSampling::default().name(), value_enum)]
    pub(in crate::cli) level_sampling: LevelSampling,
    /// The most taps along a footprint that is longer than wide: 1 (off) to 64
    #[arg(long, default_value = "1", value_name = "N", value_parser = anisotropy)]
    pub(in crate::cli) anisotropy: Anisotropy,
    /// Levels added to a texture's level of detail: -16 to 16
    #[arg(long, default_value = "0", value_name = "B", value_parser = lod_bias, allow_hyphen_values = true)]
    pub(in crate::cli) lod_bias: LodBias,
    /// The level of detail instead of the footprint's: 0 to 16 [default: the footprint's]
    #[arg(long, value_name = "L", value_parser = lod_level, allow_hyphen_values = true)]
    pub(in crate::cli) lod_level: Option<FixedLevel>,
    /// Whether a footprint is a pixel's or a sample's
    #[arg(long, default_value = Derivatives::default().name(), value_enum)]
    pub(in crate::cli) lod_per: Derivatives,
    /// white, transparent or #RRGGBB
    #[arg(long, default_value = "white", value_name = "COLOUR", value_parser = background)]
    pub(in crate::cli) background: Rgba,
    /// How documents are read
    #[arg(long, default_value = DialectChoice::default().name(), value_enum)]
    pub(in crate::cli) dialect: DialectChoice,
    /// In which values the samples of a pixel are averaged
    #[arg(long, default_value = ResolveSpace::default().name(), value_enum)]
    pub(in crate::cli) resolve: ResolveSpace,
    /// What the pixels show; all but colour come with a legend
    #[arg(long, default_value = Visualisation::default().name(), value_enum, value_name = "WHAT")]
    pub(in crate::cli) visualise: Visualisation,
    /// Whose conventions decide edges, texels and bytes
    #[arg(long, default_value = Rules::default().name(), value_enum)]
    pub(in crate::cli) rules: Rules,
}

impl SamplingOptions {
    /// How documents are read: the course's rules ask for the course's dialect where nothing else is said.
    pub(in crate::cli) fn reading(&self) -> DialectChoice {
        match (self.dialect, self.rules) {
            (DialectChoice::Auto, Rules::Course) => DialectChoice::Course,
            (dialect, _) => dialect,
        }
    }

    /// Which options do not go together, and the cure.
    pub(in crate::cli) fn refusal(&self) -> Option<String> {
        let refusal = self.pattern.refusal(self.sample_rate)?;
        Some(format!("--sample-rate {}: {refusal}", self.sample_rate.samples()))
    }

    /// The same as settings of the engine; the outline belongs to every view but the canvas view.
    pub(in crate::cli) fn settings(&self, view: View) -> RenderSettings {
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
    let sampling = read.map_err(|error| one_line(&error.to_string()))?.sampling;
    match sampling.refusal() {
        Some(refusal) => Err(one_line(&refusal)),
        None => Ok(sampling),
    }
}

fn sample_rate(text: &str) -> Result<SampleRate, String> {
    let rate = text.parse().ok().and_then(SampleRate::new);
    rate.ok_or_else(|| "the sample rate is a whole number from 1 to 256".to_owned())
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
