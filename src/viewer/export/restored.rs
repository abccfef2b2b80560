//! Pictures that tell how they were made: finding their scene again, and what of it has changed since.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use crate::figure::{Guard, Record, RecordedFile};
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
    /// One line when its record cannot be used, or shows no scene.
    pub fn of_file(shot: &Path, read: ReadArguments) -> Result<Option<Self>, String> {
        let name = shot.display();
        let cure = "give its scene instead";
        let Some(record) = Record::of_file(shot).map_err(|error| format!("{name}: {error}; {cure}"))? else {
            return Ok(None);
        };
        if let Some(what) = without_scene(&record) {
            return Err(format!(
                "{name}: this is {what}, from which no scene comes back; give a scene, or a picture of one"
            ));
        }
        let mut spec = read(&record)
            .map_err(|error| format!("{name}: the command line in this picture is at fault: {error}; {cure}"))?;
        spec.scene = found_scene(&record, spec.scene, shot);
        Ok(Some(Self {
            shot: shot.to_owned(),
            record,
            spec,
        }))
    }

    /// What of the files has another content than when the picture was made, in one line for those who see the picture that
    /// is drawn of them now; `None` where all is as it was.
    pub fn changes(&self, files: &SceneFiles) -> Option<String> {
        Some(format!("{}: the picture may differ", self.changed(files)?))
    }

    /// The same without what follows from it.
    pub fn changed(&self, files: &SceneFiles) -> Option<String> {
        let mut changes = Changes::default();
        let then = self.record.scene.as_ref().map_or("", |scene| scene.sha256.as_str());
        let is_other = files.document.is_some_and(|now| differs(then, &now));
        if is_other {
            changes.changed.push(format!("the scene {}", self.spec.scene.address()));
        }
        changes.add_textures(&self.record, is_other, |address| {
            let (_, digest) = files.textures.iter().find(|(known, _)| known == address)?;
            Some(digest.to_string())
        });
        if !is_other {
            changes.add_new_textures(&self.record, files.textures.iter().map(|(address, _)| address.as_str()));
        }
        changes.line(&self.shot)
    }
}

/// What of the inputs of the picture `shot` has another content than `then`, when it was made, in one line; `now` is its record
/// as it would be made today.
pub fn changed_inputs(then: &Record, now: &Record, shot: &Path) -> Option<String> {
    let mut changes = Changes::default();
    for (then, now) in then.inputs.iter().zip(&now.inputs) {
        if !then.sha256.is_empty() && then.sha256 != now.sha256 {
            changes.changed.push(now.address.clone());
        }
    }
    let is_other = !changes.changed.is_empty();
    changes.add_textures(then, is_other, |address| {
        let mut textures = now.textures.iter();
        Some(textures.find(|texture| texture.address == address)?.sha256.clone())
    });
    if !is_other {
        changes.add_new_textures(then, now.textures.iter().map(|texture| texture.address.as_str()));
    }
    changes.line(shot)
}

/// What happened to the files of a picture since it was made.
#[derive(Debug, Default)]
struct Changes {
    /// These have another content.
    changed: Vec<String>,
    /// These were not read again, and why.
    missing: Vec<String>,
    /// These could not be read then.
    new: Vec<String>,
}

impl Changes {
    /// Compares the textures of then with those of today, of which `now` gives the digest. A scene that `is_other` may read
    /// others.
    fn add_textures(&mut self, then: &Record, is_other: bool, now: impl Fn(&str) -> Option<String>) {
        for texture in &then.textures {
            let name = format!("the texture {}", texture.address);
            match now(&texture.address) {
                Some(now) if texture.sha256.is_empty() || texture.sha256 == now => {}
                Some(_) => self.changed.push(name),
                None if is_other => self.missing.push(format!("{name} is no longer read")),
                None => self.missing.push(format!("{name} is gone")),
            }
        }
    }

    /// Textures that the same scene reads `now` and could not read then.
    fn add_new_textures<'a>(&mut self, then: &Record, now: impl Iterator<Item = &'a str>) {
        let known: HashSet<&str> = then.textures.iter().map(|texture| texture.address.as_str()).collect();
        let new = now.filter(|address| !known.contains(address));
        self.new.extend(new.map(|address| format!("the texture {address}")));
    }

    /// In one line; `None` where nothing happened.
    fn line(&self, shot: &Path) -> Option<String> {
        let shot = shot.display();
        let others = |all: &[String]| match all.len().saturating_sub(1) {
            0 => String::new(),
            1 => " and one more file".to_owned(),
            more => format!(" and {more} more files"),
        };
        let changed = self.changed.first().map(|first| {
            let others = others(&self.changed);
            format!("{first}{others} changed since {shot} was made (another SHA-256)")
        });
        let since = if changed.is_none() {
            format!(" since {shot} was made")
        } else {
            String::new()
        };
        let missing = self.missing.first().map(|first| match others(&self.missing) {
            others if others.is_empty() => format!("{first}{since}"),
            others => format!("{first}{since},{others} as well"),
        });
        let new = self.new.first().map(|first| {
            let others = others(&self.new);
            format!("{first}{others} could not be read when {shot} was made, and can be now")
        });
        let parts: Vec<String> = [changed, missing, new].into_iter().flatten().collect();
        (!parts.is_empty()).then(|| parts.join(", and "))
    }
}

impl SceneSource {
    /// Protects the files that the scene was read from, and those that it names and that were of no use.
    pub fn protect(&self, files: &SceneFiles, guard: &mut Guard) {
        if let Self::File(path) = self {
            let folder = path.parent().unwrap_or(Path::new(""));
            guard.protect(path);
            for named in &files.named {
                guard.protect(folder.join(named));
            }
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
    match (&named, &record.scene) {
        (SceneSource::File(path), Some(scene)) => SceneSource::File(found_file(scene, path, shot)),
        _ => named,
    }
}

/// Where a file of the picture `shot` is now that was called `named`, found as a scene is; `named` where it is nowhere.
pub fn found_file(file: &RecordedFile, named: &Path, shot: &Path) -> PathBuf {
    let folder = shot.parent().unwrap_or(Path::new(""));
    let beside = file.beside.as_ref().map(|beside| folder.join(beside));
    let places: Vec<PathBuf> = beside
        .into_iter()
        .chain([named.to_owned()])
        .filter(|path| path.is_file())
        .collect();
    let has_content = |path: &&PathBuf| {
        // One place alone needs no telling apart.
        let bytes = FolderResources::read_file(path).ok();
        places.len() > 1 && bytes.is_some_and(|bytes| !differs(&file.sha256, &FileDigest::of(&bytes)))
    };
    let found = places.iter().find(has_content).or(places.first());
    found.map_or(named.to_owned(), Clone::clone)
}

/// What a picture is that shows no scene alone.
fn without_scene(record: &Record) -> Option<&'static str> {
    match record.arguments.first().map(String::as_str) {
        Some("diff") => Some("the difference of two pictures"),
        Some("lesson") => Some("a slide of a lesson"),
        Some("sweep") => Some("the chart of a sweep"),
        _ => None,
    }
}
