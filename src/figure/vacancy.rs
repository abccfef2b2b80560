//! Where a picture is empty: what lies over such places hides nothing.

use glam::{DAffine2, DVec2};

use super::PixelRect;
use crate::geometry::ViewTransform;
use crate::raster::{Framebuffer, SampleRate};
use crate::render::{self, RenderSettings, Subject};
use crate::rules::Rules;

/// Most cells along a side.
const CELLS: u32 = 160;
/// Enough samples that thin parts are seen.
const SAMPLES: u32 = 16;

/// What of a picture is painted, in square cells of some pixels. It depends on scene, view and size only, so that pictures of
/// one view under other settings are laid out alike.
pub(super) struct Vacancy {
    /// Pixels along the side of a cell.
    step: u32,
    columns: usize,
    rows: usize,
    /// Painted cells above and to the left of each corner of a cell.
    sums: Vec<u32>,
}

impl Vacancy {
    /// Draws the subject small.
    pub(super) fn of(subject: &Subject<'_>, size: [u32; 2]) -> Self {
        let step = size[0].max(size[1]).div_ceil(CELLS).max(1);
        let mut frame = Framebuffer::new(size[0].div_ceil(step), size[1].div_ceil(step));
        let view = ViewTransform {
            scene_to_pixels: DAffine2::from_scale(DVec2::splat(1.0 / f64::from(step))) * subject.view.scene_to_pixels,
        };
        let settings = RenderSettings {
            sample_rate: SampleRate::new(SAMPLES).unwrap_or_default(),
            background: subject.settings.background,
            outline: subject.settings.outline,
            ..RenderSettings::default()
        };
        render::draw(subject.scene, &view, &settings, &mut frame);
        let [r, g, b, a] = settings.background.to_bytes(Rules::Standard);
        let empty = if a == 0 { 0 } else { u32::from_be_bytes([a, r, g, b]) };
        Self::new(&frame, step, empty)
    }

    fn new(frame: &Framebuffer, step: u32, empty: u32) -> Self {
        let (columns, rows) = (frame.width() as usize, frame.height() as usize);
        let stride = columns + 1;
        let mut sums = vec![0; stride];
        for line in frame.pixels().chunks_exact(columns.max(1)) {
            let above = sums.len() - stride;
            let mut row = 0;
            sums.push(0);
            for (x, pixel) in line.iter().enumerate() {
                row += u32::from(*pixel != empty);
                sums.push(sums[above + x + 1] + row);
            }
        }
        Self {
            step,
            columns,
            rows,
            sums,
        }
    }

    /// The part of a rectangle that is painted, in thousandths; the cells that it touches count.
    pub(super) fn hidden(&self, rect: &PixelRect) -> u32 {
        let step = i64::from(self.step);
        let cell = |side: i64, most: usize| usize::try_from(side.max(0)).unwrap_or(0).min(most);
        let (left, right) = (
            cell(rect.x.div_euclid(step), self.columns),
            cell((rect.right() + step - 1).div_euclid(step), self.columns),
        );
        let (top, bottom) = (
            cell(rect.y.div_euclid(step), self.rows),
            cell((rect.bottom() + step - 1).div_euclid(step), self.rows),
        );
        let at = |x: usize, y: usize| self.sums[y * (self.columns + 1) + x];
        let painted = at(right, bottom) + at(left, top) - at(right, top) - at(left, bottom);
        let all = u32::try_from((right - left) * (bottom - top)).unwrap_or(u32::MAX);
        (painted * 1000).div_ceil(all.max(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vacancy_counts_painted_cells() {
        let mut frame = Framebuffer::new(6, 5);
        frame.pixels_mut().fill(0xFFFF_FFFF);
        for (x, y) in [(1, 1), (2, 1), (2, 2), (5, 4)] {
            frame.pixels_mut()[y * 6 + x] = 0xFF00_0000;
        }
        let vacancy = Vacancy::new(&frame, 10, 0xFFFF_FFFF);
        let rect = |x, y, width, height| PixelRect { x, y, width, height };
        assert_eq!(vacancy.hidden(&rect(0, 0, 60, 10)), 0, "the first row");
        assert_eq!(vacancy.hidden(&rect(10, 10, 20, 20)), 750, "three of four");
        assert_eq!(vacancy.hidden(&rect(19, 19, 2, 2)), 750, "touched ones count");
        assert_eq!(vacancy.hidden(&rect(-50, -50, 30, 30)), 0, "outside");
        assert_eq!(vacancy.hidden(&rect(50, 40, 99, 99)), 1000, "cut to the picture");
    }
}
