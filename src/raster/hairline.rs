//! Lines one pixel wide: which pixels a digital differential analyser visits.
//!
//! The course's algorithm, step by step in 32-bit floats, because its rounding decides which of two pixels is filled.

use glam::DVec2;

/// How far outside the frame a line is stepped along rather than cut off, in pixels.
const MARGIN: f64 = 4096.0;

/// Appends the pixels `[column, row]` of the line between two screen-space points that lie in a frame of `size`.
pub(super) fn trace(ends: [DVec2; 2], size: [u32; 2], pixels: &mut Vec<[u16; 2]>) {
    let Some([from, to]) = cut(ends, size) else {
        return;
    };
    let (from, to) = if from[0] > to[0] { (to, from) } else { (from, to) };
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let slope = dy / dx;
    let step = if slope.abs() <= 1.0 {
        [1.0, slope]
    } else if dx == 0.0 {
        [0.0, if dy < 0.0 { -1.0 } else { 1.0 }]
    } else {
        [1.0 / slope.abs(), slope.signum()]
    };
    let frame = [size[0] as f32, size[1] as f32];
    let [mut x, mut y] = from;
    while x.floor() <= to[0].floor() && (y - from[1]).abs() <= dy.abs() {
        if x >= 0.0 && x < frame[0] && y >= 0.0 && y < frame[1] {
            pixels.push(pixel(truncate(x), truncate(y)));
        }
        x += step[0];
        y += step[1];
    }
}

/// A pixel inside a frame, whose sides fit 16 bits.
pub(super) fn pixel(x: i32, y: i32) -> [u16; 2] {
    [x, y].map(|coordinate| u16::try_from(coordinate).unwrap_or(0))
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the caller has checked that it lies in the frame"
)]
fn truncate(coordinate: f32) -> i32 {
    coordinate as i32
}

/// The ends as 32-bit floats, where a line that reaches beyond the margin is cut to it; `None` when it misses the
/// frame. Lines inside the margin stay as they are: cutting would change their rounding.
fn cut(ends: [DVec2; 2], size: [u32; 2]) -> Option<[[f32; 2]; 2]> {
    let frame = DVec2::new(f64::from(size[0]), f64::from(size[1]));
    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    if !low.is_finite() || !high.is_finite() || high.cmplt(DVec2::ZERO).any() || low.cmpge(frame).any() {
        return None;
    }
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

    fn pixels(from: (f64, f64), to: (f64, f64)) -> Vec<[u16; 2]> {
        let mut pixels = Vec::new();
        trace([DVec2::from(from), DVec2::from(to)], [8, 6], &mut pixels);
        pixels
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
