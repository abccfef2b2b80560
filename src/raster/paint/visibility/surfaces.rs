//! The colours that the samples of a tile may show, by number.
//!
//! Painting a translucent colour over a slot makes a new slot: once for all samples that show the old one.

use crate::color::{Premultiplied16, Resolver};
use crate::raster::list::chunk::{Paint, ScreenTriangle};
use crate::raster::paint::visibility::buffer::{MAX_SLOTS, Slot};
use crate::raster::paint::visibility::flat_resolve::Known;
use crate::rules::Rules;

/// What samples may show.
#[derive(Debug)]
pub(crate) struct Slots<'a> {
    rules: Rules,
    all: Vec<SlotColor<'a>>,
    /// The first ones once more.
    known: Known,
    /// For each slot what it became under the latest translucent paint, and which paint that was.
    painted: Vec<(u32, Slot)>,
    paint: u32,
    /// Whether anything is to be shaded.
    pub(crate) any_shaded: bool,
}

/// What the samples of one slot show.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SlotColor<'a> {
    /// The colour; over a shaded primitive, what translucent paints add to it.
    pub(crate) flat: Premultiplied16,
    /// The same, spread so that many can be added up.
    pub(crate) spread: Spread,
    /// The pixel that shows nothing but the flat colour.
    pub(crate) pixel: u32,
    /// The opaque primitive below.
    pub(crate) shaded: Option<Shaded<'a>>,
}

/// The sum of up to 65 536 colours, two channels of 32 bits in each number: red and green, blue and alpha.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Spread([u64; 2]);

/// A primitive that is to be shaded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shaded<'a> {
    pub(crate) triangle: &'a ScreenTriangle,
    pub(crate) paint: &'a Paint,
    /// How much of its colour shines through, of [`Premultiplied16::ONE`].
    pub(crate) kept: u16,
}

impl<'a> Slots<'a> {
    /// No slots.
    pub(crate) fn new(rules: Rules, resolver: Resolver) -> Self {
        Self {
            rules,
            all: Vec::new(),
            known: Known::new(resolver),
            painted: Vec::new(),
            paint: 0,
            any_shaded: false,
        }
    }

    /// Forgets all slots.
    pub(crate) fn clear(&mut self) {
        self.all.clear();
        self.known.clear();
        self.painted.clear();
        self.paint = 0;
        self.any_shaded = false;
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.all.len()
    }

    /// What a slot shows.
    #[inline]
    pub(crate) fn get(&self, slot: Slot) -> &SlotColor<'a> {
        &self.all[usize::from(slot)]
    }

    /// What is known of all slots; `None` where there are too many.
    #[inline]
    pub(crate) fn known(&self) -> Option<&Known> {
        self.known.is_all().then_some(&self.known)
    }

    /// Whether each slot in use may become another one, and one more may come, without running out of numbers.
    pub(crate) fn is_full(&self) -> bool {
        self.all.len() > MAX_SLOTS / 2 - 1
    }

    /// A slot for a flat colour; successive ones of the same colour share it.
    #[inline]
    pub(crate) fn flat(&mut self, color: Premultiplied16) -> Slot {
        let newest = self.all.last();
        if newest.is_none_or(|newest| newest.flat != color || newest.shaded.is_some()) {
            self.push(SlotColor {
                flat: color,
                spread: Spread::new(color),
                pixel: color.to_pixel(self.rules),
                shaded: None,
            });
        }
        self.newest()
    }

    /// A slot for an opaque primitive that is to be shaded.
    #[inline]
    pub(crate) fn shaded(&mut self, triangle: &'a ScreenTriangle, paint: &'a Paint) -> Slot {
        self.any_shaded = true;
        self.push(SlotColor {
            flat: Premultiplied16::TRANSPARENT,
            spread: Spread::default(),
            pixel: 0,
            shaded: Some(Shaded {
                triangle,
                paint,
                kept: Premultiplied16::ONE,
            }),
        });
        self.newest()
    }

    /// From here on [`Slots::under`] speaks of another paint.
    pub(crate) fn next_paint(&mut self) {
        self.paint += 1;
    }

    /// What samples of `slot` show under a translucent colour, which is the same for all calls between two of
    /// [`Slots::next_paint`].
    #[inline]
    pub(crate) fn under(&mut self, slot: Slot, color: Premultiplied16) -> Slot {
        if self.painted.len() < self.all.len() {
            self.painted.resize(self.all.len(), (0, 0));
        }
        let (paint, known) = self.painted[usize::from(slot)];
        if paint == self.paint {
            return known;
        }
        let mixed = self.mix(slot, color);
        self.painted[usize::from(slot)] = (self.paint, mixed);
        mixed
    }

    /// A new slot for a colour over what `below` shows.
    pub(crate) fn mix(&mut self, below: Slot, color: Premultiplied16) -> Slot {
        let mut mixed = *self.get(below);
        mixed.flat = color.over(mixed.flat, self.rules);
        mixed.spread = Spread::new(mixed.flat);
        match &mut mixed.shaded {
            None => mixed.pixel = mixed.flat.to_pixel(self.rules),
            Some(shaded) => {
                let rest = Premultiplied16::ONE - color.0[3];
                let [kept, ..] = Premultiplied16([shaded.kept; 4]).faded(rest).0;
                shaded.kept = kept;
            }
        }
        self.push(mixed);
        self.newest()
    }

    /// Keeps the slots for which `used` is set; the new number of each.
    pub(crate) fn keep(&mut self, used: &[bool]) -> Vec<Slot> {
        let mut numbers = vec![0; used.len()];
        let mut kept = 0;
        self.known.clear();
        for (old, number) in numbers.iter_mut().enumerate().filter(|(old, _)| used[*old]) {
            self.all[kept] = self.all[old];
            self.known.set(kept, &self.all[kept]);
            *number = Slot::try_from(kept).unwrap_or(0);
            kept += 1;
        }
        self.all.truncate(kept);
        self.painted.clear();
        numbers
    }

    #[inline]
    fn push(&mut self, slot: SlotColor<'a>) {
        self.known.set(self.all.len(), &slot);
        self.all.push(slot);
    }

    fn newest(&self) -> Slot {
        debug_assert!(self.all.len() <= MAX_SLOTS, "slots are made room for");
        Slot::try_from(self.all.len() - 1).unwrap_or(0)
    }
}

impl Spread {
    /// One colour.
    #[inline]
    fn new(color: Premultiplied16) -> Self {
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

impl SlotColor<'_> {
    /// `count` times the flat colour.
    #[inline]
    pub(crate) fn sum(&self, count: u32) -> [u32; 4] {
        let mut sum = Spread::default();
        sum.add(self.spread, count);
        sum.channels()
    }
}
