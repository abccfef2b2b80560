//! Pixels drawn again, one by one: what painted each, op by op, and the shapes that did.

use std::collections::HashSet;

use glam::DVec2;
use rayon::prelude::*;

use super::{Screen, Subject, add, number, picture_list, raster_settings, sources};
use crate::color::Rgba;
use crate::geometry::{FillRule, Polygon, area_in_pixel, cut_to_window};
use crate::raster::{
    ChunkBuilder, DisplayList, Hidden, ListContext, PaintedCommand, PaintedKind, Piece, PieceShape, PixelReplay,
    RasterSettings, Region, SampleOfTriangle,
};
use crate::scene::{Fill, Paint, Primitive, PrimitiveKind, Scene};

/// Whether a primitive is shaded and lets what is below it shine through.
pub(super) fn shines_through(scene: &Scene, kind: &PrimitiveKind) -> bool {
    match kind {
        PrimitiveKind::Triangle {
            paint: Paint::Texture { texture, opacity, .. },
            ..
        } => *opacity < 1.0 || !scene.textures[texture.0 as usize].pyramid.is_opaque(),
        PrimitiveKind::Triangle {
            paint: Paint::Vertex(colors),
            ..
        } => colors.iter().any(|color| color.a < 1.0),
        PrimitiveKind::Polygon {
            fill: Fill::Gradient(gradient),
            ..
        } => {
            let gradient = &scene.gradients[gradient.0 as usize];
            !gradient.geometry.is_everywhere() || !gradient.ramp.is_opaque()
        }
        PrimitiveKind::Polygon {
            fill: Fill::Pattern(_), ..
        } => true,
        _ => false,
    }
}

/// The contours of a polygon in screen space.
pub(super) fn placed<'p>(
    polygon: &'p Polygon,
    screen: &'p Screen<'_>,
) -> impl Iterator<Item = impl Iterator<Item = DVec2> + use<'p>> + use<'p> {
    let contours = polygon.contours();
    contours.map(|contour| contour.iter().map(|point| screen.place(*point)))
}

/// Draws a pixel of a frame of `size` pixels again, by the same code as the frame; `None` outside the frame.
///
/// Sources are indices into [`crate::scene::Scene::primitives`], or the number of primitives for the canvas outline. Only
/// ops that touch samples of the pixel are told, and the layers that hold any of them. It is the picture that is told of,
/// whatever the settings show instead.
pub fn replay(subject: &Subject<'_>, size: [u32; 2], pixel: [u32; 2]) -> Option<PixelReplay> {
    Neighbourhood::new(*subject, size, Region::of_pixel(pixel)).replay(pixel)
}

/// A sample that edges in 32-bit floats leave open.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenSample {
    /// Its number.
    pub sample: usize,
    /// The primitive that it is part of.
    pub source: u32,
    /// The corners of its triangle, in pixels of the frame.
    pub corners: [DVec2; 3],
    /// What it sees of that triangle.
    pub view: SampleOfTriangle,
}

/// Some pixels of a picture that are drawn again, each alone: what is far from all of them was left out once.
#[derive(Debug)]
pub struct Neighbourhood<'a> {
    subject: Subject<'a>,
    size: [u32; 2],
    region: Region,
    list: DisplayList<'a>,
}

impl<'a> Neighbourhood<'a> {
    /// The pixels of `region` in a frame of `size` pixels.
    pub fn new(subject: Subject<'a>, size: [u32; 2], region: Region) -> Self {
        /// Corners are snapped by far less than this, in pixels.
        const SNAP: f64 = 1.0;
        let beside = SNAP + subject.settings.margin();
        let screen = Screen::new(subject.view, subject.settings, size);
        let low = DVec2::new(f64::from(region.x), f64::from(region.y));
        let size_of = DVec2::new(f64::from(region.width), f64::from(region.height));
        let near = [low - beside, low + size_of + beside];
        // One translucent shaded primitive anywhere makes all shaded ones blend sample by sample.
        let wanted = |kind: &PrimitiveKind| {
            shines_through(subject.scene, kind) || bounds(&screen, kind).is_none_or(|bounds| touch(bounds, near))
        };
        Self {
            list: picture_list(&subject, size, Hidden::Kept, wanted),
            subject,
            size,
            region,
        }
    }

    /// What [`replay`] tells of one of the pixels; `None` outside the region or the frame.
    pub fn replay(&self, [x, y]: [u32; 2]) -> Option<PixelReplay> {
        let Region {
            x: left,
            y: top,
            width,
            height,
        } = self.region;
        let inside = x.checked_sub(left)? < width && y.checked_sub(top)? < height;
        let mut pixel = self.list.replay(x, y).filter(|_| inside)?;
        drop_what_paints_nothing(&mut pixel.painted);
        Some(pixel)
    }

    /// Looks at what painted one of the pixels.
    pub fn explainer(&self, pixel: [u32; 2]) -> Explainer<'a> {
        Explainer::new(self.subject, self.size, pixel)
    }

    /// How much there is to look at for each pixel.
    pub fn ops(&self) -> usize {
        self.list.commands()
    }
}

/// Keeps the ops that paint samples, and the beginning of each layer whose end does.
fn drop_what_paints_nothing(painted: &mut Vec<PaintedCommand>) {
    let mut kept = vec![true; painted.len()];
    let mut open: Vec<(usize, bool)> = Vec::new();
    for (i, op) in painted.iter().enumerate() {
        let used = match op.kind {
            PaintedKind::Primitive => {
                kept[i] = op.count > 0;
                kept[i]
            }
            PaintedKind::BeginLayer => {
                open.push((i, false));
                false
            }
            PaintedKind::EndLayer(compositing) => match open.pop() {
                Some((begin, used)) if compositing.keeps_below() => {
                    (kept[begin], kept[i]) = (used, used);
                    used
                }
                Some((begin, _)) => {
                    // Clip paths and masks act on what was painted in the layer around them; without a shape they take it
                    // all away.
                    if open.last().is_some_and(|(_, any)| *any) {
                        (kept[begin], kept[i]) = (true, true);
                    } else {
                        kept[begin..=i].fill(false);
                    }
                    false
                }
                None => false,
            },
        };
        if let Some((_, any)) = open.last_mut() {
            *any |= used;
        }
    }
    let mut kept = kept.into_iter();
    painted.retain(|_| kept.next().unwrap_or(true));
}

/// A primitive that covers a part of the pixel and none of its samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MissedPrimitive {
    /// Index into the scene's primitives.
    pub source: u32,
    /// The part of the pixel that it covers in truth, `0.0..=1.0`.
    pub area: f64,
    /// Whether it is a part of a clip path or mask.
    pub in_mask: bool,
}

/// Looks at single primitives from one pixel: builds them anew, with all that a display list of many drops.
#[derive(Debug)]
pub struct Explainer<'a> {
    pub(super) subject: Subject<'a>,
    pub(super) context: ListContext,
    raster: RasterSettings,
    pub(super) pixel: [u32; 2],
}

impl<'a> Explainer<'a> {
    /// For a pixel of a frame of `size` pixels, which must lie in it.
    pub fn new(subject: Subject<'a>, size: [u32; 2], pixel: [u32; 2]) -> Self {
        let raster = raster_settings(subject.settings);
        Self {
            subject,
            context: ListContext::new(size, &raster),
            raster,
            pixel,
        }
    }

    /// For each op that was painted the shape that did, as the samples see it; `None` for layers and the outline of the
    /// canvas.
    pub fn pieces(&self, painted: &[PaintedCommand]) -> Vec<Option<Piece>> {
        let mut pieces = Vec::new().into_iter();
        let mut source = None;
        let piece = |op: &PaintedCommand| {
            if op.kind != PaintedKind::Primitive {
                source = None;
                return None;
            }
            // The ops of one primitive come one after the other.
            if source != Some(op.source) {
                source = Some(op.source);
                pieces = self.pieces_of(op.source).into_iter();
            }
            pieces.next()
        };
        painted.iter().map(piece).collect()
    }

    /// The parts of a primitive that touch samples of the pixel, in painter's order.
    fn pieces_of(&self, source: u32) -> Vec<Piece> {
        let Some(primitive) = self.subject.scene.primitives.get(source as usize) else {
            return Vec::new();
        };
        let (list, mut pieces) = self.all_pieces_of(primitive);
        let [x, y] = self.pixel;
        let painted = list.painted(x, y);
        let touched = |piece: &Piece| painted.iter().any(|op| piece.is_of(op) && !op.fragments.is_empty());
        pieces.retain(touched);
        pieces
    }

    /// The display list of a single primitive, and its parts, near the pixel or not.
    pub(super) fn all_pieces_of(&self, primitive: &Primitive) -> (DisplayList<'a>, Vec<Piece>) {
        let chunk = |primitive: &Primitive| {
            let mut builder = ChunkBuilder::new(&self.context, 1).with_all_shapes();
            builder.set_source(number(0));
            add(&mut builder, &self.screen(), &primitive.kind);
            builder.finish()
        };
        let weights = chunk(&weighted(primitive));
        let sources = sources(self.subject.scene, self.subject.view, self.subject.settings);
        let list = DisplayList::new(self.context, self.raster, vec![chunk(primitive)], sources);
        let pieces = list.pieces(self.pixel, &weights);
        (list, pieces)
    }

    /// The samples of the pixel that are a triangle's by exact edges and not by edges in 32-bit floats, where that triangle
    /// would be seen: `opaque` says for each sample which primitive hides all that lies below it. At most one for each sample.
    pub fn left_open(&self, opaque: &[Option<u32>]) -> Vec<OpenSample> {
        let mut open: Vec<Option<OpenSample>> = vec![None; opaque.len()];
        let below = opaque.iter().min().copied().flatten();
        let below = below.map_or(0, |opaque| opaque as usize + 1);
        let primitives = self.subject.scene.primitives.iter().enumerate().skip(below).rev();
        for (index, primitive) in primitives.filter(|(_, primitive)| self.is_near(&primitive.kind)) {
            let source = number(index);
            for piece in self.all_pieces_of(primitive).1 {
                let PieceShape::Triangle { corners, samples, .. } = piece.shape else {
                    continue;
                };
                for (sample, view) in samples.into_iter().enumerate() {
                    let shows = opaque[sample].is_none_or(|opaque| opaque < source);
                    if shows && open[sample].is_none() && view.is_left_open() {
                        open[sample] = Some(OpenSample {
                            sample,
                            source,
                            corners,
                            view,
                        });
                    }
                }
            }
            if open.iter().all(Option::is_some) {
                break;
            }
        }
        open.into_iter().flatten().collect()
    }

    pub(super) fn screen(&self) -> Screen<'_> {
        Screen::new(self.subject.view, self.subject.settings, self.context.size)
    }

    /// The part of the pixel that a primitive covers in truth, `0.0..=1.0`, before it is snapped and sampled; `None` for
    /// primitives that have no area of their own, and polygons too tangled to be measured.
    pub fn area(&self, source: u32) -> Option<f64> {
        self.area_of(&self.subject.scene.primitives.get(source as usize)?.kind)
    }

    fn area_of(&self, kind: &PrimitiveKind) -> Option<f64> {
        let screen = self.screen();
        let area = |points: &[DVec2; 3]| area_in_pixel(points.map(|point| screen.place(point)), self.pixel);
        match kind {
            PrimitiveKind::Triangle { points, .. } => Some(area(points)),
            PrimitiveKind::Polygon { polygon, .. } => {
                let corner = DVec2::from(self.pixel.map(f64::from));
                let inside =
                    |polygon: &Polygon| cut_to_window(placed(polygon, &screen), polygon.rule(), [corner, corner + 1.0]);
                // Each part is rounded; together they cannot be more than all of it.
                screen.with_true_edges(polygon, |polygon| Some(inside(polygon).area()?.min(1.0)))
            }
            PrimitiveKind::Hairline { .. }
            | PrimitiveKind::Point { .. }
            | PrimitiveKind::BeginLayer
            | PrimitiveKind::EndLayer { .. } => None,
        }
    }

    /// The part of the pixel that lies in both of two primitives, by the areas of both, and of what lies in one of them only; `None`
    /// where one has no area of its own, and for polygons too tangled to be measured.
    pub fn overlap(&self, sources: [u32; 2]) -> Option<f64> {
        let [a, b] = [self.area(sources[0])?, self.area(sources[1])?];
        let screen = self.screen();
        let corner = DVec2::from(self.pixel.map(f64::from));
        let mut contours: Vec<Vec<DVec2>> = Vec::new();
        for source in sources {
            match &self.subject.scene.primitives.get(source as usize)?.kind {
                PrimitiveKind::Triangle { points, .. } => {
                    contours.push(points.map(|point| screen.place(point)).to_vec());
                }
                PrimitiveKind::Polygon { polygon, .. } => screen.with_true_edges(polygon, |polygon| {
                    contours.extend(placed(polygon, &screen).map(Iterator::collect));
                }),
                _ => return None,
            }
        }
        let contours = contours.iter().map(|contour| contour.iter().copied());
        let in_one = cut_to_window(contours, FillRule::EvenOdd, [corner, corner + 1.0]).area()?;
        Some((a + b - in_one) / 2.0)
    }

    /// Primitives that cover parts of the pixel and none of its samples. At most `most` of them.
    pub fn missed(&self, painted: &[PaintedCommand], most: usize) -> Vec<MissedPrimitive> {
        /// Less than this is rounding.
        const LEAST: f64 = 1e-9;
        let masks = self.subject.scene.parts_of_masks();
        let primitives = self.subject.scene.primitives.par_iter().enumerate();
        let near = primitives.filter(|(_, primitive)| self.is_near(&primitive.kind));
        let hits: HashSet<u32> = painted.iter().filter(|op| op.count > 0).map(|op| op.source).collect();
        let mut missed: Vec<MissedPrimitive> = near
            .filter_map(|(index, primitive)| {
                let source = number(index);
                let is_hit = hits.contains(&source);
                let area = if is_hit { None } else { self.area_of(&primitive.kind) };
                area.filter(|area| *area > LEAST).map(|area| MissedPrimitive {
                    source,
                    area,
                    in_mask: masks.as_ref().is_some_and(|parts| parts[index]),
                })
            })
            .collect();
        missed.truncate(most);
        missed
    }

    /// Whether the box around a primitive touches the pixel.
    fn is_near(&self, kind: &PrimitiveKind) -> bool {
        let pixel = DVec2::new(f64::from(self.pixel[0]), f64::from(self.pixel[1]));
        bounds(&self.screen(), kind).is_some_and(|bounds| touch(bounds, [pixel, pixel + 1.0]))
    }
}

/// The box around a primitive on the screen, its least and its greatest corner; `None` for what has no area of its own.
pub(super) fn bounds(screen: &Screen<'_>, kind: &PrimitiveKind) -> Option<[DVec2; 2]> {
    let corners;
    let points: &[DVec2] = match kind {
        PrimitiveKind::Triangle { points, .. } => points,
        PrimitiveKind::Polygon { polygon, .. } if polygon.curves().is_some() => {
            let [low, high] = polygon.bounds();
            corners = [low, high, DVec2::new(low.x, high.y), DVec2::new(high.x, low.y)];
            &corners
        }
        PrimitiveKind::Polygon { polygon, .. } => polygon.points(),
        _ => return None,
    };
    let mut bounds = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    for point in points {
        let point = screen.place(*point);
        bounds = [bounds[0].min(point), bounds[1].max(point)];
    }
    Some(bounds)
}

/// Whether two boxes share more than a line.
pub(super) fn touch([low, high]: [DVec2; 2], [other_low, other_high]: [DVec2; 2]) -> bool {
    low.cmplt(other_high).all() && high.cmpgt(other_low).all()
}

/// The same triangle with red, green and blue at its corners: colours that are barycentric weights.
fn weighted(primitive: &Primitive) -> Primitive {
    let corner = |r, g, b| Rgba::opaque(r, g, b);
    let kind = match primitive.kind {
        PrimitiveKind::Triangle { points, .. } => PrimitiveKind::Triangle {
            points,
            paint: Paint::Vertex([corner(1.0, 0.0, 0.0), corner(0.0, 1.0, 0.0), corner(0.0, 0.0, 1.0)]),
        },
        ref other => other.clone(),
    };
    Primitive {
        shape: primitive.shape,
        kind,
    }
}
