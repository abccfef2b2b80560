//! Which elements lead to which: to those inside, to those they refer to, and by paints that are handed down; and the references
//! that close circles, of which nobody draws anything (SVG 2, section 5.6).

use std::collections::{HashMap, HashSet};

use roxmltree::{Node, NodeId};

use super::circles;
use super::styles::{By, Styles};
use crate::scene::report::quote;

/// Something that an element leads to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link<'doc> {
    /// The property or attribute.
    pub(super) by: By,
    pub(super) to: Node<'doc, 'doc>,
}

/// A reference to what is not there.
pub(super) struct Unmet<'doc> {
    pub(super) node: Node<'doc, 'doc>,
    pub(super) by: By,
    pub(super) id: &'doc str,
}

/// A reference that leads in a circle back to where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Circular<'doc> {
    pub(super) by: By,
    pub(super) id: &'doc str,
    /// Whether fill and stroke around the element refer to that, too.
    around: [bool; 2],
}

/// How the elements of a document lead to each other.
#[derive(Debug)]
pub(super) struct Graph<'doc> {
    styles: Styles<'doc>,
    ids: HashMap<&'doc str, Node<'doc, 'doc>>,
    /// Paint servers that elements hand down.
    inherited: HashMap<usize, [Option<&'doc str>; 2]>,
    /// The references that close circles, by the elements that have them.
    circular: HashMap<NodeId, Vec<Link<'doc>>>,
    /// Elements that are not drawn, whatever is inside.
    left_out: HashSet<NodeId>,
}

/// Elements that are drawn elsewhere, but with what they inherit where they stand.
const DEFINITIONS: [&str; 3] = ["pattern", "marker", "mask"];

/// The properties that paint.
const PAINTS: [&str; 2] = ["fill", "stroke"];

/// Whether it is a gradient or a pattern.
pub(super) fn is_server(node: Node<'_, '_>) -> bool {
    matches!(node.tag_name().name(), "linearGradient" | "radialGradient" | "pattern")
}

impl<'doc> Graph<'doc> {
    /// That of the elements below `root`, with these styles.
    pub(super) fn below(root: Node<'doc, 'doc>, styles: Styles<'doc>) -> Self {
        let inherited = styles.inherited(root);
        let mut ids = HashMap::new();
        for node in root.descendants().filter(Node::is_element) {
            if let Some(id) = node.attribute("id") {
                // Of two with one id the first.
                ids.entry(id).or_insert(node);
            }
        }
        let mut graph = Self {
            styles,
            ids,
            inherited,
            circular: HashMap::new(),
            left_out: HashSet::new(),
        };
        graph.circular = graph.find_circles(root);
        graph
    }

    /// Notes an element that is not drawn, whatever is inside.
    pub(super) fn leave_out(&mut self, node: Node<'doc, 'doc>) {
        self.left_out.insert(node.id());
    }

    /// Whether an element is such a one.
    pub(super) fn is_left_out(&self, node: Node<'doc, 'doc>) -> bool {
        self.left_out.contains(&node.id())
    }

    /// Whether there is any circle.
    pub(super) fn has_circles(&self) -> bool {
        !self.circular.is_empty()
    }

    /// The references of an element that lead in circles.
    pub(super) fn circular(&self, node: Node<'doc, 'doc>) -> Vec<Circular<'doc>> {
        let links = self.circular.get(&node.id()).into_iter().flatten();
        let around = self.around(node);
        let circular = links.filter_map(|link| {
            let id = link.to.attribute("id")?;
            Some(Circular {
                by: link.by,
                id,
                around: around.map(|paint| paint == Some(id)),
            })
        });
        circular.collect()
    }

    /// What is inside an element, and what it refers to, but for references that lead in circles; markers after all that they may be
    /// drawn on. Notes what is not there.
    pub(super) fn links(&self, node: Node<'doc, 'doc>, unmet: &mut Vec<Unmet<'doc>>) -> Vec<Link<'doc>> {
        if self.is_left_out(node) {
            return Vec::new();
        }
        let inside = |to| Link { by: By::Inside, to };
        let mut links: Vec<Link<'doc>> = node.children().filter(Node::is_element).map(inside).collect();
        links.extend(self.references(node, unmet));
        links.sort_by_key(|link| match link.by {
            By::Inside | By::Href => 0,
            By::Marker | By::EndMarker => 1,
            _ => 2,
        });
        links.extend(self.handed_down(node));
        if let Some(circular) = self.circular.get(&node.id()) {
            links.retain(|link| !circular.iter().any(|other| (other.by, other.to) == (link.by, link.to)));
        }
        links
    }

    /// What an element refers to itself.
    fn references(&self, node: Node<'doc, 'doc>, unmet: &mut Vec<Unmet<'doc>>) -> Vec<Link<'doc>> {
        let references = self.styles.references(node).into_iter();
        let links = references.filter_map(|(by, id)| {
            let to = self.ids.get(id).copied();
            if to.is_none() {
                unmet.push(Unmet { node, by, id });
            }
            Some(Link { by, to: to? })
        });
        links.collect()
    }

    /// The paint servers of what is around: what stands elsewhere is painted as what is around it there, and each shape has paints of
    /// its own.
    fn handed_down(&self, node: Node<'doc, 'doc>) -> impl Iterator<Item = Link<'doc>> {
        let by = if DEFINITIONS.contains(&node.tag_name().name()) {
            Some(By::Inherited)
        } else {
            (!node.has_children()).then_some(By::Fill)
        };
        let around = by.map(|by| self.around(node).map(|id| (by, id)));
        let around = around.into_iter().flatten();
        around.filter_map(|(by, id)| {
            Some(Link {
                by,
                to: *self.ids.get(id?)?,
            })
        })
    }

    /// The paint servers that an element has from what is around it.
    fn around(&self, node: Node<'doc, 'doc>) -> [Option<&'doc str>; 2] {
        let parent = node.parent_element().map(|parent| parent.id().get_usize());
        let paints = parent.and_then(|parent| self.inherited.get(&parent));
        paints.copied().unwrap_or_default()
    }

    /// The references that lead in circles.
    fn find_circles(&self, root: Node<'doc, 'doc>) -> HashMap<NodeId, Vec<Link<'doc>>> {
        let elements = || root.descendants().filter(Node::is_element);
        let references = elements().flat_map(|node| {
            let links = self.references(node, &mut Vec::new()).into_iter();
            // Shapes of a circle have their paints from an element of it, or from where it stands.
            let handed_down = self.handed_down(node).filter(|link| link.by == By::Inherited);
            let links = links.chain(handed_down).filter(move |link| is_followed(node, link.by));
            links.map(move |link| (node, link))
        });
        let references: Vec<(Node<'doc, 'doc>, Link<'doc>)> = references.collect();
        // Most of what is referred to leads nowhere.
        let mut leading: HashSet<NodeId> = HashSet::new();
        for (node, _) in &references {
            for around in node.ancestors() {
                if !leading.insert(around.id()) {
                    break;
                }
            }
        }
        let number = |node: Node<'_, '_>| node.id().get_usize();
        let edges = references.iter().filter(|(_, link)| leading.contains(&link.to.id()));
        let mut edges: Vec<circles::Edge> = edges
            .map(|(node, link)| (number(*node), number(link.to), link.by))
            .collect();
        if edges.is_empty() {
            return HashMap::new();
        }
        for node in elements().filter(|node| leading.contains(&node.id())) {
            let parent = node.parent_element();
            edges.extend(parent.map(|parent| (number(parent), number(node), By::Inside)));
        }
        let closing: HashSet<circles::Edge> = circles::closing(&edges).into_iter().collect();
        let mut found: HashMap<NodeId, Vec<Link<'doc>>> = HashMap::new();
        for (node, link) in references {
            if closing.contains(&(number(node), number(link.to), link.by)) {
                found.entry(node.id()).or_default().push(link);
            }
        }
        found
    }
}

/// Whether what an element refers to becomes a part of it.
fn is_followed(node: Node<'_, '_>, by: By) -> bool {
    match by {
        By::Inside => false,
        By::Href => node.tag_name().name() == "use" || is_server(node),
        _ => true,
    }
}

impl Circular<'_> {
    /// The properties by which an element may refer to that, and whether what is around it does so, too.
    pub(super) fn properties(self) -> impl Iterator<Item = (&'static str, bool)> {
        let [fill, stroke] = self.around;
        let names: &[(&str, bool)] = match self.by {
            By::Clip => &[("clip-path", false)],
            By::Mask => &[("mask", false)],
            By::Filter => &[("filter", false)],
            By::Marker => &[("marker", false), ("marker-mid", false)],
            By::EndMarker => &[("marker-start", false), ("marker-end", false)],
            By::Fill | By::Stroke | By::Inherited => &[(PAINTS[0], true), (PAINTS[1], true)],
            By::Inside | By::Href | By::Picture => &[],
        };
        let is_around = move |name| if name == PAINTS[0] { fill } else { stroke };
        names
            .iter()
            .map(move |(name, is_paint)| (*name, *is_paint && is_around(*name)))
    }

    /// Whether it is the address of an element, no property.
    pub(super) fn is_address(self) -> bool {
        matches!(self.by, By::Href | By::Picture)
    }

    /// Whether the value of a property refers to that.
    pub(super) fn is_in(self, value: &str) -> bool {
        let mut addresses = value.split("url(").skip(1);
        addresses.any(|address| {
            let address = address.split(')').next().unwrap_or("");
            address.trim().trim_matches(['"', '\'']).trim().strip_prefix('#') == Some(self.id)
        })
    }

    /// What is said of it, where `property` has it, and `instead` is taken.
    pub(super) fn told(self, property: &str, instead: &str) -> String {
        let id = quote(self.id);
        let instead = match instead {
            "" => String::new(),
            paint => format!("; {} is taken", quote(paint)),
        };
        format!("{property} refers to #{id}, which leads in a circle back to here{instead}")
    }
}
