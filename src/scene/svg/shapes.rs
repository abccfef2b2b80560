//! SVG's basic shapes and images, from attributes to primitives.

use glam::DVec2;
use roxmltree::Node;
use svgtypes::NumberListParser;

use super::outline::{self, Outline};
use super::style::Style;
use super::values::Along;
use super::viewport::Frame;
use super::{Element, Surroundings, SvgReader};
use crate::color::Rgba;
use crate::geometry::{FillRule, StrokeStyle, stroke_outline};
use crate::scene::build::{Area, unit_square};
use crate::scene::error::Fault;
use crate::scene::{Paint, attributes, triangles};

impl<'doc> SvgReader<'_, 'doc> {
    /// Draws a visible shape.
    pub(super) fn shape(&mut self, node: Node<'doc, 'doc>, around: &Surroundings, opacity: f32) -> Result<(), Fault> {
        let element = Element {
            node,
            shape: self.builder.shape(node),
            to_user: around.to_user,
        };
        let outline = match node.tag_name().name() {
            "colortri" => return triangles::colortri(self.builder, element, opacity),
            "textri" => return triangles::textri(self.builder, element, &self.texture_files, opacity),
            "image" => return self.image(element, around, opacity),
            "line" => Some(self.line(node, around)?),
            "rect" => self.rect(node, around)?,
            name => Some(Outline {
                points: self.points(node)?,
                closed: name == "polygon",
            }),
        };
        match outline {
            Some(outline) => self.paint(element, &outline, around, opacity),
            None => Ok(()),
        }
    }

    /// Fills and strokes an outline. Where both show through, they share a layer: the stroke hides the fill below it.
    fn paint(
        &mut self,
        element: Element<'doc>,
        outline: &Outline,
        around: &Surroundings,
        opacity: f32,
    ) -> Result<(), Fault> {
        let (fill, stroke) = (around.style.fill_color(), around.style.stroke_color());
        let both = fill.a > 0.0 && stroke.a > 0.0 && opacity < 1.0;
        let own_opacity = if both { 1.0 } else { opacity };
        if both {
            self.builder.begin_layer(element.shape)?;
        }
        let area = Area {
            contours: std::slice::from_ref(&outline.points),
            rule: around.style.fill_rule,
            to_user: element.to_user,
        };
        self.builder.fill(element.shape, &area, fill.faded(own_opacity))?;
        self.stroke(element, outline, around, stroke.faded(own_opacity))?;
        if both {
            self.builder.end_layer(element.shape, opacity)?;
        }
        Ok(())
    }

    fn stroke(
        &mut self,
        element: Element<'doc>,
        outline: &Outline,
        around: &Surroundings,
        color: Rgba,
    ) -> Result<(), Fault> {
        let Style {
            stroke_width,
            cap,
            join,
            miter_limit,
            ..
        } = around.style;
        let width = around.units().resolve(stroke_width, Along::Diagonal);
        if color.a <= 0.0 || width <= 0.0 {
            return Ok(());
        }
        let style = StrokeStyle {
            width,
            cap,
            join,
            miter_limit,
        };
        // In the shape's own coordinates, so that its transform acts on the stroke too.
        let area = Area {
            contours: &stroke_outline(&outline.points, outline.closed, &style),
            rule: FillRule::NonZero,
            to_user: element.to_user,
        };
        self.builder.fill(element.shape, &area, color)
    }

    fn line(&mut self, node: Node<'doc, 'doc>, around: &Surroundings) -> Result<Outline, Fault> {
        let from = self.point(node, ["x1", "y1"], around)?;
        let to = self.point(node, ["x2", "y2"], around)?;
        Ok(Outline {
            points: vec![from, to],
            closed: false,
        })
    }

    /// `None` if it has no area.
    fn rect(&mut self, node: Node<'doc, 'doc>, around: &Surroundings) -> Result<Option<Outline>, Fault> {
        let corner = self.point(node, ["x", "y"], around)?;
        let size = self.point(node, ["width", "height"], around)?;
        let rx = self.length(node, "rx", Along::X, around)?;
        let ry = self.length(node, "ry", Along::Y, around)?;
        if size.min_element() <= 0.0 {
            return Ok(None);
        }
        // One radius that is missing is like the other.
        let rounding = DVec2::new(rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0));
        let frame = Frame { corner, size };
        Ok(Some(outline::rect(frame, rounding.min(size / 2.0))))
    }

    fn point(&mut self, node: Node<'doc, 'doc>, names: [&str; 2], around: &Surroundings) -> Result<DVec2, Fault> {
        let x = self.length(node, names[0], Along::X, around)?;
        let y = self.length(node, names[1], Along::Y, around)?;
        Ok(DVec2::new(x.unwrap_or(0.0), y.unwrap_or(0.0)))
    }

    /// The pairs in `points`, up to the first that is none, as SVG wants it.
    fn points(&mut self, node: Node<'doc, 'doc>) -> Result<Vec<DVec2>, Fault> {
        let text = node.attribute("points").unwrap_or("");
        let mut numbers = Vec::new();
        let mut damaged = false;
        for number in NumberListParser::from(text) {
            match number {
                Ok(number) => numbers.push(number),
                Err(_) => damaged = true,
            }
        }
        let (pairs, odd) = numbers.as_chunks::<2>();
        if damaged {
            self.not_understood(node, "points", text)?;
        } else if !odd.is_empty() {
            self.builder.warn(
                node,
                "points holds an odd number of coordinates; the last has no effect".to_owned(),
            );
        }
        Ok(pairs.iter().copied().map(DVec2::from).collect())
    }

    fn image(&mut self, element: Element<'doc>, around: &Surroundings, opacity: f32) -> Result<(), Fault> {
        let node = element.node;
        let Some(address) = attributes::href(node) else {
            self.builder.warn(node, "not drawn: it has no href".to_owned());
            return Ok(());
        };
        let Some(texture) = triangles::texture(self.builder, node, address) else {
            return Ok(());
        };
        let corner = self.point(node, ["x", "y"], around)?;
        let width = self.length(node, "width", Along::X, around)?;
        let height = self.length(node, "height", Along::Y, around)?;
        let natural = self
            .builder
            .textures
            .size(texture)
            .map(|size| DVec2::new(size[0].into(), size[1].into()));
        let port = Frame {
            corner,
            size: image_size(width, height, natural),
        };
        if port.size.min_element() <= 0.0 {
            return Ok(());
        }
        let aspect = self.aspect(node)?;
        let content = Frame {
            corner: DVec2::ZERO,
            size: natural.unwrap_or(port.size),
        };
        let placed = port.fit(content, aspect);
        let whole = Frame {
            corner: placed.transform_point2(DVec2::ZERO),
            size: placed.transform_vector2(content.size),
        };
        // `slice` lets the image hang over: only what lies in the port is drawn.
        let visible = whole.intersection(port);
        let uv_of_visible = whole.unit_map().inverse() * visible.unit_map();
        for (points, uv) in unit_square(element.to_user * visible.unit_map()) {
            let uv = uv.map(|corner| uv_of_visible.transform_point2(corner.as_dvec2()).as_vec2());
            let paint = Paint::Texture { texture, uv, opacity };
            self.builder.triangle(element.shape, points, paint)?;
        }
        Ok(())
    }
}

/// The size of an image's box: what is missing follows from the natural size and its proportions.
fn image_size(width: Option<f64>, height: Option<f64>, natural: Option<DVec2>) -> DVec2 {
    let natural = natural.unwrap_or(DVec2::splat(64.0));
    match (width, height) {
        (Some(width), Some(height)) => DVec2::new(width, height),
        (Some(width), None) => natural * (width / natural.x),
        (None, Some(height)) => natural * (height / natural.y),
        (None, None) => natural,
    }
}
