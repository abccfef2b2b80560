//! The colours that the samples of a tile may show, by number.
//!
//! Painting a translucent colour over a surface makes a new surface: once for all samples that show the old one.

use crate::color::{Premultiplied16, Resolver};
use crate::raster::layers::Compositing;
use crate::raster::paint::method::Rounding;
use crate::raster::paint::visibility::flat_resolve::FlatResolve;
use crate::raster::paint::visibility::paint_stack::{PaintStacks, Primitive, Translucent};
use crate::raster::paint::visibility::surface_color::{Shaded, Spread, SurfaceColor};
use crate::raster::surface_id::{MAX_SURFACES, SurfaceId};
use crate::rules::Rules;

/// What samples may show.
#[derive(Debug)]
pub(crate) struct SurfaceTable<'a> {
    rules: Rules,
    all: Vec<SurfaceColor<'a>>,
    /// The first ones once more.
    flat: FlatResolve,
    /// For each surface what it became under the latest translucent paint, and which paint that was.
    painted: Vec<(u32, SurfaceId)>,
    paint: u32,
    /// How many were mixed of others.
    pub(crate) mixed: usize,
    /// Whether anything is to be shaded.
    pub(crate) any_shaded: bool,
    /// Whether every sample is rounded for itself, and what lies over shaded primitives then.
    rounding: Rounding,
    pub(super) stacks: PaintStacks<'a>,
}

impl<'a> SurfaceTable<'a> {
    /// No surfaces.
    pub(crate) fn new(rules: Rules, resolver: Resolver) -> Self {
        Self {
            rules,
            all: Vec::new(),
            flat: FlatResolve::new(resolver),
            painted: Vec::new(),
            paint: 0,
            mixed: 0,
            any_shaded: false,
            rounding: Rounding::Sums,
            stacks: PaintStacks::default(),
        }
    }

    /// Forgets all surfaces, for a tile where this is rounded.
    pub(crate) fn clear(&mut self, rounding: Rounding) {
        self.all.clear();
        self.flat.clear();
        self.painted.clear();
        self.paint = 0;
        self.mixed = 0;
        self.any_shaded = false;
        self.rounding = rounding;
        self.stacks.clear();
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.all.len()
    }

    /// What a surface shows.
    #[inline]
    pub(crate) fn get(&self, surface: SurfaceId) -> &SurfaceColor<'a> {
        &self.all[usize::from(surface)]
    }

    /// The colours of all surfaces for the flat resolve; `None` where there are too many.
    #[inline]
    pub(crate) fn flat_resolve(&self) -> Option<&FlatResolve> {
        self.flat.is_all().then_some(&self.flat)
    }

    /// Whether each surface in use may become another one, and one more may come, without running out of numbers.
    pub(crate) fn is_full(&self) -> bool {
        self.all.len() > MAX_SURFACES / 2 - 1
    }

    /// Whether more lies on top of each other than there is room for: nothing may be painted then.
    pub(crate) fn has_too_many_paints(&self) -> bool {
        self.stacks.is_full()
    }

    /// A surface for a flat colour; successive ones of the same colour share it.
    #[inline]
    pub(crate) fn flat(&mut self, color: Premultiplied16) -> SurfaceId {
        let newest = self.all.last();
        if newest.is_none_or(|newest| newest.flat != color || newest.shaded.is_some()) {
            self.push(SurfaceColor::flat(color, self.rules));
        }
        self.newest()
    }

    /// A surface for an opaque primitive that is to be shaded.
    #[inline]
    pub(crate) fn shaded(&mut self, primitive: Primitive<'a>) -> SurfaceId {
        self.any_shaded = true;
        self.push(SurfaceColor {
            flat: Premultiplied16::TRANSPARENT,
            spread: Spread::default(),
            pixel: 0,
            shaded: Some(Shaded::new(primitive)),
        });
        self.newest()
    }

    /// Starts another translucent paint: see [`SurfaceTable::under`].
    pub(crate) fn next_paint(&mut self) {
        self.paint += 1;
    }

    /// What samples of `surface` show under a translucent paint, which is the same for all calls between two of
    /// [`SurfaceTable::next_paint`].
    #[inline]
    pub(crate) fn under(&mut self, surface: SurfaceId, above: Translucent<'a>) -> SurfaceId {
        if self.painted.len() < self.all.len() {
            self.painted.resize(self.all.len(), (0, 0));
        }
        let (paint, became) = self.painted[usize::from(surface)];
        if paint == self.paint {
            return became;
        }
        let mixed = self.mix(surface, above);
        self.painted[usize::from(surface)] = (self.paint, mixed);
        mixed
    }

    /// A new surface for a translucent paint over what `below` shows; one that is to be shaded only where every sample is rounded
    /// for itself.
    pub(crate) fn mix(&mut self, below: SurfaceId, above: Translucent<'a>) -> SurfaceId {
        self.mixed += 1;
        let mut mixed = *self.get(below);
        match (above, &mut mixed.shaded) {
            (above, Some(shaded)) if self.rounding == Rounding::Samples => {
                shaded.above = self.stacks.push(above, shaded.above);
            }
            (Translucent::Flat(color), shaded) => {
                mixed.flat = color.over(mixed.flat, self.rules);
                mixed.spread = Spread::new(mixed.flat);
                match shaded {
                    None => mixed.pixel = mixed.flat.to_pixel(self.rules),
                    Some(shaded) => {
                        let rest = Premultiplied16::ONE - color.0[3];
                        let [kept, ..] = Premultiplied16([shaded.kept; 4]).faded(rest).0;
                        shaded.kept = kept;
                    }
                }
            }
            (Translucent::Shaded(primitive), shaded) => {
                debug_assert_eq!(self.rounding, Rounding::Samples, "sums are of opaque primitives");
                self.any_shaded = true;
                *shaded = Some(Shaded::new(primitive));
            }
        }
        self.push(mixed);
        self.newest()
    }

    /// A new surface for a layer's sample, composited with what `below` shows. Tiles in which anything is to be shaded have no
    /// layers.
    pub(crate) fn composited(
        &mut self,
        below: SurfaceId,
        sample: Premultiplied16,
        compositing: Compositing,
    ) -> SurfaceId {
        self.mixed += 1;
        let below = self.get(below);
        debug_assert!(below.shaded.is_none(), "layers hold flat colours");
        self.push(SurfaceColor::flat(
            compositing.composited(sample, below.flat, self.rules),
            self.rules,
        ));
        self.newest()
    }

    /// Keeps the surfaces for which `used` is set; the new number of each.
    pub(crate) fn keep(&mut self, used: &[bool]) -> Vec<SurfaceId> {
        let mut numbers = vec![0; used.len()];
        let mut kept = 0;
        self.flat.clear();
        for (old, number) in numbers.iter_mut().enumerate().filter(|(old, _)| used[*old]) {
            self.all[kept] = self.all[old];
            self.flat.set(kept, &self.all[kept]);
            *number = SurfaceId::try_from(kept).unwrap_or(0);
            kept += 1;
        }
        self.all.truncate(kept);
        self.painted.clear();
        numbers
    }

    #[inline]
    fn push(&mut self, surface: SurfaceColor<'a>) {
        self.flat.set(self.all.len(), &surface);
        self.all.push(surface);
    }

    fn newest(&self) -> SurfaceId {
        debug_assert!(self.all.len() <= MAX_SURFACES, "surfaces are made room for");
        SurfaceId::try_from(self.all.len() - 1).unwrap_or(0)
    }
}
