//! Clip paths that take nothing away: rectangles around all that they clip.
//!
//! Programs clip without need: plots to their axes, drawings to their page, symbols to their view box. A layer for each would
//! cost more than what is in it.

use usvg::tiny_skia_path::{PathSegment, Point, Rect, Transform};
use usvg::{ClipPath, Group, LineCap, LineJoin, Node, Path};

/// Most nodes that are looked at for one clip path; what holds more is clipped.
const MAX_NODES: usize = 1000;

/// Whether a clip path cuts off nothing of a group, which blends with nothing around it. Lines that do not scale must be
/// ruled out before.
pub(super) fn is_idle(clip: &ClipPath, group: &Group) -> bool {
    let Some(window) = window(clip) else {
        return false;
    };
    let mut left = MAX_NODES;
    reaches_no_further(group, Transform::identity(), window, &mut left)
}

/// The rectangle that a clip path is, in the coordinates of what it clips.
fn window(clip: &ClipPath) -> Option<Rect> {
    let [Node::Path(path)] = clip.root().children() else {
        return None;
    };
    let to_group = clip.transform();
    let is_upright = to_group.kx == 0.0 && to_group.ky == 0.0;
    let is_whole = clip.clip_path().is_none() && clip.root().transform().is_identity();
    let is_painted = path.is_visible() && path.fill().is_some() && path.rendering_mode().use_shape_antialiasing();
    if !is_upright || !is_whole || !is_painted || !is_rectangle(path) {
        return None;
    }
    path.data().bounds().transform(to_group)
}

/// Whether a path goes once around its bounds.
fn is_rectangle(path: &Path) -> bool {
    let bounds = path.data().bounds();
    let corners = [
        (bounds.left(), bounds.top()),
        (bounds.right(), bounds.top()),
        (bounds.right(), bounds.bottom()),
        (bounds.left(), bounds.bottom()),
    ];
    let mut visited = Vec::new();
    for segment in path.data().segments() {
        match segment {
            PathSegment::MoveTo(to) if visited.is_empty() => visited.push((to.x, to.y)),
            PathSegment::LineTo(to) => visited.push((to.x, to.y)),
            PathSegment::Close => {}
            _ => return false,
        }
    }
    if visited.len() == 5 && visited.first() == visited.last() {
        visited.pop();
    }
    let begins_at = |start: usize| {
        visited
            .iter()
            .zip(corners.iter().cycle().skip(start))
            .all(|(a, b)| a == b)
    };
    let turned = |start: usize| {
        let backwards = corners.iter().rev().cycle().skip(start);
        visited.iter().zip(backwards).all(|(a, b)| a == b)
    };
    visited.len() == 4 && (0..4).any(|start| begins_at(start) || turned(start))
}

/// Whether all that a group paints lies inside a rectangle, and is painted over what is there without blending.
fn reaches_no_further(group: &Group, to_window: Transform, window: Rect, left: &mut usize) -> bool {
    group.children().iter().all(|node| {
        *left = left.saturating_sub(1);
        if *left == 0 {
            return false;
        }
        match node {
            Node::Group(group) => {
                group.blend_mode() == usvg::BlendMode::Normal
                    && reaches_no_further(group, to_window.pre_concat(group.transform()), window, left)
            }
            Node::Path(path) => {
                path.rendering_mode().use_shape_antialiasing()
                    && reach(path)
                        .and_then(|reach| reach.transform(to_window))
                        .is_some_and(|reach| holds(window, reach))
            }
            Node::Text(text) => reaches_no_further(text.flattened(), to_window, window, left),
            Node::Image(_) => false,
        }
    })
}

/// A rectangle around all that a path paints.
fn reach(path: &Path) -> Option<Rect> {
    let bounds = path.data().bounds();
    let Some(stroke) = path.stroke() else {
        return Some(bounds);
    };
    let miter = match stroke.linejoin() {
        LineJoin::Miter | LineJoin::MiterClip => longest_miter(path).min(stroke.miterlimit().get()),
        LineJoin::Round | LineJoin::Bevel => 1.0,
    };
    let cap = if stroke.linecap() == LineCap::Square {
        std::f32::consts::SQRT_2
    } else {
        1.0
    };
    // A little more than half a width, for what single floats cannot tell.
    let margin = stroke.width().get() * 0.5001 * miter.max(cap);
    bounds.outset(margin, margin)
}

/// How many widths long the miter at the sharpest corner of a path would be.
fn longest_miter(path: &Path) -> f32 {
    let mut longest = 1.0_f32;
    let (mut start, mut at) = (Point::zero(), Point::zero());
    // Directions: that of the subpath's first segment, and that in which the last one arrived.
    let (mut first, mut last) = (None, None);
    for segment in path.data().segments() {
        let stops = match segment {
            PathSegment::MoveTo(to) => {
                (start, at, first, last) = (to, to, None, None);
                continue;
            }
            PathSegment::LineTo(to) => vec![to],
            PathSegment::QuadTo(control, to) => vec![control, to],
            PathSegment::CubicTo(a, b, to) => vec![a, b, to],
            PathSegment::Close => vec![start],
        };
        let mut directions = stops.iter().scan(at, |from, to| {
            let mut direction = *to - *from;
            *from = *to;
            Some(direction.normalize().then_some(direction))
        });
        let leaves = directions.find_map(|direction| direction);
        let arrives = directions.flatten().last().or(leaves);
        if let (Some(last), Some(leaves)) = (last, leaves) {
            longest = longest.max(miter(last, leaves));
        }
        first = first.or(leaves);
        last = arrives.or(last);
        if let (PathSegment::Close, Some(last), Some(first)) = (segment, last, first) {
            longest = longest.max(miter(last, first));
        }
        at = stops.last().copied().unwrap_or(at);
    }
    longest
}

/// How many widths long a miter is, between unit directions (SVG 2, section 13.5.5).
fn miter(from: Point, to: Point) -> f32 {
    let cosine = from.x * to.x + from.y * to.y;
    (2.0 / (1.0 + cosine).max(f32::MIN_POSITIVE)).sqrt()
}

/// Whether nothing to be seen of a rectangle lies outside of the window.
fn holds(window: Rect, inner: Rect) -> bool {
    // What single floats make of a corner that lies on the window's.
    let slack = 1e-5 * window.width().max(window.height());
    window.left() - slack <= inner.left()
        && window.top() - slack <= inner.top()
        && window.right() + slack >= inner.right()
        && window.bottom() + slack >= inner.bottom()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether the clip path of the first group that has one is idle.
    fn idle(clip: &str, content: &str) -> bool {
        let document = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='100' height='100'>
             <clipPath id='c'>{clip}</clipPath><g clip-path='url(#c)'>{content}</g></svg>"
        );
        let tree = usvg::Tree::from_str(&document, &usvg::Options::default()).expect("a good document");
        let [Node::Group(group)] = tree.root().children() else {
            panic!("no group in {document}");
        };
        is_idle(group.clip_path().expect("a clip path"), group)
    }

    #[test]
    fn rectangles_around_all_that_they_clip_are_idle() {
        let page = "<rect width='100' height='100'/>";
        for (clip, content, expected) in [
            (page, "<rect x='10' y='10' width='90' height='90'/>", true),
            (page, "<rect x='10' y='10' width='91' height='90'/>", false),
            ("<path d='M0,0V100H100V0Z'/>", "<circle cx='50' cy='50' r='50'/>", true),
            (
                "<path d='M0,0V100H100V0L50,50Z'/>",
                "<circle cx='50' cy='50' r='9'/>",
                false,
            ),
            (
                "<path d='M0,0L100,100H0V100Z'/>",
                "<rect x='40' y='10' width='9' height='9'/>",
                false,
            ),
            (
                "<circle cx='50' cy='50' r='50'/>",
                "<circle cx='50' cy='50' r='9'/>",
                false,
            ),
            (
                page,
                "<circle cx='50' cy='50' r='49' stroke='red' stroke-width='2'/>",
                true,
            ),
            (
                page,
                "<circle cx='50' cy='50' r='49' stroke='red' stroke-width='2.1'/>",
                false,
            ),
            // A miter may be four widths long.
            (
                page,
                "<path d='M10,5L90,5L10,6' fill='none' stroke='red' stroke-width='4'/>",
                false,
            ),
            (
                page,
                "<path d='M10,9L90,9L10,10' fill='none' stroke='red' stroke-width='4'/>",
                true,
            ),
            (
                page,
                "<g transform='translate(50)'><rect width='50' height='50'/></g>",
                true,
            ),
            (
                page,
                "<g transform='translate(51)'><rect width='50' height='50'/></g>",
                false,
            ),
            (
                page,
                "<g transform='rotate(45)'><rect width='50' height='50'/></g>",
                false,
            ),
            (
                page,
                "<g style='mix-blend-mode:multiply'><rect width='9' height='9'/></g>",
                false,
            ),
            (page, "<rect width='9' height='9' shape-rendering='crispEdges'/>", false),
            (
                "<rect width='50' height='50' transform='scale(2)'/>",
                "<rect width='9' height='9'/>",
                false,
            ),
        ] {
            assert_eq!(idle(clip, content), expected, "{clip} {content}");
        }
    }

    #[test]
    fn a_group_of_too_many_is_clipped() {
        let dots = "<rect width='1' height='1'/>".repeat(MAX_NODES);
        assert!(!idle("<rect width='100' height='100'/>", &dots));
    }
}
