//! The guard of `benches/instructions` bites: made-up counts against made-up baselines.

use std::fs;
use std::path::Path;
use std::process::Command;

const BASELINE: &str = "# a remark\nflat 1000000\ntextured 2000000\n";

/// Whether the guard is content with `counts`, and what it says.
fn compared(counts: &str) -> (bool, String) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let files = [("baseline", BASELINE), ("counts", counts)].map(|(name, text)| {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("a writable folder");
        path
    });
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/instructions/compare");
    let output = Command::new("sh").arg(script).args(files).output().expect("a shell");
    let text = String::from_utf8(output.stdout).expect("text");
    (output.status.success(), text)
}

#[test]
fn instruction_guard_bites_above_five_percent() {
    for (counts, content, words) in [
        ("flat 1000000\ntextured 2000000\n", true, "as before"),
        ("flat 1049000\ntextured 1960000\n", true, "as before"),
        ("flat 1051000\ntextured 2000000\n", false, "5.1 %"),
        ("flat 500000\ntextured 2300000\n", false, "15.0 %"),
        ("flat 900000\ntextured 2000000\n", true, "--bless keeps it so"),
        ("flat 1000000\n", false, "textured was not counted"),
        ("flat 1000000\ntextured 2000000\nnew 5\n", false, "new has no baseline"),
        ("flat 1000000\ntextured\n", false, "not a case and its count"),
        ("", false, "was not counted"),
    ] {
        let (found, text) = compared(counts);
        assert_eq!(found, content, "{counts:?}: {text}");
        assert!(text.contains(words), "{counts:?} says {words}: {text}");
    }
}

#[test]
fn instruction_guard_has_a_baseline() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/instructions/baseline.txt");
    let text = fs::read_to_string(path).expect("the baseline");
    let cases = text.lines().filter(|line| !line.starts_with('#')).count();
    assert!(cases >= 8, "all cases: {text}");
}
