//! Which texels one sample reads, and what each weighs: the arithmetic of filtering, noted down instead of summed up.
//!
//! For explanations, not for pictures. The weights are those of `bilinear`, which the kernels share, so that the texels times
//! their weights are the filter's colour to the last bit.

use glam::DVec2;

use super::course_sampler::{Sampler, course_place, course_point, course_weights};
use super::filter::{Filter, SampleGrid};
use super::filter_plan::{Axis, GridLevel, Plan};
use super::pyramid::NumberedLevel;
use super::{BoxRead, PixelSampling, Wrap, bilinear, fixed_point, wrap};
use crate::color::Premultiplied16;

/// A texel that a sample read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexelRead {
    /// Number of its mip level.
    pub level: usize,
    /// Column and row in the level, inside it.
    pub at: [u32; 2],
    /// Premultiplied red, green, blue, alpha.
    pub color: [u8; 4],
    /// Its part of the colour; the parts of a sample sum to one. Cubic kernels weigh some texels below zero, and others
    /// above one.
    pub weight: f64,
}

/// A point of a level around which texels were read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TapRead {
    /// Number of the mip level.
    pub level: usize,
    /// In texels from the corner of the level's first texel; clamped or wrapped as the filter does it. The very number from
    /// which the filter decides: the nearest texel is its whole part, the four around it begin at the whole part of half a
    /// texel less, and the sixteen one texel before that.
    pub at: DVec2,
}

/// What one sample read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextureReads {
    /// Each texel once, by level, row and column; none that weighs nothing.
    pub texels: Vec<TexelRead>,
    /// One per level and tap.
    pub taps: Vec<TapRead>,
    /// What stood beyond the border.
    pub wrap: Wrap,
    /// The box of a summed-area table. One of thousands of texels has none of them in `texels`; their sum is here.
    pub summed: Option<BoxRead>,
}

/// Gathers what is read.
struct Notes {
    reads: TextureReads,
    /// What all weights together are.
    total: f64,
}

impl Filter<'_> {
    /// What the sample in column and row `point`, counted from the first sample of the grid's origin, reads.
    pub fn reads(&self, grid: SampleGrid, point: [u16; 2]) -> TextureReads {
        let plan = self.plan(grid);
        let count = plan.line.taps.count;
        let mut notes = Notes::new(f64::from(fixed_point::MASS) * f64::from(count), plan.wrap);
        for level in [Some(&plan.finer), plan.coarser.as_ref()].into_iter().flatten() {
            for tap in 0..count {
                let place = place(&plan, level, point, tap);
                notes.tap(level.number, place, plan.pixel);
                let read = NumberedLevel {
                    level: level.level,
                    number: level.number,
                };
                bilinear::each(plan.pixel, place, level.mass, |x, y, weight| {
                    notes.texel(read, [x, y], f64::from(weight));
                });
            }
        }
        notes.finish()
    }
}

/// Where a tap of a sample lies in a level, in fixed point.
pub(super) fn place(plan: &Plan<'_>, level: &GridLevel<'_>, point: [u16; 2], tap: u32) -> [i32; 2] {
    let from_pivot = plan.first + DVec2::new(f64::from(point[0]), f64::from(point[1]));
    let at = |axis: &Axis| (axis.at_pivot + from_pivot.x * axis.right) + from_pivot.y * axis.down;
    [&level.x, &level.y].map(|axis| {
        let offset = (plan.line.taps.count > 1).then(|| axis.tap(&plan.line, tap));
        wrap::place(axis.last, (plan.wrap, plan.pixel), at(axis), offset)
    })
}

impl Sampler<'_> {
    /// What the course's rules read at `(u, v)`.
    pub fn course_reads(&self, u: f32, v: f32) -> TextureReads {
        let mut notes = Notes::new(f64::from(self.taps.count), self.wrap);
        let at = DVec2::new(f64::from(u), f64::from(v));
        let finer = NumberedLevel {
            level: self.finer,
            number: self.number,
        };
        for tap in 0..self.taps.count {
            let place = match self.taps.count {
                1 => [u, v],
                _ => (at + self.along * self.taps.place(tap)).as_vec2().to_array(),
            };
            match self.coarser {
                None => notes.course(finer, self.pixel, place, 1.0),
                Some((level, weight)) => {
                    let coarser = NumberedLevel {
                        level,
                        number: self.number + 1,
                    };
                    notes.course(finer, self.pixel, place, 1.0 - weight);
                    notes.course(coarser, self.pixel, place, weight);
                }
            }
        }
        notes.finish()
    }
}

impl Notes {
    fn new(total: f64, wrap: Wrap) -> Self {
        Self {
            reads: TextureReads {
                wrap,
                ..TextureReads::default()
            },
            total,
        }
    }

    fn tap(&mut self, level: usize, place: [i32; 2], pixel: PixelSampling) {
        let one = f64::from(1_u32 << fixed_point::FRACTION_BITS);
        let at = DVec2::new(f64::from(place[0]), f64::from(place[1])) / one + fixed_point::first_centre(pixel);
        self.reads.taps.push(TapRead { level, at });
    }

    fn texel(&mut self, NumberedLevel { level, number }: NumberedLevel<'_>, [x, y]: [i32; 2], weight: f64) {
        if weight == 0.0 {
            return;
        }
        let inside = |at: i32, size: u32| self.reads.wrap.texel(at, size).cast_unsigned();
        let at = [inside(x, level.width()), inside(y, level.height())];
        self.reads.texels.push(TexelRead {
            level: number,
            at,
            color: level.wrapped(self.reads.wrap, [x, y]),
            weight: weight / self.total,
        });
    }

    fn course(&mut self, numbered: NumberedLevel<'_>, pixel: PixelSampling, uv: [f32; 2], weight: f32) {
        let NumberedLevel { level, number } = numbered;
        let uv = self.reads.wrap.course_inside(uv);
        let ([left, top], [s, t]) = course_place(level, pixel, uv);
        let point = course_point(level, pixel, uv).map(f64::from);
        // Beyond the level its last texel goes on.
        let last = DVec2::new(f64::from(level.width()), f64::from(level.height())) - 0.5;
        let at = (DVec2::from(point) + fixed_point::first_centre(pixel)).min(last);
        self.reads.taps.push(TapRead { level: number, at });
        // A nearest texel far beyond the level has no neighbour to its right, and reads none.
        let (right, bottom) = (left.saturating_add(1), top.saturating_add(1));
        if let Some(cubic) = pixel.cubic() {
            for (x, y, part) in course_weights(cubic, [s, t]) {
                let at = [left.saturating_add(x), top.saturating_add(y)];
                self.texel(numbered, at, f64::from(part * weight));
            }
            return;
        }
        let mut read = |x, y, part: f32| self.texel(numbered, [x, y], f64::from(part * weight));
        read(left, top, (1.0 - s) * (1.0 - t));
        read(right, top, s * (1.0 - t));
        read(left, bottom, (1.0 - s) * t);
        read(right, bottom, s * t);
    }

    /// Adds up what was read several times.
    fn finish(self) -> TextureReads {
        self.reads.once()
    }
}

impl TextureReads {
    /// The same with what was read several times added up.
    pub(super) fn once(mut self) -> Self {
        let texels = &mut self.texels;
        texels.sort_by_key(|texel| (texel.level, texel.at[1], texel.at[0]));
        texels.dedup_by(|next, kept| {
            let same = (next.level, next.at) == (kept.level, kept.at);
            if same {
                kept.weight += next.weight;
            }
            same
        });
        self
    }

    /// The texels times their weights: the colour that was read, premultiplied, channels in `0.0..=255.0`.
    pub fn mean(&self) -> [f64; 4] {
        let mut mean = [0.0; 4];
        for texel in &self.texels {
            for (mean, channel) in mean.iter_mut().zip(texel.color) {
                *mean += f64::from(channel) * texel.weight;
            }
        }
        mean
    }

    /// The mean as a sample stores it: what cubic kernels bring beyond a colour is clamped.
    pub fn color(&self) -> Premultiplied16 {
        let per_byte = f64::from(Premultiplied16::PER_BYTE);
        Premultiplied16(self.clamped().map(|channel| whole(channel * per_byte)))
    }

    /// The mean, with alpha at most what there can be and no channel above alpha.
    pub fn clamped(&self) -> [f64; 4] {
        let [r, g, b, alpha] = self.mean();
        let alpha = alpha.clamp(0.0, 255.0);
        [r.clamp(0.0, alpha), g.clamp(0.0, alpha), b.clamp(0.0, alpha), alpha]
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a weighted mean of bytes is a byte, which is 16 bits when stored"
)]
fn whole(channel: f64) -> u16 {
    (channel + 0.5) as u16
}

#[cfg(test)]
mod tests {
    use super::super::{Anisotropy, MipPyramid, SamplingSettings, oracle};
    use super::*;
    use crate::rules::Rules;
    use crate::simd;

    #[test]
    fn texels_times_weights_are_the_filtered_colour() {
        arbtest::arbtest(|u| {
            let pyramid = oracle::pyramid(u)?;
            let map = oracle::map(u, &pyramid.levels()[0])?;
            let grid = oracle::grid(u, &map)?;
            let filter = oracle::filter(u, &pyramid, &map)?;
            for _ in 0..20 {
                let point = [u.int_in_range(0..=1100)?, u.int_in_range(0..=1100)?];
                let mut color = [Premultiplied16::TRANSPARENT];
                filter.points(simd::level(), grid, &[point], &mut color);
                let reads = filter.reads(grid, point);
                for (found, drawn) in reads.color().0.iter().zip(color[0].0) {
                    // Several taps are scaled in 32 bits: the last bit may differ.
                    assert!(found.abs_diff(drawn) <= 1, "{reads:?} is not {color:?}");
                }
                check_decided(&reads, filter.plan(grid).pixel, &pyramid);
                let weights: f64 = reads.texels.iter().map(|texel| texel.weight).sum();
                assert!((weights - 1.0).abs() < 1e-9, "weights sum to {weights}");
                for texel in &reads.texels {
                    let level = &pyramid.levels()[texel.level];
                    let [x, y] = texel.at.map(u32::cast_signed);
                    assert!(texel.at[0] < level.width() && texel.at[1] < level.height(), "inside");
                    assert_eq!(level.texel(x, y), texel.color, "the texel of that place");
                }
            }
            Ok(())
        })
        .budget_ms(400);
    }

    /// Each texel that weighs anything lies where a tap says that it does.
    #[expect(clippy::cast_possible_truncation, reason = "a place in a level")]
    fn check_decided(reads: &TextureReads, pixel: PixelSampling, pyramid: &MipPyramid) {
        for texel in &reads.texels {
            let level = &pyramid.levels()[texel.level];
            let decides = |tap: &TapRead| {
                let first = (tap.at - fixed_point::first_centre(pixel)).floor();
                let [least, most] = match pixel {
                    PixelSampling::Nearest => [0, 0],
                    PixelSampling::Bilinear => [0, 1],
                    PixelSampling::CatmullRom | PixelSampling::BSpline | PixelSampling::Mitchell => [-1, 2],
                };
                let near = |first: f64, at: u32, side: u32| {
                    (least..=most).any(|beyond| reads.wrap.texel(first as i32 + beyond, side) == at.cast_signed())
                };
                tap.level == texel.level
                    && near(first.x, texel.at[0], level.width())
                    && near(first.y, texel.at[1], level.height())
            };
            assert!(reads.taps.iter().any(decides), "{texel:?} lies beside {:?}", reads.taps);
        }
    }

    #[test]
    fn course_weighs_texels_as_it_mixes_them() {
        arbtest::arbtest(|u| {
            let pyramid = oracle::pyramid(u)?;
            let map = oracle::map(u, &pyramid.levels()[0])?;
            let settings = SamplingSettings {
                rules: Rules::Course,
                anisotropy: Anisotropy::new(u.int_in_range(1..=5)?).unwrap_or_default(),
                ..oracle::settings(u)?
            };
            let footprint = map.footprint();
            if !(footprint.dx.is_finite() && footprint.dy.is_finite()) {
                return Ok(());
            }
            let sampler = Sampler::new(&pyramid, &footprint, &settings);
            for _ in 0..20 {
                let uv = [
                    u.int_in_range(-200..=1200)? as f32 / 1e3,
                    u.int_in_range(-200..=1200)? as f32 / 1e3,
                ];
                let drawn = sampler.sample(uv[0], uv[1]);
                let reads = sampler.course_reads(uv[0], uv[1]);
                check_decided(&reads, settings.pixel, &pyramid);
                for (found, drawn) in reads.clamped().iter().zip(drawn) {
                    assert!(
                        (found - f64::from(drawn)).abs() < 0.01,
                        "{reads:?} is not {drawn} at {uv:?}"
                    );
                }
            }
            Ok(())
        })
        .budget_ms(200);
    }
}
