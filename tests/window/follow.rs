//! A file that another program saves while the window shows it.

use std::fs;

use super::program::{Program, flat, viewed};

#[test]
fn saved_file_is_shown_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.svg");
    let scene = |fill: &str| {
        format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100"><rect x="10" y="20" width="60" height="50" fill="{fill}"/></svg>"#
        )
    };
    fs::write(&file, scene("#d1495b")).unwrap();
    let program = Program::start_bare(&file);
    program.shows(&viewed(&file, &[]), "the file as it was");
    // As editors do it: another file takes its name.
    let draft = folder.path().join("scene.svg~");
    fs::write(&draft, scene("#1f6feb")).unwrap();
    fs::rename(&draft, &file).unwrap();
    program.shows(&viewed(&file, &[]), "the file as it was saved");
    // A file is read while it is written: what is wrong with half of it is soon forgotten.
    fs::write(&file, "<svg").unwrap();
    std::thread::sleep(std::time::Duration::from_millis(600));
    fs::write(&file, fs::read(flat()).unwrap()).unwrap();
    program.shows(&viewed(&file, &[]), "mended");
}
