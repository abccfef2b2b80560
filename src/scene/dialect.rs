//! Which reading of a document the user asks for.

use std::path::Path;

use roxmltree::Node;
use svgtypes::{Length, LengthUnit};

use super::document::Source;
use super::{Dialect, attributes, course, course_values, numbers};

/// Attributes with which nobody writes for the course's reader, which knows nothing of them.
const ONLY_SVG: [&str; 24] = [
    "class",
    "clip-path",
    "clip-rule",
    "color",
    "display",
    "fill-rule",
    "filter",
    "marker-end",
    "marker-mid",
    "marker-start",
    "mask",
    "mix-blend-mode",
    "opacity",
    "paint-order",
    "preserveAspectRatio",
    "rx",
    "ry",
    "shape-rendering",
    "stroke-dasharray",
    "stroke-dashoffset",
    "transform-origin",
    "vector-effect",
    "visibility",
    "xml:space",
];

/// Attributes that hold a length.
const LENGTHS: [&str; 10] = [
    "x",
    "y",
    "x1",
    "y1",
    "x2",
    "y2",
    "width",
    "height",
    "stroke-width",
    "font-size",
];

/// Attributes that hold a part of one, which the course's reader does not know in percent.
const PARTS: [&str; 3] = ["fill-opacity", "stroke-opacity", "stop-opacity"];

/// The dialect as a setting.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DialectChoice {
    /// [`Dialect::Course`] if the document uses the course's own elements, or only elements and colours that the course
    /// reads as SVG does.
    #[default]
    Auto,
    /// The same for a document among others of the course, or in a folder for which the course's reading was chosen: what may be
    /// meant in either dialect is the course's. What uses more of SVG than any course's reader knows stays SVG.
    AmongCourse,
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
    /// Every value that can be set, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Auto, Self::Course, Self::Svg];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto | Self::AmongCourse => "auto",
            Self::Course => Dialect::Course.name(),
            Self::Svg => Dialect::Svg.name(),
        }
    }

    /// The choice that reads a document as this one did, in `dialect`, wherever it lies.
    #[must_use]
    pub const fn anywhere(self, dialect: Dialect) -> Self {
        match (self, dialect) {
            (Self::AmongCourse, Dialect::Course) => Self::Course,
            (Self::AmongCourse, Dialect::Svg) => Self::Auto,
            _ => self,
        }
    }

    /// Whether a document may be read in `dialect` then.
    pub const fn allows(self, dialect: Dialect) -> bool {
        match self {
            Self::Auto | Self::AmongCourse => true,
            Self::Course => matches!(dialect, Dialect::Course),
            Self::Svg => matches!(dialect, Dialect::Svg),
        }
    }

    /// The dialect in which to read the document with this root; and the other, where the document may be meant in it and
    /// is another picture then.
    pub(super) fn resolve(self, root: Node<'_, '_>) -> (Dialect, Option<Dialect>) {
        let traits = Traits::of(root);
        let dialect = match self {
            Self::Course => Dialect::Course,
            Self::Svg => Dialect::Svg,
            Self::AmongCourse if !traits.rich => Dialect::Course,
            Self::Auto | Self::AmongCourse => traits.dialect(),
        };
        let other = match dialect {
            Dialect::Course => Dialect::Svg,
            Dialect::Svg => Dialect::Course,
        };
        (dialect, traits.may_be_either().then_some(other))
    }
}

/// Whether a document uses elements that only the course has, so that those beside it are the course's too.
pub fn is_of_course(document: &[u8]) -> bool {
    let names = ["colortri", "textri", "texture"];
    let holds = |name: &str| document.windows(name.len()).any(|part| part == name.as_bytes());
    if !names.into_iter().any(holds) {
        return false;
    }
    let Ok(text) = super::document::decode(document) else {
        return false;
    };
    let Ok(source) = Source::new(&text) else {
        return false;
    };
    source.parse().is_ok_and(|tree| {
        let mut elements = tree.root_element().descendants().filter(Node::is_element);
        elements.any(|node| names.contains(&node.tag_name().name()) && !attributes::is_silent(node))
    })
}

/// What tells the dialects apart in a document.
#[derive(Clone, Copy, Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is a question of its own")]
struct Traits {
    /// It uses what only the course has.
    own: bool,
    /// It has rects without a size, which the course draws as points; other programs leave such, too.
    points: bool,
    /// It uses elements that the course's reader skips, colours that it misreads, or `style`.
    foreign: bool,
    /// It uses more of SVG than lines, polygons and round shapes: nobody writes that for the course's reader.
    rich: bool,
    /// It has a `style`, where rects without a size are leftovers.
    styled: bool,
    /// Its shapes are shown larger or smaller than they are written; there such rects are leftovers, too.
    scaled: bool,
    /// It has something that the course's reader draws.
    drawn: bool,
    /// It has strokes, a `viewBox` and the like, which mean something else to each reader.
    differs: bool,
    /// Its size is given in plain numbers, without which the course's reader has no canvas; or begins with numbers.
    sized: bool,
    measured: bool,
}

impl Traits {
    fn of(root: Node<'_, '_>) -> Self {
        let mut traits = Self {
            sized: has_number(root, "width") && has_number(root, "height"),
            measured: begins_with_number(root, "width") && begins_with_number(root, "height"),
            differs: has_view_box(root),
            foreign: is_styled_root(root) || is_scaled(root),
            scaled: is_scaled(root),
            ..Self::default()
        };
        let mut open = vec![root.children()];
        while let Some(children) = open.last_mut() {
            let Some(node) = children.next() else {
                open.pop();
                continue;
            };
            if !node.is_element() || attributes::is_silent(node) {
                continue;
            }
            traits.add(node);
            if traits.own {
                break;
            }
            open.push(node.children());
        }
        traits
    }

    fn add(&mut self, node: Node<'_, '_>) {
        let name = node.tag_name().name();
        let is_known = course::ELEMENTS.contains(&name);
        self.own |= matches!(name, "colortri" | "textri" | "texture");
        self.points |= is_point(node);
        // The course's reader stretches pictures, SVG keeps their proportions.
        let is_picture = name == "image";
        self.foreign |= !is_known || is_picture || is_styled_as_svg(node) || is_only_svg(node);
        self.styled |= node.has_attribute("style");
        self.rich |= !is_known && !matches!(name, "circle" | "ellipse");
        self.drawn |= is_known && name != "g";
        self.differs |= !is_known || is_styled_as_svg(node) || course::is_read_otherwise(node);
    }

    /// The course's dialect if the document uses what only the course has; or nothing that the course does not have,
    /// colours that it reads as SVG does (named ones and `#fff` are others to it), no `style`, no picture, no attribute
    /// or unit of which the course's reader knows nothing, no paint for a whole group, and a size in plain numbers that is that
    /// of the `viewBox`, too.
    fn dialect(self) -> Dialect {
        let is_pointed = self.points && self.measured && !self.rich && !self.styled && !self.scaled;
        if self.own || is_pointed || (self.sized && !self.foreign) {
            Dialect::Course
        } else {
            Dialect::Svg
        }
    }

    fn may_be_either(self) -> bool {
        // Points are the course's, unless the rest is written as SVG.
        let says_nothing = !self.points || self.foreign;
        !self.own && says_nothing && !self.rich && self.drawn && self.measured && self.differs
    }
}

/// Whether the root says how its shapes look, of which the course's reader knows nothing: sets of icons do.
fn is_styled_root(root: Node<'_, '_>) -> bool {
    let names = ["class", "color", "fill", "stroke", "stroke-width", "style", "transform"];
    names.into_iter().any(|name| root.has_attribute(name))
}

/// Whether a `viewBox` says something else than width and height do.
fn has_view_box(root: Node<'_, '_>) -> bool {
    let Some(text) = root.attribute("viewBox") else {
        return false;
    };
    let number = |name| {
        numbers::leading(name, root.attribute(name).unwrap_or(""))
            .ok()
            .flatten()
    };
    let plain = [Some(0.0), Some(0.0), number("width"), number("height")];
    let found = numbers::all("viewBox", text).unwrap_or_default();
    found.into_iter().map(Some).ne(plain)
}

/// Whether shapes are shown larger or smaller than they are written, of which the course's reader knows nothing. Exporters that
/// give a size of one pixel mean the `viewBox` as the size.
fn is_scaled(root: Node<'_, '_>) -> bool {
    let found = numbers::all("viewBox", root.attribute("viewBox").unwrap_or("")).unwrap_or_default();
    let number = |name| {
        numbers::leading(name, root.attribute(name).unwrap_or(""))
            .ok()
            .flatten()
    };
    let side = |at: usize| found.get(at).copied().filter(|side| *side > 0.0);
    match (number("width").zip(number("height")), side(2).zip(side(3))) {
        (Some(size), Some(sides)) => size.0 > 1.0 && size.1 > 1.0 && size != sides,
        _ => false,
    }
}

/// Whether the course's reader finds a number above zero in the attribute.
fn begins_with_number(node: Node<'_, '_>, name: &str) -> bool {
    let number = numbers::leading(name, node.attribute(name).unwrap_or(""));
    matches!(number, Ok(Some(number)) if number > 0.0)
}

/// Whether the attribute is a number, perhaps of pixels: what the course's reader takes for one.
fn has_number(node: Node<'_, '_>, name: &str) -> bool {
    numbers::is_plain(node.attribute(name).unwrap_or(""))
}

/// Whether the element's look is written so that the course's reader would show another one.
fn is_styled_as_svg(node: Node<'_, '_>) -> bool {
    let misread = |name| {
        node.attribute(name)
            .is_some_and(|text| !course_values::color(text).as_svg)
    };
    node.has_attribute("style") || misread("fill") || misread("stroke")
}

/// Whether the element has an attribute, a unit or a picture that the course's reader does not know.
fn is_only_svg(node: Node<'_, '_>) -> bool {
    let has_unit = |text: &str| {
        let length = text.trim().parse::<Length>();
        length.is_ok_and(|length| !matches!(length.unit, LengthUnit::None | LengthUnit::Px))
    };
    let in_percent = |name: &str| node.attribute(name).is_some_and(|text| text.contains('%'));
    ONLY_SVG.iter().any(|name| node.has_attribute(*name))
        || PARTS.into_iter().any(in_percent)
        || LENGTHS.iter().any(|name| node.attribute(*name).is_some_and(has_unit))
        // To the course's reader each shape has its own paint.
        || node.tag_name().name() == "g" && ["fill", "stroke"].into_iter().any(|paint| node.has_attribute(paint))
        || is_drawing(node)
}

/// Whether this is an image that is a drawing itself: the course's reader knows pictures of texels only.
fn is_drawing(node: Node<'_, '_>) -> bool {
    let address = attributes::href(node).filter(|_| node.tag_name().name() == "image");
    address.is_some_and(|address| {
        let head: String = address.trim_start().chars().take("data:image/svg".len()).collect();
        head.eq_ignore_ascii_case("data:image/svg")
            || Path::new(address.trim_end())
                .extension()
                .is_some_and(|kind| kind.eq_ignore_ascii_case("svg") || kind.eq_ignore_ascii_case("svgz"))
    })
}

/// Whether this is a rect without size, which the course draws as a point.
fn is_point(node: Node<'_, '_>) -> bool {
    let zero = |name| {
        node.attribute(name)
            .is_none_or(|text| matches!(numbers::leading(name, text), Ok(Some(0.0) | None)))
    };
    node.tag_name().name() == "rect" && zero("width") && zero("height")
}
