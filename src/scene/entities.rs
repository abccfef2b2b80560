//! The guard against entity bombs: how far a document's own entities would expand.
//!
//! Drawing programs declare a dozen short entities for namespaces, nothing more. So values that hold markup are
//! refused outright, and the expansion of all references together has a ceiling.

use std::collections::HashMap;

use super::Problem;
use super::SourceLocation;
use super::error::Fault;
use super::report::quote;

/// What a declaration begins with.
const DECLARATION: &str = "<!ENTITY";
/// Most bytes that all references of a document may expand to.
const MAX_EXPANSION: usize = 4 << 20;
/// Most declarations.
const MAX_DECLARATIONS: usize = 256;
/// Nesting that the XML library allows.
const MAX_NESTING: usize = 10;

/// Entities that HTML has and XML has not, with their characters.
const OF_HTML: [(&str, char); 16] = [
    ("nbsp", '\u{a0}'),
    ("copy", '©'),
    ("reg", '®'),
    ("trade", '™'),
    ("deg", '°'),
    ("plusmn", '±'),
    ("micro", 'µ'),
    ("middot", '·'),
    ("times", '×'),
    ("laquo", '«'),
    ("raquo", '»'),
    ("ndash", '–'),
    ("mdash", '—'),
    ("bull", '•'),
    ("hellip", '…'),
    ("euro", '€'),
];

/// What is to be said of a reference in `text` to an entity that it does not declare, or declares to be in another file.
pub(super) fn unknown(name: &str, text: &str) -> String {
    if text.split(DECLARATION).skip(1).any(|after| is_elsewhere(after, name)) {
        return format!(
            "the entity &{}; is in another file, and others are not read; write what it holds in its place",
            quote(name)
        );
    }
    let known = OF_HTML.iter().find(|(known, _)| *known == name);
    let instead = known.map_or_else(
        || "the character itself".to_owned(),
        |(_, character)| format!("&#{};", u32::from(*character)),
    );
    format!("XML has no entity &{};; write {instead} in its place", quote(name))
}

/// Whether a declaration, of which `text` is what follows `<!ENTITY`, says in which file the entity of this name is.
fn is_elsewhere(text: &str, name: &str) -> bool {
    let mut words = text.split_ascii_whitespace();
    words.next() == Some(name) && matches!(words.next(), Some("SYSTEM" | "PUBLIC"))
}

/// Refuses documents whose entities hold markup or expand too far.
pub(super) fn check(text: &str) -> Result<(), Fault> {
    let declared = declarations(text)?;
    if declared.is_empty() {
        return Ok(());
    }
    let mut sizes: HashMap<&str, usize> = declared.iter().map(|(name, value)| (*name, value.len())).collect();
    for _ in 0..MAX_NESTING {
        let larger = declared
            .iter()
            .map(|(name, value)| (*name, expansion(value, &sizes).saturating_add(value.len())));
        sizes = larger.collect();
    }
    let mut sum = 0_usize;
    let too_far = references(text, &sizes).find(|(_, size)| {
        sum = sum.saturating_add(*size);
        sum > MAX_EXPANSION
    });
    let Some((at, _)) = too_far else {
        return Ok(());
    };
    let problem = Problem::TooMuch {
        what: "bytes of expanded entities",
        limit: MAX_EXPANSION,
        cure: "let fewer entities hold others",
    };
    Err(problem.at(place_of(&text[..at])))
}

/// Where the references in `text` stand, and how many bytes each expands to.
fn references(text: &str, sizes: &HashMap<&str, usize>) -> impl Iterator<Item = (usize, usize)> {
    text.match_indices('&').filter_map(|(at, _)| {
        let after = text[at + 1..].split('&').next()?;
        Some((at, *sizes.get(after.split_once(';')?.0)?))
    })
}

/// What all references in `text` expand to, in bytes.
fn expansion(text: &str, sizes: &HashMap<&str, usize>) -> usize {
    let sizes = references(text, sizes).map(|(_, size)| size);
    sizes.fold(0, usize::saturating_add)
}

/// Names and values of the general entities that the document declares.
fn declarations(text: &str) -> Result<Vec<(&str, &str)>, Fault> {
    let mut found = Vec::new();
    for after in text.split(DECLARATION).skip(1) {
        let Some((name, value)) = declaration(after) else {
            continue;
        };
        if value.contains('<') {
            let end = after.as_ptr().addr() - text.as_ptr().addr() - DECLARATION.len();
            return Err(Problem::EntityMarkup(name.to_owned()).at(place_of(&text[..end])));
        }
        found.push((name, value));
        if found.len() > MAX_DECLARATIONS {
            let problem = Problem::TooMuch {
                what: "entity declarations",
                limit: MAX_DECLARATIONS,
                cure: "write what some of them hold in the place of their references",
            };
            let end = after.as_ptr().addr() - text.as_ptr().addr() - DECLARATION.len();
            return Err(problem.at(place_of(&text[..end])));
        }
    }
    Ok(found)
}

/// The place behind some text.
fn place_of(before: &str) -> SourceLocation {
    let number = |count: usize| u32::try_from(count + 1).unwrap_or(u32::MAX);
    let last = before.rsplit('\n').next().unwrap_or("");
    SourceLocation {
        line: number(before.matches('\n').count()),
        column: number(last.chars().count()),
    }
}

/// Name and value of one declaration, of which `text` is what follows `<!ENTITY`.
fn declaration(text: &str) -> Option<(&str, &str)> {
    let (name, rest) = text.trim_start().split_once(|c: char| c.is_ascii_whitespace())?;
    let rest = rest.trim_start();
    let quote = rest.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let value = rest[1..].split(quote).next()?;
    Some((name, value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn check_lets_namespaces_pass() {
        let text = "<!DOCTYPE svg [ <!ENTITY ns \"http://www.w3.org/2000/svg\"> ]><svg xmlns=\"&ns;\"/>";
        assert!(check(text).is_ok(), "an Illustrator file");
        assert!(check("<svg>&amp;</svg>").is_ok(), "no declarations");
    }

    #[test]
    fn unknown_entities_are_told_from_those_of_other_files() {
        let text = "<!DOCTYPE svg [<!ENTITY a SYSTEM 'file:///b'> <!ENTITY c \"d\">]>";
        assert!(unknown("a", text).starts_with("the entity &a; is in another file"));
        assert!(unknown("b", text).starts_with("XML has no entity &b;"));
    }

    #[test]
    fn check_refuses_bombs() {
        let level = |i: u32| format!("<!ENTITY a{} '{}'>", i + 1, format!("&a{i};").repeat(10));
        let mut nested = String::from("<!ENTITY a0 'aaaaaaaaaaaaaaaa'>");
        nested.extend((0..9).map(level));
        let laughs = check(&format!("{nested}\n&a9;")).expect_err("billion laughs");
        assert!(laughs.location.is_some(), "where it is too much: {laughs:?}");
        assert!(laughs.problem.to_string().ends_with("; let fewer entities hold others"));
        let flat = format!("<!ENTITY a '{}'>{}", "x".repeat(10_000), "&a;".repeat(10_000));
        assert!(check(&flat).is_err(), "quadratic blow-up");
        let markup = check("<!DOCTYPE svg [\n <!ENTITY a '<svg/>'>").expect_err("markup");
        assert!(
            format!("{markup:?}").contains("line: 2, column: 2"),
            "with its place: {markup:?}"
        );
        assert!(
            check(&"<!ENTITY a ''>".repeat(MAX_DECLARATIONS + 1)).is_err(),
            "declarations"
        );
    }
}
