//! Room between the panels and the picture: edges that are dragged, and a canvas that goes where there is room.

use egui::accesskit::{Node, Rect};
use glam::{DVec2, dvec2};

use super::hands::{comparing, nodes, place_of, right_click, session};
use super::*;
use crate::viewer::script::Stage as _;
use crate::viewer::{PixelRect, Toggle, ViewCommand, WindowCommand};

const SIDE: &str = "Edge of the side panel";
const EXPLANATION: &str = "Edge of the explanation";

fn bounds(session: &mut Session, name: &str) -> Option<Rect> {
    let nodes = nodes(session);
    nodes
        .iter()
        .find(|node| node.label() == Some(name))
        .and_then(Node::bounds)
}

/// Where an edge is, in points from the left.
fn edge(session: &mut Session, name: &str) -> f64 {
    place_of(session, name).x
}

fn drag(session: &mut Session, from: DVec2, to: DVec2) {
    session.pointer(Some(from));
    session.button(PointerButton::Primary, true);
    for step in 1..=4 {
        session.pointer(Some(from.lerp(to, f64::from(step) / 4.0)));
    }
    session.button(PointerButton::Primary, false);
    session.settle();
}

#[test]
fn dragged_edge_makes_a_panel_wider_and_leaves_the_picture_alone() {
    let mut session = session(Vec::new(), [1280, 800]);
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    let view = session.viewer.both().view_numbers();
    let revision = session.viewer.picture_revision();
    let from = dvec2(edge(&mut session, SIDE), 300.0);
    assert!((from.x - 1016.0).abs() < 1.0, "its first width: {from}");
    drag(&mut session, from, from - dvec2(26.0, 0.0));
    assert!(
        (edge(&mut session, SIDE) - 990.0).abs() < 1.0,
        "it followed the pointer"
    );
    assert_eq!(session.viewer.both().view_numbers(), view, "the canvas has room yet");
    assert_eq!(session.viewer.picture_revision(), revision, "and no drag moved it");
    drag(&mut session, dvec2(990.0, 300.0), dvec2(3.0, 300.0));
    assert!(
        (edge(&mut session, SIDE) - 704.0).abs() < 1.0,
        "no wider than 45 % of the window"
    );
    assert_ne!(session.viewer.both().view_numbers(), view, "the canvas made room");
    let at = dvec2(704.0, 300.0);
    drag(&mut session, at, dvec2(1279.0, 300.0));
    assert!(
        (edge(&mut session, SIDE) - 1016.0).abs() < 1.0,
        "all of it stays to be read"
    );
    assert_eq!(session.viewer.both().view_numbers(), view, "the canvas is where it was");
    drag(&mut session, dvec2(1016.0, 300.0), dvec2(900.0, 300.0));
    for _ in 0..2 {
        hands::click(&mut session, dvec2(900.0, 300.0));
    }
    session.settle();
    assert!(
        (edge(&mut session, SIDE) - 1016.0).abs() < 1.0,
        "a double click gives the first width"
    );
}

#[test]
fn comparison_and_explanation_leave_most_of_the_window_to_the_picture() {
    for (window, least) in [([1280, 800], 0.55), ([1366, 768], 0.55), ([1920, 1080], 0.55)] {
        for on_left in [true, false] {
            let mut session = comparing(window);
            let x = if on_left { 0.4 } else { 0.6 } * f64::from(window[0]);
            right_click(&mut session, [x, 300.0]);
            let (left, right) = free(&mut session, window);
            let part = (right - left) / f64::from(window[0]);
            assert!(part >= least, "{part} of {window:?} at {x}");
            assert!(
                session.viewer.inspector().explanation().is_some(),
                "and the pixel is explained"
            );
        }
    }
}

/// From where to where no panel lies.
fn free(session: &mut Session, window: [u32; 2]) -> (f64, f64) {
    let width = f64::from(window[0]);
    let edges = [SIDE, EXPLANATION, "Edge of the comparison"];
    let edges: Vec<f64> = edges
        .iter()
        .filter_map(|name| bounds(session, name))
        .map(|place| f64::midpoint(place.x0, place.x1))
        .collect();
    let (left, right): (Vec<f64>, Vec<f64>) = edges.into_iter().partition(|x| *x < width / 2.0);
    (
        left.into_iter().fold(0.0, f64::max),
        right.into_iter().fold(width, f64::min),
    )
}

#[test]
fn canvas_goes_where_panels_leave_room() {
    let window = [1000, 760];
    let mut session = session(Vec::new(), window);
    let inside = |session: &mut Session| {
        let (left, right) = free(session, window);
        let numbers = session.viewer.both().view_numbers().expect("a view");
        let canvas = session
            .viewer
            .scene_list()
            .current()
            .and_then(|entry| entry.scene())
            .expect("a scene")
            .canvas;
        let reach = numbers.scale * canvas.x / 2.0;
        let middle = 500.0 + (canvas.x / 2.0 - numbers.center.x) * numbers.scale;
        middle - reach >= left && middle + reach <= right
    };
    let first = session.viewer.both().view_numbers();
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    assert!(inside(&mut session), "beside the side panel");
    let beside = session.viewer.both().view_numbers();
    assert_ne!(beside, first, "else it would be covered");
    // A pinned pixel stays what it is.
    session.command(Command::Window(WindowCommand::Panel(Toggle::Off)));
    session.settle();
    assert_eq!(session.viewer.both().view_numbers(), first, "as without a panel");
    right_click(&mut session, [500.0, 300.0]);
    let pinned = session
        .viewer
        .inspector()
        .explanation()
        .map(|explanation| (explanation.pixel, explanation.color));
    assert_eq!(
        session.viewer.both().view_numbers(),
        first,
        "no other samples for the pixel that is explained"
    );
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    assert_eq!(session.viewer.both().view_numbers(), first, "nor with another panel");
    session.command(Command::Window(WindowCommand::Panel(Toggle::Off)));
    session.settle();
    right_click(&mut session, [500.0, 300.0]);
    assert!(pinned.is_some(), "it was explained");
    // A view that a hand moved stays.
    session.command(Command::View(ViewCommand::PanBy { by: dvec2(7.0, 3.0) }));
    session.settle();
    let moved = session.viewer.both().view_numbers();
    session.command(Command::Window(WindowCommand::Panel(Toggle::On)));
    session.settle();
    assert_eq!(session.viewer.both().view_numbers(), moved, "a hand moved it");
    session.command(Command::View(ViewCommand::Reset));
    session.settle();
    assert!(inside(&mut session), "until it is reset");
    session.command(Command::Window(WindowCommand::Panel(Toggle::Off)));
    session.settle();
    assert_eq!(session.viewer.both().view_numbers(), first, "then it follows again");
}

#[test]
fn pinned_pixel_stays_in_sight_when_the_window_shrinks() {
    for lesson in [false, true] {
        let paths = if lesson {
            vec!["lesson:six-tasks".into()]
        } else {
            Vec::new()
        };
        let mut session = session(paths, [1280, 800]);
        right_click(&mut session, [if lesson { 500.0 } else { 900.0 }, 300.0]);
        for size in [[900, 700], [700, 520], [640, 480], [1280, 800]] {
            session.set_size(size, 1.0);
            session.settle();
            session.settle();
            let free = session.free_area.expect("room");
            let places = session.viewer.pixels().pinned_places();
            let seen = |place: &PixelRect| free.contains([place.x, place.y]);
            assert!(!places.is_empty(), "the pin is in {size:?}, lesson {lesson}");
            assert!(
                places.iter().all(seen),
                "{places:?} in {free:?} of {size:?}, lesson {lesson}"
            );
        }
    }
}
