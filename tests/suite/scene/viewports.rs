//! Boxes that drawings lie in: those of nested documents and symbols, by attributes and by styles.

use glam::DVec2;
use rasterscope::scene::{DialectChoice, PrimitiveKind};

use crate::support::documents::{kinds, lines, read, svg};

/// A symbol that fills its box, and what shows it.
fn symbol(shows: &str) -> String {
    format!("<symbol id='s' viewBox='0 0 10 10'><rect width='10' height='10' fill='lime'/></symbol>{shows}")
}

/// What is drawn of a document.
fn drawn(body: &str) -> Vec<PrimitiveKind> {
    kinds(&read(&svg("width='200' height='200'", body), DialectChoice::Svg))
}

#[test]
fn percentages_of_a_symbol_are_of_what_is_around_it() {
    for (percent, number) in [
        (
            "<use href='#s' x='50%' y='50%' width='25%' height='25%'/>",
            "<use href='#s' x='100' y='100' width='50' height='50'/>",
        ),
        (
            "<use href='#s' width='50%' height=' 50% '/>",
            "<use href='#s' width='100' height='100'/>",
        ),
        (
            "<use href='#s' x='50%' width='60'/>",
            "<use href='#s' x='100' width='60'/>",
        ),
        (
            "<use href='#s' style='x:50%;width:10%;height:20%'/>",
            "<use href='#s' x='100' width='20' height='40'/>",
        ),
        (
            "<svg width='50%' height='1in'><use href='#s' x='50%' y='50%' width='25%' height='25%'/></svg>",
            "<svg width='100' height='96'><use href='#s' x='50' y='48' width='25' height='24'/></svg>",
        ),
        (
            "<svg width='100' height='100' viewBox='0 0 40 40'><use href='#s' width='25%' height='25%'/></svg>",
            "<svg width='100' height='100' viewBox='0 0 40 40'><use href='#s' width='10' height='10'/></svg>",
        ),
    ] {
        let (percent, number) = (drawn(&symbol(percent)), drawn(&symbol(number)));
        assert!(!number.is_empty(), "something is drawn");
        assert_eq!(percent, number);
    }
}

#[test]
fn view_boxes_without_area_hide_their_element() {
    const RECT: &str = "<rect width='9' height='9'/>";
    for (without, body) in [
        (
            "",
            format!("<svg width='50' height='50' viewBox='0 0 0 10'>{RECT}</svg>"),
        ),
        (
            "",
            format!("<symbol id='s' viewBox='0 0 9 0'>{RECT}</symbol><use href='#s'/>"),
        ),
        (
            "",
            format!(
                "<pattern id='p' width='9' height='9' viewBox='0 0 0 0'>{RECT}</pattern><rect width='50' height='50' fill='url(#p)'/>"
            ),
        ),
        (
            "<path d='M9 9h50' stroke='red'/>",
            format!(
                "<marker id='m' viewBox='0 0 0 9'>{RECT}</marker><path d='M9 9h50' stroke='red' marker-end='url(#m)'/>"
            ),
        ),
    ] {
        let scene = read(&svg("width='200' height='200'", &body), DialectChoice::Svg);
        assert_eq!(kinds(&scene), drawn(without), "{body}");
        let told = lines(&scene);
        assert!(
            told.len() == 1 && told[0].contains("has no area: nothing of this"),
            "{told:?}"
        );
    }
    let root = read(
        &svg("width='20' height='20' viewBox='0 0 0 0'", RECT),
        DialectChoice::Svg,
    );
    assert_eq!(kinds(&root).len(), 1, "a root is drawn");
    let told = lines(&root);
    assert!(
        told.len() == 1 && told[0].contains("drawn as without viewBox"),
        "{told:?}"
    );
}

#[test]
fn nested_documents_without_width_or_height_are_not_drawn() {
    const RECT: &str = "<rect width='9' height='9' mask='x'/>";
    for flat in [
        format!("<svg width='0' height='9'>{RECT}</svg>"),
        format!("<svg width='9' height=' 0% ' viewBox='0 0 9 9'>{RECT}</svg>"),
        format!("<svg style='height:0px'>{RECT}</svg>"),
        format!("<svg width='0em'><svg width='9' height='9'>{RECT}</svg></svg>"),
    ] {
        let scene = read(&svg("width='200' height='200'", &flat), DialectChoice::Svg);
        assert_eq!((kinds(&scene), lines(&scene)), (Vec::new(), Vec::new()), "{flat}");
    }
    for shows in ["width='0'", "height='0'", "style='width:0'"] {
        assert_eq!(drawn(&symbol(&format!("<use href='#s' {shows}/>"))), [], "{shows}");
        let document = format!("<defs><svg id='d' width='9' height='9'>{RECT}</svg></defs><use href='#d' {shows}/>");
        assert_eq!(drawn(&document), [], "{shows}");
    }
    for seen in [
        "<svg width='-1' height='9'><rect width='9' height='9'/></svg>",
        "<defs><g id='g'><rect width='9' height='9'/></g></defs><use href='#g' width='0'/>",
    ] {
        assert_eq!(drawn(seen).len(), 1, "{seen}");
    }
}

#[test]
fn styles_say_where_nested_documents_and_copies_lie() {
    const RECT: &str = "<rect width='100%' height='100%' fill='red'/>";
    for (style, attributes) in [
        (
            format!("<svg style='x:150px;y:80px;width:40px;height:40px'>{RECT}</svg>"),
            format!("<svg x='150' y='80' width='40' height='40'>{RECT}</svg>"),
        ),
        (
            format!("<style>svg svg{{width:40px;height:20px}}</style><svg width='9'>{RECT}</svg>"),
            format!("<svg width='40' height='20'>{RECT}</svg>"),
        ),
        (
            "<rect id='r' width='30' height='30'/><use href='#r' style='x:100px;y:50px'/>".to_owned(),
            "<rect id='r' width='30' height='30'/><use href='#r' x='100' y='50'/>".to_owned(),
        ),
    ] {
        assert_eq!(drawn(&style), drawn(&attributes), "{style}");
    }
    let root = read(
        &svg("width='20' height='20' style='width:100%;x:5px'", RECT),
        DialectChoice::Svg,
    );
    assert_eq!(root.canvas, DVec2::splat(20.0), "those of a root are the page's");
}
