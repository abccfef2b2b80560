//! How thin a shape is at a place: what decides whether it can pass between samples.

use std::collections::{BTreeMap, HashMap};

use glam::DVec2;

use super::area::cut;

/// A shape that holds this part of the hull around it is as good as convex.
const CONVEX: f64 = 0.98;
/// Steps up a hill at most, and the directions that each is tried in.
const STEPS: usize = 24;
const DIRECTIONS: u32 = 16;
/// How far outside of a window [`width_of_part`] is told of a shape, in pixels: so much of a disc may lie there.
pub const BEYOND: f64 = 1.0;

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

/// The width of a part of the triangles of a polygon in a window, which is given by its least and its greatest corner: of the widest
/// part that touches the pixel in the middle of that, which has a margin of `around` on each side. The triangles are all of what lies
/// at most [`BEYOND`] outside of the window; `None` where there are none.
///
/// Parts hang together by corners. One that is convex is as wide as [`width_in_window`] says. Others, such as a curved strip, are less
/// wide than the hull around them: as wide as the widest disc in them whose middle lies in the window.
pub fn width_of_part(triangles: &[[DVec2; 3]], window: [DVec2; 2], around: f64) -> Option<f64> {
    let pixel = [window[0] + around, window[1] - around];
    let (mut touching, mut beside): (Option<f64>, Option<f64>) = (None, None);
    for part in parts(triangles) {
        let Some(width) = width_of(&part, window) else {
            continue;
        };
        let corners = || part.iter().flatten();
        let low = corners().fold(DVec2::INFINITY, |low, corner| low.min(*corner));
        let high = corners().fold(DVec2::NEG_INFINITY, |high, corner| high.max(*corner));
        let touches = low.cmplt(pixel[1]).all() && high.cmpgt(pixel[0]).all();
        let widest = if touches { &mut touching } else { &mut beside };
        *widest = Some(widest.map_or(width, |widest| widest.max(width)));
    }
    touching.or(beside)
}

/// A corner as it can be looked up.
fn key(corner: DVec2) -> [u64; 2] {
    [corner.x.to_bits(), corner.y.to_bits()]
}

/// Triangles that hang together by corners.
fn parts(triangles: &[[DVec2; 3]]) -> Vec<Vec<[DVec2; 3]>> {
    fn root(parents: &mut [usize], mut at: usize) -> usize {
        while parents[at] != at {
            parents[at] = parents[parents[at]];
            at = parents[at];
        }
        at
    }
    let mut parents: Vec<usize> = (0..triangles.len()).collect();
    let mut first_with = HashMap::new();
    for (at, corner) in triangles
        .iter()
        .enumerate()
        .flat_map(|(at, corners)| corners.map(|corner| (at, corner)))
    {
        let first = *first_with.entry(key(corner)).or_insert(at);
        let [a, b] = [first, at].map(|at| root(&mut parents, at));
        parents[b] = a;
    }
    // In an order that is the same whenever somebody asks.
    let mut parts: BTreeMap<usize, Vec<[DVec2; 3]>> = BTreeMap::new();
    for (at, triangle) in triangles.iter().enumerate() {
        parts.entry(root(&mut parents, at)).or_default().push(*triangle);
    }
    parts.into_values().collect()
}

/// How wide a part is that hangs together.
fn width_of(part: &[[DVec2; 3]], window: [DVec2; 2]) -> Option<f64> {
    let across = width_in_window(part.iter().copied(), window)?;
    let area: f64 = part
        .iter()
        .map(|[a, b, c]| (*b - *a).perp_dot(*c - *a).abs() / 2.0)
        .sum();
    let hull = convex_hull(part.as_flattened().to_vec());
    let fan = hull
        .windows(2)
        .map(|edge| (edge[0] - hull[0]).perp_dot(edge[1] - hull[0]));
    let of_hull = fan.sum::<f64>().abs() / 2.0;
    if area >= of_hull * CONVEX {
        return Some(across);
    }
    let disc = Inside::new(part, window).widest();
    Some(disc.map_or(across, |disc| across.min(disc)))
}

/// A part in a window, as discs that lie in it see it.
struct Inside {
    window: [DVec2; 2],
    /// The edges of its border, but for those where it was cut and may go on.
    border: Vec<[DVec2; 2]>,
    /// Places inside: in the middle of triangles, and of the edges between them.
    middles: Vec<DVec2>,
}

impl Inside {
    /// Of triangles that share whole edges.
    fn new(part: &[[DVec2; 3]], window: [DVec2; 2]) -> Self {
        /// Corners on the window's border are rounded.
        const ON_BORDER: f64 = 1e-6;
        let [low, high] = [window[0] - BEYOND, window[1] + BEYOND];
        // Of places that are as far from the border the first ones count: in an order that is the same whenever somebody asks.
        let mut edges = BTreeMap::new();
        for [a, b, c] in part {
            for (from, to) in [(*a, *b), (*b, *c), (*c, *a)] {
                let mut ends = [key(from), key(to)];
                ends.sort_unstable();
                edges.entry(ends).or_insert(([from, to], 0)).1 += 1;
            }
        }
        let is_on = |line: f64, ends: [f64; 2]| ends.into_iter().all(|end| (end - line).abs() < ON_BORDER);
        let is_cut = |[from, to]: [DVec2; 2]| {
            let (across, down) = ([from.x, to.x], [from.y, to.y]);
            is_on(low.x, across) || is_on(high.x, across) || is_on(low.y, down) || is_on(high.y, down)
        };
        let is_inside = |at: &DVec2| at.cmpge(window[0]).all() && at.cmple(window[1]).all();
        let mut middles: Vec<DVec2> = part.iter().map(|[a, b, c]| (*a + *b + *c) / 3.0).collect();
        let mut border = Vec::new();
        for ([from, to], count) in edges.into_values() {
            if count % 2 == 0 {
                middles.push(from.midpoint(to));
            } else if !is_cut([from, to]) {
                border.push([from, to]);
            }
        }
        middles.retain(is_inside);
        Self {
            window,
            border,
            middles,
        }
    }

    /// How far a place is from the border.
    fn distance(&self, at: DVec2) -> f64 {
        distance_from(&self.border, at)
    }

    /// The diameter of the widest disc that is found in it, from the middles that are farthest from the border up the hill; `None` where
    /// none of these lies in the window.
    fn widest(&self) -> Option<f64> {
        /// Edges that are looked at for the first distances, and again for the hills that are climbed; and these hills.
        const MOST_MEASURED: usize = 500_000;
        const CLIMBED: usize = 8;
        let climbed = MOST_MEASURED / (STEPS * DIRECTIONS as usize * self.border.len()).max(1);
        let each = (self.middles.len() * self.border.len()).div_ceil(MOST_MEASURED).max(1);
        let middles = self.middles.iter().step_by(each);
        let mut starts: Vec<(f64, DVec2)> = middles.map(|at| (self.distance(*at), *at)).collect();
        starts.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        starts.truncate(climbed.clamp(1, CLIMBED));
        let widest = starts
            .into_iter()
            .map(|start| self.climbed(start))
            .max_by(f64::total_cmp);
        widest.map(|radius| 2.0 * radius)
    }

    /// How far from the border a place is that is reached from another by steps that lead away from it. A step is shorter than the
    /// distance, so that it does not leave the part.
    fn climbed(&self, (mut radius, mut at): (f64, DVec2)) -> f64 {
        let mut step = 0.5;
        let mut border = self.border_near(at, radius);
        for _ in 0..STEPS {
            let around = (0..DIRECTIONS)
                .map(|i| DVec2::from_angle(f64::from(i) * std::f64::consts::TAU / f64::from(DIRECTIONS)));
            let near = around.map(|toward| at + toward * radius * step);
            let inside = near.filter(|at| at.cmpge(self.window[0]).all() && at.cmple(self.window[1]).all());
            let best = inside
                .map(|at| (distance_from(&border, at), at))
                .max_by(|a, b| a.0.total_cmp(&b.0));
            match best {
                Some((distance, place)) if distance > radius * 1.001 => {
                    (radius, at) = (distance, place);
                    border = self.border_near(at, radius);
                }
                _ if step > 0.01 => step /= 2.0,
                _ => break,
            }
        }
        radius
    }

    /// The edges of the border one of which is the nearest to any place within a step of `at`, which has this distance from the border:
    /// a step is at most half as long, and the place then not farther from the border than by that more.
    fn border_near(&self, at: DVec2, radius: f64) -> Vec<[DVec2; 2]> {
        let near = (2.1 * radius).powi(2);
        let is_near = |edge: &&[DVec2; 2]| distance_squared(edge, at) <= near;
        self.border.iter().filter(is_near).copied().collect()
    }
}

/// How far a place is from the nearest of some edges.
fn distance_from(edges: &[[DVec2; 2]], at: DVec2) -> f64 {
    let squares = edges.iter().map(|edge| distance_squared(edge, at));
    squares.fold(f64::INFINITY, f64::min).sqrt()
}

/// The square of how far a place is from an edge.
fn distance_squared([from, to]: &[DVec2; 2], at: DVec2) -> f64 {
    let (along, beside) = (*to - *from, at - *from);
    let part = (beside.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    beside.distance_squared(along * part)
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
    use super::super::{FillRule, cut_to_window};
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

    /// The width of what a polygon of these contours has in a window.
    fn width_of_contours(contours: Vec<Vec<DVec2>>, window: [DVec2; 2], around: f64) -> Option<f64> {
        let contours = contours.into_iter().map(Vec::into_iter);
        let around_it = [window[0] - BEYOND, window[1] + BEYOND];
        let inside = cut_to_window(contours, FillRule::NonZero, around_it);
        width_of_part(inside.triangles().expect("few edges"), window, around)
    }

    #[test]
    fn a_curved_strip_is_as_wide_as_it_was_drawn() {
        let mut tried = 0;
        arbtest::arbtest(|u| {
            let unit = |u: &mut arbtest::arbitrary::Unstructured<'_>| Ok(f64::from(u.arbitrary::<u16>()?) / 65535.0);
            let (radius, width) = (1.0 + 8.0 * unit(u)?, 0.05 + 0.3 * unit(u)?);
            let corner = DVec2::new(20.0, 20.0);
            let toward = DVec2::from_angle(unit(u)? * std::f64::consts::TAU);
            let middle = corner + 0.5 - toward * radius;
            // A whole circle, or half of one, whose end may lie in the window.
            let (first, last) = if u.arbitrary()? { (0, 256) } else { (0, 128) };
            let turn = unit(u)? * std::f64::consts::TAU;
            let ring = |radius: f64| {
                (first..=last).map(move |i| {
                    middle + DVec2::from_angle(turn + f64::from(i) * std::f64::consts::TAU / 256.0) * radius
                })
            };
            let contour: Vec<DVec2> = ring(radius - width / 2.0)
                .chain(ring(radius + width / 2.0).rev())
                .collect();
            let around = 1.0 + unit(u)?;
            let window = [corner - around, corner + 1.0 + around];
            if let Some(found) = width_of_contours(vec![contour], window, around) {
                tried += 1;
                // Only a bit of it, or an end, may lie in the window.
                assert!(
                    found < width * 1.1,
                    "{found} for {width}, radius {radius}, turned by {turn}"
                );
                if last == 256 {
                    assert!(found > width * 0.85, "{found} for {width}, radius {radius}");
                }
            }
            Ok(())
        })
        .budget_ms(300);
        assert!(tried > 20, "{tried} were inside");
    }

    /// Places that are as far from the border, and so whichever comes first is climbed from, must not be taken by chance.
    #[test]
    fn a_comb_has_one_width_however_often_it_is_asked() {
        let mut comb = vec![DVec2::new(0.0, 2.0)];
        for i in 0..12 {
            let x = f64::from(i) * 0.25;
            comb.extend([(x, 0.1), (x + 0.11, 0.1), (x + 0.11, 1.7), (x + 0.25, 1.7)].map(|(x, y)| DVec2::new(x, y)));
        }
        comb.push(DVec2::new(3.0, 2.0));
        let window = [DVec2::new(0.5, 0.5), DVec2::new(2.5, 2.5)];
        let width = || width_of_contours(vec![comb.clone()], window, 0.5);
        let first = width();
        assert!(first.is_some(), "in the window");
        for again in 0..20 {
            assert_eq!(width(), first, "time {again}");
        }
    }

    #[test]
    fn the_part_in_the_pixel_counts() {
        let at = |x: f64, y: f64| DVec2::new(x, y);
        let bar = |left: f64, right: f64| vec![at(left, -9.0), at(right, -9.0), at(right, 9.0), at(left, 9.0)];
        let window = [at(-2.0, -2.0), at(3.0, 3.0)];
        let width = width_of_contours(vec![bar(0.4, 0.5), bar(1.2, 2.2)], window, 2.0).expect("inside");
        assert!((width - 0.1).abs() < 1e-6, "the thin one: {width}");
        let width = width_of_contours(vec![bar(1.2, 2.2)], window, 2.0).expect("beside");
        assert!((width - 1.0).abs() < 1e-6, "nothing is nearer: {width}");
        let joined = vec![
            at(0.0, -9.0),
            at(0.2, -9.0),
            at(0.2, 0.3),
            at(9.0, 0.3),
            at(9.0, 0.5),
            at(0.0, 0.5),
        ];
        let width = width_of_contours(vec![joined], window, 2.0).expect("inside");
        assert!(
            (0.2..0.24).contains(&width),
            "around a corner, where a disc has some more room: {width}"
        );
        // A star of needles is thick in its middle.
        let star = (0..48).map(|i| {
            let reach = if i % 2 == 0 { 4.0 } else { 0.7 };
            at(0.5, 0.5) + DVec2::from_angle(f64::from(i) * std::f64::consts::TAU / 48.0) * reach
        });
        let width = width_of_contours(vec![star.collect()], window, 2.0).expect("inside");
        assert!((1.3..1.45).contains(&width), "the middle of a star: {width}");
    }
}
