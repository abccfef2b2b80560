//! SHA-256 of the files that a scene was read from: tells whether a picture can be made again.

use std::fmt;
use std::fmt::Write as _;

use sha2::Digest as _;

/// The SHA-256 of a file's bytes (FIPS 180-4). Shown in lower case hexadecimal, as `sha256sum` prints it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FileDigest([u8; 32]);

/// What a scene was read from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SceneFiles {
    /// The document; `None` for a scene that was made in code.
    pub document: Option<FileDigest>,
    /// Every texture file that could be read, by its address in the document, in the order of their first use. Images that
    /// are embedded belong to the document.
    pub textures: Vec<(String, FileDigest)>,
    /// Paths of every file that the document names as a texture or an image, read or not, relative to the document: none of
    /// them may be written over. At most 65 536 and one.
    pub named: Vec<String>,
}

impl FileDigest {
    /// The digest of a file with these bytes.
    pub fn of(bytes: &[u8]) -> Self {
        Self(sha2::Sha256::digest(bytes).into())
    }
}

impl fmt::Display for FileDigest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = String::with_capacity(64);
        for byte in self.0 {
            write!(text, "{byte:02x}")?;
        }
        f.write_str(&text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digest_is_that_of_the_standard() {
        // The examples of FIPS 180-4: "abc" and the empty message.
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(FileDigest::of(b"abc").to_string(), abc, "abc");
        let nothing = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        assert_eq!(FileDigest::of(b"").to_string(), nothing, "no bytes");
    }
}
