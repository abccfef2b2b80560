//! What each sample of a pixel shows, and what painted it last: the short answer, for the magnifier's dots.

use crate::color::Premultiplied16;
use crate::geometry::ViewTransform;
use crate::render::{self, RenderSettings, Subject};
use crate::rules::Rules;
use crate::scene::{Scene, Shape};

/// One sample of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSample<'a> {
    /// Its place in the pixel: `(0, 0)` the top left corner, `(1, 1)` the bottom right.
    pub position: [f64; 2],
    /// Its colour when everything is painted, straight `[r, g, b, a]`.
    pub color: [u8; 4],
    /// What painted it last.
    pub hit: SampleHit<'a>,
}

/// What painted a sample last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SampleHit<'a> {
    /// Nothing but the background.
    Background,
    /// The outline around the canvas.
    Outline,
    /// A primitive of this shape.
    Shape(&'a Shape),
}

/// The samples of pixel `(x, y)` of a frame of `size` pixels, row by row; `None` outside the frame.
pub fn pixel_samples<'a>(
    scene: &'a Scene,
    view: &ViewTransform,
    settings: &RenderSettings,
    size: [u32; 2],
    pixel: [u32; 2],
) -> Option<Vec<PixelSample<'a>>> {
    let subject = Subject { scene, view, settings };
    let replay = render::replay(&subject, size, pixel)?;
    let sources = replay.sources();
    let samples = replay
        .samples
        .into_iter()
        .zip(sources)
        .map(|(sample, source)| PixelSample {
            position: sample.position,
            color: straight(sample.color, settings.rules),
            hit: source.map_or(SampleHit::Background, |source| shape_of(scene, source)),
        });
    Some(samples.collect())
}

/// What a source stands for.
pub(super) fn shape_of(scene: &Scene, source: u32) -> SampleHit<'_> {
    match scene.primitives.get(source as usize) {
        Some(primitive) => scene
            .shapes
            .get(primitive.shape.0 as usize)
            .map_or(SampleHit::Background, SampleHit::Shape),
        None => SampleHit::Outline,
    }
}

/// A stored sample as a pixel that consists of it alone.
pub(super) fn straight(color: Premultiplied16, rules: Rules) -> [u8; 4] {
    let [a, r, g, b] = Premultiplied16::resolve(color.0.map(u32::from), 1, rules).to_be_bytes();
    [r, g, b, a]
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::color::Rgba;
    use crate::geometry::View;
    use crate::raster::SampleRate;
    use crate::scene::{Dialect, Paint, Primitive, PrimitiveKind, ShapeId, SourceLocation};

    #[test]
    fn samples_name_what_they_hit() {
        let mut scene = Scene::empty(DVec2::splat(4.0), Dialect::Svg);
        let location = SourceLocation { line: 3, column: 5 };
        scene.shapes = vec![Shape {
            element: "polygon".into(),
            id: Some("left".into()),
            location,
            used: None,
        }];
        let points = [DVec2::new(0.0, -8.0), DVec2::new(1.5, -8.0), DVec2::new(0.0, 4000.0)];
        let paint = Paint::Solid(Rgba::opaque(1.0, 0.0, 0.0));
        scene.primitives = vec![Primitive {
            shape: ShapeId(0),
            kind: PrimitiveKind::Triangle { points, paint },
        }];
        let settings = RenderSettings {
            sample_rate: SampleRate::new(4).expect("a square number"),
            outline: false,
            ..RenderSettings::default()
        };
        let around = |center| {
            View::At {
                center,
                scale: 1.0,
                rotation: 0.0,
            }
            .transform(scene.canvas, [4, 4])
        };
        let view = around(DVec2::splat(2.0));
        let samples = pixel_samples(&scene, &view, &settings, [4, 4], [1, 1]).expect("inside");
        let red: Vec<bool> = samples
            .iter()
            .map(|sample| sample.hit == SampleHit::Shape(&scene.shapes[0]))
            .collect();
        assert_eq!(red, [true, false, true, false], "the left half");
        assert_eq!(samples[0].color, [255, 0, 0, 255], "in its colour");
        assert_eq!(
            (samples[1].hit, samples[1].color),
            (SampleHit::Background, [255; 4]),
            "the right half is paper"
        );
        assert!(
            pixel_samples(&scene, &view, &settings, [4, 4], [4, 1]).is_none(),
            "outside"
        );
    }
}
