//! Which families of typefaces are meant by the names that documents use: those of a kind by its generic name, and those whose
//! letters are as wide by the names of common ones that a machine may not have.

use std::path::PathBuf;

use usvg::FontFamily;
use usvg::fontdb::{Database, FaceInfo, Source};

/// What text is set in that asks for nothing: usvg takes this for the name of a family.
pub(super) const UNNAMED: &str = "serif";

/// A generic family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Serif,
    Sans,
    Cursive,
    Fantasy,
    Mono,
}

/// What a document asks for by one name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Asked<'a> {
    Kind(Kind),
    Named(&'a str),
    /// Nothing: the text has no family.
    Nothing,
}

/// The usual families of each kind, in the order in which they are looked for, and the one that comes with the program.
const OF_KINDS: [(Kind, &[&str], &str); 5] = [
    (
        Kind::Serif,
        &[
            "Times New Roman",
            "Liberation Serif",
            "DejaVu Serif",
            "Noto Serif",
            "Times",
            "Nimbus Roman",
            "FreeSerif",
            "Georgia",
        ],
        "Ubuntu",
    ),
    (
        Kind::Sans,
        &[
            "Arial",
            "Liberation Sans",
            "DejaVu Sans",
            "Noto Sans",
            "Helvetica",
            "Nimbus Sans",
            "FreeSans",
            "Verdana",
        ],
        "Ubuntu",
    ),
    (
        Kind::Cursive,
        &[
            "Comic Sans MS",
            "Comic Neue",
            "Apple Chancery",
            "Z003",
            "URW Chancery L",
        ],
        "Ubuntu",
    ),
    (Kind::Fantasy, &["Impact", "Papyrus", "Anton"], "Ubuntu"),
    (
        Kind::Mono,
        &[
            "Courier New",
            "Liberation Mono",
            "DejaVu Sans Mono",
            "Noto Sans Mono",
            "Courier",
            "Nimbus Mono PS",
            "FreeMono",
            "Menlo",
            "Consolas",
        ],
        "Hack",
    ),
];

/// Families whose letters are equally wide, of a kind: each stands for any other.
const AS_WIDE: [(Kind, &[&str]); 3] = [
    (
        Kind::Sans,
        &[
            "Arial",
            "Helvetica",
            "Liberation Sans",
            "Arimo",
            "Nimbus Sans",
            "Nimbus Sans L",
            "TeX Gyre Heros",
        ],
    ),
    (
        Kind::Serif,
        &[
            "Times New Roman",
            "Times",
            "Liberation Serif",
            "Tinos",
            "Nimbus Roman",
            "Nimbus Roman No9 L",
            "TeX Gyre Termes",
        ],
    ),
    (
        Kind::Mono,
        &[
            "Courier New",
            "Courier",
            "Liberation Mono",
            "Cousine",
            "Nimbus Mono PS",
            "Nimbus Mono L",
            "TeX Gyre Cursor",
        ],
    ),
];

/// Names of kinds as CSS writes them, also newer ones.
const NAMES: [(&str, Kind); 10] = [
    ("serif", Kind::Serif),
    ("sans-serif", Kind::Sans),
    ("cursive", Kind::Cursive),
    ("fantasy", Kind::Fantasy),
    ("monospace", Kind::Mono),
    ("system-ui", Kind::Sans),
    ("ui-sans-serif", Kind::Sans),
    ("ui-rounded", Kind::Sans),
    ("ui-serif", Kind::Serif),
    ("ui-monospace", Kind::Mono),
];

impl Kind {
    /// As CSS calls it.
    pub(super) fn name(self) -> &'static str {
        NAMES
            .iter()
            .find(|(_, kind)| *kind == self)
            .map_or(UNNAMED, |(name, _)| name)
    }
}

impl<'a> Asked<'a> {
    /// By a family as usvg hands it on.
    pub(super) fn by(family: &'a FontFamily) -> Self {
        match family {
            FontFamily::Serif => Self::Kind(Kind::Serif),
            FontFamily::SansSerif => Self::Kind(Kind::Sans),
            FontFamily::Cursive => Self::Kind(Kind::Cursive),
            FontFamily::Fantasy => Self::Kind(Kind::Fantasy),
            FontFamily::Monospace => Self::Kind(Kind::Mono),
            FontFamily::Named(name) if name == UNNAMED => Self::Nothing,
            FontFamily::Named(name) => {
                let kind = NAMES.iter().find(|(known, _)| known.eq_ignore_ascii_case(name));
                kind.map_or(Self::Named(name), |(_, kind)| Self::Kind(*kind))
            }
        }
    }

    /// Its kind, where that is known; a text without a family has letters with serifs, as in browsers.
    pub(super) fn kind(self) -> Option<Kind> {
        match self {
            Self::Kind(kind) => Some(kind),
            Self::Nothing => Some(Kind::Serif),
            Self::Named(name) => as_wide(name).map(|(kind, _)| *kind),
        }
    }
}

/// The family of this name as the typefaces write it; upper and lower case are the same (CSS Fonts 4, section 5.1).
pub(super) fn spelled<'d>(database: &'d Database, name: &str) -> Option<&'d str> {
    let lower = name.to_lowercase();
    let mut known = database.faces().flat_map(|face| &face.families);
    let found = known.find(|(known, _)| known == name || known.to_lowercase() == lower);
    found.map(|(known, _)| known.as_str())
}

/// The families of a kind that are there, the first first; those in `more`, files and folders that the user named, before all
/// others, and the shipped one not at all.
pub(super) fn of_kind<'d>(database: &'d Database, kind: Kind, more: &[PathBuf]) -> Vec<&'d str> {
    let usual = OF_KINDS
        .iter()
        .find(|(of, ..)| *of == kind)
        .map_or(&[][..], |row| row.1);
    let mut found: Vec<&str> = usual.iter().filter_map(|name| spelled(database, name)).collect();
    let given = database.faces().filter(|face| is_in(face, more));
    let mut given: Vec<(bool, &str)> = given
        .filter_map(|face| Some((face.monospaced, face.families.first()?.0.as_str())))
        .collect();
    // The order of files in a folder is nobody's choice.
    given.sort_unstable();
    given.dedup();
    let is_given = |name: &&str| given.iter().any(|(_, given)| given == name);
    let (mut first, rest): (Vec<&str>, Vec<&str>) = found.drain(..).partition(is_given);
    first.extend(rest);
    // Those that nobody has heard of may be of the kind, too.
    let fitting = given.iter().filter(|(is_mono, _)| *is_mono == (kind == Kind::Mono));
    for (_, name) in fitting {
        if !first.contains(name) {
            first.push(name);
        }
    }
    first
}

/// The family that comes with the program for a kind, and whether it is of that kind.
pub(super) fn shipped(kind: Kind) -> (&'static str, bool) {
    let row = OF_KINDS.iter().find(|(of, ..)| *of == kind);
    (
        row.map_or("Ubuntu", |row| row.2),
        matches!(kind, Kind::Sans | Kind::Mono),
    )
}

/// The first family that is there whose letters are as wide as those of this one, which is not.
pub(super) fn instead<'d>(database: &'d Database, name: &str) -> Option<&'d str> {
    let (_, names) = as_wide(name)?;
    names.iter().find_map(|name| spelled(database, name))
}

fn as_wide(name: &str) -> Option<&'static (Kind, &'static [&'static str])> {
    let is_one = |names: &[&str]| names.iter().any(|known| known.eq_ignore_ascii_case(name));
    AS_WIDE.iter().find(|(_, names)| is_one(names))
}

/// Whether a face is of these files and folders.
fn is_in(face: &FaceInfo, more: &[PathBuf]) -> bool {
    let (Source::File(path) | Source::SharedFile(path, _)) = &face.source else {
        return false;
    };
    more.iter().any(|given| path.starts_with(given))
}
