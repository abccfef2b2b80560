//! What is needed to paint one document, and where it is painted.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;
use std::sync::Arc;

use glam::DAffine2;
use roxmltree::Node;

use super::elements::Elements;
use super::markers::Markers;
use super::own_triangles::Drawn;
use super::pictures::Picture;
use super::styles::Effects;
use crate::color::Rgba;
use crate::scene::build::Builder;
use crate::scene::texture_files::TextureFiles;
use crate::scene::{GradientId, PatternId, Scene, ShapeId, SourceLocation};

/// Paints one document.
pub(super) struct Painter<'a, 'doc> {
    pub(super) builder: &'a mut Builder<'doc>,
    pub(super) root: Node<'doc, 'doc>,
    pub(super) elements: &'a Elements<'doc>,
    pub(super) pictures: &'a [Picture],
    pub(super) effects: Rc<Effects>,
    pub(super) markers: Rc<Markers<'doc>>,
    /// Samples per canvas unit for which edges of curves are fine enough.
    pub(super) scale: f64,
    pub(super) servers: Servers,
    pub(super) texture_files: TextureFiles<'doc>,
    /// Inside an image that is a document.
    pub(super) inside: Option<Inside<'a>>,
    /// The `use` elements that are being shown, innermost last.
    pub(super) used: Vec<Used<'doc>>,
    /// The path that is being painted.
    pub(super) painting: Option<Node<'doc, 'doc>>,
    /// The shapes of elements that have one.
    pub(super) known: HashMap<roxmltree::NodeId, ShapeId>,
    /// Triangles of the course of which everything is told.
    pub(super) told: HashSet<roxmltree::NodeId>,
}

/// An image that is a document.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inside<'a> {
    /// Everything belongs to it.
    pub(super) image: ShapeId,
    /// The document's own triangles, by their numbers.
    pub(super) triangles: &'a [Option<Drawn>],
}

/// Where something is painted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) to_user: DAffine2,
    /// Whose it is where nothing else is said.
    pub(super) shape: ShapeId,
    /// Multiplies the opacity of what is painted.
    pub(super) opacity: f32,
}

/// A `use` that is being shown.
#[derive(Debug)]
pub(super) struct Used<'doc> {
    pub(super) location: SourceLocation,
    /// What it shows and has not yet been met, the next one last; nothing where that cannot be told.
    pub(super) left: Vec<Node<'doc, 'doc>>,
}

/// What tells paint servers apart: the one of usvg's, its opacity, and how it lies.
pub(super) type Key = (usize, u32, [u64; 6]);

/// The paint servers of one scene, by what they are made from.
#[derive(Debug, Default)]
pub(super) struct Servers {
    pub(super) gradients: HashMap<Key, Option<GradientId>>,
    pub(super) patterns: HashMap<Key, Option<PatternId>>,
    pub(super) tiles: HashMap<(usize, u64), Option<Arc<Scene>>>,
    /// Ids of gradients in the document by what they show: usvg gives the copies that it makes for boxes other ids.
    pub(super) names: HashMap<Vec<u32>, String>,
}

impl<'a, 'doc> Painter<'a, 'doc> {
    pub(super) fn new(
        builder: &'a mut Builder<'doc>,
        root: Node<'doc, 'doc>,
        elements: &'a Elements<'doc>,
        pictures: &'a [Picture],
        scale: f64,
    ) -> Self {
        Self {
            builder,
            root,
            elements,
            pictures,
            effects: Rc::default(),
            markers: Rc::default(),
            scale,
            servers: Servers::default(),
            texture_files: TextureFiles::below(root),
            inside: None,
            used: Vec::new(),
            painting: None,
            known: HashMap::new(),
            told: HashSet::new(),
        }
    }
}

impl std::fmt::Debug for Painter<'_, '_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Painter").finish_non_exhaustive()
    }
}

/// usvg's colour with an opacity.
pub(super) fn color(color: usvg::Color, opacity: f32) -> Rgba {
    Rgba::from_bytes([color.red, color.green, color.blue, u8::MAX]).faded(opacity)
}
