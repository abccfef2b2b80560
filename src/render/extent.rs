//! How wide and how long a primitive is near a pixel, together with the triangles that continue it: what has one edge and one paint
//! with its neighbour has no border there.

use std::collections::{HashMap, HashSet};

use glam::DVec2;
use rayon::prelude::*;

use super::number;
use super::replay::{Explainer, bounds, placed, touch};
use crate::geometry::{BEYOND, FillRule, cut_to_window, width_in_window, width_of_part};
use crate::scene::{Paint, PrimitiveKind};

/// Triangles whose common outline is looked for at most, and triangles near a pixel beyond which none is joined with others: it would
/// take as long as drawing.
const MOST_JOINED: usize = 200;
const MOST_NEAR: usize = 50_000;

/// How large a primitive is near a pixel, together with the triangles that continue it, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// In the thinnest direction, as far as it lies in the pixel or beside it, or that of the widest of the parts there that touch
    /// the pixel.
    pub width: f64,
    /// The longer side of the box around it.
    pub length: f64,
}

/// The ends of an edge, as they can be looked up: in an order that does not depend on whose it is.
type Ends = [[u64; 2]; 2];

impl Explainer<'_> {
    /// How large primitives are in the pixel and at most `around` pixels beside it; `None` where [`Explainer::area`] is, and for what
    /// does not lie there.
    pub fn extents(&self, sources: &[u32], around: f64) -> Vec<Option<Extent>> {
        let corner = DVec2::from(self.pixel.map(f64::from));
        let window = [corner - around, corner + 1.0 + around];
        let is_triangle = |source: &u32| matches!(self.kind(*source), Some(PrimitiveKind::Triangle { .. }));
        let beside = if sources.iter().any(is_triangle) {
            self.edges_near([window[0] - BEYOND, window[1] + BEYOND])
        } else {
            HashMap::new()
        };
        let mut known = HashMap::new();
        let extent = |source: &u32| {
            if let Some(known) = known.get(source) {
                return *known;
            }
            let joined = self.joined(*source, &beside);
            let width = self.width(&joined, window, around);
            let extent = width.zip(self.length(&joined));
            let extent = extent.map(|(width, length)| Extent { width, length });
            known.extend(joined.into_iter().map(|source| (source, extent)));
            extent
        };
        sources.iter().map(extent).collect()
    }

    fn width(&self, joined: &[u32], window: [DVec2; 2], around: f64) -> Option<f64> {
        let screen = self.screen();
        let around_it = [window[0] - BEYOND, window[1] + BEYOND];
        if let [source] = joined
            && let PrimitiveKind::Polygon { polygon, .. } = self.kind(*source)?
        {
            return screen.with_edges(polygon, |polygon| {
                let inside = cut_to_window(placed(polygon, &screen), polygon.rule(), around_it);
                width_of_part(inside.triangles()?, window, around)
            });
        }
        let triangles = joined.iter().filter_map(|source| match self.kind(*source)? {
            PrimitiveKind::Triangle { points, .. } => Some(points.map(|point| screen.place(point))),
            _ => None,
        });
        if joined.len() < 2 || joined.len() > MOST_JOINED {
            return width_in_window(triangles, window);
        }
        let contours = triangles.map(|corners| turned_one_way(corners).into_iter());
        let inside = cut_to_window(contours, FillRule::NonZero, around_it);
        width_of_part(inside.triangles()?, window, around)
    }

    fn length(&self, joined: &[u32]) -> Option<f64> {
        let screen = self.screen();
        let boxes = joined.iter().filter_map(|source| bounds(&screen, self.kind(*source)?));
        let [low, high] = boxes.reduce(|one, other| [one[0].min(other[0]), one[1].max(other[1])])?;
        Some((high - low).max_element())
    }

    fn kind(&self, source: u32) -> Option<&PrimitiveKind> {
        Some(&self.subject.scene.primitives.get(source as usize)?.kind)
    }

    /// A primitive and the triangles that continue it, one after the other, of those that are given by their edges.
    fn joined(&self, source: u32, beside: &HashMap<Ends, Vec<u32>>) -> Vec<u32> {
        let mut found = vec![source];
        let mut known = HashSet::from([source]);
        let mut at = 0;
        while let Some(one) = found.get(at).copied() {
            at += 1;
            for edge in 0..3 {
                let beside = self.ends(one, edge).and_then(|ends| beside.get(&ends));
                for other in beside.into_iter().flatten().copied() {
                    if self.continues(one, edge, other) && known.insert(other) {
                        found.push(other);
                    }
                }
            }
        }
        found
    }

    /// The triangles that touch a window, by their edges.
    fn edges_near(&self, window: [DVec2; 2]) -> HashMap<Ends, Vec<u32>> {
        let screen = self.screen();
        let all = self.subject.scene.primitives.par_iter().enumerate();
        let near = all.filter(|(_, primitive)| {
            let is_triangle = matches!(primitive.kind, PrimitiveKind::Triangle { .. });
            is_triangle && bounds(&screen, &primitive.kind).is_some_and(|bounds| touch(bounds, window))
        });
        let near: Vec<u32> = near.map(|(index, _)| number(index)).collect();
        let mut edges: HashMap<Ends, Vec<u32>> = HashMap::new();
        for source in near.into_iter().take(MOST_NEAR) {
            for ends in (0..3).filter_map(|edge| self.ends(source, edge)) {
                edges.entry(ends).or_default().push(source);
            }
        }
        edges
    }

    /// The ends of an edge of a triangle, which runs from this corner to the next.
    fn ends(&self, source: u32, edge: usize) -> Option<Ends> {
        let PrimitiveKind::Triangle { points, .. } = self.kind(source)? else {
            return None;
        };
        let mut ends = [points[edge], points[(edge + 1) % 3]].map(key);
        ends.sort_unstable();
        Some(ends)
    }

    /// Whether a triangle has the colours of another one along an edge of that, which is one of its own, too.
    fn continues(&self, one: u32, edge: usize, other: u32) -> bool {
        let both = self.kind(one).zip(self.kind(other));
        let Some((
            PrimitiveKind::Triangle { points, paint },
            PrimitiveKind::Triangle {
                points: corners,
                paint: other,
            },
        )) = both
        else {
            return false;
        };
        let same = |corner: usize| corners.iter().position(|place| key(*place) == key(points[corner]));
        let next = (edge + 1) % 3;
        let shared = same(edge).zip(same(next));
        shared.is_some_and(|(first, second)| {
            [(edge, first), (next, second)]
                .into_iter()
                .all(|pair| is_one_paint([paint, other], pair))
        })
    }
}

/// Whether two triangles have the same paint in a corner of the one and a corner of the other.
fn is_one_paint(paints: [&Paint; 2], (one, other): (usize, usize)) -> bool {
    match paints {
        [Paint::Solid(own), Paint::Solid(beside)] => own == beside,
        [Paint::Vertex(own), Paint::Vertex(beside)] => own[one] == beside[other],
        [
            Paint::Texture { texture, uv, opacity },
            Paint::Texture {
                texture: beside,
                uv: uv_beside,
                opacity: opacity_beside,
            },
        ] => {
            let is_as_opaque = opacity.to_bits() == opacity_beside.to_bits();
            texture == beside && is_as_opaque && uv[one] == uv_beside[other]
        }
        _ => false,
    }
}

/// The corners in the order in which the area is not below zero, so that no two triangles take each other away.
fn turned_one_way([a, b, c]: [DVec2; 3]) -> [DVec2; 3] {
    if (b - a).perp_dot(c - a) < 0.0 {
        [a, c, b]
    } else {
        [a, b, c]
    }
}

/// A corner as it can be looked up. Adding turns -0 into 0.
fn key(corner: DVec2) -> [u64; 2] {
    (corner + 0.0).to_array().map(f64::to_bits)
}
