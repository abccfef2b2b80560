//! Which paints of two explanations are one part of a scene: an element may be painted as a polygon by the rules of A and as
//! triangles by those of B, and its triangles tell apart by their corners alone.

use std::collections::BTreeSet;

use super::model::{Explanation, Paint, Shape, Texture};

/// How far the corners of a triangle may lie apart where the grids of two pictures differ, in pixels.
const NEAR: f64 = 0.25;

/// One part of a scene in two explanations.
#[derive(Debug)]
pub(super) struct Part<'a> {
    /// What it is called, with its number among its like.
    pub(super) name: String,
    /// What paints it in A and in B; several where the other paints them as one.
    pub(super) sides: [Vec<&'a Paint>; 2],
}

impl Part<'_> {
    /// The part of a pixel that a side covers, as its picture counts it: its area, or the part of the samples. `None` where nothing
    /// of it is painted.
    pub(super) fn covered(&self, side: usize, of: &Explanation) -> Option<f64> {
        let paints = &self.sides[side];
        if paints.is_empty() {
            return None;
        }
        if paints.iter().all(|paint| paint.covered.is_some()) {
            let areas = paints.iter().filter_map(|paint| paint.covered);
            return Some(areas.sum::<f64>().min(1.0));
        }
        let fragments = paints.iter().flat_map(|paint| &paint.fragments);
        let samples: BTreeSet<usize> = fragments.map(|fragment| fragment.sample).collect();
        Some(samples.len() as f64 / of.samples.len().max(1) as f64)
    }

    /// How a side reads its texture.
    pub(super) fn texture(&self, side: usize) -> Option<&Texture> {
        self.sides[side].iter().find_map(|paint| paint.texture.as_ref())
    }
}

/// All parts of both, those of `a` first.
pub(super) fn parts<'a>(a: &'a Explanation, b: &'a Explanation) -> Vec<Part<'a>> {
    let mut groups: Vec<[Vec<&Paint>; 2]> = Vec::new();
    for (side, of) in [a, b].into_iter().enumerate() {
        for paint in &of.paints {
            let is_like = |group: &[Vec<&Paint>; 2]| group.iter().flatten().any(|other| is_sibling(paint, other));
            let at = groups.iter().position(is_like).unwrap_or_else(|| {
                groups.push([Vec::new(), Vec::new()]);
                groups.len() - 1
            });
            groups[at][side].push(paint);
        }
    }
    groups.into_iter().flat_map(parts_of).collect()
}

/// Whether both are painted of one primitive, and are of one kind: triangles are of the polygon that they were cut from.
fn is_sibling(one: &Paint, other: &Paint) -> bool {
    let is_area = |paint: &Paint| matches!(paint.shape, Shape::Triangle { .. } | Shape::Polygon { .. });
    let is_one_kind = std::mem::discriminant(&one.shape) == std::mem::discriminant(&other.shape);
    let is_one_thing = one.primitive == other.primitive && one.in_mask == other.in_mask;
    is_one_thing && (is_one_kind || (is_area(one) && is_area(other)))
}

/// The parts that siblings are: all of them are one where a side has them whole and the other in pieces.
fn parts_of([a, b]: [Vec<&Paint>; 2]) -> Vec<Part<'_>> {
    let is_whole = |paints: &[&Paint]| paints.iter().any(|paint| corners(paint).is_none());
    let one_way = a.is_empty() || b.is_empty() || is_whole(&a) == is_whole(&b);
    let sides = if one_way { pairs(&a, b) } else { vec![[a, b]] };
    let names: Vec<String> = sides.iter().map(name).collect();
    let mut parts = Vec::new();
    for (at, (sides, name)) in sides.into_iter().zip(&names).enumerate() {
        let of = names.iter().filter(|other| *other == name).count();
        let number = names[..=at].iter().filter(|other| *other == name).count();
        let name = if of > 1 {
            format!("{name} ({number} of {of})")
        } else {
            name.clone()
        };
        parts.push(Part { name, sides });
    }
    parts
}

/// What both sides are called: a polygon, where one is one.
fn name(sides: &[Vec<&Paint>; 2]) -> String {
    let mut paints = sides.iter().flatten();
    let whole = paints.clone().find(|paint| corners(paint).is_none());
    whole
        .or_else(|| paints.next())
        .map_or(String::new(), |paint| paint.name())
}

/// Each of `a` with its like of `b`, then what `b` has besides: triangles by their corners, all else in its order.
fn pairs<'a>(a: &[&'a Paint], mut b: Vec<&'a Paint>) -> Vec<[Vec<&'a Paint>; 2]> {
    let mut pairs = Vec::new();
    for paint in a {
        let like = match corners(paint) {
            None => (!b.is_empty()).then_some(0),
            Some(corners) => nearest(corners, &b),
        };
        let like = like.map(|at| b.remove(at));
        pairs.push([vec![*paint], like.into_iter().collect()]);
    }
    pairs.extend(b.into_iter().map(|paint| [Vec::new(), vec![paint]]));
    pairs
}

/// Which of these has its corners at the same places.
fn nearest(places: [[f64; 2]; 3], among: &[&Paint]) -> Option<usize> {
    let apart = |paint: &Paint| {
        let pairs = places.iter().flatten().zip(corners(paint)?.into_iter().flatten());
        Some(pairs.map(|(one, other)| (one - other).abs()).fold(0.0, f64::max))
    };
    let apart = among
        .iter()
        .enumerate()
        .filter_map(|(at, paint)| Some((at, apart(paint)?)));
    let nearest = apart.min_by(|(_, one), (_, other)| one.total_cmp(other));
    nearest.filter(|(_, apart)| *apart <= NEAR).map(|(at, _)| at)
}

fn corners(paint: &Paint) -> Option<[[f64; 2]; 3]> {
    match paint.shape {
        Shape::Triangle { corners } => Some(corners),
        _ => None,
    }
}
