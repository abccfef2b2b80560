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

use glam::DVec2;

use super::texel_blocks::Line;
use super::{Footprint, MipLevel, MipPyramid};

/// How many times as long as wide an ellipse counts at most, which is what Pharr, Jakob and Humphreys take: a thinner one is
/// widened. So few texels weigh that time is bounded.
const MOST_ECCENTRIC: f64 = 8.0;
/// The shorter half axis of a footprint has so many texels of its level, up to twice as many.
const SHORTEST: f64 = 1.0;
/// The longest half axis, in texels, before the circle of a texel is added; longer ones occur at the last level only.
const LONGEST: f64 = 2.0 * SHORTEST * MOST_ECCENTRIC;
/// What to multiply the powers of `e = 1 - q` by, from the first on, for their sum to be `exp(-2 q) - exp(-2)`: by Chebyshev
/// interpolation of what is left of it when `e` is divided by; it errs by less than 0.001.
const SERIES: [f64; 4] = [0.270_098_33, 0.288_809_73, 0.094_357_716, 0.210_595_3];
/// Adding and subtracting this rounds numbers below 512 to the parts of a texel by which [`Quadratic::within`] goes.
pub(super) const TO_PARTS: f32 = 1536.0;
/// The bits of a 32-bit float that weights keep: 16 of the fraction's 24 with the first one, which is not stored.
pub(super) const KEPT: u32 = 0xFFFF_FF00;

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

/// Where a point lies in an ellipse about another: `q` is `dy dy down + (dx - dy lean)^2 growth`.
///
/// Weights are divided by their sum, so that what all of them are multiplied by may be left out: [`Quadratic::within`] is
/// `1 - q` divided by `growth`, and the highest power of it in a weight stands alone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quadratic {
    /// What `q` is at least, by the square of the distance from the middle's row.
    pub(super) down: f32,
    /// How far beside the middle it is least, by that distance.
    pub(super) lean: f32,
    /// What it grows by with the square of the distance from there.
    pub(super) growth: f32,
    /// `1 / growth`, and `down / growth`.
    pub(super) most: f32,
    pub(super) fall: f32,
    /// What to multiply the first powers of [`Quadratic::within`] by.
    pub(super) series: [f32; 3],
}

impl Ellipse {
    /// That of a footprint on a pyramid, and the level of detail, of which the whole part is the level: at 0 the minor half axis is
    /// [`SHORTEST`]. A footprint that is not finite is a circle of one pixel at the last level.
    pub(super) fn new(footprint: &Footprint, pyramid: &MipPyramid) -> (Self, f64) {
        let size = |level: &MipLevel| DVec2::new(f64::from(level.width()), f64::from(level.height()));
        let levels = pyramid.levels();
        let of = |level: usize| Moments::new(footprint, size(&levels[level])).widened();
        let [_, minor] = of(0).squares();
        let lod = if minor.is_finite() {
            0.5 * (minor / (SHORTEST * SHORTEST)).log2()
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

    /// Along which lines the ellipse is long, and where points lie in it: right is along them, down is across.
    pub(super) fn quadratic(&self) -> (Line, Quadratic) {
        /// So many times as high as wide it must be, because texels of a row are read more quickly.
        const CLEARLY: f64 = 1.5;
        let Moments { xx, xy, yy } = self.moments;
        let line = if yy > xx * (CLEARLY * CLEARLY) {
            Line::Column
        } else {
            Line::Row
        };
        let [xx, yy] = line.turned([xx, yy]);
        let growth = yy / (xx * yy - xy * xy);
        let [a, b, c, d] = SERIES;
        let quadratic = Quadratic {
            down: narrow(1.0 / yy),
            lean: narrow(xy / yy),
            growth: narrow(growth),
            most: narrow(1.0 / growth),
            fall: narrow(1.0 / (yy * growth)),
            series: [a / (d * growth.powi(3)), b / (d * growth.powi(2)), c / (d * growth)].map(narrow),
        };
        (line, quadratic)
    }
}

impl Quadratic {
    /// `1 - q`, divided by `growth`, at a place relative to the middle, in texels: nothing at the rim, and less beyond.
    ///
    /// Where a row is nearest to the middle is rounded to parts of a texel, so that the distance of a texel from there is exact
    /// whatever it is counted from.
    #[inline]
    pub(super) fn within(self, [right, below]: [f32; 2]) -> f32 {
        let nearest = (below * self.lean + TO_PARTS) - TO_PARTS;
        let beside = right - nearest;
        (self.most - below * below * self.fall) - beside * beside
    }

    /// What a texel weighs by what it is within, not yet divided by the sum of all. It has so few digits that products with bytes
    /// are exact, so that an instruction that adds one may round once or twice.
    #[inline]
    pub(super) fn weight(self, within: f32) -> f32 {
        let [a, b, c] = self.series;
        let within = within.max(0.0);
        f32::from_bits((within * (within * (within * (within + c) + b) + a)).to_bits() & KEPT)
    }

    /// Half the height of the ellipse.
    #[inline]
    pub(super) fn half_height(self) -> f32 {
        self.down.sqrt().recip()
    }
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

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a level of detail is clamped to 0..=30"
)]
fn whole(lod: f64) -> usize {
    lod as usize
}

#[inline]
#[expect(clippy::cast_possible_truncation, reason = "weights are found in 32-bit floats")]
fn narrow(at: f64) -> f32 {
    at as f32
}
