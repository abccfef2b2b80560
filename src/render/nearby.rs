//! One pixel drawn with many settings: what is far from it is left out once, and nothing is noted.

use std::sync::OnceLock;
use std::sync::atomic::AtomicBool;

use glam::DVec2;
use rayon::prelude::*;

use super::replay::{bounds, shines_through, touch};
use super::smoothed;
use super::{RenderSettings, Screen, Subject, add, number, outline, raster_settings, sources};
use crate::color::Premultiplied16;
use crate::geometry::ViewTransform;
use crate::post;
use crate::raster::{ChunkBuilder, DisplayList, ListContext, PixelReplay, SizedFilter};
use crate::scene::{Composite, PrimitiveKind, Scene};

/// How far from the pixel a primitive may lie and yet paint it, in pixels: the pixel takes samples of its neighbours, corners
/// are snapped by far less than one, whoever's rules, and a hairline is as wide as a pixel.
const REACH: f64 = 2.0 + SizedFilter::MOST_MARGIN as f64;

/// The primitives near one pixel of a picture.
#[derive(Debug)]
pub struct Nearby<'a> {
    scene: &'a Scene,
    view: &'a ViewTransform,
    size: [u32; 2],
    pixel: [u32; 2],
    /// Indices of the primitives, in painter's order.
    primitives: Vec<u32>,
    /// Of those near the pixels, too, that decide about a smoothed one.
    around: OnceLock<Vec<u32>>,
}

impl<'a> Nearby<'a> {
    /// Of a frame of `size` pixels, in which the pixel must lie.
    pub fn new(subject: &Subject<'a>, size: [u32; 2], pixel: [u32; 2]) -> Self {
        Self {
            scene: subject.scene,
            view: subject.view,
            size,
            pixel,
            primitives: primitives(subject, size, pixel, REACH),
            around: OnceLock::new(),
        }
    }

    /// The same without some of the primitives, given by their indices.
    #[must_use]
    pub fn without(&self, left_out: &[u32]) -> Self {
        let kept = |primitives: &[u32]| {
            let kept = primitives.iter().filter(|index| !left_out.contains(*index));
            kept.copied().collect::<Vec<u32>>()
        };
        Self {
            primitives: kept(&self.primitives),
            around: self
                .around
                .get()
                .map(|around| kept(around))
                .map_or_else(OnceLock::new, OnceLock::from),
            ..*self
        }
    }

    /// How much there is to draw each time, in corners.
    pub fn work(&self) -> usize {
        /// What a layer's begin or end takes.
        const LAYER: usize = 30;
        let corners = |index: &u32| match &self.scene.primitives[*index as usize].kind {
            PrimitiveKind::Polygon { polygon, .. } => polygon.points().len(),
            PrimitiveKind::BeginLayer | PrimitiveKind::EndLayer { .. } => LAYER,
            _ => 3,
        };
        self.primitives.iter().map(corners).sum()
    }

    /// The pixel `0xAARRGGBB`, the bytes of a whole frame with these settings; it is the picture's, whatever they show
    /// instead. `None` where the pixel lies outside the frame.
    pub fn pixel(&self, settings: &RenderSettings) -> Option<u32> {
        let Some(values) = settings.smoothing() else {
            let [x, y] = self.pixel;
            return self.list(&self.primitives, settings).pixel(x, y);
        };
        let subject = Subject {
            scene: self.scene,
            view: self.view,
            settings,
        };
        let reach = REACH + f64::from(post::REACH);
        let around = self
            .around
            .get_or_init(|| primitives(&subject, self.size, self.pixel, reach));
        let list = self.list(around, settings);
        smoothed::pixel(self.size, self.pixel, values, |region, publish| {
            list.rasterize_tiles(&[region], self.pixel, &AtomicBool::new(false), &publish);
        })
    }

    /// The colours of the pixel's own samples with these settings, in the order of their pattern; `None` where it lies outside the
    /// frame.
    pub fn samples(&self, settings: &RenderSettings) -> Option<Vec<Premultiplied16>> {
        let replay = self.replay(settings)?;
        Some(replay.samples.into_iter().map(|sample| sample.color).collect())
    }

    /// What painted the pixel's own samples with these settings; `None` where it lies outside the frame.
    pub fn replay(&self, settings: &RenderSettings) -> Option<PixelReplay> {
        let [x, y] = self.pixel;
        self.list(&self.primitives, settings).replay(x, y)
    }

    /// Whether any of the pixel's own samples lies in a primitive, given by its index, wherever that counts.
    pub fn meets(&self, primitive: u32, settings: &RenderSettings) -> bool {
        let [x, y] = self.pixel;
        let replay = self.list(&[primitive], settings).replay(x, y);
        replay.is_some_and(|replay| replay.painted.iter().any(|op| op.source == primitive && op.count > 0))
    }

    /// What paints some of the primitives.
    fn list(&self, primitives: &[u32], settings: &RenderSettings) -> DisplayList<'a> {
        let raster = raster_settings(settings);
        let context = ListContext::new(self.size, &raster);
        let screen = Screen::new(self.view, settings, self.size);
        let mut builder = ChunkBuilder::new(&context, primitives.len());
        for index in primitives {
            builder.set_source(*index);
            add(&mut builder, &screen, &self.scene.primitives[*index as usize].kind);
        }
        let mut list = vec![builder.finish()];
        list.extend(outline(self.scene, &context, &screen, settings));
        DisplayList::new(context, raster, list, sources(self.scene, self.view, settings))
    }
}

/// The primitives that may paint pixels at most `reach` from one, by their indices.
fn primitives(subject: &Subject<'_>, size: [u32; 2], pixel: [u32; 2], reach: f64) -> Vec<u32> {
    let Subject { scene, view, settings } = *subject;
    let screen = Screen::new(view, settings, size);
    let corner = DVec2::from(pixel.map(f64::from));
    let near = [corner - reach, corner + 1.0 + reach];
    let wanted = scene.primitives.par_iter().enumerate().filter(|(_, primitive)| {
        let around = ends(&screen, &primitive.kind);
        around.is_none_or(|around| touch(around, near))
    });
    let mut primitives: Vec<u32> = wanted.map(|(index, _)| number(index)).collect();
    primitives.extend(shining(scene, &screen, size));
    primitives.sort_unstable();
    primitives.dedup();
    without_empty_layers(scene, &primitives)
}

/// The box around what a primitive paints, but for a pixel; `None` for layers.
fn ends(screen: &Screen<'_>, kind: &PrimitiveKind) -> Option<[DVec2; 2]> {
    match kind {
        PrimitiveKind::Hairline { ends, .. } => {
            let [a, b] = ends.map(|end| screen.place(end));
            Some([a.min(b), a.max(b)])
        }
        PrimitiveKind::Point { at, .. } => Some([screen.place(*at); 2]),
        _ => bounds(screen, kind),
    }
}

/// The largest triangle in the frame that is shaded and lets what is below it shine through: one anywhere makes all shaded
/// ones blend sample by sample.
fn shining(scene: &Scene, screen: &Screen<'_>, size: [u32; 2]) -> Option<u32> {
    let frame = [DVec2::ZERO, DVec2::from(size.map(f64::from))];
    let shining = scene
        .primitives
        .par_iter()
        .enumerate()
        .filter_map(|(index, primitive)| {
            let PrimitiveKind::Triangle { points, .. } = &primitive.kind else {
                return None;
            };
            let [low, high] = bounds(screen, &primitive.kind).filter(|_| shines_through(scene, &primitive.kind))?;
            let inside = high.min(frame[1]) - low.max(frame[0]);
            let [a, b, c] = points.map(|point| screen.place(point));
            let area = ((b - a).perp_dot(c - a) / 2.0).abs().min(inside.x * inside.y);
            inside.cmpgt(DVec2::ZERO).all().then_some((area, index))
        });
    let largest = shining.max_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    largest.map(|(_, index)| number(index))
}

/// Leaves out the layers that nothing is left of.
fn without_empty_layers(scene: &Scene, primitives: &[u32]) -> Vec<u32> {
    let kind = |index: u32| &scene.primitives[index as usize].kind;
    let mut kept: Vec<u32> = Vec::with_capacity(primitives.len());
    for index in primitives {
        let begun = kept
            .last()
            .is_some_and(|last| matches!(kind(*last), PrimitiveKind::BeginLayer));
        let is_seen = |composite: &Composite| matches!(composite, Composite::Over { .. });
        if begun && matches!(kind(*index), PrimitiveKind::EndLayer { composite } if is_seen(composite)) {
            kept.pop();
        } else {
            kept.push(*index);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::View;
    use crate::raster::{Framebuffer, SampleRate};
    use crate::render::draw;
    use crate::rules::Rules;
    use crate::scene::{DialectChoice, NoResources, ReadOptions, read};

    #[test]
    fn pixels_drawn_alone_are_those_of_frames() {
        let document = r##"<svg width="40" height="40" xmlns="http://www.w3.org/2000/svg">
            <rect width="40" height="40" fill="#CCDDEE"/>
            <g opacity="0.5"><rect x="2" y="2" width="5" height="5" fill="#FF0000"/></g>
            <g opacity="0.5"><circle cx="20" cy="20" r="12" fill="#0000FF"/><path d="M9 1 31 39 32 2z"/></g>
            <line x1="3" y1="37" x2="38" y2="5" stroke="#00AA00" stroke-width="0.7"/></svg>"##;
        let lines = r##"<svg width="40" height="40"><colortri points="0,0 40,0 0,40"
            colors="1 0 0 1 0 1 0 0.5 0 0 1 1"/><line x1="3" y1="37" x2="38" y2="5" stroke="#00AA00"/>
            <rect x="22" y="21" fill="#102030" width="0" height="0"/></svg>"##;
        for document in [document, lines] {
            let options = ReadOptions {
                dialect: DialectChoice::Auto,
            };
            let scene = read(document.as_bytes(), "scene.svg", options, &NoResources).expect("a scene");
            let size = [41, 37];
            let view = View::Default.transform(scene.canvas, size);
            let rates = [1, 4, 9].map(|samples| SampleRate::new(samples).expect("a rate"));
            for (sample_rate, rules) in rates.into_iter().flat_map(|rate| Rules::ALL.map(|rules| (rate, rules))) {
                let settings = RenderSettings {
                    sample_rate,
                    rules,
                    ..RenderSettings::default()
                };
                let mut frame = Framebuffer::new(size[0], size[1]);
                draw(&scene, &view, &settings, &mut frame);
                for (i, expected) in (0..).zip(frame.pixels()) {
                    let pixel = [i % size[0], i / size[0]];
                    // What is left out is chosen with other settings than those that are drawn with.
                    let subject = Subject {
                        scene: &scene,
                        view: &view,
                        settings: &RenderSettings::default(),
                    };
                    let found = Nearby::new(&subject, size, pixel).pixel(&settings);
                    assert_eq!(found, Some(*expected), "{pixel:?} {sample_rate:?} {rules:?}");
                }
            }
        }
    }
}
