//! Frames as PNG files with their records.

use std::io;
use std::path::Path;

use ::png::{BitDepth, ColorType, Compression, Encoder, Filter, PixelDimensions, Unit};

use super::output::{Destination, Guard, NewFile, save_files};
use super::record::{KEYWORD, Record};
use crate::memory;
use crate::raster::Framebuffer;

/// 300 dots per inch, as sheets are laid out for: a page's width is 16 cm.
const PRINT: PixelDimensions = PixelDimensions {
    xppu: 11_811,
    yppu: 11_811,
    unit: Unit::Meter,
};

/// A frame as the bytes of a PNG file: 8-bit RGB, or RGBA with straight alpha where a pixel is not opaque. `record` stands
/// before the pixels, and figures for print say how large they are on paper.
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
    let mut data = Vec::new();
    let length = frame.pixels().len() * channels;
    data.try_reserve_exact(length)?;
    // The encoder takes memory for its bytes, and for those that they grow from, and does not say where there is none.
    memory::ask_for(2 * length as u64).map_err(|_| io::ErrorKind::OutOfMemory)?;
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
    if record.is_some_and(Record::is_for_print) {
        encoder.set_pixel_dims(Some(PRINT));
    }
    if let Some(record) = record {
        encoder.add_itxt_chunk(KEYWORD.to_owned(), record.to_json()?)?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&data)?;
    writer.finish()?;
    Ok(bytes)
}

/// Writes a frame as PNG file, replacing a picture that was there: under another name first, so that no half file is ever
/// seen. A link is followed; a device, pipe or folder is left alone.
///
/// # Errors
/// When the frame has no pixels, when the name does not end in `.png`, when the file cannot be written.
pub fn save_png(frame: &Framebuffer, path: &Path) -> io::Result<()> {
    save_picture(frame, None, Destination::by_user(path), &Guard::default())
}

/// As [`save_png`], with a record of how the picture was made, and only where `guard` has nothing against it.
///
/// # Errors
/// As [`save_png`], and when the file must not be replaced.
pub fn save_picture(
    frame: &Framebuffer,
    record: Option<&Record>,
    Destination { path, named }: Destination<'_>,
    guard: &Guard,
) -> io::Result<()> {
    if !path
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("png"))
    {
        let why = "pictures are written as PNG and their names end in .png";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, why));
    }
    let (path, bytes) = (path.to_owned(), encode_png(frame, record)?);
    save_files(&[NewFile { path, bytes, named }], guard).map_err(|(_, error)| error)
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

    #[test]
    fn png_of_figures_has_their_size_on_paper() {
        let size_of = |verb: &str| {
            let arguments = vec![verb.to_owned(), "a.svg".to_owned()];
            let record = Record {
                arguments,
                ..Record::default()
            };
            let bytes = encode_png(&Framebuffer::new(2, 1), Some(&record)).expect("it has pixels");
            let reader = ::png::Decoder::new(io::Cursor::new(bytes)).read_info().expect("a PNG");
            reader.info().pixel_dims.map(|size| [size.xppu, size.yppu])
        };
        for verb in ["sheet", "board", "sweep", "spectrum"] {
            assert_eq!(size_of(verb), Some([11_811; 2]), "{verb}");
        }
        assert_eq!(size_of("render"), None, "pixels have none");
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
