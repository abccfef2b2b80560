//! Spectra: of what, of which part of the picture, and what was found.

pub(in crate::viewer) mod question;

use crate::compare::{SpectrumAnalysis, SpectrumOf};
use crate::raster::Region;
use crate::viewer::spectrum::question::Spectra;

/// Which part of the picture is transformed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SpectrumPart {
    /// All of it that panels leave free, or the middle of that where it is large.
    #[default]
    Whole,
    /// A square around the pinned pixel, or around the middle while none is pinned.
    Pin,
}

impl SpectrumPart {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 2] = [Self::Whole, Self::Pin];
    /// Side of the square, in pixels.
    const SIDE: u32 = 128;

    /// The name used in the interface and in scripts.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Whole => "whole",
            Self::Pin => "pin",
        }
    }

    /// Its pixels, in a frame of `size` of which panels leave `free`.
    pub(in crate::viewer) fn region(self, size: [u32; 2], free: Region, pixel: [u32; 2]) -> Region {
        match self {
            Self::Whole => SpectrumAnalysis::middle_of(free.intersection(Region::of_size(size))),
            Self::Pin => {
                let [(x, width), (y, height)] = [0, 1].map(|axis| {
                    let side = Self::SIDE.min(size[axis]);
                    let start = pixel[axis].saturating_sub(side / 2);
                    (start.min(size[axis] - side), side)
                });
                Region { x, y, width, height }
            }
        }
    }
}

/// The state of spectra.
#[derive(Debug)]
pub(in crate::viewer) struct SpectrumState {
    /// Whether one is to be seen.
    pub(in crate::viewer) open: bool,
    /// Of what.
    pub(in crate::viewer) of: SpectrumOf,
    /// Of which part.
    pub(in crate::viewer) part: SpectrumPart,
    pub(in crate::viewer) spectra: Spectra,
}

impl SpectrumState {
    pub(in crate::viewer) fn new(spectra: Spectra) -> Self {
        Self {
            open: false,
            of: SpectrumOf::default(),
            part: SpectrumPart::default(),
            spectra,
        }
    }

    /// Closes it; true if it was open.
    pub(in crate::viewer) fn escape(&mut self) -> bool {
        std::mem::take(&mut self.open)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_lie_in_the_frame() {
        let around = |size, pixel| SpectrumPart::Pin.region(size, Region::of_size(size), pixel);
        let region = |x, y, width, height| Region { x, y, width, height };
        assert_eq!(around([640, 480], [320, 100]), region(256, 36, 128, 128), "around it");
        assert_eq!(
            around([640, 480], [5, 479]),
            region(0, 352, 128, 128),
            "beside the border"
        );
        assert_eq!(around([100, 60], [50, 50]), region(0, 0, 100, 60), "all of a small one");
        let whole = |free| SpectrumPart::Whole.region([1280, 300], free, [0, 0]);
        assert_eq!(whole(region(0, 0, 1280, 300)), region(384, 0, 512, 300), "the middle");
        assert_eq!(
            whole(region(0, 20, 1000, 280)),
            region(244, 20, 512, 280),
            "of what panels leave"
        );
        assert_eq!(whole(region(0, 0, 400, 300)), region(0, 0, 400, 300), "all of that");
    }
}
