//! The first minute by mouse and keys: the card with the ways on, files to open, and letters large enough to read.

use glam::dvec2;

use super::hands::{click, click_on, key, place_of, says, session};
use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{AbCommand, Against, MessageKind, Theme};
use crate::viewer::{Dialog, Toggle, ViewCommand, ViewerOptions};

const WINDOWS: [[u32; 2]; 4] = [[480, 360], [800, 600], [1280, 800], [1920, 1080]];
const WAYS: [&str; 4] = [
    "Follow a lesson",
    "Open your file",
    "Look at a study of aliasing",
    "Explain a pixel",
];

/// What a hand does, in words and deed.
type Act = (&'static str, fn(&mut Session));

/// A session that shows the card.
fn greeted(window: [u32; 2]) -> Session {
    let mut session = session(Vec::new(), window);
    session.command(Command::Window(WindowCommand::StartCard(Toggle::On)));
    session.settle();
    session
}

#[test]
fn files_are_to_be_dropped_only_where_that_is_possible() {
    for takes_drops in [true, false] {
        let options = ViewerOptions {
            takes_drops,
            ..ViewerOptions::default()
        };
        let viewer = Viewer::new(options).expect("threads");
        let mut session = Session::new(viewer, 1.0, Clock::Simulated(0.0));
        session.ctx().enable_accesskit();
        session.command(Command::Window(WindowCommand::StartCard(Toggle::On)));
        session.settle();
        let offers = says(&mut session, "drop it on the window");
        assert_eq!(offers, takes_drops, "files can be dropped: {takes_drops}");
    }
}

#[test]
fn start_card_leads_on() {
    for window in WINDOWS {
        for way in WAYS {
            let mut session = greeted(window);
            let at = place_of(&mut session, way);
            let [width, height] = window.map(f64::from);
            assert!(
                at.x > 0.0 && at.x < width && at.y < height,
                "{way} at {at} of {window:?}"
            );
            click(&mut session, at);
            session.settle();
            let viewer = session.viewer();
            assert!(!viewer.chrome().start_card(), "{way} closes the card");
            let done = match way {
                "Follow a lesson" => viewer.lesson().is_some(),
                "Open your file" => viewer.chrome().dialog() == Some(Dialog::Open),
                "Explain a pixel" => viewer.pixels().pinned().is_some() && viewer.pixels().explains(),
                _ => viewer
                    .scene_list()
                    .current()
                    .is_some_and(|entry| entry.label.contains("zone_plate")),
            };
            assert!(done, "{way} in {window:?}");
        }
    }
}

#[test]
fn start_card_scrolls_in_a_small_window() {
    for window in [[320, 240], [500, 300]] {
        let mut session = greeted(window);
        let free = session.free_area.expect("there is room");
        #[expect(clippy::cast_possible_truncation, reason = "inside the window")]
        let inside = |at: DVec2| free.contains(at.to_array().map(|side| side.floor() as i64));
        let first = place_of(&mut session, WAYS[0]);
        assert!(inside(first), "{first} of {window:?}");
        session.pointer(Some(first));
        for _ in 0..12 {
            session.wheel(-1.0);
            session.settle();
        }
        assert!(session.viewer().chrome().start_card(), "the wheel over it leaves it");
        let last = place_of(&mut session, WAYS[3]);
        assert!(inside(last), "{last} of {window:?}");
        let came_back = (0..5).any(|_| {
            key(&mut session, "Tab");
            session.settle();
            inside(place_of(&mut session, WAYS[0]))
        });
        assert!(came_back, "Tab leads back to the first way in {window:?}");
        let first = place_of(&mut session, WAYS[0]);
        assert!(inside(first), "{first} of {window:?}");
        click_on(&mut session, WAYS[0]);
        assert!(!session.viewer().chrome().start_card(), "its way is taken");
    }
}

#[test]
fn explained_pixel_is_one_that_an_edge_makes_wrong() {
    for window in WINDOWS {
        let mut session = greeted(window);
        click_on(&mut session, "Explain a pixel");
        let viewer = session.viewer();
        let [x, y] = viewer.pixels().pinned().expect("a pin");
        let frame = viewer.frames().frame().expect("a frame");
        let around = [[x + 1, y], [x, y + 1], [x - 1, y], [x, y - 1]];
        let differs = around
            .iter()
            .any(|[u, v]| frame.final_rgba(x, y) != frame.final_rgba(*u, *v));
        assert!(differs, "{x}, {y} of {window:?}");
        let truth = viewer
            .inspector()
            .explanation()
            .and_then(|explanation| explanation.truth.as_ref());
        let truth = truth.expect("a small scene");
        assert!(
            truth.distance >= 24.0 && !truth.cures.is_empty(),
            "{x}, {y} of {window:?}: {truth:?}"
        );
    }
}

#[test]
fn start_card_goes_with_the_first_key_or_click() {
    let acts: [Act; 4] = [
        ("a key", |session| key(session, "2")),
        ("Esc", |session| key(session, "Escape")),
        ("a click on the picture", |session| click(session, dvec2(20.0, 300.0))),
        ("the wheel", |session| {
            session.pointer(Some(dvec2(20.0, 300.0)));
            session.wheel(1.0);
        }),
    ];
    // Desktops that give windows their sizes do so at once: the panel folds.
    let mut session = greeted([1280, 800]);
    assert!(session.viewer().chrome().panel(), "it has room");
    session.resize([1043, 717]);
    session.settle();
    assert!(!session.viewer().chrome().panel(), "it has none");
    assert!(session.viewer().chrome().start_card(), "another size leaves the card");
    for (what, act) in acts {
        let mut session = greeted([800, 600]);
        session.pointer(Some(dvec2(20.0, 300.0)));
        session.resize([810, 600]);
        assert!(
            session.viewer().chrome().start_card(),
            "the pointer and the window's size leave it"
        );
        act(&mut session);
        session.settle();
        assert!(!session.viewer().chrome().start_card(), "{what} closes it");
        assert!(session.viewer().chrome().messages().is_empty(), "{what} asks nothing");
    }
    let mut session = greeted([800, 600]);
    key(&mut session, "F1");
    session.settle();
    for way in WAYS {
        assert!(
            says(&mut session, way) || place_of(&mut session, way).x > 0.0,
            "the help has {way}"
        );
    }
    click_on(&mut session, "Explain a pixel");
    assert_eq!(session.viewer().chrome().dialog(), None, "the help closes");
    assert!(session.viewer().pixels().pinned().is_some(), "and its way is taken");
}

#[test]
fn interface_scale_leaves_the_picture() {
    let mut session = session(Vec::new(), [1600, 1200]);
    session.command(Command::Inspector(InspectorCommand::Show(Toggle::Off)));
    session.command(Command::View(ViewCommand::Fit));
    session.settle();
    let menu = place_of(&mut session, "Menu");
    let numbers = session.viewer().both().view_numbers();
    for _ in 0..3 {
        key(&mut session, "Ctrl+=");
    }
    session.settle();
    assert_eq!(
        session.viewer().chrome().interface_scale().percent(),
        150,
        "three steps"
    );
    assert!((session.ctx().pixels_per_point() - 1.5).abs() < 1e-6, "egui follows");
    assert_eq!(session.viewer().both().view_numbers(), numbers, "the picture stays");
    let points = place_of(&mut session, "Menu");
    let larger = 1200.0 - points.y * 1.5;
    let before = 1200.0 - menu.y;
    assert!(
        (larger / before - 1.5).abs() < 0.1,
        "the line at the foot: {before} to {larger} pixels"
    );
    // The pointer still finds what is drawn.
    click(&mut session, points * 1.5);
    session.settle();
    assert!(session.interface.list_is_open(), "a click opens the menu");
    key(&mut session, "Escape");
    key(&mut session, "Ctrl+-");
    assert_eq!(session.viewer().chrome().interface_scale().percent(), 125, "one back");
    session.command(Command::Window(WindowCommand::SetInterfaceScale(
        crate::viewer::InterfaceScale::from_percent(300),
    )));
    session.resize([800, 600]);
    session.settle();
    let scale = session.ctx().pixels_per_point();
    assert!(
        (scale - 800.0 / 520.0).abs() < 1e-6,
        "{scale}: room for three lists of the menu"
    );
    let told = |session: &Session| {
        let messages = session.viewer().chrome().messages().iter();
        messages
            .filter(|message| message.text.contains("room for no more"))
            .count()
    };
    assert_eq!(told(&session), 0, "nobody asked for more than there was room for");
    key(&mut session, "Ctrl+-");
    assert_eq!(told(&session), 1, "250 percent look as 300 do, and that is said");
}

/// A folder with scenes, one of them in a folder inside.
fn folder_of_scenes() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("inside")).expect("a folder");
    for name in ["one.svg", "two.svg", "inside/three.svg"] {
        let document =
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100"><rect width="50" height="50"/></svg>"#;
        std::fs::write(folder.path().join(name), document).expect("a file");
    }
    std::fs::write(folder.path().join("notes.txt"), "no scene").expect("a file");
    folder
}

/// The label of the scene that is shown.
fn shown(session: &Session) -> String {
    session
        .viewer()
        .scene_list()
        .current()
        .map_or(String::new(), |entry| entry.label.clone())
}

#[test]
fn files_are_opened_by_mouse() {
    for window in WINDOWS {
        let folder = folder_of_scenes();
        let mut session = session(vec![folder.path().join("one.svg")], window);
        key(&mut session, "Ctrl+O");
        session.settle();
        assert!(
            says(&mut session, "one.svg") || place_of(&mut session, "one.svg").x > 0.0,
            "beside the scene"
        );
        let up = place_of(&mut session, "Up");
        click_on(&mut session, "inside");
        assert_eq!(
            session.viewer().chrome().dialog(),
            Some(Dialog::Open),
            "a folder is gone into"
        );
        assert_eq!(
            place_of(&mut session, "Up"),
            up,
            "and its buttons stay under the pointer"
        );
        click_on(&mut session, "Up");
        click_on(&mut session, "two.svg");
        assert_eq!(session.viewer().chrome().dialog(), None, "a file closes the dialog");
        assert_eq!(shown(&session), "two.svg", "and is shown, in {window:?}");
        key(&mut session, "Ctrl+O");
        click_on(&mut session, "inside");
        click_on(&mut session, "Open this folder");
        assert_eq!(shown(&session), "three.svg", "all of a folder");
        key(&mut session, "Ctrl+O");
        click_on(&mut session, "Cancel");
        assert_eq!(session.viewer().chrome().dialog(), None, "or nothing");
    }
}

#[test]
fn files_are_opened_by_keys() {
    let folder = folder_of_scenes();
    let mut session = session(vec![folder.path().join("one.svg")], [800, 600]);
    let type_and_enter = |session: &mut Session, text: &str| {
        key(session, "Ctrl+A");
        session.type_text(text);
        session.settle();
        key(session, "Enter");
        session.settle();
    };
    key(&mut session, "Ctrl+O");
    session.settle();
    type_and_enter(&mut session, "tw");
    assert_eq!(shown(&session), "two.svg", "part of a name");
    key(&mut session, "Ctrl+O");
    session.settle();
    type_and_enter(&mut session, "no such/file.svg");
    assert!(says(&mut session, "no such file"), "a wrong path");
    type_and_enter(&mut session, "insi");
    assert_eq!(session.viewer().chrome().dialog(), Some(Dialog::Open), "a folder");
    key(&mut session, "Enter");
    session.settle();
    assert_eq!(shown(&session), "three.svg", "the first of it");
    key(&mut session, "Ctrl+O");
    session.settle();
    let path = folder.path().join("one.svg");
    type_and_enter(&mut session, &path.display().to_string());
    assert_eq!(shown(&session), "one.svg", "a whole path");
    key(&mut session, "Ctrl+O");
    key(&mut session, "Escape");
    assert_eq!(session.viewer().chrome().dialog(), None, "Esc closes it");
}

#[test]
fn key_that_opened_a_question_does_not_close_it() {
    for (name, dialog) in [
        ("Ctrl+O", Dialog::Open),
        ("Ctrl+G", Dialog::GoToPixel),
        ("Ctrl+Shift+P", Dialog::Palette),
    ] {
        let mut session = session(Vec::new(), [800, 600]);
        let rate = session.viewer().settings().render.sample_rate;
        for _ in 0..2 {
            key(&mut session, name);
            session.settle();
            assert_eq!(session.viewer().chrome().dialog(), Some(dialog), "{name}");
        }
        // A command of the picture.
        key(&mut session, "2");
        session.settle();
        assert_eq!(
            session.viewer().settings().render.sample_rate,
            rate,
            "what is typed after {name} is the answer"
        );
        key(&mut session, "Escape");
        assert_eq!(session.viewer().chrome().dialog(), None, "Esc closes it");
    }
}

#[test]
fn scene_tells_what_to_look_at() {
    for window in WINDOWS {
        let mut session = session(Vec::new(), window);
        let words = "A lighthouse at dusk.";
        assert!(!says(&mut session, words), "unasked");
        key(&mut session, "I");
        session.settle();
        assert!(says(&mut session, words), "in {window:?}");
        key(&mut session, "PageDown");
        session.settle();
        assert!(!says(&mut session, words), "another scene has other words");
        key(&mut session, "PageUp");
        session.settle();
        click_on(&mut session, "Close the scene's words");
        assert!(!says(&mut session, words), "the button closes them");
        key(&mut session, "I");
        session.settle();
        assert!(says(&mut session, words), "again");
        key(&mut session, "Escape");
        session.settle();
        assert!(!says(&mut session, words), "and so does Esc");
        let warned = session
            .viewer
            .chrome()
            .messages()
            .iter()
            .any(|message| message.text.contains("Esc"));
        assert!(!warned, "which does not ask whether to end the program");
    }
}

#[test]
fn presenter_look_is_larger_and_has_more_contrast() {
    let mut session = session(Vec::new(), [1920, 1080]);
    session.command(Command::Inspector(InspectorCommand::Pin([900, 500])));
    session.settle();
    let ring = |session: &Session| session.interface.rings(&session.viewer)[0].width() * session.scale();
    let luminance = |color: egui::Color32| {
        let [red, green, blue, _] = egui::Rgba::from(color).to_array();
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    };
    // The contrast of WCAG 2, section 1.4.3, of plain and of weak letters on panels.
    let contrasts = |session: &Session| {
        let visuals = session.ctx().global_style().visuals.clone();
        [visuals.text_color(), visuals.weak_text_color()].map(|color| {
            let [a, b] = [color, visuals.panel_fill].map(|color| luminance(color) + 0.05);
            a.max(b) / a.min(b)
        })
    };
    for theme in [Theme::Dark, Theme::Light] {
        session.command(Command::Window(WindowCommand::SetTheme(theme)));
        session.settle();
        let before = (session.scale(), ring(&session), contrasts(&session));
        session.command(Command::Window(WindowCommand::Presenter(Toggle::On)));
        session.settle();
        let (scale, wide, [text, weak]) = (session.scale(), ring(&session), contrasts(&session));
        assert!(scale >= before.0 * 1.49, "{scale} for {}", before.0);
        assert!(
            wide >= before.1 * 1.8,
            "a ring of {wide} pixels for one of {}",
            before.1
        );
        assert!(
            text > before.2[0] && weak > before.2[1],
            "{text}, {weak} for {:?}",
            before.2
        );
        assert!(text >= 15.0 && weak >= 10.0, "{theme:?}: {text}, {weak}");
        session.command(Command::Window(WindowCommand::Presenter(Toggle::Flip)));
        session.settle();
        assert_eq!(
            (session.scale(), ring(&session), contrasts(&session)),
            before,
            "and back"
        );
    }
}

#[test]
fn messages_lie_at_the_foot_however_letters_grow() {
    for window in [[1366, 768], [1920, 1080]] {
        let mut session = session(Vec::new(), window);
        session.command(Command::Ab(AbCommand::Compare(Against::Truth(None))));
        session.settle();
        session.command(Command::Inspector(InspectorCommand::Pin([700, 400])));
        session.settle();
        let error = "/a/folder/of/pictures/that/is/named: no file manager shows this folder: No such file or directory (os \
                     error 2); open it by hand";
        session.viewer.tell(MessageKind::Error, error.to_owned());
        session.settle();
        // The lower edge of the message above the line at the foot, in device pixels.
        let above_foot = |session: &Session| {
            let newest = session.viewer.chrome().messages().last().expect("it is there").id;
            let area = egui::Id::unique(("message", newest));
            let place = session
                .ctx()
                .memory(|memory| memory.area_rect(area))
                .expect("a message");
            let free = session.free_area.expect("there is room");
            free.bottom() as f32 - place.bottom() * session.scale()
        };
        for on in [Toggle::On, Toggle::Off] {
            session.command(Command::Window(WindowCommand::Presenter(on)));
            session.settle();
            let kept = above_foot(&session);
            let newest = session.viewer.chrome().messages().last().expect("it is there").id;
            session.command(Command::Window(WindowCommand::DismissMessage(newest)));
            session.settle();
            session.viewer.tell(MessageKind::Error, error.to_owned());
            session.settle();
            let fresh = above_foot(&session);
            assert!(kept < fresh + 1.0, "{kept}, one that comes now {fresh}, in {window:?}");
            assert!(kept < 100.0 * session.scale(), "at the foot: {kept} in {window:?}");
        }
    }
}
