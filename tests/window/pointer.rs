//! The pointer: dragging, the wheel, pinning.

use std::time::Duration;

use glam::DVec2;
use rasterscope::viewer::{Command, InspectorCommand, PointerCommand, ViewCommand, WindowCommand};

use super::desktop::keysym;
use super::program::{Program, SIZE, SMALL_INSET, SMALL_INSET_COMMANDS, flat, inset, until, viewed};

/// Where the tests point, in window pixels.
const AT: [i16; 2] = [180, 150];

/// Lets the program see where the pointer is before a button goes down.
fn settle() {
    std::thread::sleep(Duration::from_millis(60));
}

/// Drags by 35, -21 pixels.
fn drag_along(program: &Program) {
    program.desktop.point(AT[0], AT[1]);
    settle();
    program.desktop.button(1, true);
    for step in 1..=7 {
        program.desktop.point(AT[0] + 5 * step, AT[1] - 3 * step);
    }
    program.desktop.button(1, false);
}

#[test]
fn pointer_drags_the_picture_pixel_by_pixel() {
    let path = flat();
    let program = Program::start_bare(&path);
    program.shows(&viewed(&path, &[]), "the first picture");
    drag_along(&program);
    let moved = [Command::View(ViewCommand::PanBy {
        by: DVec2::new(35.0, -21.0),
    })];
    program.shows(&viewed(&path, &moved), "moved by exactly 35, -21 pixels");
    // Without the button the picture stays.
    program.desktop.point(300, 300);
    settle();
    program.shows(&viewed(&path, &moved), "still there");
}

#[test]
fn pointer_wheel_zooms_about_it() {
    let path = flat();
    let program = Program::start_bare(&path);
    program.shows(&viewed(&path, &[]), "the first picture");
    program.desktop.point(AT[0], AT[1]);
    settle();
    program.desktop.button(4, true);
    program.desktop.button(4, false);
    // A click from XTEST arrives as one or as two events.
    let at = DVec2::new(f64::from(AT[0]), f64::from(AT[1]));
    let zoomed = |clicks| {
        viewed(
            &path,
            &[
                Command::Pointer(PointerCommand::Moved { at }),
                Command::Pointer(PointerCommand::Wheel { clicks }),
            ],
        )
    };
    let (one, two) = (zoomed(1.0), zoomed(2.0));
    let plain = |pixels: &[u32]| pixels.iter().map(|pixel| pixel & 0x00ff_ffff).collect::<Vec<_>>();
    let expected = [plain(one.pixels()), plain(two.pixels())];
    settle();
    until("the zoomed picture", || {
        let (pixels, _) = program.desktop.pixels(program.window)?;
        expected.contains(&pixels).then_some(())
    });
    program.desktop.button(5, true);
    program.desktop.button(5, false);
    program.shows(&viewed(&path, &[]), "and back");
}

#[test]
fn pointer_right_click_pins() {
    let path = flat();
    let program = Program::start_with(&path, &["--do", SMALL_INSET]);
    program.desktop.point(AT[0], AT[1]);
    settle();
    program.desktop.button(3, true);
    program.desktop.button(3, false);
    let pin = [
        &SMALL_INSET_COMMANDS[..],
        &[Command::Inspector(InspectorCommand::Pin(AT.map(i64::from)))],
    ]
    .concat();
    let pinned = inset(&path, &pin);
    program.shows_somewhere(&pinned, "the pixel pinned by a right click");
    program.desktop.point(20, 300);
    settle();
    program.shows_somewhere(&pinned, "it stays while the pointer goes away");
}

#[test]
fn resize_storm_ends_sharp() {
    let path = flat();
    let program = Program::start_bare(&path);
    program.shows(&viewed(&path, &[]), "the first picture");
    for step in 0..60_u32 {
        program.resize([330 + step * 37 % 700, 250 + step * 53 % 600]);
        std::thread::sleep(Duration::from_millis(u64::from(step % 7)));
    }
    for size in [[641, 479], [1333, 777], SIZE] {
        program.resize(size);
        let picture = viewed(&path, &[Command::Window(WindowCommand::Resize(size))]);
        program.shows(&picture, &format!("sharp at {size:?}"));
    }
}

#[test]
fn pointer_that_rests_presses_what_grew_under_it() {
    /// What the menu covers once it is open.
    const COVERED: [u16; 4] = [40, 400, 60, 80];
    let program = Program::open(&[&flat()], &["--theme", "dark"]);
    program.resize([800, 600]);
    // On the button of the menu, before and after.
    program.desktop.point(60, 583);
    for _ in 0..2 {
        program.desktop.press('='.into(), &[keysym::CONTROL]);
        std::thread::sleep(Duration::from_millis(300));
    }
    let closed = program.desktop.part(program.window, COVERED);
    program.desktop.button(1, true);
    program.desktop.button(1, false);
    until("the menu", || {
        (program.desktop.part(program.window, COVERED) != closed).then_some(())
    });
}

#[test]
fn pointer_draws_the_line_of_a_profile_and_leaves_the_picture() {
    let path = flat();
    let program = Program::start_bare(&path);
    program.shows(&viewed(&path, &[]), "the first picture");
    program.desktop.type_char('p', &[keysym::CONTROL, keysym::SHIFT]);
    std::thread::sleep(Duration::from_millis(300));
    for character in "profile on".chars() {
        program.desktop.type_char(character, &[]);
    }
    program.desktop.press(keysym::RETURN, &[]);
    // The palette darkens what it covers; what comes with the line hides nothing there.
    until("the palette has closed", || {
        let (pixels, [width, _]) = program.desktop.pixels(program.window)?;
        (pixels[200 * width as usize + 5] & 0x00ff_ffff == 0x00ff_ffff).then_some(())
    });
    // The panels are there with it, and a drag draws the line.
    std::thread::sleep(Duration::from_millis(300));
    drag_along(&program);
    settle();
    program.desktop.press(keysym::TAB, &[]);
    program.shows(&viewed(&path, &[]), "the picture has not moved");
    drag_along(&program);
    let moved = [Command::View(ViewCommand::PanBy {
        by: DVec2::new(35.0, -21.0),
    })];
    program.shows(&viewed(&path, &moved), "without panels there is no line to draw");
}
