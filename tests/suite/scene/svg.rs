//! Documents in the dialect `svg`.

use glam::{DVec2, Vec2};
use rasterscope::color::Rgba;
use rasterscope::scene::{Composite, DialectChoice, Fill, MaskKind, Paint, PrimitiveKind, Scene};

use crate::support::documents::{area, kinds, lines, read, svg, svg_scene, try_read};

/// Area and colour of a scene in one colour.
fn filled(body: &str) -> (f64, Rgba) {
    let scene = svg_scene(body);
    let color = |kind: &PrimitiveKind| match kind {
        PrimitiveKind::Triangle {
            paint: Paint::Solid(color),
            ..
        }
        | PrimitiveKind::Polygon {
            fill: Fill::Solid(color),
            ..
        } => *color,
        other => panic!("{body}: {other:?}"),
    };
    let colors: Vec<Rgba> = scene.primitives.iter().map(|p| color(&p.kind)).collect();
    assert!(
        colors.windows(2).all(|pair| pair[0] == pair[1]),
        "{body}: one colour, not {colors:?}"
    );
    (area(&scene), colors.first().copied().unwrap_or(Rgba::TRANSPARENT))
}

/// The smallest box around all triangles and polygons: left, top, right, bottom.
pub(super) fn bounds(scene: &Scene) -> [f64; 4] {
    let mut low = DVec2::INFINITY;
    let mut high = DVec2::NEG_INFINITY;
    for kind in kinds(scene) {
        let points = match &kind {
            PrimitiveKind::Triangle { points, .. } => points.as_slice(),
            PrimitiveKind::Polygon { polygon, .. } => polygon.points(),
            _ => &[],
        };
        for point in points {
            low = low.min(*point);
            high = high.max(*point);
        }
    }
    [low.x, low.y, high.x, high.y]
}

fn assert_near(found: &[f64], expected: &[f64], what: &str) {
    // Coordinates come as 32-bit floats.
    let near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 2e-5);
    assert!(near, "{what}: {found:?}, not {expected:?}");
}

const RED: Rgba = Rgba::opaque(1.0, 0.0, 0.0);
const BLUE: Rgba = Rgba::opaque(0.0, 0.0, 1.0);
const UNIT: &str = "width='10' height='10'";

#[test]
fn svg_canvas_and_view_box() {
    let rect = "<rect x='10' y='20' width='30' height='10'/>";
    for (attributes, canvas, expected) in [
        ("width='100' height='50'", [100.0, 50.0], [10.0, 20.0, 40.0, 30.0]),
        ("viewBox='0 0 100 50'", [100.0, 50.0], [10.0, 20.0, 40.0, 30.0]),
        ("viewBox='10 20 30 10'", [30.0, 10.0], [0.0, 0.0, 30.0, 10.0]),
        (
            "width='60' height='60' viewBox='10 20 30 10'",
            [60.0, 60.0],
            [0.0, 20.0, 60.0, 40.0],
        ),
        (
            "width='1in' height='72pt' viewBox='10 20 30 10' preserveAspectRatio='none'",
            [96.0; 2],
            [0.0, 0.0, 96.0, 96.0],
        ),
        (
            "width='60' height='60' viewBox='10 20 30 10' preserveAspectRatio='xMinYMin slice'",
            [60.0; 2],
            [0.0, 0.0, 180.0, 60.0],
        ),
        (
            "width='50%' viewBox='0 0 100 50'",
            [50.0, 25.0],
            [5.0, 10.0, 20.0, 15.0],
        ),
    ] {
        let scene = read(&svg(attributes, rect), DialectChoice::Svg);
        assert_eq!(scene.canvas, DVec2::from(canvas), "{attributes}");
        assert_near(&bounds(&scene), &expected, attributes);
    }
}

#[test]
fn svg_nested_viewport() {
    let port = "<svg x='10' y='20' width='50%' height='40' viewBox='0 0 5 4'>";
    let scene = svg_scene(&format!("{port}<rect width='100%' height='1'/></svg>"));
    assert_near(
        &bounds(&scene),
        &[10.0, 20.0, 60.0, 30.0],
        "the inner viewBox counts, and nothing is to be clipped",
    );
    let scene = svg_scene(&format!("{port}<rect width='100%' height='1'/><circle r='1'/></svg>"));
    let circle = std::f64::consts::PI * 100.0;
    assert!(
        (area(&scene) - 500.0 - circle - 2000.0).abs() < 1.0,
        "the port clips: {}",
        area(&scene)
    );
}

#[test]
fn svg_style_from_attribute_declaration_and_parent() {
    for (body, color) in [
        (format!("<rect {UNIT}/>"), Rgba::BLACK),
        (format!("<rect {UNIT} fill='red'/>"), RED),
        (format!("<rect {UNIT} fill='blue' style='fill: red'/>"), RED),
        (format!("<g fill='red'><rect {UNIT}/></g>"), RED),
        (
            format!("<g fill='blue'><g style='fill:#f00;'><rect {UNIT}/></g></g>"),
            RED,
        ),
        (format!("<g fill='red'><rect {UNIT} fill='inherit'/></g>"), RED),
        (format!("<g color='red'><rect {UNIT} fill='currentColor'/></g>"), RED),
        (
            format!("<g color='blue' fill='currentColor'><rect {UNIT} color='red'/></g>"),
            RED,
        ),
        (format!("<rect {UNIT} fill='red' fill-opacity='50%'/>"), RED.faded(0.5)),
        (
            format!("<rect {UNIT} fill='red' opacity='0.5' fill-opacity='.5'/>"),
            RED.faded(0.25),
        ),
        (
            format!("<g fill-opacity='.5'><rect {UNIT} fill='hsl(0,100%,50%)'/></g>"),
            RED.faded(0.5),
        ),
    ] {
        let (area, found) = filled(&body);
        assert_eq!(found, color, "{body}");
        assert_near(&[area], &[100.0], &body);
    }
}

#[test]
fn svg_invisible_things_are_not_drawn() {
    for body in [
        format!("<rect {UNIT} fill='none'/>"),
        format!("<rect {UNIT} visibility='hidden'/>"),
        format!("<g display='none'><rect {UNIT}/><circle r='1'/></g>"),
        format!("<g opacity='0'><rect {UNIT}/></g>"),
        format!("<defs><rect {UNIT}/></defs><symbol><rect {UNIT}/></symbol>"),
        format!("<rect {UNIT} style='display:none' mask='none'/>"),
        "<rect width='0' height='10' stroke='red'/>".to_owned(),
        "<g opacity='.5'><g/></g>".to_owned(),
    ] {
        let scene = svg_scene(&body);
        assert!(scene.primitives.is_empty(), "{body}: {:?}", scene.primitives);
        assert!(scene.report.is_empty(), "{body}: {:?}", scene.report);
    }
    let (area, _) = filled(&format!(
        "<g visibility='hidden'><rect {UNIT} visibility='visible'/></g>"
    ));
    assert_near(&[area], &[100.0], "a visible child of a hidden parent");
}

#[test]
fn svg_empty_ids_are_none() {
    for id in ["''", "' '", "\"\"", "'' xml:id='a'", "'&#10;'"] {
        let body = format!(
            "<svg id={id}><g id={id}><rect id={id} {UNIT} fill='red'/><text id={id}></text></g></svg><use id={id} href='#b'/>"
        );
        assert_eq!(filled(&body), (100.0, RED), "{id}");
    }
}

#[test]
fn svg_shapes_have_their_areas() {
    let star = "points='10,0 16,19 0,7 20,7 4,19'";
    let round = std::f64::consts::PI;
    for (body, expected) in [
        ("<polygon points='0,0 10,0 10,10 0,10'/>".to_owned(), 100.0),
        ("<polyline points='0,0 10,0 10,10 0,10'/>".to_owned(), 100.0),
        ("<line x2='10' y2='10'/>".to_owned(), 0.0),
        ("<line x2='10' stroke='red' stroke-width='3'/>".to_owned(), 30.0),
        (
            "<g stroke-width='10%'><line x2='10' stroke='red'/></g>".to_owned(),
            100.0,
        ),
        (
            "<g font-size='5'><line x2='10' stroke='red' stroke-width='2em'/></g>".to_owned(),
            100.0,
        ),
        (
            "<line x2='10' stroke='red' stroke-width='3' transform='scale(1 2)'/>".to_owned(),
            60.0,
        ),
        (
            "<line x2='10' stroke='red' stroke-width='3' transform='scale(2 1)'/>".to_owned(),
            60.0,
        ),
        (
            "<line x2='10' stroke='red' stroke-width='2' stroke-linecap='round'/>".to_owned(),
            20.0 + round,
        ),
        (
            "<rect width='10' height='10' fill='none' stroke='red' stroke-width='2'/>".to_owned(),
            80.0,
        ),
        (
            "<polyline points='0,0 10,0 10,10' fill='none' stroke='red' stroke-linejoin='bevel' stroke-width='2'/>"
                .to_owned(),
            39.5,
        ),
        ("<rect width='10' height='10' rx='5'/>".to_owned(), 25.0 * round),
        ("<rect width='20' height='10' rx='50' ry='5'/>".to_owned(), 50.0 * round),
    ] {
        let (found, _) = filled(&body);
        // Edges lie within a tenth of a sample, 0.0024 units, of the curves.
        assert!((found - expected).abs() < 0.1, "{body}: {found}, not {expected}");
    }
    let whole = filled(&format!("<polygon {star}/>")).0;
    let arms = filled(&format!("<polygon {star} style='fill-rule:evenodd'/>")).0;
    assert!(
        arms < whole - 10.0,
        "the heart of the star is empty: {arms} and {whole}"
    );
}

#[test]
fn svg_opacity_layers_where_things_overlap() {
    let both = svg_scene(&format!("<rect {UNIT} fill='red' stroke='blue' opacity='.5'/>"));
    let kinds_of_both = kinds(&both);
    assert_eq!(
        kinds_of_both.first(),
        Some(&PrimitiveKind::BeginLayer),
        "fill and stroke overlap"
    );
    assert_eq!(
        kinds_of_both.last(),
        Some(&PrimitiveKind::EndLayer {
            composite: Composite::over(0.5)
        }),
        "the shape's opacity"
    );
    let group = svg_scene(&format!(
        "<g opacity='.5'><rect {UNIT} fill='red'/><rect {UNIT} fill='blue'/></g>"
    ));
    let solid = |kind: &PrimitiveKind| match kind {
        PrimitiveKind::Polygon {
            fill: Fill::Solid(color),
            ..
        } => Some(*color),
        _ => None,
    };
    let colors: Vec<Rgba> = kinds(&group).iter().filter_map(solid).collect();
    assert_eq!(colors, [RED, BLUE], "opaque inside the layer");
    assert_eq!(kinds(&group).len(), 4, "one layer around both");
}

#[test]
fn svg_reports_what_it_does_not_draw() {
    let body = "<foreignObject/><rect width='1' height='1' fill='url(#g) red' filter='url(#f)' clip-path='none'/>\
                <filter id='f'><feOffset/></filter><line stroke='red' style='vector-effect: fixed-position'/>\
                <script>1</script><rect><animate/></rect><x:y xmlns:x='urn:x'/><metadata/>\
                <switch><foreignObject/><g/></switch><g display='none'><audio/></g>";
    let scene = svg_scene(body);
    let what: Vec<&str> = scene.report.skipped.iter().map(|skipped| &*skipped.name).collect();
    let expected = ["foreignObject", "filter", "vector-effect", "script", "animate"];
    assert_eq!(what, expected, "in order");
    let with_filter =
        filled("<rect width='1' height='1' fill='red' filter='url(#f)'/><filter id='f'><feOffset/></filter>");
    assert_eq!(with_filter, (1.0, RED), "drawn without it");
    assert_eq!(
        filled("<rect width='1' height='1' fill='url(#g) red'/>").1,
        RED,
        "the fallback is drawn"
    );
    let elsewhere = svg_scene("<use href='other.svg#a'/><use href='#nobody'/><use href='#a'/><g id='a'/>");
    assert_eq!(lines(&elsewhere).len(), 2, "{:?}", lines(&elsewhere));
}

#[test]
fn svg_tells_references_to_what_is_not_there() {
    const RECT: &str = "<rect width='8' height='4' ";
    for (look, property) in [
        ("fill='url(#no)'", "fill"),
        ("style='stroke: url(\"#no\")'", "stroke"),
        ("clip-path='url(#no)'", "clip-path"),
        ("mask='url(#no)'", "mask"),
        ("class='a'", "clip-path"),
    ] {
        let scene = svg_scene(&format!("<style>.a {{ clip-path: url(#no) }}</style>{RECT}{look}/>"));
        let told = lines(&scene);
        let expected = format!("{property} refers to #no, and no element has that id");
        assert!(told.len() == 1 && told[0].contains(&expected), "{look}: {told:?}");
    }
    let arrow = svg_scene("<path d='M0 0h9' marker-end='url(#no)'/><linearGradient id='g' href='#no'/>");
    assert_eq!(lines(&arrow).len(), 2, "{:?}", lines(&arrow));
    let there = svg_scene(&format!(
        "{RECT} clip-path='url(#c)'/><clipPath id='c'>{RECT}/></clipPath>"
    ));
    assert_eq!(lines(&there), [""; 0], "nothing is to be told");
}

#[test]
fn svg_numbers_may_stand_between_white_space() {
    let plain = filled("<rect width='8' height='4' fill='red'/>");
    for spaced in [
        "<rect width='8 ' height=' 4' fill='red'/>",
        "<rect width='\n8' height='4\t' opacity=' 1 ' fill='red'/>",
        "<rect x=' 10 ' width=' 8 ' height=' 4 ' fill-opacity=' 100% ' fill='red'/>",
    ] {
        assert_eq!(filled(spaced), plain, "{spaced:?}");
    }
    let scene = svg_scene("<circle cx=' 20 ' cy='10' r=' 5 '/>");
    assert_near(&bounds(&scene), &[15.0, 5.0, 25.0, 15.0], "a disc in its place");
    assert_eq!(lines(&scene), [""; 0], "nothing is to be told");
}

#[test]
fn svg_tells_what_it_passes_over() {
    const RECT: &str = "<rect width='8' height='4' fill='red' ";
    for (look, told) in [
        ("style='mix-blend-mode: plus-lighter'", "plus-lighter"),
        ("style='mix-blend-mode: multiply'", ""),
        ("pathLength='10' stroke-dasharray='1'", "pathLength"),
        ("pathLength='10'", ""),
        ("style='font-variant: small-caps'", "font-variant"),
        ("direction='rtl'", "direction"),
        ("direction='ltr' font-variant='normal'", ""),
        ("text-orientation='upright'", "text-orientation"),
        ("stroke-linejoin='arcs'", "stroke-linejoin"),
        ("stroke-linejoin='bevel'", ""),
        ("style='glyph-orientation-vertical: 0'", "glyph-orientation-vertical"),
        ("text-orientation='mixed'", ""),
    ] {
        let found = lines(&svg_scene(&format!("{RECT}{look}/>")));
        assert_eq!(found.len(), usize::from(!told.is_empty()), "{look}: {found:?}");
        assert!(found.iter().all(|line| line.contains(told)), "{look}: {found:?}");
    }
}

#[test]
fn svg_filters_that_are_not_there_hide_nothing() {
    for missing in ["url(#zz)", " url('#zz') "] {
        let body = format!("<rect width='8' height='4' fill='red' filter=\"{missing}\"/>");
        assert_eq!(filled(&body), (32.0, RED), "{body}");
        assert_eq!(lines(&svg_scene(&body)).len(), 1, "it is told: {body}");
    }
    // One without effects makes nothing of everything, as SVG wants it.
    for reference in ["url(#f)", "url('#f')", "url( \"#f\" )"] {
        let reference = reference.replace('"', "&quot;");
        let body = format!("<filter id='f'/><rect width='8' height='4' filter=\"{reference}\"/>");
        let empty = svg_scene(&body);
        assert_eq!(kinds(&empty).len(), 0, "nothing is drawn: {body}");
        assert_eq!(lines(&empty), [""; 0], "nor told: {body}");
    }
}

#[test]
fn svg_styles_count_as_css_has_it() {
    const RECT: &str = "<rect class='a b' id='c' width='8' height='4'";
    let lime = Rgba::opaque(0.0, 1.0, 0.0);
    for (sheet, style) in [
        // The last important declaration counts, by weight and then by place.
        (".a{fill:red !important} .b{fill:lime!important}", ""),
        ("#c{fill:lime ! important} .b{fill:red !important}", "style='fill:blue'"),
        (".a{fill:red !important}", "style='fill:lime !important'"),
        (".a{fill:red!important;fill:lime!important}", ""),
        (".a{fill:lime !important;fill:red}", "style=''"),
        // What cannot be read goes alone.
        (".a{;fill:lime}", ""),
        (".a{aspect-ratio:1/1;stroke:;fill:lime}", ""),
        ("", "style='undefined;fill:lime'"),
        // Filters that are not there are none, wherever they are named.
        (".a{filter:url(#gone);fill:lime}", ""),
        ("", "style='filter:url(#gone);fill:lime'"),
        // Lengths and transforms count in styles, too.
        (".a{width:4px;height:8px;fill:lime}", ""),
        (
            "",
            "style='width:16px;height:2px;fill:lime;transform:translate(1mm,2px) rotate(90deg)'",
        ),
    ] {
        let body = format!("<style>{sheet}</style>{RECT} {style}/>");
        assert_eq!(filled(&body), (32.0, lime), "{body}");
    }
    let moved =
        svg_scene("<style>.a{transform:translateX(5px) scaleY(2)}</style><rect class='a' width='8' height='4'/>");
    assert_near(&bounds(&moved), &[5.0, 0.0, 13.0, 8.0], "by a rule");
    assert_eq!(lines(&moved), [""; 0], "which is not told");
}

#[test]
fn svg_tells_nothing_of_what_nobody_misses() {
    for body in [
        "<text font-family='sans-serif, Nonexistent'>a</text>",
        "<text font-family='Nonexistent, sans-serif'>a</text>",
        "<image visibility='hidden' width='9' height='9'/>",
        "<view id='v' viewBox='0 0 5 5'/><cursor/>",
    ] {
        assert_eq!(lines(&svg_scene(body)), [""; 0], "{body}");
    }
    let missing = lines(&svg_scene("<text font-family='Nonexistent, Gone'>a</text>"));
    assert!(missing.len() == 1 && missing[0].contains("Nonexistent"), "{missing:?}");
}

#[test]
fn svg_rules_in_vain_are_told_where_they_are_meant() {
    for (declaration, told) in [
        ("transform:translate(5%)", "transform"),
        ("filter:url(#f)", "filter"),
        ("clip-path:circle(5px)", "clip-path"),
        ("stroke-width:calc(1px + 2px)", "stroke-width"),
        ("opacity:foo", "opacity"),
        ("animation:in 1s", "animation"),
        ("animation:0s ease 0s 1 normal none running none", ""),
        ("fill-opacity:.5", ""),
    ] {
        let of = |class: &str| {
            let body = format!(
                "<style>.a{{{declaration}}}</style><filter id='f'><feOffset/></filter>\
                 <path class='{class}' stroke='red' d='M0 0H9V9'/>"
            );
            lines(&svg_scene(&body))
        };
        let found = of("a");
        assert_eq!(found.len(), usize::from(!told.is_empty()), "{declaration}: {found:?}");
        assert!(found.iter().all(|line| line.contains(told)), "{declaration}: {found:?}");
        assert_eq!(of("b"), [""; 0], "it is for nothing");
    }
}

#[test]
fn svg_patterns_take_nothing_from_what_is_around_them() {
    // In the tile a layer that turns out to hold nothing is taken back.
    let scene = svg_scene(
        "<clipPath id='c'/><pattern id='p' width='4' height='4' patternUnits='userSpaceOnUse'>\
         <g clip-path='url(#c)'><circle r='2'/></g><circle r='3'/></pattern>\
         <circle cx='20' cy='20' r='9' fill='red'/><circle cx='60' cy='60' r='9' fill='url(#p)'/>",
    );
    assert_eq!(kinds(&scene).len(), 2, "both discs");
    assert_near(&bounds(&scene), &[11.0, 11.0, 69.0, 69.0], "with their edges");
}

#[test]
fn svg_masks_that_a_filter_whitens_count_by_their_opacity() {
    let mask = |values: &str| {
        svg_scene(&format!(
            "<filter id='f' x='0%' y='0%' width='100%' height='100%'>\
             <feColorMatrix type='matrix' in='SourceGraphic' values='{values}'/></filter>\
             <mask id='m'><g filter='url(#f)'><rect width='60' height='60' style='fill-opacity:0.5'/></g></mask>\
             <g mask='url(#m)'><circle cx='30' cy='30' r='25' fill='red'/></g>"
        ))
    };
    let kind = |scene: &Scene| {
        kinds(scene).iter().find_map(|kind| match kind {
            PrimitiveKind::EndLayer {
                composite: Composite::Mask(kind),
            } => Some(*kind),
            _ => None,
        })
    };
    let of_cairo = mask("0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0");
    assert_eq!(kind(&of_cairo), Some(MaskKind::Alpha), "black, but whitened");
    assert!(of_cairo.report.is_empty(), "{:?}", lines(&of_cairo));
    let other = mask("0 0 0 0 1 0 0 0 0 0 0 0 0 0 1 0 0 0 1 0");
    assert_eq!(kind(&other), Some(MaskKind::Luminance), "another colour");
    assert_eq!(lines(&other).len(), 1, "a filter without effect is told");
}

#[test]
fn svg_nonsense_is_ignored_with_a_warning() {
    for (body, warning) in [
        (
            "<rect width='1' height='1' fill='reddish'/>",
            "fill=\"reddish\" is not understood and has no effect",
        ),
        (
            "<rect width='1' height='1' transform='spin(2)'/>",
            "transform=\"spin(2)\" is not understood and has no effect",
        ),
        (
            "<style>rect, g { stroke: reddish }</style><rect width='1' height='1'/>",
            "stroke=\"reddish\" is not understood and has no effect",
        ),
        (
            "<style>rect:not(.a) { fill: red }</style><rect width='1' height='1'/>",
            "the selector \"rect:not(.a)\" is not understood (:not); its rule has no effect",
        ),
        (
            "<rect width='1' height='1' x='left'/>",
            "x=\"left\" is not understood and has no effect",
        ),
        (
            "<rect width='1' height='1' stroke-linecap='pointed'/>",
            "stroke-linecap=\"pointed\" is not understood and has no effect",
        ),
        (
            "<polygon points='0,0 1,0 1,1 2'/>",
            "points holds an odd number of coordinates; the last has no effect",
        ),
        (
            "<polygon points='0,0 1,0 1,1 x,y'/>",
            "points=\"0,0 1,0 1,1 x,y\" is not understood after 3 points; it is drawn up to there",
        ),
        ("<image width='1' height='1'/>", "not drawn: it has no href"),
        (
            "<rect width='1' height='1' style='clip-path: circle(40%)'/>",
            "clip-path=\"circle(40%)\" is not understood and has no effect",
        ),
        (
            "<rect width='1' height='1' rx='1' style='rx: 1px; ry: 99999999px'/>",
            "ry has no effect in a style; write it as an attribute",
        ),
        (
            "<style>@media (width) { rect { fill: red } } @media print { rect { fill: none } }</style>",
            "the rules inside \"@media (width)\" have no effect; whether such conditions hold is not looked at",
        ),
        (
            "<style>@import url('a.css');</style>",
            "\"@import url('a.css')\" has no effect; other style sheets are not fetched",
        ),
    ] {
        let scene = svg_scene(body);
        let lines = lines(&scene);
        assert_eq!(lines.len(), 1, "{body}: {lines:?}");
        assert!(lines[0].ends_with(warning), "{body}: {lines:?}");
    }
}

#[test]
fn svg_outlines_are_drawn_as_far_as_they_are_understood() {
    for (body, warning) in [
        (
            "<polygon points='x,y 1,0'/>",
            "points=\"x,y 1,0\" is not understood and has no effect",
        ),
        (
            "<path d='M0 0L5 0L5 5X L0 5'/>",
            "d=\"M0 0L5 0L5 5X L0 5\" is not understood after 3 segments; it is drawn up to there",
        ),
        (
            "<path d='M0 0h9' stroke='red' stroke-dasharray=' 2 foo '/>",
            "stroke-dasharray=\"2 foo\" is not understood and has no effect",
        ),
        (
            "<style>path { stroke-dasharray: 2 foo }</style><path d='M0 0h9' stroke='red'/>",
            "stroke-dasharray=\"2 foo\" is not understood and has no effect",
        ),
    ] {
        let told = lines(&svg_scene(body));
        assert!(told.len() == 1 && told[0].ends_with(warning), "{body}: {told:?}");
    }
    let solid = kinds(&svg_scene("<path d='M0 0h9' stroke='red'/>"));
    for dashes in [
        "stroke-dasharray='2 foo'",
        "style='stroke-dasharray:2 foo'",
        "stroke-dasharray=' foo\n'",
    ] {
        let dashed = svg_scene(&format!("<path d='M0 0h9' stroke='red' {dashes}/>"));
        assert_eq!(kinds(&dashed), solid, "{dashes}");
    }
}

#[test]
fn svg_colors_that_nobody_understands_let_others_through() {
    let shape = "width='9' height='9' transform='rotate(3)'";
    for (body, plain) in [
        // As draw.io writes it: for what knows no `light-dark`, the attribute has the colour.
        (
            "<rect fill='#fc9' style='fill: light-dark(#fc9, #663600); stroke: light-dark(rgb(1, 2, 3), red)' SHAPE/>",
            "<rect fill='#fc9' stroke='#010203' SHAPE/>",
        ),
        (
            "<rect fill='var(--fill-0, #D9D9D9)' SHAPE/>",
            "<rect fill='#D9D9D9' SHAPE/>",
        ),
        (
            "<rect fill='lime' style='fill: color(rec2020 1 0 0)' SHAPE/>",
            "<rect fill='lime' SHAPE/>",
        ),
        ("<rect unread-fill='1' fill='reddish' SHAPE/>", "<rect SHAPE/>"),
        (
            "<rect fill='lime' style='fill: oklch(51.975% 0.17686 142.495); stroke: color(srgb 1 0.5 0 / 50%)' SHAPE/>",
            "<rect fill='#008000' stroke='#ff800080' SHAPE/>",
        ),
        (
            "<g color='lime'><rect fill='currentcolor' stroke='rebeccapurple' SHAPE/></g>",
            "<g color='lime'><rect fill='currentColor' stroke='#663399' SHAPE/></g>",
        ),
        (
            "<g style='--main: rgb(255, 0, 0)'><rect fill='var(--main, lime)' SHAPE/></g>",
            "<g><rect fill='#f00' SHAPE/></g>",
        ),
        (
            "<g fill='lime'><rect fill='reddish' SHAPE/></g>",
            "<g fill='lime'><rect SHAPE/></g>",
        ),
        (
            "<style>rect { fill: reddish; stroke: red }</style><rect fill='lime' SHAPE/>",
            "<rect fill='lime' stroke='red' SHAPE/>",
        ),
        (
            "<rect style='filter: drop-shadow(0 0 2px rgb(0 0 0 / 40%)); --size: 3; fill: lime' SHAPE/>",
            "<rect fill='lime' SHAPE/>",
        ),
        (
            "<style>:root { --main: lime } rect { fill: var(--main) }</style><rect SHAPE/>",
            "<rect fill='lime' SHAPE/>",
        ),
    ] {
        let [body, plain] = [body, plain].map(|body| svg_scene(&body.replace("SHAPE", shape)));
        assert_eq!(kinds(&body), kinds(&plain), "{:?}", lines(&body));
    }
}

#[test]
fn long_style_sheets_are_read_in_pieces() {
    let rule = |i: usize| format!(".c{i} {{ fill: #{i:06x}; stroke: none }} /* }} */\n");
    let rules: String = (0..20_000).map(rule).collect();
    let shapes = "<rect class='c7' width='9' height='9'/><rect class='c19999' width='9' height='9'/>";
    let plain = "<rect fill='#000007' width='9' height='9'/><rect fill='#004e1f' width='9' height='9'/>";
    let plain = svg_scene(plain);
    for sheet in [
        format!("<style>{rules}</style>"),
        format!("<style type='text/css'><![CDATA[{rules}]]></style>"),
    ] {
        let scene = svg_scene(&format!("{sheet}{shapes}"));
        assert_eq!(kinds(&scene), kinds(&plain), "{:?}", lines(&scene));
    }
}

/// A drawing that looks as a plain one does, and one line about it.
#[track_caller]
fn assert_drawn_and_told(body: &str, plain: &str, told: &str) {
    let scene = svg_scene(body);
    let lines = lines(&scene);
    assert!(lines.len() == 1 && lines[0].ends_with(told), "{body}: {lines:?}");
    assert_eq!(kinds(&scene), kinds(&svg_scene(plain)), "{body}");
    assert!(!kinds(&scene).is_empty(), "{body}: something is drawn");
}

#[test]
fn svg_numbers_without_end_have_no_effect() {
    let nothing = "is not understood and has no effect";
    let path = "<path d='M0 0h9' stroke='red'/>";
    let rect = "<rect width='9' height='9'/>";
    for (body, plain, told) in [
        ("<circle cx='NaN' r='9'/>", "<circle r='9'/>", nothing),
        ("<circle cx='1e39' r='9'/>", "<circle r='9'/>", nothing),
        ("<rect x='-Infinity' width='9' height='9'/>", rect, nothing),
        ("<rect y='1e400' width='9' height='9'/>", rect, nothing),
        ("<rect style='x: 1e39px' width='9' height='9'/>", rect, nothing),
        (
            "<rect transform='translate(NaN,5)' width='9' height='9'/>",
            rect,
            nothing,
        ),
        ("<rect transform='scale(1e39)' width='9' height='9'/>", rect, nothing),
        (
            "<style>rect { transform: translate(1e39px) }</style><rect width='9' height='9'/>",
            rect,
            nothing,
        ),
        ("<path d='M0 0h9' stroke='red' stroke-width='1e39'/>", path, nothing),
        (
            "<path d='M0 0h9' stroke='red' style='stroke-width: 1e39!important'/>",
            path,
            nothing,
        ),
        (
            "<style>path { stroke-width: 1e39 }</style><path d='M0 0h9' stroke='red'/>",
            path,
            nothing,
        ),
        (
            "<svg viewBox='0 0 NaN 1'><circle r='9'/></svg>",
            "<svg><circle r='9'/></svg>",
            nothing,
        ),
        (
            "<svg viewBox='0 0 1e39 1'><circle r='9'/></svg>",
            "<svg><circle r='9'/></svg>",
            nothing,
        ),
    ] {
        assert_drawn_and_told(body, plain, told);
    }
    for number in ["NaN", "1e39", "-1e400"] {
        let path = format!("<path d='M0 0L9 0L9 9L{number} 5L0 9'/>");
        let told = "is not understood after 3 segments; it is drawn up to there";
        assert_drawn_and_told(&path, "<path d='M0 0L9 0L9 9'/>", told);
        let polygon = format!("<polygon points='0,0 9,0 9,9 {number},1 0,9'/>");
        let told = "is not understood after 3 points; it is drawn up to there";
        assert_drawn_and_told(&polygon, "<polygon points='0,0 9,0 9,9'/>", told);
    }
    // What no number of its own is too large for is still refused: nothing of it can be drawn anywhere.
    let body = "<g transform='scale(1e30)'><rect x='1e30' width='1' height='1'/></g>";
    let document = svg("width='10' height='10'", &format!("\n {body}"));
    let line = try_read(document.as_bytes(), DialectChoice::Svg)
        .expect_err(body)
        .to_string();
    assert!(line.starts_with("test.svg:2:") && line.contains("3.4e38"), "{line}");
    // Groups inside each other move their shape by the sum, not by the product.
    let (open, close) = ("<g transform='translate(900, 700)'>".repeat(20), "</g>".repeat(20));
    let turned = "<g transform='rotate(1 250 250)'>".repeat(20);
    let scene = svg_scene(&format!("{open}{turned}<rect width='9' height='9'/>{close}{close}"));
    assert_eq!(scene.primitives.len(), 1, "far, but not that far");
    let scene = svg_scene("<rect x='-1e30' y='-1e30' width='2e30' height='2e30'/>");
    assert_eq!(scene.primitives.len(), 1, "large numbers are legal");
}

/// A PNG of 4 x 2 texels, as a `data:` address.
const PNG: &str = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAQAAAACCAYAAAB/qH1jAAAAEklEQVR4nGP4z8DwHxkzoAsAAA8hD/EEN8afAAAAAElFTkSuQmCC";

#[test]
fn svg_image_places_by_aspect() {
    for (attributes, expected, uv_low, uv_high) in [
        ("", [0.0, 0.0, 4.0, 2.0], [0.0, 0.0], [1.0, 1.0]),
        ("width='8'", [0.0, 0.0, 8.0, 4.0], [0.0, 0.0], [1.0, 1.0]),
        (
            "x='1' y='1' width='8' height='8'",
            [1.0, 3.0, 9.0, 7.0],
            [0.0, 0.0],
            [1.0, 1.0],
        ),
        (
            "width='8' height='8' preserveAspectRatio='none'",
            [0.0, 0.0, 8.0, 8.0],
            [0.0, 0.0],
            [1.0, 1.0],
        ),
        (
            "width='8' height='8' preserveAspectRatio='xMidYMid slice'",
            // What hangs over is clipped.
            [-4.0, 0.0, 12.0, 8.0],
            [0.0, 0.0],
            [1.0, 1.0],
        ),
    ] {
        let scene = svg_scene(&format!("<image href='{PNG}' {attributes}/>"));
        assert!(scene.report.is_empty(), "{attributes}: {:?}", lines(&scene));
        assert_near(&bounds(&scene), &expected, attributes);
        let mut low = Vec2::INFINITY;
        let mut high = Vec2::NEG_INFINITY;
        for kind in kinds(&scene) {
            if let PrimitiveKind::Triangle {
                paint: Paint::Texture { uv, .. },
                ..
            } = kind
            {
                low = uv.iter().fold(low, |low, uv| low.min(*uv));
                high = uv.iter().fold(high, |high, uv| high.max(*uv));
            }
        }
        assert_eq!(
            [low, high],
            [Vec2::from(uv_low), Vec2::from(uv_high)],
            "{attributes}: texture coordinates"
        );
    }
    let scene = svg_scene(&format!("<image xlink:href='{PNG}'/><image href='{PNG}'/>"));
    assert_eq!(scene.textures.len(), 1, "one address, one texture");
}

#[test]
fn stroke_under_a_transform_that_flattens_it_ends() {
    // Outlines that were cut into triangles after such a transform crossed themselves everywhere, for ever.
    for transform in [
        "matrix(3.1 .1 6.2 .2 0 0)",
        "matrix(56.7 5.67 10 1 0 0)",
        "skewX(90.00000001) skewY(89.99)",
    ] {
        let body = format!("<rect width='5' height='5' fill='none' stroke='red' transform='{transform}'/>");
        let scene = svg_scene(&body);
        assert!(
            scene.primitives.len() < 100,
            "{transform}: {} primitives",
            scene.primitives.len()
        );
    }
}
