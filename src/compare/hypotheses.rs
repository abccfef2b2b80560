//! A guess at why a picture from outside differs from ours: our scene is drawn under known causes, one by one and together,
//! and those count that explain what others do not.
//!
//! A cause must leave at most two fifths of the squared error that is left without it. Less would prove nothing: where two
//! pictures have nothing in common, a smoother one of them leaves up to a half.

use std::time::{Duration, Instant};

use super::cause::{Cause, drawn_otherwise, finished_otherwise};
use super::trial::Trial;
use super::truncation::truncated_errors;
use crate::post::PostProcess;
use crate::raster::{Framebuffer, SampleRate};
use crate::render::{CancelToken, Subject};
use crate::rules::Rules;

/// Most causes that are told together.
const MAX_CAUSES: usize = 3;
/// The part of the error that a cause may leave of what is left without it.
const MARGIN: f64 = 0.4;
/// How many of the best combinations of one, and of two causes, are tried with one cause more; of single causes all kinds.
const BEAMS: [usize; MAX_CAUSES - 1] = [8, 3];
/// The part of the error that is not worth looking for causes.
const NEGLIGIBLE: f64 = 1e-3;
/// Ways to finish a frame that are tried with everything else.
const FINISHES: usize = 3;

/// What makes our picture most like another.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// What the other renderer does otherwise, all of it at once, the weightiest first. Empty where nothing known explains
    /// the difference.
    pub causes: Vec<Cause>,
    /// The sum of squared differences over pixels and channels that our picture has, in levels of 255 squared.
    pub before: u64,
    /// The same when our picture is drawn under these causes.
    pub after: u64,
    /// Whether time was up before everything was tried.
    pub stopped: bool,
}

impl Guess {
    /// How long is searched at most, but for the drawing that is under way then.
    pub const BUDGET: Duration = Duration::from_secs(8);

    /// The share of the squared difference that the causes explain, from 0 to 1.
    pub fn explained(&self) -> f64 {
        if self.before == 0 {
            return 1.0;
        }
        // Sums stay far below 2^53.
        1.0 - self.after as f64 / self.before as f64
    }

    /// Whether the causes leave more of the difference than rounding may: other ones may leave as little, and so may more of them than
    /// are tried together.
    pub fn leaves_a_part(&self) -> bool {
        1.0 - self.explained() > NEGLIGIBLE
    }
}

/// Finds what makes the picture of `subject` most like `other`, a picture of the same scene by another renderer. Draws
/// the scene at the size of `other` some hundred times, at most 600, for as long as `budget` allows; no more once the picture is
/// the other, byte by byte. `None` once `cancel` says so.
///
/// Where the other picture is transparent and ours is not, and that is most of what differs, that is a cause, and the others are
/// looked for on a transparent background.
pub fn guess(subject: &Subject<'_>, other: &Framebuffer, budget: Duration, cancel: &CancelToken) -> Option<Guess> {
    let trial = Trial { subject, other, cancel };
    let clear = Cause::TransparentBackground;
    if subject.settings.background.a >= 1.0 && other.pixels().iter().any(|pixel| pixel >> 24 < 255) {
        let error = |causes: &[Cause]| Some(trial.error(&trial.draw(causes)?, &[]));
        let before = error(&[])?;
        // Many renderers have neither a background nor a margin.
        let opaque = before.min(error(&[Cause::Filled])?);
        let transparent = error(&[clear])?.min(error(&[clear, Cause::Filled])?);
        if transparent as f64 <= MARGIN * opaque as f64 {
            let settings = trial.settings(&[clear]);
            let subject = Subject {
                settings: &settings,
                ..*subject
            };
            let mut guess = search(
                &Trial {
                    subject: &subject,
                    other,
                    cancel,
                },
                budget,
            )?;
            guess.causes.insert(0, clear);
            guess.before = before;
            return Some(guess);
        }
    }
    search(&trial, budget)
}

/// Tries causes until one explains all, or time is up.
fn search(trial: &Trial<'_>, budget: Duration) -> Option<Guess> {
    let mut search = Search::new(trial, budget)?;
    search.run()?;
    let mut guess = search.guess();
    // Truncated bytes alone look like the course's rules, of which they are a part.
    let course = Cause::Rules(Rules::Course);
    if (guess.after > 0 || guess.causes.contains(&course)) && !search.stopped {
        consider_truncation(trial, &mut guess)?;
    }
    Some(guess)
}

/// Some causes and the error that they leave.
#[derive(Clone, Debug)]
struct Found {
    causes: Vec<Cause>,
    error: u64,
}

/// The way through combinations of causes.
struct Search<'a> {
    trial: &'a Trial<'a>,
    /// Nothing, and the best of one cause, of two and of three.
    best: Vec<Option<Found>>,
    /// What single causes leave.
    alone: Vec<(Cause, u64)>,
    /// Ways to finish a frame that are worth trying with others; the first is none.
    finishes: Vec<Vec<Cause>>,
    until: Option<Instant>,
    /// How long one drawing took.
    one: Duration,
    stopped: bool,
}

impl<'a> Search<'a> {
    /// Draws the scene as it is.
    fn new(trial: &'a Trial<'a>, budget: Duration) -> Option<Self> {
        let start = Instant::now();
        let mut search = Self {
            trial,
            best: vec![None; MAX_CAUSES + 1],
            alone: Vec::new(),
            finishes: finished_otherwise(),
            until: start.checked_add(budget),
            one: Duration::ZERO,
            stopped: false,
        };
        let mut errors = search.consider(&[])?;
        search.one = start.elapsed();
        // The first is nothing, which stays.
        errors[1..].sort_by_key(|(error, _)| *error);
        search.finishes = errors.into_iter().take(FINISHES).map(|(_, finish)| finish).collect();
        Some(search)
    }

    /// Tries single causes, then what goes with the best of them.
    fn run(&mut self) -> Option<()> {
        let causes = drawn_otherwise(self.trial.subject, self.trial.size());
        let mut beam: Vec<Vec<Cause>> = vec![Vec::new()];
        for count in 0..MAX_CAUSES {
            let mut next: Vec<(u64, Vec<Cause>)> = Vec::new();
            let readings = if count == 1 { readings(&causes) } else { Vec::new() };
            let sets = beam.iter().flat_map(|set| {
                let fitting = causes.iter().filter(|cause| cause.goes_with(set));
                fitting.map(move |cause| [set.as_slice(), &[*cause]].concat())
            });
            for together in readings.into_iter().chain(sets) {
                let known = next.iter().any(|(_, known)| is_same(known, &together));
                if known || !self.makes_sense(&together) {
                    continue;
                }
                if self.is_exact() {
                    return Some(());
                }
                if !self.has_time_for(&together) {
                    self.stopped = true;
                    continue;
                }
                let errors = self.consider(&together)?;
                let least = errors.iter().map(|(error, _)| *error).min().unwrap_or(u64::MAX);
                next.push((least, together));
            }
            next.sort_by_key(|(error, _)| *error);
            beam.clear();
            if self.is_all_but_exact() {
                // One sampling of textures may look like a pair of others, which are tried yet, but nothing else.
                if count == 0 {
                    continue;
                }
                return Some(());
            }
            for (_, set) in next {
                // The best of a kind: two shifts are better than no sample rate, but each goes with others.
                let is_new = beam.iter().all(|known| !is_akin(known, &set));
                if is_new && beam.len() < BEAMS.get(count).copied().unwrap_or(0) {
                    beam.push(set);
                }
            }
        }
        Some(())
    }

    /// Draws under causes, and notes what is left with each way to finish the frame.
    fn consider(&mut self, causes: &[Cause]) -> Option<Vec<(u64, Vec<Cause>)>> {
        let frame = self.trial.draw(causes)?;
        let mut errors = Vec::new();
        for finish in self.finishes.clone() {
            let together = [causes, &finish].concat();
            if together.len() > MAX_CAUSES {
                continue;
            }
            let error = self.trial.error(&frame, &finish);
            errors.push((error, finish));
            if let [cause] = together.as_slice() {
                self.alone.push((*cause, error));
            }
            let best = &mut self.best[together.len()];
            // What looks the same without hairlines and points is told as what is known to happen.
            let rank = |causes: &[Cause]| causes.iter().any(|cause| matches!(cause, Cause::Shifted(_)));
            let is_better = |best: &Found| (error, rank(&together)) < (best.error, rank(&best.causes));
            if best.as_ref().is_none_or(is_better) {
                *best = Some(Found {
                    causes: together,
                    error,
                });
            }
        }
        Some(errors)
    }

    /// Whether some causes explain everything.
    fn is_exact(&self) -> bool {
        self.best.iter().flatten().any(|found| found.error == 0)
    }

    /// Whether what is left is not worth the time.
    fn is_all_but_exact(&self) -> bool {
        let before = self.best[0].as_ref().map_or(0, |found| found.error) as f64;
        let mut found = self.best.iter().flatten();
        found.any(|found| found.error as f64 <= NEGLIGIBLE * before)
    }

    /// Whether each cause makes a difference beside the others.
    fn makes_sense(&self, causes: &[Cause]) -> bool {
        let settings = self.trial.settings(causes);
        let is_single = settings.sample_rate == SampleRate::ONE;
        let is_exact = settings.coverage.is_exact();
        let is_smoothed = settings.post_process == PostProcess::Smaa;
        causes.iter().all(|cause| match cause {
            Cause::Resolve(_) => !is_single || is_exact || is_smoothed,
            Cause::Shading(_) => !is_single && !is_exact,
            Cause::SampleRate(_) => !is_exact && !causes.contains(&Cause::PostProcess(PostProcess::Smaa)),
            Cause::Corners(_) => !is_exact,
            _ => true,
        })
    }

    /// Whether another drawing will be done in time: as many times more samples take as many times longer at most.
    fn has_time_for(&self, causes: &[Cause]) -> bool {
        let samples = |causes| f64::from(self.trial.settings(causes).sample_rate.samples());
        let needed = self.one.mul_f64((samples(causes) / samples(&[])).max(1.0));
        let left = self.until.map(|until| until.saturating_duration_since(Instant::now()));
        left.is_none_or(|left| needed < left)
    }

    /// The most causes of which each explains what the others do not.
    fn guess(&self) -> Guess {
        let error_of = |count: usize| self.best[count].as_ref().map(|found| found.error);
        let before = error_of(0).unwrap_or(0);
        let mut chosen = 0;
        for count in 1..=MAX_CAUSES {
            let Some(error) = error_of(count) else { continue };
            let mut fewer = (0..count).filter_map(|fewer| Some((fewer, error_of(fewer)?)));
            // Clearly below any guess with fewer causes, and below none at all by that step once for each cause.
            let is_far_below = |(fewer, error_of_fewer): (usize, u64)| {
                let times = if fewer == 0 { count } else { 1 };
                error as f64 <= (0..times).fold(error_of_fewer as f64, |error, _| error * MARGIN)
            };
            // Of two that leave nothing, that with fewer is enough.
            let is_less = fewer.clone().all(|(_, error_of_fewer)| error < error_of_fewer);
            if is_less && fewer.all(is_far_below) {
                chosen = count;
            }
        }
        let found = self.best[chosen].clone();
        let mut causes = found.as_ref().map_or_else(Vec::new, |found| found.causes.clone());
        let alone = |cause: &Cause| {
            self.alone
                .iter()
                .find(|(known, _)| known == cause)
                .map(|(_, error)| *error)
        };
        causes.sort_by_key(|cause| alone(cause).unwrap_or(u64::MAX));
        Guess {
            causes,
            before,
            after: found.map_or(before, |found| found.error),
            stopped: self.stopped,
        }
    }
}

/// The pairs of a pixel and a level sampling, at most 20. All of them are tried: each of the two hides what the other does, so
/// that neither needs to be the best of its kind alone.
fn readings(causes: &[Cause]) -> Vec<Vec<Cause>> {
    let levels = || causes.iter().filter(|cause| matches!(cause, Cause::LevelSampling(_)));
    let pixels = causes.iter().filter(|cause| matches!(cause, Cause::PixelSampling(_)));
    pixels
        .flat_map(|pixel| levels().map(|level| vec![*pixel, *level]))
        .collect()
}

/// Whether two lists hold the same causes.
fn is_same(a: &[Cause], b: &[Cause]) -> bool {
    a.len() == b.len() && a.iter().all(|cause| b.contains(cause))
}

/// Whether two lists hold causes of the same kinds.
fn is_akin(a: &[Cause], b: &[Cause]) -> bool {
    a.len() == b.len() && a.iter().all(|cause| b.iter().any(|other| other.is_akin(*cause)))
}

/// Adds truncated bytes to a guess where they explain what is left; in place of the course's rules, of which they are a part,
/// where those explain no more.
fn consider_truncation(trial: &Trial<'_>, guess: &mut Guess) -> Option<()> {
    let course = Cause::Rules(Rules::Course);
    if trial.settings(&guess.causes).rules == Rules::Course && !guess.causes.contains(&course) {
        return Some(());
    }
    let others: Vec<Cause> = guess.causes.iter().copied().filter(|cause| *cause != course).collect();
    if others.len() == MAX_CAUSES {
        return Some(());
    }
    let [before, after] = truncated_errors(trial, &others)?;
    // What those rules explain beside truncation, of two roundings that are never quite the same.
    let less = after - guess.after as f64;
    let explains = after <= MARGIN * before && before > 0.0;
    if explains && (less <= NEGLIGIBLE.sqrt() * before || guess.after as f64 > MARGIN * after) {
        guess.causes = [others.as_slice(), &[Cause::Truncated]].concat();
        guess.after = whole(after);
    }
    Some(())
}

/// An estimate that is not nothing stays above it.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "sums stay far below 2^53"
)]
fn whole(error: f64) -> u64 {
    error.ceil() as u64
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DVec2;

    use super::*;
    use crate::color::Rgba;
    use crate::geometry::View;
    use crate::raster::PixelCoverage;
    use crate::render::{self, RenderSettings};
    use crate::scene::{self, Dialect, DialectChoice, Paint, Primitive, PrimitiveKind, Scene, ShapeId, TextureId};
    use crate::texture::{LevelSampling, PixelSampling, Texture};

    const SIZE: [u32; 2] = [64, 48];

    /// A triangle of mixed colours and one with a texture, neither of them symmetric.
    fn scene() -> Scene {
        let mut scene = Scene::empty(DVec2::new(64.0, 48.0), Dialect::Svg);
        scene.textures = Arc::new([Arc::new(Texture::missing("checker"))]);
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

    /// What is guessed within a time where `change` was done to our own picture.
    fn guessed(change: impl Fn(usize, u32) -> u32, budget: Duration) -> Guess {
        let scene = scene();
        let view = View::Canvas.transform(scene.canvas, SIZE);
        let settings = RenderSettings::default();
        let mut other = Framebuffer::new(SIZE[0], SIZE[1]);
        render::draw(&scene, &view, &settings, &mut other);
        for (index, pixel) in other.pixels_mut().iter_mut().enumerate() {
            *pixel = change(index, *pixel);
        }
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        };
        guess(&subject, &other, budget, &CancelToken::default()).expect("not cancelled")
    }

    #[test]
    fn hypotheses_ask_for_more_than_smoothness() {
        // Random pixels: whatever is smooth is nearer to them than what is not.
        let random = |index: usize, _| {
            let number = u32::try_from(index).expect("a small picture");
            0xFF00_0000 | number.wrapping_mul(2_654_435_761) >> 8
        };
        let guess = guessed(random, Duration::from_mins(2));
        assert_eq!((guess.causes.as_slice(), guess.stopped), (&[][..], false), "{guess:?}");
        assert_eq!(guess.after, guess.before, "nothing is explained");
    }

    #[test]
    fn hypotheses_tell_truncated_bytes_from_lower_ones() {
        // Every byte one lower, whether or not truncating would have lowered it.
        let lower = |_, pixel: u32| {
            let [a, rgb @ ..] = pixel.to_be_bytes();
            let [r, g, b] = rgb.map(|channel| channel.saturating_sub(1));
            u32::from_be_bytes([a, r, g, b])
        };
        let guess = guessed(lower, Guess::BUDGET);
        assert_eq!(guess.causes, [], "{guess:?}");
    }

    #[test]
    fn hypotheses_stop_when_time_is_up() {
        let swapped = |_, pixel: u32| pixel & 0xFF00_FF00 | (pixel & 0xFF) << 16 | pixel >> 16 & 0xFF;
        let moved = |index: usize, pixel: u32| if index < 64 * 7 { 0xFF00_0000 } else { pixel };
        assert!(guessed(moved, Duration::ZERO).stopped, "more could be tried");
        let guess = guessed(swapped, Duration::ZERO);
        assert_eq!(
            (guess.causes.as_slice(), guess.stopped),
            (&[Cause::SwappedChannels][..], false),
            "nothing more is needed"
        );
    }

    #[test]
    fn hypotheses_of_equal_pictures_are_none() {
        let guess = guessed(|_, pixel| pixel, Duration::ZERO);
        assert_eq!(
            (guess.causes.len(), guess.before, guess.after, guess.stopped),
            (0, 0, 0, false),
            "nothing to explain"
        );
        assert!((guess.explained() - 1.0).abs() < 1e-12, "nothing is unexplained");
    }

    #[test]
    fn hypotheses_know_pictures_without_a_margin() {
        let scene = scene();
        let settings = RenderSettings::default();
        let view = View::Canvas.transform(scene.canvas, SIZE);
        for (coverage, causes) in [
            (PixelCoverage::Sampled, &[Cause::Filled][..]),
            (
                PixelCoverage::Exact,
                &[Cause::Filled, Cause::Coverage(PixelCoverage::Exact)],
            ),
        ] {
            let drawn = RenderSettings {
                coverage,
                outline: false,
                ..settings
            };
            let mut other = Framebuffer::new(SIZE[0], SIZE[1]);
            render::draw(&scene, &view, &drawn, &mut other);
            let subject = Subject {
                scene: &scene,
                view: &View::Default.transform(scene.canvas, SIZE),
                settings: &settings,
            };
            let guess =
                guess(&subject, &other, Duration::from_mins(2), &CancelToken::default()).expect("not cancelled");
            assert_eq!((guess.causes.as_slice(), guess.after), (causes, 0), "{guess:?}");
        }
    }

    #[test]
    fn hypotheses_know_pictures_on_a_transparent_background() {
        let scene = scene();
        let settings = RenderSettings::default();
        let view = View::Canvas.transform(scene.canvas, SIZE);
        for (coverage, more) in [
            (PixelCoverage::Sampled, None),
            (PixelCoverage::Exact, Some(Cause::Coverage(PixelCoverage::Exact))),
        ] {
            let drawn = RenderSettings {
                coverage,
                background: Rgba::TRANSPARENT,
                ..settings
            };
            let mut other = Framebuffer::new(SIZE[0], SIZE[1]);
            render::draw(&scene, &view, &drawn, &mut other);
            let subject = Subject {
                scene: &scene,
                view: &view,
                settings: &settings,
            };
            let guess =
                guess(&subject, &other, Duration::from_mins(2), &CancelToken::default()).expect("not cancelled");
            let causes: Vec<Cause> = [Cause::TransparentBackground].into_iter().chain(more).collect();
            assert_eq!((guess.causes.as_slice(), guess.after), (&*causes, 0), "{guess:?}");
            assert!(guess.explained() > 0.999, "{guess:?}");
        }
    }

    #[test]
    fn hypotheses_tell_pixel_from_level_sampling() {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/study/25_few_texels.svg");
        let scene = scene::load(&path, DialectChoice::Course).expect("a scene of the gallery");
        let size = [40, 40];
        let view = View::Canvas.transform(scene.canvas, size);
        let settings = RenderSettings::default();
        for (level_sampling, pixel_sampling) in [
            (LevelSampling::Linear, PixelSampling::Bilinear),
            (LevelSampling::Nearest, PixelSampling::Bilinear),
            (LevelSampling::Nearest, PixelSampling::Mitchell),
            (LevelSampling::Linear, PixelSampling::Mitchell),
        ] {
            let drawn = RenderSettings {
                pixel_sampling,
                level_sampling,
                ..settings
            };
            let mut other = Framebuffer::new(size[0], size[1]);
            render::draw(&scene, &view, &drawn, &mut other);
            let subject = Subject {
                scene: &scene,
                view: &view,
                settings: &settings,
            };
            let guess =
                guess(&subject, &other, Duration::from_mins(2), &CancelToken::default()).expect("not cancelled");
            let causes = [
                Cause::LevelSampling(level_sampling),
                Cause::PixelSampling(pixel_sampling),
            ];
            assert!(
                is_same(&guess.causes, &causes) && guess.after == 0,
                "{causes:?}: {guess:?}"
            );
        }
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
            guess(&subject, &Framebuffer::new(SIZE[0], SIZE[1]), Guess::BUDGET, &cancel),
            None,
            "cancelled"
        );
    }
}
