//! Documents in the dialect `course`: what becomes of every element and attribute.

use glam::{DVec2, Vec2};
use rasterscope::color::Rgba;
use rasterscope::scene::{Dialect, DialectChoice, Fill, Paint, PrimitiveKind, Scene};

use crate::support::documents::{area, kinds, lines, read, svg, try_read};

fn course(body: &str) -> Scene {
    read(
        &svg("width='100' height='80px' baseProfile='all'", body),
        DialectChoice::Course,
    )
}

fn hairline(ends: [[f64; 2]; 2], color: Rgba) -> PrimitiveKind {
    PrimitiveKind::Hairline {
        ends: ends.map(DVec2::from),
        color,
    }
}

fn solid(points: [[f64; 2]; 3], color: Rgba) -> PrimitiveKind {
    PrimitiveKind::Triangle {
        points: points.map(DVec2::from),
        paint: Paint::Solid(color),
    }
}

const RED: Rgba = Rgba::opaque(1.0, 0.0, 0.0);
const BLUE: Rgba = Rgba::opaque(0.0, 0.0, 1.0);

#[test]
fn course_canvas_is_width_and_height() {
    let scene = course("");
    assert_eq!(scene.canvas, DVec2::new(100.0, 80.0), "as told");
    assert_eq!(scene.dialect, Dialect::Course, "as asked");
    assert!(scene.report.is_empty(), "{:?}", scene.report);
}

#[test]
fn course_tells_of_views_and_units_that_it_does_not_know() {
    let triangle = "<colortri points='0 0 1 0 0 1' colors='1 0 0 1 0 1 0 1 0 0 1 1'/>";
    let cure = "(--dialect svg)";
    for (attributes, canvas, told) in [
        (
            "width='100' height='80px' viewBox='0 0 7 7'",
            [100.0, 80.0],
            vec![format!(
                "viewBox=\"0 0 7 7\" has no effect; the dialect svg scales to it {cure}"
            )],
        ),
        (
            "width='10cm' height='100%'",
            [10.0, 100.0],
            vec![
                format!("width=\"10cm\" is read as 10; the dialect svg reads it as SVG does {cure}"),
                format!("height=\"100%\" is read as 100; the dialect svg reads it as SVG does {cure}"),
            ],
        ),
        (
            "width='1,000' height='8'",
            [1.0, 8.0],
            vec!["width=\"1,000\" is read as 1; write a number alone".to_owned()],
        ),
        // Nothing that would make another picture.
        (
            "width='100px' height='80' viewBox='0,0,100.0,80'",
            [100.0, 80.0],
            vec![],
        ),
        ("width='9' height='9' viewBox='0 0 7'", [9.0, 9.0], vec![]),
    ] {
        let scene = read(&svg(attributes, triangle), DialectChoice::Auto);
        assert_eq!(scene.dialect, Dialect::Course, "{attributes}");
        assert_eq!(scene.canvas, DVec2::from(canvas), "{attributes}");
        let told: Vec<String> = told.iter().map(|line| format!("1:1: {line}")).collect();
        assert_eq!(lines(&scene), told, "{attributes}");
    }
}

#[test]
fn course_line_needs_a_stroke() {
    let scene = course("<line x1='1' y1='2' x2='3' y2='4' stroke='#ff0000' stroke-width='9'/><line x1='1' x2='9'/>");
    assert_eq!(
        kinds(&scene),
        [hairline([[1.0, 2.0], [3.0, 4.0]], RED)],
        "strokes are hairlines"
    );
}

#[test]
fn course_polyline_is_always_stroked_and_never_filled() {
    let scene = course("<polyline points='1,2 3,4 5,6' fill='#ff0000'/><polyline points='0,0 1,1' stroke='none'/>");
    let expected = [
        hairline([[1.0, 2.0], [3.0, 4.0]], Rgba::BLACK),
        hairline([[3.0, 4.0], [5.0, 6.0]], Rgba::BLACK),
    ];
    assert_eq!(kinds(&scene), expected, "open and black");
}

#[test]
fn course_polygon_fill_then_outline() {
    let scene = course("<polygon points='0,0 4,0 4,4' fill='ff0000' stroke='#0000ff' stroke-opacity='.5'/>");
    let blue = BLUE.faded(0.5);
    let expected = [
        solid([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]], RED),
        hairline([[0.0, 0.0], [4.0, 0.0]], blue),
        hairline([[4.0, 0.0], [4.0, 4.0]], blue),
        hairline([[4.0, 4.0], [0.0, 0.0]], blue),
    ];
    assert_eq!(kinds(&scene), expected, "closed outline above the fill");
}

#[test]
fn course_fill_defaults_to_black_and_none_is_nothing() {
    let scene = course("<polygon points='0,0 4,0 4,4'/><polygon points='0,0 4,0 4,4' fill='none'/>");
    assert_eq!(
        kinds(&scene),
        [solid([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]], Rgba::BLACK)],
        "one black triangle"
    );
}

#[test]
fn course_rect_is_a_polygon_and_four_lines() {
    let scene = course("<rect x='1' y='2' width='3' height='4' fill='#ff0000' stroke='#0000ff'/>");
    let [
        PrimitiveKind::Polygon {
            polygon,
            fill: Fill::Solid(RED),
        },
        lines @ ..,
    ] = &kinds(&scene)[..]
    else {
        panic!("first the fill: {:?}", scene.primitives);
    };
    let halves = [
        [[4.0, 2.0], [4.0, 6.0], [1.0, 6.0]],
        [[4.0, 2.0], [1.0, 6.0], [1.0, 2.0]],
    ];
    let triangles = polygon.triangles().expect("few crossings");
    assert_eq!(
        triangles,
        halves.map(|half| half.map(DVec2::from)),
        "cut where the course cuts"
    );
    let expected = [
        hairline([[1.0, 2.0], [4.0, 2.0]], BLUE),
        hairline([[4.0, 2.0], [4.0, 6.0]], BLUE),
        hairline([[4.0, 6.0], [1.0, 6.0]], BLUE),
        hairline([[1.0, 6.0], [1.0, 2.0]], BLUE),
    ];
    assert_eq!(lines, expected, "in this order");
}

#[test]
fn course_rect_without_size_is_a_point() {
    let scene = course("<g transform='translate(10 20)'><rect x='.5' y='2' width='0' height='0' fill='#ff0000'/></g>");
    let at = DVec2::new(10.5, 22.0);
    assert_eq!(
        kinds(&scene),
        [PrimitiveKind::Point { at, color: RED }],
        "in its fill colour"
    );
}

#[test]
fn course_numbers_are_32_bit() {
    let scene = course("<rect x='0.1' y='1e-3px' width='0' height='0'/>");
    let at = DVec2::new(f64::from(0.1_f32), f64::from(0.001_f32));
    assert_eq!(
        kinds(&scene),
        [PrimitiveKind::Point { at, color: Rgba::BLACK }],
        "rounded on the way in"
    );
}

#[test]
fn course_groups_hand_down_the_transform_only() {
    let body = "<g transform='translate(10 0)' fill='#ff0000' style='fill:red'>\
                <g transform='rotate(90)'><polygon points='0,0 4,0 4,4'/></g></g>";
    let scene = course(body);
    let [PrimitiveKind::Triangle { points, paint }] = kinds(&scene)[..] else {
        panic!("one triangle: {:?}", scene.primitives);
    };
    assert_eq!(paint, Paint::Solid(Rgba::BLACK), "fill is not inherited");
    for (found, expected) in points.iter().zip([[10.0, 0.0], [10.0, 4.0], [6.0, 4.0]]) {
        assert!(
            found.abs_diff_eq(DVec2::from(expected), 1e-9),
            "{found}: parent times own"
        );
    }
    assert_eq!(
        lines(&scene),
        ["1:85: fill on <g> has no effect", "1:85: style has no effect"],
        "reported"
    );
}

#[test]
fn course_colortri_and_textri() {
    let body = "<colortri points='0 0 1 0 0 1' colors='1 0 0 .2 0 1 0 1 0 0 1 1'/>\
                <textri texid='t' points='0 0 1 0 0 1' uvs='0 0 1 0 0 2'/>\
                <texture texid='t' filename='no.png'/>";
    let scene = course(body);
    let points = [DVec2::ZERO, DVec2::X, DVec2::Y];
    let colors = [RED, Rgba::opaque(0.0, 1.0, 0.0), BLUE];
    let texture = rasterscope::scene::TextureId(0);
    let uv = [Vec2::ZERO, Vec2::X, Vec2::new(0.0, 2.0)];
    let expected = [
        PrimitiveKind::Triangle {
            points,
            paint: Paint::Vertex(colors),
        },
        PrimitiveKind::Triangle {
            points,
            paint: Paint::Texture {
                texture,
                uv,
                opacity: 1.0,
            },
        },
    ];
    assert_eq!(kinds(&scene), expected, "the a of colours is ignored");
    assert_eq!(scene.textures.len(), 1, "one texture");
    assert_eq!(
        lines(&scene),
        [
            "1:85: alpha in colors has no effect",
            "1:151: texture no.png: there is no such file; a checker is drawn"
        ],
        "reported"
    );
}

#[test]
fn course_incomplete_triangles_are_reported() {
    let scene = course("<colortri points='0 0 1 0' colors='1 0 0 1 1 0 0 1 1 0 0 1'/><textri texid='t'/>");
    assert!(scene.primitives.is_empty(), "nothing to draw");
    let lines = lines(&scene);
    assert!(
        lines[0].ends_with("not drawn: points holds 4 numbers; 6 are needed: x y for each corner"),
        "{lines:?}"
    );
    assert_eq!(lines.len(), 3, "textri lacks points and uvs: {lines:?}");
}

#[test]
fn course_triangles_tell_how_many_numbers_they_need_and_which_attribute_is_meant() {
    let points = "points='0 0 1 0 0 1'";
    for (body, told, drawn) in [
        (
            format!("<colortri {points} colors='1 0 0 0 1 0 0 0 1'/>"),
            "not drawn: colors holds 9 numbers; 12 are needed: r g b a for each corner",
            0,
        ),
        (
            format!("<colortri {points} colors='1 0 0 1 0 1 0 1 0 0 1'/>"),
            "colors holds 11 numbers; 12 are needed: r g b a for each corner",
            1,
        ),
        (
            format!("<colortri {points}/>"),
            "not drawn: colors is missing; 12 numbers are needed: r g b a for each corner",
            0,
        ),
        (
            format!("<colortri {points} colours='1 0 0 1 1 0 0 1 1 0 0 1'/>"),
            "not drawn: colors is missing; write it for colours",
            0,
        ),
        (
            "<colortri pionts='0 0 1 0 0 1' colors='1 0 0 1 1 0 0 1 1 0 0 1'/>".to_owned(),
            "not drawn: points is missing; write it for pionts",
            0,
        ),
        (
            format!("<textri {points} uv='0 0 1 0 0 1'/>"),
            "not drawn: uvs is missing; write it for uv",
            0,
        ),
        (
            format!("<textri {points} uvs='7'/>"),
            "not drawn: uvs holds 1 number; 6 are needed: u v for each corner",
            0,
        ),
    ] {
        let scene = course(&body);
        let lines = lines(&scene);
        assert!(
            matches!(lines.as_slice(), [line] if line.ends_with(&format!(": {told}"))),
            "{body}: {lines:?}"
        );
        assert_eq!(scene.primitives.len(), drawn, "{body}");
    }
}

#[test]
fn course_colors_beyond_one_are_told_once_with_a_cure() {
    let bytes = "<colortri points='0 0 1 0 0 1' colors='255 0 0 255 0 255 0 255 0 0 255 255'/>";
    let scene = course(&[bytes, bytes].concat());
    let lines = lines(&scene);
    assert!(
        matches!(lines.as_slice(), [line] if line.ends_with("divide those that go to 255 by 255")),
        "{lines:?}"
    );
    let colors = PrimitiveKind::Triangle {
        points: [DVec2::ZERO, DVec2::X, DVec2::Y],
        paint: Paint::Vertex([RED, Rgba::opaque(0.0, 1.0, 0.0), BLUE]),
    };
    assert_eq!(kinds(&scene), [colors.clone(), colors], "clamped");
}

#[test]
fn textures_that_are_not_there_are_told_one_by_one() {
    let triangle = |texid: &str| format!("<textri {texid} points='0 0 1 0 0 1' uvs='0 0 1 0 0 1'/>");
    let body = [
        "<texture texid='t' filename='no.png'/>",
        &triangle("texid='T'"),
        &triangle("texid='u'"),
        &triangle("texid='u'"),
        &triangle("texid='t'"),
        &triangle(""),
        "<image width='9' height='9'/>",
    ];
    let cures = [
        "texture T: no <texture> has texid=\"T\", but one has texid=\"t\"; write both alike; a checker is drawn",
        "texture u: no <texture> has texid=\"u\"; give it one of those that are there: t; a checker is drawn",
        "texture no.png: there is no such file; a checker is drawn",
        "texture without a name: its <textri> has no texid; give it one of those that are there: t; a checker is drawn",
        "texture without a name: its <image> names no file; write href=\"FILE.png\" there; a checker is drawn",
    ];
    let scene = course(&body.concat());
    let told = lines(&scene);
    assert_eq!(told.len(), cures.len(), "{told:?}");
    for (line, cure) in told.iter().zip(cures) {
        assert!(line.ends_with(&format!(": {cure}")), "{line}");
    }
    assert_eq!(scene.textures[0].name, "T", "what explanations call it");
    assert_eq!(scene.primitives.len(), 5 + 2, "each is drawn");
    // The course's reader takes a texture without a name for a triangle without one.
    let nameless = course(&["<texture filename='no.png'/>", &triangle("")].concat());
    assert_eq!(nameless.textures[0].name, "no.png", "{:?}", nameless.report);
}

#[test]
fn textures_beyond_the_last_are_checkers_like_those_that_are_missing() {
    let triangles: Vec<String> = (0..4098)
        .map(|i| {
            format!(
                "<texture texid='{i}' filename='{i}.png'/><textri texid='{i}' points='0 0 1 0 0 1' uvs='0 0 1 0 0 1'/>"
            )
        })
        .collect();
    let scene = course(&triangles.concat());
    assert_eq!(scene.primitives.len(), 4098, "all are drawn");
    assert_eq!(scene.textures.len(), 4097, "the last two by one checker");
    assert_eq!(scene.textures[4096].name, "beyond the first 4096");
}

#[test]
fn course_tells_what_it_leaves_out() {
    let body = "<colortri points='0 0 1 0 0 1 7' colors='1 0 0 1 0 1 0 .5 0 0 1 1'/>\
                <polygon points='0,0 4,0 4,4 9' fill='#ff0000'/>\
                <polyline points='0,0 1,1 2' stroke-dasharray='2 1'/>\
                <rect width='4' height='2' rx='1' ry='1'/>\
                <colortri points='0 0 1 0 0' colors='1 0 0 1 1 0 0 1 1 0 0 1'/>";
    let scene = course(body);
    let expected = [
        "1:85: alpha in colors has no effect",
        "1:201: stroke-dasharray has no effect",
        "1:254: rx has no effect",
        "1:254: ry has no effect",
        "1:85: points holds 7 numbers; those after the first 6 have no effect",
        "1:153: points holds 7 numbers; the last one has no partner and is left out",
        "1:201: points holds 5 numbers; the last one has no partner and is left out",
        "1:296: not drawn: points holds 5 numbers; 6 are needed: x y for each corner",
    ];
    assert_eq!(lines(&scene), expected, "each in its line");
    assert_eq!(
        scene.primitives.len(),
        1 + 1 + 1 + 1,
        "what is left is drawn: a triangle, a polygon, a line, a rectangle"
    );
}

#[test]
fn course_forgets_the_alpha_of_textures_and_says_so() {
    let mut png = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut png);
    let pixels = [255, 0, 0, 255, 0, 0, 255, 100];
    image::ImageEncoder::write_image(encoder, &pixels, 2, 1, image::ExtendedColorType::Rgba8).unwrap();
    let bytes: Vec<String> = png.iter().map(|byte| format!("%{byte:02x}")).collect();
    let bytes = bytes.concat();
    let body = format!("<image width='9' height='9' href='data:image/png,{bytes}'/>");
    let told = "transparency has no effect; the dialect svg keeps it (--dialect svg)";
    let course = course(&body);
    assert!(
        matches!(lines(&course).as_slice(), [line] if line.ends_with(told)),
        "{:?}",
        course.report
    );
    assert!(course.textures[0].pyramid.is_opaque(), "as the course has it");
    let svg = read(&svg("width='9' height='9'", &body), DialectChoice::Svg);
    assert!(
        svg.report.is_empty() && !svg.textures[0].pyramid.is_opaque(),
        "{:?}",
        svg.report
    );
}

#[test]
fn auto_says_where_another_reading_is_another_picture() {
    use Dialect::{Course, Svg};
    let size = "width='10' height='10'";
    let boxed = "width='12cm' height='4cm' viewBox='0 0 1200 400'";
    for (attributes, body, taken, other) in [
        (
            size,
            "<line x2='1' stroke='#000000'/><circle r='1'/>",
            Svg,
            Some(Course),
        ),
        (boxed, "<polygon fill='red' points='0 0 1 0 1 1'/>", Svg, Some(Course)),
        (size, "<line x2='1' stroke='#000000'/>", Course, Some(Svg)),
        (
            "width='10' height='10' viewBox='0 0 5 5'",
            "<polygon/>",
            Svg,
            Some(Course),
        ),
        ("width='10' height='10' viewBox='0 0 10 10'", "<polygon/>", Course, None),
        (size, "<polygon fill='#102030' points='0 0 1 0 1 1'/>", Course, None),
        (size, "<colortri/><circle r='1'/><line stroke='#000000'/>", Course, None),
        (size, "<path d='M0 0'/><line stroke='#000000'/>", Svg, None),
        (size, "<circle r='1'/>", Svg, None),
        ("viewBox='0 0 1 1'", "<line stroke='#000000'/>", Svg, None),
    ] {
        let scene = read(&svg(attributes, body), DialectChoice::Auto);
        let found = (scene.dialect, scene.other_reading);
        assert_eq!(found, (taken, other), "<svg {attributes}>{body}");
        let note = scene.reading_note("");
        assert_eq!(note.is_some(), other.is_some(), "told: {note:?}");
    }
    let scene = read(
        &svg(size, "<circle r='1'/><line stroke='#000000'/>"),
        DialectChoice::Auto,
    );
    let note = scene.reading_note(", for a reason").unwrap();
    let expected = "read as svg, for a reason; --dialect course makes another picture of it (course is the simple reader of \
                    a course: rasterscope help pixels)";
    assert_eq!(note, expected, "which, why, and the option for the other");
}

#[test]
fn course_unknown_elements_are_skipped_with_what_they_hold() {
    let scene = course("<circle r='1'/>\n<title>a</title><circle r='2'/><symbol><rect width='1' height='1'/></symbol>");
    assert!(scene.primitives.is_empty(), "nothing known");
    let expected = [
        "1:85: <circle> is not drawn (2 times in all)",
        "2:32: <symbol> is not drawn",
    ];
    assert_eq!(lines(&scene), expected, "counted, at the first place");
}

#[test]
fn a_missing_quotation_mark_is_told_where_its_value_begins() {
    let body = "\n<colortri points='0 0 1 0 0 1 colors='1 0 0 1 0 1 0 1 0 0 1 1'/>";
    let error = try_read(svg("width='9' height='9'", body).as_bytes(), DialectChoice::Auto).expect_err("broken");
    let expected = "test.svg:2:11: no quotation mark stands at the end of this value; repair the XML here";
    assert_eq!(error.to_string(), expected);
}

#[test]
fn course_tells_of_transforms_that_are_miswritten() {
    let body = "<g transform='translate(10'/>\n<g transform='matrix(1 0 0 1 5)'/>\n<g transform='translate(1)'/>";
    let told = lines(&course(body));
    assert!(
        matches!(told.as_slice(), [first, second] if first.ends_with("close its parenthesis") && second.contains("5 numbers, not 6")),
        "{told:?}"
    );
}

#[test]
fn auto_names_the_dialect_that_draws_what_is_left_out() {
    let cure = "1:1: the dialect svg draws what is left out here (--dialect svg)";
    let triangle = |look: &str| format!("<colortri points='0 0 1 0 0 1' colors='1 0 0 .5 0 1 0 1 0 0 1 1' {look}/>");
    for (body, is_told) in [
        (triangle("") + "<circle r='1'/><path d='M0 0'/>", true),
        (triangle("opacity='.5'"), true),
        (triangle("") + "<script/>", false),
        (triangle(""), false),
    ] {
        let document = svg("width='10' height='10'", &body);
        let told = lines(&read(&document, DialectChoice::Auto));
        let cures = told.iter().filter(|line| *line == cure).count();
        assert_eq!(cures, usize::from(is_told), "{body}: {told:?}");
        let told = lines(&read(&document, DialectChoice::Course));
        assert!(told.iter().all(|line| line != cure), "it was chosen: {told:?}");
    }
}

#[test]
fn course_textures_may_be_defined_where_nothing_is_drawn() {
    let textri = "<textri texid='t' points='0 0 1 0 0 1' uvs='0 0 1 0 0 2'/>";
    for (definitions, told) in [
        (
            "<defs><texture texid='t' filename='no.png'/><g><title>t</title></g></defs>",
            false,
        ),
        ("<defs/>", false),
        (
            "<defs><texture texid='t' filename='no.png'/><circle id='c' r='1'/></defs>",
            true,
        ),
    ] {
        let scene = course(&format!("{definitions}{textri}"));
        let skipped: Vec<_> = scene.report.skipped.iter().map(|skipped| &*skipped.name).collect();
        assert_eq!(skipped, vec!["defs"; usize::from(told)], "{definitions}");
        assert_eq!(scene.primitives.len(), 1, "{definitions}");
    }
}

#[test]
fn course_every_shape_knows_its_place() {
    let scene = course("\n  <line id='a' stroke='#000' x2='1'/>\n\t<g>\u{e9}<polygon points='0,0 1,0 1,1'/></g>");
    let places: Vec<String> = scene
        .shapes
        .iter()
        .map(|s| format!("{} {:?} {}", s.element, s.id, s.location))
        .collect();
    assert_eq!(
        places,
        ["line Some(\"a\") 2:3", "polygon None 3:6"],
        "name, id, line:column in characters"
    );
}

#[test]
fn course_concave_polygons_are_filled_exactly() {
    let teeth: Vec<String> = (0..2000).map(|i| format!("{i},{}", 50 * (i % 2))).collect();
    let comb = teeth.join(" ");
    let scene = course(&format!("<polygon points='{comb} 1999,100 0,100'/>"));
    assert!((area(&scene) - 1999.0 * 75.0).abs() < 1e-6, "{}", area(&scene));
}

#[test]
fn auto_leaves_to_svg_what_the_course_reads_otherwise() {
    const UNIT: &str = "<rect width='1' height='1'/>";
    let with = |transform: &str| format!("<g transform='{transform}'>{UNIT}</g>");
    for (root, body, expected) in [
        // The course's own scenes scale their widths like that.
        ("", with("scale(.5)"), Dialect::Course),
        (
            "",
            "<rect width='1' height='1' fill-opacity='40%'/>".to_owned(),
            Dialect::Svg,
        ),
        (
            "",
            "<rect width='1' height='1' fill-opacity='.4'/>".to_owned(),
            Dialect::Course,
        ),
        ("transform='translate(1 2)'", UNIT.to_owned(), Dialect::Svg),
    ] {
        let scene = read(
            &svg(&format!("width='10' height='10' {root}"), &body),
            DialectChoice::Auto,
        );
        assert_eq!(scene.dialect, expected, "<svg {root}>{body}");
    }
}

#[test]
fn auto_finds_the_dialect() {
    let size = "width='10' height='10'";
    for (attributes, body, expected) in [
        (size, "<rect width='1' height='1'/>", Dialect::Course),
        (size, "<circle r='1'/><rect width='0' height='0'/>", Dialect::Course),
        (size, "<circle r='1'/><colortri/>", Dialect::Course),
        (size, "<circle r='1'/><g><textri/></g>", Dialect::Course),
        (size, "<circle r='1'/>", Dialect::Svg),
        (
            size,
            "<title>t</title><desc/><metadata><x/></metadata>",
            Dialect::Course,
        ),
        ("viewBox='0 0 1 1'", "<rect width='1' height='1'/>", Dialect::Svg),
        ("width='100%' height='10'", "<rect width='1' height='1'/>", Dialect::Svg),
        ("width='10px' height='10.5px'", "<g/>", Dialect::Course),
        (
            size,
            "<line stroke='1b1f8a'/><polygon fill='#FF8000' stroke='none'/>",
            Dialect::Course,
        ),
        (size, "<polygon fill='red'/>", Dialect::Svg),
        (size, "<g opacity='.5'><rect width='1' height='1'/></g>", Dialect::Svg),
        (size, "<rect width='50%' height='1'/>", Dialect::Svg),
        (size, "<rect width='1' height='1' x='2em'/>", Dialect::Svg),
        (size, "<rect width='1px' height='1' stroke-width='2'/>", Dialect::Course),
        (size, "<rect width='1' height='1' rx='1'/>", Dialect::Svg),
        (size, "<rect width='1' height='1' clip-path='url(#c)'/>", Dialect::Svg),
        (size, "<image width='1' height='1' href='a.SVG'/>", Dialect::Svg),
        (
            size,
            "<image width='1' height='1' href='data:image/svg+xml,'/>",
            Dialect::Svg,
        ),
        // The course's reader would stretch it.
        (size, "<image width='1' height='1' href='a.png'/>", Dialect::Svg),
        (
            size,
            "<image width='1' height='1' href='a.png'/><colortri/>",
            Dialect::Course,
        ),
        (size, "<colortri opacity='.5'/>", Dialect::Course),
        (size, "<polygon fill='red'/><rect/>", Dialect::Course),
        (size, "<g fill='#fff'><polygon/></g>", Dialect::Svg),
        // To the course's reader each shape has its own paint, and a size of one pixel means the `viewBox`.
        (size, "<g fill='#ff0000'><polygon/></g>", Dialect::Svg),
        ("width='9' height='9' viewBox='0 0 3 3'", "<polygon/>", Dialect::Svg),
        (
            "width='9' height='9' viewBox='0 0 3 3'",
            "<polygon/><rect/>",
            Dialect::Svg,
        ),
        (
            "width='1px' height='1px' viewBox='0 0 3 3'",
            "<polygon/>",
            Dialect::Course,
        ),
        (size, "<circle r='1' style='fill:red'/><rect/>", Dialect::Svg),
        (size, "<line style='stroke: #123456'/>", Dialect::Svg),
        // As other programs write: rects without a size, and icons whose root says how lines look.
        (size, "<path d='M0 0h1v1'/><rect fill='none'/>", Dialect::Svg),
        ("viewBox='0 0 1 1'", "<polygon/><rect fill='none'/>", Dialect::Svg),
        (
            "width='24' height='24' fill='none' stroke='currentColor' class='icon'",
            "<line x1='19' y1='4' x2='10' y2='4'/>",
            Dialect::Svg,
        ),
    ] {
        let scene = read(&svg(attributes, body), DialectChoice::Auto);
        assert_eq!(scene.dialect, expected, "<svg {attributes}>{body}");
    }
}

/// Points are the course's; beside what only SVG means, the other reading is told of.
#[test]
fn points_beside_colours_of_svg_are_not_taken_for_granted() {
    let size = "width='10' height='10'";
    for (body, other) in [
        ("<rect fill='#ff0000'/><line stroke='#000000'/>", None),
        (
            "<rect fill='#fff'/><ellipse rx='3' ry='2' fill='#dae8fc'/>",
            Some(Dialect::Svg),
        ),
    ] {
        let scene = read(&svg(size, body), DialectChoice::Auto);
        assert_eq!((scene.dialect, scene.other_reading), (Dialect::Course, other), "{body}");
    }
}
