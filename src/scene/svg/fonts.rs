//! Typefaces for text: those of the system, those that the user names, and two that are always there.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use usvg::fontdb::{Database, Family, ID, Query, Source, Stretch, Style, Weight};
use usvg::{Font, FontFamily, FontResolver, FontStretch, FontStyle};

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
    generic(&mut database);
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

/// Points generic families to typefaces that are there.
fn generic(database: &mut Database) {
    const SANS: &str = "Ubuntu";
    const MONO: &str = "Hack";
    let families = [
        Family::Serif,
        Family::SansSerif,
        Family::Cursive,
        Family::Fantasy,
        Family::Monospace,
    ];
    for family in families
        .into_iter()
        .filter(|family| !is_there(database, family))
        .collect::<Vec<_>>()
    {
        match family {
            Family::SansSerif => database.set_sans_serif_family(SANS),
            Family::Cursive => database.set_cursive_family(SANS),
            Family::Fantasy => database.set_fantasy_family(SANS),
            Family::Monospace => database.set_monospace_family(MONO),
            Family::Serif | Family::Name(_) => database.set_serif_family(SANS),
        }
    }
}

fn is_there(database: &Database, family: &Family<'_>) -> bool {
    let name = database.family_name(family);
    database
        .faces()
        .any(|face| face.families.iter().any(|(known, _)| known == name))
}

/// What text is set in that asks for nothing: usvg takes this for the name of a family.
pub(super) const UNNAMED: &str = "serif";

/// What a document asks for and the machine has not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Missing {
    /// A family, and what is taken instead.
    Family(String, Option<String>),
    /// A bold or an inclined face of a family that is there.
    Face(&'static str, String),
    /// A character that no typeface has. Others may be missing as well: usvg looks for one in each chunk of text.
    Character(char),
}

impl Missing {
    /// Whether it needs no line of its own beside those of others.
    pub(super) fn is_told_by(&self, others: &[Self]) -> bool {
        let is_character = |missing: &Self| matches!(missing, Self::Character(_));
        others.contains(self) || is_character(self) && others.iter().any(is_character)
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
        })
    }
}

/// Chooses typefaces as usvg does, and tells of the families, faces and characters that are missing.
pub(super) fn resolver<'a>(tell: impl Fn(Missing) + Clone + Send + Sync + 'a) -> FontResolver<'a> {
    let (fallback, tell_of_character) = (FontResolver::default_fallback_selector(), tell.clone());
    FontResolver {
        select_font: Box::new(move |font, database| {
            let found = font
                .families()
                .iter()
                .find_map(|family| query(database, font, &theirs(family)));
            let found = found.or_else(|| query(database, font, &Family::Serif));
            let named = |family: &&FontFamily| matches!(family, FontFamily::Named(_));
            let is_there = |family: &&FontFamily| query(database, font, &theirs(family)).is_some();
            // What stands behind one that is there is not asked for.
            let missing = font.families().iter().take_while(|family| !is_there(family));
            for family in missing.filter(named) {
                tell(Missing::Family(
                    family.to_string().trim_matches('"').to_owned(),
                    found.and_then(|id| name(database, id)),
                ));
            }
            for kind in found.iter().flat_map(|id| lacking(database, font, *id)) {
                tell(Missing::Face(
                    kind,
                    found.and_then(|id| name(database, id)).unwrap_or_default(),
                ));
            }
            found
        }),
        select_fallback: Box::new(move |character, tried, database| {
            let found = fallback(character, tried, database);
            if found.is_none() && !character.is_whitespace() && !character.is_control() {
                tell_of_character(Missing::Character(character));
            }
            found
        }),
    }
}

/// What a document asks of a face that this one is not.
fn lacking(database: &Database, font: &Font, id: ID) -> impl Iterator<Item = &'static str> + use<> {
    let is_bold = |weight: u16| weight >= Weight::SEMIBOLD.0;
    let face = database.face(id);
    let bold = face.is_some_and(|face| is_bold(font.weight()) && !is_bold(face.weight.0));
    let italic = face.is_some_and(|face| font.style() != FontStyle::Normal && face.style == Style::Normal);
    [bold.then_some("bold"), italic.then_some("italic")]
        .into_iter()
        .flatten()
}

fn name(database: &Database, id: ID) -> Option<String> {
    database.face(id)?.families.first().map(|(name, _)| name.clone())
}

fn theirs(family: &FontFamily) -> Family<'_> {
    match family {
        FontFamily::Serif => Family::Serif,
        FontFamily::SansSerif => Family::SansSerif,
        FontFamily::Cursive => Family::Cursive,
        FontFamily::Fantasy => Family::Fantasy,
        FontFamily::Monospace => Family::Monospace,
        FontFamily::Named(name) if name == UNNAMED => Family::Serif,
        FontFamily::Named(name) => Family::Name(name),
    }
}

fn query(database: &Database, font: &Font, family: &Family<'_>) -> Option<ID> {
    database.query(&Query {
        families: std::slice::from_ref(family),
        weight: Weight(font.weight()),
        stretch: stretch(font.stretch()),
        style: match font.style() {
            FontStyle::Normal => Style::Normal,
            FontStyle::Italic => Style::Italic,
            FontStyle::Oblique => Style::Oblique,
        },
    })
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
