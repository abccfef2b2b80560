//! What usvg would pass over in silence: values that it does not understand, properties without effect.

use glam::DAffine2;
use roxmltree::Node;

use super::cascade::Styled;
use super::listener::Listener;
use super::{nonsense, own_triangles, values, viewports};
use crate::scene::report::quote;
use crate::scene::{SkippedKind, numbers};

/// Attributes that hold coordinates and lengths.
const LENGTHS: [&str; 14] = [
    "x", "y", "width", "height", "rx", "ry", "cx", "cy", "r", "x1", "y1", "x2", "y2", "points",
];

/// Lengths of shapes that SVG 2 reads in styles, too, and usvg as attributes only.
const GEOMETRY: [&str; 9] = ["x", "y", "width", "height", "rx", "ry", "cx", "cy", "r"];
/// The elements that have such; of a root they are the page's.
const SHAPES: [&str; 6] = ["rect", "circle", "ellipse", "image", "use", "svg"];

/// What is seen at an element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    pub(super) displayed: bool,
    /// How it lies in what is around it.
    pub(super) to_parent: DAffine2,
    /// The largest of its coordinates.
    pub(super) reach: f64,
}

/// Looks at an element's attributes and style; complains unless nobody shall hear it.
///
/// `styled` is what its styles say beside that.
pub(super) fn look<L: Listener>(listener: &mut L, node: Node<'_, '_>, styled: &Styled<'_>, heard: bool) -> Look {
    let mut look = Look {
        displayed: true,
        to_parent: DAffine2::IDENTITY,
        reach: 1.0,
    };
    let mut complaints = Vec::new();
    for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
        let (name, value) = (attribute.name(), attribute.value());
        declared(&mut look, name, value.trim());
        // Triangles of the course say themselves what is wrong with their corners.
        let is_own = name == "points" && own_triangles::is_one(node);
        if !is_own && (LENGTHS.contains(&name) || values::is_known(name)) {
            complaints.push((name, value.trim()));
        }
        if name == "pathLength" && is_dashed(node) && heard {
            let message = "pathLength has no effect: dashes are as long as they are written";
            listener.warn(node, message.to_owned());
        }
        if LENGTHS.contains(&name) {
            let read = values::before_too_large(name, value);
            let largest = numbers::all(name, read).unwrap_or_default().into_iter();
            look.reach = largest.fold(look.reach, |reach, number| reach.max(f64::from(number).abs()));
        }
    }
    let style = node.attribute("style").unwrap_or("");
    for declaration in simplecss::DeclarationTokenizer::from(style) {
        declared(&mut look, declaration.name, declaration.value);
        let is_moved = declaration.name == "transform" && styled.transform.is_some();
        if heard && !styled.has_length(declaration.name) && is_geometry_in_vain(node, &declaration) {
            let message = format!(
                "{} has no effect in a style; write it as an attribute",
                declaration.name
            );
            listener.warn(node, message);
        } else if !is_moved {
            complaints.push((declaration.name, declaration.value));
        }
    }
    if let Some(transform) = &styled.transform {
        declared(&mut look, "transform", transform);
    }
    complaints.extend(
        styled
            .in_vain
            .iter()
            .map(|declaration| (declaration.name, declaration.value)),
    );
    if heard && look.displayed {
        for (name, value) in complaints {
            complain(listener, node, name, value);
        }
    }
    look
}

/// Whether an element says itself that its outline is dashed.
fn is_dashed(node: Node<'_, '_>) -> bool {
    let style = node.attribute("style").unwrap_or("");
    node.attribute("stroke-dasharray")
        .is_some_and(|dashes| dashes.trim() != "none")
        || style.contains("stroke-dasharray")
}

/// Whether a style gives a shape a length that it does not have without it.
fn is_geometry_in_vain(node: Node<'_, '_>, declaration: &simplecss::Declaration<'_>) -> bool {
    let plain = |value: &str| value.trim().trim_end_matches("px").to_owned();
    SHAPES.contains(&node.tag_name().name())
        && node.parent_element().is_some()
        && GEOMETRY.contains(&declaration.name)
        && declaration.value != "auto"
        && values::is_understood(declaration.name, declaration.value)
        && node.attribute(declaration.name).map(plain) != Some(plain(declaration.value))
}

fn declared(look: &mut Look, name: &str, value: &str) {
    match name {
        "display" => look.displayed = value != "none",
        "transform" => {
            // That of a style counts in place of the attribute's.
            look.to_parent = values::transform(value).unwrap_or(look.to_parent);
        }
        _ => {}
    }
}

/// Whether an element is drawn as far as its outline is understood.
fn is_outline(node: Node<'_, '_>) -> bool {
    matches!(node.tag_name().name(), "path" | "polyline" | "polygon")
}

/// What is to be said of a root's background, unless it is that of all pictures.
fn background(node: Node<'_, '_>, name: &str, value: &str) -> Option<String> {
    let is_one = matches!(name, "background" | "background-color") && node.parent_element().is_none();
    let color = is_one.then(|| value.parse::<svgtypes::Color>().ok())?;
    let instead = match color {
        Some(svgtypes::Color {
            red: 255,
            green: 255,
            blue: 255,
            ..
        }) => return None,
        Some(color) if color.alpha == 0 => return None,
        Some(svgtypes::Color { red, green, blue, .. }) => format!("#{red:02x}{green:02x}{blue:02x}"),
        None if values::is_keyword(value) => return None,
        None => "COLOUR".to_owned(),
    };
    Some(format!(
        "{name} is not drawn; use --background {instead}, or a <rect> behind all"
    ))
}

fn complain<L: Listener>(listener: &mut L, node: Node<'_, '_>, name: &str, value: &str) {
    if let Some(message) = background(node, name, value) {
        listener.warn(node, message);
        return;
    }
    if values::is_without_effect(name, value) {
        listener.skip(SkippedKind::Attribute, name, node);
        return;
    }
    if values::is_understood(name, value) {
        return;
    }
    let message = if name == "points" && values::is_odd(value) {
        "points holds an odd number of coordinates; the last has no effect".to_owned()
    } else if name == "viewBox" && viewports::is_without_area(value) {
        viewports::without_area(node, value)
    } else if let Some((count, what)) = values::drawn_up_to(name, value).filter(|_| is_outline(node)) {
        let value = quote(value);
        format!("{name}=\"{value}\" is not understood after {count} {what}; it is drawn up to there")
    } else {
        nonsense::without_effect(name, value)
    };
    listener.warn(node, message);
}
