//! What the samples of one surface show, and sums of such colours.

use crate::color::Premultiplied16;
use crate::raster::paint::visibility::paint_stack::{Primitive, StackedPaint};
use crate::rules::Rules;

/// What the samples of one surface show.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceColor<'a> {
    /// The colour. Of a shaded primitive what translucent paints add to it, or, where every sample is rounded for itself, what lies
    /// below it.
    pub(crate) flat: Premultiplied16,
    /// The same, spread so that many can be added up.
    pub(crate) spread: Spread,
    /// The pixel that shows nothing but the flat colour.
    pub(crate) pixel: u32,
    /// The lowest primitive that is to be shaded.
    pub(crate) shaded: Option<Shaded<'a>>,
}

/// The sum of up to 65 536 colours, two channels of 32 bits in each number: red and green, blue and alpha.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Spread([u64; 2]);

/// A primitive that is to be shaded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shaded<'a> {
    pub(crate) primitive: Primitive<'a>,
    /// How much of its colour shines through, of [`Premultiplied16::ONE`]; where every sample is rounded for itself, `above` tells.
    pub(crate) kept: u16,
    /// The topmost of the translucent paints over it, where every sample is rounded for itself.
    pub(crate) above: Option<StackedPaint>,
}

impl<'a> Shaded<'a> {
    /// One with nothing over it.
    #[inline]
    pub(crate) fn new(primitive: Primitive<'a>) -> Self {
        Self {
            primitive,
            kept: Premultiplied16::ONE,
            above: None,
        }
    }
}

impl Spread {
    /// One colour.
    #[inline]
    pub(in crate::raster) fn new(color: Premultiplied16) -> Self {
        let [r, g, b, a] = color.0.map(u64::from);
        Self([r | g << 32, b | a << 32])
    }

    /// Adds a colour `times`.
    #[inline]
    pub(crate) fn add(&mut self, color: Self, times: u32) {
        // Sums of a pixel's samples fit 32 bits, so that nothing carries over.
        self.0[0] += color.0[0] * u64::from(times);
        self.0[1] += color.0[1] * u64::from(times);
    }

    /// Adds a colour once.
    #[inline]
    pub(crate) fn add_one(&mut self, color: Self) {
        self.0[0] += color.0[0];
        self.0[1] += color.0[1];
    }

    /// [`Spread::halves`] of the sum of `count` colours of which `of_other` are the other one.
    #[inline]
    pub(crate) fn mixed(self, count: u32, other: Self, of_other: u32) -> [u64; 2] {
        // Modulo 2^64, in which the sum fits.
        [0, 1].map(|i| {
            let change = other.0[i].wrapping_sub(self.0[i]);
            (self.0[i].wrapping_mul(u64::from(count))).wrapping_add(change.wrapping_mul(u64::from(of_other)))
        })
    }

    /// Red and green, blue and alpha; the former in the lower 32 bits of each.
    #[inline]
    pub(crate) fn halves(self) -> [u64; 2] {
        self.0
    }

    /// Red, green, blue, alpha.
    #[inline]
    pub(crate) fn channels(self) -> [u32; 4] {
        let low = |word: u64| word.to_le_bytes();
        let ([a, b, c, d, e, f, g, h], [i, j, k, l, m, n, o, p]) = (low(self.0[0]), low(self.0[1]));
        [[a, b, c, d], [e, f, g, h], [i, j, k, l], [m, n, o, p]].map(u32::from_le_bytes)
    }
}

impl SurfaceColor<'_> {
    /// A flat colour.
    #[inline]
    pub(crate) fn flat(color: Premultiplied16, rules: Rules) -> Self {
        Self {
            flat: color,
            spread: Spread::new(color),
            pixel: color.to_pixel(rules),
            shaded: None,
        }
    }

    /// `count` times the flat colour.
    #[inline]
    pub(crate) fn sum(&self, count: u32) -> [u32; 4] {
        let mut sum = Spread::default();
        sum.add(self.spread, count);
        sum.channels()
    }

    /// [`SurfaceColor::over_shaded`] of each of these sums, which it becomes.
    pub(crate) fn over_each_shaded(&self, sums: &mut [[u32; 4]], kept: u16, count: u32) {
        if kept != Premultiplied16::ONE {
            for sum in sums {
                *sum = self.over_shaded(*sum, kept, count);
            }
        }
    }

    /// What `count` samples show of which the primitive below has the sum `shaded`.
    #[inline]
    pub(in crate::raster) fn over_shaded(&self, shaded: [u32; 4], kept: u16, count: u32) -> [u32; 4] {
        const ONE: u64 = Premultiplied16::ONE as u64;
        if kept == Premultiplied16::ONE {
            return shaded;
        }
        let mut sums = self.sum(count);
        for (sum, channel) in sums.iter_mut().zip(shaded) {
            let part = (u64::from(channel) * u64::from(kept) + ONE / 2) / ONE;
            *sum += u32::try_from(part).unwrap_or(u32::MAX);
        }
        // What is left after rounding twice: opaque below stays opaque.
        sums[3] = shaded[3];
        sums
    }
}
