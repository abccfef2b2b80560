//! A and B with a dialect each: the scene is read twice.

use std::fs;

use rasterscope::raster::Framebuffer;
use rasterscope::render::{self, RenderSettings};
use rasterscope::scene::{self, Dialect, DialectChoice};
use rasterscope::viewer::{
    AbCommand, Against, Arrangement, Command, InspectorCommand, Other, SceneCommand, ViewCommand, Viewer,
    ViewerOptions, picture,
};

use crate::support::session::{Session, set};

/// The dialect `course` ignores the `viewBox`, so that all is half as large, and skips the circle.
const BOXED: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" viewBox="0 0 50 50">
  <polygon fill="#1f6feb" points="5,5 45,9 20,45"/>
  <circle fill="#edae49" cx="35" cy="35" r="9"/>
</svg>"##;

/// The session's only scene, read in `dialect` and drawn from where A is seen.
fn drawn(session: &Session, dialect: DialectChoice, settings: &RenderSettings) -> Framebuffer {
    let scene = scene::load(&session.folder.path().join("1.svg"), dialect).unwrap();
    let entry = session.viewer.scene_list().current().unwrap();
    let size = session.viewer.both().layout().frame_size();
    let view = entry.camera.view().transform(entry.scene().unwrap().canvas, size);
    let mut frame = Framebuffer::new(size[0], size[1]);
    render::draw(&scene, &view, settings, &mut frame);
    frame
}

fn assert_both(session: &Session, dialects: [DialectChoice; 2], when: &str) {
    let viewer = &session.viewer;
    let own = drawn(session, dialects[0], &viewer.settings().render);
    assert!(*session.pixels() == own, "{when}: A in {:?}", dialects[0]);
    let other = drawn(
        session,
        dialects[1],
        &viewer.ab().other_settings(viewer.settings()).unwrap(),
    );
    assert!(
        *viewer.ab().other_pixels().unwrap() == other,
        "{when}: B in {:?}",
        dialects[1]
    );
    assert!(own != other, "{when}: they differ");
}

#[test]
fn dialects_of_a_and_b_are_their_own() {
    use DialectChoice::{Auto, Course, Svg};
    let mut session = Session::open(&[BOXED], [200, 160]);
    session.run(Command::Ab(AbCommand::Compare(Against::Settings)));
    session.run(Command::Ab(AbCommand::Arrange(Arrangement::Wipe)));
    session.run(set("dialect", Course.name()));
    assert_both(&session, [Course, Auto], "A reads anew, B does not");
    let title = session.viewer.both().title();
    assert!(title.contains("dialect course | auto"), "{title}");
    session.run(Command::View(ViewCommand::PanBy {
        by: glam::dvec2(7.0, -3.0),
    }));
    assert_both(&session, [Course, Auto], "they move together");
    session.run(Command::Ab(AbCommand::Swap));
    assert_eq!(
        session.viewer.settings().dialect,
        Auto,
        "the dialect changes places, too"
    );
    assert_both(&session, [Auto, Course], "swapped");
    session.run(set("dialect", Svg.name()));
    assert_both(&session, [Svg, Course], "A's choice leaves B alone");
    session.run(Command::Inspector(InspectorCommand::Pin([100, 80])));
    assert!(session.viewer.inspector().explanation().is_some(), "A is explained");
    let [own, other] = [
        session.viewer.inspector().explanation(),
        session.viewer.inspector().other_explanation(),
    ]
    .map(Option::unwrap);
    assert_eq!(
        [own.color, other.color],
        [
            session.pixels().rgba(100, 80).unwrap(),
            session.viewer.ab().other_pixels().unwrap().rgba(100, 80).unwrap()
        ],
        "each in its dialect"
    );
    let path = session.folder.path().join("1.svg");
    fs::write(&path, BOXED.replace("#1f6feb", "#d1495b")).unwrap();
    session.run(Command::Scenes(SceneCommand::Reload));
    assert_both(&session, [Svg, Course], "both are read again");
    session.run(set("dialect", Course.name()));
    let same = session.pixels() == session.viewer.ab().other_pixels().unwrap();
    assert!(same, "one dialect, one scene");
    assert!(
        !session.viewer.both().title().contains("dialect"),
        "{}",
        session.viewer.both().title()
    );
    session.run(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    session.run(set("dialect", Svg.name()));
    assert_both(&session, [Svg, Svg], "the truth is that of A's dialect");
}

#[test]
fn other_reading_holds_for_the_folder() {
    use DialectChoice::{Auto, Course, Svg};
    let mut session = Session::open(&[BOXED, BOXED], [120, 100]);
    let is_read = |session: &Session, dialect, when: &str| {
        let own = drawn(session, dialect, &session.viewer.settings().render);
        assert!(*session.pixels() == own, "{when}");
    };
    is_read(&session, Svg, "at first");
    let note = session
        .viewer
        .scene_list()
        .reading_note(session.viewer.settings().dialect)
        .unwrap();
    assert_eq!(note, "read as svg; as course it is another picture", "the note");
    let words = |session: &Session| session.viewer.scene_list().reading_words();
    assert_eq!(words(&session).as_deref(), Some("read as svg"), "the status line");
    session.run(Command::Scenes(SceneCommand::OtherReading));
    assert_eq!(session.viewer.settings().dialect, Auto, "the setting stays");
    is_read(&session, Course, "after the button");
    assert_eq!(words(&session).as_deref(), Some("read as course"), "the status line");
    let note = session
        .viewer
        .scene_list()
        .reading_note(session.viewer.settings().dialect)
        .unwrap();
    assert!(
        note.starts_with("read as course, as you chose for its folder"),
        "{note}"
    );
    let line = session.viewer.recipes().command_line().unwrap();
    assert!(
        line.contains("--dialect course"),
        "the command line makes the same: {line}"
    );
    session.run(Command::Scenes(SceneCommand::Show(1)));
    is_read(&session, Course, "the next of the folder");
    session.run(Command::Scenes(SceneCommand::OtherReading));
    session.run(Command::Scenes(SceneCommand::Show(0)));
    is_read(&session, Svg, "back again, for both");
    session.run(set("rules", rasterscope::rules::Rules::Course.name()));
    let line = session.viewer.recipes().command_line().unwrap();
    assert!(line.contains("--dialect svg"), "rules alone would say course: {line}");
    session.run(set("dialect", Course.name()));
    session.run(Command::Scenes(SceneCommand::OtherReading));
    assert_eq!(
        session.viewer.settings().dialect,
        Svg,
        "a setting is what changes where there is one"
    );
}

#[test]
fn dialects_change_with_scenes() {
    let mut session = Session::open(&[BOXED, BOXED], [120, 100]);
    session.run(Command::Ab(AbCommand::Compare(Against::Settings)));
    session.run(Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)));
    session.run(set("dialect", DialectChoice::Course.name()));
    for index in [1, 0, 1] {
        session.run(Command::Scenes(SceneCommand::Show(index)));
        assert_both(&session, [DialectChoice::Course, DialectChoice::Auto], "the next scene");
    }
}

#[test]
fn settings_for_b_are_written_as_the_command_line_has_them() {
    let mut session = Session::open(&[BOXED], [120, 100]);
    let against = Against::from_text("sample-rate 16, dialect course").unwrap();
    session.run(Command::Ab(AbCommand::Compare(against)));
    assert_eq!(session.viewer.settings().render.sample_rate.samples(), 1, "A stays");
    assert_eq!(session.viewer.settings().dialect, DialectChoice::Auto, "in its dialect");
    match session.viewer.ab().other() {
        Some(Other::Settings { render, dialect }) => {
            assert_eq!(
                (render.sample_rate.samples(), *dialect),
                (16, DialectChoice::Course),
                "B has them"
            );
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(
        session.viewer.ab().arrangement(),
        Arrangement::Wipe,
        "to be seen at once"
    );
    assert_both(&session, [DialectChoice::Auto, DialectChoice::Course], "from the start");
    for wrong in [
        "sample-rate 0",
        "sample-rate 4, nonsense 3",
        "dialect",
        "sample-rate 4,",
        "rules other",
    ] {
        let settings = Against::from_text(wrong);
        let is_path = wrong == "dialect";
        assert_eq!(
            matches!(settings, Some(Against::File(_))),
            is_path,
            "{wrong}: {settings:?}"
        );
        assert!(is_path || settings.is_none(), "{wrong}: {settings:?}");
    }
    let picture = Against::from_text("my picture, 2.png");
    assert_eq!(
        picture,
        Some(Against::File("my picture, 2.png".into())),
        "a path may have blanks and commas"
    );
    assert!(
        picture::find("lod-per").is_some() && picture::find("size").is_none(),
        "settings only"
    );
}

#[test]
fn drawings_that_only_svg_can_be_are_that_among_scenes_of_the_course() {
    let folder = tempfile::tempdir().unwrap();
    let own = "<svg width='40' height='30'><colortri points='0 0 40 0 0 30' colors='1 0 0 1 0 1 0 1 0 0 1 1'/></svg>";
    let only_svg = "<svg width='40' height='30'><path d='M0 0h40v30z' fill='#ff0000'/></svg>";
    for (name, document) in [("1.svg", BOXED), ("2.svg", own), ("3.svg", only_svg)] {
        fs::write(folder.path().join(name), document).unwrap();
    }
    let mut viewer = Viewer::new(ViewerOptions {
        paths: vec![folder.path().to_owned()],
        window: [120, 100],
        ..ViewerOptions::default()
    })
    .unwrap();
    for expected in [Dialect::Course, Dialect::Course, Dialect::Svg] {
        viewer.finish();
        let entry = viewer.scene_list().current().unwrap();
        assert_eq!(entry.scene().unwrap().dialect, expected, "{}", entry.label);
        let _ = viewer.apply(Command::Scenes(SceneCommand::Next));
    }
}
