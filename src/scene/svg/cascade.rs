//! What styles say of an element that usvg would not take from them, written where it takes it from: important declarations,
//! lengths of shapes, transforms as CSS writes them, white space that is kept, filters that are not there.
//!
//! Of important declarations the last counts, as of all others (CSS Cascading 4, section 6.1); to usvg it is the first. So the
//! words `!important` go, and what wins by them stands at the end of the element's own style, which wins over all.
//!
//! usvg compares each element with each rule. Where that would take long, what rules say of an element is written into its own style,
//! before what is there, and usvg reads no style sheets: the same wins as before.

use std::borrow::Cow;
use std::cell::Cell;
use std::ops::Range;

use roxmltree::{Attribute, NS_XML_URI, Node};
use simplecss::{Declaration, DeclarationTokenizer};

use super::elements::Elements;
use super::graph::Circular;
use super::rules::{self, Rules};
use super::{nonsense, styles, transforms, values};
use crate::scene::Problem;
use crate::scene::edits::{Edits, escaped};

/// The largest length that is taken over, in user units.
const FAR: f64 = 1e7;

/// Most comparisons of elements with rules that usvg is left with.
const MAX_COMPARISONS: usize = 10_000_000;

/// Which properties say how long and where a shape is (SVG 2, section 7.9).
const GEOMETRY: [(&str, &[&str]); 6] = [
    ("svg", &["x", "y", "width", "height"]),
    ("use", &["x", "y", "width", "height"]),
    ("rect", &["x", "y", "width", "height", "rx", "ry"]),
    ("circle", &["cx", "cy", "r"]),
    ("ellipse", &["cx", "cy", "rx", "ry"]),
    ("image", &["x", "y", "width", "height"]),
];

/// The rules of a document's style sheets, as far as they are of interest here, the weightiest last.
#[derive(Debug, Default)]
pub(super) struct Cascade<'doc> {
    rules: Rules<'doc, Vec<Declaration<'doc>>>,
    /// How often elements were compared with them.
    steps: Cell<u64>,
    /// Whether the rules are all, and written into the styles of elements.
    pub(super) is_written: bool,
    /// What that costs so far.
    cost: Cell<u64>,
}

/// What styles say of one element, and usvg would not know.
#[derive(Debug, Default)]
pub(super) struct Styled<'doc> {
    /// What rules say, where usvg does not read it from them.
    rules: String,
    /// Names and values, which win over all others.
    style: Vec<(&'doc str, String)>,
    /// Lengths of the shape.
    geometry: Vec<(&'static str, Cow<'doc, str>)>,
    /// The transform, as attributes have it.
    pub(super) transform: Option<String>,
    /// Whether white space is kept, as `xml:space` has it.
    space: Option<&'static str>,
    /// What is to be said of references that lead in circles.
    pub(super) circles: Vec<String>,
    /// What of the rules it has no effect.
    pub(super) in_vain: Vec<Declaration<'doc>>,
}

impl<'doc> Cascade<'doc> {
    /// Of the style sheets below `root`, in whose document references may lead in circles.
    pub(super) fn below(root: Node<'doc, 'doc>, has_circles: bool) -> Self {
        let all = Rules::below(root);
        let mut elements = root.descendants().filter(Node::is_element);
        let is_written = !all.is_empty() && (has_circles || elements.nth(MAX_COMPARISONS / all.len()).is_some());
        let of_interest = |mut declarations: Vec<Declaration<'doc>>| {
            declarations.retain(|found| is_of_interest(found) || is_in_vain(found));
            Some(declarations).filter(|left| !left.is_empty())
        };
        Self {
            rules: if is_written { all } else { all.filter_map(of_interest) },
            is_written,
            ..Self::default()
        }
    }

    /// What is wrong where all of this takes too long.
    pub(super) fn excess(&self) -> Option<Problem> {
        let is_too_long = self.cost.get() > styles::MAX_COST;
        rules::too_many(self.steps.get()).or_else(|| is_too_long.then(styles::too_long))
    }

    /// What styles say of `node`; `elements` are those of the document, and `circular` its references that lead in circles.
    pub(super) fn styled(
        &self,
        node: Node<'doc, 'doc>,
        elements: &Elements<'doc>,
        circular: &[Circular<'doc>],
    ) -> Styled<'doc> {
        let mut styled = Styled {
            space: node.attribute("white-space").and_then(values::space),
            ..Styled::default()
        };
        if self.rules.is_empty() && !node.has_attribute("style") && circular.is_empty() {
            return styled;
        }
        let matching = self.rules.matching(node, &self.steps);
        let mut found: Vec<Declaration<'doc>> = matching.flatten().copied().collect();
        if self.is_written {
            styled.rules = in_one_style(&found);
            self.cost
                .set(self.cost.get().saturating_add(styles::cost(&styled.rules)));
        }
        styled.in_vain.extend(found.iter().filter(|found| is_in_vain(found)));
        let style = DeclarationTokenizer::from(node.attribute("style").unwrap_or(""));
        found.extend(style);
        found.retain(|found| !nonsense::is_nonsense(found.name, found.value));
        let circles = open_circles(node, &found, circular);
        found.retain(is_of_interest);
        let mut names: Vec<&str> = found.iter().map(|declaration| declaration.name).collect();
        names.sort_unstable();
        names.dedup();
        for name in names {
            if let Some(winner) = winner(&found, name) {
                styled.take(node, winner, elements);
            }
        }
        for (name, instead, message) in circles {
            styled.style.push((name, instead));
            styled.circles.push(message);
        }
        styled
    }
}

/// The declaration of a property that counts: the last one that is important, or else the last.
fn winner<'f, 'doc>(found: &'f [Declaration<'doc>], name: &str) -> Option<&'f Declaration<'doc>> {
    let mut own = found.iter().filter(|declaration| declaration.name == name);
    let important = own.clone().rfind(|declaration| declaration.important);
    important.or_else(|| own.next_back())
}

/// The properties of an element whose references lead in circles: what is taken instead, which wins over all, and what is to be said.
/// Without another paint behind it a reference is none.
fn open_circles<'doc>(
    node: Node<'doc, 'doc>,
    found: &[Declaration<'doc>],
    circular: &[Circular<'doc>],
) -> Vec<(&'static str, String, String)> {
    let mut opened: Vec<(&str, String, String)> = Vec::new();
    for circular in circular {
        for (name, is_around) in circular.properties() {
            let declared = winner(found, name).map(|declaration| declaration.value);
            let value = declared.or_else(|| node.attribute(name));
            let is_so = value.map_or(is_around, |value| circular.is_in(value));
            if !is_so || opened.iter().any(|(other, ..)| *other == name) {
                continue;
            }
            let behind = value.and_then(|value| value.split_once(')'));
            let instead = behind.filter(|_| matches!(name, "fill" | "stroke"));
            let instead = instead.map_or("", |(_, instead)| instead.trim());
            let paint = if instead.is_empty() { "none" } else { instead };
            opened.push((name, paint.to_owned(), circular.told(name, instead)));
        }
    }
    opened
}

impl<'doc> Styled<'doc> {
    /// Takes over what wins of one property.
    fn take(&mut self, node: Node<'doc, 'doc>, winner: &Declaration<'doc>, elements: &Elements<'doc>) {
        let Declaration { name, value, important } = *winner;
        if name == "transform" {
            self.transform = transforms::plain(value);
            if let Some(plain) = self.transform.as_ref().filter(|plain| important || *plain != value) {
                self.style.push((name, plain.clone()));
                return;
            }
        }
        if name == "white-space" {
            self.space = values::space(value);
        }
        if name == "filter" && is_missing(value, elements) {
            self.style.push((name, "none".to_owned()));
            return;
        }
        if let Some(own) = lengths_of(node).iter().find(|own| **own == name) {
            self.geometry
                .extend(is_taken(value).then_some((*own, Cow::Borrowed(value))));
        } else if important {
            self.style.push((name, value.to_owned()));
        }
    }

    /// Whether a length of the shape is taken from its styles.
    pub(super) fn has_length(&self, name: &str) -> bool {
        self.geometry.iter().any(|(own, _)| *own == name)
    }

    /// What counts for a length of `node`: what its styles say, or its attribute.
    pub(super) fn length(&self, node: Node<'doc, 'doc>, name: &str) -> Option<&str> {
        let own = self.geometry.iter().find(|(own, _)| *own == name);
        own.map(|(_, value)| value.as_ref()).or_else(|| node.attribute(name))
    }

    /// Has `value` for a length, whatever the document says.
    pub(super) fn set_length(&mut self, name: &'static str, value: String) {
        self.geometry.retain(|(own, _)| *own != name);
        self.geometry.push((name, Cow::Owned(value)));
    }

    /// Has the element painted so: its own look is ours, everything around it is the document's.
    pub(super) fn paint(&mut self, look: impl IntoIterator<Item = (&'doc str, String)>) {
        self.style.extend(look);
    }

    /// Has the element not drawn, with all that is inside.
    pub(super) fn hide(&mut self) {
        self.style.push(("display", "none".to_owned()));
    }

    /// Writes what rules say before all that an element's own style in `text` says, if it has one.
    pub(super) fn write_rules(&self, node: Node<'_, '_>, edits: &mut Edits) {
        let style = node.attributes().find(|attribute| attribute.name() == "style");
        if let Some(style) = style.filter(|_| !self.rules.is_empty()) {
            edits.insert(style.range_value().start, self.rules.clone());
        }
    }

    /// Writes the rest into `text`, in which the name in the element's tag ends at `name_end`.
    pub(super) fn write(&self, text: &str, node: Node<'_, '_>, name_end: usize, edits: &mut Edits) {
        if let Some(style) = node.attributes().find(|attribute| attribute.name() == "style") {
            for mark in marks(text, style.range_value()) {
                edits.replace(mark.clone(), " ".repeat(mark.len()));
            }
        }
        for (name, value) in &self.geometry {
            let there = node.attributes().find(|attribute| attribute.name() == *name);
            match there {
                Some(there) => edits.replace(there.range_value(), escaped(value)),
                None => edits.insert(name_end, format!(" {name}=\"{}\"", escaped(value))),
            }
        }
        if let Some(space) = self.space {
            let is_own = |own: &Attribute<'_, '_>| own.name() == "space" && own.namespace() == Some(NS_XML_URI);
            match node.attributes().find(is_own) {
                Some(own) => edits.replace(own.range_value(), space.to_owned()),
                None => edits.insert(name_end, format!(" xml:space=\"{space}\"")),
            }
        }
        let declarations = self.style.iter();
        let declarations = declarations.map(|(name, value)| format!("{name}:{}", escaped(value)));
        let mut declarations = declarations.collect::<Vec<_>>().join(";");
        let style = node.attributes().find(|attribute| attribute.name() == "style");
        if style.is_none() {
            declarations.insert_str(0, &self.rules);
        }
        if declarations.is_empty() {
            return;
        }
        match style {
            // A style without anything may not begin with a semicolon.
            Some(style) if style.value().trim().is_empty() => edits.replace(style.range_value(), declarations),
            Some(style) => edits.insert(style.range_value().end, format!(";{declarations}")),
            None => edits.insert(name_end, format!(" style=\"{declarations}\"")),
        }
    }
}

/// Declarations of rules as they stand in an attribute, each with its semicolon; those that usvg would take for others are not there.
fn in_one_style(declarations: &[Declaration<'_>]) -> String {
    let understood = declarations
        .iter()
        .filter(|found| !nonsense::is_nonsense(found.name, found.value));
    understood.fold(String::new(), |all, Declaration { name, value, .. }| {
        let value = values::without_profile(value);
        all + name + ":" + &escaped(value) + ";"
    })
}

/// Has usvg pass over a style sheet, the name in whose tag ends at `name_end`.
pub(super) fn hide_sheet(sheet: Node<'_, '_>, name_end: usize, edits: &mut Edits) {
    /// A type that usvg does not read.
    const UNREAD: &str = "unread";
    match sheet.attributes().find(|attribute| attribute.name() == "type") {
        Some(kind) => edits.replace(kind.range_value(), UNREAD.to_owned()),
        None => edits.insert(name_end, format!(" type=\"{UNREAD}\"")),
    }
}

/// Takes the words `!important` out of a style sheet.
pub(super) fn unmark_sheet(text: &str, sheet: Node<'_, '_>, edits: &mut Edits) {
    for part in sheet.children().filter(Node::is_text) {
        for mark in marks(text, part.range()) {
            edits.replace(mark.clone(), " ".repeat(mark.len()));
        }
    }
}

/// Where the words `!important` stand in a part of `text`.
fn marks(text: &str, part: Range<usize>) -> Vec<Range<usize>> {
    let style = text.get(part.clone()).unwrap_or("");
    let signs = style.match_indices('!');
    let marks = signs.filter_map(|(at, _)| {
        let after = style[at + 1..].trim_start();
        let end = style.len() - after.strip_prefix("important")?.len();
        Some(part.start + at..part.start + end)
    });
    marks.collect()
}

/// The lengths that styles may give a shape; those of the root are the page's, which no picture has around it.
fn lengths_of(node: Node<'_, '_>) -> &'static [&'static str] {
    if node.parent_element().is_none() {
        return &[];
    }
    let shape = GEOMETRY.iter().find(|(shape, _)| *shape == node.tag_name().name());
    shape.map_or(&[], |(_, lengths)| lengths)
}

/// Whether usvg may take it otherwise than CSS means it.
fn is_of_interest(declaration: &Declaration<'_>) -> bool {
    let Declaration { name, important, .. } = *declaration;
    let is_length = || GEOMETRY.iter().any(|(_, lengths)| lengths.contains(&name));
    important || matches!(name, "transform" | "filter" | "white-space") || is_length()
}

/// Whether a declaration of a rule has a value without meaning; what [`nonsense`] hides is told where it stands.
fn is_in_vain(declaration: &Declaration<'_>) -> bool {
    let Declaration { name, value, .. } = *declaration;
    match name {
        _ if nonsense::is_nonsense(name, value) => false,
        // Those of the root are told.
        "background" | "background-color" => true,
        "transform" => transforms::plain(value).is_none(),
        _ => values::is_without_effect(name, value) || !values::is_understood(name, value),
    }
}

/// Whether a length in a style is one that an attribute can hold.
fn is_taken(value: &str) -> bool {
    let length = value.parse::<svgtypes::Length>();
    value == "auto" || length.is_ok_and(|length| length.number.abs() <= FAR)
}

/// Whether a filter is referred to that the document does not have.
pub(super) fn is_missing(value: &str, elements: &Elements<'_>) -> bool {
    let is_filter = |id| elements.own(id).is_some_and(|node| node.tag_name().name() == "filter");
    values::reference(value).is_some_and(|id| !is_filter(id))
}
