//! Why a primitive covers samples of a pixel, and where its colour comes from: edge functions, barycentric weights,
//! attributes, texels.

use glam::DVec2;

use crate::geometry::FillRule;
use crate::geometry::edge::{EdgeTest, EdgeWalker};
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::DisplayList;
use crate::raster::attributes::{Planes, course_uv, uv_map};
use crate::raster::coverage::float_shape::FloatShape;
use crate::raster::coverage::polygon::Outline;
use crate::raster::list::chunk::{Chunk, DrawCommand, Paint, ScreenTriangle};
use crate::raster::paint::recorder::PaintedOp;
use crate::raster::sampling::positions::Position;
use crate::raster::shading::shader::ShadeContext;
use crate::raster::span::Span;
use crate::rules::Rules;
use crate::texture::{Filter, Reading, Sampler, TextureReads};

/// One op of a list, seen from the samples of a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Its index in its chunk.
    pub(crate) op: usize,
    /// What it is.
    pub shape: PieceShape,
}

/// What an op is.
#[derive(Clone, Debug, PartialEq)]
pub enum PieceShape {
    /// A triangle, or what clipping left of one.
    Triangle {
        /// Its corners as snapped to the sub-pixel grid, in pixels of the frame.
        corners: [DVec2; 3],
        /// What each sample of the pixel sees of it, inside it or not.
        samples: Vec<SampleOfTriangle>,
        /// How it reads a texture.
        texture: Option<TextureUse>,
    },
    /// A polygon of one colour.
    Outline {
        /// Which windings are inside.
        rule: FillRule,
        /// How often it winds around each sample of the pixel: clockwise on the screen counts up.
        windings: Vec<i32>,
    },
    /// Whole pixels: a hairline or a point.
    Pixels,
}

/// What one sample sees of a triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleOfTriangle {
    /// Units of the sub-pixel grid along one side of a pixel: the square root of the edges' unit, in pixels, is one over it.
    pub units_per_pixel: f64,
    /// The edges from the first corner to the second, to the third, and back.
    pub edges: [EdgeTest; 3],
    /// The same edge functions in 32-bit floats and square pixels, by the rules that decide by them.
    pub floats: Option<[f32; 3]>,
    /// Barycentric weights of the whole triangle's corners there, also where a part of it was clipped.
    pub weights: [f64; 3],
    /// What is interpolated there.
    pub attributes: Attributes,
}

/// What is interpolated at a sample.
#[derive(Clone, Debug, PartialEq)]
pub enum Attributes {
    /// Nothing: one colour.
    None,
    /// Straight red, green, blue, alpha, `0.0..=1.0`.
    Color([f64; 4]),
    /// Texture coordinates.
    Texture {
        /// `(u, v)`.
        uv: [f64; 2],
        /// The texels read there.
        reads: TextureReads,
    },
}

/// How a triangle reads its texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureUse {
    /// Index into the textures of the drawing.
    pub texture: u32,
    /// The same for all its samples, because its map is affine.
    pub reading: Reading,
    /// Multiplies the texels, `0.0..=1.0`.
    pub opacity: f32,
}

impl SampleOfTriangle {
    /// Whether the sample is the triangle's by exact edges, and not by those in 32-bit floats.
    pub fn is_left_open(&self) -> bool {
        let exact = self.edges.iter().all(|edge| edge.is_inside(Rules::Standard));
        exact
            && self
                .floats
                .is_some_and(|floats| floats.iter().any(|value| *value <= 0.0))
    }
}

impl Piece {
    /// Whether an op of the same chunk is this one.
    pub fn is_of(&self, op: &PaintedOp) -> bool {
        self.op == op.op
    }
}

impl DisplayList<'_> {
    /// The ops of the list's only chunk as the samples of pixel `(x, y)` see them.
    ///
    /// `weights` is the same chunk but for its paints, which have red, green and blue at a triangle's corners: so weights
    /// take the way of every attribute, through clipping too.
    pub fn pieces(&self, pixel: [u32; 2], weights: &Chunk) -> Vec<Piece> {
        let Some(chunk) = self.chunks.first() else {
            return Vec::new();
        };
        let pixel = pixel.map(u32::cast_signed);
        let seen = SeenFrom {
            context: self.shade_context(),
            pixel,
            places: self.places().of_pixel(pixel, &mut Vec::new()).to_vec(),
        };
        let shape = |op: &DrawCommand| match *op {
            DrawCommand::Triangle(index) => {
                let whole = weights.triangles.get(index as usize);
                let weights = whole.map(|triangle| &weights.paints[triangle.paint as usize]);
                let triangle = &chunk.triangles[index as usize];
                let float = chunk.floats.get(index as usize);
                Some(seen.triangle((triangle, float), &chunk.paints[triangle.paint as usize], weights))
            }
            DrawCommand::Outline(index) => Some(seen.outline(chunk, &chunk.outlines[index as usize])),
            DrawCommand::Hairline(_) | DrawCommand::Pixels(_) | DrawCommand::Samples(_) => Some(PieceShape::Pixels),
            DrawCommand::BeginLayer(_) | DrawCommand::EndLayer(_) => None,
        };
        let ops = chunk.ops.iter().enumerate();
        ops.filter_map(|(op, kind)| shape(kind).map(|shape| Piece { op, shape }))
            .collect()
    }
}

/// The samples of one pixel.
struct SeenFrom<'a> {
    context: ShadeContext<'a>,
    pixel: [i32; 2],
    /// Where they lie in it.
    places: Vec<Position>,
}

impl SeenFrom<'_> {
    fn grid(&self) -> SubpixelGrid {
        self.context.grid
    }

    /// Column and row of each sample in the frame.
    fn samples(&self) -> impl Iterator<Item = [i32; 2]> {
        let first = self.pixel.map(|at| at * self.grid().side());
        let place = move |place: &Position| [first[0] + i32::from(place[0]), first[1] + i32::from(place[1])];
        self.places.iter().map(place)
    }

    fn triangle(
        &self,
        (triangle, float): (&ScreenTriangle, Option<&FloatShape>),
        paint: &Paint,
        weights: Option<&Paint>,
    ) -> PieceShape {
        let grid = self.grid();
        let corners = triangle.corners;
        let weights = match weights {
            Some(Paint::Vertex(colors)) => *colors,
            // Nothing was clipped away.
            _ => [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]],
        };
        let weights = Planes::new(grid, &corners, weights);
        let attributes = AttributeSource::new(&self.context, triangle, paint);
        let samples = self.samples().map(|[column, row]| {
            let point = GridPoint {
                x: grid.sample_coordinate(column),
                y: grid.sample_coordinate(row),
            };
            let at = [f64::from(column) + 0.5, f64::from(row) + 0.5];
            let [a, b, c, _] = weights.at(at[0], at[1]);
            SampleOfTriangle {
                units_per_pixel: grid.units_per_pixel(),
                edges: EdgeTest::of_triangle(corners, point),
                floats: float.map(|float| float.edges(grid, [column, row])),
                weights: [a, b, c],
                attributes: attributes.at(&self.context, self.pixel, [column, row]),
            }
        });
        PieceShape::Triangle {
            samples: samples.collect(),
            corners: corners
                .map(|corner| DVec2::new(f64::from(corner.x), f64::from(corner.y)) / grid.units_per_pixel()),
            texture: attributes.texture(),
        }
    }

    fn outline(&self, chunk: &Chunk, outline: &Outline) -> PieceShape {
        let grid = self.grid();
        let winding = |[column, row]: [i32; 2]| {
            let rows = Span {
                start: row,
                end: row + 1,
            };
            outline
                .edges_in(&chunk.outline_edges, rows)
                .filter(|(edge, _)| EdgeWalker::new(grid, edge.top, edge.bottom, row).at_or_after() <= column)
                // What runs up on the left of a point goes around it clockwise.
                .map(|(edge, _)| -edge.winding)
                .sum()
        };
        PieceShape::Outline {
            rule: outline.rule,
            windings: self.samples().map(winding).collect(),
        }
    }
}

/// Where the attributes of a triangle come from.
enum AttributeSource<'a> {
    None,
    Color(Planes<4>),
    Texture(Box<TextureSource<'a>>),
}

/// Texture coordinates and how they are read.
struct TextureSource<'a> {
    uv: Planes<2>,
    usage: TextureUse,
    filter: Filter<'a>,
    /// By the course's rules.
    sampler: Option<Sampler<'a>>,
}

impl<'a> AttributeSource<'a> {
    fn new(context: &ShadeContext<'a>, triangle: &ScreenTriangle, paint: &Paint) -> Self {
        match *paint {
            Paint::Solid(_) => Self::None,
            Paint::Vertex(colors) => Self::Color(Planes::new(context.grid, &triangle.corners, colors)),
            Paint::Texture { texture, uv, opacity } => {
                let pyramid = &context.textures[texture as usize].pyramid;
                let uv = Planes::new(context.grid, &triangle.corners, uv);
                let map = uv_map(context.grid, &uv);
                let sampling = &context.sampling;
                Self::Texture(Box::new(TextureSource {
                    uv,
                    usage: TextureUse {
                        texture,
                        reading: Reading::new(&map.footprint(), pyramid, sampling),
                        opacity,
                    },
                    filter: Filter::new(pyramid, &map, sampling),
                    sampler: (sampling.rules == Rules::Course)
                        .then(|| Sampler::new(pyramid, &map.footprint(), sampling)),
                }))
            }
        }
    }

    fn texture(&self) -> Option<TextureUse> {
        match self {
            Self::Texture(source) => Some(source.usage),
            Self::None | Self::Color(_) => None,
        }
    }

    /// At the sample in `column` and `row` of the frame, which lies in `pixel`.
    fn at(&self, context: &ShadeContext<'_>, pixel: [i32; 2], [column, row]: [i32; 2]) -> Attributes {
        let at = [f64::from(column) + 0.5, f64::from(row) + 0.5];
        let side = context.grid.side();
        match self {
            Self::None => Attributes::None,
            Self::Color(planes) => Attributes::Color(planes.at(at[0], at[1])),
            Self::Texture(source) => {
                let TextureSource {
                    uv, filter, sampler, ..
                } = &**source;
                if let Some(sampler) = sampler {
                    let [u, v] = course_uv(uv, side, [column, row]);
                    return Attributes::Texture {
                        uv: [u.into(), v.into()],
                        reads: sampler.course_reads(u, v),
                    };
                }
                let inside = |at: i32, pixel: i32| u16::try_from(at - pixel * side).unwrap_or(0);
                let point = [inside(column, pixel[0]), inside(row, pixel[1])];
                Attributes::Texture {
                    uv: uv.at(at[0], at[1]),
                    reads: filter.reads(context.samples_from(pixel), point),
                }
            }
        }
    }
}
