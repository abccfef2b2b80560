//! Why the bytes of a texture are none, for people: what they are instead, and what to do about it.

use crate::texture::DecodeError;

/// What cures most of it; the commands that read pictures say the same.
const CURE: &str = "give a whole PNG or JPEG";

/// How files of other kinds start, from a byte on, and what they are called.
const KINDS: [(usize, &[u8], &str); 9] = [
    (8, b"WEBP", "a WebP"),
    (0, b"GIF8", "a GIF"),
    (0, b"BM", "a BMP"),
    (0, b"II*\0", "a TIFF"),
    (0, b"MM\0*", "a TIFF"),
    (4, b"ftypavif", "an AVIF"),
    (4, b"ftyphei", "a HEIC"),
    (0, b"%PDF", "a PDF"),
    (0, b"\x1f\x8b", "a compressed file"),
];

/// Bytes at the start of a text in which its first tag is looked for.
const HEAD: usize = 2_000;

/// Why these bytes could not be decoded, and the cure, in one line.
pub(super) fn told(bytes: &[u8], error: &DecodeError) -> String {
    let message = error.to_string();
    let says = |word: &str| message.contains(word);
    match kind(bytes) {
        _ if matches!(error, DecodeError::TooLarge { .. }) => format!("{message}; make it smaller"),
        Kind::Image(_) if says("unexpected end of file") || says("Not enough bytes") => {
            "the file ends before its picture does; copy or save it again".to_owned()
        }
        Kind::Image(name) if says("imit") => {
            format!("to decode this {name} takes too much memory; make it smaller or save it again as a plain PNG")
        }
        Kind::Image(name) if says("not supported") || says("nsupported") => {
            format!("{name}s of this kind are not read; save it again as a plain PNG")
        }
        Kind::Image(name) => format!("the {name} is damaged; {CURE}"),
        Kind::Other(name) => format!("this is {name}, and textures are PNG or JPEG; {CURE}"),
        Kind::Document => {
            format!("this is an SVG document, which only an <image> of the dialect svg shows; {CURE}")
        }
        Kind::Nothing => format!("the file is empty; {CURE}"),
        Kind::Unknown => format!("this is no picture; {CURE}"),
    }
}

/// What bytes are by how they start.
enum Kind {
    /// A PNG or JPEG.
    Image(&'static str),
    /// Something else that is known.
    Other(&'static str),
    /// An SVG document.
    Document,
    Nothing,
    Unknown,
}

fn kind(bytes: &[u8]) -> Kind {
    let starts =
        |(from, magic, _): &&(usize, &[u8], &str)| bytes.get(*from..).is_some_and(|rest| rest.starts_with(magic));
    if bytes.is_empty() {
        return Kind::Nothing;
    }
    if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        return Kind::Image("PNG");
    }
    if bytes.starts_with(b"\xff\xd8\xff") {
        return Kind::Image("JPEG");
    }
    if let Some((_, _, name)) = KINDS.iter().find(starts) {
        return Kind::Other(name);
    }
    let head = &bytes[..bytes.len().min(HEAD)];
    let has = |tag: &[u8]| head.windows(tag.len()).any(|part| part == tag);
    if has(b"<svg") || has(b":svg") {
        return Kind::Document;
    }
    Kind::Unknown
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::Texture;

    fn told_of(bytes: &[u8]) -> String {
        told(bytes, &Texture::decode("a", bytes).expect_err("no texture"))
    }

    #[test]
    fn unreadable_bytes_are_told_by_what_they_are_and_with_a_cure() {
        let others: [(&[u8], &str); 8] = [
            (b"RIFF\x1a\0\0\0WEBPVP8L\x0d\0\0\0", "this is a WebP"),
            (b"GIF89a\x01\0\x01\0\0\0\0;", "this is a GIF"),
            (b"BM\0\0\0\0\0\0\0\0\x36\0\0\0", "this is a BMP"),
            (b"II*\0\x08\0\0\0\0\0", "this is a TIFF"),
            (b"\0\0\0\x20ftypavif\0\0\0\0", "this is an AVIF"),
            (b"\xef\xbb\xbf<?xml version='1.0'?>\n<svg/>", "this is an SVG document"),
            (b"", "the file is empty"),
            (b"hello", "this is no picture"),
        ];
        for (bytes, words) in others {
            let line = told_of(bytes);
            assert!(line.starts_with(words), "{words}: {line}");
            assert!(line.ends_with("; give a whole PNG or JPEG"), "{words}: {line}");
        }
    }

    #[test]
    fn damage_is_told_without_the_words_of_a_decoder() {
        let whole = include_bytes!("../texture/interlaced_9x9.png");
        let pixels = whole.windows(4).position(|part| part == b"IDAT").expect("pixels");
        let cut = &whole[..pixels + 40];
        assert_eq!(
            told_of(cut),
            "the file ends before its picture does; copy or save it again"
        );
        let (mut color, mut data) = (*whole, *whole);
        // The colour type in the header, of which 5 is none.
        color[25] = 5;
        data[pixels + 4..pixels + 10].fill(0xff);
        for bytes in [&color[..], &data] {
            assert_eq!(told_of(bytes), "the PNG is damaged; give a whole PNG or JPEG");
        }
    }
}
