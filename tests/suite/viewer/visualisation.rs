//! Visualisations in the viewer: keys, legends in the window and on saved pictures, what else of the window stays.

use glam::dvec2;
use rasterscope::figure::{add_legends, place_legends};
use rasterscope::raster::Framebuffer;
use rasterscope::render::Visualisation;
use rasterscope::viewer::{AbCommand, InspectorCommand, ViewCommand, WindowCommand};
use rasterscope::viewer::{Against, Arrangement, Command, PixelRect, WindowPixels};

use crate::support::session::{Session, TRIANGLES, set, step};

const WINDOW: [u32; 2] = [640, 480];

fn shown(session: &Session) -> Visualisation {
    session.viewer.settings().render.visualisation
}

fn rgba(picture: &Framebuffer) -> Vec<[u8; 4]> {
    let all = (0..picture.height()).flat_map(|y| (0..picture.width()).map(move |x| (x, y)));
    all.map(|(x, y)| picture.rgba(x, y).unwrap()).collect()
}

#[test]
fn visualisations_follow_each_other_by_key() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    for visualisation in Visualisation::ALL.into_iter().cycle().skip(1).take(10) {
        session.keys(&["v"]);
        assert_eq!(shown(&session), visualisation, "the next");
        session.assert_frame_is_current();
        let named = session.viewer.recipes().command_line().unwrap();
        let option = format!(" --visualise {}", visualisation.name());
        assert_eq!(
            named.contains(&option),
            visualisation != Visualisation::Color,
            "{named}"
        );
    }
    session.keys(&["shift+v", "shift+v"]);
    assert_eq!(shown(&session), Visualisation::MipLevels, "back");
    assert!(
        session.viewer.both().title().contains("visualise mip"),
        "{}",
        session.viewer.both().title()
    );
}

#[test]
fn visualised_window_shows_the_legend_where_it_hides_nothing() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    assert!(
        session.viewer.frames().legend_places().is_empty(),
        "a picture needs none"
    );
    session.run(set("visualise", Visualisation::Overdraw.name()));
    let legend = {
        let scene = session.viewer.scene_list().current().unwrap().scene().unwrap();
        Visualisation::Overdraw.legend(scene).unwrap()
    };
    let free = PixelRect {
        x: 0,
        y: 0,
        width: 640,
        height: 300,
    };
    session.run(Command::Window(WindowCommand::SetFreeArea(Some(free))));
    let expected = place_legends(&[legend], WINDOW, &free, &[]);
    let [(rect, picture)] = &expected[..] else {
        panic!("there is room")
    };
    assert_eq!(session.viewer.frames().legend_places(), [*rect], "in the free area");
    let window = session.viewer.window().picture();
    let row = |y: i64| usize::try_from(y * 640 + rect.x).unwrap();
    for (y, pixels) in (rect.y..).zip(picture.pixels().chunks(rect.width as usize)) {
        assert_eq!(&window.pixels()[row(y)..][..pixels.len()], pixels, "row {y}");
    }
    // A pin where the legend was.
    session.run(Command::Inspector(InspectorCommand::Pin([
        rect.x + 4,
        rect.bottom() - 4,
    ])));
    for place in session.viewer.frames().legend_places() {
        assert!(!place.contains([rect.x + 4, rect.bottom() - 4]), "the pixel is seen");
        assert!(
            !place.overlaps(&session.viewer.inspector().inset().unwrap().rect),
            "so is its inset"
        );
    }
    session.keys(&["tab"]);
    assert!(session.viewer.frames().legend_places().is_empty(), "only the picture");
}

#[test]
fn visualised_window_draws_the_parts_that_changed() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    let mut window = session.viewer.window().picture();
    assert!(session.viewer.take_damage().is_none(), "at first everything");
    for command in [
        step("visualise", 1.0),
        Command::Inspector(InspectorCommand::Pin([100, 440])),
        set("visualise", Visualisation::Wireframe.name()),
        Command::View(ViewCommand::PanBy { by: dvec2(3.0, 0.0) }),
        Command::Ab(AbCommand::Compare(Against::Settings)),
        Command::Ab(AbCommand::Arrange(Arrangement::Wipe)),
        set("visualise", Visualisation::Barycentric.name()),
        Command::Ab(AbCommand::Arrange(Arrangement::Difference)),
        set("visualise", Visualisation::Color.name()),
    ] {
        session.run(command.clone());
        let parts = session.viewer.take_damage();
        let all = [PixelRect::of_size(WINDOW)];
        let parts = parts.as_deref().unwrap_or(&all);
        session
            .viewer
            .window()
            .draw_parts(parts, &mut WindowPixels::of(&mut window));
        assert!(window == session.viewer.window().picture(), "after {command:?}");
    }
}

#[test]
fn visualised_comparison_has_a_legend_for_each_side_that_differs() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    let legends = |session: &Session| session.viewer.frames().legend_places().len();
    session.run(set("visualise", Visualisation::Coverage.name()));
    session.run(Command::Ab(AbCommand::Compare(Against::Settings)));
    session.run(Command::Ab(AbCommand::Arrange(Arrangement::Wipe)));
    assert_eq!(legends(&session), 1, "both show the same");
    session.run(set("visualise", Visualisation::Primitive.name()));
    assert_eq!(legends(&session), 2, "one each");
    session.run(Command::Ab(AbCommand::Arrange(Arrangement::Difference)));
    assert_eq!(legends(&session), 0, "the difference has other colours");
    session.run(Command::Ab(AbCommand::Arrange(Arrangement::Alone)));
    assert_eq!(legends(&session), 1, "A's");
}

#[test]
fn visualised_screenshots_carry_the_legend() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    session.run(set("visualise", Visualisation::Coverage.name()));
    session.keys(&["s"]);
    let mut expected = session.pixels().clone();
    let scene = session.viewer.scene_list().current().unwrap().scene().unwrap();
    let legend = Visualisation::Coverage.legend(scene).unwrap();
    assert_eq!(add_legends(&mut expected, &[legend], &[]), 1, "there is room");
    let saved = image::open(&session.pictures()[0]).unwrap().into_rgba8();
    let saved: Vec<[u8; 4]> = saved.pixels().map(|pixel| pixel.0).collect();
    assert!(saved == rgba(&expected), "frame and legend");
}

#[test]
fn visualised_pixels_are_explained_as_the_picture() {
    let mut session = Session::open(&[TRIANGLES], WINDOW);
    session.run(Command::Inspector(InspectorCommand::Pin([300, 240])));
    let explained = |session: &Session| session.viewer.inspector().explanation().unwrap().color;
    let before = explained(&session);
    session.run(set("visualise", Visualisation::Primitive.name()));
    assert_eq!(explained(&session), before, "its colour");
    assert_ne!(
        session.pixels().rgba(300, 240).unwrap()[..3],
        before[..3],
        "which is not to be seen"
    );
}
