//! Documents to scenes: XML, dialects, attributes and styles, everything resolved.
//!
//! What leaves this room holds no string that is still to be interpreted: user-space geometry in painter's order,
//! colours as numbers, textures decoded. Every shape remembers where in the document it stands.

mod attributes;
mod build;
mod course;
mod course_values;
mod css;
mod css_colors;
mod cut_off;
mod declarations;
mod dialect;
mod digest;
mod document;
mod edits;
mod entities;
mod error;
mod location;
mod media;
mod model;
mod named_files;
mod numbers;
mod places;
mod plain_styles;
mod progress;
mod quotes;
mod report;
mod resources;
mod selectors;
pub(crate) mod spelling;
mod substitutes;
mod svg;
mod texture_files;
mod textures;
mod tiles;
mod triangles;
mod turned;
mod unreadable;
mod words;

use std::path::Path;

use build::Builder;
use course::CourseReader;
use document::{LineIndex, Source};
use error::Fault;
use textures::{Alpha, TextureTable};

use crate::memory;

pub use dialect::{DialectChoice, ReadOptions, is_of_course};
pub use digest::{FileDigest, SceneFiles};
pub use error::{Problem, SceneError};
pub use location::SourceLocation;
pub use model::{
    Composite, Dialect, Fill, Gradient, GradientId, MaskKind, Paint, Pattern, PatternId, Primitive, PrimitiveKind,
    Scene, Shape, ShapeId, TextureId,
};
pub use progress::Progress;
pub use quotes::Quotes;
pub use report::{Report, Skipped, SkippedKind, Warning};
pub use resources::{FolderResources, NoResources, ResourceError, Resources};
pub use svg::{Fonts, more_fonts, set_fonts};

/// Largest scene file, in bytes.
const MAX_DOCUMENT_BYTES: u64 = 256 << 20;

/// Largest document whose text is kept to be quoted, in bytes.
const MAX_KEPT_DOCUMENT: usize = 32 << 20;

/// About what a byte of a document takes as text, tree, shapes, and primitives that are drawn; and the most of that.
const MEMORY_PER_BYTE: u64 = 32;
const MAX_MEMORY: u64 = 1 << 30;

impl Scene {
    /// Reads the scene in the file `path`, in the dialect that the document seems to be meant in; as the function
    /// [`load`] with [`DialectChoice::Auto`].
    ///
    /// # Errors
    /// When the file cannot be read or is no drawing. What is skipped, such as a texture that is missing, is in
    /// [`Scene::report`].
    pub fn load(path: impl AsRef<Path>) -> Result<Self, SceneError> {
        load(path.as_ref(), DialectChoice::Auto)
    }
}

/// Whether a file is a document by the ending of its name: `.svg`, or `.svgz` where it is compressed.
pub fn is_document(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default();
    ["svg", "svgz"].iter().any(|known| ending.eq_ignore_ascii_case(known))
}

/// Reads the scene in the file `path`; textures are looked for relative to its folder.
///
/// # Errors
/// When the file cannot be read or is no drawing; a missing texture is only a warning in [`Scene::report`].
pub fn load(path: &Path, dialect: DialectChoice) -> Result<Scene, SceneError> {
    load_watched(path, dialect, &Progress::default())
}

/// As [`load`], while somebody waits who may give it up.
///
/// # Errors
/// As [`load`], and when it was given up.
pub fn load_watched(path: &Path, dialect: DialectChoice, progress: &Progress) -> Result<Scene, SceneError> {
    let name = path.display().to_string();
    let document = resources::read_file(path, MAX_DOCUMENT_BYTES).map_err(|error| SceneError {
        file: name.clone(),
        location: None,
        line: None,
        problem: error.into(),
    })?;
    read_watched(
        &document,
        &name,
        ReadOptions { dialect },
        &FolderResources::beside(path),
        progress,
    )
}

/// Reads the scene in `document`, called `name` in messages; textures come from `resources`.
///
/// # Errors
/// As [`load`].
pub fn read(document: &[u8], name: &str, options: ReadOptions, resources: &dyn Resources) -> Result<Scene, SceneError> {
    read_watched(document, name, options, resources, &Progress::default())
}

/// As [`read`], while somebody waits who may give it up.
///
/// # Errors
/// As [`read`], and when it was given up.
pub fn read_watched(
    document: &[u8],
    name: &str,
    options: ReadOptions,
    resources: &dyn Resources,
    progress: &Progress,
) -> Result<Scene, SceneError> {
    let mut scene = read_bytes(document, options, resources, progress).map_err(|fault| fault.in_file(name))?;
    scene.name = name.into();
    Ok(scene)
}

fn read_bytes(
    bytes: &[u8],
    options: ReadOptions,
    resources: &dyn Resources,
    progress: &Progress,
) -> Result<Scene, Fault> {
    let packed = bytes;
    let bytes = &*document::unpacked(packed)?;
    let memory = (bytes.len() as u64).saturating_mul(MEMORY_PER_BYTE).min(MAX_MEMORY);
    memory::ask_for(memory).map_err(|error| Problem::from(error).nowhere())?;
    let text = document::decode(bytes)?;
    let mut scene =
        read_text(&text, options, resources, progress).map_err(|fault| Quotes::of(&text).with_line(fault))?;
    scene.files.document = Some(FileDigest::of(packed));
    scene.document = (text.len() <= MAX_KEPT_DOCUMENT).then(|| text.as_ref().into());
    Ok(scene)
}

fn read_text(text: &str, options: ReadOptions, resources: &dyn Resources, progress: &Progress) -> Result<Scene, Fault> {
    // About as their times are.
    progress.reach(0.05);
    let source = Source::new(text)?;
    let tree = source.parse()?;
    progress.reach(build::BEFORE_SHAPES);
    progress.go_on()?;
    let root = tree.root_element();
    let lines = LineIndex::new(text);
    if root.tag_name().name() != "svg" {
        let name = root.tag_name().name().to_owned();
        return Err(Problem::NotSvg(name).at(lines.locate(source.original_offset(root.range().start))));
    }
    let (dialect, other) = options.dialect.resolve(root);
    let usual = (dialect == Dialect::Svg).then(|| source.in_usual_case(&tree)).flatten();
    let again = usual.as_deref().map(Source::new).transpose()?;
    let tree_again = again.as_ref().map(Source::parse).transpose()?;
    let (source, tree) = again.as_ref().zip(tree_again.as_ref()).unwrap_or((&source, &tree));
    let root = tree.root_element();
    let alpha = match dialect {
        Dialect::Course => Alpha::Drop,
        Dialect::Svg => Alpha::Keep,
    };
    let mut builder = Builder::new(source, &lines, TextureTable::new(resources, alpha), progress);
    let canvas = match dialect {
        Dialect::Course => {
            let canvas = CourseReader::read(&mut builder, root)?;
            // Those who chose it know the other, and two readings are told of elsewhere.
            if options.dialect != DialectChoice::Course && other.is_none() {
                course::tell_of_svg(&mut builder, root);
            }
            canvas
        }
        Dialect::Svg => svg::read(&mut builder, root, source.text())?,
    };
    if canvas.min_element() <= 0.0 {
        let (width, height) = (canvas.x, canvas.y);
        return Err(Problem::Canvas { width, height }.at(builder.locate(root)));
    }
    builder.find_edges()?;
    let room = builder.textures.ask_for_room();
    room.map_err(|error| Problem::from(error).nowhere())?;
    let mut scene = builder.finish(dialect, canvas);
    scene.other_reading = other;
    scene.words = words::of(tree);
    scene.files.named = named_files::below(root);
    Ok(scene)
}
