//! The picture of the whole window, put together on surfaces that hold older ones.

use super::damage::Damage;
use super::{Holds, LONGEST_AGE, Session};
use crate::app::overlay::CanvasRect;
use crate::raster::Framebuffer;
use crate::viewer::{PixelRect, WindowPixels};

impl Session {
    /// From now on quick frames wait for [`Session::draw_frame`] instead of being drawn by a thread.
    pub(in crate::app) fn lend_surface(&mut self) {
        self.viewer.lend_surface();
    }

    /// Draws the frame that waits for it, if there is one, straight into a surface with rows of `width` pixels that was
    /// composed `age` calls ago. What the surface holds then is for [`Session::compose`] to know.
    pub(in crate::app) fn draw_frame(&mut self, surface: &mut [u32], width: u32, age: u8) -> Holds {
        let size = self.window();
        let drawn = fits(size, surface, width) && self.viewer.draw_frame(&mut WindowPixels { size, pixels: surface });
        if drawn { Holds::Frame } else { Holds::Composed(age) }
    }

    /// Brings a surface up to date and says which parts it wrote. Its rows are `width` pixels long. Where the size is not
    /// the window's, nothing is written: another call with the right size follows.
    pub(in crate::app) fn compose(&mut self, surface: &mut [u32], width: u32, holds: Holds) -> Vec<PixelRect> {
        let size = self.window();
        if !fits(size, surface, width) {
            return Vec::new();
        }
        let panels = std::mem::replace(&mut self.damage, Damage::none(size));
        let picture = self.viewer.take_damage().filter(|_| panels.is_for(size));
        self.composed.truncate(LONGEST_AGE);
        if let (Holds::Frame, Some(parts)) = (holds, &picture) {
            // All of it is new, but only what changed since the frame was drawn must come from the frame.
            self.composed.push_front(Damage::all(size));
            let whole = PixelRect::of_size(size);
            let mut window = WindowPixels { size, pixels: surface };
            self.viewer.window().draw_parts(parts, &mut window);
            self.viewer.window().draw_over(&[whole], &mut window);
            self.overlay.canvas().lay_over(window.pixels);
            return vec![whole];
        }
        let mut now = match picture {
            Some(parts) => parts.iter().fold(panels, |mut damage, part| {
                damage.add(part);
                damage
            }),
            None => Damage::all(size),
        };
        self.composed.push_front(now.clone());
        let before = match holds {
            Holds::Composed(age) => usize::from(age),
            Holds::Frame => 0,
        };
        if before == 0 || before > self.composed.len() {
            now = Damage::all(size);
        }
        self.composed.iter().take(before).for_each(|damage| now.join(damage));
        let parts = now.rects();
        self.write(surface, size, &parts);
        parts
    }

    /// Writes parts of the window: the picture, straight from the frame, and the panels over it.
    fn write(&self, surface: &mut [u32], size: [u32; 2], parts: &[PixelRect]) {
        let mut window = WindowPixels { size, pixels: surface };
        self.viewer.window().draw_parts(parts, &mut window);
        for part in parts {
            self.overlay.canvas().lay_part_over(canvas_rect(part), window.pixels);
        }
    }

    pub(super) fn window(&self) -> [u32; 2] {
        self.viewer
            .chrome()
            .window_size()
            .map(|side| side.min(Framebuffer::MAX_SIDE))
    }

    /// The picture of the whole window.
    pub(in crate::app) fn picture(&self) -> Framebuffer {
        let size = self.window();
        let mut picture = Framebuffer::new(size[0], size[1]);
        self.write(picture.pixels_mut(), size, &[PixelRect::of_size(size)]);
        for pixel in picture.pixels_mut() {
            *pixel |= 0xff00_0000;
        }
        picture
    }
}

/// Whether a surface has a window's size.
fn fits(size: [u32; 2], surface: &[u32], width: u32) -> bool {
    size[0] == width && surface.len() == size[0] as usize * size[1] as usize
}

/// A part of the window as a part of the overlay.
fn canvas_rect(part: &PixelRect) -> CanvasRect {
    let edge = |at: i64| u32::try_from(at.max(0)).unwrap_or(u32::MAX);
    CanvasRect {
        left: edge(part.x),
        top: edge(part.y),
        right: edge(part.right()),
        bottom: edge(part.bottom()),
    }
}
