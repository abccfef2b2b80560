//! What is to be painted on the screen, in painter's order: screen-space triangles, polygons, hairlines, points
//! and layers.
//!
//! The list is built in chunks that many threads fill at once; order inside and between chunks is painter's order. A
//! chunk is a handful of plain arrays. What covers a few samples only, which in a scene of a million primitives is
//! nearly everything, is reduced to the bits of these samples and its colour at once and never looked at as a triangle
//! again.

use crate::color::Premultiplied16;
use crate::geometry::subpixel::GridPoint;
use crate::raster::coverage::float_shape::FloatShape;
use crate::raster::coverage::mask8x8::CoverageMask;
use crate::raster::coverage::polygon::{Outline, OutlineEdge};
use crate::raster::coverage::shape::NumberedOutline;
use crate::raster::layers::Compositing;
use crate::raster::list::context::ListContext;
use crate::raster::list::hairline::Hairline;
use crate::raster::shading::Paint;
use crate::raster::shading::sources::PaintSources;
use crate::raster::span::{Span, SpanRect, scaled};

/// A paint of a chunk's triangles and polygons.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChunkPaint {
    pub(crate) paint: Paint,
    /// The one colour that every fragment has, as samples store it; none where fragments are to be shaded.
    pub(crate) constant: Option<Premultiplied16>,
}

/// A triangle on the sub-pixel grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScreenTriangle {
    pub(crate) corners: [GridPoint; 3],
    /// Index into the chunk's paints.
    pub(crate) paint: u32,
}

/// A few samples, or a few pixels, of one colour; all in the frame, at least one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stamp {
    pub(crate) coverage: CoverageMask,
    pub(crate) color: Premultiplied16,
}

/// Where a layer begins or ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LayerMark {
    /// The pixels that the layer may change.
    pub(crate) area: SpanRect,
    /// At the begin of the layer, whether what is in it counts in that area only: a mask's does, and so does what is masked.
    pub(crate) limits: bool,
    /// At the end of the layer, how it is composited.
    pub(crate) compositing: Option<Compositing>,
}

/// One step of the painter: an index into the chunk's array of the kind.
#[derive(Clone, Copy, Debug)]
pub(crate) enum DrawCommand {
    Triangle(u32),
    /// A polygon.
    Outline(u32),
    /// A stamp of samples.
    Samples(u32),
    /// A stamp of whole pixels.
    Pixels(u32),
    Hairline(u32),
    BeginLayer(u32),
    EndLayer(u32),
}

/// A part of the display list.
#[derive(Debug, Default)]
pub struct Chunk {
    pub(crate) commands: Vec<DrawCommand>,
    /// For each command the number its caller gave it.
    pub(crate) sources: Vec<u32>,
    pub(crate) stamps: Vec<Stamp>,
    pub(crate) triangles: Vec<ScreenTriangle>,
    /// By the rules of first drafts, what each triangle covers; else empty.
    pub(crate) floats: Vec<FloatShape>,
    pub(crate) paints: Vec<ChunkPaint>,
    pub(crate) outlines: Vec<Outline>,
    /// Of each outline the index of its paint.
    pub(crate) outline_paints: Vec<u32>,
    pub(crate) outline_edges: Vec<OutlineEdge>,
    /// Outlines in the chunks before this one.
    pub(crate) first_outline: usize,
    pub(crate) hairlines: Vec<Hairline>,
    pub(crate) layers: Vec<LayerMark>,
    /// How many triangles and polygons became commands.
    pub(crate) triangle_count: u64,
    /// Layers that earlier chunks have left open.
    pub(crate) layers_open: Vec<LayerMark>,
    /// Whether it holds what does not show, too, for those who ask what was painted.
    pub(crate) keeps_hidden: bool,
    /// Whether a colour lets what is below it shine through; textures are not looked at.
    pub(crate) translucent: bool,
}

impl Chunk {
    /// The paint of the outline at `index`.
    #[inline]
    pub(crate) fn outline_paint(&self, index: u32) -> &ChunkPaint {
        &self.paints[self.outline_paints[index as usize] as usize]
    }

    /// The outline at `index`, with what it needs.
    #[inline]
    pub(crate) fn outline(&self, index: u32) -> NumberedOutline<'_> {
        NumberedOutline {
            outline: self.outlines[index as usize].with_edges(&self.outline_edges),
            number: self.first_outline + index as usize,
        }
    }

    /// Whether some commands lie in a mask, and so count in some tiles only.
    pub(crate) fn is_limited(&self) -> bool {
        self.layers.iter().chain(&self.layers_open).any(|layer| layer.limits)
    }

    /// Whether any command begins or ends a layer.
    pub(crate) fn has_layers(&self) -> bool {
        !self.layers.is_empty()
    }

    /// The pixels that an command may touch, clipped to the frame; `None` when there are none.
    pub(crate) fn area(&self, command: DrawCommand, context: &ListContext) -> Option<SpanRect> {
        context.pixels_of(self.sample_box(command, context)?)
    }

    /// The box of the samples that an command may touch, clipped to the frame; `None` when there are none.
    pub(crate) fn sample_box(&self, command: DrawCommand, context: &ListContext) -> Option<SpanRect> {
        let side = context.grid.side();
        let of_pixels = |columns, rows| SpanRect {
            x: scaled(columns, side),
            y: scaled(rows, side),
        };
        let samples = match command {
            DrawCommand::Triangle(index) => {
                let corners = self.triangles[index as usize].corners;
                let float = self.floats.get(index as usize).map(|float| float.samples);
                float.unwrap_or_else(|| context.samples_of(corners))
            }
            DrawCommand::Outline(index) => self.outlines[index as usize].samples,
            DrawCommand::Samples(index) => {
                let coverage = self.stamps[index as usize].coverage;
                SpanRect {
                    x: coverage.columns(),
                    y: coverage.rows(),
                }
            }
            DrawCommand::Pixels(index) => {
                let coverage = self.stamps[index as usize].coverage;
                of_pixels(coverage.columns(), coverage.rows())
            }
            DrawCommand::Hairline(index) => {
                let mut area: Option<SpanRect> = None;
                self.hairlines[index as usize].blocks(context.size, |pixels| {
                    let pixels = SpanRect {
                        x: pixels.columns(),
                        y: pixels.rows(),
                    };
                    area = Some(area.map_or(pixels, |area| area.union(pixels)));
                });
                let area = area?;
                of_pixels(area.x, area.y)
            }
            DrawCommand::BeginLayer(index) | DrawCommand::EndLayer(index) => {
                let area = self.layers[index as usize].area;
                if area.is_empty() {
                    return None;
                }
                of_pixels(area.x, area.y)
            }
        }
        .intersection(context.samples());
        (!samples.is_empty()).then_some(samples)
    }
}

/// Tells every layer which pixels it touches, so that tiles beside it need not open it.
///
/// Where nothing is shaded, what is clipped or masked counts where the clip path or mask holds anything, which documents with thousands
/// of small clip paths around large shapes live on.
///
/// Layers may span chunks, so this looks at all of them in order; without layers it does nothing.
pub(crate) fn measure_layers(chunks: &mut [Chunk], context: &ListContext) {
    if !chunks.iter().any(Chunk::has_layers) {
        return;
    }
    let frame = SpanRect {
        x: Span {
            start: 0,
            end: context.size[0].cast_signed(),
        },
        y: Span {
            start: 0,
            end: context.size[1].cast_signed(),
        },
    };
    // A tile with layers may round shaded samples otherwise than one without.
    let is_shaded = |chunk: &Chunk| chunk.paints.iter().any(|paint| paint.constant.is_none());
    let keeps_clipped = chunks.iter().any(|chunk| chunk.keeps_hidden || is_shaded(chunk));
    let mut open: Vec<(usize, usize, SpanRect)> = Vec::new();
    let mut open_before = Vec::with_capacity(chunks.len());
    for at in 0..chunks.len() {
        let marks = open.iter().map(|(chunk, begin, _)| (*chunk, *begin));
        open_before.push(marks.collect::<Vec<_>>());
        for command in 0..chunks[at].commands.len() {
            match chunks[at].commands[command] {
                DrawCommand::BeginLayer(begin) => open.push((at, begin as usize, SpanRect::EMPTY)),
                DrawCommand::EndLayer(end) => {
                    let Some((begin_chunk, begin, mut area)) = open.pop() else {
                        continue;
                    };
                    let compositing = chunks[at].layers[end as usize].compositing;
                    let keeps_below = compositing.is_none_or(Compositing::keeps_below);
                    let held = area;
                    if !keeps_below {
                        // It is felt wherever there is anything below it, and nowhere else.
                        area = open.last().map_or(frame, |(_, _, outer)| *outer);
                        chunks[begin_chunk].layers[begin].limits = true;
                    }
                    chunks[begin_chunk].layers[begin].area = area;
                    chunks[at].layers[end as usize].area = area;
                    if let Some((outer_chunk, outer_begin, outer)) = open.last_mut() {
                        if keeps_below {
                            *outer = outer.union(area);
                        } else if !keeps_clipped {
                            let left = outer.intersection(held);
                            *outer = if left.is_empty() { SpanRect::EMPTY } else { left };
                            chunks[*outer_chunk].layers[*outer_begin].limits = true;
                        }
                    }
                }
                painted => {
                    if let Some((_, _, layer)) = open.last_mut()
                        && let Some(area) = chunks[at].area(painted, context)
                    {
                        *layer = layer.union(area);
                    }
                }
            }
        }
    }
    for (at, marks) in open_before.into_iter().enumerate() {
        let marks = marks.into_iter().map(|(chunk, begin)| chunks[chunk].layers[begin]);
        chunks[at].layers_open = marks.collect();
    }
}

impl ChunkPaint {
    /// Whether every fragment hides what is below it.
    pub(crate) fn is_opaque(&self, sources: &PaintSources<'_>) -> bool {
        self.constant
            .map_or_else(|| self.paint.is_opaque(sources), Premultiplied16::is_opaque)
    }

    /// Whether both give all fragments the same colours. Most triangles have the colour of the one before.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        match (self.constant, other.constant) {
            (None, None) => self.paint == other.paint,
            (own, other) => own == other,
        }
    }
}
