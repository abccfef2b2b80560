//! The scene while it grows: shapes, primitives, textures and report, with their ceilings.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DAffine2, DVec2, Vec2};
use rayon::prelude::*;
use roxmltree::Node;

use super::document::{LineIndex, Source};
use super::error::Fault;
use super::textures::TextureTable;
use super::tiles;
use super::{
    Composite, Dialect, Fill, Gradient, Paint, Pattern, Primitive, PrimitiveKind, Problem, Progress, Report, Scene,
    SceneFiles, Shape, ShapeId, SkippedKind, SourceLocation,
};
use crate::color::Rgba;
use crate::geometry::{CurvedArea, FillRule, Polygon};

/// Most primitives of a scene, about 400 MB.
const MAX_PRIMITIVES: usize = 4_000_000;
/// Most points of all polygons together, about 400 MB with the frame's copy.
const MAX_POINTS: usize = 10_000_000;
/// Shapes and primitives between two looks at who waits for them.
const WATCHED: usize = 1024;
/// What of the time has passed before the first shape is read.
pub(super) const BEFORE_SHAPES: f64 = 0.4;
/// Areas with curves from which on their edges begin coarser, so that a crowd of small ones does not have more points than
/// that; and how much coarser at most. A view has finer ones made for what it shows.
const MANY_AREAS: f64 = 60_000.0;
const COARSEST: f64 = 1.0 / 64.0;
/// What is said where there would be more; and where it is letters that have them.
const TOO_MANY_POINTS: Problem = Problem::TooMany {
    what: "points of outlines",
    limit: MAX_POINTS,
};
const TOO_MANY_LETTERS: Problem = Problem::TooMany {
    what: "points of outlines, of which each letter of a text has some 50",
    limit: MAX_POINTS,
};
/// Most layers inside each other, those of clips and masks included: each takes memory in every tile.
const MAX_LAYERS: usize = 64;

/// A growing scene and the document it comes from.
#[derive(Debug)]
pub(super) struct Builder<'doc> {
    source: &'doc Source<'doc>,
    lines: &'doc LineIndex<'doc>,
    progress: &'doc Progress,
    pub(super) shapes: Vec<Shape>,
    pub(super) primitives: Vec<Primitive>,
    pub(super) textures: TextureTable<'doc>,
    pub(super) gradients: Vec<Gradient>,
    pub(super) patterns: Vec<Pattern>,
    pub(super) report: Report,
    primitives_left: usize,
    points_left: usize,
    open_layers: usize,
    /// Areas of primitives whose edges are yet to be found, all together and on all threads; in the order of primitives.
    waiting: Vec<Waiting>,
    /// Whether areas wait: those of scenes apart do not.
    waits: bool,
}

/// An area with curves, and the primitive that it is for.
#[derive(Debug)]
struct Waiting {
    primitive: usize,
    area: FilledArea,
    edges: Edges,
}

/// A state of a growing scene, to return to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mark {
    primitives: usize,
    open_layers: usize,
}

impl<'doc> Builder<'doc> {
    pub(super) fn new(
        source: &'doc Source<'doc>,
        lines: &'doc LineIndex<'doc>,
        textures: TextureTable<'doc>,
        progress: &'doc Progress,
    ) -> Self {
        Self {
            source,
            lines,
            progress,
            shapes: Vec::new(),
            primitives: Vec::new(),
            textures,
            gradients: Vec::new(),
            patterns: Vec::new(),
            report: Report::default(),
            primitives_left: MAX_PRIMITIVES,
            points_left: MAX_POINTS,
            open_layers: 0,
            waiting: Vec::new(),
            waits: true,
        }
    }

    /// Where an element's start tag begins.
    pub(super) fn locate(&self, node: Node<'_, '_>) -> SourceLocation {
        self.lines.locate(self.source.original_offset(node.range().start))
    }

    /// Where an attribute begins.
    pub(super) fn locate_attribute(&self, node: Node<'_, '_>, name: &str) -> SourceLocation {
        match node.attribute_node(name) {
            Some(attribute) => self.lines.locate(self.source.original_offset(attribute.range().start)),
            None => self.locate(node),
        }
    }

    /// Reports something that is not drawn.
    pub(super) fn skip(&mut self, kind: SkippedKind, name: &str, node: Node<'_, '_>) {
        let location = self.locate(node);
        self.report.skip(kind, name, location);
    }

    /// Reports something that was read differently from what the document says.
    pub(super) fn warn(&mut self, node: Node<'_, '_>, message: String) {
        let location = self.locate(node);
        self.report.warn(location, message);
    }

    /// The same of what stands at byte `at` of the parsed text.
    pub(super) fn warn_at(&mut self, at: usize, message: String) {
        let location = self.lines.locate(self.source.original_offset(at));
        self.report.warn(location, message);
    }

    /// Reports what of the document's style sheets has no effect.
    pub(super) fn tell_of_styles(&mut self) {
        for (at, message) in self.source.told() {
            self.report.warn(self.lines.locate(*at), message.clone());
        }
    }

    /// The shape of an element; what is pushed with it belongs to it.
    pub(super) fn shape(&mut self, node: Node<'_, '_>) -> ShapeId {
        self.shape_used(node, None)
    }

    /// As [`Builder::shape`], of an element that the `use` at `used` puts here.
    pub(super) fn shape_used(&mut self, node: Node<'_, '_>, used: Option<SourceLocation>) -> ShapeId {
        let shape = Shape {
            element: node.tag_name().name().into(),
            id: node.attribute("id").map(Into::into),
            location: self.locate(node),
            used,
        };
        self.shapes.push(shape);
        if self.shapes.len().is_multiple_of(WATCHED) {
            let at = node.range().start as f64 / self.source.text().len() as f64;
            self.progress.reach(BEFORE_SHAPES + (1.0 - BEFORE_SHAPES) * at);
        }
        // Shapes are fewer than nodes, and nodes are fewer than 2^32.
        ShapeId(u32::try_from(self.shapes.len() - 1).unwrap_or(u32::MAX))
    }

    /// The name of the element that a shape stands for.
    pub(super) fn element(&self, shape: ShapeId) -> &str {
        self.shapes.get(shape.0 as usize).map_or("", |shape| &*shape.element)
    }

    /// Adds a primitive whose coordinates lie in user space.
    pub(super) fn push(&mut self, shape: ShapeId, kind: PrimitiveKind) -> Result<(), Fault> {
        // Counted down, so that the tiles of patterns count too.
        let Some(left) = self.primitives_left.checked_sub(1) else {
            return Err(self.fault(
                shape,
                Problem::TooMany {
                    what: "primitives",
                    limit: MAX_PRIMITIVES,
                },
            ));
        };
        self.primitives_left = left;
        if left.is_multiple_of(WATCHED) {
            self.progress.go_on()?;
        }
        let points = match &kind {
            PrimitiveKind::Triangle { points, .. } => points.as_slice(),
            PrimitiveKind::Polygon { polygon, .. } => polygon.points(),
            PrimitiveKind::Hairline { ends, .. } => ends.as_slice(),
            PrimitiveKind::Point { at, .. } => std::slice::from_ref(at),
            PrimitiveKind::BeginLayer | PrimitiveKind::EndLayer { .. } => &[],
        };
        if !points.iter().all(|point| within_reach(*point)) {
            return Err(self.fault(shape, Problem::TooFar));
        }
        self.primitives.push(Primitive { shape, kind });
        Ok(())
    }

    /// What follows is painted on a layer of its own, until [`Builder::end_layer`].
    pub(super) fn begin_layer(&mut self, shape: ShapeId) -> Result<(), Fault> {
        self.open_layers += 1;
        if self.open_layers > MAX_LAYERS {
            let what = "layers (opacity, blend modes, clip paths, masks) inside each other";
            return Err(self.fault(
                shape,
                Problem::TooMany {
                    what,
                    limit: MAX_LAYERS,
                },
            ));
        }
        self.push(shape, PrimitiveKind::BeginLayer)
    }

    /// Ends the layer that was begun last; one that would be painted and has nothing on it vanishes.
    pub(super) fn end_layer(&mut self, shape: ShapeId, composite: Composite) -> Result<(), Fault> {
        self.open_layers = self.open_layers.saturating_sub(1);
        if matches!(composite, Composite::Over { .. }) && self.is_empty_layer() {
            self.primitives.pop();
            return Ok(());
        }
        self.push(shape, PrimitiveKind::EndLayer { composite })
    }

    /// Whether the layer that was begun last has nothing on it so far.
    pub(super) fn is_empty_layer(&self) -> bool {
        matches!(self.primitives.last(), Some(last) if last.kind == PrimitiveKind::BeginLayer)
    }

    /// Where the scene has come to.
    pub(super) fn mark(&self) -> Mark {
        Mark {
            primitives: self.primitives.len(),
            open_layers: self.open_layers,
        }
    }

    /// Takes back all primitives since `mark`.
    pub(super) fn take_back(&mut self, mark: Mark) {
        self.primitives.truncate(mark.primitives);
        let kept = self
            .waiting
            .partition_point(|waiting| waiting.primitive < mark.primitives);
        self.waiting.truncate(kept);
        self.open_layers = mark.open_layers;
    }

    /// Adds a triangle.
    pub(super) fn triangle(&mut self, shape: ShapeId, points: [DVec2; 3], paint: Paint) -> Result<(), Fault> {
        self.push(shape, PrimitiveKind::Triangle { points, paint })
    }

    /// Adds a hairline, unless it cannot be seen.
    pub(super) fn hairline(&mut self, shape: ShapeId, ends: [DVec2; 2], color: Rgba) -> Result<(), Fault> {
        if color.a <= 0.0 {
            return Ok(());
        }
        self.push(shape, PrimitiveKind::Hairline { ends, color })
    }

    /// Fills closed contours, unless the fill cannot be seen.
    pub(super) fn fill(&mut self, shape: ShapeId, area: &Area<'_>, color: Rgba) -> Result<(), Fault> {
        if color.a <= 0.0 {
            return Ok(());
        }
        let place = |point: &DVec2| area.to_user.transform_point2(*point);
        if let [contour] = area.contours
            && let [a, b, c, closing @ ..] = contour.as_slice()
            && (closing.is_empty() || closing == [*a])
        {
            return self.triangle(shape, [a, b, c].map(place), Paint::Solid(color));
        }
        let polygon = Polygon::new(area.contours.iter().map(|contour| contour.iter().map(place)), area.rule);
        self.polygon(shape, polygon, Fill::Solid(color))
    }

    /// Fills an area with curves.
    pub(super) fn fill_curved(
        &mut self,
        shape: ShapeId,
        area: FilledArea,
        fill: Fill,
        edges: Edges,
    ) -> Result<(), Fault> {
        if matches!(fill, Fill::Solid(color) if color.a <= 0.0) {
            return Ok(());
        }
        if !self.waits {
            return self.polygon(shape, edges.polygon(area), fill);
        }
        let rule = area.rule;
        self.waiting.push(Waiting {
            primitive: self.primitives.len(),
            area,
            edges,
        });
        let polygon = Arc::new(Polygon::new([[]; 0], rule));
        self.push(shape, PrimitiveKind::Polygon { polygon, fill })
    }

    /// Finds the edges of all areas that wait; what turns out to cover nothing is dropped.
    pub(super) fn find_edges(&mut self) -> Result<(), Fault> {
        let left = AtomicUsize::new(self.points_left);
        // The points of a curve are as many as the root of the scale that they are fine enough for.
        let part = MANY_AREAS / self.waiting.len().max(1) as f64;
        let coarser = part.powi(2).clamp(COARSEST, 1.0);
        let found: Vec<(usize, Result<Polygon, Problem>)> = std::mem::take(&mut self.waiting)
            .into_par_iter()
            .map(|mut waiting| {
                waiting.edges.scale *= coarser;
                (waiting.primitive, waiting.polygon(&left))
            })
            .collect();
        self.points_left = left.into_inner();
        let mut is_any_empty = false;
        for (index, polygon) in found {
            let polygon = polygon.map_err(|problem| self.fault(self.primitives[index].shape, problem))?;
            is_any_empty |= polygon.points().is_empty();
            if let PrimitiveKind::Polygon { polygon: empty, .. } = &mut self.primitives[index].kind {
                *empty = Arc::new(polygon);
            }
        }
        if is_any_empty {
            let covers = |primitive: &Primitive| !matches!(&primitive.kind, PrimitiveKind::Polygon { polygon, .. } if polygon.points().is_empty());
            self.primitives.retain(covers);
        }
        Ok(())
    }

    fn polygon(&mut self, shape: ShapeId, polygon: Polygon, fill: Fill) -> Result<(), Fault> {
        if polygon.points().is_empty() {
            return Ok(());
        }
        let Some(left) = self.points_left.checked_sub(polygon.points().len()) else {
            return Err(self.fault(shape, TOO_MANY_POINTS));
        };
        self.points_left = left;
        let polygon = Arc::new(polygon);
        self.push(shape, PrimitiveKind::Polygon { polygon, fill })
    }

    /// What is drawn by `draw`, as a scene of its own with a canvas of this size. Its textures are still missing.
    pub(super) fn apart(
        &mut self,
        canvas: DVec2,
        draw: impl FnOnce(&mut Self) -> Result<(), Fault>,
    ) -> Result<Scene, Fault> {
        let mut scene = Scene::empty(canvas, Dialect::Svg);
        let layers = std::mem::take(&mut self.open_layers);
        let waits = std::mem::take(&mut self.waits);
        // Numbers of primitives are those of one scene.
        let waiting = std::mem::take(&mut self.waiting);
        self.exchange(&mut scene);
        let drawn = draw(self);
        self.exchange(&mut scene);
        (self.open_layers, self.waits, self.waiting) = (layers, waits, waiting);
        drawn.map(|()| scene)
    }

    fn exchange(&mut self, scene: &mut Scene) {
        std::mem::swap(&mut self.shapes, &mut scene.shapes);
        std::mem::swap(&mut self.primitives, &mut scene.primitives);
        std::mem::swap(&mut self.gradients, &mut scene.gradients);
        std::mem::swap(&mut self.patterns, &mut scene.patterns);
    }

    /// The scene, once its textures are loaded.
    pub(super) fn finish(mut self, dialect: Dialect, canvas: DVec2) -> Scene {
        let files = SceneFiles {
            textures: self.textures.digests(),
            ..SceneFiles::default()
        };
        if let Some((shape, message)) = tiles::too_large(&self.patterns)
            && let Some(shape) = self.shapes.get(shape.0 as usize)
        {
            self.report.warn(shape.location, message);
        }
        let textures = self.textures.load(&mut self.report);
        if !textures.is_empty() {
            tiles::hand_down(&mut self.patterns, &textures);
        }
        Scene {
            name: Arc::default(),
            canvas,
            dialect,
            other_reading: None,
            words: None,
            shapes: self.shapes,
            primitives: self.primitives,
            textures,
            gradients: self.gradients,
            patterns: self.patterns,
            report: self.report,
            document: None,
            files,
        }
    }

    fn fault(&self, shape: ShapeId, problem: Problem) -> Fault {
        let problem = match problem {
            Problem::TooMany { limit: MAX_POINTS, .. } if self.element(shape) == "text" => TOO_MANY_LETTERS,
            problem => problem,
        };
        match self.shapes.get(shape.0 as usize) {
            Some(shape) => problem.at(shape.location),
            None => problem.nowhere(),
        }
    }
}

/// An area with curves, and which of its parts count as inside.
#[derive(Clone, Debug)]
pub(super) struct FilledArea {
    pub(super) area: CurvedArea,
    pub(super) rule: FillRule,
}

/// What the edges of an area shall be like.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edges {
    /// Samples per canvas unit for which they are fine enough.
    pub(super) scale: f64,
    /// Whether whole pixels are covered: those whose middles are inside.
    pub(super) crisp: bool,
}

impl Edges {
    /// The polygon that an area with curves becomes.
    fn polygon(self, filled: FilledArea) -> Polygon {
        let polygon = Polygon::curved(filled.area, filled.rule, self.scale);
        if self.crisp {
            polygon.with_crisp_edges()
        } else {
            polygon
        }
    }
}

impl Waiting {
    /// Its polygon, whose points are taken from what is `left`; once that is too little, no more is looked for.
    fn polygon(self, left: &AtomicUsize) -> Result<Polygon, Problem> {
        if left.load(Ordering::Relaxed) == 0 {
            return Err(TOO_MANY_POINTS);
        }
        let polygon = self.edges.polygon(self.area);
        let count = polygon.points().len();
        let taken = left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(count));
        if taken.is_err() {
            left.store(0, Ordering::Relaxed);
            return Err(TOO_MANY_POINTS);
        }
        if polygon.points().iter().all(|point| within_reach(*point)) {
            Ok(polygon)
        } else {
            Err(Problem::TooFar)
        }
    }
}

/// What a fill covers.
pub(super) struct Area<'a> {
    /// Closed contours in the shape's own coordinates.
    pub(super) contours: &'a [Vec<DVec2>],
    /// Which regions lie inside.
    pub(super) rule: FillRule,
    /// The shape's own coordinates to user space.
    pub(super) to_user: DAffine2,
}

/// Whether both coordinates are within the range of 32-bit floats, which also says that they are finite.
fn within_reach(point: DVec2) -> bool {
    point.abs().max_element() <= f64::from(f32::MAX) && point.is_finite()
}

/// Two triangles that cover the parallelogram of the unit square under `unit_to_user`, with the square's coordinates
/// as texture coordinates.
pub(super) fn unit_square(unit_to_user: DAffine2) -> [([DVec2; 3], [Vec2; 3]); 2] {
    let corners = [[DVec2::ZERO, DVec2::X, DVec2::Y], [DVec2::Y, DVec2::X, DVec2::ONE]];
    corners.map(|uv| {
        (
            uv.map(|corner| unit_to_user.transform_point2(corner)),
            uv.map(DVec2::as_vec2),
        )
    })
}
