//! Clipping triangles and edges to the guard band, so that finite geometry of any size becomes grid coordinates.
//!
//! Sutherland and Hodgman, "Reentrant polygon clipping" (CACM 17, 1974). A cut point depends only on the edge it cuts,
//! never on its direction, so two triangles that share an edge still share it after clipping.

use glam::DVec2;

use super::subpixel::GUARD;

/// A corner of a clipped triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipVertex {
    /// Screen position.
    pub point: DVec2,
    /// Barycentric weights with respect to the unclipped triangle.
    pub weights: [f64; 3],
}

/// A convex polygon: a triangle cut by four lines.
#[derive(Clone, Copy, Debug)]
pub struct ClippedTriangle {
    corners: [ClipVertex; MOST_CORNERS],
    count: usize,
}

/// Room for corners: seven when arithmetic is exact, since each of four lines adds one at most; rounding may make a
/// polygon a little concave, so that a line crosses it more than twice.
const MOST_CORNERS: usize = 12;

/// A line that bounds the guard band: points with `sign * (coordinate - bound) >= 0` are kept.
#[derive(Clone, Copy)]
struct Bound {
    vertical: bool,
    sign: f64,
    at: f64,
}

const BOUNDS: [Bound; 4] = [
    Bound {
        vertical: true,
        sign: 1.0,
        at: GUARD.0,
    },
    Bound {
        vertical: true,
        sign: -1.0,
        at: GUARD.1,
    },
    Bound {
        vertical: false,
        sign: 1.0,
        at: GUARD.0,
    },
    Bound {
        vertical: false,
        sign: -1.0,
        at: GUARD.1,
    },
];

/// Whether a point lies in the guard band.
#[inline]
pub fn in_guard(point: DVec2) -> bool {
    point.cmpge(DVec2::splat(GUARD.0)).all() && point.cmple(DVec2::splat(GUARD.1)).all()
}

impl ClippedTriangle {
    /// The part of a triangle inside the guard band; empty where there is none.
    pub fn new(points: [DVec2; 3]) -> Self {
        let mut polygon = Self::EMPTY;
        for (i, point) in points.into_iter().enumerate() {
            let mut weights = [0.0; 3];
            weights[i] = 1.0;
            polygon.push(ClipVertex { point, weights });
        }
        for bound in BOUNDS {
            polygon = bound.clip(polygon.corners());
        }
        polygon
    }

    const EMPTY: Self = Self {
        corners: [ClipVertex {
            point: DVec2::ZERO,
            weights: [0.0; 3],
        }; MOST_CORNERS],
        count: 0,
    };

    fn corners(&self) -> &[ClipVertex] {
        &self.corners[..self.count]
    }

    /// Adds a corner, where there is room.
    fn push(&mut self, corner: ClipVertex) {
        if self.count < MOST_CORNERS {
            self.corners[self.count] = corner;
            self.count += 1;
        }
    }

    /// The triangles of a fan around the first corner.
    pub fn triangles(&self) -> impl Iterator<Item = [ClipVertex; 3]> + '_ {
        let corners = self.corners();
        (2..corners.len()).map(move |i| [corners[0], corners[i - 1], corners[i]])
    }
}

impl Bound {
    fn coordinate(self, point: DVec2) -> f64 {
        if self.vertical { point.x } else { point.y }
    }

    fn keeps(self, vertex: &ClipVertex) -> bool {
        self.sign * (self.coordinate(vertex.point) - self.at) >= 0.0
    }

    fn clip(self, polygon: &[ClipVertex]) -> ClippedTriangle {
        let mut kept = ClippedTriangle::EMPTY;
        for (i, vertex) in polygon.iter().enumerate() {
            let next = &polygon[(i + 1) % polygon.len()];
            if self.keeps(vertex) {
                kept.push(*vertex);
            }
            if self.keeps(vertex) != self.keeps(next) {
                kept.push(self.cut(vertex, next));
            }
        }
        kept
    }

    /// Where the edge crosses the bound; the same for both directions of the edge.
    fn cut(self, a: &ClipVertex, b: &ClipVertex) -> ClipVertex {
        // From the nearer end: from 1e30 away, what is near would drown in rounding.
        let rank = |v: &ClipVertex| {
            (
                (self.coordinate(v.point) / 2.0 - self.at / 2.0).abs(),
                v.point.x,
                v.point.y,
            )
        };
        let swap = rank(b) < rank(a);
        let (a, b) = if swap { (b, a) } else { (a, b) };
        let (from, to) = (self.coordinate(a.point), self.coordinate(b.point));
        // Halved, so that the difference of two huge coordinates stays finite.
        let t = ((self.at / 2.0 - from / 2.0) / (to / 2.0 - from / 2.0)).clamp(0.0, 1.0);
        let mix = |p: f64, q: f64| p * (1.0 - t) + q * t;
        let mut point = DVec2::new(mix(a.point.x, b.point.x), mix(a.point.y, b.point.y));
        if self.vertical {
            point.x = self.at;
        } else {
            point.y = self.at;
        }
        ClipVertex {
            point,
            weights: std::array::from_fn(|i| mix(a.weights[i], b.weights[i])),
        }
    }
}

/// What of a polygon's edge decides which points inside the guard band the polygon encloses, in the edge's direction.
///
/// What lies left of the band still winds around points inside: it comes back upright on the band's left side. What lies
/// above, below or to the right winds around none. Cut points are those of triangles with the same edge.
pub fn clip_edge(ends: [DVec2; 2]) -> impl Iterator<Item = [DVec2; 2]> {
    let [left, right, top, bottom] = BOUNDS;
    let upright = |ends: [DVec2; 2]| ends.map(|end| DVec2::new(left.at, end.y));
    let (inner, outer) = left.cut_edge(ends);
    let inner = inner.and_then(|ends| right.cut_edge(ends).0);
    let parts = if outer.is_some_and(|outer| outer[0] == ends[0]) {
        [outer.map(upright), inner]
    } else {
        [inner, outer.map(upright)]
    };
    let between = move |part| bottom.cut_edge(top.cut_edge(part).0?).0;
    parts.into_iter().flatten().filter_map(between)
}

impl Bound {
    /// The parts of an edge that are kept and that are not.
    fn cut_edge(self, ends: [DVec2; 2]) -> (Option<[DVec2; 2]>, Option<[DVec2; 2]>) {
        let weights = [0.0; 3];
        let [a, b] = ends.map(|point| ClipVertex { point, weights });
        match (self.keeps(&a), self.keeps(&b)) {
            (true, true) => (Some(ends), None),
            (false, false) => (None, Some(ends)),
            (keeps_first, _) => {
                let at = self.cut(&a, &b).point;
                let (first, second) = ([ends[0], at], [at, ends[1]]);
                if keeps_first {
                    (Some(first), Some(second))
                } else {
                    (Some(second), Some(first))
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clip_edge_keeps_what_winds_around_the_band() {
        let (low, high) = GUARD;
        let parts = |a: [f64; 2], b: [f64; 2]| -> Vec<[DVec2; 2]> { clip_edge([a.into(), b.into()]).collect() };
        let inside = [[0.0, 5.0], [70.0, -3.0]];
        assert_eq!(parts(inside[0], inside[1]), [inside.map(DVec2::from)], "untouched");
        assert_eq!(parts([1e6, 0.0], [1e6, 9.0]), [[DVec2::ZERO; 2]; 0], "to the right");
        assert_eq!(parts([0.0, -1e6], [9.0, -1e6]), [[DVec2::ZERO; 2]; 0], "above");
        let upright = [DVec2::new(low, high), DVec2::new(low, 7.0)];
        assert_eq!(parts([-1e6, 1e9], [-1e30, 7.0]), [upright], "to the left");
        let around = parts([-1e6, 0.0], [1e6, 2e3]);
        let [[a, b], [c, d]] = around[..] else {
            panic!("two parts, not {around:?}");
        };
        assert_eq!(
            (a, b.x, b),
            (DVec2::new(low, 0.0), low, c),
            "first upright, then along the edge"
        );
        assert!((d.x - high).abs() < 1e-6 && d.y > c.y, "up to the right side: {d}");
        let back = parts([1e6, 2e3], [-1e6, 0.0]);
        assert_eq!(back, [[d, c], [b, a]], "the same parts backwards");
    }

    #[test]
    fn clip_keeps_the_near_corner_of_a_far_triangle() {
        let near = DVec2::new(500.0, 610.0);
        for way in [
            DVec2::new(-1e30, -3e29),
            DVec2::new(1e30, -3e29),
            DVec2::new(-3e29, 1e30),
        ] {
            let clipped = ClippedTriangle::new([near, way, way + way.perp() * 0.1]);
            let corners: Vec<DVec2> = clipped.triangles().flatten().map(|corner| corner.point).collect();
            assert!(corners.contains(&near), "{way}: the near corner stays");
            // On a straight line from the near corner, every cut point has the direction of the far one.
            let straight = corners.iter().any(|&corner| {
                let along = (corner - near).normalize_or_zero();
                along != DVec2::ZERO && along.distance(way.normalize()) < 1e-9
            });
            assert!(straight, "{way}: the edge keeps its direction, {corners:?}");
        }
    }

    #[test]
    fn clip_leaves_inner_triangles_alone() {
        let points = [DVec2::ZERO, DVec2::new(10.0, 0.0), DVec2::new(0.0, 10.0)];
        let clipped = ClippedTriangle::new(points);
        let triangles: Vec<_> = clipped.triangles().collect();
        assert_eq!(triangles.len(), 1, "nothing to cut");
        assert_eq!(triangles[0].map(|corner| corner.point), points, "corners untouched");
    }

    #[test]
    fn clip_keeps_huge_triangles_inside_the_guard() {
        for size in [1e5, 1e30, 1e300, f64::MAX / 4.0] {
            let clipped =
                ClippedTriangle::new([DVec2::new(-size, -size), DVec2::new(size, -size), DVec2::new(0.0, size)]);
            let mut seen = 0;
            for corner in clipped.triangles().flatten() {
                assert!(in_guard(corner.point), "{corner:?} of size {size}");
                let sum: f64 = corner.weights.iter().sum();
                assert!((sum - 1.0).abs() < 1e-9, "weights sum to one: {corner:?}");
                seen += 1;
            }
            assert!(seen >= 3, "something of size {size} is left");
        }
    }

    #[test]
    fn clip_drops_what_lies_outside() {
        let far = DVec2::splat(1e6);
        let clipped = ClippedTriangle::new([far, far + DVec2::X, far + DVec2::Y]);
        assert_eq!(clipped.triangles().count(), 0, "nothing inside");
    }

    #[test]
    fn clip_cuts_a_shared_edge_alike_from_both_sides() {
        let (a, b) = (DVec2::new(-3e5, 17.0), DVec2::new(7e5, 911.0));
        let points = |c: DVec2| -> Vec<DVec2> {
            ClippedTriangle::new([a, b, c])
                .triangles()
                .flatten()
                .map(|corner| corner.point)
                .collect()
        };
        let mirrored: Vec<DVec2> = ClippedTriangle::new([b, a, DVec2::new(0.0, -2e5)])
            .triangles()
            .flatten()
            .map(|corner| corner.point)
            .collect();
        let on_edge = points(DVec2::new(0.0, 2e5))
            .iter()
            .filter(|point| mirrored.contains(point))
            .count();
        assert!(on_edge >= 2, "both triangles keep the same two ends of the cut edge");
    }
}
