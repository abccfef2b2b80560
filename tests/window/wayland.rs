//! Windows on Wayland: a compositor without a screen of its own, weston, stands between the program and the X server, so that
//! real keys go through it and every pixel that it shows can be read.

use rasterscope::raster::SampleRate;
use rasterscope::render::RenderSettings;

use super::desktop::keysym;
use super::program::{Program, SIZE, flat, rendered, until};

/// Side of a square that holds the pointer, which the compositor paints itself, and not always where the X server has it: in
/// points.
const POINTER: u32 = 32;

#[test]
fn windows_on_wayland_show_every_pixel_as_it_was_drawn() {
    let path = flat();
    for scale in [1, 2] {
        let program = Program::start_on_wayland(&path, scale);
        let [width, height] = SIZE.map(|side| side * scale);
        let low = u16::try_from(height - 1).unwrap();
        // The lowest row belongs to the line at the foot.
        until("the first picture", || {
            (program.desktop.part(program.window, [0, low, 1, 1])[..3] != [0; 3]).then_some(())
        });
        // Nothing but the picture.
        program.desktop.press(keysym::TAB, &[]);
        for samples in [1, 4] {
            let settings = RenderSettings {
                sample_rate: SampleRate::new(samples).unwrap(),
                ..RenderSettings::default()
            };
            let expected = rendered(&path, &settings, [width, height]);
            until(&format!("{samples} samples at scale {scale}"), || {
                let (pixels, size) = program.desktop.pixels(program.window)?;
                let differ = (0_usize..).zip(pixels.iter().zip(expected.pixels()));
                let differ = differ.filter(|(_, (shown, drawn))| **shown != **drawn & 0x00ff_ffff);
                let places: Vec<usize> = differ.map(|(i, _)| i).collect();
                let pointer = (POINTER * scale) as usize;
                let below_pointer = |axis: fn(usize, usize) -> usize| {
                    let along = places.iter().map(|place| axis(*place, width as usize));
                    along.clone().max().unwrap_or(0) - along.min().unwrap_or(0) < pointer
                };
                let is_shown = below_pointer(std::ops::Rem::rem) && below_pointer(std::ops::Div::div);
                (size == [width, height] && is_shown).then_some(())
            });
            program.desktop.type_char('=', &[]);
        }
    }
}
