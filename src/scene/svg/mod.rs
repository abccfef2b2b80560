//! The dialect `svg`: SVG 1.1 and 2 as far as straight edges, colours and images go.
//!
//! Styles come from presentation attributes and the `style` attribute and are inherited; strokes have widths; the
//! canvas is the document's viewport. What is not drawn is reported.

mod declarations;
mod outline;
mod shapes;
mod style;
mod values;
mod viewport;

use glam::{DAffine2, DVec2};
use roxmltree::{Children, Node};
use svgtypes::AspectRatio;

use self::style::{OwnStyle, Style};
use self::values::{Along, Units};
use self::viewport::{DEFAULT_ASPECT, Frame};
use super::build::Builder;
use super::error::Fault;
use super::report::quote;
use super::triangles::{Element, TextureFiles};
use super::{ShapeId, SkippedKind, attributes, numbers};

/// Size of a document that does not say, as web browsers have it.
const DEFAULT_SIZE: DVec2 = DVec2::new(300.0, 150.0);

/// Elements that only define what others refer to; the reference is what is reported.
const DEFINITIONS: [&str; 10] = [
    "defs",
    "texture",
    "symbol",
    "clipPath",
    "mask",
    "linearGradient",
    "radialGradient",
    "pattern",
    "marker",
    "filter",
];

/// Properties whose values are numbers: one that is not finite is refused, not ignored.
const NUMERIC: [&str; 7] = [
    "font-size",
    "fill-opacity",
    "stroke-opacity",
    "stroke-width",
    "stroke-miterlimit",
    "opacity",
    "transform",
];

/// Reads one document.
#[derive(Debug)]
pub(super) struct SvgReader<'a, 'doc> {
    builder: &'a mut Builder<'doc>,
    texture_files: TextureFiles<'doc>,
}

/// What an element finds around it.
#[derive(Clone, Copy, Debug)]
struct Surroundings {
    to_user: DAffine2,
    style: Style,
    viewport: DVec2,
}

/// A container whose children are being read.
#[derive(Debug)]
struct Open<'doc> {
    children: Children<'doc, 'doc>,
    surroundings: Surroundings,
    /// The layer to close in the end.
    layer: Option<(ShapeId, f32)>,
}

impl Surroundings {
    fn units(&self) -> Units {
        Units {
            viewport: self.viewport,
            font_size: self.style.font_size,
        }
    }

    /// What is inside an `svg` element that fills `port` is measured by its `viewBox`.
    fn establish_viewport(&mut self, port: Frame, view_box: Option<Frame>, aspect: AspectRatio) {
        if let Some(content) = view_box {
            self.to_user *= port.fit(content, aspect);
            self.viewport = content.size;
        } else {
            self.to_user *= DAffine2::from_translation(port.corner);
            self.viewport = port.size;
        }
    }
}

impl<'a, 'doc> SvgReader<'a, 'doc> {
    /// Reads everything below `root` and answers with the canvas.
    pub(super) fn read(builder: &'a mut Builder<'doc>, root: Node<'doc, 'doc>) -> Result<DVec2, Fault> {
        let mut reader = Self {
            builder,
            texture_files: TextureFiles::below(root),
        };
        let view_box = reader.view_box(root)?;
        let viewport = view_box.map_or(DEFAULT_SIZE, |frame| frame.size);
        let outside = Surroundings {
            to_user: DAffine2::IDENTITY,
            style: Style::INITIAL,
            viewport,
        };
        let width = reader.length(root, "width", Along::X, &outside)?;
        let height = reader.length(root, "height", Along::Y, &outside)?;
        let canvas = DVec2::new(width.unwrap_or(viewport.x), height.unwrap_or(viewport.y));
        if canvas.min_element() <= 0.0 {
            return Ok(canvas);
        }
        let unsized_canvas = view_box.is_none() && (width.is_none() || height.is_none());
        if unsized_canvas {
            let message = format!(
                "width, height or viewBox is missing; the canvas is {} x {}",
                canvas.x, canvas.y
            );
            reader.builder.warn(root, message);
        }
        let port = Frame {
            corner: DVec2::ZERO,
            size: canvas,
        };
        reader.tree(root, outside, port, view_box)?;
        Ok(canvas)
    }

    /// Walks the tree without recursion, so that no nesting is too deep.
    fn tree(
        &mut self,
        root: Node<'doc, 'doc>,
        outside: Surroundings,
        port: Frame,
        view_box: Option<Frame>,
    ) -> Result<(), Fault> {
        let (mut surroundings, own) = self.enter(root, outside)?;
        if !own.displayed || own.opacity <= 0.0 {
            return Ok(());
        }
        let aspect = self.aspect(root)?;
        surroundings.establish_viewport(port, view_box, aspect);
        let mut open = vec![self.open(root, surroundings, own)?];
        while let Some(container) = open.last_mut() {
            let surroundings = container.surroundings;
            match container.children.next() {
                Some(node) if node.is_element() && !attributes::is_silent(node) => {
                    open.extend(self.element(node, surroundings)?);
                }
                Some(_) => {}
                None => {
                    let layer = open.pop().and_then(|container| container.layer);
                    if let Some((shape, opacity)) = layer {
                        self.builder.end_layer(shape, opacity)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Draws an element, or opens it if it is a container.
    fn element(&mut self, node: Node<'doc, 'doc>, parent: Surroundings) -> Result<Option<Open<'doc>>, Fault> {
        let name = node.tag_name().name();
        if DEFINITIONS.contains(&name) {
            return Ok(None);
        }
        let (mut surroundings, own) = self.enter(node, parent)?;
        if !own.displayed || own.opacity <= 0.0 {
            return Ok(None);
        }
        match name {
            "g" | "a" => {}
            "svg" => {
                let Some(port) = self.nested_port(node, &surroundings)? else {
                    return Ok(None);
                };
                let (view_box, aspect) = (self.view_box(node)?, self.aspect(node)?);
                surroundings.establish_viewport(port, view_box, aspect);
            }
            "line" | "polyline" | "polygon" | "rect" | "image" | "colortri" | "textri" => {
                if surroundings.style.visible {
                    self.shape(node, &surroundings, own.opacity)?;
                }
                return Ok(None);
            }
            _ => {
                self.builder.skip(SkippedKind::Element, name, node);
                return Ok(None);
            }
        }
        self.open(node, surroundings, own).map(Some)
    }

    fn open(
        &mut self,
        node: Node<'doc, 'doc>,
        surroundings: Surroundings,
        own: OwnStyle<'doc>,
    ) -> Result<Open<'doc>, Fault> {
        let mut layer = None;
        if own.opacity < 1.0 {
            let shape = self.builder.shape(node);
            self.builder.begin_layer(shape)?;
            layer = Some((shape, own.opacity));
        }
        Ok(Open {
            children: node.children(),
            surroundings,
            layer,
        })
    }

    /// Style and transform of an element, with complaints about them.
    fn enter(&mut self, node: Node<'doc, 'doc>, parent: Surroundings) -> Result<(Surroundings, OwnStyle<'doc>), Fault> {
        let (style, own, complaints) = style::cascade(node, parent.style, parent.units());
        for (name, value) in complaints.invalid {
            self.not_understood(node, name, value)?;
        }
        for name in complaints.without_effect {
            self.builder.skip(SkippedKind::Attribute, name, node);
        }
        let mut to_user = parent.to_user;
        if let Some(text) = own.transform.filter(|text| *text != "none") {
            match values::transform(text) {
                Some(transform) => to_user *= transform,
                None => self.not_understood(node, "transform", text)?,
            }
        }
        let surroundings = Surroundings {
            to_user,
            style,
            ..parent
        };
        Ok((surroundings, own))
    }

    /// Refuses a value with a number that is not finite, and warns of any other that is not understood.
    fn not_understood(&mut self, node: Node<'doc, 'doc>, name: &str, value: &str) -> Result<(), Fault> {
        let geometry = !style::is_property(name);
        if geometry || NUMERIC.contains(&name) {
            numbers::all(name, value).map_err(|problem| problem.at(self.builder.locate_attribute(node, name)))?;
        }
        self.builder.warn(
            node,
            format!("{name}=\"{}\" is not understood and has no effect", quote(value)),
        );
        Ok(())
    }

    /// A length in user units, if there is one.
    fn length(
        &mut self,
        node: Node<'doc, 'doc>,
        name: &str,
        along: Along,
        surroundings: &Surroundings,
    ) -> Result<Option<f64>, Fault> {
        let Some(text) = node.attribute(name).filter(|text| *text != "auto") else {
            return Ok(None);
        };
        let length = surroundings.units().length(text, along);
        if length.is_none() {
            self.not_understood(node, name, text)?;
        }
        Ok(length)
    }

    fn view_box(&mut self, node: Node<'doc, 'doc>) -> Result<Option<Frame>, Fault> {
        let Some(text) = node.attribute("viewBox") else {
            return Ok(None);
        };
        let frame = Frame::parse(text);
        if frame.is_none() {
            self.not_understood(node, "viewBox", text)?;
        }
        Ok(frame)
    }

    fn aspect(&mut self, node: Node<'doc, 'doc>) -> Result<AspectRatio, Fault> {
        let Some(text) = node.attribute("preserveAspectRatio") else {
            return Ok(DEFAULT_ASPECT);
        };
        if let Ok(aspect) = text.parse() {
            return Ok(aspect);
        }
        self.not_understood(node, "preserveAspectRatio", text)?;
        Ok(DEFAULT_ASPECT)
    }

    /// Where a nested `svg` goes; `None` if it has no area.
    fn nested_port(&mut self, node: Node<'doc, 'doc>, around: &Surroundings) -> Result<Option<Frame>, Fault> {
        let x = self.length(node, "x", Along::X, around)?.unwrap_or(0.0);
        let y = self.length(node, "y", Along::Y, around)?.unwrap_or(0.0);
        let width = self
            .length(node, "width", Along::X, around)?
            .unwrap_or(around.viewport.x);
        let height = self
            .length(node, "height", Along::Y, around)?
            .unwrap_or(around.viewport.y);
        if !matches!(node.attribute("overflow"), Some("visible" | "auto")) {
            self.builder
                .skip(SkippedKind::Attribute, "the clipping of a nested <svg>", node);
        }
        let frame = Frame {
            corner: DVec2::new(x, y),
            size: DVec2::new(width, height),
        };
        Ok(Some(frame).filter(|frame| frame.size.min_element() > 0.0))
    }
}
