//! The dialect `course`: what the reader of UC Berkeley's CS184 rasterizer assignment makes of a document.
//!
//! Width and height are the canvas and `viewBox` means nothing; strokes are hairlines; a rect without size is a
//! point; nothing but the transform is inherited; numbers are 32-bit floats, read as C reads them.

use glam::{DAffine2, DVec2};
use roxmltree::{Children, Node};
use svgtypes::Length;

use super::build::{Area, Builder, unit_square};
use super::error::Fault;
use super::report::quote;
use super::texture_files::TextureFiles;
use super::triangles::{self, Element};
use super::{Paint, PrimitiveKind, Problem, Skipped, SkippedKind, attributes, course_values, numbers, svg};
use crate::color::Rgba;
use crate::geometry::FillRule;

/// Elements that the course's reader draws or obeys.
pub(super) const ELEMENTS: [&str; 9] = [
    "g", "line", "polyline", "polygon", "rect", "image", "colortri", "textri", "texture",
];

/// Attributes that would change the picture in SVG and have no effect here.
const IGNORED: [&str; 9] = [
    "style",
    "stroke-dasharray",
    "class",
    "opacity",
    "clip-path",
    "mask",
    "filter",
    "display",
    "visibility",
];

/// Attributes that SVG hands down from a group and this dialect does not.
const NOT_INHERITED: [&str; 4] = ["fill", "stroke", "fill-opacity", "stroke-opacity"];

/// Whether SVG draws the element otherwise: its strokes have a width, and more attributes count.
pub(super) fn is_read_otherwise(node: Node<'_, '_>) -> bool {
    let name = node.tag_name().name();
    let has_stroke = node.attribute("stroke").is_some_and(|stroke| stroke.trim() != "none");
    let is_group = name == "g";
    name == "polyline"
        || has_stroke && !is_group
        || IGNORED.iter().any(|attribute| node.has_attribute(*attribute))
        || is_group && NOT_INHERITED.iter().any(|attribute| node.has_attribute(*attribute))
        || is_round(node)
}

/// Whether this is a `defs` with nothing to draw: textures are read wherever they stand.
fn holds_textures_alone(node: Node<'_, '_>) -> bool {
    let mut inside = node.descendants().skip(1).filter(Node::is_element);
    node.tag_name().name() == "defs"
        && inside.all(|node| matches!(node.tag_name().name(), "texture" | "g") || attributes::is_silent(node))
}

/// Whether SVG would show another part of the drawing than a canvas of this size does.
fn is_another_view(view_box: &str, canvas: DVec2) -> bool {
    let numbers = numbers::all("viewBox", view_box).unwrap_or_default();
    let [x, y, width, height] = numbers.as_slice() else {
        return false;
    };
    let has_area = *width > 0.0 && *height > 0.0;
    let [corner, size] = [[*x, *y], [*width, *height]].map(|pair| DVec2::from(pair.map(f64::from)));
    has_area && (corner != DVec2::ZERO || size != canvas)
}

/// Tells once of the dialect that draws what was left out here, if it does.
pub(super) fn tell_of_svg(builder: &mut Builder<'_>, root: Node<'_, '_>) {
    let is_drawn = |skipped: &Skipped| match skipped.kind {
        SkippedKind::Element => svg::is_understood(&skipped.name),
        SkippedKind::Attribute => &*skipped.name != triangles::ALPHA,
    };
    if builder.report.skipped.iter().any(is_drawn) {
        let message = "the dialect svg draws what is left out here (--dialect svg)";
        builder.warn(root, message.to_owned());
    }
}

/// Whether a rect asks for round corners.
fn is_round(node: Node<'_, '_>) -> bool {
    node.tag_name().name() == "rect" && ["rx", "ry"].iter().any(|name| node.has_attribute(*name))
}

/// Reads one document.
#[derive(Debug)]
pub(super) struct CourseReader<'a, 'doc> {
    builder: &'a mut Builder<'doc>,
    texture_files: TextureFiles<'doc>,
}

impl<'a, 'doc> CourseReader<'a, 'doc> {
    /// Reads everything below `root` and answers with the canvas.
    pub(super) fn read(builder: &'a mut Builder<'doc>, root: Node<'doc, 'doc>) -> Result<DVec2, Fault> {
        let mut reader = Self {
            builder,
            texture_files: TextureFiles::below(root),
        };
        let canvas = reader.canvas(root)?;
        reader.groups(root)?;
        Ok(canvas)
    }

    /// Width and height; tells of a `viewBox` that SVG would scale to them.
    fn canvas(&mut self, root: Node<'doc, 'doc>) -> Result<DVec2, Fault> {
        let canvas = self.point(root, ["width", "height"])?;
        let text = root.attribute("viewBox").unwrap_or("");
        if is_another_view(text, canvas) {
            let message = format!(
                "viewBox=\"{}\" has no effect; the dialect svg scales to it (--dialect svg)",
                quote(text)
            );
            self.builder.warn(root, message);
        }
        Ok(canvas)
    }

    /// Walks the tree without recursion, so that no nesting is too deep.
    fn groups(&mut self, root: Node<'doc, 'doc>) -> Result<(), Fault> {
        let mut open: Vec<(Children<'doc, 'doc>, DAffine2)> = vec![(root.children(), DAffine2::IDENTITY)];
        while let Some((children, to_user)) = open.last_mut() {
            let to_user = *to_user;
            let Some(node) = children.next() else {
                open.pop();
                continue;
            };
            if !node.is_element() || attributes::is_silent(node) {
                continue;
            }
            let name = node.tag_name().name();
            if holds_textures_alone(node) {
                continue;
            }
            if !ELEMENTS.contains(&name) {
                self.builder.skip(SkippedKind::Element, name, node);
                continue;
            }
            self.report_ignored(node);
            let drawn = self.transform(node).and_then(|own| match name {
                "g" => {
                    open.push((node.children(), to_user * own));
                    Ok(())
                }
                "texture" => Ok(()),
                _ => self.element(node, to_user * own),
            });
            drawn.or_else(|fault| self.not_drawn(fault))?;
        }
        Ok(())
    }

    /// Tells of an element that a number without end keeps from being drawn, with all that is inside; other faults are those of the
    /// document. Such numbers are found before anything of an element is drawn.
    fn not_drawn(&mut self, fault: Fault) -> Result<(), Fault> {
        match (fault.location, &fault.problem) {
            (Some(place), Problem::NotFinite { .. } | Problem::TooLarge { .. }) => {
                let message = format!("not drawn: {}", fault.problem);
                self.builder.report.warn(place, message);
                Ok(())
            }
            _ => Err(fault),
        }
    }

    fn report_ignored(&mut self, node: Node<'doc, 'doc>) {
        for attribute in node.attributes().filter(|a| a.namespace().is_none()) {
            let name = attribute.name();
            if IGNORED.contains(&name) {
                self.builder.skip(SkippedKind::Attribute, name, node);
            } else if node.tag_name().name() == "g" && NOT_INHERITED.contains(&name) {
                self.builder
                    .skip(SkippedKind::Attribute, &format!("{name} on <g>"), node);
            } else if matches!(name, "rx" | "ry") && is_round(node) {
                self.builder.skip(SkippedKind::Attribute, name, node);
            }
        }
    }

    fn element(&mut self, node: Node<'doc, 'doc>, to_user: DAffine2) -> Result<(), Fault> {
        let shape = self.builder.shape(node);
        let element = Element { node, shape, to_user };
        match node.tag_name().name() {
            "line" => self.line(element),
            "polyline" => self.polyline(element),
            "polygon" => self.polygon(element),
            "rect" => self.rect(element),
            "image" => self.image(element),
            "colortri" => triangles::colortri(self.builder, element, 1.0),
            _ => triangles::textri(self.builder, element, &self.texture_files, 1.0),
        }
    }

    fn line(&mut self, element: Element<'doc>) -> Result<(), Fault> {
        let stroke = self.stroke(element.node)?.unwrap_or(Rgba::TRANSPARENT);
        let from = self.point(element.node, ["x1", "y1"])?;
        let to = self.point(element.node, ["x2", "y2"])?;
        self.outline(element, &[from, to], stroke)
    }

    fn polyline(&mut self, element: Element<'doc>) -> Result<(), Fault> {
        let stroke = self.stroke(element.node)?.unwrap_or(Rgba::BLACK);
        let points = self.points(element.node)?;
        self.outline(element, &points, stroke)
    }

    fn polygon(&mut self, element: Element<'doc>) -> Result<(), Fault> {
        let Element { node, shape, to_user } = element;
        let fill = self.fill(node)?;
        let stroke = self.stroke(node)?.unwrap_or(Rgba::TRANSPARENT);
        let mut points = self.points(node)?;
        let area = Area {
            contours: std::slice::from_ref(&points),
            rule: FillRule::NonZero,
            to_user,
        };
        self.builder.fill(shape, &area, fill)?;
        points.extend(points.first().copied());
        self.outline(element, &points, stroke)
    }

    fn rect(&mut self, element: Element<'doc>) -> Result<(), Fault> {
        let Element { node, shape, to_user } = element;
        let fill = self.fill(node)?;
        let stroke = self.stroke(node)?.unwrap_or(Rgba::TRANSPARENT);
        let corner = self.point(node, ["x", "y"])?;
        let size = self.point(node, ["width", "height"])?;
        if size == DVec2::ZERO {
            if fill.a > 0.0 {
                let at = to_user.transform_point2(corner);
                self.builder.push(shape, PrimitiveKind::Point { at, color: fill })?;
            }
            return Ok(());
        }
        // The far corner is a sum of 32-bit floats there.
        let far = (corner.as_vec2() + size.as_vec2()).as_dvec2();
        let [p00, p11] = [corner, far];
        let [p10, p01] = [DVec2::new(far.x, corner.y), DVec2::new(corner.x, far.y)];
        let area = Area {
            // From here, so that its triangles meet where the course's do.
            contours: &[vec![p10, p11, p01, p00]],
            rule: FillRule::NonZero,
            to_user,
        };
        self.builder.fill(shape, &area, fill)?;
        self.outline(element, &[p00, p10, p11, p01, p00], stroke)
    }

    fn image(&mut self, element: Element<'doc>) -> Result<(), Fault> {
        let Element { node, shape, to_user } = element;
        let corner = self.point(node, ["x", "y"])?;
        let size = self.point(node, ["width", "height"])?;
        let location = self.builder.locate(node);
        let address = attributes::href(node).unwrap_or("");
        let texture = self.builder.textures.request(address, location);
        let square = to_user * DAffine2::from_scale_angle_translation(size, 0.0, corner);
        for (points, uv) in unit_square(square) {
            let paint = Paint::Texture {
                texture,
                uv,
                opacity: 1.0,
            };
            self.builder.triangle(shape, points, paint)?;
        }
        Ok(())
    }

    /// Hairlines from point to point.
    fn outline(&mut self, element: Element<'doc>, points: &[DVec2], color: Rgba) -> Result<(), Fault> {
        for ends in points.windows(2) {
            let ends = [ends[0], ends[1]].map(|point| element.to_user.transform_point2(point));
            self.builder.hairline(element.shape, ends, color)?;
        }
        Ok(())
    }

    /// `fill`: black when missing.
    fn fill(&mut self, node: Node<'doc, 'doc>) -> Result<Rgba, Fault> {
        match self.color(node, "fill", "fill-opacity")? {
            Some(color) => Ok(color),
            None => Ok(Rgba::BLACK.faded(self.opacity(node, "fill-opacity")?)),
        }
    }

    /// `stroke`, if there is one.
    fn stroke(&mut self, node: Node<'doc, 'doc>) -> Result<Option<Rgba>, Fault> {
        self.color(node, "stroke", "stroke-opacity")
    }

    fn color(&mut self, node: Node<'doc, 'doc>, name: &str, opacity: &str) -> Result<Option<Rgba>, Fault> {
        let Some(text) = node.attribute(name) else {
            return Ok(None);
        };
        let color = course_values::color(text);
        if !color.as_svg {
            let message = format!(
                "{name}=\"{}\" is read as #{:06x}; the dialect svg reads it as SVG does (--dialect svg)",
                quote(text),
                color.rgb
            );
            self.builder.warn(node, message);
        }
        let alpha = if color.none { 0.0 } else { self.opacity(node, opacity)? };
        Ok(Some(color.to_rgba().faded(alpha)))
    }

    fn opacity(&mut self, node: Node<'doc, 'doc>, name: &str) -> Result<f32, Fault> {
        let Some(text) = node.attribute(name) else {
            return Ok(1.0);
        };
        Ok(self.leading(node, name, text)?.unwrap_or(0.0).clamp(0.0, 1.0))
    }

    fn transform(&mut self, node: Node<'doc, 'doc>) -> Result<DAffine2, Fault> {
        let Some(text) = node.attribute("transform") else {
            return Ok(DAffine2::IDENTITY);
        };
        let (transform, trouble) = course_values::transform(text)
            .map_err(|problem| problem.at(self.builder.locate_attribute(node, "transform")))?;
        if let Some(trouble) = trouble {
            self.builder.warn(node, trouble);
        }
        Ok(transform)
    }

    fn points(&mut self, node: Node<'doc, 'doc>) -> Result<Vec<DVec2>, Fault> {
        let numbers = triangles::numbers(self.builder, node, "points")?;
        let (pairs, rest) = numbers.as_chunks::<2>();
        if !rest.is_empty() {
            let message = format!(
                "points holds {} numbers; the last one has no partner and is left out",
                numbers.len()
            );
            self.builder.warn(node, message);
        }
        Ok(pairs.iter().map(|&[x, y]| DVec2::new(x.into(), y.into())).collect())
    }

    fn point(&mut self, node: Node<'doc, 'doc>, names: [&str; 2]) -> Result<DVec2, Fault> {
        Ok(DVec2::new(self.number(node, names[0])?, self.number(node, names[1])?))
    }

    /// The number at the start of an attribute; 0 when there is none.
    fn number(&mut self, node: Node<'doc, 'doc>, name: &str) -> Result<f64, Fault> {
        let Some(text) = node.attribute(name) else {
            return Ok(0.0);
        };
        let number = self.leading(node, name, text)?;
        if number.is_none() {
            self.builder
                .warn(node, format!("{name}=\"{}\" is not a number; 0 is taken", quote(text)));
        }
        Ok(number.unwrap_or(0.0).into())
    }

    /// The number at the start of a text; tells where more follows than `px`.
    fn leading(&mut self, node: Node<'doc, 'doc>, name: &str, text: &str) -> Result<Option<f32>, Fault> {
        let number = numbers::leading(name, text);
        let number = number.map_err(|problem| problem.at(self.builder.locate_attribute(node, name)))?;
        if let Some(number) = number.filter(|_| !numbers::is_plain(text)) {
            let cure = if text.trim().parse::<Length>().is_ok() {
                "the dialect svg reads it as SVG does (--dialect svg)"
            } else {
                "write a number alone"
            };
            let message = format!("{name}=\"{}\" is read as {number}; {cure}", quote(text));
            self.builder.warn(node, message);
        }
        Ok(number)
    }
}
