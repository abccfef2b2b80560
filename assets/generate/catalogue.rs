//! Every scene and texture that is made by code, each with its place in the repository.
//!
//! `cargo run --release --example make-assets` writes them all; the suite compares what is committed with what this
//! makes. Same code, same bytes, on every machine: see `steady`.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_possible_wrap,
    clippy::unreadable_literal,
    reason = "texel indices of our own pictures, hash bits, and colours written as #RRGGBB is"
)]

use std::path::Path;

mod canvas;
mod chance;
mod document;
mod lettering;
mod names;
mod palette;
mod scenes;
mod steady;
mod textures;

pub(crate) use canvas::Canvas;
pub(crate) use scenes::scenes;
pub(crate) use textures::textures;

/// A scene and the path it belongs to, from the repository's root.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SceneFile {
    /// Such as `svg/basic/test1.svg`.
    pub(crate) path: &'static str,
    /// Makes the document.
    pub(crate) make: fn() -> String,
}

/// A texture and the path it belongs to, from the repository's root.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TextureFile {
    /// Such as `assets/textures/map.png`; the ending says how it is written.
    pub(crate) path: &'static str,
    /// Paints the texels.
    pub(crate) make: fn() -> Canvas,
}

impl TextureFile {
    /// Whether it is written as JPEG, not PNG.
    pub(crate) fn is_jpeg(&self) -> bool {
        Path::new(self.path).extension().is_some_and(|ending| ending == "jpg")
    }
}
