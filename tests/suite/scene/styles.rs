//! Style sheets and styles in the dialect `svg`, and letters along paths.

use rasterscope::color::Rgba;
use rasterscope::scene::{DialectChoice, Fill, Paint, PrimitiveKind, Scene};

use super::svg::bounds;
use crate::support::documents::{area, kinds, lines, read, svg, svg_scene, try_read};

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
        ("[class ^= 'an']", RED),
        ("svg > [id^=r][id$=r]", RED),
        ("[class^=icon]", BLUE),
        ("[class$='']", BLUE),
        ("[class*=Icon]", BLUE),
    ] {
        let (color, told) = styled(&format!(">{selector}{{fill:red}} rect{{fill:blue}}"));
        assert_eq!((color, told), (expected, Vec::new()), "{selector}");
    }
    let (color, told) = styled(">[class^='an' i] { fill: red }");
    assert!(color == BLUE && told.len() == 1 && told[0].contains("(i)"), "{told:?}");
}

#[test]
fn sheets_are_read_as_css_and_xml_write_them() {
    for sheet in [
        ">rect{fill:lime}<!-- c --> rect{fill:red}",
        ">rect{fill:lime}<?x y?> rect{fill:red}",
        ">rect{stroke:none; <!-- off: fill:lime; --> fill:red}",
        ">rect{fill:lime}<!-- a > b { --> rect{fill:red}",
        ">rect{fill:red<![CDATA[}]]>",
        ">rect{fill:r<![CDATA[ed}]]>",
        "><![CDATA[rect{fill:]]>red}",
        ">rect{font-family:\"a}b\";fill:red}",
        ">rect{font-family:'a{b'}rect{fill:red}",
        ">.q::after{content:\"}\"} rect{fill:red}",
        ">rect{font-family:\"a\\\"b\";fill:red}",
        ">rect{font-family:'it\\'s }';fill:red}",
        ">rect{fill:red!IMPORTANT}rect.an{fill:lime}",
        ">rect{fill:re\\64}",
        ">rect{f\\69ll:red}",
        ">.\\61n{fill:red}",
        ">#\\72{fill:red}",
        ">*|rect{fill:red}",
        ">*|*{fill:red}",
        ">@namespace s url(http://www.w3.org/2000/svg);s|rect{fill:red}",
        ">&lt;!-- rect{fill:red} --&gt;",
        " type=''>rect{fill:red}",
        " type='TEXT/CSS'>rect{fill:red}",
        " type='text/css; charset=utf-8'>rect{fill:red}",
    ] {
        let (color, told) = styled(sheet);
        assert_eq!(color, RED, "{sheet}: {told:?}");
        assert!(told.iter().all(|line| line.contains("ypeface")), "{sheet}: {told:?}");
    }
}

#[test]
fn rules_without_effect_are_told_and_leave_those_behind() {
    for sheet in [
        ">rect.b,,rect{fill:red}",
        ">rect,{fill:red}",
        ">rect,.b>{fill:red}",
        ">rect,#{fill:red}",
        ">rect:foo{fill:red}",
        ">rect,rect:foo{fill:red}",
        ">rect,rect[x{fill:red}",
        ">rect,a::nonsense{fill:red}",
        ">@import 'a;b.css'; rect{fill:blue}",
        ">@import url(a.css;x); rect{fill:blue}",
        ">@layer a,b; rect{fill:blue}",
        " type='text/less'>rect{fill:red}",
    ] {
        let (color, told) = styled(sheet);
        assert_eq!((color, told.len()), (BLUE, 1), "{sheet}: {told:?}");
    }
    let told = styled(">rect{x:y}<!-- \n -->\n  rect,a:foo{fill:red}").1;
    assert!(told[0].starts_with("3:3: \"rect,a:foo\" is no selector"), "{told:?}");
}

#[test]
fn words_that_every_property_knows_are_known_in_capitals_too() {
    for look in [
        "style='fill:unset'",
        "style='fill:UNSET'",
        "style='fill:Inherit'",
        "style='fill:revert'",
        "fill='unset'",
        "fill='INHERIT'",
    ] {
        let scene = svg_scene(&format!("<g fill='red'><rect width='9' height='9' {look}/></g>"));
        assert_eq!((color(&scene), lines(&scene)), (RED, Vec::new()), "{look}");
    }
}

#[test]
fn a_pattern_too_fine_for_floats_costs_itself_alone() {
    for side in ["1e-9", "1e-30", "1e-9%"] {
        let scene = svg_scene(&format!(
            "<rect width='9' height='9' fill='red'/>\n<pattern id='p' width='{side}' height='{side}'>\
             <rect width='1' height='1'/></pattern><rect y='30' width='50' height='20' fill='url(#p)'/>"
        ));
        let told = lines(&scene);
        assert!((color(&scene), kinds(&scene).len()) == (RED, 1), "{side}: {told:?}");
        assert!(
            told.len() == 1 && told[0].starts_with("2:1: what the pattern \"p\""),
            "{told:?}"
        );
    }
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
        "backdrop-filter:blur(2px)",
        "color-interpolation:linearRGB",
        "image-orientation:90deg",
        "text-shadow:1px 1px red",
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
        "white-space:pre-line",
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
        "white-space:pre-wrap",
        "backdrop-filter:none;color-interpolation:sRGB;text-shadow:none",
    ] {
        let told = lines(&svg_scene(&format!("<path d='M0 0H9V9' style='{style}'/>")));
        assert_eq!(told, [""; 0], "{style}");
    }
}

#[test]
fn what_a_sheet_says_in_vain_is_told_where_it_stands() {
    let sheet = "<style>\n/* a */ .c:not(.d) { fill: red }\n@import url(a.css);\n .e {\n fill: blu; }\n\
                 .n { rect { fill: red }\n &amp; g { x: y } }</style><rect width='9' height='9'/>";
    let told = lines(&svg_scene(sheet));
    let places: Vec<&str> = told.iter().map(|line| &line[..4]).collect();
    assert_eq!(places, ["2:9:", "3:1:", "6:6:", "5:2:"], "{told:?}");
    assert!(told[2].contains("the rules inside \".n\" have no effect"), "{told:?}");
}

#[test]
fn colours_of_profiles_leave_those_beside_them() {
    for look in [
        "fill='#f00 icc-color(x, 0.1, 0.2)'",
        "style='fill:#f00 icc-color(x,.1);stroke:none'",
        "fill='red icc-color(x'",
        "class='p'",
    ] {
        let body = format!("<style>.p{{fill:red icc-color(a, 1)}}</style><rect width='9' height='9' {look}/>");
        let scene = svg_scene(&body);
        assert_eq!((color(&scene), lines(&scene)), (RED, Vec::new()), "{look}");
    }
}

#[test]
fn what_is_told_of_a_paint_is_told_once() {
    let told = |look: &str| lines(&svg_scene(&format!("<rect width='9' height='9' {look}/>")));
    let both = told("style='fill:url(#q),orange'");
    assert!(both.len() == 1 && both[0].contains("is not understood"), "{both:?}");
    for look in ["fill='url(#nope) green'", "style='fill:url(#nope) green'"] {
        let told = told(look);
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(
            told[0].ends_with("fill refers to #nope, and no element has that id; green is taken"),
            "{told:?}"
        );
    }
}

#[test]
fn backgrounds_of_pages_are_told() {
    use rasterscope::scene::DialectChoice;
    let told = |root: &str, inside: &str| {
        let text = format!("<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9' {root}>{inside}</svg>");
        lines(&read(&text, DialectChoice::Svg))
    };
    for (root, inside, name, color) in [
        ("style='background:#223'", "", "background", "#222233"),
        ("style='background-color: navy'", "", "background-color", "#000080"),
        (
            "",
            "<style>svg{background:linear-gradient(red, lime)}</style>",
            "background",
            "COLOUR",
        ),
    ] {
        let told = told(root, inside);
        let expected = format!("{name} is not drawn; use --background {color}, or a <rect> behind all");
        assert!(told.len() == 1 && told[0].ends_with(&expected), "{told:?}");
    }
    for (root, inside) in [
        ("style='background:white'", ""),
        ("style='background:transparent'", ""),
        ("style='background:none'", ""),
        ("", "<g style='background:red'/>"),
    ] {
        assert_eq!(told(root, inside), [""; 0], "{root}{inside}");
    }
}

#[test]
fn what_clips_nothing_is_told() {
    for (part, expected) in [
        (
            "<g><rect width='5' height='5'/></g>",
            Some("<g> in a clipPath has no effect"),
        ),
        ("<use href='#g'/>", Some("<use> of <g> in a clipPath has no effect")),
        ("<use href='#r'/>", None),
        ("<rect width='5' height='5'/>", None),
    ] {
        let body = format!(
            "<defs><g id='g'><rect id='r' width='5' height='5'/></g></defs><clipPath id='c'>\n{part}</clipPath>\
             <rect width='9' height='9' clip-path='url(#c)'/>"
        );
        let told = lines(&svg_scene(&body));
        let is_told = told
            .iter()
            .any(|line| line.starts_with("2:1: ") && expected.is_some_and(|told| line.contains(told)));
        assert_eq!(is_told, expected.is_some(), "{told:?}");
    }
}

#[test]
fn white_space_is_kept_where_styles_say_so() {
    let width = |around: &str, look: &str| {
        let scene = svg_scene(&format!("<g {around}><text y='30' {look}>a    b</text></g>"));
        assert_eq!(lines(&scene), [""; 0], "{around} {look}");
        bounds(&scene)[2]
    };
    let [narrow, wide] = ["", "xml:space='preserve'"].map(|look| width("", look));
    assert!(narrow < wide, "{narrow} {wide}");
    for (around, look, expected) in [
        ("", "style='white-space: pre'", wide),
        ("", "white-space='pre-wrap'", wide),
        ("style='white-space:break-spaces'", "", wide),
        ("style='white-space:pre'", "style='white-space:normal'", narrow),
        ("", "style='white-space:nowrap' xml:space='preserve'", narrow),
    ] {
        assert!((width(around, look) - expected).abs() < 1e-9, "{around} {look}");
    }
    let scene = svg_scene("<style>.svglite text {white-space: pre;}</style><g class='svglite'><text>a    b</text></g>");
    assert!((bounds(&scene)[2] - wide).abs() < 1e-9, "by a rule");
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

/// Enough shapes for rules to be written into the styles of elements; the first ones are those of `body`.
fn crowded(css: &str, body: &str) -> Scene {
    let rule = |i: usize| format!(".unused{i}{{fill:#{i:06x}}}");
    let rules: String = (0..2_000).map(rule).collect();
    let crowd = "<rect class='crowd' width='0' height='0'/>".repeat(6_000);
    svg_scene(&format!("<style>{css}{rules}</style>{body}<g>{crowd}</g>"))
}

#[test]
fn many_rules_and_shapes_look_as_few_do() {
    let css = "rect { fill: blue; stroke: none } .a { fill: red; marker: none } #i { fill: lime } g > .b { fill: yellow!important } \
               .c { fill: reddish; stroke: green icc-color(x, 1) } .d { font-family: \"A &amp; B\"; stroke-width: 1e39 } \
               g rect + rect { stroke: #123456; stroke-width: 3 } [class='a b'] { opacity: .5 } .e { x: 5px; transform: rotate(45deg) }";
    let size = "width='9' height='9'";
    let body = format!(
        "<rect {size}/><rect class='a' {size}/><rect class='a' id='i' {size}/><path class='c' d='M0 0h9v9z'/>\
         <rect class='a' style='fill: black' {size}/><rect class='a' style=' ' {size}/><rect class='a' style='fill: reddish' {size}/>\
         <g class='d'><rect class='a b' style='fill: red' {size}/><rect class='e' stroke='red' {size}/></g>"
    );
    let few = svg_scene(&format!("<style>{css}</style>{body}"));
    let many = crowded(css, &body);
    assert_eq!(kinds(&many), kinds(&few));
    // The sheets are not of one length.
    let told = |scene: &Scene| -> Vec<String> {
        let lines = lines(scene).into_iter();
        lines
            .filter_map(|line| Some(line.split_once(": ")?.1.to_owned()))
            .collect()
    };
    assert_eq!(told(&many), told(&few));
    assert!(!told(&few).is_empty(), "what is not understood");
}

#[test]
fn hundreds_of_classes_for_a_hundred_thousand_shapes_are_read() {
    let rule = |i: usize| format!(".st{i}{{fill:#{i:06x}}}");
    let rules: String = (0..700).map(rule).collect();
    let shape = |i: usize| format!("<path class='st{}' d='M0 0h1v1z'/>", i % 700);
    let shapes: String = (0..100_000).map(shape).collect();
    let scene = svg_scene(&format!("<style>{rules}</style>{shapes}"));
    assert_eq!(scene.primitives.len(), 100_000);
    assert!(scene.report.is_empty(), "{:?}", lines(&scene));
}

#[test]
fn rules_that_may_be_those_of_every_element_are_bounded() {
    let rules = "* + * > * { fill: red }".repeat(1_000);
    let shapes = "<g><rect width='1' height='1'/></g>".repeat(50_000);
    let document = svg("width='9' height='9'", &format!("<style>{rules}</style>{shapes}"));
    let error = try_read(document.as_bytes(), DialectChoice::Svg)
        .expect_err("too many")
        .to_string();
    assert!(
        error.ends_with("comparisons of elements with style sheets; select by classes and ids, or by fewer rules"),
        "{error}"
    );
}

#[test]
fn words_functions_and_units_count_in_any_case() {
    const GRADIENT: &str =
        "<linearGradient id='G'><stop stop-color='Red'/><stop offset='1' stop-color='BLUE'/></linearGradient>";
    for (other, usual) in [
        ("style='display:None'", "style='display:none'"),
        ("style='FILL:Red'", "fill='red'"),
        ("display='NONE'", "display='none'"),
        (
            "fill='None' stroke='CurrentColor' color='Lime'",
            "fill='none' stroke='lime'",
        ),
        ("fill='URL(#G)'", "fill='url(#G)'"),
        ("style='fill:URL(\"#G\")'", "fill='url(#G)'"),
        (
            "stroke='red' stroke-width='3PX' stroke-linejoin='Round'",
            "stroke='red' stroke-width='3' stroke-linejoin='round'",
        ),
        ("fill='OKLCH(0.5 0.1 140DEG)'", "fill='oklch(0.5 0.1 140deg)'"),
        ("x='.25IN'", "x='24'"),
        ("style='transform:TranslateX(9Px)'", "transform='translate(9)'"),
        ("class='c'", "visibility='hidden'"),
    ] {
        let scene = |attributes: &str| {
            let sheet = "<style>.c{VISIBILITY:Hidden}</style>";
            svg_scene(&format!("{sheet}{GRADIENT}<rect {attributes} width='20' height='30'/>"))
        };
        let [other_scene, usual_scene] = [other, usual].map(scene);
        assert_eq!(kinds(&other_scene), kinds(&usual_scene), "{other}");
        assert_eq!(lines(&other_scene), lines(&usual_scene), "{other}");
    }
    let [middle, start] = ["Middle", "Start"].map(|anchor| {
        svg_scene(&format!(
            "<text x='50' y='50' text-anchor='{anchor}' font-family='Hack'>A</text>"
        ))
    });
    assert_ne!(kinds(&middle), kinds(&start), "anchors");
    let course = read(
        &svg("width='20' height='20'", "<rect width='9' height='9' fill='None'/>"),
        DialectChoice::Course,
    );
    assert!(!kinds(&course).is_empty(), "the course knows small letters only");
}

#[test]
fn places_are_those_of_the_document_in_another_case() {
    let scene = svg_scene("\n<rect fill='None' width='9' height='9'/>\n<rect mask='Nowhere' width='9' height='9'/>");
    let told = lines(&scene);
    assert!(told.len() == 1 && told[0].starts_with("3:"), "{told:?}");
}
