//! Finding out why a pixel has its colour.

use std::collections::HashMap;

use glam::DVec2;

use super::model::{
    Explanation, Fragment, Missed, NotDrawn, Paint, Pinhole, Sample, Shape, Source, Texture, VERSION, View,
};
use super::numbers::{hex, one_line};
use super::resolve::{levels, resolve};
use super::samples::{SampleHit, shape_of, straight};
use super::smoothing::smoothing;
use super::triangle_views::{edges, interpolated, triangle_view};
use super::{areas, depth};
use crate::color::BlendMode;
use crate::geometry::{FillRule, Polygon};
use crate::raster::{
    Attributes, PaintedCommand, PaintedKind, Piece, PieceShape, PixelReplay, SampleOfTriangle, ShadingPlace,
};
use crate::render::{self, Explainer, Extent, MissedPrimitive, OpenSample, Subject};
use crate::rules::Rules;
use crate::scene::{self, Composite, MaskKind, PrimitiveKind, Quotes, Report};

/// How far beside the pixel primitives are measured, in distances of samples: far enough that the corner of something
/// large is not taken for something thin.
const BESIDE: f64 = 2.0;
/// Primitives between the samples that are told at most.
const MOST_MISSED: usize = 100;

/// What is explained, and for whom.
#[derive(Clone, Copy, Debug)]
pub struct Question<'a> {
    /// Scene, view and settings of the picture.
    pub subject: Subject<'a>,
    /// The scene's file or address, for quotations.
    pub file: &'a str,
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// The pixel, `[x, y]`.
    pub pixel: [u32; 2],
}

/// What tells of a primitive by its number: how large it is, how its document calls it.
#[derive(Clone, Copy)]
struct Sources<'a> {
    explainer: &'a Explainer<'a>,
    quotes: Option<&'a Quotes<'a>>,
}

impl Explanation {
    /// Why a pixel has its colour, but for what would help; `None` outside the picture.
    pub fn new(question: &Question<'_>) -> Option<Self> {
        let mut explanation = Self::with_masks(question)?;
        // Whether these matter is not known.
        explanation.missed.retain(|missed| !missed.in_mask);
        Some(explanation)
    }

    /// The same; parts of clip paths and masks that no sample meets are among what is missed.
    pub(super) fn with_masks(question: &Question<'_>) -> Option<Self> {
        let Question {
            subject, size, pixel, ..
        } = *question;
        let mut replay = render::replay(&subject, size, pixel)?;
        let explainer = Explainer::new(subject, size, pixel);
        // Where areas are covered, only what is smaller than the smallest area is missed.
        let most = if subject.settings.covers_areas() {
            0
        } else {
            MOST_MISSED
        };
        let mut missed = explainer.missed(&replay.painted, most);
        let quotes = subject.scene.quotes();
        depth::drop_idle_viewports(&mut replay, subject.scene);
        let (seen, unlisted) = depth::list(&mut replay);
        let sources = Sources {
            explainer: &explainer,
            quotes: quotes.as_ref(),
        };
        let pieces = explainer.pieces(&replay.painted);
        let rules = subject.settings.rules;
        let mut paints: Vec<Paint> = replay
            .painted
            .iter()
            .zip(pieces)
            .zip(&seen)
            .map(|((op, piece), seen)| question.paint(op, piece, seen, sources))
            .collect();
        measure(&mut paints, &replay.painted, &explainer);
        mark_masks(&mut paints);
        let smoothing = smoothing(&subject, size, pixel);
        let [a, r, g, b] = replay.pixel.to_be_bytes();
        let color = smoothing.as_ref().map_or([r, g, b, a], |smoothing| smoothing.after);
        let center = DVec2::new(f64::from(pixel[0]), f64::from(pixel[1])) + 0.5;
        let mut samples = samples(&replay, &paints, rules);
        if unlisted > 0 {
            count_unlisted(&mut samples, &replay, &paints);
        }
        let pinholes = question.pinholes(&samples, &paints, sources);
        missed.retain(|missed| pinholes.iter().all(|pinhole| pinhole.primitive != missed.source));
        let positions: Vec<DVec2> = samples.iter().map(|sample| sample.position.into()).collect();
        let around = BESIDE / (replay.samples.len() as f64).sqrt();
        let extents = measure_parts(&mut paints, &missed, &explainer, around);
        Some(Self {
            version: VERSION,
            pixel,
            size,
            user: subject.view.to_scene(center).to_array(),
            color,
            hex: hex(color),
            resolve: resolve(&replay, subject.settings),
            smoothing,
            exact: subject.settings.covers_areas(),
            conflation: areas::conflation(&paints, &explainer),
            samples,
            paints,
            pinholes,
            unlisted,
            missed: question.missed(missed, extents, sources, &positions),
            truth: None,
            untried: None,
            not_drawn: not_drawn(&subject.scene.report),
        })
    }
}

impl Explanation {
    /// The last of the paints that some sample shows.
    fn topmost_of(paints: &mut [Paint]) -> Option<&mut Paint> {
        paints.iter_mut().rev().find(|paint| paint.is_seen())
    }
}

/// What a scene's document asks for and no picture has.
fn not_drawn(report: &Report) -> Option<NotDrawn> {
    let first = report.skipped.first()?;
    Some(NotDrawn {
        name: first.name.clone(),
        line: first.first.line,
        others: report.skipped.len() - 1,
    })
}

/// Finds how much of the pixel each paint's primitive covers: once for all pieces of one.
fn measure(paints: &mut [Paint], painted: &[PaintedCommand], explainer: &Explainer<'_>) {
    let mut known: HashMap<u32, Option<f64>> = HashMap::new();
    for (paint, op) in paints.iter_mut().zip(painted) {
        if op.kind == PaintedKind::Primitive {
            paint.area = *known.entry(op.source).or_insert_with(|| explainer.area(op.source));
        }
    }
}

/// Finds how large the topmost paint is, where it covers only a part of the pixel; and what is missed, each.
fn measure_parts(
    paints: &mut [Paint],
    missed: &[MissedPrimitive],
    explainer: &Explainer<'_>,
    around: f64,
) -> Vec<Option<Extent>> {
    let topmost = Explanation::topmost_of(paints).filter(|topmost| topmost.area.is_some_and(|area| area < 1.0));
    let sources = missed.iter().map(|missed| missed.source);
    let sources: Vec<u32> = sources
        .chain(topmost.as_ref().map(|topmost| topmost.primitive))
        .collect();
    let mut extents = explainer.extents(&sources, around);
    if let Some(topmost) = topmost {
        let extent = extents.pop().flatten();
        topmost.width = extent.map(|extent| extent.width);
        topmost.length = extent.map(|extent| extent.length);
    }
    extents
}

/// The geometry of a paint.
struct Shaped {
    shape: Shape,
    /// What each sample saw of it.
    views: Vec<View>,
    texture: Option<Texture>,
}

impl Question<'_> {
    /// What covers parts of the pixel and none of its samples, and how large each of it is.
    fn missed(
        &self,
        found: Vec<MissedPrimitive>,
        extents: Vec<Option<Extent>>,
        sources: Sources<'_>,
        positions: &[DVec2],
    ) -> Vec<Missed> {
        let missed = |(found, extent): (MissedPrimitive, Option<Extent>)| {
            let Extent { width, length } = extent?;
            let MissedPrimitive {
                source: primitive,
                area,
                in_mask,
            } = found;
            let polygon = self.polygon(primitive);
            Some(Missed {
                source: self.source(primitive, sources.quotes)?,
                primitive,
                part: self.is_part(primitive),
                stroke: polygon.is_some_and(Polygon::is_stroke),
                crisp: polygon.is_some_and(Polygon::is_crisp),
                in_mask,
                area,
                shown: None,
                width,
                length,
                ties: self.ties(primitive, sources.explainer, positions),
            })
        };
        found.into_iter().zip(extents).filter_map(missed).collect()
    }

    /// Whether a primitive is one of several triangles of its element.
    fn is_part(&self, primitive: u32) -> bool {
        let primitives = &self.subject.scene.primitives;
        let index = primitive as usize;
        let triangle = |index: usize| {
            let primitive = primitives.get(index)?;
            matches!(primitive.kind, PrimitiveKind::Triangle { .. }).then_some(primitive.shape)
        };
        let beside = [index.checked_sub(1), Some(index + 1)].into_iter().flatten();
        triangle(index).is_some_and(|shape| beside.into_iter().any(|other| triangle(other) == Some(shape)))
    }

    fn paint(&self, op: &PaintedCommand, piece: Option<Piece>, seen: &[bool], sources: Sources<'_>) -> Paint {
        let source = self.source(op.source, sources.quotes);
        let Shaped { shape, views, texture } = self.shape(op, source.is_none(), piece);
        let is_cut = matches!(shape, Shape::Triangle { .. }) && self.polygon(op.source).is_some();
        Paint {
            area: None,
            shape,
            source,
            primitive: op.source,
            layers: op.layers,
            in_mask: false,
            is_cut,
            fragments: op
                .fragments
                .iter()
                .zip(seen)
                .map(|(fragment, seen)| Fragment {
                    sample: fragment.sample,
                    color: levels(fragment.color),
                    before: levels(fragment.before),
                    after: levels(fragment.after),
                    seen: *seen,
                })
                .collect(),
            covered: op.covered_part(),
            width: None,
            length: None,
            shaded_at: op.shaded.map(ShadingPlace::position),
            views,
            texture,
            gradient: self.gradient(op.source),
            pattern: self.pattern(op.source),
        }
    }

    /// The geometry of a paint, and what each of its samples saw of it. What has no place in the document is the canvas's
    /// outline.
    fn shape(&self, op: &PaintedCommand, is_nowhere: bool, piece: Option<Piece>) -> Shaped {
        let rules = self.subject.settings.rules;
        let polygon = self.polygon(op.source);
        let (mut views, mut texture) = (Vec::new(), None);
        let shape = match (op.kind, piece.map(|piece| piece.shape)) {
            (PaintedKind::BeginLayer, _) => Shape::BeginLayer,
            (PaintedKind::EndLayer(compositing), _) => self.end_of_layer(op.source, compositing.opacity()),
            (
                PaintedKind::Primitive,
                Some(PieceShape::Triangle {
                    corners,
                    samples,
                    texture: usage,
                }),
            ) => {
                texture = usage.map(|usage| self.texture(&usage));
                let view = |sample: &SampleOfTriangle| triangle_view(sample, &corners, rules);
                views = samples.iter().map(view).collect();
                Shape::Triangle {
                    corners: corners.map(|corner| corner.to_array()),
                }
            }
            (
                PaintedKind::Primitive,
                Some(PieceShape::Outline {
                    rule,
                    windings,
                    attributes,
                }),
            ) => {
                let view = |(winding, attributes): (i32, &Attributes)| View::Polygon {
                    winding,
                    value: interpolated(attributes),
                };
                views = windings.into_iter().zip(&attributes).map(view).collect();
                Shape::Polygon {
                    // What is drawn of a crisp shape are pixels.
                    rule: match polygon.map_or(rule, Polygon::rule) {
                        FillRule::NonZero => "nonzero",
                        FillRule::EvenOdd => "evenodd",
                    },
                    curved: polygon.is_some_and(|polygon| polygon.curves().is_some()),
                    stroke: polygon.is_some_and(Polygon::is_stroke),
                    crisp: polygon.is_some_and(Polygon::is_crisp),
                }
            }
            (PaintedKind::Primitive, _) if is_nowhere => Shape::CanvasOutline,
            (PaintedKind::Primitive, _) => Shape::WholePixel,
        };
        Shaped { shape, views, texture }
    }

    /// The polygon that a primitive of the scene is, if it is one.
    pub(super) fn polygon(&self, primitive: u32) -> Option<&Polygon> {
        match &self.subject.scene.primitives.get(primitive as usize)?.kind {
            PrimitiveKind::Polygon { polygon, .. } => Some(polygon),
            _ => None,
        }
    }

    /// What the end of a layer does.
    fn end_of_layer(&self, primitive: u32, opacity: f64) -> Shape {
        let kind = self
            .subject
            .scene
            .primitives
            .get(primitive as usize)
            .map(|primitive| &primitive.kind);
        match kind {
            Some(PrimitiveKind::EndLayer {
                composite: Composite::Clip,
            }) => Shape::EndClip,
            Some(PrimitiveKind::EndLayer {
                composite: Composite::Mask(kind),
            }) => Shape::EndMask {
                by: match kind {
                    MaskKind::Luminance => "luminance",
                    MaskKind::Alpha => "alpha",
                },
            },
            Some(PrimitiveKind::EndLayer {
                composite: Composite::Over { blend, .. },
            }) if *blend != BlendMode::Normal => Shape::EndLayer {
                opacity,
                blend: Some(blend.name()),
            },
            _ => Shape::EndLayer { opacity, blend: None },
        }
    }

    /// The samples that the float rules leave open, though a triangle that nothing opaque lies above is theirs, and no neighbour's.
    fn pinholes(&self, samples: &[Sample], paints: &[Paint], sources: Sources<'_>) -> Vec<Pinhole> {
        if self.subject.settings.rules != Rules::Float {
            return Vec::new();
        }
        let opaque = |(number, sample): (usize, &Sample)| {
            let hides = |paint: &&Paint| {
                let mut fragments = paint.fragments.iter().filter(|fragment| fragment.sample == number);
                fragments.any(|fragment| fragment.seen && fragment.color[3] >= 255.0)
            };
            let stack = sample.stack.iter().rev().map(|paint| &paints[*paint]);
            let mut primitives = stack.filter(|paint| !paint.shape.is_layer_mark());
            primitives.find(hides).map(|paint| paint.primitive)
        };
        let opaque: Vec<Option<u32>> = samples.iter().enumerate().map(opaque).collect();
        let is_neighbours = |open: &OpenSample| {
            let stack = samples[open.sample].stack.iter();
            stack.into_iter().any(|paint| is_beside(&paints[*paint], open.corners))
        };
        let pinhole = |open: OpenSample| {
            Some(Pinhole {
                sample: open.sample,
                source: self.source(open.source, sources.quotes)?,
                primitive: open.source,
                corners: open.corners.map(|corner| corner.to_array()),
                edges: edges(&open.view, &open.corners, Rules::Float),
            })
        };
        sources
            .explainer
            .left_open(&opaque)
            .into_iter()
            .filter(|open| !is_neighbours(open))
            .filter_map(pinhole)
            .collect()
    }

    /// Where a primitive stands in the document.
    fn source(&self, primitive: u32, quotes: Option<&Quotes<'_>>) -> Option<Source> {
        let scene = self.subject.scene;
        let SampleHit::Shape(shape) = shape_of(scene, primitive) else {
            return None;
        };
        Some(self.source_of(shape, quotes))
    }

    pub(super) fn source_of(&self, shape: &scene::Shape, quotes: Option<&Quotes<'_>>) -> Source {
        Source {
            element: shape.element.to_string(),
            id: shape.id.as_deref().map(one_line),
            file: self.file.to_owned(),
            line: shape.location.line,
            column: shape.location.column,
            used: shape.used.map(|place| place.line),
            text: quotes.and_then(|quotes| quotes.excerpt(shape.location)),
        }
    }
}

/// Whether a paint is a triangle that shares an edge with one of these corners.
fn is_beside(paint: &Paint, corners: [DVec2; 3]) -> bool {
    let Shape::Triangle { corners: own } = paint.shape else {
        return false;
    };
    corners.iter().filter(|corner| own.contains(&corner.to_array())).count() == 2
}

fn samples(replay: &PixelReplay, paints: &[Paint], rules: Rules) -> Vec<Sample> {
    let mut samples: Vec<Sample> = replay
        .samples
        .iter()
        .map(|sample| Sample {
            position: sample.position,
            color: levels(sample.color),
            bytes: straight(sample.color, rules),
            stack: Vec::new(),
            unlisted: 0,
            seen: None,
        })
        .collect();
    for (number, paint) in paints.iter().enumerate().filter(|(_, paint)| !paint.in_mask) {
        let is_primitive = !paint.shape.is_layer_mark();
        for fragment in &paint.fragments {
            let sample = &mut samples[fragment.sample];
            sample.stack.push(number);
            if fragment.seen && is_primitive {
                sample.seen = Some(number);
            }
        }
    }
    samples
}

/// Counts what painted each sample and is not listed.
fn count_unlisted(samples: &mut [Sample], replay: &PixelReplay, paints: &[Paint]) {
    let mut in_masks = vec![0; samples.len()];
    for fragment in paints
        .iter()
        .filter(|paint| paint.in_mask)
        .flat_map(|paint| &paint.fragments)
    {
        in_masks[fragment.sample] += 1;
    }
    for ((sample, replayed), in_masks) in samples.iter_mut().zip(&replay.samples).zip(in_masks) {
        sample.unlisted = replayed.fragments.saturating_sub(sample.stack.len() + in_masks);
    }
}

/// Marks what is part of a clip path or mask, which lies on no sample itself.
fn mark_masks(paints: &mut [Paint]) {
    let mut open = Vec::new();
    for number in 0..paints.len() {
        match paints[number].shape {
            Shape::BeginLayer => open.push(number),
            Shape::EndLayer { .. } => {
                open.pop();
            }
            Shape::EndClip | Shape::EndMask { .. } => {
                let begin = open.pop().unwrap_or(number);
                for part in &mut paints[begin..=number] {
                    part.in_mask = true;
                }
            }
            _ => {}
        }
    }
}
