//! Edge functions as first drafts have them: in 32-bit floats, and without a rule for ties.
//!
//! A point is inside where all three are above zero. One on an edge that two triangles share is thus in neither, and where
//! rounding errs, it may be in neither or in both. That is what `--rules float` is there to show.
//!
//! Rounding keeps order: what is not less before it is not less after it. So each edge function, though it errs, only rises
//! or only falls along a row and along a column of samples. What a triangle covers of a row therefore lies side by side,
//! and the corners of a rectangle of samples tell of all of it whether an edge keeps it in or out.

use glam::{DVec2, Vec2};

/// A triangle in 32-bit floats, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloatTriangle {
    corners: [Vec2; 3],
    /// The box around the corners: nobody looks for samples beyond it.
    low: Vec2,
    high: Vec2,
    /// Turns edge functions so that they are above zero inside, whichever way the corners run.
    sign: f32,
}

impl FloatTriangle {
    /// `None` where the area is zero in 32-bit floats: then it draws nothing.
    pub fn new(points: [DVec2; 3]) -> Option<Self> {
        let corners = points.map(DVec2::as_vec2);
        let [a, b, c] = corners;
        let area = line(a, b, c);
        (area.abs() > 0.0).then(|| Self {
            corners,
            low: a.min(b).min(c),
            high: a.max(b).max(c),
            sign: area.signum(),
        })
    }

    /// The least and the greatest corner of the box around it.
    pub fn bounds(&self) -> [Vec2; 2] {
        [self.low, self.high]
    }

    /// The edge functions from the first corner to the second, to the third, and back, at a point: in square pixels, above
    /// zero inside.
    pub fn edges(&self, at: Vec2) -> [f32; 3] {
        [0, 1, 2].map(|i| self.edge(i, at))
    }

    fn edge(&self, i: usize, at: Vec2) -> f32 {
        self.sign * line(self.corners[i], self.corners[(i + 1) % 3], at)
    }

    /// Whether a point is inside.
    pub fn covers(&self, at: Vec2) -> bool {
        self.low.cmple(at).all() && at.cmple(self.high).all() && self.edges(at).iter().all(|value| *value > 0.0)
    }

    /// Which of the columns from `start` up to `end` are inside in the row at `y`: the first of them and one beyond the last.
    /// `place` says where a column lies; further right, it must not say less.
    pub fn columns(&self, y: f32, [mut start, mut end]: [i32; 2], place: impl Fn(i32) -> f32) -> [i32; 2] {
        if !(self.low.y..=self.high.y).contains(&y) {
            return [start, start];
        }
        start = first(start, end, |column| place(column) >= self.low.x);
        end = first(start, end, |column| place(column) > self.high.x);
        for i in 0..3 {
            let inside = |column| self.edge(i, Vec2::new(place(column), y)) > 0.0;
            let down = self.corners[(i + 1) % 3].y - self.corners[i].y;
            if self.sign * down > 0.0 {
                end = first(start, end, |column| !inside(column));
            } else {
                start = first(start, end, inside);
            }
        }
        [start, end]
    }
}

/// The line equation of `from -> to` at a point.
fn line(from: Vec2, to: Vec2, at: Vec2) -> f32 {
    (to.x - from.x) * (at.y - from.y) - (to.y - from.y) * (at.x - from.x)
}

/// The first number from `start` on for which `is` holds, as for all after it; `end` where there is none before.
pub fn first(start: i32, end: i32, is: impl Fn(i32) -> bool) -> i32 {
    let (mut low, mut high) = (start, end.max(start));
    while low < high {
        let middle = low + (high - low) / 2;
        if is(middle) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_those_that_the_edges_name_one_by_one() {
        arbtest::arbtest(|u| {
            let scale = *u.choose(&[1.0, 0.1, 1.0 / 3.0, 70.3])?;
            let mut point = || -> arbtest::arbitrary::Result<DVec2> {
                let mut at = || Ok(f64::from(u.int_in_range(-30..=90)?) / 2.0);
                Ok(DVec2::new(at()?, at()?) * scale)
            };
            let points = [point()?, point()?, point()?];
            let Some(triangle) = FloatTriangle::new(points) else {
                return Ok(());
            };
            let place = |at: i32| (at as f32 + 0.5) / 3.0;
            for row in 0..60 {
                let [start, end] = triangle.columns(place(row), [0, 90], place);
                for column in 0..90 {
                    assert_eq!(
                        (start..end).contains(&column),
                        triangle.covers(Vec2::new(place(column), place(row))),
                        "column {column} of row {row}: {points:?}"
                    );
                }
            }
            Ok(())
        })
        .budget_ms(300);
    }
}
