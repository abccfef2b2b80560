//! Lines one pixel wide: which pixels a digital differential analyser visits.
//!
//! The course's algorithm, step by step in 32-bit floats, because its rounding decides which of two pixels is filled.

use glam::DVec2;

use crate::color::Premultiplied16;
use crate::raster::coverage::mask8x8::CoverageMask;
use crate::raster::span::SMALL;

/// How far outside the frame a line is stepped along rather than cut off, in pixels.
const MARGIN: f64 = 4096.0;

/// A line one pixel wide, near the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hairline {
    /// From left to right, in pixels.
    from: [f32; 2],
    to: [f32; 2],
    /// Pixels that are painted on each side of the frame.
    margin: i32,
    pub(crate) color: Premultiplied16,
}

/// Steps along a line, from its left end on.
#[derive(Debug)]
struct Walk<'a> {
    line: &'a Hairline,
    at: [f32; 2],
    step: [f32; 2],
    /// Where `x` is beyond the line.
    end: f32,
    /// How far `y` gets.
    height: f32,
}

impl Hairline {
    /// The line between two screen-space points; `None` when it misses the `size` that is painted, of which `margin` pixels
    /// on each side lie beyond the frame. It keeps its place in the frame, so that it rounds alike whatever the margin.
    pub(crate) fn new(ends: [DVec2; 2], size: [u32; 2], margin: u32, color: Premultiplied16) -> Option<Self> {
        let [from, to] = cut(ends, size, margin)?;
        let (from, to) = if from[0] > to[0] { (to, from) } else { (from, to) };
        Some(Self {
            from,
            to,
            margin: margin.cast_signed(),
            color,
        })
    }

    /// The pixel that a coordinate falls in, which lies in what is painted.
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the caller has checked that it lies near the frame"
    )]
    fn cell(&self, coordinate: f32) -> i32 {
        let truncated = coordinate as i32;
        // Without a margin nothing lies below zero, and pictures of many lines are drawn without.
        if self.margin == 0 {
            return truncated;
        }
        truncated - i32::from(truncated as f32 > coordinate) + self.margin
    }

    /// Whether every step of the line lies in the `size` that is painted.
    fn is_inside(&self, size: [u32; 2]) -> bool {
        let least = -self.margin as f32;
        let [right, bottom] = size.map(|pixels| pixels as f32 + least);
        let ([left, from], [last, to]) = (self.from, self.to);
        // Steps go up to a pixel beyond the ends, and rounding moves them by far less.
        left >= least && last < right - 1.0 && from.min(to) >= least + 1.0 && from.max(to) < bottom - 1.0
    }

    /// Calls `visit` with the pixels of the line that lie in the `size` that is painted, up to eight by eight of them at once:
    /// column and row of each block are multiples of eight.
    #[inline]
    pub(crate) fn blocks(&self, size: [u32; 2], mut visit: impl FnMut(CoverageMask)) {
        let mut walk = Walk::new(self);
        let inside = self.is_inside(size);
        let frame = size.map(|pixels| pixels as f32 - self.margin as f32);
        loop {
            let block = if inside {
                walk.block(|_, _| true)
            } else {
                let least = -self.margin as f32;
                walk.block(|x, y| x >= least && x < frame[0] && y >= least && y < frame[1])
            };
            if block.mask == 0 {
                return;
            }
            visit(block);
        }
    }
}

impl<'a> Walk<'a> {
    /// At the line's left end.
    #[inline]
    fn new(line: &'a Hairline) -> Self {
        let Hairline { from, to, .. } = *line;
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let slope = dy / dx;
        let step = if slope.abs() <= 1.0 {
            [1.0, slope]
        } else if dx == 0.0 {
            [0.0, if dy < 0.0 { -1.0 } else { 1.0 }]
        } else {
            [1.0 / slope.abs(), slope.signum()]
        };
        Self {
            line,
            at: from,
            step,
            // Before its whole number exceeds that of the last, `x` exceeds it by one.
            end: to[0].floor() + 1.0,
            height: dy.abs(),
        }
    }

    /// The next pixels that lie in one block of eight by eight, of the steps that `is_painted`; none at the line's end. No pixel
    /// comes twice: each step goes on by a whole one along the longer axis.
    #[inline]
    fn block(&mut self, is_painted: impl Fn(f32, f32) -> bool) -> CoverageMask {
        let mut block = CoverageMask::default();
        let [mut x, mut y] = self.at;
        while x < self.end && (y - self.line.from[1]).abs() <= self.height {
            if is_painted(x, y) {
                let (column, row) = (self.line.cell(x), self.line.cell(y));
                let corner = (column & -SMALL, row & -SMALL);
                if block.mask == 0 {
                    (block.column, block.row) = corner;
                } else if (block.column, block.row) != corner {
                    break;
                }
                block.mask |= 1 << (SMALL * (row - corner.1) + column - corner.0);
            }
            x += self.step[0];
            y += self.step[1];
        }
        self.at = [x, y];
        block
    }
}

/// The ends as 32-bit floats, where a line that reaches far beyond the frame is cut; `None` when it misses what is painted.
/// Others stay as they are: cutting would change their rounding.
fn cut(ends: [DVec2; 2], size: [u32; 2], margin: u32) -> Option<[[f32; 2]; 2]> {
    let first = DVec2::splat(-f64::from(margin));
    let beyond = first + DVec2::new(f64::from(size[0]), f64::from(size[1]));
    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    if !low.is_finite() || !high.is_finite() || high.cmplt(first).any() || low.cmpge(beyond).any() {
        return None;
    }
    let frame = beyond + first;
    let (least, greatest) = (DVec2::splat(-MARGIN), frame + MARGIN);
    let inside = low.cmpge(least).all() && high.cmple(greatest).all();
    let [from, to] = if inside {
        ends
    } else {
        clip_segment(ends, least, greatest)?
    };
    Some([narrow(from), narrow(to)])
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the algorithm is defined on 32-bit floats"
)]
fn narrow(point: DVec2) -> [f32; 2] {
    [point.x as f32, point.y as f32]
}

/// The part of a segment inside a box, cut by one side after the other (Sutherland and Hodgman, 1974): each cut starts
/// from ends that earlier cuts have brought near, so that even a line of 1e30 pixels keeps its digits.
fn clip_segment([mut a, mut b]: [DVec2; 2], least: DVec2, greatest: DVec2) -> Option<[DVec2; 2]> {
    for axis in 0..2 {
        for (sign, bound) in [(1.0, least[axis]), (-1.0, greatest[axis])] {
            let outside = |point: DVec2| sign * (point[axis] - bound) < 0.0;
            match (outside(a), outside(b)) {
                (true, true) => return None,
                (true, false) => a = cut_at(a, b, axis, bound),
                (false, true) => b = cut_at(b, a, axis, bound),
                (false, false) => {}
            }
        }
    }
    Some([a, b])
}

/// The point of a segment where its coordinate along `axis` is `bound`.
fn cut_at(from: DVec2, to: DVec2, axis: usize, bound: f64) -> DVec2 {
    // Halved, so that the difference of two huge coordinates stays finite.
    let t = (bound / 2.0 - from[axis] / 2.0) / (to[axis] / 2.0 - from[axis] / 2.0);
    let mut point = from * (1.0 - t) + to * t;
    point[axis] = bound;
    point
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(from: (f64, f64), to: (f64, f64), size: [u32; 2]) -> Option<Hairline> {
        let ends = [DVec2::from(from), DVec2::from(to)];
        Hairline::new(ends, size, 0, Premultiplied16::TRANSPARENT)
    }

    /// The pixels of a line step by step, each of which is looked at by itself.
    fn trace(line: &Hairline, size: [u32; 2]) -> Vec<[i32; 2]> {
        let Walk {
            at: [mut x, mut y],
            step,
            end,
            height,
            ..
        } = Walk::new(line);
        let inside = |at: f32, side: u32| (0.0..side as f32).contains(&at);
        let mut pixels = Vec::new();
        while x < end && (y - line.from[1]).abs() <= height {
            if inside(x, size[0]) && inside(y, size[1]) {
                pixels.push([line.cell(x), line.cell(y)]);
            }
            x += step[0];
            y += step[1];
        }
        pixels
    }

    fn pixels(from: (f64, f64), to: (f64, f64)) -> Vec<[i32; 2]> {
        line(from, to, [8, 6]).map_or_else(Vec::new, |line| trace(&line, [8, 6]))
    }

    #[test]
    fn hairline_in_blocks_is_the_same_pixels() {
        const SIZE: [u32; 2] = [90, 70];
        arbtest::arbtest(|u| {
            let mut point = || -> arbtest::arbitrary::Result<(f64, f64)> {
                let mut at = || Ok(f64::from(u.int_in_range(-600..=1200)?) / 10.0);
                Ok((at()?, at()?))
            };
            let Some(line) = line(point()?, point()?, SIZE) else {
                return Ok(());
            };
            let (mut expected, mut found) = (trace(&line, SIZE), Vec::new());
            let mut blocks = 0;
            line.blocks(SIZE, |block| {
                blocks += 1;
                for bit in (0..64).filter(|bit| block.mask >> bit & 1 == 1) {
                    found.push([block.column + bit % SMALL, block.row + bit / SMALL]);
                }
            });
            assert!(
                blocks <= 2 + expected.len() / 3,
                "{blocks} blocks for {} pixels",
                expected.len()
            );
            expected.sort_unstable();
            found.sort_unstable();
            assert_eq!(found, expected, "{line:?}");
            Ok(())
        })
        .budget_ms(200);
    }

    #[test]
    fn hairline_steps_along_its_longer_axis() {
        assert_eq!(
            pixels((0.5, 0.5), (3.5, 0.5)),
            [[0, 0], [1, 0], [2, 0], [3, 0]],
            "horizontal"
        );
        assert_eq!(
            pixels((3.5, 0.5), (0.5, 0.5)),
            pixels((0.5, 0.5), (3.5, 0.5)),
            "either direction"
        );
        assert_eq!(
            pixels((2.5, 3.5), (2.5, 1.5)),
            [[2, 3], [2, 2], [2, 1]],
            "vertical, upwards"
        );
        assert_eq!(
            pixels((0.5, 0.5), (1.5, 3.5)),
            [[0, 0], [0, 1], [1, 2], [1, 3]],
            "steep"
        );
        assert_eq!(pixels((2.25, 2.75), (2.25, 2.75)), [[2, 2]], "a point");
    }

    #[test]
    fn hairline_of_any_length_ends() {
        for far in [1e4, 1e9, 1e30, 1e300] {
            assert_eq!(pixels((-far, 2.5), (far, 2.5)).len(), 8, "across, {far} long");
            assert_eq!(pixels((3.5, far), (3.5, -far)).len(), 6, "down, {far} long");
            assert!(pixels((-far, -far), (far, far)).len() >= 6, "diagonal, {far} long");
            assert!(pixels((far, far), (far, -far)).is_empty(), "beside, {far} away");
        }
    }
}
