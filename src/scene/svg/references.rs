//! References between elements that multiply beyond measure.
//!
//! usvg looks for an element's clip path, mask, pattern, marker and filter as often as it is referred to, inside of what is
//! referred to again. It counts what a `use` repeats; the rest is looked at here. References that lead in
//! circles are taken out before.

use std::collections::HashMap;

use roxmltree::{Node, NodeId};

use super::graph::{Graph, Link, Unmet, is_server};
use super::listener::Listener;
use super::styles::By;
use super::values;
use crate::scene::Problem;
use crate::scene::error::Fault;
use crate::scene::report::quote;

/// Most elements that usvg may look at, those that are referred to counted again with everything inside.
const MAX_WORK: u64 = 4_000_000;

/// Most elements inside each other, where what is referred to counts as inside.
const MAX_DEPTH: usize = 2_000;

/// Most references but those of `use`.
const MAX_REFERENCES: u64 = 150_000;

/// Most numbers of outlines, those that references repeat counted again: usvg takes up to 70 bytes for each.
const MAX_NUMBERS: u64 = 20_000_000;

/// Numbers of a letter's outline.
const OF_A_LETTER: u64 = 40;

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
    /// Numbers of the outlines that are made of it.
    numbers: u64,
    /// Whether all that refer to it share what is made of it.
    is_shared: bool,
    /// Corners of its paths, at each of which a marker is drawn that it hands down.
    corners: u64,
    /// Its paths, at an end of each of which a marker is drawn; there are no more of them than elements.
    paths: u64,
}

/// An element on the way down.
struct Open<'doc> {
    node: Node<'doc, 'doc>,
    links: std::vec::IntoIter<Link<'doc>>,
    by: By,
    times: u64,
    found: Found,
}

/// Refuses documents whose references are too many or too deep, and tells of those to what is not there.
pub(super) fn check<'doc, L: Listener>(
    root: Node<'doc, 'doc>,
    graph: &Graph<'doc>,
    listener: &mut L,
) -> Result<(), Fault> {
    let mut search = Search {
        graph,
        done: HashMap::new(),
        steps: 0,
        references: 0,
        unmet: Vec::new(),
    };
    search.run(root, listener)?;
    for Unmet { node, by, id } in search.unmet.drain(..) {
        if let Some(property) = property(by, node) {
            let instead = instead(node, property, id);
            let instead = instead.map_or_else(String::new, |paint| format!("; {} is taken", quote(paint)));
            listener.warn(
                node,
                format!("{property} refers to #{id}, and no element has that id{instead}"),
            );
        }
    }
    Ok(())
}

struct Search<'s, 'doc> {
    graph: &'s Graph<'doc>,
    /// What has been looked at; `None` while it is being looked at.
    done: HashMap<NodeId, Option<Found>>,
    /// Of usvg's search for circles.
    steps: u64,
    /// How many references there are, of which usvg compares each with each.
    references: u64,
    /// References to what is not there.
    unmet: Vec<Unmet<'doc>>,
}

/// The name of what refers to something, where nothing else tells that it is not there.
fn property(by: By, node: Node<'_, '_>) -> Option<&'static str> {
    Some(match by {
        By::Fill => "fill",
        By::Stroke => "stroke",
        By::Clip => "clip-path",
        By::Mask => "mask",
        By::Marker | By::EndMarker => "marker",
        By::Href if is_server(node) => "href",
        By::Href | By::Filter | By::Picture | By::Inside | By::Inherited => return None,
    })
}

/// The paint that an element names behind a reference, for where nothing has that id.
fn instead<'doc>(node: Node<'doc, 'doc>, property: &str, id: &str) -> Option<&'doc str> {
    let style = simplecss::DeclarationTokenizer::from(node.attribute("style").unwrap_or(""));
    let declared = style
        .filter(|declaration| declaration.name == property)
        .map(|declaration| declaration.value);
    let mut values = declared.chain(node.attribute(property));
    let value = values.find(|value| values::reference(value) == Some(id))?;
    let (_, instead) = value.split_once(')')?;
    Some(instead.trim()).filter(|instead| !instead.is_empty())
}

impl<'doc> Search<'_, 'doc> {
    fn run<L: Listener>(&mut self, root: Node<'doc, 'doc>, listener: &L) -> Result<(), Fault> {
        let whole = Link {
            by: By::Inside,
            to: root,
        };
        let mut open = vec![self.open(whole, 1)];
        while let Some(last) = open.last_mut() {
            if let Some(link) = last.links.next() {
                let times = last.found.times(link.by);
                match self.done.get(&link.to.id()) {
                    Some(Some(found)) => {
                        let found = *found;
                        last.found.add(link.by, found, times);
                        self.count(link.by, found, times);
                    }
                    // Such as the place that a link leads to; nothing is drawn of it here.
                    Some(None) => {}
                    None => {
                        if open.len() >= MAX_DEPTH {
                            let what = DEEP;
                            return Err(listener.fault(Problem::TooMany { what, limit: MAX_DEPTH }, link.to, ""));
                        }
                        let next = self.open(link, times);
                        open.push(next);
                    }
                }
            } else if let Some(closed) = open.pop() {
                self.done.insert(closed.node.id(), Some(closed.found));
                if let Some(around) = open.last_mut() {
                    around.found.add(closed.by, closed.found, closed.times);
                    self.count(closed.by, closed.found, closed.times);
                }
            }
            if let Some(last) = open.last()
                && let Some((what, limit)) = self.excess(last.found)
            {
                let limit = usize::try_from(limit).unwrap_or(usize::MAX);
                return Err(listener.fault(Problem::TooMany { what, limit }, last.node, ""));
            }
        }
        Ok(())
    }

    /// What of an element is too much, with all that is inside so far, and where the limit is.
    fn excess(&self, found: Found) -> Option<(&'static str, u64)> {
        if found.depth > MAX_DEPTH {
            Some((DEEP, MAX_DEPTH as u64))
        } else if self.references > MAX_REFERENCES {
            let what = "references to gradients, patterns, clip paths, masks and markers, one for each shape or corner (shapes that look alike can be one path)";
            Some((what, MAX_REFERENCES))
        } else if found.work > MAX_WORK || self.steps > MAX_SEARCH {
            Some(("elements, with those that references repeat", MAX_WORK))
        } else if found.numbers > MAX_NUMBERS {
            let what = "numbers of outlines (a letter has about 40), with those that references repeat";
            Some((what, MAX_NUMBERS))
        } else {
            None
        }
    }

    /// usvg looks through everything that is referred to, once for each reference.
    fn count(&mut self, by: By, found: Found, times: u64) {
        if !matches!(by, By::Inside | By::Href) {
            self.steps = self.steps.saturating_add(found.work);
            self.references = self.references.saturating_add(times);
        }
    }

    fn open(&mut self, link: Link<'doc>, times: u64) -> Open<'doc> {
        let Link { by, to } = link;
        self.done.insert(to.id(), None);
        let mut unmet = std::mem::take(&mut self.unmet);
        let links = self.graph.links(to, &mut unmet);
        self.unmet = unmet;
        Open {
            node: to,
            links: links.into_iter(),
            by,
            times,
            found: if self.graph.is_left_out(to) {
                Found::NOTHING
            } else {
                Found::alone(to)
            },
        }
    }
}

impl Found {
    /// An element that is left out.
    const NOTHING: Self = Self {
        work: 1,
        depth: 1,
        numbers: 0,
        is_shared: false,
        corners: 0,
        paths: 0,
    };

    /// An element without what is inside and what it refers to.
    fn alone(node: Node<'_, '_>) -> Self {
        let data = node.attribute("d").or_else(|| node.attribute("points"));
        let numbers = data.map_or(0, numbers);
        let letters = match node.tag_name().name() {
            "text" | "tspan" | "textPath" | "a" => {
                let texts = node.children().filter(Node::is_text);
                texts.map(|text| text.text().unwrap_or("").trim().len() as u64).sum()
            }
            _ => 0,
        };
        Self {
            is_shared: matches!(node.tag_name().name(), "linearGradient" | "radialGradient"),
            numbers: numbers.saturating_add(OF_A_LETTER * letters),
            // Most corners have two numbers or more.
            corners: numbers.div_ceil(2),
            paths: 1,
            ..Self::NOTHING
        }
    }

    /// How often an element is drawn that is referred to once, where all that is inside has been added.
    fn times(self, by: By) -> u64 {
        match by {
            By::Marker => self.corners.max(1),
            By::EndMarker => self.paths,
            _ => 1,
        }
    }

    fn add(&mut self, by: By, inside: Self, times: u64) {
        let work = if inside.is_shared { 1 } else { inside.work };
        self.work = self.work.saturating_add(work.saturating_mul(times));
        self.numbers = self.numbers.saturating_add(inside.numbers.saturating_mul(times));
        self.depth = self.depth.max(inside.depth + 1);
        if matches!(by, By::Inside | By::Href) {
            self.corners = self.corners.saturating_add(inside.corners);
            self.paths = self.paths.saturating_add(inside.paths);
        }
    }
}

/// How many numbers the data of a path or polygon holds, about.
fn numbers(data: &str) -> u64 {
    let mut count = 0;
    let mut last = b' ';
    let mut has_point = false;
    for byte in data.bytes() {
        let is_point = byte == b'.';
        if is_point || byte.is_ascii_digit() {
            let begins = !(last == b'.' || last.is_ascii_digit());
            // A second point begins another number: `.5.5`.
            let again = is_point && has_point && !begins;
            has_point = is_point || has_point && !begins;
            count += u64::from(begins || again);
        }
        last = byte;
    }
    count
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
        Some(values::reference(value))
    })?
}
