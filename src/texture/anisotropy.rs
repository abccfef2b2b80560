//! Anisotropic filtering: into how many taps a long footprint is cut, and where they lie.
//!
//! After the Vulkan specification, chapter "Image Operations": "Scale Factor Operation, LOD Operation and Image Level(s)
//! Selection" for the ratio, "Texel Anisotropic Filtering" for the taps.

use glam::DVec2;

use super::Footprint;

/// The most taps that a long footprint is cut into: 1, which is isotropic filtering, to 64.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Anisotropy(u8);

/// How often a footprint is read, and where: evenly spread over its longer side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taps {
    /// Taps per sample, at least 1.
    pub count: u32,
    /// How many times as long as wide the footprint counts, `1.0` with one tap: the level of detail is that of the longer
    /// side divided by it.
    pub ratio: f64,
    /// Whether the step to the right is the longer side, and not the step down.
    pub along_x: bool,
}

impl Anisotropy {
    /// One tap.
    pub const OFF: Self = Self(1);
    /// The greatest value.
    pub const MAX: u32 = 64;
    /// The values that menus offer and keys step through.
    pub const STEPS: [Self; 7] = [Self(1), Self(2), Self(4), Self(8), Self(16), Self(32), Self(64)];

    /// At most `taps`, or `None` unless that is 1 to 64.
    pub fn new(taps: u32) -> Option<Self> {
        let taps = u8::try_from(taps).ok()?;
        (1..=Self::MAX).contains(&u32::from(taps)).then_some(Self(taps))
    }

    /// Twice as many, at most [`Anisotropy::MAX`]; [`Anisotropy::OFF`] after that.
    #[must_use]
    pub fn doubled(self) -> Self {
        match u32::from(self.0) {
            Self::MAX => Self::OFF,
            taps => Self::new(2 * taps).unwrap_or(Self::STEPS[6]),
        }
    }

    /// The most taps.
    pub fn taps(self) -> u32 {
        u32::from(self.0)
    }
}

impl Default for Anisotropy {
    fn default() -> Self {
        Self::OFF
    }
}

impl Taps {
    /// One tap: isotropic filtering.
    pub const ONE: Self = Self {
        count: 1,
        ratio: 1.0,
        along_x: true,
    };

    /// For a footprint on a base level of `size` texels.
    ///
    /// The ratio is that of the two sides' lengths in texels, at most `most` and at most as many as the longer side has
    /// texels (specified as an implementation's choice: closer taps would read the same texels again); it is rounded up
    /// to the number of taps. A footprint that is not finite, or a point, has one tap.
    pub fn new(footprint: &Footprint, size: DVec2, most: Anisotropy) -> Self {
        /// What a square footprint's sides may differ by from rounding.
        const NOISE: f64 = 1.0 / 1024.0;
        if most == Anisotropy::OFF {
            return Self::ONE;
        }
        let (right, down) = ((footprint.dx * size).length(), (footprint.dy * size).length());
        let (longer, shorter) = (right.max(down), right.min(down));
        let most = f64::from(most.taps()).min(longer);
        let ratio = (longer / shorter).min(most);
        // The sum is no number where one of the sides is none, and infinite where one is; a point's ratio is no number.
        if !(right + down).is_finite() || ratio.is_nan() || ratio <= 1.0 + NOISE {
            return Self::ONE;
        }
        Self {
            count: whole((ratio - NOISE).ceil()),
            ratio,
            along_x: right > down,
        }
    }

    /// Where tap `i` of `0..count` lies, as a part of the longer side, from its middle.
    pub fn place(&self, i: u32) -> f64 {
        f64::from(i + 1) / f64::from(self.count + 1) - 0.5
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a number of taps is 1 to 64"
)]
fn whole(taps: f64) -> u32 {
    taps as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taps(dx: [f64; 2], dy: [f64; 2], most: u32) -> Taps {
        let size = DVec2::new(64.0, 32.0);
        let footprint = Footprint {
            dx: DVec2::from(dx) / size,
            dy: DVec2::from(dy) / size,
        };
        Taps::new(&footprint, size, Anisotropy::new(most).expect("a maximum"))
    }

    #[test]
    fn taps_follow_the_ratio_of_the_sides() {
        let long = taps([6.0, 8.0], [-0.4, 0.3], 64);
        assert_eq!((long.count, long.along_x), (10, true), "no more than texels");
        let long = taps([6.0, 8.0], [-3.2, 2.4], 64);
        assert_eq!((long.count, long.along_x), (3, true), "2.5 is rounded up");
        assert!((long.ratio - 2.5).abs() < 1e-12, "10 over 4");
        let upright = taps([1.0, 0.0], [0.0, 16.0], 8);
        assert_eq!((upright.count, upright.along_x), (8, false), "the maximum");
        assert!((upright.ratio - 8.0).abs() < 1e-12, "the maximum");
        assert_eq!(taps([0.0, 0.0], [0.0, 16.0], 64).count, 16, "a line");
        for (dx, dy, why) in [
            ([3.0, 4.0], [-4.0, 3.0], "a square, turned"),
            ([0.3, 0.0], [0.0, 0.9], "magnified"),
            ([0.0, 0.0], [0.0, 0.0], "a point"),
            ([f64::NAN, 0.0], [0.0, 3.0], "no number"),
            ([1.0, 0.0], [f64::INFINITY, 3.0], "infinite"),
            ([1e200, 0.0], [1.0, 3.0], "a square that is infinite"),
        ] {
            assert_eq!(taps(dx, dy, 64), Taps::ONE, "{why}");
        }
        assert_eq!(taps([9.0, 0.0], [0.0, 1.0], 1), Taps::ONE, "switched off");
    }

    #[test]
    fn taps_lie_evenly_about_the_middle() {
        let three = taps([3.0, 0.0], [0.0, 1.0], 16);
        let places: Vec<f64> = (0..three.count).map(|i| three.place(i)).collect();
        assert_eq!(places, [-0.25, 0.0, 0.25], "three of them");
        assert!(Taps::ONE.place(0).abs() < f64::EPSILON, "one is in the middle");
    }

    #[test]
    fn anisotropy_has_limits() {
        assert_eq!(Anisotropy::new(0), None, "too few");
        assert_eq!(Anisotropy::new(65), None, "too many");
        assert_eq!(Anisotropy::new(257), None, "far too many");
        assert_eq!(Anisotropy::new(64).map(Anisotropy::taps), Some(64), "the most");
        let mut taps = Anisotropy::OFF;
        for step in Anisotropy::STEPS {
            assert_eq!(taps, step, "doubled");
            taps = taps.doubled();
        }
        assert_eq!(taps, Anisotropy::OFF, "and round");
        let odd = Anisotropy::new(48).expect("a maximum");
        assert_eq!(odd.doubled().taps(), 64, "never beyond");
    }
}
