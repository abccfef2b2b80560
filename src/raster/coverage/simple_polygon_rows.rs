//! Outlines of which every sample row is crossed by two edges or by none: most of them, without sorting anything.
//!
//! Where two edges cross a row, one runs up and one runs down; what lies between them is inside, whatever the fill rule.

use fearless_simd::{Simd, dispatch};

use crate::geometry::edge::EdgeWalker;
use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::coverage::polygon::OutlineEdge;
use crate::raster::span::{Span, SpanRect, to_index};
use crate::simd;

/// Looks at outlines, reusing its memory.
#[derive(Debug, Default)]
pub(in crate::raster) struct SimplePolygonRows {
    /// The least and the greatest column in which an edge crosses each row.
    least: Vec<i32>,
    greatest: Vec<i32>,
}

/// How many edges cross each of some rows, and how they wind, kept as what changes from each row to the next.
#[derive(Debug, Default)]
pub(in crate::raster) struct Crossings {
    /// In the lower half the number, in the upper half the sum of the windings; one more than there are rows.
    changes: Vec<i64>,
}

impl Crossings {
    /// Counts edges, which come with those of `rows` that they cross.
    pub(in crate::raster) fn count<'c>(&mut self, edges: impl Iterator<Item = (&'c OutlineEdge, Span)>, rows: Span) {
        self.changes.clear();
        self.changes.resize(to_index(rows.end - rows.start) + 1, 0);
        for (edge, inside) in edges {
            let change = 1 + (i64::from(edge.winding) << 32);
            self.changes[to_index(inside.start - rows.start)] += change;
            self.changes[to_index(inside.end - rows.start)] -= change;
        }
    }

    /// Number and windings, row by row.
    fn rows(&self) -> impl Iterator<Item = i64> {
        let rows = self.changes.split_last().map_or(&[][..], |(_, rows)| rows);
        rows.iter().scan(0, |crossing, change| {
            *crossing += change;
            Some(*crossing)
        })
    }

    /// Whether each row is crossed by two edges, one that runs up and one that runs down, or by none.
    pub(in crate::raster) fn are_plain(&self) -> bool {
        // Windings that cancel out are zero.
        self.rows().fold(0, |other, crossing| other | crossing & !2) == 0
    }

    /// The number of crossings in each row.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the lower half: far fewer than 2^32"
    )]
    pub(in crate::raster) fn numbers(&self) -> impl Iterator<Item = u32> {
        self.rows().map(|crossing| crossing as u32)
    }
}

impl SimplePolygonRows {
    /// Adds the span of each row of `within` to `spans`, from the frame's left side to the end of its columns; the rows'
    /// crossings must be [plain](Crossings::are_plain). `edges` come with those of the rows that they cross.
    pub(in crate::raster) fn scan<'c>(
        &mut self,
        edges: impl Iterator<Item = (&'c OutlineEdge, Span)>,
        grid: SubpixelGrid,
        within: SpanRect,
        spans: &mut Vec<Span>,
    ) {
        let (rows, end) = (within.y, within.x.end);
        let count = to_index(rows.end - rows.start);
        self.least.clear();
        self.least.resize(count, Span::EMPTY.start);
        self.greatest.clear();
        self.greatest.resize(count, Span::EMPTY.end);
        dispatch!(simd::level(), simd => self.walk(simd, edges, grid, rows.start));
        let both = self.least.iter().zip(&self.greatest);
        spans.extend(both.map(|(least, greatest)| {
            let span = Span {
                start: *least.max(&0),
                end: *greatest.min(&end),
            };
            if span.is_empty() { Span::EMPTY } else { span }
        }));
    }

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn walk<'c, S: Simd>(
        &mut self,
        simd: S,
        edges: impl Iterator<Item = (&'c OutlineEdge, Span)>,
        grid: SubpixelGrid,
        top: i32,
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                for (edge, inside) in edges {
                    let walker = EdgeWalker::new(grid, edge.top, edge.bottom, inside.start);
                    let range = to_index(inside.start - top)..to_index(inside.end - top);
                    widen(walker, &mut self.least[range.clone()], &mut self.greatest[range]);
                }
            },
        );
    }
}

/// Walks down an edge by as many rows as there are, and notes its columns where they are the least or the greatest.
#[inline(always)]
#[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
fn widen(mut edge: EdgeWalker, least: &mut [i32], greatest: &mut [i32]) {
    for (least, greatest) in least.iter_mut().zip(greatest) {
        let column = edge.at_or_after();
        *least = column.min(*least);
        *greatest = column.max(*greatest);
        edge.step();
    }
}
