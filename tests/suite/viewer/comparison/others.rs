//! A against something else than a second set of settings: the truth, a picture from outside; and what a script says of it.

use std::path::PathBuf;

use glam::dvec2;
use rasterscope::color::ResolveSpace;
use rasterscope::compare::{Cause, Gain, Measure, Pair};
use rasterscope::figure::save_png;
use rasterscope::geometry::View;
use rasterscope::raster::{Framebuffer, SamplePattern, SampleRate};
use rasterscope::render::{self, RenderSettings};
use rasterscope::texture::PixelSampling;
use rasterscope::viewer::script::{Script, ViewerStage, play};
use rasterscope::viewer::{
    AbCommand, Against, Arrangement, Command, MessageKind, Other, PointerCommand, SceneCommand, ViewCommand,
    WindowCommand,
};

use super::{WINDOW, frames};
use crate::support::session::{Session, TRIANGLES, set, step};

#[test]
fn comparison_without_a_window_or_a_scene_ends() {
    let mut session = Session::open(&[TRIANGLES, "<svg"], WINDOW);
    session.run(Command::Window(WindowCommand::Resize([0, 0])));
    session.keys(&["r", "w", "n", "="]);
    session.run(Command::Window(WindowCommand::Resize(WINDOW)));
    session.assert_frame_is_current();
    assert!(session.viewer.ab().other_pixels().is_some(), "B too");
    session.run(Command::Scenes(SceneCommand::Next));
    session.keys(&["d", "r", "n", "w"]);
    assert!(
        session.viewer.ab().other_pixels().is_none(),
        "no picture of a scene that cannot be read"
    );
    session.run(Command::Scenes(SceneCommand::Previous));
    session.keys(&["d"]);
    session.assert_frame_is_current();
}

#[test]
fn comparison_that_is_closed_without_a_window_is_not_waited_for() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    session.keys(&["d"]);
    let _ = session
        .viewer
        .apply(Command::Window(WindowCommand::Resize([WINDOW[0], 0])));
    for _ in 0..2 {
        let _ = session.viewer.apply(Command::Window(WindowCommand::Escape));
    }
    assert!(session.viewer.ab().other().is_none(), "nothing is compared any more");
    session.viewer.poll();
    assert!(session.viewer.is_settled(), "there is nothing to measure");
}

#[test]
fn comparison_with_the_truth() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    session.keys(&["p", "l", "t", "."]);
    session.run(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    assert_eq!(
        session.viewer.ab().arrangement(),
        Arrangement::Wipe,
        "to be seen at once"
    );
    let truth = RenderSettings {
        sample_rate: SampleRate::new(256).unwrap(),
        pattern: SamplePattern::Hammersley,
        pixel_sampling: PixelSampling::Bilinear,
        ..RenderSettings::default()
    };
    assert_eq!(
        session.viewer.ab().other_settings(session.viewer.settings()),
        Some(truth),
        "level zero, no anisotropy, no bias, averaged as A"
    );
    let title = session.viewer.both().title();
    assert!(title.contains("A against the truth: sample rate 1 | 256"), "{title}");
    session.run(step("pixel-sampling", -1.0));
    let truth = RenderSettings {
        pixel_sampling: PixelSampling::Nearest,
        ..truth
    };
    assert_eq!(
        session.viewer.ab().other_settings(session.viewer.settings()),
        Some(truth),
        "textures are continued as in A"
    );
    let [a, b] = frames(&session);
    let entry = session.viewer.scene_list().current().unwrap();
    let scene = entry.scene().unwrap();
    let mut expected = Framebuffer::new(WINDOW[0], WINDOW[1]);
    let view = entry.camera.view().transform(scene.canvas, WINDOW);
    render::draw(scene, &view, &truth, &mut expected);
    assert!(b == expected, "what the renderer makes of 256 samples");
    session.run(Command::Window(WindowCommand::Escape));
    assert!(session.viewer.window().picture() == a, "A alone");
    session.keys(&["r"]);
    assert!(
        session.viewer.window().picture() == b,
        "R shows the truth in place of A"
    );
    assert_eq!(
        session.viewer.settings().render.sample_rate.samples(),
        1,
        "whose settings stay"
    );
    session.keys(&["="]);
    assert_eq!(
        session.viewer.settings().render.sample_rate.samples(),
        4,
        "and go on being changed"
    );
    session.keys(&["w"]);
    let window = session.viewer.window().picture();
    assert_eq!(window.rgba(79, 60), b.rgba(79, 60), "the truth on the left");
    assert_eq!(window.rgba(80, 60), session.pixels().rgba(80, 60), "A on the right");
    assert_eq!(session.run(Command::Window(WindowCommand::Escape)), [], "the wipe");
    assert!(
        session.viewer.window().picture() == *session.pixels(),
        "A in front again"
    );
}

#[test]
fn comparison_tells_what_decides_the_pictures() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    session.run(set("pattern", "r2"));
    session.run(set("sample-rate", "4"));
    let against = Against::from_text("coverage exact, sample-rate 16").unwrap();
    session.run(Command::Ab(AbCommand::Compare(against)));
    let settings = *session.viewer.settings();
    let ab = session.viewer.ab();
    let sides = ab.sides(&settings).unwrap();
    assert_eq!(sides[0], "A: sample rate 4, coverage sampled");
    assert_eq!(sides[1], "B: coverage exact", "which has no samples");
    let words = ab.words(&settings).unwrap();
    assert_eq!(words, ["sample rate 4 | \u{2013}", "coverage sampled | exact"]);
    assert_eq!(ab.shared_words(&settings).as_deref(), Some("pattern r2"), "A has it");
    session.run(set("coverage", "exact"));
    let settings = *session.viewer.settings();
    let ab = session.viewer.ab();
    assert_eq!(
        ab.shared_words(&settings).as_deref(),
        Some("coverage exact"),
        "no pattern"
    );
    let sides = ab.sides(&settings).unwrap();
    assert_eq!(sides[1], "B: sample rate 16 (no effect)", "nothing else differs");
    session.run(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    let settings = *session.viewer.settings();
    let [_, truth] = session.viewer.ab().sides(&settings).unwrap();
    assert!(truth.ends_with("pattern hammersley"), "{truth}");
    assert_eq!(
        session.viewer.ab().shared_words(&settings),
        None,
        "its settings are its own"
    );
}

#[test]
fn truth_averages_as_a_does_unless_asked() {
    use ResolveSpace::{Linear, Stored};
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    let psnr = |session: &Session| {
        let [a, b] = frames(session);
        Pair::new(&a, &b).unwrap().levels().psnr()
    };
    for own in ResolveSpace::ALL {
        session.run(set("resolve", own.name()));
        session.run(set("sample-rate", "64"));
        let mut ratios = Vec::new();
        for (text, resolve) in [("truth", own), ("truth stored", Stored), ("truth linear", Linear)] {
            session.run(Command::Ab(AbCommand::Compare(Against::from_text(text).unwrap())));
            assert_eq!(
                session
                    .viewer
                    .ab()
                    .other_settings(session.viewer.settings())
                    .unwrap()
                    .resolve,
                resolve,
                "{text}"
            );
            let [_, told] = session.viewer.ab().sides(session.viewer.settings()).unwrap();
            let words = if resolve == Linear {
                "linear light"
            } else {
                "stored values"
            };
            assert!(told.contains(words), "{text}: {told}");
            ratios.push(psnr(&session));
        }
        let other = if own == Stored { ratios[2] } else { ratios[1] };
        assert!(
            ratios[0] > other + 3.0,
            "{own:?}: the same values leave sampling alone: {ratios:?}"
        );
    }
    session.run(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    session.run(set("resolve", Stored.name()));
    assert_eq!(
        session
            .viewer
            .ab()
            .other_settings(session.viewer.settings())
            .unwrap()
            .resolve,
        Stored,
        "it follows A"
    );
}

/// A picture of [`TRIANGLES`] with four samples per pixel, in the session's folder.
fn picture_of_rate_four(session: &Session, size: [u32; 2]) -> (PathBuf, Framebuffer) {
    let scene = session.viewer.scene_list().current().unwrap().scene().unwrap();
    let settings = RenderSettings {
        sample_rate: SampleRate::new(4).unwrap(),
        ..RenderSettings::default()
    };
    let mut picture = Framebuffer::new(size[0], size[1]);
    let view = View::Default.transform(scene.canvas, size);
    render::draw(scene, &view, &settings, &mut picture);
    let path = session.folder.path().join("theirs.png");
    save_png(&picture, &path).unwrap();
    (path, picture)
}

#[test]
fn comparison_with_a_picture_from_outside() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    let (path, picture) = picture_of_rate_four(&session, [90, 70]);
    // Dropped on the window.
    session.run(Command::Scenes(SceneCommand::Open(vec![path])));
    assert_eq!(session.viewer.scene_list().scenes().len(), 1, "a picture is no scene");
    assert_eq!(
        session.viewer.both().layout().frame_size(),
        [90, 70],
        "A takes its size"
    );
    session.assert_frame_is_current();
    assert!(
        *session.viewer.ab().other_pixels().unwrap() == picture,
        "B is the picture"
    );
    let title = session.viewer.both().title();
    assert!(
        title.contains("A against theirs.png: sample rate 1 - "),
        "no word of textures in a scene without any: {title}"
    );
    let guess = session.viewer.both().measures().unwrap().0.guess.clone().unwrap();
    assert_eq!(
        guess.causes,
        [Cause::SampleRate(SampleRate::new(4).unwrap())],
        "why it differs"
    );
    session.keys(&["="]);
    let (measures, is_current) = session.viewer.both().measures().unwrap();
    assert!(is_current && measures.levels.differing() == 0, "then nothing does");
    assert_eq!(measures.guess, None, "and there is nothing to guess");
    // Both in the middle of the window, (160 - 90) / 2 and (120 - 70) / 2 pixels from its corner.
    session.run(Command::Window(WindowCommand::Escape));
    let shows = |session: &Session, [left, top]: [u32; 2], what: &str| {
        let window = session.viewer.window().picture();
        for (x, y) in [(0, 0), (17, 40), (45, 35), (60, 12)] {
            let shown = window.rgba(left + x, top + y);
            assert_eq!(shown, session.pixels().rgba(x, y), "{what}: {x}, {y}");
        }
    };
    shows(&session, [35, 25], "in the middle");
    let beside = session.viewer.window().picture().rgba(34, 40);
    assert_eq!(beside, Some([128, 128, 128, 255]), "grey beside it");
    let view = session.viewer.both().view_numbers();
    session.run(Command::View(ViewCommand::PanBy { by: dvec2(-5.0, 12.0) }));
    shows(&session, [30, 37], "moved by the hand");
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(47.0, 77.0) }));
    assert_eq!(session.viewer.pixels().hovered(), Some([17, 40]), "read where it is");
    session.run(Command::Pointer(PointerCommand::Wheel { clicks: 1.0 }));
    assert_eq!(session.viewer.settings().pixel_zoom.factor(), 2, "the wheel magnifies");
    assert_eq!(session.viewer.pixels().hovered(), Some([17, 40]), "about the pointer");
    assert_eq!(
        session.viewer.both().view_numbers(),
        view,
        "the scene's view stays: it is the picture's"
    );
    session.run(Command::Ab(AbCommand::Compare(Against::Nothing)));
    assert_eq!(
        session.viewer.both().layout().frame_size(),
        [80, 60],
        "the window's size again, at a zoom of 2"
    );
}

#[test]
fn comparison_with_what_is_no_picture_says_so() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    session.keys(&["r"]);
    let folder = session.folder.path().to_owned();
    let start = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff\x08\x06\0\0\0";
    std::fs::write(folder.join("huge.png"), [&start[..], &[0; 20]].concat()).unwrap();
    std::fs::write(folder.join("text.png"), "no picture").unwrap();
    std::fs::create_dir(folder.join("folder.png")).unwrap();
    for name in ["huge.png", "text.png", "folder.png", "nowhere.png"] {
        let before = session.viewer.chrome().messages().last().map(|message| message.id);
        session.run(Command::Ab(AbCommand::Compare(Against::File(folder.join(name)))));
        let message = session.viewer.chrome().messages().last().unwrap();
        assert!(before < Some(message.id), "{name} is told");
        assert_eq!(message.kind, MessageKind::Error, "{name}");
        assert!(
            message.text.contains(name) && !message.text.contains('\n'),
            "{}",
            message.text
        );
        assert!(message.text.contains("give a"), "the cure: {}", message.text);
        let kept = matches!(session.viewer.ab().other(), Some(Other::Settings { .. }));
        assert!(kept, "B stays after {name}");
    }
}

#[test]
fn comparison_newest_picture_wins() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    let (path, _) = picture_of_rate_four(&session, [90, 70]);
    let _ = session
        .viewer
        .apply(Command::Ab(AbCommand::Compare(Against::File(path.clone()))));
    let _ = session
        .viewer
        .apply(Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)));
    let _ = session.viewer.apply(Command::Ab(AbCommand::Swap));
    session.viewer.finish();
    assert!(
        matches!(session.viewer.ab().other(), Some(Other::Picture(_))),
        "what is being read becomes B"
    );
    assert_eq!(
        session.viewer.ab().arrangement(),
        Arrangement::SideBySide,
        "arranged as asked meanwhile"
    );
    let _ = session
        .viewer
        .apply(Command::Ab(AbCommand::Compare(Against::File(path))));
    let _ = session
        .viewer
        .apply(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    session.viewer.finish();
    assert_eq!(
        session.viewer.ab().other(),
        Some(&Other::Truth(None)),
        "what was asked for last"
    );
}

#[test]
fn comparison_by_a_script() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    let (path, _) = picture_of_rate_four(&session, [90, 70]);
    let text = format!(
        "against settings; rate 16; arrange difference; difference signed; gain 4; normalize on
        truth; wipe 0.25; against \"{}\"; next-difference; side",
        path.display()
    );
    let script = Script::parse(&text, "s").unwrap();
    play(&script, "s", &mut ViewerStage::new(&mut session.viewer)).unwrap();
    assert!(
        matches!(session.viewer.ab().other(), Some(Other::Picture(_))),
        "the last B"
    );
    assert_eq!(
        session.viewer.ab().arrangement(),
        Arrangement::SideBySide,
        "the last arrangement"
    );
    let style = session.viewer.ab().difference_style();
    assert_eq!(
        (style.measure, style.gain),
        (Measure::Signed, Gain::Normalize),
        "the style"
    );
    assert_eq!(
        session.viewer.pixels().pinned_difference(),
        Some(0),
        "where they differ most"
    );
}

#[test]
fn a_picture_that_reaches_beyond_the_window_is_saved_whole() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    let size = WINDOW.map(|side| side + 37);
    let (path, expected) = picture_of_rate_four(&session, size);
    for (arrangement, half) in [("wipe 0", false), ("arrange difference", false), ("side", true)] {
        let saved = session.folder.path().join(format!("{arrangement}.png"));
        let text = format!(
            "against \"{}\"; {arrangement}; save-as \"{}\"",
            path.display(),
            saved.display()
        );
        let script = Script::parse(&text, "s").unwrap();
        play(&script, "s", &mut ViewerStage::new(&mut session.viewer)).unwrap();
        let picture = image::open(&saved).unwrap().into_rgba8();
        if half {
            assert!(
                picture.width() <= WINDOW[0] && picture.height() <= WINDOW[1],
                "halves of the window: {:?}",
                picture.dimensions()
            );
            continue;
        }
        assert_eq!(<[u32; 2]>::from(picture.dimensions()), size, "{arrangement}");
        if arrangement == "wipe 0" {
            // Tags lie at the top.
            let below = (size[1] / 2..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
            let differing = below.filter(|[x, y]| Some(picture.get_pixel(*x, *y).0) != expected.rgba(*x, *y));
            assert_eq!(differing.count(), 0, "all of B, where it is");
        }
    }
}
