//! Slow scenes in the window: previews while the view moves, the final picture when it rests, nothing else in files.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use glam::DVec2;
use rasterscope::texture::{LevelSampling, PixelSampling};
use rasterscope::viewer::{Command, PointerButton, PointerCommand, WindowCommand};

use super::desktop::keysym;
use super::life::rests;
use super::program::{Program, SIZE, flat, until, viewed};

/// Where the tests point, in window pixels.
const AT: [i16; 2] = [180, 150];
/// The accent of the dark theme, which the progress bar has.
const ACCENT: u32 = 0x002c_68ba;

/// A scene whose every pixel is read from textures: no trick makes 256 samples of it as quick as one.
fn slow() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/texmap/test1.svg")
}

/// What makes it slow.
const SLOWLY: [&str; 6] = [
    "--sample-rate",
    "256",
    "--pixel-sampling",
    "bilinear",
    "--level-sampling",
    "linear",
];

/// The same settings at any rate, and then more commands.
fn at_rate(samples: u32, more: &[Command]) -> Vec<Command> {
    let settings = [
        Command::set("sample-rate", &samples.to_string()).expect("a value"),
        Command::set("pixel-sampling", PixelSampling::Bilinear.name()).expect("a value"),
        Command::set("level-sampling", LevelSampling::Linear.name()).expect("a value"),
    ];
    [&settings, more].concat()
}

fn plain(pixels: &[u32]) -> Vec<u32> {
    pixels.iter().map(|pixel| pixel & 0x00ff_ffff).collect()
}

/// Whether a picture consists of squares of 2x2 equal pixels, as previews do that are coarser than rate 1.
fn is_coarse(pixels: &[u32], size: [u32; 2]) -> bool {
    let [width, height] = size.map(|side| side as usize);
    let at = |x: usize, y: usize| pixels[y * width + x];
    (0..height).all(|y| (0..width).all(|x| at(x, y) == at(x & !1, y & !1)))
}

fn settle() {
    std::thread::sleep(Duration::from_millis(60));
}

#[test]
fn slow_zoom_shows_a_preview_then_the_final_picture_then_rests() {
    let path = slow();
    let program = Program::start_with(&path, &[&SLOWLY[..], &["--do", "hide on"]].concat());
    program.shows(&viewed(&path, &at_rate(256, &[])), "the first picture");
    program.desktop.point(AT[0], AT[1]);
    settle();
    let at = DVec2::from(AT.map(f64::from));
    let mut seen = false;
    // The wheel as the window tells it: a click from XTEST arrives as one or as two events.
    let mut turned = Vec::new();
    let turns = |count: usize| vec![Command::Pointer(PointerCommand::Wheel { clicks: 1.0 }); count];
    // On a busy machine a preview may be gone before anybody looks: another click, another chance.
    for _ in 0..6 {
        let candidates = [1, 2].map(|more| {
            let all = [
                &[Command::Pointer(PointerCommand::Moved { at })],
                &turned[..],
                &turns(more),
            ]
            .concat();
            [1, 256].map(|rate| plain(viewed(&path, &at_rate(rate, &all)).pixels()))
        });
        program.desktop.button(4, true);
        program.desktop.button(4, false);
        let more = until("the final picture", || {
            let (pixels, size) = program.desktop.pixels(program.window)?;
            seen |= candidates.iter().any(|[preview, _]| *preview == pixels) || is_coarse(&pixels, size);
            candidates.iter().position(|[_, last]| *last == pixels)
        });
        turned.extend(turns(more + 1));
        if seen {
            break;
        }
    }
    assert!(seen, "no preview was ever to be seen");
    rests(program.id(), "after the final picture");
}

#[test]
fn slow_drag_ends_final_and_its_screenshots_are_so() {
    let path = slow();
    let program = Program::start_with(&path, &[&SLOWLY[..], &["--do", "hide on"]].concat());
    program.shows(&viewed(&path, &at_rate(256, &[])), "the first picture");
    program.desktop.point(AT[0], AT[1]);
    settle();
    program.desktop.button(1, true);
    // The same motions for the expected pictures: their sum would have other last digits.
    let moved = |x: i16, y: i16| {
        Command::Pointer(PointerCommand::Moved {
            at: DVec2::from([AT[0] + x, AT[1] - y].map(f64::from)),
        })
    };
    let mut motions = vec![
        moved(0, 0),
        Command::Pointer(PointerCommand::Pressed(PointerButton::Primary)),
    ];
    for step in 1..=5 {
        program.desktop.point(AT[0] + 6 * step, AT[1] - 3 * step);
        motions.push(moved(6 * step, 3 * step));
        settle();
    }
    program.desktop.type_char('s', &[]);
    settle();
    program.desktop.point(AT[0] + 40, AT[1] - 20);
    let file = until("the file", || {
        let mut files = std::fs::read_dir(program.folder.path())
            .unwrap()
            .map(|file| file.unwrap().path());
        files.find(|file| image::open(file).is_ok())
    });
    program.desktop.button(1, false);
    let asked = viewed(&path, &at_rate(256, &motions));
    motions.push(moved(40, 20));
    let last = viewed(&path, &at_rate(256, &motions));
    program.shows(&last, "the final picture, moved by exactly 40, -20");
    let picture = image::open(file).unwrap().into_rgba8();
    let saved: Vec<u32> = picture
        .pixels()
        .map(|pixel| u32::from_be_bytes([0, pixel.0[0], pixel.0[1], pixel.0[2]]))
        .collect();
    assert!(
        [asked, last].iter().any(|picture| plain(picture.pixels()) == saved),
        "the file holds a final picture of the moment it was asked for, or of the next"
    );
}

#[test]
fn slow_refinement_shows_how_far_it_is() {
    let mut program = Program::start_with(&slow(), &SLOWLY);
    program.resize([1900, 1060]);
    until("the progress bar", || {
        let (pixels, [width, _]) = program.desktop.pixels(program.window)?;
        (pixels[width as usize + 1] == ACCENT).then_some(())
    });
    // What is drawn does not keep the program alive.
    program.desktop.type_char('q', &[keysym::CONTROL]);
    assert!(program.ended().success(), "Ctrl+Q quits at once");
}

/// The pointer moves all the time: something new is to be seen all the time. The bound is far above what the window
/// needs (see the README), since machines that test are busy.
#[test]
fn drag_of_a_large_textured_scene_keeps_up() {
    const STUCK: Duration = Duration::from_millis(150);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/texmap/test6.svg");
    let settings = [
        "--sample-rate",
        "16",
        "--pixel-sampling",
        "bilinear",
        "--level-sampling",
        "linear",
    ];
    let program = Program::start_with(&path, &settings);
    program.resize([1920, 1080]);
    program.desktop.point(900, 500);
    program.desktop.press(keysym::TAB, &[]);
    let start = at_rate(16, &[Command::Window(WindowCommand::Resize([1920, 1080]))]);
    program.shows(&viewed(&path, &start), "the first picture");
    program.desktop.button(1, true);
    let begin = Instant::now();
    let (mut gaps, mut last, mut shown) = (Vec::new(), begin, Vec::new());
    let mut step = 0_i16;
    while begin.elapsed() < Duration::from_secs(3) {
        step += 1;
        let along = (step % 200 - 100).abs();
        program.desktop.point(900 + 2 * along, 500 + along);
        let strip = program.desktop.part(program.window, [800, 500, 300, 2]);
        if strip != shown {
            shown = strip;
            gaps.push(last.elapsed());
            last = Instant::now();
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    program.desktop.button(1, false);
    gaps.sort();
    let (middle, longest) = (gaps[gaps.len() / 2], gaps[gaps.len() - 1]);
    println!("{} pictures, middle {middle:?}, longest {longest:?} apart", gaps.len());
    // Other programs may take the processor for longer than that now and then, but not most of the time.
    assert!(middle < STUCK, "the middle one of {} gaps: {middle:?}", gaps.len());
    // Hundreds of motions add up to other last digits than one: back to numbers that are known.
    program.desktop.type_char(' ', &[]);
    program.shows(&viewed(&path, &start), "the final picture of the default view");
}

/// What the log of a window says was shown, and of how many pixels.
fn logged(file: &Path) -> Vec<(String, u64)> {
    let text = std::fs::read_to_string(file).unwrap_or_default();
    let mut lines = text.split_inclusive('\n').filter(|line| line.ends_with('\n'));
    let Some(header) = lines.next() else {
        return Vec::new();
    };
    let columns = header.trim_end().split(',').count();
    let shown = lines.map(|line| {
        let words: Vec<&str> = line.trim_end().split(',').collect();
        assert_eq!(words.len(), columns, "{header}{line}");
        (words[1].to_owned(), words[columns - 1].parse().unwrap())
    });
    shown.collect()
}

#[test]
fn frame_log_tells_what_was_shown() {
    let mut program = Program::start_with(&flat(), &["--frame-log", "frames.csv"]);
    let file = program.folder.path().join("frames.csv");
    let count = |panels: bool| {
        let lines = logged(&file);
        lines.iter().filter(|(shows, _)| (shows == "panels") == panels).count()
    };
    until("the first picture", || (count(false) > 0).then_some(()));
    let before = count(true);
    let mut step = 0;
    until("the status line", || {
        step += 1;
        program.desktop.point(200 + step % 50, 200);
        (count(true) > before).then_some(())
    });
    let before = count(false);
    program.desktop.button(1, true);
    program.desktop.point(240, 170);
    until("the moved picture", || (count(false) > before).then_some(()));
    program.desktop.button(1, false);
    program.close();
    assert!(program.ended().success(), "the window was closed");
    let [width, height] = SIZE.map(u64::from);
    for (shows, pixels) in logged(&file) {
        assert!(pixels > 0 && pixels <= width * height, "{pixels} pixels of {shows}");
    }
}
