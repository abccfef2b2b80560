//! A guess at why a picture from outside differs from ours: our scene is drawn under one known cause after the other,
//! and the cause that leaves the smallest squared error is kept; then the next one beside it.

use glam::{DAffine2, DVec2};
use rayon::prelude::*;

use super::cause::{self, Cause, candidates};
use crate::color::{linear_to_srgb, srgb_to_linear, unit_to_byte};
use crate::geometry::ViewTransform;
use crate::raster::{Framebuffer, SampleRate};
use crate::render::{self, CancelToken, RenderSettings, Subject};
use crate::rules::Rules;
use crate::scene::{Paint, PrimitiveKind, Scene};

/// Most causes that are told together.
const MAX_CAUSES: usize = 3;
/// A cause beside others must at least halve the error that they leave.
const WORTH: f64 = 0.5;
/// Most samples of a picture that is resolved in linear light.
const MAX_SAMPLES: u64 = 1 << 26;

/// What makes our picture most like another.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// What the other renderer does otherwise, all of it at once, the weightiest first. Empty where nothing known makes
    /// the pictures more alike.
    pub causes: Vec<Cause>,
    /// The sum of squared differences over pixels and channels that our picture has, in levels of 255 squared.
    pub before: u64,
    /// The same when our picture is drawn under these causes.
    pub after: u64,
}

impl Guess {
    /// The share of the squared difference that the causes explain, from 0 to 1.
    pub fn explained(&self) -> f64 {
        if self.before == 0 {
            return 1.0;
        }
        // Sums stay far below 2^53.
        1.0 - self.after as f64 / self.before as f64
    }
}

/// Finds what makes the picture of `subject` most like `other`, a picture of the same scene by another renderer. Draws
/// the scene some dozen times at the size of `other`. `None` once `cancel` says so.
pub fn guess(subject: &Subject<'_>, other: &Framebuffer, cancel: &CancelToken) -> Option<Guess> {
    let trial = Trial {
        subject,
        flipped: flipped_v(subject.scene),
        other,
        cancel,
    };
    let before = trial.error(&[])?;
    let mut guess = Guess {
        causes: Vec::new(),
        before,
        after: before,
    };
    let candidates = candidates(subject);
    while guess.after > 0 && guess.causes.len() < MAX_CAUSES {
        let mut best: Option<(u64, Cause)> = None;
        for cause in candidates.iter().filter(|cause| cause.goes_with(&guess.causes)) {
            let causes = [guess.causes.as_slice(), &[*cause]].concat();
            let error = trial.error(&causes)?;
            if best.is_none_or(|(least, _)| error < least) {
                best = Some((error, *cause));
            }
        }
        let worth = if guess.causes.is_empty() { 1.0 } else { WORTH };
        match best {
            Some((error, cause)) if error < guess.after && error as f64 <= worth * guess.after as f64 => {
                guess.causes.push(cause);
                guess.after = error;
            }
            _ => break,
        }
    }
    Some(guess)
}

/// What hypotheses are tried on.
struct Trial<'a> {
    subject: &'a Subject<'a>,
    /// The scene with its textures upside down.
    flipped: Scene,
    other: &'a Framebuffer,
    cancel: &'a CancelToken,
}

impl Trial<'_> {
    /// How far the picture under `causes` is from the other: the sum of squared differences.
    fn error(&self, causes: &[Cause]) -> Option<u64> {
        let frame = self.draw(causes)?;
        let width = self.other.width() as usize;
        let truncated = causes.contains(&Cause::Truncated);
        let rows = frame.pixels().par_chunks(width.max(1));
        let rows = rows.zip(self.other.pixels().par_chunks(width.max(1)));
        let error = |(ours, theirs): (&[u32], &[u32])| -> u64 {
            ours.iter().zip(theirs).map(|(a, b)| squared(*a, *b, truncated)).sum()
        };
        Some(rows.map(error).sum())
    }

    /// Our picture under `causes`.
    fn draw(&self, causes: &[Cause]) -> Option<Framebuffer> {
        let mut settings = *self.subject.settings;
        let mut view = *self.subject.view;
        let mut scene = self.subject.scene;
        for cause in causes {
            match *cause {
                Cause::Shifted(pixels) => view = moved(&view, pixels),
                Cause::Rules(rules) => settings.rules = rules,
                Cause::SampleRate(rate) => settings.sample_rate = rate,
                Cause::PixelSampling(sampling) => settings.pixel_sampling = sampling,
                Cause::LevelSampling(sampling) => settings.level_sampling = sampling,
                Cause::FlippedV => scene = &self.flipped,
                _ => {}
            }
        }
        let subject = Subject {
            scene,
            view: &view,
            settings: &settings,
        };
        let mut frame = self.render(&subject, 1)?;
        if causes.contains(&Cause::LinearResolve) {
            self.resolve_linear(&subject, &mut frame)?;
        }
        for cause in causes {
            cause::apply(*cause, &mut frame);
        }
        Some(frame)
    }

    /// The picture, `times` as wide and as high as the other.
    fn render(&self, subject: &Subject<'_>, times: u32) -> Option<Framebuffer> {
        let mut frame = Framebuffer::new(self.other.width() * times, self.other.height() * times);
        render::draw_cancellable(subject.scene, subject.view, subject.settings, &mut frame, self.cancel)?;
        Some(frame)
    }

    /// Mixes the samples of each pixel in linear light. They are the pixels of a picture that is as many times larger,
    /// and count only where their mean in stored values is what `frame` holds: hairlines and points keep their pixels,
    /// and textures of other mip levels their colours.
    fn resolve_linear(&self, subject: &Subject<'_>, frame: &mut Framebuffer) -> Option<()> {
        let side = subject.settings.sample_rate.side();
        let [width, height] = [frame.width(), frame.height()];
        let samples = u64::from(width) * u64::from(height) * u64::from(side * side);
        if side < 2 || width.max(height) * side > Framebuffer::MAX_SIDE || samples > MAX_SAMPLES {
            return Some(());
        }
        let view = ViewTransform {
            scene_to_pixels: DAffine2::from_scale(DVec2::splat(f64::from(side))) * subject.view.scene_to_pixels,
        };
        let settings = RenderSettings {
            sample_rate: SampleRate::ONE,
            ..*subject.settings
        };
        let large = Subject {
            view: &view,
            settings: &settings,
            ..*subject
        };
        let large = self.render(&large, side)?;
        let linear: Vec<f32> = (0..=255_u8)
            .map(|byte| srgb_to_linear(f32::from(byte) / 255.0))
            .collect();
        let (width, side) = (width as usize, side as usize);
        let rows = large.pixels().par_chunks_exact((width * side * side).max(1));
        frame
            .pixels_mut()
            .par_chunks_mut(width.max(1))
            .zip(rows)
            .for_each(|(row, samples)| {
                for (x, pixel) in row.iter_mut().enumerate() {
                    let lines = samples
                        .chunks_exact(width * side)
                        .map(|line| &line[x * side..(x + 1) * side]);
                    *pixel = mixed_linear(*pixel, lines.flatten().copied(), &linear).unwrap_or(*pixel);
                }
            });
        Some(())
    }
}

/// The linear mean of `samples`, all of them opaque, if their mean in stored values is `pixel` to two levels.
fn mixed_linear(pixel: u32, samples: impl Iterator<Item = u32>, linear: &[f32]) -> Option<u32> {
    let (mut stored, mut light, mut count) = ([0.0; 3], [0.0; 3], 0.0);
    for sample in samples {
        let [a, rgb @ ..] = sample.to_be_bytes();
        if a != 255 {
            return None;
        }
        for (i, byte) in rgb.into_iter().enumerate() {
            stored[i] += f32::from(byte);
            light[i] += linear[usize::from(byte)];
        }
        count += 1.0;
    }
    let [_, rgb @ ..] = pixel.to_be_bytes();
    let alike = rgb
        .into_iter()
        .zip(stored)
        .all(|(byte, sum)| (f32::from(byte) - sum / count).abs() <= 2.0);
    let [r, g, b] = light.map(|sum| unit_to_byte(linear_to_srgb(sum / count), Rules::Standard));
    alike.then(|| u32::from_be_bytes([255, r, g, b]))
}

/// The squared difference of two pixels over their channels. Bytes that were truncated may be one level lower.
fn squared(ours: u32, theirs: u32, truncated: bool) -> u64 {
    if ours == theirs {
        return 0;
    }
    let channels = ours.to_be_bytes().into_iter().zip(theirs.to_be_bytes());
    channels
        .map(|(a, b)| match a.abs_diff(b) {
            1 if truncated && b < a => 0,
            difference => u64::from(difference) * u64::from(difference),
        })
        .sum()
}

/// The view under which everything appears moved by so many pixels to the right and down.
fn moved(view: &ViewTransform, pixels: [f64; 2]) -> ViewTransform {
    ViewTransform {
        scene_to_pixels: DAffine2::from_translation(DVec2::from_array(pixels)) * view.scene_to_pixels,
    }
}

/// The same scene with its textures upside down.
fn flipped_v(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    for primitive in &mut scene.primitives {
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
    scene
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::color::Rgba;
    use crate::geometry::View;
    use crate::scene::{Dialect, Primitive, ShapeId, TextureId};
    use crate::texture::Texture;

    const SIZE: [u32; 2] = [64, 48];

    /// A triangle of mixed colours and one with a texture, neither of them symmetric.
    fn scene() -> Scene {
        let mut scene = Scene::empty(DVec2::new(64.0, 48.0), Dialect::Svg);
        scene.textures = vec![Arc::new(Texture::missing("checker"))];
        let triangle = |points: [[f64; 2]; 3], paint| Primitive {
            shape: ShapeId(0),
            kind: PrimitiveKind::Triangle {
                points: points.map(DVec2::from_array),
                paint,
            },
        };
        let uv = [[0.0, 0.0], [1.0, 0.1], [0.2, 0.9]].map(glam::Vec2::from_array);
        let colors = [
            Rgba::opaque(0.9, 0.1, 0.3),
            Rgba::opaque(0.2, 0.8, 0.4),
            Rgba::opaque(0.1, 0.3, 0.6),
        ];
        let texture = Paint::Texture {
            texture: TextureId(0),
            uv,
            opacity: 1.0,
        };
        scene.primitives = vec![
            triangle([[3.2, 4.1], [60.3, 9.7], [20.8, 44.2]], Paint::Vertex(colors)),
            triangle([[40.1, 20.3], [62.4, 30.2], [35.7, 46.9]], texture),
        ];
        scene
    }

    /// What is guessed for our own picture under `causes`.
    fn found(causes: &[Cause], rate: u32) -> Guess {
        let scene = scene();
        let view = View::Canvas.transform(scene.canvas, SIZE);
        let settings = RenderSettings {
            sample_rate: SampleRate::new(rate).expect("a square number"),
            outline: false,
            ..RenderSettings::default()
        };
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        };
        let blank = Framebuffer::new(SIZE[0], SIZE[1]);
        let cancel = CancelToken::default();
        let trial = Trial {
            subject: &subject,
            flipped: flipped_v(&scene),
            other: &blank,
            cancel: &cancel,
        };
        let other = trial.draw(causes).expect("not cancelled");
        guess(&subject, &other, &cancel).expect("not cancelled")
    }

    #[test]
    fn hypotheses_find_each_cause() {
        for cause in [
            Cause::Shifted([0.5, 0.5]),
            Cause::Shifted([-0.5, 0.0]),
            Cause::Shifted([0.0, 1.0]),
            Cause::Rules(Rules::Course),
            Cause::FlippedV,
            Cause::UpsideDown,
            Cause::SwappedChannels,
            Cause::EncodedTwice,
            Cause::NotEncoded,
            Cause::LinearResolve,
            Cause::SampleRate(SampleRate::ONE),
            Cause::PixelSampling(crate::texture::PixelSampling::Bilinear),
        ] {
            let guess = found(&[cause], 4);
            assert_eq!(guess.causes, [cause], "{cause:?}: {guess:?}");
            assert!(guess.before > 0 && guess.after == 0, "{cause:?}: {guess:?}");
            assert!((guess.explained() - 1.0).abs() < 1e-12, "{cause:?}: all of it");
        }
    }

    #[test]
    fn hypotheses_find_two_causes_at_once() {
        let both = [Cause::Shifted([0.5, 0.5]), Cause::SwappedChannels];
        let mut guess = found(&both, 4);
        guess.causes.sort_by_key(|cause| *cause == Cause::SwappedChannels);
        assert_eq!((guess.causes.as_slice(), guess.after), (&both[..], 0), "both");
    }

    #[test]
    fn hypotheses_see_truncated_bytes() {
        let scene = scene();
        let view = View::Canvas.transform(scene.canvas, SIZE);
        let settings = RenderSettings::default();
        let mut other = Framebuffer::new(SIZE[0], SIZE[1]);
        render::draw(&scene, &view, &settings, &mut other);
        for pixel in other.pixels_mut().iter_mut().step_by(3) {
            let [a, rgb @ ..] = pixel.to_be_bytes();
            let [r, g, b] = rgb.map(|channel| channel.saturating_sub(1));
            *pixel = u32::from_be_bytes([a, r, g, b]);
        }
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        };
        let guess = guess(&subject, &other, &CancelToken::default()).expect("not cancelled");
        assert_eq!(
            (guess.causes.as_slice(), guess.after),
            (&[Cause::Truncated][..], 0),
            "one level lower"
        );
    }

    #[test]
    fn hypotheses_of_equal_pictures_are_none() {
        let guess = found(&[], 1);
        assert_eq!(
            (guess.causes.len(), guess.before, guess.after),
            (0, 0, 0),
            "nothing to explain"
        );
        assert!((guess.explained() - 1.0).abs() < 1e-12, "nothing is unexplained");
    }

    #[test]
    fn hypotheses_are_given_up() {
        let scene = scene();
        let view = View::Canvas.transform(scene.canvas, SIZE);
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &RenderSettings::default(),
        };
        let cancel = CancelToken::default();
        cancel.cancel();
        assert_eq!(
            guess(&subject, &Framebuffer::new(SIZE[0], SIZE[1]), &cancel),
            None,
            "cancelled"
        );
    }
}
