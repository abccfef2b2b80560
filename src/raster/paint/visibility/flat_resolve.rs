//! What is needed of surfaces again and again when pixels that show nothing but flat colours are resolved, side by side.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i16x8, i32x4, u32x4, u64x2};

use crate::color::Resolver;
use crate::raster::paint::visibility::packed::lanes;
use crate::raster::paint::visibility::surface_color::SurfaceColor;
use crate::raster::surface_id::{ROW, SurfaceId};

/// How many surfaces have a place here: a power of two.
const FIRST: usize = 1024;

/// What is taken from channels so that they are signed numbers of 16 bits.
const MIDDLE: u16 = 1 << 15;

/// Most samples of a pixel whose mean a [`Mixer`] takes.
const MOST: u32 = 64;

/// The colours of the first surfaces of a tile, side by side, so that pixels of nothing but flat colours are resolved at
/// once.
#[derive(Debug)]
pub(crate) struct FlatResolve {
    resolver: Resolver,
    /// How many surfaces there are.
    count: usize,
    /// Whether all are opaque.
    opaque: bool,
    pixels: Box<[u32; FIRST]>,
    /// Blue, green, red and alpha of colours from the lowest bits on, each less [`MIDDLE`].
    colors: Box<[u64; FIRST]>,
}

/// Takes the means of two opaque colours.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mixer<'k, S: Simd> {
    simd: S,
    colors: &'k [u64; FIRST],
    count: u32,
    /// What rounds a sum, and makes up for [`MIDDLE`].
    offset: i32x4<S>,
    shift: u32,
}

impl FlatResolve {
    /// No surfaces.
    pub(crate) fn new(resolver: Resolver) -> Self {
        Self {
            resolver,
            count: 0,
            opaque: true,
            pixels: Box::new([0; FIRST]),
            colors: Box::new([0; FIRST]),
        }
    }

    /// Forgets all surfaces.
    pub(crate) fn clear(&mut self) {
        self.count = 0;
        self.opaque = true;
    }

    /// Whether all surfaces have a place here.
    #[inline]
    pub(crate) fn is_all(&self) -> bool {
        self.count <= FIRST
    }

    /// Surface `number`, which comes after all others, shows `surface`.
    #[inline]
    pub(crate) fn set(&mut self, number: usize, surface: &SurfaceColor<'_>) {
        self.count = number + 1;
        self.opaque &= surface.flat.is_opaque();
        self.pixels[number % FIRST] = surface.pixel;
        let [r, g, b, a] = surface.flat.0.map(|channel| u64::from(channel ^ MIDDLE));
        self.colors[number % FIRST] = b | g << 16 | r << 32 | a << 48;
    }

    /// The pixel that shows nothing but the flat colour of a surface; any for a number that is none.
    #[inline]
    fn pixel(&self, surface: SurfaceId) -> u32 {
        self.pixels[usize::from(surface) % FIRST]
    }

    /// The pixels of a row that show nothing but the flat colours of surfaces; any for numbers that are none.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub(crate) fn row(&self, shown: &[SurfaceId; ROW], pixels: &mut [u32]) {
        let first = shown[0];
        // Most rows of most pictures show one surface. Counting all of them is a few vector instructions.
        if shown.iter().filter(|surface| **surface != first).count() == 0 {
            return pixels.fill(self.pixel(first));
        }
        for (pixel, surface) in pixels.iter_mut().zip(shown) {
            *pixel = self.pixel(*surface);
        }
    }

    /// What mixes two of these; `None` where one of them is not opaque, or means are no shifts.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub(crate) fn mixer<S: Simd>(&self, simd: S) -> Option<Mixer<'_, S>> {
        let (count, shift) = (self.resolver.count(), self.resolver.shift()?);
        let offset = self.resolver.half() + u32::from(MIDDLE) * count;
        (self.opaque && count <= MOST).then_some(Mixer {
            simd,
            colors: &self.colors,
            count,
            offset: i32x4::splat(simd, offset.cast_signed()),
            shift,
        })
    }
}

impl<S: Simd> Mixer<'_, S> {
    /// The pixel of which all samples show `first` but `of_second`, which show `second`.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub(crate) fn pixel(&self, first: SurfaceId, second: SurfaceId, of_second: u32) -> u32 {
        self.mean(self.weighed(first, second, self.count - of_second, of_second))
    }

    /// The pixel whose samples show these surfaces, four in a word.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    pub(crate) fn pixel_of_packed(&self, words: &[u64]) -> u32 {
        let zero = i32x4::splat(self.simd, 0);
        let sums = words.iter().fold(zero, |sums, word| {
            let [a, b, c, d] = lanes(*word);
            sums + self.weighed(a, b, 1, 1) + self.weighed(c, d, 1, 1)
        });
        self.mean(sums)
    }

    /// Two colours, each so many times.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn weighed(&self, first: SurfaceId, second: SurfaceId, of_first: u32, of_second: u32) -> i32x4<S> {
        let color = |surface: SurfaceId| -> i16x8<S> {
            let color = self.colors[usize::from(surface) % FIRST];
            u64x2::splat(self.simd, color).bitcast()
        };
        let weights: i16x8<S> = u32x4::splat(self.simd, of_second << 16 | of_first).bitcast();
        color(first).zip_low(color(second)).pairwise_dot_product(weights)
    }

    /// The pixel for the sum of all samples.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "vector instructions reach inlined code only")]
    fn mean(&self, sums: i32x4<S>) -> u32 {
        // No sum exceeds that of opaque white, so that no mean exceeds 255.
        let sums = sums + self.offset;
        let means = (sums.bitcast::<u32x4<S>>() >> self.shift).bitcast::<i32x4<S>>();
        let halves = means.saturating_narrow(means);
        let bytes: u32x4<S> = halves.narrow(halves).bitcast();
        bytes.to_array()[0]
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::{Result, Unstructured};
    use fearless_simd::dispatch;

    use super::*;
    use crate::color::Premultiplied16;
    use crate::raster::paint::visibility::surface_color::Spread;
    use crate::raster::paint::visibility::surfaces::SurfaceTable;
    use crate::raster::surface_id::TWO_SURFACES;
    use crate::rules::Rules;
    use crate::simd;

    fn color(u: &mut Unstructured<'_>, opaque: bool) -> Result<Premultiplied16> {
        let mut channel = || u.int_in_range(0..=Premultiplied16::ONE);
        let alpha = if opaque { Premultiplied16::ONE } else { channel()? };
        let mut below = || Ok(channel()?.min(alpha));
        Ok(Premultiplied16([below()?, below()?, below()?, alpha]))
    }

    #[test]
    fn means_of_opaque_colours_are_those_of_sums_on_every_level() {
        arbtest::arbtest(|u| {
            let rules = *u.choose(&Rules::ALL)?;
            let side: u32 = u.int_in_range(1..=9)?;
            let count = side * side;
            let resolver = Resolver::new(count, rules);
            let mut surfaces = SurfaceTable::new(rules, resolver);
            let opaque = u.ratio(7, 8)?;
            let numbers = [surfaces.flat(color(u, true)?), surfaces.flat(color(u, opaque)?)];
            let of_second = u.int_in_range(0..=count)?;
            let [first, second] = numbers.map(|surface| *surfaces.get(surface));
            let mut sum = Spread::default();
            sum.add(first.spread, count - of_second);
            sum.add(second.spread, of_second);
            assert_eq!(
                first.spread.mixed(count, second.spread, of_second),
                sum.halves(),
                "as a difference"
            );
            let words: Vec<u64> = (0..count / 4)
                .map(|_| u.arbitrary::<u64>().map(|bits| bits & 0x0001_0001_0001_0001))
                .collect::<Result<_>>()?;
            let mut of_words = Spread::default();
            for surface in words.iter().flat_map(|word| lanes(*word)) {
                of_words.add_one(surfaces.get(numbers[usize::from(surface) % 2]).spread);
            }
            let flat = surfaces.flat_resolve().expect("two surfaces");
            // Equal colours share a surface.
            let two = numbers[0] != numbers[1];
            for (name, level) in simd::tested() {
                let expected = (second.flat.is_opaque() && [1, 4, 16, 64].contains(&count))
                    .then(|| resolver.pixel(sum.channels()));
                let [first, second] = numbers;
                let found =
                    dispatch!(level, simd => flat.mixer(simd).map(|mixer| mixer.pixel(first, second, of_second)));
                assert_eq!(found, expected, "{name}: {of_second} of {count}");
                if expected.is_some() && count >= 4 && two {
                    let expected = resolver.pixel(of_words.channels());
                    let found = dispatch!(level, simd => flat.mixer(simd).map(|mixer| mixer.pixel_of_packed(&words)));
                    assert_eq!(found, Some(expected), "{name}: {words:x?}");
                }
            }
            Ok(())
        })
        .budget_ms(500);
    }

    #[test]
    fn rows_show_the_pixels_of_their_surfaces() {
        arbtest::arbtest(|u| {
            let resolver = Resolver::new(16, Rules::Standard);
            let mut surfaces = SurfaceTable::new(Rules::Standard, resolver);
            let most = *u.choose(&[1, 3, 16, 17, 32, 33, 300])?;
            for i in 0..most {
                // All different.
                let [_, g, b, _] = color(u, true)?.0;
                surfaces.flat(Premultiplied16([i, g, b, Premultiplied16::ONE]));
            }
            let mut shown = [0; ROW];
            let few = u.ratio(1, 4)?;
            for surface in &mut shown {
                *surface = if few { 0 } else { u.int_in_range(0..=most - 1)? };
                if u.ratio(1, 8)? {
                    *surface = *u.choose(&[TWO_SURFACES, SurfaceId::MAX])?;
                }
            }
            let flat = surfaces.flat_resolve().expect("few surfaces");
            let mut pixels = vec![0; u.int_in_range(1..=ROW)?];
            flat.row(&shown, &mut pixels);
            for (x, (pixel, surface)) in pixels.iter().zip(shown).enumerate() {
                assert!(
                    surface >= TWO_SURFACES || *pixel == surfaces.get(surface).pixel,
                    "pixel {x} of {shown:?}"
                );
            }
            Ok(())
        })
        .budget_ms(500);
    }
}
