//! Long style sheets in pieces. At the end of every value simplecss counts lines from the beginning of its text, so that time grows
//! with the square of a sheet's length; that of pieces does not.

use std::ops::Range;

use roxmltree::Node;
use simplecss::StyleSheet;

/// Shortest piece, in bytes, and most pieces of a sheet: simplecss sorts all rules after each.
const LEAST: usize = 4 << 10;
const MOST_PIECES: usize = 100;

/// Adds the rules of `css`.
pub(super) fn parse<'css>(sheet: &mut StyleSheet<'css>, css: &'css str) {
    for piece in pieces(css) {
        sheet.parse_more(&css[piece]);
    }
}

/// The pieces of a sheet: each ends where a rule does.
pub(super) fn pieces(css: &str) -> Vec<Range<usize>> {
    let least = LEAST.max(css.len() / MOST_PIECES);
    let mut found = Vec::new();
    let [mut start, mut depth, mut at] = [0, 0_usize, 0];
    let bytes = css.as_bytes();
    while let Some(&byte) = bytes.get(at) {
        at += 1;
        match byte {
            b'/' if bytes.get(at) == Some(&b'*') => {
                at = css[at + 1..].find("*/").map_or(bytes.len(), |end| at + 1 + end + 2);
            }
            b'"' | b'\'' => {
                let end = bytes[at..].iter().position(|end| *end == byte || *end == b'\n');
                at = end.map_or(bytes.len(), |end| at + end + 1);
            }
            b'{' => depth += 1,
            b'}' => {
                depth = depth.saturating_sub(1);
                if depth == 0 && at - start >= least {
                    found.push(start..at);
                    start = at;
                }
            }
            _ => {}
        }
    }
    if start < bytes.len() || found.is_empty() {
        found.push(start..bytes.len());
    }
    found
}

/// Where in `text` an element `style` has to be cut for usvg, which parses each as one, and what to put there.
pub(super) fn cuts(text: &str, node: Node<'_, '_>) -> Option<(Vec<usize>, String)> {
    let css = node.text()?;
    if css.len() < 2 * LEAST || !matches!(node.attribute("type"), None | Some("" | "text/css")) {
        return None;
    }
    let range = node.first_child()?.range();
    // Where references to entities stand in it, places cannot be told.
    let raw = text.get(range.clone())?;
    let start = range.start + raw.find(css)?;
    let tag = text.get(node.range().start + 1..)?;
    let name = &tag[..tag.find(|c: char| c.is_ascii_whitespace() || matches!(c, '>' | '/'))?];
    let between = if raw.starts_with("<![CDATA[") {
        format!("]]></{name}><{name}><![CDATA[")
    } else {
        format!("</{name}><{name}>")
    };
    let ends = pieces(css).into_iter().map(|piece| piece.end);
    let cuts = ends.filter(|end| *end < css.len()).map(|end| start + end).collect();
    Some((cuts, between))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_end_with_rules_outside_of_everything() {
        let rule = ".a { x: '}'; fill: red; } /* } */ @media print { .b { y: 1 } }\n";
        let css = rule.repeat(1000);
        let found = pieces(&css);
        assert!(found.len() > 5 && found.len() <= MOST_PIECES + 1, "{}", found.len());
        let joined: String = found.iter().map(|piece| &css[piece.clone()]).collect();
        assert_eq!(joined, css, "nothing is lost");
        for piece in &found {
            let text = css[piece.clone()].trim_end();
            assert!(
                text.ends_with("red; }") || text.ends_with("} }"),
                "{}",
                &text[text.len() - 30..]
            );
        }
        let [mut whole, mut pieced] = [StyleSheet::new(), StyleSheet::new()];
        whole.parse_more(&css);
        parse(&mut pieced, &css);
        assert_eq!(pieced.rules.len(), whole.rules.len(), "the same rules");
        for css in ["", "a", "a{", "}}}", "/*", "'", "/*/"] {
            assert_eq!(pieces(css), vec![(0..css.len())], "{css}");
        }
    }
}
