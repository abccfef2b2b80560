//! Screenshots: which pixels, which names, what happens where none can be written.

use rasterscope::figure::{PixelRect, Record};
use rasterscope::raster::Framebuffer;
use rasterscope::viewer::{AbCommand, ExportCommand, InspectorCommand, ViewCommand, WindowCommand};
use rasterscope::viewer::{Against, Command, Effect, MessageKind, NameTemplate, PixelZoom, Viewer, ViewerOptions};

use crate::support::session::{Session, TRIANGLES, step};

fn read(path: &std::path::Path) -> Vec<[u8; 4]> {
    let picture = image::open(path).unwrap().into_rgba8();
    picture.pixels().map(|pixel| pixel.0).collect()
}

fn rgba(picture: &Framebuffer) -> Vec<[u8; 4]> {
    let all = (0..picture.height()).flat_map(|y| (0..picture.width()).map(move |x| (x, y)));
    all.map(|(x, y)| picture.rgba(x, y).unwrap()).collect()
}

#[test]
fn screenshot_is_the_frame() {
    let mut session = Session::open(&[TRIANGLES], [80, 60]);
    session.run(step("sample-rate", 1.0));
    session.keys(&["s"]);
    let pictures = session.pictures();
    assert_eq!(pictures.len(), 1, "{pictures:?}");
    assert!(read(&pictures[0]) == rgba(session.pixels()), "every pixel");
    let message = session.viewer.chrome().messages().last().unwrap();
    let name = pictures[0].file_name().unwrap().to_str().unwrap();
    assert!(
        message.text.contains(name) && message.text.contains("80 x 60"),
        "{}",
        message.text
    );
    let digits = name.bytes().filter(u8::is_ascii_digit).count();
    assert!(
        name.starts_with("rasterscope-") && digits >= 17,
        "{name} goes from the year to the millisecond"
    );
}

#[test]
fn screenshot_tells_how_it_was_made() {
    let mut session = Session::open(&[TRIANGLES], [80, 60]);
    session.keys(&["=", "s"]);
    let told = |session: &Session, index: usize| Record::of_file(&session.pictures()[index]).unwrap().unwrap();
    let first = told(&session, 0);
    let line = session.viewer.recipes().command_line().unwrap();
    let [before, after] = ["rasterscope render ", " --size 80x60 --view default --sample-rate 4"];
    assert!(
        first.command_line.starts_with(before) && first.command_line.ends_with(after),
        "{first:?}"
    );
    assert!(
        line.ends_with(after) && first.differs.is_none(),
        "the command line of the moment"
    );
    session.run(Command::Ab(AbCommand::Compare(Against::Settings)));
    assert_eq!(first.compared, None);
    session.keys(&["=", "w", "s"]);
    let both = told(&session, 1);
    let (differs, b) = (both.differs.unwrap(), both.compared.unwrap());
    assert!(
        differs.contains("A and B share this picture (wipe 0.5; B: sample-rate 4)"),
        "{differs}"
    );
    assert_eq!(
        (&*b.against, &*b.arrangement, b.picture),
        ("sample-rate 4", "wipe 0.5", None)
    );
    let theirs = session.folder.path().join("theirs.png");
    std::fs::copy(&session.pictures()[0], &theirs).unwrap();
    session.run(Command::Ab(AbCommand::Compare(Against::File(theirs.clone()))));
    session.keys(&["d", "s"]);
    let b = told(&session, 2).compared.expect("a picture from outside");
    assert_eq!(
        (b.against, &*b.arrangement),
        (theirs.display().to_string(), "difference absolute; gain 1")
    );
    let file = b.picture.expect("its file");
    assert_eq!(file.sha256.len(), 64, "{file:?}");
}

#[test]
fn screenshot_of_both_says_which_is_whose() {
    use rasterscope::viewer::Arrangement;
    let mut session = Session::open(&[TRIANGLES], [640, 480]);
    session.run(Command::Ab(AbCommand::Compare(Against::Settings)));
    session.keys(&["="]);
    // Tags lie along the upper edge, white on a ground that darkens what is below.
    let marked = |saved: &[[u8; 4]], shown: &[[u8; 4]], columns: std::ops::Range<usize>| {
        let row = |y: usize| (columns.clone()).map(move |x| y * 640 + x);
        let differs = |at: &usize| saved[*at] != shown[*at];
        let above = (0..60).flat_map(row).filter(differs).count();
        let below = (60..480).flat_map(row).filter(differs).count();
        [above, below]
    };
    let arrangements = [
        (Arrangement::Wipe, [true, true]),
        (Arrangement::SideBySide, [true, true]),
        (Arrangement::Difference, [true, false]),
        (Arrangement::Flip, [false, false]),
    ];
    for (index, (arrangement, halves)) in arrangements.into_iter().enumerate() {
        session.run(Command::Ab(AbCommand::Arrange(arrangement)));
        session.keys(&["s"]);
        let (saved, shown) = (
            read(&session.pictures()[index]),
            rgba(&session.viewer.window().picture()),
        );
        assert_eq!(saved.len(), shown.len(), "{arrangement:?}");
        for (columns, has_tag) in [0..320, 320..640].into_iter().zip(halves) {
            let has_legend = arrangement == Arrangement::Difference && columns.start == 0;
            let [count, below] = marked(&saved, &shown, columns);
            assert_eq!(count > 300, has_tag, "{arrangement:?}: {count} pixels of a tag");
            assert_eq!(
                below > 300,
                has_legend,
                "{arrangement:?}: {below} pixels of what its colours mean"
            );
        }
    }
    session.run(Command::Ab(AbCommand::Arrange(Arrangement::Alone)));
    session.keys(&["s"]);
    assert!(
        read(&session.pictures()[4]) == rgba(session.pixels()),
        "A alone has none"
    );
}

#[test]
fn screenshot_of_both_holds_the_magnifiers_and_nothing_of_panels() {
    use rasterscope::viewer::Arrangement;
    let mut session = Session::open(&[TRIANGLES], [1000, 700]);
    session.run(Command::Ab(AbCommand::Compare(Against::Settings)));
    session.keys(&["="]);
    let free = PixelRect {
        x: 200,
        y: 0,
        width: 800,
        height: 680,
    };
    session.run(Command::Window(WindowCommand::SetFreeArea(Some(free))));
    let arrangements = [Arrangement::Wipe, Arrangement::Difference, Arrangement::SideBySide];
    for (index, arrangement) in arrangements.into_iter().enumerate() {
        session.run(Command::Ab(AbCommand::Arrange(arrangement)));
        session.run(Command::Inspector(InspectorCommand::Pin([190, 320])));
        session.keys(&["s"]);
        let saved = image::open(&session.pictures()[index]).unwrap().into_rgba8();
        let whole = if arrangement == Arrangement::SideBySide {
            (800, 680)
        } else {
            (1000, 700)
        };
        assert_eq!(
            saved.dimensions(),
            whole,
            "{arrangement:?}: what panels cover is cut off"
        );
        let inspector = session.viewer.inspector();
        let places = [inspector.inset(), inspector.other_inset()].map(|placed| placed.expect("both").rect);
        // The ground of the words below a grid is light, the grid of the window is not.
        let plate = saved
            .pixels()
            .filter(|pixel| pixel.0 == [0xf4, 0xf4, 0xf2, 255])
            .count();
        let widths: u32 = places.iter().map(|place| place.width).sum();
        assert!(
            plate > widths as usize * 10,
            "{arrangement:?}: plates for {places:?} have {plate} pixels"
        );
        // The legend of a difference lies on such a plate, too.
        let legend = if arrangement == Arrangement::Difference {
            30_000
        } else {
            0
        };
        assert!(
            plate < widths as usize * 60 + legend,
            "{arrangement:?}: no field without words, {plate} pixels"
        );
    }
}

#[test]
fn picture_that_fills_the_frame_is_saved_with_its_own_record() {
    use rasterscope::viewer::Arrangement;
    let mut session = Session::open(&[TRIANGLES], [80, 60]);
    session.run(Command::Ab(AbCommand::Compare(
        Against::from_text("sample-rate 4").unwrap(),
    )));
    session.run(Command::Ab(AbCommand::Arrange(Arrangement::Alone)));
    let copied = |session: &mut Session| {
        let effects = session.run(Command::Export(ExportCommand::CopyCommandLine));
        let [Effect::CopyText(line)] = &effects[..] else {
            panic!("{effects:?}")
        };
        let said = session.viewer.chrome().messages().last().unwrap().text.clone();
        (
            line.contains("--sample-rate 4"),
            said.starts_with("copied, of A alone: "),
        )
    };
    for (index, of_b) in [true, false].into_iter().enumerate() {
        session.run(Command::Ab(AbCommand::FlipByHand));
        assert_eq!(session.viewer.ab().shows_b(), of_b, "in turn");
        assert_eq!(copied(&mut session), (of_b, false), "of the one that is seen");
        session.keys(&["s"]);
        let file = &session.pictures()[index];
        let record = Record::of_file(file).unwrap().unwrap();
        assert_eq!(record.differs, None, "the command line draws just this");
        assert_eq!(
            record.command_line.contains("--sample-rate 4"),
            of_b,
            "{}",
            record.command_line
        );
        let other = session.viewer.ab().other_pixels().unwrap();
        let shown = if of_b { other } else { session.pixels() };
        assert!(read(file) == rgba(shown), "every pixel");
    }
    session.keys(&["w"]);
    assert_eq!(
        copied(&mut session),
        (false, true),
        "where both share the window it says so"
    );
}

#[test]
fn save_as_makes_the_file_that_was_named_and_replaces_none() {
    let mut session = Session::open(&[TRIANGLES], [80, 60]);
    let elsewhere = tempfile::tempdir().unwrap();
    let file = elsewhere.path().join("figure.png");
    session.run(step("sample-rate", 1.0));
    session.run(Command::Export(ExportCommand::SaveAs(file.clone())));
    assert!(read(&file) == rgba(session.pixels()), "every pixel");
    assert_eq!(Record::of_file(&file).unwrap().unwrap().size, [80, 60]);
    assert!(session.pictures().is_empty(), "nowhere else");
    let last = |session: &Session| session.viewer.chrome().messages().last().unwrap().clone();
    let folder = elsewhere.path().to_str().unwrap();
    let said = last(&session);
    assert_eq!(said.kind, MessageKind::Saved);
    assert!(said.text.ends_with(folder), "{} names the folder", said.text);
    assert_eq!(
        session.run(Command::Export(ExportCommand::OpenFolder)),
        [Effect::OpenFolder(elsewhere.path().to_owned())],
        "the last one"
    );
    let before = std::fs::read(&file).unwrap();
    session.keys(&["="]);
    session.run(Command::Export(ExportCommand::SaveAs(file.clone())));
    let said = last(&session);
    assert_eq!(said.kind, MessageKind::Error);
    assert!(said.text.contains("figure.png: this file exists"), "{}", said.text);
    assert_eq!(std::fs::read(&file).unwrap(), before, "left as it was");
    let proposed = session.viewer.new_picture_path().unwrap();
    assert_eq!(proposed, elsewhere.path().join("1.png"), "named like the scene");
    session.run(Command::Export(ExportCommand::SaveAs(proposed)));
    let next = session.viewer.new_picture_path().unwrap();
    assert_eq!(next, elsewhere.path().join("1-2.png"), "one that is not there yet");
    session.run(Command::Export(ExportCommand::SaveAs(
        elsewhere.path().join("no/such.png"),
    )));
    assert!(last(&session).text.contains("cannot save here"), "{:?}", last(&session));
}

#[test]
fn screenshot_waits_for_the_frame_it_was_asked_for() {
    let mut session = Session::open(&[TRIANGLES], [80, 60]);
    let _ = session
        .viewer
        .apply(Command::View(ViewCommand::RotateBy { degrees: 45.0 }));
    let _ = session.viewer.apply(Command::Export(ExportCommand::Screenshot));
    session.viewer.finish();
    assert!(read(&session.pictures()[0]) == rgba(session.pixels()), "turned");
    session.assert_frame_is_current();
}

#[test]
fn screenshot_holds_the_inset() {
    let mut session = Session::open(&[TRIANGLES], [800, 600]);
    session.run(Command::Inspector(InspectorCommand::Pin([300, 200])));
    session.keys(&["s"]);
    let shot = &session.pictures()[0];
    let told = Record::of_file(shot).unwrap().unwrap();
    let line = session.viewer.recipes().command_line().unwrap();
    assert!(line.ends_with(" --inset 300,200:15@20:auto"), "{line}");
    assert!(
        told.command_line.ends_with(" --inset 300,200:15@20:auto") && told.differs.is_none(),
        "{told:?}"
    );
    let (saved, frame) = (read(shot), rgba(session.pixels()));
    let changed = saved.iter().zip(&frame).filter(|(a, b)| a != b).count();
    // It lies where the scene is empty, so what of it is white changes nothing.
    assert!(changed > 45_000, "an inset of 15 times 21 pixels a side: {changed}");
    assert_eq!(
        saved[200 * 800 + 300],
        frame[200 * 800 + 300],
        "its subject is to be seen"
    );
    let again = std::process::Command::new(env!("CARGO_BIN_EXE_rasterscope"))
        .args(["rerun".as_ref(), shot.as_os_str(), "--check".as_ref()])
        .output()
        .unwrap();
    assert!(again.status.success(), "{again:?}");
    session.run(Command::View(ViewCommand::SetPixelZoom(PixelZoom::new(4).unwrap())));
    session.keys(&["s"]);
    let told = Record::of_file(&session.pictures()[1]).unwrap().unwrap();
    assert_eq!(told.size, [200, 150], "frame pixels");
    assert!(
        told.command_line.contains(" --inset 75,50:"),
        "made to fit: {}",
        told.command_line
    );
}

#[test]
fn screenshots_have_names_of_their_own() {
    let mut session = Session::open(&[TRIANGLES], [8, 8]);
    for _ in 0..30 {
        let _ = session.viewer.apply(Command::Export(ExportCommand::Screenshot));
    }
    session.viewer.finish();
    assert_eq!(session.pictures().len(), 30, "none replaced another");
}

#[test]
fn screenshot_folder_that_is_none() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    std::fs::write(&file, "").unwrap();
    for wrong in [file, folder.path().join("missing")] {
        let options = ViewerOptions {
            window: [8, 8],
            screenshot_dir: Some(wrong.clone()),
            ..ViewerOptions::default()
        };
        let mut viewer = Viewer::new(options).unwrap();
        let _ = viewer.apply(Command::Export(ExportCommand::Screenshot));
        viewer.finish();
        let message = viewer.chrome().messages().last().unwrap();
        assert_eq!(message.kind, MessageKind::Error, "{}", message.text);
        let told = message.text.contains(&wrong.display().to_string()) && message.text.contains("--screenshot-dir");
        assert!(told, "{} names place and cure", message.text);
    }
}

#[test]
fn screenshot_of_the_window_is_asked_for() {
    let mut session = Session::open(&[TRIANGLES], [8, 8]);
    assert_eq!(
        session.run(Command::Export(ExportCommand::WindowScreenshot)),
        [Effect::PictureOfWindow],
        "the window is elsewhere"
    );
    let mut window = Framebuffer::new(3, 3);
    window.pixels_mut().fill(0xff12_3456);
    session.viewer.save_window_picture(window.clone());
    session.viewer.finish();
    assert!(read(&session.pictures()[0]) == rgba(&window), "as given");
    session.viewer.save_window_picture(Framebuffer::new(0, 0));
    session.viewer.finish();
    assert_eq!(session.pictures().len(), 1, "nothing to save");
}

#[test]
fn screenshots_are_whole_when_the_program_ends() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    for _ in 0..5 {
        let _ = session.viewer.apply(Command::Export(ExportCommand::Screenshot));
    }
    let Session { viewer, folder } = session;
    drop(viewer);
    let files: Vec<_> = std::fs::read_dir(folder.path())
        .unwrap()
        .map(|item| item.unwrap().path())
        .collect();
    let pictures = files
        .iter()
        .filter(|path| path.extension().is_some_and(|ending| ending == "png"));
    assert_eq!(
        pictures.map(|path| read(path).len()).collect::<Vec<_>>(),
        [120_000; 5],
        "all five, all whole"
    );
}

#[test]
fn screenshots_are_named_by_a_template() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("gears.svg");
    std::fs::write(&scene, TRIANGLES).unwrap();
    let options = ViewerOptions {
        paths: vec![scene],
        window: [40, 30],
        screenshot_dir: Some(folder.path().to_owned()),
        screenshot_name: NameTemplate::parse("{scene} {rate}spp {pixel}").unwrap(),
        ..ViewerOptions::default()
    };
    let mut viewer = Viewer::new(options).unwrap();
    viewer.finish();
    for command in [
        Command::Export(ExportCommand::Screenshot),
        Command::Export(ExportCommand::Screenshot),
        step("sample-rate", 1.0),
        Command::Export(ExportCommand::Screenshot),
    ] {
        let _ = viewer.apply(command);
        viewer.finish();
    }
    for name in [
        "gears 1spp nearest.png",
        "gears 1spp nearest-2.png",
        "gears 4spp nearest.png",
    ] {
        assert!(folder.path().join(name).is_file(), "{name}");
    }
}

#[test]
fn copy_takes_the_picture_unless_a_pixel_is_inspected() {
    let mut session = Session::open(&[TRIANGLES], [80, 60]);
    let effects = session.run(Command::Export(ExportCommand::Copy));
    let frame = session.pixels().clone();
    assert_eq!(effects, [Effect::CopyPicture(frame)], "what a screenshot saves");
    session.run(Command::Inspector(InspectorCommand::Pin([30, 20])));
    let effects = session.run(Command::Export(ExportCommand::Copy));
    assert!(
        matches!(&effects[..], [Effect::CopyText(text)] if text.starts_with("pixel 30, 20")),
        "{effects:?}"
    );
    let effects = session.run(Command::Export(ExportCommand::CopyPicture));
    assert!(
        matches!(&effects[..], [Effect::CopyPicture(_)]),
        "by name still the picture"
    );
}
