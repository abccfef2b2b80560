//! Where pixels of two frames can be compared: both final, or both of the same preview. Elsewhere a difference would be that of
//! a preview from a final picture.

use std::ops::Range;

use crate::viewer::frames::frame::{Preview, PreviewQuality};

/// The colours of the hatch in place of a difference that is still to come.
const HATCH: [u32; 2] = [0xff4a_4a4a, 0xff5c_5c5c];

/// How far two frames are from final.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::viewer) struct Refining<'a>(pub(in crate::viewer) [Option<&'a Preview>; 2]);

impl Refining<'_> {
    /// How each was made, if it is not final.
    pub(in crate::viewer) fn qualities(self) -> [Option<PreviewQuality>; 2] {
        self.0.map(|preview| preview.map(|preview| preview.quality))
    }

    /// Whether any pixel may be at another stage in one frame than in the other, or in no final one.
    pub(in crate::viewer) fn is_any(self) -> bool {
        self.0.iter().any(Option::is_some)
    }

    /// Hatches what cannot be compared of some pixels of a row.
    pub(in crate::viewer) fn hatch(self, y: usize, columns: Range<usize>, out: &mut [u32]) {
        if !self.is_any() {
            return;
        }
        for (x, pixel) in columns.zip(out) {
            if !self.can_compare([x, y]) {
                *pixel = HATCH[(x + y) / 4 % 2];
            }
        }
    }

    fn can_compare(self, at: [usize; 2]) -> bool {
        let at = at.map(|coordinate| u32::try_from(coordinate).unwrap_or(u32::MAX));
        let stage = |preview: Option<&Preview>| {
            let preview = preview.filter(|preview| !preview.exact.contains(at));
            let quality = preview.map(|preview| preview.quality);
            // What was moved by whole pixels most often has all of its samples, and a hand drags it: no hatch for that while.
            quality.filter(|quality| *quality != PreviewQuality::Moved)
        };
        match self.0.map(stage) {
            [None, None] => true,
            [Some(a), Some(b)] => a == b && a != PreviewQuality::Earlier,
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::Region;
    use crate::viewer::frames::frame::ExactCells;

    /// A preview of 16 x 8 pixels whose first cell is final.
    fn preview(quality: PreviewQuality) -> Preview {
        let mut exact = ExactCells::new([16, 8]);
        exact.mark(Region::of_size([8, 8]));
        Preview { quality, exact }
    }

    /// Which of both cells are hatched.
    fn hatched(frames: [Option<&Preview>; 2]) -> [bool; 2] {
        let mut row = [0; 16];
        Refining(frames).hatch(3, 0..16, &mut row);
        let is_hatch = |pixel: &u32| HATCH.contains(pixel);
        [&row[..8], &row[8..]].map(|cell| {
            let count = cell.iter().filter(|pixel| is_hatch(pixel)).count();
            assert!(count == 0 || count == 8, "all of a cell: {count}");
            count > 0
        })
    }

    #[test]
    fn preview_is_not_compared_with_a_final_picture() {
        let [rate_one, earlier] = [PreviewQuality::RateOne, PreviewQuality::Earlier].map(preview);
        let moved = preview(PreviewQuality::Moved);
        assert_eq!(hatched([None, None]), [false; 2], "both final");
        assert_eq!(hatched([Some(&rate_one), None]), [false, true], "one is refined");
        assert_eq!(hatched([None, Some(&rate_one)]), [false, true], "or the other");
        assert_eq!(hatched([Some(&rate_one); 2]), [false; 2], "both alike");
        assert_eq!(hatched([Some(&moved), None]), [false; 2], "as final, but for its place");
        assert_eq!(
            hatched([Some(&earlier); 2]),
            [false, true],
            "what was there before says nothing"
        );
    }
}
