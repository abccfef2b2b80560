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
}

/// An element on the way down.
struct Open<'doc> {
    node: Node<'doc, 'doc>,
    links: std::vec::IntoIter<Link<'doc>>,
    by: By,
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
    has_circles: bool,
}

impl<'doc> Search<'_, 'doc> {
    fn run<L: Listener>(&mut self, root: Node<'doc, 'doc>, listener: &L) -> Result<(), Fault> {
        let mut open = vec![self.open(root, By::Inside)];
        while let Some(last) = open.last_mut() {
            let Some(link) = last.links.next() else {
                let Some(closed) = open.pop() else {
                    break;
                };
                self.done.insert(closed.node.id(), Some(closed.found));
                if let Some(parent) = open.last_mut() {
                    parent.found.add(closed.found);
                    self.count(closed.by, closed.found);
                }
                continue;
            };
            match self.done.get(&link.to.id()) {
                Some(Some(found)) => {
                    let found = *found;
                    last.found.add(found);
                    self.count(link.by, found);
                }
                Some(None) => self.has_circles = true,
                None => {
                    if open.len() >= MAX_DEPTH {
                        let what = "elements inside each other, with those that are referred to";
                        return Err(listener.fault(Problem::TooMany { what, limit: MAX_DEPTH }, link.to, ""));
                    }
                    let next = self.open(link.to, link.by);
                    open.push(next);
                }
            }
            if let Some(last) = open.last()
                && (last.found.work > MAX_WORK || last.found.depth > MAX_DEPTH || self.steps > MAX_SEARCH)
            {
                let what = "elements, with those that references repeat";
                let limit = usize::try_from(MAX_WORK).unwrap_or(usize::MAX);
                return Err(listener.fault(Problem::TooMany { what, limit }, last.node, ""));
            }
        }
        Ok(())
    }

    /// usvg looks through everything that is referred to, once for each reference.
    fn count(&mut self, by: By, found: Found) {
        if !matches!(by, By::Inside | By::Href) {
            self.steps = self.steps.saturating_add(found.work);
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

    fn open(&mut self, node: Node<'doc, 'doc>, by: By) -> Open<'doc> {
        self.done.insert(node.id(), None);
        Open {
            node,
            links: self.links(node).into_iter(),
            by,
            found: Found { work: 1, depth: 1 },
        }
    }

    /// What is inside an element, and what it refers to.
    fn links(&self, node: Node<'doc, 'doc>) -> Vec<Link<'doc>> {
        let children = node
            .children()
            .filter(Node::is_element)
            .map(|to| Link { by: By::Inside, to });
        let mut links: Vec<Link<'doc>> = children.collect();
        for (by, id) in self.styles.references(node) {
            links.extend(self.ids.get(id).map(|to| Link { by, to: *to }));
        }
        links
    }
}

impl Found {
    fn add(&mut self, inside: Self) {
        self.work = self.work.saturating_add(inside.work);
        self.depth = self.depth.max(inside.depth + 1);
    }
}
