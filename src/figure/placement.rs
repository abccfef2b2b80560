//! Where an inset goes: into a corner of the free area, never over the pixel that it shows.

use super::PixelRect;

/// Pixels between an inset and the border of its area, where there is room.
const MARGIN: u32 = 12;

/// A corner of the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Corner {
    /// Upper left.
    TopLeft,
    /// Upper right.
    #[default]
    TopRight,
    /// Lower left.
    BottomLeft,
    /// Lower right.
    BottomRight,
}

impl Corner {
    /// Every corner.
    pub const ALL: [Self; 4] = [Self::TopRight, Self::BottomRight, Self::TopLeft, Self::BottomLeft];

    /// The one of `area` that is nearest to a point.
    pub fn nearest(area: &PixelRect, [x, y]: [i64; 2]) -> Self {
        let right = 2 * (x - area.x) >= i64::from(area.width);
        let below = 2 * (y - area.y) >= i64::from(area.height);
        match (right, below) {
            (false, false) => Self::TopLeft,
            (true, false) => Self::TopRight,
            (false, true) => Self::BottomLeft,
            (true, true) => Self::BottomRight,
        }
    }

    /// Its name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::TopLeft => "top-left",
            Self::TopRight => "top-right",
            Self::BottomLeft => "bottom-left",
            Self::BottomRight => "bottom-right",
        }
    }

    /// A rectangle of `size` in this corner of `area`, `margin` from its sides where there is room; `None` if it is
    /// larger than the area.
    fn rect(self, area: &PixelRect, size: [u32; 2], margin: u32) -> Option<PixelRect> {
        let spare_x = area.width.checked_sub(size[0])?;
        let spare_y = area.height.checked_sub(size[1])?;
        let right = matches!(self, Self::TopRight | Self::BottomRight);
        let below = matches!(self, Self::BottomLeft | Self::BottomRight);
        let offset = |spare: u32, far: bool| {
            let near_margin = margin.min(spare / 2);
            i64::from(if far { spare - near_margin } else { near_margin })
        };
        Some(PixelRect {
            x: area.x + offset(spare_x, right),
            y: area.y + offset(spare_y, below),
            width: size[0],
            height: size[1],
        })
    }
}

/// A rectangle of `size` in a corner of `area`; `None` if it does not fit.
pub(super) fn in_corner(area: &PixelRect, size: [u32; 2], corner: Corner) -> Option<PixelRect> {
    corner.rect(area, size, MARGIN)
}

/// Rectangles of `size` along the sides of `area`, from corner to corner; none where it is larger than that.
pub(super) fn along_sides(area: &PixelRect, size: [u32; 2]) -> impl Iterator<Item = PixelRect> {
    /// Steps from one corner to the next.
    const STEPS: u32 = 24;
    let between = |from: i64, to: i64| move |step: u32| from + (to - from) * i64::from(step) / i64::from(STEPS);
    let ends = [Corner::TopLeft, Corner::BottomRight].map(|corner| in_corner(area, size, corner));
    let sides = ends[0].zip(ends[1]).into_iter().flat_map(move |(first, last)| {
        let (x, y) = (between(first.x, last.x), between(first.y, last.y));
        (0..=STEPS).flat_map(move |step| {
            [
                [x(step), first.y],
                [x(step), last.y],
                [first.x, y(step)],
                [last.x, y(step)],
            ]
        })
    });
    sides.map(move |[x, y]| PixelRect {
        x,
        y,
        width: size[0],
        height: size[1],
    })
}

/// A place for an inset of `size` inside `area` that leaves `shown` uncovered: `preferred` if that will do, else the
/// first other corner. `None` where every corner covers it.
pub fn place(area: &PixelRect, size: [u32; 2], shown: &PixelRect, preferred: Corner) -> Option<(Corner, PixelRect)> {
    corners(area, size, preferred).find(|(_, rect)| !rect.overlaps(shown))
}

/// The places for something of `size` in the corners of `area`, `preferred` first; none where it is larger than that.
pub fn corners(area: &PixelRect, size: [u32; 2], preferred: Corner) -> impl Iterator<Item = (Corner, PixelRect)> {
    // Without a margin a tight area may still have room.
    let corners = [MARGIN, 0].into_iter().flat_map(move |margin| {
        std::iter::once(preferred)
            .chain(Corner::ALL)
            .map(move |corner| (corner, margin))
    });
    corners.filter_map(move |(corner, margin)| Some((corner, corner.rect(area, size, margin)?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn placement_never_covers_the_pixel() {
        arbtest::arbtest(|u| {
            let area = PixelRect {
                x: u.int_in_range(-20..=20)?,
                y: u.int_in_range(-20..=20)?,
                width: u.int_in_range(0..=300)?,
                height: u.int_in_range(0..=300)?,
            };
            let size = [u.int_in_range(1..=200)?, u.int_in_range(1..=200)?];
            let zoom = u.int_in_range(1..=8)?;
            let shown = PixelRect {
                x: u.int_in_range(-30..=320)?,
                y: u.int_in_range(-30..=320)?,
                width: zoom,
                height: zoom,
            };
            let preferred = *u.choose(&Corner::ALL)?;
            if let Some((_, rect)) = place(&area, size, &shown, preferred) {
                assert!(!rect.overlaps(&shown), "{rect:?} covers {shown:?}");
                assert_eq!(rect.intersection(&area), rect, "{rect:?} lies inside {area:?}");
            } else {
                // With twice the room in one direction, some corner is always free.
                let roomy = |room: u32, side: u32| room >= 2 * side + zoom;
                let fits = area.width >= size[0] && area.height >= size[1];
                let free = fits && (roomy(area.width, size[0]) || roomy(area.height, size[1]));
                assert!(!free, "{size:?} has room in {area:?} beside {shown:?}");
            }
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn placement_stays_where_it_is_while_it_can() {
        let area = PixelRect::of_size([800, 600]);
        let at = |x, y| PixelRect {
            x,
            y,
            width: 1,
            height: 1,
        };
        let corner = |shown, preferred| place(&area, [200, 200], &shown, preferred).map(|(corner, _)| corner);
        assert_eq!(
            corner(at(10, 10), Corner::BottomRight),
            Some(Corner::BottomRight),
            "no need to move"
        );
        assert_eq!(
            corner(at(700, 500), Corner::BottomRight),
            Some(Corner::TopRight),
            "moves away"
        );
    }
}
