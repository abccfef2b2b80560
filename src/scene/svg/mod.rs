//! The dialect `svg`: SVG 1.1 and 2, as usvg reads them.
//!
//! ```text
//!     document -> check, references -> prepare -> usvg -> paint -> primitives
//!                 (what usvg would     (ids, own   (styles,
//!                  pass over or not     triangles,  units,
//!                  survive)             images)     text)
//! ```
//!
//! What is not drawn is reported.

mod affine;
mod cascade;
mod check;
mod circles;
mod clip;
mod elements;
mod fallback;
mod families;
mod fonts;
mod graph;
mod guarded;
mod left_out;
mod listener;
mod marked;
mod markers;
mod mended;
mod nonsense;
mod own_fonts;
mod own_triangles;
mod paint;
mod painter;
mod pictures;
mod prepare;
mod reach;
mod references;
mod rules;
mod server;
mod shapes;
mod sheets;
mod styles;
mod text_paths;
mod transforms;
mod values;
mod viewports;

use std::rc::Rc;
use std::sync::{Arc, Mutex, PoisonError};

use glam::DVec2;
use roxmltree::Node;
use usvg::fontdb::Database;

use self::painter::Painter;
use self::pictures::Loading;
use self::styles::Effects;
use super::build::Builder;
use super::error::Fault;
use super::{Problem, numbers};
use crate::memory::OutOfMemory;

pub(super) use prepare::is_understood;

pub use fonts::{Fonts, more_fonts, set_fonts};

/// Stack for documents that are as deep as they may be: usvg and what follows it recurse. Only what is used is taken.
const STACK: usize = 256 << 20;

/// Samples along the longer side of the canvas for which the edges of curves are fine enough from the start.
const FINE_FOR: f64 = 4096.0;

/// Reads everything below `root`, which was parsed from `text`, and answers with the canvas.
pub(super) fn read<'doc>(builder: &mut Builder<'doc>, root: Node<'doc, 'doc>, text: &str) -> Result<DVec2, Fault> {
    let thread = std::thread::Builder::new().name("svg".to_owned()).stack_size(STACK);
    std::thread::scope(|scope| {
        let reading = thread.spawn_scoped(scope, || read_here(builder, root, text));
        let megabytes = (STACK >> 20) as u64;
        let reading = reading.map_err(|_| Problem::from(OutOfMemory { megabytes }).nowhere())?;
        reading.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

fn read_here<'doc>(builder: &mut Builder<'doc>, root: Node<'doc, 'doc>, text: &str) -> Result<DVec2, Fault> {
    builder.tell_of_styles();
    let prepared = prepare::prepare(root, text, builder)?;
    references::check(root, &prepared.graph, builder)?;
    let letters = prepared.letters;
    let fonts = letters.map(|_| own_fonts::joined(fonts::database(), root, builder));
    let loading = Mutex::new(Loading::new(builder));
    let tree = loading_tree(&prepared, fonts, &loading);
    let Loading {
        builder,
        pictures,
        missing,
        ..
    } = loading.into_inner().unwrap_or_else(PoisonError::into_inner);
    let tree = tree
        .map_err(|problem| problem.at(builder.locate(root)))?
        .map_err(|error| explain(&error, builder, root))?;
    for message in missing.iter().filter_map(fonts::Missing::message) {
        builder.warn(letters.unwrap_or(root), message);
    }
    let canvas = DVec2::new(tree.size().width().into(), tree.size().height().into());
    warn_of_size(builder, root, canvas);
    let scale = FINE_FOR / canvas.max_element();
    let mut painter = Painter::new(builder, root, &prepared.elements, &pictures, scale);
    painter.effects = Rc::new(Effects::below(root));
    painter.markers = Rc::new(prepared.markers);
    painter.tree(&tree)?;
    Ok(canvas)
}

/// usvg's tree of a document.
fn loading_tree<'doc>(
    prepared: &prepare::Prepared<'doc>,
    fonts: Option<Arc<Database>>,
    loading: &Mutex<Loading<'_, 'doc>>,
) -> Result<Result<usvg::Tree, usvg::Error>, Problem> {
    let load = |address: &str| {
        let node = *prepared.images.get(prepared.elements.number(address)?)?;
        pictures::load(loading, node)
    };
    pictures::tree(&prepared.text, fonts, loading, load)
}

/// usvg's error in our words.
fn explain(error: &usvg::Error, builder: &Builder<'_>, root: Node<'_, '_>) -> Fault {
    let number = |name| numbers::leading(name, root.attribute(name).unwrap_or(""));
    let side = |name| f64::from(number(name).ok().flatten().unwrap_or(0.0));
    match error {
        usvg::Error::InvalidSize => Problem::Canvas {
            width: side("width"),
            height: side("height"),
        }
        .at(builder.locate(root)),
        usvg::Error::ElementsLimitReached | usvg::Error::ParsingFailed(roxmltree::Error::NodesLimitReached) => {
            let what = "elements, with those that are used again";
            let limit = prepare::MAX_ELEMENTS;
            Problem::TooMany { what, limit }.nowhere()
        }
        error => Problem::Xml(super::report::quote(&error.to_string())).nowhere(),
    }
}

/// Tells of a document without a size, which is as large as what is drawn.
fn warn_of_size(builder: &mut Builder<'_>, root: Node<'_, '_>, canvas: DVec2) {
    let understood = |name| {
        root.attribute(name)
            .map(str::trim)
            .filter(|value| values::is_understood(name, value))
    };
    let is_given = |name| understood(name).is_some_and(|side| !side.ends_with('%'));
    if understood("viewBox").is_some() || is_given("width") && is_given("height") {
        return;
    }
    let message = format!(
        "width, height or viewBox is missing; the canvas is {} x {}",
        canvas.x, canvas.y
    );
    builder.warn(root, message);
}
