//! The floors inside the rooms: imports go down, and no files import each other in a circle.
//!
//! Imports are read from the code: every path from `crate::ROOM`, `super` or `self`, through braces and re-exports. Tests
//! at a file's end may look everywhere.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use super::imports::{Module, tree_paths};

/// A room whose parts stand on floors.
struct House {
    room: &'static str,
    /// Files and folders, bottom up: each may import those before it.
    floors: &'static [&'static str],
    /// Files of tests only.
    tests: &'static [&'static str],
}

const HOUSES: &[House] = &[
    House {
        room: "viewer",
        floors: &[
            "key_chords",
            "jobs",
            "settings",
            "chrome",
            "view",
            "library",
            "frames",
            "ab",
            "inspector",
            "profile",
            "spectrum",
            "export",
            "board",
            "lesson",
            "command",
            "state",
            "control",
            "script",
            "slides",
        ],
        tests: &[],
    },
    House {
        room: "raster",
        floors: &[
            "surface_id",
            "stats",
            "sampling",
            "span",
            "tile_layout",
            "resolve",
            "settings",
            "attributes",
            "shading",
            "layers",
            "coverage",
            "list",
            "binning",
            "frame",
            "paint",
            "display_list",
            "tiles",
            "rasterizer",
            "refine",
            "explain",
        ],
        tests: &["random"],
    },
];

/// Rooms in which no files import each other in a circle.
const WITHOUT_CIRCLES: &[&str] = &[
    "app", "cli", "color", "compare", "figure", "geometry", "inspect", "post", "raster", "render", "scene", "texture",
    "viewer",
];

/// The files of a room, and which of them each imports.
struct Imports {
    texts: BTreeMap<Module, String>,
    of: BTreeMap<Module, BTreeSet<Module>>,
}

impl Imports {
    fn of_room(room: &str) -> Self {
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let mut texts = BTreeMap::new();
        gather(&source.join(room), &mut Vec::new(), &mut texts);
        let beside = source.join(format!("{room}.rs"));
        if let Ok(text) = fs::read_to_string(beside) {
            texts.insert(Vec::new(), code(&text));
        }
        Self::of_texts(room, texts)
    }

    fn of_texts(room: &str, texts: BTreeMap<Module, String>) -> Self {
        let mut all = Self {
            texts,
            of: BTreeMap::new(),
        };
        for (module, text) in &all.texts {
            let found = paths(room, module, text);
            let targets = found.iter().filter_map(|path| all.file_of(room, path));
            all.of
                .insert(module.clone(), targets.filter(|target| target != module).collect());
        }
        all
    }

    /// The file in which the item at `path` stands; `None` for the room's front door.
    fn file_of(&self, room: &str, path: &[String]) -> Option<Module> {
        let longest = (0..=path.len())
            .rev()
            .find(|length| self.texts.contains_key(&path[..*length]))?;
        let (module, rest) = path.split_at(longest);
        let item = rest.first();
        let exported = item.and_then(|item| {
            let exports = exports(room, module, &self.texts[module]);
            exports
                .into_iter()
                .find(|path| path.last() == Some(item) && path.len() > module.len() + 1)
        });
        match exported {
            Some(path) => self.file_of(room, &path),
            None if module.is_empty() => None,
            None => Some(module.to_vec()),
        }
    }

    /// Files that import each other, each group once.
    fn circles(&self) -> Vec<BTreeSet<&Module>> {
        let reached: BTreeMap<&Module, BTreeSet<&Module>> = self
            .of
            .keys()
            .map(|module| (module, self.reached_from(module)))
            .collect();
        let mut circles = Vec::new();
        for (module, reaches) in &reached {
            let circle: BTreeSet<&Module> = reaches
                .iter()
                .copied()
                .filter(|other| reached[other].contains(module))
                .collect();
            if !circle.is_empty() && !circles.contains(&circle) {
                circles.push(circle);
            }
        }
        circles
    }

    fn reached_from<'s>(&'s self, module: &Module) -> BTreeSet<&'s Module> {
        let mut reached = BTreeSet::new();
        let mut open: Vec<&Module> = self.of[module].iter().collect();
        while let Some(next) = open.pop() {
            if reached.insert(next) {
                open.extend(&self.of[next]);
            }
        }
        reached
    }
}

/// The files below a folder, without their tests and comments.
fn gather(folder: &Path, at: &mut Module, texts: &mut BTreeMap<Module, String>) {
    for entry in fs::read_dir(folder).expect("the folder is there") {
        let path = entry.expect("a readable entry").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        if path.is_dir() && name == "tests" {
            continue;
        }
        if path.is_dir() {
            at.push(name);
            gather(&path, at, texts);
            at.pop();
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = code(&fs::read_to_string(&path).expect("readable source"));
            let mut module = at.clone();
            if name != "mod" {
                module.push(name);
            }
            texts.insert(module, text);
        }
    }
}

/// A file's text without its tests at the end, and without comments.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or("");
    text.lines()
        .map(|line| line.split("//").next().unwrap_or(""))
        .collect::<Vec<_>>()
        .join("\n")
}

/// Every path in the text of a file that leads to its own room, from the room's front door on.
fn paths(room: &str, module: &[String], text: &str) -> Vec<Module> {
    let own = format!("crate::{room}::");
    // A file's parent; that of a folder's own file is the folder's parent.
    let parent = module.split_last().map_or(&[][..], |(_, parent)| parent);
    let mut found = Vec::new();
    for (prefix, base) in [(own.as_str(), &[][..]), ("super::", parent), ("self::", module)] {
        for (start, _) in text.match_indices(prefix) {
            let before = text[..start].chars().next_back();
            if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':') {
                continue;
            }
            // Re-exports are doors, not imports.
            let line = text[..start].lines().next_back().unwrap_or("").trim_start();
            if !line.starts_with("pub use") && !line.starts_with("pub(") {
                let (base, tree) = climbed(base, &text[start + prefix.len()..]);
                tree_paths(base, tree, &mut found);
            }
        }
    }
    found
}

/// Leaves further `super::` behind.
fn climbed<'t>(mut base: &[String], mut tree: &'t str) -> (Module, &'t str) {
    while let Some(rest) = tree.strip_prefix("super::") {
        base = base.split_last().map_or(&[][..], |(_, base)| base);
        tree = rest;
    }
    (base.to_vec(), tree)
}

/// What a file re-exports, as paths from the front door.
fn exports(room: &str, module: &[String], text: &str) -> Vec<Module> {
    let mut found = Vec::new();
    for statement in text.split(';').map(str::trim_start) {
        let Some((visibility, tree)) = statement.rsplit_once("use ") else {
            continue;
        };
        if visibility.trim_start().starts_with("pub") || visibility.contains("\npub") {
            let tree = tree.strip_prefix("self::").unwrap_or(tree);
            let own = tree.strip_prefix(&format!("crate::{room}::"));
            let base = if own.is_some() { Vec::new() } else { module.to_vec() };
            tree_paths(base, own.unwrap_or(tree), &mut found);
        }
    }
    found
}

/// What is wrong with the imports of a room by its floors.
fn broken(house: &House, imports: &Imports) -> Vec<String> {
    let floor = |module: &Module| {
        let first = module.first()?;
        house.floors.iter().position(|floor| floor == first)
    };
    let mut wrong = Vec::new();
    for (module, targets) in &imports.of {
        let is_test = module
            .first()
            .is_some_and(|first| house.tests.contains(&first.as_str()));
        if module.is_empty() || is_test {
            continue;
        }
        let name = module.join("/");
        let Some(own) = floor(module) else {
            wrong.push(format!("{}/{name} stands on no floor", house.room));
            continue;
        };
        for target in targets.iter().filter(|target| target.first() != module.first()) {
            if floor(target).is_none_or(|other| other >= own) {
                wrong.push(format!("{}/{name} imports {} from above", house.room, target.join("/")));
            }
        }
    }
    wrong
}

#[test]
fn floors_are_imported_downwards_only() {
    for house in HOUSES {
        let imports = Imports::of_room(house.room);
        let wrong = broken(house, &imports);
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
        let count: usize = imports.of.values().map(BTreeSet::len).sum();
        assert!(count > imports.of.len(), "imports were found: {count}");
        for floor in house.floors {
            let is_there = imports
                .of
                .keys()
                .any(|module| module.first().is_some_and(|first| first == floor));
            assert!(is_there, "{} has {floor}", house.room);
        }
    }
}

#[test]
fn floors_have_no_circles() {
    for room in WITHOUT_CIRCLES {
        let imports = Imports::of_room(room);
        let circles = imports.circles();
        assert!(circles.is_empty(), "{room}: {circles:?}");
    }
}

/// Files by their names, with their texts; `front` is the room's front door.
fn imports_of(files: &[(&str, &str)]) -> Imports {
    let front = [("", "pub use low::a::Item;\npub use high::{Other, c::{D, E}};")];
    let texts = files.iter().chain(&front).map(|(name, text)| {
        let module = name.split('/').filter(|part| !part.is_empty());
        (module.map(str::to_owned).collect(), code(text))
    });
    Imports::of_texts("raster", texts.collect())
}

#[test]
fn floors_checker_bites() {
    let house = House {
        room: "raster",
        floors: &["low", "high"],
        tests: &["random"],
    };
    let of_low = [
        ("use crate::raster::high::Other;", 1, "up"),
        ("use super::super::Other;", 1, "by the front door"),
        ("use crate::raster::{high::{Other, More}, low};", 1, "through braces"),
        ("fn f() -> crate::raster::E {}", 1, "without an import"),
        ("use super::b::B;", 0, "on the same floor"),
        ("// crate::raster::high::Other", 0, "a comment"),
        (
            "#[cfg(test)]\nmod tests {\n use crate::raster::high::Other;\n}",
            0,
            "a test",
        ),
    ];
    for (text, expected, what) in of_low {
        let imports = imports_of(&[("low/a", text), ("low/b", ""), ("high", ""), ("random", text)]);
        let wrong = broken(&house, &imports);
        assert_eq!(wrong.len(), expected, "{what}: {wrong:?}");
    }
    let down = [("low/a", ""), ("high", "use crate::raster::low::a::Item;")];
    assert!(broken(&house, &imports_of(&down)).is_empty(), "down");
    let cellar = imports_of(&[("low/a", ""), ("high", ""), ("cellar", "")]);
    assert_eq!(broken(&house, &cellar), ["raster/cellar stands on no floor"]);
    let circle = imports_of(&[("low/a", "use super::b::B;"), ("low/b", "fn f() -> super::a::Item {}")]);
    assert_eq!(circle.circles().len(), 1, "{:?}", circle.of);
    let line = imports_of(&[("low/a", "use super::b::B;"), ("low/b", "")]);
    assert!(line.circles().is_empty(), "{:?}", line.of);
}
