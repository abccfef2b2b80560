//! The area that edges enclose in a pixel, for the oracle: between two heights at which anything happens, the length that is inside
//! changes evenly, so that the middle one times the height is the area.

#![expect(clippy::cast_precision_loss, reason = "small numbers")]

use rasterscope::geometry::FillRule;

/// Units of the grid along a side of a pixel that has one sample.
const UNITS: f64 = 16_384.0;

/// The part of a pixel that closed contours enclose, given by their edges in units of the grid.
pub(crate) fn in_pixel(edges: &[[(i128, i128); 2]], rule: FillRule, pixel: [i64; 2]) -> f64 {
    let place = |(x, y): (i128, i128)| [x as f64 / UNITS - pixel[0] as f64, y as f64 / UNITS - pixel[1] as f64];
    let edges: Vec<[[f64; 2]; 2]> = edges.iter().map(|ends| ends.map(place)).collect();
    let mut heights = vec![0.0, 1.0];
    for (i, edge) in edges.iter().enumerate() {
        heights.extend(edge.map(|end| end[1]));
        let sides = [0.0, 1.0].map(|x| crossing(*edge, [[x, -1.0], [x, 2.0]]));
        let others = edges[..i].iter().map(|other| crossing(*edge, *other));
        heights.extend(sides.into_iter().chain(others).flatten());
    }
    heights.retain(|y| (0.0..=1.0).contains(y));
    heights.sort_by(f64::total_cmp);
    let band = |pair: &[f64]| (pair[1] - pair[0]) * inside(&edges, rule, f64::midpoint(pair[0], pair[1]));
    heights.windows(2).map(band).sum()
}

/// The height at which two lines cross.
fn crossing([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> Option<f64> {
    let cross = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
    let from = |a: [f64; 2], b: [f64; 2]| [b[0] - a[0], b[1] - a[1]];
    let (own, other) = (from(a, b), from(c, d));
    let part = cross(from(a, c), other) / cross(own, other);
    part.is_finite().then(|| a[1] + part * own[1])
}

/// How much of the line at a height lies inside, from the pixel's left side to its right one.
fn inside(edges: &[[[f64; 2]; 2]], rule: FillRule, y: f64) -> f64 {
    let mut crossings: Vec<(f64, i32)> = Vec::new();
    for [from, to] in edges {
        if (from[1] <= y) != (to[1] <= y) {
            let x = from[0] + (to[0] - from[0]) * (y - from[1]) / (to[1] - from[1]);
            crossings.push((x.clamp(0.0, 1.0), if from[1] < to[1] { 1 } else { -1 }));
        }
    }
    crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut winding, mut last, mut length) = (0, 0.0, 0.0);
    for (x, around) in crossings {
        let is_inside = match rule {
            FillRule::NonZero => winding != 0,
            FillRule::EvenOdd => winding % 2 != 0,
        };
        length += if is_inside { x - last } else { 0.0 };
        (winding, last) = (winding + around, x);
    }
    length
}
