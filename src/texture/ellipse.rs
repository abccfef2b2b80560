//! The ellipse of the elliptical weighted average: which texels weigh, and how much.
//!
//! After Heckbert, "Fundamentals of Texture Mapping and Image Warping", 1989, sections 3.5.8 and 6.4; the weight that falls to
//! nothing at the rim is that of Pharr, Jakob and Humphreys, "Physically Based Rendering", third edition, section 10.4.5.
//!
//! ```text
//!      . . o o .        the unit circle of a pixel becomes an ellipse on the level; a circle of one texel more, which
//!      . o O O o        reconstructs the texture between its texels, keeps it from being thinner than texels are apart
//!      o O O o .
//!      . o o . .        a texel weighs exp(-2 q) - exp(-2), where q is 0 in the middle and 1 at the rim
//! ```

#![expect(
    clippy::inline_always,
    reason = "a function that is not inlined into its dispatch loses the vector instructions"
)]

use glam::DVec2;

use super::{Footprint, MipLevel, MipPyramid};

/// How many times as long as wide an ellipse counts at most: a thinner one is widened. So few texels weigh that time is bounded.
const MOST_ECCENTRIC: f64 = 16.0;
/// The longest half axis, in texels, before the circle of a texel is added; longer ones occur at the last level only.
const LONGEST: f64 = 2.0 * MOST_ECCENTRIC;

/// An ellipse on a level, about the point that is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// Number of the level.
    pub level: usize,
    /// The half axes in the level's texels, the longer one first.
    pub axes: [DVec2; 2],
    /// The squares of half its width and half its height, and how far it leans: its matrix of second moments.
    moments: Moments,
}

/// The symmetric matrix `J J^T` of the steps `J` of a footprint.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Moments {
    xx: f64,
    xy: f64,
    yy: f64,
}

/// The texels of a row under an ellipse, and what they weigh.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// The first column, and the one after the last.
    pub(super) columns: [i32; 2],
    /// Where the row is nearest to the middle.
    nearest: f64,
    /// `q` there, and what it grows by with the square of the distance from it.
    least: f64,
    growth: f64,
}

impl Ellipse {
    /// That of a footprint on a pyramid, and the level of detail, which is that of its minor axis. A footprint that is not
    /// finite is a circle of one pixel at the last level.
    pub(super) fn new(footprint: &Footprint, pyramid: &MipPyramid) -> (Self, f64) {
        let size = |level: &MipLevel| DVec2::new(f64::from(level.width()), f64::from(level.height()));
        let levels = pyramid.levels();
        let of = |level: usize| Moments::new(footprint, size(&levels[level])).widened();
        let [_, minor] = of(0).squares();
        let lod = if minor.is_finite() {
            0.5 * minor.log2()
        } else {
            f64::INFINITY
        };
        let level = whole(lod.clamp(0.0, pyramid.last_level() as f64));
        let [major, minor] = of(level).squares().map(|square| square.min(LONGEST * LONGEST) + 1.0);
        let direction = of(level).direction();
        let axes = [direction * major.sqrt(), direction.perp() * minor.sqrt()];
        let moments = Moments::of_axes(axes);
        (Self { level, axes, moments }, lod)
    }

    /// Half its width and half its height.
    #[inline]
    pub(super) fn half(&self) -> DVec2 {
        DVec2::new(self.moments.xx.sqrt(), self.moments.yy.sqrt())
    }

    /// Of a row that is `d` below the middle: `q` is `d d` times the first where it is least, which is `d` times the second beside
    /// the middle, and grows from there by the third times the square of the distance.
    #[inline]
    pub(super) fn factors(&self) -> [f64; 3] {
        let Moments { xx, xy, yy } = self.moments;
        [1.0 / yy, xy / yy, yy / (xx * yy - xy * xy)]
    }

    /// The rows of texels under it about a point, whose whole coordinates are centres of texels.
    #[inline]
    pub(super) fn rows(&self, at: DVec2) -> std::ops::RangeInclusive<i32> {
        let half = self.half().y;
        near((at.y - half).ceil())..=near((at.y + half).floor())
    }

    /// A row.
    #[inline]
    pub(super) fn row(&self, at: DVec2, y: i32) -> Row {
        let [down, lean, growth] = self.factors();
        let below = f64::from(y) - at.y;
        let least = below * below * down;
        let nearest = at.x + below * lean;
        let half = ((1.0 - least).max(0.0) / growth).sqrt();
        Row {
            columns: [near((nearest - half).ceil()), near((nearest + half).floor()) + 1],
            nearest,
            least,
            growth,
        }
    }
}

impl Row {
    /// What the texel in a column weighs, not yet divided by the sum of all; nothing beyond the rim.
    #[inline]
    pub(super) fn weight(&self, column: i32) -> f32 {
        let beside = f64::from(column) - self.nearest;
        weight(narrow(self.least + self.growth * beside * beside))
    }
}

/// `exp(-2 q) - exp(-2)`, nothing from 1 on. By the eighth power of a series, which errs by less than 0.0001: whatever the
/// machine, it is the same to the last bit.
#[inline(always)]
pub(super) fn weight(q: f32) -> f32 {
    /// The same power at 1.
    const RIM: f32 = power(1.0);
    (power(q.min(1.0)) - RIM).max(0.0)
}

/// `exp(-2 q)`.
#[inline(always)]
const fn power(q: f32) -> f32 {
    let t = q * 0.25;
    let root = 1.0 - t * (1.0 - t * (0.5 - t * (1.0 / 6.0 - t * (1.0 / 24.0))));
    let square = root * root;
    let fourth = square * square;
    fourth * fourth
}

impl Moments {
    fn new(footprint: &Footprint, size: DVec2) -> Self {
        Self::of_axes([footprint.dx * size, footprint.dy * size])
    }

    fn of_axes([a, b]: [DVec2; 2]) -> Self {
        Self {
            xx: a.x * a.x + b.x * b.x,
            xy: a.x * a.y + b.x * b.y,
            yy: a.y * a.y + b.y * b.y,
        }
    }

    /// The squares of the half axes, the longer one first.
    fn squares(&self) -> [f64; 2] {
        let apart = (self.xx - self.yy) * 0.5;
        let major = (self.xx + self.yy) * 0.5 + (apart * apart + self.xy * self.xy).sqrt();
        // The product of both is the determinant; a difference would cancel.
        let minor = (self.xx * self.yy - self.xy * self.xy).max(0.0) / major;
        [major, if major > 0.0 { minor.min(major) } else { 0.0 }]
    }

    /// Along the longer half axis, of length one.
    fn direction(&self) -> DVec2 {
        let [major, _] = self.squares();
        let (first, second) = (
            DVec2::new(major - self.yy, self.xy),
            DVec2::new(self.xy, major - self.xx),
        );
        let longer = if first.length_squared() > second.length_squared() {
            first
        } else {
            second
        };
        longer.try_normalize().unwrap_or(DVec2::X)
    }

    /// At most [`MOST_ECCENTRIC`] times as long as wide; one whose squares are no numbers is nothing at all, and one that is
    /// infinite stays it.
    fn widened(&self) -> Self {
        let [major, minor] = self.squares();
        if !major.is_finite() {
            return Self {
                xx: f64::INFINITY,
                xy: 0.0,
                yy: f64::INFINITY,
            };
        }
        let wide = minor.max(major / (MOST_ECCENTRIC * MOST_ECCENTRIC));
        let direction = self.direction();
        Self::of_axes([direction * major.sqrt(), direction.perp() * wide.sqrt()])
    }
}

/// A column or a row near a level; see `fixed_point::REACH`.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    reason = "`as` saturates, and points lie near their level"
)]
fn near(at: f64) -> i32 {
    at as i32
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a level of detail is clamped to 0..=30"
)]
fn whole(lod: f64) -> usize {
    lod as usize
}

#[inline]
#[expect(clippy::cast_possible_truncation, reason = "weights are 32-bit floats")]
fn narrow(q: f64) -> f32 {
    q as f32
}
