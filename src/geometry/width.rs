//! How thin a shape is at a place: what decides whether it can pass between samples.

use glam::DVec2;

use super::area::cut;

/// The least width, in any direction, of what triangles and a window have in common; `None` where that is nothing.
///
/// The window is given by its least and its greatest corner. A convex polygon is thinnest across one of its edges (Houle and
/// Toussaint, *Computing the Width of a Set*, 1988).
pub fn width_in_window(triangles: impl Iterator<Item = [DVec2; 3]>, window: [DVec2; 2]) -> Option<f64> {
    let inside: Vec<DVec2> = triangles
        .filter(|corners| corners.iter().all(|corner| corner.is_finite()))
        .flat_map(|corners| cut(&corners, window))
        .collect();
    if inside.is_empty() {
        return None;
    }
    let hull = convex_hull(inside);
    let edges = hull.iter().zip(hull.iter().cycle().skip(1));
    let across = edges.filter_map(|(a, b)| {
        let normal = (*b - *a).perp().try_normalize()?;
        let distances = hull.iter().map(|point| normal.dot(*point - *a).abs());
        Some(distances.fold(0.0, f64::max))
    });
    Some(across.min_by(f64::total_cmp).unwrap_or(0.0))
}

/// The corners of the convex hull of some points, in order around it: Andrew's monotone chain.
fn convex_hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let chain = |points: &mut dyn Iterator<Item = &DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(*point - b) <= 0.0
            {
                chain.pop();
            }
            chain.push(*point);
        }
        // The last point is the other chain's first.
        chain.pop();
        chain
    };
    let mut hull = chain(&mut points.iter());
    hull.extend(chain(&mut points.iter().rev()));
    hull
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
            assert!((width - 0.2).abs() < 1e-6, "a strip 0.2 wide at {angle}: {width}");
        }
        let half = [at(0.5, -1e6), at(0.5, 1e6), at(1e6, 0.0)];
        let width = width_in_window([half].into_iter(), window).expect("inside");
        assert!((width - 1.5).abs() < 1e-6, "the right half: {width}");
        let point = [at(0.5, 0.5); 3];
        let width = width_in_window([point].into_iter(), window).expect("inside");
        assert!(width.abs() < 1e-9, "a point: {width}");
        let far = [at(5.0, 0.0), at(6.0, 0.0), at(5.0, 1.0)];
        assert_eq!(width_in_window([far].into_iter(), window), None, "beside it");
        let no = [at(f64::NAN, 0.0), at(6.0, 0.0), at(5.0, 1.0)];
        assert_eq!(width_in_window([no].into_iter(), window), None, "no triangle");
    }
}
