//! The walls of the house: which room may name which room and which crate.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use super::imports::{paths, statements};

/// A room, the rooms it may import, and the guarded crates it may name.
struct Room {
    name: &'static str,
    rooms: &'static [&'static str],
    crates: &'static [&'static str],
}

/// The table of permitted imports. Every room may name itself, `std` and crates that are not guarded.
const ROOMS: &[Room] = &[
    Room {
        name: "main",
        rooms: &["cli"],
        crates: &[],
    },
    Room {
        name: "cli",
        rooms: &[
            "app", "viewer", "figure", "compare", "inspect", "render", "scene", "raster", "texture", "color",
            "geometry", "rules", "simd", "plain", "memory",
        ],
        crates: &[
            "clap",
            "clap_complete",
            "clap_mangen",
            "serde",
            "serde_json",
            "toml",
            "indicatif",
            "ctrlc",
            "signal_hook",
            "winsafe",
            "nix",
        ],
    },
    Room {
        name: "api",
        rooms: &["inspect", "render", "scene", "raster", "geometry", "memory"],
        crates: &[],
    },
    Room {
        name: "app",
        rooms: &[
            "viewer", "figure", "compare", "inspect", "render", "scene", "raster", "texture", "color", "geometry",
            "simd", "plain",
        ],
        crates: &[
            "winit",
            "softbuffer",
            "egui",
            "egui_winit",
            "fearless_simd",
            "notify",
            "etcetera",
            "open",
            "zbus",
            "smithay_client_toolkit",
            "wayland_client",
            "x11rb",
            "serde",
            "toml",
        ],
    },
    Room {
        name: "viewer",
        rooms: &[
            "figure", "compare", "inspect", "render", "scene", "post", "raster", "texture", "color", "geometry",
            "rules", "plain",
        ],
        crates: &["image", "jiff", "toml", "pulldown_cmark"],
    },
    Room {
        name: "figure",
        rooms: &[
            "compare", "render", "scene", "raster", "texture", "color", "geometry", "rules", "plain", "memory",
        ],
        crates: &[
            "image",
            "png",
            "ab_glyph",
            "epaint_default_fonts",
            "plotters",
            "serde",
            "serde_json",
        ],
    },
    Room {
        name: "compare",
        rooms: &[
            "render", "scene", "post", "raster", "texture", "color", "geometry", "rules", "simd",
        ],
        crates: &["fearless_simd", "rustfft"],
    },
    Room {
        name: "inspect",
        rooms: &[
            "render", "scene", "post", "raster", "texture", "color", "geometry", "rules", "plain",
        ],
        crates: &["serde"],
    },
    Room {
        name: "render",
        rooms: &["scene", "post", "raster", "texture", "color", "geometry", "rules"],
        crates: &[],
    },
    Room {
        name: "scene",
        rooms: &["texture", "color", "geometry", "rules", "plain", "memory"],
        crates: &[
            "roxmltree",
            "svgtypes",
            "usvg",
            "simplecss",
            "flate2",
            "epaint_default_fonts",
            "data_url",
            "sha2",
        ],
    },
    Room {
        name: "post",
        rooms: &["color", "rules", "simd"],
        crates: &["fearless_simd"],
    },
    Room {
        name: "raster",
        rooms: &["texture", "color", "geometry", "rules", "simd"],
        crates: &["fearless_simd"],
    },
    Room {
        name: "texture",
        rooms: &["color", "rules", "simd"],
        crates: &["image", "png", "fearless_simd"],
    },
    Room {
        name: "geometry",
        rooms: &["rules", "simd"],
        crates: &["kurbo", "i_triangle", "fearless_simd"],
    },
    Room {
        name: "color",
        rooms: &["rules", "simd"],
        crates: &["fearless_simd"],
    },
    Room {
        name: "rules",
        rooms: &[],
        crates: &[],
    },
    Room {
        name: "plain",
        rooms: &[],
        crates: &[],
    },
    Room {
        name: "memory",
        rooms: &[],
        crates: &[],
    },
    Room {
        name: "simd",
        rooms: &[],
        crates: &["fearless_simd"],
    },
];

/// Dependencies that every room may name: vectors, threads and errors.
const ANYWHERE: [&str; 3] = ["glam", "rayon", "thiserror"];

/// Crates that only the rooms of the table may name: all other dependencies, as code calls them.
static GUARDED: LazyLock<BTreeSet<String>> = LazyLock::new(|| {
    let manifest = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml")).expect("the manifest");
    guarded(&manifest)
});

/// The dependencies that a manifest names, those of single systems too, but for [`ANYWHERE`].
fn guarded(manifest: &str) -> BTreeSet<String> {
    let manifest: toml::Table = manifest.parse().expect("TOML");
    let systems = manifest.get("target").and_then(toml::Value::as_table);
    let of_systems = systems.into_iter().flat_map(toml::Table::values);
    let lists = of_systems.map(|system| system.get("dependencies"));
    lists
        .chain([manifest.get("dependencies")])
        .flatten()
        .filter_map(toml::Value::as_table)
        .flat_map(toml::Table::keys)
        .map(|name| name.replace('-', "_"))
        .filter(|name| !ANYWHERE.contains(&name.as_str()))
        .collect()
}

/// What is wrong with the code of a room, with the numbers of lines.
fn violations(room: &Room, text: &str) -> Vec<String> {
    let statements = statements(text).into_iter();
    statements
        .filter_map(|(number, code)| Some(format!("{number}: {}", violation(room, &code)?)))
        .collect()
}

/// What is wrong with a statement of a room's code.
fn violation(room: &Room, code: &str) -> Option<String> {
    let wrong = doors(code).into_iter().find(|door| match *door {
        Door::Room(other) => other != room.name && !room.rooms.contains(&other),
        Door::Crate(other) => !room.crates.contains(&other),
    });
    wrong.map(|door| format!("{} uses {door}", room.name))
}

/// What a room needs a permission for.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Door {
    Room(&'static str),
    Crate(&'static str),
}

impl fmt::Display for Door {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Room(name) => write!(f, "the room `{name}`"),
            Self::Crate(name) => write!(f, "the crate `{name}`"),
        }
    }
}

/// The rooms and guarded crates that a statement names.
fn doors(code: &str) -> Vec<Door> {
    let door = |path: String| {
        if let Some(inner) = path.strip_prefix("crate::").or(path.strip_prefix("rasterscope::")) {
            let first = inner.split("::").next()?;
            ROOMS
                .iter()
                .find(|room| room.name == first)
                .map(|room| Door::Room(room.name))
        } else {
            // A crate beside a module of its name is `::png`.
            let first = path.trim_start_matches("::").split("::").next()?;
            GUARDED.get(first).map(|name| Door::Crate(name))
        }
    };
    paths(code).into_iter().filter_map(door).collect()
}

/// What the table permits a room that no file of it does.
fn unused(room: &Room, used: &BTreeSet<Door>) -> Vec<String> {
    let rooms = room.rooms.iter().map(|name| Door::Room(name));
    let permitted = rooms.chain(room.crates.iter().map(|name| Door::Crate(name)));
    permitted
        .filter(|door| !used.contains(door))
        .map(|door| format!("{} is permitted {door} and has no use for it", room.name))
        .collect()
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the folder is there") {
        let path = entry.expect("a readable entry").path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn architecture_doors_open_downwards_only() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut all = Vec::new();
    files(&source, &mut all);
    let mut wrong = Vec::new();
    let mut used: BTreeMap<&str, BTreeSet<Door>> = BTreeMap::new();
    for path in all {
        let inner = path.strip_prefix(&source).expect("below src");
        let first = inner
            .components()
            .next()
            .expect("a name")
            .as_os_str()
            .to_string_lossy()
            .into_owned();
        let name = first.trim_end_matches(".rs");
        if name == "lib" {
            continue;
        }
        let Some(room) = ROOMS.iter().find(|room| room.name == name) else {
            wrong.push(format!("{}: `{name}` is no room of the house", inner.display()));
            continue;
        };
        let text = fs::read_to_string(&path).expect("readable source");
        let statements = statements(&text).into_iter();
        used.entry(room.name)
            .or_default()
            .extend(statements.flat_map(|(_, code)| doors(&code)));
        let broken = violations(room, &text).into_iter();
        wrong.extend(broken.map(|what| format!("{}:{what}", inner.display())));
    }
    assert!(wrong.is_empty(), "walls broken:\n{}", wrong.join("\n"));
    for room in ROOMS {
        assert!(used.contains_key(room.name), "{} was looked at", room.name);
        wrong.extend(unused(room, &used[room.name]));
    }
    assert!(wrong.is_empty(), "the table permits too much:\n{}", wrong.join("\n"));
}

/// No circle: the table lists rooms from the top down, and each may import what stands below it.
#[test]
fn architecture_rooms_stand_on_those_below() {
    for (place, room) in ROOMS.iter().enumerate() {
        for other in room.rooms {
            let below = ROOMS[place + 1..].iter().any(|room| room.name == *other);
            assert!(below, "{} imports {other}, which stands above it", room.name);
        }
    }
}

/// What the benchmarks may use: the engine, as any program could.
const BENCHES: Room = Room {
    name: "benches",
    rooms: &[
        "inspect", "render", "scene", "post", "raster", "texture", "color", "geometry", "rules", "simd",
    ],
    // usvg is the peers' reader too, and they get the typefaces that we have.
    crates: &["epaint_default_fonts", "serde_json", "sha2", "usvg"],
};

#[test]
fn architecture_benches_use_the_engine_only() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut all = Vec::new();
    files(&root.join("benches"), &mut all);
    let mut wrong = Vec::new();
    let mut used = BTreeSet::new();
    for path in &all {
        let text = fs::read_to_string(path).expect("readable source");
        used.extend(statements(&text).into_iter().flat_map(|(_, code)| doors(&code)));
        let broken = violations(&BENCHES, &text).into_iter();
        wrong.extend(broken.map(|what| format!("{}:{what}", path.display())));
    }
    wrong.extend(unused(&BENCHES, &used));
    assert!(wrong.is_empty(), "walls broken:\n{}", wrong.join("\n"));
    assert!(all.len() >= 5, "the benchmarks were looked at: {all:?}");
    assert!(
        !violations(&BENCHES, "use rasterscope::viewer::Viewer;").is_empty(),
        "the check bites"
    );
}

#[test]
fn architecture_checker_bites() {
    let room = |name: &str| ROOMS.iter().find(|room| room.name == name).expect("a room");
    let cases = [
        ("raster", "use crate::scene::Scene;", true),
        ("raster", "use crate::texture::Texture;", false),
        ("scene", "    let frame = crate::raster::Framebuffer::new(1, 1);", true),
        ("raster", "use crate::{color::Rgba, scene};", true),
        ("raster", "use crate::{\n    color::Rgba,\n    scene::Scene,\n};", true),
        (
            "raster",
            "use crate::{\n    color::Rgba, // not scene\n    texture,\n};",
            false,
        ),
        ("raster", "use crate::{texture::{Texture, scene}};", false),
        ("viewer", "use winit::window::Window;", true),
        ("app", "use winit::window::Window;", false),
        ("raster", "let _ = ctrlc::set_handler(stop);", true),
        ("viewer", "use x11rb::connection::Connection;", true),
        ("raster", "use rayon::prelude::*;", false),
        ("viewer", "use egui_winit::State;", true),
        ("geometry", "let doc = roxmltree::Document::parse(text);", true),
        ("scene", "let doc = roxmltree::Document::parse(text);", false),
        ("texture", "use crate::render::draw;", true),
        ("texture", "use fearless_simd::Simd;", false),
        ("scene", "use fearless_simd::Simd;", true),
        ("main", "use rasterscope::raster::Framebuffer;", true),
        ("raster", "// crate::scene::Scene is what this must not see", false),
    ];
    for (name, text, bites) in cases {
        assert_eq!(!violations(room(name), text).is_empty(), bites, "{name}: {text}");
    }
    let later = "\nuse crate::color;\npub use crate::{\n    scene,\n};\nuse crate::render;";
    assert_eq!(
        violations(room("raster"), later),
        ["3: raster uses the room `scene`", "6: raster uses the room `render`"]
    );
}

#[test]
fn architecture_guards_every_dependency() {
    let manifest = "[dependencies]\nclap-complete = \"4\"\nglam = \"1\"\n[dev-dependencies]\ntempfile = \"3\"\n\
                    [target.'cfg(unix)'.dependencies]\nsignal-hook = { version = \"0.4\", optional = true }\n";
    assert!(
        guarded(manifest).iter().eq(["clap_complete", "signal_hook"]),
        "{:?}",
        guarded(manifest)
    );
    let permitted = ROOMS.iter().flat_map(|room| room.crates);
    let unknown: Vec<_> = permitted.filter(|name| !GUARDED.contains(**name)).collect();
    assert!(unknown.is_empty(), "no dependency is called {unknown:?}");
    assert!(
        ANYWHERE.iter().all(|name| !GUARDED.contains(*name)) && GUARDED.len() > 30,
        "the manifest was read: {GUARDED:?}"
    );
}

#[test]
fn architecture_finds_permissions_without_use() {
    let room = Room {
        name: "scene",
        rooms: &["color", "texture"],
        crates: &["png", "usvg"],
    };
    let code = "use ::png::Decoder; fn f(_: crate::color::Rgba) {}";
    let used = doors(code).into_iter().collect();
    assert_eq!(
        unused(&room, &used),
        [
            "scene is permitted the room `texture` and has no use for it",
            "scene is permitted the crate `usvg` and has no use for it"
        ]
    );
}
