//! What a picture shows in place of colours: by which fills the primitives of a scene are replaced, and how numbers
//! become colours.
//!
//! Shapes, samples and resolve stay those of the picture: only fills change, so that a visualisation can be laid over
//! the picture pixel by pixel. All colours are told apart by people with any kind of colour vision.

use std::sync::LazyLock;

use glam::DVec2;

use super::{Screen, add, paint};
use crate::color::{Colormap, Premultiplied16, Rgba};
use crate::geometry::Polygon;
use crate::raster::{self, ChunkBuilder, RasterSettings};
use crate::rules::Rules;
use crate::scene::{Paint, PrimitiveKind, Scene};
use crate::texture::{
    Anisotropy, Footprint, LevelOfDetail, LevelSampling, MipLevel, MipPyramid, PixelSampling, Reading,
    SamplingSettings, Taps, Texture,
};

/// What the pixels of a picture show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Visualisation {
    /// The picture itself.
    #[default]
    Color,
    /// The part of the pixel's samples that any primitive covers, however transparent it is.
    Coverage,
    /// How many fragments the pixel's samples received, on average: what is painted, seen or not.
    Overdraw,
    /// Each primitive in a colour of its own.
    Primitive,
    /// The edges of all primitives over the paled picture.
    Wireframe,
    /// Barycentric weights: a triangle's three corners in three colours.
    Barycentric,
    /// Texture coordinates, clamped to the texture.
    Uv,
    /// The level of detail with which a texture is read, before it is clamped to the levels that exist.
    LevelOfDetail,
    /// Which mip levels are read: the picture with a tint for each level.
    MipLevels,
    /// How many times as long as wide a pixel's footprint is, as anisotropic filtering measures it.
    Anisotropy,
}

/// Where a primitive has no number to show.
pub(super) const NONE: u32 = 0xFF9A_9A9A;
/// Corners of a triangle, first to third (M. Okabe, K. Ito, "Color Universal Design", 2008).
pub(super) const CORNERS: [u32; 3] = [0xFFD5_5E00, 0xFF00_72B2, 0xFFF0_E442];
/// The colour at `u = 1` and that at `v = 1`; together they are white.
pub(super) const UV: [u32; 2] = [0xFFFF_9900, 0xFF00_66FF];
/// Edges of triangles, outlines of polygons, hairlines and points.
pub(super) const EDGES: [u32; 3] = [0xFF00_72B2, 0xFFD5_5E00, 0xFF00_0000];
/// The largest level of detail that has a colour of its own.
pub(super) const MOST_LEVELS: f32 = 8.0;
/// The largest number of fragments that is counted.
pub(super) const MOST_FRAGMENTS: u16 = 255 / Premultiplied16::FRAGMENT_BYTES;
/// How opaque the tint of a mip level is.
const TINT: f32 = 0.7;
/// How much of the picture below a wireframe is gone.
const PALE: f32 = 0.8;
/// Colours for things without an order (P. Tol, "Colour Schemes", SRON/EPS/TN/09-002, 2021: "muted").
const MUTED: [u32; 9] = [
    0xFF33_2288,
    0xFFDD_CC77,
    0xFF88_CCEE,
    0xFFCC_6677,
    0xFF11_7733,
    0xFF88_2255,
    0xFF44_AA99,
    0xFF99_9933,
    0xFFAA_4499,
];
/// Mip levels from 0 on: the colours of Okabe and Ito.
const LEVELS: [u32; 8] = [
    0xFF00_72B2,
    0xFF56_B4E9,
    0xFF00_9E73,
    0xFFF0_E442,
    0xFFE6_9F00,
    0xFFD5_5E00,
    0xFFCC_79A7,
    0xFF00_0000,
];

/// Counts of eighths of fragments, on a logarithmic scale: `log2(1 + fragments)`.
static OVERDRAW: LazyLock<[u32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|byte| overdraw_color(byte as f32 / f32::from(Premultiplied16::FRAGMENT_BYTES)))
});

/// Covered parts of a pixel.
static COVERAGE: LazyLock<[u32; 256]> =
    LazyLock::new(|| std::array::from_fn(|byte| Colormap::Sequential.color(byte as f32 / 255.0)));

/// A texture whose texel at `(u, v)` is the colour of `(u, v)`.
static RAMP: LazyLock<Texture> = LazyLock::new(|| {
    const SIDE: u32 = 256;
    let texels = (0..SIDE * SIDE).map(|i| {
        let part = |index: u32| index as f32 / (SIDE - 1) as f32;
        uv_color(part(i % SIDE), part(i / SIDE))
    });
    Texture {
        name: "(u, v)".to_owned(),
        pyramid: MipPyramid::build(MipLevel::new(SIDE, SIDE, texels.collect())),
    }
});

/// Replaces the fills of primitives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visualiser<'a> {
    kind: Visualisation,
    scene: &'a Scene,
    sampling: SamplingSettings,
}

impl Visualisation {
    /// Every value, in the order of menus and of the key that steps through them.
    pub const ALL: [Self; 10] = [
        Self::Color,
        Self::Coverage,
        Self::Overdraw,
        Self::Primitive,
        Self::Wireframe,
        Self::Barycentric,
        Self::Uv,
        Self::LevelOfDetail,
        Self::MipLevels,
        Self::Anisotropy,
    ];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Color => "colour",
            Self::Coverage => "coverage",
            Self::Overdraw => "overdraw",
            Self::Primitive => "primitive",
            Self::Wireframe => "wireframe",
            Self::Barycentric => "barycentric",
            Self::Uv => "uv",
            Self::LevelOfDetail => "lod",
            Self::MipLevels => "mip",
            Self::Anisotropy => "anisotropy",
        }
    }

    /// A name that it had once: scripts, and the records of pictures that were saved then, still have it.
    pub const fn former_name(self) -> Option<&'static str> {
        match self {
            Self::Color => Some("color"),
            _ => None,
        }
    }

    /// Whether the canvas' outline belongs into the picture: it is not to be counted.
    pub(super) fn has_outline(self) -> bool {
        !matches!(self, Self::Coverage | Self::Overdraw)
    }
}

/// The colour of a mean number of fragments, `0.0..=31.0`.
pub(super) fn overdraw_color(fragments: f32) -> u32 {
    Colormap::Sequential.color(logarithmic(fragments + 1.0, f32::from(MOST_FRAGMENTS) + 1.0))
}

/// The colour of a level of detail.
pub(super) fn level_of_detail_color(lod: f32) -> u32 {
    Colormap::Diverging.color(lod / MOST_LEVELS)
}

/// The colour of a footprint that is `ratio` times as long as wide.
pub(super) fn anisotropy_color(ratio: f32) -> u32 {
    Colormap::Sequential.color(logarithmic(ratio, Anisotropy::MAX as f32))
}

/// The colour of a mip level; levels after the eighth repeat the colours, half-way to white.
pub(super) fn level_color(level: usize) -> Rgba {
    shade_of(&LEVELS, level)
}

/// The colour of a primitive; after the ninth they repeat, half-way to white.
pub(super) fn primitive_color(index: usize) -> Rgba {
    shade_of(&MUTED, index)
}

/// The part that `value` is of `most` on a logarithmic scale that begins with 1.
pub(super) fn logarithmic(value: f32, most: f32) -> f32 {
    value.max(1.0).log2() / most.log2()
}

/// A pixel's colour.
pub(super) fn rgba(pixel: u32) -> Rgba {
    let [a, r, g, b] = pixel.to_be_bytes().map(|byte| f32::from(byte) / 255.0);
    Rgba { r, g, b, a }
}

fn shade_of(colors: &[u32], index: usize) -> Rgba {
    let color = rgba(colors[index % colors.len()]);
    if (index / colors.len()).is_multiple_of(2) {
        color
    } else {
        mix(color, Rgba::WHITE, 0.5)
    }
}

/// From `first` to `second`, in stored values.
fn mix(first: Rgba, second: Rgba, part: f32) -> Rgba {
    let channel = |a: f32, b: f32| a + (b - a) * part;
    Rgba {
        r: channel(first.r, second.r),
        g: channel(first.g, second.g),
        b: channel(first.b, second.b),
        a: channel(first.a, second.a),
    }
}

/// The colour of texture coordinates: that of `u` and that of `v` added up.
fn uv_color(u: f32, v: f32) -> [u8; 4] {
    let [along_u, along_v] = UV.map(rgba);
    let channel = |a: f32, b: f32| crate::color::unit_to_byte(u * a + v * b, Rules::Standard);
    [
        channel(along_u.r, along_v.r),
        channel(along_u.g, along_v.g),
        channel(along_u.b, along_v.b),
        255,
    ]
}

impl<'a> Visualiser<'a> {
    /// For the picture of a scene that is sampled like this.
    pub(super) fn new(kind: Visualisation, scene: &'a Scene, sampling: SamplingSettings) -> Self {
        Self { kind, scene, sampling }
    }

    /// What the rasterizer does otherwise than for the picture.
    pub(super) fn change(kind: Visualisation, settings: &mut RasterSettings) {
        match kind {
            Visualisation::Coverage | Visualisation::Overdraw => {
                let counted = kind == Visualisation::Overdraw;
                settings.palette = Some(if counted { &OVERDRAW } else { &COVERAGE });
                settings.background = Rgba::BLACK;
                settings.space = crate::color::ResolveSpace::Stored;
            }
            Visualisation::Uv => {
                settings.sampling.pixel = PixelSampling::Nearest;
                settings.sampling.level = LevelSampling::Zero;
                settings.sampling.anisotropy = Anisotropy::OFF;
                settings.sampling.detail = LevelOfDetail::default();
            }
            _ => {}
        }
    }

    /// The textures that fills point to.
    pub(super) fn textures(&self) -> Vec<&'a Texture> {
        match self.kind {
            Visualisation::Uv => vec![&RAMP],
            _ => self.scene.textures.iter().map(AsRef::as_ref).collect(),
        }
    }

    /// A builder that does with fragments what is shown.
    pub(super) fn prepare<'b>(&self, builder: ChunkBuilder<'b>) -> ChunkBuilder<'b> {
        match self.kind {
            Visualisation::Overdraw => builder.with_counts(),
            _ => builder,
        }
    }

    /// Adds primitive number `index`.
    pub(super) fn add(&self, builder: &mut ChunkBuilder<'_>, screen: &Screen<'_>, index: usize) {
        let kind = &self.scene.primitives[index].kind;
        match self.kind {
            Visualisation::Color | Visualisation::Wireframe => add(builder, screen, kind),
            Visualisation::Coverage | Visualisation::Overdraw => repaint(builder, screen, kind, Rgba::WHITE),
            Visualisation::Primitive => repaint(builder, screen, kind, primitive_color(index)),
            Visualisation::Barycentric => match kind {
                PrimitiveKind::Triangle { points, .. } => {
                    let points = points.map(|point| screen.place(point));
                    builder.triangle(points, &raster::Paint::vertex(CORNERS.map(rgba)));
                }
                _ => repaint(builder, screen, kind, rgba(NONE)),
            },
            Visualisation::Uv | Visualisation::LevelOfDetail | Visualisation::MipLevels | Visualisation::Anisotropy => {
                self.add_textured(builder, screen, kind);
            }
        }
    }

    /// What speaks of textures only.
    fn add_textured(&self, builder: &mut ChunkBuilder<'_>, screen: &Screen<'_>, kind: &PrimitiveKind) {
        let PrimitiveKind::Triangle {
            points,
            paint: own @ Paint::Texture { texture, uv, .. },
        } = kind
        else {
            return repaint(builder, screen, kind, rgba(NONE));
        };
        let points = points.map(|point| screen.place(point));
        let uv = uv.map(|uv| uv.to_array());
        let pyramid = &self.scene.textures[texture.0 as usize].pyramid;
        match self.kind {
            Visualisation::Uv => {
                builder.triangle(points, &raster::Paint::texture(0, uv, 1.0));
            }
            Visualisation::LevelOfDetail => builder.measured_triangle(points, uv, &|footprint| {
                rgba(level_of_detail_color(single(self.reading(footprint, pyramid).lod)))
            }),
            Visualisation::Anisotropy => builder.measured_triangle(points, uv, &|footprint| {
                rgba(anisotropy_color(single(ratio(footprint, pyramid))))
            }),
            _ => {
                builder.triangle(points, &paint(own));
                builder.measured_triangle(points, uv, &|footprint| {
                    let levels = self.reading(footprint, pyramid).levels;
                    let (finer, coarser) = (level_color(levels.level), level_color(levels.level + 1));
                    let a = TINT;
                    Rgba {
                        a,
                        ..mix(finer, coarser, levels.next_weight)
                    }
                });
            }
        }
    }

    fn reading(&self, footprint: &Footprint, pyramid: &MipPyramid) -> Reading {
        Reading::new(footprint, pyramid, &self.sampling)
    }

    /// Whether edges come on top of everything.
    pub(super) fn has_edges(&self) -> bool {
        self.kind == Visualisation::Wireframe
    }

    /// Pales what was painted so far.
    pub(super) fn add_veil(builder: &mut ChunkBuilder<'_>, size: [u32; 2], background: Rgba) {
        let [width, height] = size.map(f64::from);
        let corner = |x, y| DVec2::new(x, y);
        let (low, high) = (corner(0.0, 0.0), corner(width, height));
        // A transparent ground lets nothing shine through that a veil could pale: it is white then, as paper.
        let ground = if background.a > 0.0 { background } else { Rgba::WHITE };
        let veil = raster::Paint::solid(Rgba { a: PALE, ..ground });
        builder.triangle([low, corner(width, 0.0), high], &veil);
        builder.triangle([low, high, corner(0.0, height)], &veil);
    }

    /// Adds the edges of primitive number `index`.
    pub(super) fn add_edges(&self, builder: &mut ChunkBuilder<'_>, screen: &Screen<'_>, index: usize) {
        let [triangle, polygon, other] = EDGES.map(rgba);
        match &self.scene.primitives[index].kind {
            PrimitiveKind::Triangle { points, .. } => closed(builder, screen, points, triangle),
            PrimitiveKind::Polygon { polygon: shape, .. } => match triangles_of(shape, screen) {
                Some(triangles) => {
                    for points in triangles {
                        closed(builder, screen, points, triangle);
                    }
                }
                None => {
                    for contour in shape.contours() {
                        closed(builder, screen, contour, polygon);
                    }
                }
            },
            kind @ (PrimitiveKind::Hairline { .. } | PrimitiveKind::Point { .. }) => {
                repaint(builder, screen, kind, other);
            }
            PrimitiveKind::BeginLayer | PrimitiveKind::EndLayer { .. } => {}
        }
    }
}

/// The ratio of a footprint's sides in texels, at most [`Anisotropy::MAX`].
fn ratio(footprint: &Footprint, pyramid: &MipPyramid) -> f64 {
    let base = &pyramid.levels()[0];
    let size = DVec2::new(f64::from(base.width()), f64::from(base.height()));
    let most = Anisotropy::STEPS[Anisotropy::STEPS.len() - 1];
    Taps::new(footprint, size, most).ratio
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "what becomes a colour needs no more digits"
)]
fn single(value: f64) -> f32 {
    value as f32
}

/// The triangles that a polygon is painted as, where it is.
fn triangles_of<'p>(polygon: &'p Polygon, screen: &Screen<'_>) -> Option<&'p [[DVec2; 3]]> {
    polygon.triangles().filter(|_| screen.rules.cut_polygons())
}

/// A closed line.
fn closed(builder: &mut ChunkBuilder<'_>, screen: &Screen<'_>, points: &[DVec2], color: Rgba) {
    let mut last = points.last();
    for point in points {
        if let Some(last) = last.replace(point) {
            builder.hairline([*last, *point].map(|end| screen.place(end)), color);
        }
    }
}

/// Adds a primitive in one opaque colour; layers are left out.
fn repaint(builder: &mut ChunkBuilder<'_>, screen: &Screen<'_>, kind: &PrimitiveKind, color: Rgba) {
    match kind {
        PrimitiveKind::Triangle { points, .. } => {
            builder.triangle(points.map(|point| screen.place(point)), &raster::Paint::solid(color));
        }
        PrimitiveKind::Polygon { polygon, .. } => {
            let polygon = polygon.clone();
            add(builder, screen, &PrimitiveKind::Polygon { polygon, color });
        }
        PrimitiveKind::Hairline { ends, .. } => {
            builder.hairline(ends.map(|end| screen.place(end)), color);
        }
        PrimitiveKind::Point { at, .. } => builder.point(screen.place(*at), color),
        PrimitiveKind::BeginLayer | PrimitiveKind::EndLayer { .. } => {}
    }
}
