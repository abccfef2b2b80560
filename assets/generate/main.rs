//! Rewrites the scenes in `svg` and the textures in `assets/textures`: `cargo run --release --example make-assets`.
//!
//! With arguments it writes only the files whose path contains one of them.

#[path = "catalogue.rs"]
mod catalogue;

use std::{env, error::Error, fs, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let wanted: Vec<String> = env::args().skip(1).collect();
    let is_wanted = |path: &str| wanted.is_empty() || wanted.iter().any(|part| path.contains(part.as_str()));
    for scene in catalogue::scenes().iter().filter(|scene| is_wanted(scene.path)) {
        write(&root.join(scene.path), (scene.make)().as_bytes())?;
    }
    Ok(())
}

/// Writes a file and the folders above it.
fn write(path: &Path, bytes: &[u8]) -> Result<(), Box<dyn Error>> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()).into())
}
