//! Where the files that a document names come from: a folder on disk, or whatever implements [`Resources`].

use std::fs::File;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

/// Largest texture file, in bytes.
const MAX_RESOURCE_BYTES: u64 = 256 << 20;

/// Hands out the bytes of files that a document refers to. Called from several threads at once.
pub trait Resources: Sync {
    /// The bytes behind `address`, which is as the document writes it: a path with `/`, relative to the document.
    ///
    /// # Errors
    /// When there is no such thing, or it is unfit to be read.
    fn read(&self, address: &str) -> Result<Vec<u8>, ResourceError>;
}

/// Why a file could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ResourceError {
    /// Nothing has this name.
    #[error("there is no such file")]
    NotFound,
    /// A folder, device, pipe or socket.
    #[error("this is not a regular file")]
    NotAFile,
    /// Above the ceiling.
    #[error("the file is larger than {} MiB", limit >> 20)]
    TooLarge {
        /// The ceiling in bytes.
        limit: u64,
    },
    /// Everything else that the system reports.
    #[error("{0}")]
    Io(io::Error),
}

/// Files relative to a folder; absolute paths and `..` are allowed, since course scenes keep textures beside them.
#[derive(Clone, Debug)]
pub struct FolderResources {
    folder: PathBuf,
}

/// For documents that refer to nothing: every address is unknown.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoResources;

impl FolderResources {
    /// Addresses are relative to `folder`.
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Self { folder: folder.into() }
    }

    /// Addresses are relative to the folder that holds the file `document`.
    pub fn beside(document: &Path) -> Self {
        Self::new(document.parent().unwrap_or(Path::new("")))
    }

    /// The bytes of the file `path` itself, by the same rules: a regular file below the same ceiling.
    ///
    /// # Errors
    /// When there is no such file, or it is unfit to be read.
    pub fn read_file(path: &Path) -> Result<Vec<u8>, ResourceError> {
        read_file(path, MAX_RESOURCE_BYTES)
    }
}

impl Resources for FolderResources {
    fn read(&self, address: &str) -> Result<Vec<u8>, ResourceError> {
        read_file(&self.folder.join(address), MAX_RESOURCE_BYTES)
    }
}

impl Resources for NoResources {
    fn read(&self, _address: &str) -> Result<Vec<u8>, ResourceError> {
        Err(ResourceError::NotFound)
    }
}

/// Reads a regular file of at most `limit` bytes.
///
/// The kind is asked before opening, because opening a pipe would wait for a writer.
pub(super) fn read_file(path: &Path, limit: u64) -> Result<Vec<u8>, ResourceError> {
    let about = std::fs::metadata(path).map_err(ResourceError::from_io)?;
    if !about.is_file() {
        return Err(ResourceError::NotAFile);
    }
    if about.len() > limit {
        return Err(ResourceError::TooLarge { limit });
    }
    let mut bytes = Vec::new();
    // The ceiling holds while reading too: the file may grow, and /proc files claim no length.
    File::open(path)
        .and_then(|file| file.take(limit + 1).read_to_end(&mut bytes))
        .map_err(ResourceError::from_io)?;
    if bytes.len() as u64 > limit {
        return Err(ResourceError::TooLarge { limit });
    }
    Ok(bytes)
}

impl ResourceError {
    /// Whether nothing is wrong with the file: the system gives too little memory to read it.
    pub fn is_of_memory(&self) -> bool {
        matches!(self, Self::Io(error) if error.kind() == io::ErrorKind::OutOfMemory)
    }

    fn from_io(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound => Self::NotFound,
            io::ErrorKind::IsADirectory => Self::NotAFile,
            _ => Self::Io(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn read_file_only_regular_ones() {
        assert!(
            matches!(read_file(Path::new("/"), 10), Err(ResourceError::NotAFile)),
            "a folder is no file"
        );
        assert!(
            matches!(read_file(Path::new("no/such/file"), 10), Err(ResourceError::NotFound)),
            "nothing there"
        );
    }

    #[test]
    fn read_file_has_a_ceiling() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("big");
        std::fs::write(&path, [0; 11]).expect("a small file");
        assert!(
            matches!(read_file(&path, 10), Err(ResourceError::TooLarge { limit: 10 })),
            "11 bytes are more than 10"
        );
        assert_eq!(read_file(&path, 11).map(|b| b.len()).ok(), Some(11), "11 bytes fit 11");
    }
}
