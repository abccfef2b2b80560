//! Pixels of linear gradients, from the places of all their samples: along a stretch of the ramp colours lie in planes.
//!
//! ```text
//!     stop 0          stop 1         stop 2
//!   =====+--------------+--------------+=====> place on the ramp
//!          [pixel]           [pixel]           each has all of its samples on one stretch
//!                   [pixel]                    this one is shaded sample by sample
//! ```

use std::ops::Range;

use crate::color::{Ramp, SampleMean, Spread, SumBounds};
use crate::raster::attributes::Planes;
use crate::raster::shading::context::{BoundedPixels, Pixels, PlacedParts, PlacedPixels};
use crate::raster::shading::kernel::first_sample;
use crate::raster::shading::kind::Shade;
use crate::raster::shading::plane_means::PlaneColors;
use crate::texture::SampleGrid;

/// Planes steeper or higher than this have few digits left.
const LARGEST: f64 = 1e9;
/// How far rounding may move a place on the ramp, as a part of it.
const ROUNDED: f64 = 1e-9;

/// A linear gradient with an opaque ramp; the place on it is an affine function of a point of the frame's lattice.
#[derive(Clone, Copy)]
pub(super) struct LineColors<'a> {
    pub(super) ramp: &'a Ramp,
    /// The change of the place along `x` and along `y`, and the place at the origin.
    pub(super) place: [f64; 3],
    /// What gives single samples their colours.
    pub(super) shade: &'a dyn Shade,
}

/// Where colours lie in planes.
struct Piece {
    /// Between these places, before spreading.
    range: [f64; 2],
    planes: Planes<3>,
}

impl LineColors<'_> {
    /// All of the pixels.
    pub(super) fn means(self, pixels: PlacedPixels<'_>, mean: &SampleMean, values: &mut [u32]) {
        self.each_piece(pixels.pixels, 0, |range, planes| {
            let colors = PlaneColors {
                planes: planes.unwrap_or(&NOWHERE),
                shade: self.shade,
            };
            colors.means(pixels.part(range.clone()), mean, &mut values[range]);
        });
    }

    /// As [`PlaneColors::bounded`], of all stretches.
    pub(super) fn bounded(
        self,
        pixels: BoundedPixels<'_>,
        mean: &SampleMean,
        values: &mut [u32],
        open: &mut Vec<usize>,
    ) -> bool {
        let mut of_part = Vec::new();
        self.each_piece(pixels.pixels, pixels.margin, |range, planes| {
            of_part.clear();
            let part = BoundedPixels {
                pixels: pixels.pixels.part(range.clone()),
                ..pixels
            };
            let shade = self.shade;
            let is_known = planes.is_some_and(|planes| {
                PlaneColors { planes, shade }.bounded(part, mean, &mut values[range.clone()], &mut of_part)
            });
            if is_known {
                open.extend(of_part.iter().map(|i| range.start + i));
            } else {
                open.extend(range);
            }
        });
        true
    }

    /// As [`PlaneColors::part_bounds`], of all stretches.
    pub(super) fn part_bounds(self, parts: PlacedParts<'_>, mean: &SampleMean, bounds: &mut [SumBounds]) {
        let shade = self.shade;
        self.each_piece(parts.pixels, 0, |range, planes| {
            let planes = planes.unwrap_or(&NOWHERE);
            PlaneColors { planes, shade }.part_bounds(parts.part(range.clone()), mean, &mut bounds[range]);
        });
    }

    /// Calls `done` with pixels that follow each other in the list and all of whose samples lie on one piece, and those of as many
    /// pixels around as `margin` says, and with its planes; with none where a pixel lies on several.
    fn each_piece(self, pixels: Pixels<'_>, margin: u32, mut done: impl FnMut(Range<usize>, Option<&Planes<3>>)) {
        let SampleGrid { side, .. } = pixels.grid;
        let [right, down, start] = self.place;
        let (first, middle) = (first_sample(pixels.grid), f64::from(side - 1) / 2.0);
        let reach = (right.abs() + down.abs()) * (middle + f64::from(margin * side));
        let (mut current, mut from): (Option<Piece>, usize) = (None, 0);
        for (i, place) in pixels.places.iter().enumerate() {
            let at = |axis: usize| first[axis] + f64::from(u32::from(place[axis]) * side) + middle;
            let center = at(0) * right + at(1) * down + start;
            let off = reach + (center.abs() + 1.0) * ROUNDED;
            let (least, most) = (center - off, center + off);
            if current
                .as_ref()
                .is_some_and(|piece| piece.range[0] <= least && most < piece.range[1])
            {
                continue;
            }
            if i > from {
                done(from..i, current.as_ref().map(|piece| &piece.planes));
            }
            from = i;
            current = self.piece(least, most);
            if current.is_none() {
                done(i..i + 1, None);
                from = i + 1;
            }
        }
        if pixels.places.len() > from {
            done(from..pixels.places.len(), current.as_ref().map(|piece| &piece.planes));
        }
    }

    /// The piece that all places from `least` to `most` lie on.
    fn piece(&self, least: f64, most: f64) -> Option<Piece> {
        let piece = match self.ramp.spread() {
            Spread::Pad if most <= 0.0 => self.even(0.0, [f64::NEG_INFINITY, 0.0]),
            Spread::Pad if least >= 1.0 => self.even(1.0, [1.0, f64::INFINITY]),
            Spread::Pad if least >= 0.0 => self.sloped(least, [1.0, 0.0]),
            Spread::Pad => return None,
            Spread::Repeat => self.sloped(least, [1.0, -least.floor()]),
            Spread::Reflect => {
                let period = least.floor();
                let is_backwards = (period / 2.0).fract().abs() > 0.25;
                self.sloped(
                    least,
                    if is_backwards {
                        [-1.0, period + 1.0]
                    } else {
                        [1.0, -period]
                    },
                )
            }
        };
        let [from, to] = piece.range;
        let is_flat_enough = |values: &[f64; 3]| values.iter().all(|value| value.abs() < LARGEST);
        let Planes { at_pivot, dx, dy, .. } = &piece.planes;
        let is_known = from <= least && most < to && [at_pivot, dx, dy].into_iter().all(is_flat_enough);
        is_known.then_some(piece)
    }

    /// One colour, that of a place on the ramp.
    fn even(&self, at: f64, range: [f64; 2]) -> Piece {
        let [at_zero, slope] = self.ramp.stretch(at).line();
        Piece {
            range,
            planes: Planes {
                at_pivot: [0, 1, 2].map(|k| at_zero[k] + slope[k] * at),
                ..NOWHERE
            },
        }
    }

    /// The stretch that the place `t` lies on, where this is `turn * t + shift` on the ramp.
    fn sloped(&self, t: f64, [turn, shift]: [f64; 2]) -> Piece {
        let stretch = self.ramp.stretch(turn * t + shift);
        // Beyond its ends the ramp goes on otherwise.
        let ends = stretch.range().map(|end| (end.clamp(0.0, 1.0) - shift) * turn);
        let [at_zero, slope] = stretch.line();
        let [right, down, start] = self.place;
        Piece {
            range: if turn < 0.0 { [ends[1], ends[0]] } else { ends },
            planes: Planes {
                at_pivot: [0, 1, 2].map(|k| at_zero[k] + slope[k] * (turn * start + shift)),
                dx: slope.map(|slope| slope * turn * right),
                dy: slope.map(|slope| slope * turn * down),
                ..NOWHERE
            },
        }
    }
}

/// What no value is certain of: each sample is shaded for itself.
const NOWHERE: Planes<3> = Planes {
    pivot: [0.0; 2],
    at_pivot: [f64::NAN; 3],
    dx: [0.0; 3],
    dy: [0.0; 3],
};

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};
    use glam::{DAffine2, DVec2};

    use super::super::gradient::GradientShader;
    use super::*;
    use crate::color::{Premultiplied16, ResolveSpace, Rgba, Stop};
    use crate::geometry::GradientShape;
    use crate::raster::sampling::positions::{SamplePositions, lattice};
    use crate::raster::shading::sources::PlacedGradient;
    use crate::raster::{SamplePattern, SampleRate, Seed};
    use crate::rules::Rules;

    fn ramp(u: &mut Unstructured<'_>) -> Result<Ramp> {
        let stops = (0..u.int_in_range(1..=5)?)
            .map(|_| {
                let offset = f32::from(u.int_in_range(0..=8_u8)?) / 8.0;
                let [r, g, b] = u.arbitrary()?;
                let color = Rgba::from_bytes([r, g, b, 255]);
                Ok(Stop { offset, color })
            })
            .collect::<Result<_>>()?;
        let spread = *u.choose(&[Spread::Pad, Spread::Reflect, Spread::Repeat])?;
        Ok(Ramp::new(stops, spread).expect("a stop"))
    }

    /// The pixels, sample by sample.
    fn one_by_one(shader: &GradientShader<'_>, placed: PlacedPixels<'_>, mean: &SampleMean) -> Vec<u32> {
        let Pixels { grid, places } = placed.pixels;
        let side = u16::try_from(grid.side).expect("at most 256");
        let pixel = |(i, place): (usize, &[u16; 2])| {
            let inside = placed.inside(i).iter();
            let points: Vec<[u16; 2]> = inside
                .map(|inside| [0, 1].map(|axis| place[axis] * side + u16::from(inside[axis])))
                .collect();
            let mut colors = vec![Premultiplied16::TRANSPARENT; points.len()];
            shader.points(grid, &points, &mut colors);
            mean.pixel(&colors)
        };
        places.iter().enumerate().map(pixel).collect()
    }

    #[test]
    fn pixels_are_those_of_their_samples_one_by_one() {
        let (mut open_met, mut all) = (0, 0);
        arbtest::arbtest(|u| {
            let ramp = ramp(u)?;
            let mut at = || -> Result<f64> { Ok(f64::from(u.int_in_range(-400..=400)?) / 4.0) };
            let geometry = GradientShape::Linear {
                from: DVec2::new(at()?, at()?),
                to: DVec2::new(at()?, at()?),
            };
            let gradient = PlacedGradient {
                geometry,
                ramp: &ramp,
                from_pixels: DAffine2::IDENTITY,
            };
            let pattern = *u.choose(&SamplePattern::ALL)?;
            let rate = SampleRate::new(*u.choose(&[4, 16, 64])?).expect("a rate");
            let positions = SamplePositions::new(pattern, rate, Seed::default());
            let side = lattice(pattern, rate).side();
            let shader = GradientShader::new(&gradient, side, Rules::Standard);
            let grid = SampleGrid {
                side: side.cast_unsigned(),
                origin: [u.int_in_range(-40..=40)?, u.int_in_range(-40..=40)?],
            };
            let places: Vec<[u16; 2]> = (0..40).map(|i| [i * 2 % 37, i / 10]).collect();
            let pixels = Pixels { grid, places: &places };
            let same = positions.are_same();
            let mut inside = Vec::new();
            for place in &places[..if same { 1 } else { places.len() }] {
                let pixel = [0, 1].map(|i| grid.origin[i] + i32::from(place[i]));
                inside.extend_from_slice(positions.of_pixel(pixel, &mut Vec::new()));
            }
            let placed = PlacedPixels {
                pixels,
                count: positions.count(),
                inside: &inside,
                tints: &[],
            };
            let colors = shader.line_colors().expect("a line");
            for space in ResolveSpace::ALL {
                let mean = SampleMean::new(space, rate.samples(), Rules::Standard);
                let expected = one_by_one(&shader, placed, &mean);
                let mut found = vec![0; places.len()];
                colors.means(placed, &mean, &mut found);
                assert_eq!(found, expected, "{pattern:?}, {rate:?}, {space:?}: {gradient:?}");
                let bounded = BoundedPixels::new(pixels, positions.mean_range(), &[]);
                let (mut found, mut open) = (vec![0; places.len()], Vec::new());
                if same || !colors.bounded(bounded, &mean, &mut found, &mut open) {
                    continue;
                }
                all += found.len();
                open_met += open.len();
                for i in (0..places.len()).filter(|i| !open.contains(i)) {
                    assert_eq!(found[i], expected[i], "{pattern:?}, {rate:?}, {space:?}: {gradient:?}");
                }
            }
            Ok(())
        })
        .budget_ms(1500);
        assert!(
            all > 200 && open_met < all && open_met > 0,
            "{open_met} of {all} are open"
        );
    }
}
