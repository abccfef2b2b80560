//! The settings that are worth trying on a pixel that is not what it should be, and their values.

use std::collections::BTreeSet;

use super::model::Setting;
use crate::color::ResolveSpace;
use crate::post::PostProcess;
use crate::raster::{PixelCoverage, SamplePattern, SampleRate, ShadingRate};
use crate::render::RenderSettings;
use crate::rules::Rules;
use crate::texture::{
    Anisotropy, Derivatives, FootprintExtent, LevelOfDetail, LevelSampling, LodBias, PixelSampling, PyramidFilter,
};

/// Texels of a texture above which nothing is made of it for the sake of advice, such as sums and ripmaps: it would take as long as
/// frames.
const MOST_TABLED: u64 = 1 << 20;
/// Samples per pixel that are many.
const MANY: u32 = 16;

/// The textures that a pixel reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ReadTextures {
    /// How many texels the largest one has.
    pub(super) texels: u64,
    /// Whether the places that are read lie so close together that level 0 alone can be read there.
    pub(super) closely: bool,
}

/// Every setting that may bring a pixel nearer to the truth, with the values that are worth trying, the cheapest first.
/// `textures` are those that the pixel reads, if it reads any.
pub(super) fn candidates(
    own: &RenderSettings,
    textures: Option<ReadTextures>,
) -> Vec<(Setting, Vec<(String, RenderSettings)>)> {
    let mut all = vec![
        (Setting::Rules, rules(own)),
        (Setting::SampleRate, rates(own)),
        (Setting::Pattern, patterns(own)),
        (Setting::ShadingRate, shading_rates(own)),
        (Setting::PostProcess, post_processes(own)),
        (Setting::Coverage, coverages(own)),
    ];
    if let Some(textures) = textures {
        all.extend(of_textures(own, textures));
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
pub(super) fn is_own(pattern: SamplePattern) -> bool {
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
pub(super) fn other_coverage(own: &RenderSettings) -> Vec<(String, RenderSettings)> {
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

/// Levels, and areas of textures; level 0 alone where no texel is left out then.
fn level_samplings(own: &RenderSettings, textures: ReadTextures) -> Vec<(String, RenderSettings)> {
    let has_tables = textures.texels <= MOST_TABLED;
    // A fixed level is read by level sampling zero, too.
    let reads_base = textures.closely && own.detail.fixed.is_none();
    let is_sensible = |level: &LevelSampling| match level {
        LevelSampling::Zero => reads_base,
        LevelSampling::Ripmap | LevelSampling::SummedArea => has_tables,
        LevelSampling::Linear | LevelSampling::Nearest | LevelSampling::Ewa => true,
    };
    // The cheapest first.
    let levels = [
        LevelSampling::Zero,
        LevelSampling::Linear,
        LevelSampling::Nearest,
        LevelSampling::Ripmap,
        LevelSampling::SummedArea,
        LevelSampling::Ewa,
    ];
    levels
        .into_iter()
        .filter(|level| *level != own.level_sampling && is_sensible(level))
        .map(|level_sampling| {
            let settings = RenderSettings { level_sampling, ..*own };
            (level_sampling.name().to_owned(), settings)
        })
        .collect()
}

/// The values in which levels were not averaged: those that samples are averaged in, or else the other ones, which may happen to come
/// nearer.
fn pyramids(own: &RenderSettings, textures: ReadTextures) -> Vec<(String, RenderSettings)> {
    let reads_levels = own.level_sampling != LevelSampling::Zero || own.detail.fixed.is_some();
    let is_sensible = |space: ResolveSpace| space == own.resolve || (reads_levels && textures.texels <= MOST_TABLED);
    ResolveSpace::ALL
        .into_iter()
        .filter(|space| *space != own.pyramid && is_sensible(*space))
        .map(|pyramid| (pyramid.name().to_owned(), RenderSettings { pyramid, ..*own }))
        .collect()
}

/// The ways to read between texels, of textures and of patterns' tiles.
pub(super) fn pixel_samplings(own: &RenderSettings) -> Vec<(String, RenderSettings)> {
    PixelSampling::ALL
        .into_iter()
        .filter(|sampling| *sampling != PixelSampling::Nearest && *sampling != own.pixel_sampling)
        .map(|pixel_sampling| {
            let settings = RenderSettings { pixel_sampling, ..*own };
            (pixel_sampling.name().to_owned(), settings)
        })
        .collect()
}

fn of_textures(own: &RenderSettings, textures: ReadTextures) -> Vec<(Setting, Vec<(String, RenderSettings)>)> {
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
    let boxed = (own.pyramid_filter != PyramidFilter::Box).then(|| {
        let settings = RenderSettings {
            pyramid_filter: PyramidFilter::Box,
            ..*own
        };
        (PyramidFilter::Box.name().to_owned(), settings)
    });
    vec![
        (Setting::PyramidFilter, boxed.into_iter().collect()),
        (Setting::Pyramid, pyramids(own, textures)),
        (Setting::LodLevel, detail("auto", own.detail.fixed.is_some(), automatic)),
        (Setting::LodBias, detail("0", own.detail != unbiased, unbiased)),
        (Setting::LevelSampling, level_samplings(own, textures)),
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
    use crate::texture::FixedLevel;

    #[test]
    fn candidates_are_other_settings() {
        let own = RenderSettings::default();
        let read = |texels, closely| Some(ReadTextures { texels, closely });
        for textures in [None, read(1, true), read(u64::MAX, false)] {
            for (setting, values) in candidates(&own, textures) {
                for (value, settings) in values {
                    assert!(settings != own, "{setting:?} {value}");
                }
            }
        }
        let rates: Vec<String> = rates(&own).into_iter().map(|(value, _)| value).collect();
        assert_eq!(rates, ["4", "9", "16", "25", "36", "49", "64", "256"], "cheapest first");
    }

    #[test]
    fn level_0_alone_is_tried_where_it_leaves_nothing_out() {
        let tried = |closely, fixed| {
            let mut own = RenderSettings {
                level_sampling: LevelSampling::Ripmap,
                ..RenderSettings::default()
            };
            own.detail.fixed = fixed;
            let textures = ReadTextures { texels: 1, closely };
            let values = level_samplings(&own, textures);
            values.iter().any(|(value, _)| value == LevelSampling::Zero.name())
        };
        assert!(tried(true, None), "samples lie close together");
        assert!(!tried(false, None), "it would be luck");
        assert!(!tried(true, FixedLevel::new(2.0)), "level 2 would be read");
    }

    #[test]
    fn the_other_pyramid_is_tried_where_it_is_read_and_soon_made() {
        let tried = |level_sampling, resolve, texels| {
            let own = RenderSettings {
                level_sampling,
                resolve,
                ..RenderSettings::default()
            };
            let values = pyramids(&own, ReadTextures { texels, closely: true });
            values.into_iter().map(|(value, _)| value).collect::<Vec<String>>()
        };
        let (stored, linear) = (ResolveSpace::Stored, ResolveSpace::Linear);
        assert_eq!(tried(LevelSampling::Linear, stored, 1), ["linear"]);
        assert!(tried(LevelSampling::Linear, stored, u64::MAX).is_empty(), "too large");
        assert!(tried(LevelSampling::Zero, stored, 1).is_empty(), "none is read");
        assert_eq!(
            tried(LevelSampling::Linear, linear, u64::MAX),
            ["linear"],
            "as samples are"
        );
    }
}
