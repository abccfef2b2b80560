//! What other renderers are known to do otherwise: in words, in which combinations, and to a finished frame.

use std::fmt;
use std::mem::discriminant;

use crate::color::{linear_to_srgb, srgb_to_linear, unit_to_byte};
use crate::raster::{Framebuffer, SampleRate};
use crate::render::Subject;
use crate::rules::Rules;
use crate::texture::{LevelSampling, PixelSampling};

/// Something that another renderer does otherwise than ours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cause {
    /// Everything lies so many pixels further to the right and down.
    Shifted([f64; 2]),
    /// It follows these rules.
    Rules(Rules),
    /// Bytes are truncated where ours are rounded.
    Truncated,
    /// It takes so many samples.
    SampleRate(SampleRate),
    /// Textures are read so inside a mip level.
    PixelSampling(PixelSampling),
    /// These mip levels are read.
    LevelSampling(LevelSampling),
    /// Textures are upside down.
    FlippedV,
    /// The whole picture is.
    UpsideDown,
    /// Red and blue are swapped.
    SwappedChannels,
    /// The sRGB curve was applied to values that had it already: too light.
    EncodedTwice,
    /// Linear light was stored without the sRGB curve: too dark.
    NotEncoded,
    /// The samples of a pixel were mixed in linear light.
    LinearResolve,
}

impl Cause {
    /// Whether it may be tried together with `others`: one of a kind, and only one curve.
    pub(super) fn goes_with(self, others: &[Self]) -> bool {
        let curve = |cause: Self| matches!(cause, Self::EncodedTwice | Self::NotEncoded);
        let clash = |other: &Self| discriminant(other) == discriminant(&self) || curve(*other) && curve(self);
        !others.iter().any(clash)
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shifted([x, y]) => write!(f, "shifted by {x:+} pixels across and {y:+} down"),
            Self::Rules(Rules::Course) => {
                f.write_str("the course's rules: inclusive edges, truncated bytes, texels by w - 1")
            }
            Self::Rules(Rules::Standard) => {
                f.write_str("the standard rules: top-left edges, rounded bytes, the texel at the point")
            }
            Self::Rules(Rules::Float) => f.write_str("the float rules: edges in 32-bit floats without a rule for ties"),
            Self::Truncated => f.write_str("bytes truncated instead of rounded"),
            Self::SampleRate(rate) if rate.samples() == 1 => f.write_str("1 sample per pixel"),
            Self::SampleRate(rate) => write!(f, "{} samples per pixel", rate.samples()),
            Self::PixelSampling(sampling) => write!(f, "{} pixel sampling", sampling.name()),
            Self::LevelSampling(sampling) => write!(f, "{} level sampling", sampling.name()),
            Self::FlippedV => f.write_str("textures upside down (v is 1 - v)"),
            Self::UpsideDown => f.write_str("the whole picture upside down"),
            Self::SwappedChannels => f.write_str("red and blue swapped"),
            Self::EncodedTwice => f.write_str("gamma: the sRGB curve applied twice (too light)"),
            Self::NotEncoded => f.write_str("gamma: linear light stored without the sRGB curve (too dark)"),
            Self::LinearResolve => f.write_str("gamma: samples mixed in linear light"),
        }
    }
}

/// What is worth trying for a subject, plain causes first.
pub(super) fn candidates(subject: &Subject<'_>) -> Vec<Cause> {
    let settings = subject.settings;
    let mut causes = vec![
        Cause::Truncated,
        Cause::UpsideDown,
        Cause::SwappedChannels,
        Cause::EncodedTwice,
        Cause::NotEncoded,
    ];
    causes.extend(
        Rules::ALL
            .into_iter()
            .filter(|rules| *rules != settings.rules)
            .map(Cause::Rules),
    );
    let rates = [1, 4, 9, 16].into_iter().filter_map(SampleRate::new);
    causes.extend(
        rates
            .filter(|rate| *rate != settings.sample_rate)
            .map(Cause::SampleRate),
    );
    if settings.sample_rate.side() > 1 {
        causes.push(Cause::LinearResolve);
    }
    if !subject.scene.textures.is_empty() {
        causes.push(Cause::FlippedV);
        let pixel = PixelSampling::ALL
            .into_iter()
            .filter(|sampling| *sampling != settings.pixel_sampling);
        causes.extend(pixel.map(Cause::PixelSampling));
        let level = LevelSampling::ALL
            .into_iter()
            .filter(|sampling| *sampling != settings.level_sampling);
        causes.extend(level.map(Cause::LevelSampling));
    }
    causes.extend(shifts(settings.sample_rate));
    causes
}

/// By half a pixel and by a whole one in every direction, and what corners of samples' cells instead of their centres do.
fn shifts(rate: SampleRate) -> Vec<Cause> {
    let steps = [0.0, -0.5, 0.5, -1.0, 1.0];
    let mut found: Vec<[f64; 2]> = steps.into_iter().flat_map(|y| steps.map(|x| [x, y])).skip(1).collect();
    if rate.side() > 1 {
        let corner = 0.5 / f64::from(rate.side());
        found.extend([[corner, corner], [-corner, -corner]]);
    }
    found.into_iter().map(Cause::Shifted).collect()
}

/// What a cause does to a frame when it is finished; nothing for causes of how it is drawn.
pub(super) fn apply(cause: Cause, frame: &mut Framebuffer) {
    let [width, height] = [frame.width(), frame.height()].map(|side| side as usize);
    match cause {
        Cause::UpsideDown => {
            for y in 0..height / 2 {
                let (above, below) = frame.pixels_mut().split_at_mut((height - 1 - y) * width);
                above[y * width..(y + 1) * width].swap_with_slice(&mut below[..width]);
            }
        }
        Cause::SwappedChannels => map(frame, |[r, g, b]| [b, g, r]),
        Cause::EncodedTwice => through(frame, linear_to_srgb),
        Cause::NotEncoded => through(frame, srgb_to_linear),
        _ => {}
    }
}

fn through(frame: &mut Framebuffer, curve: impl Fn(f32) -> f32) {
    let table: Vec<u8> = (0..=255_u8)
        .map(|byte| unit_to_byte(curve(f32::from(byte) / 255.0), Rules::Standard))
        .collect();
    map(frame, |rgb| rgb.map(|byte| table[usize::from(byte)]));
}

fn map(frame: &mut Framebuffer, color: impl Fn([u8; 3]) -> [u8; 3]) {
    for pixel in frame.pixels_mut() {
        let [a, rgb @ ..] = pixel.to_be_bytes();
        let [r, g, b] = color(rgb);
        *pixel = u32::from_be_bytes([a, r, g, b]);
    }
}
