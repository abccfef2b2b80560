//! Drawings made to take time or memory: each ends as a picture, or in one line, soon.

use std::sync::Arc;
use std::time::Instant;

use rasterscope::scene::DialectChoice;

use crate::support::documents::{kinds, lines, svg, svg_scene, try_read};

/// The longest that any of these may take on a busy machine, in seconds.
const SOON: f64 = 10.0;

/// Reads a drawing; the line in which it is refused, or an empty one.
fn outcome(what: &str, body: &str) -> String {
    let document = svg("width='100' height='100'", body);
    let started = Instant::now();
    let line = match try_read(document.as_bytes(), DialectChoice::Svg) {
        Ok(_) => String::new(),
        Err(error) => error.to_string(),
    };
    let seconds = started.elapsed().as_secs_f64();
    assert!(seconds < SOON, "{what}: {seconds} s");
    assert!(!line.contains('\n') && !line.contains("_0_"), "{what}: {line}");
    line
}

/// `count` definitions, each of which refers to the one before twice.
fn chain(count: usize, one: impl Fn(&str, &str) -> String) -> String {
    (0..count)
        .map(|i| one(&format!("d{}", i + 1), &format!("#d{i}")))
        .collect()
}

#[test]
fn images_that_are_too_small_for_where_they_lie_are_not_drawn() {
    const PIXELS: &str = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==";
    const DOCUMENT: &str = "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' width='9' height='9'/%3E";
    for (sides, is_drawn) in [
        ("width='9' height='999999999999999999999'", false),
        ("width='9' height='1e30' preserveAspectRatio='none'", false),
        ("width='9' height='1e30' preserveAspectRatio='xMaxYMax slice'", false),
        ("x='1e30' width='9' height='9'", false),
        ("x='-1e9' width='1e-3' height='1e3'", false),
        ("y='1e30'", false),
        ("width='0' height='1e30'", true),
        ("width='1e30' height='1e30'", true),
        ("x='3500000' y='5800000' width='200' height='100'", true),
        ("x='10%' width='100%' height='9'", true),
        ("", true),
    ] {
        for address in [PIXELS, DOCUMENT] {
            let image = format!(r#"<image {sides} href="{address}"/>"#);
            let document = svg("width='100' height='100'", &image);
            let scene = try_read(document.as_bytes(), DialectChoice::Svg).expect("a document");
            let report = format!("{:?}", scene.report);
            assert_eq!(
                !report.contains("too small for where it lies"),
                is_drawn,
                "{sides}: {report}"
            );
            outcome(
                "inside an image",
                &format!(
                    r#"<image width="9" height="9" href="data:image/svg+xml,{}"/>"#,
                    svg("width='9' height='9'", &image)
                        .replace('"', "%22")
                        .replace('#', "%23")
                ),
            );
        }
    }
}

#[test]
fn documents_at_which_the_reader_panics_are_refused_in_one_line() {
    const PIXELS: &str = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==";
    let mut refused = 0;
    for (head, sides) in [
        ("viewBox='0 0 1e9 1e9'", "width='100%' height='0.01'"),
        ("viewBox='0 0 1e9 1e9'", "x='100%' width='1' height='1'"),
        ("width='100' height='100' font-size='1e9'", "width='1em' height='0.01'"),
        (
            "width='100' height='100' font-size='1e9'",
            "x='1em' width='1' height='1'",
        ),
        ("viewBox='500000 0 1e6 1e6'", "x='700000' width='10%' height='10%'"),
    ] {
        let document = svg(head, &format!(r#"<image {sides} href="{PIXELS}"/>"#));
        match try_read(document.as_bytes(), DialectChoice::Svg) {
            Ok(scene) => {
                let report = format!("{:?}", scene.report);
                assert!(!report.contains("too small for where it lies"), "{head}: {report}");
            }
            Err(error) => {
                let line = error.to_string();
                assert!(
                    line.contains("the SVG reader fails here") && !line.contains('\n'),
                    "{head}: {line}"
                );
                refused += 1;
            }
        }
    }
    assert!(refused > 0, "usvg has learnt all of them: the guard can go");
}

#[test]
fn long_styles_end_soon() {
    let attribute = |count: usize, one: &str| {
        let style = one.repeat(count);
        outcome(
            &format!("{count} x {one}"),
            &format!("<rect width='50' height='50' style='{style}'/>"),
        )
    };
    assert_eq!(attribute(500, "fill:red;"), "", "as long as no tool writes them: drawn");
    assert_eq!(attribute(5_000, "fill:red;"), "", "drawn");
    for (count, one) in [
        (45_000, "fill:red;"),
        (100_000, "a:b;"),
        (400_000, ";"),
        (200_000, "a:"),
    ] {
        let line = attribute(count, one);
        assert!(line.is_empty() || line.contains("of reading styles"), "{one}: {line}");
    }
    let sheet = |rules: usize| {
        let rule = |i: usize| format!(".cls-{i}{{fill:#{i:06x};stroke:none;opacity:1;}}\n");
        let rules: String = (0..rules).map(rule).collect();
        let body = format!("<style>{rules}</style><rect class='cls-3' width='50' height='50'/>");
        outcome("a style sheet", &body)
    };
    assert_eq!(
        sheet(1_500),
        "",
        "a drawing with many colours, as Illustrator writes it"
    );
    let line = sheet(40_000);
    assert!(line.contains("of reading styles"), "{line}");
}

#[test]
fn declarations_of_namespaces_may_be_repeated() {
    let nested = "<svg xmlns='http://www.w3.org/2000/svg' width='8' height='8'><rect width='8' height='8'/></svg>";
    assert_eq!(outcome("nested documents", &nested.repeat(5_000)), "", "drawn");
    let comment = "<!-- xmlns='a' --><rect width='8' height='8'/>";
    assert_eq!(outcome("comments", &comment.repeat(300)), "", "they declare nothing");
    let declared = |count: usize| {
        let one = |i: usize| format!(" xmlns:p{i}='a'");
        (0..count).map(one).collect::<Vec<_>>().concat()
    };
    assert!(outcome("prefixes", &format!("<g{}/>", declared(300))).contains("more than 256 prefixes of namespaces"));
    let each = format!("<g{}>{}</g>", declared(150), "<g xmlns='a'/>".repeat(20_000));
    assert!(outcome("many of both", &each).contains("namespace declarations with so many prefixes"));
}

#[test]
fn large_tiles_are_told_where_they_have_no_room_together() {
    let told = |count: usize| {
        let one = |i: usize| {
            format!(
                "<pattern id='p{i}' width='1000' height='1000' patternUnits='userSpaceOnUse'><rect width='900' height='900'/></pattern>\
                 <rect width='9' height='9' fill='url(#p{i})'/>"
            )
        };
        let body: String = (0..count).map(one).collect();
        let document = svg("width='100' height='100'", &body);
        let scene = try_read(document.as_bytes(), DialectChoice::Svg).expect("a document");
        format!("{:?}", scene.report.warnings)
    };
    assert_eq!(told(60), "[]", "60 million texels");
    assert!(
        told(100).contains("100 patterns have 100 million pixels together"),
        "{}",
        told(100)
    );
}

/// Thousands of textures times a hundred thousand tiles would be gigabytes, if each tile had a list of its own.
#[test]
fn tiles_share_the_textures_of_the_scene() {
    const PIXEL: &str =
        "base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==";
    let image = |i: usize| format!("<image width='1' height='1' href='data:image/png;n={i};{PIXEL}'/>");
    let tile = |i: usize| {
        format!(
            "<pattern id='p{i}' width='1' height='1' patternUnits='userSpaceOnUse'><rect width='1' height='1' fill='url(#inner)'/></pattern>\
             <rect width='9' height='9' fill='url(#p{i})'/><rect width='9' height='9' fill='url(#p{i})' opacity='.5'/>"
        )
    };
    let images: String = (0..64).map(image).collect();
    let tiles: String = (0..500).map(tile).collect();
    let inner = format!("<pattern id='inner' width='1' height='1' patternUnits='userSpaceOnUse'>{images}</pattern>");
    let document = svg("width='100' height='100'", &format!("{inner}{tiles}"));
    let scene = try_read(document.as_bytes(), DialectChoice::Svg).expect("a document");
    assert_eq!((scene.textures.len(), scene.patterns.len()), (64, 1000));
    for pattern in &scene.patterns {
        let [inside] = pattern.tile.patterns.as_slice() else {
            panic!("a pattern in the tile: {:?}", pattern.tile.patterns.len());
        };
        assert!(Arc::ptr_eq(&pattern.tile.textures, &scene.textures), "one list");
        assert!(Arc::ptr_eq(&inside.tile.textures, &scene.textures), "inside too");
    }
    let [half, whole] = [&scene.patterns[0], &scene.patterns[1]].map(|pattern| Arc::as_ptr(&pattern.tile));
    assert_eq!(half, whole, "patterns that had one tile still do");
}

#[test]
fn long_texts_are_left_out_and_the_rest_is_drawn() {
    let spans = format!("<text y='50'>{}</text>", "<tspan>x</tspan>".repeat(3_000));
    let letters = format!("<text>{}</text>", "word ".repeat(200_000));
    let shown = "<switch><text>ALL</text><rect width='9' height='9'/></switch>";
    for text in [spans.clone(), letters, shown.replace("ALL", &"word ".repeat(5_000))] {
        let told = told("a long text", &format!("<rect width='9' height='9'/>\n{text}"));
        let [line] = told.as_slice() else {
            panic!("one line: {told:?}")
        };
        assert!(line.starts_with("2:"), "{line}");
        assert!(
            line.contains("each element inside counts as 8; split the text"),
            "{line}"
        );
    }
    let scene = svg_scene(&shown.replace("ALL", &"word ".repeat(5_000)));
    assert!(scene.primitives.is_empty(), "a switch shows its first");
    let scene = svg_scene(&format!("<g display='none'>{spans}</g>"));
    assert!(scene.report.is_empty(), "nobody misses it: {:?}", scene.report);
}

#[test]
fn markers_count_once_for_each_path() {
    let path =
        |data: &str| format!("<path d='{data}' style='marker-start:url(#a);marker-mid:url(#a);marker-end:url(#a)'/>");
    let marker = "<marker id='a'><rect width='1' height='1'/></marker>";
    let line = outcome(
        "three markers",
        &format!("{marker}{}", path("M10 10L5 5").repeat(16_000)),
    );
    assert!(!line.contains("more than"), "{line}");
    let corners = path(&format!("M0 0{}", "L1 1".repeat(200_000)));
    let line = outcome("many corners", &format!("{marker}{corners}"));
    assert!(
        line.contains("masks and markers, one for each shape or corner"),
        "{line}"
    );
}

/// The lines that are told of a drawing, which is read soon.
fn told(what: &str, body: &str) -> Vec<String> {
    let started = Instant::now();
    let scene = svg_scene(body);
    let seconds = started.elapsed().as_secs_f64();
    assert!(seconds < SOON, "{what}: {seconds} s");
    assert!(!scene.primitives.is_empty(), "{what}: the rest is drawn");
    lines(&scene)
}

/// How many of them are told of references in circles.
fn count_of_circles(told: &[String]) -> usize {
    told.iter()
        .filter(|line| line.contains("which leads in a circle back to here"))
        .count()
}

#[test]
fn references_in_circles_have_no_effect() {
    let circle = |kind: &str, attribute: &str, length: usize| -> String {
        let one = |i: usize| {
            let next = (i + 1) % length;
            format!("<{kind} id='d{i}'><rect width='9' height='9' {attribute}='url(#d{next})'/></{kind}>")
        };
        (0..length).map(one).collect()
    };
    for (kind, attribute) in [
        ("clipPath", "clip-path"),
        ("mask", "mask"),
        ("pattern", "fill"),
        ("pattern", "stroke"),
    ] {
        for length in [1, 2, 3, 50] {
            let what = format!("{length} x {kind}");
            let body = format!(
                "{}<rect width='9' height='9' {attribute}='url(#d0)'/><circle r='3'/>",
                circle(kind, attribute, length)
            );
            let told = told(&what, &body);
            assert_eq!(count_of_circles(&told), length, "{what}: {told:?}");
        }
    }
}

#[test]
fn references_of_many_kinds_in_circles_are_told() {
    let shape = "<rect width='9' height='9'/>";
    for (what, count, body) in [
        (
            "two kinds",
            2,
            "<pattern id='a' width='1' height='1'><rect width='1' height='1' stroke='url(#b)'/></pattern>\
             <pattern id='b' width='1' height='1'><rect width='1' height='1' fill='url(#a)'/></pattern><rect width='9' height='9' fill='url(#b)'/>",
        ),
        (
            "by a style sheet",
            3,
            "<style>.x{mask:url(#a)}.y{mask:url(#b)}.z{mask:url(#c)}</style>\
             <mask id='a'><rect class='y' width='9' height='9'/></mask><mask id='b'><rect class='z' width='9' height='9'/></mask>\
             <mask id='c'><rect class='x' width='9' height='9'/></mask><rect class='x' width='9' height='9'/>",
        ),
        (
            "two groups that show each other",
            2,
            "<g id='a'><use href='#b'/><rect width='9' height='9'/></g><g id='b'><use href='#a'/></g>",
        ),
        (
            "use",
            3,
            "<g id='a'><use href='#b'/></g><g id='b'><use href='#c'/></g><g id='c'><use href='#a'/></g>",
        ),
        (
            "use of itself",
            2,
            "<use id='a' href='#a'/><g id='b'><use href='#b'/></g>",
        ),
        (
            "a clip path clipped by itself",
            1,
            "<clipPath id='c' clip-path='url(#c)'><rect width='5' height='5'/></clipPath>",
        ),
        ("a gradient of itself", 1, "<linearGradient id='a' href='#a'/>"),
        (
            "gradients",
            3,
            "<linearGradient id='a' href='#b'/><linearGradient id='b' href='#c'/><linearGradient id='c' href='#a'/><rect width='9' height='9' fill='url(#a)'/>",
        ),
        (
            "markers",
            2,
            "<marker id='a' markerWidth='9' markerHeight='9'><path d='M0 0L1 1' marker-end='url(#b)'/></marker>\
             <marker id='b' markerWidth='9' markerHeight='9'><path d='M0 0L1 1' marker-end='url(#a)'/></marker><path d='M0 0L9 9' stroke='red' marker-end='url(#a)'/>",
        ),
        (
            "a paint that is handed down",
            1,
            "<g fill='url(#p)'><pattern id='p' width='1' height='1'><rect width='1' height='1'/></pattern></g>",
        ),
    ] {
        let told = told(what, &format!("{body}{shape}"));
        assert_eq!(count_of_circles(&told), count, "{what}: {told:?}");
    }
    let picture = "<filter id='f'><feImage href='#g'/></filter><g id='g'><g filter='url(#f)'><rect width='9' height='9'/></g></g>";
    assert!(count_of_circles(&told("a picture by a filter", &format!("{picture}{shape}"))) > 0);
}

#[test]
fn what_stands_beside_a_circle_is_drawn_as_without_it() {
    let pattern = "<pattern id='p' width='4' height='4' patternUnits='userSpaceOnUse'><rect width='3' height='3' LOOK/></pattern>\
                   <rect width='9' height='9' fill='url(#p)'/>";
    for (look, plain) in [
        ("fill='url(#p) red'", "fill='red'"),
        ("style='fill: url(#p) red'", "fill='red'"),
        ("fill='url(#p)' stroke='blue'", "fill='none' stroke='blue'"),
        // What does not count leads nowhere.
        ("fill='url(#p)' style='fill: lime'", "fill='lime'"),
        ("class='c' fill='url(#p)'", "fill='yellow'"),
    ] {
        let sheet = "<style>.c { fill: yellow } .d { fill: none }</style>";
        let [found, expected] =
            [look, plain].map(|look| svg_scene(&format!("{sheet}{}", pattern.replace("LOOK", look))));
        assert_eq!(kinds(&found), kinds(&expected), "{look}");
        let is_circle = !look.contains("lime") && !look.contains("class");
        assert_eq!(count_of_circles(&lines(&found)), usize::from(is_circle), "{look}");
    }
    let around = svg_scene("<g id='a'><rect width='9' height='9'/><use href='#a' x='20'/></g>");
    assert_eq!(around.primitives.len(), 1);
    let told = lines(&around);
    assert!(
        told.len() == 1 && told[0].contains("not drawn: its href refers to #a, which leads in a circle back to here"),
        "{told:?}"
    );
}

#[test]
fn what_multiplies_is_counted_first() {
    let rect = "<rect width='9' height='9'";
    let twice = |one: &str| one.repeat(10);
    let bombs = [
        (
            "use",
            chain(12, |id, to| {
                format!("<g id='{id}'>{}</g>", twice(&format!("<use href='{to}'/>")))
            }),
            "<use href='#d12'/>".to_owned(),
        ),
        (
            "clip paths",
            chain(12, |id, to| {
                format!(
                    "<clipPath id='{id}' clipPathUnits='objectBoundingBox'>{}</clipPath>",
                    twice(&format!("{rect} clip-path='url({to})'/>"))
                )
            }),
            format!("{rect} clip-path='url(#d12)'/>"),
        ),
        (
            "masks",
            chain(12, |id, to| {
                format!(
                    "<mask id='{id}'>{}</mask>",
                    twice(&format!("{rect} mask='url({to})'/>"))
                )
            }),
            format!("{rect} mask='url(#d12)'/>"),
        ),
        (
            "patterns",
            chain(12, |id, to| {
                format!(
                    "<pattern id='{id}' width='.1' height='.1'>{}</pattern>",
                    twice(&format!("{rect} fill='url({to})'/>"))
                )
            }),
            format!("{rect} fill='url(#d12)'/>"),
        ),
        (
            "markers",
            chain(12, |id, to| {
                format!(
                    "<marker id='{id}' markerWidth='9' markerHeight='9'>{}</marker>",
                    twice(&format!("<path d='M0 0L1 1 2 3 4 5' marker-mid='url({to})'/>"))
                )
            }),
            "<path d='M0 0L1 1 2 3' marker-mid='url(#d12)'/>".to_owned(),
        ),
    ];
    for (what, definitions, body) in bombs {
        let line = outcome(what, &format!("{definitions}{body}"));
        assert!(line.contains("more than"), "{what}: {line}");
    }
    let stops = "<stop/>".repeat(1000);
    let shapes = "<rect width='1' height='1' fill='url(#g)'/>".repeat(10_000);
    // Shapes share them.
    let line = outcome(
        "stops",
        &format!("<linearGradient id='g'>{stops}</linearGradient>{shapes}"),
    );
    assert!(line.is_empty(), "a thousand stops, ten thousand times: {line}");
}

/// Few elements, but long outlines, which usvg copies.
#[test]
fn outlines_that_multiply_are_counted_first() {
    let rect = "<rect width='9' height='9'";
    let path = format!("<path id='p' d='M0 0{}'/>", "h1v1".repeat(5_000));
    let marker = format!("<marker id='m'><path d='M0 0{}'/></marker>", "h1v1".repeat(500));
    let edges = "<path d='M0 0h1v1h1v1h1v1h1v1'/>".repeat(10_000);
    let long = [
        ("use", path.clone(), "<use href='#p'/>".repeat(3_000)),
        (
            "a clip path",
            format!("<clipPath id='c'>{path}</clipPath>"),
            format!("{rect} clip-path='url(#c)'/>").repeat(3_000),
        ),
        (
            "a marker of a group",
            marker.clone(),
            format!("<g marker-mid='url(#m)'>{edges}</g>"),
        ),
        (
            "a marker of what is used",
            format!("{marker}<g id='g'>{edges}</g>"),
            "<use href='#g' marker-mid='url(#m)'/>".to_owned(),
        ),
        (
            "letters",
            format!("<text id='t'>{}</text>", "many words ".repeat(500)),
            "<use href='#t'/>".repeat(200),
        ),
    ];
    for (what, definitions, body) in long {
        let line = outcome(what, &format!("{definitions}{body}"));
        assert!(line.contains("numbers of outlines"), "{what}: {line}");
    }
    // An arrow at the end of each path is drawn once.
    let line = outcome(
        "arrows",
        &format!("{marker}<g marker-end='url(#m)'>{}</g>", path.repeat(100)),
    );
    assert!(line.is_empty(), "{line}");
}

#[test]
fn depth_has_an_end() {
    let nested = |count: usize, open: &str, close: &str| {
        format!(
            "{}<rect width='9' height='9'/>{}",
            open.repeat(count),
            close.repeat(count)
        )
    };
    for (open, close) in [
        ("<g>", "</g>"),
        ("<svg>", "</svg>"),
        ("<g opacity='.5'>", "</g>"),
        ("<text>", "</text>"),
    ] {
        for count in [900, 1100, 100_000] {
            let line = outcome(open, &nested(count, open, close));
            assert!(
                count < 1000 || line.contains("inside each other") || open == "<text>" && count > 2500,
                "{count} x {open}: {line}"
            );
            assert!(line.is_empty() || line.starts_with("test.svg:1:"), "{line}");
        }
    }
    let masks = chain(30_000, |id, to| {
        format!("<mask id='{id}'><rect width='9' height='9' mask='url({to})'/></mask>")
    });
    let line = outcome(
        "a chain of masks",
        &format!("{masks}<rect width='9' height='9' mask='url(#d30000)'/>"),
    );
    assert!(line.contains("inside each other"), "{line}");
    let short = chain(400, |id, to| {
        format!("<mask id='{id}'><rect width='9' height='9' mask='url({to})'/></mask>")
    });
    let line = outcome(
        "a shorter one",
        &format!("{short}<rect width='9' height='9' mask='url(#d400)'/>"),
    );
    assert!(line.contains("layers"), "usvg reads it: {line}");
}

#[test]
fn strokes_and_gradients_of_any_size_end() {
    for (what, body) in [
        ("tiny dashes", "<path d='M0 0H100V100' stroke='red' stroke-dasharray='1e-9'/>".to_owned()),
        ("a wide stroke", "<path d='M0 0H100V100' stroke='red' stroke-width='1e30' stroke-linejoin='round'/>".to_owned()),
        ("a thin stroke", "<path d='M0 0H100V100C0 0 1 2 3 4' stroke='red' stroke-width='1e-30' stroke-linecap='round'/>".to_owned()),
        ("far away", "<path d='M-1e30 0H1e30V1e30C0 0 1 2 3 4' stroke='red' stroke-dasharray='5'/>".to_owned()),
        ("many stops", format!("<linearGradient id='g'>{}</linearGradient><rect width='9' height='9' fill='url(#g)'/>", "<stop offset='.5'/>".repeat(1_000_000))),
        ("as many as may be", format!("<linearGradient id='g'>{}</linearGradient><rect width='9' height='9' fill='url(#g)'/>", (0..300_000).map(|i| format!("<stop offset='{}'/>", f64::from(i) / 3e5)).collect::<Vec<_>>().concat())),
        ("a tiny tile", "<pattern id='p' width='1e-20' height='1e-20'><rect width='1' height='1'/></pattern><rect width='9' height='9' fill='url(#p)'/>".to_owned()),
        ("much text", format!("<text>{}</text>", "word ".repeat(20_000))),
        ("a selector", format!("<style>{}x{{fill:red}}</style>{}<rect/>{}", "g ".repeat(30), "<g>".repeat(500), "</g>".repeat(500))),
        ("rules", format!("<style>{}</style>{}", ".a{fill:red}".repeat(20_000), "<rect/>".repeat(20_000))),
        ("nested images", (0..12).fold("<rect width='9' height='9'/>".to_owned(), |inner, _| {
            let document = svg("width='9' height='9'", &inner).replace('%', "%25").replace('#', "%23").replace('\'', "%27").replace('<', "%3c").replace('>', "%3e");
            format!("<image href='data:image/svg+xml,{document}'/>")
        })),
    ] {
        outcome(what, &body);
    }
}
