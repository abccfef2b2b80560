//! Documents of the size that people have: a map of 5 MB, a plot of 100 000 segments, a page of 10 000 glyphs, written as
//! the tools that make them write them.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use super::chance::Chance;

/// Width and height of every document in user units.
const SIDE: f64 = 1000.0;

/// The documents, each with the name that tables call it.
pub(crate) fn all() -> [(&'static str, String); 3] {
    [
        ("map of 5 MB", map()),
        ("plot of 100k", plot()),
        ("page of 10k", page()),
    ]
}

fn document(body: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{SIDE}' height='{SIDE}' viewBox='0 0 {SIDE} {SIDE}'>{body}</svg>"
    )
}

/// A town as an exporter of map data writes it: a `style` on every path; land, contour lines, water that runs out in a
/// gradient, buildings with outlines, streets as a wide line below a narrow one, dashed railways and names, in a clip.
fn map() -> String {
    let mut chance = Chance::new(18);
    let mut body = String::from(
        "<defs><clipPath id='sheet'><rect x='10' y='10' width='980' height='980'/></clipPath>\
         <linearGradient id='lake' x2='0' y2='1'><stop stop-color='#b5d0d0'/><stop offset='1' stop-color='#8fb4c4'/></linearGradient>\
         </defs><rect width='1000' height='1000' fill='#f2efe9'/><g clip-path='url(#sheet)'>",
    );
    for _ in 0..40 {
        let radius = chance.range(30.0, 120.0);
        let center = place(&mut chance);
        let land = blob(&mut chance, center, radius, 120);
        path(&mut body, &land, true, "fill:#cdebb0;stroke:none");
    }
    for height in 0..60 {
        let start = f64::from(height) * 17.0;
        let line = walk(&mut chance, [-5.0, start], 0.0, [1.0, 2.5], 600);
        path(
            &mut body,
            &line,
            false,
            "fill:none;stroke:#c8a070;stroke-width:0.4;stroke-opacity:0.6",
        );
    }
    let shore = blob(&mut chance, [420.0, 560.0], 180.0, 800);
    path(
        &mut body,
        &shore,
        true,
        "fill:url(#lake);stroke:#7a9fb5;stroke-width:0.8",
    );
    for _ in 0..22_500 {
        let [x, y] = place(&mut chance);
        let (sin, cos) = chance.range(0.0, TAU).sin_cos();
        let [wide, high] = [chance.range(1.2, 4.0), chance.range(1.2, 4.0)];
        let house = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.6, 0.5], [0.6, 1.0], [0.0, 1.0]]
            .map(|[u, v]| [x + wide * u * cos - high * v * sin, y + wide * u * sin + high * v * cos]);
        path(&mut body, &house, true, "fill:#d9d0c9;stroke:#b8a89b;stroke-width:0.25");
    }
    lines(&mut chance, &mut body);
    for _ in 0..300 {
        let [x, y] = place(&mut chance);
        let _ = write!(
            body,
            "<text x='{x:.2}' y='{y:.2}' style='font:7px Ubuntu;fill:#333;stroke:none'>Linden Street {}</text>",
            chance.byte()
        );
    }
    body.push_str("</g>");
    document(&body)
}

/// Streets as a wide line below a narrow one, and railways, dashed.
fn lines(chance: &mut Chance, body: &mut String) {
    let streets: Vec<Vec<[f64; 2]>> = (0..400)
        .map(|_| {
            let start = place(chance);
            let towards = chance.range(0.0, TAU);
            walk(chance, start, towards, [2.0, 5.0], 60)
        })
        .collect();
    for (width, color) in [(3.0, "#a0a0a0"), (2.2, "#ffffff")] {
        for street in &streets {
            let style =
                format!("fill:none;stroke:{color};stroke-width:{width};stroke-linecap:round;stroke-linejoin:round");
            path(body, street, false, &style);
        }
    }
    for _ in 0..12 {
        let start = place(chance);
        let rails = walk(chance, start, 0.4, [2.0, 5.0], 300);
        path(body, &rails, false, "fill:none;stroke:#707070;stroke-width:1.4");
        path(
            body,
            &rails,
            false,
            "fill:none;stroke:#ffffff;stroke-width:0.9;stroke-dasharray:4,4",
        );
    }
}

/// Four measured series of 25 000 segments each as Matplotlib writes them, clipped by their axes, with grid and frame.
fn plot() -> String {
    let mut chance = Chance::new(19);
    let mut body = String::from(
        "<defs><clipPath id='axes'><rect x='80' y='60' width='860' height='860'/></clipPath></defs>\
         <path d='M 0 1000 L 1000 1000 L 1000 0 L 0 0 z' style='fill:#ffffff'/>",
    );
    for line in 0..9 {
        let at = 120.0 + 90.0 * f64::from(line);
        let style = "fill:none;stroke:#b0b0b0;stroke-width:0.8;stroke-linecap:square";
        path(&mut body, &[[at, 60.0], [at, 920.0]], false, style);
        path(&mut body, &[[80.0, at], [940.0, at]], false, style);
        let _ = write!(
            body,
            "<text x='{at}' y='945' style='font:12px Ubuntu;text-anchor:middle'>{line}</text>"
        );
    }
    for (color, middle) in [
        ("#1f77b4", 200.0),
        ("#ff7f0e", 400.0),
        ("#2ca02c", 600.0),
        ("#d62728", 800.0),
    ] {
        let mut value: f64 = 0.0;
        let series: Vec<[f64; 2]> = (0..=25_000)
            .map(|step| {
                value = 0.98 * value + chance.range(-6.0, 6.0);
                [80.0 + f64::from(step) * 860.0 / 25_000.0, middle + value]
            })
            .collect();
        let style = format!("fill:none;stroke:{color};stroke-width:1.5;stroke-linecap:square");
        body.push_str("<g clip-path='url(#axes)'>");
        path(&mut body, &series, false, &style);
        body.push_str("</g>");
    }
    path(
        &mut body,
        &[[80.0, 60.0], [940.0, 60.0], [940.0, 920.0], [80.0, 920.0]],
        true,
        "fill:none;stroke:#000000;stroke-width:0.8;stroke-linejoin:miter",
    );
    document(&body)
}

/// A page of text in 100 lines of 100 letters.
fn page() -> String {
    const LETTERS: &[u8] = b"etaoinshrdlucmfwypvbgkjqxzETAOINSHRDLU0123456789.,;-";
    let mut chance = Chance::new(20);
    let mut body =
        String::from("<rect width='1000' height='1000' fill='#ffffff'/><g style='font:17px Ubuntu;fill:#222'>");
    for line in 1..=100 {
        let _ = write!(body, "<text x='12' y='{:.1}'>", 9.8 * f64::from(line) + 4.0);
        for _ in 0..100 {
            let letter = LETTERS[usize::from(chance.byte()) % LETTERS.len()];
            body.push(char::from(letter));
        }
        body.push_str("</text>");
    }
    body.push_str("</g>");
    document(&body)
}

fn place(chance: &mut Chance) -> [f64; 2] {
    [chance.range(0.0, SIDE), chance.range(0.0, SIDE)]
}

/// A rough ring of so many corners.
fn blob(chance: &mut Chance, [x, y]: [f64; 2], radius: f64, corners: u32) -> Vec<[f64; 2]> {
    let lobes = f64::from(2 + chance.byte() % 5);
    (0..corners)
        .map(|corner| {
            let angle = TAU * f64::from(corner) / f64::from(corners);
            let radius = radius * (1.0 + 0.3 * (lobes * angle).sin() + chance.range(-0.02, 0.02));
            [x + radius * angle.cos(), y + radius * angle.sin()]
        })
        .collect()
}

/// A line that wanders: so many steps, each between two lengths.
fn walk(chance: &mut Chance, start: [f64; 2], towards: f64, step: [f64; 2], steps: u32) -> Vec<[f64; 2]> {
    let (mut at, mut towards) = (start, towards);
    (0..=steps)
        .map(|_| {
            let here = at;
            towards += chance.range(-0.15, 0.15);
            let length = chance.range(step[0], step[1]);
            at = [at[0] + length * towards.cos(), at[1] + length * towards.sin()];
            here
        })
        .collect()
}

fn path(body: &mut String, points: &[[f64; 2]], closed: bool, style: &str) {
    body.push_str("<path d='");
    for (i, [x, y]) in points.iter().enumerate() {
        let letter = if i == 0 { 'M' } else { 'L' };
        let _ = write!(body, "{letter} {x:.2} {y:.2} ");
    }
    let _ = write!(body, "{}' style='{style}'/>", if closed { "z" } else { "" });
}
