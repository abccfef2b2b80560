//! How far a pixel is from the truth, and which settings bring it nearer: each is tried on this very pixel, by the code that
//! draws frames.

use super::candidates::{ReadTextures, candidates, is_own, other_coverage, pixel_samplings};
use super::explanation::Question;
use super::model::{Causes, Cure, Explanation, Setting, Truth};
use crate::post::PostProcess;
use crate::raster::SamplePattern;
use crate::render::{Nearby, RenderSettings};
use crate::scene::Dialect;
use crate::texture::LevelSampling;

/// Corners near a pixel above which it is not drawn again and again: it takes some tenths of a second then.
const MOST_WORK: usize = 500_000;
/// A setting has to bring a pixel nearer by more levels than this: less is rounding.
const LEAST: f64 = 1.0;
/// Of several values of a setting the first is taken that brings this part of what the best one does.
const ENOUGH: f64 = 0.75;
/// What brings less than this part of what another setting does is not worth a word.
const WORTH_A_WORD: f64 = 0.25;
/// Settings that are told at most.
const MOST_CURES: usize = 3;

impl Explanation {
    /// Why a pixel has its colour, how far it is from the truth and what brings it nearer; `None` outside the picture.
    pub fn advised(question: &Question<'_>) -> Option<Self> {
        let mut explanation = Self::with_masks(question)?;
        let nearby = Nearby::new(&question.subject, question.size, question.pixel);
        let is_little = nearby.work() <= MOST_WORK;
        if is_little {
            explanation.find_shown(question, &nearby);
        }
        explanation
            .missed
            .retain(|missed| !missed.in_mask || missed.shown > Some(0.0));
        if is_little {
            explanation.truth = explanation.find_truth(question, &nearby);
        } else {
            explanation.untried = Some(nearby.work());
        }
        Some(explanation)
    }

    /// `None` outside the picture.
    fn find_truth(&self, question: &Question<'_>, nearby: &Nearby<'_>) -> Option<Truth> {
        let settings = question.subject.settings;
        let draw = |settings: &RenderSettings| {
            let [a, r, g, b] = nearby.pixel(settings)?.to_be_bytes();
            Some([r, g, b, a])
        };
        let true_color = draw(&settings.truth())?;
        // Exact areas may be nearer to what is right than any samples are: more sets of them tell how sure the truth is.
        let others = [SamplePattern::Sobol, SamplePattern::Halton, SamplePattern::R2];
        let others = if settings.coverage.is_exact() {
            &others[..]
        } else {
            &others[..1]
        };
        let mut unsure = 0.0_f64;
        for pattern in others {
            let color = draw(&RenderSettings {
                pattern: *pattern,
                ..settings.truth()
            })?;
            unsure = unsure.max(distance(color, true_color));
        }
        let mut truth = Truth {
            color: true_color,
            distance: distance(self.color, true_color),
            unsure,
            cures: Vec::new(),
            causes: Causes::default(),
        };
        // Nothing can bring it nearer by more than it is away.
        if !truth.is_reached() {
            let textures = self.paints.iter().filter_map(|paint| paint.texture.as_ref());
            let texels = textures.map(|texture| u64::from(texture.size[0]) * u64::from(texture.size[1]));
            let tiles = self.paints.iter().any(|paint| paint.pattern.is_some());
            let of_tiles =
                (tiles && texels.clone().next().is_none()).then(|| (Setting::PixelSampling, pixel_samplings(settings)));
            let textures = texels.max().map(|texels| ReadTextures {
                texels,
                closely: self.reads_closely(),
            });
            truth.cures = candidates(settings, textures)
                .into_iter()
                .chain(of_tiles)
                .filter(|(setting, _)| *setting != Setting::PixelSampling || !self.is_luck_between_texels())
                .filter_map(|(setting, values)| truth.cure(setting, values, draw))
                .collect();
            if truth.cures.is_empty() {
                let coverage = truth.cure(Setting::Coverage, other_coverage(settings), draw);
                truth.cures.extend(coverage);
            }
            truth.cures.sort_by(|a, b| b.nearer.total_cmp(&a.nearer));
            let best = truth.cures.first().map_or(0.0, |cure| cure.nearer);
            truth
                .cures
                .retain(|cure| cure.nearer >= best * cure.worth_a_word(settings));
            truth.cures.truncate(MOST_CURES);
            for cure in &mut truth.cures {
                let is_other = cure.setting == Setting::Pattern && is_own(settings.pattern);
                let is_more = cure.setting == Setting::Coverage
                    && settings.coverage.is_exact()
                    && cure.samples != Some(settings.sample_rate.samples());
                cure.samples = cure.samples.filter(|_| is_other || is_more);
                let is_of_course = cure.setting == Setting::Rules && question.subject.scene.dialect == Dialect::Course;
                cure.dialect = is_of_course.then_some(Dialect::Course.name());
            }
            if !truth.cures.is_empty() {
                truth.causes = self.causes(nearby, settings, &truth);
            }
        }
        Some(truth)
    }
}

impl Cure {
    /// What it brings, beside other values of its setting. An area takes several times as long as levels, and has to bring twice as
    /// much.
    fn worth(&self) -> f64 {
        if self.weighs_area() {
            self.nearer / 2.0
        } else {
            self.nearer
        }
    }

    /// Whether it makes samples weigh areas of textures.
    pub(super) fn weighs_area(&self) -> bool {
        let mut areas = LevelSampling::ALL.into_iter().filter(|level| level.weighs_area());
        self.setting == Setting::LevelSampling && areas.any(|level| level.name() == self.value)
    }

    /// The part of what the best setting does that this one has to do. A guess has to fit as well as samples do.
    fn worth_a_word(&self, settings: &RenderSettings) -> f64 {
        let is_guess = match self.setting {
            Setting::PostProcess => self.value == PostProcess::Smaa.name(),
            // Levels that are not averaged as samples are.
            Setting::Pyramid => self.value != settings.resolve.name(),
            _ => false,
        };
        if is_guess { ENOUGH } else { WORTH_A_WORD }
    }
}

impl Truth {
    /// Whether the pixel is as near to it as can be told.
    pub(super) fn is_reached(&self) -> bool {
        self.distance <= self.least()
    }

    /// A setting has to bring a pixel nearer by more levels than this.
    pub(super) fn least(&self) -> f64 {
        LEAST.max(self.unsure)
    }

    /// The first of a setting's values that brings nearly as much as the best one.
    fn cure(
        &self,
        setting: Setting,
        values: Vec<(String, RenderSettings)>,
        draw: impl Fn(&RenderSettings) -> Option<[u8; 4]>,
    ) -> Option<Cure> {
        let tried = values.into_iter().filter_map(|(value, settings)| {
            let color = draw(&settings)?;
            let nearer = self.distance - distance(color, self.color);
            (nearer > self.least()).then_some(Cure {
                setting,
                value,
                color,
                nearer,
                samples: Some(settings.sample_rate.samples()),
                dialect: None,
            })
        });
        let tried: Vec<Cure> = tried.collect();
        let best = tried.iter().map(Cure::worth).fold(0.0, f64::max);
        tried.into_iter().find(|cure| cure.worth() >= best * ENOUGH)
    }
}

/// How far two colours are apart: the largest difference of a channel, in levels, when both are premultiplied.
pub(super) fn distance(a: [u8; 4], b: [u8; 4]) -> f64 {
    let apart = premultiplied(a).into_iter().zip(premultiplied(b));
    apart.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// A straight colour, premultiplied, in levels.
pub(super) fn premultiplied([r, g, b, a]: [u8; 4]) -> [f64; 4] {
    let alpha = f64::from(a) / 255.0;
    let [r, g, b] = [r, g, b].map(|channel| f64::from(channel) * alpha);
    [r, g, b, f64::from(a)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_is_of_what_is_seen() {
        for (a, b, expected) in [
            ([10, 20, 30, 255], [10, 20, 30, 255], 0.0),
            ([10, 20, 30, 255], [13, 15, 30, 255], 5.0),
            ([255, 0, 0, 0], [0, 255, 0, 0], 0.0),
            ([255, 0, 0, 51], [0, 0, 0, 51], 51.0),
            ([0, 0, 0, 0], [0, 0, 0, 255], 255.0),
        ] {
            let found = distance(a, b);
            assert!((found - expected).abs() < 1e-9, "{a:?} to {b:?} is {found}");
        }
    }
}
