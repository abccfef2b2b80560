//! Colour ramps of gradients: stops along a line, and what lies between and beyond them.
//!
//! ```text
//!      stop 0        stop 1                 stop 2
//!   ------+-------------+----------------------+------> t
//!        0.0           0.3                    1.0
//! ```
//!
//! Colours are mixed as they are stored, straight, as SVG's `color-interpolation: sRGB` asks for (SVG 2, section 14.2.4);
//! there is no table, so that no steps can be seen.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f64x8, mask64x8};

use super::{Premultiplied16, Rgba};
use crate::simd;

/// The largest level of a channel.
const ONE: f64 = Premultiplied16::ONE as f64;

/// What a gradient shows beyond its ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spread {
    /// The colour of the nearest end.
    #[default]
    Pad,
    /// The ramp backwards, then forwards again.
    Reflect,
    /// The ramp again.
    Repeat,
}

/// A colour at a place of a ramp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Where, `0.0..=1.0`.
    pub offset: f32,
    /// Which.
    pub color: Rgba,
}

/// Stops in order of their offsets, at least one, and what lies beyond them.
#[derive(Clone, Debug, PartialEq)]
pub struct Ramp {
    stops: Vec<Stop>,
    spread: Spread,
    /// Whether all stops are.
    opaque: bool,
}

/// The colour at one place of a ramp, and how it comes about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mix {
    /// The place on the ramp after spreading, `0.0..=1.0`.
    pub at: f64,
    /// Numbers of the two stops; the same one twice where nothing is mixed.
    pub stops: [usize; 2],
    /// The stops themselves.
    pub ends: [Stop; 2],
    /// What the second one weighs, `0.0..=1.0`.
    pub weight: f64,
    /// The mixed colour.
    pub color: Rgba,
}

/// A part of a ramp along which colours change evenly: between two stops that follow each other, or beyond the outermost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// It holds the places `start <= at < end`.
    start: f64,
    end: f64,
    /// Where it has the colour `from`, which grows by `slope` from there on: straight red, green and blue in units of
    /// [`Premultiplied16`], alpha `0.0..=1.0`.
    origin: f64,
    from: [f64; 4],
    slope: [f64; 4],
    /// Whether the whole ramp is.
    opaque: bool,
}

#[expect(
    clippy::inline_always,
    reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
)]
impl Stretch {
    /// Which of eight places lie on it.
    #[inline(always)]
    pub fn holds<S: Simd>(&self, places: f64x8<S>) -> mask64x8<S> {
        places.simd_ge(f64x8::splat(places.simd, self.start)) & places.simd_lt(f64x8::splat(places.simd, self.end))
    }

    /// Which places it holds, from the first on and before the second.
    pub fn range(&self) -> [f64; 2] {
        [self.start, self.end]
    }

    /// Straight red, green and blue where places begin to be counted, were it that long, and their growth, in units of
    /// [`Premultiplied16`].
    pub fn line(&self) -> [[f64; 3]; 2] {
        let at_zero = |k: usize| self.from[k] - self.slope[k] * self.origin;
        [[0, 1, 2].map(at_zero), [0, 1, 2].map(|k| self.slope[k])]
    }

    /// Premultiplied red, green, blue and alpha at eight places of it, in units of [`Premultiplied16`], not rounded; rounding
    /// may have carried them a little beyond its limits.
    #[inline(always)]
    pub fn levels<S: Simd>(&self, places: f64x8<S>) -> [f64x8<S>; 4] {
        let along = places - self.origin;
        let r = along * self.slope[0] + self.from[0];
        let g = along * self.slope[1] + self.from[1];
        let b = along * self.slope[2] + self.from[2];
        if self.opaque {
            return [r, g, b, f64x8::splat(places.simd, ONE)];
        }
        let alpha = along * self.slope[3] + self.from[3];
        [r * alpha, g * alpha, b * alpha, alpha * ONE]
    }
}

impl Ramp {
    /// A ramp of these stops; `None` if there is none. An offset that lies before the one of an earlier stop counts as that
    /// one (SVG 2, section 14.2.4).
    pub fn new(mut stops: Vec<Stop>, spread: Spread) -> Option<Self> {
        let mut last = 0.0_f32;
        for stop in &mut stops {
            // `max` and `min` also make a number of what is none.
            last = stop.offset.max(last).min(1.0);
            stop.offset = last;
        }
        (!stops.is_empty()).then_some(Self {
            opaque: stops.iter().all(|stop| stop.color.a >= 1.0),
            stops,
            spread,
        })
    }

    /// Its stops, in order.
    pub fn stops(&self) -> &[Stop] {
        &self.stops
    }

    /// What it shows beyond its ends.
    pub fn spread(&self) -> Spread {
        self.spread
    }

    /// Whether none of its colours lets anything shine through.
    pub fn is_opaque(&self) -> bool {
        self.opaque
    }

    /// The number of the first stop beyond `at`, `0.0..=1.0`: where several share an offset, the last of them rules from
    /// there on.
    fn next_stop(&self, at: f64) -> usize {
        self.stops.partition_point(|stop| f64::from(stop.offset) <= at)
    }

    /// The stretch around `at`, a place after spreading.
    pub fn stretch(&self, at: f64) -> Stretch {
        let next = self.next_stop(at);
        let offset = |stop: &Stop| f64::from(stop.offset);
        let (before, after) = (next.checked_sub(1).map(|last| &self.stops[last]), self.stops.get(next));
        let first = before.or(after).unwrap_or(&self.stops[0]);
        let from = levels(first.color);
        let slope = match (before, after) {
            (Some(before), Some(after)) => {
                let (to, length) = (levels(after.color), offset(after) - offset(before));
                [0, 1, 2, 3].map(|i| (to[i] - from[i]) / length)
            }
            _ => [0.0; 4],
        };
        Stretch {
            start: before.map_or(f64::NEG_INFINITY, offset),
            end: after.map_or(f64::INFINITY, offset),
            origin: offset(first),
            from,
            slope,
            opaque: self.opaque,
        }
    }

    /// What is mixed at `t`, any number.
    pub fn mix(&self, t: f64) -> Mix {
        let at = self.spread.folded(t);
        let stops = &self.stops;
        let next = self.next_stop(at);
        let single = |index: usize| Mix {
            at,
            stops: [index; 2],
            ends: [stops[index]; 2],
            weight: 0.0,
            color: stops[index].color,
        };
        if next == 0 {
            return single(0);
        }
        if next == stops.len() {
            return single(next - 1);
        }
        let (from, to) = (stops[next - 1], stops[next]);
        let [start, end] = [from.offset, to.offset].map(f64::from);
        let weight = (at - start) / (end - start);
        Mix {
            at,
            stops: [next - 1, next],
            ends: [from, to],
            weight,
            color: mixed(from.color, to.color, weight),
        }
    }
}

impl Spread {
    /// The name that it has in SVG.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pad => "pad",
            Self::Reflect => "reflect",
            Self::Repeat => "repeat",
        }
    }

    /// Where on the ramp `t` falls, `0.0..=1.0`.
    fn folded(self, t: f64) -> f64 {
        dispatch!(simd::level(), simd => <[f64; 8]>::from(self.fold(f64x8::splat(simd, t)))[0])
    }

    /// Where on the ramp eight places fall, `0.0..=1.0`.
    #[expect(
        clippy::inline_always,
        reason = "only what is inlined into a dispatched function is compiled for its vector instructions"
    )]
    #[inline(always)]
    pub fn fold<S: Simd>(self, places: f64x8<S>) -> f64x8<S> {
        let folded = match self {
            Self::Pad => places,
            Self::Repeat => places - places.floor(),
            Self::Reflect => {
                // `0.0..2.0`, and from its middle on backwards.
                let twice = places - (places * 0.5).floor() * 2.0;
                f64x8::splat(places.simd, 1.0) - (twice - 1.0).abs()
            }
        };
        let (zero, one) = (f64x8::splat(places.simd, 0.0), f64x8::splat(places.simd, 1.0));
        // In this order what is no number becomes 0.
        let positive = folded.simd_gt(zero).select(folded, zero);
        positive.simd_lt(one).select(positive, one)
    }
}

/// Straight red, green and blue in units of [`Premultiplied16`], and alpha, `0.0..=1.0`.
fn levels(color: Rgba) -> [f64; 4] {
    let [r, g, b] = [color.r, color.g, color.b].map(|channel| f64::from(channel) * ONE);
    [r, g, b, f64::from(color.a)]
}

#[expect(clippy::cast_possible_truncation, reason = "colours are 32-bit floats")]
fn mixed(from: Rgba, to: Rgba, weight: f64) -> Rgba {
    let channel = |a: f32, b: f32| (f64::from(a) + (f64::from(b) - f64::from(a)) * weight) as f32;
    Rgba {
        r: channel(from.r, to.r),
        g: channel(from.g, to.g),
        b: channel(from.b, to.b),
        a: channel(from.a, to.a),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: Rgba = Rgba::opaque(1.0, 0.0, 0.0);

    fn ramp(stops: &[(f32, Rgba)], spread: Spread) -> Ramp {
        let stops = stops.iter().map(|&(offset, color)| Stop { offset, color }).collect();
        Ramp::new(stops, spread).expect("some stops")
    }

    /// Premultiplied channels at a place that the stretch must hold, `0.0..=1.0`.
    fn levels_at(stretch: &Stretch, at: f64) -> [f64; 4] {
        dispatch!(simd::level(), simd => {
            let at = f64x8::splat(simd, at);
            assert!(stretch.holds(at).all_true(), "{stretch:?} holds {at:?}");
            stretch.levels(at).map(|levels| <[f64; 8]>::from(levels)[0] / ONE)
        })
    }

    impl Ramp {
        /// The colour at `t`; the stretch around it says the same.
        fn color(&self, t: f64) -> Rgba {
            let mix = self.mix(t);
            let stretch = self.stretch(mix.at);
            let [r, g, b, a] = levels_at(&stretch, mix.at);
            let alpha = f64::from(mix.color.a);
            let straight = [mix.color.r, mix.color.g, mix.color.b].map(f64::from);
            for (level, channel) in [r, g, b].into_iter().zip(straight) {
                assert!((level - channel * alpha).abs() < 1e-6, "{stretch:?} at {t}: {level}");
            }
            assert!((a - alpha).abs() < 1e-6, "{stretch:?} at {t}: {a}");
            mix.color
        }
    }

    #[test]
    fn between_two_stops_colours_are_mixed_as_stored() {
        let ramp = ramp(&[(0.0, Rgba::BLACK), (0.5, RED), (1.0, Rgba::WHITE)], Spread::Pad);
        assert_eq!(ramp.color(0.25), Rgba::opaque(0.5, 0.0, 0.0), "half way to the second");
        let mix = ramp.mix(0.625);
        assert_eq!((mix.stops, mix.weight), ([1, 2], 0.25));
        assert_eq!(mix.color, Rgba::opaque(1.0, 0.25, 0.25));
    }

    #[test]
    fn beyond_the_ends_the_spread_decides() {
        let stops = [(0.0, Rgba::BLACK), (1.0, Rgba::WHITE)];
        let gray = |value: f32| Rgba::opaque(value, value, value);
        for (spread, t, value) in [
            (Spread::Pad, -3.0, 0.0),
            (Spread::Pad, 3.5, 1.0),
            (Spread::Repeat, 1.25, 0.25),
            (Spread::Repeat, -0.25, 0.75),
            (Spread::Reflect, 1.25, 0.75),
            (Spread::Reflect, -0.25, 0.25),
            (Spread::Reflect, 2.25, 0.25),
            (Spread::Pad, f64::NAN, 0.0),
        ] {
            assert_eq!(ramp(&stops, spread).color(t), gray(value), "{spread:?} at {t}");
        }
    }

    #[test]
    fn colours_are_premultiplied_once_they_are_mixed() {
        let clear = Rgba::TRANSPARENT;
        let half_red = Rgba { a: 0.5, ..RED };
        let ramp = ramp(&[(0.25, clear), (0.75, half_red)], Spread::Pad);
        assert!(!ramp.is_opaque(), "neither stop is");
        for t in [0.0, 0.25, 0.4, 0.5, 0.74, 0.75, 1.0] {
            ramp.color(t);
        }
        let [red, _, _, alpha] = levels_at(&ramp.stretch(0.5), 0.5);
        assert!(
            (alpha - 0.25).abs() < 1e-9 && (red - 0.125).abs() < 1e-9,
            "{red} {alpha}"
        );
    }

    #[test]
    fn stops_at_one_place_make_a_hard_edge_and_offsets_never_fall() {
        let hard = ramp(&[(0.5, Rgba::BLACK), (0.5, Rgba::WHITE)], Spread::Pad);
        assert_eq!(hard.color(0.499), Rgba::BLACK, "before it");
        assert_eq!(hard.color(0.5), Rgba::WHITE, "from it on the last one rules");
        let falling = ramp(&[(0.8, Rgba::BLACK), (0.2, Rgba::WHITE)], Spread::Pad);
        assert_eq!(
            falling.stops()[1].offset.to_bits(),
            0.8_f32.to_bits(),
            "as if it were there"
        );
        assert_eq!(Ramp::new(Vec::new(), Spread::Pad), None, "nothing to show");
    }
}
