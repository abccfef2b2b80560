//! Where frames lie in the window, and how pixels of the window become pixels of a frame and back.
//!
//! Screen pixels are the window's pixels divided by the pixel zoom; frames lie in panes of the screen.

use glam::DVec2;

use crate::figure::PixelRect;
use crate::raster::Region;
use crate::viewer::chrome::Chrome;
use crate::viewer::settings::PixelZoom;
use crate::viewer::view::panes::{Moved, Pane, Panes};
use crate::viewer::view::pointer::window_pixel;

/// Screen pixels between two pictures side by side at least: one more where the rest is odd.
const GAP: u32 = 2;

/// Where frames lie in the window at this moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindowLayout {
    zoom: PixelZoom,
    window: [u32; 2],
    free_area: Option<PixelRect>,
    free_window: PixelRect,
    fixed_size: Option<[u32; 2]>,
    panes: Panes,
}

/// How frames share the window, and of which size they are.
#[derive(Clone, Copy, Debug)]
pub(in crate::viewer) struct Sharing<'a> {
    pub(in crate::viewer) side_by_side: bool,
    /// The size of both frames, where a picture from outside gives it.
    pub(in crate::viewer) fixed_size: Option<[u32; 2]>,
    /// Where the hand moved frames of such a size.
    pub(in crate::viewer) moved: &'a Moved,
}

impl WindowLayout {
    pub(in crate::viewer) fn new(zoom: PixelZoom, chrome: &Chrome, sharing: Sharing<'_>) -> Self {
        let screen = zoom.frame_size(chrome.window);
        let whole = PixelRect::of_size(screen);
        let free_window = chrome.free_window();
        let free = free_screen(zoom, &free_window);
        let halves = free.filter(|_| sharing.side_by_side).and_then(halves);
        let pane = |area: PixelRect, middle: &PixelRect| Pane {
            area,
            corner: match sharing.fixed_size {
                Some(frame) => sharing.moved.corner(middle, frame),
                None => [area.x, area.y],
            },
        };
        let panes = match halves {
            Some([left, right]) => Panes {
                frame: sharing.fixed_size.unwrap_or([left.width, left.height]),
                first: pane(left, &left),
                second: Some(pane(right, &right)),
            },
            None => Panes {
                frame: sharing.fixed_size.unwrap_or(screen),
                first: pane(whole, &free.unwrap_or(whole)),
                second: None,
            },
        };
        Self {
            zoom,
            window: chrome.window,
            free_area: chrome.free_area,
            free_window,
            fixed_size: sharing.fixed_size,
            panes,
        }
    }

    /// The size of A's frame, and of B's: that of the window divided by the pixel zoom, unless both lie side by side.
    pub fn frame_size(&self) -> [u32; 2] {
        self.panes.frame
    }

    /// Where a frame pixel is to be seen, in window pixels.
    pub fn shown_at(&self, pixel: [u32; 2]) -> PixelRect {
        self.shown_in(&self.panes.first, pixel)
    }

    /// Where a pane shows a frame pixel, in window pixels.
    pub(in crate::viewer) fn shown_in(&self, pane: &Pane, pixel: [u32; 2]) -> PixelRect {
        magnified(&pane.place(Region::of_pixel(pixel)), self.zoom())
    }

    pub(in crate::viewer) fn panes(&self) -> Panes {
        self.panes
    }

    /// The size of both frames, where a picture from outside gives it.
    pub(in crate::viewer) fn fixed_size(&self) -> Option<[u32; 2]> {
        self.fixed_size
    }

    /// Window pixels along each side of a frame pixel.
    pub(in crate::viewer) fn zoom(&self) -> u32 {
        self.zoom.factor()
    }

    /// The part of the window that no panel covers.
    pub(in crate::viewer) fn free_window(&self) -> PixelRect {
        self.free_window
    }

    /// The half of it at a window pixel where two pictures lie side by side, else all of it.
    pub(in crate::viewer) fn free_window_at(&self, at: [i64; 2]) -> PixelRect {
        let panes = self.panes();
        let Some(second) = panes.second else {
            return self.free_window;
        };
        let halves = [panes.first, second].map(|pane| magnified(&pane.area, self.zoom()));
        let [first, second] = halves;
        if second.contains(at) { second } else { first }
    }

    /// The same as panels tell it; `None` where there are none, as in pictures of the window without panels.
    pub(in crate::viewer) fn free_area(&self) -> Option<PixelRect> {
        self.free_area
    }

    /// The same in whole screen pixels; `None` where there is none.
    pub(in crate::viewer) fn free_screen(&self) -> Option<PixelRect> {
        free_screen(self.zoom, &self.free_window)
    }

    /// The part of the frame that no panel covers: its corner and size in frame pixels.
    pub(crate) fn free_part(&self) -> [DVec2; 2] {
        let zoom = f64::from(self.zoom());
        let free = self.free_window;
        if self.panes.second.is_some() || self.fixed_size.is_some() {
            return [DVec2::ZERO, DVec2::from(self.panes.frame.map(f64::from))];
        }
        let corner = DVec2::new(free.x as f64, free.y as f64) / zoom;
        [corner, DVec2::new(f64::from(free.width), f64::from(free.height)) / zoom]
    }

    /// The pixels of that part that are wholly free; all of the frame where there are none.
    pub(in crate::viewer) fn free_region(&self) -> Region {
        let whole = Region::of_size(self.panes.frame);
        if self.panes.second.is_some() || self.fixed_size.is_some() {
            return whole;
        }
        let region = |free: PixelRect| {
            let (x, y) = (u32::try_from(free.x).ok()?, u32::try_from(free.y).ok()?);
            let PixelRect { width, height, .. } = free;
            Some(Region { x, y, width, height }.intersection(whole))
        };
        let free = self.free_screen().and_then(region);
        free.filter(|free| !free.is_empty()).unwrap_or(whole)
    }

    /// The point in the middle of the frame, in frame pixels.
    pub(in crate::viewer) fn middle(&self) -> DVec2 {
        DVec2::from(self.panes.frame.map(f64::from)) / 2.0
    }

    /// The pixel, if the frame has it.
    pub(in crate::viewer) fn in_frame(&self, pixel: [i64; 2]) -> Option<[u32; 2]> {
        let [width, height] = self.panes.frame;
        let inside = |value: i64, side: u32| u32::try_from(value).ok().filter(|value| *value < side);
        Some([inside(pixel[0], width)?, inside(pixel[1], height)?])
    }

    /// The frame's nearest pixel; `None` if it has no pixels.
    pub(crate) fn nearest_in_frame(&self, pixel: [i64; 2]) -> Option<[u32; 2]> {
        let [width, height] = self.panes.frame;
        let last = [i64::from(width) - 1, i64::from(height) - 1];
        self.in_frame([pixel[0].min(last[0]).max(0), pixel[1].min(last[1]).max(0)])
    }

    /// The frame pixel at a window pixel; it may lie outside the frame.
    pub(in crate::viewer) fn frame_pixel(&self, at: [i64; 2]) -> [i64; 2] {
        let zoom = i64::from(self.zoom());
        let screen = at.map(|side| side.div_euclid(zoom));
        let corner = self.panes.at(screen).corner;
        [screen[0] - corner[0], screen[1] - corner[1]]
    }

    /// The place in the frame, in frame pixels, of a place in the window.
    pub(in crate::viewer) fn frame_position(&self, at: DVec2) -> DVec2 {
        let screen = at / f64::from(self.zoom());
        let [x, y] = self.panes.at(window_pixel(screen)).corner;
        screen - DVec2::new(x as f64, y as f64)
    }

    /// Where frame pixels are to be seen in the window: in every pane.
    pub(in crate::viewer) fn in_window(&self, region: Region) -> Vec<PixelRect> {
        let shown = std::iter::once(self.panes.first).chain(self.panes.second);
        let places = shown.map(|pane| magnified(&pane.place(region).intersection(&pane.area), self.zoom()));
        places.collect()
    }

    /// Whether a frame fills the window pixel by pixel.
    pub(in crate::viewer) fn is_plain(&self) -> bool {
        let panes = &self.panes;
        self.zoom == PixelZoom::ONE
            && panes.first.corner == [0, 0]
            && panes.frame == self.window
            && !panes.frame.contains(&0)
    }

    /// The window in device pixels.
    pub(in crate::viewer) fn window(&self) -> [u32; 2] {
        self.window
    }
}

/// Screen pixels as window pixels.
pub(in crate::viewer) fn magnified(rect: &PixelRect, zoom: u32) -> PixelRect {
    PixelRect {
        x: rect.x * i64::from(zoom),
        y: rect.y * i64::from(zoom),
        width: rect.width.saturating_mul(zoom),
        height: rect.height.saturating_mul(zoom),
    }
}

/// The free part of the window in whole screen pixels; `None` where there is none.
fn free_screen(zoom: PixelZoom, free: &PixelRect) -> Option<PixelRect> {
    if free.width == 0 || free.height == 0 {
        return None;
    }
    let zoom = i64::from(zoom.factor());
    let (x, y) = ((free.x + zoom - 1) / zoom, (free.y + zoom - 1) / zoom);
    let side = |from: i64, to: i64| u32::try_from(to / zoom - from).ok().filter(|side| *side > 0);
    let (width, height) = (side(x, free.right())?, side(y, free.bottom())?);
    Some(PixelRect { x, y, width, height })
}

/// The left and right half of the free part, of one size and out to its edges; `None` where there is no room.
fn halves(free: PixelRect) -> Option<[PixelRect; 2]> {
    let width = free.width.checked_sub(GAP)? / 2;
    let first = PixelRect { width, ..free };
    let second = PixelRect {
        x: free.right() - i64::from(width),
        ..first
    };
    (width > 0).then_some([first, second])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_reach_both_edges_of_windows_of_any_width() {
        for width in 4..12 {
            let free = PixelRect {
                x: 3,
                y: 5,
                width,
                height: 7,
            };
            let [left, right] = halves(free).expect("room");
            assert_eq!(
                (left.width, left.height),
                (right.width, right.height),
                "{width}: of one size"
            );
            assert_eq!((left.x, right.right()), (free.x, free.right()), "{width}: edges");
            assert!((2..=3).contains(&(right.x - left.right())), "{width}: the line between");
        }
    }
}
