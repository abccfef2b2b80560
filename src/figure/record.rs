//! What a picture tells about itself: a record in an iTXt chunk of its PNG file, and how it is found again.
//!
//! The record is JSON, in a chunk with the keyword `rasterscope`:
//!
//! | field | |
//! |---|---|
//! | `version` | of this shape, [`Record::VERSION`]; new fields do not raise it |
//! | `program` | name and version of the program that drew the picture |
//! | `command_line` | makes the picture again, quoted for a POSIX shell |
//! | `arguments` | the same as words, without the program's name |
//! | `differs` | where the picture is not what the command line makes: how; else `null` |
//! | `scene` | what was drawn: `address` as in the command line, `beside` the same relative to the picture's folder, `sha256` |
//! | `textures` | `address` in the document and `sha256` of each file |
//! | `inputs` | as `scene`, of what else was read: both pictures of a difference, the lesson and the scene of a slide; only where there are any |
//! | `view`, `size`, `settings` | as in the command line; of the settings those that differ from their defaults |
//!
//! Files come from anywhere, so that nothing in them is trusted: chunks are stepped over, the record has a ceiling, and
//! what it names is only ever read as a scene. `command_line` is for other programs and for people who look into the file:
//! this program reads `arguments`, and makes the line anew where it shows one.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use serde::{Deserialize, Serialize};

/// The chunk's keyword.
pub(super) const KEYWORD: &str = "rasterscope";
/// Commands whose pictures are laid out for paper.
const PRINTED: [&str; 4] = ["sheet", "board", "sweep", "spectrum"];
/// What every PNG file starts with.
const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";
/// Largest chunk that is read, in bytes.
const MAX_BYTES: u32 = 4 << 20;
/// Most chunks that are stepped over.
const MAX_CHUNKS: u32 = 100_000;

/// What a picture tells about itself.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Record {
    /// Version of the shape.
    pub version: u32,
    /// The program that drew the picture, and its version.
    pub program: String,
    /// The command line that makes the picture again, quoted for a POSIX shell.
    pub command_line: String,
    /// Its words, without the program's name.
    pub arguments: Vec<String>,
    /// How the picture differs from what the command line makes; `None` where it does not.
    pub differs: Option<String>,
    /// The scene.
    pub scene: Option<RecordedFile>,
    /// The texture files of the scene.
    pub textures: Vec<RecordedFile>,
    /// What else was read, in the order of the command line: the pictures of a difference, or a lesson and the scene of its
    /// step.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub inputs: Vec<RecordedFile>,
    /// Which part of the scene is seen.
    pub view: String,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The settings that differ from their defaults, by their names on the command line.
    pub settings: BTreeMap<String, String>,
    /// What shares the picture with what the command line makes, or fills it instead.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compared: Option<RecordedB>,
}

/// The other of two pictures that were compared.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct RecordedB {
    /// What it is, as `view --against` takes it: settings that differ from those of the command line, `truth`, or a picture's path.
    pub against: String,
    /// How both share the picture, as scripts say it: `wipe 0.25`, or `difference signed; gain 4`.
    pub arrangement: String,
    /// The file, where it comes from outside.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub picture: Option<RecordedFile>,
}

/// A file that a picture was made from.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct RecordedFile {
    /// Its address on the command line, or a texture's in the document.
    pub address: String,
    /// Its path from the picture's folder, for both may be moved together.
    pub beside: Option<String>,
    /// SHA-256 of its bytes in hexadecimal; empty where it is not known.
    pub sha256: String,
}

/// Why a PNG file's record cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The file cannot be read.
    #[error("cannot read this file: {0}")]
    Io(#[from] io::Error),
    /// The chunk does not hold what this program writes.
    #[error("the record in this picture is damaged: {0}")]
    Damaged(String),
    /// A later version wrote it.
    #[error(
        "the record in this picture has version {found}, and this program knows {known}; a newer rasterscope draws it again",
        known = Record::VERSION
    )]
    Newer {
        /// Its version.
        found: u32,
    },
}

impl Record {
    /// The version that is written.
    pub const VERSION: u32 = 1;

    /// Whether its picture is a figure that is laid out for paper, not pixels of a scene.
    pub(super) fn is_for_print(&self) -> bool {
        let verb = self.arguments.first().map(String::as_str);
        verb.is_some_and(|verb| PRINTED.contains(&verb))
    }

    /// As it stands in the chunk.
    ///
    /// # Errors
    /// Never for records that this program makes: each field has a form in JSON.
    pub(super) fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self)
    }

    fn from_json(text: &str) -> Result<Self, RecordError> {
        let damaged = |error: serde_json::Error| RecordError::Damaged(error.to_string());
        let version = serde_json::from_str::<Version>(text).map_err(damaged)?.version;
        match version {
            0 => return Err(RecordError::Damaged("there is no version 0".to_owned())),
            Self::VERSION => {}
            found => return Err(RecordError::Newer { found }),
        }
        serde_json::from_str(text).map_err(damaged)
    }

    /// The record of the PNG file `path`. `None` where it has none, and where it is no PNG file.
    ///
    /// # Errors
    /// When the file cannot be read, or its record cannot.
    pub fn of_file(path: &Path) -> Result<Option<Self>, RecordError> {
        // The kind is asked before opening, because opening a pipe would wait for a writer.
        if !std::fs::metadata(path)?.is_file() {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is not a file").into());
        }
        Self::read(&mut BufReader::new(File::open(path)?))
    }

    /// As [`Record::of_file`], from the bytes of a file.
    ///
    /// # Errors
    /// When they cannot be read, or the record cannot.
    pub fn read(file: &mut (impl Read + Seek)) -> Result<Option<Self>, RecordError> {
        if read_array(file)? != Some(SIGNATURE) {
            return Ok(None);
        }
        for _ in 0..MAX_CHUNKS {
            let Some([l0, l1, l2, l3, kind @ ..]) = read_array::<8>(file)? else {
                return Ok(None);
            };
            let length = u32::from_be_bytes([l0, l1, l2, l3]);
            let checksum = 4;
            if kind != *b"iTXt" || length > MAX_BYTES {
                file.seek(SeekFrom::Current(i64::from(length) + checksum))?;
                continue;
            }
            let mut data = Vec::new();
            file.take(u64::from(length)).read_to_end(&mut data)?;
            file.seek(SeekFrom::Current(checksum))?;
            if let Some(text) = record_text(&data)? {
                return Self::from_json(text).map(Some);
            }
        }
        Ok(None)
    }
}

/// Only the version, which is asked before the rest.
#[derive(Deserialize)]
struct Version {
    version: u32,
}

/// The next bytes, or `None` at the end of the file.
fn read_array<const N: usize>(file: &mut impl Read) -> io::Result<Option<[u8; N]>> {
    let mut bytes = [0; N];
    match file.read_exact(&mut bytes) {
        Ok(()) => Ok(Some(bytes)),
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(None),
        Err(error) => Err(error),
    }
}

/// The text of an iTXt chunk, if its keyword is ours (PNG specification, third edition, section 11.3.3.4).
fn record_text(data: &[u8]) -> Result<Option<&str>, RecordError> {
    let damaged = |what: &str| RecordError::Damaged(what.to_owned());
    let Some(rest) = data
        .strip_prefix(KEYWORD.as_bytes())
        .and_then(|rest| rest.strip_prefix(b"\0"))
    else {
        return Ok(None);
    };
    let [compressed, _method, rest @ ..] = rest else {
        return Err(damaged("it ends too early"));
    };
    if *compressed != 0 {
        return Err(damaged("another program has compressed it"));
    }
    // Language and translated keyword, each with its end.
    let text = rest.splitn(3, |byte| *byte == 0).nth(2);
    let text = text.ok_or_else(|| damaged("it ends too early"))?;
    std::str::from_utf8(text)
        .map(Some)
        .map_err(|_| damaged("it is no UTF-8 text"))
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::super::encode_png;
    use super::*;
    use crate::raster::Framebuffer;

    fn record() -> Record {
        Record {
            version: Record::VERSION,
            program: "rasterscope 1.2.3".to_owned(),
            command_line: "rasterscope render 'ä b.svg' -o a.png".to_owned(),
            arguments: ["render", "ä b.svg", "-o", "a.png"].map(str::to_owned).to_vec(),
            differs: Some("with \"quotes\" and\nlines".to_owned()),
            scene: Some(RecordedFile {
                address: "ä b.svg".to_owned(),
                beside: Some("../ä b.svg".to_owned()),
                sha256: "00ff".to_owned(),
            }),
            size: [2, 1],
            ..Record::default()
        }
    }

    fn png() -> Vec<u8> {
        let mut frame = Framebuffer::new(2, 1);
        frame.pixels_mut().fill(0xff10_2030);
        encode_png(&frame, Some(&record())).expect("it has pixels")
    }

    fn read(bytes: &[u8]) -> Result<Option<Record>, RecordError> {
        Record::read(&mut Cursor::new(bytes))
    }

    #[test]
    fn record_comes_back_from_the_file() {
        let bytes = png();
        assert_eq!(read(&bytes).expect("whole"), Some(record()), "every field");
        let plain = encode_png(&Framebuffer::new(2, 1), None).expect("it has pixels");
        assert_eq!(read(&plain).expect("whole"), None, "a picture without one");
        assert_eq!(read(b"<svg/>").expect("readable"), None, "no picture at all");
        let picture = image::load_from_memory(&bytes)
            .expect("other programs read it")
            .into_rgba8();
        assert_eq!(picture.get_pixel(1, 0).0, [16, 32, 48, 255], "with its pixels");
    }

    #[test]
    fn record_of_a_later_version_is_told() {
        let none = Record::from_json(r#"{"version": 0}"#).expect_err("there never was one");
        assert!(matches!(none, RecordError::Damaged(_)), "{none}");
        let text = r#"{"version": 2, "arguments": {"now": "an object"}}"#;
        let error = Record::from_json(text).expect_err("not known");
        assert!(matches!(error, RecordError::Newer { found: 2 }), "{error}");
        let unknown = Record::from_json(r#"{"version": 1, "mood": "good"}"#).expect("known");
        assert_eq!(unknown.arguments.len(), 0, "fields that are new or missing do no harm");
    }

    #[test]
    fn record_survives_damage_of_any_kind() {
        let whole = png();
        for end in 0..whole.len() {
            let _ = read(&whole[..end]);
        }
        arbtest::arbtest(|u| {
            let mut bytes = whole.clone();
            for _ in 0..u.int_in_range(1..=8)? {
                let at = u.choose_index(bytes.len())?;
                bytes[at] = u.arbitrary()?;
            }
            let _ = read(&bytes);
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn record_chunks_that_claim_gigabytes_cost_nothing() {
        let mut bytes = SIGNATURE.to_vec();
        for _ in 0..3 {
            bytes.extend(u32::MAX.to_be_bytes());
            bytes.extend(b"iTXt");
        }
        assert_eq!(read(&bytes).expect("stepped over"), None, "longer than a record may be");
        let mut bytes = SIGNATURE.to_vec();
        bytes.extend(MAX_BYTES.to_be_bytes());
        bytes.extend(b"iTXtrasterscope\0\0\0\0\0{");
        let error = read(&bytes).expect_err("cut off");
        assert!(matches!(error, RecordError::Damaged(_)), "{error}");
    }
}
