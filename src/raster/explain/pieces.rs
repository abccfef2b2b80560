//! Why a primitive covers samples of a pixel, and where its colour comes from: edge functions, barycentric weights,
//! attributes, texels.

use glam::DVec2;

use crate::color::Rgba;
use crate::geometry::FillRule;
use crate::geometry::edge::{EdgeTest, EdgeWalker};
use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::DisplayList;
use crate::raster::binning::tile_command::NO_CORNERS;
use crate::raster::coverage::float_shape::FloatShape;
use crate::raster::list::chunk::{Chunk, DrawCommand, ScreenTriangle};
use crate::raster::paint::recorder::PaintedCommand;
use crate::raster::sampling::positions::Position;
use crate::raster::shading::context::{ShadeContext, ShadedSample};
use crate::raster::shading::interpolated::{Attributes, TextureUse};
use crate::raster::shading::once::ShadingPlace;
use crate::raster::shading::{Paint, Shader};
use crate::raster::span::Span;
use crate::rules::Rules;

/// One command of a list, seen from the samples of a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Its index in its chunk.
    pub(crate) command: usize,
    /// What it is.
    pub shape: PieceShape,
}

/// What an command is.
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
    /// A polygon.
    Outline {
        /// Which windings are inside.
        rule: FillRule,
        /// How often it winds around each sample of the pixel: clockwise on the screen counts up.
        windings: Vec<i32>,
        /// What its paint finds at each sample.
        attributes: Vec<Attributes>,
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
    /// Barycentric weights of the whole triangle's corners where it is shaded for this sample, also where a part of it was clipped.
    pub weights: [f64; 3],
    /// What is interpolated there.
    pub attributes: Attributes,
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
    /// Whether an command of the same chunk is this one.
    pub fn is_of(&self, command: &PaintedCommand) -> bool {
        self.command == command.command
    }
}

impl DisplayList<'_> {
    /// The commands of the list's only chunk as the samples of pixel `(x, y)` see them.
    ///
    /// `weights` is the same chunk but for its paints, which have red, green and blue at a triangle's corners: so weights
    /// take the way of every attribute, through clipping too.
    pub fn pieces(&self, pixel: [u32; 2], weights: &Chunk) -> Vec<Piece> {
        let Some(chunk) = self.chunks.first() else {
            return Vec::new();
        };
        let painted = if self.context.shading.is_once() {
            self.painted(pixel[0], pixel[1])
        } else {
            Vec::new()
        };
        let place = |command: usize| painted.iter().find(|painted| painted.command == command)?.shaded;
        let pixel = self.painted_at(pixel);
        let seen = SeenFrom {
            context: self.shade_context(),
            shift: self.context.shift(),
            pixel,
            places: self.places().of_pixel(pixel, &mut Vec::new()).to_vec(),
        };
        let shape = |command: usize, kind: &DrawCommand| match *kind {
            DrawCommand::Triangle(index) => {
                let whole = weights.triangles.get(index as usize);
                // Without such colours nothing was clipped away.
                let corners = corner_weights();
                let weights = whole.map_or(&corners, |triangle| &weights.paints[triangle.paint as usize].paint);
                let triangle = &chunk.triangles[index as usize];
                let float = chunk.floats.get(index as usize);
                let paint = &chunk.paints[triangle.paint as usize].paint;
                Some(seen.triangle(triangle, float, [paint, weights], place(command)))
            }
            DrawCommand::Outline(index) => Some(seen.outline(chunk, index, place(command))),
            DrawCommand::Hairline(_) | DrawCommand::Pixels(_) | DrawCommand::Samples(_) => Some(PieceShape::Pixels),
            DrawCommand::BeginLayer(_) | DrawCommand::EndLayer(_) => None,
        };
        let commands = chunk.commands.iter().enumerate();
        commands
            .filter_map(|(command, kind)| shape(command, kind).map(|shape| Piece { command, shape }))
            .collect()
    }
}

/// Red, green and blue at a triangle's corners.
fn corner_weights() -> Paint {
    let corner = |i: usize| Rgba {
        r: f32::from(i == 0),
        g: f32::from(i == 1),
        b: f32::from(i == 2),
        a: 1.0,
    };
    Paint::vertex([corner(0), corner(1), corner(2)])
}

/// The weights at a sample: what the first of some paints with colours at the corners interpolates there.
fn weights_at(shaders: &[Shader<'_>; 2], sample: ShadedSample) -> [f64; 3] {
    let of = |shader: &Shader<'_>| match shader.interpolated(sample) {
        Attributes::Color([a, b, c, _]) => Some([a, b, c]),
        Attributes::None
        | Attributes::Texture { .. }
        | Attributes::Gradient { .. }
        | Attributes::OffRamp
        | Attributes::Pattern { .. } => None,
    };
    shaders.iter().find_map(of).unwrap_or_default()
}

/// The samples of one pixel.
struct SeenFrom<'a> {
    context: ShadeContext<'a>,
    /// From places in the frame to where they are painted.
    shift: DVec2,
    pixel: [i32; 2],
    /// Where they lie in it.
    places: Vec<Position>,
}

impl SeenFrom<'_> {
    fn grid(&self) -> SubpixelGrid {
        self.context.grid
    }

    /// The pixel's samples, in the order of the pattern.
    fn samples(&self) -> impl Iterator<Item = ShadedSample> {
        let grid = self.context.samples_from(self.pixel);
        let sample = move |place: &Position| ShadedSample {
            grid,
            place: place.map(u16::from),
        };
        self.places.iter().map(sample)
    }

    /// Where a primitive is shaded: what its shader has to be prepared with, and the sample for each sample that is covered.
    fn shaded(&self, place: Option<ShadingPlace>) -> (ShadeContext<'_>, impl Fn(ShadedSample) -> ShadedSample) {
        let context = self.context.on(place.map_or(self.grid(), |place| place.grid));
        let once = place.map(|place| place.in_pixel(&context, self.pixel));
        (context, move |sample| once.unwrap_or(sample))
    }

    /// A triangle, its paint, and the one that has weights for colours; and where it is shaded for the whole pixel.
    fn triangle(
        &self,
        triangle: &ScreenTriangle,
        float: Option<&FloatShape>,
        [paint, weights]: [&Paint; 2],
        place: Option<ShadingPlace>,
    ) -> PieceShape {
        let grid = self.grid();
        let corners = triangle.corners;
        let (context, shaded) = self.shaded(place);
        let shader = Shader::new(&context, &corners, paint);
        let weights = [weights, &corner_weights()].map(|paint| Shader::new(&context, &corners, paint));
        let samples = self.samples().map(|sample| {
            let [column, row] = sample.in_frame();
            let point = GridPoint {
                x: grid.sample_coordinate(column),
                y: grid.sample_coordinate(row),
            };
            SampleOfTriangle {
                units_per_pixel: grid.units_per_pixel(),
                edges: EdgeTest::of_triangle(corners, point),
                floats: float.map(|float| float.edges(grid, [column, row])),
                weights: weights_at(&weights, shaded(sample)),
                attributes: shader.interpolated(shaded(sample)),
            }
        });
        PieceShape::Triangle {
            samples: samples.collect(),
            corners: corners.map(|corner| {
                DVec2::new(f64::from(corner.x), f64::from(corner.y)) / grid.units_per_pixel() - self.shift
            }),
            texture: shader.texture_use(&context),
        }
    }

    fn outline(&self, chunk: &Chunk, index: u32, place: Option<ShadingPlace>) -> PieceShape {
        let grid = self.grid();
        let outline = chunk.outline(index).outline;
        let (context, shaded) = self.shaded(place);
        let shader = Shader::new(&context, &NO_CORNERS, &chunk.outline_paint(index).paint);
        let winding = |sample: ShadedSample| {
            let [column, row] = sample.in_frame();
            let rows = Span {
                start: row,
                end: row + 1,
            };
            outline
                .edges_in(rows)
                .filter(|(edge, _)| !edge.sample_rows(grid).intersection(rows).is_empty())
                .filter(|(edge, _)| EdgeWalker::new(grid, edge.top, edge.bottom, row).at_or_after() <= column)
                // What runs up on the left of a point goes around it clockwise.
                .map(|(edge, _)| -edge.winding)
                .sum()
        };
        PieceShape::Outline {
            rule: outline.outline.rule,
            windings: self.samples().map(winding).collect(),
            attributes: self
                .samples()
                .map(|sample| shader.interpolated(shaded(sample)))
                .collect(),
        }
    }
}
