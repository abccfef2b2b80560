//! How the lines of a chart look: each has a colour of its own, and where the colours are used up, other dashes and other
//! marks of its points.

use glam::DVec2;

use crate::figure::lines::{Stroke, draw_line};
use crate::figure::paint::{blend, for_each_index};
use crate::figure::{Anchor, PixelRect, TextBlock};
use crate::raster::Framebuffer;

/// Colours of series, `0xAARRGGBB` (M. Okabe, K. Ito, "Color Universal Design", 2008), the palest left out.
pub(super) const COLORS: [u32; 7] = [
    0xff00_72b2,
    0xffd5_5e00,
    0xff00_9e73,
    0xffcc_79a7,
    0xffe6_9f00,
    0xff56_b4e9,
    0xff40_4040,
];
/// Lengths of dashes and of the gaps behind them, in widths of the line; none is a line without gaps.
const DASHES: [&[f64]; 4] = [&[], &[7.0, 4.0], &[2.0, 3.0], &[9.0, 3.0, 2.0, 3.0]];
/// A mark's pixel is covered as far as so many points in each direction lie inside.
const POINTS: u8 = 4;

/// How a series looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Look {
    pub(super) color: u32,
    mark: Mark,
    dashes: &'static [f64],
}

/// The shape of points, all of about the same area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mark {
    Disc,
    Square,
    Triangle,
    Diamond,
}

impl Mark {
    const ALL: [Self; 4] = [Self::Disc, Self::Square, Self::Triangle, Self::Diamond];

    /// Whether a place lies inside, in radii from the middle.
    fn holds(self, DVec2 { x, y }: DVec2) -> bool {
        match self {
            Self::Disc => x * x + y * y <= 1.0,
            Self::Square => x.abs().max(y.abs()) <= 0.9,
            // Upright: the point above, all sides alike.
            Self::Triangle => y <= 0.75 && x.abs() * 3.0_f64.sqrt() <= y + 1.5,
            Self::Diamond => x.abs() + y.abs() <= 1.3,
        }
    }
}

impl Look {
    /// That of a series by its number: all of the first 112 differ.
    pub(super) fn of_series(number: usize) -> Self {
        let round = number / COLORS.len();
        let marks = Mark::ALL.len();
        Self {
            color: COLORS[number % COLORS.len()],
            mark: Mark::ALL[round % marks],
            dashes: DASHES[(round + round / marks) % DASHES.len()],
        }
    }

    /// A line from point to point, as thick everywhere. Nothing reaches beyond the points by more than half of the `width`,
    /// however sharply the line turns.
    pub(super) fn draw_line(&self, picture: &mut Framebuffer, points: &[DVec2], width: f64) {
        #[expect(clippy::cast_possible_truncation, reason = "a few pixels")]
        let stroke = Stroke {
            color: self.color,
            halo: 0,
            width: width as f32,
        };
        let mut along = 0.0;
        for pair in points.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let length = from.distance(to);
            if length <= 0.0 {
                continue;
            }
            for part in inked(self.dashes, width, [along, along + length]) {
                let [start, end] = part.map(|at| from.lerp(to, ((at - along) / length).clamp(0.0, 1.0)));
                draw_line(picture, start, end, stroke);
            }
            along += length;
        }
    }

    /// The mark of a point.
    pub(super) fn draw_mark(&self, picture: &mut Framebuffer, middle: DVec2, radius: f64) {
        let reach = DVec2::splat(radius * 1.6);
        let [low, high] = [middle - reach, middle + reach].map(|corner| [corner.x, corner.y].map(whole));
        let side = |axis: usize| u32::try_from(high[axis] - low[axis] + 1).unwrap_or(0);
        let square = PixelRect {
            x: low[0],
            y: low[1],
            width: side(0),
            height: side(1),
        };
        let columns = picture.width() as usize;
        let square = square.intersection(&PixelRect::of_size([picture.width(), picture.height()]));
        for_each_index(&square, columns, |index| {
            let corner = DVec2::new((index % columns) as f64, (index / columns) as f64);
            let inside = (0..POINTS * POINTS).filter(|point| {
                let point = DVec2::new(f64::from(point % POINTS), f64::from(point / POINTS)) + 0.5;
                self.mark.holds((corner + point / f64::from(POINTS) - middle) / radius)
            });
            let part = inside.count() as f32 / f32::from(POINTS * POINTS);
            let pixel = &mut picture.pixels_mut()[index];
            *pixel = blend(*pixel, self.color, part);
        });
    }
}

/// Draws words with paper around their letters, so that they are read over lines too.
pub(super) fn draw_words(picture: &mut Framebuffer, [ink, paper]: [&TextBlock; 2], [x, y]: [i64; 2]) {
    for (across, down) in [(-1, 0), (1, 0), (0, -1), (0, 1), (-1, -1), (1, 1), (-1, 1), (1, -1)] {
        paper.draw(picture, [x + across * 2, y + down * 2], Anchor::Left);
    }
    ink.draw(picture, [x, y], Anchor::Left);
}

/// The parts of a stretch along a line that have ink, where dashes begin at its start.
fn inked(dashes: &[f64], width: f64, [start, end]: [f64; 2]) -> Vec<[f64; 2]> {
    let period = dashes.iter().sum::<f64>() * width;
    if period <= 0.0 {
        return vec![[start, end]];
    }
    let mut parts = Vec::new();
    let mut at = (start / period).floor() * period;
    while at < end {
        for (index, length) in dashes.iter().map(|length| length * width).enumerate() {
            let part = [at.max(start), (at + length).min(end)];
            if index % 2 == 0 && part[0] < part[1] {
                parts.push(part);
            }
            at += length;
        }
    }
    parts
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "`as` saturates; a rectangle is clipped to its picture"
)]
fn whole(length: f64) -> i64 {
    length.floor() as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_differ_from_series_to_series() {
        let looks: Vec<Look> = (0..112).map(Look::of_series).collect();
        for (index, look) in looks.iter().enumerate() {
            assert!(!looks[..index].contains(look), "{index}: {look:?}");
        }
    }

    #[test]
    fn dashes_go_on_around_corners() {
        let dashes = [3.0, 1.0];
        assert_eq!(inked(&dashes, 1.0, [0.0, 6.0]), [[0.0, 3.0], [4.0, 6.0]], "one side");
        assert_eq!(inked(&dashes, 1.0, [6.0, 9.0]), [[6.0, 7.0], [8.0, 9.0]], "the next");
        assert_eq!(inked(&[], 1.0, [6.0, 9.0]), [[6.0, 9.0]], "no gaps");
        assert!(inked(&dashes, 1.0, [5.0, 5.0]).is_empty(), "of no length");
    }

    #[test]
    fn lines_have_no_mitres() {
        let mut picture = Framebuffer::new(60, 60);
        picture.pixels_mut().fill(0xffff_ffff);
        let points = [[20.0, 30.0], [40.0, 30.0], [20.5, 30.4], [40.0, 31.0]].map(DVec2::from);
        Look::of_series(0).draw_line(&mut picture, &points, 4.0);
        let inked = |x: usize, y: usize| picture.pixels()[y * 60 + x] != 0xffff_ffff;
        let all = (0..60).flat_map(|y| (0..60).map(move |x| (x, y)));
        let columns: Vec<usize> = all.filter(|(x, y)| inked(*x, *y)).map(|(x, _)| x).collect();
        assert_eq!(columns.iter().min(), Some(&20), "from the first");
        assert_eq!(columns.iter().max(), Some(&39), "to the last, and no farther");
    }

    #[test]
    fn marks_are_of_one_size() {
        for mark in Mark::ALL {
            let look = Look {
                mark,
                ..Look::of_series(0)
            };
            let mut picture = Framebuffer::new(40, 40);
            picture.pixels_mut().fill(0xffff_ffff);
            look.draw_mark(&mut picture, DVec2::splat(20.0), 10.0);
            let inked = picture.pixels().iter().filter(|pixel| **pixel == look.color).count();
            assert!((220..=360).contains(&inked), "{mark:?}: {inked} pixels");
        }
    }
}
