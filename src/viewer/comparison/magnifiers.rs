//! The magnifiers of a comparison: side by side each lies in its picture's half, elsewhere one stands above the other.

use glam::{DVec2, dvec2};

use super::super::inspector::{Inspector, LEAST, PlacedInset, SHARE, with_ring};
use super::super::window_picture::magnified;
use super::super::{PixelRect, Viewer};
use crate::figure::{Inset, place};

impl Viewer {
    /// Where the magnifiers of a pixel of both go, inside the window pixels of `area`.
    pub(in super::super) fn place_magnifiers(
        &mut self,
        center: [u32; 2],
        area: &PixelRect,
    ) -> Option<[PlacedInset; 2]> {
        let (shown, panes) = (self.shown_at(center), self.panes());
        let Some((second, canvas)) = panes.second.zip(self.canvas_in_frame()) else {
            return self.inspector.place_both(center, &shown, area);
        };
        let zoom = self.settings.pixel_zoom.factor();
        let [low, high] = canvas.map(|place| screen_place(place, panes.first.corner));
        let side = |axis: usize| u32::try_from(high[axis] - low[axis]).unwrap_or_default();
        let canvas = PixelRect {
            x: low[0],
            y: low[1],
            width: side(0),
            height: side(1),
        };
        let [canvas, first, second] = [canvas, panes.first.area, second.area].map(|rect| magnified(&rect, zoom));
        self.inspector
            .place_in_halves(center, &shown, &canvas, [&first, &second])
    }

    /// The corners of the box around the canvas, in frame pixels; `None` before the scene was read.
    pub(crate) fn canvas_in_frame(&self) -> Option<[DVec2; 2]> {
        let sight = self.sight()?;
        let view = self.current()?.camera.transform(&sight);
        let DVec2 { x, y } = sight.canvas;
        let corners = [dvec2(0.0, 0.0), dvec2(x, 0.0), dvec2(0.0, y), dvec2(x, y)].map(|at| view.to_pixels(at));
        let low = corners.into_iter().reduce(DVec2::min)?;
        let high = corners.into_iter().reduce(DVec2::max)?;
        Some([low, high])
    }
}

impl Inspector {
    /// As [`Inspector::place`] for two pictures side by side: each inset lies in its picture's half, beside the picture in
    /// `canvas` where there is room. `shown` and `canvas` lie in the first half; those of the second are alike.
    fn place_in_halves(
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
        let bands = bands_around(half, canvas);
        for inset in insets.flat_map(|inset| [inset, inset.without_detail()]) {
            let size = inset.size();
            if f64::from(size[0].max(size[1])) > longest {
                continue;
            }
            let mut places = bands.iter().filter_map(|band| place(band, size, &taken, self.corner));
            if let Some((corner, rect)) = places.next() {
                self.corner = corner;
                return Some(PlacedInset { inset, rect });
            }
        }
        None
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

/// The screen pixel of a place in a frame whose corner lies at `corner`; far places are brought near.
fn screen_place(place: DVec2, corner: [i64; 2]) -> [i64; 2] {
    /// Farther away nothing is to be seen.
    const FAR: f64 = 1e6;
    #[expect(clippy::cast_possible_truncation, reason = "clamped")]
    let near = |at: f64| at.round().clamp(-FAR, FAR) as i64;
    [near(place.x) + corner[0], near(place.y) + corner[1]]
}
