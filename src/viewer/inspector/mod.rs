//! The pixel inspector: which pixel it shows, how large, and where its inset lies in the window.
//!
//! It reads the frame, never the screen. Unpinned it follows the pointer and gives way to it; pinned it stays, so
//! that the pointer can go into the inset and read the magnified pixels.

pub(in crate::viewer) mod contributions;
pub(in crate::viewer) mod explanation;
pub(in crate::viewer) mod pin;
pub(in crate::viewer) mod samples;
pub(in crate::viewer) mod side_by_side;
pub(in crate::viewer) mod state;
pub(in crate::viewer) mod status;

use glam::DVec2;

use crate::figure::{Corner, Inset, PixelRect, corners};
use crate::viewer::view::camera::Camera;

/// The magnifications that the wheel steps through.
const STEPS: [u32; 17] = [2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 28, 32, 40, 48, 64, 96];

/// As many steps as there can be.
const MAX_STEPS: u32 = 20;

/// Part of the shorter side of its area that an inset may take.
pub(in crate::viewer) const SHARE: f64 = 0.8;
/// What it may take in the smallest window, in pixels.
pub(in crate::viewer) const LEAST: f64 = 48.0;
/// What panels must leave of the window's shorter side, as one part of so many, and how many window pixels are enough in any
/// case, for an inset to be worth its place.
pub(in crate::viewer) const LEAST_PART: u32 = 3;
pub(in crate::viewer) const ENOUGH: u32 = 150;
/// Lines of a magnified pixel's label: red, green, blue.
const LABEL_LINES: f32 = 3.0;

/// Characters of a label's longest line.
const LABEL_CHARACTERS: f32 = 3.0;

/// Pixels between the inset of A and that of B.
const BETWEEN: u32 = 4;

/// Window pixels around a pinned pixel that its ring takes, on a display with two pixels per point.
pub(in crate::viewer) const RING_ROOM: u32 = 24;

/// Free pixels around a label.
const LABEL_MARGIN: f32 = 2.0;

/// Why a pin is kept in sight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) enum Reveal {
    /// It was jumped to.
    Jumped,
    /// The window has another size, and panels may cover more of it.
    Resized,
}

/// State of the pixel inspector.
#[expect(
    clippy::struct_excessive_bools,
    reason = "what is open, and what led to that, each on its own"
)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inspector {
    /// Whether it is to be seen.
    pub open: bool,
    /// Source pixels along each side, 8 to 64.
    pub region: u32,
    /// Window pixels along each side of a magnified pixel.
    pub magnification: u32,
    pub(in crate::viewer) pin: Option<Pin>,
    /// Window pixels around the pinned one that a ring takes which marks it in the picture.
    pub(in crate::viewer) ring_room: u32,
    /// Why the pin is to stay in the part of the window that is free, if it is, until a hand moves the picture.
    pub(in crate::viewer) reveal: Option<Reveal>,
    /// Whether a hand asked about the pinned pixel: the view rests while the explanation takes its room.
    pub(in crate::viewer) asked: bool,
    /// Where in the window a hand asked about it.
    pub(in crate::viewer) asked_at: Option<AskedAt>,
    /// The view before an explanation took its room, and the one that was set then.
    pub(in crate::viewer) kept_view: Option<[Camera; 2]>,
    /// How often a pixel was pinned.
    pub(in crate::viewer) pins: u64,
    /// Whether a pin opened the inspector, which then closes with it.
    pub(in crate::viewer) came_with_pin: bool,
    /// The pixel last under the pointer: shown while the pointer is elsewhere.
    pub(in crate::viewer) last: Option<[u32; 2]>,
    /// Region times pitch that the user chose; the wheel keeps it.
    extent: u32,
    /// Where the inset was last.
    pub(in crate::viewer) corner: Corner,
    /// The corner that a hand dragged it to.
    chosen: Option<Corner>,
    /// The corner that a hand is dragging it to: where it has no room there, it stays where it is.
    pub(in crate::viewer) dragged: Option<Corner>,
    /// The part beside a picture in a half of the window where the inset was last.
    band: usize,
    /// Turns of the wheel that did not make a whole step yet.
    rest: f64,
    /// Whether the wheel turned over it: it stays where it is.
    wheeled: bool,
    /// What it lay beside then: once that changes, it may go elsewhere.
    wheeled_beside: Option<Beside>,
    /// Where the pointer has rested while the wheel turned over the picture: the inset does not go there, if it can go
    /// elsewhere.
    pub(in crate::viewer) spared: Option<[i64; 2]>,
}

/// Where in the window a hand asked about a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AskedAt {
    /// The window pixel.
    pub at: [i64; 2],
    /// Whether it was B's half of two pictures side by side.
    pub in_second: bool,
}

/// What is pinned: a place of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::viewer) struct Pin {
    /// The frame pixel that the place falls in now; it may lie outside the frame.
    pub(in crate::viewer) pixel: [i64; 2],
    /// The place in canvas units, and the scene's number and generation; `None` until the scene was read.
    pub(in crate::viewer) place: Option<(DVec2, (usize, u64))>,
}

/// The inset in the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlacedInset {
    /// What it shows. In a small window less than the user chose.
    pub inset: Inset,
    /// Where it lies, in window pixels.
    pub rect: PixelRect,
}

/// The numbers of a magnified pixel, and where to write them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelLabel {
    /// The frame pixel.
    pub pixel: [u32; 2],
    /// Its block, in window pixels.
    pub block: PixelRect,
    /// Straight `[r, g, b, a]`; red, green and blue are to be written in decimal below each other.
    pub rgba: [u8; 4],
    /// Whether the colour is dark, so that the text must be light.
    pub dark: bool,
}

impl Default for Inspector {
    fn default() -> Self {
        let (region, magnification) = (15, 20);
        Self {
            open: false,
            region,
            magnification,
            pin: None,
            ring_room: 0,
            reveal: None,
            asked: false,
            asked_at: None,
            kept_view: None,
            pins: 0,
            came_with_pin: false,
            last: None,
            extent: region * (magnification + 1),
            corner: Corner::default(),
            chosen: None,
            dragged: None,
            band: 0,
            rest: 0.0,
            wheeled: false,
            wheeled_beside: None,
            spared: None,
        }
    }
}

impl Inspector {
    pub(in crate::viewer) fn set_region(&mut self, region: u32) {
        self.apply(Inset::new([0, 0], region, self.magnification));
        self.extent = self.region * (self.magnification + 1);
    }

    pub(in crate::viewer) fn set_magnification(&mut self, magnification: u32) {
        self.apply(Inset::new([0, 0], self.region, magnification));
        self.extent = self.region * (self.magnification + 1);
    }

    /// So many steps through [`STEPS`]; the inset's size stays about the same.
    pub(in crate::viewer) fn step(&mut self, steps: i32) {
        let now = self.magnification;
        for _ in 0..steps.unsigned_abs().min(MAX_STEPS) {
            let next = if steps > 0 {
                STEPS.into_iter().find(|m| *m > self.magnification)
            } else {
                STEPS.into_iter().rfind(|m| *m < self.magnification)
            };
            self.magnification = next.unwrap_or(self.magnification);
        }
        if self.magnification != now {
            let region = (self.extent + self.magnification.div_ceil(2)) / (self.magnification + 1);
            self.apply(Inset::new([0, 0], region, self.magnification));
        }
    }

    /// Turns of the wheel over the inset, which was `placed`: every whole one is a step, from what is to be seen and not from
    /// what had no room.
    pub(in crate::viewer) fn wheel(&mut self, clicks: f64, placed: &Inset) {
        if clicks.is_nan() {
            return;
        }
        let turned = (self.rest + clicks).clamp(-100.0, 100.0);
        let whole = turned.trunc();
        self.rest = turned - whole;
        (self.wheeled, self.wheeled_beside) = (true, None);
        if whole != 0.0 {
            self.magnification = self.magnification.min(placed.magnification);
        }
        #[expect(clippy::cast_possible_truncation, reason = "clamped to 100 steps")]
        self.step(whole as i32);
    }

    /// The pointer moved: the inset may lie where it rested.
    pub(in crate::viewer) fn let_go(&mut self) {
        self.spared = None;
    }

    /// Whether it is to stay where it is: since the wheel turned over it nothing changed that it lies beside.
    fn stays(&mut self, beside: &Beside) -> bool {
        self.wheeled &= self.wheeled_beside.is_none_or(|before| before == *beside);
        self.wheeled_beside = self.wheeled.then_some(*beside);
        self.wheeled
    }

    fn apply(&mut self, limits: Inset) {
        self.region = limits.region;
        self.magnification = limits.magnification;
    }

    /// Where the inset for the frame pixel `center` goes: inside the area, never over that pixel, beside the ring of a
    /// pinned one and beside the picture where there is room, and never most of the area. In a tight window the large pixel
    /// goes first, then the region shrinks, then the magnification. Remembers the corner, so that the inset only moves when
    /// it must.
    pub(in crate::viewer) fn place(&mut self, center: [u32; 2], beside: &Beside) -> Option<PlacedInset> {
        self.place_group(center, beside, Inset::size)
    }

    /// As [`Inspector::place`] for two insets of the same pixel, the second without a large pixel.
    ///
    /// They lie next to each other, A's to the left unless `swapped`, so that neither picture of a wipe loses its whole
    /// side.
    pub(in crate::viewer) fn place_both(
        &mut self,
        center: [u32; 2],
        beside: &Beside,
        swapped: bool,
    ) -> Option<[PlacedInset; 2]> {
        let mut first = self.place_group(center, beside, |inset| {
            let [width, height] = inset.size();
            [2 * width + BETWEEN, height]
        })?;
        let inset = first.inset.without_detail();
        let rect = PixelRect {
            height: inset.size()[1],
            ..first.rect
        };
        let mut second = PlacedInset { inset, rect };
        let right = if swapped { &mut first } else { &mut second };
        right.rect.x += i64::from(rect.width + BETWEEN);
        Some([first, second])
    }

    /// Places what is as large as `size` says for an inset, which stands in its upper left corner.
    fn place_group(
        &mut self,
        center: [u32; 2],
        beside: &Beside,
        size: impl Fn(&Inset) -> [u32; 2],
    ) -> Option<PlacedInset> {
        let Beside { area, shown, .. } = beside;
        let center = center.map(i64::from);
        let (region, magnification) = (self.region, self.magnification);
        let smallest = *Inset::REGION.start();
        let inset = |region, magnification| Inset::new(center, region, magnification);
        let regions = |least: u32| (least..=region).rev().map(move |region| inset(region, magnification));
        let ring = (self.ring_room > 0).then(|| with_ring(shown, self.ring_room));
        let all = || {
            let magnifications = (*Inset::MAGNIFICATION.start()..magnification).rev();
            let smaller = magnifications.map(|magnification| inset(smallest, magnification));
            regions(smallest).chain(smaller)
        };
        let side = |inset: &Inset| inset.without_detail().size()[0];
        let largest = f64::from(area.width.min(area.height)) * SHARE;
        let least = f64::from(side(&inset(region, magnification))).min(largest) / 2.0;
        // The ring is worth an inset of half the size, not a tiny one.
        let beside_ring = || all().take_while(|inset| f64::from(side(inset)) >= least);
        for corner in self.wanted_corners() {
            let room = Room {
                beside,
                taken: ring.as_ref().unwrap_or(shown),
                only: Some(corner),
                spared: self.spared,
            };
            if let Some(placed) = self.first_place(beside_ring(), &room, &size) {
                self.chosen = Some(corner);
                return Some(placed);
            }
        }
        let corners: &[Option<Corner>] = if self.stays(beside) {
            &[Some(self.corner), None]
        } else {
            &[None]
        };
        let spared = [self.spared, None];
        let spared = &spared[usize::from(self.spared.is_none())..];
        corners
            .iter()
            .flat_map(|only| spared.iter().map(move |spared| (only, spared)))
            .find_map(|(only, spared)| {
                let room = |taken| Room {
                    beside,
                    taken,
                    only: *only,
                    spared: *spared,
                };
                let large = ring
                    .as_ref()
                    .and_then(|ring| self.first_place(beside_ring(), &room(ring), &size));
                large.or_else(|| self.first_place(all(), &room(shown), &size))
            })
    }

    /// The corners that a hand dragged it to, the latest first; the latest is asked for once.
    fn wanted_corners(&mut self) -> impl Iterator<Item = Corner> + use<> {
        self.dragged.take().into_iter().chain(self.chosen)
    }

    /// Places the first of these insets that has room, rather without its large pixel than a smaller one.
    fn first_place(
        &mut self,
        insets: impl Iterator<Item = Inset>,
        room: &Room<'_>,
        size: &impl Fn(&Inset) -> [u32; 2],
    ) -> Option<PlacedInset> {
        let Room {
            beside: Beside { area, picture, .. },
            taken,
            only,
            spared,
        } = *room;
        let longest = (f64::from(area.width.min(area.height)) * SHARE).max(LEAST);
        for inset in insets {
            for inset in [inset, inset.without_detail()] {
                let whole = size(&inset);
                if f64::from(whole[0].max(whole[1])) > longest {
                    continue;
                }
                let suits = |(corner, rect): &(Corner, PixelRect)| {
                    let is_free = !rect.overlaps(taken) && spared.is_none_or(|at| !rect.contains(at));
                    is_free && only.is_none_or(|only| only == *corner)
                };
                let free = || corners(area, whole, self.corner).filter(suits);
                let beside_picture = free().find(|(_, rect)| !rect.overlaps(picture));
                if let Some((corner, rect)) = beside_picture.or_else(|| free().next()) {
                    self.corner = corner;
                    let [width, height] = inset.size();
                    let rect = PixelRect { width, height, ..rect };
                    return Some(PlacedInset { inset, rect });
                }
            }
        }
        None
    }
}

/// What insets lie in and beside, in window pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::viewer) struct Beside {
    /// The part of the window that is free for them.
    pub(in crate::viewer) area: PixelRect,
    /// The magnified pixel in the picture.
    pub(in crate::viewer) shown: PixelRect,
    /// The canvas of the picture.
    pub(in crate::viewer) picture: PixelRect,
}

/// Where an inset may go: beside what is `taken` and the point that is `spared`, in this corner if there is one.
struct Room<'a> {
    beside: &'a Beside,
    taken: &'a PixelRect,
    only: Option<Corner>,
    spared: Option<[i64; 2]>,
}

/// A pinned pixel with so much room around it.
pub(in crate::viewer) fn with_ring(pixel: &PixelRect, room: u32) -> PixelRect {
    PixelRect {
        x: pixel.x - i64::from(room),
        y: pixel.y - i64::from(room),
        width: pixel.width + 2 * room,
        height: pixel.height + 2 * room,
    }
}

impl PlacedInset {
    /// The frame pixel magnified at a window pixel; it may lie outside the frame. `None` beside the grid.
    pub fn pixel_at(&self, [x, y]: [i64; 2]) -> Option<[i64; 2]> {
        if !self.rect.contains([x, y]) {
            return None;
        }
        self.inset.pixel_at([x - self.rect.x, y - self.rect.y])
    }

    /// The block of a frame pixel, in window pixels.
    pub fn block(&self, pixel: [i64; 2]) -> Option<PixelRect> {
        let block = self.inset.block(pixel)?;
        Some(PixelRect {
            x: block.x + self.rect.x,
            y: block.y + self.rect.y,
            ..block
        })
    }

    /// Where there is room for words about the pixel in the middle, in window pixels. The ground is light in every
    /// theme.
    pub fn text_area(&self) -> Option<PixelRect> {
        let area = self.inset.text_area()?;
        Some(PixelRect {
            x: area.x + self.rect.x,
            y: area.y + self.rect.y,
            ..area
        })
    }

    /// Whether the numbers of a pixel fit its block when a character is `[width, height]` window pixels.
    pub fn labels_fit(&self, character: [f32; 2]) -> bool {
        let room = self.inset.magnification as f32 - LABEL_MARGIN;
        character[0] * LABEL_CHARACTERS <= room && character[1] * LABEL_LINES <= room
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wheel_keeps_the_size() {
        let mut inspector = Inspector::default();
        let side = |inspector: &Inspector| inspector.region * (inspector.magnification + 1);
        let before = side(&inspector);
        let wheel = |inspector: &mut Inspector, clicks: f64| {
            let placed = Inset::new([0, 0], inspector.region, inspector.magnification);
            inspector.wheel(clicks, &placed);
        };
        wheel(&mut inspector, 0.5);
        assert_eq!(inspector.magnification, 20, "half a click is no step");
        wheel(&mut inspector, 0.5);
        assert_eq!(inspector.magnification, 24, "two halves are one");
        assert!(side(&inspector).abs_diff(before) <= 20, "{inspector:?}");
        wheel(&mut inspector, -1.0);
        assert_eq!((inspector.magnification, inspector.region), (20, 15), "and back");
        wheel(&mut inspector, 1e300);
        wheel(&mut inspector, f64::NAN);
        assert_eq!((inspector.magnification, inspector.region), (96, 8), "the end");
        let small = Inset::new([0, 0], 8, 37);
        inspector.wheel(-1.0, &small);
        assert_eq!(inspector.magnification, 32, "the step below what was to be seen");
    }

    #[test]
    fn place_gives_way_and_shrinks() {
        let mut inspector = Inspector::default();
        let area = PixelRect::of_size([800, 600]);
        let mut place = |at: [u32; 2], area: &PixelRect| inspector.place(at, &beside(at, area));
        let far = place([10, 500], &area).expect("there is room");
        assert_eq!(far.inset.region, 15, "as chosen");
        let near = place([700, 100], &area).expect("there is room");
        assert_ne!(near.rect, far.rect, "it moved away");
        let back = place([10, 300], &area).expect("there is room");
        assert_eq!(back.rect, near.rect, "it only moves when it must");
        let tight = place([60, 60], &PixelRect::of_size([120, 120])).expect("a small one fits");
        assert!(tight.rect.width <= 90, "{tight:?}");
        assert_eq!(place([0, 0], &PixelRect::of_size([20, 20])), None, "no room at all");
        assert_eq!(place([0, 0], &PixelRect::default()), None, "nor here");
    }

    #[test]
    fn place_leaves_the_ring_of_a_pin_uncovered() {
        let area = PixelRect::of_size([800, 600]);
        let mut inspector = Inspector::default();
        let far = inspector
            .place([10, 500], &beside([10, 500], &area))
            .expect("there is room");
        // Beside the inset by a few pixels: only the ring is in its way.
        let at = [u32::try_from(far.rect.x).expect("inside") - 3, 100];
        let free = inspector.place(at, &beside(at, &area)).expect("there is room");
        assert_eq!(free.rect, far.rect, "without a ring it stays");
        inspector.ring_room = RING_ROOM;
        let pinned = inspector.place(at, &beside(at, &area)).expect("there is room");
        assert!(!pinned.rect.overlaps(&with_ring(&pixel(at), RING_ROOM)), "{pinned:?}");
        assert_eq!(pinned.inset.region, 15, "as large as before");
        let tight = PixelRect::of_size([120, 120]);
        let small = inspector.place([60, 60], &beside([60, 60], &tight));
        assert!(small.is_some(), "where only the ring has no room, it is covered");
    }

    fn pixel(at: [u32; 2]) -> PixelRect {
        let [x, y] = at.map(i64::from);
        PixelRect {
            x,
            y,
            width: 1,
            height: 1,
        }
    }

    fn beside(at: [u32; 2], area: &PixelRect) -> Beside {
        Beside {
            area: *area,
            shown: pixel(at),
            ..Beside::default()
        }
    }

    #[test]
    fn place_leaves_the_picture_uncovered_where_a_corner_is_free() {
        let area = PixelRect::of_size([800, 600]);
        for (x, y) in [(0, 0), (650, 0), (0, 450), (650, 450)] {
            let picture = PixelRect {
                x,
                y,
                width: 150,
                height: 150,
            };
            for corner in Corner::ALL {
                let mut inspector = Inspector {
                    corner,
                    ..Inspector::default()
                };
                let beside = Beside {
                    picture,
                    ..beside([400, 300], &area)
                };
                let placed = inspector.place([400, 300], &beside).expect("there is room");
                assert!(!placed.rect.overlaps(&picture), "{placed:?} covers {picture:?}");
                assert_eq!(placed.inset.magnification, 20, "no smaller for that");
            }
        }
    }

    #[test]
    fn place_both_lays_them_into_the_free_area() {
        let mut inspector = Inspector::default();
        let cases = [
            ([800, 600], [700, 100]),
            ([704, 772], [600, 386]),
            ([704, 772], [352, 386]),
            ([1280, 1000], [5, 5]),
            ([300, 260], [40, 40]),
            ([260, 600], [40, 40]),
        ];
        for (size, at) in cases {
            let area = PixelRect::of_size(size);
            for swapped in [false, true] {
                let both = inspector.place_both(at, &beside(at, &area), swapped);
                let [a, b] = both.expect("there is room");
                for placed in [&a, &b] {
                    assert_eq!(placed.rect.intersection(&area), placed.rect, "inside {size:?}");
                    assert!(!placed.rect.overlaps(&pixel(at)), "beside the pixel");
                    assert_eq!([placed.rect.width, placed.rect.height], placed.inset.size(), "its size");
                }
                assert!(!a.rect.overlaps(&b.rect) && a.rect.y == b.rect.y, "next to each other");
                assert_eq!(a.inset.source(), b.inset.source(), "the same pixels");
                assert_eq!(a.rect.x > b.rect.x, swapped, "A's on the side of A");
            }
        }
    }
}
