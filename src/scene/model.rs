//! What a document means: the types that drawing code receives.

use std::sync::Arc;

use glam::{DAffine2, DVec2, Vec2};

use super::{Report, SceneFiles, SourceLocation};
use crate::color::{BlendMode, Ramp, Rgba};
use crate::geometry::{GradientShape, Polygon};
use crate::texture::{Texture, TileCache};

/// Which reading of a document is in force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Dialect {
    /// As the course's reader: no `viewBox`, strokes are hairlines, zero-size rects are points.
    Course,
    /// As SVG 1.1 / 2.
    Svg,
}

/// A resolved document: what to paint, in painter's order, in user space.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What the document is called in messages: its file or address; empty for a scene that was made in code.
    pub name: Arc<str>,
    /// Width and height of the canvas in canvas units, finite and above zero.
    pub canvas: DVec2,
    /// The dialect the document was read in.
    pub dialect: Dialect,
    /// The other dialect, where the document may be meant in it and is another picture then.
    pub other_reading: Option<Dialect>,
    /// What the document says about itself, for people: title and description, or the comment at its start; a paragraph a line,
    /// at most 2000 characters.
    pub words: Option<Arc<str>>,
    /// The document's shapes, in document order; [`Primitive::shape`] points here.
    pub shapes: Vec<Shape>,
    /// What to paint, first to last.
    pub primitives: Vec<Primitive>,
    /// What [`Paint::Texture`] points to; the tiles of patterns share it with the scene that they are in.
    pub textures: Arc<[Arc<Texture>]>,
    /// What [`Fill::Gradient`] points to.
    pub gradients: Vec<Gradient>,
    /// What [`Fill::Pattern`] points to.
    pub patterns: Vec<Pattern>,
    /// What the document asks for and the picture lacks.
    pub report: Report,
    /// The document itself, for [`Scene::quotes`]; not kept when it is larger than 32 MB or the scene was made in
    /// code.
    pub document: Option<Arc<str>>,
    /// What it was read from.
    pub files: SceneFiles,
}

impl Scene {
    /// A canvas with nothing on it; the start of scenes that are made in code.
    pub fn empty(canvas: DVec2, dialect: Dialect) -> Self {
        Self {
            name: Arc::default(),
            canvas,
            dialect,
            other_reading: None,
            words: None,
            shapes: Vec::new(),
            primitives: Vec::new(),
            textures: Arc::default(),
            gradients: Vec::new(),
            patterns: Vec::new(),
            report: Report::default(),
            document: None,
            files: SceneFiles::default(),
        }
    }
}

impl Scene {
    /// For each primitive whether it is part of a clip path or mask, and so not seen itself; `None` where there are none.
    pub fn parts_of_masks(&self) -> Option<Vec<bool>> {
        let is_mask = |kind: &PrimitiveKind| match kind {
            PrimitiveKind::EndLayer { composite } => !matches!(composite, Composite::Over { .. }),
            _ => false,
        };
        if !self.primitives.iter().any(|primitive| is_mask(&primitive.kind)) {
            return None;
        }
        let mut parts = vec![false; self.primitives.len()];
        let mut open = Vec::new();
        for (index, primitive) in self.primitives.iter().enumerate() {
            match &primitive.kind {
                PrimitiveKind::BeginLayer => open.push(index),
                kind @ PrimitiveKind::EndLayer { .. } => {
                    let begin = open.pop().unwrap_or(index);
                    if is_mask(kind) {
                        parts[begin..=index].fill(true);
                    }
                }
                _ => {}
            }
        }
        Some(parts)
    }

    /// Where the document may be meant in the other dialect: which reading this is, `why`, and which option asks for the
    /// other, in one line.
    pub fn reading_note(&self, why: &str) -> Option<String> {
        let other = self.other_reading?.name();
        let taken = self.dialect.name();
        Some(format!(
            "read as {taken}{why}; --dialect {other} makes another picture of it (course is the simple reader of a course: rasterscope help pixels)"
        ))
    }
}

/// Index into [`Scene::shapes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ShapeId(pub u32);

/// Index into [`Scene::textures`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TextureId(pub u32);

/// Index into [`Scene::gradients`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct GradientId(pub u32);

/// Index into [`Scene::patterns`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PatternId(pub u32);

/// Where a shape came from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shape {
    /// The element's name, such as `polygon`.
    pub element: Box<str>,
    /// Its `id`, where it has one.
    pub id: Option<Box<str>>,
    /// Where its start tag begins.
    pub location: SourceLocation,
    /// Where the `use` stands that put it here, if one did.
    pub used: Option<SourceLocation>,
}

/// The smallest thing that is painted.
#[derive(Clone, Debug, PartialEq)]
pub struct Primitive {
    /// The shape it belongs to.
    pub shape: ShapeId,
    /// What it is.
    pub kind: PrimitiveKind,
}

/// A primitive's geometry and paint. All coordinates are finite.
#[derive(Clone, Debug, PartialEq)]
pub enum PrimitiveKind {
    /// A filled triangle of either winding.
    Triangle {
        /// Its corners.
        points: [DVec2; 3],
        /// What fills it.
        paint: Paint,
    },
    /// A filled area.
    Polygon {
        /// Which.
        polygon: Arc<Polygon>,
        /// What fills it.
        fill: Fill,
    },
    /// A line as wide as one pixel at every zoom (course dialect).
    Hairline {
        /// From, to.
        ends: [DVec2; 2],
        /// Its colour.
        color: Rgba,
    },
    /// One pixel at every zoom (course dialect).
    Point {
        /// Where.
        at: DVec2,
        /// Its colour.
        color: Rgba,
    },
    /// What follows, up to the matching [`PrimitiveKind::EndLayer`], is painted on a transparent layer of its own.
    BeginLayer,
    /// The layer is finished.
    EndLayer {
        /// What becomes of it and of what lies below it.
        composite: Composite,
    },
}

/// How a finished layer is composited with what lies below it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Composite {
    /// It is painted over it (SVG's `opacity` and `mix-blend-mode` of a group or shape).
    Over {
        /// `0.0..=1.0`.
        opacity: f32,
        /// How colours are mixed.
        blend: BlendMode,
    },
    /// What lies below stays where the layer covers it (`clip-path`); the layer itself is not seen.
    Clip,
    /// What lies below stays as far as the layer lets it (`mask`); the layer itself is not seen.
    Mask(MaskKind),
}

impl Composite {
    /// Source over at this opacity.
    pub const fn over(opacity: f32) -> Self {
        Self::Over {
            opacity,
            blend: BlendMode::Normal,
        }
    }
}

/// What of a mask's colours counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaskKind {
    /// How light they are, times their opacity.
    Luminance,
    /// Their opacity.
    Alpha,
}

/// What fills a polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fill {
    /// One colour.
    Solid(Rgba),
    /// A gradient.
    Gradient(GradientId),
    /// A picture, over and over.
    Pattern(PatternId),
}

/// Colours along a line or between circles.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradient {
    /// Its element and where that stands; an index into [`Scene::shapes`].
    pub shape: ShapeId,
    /// Where on the ramp a point lies, in the gradient's own coordinates.
    pub geometry: GradientShape,
    /// The colours, the fill's opacity included.
    pub ramp: Ramp,
    /// The gradient's own coordinates to user space.
    pub to_user: DAffine2,
}

/// A picture that is repeated in both directions.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// Its element and where that stands; an index into [`Scene::shapes`].
    pub shape: ShapeId,
    /// One tile, which is as large as its canvas; its primitives point to its own shapes.
    pub tile: Arc<Scene>,
    /// The tile's coordinates to user space.
    pub to_user: DAffine2,
    /// Multiplies the tile's own opacity, `0.0..=1.0`.
    pub opacity: f32,
    /// The tile as views have shown it.
    pub drawn: TileCache,
}

/// What fills a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Paint {
    /// One colour.
    Solid(Rgba),
    /// A colour per corner, mixed with barycentric weights.
    Vertex([Rgba; 3]),
    /// A texture; its coordinates at the corners are mixed with barycentric weights.
    Texture {
        /// Which.
        texture: TextureId,
        /// `(u, v)` at the corners; any finite values, clamped to the texture when read.
        uv: [Vec2; 3],
        /// Multiplies the texture's own opacity, `0.0..=1.0`.
        opacity: f32,
    },
}

impl Dialect {
    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Course => "course",
            Self::Svg => "svg",
        }
    }
}
