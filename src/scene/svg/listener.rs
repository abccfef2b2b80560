//! Who hears of what is not drawn: the report of the scene, or that of a document around this one.

use roxmltree::Node;

use crate::scene::build::Builder;
use crate::scene::error::Fault;
use crate::scene::{Problem, SkippedKind};

/// Who hears of what is not drawn.
pub(super) trait Listener {
    /// An element, or an attribute, without effect.
    fn skip(&mut self, kind: SkippedKind, name: &str, node: Node<'_, '_>);
    /// Something that is read differently from what the document says.
    fn warn(&mut self, node: Node<'_, '_>, message: String);
    /// The same of what stands in an element, at byte `at` of the text that was parsed.
    fn warn_at(&mut self, at: usize, node: Node<'_, '_>, message: String);
    /// A problem of an element or its attribute.
    fn fault(&self, problem: Problem, node: Node<'_, '_>, attribute: &str) -> Fault;
}

impl Listener for Builder<'_> {
    fn skip(&mut self, kind: SkippedKind, name: &str, node: Node<'_, '_>) {
        Builder::skip(self, kind, name, node);
    }

    fn warn(&mut self, node: Node<'_, '_>, message: String) {
        Builder::warn(self, node, message);
    }

    fn warn_at(&mut self, at: usize, _node: Node<'_, '_>, message: String) {
        Builder::warn_at(self, at, message);
    }

    fn fault(&self, problem: Problem, node: Node<'_, '_>, attribute: &str) -> Fault {
        problem.at(self.locate_attribute(node, attribute))
    }
}
