//! Pictures that tell how they were made: finding their scene again, and what of it has changed since.

use std::path::{Path, PathBuf};

use crate::figure::{Guard, Record};
use crate::scene::{FileDigest, FolderResources, SceneFiles};
use crate::viewer::export::sheet::preview::ReadSheet;
use crate::viewer::export::spec::PictureSpec;
use crate::viewer::library::SceneSource;

/// Reads the arguments of a record by the grammar of the command line.
pub type ReadArguments = fn(&Record) -> Result<PictureSpec, String>;

/// The grammar of the command line, which lies above the viewer.
#[derive(Clone, Copy, Debug)]
pub struct Grammar {
    /// Reads the command lines that pictures carry.
    pub picture: ReadArguments,
    /// Reads the command lines of sheets.
    pub sheet: ReadSheet,
}

/// A picture whose record was read: the state to come back to.
#[derive(Clone, Debug, PartialEq)]
pub struct Restored {
    /// The picture's file.
    pub shot: PathBuf,
    /// What it tells.
    pub record: Record,
    /// The same, understood; its scene is where it is found now.
    pub spec: PictureSpec,
}

impl Restored {
    /// The state that the PNG file `shot` tells; `None` where it has no record.
    ///
    /// # Errors
    /// One line when its record cannot be used.
    pub fn of_file(shot: &Path, read: ReadArguments) -> Result<Option<Self>, String> {
        let name = shot.display();
        let cure = "give its scene instead";
        let Some(record) = Record::of_file(shot).map_err(|error| format!("{name}: {error}; {cure}"))? else {
            return Ok(None);
        };
        let mut spec = read(&record)
            .map_err(|error| format!("{name}: the command line in this picture is at fault: {error}; {cure}"))?;
        spec.scene = found_scene(&record, spec.scene, shot);
        Ok(Some(Self {
            shot: shot.to_owned(),
            record,
            spec,
        }))
    }

    /// What of the files has another content than when the picture was made, in one line; `None` where all is as it was.
    pub fn changes(&self, files: &SceneFiles) -> Option<String> {
        let mut changed = Vec::new();
        let then = self.record.scene.as_ref().map_or("", |scene| scene.sha256.as_str());
        if files.document.is_some_and(|now| differs(then, &now)) {
            changed.push(format!("the scene {}", self.spec.scene.address()));
        }
        for texture in &self.record.textures {
            let now = files.textures.iter().find(|(address, _)| *address == texture.address);
            match now {
                Some((_, now)) if !differs(&texture.sha256, now) => {}
                Some(_) => changed.push(format!("the texture {}", texture.address)),
                None => changed.push(format!("the texture {}, which is gone,", texture.address)),
            }
        }
        let first = changed.first()?;
        let others = match changed.len() - 1 {
            0 => String::new(),
            1 => " and one more file".to_owned(),
            more => format!(" and {more} more files"),
        };
        let shot = self.shot.display();
        Some(format!(
            "{first}{others} changed since {shot} was made (another SHA-256): the picture may differ"
        ))
    }
}

impl SceneSource {
    /// Protects the files that the scene was read from.
    pub fn protect(&self, files: &SceneFiles, guard: &mut Guard) {
        if let Self::File(path) = self {
            guard.protect(path);
            guard.protect_contents(files.textures.iter().map(|(_, digest)| *digest));
        }
    }
}

/// Whether a file had another digest then; nothing is known where none was recorded.
pub(in crate::viewer) fn differs(then: &str, now: &FileDigest) -> bool {
    !then.is_empty() && now.to_string() != then
}

/// Where the scene of a record is now: in the gallery, at its place beside the picture, or at the address of the command
/// line, whichever still has the content of then; else the first that exists.
fn found_scene(record: &Record, named: SceneSource, shot: &Path) -> SceneSource {
    let (SceneSource::File(path), Some(scene)) = (&named, &record.scene) else {
        return named;
    };
    let folder = shot.parent().unwrap_or(Path::new(""));
    let beside = scene.beside.as_ref().map(|beside| folder.join(beside));
    let places: Vec<PathBuf> = beside
        .into_iter()
        .chain([path.clone()])
        .filter(|path| path.is_file())
        .collect();
    let has_content = |path: &&PathBuf| {
        // One place alone needs no telling apart.
        let bytes = FolderResources::read_file(path).ok();
        places.len() > 1 && bytes.is_some_and(|bytes| !differs(&scene.sha256, &FileDigest::of(&bytes)))
    };
    let found = places.iter().find(has_content).or(places.first());
    found.map_or(named.clone(), |path| SceneSource::File(path.clone()))
}
