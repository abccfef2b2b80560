//! The dialog of sheets, by real keys.

use std::path::Path;

use rasterscope::app::{ScriptSource, ViewOptions, run};
use rasterscope::figure::Record;
use rasterscope::raster::Framebuffer;

use super::desktop::keysym;
use super::program::{Program, SIZE, flat, until, viewed};

/// The window as the program makes it of a script, without a display.
fn window_after(steps: &str, folder: &Path) -> Framebuffer {
    let file = folder.join("expected.png");
    run(ViewOptions {
        paths: vec![flat()],
        size: Some(SIZE),
        scale: Some(1.0),
        script: Some(ScriptSource::Text(format!("{steps}; shot \"{}\"", file.display()))),
        headless: true,
        grammar: Some(rasterscope::cli::GRAMMAR),
        ..ViewOptions::default()
    })
    .unwrap();
    let picture = image::open(&file).unwrap().into_rgba8();
    let mut frame = Framebuffer::new(picture.width(), picture.height());
    for (to, from) in frame.pixels_mut().iter_mut().zip(picture.pixels()) {
        let [r, g, b, a] = from.0;
        *to = u32::from_be_bytes([a, r, g, b]);
    }
    frame
}

#[cfg(unix)]
#[test]
fn folder_of_saved_pictures_opens_in_the_file_manager() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = tempfile::tempdir().unwrap();
    // What stands for the desktop's file manager writes down what it is to show.
    let (bin, shown) = (folder.path().join("bin"), folder.path().join("shown"));
    std::fs::create_dir(&bin).unwrap();
    let manager = bin.join("xdg-open");
    std::fs::write(
        &manager,
        format!("#!/bin/sh\nprintf %s \"$1\" > '{}'\n", shown.display()),
    )
    .unwrap();
    std::fs::set_permissions(&manager, std::fs::Permissions::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let here = folder.path().canonicalize().unwrap();
    let scene = flat();
    let program = Program::open_where(folder, &[&scene], &["--do", "hide on"], &[("PATH", &path)]);
    program.shows(&viewed(&scene, &[]), "the picture");
    program.desktop.type_char('s', &[]);
    let is_picture = |file: &std::path::PathBuf| file.extension().is_some_and(|ending| ending == "png");
    until("the picture", || {
        let mut files = std::fs::read_dir(&here).unwrap().map(|file| file.unwrap().path());
        files.find(is_picture)
    });
    std::thread::sleep(std::time::Duration::from_millis(300));
    program.desktop.type_char('p', &[keysym::CONTROL, keysym::SHIFT]);
    std::thread::sleep(std::time::Duration::from_millis(300));
    for character in "open-folder".chars() {
        program.desktop.type_char(character, &[]);
    }
    program.desktop.press(keysym::RETURN, &[]);
    let told = until("the file manager", || {
        std::fs::read_to_string(&shown).ok().filter(|told| !told.is_empty())
    });
    assert_eq!(Path::new(&told).canonicalize().unwrap(), here);
}

#[test]
fn keys_put_a_sheet_together_and_save_it() {
    let path = flat();
    let program = Program::start_bare(&path);
    program.shows(&viewed(&path, &[]), "the first picture");
    // Where it lies over no control.
    program.desktop.point(2, 2);
    program.desktop.type_char('s', &[keysym::SHIFT]);
    let elsewhere = tempfile::tempdir().unwrap();
    // What is said of hidden panels is gone by then.
    let expected = window_after("hide on; wait 10000; move 2,2; sheet", elsewhere.path());
    program.shows(&expected, "the dialog with its preview");
    // A key that no line of text wants goes on changing the picture, and the sheet with it.
    program.desktop.type_char('v', &[]);
    let expected = window_after(
        "hide on; wait 10000; move 2,2; sheet; visualise coverage",
        elsewhere.path(),
    );
    program.shows(&expected, "the preview follows");
    program.desktop.press(keysym::ESCAPE, &[]);
    program.desktop.type_char('p', &[keysym::CONTROL, keysym::SHIFT]);
    std::thread::sleep(std::time::Duration::from_millis(300));
    for character in "save-sheet".chars() {
        program.desktop.type_char(character, &[]);
    }
    program.desktop.press(keysym::RETURN, &[]);
    let sheet = until("the sheet", || {
        let mut files = std::fs::read_dir(program.folder.path())
            .unwrap()
            .map(|file| file.unwrap().path());
        files.find(|file| file.extension().is_some_and(|ending| ending == "png") && image::open(file).is_ok())
    });
    let record = Record::of_file(&sheet).unwrap().unwrap();
    assert!(
        record
            .command_line
            .contains(" --sample-rate=1,4,16 --visualise=coverage "),
        "{}",
        record.command_line
    );
    assert!(sheet.with_extension("").join("figures.md").is_file(), "with its panels");
}
