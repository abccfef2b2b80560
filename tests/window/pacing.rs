//! Slow scenes in the window: previews while the view moves, the final picture when it rests, nothing else in files.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use glam::DVec2;
use rasterscope::raster::SampleRate;
use rasterscope::viewer::Command;

use super::desktop::keysym;
use super::life::ticks;
use super::program::{Program, until, viewed};

/// Where the tests point, in window pixels.
const AT: [i16; 2] = [180, 150];
/// The accent of the dark theme, which the progress bar has.
const ACCENT: u32 = 0x002c_68ba;

/// A scene of translucent gradients over all of the canvas: every sample of every layer is to be shaded and blended.
fn slow_scene(folder: &Path, layers: u32) -> PathBuf {
    let mut text = "<svg width='100' height='100'>\n".to_owned();
    for layer in 0..layers {
        let shift = layer % 7;
        writeln!(
            text,
            "<colortri points='{shift},-300 -400,300 400,50{shift}' \
             colors='1 0 0.{shift} 0.5  0 1 0.{shift} 0.5  0 0 1 0.5'/>\
             <polygon points='{shift},5 90,{shift}0 50,9{shift}' fill='#18{shift}0a0' fill-opacity='0.5'/>"
        )
        .unwrap();
    }
    text.push_str("</svg>\n");
    let path = folder.join("slow.svg");
    std::fs::write(&path, text).unwrap();
    path
}

fn rate(samples: u32) -> Command {
    Command::SetSampleRate(SampleRate::new(samples).unwrap())
}

fn plain(pixels: &[u32]) -> Vec<u32> {
    pixels.iter().map(|pixel| pixel & 0x00ff_ffff).collect()
}

fn settle() {
    std::thread::sleep(Duration::from_millis(60));
}

#[test]
fn slow_zoom_shows_a_preview_then_the_final_picture_then_rests() {
    let folder = tempfile::tempdir().unwrap();
    let path = slow_scene(folder.path(), 6);
    let program = Program::start_with(&path, &["--sample-rate", "64", "--do", "hide on"]);
    program.shows(&viewed(&path, &[rate(64)]), "the first picture");
    program.desktop.point(AT[0], AT[1]);
    settle();
    let at = DVec2::from(AT.map(f64::from));
    let mut seen = false;
    let mut clicks = 0.0;
    // On a busy machine a preview may be coarser than rate 1: another click, another chance.
    for _ in 0..6 {
        program.desktop.button(4, true);
        program.desktop.button(4, false);
        // A click from XTEST arrives as one or as two events.
        let previews = [clicks + 1.0, clicks + 2.0].map(|clicks| {
            let commands = [rate(1), Command::PointerMoved { at }, Command::Wheel { clicks }];
            plain(viewed(&path, &commands).pixels())
        });
        let start = Instant::now();
        while start.elapsed() < Duration::from_secs(1) && !seen {
            let shown = program.desktop.pixels(program.window).map(|(pixels, _)| pixels);
            seen = shown.is_some_and(|shown| previews.contains(&shown));
        }
        let finals = [clicks + 1.0, clicks + 2.0].map(|clicks| {
            let commands = [rate(64), Command::PointerMoved { at }, Command::Wheel { clicks }];
            plain(viewed(&path, &commands).pixels())
        });
        clicks += until("the final picture", || {
            let (pixels, _) = program.desktop.pixels(program.window)?;
            let at = finals.iter().position(|picture| *picture == pixels)?;
            Some(if at == 0 { 1.0 } else { 2.0 })
        });
        if seen {
            break;
        }
    }
    assert!(seen, "no preview was ever to be seen");
    std::thread::sleep(Duration::from_secs(1));
    let before = ticks(program.id());
    std::thread::sleep(Duration::from_secs(2));
    assert_eq!(ticks(program.id()), before, "at rest again");
}

#[test]
fn slow_drag_ends_final_and_its_screenshots_are_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = slow_scene(folder.path(), 6);
    let program = Program::start_with(&path, &["--sample-rate", "64", "--do", "hide on"]);
    program.shows(&viewed(&path, &[rate(64)]), "the first picture");
    program.desktop.point(AT[0], AT[1]);
    settle();
    program.desktop.button(1, true);
    for step in 1..=5 {
        program.desktop.point(AT[0] + 6 * step, AT[1] - 3 * step);
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
    let moved = |x: f64, y: f64| viewed(&path, &[rate(64), Command::PanBy { by: DVec2::new(x, y) }]);
    let last = moved(40.0, -20.0);
    program.shows(&last, "the final picture, moved by exactly 40, -20");
    let picture = image::open(file).unwrap().into_rgba8();
    let saved: Vec<u32> = picture
        .pixels()
        .map(|pixel| u32::from_be_bytes([0, pixel.0[0], pixel.0[1], pixel.0[2]]))
        .collect();
    let asked = moved(30.0, -15.0);
    assert!(
        [asked, last].iter().any(|picture| plain(picture.pixels()) == saved),
        "the file holds a final picture of the moment it was asked for, or of the next"
    );
}

#[test]
fn slow_refinement_shows_how_far_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = slow_scene(folder.path(), 60);
    let mut program = Program::start_with(&path, &["--sample-rate", "256"]);
    until("the progress bar", || {
        let (pixels, [width, _]) = program.desktop.pixels(program.window)?;
        (pixels[width as usize + 1] == ACCENT).then_some(())
    });
    // What is drawn does not keep the program alive.
    program.desktop.press(keysym::ESCAPE, &[]);
    assert!(program.ended().success(), "Esc quits at once");
}

/// The pointer moves all the time: something new is to be seen all the time. The bound is far above what the window
/// needs (see the README), since machines that test are busy.
#[test]
fn drag_of_a_large_textured_scene_keeps_up() {
    const STUCK: Duration = Duration::from_millis(500);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/texmap/test6.svg");
    let program = Program::start_with(&path, &["--sample-rate", "16", "--pixel-sampling", "bilinear"]);
    program.resize([1920, 1080]);
    let size = [Command::Resize([1920, 1080]), rate(16)];
    program.desktop.point(900, 500);
    program.desktop.press(keysym::TAB, &[]);
    let sampling = Command::SetPixelSampling(rasterscope::texture::PixelSampling::Bilinear);
    let start = [&size[..], std::slice::from_ref(&sampling)].concat();
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
    assert!(longest < STUCK, "the longest of {} gaps: {longest:?}", gaps.len());
    // Hundreds of motions add up to other last digits than one: back to numbers that are known.
    program.desktop.type_char(' ', &[]);
    program.shows(&viewed(&path, &start), "the final picture of the default view");
}
