//! Our picture drawn under causes, and how far it then is from the other.

use std::borrow::Cow;
use std::sync::Arc;

use glam::{DAffine2, DVec2};
use rayon::prelude::*;

use super::cause::{self, Cause, CellCorner};
use super::levels::compared;
use crate::color::Rgba;
use crate::geometry::{View, ViewTransform};
use crate::post::PostProcess;
use crate::raster::{Framebuffer, SampleRate};
use crate::render::{self, CancelToken, RenderSettings, Subject};
use crate::scene::{Paint, Primitive, PrimitiveKind, Scene};

/// What causes are tried on.
pub(super) struct Trial<'a> {
    pub(super) subject: &'a Subject<'a>,
    pub(super) other: &'a Framebuffer,
    pub(super) cancel: &'a CancelToken,
}

/// The scene, where it is seen from and how it is drawn under some causes.
pub(super) struct Variant<'a> {
    scene: Cow<'a, Scene>,
    view: ViewTransform,
    settings: RenderSettings,
}

impl Variant<'_> {
    pub(super) fn subject(&self) -> Subject<'_> {
        Subject {
            scene: &self.scene,
            view: &self.view,
            settings: &self.settings,
        }
    }
}

impl<'a> Trial<'a> {
    /// Width and height of the other picture, and so of ours.
    pub(super) fn size(&self) -> [u32; 2] {
        [self.other.width(), self.other.height()]
    }

    /// The settings under causes.
    pub(super) fn settings(&self, causes: &[Cause]) -> RenderSettings {
        let mut settings = *self.subject.settings;
        for cause in causes {
            match *cause {
                Cause::Filled => settings.outline = false,
                Cause::TransparentBackground => settings.background = Rgba::TRANSPARENT,
                Cause::Rules(rules) => settings.rules = rules,
                Cause::SampleRate(rate) => settings.sample_rate = rate,
                Cause::Resolve(space) => settings.resolve = space,
                Cause::Shading(shading) => settings.shading = shading,
                Cause::Coverage(coverage) => settings.coverage = coverage,
                Cause::PostProcess(process) => {
                    settings.post_process = process;
                    // SMAA is made for one sample per pixel.
                    if process == PostProcess::Smaa {
                        settings.sample_rate = SampleRate::ONE;
                    }
                }
                Cause::PixelSampling(sampling) => settings.pixel_sampling = sampling,
                Cause::LevelSampling(sampling) => settings.level_sampling = sampling,
                _ => {}
            }
        }
        settings
    }

    /// What is drawn under causes; those of finished frames do nothing here.
    pub(super) fn variant(&self, causes: &[Cause]) -> Variant<'a> {
        let Subject { scene, view, .. } = *self.subject;
        let mut variant = Variant {
            scene: Cow::Borrowed(scene),
            view: if causes.contains(&Cause::Filled) {
                View::Canvas.transform(scene.canvas, self.size())
            } else {
                *view
            },
            settings: self.settings(causes),
        };
        for cause in causes {
            match *cause {
                Cause::Shifted(pixels) => variant.view = moved(&variant.view, pixels),
                Cause::FlippedV => flip_v(&mut variant.scene.to_mut().primitives),
                _ => {}
            }
        }
        // Half a cell is known once the sample rate is.
        let half = 0.5 / f64::from(variant.settings.sample_rate.side());
        for cause in causes {
            let by = match cause {
                Cause::Corners(CellCorner::UpperLeft) => half,
                Cause::Corners(CellCorner::LowerRight) => -half,
                _ => continue,
            };
            // Samples to the upper left see what shapes to the lower right would show.
            let by = variant.view.scene_to_pixels.matrix2.inverse() * DVec2::splat(by);
            move_shapes(&mut variant.scene.to_mut().primitives, by);
        }
        variant
    }

    /// The picture under causes, before anything was done to the finished frame; `None` when cancelled.
    pub(super) fn draw(&self, causes: &[Cause]) -> Option<Framebuffer> {
        let variant = self.variant(causes);
        let [width, height] = self.size();
        let mut frame = Framebuffer::new(width, height);
        render::draw_cancellable(
            &variant.scene,
            &variant.view,
            &variant.settings,
            &mut frame,
            self.cancel,
        )?;
        Some(frame)
    }

    /// How far a drawn picture to which `causes` are done is from the other: the sum of squared differences.
    pub(super) fn error(&self, drawn: &Framebuffer, causes: &[Cause]) -> u64 {
        let mut frame = Cow::Borrowed(drawn);
        for cause in causes {
            cause::apply(*cause, frame.to_mut());
        }
        let pixels = frame.pixels().par_iter().zip(self.other.pixels());
        pixels.with_min_len(4096).map(|(a, b)| squared(*a, *b)).sum()
    }
}

/// The squared difference of two pixels over their channels.
pub(super) fn squared(ours: u32, theirs: u32) -> u64 {
    if ours == theirs {
        return 0;
    }
    let [ours, theirs] = compared(ours, theirs).map(u32::to_be_bytes);
    let channels = ours.into_iter().zip(theirs);
    channels.map(|(a, b)| u64::from(a.abs_diff(b)).pow(2)).sum()
}

/// The view under which everything appears moved to the right and down by these pixels.
fn moved(view: &ViewTransform, pixels: [f64; 2]) -> ViewTransform {
    ViewTransform {
        scene_to_pixels: DAffine2::from_translation(DVec2::from_array(pixels)) * view.scene_to_pixels,
    }
}

/// Turns textures upside down.
fn flip_v(primitives: &mut [Primitive]) {
    for primitive in primitives {
        if let PrimitiveKind::Triangle {
            paint: Paint::Texture { uv, .. },
            ..
        } = &mut primitive.kind
        {
            for corner in uv {
                corner.y = 1.0 - corner.y;
            }
        }
    }
}

/// Moves what has an area, in canvas units.
fn move_shapes(primitives: &mut [Primitive], by: DVec2) {
    for primitive in primitives {
        match &mut primitive.kind {
            PrimitiveKind::Triangle { points, .. } => *points = points.map(|point| point + by),
            PrimitiveKind::Polygon { polygon, .. } => {
                *polygon = Arc::new(polygon.moved(by));
            }
            _ => {}
        }
    }
}
