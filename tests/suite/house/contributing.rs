//! What CONTRIBUTING.md names is there: files, folders, programs, and the values that it says are listed by hand. The
//! changelog says everything once.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use rasterscope::raster::SamplePattern;

/// Top folders, by which a path is told from other words in code.
const FOLDERS: [&str; 8] = [
    ".ci/",
    "assets/",
    "benches/",
    "examples/",
    "fuzz/",
    "src/",
    "svg/",
    "tests/",
];

/// The words in code that are meant to be paths of the project, with their lines.
fn paths(text: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    let mut in_block = false;
    for (number, line) in (1..).zip(text.lines()) {
        if line.starts_with("```") {
            in_block = !in_block;
        }
        let code: Vec<&str> = if in_block {
            vec![line]
        } else {
            line.split('`').skip(1).step_by(2).collect()
        };
        let words = code.into_iter().flat_map(str::split_whitespace);
        let is_path = |word: &&str| {
            let is_text = ["md", "toml"]
                .iter()
                .any(|ending| Path::new(word).extension().is_some_and(|e| e == *ending));
            is_text || FOLDERS.iter().any(|folder| word.starts_with(folder))
        };
        found.extend(words.filter(is_path).map(|word| (number, word)));
    }
    found
}

#[test]
fn contributing_names_files_that_are_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for name in ["CONTRIBUTING.md", "CHANGELOG.md"] {
        let text = fs::read_to_string(root.join(name)).unwrap();
        let missing: Vec<String> = paths(&text)
            .into_iter()
            .filter(|(_, path)| !root.join(path).exists())
            .map(|(line, path)| format!("{name}:{line}: there is no {path}"))
            .collect();
        assert!(missing.is_empty(), "{}", missing.join("\n"));
    }
    let text = fs::read_to_string(root.join("CONTRIBUTING.md")).unwrap();
    assert!(paths(&text).len() > 40, "the paths were found");
}

/// The entries of a list, each in one line; an entry goes on in lines that are indented.
fn bullets(text: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let mut is_open = false;
    for line in text.lines() {
        if let Some(words) = line.strip_prefix("- ") {
            found.push(words.to_owned());
            is_open = true;
        } else if let Some(last) = found.last_mut().filter(|_| is_open && line.starts_with("  ")) {
            last.push(' ');
            last.push_str(line.trim());
        } else {
            is_open = false;
        }
    }
    found
}

/// A change belongs to one version.
#[test]
fn changelog_has_every_entry_once() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let entries = bullets(&fs::read_to_string(root.join("CHANGELOG.md")).unwrap());
    assert!(entries.len() > 40, "the entries were found");
    let mut seen = BTreeSet::new();
    let twice: Vec<&String> = entries.iter().filter(|entry| !seen.insert(*entry)).collect();
    assert!(twice.is_empty(), "{twice:#?}");
    let text = "- one\n  entry\n- another\n\n## [0.1.0]\n\n- one entry\n";
    assert_eq!(bullets(text), ["one entry", "another", "one entry"]);
}

#[test]
fn contributing_check_bites() {
    let text = "see `src/no.rs`, `cargo run`, `benches/frozen/run --bless`\n```sh\nbench svg/a.svg --frames 2\n```\n`CHANGELOG.md`";
    let found = [
        (1, "src/no.rs"),
        (1, "benches/frozen/run"),
        (3, "svg/a.svg"),
        (5, "CHANGELOG.md"),
    ];
    assert_eq!(paths(text), found);
}

/// The tables of additions list every file of the crate that names an existing value: here the pattern `r2`.
#[test]
fn contributing_lists_every_file_that_a_pattern_touches() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(root.join("CONTRIBUTING.md")).unwrap();
    let (_, rest) = text.split_once("### ... a sample pattern").unwrap();
    let (part, _) = rest.split_once("\n###").unwrap();
    let name = SamplePattern::R2.name();
    let names_it = |source: &str| {
        let product = source.split("#[cfg(test)]").next().unwrap_or("");
        let mut words = product.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
        words.any(|word| word == "R2")
            || product.contains(&format!("|{name}"))
            || product.contains(&format!(", {name}\""))
    };
    let mut open = vec![root.join("src")];
    let mut touched = 0;
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|ending| ending == "rs") && names_it(&fs::read_to_string(&path).unwrap())
        {
            let inner = path.strip_prefix(root).unwrap().to_str().unwrap().replace('\\', "/");
            assert!(part.contains(&format!("`{inner}`")), "{inner} knows the pattern {name}");
            touched += 1;
        }
    }
    assert!(touched >= 2, "enumeration and positions at least");
}
