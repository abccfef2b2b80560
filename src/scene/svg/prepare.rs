//! A document made ready for usvg: every element with an id, images by number, the course's triangles as paths; and a report of
//! what is not drawn.

use glam::{DAffine2, DVec2};
use roxmltree::{Attribute, Node};

use super::cascade::{Cascade, Styled};
use super::check;
use super::elements::Elements;
use super::graph::{Circular, Graph};
use super::listener::Listener;
use super::marked::Marks;
use super::markers::Markers;
use super::styles::Styles;
use super::{cascade, left_out, mended, nonsense, own_triangles, sheets, styles, text_paths, transforms, viewports};
use crate::scene::edits::Edits;
use crate::scene::error::Fault;
use crate::scene::{Problem, SkippedKind, attributes, numbers};

/// Most elements that usvg reads, those that a `use` repeats counted again.
pub(super) const MAX_ELEMENTS: usize = 1_000_000;

/// Elements inside each other, at most: each takes usvg's stack.
const MAX_DEPTH: usize = 1_000;

/// Most stops of a gradient.
const MAX_STOPS: usize = 100_000;

/// Elements that usvg makes something of.
const UNDERSTOOD: [&str; 31] = [
    "svg",
    "g",
    "a",
    "switch",
    "use",
    "symbol",
    "defs",
    "style",
    "rect",
    "circle",
    "ellipse",
    "line",
    "polyline",
    "polygon",
    "path",
    "image",
    "text",
    "tspan",
    "textPath",
    "tref",
    "clipPath",
    "mask",
    "marker",
    "pattern",
    "linearGradient",
    "radialGradient",
    "stop",
    "filter",
    "colortri",
    "textri",
    "texture",
];

/// Elements that no reader draws.
const NEVER_DRAWN: [&str; 2] = ["cursor", "view"];

/// The namespace of SVG.
const SVG: &str = "http://www.w3.org/2000/svg";

/// What usvg reads, and what it is made from.
#[derive(Debug)]
pub(super) struct Prepared<'doc> {
    pub(super) text: String,
    pub(super) elements: Elements<'doc>,
    /// Elements that show images, by the numbers in their addresses.
    pub(super) images: Vec<Node<'doc, 'doc>>,
    /// The first element with text, if there is one.
    pub(super) letters: Option<Node<'doc, 'doc>>,
    /// How its elements lead to each other.
    pub(super) graph: Graph<'doc>,
    pub(super) markers: Markers<'doc>,
}

/// Gathers the changes to one document.
struct Preparation<'a, 'doc, L> {
    text: &'a str,
    edits: Edits,
    elements: Elements<'doc>,
    images: Vec<Node<'doc, 'doc>>,
    letters: Option<Node<'doc, 'doc>>,
    cascade: Cascade<'doc>,
    graph: Graph<'doc>,
    /// How many elements usvg will have to read, at least.
    read: usize,
    marks: Marks<'a>,
    markers: Markers<'doc>,
    names: own_triangles::Names,
    /// Whether it is told that coordinates are rounded.
    is_far_told: bool,
    listener: &'a mut L,
}

/// Makes the document below `root`, which was parsed from `text`, ready.
pub(super) fn prepare<'doc, L: Listener>(
    root: Node<'doc, 'doc>,
    text: &str,
    listener: &mut L,
) -> Result<Prepared<'doc>, Fault> {
    styles::bounded(root, text, listener)?;
    let graph = Graph::below(root, Styles::below(root, listener)?);
    let mut edits = Edits::default();
    let marks = Marks::of(text, &mut edits);
    let names = own_triangles::Names::of(text, &mut edits);
    if !names.are_apart {
        let message =
            "styles of path, polygon or polyline hold for colortri and textri, too: select the others by a class";
        listener.warn(root, message.to_owned());
    }
    let elements = Elements::below(root);
    let markers = Markers::below(root, &elements);
    let mut preparation = Preparation {
        text,
        edits,
        elements,
        images: Vec::new(),
        letters: None,
        cascade: Cascade::below(root, graph.has_circles()),
        graph,
        read: 0,
        marks,
        markers,
        names,
        is_far_told: false,
        listener,
    };
    if let Some(message) = mended::style_elsewhere(root) {
        preparation.listener.warn(root, message.to_owned());
    }
    if let Some(message) = mended::other_namespace(root, SVG) {
        preparation.listener.warn(root, message);
    }
    preparation.namespace(root);
    preparation.written_rules(root);
    if let Some(message) = mended::far_from_zero(root) {
        preparation.is_far_told = true;
        preparation.listener.warn(root, message);
    }
    preparation.tree(root)?;
    let Preparation {
        edits,
        elements,
        images,
        letters,
        graph,
        markers,
        ..
    } = preparation;
    Ok(Prepared {
        text: edits.apply(text),
        elements,
        images,
        letters,
        graph,
        markers,
    })
}

/// A container whose children are being looked at.
struct Open<'doc> {
    node: Node<'doc, 'doc>,
    next: Option<Node<'doc, 'doc>>,
    within: Within,
}

/// What an element lies in.
#[derive(Clone, Copy)]
struct Within {
    /// All transforms so far.
    to_root: DAffine2,
    /// Whether what is inside may be seen, so that its absence is worth a word.
    heard: bool,
    /// Width and height of what percentages are of, where the document tells them.
    viewport: Option<DVec2>,
}

impl<'doc, L: Listener> Preparation<'_, 'doc, L> {
    /// Walks the tree without recursion, so that no nesting is too deep.
    fn tree(&mut self, root: Node<'doc, 'doc>) -> Result<(), Fault> {
        let mut open: Vec<Open<'doc>> = Vec::new();
        let nothing = Within {
            to_root: DAffine2::IDENTITY,
            heard: true,
            viewport: None,
        };
        open.extend(self.element(root, nothing)?);
        while let Some(container) = open.last_mut() {
            let Some(node) = container.next else {
                open.pop();
                continue;
            };
            container.next = node.next_sibling();
            if !node.is_element() || attributes::is_silent(node) {
                continue;
            }
            let within = container.within;
            if open.len() >= MAX_DEPTH {
                let what = "elements inside each other";
                let problem = Problem::TooMany { what, limit: MAX_DEPTH };
                return Err(self.listener.fault(problem, node, ""));
            }
            open.extend(self.element(node, within)?);
        }
        Ok(())
    }

    /// Looks at an element, and opens it unless nobody sees what is inside.
    fn element(&mut self, node: Node<'doc, 'doc>, around: Within) -> Result<Option<Open<'doc>>, Fault> {
        let Within { heard, viewport, .. } = around;
        let name = node.tag_name().name();
        let is_effect = name.starts_with("fe")
            && node
                .parent_element()
                .is_some_and(|parent| parent.has_tag_name("filter"));
        if !UNDERSTOOD.contains(&name) && !is_effect {
            if heard && !NEVER_DRAWN.contains(&name) && !is_fallen_back(node) {
                self.listener.skip(SkippedKind::Element, name, node);
            }
            return Ok(None);
        }
        if self.leave_out(node, heard) {
            return Ok(None);
        }
        let is_told =
            heard && !mended::is_whitened(node, &self.elements) && !mended::is_filtered_away(node, &self.elements);
        let circular = self.graph.circular(node);
        let mut styled = self.cascade.styled(node, &self.elements, &circular);
        self.open_circles(node, &circular, heard.then_some(&styled));
        if let Some(problem) = self.cascade.excess() {
            return Err(self.listener.fault(problem, node, ""));
        }
        let look = check::look(self.listener, node, &styled, is_told);
        viewports::resolve(node, &mut styled, &self.elements, viewport);
        let to_root = around.to_root * look.to_parent;
        if !transforms::is_within_floats(to_root, look.reach) {
            return Err(self.listener.fault(Problem::TooFar, node, ""));
        }
        let is_flat = name == "svg" && viewports::is_flat(node, &styled);
        let heard = heard && look.displayed && !viewports::hides(node) && !is_flat;
        self.count(node)?;
        self.identify(node);
        self.marks.put(node, self.name_end(node), &mut self.edits);
        mended::pixelate(node, &mut self.edits);
        styled.write_rules(node, &mut self.edits);
        self.hide_nonsense(node, &styled);
        if own_triangles::is_one(node) {
            styled.paint(self.triangle(node));
        }
        styled.write(self.text, node, self.name_end(node), &mut self.edits);
        mended::trim_numbers(self.text, node, &styled, &mut self.edits);
        mended::mend_filter(node, &self.elements, &mut self.edits);
        if heard {
            self.tell(node, to_root, viewport);
        }
        match name {
            "image" => self.image(node, heard),
            "path" => self.markers.end_drawn(self.text, node, &mut self.edits),
            "textPath" => {
                let id = self.elements.outline(node.id().get_usize());
                text_paths::move_own(self.text, node, (&id, self.name_end(node)), &mut self.edits);
            }
            "text" if self.letters.is_none() => self.letters = Some(node),
            _ => {}
        }
        Ok(Some(Open {
            node,
            next: node.first_child(),
            within: Within {
                to_root,
                heard,
                viewport: viewports::inside(node, &styled, viewport),
            },
        })
        .filter(|open| open.node.has_children()))
    }

    /// Takes letters out that nobody draws, and tells whoever hears it; whether they are.
    fn leave_out(&mut self, node: Node<'doc, 'doc>, heard: bool) -> bool {
        let Some((why, instead)) = left_out::letters(node, &self.elements) else {
            return false;
        };
        if heard {
            self.listener.warn(node, why);
        }
        self.edits.replace(node.range(), instead.to_owned());
        self.graph.leave_out(node);
        true
    }

    /// Takes an element's addresses out that lead in circles; tells of them, and of what its styles have for others, to whoever hears it.
    fn open_circles(&mut self, node: Node<'doc, 'doc>, circular: &[Circular<'doc>], heard: Option<&Styled<'doc>>) {
        let mut told = heard.map_or(Vec::new(), |styled| styled.circles.clone());
        if let Some(address) = circular.iter().find(|circular| circular.is_address()) {
            let hrefs = node.attributes().filter(|attribute| attribute.name() == "href");
            for href in hrefs {
                self.edits.replace(href.range(), String::new());
            }
            let is_use = node.tag_name().name() == "use";
            let property = if is_use { "not drawn: its href" } else { "href" };
            told.extend(heard.map(|_| address.told(property, "")));
        }
        for message in told {
            self.listener.warn(node, message);
        }
    }

    /// Tells of a shape that is drawn in another place, and of what is not drawn.
    fn tell(&mut self, node: Node<'doc, 'doc>, to_root: DAffine2, viewport: Option<DVec2>) {
        let far = viewport.filter(|_| !self.is_far_told);
        if let Some(message) = far.and_then(|picture| mended::far_before_transform(node, to_root, picture)) {
            self.is_far_told = true;
            self.listener.warn(node, message);
        }
        if let Some(message) = mended::clips_nothing(node, &self.elements) {
            self.listener.warn(node, message);
        }
        if let Some(message) = mended::shows_nothing(node, &self.elements) {
            self.listener.warn(node, message.to_owned());
        }
    }

    /// Refuses more elements than usvg reads, and more stops of a gradient.
    fn count(&mut self, node: Node<'doc, 'doc>) -> Result<(), Fault> {
        self.read += usize::from(!matches!(node.tag_name().name(), "style" | "texture"));
        if self.read > MAX_ELEMENTS {
            let (what, limit) = ("elements", MAX_ELEMENTS);
            return Err(self.listener.fault(Problem::TooMany { what, limit }, node, ""));
        }
        let is_gradient = matches!(node.tag_name().name(), "linearGradient" | "radialGradient");
        if is_gradient && node.children().count() > MAX_STOPS {
            let (what, limit) = ("stops of one gradient", MAX_STOPS);
            let cure = "leave out those that nobody sees";
            return Err(self.listener.fault(Problem::TooMuch { what, limit, cure }, node, ""));
        }
        Ok(())
    }

    /// Has usvg read no style sheet whose rules are written into the styles of elements.
    fn written_rules(&mut self, root: Node<'doc, 'doc>) {
        let sheets = root.descendants().filter(|node| node.tag_name().name() == "style");
        for sheet in sheets.filter(|_| self.cascade.is_written) {
            cascade::hide_sheet(sheet, self.name_end(sheet), &mut self.edits);
        }
    }

    /// Gives the element an id if it needs one, in the place of an empty one.
    fn identify(&mut self, node: Node<'doc, 'doc>) {
        if let Some(id) = self.elements.give(node) {
            let is_plain = |own: &Attribute<'_, '_>| own.name() == "id" && own.namespace().is_none();
            match node.attributes().find(is_plain) {
                Some(empty) => self.edits.replace(empty.range_value(), id),
                None => self.edits.insert(self.name_end(node), format!(" id=\"{id}\"")),
            }
        }
    }

    /// Takes their names from values that usvg would make something else of.
    fn hide_nonsense(&mut self, node: Node<'doc, 'doc>, styled: &Styled<'doc>) {
        if let Some(message) = mended::hide_fine_pattern(node, &mut self.edits) {
            self.listener.warn(node, message);
        }
        if let Some(message) = mended::drop_text_length(node, &mut self.edits) {
            self.listener.warn(node, message.to_owned());
        }
        nonsense::hide(self.text, node, |name| styled.has_length(name), &mut self.edits);
        if node.tag_name().name() == "style" {
            cascade::unmark_sheet(self.text, node, &mut self.edits);
            let (cuts, between) = sheets::cuts(self.text, node).unwrap_or_default();
            for at in cuts {
                self.edits.insert(at, between.clone());
            }
            for part in node.children().filter(Node::is_text) {
                nonsense::hide_profiles(self.text, part.range(), &mut self.edits);
            }
            if let Some(message) = mended::other_media(node) {
                self.listener.warn(node, message);
            }
            for (at, message) in nonsense::names_in_sheet(self.text, node) {
                self.edits.insert(at, nonsense::UNREAD.to_owned());
                self.listener.warn_at(at, node, message);
            }
        }
    }

    /// Where the name in the start tag ends.
    fn name_end(&self, node: Node<'doc, 'doc>) -> usize {
        let start = node.range().start + 1;
        let name = self.text.as_bytes()[start..].iter();
        start + name.take_while(|byte| !b" \t\r\n/>".contains(byte)).count()
    }

    /// Documents without SVG's namespace get it where they have another.
    fn namespace(&mut self, root: Node<'doc, 'doc>) {
        if root.tag_name().namespace().is_none_or(|uri| uri == SVG) {
            return;
        }
        let start = self.name_end(root);
        let prefix = root
            .lookup_prefix(root.tag_name().namespace().unwrap_or(""))
            .filter(|prefix| !prefix.is_empty());
        let name = prefix.map_or_else(|| "xmlns".to_owned(), |prefix| format!("xmlns:{prefix}"));
        let tag = self.text.get(start..).unwrap_or("");
        let declared = tag.match_indices(&name).find_map(|(at, _)| {
            let value = tag[at + name.len()..].trim_start().strip_prefix('=')?.trim_start();
            let quote = value.chars().next().filter(|c| matches!(c, '"' | '\''))?;
            // What is left of the text ends where the text does.
            let begin = self.text.len() - value.len() + 1;
            let length = value[1..].find(quote)?;
            Some(begin..begin + length)
        });
        if let Some(uri) = declared {
            self.edits.replace(uri, SVG.to_owned());
        }
    }

    /// usvg asks for images by their numbers.
    fn image(&mut self, node: Node<'doc, 'doc>, heard: bool) {
        let address = self.elements.address(self.images.len());
        let hrefs: Vec<Attribute<'_, '_>> = node
            .attributes()
            .filter(|attribute| attribute.name() == "href")
            .collect();
        if attributes::href(node).is_none() {
            // Listeners for the mouse are such pictures.
            if heard && node.attribute("visibility") != Some("hidden") {
                self.listener.warn(node, "not drawn: it has no href".to_owned());
            }
            return;
        }
        for href in hrefs {
            self.edits.replace(href.range_value(), address.clone());
        }
        self.images.push(node);
    }

    /// The course's triangles become paths, which usvg brings to their places; how these are to be painted. What is wrong with one is told
    /// where it is painted.
    fn triangle(&mut self, node: Node<'doc, 'doc>) -> [(&'static str, String); 4] {
        let points = numbers::all("points", node.attribute("points").unwrap_or("")).unwrap_or_default();
        let number = self.elements.add_triangle(node);
        self.names.disguise(self.text, node, &points, &mut self.edits);
        own_triangles::look(number)
    }
}

/// Whether usvg makes something of elements of this name.
pub(crate) fn is_understood(name: &str) -> bool {
    UNDERSTOOD.contains(&name)
}

/// Whether a `switch` has something else to show than this.
fn is_fallen_back(node: Node<'_, '_>) -> bool {
    node.parent_element()
        .is_some_and(|parent| parent.tag_name().name() == "switch")
        && node.next_sibling_element().is_some()
}
