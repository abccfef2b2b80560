//! Style sheets and styles in the dialect `svg`, and letters along paths.

use rasterscope::color::Rgba;
use rasterscope::scene::{Fill, Paint, PrimitiveKind, Scene};

use crate::support::documents::{area, kinds, lines, svg_scene};

const RED: Rgba = Rgba::opaque(1.0, 0.0, 0.0);
const BLUE: Rgba = Rgba::opaque(0.0, 0.0, 1.0);

/// The colour of the first thing that is drawn.
fn color(scene: &Scene) -> Rgba {
    let color = kinds(scene).into_iter().find_map(|kind| match kind {
        PrimitiveKind::Triangle {
            paint: Paint::Solid(color),
            ..
        }
        | PrimitiveKind::Polygon {
            fill: Fill::Solid(color),
            ..
        } => Some(color),
        _ => None,
    });
    color.expect("something is drawn")
}

/// The colour of a shape to which a sheet says this, and what is told.
fn styled(sheet: &str) -> (Rgba, Vec<String>) {
    let body = format!("<style{sheet}</style><rect class='an icon' id='r' width='9' height='9' fill='blue'/>");
    let scene = svg_scene(&body);
    (color(&scene), lines(&scene))
}

#[test]
fn selectors_look_at_parts_of_attributes() {
    for (selector, expected) in [
        ("[class^='an i']", RED),
        ("[class$=icon]", RED),
        ("rect[class*=\"n i\"]", RED),
        ("svg > [id^=r][id$=r]", RED),
        ("[class^=icon]", BLUE),
        ("[class$='']", BLUE),
        ("[class*=Icon]", BLUE),
    ] {
        let (color, told) = styled(&format!(">{selector}{{fill:red}} rect{{fill:blue}}"));
        assert_eq!((color, told), (expected, Vec::new()), "{selector}");
    }
    let (color, told) = styled(">[class ^= 'an'] { fill: red }");
    assert!(color == BLUE && told.len() == 1 && told[0].contains("(^=)"), "{told:?}");
}

#[test]
fn the_root_is_selected_by_its_name_or_place() {
    let scene = svg_scene("<style>:root{fill:red} :root > g{stroke:none}</style><g><rect width='9' height='9'/></g>");
    assert_eq!((color(&scene), lines(&scene)), (RED, Vec::new()));
    // Its weight is that of a class.
    let scene =
        svg_scene("<style>:root{fill:red} svg{fill:blue} g g:root{fill:lime}</style><rect width='9' height='9'/>");
    assert_eq!(color(&scene), RED);
}

#[test]
fn rules_for_screens_hold_and_those_for_paper_do_not() {
    for (sheet, expected, told) in [
        (" media='print'>rect{fill:red}", BLUE, 0),
        (" media='print, screen'>rect{fill:red}", RED, 0),
        (" media='(min-width: 5px)'>rect{fill:red}", BLUE, 1),
        (">@media screen, print{rect{fill:red}}", RED, 0),
        (">@media not print{rect{fill:red}}", RED, 0),
        (">@media only screen { rect{fill:red}}", RED, 0),
        (">@media print{rect{fill:red}}", BLUE, 0),
        (">@media (prefers-color-scheme: light){rect{fill:red}}", BLUE, 1),
    ] {
        let (color, lines) = styled(sheet);
        assert_eq!((color, lines.len()), (expected, told), "{sheet}: {lines:?}");
    }
}

#[test]
fn styles_are_read_as_css_writes_them() {
    for style in ["FILL:red", "fill:rgb(255,0,0", "stroke:none;Fill : rgb(255, 0, 0"] {
        let scene = svg_scene(&format!("<rect width='9' height='9' style='{style}'/>"));
        assert_eq!(color(&scene), RED, "{style}");
    }
}

#[test]
fn properties_that_are_not_drawn_are_told_unless_they_change_nothing() {
    for style in [
        "all:unset",
        "clip:rect(0 0 0 0)",
        "d:path(&quot;M0 0H9&quot;)",
        "inline-size:50px",
        "mask-image:url(#m)",
        "rotate:45deg",
        "scale:2",
        "shape-inside:url(#s)",
        "text-transform:uppercase",
        "transform-box:fill-box",
        "translate:5px",
        "white-space:pre",
    ] {
        let name = style.split(':').next().unwrap();
        let told = lines(&svg_scene(&format!("<path d='M0 0H9V9' style='{style}'/>")));
        assert!(told.len() == 1 && told[0].contains(name), "{style}: {told:?}");
        let told = lines(&svg_scene(&format!(
            "<style>path{{{style}}}</style><path d='M0 0H9V9'/>"
        )));
        assert!(
            told.len() == 1 && told[0].contains(name),
            "{style} in a sheet: {told:?}"
        );
    }
    for style in [
        "clip:auto;d:none;rotate:none;scale:1",
        "transform-box:view-box;white-space:normal",
    ] {
        let told = lines(&svg_scene(&format!("<path d='M0 0H9V9' style='{style}'/>")));
        assert_eq!(told, [""; 0], "{style}");
    }
}

#[test]
fn letters_along_paths_are_drawn_or_missed() {
    let text = |path: &str| {
        svg_scene(&format!(
            "<path id='p' d='M0 50h90' fill='none'/><g id='g'/><text y='30'>{path}</text>"
        ))
    };
    let after = area(&text("after"));
    for (path, why) in [
        ("<textPath href='#nope'>abc</textPath>", "no element has the id"),
        ("<textPath href='#g'><tspan>abc</tspan></textPath>", "no outline"),
        ("<textPath href='a.svg#p'>abc</textPath>", "other documents"),
        ("<textPath path='none'>abc</textPath>", "no href"),
    ] {
        let scene = text(&format!("{path}after"));
        let told = lines(&scene);
        assert!(told.len() == 1 && told[0].contains(why), "{path}: {told:?}");
        assert!(
            after > 10.0 && (area(&scene) - after).abs() < 1e-6,
            "{path}: what follows is drawn"
        );
    }
    let referred = area(&text("<textPath href='#p'>abc</textPath>"));
    for path in [
        "<textPath path='M0 50h90'>abc</textPath>",
        "<textPath href='#g' path='M0 50h90'>abc</textPath>",
    ] {
        let scene = text(path);
        assert_eq!(lines(&scene), [""; 0], "{path}");
        assert!(referred > 10.0 && (area(&scene) - referred).abs() < 1e-6, "{path}");
    }
}
