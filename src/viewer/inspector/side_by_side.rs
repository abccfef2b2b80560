//! The magnifiers of two pictures side by side: each lies in its picture's half, beside the picture where there is room.

use crate::figure::{Corner, Inset, PixelRect, place};
use crate::viewer::inspector::{Beside, Inspector, LEAST, PlacedInset, SHARE, with_ring};

impl Inspector {
    /// As [`Inspector::place`] for two pictures side by side: each inset lies in its picture's half, beside the picture
    /// where there is room. What A's inset lies beside is in its half; B's, whose corner lies at `other`, is alike.
    pub(in crate::viewer) fn place_in_halves(
        &mut self,
        center: [u32; 2],
        beside: &Beside,
        other: [i64; 2],
    ) -> Option<[PlacedInset; 2]> {
        let first = self
            .place_beside(center, beside)
            .or_else(|| self.place(center, beside))?;
        let inset = first.inset.without_detail();
        let rect = PixelRect {
            x: first.rect.x + other[0] - beside.area.x,
            height: inset.size()[1],
            ..first.rect
        };
        Some([first, PlacedInset { inset, rect }])
    }

    /// Places an inset in the part of the area that the picture leaves free; `None` where there is room only for a tiny
    /// one.
    fn place_beside(&mut self, center: [u32; 2], beside: &Beside) -> Option<PlacedInset> {
        /// What is left of the magnification at least.
        const LEAST_PART: u32 = 3;
        let Beside { area, shown, picture } = beside;
        let longest = (f64::from(area.width.min(area.height)) * SHARE).max(LEAST);
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
        let bands: Vec<(usize, PixelRect)> = bands_around(area, picture).into_iter().enumerate().collect();
        for wanted in self.wanted_corners() {
            let in_band = |inset: &Inset, (number, band): &(usize, PixelRect)| {
                let (_, rect) = place(band, inset.size(), &taken, wanted)?;
                let middle = [rect.x + i64::from(rect.width / 2), rect.y + i64::from(rect.height / 2)];
                (Corner::nearest(area, middle) == wanted).then_some((PlacedInset { inset: *inset, rect }, *number))
            };
            let placed = insets
                .iter()
                .find_map(|inset| bands.iter().find_map(|band| in_band(inset, band)));
            if let Some((placed, number)) = placed {
                (self.corner, self.chosen, self.band) = (wanted, Some(wanted), number);
                return Some(placed);
            }
        }
        // What the wheel turns over stays in its band, where there is room for any inset.
        let stays = self.stays(beside);
        let same = bands.get(self.band..=self.band).filter(|_| stays);
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

/// What is free of `area` below, above and beside `picture`.
fn bands_around(area: &PixelRect, picture: &PixelRect) -> [PixelRect; 4] {
    let from_to = |[left, top]: [i64; 2], [right, bottom]: [i64; 2]| {
        let side = |from: i64, to: i64| u32::try_from(to - from).unwrap_or_default();
        PixelRect {
            x: left,
            y: top,
            width: side(left, right),
            height: side(top, bottom),
        }
    };
    let (right, bottom) = (area.right(), area.bottom());
    [
        from_to([area.x, picture.bottom().max(area.y)], [right, bottom]),
        from_to([area.x, area.y], [right, picture.y.min(bottom)]),
        from_to([picture.right().max(area.x), area.y], [right, bottom]),
        from_to([area.x, area.y], [picture.x.min(right), bottom]),
    ]
}
