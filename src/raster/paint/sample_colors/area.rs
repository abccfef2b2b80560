//! Painting areas of pixels with one colour each.

use super::{SampleColors, ShadedColors};
use crate::color::Premultiplied16;
use crate::raster::coverage::area::row::{Area, CoveredArea};
use crate::raster::span::Span;
use crate::rules::Rules;

impl SampleColors {
    /// Paints a part of some pixels of row `y`, which have one colour each, with one colour: each is the mean of what it showed
    /// and of what it shows where it is covered.
    #[inline]
    pub(crate) fn fill_area(&mut self, y: i32, covered: CoveredArea, color: Premultiplied16) {
        let CoveredArea { xs, area } = covered;
        if xs.is_empty() {
            return;
        }
        let first = self.index(xs.start, y);
        let pixels = &mut self.whole[first..first + xs.length()];
        if area == Area::WHOLE {
            if color.is_opaque() {
                pixels.fill(color);
            } else {
                color.over_all(pixels, self.rules);
            }
            return;
        }
        // Bytes are stored after every write: else what is painted with nothing later would truncate them, tile by tile.
        let truncates = self.rules == Rules::Course;
        for below in pixels {
            let above = if color.is_opaque() && !truncates {
                color
            } else {
                color.over(*below, self.rules)
            };
            let mixed = self.space.mix(*below, above, area.parts());
            *below = if truncates { mixed.truncated() } else { mixed };
        }
    }

    /// As [`SampleColors::fill_area`], with a colour for each of the pixels.
    pub(crate) fn fill_area_each(&mut self, y: i32, covered: CoveredArea, shaded: ShadedColors<'_>) {
        let CoveredArea { xs, area } = covered;
        if area == Area::WHOLE {
            return self.fill_each(xs, y, shaded);
        }
        for (start, color) in (xs.start..xs.end).zip(shaded.colors) {
            let xs = Span { start, end: start + 1 };
            self.fill_area(y, CoveredArea { xs, area }, *color);
        }
    }
}
