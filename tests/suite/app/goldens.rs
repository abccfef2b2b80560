//! Pictures of the whole window, made without a display: panels, dialogs, inspector, both themes, two scales.

use std::path::{Path, PathBuf};

use rasterscope::app::{ScriptSource, ViewOptions, run};
use rasterscope::raster::Framebuffer;
use rasterscope::viewer::{Against, Theme};

use crate::support::golden;

/// Glyphs are rasterized in floats, and contrast is a power: on another processor a channel may round differently.
const TOLERANCE: u8 = 1;

/// One picture: its name, the window, the steps before it is taken.
struct Case {
    name: &'static str,
    size: [u32; 2],
    scale: f32,
    theme: Theme,
    steps: &'static str,
}

const CASES: [Case; 17] = [
    Case {
        name: "overlay_panel_dark",
        size: [800, 600],
        scale: 1.0,
        theme: Theme::Dark,
        steps: "panel on; move 300,300",
    },
    Case {
        name: "overlay_panel_light_2x",
        size: [800, 1100],
        scale: 2.0,
        theme: Theme::Light,
        steps: "panel on; rate 16; move 100,300",
    },
    Case {
        name: "overlay_help",
        size: [800, 600],
        scale: 1.0,
        theme: Theme::Dark,
        steps: "key ?",
    },
    Case {
        name: "overlay_palette",
        size: [520, 360],
        scale: 1.0,
        theme: Theme::Light,
        steps: "key Ctrl+Shift+P; type samp; key Down",
    },
    Case {
        name: "overlay_inspector",
        size: [520, 420],
        scale: 1.0,
        theme: Theme::Dark,
        steps: "pin 120,200; magnification 32; region 8; panel off",
    },
    Case {
        name: "overlay_inspector_samples",
        size: [800, 600],
        scale: 1.0,
        theme: Theme::Light,
        steps: "rate 16; pin 277,178; magnification 24; region 12; panel off; explanation off",
    },
    Case {
        name: "overlay_explanation",
        size: [900, 900],
        scale: 1.0,
        theme: Theme::Dark,
        steps: "rate 16; pin 585,178; magnification 16; panel off; move 120,339",
    },
    Case {
        name: "overlay_explanation_exact",
        size: [900, 900],
        scale: 1.0,
        theme: Theme::Light,
        steps: "coverage exact; pin 585,178; magnification 16; panel off",
    },
    Case {
        name: "overlay_explanation_smaa",
        size: [900, 900],
        scale: 1.0,
        theme: Theme::Dark,
        steps: "post-process smaa; pin 585,178; magnification 16; panel off",
    },
    Case {
        name: "overlay_explanation_light_2x",
        size: [1600, 1400],
        scale: 2.0,
        theme: Theme::Light,
        steps: "rate 4; pin 300,640; panel off",
    },
    Case {
        name: "overlay_inspector_small",
        size: [420, 420],
        scale: 1.0,
        theme: Theme::Dark,
        steps: "rate 4; pin 160,200; magnification 2; region 64; panel off",
    },
    Case {
        name: "overlay_panel_deep",
        size: [560, 480],
        scale: 1.0,
        theme: Theme::Dark,
        steps: "panel on; view -512.3456789,433.987654,12345678900",
    },
    Case {
        name: "overlay_compare_wipe",
        size: [900, 600],
        scale: 1.0,
        theme: Theme::Dark,
        steps: "panel on; key r; rate 16; key w; wait 6000",
    },
    Case {
        name: "overlay_compare_difference_2x",
        size: [1560, 1100],
        scale: 2.0,
        theme: Theme::Light,
        steps: "panel on; key r; rate 16; difference signed; key Shift+D; region 9; magnification 12; key n; wait 6000",
    },
    Case {
        name: "overlay_compare_side",
        size: [620, 420],
        scale: 1.0,
        theme: Theme::Dark,
        steps: "panel off; rate 4; side; rate 1; wait 6000",
    },
    Case {
        name: "overlay_go_to_pixel",
        size: [400, 300],
        scale: 1.5,
        theme: Theme::Light,
        steps: "key Ctrl+G; type 7; key Enter",
    },
    Case {
        name: "overlay_sheet",
        size: [800, 500],
        scale: 1.0,
        theme: Theme::Light,
        steps: "panel off; pin 300,178; magnification 8; explanation off; sheet; sheet-rows pattern grid,r2; move 2,2",
    },
];

fn picture(case: &Case, folder: &Path) -> Framebuffer {
    let document = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/basic/test4.svg");
    picture_of(document, case, folder)
}

fn picture_of(document: PathBuf, case: &Case, folder: &Path) -> Framebuffer {
    let file = folder.join("window.png");
    let steps = format!("{}; shot \"{}\"", case.steps, file.display());
    run(ViewOptions {
        paths: vec![document],
        size: Some(case.size),
        scale: Some(case.scale),
        theme: Some(case.theme),
        script: Some(ScriptSource::Text(steps)),
        headless: true,
        grammar: Some(rasterscope::cli::GRAMMAR),
        ..ViewOptions::default()
    })
    .unwrap();
    let image = image::open(&file).unwrap().into_rgba8();
    let mut frame = Framebuffer::new(image.width(), image.height());
    for (to, from) in frame.pixels_mut().iter_mut().zip(image.pixels()) {
        let [r, g, b, a] = from.0;
        *to = u32::from_be_bytes([a, r, g, b]);
    }
    frame
}

#[test]
fn overlay_goldens() {
    let folder = tempfile::tempdir().unwrap();
    let problems: Vec<String> = CASES
        .iter()
        .filter_map(|case| golden::check(case.name, &picture(case, folder.path()), TOLERANCE).err())
        .collect();
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

/// Texture, footprint, taps and texels of a pixel, and what B tells differently.
#[test]
fn overlay_explains_a_texture() {
    let folder = tempfile::tempdir().unwrap();
    let document = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/study/07_checker_floor.svg");
    let case = Case {
        name: "overlay_explanation_texture",
        size: [1280, 1150],
        scale: 1.0,
        theme: Theme::Light,
        steps: "panel off; pixel-sampling bilinear; level-sampling linear; key r; anisotropy 8; rate 4; pin 720,560",
    };
    let found = golden::check(case.name, &picture_of(document, &case, folder.path()), TOLERANCE);
    assert_eq!(found.err(), None, "as it was looked at");
}

/// The texel under the pointer is framed, and so are the pixels that it contributes to.
#[test]
fn overlay_lights_what_a_texel_feeds() {
    let folder = tempfile::tempdir().unwrap();
    let document = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/study/07_checker_floor.svg");
    let case = Case {
        name: "overlay_texel_feeds",
        size: [1100, 1000],
        scale: 1.0,
        theme: Theme::Dark,
        steps: "panel off; pixel-sampling bilinear; level-sampling linear; rate 4; pin 720,560; wait; move 190,770",
    };
    let found = golden::check(case.name, &picture_of(document, &case, folder.path()), TOLERANCE);
    assert_eq!(found.err(), None, "as it was looked at");
}

/// An edge by a filter that rings, beside the box and the truth.
#[test]
fn overlay_plots_an_edge() {
    let folder = tempfile::tempdir().unwrap();
    let document = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/study/14_one_edge.svg");
    let case = Case {
        name: "overlay_profile",
        size: [720, 520],
        scale: 1.0,
        theme: Theme::Dark,
        steps: "panel off; view 256,256,1; rate 16; key r; resolve-filter lanczos3; profile 345,200 378,204; move 551,300; wait 6000",
    };
    let found = golden::check(case.name, &picture_of(document, &case, folder.path()), TOLERANCE);
    assert_eq!(found.err(), None, "as it was looked at");
}

/// Three patterns beside the truth: where the pin is, the nearest first, A outlined.
#[test]
fn overlay_board_compares_settings() {
    let folder = tempfile::tempdir().unwrap();
    let document = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/study/01_zone_plate.svg");
    let case = Case {
        name: "overlay_board",
        size: [900, 560],
        scale: 1.0,
        theme: Theme::Light,
        steps: "panel off; view 256,256,1; rate 16; truth-space linear; board-vary pattern grid,sobol,r2; wait 6000",
    };
    let found = golden::check(case.name, &picture_of(document, &case, folder.path()), TOLERANCE);
    assert_eq!(found.err(), None, "as it was looked at");
}

/// The waves of a scene, with one too fine for pixels that is pointed at, and its stripes as pixels see them.
#[test]
fn overlay_shows_a_spectrum() {
    let folder = tempfile::tempdir().unwrap();
    let document = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/study/07_checker_floor.svg");
    let case = Case {
        name: "overlay_spectrum",
        size: [720, 520],
        scale: 1.0,
        theme: Theme::Dark,
        steps: "panel off; spectrum scene; wait; move 576,200; wait 3000",
    };
    let found = golden::check(case.name, &picture_of(document, &case, folder.path()), TOLERANCE);
    assert_eq!(found.err(), None, "as it was looked at");
}

/// A script always makes the same picture: nothing in it depends on time.
#[test]
fn overlay_pictures_repeat() {
    let folder = tempfile::tempdir().unwrap();
    let first = picture(&CASES[1], folder.path());
    assert!(
        first == picture(&CASES[1], folder.path()),
        "the same session, the same picture"
    );
}

/// The reader's notes take the height that the scenes leave.
#[test]
fn overlay_shows_all_notes() {
    const NOTES: usize = 12;
    let folder = tempfile::tempdir().unwrap();
    let document = folder.path().join("notes.svg");
    let unknown: Vec<String> = (0..NOTES).map(|number| format!("<unknown{number}/>")).collect();
    let text = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="10" height="10">{}</svg>"#,
        unknown.concat()
    );
    std::fs::write(&document, text).unwrap();
    let case = Case {
        name: "notes",
        size: [800, 1124],
        scale: 1.0,
        theme: Theme::Dark,
        steps: "panel on",
    };
    let frame = picture_of(document, &case, folder.path());
    // The warning colour's red and blue are far apart; nothing else in the panel is yellow.
    let is_yellow = |x, y| {
        let pixel = frame.rgba(x, y);
        pixel.is_some_and(|[r, g, b, _]| r > 150 && g > 100 && b < 110)
    };
    let written: Vec<bool> = (0..frame.height())
        .map(|y| (540..800).any(|x| is_yellow(x, y)))
        .collect();
    let lines = written.windows(2).filter(|rows| !rows[0] && rows[1]).count();
    assert_eq!(lines, NOTES, "one line for every note");
}

/// A command that is chosen before its argument was typed leaves the caret where the argument goes.
#[test]
fn overlay_palette_takes_an_argument_later() {
    let folder = tempfile::tempdir().unwrap();
    let after = |steps| {
        let case = Case {
            name: "palette",
            size: [700, 400],
            scale: 1.0,
            theme: Theme::Dark,
            steps,
        };
        picture(&case, folder.path())
    };
    let chosen = after("panel on; key Ctrl+Shift+P; type rate; key Enter; type 16; key Enter");
    assert!(chosen == after("panel on; rate 16"), "as if typed in one go");
    assert!(chosen != after("panel on"), "the rate is to be seen");
}

/// What the picture is compared with can be said at the start; a picture that cannot be read is the user's mistake.
#[test]
fn overlay_against_from_the_start() {
    let folder = tempfile::tempdir().unwrap();
    let document = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/basic/test4.svg");
    let file = folder.path().join("window.png");
    let options = |against: Option<Against>, script: Option<String>| ViewOptions {
        paths: vec![document.clone()],
        size: Some([640, 480]),
        against,
        script: script.map(ScriptSource::Text),
        screenshot_dir: Some(folder.path().to_owned()),
        headless: true,
        ..ViewOptions::default()
    };
    let shot = |against: Option<Against>, first: &str| {
        let script = format!("{first}hide on; shot \"{}\"", file.display());
        run(options(against, Some(script))).unwrap();
        image::open(&file).unwrap().into_rgba8()
    };
    let truth = shot(Some(Against::Truth(None)), "");
    assert!(truth == shot(None, "truth; "), "as if the command had been given");
    assert!(truth != shot(None, ""), "it is to be seen");
    let error = run(options(Some(Against::File("/nowhere/theirs.png".into())), None)).unwrap_err();
    let text = error.to_string();
    assert!(
        error.is_input() && text.contains("/nowhere/theirs.png") && !text.contains('\n'),
        "{text}"
    );
}

/// A mistake in a script is the user's, and told with its place.
#[test]
fn overlay_script_errors_are_input() {
    let options = ViewOptions {
        script: Some(ScriptSource::Text("key =; nonsense".to_owned())),
        headless: true,
        ..ViewOptions::default()
    };
    let error = run(options).unwrap_err();
    assert!(error.is_input(), "{error}");
    assert!(error.to_string().starts_with("--do:1:8: "), "{error}");
    let options = ViewOptions {
        script: Some(ScriptSource::File("/nowhere/script.txt".into())),
        headless: true,
        ..ViewOptions::default()
    };
    let error = run(options).unwrap_err();
    assert!(
        error.is_input() && error.to_string().contains("/nowhere/script.txt"),
        "{error}"
    );
}
