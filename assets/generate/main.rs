//! Rewrites the scenes in `svg` and the textures in `assets/textures`: `cargo run --release --example make-assets`.
//!
//! With arguments it writes only the files whose path contains one of them.

#[path = "catalogue.rs"]
mod catalogue;

use std::{env, error::Error, fs, path::Path};

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder as _, ImageError};

/// High enough that no block of the codec shows at any zoom that keeps texels small.
const JPEG_QUALITY: u8 = 80;

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let wanted: Vec<String> = env::args().skip(1).collect();
    let is_wanted = |path: &str| wanted.is_empty() || wanted.iter().any(|part| path.contains(part.as_str()));
    for scene in catalogue::scenes().iter().filter(|scene| is_wanted(scene.path)) {
        write(&root.join(scene.path), (scene.make)().as_bytes())?;
    }
    for texture in catalogue::textures().iter().filter(|texture| is_wanted(texture.path)) {
        let canvas = (texture.make)();
        write(&root.join(texture.path), &encode(&canvas, texture.is_jpeg())?)?;
    }
    Ok(())
}

/// The bytes of an image file, as small as lossless PNG or JPEG of high quality gets.
fn encode(canvas: &catalogue::Canvas, jpeg: bool) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Vec::new();
    let texels = canvas.bytes();
    if jpeg {
        let encoder = JpegEncoder::new_with_quality(&mut bytes, JPEG_QUALITY);
        encoder.write_image(&texels, canvas.width, canvas.height, ExtendedColorType::Rgb8)?;
    } else {
        let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive);
        match greys(&texels) {
            Some(greys) => encoder.write_image(&greys, canvas.width, canvas.height, ExtendedColorType::L8)?,
            None => encoder.write_image(&texels, canvas.width, canvas.height, ExtendedColorType::Rgb8)?,
        }
    }
    Ok(bytes)
}

/// Writes a file and the folders above it.
fn write(path: &Path, bytes: &[u8]) -> Result<(), Box<dyn Error>> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()).into())
}

/// One byte a texel where every texel of these RGB bytes is a grey.
fn greys(texels: &[u8]) -> Option<Vec<u8>> {
    texels
        .as_chunks::<3>()
        .0
        .iter()
        .map(|&[r, g, b]| (r == g && g == b).then_some(r))
        .collect()
}
