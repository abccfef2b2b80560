//! The window's icon, drawn by ourselves from the drawing that desktops are given.

use winit::window::Icon;

use crate::geometry::View;
use crate::raster::{Framebuffer, SampleRate};
use crate::render::{self, RenderSettings};
use crate::scene::{self, NoResources, ReadOptions};

/// Pixels of a side: what taskbars show at scale 2.
const SIDE: u32 = 64;

/// The icon; `None` where it cannot be drawn, which is no reason to go without a window.
pub(super) fn icon() -> Option<Icon> {
    let document = include_bytes!("../../../assets/linux/rasterscope.svg");
    let scene = scene::read(document, "icon", ReadOptions::default(), &NoResources).ok()?;
    let settings = RenderSettings {
        sample_rate: SampleRate::new(16)?,
        background: crate::color::Rgba::TRANSPARENT,
        outline: false,
        ..RenderSettings::default()
    };
    let mut frame = Framebuffer::new(SIDE, SIDE);
    let view = View::Canvas.transform(scene.canvas, [SIDE; 2]);
    render::draw(&scene, &view, &settings, &mut frame);
    let bytes = frame.pixels().iter().flat_map(|pixel| {
        let [a, r, g, b] = pixel.to_be_bytes();
        [r, g, b, a]
    });
    Icon::from_rgba(bytes.collect(), SIDE, SIDE).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn icon_is_drawn() {
        assert!(icon().is_some());
    }
}
