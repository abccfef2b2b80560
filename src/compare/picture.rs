//! Pictures from outside as frames.

use crate::raster::Framebuffer;
use crate::texture::{self, DecodeError, Texture};

/// Width and height in pixels of an encoded PNG or JPEG, from its header alone.
///
/// # Errors
/// When the bytes are neither, or the picture is larger than a frame may be.
pub fn encoded_size(bytes: &[u8]) -> Result<[u32; 2], DecodeError> {
    Texture::size_of_encoded(bytes).map(|(width, height)| [width, height])
}

/// Decodes a PNG or JPEG to a frame. Channels of 16 bits are rounded to 8, grey becomes colour, and the hidden colour
/// of a wholly transparent pixel becomes black: it shows nowhere, and is compared with nothing.
///
/// # Errors
/// When the bytes are neither, are damaged, or the picture is larger than a frame may be.
pub fn decode_picture(bytes: &[u8]) -> Result<Framebuffer, DecodeError> {
    let [width, height] = encoded_size(bytes)?;
    let mut frame = Framebuffer::new(width, height);
    let all = frame.pixels_mut();
    texture::decode_rows(bytes, |run, pixels| {
        let row = &mut all[run.y * width as usize..][..width as usize];
        for (out, pixel) in row.iter_mut().skip(run.x).step_by(run.step).zip(pixels) {
            *out = seen(*pixel);
        }
    })?;
    Ok(frame)
}

/// How many pixels of an encoded PNG or JPEG differ from those of the frame; all do where the sizes differ. The picture is
/// never in memory as a whole. What is wholly transparent has no colour, on either side.
///
/// # Errors
/// As [`decode_picture`].
pub fn count_different(bytes: &[u8], frame: &Framebuffer) -> Result<usize, DecodeError> {
    let [width, height] = encoded_size(bytes)?;
    let (columns, all) = (width as usize, width as usize * height as usize);
    if [width, height] != [frame.width(), frame.height()] {
        return Ok(all);
    }
    let mut different = 0;
    texture::decode_rows(bytes, |run, pixels| {
        let row = &frame.pixels()[run.y * columns..][..columns];
        let pairs = row.iter().skip(run.x).step_by(run.step).zip(pixels);
        let differs =
            |(ours, theirs): &(&u32, &[u8; 4])| **ours != seen(**theirs) && (**ours >> 24 != 0 || theirs[3] != 0);
        different += pairs.filter(differs).count();
    })?;
    Ok(different)
}

/// A decoded pixel as frames have it.
fn seen([r, g, b, a]: [u8; 4]) -> u32 {
    if a == 0 { 0 } else { u32::from_be_bytes([a, r, g, b]) }
}

const _: () = assert!(
    texture::MAX_SIDE <= Framebuffer::MAX_SIDE,
    "whatever decodes fits a frame"
);
