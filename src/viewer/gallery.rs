//! The scenes and textures that are built into the program.

use crate::scene::{ResourceError, Resources};

/// A scene of the built-in gallery.
#[derive(Clone, Copy, Debug)]
pub struct GalleryScene {
    /// Its name, such as `basic/test4.svg`.
    pub name: &'static str,
    /// The document.
    pub document: &'static str,
}

/// Every scene of the gallery, in the order of the list.
pub static SCENES: &[GalleryScene] = &[GalleryScene {
    name: "first.svg",
    document: include_str!("first.svg"),
}];

/// The gallery's textures, by the addresses that its scenes use.
#[derive(Clone, Copy, Debug)]
pub struct Textures;

impl Resources for Textures {
    fn read(&self, _address: &str) -> Result<Vec<u8>, ResourceError> {
        Err(ResourceError::NotFound)
    }
}
