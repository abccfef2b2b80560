//! Frames as PNG files with their records; files that are written whole or not at all.

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};

use ::png::{BitDepth, ColorType, Compression, Encoder, Filter};

use super::Record;
use super::record::KEYWORD;
use crate::raster::Framebuffer;

/// A frame as the bytes of a PNG file: 8-bit RGB, or RGBA with straight alpha where a pixel is not opaque. `record` stands
/// before the pixels.
///
/// # Errors
/// When the frame has no pixels.
pub fn encode_png(frame: &Framebuffer, record: Option<&Record>) -> io::Result<Vec<u8>> {
    let opaque = frame.pixels().iter().all(|pixel| pixel >> 24 == 0xFF);
    let (channels, color) = if opaque {
        (3, ColorType::Rgb)
    } else {
        (4, ColorType::Rgba)
    };
    let mut data = Vec::with_capacity(frame.pixels().len() * channels);
    for pixel in frame.pixels() {
        let [a, r, g, b] = pixel.to_be_bytes();
        data.extend_from_slice(&[r, g, b, a][..channels]);
    }
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, frame.width(), frame.height());
    encoder.set_color(color);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Adaptive);
    if let Some(record) = record {
        encoder.add_itxt_chunk(KEYWORD.to_owned(), record.to_json()?)?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&data)?;
    writer.finish()?;
    Ok(bytes)
}

/// Writes a frame as PNG file, replacing a file that was there: under another name first, so that no half file is ever
/// seen. A link is followed; a device, pipe or folder is left alone.
///
/// # Errors
/// When the frame has no pixels, when the name does not end in `.png`, when the file cannot be written.
pub fn save_png(frame: &Framebuffer, path: &Path) -> io::Result<()> {
    save(frame, path, None)
}

/// As [`save_png`], with a record of how the picture was made.
///
/// # Errors
/// As [`save_png`].
pub fn save_recorded_png(frame: &Framebuffer, path: &Path, record: &Record) -> io::Result<()> {
    save(frame, path, Some(record))
}

fn save(frame: &Framebuffer, path: &Path, record: Option<&Record>) -> io::Result<()> {
    if !path
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("png"))
    {
        let why = "pictures are written as PNG and their names end in .png";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, why));
    }
    let bytes = encode_png(frame, record)?;
    save_files(&[(path.to_owned(), bytes)])
}

/// Writes files, replacing those that were there: all under other names first, so that neither a half file is ever seen nor
/// half of the files. A link is followed; a device, pipe or folder is left alone.
///
/// # Errors
/// When one cannot be written.
pub fn save_files(files: &[(PathBuf, Vec<u8>)]) -> io::Result<()> {
    let mut staged: Vec<(PathBuf, PathBuf)> = Vec::new();
    let written = files.iter().try_for_each(|(path, bytes)| {
        let (partial, target) = partial_name(path)?;
        staged.push((partial.clone(), target));
        std::fs::write(&partial, bytes)
    });
    let moved = written.and_then(|()| staged.iter().try_for_each(|(from, to)| std::fs::rename(from, to)));
    if moved.is_err() {
        for (partial, _) in &staged {
            // The first error is the one to tell; there may be nothing to remove.
            let _ = std::fs::remove_file(partial);
        }
    }
    moved
}

/// The name to write under first, and the one in the end.
fn partial_name(path: &Path) -> io::Result<(PathBuf, PathBuf)> {
    let refused = |why: &str| Err(io::Error::new(io::ErrorKind::InvalidInput, why));
    // What is not there yet cannot be followed.
    let target = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if std::fs::metadata(&target).is_ok_and(|there| !there.is_file()) {
        return refused("there is something of that name that is no file");
    }
    let Some(name) = target.file_name() else {
        return refused("this is no file name");
    };
    let mut partial = OsString::from(".");
    partial.push(name);
    partial.push(format!(".{}.part", std::process::id()));
    Ok((target.with_file_name(partial), target))
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
