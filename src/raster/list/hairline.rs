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

/// Gathers pixels that come one after the other into blocks of eight by eight.
#[derive(Debug)]
struct Gatherer<F: FnMut(CoverageMask)> {
    block: CoverageMask,
    emit: F,
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

    /// Calls `visit` with each pixel `[column, row]` of the line that lies in the `size` that is painted.
    #[inline]
    fn trace(&self, size: [u32; 2], mut visit: impl FnMut(i32, i32)) {
        let Self { from, to, .. } = *self;
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let slope = dy / dx;
        let step = if slope.abs() <= 1.0 {
            [1.0, slope]
        } else if dx == 0.0 {
            [0.0, if dy < 0.0 { -1.0 } else { 1.0 }]
        } else {
            [1.0 / slope.abs(), slope.signum()]
        };
        let least = -self.margin as f32;
        let frame = size.map(|pixels| pixels as f32 + least);
        let (last, height) = (to[0].floor(), dy.abs());
        let [mut x, mut y] = from;
        // Before its whole number exceeds `last`, `x` exceeds it by one.
        while x < last + 1.0 && (y - from[1]).abs() <= height {
            if x >= least && x < frame[0] && y >= least && y < frame[1] {
                visit(self.cell(x), self.cell(y));
            }
            x += step[0];
            y += step[1];
        }
    }

    /// Calls `visit` with the pixels of the line in a frame of `size`, up to eight by eight of them at once.
    #[inline]
    pub(crate) fn blocks(&self, size: [u32; 2], visit: impl FnMut(CoverageMask)) {
        let mut gatherer = Gatherer {
            block: CoverageMask::default(),
            emit: visit,
        };
        self.trace(size, |x, y| gatherer.add(x, y));
        gatherer.finish();
    }
}

impl<F: FnMut(CoverageMask)> Gatherer<F> {
    #[inline]
    fn add(&mut self, x: i32, y: i32) {
        let (column, row) = (x & -SMALL, y & -SMALL);
        let bit = 1 << (SMALL * (y - row) + x - column);
        // A pixel that a line visits twice is painted twice.
        if self.block.column != column || self.block.row != row || self.block.mask & bit != 0 {
            self.finish();
            self.block.column = column;
            self.block.row = row;
        }
        self.block.mask |= bit;
    }

    #[inline]
    fn finish(&mut self) {
        if self.block.mask != 0 {
            (self.emit)(self.block);
        }
        self.block.mask = 0;
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

    fn pixels(from: (f64, f64), to: (f64, f64)) -> Vec<[i32; 2]> {
        let mut pixels = Vec::new();
        if let Some(line) = line(from, to, [8, 6]) {
            line.trace([8, 6], |x, y| pixels.push([x, y]));
        }
        pixels
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
            let (mut expected, mut found) = (Vec::new(), Vec::new());
            line.trace(SIZE, |x, y| expected.push([x, y]));
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
