//! The files that a document names for its pictures, whether or not they are drawn or could be read: none of them may be
//! written over.

use std::collections::HashSet;

use roxmltree::Node;

use super::attributes;
use super::textures::{is_data, resolved};

/// Most files of a document that are kept: many times as many as are read.
const MOST: usize = 65_536;
/// Most bytes of a path that a system opens.
const LONGEST: usize = 4_096;

/// Their paths relative to the document, as they are written and as they are resolved, each once.
pub(super) fn below(root: Node<'_, '_>) -> Vec<String> {
    let mut known = HashSet::new();
    let mut paths = Vec::new();
    let addresses = root.descendants().flat_map(addresses).map(str::trim);
    for address in addresses.filter(|address| !address.is_empty() && address.len() <= LONGEST && !is_data(address)) {
        if paths.len() >= MOST {
            break;
        }
        if known.insert(address) {
            let resolved = resolved(address);
            if resolved != address {
                paths.push(resolved);
            }
            paths.push(address.to_owned());
        }
    }
    paths
}

/// What an element names: by the attribute that is right, or by the one that is mistaken for it.
fn addresses<'doc>(node: Node<'doc, 'doc>) -> impl Iterator<Item = &'doc str> {
    let names_files = matches!(node.tag_name().name(), "texture" | "textri" | "image" | "feImage");
    let addresses = [node.attribute("filename"), attributes::href(node)];
    addresses.into_iter().flatten().filter(move |_| names_files)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(body: &str) -> Vec<String> {
        let text = format!("<svg xmlns='http://www.w3.org/2000/svg'>{body}</svg>");
        let tree = roxmltree::Document::parse(&text).expect("XML");
        below(tree.root_element())
    }

    #[test]
    fn named_files_are_those_of_textures_and_images() {
        let body = "<texture texid='t' filename='a%20b.png'/><g><image href=' c.jpg '/><image href='c.jpg'/></g>\
                    <texture href='d.png'/><image href='data:image/png,x'/><image href=''/><use href='#e'/>";
        assert_eq!(named(body), ["a b.png", "a%20b.png", "c.jpg", "d.png"], "each once");
    }

    #[test]
    fn named_files_are_bounded() {
        let images: Vec<String> = (0..MOST + 9).map(|i| format!("<image href='{i}'/>")).collect();
        assert_eq!(named(&images.concat()).len(), MOST, "no more of them");
        let long = "x".repeat(LONGEST + 1);
        assert!(
            named(&format!("<image href='{long}'/>")).is_empty(),
            "no path is so long"
        );
    }
}
