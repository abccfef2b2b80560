//! The library's front door: the example as it is printed, and its answers beside the program's.

use std::path::Path;

use rasterscope::post::PostProcess;
use rasterscope::{PictureError, RenderSettings, SampleRate, Scene, Settings, View, draw, explain, save_png};

use crate::support::program::done;

#[expect(dead_code, reason = "the program's own start is not called")]
#[path = "../../../examples/explain.rs"]
mod example;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn api_example_draws_a_file_and_explains_a_pixel() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("fox.png");
    let drawing = root().join("svg/illustration/02_fox.svg");
    let explanation = example::run(&drawing, &picture, [512, 512]).unwrap();
    let drawn = image::open(&picture).unwrap().into_rgba8();
    assert_eq!(drawn.dimensions(), (1024, 1024), "the picture");
    assert_eq!(
        drawn.get_pixel(512, 512).0,
        explanation.color,
        "the pixel is the picture's"
    );
    let text = explanation.to_string();
    assert!(text.starts_with("Pixel (512, 512) of 1024 x 1024\n"), "{text}");
    assert!(text.contains("02_fox.svg:"), "it quotes the drawing: {text}");
    let told = example::run(&root().join("no/such.svg"), &picture, [0, 0]).unwrap_err();
    assert!(told.to_string().contains("such.svg: cannot read"), "{told}");
}

#[test]
fn api_draws_and_explains_as_the_program_does() {
    let folder = tempfile::tempdir().unwrap();
    let scene = root().join("svg/study/11_city_floor.svg");
    let address = scene.to_str().unwrap();
    let settings = Settings {
        size: [200, 120],
        render: RenderSettings {
            sample_rate: SampleRate::new(4).unwrap(),
            ..RenderSettings::default()
        },
        ..Settings::default()
    };
    let options = ["--size", "200x120", "--sample-rate", "4"];
    let scene = Scene::load(address).unwrap();
    save_png(&draw(&scene, &settings).unwrap(), &folder.path().join("ours.png")).unwrap();
    done(
        folder.path(),
        &[&["render", address, "-o", "theirs.png"], options.as_slice()].concat(),
    );
    let bytes = |name: &str| image::open(folder.path().join(name)).unwrap().into_rgba8();
    assert_eq!(bytes("ours.png"), bytes("theirs.png"), "pixel by pixel");
    let text = done(
        folder.path(),
        &[&["inspect", address, "--pixel", "90,70"], options.as_slice()].concat(),
    );
    assert_eq!(
        explain(&scene, &settings, [90, 70]).unwrap().to_string(),
        text.trim_end(),
        "word by word"
    );
}

/// Such a frame takes a gigabyte; the pixel depends on the few around it, and those are all that is drawn.
#[test]
fn api_explains_a_smoothed_pixel_at_the_corner_of_the_largest_frame() {
    let file = root().join("svg/basic/test1.svg");
    let scene = Scene::load(&file).unwrap();
    let mut settings = Settings {
        size: [16_384, 16_384],
        view: View::Canvas,
        ..Settings::default()
    };
    settings.render.post_process = PostProcess::Smaa;
    let pixel = [16_383, 16_383];
    let whole = explain(&scene, &settings, pixel).unwrap();
    let smoothed = whole.smoothing.expect("what was done to the pixel");
    assert_eq!(smoothed.after, whole.color, "at the frame's corner");
}

#[test]
fn api_refuses_in_one_line() {
    let file = root().join("svg/basic/test1.svg");
    let scene = Scene::load(&file).unwrap();
    let sized = |size| Settings {
        size,
        view: View::Canvas,
        ..Settings::default()
    };
    for size in [[0, 5], [5, 0], [16_385, 1]] {
        let error = PictureError::Size(size[0], size[1]);
        assert_eq!(draw(&scene, &sized(size)).unwrap_err(), error, "{size:?}");
        assert_eq!(explain(&scene, &sized(size), [0, 0]).unwrap_err(), error, "{size:?}");
    }
    let told = explain(&scene, &sized([4, 3]), [4, 0]).unwrap_err();
    assert_eq!(told.to_string(), "pixel 4,0 is outside the picture of 4x3 pixels");
    assert!(explain(&scene, &sized([4, 3]), [3, 2]).is_ok(), "the last pixel");
}
