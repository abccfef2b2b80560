//! The outlines of SVG's basic shapes, in the shape's own coordinates.

use glam::DVec2;

use super::viewport::Frame;

/// Edges that stand for a quarter of a rounded corner: within 1/13000 of its radius.
const EDGES_PER_CORNER: u32 = 64;

/// A shape's line.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Outline {
    pub(super) points: Vec<DVec2>,
    /// Whether a stroke runs on from the last point to the first. The fill always does.
    pub(super) closed: bool,
}

/// A rect with corners of the radii `rounding`, already clamped to half its size.
pub(super) fn rect(frame: Frame, rounding: DVec2) -> Outline {
    let Frame { corner, size } = frame;
    let far = corner + size;
    let square = [corner, DVec2::new(far.x, corner.y), far, DVec2::new(corner.x, far.y)];
    let points = if rounding.min_element() <= 0.0 {
        square.to_vec()
    } else {
        let centers = [far, DVec2::new(corner.x, far.y), corner, DVec2::new(far.x, corner.y)];
        let inward = [DVec2::NEG_ONE, DVec2::new(1.0, -1.0), DVec2::ONE, DVec2::new(-1.0, 1.0)];
        let mut points: Vec<DVec2> = Vec::new();
        for (quarter, (corner, inward)) in (0_u32..).zip(centers.into_iter().zip(inward)) {
            for i in 0..=EDGES_PER_CORNER {
                let turn = f64::from(quarter * EDGES_PER_CORNER + i) / f64::from(4 * EDGES_PER_CORNER);
                let direction = DVec2::from_angle(turn * std::f64::consts::TAU);
                points.push(corner + rounding * (inward + direction));
            }
        }
        points
    };
    Outline { points, closed: true }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[DVec2]) -> f64 {
        let next = points.iter().cycle().skip(1);
        points.iter().zip(next).map(|(a, b)| a.perp_dot(*b) / 2.0).sum()
    }

    #[test]
    fn rect_with_round_corners() {
        let frame = Frame {
            corner: DVec2::new(1.0, 2.0),
            size: DVec2::new(10.0, 8.0),
        };
        assert_eq!(rect(frame, DVec2::ZERO).points.len(), 4, "sharp");
        let round = rect(frame, DVec2::new(2.0, 3.0));
        let missing = (4.0 - std::f64::consts::PI) * 2.0 * 3.0;
        assert!(
            (area(&round.points) - (80.0 - missing)).abs() < 1e-2,
            "{}",
            area(&round.points)
        );
        let ellipse = rect(frame, frame.size / 2.0);
        assert!(
            (area(&ellipse.points) - std::f64::consts::PI * 20.0).abs() < 1e-1,
            "an ellipse"
        );
        for point in ellipse.points.iter().chain(&round.points) {
            assert!(point.cmpge(frame.corner - 1e-9).all(), "{point} inside");
            assert!(point.cmple(frame.corner + frame.size + 1e-9).all(), "{point} inside");
        }
    }
}
