//! The picture below the panels, row by row: A alone, both beside a line or side by side, or what differs.
//!
//! Nothing is kept between two calls: a row is read from the frames when the window wants it. Screen pixels are the
//! window's pixels divided by the pixel zoom; frames lie in panes of the screen.

use std::ops::Range;

use crate::compare::DifferencePaint;
use crate::figure::PixelRect;
use crate::raster::Framebuffer;
use crate::viewer::frames::refining::Refining;
use crate::viewer::view::panes::Pane;

/// Where no frame reaches.
pub(in crate::viewer) const BEYOND: u32 = 0xff80_8080;

/// What a pane shows; all frames of one content are of one size.
#[derive(Clone, Copy, Debug)]
pub(in crate::viewer) enum Content<'a> {
    /// One frame.
    One(&'a Framebuffer),
    /// The first up to this column, the second from there on.
    Wipe([&'a Framebuffer; 2], u32),
    /// How far the second is from the first, where they can be compared.
    Difference([&'a Framebuffer; 2], &'a DifferencePaint, Refining<'a>),
}

/// Up to two panes with what they show.
#[derive(Clone, Debug, Default)]
pub(in crate::viewer) struct Composite<'a> {
    panes: Vec<(Pane, Content<'a>)>,
}

impl<'a> Content<'a> {
    fn frame(&self) -> &'a Framebuffer {
        match self {
            Self::One(frame) | Self::Wipe([frame, _], _) | Self::Difference([frame, _], ..) => frame,
        }
    }

    /// Writes some pixels of a row that the frames have.
    fn row(&self, y: usize, columns: Range<usize>, out: &mut [u32]) {
        let start = y * self.frame().width() as usize;
        let of = |frame: &'a Framebuffer, columns: &Range<usize>| {
            &frame.pixels()[start + columns.start..start + columns.end]
        };
        match self {
            Self::One(frame) => out.copy_from_slice(of(frame, &columns)),
            Self::Wipe([first, second], at) => {
                let at = (*at as usize).clamp(columns.start, columns.end);
                let (left, right) = out.split_at_mut(at - columns.start);
                left.copy_from_slice(of(first, &(columns.start..at)));
                right.copy_from_slice(of(second, &(at..columns.end)));
            }
            Self::Difference([first, second], paint, refining) => {
                paint.row(of(first, &columns), of(second, &columns), out);
                refining.hatch(y, columns, out);
            }
        }
    }
}

impl<'a> Composite<'a> {
    /// What the panes show, in the order in which they are drawn.
    pub(in crate::viewer) fn new(panes: Vec<(Pane, Content<'a>)>) -> Self {
        Self { panes }
    }

    /// The one frame that is all there is, from the screen's upper left corner on.
    pub(in crate::viewer) fn plain(&self) -> Option<&'a Framebuffer> {
        match self.panes.as_slice() {
            [(pane, Content::One(frame))] => {
                let reached = PixelRect::of_size([frame.width(), frame.height()]);
                let is_whole = pane.corner == [0, 0] && reached.intersection(&pane.area) == reached;
                is_whole.then_some(*frame)
            }
            _ => None,
        }
    }

    /// Each pane with what it shows and where that is to be seen on the screen.
    fn parts(&self) -> impl Iterator<Item = (&Pane, &Content<'a>, PixelRect)> {
        self.panes
            .iter()
            .map(|(pane, content)| (pane, content, place_of(pane, content).intersection(&pane.area)))
    }

    /// As it is, but that the one pane which is all there is shows its whole frame, beyond the screen, too.
    pub(in crate::viewer) fn whole(mut self) -> Self {
        if let [(pane, content)] = self.panes.as_mut_slice() {
            pane.area = place_of(pane, content);
        }
        self
    }

    /// Writes some columns of a row of the screen; `out` has as many pixels.
    pub(in crate::viewer) fn row(&self, y: usize, columns: Range<usize>, out: &mut [u32]) {
        self.line([signed(columns.start), signed(y)], out);
    }

    /// Writes the pixels of a row of the screen that begin at a column and row, which may lie beyond the screen.
    fn line(&self, [x, y]: [i64; 2], out: &mut [u32]) {
        out.fill(BEYOND);
        let wanted = PixelRect {
            x,
            y,
            width: u32::try_from(out.len()).unwrap_or(u32::MAX),
            height: 1,
        };
        for (pane, content, seen) in self.parts() {
            let part = seen.intersection(&wanted);
            if part.width == 0 || part.height == 0 {
                continue;
            }
            let length = part.width as usize;
            let (from, to) = (unsigned(part.x - pane.corner[0]), unsigned(part.x - wanted.x));
            content.row(
                unsigned(part.y - pane.corner[1]),
                from..from + length,
                &mut out[to..to + length],
            );
        }
    }

    /// What of the screen the panes fill.
    pub(in crate::viewer) fn bounds(&self) -> PixelRect {
        let places = self.parts().map(|(_, _, seen)| seen);
        places.reduce(|one, other| one.union(&other)).unwrap_or_default()
    }

    /// A part of the screen as a picture.
    pub(in crate::viewer) fn picture_of(&self, bounds: &PixelRect) -> Framebuffer {
        let mut picture = Framebuffer::new(bounds.width, bounds.height);
        let rows = picture.pixels_mut().chunks_exact_mut((bounds.width as usize).max(1));
        for (y, row) in (bounds.y..).zip(rows) {
            self.line([bounds.x, y], row);
        }
        picture
    }
}

/// Where the frames of a pane lie on the screen, and beyond it.
fn place_of(pane: &Pane, content: &Content<'_>) -> PixelRect {
    let frame = content.frame();
    PixelRect {
        x: pane.corner[0],
        y: pane.corner[1],
        width: frame.width(),
        height: frame.height(),
    }
}

fn signed(position: usize) -> i64 {
    i64::try_from(position).unwrap_or(i64::MAX)
}

/// Positions inside the screen are not negative.
fn unsigned(position: i64) -> usize {
    usize::try_from(position).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::Measure;

    /// Every pixel has a colour of its own.
    fn frame(width: u32, height: u32, seed: u32) -> Framebuffer {
        let mut frame = Framebuffer::new(width, height);
        for (i, pixel) in (seed..).zip(frame.pixels_mut()) {
            *pixel = 0xff00_0000 | i.wrapping_mul(2_654_435_761) >> 8;
        }
        frame
    }

    /// A pixel `0xAARRGGBB`.
    fn pixel(content: &Content<'_>, [x, y]: [u32; 2]) -> Option<u32> {
        let frame = content.frame();
        let mut pixel = [0];
        let inside = x < frame.width() && y < frame.height();
        inside.then(|| {
            content.row(y as usize, x as usize..x as usize + 1, &mut pixel);
            pixel[0]
        })
    }

    fn pane(area: [i64; 2], size: [u32; 2], corner: [i64; 2]) -> Pane {
        Pane {
            area: PixelRect {
                x: area[0],
                y: area[1],
                width: size[0],
                height: size[1],
            },
            corner,
        }
    }

    #[test]
    fn composite_of_a_wipe_is_pixel_exact() {
        let (a, b) = (frame(9, 4, 1), frame(9, 4, 500));
        for at in [0, 1, 5, 9, 99] {
            let whole = pane([0, 0], [9, 4], [0, 0]);
            let composite = Composite::new(vec![(whole, Content::Wipe([&a, &b], at))]);
            let picture = composite.picture_of(&composite.bounds());
            for y in 0..4 {
                for x in 0..9 {
                    let expected = if x < at { a.rgba(x, y) } else { b.rgba(x, y) };
                    assert_eq!(picture.rgba(x, y), expected, "{x}, {y} with the line at {at}");
                }
            }
        }
    }

    #[test]
    fn composite_of_one_pane_is_whole_beyond_the_screen() {
        let only = frame(9, 7, 1);
        let cut = Composite::new(vec![(pane([0, 0], [6, 5], [-2, -1]), Content::One(&only))]);
        assert_eq!(cut.bounds(), PixelRect::of_size([6, 5]));
        let whole = cut.whole();
        assert_eq!(whole.picture_of(&whole.bounds()).pixels(), only.pixels());
    }

    #[test]
    fn composite_of_a_difference_is_the_pairs_picture() {
        let (a, b) = (frame(70, 5, 1), frame(70, 5, 2));
        for measure in Measure::ALL {
            let paint = DifferencePaint::new(measure, 2.0);
            let whole = pane([0, 0], [70, 5], [0, 0]);
            let content = Content::Difference([&a, &b], &paint, Refining::default());
            let picture = Composite::new(vec![(whole, content)]).picture_of(&whole.area);
            let pixels = a.pixels().iter().zip(b.pixels());
            let expected: Vec<u32> = pixels.map(|(a, b)| paint.pixel(*a, *b)).collect();
            assert_eq!(picture.pixels(), expected, "{measure:?}");
        }
    }

    #[test]
    fn composite_rows_come_from_their_panes() {
        arbtest::arbtest(|u| {
            let frames = [
                frame(u.int_in_range(0..=12)?, u.int_in_range(0..=8)?, 1),
                frame(7, 6, 300),
            ];
            let mut panes = Vec::new();
            for frame in &frames {
                let mut number = |least: i64, most: i64| u.int_in_range(least..=most);
                let area = [number(0, 10)?, number(0, 6)?];
                let size = [number(0, 12)?, number(0, 8)?].map(|side| u32::try_from(side).unwrap_or(0));
                panes.push((pane(area, size, [number(-6, 14)?, number(-6, 9)?]), Content::One(frame)));
            }
            let composite = Composite::new(panes.clone());
            let start = u.int_in_range(0..=20)?;
            let columns = start..u.int_in_range(start..=25)?;
            for y in 0..12 {
                let mut row = vec![0; columns.len()];
                composite.row(y, columns.clone(), &mut row);
                for (x, written) in columns.clone().zip(row) {
                    let at = [signed(x), signed(y)];
                    let seen = panes.iter().rev().find_map(|(pane, content)| {
                        let inside = [at[0] - pane.corner[0], at[1] - pane.corner[1]].map(u32::try_from);
                        let [Ok(x), Ok(y)] = inside else { return None };
                        pixel(content, [x, y]).filter(|_| pane.area.contains(at))
                    });
                    assert_eq!(written, seen.unwrap_or(BEYOND), "{at:?} of {panes:?}");
                }
            }
            Ok(())
        })
        .budget_ms(300);
    }
}
