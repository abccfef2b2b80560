//! Windows on Wayland: a compositor without a screen of its own, weston, stands between the program and the X server, so that
//! real keys go through it and every pixel that it shows can be read.

use rasterscope::raster::{Framebuffer, SampleRate};
use rasterscope::render::RenderSettings;

use super::desktop::keysym;
use super::program::{Program, SIZE, flat, rendered, until};

/// Rows at the foot that the pointer's tip may reach into.
const POINTER: u32 = 8;

#[test]
fn windows_on_wayland_show_every_pixel_as_it_was_drawn() {
    let path = flat();
    for scale in [1, 2] {
        let program = Program::start_on_wayland(&path, scale);
        let [width, height] = SIZE.map(|side| side * scale);
        let [right, low] = [width - 1, height - 1].map(|at| u16::try_from(at).unwrap());
        // The lowest row belongs to the line at the foot.
        until("the first picture", || {
            (program.desktop.part(program.window, [0, low, 1, 1])[..3] != [0; 3]).then_some(())
        });
        // Nothing but the picture.
        program.desktop.press(keysym::TAB, &[]);
        // The compositor paints the pointer itself: here below the rows that are compared.
        program.desktop.point(right.cast_signed(), low.cast_signed());
        for samples in [1, 4] {
            let settings = RenderSettings {
                sample_rate: SampleRate::new(samples).unwrap(),
                ..RenderSettings::default()
            };
            let all = rendered(&path, &settings, [width, height]);
            let mut upper = Framebuffer::new(width, height - POINTER);
            let pixels = upper.pixels().len();
            upper.pixels_mut().copy_from_slice(&all.pixels()[..pixels]);
            program.shows_somewhere(&upper, &format!("{samples} samples at scale {scale}"));
            program.desktop.type_char('=', &[]);
        }
    }
}
