//! References between elements: those that multiply beyond measure, or lead in a circle that usvg would follow for ever.
//!
//! usvg looks for an element's clip path, mask, pattern, marker and filter as often as it is referred to, inside of what is
//! referred to again. It breaks circles of one or two elements, and counts what a `use` repeats; the rest is looked at here.

use std::collections::HashMap;

use roxmltree::{Node, NodeId};

use super::circles;
use super::listener::Listener;
use super::styles::{By, Styles};
use crate::scene::Problem;
use crate::scene::error::Fault;

/// Most elements that usvg may look at, those that are referred to counted again with everything inside.
const MAX_WORK: u64 = 4_000_000;

/// Most elements inside each other, where what is referred to counts as inside.
const MAX_DEPTH: usize = 2_000;

/// Most references but those of `use`.
const MAX_REFERENCES: u64 = 150_000;

/// Elements inside a group with a marker that are looked at for the longest path.
const MAX_INSIDE: usize = 1_000;

const DEEP: &str = "elements inside each other, with those that are referred to";

/// Most steps of usvg's own search for circles.
const MAX_SEARCH: u64 = 200_000_000;

/// What an element is to usvg.
#[derive(Clone, Copy, Debug)]
struct Found {
    /// How many elements are looked at for it.
    work: u64,
    /// How deep that goes.
    depth: usize,
}

/// Something that an element refers to.
#[derive(Clone, Copy, Debug)]
struct Link<'doc> {
    /// The property or attribute.
    by: By,
    to: Node<'doc, 'doc>,
    /// How often it is drawn for one reference: a marker is, at every corner.
    times: u64,
}

/// An element on the way down.
struct Open<'doc> {
    node: Node<'doc, 'doc>,
    links: std::vec::IntoIter<Link<'doc>>,
    by: By,
    times: u64,
    found: Found,
}

/// Refuses documents whose references are too many, too deep or circular.
pub(super) fn check<'doc, L: Listener>(root: Node<'doc, 'doc>, listener: &mut L) -> Result<(), Fault> {
    let styles = Styles::below(root, listener)?;
    let mut ids = HashMap::new();
    for node in root.descendants().filter(Node::is_element) {
        if let Some(id) = node.attribute("id") {
            ids.entry(id).or_insert(node);
        }
    }
    let mut search = Search {
        styles: &styles,
        ids: &ids,
        done: HashMap::new(),
        steps: 0,
        references: 0,
        inherited: styles.inherited(root),
        has_circles: false,
    };
    search.run(root, listener)?;
    if !search.has_circles {
        return Ok(());
    }
    match circles::endless(&search.edges(root)) {
        Some(at) => {
            let node = root.descendants().find(|node| node.id().get_usize() == at);
            Err(listener.fault(Problem::Circle, node.unwrap_or(root), ""))
        }
        None => Ok(()),
    }
}

struct Search<'s, 'doc> {
    styles: &'s Styles<'doc>,
    ids: &'s HashMap<&'doc str, Node<'doc, 'doc>>,
    /// What has been looked at; `None` while it is being looked at.
    done: HashMap<NodeId, Option<Found>>,
    /// Of usvg's search for circles.
    steps: u64,
    /// How many references there are, of which usvg compares each with each.
    references: u64,
    /// Paint servers that elements hand down.
    inherited: HashMap<usize, [Option<&'doc str>; 2]>,
    has_circles: bool,
}

impl<'doc> Search<'_, 'doc> {
    fn run<L: Listener>(&mut self, root: Node<'doc, 'doc>, listener: &L) -> Result<(), Fault> {
        let whole = Link {
            by: By::Inside,
            to: root,
            times: 1,
        };
        let mut open = vec![self.open(whole)];
        while let Some(last) = open.last_mut() {
            let Some(link) = last.links.next() else {
                let Some(closed) = open.pop() else {
                    break;
                };
                self.done.insert(closed.node.id(), Some(closed.found));
                if let Some(parent) = open.last_mut() {
                    parent.found.add(closed.found, closed.times);
                    self.count(closed.by, closed.found, closed.times);
                }
                continue;
            };
            match self.done.get(&link.to.id()) {
                Some(Some(found)) => {
                    let found = *found;
                    last.found.add(found, link.times);
                    self.count(link.by, found, link.times);
                }
                Some(None) => self.has_circles = true,
                None => {
                    if open.len() >= MAX_DEPTH {
                        let what = DEEP;
                        return Err(listener.fault(Problem::TooMany { what, limit: MAX_DEPTH }, link.to, ""));
                    }
                    let next = self.open(link);
                    open.push(next);
                }
            }
            if self.references > MAX_REFERENCES {
                let limit = usize::try_from(MAX_REFERENCES).unwrap_or(usize::MAX);
                let what = "references to gradients, patterns, clip paths and masks";
                return Err(listener.fault(Problem::TooMany { what, limit }, link.to, ""));
            }
            if let Some(last) = open.last() {
                let deep = last.found.depth > MAX_DEPTH;
                let much = last.found.work > MAX_WORK || self.steps > MAX_SEARCH;
                let (what, limit) = match (deep, much) {
                    (true, _) => (DEEP, MAX_DEPTH),
                    (_, true) => (
                        "elements, with those that references repeat",
                        usize::try_from(MAX_WORK).unwrap_or(usize::MAX),
                    ),
                    _ => continue,
                };
                return Err(listener.fault(Problem::TooMany { what, limit }, last.node, ""));
            }
        }
        Ok(())
    }

    /// usvg looks through everything that is referred to, once for each reference.
    fn count(&mut self, by: By, found: Found, times: u64) {
        if !matches!(by, By::Inside | By::Href) {
            self.steps = self.steps.saturating_add(found.work);
            self.references = self.references.saturating_add(times);
        }
    }

    /// Everything that leads from element to element, but for markers: usvg draws none inside of itself.
    fn edges(&self, root: Node<'doc, 'doc>) -> Vec<circles::Edge> {
        let nodes = root.descendants().filter(Node::is_element);
        let edges = nodes.flat_map(|node| {
            let from = node.id().get_usize();
            let links = self.links(node).into_iter();
            links.map(move |link| (from, link.to.id().get_usize(), link.by))
        });
        edges.filter(|(_, _, by)| *by != By::Marker).collect()
    }

    fn open(&mut self, link: Link<'doc>) -> Open<'doc> {
        let Link { by, to, times } = link;
        self.done.insert(to.id(), None);
        Open {
            node: to,
            links: self.links(to).into_iter(),
            by,
            times,
            found: Found { work: 1, depth: 1 },
        }
    }

    /// What is inside an element, and what it refers to.
    fn links(&self, node: Node<'doc, 'doc>) -> Vec<Link<'doc>> {
        let inside = |to| Link {
            by: By::Inside,
            to,
            times: 1,
        };
        let mut links: Vec<Link<'doc>> = node.children().filter(Node::is_element).map(inside).collect();
        for (by, id) in self.styles.references(node) {
            let times = if by == By::Marker { corners(node) } else { 1 };
            links.extend(self.ids.get(id).map(|to| Link { by, to: *to, times }));
        }
        // What stands elsewhere is painted as what is around it there; and each shape has paints of its own.
        let is_definition = DEFINITIONS.contains(&node.tag_name().name());
        if is_definition || !node.has_children() {
            let parent = node.parent_element().map(|parent| parent.id().get_usize());
            let paints = parent.and_then(|parent| self.inherited.get(&parent));
            let around = paints.into_iter().flatten().flatten().filter_map(|id| self.ids.get(id));
            let by = if is_definition { By::Inherited } else { By::Fill };
            links.extend(around.map(|to| Link { by, to: *to, times: 1 }));
        }
        links
    }
}

/// Elements that are drawn elsewhere, but with what they inherit where they stand.
const DEFINITIONS: [&str; 3] = ["pattern", "marker", "mask"];

/// How many corners the longest path inside an element has, at most.
fn corners(node: Node<'_, '_>) -> u64 {
    let of_one = |node: Node<'_, '_>| {
        let data = node.attribute("d").or_else(|| node.attribute("points")).unwrap_or("");
        // A corner takes about as many characters, mostly more.
        (data.len() / 4) as u64
    };
    node.descendants()
        .take(MAX_INSIDE)
        .map(of_one)
        .max()
        .unwrap_or(0)
        .max(1)
}

impl Found {
    fn add(&mut self, inside: Self, times: u64) {
        self.work = self.work.saturating_add(inside.work.saturating_mul(times));
        self.depth = self.depth.max(inside.depth + 1);
    }
}

/// The id that a property refers to, written on the element or handed down to it; style sheets are not looked at.
pub(super) fn inherited<'doc>(node: Node<'doc, 'doc>, property: &str) -> Option<&'doc str> {
    node.ancestors().find_map(|node| {
        let style = node.attribute("style").unwrap_or("");
        let declared = simplecss::DeclarationTokenizer::from(style)
            .find(|declaration| declaration.name == property)
            .map(|declaration| declaration.value);
        let value = declared.or_else(|| node.attribute(property))?;
        // The nearest value counts, whatever it is.
        Some(
            value
                .trim()
                .strip_prefix("url(#")
                .and_then(|rest| Some(rest.split_once(')')?.0)),
        )
    })?
}
