//! The sub-pixel grid: where vertices may lie and where samples do, all in integers.
//!
//! Coverage is decided exactly, so every vertex is snapped once to a fixed-point grid. One unit is `1 / (n << bits)`
//! of a pixel, where `n x n` is the sample rate: samples then lie on the grid for every `n`, also for 3, 5, 6 and 7.
//! About 14 bits per pixel are kept whatever the rate, far more than the 8 that a picture needs, so that snapping
//! moves an edge by less than 1/18 000 of a pixel. Together with [`GUARD`] all coordinates fit `i32` and all edge
//! values fit `i64`: `2^16` pixels times `2^14` units are `2^30`, and products of two differences `2^61`.

use glam::DVec2;

/// The part of screen space that vertices may lie in, in pixels: `(least, greatest)` of x and of y. Geometry beyond
/// it is clipped. It reaches as far beyond the largest frame on either side, so that clipped edges stay invisible.
pub const GUARD: (f64, f64) = (-24_576.0, 40_960.0);

/// Bits per pixel that the grid should have, whatever the sample rate.
const BITS_PER_PIXEL: u32 = 14;

/// A vertex on the sub-pixel grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridPoint {
    /// To the right, in units of the grid.
    pub x: i32,
    /// Down, in units of the grid.
    pub y: i32,
}

/// The fixed-point grid for one sample rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SubpixelGrid {
    side: i32,
    bits: u32,
}

impl SubpixelGrid {
    /// Samples along one side of a pixel that [`SubpixelGrid::fine`] has.
    pub const FINE_SIDE: u32 = 256;

    /// The grid for `side x side` samples per pixel, `1..=16`.
    pub fn new(side: u32) -> Self {
        assert!((1..=16).contains(&side), "{side} x {side} samples are not supported");
        Self::of_side(side)
    }

    /// The grid for samples that may lie anywhere in a pixel: as if it had 256 x 256 of them, of which a pattern takes
    /// some.
    pub fn fine() -> Self {
        Self::of_side(Self::FINE_SIDE)
    }

    fn of_side(side: u32) -> Self {
        let bits = BITS_PER_PIXEL - side.next_power_of_two().trailing_zeros();
        Self {
            side: side.cast_signed(),
            bits,
        }
    }

    /// A grid of the same units on which a sample lies in the middle of each pixel: as many samples along a side as are left when
    /// their number is halved until it is odd.
    #[must_use]
    pub fn with_centres(&self) -> Self {
        let halvings = self.side.trailing_zeros();
        Self {
            side: self.side >> halvings,
            bits: self.bits + halvings,
        }
    }

    /// A grid of the same units with as many samples along a side of a pixel as doubling gives, up to 256: at least 129.
    #[must_use]
    pub fn dense(&self) -> Self {
        let doublings = (Self::FINE_SIDE / self.side.cast_unsigned()).ilog2();
        Self {
            side: self.side << doublings,
            bits: self.bits - doublings,
        }
    }

    /// Samples along one side of a pixel.
    pub fn side(&self) -> i32 {
        self.side
    }

    /// Fractional bits between two neighbouring samples.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// Units per pixel.
    pub fn units_per_pixel(&self) -> f64 {
        f64::from(self.side << self.bits)
    }

    /// The grid point nearest to a screen-space point, which must lie inside [`GUARD`].
    #[inline]
    pub fn snap(&self, point: DVec2) -> GridPoint {
        let scaled = point * self.units_per_pixel();
        GridPoint {
            x: round_to_i32(scaled.x),
            y: round_to_i32(scaled.y),
        }
    }

    /// The first sample row or column at or after a coordinate: samples lie at `(i + 1/2) << bits`.
    #[inline]
    pub fn sample_at_or_after(&self, coordinate: i32) -> i32 {
        let half = 1 << (self.bits - 1);
        (coordinate - half + (1 << self.bits) - 1) >> self.bits
    }

    /// The first sample row or column after a coordinate.
    #[inline]
    pub fn sample_after(&self, coordinate: i32) -> i32 {
        self.sample_at_or_after(coordinate + 1)
    }

    /// The coordinate of a sample row or column.
    #[inline]
    pub fn sample_coordinate(&self, index: i32) -> i32 {
        (index << self.bits) + (1 << (self.bits - 1))
    }

    /// The position of a sample row or column in pixels.
    #[inline]
    pub fn sample_position(&self, index: i32) -> f64 {
        (f64::from(index) + 0.5) / f64::from(self.side)
    }
}

/// `1.5 * 2^52`: at this size a 64-bit float holds whole numbers only. Adding it to a number rounds that to the nearest one, whose
/// lowest bits are those of an integer; no machine needs a call for it.
pub(crate) const WHOLE: f64 = 6_755_399_441_055_744.0;

/// To nearest, for values of `i32`; halves go up, so that shifting by whole units commutes with rounding.
///
/// Neither `floor` nor a saturating conversion is a single instruction on every machine; additions are.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the lowest 32 bits are meant")]
fn round_to_i32(value: f64) -> i32 {
    debug_assert!(value.abs() < 2_147_483_647.0, "{value} lies on the grid");
    let value = value + 0.5;
    let whole = value + WHOLE;
    // The nearest whole number may be the one above.
    let above = whole - WHOLE > value;
    (whole.to_bits() as u32).cast_signed() - i32::from(above)
}

/// The whole number at or below, saturating; NaN becomes 0.
#[expect(clippy::cast_possible_truncation, reason = "`as` saturates")]
pub fn floor_to_i32(value: f64) -> i32 {
    value.floor() as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_lie_on_the_grid_for_every_rate() {
        for side in 1..=16 {
            let grid = SubpixelGrid::new(side);
            assert!(grid.bits() >= 8, "rate {side} keeps at least 8 bits between samples");
            for index in [-40, -1, 0, 1, 7, 1000] {
                let at = grid.sample_coordinate(index);
                let exact = grid.sample_position(index) * grid.units_per_pixel();
                assert!((f64::from(at) - exact).abs() < 1e-6, "sample {index} of rate {side}");
                assert_eq!(grid.sample_at_or_after(at), index, "a sample is at itself");
                assert_eq!(
                    grid.sample_at_or_after(at + 1),
                    index + 1,
                    "one unit later comes the next"
                );
                assert_eq!(grid.sample_after(at), index + 1, "after a sample comes the next");
                assert_eq!(
                    grid.sample_after(at - 1),
                    index,
                    "one unit before it the sample is still to come"
                );
            }
        }
    }

    #[test]
    fn coarser_and_denser_grids_have_the_same_units() {
        for side in 1..=16 {
            let grid = SubpixelGrid::new(side);
            for other in [grid.with_centres(), grid.dense()] {
                let units = |grid: SubpixelGrid| grid.side() << grid.bits();
                assert_eq!(units(other), units(grid), "{side}: {other:?}");
            }
            let [centres, dense] = [grid.with_centres(), grid.dense()];
            let middle = centres.sample_coordinate(centres.side() / 2);
            assert_eq!(2 * middle, centres.side() << centres.bits(), "{side}: the middle");
            assert!(
                (129..=256).contains(&dense.side()) && dense.bits() > 0,
                "{side}: {dense:?}"
            );
        }
        assert_eq!(SubpixelGrid::fine().dense(), SubpixelGrid::fine(), "it is dense enough");
    }

    #[test]
    fn snap_rounds_to_nearest_and_commutes_with_whole_pixels() {
        let grid = SubpixelGrid::new(4);
        let unit = 1.0 / grid.units_per_pixel();
        for x in [0.0, 0.5 * unit, -0.5 * unit, 3.25, -17.3] {
            let near = grid.snap(DVec2::new(x, 0.0)).x;
            let far = grid.snap(DVec2::new(x + 512.0, 0.0)).x;
            assert_eq!(far - near, 512 << 14, "snapping {x} and its shift");
        }
    }

    #[test]
    #[expect(clippy::cast_possible_truncation, reason = "the values fit")]
    fn rounding_by_additions_is_rounding() {
        let slow = |value: f64| (value + 0.5).floor() as i32;
        let edges: [f64; 8] = [0.0, 0.5, 1.0, 1.5, 2.5, 1e9 + 0.5, 671_088_640.0, 402_653_184.5];
        for value in edges {
            for near in [
                value,
                f64::from_bits(value.to_bits() + 1),
                f64::from_bits(value.to_bits().max(1) - 1),
            ] {
                assert_eq!(round_to_i32(near), slow(near), "{near:?}");
                assert_eq!(round_to_i32(-near), slow(-near), "-{near:?}");
            }
        }
        arbtest::arbtest(|u| {
            let value =
                u.int_in_range(-1_000_000_000_i64..=1_000_000_000)? as f64 / 2_f64.powi(u.int_in_range(0..=40)?);
            assert_eq!(round_to_i32(value), slow(value), "{value:?}");
            Ok(())
        })
        .budget_ms(100);
    }

    #[test]
    fn guard_fits_thirty_bits() {
        for side in 1..=16 {
            let grid = SubpixelGrid::new(side);
            let low = grid.snap(DVec2::splat(GUARD.0)).x;
            let high = grid.snap(DVec2::splat(GUARD.1)).x;
            assert!(high - low <= 1 << 30, "extent of rate {side}: {}", high - low);
        }
    }
}
