//! The parts of a scene that threads transform side by side.

use std::ops::Range;

use rayon::prelude::*;

use crate::raster::Chunk;
use crate::scene::{Primitive, PrimitiveKind, Scene};

/// Fewest points that are worth another thread.
const MIN_POINTS: usize = 192;

/// Most primitives of a part, and fewest of one of a large scene.
const MAX_PRIMITIVES: usize = 65_536;
const LARGE: usize = 1024;

/// Parts into which a large scene is cut; a small one into as many as there are threads, since tiles have to look at all
/// of them.
const PARTS: usize = 64;

/// What `make` makes of each part of a scene, in painter's order: of the number of its first primitive and its primitives.
pub(super) fn chunks(scene: &Scene, make: impl Fn(usize, &[Primitive]) -> Chunk + Sync) -> Vec<Chunk> {
    let parts = parts(&scene.primitives, rayon::current_num_threads());
    let make = |part: Range<usize>| make(part.start, &scene.primitives[part]);
    parts.into_par_iter().map(make).collect()
}

/// Cuts primitives into parts for several threads: those of a small scene have about as many points each, those of a large
/// one as many primitives.
fn parts(primitives: &[Primitive], threads: usize) -> Vec<Range<usize>> {
    let count = primitives.len();
    if count > LARGE * threads {
        let length = (count / PARTS).clamp(LARGE, MAX_PRIMITIVES);
        return (0..count)
            .step_by(length)
            .map(|start| start..count.min(start + length))
            .collect();
    }
    let points = |primitive: &Primitive| match &primitive.kind {
        PrimitiveKind::Triangle { points, .. } => points.len(),
        PrimitiveKind::Polygon { polygon, .. } => polygon.points().len(),
        _ => 1,
    };
    let all: usize = primitives.iter().map(points).sum();
    let most = all.div_ceil(threads).max(MIN_POINTS);
    let (mut parts, mut start, mut held) = (Vec::with_capacity(threads), 0, 0);
    for (i, primitive) in primitives.iter().enumerate() {
        held += points(primitive);
        if held >= most {
            parts.push(start..i + 1);
            (start, held) = (i + 1, 0);
        }
    }
    if start < count {
        parts.push(start..count);
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{DialectChoice, NoResources, ReadOptions, read};

    /// A scene of polygons with so many corners each.
    fn scene(corners: impl Iterator<Item = usize>) -> Scene {
        let polygon = |count: usize| format!("<polygon points='{}'/>", "1,2 7,3 5,8 ".repeat(count.div_ceil(3)));
        let polygons = corners.map(polygon).collect::<Vec<_>>().concat();
        let document = format!("<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'>{polygons}</svg>");
        let options = ReadOptions {
            dialect: DialectChoice::Svg,
        };
        read(document.as_bytes(), "polygons", options, &NoResources).expect("a good document")
    }

    fn points(primitives: &[Primitive]) -> usize {
        let of = |primitive: &Primitive| match &primitive.kind {
            PrimitiveKind::Polygon { polygon, .. } => polygon.points().len(),
            PrimitiveKind::Triangle { points, .. } => points.len(),
            _ => 0,
        };
        primitives.iter().map(of).sum()
    }

    #[test]
    fn parts_hold_each_primitive_once_and_small_scenes_as_many_points_in_each() {
        let small = scene((0..90).map(|i| if i < 80 { 3 } else { 240 }));
        let few = scene([30].into_iter());
        let large = scene((0..5000).map(|_| 6));
        for threads in 1..=4 {
            for scene in [&small, &few, &large] {
                let parts = parts(&scene.primitives, threads);
                let all: Vec<usize> = parts.iter().cloned().flatten().collect();
                assert_eq!(
                    all,
                    (0..scene.primitives.len()).collect::<Vec<_>>(),
                    "each once, in order"
                );
            }
            let parts_of_small = parts(&small.primitives, threads);
            assert_eq!(parts_of_small.len(), threads, "one for each thread");
            let share = points(&small.primitives) / threads;
            for part in parts_of_small {
                let held = points(&small.primitives[part]);
                assert!(
                    held.abs_diff(share) <= 240 * threads,
                    "{held} points of {share} by {threads}"
                );
            }
            assert_eq!(
                parts(&few.primitives, threads).len(),
                1,
                "nobody is woken up for so little"
            );
        }
    }
}
