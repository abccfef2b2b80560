//! How thin a shape is at a place: what decides whether it can pass between samples.

use glam::DVec2;

use super::area::cut;

/// Directions in which a shape is measured, spread over half a turn.
const DIRECTIONS: u32 = 64;

/// The least width, in any direction, of what triangles and a window have in common; `None` where that is nothing.
///
/// The window is given by its least and its greatest corner. Only so many directions are tried: what is found is never less
/// than the width, and more by a few hundredths of the window's side at most.
pub fn width_in_window(triangles: impl Iterator<Item = [DVec2; 3]>, window: [DVec2; 2]) -> Option<f64> {
    let inside: Vec<DVec2> = triangles
        .filter(|corners| corners.iter().all(|corner| corner.is_finite()))
        .flat_map(|corners| cut(&corners, window))
        .collect();
    let extent = |direction: DVec2| {
        let along = inside.iter().map(|point| direction.dot(*point));
        let (least, most) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), at| {
            (least.min(at), most.max(at))
        });
        most - least
    };
    let directions = (0..DIRECTIONS).map(|i| std::f64::consts::PI * f64::from(i) / f64::from(DIRECTIONS));
    let least = directions
        .map(|angle| extent(DVec2::from_angle(angle)))
        .min_by(f64::total_cmp);
    least.filter(|_| !inside.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn width_is_that_of_the_thinnest_direction() {
        let at = |x: f64, y: f64| DVec2::new(x, y);
        let window = [at(-1.0, -1.0), at(2.0, 2.0)];
        let strip = |angle: f64| {
            let (along, across) = (DVec2::from_angle(angle), DVec2::from_angle(angle).perp() * 0.1);
            let (a, b) = (at(0.5, 0.5) - along * 1e4, at(0.5, 0.5) + along * 1e4);
            [
                [a - across, a + across, b + across],
                [a - across, b + across, b - across],
            ]
        };
        for angle in [0.0, 0.3, 0.785, 1.57, 2.9] {
            let width = width_in_window(strip(angle).into_iter(), window).expect("inside");
            assert!((0.2..0.32).contains(&width), "a strip 0.2 wide at {angle}: {width}");
        }
        let half = [at(0.5, -1e6), at(0.5, 1e6), at(1e6, 0.0)];
        let width = width_in_window([half].into_iter(), window).expect("inside");
        assert!((width - 1.5).abs() < 0.01, "the right half: {width}");
        let far = [at(5.0, 0.0), at(6.0, 0.0), at(5.0, 1.0)];
        assert_eq!(width_in_window([far].into_iter(), window), None, "beside it");
        let no = [at(f64::NAN, 0.0), at(6.0, 0.0), at(5.0, 1.0)];
        assert_eq!(width_in_window([no].into_iter(), window), None, "no triangle");
    }
}
