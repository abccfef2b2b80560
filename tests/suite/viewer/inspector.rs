//! The pixel inspector without a window: pin, inset, labels, samples.

use glam::dvec2;
use rasterscope::raster::SamplePattern;
use rasterscope::viewer::{AbCommand, ExportCommand, InspectorCommand, PointerCommand, ViewCommand, WindowCommand};
use rasterscope::viewer::{Command, Effect, PixelRect, PixelZoom, Toggle, ViewNumbers};

use crate::support::session::{Session, TRIANGLES, set};

#[test]
fn inspector_pin_and_nudge() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    session.keys(&["Left"]);
    assert_eq!(
        session.viewer.pixels().pinned(),
        None,
        "arrows do nothing before the inspector is open"
    );
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(100.2, 50.9) }));
    session.keys(&["Enter"]);
    assert_eq!(session.viewer.pixels().pinned(), Some([100, 50]), "pinned");
    assert!(session.viewer.inspector().magnifier().open, "and to be seen");
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(3.0, 4.0) }));
    session.keys(&["Left", "Up", "Shift+Right", "Shift+Down"]);
    assert_eq!(session.viewer.pixels().pinned(), Some([109, 59]), "nudged");
    session.run(Command::Inspector(InspectorCommand::Nudge([100_000, -100_000])));
    assert_eq!(session.viewer.pixels().pinned(), Some([399, 0]), "within the frame");
    session.run(Command::Window(WindowCommand::Resize([200, 300])));
    assert_eq!(
        session.viewer.pixels().pinned(),
        None,
        "a smaller frame does not reach the place"
    );
    session.run(Command::Window(WindowCommand::Resize([0, 0])));
    assert_eq!(
        session.viewer.pixels().pinned(),
        None,
        "a minimised window has no pixels"
    );
    session.run(Command::Window(WindowCommand::Resize([400, 300])));
    assert_eq!(session.viewer.pixels().pinned(), Some([399, 0]), "as the user chose it");
}

#[test]
fn status_tells_of_a_pin_that_arrows_moved_until_the_pointer_moves() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    let told = |session: &Session| session.viewer.pixels().status().map(|status| status.pixel);
    let to = |x, y| Command::Pointer(PointerCommand::Moved { at: dvec2(x, y) });
    session.run(to(100.2, 50.9));
    session.keys(&["Enter"]);
    assert_eq!(told(&session), Some([100, 50]), "pinned under the pointer");
    session.keys(&["Right", "Right", "Right"]);
    assert_eq!(
        told(&session),
        Some([103, 50]),
        "the pin, not what the pointer rests on"
    );
    session.run(to(100.2, 51.9));
    assert_eq!(told(&session), Some([100, 51]), "the pointer moved");
    session.run(Command::Inspector(InspectorCommand::Pin([7, 9])));
    assert_eq!(told(&session), Some([7, 9]), "pinned by a command");
    session.run(Command::Inspector(InspectorCommand::Unpin));
    assert_eq!(told(&session), Some([100, 51]), "nothing is pinned");
}

#[test]
fn inspector_pin_stays_at_its_place_in_the_scene() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    session.run(Command::Inspector(InspectorCommand::Pin([150, 120])));
    let place = |session: &Session| {
        let pixel = session.viewer.pixels().pinned().expect("in the frame");
        session.viewer.pixels().status_of(pixel).expect("a scene").user
    };
    let (before, scale) = (
        place(&session),
        session.viewer.both().view_numbers().expect("a view").scale,
    );
    session.run(Command::View(ViewCommand::ZoomAt {
        at: Some(dvec2(130.0, 110.0)),
        factor: 3.0,
    }));
    assert_eq!(
        session.viewer.pixels().pinned(),
        Some([190, 140]),
        "three times as far from what stays"
    );
    session.run(Command::View(ViewCommand::PanBy { by: dvec2(-40.0, 25.0) }));
    assert_eq!(session.viewer.pixels().pinned(), Some([150, 165]), "with the picture");
    for command in [
        Command::View(ViewCommand::RotateBy { degrees: 35.0 }),
        Command::Window(WindowCommand::Resize([500, 420])),
        Command::View(ViewCommand::SetPixelZoom(PixelZoom::ALL[1])),
        set("sample-rate", "9"),
    ] {
        session.run(command.clone());
        let numbers = session.viewer.both().view_numbers().expect("a view");
        assert!(
            (place(&session) - before).length() < 1.0 / numbers.scale,
            "{command:?}: less than a pixel away"
        );
    }
    session.run(Command::View(ViewCommand::PanBy { by: dvec2(9000.0, 0.0) }));
    assert_eq!(session.viewer.pixels().pinned(), None, "out of sight");
    session.run(Command::View(ViewCommand::Reset));
    assert!(
        (place(&session) - before).length() < 1.0 / scale.min(1.0),
        "and back: {:?}",
        session.viewer.pixels().pinned()
    );
}

#[test]
fn means_of_a_and_b_are_told_in_one_unit() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    session.run(set("sample-rate", "4"));
    session.keys(&["r"]);
    // At an edge, and where one colour fills the pixel.
    let row = |session: &Session, what: &str| {
        let inspector = session.viewer.inspector();
        let differences = inspector.explanation()?.differences(inspector.other_explanation()?);
        let row = differences.into_iter().find(|difference| difference.what == what)?;
        Some([row.a, row.b])
    };
    session.run(set("resolve", "linear"));
    let other = session.viewer.ab().other_pixels().unwrap().pixels().to_vec();
    let differs = |(a, b): (&u32, &u32)| a != b;
    let at_edge = session.pixels().pixels().iter().zip(&other).position(differs);
    let at_edge = i64::try_from(at_edge.expect("edges are of another colour")).unwrap();
    for pixel in [[at_edge % 400, at_edge / 400], [0, 0]] {
        session.run(Command::Inspector(InspectorCommand::Pin(pixel)));
        assert!(row(&session, "averaged as").is_some(), "the values differ");
        let [colours, means] = ["colour", "mean"].map(|what| row(&session, what));
        assert_eq!(
            colours.is_some(),
            means.is_some(),
            "where both show one colour, nothing is told"
        );
        let Some(means) = means else { continue };
        let red = |mean: &str| mean.split(',').next().unwrap().parse::<f64>().unwrap().round();
        let explained = session.viewer.inspector().explanation().unwrap();
        let off = (red(&means[0]) - f64::from(explained.color[0])).abs();
        assert!(off <= 1.0, "in stored values: {means:?}");
    }
}

#[test]
fn inspector_explains_the_pinned_pixel() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    assert!(session.viewer.inspector().explanation().is_none(), "nothing is pinned");
    session.run(Command::Inspector(InspectorCommand::Show(Toggle::On)));
    assert!(
        session.viewer.inspector().explanation().is_none(),
        "the pointer is not followed"
    );
    session.run(Command::Inspector(InspectorCommand::Pin([200, 150])));
    let explained = session
        .viewer
        .inspector()
        .explanation()
        .expect("a pinned pixel")
        .clone();
    let frame = session.viewer.frames().frame().expect("a frame");
    assert_eq!(explained.pixel, [200, 150], "the pinned one");
    assert_eq!(Some(explained.color), frame.final_rgba(200, 150), "as in the frame");
    session.run(set("sample-rate", "4"));
    assert_eq!(
        session
            .viewer
            .inspector()
            .explanation()
            .map(|explained| explained.samples.len()),
        Some(4),
        "for the new settings"
    );
    assert!(
        session.viewer.inspector().other_explanation().is_none(),
        "there is no B"
    );
    session.keys(&["r"]);
    session.run(set("sample-rate", "9"));
    let explained = session.viewer.inspector().explanation().expect("a pinned pixel");
    let other = session
        .viewer
        .inspector()
        .other_explanation()
        .expect("B is drawn by us");
    let differences = explained.differences(other);
    let samples = differences.iter().find(|difference| difference.what == "samples");
    assert_eq!(
        samples.map(|difference| (difference.a.as_str(), difference.b.as_str())),
        Some(("9", "4")),
        "{differences:?}"
    );
    assert!(
        explained.differences(explained).is_empty(),
        "nothing differs from itself"
    );
    session.keys(&["e"]);
    assert!(session.viewer.inspector().explanation().is_none(), "closed");
    session.keys(&["e"]);
    assert!(session.viewer.inspector().explanation().is_some(), "open again");
    let copied = session.run(Command::Export(ExportCommand::CopyExplanation));
    assert!(
        matches!(copied.as_slice(), [Effect::CopyText(text)] if text.starts_with("## Pixel (200, 150)")),
        "{copied:?}"
    );
}

#[test]
fn inspector_inset_reads_the_frame() {
    let mut session = Session::open(&[TRIANGLES], [640, 480]);
    session.run(Command::Inspector(InspectorCommand::Pin([320, 240])));
    let placed = session.viewer.inspector().inset().unwrap();
    let block = placed.block([322, 239]).unwrap();
    session.run(Command::Pointer(PointerCommand::Moved {
        at: dvec2(block.x as f64 + 1.5, block.y as f64 + 2.5),
    }));
    assert!(session.viewer.pixels().over_inset(), "over the inset");
    assert_eq!(
        session.viewer.pixels().hovered(),
        Some([322, 239]),
        "the magnified pixel"
    );
    assert_eq!(
        session.viewer.pixels().status().unwrap().rgba,
        session.pixels().rgba(322, 239),
        "its colour"
    );
    let window = session.viewer.window().picture();
    let corner = [block.x, block.y].map(|n| u32::try_from(n).unwrap());
    assert_eq!(
        window.rgba(corner[0], corner[1]),
        session.pixels().rgba(322, 239),
        "shown as it is"
    );
    let magnification = session.viewer.inspector().magnifier().magnification;
    let numbers = session.viewer.both().view_numbers();
    session.run(Command::Pointer(PointerCommand::Wheel { clicks: 1.0 }));
    assert!(
        session.viewer.inspector().magnifier().magnification > magnification,
        "the wheel magnifies here"
    );
    assert_eq!(
        session.viewer.both().view_numbers(),
        numbers,
        "and does not zoom the picture"
    );
}

#[test]
fn inspector_inset_never_hides_its_pixel() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    session.run(Command::Inspector(InspectorCommand::Show(Toggle::On)));
    session.run(Command::Window(WindowCommand::SetFreeArea(Some(PixelRect {
        x: 60,
        y: 0,
        width: 340,
        height: 290,
    }))));
    for zoom in PixelZoom::ALL {
        session.run(Command::View(ViewCommand::SetPixelZoom(zoom)));
        for y in (0..300).step_by(7) {
            for x in (0..400).step_by(13) {
                let _ = session.viewer.apply(Command::Pointer(PointerCommand::Moved {
                    at: dvec2(f64::from(x), f64::from(y)),
                }));
                let [px, py] = session.viewer.pixels().inspected().unwrap();
                let k = zoom.factor();
                assert_eq!([px, py], [x / k, y / k], "follows the pointer, below the inset too");
                let shown = PixelRect {
                    x: i64::from(px * k),
                    y: i64::from(py * k),
                    width: k,
                    height: k,
                };
                let placed = session.viewer.inspector().inset().unwrap();
                assert!(!placed.rect.overlaps(&shown), "{placed:?} hides {shown:?}");
                assert!(
                    placed.rect.x >= 60 && placed.rect.bottom() <= 290,
                    "below a panel: {placed:?}"
                );
            }
        }
    }
}

#[test]
fn inspector_labels_only_where_they_fit() {
    let mut session = Session::open(&[TRIANGLES], [640, 480]);
    session.run(Command::Inspector(InspectorCommand::Pin([0, 0])));
    assert!(
        session.viewer.pixels().pixel_labels([7.0, 12.0]).is_empty(),
        "20 pixels are too few for 3 lines of 12"
    );
    session.run(Command::Inspector(InspectorCommand::SetMagnification(40)));
    let labels = session.viewer.pixels().pixel_labels([7.0, 12.0]);
    let inset = session.viewer.inspector().inset().unwrap().inset;
    let visible = usize::try_from(inset.region - inset.region / 2).unwrap();
    let dots = usize::from(!inset.has_detail());
    let expected = visible * visible - dots;
    assert_eq!(
        labels.len(),
        expected,
        "only pixels of the frame have numbers, and dots need their place"
    );
    for label in labels {
        let [x, y] = label.pixel;
        assert_eq!(Some(label.rgba), session.pixels().rgba(x, y), "{label:?}");
    }
}

#[test]
fn inspector_samples_of_the_inspected_pixel() {
    // A left half in red; and the same below thousands of shapes, which are probed in a thread.
    let half = |others: usize| {
        let other = r#"<rect x="0" y="90" width="1" height="1" fill="black"/>"#.repeat(others);
        format!(
            r##"<svg width="100" height="100"><rect id="left" fill="#ff0000" x="0" y="0" width="50" height="100"/>{other}</svg>"##
        )
    };
    let mut session = Session::open(&[&half(0), &half(5000)], [120, 120]);
    session.run(set("sample-rate", "16"));
    for key in ["1", "2"] {
        session.keys(&[key]);
        // The red edge runs through the middle of the pixel.
        session.run(Command::View(ViewCommand::Set(ViewNumbers {
            center: dvec2(49.5, 50.0),
            scale: 1.0,
            rotation: 0.0,
        })));
        session.run(Command::Inspector(InspectorCommand::Pin([60, 60])));
        let samples = session.viewer.inspector().pixel_samples();
        assert_eq!(samples.len(), 16, "scene {key}");
        let hits: Vec<(String, usize)> = session
            .viewer
            .inspector()
            .hits()
            .into_iter()
            .map(|(hit, n)| (hit.to_string(), n))
            .collect();
        let expected = [("rect \"left\", line 1".to_owned(), 8), ("background".to_owned(), 8)];
        assert_eq!(hits, expected, "scene {key}");
        let green: u32 = samples.iter().map(|sample| u32::from(sample.mark.color[1])).sum();
        let pixel = session.pixels().rgba(60, 60).unwrap();
        assert_eq!(
            (green + 8) / 16,
            u32::from(pixel[1]),
            "the pixel is the mean of its samples"
        );
    }
    session.run(set("coverage", "exact"));
    assert!(
        session.viewer.inspector().pixel_samples().is_empty(),
        "areas are covered, without samples"
    );
    session.run(set("coverage", "sampled"));
    session.keys(&["Esc", "Esc"]);
    assert!(
        session.viewer.inspector().pixel_samples().is_empty(),
        "the inspector is closed"
    );
}

#[test]
fn inspector_counts_the_shades_of_an_edge() {
    // Stairs, a pixel high each and 1/24 of a pixel wide, so that no stair has two shades.
    let stair = |i: u32| {
        let x = 49.01 + f64::from(i) / 24.0;
        format!("{x:.4},{} {x:.4},{} ", 34 + i, 35 + i)
    };
    let stairs: String = (0..32).map(stair).collect();
    let edge = format!(r#"<svg width="100" height="100"><polygon points="0,34 {stairs}0,66" fill="black"/></svg>"#);
    let mut session = Session::open(&[&edge], [640, 480]);
    session.run(Command::View(ViewCommand::Set(ViewNumbers {
        center: dvec2(50.0, 50.0),
        scale: 1.0,
        rotation: 0.0,
    })));
    assert_eq!(session.viewer.pixels().region_colors(), None, "the inspector is closed");
    session.run(set("sample-rate", "4"));
    session.run(Command::Inspector(InspectorCommand::SetRegion(32)));
    session.run(Command::Inspector(InspectorCommand::SetMagnification(6)));
    session.run(Command::Inspector(InspectorCommand::Pin([320, 240])));
    let found = session.viewer.pixels().region_colors();
    session.run(set("pattern", SamplePattern::Rotated.name()));
    assert_eq!(
        (found, session.viewer.pixels().region_colors()),
        (Some(3), Some(5)),
        "grid and rotated grid"
    );
}

/// Enter opens the explanation with every pin. E goes by what is to be seen: it never changes what nobody sees.
#[test]
fn inspector_explanation_goes_by_what_is_seen() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(100.0, 50.0) }));
    session.keys(&["e"]);
    assert_eq!(
        session.viewer.pixels().pinned(),
        Some([100, 50]),
        "E pins where nothing is"
    );
    assert!(session.viewer.pixels().explains(), "and explains");
    session.keys(&["e"]);
    assert!(!session.viewer.pixels().explains(), "E hides what is shown");
    assert_eq!(session.viewer.pixels().pinned(), Some([100, 50]), "the pin stays");
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(120.0, 60.0) }));
    session.keys(&["Enter"]);
    assert_eq!(session.viewer.pixels().pinned(), Some([120, 60]), "the pin moves");
    assert!(
        session.viewer.pixels().explains(),
        "who points at another pixel asks about it"
    );
    session.keys(&["Enter"]);
    assert_eq!(session.viewer.pixels().pinned(), None, "unpinned");
    session.keys(&["Enter"]);
    assert!(
        session.viewer.pixels().explains(),
        "a new pin is explained, as its help says"
    );
    session.keys(&["Tab"]);
    assert!(!session.viewer.pixels().explains(), "only the picture");
    session.keys(&["e"]);
    assert!(
        session.viewer.pixels().explains(),
        "E shows what was hidden with the rest"
    );
    assert_eq!(session.viewer.pixels().pinned(), Some([120, 60]), "of the same pixel");
}

/// Where the pointer was last is not to be seen, unless the magnifier shows it.
#[test]
fn inspector_pins_the_middle_while_the_pointer_is_elsewhere() {
    for key in ["Enter", "e"] {
        let mut session = Session::open(&[TRIANGLES], [400, 300]);
        session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(100.0, 50.0) }));
        session.run(Command::Pointer(PointerCommand::Left));
        session.keys(&[key]);
        assert_eq!(
            session.viewer.pixels().pinned(),
            Some([200, 150]),
            "the middle, by {key}"
        );
    }
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    session.run(Command::Pointer(PointerCommand::Moved { at: dvec2(100.0, 50.0) }));
    session.keys(&["z"]);
    session.run(Command::Pointer(PointerCommand::Left));
    session.keys(&["Enter"]);
    assert_eq!(
        session.viewer.pixels().pinned(),
        Some([100, 50]),
        "the one that the magnifier shows"
    );
}

/// A pin that leaves the window is not forgotten, and says where it went.
#[test]
fn inspector_says_that_the_pin_left_the_window() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    session.run(Command::Inspector(InspectorCommand::Pin([100, 50])));
    let told = |session: &Session| {
        let messages = session.viewer.chrome().messages();
        messages
            .iter()
            .any(|message| message.text.contains("outside the window"))
    };
    assert!(!told(&session), "it is in sight");
    let at = dvec2(300.0, 250.0);
    session.run(Command::Pointer(PointerCommand::Moved { at }));
    session.run(Command::Pointer(PointerCommand::Wheel { clicks: 6.0 }));
    assert_eq!(session.viewer.pixels().pinned(), None, "zoomed away");
    assert!(told(&session), "and not in silence");
    session.run(Command::Pointer(PointerCommand::Wheel { clicks: -6.0 }));
    assert_eq!(session.viewer.pixels().pinned(), Some([100, 50]), "it comes back");
    assert!(session.viewer.pixels().explains(), "with its explanation");
}

/// The ring in the picture goes where the pixel is to be seen, in every pane.
#[test]
fn inspector_pin_has_a_place_in_every_pane() {
    let mut session = Session::open(&[TRIANGLES], [400, 300]);
    assert!(session.viewer.pixels().pinned_places().is_empty(), "no pin");
    session.run(Command::Inspector(InspectorCommand::Pin([100, 50])));
    let corners = |session: &Session| -> Vec<[i64; 2]> {
        let places = session.viewer.pixels().pinned_places();
        places.iter().map(|place| [place.x, place.y]).collect()
    };
    assert_eq!(corners(&session), [[100, 50]], "in the frame");
    session.run(Command::Ab(AbCommand::Swap));
    session.run(Command::Window(WindowCommand::SetFreeArea(Some(PixelRect::of_size([
        400, 300,
    ])))));
    session.run(Command::Ab(AbCommand::Arrange(
        rasterscope::viewer::Arrangement::SideBySide,
    )));
    let pixel = session.viewer.pixels().pinned().expect("in both halves");
    let [x, y] = pixel.map(i64::from);
    assert_eq!(corners(&session), [[x, y], [x + 201, y]], "in both");
}
