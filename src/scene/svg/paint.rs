//! usvg's tree as primitives: groups become layers where they must, paths become areas.

use glam::DAffine2;
use roxmltree::Node;
use usvg::tiny_skia_path::Path as TheirPath;
use usvg::{ClipPath, Group, Image, ImageKind, ImageRendering, Path};

use super::affine::affine;
use super::own_triangles::{self, Drawn};
use super::painter::{Inside, Painter, Place};
use super::pictures::{self, Picture};
use super::{clip, reach, shapes};
use crate::color::BlendMode;
use crate::geometry::{CurvedArea, FillRule};
use crate::scene::build::{Edges, FilledArea, unit_square};
use crate::scene::error::Fault;
use crate::scene::triangles::{self, Element};
use crate::scene::{Composite, Fill, Paint};

/// Most samples along a path's longer side for which the edges of its curves are fine enough.
const MOST_SAMPLES: f64 = 1e8;

impl<'doc> Painter<'_, 'doc> {
    /// Paints a whole document.
    pub(super) fn tree(&mut self, tree: &usvg::Tree) -> Result<(), Fault> {
        self.servers.name(tree, self.elements);
        let shape = self.shape(self.root);
        let place = Place {
            to_user: DAffine2::IDENTITY,
            shape,
            opacity: 1.0,
        };
        if !has_blends(tree.root()) {
            return self.group(tree.root(), place);
        }
        // The root is an isolated group, too (Compositing and Blending 1, section 2.2): what lies below it is the paper, with which
        // nothing is blended by its own mode.
        self.on_layer(place, BlendMode::Normal, |painter, opaque| {
            painter.group(tree.root(), opaque)?;
            Ok(true)
        })
    }

    /// Paints something on a layer of its own, which then has the opacity of `place`. `paint` gets the same place without it, and says
    /// whether any of what it painted is left.
    fn on_layer(
        &mut self,
        place: Place,
        blend: BlendMode,
        paint: impl FnOnce(&mut Self, Place) -> Result<bool, Fault>,
    ) -> Result<(), Fault> {
        let mark = self.builder.mark();
        self.builder.begin_layer(place.shape)?;
        let is_left = paint(self, Place { opacity: 1.0, ..place })?;
        if !is_left || self.builder.is_empty_layer() {
            self.builder.take_back(mark);
            return Ok(());
        }
        let composite = Composite::Over {
            opacity: place.opacity,
            blend,
        };
        self.builder.end_layer(place.shape, composite)
    }

    /// Paints a group, on a layer of its own where that makes a difference.
    pub(super) fn group(&mut self, group: &Group, around: Place) -> Result<(), Fault> {
        let place = Place {
            to_user: around.to_user * affine(group.transform()),
            shape: self.owner(group, around.shape),
            opacity: around.opacity * group.opacity().get(),
        };
        if place.opacity <= 0.0 {
            return Ok(());
        }
        let is_using = self.begin_use(group);
        let painted = self.layered(group, place);
        if is_using {
            self.used.pop();
        }
        painted
    }

    fn layered(&mut self, group: &Group, place: Place) -> Result<(), Fault> {
        let clip = group.clip_path().filter(|clip| !self.is_idle(clip, group));
        if is_plain(group, clip) && (place.opacity >= 1.0 || is_single(group)) {
            return self.children(group, place);
        }
        self.on_layer(place, blend_mode(group.blend_mode()), |painter, opaque| {
            painter.children(group, opaque)?;
            Ok(!painter.builder.is_empty_layer() && painter.cut(clip, group, opaque)?)
        })
    }

    /// Whether a group's clip path takes nothing away, so that the group needs no layer for it.
    fn is_idle(&self, clip: &ClipPath, group: &Group) -> bool {
        self.effects.is_empty() && reach::is_idle(clip, group)
    }

    /// Cuts the layer that was begun last by a clip path and the group's mask; whether anything is left.
    fn cut(&mut self, clip: Option<&ClipPath>, group: &Group, place: Place) -> Result<bool, Fault> {
        if let Some(path) = clip
            && !clip::clip(self, path, place)?
        {
            return Ok(false);
        }
        match group.mask() {
            Some(mask) => clip::mask(self, mask, place),
            None => Ok(true),
        }
    }

    pub(super) fn children(&mut self, group: &Group, place: Place) -> Result<(), Fault> {
        let mut place = place;
        let around = place.shape;
        // The marks of the path before, which follow it.
        let mut marks = None;
        let mut marked = None;
        for node in group.children() {
            let before = marked.take();
            match node {
                usvg::Node::Group(group) => {
                    let shape = marks.filter(|_| group.id().is_empty()).unwrap_or(place.shape);
                    self.behind(before, group, Place { shape, ..place })?;
                }
                usvg::Node::Text(text) => {
                    let shape = self.leaf(text.id(), place.shape);
                    self.group(text.flattened(), Place { shape, ..place })?;
                }
                usvg::Node::Path(path) => {
                    let found = self.elements.find(path.id());
                    self.painting = found.or_else(|| self.used.last()?.left.last().copied());
                    marked = self.painting.map(|node| (node, path.data()));
                    place.shape = self.leaf(path.id(), around);
                    marks = found.and_then(|node| self.shape_of_marks(node));
                    self.path(path, place)?;
                }
                usvg::Node::Image(image) => self.image(image, place)?,
            }
        }
        Ok(())
    }

    /// Paints a group behind an outline, whose markers it may hold.
    fn behind(
        &mut self,
        outline: Option<(Node<'doc, 'doc>, &TheirPath)>,
        group: &Group,
        place: Place,
    ) -> Result<(), Fault> {
        let outline = outline.filter(|_| self.inside.is_none());
        let turns = outline.and_then(|(node, outline)| self.markers.turns(node, outline, group));
        let Some(turns) = turns else {
            return self.group(group, place);
        };
        for (marker, turn) in turns {
            let to_user = place.to_user * turn;
            self.group(marker, Place { to_user, ..place })?;
        }
        Ok(())
    }

    fn path(&mut self, path: &Path, place: Place) -> Result<(), Fault> {
        if !path.is_visible() {
            return Ok(());
        }
        if let Some(number) = own_triangles::number(path) {
            let drawn = self.inside.map(|inside| inside.triangles.get(number));
            let own = self.elements.triangles().get(number).copied();
            match (drawn, own) {
                (Some(Some(drawn)), _) => return self.drawn_triangle(drawn.as_ref(), place),
                (None, Some(node)) => return self.own_triangle(node, place),
                _ => {}
            }
        }
        match path.paint_order() {
            usvg::PaintOrder::FillAndStroke => {
                self.fill(path, place)?;
                self.stroke(path, place)
            }
            usvg::PaintOrder::StrokeAndFill => {
                self.stroke(path, place)?;
                self.fill(path, place)
            }
        }
    }

    /// A triangle of the course, wherever it is shown; what is wrong with it is told once.
    fn own_triangle(&mut self, node: Node<'doc, 'doc>, place: Place) -> Result<(), Fault> {
        let element = Element {
            node,
            shape: place.shape,
            to_user: place.to_user,
        };
        let is_told = !self.told.insert(node.id());
        let report = is_told.then(|| std::mem::take(&mut self.builder.report));
        let painted = match node.tag_name().name() {
            "colortri" => triangles::colortri(self.builder, element, place.opacity),
            _ => triangles::textri(self.builder, element, &self.texture_files, place.opacity),
        };
        if let Some(report) = report {
            self.builder.report = report;
        }
        painted
    }

    /// One of a document inside an image.
    fn drawn_triangle(&mut self, drawn: Option<&Drawn>, place: Place) -> Result<(), Fault> {
        let Some((points, paint)) = drawn else {
            return Ok(());
        };
        let points = points.map(|point| place.to_user.transform_point2(point));
        let opacity = place.opacity;
        let paint = match *paint {
            Paint::Solid(color) => Paint::Solid(color.faded(opacity)),
            Paint::Vertex(colors) => Paint::Vertex(colors.map(|color| color.faded(opacity))),
            Paint::Texture { texture, uv, .. } => Paint::Texture { texture, uv, opacity },
        };
        self.builder.triangle(place.shape, points, paint)
    }

    fn fill(&mut self, path: &Path, place: Place) -> Result<(), Fault> {
        let Some(fill) = path.fill() else {
            return Ok(());
        };
        let opacity = fill.opacity().get() * place.opacity;
        if let Some(paint) = self.server(fill.paint(), Place { opacity, ..place })? {
            self.area(path, fill.rule(), paint, place)?;
        }
        Ok(())
    }

    /// Fills the inside of a path.
    pub(super) fn area(&mut self, path: &Path, rule: usvg::FillRule, fill: Fill, place: Place) -> Result<(), Fault> {
        let bounds = path.data().bounds();
        // What is flat has no inside.
        if bounds.width() <= 0.0 || bounds.height() <= 0.0 {
            return Ok(());
        }
        let edges = self.edges_for(path, place, 0.0);
        if let (Fill::Solid(color), Some(corners)) = (fill, shapes::triangle(path.data()).filter(|_| !edges.crisp)) {
            if color.a <= 0.0 {
                return Ok(());
            }
            let points = corners.map(|corner| place.to_user.transform_point2(corner));
            return self.builder.triangle(place.shape, points, Paint::Solid(color));
        }
        let rule = match rule {
            usvg::FillRule::NonZero => FillRule::NonZero,
            usvg::FillRule::EvenOdd => FillRule::EvenOdd,
        };
        let area = CurvedArea {
            path: shapes::path(path.data(), self.builder.element(place.shape)),
            stroke: None,
            to_user: place.to_user,
        };
        self.builder
            .fill_curved(place.shape, FilledArea { area, rule }, fill, edges)
    }

    fn stroke(&mut self, path: &Path, place: Place) -> Result<(), Fault> {
        let Some(stroke) = path.stroke() else {
            return Ok(());
        };
        let opacity = stroke.opacity().get() * place.opacity;
        let Some(paint) = self.server(stroke.paint(), Place { opacity, ..place })? else {
            return Ok(());
        };
        let line = shapes::path(path.data(), self.builder.element(place.shape));
        // In the shape's own coordinates its transform acts on the stroke too.
        let (line, to_user) = if self.is_stroked_in_place() {
            (line.transformed(place.to_user), DAffine2::IDENTITY)
        } else {
            (line, place.to_user)
        };
        let area = CurvedArea {
            path: line,
            stroke: Some(shapes::stroke(stroke)),
            to_user,
        };
        if let Some(stroke) = &area.stroke
            && stroke.is_too_fine(&area.path)
        {
            let node = self.painting.unwrap_or(self.root);
            let message = format!(
                "more than 200000 dashes; the line of this <{}> is drawn without gaps: make its dashes longer, or cut what lies outside of the picture",
                node.tag_name().name()
            );
            let location = self.builder.locate(node);
            self.builder.report.warn_once(location, &message);
        }
        let edges = self.edges_for(path, place, stroke.width().get());
        self.builder.fill_curved(
            place.shape,
            FilledArea {
                area,
                rule: FillRule::NonZero,
            },
            paint,
            edges,
        )
    }

    /// Whether the path that is painted is stroked where it lies on the canvas, so that no transform widens its line.
    fn is_stroked_in_place(&self) -> bool {
        self.inside.is_none() && self.painting.is_some_and(|node| self.effects.is_non_scaling(node))
    }

    /// What the edges of a path shall be like. Those of one that is so large that they would never end are coarser.
    fn edges_for(&self, path: &Path, place: Place, width: f32) -> Edges {
        let bounds = path.data().bounds();
        let sides = [bounds.left(), bounds.top(), bounds.right(), bounds.bottom(), width];
        let reach = sides.into_iter().map(|side| f64::from(side).abs()).fold(0.0, f64::max);
        let matrix = place.to_user.matrix2;
        let stretch = matrix.x_axis.length().max(matrix.y_axis.length());
        Edges {
            scale: self.scale.min(MOST_SAMPLES / (reach * stretch).max(f64::MIN_POSITIVE)),
            crisp: !path.rendering_mode().use_shape_antialiasing(),
        }
    }

    fn warn_once(&mut self, message: &str) {
        let location = self.builder.locate(self.root);
        if !self
            .builder
            .report
            .warnings
            .iter()
            .any(|warning| warning.message == message)
        {
            self.builder.report.warn(location, message.to_owned());
        }
    }

    fn image(&mut self, image: &Image, place: Place) -> Result<(), Fault> {
        if !image.is_visible() {
            return Ok(());
        }
        let pictures = self.pictures;
        match pictures::of(image, pictures) {
            Some(Picture::Texture(texture)) => {
                let texture = if is_pixelated(image.rendering_mode()) {
                    self.builder.textures.pixelated(*texture)
                } else {
                    *texture
                };
                let size = [image.size().width(), image.size().height()].map(f64::from);
                let unit_to_user = place.to_user * DAffine2::from_scale(size.into());
                for (points, uv) in unit_square(unit_to_user) {
                    let paint = Paint::Texture {
                        texture,
                        uv,
                        opacity: place.opacity,
                    };
                    self.builder.triangle(place.shape, points, paint)?;
                }
                Ok(())
            }
            Some(Picture::Document(tree, triangles)) => {
                let image = place.shape;
                let outer = self.inside.replace(Inside { image, triangles });
                let painted = self.nested(tree, place);
                self.inside = outer;
                painted
            }
            None => {
                if let ImageKind::SVG(_) = image.kind() {
                    return Ok(());
                }
                self.warn_once("a letter that is a picture is not drawn");
                Ok(())
            }
        }
    }

    /// A document in an image, which ends where its canvas does.
    fn nested(&mut self, tree: &usvg::Tree, place: Place) -> Result<(), Fault> {
        self.on_layer(place, BlendMode::Normal, |painter, opaque| {
            painter.group(tree.root(), opaque)?;
            if !painter.builder.is_empty_layer() {
                let [width, height] = [tree.size().width(), tree.size().height()];
                clip::to_box(painter, [0.0, 0.0, width, height], opaque)?;
            }
            Ok(true)
        })
    }
}

/// Whether texels shall be seen as they are, and not mixed.
fn is_pixelated(rendering: ImageRendering) -> bool {
    use ImageRendering::{CrispEdges, OptimizeSpeed, Pixelated};
    matches!(rendering, CrispEdges | OptimizeSpeed | Pixelated)
}

/// Whether a group does nothing but move, and fade, what is inside. What its filters would do is not done.
fn is_plain(group: &Group, clip: Option<&ClipPath>) -> bool {
    let blends = group.blend_mode() != usvg::BlendMode::Normal;
    !blends && !group.isolate() && clip.is_none() && group.mask().is_none()
}

/// Whether anything in a group is blended with what lies behind the group.
fn has_blends(group: &Group) -> bool {
    group.children().iter().any(|child| match child {
        usvg::Node::Group(group) => {
            let blends = group.blend_mode() != usvg::BlendMode::Normal;
            let is_open = group.opacity().get() >= 1.0 && is_plain(group, group.clip_path());
            blends || is_open && has_blends(group)
        }
        _ => false,
    })
}

/// Whether one thing is painted at most, so that it may be faded itself.
fn is_single(group: &Group) -> bool {
    let [child] = group.children() else {
        return group.children().is_empty();
    };
    match child {
        usvg::Node::Group(group) => is_plain(group, group.clip_path()) && is_single(group),
        usvg::Node::Path(path) => path.fill().is_none() || path.stroke().is_none(),
        usvg::Node::Text(text) => is_single(text.flattened()),
        usvg::Node::Image(image) => !matches!(image.kind(), ImageKind::SVG(_)),
    }
}

fn blend_mode(mode: usvg::BlendMode) -> BlendMode {
    use usvg::BlendMode as Theirs;
    match mode {
        // Not a mode of the specification; usvg makes none of it by itself.
        Theirs::Normal | Theirs::PlusLighter => BlendMode::Normal,
        Theirs::Multiply => BlendMode::Multiply,
        Theirs::Screen => BlendMode::Screen,
        Theirs::Overlay => BlendMode::Overlay,
        Theirs::Darken => BlendMode::Darken,
        Theirs::Lighten => BlendMode::Lighten,
        Theirs::ColorDodge => BlendMode::ColorDodge,
        Theirs::ColorBurn => BlendMode::ColorBurn,
        Theirs::HardLight => BlendMode::HardLight,
        Theirs::SoftLight => BlendMode::SoftLight,
        Theirs::Difference => BlendMode::Difference,
        Theirs::Exclusion => BlendMode::Exclusion,
        Theirs::Hue => BlendMode::Hue,
        Theirs::Saturation => BlendMode::Saturation,
        Theirs::Color => BlendMode::Color,
        Theirs::Luminosity => BlendMode::Luminosity,
    }
}
