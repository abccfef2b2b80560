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
use crate::raster::coverage::area::edge::{AreaEdge, PIXEL, rounded};
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
    /// Their parts in the row at work, from left to right.
    parts: Vec<Part>,
    sorter: PartSorter,
    bands: BandMemory,
    row: AreaRow,
}

/// What of an edge lies in a row.
#[derive(Clone, Copy, Debug)]
struct Part {
    /// Which of the edges.
    edge: usize,
    /// Its upper and its lower end.
    y: [i64; 2],
    x: [i64; 2],
}

/// Sorts the parts of a row: numbers are moved instead of them.
#[derive(Debug, Default)]
struct PartSorter {
    /// Their left ends; which.
    keys: Vec<(i64, usize)>,
    sorted: Vec<Part>,
}

/// What bands are made of, kept for the next ones.
#[derive(Debug, Default)]
struct BandMemory {
    /// Where bands begin and end.
    heights: Vec<i64>,
    /// The parts of a group by their upper ends; which.
    tops: Vec<(i64, usize)>,
    /// The parts of a group at the band at work.
    crossing: Vec<Crossing>,
    /// Those that cross it, from left to right: where they cross its middle, doubled; which.
    ordered: Vec<(i64, usize)>,
}

/// A part of an edge at a band.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    edge: AreaEdge,
    /// Where the part ends.
    end: i64,
    /// Where it crosses the band's upper and lower end.
    x: [i64; 2],
}

/// Cuts groups of edges into bands in which they keep their order.
struct Bands<'m> {
    memory: &'m mut BandMemory,
    edges: &'m [(Span, AreaEdge)],
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
        // In any order inside a row: what lies there is sorted.
        self.edges.sort_unstable_by_key(|(rows, _)| rows.start);
        self.parts.clear();
        let mut next = 0;
        for y in rows.start..rows.end {
            let [top, bottom] = [y, y + 1].map(|y| i64::from(y) * PIXEL);
            let edges = &self.edges;
            self.parts.retain_mut(|part| {
                let (rows, edge) = &edges[part.edge];
                part.go_on(edge, bottom);
                rows.end > y
            });
            while let Some((_, edge)) = edges.get(next).filter(|(rows, _)| rows.start <= y) {
                self.parts.push(Part::new(next, edge, [top, bottom]));
                next += 1;
            }
            if self.parts.is_empty() {
                continue;
            }
            self.sum_up([top, bottom], of.outline.rule);
            self.row.take(|covered| visit(y, covered));
        }
    }

    /// Adds the row of pixels from `top` to `bottom`.
    fn sum_up(&mut self, [top, bottom]: [i64; 2], rule: FillRule) {
        self.sorter.sort(&mut self.parts, &self.edges);
        let (edges, row) = (self.edges.as_slice(), &mut self.row);
        let (mut rest, mut around) = (self.parts.as_slice(), 0);
        while let Some((first, others)) = rest.split_first() {
            let mut end = first.right();
            let apart = others.iter().position(|part| {
                let is_apart = part.left() > end;
                end = end.max(part.right());
                is_apart
            });
            let (group, next) = rest.split_at(apart.map_or(rest.len(), |others| others + 1));
            let mut bands = Bands {
                memory: &mut self.bands,
                edges,
                rule,
                around,
            };
            bands.add(group, [top, bottom], row);
            // Contours that enter a group leave it above or below: it winds alike at all heights.
            around += group
                .iter()
                .filter(|part| part.y[0] == top && part.y[1] > top)
                .map(|part| edges[part.edge].1.winding)
                .sum::<i32>();
            rest = next;
        }
    }
}

impl Part {
    /// What lies in the first row that edge number `number` touches.
    fn new(number: usize, edge: &AreaEdge, [top, bottom]: [i64; 2]) -> Self {
        let y = [edge.top[1].max(top), edge.bottom[1].min(bottom)];
        let x = if edge.top[1] == edge.bottom[1] {
            [edge.top[0], edge.bottom[0]]
        } else {
            y.map(|y| edge.x_at(y))
        };
        Self { edge: number, y, x }
    }

    /// Goes to the next row of the same edge, which ends at `bottom`.
    #[inline]
    fn go_on(&mut self, edge: &AreaEdge, bottom: i64) {
        let bottom = edge.bottom[1].min(bottom);
        self.y = [self.y[1], bottom];
        self.x = [self.x[1], edge.x_at(bottom)];
    }

    /// Its least column.
    fn left(&self) -> i64 {
        self.x[0].min(self.x[1])
    }

    /// Its greatest column.
    fn right(&self) -> i64 {
        self.x[0].max(self.x[1])
    }
}

impl PartSorter {
    /// By the left end; beyond that by what makes any two the same that are interchangeable.
    fn sort(&mut self, parts: &mut Vec<Part>, edges: &[(Span, AreaEdge)]) {
        self.keys.clear();
        self.keys
            .extend(parts.iter().enumerate().map(|(number, part)| (part.left(), number)));
        self.keys.sort_unstable();
        for alike in self.keys.chunk_by_mut(|a, b| a.0 == b.0) {
            if alike.len() > 1 {
                alike.sort_unstable_by_key(|(_, number)| {
                    let edge = &edges[parts[*number].edge].1;
                    (parts[*number].right(), edge.top, edge.bottom, edge.winding)
                });
            }
        }
        self.sorted.clear();
        self.sorted.extend(self.keys.iter().map(|(_, number)| parts[*number]));
        std::mem::swap(parts, &mut self.sorted);
    }
}

impl Bands<'_> {
    /// Adds a group of edges, of which none is apart from the others, to a row from `top` to `bottom`.
    fn add(&mut self, parts: &[Part], [top, bottom]: [i64; 2], row: &mut AreaRow) {
        let band = parts[0].y;
        let keeps_order = |pair: &[Part]| pair[0].x[0] <= pair[1].x[0] && pair[0].x[1] <= pair[1].x[1];
        if parts.iter().all(|part| part.y == band) && parts.windows(2).all(keeps_order) {
            let through = parts.iter().map(|part| (&self.edges[part.edge].1, part.x));
            return self.add_band(through, band, row);
        }
        // A curve on its way through the row, edge after edge.
        let goes_down = |pair: &[Part]| pair[0].y[1] <= pair[1].y[0];
        let goes_up = |pair: &[Part]| pair[1].y[1] <= pair[0].y[0];
        if parts.windows(2).all(goes_down) || parts.windows(2).all(goes_up) {
            for part in parts {
                self.add_band(std::iter::once((&self.edges[part.edge].1, part.x)), part.y, row);
            }
            return;
        }
        self.find(parts, [top, bottom]);
        let mut memory = std::mem::take(self.memory);
        let BandMemory {
            heights,
            tops,
            crossing,
            ordered,
        } = &mut memory;
        tops.clear();
        tops.extend(parts.iter().enumerate().map(|(number, part)| (part.y[0], number)));
        tops.sort_unstable();
        crossing.clear();
        crossing.extend(parts.iter().map(|part| Crossing {
            edge: self.edges[part.edge].1,
            end: part.y[1],
            x: part.x,
        }));
        ordered.clear();
        let mut next = 0;
        for band in heights.windows(2).map(|ends| [ends[0], ends[1]]) {
            let middle = i64::midpoint(band[0], band[1]);
            let mut count = 0;
            for at in 0..ordered.len() {
                let number = ordered[at].1;
                let part = &mut crossing[number];
                if part.end > middle {
                    // A band begins where the one above ends.
                    let x = [part.x[1], part.edge.x_at(band[1])];
                    part.x = x;
                    ordered[count] = (x[0] + x[1], number);
                    move_back(&mut ordered[..=count]);
                    count += 1;
                }
            }
            ordered.truncate(count);
            while let Some((_, number)) = tops.get(next).filter(|(top, _)| *top <= middle) {
                let part = &mut crossing[*number];
                if part.end > middle {
                    let x = band.map(|y| part.edge.x_at(y));
                    part.x = x;
                    ordered.push((x[0] + x[1], *number));
                    move_back(ordered);
                }
                next += 1;
            }
            if ordered.len() > MOST_EDGES {
                ordered.sort_unstable();
            }
            let crossing = ordered.iter().map(|(_, number)| &crossing[*number]);
            self.add_band(crossing.map(|part| (&part.edge, part.x)), band, row);
        }
        *self.memory = memory;
    }

    /// Finds the heights at which edges end or cross.
    fn find(&mut self, parts: &[Part], [top, bottom]: [i64; 2]) {
        let heights = &mut self.memory.heights;
        heights.clear();
        heights.extend([top, bottom]);
        heights.extend(parts.iter().flat_map(|part| part.y));
        if parts.len() <= MOST_EDGES {
            for (number, part) in parts.iter().enumerate() {
                // From left to right: none of those beyond reaches back.
                let others = parts[number + 1..].iter();
                let others = others.take_while(|other| other.left() <= part.right());
                heights.extend(others.filter_map(|other| crossing(self.edges, part, other)));
            }
        }
        heights.sort_unstable();
        heights.dedup();
        if parts.len() > MOST_EDGES || heights.len() * parts.len() > MOST_LOOKS {
            heights.clear();
            heights.extend((0..=EQUAL_BANDS).map(|band| top + (bottom - top) * band / EQUAL_BANDS));
        }
    }

    /// Adds those of a band's edges, from left to right, at which the shape begins or ends; each with where it crosses the band's
    /// ends.
    fn add_band<'e>(
        &self,
        edges: impl Iterator<Item = (&'e AreaEdge, [i64; 2])>,
        [top, bottom]: [i64; 2],
        row: &mut AreaRow,
    ) {
        if top >= bottom {
            return;
        }
        let (mut winding, mut is_inside) = (self.around, self.rule.encloses(self.around));
        for (edge, x) in edges {
            winding += edge.winding;
            if self.rule.encloses(winding) != is_inside {
                row.add(edge, [[x[0], top], [x[1], bottom]], if is_inside { -1 } else { 1 });
                is_inside = !is_inside;
            }
        }
    }
}

/// Moves the last number back to its place among the others, which are in order: not far, since they were in a band or a row
/// above. Too many are sorted later.
#[inline]
fn move_back(ordered: &mut [(i64, usize)]) {
    if let Some((last, others)) = ordered.split_last()
        && others.len() < MOST_EDGES
    {
        let last = *last;
        let mut at = others.len();
        while at > 0 && last < ordered[at - 1] {
            ordered[at] = ordered[at - 1];
            at -= 1;
        }
        ordered[at] = last;
    }
}

/// The height at which two of the edges cross, if they do inside the row.
fn crossing(edges: &[(Span, AreaEdge)], a: &Part, b: &Part) -> Option<i64> {
    let y = [a.y[0].max(b.y[0]), a.y[1].min(b.y[1])];
    if y[0] >= y[1] {
        return None;
    }
    let [above, below] = y.map(|y| edges[a.edge].1.x_at(y) - edges[b.edge].1.x_at(y));
    if above.signum() * below.signum() >= 0 {
        return None;
    }
    let part = above as f64 / (above - below) as f64;
    Some(y[0] + rounded((y[1] - y[0]) as f64 * part)).filter(|at| y[0] < *at && *at < y[1])
}
