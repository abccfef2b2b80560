//! The course's own triangles, which both dialects draw: `colortri` and `textri`.

use glam::{DAffine2, DVec2, Vec2};
use roxmltree::Node;

use super::build::Builder;
use super::error::Fault;
use super::report::quote;
use super::texture_files::{TextureFiles, misspelt};
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

/// What an attribute holds for each of the three corners.
#[derive(Clone, Copy, Debug)]
struct CornerNumbers {
    attribute: &'static str,
    /// How many numbers it should hold.
    needed: usize,
    /// Their names at one corner.
    each: &'static str,
}

const POINTS: CornerNumbers = CornerNumbers {
    attribute: "points",
    needed: 6,
    each: "x y",
};
const COLORS: CornerNumbers = CornerNumbers {
    attribute: "colors",
    needed: 12,
    each: "r g b a",
};
const UVS: CornerNumbers = CornerNumbers {
    attribute: "uvs",
    needed: 6,
    each: "u v",
};

/// The first `N` numbers of an attribute, which are enough to draw; a warning where there are not just as many as are needed.
fn first<const N: usize>(builder: &mut Builder<'_>, node: Node<'_, '_>, corners: CornerNumbers) -> Option<[f32; N]> {
    let name = corners.attribute;
    let numbers = match numbers::all(name, node.attribute(name).unwrap_or("")) {
        Ok(numbers) => numbers,
        Err(problem) => {
            let place = builder.locate_attribute(node, name);
            builder.report.warn(place, format!("not drawn: {problem}"));
            return None;
        }
    };
    let first = numbers.first_chunk::<N>().copied();
    if numbers.len() != corners.needed {
        let told = corners.told(node, numbers.len());
        builder.warn(
            node,
            if first.is_none() {
                format!("not drawn: {told}")
            } else {
                told
            },
        );
    }
    first
}

impl CornerNumbers {
    /// What is wrong with an attribute that holds `count` numbers.
    fn told(self, node: Node<'_, '_>, count: usize) -> String {
        let Self {
            attribute,
            needed,
            each,
        } = self;
        if !node.has_attribute(attribute) {
            return match misspelt(node, attribute) {
                Some(meant) => format!("{attribute} is missing; write it for {}", quote(meant)),
                None => format!("{attribute} is missing; {needed} numbers are needed: {each} for each corner"),
            };
        }
        if count > needed {
            return format!("{attribute} holds {count} numbers; those after the first {needed} have no effect");
        }
        let s = if count == 1 { "" } else { "s" };
        format!("{attribute} holds {count} number{s}; {needed} are needed: {each} for each corner")
    }
}

/// Three `x y` in `points`, in user space.
fn corners(builder: &mut Builder<'_>, element: Element<'_>) -> Option<[DVec2; 3]> {
    let numbers = first::<6>(builder, element.node, POINTS)?;
    let corner = |n: [f32; 6], i: usize| {
        element
            .to_user
            .transform_point2(DVec2::new(n[i].into(), n[i + 1].into()))
    };
    Some([0, 2, 4].map(|i| corner(numbers, i)))
}

/// Three `r g b a` in `colors`; the opacity means nothing, and the last one is not waited for.
fn corner_colors(builder: &mut Builder<'_>, node: Node<'_, '_>) -> Option<[Rgba; 3]> {
    let numbers = first::<11>(builder, node, COLORS)?;
    let all = numbers::all("colors", node.attribute("colors").unwrap_or("")).unwrap_or_default();
    let last = all.get(11).copied().unwrap_or(1.0);
    if [numbers[3], numbers[7], last].into_iter().any(|alpha| alpha < 1.0) {
        builder.skip(SkippedKind::Attribute, ALPHA, node);
    }
    if numbers.iter().any(|channel| !(0.0..=1.0).contains(channel)) {
        let message =
            "colors go from 0 to 1, and what is beyond is taken as 0 or 1; divide those that go to 255 by 255";
        let location = builder.locate(node);
        builder.report.warn_once(location, message);
    }
    let unit = |channel: f32| channel.clamp(0.0, 1.0);
    Some([0, 4, 8].map(|i| Rgba::opaque(unit(numbers[i]), unit(numbers[i + 1]), unit(numbers[i + 2]))))
}

/// Three `u v` in `uvs`.
fn corner_uvs(builder: &mut Builder<'_>, node: Node<'_, '_>) -> Option<[Vec2; 3]> {
    let n = first::<6>(builder, node, UVS)?;
    Some([0, 2, 4].map(|i| Vec2::new(n[i], n[i + 1])))
}
