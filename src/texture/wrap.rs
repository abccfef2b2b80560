//! What a texture shows beyond its border: OpenGL 4.6, section 8.14.2, "Coordinate wrapping and texel selection".
//!
//! ```text
//!     u         -1     0     1     2     3
//!     clamp      |<<<<<|a b c|>>>>>|>>>>>|     the outermost texels go on
//!     repeat     |a b c|a b c|a b c|a b c|     the texel before the first one is the last one
//!     mirror     |c b a|a b c|c b a|a b c|     the texel before the first one is the first one
//! ```
//!
//! A point is brought into the texture first; from there filters read across the border, at each level by its own number of
//! texels. The pyramid is the same for all: its coarser texels next to a border were made of clamped ones, so that filters
//! wider than the box, and sides that are no powers of two, leave a faint seam where a repeated texture meets itself.

use super::MipLevel;
use super::PixelSampling;
use super::cubic::Cubic;
use super::fixed_point::{REACH, first_centre, signed, tap_offset};

/// What a texture shows beyond its border.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The colours of its border.
    #[default]
    Clamp,
    /// Itself, again and again.
    Repeat,
    /// Itself again and again, every other time turned round.
    Mirror,
}

/// A level's axis as one that goes on for ever, in fixed point from the corner of the first texel; [`Wrap::Clamp`] has none.
#[derive(Clone, Copy, Debug)]
pub(super) struct Endless {
    /// After how many texels everything comes again, and one through that.
    pub(super) period: f64,
    pub(super) inverse: f64,
    /// From the corner of the first texel to where coordinates are counted from, in texels.
    pub(super) first_centre: f64,
    /// The same in fixed point.
    pub(super) fixed_period: i32,
    pub(super) fixed_centre: i32,
    /// What a place and the one that shows the same add up to; -1 where nothing is turned round.
    pub(super) fixed_turn: i32,
}

impl Wrap {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Clamp, Self::Repeat, Self::Mirror];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Clamp => "clamp",
            Self::Repeat => "repeat",
            Self::Mirror => "mirror",
        }
    }

    /// The texel that stands at a place, of a row or a column of `side` texels.
    pub(super) fn texel(self, at: i32, side: u32) -> i32 {
        let side = side.cast_signed();
        if (0..side).contains(&at) {
            // So it is mostly, and without a division.
            return at;
        }
        match self {
            Self::Clamp => at.clamp(0, side - 1),
            Self::Repeat => at.rem_euclid(side),
            Self::Mirror => {
                let in_both = at.rem_euclid(2 * side);
                in_both.min(2 * side - 1 - in_both)
            }
        }
    }

    /// Where in `0.0..=1.0` a texture coordinate lies, and whether the texture is turned round there.
    pub fn inside(self, at: f64) -> (f64, bool) {
        match self {
            Self::Clamp => (at, false),
            Self::Repeat => (at - at.floor(), false),
            Self::Mirror => {
                let in_both = at - 2.0 * (at * 0.5).floor();
                (in_both.min(2.0 - in_both), in_both > 1.0)
            }
        }
    }

    /// The same by the course's 32-bit arithmetic.
    pub(super) fn course_inside(self, uv: [f32; 2]) -> [f32; 2] {
        uv.map(|at| match self {
            Self::Clamp => at,
            Self::Repeat => at - at.floor(),
            Self::Mirror => {
                let in_both = at - 2.0 * (at * 0.5).floor();
                in_both.min(2.0 - in_both)
            }
        })
    }
}

impl Endless {
    /// That of an axis of a level whose last texel is `last`; `None` where it ends at the border.
    pub(super) fn new(wrap: Wrap, last: f64, pixel: PixelSampling) -> Option<Self> {
        let side = last + 1.0;
        let period = match wrap {
            Wrap::Clamp => return None,
            Wrap::Repeat => side,
            Wrap::Mirror => 2.0 * side,
        };
        let first_centre = first_centre(pixel);
        let fixed_period = signed(period, 0.0, period);
        Some(Self {
            period,
            inverse: period.recip(),
            first_centre,
            fixed_period,
            fixed_centre: signed(first_centre, 0.0, 1.0),
            fixed_turn: if wrap == Wrap::Mirror { fixed_period - 1 } else { -1 },
        })
    }

    /// What is added to a place for a tap that lies `offset` texels away: below zero, and less than a period.
    pub(super) fn offset(&self, offset: f64) -> i32 {
        self.before(tap_offset(offset))
    }

    /// The same of a distance in fixed point.
    pub(super) fn before(&self, offset: i32) -> i32 {
        offset.rem_euclid(self.fixed_period) - self.fixed_period
    }

    /// A coordinate in fixed point inside the first period.
    fn place(&self, at: f64, offset: i32) -> i32 {
        let from_corner = at + self.first_centre;
        let within = from_corner - (from_corner * self.inverse).floor() * self.period;
        let mut place = signed(within, 0.0, self.period) + offset;
        if place < 0 {
            place += self.fixed_period;
        }
        let turned = self.fixed_turn - place;
        if (0..place).contains(&turned) {
            place = turned;
        }
        place - self.fixed_centre
    }
}

/// How far beyond the centre of an outermost texel it still matters where a point lies, in texels, where that texel goes on:
/// so far a cubic kernel reaches to the texels inside.
pub(super) fn outside(pixel: PixelSampling) -> f64 {
    pixel.cubic().map_or(0.0, |_| Cubic::RADIUS)
}

/// Where a tap lies on an axis whose last texel is `last`, in fixed point; `offset` texels from a sample at `at`, where there
/// are several taps: both are rounded, then added. By [`Wrap::Clamp`] as far outside the level as [`outside`] says, else up to
/// half a texel. A sample counts as at most [`REACH`] texels beyond the level: from there on taps read its border.
pub(super) fn place(last: f64, (wrap, pixel): (Wrap, PixelSampling), at: f64, offset: Option<f64>) -> i32 {
    if let Some(endless) = Endless::new(wrap, last, pixel) {
        return endless.place(at, endless.offset(offset.unwrap_or(0.0)));
    }
    let [least, most] = [-outside(pixel), last + outside(pixel)];
    match offset {
        None => signed(at, least, most),
        Some(offset) => {
            let at = signed(at, -REACH, last + REACH) + tap_offset(offset);
            at.clamp(signed(least, least, most), signed(most, least, most))
        }
    }
}

impl MipLevel {
    /// The texel that stands in a column and a row; see [`Wrap`].
    #[inline]
    pub(super) fn wrapped(&self, wrap: Wrap, [x, y]: [i32; 2]) -> [u8; 4] {
        match wrap {
            Wrap::Clamp => self.texel(x, y),
            Wrap::Repeat | Wrap::Mirror => self.texel(wrap.texel(x, self.width()), wrap.texel(y, self.height())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixed_point::{FRACTION_BITS, REACH};
    use super::*;

    #[test]
    fn texels_stand_where_the_specification_says() {
        let row = |wrap: Wrap, side: u32| -> Vec<i32> { (-7..7).map(|at| wrap.texel(at, side)).collect() };
        assert_eq!(row(Wrap::Clamp, 3), [0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2]);
        assert_eq!(row(Wrap::Repeat, 3), [2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0]);
        assert_eq!(row(Wrap::Mirror, 3), [0, 0, 1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0]);
        for wrap in Wrap::ALL {
            assert_eq!(row(wrap, 1), [0; 14], "{wrap:?} of a single texel");
        }
    }

    #[test]
    fn coordinates_come_inside() {
        for (wrap, at, expected) in [
            (Wrap::Clamp, -0.25, (-0.25, false)),
            (Wrap::Repeat, -0.25, (0.75, false)),
            (Wrap::Repeat, 3.5, (0.5, false)),
            (Wrap::Mirror, -0.25, (0.25, true)),
            (Wrap::Mirror, 1.25, (0.75, true)),
            (Wrap::Mirror, 2.25, (0.25, false)),
        ] {
            assert_eq!(wrap.inside(at), expected, "{wrap:?} at {at}");
        }
    }

    #[test]
    fn clamped_places_reach_outside_as_far_as_the_kernel() {
        let one = f64::from(1 << FRACTION_BITS);
        for (pixel, least, most) in [(PixelSampling::Bilinear, 0.0, 4.0), (PixelSampling::BSpline, -2.0, 6.0)] {
            for at in [-9.0, -1.25, -0.5, 0.0, 3.5, 4.75, 5.5, 1e9] {
                let expected = f64::clamp(at, least, most) * one;
                for offset in [None, Some(0.0)] {
                    let found = place(4.0, (Wrap::Clamp, pixel), at, offset);
                    assert!((f64::from(found) - expected).abs() < 0.5, "{pixel:?} at {at}: {found}");
                }
            }
        }
    }

    #[test]
    fn places_are_those_of_texels_everywhere() {
        for wrap in [Wrap::Repeat, Wrap::Mirror] {
            let read = (wrap, PixelSampling::Nearest);
            for texel in -23..23 {
                let place = |at: f64, offset| place(4.0, read, at, offset) >> FRACTION_BITS;
                let middle = f64::from(texel) + 0.5;
                assert_eq!(place(middle, None), wrap.texel(texel, 5), "{wrap:?} of {texel}");
                for tap in [-17.0, -3.0, 2.0, 11.0] {
                    assert_eq!(
                        place(middle - tap, Some(tap)),
                        wrap.texel(texel, 5),
                        "{wrap:?} of {texel}, {tap}"
                    );
                }
            }
            for absurd in [f64::NAN, f64::INFINITY, -1e300, 1e18, 4.999_999_999] {
                let place = place(4.0, read, absurd, Some(-REACH)) >> FRACTION_BITS;
                assert!((0..5).contains(&place), "{wrap:?} at {absurd}: {place}");
            }
        }
    }
}
