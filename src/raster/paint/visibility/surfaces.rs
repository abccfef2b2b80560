//! The colours that the samples of a tile may show, by number.
//!
//! Painting a translucent colour over a slot makes a new slot: once for all samples that show the old one.

use crate::color::{Premultiplied16, Resolver};
use crate::raster::list::chunk::{Paint, ScreenTriangle};
use crate::raster::paint::visibility::flat_resolve::Known;
use crate::raster::paint::visibility::surface_color::{Shaded, SlotColor, Spread};
use crate::raster::surface_id::{MAX_SLOTS, Slot};
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
