//! The course's own triangles in drawings: wherever SVG shows something again, they have their colours.

use glam::DVec2;
use rasterscope::color::Rgba;
use rasterscope::scene::{DialectChoice, Paint, PrimitiveKind, Scene};

use crate::support::documents::{kinds, lines, read, svg};

/// A triangle with a red, a green and a blue corner.
const TRIANGLE: &str = "<colortri id='a' points='0 0 10 0 0 10' colors='1 0 0 1 0 1 0 1 0 0 1 1'/>";

/// A PNG of 4 x 2 texels, as a `data:` address.
const PNG: &str = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAQAAAACCAYAAAB/qH1jAAAAEklEQVR4nGP4z8DwHxkzoAsAAA8hD/EEN8afAAAAAElFTkSuQmCC";

fn drawing(body: &str) -> Scene {
    read(&svg("width='100' height='100'", body), DialectChoice::Svg)
}

/// The red corners of all triangles whose corners are red, green and blue.
fn red_corners(scene: &Scene, opacity: f32) -> Vec<DVec2> {
    let expected = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let expected = expected.map(|[r, g, b]| Rgba::opaque(r, g, b).faded(opacity));
    let red = |kind: &PrimitiveKind| match kind {
        PrimitiveKind::Triangle {
            points,
            paint: Paint::Vertex(colors),
        } if *colors == expected => Some(points[0]),
        _ => None,
    };
    kinds(scene).iter().filter_map(red).collect()
}

/// A document as the address of an image.
fn address(document: &str) -> String {
    let bytes = document.bytes().map(|byte| format!("%{byte:02x}"));
    format!("data:image/svg+xml,{}", bytes.collect::<String>())
}

#[test]
fn own_triangles_have_their_colours_wherever_they_are_shown_again() {
    let defined = format!("<defs>{TRIANGLE}</defs>");
    let symbol = format!("<symbol id='s'>{TRIANGLE}</symbol>");
    let marker = format!("<marker id='m' markerUnits='userSpaceOnUse' overflow='visible'>{TRIANGLE}</marker>");
    for (body, opacity, expected) in [
        (
            format!("{TRIANGLE}<use href='#a' x='5' y='6'/>"),
            1.0,
            vec![[0.0, 0.0], [5.0, 6.0]],
        ),
        (
            format!("{defined}<use href='#a' x='5' opacity='.5'/>"),
            0.5,
            vec![[5.0, 0.0]],
        ),
        (
            format!("{defined}<g id='g'><use href='#a' x='5'/></g><use href='#g' y='7'/>"),
            1.0,
            vec![[5.0, 0.0], [5.0, 7.0]],
        ),
        (format!("{symbol}<use href='#s' x='8'/>"), 1.0, vec![[8.0, 0.0]]),
        (
            format!("{marker}<path d='M20 30L40 30' marker-start='url(#m)'/>"),
            1.0,
            vec![[20.0, 30.0]],
        ),
    ] {
        let scene = drawing(&body);
        let expected: Vec<DVec2> = expected.into_iter().map(DVec2::from).collect();
        assert_eq!(red_corners(&scene, opacity), expected, "{body}: {:?}", lines(&scene));
    }
    let body = "<defs><texture texid='t' filename='no.png'/><textri id='a' texid='t' points='0 0 9 0 0 9' uvs='0 0 1 0 0 1'/></defs>\
                <use href='#a'/>";
    let scene = drawing(body);
    assert!(
        matches!(
            kinds(&scene).as_slice(),
            [PrimitiveKind::Triangle {
                paint: Paint::Texture { .. },
                ..
            }]
        ),
        "{:?}",
        kinds(&scene)
    );
}

#[test]
fn what_is_wrong_with_a_triangle_is_told_once_however_often_it_is_shown() {
    let body = "<defs><colortri id='a' points='0 0 10 0' colors='1 0 0 .5 0 1 0 1 0 0 1 1'/></defs>\
                <use href='#a'/><use href='#a' x='9'/><use href='#a' x='18'/>";
    let told = lines(&drawing(body));
    assert_eq!(told.len(), 2, "{told:?}");
    assert!(
        told[0].ends_with("alpha in colors has no effect")
            && told[1].ends_with("points holds 4 numbers; 6 are needed: x y for each corner"),
        "{told:?}"
    );
}

#[test]
fn own_triangles_are_drawn_in_images() {
    let textri = |file: &str| {
        format!(
            "<texture texid='t' filename='{file}'/><textri texid='t' points='0 0 9 0 0 9' uvs='0 0 1 0 0 1' opacity='.5'/>"
        )
    };
    let inner = |body: &str| address(&svg("width='10' height='10'", body));
    let image = |body: &str| {
        format!(
            "<image x='20' width='20' height='20' opacity='.5' href='{}'/>",
            inner(body)
        )
    };
    let scene = drawing(&image(&format!("<path d='M1 1'/>{TRIANGLE}")));
    assert_eq!(red_corners(&scene, 1.0), [DVec2::new(20.0, 0.0)], "{:?}", kinds(&scene));
    assert!(scene.report.is_empty(), "{:?}", lines(&scene));
    let owner = scene.primitives.iter().find(|primitive| {
        matches!(
            primitive.kind,
            PrimitiveKind::Triangle {
                paint: Paint::Vertex(_),
                ..
            }
        )
    });
    let shape = &scene.shapes[owner.expect("the triangle").shape.0 as usize];
    assert_eq!(&*shape.element, "image", "whose it is");
    let scene = drawing(&image(&textri(PNG)));
    let opacity = kinds(&scene).iter().find_map(|kind| match kind {
        PrimitiveKind::Triangle {
            paint: Paint::Texture { opacity, .. },
            ..
        } => Some(*opacity),
        _ => None,
    });
    assert_eq!(opacity, Some(0.5), "{:?}", kinds(&scene));
    assert_eq!(scene.textures.len(), 1, "{:?}", lines(&scene));
    // Documents in images read no other files.
    let scene = drawing(&image(&textri("map.png")));
    let told = lines(&scene);
    assert!(
        matches!(told.as_slice(), [line] if line.contains("in the image: a textri is not drawn")),
        "{told:?}"
    );
    assert!(scene.textures.is_empty(), "nothing was asked for");
}

#[test]
fn style_sheets_select_triangles_by_their_own_names() {
    let textri = "<texture texid='t' filename='no.png'/><textri texid='t' points=' 0 0 9 0 0 9 ' uvs='0 0 1 0 0 1'/>";
    let opacities = |sheet: &str| {
        let body = format!("<style>{sheet}</style><g>{TRIANGLE}</g>{textri}");
        let scene = drawing(&body);
        let opacity = |kind: &PrimitiveKind| match kind {
            PrimitiveKind::Triangle { paint, .. } => match paint {
                Paint::Vertex(colors) => Some(("colortri", colors[0].a)),
                Paint::Texture { opacity, .. } => Some(("textri", *opacity)),
                Paint::Solid(_) => None,
            },
            _ => None,
        };
        let told = lines(&scene).into_iter().filter(|line| !line.contains("no.png"));
        let found: Vec<_> = kinds(&scene).iter().filter_map(opacity).collect();
        (found, told.collect::<Vec<_>>())
    };
    for (sheet, colortri, textri) in [
        ("path, polygon{opacity:.5}", Some(1.0), 1.0),
        ("colortri{opacity:.5}", Some(0.5), 1.0),
        ("g > colortri, .textri{display:none}", None, 1.0),
        ("g + textri{opacity:.5}", Some(1.0), 1.0),
        ("texture + textri{opacity:.25} path{opacity:.5}", Some(1.0), 0.25),
        (
            "#a{opacity:.75} colortri{opacity:.5} textri[texid='t']{opacity:.5}",
            Some(0.75),
            0.5,
        ),
        ("g *{opacity:.5} textri{opacity:1 !important}", Some(0.5), 1.0),
    ] {
        let (found, told) = opacities(sheet);
        let mut expected: Vec<_> = colortri.map(|opacity| ("colortri", opacity)).into_iter().collect();
        expected.push(("textri", textri));
        assert_eq!(found, expected, "{sheet}");
        assert!(told.is_empty(), "{sheet}: {told:?}");
    }
    let (_, told) = opacities("path, polygon, polyline{opacity:.5}");
    assert!(
        matches!(told.as_slice(), [line] if line.contains("hold for colortri and textri, too")),
        "{told:?}"
    );
}

#[test]
fn a_number_without_end_takes_its_triangle_alone() {
    let broken = "\n<colortri points='0 0 0 0 0 nan' colors='0 0 0 1 0 0 0 1 0 0 0 1'/>\
                  \n<colortri points='0 0 9 0 0 9' colors='0 0 0 1 0 -inf 0 1 0 0 0 1'/>\
                  \n<textri points='0 0 9 0 0 9' uvs='0 0 1e39 0 0 1'/>";
    let expected = [
        "2:11: not drawn: points=\"0 0 0 0 0 nan\" holds a number that is not finite; use numbers up to 3.4e38",
        "3:32: not drawn: colors=\"0 0 0 1 0 -inf 0 1 0 0 0 1\" holds a number that is not finite; use numbers up to 3.4e38",
        "4:30: not drawn: uvs=\"0 0 1e39 0 0 1\" holds a number that is too large; use numbers from -3.4e38 to 3.4e38",
    ];
    for dialect in [DialectChoice::Course, DialectChoice::Svg] {
        let scene = read(
            &svg("width='100' height='100'", &format!("{broken}{TRIANGLE}")),
            dialect,
        );
        assert_eq!(lines(&scene), expected, "{dialect:?}");
        assert_eq!(
            red_corners(&scene, 1.0),
            [DVec2::ZERO],
            "{dialect:?}: the other is drawn"
        );
    }
    let image = address(&svg("width='9' height='9'", &format!("{broken}{TRIANGLE}")));
    let scene = drawing(&format!("<image width='9' height='9' href='{image}'/>"));
    assert_eq!(lines(&scene).len(), expected.len(), "{:?}", lines(&scene));
    assert_eq!(red_corners(&scene, 1.0), [DVec2::ZERO], "in an image, too");
}
