//! How far a pixel is from the truth, and which settings bring it nearer: each is tried on this very pixel, by the code that
//! draws frames.

use std::collections::BTreeSet;

use super::explanation::Question;
use super::model::{Causes, Cure, Explanation, Setting, Truth};
use crate::post::PostProcess;
use crate::raster::{PixelCoverage, SamplePattern, SampleRate, ShadingRate};
use crate::render::{Nearby, RenderSettings};
use crate::rules::Rules;
use crate::scene::Dialect;
use crate::texture::{
    Anisotropy, Derivatives, FootprintExtent, LevelOfDetail, LevelSampling, LodBias, PixelSampling, PyramidFilter,
};

/// Corners near a pixel above which it is not drawn again and again: it takes some tenths of a second then.
const MOST_WORK: usize = 500_000;
/// A setting has to bring a pixel nearer by more levels than this: less is rounding.
const LEAST: f64 = 1.0;
/// Of several values of a setting the first is taken that brings this part of what the best one does.
const ENOUGH: f64 = 0.75;
/// What brings less than this part of what another setting does is not worth a word.
const WORTH_A_WORD: f64 = 0.25;
/// Texels of a texture above which no sums and ripmaps are made of it for the sake of advice: they would take as long as frames.
const MOST_TABLED: u64 = 1 << 20;
/// Samples per pixel that are many.
const MANY: u32 = 16;
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
        let other_color = draw(&RenderSettings {
            pattern: SamplePattern::Sobol,
            ..settings.truth()
        })?;
        let mut truth = Truth {
            color: true_color,
            distance: distance(self.color, true_color),
            unsure: distance(other_color, true_color),
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
            truth.cures = candidates(settings, texels.max())
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
            truth.cures.retain(|cure| cure.nearer >= best * cure.worth_a_word());
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
            if truth.cures.iter().any(|cure| cure.setting == Setting::SampleRate) {
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
    fn worth_a_word(&self) -> f64 {
        let is_guess = self.setting == Setting::PostProcess && self.value == PostProcess::Smaa.name();
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
    let premultiplied = |[r, g, b, a]: [u8; 4]| {
        let alpha = f64::from(a) / 255.0;
        [r, g, b]
            .map(|channel| f64::from(channel) * alpha)
            .into_iter()
            .chain([f64::from(a)])
    };
    let apart = premultiplied(a).zip(premultiplied(b)).map(|(a, b)| (a - b).abs());
    apart.fold(0.0, f64::max)
}

/// Every setting that may bring a pixel nearer to the truth, with the values that are worth trying, the cheapest first.
/// `texels` is how many the largest texture has that the pixel reads, if it reads any.
fn candidates(own: &RenderSettings, texels: Option<u64>) -> Vec<(Setting, Vec<(String, RenderSettings)>)> {
    let mut all = vec![
        (Setting::Rules, rules(own)),
        (Setting::SampleRate, rates(own)),
        (Setting::Pattern, patterns(own)),
        (Setting::ShadingRate, shading_rates(own)),
        (Setting::PostProcess, post_processes(own)),
        (Setting::Coverage, coverages(own)),
    ];
    if let Some(texels) = texels {
        all.extend(of_textures(own, texels));
    }
    all
}

fn rules(own: &RenderSettings) -> Vec<(String, RenderSettings)> {
    let rules = Rules::Standard;
    let is_other = own.rules != rules;
    is_other
        .then(|| (rules.name().to_owned(), RenderSettings { rules, ..*own }))
        .into_iter()
        .collect()
}

/// The most samples per pixel that the truth, of 256, is surely nearer to what is right than.
const SURE: u32 = 64;

/// The higher sample rates that keys reach, and the highest.
fn rates(own: &RenderSettings) -> Vec<(String, RenderSettings)> {
    let now = own.pattern.nearest(own.sample_rate);
    // So many samples may be as near to what is right as the highest rate, which is the measure here, is itself. A pattern of
    // somebody's own takes one rate only.
    if now.samples() > SURE || is_own(own.pattern) {
        return Vec::new();
    }
    let by_key = std::iter::successors(Some(now), |rate| Some(rate.higher()).filter(|next| next != rate));
    let highest = SampleRate::new(SampleRate::MAX);
    by_key
        .chain(highest)
        .filter(|rate| *rate > now)
        .map(|sample_rate| {
            let settings = RenderSettings { sample_rate, ..*own };
            (sample_rate.samples().to_string(), settings)
        })
        .collect()
}

/// Whether a pattern came from a file, as the `msaa` patterns do.
fn is_own(pattern: SamplePattern) -> bool {
    matches!(pattern, SamplePattern::Custom(_))
}

/// The pattern whose samples share neither columns nor rows; where a single sample lies is luck.
fn patterns(own: &RenderSettings) -> Vec<(String, RenderSettings)> {
    let pattern = SamplePattern::Rotated;
    let now = own.pattern.nearest(own.sample_rate);
    let is_sensible = shares_lines(own) && pattern.takes(now) && now > SampleRate::ONE;
    is_sensible
        .then(|| (pattern.name().to_owned(), RenderSettings { pattern, ..*own }))
        .into_iter()
        .collect()
}

/// Whether samples of a pixel share columns or rows: those of a grid do, and those of some patterns from files.
fn shares_lines(own: &RenderSettings) -> bool {
    match own.pattern {
        SamplePattern::Grid => true,
        SamplePattern::Custom(pattern) => {
            let samples = pattern.samples();
            [0, 1].into_iter().any(|axis| {
                let lines: BTreeSet<u8> = samples.iter().map(|sample| sample.place[axis]).collect();
                lines.len() < samples.len()
            })
        }
        _ => false,
    }
}

/// Where colours are computed once: for the covered samples, where that was not so, and for each of them.
fn shading_rates(own: &RenderSettings) -> Vec<(String, RenderSettings)> {
    let others = match own.shading {
        ShadingRate::Sample => &[][..],
        ShadingRate::Centre => &[ShadingRate::Centroid, ShadingRate::Sample],
        ShadingRate::Centroid => &[ShadingRate::Sample],
    };
    others
        .iter()
        .map(|shading| {
            let settings = RenderSettings {
                shading: *shading,
                ..*own
            };
            (shading.name().to_owned(), settings)
        })
        .collect()
}

/// The other ways to leave or to change finished pixels; these are made for one sample per pixel.
fn post_processes(own: &RenderSettings) -> Vec<(String, RenderSettings)> {
    let is_sensible = |process: &PostProcess| *process == PostProcess::None || own.sample_rate == SampleRate::ONE;
    PostProcess::ALL
        .into_iter()
        .filter(|process| *process != own.post_process && is_sensible(process))
        .map(|post_process| (post_process.name().to_owned(), RenderSettings { post_process, ..*own }))
        .collect()
}

/// Exact areas where there are many samples already or cannot be more, and samples where areas are covered: a few samples more
/// are the first thing to try.
fn coverages(own: &RenderSettings) -> Vec<(String, RenderSettings)> {
    if own.coverage.is_exact() || own.sample_rate.samples() >= MANY || is_own(own.pattern) {
        other_coverage(own)
    } else {
        Vec::new()
    }
}

/// Samples in the place of areas, many and then as many as are surely farther off than the truth; or the other way.
fn other_coverage(own: &RenderSettings) -> Vec<(String, RenderSettings)> {
    let by = |coverage: PixelCoverage, sample_rate: SampleRate| {
        let settings = RenderSettings {
            sample_rate,
            coverage,
            ..*own
        };
        (coverage.name().to_owned(), settings)
    };
    if !own.coverage.is_exact() {
        return vec![by(PixelCoverage::Exact, own.sample_rate)];
    }
    let many = sampled_at(own);
    // All rates between would be drawn for a word that says little more. Smoothing is made for one sample, and draws many pixels.
    let is_sensible = !is_own(own.pattern) && own.post_process == PostProcess::None;
    let more = SampleRate::new(SURE).filter(|more| *more > many && is_sensible);
    std::iter::once(many)
        .chain(more)
        .map(|rate| by(PixelCoverage::Sampled, rate))
        .collect()
}

/// At which rate samples are tried where areas are covered, which hides the rate in use: few samples are no match for areas.
fn sampled_at(own: &RenderSettings) -> SampleRate {
    let many = SampleRate::new(MANY).unwrap_or(own.sample_rate);
    if is_own(own.pattern) {
        own.sample_rate
    } else {
        own.sample_rate.max(many)
    }
}

/// Levels, and areas of textures.
fn level_samplings(own: &RenderSettings, texels: u64) -> Vec<(String, RenderSettings)> {
    let has_tables = texels <= MOST_TABLED;
    let is_of_table = |level: &LevelSampling| matches!(level, LevelSampling::Ripmap | LevelSampling::SummedArea);
    // The cheapest first.
    let levels = [
        LevelSampling::Linear,
        LevelSampling::Nearest,
        LevelSampling::Ripmap,
        LevelSampling::SummedArea,
        LevelSampling::Ewa,
    ];
    levels
        .into_iter()
        .filter(|level| *level != own.level_sampling && (has_tables || !is_of_table(level)))
        .map(|level_sampling| {
            let settings = RenderSettings { level_sampling, ..*own };
            (level_sampling.name().to_owned(), settings)
        })
        .collect()
}

/// The ways to read between texels, of textures and of patterns' tiles.
fn pixel_samplings(own: &RenderSettings) -> Vec<(String, RenderSettings)> {
    PixelSampling::ALL
        .into_iter()
        .filter(|sampling| *sampling != PixelSampling::Nearest && *sampling != own.pixel_sampling)
        .map(|pixel_sampling| {
            let settings = RenderSettings { pixel_sampling, ..*own };
            (pixel_sampling.name().to_owned(), settings)
        })
        .collect()
}

/// `texels` is how many the largest texture has.
fn of_textures(own: &RenderSettings, texels: u64) -> Vec<(Setting, Vec<(String, RenderSettings)>)> {
    let detail = |value: &str, changes: bool, detail: LevelOfDetail| {
        let settings = RenderSettings { detail, ..*own };
        changes.then(|| (value.to_owned(), settings)).into_iter().collect()
    };
    let taps = Anisotropy::STEPS
        .into_iter()
        .filter(|anisotropy| *anisotropy > own.anisotropy)
        .map(|anisotropy| (anisotropy.taps().to_string(), RenderSettings { anisotropy, ..*own }));
    let automatic = LevelOfDetail {
        fixed: None,
        ..own.detail
    };
    let unbiased = LevelOfDetail {
        bias: LodBias::default(),
        ..own.detail
    };
    let per_sample = LevelOfDetail {
        derivatives: Derivatives::Sample,
        ..own.detail
    };
    let longer = LevelOfDetail {
        extent: FootprintExtent::Longer,
        ..own.detail
    };
    // Averaged as samples are.
    let pyramid = (own.pyramid != own.resolve).then(|| {
        let settings = RenderSettings {
            pyramid: own.resolve,
            ..*own
        };
        (own.resolve.name().to_owned(), settings)
    });
    let boxed = (own.pyramid_filter != PyramidFilter::Box).then(|| {
        let settings = RenderSettings {
            pyramid_filter: PyramidFilter::Box,
            ..*own
        };
        (PyramidFilter::Box.name().to_owned(), settings)
    });
    vec![
        (Setting::PyramidFilter, boxed.into_iter().collect()),
        (Setting::Pyramid, pyramid.into_iter().collect()),
        (Setting::LodLevel, detail("auto", own.detail.fixed.is_some(), automatic)),
        (Setting::LodBias, detail("0", own.detail != unbiased, unbiased)),
        (Setting::LevelSampling, level_samplings(own, texels)),
        (Setting::Anisotropy, taps.collect()),
        (Setting::LodBy, detail("longer", own.detail != longer, longer)),
        // Where one colour is computed for all samples, none of them reads a texture itself.
        (
            Setting::LodPer,
            detail("sample", own.detail != per_sample && !own.shading.is_once(), per_sample),
        ),
        (Setting::PixelSampling, pixel_samplings(own)),
    ]
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

    #[test]
    fn candidates_are_other_settings() {
        let own = RenderSettings::default();
        for texels in [None, Some(1), Some(u64::MAX)] {
            for (setting, values) in candidates(&own, texels) {
                for (value, settings) in values {
                    assert!(settings != own, "{setting:?} {value}");
                }
            }
        }
        let rates: Vec<String> = rates(&own).into_iter().map(|(value, _)| value).collect();
        assert_eq!(rates, ["4", "9", "16", "25", "36", "49", "64", "256"], "cheapest first");
    }
}
