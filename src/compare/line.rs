//! The pixels along a straight line, in order: what a profile is read from.
//!
//! One pixel for each step along the longer axis, the nearest to the line (J. Bresenham, "Algorithm for computer control of
//! a digital plotter", 1965), and nothing between pixels: whoever counts shades counts those that the picture has.

use crate::raster::Region;

/// Pixels of a line that one region holds: a slanted line goes through little of the box around all of it.
const PIECE: usize = 16;
/// Farther away than any frame reaches: coordinates beyond count as this far.
const FAR: i64 = 1 << 40;

/// A line from the middle of one pixel to the middle of another; either may lie outside of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Line {
    /// Columns and rows of its ends, in order.
    pub ends: [[i64; 2]; 2],
}

/// A pixel on a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinePoint {
    /// Column and row.
    pub at: [u32; 2],
    /// How far along the line it lies, in pixels from the middle of the first end.
    pub distance: f64,
}

impl Line {
    /// Its pixels in a frame of `size`, in order; as many as a side of the frame has at most. Backwards the same line has
    /// the same pixels.
    pub fn points(self, size: [u32; 2]) -> Vec<LinePoint> {
        let [from, to] = self.ends.map(|end| end.map(|at| at.clamp(-FAR, FAR)));
        let steps = [to[0] - from[0], to[1] - from[1]];
        let long = usize::from(steps[1].abs() > steps[0].abs());
        let short = 1 - long;
        let count = steps[long].abs();
        let step = (steps[0] as f64).hypot(steps[1] as f64) / count.max(1) as f64;
        // Only what lies in the frame along the longer axis is walked through, however long the line is.
        let last = i64::from(size[long]) - 1;
        let (first, end) = if steps[long] < 0 {
            (from[long] - last, from[long])
        } else {
            (-from[long], last - from[long])
        };
        let walk = first.max(0)..=end.min(count);
        let points = walk.filter_map(|i| {
            let mut at = from;
            at[long] += i * steps[long].signum();
            at[short] += nearest(i, steps[short], count);
            let [x, y] = at.map(|at| u32::try_from(at).ok());
            let at = [x?, y?];
            (at[0] < size[0] && at[1] < size[1]).then_some(LinePoint {
                at,
                distance: i as f64 * step,
            })
        });
        points.collect()
    }

    /// Small boxes that together hold its pixels in a frame of `size`: what is to be drawn for them.
    pub fn regions(self, size: [u32; 2]) -> Vec<Region> {
        let points = self.points(size);
        let region = |piece: &[LinePoint]| {
            let ends = |axis: usize| {
                let along = || piece.iter().map(|point| point.at[axis]);
                let (low, high) = (along().min().unwrap_or(0), along().max().unwrap_or(0));
                (low, high - low + 1)
            };
            let ((x, width), (y, height)) = (ends(0), ends(1));
            Region { x, y, width, height }
        };
        points.chunks(PIECE).map(region).collect()
    }
}

/// `i * step / count` to the nearest whole number, halves upwards; 0 where `count` is.
fn nearest(i: i64, step: i64, count: i64) -> i64 {
    let [i, step, count] = [i, step, count.max(1)].map(i128::from);
    i64::try_from((2 * i * step + count).div_euclid(2 * count)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(ends: [[i64; 2]; 2], size: [u32; 2]) -> Vec<[u32; 2]> {
        Line { ends }.points(size).iter().map(|point| point.at).collect()
    }

    #[test]
    fn line_visits_one_pixel_for_each_step_of_its_longer_axis() {
        let level = [[2, 1], [3, 1], [4, 1]];
        assert_eq!(places([[2, 1], [4, 1]], [9, 9]), level, "level");
        let slanted = [[0, 0], [1, 0], [2, 1], [3, 1], [4, 2], [5, 2]];
        assert_eq!(places([[0, 0], [5, 2]], [9, 9]), slanted, "0, 0.4, 0.8, 1.2, 1.6, 2");
        let steep = [[3, 0], [2, 1], [2, 2], [1, 3]];
        assert_eq!(places([[3, 0], [1, 3]], [9, 9]), steep, "3, 2.33, 1.67, 1");
        assert_eq!(places([[4, 4], [4, 4]], [9, 9]), [[4, 4]], "a single pixel");
    }

    #[test]
    fn line_measures_along_itself() {
        let line = Line { ends: [[0, 0], [3, 4]] };
        let distances: Vec<f64> = line.points([9, 9]).iter().map(|point| point.distance).collect();
        for (found, expected) in distances.iter().zip([0.0, 1.25, 2.5, 3.75, 5.0]) {
            assert!((found - expected).abs() < 1e-12, "{distances:?}");
        }
    }

    #[test]
    fn line_is_cut_at_the_frame_and_keeps_its_distances() {
        let line = Line {
            ends: [[-3, 2], [20, 2]],
        };
        let points = line.points([5, 4]);
        let found: Vec<[u32; 2]> = points.iter().map(|point| point.at).collect();
        assert_eq!(found, [[0, 2], [1, 2], [2, 2], [3, 2], [4, 2]], "what the frame has");
        assert!((points[0].distance - 3.0).abs() < 1e-12, "from the end outside");
        assert_eq!(places([[-3, 7], [20, 7]], [5, 4]), [[0_u32; 2]; 0], "beside the frame");
        assert_eq!(places([[0, 0], [4, 0]], [0, 0]), [[0_u32; 2]; 0], "no frame");
    }

    #[test]
    fn regions_hold_the_line_and_little_else() {
        let (ends, size) = ([[3, 2], [90, 61]], [100, 70]);
        let line = Line { ends };
        let regions = line.regions(size);
        let inside = |[x, y]: [u32; 2]| {
            let holds =
                |region: &Region| (region.x..region.right()).contains(&x) && (region.y..region.bottom()).contains(&y);
            regions.iter().any(holds)
        };
        assert!(line.points(size).iter().all(|point| inside(point.at)), "{regions:?}");
        let area: u32 = regions.iter().map(|region| region.width * region.height).sum();
        assert!(area < 88 * 16, "{area} pixels for 88");
    }

    #[test]
    fn line_takes_any_ends() {
        arbtest::arbtest(|u| {
            let mut end = || {
                let odd = [i64::MIN, i64::MAX, -1, 0, 1, 1 << 33];
                let at = if u.ratio(1, 3)? {
                    *u.choose(&odd)?
                } else {
                    u.int_in_range(-40..=80)?
                };
                Ok::<_, arbtest::arbitrary::Error>(at)
            };
            let ends = [[end()?, end()?], [end()?, end()?]];
            let size = [u.int_in_range(0..=40)?, u.int_in_range(0..=40)?];
            let found = places(ends, size);
            assert!(found.len() <= size[0].max(size[1]) as usize, "{ends:?} in {size:?}");
            let mut back = places([ends[1], ends[0]], size);
            back.reverse();
            assert_eq!(found, back, "{ends:?} backwards");
            for pair in found.windows(2) {
                let apart = [0, 1].map(|axis| pair[0][axis].abs_diff(pair[1][axis]));
                assert!(apart[0].max(apart[1]) == 1, "{ends:?}: {pair:?} are neighbours");
            }
            Ok(())
        });
    }
}
