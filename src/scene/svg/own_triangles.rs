//! The course's triangles among what usvg reads: paths whose paint is the triangle's number.
//!
//! usvg drops the ids of what `use`, a marker or another document shows, and keeps paints. So the number lies in the colour, and an
//! opacity that no document writes says that it is one.

use glam::{DAffine2, DVec2};
use roxmltree::Node;
use usvg::Path;

use crate::scene::build::Builder;
use crate::scene::document::{LineIndex, Source};
use crate::scene::edits::Edits;
use crate::scene::error::Fault;
use crate::scene::textures::{Alpha, TextureTable, is_data};
use crate::scene::triangles::{self, Element, TextureFiles};
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

/// Makes a path of a triangle in `text`, by its number and the numbers of its corners. There are fewer triangles than colours.
pub(super) fn disguise(text: &str, node: Node<'_, '_>, (number, points): (usize, &[f32]), edits: &mut Edits) {
    let name = node.tag_name().name();
    let range = node.range();
    let tag = &text.as_bytes()[range.start + 1..];
    let end = range.start + 1 + tag.iter().take_while(|byte| !b" \t\r\n/>".contains(byte)).count();
    edits.replace(end - name.len()..end, "path".to_owned());
    let closing = text[range.clone()].rfind("</").filter(|at| range.start + at >= end);
    if let Some(at) = closing.filter(|_| !text[range.clone()].ends_with("/>")) {
        let tag = range.start + at;
        let name_at = tag + text[tag..range.end].rfind(name).unwrap_or(2);
        edits.replace(name_at..name_at + name.len(), "path".to_owned());
    }
    // A path that is always painted: its own look is ours, everything around it is the document's.
    let place = match points.first_chunk::<6>() {
        Some([a, b, c, d, e, f]) => format!("M{a} {b}L{c} {d}L{e} {f}Z"),
        None => "M0 0L1 0L0 1Z".to_owned(),
    };
    for own in node.attributes().filter(|attribute| attribute.name() == "d") {
        edits.replace(own.range_qname(), "data-d".to_owned());
    }
    edits.insert(end, format!(" d=\"{place}\""));
    let look = format!(
        "fill:#{number:06x}!important;fill-opacity:{MARK}!important;stroke:none!important;marker:none!important;"
    );
    match node.attributes().find(|attribute| attribute.name() == "style") {
        Some(style) => edits.insert(style.range_value().start, look),
        None => edits.insert(end, format!(" style=\"{look}\"")),
    }
}

/// The triangles of a document inside an image, by their numbers; nothing where one is not drawn; and what is to be said of them.
/// As all that images show, it reads no other files: `load` gives textures whose pixels stand in their address.
pub(super) fn drawn<'doc>(
    source: &'doc Source<'doc>,
    nodes: &[Node<'doc, 'doc>],
    load: impl Fn(&str) -> Option<TextureId>,
) -> Result<(Vec<Option<Drawn>>, Report), Fault> {
    let Some(first) = nodes.first() else {
        return Ok((Vec::new(), Report::default()));
    };
    let files = TextureFiles::below(first.document().root_element());
    let lines = LineIndex::new("");
    let progress = Progress::default();
    let textures = TextureTable::new(&NoResources, Alpha::Keep);
    let mut builder = Builder::new(source, &lines, textures, &progress);
    let mut found = Vec::with_capacity(nodes.len());
    for &node in nodes {
        // What is painted belongs to the image.
        let (shape, to_user) = (ShapeId(0), DAffine2::IDENTITY);
        let element = Element { node, shape, to_user };
        if node.tag_name().name() == "colortri" {
            let colored = triangles::colored(&mut builder, element)?;
            found.push(colored.map(|(points, colors)| (points, Paint::Vertex(colors))));
            continue;
        }
        let address = files.of(node);
        let mapped = triangles::mapped(&mut builder, element)?.filter(|_| {
            let is_here = is_data(address);
            if !is_here {
                let message = "a textri is not drawn: documents in images read no other files".to_owned();
                builder.warn(node, message);
            }
            is_here
        });
        found.push(mapped.and_then(|(points, uv)| {
            let (texture, opacity) = (load(address)?, 1.0);
            Some((points, Paint::Texture { texture, uv, opacity }))
        }));
    }
    Ok((found, builder.report))
}
