//! Radical inverses: the sequence of Halton ("On the efficiency of certain quasi-random sequences of points", Numerische
//! Mathematik 2, 1960), and the set of Hammersley ("Monte Carlo methods for solving multivariable problems", Annals of the New
//! York Academy of Sciences 86, 1960), which needs to know how many points there are.

use std::sync::Arc;

use super::arrange::{Arrange, Fixed, Place};
use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::sampling::rate::SampleRate;

/// In bases 2 and 3, from number 1 on.
pub(super) struct Halton;

/// Evenly from left to right, and the radical inverse in base 2, from number 1 on, from top to bottom.
pub(super) struct Hammersley;

impl Arrange for Halton {
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place> {
        Fixed::by(rate, |i| [radical_inverse(i + 1, 2), radical_inverse(i + 1, 3)])
    }
}

impl Arrange for Hammersley {
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place> {
        let count = rate.samples();
        let column = |i: u32| (2 * i + 1) * SubpixelGrid::FINE_SIDE / (2 * count);
        Fixed::by(rate, |i| [column(i), radical_inverse(i + 1, 2)])
    }
}

/// The digits of a number mirrored at the point, in points of the lattice.
fn radical_inverse(mut number: u32, base: u32) -> u32 {
    let (mut digits, mut one) = (0, 1);
    while number > 0 {
        digits = digits * base + number % base;
        one *= base;
        number /= base;
    }
    digits * SubpixelGrid::FINE_SIDE / one
}
