//! The `texture`s of a document by their `texid`s, and what is wrong where a `textri` finds none.

use std::collections::HashMap;

use roxmltree::Node;

use super::attributes;
use super::report::quote;
use super::spelling::nearest;

/// Textures that are looked through for one that may be meant.
const LOOKED_AT: usize = 1_000;
/// Names that a message lists.
const LISTED: usize = 5;
/// Attributes that people write for `filename`.
const FOR_FILENAME: [&str; 5] = ["href", "src", "file", "path", "url"];

/// The textures that a document defines.
#[derive(Debug)]
pub(super) struct TextureFiles<'doc> {
    by_texid: HashMap<&'doc str, Node<'doc, 'doc>>,
    /// By what stands in the place of a `texid`: which attribute that is.
    misnamed: HashMap<&'doc str, &'doc str>,
    /// The first names in the order of the document.
    first: Vec<&'doc str>,
}

impl<'doc> TextureFiles<'doc> {
    /// All definitions below `root`, wherever they stand; of two with one name the later counts.
    pub(super) fn below(root: Node<'doc, 'doc>) -> Self {
        let mut files = Self {
            by_texid: HashMap::new(),
            misnamed: HashMap::new(),
            first: Vec::new(),
        };
        for node in root.descendants().filter(|node| node.tag_name().name() == "texture") {
            let texid = node.attribute("texid");
            if let Some(attribute) = texid.is_none().then(|| instead_of_texid(node)).flatten() {
                files
                    .misnamed
                    .insert(node.attribute(attribute).unwrap_or(""), attribute);
            }
            let texid = texid.unwrap_or("");
            let is_new = files.by_texid.insert(texid, node).is_none();
            if is_new && !texid.is_empty() && files.first.len() < LOOKED_AT {
                files.first.push(texid);
            }
        }
        files
    }

    /// The file of the texture with this name.
    pub(super) fn file(&self, texid: &str) -> Option<&'doc str> {
        let file = self.by_texid.get(texid)?.attribute("filename")?;
        (!file.trim().is_empty()).then_some(file)
    }

    /// Why a `textri` has no file, and what to do about it.
    pub(super) fn trouble(&self, triangle: Node<'_, '_>) -> String {
        let Some(texid) = triangle.attribute("texid") else {
            return self.without_texid(triangle);
        };
        if let Some(definition) = self.by_texid.get(texid).filter(|_| !texid.is_empty()) {
            return without_filename(*definition);
        }
        let name = quote(texid);
        let file = triangle.attribute("filename").map(quote);
        let alike = |other: &&&str| other.trim().eq_ignore_ascii_case(texid.trim());
        if let Some(attribute) = self.misnamed.get(texid) {
            format!("its <texture> has {attribute}=\"{name}\"; write texid=\"{name}\" there")
        } else if let Some(other) = self.first.iter().find(alike) {
            let other = quote(other);
            format!("no <texture> has texid=\"{name}\", but one has texid=\"{other}\"; write both alike")
        } else if let Some(file) = file {
            format!("a <textri> has no filename; add <texture texid=\"{name}\" filename=\"{file}\"/>")
        } else if self.first.is_empty() {
            format!("the document has no <texture> with a texid; add <texture texid=\"{name}\" filename=\"FILE.png\"/>")
        } else {
            format!(
                "no <texture> has texid=\"{name}\"; give it one of those that are there: {}",
                self.listed()
            )
        }
    }

    fn without_texid(&self, triangle: Node<'_, '_>) -> String {
        let is_texid = |name: &&str| {
            triangle
                .attribute(*name)
                .is_some_and(|id| self.by_texid.contains_key(id))
        };
        let meant = misspelt(triangle, "texid").or(Some("id").filter(is_texid));
        if let Some(meant) = meant {
            format!("its <textri> has {} where texid is read; write texid", quote(meant))
        } else if self.first.is_empty() {
            "its <textri> has no texid; add <texture texid=\"t\" filename=\"FILE.png\"/> to the document and texid=\"t\" here"
                .to_owned()
        } else {
            format!(
                "its <textri> has no texid; give it one of those that are there: {}",
                self.listed()
            )
        }
    }

    /// The first names, and how many more there are.
    fn listed(&self) -> String {
        let names: Vec<String> = self.first.iter().take(LISTED).map(|name| quote(name)).collect();
        let names = names.join(", ");
        let all = self.by_texid.len() - usize::from(self.by_texid.contains_key(""));
        match all.saturating_sub(LISTED) {
            0 => names,
            more => format!("{names} and {more} more"),
        }
    }
}

/// The attribute of an element that stands for another up to a slip, where that is missing.
pub(super) fn misspelt<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    nearest(name, node.attributes().map(|attribute| attribute.name()))
}

/// The attribute that stands for the `texid` of a texture.
fn instead_of_texid<'a>(texture: Node<'a, '_>) -> Option<&'a str> {
    let has = |name: &&str| texture.has_attribute(*name);
    misspelt(texture, "texid").or(["id", "name"].into_iter().find(has))
}

/// What is wrong with a texture that names no file.
fn without_filename(texture: Node<'_, '_>) -> String {
    let has = |name: &&str| texture.has_attribute(*name);
    let linked = attributes::href(texture).map(|_| "href");
    let meant = misspelt(texture, "filename").filter(|name| *name != "filename");
    let meant = meant.or(linked).or(FOR_FILENAME.into_iter().find(has));
    let text = texture.text().map(str::trim).filter(|text| !text.is_empty());
    match (meant, text) {
        (Some(meant), _) => format!(
            "its <texture> has {} where filename is read; write filename",
            quote(meant)
        ),
        (None, Some(text)) => format!(
            "its <texture> has the file's name inside; write it as filename=\"{}\"",
            quote(text)
        ),
        (None, None) => "its <texture> names no file; write filename=\"FILE.png\" there".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is told of the first `textri` of a document.
    fn trouble(body: &str) -> String {
        let text = format!("<svg>{body}</svg>");
        let tree = roxmltree::Document::parse(&text).expect("XML");
        let files = TextureFiles::below(tree.root_element());
        let triangle = tree.descendants().find(|node| node.has_tag_name("textri"));
        files.trouble(triangle.expect("a triangle"))
    }

    #[test]
    fn texture_files_tell_each_mistake_with_its_cure() {
        let t = "<texture texid='t' filename='a.png'/>";
        let many: Vec<String> = (0..8)
            .map(|i| format!("<texture texid='m{i}' filename='a.png'/>"))
            .collect();
        let many = many.concat();
        for (body, expected) in [
            (
                format!("{t}<textri texid='T'/>"),
                "no <texture> has texid=\"T\", but one has texid=\"t\"; write both alike",
            ),
            (
                "<textri texid='t'/>".to_owned(),
                "the document has no <texture> with a texid; add <texture texid=\"t\" filename=\"FILE.png\"/>",
            ),
            (
                format!("{many}<textri texid='t'/>"),
                "no <texture> has texid=\"t\"; give it one of those that are there: m0, m1, m2, m3, m4 and 3 more",
            ),
            (
                "<texture id='t' filename='a.png'/><textri texid='t'/>".to_owned(),
                "its <texture> has id=\"t\"; write texid=\"t\" there",
            ),
            (
                "<textri texid='t' filename='a.png'/>".to_owned(),
                "a <textri> has no filename; add <texture texid=\"t\" filename=\"a.png\"/>",
            ),
            (
                "<texture texid='t' href='a.png'/><textri texid='t'/>".to_owned(),
                "its <texture> has href where filename is read; write filename",
            ),
            (
                "<texture texid='t' fileName='a.png'/><textri texid='t'/>".to_owned(),
                "its <texture> has fileName where filename is read; write filename",
            ),
            (
                "<texture texid='t'> a.png </texture><textri texid='t'/>".to_owned(),
                "its <texture> has the file's name inside; write it as filename=\"a.png\"",
            ),
            (
                "<texture texid='t' filename=''/><textri texid='t'/>".to_owned(),
                "its <texture> names no file; write filename=\"FILE.png\" there",
            ),
            (
                format!("{t}<textri texId='t'/>"),
                "its <textri> has texId where texid is read; write texid",
            ),
            (
                format!("{t}<textri id='t'/>"),
                "its <textri> has id where texid is read; write texid",
            ),
            (
                format!("{t}<textri id='floor'/>"),
                "its <textri> has no texid; give it one of those that are there: t",
            ),
        ] {
            assert_eq!(trouble(&body), expected, "{body}");
        }
    }
}
