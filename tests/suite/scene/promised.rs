//! What the README promises of SVG: each word of its table has a document that is drawn without a complaint, or is reported.

use std::fs;
use std::path::Path;

use rasterscope::scene::DialectChoice;

use crate::support::documents::{read, svg};
use crate::support::scenes::{at_rate, drawn, one_to_one};

/// Words of the table, and what is drawn with them on a white canvas of 20 by 20.
const DRAWN: &[(&str, &str)] = &[
    (
        "`path` with all its commands",
        "<path d='M2 2h9v9H2z M3 3q9 0 9 9t5 5 M1 1c2 2 3 3 4 9s2 2 9 9a5 5 0 0 1 -9 -9l1 1'/>",
    ),
    ("`rect`", "<rect x='2' y='2' width='9' height='9' rx='3'/>"),
    ("`circle`", "<circle cx='9' cy='9' r='5'/>"),
    ("`ellipse`", "<ellipse cx='9' cy='9' rx='5' ry='3'/>"),
    ("`line`", "<line x1='2' y1='2' x2='15' y2='9' stroke='red'/>"),
    ("`polyline`", "<polyline points='2,2 15,9 3,15'/>"),
    ("`polygon`", "<polygon points='2,2 15,9 3,15'/>"),
    (
        "markers",
        "<marker id='m' markerWidth='4' markerHeight='4'><path d='M0 0h4v4z'/></marker><path d='M5 5h9' marker-end='url(#m)'/>",
    ),
    (
        "gradients",
        "<linearGradient id='g'><stop stop-color='red'/><stop offset='1'/></linearGradient><rect width='9' height='9' fill='url(#g)'/>",
    ),
    (
        "patterns",
        "<pattern id='p' width='.5' height='.5'><rect width='2' height='2'/></pattern><rect width='9' height='9' fill='url(#p)'/>",
    ),
    (
        "fill rules",
        "<path d='M1 1h9v9h-9z M3 3h5v5h-5z' fill-rule='evenodd'/>",
    ),
    (
        "dashes",
        "<path d='M1 5h15' stroke='red' stroke-width='3' stroke-dasharray='2 1' stroke-dashoffset='1'/>",
    ),
    (
        "miter limits",
        "<path d='M1 5h15L2 9' fill='none' stroke='red' stroke-miterlimit='9' stroke-linejoin='miter' stroke-linecap='square'/>",
    ),
    (
        "`paint-order`",
        "<circle cx='9' cy='9' r='5' stroke='red' paint-order='stroke'/>",
    ),
    ("`opacity`", "<g opacity='.5'><rect width='9' height='9'/></g>"),
    (
        "clip paths",
        "<clipPath id='c'><circle cx='5' cy='5' r='4'/></clipPath><rect width='9' height='9' clip-path='url(#c)'/>",
    ),
    (
        "masks",
        "<mask id='k'><rect width='9' height='5' fill='#fff'/></mask><rect width='9' height='9' mask='url(#k)'/>",
    ),
    (
        "blend modes",
        "<rect width='9' height='9' style='mix-blend-mode:multiply'/>",
    ),
    (
        "`use`",
        "<defs><rect id='r' width='9' height='9'/></defs><use href='#r' x='3'/>",
    ),
    (
        "`symbol`",
        "<symbol id='s' viewBox='0 0 2 2'><rect width='1' height='1'/></symbol><use href='#s' width='9' height='9'/>",
    ),
    (
        "`switch`",
        "<switch><rect systemLanguage='xx' width='9' height='9' fill='none'/><rect width='9' height='9'/></switch>",
    ),
    (
        "nested `svg`",
        "<svg x='3' width='9' height='9' viewBox='0 0 2 2'><rect width='1' height='1'/></svg>",
    ),
    (
        "text",
        "<text x='1' y='15' font-family='Ubuntu' font-size='12'>A</text>",
    ),
    (
        "style sheets",
        "<style>.a { fill: red }</style><rect class='a' width='9' height='9'/>",
    ),
    ("all units of SVG 1.1", "<rect width='50%' height='2mm'/>"),
];

/// Words of the table, and what is reported instead of being drawn.
const REPORTED: &[(&str, &str, &str)] = &[
    (
        "filters",
        "<filter id='f'><feFlood/></filter><rect width='9' height='9' filter='url(#f)'/>",
        "filter",
    ),
    (
        "animation",
        "<rect width='9' height='9'><animate attributeName='x' to='9' dur='1s'/></rect>",
        "animate",
    ),
    ("scripts", "<script>alert(1)</script>", "script"),
    (
        "`foreignObject`",
        "<foreignObject width='9' height='9'/>",
        "foreignObject",
    ),
];

fn table() -> String {
    let readme = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).expect("a README");
    let rows = readme.lines().skip_while(|line| !line.starts_with("| of SVG |"));
    rows.take_while(|line| line.starts_with('|'))
        .collect::<Vec<_>>()
        .join("\n")
}

#[test]
fn what_the_readme_promises_of_svg_is_drawn() {
    let table = table();
    for (words, body) in DRAWN {
        assert!(table.contains(words), "{words} in {table}");
        let scene = read(&svg("width='20' height='20'", body), DialectChoice::Svg);
        let report: Vec<String> = scene.report.lines().collect();
        assert_eq!(report, [""; 0], "{words}");
        let frame = drawn(&scene, &one_to_one([20, 20]), &at_rate(16), [20, 20]);
        let painted = frame.pixels().iter().filter(|pixel| **pixel != 0xFFFF_FFFF).count();
        assert!(painted > 3, "{words}: {painted} pixels");
    }
}

#[test]
fn what_the_readme_says_is_not_drawn_is_reported_with_its_line() {
    let table = table();
    for (words, body, name) in REPORTED {
        assert!(table.contains(words), "{words} in {table}");
        let scene = read(&svg("width='20' height='20'", body), DialectChoice::Svg);
        let named = scene.report.skipped.iter().any(|skipped| skipped.name.contains(name));
        assert!(named, "{words}: {:?}", scene.report);
    }
}
