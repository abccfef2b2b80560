//! From `(u, v)` to a colour: pixel sampling inside a level, level sampling between levels.

use glam::DVec2;

use super::{Footprint, LevelSampling, MipLevel, MipPyramid, PixelSampling, cell};
use crate::color::Premultiplied16;
use crate::rules::Rules;

/// How textures are read: what a user chooses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SamplingSettings {
    /// Inside a level.
    pub pixel: PixelSampling,
    /// Between levels.
    pub level: LevelSampling,
    /// How texels are addressed.
    pub rules: Rules,
}

/// Which levels a footprint reads: the finer one, and where two are mixed the next coarser and its weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelChoice {
    /// Number of the (finer) level.
    pub level: usize,
    /// Weight of level `level + 1`; zero when only one level is read.
    pub next_weight: f32,
}

/// One texture read at one footprint.
#[derive(Clone, Copy, Debug)]
pub struct Sampler<'a> {
    finer: &'a MipLevel,
    /// The next coarser level and its weight, when two are mixed.
    coarser: Option<(&'a MipLevel, f32)>,
    pixel: PixelSampling,
    rules: Rules,
}

impl LevelChoice {
    /// The levels that `footprint` reads of a pyramid with levels `0..=last` over a base of `size` texels.
    pub fn new(footprint: &Footprint, size: DVec2, last: usize, sampling: LevelSampling) -> Self {
        let lod = footprint.level_of_detail(size).clamp(0.0, last as f64);
        match sampling {
            LevelSampling::Zero => Self {
                level: 0,
                next_weight: 0.0,
            },
            LevelSampling::Nearest => Self {
                level: whole(lod + 0.5).min(last),
                next_weight: 0.0,
            },
            LevelSampling::Linear => {
                let level = whole(lod).min(last);
                Self {
                    level,
                    next_weight: fraction(lod - level as f64),
                }
            }
        }
    }
}

/// The weight of the next level as a part of [`cell::MASS`].
#[expect(clippy::cast_possible_truncation, reason = "a weight in 0..=1 becomes 0..=MASS")]
pub(super) fn mass(weight: f32) -> i32 {
    (weight * cell::MASS as f32).round() as i32
}

/// The whole part of a clamped level of detail.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a level of detail is clamped to 0..=30"
)]
fn whole(lod: f64) -> usize {
    lod as usize
}

/// The fractional part of a level of detail as a weight.
#[expect(clippy::cast_possible_truncation, reason = "a weight in 0..1 loses only digits")]
fn fraction(weight: f64) -> f32 {
    weight as f32
}

impl<'a> Sampler<'a> {
    /// Prepares reading `pyramid` at `footprint`.
    pub fn new(pyramid: &'a MipPyramid, footprint: &Footprint, settings: SamplingSettings) -> Self {
        let levels = pyramid.levels();
        let size = DVec2::new(f64::from(levels[0].width()), f64::from(levels[0].height()));
        let choice = LevelChoice::new(footprint, size, pyramid.last_level(), settings.level);
        let coarser = (choice.next_weight > 0.0).then(|| (&levels[choice.level + 1], choice.next_weight));
        Self {
            finer: &levels[choice.level],
            coarser,
            pixel: settings.pixel,
            rules: settings.rules,
        }
    }

    /// The premultiplied colour at `(u, v)`, channels in `0.0..=255.0`. Coordinates outside `0..=1` read the border.
    ///
    /// Under the standard rules this is what [`super::Filter`] gives for a fragment there, to the last bit.
    pub fn sample(&self, u: f32, v: f32) -> [f32; 4] {
        match self.rules {
            Rules::Standard => {
                let at = DVec2::new(f64::from(u), f64::from(v));
                let mut sums = [0; 4];
                let (level, mass) = self
                    .coarser
                    .map_or((self.finer, 0), |(level, weight)| (level, mass(weight)));
                self.add(self.finer, at, cell::MASS - mass, &mut sums);
                self.add(level, at, mass, &mut sums);
                sums.map(|sum| f32::from(cell::to_channel(sum)) / f32::from(Premultiplied16::PER_BYTE))
            }
            Rules::Course => {
                let fine = self.sample_level(self.finer, u, v);
                match self.coarser {
                    None => fine,
                    Some((level, weight)) => lerp(fine, self.sample_level(level, u, v), weight),
                }
            }
        }
    }

    fn add(&self, level: &MipLevel, at: DVec2, mass: i32, sums: &mut [i32; 4]) {
        let size = DVec2::new(f64::from(level.width()), f64::from(level.height()));
        let at = at * size - cell::first_centre(self.pixel);
        let at = [cell::to_fixed(at.x, size.x - 1.0), cell::to_fixed(at.y, size.y - 1.0)];
        cell::add(level, self.pixel, at, mass, sums);
    }

    fn sample_level(&self, level: &MipLevel, u: f32, v: f32) -> [f32; 4] {
        match self.pixel {
            PixelSampling::Nearest => course_nearest(level, u, v),
            PixelSampling::Bilinear => course_bilinear(level, u, v),
        }
    }
}

/// Texel `round(u (w - 1)), round(v (h - 1))`.
fn course_nearest(level: &MipLevel, u: f32, v: f32) -> [f32; 4] {
    let (width, height) = (level.width() as f32, level.height() as f32);
    let (x, y) = (u * (width - 1.0) + 0.5, v * (height - 1.0) + 0.5);
    level.texel(truncate(x.max(0.0)), truncate(y.max(0.0))).map(f32::from)
}

/// The four texels around the point, weighted by distance, where texel centres lie at whole multiples of `1 / (w - 1)`.
fn course_bilinear(level: &MipLevel, u: f32, v: f32) -> [f32; 4] {
    let (right, bottom) = (level.width() as f32 - 1.0, level.height() as f32 - 1.0);
    // Beyond the outermost centres the border texel goes on, so clamping the point is clamping the texels.
    let (x, y) = ((u * right).max(0.0).min(right), (v * bottom).max(0.0).min(bottom));
    let (left, top) = (truncate(x), truncate(y));
    let (s, t) = (x - left as f32, y - top as f32);
    let texel = |x, y| level.texel(x, y).map(f32::from);
    let upper = lerp(texel(left, top), texel(left + 1, top), s);
    let lower = lerp(texel(left, top + 1), texel(left + 1, top + 1), s);
    lerp(upper, lower, t)
}

/// `a + (b - a) t`: exact at `t = 0` and for equal colours, so that a constant texture stays constant.
fn lerp(a: [f32; 4], b: [f32; 4], t: f32) -> [f32; 4] {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}

/// Towards zero, saturating; NaN becomes 0. For coordinates at or above zero this is `floor`.
#[expect(
    clippy::cast_possible_truncation,
    reason = "`as` saturates, and texels are clamped to their level"
)]
fn truncate(value: f32) -> i32 {
    value as i32
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "these filters promise exact values")]
mod tests {
    use super::super::{Filter, SampleGrid, UvMap};
    use super::*;
    use crate::simd;

    const ALL: [(PixelSampling, LevelSampling); 6] = [
        (PixelSampling::Nearest, LevelSampling::Zero),
        (PixelSampling::Nearest, LevelSampling::Nearest),
        (PixelSampling::Nearest, LevelSampling::Linear),
        (PixelSampling::Bilinear, LevelSampling::Zero),
        (PixelSampling::Bilinear, LevelSampling::Nearest),
        (PixelSampling::Bilinear, LevelSampling::Linear),
    ];

    fn settings(pixel: PixelSampling, level: LevelSampling) -> SamplingSettings {
        SamplingSettings {
            pixel,
            level,
            rules: Rules::Standard,
        }
    }

    /// A footprint of `texels` base texels per pixel in both directions.
    fn footprint(texels: f64, side: f64) -> Footprint {
        Footprint {
            dx: DVec2::new(texels / side, 0.0),
            dy: DVec2::new(0.0, texels / side),
        }
    }

    fn ramp(side: u32) -> MipPyramid {
        let byte = |value: u32| u8::try_from(value * 255 / (side - 1)).expect("a byte");
        let texels = (0..side * side)
            .map(|i| [byte(i % side), byte(i / side), 0, 255])
            .collect();
        MipPyramid::build(MipLevel::new(side, side, texels))
    }

    #[test]
    fn constant_texture_stays_constant_under_every_filter_and_rule() {
        let texel = [13, 200, 77, 255];
        let pyramid = MipPyramid::build(MipLevel::new(37, 21, vec![texel; 37 * 21]));
        arbtest::arbtest(|u| {
            let mut number = |range: f32| -> arbtest::arbitrary::Result<f32> {
                Ok((u.int_in_range(-1_000_000..=1_000_000)? as f32) / 1e6 * range)
            };
            let (s, t, texels) = (number(3.0)?, number(3.0)?, f64::from(number(5.0)?.exp2()));
            for (pixel, level) in ALL {
                for rules in Rules::ALL {
                    let settings = SamplingSettings { pixel, level, rules };
                    let found = Sampler::new(&pyramid, &footprint(texels, 37.0), settings).sample(s, t);
                    assert_eq!(found, texel.map(f32::from), "{settings:?} at {s}, {t}");
                }
            }
            Ok(())
        })
        .budget_ms(200);
    }

    /// Reads level 0.
    fn at(level: MipLevel, pixel: PixelSampling, rules: Rules, [u, v]: [f32; 2]) -> [f32; 4] {
        let settings = SamplingSettings {
            pixel,
            level: LevelSampling::Zero,
            rules,
        };
        Sampler::new(&MipPyramid::build(level), &footprint(1.0, 4.0), settings).sample(u, v)
    }

    #[test]
    fn nearest_takes_the_texel_that_contains_the_point() {
        let level = || MipLevel::new(4, 1, [10, 20, 30, 40].map(|red| [red, 0, 0, 255]).to_vec());
        let red = |u, rules| at(level(), PixelSampling::Nearest, rules, [u, 0.5])[0];
        for (u, expected) in [
            (f32::NAN, 10.0),
            (-1e30, 10.0),
            (0.0, 10.0),
            (0.2499, 10.0),
            (0.25, 20.0),
            (0.99, 40.0),
            (1.0, 40.0),
            (f32::INFINITY, 40.0),
        ] {
            assert_eq!(red(u, Rules::Standard), expected, "standard at {u}");
        }
        for (u, expected) in [
            (0.0, 10.0),
            (0.16, 10.0),
            (0.17, 20.0),
            (0.49, 20.0),
            (0.51, 30.0),
            (1.0, 40.0),
        ] {
            assert_eq!(red(u, Rules::Course), expected, "course at {u}");
        }
    }

    #[test]
    fn bilinear_is_exact_at_texel_centres_and_halfway_between() {
        let texels = vec![[0, 0, 0, 255], [100, 0, 0, 255], [0, 200, 0, 255], [100, 200, 0, 255]];
        let read = |point, rules| {
            let level = MipLevel::new(2, 2, texels.clone());
            at(level, PixelSampling::Bilinear, rules, point)
        };
        for (rules, centre) in [(Rules::Standard, 0.25), (Rules::Course, 0.0)] {
            let found = read([centre, centre], rules);
            assert_eq!(found, [0.0, 0.0, 0.0, 255.0], "a texel's centre, {rules:?}");
            let found = read([0.5, 0.5], rules);
            assert_eq!(found, [50.0, 100.0, 0.0, 255.0], "the middle of four, {rules:?}");
            let found = read([-0.5, 1.5], rules);
            assert_eq!(found, [0.0, 200.0, 0.0, 255.0], "the border goes on, {rules:?}");
        }
    }

    #[test]
    fn trilinear_at_whole_levels_is_that_level_alone() {
        let pyramid = ramp(64);
        for rules in Rules::ALL {
            for level in 0..=pyramid.last_level() {
                let print = footprint(f64::from(1_u32 << level), 64.0);
                let read = |level| {
                    let settings = SamplingSettings {
                        pixel: PixelSampling::Bilinear,
                        level,
                        rules,
                    };
                    let sampler = Sampler::new(&pyramid, &print, settings);
                    [(0.1, 0.9), (0.5, 0.5), (0.77, 0.13)].map(|(u, v)| sampler.sample(u, v))
                };
                let (mixed, alone) = (read(LevelSampling::Linear), read(LevelSampling::Nearest));
                assert_eq!(mixed, alone, "level {level}, {rules:?}");
            }
        }
    }

    #[test]
    fn single_points_are_fragments_of_a_filter() {
        let pyramid = ramp(64);
        for (pixel, level) in ALL {
            let footprint = footprint(2.7, 64.0);
            let map = UvMap {
                pivot: DVec2::new(0.5, 0.5),
                uv: DVec2::new(0.375, 0.8125),
                dx: footprint.dx,
                dy: footprint.dy,
            };
            let grid = SampleGrid {
                side: 1,
                origin: [0, 0],
            };
            let mut color = [Premultiplied16::TRANSPARENT];
            Filter::new(&pyramid, &map, pixel, level).points(simd::level(), grid, &[[0, 0]], &mut color);
            let alone = Sampler::new(&pyramid, &footprint, settings(pixel, level)).sample(0.375, 0.8125);
            let stored = Premultiplied16::from_byte_range(alone, Rules::Standard);
            assert_eq!(color, [stored], "{pixel:?} {level:?}");
        }
    }

    #[test]
    fn level_choice_follows_the_level_of_detail() {
        let size = DVec2::splat(64.0);
        let choose = |texels: f64, sampling| LevelChoice::new(&footprint(texels, 64.0), size, 6, sampling);
        assert_eq!(choose(40.0, LevelSampling::Zero).level, 0, "zero is zero");
        assert_eq!(
            choose(2.0_f64.powf(1.49), LevelSampling::Nearest).level,
            1,
            "1.49 rounds down"
        );
        assert_eq!(
            choose(2.0_f64.powf(1.51), LevelSampling::Nearest).level,
            2,
            "1.51 rounds up"
        );
        let mixed = choose(2.0_f64.powf(2.25), LevelSampling::Linear);
        assert_eq!(mixed.level, 2, "between 2 and 3");
        assert!((mixed.next_weight - 0.25).abs() < 1e-6, "a quarter of level 3");
        let last = choose(1e9, LevelSampling::Linear);
        assert_eq!(
            last,
            LevelChoice {
                level: 6,
                next_weight: 0.0
            },
            "never beyond the last"
        );
    }
}
