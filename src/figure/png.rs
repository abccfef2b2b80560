//! Frames as PNG files.

use std::io;
use std::path::Path;

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder as _, ImageError};

use crate::raster::Framebuffer;

/// A frame as the bytes of a PNG file: 8-bit RGB, or RGBA with straight alpha where a pixel is not opaque.
///
/// # Errors
/// When the frame has no pixels.
pub fn encode_png(frame: &Framebuffer) -> Result<Vec<u8>, ImageError> {
    let opaque = frame.pixels().iter().all(|pixel| pixel >> 24 == 0xFF);
    let channels = if opaque { 3 } else { 4 };
    let mut data = Vec::with_capacity(frame.pixels().len() * channels);
    for pixel in frame.pixels() {
        let [a, r, g, b] = pixel.to_be_bytes();
        data.extend_from_slice(&[r, g, b, a][..channels]);
    }
    let color = if opaque {
        ExtendedColorType::Rgb8
    } else {
        ExtendedColorType::Rgba8
    };
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes).write_image(&data, frame.width(), frame.height(), color)?;
    Ok(bytes)
}

/// Writes a frame as PNG file, replacing a file that was there: under another name first, so that no half file is ever
/// seen. A link is followed; a device, pipe or folder is left alone.
///
/// # Errors
/// When the frame has no pixels, when the name does not end in `.png`, when the file cannot be written.
pub fn save_png(frame: &Framebuffer, path: &Path) -> io::Result<()> {
    let refused = |why: &str| Err(io::Error::new(io::ErrorKind::InvalidInput, why));
    if !path
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("png"))
    {
        return refused("pictures are written as PNG and their names end in .png");
    }
    // What is not there yet cannot be followed.
    let target = std::fs::canonicalize(path);
    let path = target.as_deref().unwrap_or(path);
    if std::fs::metadata(path).is_ok_and(|there| !there.is_file()) {
        return refused("there is something of that name that is no file");
    }
    let bytes = encode_png(frame).map_err(io::Error::other)?;
    let name = path
        .file_name()
        .ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "this is no file name"))?;
    let mut partial = std::ffi::OsString::from(".");
    partial.push(name);
    partial.push(format!(".{}.part", std::process::id()));
    let partial = path.with_file_name(partial);
    let written = std::fs::write(&partial, bytes).and_then(|()| std::fs::rename(&partial, path));
    if written.is_err() {
        // The first error is the one to tell; there may be nothing to remove.
        let _ = std::fs::remove_file(&partial);
    }
    written
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn png_keeps_colour_and_alpha() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.png");
        let mut frame = Framebuffer::new(2, 1);
        for pixels in [[0xFF01_0203, 0xFFFF_FEFD], [0xFF01_0203, 0x80FF_8000]] {
            frame.pixels_mut().copy_from_slice(&pixels);
            save_png(&frame, &path).expect("a writable folder");
            let back = image::open(&path).expect("a PNG").into_rgba8();
            let found: Vec<u32> = back
                .pixels()
                .map(|p| u32::from_be_bytes([p.0[3], p.0[0], p.0[1], p.0[2]]))
                .collect();
            assert_eq!(found, pixels, "read back");
        }
        assert_eq!(
            std::fs::read_dir(folder.path()).expect("the folder").count(),
            1,
            "no other file is left"
        );
    }

    #[cfg(unix)]
    #[test]
    fn png_replaces_files_only() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let at = |name: &str| folder.path().join(name);
        let frame = Framebuffer::new(2, 1);
        std::fs::write(at("notes.svg"), "<svg/>").expect("a small file");
        assert!(save_png(&frame, &at("notes.svg")).is_err(), "no picture's name");
        assert_eq!(
            std::fs::read(at("notes.svg")).expect("still there"),
            b"<svg/>",
            "untouched"
        );
        std::os::unix::fs::symlink(at("target.png"), at("link.png")).expect("a link");
        std::fs::write(at("target.png"), "old").expect("a small file");
        save_png(&frame, &at("link.png")).expect("writable");
        assert!(at("link.png").is_symlink(), "the link stays");
        assert!(image::open(at("target.png")).is_ok(), "what it leads to is the picture");
        std::os::unix::fs::symlink("/dev/null", at("device.png")).expect("a link");
        assert!(save_png(&frame, &at("device.png")).is_err(), "a device is no file");
    }

    #[test]
    fn png_that_cannot_be_written_leaves_nothing() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let frame = Framebuffer::new(2, 1);
        assert!(
            save_png(&frame, &folder.path().join("no/such/a.png")).is_err(),
            "no such folder"
        );
        std::fs::create_dir(folder.path().join("taken.png")).expect("a folder");
        assert!(
            save_png(&frame, &folder.path().join("taken.png")).is_err(),
            "a folder has that name"
        );
        assert_eq!(
            std::fs::read_dir(folder.path()).expect("the folder").count(),
            1,
            "no partial file is left"
        );
    }
}
