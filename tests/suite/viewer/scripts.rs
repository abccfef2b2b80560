//! Scripted sessions without a window.

use rasterscope::viewer::script::{Script, Step, ViewerStage, play};

use crate::support::session::{Session, TRIANGLES};

#[test]
fn script_plays_like_a_hand() {
    let mut session = Session::open(&[TRIANGLES], [640, 480]);
    let shot = session.folder.path().join("out shot.png");
    assert!(
        Script::parse("key =; rate 16 # is no comment", "s").is_err(),
        "a comment starts a step"
    );
    let text = format!(
        "# A session.
        key =; key =
        pin 300,200; key Shift+Right
        drag 10,10 25,18
        resize 500x400; leave
        shot \"{}\"
        key ctrl+c
        quit
        rate 1",
        shot.display()
    );
    let script = Script::parse(&text, "session").unwrap();
    let mut stage = ViewerStage::new(&mut session.viewer);
    let late = play(&script, "session", &mut stage).unwrap_err()[0].to_string();
    assert!(
        late.starts_with("session:9:9: it is not played"),
        "after the end: {late}"
    );
    let copied = stage.clipboard.clone().unwrap();
    assert!(
        copied.starts_with("pixel 255, 168  user 95.25, 30.25"),
        "the pin stays where pixel 310, 200 was in the scene: {copied}"
    );
    let viewer = &session.viewer;
    assert_eq!(viewer.settings().render.sample_rate.samples(), 9, "nothing after quit");
    assert_eq!(viewer.chrome().window_size(), [500, 400], "resized");
    assert!(!viewer.scene_list().current().unwrap().camera.is_default(), "dragged");
    let picture = image::open(&shot).unwrap().into_rgba8();
    let window = viewer.window().picture();
    assert_eq!(picture.dimensions(), (500, 400), "the whole window");
    let same = picture
        .enumerate_pixels()
        .all(|(x, y, pixel)| window.rgba(x, y) == Some(pixel.0));
    assert!(same, "frame and inset");
}

/// The page of scripts shows steps that scripts understand, and says how to quote.
#[test]
fn script_page_is_understood() {
    let page = include_str!("../../../src/cli/help/scripts.md");
    let block = page.split("```").nth(1).expect("examples");
    let examples = block.lines().skip(1).map(|line| line.split("   ").next().unwrap());
    let count: usize = examples
        .map(|steps| Script::parse(steps, "page").unwrap().steps.len())
        .sum();
    assert!(count > 15, "{count} steps");
    for text in ["a;b", "a\nb", " a "] {
        let script = Script::parse(&format!("type \"{text}\""), "quoted").unwrap();
        let steps: Vec<&Step> = script.steps.iter().map(|step| &step.step).collect();
        assert_eq!(steps, [&Step::Type(text.to_owned())], "{text:?} in quotes");
        let bare = Script::parse(&format!("type {text}"), "bare");
        let is_same = bare.is_ok_and(|bare| bare.steps == script.steps);
        assert!(!is_same, "{text:?} without quotes");
    }
}

#[test]
fn script_failure_names_its_place() {
    let mut session = Session::open(&[TRIANGLES], [64, 48]);
    let script = Script::parse("key =\n  shot no/such/folder/x.png", "do").unwrap();
    let mut stage = ViewerStage::new(&mut session.viewer);
    let errors = play(&script, "do", &mut stage).unwrap_err();
    let [error] = errors.as_slice() else {
        panic!("one step failed: {errors:?}");
    };
    assert!(
        error
            .to_string()
            .starts_with("do:2:3: no/such/folder/x.png: cannot write"),
        "{error}"
    );
}
