//! How wide and how long a primitive is near a pixel, together with the triangles that continue it: what has one edge and one paint
//! with its neighbour has no border there.

use std::collections::{HashMap, HashSet};

use glam::DVec2;
use rayon::prelude::*;

use super::number;
use super::replay::{Explainer, bounds, placed, touch};
use super::triangle_edges::Ends;
use crate::geometry::{BEYOND, FillRule, cut_to_window, width_in_window, width_of_part};
use crate::scene::{Paint, PrimitiveKind};

/// Triangles that continue one at most, and triangles near a pixel beyond which none is looked for: it would take as long as drawing.
const MOST_CONTINUED: usize = 200;
const MOST_NEAR: usize = 50_000;

impl Explainer<'_> {
    /// How wide a primitive is in the thinnest direction, in pixels, with the triangles that continue it, as far as they lie in the
    /// pixel or at most `around` pixels beside it, or the widest of their parts there that touch the pixel; `None` where
    /// [`Explainer::area`] is.
    pub fn width(&self, source: u32, around: f64) -> Option<f64> {
        let screen = self.screen();
        let corner = DVec2::from(self.pixel.map(f64::from));
        let window = [corner - around, corner + 1.0 + around];
        let around_it = [window[0] - BEYOND, window[1] + BEYOND];
        match self.kind(source)? {
            PrimitiveKind::Triangle { points, .. } => {
                let place = |points: [DVec2; 3]| points.map(|point| screen.place(point));
                let triangles = self.continued(source, around_it);
                if triangles.len() < 2 {
                    return width_in_window(std::iter::once(place(*points)), window);
                }
                let contours = triangles.into_iter().filter_map(|source| match self.kind(source)? {
                    PrimitiveKind::Triangle { points, .. } => Some(turned_one_way(place(*points)).into_iter()),
                    _ => None,
                });
                let inside = cut_to_window(contours, FillRule::NonZero, around_it);
                width_of_part(inside.triangles()?, window, around)
            }
            PrimitiveKind::Polygon { polygon, .. } => screen.with_edges(polygon, |polygon| {
                let inside = cut_to_window(placed(polygon, &screen), polygon.rule(), around_it);
                width_of_part(inside.triangles()?, window, around)
            }),
            _ => None,
        }
    }

    /// The longer side of the box around a primitive and the triangles that continue it near the pixel, in pixels; `None` where
    /// [`Explainer::area`] is.
    pub fn length(&self, source: u32) -> Option<f64> {
        let corner = DVec2::from(self.pixel.map(f64::from));
        let near = [corner - BEYOND, corner + 1.0 + BEYOND];
        let screen = self.screen();
        let boxes = self.continued(source, near).into_iter();
        let boxes = boxes.filter_map(|source| bounds(&screen, self.kind(source)?));
        let [low, high] = boxes.reduce(|one, other| [one[0].min(other[0]), one[1].max(other[1])])?;
        Some((high - low).max_element())
    }

    fn kind(&self, source: u32) -> Option<&PrimitiveKind> {
        Some(&self.subject.scene.primitives.get(source as usize)?.kind)
    }

    /// A primitive and the triangles that continue it, one after the other, as far as they touch a window.
    fn continued(&self, source: u32, window: [DVec2; 2]) -> Vec<u32> {
        let mut found = vec![source];
        if !matches!(self.kind(source), Some(PrimitiveKind::Triangle { .. })) {
            return found;
        }
        let edges = self.edges.with.get_or_init(|| self.edges_near());
        let mut known = HashSet::from([source]);
        let mut at = 0;
        while let Some(one) = found.get(at).copied().filter(|_| found.len() < MOST_CONTINUED) {
            at += 1;
            for edge in 0..3 {
                let beside = self.ends(one, edge).and_then(|ends| edges.get(&ends));
                for other in beside.into_iter().flatten().copied() {
                    let touches =
                        |kind: &PrimitiveKind| bounds(&self.screen(), kind).is_some_and(|bounds| touch(bounds, window));
                    if self.continues(one, edge, other) && self.kind(other).is_some_and(touches) && known.insert(other)
                    {
                        found.push(other);
                    }
                }
            }
        }
        found
    }

    /// The triangles as near to the pixel as any width is measured, by their edges.
    fn edges_near(&self) -> HashMap<Ends, Vec<u32>> {
        /// Beside the pixel, in pixels.
        const FAR: f64 = 4.0;
        let corner = DVec2::from(self.pixel.map(f64::from));
        let window = [corner - FAR, corner + 1.0 + FAR];
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
