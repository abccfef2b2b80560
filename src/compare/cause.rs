//! What other renderers are known to do otherwise: in words, in which combinations, and to a finished frame.

use std::fmt;
use std::mem::discriminant;

use crate::color::{ResolveSpace, linear_to_srgb, srgb_to_linear, unit_to_byte};
use crate::geometry::View;
use crate::post::PostProcess;
use crate::raster::{Framebuffer, PixelCoverage, SamplePattern, SampleRate, ShadingRate};
use crate::render::Subject;
use crate::rules::Rules;
use crate::texture::{LevelSampling, PixelSampling};

/// Something that another renderer does otherwise than ours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cause {
    /// The canvas fills the picture, without a margin and an outline: [`View::Canvas`].
    Filled,
    /// Nothing is painted behind the scene.
    TransparentBackground,
    /// Everything is moved to the right and down by these pixels.
    Shifted([f64; 2]),
    /// Samples lie in a corner of their cells, which are pixels where there is one sample in each. Shapes are then seen as
    /// if they were shifted; hairlines and points, which have no samples, stay.
    Corners(CellCorner),
    /// It follows these rules.
    Rules(Rules),
    /// Bytes are truncated where ours are rounded.
    Truncated,
    /// It takes this many samples.
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
    /// The samples of a pixel were averaged in these values.
    Resolve(ResolveSpace),
    /// So often a primitive is shaded in a pixel.
    Shading(ShadingRate),
    /// What tells how much of a pixel a primitive covers.
    Coverage(PixelCoverage),
    /// What is done to finished pixels; SMAA to those of one sample.
    PostProcess(PostProcess),
}

/// The corner of a sample's cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellCorner {
    /// Where the cell begins: the half that leads to its centre was not added.
    UpperLeft,
    /// Where it ends.
    LowerRight,
}

impl Cause {
    /// Whether it may be tried together with `others`: one of a kind.
    pub(super) fn goes_with(self, others: &[Self]) -> bool {
        !others.iter().any(|other| other.is_akin(self))
    }

    /// Whether both are of a kind: places, curves, or the same thing with another value.
    pub(super) fn is_akin(self, other: Self) -> bool {
        let place = |cause: Self| matches!(cause, Self::Shifted(_) | Self::Corners(_));
        let curve = |cause: Self| matches!(cause, Self::EncodedTwice | Self::NotEncoded);
        let both = |kind: &dyn Fn(Self) -> bool| kind(self) && kind(other);
        discriminant(&self) == discriminant(&other) || both(&place) || both(&curve)
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Filled => f.write_str("the canvas fills the picture, without a margin (view canvas)"),
            Self::TransparentBackground => f.write_str("a transparent background (background transparent)"),
            Self::Shifted([x, y]) => write!(f, "shifted by {x:+} pixels across and {y:+} down"),
            Self::Corners(CellCorner::UpperLeft) => {
                f.write_str("samples in the upper left corners, not in the centres (+ 0.5 forgotten)")
            }
            Self::Corners(CellCorner::LowerRight) => {
                f.write_str("samples in the lower right corners, not in the centres")
            }
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
            Self::Resolve(ResolveSpace::Linear) => f.write_str("gamma: samples mixed in linear light"),
            Self::Resolve(ResolveSpace::Stored) => f.write_str("gamma: samples mixed in stored values"),
            Self::Shading(ShadingRate::Sample) => f.write_str("supersampling: a colour for each sample"),
            Self::Shading(ShadingRate::Centre) => {
                f.write_str("multisampling: one colour for all samples of a pixel, that of its centre")
            }
            Self::Shading(ShadingRate::Centroid) => f.write_str(
                "multisampling: one colour for all samples of a pixel, that of the centroid of the covered ones",
            ),
            Self::Coverage(PixelCoverage::Exact) => {
                f.write_str("exact coverage: the area of each shape, as vector renderers do")
            }
            Self::Coverage(PixelCoverage::Sampled) => f.write_str("coverage by samples instead of exact areas"),
            Self::PostProcess(PostProcess::Smaa) => f.write_str("SMAA: one sample per pixel, smoothed along edges"),
            Self::PostProcess(PostProcess::None) => f.write_str("finished pixels left as they are, without SMAA"),
        }
    }
}

/// What is worth trying of how a subject is drawn in a picture of `size` pixels, plain causes first.
pub(super) fn drawn_otherwise(subject: &Subject<'_>, size: [u32; 2]) -> Vec<Cause> {
    let settings = subject.settings;
    let mut causes = Vec::new();
    if View::Canvas.transform(subject.scene.canvas, size) != *subject.view {
        causes.push(Cause::Filled);
    }
    if settings.pattern.simplest(settings.sample_rate) == SamplePattern::Grid {
        causes.extend([CellCorner::UpperLeft, CellCorner::LowerRight].map(Cause::Corners));
    }
    causes.extend(others(&Rules::ALL, settings.rules).map(Cause::Rules));
    let rates: Vec<SampleRate> = [1, 4, 9, 16].into_iter().filter_map(SampleRate::new).collect();
    causes.extend(others(&rates, settings.sample_rate).map(Cause::SampleRate));
    causes.extend(others(&ResolveSpace::ALL, settings.resolve).map(Cause::Resolve));
    // A centroid is what few ask of their hardware, and what explains other renderers' rounding by chance.
    let rates = [ShadingRate::Sample, ShadingRate::Centre];
    causes.extend(others(&rates, settings.shading).map(Cause::Shading));
    causes.extend(others(&PixelCoverage::ALL, settings.coverage).map(Cause::Coverage));
    causes.extend(others(&PostProcess::ALL, settings.post_process).map(Cause::PostProcess));
    if !subject.scene.textures.is_empty() {
        causes.push(Cause::FlippedV);
        causes.extend(others(&PixelSampling::ALL, settings.pixel_sampling).map(Cause::PixelSampling));
        causes.extend(others(&LevelSampling::ALL, settings.level_sampling).map(Cause::LevelSampling));
    }
    let steps = [0.0, -0.5, 0.5, -1.0, 1.0];
    let shifts = steps.into_iter().flat_map(|y| steps.map(|x| [x, y])).skip(1);
    causes.extend(shifts.map(Cause::Shifted));
    causes
}

/// All values but one.
fn others<T: Copy + PartialEq>(all: &[T], own: T) -> impl Iterator<Item = T> {
    all.iter().copied().filter(move |value| *value != own)
}

/// What may have happened to a frame when it was finished: nothing first, then every combination.
pub(super) fn finished_otherwise() -> Vec<Vec<Cause>> {
    let mut combinations = vec![Vec::new()];
    for kind in [
        &[Cause::UpsideDown][..],
        &[Cause::SwappedChannels],
        &[Cause::EncodedTwice, Cause::NotEncoded],
    ] {
        for index in 0..combinations.len() {
            for cause in kind {
                combinations.push([combinations[index].as_slice(), &[*cause]].concat());
            }
        }
    }
    combinations.sort_by_key(Vec::len);
    combinations
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
