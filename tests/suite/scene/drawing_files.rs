//! Drawings as files: compressed, without a size, in a namespace of their own, and drawings inside drawings.

use std::io::Write as _;

use flate2::Compression;
use flate2::write::GzEncoder;
use glam::DVec2;
use rasterscope::scene::{
    self, DialectChoice, FileDigest, FolderResources, PrimitiveKind, ReadOptions, Scene, SceneError, is_document,
};

use crate::support::documents::{area, kinds, lines, read, svg, try_read};

fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes).expect("memory");
    encoder.finish().expect("memory")
}

#[test]
fn compressed_documents_are_read() {
    let document = svg("width='10' height='10'", "\n<circle r='3'/>");
    let bytes = packed(document.as_bytes());
    let scene = try_read(&bytes, DialectChoice::Auto).expect("a scene");
    assert_eq!(
        scene.shapes.iter().filter(|shape| &*shape.element == "circle").count(),
        1
    );
    assert_eq!(scene.document.as_deref(), Some(&*document), "quoted as it was before");
    assert_eq!(
        scene.files.document,
        Some(FileDigest::of(&bytes)),
        "the file's own digest"
    );
    let course = packed(svg("width='10' height='10'", "<rect width='1' height='1'/>").as_bytes());
    let scene = try_read(&course, DialectChoice::Auto).expect("a scene");
    assert_eq!(scene.dialect, scene::Dialect::Course, "of either dialect");
    let line = |bytes: &[u8]| try_read(bytes, DialectChoice::Svg).expect_err("no scene").to_string();
    assert!(line(&bytes[..bytes.len() - 9]).contains("compressed document is damaged"));
    assert!(line(&[0x1f, 0x8b, 1, 2, 3]).contains("compressed document is damaged"));
    let bomb = packed(&vec![b' '; (256 << 20) + 1]);
    assert!(bomb.len() < 1 << 20, "small");
    assert_eq!(
        line(&bomb),
        "test.svg: cannot read: the file is larger than 256 MiB; give the path of an SVG file"
    );
    for (name, expected) in [("a.svg", true), ("a.SVGZ", true), ("a.svg.gz", false), ("svgz", false)] {
        assert_eq!(is_document(name.as_ref()), expected, "{name}");
    }
}

#[test]
fn documents_without_a_size_are_as_large_as_what_they_show() {
    let scene = read(&svg("", "<rect x='10' width='30' height='20'/>"), DialectChoice::Svg);
    assert_eq!(scene.canvas, DVec2::new(40.0, 20.0), "to the far corner");
    assert_eq!(
        lines(&scene),
        ["1:1: width, height or viewBox is missing; the canvas is 40 x 20"]
    );
    for attributes in [
        "width='0' height='5'",
        "width='10' height='-5'",
        "viewBox='0 0 0 5' width='0'",
    ] {
        let error = try_read(svg(attributes, "<g/>").as_bytes(), DialectChoice::Svg).expect_err(attributes);
        assert!(
            error.to_string().contains("give <svg> a width and height above zero"),
            "{error}"
        );
    }
}

#[test]
fn documents_of_another_namespace_are_drawings_too() {
    for document in [
        "<svg width='9' height='9'><circle r='3'/></svg>",
        "<svg xmlns='http://example.com/' width='9' height='9'><circle r='3'/></svg>",
        "<s:svg xmlns:s='http://example.com/' width='9' height='9'><s:circle r='3'/></s:svg>",
        "<s:svg xmlns:s='http://www.w3.org/2000/svg' width='9' height='9'><s:colortri points='0 0 9 0 0 9' colors='0 0 0 1 0 0 0 1 0 0 0 1'></s:colortri></s:svg>",
    ] {
        let scene = read(document, DialectChoice::Svg);
        assert_eq!(scene.primitives.len(), 1, "{document}");
        let told = lines(&scene);
        let is_of_svg = document.contains("w3.org");
        assert_eq!(told.len(), usize::from(!is_of_svg), "{document}: {told:?}");
        assert!(
            told.iter()
                .all(|line| line.contains("other programs draw it with xmlns=")),
            "{told:?}"
        );
    }
}

/// Reads `main` in a folder with these files.
fn in_folder(files: &[(&str, String)], main: &str) -> Result<Scene, SceneError> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("a writable folder");
    }
    let options = ReadOptions {
        dialect: DialectChoice::Svg,
    };
    let document = svg("width='100' height='100'", main);
    scene::read(
        document.as_bytes(),
        "test.svg",
        options,
        &FolderResources::new(folder.path()),
    )
}

#[test]
fn drawings_show_drawings() {
    let inner = svg(
        "width='10' height='20' viewBox='0 0 20 40'",
        "<rect id='r' width='20' height='40' fill='url(#g)'/><image href='secret.png' width='5' height='5'/>\
        <linearGradient id='g'><stop/><stop offset='1'/></linearGradient><script/>",
    );
    let files = [("in.svg", inner.clone())];
    let scene = in_folder(
        &files,
        "\n<image href='in.svg' x='5' width='20' height='20' opacity='.5'/>\n<image href='in.svg'/>",
    )
    .expect("a scene");
    let found = kinds(&scene);
    let gradients = found.iter().filter(|kind| {
        matches!(
            kind,
            PrimitiveKind::Polygon {
                fill: scene::Fill::Gradient(_),
                ..
            }
        )
    });
    assert_eq!(gradients.count(), 2, "{found:?}");
    assert!(
        (area(&scene) - 2.0 * (20.0 * 10.0 + 10.0 * 20.0)).abs() < 1e-2,
        "each, and what it is clipped to: {}",
        area(&scene)
    );
    let places: Vec<u32> = scene
        .primitives
        .iter()
        .map(|primitive| scene.shapes[primitive.shape.0 as usize].location.line)
        .collect();
    assert!(
        places.iter().all(|line| [2, 3].contains(line)),
        "everything is the image's: {places:?}"
    );
    assert_eq!(scene.textures.len(), 0, "what is shown loads no files");
    assert!(
        lines(&scene).iter().any(|line| line == "2:1: <script> is not drawn"),
        "{:?}",
        lines(&scene)
    );
    assert_eq!(
        scene.files.textures,
        [("in.svg".to_owned(), FileDigest::of(inner.as_bytes()))],
        "it was read"
    );
    let missing = in_folder(
        &[],
        "<image href='in.svg'/><image href='http://x/in.svg'/><image href='data:image/svg+xml,%3Cp/%3E'/>",
    )
    .expect("a scene");
    assert!(missing.primitives.is_empty(), "nothing to show");
    let told = lines(&missing);
    assert_eq!(told.len(), 3, "{told:?}");
    assert!(
        told[0].ends_with("image in.svg: there is no such file; it is not drawn") && told[1].contains("not fetched"),
        "{told:?}"
    );
}

#[test]
fn pictures_of_patterns_have_their_textures() {
    let png = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAQAAAACCAYAAAB/qH1jAAAAEklEQVR4nGP4z8DwHxkzoAsAAA8hD/EEN8afAAAAAElFTkSuQmCC";
    let body = format!(
        "<pattern id='p' width='4' height='2' patternUnits='userSpaceOnUse'><image href='{png}'/></pattern>\
         <rect width='9' height='9' fill='url(#p)'/><image href='{png}'/>"
    );
    let scene = in_folder(&[], &body).expect("a scene");
    assert_eq!((scene.textures.len(), scene.patterns.len()), (1, 1));
    assert_eq!(scene.patterns[0].tile.textures.len(), 1, "the tile has it too");
}

#[test]
fn pictures_that_end_too_soon_are_told() {
    let mut jpeg = Vec::new();
    let encoder = image::codecs::jpeg::JpegEncoder::new(&mut jpeg);
    let pixels: Vec<u8> = (0..64 * 64 * 3_u32)
        .map(|i| u8::try_from(i * i % 251).expect("below 251"))
        .collect();
    image::ImageEncoder::write_image(encoder, &pixels, 64, 64, image::ExtendedColorType::Rgb8).unwrap();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let told = |length: usize| {
        std::fs::write(folder.path().join("a.jpg"), &jpeg[..length]).expect("a writable folder");
        let document = svg(
            "width='99' height='99'",
            "\n<image href='a.jpg'/><image href='a.jpg' style='image-rendering:pixelated'/>",
        );
        let options = ReadOptions {
            dialect: DialectChoice::Svg,
        };
        let resources = FolderResources::new(folder.path());
        let scene = scene::read(document.as_bytes(), "test.svg", options, &resources).expect("a scene");
        lines(&scene)
    };
    assert_eq!(told(jpeg.len()), [""; 0], "a whole one");
    let cut = told(jpeg.len() / 2);
    assert_eq!(cut.len(), 1, "{cut:?}");
    assert!(
        cut[0].starts_with("2:1: texture a.jpg: the file ends before its picture does"),
        "{cut:?}"
    );
}
