//! Files that change while they are shown.

use std::fs;
use std::time::Duration;

use glam::dvec2;
use rasterscope::figure::save_png;
use rasterscope::raster::Framebuffer;
use rasterscope::viewer::{AbCommand, Against, Arrangement};
use rasterscope::viewer::{Command, InspectorCommand, LessonCommand, LessonSource, MessageKind, SceneCommand, Toggle};
use rasterscope::viewer::{ViewCommand, ViewNumbers, Viewer, ViewerOptions, WindowCommand};

use crate::support::session::{SQUARE, Session, TRIANGLES, set};

/// Tells the viewer that the files it shows were saved.
fn saved(session: &mut Session) {
    let files = session.viewer.files();
    session.run(Command::Scenes(SceneCommand::FilesChanged(files)));
}

fn errors(session: &Session) -> Vec<String> {
    let messages = session.viewer.chrome().messages().iter();
    let errors = messages.filter(|message| message.kind == MessageKind::Error);
    errors.map(|message| message.text.clone()).collect()
}

#[test]
fn broken_file_keeps_the_picture_until_it_is_mended() {
    let mut session = Session::open(&[TRIANGLES], [200, 150]);
    let file = session.folder.path().join("1.svg");
    assert_eq!(session.viewer.files(), std::slice::from_ref(&file), "what is shown");
    session.run(Command::View(ViewCommand::Set(ViewNumbers {
        center: dvec2(20.0, 20.0),
        scale: 3.0,
        rotation: 10.0,
    })));
    session.run(Command::Inspector(InspectorCommand::Pin([100, 75])));
    session.viewer.request_thumbnail(0);
    session.viewer.finish_thumbnails();
    let (picture, view) = (session.pixels().clone(), session.viewer.both().view_numbers());
    for half in ["", "<svg", &TRIANGLES[..TRIANGLES.len() / 2]] {
        fs::write(&file, half).unwrap();
        saved(&mut session);
        assert!(*session.pixels() == picture, "as it was read last");
        assert_eq!(session.viewer.both().view_numbers(), view, "from the same place");
        assert!(
            session.viewer.inspector().explanation().is_some(),
            "a pixel can still be explained"
        );
        let entry = session.viewer.scene_list().current().unwrap();
        assert!(entry.thumbnail.is_some(), "and it keeps its thumbnail");
        let failure = entry.failure().expect("it is told").to_owned();
        assert!(failure.contains("1.svg"), "{failure}");
        assert_eq!(errors(&session), [""; 0], "beside the picture, for as long as it is so");
    }
    fs::write(&file, SQUARE).unwrap();
    saved(&mut session);
    assert!(*session.pixels() != picture, "the new document");
    session.assert_frame_is_current();
    assert_eq!(session.viewer.both().view_numbers(), view, "from the same place");
    assert_eq!(session.viewer.pixels().pinned(), Some([100, 75]), "the pin stays");
    assert_eq!(errors(&session), [""; 0], "nothing is wrong any more");
    fs::remove_file(&file).unwrap();
    saved(&mut session);
    assert!(
        session.viewer.frames().frame().is_some(),
        "a file that is gone is shown on"
    );
    fs::write(&file, TRIANGLES).unwrap();
    saved(&mut session);
    assert!(*session.pixels() == picture, "and back");
}

#[test]
fn files_are_followed_unless_that_is_not_wanted() {
    let mut session = Session::open(&[TRIANGLES], [100, 80]);
    let file = session.folder.path().join("1.svg");
    let picture = session.pixels().clone();
    session.run(Command::Scenes(SceneCommand::FollowFiles(Toggle::Off)));
    fs::write(&file, SQUARE).unwrap();
    saved(&mut session);
    assert!(*session.pixels() == picture, "not wanted");
    session.run(Command::Scenes(SceneCommand::FollowFiles(Toggle::On)));
    saved(&mut session);
    assert!(*session.pixels() != picture, "wanted");
}

#[test]
fn scene_that_was_saved_behind_another_is_read_again_when_it_is_shown() {
    let mut session = Session::open(&[TRIANGLES, TRIANGLES], [100, 80]);
    let second = session.folder.path().join("2.svg");
    let show = |session: &mut Session, index: usize| {
        session.run(Command::Scenes(SceneCommand::Show(index)));
    };
    let behind = |session: &mut Session, document: &str| {
        show(session, 0);
        fs::write(&second, document).unwrap();
        show(session, 1);
    };
    show(&mut session, 1);
    let picture = session.pixels().clone();
    let failure = |session: &Session| {
        let entry = session.viewer.scene_list().current().unwrap();
        entry.failure().map(str::to_owned)
    };
    behind(&mut session, SQUARE);
    assert!(*session.pixels() != picture, "the new document");
    let square = session.pixels().clone();
    behind(&mut session, "<svg");
    assert!(failure(&session).is_some(), "it is told that it is broken");
    assert!(*session.pixels() == square, "as it was read last");
    behind(&mut session, TRIANGLES);
    assert_eq!(failure(&session), None, "mended");
    assert!(*session.pixels() == picture, "the first document");
    show(&mut session, 0);
    fs::remove_file(&second).unwrap();
    show(&mut session, 1);
    assert!(failure(&session).is_some(), "it is told that it is gone");
    session.run(Command::Scenes(SceneCommand::FollowFiles(Toggle::Off)));
    behind(&mut session, TRIANGLES);
    assert!(failure(&session).is_some(), "not wanted");
}

#[test]
fn texture_that_was_saved_behind_another_scene_is_read_again_when_its_scene_is_shown() {
    let textured = r#"<svg xmlns="http://www.w3.org/2000/svg" width="40" height="40">
      <image href="t.png" width="40" height="40"/></svg>"#;
    let mut session = Session::open(&[TRIANGLES, textured], [100, 80]);
    let texture = session.folder.path().join("t.png");
    let mut show = |index: usize, color: u32, size: u32| {
        let mut picture = Framebuffer::new(size, size);
        picture.pixels_mut().fill(color);
        save_png(&picture, &texture).unwrap();
        session.run(Command::Scenes(SceneCommand::Show(index)));
        session.pixels().clone()
    };
    let red = show(1, 0xffff_0000, 4);
    show(0, 0xff00_00ff, 5);
    assert!(show(1, 0xff00_00ff, 6) != red, "the texture of now");
}

#[test]
fn picture_to_compare_with_is_followed() {
    let mut session = Session::open(&[TRIANGLES], [100, 80]);
    let file = session.folder.path().join("b.png");
    let write = |color: u32, size: [u32; 2]| {
        let mut picture = Framebuffer::new(size[0], size[1]);
        picture.pixels_mut().fill(color);
        // There may be none yet.
        let _ = fs::remove_file(&file);
        save_png(&picture, &file).unwrap();
    };
    let other = |session: &Session| session.viewer.ab().other_pixels().unwrap().clone();
    let differing = |session: &Session| session.viewer.both().measures().unwrap().0.levels.differing();
    write(0xffff_0000, [60, 40]);
    session.run(Command::Ab(AbCommand::Compare(Against::File(file.clone()))));
    session.run(Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)));
    session.run(Command::Ab(AbCommand::Swap));
    assert!(session.viewer.files().contains(&file), "it is among the files");
    let (red, differing_red) = (other(&session), differing(&session));
    save_png(session.pixels(), &file.with_extension("own.png")).unwrap();
    fs::rename(file.with_extension("own.png"), &file).unwrap();
    saved(&mut session);
    assert!(other(&session) == *session.pixels(), "as it was saved");
    assert!(differing_red > 0 && differing(&session) == 0, "measured anew");
    assert!(session.viewer.ab().is_swapped(), "on the same side");
    write(0xffff_0000, [60, 40]);
    session.keys(&["F5"]);
    assert!(other(&session) == red, "by hand, too");
    fs::write(&file, "no picture").unwrap();
    saved(&mut session);
    let told = errors(&session);
    assert!(
        told.len() == 1 && told[0].contains("b.png") && told[0].ends_with("B stays as it was read last"),
        "{told:?}"
    );
    assert!(other(&session) == red, "it stays");
    write(0xff00_00ff, [30, 20]);
    saved(&mut session);
    assert_eq!(errors(&session), [""; 0], "nothing is wrong any more");
    assert_eq!(
        [session.pixels().width(), session.pixels().height()],
        [30, 20],
        "A has its size"
    );
}

#[test]
fn pattern_of_a_file_is_followed() {
    let mut session = Session::open(&[TRIANGLES], [100, 80]);
    let file = session.folder.path().join("followed.toml");
    let write = |samples: &str| fs::write(&file, format!("name = 'followed'\nsamples = [{samples}]")).unwrap();
    let rates = |session: &Session| {
        let own = session.viewer.settings();
        let other = session.viewer.ab().other_settings(own);
        [Some(own.render), other].map(|render| render.map(|render| render.sample_rate.samples()))
    };
    write("{ x = 0.3, y = 0.71 }, { x = 0.7, y = 0.31 }");
    session.run(Command::Scenes(SceneCommand::Open(vec![file.clone()])));
    session.run(Command::Ab(AbCommand::Compare(Against::Settings)));
    // Two samples make no grid.
    session.run(set("pattern", "sobol"));
    let own = rates(&session)[0];
    assert!(session.viewer.files().contains(&file), "it is among the files");
    write("{ x = 0.3, y = 0.71, weight = 3 }");
    saved(&mut session);
    assert_eq!(rates(&session), [own, Some(3)], "B samples by it");
    write("");
    saved(&mut session);
    let told = errors(&session);
    assert!(told.len() == 1 && told[0].contains("0 samples"), "{told:?}");
    write("{ x = 0.3, y = 0.71, weight = 5 }");
    session.keys(&["F5"]);
    assert_eq!(rates(&session), [own, Some(5)], "by hand, too");
    assert_eq!(errors(&session), [""; 0], "nothing is wrong any more");
    session.run(Command::Scenes(SceneCommand::Open(vec![file.clone()])));
    write("{ x = 0.3, y = 0.71, weight = 6 }");
    saved(&mut session);
    assert_eq!(rates(&session), [Some(6), Some(6)], "A samples by it, too");
}

#[test]
fn textures_are_among_the_files() {
    let mut session = Session::open(&[SQUARE], [100, 80]);
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let scene = root.join("svg/texmap/test4.svg");
    session.run(Command::Scenes(SceneCommand::Open(vec![scene.clone()])));
    let files = session.viewer.files();
    assert_eq!(files[0], scene, "the document comes first");
    assert!(
        files.len() > 1 && files[1..].iter().all(|file| file.is_file()),
        "{files:?}"
    );
}

#[test]
fn lesson_is_read_again_at_its_step() {
    let mut session = Session::open(&[TRIANGLES], [600, 400]);
    let file = session.folder.path().join("lesson.toml");
    let lesson = |words: &str| {
        format!(
            "title = 'Two'\n[[step]]\nscene = '1.svg'\ntext = 'one'\n[[step]]\ntitle = '{words}'\nscene = '1.svg'\ntext = 'two'\n"
        )
    };
    fs::write(&file, lesson("before")).unwrap();
    session.run(Command::Lesson(LessonCommand::Open(LessonSource::File(file.clone()))));
    session.run(Command::Lesson(LessonCommand::Step(1)));
    assert!(session.viewer.files().contains(&file), "it is among the files");
    let title = |session: &Session| {
        let (lesson, at) = session.viewer.lesson().expect("a lesson");
        (at, lesson.steps[at].title.clone())
    };
    fs::write(&file, lesson("after")).unwrap();
    session.run(Command::Scenes(SceneCommand::FilesChanged(vec![file.clone()])));
    assert_eq!(title(&session), (1, "after".to_owned()), "its new words");
    fs::write(&file, "title = ").unwrap();
    session.run(Command::Scenes(SceneCommand::FilesChanged(vec![file.clone()])));
    assert_eq!(title(&session), (1, "after".to_owned()), "it stays");
    assert_eq!(errors(&session).len(), 1, "and what is wrong is told");
    fs::write(&file, "title = 'One'\n[[step]]\nscene = '1.svg'\ntext = 'one'\n").unwrap();
    session.run(Command::Scenes(SceneCommand::FilesChanged(vec![file])));
    assert_eq!(title(&session), (0, String::new()), "the step is gone");
    assert_eq!(errors(&session), [""; 0], "nothing is wrong any more");
}

#[test]
fn long_reading_tells_how_far_it_is_and_can_be_given_up() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.svg");
    let shapes = "<rect x='1' y='2' width='3' height='4'/>\n".repeat(700_000);
    fs::write(&path, format!("<svg width='9' height='9'>{shapes}</svg>")).unwrap();
    let mut viewer = Viewer::new(ViewerOptions {
        paths: vec![path.clone()],
        ..ViewerOptions::default()
    })
    .unwrap();
    let entry = |viewer: &Viewer| viewer.scene_list().current().unwrap().clone();
    let mut parts = Vec::new();
    while parts.len() < 3 {
        let now = entry(&viewer);
        assert!(now.is_reading(), "this takes long: {:?}", now.failure());
        parts.extend(now.long_reading());
        std::thread::sleep(Duration::from_millis(20));
        viewer.poll();
    }
    assert!(parts.is_sorted() && parts[0] < 1.0, "{parts:?}");
    let ended = viewer.apply(Command::Window(WindowCommand::Escape));
    assert_eq!(ended, [], "nothing ends");
    let why = entry(&viewer).failure().unwrap().to_owned();
    assert!(why.contains("large.svg: reading was given up; F5"), "{why}");
    fs::write(&path, "<svg width='9' height='9'/>").unwrap();
    let _ = viewer.apply(Command::Scenes(SceneCommand::Reload));
    viewer.finish();
    assert_eq!(entry(&viewer).failure(), None, "it is read again");
    assert!(entry(&viewer).scene().is_some(), "to its end");
}
