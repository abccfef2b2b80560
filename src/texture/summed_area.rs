//! Summed-area tables: the mean of any box of texels from the sums at its four corners (Crow, "Summed-area tables for texture
//! mapping", 1984).
//!
//! ```text
//!      a-----------b             a number of the table is the sum of all texels above and to the left of a corner of texels
//!      |   +-------+
//!      |   | box   |             the sum over the box = d - b - c + a
//!      c---+-------d
//! ```
//!
//! A border of the box that lies inside a texel takes its part of that texel: sums between corners of texels are linear along
//! both axes, so that mixing the four corners around a point is exact. All sums are whole numbers: those of bytes fit 32 bits,
//! and `box_means` reads them; those of light are held by 64-bit floats.

use glam::DVec2;

use super::fixed_point::REACH;
use super::light_bytes::LightBytes;
use super::pyramid_values::PyramidValues;
use super::{MipLevel, PyramidFilter, TexelBox, Wrap};
use crate::color::{Premultiplied16, ResolveSpace};

/// Sums of a level's texels.
pub struct SummedAreaTable {
    size: [u32; 2],
    sums: Sums,
}

/// The numbers of a table, row by row: one row and one column more than texels; the first ones are nothing.
pub(super) enum Sums {
    Bytes(Vec<[u32; 4]>),
    Light(Box<SumsOfLight>),
}

/// The numbers of a table of light, and how their means become texels.
pub(super) struct SumsOfLight {
    /// In steps of one part in [`SumsOfLight::STEPS`].
    pub(super) sums: Vec<[f64; 4]>,
    values: PyramidValues,
    bytes: LightBytes,
}

/// What a sample read of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxRead {
    /// Number of the level whose texels were summed.
    pub level: usize,
    /// The upper left corner of the box, in texels; beyond the level there is what the wrap says.
    pub from: DVec2,
    /// The lower right one.
    pub to: DVec2,
    /// The table at the corners of a box that lies inside the level: upper left, upper right, lower left, lower right; red,
    /// green, blue, alpha each.
    pub corners: Option<[[f64; 4]; 4]>,
    /// The sum over the box.
    pub sum: [f64; 4],
    /// Its area in texels.
    pub area: f64,
    /// Whether light was summed, of which 65535 is all, instead of bytes.
    pub is_of_light: bool,
}

/// A stretch of an axis inside a level, and how often it counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stretch {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) times: f64,
}

/// What a side of a box becomes: up to four stretches, those of no length at the end.
pub(super) type Stretches = [Stretch; 4];

impl SummedAreaTable {
    /// The sums of a level in these values.
    pub(super) fn build(level: &MipLevel, space: ResolveSpace) -> Self {
        let size = [level.width(), level.height()];
        let sums = match space {
            // The largest level that is summed has a few million texels, so that nothing overflows.
            ResolveSpace::Stored => Sums::Bytes(summed(level, [0; 4], |sum, texel| {
                std::array::from_fn(|i| sum[i].wrapping_add(u32::from(texel[i])))
            })),
            ResolveSpace::Linear => {
                let values = PyramidValues::new(space, PyramidFilter::Box);
                let numbers = summed(level, [0.0; 4], |sum, texel| {
                    let value = values.value(texel);
                    std::array::from_fn(|i| sum[i] + (f64::from(value[i]) * SumsOfLight::STEPS).round())
                });
                Sums::Light(Box::new(SumsOfLight {
                    sums: numbers,
                    bytes: LightBytes::new(&values),
                    values,
                }))
            }
        };
        Self { size, sums }
    }

    /// The sums of bytes, where bytes are summed.
    #[inline]
    pub(super) fn of_bytes(&self) -> Option<&[[u32; 4]]> {
        match &self.sums {
            Sums::Bytes(sums) => Some(sums),
            Sums::Light(_) => None,
        }
    }

    /// The numbers.
    #[inline]
    pub(super) fn sums(&self) -> &Sums {
        &self.sums
    }

    /// Width and height in texels.
    #[inline]
    pub(super) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The mean of a box anywhere about a point, both in texels from the corner of the first one; what `box_sums` finds in
    /// vectors.
    #[cfg(test)]
    pub(super) fn mean(&self, at: DVec2, area: &TexelBox, wrap: Wrap) -> Premultiplied16 {
        let (sum, texels) = self.wrapped(at, area, wrap);
        self.color(sum, texels)
    }

    /// What the mean of a box anywhere about a point is made of.
    pub(super) fn read(&self, at: DVec2, area: &TexelBox, wrap: Wrap) -> BoxRead {
        let half = area.sides * 0.5;
        let (from, to) = (at - half, at + half);
        let (sum, texels) = self.wrapped(at, area, wrap);
        let size = DVec2::from(self.size.map(f64::from));
        let is_inside = from.min_element() >= 0.0 && to.cmple(size).all();
        let corners = || [[from.x, from.y], [to.x, from.y], [from.x, to.y], [to.x, to.y]].map(|[x, y]| self.at(x, y));
        BoxRead {
            level: area.level,
            from,
            to,
            corners: is_inside.then(corners),
            sum,
            area: texels,
            is_of_light: self.is_of_light(),
        }
    }

    /// The texels under a box about a point, and their parts of it, which are one together; `None` where they are too many to be
    /// listed.
    pub(super) fn texels(&self, at: DVec2, area: &TexelBox, wrap: Wrap) -> Option<Vec<([u32; 2], f64)>> {
        /// Texels that are listed at most.
        const MOST: usize = 4096;
        let [columns, rows] = self.stretches(at, area, wrap).map(|stretches| parts(&stretches));
        if columns.len() * rows.len() > MOST {
            return None;
        }
        let all = rows
            .iter()
            .flat_map(|(y, down)| columns.iter().map(move |(x, across)| ([*x, *y], across * down)));
        Some(all.collect())
    }

    /// Whether light is summed, instead of stored values.
    fn is_of_light(&self) -> bool {
        matches!(self.sums, Sums::Light(_))
    }

    /// The sum over a box anywhere, and its area.
    fn wrapped(&self, at: DVec2, area: &TexelBox, wrap: Wrap) -> ([f64; 4], f64) {
        let [columns, rows] = self.stretches(at, area, wrap);
        let mut sum = [0.0; 4];
        for (column, row) in rows
            .iter()
            .flat_map(|row| columns.iter().map(move |column| (column, row)))
        {
            let times = column.times * row.times;
            if times > 0.0 {
                let part = self.over([column.from, column.to], [row.from, row.to]);
                sum = std::array::from_fn(|i| sum[i] + part[i] * times);
            }
        }
        (sum, length(&columns) * length(&rows))
    }

    fn stretches(&self, at: DVec2, area: &TexelBox, wrap: Wrap) -> [Stretches; 2] {
        let half = area.sides * 0.5;
        let axis = |side: u32, at: f64, half: f64| stretches(wrap, f64::from(side), at, half);
        [axis(self.size[0], at.x, half.x), axis(self.size[1], at.y, half.y)]
    }

    /// The sum over a box inside the level.
    #[inline]
    fn over(&self, [left, right]: [f64; 2], [top, bottom]: [f64; 2]) -> [f64; 4] {
        let [a, b] = [self.at(left, top), self.at(right, top)];
        let [c, d] = [self.at(left, bottom), self.at(right, bottom)];
        std::array::from_fn(|i| (d[i] - b[i]) - (c[i] - a[i]))
    }

    /// The sum of all that lies above and to the left of a point inside the level.
    #[inline]
    fn at(&self, x: f64, y: f64) -> [f64; 4] {
        let stride = self.size[0] as usize + 1;
        let [column, row] = [whole(x).min(self.size[0] - 1), whole(y).min(self.size[1] - 1)];
        let (across, down) = (x - f64::from(column), y - f64::from(row));
        let start = row as usize * stride + column as usize;
        let number = |at: usize| match &self.sums {
            Sums::Bytes(sums) => sums[at].map(f64::from),
            Sums::Light(light) => light.sums[at],
        };
        let upper = [number(start), number(start + 1)];
        let lower = [number(start + stride), number(start + stride + 1)];
        std::array::from_fn(|i| {
            let above = upper[0][i] + (upper[1][i] - upper[0][i]) * across;
            let below = lower[0][i] + (lower[1][i] - lower[0][i]) * across;
            above + (below - above) * down
        })
    }

    /// The colour of a mean.
    #[inline]
    pub(super) fn color(&self, sum: [f64; 4], area: f64) -> Premultiplied16 {
        if let Sums::Light(light) = &self.sums {
            return light.texel(SumsOfLight::mean(sum, area));
        }
        let per_byte = f64::from(Premultiplied16::PER_BYTE) / area;
        Premultiplied16(sum.map(|sum| channel(sum * per_byte)))
    }
}

impl SumsOfLight {
    /// What light, which is 0 to 1, is multiplied by to be whole numbers.
    pub(super) const STEPS: f64 = 65_535.0;

    /// The mean light of a box.
    pub(super) fn mean(sum: [f64; 4], area: f64) -> [f32; 4] {
        sum.map(|sum| narrow(sum / area / Self::STEPS))
    }

    /// The colour of such a mean.
    #[inline]
    pub(super) fn color(&self, mean: [f32; 4]) -> Premultiplied16 {
        let [r, g, b, alpha] = mean;
        if LightBytes::is_opaque(alpha) {
            let [r, g, b] = [r, g, b].map(|channel| self.bytes.byte(channel));
            return Premultiplied16::from_bytes([r, g, b, u8::MAX]);
        }
        self.texel(mean)
    }

    /// The same by its definition.
    #[inline(never)]
    fn texel(&self, mean: [f32; 4]) -> Premultiplied16 {
        Premultiplied16::from_bytes(self.values.texel(mean))
    }
}

impl Stretch {
    const NONE: Self = Self {
        from: 0.0,
        to: 0.0,
        times: 0.0,
    };

    fn length(&self) -> f64 {
        (self.to - self.from) * self.times
    }
}

/// The table of a level: `add` adds a texel to a sum.
fn summed<T: Copy + std::ops::Add<Output = T>>(
    level: &MipLevel,
    nothing: [T; 4],
    add: impl Fn([T; 4], [u8; 4]) -> [T; 4],
) -> Vec<[T; 4]> {
    let stride = level.width() as usize + 1;
    let mut sums = vec![nothing; stride * (level.height() as usize + 1)];
    for y in 0..level.height() {
        let start = stride * y as usize;
        let mut row = nothing;
        for x in 0..level.width() {
            let at = start + x as usize + 1;
            row = add(row, level.texel(x.cast_signed(), y.cast_signed()));
            let above = sums[at];
            sums[at + stride] = std::array::from_fn(|i| above[i] + row[i]);
        }
    }
    sums
}

/// The texels of a side.
#[inline]
pub(super) fn length(stretches: &Stretches) -> f64 {
    stretches.iter().map(Stretch::length).sum()
}

/// Where the side of a box lies in a row of `side` texels, and how often each stretch of it counts.
pub(super) fn stretches(wrap: Wrap, side: f64, at: f64, half: f64) -> Stretches {
    let mut found = [Stretch::NONE; 4];
    let mut count = 0;
    let mut add = |from: f64, to: f64, times: f64| {
        if to > from && times > 0.0 && count < found.len() {
            found[count] = Stretch { from, to, times };
            count += 1;
        }
    };
    let half = half.min(REACH);
    let period = match wrap {
        Wrap::Clamp => {
            // Far away there is nothing but the border.
            let at = at.max(-2.0 * REACH).min(side + 2.0 * REACH);
            let (from, to) = (at - half, at + half);
            add(0.0, 1.0, to.min(0.0) - from.min(0.0));
            add(from.max(0.0), to.min(side), 1.0);
            add(side - 1.0, side, to.max(side) - from.max(side));
            return found;
        }
        Wrap::Repeat => side,
        Wrap::Mirror => 2.0 * side,
    };
    let from = at - half;
    let from = if from.is_finite() {
        from - (from / period).floor() * period
    } else {
        0.0
    };
    let times = (2.0 * half / period).floor();
    add(0.0, side, times * period / side);
    let to = from + (2.0 * half - times * period);
    for copy in 0..4 {
        let start = f64::from(copy) * side;
        let (low, high) = (from.max(start) - start, to.min(start + side) - start);
        if wrap == Wrap::Mirror && copy % 2 == 1 {
            add((side - high).max(0.0), (side - low).min(side), 1.0);
        } else {
            add(low.max(0.0), high.min(side), 1.0);
        }
    }
    found
}

/// The texels of a row under some stretches, and their parts of them.
fn parts(stretches: &Stretches) -> Vec<(u32, f64)> {
    let total = length(stretches);
    let mut found: Vec<(u32, f64)> = Vec::new();
    for Stretch { from, to, times } in stretches.iter().filter(|stretch| stretch.times > 0.0) {
        for texel in whole(*from)..whole(to.ceil()) {
            let left = f64::from(texel);
            let part = (to.min(left + 1.0) - from.max(left)) * times / total;
            if part > 0.0 {
                found.push((texel, part));
            }
        }
    }
    found
}

/// A column or a row; what is below the first one, or no number, is that.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "`as` saturates, and places are clamped to their level"
)]
fn whole(at: f64) -> u32 {
    at as u32
}

/// A channel, rounded to nearest.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a mean of bytes is a byte, which is 16 bits when stored"
)]
fn channel(mean: f64) -> u16 {
    (mean + 0.5) as u16
}

#[inline]
#[expect(clippy::cast_possible_truncation, reason = "light is a 32-bit float")]
fn narrow(light: f64) -> f32 {
    light as f32
}

impl std::fmt::Debug for SummedAreaTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SummedAreaTable")
            .field("size", &self.size)
            .finish_non_exhaustive()
    }
}
