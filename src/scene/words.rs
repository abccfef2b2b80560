//! What a document says about itself, for people: its title and description, or the comment at its start.

use std::sync::Arc;

use roxmltree::{Document, Node};

use crate::plain;

/// Characters that are kept.
const MOST: usize = 2000;

/// The words of a document, a paragraph a line; `None` where it has none.
pub(super) fn of(tree: &Document<'_>) -> Option<Arc<str>> {
    let root = tree.root_element();
    let child = |name: &str| root.children().find(|node| node.tag_name().name() == name);
    let told = [child("title"), child("desc")].into_iter().flatten().map(text_of);
    let words: Vec<String> = told.flat_map(|text| paragraphs(&text)).collect();
    let words = if words.is_empty() { comment(tree) } else { words };
    let text = words.join("\n");
    if text.is_empty() {
        return None;
    }
    let kept: String = text.chars().take(MOST).collect();
    let kept = if kept.len() < text.len() {
        format!("{kept} …")
    } else {
        kept
    };
    Some(plain::lines(&kept).as_ref().into())
}

/// All text inside an element.
fn text_of(node: Node<'_, '_>) -> String {
    node.descendants()
        .filter_map(|node| node.text().filter(|_| node.is_text()))
        .collect()
}

/// The first comment that says something, before the root or as the first thing in it.
fn comment(tree: &Document<'_>) -> Vec<String> {
    let root = tree.root_element();
    let before = tree.root().children().take_while(|node| *node != root);
    let inside = root.children().take_while(|node| !node.is_element());
    let comments = before.chain(inside).filter(Node::is_comment);
    let mut texts = comments.filter_map(|node| node.text()).map(paragraphs);
    texts.find(|paragraphs| !paragraphs.is_empty()).unwrap_or_default()
}

/// Text in lines as paragraphs, which blank lines part.
fn paragraphs(text: &str) -> Vec<String> {
    let mut paragraphs = vec![Vec::new()];
    for line in text.lines().map(str::trim) {
        match paragraphs.last_mut() {
            Some(words) if !line.is_empty() => words.push(line),
            Some(words) if words.is_empty() => {}
            _ => paragraphs.push(Vec::new()),
        }
    }
    let joined = paragraphs.into_iter().map(|lines| lines.join(" "));
    joined.filter(|paragraph| !paragraph.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(document: &str) -> Option<String> {
        let tree = Document::parse(document).expect("XML");
        of(&tree).map(|words| words.to_string())
    }

    #[test]
    fn words_are_title_and_description_or_the_first_comment() {
        let both = "<svg><!-- a tool --><title>A  fan</title><desc>Of\n edges,\n\nfine.</desc></svg>";
        assert_eq!(words(both).as_deref(), Some("A  fan\nOf edges,\nfine."));
        assert_eq!(words("<!--\n  two\n  lines\n--><svg/>").as_deref(), Some("two lines"));
        assert_eq!(words("<svg><!-- inside --><g/></svg>").as_deref(), Some("inside"));
        assert_eq!(
            words("<!-- --><svg><g/><!-- late --></svg>"),
            None,
            "nothing at the start"
        );
        assert_eq!(
            words("<svg><g><title>of a group</title></g></svg>"),
            None,
            "not the scene's"
        );
        let hostile = format!("<svg><desc>\u{202e}{}</desc></svg>", "x".repeat(9000));
        let kept = words(&hostile).expect("words");
        assert!(kept.len() < 2100 && !kept.contains('\u{202e}'), "short and plain");
    }
}
