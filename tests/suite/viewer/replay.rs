//! Commands replayed without a window: state and pixels.

use glam::dvec2;
use rasterscope::color::ResolveSpace;
use rasterscope::raster::{SamplePattern, SampleRate};
use rasterscope::rules::Rules;
use rasterscope::scene::DialectChoice;
use rasterscope::texture::{LevelSampling, PixelSampling};
use rasterscope::viewer::{Command, Dialog, Effect, MessageKind, PixelZoom, PointerButton, Toggle, ViewNumbers};
use rasterscope::viewer::{ExportCommand, InspectorCommand, PointerCommand, SceneCommand, ViewCommand, WindowCommand};

use crate::support::session::{SQUARE, Session, TRIANGLES, set, step};

#[test]
fn replay_every_change_reaches_the_frame() {
    let mut session = Session::open(&[TRIANGLES, SQUARE], [160, 120]);
    session.assert_frame_is_current();
    let mut before = session.pixels().clone();
    let steps = [
        step("sample-rate", 1.0),
        Command::View(ViewCommand::PanBy { by: dvec2(7.0, -3.0) }),
        Command::View(ViewCommand::ZoomAt {
            at: Some(dvec2(30.0, 40.0)),
            factor: 2.5,
        }),
        Command::View(ViewCommand::RotateBy { degrees: 30.0 }),
        Command::View(ViewCommand::Fit),
        Command::View(ViewCommand::ActualSize),
        Command::Scenes(SceneCommand::Next),
        set("rules", Rules::Course.name()),
        Command::Window(WindowCommand::Resize([90, 70])),
        Command::View(ViewCommand::SetPixelZoom(PixelZoom::new(3).unwrap())),
        Command::Scenes(SceneCommand::Previous),
        Command::View(ViewCommand::Reset),
    ];
    for step in steps {
        session.run(step.clone());
        session.assert_frame_is_current();
        assert!(*session.pixels() != before, "{step:?} changes the picture");
        before = session.pixels().clone();
    }
}

#[test]
fn replay_the_courses_keys() {
    let mut session = Session::open(&[TRIANGLES], [64, 64]);
    session.keys(&["=", "=", "-", "p", "l", "l"]);
    let render = session.viewer.settings().render;
    assert_eq!(render.sample_rate.samples(), 4, "1 4 9 4");
    assert_eq!(render.pixel_sampling, PixelSampling::Bilinear, "P");
    assert_eq!(render.level_sampling, LevelSampling::Linear, "zero, nearest, linear");
    session.keys(&["p", "p", "p", "p", "l", "l", "l", "l", "-", "-"]);
    let render = session.viewer.settings().render;
    assert_eq!(render.pixel_sampling, PixelSampling::Nearest, "round");
    assert_eq!(render.level_sampling, LevelSampling::Zero, "round");
    assert_eq!(render.sample_rate, SampleRate::ONE, "not below one");
    assert!(
        session.viewer.both().title().starts_with("1.svg - sample rate 1 - "),
        "{}",
        session.viewer.both().title()
    );
}

#[test]
fn replay_drag_moves_pixels_with_the_pointer() {
    let mut session = Session::open(&[TRIANGLES], [160, 120]);
    session.run(Command::View(ViewCommand::ActualSize));
    let before = session.pixels().clone();
    for command in [
        Command::Pointer(PointerCommand::Moved { at: dvec2(50.0, 60.0) }),
        Command::Pointer(PointerCommand::Pressed(PointerButton::Primary)),
        Command::Pointer(PointerCommand::Moved { at: dvec2(53.0, 61.0) }),
        Command::Pointer(PointerCommand::Moved { at: dvec2(62.0, 55.0) }),
        Command::Pointer(PointerCommand::Released(PointerButton::Primary)),
        Command::Pointer(PointerCommand::Moved { at: dvec2(90.0, 90.0) }),
    ] {
        session.run(command);
    }
    // Moved by (12, -5) in all, and no further after the button went up.
    for y in 0..115 {
        for x in 12..160 {
            let (now, then) = (session.pixels().rgba(x, y), before.rgba(x - 12, y + 5));
            assert_eq!(now, then, "pixel {x}, {y}");
        }
    }
}

#[test]
fn replay_wheel_zooms_about_the_pointer() {
    let mut session = Session::open(&[TRIANGLES], [160, 120]);
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(40.5, 30.5) }));
    let before = session.viewer.pixels().status().unwrap();
    session.run(Command::Pointer(PointerCommand::Wheel { clicks: 3.0 }));
    let after = session.viewer.pixels().status().unwrap();
    assert!(
        after.scale > before.scale * 1.9,
        "up is in: {} to {}",
        before.scale,
        after.scale
    );
    assert!(
        after.user.abs_diff_eq(before.user, 1e-9),
        "{} moved to {}",
        before.user,
        after.user
    );
    assert_eq!(before.pixel, [40, 30], "the pixel under the pointer");
}

#[test]
fn replay_each_scene_keeps_its_view() {
    let mut session = Session::open(&[TRIANGLES, SQUARE], [160, 120]);
    session.run(Command::View(ViewCommand::PanBy { by: dvec2(5.0, 9.0) }));
    let first = session.viewer.both().view_numbers().unwrap();
    session.keys(&["2"]);
    assert_eq!(
        session.viewer.scene_list().current_index(),
        1,
        "2 shows the second scene"
    );
    assert!(
        session.viewer.scene_list().current().unwrap().camera.is_default(),
        "its own view"
    );
    session.run(Command::View(ViewCommand::RotateBy { degrees: 10.0 }));
    session.keys(&["PageDown"]);
    assert_eq!(
        session.viewer.both().view_numbers(),
        Some(first),
        "round to the first, as it was"
    );
    session.keys(&["9"]);
    assert_eq!(session.viewer.scene_list().current_index(), 0, "there is no ninth");
    session.keys(&["Space"]);
    assert!(
        session.viewer.scene_list().current().unwrap().camera.is_default(),
        "Space resets"
    );
}

#[test]
fn replay_pixel_zoom_shows_the_same_part() {
    let mut session = Session::open(&[TRIANGLES], [160, 120]);
    session.run(Command::View(ViewCommand::Set(ViewNumbers {
        center: dvec2(60.0, 50.0),
        scale: 4.0,
        rotation: 0.0,
    })));
    session.run(Command::View(ViewCommand::SetPixelZoom(PixelZoom::new(2).unwrap())));
    let numbers = session.viewer.both().view_numbers().unwrap();
    assert_eq!(
        (session.pixels().width(), session.pixels().height()),
        (80, 60),
        "half the pixels"
    );
    assert!((numbers.scale - 2.0).abs() < 1e-12, "half the scale: {numbers:?}");
    let window = session.viewer.window().picture();
    for (x, y) in [(0, 0), (81, 7), (159, 119)] {
        assert_eq!(
            window.rgba(x, y),
            session.pixels().rgba(x / 2, y / 2),
            "{x}, {y} magnified"
        );
    }
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(81.0, 7.0) }));
    assert_eq!(session.viewer.pixels().hovered(), Some([40, 3]), "frame pixels");
}

#[test]
fn replay_escape_closes_one_thing_at_a_time() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    session.keys(&["z"]);
    session.run(Command::Inspector(InspectorCommand::Pin([10, 20])));
    session.keys(&["Tab", "?"]);
    assert_eq!(session.viewer.chrome().dialog(), Some(Dialog::Help), "help is open");
    session.keys(&["Ctrl+G"]);
    assert_eq!(
        session.viewer.chrome().dialog(),
        Some(Dialog::GoToPixel),
        "one dialog at a time"
    );
    let state = |session: &Session| {
        let viewer = &session.viewer;
        let inspector = viewer.inspector().magnifier();
        (
            viewer.chrome().dialog().is_some(),
            viewer.pixels().pinned().is_some(),
            inspector.open,
            viewer.chrome().everything_hidden(),
        )
    };
    for expected in [
        (false, true, true, true),
        (false, true, true, false),
        (false, false, true, false),
        (false, false, false, false),
    ] {
        assert_eq!(session.run(Command::Window(WindowCommand::Escape)), [], "not yet");
        assert_eq!(state(&session), expected, "dialog, pin, inspector, hidden");
    }
    assert_eq!(
        session.run(Command::Window(WindowCommand::Escape)),
        [],
        "nothing is open any more: it asks"
    );
    assert_eq!(
        session.run(Command::Window(WindowCommand::Escape)),
        [Effect::Quit],
        "and ends"
    );
}

#[test]
fn replay_escape_asks_before_it_ends() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    let questions = |session: &Session| {
        let asked = |message: &&rasterscope::viewer::Message| message.kind == MessageKind::Question;
        session.viewer.chrome().messages().iter().filter(asked).count()
    };
    assert_eq!(session.run(Command::Window(WindowCommand::Escape)), [], "it asks");
    let text = session
        .viewer
        .chrome()
        .messages()
        .last()
        .map(|message| message.text.clone());
    assert_eq!(text.as_deref(), Some("Esc again ends the program"));
    session.keys(&["z"]);
    assert_eq!(
        session.run(Command::Window(WindowCommand::Escape)),
        [],
        "the inspector was open"
    );
    assert_eq!(
        session.run(Command::Window(WindowCommand::Escape)),
        [],
        "another thing was closed: it asks anew"
    );
    assert_eq!(questions(&session), 1, "one question at a time");
    assert_eq!(
        session.run(Command::Window(WindowCommand::Escape)),
        [Effect::Quit],
        "the answer"
    );
    assert_eq!(
        session.run(Command::Window(WindowCommand::Quit)),
        [Effect::Quit],
        "Ctrl+Q never asks"
    );
}

#[test]
fn replay_broken_scene_leaves_the_others_usable() {
    let mut session = Session::open(&[TRIANGLES, "<svg", SQUARE], [64, 64]);
    session.keys(&["2"]);
    let entry = session.viewer.scene_list().current().unwrap();
    let problem = entry.failure().expect("no scene").to_owned();
    assert!(problem.contains("2.svg"), "{problem} names the file");
    assert!(!problem.contains('\n'), "{problem} is one line");
    let message = session.viewer.chrome().messages().last().unwrap();
    assert_eq!(
        (message.kind, &message.text),
        (MessageKind::Error, &problem),
        "the user is told"
    );
    assert!(
        session.viewer.frames().frame().is_none(),
        "no picture of another scene under this name"
    );
    for command in [
        Command::View(ViewCommand::PanBy { by: dvec2(1.0, 1.0) }),
        Command::View(ViewCommand::Fit),
        Command::Export(ExportCommand::CopyCommandLine),
    ] {
        session.run(command);
    }
    session.keys(&["3"]);
    session.assert_frame_is_current();
    session.keys(&["2"]);
    std::fs::write(session.folder.path().join("2.svg"), TRIANGLES).unwrap();
    session.keys(&["F5"]);
    session.assert_frame_is_current();
}

#[test]
fn replay_reload_and_dialect_read_again() {
    let mut session = Session::open(&[TRIANGLES], [64, 64]);
    session.run(Command::View(ViewCommand::PanBy { by: dvec2(3.0, 0.0) }));
    let numbers = session.viewer.both().view_numbers();
    std::fs::write(
        session.folder.path().join("1.svg"),
        TRIANGLES.replace("#1f6feb", "#00ff00"),
    )
    .unwrap();
    let before = session.pixels().clone();
    session.keys(&["Ctrl+R"]);
    assert!(*session.pixels() != before, "the new colours");
    session.assert_frame_is_current();
    assert_eq!(session.viewer.both().view_numbers(), numbers, "the view stays");
    session.run(set("dialect", DialectChoice::Course.name()));
    let scene = session.viewer.scene_list().current().unwrap().scene().unwrap();
    assert_eq!(scene.dialect.name(), "course", "read as asked");
}

#[test]
fn replay_thumbnails_come_when_asked_for() {
    let mut session = Session::open(&[TRIANGLES, "<svg", SQUARE], [64, 64]);
    for index in 0..4 {
        session.viewer.request_thumbnail(index);
    }
    session.viewer.finish_thumbnails();
    let sizes: Vec<Option<[u32; 2]>> = session
        .viewer
        .scene_list()
        .scenes()
        .iter()
        .map(|entry| {
            entry
                .thumbnail
                .as_ref()
                .map(|picture| [picture.width(), picture.height()])
        })
        .collect();
    assert_eq!(
        sizes,
        [Some([160, 80]), None, Some([160, 160])],
        "as the canvas, none for a broken scene"
    );
}

#[test]
fn replay_copies() {
    let mut session = Session::open(&[TRIANGLES], [64, 48]);
    session.run(Command::Inspector(InspectorCommand::Pin([32, 24])));
    let effects = session.run(Command::Export(ExportCommand::CopyPixel));
    let status = session.viewer.pixels().status().unwrap();
    assert_eq!(
        effects,
        [Effect::CopyText(status.to_string())],
        "what the status line says"
    );
    assert!(status.to_string().starts_with("pixel 32, 24  user 10"), "{status}");
    let line = session.viewer.recipes().command_line().unwrap();
    let path = session.folder.path().join("1.svg");
    let expected = format!(
        "rasterscope render {} -o 1.png --size 64x48 --view default",
        path.display()
    );
    assert_eq!(line, expected, "all defaults");
    session.keys(&["=", "p", "l"]);
    session.run(set("rules", Rules::Course.name()));
    session.run(Command::View(ViewCommand::Set(ViewNumbers {
        center: dvec2(-1.5, 2.25),
        scale: 0.1,
        rotation: -30.0,
    })));
    let line = session.viewer.recipes().command_line().unwrap();
    let options = "--size 64x48 --view=-1.5,2.25,0.1,-30 --sample-rate 4 --pixel-sampling bilinear \
                   --level-sampling nearest --rules course";
    assert!(line.ends_with(options), "{line}");
    session.keys(&["t", "t", "m", "m", "m", ",", ",", ","]);
    session.run(step("lod-per", 1.0));
    session.run(step("lod-by", 1.0));
    session.run(step("pyramid", 1.0));
    session.run(step("pyramid-filter", 1.0));
    session.run(step("shading-rate", 1.0));
    let line = session.viewer.recipes().command_line().unwrap();
    let options = "--anisotropy 4 --lod-bias -1.5 --lod-level 2 --lod-per sample --lod-by area --pyramid linear --pyramid-filter tent --rules course";
    assert!(line.ends_with(options), "{line}");
    assert!(line.contains("--sample-rate 4 --shading-rate centre --pixel"), "{line}");
    let title = session.viewer.both().title();
    // There is no texture that the others would change.
    assert!(
        title.contains(" - sample rate 4, shading rate centre, rules course - "),
        "{title}"
    );
    session.keys(&[".", ".", "."]);
    session.run(set("lod-level", "auto"));
    session.run(set("anisotropy", "1"));
    session.run(step("lod-per", 1.0));
    session.run(set("lod-by", "longer"));
    session.run(set("pyramid", "stored"));
    session.run(set("pyramid-filter", "box"));
    session.run(set("shading-rate", "sample"));
    let line = session.viewer.recipes().command_line().unwrap();
    assert!(!line.contains("shading-rate"), "{line}");
    assert!(line.ends_with("--level-sampling nearest --rules course"), "{line}");
}

#[test]
fn replay_steps_through_patterns_and_tells_which_rates_they_refuse() {
    let mut session = Session::open(&[TRIANGLES], [64, 48]);
    session.keys(&["=", "a", "a"]);
    let render = |session: &Session| session.viewer.settings().render;
    assert_eq!(render(&session).pattern, SamplePattern::Jittered, "the third");
    assert!(
        session
            .viewer
            .both()
            .title()
            .contains("sample rate 4, pattern jittered - "),
        "{}",
        session.viewer.both().title()
    );
    let line = session.viewer.recipes().command_line().unwrap();
    assert!(line.contains(" --sample-rate 4 --pattern jittered"), "{line}");
    session.assert_frame_is_current();
    session.keys(&["a", "a", "a", "a"]);
    session.run(set("sample-rate", "5"));
    assert_eq!(render(&session).sample_rate.samples(), 5, "halton takes any number");
    assert!(session.viewer.chrome().messages().is_empty(), "nothing to tell");
    session.assert_frame_is_current();
    session.keys(&["a", "a", "a", "a", "a", "a"]);
    assert_eq!(render(&session).pattern, SamplePattern::Grid, "round and round");
    assert_eq!(
        render(&session).sample_rate.samples(),
        4,
        "the nearest that a grid takes"
    );
    let told = session.viewer.chrome().messages()[0].text.clone();
    assert_eq!(
        told,
        "pattern grid takes a square number of samples, not 5; 4 is nearest, and random, halton, hammersley, sobol, sobol-same, \
         blue-noise and r2 take any",
        "in one line"
    );
    session.run(set("sample-rate", "8"));
    assert_eq!(render(&session).sample_rate.samples(), 9, "also when typed");
    session.run(step("resolve", 1.0));
    assert_eq!(render(&session).resolve, ResolveSpace::Linear, "the other one");
    assert!(
        session.viewer.both().title().contains("resolve linear"),
        "{}",
        session.viewer.both().title()
    );
    let line = session.viewer.recipes().command_line().unwrap();
    assert!(line.ends_with(" --resolve linear"), "{line}");
    session.assert_frame_is_current();
    session.run(set("resolve", ResolveSpace::Stored.name()));
    session.keys(&["a"]);
    let (rotated, rate) = (render(&session).pattern, render(&session).sample_rate.samples());
    assert_eq!(
        (rotated, rate),
        (SamplePattern::Rotated, 9),
        "keys keep a rate that fits"
    );
}

#[test]
fn replay_gallery_without_paths() {
    let mut session = Session::open(&[], [64, 64]);
    assert!(!session.viewer.scene_list().scenes().is_empty(), "the built-in gallery");
    session.assert_frame_is_current();
    session.run(Command::Scenes(SceneCommand::Open(vec![
        session.folder.path().to_owned(),
    ])));
    assert_eq!(session.viewer.chrome().messages().len(), 1, "an empty folder is told");
    session.assert_frame_is_current();
}

#[test]
fn replay_opening_keeps_the_other_scenes() {
    let mut session = Session::open(&[SQUARE, SQUARE], [64, 64]);
    let count = session.viewer.scene_list().scenes().len();
    let broken = session.folder.path().join("broken.svg");
    std::fs::write(&broken, "<svg").unwrap();
    session.run(Command::Scenes(SceneCommand::Open(vec![
        session.folder.path().join("nowhere.svg"),
    ])));
    assert_eq!(
        session.viewer.scene_list().scenes().len(),
        count,
        "a missing file changes nothing"
    );
    assert_eq!(session.viewer.chrome().messages().len(), 1, "but is told");
    for _ in 0..2 {
        session.run(Command::Scenes(SceneCommand::Open(vec![broken.clone()])));
        assert_eq!(
            session.viewer.scene_list().scenes().len(),
            count + 1,
            "added once, at the end"
        );
        assert_eq!(session.viewer.scene_list().current_index(), count, "and shown");
    }
    assert!(
        session.viewer.scene_list().current().unwrap().failure().is_some(),
        "as broken as it is"
    );
    session.run(Command::Scenes(SceneCommand::Previous));
    session.assert_frame_is_current();
    std::fs::write(&broken, SQUARE).unwrap();
    session.run(Command::Scenes(SceneCommand::Open(vec![broken])));
    session.assert_frame_is_current();
    let left: Vec<_> = session
        .viewer
        .chrome()
        .messages()
        .iter()
        .filter(|m| m.text.contains("broken.svg"))
        .collect();
    assert!(left.is_empty(), "repaired, so nothing is wrong any more: {left:?}");
}

#[test]
#[cfg(unix)]
fn replay_command_line_makes_the_same_picture() {
    let mut session = Session::open(&[TRIANGLES], [90, 70]);
    for command in [
        step("sample-rate", 1.0),
        Command::View(ViewCommand::ZoomAt {
            at: Some(dvec2(20.0, 30.0)),
            factor: 1.7,
        }),
        Command::View(ViewCommand::RotateBy { degrees: 17.0 }),
        set("background", "#0ac81e"),
        Command::View(ViewCommand::SetPixelZoom(PixelZoom::new(2).unwrap())),
    ] {
        session.run(command);
    }
    let line = session.viewer.recipes().command_line().unwrap();
    let program = std::path::Path::new(env!("CARGO_BIN_EXE_rasterscope"));
    let mut folders = vec![program.parent().unwrap().to_owned()];
    folders.extend(std::env::split_paths(&std::env::var_os("PATH").unwrap_or_default()));
    let status = std::process::Command::new("sh")
        .args(["-c", &line])
        .env("PATH", std::env::join_paths(folders).unwrap())
        .current_dir(session.folder.path())
        .status()
        .unwrap();
    assert!(status.success(), "{line}");
    let picture = image::open(session.folder.path().join("1.png")).unwrap().into_rgba8();
    assert_eq!(picture.dimensions(), (45, 35), "{line}");
    let same = |(x, y, pixel): (u32, u32, &image::Rgba<u8>)| session.pixels().rgba(x, y) == Some(pixel.0);
    assert!(picture.enumerate_pixels().all(same), "{line} makes another picture");
}

#[test]
fn replay_hide_leaves_only_the_picture() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    session.run(Command::Inspector(InspectorCommand::Pin([200, 150])));
    session.keys(&["Tab"]);
    assert!(
        session.viewer.chrome().everything_hidden() && session.viewer.inspector().inset().is_none(),
        "no inset"
    );
    assert!(
        session.viewer.window().picture() == *session.pixels(),
        "nothing but the frame"
    );
    session.keys(&["Tab"]);
    assert_eq!(
        session.viewer.pixels().pinned(),
        Some([200, 150]),
        "comes back as it was"
    );
    session.keys(&["Tab", "z"]);
    assert!(
        !session.viewer.chrome().everything_hidden(),
        "what is asked for is shown"
    );
    assert!(session.viewer.inspector().inset().is_some(), "the inspector");
}

#[test]
fn replay_newest_request_wins() {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    let woken = Arc::new(AtomicUsize::new(0));
    let count = Arc::clone(&woken);
    let options = rasterscope::viewer::ViewerOptions {
        window: [300, 200],
        waker: Arc::new(move || _ = count.fetch_add(1, Ordering::SeqCst)),
        ..Default::default()
    };
    let mut viewer = rasterscope::viewer::Viewer::new(options).unwrap();
    viewer.finish();
    woken.store(0, Ordering::SeqCst);
    for _ in 0..200 {
        let _ = viewer.apply(Command::View(ViewCommand::RotateBy { degrees: 0.25 }));
    }
    viewer.finish();
    let frames = woken.load(Ordering::SeqCst);
    // The waker is called after the result is sent: the one for the first frame may come late.
    assert!((1..=3).contains(&frames), "{frames} frames were drawn for 200 requests");
    let rotation = viewer.both().view_numbers().unwrap().rotation;
    assert!((rotation - 50.0).abs() < 1e-9, "all of them count: {rotation}");
    assert!(!viewer.poll(), "nothing is left to take in");
}

#[test]
fn replay_revisions_tell_what_to_draw() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(10.0, 10.0) }));
    let revisions = |session: &Session| (session.viewer.revision(), session.viewer.picture_revision());
    let before = revisions(&session);
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(10.0, 10.0) }));
    session.run(Command::Window(WindowCommand::Resize([400, 300])));
    assert_eq!(revisions(&session), before, "nothing new");
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(11.0, 10.0) }));
    let moved = revisions(&session);
    assert!(moved.0 > before.0, "the status line changes");
    assert_eq!(moved.1, before.1, "the pixels do not");
    for command in [
        Command::Inspector(InspectorCommand::Show(Toggle::On)),
        Command::Pointer(PointerCommand::Moved {
            at: dvec2(200.0, 150.0),
        }),
        step("sample-rate", 1.0),
        Command::Inspector(InspectorCommand::StepMagnification(1)),
    ] {
        let (picture, window) = (session.viewer.picture_revision(), session.viewer.window().picture());
        session.run(command.clone());
        assert!(
            session.viewer.window().picture() != window,
            "{command:?} changes pixels"
        );
        assert!(session.viewer.picture_revision() > picture, "{command:?} says so");
    }
}

/// The list shows what F5 read, as the picture does.
#[test]
fn replay_reload_draws_the_thumbnail_again() {
    let mut session = Session::open(&[TRIANGLES, SQUARE], [200, 150]);
    session.viewer.request_thumbnail(0);
    session.viewer.finish_thumbnails();
    let thumbnail = |session: &Session| {
        session.viewer.scene_list().scenes()[0]
            .thumbnail
            .clone()
            .expect("drawn")
    };
    let before = thumbnail(&session);
    std::fs::write(session.folder.path().join("1.svg"), SQUARE).unwrap();
    session.run(Command::Scenes(SceneCommand::Reload));
    session.viewer.finish_thumbnails();
    let after = thumbnail(&session);
    assert!(*before != *after, "the new document");
    // Shown again much later, when it was let go, a file may have changed too.
    std::fs::write(session.folder.path().join("1.svg"), TRIANGLES).unwrap();
    session.run(Command::Scenes(SceneCommand::Reload));
    session.viewer.finish_thumbnails();
    assert!(*before == *thumbnail(&session), "and back");
}
