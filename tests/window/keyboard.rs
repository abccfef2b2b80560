//! Keys through the real keyboard: the window then shows what `render` makes with the same settings.

use rasterscope::raster::SampleRate;
use rasterscope::render::RenderSettings;
use rasterscope::texture::{LevelSampling, PixelSampling};
use rasterscope::viewer::{Command, Toggle};
use rasterscope::viewer::{InspectorCommand, ViewCommand};

use super::desktop::keysym;
use super::program::{
    Program, SIZE, SMALL_INSET, SMALL_INSET_COMMANDS, flat, inset, left_part, rendered, textured, until, viewed,
};

#[test]
fn keys_change_the_sampling() {
    let path = textured();
    let program = Program::start_bare(&path);
    let mut settings = RenderSettings::default();
    program.shows(&rendered(&path, &settings, SIZE), "the first picture");

    let rate = |samples| SampleRate::new(samples).unwrap();
    for (key, samples) in [('=', 4), ('=', 9), ('-', 4), ('+', 9), ('-', 4), ('-', 1), ('-', 1)] {
        program.desktop.type_char(key, &[]);
        settings.sample_rate = rate(samples);
        program.shows(
            &rendered(&path, &settings, SIZE),
            &format!("{samples} samples after {key}"),
        );
    }
    program.desktop.type_char('p', &[]);
    settings.pixel_sampling = PixelSampling::Bilinear;
    program.shows(&rendered(&path, &settings, SIZE), "bilinear after P");
    for level in LevelSampling::ALL[1..].iter().chain([&LevelSampling::Zero]).copied() {
        program.desktop.type_char('l', &[]);
        settings.level_sampling = level;
        program.shows(
            &rendered(&path, &settings, SIZE),
            &format!("level {} after L", level.name()),
        );
    }
}

#[test]
fn keys_change_the_view() {
    let path = flat();
    let program = Program::start_bare(&path);
    let start = viewed(&path, &[]);
    program.shows(&start, "the first picture");
    let cases = [
        (']', Command::View(ViewCommand::RotateBy { degrees: 5.0 })),
        ('[', Command::View(ViewCommand::RotateBy { degrees: -5.0 })),
        ('f', Command::View(ViewCommand::Fit)),
        (' ', Command::View(ViewCommand::Reset)),
    ];
    let mut played = Vec::new();
    for (key, command) in cases {
        program.desktop.type_char(key, &[]);
        played.push(command);
        program.shows(&viewed(&path, &played), &format!("after {key:?}"));
    }
    program.desktop.type_char('0', &[keysym::CONTROL]);
    program.shows(
        &viewed(&path, &[Command::View(ViewCommand::ActualSize)]),
        "one unit one pixel",
    );
}

#[test]
fn keys_switch_scenes_and_keep_their_views() {
    let folder = tempfile::tempdir().unwrap();
    for (name, color) in [("a.svg", "#ff8000"), ("b.svg", "#0080ff")] {
        let text =
            format!("<svg width='100' height='100'><rect x='10' y='20' width='50' height='40' fill='{color}'/></svg>");
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let program = Program::start_bare(folder.path());
    let (a, b) = (folder.path().join("a.svg"), folder.path().join("b.svg"));
    program.shows(&viewed(&a, &[]), "the first scene");
    program.desktop.type_char('f', &[]);
    let fitted = viewed(&a, &[Command::View(ViewCommand::Fit)]);
    program.shows(&fitted, "fitted");
    program.desktop.press(keysym::PAGE_DOWN, &[]);
    program.shows(&viewed(&b, &[]), "the second scene");
    program.desktop.type_char('1', &[]);
    program.shows(&fitted, "the first scene as it was left");
    program.desktop.type_char('2', &[]);
    program.shows(&viewed(&b, &[]), "the second scene by its digit");
}

#[test]
fn keys_of_the_inspector() {
    let path = flat();
    let program = Program::start_with(&path, &["--do", SMALL_INSET]);
    program.desktop.point(250, 200);
    program.desktop.type_char('z', &[]);
    let open = [
        &SMALL_INSET_COMMANDS[..],
        &[
            Command::Inspector(InspectorCommand::Show(Toggle::On)),
            Command::Inspector(InspectorCommand::Pin([250, 200])),
        ],
    ]
    .concat();
    program.shows_somewhere(&inset(&path, &open), "the inset under the pointer");
    program.desktop.press(keysym::RETURN, &[]);
    program.desktop.point(20, 300);
    program.desktop.press(keysym::LEFT, &[]);
    program.desktop.press(keysym::RIGHT, &[keysym::SHIFT]);
    let nudged = [
        &open[..],
        &[
            Command::Inspector(InspectorCommand::Nudge([-1, 0])),
            Command::Inspector(InspectorCommand::Nudge([10, 0])),
        ],
    ]
    .concat();
    program.shows_somewhere(&inset(&path, &nudged), "the pin, nudged");
    program.desktop.press(keysym::ESCAPE, &[]);
    program.desktop.press(keysym::ESCAPE, &[]);
    program.desktop.press(keysym::TAB, &[]);
    program.shows(&viewed(&path, &[]), "unpinned and closed");
}

#[test]
fn keys_explain_the_pinned_pixel() {
    const LARGE: [u32; 2] = [900, 700];
    // The panel with its text, above the status line.
    const PANEL: [u32; 2] = [340, 640];
    let path = flat();
    let program = Program::start_with(&path, &["--do", "panel off; theme dark"]);
    program.resize(LARGE);
    program.desktop.point(450, 300);
    program.desktop.press(keysym::RETURN, &[]);
    program.desktop.point(600, 660);
    let steps = "panel off; theme dark; pin 450,300; move 600,660";
    let explained = left_part(&path, LARGE, steps, PANEL);
    program.shows_somewhere(&explained, "the explanation of the pinned pixel");
    program.desktop.type_char('=', &[]);
    let finer = left_part(&path, LARGE, &format!("{steps}; rate 4"), PANEL);
    assert_ne!(finer.pixels(), explained.pixels(), "it tells other samples");
    program.shows_somewhere(&finer, "the explanation of four samples");
    program.desktop.type_char('e', &[]);
    let closed = left_part(&path, LARGE, &format!("{steps}; rate 4; explanation off"), PANEL);
    program.shows_somewhere(&closed, "the picture without the explanation");
}

#[test]
fn keys_save_the_picture() {
    let path = flat();
    let program = Program::start_bare(&path);
    let picture = viewed(&path, &[]);
    program.shows(&picture, "the first picture");
    program.desktop.type_char('s', &[]);
    let file = until("the file", || {
        let mut files = std::fs::read_dir(program.folder.path())
            .unwrap()
            .map(|file| file.unwrap().path());
        files.find(|file| image::open(file).is_ok())
    });
    let name = file.file_name().unwrap().to_string_lossy().into_owned();
    assert!(
        name.starts_with("rasterscope-20") && file.extension().is_some_and(|ending| ending == "png"),
        "year to millisecond: {name}"
    );
    let saved = image::open(&file).unwrap().into_rgba8();
    assert_eq!((saved.width(), saved.height()), (SIZE[0], SIZE[1]), "the frame's size");
    for (x, y, pixel) in saved.enumerate_pixels() {
        assert_eq!(Some(pixel.0), picture.rgba(x, y), "pixel {x}, {y}");
    }
}

#[test]
fn keys_go_to_the_line_of_text_that_asks_for_them() {
    let path = flat();
    let program = Program::start_bare(&path);
    program.shows(&viewed(&path, &[]), "the first picture");
    program.desktop.type_char('p', &[keysym::CONTROL, keysym::SHIFT]);
    std::thread::sleep(std::time::Duration::from_millis(300));
    for character in "rate 16".chars() {
        program.desktop.type_char(character, &[]);
    }
    program.desktop.press(keysym::RETURN, &[]);
    let sixteen = [Command::set("sample-rate", "16").expect("a value")];
    program.shows(
        &viewed(&path, &sixteen),
        "the palette set the rate, and no letter did anything else",
    );
}
