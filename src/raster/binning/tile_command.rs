//! One command in one tile, as the painters of tiles read it: everything about a small primitive, in painter's order.

use crate::color::Premultiplied16;
use crate::geometry::subpixel::GridPoint;
use crate::raster::coverage::mask8x8::CoverageMask;
use crate::raster::coverage::shape::Shape;
use crate::raster::layers::Compositing;
use crate::raster::list::chunk::{Chunk, DrawCommand};
use crate::raster::shading::Paint;
use crate::raster::span::Span;

/// One command in one tile. A stamp is held whole, the colour of a flat shape too, so that painting these does not jump
/// around in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct TileCommand {
    /// Flags, and below them the index of the command in its chunk.
    head: u32,
    /// Column and row of a stamp's first bit, counted from the tile's first: samples or pixels.
    at: [u16; 2],
    /// The bits of a stamp, or the index of a triangle or outline, or of a layer mark.
    bits: u64,
    color: Premultiplied16,
}

/// The corners of a polygon's paint, which needs none.
pub(in crate::raster) const NO_CORNERS: [GridPoint; 3] = [GridPoint { x: 0, y: 0 }; 3];

/// What is to be painted.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Work<'c> {
    /// A shape of one colour.
    Flat(Shape<'c>, Premultiplied16),
    /// A triangle or polygon of any other paint: what it covers, and the corners between which the paint lies.
    Shaded(Shape<'c>, &'c [GridPoint; 3], &'c Paint),
    BeginLayer,
    /// With how the layer is composited.
    EndLayer(Compositing),
}

impl TileCommand {
    const COVERS: u32 = 1 << 31;
    const HIDES: u32 = 1 << 30;
    const OPAQUE: u32 = 1 << 29;
    const FLAT: u32 = 1 << 28;
    const SAMPLES: u32 = 1 << 27;
    const PIXELS: u32 = 1 << 26;
    const OUTLINE: u32 = 1 << 25;
    /// The largest index of an command; a chunk is made from at most 65 536 primitives, which become five commands each at most.
    const MAX_COMMAND: u32 = Self::OUTLINE - 1;

    /// A triangle that touches the tile, number `triangle` of its chunk; `flat` is its colour, if it has just one and is
    /// covered exactly.
    pub(crate) fn triangle(command: usize, triangle: u32, flat: Option<Premultiplied16>, opaque: bool) -> Self {
        let flags = if flat.is_some() { Self::FLAT } else { 0 } | if opaque { Self::OPAQUE } else { 0 };
        Self {
            head: Self::number(command) | flags,
            at: [0; 2],
            bits: u64::from(triangle),
            color: flat.unwrap_or_default(),
        }
    }

    /// A polygon that touches the tile, outline number `outline` of its chunk; `flat` is its colour, if it has just one.
    pub(crate) fn outline(command: usize, outline: u32, flat: Option<Premultiplied16>, opaque: bool) -> Self {
        let flags = if flat.is_some() { Self::OUTLINE } else { 0 } | if opaque { Self::OPAQUE } else { 0 };
        Self {
            head: Self::number(command) | flags,
            at: [0; 2],
            bits: u64::from(outline),
            color: flat.unwrap_or_default(),
        }
    }

    /// A stamp of samples, yet without its bits.
    #[inline]
    pub(crate) fn samples(command: usize, color: Premultiplied16) -> Self {
        Self::stamp(command, color, Self::SAMPLES)
    }

    /// A stamp of pixels, yet without its bits.
    #[inline]
    pub(crate) fn pixels(command: usize, color: Premultiplied16) -> Self {
        Self::stamp(command, color, Self::PIXELS)
    }

    #[inline]
    fn stamp(command: usize, color: Premultiplied16, kind: u32) -> Self {
        let opaque = if color.is_opaque() { Self::OPAQUE } else { 0 };
        Self {
            head: Self::number(command) | kind | opaque,
            at: [0; 2],
            bits: 0,
            color,
        }
    }

    /// The beginning or end of a layer.
    pub(crate) fn layer(command: usize) -> Self {
        Self {
            head: Self::number(command),
            ..Self::default()
        }
    }

    #[inline]
    fn number(command: usize) -> u32 {
        debug_assert!(
            command <= Self::MAX_COMMAND as usize,
            "command {command} fits below the flags"
        );
        u32::try_from(command).unwrap_or(0) & Self::MAX_COMMAND
    }

    /// The same stamp with its bits, of which the first, set or not, lies at column `x` and row `y` of the tile.
    #[inline]
    pub(crate) fn with_bits(self, [x, y]: [u16; 2], bits: u64) -> Self {
        Self {
            at: [x, y],
            bits,
            ..self
        }
    }

    /// The same shape where it covers every sample of the tile; `hides` says whether nothing painted in the tile
    /// before can be seen.
    #[inline]
    pub(crate) fn covering(self, hides: bool) -> Self {
        let hides = if hides { Self::HIDES } else { 0 };
        Self {
            head: self.head | Self::COVERS | hides,
            ..self
        }
    }

    /// The same shape in the tile columns that it touches, given with those that it covers; `base` says that it is in no layer.
    #[inline]
    pub(super) fn along_row(self, [touched, covered]: [Span; 2], base: bool) -> impl Iterator<Item = (i32, Self)> {
        (touched.start..touched.end).map(move |column| {
            let covers = covered.start <= column && column < covered.end;
            let entry = if covers {
                self.covering(base && self.is_opaque())
            } else {
                self
            };
            (column, entry)
        })
    }

    /// The same shape by its edges, as in any other tile.
    #[cfg(test)]
    pub(crate) fn uncovered(self) -> Self {
        Self {
            head: self.head & !Self::COVERS,
            ..self
        }
    }

    /// Index of the command in its chunk.
    #[inline]
    pub(crate) fn command(self) -> usize {
        (self.head & Self::MAX_COMMAND) as usize
    }

    /// Index of a triangle or outline among those of its chunk.
    #[inline]
    pub(crate) fn primitive(self) -> usize {
        usize::try_from(self.bits).unwrap_or(usize::MAX)
    }

    /// Whether the command is a triangle or polygon that covers every sample of the tile.
    #[inline]
    pub(crate) fn covers_tile(self) -> bool {
        self.head & Self::COVERS != 0
    }

    /// Whether nothing painted in the tile before this command can be seen.
    #[inline]
    pub(crate) fn hides_tile(self) -> bool {
        self.head & Self::HIDES != 0
    }

    /// Whether it paints, and every fragment hides what is below it.
    #[inline]
    pub(crate) fn is_opaque(self) -> bool {
        self.head & Self::OPAQUE != 0
    }

    /// What is to be painted; `chunk` is the one that the entry belongs to.
    #[inline]
    pub(crate) fn work(self, chunk: &Chunk) -> Work<'_> {
        let coverage = CoverageMask {
            column: i32::from(self.at[0]),
            row: i32::from(self.at[1]),
            mask: self.bits,
        };
        let covered = |shape| if self.covers_tile() { Shape::Tile } else { shape };
        if self.head & Self::SAMPLES != 0 {
            return Work::Flat(Shape::Samples(coverage), self.color);
        }
        if self.head & Self::PIXELS != 0 {
            return Work::Flat(Shape::Pixels(coverage), self.color);
        }
        if self.head & Self::FLAT != 0 {
            let triangle = Shape::Triangle(&chunk.triangles[self.primitive()].corners);
            return Work::Flat(covered(triangle), self.color);
        }
        if self.head & Self::OUTLINE != 0 {
            let index = u32::try_from(self.bits).unwrap_or(u32::MAX);
            return Work::Flat(covered(Shape::Outline(chunk.outline(index))), self.color);
        }
        match chunk.commands[self.command()] {
            DrawCommand::Triangle(index) => {
                let triangle = &chunk.triangles[index as usize];
                let paint = &chunk.paints[triangle.paint as usize];
                let float = chunk.floats.get(index as usize);
                let shape = covered(float.map_or(Shape::Triangle(&triangle.corners), Shape::Float));
                match paint.constant {
                    Some(color) => Work::Flat(shape, color),
                    None => Work::Shaded(shape, &triangle.corners, &paint.paint),
                }
            }
            DrawCommand::BeginLayer(index) | DrawCommand::EndLayer(index) => {
                let compositing = chunk.layers[index as usize].compositing;
                compositing.map_or(Work::BeginLayer, Work::EndLayer)
            }
            DrawCommand::Outline(index) => {
                let paint = &chunk.outline_paint(index).paint;
                Work::Shaded(Shape::Outline(chunk.outline(index)), &NO_CORNERS, paint)
            }
            // Stamps and hairlines have returned above.
            DrawCommand::Samples(_) | DrawCommand::Pixels(_) | DrawCommand::Hairline(_) => Work::BeginLayer,
        }
    }
}
