//! PNG and JPEG bytes to texels, within limits that a hostile file cannot break.
//!
//! A PNG is read row by row, without its profile and its texts: beside what it becomes it takes a few rows, whatever it
//! says. [`Memory`] tells before anything is decoded what an image will take.

use std::io::Cursor;

use image::{DynamicImage, ImageReader, Limits};
use png::{BitDepth, ColorType, Transformations};

use super::MipLevel;
use super::pyramid::MAX_SIDE;

/// Memory that the decoders may use besides pixels, in bytes.
const MAX_BYTES: usize = 32 << 20;
/// The most that the decoder of a JPEG may use, in bytes.
const MAX_JPEG_BYTES: u64 = 1 << 30;
/// How a PNG starts.
const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";
/// Adam7: the first column and row of each pass, and the steps from there.
const PASSES: [[usize; 4]; 7] = [
    [0, 0, 8, 8],
    [4, 0, 8, 8],
    [0, 4, 4, 8],
    [2, 0, 4, 4],
    [0, 2, 2, 4],
    [1, 0, 2, 2],
    [0, 1, 1, 2],
];

/// Why an image could not be used as a texture.
#[derive(Debug, thiserror::Error)]
pub enum DecodeError {
    /// Neither PNG nor JPEG, or a damaged JPEG.
    #[error("{0}")]
    Image(#[from] image::ImageError),
    /// A damaged PNG.
    #[error("{0}")]
    Png(#[from] png::DecodingError),
    /// The bytes could not be probed for a format.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// Above the limits.
    #[error("{width} x {height} pixels are more than {MAX_SIDE} a side")]
    TooLarge {
        /// Its width in pixels.
        width: u32,
        /// Its height.
        height: u32,
    },
}

/// What an image takes as a texture, in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Memory {
    /// With its pyramid, as long as the texture lives.
    pub held: u64,
    /// More than that while it is decoded and the pyramid is built.
    pub passing: u64,
}

/// Where decoded pixels belong: some of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// The row.
    pub y: usize,
    /// The column of the first pixel.
    pub x: usize,
    /// Columns from one pixel to the next.
    pub step: usize,
}

impl Memory {
    /// Of an encoded image of this size.
    pub(super) fn of(bytes: &[u8], [width, height]: [u32; 2]) -> Self {
        /// The coarser levels before they are rounded, 16 bytes a texel of a quarter and a sixteenth.
        const PYRAMID: u64 = 5;
        let texels = u64::from(width) * u64::from(height);
        let decoder = if bytes.starts_with(PNG) {
            0
        } else {
            // The bytes again, the picture, and the coefficients of a progressive one.
            let coefficients = if is_progressive(bytes) { 8 } else { 0 };
            bytes.len() as u64 + texels * (4 + coefficients)
        };
        Self {
            held: texels * 16 / 3,
            passing: decoder.max(texels * PYRAMID),
        }
    }
}

/// Decodes to 8-bit premultiplied RGBA.
pub(super) fn decode(bytes: &[u8]) -> Result<MipLevel, DecodeError> {
    decode_level(bytes, premultiply)
}

/// Decodes to 8-bit RGBA of which every texel is opaque; and whether any was not.
pub(super) fn decode_opaque(bytes: &[u8]) -> Result<(MipLevel, bool), DecodeError> {
    let mut dropped = false;
    let level = decode_level(bytes, |[r, g, b, a]| {
        dropped |= a != u8::MAX;
        [r, g, b, u8::MAX]
    })?;
    Ok((level, dropped))
}

fn decode_level(bytes: &[u8], mut texel: impl FnMut([u8; 4]) -> [u8; 4]) -> Result<MipLevel, DecodeError> {
    let (width, height) = size(bytes)?;
    let mut level = MipLevel::blank(width, height);
    decode_rows(bytes, |run, pixels| {
        let row = &mut level.row_mut(run.y)[run.x..];
        if run.step == 1 {
            for (out, pixel) in row.iter_mut().zip(pixels) {
                *out = texel(*pixel);
            }
        } else {
            for (out, pixel) in row.iter_mut().step_by(run.step).zip(pixels) {
                *out = texel(*pixel);
            }
        }
    })?;
    Ok(level)
}

/// Decodes a PNG or JPEG, within the limits of textures, to straight 8-bit RGBA: hands over every pixel once.
///
/// # Errors
/// When the bytes are no such image, are damaged, or are larger than 16 384 texels a side.
pub fn decode_rows(bytes: &[u8], put: impl FnMut(Run, &[[u8; 4]])) -> Result<(), DecodeError> {
    if bytes.starts_with(PNG) {
        png_rows(bytes, put)
    } else {
        jpeg_rows(bytes, put)
    }
}

/// Width and height, from the header.
pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    let (width, height) = if bytes.starts_with(PNG) {
        png_decoder(bytes).read_header_info()?.size()
    } else {
        reader(bytes)?.into_dimensions()?
    };
    if width.max(height) > MAX_SIDE {
        return Err(DecodeError::TooLarge { width, height });
    }
    Ok((width, height))
}

fn png_decoder(bytes: &[u8]) -> png::Decoder<Cursor<&[u8]>> {
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), png::Limits { bytes: MAX_BYTES });
    decoder.set_ignore_iccp_chunk(true);
    decoder.set_ignore_text_chunk(true);
    decoder.set_transformations(Transformations::EXPAND);
    decoder
}

fn png_rows(bytes: &[u8], mut put: impl FnMut(Run, &[[u8; 4]])) -> Result<(), DecodeError> {
    size(bytes)?;
    let mut reader = png_decoder(bytes).read_info()?;
    let (width, height) = reader.info().size();
    let (width, height) = (width as usize, height as usize);
    let (color, depth) = reader.output_color_type();
    let passes = if reader.info().interlaced {
        &PASSES[..]
    } else {
        &[[0, 0, 1, 1]]
    };
    let runs = passes
        .iter()
        .filter(|[x, ..]| *x < width)
        .flat_map(|[x, y, step, lines]| (*y..height).step_by(*lines).map(|y| Run { y, x: *x, step: *step }));
    let mut pixels = Vec::with_capacity(width);
    for run in runs {
        let Some(row) = reader.next_interlaced_row()? else {
            break;
        };
        pixels.clear();
        straight(row.data(), color, depth, &mut pixels);
        put(run, &pixels);
    }
    Ok(())
}

/// A row of a PNG as straight bytes; channels of 16 bits are rounded.
fn straight(row: &[u8], color: ColorType, depth: BitDepth, pixels: &mut Vec<[u8; 4]>) {
    /// Gathers the channels of each pixel.
    fn gather<const N: usize>(row: &[u8], wide: bool, pixel: impl Fn([u8; N]) -> [u8; 4], pixels: &mut Vec<[u8; 4]>) {
        if wide {
            let (channels, _) = row.as_chunks::<2>();
            let (parts, _) = channels.as_chunks::<N>();
            pixels.extend(parts.iter().map(|part| pixel(part.map(rounded))));
        } else {
            let (parts, _) = row.as_chunks::<N>();
            pixels.extend(parts.iter().map(|part| pixel(*part)));
        }
    }
    let wide = depth == BitDepth::Sixteen;
    match color {
        ColorType::Grayscale => gather(row, wide, |[l]| [l, l, l, u8::MAX], pixels),
        ColorType::GrayscaleAlpha => gather(row, wide, |[l, a]| [l, l, l, a], pixels),
        ColorType::Rgb => gather(row, wide, |[r, g, b]| [r, g, b, u8::MAX], pixels),
        // A palette is expanded to one of the others.
        ColorType::Rgba | ColorType::Indexed => gather(row, wide, |rgba| rgba, pixels),
    }
}

/// 16 bits to 8.
fn rounded(channel: [u8; 2]) -> u8 {
    let nearest = (u32::from(u16::from_be_bytes(channel)) + 128) / 257;
    u8::try_from(nearest).unwrap_or(u8::MAX)
}

fn jpeg_rows(bytes: &[u8], mut put: impl FnMut(Run, &[[u8; 4]])) -> Result<(), DecodeError> {
    let image = reader(bytes)?.decode()?;
    let width = image.width() as usize;
    let mut pixels = Vec::with_capacity(width);
    let mut rows = |y: usize, row: &mut dyn Iterator<Item = [u8; 4]>| {
        pixels.clear();
        pixels.extend(row);
        put(Run { y, x: 0, step: 1 }, &pixels);
    };
    match &image {
        DynamicImage::ImageRgb8(image) => {
            for (y, row) in image.rows().enumerate() {
                rows(y, &mut row.map(|pixel| [pixel.0[0], pixel.0[1], pixel.0[2], u8::MAX]));
            }
        }
        DynamicImage::ImageLuma8(image) => {
            for (y, row) in image.rows().enumerate() {
                rows(y, &mut row.map(|pixel| [pixel.0[0], pixel.0[0], pixel.0[0], u8::MAX]));
            }
        }
        other => {
            for (y, row) in other.to_rgba8().rows().enumerate() {
                rows(y, &mut row.map(|pixel| pixel.0));
            }
        }
    }
    Ok(())
}

/// For everything but PNG.
fn reader(bytes: &[u8]) -> Result<ImageReader<Cursor<&[u8]>>, DecodeError> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format()?;
    let mut limits = Limits::no_limits();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_JPEG_BYTES);
    reader.limits(limits);
    Ok(reader)
}

/// Whether a JPEG comes in several scans, whose coefficients are all kept until the last.
fn is_progressive(bytes: &[u8]) -> bool {
    let mut rest = bytes.get(2..).unwrap_or(&[]);
    while let [0xff, marker, after @ ..] = rest {
        match (marker, after) {
            (0xff, _) => rest = &rest[1..],
            (0xc2 | 0xc6 | 0xca | 0xce, _) => return true,
            // The other frames, and the pixels.
            (0xc0 | 0xc1 | 0xc3 | 0xc5 | 0xc7 | 0xc9 | 0xcb | 0xcd | 0xcf | 0xda, _) => return false,
            (_, [high, low, ..]) => {
                let length = usize::from(u16::from_be_bytes([*high, *low]));
                rest = after.get(length.max(2)..).unwrap_or(&[]);
            }
            _ => return false,
        }
    }
    // Not understood: the dearer kind.
    true
}

/// Straight bytes to premultiplied ones, rounded to nearest.
fn premultiply([r, g, b, a]: [u8; 4]) -> [u8; 4] {
    let scale = |channel: u8| {
        let product = u16::from(channel) * u16::from(a) + 127;
        u8::try_from(product / 255).unwrap_or(u8::MAX)
    };
    [scale(r), scale(g), scale(b), a]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A PNG of this kind with every value somewhere.
    fn encoded(color: ColorType, depth: BitDepth, [width, height]: [u32; 2]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if color == ColorType::Indexed {
            encoder.set_palette((0..=255).flat_map(|i| [i, 255 - i, i / 2]).collect::<Vec<u8>>());
            encoder.set_trns((0..=255).rev().collect::<Vec<u8>>());
        }
        let bits = color.samples() * depth as usize;
        let length = (width as usize * bits).div_ceil(8) * height as usize;
        let mut state = 1_u32;
        let data: Vec<u8> = std::iter::repeat_with(|| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state.to_be_bytes()[0]
        })
        .take(length)
        .collect();
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(&data).expect("rows");
        writer.finish().expect("an end");
        bytes
    }

    fn pixels(bytes: &[u8]) -> Vec<u8> {
        let (width, height) = size(bytes).expect("a size");
        let mut all = vec![[7; 4]; width as usize * height as usize];
        decode_rows(bytes, |run, pixels| {
            for (i, pixel) in pixels.iter().enumerate() {
                all[run.y * width as usize + run.x + i * run.step] = *pixel;
            }
        })
        .expect("an image");
        all.concat()
    }

    #[test]
    fn rows_are_the_image_whatever_its_kind() {
        use BitDepth::{Eight, Four, One, Sixteen, Two};
        use ColorType::{Grayscale, GrayscaleAlpha, Indexed, Rgb, Rgba};
        for (color, depths) in [
            (Grayscale, &[One, Two, Four, Eight, Sixteen][..]),
            (GrayscaleAlpha, &[Eight, Sixteen]),
            (Rgb, &[Eight, Sixteen]),
            (Rgba, &[Eight, Sixteen]),
            (Indexed, &[Eight]),
        ] {
            for depth in depths {
                let bytes = encoded(color, *depth, [37, 29]);
                let expected = image::load_from_memory(&bytes).expect("a PNG").into_rgba8();
                assert!(pixels(&bytes) == expected.into_raw(), "{color:?} {depth:?}");
            }
        }
    }

    #[test]
    fn interlaced_rows_are_put_in_their_places() {
        // Made by ImageMagick: 3 x 2 and 9 x 9 pixels of noise, interlaced.
        for bytes in INTERLACED {
            let expected = image::load_from_memory(bytes).expect("a PNG").into_rgba8();
            assert!(pixels(bytes) == expected.into_raw(), "as the other decoder has it");
        }
    }

    #[test]
    fn profiles_and_texts_are_not_unpacked() {
        let mut bytes = Vec::new();
        let mut info = png::Info::with_size(1, 1);
        info.color_type = ColorType::Rgba;
        info.bit_depth = BitDepth::Eight;
        info.icc_profile = Some(vec![0; 4 << 20].into());
        let text = png::text_metadata::ZTXtChunk::new("Comment", "x".repeat(4 << 20));
        info.compressed_latin1_text.push(text);
        let encoder = png::Encoder::with_info(&mut bytes, info).expect("a header");
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(&[1, 2, 3, 4]).expect("a row");
        writer.finish().expect("an end");
        assert!(bytes.len() < 100_000, "packed: {}", bytes.len());
        let reader = png_decoder(&bytes).read_info().expect("a PNG");
        assert!(reader.info().icc_profile.is_none(), "the profile");
        assert!(reader.info().compressed_latin1_text.is_empty(), "the text");
        assert_eq!(pixels(&bytes), [1, 2, 3, 4], "the pixel");
    }

    #[test]
    fn memory_is_told_before() {
        let memory = Memory::of(&encoded(ColorType::Rgb, BitDepth::Eight, [64, 32]), [64, 32]);
        let level = MipLevel::blank(64, 32);
        let pyramid = super::super::MipPyramid::build(level);
        let texels: u64 = pyramid
            .levels()
            .iter()
            .map(|level| u64::from(level.width()) * u64::from(level.height()))
            .sum();
        assert!(memory.held >= texels * 4 - 4, "{memory:?}, {texels} texels");
        let baseline = b"\xff\xd8\xff\xe0\0\x04ab\xff\xc0\0\x11";
        let progressive = b"\xff\xd8\xff\xe0\0\x04ab\xff\xc2\0\x11";
        let [baseline, progressive] = [&baseline[..], progressive].map(|bytes| Memory::of(bytes, [1000, 1000]));
        assert_eq!(baseline.held, progressive.held, "the same texture");
        assert!(
            progressive.passing > 2 * baseline.passing,
            "several scans: {progressive:?}"
        );
    }

    const INTERLACED: [&[u8]; 2] = [
        include_bytes!("interlaced_3x2.png"),
        include_bytes!("interlaced_9x9.png"),
    ];
}
