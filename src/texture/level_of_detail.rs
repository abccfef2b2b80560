//! Which mip levels a footprint reads, and where along it.
//!
//! After the Vulkan specification, chapter "Image Operations", "Scale Factor Operation, LOD Operation and Image Level(s)
//! Selection", and OpenGL 4.6, section 8.14.

use glam::DVec2;

use super::detail_settings::{FixedLevel, FootprintExtent};
use super::{Area, Footprint, LevelChoice, LevelSampling, MipPyramid, SamplingSettings, Taps};

/// How a footprint reads a pyramid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// The footprint that counts: a pixel's, or a sample's.
    pub footprint: Footprint,
    /// Where along it texels are read.
    pub taps: Taps,
    /// Level of detail with bias, not clamped.
    pub lod: f64,
    /// The levels that it leads to; of a ripmap those of the longer side of its box.
    pub levels: LevelChoice,
    /// What of the texture is weighed, where that is an area.
    pub area: Option<Area>,
}

impl Reading {
    /// How `per_pixel`, the change of `(u, v)` from pixel to pixel, reads `pyramid`.
    ///
    /// The level of detail is `log2(longer side / ratio) + bias`, see [`Taps`], or with one tap that of the extent that the settings
    /// name; a fixed level stands in for the logarithm. Level sampling zero reads level 0 whatever the bias; only a fixed level is read there too, rounded.
    pub fn new(per_pixel: &Footprint, pyramid: &MipPyramid, settings: &SamplingSettings) -> Self {
        let (base, last) = (&pyramid.levels()[0], pyramid.last_level());
        let size = DVec2::new(f64::from(base.width()), f64::from(base.height()));
        let detail = &settings.detail;
        let footprint = per_pixel.scaled(detail.derivatives.step(settings.sample_step));
        if settings.level.weighs_area() {
            return Self::of_area(footprint, pyramid, settings);
        }
        let taps = Taps::new(&footprint, size, settings.anisotropy);
        let computed = || {
            if taps.count == 1 {
                footprint.level_of_detail(size, detail.extent)
            } else {
                footprint.level_of_detail(size, FootprintExtent::Longer) - taps.ratio.log2()
            }
        };
        let lod = detail.fixed.map_or_else(computed, FixedLevel::level) + detail.bias.levels();
        let sampling = match settings.level {
            LevelSampling::Zero if detail.fixed.is_some() => LevelSampling::Nearest,
            sampling => sampling,
        };
        Self {
            footprint,
            taps,
            lod,
            levels: LevelChoice::new(lod, last, sampling),
            area: None,
        }
    }

    /// The same by a filter that weighs an area; it needs no taps.
    fn of_area(footprint: Footprint, pyramid: &MipPyramid, settings: &SamplingSettings) -> Self {
        let (area, lod) = Area::new(&footprint, pyramid, settings);
        let levels = match area {
            Area::Ellipse(ellipse) => LevelChoice::alone(ellipse.level),
            Area::Box(area) => LevelChoice::alone(area.level),
            Area::Ripmap(_) => LevelChoice::new(lod, pyramid.last_level(), LevelSampling::Linear),
        };
        Self {
            footprint,
            taps: Taps::ONE,
            lod,
            levels,
            area: Some(area),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Anisotropy, Derivatives, LevelOfDetail, LodBias, MipLevel};
    use super::*;

    /// A footprint of `texels` texels of a base of 64 x 64 per pixel in both directions.
    fn footprint(texels: f64) -> Footprint {
        Footprint {
            dx: DVec2::new(texels / 64.0, 0.0),
            dy: DVec2::new(0.0, texels / 64.0),
        }
    }

    fn pyramid() -> MipPyramid {
        MipPyramid::build(MipLevel::new(64, 64, vec![[0, 0, 0, 255]; 64 * 64]))
    }

    fn choose(texels: f64, level: LevelSampling, detail: LevelOfDetail) -> LevelChoice {
        let settings = SamplingSettings {
            level,
            detail,
            ..SamplingSettings::default()
        };
        Reading::new(&footprint(texels), &pyramid(), &settings).levels
    }

    #[test]
    fn levels_follow_the_level_of_detail() {
        let plain = LevelOfDetail::default();
        let choose = |texels: f64, sampling| choose(texels, sampling, plain);
        assert_eq!(choose(40.0, LevelSampling::Zero).level, 0, "zero is zero");
        let nearest = |lod: f64| choose(lod.exp2(), LevelSampling::Nearest).level;
        assert_eq!((nearest(1.49), nearest(1.51)), (1, 2), "rounded to nearest");
        let mixed = choose(2.25_f64.exp2(), LevelSampling::Linear);
        assert_eq!(mixed.level, 2, "between 2 and 3");
        assert!((mixed.next_weight - 0.25).abs() < 1e-6, "a quarter of level 3");
        let last = choose(1e9, LevelSampling::Linear);
        let top = LevelChoice {
            level: 6,
            next_weight: 0.0,
        };
        assert_eq!(last, top, "never beyond the last");
    }

    #[test]
    fn bias_moves_levels_monotonously_and_is_clamped() {
        for texels in [0.1, 1.0, 3.7, 50.0] {
            for sampling in [LevelSampling::Nearest, LevelSampling::Linear] {
                let mut before = 0.0;
                for step in -64..=64 {
                    let bias = LodBias::new(f64::from(step) / 4.0).expect("within limits");
                    let detail = LevelOfDetail {
                        bias,
                        ..LevelOfDetail::default()
                    };
                    let found = choose(texels, sampling, detail);
                    let level = found.level as f64 + f64::from(found.next_weight);
                    assert!(
                        level >= before && level <= 6.0,
                        "{texels}, {sampling:?}, {bias:?}: {found:?} after {before}"
                    );
                    before = level;
                }
                assert!(before > 5.99, "16 levels more are the last one");
            }
        }
        let detail = LevelOfDetail {
            bias: LodBias::new(3.0).expect("within limits"),
            ..LevelOfDetail::default()
        };
        assert_eq!(choose(1.0, LevelSampling::Nearest, detail).level, 3, "three more");
        assert_eq!(choose(1.0, LevelSampling::Zero, detail).level, 0, "zero is zero");
    }

    #[test]
    fn fixed_level_is_read_whatever_the_footprint() {
        let fixed = |level: f64| LevelOfDetail {
            fixed: FixedLevel::new(level),
            ..LevelOfDetail::default()
        };
        for texels in [0.0, 0.3, 1.0, 77.0, f64::NAN] {
            let mixed = choose(texels, LevelSampling::Linear, fixed(2.5));
            assert_eq!(mixed.level, 2, "two and a half of {texels}");
            assert!((mixed.next_weight - 0.5).abs() < 1e-6, "a half");
            assert_eq!(choose(texels, LevelSampling::Nearest, fixed(2.4)).level, 2, "rounded");
            assert_eq!(
                choose(texels, LevelSampling::Zero, fixed(3.0)).level,
                3,
                "also for zero"
            );
            assert_eq!(choose(texels, LevelSampling::Linear, fixed(16.0)).level, 6, "the last");
        }
    }

    #[test]
    fn derivatives_per_sample_see_a_sample_only() {
        let settings = SamplingSettings {
            level: LevelSampling::Nearest,
            detail: LevelOfDetail {
                derivatives: Derivatives::Sample,
                ..LevelOfDetail::default()
            },
            sample_step: 0.25,
            ..SamplingSettings::default()
        };
        let reading = Reading::new(&footprint(16.0), &pyramid(), &settings);
        assert_eq!(reading.levels.level, 2, "two levels finer");
        assert_eq!(reading.footprint, footprint(4.0), "a quarter");
    }

    #[test]
    fn anisotropy_reads_the_level_of_the_shorter_side() {
        let settings = |most| SamplingSettings {
            level: LevelSampling::Linear,
            anisotropy: Anisotropy::new(most).expect("a maximum"),
            ..SamplingSettings::default()
        };
        let long = Footprint {
            dx: DVec2::new(16.0 / 64.0, 0.0),
            dy: DVec2::new(0.0, 2.0 / 64.0),
        };
        for (most, lod, count) in [(1, 4.0, 1), (2, 3.0, 2), (8, 1.0, 8), (64, 1.0, 8)] {
            let reading = Reading::new(&long, &pyramid(), &settings(most));
            assert!((reading.lod - lod).abs() < 1e-9, "{most}: {reading:?}");
            assert_eq!(reading.taps.count, count, "{most}");
        }
    }

    #[test]
    fn values_beyond_the_limits_are_none() {
        for wrong in [16.1, -16.1, f64::NAN, f64::INFINITY] {
            assert_eq!(LodBias::new(wrong), None, "bias {wrong}");
        }
        for wrong in [16.1, -0.1, f64::NAN, f64::INFINITY] {
            assert_eq!(FixedLevel::new(wrong), None, "level {wrong}");
        }
        let most = LodBias::new(15.75).expect("within limits");
        assert!((most.stepped(0.5).levels() - 16.0).abs() < 1e-12, "kept within limits");
        assert_eq!(most.stepped(f64::NAN), most, "nothing");
        let mut steps = vec![];
        let mut level = FixedLevel::after(None);
        while let Some(fixed) = level {
            steps.push(fixed.level());
            level = FixedLevel::after(level);
        }
        assert_eq!(steps, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0], "then none");
        let steps = |from: f64, step: f64| {
            let first = LodBias::new(from).expect("within limits");
            let all = std::iter::successors(Some(first), |bias| Some(bias.next_multiple(step)));
            all.skip(1).take(3).map(LodBias::levels).collect::<Vec<f64>>()
        };
        assert_eq!(steps(1.3, -0.5), [1.0, 0.5, 0.0], "down to none");
        assert_eq!(steps(-1.3, 0.5), [-1.0, -0.5, 0.0], "up to none");
        assert_eq!(steps(0.5, -0.5), [0.0, -0.5, -1.0], "a half each");
        assert_eq!(steps(15.75, 0.5), [16.0; 3], "no further");
        let zero = LodBias::new(-0.0).expect("nothing");
        assert!(zero.levels().is_sign_positive(), "no minus is shown");
    }
}
