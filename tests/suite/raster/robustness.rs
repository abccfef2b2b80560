//! Hostile documents: each ends in a scene or in one line, soon and in little memory.
//!
//! `tests/broken` holds documents that are each named after their fault; what is too large for a file is made here.

use std::time::{Duration, Instant};

use rasterscope::geometry::View;
use rasterscope::raster::Framebuffer;
use rasterscope::render::{RenderSettings, draw};
use rasterscope::scene::{self, DialectChoice, PrimitiveKind};

use crate::support::documents::{svg, try_read};
use crate::support::mutation::mutate;

/// How long one document may take in a checked build on a busy machine.
const PATIENCE: Duration = Duration::from_secs(20);

/// A document with a little of everything.
const EVERYTHING: &str = r##"<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE svg [ <!ENTITY red "#ff0000"> ]>
<svg xmlns="http://www.w3.org/2000/svg" width="64px" height="48" viewBox="0 0 64 48">
  <!-- a comment --><title>t</title>
  <defs><linearGradient id="g"/></defs>
  <texture texid="map" filename="data:image/png;base64,iVBORw0KGgo="/>
  <g transform="translate(3 4) rotate(30,1,2) scale(.5)" opacity="0.5" fill="&red;">
    <polygon id="p" points="0,0 10,0 3,9 9,9 5,-2" stroke="#00f" stroke-width="2mm" style="fill-rule:evenodd"/>
    <polyline points="1 2 3 4 5 9" stroke="#0f0" stroke-linejoin="round" stroke-linecap="square"/>
  </g>
  <rect x="1" y="2" width="0" height="0"/><rect x="5%" width="7" height="8" rx="2" stroke-opacity=".3"/>
  <line x1="1" y1="1e2" x2="-3" stroke="rgb(1,2,3)"/>
  <colortri points="0 0 9 0 0 9" colors="1 0 0 1 0 1 0 1 0 0 1 1"/>
  <textri texid="map" points="0 0 9 0 0 9" uvs="0 0 1 0 0 1"/>
  <image x="1" y="2" width="9" href="none.png" preserveAspectRatio="xMinYMax slice"/>
  <svg x="4" viewBox="0 0 2 2"><circle r="1"/></svg>
</svg>
"##;

thread_local! {
    /// Threads of this test's own: those that all tests share might be busy with another's pictures, and time would be told
    /// of them.
    static POOL: rayon::ThreadPool = rayon::ThreadPoolBuilder::new().num_threads(2).build().expect("a pool");
}

/// Reads in every dialect, draws what comes out, and answers with the errors' lines.
fn survive(document: &[u8], what: &str) -> Vec<String> {
    POOL.with(|pool| pool.install(|| survive_here(document, what)))
}

fn survive_here(document: &[u8], what: &str) -> Vec<String> {
    let started = Instant::now();
    let mut lines = Vec::new();
    for dialect in DialectChoice::ALL {
        match try_read(document, dialect) {
            Ok(scene) => {
                assert!(
                    scene.canvas.is_finite() && scene.canvas.min_element() > 0.0,
                    "{what}: {}",
                    scene.canvas
                );
                for primitive in &scene.primitives {
                    let points: &[_] = match &primitive.kind {
                        PrimitiveKind::Triangle { points, .. } => points,
                        PrimitiveKind::Polygon { polygon, .. } => polygon.points(),
                        PrimitiveKind::Hairline { ends, .. } => ends,
                        PrimitiveKind::Point { at, .. } => std::slice::from_ref(at),
                        PrimitiveKind::BeginLayer | PrimitiveKind::EndLayer { .. } => &[],
                    };
                    assert!(points.iter().all(|point| point.is_finite()), "{what}: {primitive:?}");
                    assert!(
                        (primitive.shape.0 as usize) < scene.shapes.len(),
                        "{what}: {primitive:?}"
                    );
                }
                assert!(
                    scene.report.lines().all(|line| is_one_line(&line)),
                    "{what}: {:?}",
                    scene.report
                );
                let size = [16, 16];
                let mut frame = Framebuffer::new(16, 16);
                draw(
                    &scene,
                    &View::Default.transform(scene.canvas, size),
                    &RenderSettings::default(),
                    &mut frame,
                );
            }
            Err(error) => {
                let line = error.to_string();
                assert!(is_one_line(&line) && line.starts_with("test.svg"), "{what}: {line}");
                lines.push(line);
            }
        }
    }
    assert!(started.elapsed() < PATIENCE, "{what} took {:?}", started.elapsed());
    lines
}

fn is_one_line(line: &str) -> bool {
    !line.contains(['\n', '\r']) && line.chars().count() < 500
}

/// Must be refused in every dialect, for a reason that contains `cause`.
fn refused(document: &[u8], cause: &str) {
    let lines = survive(document, cause);
    assert_eq!(lines.len(), 3, "refused in every dialect because of {cause}: {lines:?}");
    assert!(lines.iter().all(|line| line.contains(cause)), "{cause}: {lines:?}");
}

/// Must give a scene in every dialect.
fn accepted(document: &[u8], what: &str) {
    let lines = survive(document, what);
    assert!(lines.is_empty(), "{what}: {lines:?}");
}

#[test]
fn robust_broken_documents_one_line_each() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).expect("the folder of broken documents") {
        let path = entry.expect("an entry").path();
        let name = path.display().to_string();
        let document = std::fs::read(&path).expect("readable");
        let lines = survive(&document, &name);
        let harmless = name.contains("harmless");
        assert_eq!(lines.is_empty(), harmless, "{name}: {lines:?}");
        for dialect in DialectChoice::ALL {
            if let Err(error) = scene::load(&path, dialect) {
                assert!(is_one_line(&error.to_string()), "{error}");
            }
        }
        count += 1;
    }
    assert!(count >= 20, "{count} documents found");
}

#[test]
fn robust_every_prefix_of_a_document() {
    accepted(EVERYTHING.as_bytes(), "the whole document");
    for end in 0..EVERYTHING.trim_end().len() {
        refused(&EVERYTHING.as_bytes()[..end], "; ");
    }
}

#[test]
fn robust_mutated_documents() {
    let splices = [
        "-", "e999", "nan", "1e38", "\"", "<", ">", "&", "<g>", "</g>", "\u{0}", "%", "(", "url(#", "0 0 0",
    ];
    arbtest::arbtest(|u| {
        let mut bytes = EVERYTHING.as_bytes().to_vec();
        for _ in 0..u.int_in_range(1..=4)? {
            mutate(u, &mut bytes, &splices)?;
        }
        survive(&bytes, &String::from_utf8_lossy(&bytes));
        Ok(())
    })
    .budget_ms(2_000);
}

#[test]
fn robust_arbitrary_bytes() {
    arbtest::arbtest(|u| {
        let length = u.len();
        let bytes = u.bytes(length)?;
        survive(bytes, "bytes");
        let in_svg = [b"<svg width='9' height='9'><".as_slice(), bytes, b"></svg>"].concat();
        survive(&in_svg, "bytes in an element");
        Ok(())
    })
    .budget_ms(500);
}

#[test]
fn robust_deep_nesting() {
    let nested = |depth: usize, open: &str, close: &str| {
        svg(
            "width='9' height='9'",
            &format!(
                "{}<rect width='1' height='1'/>{}",
                open.repeat(depth),
                close.repeat(depth)
            ),
        )
    };
    for (open, close) in [
        ("<g>", "</g>"),
        ("<svg overflow='visible'>", "</svg>"),
        ("<unknown>", "</unknown>"),
    ] {
        accepted(nested(900, open, close).as_bytes(), open);
        // The course's dialect draws it; the library that reads SVG would not survive it.
        let lines = survive(nested(100_000, open, close).as_bytes(), open);
        let refused = lines.iter().filter(|line| line.contains("inside each other"));
        assert_eq!(refused.count(), lines.len(), "{open}: {lines:?}");
        assert!(lines.len() < 3, "{open}: the course's dialect draws it");
    }
    survive(nested(1_000, "<g opacity='.9'>", "</g>").as_bytes(), "layers");
    survive(
        nested(1_000, "<g transform='scale(10)'>", "</g>").as_bytes(),
        "growing transforms",
    );
    refused("<g>".repeat(200_000).as_bytes(), "never closed");
}

#[test]
fn robust_entities() {
    let level = |i: u32| format!("<!ENTITY a{} '{}'>", i + 1, format!("&a{i};").repeat(10));
    let mut bomb = String::from("<!DOCTYPE svg [<!ENTITY a0 'aaaaaaaaaa'>");
    bomb.extend((0..9).map(level));
    refused(
        format!("{bomb}]><svg>&a9;</svg>").as_bytes(),
        "bytes of expanded entities",
    );
    let loop_ = "<!DOCTYPE svg [<!ENTITY a '&b;'><!ENTITY b '&a;'>]><svg width='1' height='1'>&a;</svg>";
    refused(loop_.as_bytes(), "entity");
    let outside = "<!DOCTYPE svg [<!ENTITY a SYSTEM 'file:///etc/passwd'>]><svg width='1' height='1'>&a;</svg>";
    refused(outside.as_bytes(), "entity");
}

#[test]
fn robust_counts() {
    let many = |element: &str, n: usize| svg("width='9' height='9'", &element.repeat(n));
    accepted(
        many("<rect width='1' height='1'/>", 100_000).as_bytes(),
        "rects in one line",
    );
    accepted(many("\n<unknown/>", 100_000).as_bytes(), "unknown elements");
    accepted(many("<rect width='x' height='1'/>", 100_000).as_bytes(), "warnings");
    let names: Vec<String> = (0..50_000).map(|i| format!("<e{i}/>")).collect();
    accepted(
        svg("width='9' height='9'", &names.concat()).as_bytes(),
        "different unknown elements",
    );
    refused("<".repeat(9_000_000).as_bytes(), "tags");
    refused(
        svg("width='9' height='9'", &"=".repeat(9_000_000)).as_bytes(),
        "attributes",
    );
    refused(format!("<svg{}/>", " a=''".repeat(100_000)).as_bytes(), "attributes");
    let urls: Vec<String> = (0..5_000)
        .map(|i| format!("<image width='1' height='1' href='{i}.png'/>"))
        .collect();
    accepted(svg("width='9' height='9'", &urls.concat()).as_bytes(), "missing images");
    let words = format!("<polygon points='{}'/>", "x".repeat(5_000_000));
    accepted(svg("width='9' height='9'", &words).as_bytes(), "a long word");
}

#[test]
fn robust_polygons() {
    let polygon = |point: &dyn Fn(u32) -> [f64; 2], n: u32| {
        let points: Vec<String> = (0..n).map(|i| format!("{},{}", point(i)[0], point(i)[1])).collect();
        svg(
            "width='9' height='9'",
            &format!("<polygon points='{}'/>", points.join(" ")),
        )
    };
    let random = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 12);
    let circle = |i: u32| [0.0, 1.0].map(|quarter| (f64::from(i) * 6.2e-5 + quarter * 1.57).sin() * 100.0);
    accepted(polygon(&circle, 100_000).as_bytes(), "a round polygon");
    accepted(
        polygon(&|i| [f64::from(i), f64::from(i % 2) * 1e3], 100_000).as_bytes(),
        "a comb",
    );
    accepted(
        polygon(&|i| [random(i), random(i ^ 0x5555)], 50_000).as_bytes(),
        "a scribble",
    );
    accepted(polygon(&|i| [random(i), 3.0], 50_000).as_bytes(), "all on one line");
    accepted(polygon(&|_| [2.0, 3.0], 50_000).as_bytes(), "all in one place");
    accepted(
        polygon(&|i| [random(i) * 1e24, random(i + 9) * 1e-30], 1_000).as_bytes(),
        "extreme",
    );
}

#[cfg(unix)]
#[test]
fn robust_only_regular_files() {
    for path in ["/dev/zero", "/dev/null", "/", "/no/such/file", ""] {
        let error = scene::load(path.as_ref(), DialectChoice::Auto).expect_err(path);
        assert!(is_one_line(&error.to_string()), "{error}");
    }
    for path in ["/dev/zero", "/dev/stdin", "/", "../../../../../dev/zero"] {
        let document = svg(
            "width='1' height='1'",
            &format!("<image width='1' height='1' href='{path}'/>"),
        );
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("scene.svg");
        std::fs::write(&file, document).expect("written");
        let scene = scene::load(&file, DialectChoice::Auto).expect("a scene with a checker");
        assert_eq!(scene.report.warnings.len(), 1, "{path}: {:?}", scene.report);
    }
}
