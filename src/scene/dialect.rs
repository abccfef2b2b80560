//! Which reading of a document the user asks for.

use roxmltree::Node;

use super::{Dialect, attributes, course, course_values, numbers};

/// The dialect as a setting.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DialectChoice {
    /// [`Dialect::Course`] if the document uses the course's own elements, or only elements and colours that the course
    /// reads as SVG does.
    #[default]
    Auto,
    /// Always [`Dialect::Course`].
    Course,
    /// Always [`Dialect::Svg`].
    Svg,
}

/// How to read a document.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ReadOptions {
    /// In which dialect.
    pub dialect: DialectChoice,
}

impl DialectChoice {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Auto, Self::Course, Self::Svg];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Course => Dialect::Course.name(),
            Self::Svg => Dialect::Svg.name(),
        }
    }

    /// The dialect in which to read the document with this root.
    pub(super) fn resolve(self, root: Node<'_, '_>) -> Dialect {
        match self {
            Self::Course => Dialect::Course,
            Self::Svg => Dialect::Svg,
            Self::Auto => recognise(root),
        }
    }
}

/// The course's dialect if the document uses what only the course has; or nothing that the course does not have,
/// colours that it reads as SVG does (named ones and `#fff` are others to it), no `style`, and a size in plain numbers,
/// without which the course's reader has no canvas.
fn recognise(root: Node<'_, '_>) -> Dialect {
    let mut foreign = false;
    let mut open = vec![root.children()];
    while let Some(children) = open.last_mut() {
        let Some(node) = children.next() else {
            open.pop();
            continue;
        };
        if !node.is_element() || attributes::is_silent(node) {
            continue;
        }
        let name = node.tag_name().name();
        if matches!(name, "colortri" | "textri" | "texture") || is_point(node) {
            return Dialect::Course;
        }
        foreign |= !course::ELEMENTS.contains(&name) || is_styled_as_svg(node);
        open.push(node.children());
    }
    let sized = has_number(root, "width") && has_number(root, "height");
    if foreign || !sized {
        Dialect::Svg
    } else {
        Dialect::Course
    }
}

/// Whether the attribute is a number, perhaps of pixels: what the course's reader takes for one.
fn has_number(node: Node<'_, '_>, name: &str) -> bool {
    let text = node.attribute(name).unwrap_or("").trim();
    text.strip_suffix("px").unwrap_or(text).parse::<f32>().is_ok()
}

/// Whether the element's look is written so that the course's reader would show another one.
fn is_styled_as_svg(node: Node<'_, '_>) -> bool {
    let misread = |name| {
        node.attribute(name)
            .is_some_and(|text| !course_values::color(text).as_svg)
    };
    node.has_attribute("style") || misread("fill") || misread("stroke")
}

/// Whether this is a rect without size, which the course draws as a point.
fn is_point(node: Node<'_, '_>) -> bool {
    let zero = |name| {
        node.attribute(name)
            .is_none_or(|text| matches!(numbers::leading(name, text), Ok(Some(0.0) | None)))
    };
    node.tag_name().name() == "rect" && zero("width") && zero("height")
}
