//! What SVG reads and usvg does not: numbers between white space, and shapes whose filter is not there.

use glam::{DAffine2, DVec2};
use roxmltree::Node;
use svgtypes::PathSegment;

use super::cascade::{Styled, is_missing};
use super::elements::Elements;
use super::{nonsense, own_triangles, values};
use crate::scene::edits::Edits;
use crate::scene::report::quote;
use crate::scene::{attributes, media, numbers};

/// White space as XML knows it.
const SPACE: [char; 4] = [' ', '\t', '\n', '\r'];

/// Takes the white space around the numbers of an element's attributes out of `text`: usvg takes other values for them, or none.
/// `styled` says which have others from styles.
pub(super) fn trim_numbers(text: &str, node: Node<'_, '_>, styled: &Styled<'_>, edits: &mut Edits) {
    let attributes = node.attributes().filter(|attribute| attribute.namespace().is_none());
    for attribute in attributes.filter(|attribute| !styled.has_length(attribute.name())) {
        let name = attribute.name();
        let range = attribute.range_value();
        let raw = text.get(range.clone()).unwrap_or("");
        // A path's data may have it, and is changed elsewhere.
        let is_framed = raw.starts_with(SPACE) | raw.ends_with(SPACE);
        let is_kept = || {
            !is_outline(node, name) && values::is_numeric(name) && !nonsense::is_nonsense(name, raw.trim_matches(SPACE))
        };
        if is_framed && is_kept() {
            edits.replace(range, raw.trim_matches(SPACE).to_owned());
        }
    }
}

/// Whether an attribute is the outline of a path or a triangle.
fn is_outline(node: Node<'_, '_>, name: &str) -> bool {
    name == "d" || name == "points" && own_triangles::is_one(node)
}

/// Takes an element's filter out of the text where no filter has the id that it refers to: such a filter is none, and usvg would
/// draw nothing. Quotes around an id go as well, for which usvg passes over filters. Styles are read elsewhere.
pub(super) fn mend_filter(node: Node<'_, '_>, elements: &Elements<'_>, edits: &mut Edits) {
    let Some(filter) = node.attributes().find(|attribute| attribute.name() == "filter") else {
        return;
    };
    let value = filter.value();
    if is_missing(value, elements) {
        edits.replace(filter.range(), String::new());
    } else if let Some(id) = values::reference(value).filter(|_| value.contains(['"', '\''])) {
        edits.replace(filter.range_value(), format!("url(#{id})"));
    }
}

/// Takes its `textLength` from a text with others inside: usvg has each run of letters alone as long as it, or none. What is to be
/// said of it.
pub(super) fn drop_text_length(node: Node<'_, '_>, edits: &mut Edits) -> Option<&'static str> {
    let length = node.attributes().find(|attribute| attribute.name() == "textLength")?;
    let holds = |name: &str| node.children().any(|child| child.tag_name().name() == name);
    if !["tspan", "textPath", "a", "tref"].into_iter().any(holds) {
        return None;
    }
    edits.replace(length.range(), String::new());
    Some("textLength has no effect where elements stand in a text: its letters are as wide as they are")
}

/// Shortest side of a pattern's tile: usvg does not survive those that 32-bit floats do not tell from nothing beside what they fill.
const FINEST: f64 = 1e-6;

/// Has a pattern fill nothing whose tiles are too small to be told apart; what is to be said of it.
pub(super) fn hide_fine_pattern(node: Node<'_, '_>, edits: &mut Edits) -> Option<String> {
    let sides = node
        .attributes()
        .filter(|attribute| matches!(attribute.name(), "width" | "height"));
    let fine = sides.filter(|_| node.tag_name().name() == "pattern").find(|side| {
        let length = side.value().trim().parse::<svgtypes::Length>();
        length.is_ok_and(|length| {
            let is_percent = length.unit == svgtypes::LengthUnit::Percent;
            let number = if is_percent {
                length.number / 100.0
            } else {
                length.number
            };
            number > 0.0 && number < FINEST
        })
    })?;
    let (name, value) = (fine.name(), quote(fine.value()));
    edits.replace(fine.range(), format!("{name}=\"0\""));
    let id = node
        .attribute("id")
        .map_or(String::new(), |id| format!(" \"{}\"", quote(id)));
    Some(format!(
        "what the pattern{id} fills is not drawn: its {name} \"{value}\" is under {FINEST}; make its tiles larger"
    ))
}

/// Whether an element is all of a mask and made white by its filter, which then has the effect that it shall have.
pub(super) fn is_whitened(node: Node<'_, '_>, elements: &Elements<'_>) -> bool {
    let Some(filter) = node.attribute("filter") else {
        return false;
    };
    let is_all = node.parent_element().is_some_and(|parent| {
        parent.tag_name().name() == "mask" && parent.children().filter(Node::is_element).count() == 1
    });
    let effects = values::reference(filter)
        .filter(|_| is_all)
        .and_then(|id| elements.own(id))
        .map(|filter| filter.children().filter(Node::is_element));
    effects.is_some_and(|mut effects| {
        let first = effects
            .next()
            .filter(|effect| effect.tag_name().name() == "feColorMatrix");
        let values = first.and_then(|effect| effect.attribute("values"));
        let numbers = values.and_then(|values| numbers::all("values", values).ok());
        effects.next().is_none() && numbers.is_some_and(|numbers| numbers == values::WHITENS)
    })
}

/// Some values of `image-rendering` are known to usvg in styles only; as attributes they mean what an older one does.
pub(super) fn pixelate(node: Node<'_, '_>, edits: &mut Edits) {
    let attribute = node
        .attributes()
        .find(|attribute| attribute.name() == "image-rendering");
    if let Some(attribute) = attribute.filter(|attribute| matches!(attribute.value(), "pixelated" | "crisp-edges")) {
        edits.replace(attribute.range_value(), "optimizeSpeed".to_owned());
    }
}

/// Whether an element shows nothing because it has a filter without effects, as SVG wants it.
pub(super) fn is_filtered_away(node: Node<'_, '_>, elements: &Elements<'_>) -> bool {
    let id = node.attribute("filter").and_then(values::reference);
    let found = id.and_then(|id| elements.own(id));
    found.is_some_and(|filter| {
        filter.has_tag_name("filter")
            && !filter.has_attribute("href")
            && !filter.children().any(|effect| effect.is_element())
    })
}

/// What is to be said of a part of a clip path that SVG wants passed over (CSS Masking 1, section 6.1): all but shapes, text and
/// each `use` of one.
pub(super) fn clips_nothing(node: Node<'_, '_>, elements: &Elements<'_>) -> Option<String> {
    let is_part = node
        .parent_element()
        .is_some_and(|parent| parent.tag_name().name() == "clipPath");
    let is_group = |node: Node<'_, '_>| {
        matches!(
            node.tag_name().name(),
            "g" | "a" | "svg" | "switch" | "symbol" | "image"
        )
    };
    let name = node.tag_name().name();
    if !is_part {
        None
    } else if is_group(node) {
        Some(format!(
            "<{name}> in a clipPath has no effect; put shapes and text into the clipPath themselves"
        ))
    } else {
        let target = elements
            .target(node)
            .filter(|target| name == "use" && is_group(*target))?;
        let name = target.tag_name().name();
        Some(format!(
            "<use> of <{name}> in a clipPath has no effect; use the shapes inside themselves"
        ))
    }
}

/// What is to be said of a `use` of what is not there.
pub(super) fn shows_nothing(node: Node<'_, '_>, elements: &Elements<'_>) -> Option<&'static str> {
    let address = attributes::href(node).filter(|_| node.tag_name().name() == "use")?;
    if elements.target(node).is_some() {
        None
    } else if address.trim().starts_with('#') {
        Some("not drawn: no element has the id that it refers to")
    } else {
        Some("not drawn: other documents are not looked into")
    }
}

/// What is to be said of a document that refers to a style sheet outside, as XML does.
pub(super) fn style_elsewhere(root: Node<'_, '_>) -> Option<&'static str> {
    let mut instructions = root.document().root().children().filter_map(|node| node.pi());
    let is_sheet = instructions.any(|instruction| instruction.target == "xml-stylesheet");
    is_sheet.then_some("<?xml-stylesheet?> has no effect; other style sheets are not fetched: put it into a <style>")
}

/// What is to be said of a sheet that is left out because of a condition.
pub(super) fn other_media(sheet: Node<'_, '_>) -> Option<String> {
    let list = sheet.attribute("media").filter(|list| media::applies(list).is_none())?;
    Some(format!(
        "has no effect: whether media=\"{}\" holds is not looked at",
        quote(list)
    ))
}

/// What is to be said of a root that other programs take for no drawing, as it is not in the namespace `svg`.
pub(super) fn other_namespace(root: Node<'_, '_>, svg: &str) -> Option<String> {
    let namespace = root.tag_name().namespace().unwrap_or("");
    let what = match namespace {
        "" => "has no namespace".to_owned(),
        other => format!("is in the namespace \"{}\"", quote(other)),
    };
    (namespace != svg).then(|| format!("{what}; other programs draw it with xmlns=\"{svg}\" alone"))
}

/// What is to be said of a root whose coordinates lie so far from 0 that 32-bit floats, in which usvg counts, tell neighbouring
/// pixels no longer apart.
pub(super) fn far_from_zero(root: Node<'_, '_>) -> Option<String> {
    let numbers = numbers::all("viewBox", root.attribute("viewBox")?).ok()?;
    let [x, y, width, height] = numbers.first_chunk::<4>()?.map(f64::from);
    let farthest = (x.abs() + width).max(y.abs() + height);
    rounded(
        farthest,
        width.max(height),
        "move all of them nearer to 0, and viewBox with them",
    )
}

/// What is to be said of a shape whose coordinates lie that far from 0, and which a transform brings back into a picture of this
/// size.
pub(super) fn far_before_transform(node: Node<'_, '_>, to_root: DAffine2, picture: DVec2) -> Option<String> {
    /// How far from 0 a shape of the picture begins, at most, in its longer sides: its viewBox may begin elsewhere.
    const NEAR: f64 = 10.0;
    let side = picture.max_element();
    // Most transforms are near, and not worth a look at the outline.
    let cure = "write them nearer to 0, with a smaller transform";
    rounded(to_root.translation.abs().max_element(), side, cure)?;
    let start = start(node)?;
    let is_seen = to_root.transform_point2(start).abs().max_element() < NEAR * side;
    let scale = to_root.matrix2.x_axis.length().max(to_root.matrix2.y_axis.length());
    rounded(start.abs().max_element() * scale, side, cure).filter(|_| is_seen)
}

/// Where the outline of a shape begins, or text; nothing of other elements.
fn start(node: Node<'_, '_>) -> Option<DVec2> {
    let number = |name| {
        numbers::leading(name, node.attribute(name)?)
            .ok()
            .flatten()
            .map(f64::from)
    };
    let place = |x, y| Some(DVec2::new(number(x).unwrap_or(0.0), number(y).unwrap_or(0.0)));
    match node.tag_name().name() {
        "path" => match svgtypes::PathParser::from(node.attribute("d")?).next()?.ok()? {
            PathSegment::MoveTo { x, y, .. } => Some(DVec2::new(x, y)),
            _ => None,
        },
        "polygon" | "polyline" => {
            let (x, y) = svgtypes::PointsParser::from(node.attribute("points")?).next()?;
            Some(DVec2::new(x, y))
        }
        "rect" | "image" | "text" | "use" => place("x", "y"),
        "circle" | "ellipse" => place("cx", "cy"),
        "line" => place("x1", "y1"),
        _ => None,
    }
}

/// What is to be said of coordinates that are up to `farthest` from 0 in a picture whose longer side is `side`.
fn rounded(farthest: f64, side: f64, cure: &str) -> Option<String> {
    /// Parts of the picture's longer side by which a corner may be off: a tenth of a pixel of most windows.
    const LITTLE: f64 = 1e-4;
    // Half of the distance of neighbouring floats, at most.
    let off = farthest * f64::from(f32::EPSILON) / 2.0;
    (off > side * LITTLE).then(|| {
        format!(
            "coordinates this far from 0 are rounded, by up to {off:.2} of {side} units: shapes are drawn in other places; {cure}"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_that_a_transform_brings_back_are_told() {
        let told = |shape: &str, x: f64| {
            let document = roxmltree::Document::parse(shape).expect("a document");
            let to_root = DAffine2::from_translation(DVec2::new(x, 0.0));
            far_before_transform(document.root_element(), to_root, DVec2::new(200.0, 100.0))
        };
        for far in [
            "<path d='M13000101 5h9'/>",
            "<rect x='13000101'/>",
            "<polygon points='13000101,5 6 7'/>",
        ] {
            let line = told(far, -13e6).expect(far);
            assert!(line.contains("rounded, by up to 0.77 of 200 units"), "{line}");
        }
        for (near, x) in [
            ("<path d='M101 5h9'/>", 0.0),
            ("<path d='M101 5h9'/>", -13e6),
            ("<rect x='13000101'/>", 0.0),
            ("<g x='13000101'/>", -13e6),
            ("<path d=''/>", -13e6),
            ("<rect x='1101'/>", -1000.0),
        ] {
            assert_eq!(told(near, x), None, "{near}");
        }
    }

    #[test]
    fn roots_far_from_zero_are_told() {
        let told = |view_box: &str| {
            let text = format!("<svg viewBox='{view_box}'/>");
            let document = roxmltree::Document::parse(&text).expect("a document");
            far_from_zero(document.root_element())
        };
        for plain in ["0 0 20 20", "-5000 3000 100 100", "1e9 0 1e9 1e9", "", "1 2 3"] {
            assert_eq!(told(plain), None, "{plain}");
        }
        for far in ["500000 5000000 20 20", "13387000 0 50 50", "0 -1e8 640 480"] {
            assert!(told(far).is_some_and(|line| line.contains("nearer to 0")), "{far}");
        }
    }
}
