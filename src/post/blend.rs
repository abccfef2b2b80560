//! Pixels and their neighbours by weight.

use super::areas::ONE;
use super::weights::Weights;
use crate::color::{Premultiplied16, ResolveSpace, Rgba, WeightedSum};
use crate::rules::Rules;

/// In which values pixels are blended, and how these become bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Values {
    /// As the samples of the picture are averaged.
    pub space: ResolveSpace,
    /// As its means are rounded.
    pub rules: Rules,
}

/// The weights around a pixel, in parts of [`ONE`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Around {
    pub(super) left: u16,
    pub(super) right: u16,
    pub(super) above: u16,
    pub(super) below: u16,
}

/// What of two opposite neighbours is blended in, the left or upper one first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Blend {
    /// Whether they stand in the pixel's row.
    pub(super) is_across: bool,
    pub(super) weights: [u16; 2],
}

impl Around {
    /// From the weights at the edges of a pixel, of the one on its right and of the one below.
    #[inline]
    pub(super) fn new(own: Weights, right: Weights, below: Weights) -> Self {
        Self {
            left: own.left[0],
            right: right.left[1],
            above: own.top[0],
            below: below.top[1],
        }
    }

    /// Only neighbours along one axis are blended in: those of the greatest weight.
    #[inline]
    pub(super) fn blend(self) -> Option<Blend> {
        let is_across = self.left.max(self.right) > self.above.max(self.below);
        let weights = if is_across {
            [self.left, self.right]
        } else {
            [self.above, self.below]
        };
        (weights != [0; 2]).then_some(Blend { is_across, weights })
    }
}

impl Blend {
    /// What the pixel itself and the two neighbours weigh: where both are blended in, each counts by its weight.
    pub(super) fn shares(self) -> [i64; 3] {
        let one = i64::from(ONE);
        let [first, second] = self.weights.map(i64::from);
        [
            first * (one - first) + second * (one - second),
            first * first,
            second * second,
        ]
    }

    /// The weight of the only neighbour that is blended in, and that pixel, if it is but one: with weight `w`, the shares
    /// `w (1 - w)` and `w w` are to each other as `1 - w` and `w`, whose sum needs no division.
    fn only(self, neighbours: [u32; 2]) -> Option<(u16, u32)> {
        match self.weights {
            [first, 0] => Some((first, neighbours[0])),
            [0, second] => Some((second, neighbours[1])),
            _ => None,
        }
    }

    /// The pixel `0xAARRGGBB` that becomes of one and its neighbours.
    pub(super) fn pixel(self, own: u32, neighbours: [u32; 2], values: Values) -> u32 {
        let is_opaque = (own & neighbours[0] & neighbours[1]) >> 24 == 255;
        if let Some((weight, neighbour)) = self.only(neighbours)
            && is_opaque
            && values.rules != Rules::Course
        {
            return values.space.opaque_mean([own, neighbour], weight);
        }
        let mut sum = WeightedSum::default();
        for (weight, pixel) in self.shares().into_iter().zip([own, neighbours[0], neighbours[1]]) {
            let [a, r, g, b] = pixel.to_be_bytes();
            let color = match a {
                255 => Premultiplied16::from_bytes([r, g, b, a]),
                _ => Premultiplied16::from_straight(Rgba::from_bytes([r, g, b, a]), Rules::Standard),
            };
            sum.add(weight, values.space.parts(color));
        }
        values.space.weighted_pixel(sum, values.rules)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_single_neighbour_is_blended_in_as_all_are() {
        let cases = ResolveSpace::ALL.map(|space| Values {
            space,
            rules: Rules::Standard,
        });
        for (weight, values) in (1..=ONE)
            .step_by(61)
            .flat_map(|weight| cases.map(|values| (weight, values)))
        {
            for level in (0..=255).step_by(5) {
                let (own, other) = (0xFF00_8040, 0xFFFF_0000 | level << 8 | (255 - level));
                let blend = Blend {
                    is_across: true,
                    weights: [weight, 0],
                };
                let mut sum = WeightedSum::default();
                for (share, pixel) in blend.shares().into_iter().zip([own, other]) {
                    let [a, r, g, b] = u32::to_be_bytes(pixel);
                    sum.add(share, values.space.parts(Premultiplied16::from_bytes([r, g, b, a])));
                }
                let expected = values.space.weighted_pixel(sum, values.rules);
                assert_eq!(
                    blend.pixel(own, [other, own], values),
                    expected,
                    "{weight}, {level}, {values:?}"
                );
            }
        }
    }
}
