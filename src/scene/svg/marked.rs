//! Attributes for usvg by which it finds the elements that selectors of its own do not: the root, and elements one of whose
//! attributes begins, ends or holds something. Our own readers of styles ask `Counted` instead.

use roxmltree::Node;
use simplecss::AttributeOperator;

use crate::scene::edits::Edits;
use crate::scene::selectors::{Comparison, Part, ROOT, comparisons};

/// The attribute with the numbers of all comparisons that hold.
const HOLDS: &str = "_s_";

/// The comparisons with parts of attributes that a document's style sheets make.
#[derive(Debug)]
pub(super) struct Marks<'t>(Vec<Comparison<'t>>);

impl<'t> Marks<'t> {
    /// Those of the document `text`, in which each asks from now on for its number.
    pub(super) fn of(text: &'t str, edits: &mut Edits) -> Self {
        let found = comparisons(text);
        for (number, comparison) in found.iter().enumerate() {
            edits.replace(comparison.place.clone(), format!("[{HOLDS}~=\"{number}\"]"));
        }
        Self(found)
    }

    /// Gives an element, the name in whose tag ends at `name_end`, its mark.
    pub(super) fn put(&self, node: Node<'_, '_>, name_end: usize, edits: &mut Edits) {
        if node.parent_element().is_none() {
            edits.insert(name_end, format!(" {ROOT}=\"\""));
        }
        let holding = self.0.iter().enumerate().filter(|(_, comparison)| {
            let value = node.attribute(comparison.name);
            value.is_some_and(|value| comparison.part.is_in(value, comparison.wanted))
        });
        let numbers: Vec<String> = holding.map(|(number, _)| number.to_string()).collect();
        if !numbers.is_empty() {
            edits.insert(name_end, format!(" {HOLDS}=\"{}\"", numbers.join(" ")));
        }
    }
}

/// Whether an element has an attribute as a selector asks for it.
pub(super) fn attribute_matches(node: Node<'_, '_>, name: &str, operator: AttributeOperator<'_>) -> bool {
    if name == ROOT {
        return node.parent_element().is_none();
    }
    if let Some(value) = node.attribute(name) {
        return operator.matches(value);
    }
    let AttributeOperator::Matches(wanted) = operator else {
        return false;
    };
    let found = Part::of(name).and_then(|(name, part)| Some((node.attribute(name)?, part)));
    found.is_some_and(|(value, part)| part.is_in(value, wanted))
}
