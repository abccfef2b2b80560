//! Markers where usvg's own are wrong: turned as SVG has it where points of an outline coincide and where subpaths are closed, and
//! none where parts of an arc meet, which are no vertices.
//!
//! usvg draws them in a group behind the outline, one for each of its vertices in their order. Where as many are there as the document
//! asks for, each is turned about its vertex by what it lacks; most lack nothing. What a `use` shows, and documents in images, usvg tells
//! nothing of: there they stay.

use std::cell::Cell;
use std::collections::HashMap;
use std::f32::consts::{FRAC_PI_2, PI};

use glam::{DAffine2, DVec2, Vec2};
use roxmltree::{Node, NodeId};
use simplecss::DeclarationTokenizer;
use svgtypes::{SimplePathSegment as Simple, SimplifyingPathParser};
use usvg::Group;
use usvg::tiny_skia_path::{Path as TheirPath, PathSegment, Point};

use super::affine::affine;
use super::elements::Elements;
use super::rules::Rules;
use super::values;
use crate::scene::edits::Edits;

/// Where markers stand: at the first vertex, at those between, and at the last.
const PROPERTIES: [&str; 3] = ["marker-start", "marker-mid", "marker-end"];

/// The markers of an element, one for each of [`PROPERTIES`].
type Own<'doc> = [Option<Node<'doc, 'doc>>; 3];

/// The markers of all elements of a document that have any, their own or those of what is around them.
#[derive(Debug, Default)]
pub(super) struct Markers<'doc>(HashMap<NodeId, Own<'doc>>);

impl<'doc> Markers<'doc> {
    /// Those below `root`.
    pub(super) fn below(root: Node<'doc, 'doc>, elements: &Elements<'doc>) -> Self {
        let mut found: HashMap<NodeId, Own<'doc>> = HashMap::new();
        if !root.descendants().any(is_marker) {
            return Self(found);
        }
        let rules = Rules::below(root).filter_map(|mut declarations| {
            declarations.retain(|declaration| declaration.name.starts_with("marker"));
            (!declarations.is_empty()).then_some(declarations)
        });
        let steps = Cell::new(0);
        for node in root.descendants().filter(Node::is_element) {
            let around = node.parent().and_then(|around| found.get(&around.id()));
            let mut own = around.copied().unwrap_or_default();
            let attributes = PROPERTIES
                .into_iter()
                .filter_map(|name| Some((name, node.attribute(name)?)));
            let mut declared: Vec<_> = rules.matching(node, &steps).flatten().copied().collect();
            declared.extend(DeclarationTokenizer::from(node.attribute("style").unwrap_or("")));
            declared.sort_by_key(|declaration| declaration.important);
            let declared = declared.iter().map(|declaration| (declaration.name, declaration.value));
            for (name, value) in attributes.chain(declared).filter(|(_, value)| *value != "inherit") {
                let marker = values::reference(value).and_then(|id| elements.own(id));
                for (property, own) in PROPERTIES.into_iter().zip(&mut own) {
                    if name == property || name == "marker" {
                        *own = marker.filter(|marker| is_marker(*marker));
                    }
                }
            }
            if own.iter().any(Option::is_some) {
                found.insert(node.id(), own);
            }
        }
        Self(found)
    }

    /// Has a path end in `text` where it is drawn: at the end of one whose last segment only moves usvg draws no marker.
    pub(super) fn end_drawn(&self, text: &str, path: Node<'doc, 'doc>, edits: &mut Edits) {
        let has_end = self.0.get(&path.id()).is_some_and(|[_, _, end]| end.is_some());
        let data = path.attributes().find(|attribute| has_end && attribute.name() == "d");
        if let Some((data, end)) = data.and_then(|data| Some((data, drawn_end(data.value())?))) {
            let there = data.range_value();
            if text.get(there.clone()) == Some(data.value()) {
                edits.replace(there.start + end..there.end, String::new());
            }
        }
    }

    /// usvg's markers in `group` on the outline of an element, and by what each is to be turned; `None` where they are not those that the
    /// document asks for.
    pub(super) fn turns<'g>(
        &self,
        path: Node<'doc, 'doc>,
        theirs: &TheirPath,
        group: &'g Group,
    ) -> Option<Vec<(&'g Group, DAffine2)>> {
        let [start, middle, end] = *self.0.get(&path.id())?;
        let drawn: Option<Vec<&Group>> = group.children().iter().map(alone).collect();
        let drawn = drawn.filter(|_| group.id().is_empty() && group.transform().is_identity())?;
        let legs = legs(theirs);
        let last = legs.len().checked_sub(1)?;
        let between = (1..last).filter(|at| !legs[*at].is_close);
        let mut due: Vec<(usize, Node<'_, '_>)> = start.map(|marker| (0, marker)).into_iter().collect();
        due.extend(
            middle
                .into_iter()
                .flat_map(|marker| between.clone().map(move |at| (at, marker))),
        );
        due.extend(end.filter(|_| !legs[last].is_move).map(|marker| (last, marker)));
        if due.len() != drawn.len() {
            return None;
        }
        let joints = middle.and_then(|_| joints(path.attribute("d")?, legs.len()));
        let is_vertex = |at: usize| !joints.as_ref().is_some_and(|joints| joints[at]);
        let due = due.into_iter().zip(drawn).filter(|((at, _), _)| is_vertex(*at));
        let turns = due.map(|((at, marker), drawn)| {
            let angle = match marker.attribute("orient") {
                Some("auto") => legs[at].angle,
                Some("auto-start-reverse") => legs[at].angle + if at == 0 { PI } else { 0.0 },
                _ => return (drawn, DAffine2::IDENTITY),
            };
            let now = affine(drawn.transform());
            (drawn, turned(now, f64::from(angle), legs[at].to.as_dvec2()))
        });
        Some(turns.collect())
    }
}

/// How much of a path's data is drawn, where that is not all.
fn drawn_end(data: &str) -> Option<usize> {
    let mut segments = svgtypes::PathParser::from(data).collect::<Result<Vec<_>, _>>().ok()?;
    let mut end = data.len();
    while let Some(svgtypes::PathSegment::MoveTo { .. }) = segments.pop() {
        end = data[..end].rfind(['M', 'm'])?;
    }
    (0 < end && end < data.len()).then_some(end)
}

/// A group that may be a marker: usvg gives those no id.
fn alone(node: &usvg::Node) -> Option<&Group> {
    match node {
        usvg::Node::Group(group) if group.id().is_empty() => Some(group),
        _ => None,
    }
}

fn is_marker(node: Node<'_, '_>) -> bool {
    node.tag_name().name() == "marker"
}

/// What turns something that lies so about a place, until its x axis points in this direction.
fn turned(now: DAffine2, angle: f64, about: DVec2) -> DAffine2 {
    /// In radians: as far as 32-bit floats tell directions, and less than anybody sees.
    const NOTHING: f64 = 1e-3;
    let axis = now.matrix2.x_axis;
    let (sin, cos) = (angle - axis.y.atan2(axis.x)).sin_cos();
    let turn = sin.atan2(cos);
    if turn.abs() < NOTHING {
        return DAffine2::IDENTITY;
    }
    DAffine2::from_translation(about) * DAffine2::from_angle(turn) * DAffine2::from_translation(-about)
}

/// A segment of an outline, and the vertex at its end.
#[derive(Clone, Copy, Debug)]
struct Leg {
    to: Vec2,
    is_move: bool,
    is_close: bool,
    /// The directions at its start and its end; those of one without length are another's.
    ways: Option<[Vec2; 2]>,
    /// In which direction a marker at the vertex points, in radians.
    angle: f32,
}

/// The segments of an outline with the directions at their vertices (SVG 2, sections 9.5.3 and 13.7.4).
fn legs(theirs: &TheirPath) -> Vec<Leg> {
    let at = |point: Point| Vec2::new(point.x, point.y);
    let mut legs: Vec<Leg> = Vec::new();
    let (mut begun, mut from) = (Vec2::ZERO, Vec2::ZERO);
    for segment in theirs.segments() {
        let (to, ways) = match segment {
            PathSegment::MoveTo(to) => (at(to), None),
            PathSegment::LineTo(to) => (at(to), ways(&[from, at(to)])),
            PathSegment::QuadTo(control, to) => (at(to), ways(&[from, at(control), at(to)])),
            PathSegment::CubicTo(first, second, to) => (at(to), ways(&[from, at(first), at(second), at(to)])),
            PathSegment::Close => (begun, ways(&[from, begun])),
        };
        let is_move = matches!(segment, PathSegment::MoveTo(_));
        let is_close = segment == PathSegment::Close;
        legs.push(Leg {
            to,
            is_move,
            is_close,
            ways,
            angle: 0.0,
        });
        begun = if is_move { to } else { begun };
        from = to;
    }
    legs.chunk_by_mut(|_, next| !next.is_move).for_each(direct);
    legs
}

/// The directions at the ends of a curve by its points; `None` where all of them are one.
fn ways(points: &[Vec2]) -> Option<[Vec2; 2]> {
    let (first, last) = (*points.first()?, *points.last()?);
    let mut starts = points.iter().map(|point| *point - first);
    let mut ends = points.iter().rev().map(|point| last - *point);
    let is_some = |way: &Vec2| *way != Vec2::ZERO;
    Some([starts.find(is_some)?, ends.find(is_some)?])
}

/// Finds the directions at the vertices of a subpath. A segment without length goes on as the one before it does, or as the next
/// begins.
fn direct(subpath: &mut [Leg]) {
    let mut before = None;
    for leg in subpath.iter_mut() {
        leg.ways = leg.ways.or(before);
        before = leg.ways.map(|[_, end]| [end; 2]);
    }
    let first = subpath.iter().find_map(|leg| leg.ways).map(|[start, _]| [start; 2]);
    for leg in subpath.iter_mut().skip(1) {
        leg.ways = leg.ways.or(first);
    }
    let closing = subpath.last().filter(|leg| leg.is_close).and_then(|leg| leg.ways);
    let starting = subpath.get(1).and_then(|leg| leg.ways);
    for at in 0..subpath.len() {
        let arriving = subpath[at].ways.or(closing);
        let leaving = match subpath.get(at + 1) {
            Some(next) => next.ways,
            None => starting.filter(|_| closing.is_some()),
        };
        subpath[at].angle = angle(arriving.map(|[_, end]| end), leaving.map(|[start, _]| start));
    }
}

/// Between the two directions at a vertex, as usvg counts it: where they are opposite, to the same side.
fn angle(arriving: Option<Vec2>, leaving: Option<Vec2>) -> f32 {
    let positive = |angle: f32| if angle < 0.0 { angle + PI * 2.0 } else { angle };
    let of = |way: Vec2| positive(way.y.atan2(way.x));
    let [arriving, leaving] = match (arriving, leaving) {
        (Some(arriving), Some(leaving)) => [of(arriving), of(leaving)],
        (one, other) => [one.or(other).map_or(0.0, of); 2],
    };
    let half = (leaving - arriving) * 0.5;
    arriving + half - if FRAC_PI_2 < half.abs() { PI } else { 0.0 }
}

/// Which vertices of an outline are none in its data, because an arc goes on there; `count` is how many usvg has.
fn joints(data: &str, count: usize) -> Option<Vec<bool>> {
    let simple: Vec<Simple> = SimplifyingPathParser::from(data).map_while(Result::ok).collect();
    let mut joints: Vec<bool> = Vec::new();
    for segment in svgtypes::PathParser::from(data).map_while(Result::ok) {
        let is_arc = matches!(segment, svgtypes::PathSegment::EllipticalArc { .. });
        let is_moving = matches!(segment, svgtypes::PathSegment::MoveTo { .. });
        // Behind a subpath that is closed, usvg begins another by itself.
        let is_begun = matches!(simple.get(joints.len()), Some(Simple::MoveTo { .. })) && !is_moving;
        joints.extend(is_begun.then_some(false));
        let parts = if is_arc {
            parts(simple.get(joints.len().checked_sub(1)?)?, segment)?
        } else {
            1
        };
        joints.extend((1..parts).map(|_| true));
        joints.push(false);
    }
    (joints.len() == count).then_some(joints)
}

/// How many parts an arc has that begins where another segment ends.
fn parts(before: &Simple, arc: svgtypes::PathSegment) -> Option<usize> {
    let (from_x, from_y) = match *before {
        Simple::MoveTo { x, y }
        | Simple::LineTo { x, y }
        | Simple::Quadratic { x, y, .. }
        | Simple::CurveTo { x, y, .. } => (x, y),
        Simple::ClosePath => return None,
    };
    let svgtypes::PathSegment::EllipticalArc {
        abs,
        rx,
        ry,
        x_axis_rotation,
        large_arc,
        sweep,
        x,
        y,
    } = arc
    else {
        return None;
    };
    let (command, [large, sweep]) = (if abs { 'A' } else { 'a' }, [large_arc, sweep].map(u8::from));
    let alone = format!("M{from_x} {from_y}{command}{rx} {ry} {x_axis_rotation} {large} {sweep} {x} {y}");
    SimplifyingPathParser::from(alone.as_str()).count().checked_sub(1)
}
