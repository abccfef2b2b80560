//! The areas of outlines, row by row of pixels, by their fill rule, however their contours overlap.
//!
//! ```text
//!      \    /         a row of pixels whose edges cross:
//!     --\--/----
//!        \/           one band above the crossing, one below; in each of them
//!     ---/\-----      edges keep their order from left to right
//!       /  \
//! ```
//!
//! Edges that lie apart from all others, as most do, are looked at by themselves.

use crate::geometry::FillRule;
use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::coverage::area::edge::{AreaEdge, PIXEL, ordered, rounded};
use crate::raster::coverage::area::row::{AreaRow, CoveredArea};
use crate::raster::coverage::polygon::OutlineWithEdges;
use crate::raster::span::Span;

/// Bands of equal height that a row is cut into where its edges are too many to look for each crossing: areas are then those of
/// edges that change their places at these heights only.
const EQUAL_BANDS: i64 = 256;

/// Edges of one row among which crossings are looked for.
const MOST_EDGES: usize = 512;

/// How often the edges of one row are looked at, one look for each band.
const MOST_LOOKS: usize = 1 << 20;

/// Finds the areas of outlines, reusing its memory.
#[derive(Debug, Default)]
pub(super) struct OutlineAreas {
    /// The edges in some rows, by their first row, each with those rows.
    edges: Vec<(Span, AreaEdge)>,
    /// Those of the row at work.
    active: Vec<(Span, AreaEdge)>,
    /// Their parts in this row.
    parts: Vec<Part>,
    /// Where bands begin and end.
    heights: Vec<i64>,
    /// The edges of the band at work: where they cross it, twice the middle; which.
    ordered: Vec<(i64, usize)>,
    row: AreaRow,
}

/// What of an edge lies in a row.
#[derive(Clone, Copy, Debug)]
struct Part {
    /// Its least and its greatest column.
    reach: [i64; 2],
    edge: AreaEdge,
    y: [i64; 2],
    x: [i64; 2],
}

/// Cuts groups of edges into bands in which they keep their order.
struct Bands<'m> {
    /// Where bands begin and end.
    heights: &'m mut Vec<i64>,
    /// The edges of the band at work: where they cross it, twice the middle; which.
    ordered: &'m mut Vec<(i64, usize)>,
    rule: FillRule,
    /// How often the contours wind around what lies left of the group.
    around: i32,
}

impl OutlineAreas {
    /// Calls `visit` with what an outline covers of these rows and columns of pixels: from top to bottom, from left to right.
    pub(super) fn each(
        &mut self,
        of: OutlineWithEdges<'_>,
        grid: SubpixelGrid,
        [columns, rows]: [Span; 2],
        mut visit: impl FnMut(i32, CoveredArea),
    ) {
        self.row.go_to(columns);
        self.edges.clear();
        self.edges.extend(of.edges_in(rows).map(|(edge, inside)| {
            let ends = [edge.top, edge.bottom];
            (inside, AreaEdge::new(grid, ends, edge.winding))
        }));
        self.edges.sort_by_key(|(rows, _)| rows.start);
        self.active.clear();
        let mut next = 0;
        for y in rows.start..rows.end {
            // In any order: what lies in the row is sorted.
            let mut at = 0;
            while let Some((rows, _)) = self.active.get(at) {
                if rows.end > y {
                    at += 1;
                } else {
                    self.active.swap_remove(at);
                }
            }
            while let Some(edge) = self.edges.get(next).filter(|(rows, _)| rows.start <= y) {
                self.active.push(*edge);
                next += 1;
            }
            if self.active.is_empty() {
                continue;
            }
            self.sum_up(i64::from(y) * PIXEL, of.outline.rule);
            self.row.take(|covered| visit(y, covered));
        }
    }

    /// Adds the row of pixels that begins at `top`.
    fn sum_up(&mut self, top: i64, rule: FillRule) {
        let bottom = top + PIXEL;
        self.parts.clear();
        self.parts
            .extend(self.active.iter().map(|(_, edge)| Part::new(*edge, [top, bottom])));
        self.parts.sort_unstable_by_key(Part::order);
        let Self {
            parts,
            ordered,
            heights,
            row,
            ..
        } = self;
        let (mut rest, mut around) = (parts.as_slice(), 0);
        while let Some((first, others)) = rest.split_first() {
            let mut end = first.reach[1];
            let apart = others.iter().position(|part| {
                let is_apart = part.reach[0] > end;
                end = end.max(part.reach[1]);
                is_apart
            });
            let (group, next) = rest.split_at(apart.map_or(rest.len(), |others| others + 1));
            let mut bands = Bands {
                heights,
                ordered,
                rule,
                around,
            };
            bands.add(group, [top, bottom], row);
            // Contours that enter a group leave it above or below: it winds alike at all heights.
            around += group
                .iter()
                .filter(|part| part.y[0] == top && part.y[1] > top)
                .map(|part| part.edge.winding)
                .sum::<i32>();
            rest = next;
        }
    }
}

impl Part {
    fn new(edge: AreaEdge, [top, bottom]: [i64; 2]) -> Self {
        let y = [edge.top[1].max(top), edge.bottom[1].min(bottom)];
        let x = if edge.top[1] == edge.bottom[1] {
            [edge.top[0], edge.bottom[0]]
        } else {
            y.map(|y| edge.x_at(y))
        };
        Self {
            reach: ordered(x[0], x[1]),
            edge,
            y,
            x,
        }
    }

    /// By the left end; beyond that by what makes any two the same that are interchangeable.
    fn order(&self) -> ([i64; 2], [i64; 2], [i64; 2], i32) {
        (self.reach, self.edge.top, self.edge.bottom, self.edge.winding)
    }
}

impl Bands<'_> {
    /// Adds a group of edges, of which none is apart from the others, to a row from `top` to `bottom`.
    fn add(&mut self, parts: &[Part], [top, bottom]: [i64; 2], row: &mut AreaRow) {
        let is_through = |part: &Part| part.y == [top, bottom];
        let keeps_order = |pair: &[Part]| pair[0].x[0] <= pair[1].x[0] && pair[0].x[1] <= pair[1].x[1];
        if parts.iter().all(is_through) && parts.windows(2).all(keeps_order) {
            return self.add_band(parts.iter().map(|part| &part.edge), [top, bottom], row);
        }
        self.find(parts, [top, bottom]);
        for i in 1..self.heights.len() {
            let band = [self.heights[i - 1], self.heights[i]];
            let middle = i64::midpoint(band[0], band[1]);
            let mut ordered = std::mem::take(self.ordered);
            ordered.clear();
            for (number, part) in parts.iter().enumerate() {
                if part.y[0] <= middle && middle < part.y[1] {
                    let [above, below] = band.map(|y| part.edge.x_at(y));
                    ordered.push((above + below, number));
                }
            }
            ordered.sort_unstable();
            self.add_band(ordered.iter().map(|(_, number)| &parts[*number].edge), band, row);
            *self.ordered = ordered;
        }
    }

    /// Finds the heights at which edges end or cross.
    fn find(&mut self, parts: &[Part], [top, bottom]: [i64; 2]) {
        let heights = &mut *self.heights;
        heights.clear();
        heights.extend([top, bottom]);
        heights.extend(parts.iter().flat_map(|part| part.y));
        if parts.len() <= MOST_EDGES {
            for (number, part) in parts.iter().enumerate() {
                heights.extend(parts[number + 1..].iter().filter_map(|other| crossing(part, other)));
            }
        }
        heights.sort_unstable();
        heights.dedup();
        if parts.len() > MOST_EDGES || heights.len() * parts.len() > MOST_LOOKS {
            heights.clear();
            heights.extend((0..=EQUAL_BANDS).map(|band| top + (bottom - top) * band / EQUAL_BANDS));
        }
    }

    /// Adds those of a band's edges, from left to right, at which the shape begins or ends.
    fn add_band<'e>(&self, edges: impl Iterator<Item = &'e AreaEdge>, band: [i64; 2], row: &mut AreaRow) {
        let (mut winding, mut is_inside) = (self.around, self.rule.encloses(self.around));
        for edge in edges {
            winding += edge.winding;
            if self.rule.encloses(winding) != is_inside {
                row.add(edge, band, if is_inside { -1 } else { 1 });
                is_inside = !is_inside;
            }
        }
    }
}

/// The height at which two edges cross, if they do inside the row.
fn crossing(a: &Part, b: &Part) -> Option<i64> {
    let y = [a.y[0].max(b.y[0]), a.y[1].min(b.y[1])];
    if y[0] >= y[1] || a.reach[1] < b.reach[0] {
        return None;
    }
    let [above, below] = y.map(|y| a.edge.x_at(y) - b.edge.x_at(y));
    if above.signum() * below.signum() >= 0 {
        return None;
    }
    let part = above as f64 / (above - below) as f64;
    Some(y[0] + rounded((y[1] - y[0]) as f64 * part)).filter(|at| y[0] < *at && *at < y[1])
}
