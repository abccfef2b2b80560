//! PNG and JPEG bytes to premultiplied texels, within limits that a hostile file cannot break.

use std::io::Cursor;

use image::{ImageReader, Limits};

use super::MipLevel;
use super::pyramid::MAX_SIDE;

/// Memory that decoding may use, in bytes.
const MAX_BYTES: u64 = 1 << 30;

/// Why an image could not be used as a texture.
#[derive(Debug, thiserror::Error)]
pub enum DecodeError {
    /// Neither PNG nor JPEG, or damaged, or larger than the limits.
    #[error("{0}")]
    Image(#[from] image::ImageError),
    /// The bytes could not be probed for a format.
    #[error("{0}")]
    Io(#[from] std::io::Error),
}

/// Decodes to 8-bit premultiplied RGBA.
pub(super) fn decode(bytes: &[u8]) -> Result<MipLevel, DecodeError> {
    decode_with(bytes, premultiply)
}

/// Decodes to 8-bit RGBA of which every texel is opaque.
pub(super) fn decode_opaque(bytes: &[u8]) -> Result<MipLevel, DecodeError> {
    decode_with(bytes, |[r, g, b, _]| [r, g, b, 255])
}

/// Decodes a PNG or JPEG, within the limits of textures, to straight 8-bit RGBA, row by row.
///
/// # Errors
/// When the bytes are no such image, are damaged, or are larger than 16 384 texels a side.
pub fn decode_straight(bytes: &[u8]) -> Result<Vec<u8>, DecodeError> {
    Ok(reader(bytes)?.decode()?.into_rgba8().into_raw())
}

/// Width and height, from the header.
pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    Ok(reader(bytes)?.into_dimensions()?)
}

fn decode_with(bytes: &[u8], texel: impl Fn([u8; 4]) -> [u8; 4] + Sync) -> Result<MipLevel, DecodeError> {
    let image = reader(bytes)?.decode()?.into_rgba8();
    let (width, height) = image.dimensions();
    let (pixels, _) = image.as_raw().as_chunks::<4>();
    Ok(MipLevel::from_rows(width, height, |y, row| {
        let pixels = &pixels[y * width as usize..];
        for (out, pixel) in row.iter_mut().zip(pixels) {
            *out = texel(*pixel);
        }
    }))
}

fn reader(bytes: &[u8]) -> Result<ImageReader<Cursor<&[u8]>>, DecodeError> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format()?;
    let mut limits = Limits::no_limits();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_BYTES);
    reader.limits(limits);
    Ok(reader)
}

/// Straight bytes to premultiplied ones, rounded to nearest.
fn premultiply([r, g, b, a]: [u8; 4]) -> [u8; 4] {
    let scale = |channel: u8| {
        let product = u16::from(channel) * u16::from(a) + 127;
        u8::try_from(product / 255).unwrap_or(u8::MAX)
    };
    [scale(r), scale(g), scale(b), a]
}
