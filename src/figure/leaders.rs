//! Leader lines: what connects a region of a picture with its magnifier.
//!
//! ```text
//!     region          magnifier
//!     *-----------*-----------*
//!     |  |        |           |
//!     *--*        |           |      two of the four lines between like corners pass neither of both
//!        `--------*-----------*
//! ```

use glam::DVec2;

use super::PixelRect;

/// The lines from corners of a region to the same corners of its inset that pass neither.
pub(super) fn leaders(region: &PixelRect, inset: &PixelRect) -> impl Iterator<Item = [DVec2; 2]> {
    let corners = |rect: &PixelRect| {
        let [x0, y0, x1, y1] = [rect.x, rect.y, rect.right(), rect.bottom()].map(|side| side as f64);
        [
            DVec2::new(x0, y0),
            DVec2::new(x1, y0),
            DVec2::new(x0, y1),
            DVec2::new(x1, y1),
        ]
    };
    let (region, inset) = (*region, *inset);
    let lines = corners(&region)
        .into_iter()
        .zip(corners(&inset))
        .map(|(from, to)| [from, to]);
    lines.filter(move |line| !passes(*line, &region) && !passes(*line, &inset))
}

/// Whether a line passes the inside of a rectangle (Liang and Barsky, 1984).
fn passes([from, to]: [DVec2; 2], rect: &PixelRect) -> bool {
    let (mut start, mut end) = (0.0_f64, 1.0_f64);
    let by = to - from;
    let sides = [
        (-by.x, from.x - rect.x as f64),
        (by.x, rect.right() as f64 - from.x),
        (-by.y, from.y - rect.y as f64),
        (by.y, rect.bottom() as f64 - from.y),
    ];
    for (direction, distance) in sides {
        if direction == 0.0 {
            if distance <= 0.0 {
                return false;
            }
        } else if direction < 0.0 {
            start = start.max(distance / direction);
        } else {
            end = end.min(distance / direction);
        }
    }
    end - start > 1e-9
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaders_are_the_two_tangents() {
        let rect = |x, y| PixelRect {
            x,
            y,
            width: 10,
            height: 10,
        };
        let (region, inset) = (
            rect(0, 100),
            PixelRect {
                x: 80,
                y: 0,
                width: 60,
                height: 60,
            },
        );
        let lines: Vec<_> = leaders(&region, &inset).collect();
        assert_eq!(lines.len(), 2, "{lines:?}");
        assert_eq!(
            lines[0],
            [DVec2::new(0.0, 100.0), DVec2::new(80.0, 0.0)],
            "upper left corners"
        );
        assert_eq!(
            lines[1],
            [DVec2::new(10.0, 110.0), DVec2::new(140.0, 60.0)],
            "lower right corners"
        );
    }
}
