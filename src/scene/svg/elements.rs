//! The elements of a document by the ids that usvg knows them by.
//!
//! usvg hands out the `id` of what it makes of an element, and nothing else that tells where the element stands. So elements
//! without one get an id of ours in the text that usvg reads; nobody else ever sees it.

use std::collections::{HashMap, HashSet};

use roxmltree::Node;

use crate::scene::attributes;

/// Elements that become something to paint, or groups of that.
const SHOWN: [&str; 16] = [
    "svg", "g", "a", "switch", "use", "rect", "circle", "ellipse", "line", "polyline", "polygon", "path", "image",
    "text", "colortri", "textri",
];

/// Finds elements by their own ids and by those that they were given.
#[derive(Debug)]
pub(super) struct Elements<'doc> {
    /// What every id of ours begins with, and no other.
    prefix: String,
    given: Vec<Node<'doc, 'doc>>,
    own: HashMap<&'doc str, Node<'doc, 'doc>>,
    /// The course's triangles, by their numbers.
    triangles: Vec<Node<'doc, 'doc>>,
}

impl<'doc> Elements<'doc> {
    /// The elements below `root`, itself included.
    pub(super) fn below(root: Node<'doc, 'doc>) -> Self {
        let mut own = HashMap::new();
        let mut taken = HashSet::new();
        for node in root.descendants().filter(Node::is_element) {
            // Of two elements with one id usvg takes the first for `use`.
            if let Some(id) = own_id(node) {
                own.entry(id).or_insert(node);
                taken.extend(number_of(id));
            }
        }
        let number = (0..=taken.len() as u64)
            .find(|number| !taken.contains(number))
            .unwrap_or(u64::MAX);
        Self {
            prefix: format!("_{number}_"),
            given: Vec::new(),
            own,
            triangles: Vec::new(),
        }
    }

    /// The id that `node` needs to be found by: none where it has one of its own, or never shows.
    pub(super) fn give(&mut self, node: Node<'doc, 'doc>) -> Option<String> {
        if own_id(node).is_some() || !SHOWN.contains(&node.tag_name().name()) {
            return None;
        }
        self.given.push(node);
        Some(format!("{}{}", self.prefix, self.given.len() - 1))
    }

    /// Numbers a triangle of the course.
    pub(super) fn add_triangle(&mut self, node: Node<'doc, 'doc>) -> usize {
        self.triangles.push(node);
        self.triangles.len() - 1
    }

    /// The course's triangles, by their numbers.
    pub(super) fn triangles(&self) -> &[Node<'doc, 'doc>] {
        &self.triangles
    }

    /// An address of ours, that no document has.
    pub(super) fn address(&self, number: usize) -> String {
        format!("{}picture{number}", self.prefix)
    }

    /// The id of an outline that we put into the text.
    pub(super) fn outline(&self, number: usize) -> String {
        format!("{}outline{number}", self.prefix)
    }

    /// The number in an address of ours.
    pub(super) fn number(&self, address: &str) -> Option<usize> {
        let rest = address.strip_prefix(&self.prefix)?;
        rest.strip_prefix("picture")?.parse().ok()
    }

    /// The element of this id, its own or one that it was given.
    pub(super) fn find(&self, id: &str) -> Option<Node<'doc, 'doc>> {
        match id.strip_prefix(&self.prefix) {
            Some(number) => self.given.get(number.parse::<usize>().ok()?).copied(),
            None => self.own.get(id).copied(),
        }
    }

    /// The element that has this id itself.
    pub(super) fn own(&self, id: &str) -> Option<Node<'doc, 'doc>> {
        self.own.get(id).copied()
    }

    /// The element that a `use` shows, if it is in this document.
    pub(super) fn target(&self, node: Node<'doc, 'doc>) -> Option<Node<'doc, 'doc>> {
        let id = attributes::href(node)?.trim().strip_prefix('#')?;
        self.own.get(id).copied()
    }
}

/// The id that usvg sees: one in a foreign namespace is none to it.
fn own_id<'doc>(node: Node<'doc, 'doc>) -> Option<&'doc str> {
    let xml = "http://www.w3.org/XML/1998/namespace";
    let mut ids = node.attributes().filter(|attribute| attribute.name() == "id");
    let id = ids
        .find(|attribute| attribute.namespace().is_none_or(|uri| uri == xml))?
        .value();
    (!id.trim().is_empty()).then_some(id)
}

/// The number in what might be taken for an id of ours.
fn number_of(id: &str) -> Option<u64> {
    let (number, _) = id.strip_prefix('_')?.split_once('_')?;
    number.parse().ok()
}
