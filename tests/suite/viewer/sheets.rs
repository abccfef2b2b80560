//! Sheets that are put together in the window: they are what their command line makes.

use std::path::{Path, PathBuf};

use rasterscope::figure::Record;
use rasterscope::viewer::{
    Axis, Command, Dialog, MessageKind, PanelSize, SceneCommand, SheetChange, SheetCommand, SheetSide, Viewer,
    ViewerOptions, commands,
};

use crate::support::folder::names;
use crate::support::program::{done, run};
use crate::support::session::{Session, TRIANGLES};

/// A session on two triangles that knows the command line.
fn session(window: [u32; 2]) -> Session {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("1.svg");
    std::fs::write(&path, TRIANGLES).unwrap();
    let viewer = Viewer::new(ViewerOptions {
        paths: vec![path],
        window,
        screenshot_dir: Some(folder.path().to_owned()),
        grammar: Some(rasterscope::cli::GRAMMAR),
        ..ViewerOptions::default()
    });
    let mut session = Session {
        viewer: viewer.unwrap(),
        folder,
    };
    session.viewer.finish();
    session
}

/// Runs a command of the table with its argument.
fn say(session: &mut Session, id: &str, argument: &str) {
    let spec = commands::find(id).unwrap();
    let command = match argument {
        "" => spec.command().unwrap().clone(),
        text => spec.argument.unwrap().parse(text).unwrap(),
    };
    session.run(command);
}

fn pixels(path: &Path) -> (u32, u32, Vec<u8>) {
    let picture = image::open(path).unwrap().into_rgba8();
    (picture.width(), picture.height(), picture.into_raw())
}

/// The only sheet that was saved, and the files beside it.
fn saved(session: &Session) -> (PathBuf, Vec<String>) {
    let pictures = session.pictures();
    let sheet = pictures.iter().find(|path| path.to_string_lossy().contains("-sheet"));
    let sheet = sheet
        .unwrap_or_else(|| panic!("{:?}", session.viewer.chrome().messages()))
        .clone();
    let names = names(&sheet.with_extension(""));
    (sheet, names)
}

#[test]
fn sheet_from_the_window_is_that_of_its_command_line() {
    let mut session = session([160, 120]);
    say(&mut session, "pattern", "rotated");
    say(&mut session, "view", "100,50,1.5,10");
    say(&mut session, "pin", "80,60");
    say(&mut session, "sheet-columns", "sample-rate 1,4");
    say(&mut session, "sheet-rows", "pixel-sampling nearest,bilinear");
    say(&mut session, "sheet-note", "Edges are the point.");
    say(&mut session, "sheet-theme", "dark");
    say(&mut session, "save-sheet", "");
    let (sheet, names) = saved(&session);
    let panels = names.iter().filter(|name| name.contains(".png")).count();
    assert_eq!(panels, 4, "{names:?}");
    assert!(
        ["figures.md", "figures.html", "figures.tex"]
            .iter()
            .all(|name| names.contains(&(*name).to_owned())),
        "{names:?}"
    );
    let record = Record::of_file(&sheet).unwrap().unwrap();
    for part in [
        "--sample-rate=1,4 --pixel-sampling=nearest,bilinear --pattern=rotated --size=160x120",
        "--inset 80,60:",
        "--theme dark '--note=Edges are the point'",
    ] {
        assert!(record.command_line.contains(part), "{part}: {}", record.command_line);
    }
    let words: Vec<&str> = record.arguments.iter().map(String::as_str).collect();
    let output = words.iter().position(|word| *word == "-o").unwrap() + 1;
    let mut again = words.clone();
    again[output] = "again.png";
    done(session.folder.path(), &again);
    assert_eq!(
        pixels(&sheet),
        pixels(&session.folder.path().join("again.png")),
        "the same sheet"
    );
    let check = done(
        session.folder.path(),
        &["rerun", sheet.to_str().unwrap(), "--check", "--threads=1"],
    );
    assert!(check.contains("the same"), "{check}");
    let line = session
        .viewer
        .recipes()
        .sheet_command_line(session.viewer.sheet())
        .unwrap();
    let told = record.command_line.split(" --sample-rate").nth(1);
    assert_eq!(
        line.split(" --sample-rate").nth(1),
        told,
        "what is copied makes the same"
    );
}

#[test]
fn panels_of_the_window_are_its_picture() {
    let mut session = session([90, 70]);
    say(&mut session, "rate", "4");
    say(&mut session, "sheet-columns", "sample-rate 1,4");
    say(&mut session, "save-sheet", "");
    session.keys(&["s"]);
    let (sheet, names) = saved(&session);
    let panel = sheet
        .with_extension("")
        .join(names.iter().find(|name| name.contains("rate-4")).unwrap());
    let pictures = session.pictures();
    let shot = pictures.iter().find(|path| **path != sheet).unwrap();
    assert_eq!(pixels(&panel), pixels(shot), "pixel by pixel");
}

#[test]
fn pages_show_the_same_part_and_the_pinned_place() {
    let mut session = session([160, 120]);
    say(&mut session, "view", "100,50,2,0");
    say(&mut session, "pin", "40,30");
    for (panels, width) in [("page", 1890), ("300x200", 630)] {
        say(&mut session, "sheet-panels", panels);
        say(&mut session, "sheet-columns", "sample-rate 1,16");
        say(&mut session, "save-sheet", "");
        let pictures = session.pictures();
        let sheet = pictures.last().unwrap();
        let (wide, ..) = pixels(sheet);
        assert!(wide.abs_diff(width) < 40, "{panels}: {wide} pixels wide");
        let record = Record::of_file(sheet).unwrap().unwrap();
        let scale = 2.0 * f64::from(record.size[0]) / 160.0;
        let scale = scale.min(2.0 * f64::from(record.size[1]) / 120.0);
        let view: Vec<f64> = record.view.split(',').map(|part| part.parse().unwrap()).collect();
        assert!(
            (view[2] - scale).abs() < 1e-9,
            "{panels}: {} shows the same part",
            record.view
        );
        // The centre of pixel (40, 30), seen from (100, 50) at 2 pixels per unit.
        assert!(
            record.command_line.contains(" --inset u80.25,35.25:"),
            "{}",
            record.command_line
        );
    }
}

#[test]
fn sheets_wait_for_their_scene_and_never_replace() {
    let mut session = session([90, 70]);
    for _ in 0..3 {
        let _ = session.viewer.apply(Command::Scenes(SceneCommand::Reload));
        let _ = session.viewer.apply(Command::Sheet(SheetCommand::Save));
    }
    session.viewer.finish();
    let pictures = session.pictures();
    assert_eq!(pictures.len(), 3, "{:?}", session.viewer.chrome().messages());
    let folders = pictures.iter().filter(|path| path.with_extension("").is_dir()).count();
    assert_eq!(folders, 3, "each with its panels");
}

#[test]
fn previews_follow_what_is_set() {
    let mut session = session([300, 200]);
    assert!(session.viewer.sheet().preview().is_none(), "the dialog is closed");
    session.keys(&["Shift+S"]);
    assert_eq!(session.viewer.chrome().dialog(), Some(Dialog::Sheet), "it is open");
    session.run(Command::Sheet(SheetCommand::SetRoom([400, 300])));
    let shown = |session: &Session| {
        let (preview, stale) = session.viewer.sheet().preview().unwrap();
        assert!(!stale, "it was waited for");
        preview.clone()
    };
    let first = shown(&session).unwrap();
    assert_eq!(first.panels, 3, "three rates to begin with");
    let [width, height] = [first.picture.width(), first.picture.height()];
    assert!(
        width == 400 && height < 300,
        "as wide as there is room: {width} x {height}"
    );
    let side = |side, text: &str| {
        let axis = text
            .split_once(' ')
            .map(|(name, values)| Axis::of(name, values).unwrap());
        Command::Sheet(SheetCommand::Change(SheetChange::Axis(side, axis)))
    };
    session.run(side(SheetSide::Rows, "sample-rate 4,9"));
    assert!(
        session.viewer.sheet().draft().columns.is_none(),
        "a setting has one side"
    );
    assert_eq!(shown(&session).unwrap().panels, 2, "only those");
    session.keys(&["v"]);
    let other = shown(&session).unwrap();
    assert!(
        other.size[1] > first.size[1],
        "with a legend, for the picture has one now"
    );
    session.run(side(SheetSide::Columns, "pattern grid,halton"));
    session.run(side(SheetSide::Rows, "sample-rate 4,5"));
    let problem = shown(&session).unwrap_err();
    assert!(
        problem.contains('5') && !problem.contains('\n'),
        "the grid takes squares: {problem}"
    );
    session.run(Command::Sheet(SheetCommand::Change(SheetChange::Panels(
        PanelSize::Exact([9000, 9000]),
    ))));
    session.run(side(SheetSide::Rows, ""));
    assert!(shown(&session).unwrap_err().contains("smaller"), "too large");
    session.run(Command::Sheet(SheetCommand::Save));
    let message = session.viewer.chrome().messages().last().unwrap();
    assert_eq!(message.kind, MessageKind::Error, "{}", message.text);
    assert!(session.pictures().is_empty(), "nothing is left");
    assert_eq!(
        std::fs::read_dir(session.folder.path()).unwrap().count(),
        1,
        "but the scene"
    );
}

#[test]
fn sheets_that_cannot_be_saved_say_so() {
    let mut session = session([90, 70]);
    let gone = session.folder.path().join("1.svg");
    std::fs::remove_file(&gone).unwrap();
    say(&mut session, "sheet-columns", "dialect course,svg");
    say(&mut session, "save-sheet", "");
    let message = session.viewer.chrome().messages().last().unwrap().text.clone();
    assert!(message.contains("1.svg"), "{message}");
    assert_eq!(
        std::fs::read_dir(session.folder.path()).unwrap().count(),
        0,
        "nothing is left"
    );
}

#[test]
fn sheets_by_a_script_of_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let script = "sheet-columns level-sampling zero,linear; sheet-panels 120x90; save-sheet";
    let arguments = [
        "view",
        "gallery:texmap/test4.svg",
        "--headless",
        "--size=200x150",
        "--screenshot-name=T5",
        "--do",
        script,
    ];
    let output = run(folder.path(), &arguments);
    assert!(output.status.success(), "{output:?}");
    let (width, _, _) = pixels(&folder.path().join("T5-sheet.png"));
    assert!(width > 240, "two panels side by side: {width}");
    assert!(folder.path().join("T5-sheet/figures.tex").is_file(), "with snippets");
}
