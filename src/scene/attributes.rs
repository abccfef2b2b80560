//! What both dialects read alike: the course's own triangles, texture addresses, elements that mean no picture.

use glam::{DVec2, Vec2};
use roxmltree::Node;

use super::build::Builder;
use super::error::Fault;
use super::textures::Alpha;
use super::{TextureId, numbers};
use crate::color::Rgba;

/// The namespace of SVG.
const SVG: &str = "http://www.w3.org/2000/svg";
/// The namespace of linked addresses in SVG 1.1.
const XLINK: &str = "http://www.w3.org/1999/xlink";

/// Whether an element never shows in a picture, so that its absence is not worth a word: descriptions, and what
/// drawing programs store for themselves in namespaces of their own.
pub(super) fn is_silent(node: Node<'_, '_>) -> bool {
    let namespace = node.tag_name().namespace();
    let root = node.document().root_element().tag_name().namespace();
    matches!(node.tag_name().name(), "title" | "desc" | "metadata")
        || namespace.is_some_and(|uri| uri != SVG && Some(uri) != root)
}

/// The address an element links to, by SVG 2's `href` or SVG 1.1's `xlink:href`.
pub(super) fn href<'doc>(node: Node<'doc, 'doc>) -> Option<&'doc str> {
    node.attribute("href").or_else(|| node.attribute((XLINK, "href")))
}

/// All numbers of an attribute; none if it is missing.
pub(super) fn numbers(builder: &Builder<'_>, node: Node<'_, '_>, name: &str) -> Result<Vec<f32>, Fault> {
    let text = node.attribute(name).unwrap_or("");
    numbers::all(name, text).map_err(|problem| problem.at(builder.locate_attribute(node, name)))
}

/// The first `N` numbers of an attribute, or a warning that there are fewer.
fn first<const N: usize>(builder: &mut Builder<'_>, node: Node<'_, '_>, name: &str) -> Result<Option<[f32; N]>, Fault> {
    let numbers = numbers(builder, node, name)?;
    let first = numbers.first_chunk::<N>().copied();
    if first.is_none() {
        let message = format!("not drawn: {name} holds {} numbers instead of {N}", numbers.len());
        builder.warn(node, message);
    }
    Ok(first)
}

/// Three `x y` in `points`.
pub(super) fn corners(builder: &mut Builder<'_>, node: Node<'_, '_>) -> Result<Option<[DVec2; 3]>, Fault> {
    let numbers = first::<6>(builder, node, "points")?;
    Ok(numbers.map(|n| [0, 2, 4].map(|i| DVec2::new(n[i].into(), n[i + 1].into()))))
}

/// Three `r g b a` in `colors`; the opacity means nothing.
pub(super) fn corner_colors(builder: &mut Builder<'_>, node: Node<'_, '_>) -> Result<Option<[Rgba; 3]>, Fault> {
    let numbers = first::<11>(builder, node, "colors")?;
    let unit = |channel: f32| channel.clamp(0.0, 1.0);
    Ok(numbers.map(|n| [0, 4, 8].map(|i| Rgba::opaque(unit(n[i]), unit(n[i + 1]), unit(n[i + 2])))))
}

/// Three `u v` in `uvs`.
pub(super) fn corner_uvs(builder: &mut Builder<'_>, node: Node<'_, '_>) -> Result<Option<[Vec2; 3]>, Fault> {
    let numbers = first::<6>(builder, node, "uvs")?;
    Ok(numbers.map(|n| [0, 2, 4].map(|i| Vec2::new(n[i], n[i + 1]))))
}

/// The texture at `address`, or a warning that there are too many.
pub(super) fn texture<'doc>(
    builder: &mut Builder<'doc>,
    node: Node<'doc, 'doc>,
    address: &'doc str,
    alpha: Alpha,
) -> Option<TextureId> {
    let location = builder.locate(node);
    let id = builder.textures.request(address, alpha, location);
    if id.is_none() {
        builder.warn(node, "not drawn: the scene has too many textures".to_owned());
    }
    id
}
