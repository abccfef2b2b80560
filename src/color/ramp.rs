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

use super::Rgba;

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
        (!stops.is_empty()).then_some(Self { stops, spread })
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
        self.stops.iter().all(|stop| stop.color.a >= 1.0)
    }

    /// The colour at `t`, any number.
    #[inline]
    pub fn color(&self, t: f64) -> Rgba {
        self.mix(t).color
    }

    /// As [`Ramp::color`], with what is mixed there.
    pub fn mix(&self, t: f64) -> Mix {
        let at = self.spread.folded(t);
        let stops = &self.stops;
        // The first stop beyond `at`: where several share an offset, the last of them rules from there on.
        let next = stops.partition_point(|stop| f64::from(stop.offset) <= at);
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
    #[inline]
    fn folded(self, t: f64) -> f64 {
        let folded = match self {
            Self::Pad => t,
            Self::Repeat => t - t.floor(),
            Self::Reflect => 1.0 - (t.rem_euclid(2.0) - 1.0).abs(),
        };
        // In this order what is no number becomes 0.
        if folded > 0.0 { folded.min(1.0) } else { 0.0 }
    }
}

#[inline]
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
