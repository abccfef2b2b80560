//! The report on a pixel, in numbers: what [`super::Explanation::new`] finds out.
//!
//! Colours are premultiplied `[red, green, blue, alpha]` in `0.0..=255.0`, as samples store them (in steps of 1/256),
//! unless a field says otherwise. Samples are numbered from 0 in the order of their pattern, paints from 0 in painter's
//! order. `rasterscope inspect --json` prints these types as they are: a change of any name or meaning is another
//! [`VERSION`].

use serde::Serialize;

use super::area_use::{AreaUse, SummedBox};
use super::smoothing::Smoothing;
use super::tie::Tie;
use crate::color::ResolveSpace;
use crate::texture::Wrap;

/// The version of the shape of the report.
pub const VERSION: u32 = 1;

/// Why one pixel has its colour.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Explanation {
    /// [`VERSION`].
    pub version: u32,
    /// The pixel, `[x, y]` in the frame.
    pub pixel: [u32; 2],
    /// Width and height of the frame in pixels.
    pub size: [u32; 2],
    /// The pixel's centre in user coordinates.
    pub user: [f64; 2],
    /// Its colour: straight red, green, blue, alpha.
    pub color: [u8; 4],
    /// The same in hexadecimal, `#RRGGBB`, or `#RRGGBBAA` where it is not opaque.
    pub hex: String,
    /// How its samples became this colour.
    pub resolve: Resolve,
    /// What was done to the finished pixel after that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smoothing: Option<Smoothing>,
    /// Whether exact areas of the pixel are covered: it has no samples then, but one colour, which stands as its only one.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub exact: bool,
    /// Where areas are covered, neighbours between which what is below shows through.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub conflation: Option<Conflation>,
    /// Its samples when everything is painted.
    pub samples: Vec<Sample>,
    /// Everything that painted any of them, first to last; of more than some hundred the last ones, and those that samples
    /// show.
    pub paints: Vec<Paint>,
    /// How many paints there are besides.
    pub unlisted: usize,
    /// Samples that an edge in 32-bit floats leaves open; there are some by the float rules only.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pinholes: Vec<Pinhole>,
    /// What covers parts of the pixel and none of its samples.
    pub missed: Vec<Missed>,
    /// What the pixel should be, and what brings it nearer; `None` where nobody asked, or there is too much to draw.
    pub truth: Option<Truth>,
    /// Where there is too much: how many corners would have to be drawn for each setting.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub untried: Option<usize>,
    /// What the document asks for and no picture has, the truth neither: the first of it, such as `filter, line 3`, and how much there
    /// is besides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub not_drawn: Option<NotDrawn>,
}

/// What the document asks for and no picture has.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NotDrawn {
    /// The name of the element, attribute or property.
    pub name: Box<str>,
    /// Where it stands first.
    pub line: u32,
    /// How many other names there are.
    pub others: usize,
}

/// Primitives that cover all of a pixel together, without overlap, where areas are covered.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Conflation {
    /// Their numbers among the paints.
    pub paints: Vec<usize>,
    /// The part of what is below that shows through all the same.
    pub through: f64,
    /// The part that shows through by their opacity, wherever they lie.
    pub by_opacity: f64,
}

/// How samples became a pixel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Resolve {
    /// In which values samples are averaged: `stored`, or `linear` light. There red, green and blue of the sums and the mean
    /// are light, weighted by alpha and scaled to `0.0..=255.0`; the colour is the mean divided by its alpha and encoded.
    pub space: &'static str,
    /// The sums of the samples' channels; of samples that are weighted already where there is an [`Resolve::around`].
    pub sums: [f64; 4],
    /// Of how many samples, of this pixel and of others.
    pub samples: usize,
    /// What each sample weighs; 1 where they are weighted already.
    pub weight: f64,
    /// Sums times weight. What lies beyond black, white or the opacity is clamped then.
    pub mean: [f64; 4],
    /// What was done with fractions.
    pub rounding: Rounding,
    /// Whether shaded samples were summed before they were rounded to 1/256, so that the sums may differ a little from
    /// those of [`Explanation::samples`].
    pub summed_exactly: bool,
    /// What is taken of which pixels, where a filter takes samples of the neighbours too.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub around: Option<Around>,
}

/// What a pixel takes of the pixels around it, by a filter that is wider than a pixel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Around {
    /// The filter's name.
    pub filter: &'static str,
    /// How far from the pixel's middle samples weigh anything, in pixels.
    pub radius: f64,
    /// Whether what samples weigh by their places adds up to less than an eighth of what even weights do, so that the pixel is the
    /// mean of its own samples instead.
    pub is_own_mean: bool,
    /// The pixels of which anything is taken, row by row; this one is among them.
    pub pixels: Vec<Taken>,
}

/// What a pixel takes of another one, or of itself.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Taken {
    /// How many columns to the right and how many rows below it lies.
    pub beside: [i32; 2],
    /// What its samples weigh together. Those of all pixels are 1.
    pub weight: f64,
    /// What they add to the mean.
    pub adds: [f64; 4],
    /// What each of its samples weighs, in the order of the pattern.
    pub weights: Vec<f64>,
    /// What each of them shows.
    pub colors: Vec<[f64; 4]>,
}

/// What a pixel should be, and how to come nearer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Truth {
    /// The pixel's true colour, straight red, green, blue, alpha: of 256 samples, each of which reads level 0 of its texture,
    /// weighted and averaged as the picture's are.
    pub color: [u8; 4],
    /// How far the pixel is from it: the largest difference of a channel in levels, of premultiplied colours.
    pub distance: f64,
    /// How far from it as many samples of another pattern are: what is nearer than that is not told from the truth.
    pub unsure: f64,
    /// The settings that bring it nearer, the best first; each alone.
    pub cures: Vec<Cure>,
    /// What the distance comes of.
    #[serde(skip)]
    pub causes: Causes,
}

/// By how many levels a pixel would be nearer to the truth if it were not for something: what may be told as the reason.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Causes {
    /// Primitives that pass between the samples and are thinner than these are apart.
    pub thin: MissedCause,
    /// All primitives that cover a part of the pixel and none of its samples.
    pub missed: MissedCause,
    /// The topmost primitive that is seen.
    pub topmost: f64,
    /// How much of the pixel each primitive covers, as if each had one colour in it.
    pub coverage: f64,
    /// Textures that differ within the pixel.
    pub textures: f64,
    /// What levels and taps average before it is read: as many samples as the truth has of them are as far from it.
    pub averaging: f64,
    /// The paint whose colour is farthest from its true one: the place where it is shaded is the reason.
    pub off_color: Option<usize>,
    /// The same of those that read textures.
    pub off_texture: Option<usize>,
}

/// What the samples miss.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MissedCause {
    /// By how many levels the pixel is nearer to what else there is.
    pub levels: f64,
    /// The part of the truth's samples that show it, `0.0..=1.0`: what lies above, clip paths and masks take their part away.
    pub part: f64,
    /// The area of it all, where it is that part.
    pub area: Option<f64>,
    /// Whether all of it is shorter than samples are apart: a dot, and no line.
    pub small: bool,
}

/// A setting that brings a pixel nearer to the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cure {
    /// Which setting.
    pub setting: Setting,
    /// Its value, as the command line has it.
    pub value: String,
    /// The pixel's colour with it, straight red, green, blue, alpha.
    pub color: [u8; 4],
    /// By how many levels it is nearer.
    pub nearer: f64,
    /// How many samples it takes, where it leaves the rate in use: the number that a pattern of somebody's own brings goes with that,
    /// and where areas are covered, few samples are no match for them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples: Option<u32>,
    /// The dialect that goes with the rules, where the scene is read as the course's: on a command line its rules alone choose
    /// its dialect, too.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dialect: Option<&'static str>,
}

/// The settings that are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Setting {
    /// Whose conventions.
    Rules,
    /// A fixed level of detail.
    LodLevel,
    /// What is added to the level of detail.
    LodBias,
    /// Between mip levels.
    LevelSampling,
    /// Along a footprint.
    Anisotropy,
    /// Between which points footprints are measured.
    LodPer,
    /// What of a footprint counts.
    LodBy,
    /// In which values mip levels are averaged.
    Pyramid,
    /// By which filter mip levels are made.
    PyramidFilter,
    /// Inside a mip level.
    PixelSampling,
    /// Samples per pixel.
    SampleRate,
    /// Where they lie.
    Pattern,
    /// How often primitives are shaded in a pixel.
    ShadingRate,
    /// What is done to finished pixels.
    PostProcess,
    /// What tells how much of a pixel a primitive covers.
    Coverage,
}

impl Explanation {
    /// The colour that its samples became, before anything was done to the finished pixel.
    pub fn resolved(&self) -> [u8; 4] {
        self.smoothing.as_ref().map_or(self.color, |smoothing| smoothing.before)
    }
}

impl Resolve {
    /// [`Resolve::space`] as a setting.
    pub fn space(&self) -> ResolveSpace {
        let named = ResolveSpace::ALL.into_iter().find(|space| space.name() == self.space);
        named.unwrap_or_default()
    }
}

/// How fractions of a level become whole ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rounding {
    /// To the nearest level.
    Nearest,
    /// Down, by the course's rules.
    Truncated,
}

/// One sample.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sample {
    /// Its place in the pixel, `[0, 0]` the top left corner, `[1, 1]` the bottom right.
    pub position: [f64; 2],
    /// Its colour after all painting.
    pub color: [f64; 4],
    /// The same as a pixel would have it: straight red, green, blue, alpha.
    pub bytes: [u8; 4],
    /// The paints that touched it, first to last.
    pub stack: Vec<usize>,
    /// How many more did that are not listed.
    pub unlisted: usize,
    /// The primitive that is seen there; on top where several shine through. `None` where it is the background.
    pub seen: Option<usize>,
}

/// A primitive that painted samples, or the beginning or end of a layer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Paint {
    /// What it is.
    pub shape: Shape,
    /// Where it stands in the document; `None` for the outline around the canvas.
    pub source: Option<Source>,
    /// Index into the scene's primitives; one beyond the last for the outline.
    pub primitive: u32,
    /// How many layers it lies in.
    pub layers: usize,
    /// Whether it is part of a clip path or mask, and so not seen itself.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub in_mask: bool,
    /// Whether it is one of the triangles that an outline was cut into: [`Paint::area`] is that of all of them.
    #[serde(skip)]
    pub is_cut: bool,
    /// The samples that it painted.
    pub fragments: Vec<Fragment>,
    /// What every sample of the pixel sees of it, in the order of samples; empty for what has neither edges nor windings.
    pub views: Vec<View>,
    /// Where it was shaded for all of its samples, if not at each: `[0, 0]` is the pixel's top left corner, `[1, 1]` its bottom
    /// right one. What [`Paint::views`] tell of weights and colours is found there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shaded_at: Option<[f64; 2]>,
    /// How it reads its texture.
    pub texture: Option<Texture>,
    /// The gradient that fills it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gradient: Option<GradientUse>,
    /// The pattern that fills it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pattern: Option<PatternUse>,
    /// The part of the pixel by which it was composited, `0.0..=1.0`, where areas are covered.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub covered: Option<f64>,
    /// The part of the pixel that it covers in truth, `0.0..=1.0`.
    pub area: Option<f64>,
    /// Of the topmost one that is seen, where it does not cover all of the pixel: how wide it is there and beside it in its
    /// thinnest direction, in pixels, with the triangles that continue it in its paint.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    /// Of the same one how long it is: the longer side of the box around it.
    #[serde(skip)]
    pub length: Option<f64>,
}

/// What paints.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Shape {
    /// A triangle, or what clipping left of one.
    Triangle {
        /// Its corners as snapped to the sub-pixel grid, in pixels of the frame.
        corners: [[f64; 2]; 3],
    },
    /// A polygon.
    Polygon {
        /// The fill rule: `nonzero` or `evenodd`.
        rule: &'static str,
        /// Whether its edges stand for curves, and are as fine as the view needs.
        #[serde(skip_serializing_if = "std::ops::Not::not")]
        curved: bool,
        /// Whether it is the stroke of a path.
        #[serde(skip_serializing_if = "std::ops::Not::not")]
        stroke: bool,
        /// Whether it covers whole pixels, those whose middles it holds (`shape-rendering`).
        #[serde(skip_serializing_if = "std::ops::Not::not")]
        crisp: bool,
    },
    /// A line one pixel wide, or a point: whole pixels, whatever the samples.
    WholePixel,
    /// The outline around the canvas: whole pixels too.
    CanvasOutline,
    /// The beginning of a layer, which is transparent.
    BeginLayer,
    /// The end of a layer, which is painted over what lies below it.
    EndLayer {
        /// `0.0..=1.0`.
        opacity: f64,
        /// How its colours are mixed with those below, where not by source over.
        #[serde(skip_serializing_if = "Option::is_none")]
        blend: Option<&'static str>,
    },
    /// The end of a clip path: what lies below stays where the path covers a sample.
    EndClip,
    /// The end of a mask: what lies below stays as far as the mask lets it.
    EndMask {
        /// What of the mask counts: `luminance` or `alpha`.
        by: &'static str,
    },
}

/// A place in the document.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Source {
    /// The element's name.
    pub element: String,
    /// Its `id`.
    pub id: Option<String>,
    /// The scene's file or address.
    pub file: String,
    /// Line and column of its start tag, from 1.
    pub line: u32,
    /// See `line`.
    pub column: u32,
    /// Line of the `use` that put it here, if one did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub used: Option<u32>,
    /// The line itself, where the document was kept; of one longer than 200 characters an excerpt around the element.
    pub text: Option<String>,
}

/// What a paint did to one sample.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fragment {
    /// Number of the sample.
    pub sample: usize,
    /// What was painted.
    pub color: [f64; 4],
    /// What the sample held before.
    pub before: [f64; 4],
    /// What it holds then.
    pub after: [f64; 4],
    /// Whether anything of it is seen in the end.
    pub seen: bool,
}

/// What one sample sees of a primitive.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum View {
    /// Of a triangle.
    Triangle {
        /// The edges from corner A to B, B to C, C to A.
        edges: [Edge; 3],
        /// Barycentric weights of A, B and C; below zero outside.
        weights: [f64; 3],
        /// What is interpolated there.
        value: Interpolated,
    },
    /// Of a polygon.
    Polygon {
        /// How often its contours run clockwise around the sample.
        winding: i32,
        /// What its gradient shows there.
        #[serde(skip_serializing_if = "Interpolated::is_flat")]
        value: Interpolated,
    },
}

/// An edge function at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Edge {
    /// In square units of the sub-pixel grid: exact. Above zero on the triangle's side.
    pub value: i64,
    /// By the float rules, the same in 32-bit floats and square pixels, which is what decides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub float: Option<f32>,
    /// The distance from the edge's line in pixels, with the sign of `value`.
    pub distance: f64,
    /// What follows.
    pub verdict: Verdict,
}

/// What an edge says of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// On the triangle's side.
    Inside,
    /// On the other side.
    Outside,
    /// On the line of a top edge, which owns it.
    TieTop,
    /// On the line of a left edge, which owns it.
    TieLeft,
    /// On the line of a right or bottom edge: the neighbour owns it.
    TieNeither,
    /// On the line, and the course's rules count every line as inside.
    TieInclusive,
    /// Zero in 32-bit floats, and the float rules count that as inside for nobody.
    TieUndecided,
}

/// What a triangle interpolates at a sample.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Interpolated {
    /// Nothing: one colour.
    Flat,
    /// The colours of the corners.
    Color {
        /// Straight red, green, blue, alpha, `0.0..=1.0`.
        rgba: [f64; 4],
    },
    /// Texels of a tile that is repeated.
    Pattern {
        /// Column and row of the copy of the tile.
        copy: [i64; 2],
        /// Width and height of the tile in texels.
        size: [u32; 2],
        /// The texels read there.
        texels: Vec<TileTexel>,
    },
    /// A place on the ramp of a gradient.
    Gradient {
        /// Where, before spreading: 0 at the ramp's beginning, 1 at its end.
        t: f64,
        /// Where on the ramp that is, `0.0..=1.0`.
        at: f64,
        /// The two stops around it, numbered from 0; the same one twice where nothing is mixed.
        stops: [RampStop; 2],
        /// What the second one weighs.
        weight: f64,
        /// The mixed colour: straight red, green, blue, alpha, `0.0..=1.0`.
        rgba: [f32; 4],
    },
    /// No place on the ramp: none of a radial gradient's circles goes through the sample.
    OffRamp,
    /// Texture coordinates.
    Texture {
        /// `[u, v]`.
        uv: [f64; 2],
        /// Where that is in a texture that goes on beyond its border; `None` inside of it, and where it ends there.
        #[serde(skip_serializing_if = "Option::is_none")]
        wrapped: Option<Wrapped>,
        /// The box whose mean is read, of a summed-area table; one of thousands of texels has none of them in `texels`.
        #[serde(skip_serializing_if = "Option::is_none")]
        summed: Option<Box<SummedBox>>,
        /// The points around which texels were read.
        taps: Vec<Tap>,
        /// The texels read there.
        texels: Vec<Texel>,
    },
}

/// A place of a texture that goes on beyond its border.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Wrapped {
    /// Column and row of the copy in which it lies; the texture itself is (0, 0).
    pub copy: [f64; 2],
    /// `[u, v]` in that copy.
    pub uv: [f64; 2],
    /// Whether the copy is turned round along each.
    pub turned: [bool; 2],
}

/// A stop of a gradient.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RampStop {
    /// Its number, from 0.
    pub number: usize,
    /// Its place, `0.0..=1.0`.
    pub offset: f32,
    /// Its colour as style sheets have it: straight red, green, blue, alpha.
    pub color: [u8; 4],
}

/// A texel of a pattern's tile that was read.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TileTexel {
    /// Column and row.
    pub at: [u32; 2],
    /// Straight red, green, blue, alpha.
    pub color: [u8; 4],
    /// Its part of the colour that was read; cubic kernels weigh some texels below zero.
    pub weight: f64,
}

/// What fills a polygon with a pattern.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PatternUse {
    /// Where it stands in the document.
    pub source: Source,
    /// Width and height of a tile in its own units.
    pub tile: [f64; 2],
    /// Multiplies the tile's own opacity.
    pub opacity: f64,
}

/// What fills a polygon with a gradient.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GradientUse {
    /// Where it stands in the document.
    pub source: Source,
    /// What lies beyond its ends: `pad`, `reflect` or `repeat`.
    pub spread: &'static str,
    /// How many stops it has.
    pub stops: usize,
}

/// A point of a mip level around which texels were read.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Tap {
    /// Number of the level.
    pub level: usize,
    /// In texels from the corner of the level's first texel.
    pub at: [f64; 2],
}

/// A texel that was read.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Texel {
    /// Number of its level.
    pub level: usize,
    /// Column and row.
    pub at: [u32; 2],
    /// Premultiplied red, green, blue, alpha.
    pub color: [u8; 4],
    /// Its part of the colour that was read; cubic kernels weigh some texels below zero.
    pub weight: f64,
}

/// How a triangle reads its texture: the same at all its samples.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Texture {
    /// Its name in the document, or its file.
    pub name: String,
    /// Index into the scene's textures.
    pub index: u32,
    /// Width and height of the base level, in texels.
    pub size: [u32; 2],
    /// How it is read inside a level: `nearest`, `bilinear`, or by the cubic kernel `catmull-rom`, `b-spline` or `mitchell`.
    pub pixel_sampling: &'static str,
    /// What it shows beyond its border: `clamp`, `repeat` or `mirror`.
    #[serde(skip_serializing_if = "is_clamp")]
    pub wrap: &'static str,
    /// Whether the document asks for that (`image-rendering`), so that the setting has no effect.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub asked: bool,
    /// How levels are chosen: `zero`, `nearest` or `linear`; or by what an area is weighed: `ewa`, `summed-area` or `ripmap`.
    pub level_sampling: &'static str,
    /// The way in base texels of one step to the right; a pixel, or a sample.
    pub right: [f64; 2],
    /// The same of one step down.
    pub down: [f64; 2],
    /// What a step is: `pixel` or `sample`.
    pub step: &'static str,
    /// The longer of the two, in texels, and the shorter.
    pub major: f64,
    /// See `major`.
    pub minor: f64,
    /// What of the footprint the level of detail follows: `longer`, `area` or `shorter`; more taps than one do not ask.
    pub extent: &'static str,
    /// Taps along the longer one.
    pub taps: u32,
    /// The level of detail as computed; `None` where it is infinite, as for a constant `(u, v)`.
    pub level_of_detail: Option<f64>,
    /// The same clamped to the levels that there are.
    pub clamped: f64,
    /// What was added to it.
    #[serde(skip_serializing_if = "is_zero")]
    pub bias: f64,
    /// Whether the settings say it, whatever the footprint.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub fixed: bool,
    /// The levels that are read; those of a ripmap have its numbers.
    pub levels: Vec<Level>,
    /// What each sample weighs, where that is an area instead of texels around points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area: Option<AreaUse>,
    /// In which values coarser levels were averaged: `stored` or `linear`.
    pub pyramid: &'static str,
    /// By which filter: `box`, `tent` or `kaiser`.
    pub pyramid_filter: &'static str,
    /// Multiplies what is read, `0.0..=1.0`.
    pub opacity: f64,
}

/// A mip level that is read.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Level {
    /// Its number; 0 is the base.
    pub number: usize,
    /// Width and height in texels.
    pub size: [u32; 2],
    /// Its part of the colour, `0.0..=1.0`.
    pub weight: f64,
}

/// A primitive that covers a part of the pixel and none of its samples.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "facts that do not depend on each other, as JSON tells them"
)]
pub struct Missed {
    /// Where it stands in the document.
    pub source: Source,
    /// Index into the scene's primitives.
    pub primitive: u32,
    /// Whether it is one of the triangles that its element is painted as.
    pub part: bool,
    /// Whether it is the stroke of a path.
    pub stroke: bool,
    /// Whether it has one sample per pixel, the pixel's middle, at every rate.
    pub crisp: bool,
    /// Whether it is a part of a clip path or mask.
    pub in_mask: bool,
    /// The part of the pixel that it covers in truth, `0.0..=1.0`.
    pub area: f64,
    /// The part of the truth's samples that show it: not what is hidden, clipped or masked; of a part of a clip path or mask, those
    /// that it changes. `None` where there is no truth, or none of its samples is met.
    pub shown: Option<f64>,
    /// How wide it is here in its thinnest direction, in pixels, with the triangles that continue it in its paint: in the pixel and
    /// up to two samples' distances beside it.
    pub width: f64,
    /// How long it is: the longer side of the box around it.
    #[serde(skip)]
    pub length: f64,
    /// The samples that lie exactly on its edge.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ties: Vec<Tie>,
}

/// A sample that is a triangle's by the standard rules, and by the float rules is not: what lies below shows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pinhole {
    /// Number of the sample.
    pub sample: usize,
    /// Where the triangle stands in the document.
    pub source: Source,
    /// Index into the scene's primitives.
    pub primitive: u32,
    /// Its corners, in pixels of the frame.
    pub corners: [[f64; 2]; 3],
    /// Its edges there.
    pub edges: [Edge; 3],
}

/// Nothing is added.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde gives references")]
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

/// Whether a texture ends at its border.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde gives references")]
fn is_clamp(wrap: &&'static str) -> bool {
    *wrap == Wrap::Clamp.name()
}

impl Verdict {
    /// Whether the sample is the triangle's, as far as this edge is concerned.
    pub fn is_inside(self) -> bool {
        !matches!(self, Self::Outside | Self::TieNeither | Self::TieUndecided)
    }

    /// Whether the sample lies on the line.
    pub fn is_tie(self) -> bool {
        !matches!(self, Self::Inside | Self::Outside)
    }
}

impl Shape {
    /// Whether it is the beginning or the end of a layer.
    pub fn is_layer_mark(&self) -> bool {
        match self {
            Self::BeginLayer | Self::EndLayer { .. } | Self::EndClip | Self::EndMask { .. } => true,
            Self::Triangle { .. } | Self::Polygon { .. } | Self::WholePixel | Self::CanvasOutline => false,
        }
    }
}

impl Interpolated {
    /// Whether nothing is interpolated.
    fn is_flat(&self) -> bool {
        *self == Self::Flat
    }
}
