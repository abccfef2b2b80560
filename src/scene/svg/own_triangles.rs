//! The course's triangles among what usvg reads: paths whose paint is the triangle's number.
//!
//! Style sheets may select triangles by their names, or paths by theirs. Then triangles are elements that are drawn as paths are and
//! that no sheet selects, and selectors of theirs have that name.
//!
//! usvg drops the ids of what `use`, a marker or another document shows, and keeps paints. So the number lies in the colour, and an
//! opacity that no document writes says that it is one.

use std::collections::HashMap;

use glam::{DAffine2, DVec2};
use roxmltree::Node;
use usvg::Path;

use crate::scene::build::Builder;
use crate::scene::document::{LineIndex, Source};
use crate::scene::edits::Edits;
use crate::scene::selectors;
use crate::scene::texture_files::TextureFiles;
use crate::scene::textures::{Alpha, TextureTable, is_data};
use crate::scene::triangles::{self, Element};
use crate::scene::{NoResources, Paint, Progress, Report, ShapeId, TextureId};

/// The opacity of paints that are numbers: one of 2^23 between a half and one.
const MARK: f32 = 0.739_085_14;

/// A triangle in its own coordinates.
pub(super) type Drawn = ([DVec2; 3], Paint);

/// Whether this is a triangle of the course.
pub(super) fn is_one(node: Node<'_, '_>) -> bool {
    matches!(node.tag_name().name(), "colortri" | "textri")
}

/// The number of the triangle that a path of usvg's stands for.
pub(super) fn number(path: &Path) -> Option<usize> {
    let fill = path
        .fill()
        .filter(|fill| fill.opacity().get().to_bits() == MARK.to_bits())?;
    let usvg::Paint::Color(usvg::Color { red, green, blue }) = fill.paint() else {
        return None;
    };
    usize::try_from(u32::from_be_bytes([0, *red, *green, *blue])).ok()
}

/// What paints the path of the triangle with this number, whatever else is said of it.
pub(super) fn look(number: usize) -> [(&'static str, String); 4] {
    [
        ("fill", format!("#{number:06x}!important")),
        ("fill-opacity", format!("{MARK}!important")),
        ("stroke", "none!important".to_owned()),
        ("marker", "none!important".to_owned()),
    ]
}

/// The names of elements that three corners can be drawn by.
const SHAPES: [&str; 3] = ["path", "polygon", "polyline"];

/// What triangles are called for usvg.
#[derive(Clone, Copy, Debug)]
pub(super) struct Names {
    colortri: &'static str,
    textri: &'static str,
    /// Whether style sheets tell them from all else.
    pub(super) are_apart: bool,
}

impl Names {
    /// Those in the document `text`, whose style sheets select by them from now on.
    pub(super) fn of(text: &str, edits: &mut Edits) -> Self {
        let mut names = Self {
            colortri: SHAPES[0],
            textri: SHAPES[0],
            are_apart: true,
        };
        if !text.contains("style") || !["colortri", "textri"].into_iter().any(|name| text.contains(name)) {
            return names;
        }
        let selected = selectors::names(text);
        let is_selected = |name: &str| selected.iter().any(|range| text[range.clone()] == *name);
        let mut free = SHAPES.into_iter().filter(|shape| !is_selected(shape));
        let first = free.next();
        let is_one_kind = !text.contains("colortri") || !text.contains("textri");
        let second = if !is_one_kind && (is_selected("colortri") || is_selected("textri")) {
            free.next()
        } else {
            first
        };
        names.are_apart = second.is_some();
        names.colortri = first.unwrap_or(SHAPES[0]);
        names.textri = second.unwrap_or(names.colortri);
        for range in selected {
            if let Some(name) = names.get(&text[range.clone()]) {
                edits.replace(range, name.to_owned());
            }
        }
        names
    }

    /// The name for an element of this one, if it is a triangle.
    fn get(self, name: &str) -> Option<&'static str> {
        match name {
            "colortri" => Some(self.colortri),
            "textri" => Some(self.textri),
            _ => None,
        }
    }

    /// Makes such an element of a triangle in `text`, by the numbers of its corners; its style is to have its [`look`]. There are
    /// fewer triangles than colours.
    pub(super) fn disguise(self, text: &str, node: Node<'_, '_>, points: &[f32], edits: &mut Edits) {
        let name = node.tag_name().name();
        let other = self.get(name).unwrap_or(SHAPES[0]);
        let range = node.range();
        let tag = &text.as_bytes()[range.start + 1..];
        let end = range.start + 1 + tag.iter().take_while(|byte| !b" \t\r\n/>".contains(byte)).count();
        edits.replace(end - name.len()..end, other.to_owned());
        let closing = text[range.clone()].rfind("</").filter(|at| range.start + at >= end);
        if let Some(at) = closing.filter(|_| !text[range.clone()].ends_with("/>")) {
            let tag = range.start + at;
            let name_at = tag + text[tag..range.end].rfind(name).unwrap_or(2);
            edits.replace(name_at..name_at + name.len(), other.to_owned());
        }
        let [a, b, c, d, e, f] = points.first_chunk::<6>().unwrap_or(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
        let (attribute, place) = match other {
            "path" => ("d", format!("M{a} {b}L{c} {d}L{e} {f}Z")),
            _ => ("points", format!("{a} {b} {c} {d} {e} {f}")),
        };
        for own in node.attributes().filter(|own| own.name() == attribute) {
            edits.replace(own.range(), String::new());
        }
        edits.insert(end, format!(" {attribute}=\"{place}\""));
    }
}

/// The triangles of a document inside an image, by their numbers; nothing where one is not drawn; and what is to be said of them.
/// As all that images show, it reads no other files: `load` gives textures whose pixels stand in their address.
pub(super) fn drawn<'doc>(
    source: &'doc Source<'doc>,
    nodes: &[Node<'doc, 'doc>],
    load: impl Fn(&str) -> TextureId,
) -> (Vec<Option<Drawn>>, Report) {
    let Some(first) = nodes.first() else {
        return (Vec::new(), Report::default());
    };
    let files = TextureFiles::below(first.document().root_element());
    let lines = LineIndex::new("");
    let progress = Progress::default();
    let textures = TextureTable::new(&NoResources, Alpha::Keep);
    let mut builder = Builder::new(source, &lines, textures, &progress);
    let mut textures_by_name = HashMap::new();
    let mut found = Vec::with_capacity(nodes.len());
    for &node in nodes {
        // What is painted belongs to the image.
        let (shape, to_user) = (ShapeId(0), DAffine2::IDENTITY);
        let element = Element { node, shape, to_user };
        if node.tag_name().name() == "colortri" {
            let colored = triangles::colored(&mut builder, element);
            found.push(colored.map(|(points, colors)| (points, Paint::Vertex(colors))));
            continue;
        }
        let mapped = triangles::mapped(&mut builder, element);
        found.push(mapped.and_then(|(points, uv)| {
            let name = node.attribute("texid").unwrap_or("");
            let address = files.file(name);
            // Addresses with their pixels are long, and many triangles share one.
            let texture = textures_by_name.entry(name);
            let texture = *texture.or_insert_with(|| address.filter(|address| is_data(address)).map(&load));
            if texture.is_none() {
                let why = match address {
                    Some(_) => "documents in images read no other files".to_owned(),
                    None => files.trouble(node),
                };
                builder.warn(node, format!("a textri is not drawn: {why}"));
            }
            let (texture, opacity) = (texture?, 1.0);
            Some((points, Paint::Texture { texture, uv, opacity }))
        }));
    }
    (found, builder.report)
}
