//! Morphological antialiasing again, pixel by pixel from its definition: no tables, no rows, all in floating point. Areas are
//! summed up column by column.

use rasterscope::color::{ResolveSpace, encoded, srgb_to_linear};

/// Columns that a pixel is cut into for areas.
const COLUMNS: i32 = 512;

/// A picture of `size` pixels, straight `[r, g, b, a]`.
pub(crate) struct Picture {
    pub(crate) size: [i32; 2],
    pub(crate) pixels: Vec<[u8; 4]>,
}

impl Picture {
    /// What may become of the pixel at a place: two colours where its row and its column weigh the same but for rounding.
    pub(crate) fn smoothed(&self, x: i32, y: i32, space: ResolveSpace) -> Vec<[f64; 4]> {
        const ROUNDING: f64 = 1e-3;
        let (own, right, below) = (self.weights(x, y), self.weights(x + 1, y), self.weights(x, y + 1));
        let across = [(own[1][0], [x - 1, y]), (right[1][1], [x + 1, y])];
        let down = [(own[0][0], [x, y - 1]), (below[0][1], [x, y + 1])];
        let most = |weights: &[(f64, [i32; 2]); 2]| weights[0].0.max(weights[1].0);
        let difference = most(&across) - most(&down);
        let mut found = Vec::new();
        if difference > -ROUNDING {
            found.push(self.mixed([x, y], across, space));
        }
        if difference < ROUNDING {
            found.push(self.mixed([x, y], down, space));
        }
        found
    }

    fn mixed(&self, [x, y]: [i32; 2], neighbours: [(f64, [i32; 2]); 2], space: ResolveSpace) -> [f64; 4] {
        let own = self.pixel(x, y).expect("inside");
        let sum = neighbours[0].0 + neighbours[1].0;
        if sum <= 0.0 {
            return own.map(f64::from);
        }
        let this = values(own, space);
        let mut mixed = [0.0; 4];
        for (weight, [x, y]) in neighbours {
            let other = values(self.pixel(x, y).unwrap_or([0; 4]), space);
            for (k, mixed) in mixed.iter_mut().enumerate() {
                *mixed += weight / sum * (this[k] * (1.0 - weight) + other[k] * weight);
            }
        }
        straight(mixed, space)
    }

    fn pixel(&self, x: i32, y: i32) -> Option<[u8; 4]> {
        let inside = (0..self.size[0]).contains(&x) && (0..self.size[1]).contains(&y);
        inside.then(|| self.pixels[usize::try_from(y * self.size[0] + x).expect("inside")])
    }

    /// How far two pixels are apart, in parts of 10 000 * 255 * 255; nothing where one lies outside.
    fn apart(&self, [x, y]: [i32; 2], [u, v]: [i32; 2]) -> i64 {
        let measure = |[r, g, b, a]: [u8; 4]| {
            let [r, g, b, a] = [r, g, b, a].map(i64::from);
            [(2126 * r + 7152 * g + 722 * b) * a, 2_550_000 * a]
        };
        let (Some(one), Some(other)) = (self.pixel(x, y), self.pixel(u, v)) else {
            return 0;
        };
        let (one, other) = (measure(one), measure(other));
        (one[0] - other[0]).abs().max((one[1] - other[1]).abs())
    }

    /// Whether the left or the top side of a pixel is an edge.
    fn is_edge(&self, x: i32, y: i32, is_top: bool) -> bool {
        let left = self.apart([x, y], [x - 1, y]);
        let top = self.apart([x, y], [x, y - 1]);
        let own = if is_top { top } else { left };
        let others = [
            left,
            top,
            self.apart([x, y], [x + 1, y]),
            self.apart([x, y], [x, y + 1]),
            self.apart([x - 1, y], [x - 2, y]),
            self.apart([x, y - 1], [x, y - 2]),
        ];
        own * 10 >= 10_000 * 255 * 255 && others.into_iter().all(|other| 2 * own >= other)
    }

    /// What a pixel takes of the ones above and on the left, and they of it.
    fn weights(&self, x: i32, y: i32) -> [[f64; 2]; 2] {
        let mut weights = [[0.0; 2]; 2];
        if self.is_edge(x, y, true) {
            weights[0] = self.diagonals(x, y);
            if weights[0].iter().any(|weight| *weight > 0.0) {
                return weights;
            }
            weights[0] = line_weights(
                |along, across| self.is_edge(x + along, y + across, true),
                |along, across| self.is_edge(x + along, y + across, false),
            );
        }
        if self.is_edge(x, y, false) {
            weights[1] = line_weights(
                |along, across| self.is_edge(x + across, y + along, false),
                |along, across| self.is_edge(x + across, y + along, true),
            );
        }
        weights
    }

    fn diagonals(&self, x: i32, y: i32) -> [f64; 2] {
        let (left, top) = (|x, y| self.is_edge(x, y, false), |x, y| self.is_edge(x, y, true));
        // Steps, whether the end was found, and whether the last pixel that was looked at has a top edge.
        let search = |dx: i32, dy: i32, side: i32| {
            let both = |n: i32| left(x + n * dx + side, y + n * dy) && top(x + n * dx, y + n * dy);
            let steps = (1..8).take_while(|n| both(*n)).count();
            let steps = i32::try_from(steps).expect("a few");
            (steps, !both(steps + 1), top(x + (steps + 1) * dx, y + (steps + 1) * dy))
        };
        let mut sum = [0.0; 2];
        let cross = |found: bool, horizontal: bool, vertical: bool| {
            if found {
                2 * i32::from(horizontal) + i32::from(vertical)
            } else {
                0
            }
        };
        // Up to the right.
        let (mut before, found, on) = if left(x, y) { search(-1, 1, 0) } else { (0, true, false) };
        before += i32::from(on);
        let (after, found_after, _) = search(1, -1, 0);
        if before + after > 2 {
            let begin = cross(found, top(x - before - 1, y + before), left(x - before, y + before));
            let end = cross(
                found_after,
                top(x + after + 1, y - after),
                left(x + after + 1, y - after - 1),
            );
            let [own, other] = under_diagonal([begin, end], before, after);
            sum = [sum[0] + own, sum[1] + other];
        }
        // Down to the right.
        let (before, found, _) = search(-1, -1, 1);
        let (mut after, found_after, on) = if left(x + 1, y) {
            search(1, 1, 1)
        } else {
            (0, true, false)
        };
        after += i32::from(on);
        if before + after > 2 {
            let begin = cross(found, top(x - before - 1, y - before), left(x - before, y - before - 1));
            let end = cross(
                found_after,
                top(x + after + 1, y + after),
                left(x + after + 1, y + after),
            );
            let [other, own] = under_diagonal([begin, end], before, after);
            sum = [sum[0] + own, sum[1] + other];
        }
        sum.map(|weight: f64| weight.min(1.0))
    }
}

/// The weights at an edge of a line, which lies at place 0 along it: what is a line and what crosses it there.
fn line_weights(is_line: impl Fn(i32, i32) -> bool, crosses: impl Fn(i32, i32) -> bool) -> [f64; 2] {
    let is_crossed = |along: i32| crosses(along, 0) || crosses(along, -1);
    let before = (0..32).take_while(|n| !is_crossed(-n) && is_line(-n - 1, 0)).count();
    let after = (1..33).take_while(|n| !is_crossed(*n) && is_line(*n, 0)).count();
    let [before, after] = [before, after].map(|count| i32::try_from(count).expect("at most 32"));
    let [first, last] = [-before, after + 1];
    // The height at which the line crosses each end, upwards: where only one side crosses.
    let height = |near: bool, far: bool| (f64::from(u8::from(far)) - f64::from(u8::from(near))) / 2.0;
    let ends = [first, last].map(|along| [crosses(along, 0), crosses(along, -1)]);
    let mut heights = ends.map(|[near, far]| height(near, far));
    let is_double = ends.map(|[near, far]| near && far);
    let length = f64::from(before + after + 1);
    let place = f64::from(before);
    let mut areas = [0.0; 2];
    let is_z =
        (is_double[0] && heights[1] != 0.0) || (is_double[1] && heights[0] != 0.0) || heights[0] * heights[1] < 0.0;
    if is_z {
        if is_double[0] {
            heights[0] = -heights[1];
        }
        if is_double[1] {
            heights[1] = -heights[0];
        }
        areas = cut(place, |x| heights[0] + (heights[1] - heights[0]) * x / length);
    } else if heights[0] * heights[1] > 0.0 {
        let part = (length / 32.0).min(1.0);
        for half in [0, 1] {
            let found = cut(place, |x| {
                if (x < length / 2.0) == (half == 0) {
                    heights[half] * (1.0 - 2.0 * x / length).abs()
                } else {
                    0.0
                }
            });
            for (area, found) in areas.iter_mut().zip(found) {
                let rounded = (found * 2.0).sqrt() / 2.0;
                *area += rounded + (found - rounded) * part;
            }
        }
    } else if heights[0] != 0.0 && before <= after {
        areas = cut(place, |x| heights[0] * (1.0 - 2.0 * x / length).max(0.0));
    } else if heights[1] != 0.0 && before >= after {
        areas = cut(place, |x| heights[1] * (2.0 * x / length - 1.0).max(0.0));
    }
    let nearer = [before <= after, after <= before].map(|is_nearer| f64::from(u8::from(is_nearer)));
    for (area, beside) in areas.iter_mut().zip([1, -2]) {
        let corners = [first, last].map(|along| f64::from(u8::from(crosses(along, beside))));
        *area *= 1.0 - 0.75 * (nearer[0] * corners[0] + nearer[1] * corners[1]) / (nearer[0] + nearer[1]);
    }
    areas
}

/// The areas below and above zero of a height over the pixel that begins at `x`.
fn cut(x: f64, height: impl Fn(f64) -> f64) -> [f64; 2] {
    let mut areas = [0.0; 2];
    for column in 0..COLUMNS {
        let height = height(x + (f64::from(column) + 0.5) / f64::from(COLUMNS));
        areas[usize::from(height > 0.0)] += height.abs() / f64::from(COLUMNS);
    }
    areas
}

/// The areas at a pixel of a diagonal that rises: what of it lies above the line, and of its upper neighbour below. Each end may
/// lie at corners of its pixel, named by what crosses it.
fn under_diagonal([begin, end]: [i32; 2], before: i32, after: i32) -> [f64; 2] {
    let (low, high, far) = ([0.0, 0.0], [1.0, 1.0], [1.0, 0.0]);
    let guesses: &[[[f64; 2]; 2]] = match (begin, end) {
        (1, 0) => &[[far, low], [far, far]],
        (2, 0) => &[[high, low], [high, far]],
        (3, 0) => &[[high, low], [far, far]],
        (0, 1) => &[[low, high], [far, high]],
        (1, 1) => &[[far, high]],
        (2, 1) => &[[high, high]],
        (3, 1) => &[[high, high], [far, high]],
        (0, 2) => &[[low, far], [far, far]],
        (1, 2) => &[[far, far]],
        (2, 2) => &[[high, far]],
        (3, 2) => &[[high, far], [far, far]],
        (0, 3) => &[[low, high], [far, far]],
        (1, 3) => &[[far, high], [far, far]],
        (2, 3) => &[[high, high], [high, far]],
        // Nothing crosses either end, or everything.
        _ => &[[high, high], [far, far]],
    };
    let length = f64::from(before + after + 1);
    let mut areas = [0.0; 2];
    for [from, to] in guesses {
        let at = |x: f64| from[1] + (to[1] + length - from[1]) * (x - from[0]) / (to[0] + length - from[0]);
        for column in 0..COLUMNS {
            let x = 1.0 + f64::from(before) + (f64::from(column) + 0.5) / f64::from(COLUMNS);
            let part = 1.0 / f64::from(COLUMNS) / guesses.len() as f64;
            areas[0] += (1.0 - (at(x) - f64::from(before)).clamp(0.0, 1.0)) * part;
            areas[1] += (at(x) - f64::from(before) - 1.0).clamp(0.0, 1.0) * part;
        }
    }
    areas
}

/// What is blended of a pixel: weighted by alpha.
fn values([r, g, b, a]: [u8; 4], space: ResolveSpace) -> [f64; 4] {
    let alpha = f64::from(a);
    let of = |channel: u8| match space {
        ResolveSpace::Stored => f64::from(channel) * alpha,
        ResolveSpace::Linear => f64::from(srgb_to_linear(f32::from(channel) / 255.0)) * 255.0 * alpha,
    };
    [of(r), of(g), of(b), alpha]
}

fn straight([r, g, b, a]: [f64; 4], space: ResolveSpace) -> [f64; 4] {
    let of = |channel: f64| match space {
        _ if a <= 0.0 => 0.0,
        ResolveSpace::Stored => channel / a,
        ResolveSpace::Linear => encoded(channel / a),
    };
    [of(r), of(g), of(b), a]
}
