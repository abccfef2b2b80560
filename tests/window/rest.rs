//! The window comes to rest and hears the mouse: whatever its size, its theme and what it was opened with.
//!
//! A layout that depends on what it decided itself never rests, and swallows the clicks on what it lays out anew.

use std::path::Path;
use std::time::{Duration, Instant};

use super::program::{Program, flat, until};

/// From the smallest to a large one; many near the heights where the side panel changes its layout.
const SIZES: [[u32; 2]; 14] = [
    [480, 360],
    [800, 600],
    [1024, 768],
    [1366, 768],
    [1280, 795],
    [1280, 800],
    [1590, 800],
    [1200, 830],
    [1280, 850],
    [1440, 900],
    [1280, 950],
    [1680, 1050],
    [1920, 1080],
    [700, 1150],
];
/// From the window's right edge to the middle of the buttons for 1 and 4 samples per pixel, and from its upper edge.
const RATES: [u32; 2] = [238, 207];
const RATES_DOWN: u32 = 63;
/// No thread wakes for so long: longer than any animation pauses between its frames.
const QUIET: Duration = Duration::from_millis(150);
/// The longest that the window may take to come to rest, on a busy machine too.
const PATIENCE: Duration = Duration::from_secs(20);

#[test]
fn rest_and_clicks_bare() {
    rests_and_hears(None);
}

#[test]
fn rest_and_clicks_with_a_folder() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/study");
    rests_and_hears(Some(&folder));
}

#[test]
fn rest_and_clicks_with_a_file() {
    rests_and_hears(Some(&flat()));
}

#[test]
fn rest_and_clicks_with_notes() {
    let folder = tempfile::tempdir().unwrap();
    // The reader has something to say about each of these lines: the report takes its place in the panel, too.
    let odd: Vec<String> = (0..12).map(|i| format!("<odd{i}/>\n")).collect();
    let odd = odd.concat();
    let file = folder.path().join("notes.svg");
    let scene = format!("<svg width='100' height='100'>\n{odd}<colortri points='0,0 9,0 0,9'/></svg>");
    std::fs::write(&file, scene).unwrap();
    rests_and_hears(Some(&file));
}

#[test]
fn rest_the_bar_takes_no_clicks_from_what_is_beside_it() {
    /// The choice `linear` of the row `Resolve`, which one sample would not need: the last pixels of its button, from the window's right edge.
    const LINEAR: [u32; 2] = [14, 387];
    let program = Program::open(&[&flat()], &["--theme", "dark", "--do", "rate 4; panel on"]);
    let size = [1280, 800];
    program.resize(size);
    rests(&program, "before");
    let button = [size[0] - LINEAR[0], LINEAR[1]];
    let [x, y] = button.map(|at| i16::try_from(at).unwrap());
    // The bar grows when the pointer comes near.
    program.desktop.point(x - 3, y - 10);
    rests(&program, "near the bar");
    program.desktop.point(x, y);
    rests(&program, "at the button's edge");
    program.desktop.button(1, true);
    program.desktop.button(1, false);
    until("the click's effect", || {
        (colour_beside(&program, button) == [44, 104, 186]).then_some(())
    });
}

/// At every size and in both themes: a click on a sample rate takes effect, and then nothing happens any more.
fn rests_and_hears(path: Option<&Path>) {
    for (theme, accent) in [("dark", [44, 104, 186]), ("light", [36, 98, 184])] {
        let paths: Vec<&Path> = path.into_iter().collect();
        let program = Program::open(&paths, &["--theme", theme, "--do", "panel on"]);
        for (i, size) in SIZES.into_iter().enumerate() {
            let what = format!("{path:?} at {size:?}, {theme}");
            program.resize(size);
            program.desktop.point(40, 200);
            rests(&program, &what);
            // Every other time the rate that it has not.
            let button = [size[0] - RATES[(i + 1) % 2], RATES_DOWN];
            assert_ne!(
                colour_beside(&program, button),
                accent,
                "{what}: chosen before the click"
            );
            let [x, y] = button.map(|at| i16::try_from(at).unwrap());
            program.desktop.point(x, y);
            // A hand waits, too, before it presses.
            std::thread::sleep(Duration::from_millis(40));
            program.desktop.button(1, true);
            program.desktop.button(1, false);
            until(&format!("{what}: the click's effect"), || {
                (colour_beside(&program, button) == accent).then_some(())
            });
            program.desktop.point(40, 200);
            rests(&program, &what);
        }
    }
}

/// Waits until no thread of the program wakes any more.
fn rests(program: &Program, what: &str) {
    let start = Instant::now();
    loop {
        let before = wakes(program.id());
        std::thread::sleep(QUIET);
        if wakes(program.id()) == before {
            return;
        }
        assert!(start.elapsed() < PATIENCE, "{what}: the window does not come to rest");
    }
}

/// How often the process's threads were woken after waiting for something.
fn wakes(process: u32) -> u64 {
    let tasks = std::fs::read_dir(format!("/proc/{process}/task")).unwrap();
    let of_task = |task: std::io::Result<std::fs::DirEntry>| {
        // A thread may end in between.
        let status = std::fs::read_to_string(task.ok()?.path().join("status")).ok()?;
        let line = status
            .lines()
            .find_map(|line| line.strip_prefix("voluntary_ctxt_switches:"))?;
        line.trim().parse::<u64>().ok()
    };
    tasks.filter_map(of_task).sum()
}

/// The colour of a button beside its word.
fn colour_beside(program: &Program, [x, y]: [u32; 2]) -> [u8; 3] {
    let at = [x - 10, y + 6].map(|at| u16::try_from(at).unwrap());
    match program.desktop.part(program.window, [at[0], at[1], 1, 1])[..] {
        [b, g, r, ..] => [r, g, b],
        _ => [0; 3],
    }
}
