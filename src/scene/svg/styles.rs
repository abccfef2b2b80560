//! Which elements an element refers to: by attributes, by its style, and by the document's style sheets.

use std::cell::Cell;
use std::collections::HashMap;

use roxmltree::{Node, NodeId};

use super::listener::Listener;
use super::rules::{self, Rules};
use super::{nonsense, sheets};
use crate::scene::error::Fault;
use crate::scene::{Problem, attributes};

/// Most bytes that may be passed over while styles are read, some seconds' worth.
const MAX_PASSED: u64 = 3_000_000_000;
/// How often a `style` attribute is read, here and by usvg; and how often a style sheet.
const READINGS: [u64; 2] = [7, 5];

/// How elements refer to each other. usvg looks for circles of one kind at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum By {
    Inside,
    Href,
    Clip,
    Mask,
    Fill,
    Stroke,
    /// By a marker at every corner.
    Marker,
    /// By a marker at one end of a path.
    EndMarker,
    Filter,
    /// By the picture of a filter.
    Picture,
    /// By a paint of what is around: usvg does not look for circles of these.
    Inherited,
}

/// The style sheets of one document, as far as they refer to elements.
#[derive(Debug, Default)]
pub(super) struct Styles<'doc> {
    rules: Rules<'doc, Vec<(By, &'doc str)>>,
}

impl<'doc> Styles<'doc> {
    /// Reads the style sheets below `root`, and refuses those that take too long to compare with all elements.
    pub(super) fn below<L: Listener>(root: Node<'doc, 'doc>, listener: &L) -> Result<Self, Fault> {
        let all = Rules::below(root);
        if all.is_empty() {
            return Ok(Self::default());
        }
        let steps = Cell::new(0);
        for node in root.descendants().filter(Node::is_element) {
            all.matching(node, &steps).for_each(drop);
            if let Some(problem) = rules::too_many(steps.get()) {
                return Err(listener.fault(problem, node, ""));
            }
        }
        let rules = all.filter_map(|declarations| {
            let references = declarations.iter().flat_map(|d| declared(d.name, d.value));
            Some(references.collect()).filter(|references: &Vec<_>| !references.is_empty())
        });
        Ok(Self { rules })
    }

    /// The ids that an element refers to, wherever that is said.
    pub(super) fn references(&self, node: Node<'doc, 'doc>) -> Vec<(By, &'doc str)> {
        let mut found = Vec::new();
        for attribute in node.attributes() {
            found.extend(declared(attribute.name(), attribute.value()));
        }
        if let Some(style) = node.attribute("style") {
            for declaration in simplecss::DeclarationTokenizer::from(style) {
                found.extend(declared(declaration.name, declaration.value));
            }
        }
        found.extend(self.rules.matching(node, &Cell::new(0)).flatten());
        let by = match node.tag_name().name() {
            "a" => return found,
            "feImage" => By::Picture,
            _ => By::Href,
        };
        let href = attributes::href(node).and_then(|href| href.trim().strip_prefix('#'));
        found.extend(href.map(|id| (by, id)));
        found
    }

    /// The paint servers that elements hand down to what is inside, by their numbers: fill and stroke.
    pub(super) fn inherited(&self, root: Node<'doc, 'doc>) -> HashMap<usize, [Option<&'doc str>; 2]> {
        let mut paints: HashMap<usize, [Option<&'doc str>; 2]> = HashMap::new();
        for node in root.descendants().filter(Node::is_element) {
            let around = node
                .parent_element()
                .and_then(|parent| paints.get(&parent.id().get_usize()));
            let mut own = around.copied().unwrap_or_default();
            for (paint, name) in own.iter_mut().zip(["fill", "stroke"]) {
                *paint = paint.filter(|_| !node.has_attribute(name));
            }
            for (by, id) in self.references(node) {
                match by {
                    By::Fill => own[0] = Some(id),
                    By::Stroke => own[1] = Some(id),
                    _ => {}
                }
            }
            if own.iter().any(Option::is_some) {
                paints.insert(node.id().get_usize(), own);
            }
        }
        paints
    }
}

/// Most styles of elements together that rules are written into, by what each [`costs`](cost).
pub(super) const MAX_COST: u64 = MAX_PASSED;

/// What it costs to write a style into an element and to have it read there, in bytes to pass over.
pub(super) fn cost(style: &str) -> u64 {
    /// Of each byte in memory.
    const OF_A_BYTE: u64 = 40;
    let memory = OF_A_BYTE.saturating_mul(style.len() as u64);
    passed_over(style).saturating_mul(READINGS[0]).saturating_add(memory)
}

/// What is wrong with styles that take too long to read.
pub(super) fn too_long() -> Problem {
    Problem::TooMuch {
        what: "steps of reading styles",
        limit: usize::try_from(MAX_PASSED).unwrap_or(usize::MAX),
        cure: "they grow with the square of a style's length: give long styles fewer declarations",
    }
}

/// Refuses styles that take too long to read: at the end of every value simplecss counts lines from the beginning of its
/// style, so that time grows with the square of a style's length; sheets are read in pieces where they can be cut in `text`.
pub(super) fn bounded<L: Listener>(root: Node<'_, '_>, text: &str, listener: &L) -> Result<(), Fault> {
    let mut passed = 0_u64;
    for node in root.descendants().filter(Node::is_element) {
        let sheet = (node.tag_name().name() == "style").then(|| node.text()).flatten();
        let style = node.attribute("style").unwrap_or("");
        passed = passed.saturating_add(passed_over(style).saturating_mul(READINGS[0]));
        let pieces: u64 = match sheet.map(|sheet| (sheet, sheets::cuts(text, node))) {
            Some((sheet, Some(_))) => {
                let pieces = sheets::pieces(sheet).into_iter();
                pieces.map(|piece| passed_over(&sheet[piece])).sum()
            }
            Some((sheet, None)) => passed_over(sheet),
            None => 0,
        };
        passed = passed.saturating_add(pieces.saturating_mul(READINGS[1]));
        if passed > MAX_PASSED {
            return Err(listener.fault(too_long(), node, "style"));
        }
    }
    Ok(())
}

/// The bytes before the ends of all values of a style together.
fn passed_over(style: &str) -> u64 {
    let marks = style.bytes().filter(|byte| matches!(byte, b':' | b';' | b'{' | b'}'));
    // On average half of the style lies before a value.
    (marks.count() as u64 / 2).saturating_mul(style.len() as u64) / 2
}

/// Elements that keep the width of their lines, whatever their transforms (`vector-effect: non-scaling-stroke`).
#[derive(Debug, Default)]
pub(super) struct Effects(HashMap<NodeId, bool>);

impl Effects {
    /// Those below `root`, in whose style sheets [`Styles::below`] found nothing wrong.
    pub(super) fn below(root: Node<'_, '_>) -> Self {
        let is_effect = |declaration: &&simplecss::Declaration<'_>| declaration.name == "vector-effect";
        let rules = Rules::below(root).filter_map(|declarations| Some(declarations.iter().rfind(is_effect)?.value));
        let steps = Cell::new(0);
        let mut effects = HashMap::new();
        for node in root.descendants().filter(Node::is_element) {
            let mut effect = node.attribute("vector-effect");
            effect = rules.matching(node, &steps).last().copied().or(effect);
            for declaration in simplecss::DeclarationTokenizer::from(node.attribute("style").unwrap_or("")) {
                if declaration.name == "vector-effect" {
                    effect = Some(declaration.value);
                }
            }
            if let Some(effect) = effect {
                effects.insert(node.id(), effect.trim() == "non-scaling-stroke");
            }
        }
        Self(effects)
    }

    /// Whether no element does.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether an element's line has the same width on the canvas, however large the element is shown.
    pub(super) fn is_non_scaling(&self, node: Node<'_, '_>) -> bool {
        self.0.get(&node.id()).is_some_and(|is| *is)
    }
}

/// The references in the value of a property; a value without a meaning has none.
fn declared<'v>(name: &str, value: &'v str) -> impl Iterator<Item = (By, &'v str)> + use<'v> {
    let by = match name {
        "clip-path" => Some(By::Clip),
        "mask" => Some(By::Mask),
        "fill" => Some(By::Fill),
        "stroke" => Some(By::Stroke),
        "marker" | "marker-mid" => Some(By::Marker),
        "marker-start" | "marker-end" => Some(By::EndMarker),
        "filter" => Some(By::Filter),
        _ => None,
    };
    let by = by.filter(|_| !value.contains("url(") || !nonsense::is_nonsense(name, value.trim()));
    by.into_iter().flat_map(move |by| {
        let parts = value.split("url(").skip(1);
        parts.filter_map(move |part| {
            let address = part.split(')').next()?.trim().trim_matches(['"', '\'']).trim();
            Some((by, address.strip_prefix('#')?))
        })
    })
}
