//! Whose a node of usvg's is, and its outline as ours.

use std::collections::HashSet;
use std::f64::consts::FRAC_PI_2;

use glam::DVec2;
use roxmltree::Node;
use usvg::Group;
use usvg::tiny_skia_path::{Path as TheirPath, PathSegment, Point};

use super::painter::{Painter, Used};
use super::references;
use crate::geometry::{LineCap, LineJoin, Path, Stroke, StrokeStyle};
use crate::scene::{ShapeId, attributes};

/// Most elements that a `use` shows and that are told apart.
const MAX_USED: usize = 10_000;

impl<'doc> Painter<'_, 'doc> {
    /// The shape of an element, the same for all that is painted for it.
    pub(super) fn shape(&mut self, node: Node<'doc, 'doc>) -> ShapeId {
        if let Some(inside) = self.inside {
            return inside.image;
        }
        let builder = &mut *self.builder;
        *self.known.entry(node.id()).or_insert_with(|| builder.shape(node))
    }

    /// Whose a group is; `around` where it does not say.
    pub(super) fn owner(&mut self, group: &Group, around: ShapeId) -> ShapeId {
        let id = first_id(group, 0);
        match self.elements.find(id).filter(|_| self.inside.is_none()) {
            Some(node) => self.shape(node),
            None => around,
        }
    }

    /// Whose a path or text is.
    pub(super) fn leaf(&mut self, id: &str, around: ShapeId) -> ShapeId {
        if self.inside.is_some() {
            return around;
        }
        if let Some(node) = self.elements.find(id) {
            return self.shape(node);
        }
        let Some(used) = self.used.last_mut() else {
            return around;
        };
        let location = used.location;
        match used.left.pop() {
            Some(node) => self.builder.shape_used(node, Some(location)),
            None => around,
        }
    }

    /// Whose the marks on an element's line are, which usvg tells nothing of: its marker, if it has but one.
    pub(super) fn shape_of_marks(&mut self, node: Node<'doc, 'doc>) -> Option<ShapeId> {
        const NAMES: [&str; 4] = ["marker", "marker-start", "marker-mid", "marker-end"];
        let mut found = None;
        for name in NAMES {
            let Some(marker) = references::inherited(node, name).and_then(|id| self.elements.own(id)) else {
                continue;
            };
            if found.is_some_and(|found| found != marker) {
                return None;
            }
            found = Some(marker);
        }
        let marker = found.filter(|marker| self.inside.is_none() && marker.tag_name().name() == "marker")?;
        let location = self.builder.locate(node);
        Some(self.builder.shape_used(marker, Some(location)))
    }

    /// Whose a definition is, by its id, or by what is inside.
    pub(super) fn definition(&mut self, id: &str, inside: &Group, element: &str, around: ShapeId) -> ShapeId {
        if self.inside.is_some() {
            return around;
        }
        let found = self.elements.find(id).or_else(|| {
            let node = self.elements.find(first_id(inside, 0))?;
            node.ancestors().find(|node| node.tag_name().name() == element)
        });
        found.map_or(around, |node| self.shape(node))
    }

    /// Whether the group stands for a `use`; then the shapes inside belong to what it shows.
    pub(super) fn begin_use(&mut self, group: &Group) -> bool {
        if self.inside.is_some() {
            return false;
        }
        let found = self
            .elements
            .find(group.id())
            .filter(|node| node.tag_name().name() == "use");
        let Some(node) = found else {
            return false;
        };
        let mut left = self.shown_by(node);
        if left.len() != leaves(group) {
            left.clear();
        }
        left.reverse();
        let location = self.builder.locate(node);
        self.used.push(Used { location, left });
        true
    }

    /// The elements with something to paint that a `use` shows, in their order.
    fn shown_by(&self, node: Node<'doc, 'doc>) -> Vec<Node<'doc, 'doc>> {
        let mut shown = Vec::new();
        let mut entered = HashSet::new();
        let mut open: Vec<Node<'doc, 'doc>> = self.elements.target(node).into_iter().collect();
        while let Some(node) = open.pop() {
            let hidden = node.attribute("display") == Some("none");
            match node.tag_name().name() {
                _ if hidden || attributes::is_silent(node) || shown.len() > MAX_USED => {}
                "rect" | "circle" | "ellipse" | "line" | "polyline" | "polygon" | "path" | "image" | "text"
                | "colortri" | "textri" => shown.push(node),
                "use" if entered.insert(node.id()) => open.extend(self.elements.target(node)),
                "g" | "a" | "svg" | "symbol" | "switch" => {
                    open.extend(node.children().filter(Node::is_element).rev());
                }
                _ => {}
            }
        }
        shown
    }
}

/// The id of a group, or of the first thing inside that has one.
fn first_id(group: &Group, depth: usize) -> &str {
    const DEEP: usize = 4;
    if !group.id().is_empty() || depth > DEEP {
        return group.id();
    }
    match group.children().first() {
        Some(usvg::Node::Group(inner)) => first_id(inner, depth + 1),
        Some(node) => node.id(),
        None => "",
    }
}

/// How many paths, texts and images a group holds.
fn leaves(group: &Group) -> usize {
    let of_node = |node: &usvg::Node| match node {
        usvg::Node::Group(group) => leaves(group),
        _ => 1,
    };
    group.children().iter().map(of_node).sum()
}

fn point(at: Point) -> DVec2 {
    DVec2::new(at.x.into(), at.y.into())
}

/// usvg's path as ours. The curves of round elements, which usvg has as cubics for the size of the document, become round
/// enough for any view.
pub(super) fn path(theirs: &TheirPath, element: &str) -> Path {
    let is_round = matches!(element, "circle" | "ellipse" | "rect");
    let mut path = Path::default();
    let mut from = DVec2::ZERO;
    for segment in theirs.segments() {
        match segment {
            PathSegment::MoveTo(to) => path.move_to(point(to)),
            PathSegment::LineTo(to) => path.line_to(point(to)),
            PathSegment::QuadTo(control, to) => path.quad_to(point(control), point(to)),
            PathSegment::CubicTo(first, second, to) => {
                let (controls, to) = ([first, second].map(point), point(to));
                match Arc::of(from, controls, to).filter(|_| is_round) {
                    Some(arc) => arc.append(&mut path, to),
                    None => path.cubic_to(controls, to),
                }
            }
            PathSegment::Close => path.close(),
        }
        if let PathSegment::MoveTo(to)
        | PathSegment::LineTo(to)
        | PathSegment::QuadTo(_, to)
        | PathSegment::CubicTo(_, _, to) = segment
        {
            from = point(to);
        }
    }
    path
}

/// A part of an ellipse: `center + a cos(angle) + b sin(angle)`, the angle from 0 to `sweep`.
#[derive(Clone, Copy, Debug)]
struct Arc {
    center: DVec2,
    a: DVec2,
    b: DVec2,
    /// In radians.
    sweep: f64,
}

impl Arc {
    /// How far the control points of the usual cubic lie from the ends of an arc, in radii along the tangents; the cubic's
    /// error is 2.7e-4 of the radius for a quarter, and falls with the sixth power of the angle.
    fn reach(sweep: f64) -> f64 {
        4.0 / 3.0 * (sweep / 4.0).tan()
    }

    /// The arc that a cubic stands for: a quarter of an ellipse, or a whole part of one.
    fn of(from: DVec2, [first, second]: [DVec2; 2], to: DVec2) -> Option<Self> {
        /// Into how many parts usvg divides the quarters of large ellipses.
        const MOST_PARTS: u32 = 8;
        /// How well 32-bit floats hold a place.
        const PRECISION: f64 = 1e-6;
        (1..=MOST_PARTS).find_map(|parts| {
            let sweep = FRAC_PI_2 / f64::from(parts);
            let (sin, cos) = sweep.sin_cos();
            let reach = Self::reach(sweep);
            let b = (first - from) / reach;
            let a = (b * cos - (to - second) / reach) / sin;
            let center = from - a;
            let off = center + a * cos + b * sin - to;
            let slack =
                PRECISION * (from.abs().max(to.abs()) + a.abs() + b.abs()).max_element() * f64::from(parts * parts);
            (off.length() <= slack).then_some(Self { center, a, b, sweep })
        })
    }

    /// Adds it to a path that has come to its begin, ending at `to`.
    fn append(self, path: &mut Path, to: DVec2) {
        /// Each is a cubic whose error is 7e-8 of the radius: a hundredth of a pixel for a radius of 150 000.
        const PARTS: u32 = 4;
        let Self { center, a, b, sweep } = self;
        let step = sweep / f64::from(PARTS);
        let reach = Self::reach(step);
        let at = |part: u32| {
            let (sin, cos) = (step * f64::from(part)).sin_cos();
            (center + a * cos + b * sin, b * cos - a * sin)
        };
        for part in 0..PARTS {
            let ((from, leaving), (end, arriving)) = (at(part), at(part + 1));
            let end = if part + 1 == PARTS { to } else { end };
            path.cubic_to([from + leaving * reach, end - arriving * reach], end);
        }
    }
}

/// The corners of a path that is nothing but a triangle.
pub(super) fn triangle(theirs: &TheirPath) -> Option<[DVec2; 3]> {
    use PathSegment::{Close, LineTo, MoveTo};
    if theirs.len() > 5 {
        return None;
    }
    let segments: Vec<PathSegment> = theirs.segments().collect();
    let [MoveTo(a), LineTo(b), LineTo(c), end @ ..] = segments.as_slice() else {
        return None;
    };
    let is_closed = match end {
        [] | [Close] => true,
        [LineTo(last)] | [LineTo(last), Close] => last == a,
        _ => false,
    };
    is_closed.then(|| [*a, *b, *c].map(point))
}

/// usvg's stroke as ours.
pub(super) fn stroke(theirs: &usvg::Stroke) -> Stroke {
    Stroke {
        style: StrokeStyle {
            width: theirs.width().get().into(),
            cap: match theirs.linecap() {
                usvg::LineCap::Butt => LineCap::Butt,
                usvg::LineCap::Round => LineCap::Round,
                usvg::LineCap::Square => LineCap::Square,
            },
            join: match theirs.linejoin() {
                usvg::LineJoin::Miter | usvg::LineJoin::MiterClip => LineJoin::Miter,
                usvg::LineJoin::Round => LineJoin::Round,
                usvg::LineJoin::Bevel => LineJoin::Bevel,
            },
            miter_limit: theirs.miterlimit().get().into(),
        },
        dashes: theirs
            .dasharray()
            .unwrap_or_default()
            .iter()
            .copied()
            .map(f64::from)
            .collect(),
        dash_offset: theirs.dashoffset().into(),
    }
}
