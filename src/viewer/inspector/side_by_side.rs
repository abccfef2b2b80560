//! The magnifiers of two pictures side by side: each lies in its picture's half, beside the picture where there is room.

use crate::figure::{Inset, PixelRect, place};
use crate::viewer::inspector::{Inspector, LEAST, PlacedInset, SHARE, with_ring};

impl Inspector {
    /// As [`Inspector::place`] for two pictures side by side: each inset lies in its picture's half, beside the picture in
    /// `canvas` where there is room. `shown` and `canvas` lie in the first half; those of the second are alike.
    pub(in crate::viewer) fn place_in_halves(
        &mut self,
        center: [u32; 2],
        shown: &PixelRect,
        canvas: &PixelRect,
        halves: [&PixelRect; 2],
    ) -> Option<[PlacedInset; 2]> {
        let [half, other] = halves;
        let first = self
            .place_beside(center, shown, canvas, half)
            .or_else(|| self.place(center, shown, half))?;
        let inset = first.inset.without_detail();
        let rect = PixelRect {
            x: first.rect.x + other.x - half.x,
            height: inset.size()[1],
            ..first.rect
        };
        Some([first, PlacedInset { inset, rect }])
    }

    /// Places an inset in the part of `half` that the picture in `canvas` leaves free; `None` where there is room only for
    /// a tiny one.
    fn place_beside(
        &mut self,
        center: [u32; 2],
        shown: &PixelRect,
        canvas: &PixelRect,
        half: &PixelRect,
    ) -> Option<PlacedInset> {
        /// What is left of the magnification at least.
        const LEAST_PART: u32 = 3;
        let longest = (f64::from(half.width.min(half.height)) * SHARE).max(LEAST);
        let taken = with_ring(shown, self.ring_room);
        let smallest = *Inset::REGION.start();
        let inset = |region, magnification| Inset::new(center.map(i64::from), region, magnification);
        let (region, magnification) = (self.region, self.magnification);
        let regions = (smallest..=region).rev().map(|region| inset(region, magnification));
        let smaller = (magnification.div_ceil(LEAST_PART)..magnification).rev();
        let insets = regions.chain(smaller.map(|magnification| inset(smallest, magnification)));
        let insets: Vec<Inset> = insets
            .flat_map(|inset| [inset, inset.without_detail()])
            .filter(|inset| f64::from(inset.size()[0].max(inset.size()[1])) <= longest)
            .collect();
        let bands: Vec<(usize, PixelRect)> = bands_around(half, canvas).into_iter().enumerate().collect();
        // What the wheel turns over stays in its band, where there is room for any inset.
        let same = bands.get(self.band..=self.band).filter(|_| self.wheeled);
        let (found, corner, number) = [same.unwrap_or_default(), &bands].into_iter().find_map(|bands| {
            insets.iter().find_map(|inset| {
                bands.iter().find_map(|(number, band)| {
                    let (corner, rect) = place(band, inset.size(), &taken, self.corner)?;
                    Some((PlacedInset { inset: *inset, rect }, corner, *number))
                })
            })
        })?;
        (self.corner, self.band) = (corner, number);
        Some(found)
    }
}

/// What is free of `half` below, above and beside `canvas`.
fn bands_around(half: &PixelRect, canvas: &PixelRect) -> [PixelRect; 4] {
    let from_to = |[left, top]: [i64; 2], [right, bottom]: [i64; 2]| {
        let side = |from: i64, to: i64| u32::try_from(to - from).unwrap_or_default();
        PixelRect {
            x: left,
            y: top,
            width: side(left, right),
            height: side(top, bottom),
        }
    };
    let (right, bottom) = (half.right(), half.bottom());
    [
        from_to([half.x, canvas.bottom().max(half.y)], [right, bottom]),
        from_to([half.x, half.y], [right, canvas.y.min(bottom)]),
        from_to([canvas.right().max(half.x), half.y], [right, bottom]),
        from_to([half.x, half.y], [canvas.x.min(right), bottom]),
    ]
}
