//! Typefaces for text: those of the system, those that the user names, and two that are always there. Which families a name
//! stands for is said in `families`.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use usvg::fontdb::{Database, Family, ID, Query, Source, Stretch, Style, Weight};
use usvg::{Font, FontResolver, FontStretch, FontStyle};

use super::fallback::{Fallbacks, Instead};
use super::families::{self, Asked, Kind};

/// Where typefaces come from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Fonts {
    /// Whether the system's are used. Without them text is the same on every machine.
    pub system: bool,
    /// More files, and folders of files.
    pub more: Vec<PathBuf>,
}

/// Typefaces as they are asked for, and those found so far.
static CHOSEN: Mutex<(Option<Fonts>, Option<Arc<Database>>)> = Mutex::new((None, None));

/// From now on text is set in these. Until this is called, only in the typefaces that come with the program.
///
/// # Errors
/// The path that holds no typeface.
pub fn set_fonts(fonts: Fonts) -> Result<(), PathBuf> {
    for path in &fonts.more {
        let mut found = Database::new();
        add(&mut found, path);
        if found.is_empty() {
            return Err(path.clone());
        }
    }
    *CHOSEN.lock().unwrap_or_else(PoisonError::into_inner) = (Some(fonts), None);
    Ok(())
}

/// The files and folders of typefaces that were chosen besides the system's.
pub fn more_fonts() -> Vec<PathBuf> {
    let chosen = CHOSEN.lock().unwrap_or_else(PoisonError::into_inner);
    chosen.0.as_ref().map_or_else(Vec::new, |fonts| fonts.more.clone())
}

/// The typefaces, which are looked for when the first document has text.
pub(super) fn database() -> Arc<Database> {
    let mut chosen = CHOSEN.lock().unwrap_or_else(PoisonError::into_inner);
    let (fonts, found) = &mut *chosen;
    Arc::clone(found.get_or_insert_with(|| Arc::new(gathered(&fonts.clone().unwrap_or_default()))))
}

fn gathered(fonts: &Fonts) -> Database {
    let mut database = Database::new();
    for shipped in [epaint_default_fonts::UBUNTU_LIGHT, epaint_default_fonts::HACK_REGULAR] {
        database.load_font_source(Source::Binary(Arc::new(shipped)));
    }
    for path in &fonts.more {
        add(&mut database, path);
    }
    if fonts.system {
        database.load_system_fonts();
    }
    database
}

fn add(database: &mut Database, path: &std::path::Path) {
    if path.is_dir() {
        database.load_fonts_dir(path);
    } else {
        // A file that is none leaves the database as it is.
        let _ = database.load_font_file(path);
    }
}

/// What a document asks for and the machine has not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Missing {
    /// The families of a list, and what is taken instead.
    Family(String, Option<String>),
    /// A bold or an inclined face of a family that is there.
    Face(&'static str, String),
    /// A character that no typeface has. Others may be missing as well: usvg looks for one in each chunk of text.
    Character(char),
    /// A character of another typeface, which stands for the text around it, too.
    Around(char, String),
}

impl Missing {
    /// Whether it needs no line of its own beside those of others.
    pub(super) fn is_told_by(&self, others: &[Self]) -> bool {
        let is_like = |other: &Self| match (self, other) {
            (Self::Character(_), Self::Character(_)) => true,
            (Self::Around(_, family), Self::Around(_, other)) => family == other,
            _ => self == other,
        };
        others.iter().any(is_like)
    }

    /// One line about it.
    pub(super) fn message(&self) -> Option<String> {
        let quote = crate::scene::report::quote;
        Some(match self {
            Self::Family(family, instead) => format!(
                "there is no typeface {}; {} is taken instead (--font adds more)",
                quote(family),
                quote(instead.as_deref()?)
            ),
            Self::Face(kind, family) => format!(
                "there is no {kind} face of {}; another one is taken instead (--font adds more)",
                quote(family)
            ),
            Self::Character(character) => format!(
                "there is no typeface with the character {} (U+{:04X}); a box stands for it and for others like it (--font adds more)",
                quote(&character.to_string()),
                u32::from(*character)
            ),
            Self::Around(character, family) => format!(
                "the typeface of a text has no character {} (U+{:04X}); all of the text may be set in {}, which has it (--font adds more)",
                quote(&character.to_string()),
                u32::from(*character),
                quote(family)
            ),
        })
    }
}

/// Chooses typefaces, and tells of the families, faces and characters that are missing.
pub(super) fn resolver<'a>(
    fallbacks: &'a Fallbacks,
    tell: impl Fn(Missing) + Clone + Send + Sync + 'a,
) -> FontResolver<'a> {
    let tell_of_character = tell.clone();
    let more = more_fonts();
    FontResolver {
        select_font: Box::new(move |font, database| {
            let (found, missing) = chosen(database, &Wanted::by(font), &more);
            for missing in missing {
                tell(missing);
            }
            found
        }),
        select_fallback: Box::new(
            move |character, tried, database| match fallbacks.find(character, tried, database) {
                Some(Instead::Part(found)) => Some(found),
                Some(Instead::Whole(found)) => {
                    tell_of_character(Missing::Around(character, name(database, found)?));
                    Some(found)
                }
                None => {
                    if !character.is_whitespace() && !character.is_control() {
                        tell_of_character(Missing::Character(character));
                    }
                    None
                }
            },
        ),
    }
}

/// What a text wants to be set in.
#[derive(Clone, Debug)]
struct Wanted<'a> {
    families: Vec<Asked<'a>>,
    weight: Weight,
    stretch: Stretch,
    style: Style,
}

impl<'a> Wanted<'a> {
    fn by(font: &'a Font) -> Self {
        Self {
            families: font.families().iter().map(Asked::by).collect(),
            weight: Weight(font.weight()),
            stretch: stretch(font.stretch()),
            style: match font.style() {
                FontStyle::Normal => Style::Normal,
                FontStyle::Italic => Style::Italic,
                FontStyle::Oblique => Style::Oblique,
            },
        }
    }

    /// The face of a family that fits best.
    fn face(&self, database: &Database, family: &str) -> Option<ID> {
        database.query(&Query {
            families: &[Family::Name(family)],
            weight: self.weight,
            stretch: self.stretch,
            style: self.style,
        })
    }

    /// The first face of a kind that has all that is wanted, or else the first; none where only the shipped ones are left.
    fn face_of_kind(&self, database: &Database, kind: Kind, more: &[PathBuf]) -> Option<ID> {
        let there = families::of_kind(database, kind, more).into_iter();
        let faces: Vec<ID> = there.filter_map(|family| self.face(database, family)).collect();
        let whole = faces.iter().find(|id| self.lacking(database, **id).next().is_none());
        whole.or(faces.first()).copied()
    }

    /// What is asked of a face that this one is not.
    fn lacking(&self, database: &Database, id: ID) -> impl Iterator<Item = &'static str> + use<> {
        let is_bold = |weight: Weight| weight >= Weight::SEMIBOLD;
        let face = database.face(id);
        let bold = face.is_some_and(|face| is_bold(self.weight) && !is_bold(face.weight));
        let italic = face.is_some_and(|face| self.style != Style::Normal && face.style == Style::Normal);
        [bold.then_some("bold"), italic.then_some("italic")]
            .into_iter()
            .flatten()
    }
}

/// The face that is taken, and what of the wanted is missing; `more` are the files and folders that the user named.
fn chosen(database: &Database, wanted: &Wanted<'_>, more: &[PathBuf]) -> (Option<ID>, Vec<Missing>) {
    let asked = &wanted.families;
    let mut unmet: Vec<&str> = Vec::new();
    let found = asked.iter().find_map(|asked| match asked {
        Asked::Named(name) => {
            let there = families::spelled(database, name);
            // What stands behind one that is there is not asked for.
            unmet.extend(there.is_none().then_some(name));
            wanted.face(database, there.or_else(|| families::instead(database, name))?)
        }
        Asked::Kind(kind) => {
            let found = wanted.face_of_kind(database, *kind, more);
            let (shipped, is_of_kind) = families::shipped(*kind);
            if found.is_none() && !is_of_kind {
                unmet.push(kind.name());
            }
            found.or_else(|| wanted.face(database, shipped))
        }
        Asked::Nothing => None,
    });
    let found = found.or_else(|| {
        let kind = asked.iter().find_map(|asked| asked.kind()).unwrap_or(Kind::Serif);
        let found = wanted.face_of_kind(database, kind, more);
        found.or_else(|| wanted.face(database, families::shipped(kind).0))
    });
    let is_there = |kind| families::shipped(kind).1 || wanted.face_of_kind(database, kind, more).is_some();
    if !unmet.is_empty()
        && asked
            .iter()
            .any(|asked| matches!(asked, Asked::Kind(kind) if is_there(*kind)))
    {
        // The document says itself that any family of that kind will do for want of the others.
        unmet.clear();
    }
    let taken = found.and_then(|id| name(database, id));
    let families = (!unmet.is_empty()).then(|| Missing::Family(unmet.join(" or "), taken.clone()));
    let faces = found.iter().flat_map(|id| wanted.lacking(database, *id));
    let faces = faces.map(|kind| Missing::Face(kind, taken.clone().unwrap_or_default()));
    (found, families.into_iter().chain(faces).collect())
}

fn name(database: &Database, id: ID) -> Option<String> {
    database.face(id)?.families.first().map(|(name, _)| name.clone())
}

fn stretch(stretch: FontStretch) -> Stretch {
    match stretch {
        FontStretch::UltraCondensed => Stretch::UltraCondensed,
        FontStretch::ExtraCondensed => Stretch::ExtraCondensed,
        FontStretch::Condensed => Stretch::Condensed,
        FontStretch::SemiCondensed => Stretch::SemiCondensed,
        FontStretch::Normal => Stretch::Normal,
        FontStretch::SemiExpanded => Stretch::SemiExpanded,
        FontStretch::Expanded => Stretch::Expanded,
        FontStretch::ExtraExpanded => Stretch::ExtraExpanded,
        FontStretch::UltraExpanded => Stretch::UltraExpanded,
    }
}

#[cfg(test)]
mod tests {
    use usvg::FontFamily;
    use usvg::fontdb::{FaceInfo, Language};

    use super::*;

    /// A machine with these faces and the shipped ones; those in `/more/` were named by the user.
    fn machine(faces: &[(&str, &str)]) -> Database {
        let mut database = gathered(&Fonts::default());
        for (path, family) in faces {
            let (family, is_bold) = match family.strip_suffix(" bold") {
                Some(family) => (family, true),
                None => (*family, false),
            };
            database.push_face_info(FaceInfo {
                id: ID::dummy(),
                source: Source::File(PathBuf::from(path).join("a.ttf")),
                index: 0,
                families: vec![(family.to_owned(), Language::English_UnitedStates)],
                post_script_name: String::new(),
                style: Style::Normal,
                weight: if is_bold { Weight::BOLD } else { Weight::NORMAL },
                stretch: Stretch::Normal,
                monospaced: false,
            });
        }
        database
    }

    /// The family that is taken, whether its face is bold, and what is told.
    fn set(database: &Database, families: &[FontFamily], weight: u16) -> (String, bool, Vec<String>) {
        let wanted = Wanted {
            families: families.iter().map(Asked::by).collect(),
            weight: Weight(weight),
            stretch: Stretch::Normal,
            style: Style::Normal,
        };
        let (found, missing) = chosen(database, &wanted, &[PathBuf::from("/more")]);
        let found = found.and_then(|id| database.face(id)).expect("there is always one");
        let told = missing.iter().filter_map(Missing::message).collect();
        (found.families[0].0.clone(), found.weight == Weight::BOLD, told)
    }

    fn named(name: &str) -> FontFamily {
        FontFamily::Named(name.to_owned())
    }

    #[track_caller]
    fn assert_set(database: &Database, family: FontFamily, expected: &str) {
        let (taken, _, told) = set(database, &[family], 400);
        assert_eq!((taken.as_str(), told), (expected, Vec::new()));
    }

    #[test]
    fn generic_families_are_those_that_the_machine_has() {
        let system = machine(&[
            ("/usr", "DejaVu Sans"),
            ("/usr", "Noto Serif"),
            ("/usr", "DejaVu Serif"),
            ("/usr", "DejaVu Sans Mono"),
        ]);
        assert_set(&system, FontFamily::Serif, "DejaVu Serif");
        assert_set(&system, named(families::UNNAMED), "DejaVu Serif");
        assert_set(&system, named("SANS-serif"), "DejaVu Sans");
        assert_set(&system, named("ui-monospace"), "DejaVu Sans Mono");
        let given = machine(&[
            ("/usr", "DejaVu Sans"),
            ("/usr", "DejaVu Serif"),
            ("/more", "Noto Serif"),
            ("/more", "Mine"),
        ]);
        assert_set(&given, FontFamily::Serif, "Noto Serif");
        assert_set(&given, FontFamily::SansSerif, "DejaVu Sans");
        assert_set(&machine(&[("/more", "Mine")]), FontFamily::SansSerif, "Mine");
        assert_set(&machine(&[]), FontFamily::SansSerif, "Ubuntu");
        assert_set(&machine(&[]), FontFamily::Monospace, "Hack");
        assert_set(&machine(&[]), named(families::UNNAMED), "Ubuntu");
        let (taken, _, told) = set(&machine(&[]), &[FontFamily::Serif], 400);
        assert_eq!(taken, "Ubuntu");
        assert_eq!(
            told,
            ["there is no typeface serif; Ubuntu is taken instead (--font adds more)"]
        );
    }

    #[test]
    fn a_bold_face_of_the_kind_is_taken_where_there_is_one() {
        let faces = [
            ("/usr", "DejaVu Sans"),
            ("/usr", "Noto Sans"),
            ("/usr", "Noto Sans bold"),
        ];
        let (taken, is_bold, told) = set(&machine(&faces), &[FontFamily::SansSerif], 700);
        assert_eq!((taken.as_str(), is_bold, told.len()), ("Noto Sans", true, 0));
        let (taken, _, told) = set(&machine(&faces[..1]), &[FontFamily::SansSerif], 700);
        assert!(taken == "DejaVu Sans" && told.len() == 1, "{taken}, {told:?}");
        let cured = machine(&[("/more", "Mine bold")]);
        let (taken, is_bold, told) = set(&cured, &[FontFamily::SansSerif], 700);
        assert_eq!(
            (taken.as_str(), is_bold, told.len()),
            ("Mine", true, 0),
            "what is told is true"
        );
    }

    #[test]
    fn families_have_their_names_in_any_case_and_common_ones_stand_for_each_other() {
        let system = machine(&[("/usr", "DejaVu Sans"), ("/usr", "Nimbus Sans"), ("/usr", "Tinos")]);
        assert_set(&system, named("dejavu sans"), "DejaVu Sans");
        let (taken, _, told) = set(&system, &[named("arial"), named("DejaVu Sans")], 400);
        assert_eq!(taken, "Nimbus Sans");
        assert_eq!(
            told,
            ["there is no typeface arial; Nimbus Sans is taken instead (--font adds more)"]
        );
        assert_eq!(set(&system, &[named("Times")], 400).0, "Tinos");
        let (taken, _, told) = set(
            &system,
            &[named("No Such"), named("Courier"), named("DejaVu Sans")],
            400,
        );
        assert_eq!(taken, "DejaVu Sans");
        assert_eq!(
            told,
            ["there is no typeface No Such or Courier; DejaVu Sans is taken instead (--font adds more)"],
            "one line for a list"
        );
        let list = ["Segoe UI", "Roboto", "No Such"].map(named);
        let list = [&list[..], &[FontFamily::SansSerif]].concat();
        assert_eq!(
            set(&system, &list, 400).2,
            [""; 0],
            "nothing where its own last choice is there"
        );
        for first in ["arial", "No Such"] {
            let list = [named(first), named("DejaVu Sans"), FontFamily::SansSerif];
            assert_eq!(
                set(&system, &list, 400).2,
                [""; 0],
                "whatever is taken before it: {first}"
            );
        }
        let (taken, _, told) = set(&system, &[named("Courier")], 400);
        assert!(taken == "Hack" && told.len() == 1, "of its kind: {taken}: {told:?}");
    }
}
