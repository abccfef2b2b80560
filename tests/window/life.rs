//! How the program starts, rests and ends.

use std::process::Command as Process;
use std::time::Duration;

use rasterscope::viewer::Command;

use super::desktop::keysym;
use super::program::{Program, flat, until, viewed};

#[test]
fn close_ends_with_success() {
    let mut program = Program::start(&flat());
    program.close();
    assert!(program.ended().success(), "the window was closed");
}

#[test]
fn next_session_begins_as_the_last_one_ended() {
    /// Inside the card that greets newcomers, beside its words, and what the pixel there is in the dark theme.
    const CARD: [u16; 4] = [72, 200, 1, 1];
    const DARK: [u8; 3] = [36, 32, 30];
    const LIGHT: [u8; 3] = [244, 246, 246];
    /// Inside the line at the foot.
    const FOOT: [u16; 4] = [3, 397, 1, 1];
    let part = |program: &Program, at| program.desktop.part(program.window, at);
    let mut program = Program::open(&[], &["--theme", "dark"]);
    until("the card", || part(&program, CARD).starts_with(&DARK).then_some(()));
    program.desktop.press('='.into(), &[keysym::CONTROL]);
    until("no card after a key", || {
        (!part(&program, CARD).starts_with(&DARK)).then_some(())
    });
    program.close();
    assert!(program.ended().success(), "the first session");
    let file = "config/rasterscope/session.toml";
    let text = |program: &Program| std::fs::read_to_string(program.folder.path().join(file)).unwrap();
    let first = text(&program);
    assert!(
        first.contains("greeted = true") && first.contains("interface-scale = 110"),
        "{first}"
    );
    let written = first.replace("greeted", "theme = \"light\"\ngreeted");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(file);
    std::fs::create_dir_all(file.parent().unwrap()).unwrap();
    std::fs::write(&file, &written).unwrap();
    let mut program = Program::open_in(folder, &[], &[]);
    until("the theme that was chosen", || {
        part(&program, FOOT).starts_with(&LIGHT).then_some(())
    });
    assert!(!part(&program, CARD).starts_with(&LIGHT), "nobody is greeted twice");
    program.close();
    assert!(program.ended().success(), "the second session");
    assert_eq!(text(&program), written, "nothing was changed");
}

#[test]
fn settings_and_place_are_those_of_the_last_session() {
    let path = flat();
    let mut program = Program::start_bare(&path);
    let command = |option: &str, value: &str| Command::set(option, value).unwrap();
    let left = [command("sample-rate", "4"), command("pattern", "rotated")];
    program.desktop.press('='.into(), &[]);
    program.desktop.press('a'.into(), &[]);
    program.shows(&viewed(&path, &left), "other settings");
    program.place([90, 60]);
    // The settings are on the screen; nothing shows that the place was told.
    std::thread::sleep(Duration::from_millis(700));
    program.close();
    assert!(program.ended().success(), "the first session");
    let file = "config/rasterscope/session.toml";
    let text = std::fs::read_to_string(program.folder.path().join(file)).unwrap();
    for line in [
        "place = [90, 60]",
        "[settings]",
        "pattern = \"rotated\"",
        "sample-rate = \"4\"",
    ] {
        assert!(text.lines().any(|written| written == line), "{line} in {text}");
    }
    let next = |arguments: &[&str]| {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join(file);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(file, &text).unwrap();
        let program = Program::open_in(folder, &[&path], arguments);
        program.desktop.point(250, 200);
        program.desktop.press(keysym::TAB, &[]);
        program
    };
    let program = next(&[]);
    program.shows(&viewed(&path, &left), "the settings of the last session");
    assert_eq!(program.placed(), [90, 60], "where the last one was");
    let program = next(&["--sample-rate", "1"]);
    program.shows(&viewed(&path, &left[1..]), "what the command line asks for");
    let program = next(&["--no-config"]);
    program.shows(&viewed(&path, &[]), "nothing is taken up");
}

#[test]
#[cfg(target_os = "linux")]
fn desktop_that_changes_its_scale_has_larger_panels() {
    /// The line at the foot, 27 points high: a pixel that is in it at scale 2, and the picture's at scale 1.
    const ABOVE: [u16; 4] = [3, 400 - 45, 1, 1];
    let program = Program::start_with(&flat(), &["--theme", "dark"]);
    let foot = || program.desktop.part(program.window, [3, 397, 1, 1]);
    let above = |size: [u32; 2]| {
        program.desktop.pixels(program.window).filter(|(_, now)| *now == size)?;
        Some(program.desktop.part(program.window, ABOVE))
    };
    let line = until("the line at the foot", || {
        Some(foot()).filter(|pixel| (10..60).contains(&pixel[0]))
    });
    assert_ne!(until("the picture", || above([500, 400])), line, "the line is low");
    program.desktop.set_dots_per_inch(192);
    // The window grows with the scale; its hand makes it small again.
    until("a window of twice the size", || above([1000, 800]));
    program.resize([500, 400]);
    until("a line of twice the height", || {
        above([500, 400]).filter(|pixel| *pixel == line)
    });
    program.desktop.set_dots_per_inch(96);
    until("a window of half the size", || {
        above([250, 200]).or_else(|| above([320, 240]))
    });
    program.resize([500, 400]);
    until("the line as it was", || {
        above([500, 400]).filter(|pixel| *pixel != line)
    });
}

#[test]
#[cfg(unix)]
fn signals_end_with_one_line_and_nothing_is_forgotten() {
    for (number, name) in [(15, "SIGTERM"), (1, "SIGHUP"), (2, "Ctrl+C")] {
        let mut program = Program::open(&[], &[]);
        program.desktop.press('='.into(), &[keysym::CONTROL]);
        // The key has no other effect that could be waited for.
        std::thread::sleep(Duration::from_millis(700));
        let id = program.id().to_string();
        let sent = Process::new("kill")
            .args([&format!("-{number}"), &id])
            .status()
            .unwrap();
        assert!(sent.success(), "{name} is sent");
        assert_eq!(program.ended().code(), Some(128 + number), "as shells tell {name}");
        let line = program.errors();
        assert!(
            line.starts_with(&format!("rasterscope: stopped by {name}")) && line.lines().count() == 1,
            "{line}"
        );
        let session = program.folder.path().join("config/rasterscope/session.toml");
        let session = std::fs::read_to_string(session).unwrap();
        assert!(session.contains("interface-scale = 110"), "{name}: {session}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn compositor_that_has_ended_leaves_x11() {
    let folder = tempfile::tempdir().unwrap();
    let runtime = folder.path().display().to_string();
    let variables = [("WAYLAND_DISPLAY", "wayland-9"), ("XDG_RUNTIME_DIR", runtime.as_str())];
    let mut program = Program::open_where(folder, &[&flat()], &[], &variables);
    program.close();
    assert!(program.ended().success(), "a window was opened and closed");
}

#[test]
fn desktop_finds_name_and_icon() {
    let mut program = Program::start(&flat());
    let class = program.desktop.property(program.window, "WM_CLASS");
    assert_eq!(class, b"rasterscope\0rasterscope\0", "as in the desktop file");
    let icon = program.desktop.property(program.window, "_NET_WM_ICON");
    assert_eq!(icon.len(), (2 + 64 * 64) * 4, "width, height, pixels");
    let middle = 4 * (2 + 36 * 64 + 37);
    assert_eq!(
        icon[middle..middle + 4],
        [10, 214, 255, 255],
        "the lens's yellow dot, B G R A"
    );
    program.close();
    assert!(program.ended().success());
}

#[test]
fn escape_twice_ends_when_nothing_is_open() {
    let mut program = Program::start_bare(&flat());
    program.shows(&viewed(&flat(), &[]), "the first picture");
    // The first shows the panels again, the second asks.
    for _ in 0..3 {
        program.desktop.press(keysym::ESCAPE, &[]);
    }
    assert!(program.ended().success(), "Esc ends");
}

#[test]
fn escape_closes_a_list_and_then_asks_for_two_seconds() {
    /// The box of values, the list below it, and where the question stands: corner, width and height.
    const SHOW: [i16; 2] = [1180, 414];
    const LIST: [u16; 4] = [1120, 433, 100, 60];
    const QUESTION: [u16; 4] = [14, 730, 120, 24];
    /// A pixel of the button for the sample rate, and its colour: the panel is at its place.
    const RATE: [u16; 4] = [1032, 69, 1, 1];
    const ACCENT: [u8; 3] = [186, 104, 44];
    let mut program = Program::start_with(&flat(), &["--theme", "dark", "--do", "panel on"]);
    program.resize([1280, 800]);
    until("the panel", || {
        program
            .desktop
            .part(program.window, RATE)
            .starts_with(&ACCENT)
            .then_some(())
    });
    // Where nothing has a tool tip.
    program.desktop.point(40, 200);
    let part = |program: &Program, part| program.desktop.part(program.window, part);
    let still = |program: &Program, place| {
        until("a picture at rest", || {
            let before = part(program, place);
            std::thread::sleep(Duration::from_millis(400));
            (part(program, place) == before).then_some(before)
        })
    };
    let (closed, unasked) = (still(&program, LIST), still(&program, QUESTION));
    program.desktop.point(SHOW[0], SHOW[1]);
    std::thread::sleep(Duration::from_millis(60));
    program.desktop.button(1, true);
    program.desktop.button(1, false);
    // A click counts where the pointer is when its frame is laid out.
    std::thread::sleep(Duration::from_millis(200));
    program.desktop.point(40, 200);
    until("the open list", || (part(&program, LIST) != closed).then_some(()));
    let _ = still(&program, LIST);
    program.desktop.press(keysym::ESCAPE, &[]);
    until("the closed list", || (part(&program, LIST) == closed).then_some(()));
    assert!(still(&program, QUESTION) == unasked, "only the list was closed");
    program.desktop.press(keysym::ESCAPE, &[]);
    until("the question", || (part(&program, QUESTION) != unasked).then_some(()));
    until("its end", || (part(&program, QUESTION) == unasked).then_some(()));
    program.desktop.press(keysym::ESCAPE, &[]);
    until("the question again", || {
        (part(&program, QUESTION) != unasked).then_some(())
    });
    program.desktop.press(keysym::ESCAPE, &[]);
    assert!(program.ended().success(), "the answer");
}

#[test]
fn control_q_ends_at_once() {
    let mut program = Program::start_bare(&flat());
    program.shows(&viewed(&flat(), &[]), "the first picture");
    program.desktop.type_char('q', &[keysym::CONTROL]);
    assert!(program.ended().success(), "Ctrl+Q ends");
}

#[test]
fn rest_costs_nothing() {
    let program = Program::start(&flat());
    std::thread::sleep(Duration::from_secs(3));
    rests(program.id(), "while nothing happened");
}

/// Fails unless a process comes to rest: works for less than a millisecond a second.
///
/// A thread that waits for the desktop's messages wakes twice a second, for a tenth of that; a motion of the pointer
/// takes several times as much. A busy machine finishes late what was asked for, hence more than one look.
pub(crate) fn rests(process: u32, when: &str) {
    const SPAN: Duration = Duration::from_secs(2);
    let worked: Vec<Duration> = (0..5)
        .map_while(|_| {
            let before = work(process);
            std::thread::sleep(SPAN);
            let worked = work(process).abs_diff(before);
            (worked > SPAN / 1000).then_some(worked)
        })
        .collect();
    assert!(
        worked.len() < 5,
        "{when} the program worked in spans of {SPAN:?}: {worked:?}"
    );
}

/// For how long the threads that a process has were run.
fn work(process: u32) -> Duration {
    let threads = std::fs::read_dir(format!("/proc/{process}/task")).unwrap();
    let nanoseconds = threads.map(|thread| {
        // A thread may end before its file is read.
        let file = thread.unwrap().path().join("schedstat");
        let text = std::fs::read_to_string(file).unwrap_or_default();
        text.split_whitespace()
            .next()
            .map_or(0, |word| word.parse::<u64>().unwrap())
    });
    Duration::from_nanos(nanoseconds.sum())
}

#[test]
fn without_display_the_first_frame_becomes_a_file() {
    for (display, why) in [
        (None, "neither DISPLAY nor WAYLAND_DISPLAY"),
        (Some(":9876"), "does not answer"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let mut process = Process::new(env!("CARGO_BIN_EXE_rasterscope"));
        process
            .arg(flat())
            .args(["--size", "400x300"])
            .current_dir(folder.path());
        process
            .env_remove("DISPLAY")
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET");
        if let Some(display) = display {
            process.env("DISPLAY", display);
        }
        let output = process.output().unwrap();
        assert!(output.status.success(), "{output:?}");
        let line = String::from_utf8(output.stdout).unwrap();
        assert!(
            line.contains(why) && line.contains("xvfb-run") && line.lines().count() == 1,
            "{line}"
        );
        let files: Vec<_> = std::fs::read_dir(folder.path())
            .unwrap()
            .map(|file| file.unwrap().path())
            .collect();
        assert_eq!(files.len(), 1, "{files:?}");
        let picture = image::open(&files[0]).unwrap();
        assert_eq!((picture.width(), picture.height()), (400, 300), "the window's size");
    }
}
