//! Outlines of which every sample row is crossed by two edges or by none: most of them, without sorting anything.
//!
//! Where two edges cross a row, one runs up and one runs down; what lies between them is inside, whatever the fill rule.

use fearless_simd::{Simd, dispatch};

use super::outline::OutlineEdge;
use super::rows::Span;
use crate::geometry::edge::EdgeWalker;
use crate::geometry::subpixel::SubpixelGrid;
use crate::simd;

/// From so many rows on that an edge crosses, it is walked four rows at a time.
const LONG: usize = 8;

/// Looks at outlines, reusing its memory.
#[derive(Debug, Default)]
pub(super) struct PlainRows {
    /// How the crossings of each row differ from those of the row above: their number, and in the upper half the sum of
    /// their windings.
    changes: Vec<i64>,
    /// The least and the greatest column in which an edge crosses each row.
    least: Vec<i32>,
    greatest: Vec<i32>,
}

impl PlainRows {
    /// Adds the span of each of `rows` to `spans`, left of the frame's end at column `end`; false, and nothing added, where
    /// a row is crossed by other edges than one that runs up and one that runs down. `edges` come with those of the rows
    /// that they cross.
    pub(super) fn scan<'c>(
        &mut self,
        edges: impl Iterator<Item = (&'c OutlineEdge, Span)> + Clone,
        grid: SubpixelGrid,
        (rows, end): (Span, i32),
        spans: &mut Vec<Span>,
    ) -> bool {
        let count = place(rows.end - rows.start);
        if !self.is_plain(edges.clone(), rows, count) {
            return false;
        }
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
        true
    }

    fn is_plain<'c>(&mut self, edges: impl Iterator<Item = (&'c OutlineEdge, Span)>, rows: Span, count: usize) -> bool {
        self.changes.clear();
        self.changes.resize(count + 1, 0);
        for (edge, inside) in edges {
            let change = 1 + (i64::from(edge.winding) << 32);
            self.changes[place(inside.start - rows.start)] += change;
            self.changes[place(inside.end - rows.start)] -= change;
        }
        let (mut crossing, mut other) = (0, 0);
        for change in &self.changes[..count] {
            crossing += change;
            // Neither none nor two with windings that cancel out.
            other |= crossing & !2;
        }
        other == 0
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
                    let range = place(inside.start - top)..place(inside.end - top);
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
    let (mut least, mut greatest) = (least, greatest);
    if least.len() >= LONG {
        let mut rows = edge.four_rows();
        let (least_fours, least_rest) = least.as_chunks_mut::<4>();
        let (greatest_fours, greatest_rest) = greatest.as_chunks_mut::<4>();
        for (least, greatest) in least_fours.iter_mut().zip(greatest_fours) {
            let columns = rows.at_or_after();
            for i in 0..4 {
                least[i] = least[i].min(columns[i]);
                greatest[i] = greatest[i].max(columns[i]);
            }
            rows.step();
        }
        edge.go_to(&rows);
        (least, greatest) = (least_rest, greatest_rest);
    }
    for (least, greatest) in least.iter_mut().zip(greatest) {
        let column = edge.at_or_after();
        *least = column.min(*least);
        *greatest = column.max(*greatest);
        edge.step();
    }
}

/// A distance that is never negative.
#[inline]
fn place(distance: i32) -> usize {
    distance.max(0).cast_unsigned() as usize
}
