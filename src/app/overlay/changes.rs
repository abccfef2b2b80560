//! Which parts of the interface changed from one picture to the next: its shapes are compared before they are cut into
//! triangles, so that only what changed costs anything.
//!
//! Both lists are in painter's order. Shapes that stand in both, in the same order, are matched; every pixel outside
//! the others' bounds then gets the same shapes in the same order as before, so it keeps its colour.

use std::sync::Arc;

use egui::epaint::{ClippedShape, Shape};
use egui::{Pos2, Rect, TextureId, Vec2};

use super::CanvasRect;

/// How far two lists may be apart where one of them has shapes that the other does not have.
const WINDOW: usize = 16;
/// Farther than this from its bounds nothing of a shape is painted, in points: edges are softened over a pixel, and
/// positions are rounded to whole pixels.
const REACH: f32 = 2.0;
/// Most parts that are told apart.
const MAX_PARTS: usize = 24;

/// The bounds, in points, of all shapes that stand in one list only, or use a texture that changed.
pub(super) fn changed_bounds(old: &[ClippedShape], new: &[ClippedShape], textures: &[TextureId]) -> Vec<Rect> {
    let mut bounds = Vec::new();
    let mut add = |shapes: &[ClippedShape]| bounds.extend(shapes.iter().map(reach).filter(Rect::is_positive));
    let (mut i, mut j) = (0, 0);
    while i < old.len() || j < new.len() {
        let next = next_match(&old[i..], &new[j..]);
        // Far apart: give up one of each and look again.
        let (skip_old, skip_new) = next.unwrap_or(((old.len() - i).min(1), (new.len() - j).min(1)));
        add(&old[i..i + skip_old]);
        add(&new[j..j + skip_new]);
        (i, j) = (i + skip_old, j + skip_new);
        if next.is_some() {
            if uses(&new[j].shape, textures) {
                add(&new[j..=j]);
            }
            (i, j) = (i + 1, j + 1);
        }
    }
    bounds
}

/// How many shapes of both lists come before the next that stands in both, as few as possible; `None` if there is none
/// near.
fn next_match(old: &[ClippedShape], new: &[ClippedShape]) -> Option<(usize, usize)> {
    for distance in 0..WINDOW {
        for skip_old in 0..=distance.min(old.len()) {
            let skip_new = distance - skip_old;
            if let (Some(a), Some(b)) = (old.get(skip_old), new.get(skip_new))
                && is_same(a, b)
            {
                return Some((skip_old, skip_new));
            }
        }
    }
    None
}

/// Whether both paint the same pixels. Texts that egui laid out once share their memory.
fn is_same(a: &ClippedShape, b: &ClippedShape) -> bool {
    if a.clip_rect != b.clip_rect || a.transform_after_tessellation != b.transform_after_tessellation {
        return false;
    }
    match (&a.shape, &b.shape) {
        (Shape::Text(a), Shape::Text(b)) if Arc::ptr_eq(&a.galley, &b.galley) => {
            a.pos == b.pos
                && a.underline == b.underline
                && a.override_text_color == b.override_text_color
                && a.fallback_color == b.fallback_color
                && a.opacity_factor.to_bits() == b.opacity_factor.to_bits()
                && a.angle.to_bits() == b.angle.to_bits()
        }
        (a, b) => a == b,
    }
}

fn uses(shape: &Shape, textures: &[TextureId]) -> bool {
    match shape {
        Shape::Vec(shapes) => shapes.iter().any(|shape| uses(shape, textures)),
        shape => textures.contains(&shape.texture_id()),
    }
}

/// Where a shape can paint anything, in points.
pub(super) fn reach(shape: &ClippedShape) -> Rect {
    let bounds = bounds(&shape.shape);
    if bounds.any_nan() {
        return shape.clip_rect;
    }
    // What paints nothing has bounds that stay turned inside out.
    let bounds = shape.transform_after_tessellation * bounds.expand(REACH);
    shape.clip_rect.intersect(bounds)
}

/// Around all that a shape paints, but for what softens its edges.
fn bounds(shape: &Shape) -> Rect {
    match shape {
        // Lines below and through a text may reach beyond its letters.
        Shape::Text(text) if text.angle == 0.0 => {
            let rows = text.galley.rect.translate(text.pos.to_vec2());
            rows | shape.visual_bounding_rect()
        }
        Shape::Text(_) => Rect::EVERYTHING,
        // A frame and its shadow come together.
        Shape::Vec(shapes) => shapes.iter().map(bounds).fold(Rect::NOTHING, Rect::union),
        Shape::Path(path) if path.closed => {
            shape.visual_bounding_rect() | bounds_of_corners(&path.points, path.stroke.width)
        }
        other => other.visual_bounding_rect(),
    }
}

/// Around the corners of a closed path, which egui prolongs until the sides of its line meet: the sharper, the farther.
fn bounds_of_corners(points: &[Pos2], width: f32) -> Rect {
    let count = points.len();
    let corner = |i: usize| {
        let [before, at, after] = [i + count - 1, i, i + 1].map(|i| points[i % count]);
        // Half the sum of both sides' normals is as much shorter than one as the corner is farther away.
        let normal = ((at - before).normalized() + (after - at).normalized()) / 2.0;
        let half = (width / 2.0 + REACH) / normal.length();
        Rect::from_center_size(at, Vec2::splat(2.0 * half))
    };
    (0..count).map(corner).fold(Rect::NOTHING, Rect::union)
}

/// Joins parts that overlap or nearly do, until all are apart and few.
pub(super) fn joined(parts: impl IntoIterator<Item = CanvasRect>) -> Vec<CanvasRect> {
    let mut apart: Vec<CanvasRect> = Vec::new();
    for part in parts.into_iter().filter(|part| !part.is_empty()) {
        let mut part = part;
        // A part that grew may touch others that it did not touch before.
        while let Some(at) = apart.iter().position(|other| is_worth_joining(part, *other)) {
            part = part.join(apart.swap_remove(at));
        }
        apart.push(part);
    }
    if apart.len() > MAX_PARTS {
        let all = apart.into_iter().fold(CanvasRect::EMPTY, CanvasRect::join);
        return vec![all];
    }
    apart
}

/// Whether two parts share a pixel, or their common box holds little more than they do.
fn is_worth_joining(a: CanvasRect, b: CanvasRect) -> bool {
    let area = |rect: CanvasRect| {
        u64::from(rect.right.saturating_sub(rect.left)) * u64::from(rect.bottom.saturating_sub(rect.top))
    };
    !a.intersect(b).is_empty() || area(a.join(b)) <= (area(a) + area(b)) * 3 / 2
}

#[cfg(test)]
mod tests {
    use egui::{Color32, CornerRadius, pos2, vec2};

    use super::*;

    #[test]
    fn sharp_corners_reach_as_far_as_they_are_painted() {
        use egui::epaint::{TessellationOptions, Tessellator};
        for sharp in [0.01, 0.1, 0.5, 3.0] {
            let points = vec![pos2(0.0, 0.0), pos2(40.0, sharp), pos2(40.0, -sharp)];
            for width in [0.0, 1.0, 4.0] {
                let shape = Shape::closed_line(points.clone(), egui::Stroke::new(width, Color32::RED));
                let found = bounds(&shape).expand(REACH);
                let options = TessellationOptions::default();
                let mut painted = egui::Mesh::default();
                Tessellator::new(1.0, options, [1, 1], Vec::new()).tessellate_shape(shape, &mut painted);
                for vertex in &painted.vertices {
                    assert!(
                        found.any_nan() || found.contains(vertex.pos),
                        "{:?} of a corner {sharp} wide lies outside of {found:?}",
                        vertex.pos
                    );
                }
            }
        }
    }

    fn square(at: f32) -> ClippedShape {
        let rect = Rect::from_min_size(pos2(at, 0.0), vec2(4.0, 4.0));
        let shape = Shape::rect_filled(rect, CornerRadius::ZERO, Color32::RED);
        ClippedShape {
            clip_rect: Rect::EVERYTHING,
            shape,
            transform_after_tessellation: egui::emath::TSTransform::IDENTITY,
        }
    }

    /// The left edges of what changed.
    fn changed(old: &[f32], new: &[f32]) -> Vec<f32> {
        let list = |all: &[f32]| all.iter().map(|at| square(*at)).collect::<Vec<_>>();
        let mut edges: Vec<f32> = changed_bounds(&list(old), &list(new), &[])
            .iter()
            .map(|rect| rect.left() + REACH)
            .collect();
        edges.sort_by(f32::total_cmp);
        edges
    }

    #[test]
    fn changes_are_what_stands_in_one_list_only() {
        assert_eq!(changed(&[1.0, 2.0, 3.0], &[1.0, 2.0, 3.0]), [] as [f32; 0], "nothing");
        assert_eq!(
            changed(&[1.0, 2.0, 3.0], &[1.0, 9.0, 3.0]),
            [2.0, 9.0],
            "old and new place"
        );
        assert_eq!(changed(&[1.0, 3.0], &[1.0, 2.0, 3.0]), [2.0], "inserted");
        assert_eq!(changed(&[1.0, 2.0, 3.0], &[3.0]), [1.0, 2.0], "removed");
        assert_eq!(changed(&[], &[4.0]), [4.0], "all new");
        let far = |from: u8| (from..from + 100).map(f32::from).collect::<Vec<_>>();
        assert_eq!(changed(&far(0), &far(100)).len(), 200, "nothing in common");
        assert_eq!(changed(&far(0), &[]).len(), 100, "all gone");
        let inserted = [&[255.0], &far(0)[..50], &far(120)[..40], &far(50)[..50]].concat();
        let seen = changed(&far(0), &inserted);
        let missing = [&[255.0], &far(120)[..40]].concat();
        assert!(missing.iter().all(|at| seen.contains(at)), "far apart: {seen:?}");
        assert_eq!(changed(&[1.0, 2.0], &[2.0, 1.0]).len(), 2, "another order is a change");
    }

    #[test]
    fn shapes_together_reach_as_far_as_each() {
        let [near, far] = [1.0, 50.0].map(|at| square(at).shape);
        let inner = Shape::Vec(vec![Shape::Noop, far]);
        let together = ClippedShape {
            shape: Shape::Vec(vec![near, inner]),
            ..square(0.0)
        };
        let around = Rect::from_min_max(pos2(1.0, 0.0), pos2(54.0, 4.0)).expand(REACH);
        assert_eq!(reach(&together), around, "around both");
        let nothing = ClippedShape {
            shape: Shape::Vec(vec![Shape::Noop]),
            ..square(0.0)
        };
        assert!(!reach(&nothing).is_positive(), "nothing is painted nowhere");
    }

    #[test]
    fn changes_of_texture_count() {
        let list = [square(1.0)];
        assert_eq!(
            changed_bounds(&list, &list, &[TextureId::default()]).len(),
            1,
            "its texture"
        );
        assert!(
            changed_bounds(&list, &list, &[TextureId::User(3)]).is_empty(),
            "another's"
        );
    }

    #[test]
    fn parts_are_apart() {
        arbtest::arbtest(|u| {
            let mut parts = Vec::new();
            for _ in 0..u.int_in_range(0..=40)? {
                let (left, top) = (u.int_in_range(0..=200)?, u.int_in_range(0..=200)?);
                let (width, height): (u32, u32) = (u.int_in_range(0..=20)?, u.int_in_range(0..=20)?);
                parts.push(CanvasRect {
                    left,
                    top,
                    right: left + width,
                    bottom: top + height,
                });
            }
            let result = joined(parts.clone());
            assert!(result.len() <= MAX_PARTS, "{}", result.len());
            for (i, part) in result.iter().enumerate() {
                let others = &result[i + 1..];
                assert!(
                    others.iter().all(|other| part.intersect(*other).is_empty()),
                    "{result:?}"
                );
            }
            for part in parts.into_iter().filter(|part| !part.is_empty()) {
                assert!(
                    result.iter().any(|all| all.intersect(part) == part),
                    "{part:?} in {result:?}"
                );
            }
            Ok(())
        })
        .budget_ms(300);
    }
}
