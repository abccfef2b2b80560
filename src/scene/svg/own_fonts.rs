//! Typefaces that a document brings with it: `@font-face` in its style sheets, with a `data:` address.

use std::sync::Arc;

use roxmltree::Node;
use usvg::fontdb::{Database, ID, Language, Source, Style, Weight};

use super::listener::Listener;
use crate::scene::css::block_end;
use crate::scene::declarations;
use crate::scene::report::quote;
use crate::scene::textures::{embedded, is_data};

/// Most bytes of all typefaces of a document, and most typefaces.
const MOST_BYTES: usize = 32 << 20;
const MOST: usize = 100;

/// What a rule `@font-face` says.
#[derive(Debug, Default)]
struct Rule<'css> {
    family: &'css str,
    addresses: Vec<&'css str>,
    weight: Option<Weight>,
    style: Option<Style>,
}

/// The typefaces of the machine, with those of the document below `root`.
pub(super) fn joined<L: Listener>(known: Arc<Database>, root: Node<'_, '_>, listener: &mut L) -> Arc<Database> {
    let mut all = known;
    let (mut left, mut count) = (MOST_BYTES, 0);
    for node in root.descendants().filter(|node| node.tag_name().name() == "style") {
        for rule in rules(node.text().unwrap_or("")) {
            count += 1;
            let added = if count > MOST {
                Err(format!("more than {MOST} are too many"))
            } else {
                add(&mut all, &rule, &mut left)
            };
            if let Err(why) = added {
                let family = quote(rule.family);
                listener.warn(
                    node,
                    format!("the typeface {family} in the document is not read: {why}; --font adds a file that has it"),
                );
            }
            if count > MOST {
                return all;
            }
        }
    }
    all
}

/// Adds the typeface of a rule that has one.
fn add(all: &mut Arc<Database>, rule: &Rule<'_>, left: &mut usize) -> Result<(), String> {
    // One of the system is asked for by its own name.
    let Some(first) = rule.addresses.first() else {
        return Ok(());
    };
    let Some(address) = rule.addresses.iter().find(|address| is_data(address)) else {
        return Err(format!("{} is not fetched", quote(first)));
    };
    if address.len() / 4 * 3 > *left {
        return Err(format!("there are more than {} MiB of them", MOST_BYTES >> 20));
    }
    let bytes = embedded(address)?;
    let kind = match bytes.first_chunk::<4>() {
        Some(b"wOFF") => Some("WOFF"),
        Some(b"wOF2") => Some("WOFF2"),
        _ => None,
    };
    if let Some(kind) = kind {
        return Err(format!("it is {kind}, not TrueType or OpenType"));
    }
    *left = left.saturating_sub(bytes.len());
    let mut own = Database::new();
    let found: Vec<ID> = own.load_font_source(Source::Binary(Arc::new(bytes))).to_vec();
    let Some(face) = found.first().and_then(|id| own.face(*id)) else {
        return Err("it is no TrueType or OpenType".to_owned());
    };
    let mut face = face.clone();
    face.families = vec![(rule.family.to_owned(), Language::English_UnitedStates)];
    face.weight = rule.weight.unwrap_or(face.weight);
    face.style = rule.style.unwrap_or(face.style);
    let all = Arc::make_mut(all);
    // It comes before one of the machine that has the same name (CSS Fonts 4, section 5.2).
    let same: Vec<ID> = all
        .faces()
        .filter(|known| is_named(known, rule.family) && !matches!(&known.source, Source::Binary(_)))
        .map(|known| known.id)
        .collect();
    for id in same {
        all.remove_face(id);
    }
    all.push_face_info(face);
    Ok(())
}

fn is_named(face: &usvg::fontdb::FaceInfo, family: &str) -> bool {
    face.families.iter().any(|(name, _)| name.eq_ignore_ascii_case(family))
}

/// The rules `@font-face` of a style sheet that name a family.
fn rules(css: &str) -> Vec<Rule<'_>> {
    let mut found = Vec::new();
    let mut rest = css;
    while let Some((_, after)) = rest.split_once("@font-face") {
        let Some((head, block)) = after.split_once('{') else {
            break;
        };
        let (body, after) = block.split_at(block_end(block));
        rest = after;
        let rule = Rule::of(body);
        if head.trim().is_empty() && !rule.family.is_empty() {
            found.push(rule);
        }
    }
    found
}

impl<'css> Rule<'css> {
    fn of(body: &'css str) -> Self {
        let mut rule = Self::default();
        for piece in declarations::pieces(body) {
            let Some((name, value)) = body[piece].trim_end_matches(';').split_once(':') else {
                continue;
            };
            let value = value.trim();
            match name.trim().to_ascii_lowercase().as_str() {
                "font-family" => rule.family = unquoted(value),
                "src" => rule.addresses.extend(addresses(value)),
                "font-weight" => rule.weight = weight(value),
                "font-style" => {
                    rule.style = Some(match value.split_whitespace().next() {
                        Some("italic") => Style::Italic,
                        Some("oblique") => Style::Oblique,
                        _ => Style::Normal,
                    });
                }
                _ => {}
            }
        }
        rule
    }
}

/// A weight; of a range there is none, as the typeface says it itself.
fn weight(value: &str) -> Option<Weight> {
    match value {
        "normal" => Some(Weight::NORMAL),
        "bold" => Some(Weight::BOLD),
        value => value
            .parse()
            .ok()
            .filter(|weight| (1..=1000).contains(weight))
            .map(Weight),
    }
}

/// The addresses in a list of sources.
fn addresses(sources: &str) -> impl Iterator<Item = &str> {
    sources.split("url(").skip(1).filter_map(|source| {
        let (address, _) = source.split_once(')')?;
        Some(unquoted(address))
    })
}

fn unquoted(text: &str) -> &str {
    text.trim().trim_matches(['"', '\'']).trim()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_are_read_as_far_as_they_name_typefaces() {
        let css = "a{b:c} @font-face { font-family: \"My Own\"; src: local('x'), url('data:font/ttf;base64,AA;=') format('truetype'), \
                   url(b.ttf); font-weight: bold; font-style: italic } @font-face{src:url(c)} @font-face";
        let found = rules(css);
        assert_eq!(found.len(), 1, "{found:?}");
        let Rule {
            family,
            addresses,
            weight,
            style,
        } = &found[0];
        assert_eq!(*family, "My Own");
        assert_eq!(addresses, &["data:font/ttf;base64,AA;=", "b.ttf"]);
        assert_eq!((*weight, *style), (Some(Weight::BOLD), Some(Style::Italic)));
    }

    #[test]
    fn what_cannot_be_read_is_told() {
        let told = |source: &str, left: usize| {
            let css = format!("@font-face{{font-family:Mine;src:url({source})}}");
            let mut all = Arc::new(Database::new());
            let added = add(&mut all, &rules(&css)[0], &mut { left });
            added.expect_err(source)
        };
        for (source, expected) in [
            ("https://fonts.example/a.woff2", "is not fetched"),
            ("data:font/woff2;base64,d09GMgAA", "it is WOFF2"),
            ("data:font/woff;base64,d09GRgAA", "it is WOFF,"),
            ("data:font/ttf;base64,AAEAAAAA", "no TrueType"),
            ("data:font/ttf;base64,!", "damaged"),
        ] {
            let line = told(source, MOST_BYTES);
            assert!(line.contains(expected), "{line}");
        }
        assert!(told("data:font/ttf;base64,AAEAAAAAAAAA", 3).contains("more than 32 MiB"));
    }

    #[test]
    fn typefaces_have_the_names_that_the_document_gives_them() {
        let bytes: String = epaint_default_fonts::HACK_REGULAR
            .iter()
            .flat_map(|byte| {
                let digits = [byte >> 4, byte & 15].map(|digit| char::from_digit(digit.into(), 16));
                ['%'].into_iter().chain(digits.into_iter().flatten())
            })
            .collect();
        let css = format!("@font-face{{font-family:Mine;font-weight:700;src:url(data:font/ttf,{bytes})}}");
        let mut all = Arc::new(Database::new());
        add(&mut all, &rules(&css)[0], &mut { MOST_BYTES }).expect("a typeface");
        let face = all.faces().next().expect("one face");
        assert_eq!((face.families[0].0.as_str(), face.weight), ("Mine", Weight::BOLD));
    }
}
