//! Images: textures, and documents inside the document.
//!
//! usvg asks for an image when it meets one, and wants to know no more than its size. It gets a picture without pixels that
//! carries our number for it; the pixels stay with the textures.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use roxmltree::Node;
use usvg::fontdb::Database;
use usvg::{Image, ImageHrefResolver, ImageKind, Options};

use super::fallback::Fallbacks;
use super::families;
use super::fonts::{self, Missing};
use super::listener::Listener;
use super::own_triangles::{self, Drawn};
use super::{guarded, own_fonts, prepare, references};
use crate::scene::build::Builder;
use crate::scene::document::{self, Source};
use crate::scene::error::Fault;
use crate::scene::textures::{is_data, name_of};
use crate::scene::{Problem, SkippedKind, SourceLocation, TextureId, attributes, numbers};

/// Documents inside each other's images, at most.
const MAX_DEPTH: usize = 8;

/// The size of a texture that is missing, in texels.
const MISSING: [u32; 2] = [64; 2];

/// What an image shows.
#[derive(Debug)]
pub(super) enum Picture {
    /// Pixels.
    Texture(TextureId),
    /// A document, as usvg has it, and its own triangles by their numbers.
    Document(Box<usvg::Tree>, Vec<Option<Drawn>>),
}

/// What is loaded while usvg reads.
pub(super) struct Loading<'a, 'doc> {
    pub(super) builder: &'a mut Builder<'doc>,
    pub(super) pictures: Vec<Picture>,
    pub(super) missing: Vec<Missing>,
    /// Numbers of pictures by their addresses; nothing where there is none to show.
    known: HashMap<Cow<'doc, str>, Option<usize>>,
    /// Documents that are being read, inside each other.
    depth: usize,
}

impl<'a, 'doc> Loading<'a, 'doc> {
    pub(super) fn new(builder: &'a mut Builder<'doc>) -> Self {
        Self {
            builder,
            pictures: Vec::new(),
            missing: Vec::new(),
            known: HashMap::new(),
            depth: 0,
        }
    }

    fn add(&mut self, picture: Picture) -> usize {
        self.pictures.push(picture);
        self.pictures.len() - 1
    }

    /// The width and height of a picture.
    fn size(&self, number: usize) -> Option<[f32; 2]> {
        Some(match self.pictures.get(number)? {
            Picture::Texture(texture) => {
                let size = self.builder.textures.size(*texture).unwrap_or(MISSING);
                size.map(|texels| texels as f32)
            }
            Picture::Document(tree, _) => [tree.size().width(), tree.size().height()],
        })
    }

    /// What usvg gets for a picture.
    fn kind(&self, number: usize) -> Option<ImageKind> {
        match self.pictures.get(number)? {
            Picture::Texture(texture) => Some(header(self.builder.textures.size(*texture).unwrap_or(MISSING), number)),
            Picture::Document(tree, _) => empty_document(tree.size(), number),
        }
    }
}

/// The guard, also after a panic elsewhere.
fn lock<'l, 'a, 'doc>(loading: &'l Mutex<Loading<'a, 'doc>>) -> MutexGuard<'l, Loading<'a, 'doc>> {
    loading.lock().unwrap_or_else(PoisonError::into_inner)
}

/// usvg's tree of a document: `load` finds images by the addresses that they were given.
///
/// # Errors
/// [`Problem::Reader`] where usvg panics.
pub(super) fn tree(
    text: &str,
    fonts: Option<Arc<Database>>,
    loading: &Mutex<Loading<'_, '_>>,
    load: impl Fn(&str) -> Option<ImageKind> + Send + Sync,
) -> Result<Result<usvg::Tree, usvg::Error>, Problem> {
    let fonts = fonts.unwrap_or_default();
    let fallbacks = Fallbacks::default();
    let read = || {
        let options = Options {
            font_family: families::UNNAMED.to_owned(),
            fontdb: Arc::clone(&fonts),
            font_resolver: fonts::resolver(&fallbacks, |missing| {
                let found = &mut lock(loading).missing;
                if !missing.is_told_by(found) {
                    found.push(missing);
                }
            }),
            image_href_resolver: ImageHrefResolver {
                // Images have addresses of ours; what else asks for one, as a filter may, gets none.
                resolve_data: Box::new(|_, _, _| None),
                resolve_string: Box::new(|address, _| load(address)),
            },
            ..Options::default()
        };
        guarded::tree(text, &options)
    };
    match read()? {
        // Pictures are loaded once, and what is missing is told once.
        Ok(tree) if fallbacks.fail(&tree) => read(),
        read => Ok(read),
    }
}

/// The picture that an image of the document shows.
pub(super) fn load<'doc>(loading: &Mutex<Loading<'_, 'doc>>, node: Node<'doc, 'doc>) -> Option<ImageKind> {
    let address = attributes::href(node)?;
    let location = lock(loading).builder.locate(node);
    let number = numbered(loading, Cow::Borrowed(address), location)?;
    placed(loading, number, node, |message| {
        lock(loading).builder.warn(node, message);
    })
}

/// What usvg gets for a picture, unless the image that shows it is too small for where it lies: usvg has places as 32-bit floats,
/// and panics where such a rectangle is empty.
fn placed(
    loading: &Mutex<Loading<'_, '_>>,
    number: usize,
    image: Node<'_, '_>,
    warn: impl FnOnce(String),
) -> Option<ImageKind> {
    let (kind, size) = {
        let guard = lock(loading);
        (guard.kind(number)?, guard.size(number)?)
    };
    let is_placeable = is_placeable(image, size);
    if !is_placeable {
        warn("not drawn: it is too small for where it lies, or too long for its width".to_owned());
    }
    is_placeable.then_some(kind)
}

/// Whether what an image shows of a picture of this size is large enough beside its coordinates to be a rectangle in 32-bit floats,
/// which have 24 bits: what is kept of them is room for units such as inches. What depends on the view box or on letters is usvg's
/// to find out.
fn is_placeable(image: Node<'_, '_>, size: [f32; 2]) -> bool {
    const MOST: f32 = 65_536.0;
    let is_relative = |name: &str| {
        let value = image.attribute(name).unwrap_or("").trim_end();
        ["%", "em", "ex"].iter().any(|unit| value.ends_with(unit))
    };
    if ["x", "y", "width", "height"].into_iter().any(is_relative) {
        return true;
    }
    let number = |name| {
        numbers::leading(name, image.attribute(name).unwrap_or(""))
            .ok()
            .flatten()
    };
    let sides = ["width", "height"].map(|name| number(name).map(f32::abs));
    let scales = [0, 1].map(|axis| sides[axis].map(|side| side / size[axis]));
    let aspect = image.attribute("preserveAspectRatio").unwrap_or("").trim_start();
    let scales = match scales {
        [Some(across), Some(down)] if aspect.starts_with("none") => [across, down],
        [Some(across), Some(down)] => [across.min(down); 2],
        [across, down] => [across.or(down).unwrap_or(1.0); 2],
    };
    let least = (size[0] * scales[0]).min(size[1] * scales[1]);
    let farthest = ["x", "y"].map(|name| number(name).unwrap_or(0.0).abs());
    let farthest = farthest
        .into_iter()
        .chain(sides.into_iter().flatten())
        .fold(0.0, f32::max);
    // A side of zero shows nothing, and is usvg's to see.
    least <= 0.0 || farthest / least <= MOST
}

/// The number of the picture at an address, which is loaded when it is asked for first.
fn numbered<'doc>(
    loading: &Mutex<Loading<'_, 'doc>>,
    address: Cow<'doc, str>,
    location: SourceLocation,
) -> Option<usize> {
    let mut guard = lock(loading);
    if let Some(known) = guard.known.get(&address) {
        return *known;
    }
    let number = if is_document(&address) {
        let bytes = guard.builder.textures.document(&address);
        let deeper = guard.depth < MAX_DEPTH;
        guard.depth += 1;
        drop(guard);
        let tree = match bytes {
            Ok(_) if !deeper => Err(format!("more than {MAX_DEPTH} documents are inside each other")),
            Ok(bytes) => nested(loading, &bytes, location).map_err(|fault| fault.problem.to_string()),
            Err(trouble) => Err(trouble),
        };
        guard = lock(loading);
        guard.depth -= 1;
        match tree {
            Ok((tree, triangles)) => Some(guard.add(Picture::Document(Box::new(tree), triangles))),
            Err(trouble) => {
                let message = format!("image {}: {trouble}; it is not drawn", name_of(&address));
                guard.builder.report.warn(location, message);
                None
            }
        }
    } else {
        let texture = guard.builder.textures.request(address.clone(), location);
        Some(guard.add(Picture::Texture(texture)))
    };
    guard.known.insert(address, number);
    number
}

/// usvg's tree of a document inside an image, and its own triangles: it sees no other files.
fn nested(
    loading: &Mutex<Loading<'_, '_>>,
    bytes: &[u8],
    location: SourceLocation,
) -> Result<(usvg::Tree, Vec<Option<Drawn>>), Fault> {
    let unpacked = document::unpacked(bytes)?;
    let text = document::decode(&unpacked)?;
    let source = Source::new(&text)?;
    let tree = source.parse()?;
    let usual = source.in_usual_case(&tree);
    let again = usual.as_deref().map(Source::new).transpose()?;
    let tree_again = again.as_ref().map(Source::parse).transpose()?;
    let (source, tree) = again.as_ref().zip(tree_again.as_ref()).unwrap_or((&source, &tree));
    let root = tree.root_element();
    if root.tag_name().name() != "svg" {
        return Err(Problem::NotSvg(root.tag_name().name().to_owned()).nowhere());
    }
    let mut listener = Outside { loading, location };
    for (_, message) in source.told() {
        listener.warn(root, message.clone());
    }
    let prepared = prepare::prepare(root, source.text(), &mut listener)?;
    references::check(root, &prepared.graph, &mut listener)?;
    let fonts = prepared.letters;
    let fonts = fonts.map(|_| own_fonts::joined(fonts::database(), root, &mut listener));
    let load = |address: &str| {
        let node = *prepared.images.get(prepared.elements.number(address)?)?;
        let address = attributes::href(node).filter(|address| is_data(address))?;
        let number = numbered(loading, Cow::Owned(address.to_owned()), location)?;
        placed(loading, number, node, |message| {
            let message = format!("in the image: {message}");
            lock(loading).builder.report.warn(location, message);
        })
    };
    let tree = self::tree(&prepared.text, fonts, loading, load).map_err(Problem::nowhere)?;
    let tree = tree.map_err(|error| Problem::Xml(error.to_string()).nowhere())?;
    let (triangles, report) = own_triangles::drawn(source, prepared.elements.triangles(), |address| {
        lock(loading).builder.textures.request(address.to_owned(), location)
    });
    let heard = &mut lock(loading).builder.report;
    for skipped in report.skipped {
        heard.skip(skipped.kind, &skipped.name, location);
    }
    for warning in report.warnings {
        heard.warn(location, format!("in the image: {}", warning.message));
    }
    Ok((tree, triangles))
}

/// Hears of what a document in an image lacks, and tells it of the image.
struct Outside<'l, 'a, 'doc> {
    loading: &'l Mutex<Loading<'a, 'doc>>,
    location: SourceLocation,
}

impl Listener for Outside<'_, '_, '_> {
    fn skip(&mut self, kind: SkippedKind, name: &str, _node: Node<'_, '_>) {
        lock(self.loading).builder.report.skip(kind, name, self.location);
    }

    fn warn(&mut self, _node: Node<'_, '_>, message: String) {
        let message = format!("in the image: {message}");
        lock(self.loading).builder.report.warn(self.location, message);
    }

    fn warn_at(&mut self, _at: usize, node: Node<'_, '_>, message: String) {
        self.warn(node, message);
    }

    fn fault(&self, problem: Problem, _node: Node<'_, '_>, _attribute: &str) -> Fault {
        problem.at(self.location)
    }
}

/// Whether an address names a document rather than pixels.
fn is_document(address: &str) -> bool {
    let address = address.trim();
    if is_data(address) {
        let kind = address.get(5..).unwrap_or("").trim_start();
        return kind
            .get(..13)
            .is_some_and(|kind| kind.eq_ignore_ascii_case("image/svg+xml"));
    }
    let path = address.split(['?', '#']).next().unwrap_or("");
    let ending = path.rsplit_once('.').map_or("", |(_, ending)| ending);
    ["svg", "svgz"].iter().any(|known| ending.eq_ignore_ascii_case(known))
}

/// The picture that usvg's image stands for.
pub(super) fn of<'p>(image: &Image, pictures: &'p [Picture]) -> Option<&'p Picture> {
    let number = match image.kind() {
        ImageKind::PNG(bytes) => {
            let number = bytes.strip_prefix(SIGNATURE)?.get(HEADER..)?;
            usize::try_from(u64::from_be_bytes(number.try_into().ok()?)).ok()?
        }
        ImageKind::SVG(tree) => tree
            .root()
            .children()
            .first()?
            .id()
            .strip_prefix(PICTURE)?
            .parse()
            .ok()?,
        _ => return None,
    };
    pictures.get(number)
}

/// What every PNG begins with.
const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
/// Bytes of a PNG's header behind the signature, up to the height.
const HEADER: usize = 16;
/// Begins the id in a document that only has a size.
const PICTURE: &str = "picture";

/// The beginning of a PNG of this size, with our number in the place of pixels.
fn header([width, height]: [u32; 2], number: usize) -> ImageKind {
    let mut bytes = SIGNATURE.to_vec();
    bytes.extend(b"\0\0\0\x0dIHDR");
    bytes.extend([width, height].map(u32::to_be_bytes).concat());
    bytes.extend((number as u64).to_be_bytes());
    ImageKind::PNG(Arc::new(bytes))
}

/// A document of this size with our number, and nothing else.
fn empty_document(size: usvg::Size, number: usize) -> Option<ImageKind> {
    let text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\"><g id=\"{PICTURE}{number}\"/></svg>",
        size.width(),
        size.height()
    );
    usvg::Tree::from_str(&text, &Options::default())
        .ok()
        .map(ImageKind::SVG)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_tell_documents_from_pixels() {
        for (address, expected) in [
            ("a.svg", true),
            ("a.b/C.SVGZ", true),
            (" a.svg#layer", true),
            ("a.png", false),
            ("svg", false),
            ("data:image/svg+xml;base64,AA", true),
            ("data:image/SVG+XML,%3Csvg", true),
            ("data:image/png;base64,AA.svg", false),
        ] {
            assert_eq!(is_document(address), expected, "{address}");
        }
    }

    #[test]
    fn pictures_of_a_size_carry_their_number() {
        let sizes = [
            header([3, 70_000], 258),
            empty_document(usvg::Size::from_wh(2.5, 0.25).expect("a size"), 258).expect("a document"),
        ];
        let pictures: Vec<Picture> = (0..300).map(|i| Picture::Texture(TextureId(i))).collect();
        for kind in sizes {
            let address = "_0_picture0";
            let load = move |_: &str| Some(kind.clone());
            let options = Options {
                image_href_resolver: ImageHrefResolver {
                    resolve_data: Box::new(|_, _, _| None),
                    resolve_string: Box::new(move |address, _| load(address)),
                },
                ..Options::default()
            };
            let text =
                format!("<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'><image href='{address}'/></svg>");
            let tree = usvg::Tree::from_str(&text, &options).expect("a tree");
            let Some(usvg::Node::Group(group)) = tree.root().children().first() else {
                panic!("a group");
            };
            let Some(usvg::Node::Image(image)) = group.children().first() else {
                panic!("an image");
            };
            assert!(
                matches!(of(image, &pictures), Some(Picture::Texture(TextureId(258)))),
                "its number"
            );
        }
    }
}
