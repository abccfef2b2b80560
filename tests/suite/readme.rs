//! What the README promises: its key table is the program's, and every option and scene folder is named.

use std::fs;
use std::path::Path;
use std::process::Command;

use rasterscope::viewer::commands;

const START: &str = "<!-- keys: made by the command table, `BLESS=1 cargo test readme` writes it anew -->\n";
const END: &str = "<!-- /keys -->";

#[test]
fn readme_holds_the_key_table_of_the_program() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let text = fs::read_to_string(&path).expect("the README");
    let (before, rest) = text.split_once(START).expect("the table's beginning");
    let (table, after) = rest.split_once(END).expect("the table's end");
    let expected = format!("\n{}\n", commands::markdown().trim());
    if table.trim() == expected.trim() {
        return;
    }
    if std::env::var_os("BLESS").is_some_and(|value| value == "1") {
        fs::write(&path, format!("{before}{START}{expected}\n{END}{after}")).expect("a writable README");
        panic!("the README's key table was written anew");
    }
    panic!("the README's key table is not the program's: run with BLESS=1");
}

#[test]
fn readme_names_every_option_and_scene_folder() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(root.join("README.md")).expect("the README");
    for command in [
        "view", "render", "sheet", "sweep", "writeup", "rerun", "inspect", "diff", "lesson", "bench",
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_rasterscope"))
            .args([command, "--help"])
            .output()
            .expect("help");
        let help = String::from_utf8(output.stdout).expect("text");
        let options = help.split_whitespace().filter_map(|word| word.strip_prefix("--"));
        for option in options.map(|word| word.trim_matches(|c: char| !c.is_alphabetic())) {
            let known = option == "help" || option == "output" || text.contains(&format!("--{option}"));
            assert!(known, "--{option} of {command} is in the README");
        }
    }
    for entry in fs::read_dir(root.join("svg")).expect("scenes") {
        let name = entry
            .expect("a readable entry")
            .file_name()
            .to_string_lossy()
            .into_owned();
        assert!(text.contains(&format!("`svg/{name}`")), "svg/{name} is in the README");
    }
    assert!(
        root.join("assets/screenshot.png").is_file(),
        "the picture at the top is there"
    );
}

#[test]
fn readme_shows_pictures_that_its_commands_make() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = fs::read_to_string(root.join("README.md")).unwrap();
    let mut count = 0;
    for entry in fs::read_dir(root.join("assets/figures")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        let told = rasterscope::figure::Record::of_file(&path).unwrap().unwrap();
        assert!(readme.contains(&format!("(assets/figures/{name})")), "{name} is shown");
        assert!(
            readme.contains(&format!("`{}`", told.command_line)),
            "{}",
            told.command_line
        );
        count += 1;
    }
    assert_eq!(count, 4, "all pictures");
    // Flat colours are the same bytes on every machine.
    let again = Command::new(env!("CARGO_BIN_EXE_rasterscope"))
        .current_dir(root)
        .args(["rerun", "assets/figures/rates.png", "--check"])
        .output()
        .unwrap();
    assert!(again.status.success(), "{again:?}");
}
