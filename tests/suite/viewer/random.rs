//! Any commands in any order: no panic, no hang, and the frame shows the state.

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use arbtest::arbitrary::{Result, Unstructured};
use glam::{DVec2, dvec2};
use rasterscope::raster::Framebuffer;
use rasterscope::viewer::{
    BoardCommand, Command, ExportCommand, InspectorCommand, PixelRect, PointerButton, PointerCommand, ProfileCommand,
    SceneCommand, ViewCommand, ViewNumbers, Viewer, ViewerOptions, WindowCommand, commands,
};

use crate::support::session::{SQUARE, Session, TRIANGLES, step};

/// A number, often one that breaks things.
fn number(u: &mut Unstructured<'_>) -> Result<f64> {
    let odd = [
        0.0,
        -1.0,
        1e-300,
        1e300,
        f64::MAX,
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        -0.0,
    ];
    if u.ratio(1, 4)? {
        return Ok(*u.choose(&odd)?);
    }
    Ok(f64::from(u.int_in_range(-4000..=4000)?) / 16.0)
}

fn point(u: &mut Unstructured<'_>) -> Result<DVec2> {
    Ok(dvec2(number(u)?, number(u)?))
}

fn whole(u: &mut Unstructured<'_>) -> Result<i64> {
    let odd = [0, 1, -1, i64::MAX, i64::MIN, 10];
    if u.ratio(1, 2)? {
        Ok(*u.choose(&odd)?)
    } else {
        u.int_in_range(-100..=100)
    }
}

/// Commands that hands make, and some with numbers that no hand makes.
fn command(u: &mut Unstructured<'_>) -> Result<Command> {
    let buttons = [PointerButton::Primary, PointerButton::Secondary];
    Ok(match u.int_in_range(0..=20)? {
        0 => Command::Pointer(PointerCommand::Moved { at: point(u)? }),
        1 => Command::Pointer(PointerCommand::Pressed(*u.choose(&buttons)?)),
        2 => Command::Pointer(PointerCommand::Released(*u.choose(&buttons)?)),
        3 => Command::Pointer(PointerCommand::Wheel { clicks: number(u)? }),
        4 => Command::Pointer(PointerCommand::Pinch { factor: number(u)? }),
        5 => Command::View(ViewCommand::PanBy { by: point(u)? }),
        6 => Command::View(ViewCommand::ZoomAt {
            at: Some(point(u)?),
            factor: number(u)?,
        }),
        7 => Command::View(ViewCommand::RotateBy { degrees: number(u)? }),
        8 => Command::View(ViewCommand::Set(ViewNumbers {
            center: point(u)?,
            scale: number(u)?,
            rotation: number(u)?,
        })),
        9 => Command::Window(WindowCommand::Resize([
            u.int_in_range(0..=40)?,
            u.int_in_range(0..=40)?,
        ])),
        10 => Command::Inspector(InspectorCommand::Pin([whole(u)?, whole(u)?])),
        11 => Command::Inspector(InspectorCommand::Nudge([whole(u)?, whole(u)?])),
        12 => Command::Inspector(InspectorCommand::SetMagnification(u.arbitrary()?)),
        13 => Command::Inspector(InspectorCommand::SetRegion(u.arbitrary()?)),
        14 => Command::Inspector(InspectorCommand::StepMagnification(u.arbitrary()?)),
        15 => Command::Window(WindowCommand::SetFreeArea(Some(PixelRect {
            x: whole(u)?,
            y: whole(u)?,
            width: u.arbitrary()?,
            height: u.int_in_range(0..=50)?,
        }))),
        16 => Command::Pointer(PointerCommand::Left),
        17 => Command::Scenes(SceneCommand::Show(u.int_in_range(0..=4)?)),
        18 => Command::Profile(ProfileCommand::SetLine([
            [whole(u)?, whole(u)?],
            [whole(u)?, whole(u)?],
        ])),
        19 => Command::Board(match u.int_in_range(0..=3)? {
            0 => BoardCommand::AddA,
            1 => BoardCommand::Remove(u.arbitrary()?),
            2 => BoardCommand::MakeA(u.int_in_range(0..=9)?),
            _ => BoardCommand::SetSide(u.arbitrary()?),
        }),
        _ => {
            let spec = u.choose(commands::all())?;
            let command = spec.command_of_key(u.choose_index(spec.keys.len().max(1))?);
            // Whoever saves pictures in a loop fills the disk; screenshots have tests of their own.
            let saves = [
                Command::Export(ExportCommand::Screenshot),
                Command::Board(BoardCommand::Save),
            ];
            let harmless = command.filter(|command| !saves.contains(command));
            harmless.unwrap_or(step("sample-rate", -1.0))
        }
    })
}

/// Takes down what is done and ends the tests where that never ends: a test that hangs says neither where nor why. Dropping
/// what it returns calls it off.
fn watch() -> Sender<String> {
    let (tell, told) = channel::<String>();
    let watch = move || {
        let mut done = Vec::new();
        loop {
            match told.recv_timeout(Duration::from_mins(2)) {
                Ok(step) => done.push(step),
                Err(RecvTimeoutError::Disconnected) => return,
                Err(RecvTimeoutError::Timeout) => {
                    let _ = writeln!(io::stderr(), "the viewer waits for ever after {}", done.join(", "));
                    std::process::abort();
                }
            }
        }
    };
    thread::Builder::new().name("watch".to_owned()).spawn(watch).unwrap();
    tell
}

#[test]
fn random_commands_never_break_the_viewer() {
    let session = Session::open(&[TRIANGLES, "<svg", SQUARE], [40, 30]);
    let paths: Vec<PathBuf> = (1..=3)
        .map(|n| session.folder.path().join(format!("{n}.svg")))
        .collect();
    arbtest::arbtest(|u| {
        let options = ViewerOptions {
            paths: paths.clone(),
            window: [40, 30],
            ..ViewerOptions::default()
        };
        let mut viewer = Viewer::new(options).unwrap();
        let mut drawn: Option<(u64, Framebuffer)> = None;
        let watched = watch();
        for _ in 0..u.int_in_range(1..=40)? {
            let command = command(u)?;
            let _ = watched.send(format!("{command:?}"));
            let _ = viewer.apply(command);
            let _ = (
                viewer.pixels().status(),
                viewer.both().title(),
                viewer.recipes().command_line(),
            );
            let _ = viewer.pixels().pixel_labels([1.0, 1.0]);
            let _ = (viewer.profile().places(), viewer.profile().curves());
            let _ = (viewer.board().words(), viewer.board().tiles());
            match u.int_in_range(0..=3)? {
                0 => viewer.finish(),
                1 => _ = viewer.poll(),
                2 => {
                    let now = (viewer.picture_revision(), viewer.window().picture());
                    let is_told = drawn
                        .as_ref()
                        .is_none_or(|(revision, picture)| *revision != now.0 || *picture == now.1);
                    assert!(is_told, "other pixels have another revision");
                    drawn = Some(now);
                }
                _ => {}
            }
        }
        viewer.finish();
        assert!(viewer.is_settled(), "finished is finished");
        let size = viewer.both().layout().frame_size();
        if viewer
            .scene_list()
            .current()
            .is_some_and(|entry| entry.scene().is_some())
            && !size.contains(&0)
        {
            let frame = viewer.frames().frame().expect("a frame for a scene");
            assert_eq!(
                [frame.pixels.width(), frame.pixels.height()],
                size,
                "the frame fits the window"
            );
            assert_eq!(
                frame.picture.settings,
                viewer.settings().render,
                "the frame shows the settings"
            );
        }
        Ok(())
    })
    .budget_ms(2000);
}

#[test]
fn random_keys_alone() {
    arbtest::arbtest(|u| {
        let mut session = Session::open(&[TRIANGLES, SQUARE], [30, 20]);
        for _ in 0..u.int_in_range(1..=30)? {
            let spec = u.choose(commands::all())?;
            if spec.id != "screenshot"
                && let Some(command) = spec.command()
            {
                let _ = session.viewer.apply(command);
            }
        }
        session.viewer.finish();
        Ok(())
    })
    .budget_ms(500);
}
