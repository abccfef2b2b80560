//! Lessons: walking through them by commands, and their slides.

use std::fs;
use std::path::Path;
use std::process::Command as Process;

use glam::dvec2;
use rasterscope::geometry::View;
use rasterscope::raster::{Framebuffer, SampleRate};
use rasterscope::render::{LegendKey, RenderSettings, Visualisation, draw};
use rasterscope::scene::{Dialect, DialectChoice, ReadOptions, Scene};
use rasterscope::texture::{Anisotropy, LevelSampling, PixelSampling};
use rasterscope::viewer::gallery::{SCENES, Textures};
use rasterscope::viewer::{
    Arrangement, BUILT_IN, Command, LessonCommand, LessonSource, SceneCommand, ViewCommand, Viewer, WindowCommand,
};

use crate::support::session::{SQUARE, Session, TRIANGLES};

const LESSON: &str = r#"
title = "Two steps"

[[step]]
title = "First"
scene = "a.svg"
sample-rate = 16
pin = "40,60"
text = "See **this**."

[[step]]
title = "Second"
scene = "b.svg"
view = "50,50,2"
dialect = "svg"
against = "sample-rate 4"
arrange = "side"
text = "And that."

[[step]]
title = "Third"
text = "The same scene."
"#;

/// A folder with the lesson and its scenes.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("lesson.toml", LESSON), ("a.svg", TRIANGLES), ("b.svg", SQUARE)] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn title(viewer: &Viewer) -> Option<String> {
    let (lesson, at) = viewer.lesson()?;
    Some(lesson.steps[at].title.clone())
}

#[test]
fn lesson_is_walked_by_keys_and_closed_by_escape() {
    let folder = folder();
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    session.keys(&["p", "="]);
    let (settings, before) = (*session.viewer.settings(), session.pixels().clone());
    session.run(Command::Scenes(SceneCommand::Open(vec![
        folder.path().join("lesson.toml"),
    ])));
    assert_eq!(title(&session.viewer).as_deref(), Some("First"));
    assert_eq!(
        session.viewer.scene_list().scenes().len(),
        2,
        "each scene of the lesson once"
    );
    assert_eq!(
        session.viewer.settings().render.sample_rate.samples(),
        16,
        "the step's settings"
    );
    assert_eq!(
        session.viewer.settings().render.pixel_sampling,
        PixelSampling::default(),
        "the others have their defaults"
    );
    let pinned = session.viewer.pixels().pinned().expect("the step's pin");
    let user = session.viewer.pixels().status_of(pinned).unwrap().user;
    assert!(user.distance(dvec2(40.0, 60.0)) < 1.0, "{user}");
    session.assert_frame_is_current();

    session.keys(&["PageDown"]);
    assert_eq!(title(&session.viewer).as_deref(), Some("Second"));
    let numbers = session.viewer.both().view_numbers().unwrap();
    // Frames of odd sides show it moved by half a pixel, so that their pixels are those of even ones.
    let half = dvec2(0.25, 0.25) + 1e-9;
    let is_near = (numbers.center - dvec2(50.0, 50.0)).abs().cmple(half).all();
    assert!(
        is_near && (numbers.scale - 2.0).abs() < 1e-9,
        "the step's view, not {numbers:?}"
    );
    assert_eq!(session.viewer.settings().dialect, DialectChoice::Svg);
    assert_eq!(session.viewer.ab().arrangement(), Arrangement::SideBySide);
    let b = session.viewer.ab().other_settings(session.viewer.settings());
    assert_eq!(b.unwrap().sample_rate.samples(), 4, "B");
    assert_eq!(session.viewer.pixels().pinned(), None, "no pin");

    session.keys(&["PageDown", "PageDown"]);
    assert_eq!(title(&session.viewer).as_deref(), Some("Third"), "the last one stays");
    assert_eq!(session.viewer.ab().other(), None, "without a comparison");
    session.keys(&["=", "]", "PageUp"]);
    session.run(Command::Lesson(LessonCommand::Step(2)));
    assert_eq!(
        session.viewer.settings().render.sample_rate.samples(),
        1,
        "as its author meant it"
    );
    assert!(
        session.viewer.both().view_numbers().unwrap().rotation.abs() < 1e-9,
        "upright again"
    );
    session.run(Command::Lesson(LessonCommand::Step(17)));
    assert_eq!(
        title(&session.viewer).as_deref(),
        Some("Third"),
        "there is no such step"
    );

    session.run(Command::Window(WindowCommand::Escape));
    assert_eq!(session.viewer.lesson(), None, "closed");
    assert_eq!(*session.viewer.settings(), settings, "the settings are back");
    assert_eq!(session.viewer.scene_list().scenes().len(), 1, "and the scenes");
    assert!(*session.pixels() == before, "and the picture");
}

#[test]
fn lesson_gives_back_comparison_and_pin() {
    use rasterscope::viewer::{AbCommand, Against, InspectorCommand, Other};
    let folder = folder();
    let file = LessonSource::File(folder.path().join("lesson.toml"));
    for arrangement in Arrangement::ALL {
        for swapped in [false, true] {
            let mut session = Session::open(&[TRIANGLES], [400, 300]);
            session.run(Command::Ab(AbCommand::Compare(Against::Settings)));
            session.keys(&["="]);
            session.run(Command::Ab(AbCommand::Arrange(arrangement)));
            session.run(Command::Ab(AbCommand::SetWipe(0.3)));
            if swapped {
                session.run(Command::Ab(AbCommand::Swap));
            }
            session.run(Command::Inspector(InspectorCommand::Pin([120, 80])));
            let state = |session: &Session| {
                let ab = session.viewer.ab();
                let pinned = session.viewer.pixels().pinned();
                (ab.other().cloned(), ab.arrangement(), ab.is_swapped(), pinned)
            };
            let before = (state(&session), session.viewer.window().picture());
            assert!(matches!(before.0.0, Some(Other::Settings { .. })) && before.0.3 == Some([120, 80]));
            session.run(Command::Lesson(LessonCommand::Open(file.clone())));
            session.keys(&["PageDown"]);
            assert_ne!(state(&session).3, before.0.3, "the lesson has its own");
            session.run(Command::Lesson(LessonCommand::Close));
            assert_eq!(state(&session), before.0, "{arrangement:?}, swapped {swapped}");
            // What flips by itself shows A first.
            let flips = arrangement == Arrangement::Flip;
            assert!(
                flips || session.viewer.window().picture() == before.1,
                "{arrangement:?}"
            );
        }
    }
}

#[test]
fn lesson_shows_the_canvas_where_no_panel_is_until_a_hand_moves_it() {
    use rasterscope::viewer::PixelRect;
    let folder = folder();
    let mut session = Session::open(&[TRIANGLES], [600, 300]);
    session.run(Command::Scenes(SceneCommand::Open(vec![
        folder.path().join("lesson.toml"),
    ])));
    let middle = |session: &Session| {
        let entry = session.viewer.scene_list().current().unwrap();
        let canvas = entry.scene().unwrap().canvas;
        entry
            .camera
            .view()
            .transform(canvas, session.viewer.both().layout().frame_size())
            .to_pixels(canvas / 2.0)
    };
    let free = |x: i64, width: u32| {
        Command::Window(WindowCommand::SetFreeArea(Some(PixelRect {
            x,
            y: 0,
            width,
            height: 300,
        })))
    };
    session.run(free(200, 400));
    assert!(
        middle(&session).distance(dvec2(400.0, 150.0)) < 1.0,
        "{}",
        middle(&session)
    );
    session.run(free(300, 200));
    assert!(
        middle(&session).distance(dvec2(400.0, 150.0)) < 1.0,
        "{}",
        middle(&session)
    );
    session.run(Command::View(ViewCommand::PanBy { by: dvec2(-50.0, 0.0) }));
    session.run(free(0, 600));
    assert!(
        middle(&session).distance(dvec2(350.0, 150.0)) < 1.0,
        "the hand's view stays: {}",
        middle(&session)
    );
}

#[test]
fn lesson_that_cannot_be_read_changes_nothing() {
    let folder = folder();
    let path = folder.path().join("broken.toml");
    fs::write(&path, "title = \"T\"\n[[step]]\nscene = \"nowhere.svg\"\n").unwrap();
    let mut session = Session::open(&[TRIANGLES], [200, 100]);
    session.run(Command::Lesson(LessonCommand::Open(LessonSource::File(path))));
    assert_eq!(session.viewer.lesson(), None);
    let message = &session.viewer.chrome().messages().last().unwrap().text;
    assert!(
        message.contains("broken.toml:3:9: nowhere.svg: no such scene"),
        "{message}"
    );
    session.assert_frame_is_current();
}

/// Every step of the program's own lessons can be drawn, and its words fit.
#[test]
fn lesson_slides_are_numbered_pictures() {
    let folder = tempfile::tempdir().unwrap();
    for (name, _) in BUILT_IN {
        let out = folder.path().join(name);
        let run = lesson(&[name, "--slides", out.to_str().unwrap(), "--size", "960x540"]);
        assert_eq!(run.0, Some(0), "{name}: {}", run.1);
        let source = LessonSource::from_address(Path::new(&format!("lesson:{name}"))).unwrap();
        let steps = source.read().unwrap().steps.len();
        let mut files: Vec<String> = fs::read_dir(&out)
            .unwrap()
            .map(|file| file.unwrap().file_name().into_string().unwrap())
            .collect();
        files.sort();
        let expected: Vec<String> = (1..=steps).map(|number| format!("{number:02}.png")).collect();
        assert_eq!(files, expected, "{name}");
        let first = image::open(out.join("01.png")).unwrap().into_rgb8();
        assert_eq!((first.width(), first.height()), (960, 540), "{name}");
        let dark = |columns: std::ops::Range<u32>| {
            let pixels = columns.flat_map(|x| (0..540).map(move |y| (x, y)));
            pixels
                .filter(|(x, y)| first.get_pixel(*x, *y).0.iter().all(|channel| *channel < 120))
                .count()
        };
        assert!(dark(0..320) > 200, "{name}: words on the left");
    }
    let golden = rasterscope_frame(&folder.path().join("six-tasks/08.png"));
    let found = crate::support::golden::check("lesson_slide", &golden, 1);
    assert_eq!(found.err(), None, "as it was looked at");
}

/// The magnifier goes where the step alone puts it, wherever the step before had it.
#[test]
fn lesson_slides_do_not_depend_on_those_before() {
    let folder = folder();
    let step = |pin: &str| format!("[[step]]\nscene = \"b.svg\"\npin = \"{pin}\"\ntext = \"x\"\n");
    let steps = ["95,5", "50,50", "5,95", "50,50"].map(step).concat();
    let path = folder.path().join("pins.toml");
    fs::write(&path, format!("title = \"T\"\n{steps}")).unwrap();
    let (all, alone) = (folder.path().join("all"), folder.path().join("alone"));
    let draw = |out: &Path, more: &[&str]| {
        let slides = [
            path.to_str().unwrap(),
            "--slides",
            out.to_str().unwrap(),
            "--size=480x270",
        ];
        let run = lesson(&[&slides[..], more].concat());
        assert_eq!(run.0, Some(0), "{}", run.1);
    };
    draw(&all, &[]);
    for number in 1..=4 {
        draw(&alone, &[&format!("--step={number}")]);
        let [one, other] = [&all, &alone].map(|folder| rasterscope_frame(&folder.join(format!("{number:02}.png"))));
        assert!(one == other, "slide {number}");
    }
}

#[test]
fn lesson_slides_are_light_or_dark() {
    let folder = folder();
    let out = folder.path().join("out");
    let slides = [
        "anisotropy",
        "--slides",
        out.to_str().unwrap(),
        "--size=480x300",
        "--step=1",
    ];
    for (theme, paper) in [("light", 0xffff_ffff), ("dark", 0xff14_1619)] {
        let run = lesson(&[&slides[..], &["--theme", theme, "--threads=1"]].concat());
        assert_eq!(run.0, Some(0), "{}", run.1);
        let slide = out.join("01.png");
        assert_eq!(rasterscope_frame(&slide).pixels()[0], paper, "{theme}");
        let again = Process::new(env!("CARGO_BIN_EXE_rasterscope"))
            .args(["rerun", slide.to_str().unwrap(), "--check"])
            .output()
            .unwrap();
        assert!(again.status.success(), "{theme}: {again:?}");
    }
}

#[test]
fn lesson_slides_refuse_what_they_do_not_take() {
    let folder = folder();
    let out = folder.path().join("out");
    for option in [
        "--sample-rate=64",
        "--dialect=svg",
        "--view=1,2,3",
        "--against=truth",
        "--scale=2",
        "--do=wait",
        "--script=nowhere.txt",
        "--screenshot-dir=.",
        "--screenshot-name=a",
        "--frame-log=a.csv",
        "a.svg",
    ] {
        let (status, message) = lesson(&["six-tasks", "--slides", out.to_str().unwrap(), option]);
        let name = option.split('=').next().unwrap();
        assert_eq!(status, Some(2), "{option}: {message}");
        assert!(
            message.contains(&format!("{name}: slides are")) || message.contains(&format!("{name}: slides show")),
            "{message}"
        );
        assert_eq!(message.trim_end().lines().count(), 1, "{message}");
        assert!(!out.exists(), "{option}: nothing is written");
    }
}

/// Where the pin is in the picture is marked as in the window.
#[test]
fn lesson_slides_mark_the_pin() {
    let folder = folder();
    let draw = |name: &str, pin: &str| {
        let path = folder.path().join(format!("{name}.toml"));
        let lesson_text = format!("title = \"T\"\n[[step]]\nscene = \"b.svg\"\n{pin}text = \"x\"\n");
        fs::write(&path, lesson_text).unwrap();
        let out = folder.path().join(name);
        let run = lesson(&[
            path.to_str().unwrap(),
            "--slides",
            out.to_str().unwrap(),
            "--size=960x540",
        ]);
        assert_eq!(run.0, Some(0), "{}", run.1);
        rasterscope_frame(&out.join("01.png"))
    };
    // The canvas has the middle of the picture; its upper left corner is far from the magnifier in any other.
    let (plain, pinned) = (draw("plain", ""), draw("pinned", "pin = \"5,5\"\n"));
    let is_red = |pixel: u32| {
        let [_, red, green, blue] = pixel.to_be_bytes();
        red > 220 && green < 160 && blue < 160
    };
    let count = |frame: &Framebuffer| frame.pixels().iter().filter(|pixel| is_red(**pixel)).count();
    assert_eq!(count(&plain), 0, "nothing else is red");
    // The canvas begins at column 384 and row 25, and a unit has five pixels.
    let rows = pinned.pixels().chunks(960).skip(35).take(27);
    let ring = rows.flat_map(|row| &row[395..424]).filter(|pixel| is_red(**pixel));
    assert!((30..120).contains(&ring.count()), "a ring about the pin");
}

fn rasterscope_frame(path: &Path) -> Framebuffer {
    let image = image::open(path).unwrap().into_rgba8();
    let mut frame = Framebuffer::new(image.width(), image.height());
    for (to, from) in frame.pixels_mut().iter_mut().zip(image.pixels()) {
        let [r, g, b, a] = from.0;
        *to = u32::from_be_bytes([a, r, g, b]);
    }
    frame
}

#[test]
fn lesson_mistakes_are_one_line_and_status_2() {
    let folder = folder();
    let path = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let out = folder.path().join("out");
    let out = out.to_str().unwrap();
    let wrong = path("wrong.toml", &LESSON.replace("sample-rate = 16", "sample-rat = 16"));
    let long = path(
        "long.toml",
        &LESSON.replace("And that.", &"words and words ".repeat(900)),
    );
    let bad = path("bad.toml", &LESSON.replace("b.svg", "broken.svg"));
    path("broken.svg", "<svg");
    let pin = path("pin.toml", &LESSON.replace("40,60", "99999,60"));
    let rate = path("rate.toml", &LESSON.replace("sample-rate = 16", "sample-rate = 3"));
    let plain = path("plain.txt", "");
    for (arguments, word) in [
        (
            vec![wrong.as_str(), "--slides", out],
            "wrong.toml:7:1: `sample-rat` is unknown",
        ),
        (
            vec![pin.as_str(), "--slides", out],
            "pin.toml: step 1: its pin 99999,60 is not in the picture",
        ),
        (
            vec![rate.as_str(), "--slides", out],
            "rate.toml:7:15: pattern grid takes a square number",
        ),
        (
            vec![long.as_str(), "--slides", out],
            "long.toml: step 2: its text does not fit",
        ),
        (vec![bad.as_str(), "--slides", out], "step 2: "),
        (vec![plain.as_str()], "no lesson"),
        (vec!["nowhere.toml"], "nowhere.toml: cannot be read"),
        (vec!["six-tasks", "--slides", out, "--size", "20x20"], "too small"),
        (vec!["six-tasks", "--slides", plain.as_str()], "plain.txt"),
    ] {
        let (status, message) = lesson(&arguments);
        assert_eq!(status, Some(2), "{arguments:?}: {message}");
        assert!(message.contains(word), "{arguments:?}: {message}");
        assert_eq!(message.trim_end().lines().count(), 1, "{arguments:?}: {message}");
    }
}

/// Exit status and stderr of `rasterscope lesson`.
fn lesson(arguments: &[&str]) -> (Option<i32>, String) {
    let run = Process::new(env!("CARGO_BIN_EXE_rasterscope"))
        .arg("lesson")
        .args(arguments)
        .output()
        .unwrap();
    (run.status.code(), String::from_utf8_lossy(&run.stderr).into_owned())
}

#[test]
fn lesson_names_the_colours_of_the_weights() {
    let scene = Scene::empty(dvec2(1.0, 1.0), Dialect::Svg);
    let legend = Visualisation::Barycentric.legend(&scene).unwrap();
    let LegendKey::Triangle(corners) = legend.key else {
        panic!("{legend:?}")
    };
    let names = corners.map(|(color, corner)| {
        let [_, r, g, b] = color.to_be_bytes();
        let name = match (r > 150, g > 150, b > 150) {
            (true, true, false) => "yellow",
            (true, false, false) if g > 60 => "orange",
            (true, false, false) => "red",
            (false, true, false) => "green",
            (false, false, true) => "blue",
            _ => panic!("{color:x} has no name"),
        };
        (name, corner)
    });
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    session.run(Command::Lesson(LessonCommand::Open(LessonSource::BuiltIn(0))));
    let (lesson, _) = session.viewer.lesson().unwrap();
    let step = lesson.steps.iter().find(|step| step.title == "The weights themselves");
    let text = format!("{:?}", step.unwrap().text);
    for (name, corner) in names {
        let corner = corner.split(' ').next().unwrap();
        assert!(
            text.contains(&format!("{name} for the {corner}")),
            "{name}, {corner}: {text}"
        );
    }
}

/// The panel counts steps; a number before a title would be taken for another count of the same thing.
#[test]
fn lesson_titles_do_not_count_steps() {
    for (name, _) in BUILT_IN {
        let source = LessonSource::from_address(Path::new(&format!("lesson:{name}"))).unwrap();
        for step in source.read().unwrap().steps {
            let counts = step.title.starts_with(|first: char| first.is_ascii_digit());
            assert!(!counts, "{name}: {}", step.title);
        }
    }
}

/// The channel of a pixel that differs most.
fn apart(a: u32, b: u32) -> u32 {
    let channels = a.to_be_bytes().into_iter().zip(b.to_be_bytes());
    channels.map(|(a, b)| u32::from(a.abs_diff(b))).max().unwrap_or(0)
}

#[test]
fn taps_help_the_pixel_that_the_lesson_on_them_pins_in_windows_of_any_size() {
    let lesson = LessonSource::named("anisotropy").unwrap().read().unwrap();
    let pins: Vec<_> = lesson.steps.iter().filter_map(|step| step.pin).collect();
    assert_eq!(pins.len(), 5, "steps that pin a pixel");
    let name = "study/11_city_floor.svg";
    let document = SCENES.iter().find(|scene| scene.name == name).unwrap().document;
    let options = ReadOptions {
        dialect: DialectChoice::Auto,
    };
    let scene = rasterscope::scene::read(document.as_bytes(), name, options, &Textures).unwrap();
    let one_tap = RenderSettings {
        pixel_sampling: PixelSampling::Bilinear,
        level_sampling: LevelSampling::Linear,
        ..RenderSettings::default()
    };
    let taps = RenderSettings {
        anisotropy: Anisotropy::new(16).unwrap(),
        ..one_tap
    };
    let truth = RenderSettings {
        sample_rate: SampleRate::new(256).unwrap(),
        level_sampling: LevelSampling::Zero,
        ..one_tap
    };
    for pin in pins {
        for step in 0..40 {
            let (scale, part) = (0.5 + 0.05 * f64::from(step), f64::from(step) / 40.0);
            let view = View::At {
                center: pin + dvec2(part - 0.5, 0.3 - part) / scale * 0.9,
                scale,
                rotation: 0.0,
            };
            let middle = |settings: &RenderSettings| {
                let mut frame = Framebuffer::new(3, 3);
                draw(&scene, &view.transform(scene.canvas, [3, 3]), settings, &mut frame);
                frame.pixels()[4]
            };
            let truth = middle(&truth);
            let (one, many) = (apart(middle(&one_tap), truth), apart(middle(&taps), truth));
            assert!(
                many + 16 <= one,
                "{many} levels off with taps, {one} without, at scale {scale}"
            );
        }
    }
}
