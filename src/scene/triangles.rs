//! The course's own triangles, which both dialects draw: `colortri` and `textri`.

use glam::{DAffine2, DVec2, Vec2};
use roxmltree::Node;

use super::build::Builder;
use super::error::Fault;
use super::texture_files::TextureFiles;
use super::{Paint, ShapeId, SkippedKind, numbers};
use crate::color::Rgba;

/// What no dialect draws of a triangle.
pub(super) const ALPHA: &str = "alpha in colors";

/// An element on its way to primitives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element<'doc> {
    pub(super) node: Node<'doc, 'doc>,
    pub(super) shape: ShapeId,
    pub(super) to_user: DAffine2,
}

/// Three corners in user space, and what each has.
pub(super) type Corners<T> = ([DVec2; 3], [T; 3]);

/// A triangle with a colour at each corner.
pub(super) fn colortri(builder: &mut Builder<'_>, element: Element<'_>, opacity: f32) -> Result<(), Fault> {
    let Some((points, colors)) = colored(builder, element) else {
        return Ok(());
    };
    let paint = Paint::Vertex(colors.map(|color| color.faded(opacity)));
    builder.triangle(element.shape, points, paint)
}

/// Its corners and their colours; nothing where it is not drawn.
pub(super) fn colored(builder: &mut Builder<'_>, element: Element<'_>) -> Option<Corners<Rgba>> {
    // Both are looked at, so that all that is wrong is told.
    let colors = corner_colors(builder, element.node);
    corners(builder, element).zip(colors)
}

/// A triangle with a texture coordinate at each corner.
pub(super) fn textri<'doc>(
    builder: &mut Builder<'doc>,
    element: Element<'doc>,
    files: &TextureFiles<'doc>,
    opacity: f32,
) -> Result<(), Fault> {
    let Some((points, uv)) = mapped(builder, element) else {
        return Ok(());
    };
    let texid = element.node.attribute("texid").unwrap_or("");
    let location = builder.locate(element.node);
    let texture = match files.file(texid) {
        Some(file) => builder.textures.request(file, location),
        None => builder
            .textures
            .undefined(texid, location, || files.trouble(element.node)),
    };
    builder.triangle(element.shape, points, Paint::Texture { texture, uv, opacity })
}

/// Its corners and where they lie in the texture; nothing where it is not drawn.
pub(super) fn mapped(builder: &mut Builder<'_>, element: Element<'_>) -> Option<Corners<Vec2>> {
    let uv = corner_uvs(builder, element.node);
    corners(builder, element).zip(uv)
}

/// All numbers of an attribute; none if it is missing.
pub(super) fn numbers(builder: &Builder<'_>, node: Node<'_, '_>, name: &str) -> Result<Vec<f32>, Fault> {
    let text = node.attribute(name).unwrap_or("");
    numbers::all(name, text).map_err(|problem| problem.at(builder.locate_attribute(node, name)))
}

/// The first `N` numbers of an attribute, or a warning that there are fewer; another where there are more than `most`.
fn first<const N: usize>(builder: &mut Builder<'_>, node: Node<'_, '_>, name: &str, most: usize) -> Option<[f32; N]> {
    let numbers = match numbers::all(name, node.attribute(name).unwrap_or("")) {
        Ok(numbers) => numbers,
        Err(problem) => {
            let place = builder.locate_attribute(node, name);
            builder.report.warn(place, format!("not drawn: {problem}"));
            return None;
        }
    };
    let first = numbers.first_chunk::<N>().copied();
    let count = numbers.len();
    if first.is_none() {
        builder.warn(node, format!("not drawn: {name} holds {count} numbers, not {N}"));
    } else if count > most {
        builder.warn(
            node,
            format!("{name} holds {count} numbers; those after the first {most} have no effect"),
        );
    }
    first
}

/// Three `x y` in `points`, in user space.
fn corners(builder: &mut Builder<'_>, element: Element<'_>) -> Option<[DVec2; 3]> {
    let numbers = first::<6>(builder, element.node, "points", 6)?;
    let corner = |n: [f32; 6], i: usize| {
        element
            .to_user
            .transform_point2(DVec2::new(n[i].into(), n[i + 1].into()))
    };
    Some([0, 2, 4].map(|i| corner(numbers, i)))
}

/// Three `r g b a` in `colors`; the opacity means nothing, and the last one may be missing.
fn corner_colors(builder: &mut Builder<'_>, node: Node<'_, '_>) -> Option<[Rgba; 3]> {
    let n = first::<11>(builder, node, "colors", 12)?;
    let all = numbers::all("colors", node.attribute("colors").unwrap_or("")).unwrap_or_default();
    let last = all.get(11).copied().unwrap_or(1.0);
    if [n[3], n[7], last].into_iter().any(|alpha| alpha < 1.0) {
        builder.skip(SkippedKind::Attribute, ALPHA, node);
    }
    let unit = |channel: f32| channel.clamp(0.0, 1.0);
    Some([0, 4, 8].map(|i| Rgba::opaque(unit(n[i]), unit(n[i + 1]), unit(n[i + 2]))))
}

/// Three `u v` in `uvs`.
fn corner_uvs(builder: &mut Builder<'_>, node: Node<'_, '_>) -> Option<[Vec2; 3]> {
    let n = first::<6>(builder, node, "uvs", 6)?;
    Some([0, 2, 4].map(|i| Vec2::new(n[i], n[i + 1])))
}
