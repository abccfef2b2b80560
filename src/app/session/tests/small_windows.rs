//! What stays in reach of the mouse where there is little room: panels make way for each other and for the pinned pixel,
//! and controls stay under the pointer that clicks them.

use std::collections::BTreeMap;

use egui::accesskit::{Node, Rect};
use glam::{DVec2, dvec2};

use super::hands::{click, click_on, comparing, key, nodes, place_of, right_click, says, session};
use super::*;
use crate::render::Visualisation;
use crate::viewer::script::Stage as _;
use crate::viewer::{AbCommand, Against, Arrangement, Dialog, InspectorCommand, Toggle, ViewCommand, WindowCommand};

/// Width of the side panel and of that of a comparison.
const PANEL: f64 = 264.0;
/// What closes the explanation.
const CLOSE: &str = "Explanation";

/// How far below the window's upper edge a text begins.
fn top_of(session: &mut Session, text: &str) -> f64 {
    let nodes = nodes(session);
    let node = nodes
        .iter()
        .find(|node| node.value().is_some_and(|value| value.contains(text)));
    node.and_then(Node::bounds).unwrap_or_else(|| panic!("no {text}")).y0
}

/// Where the controls are that lie between these columns, by name.
fn controls(session: &mut Session, columns: std::ops::Range<f64>) -> BTreeMap<String, Vec<(i64, i64)>> {
    let mut places: BTreeMap<_, Vec<_>> = BTreeMap::new();
    for node in nodes(session) {
        if let (Some(name), Some(Rect { x0, y0, .. })) = (node.label(), node.bounds())
            && columns.contains(&x0)
        {
            #[expect(clippy::cast_possible_truncation, reason = "inside the window")]
            places.entry(name.to_owned()).or_default().push((x0 as i64, y0 as i64));
        }
    }
    places
}

#[test]
fn comparison_stays_at_hand_beside_an_explained_pixel() {
    for window in [[800, 600], [1280, 800], [1366, 768], [1920, 1080]] {
        let mut session = comparing(window);
        right_click(&mut session, [330.0, 300.0]);
        assert!(says(&mut session, "canvas units"), "the explanation at {window:?}");
        click_on(&mut session, "Show: wipe");
        assert_eq!(session.viewer.ab().arrangement(), Arrangement::Wipe, "{window:?}");
        for name in ["Show: side", "Show: diff", "Show: flip", "Show: A", "Next difference"] {
            click_on(&mut session, name);
        }
        click_on(&mut session, "Swap A and B");
        let rate = session.viewer.settings().render.sample_rate.samples();
        assert_eq!(rate, 1, "swapped at {window:?}");
        click_on(&mut session, "Close comparison");
        assert!(session.viewer.ab().other().is_none(), "closed at {window:?}");
    }
}

#[test]
fn help_grows_with_its_window() {
    let help = |sizes: &[[u32; 2]]| {
        let mut session = session(Vec::new(), sizes[0]);
        for size in sizes {
            session.resize(*size);
            key(&mut session, "?");
            session.settle();
            if size != sizes.last().expect("a size") {
                key(&mut session, "Escape");
                session.settle();
            }
        }
        top_of(&mut session, "Keys and gestures")
    };
    let (grown, fresh) = (help(&[[320, 240], [900, 700]]), help(&[[900, 700]]));
    assert!((grown - fresh).abs() < 1.0, "{grown} and {fresh} points from the top");
}

#[test]
fn title_of_the_help_gives_way_to_its_button() {
    let mut session = session(Vec::new(), [150, 120]);
    key(&mut session, "?");
    session.settle();
    let nodes = nodes(&mut session);
    let right = |node: &Node| node.bounds().map_or(0.0, |bounds| bounds.x1);
    let title = nodes
        .iter()
        .find(|node| node.value().is_some_and(|value| value.starts_with("Keys")));
    let close = nodes.iter().find(|node| node.label() == Some("Close"));
    let (title, close) = (title.map(right), close.and_then(Node::bounds).map(|bounds| bounds.x0));
    let (title, close) = title.zip(close).expect("title and button");
    assert!(title <= close, "{title} beside {close}");
}

#[test]
fn explanation_takes_the_room_of_the_side_panel() {
    let mut session = session(Vec::new(), [800, 600]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    right_click(&mut session, [300.0, 300.0]);
    assert!(says(&mut session, "Pixel 300, 300"), "explained at once");
    assert!(!session.viewer.chrome().panel(), "the panel made way");
    click_on(&mut session, CLOSE);
    assert!(session.viewer.chrome().panel(), "and came back");
    right_click(&mut session, [320.0, 280.0]);
    assert!(says(&mut session, "Pixel 320, 280"), "another pixel is explained, too");
    click_on(&mut session, "Side panel");
    let viewer = &session.viewer;
    assert!(
        viewer.chrome().panel() && !viewer.pixels().explains(),
        "who wants the panel gets it"
    );
    key(&mut session, "e");
    session.settle();
    assert!(
        says(&mut session, "Pixel 320, 280"),
        "and who wants the explanation, that"
    );
    // A pixel that the panel would cover keeps it away.
    session.command(Command::Inspector(InspectorCommand::Pin([700, 300])));
    session.settle();
    click_on(&mut session, CLOSE);
    assert!(!session.viewer.chrome().panel(), "the pinned pixel stays in sight");
    session.command(Command::Inspector(InspectorCommand::Unpin));
    assert!(session.viewer.chrome().panel(), "without a pin the panel is back");
    // Where there is room for both, nothing folds.
    session.resize([1280, 800]);
    right_click(&mut session, [300.0, 300.0]);
    assert!(
        session.viewer.chrome().panel() && says(&mut session, "Pixel 300, 300"),
        "both"
    );
}

#[test]
fn panels_leave_the_pinned_pixel_in_sight() {
    for x in [60, 100, 200, 260, 300, 420, 520, 700] {
        let mut session = comparing([800, 600]);
        session.command(Command::Inspector(InspectorCommand::Pin([300, 300])));
        right_click(&mut session, [f64::from(x), 300.0]);
        if session.viewer.pixels().pinned().map(|[x, _]| x) != Some(x) {
            // The explanation lies there.
            session.command(Command::Inspector(InspectorCommand::Pin([x.into(), 300])));
            session.settle();
        }
        click_on(&mut session, CLOSE);
        let free = session.free_area.expect("there is room");
        for x in [x - 10, x + 10] {
            assert!(free.contains([x.into(), 300]), "{x} in {free:?}");
        }
    }
}

#[test]
fn button_of_the_other_reading_is_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("boxed.svg");
    let document = r##"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" viewBox="0 0 50 50"><polygon fill="#1f6feb" points="5,5 45,9 20,45"/><circle cx="35" cy="35" r="9"/></svg>"##;
    std::fs::write(&path, document).expect("a file");
    for window in [[800, 600], [1280, 800], [1366, 768]] {
        let mut session = session(vec![path.clone()], window);
        session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
        let name = "Read in the other dialect";
        session.pointer(Some(dvec2(f64::from(window[0]) - 100.0, 300.0)));
        let mut turns = 0;
        while place_of(&mut session, name).y > f64::from(window[1]) - 60.0 && turns < 50 {
            session.wheel(-1.0);
            session.settle();
            turns += 1;
        }
        let at = place_of(&mut session, name);
        // At both ends of the button, up and down.
        for (y, reading) in [(-9.0, "read as course"), (9.0, "read as svg")] {
            click(&mut session, at + dvec2(0.0, y));
            session.settle();
            let note = session
                .viewer
                .scene_list()
                .reading_note(session.viewer.settings().dialect)
                .expect("two readings");
            assert!(note.starts_with(reading), "{note} at {window:?}");
        }
    }
}

#[test]
fn controls_stay_under_the_pointer() {
    let window = [1600, 1300];
    let mut session = session(Vec::new(), window);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    let side = f64::from(window[0]) - PANEL..f64::from(window[0]);
    let before = controls(&mut session, side.clone());
    assert!(before.len() > 40, "{before:?}");
    for name in [
        "Dialect: svg",
        "Dialect: auto",
        "Swap A and B",
        "Compare with the truth",
    ] {
        click_on(&mut session, name);
        session.wait(Duration::from_secs(10));
        let now = controls(&mut session, side.clone());
        assert_eq!(now, before, "after {name}");
    }
    // The comparison's own.
    let before = controls(&mut session, 0.0..PANEL);
    let names = [
        "Swap A and B",
        "Compare with the truth",
        "Close comparison",
        "Show: wipe",
        "Next difference",
    ];
    for clicked in ["Show: diff", "Show: A", "Compare with the truth", "Swap A and B"] {
        let place = before
            .get(clicked)
            .or_else(|| before.get("Show: A"))
            .map(|places| places[0]);
        let (x, y) = place.unwrap_or_else(|| panic!("no {clicked}"));
        click(&mut session, dvec2(x as f64 + 8.0, y as f64 + 8.0));
        session.settle();
        let now = controls(&mut session, 0.0..PANEL);
        for name in names {
            assert_eq!(now.get(name), before.get(name), "{name} after {clicked}");
        }
    }
}

#[test]
fn lines_of_a_comparison_follow_a_swap_with_the_truth() {
    let mut session = comparing([1280, 800]);
    session.command(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    session.settle();
    let order = |session: &mut Session| top_of(session, "A: sample rate") < top_of(session, "B: the truth");
    assert!(order(&mut session) && says(&mut session, "A against B"), "A in front");
    click_on(&mut session, "Swap A and B");
    assert!(!order(&mut session) && says(&mut session, "B against A"), "B in front");
}

#[test]
fn another_pixel_is_explained_from_the_top() {
    let mut session = session(Vec::new(), [1280, 600]);
    right_click(&mut session, [700.0, 300.0]);
    let top = top_of(&mut session, "canvas units");
    session.pointer(Some(dvec2(100.0, 300.0)));
    for _ in 0..8 {
        session.wheel(-1.0);
        session.settle();
    }
    let scrolled = top_of(&mut session, "canvas units");
    assert!(scrolled < top - 20.0, "{scrolled} after the wheel, {top} before");
    right_click(&mut session, [720.0, 310.0]);
    let again = top_of(&mut session, "canvas units");
    assert!((again - top).abs() < 1.0, "{again}, not {top}");
}

#[test]
fn comparing_with_a_picture_says_that_its_path_is_missing() {
    let mut session = session(Vec::new(), [800, 600]);
    session.command(Command::Window(WindowCommand::ToggleDialog(Dialog::ComparePicture)));
    session.settle();
    let button = |session: &mut Session| {
        let nodes = nodes(session);
        let button = nodes.iter().find(|node| node.label() == Some("Compare"));
        button.map(Node::is_disabled)
    };
    assert_eq!(button(&mut session), Some(true), "nothing to compare with yet");
    key(&mut session, "Enter");
    session.settle();
    assert!(says(&mut session, "type the path"), "Enter says what is missing");
    session.type_text("x.png");
    session.settle();
    assert_eq!(button(&mut session), Some(false), "once there is a path");
}

#[test]
fn explanation_of_another_view_leads_back_to_the_picture() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::set("visualise", Visualisation::LevelOfDetail.name()).expect("a value"));
    right_click(&mut session, [700.0, 300.0]);
    assert!(
        says(&mut session, "shows the level-of-detail view"),
        "it says so plainly"
    );
    click_on(&mut session, "Back to the picture");
    let shown = session.viewer.settings().render.visualisation;
    assert_eq!(shown, Visualisation::Color, "the button leads back");
    assert!(!says(&mut session, "The window shows"), "and nothing more is said");
}

#[test]
fn no_panel_comes_or_goes_under_a_pointer_that_zooms() {
    let mut zooms = 0;
    for window in [[800, 600], [1280, 800]] {
        for compares in [false, true] {
            for (pin, at) in [
                ([0.6, 0.5], [0.9, 0.4]),
                ([0.4, 0.5], [0.55, 0.9]),
                ([0.6, 0.6], [0.3, 0.3]),
            ] {
                let mut session = session(Vec::new(), window);
                session.command(Command::Window(WindowCommand::StartCard(Toggle::Off)));
                session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
                if compares {
                    session.command(Command::Ab(AbCommand::Compare(Against::Truth(None))));
                }
                session.settle();
                let within = |session: &Session, [x, y]: [f64; 2]| {
                    let free = session.free_area.expect("there is room");
                    let at = [free.x as f64 + f64::from(free.width) * x, f64::from(free.height) * y];
                    at.map(f64::round)
                };
                let pin = within(&session, pin);
                right_click(&mut session, pin);
                let free = session.free_area;
                let at = DVec2::from(within(&session, at));
                session.pointer(Some(at));
                session.settle();
                if !session.is_on_picture() || session.viewer.pixels().over_inset() {
                    // Over the magnifier the wheel magnifies.
                    continue;
                }
                zooms += 1;
                let scale = |session: &Session| session.viewer.both().view_numbers().expect("a scene").scale;
                let first = scale(&session);
                let mut before = first;
                for (turn, clicks) in [1.0; 7].into_iter().chain([-1.0; 7]).enumerate() {
                    session.wheel(clicks);
                    session.settle();
                    let what = format!("turn {turn} at {at} of {window:?}, compares {compares}");
                    assert_eq!(session.free_area, free, "panels stay: {what}");
                    let now = scale(&session);
                    assert!((now - before) * clicks > before * 0.05, "{before} to {now}: {what}");
                    before = now;
                }
                assert!((before - first).abs() < 1e-6 * first, "and back");
                assert!(session.viewer.pixels().pinned().is_some(), "the pin is there again");
            }
        }
    }
    assert!(zooms >= 6, "{zooms} zooms over the picture");
}

#[test]
fn explanation_says_that_its_pixel_is_out_of_sight() {
    let mut session = session(Vec::new(), [1280, 800]);
    right_click(&mut session, [700.0, 300.0]);
    assert!(says(&mut session, "Pixel 700, 300"), "explained");
    session.pointer(Some(dvec2(450.0, 700.0)));
    for _ in 0..10 {
        session.wheel(1.0);
    }
    session.settle();
    assert_eq!(session.viewer.pixels().pinned(), None, "out of sight");
    assert!(
        says(&mut session, "The pinned pixel is outside the window now"),
        "it says so"
    );
    key(&mut session, "e");
    session.settle();
    assert!(!says(&mut session, "The pinned pixel is outside"), "a key closes it");
    session.command(Command::Inspector(InspectorCommand::Explanation(Toggle::On)));
    session.settle();
    click_on(&mut session, "Unpin");
    session.settle();
    assert!(!session.viewer.pixels().has_explanation_open(), "unpinned, and closed");
}

#[test]
fn panel_that_is_closed_leaves_the_picture() {
    let mut session = session(Vec::new(), [800, 600]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.command(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    session.settle();
    session.command(Command::Ab(AbCommand::NextDifference));
    session.settle();
    assert!(session.viewer.pixels().pinned().is_some(), "the next difference");
    assert!(session.viewer.chrome().panel(), "still there");
    session.command(Command::Window(WindowCommand::Panel(Toggle::Flip)));
    session.settle();
    assert!(
        !session.viewer.chrome().panel() && !session.viewer.pixels().explains(),
        "nothing took its place"
    );
    let pinned = session.viewer.pixels().pinned().expect("still pinned");
    session.command(Command::Inspector(InspectorCommand::Pin(pinned.map(i64::from))));
    session.command(Command::Inspector(InspectorCommand::Explanation(Toggle::On)));
    session.settle();
    assert!(session.viewer.pixels().explains(), "asked for, it comes");
}

#[test]
fn escape_asks_anew_after_anything_else() {
    let mut session = session(Vec::new(), [800, 600]);
    key(&mut session, "Escape");
    assert!(says(&mut session, "Esc again ends the program"), "asked");
    key(&mut session, "?");
    session.settle();
    assert!(!says(&mut session, "Esc again ends the program"), "another answer");
    click(&mut session, dvec2(3.0, 3.0));
    assert_eq!(
        session.viewer.chrome().dialog(),
        None,
        "a click beside the help closes it"
    );
    key(&mut session, "Escape");
    assert!(!session.has_quit(), "hours of work later");
    key(&mut session, "Escape");
    assert!(session.has_quit(), "twice in a row");
}

#[test]
fn reset_shows_the_canvas_beside_the_panel() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("square.svg");
    let document = "<svg xmlns='http://www.w3.org/2000/svg' width='100' height='100'><circle r='50'/></svg>";
    std::fs::write(&path, document).expect("a file");
    for window in [[800, 600], [1000, 600], [1280, 800]] {
        let mut session = session(vec![path.clone()], window);
        session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
        session.settle();
        session.command(Command::View(ViewCommand::Reset));
        session.settle();
        let free = session.free_area.expect("there is room");
        let view = session.viewer.both().view_numbers().expect("a scene");
        let middle = f64::from(window[0]) / 2.0;
        let [left, right] = [0.0, 100.0].map(|x| middle + (x - view.center.x) * view.scale);
        assert!(
            left >= free.x as f64 && right <= free.right() as f64,
            "{window:?}: {left} to {right} in {free:?}"
        );
    }
}

#[test]
fn fitted_view_fits_the_window_that_there_is_after_an_explanation() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    session.command(Command::View(ViewCommand::Reset));
    session.settle();
    let fitted = session.viewer.both().view_numbers().expect("a scene");
    session.resize([700, 1000]);
    session.settle();
    right_click(&mut session, [300.0, 500.0]);
    let asked = session.viewer.both().view_numbers().expect("a scene");
    session.resize([1280, 800]);
    session.settle();
    let rests = session.viewer.both().view_numbers().expect("a scene");
    assert!(
        session.viewer.pixels().explains() && (rests.scale / asked.scale - 1.0).abs() < 1e-9,
        "the pixel stays what it is: {rests:?}, not {asked:?}"
    );
    key(&mut session, "e");
    session.settle();
    assert!(session.viewer.pixels().pinned().is_some(), "still pinned");
    let after = session.viewer.both().view_numbers().expect("a scene");
    assert!(
        (after.scale / fitted.scale - 1.0).abs() < 1e-9 && after.center.distance(fitted.center) < 1e-6,
        "{after:?}, not {fitted:?}"
    );
}

#[test]
fn what_is_folded_for_one_pixel_is_not_for_the_next() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("two.svg");
    let document = r##"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100"><rect width="100" height="100" fill="#1f6feb"/><rect width="50" height="100" fill="#eee"/></svg>"##;
    std::fs::write(&path, document).expect("a file");
    let mut session = session(vec![path], [800, 1400]);
    // On the left the lower rect is hidden, and folded; on the right it is what one sees.
    right_click(&mut session, [250.0, 700.0]);
    let paints = |session: &mut Session| {
        let told = |node: &Node| node.value().is_some_and(|value| value.contains("paints "));
        nodes(session).iter().filter(|node| told(node)).count()
    };
    assert_eq!(paints(&mut session), 1, "the upper one is unfolded");
    right_click(&mut session, [550.0, 700.0]);
    assert_eq!(paints(&mut session), 1, "and so is the only one of another pixel");
}

#[test]
fn status_line_says_that_the_desktop_scales_the_window() {
    for window in [[800, 600], [1280, 800]] {
        let mut session = session(Vec::new(), window);
        let told = |session: &mut Session| {
            let nodes = nodes(session);
            let mut words = nodes.iter().filter_map(|node| node.label().or(node.value()));
            words.any(|word| word == "shown at 75 % by the desktop")
        };
        assert!(!told(&mut session), "pixel for pixel in {window:?}");
        session.set_shown_at(Some(75));
        assert!(told(&mut session), "scaled in {window:?}");
    }
}

#[test]
fn inspector_hides_where_a_panel_leaves_it_no_room() {
    const SAYS: &str = "no room here for the pixel inspector";
    let mut session = session(Vec::new(), [333, 777]);
    session.command(Command::Inspector(InspectorCommand::Pin([30, 300])));
    session.command(Command::Inspector(InspectorCommand::Explanation(Toggle::Off)));
    session.settle();
    let shows = |session: &Session| session.viewer.inspector().inset().is_some();
    let told = |session: &Session| {
        let messages = session.viewer.chrome().messages();
        messages.iter().filter(|message| message.text.starts_with(SAYS)).count()
    };
    assert_eq!((shows(&session), told(&session)), (true, 0), "beside nothing");
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    assert_eq!((shows(&session), told(&session)), (false, 1), "beside the panel");
    session.resize([640, 777]);
    session.settle();
    assert_eq!((shows(&session), told(&session)), (true, 0), "in a wider window");
    session.resize([333, 777]);
    session.settle();
    assert!(!shows(&session), "narrow again");
    session.command(Command::Window(WindowCommand::Panel(Toggle::Off)));
    session.settle();
    assert_eq!((shows(&session), told(&session)), (true, 0), "without the panel");
}
