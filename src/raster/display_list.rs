//! What is to be painted on the screen, in painter's order: screen-space triangles, pixel chains and layers.
//!
//! The list is built in chunks that many threads fill at once; order inside and between chunks is painter's order.

use glam::DVec2;

use super::hairline;
use super::rows::{SortedTriangle, Span, end_of};
use super::tile::{PixelRect, TileLayout};
use crate::color::{Premultiplied16, Rgba, unit_to_16};
use crate::geometry::clip::{ClipVertex, ClippedTriangle, in_guard};
use crate::geometry::subpixel::{GridPoint, SubpixelGrid, floor_to_i32};
use crate::rules::Rules;

/// What fills a triangle, in the terms of this room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fill {
    /// One colour.
    Solid(Rgba),
    /// Colours at the corners.
    Vertex([Rgba; 3]),
    /// Texture coordinates at the corners.
    Texture {
        /// Index into the textures of the drawing.
        texture: u32,
        /// `(u, v)` at the corners.
        uv: [[f32; 2]; 3],
        /// Multiplies the texture's own, `0.0..=1.0`.
        opacity: f32,
    },
}

/// A fill with its colour as samples store it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Paint {
    Solid(Premultiplied16),
    Vertex([[f32; 4]; 3]),
    Texture {
        texture: u32,
        uv: [[f32; 2]; 3],
        opacity: f32,
    },
}

/// A triangle on the sub-pixel grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScreenTriangle {
    pub(crate) corners: [GridPoint; 3],
    /// Index into the chunk's paints.
    pub(crate) paint: u32,
}

/// One step of the painter.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Op {
    /// Index into the chunk's triangles.
    Triangle(u32),
    /// A run of the chunk's pixels, all in one tile, in a paint that is solid.
    Pixels {
        start: u32,
        count: u32,
        paint: u32,
    },
    /// The pixels that anything in the layer touches.
    BeginLayer {
        area: PixelRect,
    },
    EndLayer {
        opacity: u16,
        area: PixelRect,
    },
}

/// A part of the display list.
#[derive(Debug, Default)]
pub struct Chunk {
    pub(crate) ops: Vec<Op>,
    /// For each op the number its caller gave it.
    pub(crate) sources: Vec<u32>,
    pub(crate) triangles: Vec<ScreenTriangle>,
    pub(crate) paints: Vec<Paint>,
    /// Columns and rows of pixels that hairlines and points fill.
    pub(crate) pixels: Vec<[u16; 2]>,
    /// Layers that earlier chunks have left open.
    pub(crate) layers_open: u32,
    /// Whether any op begins or ends a layer.
    has_layers: bool,
}

/// What a chunk needs to know about the drawing.
#[derive(Clone, Copy, Debug)]
pub struct ListContext {
    pub(crate) grid: SubpixelGrid,
    pub(crate) rules: Rules,
    /// Pixels in a row, rows.
    pub(crate) size: [u32; 2],
    pub(crate) tiles: TileLayout,
}

/// Fills one chunk.
#[derive(Debug)]
pub struct ChunkBuilder<'a> {
    context: &'a ListContext,
    chunk: Chunk,
    source: u32,
}

impl<'a> ChunkBuilder<'a> {
    /// An empty chunk.
    pub fn new(context: &'a ListContext) -> Self {
        Self {
            context,
            chunk: Chunk::default(),
            source: 0,
        }
    }

    /// Everything added from here on comes from the caller's primitive number `source`.
    pub fn set_source(&mut self, source: u32) {
        self.source = source;
    }

    /// The finished chunk.
    pub fn finish(self) -> Chunk {
        self.chunk
    }

    /// Adds a triangle in screen space; any finite coordinates.
    pub fn triangle(&mut self, points: [DVec2; 3], fill: &Fill) {
        if !points.iter().all(|point| point.is_finite()) || !self.may_show(points) {
            return;
        }
        if points.iter().all(|point| in_guard(*point)) {
            self.snapped(points, fill);
            return;
        }
        for corners in ClippedTriangle::new(points).triangles() {
            self.snapped(corners.map(|corner| corner.point), &fill.at(&corners));
        }
    }

    /// Adds a line one pixel wide; any finite coordinates.
    pub fn hairline(&mut self, ends: [DVec2; 2], color: Rgba) {
        let start = self.chunk.pixels.len();
        hairline::trace(ends, self.context.size, &mut self.chunk.pixels);
        self.pixel_runs(start, color);
    }

    /// Adds a single pixel.
    pub fn point(&mut self, at: DVec2, color: Rgba) {
        let (x, y) = (at.x.floor(), at.y.floor());
        let [width, height] = self.context.size.map(f64::from);
        if x >= 0.0 && x < width && y >= 0.0 && y < height {
            let start = self.chunk.pixels.len();
            self.chunk
                .pixels
                .push(hairline::pixel(floor_to_i32(x), floor_to_i32(y)));
            self.pixel_runs(start, color);
        }
    }

    /// Starts a transparent layer.
    pub fn begin_layer(&mut self) {
        self.chunk.has_layers = true;
        self.push(Op::BeginLayer {
            area: PixelRect::NOTHING,
        });
    }

    /// Paints the layer over what is below it.
    pub fn end_layer(&mut self, opacity: f32) {
        self.chunk.has_layers = true;
        let opacity = unit_to_16(opacity.clamp(0.0, 1.0));
        self.push(Op::EndLayer {
            opacity,
            area: PixelRect::NOTHING,
        });
    }

    fn push(&mut self, op: Op) {
        self.chunk.ops.push(op);
        self.chunk.sources.push(self.source);
    }

    /// Whether a triangle's box touches the frame at all.
    fn may_show(&self, [a, b, c]: [DVec2; 3]) -> bool {
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let frame = DVec2::new(f64::from(self.context.size[0]), f64::from(self.context.size[1]));
        high.cmpge(DVec2::ZERO).all() && low.cmple(frame).all()
    }

    fn snapped(&mut self, points: [DVec2; 3], fill: &Fill) {
        let corners = points.map(|point| self.context.grid.snap(point));
        if !covers_a_sample(self.context, corners) {
            return;
        }
        let paint = self.paint(Paint::new(fill, self.context.rules));
        let index = index(self.chunk.triangles.len());
        self.chunk.triangles.push(ScreenTriangle { corners, paint });
        self.push(Op::Triangle(index));
    }

    /// Cuts the pixels from `start` on into runs that stay in one tile.
    fn pixel_runs(&mut self, start: usize, color: Rgba) {
        if start == self.chunk.pixels.len() {
            return;
        }
        let paint = self.paint(Paint::Solid(Premultiplied16::from_straight(color, self.context.rules)));
        let mut first = start;
        for next in start + 1..=self.chunk.pixels.len() {
            let tile = |i: usize| self.context.tiles.tile_of(self.chunk.pixels[i]);
            if next == self.chunk.pixels.len() || tile(next) != tile(first) {
                let count = index(next - first);
                self.push(Op::Pixels {
                    start: index(first),
                    count,
                    paint,
                });
                first = next;
            }
        }
    }

    /// The index of a paint; runs of the same solid colour share one.
    fn paint(&mut self, paint: Paint) -> u32 {
        if self.chunk.paints.last() != Some(&paint) {
            self.chunk.paints.push(paint);
        }
        index(self.chunk.paints.len() - 1)
    }
}

/// A chunk holds far fewer than `2^32` of anything: its input is a slice of at most 65 536 primitives, each of which
/// adds at most some ten thousand pixels.
fn index(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

/// Whether a triangle's box contains a sample inside the frame; drops most triangles smaller than a sample.
fn covers_a_sample(context: &ListContext, corners: [GridPoint; 3]) -> bool {
    let grid = context.grid;
    let [a, b, c] = corners;
    let columns = Span {
        start: grid.sample_at_or_after(a.x.min(b.x).min(c.x)),
        end: end_of(grid, a.x.max(b.x).max(c.x), context.rules),
    };
    let Some(sorted) = SortedTriangle::new(corners, context.rules) else {
        return false;
    };
    let samples = |pixels: u32| Span {
        start: 0,
        end: pixels.cast_signed() * grid.side(),
    };
    !columns.intersection(samples(context.size[0])).is_empty()
        && !sorted.rows(grid).intersection(samples(context.size[1])).is_empty()
}

impl Chunk {
    /// The pixels that an op may touch, clipped to the frame; `None` when there are none.
    pub(crate) fn area(&self, op: &Op, context: &ListContext) -> Option<PixelRect> {
        let area = match *op {
            Op::Triangle(index) => {
                let [a, b, c] = self.triangles[index as usize].corners;
                let grid = context.grid;
                let pixels = |low: i32, high: i32| Span {
                    start: grid.sample_at_or_after(low).div_euclid(grid.side()),
                    end: (end_of(grid, high, context.rules) - 1).div_euclid(grid.side()) + 1,
                };
                PixelRect {
                    x: pixels(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x)),
                    y: pixels(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y)),
                }
            }
            Op::Pixels { start, count, .. } => {
                let pixels = &self.pixels[start as usize..][..count as usize];
                pixels.iter().fold(PixelRect::NOTHING, |area, [x, y]| {
                    let one = |at: u16| Span {
                        start: i32::from(at),
                        end: i32::from(at) + 1,
                    };
                    area.union(PixelRect { x: one(*x), y: one(*y) })
                })
            }
            Op::BeginLayer { area } | Op::EndLayer { area, .. } => area,
        };
        let frame = |pixels: u32| Span {
            start: 0,
            end: pixels.cast_signed(),
        };
        let area = PixelRect {
            x: area.x.intersection(frame(context.size[0])),
            y: area.y.intersection(frame(context.size[1])),
        };
        (!area.x.is_empty() && !area.y.is_empty()).then_some(area)
    }
}

/// Tells every layer which pixels it touches, so that tiles beside it need not open it.
///
/// Layers may span chunks, so this looks at all of them in order; without layers it does nothing.
pub(crate) fn measure_layers(chunks: &mut [Chunk], context: &ListContext) {
    if !chunks.iter().any(|chunk| chunk.has_layers) {
        return;
    }
    let mut open: Vec<(usize, usize, PixelRect)> = Vec::new();
    for chunk in 0..chunks.len() {
        chunks[chunk].layers_open = index(open.len());
        for op in 0..chunks[chunk].ops.len() {
            match chunks[chunk].ops[op] {
                Op::BeginLayer { .. } => open.push((chunk, op, PixelRect::NOTHING)),
                Op::EndLayer { opacity, .. } => {
                    let Some((begin_chunk, begin_op, area)) = open.pop() else {
                        continue;
                    };
                    chunks[begin_chunk].ops[begin_op] = Op::BeginLayer { area };
                    chunks[chunk].ops[op] = Op::EndLayer { opacity, area };
                    if let Some((_, _, outer)) = open.last_mut() {
                        *outer = outer.union(area);
                    }
                }
                ref painted => {
                    if let (Some((_, _, layer)), Some(area)) = (open.last_mut(), chunks[chunk].area(painted, context)) {
                        *layer = layer.union(area);
                    }
                }
            }
        }
    }
}

impl Paint {
    fn new(fill: &Fill, rules: Rules) -> Self {
        match *fill {
            Fill::Solid(color) => Self::Solid(Premultiplied16::from_straight(color, rules)),
            Fill::Vertex(colors) => Self::Vertex(colors.map(|color| [color.r, color.g, color.b, color.a])),
            Fill::Texture { texture, uv, opacity } => Self::Texture { texture, uv, opacity },
        }
    }
}

impl Fill {
    /// The same fill on a part of the triangle.
    fn at(&self, corners: &[ClipVertex; 3]) -> Self {
        match *self {
            Self::Solid(_) => *self,
            Self::Vertex(colors) => Self::Vertex(corners.map(|corner| {
                let mix = |channel: fn(&Rgba) -> f32| blend(corner.weights, colors.each_ref().map(channel));
                Rgba {
                    r: mix(|c| c.r),
                    g: mix(|c| c.g),
                    b: mix(|c| c.b),
                    a: mix(|c| c.a),
                }
            })),
            Self::Texture { texture, uv, opacity } => {
                let uv = corners.map(|corner| [0, 1].map(|i| blend(corner.weights, uv.map(|uv| uv[i]))));
                Self::Texture { texture, uv, opacity }
            }
        }
    }
}

/// A barycentric mix in 64 bits.
#[expect(clippy::cast_possible_truncation, reason = "attributes are 32-bit floats")]
fn blend(weights: [f64; 3], values: [f32; 3]) -> f32 {
    // Relative to the first corner, so that equal values stay equal.
    let first = f64::from(values[0]);
    (first + weights[1] * (f64::from(values[1]) - first) + weights[2] * (f64::from(values[2]) - first)) as f32
}
