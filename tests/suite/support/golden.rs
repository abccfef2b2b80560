//! Golden pictures: comparing, showing the difference, and blessing.
//!
//! `BLESS=1 cargo test golden` rewrites the pictures that fail, and still fails, so that a blessed run is never green.
//! A failure writes expected, difference and actual side by side below `target/golden-diff`.

use std::fs;
use std::path::{Path, PathBuf};

use rasterscope::figure::save_png;
use rasterscope::raster::Framebuffer;

/// Compares a frame with `tests/golden/NAME.png`. Channels may differ by `tolerance`. Says what is wrong.
pub(crate) fn check(name: &str, frame: &Framebuffer, tolerance: u8) -> Result<(), String> {
    let path = folder().join(format!("{name}.png"));
    let problem = match read(&path) {
        Err(error) => format!("{name}: no golden picture: {error}"),
        Ok(expected) => match compare(&expected, frame, tolerance) {
            None => return Ok(()),
            Some(difference) => {
                let diff = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("golden-diff");
                fs::create_dir_all(&diff).expect("a writable target folder");
                save_png(&triptych(&expected, frame), &diff.join(format!("{name}.png"))).expect("writable");
                format!(
                    "{name}: {difference}; see {}",
                    diff.join(format!("{name}.png")).display()
                )
            }
        },
    };
    if std::env::var_os("BLESS").is_some_and(|value| value == "1") {
        fs::create_dir_all(path.parent().expect("a folder")).expect("writable");
        save_png(frame, &path).expect("a writable golden folder");
        return Err(format!("{problem}; blessed"));
    }
    Err(problem)
}

/// Holds a table in the project's document `file`, between the lines `start` and `end`, against the one that it should be.
///
/// # Panics
/// Where it is another one; blessed, it is written anew first.
pub(crate) fn check_table(file: &str, [start, end]: [&str; 2], expected: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let text = fs::read_to_string(&path).expect("the document");
    let (before, rest) = text.split_once(start).expect("the table's beginning");
    let (found, after) = rest.split_once(end).expect("the table's end");
    let expected = expected.trim();
    if found.trim() == expected {
        return;
    }
    if std::env::var_os("BLESS").is_some_and(|value| value == "1") {
        fs::write(&path, format!("{before}{start}\n{expected}\n\n{end}{after}")).expect("a writable document");
        panic!("the table in {file} was written anew");
    }
    panic!("the table in {file} is another one now: run with BLESS=1");
}

/// Where the golden pictures lie.
pub(crate) fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden")
}

fn read(path: &Path) -> Result<Framebuffer, String> {
    let picture = image::open(path).map_err(|error| error.to_string())?.into_rgba8();
    let mut frame = Framebuffer::new(picture.width(), picture.height());
    for (pixel, rgba) in frame.pixels_mut().iter_mut().zip(picture.pixels()) {
        let [r, g, b, a] = rgba.0;
        *pixel = u32::from_be_bytes([a, r, g, b]);
    }
    Ok(frame)
}

/// How two frames differ, in words.
fn compare(expected: &Framebuffer, actual: &Framebuffer, tolerance: u8) -> Option<String> {
    let size = |frame: &Framebuffer| (frame.width(), frame.height());
    if size(expected) != size(actual) {
        return Some(format!("size {:?} instead of {:?}", size(actual), size(expected)));
    }
    let mut count = 0;
    let mut worst = (0, 0);
    for (i, (a, b)) in expected.pixels().iter().zip(actual.pixels()).enumerate() {
        let largest = largest_difference(*a, *b);
        if largest > tolerance {
            count += 1;
            worst = worst.max((largest, i));
        }
    }
    let (largest, at) = worst;
    let (x, y) = (at % expected.width() as usize, at / expected.width() as usize);
    (count > 0).then(|| {
        format!(
            "{count} pixels differ by more than {tolerance}, the worst, ({x}, {y}), by {largest}: {:08x} instead of {:08x}",
            actual.pixels()[at],
            expected.pixels()[at]
        )
    })
}

fn largest_difference(a: u32, b: u32) -> u8 {
    a.to_be_bytes()
        .iter()
        .zip(b.to_be_bytes())
        .map(|(a, b)| a.abs_diff(b))
        .max()
        .unwrap_or(0)
}

/// Expected, amplified difference, actual.
fn triptych(expected: &Framebuffer, actual: &Framebuffer) -> Framebuffer {
    let (width, height) = (
        expected.width().max(actual.width()),
        expected.height().max(actual.height()),
    );
    let mut sheet = Framebuffer::new(3 * width, height);
    let pixel = |frame: &Framebuffer, x, y| {
        frame
            .rgba(x, y)
            .map_or(0, |[r, g, b, a]| u32::from_be_bytes([a, r, g, b]))
    };
    for y in 0..height {
        for x in 0..width {
            let (a, b) = (pixel(expected, x, y), pixel(actual, x, y));
            let level = u32::from(largest_difference(a, b).saturating_mul(8));
            let shown = [a, 0xFF00_0000 | level << 16 | level << 8 | level, b];
            for (column, shown) in (0..).zip(shown) {
                sheet.pixels_mut()[(y * 3 * width + column * width + x) as usize] = shown;
            }
        }
    }
    sheet
}

#[test]
fn golden_comparison_sees_one_level_of_one_pixel() {
    let mut a = Framebuffer::new(4, 3);
    a.pixels_mut().fill(0xFF10_2030);
    let mut b = a.clone();
    assert_eq!(compare(&a, &b, 0), None, "alike");
    b.pixels_mut()[5] = 0xFF10_2130;
    assert!(
        compare(&a, &b, 0).is_some_and(|text| text.contains("(1, 1)")),
        "one level"
    );
    assert_eq!(compare(&a, &b, 1), None, "within a tolerance of one");
    assert!(compare(&a, &Framebuffer::new(4, 4), 255).is_some(), "another size");
}
