//! What a surface shows after any number of partial updates, and how much of it is written.

use std::path::Path;
use std::sync::Arc;

use egui::pos2;
use glam::DVec2;

use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{InspectorCommand, Key, KeyPress, ViewCommand, ViewerOptions};

/// A session on a scene of the gallery, and a surface that its window shows.
struct Desk {
    session: Session,
    surface: Vec<u32>,
    size: [u32; 2],
}

impl Desk {
    fn new(window: [u32; 2]) -> Self {
        let options = ViewerOptions {
            paths: vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/basic/test4.svg")],
            window,
            waker: Arc::new(|| {}),
            ..ViewerOptions::default()
        };
        let viewer = Viewer::new(options).expect("threads");
        let mut session = Session::new(viewer, 1.0, Clock::Simulated(0.0));
        session.settle();
        Self {
            session,
            surface: Vec::new(),
            size: [0, 0],
        }
    }

    /// Brings the surface up to date; the number of pixels that were written.
    fn compose(&mut self) -> u64 {
        let size = self.session.window();
        let age = u8::from(self.size == size);
        if age == 0 {
            self.surface = vec![0x1234_5678; size[0] as usize * size[1] as usize];
            self.size = size;
        }
        let holds = self.session.draw_frame(&mut self.surface, size[0], age);
        let parts = self.session.compose(&mut self.surface, size[0], holds);
        parts
            .iter()
            .map(|part| u64::from(part.width) * u64::from(part.height))
            .sum()
    }

    /// Asserts that the surface shows what a picture made anew shows.
    fn is_right(&self, what: &str) {
        let picture = self.session.picture();
        let plain = |pixel: &u32| pixel & 0x00ff_ffff;
        let same = self.surface.iter().map(plain).eq(picture.pixels().iter().map(plain));
        assert!(same, "{what}");
    }
}

#[test]
fn compose_writes_only_what_changed() {
    let mut desk = Desk::new([1920, 1080]);
    let all = desk.compose();
    assert_eq!(all, 1920 * 1080, "at first everything");
    assert_eq!(desk.compose(), 0, "nothing changed");
    let before = desk.session.viewer.picture_revision();
    let panel = desk.session.interface.covers(pos2(1800.0, 60.0));
    assert!(panel, "the panel lies there");
    // Into the panel, then from button to button.
    desk.session.pointer(Some(DVec2::new(1700.0, 60.0)));
    desk.compose();
    for x in [1720.0, 1760.0, 1800.0, 1850.0] {
        desk.session.pointer(Some(DVec2::new(x, 62.0)));
        let written = desk.compose();
        assert!(written < all / 100, "{written} pixels for a hovered button at {x}");
        desk.is_right("a hovered button");
    }
    assert_eq!(
        desk.session.viewer.picture_revision(),
        before,
        "the scene is left alone"
    );
    desk.session.pointer(Some(DVec2::new(300.0, 300.0)));
    desk.compose();
    desk.session.pointer(Some(DVec2::new(310.0, 300.0)));
    let written = desk.compose();
    assert!(written < all / 20, "{written} pixels for another pixel's numbers");
    desk.is_right("the status line");
}

#[test]
fn compose_lays_panels_over_what_was_drawn_on_the_surface() {
    let mut desk = Desk::new([640, 480]);
    desk.session.lend_surface();
    desk.session
        .command(Command::Inspector(InspectorCommand::Pin([300, 200])));
    let mut drawn = 0;
    // Where other work takes both processors, no frame may be quick for a while.
    for step in 0..200 {
        desk.session.settle();
        desk.session.command(Command::View(ViewCommand::PanBy {
            by: DVec2::new(if step % 2 == 0 { 7.5 } else { -7.5 }, 3.25),
        }));
        let waits = desk.session.viewer.frames().waits_for_surface();
        let shown = desk.session.viewer.frames().frame().map(|frame| frame.picture.clone());
        desk.compose();
        desk.is_right("panels and inset over the frame");
        let is_new = desk.session.viewer.frames().frame().map(|frame| frame.picture.clone()) != shown;
        assert_eq!(is_new, waits, "the frame is there before the panels");
        drawn += u32::from(waits);
        assert_eq!(desk.compose(), 0, "nothing is left to write");
        if drawn > 5 {
            return;
        }
    }
    panic!("{drawn} frames were drawn on the surface");
}

#[test]
fn compose_in_parts_is_the_whole() {
    arbtest::arbtest(|u| {
        let mut desk = Desk::new([640, 480]);
        if u.arbitrary()? {
            desk.session.lend_surface();
        }
        for _ in 0..u.int_in_range(1..=15)? {
            let mut at = |side: u32| Ok(f64::from(u.int_in_range(0..=side)?));
            let point = DVec2::new(at(640)?, at(480)?);
            let session = &mut desk.session;
            match u.int_in_range(0..=9)? {
                0 => session.pointer(None),
                1 | 2 => session.pointer(Some(point)),
                3 => {
                    session.pointer(Some(point));
                    session.button(PointerButton::Primary, true);
                    session.button(PointerButton::Primary, u.arbitrary()?);
                }
                4 => session.wheel(f64::from(u.int_in_range(-2..=2)?)),
                5 => session.resize([u.int_in_range(320..=700)?, u.int_in_range(240..=500)?]),
                6 => session.command(Command::View(ViewCommand::PanBy {
                    by: (point - 200.0).round() / 8.0,
                })),
                7 => session.command(Command::Inspector(InspectorCommand::Pin([
                    u.int_in_range(0..=640)?,
                    u.int_in_range(0..=480)?,
                ]))),
                8 => {
                    let names = ["z", "=", "?", "Tab", "`", "Ctrl+Shift+P", "Escape", "a"];
                    let press = KeyPress::from_name(u.choose(&names)?).expect("a key");
                    // The window would close.
                    if session.viewer.chrome().dialog().is_some() || press.logical != Some(Key::Escape) {
                        session.key(press);
                    }
                }
                _ => session.settle(),
            }
            if u.ratio(2, 3)? {
                desk.session.poll();
                desk.compose();
                desk.is_right("after any part");
            }
        }
        Ok(())
    })
    .budget_ms(3000);
}
