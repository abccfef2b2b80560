//! JPEG files of cameras that were held on their side: Exif says so, and the picture is shown as it is stored.

/// The start of a file, and the mark of a segment that may hold Exif.
const START: [u8; 2] = [0xff, 0xd8];
const APP1: u8 = 0xe1;
/// What such a segment begins with, and the number of the field that says how the picture lies (Exif 2.3, section 4.6.4).
const EXIF: &[u8] = b"Exif\0\0";
const ORIENTATION: u16 = 0x112;

/// Whether this is a JPEG that shall be shown turned or mirrored.
pub(super) fn is_turned(file: &[u8]) -> bool {
    let Some(mut rest) = file.strip_prefix(&START) else {
        return false;
    };
    while let [0xff, mark, high, low, ..] = rest {
        let length = usize::from(u16::from_be_bytes([*high, *low]));
        let Some(segment) = rest.get(4..2 + length) else {
            return false;
        };
        if let Some(exif) = segment.strip_prefix(EXIF).filter(|_| *mark == APP1) {
            return orientation(exif).is_some_and(|orientation| (2..=8).contains(&orientation));
        }
        rest = &rest[2 + length..];
    }
    false
}

/// How the picture lies by the first directory of its Exif.
fn orientation(exif: &[u8]) -> Option<u16> {
    let is_little = exif.starts_with(b"II");
    let short = |at: usize| {
        let bytes = *exif.get(at..)?.first_chunk::<2>()?;
        Some(if is_little {
            u16::from_le_bytes(bytes)
        } else {
            u16::from_be_bytes(bytes)
        })
    };
    let bytes = *exif.get(4..)?.first_chunk::<4>()?;
    let directory = if is_little {
        u32::from_le_bytes(bytes)
    } else {
        u32::from_be_bytes(bytes)
    };
    let directory = usize::try_from(directory).ok()?;
    let count = short(directory)?;
    let mut fields = (0..usize::from(count)).map(|field| directory + 2 + 12 * field);
    let field = fields.find(|field| short(*field) == Some(ORIENTATION))?;
    short(field + 8)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A JPEG's head with such a field, the last of two.
    fn file(orientation: u16, is_little: bool) -> Vec<u8> {
        let short = |number: u16| {
            if is_little {
                number.to_le_bytes()
            } else {
                number.to_be_bytes()
            }
        };
        let mut exif = EXIF.to_vec();
        exif.extend(if is_little { b"II" } else { b"MM" });
        exif.extend(short(42));
        let at: [u16; 2] = if is_little { [8, 0] } else { [0, 8] };
        exif.extend(at.map(short).concat());
        exif.extend(
            [2, 0x10f, 2, 0, 0, 0, 0, ORIENTATION, 3, 0, 1, orientation, 0]
                .map(short)
                .concat(),
        );
        let length = u16::try_from(exif.len() + 2).unwrap_or(u16::MAX);
        let head = [&START[..], &[0xff, 0xe0, 0, 4, 1, 2, 0xff, APP1], &length.to_be_bytes()].concat();
        [head, exif, vec![0xff, 0xda, 0, 2]].concat()
    }

    #[test]
    fn only_pictures_that_lie_otherwise_are_turned() {
        for is_little in [false, true] {
            for (orientation, expected) in [(0, false), (1, false), (2, true), (6, true), (8, true), (9, false)] {
                assert_eq!(is_turned(&file(orientation, is_little)), expected, "{orientation}");
            }
            let whole = file(6, is_little);
            for length in 0..whole.len() - 8 {
                assert!(!is_turned(&whole[..length]), "cut off after {length} bytes");
            }
        }
        assert!(!is_turned(b"\x89PNG"), "another format");
        assert!(!is_turned(&[0xff, 0xd8, 0xff, 0xe1, 0, 0, 0xff]), "a length of nothing");
    }
}
