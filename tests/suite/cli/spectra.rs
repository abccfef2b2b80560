//! `rasterscope spectrum`: the waves of a picture, and which of them are aliases.

use std::fs;
use std::path::Path;

use rasterscope::figure::Record;

use crate::support::program::{done, run};
use crate::support::refusal::assert_refused;

/// Upright stripes of a triangle wave, 0.7 periods in a unit, which is a pixel.
const STRIPES: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="200" height="160">
  <linearGradient id="g" gradientUnits="userSpaceOnUse" x1="0" x2="0.7142857" spreadMethod="reflect">
    <stop offset="0" stop-color="#000"/><stop offset="1" stop-color="#fff"/>
  </linearGradient>
  <rect width="200" height="160" fill="url(#g)"/>
</svg>"##;
const VIEW: &[&str] = &["--size=200x160", "--view=canvas"];

/// The object of `--json` about the stripes.
fn report(options: &[&str]) -> serde_json::Value {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("stripes.svg"), STRIPES).unwrap();
    let words = [&["spectrum", "stripes.svg", "--json"], VIEW, options].concat();
    serde_json::from_str(&done(folder.path(), &words)).unwrap()
}

fn numbers(value: &serde_json::Value) -> [f64; 2] {
    [0, 1].map(|i| value[i].as_f64().unwrap())
}

fn assert_near(found: [f64; 2], expected: [f64; 2], what: &str) {
    let off = (found[0] - expected[0]).hypot(found[1] - expected[1]);
    assert!(off < 0.006, "{what}: {found:?} for {expected:?}");
}

#[test]
fn spectrum_tells_an_alias_and_whence_it_is() {
    let frame = report(&[]);
    let peak = &frame["peaks"][0];
    assert_near(numbers(&peak["frequency"]), [0.3, 0.0], "folded");
    let [x, y] = numbers(&peak["from"]);
    assert_near([x.abs(), y], [0.7, 0.0], "its source");
    assert!(peak["alias"].as_f64().unwrap() > 0.9, "wholly: {peak}");
    assert!((peak["wavelength"].as_f64().unwrap() - 1.0 / 0.3).abs() < 0.1, "{peak}");
    let scene = report(&["--of=scene"]);
    assert!((scene["reach"].as_f64().unwrap() - 1.5).abs() < 1e-9, "{scene}");
    let peak = &scene["peaks"][0];
    assert_near(numbers(&peak["frequency"]), [0.7, 0.0], "before sampling");
    assert_near(numbers(&peak["seen_at"]), [-0.3, 0.0], "where it lands");
    let smooth = report(&["--sample-rate=256"]);
    let weaker = frame["peaks"][0]["decibels"].as_f64().unwrap() - smooth["peaks"][0]["decibels"].as_f64().unwrap();
    // sinc(0.7) in dB.
    assert!((weaker - 8.68).abs() < 0.3, "the box takes {weaker} dB");
}

/// Upright black bars of half a pitch on 64 pixels of white: waves of one, three, five ... periods in each pitch, and no others.
fn bars(folder: &Path, pitch: f64) -> serde_json::Value {
    let bar = |index: u32| {
        let at = f64::from(index) * pitch;
        format!(r#"<rect x="{at}" width="{}" height="64"/>"#, pitch / 2.0)
    };
    let bars: String = (0..64).map(bar).collect();
    let text = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="64" height="64">{bars}</svg>"#);
    fs::write(folder.join("bars.svg"), text).unwrap();
    let words = ["spectrum", "bars.svg", "--json", "--size=64x64", "--view=canvas"];
    let [frame, scene] = ["--of=frame", "--of=scene"].map(|of| {
        let said = done(folder, &[&words[..], &[of, "--peaks=4"]].concat());
        serde_json::from_str::<serde_json::Value>(&said).unwrap()["peaks"].clone()
    });
    serde_json::json!({ "frame": frame, "scene": scene })
}

#[test]
fn spectrum_names_no_wave_that_the_scene_does_not_have() {
    let folder = tempfile::tempdir().unwrap();
    for (pitch, first, alias) in [(1.6, 0.625, 0.125), (1.0 / 0.703_125, 0.703_125, 0.109_375)] {
        let found = bars(folder.path(), pitch);
        let scene = found["scene"].as_array().unwrap();
        assert_eq!(
            scene.len(),
            1,
            "{pitch}: its third wave is beyond what is shown: {scene:?}"
        );
        assert_near(numbers(&scene[0]["frequency"]), [first, 0.0], "its first");
        let mut peaks = found["frame"].as_array().unwrap().iter();
        let third = peaks.find(|peak| (numbers(&peak["frequency"])[0] - alias).abs() < 0.006);
        let third = third.unwrap_or_else(|| panic!("{pitch}: no alias of the third wave in {found}"));
        let [x, y] = numbers(&third["from"]);
        assert_near([x.abs(), y], [3.0 * first, 0.0], "its third");
        assert!(third["alias"].as_f64().unwrap() > 0.9, "wholly: {third}");
    }
}

#[test]
fn spectrum_of_the_difference_is_what_the_truth_has_not() {
    let own = report(&["--of=difference", "--sample-rate=256", "--pattern=hammersley"]);
    assert_eq!(own["peaks"], serde_json::json!([]), "the truth itself");
    let error = report(&["--of=difference"]);
    assert_near(numbers(&error["peaks"][0]["frequency"]), [0.3, 0.0], "the alias");
}

#[test]
fn spectrum_of_a_texture_is_in_texels() {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/study/06_zone_texture.svg");
    let words = [
        "spectrum",
        scene.to_str().unwrap(),
        "--json",
        "--of=texture",
        "--size=256x256",
    ];
    let zero = done(Path::new(env!("CARGO_TARGET_TMPDIR")), &words);
    let zero: serde_json::Value = serde_json::from_str(&zero).unwrap();
    let level = zero["level"].as_str().unwrap();
    assert!(level.starts_with("level 0 of "), "{level}");
    assert!(
        zero["peaks"][0]["in_pixels"].is_array(),
        "and in pixels: {}",
        zero["peaks"][0]
    );
    let coarse = [&words[..], &["--level-sampling=nearest"]].concat();
    let coarse: serde_json::Value =
        serde_json::from_str(&done(Path::new(env!("CARGO_TARGET_TMPDIR")), &coarse)).unwrap();
    assert_ne!(coarse["level"], zero["level"], "the level that is read");
}

#[test]
fn spectrum_writes_a_picture_and_a_table() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("stripes.svg"), STRIPES).unwrap();
    let words = [
        &[
            "spectrum",
            "stripes.svg",
            "-o",
            "s.png",
            "--csv",
            "s.csv",
            "--region=20,10,128,128",
            "--peaks=2",
        ],
        VIEW,
    ]
    .concat();
    let text = done(folder.path(), &words);
    assert!(
        text.contains("frame: stripes.svg, 128 x 128 pixels from 20, 10"),
        "{text}"
    );
    assert!(text.contains("alias of "), "{text}");
    let picture = image::open(folder.path().join("s.png")).unwrap().into_rgba8();
    let orange = picture.pixels().filter(|pixel| pixel[0] > 200 && pixel[2] < 60).count();
    assert!(orange > 8, "{orange} pixels of the alias's band, besides the legend's");
    let table = fs::read_to_string(folder.path().join("s.csv")).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    assert!(lines[0].starts_with("across,down,wavelength,"), "{table}");
    assert_eq!(lines.len(), 3, "two waves: {table}");
    let columns = |line: &str| line.split(',').count();
    assert!(lines.iter().all(|line| columns(line) == columns(lines[0])), "{table}");
    // Ours is replaced; another's is not.
    done(folder.path(), &words);
    fs::write(folder.path().join("s.csv"), "mine\n1\n").unwrap();
    assert_refused(&run(folder.path(), &words), &words, &["s.csv", "--force"]);
    assert_eq!(
        fs::read_to_string(folder.path().join("s.csv")).unwrap(),
        "mine\n1\n",
        "untouched"
    );
}

#[test]
fn spectrum_pictures_say_their_settings() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("stripes.svg"), STRIPES).unwrap();
    let heading = |more: &[&str]| {
        done(
            folder.path(),
            &[&["spectrum", "stripes.svg", "-o", "s.png"], VIEW, more].concat(),
        );
        let picture = image::open(folder.path().join("s.png")).unwrap().into_rgba8();
        // Above the square.
        image::imageops::crop_imm(&picture, 0, 0, picture.width(), 48).to_image()
    };
    let (plain, other) = (heading(&[]), heading(&["--pattern=sobol"]));
    assert!(plain != other, "a setting is told");
    assert!(heading(&[]) == plain, "always the same");
}

#[test]
fn spectrum_says_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("stripes.svg"), STRIPES).unwrap();
    for (options, cure) in [
        (&["--region=200,0,10,10"][..], "from 0,0 to 199,159"),
        (&["--of=texture"], "shows no texture"),
        (&["-o", "s.jpg"], "ends in .png"),
        (&["-o", "no/such/s.png"], "choose another place with -o"),
    ] {
        let words = [&["spectrum", "stripes.svg"], VIEW, options].concat();
        assert_refused(&run(folder.path(), &words), &words, &[cure]);
    }
    let one = done(folder.path(), &["spectrum", "stripes.svg", "--size=1x1", "--of=scene"]);
    assert!(one.contains("No wave stands out"), "a single pixel: {one}");
    let large = done(folder.path(), &["spectrum", "stripes.svg", "--size=900x300"]);
    assert!(large.contains("at most 512 x 512 pixels are transformed"), "{large}");
}

#[test]
fn spectrum_without_waves_says_why() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("stripes.svg"), STRIPES).unwrap();
    let plain = r##"<svg xmlns="http://www.w3.org/2000/svg" width="200" height="160">
      <rect x="-99" y="-99" width="999" height="999" fill="#7a3"/></svg>"##;
    fs::write(folder.path().join("plain.svg"), plain).unwrap();
    for (scene, options, why) in [
        (
            "stripes.svg",
            &["--of=difference", "--sample-rate=256", "--pattern=hammersley"][..],
            "the picture is the truth here",
        ),
        ("plain.svg", &["--of=difference"], "the picture is the truth here"),
        ("plain.svg", &[], "all is of one colour"),
        ("plain.svg", &["--of=scene"], "all is of one colour"),
    ] {
        let said = done(
            folder.path(),
            &[&["spectrum", scene, "--dialect=svg"], VIEW, options].concat(),
        );
        assert!(said.contains(why), "{options:?} of {scene}: {said}");
    }
}

#[test]
fn spectrum_pictures_tell_how_they_were_made() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("stripes.svg"), STRIPES).unwrap();
    let options = ["--of=scene", "--region=20,10,96,80", "--sample-rate=4", "-o", "s.png"];
    done(folder.path(), &[&["spectrum", "stripes.svg"], VIEW, &options].concat());
    let record = Record::of_file(&folder.path().join("s.png")).unwrap().unwrap();
    assert_eq!(
        record.settings.get("sample-rate").map(String::as_str),
        Some("4"),
        "its settings"
    );
    for word in ["spectrum", "--of=scene", "--region=20,10,96,80"] {
        assert!(record.arguments.iter().any(|known| known == word), "{word}: {record:?}");
    }
    let said = done(folder.path(), &["rerun", "s.png", "--check"]);
    assert!(said.starts_with("s.png: the same, all"), "{said}");
    let elsewhere = tempfile::tempdir().unwrap();
    let said = done(
        elsewhere.path(),
        &["rerun", folder.path().join("s.png").to_str().unwrap(), "--check"],
    );
    assert!(
        said.contains(": the same, all"),
        "no folder stands in the picture: {said}"
    );
    // Its scene and settings stand for the picture, as those of a board do.
    done(folder.path(), &["render", "s.png", "-o", "again.png"]);
    let frame = image::open(folder.path().join("again.png")).unwrap();
    assert_eq!(
        (frame.width(), frame.height()),
        (200, 160),
        "the picture that was transformed"
    );
}
