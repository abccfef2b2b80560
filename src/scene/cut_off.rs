//! JPEG files that end too soon: what is missing decodes as grey without an error.

/// Marks: the start of a file, of its first scan, and the end.
const START: [u8; 2] = [0xff, 0xd8];
const SCAN: u8 = 0xda;
const END: [u8; 2] = [0xff, 0xd9];
/// Marks without a length: restarts, and one for arithmetic coding.
const BARE: [u8; 9] = [0x01, 0xd0, 0xd1, 0xd2, 0xd3, 0xd4, 0xd5, 0xd6, 0xd7];

/// Whether this is a JPEG whose end is missing. Pictures inside its head, which have ends of their own, do not count.
pub(super) fn is_cut_off(file: &[u8]) -> bool {
    let Some(mut rest) = file.strip_prefix(&START) else {
        return false;
    };
    loop {
        match rest {
            // Any number of these may stand before a mark.
            [0xff, 0xff, ..] => rest = &rest[1..],
            [0xff, mark, after @ ..] if BARE.contains(mark) => rest = after,
            [0xff, SCAN, after @ ..] => return !after.windows(END.len()).any(|pair| pair == END),
            [0xff, _, high, low, ..] => {
                let length = usize::from(u16::from_be_bytes([*high, *low]));
                match rest.get(2 + length..) {
                    Some(after) => rest = after,
                    None => return true,
                }
            }
            // No mark where one should be: the decoder may tell.
            [_, ..] if rest.first() != Some(&0xff) => return false,
            _ => return true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_without_their_end_are_cut_off() {
        // A table that holds the mark of an end, and a scan with a restart.
        let whole = [
            0xff, 0xd8, 0xff, 0xe1, 0, 4, 0xff, 0xd9, 0xff, 0xff, 0xda, 0, 2, 1, 0xff, 0xd0, 2, 0xff, 0xd9, 0, 0,
        ];
        for (length, expected) in [
            (21, false),
            (19, false),
            (18, true),
            (12, true),
            (7, true),
            (2, true),
            (0, false),
        ] {
            assert_eq!(is_cut_off(&whole[..length]), expected, "{length} bytes");
        }
        assert!(!is_cut_off(b"\x89PNG"), "another format");
        assert!(!is_cut_off(&[0xff, 0xd8, 7, 7]), "nonsense");
    }
}
