//! What the README and the reference promise: the key table is the program's, every option and scene folder is named.

use std::fs;
use std::path::Path;
use std::process::Command;

use rasterscope::post::PostProcess;
use rasterscope::raster::{PixelCoverage, ResolveFilter, SamplePattern, ShadingRate};
use rasterscope::render::Visualisation;
use rasterscope::texture::{LevelSampling, PixelSampling};
use rasterscope::viewer::{commands, picture};

use crate::support::golden::check_table;

const START: &str = "<!-- keys: made by the command table, `BLESS=1 cargo test readme` writes it anew -->\n";
const END: &str = "<!-- /keys -->";
const STUDY: &str = "<!-- study: made by `benches/study` -->\n";
const STUDY_END: &str = "<!-- /study -->";

#[test]
fn readme_holds_the_key_table_of_the_program() {
    check_table("README.md", [START, END], &commands::markdown());
}

#[test]
fn readme_measures_every_pattern_filter_and_shading_rate() {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).expect("the README");
    let (_, rest) = text.split_once(STUDY).expect("the table's beginning");
    let (table, _) = rest.split_once(STUDY_END).expect("the table's end");
    // The grid, the box and a colour for each sample are one row.
    let rows = (SamplePattern::ALL.iter().map(|pattern| ("pattern", pattern.name())))
        .chain(
            ResolveFilter::ALL
                .iter()
                .skip(1)
                .map(|filter| ("resolve filter", filter.name())),
        )
        .chain(
            ShadingRate::ALL
                .iter()
                .skip(1)
                .map(|shading| ("shading rate", shading.name())),
        )
        .chain([("coverage", PixelCoverage::Exact.name())])
        .chain(PostProcess::ALL.iter().map(|process| ("post-process", process.name())))
        .chain([("pattern", "msaa-16")])
        .chain(LevelSampling::ALL.iter().map(|level| ("level sampling", level.name())))
        .chain(
            PixelSampling::ALL
                .iter()
                .skip(1)
                .map(|sampling| ("pixel sampling", sampling.name())),
        );
    for (axis, name) in rows {
        let row = format!("| {axis} `{name}` | ");
        assert!(table.contains(&row), "{row} is missing: benches/study writes it");
    }
}

/// The pages of the reference by their names, as the program prints them: one for each file.
fn pages() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/cli/help");
    let files = fs::read_dir(folder).unwrap();
    let print = |path: &Path| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let program = Command::new(env!("CARGO_BIN_EXE_rasterscope"))
            .args(["help", &name])
            .output()
            .unwrap();
        assert!(program.status.success(), "{name}: {program:?}");
        (name, String::from_utf8(program.stdout).unwrap())
    };
    files.map(|file| print(&file.unwrap().path())).collect()
}

/// What stands outside of code.
fn prose_of(text: &str) -> String {
    let outside_blocks: String = text.split("```").step_by(2).collect();
    outside_blocks.split('`').step_by(2).collect()
}

#[test]
fn readme_is_short_and_names_every_page_that_the_program_prints() {
    let readme = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).unwrap();
    let (before, rest) = readme.split_once(STUDY).expect("the beginning of the study table");
    let (_, after) = rest.split_once(STUDY_END).expect("its end");
    let lines = [before, after].map(|part| part.lines().count()).iter().sum::<usize>();
    assert!(
        lines <= 200,
        "{lines} lines beside the table that `benches/study` makes"
    );
    let pages = pages();
    let help = help_of(&[]);
    for (name, text) in &pages {
        assert!(text.starts_with("# ") && text.lines().count() > 10, "{name}: {text}");
        assert!(
            readme.contains(&format!("`rasterscope help {name}`")),
            "{name} is in the README"
        );
        assert!(help.contains(&format!("{name}`")), "{name} is in the help: {help}");
        for other in text.split("rasterscope help ").skip(1) {
            let other = other.split('`').next().unwrap();
            assert!(pages.iter().any(|(page, _)| page == other), "{name} leads to {other}");
        }
    }
    assert_eq!(pages.len(), 9, "all pages");
    let (_, keys) = pages.iter().find(|(name, _)| name == "keys").unwrap();
    assert!(keys.contains(commands::markdown().trim()), "the key table");
    let refused = Command::new(env!("CARGO_BIN_EXE_rasterscope"))
        .args(["help", "nothing"])
        .output()
        .unwrap();
    assert_eq!(refused.status.code(), Some(2), "{refused:?}");
}

#[test]
fn readme_names_every_option_and_scene_folder() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut text = fs::read_to_string(root.join("README.md")).expect("the README");
    text.extend(pages().into_iter().map(|(_, page)| page));
    for command in [
        "view", "render", "sheet", "sweep", "writeup", "rerun", "inspect", "diff", "lesson", "bench", "pattern",
        "profile", "spectrum", "board",
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_rasterscope"))
            .args([command, "--help"])
            .output()
            .expect("help");
        let help = String::from_utf8(output.stdout).expect("text");
        let options = help.split_whitespace().filter_map(|word| word.strip_prefix("--"));
        for option in options.map(|word| word.trim_matches(|c: char| !c.is_alphabetic())) {
            let known = option == "help" || option == "output" || text.contains(&format!("--{option}"));
            assert!(known, "--{option} of {command} is in the README or the reference");
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
    assert_eq!(count, 5, "all pictures");
    // Flat colours are the same bytes on every machine.
    let again = Command::new(env!("CARGO_BIN_EXE_rasterscope"))
        .current_dir(root)
        .args(["rerun", "assets/figures/rates.png", "--check"])
        .output()
        .unwrap();
    assert!(again.status.success(), "{again:?}");
}

/// The names of the program's commands, from its help.
fn commands_of_the_program() -> Vec<String> {
    let help = help_of(&[]);
    let (_, list) = help.split_once("Commands:").expect("a list");
    let names = list.lines().map_while(|line| match line.split_whitespace().next() {
        None if line.is_empty() => Some(None),
        name => name
            .filter(|_| line.starts_with("  "))
            .map(|name| Some(name.to_owned())),
    });
    let names: Vec<String> = names
        .flatten()
        .filter(|name| name != "help" && !name.starts_with('-'))
        .collect();
    assert!(names.len() > 5, "{names:?}");
    names
}

fn help_of(words: &[&str]) -> String {
    let program = Command::new(env!("CARGO_BIN_EXE_rasterscope"))
        .args(words)
        .arg("--help")
        .output()
        .unwrap();
    String::from_utf8(program.stdout).unwrap()
}

#[test]
fn readme_lists_every_command() {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).unwrap();
    let (_, rest) = text.split_once("## Command line").expect("the chapter");
    let list = rest.split("```").nth(1).expect("the list");
    for name in commands_of_the_program() {
        let start = format!("rasterscope {name} ");
        let optional = format!("rasterscope [{name}] ");
        assert!(
            list.contains(&start) || list.contains(&optional),
            "{name} is in the list"
        );
    }
}

/// One spelling in everything that people read. Names of the interface, such as fields of JSON, stand in code.
#[test]
fn readme_and_help_say_colour() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = fs::read_to_string(root.join("README.md")).unwrap();
    let mut texts = vec![
        ("README".to_owned(), prose_of(&readme)),
        ("table of commands".to_owned(), commands::markdown()),
    ];
    texts.extend(pages().iter().map(|(name, page)| (name.clone(), prose_of(page))));
    for command in commands_of_the_program() {
        texts.push((format!("help of {command}"), help_of(&[&command])));
    }
    for spec in commands::all() {
        let usage = spec
            .argument
            .map_or(String::new(), |argument| argument.usage().into_owned());
        texts.push((
            spec.id.to_owned(),
            format!("{} {} {} {usage}", spec.name, spec.help, spec.more),
        ));
    }
    for file in fs::read_dir(root.join("assets/lessons")).unwrap() {
        let path = file.unwrap().path();
        texts.push((path.display().to_string(), fs::read_to_string(&path).unwrap()));
    }
    for (place, text) in texts {
        let mut words = text.split(|letter: char| !letter.is_alphanumeric() && letter != '-' && letter != '_');
        let other = words.find(|word| {
            let word = word.to_lowercase();
            ["color", "colors", "colored", "coloring"].contains(&word.as_str())
        });
        assert_eq!(other, None, "{place}");
    }
}

#[test]
fn help_has_man_pages_of_the_program_and_of_every_command() {
    let print = |words: &[&str]| {
        let program = Command::new(env!("CARGO_BIN_EXE_rasterscope"))
            .args(words)
            .output()
            .unwrap();
        assert!(program.status.success(), "{words:?}: {program:?}");
        String::from_utf8(program.stdout).unwrap()
    };
    let whole = print(&["help", "man"]);
    assert!(whole.contains(".TH rasterscope 1"), "{whole}");
    for command in commands_of_the_program() {
        assert!(
            whole.contains(&format!("rasterscope\\-{command}(1)")),
            "{command} is listed: {whole}"
        );
        let page = print(&["help", "man", &command]);
        assert!(page.contains(&format!(".TH rasterscope-{command} 1")), "{page}");
        for line in help_of(&[&command])
            .lines()
            .filter_map(|line| line.trim().strip_prefix("--"))
        {
            let option = line.split_whitespace().next().unwrap().replace('-', "\\-");
            assert!(page.contains(&option), "{command}: {option} is in {page}");
        }
    }
}

#[test]
fn help_has_completions_of_every_command_and_option() {
    let program = env!("CARGO_BIN_EXE_rasterscope");
    let print = |shell: &str| {
        let printed = Command::new(program)
            .args(["help", "completions", shell])
            .output()
            .unwrap();
        assert!(printed.status.success(), "{shell}: {printed:?}");
        String::from_utf8(printed.stdout).unwrap()
    };
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = print(shell);
        for command in commands_of_the_program() {
            assert!(script.contains(&command), "{shell}: {command}");
            for line in help_of(&[&command])
                .lines()
                .filter_map(|line| line.trim().strip_prefix("--"))
            {
                let option = line.split_whitespace().next().unwrap();
                assert!(script.contains(option), "{shell}: {command} --{option}");
            }
        }
    }
    let refused = Command::new(program)
        .args(["help", "completions", "tcsh"])
        .output()
        .unwrap();
    let line = String::from_utf8(refused.stderr).unwrap();
    assert_eq!(refused.status.code(), Some(2), "{line}");
    assert!(line.contains("tcsh") && line.contains("zsh"), "{line}");
    let asked = Command::new(program).args(["help", "completions"]).output().unwrap();
    let line = String::from_utf8(asked.stderr).unwrap();
    assert_eq!(asked.status.code(), Some(2), "{line}");
    assert!(line.contains("which shell") && line.contains("zsh"), "{line}");
}

#[cfg(target_os = "linux")]
#[test]
fn completions_complete_in_a_shell() {
    let answer = |ask: &str| {
        let ask = format!("source <(\"$0\" help completions bash); {ask}");
        let answer = Command::new("bash")
            .args(["-c", &ask, env!("CARGO_BIN_EXE_rasterscope")])
            .output()
            .unwrap();
        String::from_utf8_lossy(&answer.stdout).trim().to_owned()
    };
    let option = "COMP_WORDS=(rasterscope render --patt); COMP_CWORD=2; \
                  _rasterscope rasterscope --patt render; echo \"${COMPREPLY[@]}\"";
    assert_eq!(answer(option), "--pattern");
    let page = "COMP_WORDS=(rasterscope help op); COMP_CWORD=2; \
                _rasterscope rasterscope op help; echo \"${COMPREPLY[@]}\"";
    assert_eq!(answer(page), "options");
    let setting = "COMP_WORDS=(rasterscope board --vary patt); COMP_CWORD=3; \
                   _rasterscope rasterscope patt --vary; echo \"${COMPREPLY[@]}\"";
    assert_eq!(answer(setting), "pattern");
}

#[test]
fn help_tells_every_setting_and_every_pattern() {
    let pages = pages();
    let page = |name: &str| &pages.iter().find(|(page, _)| page == name).unwrap().1;
    for setting in picture::all() {
        let row = format!("| `--{}` | ", setting.option);
        let line = page("options").lines().find(|line| line.starts_with(&row)).unwrap();
        for name in setting.names() {
            assert!(line.contains(&format!("`{name}`")), "{line}");
        }
    }
    for pattern in SamplePattern::ALL {
        let row = format!("| `{}` | {}", pattern.name(), pattern.description());
        assert!(page("pixels").contains(&row), "{row}");
    }
    for kind in Visualisation::ALL {
        let row = format!("| `{}` | {}", kind.name(), kind.meaning());
        assert!(page("pixels").contains(&row), "{row}");
    }
    for (name, text) in &pages {
        assert!(!text.contains("<!--"), "{name} has no gap");
    }
}
