//! Words beside the points of a chart, where they hide neither each other nor points.

use super::PixelRect;

/// What has its place already.
#[derive(Clone, Debug)]
pub(super) struct Beside {
    taken: Vec<PixelRect>,
    /// Words stay inside.
    inside: PixelRect,
    /// Pixels from a point to its words.
    gap: i64,
}

impl Beside {
    /// Points of this radius, in pixels.
    pub(super) fn new(inside: PixelRect, points: impl Iterator<Item = [i64; 2]>, radius: u32) -> Self {
        let square = |[x, y]: [i64; 2]| PixelRect {
            x: x - i64::from(radius),
            y: y - i64::from(radius),
            width: radius * 2 + 1,
            height: radius * 2 + 1,
        };
        Self {
            taken: points.map(square).collect(),
            inside,
            gap: i64::from(radius) + i64::from(radius / 2) + 1,
        }
    }

    /// The upper left corner of words of this size beside a point; where everything is taken, where they hide least.
    pub(super) fn place(&mut self, [x, y]: [i64; 2], [width, height]: [u32; 2]) -> [i64; 2] {
        let (wide, high, gap) = (i64::from(width), i64::from(height), self.gap);
        let columns = [x + gap, x - gap - wide, x - wide / 2];
        // Above and below, to the right and to the left, then farther and farther away.
        let near = [y - gap - high, y + gap]
            .into_iter()
            .flat_map(|y| columns.map(|x| [x, y]));
        let level = columns.into_iter().take(2).map(|x| [x, y - high / 2]);
        let rows = (1..4).flat_map(|away| [y - gap - high - away * high, y + gap + away * high]);
        let far = rows.flat_map(|y| columns.map(|x| [x, y]));
        let places = near.chain(level).chain(far);
        let places = places.map(|[x, y]| PixelRect { x, y, width, height });
        let area = |rect: PixelRect| u64::from(rect.width) * u64::from(rect.height);
        let hidden = |place: &PixelRect| {
            let outside = area(*place) - area(place.intersection(&self.inside));
            let taken = self.taken.iter().map(|taken| area(place.intersection(taken)));
            outside + taken.sum::<u64>()
        };
        // Of equal ones the first.
        let best = places.min_by_key(hidden).unwrap_or(PixelRect { x, y, width, height });
        self.taken.push(best);
        [best.x, best.y]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_hide_neither_each_other_nor_points() {
        let points = [[100, 100], [103, 101], [106, 99], [195, 3]];
        let mut beside = Beside::new(PixelRect::of_size([200, 200]), points.into_iter(), 3);
        let dots = beside.taken.clone();
        let placed: Vec<PixelRect> = points
            .iter()
            .map(|point| {
                let [x, y] = beside.place(*point, [30, 12]);
                PixelRect {
                    x,
                    y,
                    width: 30,
                    height: 12,
                }
            })
            .collect();
        for (index, words) in placed.iter().enumerate() {
            let others = dots.iter().chain(&placed[..index]);
            assert!(
                others.clone().all(|other| !words.overlaps(other)),
                "{index}: {placed:?}"
            );
            assert_eq!(
                words.intersection(&PixelRect::of_size([200, 200])),
                *words,
                "{index}: inside"
            );
        }
        assert!(
            placed[0].x > 100 && placed[0].bottom() < 100,
            "to the upper right where that is free"
        );
    }
}
