//! From `(u, v)` to a colour: pixel sampling inside a level, level sampling between levels.

use glam::DVec2;

use super::bilinear::mass;
use super::{Cubic, Footprint, PixelSampling, Reading, SamplingSettings, Taps, Wrap};
use super::{MipLevel, MipPyramid, bilinear, fixed_point, wrap};
use crate::color::Premultiplied16;
use crate::rules::Rules;

/// One texture read at one footprint.
#[derive(Clone, Copy, Debug)]
pub struct Sampler<'a> {
    pub(super) finer: &'a MipLevel,
    /// Its number in the pyramid.
    pub(super) number: usize,
    /// The next coarser level and its weight, when two are mixed.
    pub(super) coarser: Option<(&'a MipLevel, f32)>,
    pub(super) taps: Taps,
    /// The longer side of the footprint, in `(u, v)`.
    pub(super) along: DVec2,
    pub(super) pixel: PixelSampling,
    pub(super) wrap: Wrap,
    rules: Rules,
}

impl<'a> Sampler<'a> {
    /// Prepares reading `pyramid` where `(u, v)` changes by `footprint` from pixel to pixel.
    pub fn new(pyramid: &'a MipPyramid, footprint: &Footprint, settings: &SamplingSettings) -> Self {
        let levels = pyramid.levels();
        let Reading {
            footprint,
            taps,
            levels: choice,
            ..
        } = Reading::new(footprint, pyramid, settings);
        let coarser = (choice.next_weight > 0.0).then(|| (&levels[choice.level + 1], choice.next_weight));
        Self {
            finer: &levels[choice.level],
            number: choice.level,
            coarser,
            taps,
            along: if taps.along_x { footprint.dx } else { footprint.dy },
            pixel: settings.pixel,
            wrap: settings.wrap,
            rules: settings.rules,
        }
    }

    /// The premultiplied colour at `(u, v)`, channels in `0.0..=255.0`. Outside `0..=1` there is what [`Wrap`] says.
    ///
    /// Under the standard rules this is what [`super::Filter`] gives for a fragment there, to the last bit. The course's
    /// rules know no anisotropic filtering; there it is the mean of what they read at the taps. They know no cubic kernels
    /// either; there texels are weighed by them around the point that those rules look at. Nor do they wrap: `(u, v)` is brought
    /// into `0..=1` and read as they do, so that the first and the last texel, which stand in the corners, lie on each other.
    pub fn sample(&self, u: f32, v: f32) -> [f32; 4] {
        let at = DVec2::new(f64::from(u), f64::from(v));
        match self.rules {
            Rules::Standard | Rules::Float => {
                let mut sums = [0; 4];
                let (level, mass) = self
                    .coarser
                    .map_or((self.finer, 0), |(level, weight)| (level, mass(weight)));
                self.add(self.finer, at, fixed_point::MASS - mass, &mut sums);
                self.add(level, at, mass, &mut sums);
                let sums = bilinear::clamped(sums, self.taps.count);
                let stored = match self.taps.count {
                    1 => sums.map(bilinear::to_channel),
                    count => sums.map(|sum| bilinear::mean(sum, count)),
                };
                stored.map(|channel| f32::from(channel) / f32::from(Premultiplied16::PER_BYTE))
            }
            Rules::Course if self.taps.count == 1 => self.kept(self.sample_levels(u, v)),
            Rules::Course => {
                let mut sums = [0.0; 4];
                for tap in 0..self.taps.count {
                    let at = (at + self.along * self.taps.place(tap)).as_vec2();
                    for (sum, channel) in sums.iter_mut().zip(self.sample_levels(at.x, at.y)) {
                        *sum += channel;
                    }
                }
                self.kept(sums.map(|sum| sum / self.taps.count as f32))
            }
        }
    }

    fn add(&self, level: &MipLevel, at: DVec2, mass: i32, sums: &mut [i32; 4]) {
        let size = DVec2::new(f64::from(level.width()), f64::from(level.height()));
        let at = at * size - fixed_point::first_centre(self.pixel);
        let last = size - 1.0;
        for tap in 0..self.taps.count {
            let offset = self.along * size * self.taps.place(tap);
            let place = |at: f64, offset: f64, last: f64| {
                let offset = (self.taps.count > 1).then_some(offset);
                wrap::place(last, (self.wrap, self.pixel), at, offset)
            };
            let place = [place(at.x, offset.x, last.x), place(at.y, offset.y, last.y)];
            bilinear::add(level, (self.pixel, self.wrap), place, mass, sums);
        }
    }

    /// What a premultiplied colour can be, where a cubic kernel leads beyond that.
    fn kept(&self, [r, g, b, alpha]: [f32; 4]) -> [f32; 4] {
        if self.pixel.cubic().is_none() {
            return [r, g, b, alpha];
        }
        let alpha = alpha.clamp(0.0, 255.0);
        [r.clamp(0.0, alpha), g.clamp(0.0, alpha), b.clamp(0.0, alpha), alpha]
    }

    /// By the course's rules, with one tap, not clamped yet.
    fn sample_levels(&self, u: f32, v: f32) -> [f32; 4] {
        let uv = self.wrap.course_inside([u, v]);
        let fine = course_level(self.finer, (self.pixel, self.wrap), uv);
        match self.coarser {
            None => fine,
            Some((level, weight)) => lerp(fine, course_level(level, (self.pixel, self.wrap), uv), weight),
        }
    }
}

/// The point of a level that the course's rules look at, in texels. For [`PixelSampling::Nearest`] texel `i` lies from `i` to
/// `i + 1`, for all others its centre at `i`. Texels stand `1 / (w - 1)` apart.
pub(super) fn course_point(level: &MipLevel, pixel: PixelSampling, [u, v]: [f32; 2]) -> [f32; 2] {
    let (right, bottom) = (level.width() as f32 - 1.0, level.height() as f32 - 1.0);
    match pixel {
        PixelSampling::Nearest => [(u * right + 0.5).max(0.0), (v * bottom + 0.5).max(0.0)],
        // No point lies beyond the outermost centres: the course clamps `u` and `v`.
        _ => [(u * right).max(0.0).min(right), (v * bottom).max(0.0).min(bottom)],
    }
}

/// Where `(u, v)` lies in a level: the texel that contains the point for [`PixelSampling::Nearest`]; the upper left of the
/// four around the point and how far right and down from its centre the point is, in texels, for all others.
pub(super) fn course_place(level: &MipLevel, pixel: PixelSampling, uv: [f32; 2]) -> ([i32; 2], [f32; 2]) {
    let [x, y] = course_point(level, pixel, uv);
    let (left, top) = (truncate(x), truncate(y));
    match pixel {
        PixelSampling::Nearest => ([left, top], [0.0; 2]),
        _ => ([left, top], [x - left as f32, y - top as f32]),
    }
}

/// The texel there, or the texels around the point, weighted by distance.
fn course_level(level: &MipLevel, (pixel, wrap): (PixelSampling, Wrap), uv: [f32; 2]) -> [f32; 4] {
    let ([left, top], [s, t]) = course_place(level, pixel, uv);
    let texel = |x, y| level.wrapped(wrap, [x, y]).map(f32::from);
    if pixel == PixelSampling::Nearest {
        return texel(left, top);
    }
    if let Some(cubic) = pixel.cubic() {
        // Differences from one of them, so that a constant texture stays constant.
        let [middle, mut sum] = [texel(left, top); 2];
        for (x, y, weight) in course_weights(cubic, [s, t]) {
            let other = texel(left.saturating_add(x), top.saturating_add(y));
            sum = std::array::from_fn(|i| sum[i] + (other[i] - middle[i]) * weight);
        }
        return sum;
    }
    let upper = lerp(texel(left, top), texel(left + 1, top), s);
    let lower = lerp(texel(left, top + 1), texel(left + 1, top + 1), s);
    lerp(upper, lower, t)
}

/// Column and row of each texel around a point, counted from the upper left of the four next to it, and its weight.
#[expect(clippy::cast_possible_truncation, reason = "the course calculates in 32 bits")]
pub(super) fn course_weights(cubic: Cubic, [s, t]: [f32; 2]) -> impl Iterator<Item = (i32, i32, f32)> {
    let (columns, rows) = (cubic.weights(s.into()), cubic.weights(t.into()));
    (0..4).zip(rows).flat_map(move |(y, row)| {
        let weight = move |(x, column): (i32, f64)| (x - 1, y - 1, (column * row) as f32);
        (0..4).zip(columns).map(weight)
    })
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
    use super::super::{Anisotropy, Filter, LevelSampling, SampleGrid, UvMap};
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
            ..SamplingSettings::default()
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
            let most = Anisotropy::new(u.int_in_range(1..=64)?).expect("a maximum");
            let print = Footprint {
                dx: DVec2::new(texels, 0.3) / 37.0,
                dy: DVec2::new(0.3, texels * 7.0) / 21.0,
            };
            for (pixel, level) in ALL {
                for (rules, anisotropy) in Rules::ALL
                    .into_iter()
                    .flat_map(|rules| [(rules, Anisotropy::OFF), (rules, most)])
                {
                    let settings = SamplingSettings {
                        anisotropy,
                        rules,
                        ..settings(pixel, level)
                    };
                    let found = Sampler::new(&pyramid, &print, &settings).sample(s, t);
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
            rules,
            ..settings(pixel, LevelSampling::Zero)
        };
        Sampler::new(&MipPyramid::build(level), &footprint(1.0, 4.0), &settings).sample(u, v)
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
                        rules,
                        ..settings(PixelSampling::Bilinear, level)
                    };
                    let sampler = Sampler::new(&pyramid, &print, &settings);
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
            for taps in [1, 2, 3, 64] {
                let map = UvMap {
                    pivot: DVec2::new(0.5, 0.5),
                    uv: DVec2::new(0.375, 0.8125),
                    dx: DVec2::new(2.7, 0.4) / 64.0,
                    dy: DVec2::new(3.1, -17.0) / 64.0,
                };
                let grid = SampleGrid {
                    side: 1,
                    origin: [0, 0],
                };
                let settings = SamplingSettings {
                    anisotropy: Anisotropy::new(taps).expect("a maximum"),
                    ..settings(pixel, level)
                };
                let mut color = [Premultiplied16::TRANSPARENT];
                Filter::new(&pyramid, &map, &settings).points(simd::level(), grid, &[[0, 0]], &mut color);
                let alone = Sampler::new(&pyramid, &map.footprint(), &settings).sample(0.375, 0.8125);
                let stored = Premultiplied16::from_byte_range(alone, Rules::Standard);
                assert_eq!(color, [stored], "{pixel:?} {level:?} {taps}");
            }
        }
    }
}
