//! Typefaces for characters that the chosen one lacks.
//!
//! usvg sets a text in the chosen typeface and looks for another one for the first character that is missing. Where that other one has
//! all characters of the text, all of it is set anew, in another weight and width. So what usvg gets is a copy of the typeface
//! that has only the characters that the first one lacks. Where the copy does not help, as usvg gives up where ligatures make a
//! text shorter, the document is read again with whole typefaces, and that is told.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::ops::RangeInclusive;
use std::sync::{Arc, Mutex, PoisonError};

use usvg::fontdb::{Database, FaceInfo, ID, Language, Source, Weight};
use usvg::{Group, Node, Tree};

/// A family that no document can ask for.
const COPY: &str = "\u{1}";

/// Most bytes of all copies of one document; beyond, typefaces stand for whole texts.
const MOST_COPIED: usize = 100 << 20;

/// Most characters of one typeface that are looked at: as many as there are.
const MOST_CHARACTERS: usize = 0x11_0000;

/// Numbers of characters.
type Wanted = RangeInclusive<u32>;
/// All of them.
const ALL: Wanted = 0..=0x10_FFFF;

/// What is found while one document is read.
#[derive(Debug, Default)]
pub(super) struct Fallbacks(Mutex<State>);

#[derive(Debug, Default)]
struct State {
    /// The copies, by the typeface of the text and the one that stands in.
    copies: HashMap<(ID, ID), ID>,
    copied: usize,
    /// Whether whole typefaces stand in.
    is_whole: bool,
    /// Characters for which one was found.
    found: HashSet<char>,
}

/// What stands in for a typeface.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Instead {
    /// A typeface for the missing characters alone.
    Part(ID),
    /// One that all of a text may be set in, if it has its characters.
    Whole(ID),
}

impl Fallbacks {
    /// A typeface with `character`, where those in `tried` are without it, the text's first.
    pub(super) fn find(&self, character: char, tried: &[ID], database: &mut Arc<Database>) -> Option<Instead> {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let base = *tried.first()?;
        let copied = state.copies.iter().filter(|(_, copy)| tried.contains(copy));
        let mut passed: HashSet<ID> = copied.map(|((_, of), _)| *of).collect();
        passed.extend(tried.iter().chain(state.copies.values()));
        let found = best(character, base, &passed, database)?;
        state.found.insert(character);
        if state.is_whole {
            return Some(Instead::Whole(found));
        }
        let copy = state.copies.get(&(base, found)).copied();
        let copy = copy.or_else(|| state.copy(base, found, database));
        Some(copy.map_or(Instead::Whole(found), Instead::Part))
    }

    /// Whether a character is still missing that a typeface was found for; from then on whole ones stand in.
    pub(super) fn fail(&self, tree: &Tree) -> bool {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if state.is_whole || state.copies.is_empty() {
            return false;
        }
        state.is_whole = has_box(tree.root(), &state.found);
        state.is_whole
    }
}

impl State {
    fn copy(&mut self, base: ID, found: ID, database: &mut Arc<Database>) -> Option<ID> {
        let there: HashSet<u32> = database
            .with_face_data(base, |data, index| characters(data, index, ALL))??
            .into_keys()
            .collect();
        let left = MOST_COPIED.saturating_sub(self.copied);
        let bytes = database.with_face_data(found, |data, index| {
            let mut own = characters(data, index, ALL)?;
            own.retain(|character, _| !there.contains(character));
            with_characters(data, index, &own).filter(|bytes| bytes.len() <= left)
        })??;
        self.copied += bytes.len();
        let face = database.face(found)?;
        let face = FaceInfo {
            id: ID::dummy(),
            source: Source::Binary(Arc::new(bytes)),
            index: 0,
            families: vec![(COPY.to_owned(), Language::English_UnitedStates)],
            ..face.clone()
        };
        let copy = Arc::make_mut(database).push_face_info(face);
        self.copies.insert((base, found), copy);
        Some(copy)
    }
}

/// The typeface with a character that is most like another one.
fn best(character: char, base: ID, passed: &HashSet<ID>, database: &Database) -> Option<ID> {
    let base = database.face(base)?;
    // A light text is so because the typeface that comes with the program is.
    let weight = base.weight.max(Weight::NORMAL).0;
    let mut faces: Vec<&FaceInfo> = database.faces().filter(|face| !passed.contains(&face.id)).collect();
    faces.sort_by_key(|face| {
        (
            face.style != base.style,
            face.weight.0.abs_diff(weight),
            face.stretch != base.stretch,
            face.monospaced != base.monospaced,
        )
    });
    let found = faces.into_iter().find(|face| has(database, face.id, character));
    found.map(|face| face.id)
}

/// Whether a typeface has a character.
fn has(database: &Database, id: ID, character: char) -> bool {
    let wanted = u32::from(character)..=u32::from(character);
    let found = database.with_face_data(id, |data, index| characters(data, index, wanted));
    found.flatten().is_some_and(|found| !found.is_empty())
}

/// Whether one of these characters is drawn as a box.
fn has_box(group: &Group, characters: &HashSet<char>) -> bool {
    group.children().iter().any(|node| {
        let mut found = match node {
            Node::Group(inner) => has_box(inner, characters),
            Node::Text(text) => {
                let mut glyphs = text.layouted().iter().flat_map(|span| &span.positioned_glyphs);
                glyphs.any(|glyph| glyph.id.0 == 0 && glyph.text.contains(|c| characters.contains(&c)))
            }
            Node::Path(_) | Node::Image(_) => false,
        };
        node.subroots(|inner| found = found || has_box(inner, characters));
        found
    })
}

/// The characters of a typeface that are among `wanted`, with the numbers of their glyphs (OpenType 1.9, table `cmap`).
fn characters(data: &[u8], index: u32, wanted: Wanted) -> Option<BTreeMap<u32, u16>> {
    let (_, tables) = tables(data, index)?;
    let (_, cmap) = tables.into_iter().find(|(tag, _)| tag == b"cmap")?;
    let count = u16_at(cmap, 2)?;
    let mut found = BTreeMap::new();
    let mut left = MOST_CHARACTERS;
    for record in (0..usize::from(count)).map(|i| 4 + 8 * i) {
        let (platform, encoding) = (u16_at(cmap, record)?, u16_at(cmap, record + 2)?);
        let subtable = cmap.get(usize::try_from(u32_at(cmap, record + 4)?).ok()?..)?;
        // Of Windows' tables those of Unicode, and all of Unicode's own but the one of variations.
        let is_unicode = matches!((platform, encoding), (3, 1 | 10) | (0, 0..=4 | 6));
        if is_unicode {
            let put = |character: u32, glyph: u16| {
                left = left.saturating_sub(1);
                if glyph != 0 {
                    found.insert(character, glyph);
                }
                left > 0
            };
            match u16_at(subtable, 0)? {
                4 => segments(subtable, &wanted, put),
                12 => groups(subtable, &wanted, put),
                _ => None,
            };
        }
    }
    Some(found)
}

/// Hands on the wanted characters of a subtable of format 4 as long as `put` wants more.
fn segments(table: &[u8], wanted: &Wanted, mut put: impl FnMut(u32, u16) -> bool) -> Option<()> {
    let count = usize::from(u16_at(table, 6)?) / 2;
    for i in 0..count {
        let at = |column: usize| 14 + column * 2 * count + 2 * i + if column > 0 { 2 } else { 0 };
        let [end, start, delta, offset] = [0, 1, 2, 3].map(|column| u16_at(table, at(column)));
        let (end, start, delta, offset) = (end?, start?, delta?, offset?);
        let first = u16::try_from(*wanted.start()).ok()?.max(start);
        let last = u16::try_from(*wanted.end()).unwrap_or(u16::MAX).min(end);
        for character in first..=last {
            let glyph = if offset == 0 {
                character.wrapping_add(delta)
            } else {
                let far = usize::from(offset) + 2 * usize::from(character - start);
                match u16_at(table, at(3) + far).unwrap_or(0) {
                    0 => 0,
                    glyph => glyph.wrapping_add(delta),
                }
            };
            if !put(character.into(), glyph) {
                return None;
            }
        }
    }
    Some(())
}

/// Hands on the wanted characters of a subtable of format 12 as long as `put` wants more.
fn groups(table: &[u8], wanted: &Wanted, mut put: impl FnMut(u32, u16) -> bool) -> Option<()> {
    let count = u32_at(table, 12)?;
    for at in (0..usize::try_from(count).ok()?).map(|i| 16 + 12 * i) {
        let [start, end, glyph] = [0, 4, 8].map(|column| u32_at(table, at + column));
        let (start, end, glyph) = (start?, end?, glyph?);
        for character in start.max(*wanted.start())..=end.min(*wanted.end()) {
            let glyph = u16::try_from(glyph.saturating_add(character - start)).unwrap_or(0);
            if !put(character, glyph) {
                return None;
            }
        }
    }
    Some(())
}

/// A typeface of its own, with these characters alone.
fn with_characters(data: &[u8], index: u32, characters: &BTreeMap<u32, u16>) -> Option<Vec<u8>> {
    let cmap = cmap_of(characters)?;
    let (magic, mut tables) = tables(data, index)?;
    for (tag, table) in &mut tables {
        if tag == b"cmap" {
            *table = &cmap;
        }
    }
    let count = u16::try_from(tables.len()).ok()?;
    let mut bytes = magic.to_vec();
    bytes.extend(count.to_be_bytes());
    // Readers search the directory without these.
    bytes.extend([0; 6]);
    let mut at = 12 + 16 * tables.len();
    for (tag, table) in &tables {
        bytes.extend(tag);
        bytes.extend([0; 4]);
        bytes.extend(u32::try_from(at).ok()?.to_be_bytes());
        bytes.extend(u32::try_from(table.len()).ok()?.to_be_bytes());
        at += table.len().next_multiple_of(4);
    }
    for (_, table) in tables {
        bytes.extend(table);
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    Some(bytes)
}

/// A table `cmap` of format 12.
fn cmap_of(characters: &BTreeMap<u32, u16>) -> Option<Vec<u8>> {
    let count = u32::try_from(characters.len()).ok()?;
    let length = count.checked_mul(12)?.checked_add(16)?;
    let mut bytes = Vec::new();
    // Version 0 with one subtable: of Windows, all of Unicode, behind these 12 bytes.
    bytes.extend([0, 1, 3, 10].map(u16::to_be_bytes).concat());
    bytes.extend(12_u32.to_be_bytes());
    bytes.extend([12, 0].map(u16::to_be_bytes).concat());
    bytes.extend([length, 0, count].map(u32::to_be_bytes).concat());
    for (character, glyph) in characters {
        bytes.extend(
            [*character, *character, u32::from(*glyph)]
                .map(u32::to_be_bytes)
                .concat(),
        );
    }
    Some(bytes)
}

/// The tables of a typeface by their tags, and the bytes before them.
type Tables<'d> = ([u8; 4], Vec<([u8; 4], &'d [u8])>);

/// The tables of a typeface, or of one of a collection.
fn tables(data: &[u8], index: u32) -> Option<Tables<'_>> {
    let start = if data.starts_with(b"ttcf") {
        let at = usize::try_from(index).ok()?.checked_mul(4)?.checked_add(12)?;
        usize::try_from(u32_at(data, at)?).ok()?
    } else {
        0
    };
    let head = data.get(start..)?;
    let magic = *head.first_chunk::<4>()?;
    let count = usize::from(u16_at(head, 4)?);
    let mut found = Vec::with_capacity(count);
    for record in (0..count).map(|i| 12 + 16 * i) {
        let tag = *head.get(record..)?.first_chunk::<4>()?;
        let [offset, length] = [8, 12].map(|column| usize::try_from(u32_at(head, record + column)?).ok());
        let (offset, length) = (offset?, length?);
        found.push((tag, data.get(offset..offset.checked_add(length)?)?));
    }
    Some((magic, found))
}

fn u16_at(data: &[u8], at: usize) -> Option<u16> {
    let bytes = data.get(at..)?.first_chunk::<2>()?;
    Some(u16::from_be_bytes(*bytes))
}

fn u32_at(data: &[u8], at: usize) -> Option<u32> {
    let bytes = data.get(at..)?.first_chunk::<4>()?;
    Some(u32::from_be_bytes(*bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The two typefaces that are always there.
    fn shipped() -> (Arc<Database>, ID, ID) {
        let mut database = Database::new();
        let [text, other] = [epaint_default_fonts::UBUNTU_LIGHT, epaint_default_fonts::HACK_REGULAR]
            .map(|bytes| database.load_font_source(Source::Binary(Arc::new(bytes)))[0]);
        (Arc::new(database), text, other)
    }

    #[test]
    fn a_copy_has_only_what_the_other_typeface_lacks() {
        let (mut database, text, other) = shipped();
        let fallbacks = Fallbacks::default();
        let Some(Instead::Part(copy)) = fallbacks.find('→', &[text], &mut database) else {
            panic!("Hack has the arrow");
        };
        for (character, is) in [('→', true), ('a', false), (' ', false)] {
            assert_eq!(has(&database, copy, character), is, "{character}");
        }
        assert_eq!(
            fallbacks.find('→', &[text], &mut database),
            Some(Instead::Part(copy)),
            "made once"
        );
        assert_eq!(
            fallbacks.find('☎', &[text, copy], &mut database),
            None,
            "nor tried again"
        );
        assert!(has(&database, other, 'a'), "the other one is as it was");
        let families = database.faces().filter(|face| face.families[0].0 == "Hack");
        assert_eq!(families.count(), 1, "and is asked for by its name alone");
    }

    #[test]
    fn tables_name_the_characters_of_a_typeface() {
        let (database, text, other) = shipped();
        for id in [text, other] {
            let all = database.with_face_data(id, |data, index| characters(data, index, ALL));
            let all = all.flatten().expect("a table");
            assert!(all.len() > 500, "{}", all.len());
            for c in (0..0x3000).filter_map(char::from_u32) {
                assert_eq!(all.contains_key(&u32::from(c)), has(&database, id, c), "{c:?}");
            }
            assert!(
                all.contains_key(&0x3A9) && !all.contains_key(&0x4E00),
                "Greek, not Chinese"
            );
        }
    }

    #[test]
    fn broken_typefaces_have_no_copies() {
        let bytes = epaint_default_fonts::HACK_REGULAR;
        for length in [0, 3, 11, 12, 100, 5000] {
            assert_eq!(characters(&bytes[..length], 0, ALL), None, "{length}");
        }
        for start in (0..400).step_by(3) {
            let mut broken = bytes[..40_000].to_vec();
            broken[start] ^= 0xFF;
            if let Some(found) = characters(&broken, 0, ALL) {
                // Only that it ends, without a panic.
                let _ = with_characters(&broken, 0, &found);
            }
        }
        assert_eq!(characters(b"ttcf\0\0\0\0\0\0\0\x01\xff\xff\xff\xff", 7, ALL), None);
    }
}
