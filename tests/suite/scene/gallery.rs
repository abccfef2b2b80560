//! The built-in gallery: nothing forgotten, nothing broken, and everything as the generator makes it.

#![expect(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use rasterscope::scene::{self, DialectChoice, ReadOptions, Scene};
use rasterscope::viewer::gallery::{GalleryScene, SCENES, TEXTURES, Textures};

#[path = "../../../assets/generate/catalogue.rs"]
mod catalogue;

/// What the gallery adds to the program and to every clone, at most, in bytes.
const MOST_BYTES: usize = 9 << 20;
/// The largest document, in bytes: larger ones are slow to open in an editor.
const MOST_BYTES_OF_A_SCENE: usize = 600 << 10;
/// Mean error of a texel's channel that JPEG of high quality may make, in 1/255.
const JPEG_ERROR: f64 = 6.0;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Study scenes that the generator does not make.
const BY_HAND: [&str; 11] = [
    "study/18_text_at_8_px.svg",
    "study/19_banding.svg",
    "study/20_conflation.svg",
    "study/21_fine_spokes.svg",
    "study/22_what_filters_cost.svg",
    "study/28_guessed_edges.svg",
    "study/29_what_guesses_miss.svg",
    "study/30_exact_greys.svg",
    "study/31_seams_of_a_mesh.svg",
    "study/33_nearly_level_edges.svg",
    "study/34_leaning_edges.svg",
];

/// The files below a folder, relative to it, with `/`.
fn files_below(folder: &Path) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut open = vec![PathBuf::new()];
    while let Some(inner) = open.pop() {
        for entry in fs::read_dir(folder.join(&inner)).unwrap() {
            let entry = entry.unwrap();
            let path = inner.join(entry.file_name());
            if entry.file_type().unwrap().is_dir() {
                open.push(path);
            } else {
                found.insert(path.to_str().unwrap().replace('\\', "/"));
            }
        }
    }
    found
}

fn read(scene: &GalleryScene) -> Scene {
    let options = ReadOptions {
        dialect: DialectChoice::Auto,
    };
    scene::read(scene.document.as_bytes(), scene.name, options, &Textures).unwrap()
}

#[test]
fn gallery_holds_every_scene_of_the_folder() {
    let listed: BTreeSet<String> = SCENES.iter().map(|scene| scene.name.to_owned()).collect();
    assert_eq!(
        listed,
        files_below(&root().join("svg")),
        "src/viewer/gallery.rs lists svg"
    );
    assert_eq!(listed.len(), SCENES.len(), "no scene is listed twice");
}

#[test]
fn gallery_holds_every_texture_of_the_folder() {
    let listed: BTreeSet<String> = TEXTURES.iter().map(|texture| texture.name.to_owned()).collect();
    let folder = files_below(&root().join("assets/textures"));
    assert_eq!(listed, folder, "src/viewer/gallery.rs lists assets/textures");
    for name in listed {
        let address = format!("../../assets/textures/{name}\"");
        assert!(
            SCENES.iter().any(|scene| scene.document.contains(&address)),
            "{name} is used by a scene"
        );
    }
}

#[test]
fn gallery_scenes_are_read_without_a_word() {
    for scene in SCENES {
        let read = read(scene);
        assert!(!read.primitives.is_empty(), "{}: paints something", scene.name);
        let words: Vec<String> = read.report.lines().collect();
        assert!(read.report.is_empty(), "{}: {words:?}", scene.name);
    }
}

#[test]
fn gallery_scenes_open_with_what_to_look_at() {
    for scene in SCENES {
        let name = scene.name;
        let after = scene
            .document
            .strip_prefix("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!--\n");
        let (comment, rest) = after.and_then(|text| text.split_once("\n-->\n")).unwrap_or_else(|| {
            panic!("{name}: a comment of its own lines stands between the declaration and the drawing")
        });
        assert!(rest.starts_with("<svg "), "{name}: the drawing follows the comment");
        let lines: Vec<&str> = comment.lines().collect();
        assert!((2..=5).contains(&lines.len()), "{name}: two to five lines");
        assert!(
            lines.iter().all(|line| line.chars().count() <= 130),
            "{name}: lines of at most 130 characters"
        );
    }
}

#[test]
fn gallery_stays_small() {
    let scenes: usize = SCENES.iter().map(|scene| scene.document.len()).sum();
    let textures: usize = TEXTURES.iter().map(|texture| texture.bytes.len()).sum();
    assert!(
        scenes + textures <= MOST_BYTES,
        "{scenes} bytes of scenes, {textures} of textures"
    );
    for scene in SCENES {
        assert!(
            scene.document.len() <= MOST_BYTES_OF_A_SCENE,
            "{}: {} bytes",
            scene.name,
            scene.document.len()
        );
    }
}

#[test]
fn generated_scenes_are_what_the_generator_makes() {
    let made = catalogue::scenes();
    for scene in &made {
        let committed = fs::read_to_string(root().join(scene.path)).unwrap();
        assert!(
            committed == (scene.make)(),
            "{}: run `cargo run --release --example make-assets`",
            scene.path
        );
    }
    // Written by hand, as people write SVG.
    let by_hand = |name: &&str| name.starts_with("vector/") || BY_HAND.contains(name);
    let written = SCENES.iter().map(|scene| scene.name).filter(by_hand).count();
    assert_eq!(
        made.len() + written,
        SCENES.len(),
        "all others are made by the generator"
    );
}

#[test]
fn generated_textures_are_what_the_generator_makes() {
    let made = catalogue::textures();
    for texture in &made {
        let path = texture.path;
        let committed = image::open(root().join(path)).unwrap().into_rgb8();
        let canvas = (texture.make)();
        assert_eq!(committed.dimensions(), (canvas.width, canvas.height), "{path}: size");
        let painted = canvas.bytes();
        if texture.is_jpeg() {
            let pairs = committed.iter().zip(&painted);
            let sum: f64 = pairs.map(|(&a, &b)| f64::from(a.abs_diff(b))).sum();
            let error = sum / painted.len() as f64;
            assert!(error < JPEG_ERROR, "{path}: mean error {error}");
        } else {
            assert!(
                *committed == *painted,
                "{path}: run `cargo run --release --example make-assets`"
            );
        }
    }
    assert_eq!(made.len(), TEXTURES.len(), "every texture is made by the generator");
}

#[test]
fn gallery_has_a_texture_of_3840_by_2160() {
    let sizes: Vec<(u32, u32)> = TEXTURES
        .iter()
        .map(|texture| image::load_from_memory(texture.bytes).unwrap())
        .map(|image| (image.width(), image.height()))
        .collect();
    assert!(sizes.contains(&(3840, 2160)), "one of {sizes:?}");
}
