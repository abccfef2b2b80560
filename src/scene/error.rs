//! Why a document gave no scene: one line that names file, place, cause and cure.

use std::fmt;

use super::report::quote;
use super::{ResourceError, SourceLocation};
use crate::memory::OutOfMemory;
use crate::plain;

/// A document that cannot be drawn. Displays as one line: `FILE:LINE:COLUMN: what is wrong; what to do`.
#[derive(Debug)]
pub struct SceneError {
    /// The document's name, as given to the reader.
    pub file: String,
    /// Where in the document, if there is such a place.
    pub location: Option<SourceLocation>,
    /// The line there, or a piece of a long one.
    pub line: Option<String>,
    /// What is wrong with it.
    pub problem: Problem,
}

/// What is wrong with a document.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The file itself could not be read.
    #[error("cannot read: {0}; give the path of an SVG file")]
    Unreadable(#[from] ResourceError),
    /// Meant to be built in, with what to give instead.
    #[error("no such scene in the gallery; {0}")]
    NotInGallery(String),
    /// No bytes, or only blanks.
    #[error("the document is empty; save the drawing again")]
    Empty,
    /// Compressed, and damaged.
    #[error("the compressed document is damaged; save the drawing again")]
    Packed,
    /// Whoever waited for it does so no more.
    #[error("reading was given up; F5 reads it again")]
    GivenUp,
    /// Neither UTF-8 nor UTF-16.
    #[error("this is not text in UTF-8 or UTF-16; is it an SVG file? Save it as UTF-8")]
    Encoding,
    /// In another encoding, as it says itself.
    #[error("the document is in {}, and UTF-8, UTF-16, ISO-8859-1 and Windows-1252 are read; save it as UTF-8", quote(.0))]
    OtherEncoding(String),
    /// Another kind of file.
    #[error("this is {0}, not an SVG file; give one, which may show it by <image href=\"...\">")]
    Picture(&'static str),
    /// Not well-formed.
    #[error("{0}; repair the XML here")]
    Xml(String),
    /// Not well-formed, and how to repair it.
    #[error("{0}")]
    Repair(String),
    /// Well-formed, but an entity of this name holds markup.
    #[error("the entity {} holds markup, which is not read from there; write it where &{}; stands", quote(.0), quote(.0))]
    EntityMarkup(String),
    /// Well-formed, but something else.
    #[error("the root element is <{}>; a scene starts with <svg>", quote(.0))]
    NotSvg(String),
    /// The canvas has no area, or is larger than numbers go.
    #[error("the canvas is {width} x {height}; give <svg> a width and height above zero")]
    Canvas {
        /// Its width in canvas units.
        width: f64,
        /// Its height in canvas units.
        height: f64,
    },
    /// A word for what is no number, or none with an end.
    #[error("{attribute}=\"{}\" holds a number that is not finite; use numbers up to 3.4e38", quote(.value))]
    NotFinite {
        /// The attribute's name.
        attribute: String,
        /// All of its value.
        value: String,
    },
    /// A number beyond the range of 32-bit floats.
    #[error("{attribute}=\"{}\" holds a number that is too large; use numbers from -3.4e38 to 3.4e38", quote(.value))]
    TooLarge {
        /// The attribute's name.
        attribute: String,
        /// All of its value.
        value: String,
    },
    /// The library that reads SVG panics; why, in its words.
    #[error(
        "the SVG reader fails here ({}), as where sizes and places are too far apart; make small parts larger, or move all nearer to 0",
        quote(.0)
    )]
    Reader(String),
    /// Transforms carry a coordinate beyond the range of 32-bit floats.
    #[error("transforms move this shape further than 3.4e38; use smaller numbers")]
    TooFar,
    /// A ceiling that protects memory and time.
    #[error("more than {limit} {what}; split the document")]
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// How much is allowed.
        limit: usize,
    },
    /// The same, of what stands as often in a part of the document.
    #[error("more than {limit} {what}; {cure}")]
    TooMuch {
        /// What there is too much of.
        what: &'static str,
        /// How much is allowed.
        limit: usize,
        /// What to do.
        cure: &'static str,
    },
    /// The system has no room for the document or for its images.
    #[error("{0}; close other programs, or give a smaller scene")]
    Memory(#[from] OutOfMemory),
}

impl Problem {
    /// Whether nothing is wrong with the document: the system gives too little memory to read it.
    pub fn is_of_memory(&self) -> bool {
        match self {
            Self::Memory(_) => true,
            Self::Unreadable(error) => error.is_of_memory(),
            _ => false,
        }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let file = plain::line(&self.file);
        match self.location {
            Some(location) => write!(f, "{file}:{location}: {}", self.problem),
            None => write!(f, "{file}: {}", self.problem),
        }
    }
}

impl std::error::Error for SceneError {}

/// A problem on its way to the top, where it learns the document's name.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) location: Option<SourceLocation>,
    pub(super) line: Option<String>,
    pub(super) problem: Problem,
}

impl Problem {
    /// This problem at a place of the document.
    pub(super) fn at(self, location: SourceLocation) -> Fault {
        Fault {
            location: Some(location),
            line: None,
            problem: self,
        }
    }

    /// This problem of the document as a whole.
    pub(super) fn nowhere(self) -> Fault {
        Fault {
            location: None,
            line: None,
            problem: self,
        }
    }
}

impl Fault {
    /// The error that the user sees.
    pub(super) fn in_file(self, file: &str) -> SceneError {
        SceneError {
            file: file.to_owned(),
            location: self.location,
            line: self.line,
            problem: self.problem,
        }
    }
}
