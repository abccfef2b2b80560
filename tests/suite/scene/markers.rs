//! Markers: where they stand on an outline, and in which direction they point.

use rasterscope::scene::{DialectChoice, PrimitiveKind};

use crate::support::documents::{read, svg};

/// An arrow, which points along x where nothing turns it.
const ARROW: &str = "<marker id='a' viewBox='0 0 10 10' refX='5' refY='5' markerWidth='6' markerHeight='6' orient='auto' overflow='visible'>\
     <path d='M0 0L10 5L0 10z'/></marker>";

/// In which directions the arrows of a drawing point, in degrees from 0 to 360.
fn directions(body: &str) -> Vec<f64> {
    places(body).into_iter().map(|[_, _, degrees]| degrees).collect()
}

/// Where the arrows of a drawing stand, x and y, and their directions.
fn places(body: &str) -> Vec<[f64; 3]> {
    let document = svg("width='400' height='300' fill='none'", &format!("{ARROW}{body}"));
    let scene = read(
        &document.replace("<path d='M0 0L", "<path fill='red' d='M0 0L"),
        DialectChoice::Svg,
    );
    let arrows = scene.primitives.iter().filter_map(|primitive| match primitive.kind {
        PrimitiveKind::Triangle {
            points: [a, tip, b], ..
        } => {
            let way = tip - (a + b) / 2.0;
            let middle = tip - way / 2.0;
            // Coordinates come as 32-bit floats.
            let rounded = |number: f64| (number * 100.0).round() / 100.0;
            let degrees = rounded(way.y.atan2(way.x).to_degrees()).rem_euclid(360.0);
            Some([rounded(middle.x), rounded(middle.y), degrees])
        }
        _ => None,
    });
    arrows.collect()
}

fn assert_directions(body: &str, expected: &[f64]) {
    assert_eq!(directions(body), expected, "{body}");
}

#[test]
fn markers_point_on_where_points_of_the_outline_coincide() {
    for (outline, expected) in [
        ("<path d='M40 40C40 40 40 140 140 140' marker-start='url(#a)'/>", 90.0),
        ("<path d='M40 40c0 0 0 0 50 50' marker-start='url(#a)'/>", 45.0),
        (
            "<path d='M240 180L300 240C300 240 300 290 360 290' marker-mid='url(#a)'/>",
            67.5,
        ),
        ("<path d='M30 50L100 50L100 100L100 100' marker-end='url(#a)'/>", 90.0),
        (
            "<path d='M30 50H100V100C100 100 100 100 100 100' marker-end='url(#a)'/>",
            90.0,
        ),
        ("<path d='M30 50C40 90 80 90 80 90' marker-end='url(#a)'/>", 0.0),
        ("<path d='M200 50L200 50L200 150' marker-start='url(#a)'/>", 90.0),
        (
            "<polyline points='200,200 250,250 250,250' marker-end='url(#a)'/>",
            45.0,
        ),
    ] {
        assert_directions(outline, &[expected]);
    }
    let middle = "<path d='M300 50L300 150L300 150L350 150' marker-mid='url(#a)'/>";
    assert_directions(middle, &[90.0, 45.0]);
}

#[test]
fn markers_of_closed_outlines_point_between_their_end_and_their_begin() {
    for (outline, expected) in [
        ("<path d='M50 50H150V150H50z' marker-start='url(#a)'/>", 315.0),
        ("<path d='M50 50H150V150H50z' marker-end='url(#a)'/>", 315.0),
        (
            "<polygon points='50,50 150,50 150,150 50,150' marker-end='url(#a)'/>",
            315.0,
        ),
        ("<path d='M50 50H150V150H50V50z' marker-end='url(#a)'/>", 315.0),
        ("<path d='M50 50H150V150H50V50' marker-end='url(#a)'/>", 270.0),
        ("<path d='M50 50H150V150H50V50' marker-start='url(#a)'/>", 0.0),
    ] {
        assert_directions(outline, &[expected]);
    }
}

#[test]
fn arcs_are_one_segment_to_markers() {
    let arcs = "M40 150A60 60 0 1 1 160 150a60 60 0 0 1 90 0L350 150z";
    let dots = places(&format!(
        "<path d='{arcs}m5 5 9 0' marker='none' style='marker-mid:url(#a)'/>"
    ));
    let places: Vec<_> = dots.iter().map(|[x, y, _]| [*x, *y]).collect();
    assert_eq!(places, [[160.0, 150.0], [250.0, 150.0], [350.0, 150.0], [45.0, 155.0]]);
}

#[test]
fn markers_stand_where_the_drawn_line_ends() {
    for data in ["M30 50H100H200", "M30 50H100H200M250 50", "M30 50H100H200m5 5 M1 1 "] {
        let places = places(&format!("<path d='{data}' stroke='blue' marker-end='url(#a)'/>"));
        assert_eq!(places, [[200.0, 50.0, 0.0]], "{data}");
    }
}

#[test]
fn markers_that_are_right_stay_as_they_are() {
    for (outline, expected) in [
        (
            "<g marker-start='url(#a)'><path d='M9 9v5M9 9h5' style='marker-end:url(#a)'/></g>",
            &[90.0, 0.0][..],
        ),
        (
            "<style>.m{marker:url(#a)}</style><path class='m' d='M9 9v5h5'/>",
            &[90.0, 45.0, 0.0],
        ),
        ("<path d='M9 9h5v5' marker-start='none' marker-mid='url(#none)'/>", &[]),
        ("<path d='M9 9h5h-5' marker-mid='url(#a)'/>", &[90.0]),
    ] {
        // The document's own rule reaches into the marker as well.
        assert_directions(outline, expected);
    }
    let fixed = ARROW.replace("id='a'", "id='b'").replace("'auto'", "'30'");
    let reverse = ARROW
        .replace("id='a'", "id='c'")
        .replace("'auto'", "'auto-start-reverse'");
    assert_directions(&format!("{fixed}<path d='M9 9h0v5' marker-start='url(#b)'/>"), &[30.0]);
    let both = "<path d='M9 9h0v5' marker-start='url(#c)' marker-end='url(#c)'/>";
    assert_directions(&format!("{reverse}{both}"), &[270.0, 90.0]);
}
