//! The corner of the picture where a card lies.

use egui::{Align2, Context, Rect, ScrollArea, Ui, Vec2};

use super::look;

/// The corners where it may lie, the best first: words and settings stand on the left.
const CORNERS: [Align2; 4] = [
    Align2::RIGHT_BOTTOM,
    Align2::LEFT_BOTTOM,
    Align2::RIGHT_TOP,
    Align2::LEFT_TOP,
];
/// How near to what it gives way to the card may come, in points.
pub(super) const APART: f32 = 16.0;

/// Height of what is always to be seen of a card's contents, in points.
const LEAST_HEIGHT: f32 = 40.0;

/// Where a card may lie that is at least so wide: in what is `free` of the `window`, or where that is too narrow, over the panels
/// beside it as far as the card needs. A part behind a panel would be out of reach; who wants the panel closes the card.
pub(super) fn wide_enough(free: Rect, width: f32, window: Rect) -> Rect {
    let width = width.min(window.width());
    if free.width() >= width {
        return free;
    }
    let left = (free.center().x - width / 2.0).clamp(window.left(), window.right() - width);
    Rect::from_x_y_ranges(left..=left + width, free.y_range())
}

/// What is below a card's title, `needed` points wide and high: with bars where that is more than there is `room` for, so that
/// the title, which closes the card, stays in the window.
pub(super) fn below_title(ui: &mut Ui, [needed, room]: [Vec2; 2], contents: impl FnOnce(&mut Ui)) {
    // Half a point is a matter of rounding.
    let lacks = [needed.x > room.x + 0.5, needed.y > room.y];
    if lacks == [false; 2] {
        return contents(ui);
    }
    look::bars_beside(ui);
    let height = room.y.max(LEAST_HEIGHT);
    // As high as it may be from the first pass on: the card would keep the height of what it said before.
    ScrollArea::new(lacks)
        .id_salt("below the title")
        .max_height(height)
        .min_scrolled_height(height)
        .show(ui, |ui| {
            if lacks[0] {
                ui.set_width(needed.x);
            }
            contents(ui);
        });
}

/// Where a card is.
#[derive(Debug, Default)]
pub(super) struct CardCorner {
    at: Option<Align2>,
    /// How large it was drawn, in points.
    size: Vec2,
}

impl CardCorner {
    /// Whether a card of `size` fits into a corner of `room` where nothing is in its way.
    pub(super) fn has_room<T: Ord + Default>(size: Vec2, room: Rect, in_way: impl Fn(Rect) -> T) -> bool {
        let fits = size.x <= room.width() && size.y <= room.height();
        let place = |corner: Align2| corner.align_size_within_rect(size, room).expand(APART);
        fits && CORNERS.into_iter().any(|corner| in_way(place(corner)) == T::default())
    }

    /// The corner of `room` where a card of `size` lies: where it was, while nothing is in its way there; else where the least
    /// is. `in_way` tells how much is in a place.
    pub(super) fn choose<T: Ord + Default>(&mut self, size: Vec2, room: Rect, in_way: impl Fn(Rect) -> T) -> Align2 {
        let in_way = |corner: &Align2| in_way(corner.align_size_within_rect(size, room).expand(APART));
        let stays = self.at.filter(|corner| in_way(corner) == T::default());
        let corner = stays.unwrap_or_else(|| {
            let best = CORNERS.into_iter().min_by_key(in_way);
            best.unwrap_or(Align2::RIGHT_BOTTOM)
        });
        self.at = Some(corner);
        corner
    }

    /// How large it was drawn last, in points; nothing before the first time.
    pub(super) fn drawn_size(&self) -> Vec2 {
        self.size
    }

    /// Notes how the card was drawn. Its corner is found by the size that it had: where that has changed, it is drawn once more.
    pub(super) fn drawn(&mut self, ctx: &Context, card: Rect) {
        if self.size != card.size() {
            self.size = card.size();
            ctx.request_repaint();
        }
    }
}

#[cfg(test)]
mod tests {
    use egui::{pos2, vec2};

    use super::*;

    #[test]
    fn card_that_grew_is_drawn_once_more() {
        let ctx = Context::default();
        let mut corner = CardCorner::default();
        let mut asks = |height: f32| {
            let card = Rect::from_min_size(pos2(0.0, 0.0), vec2(100.0, height));
            let mut output = ctx.run_ui(egui::RawInput::default(), |_| corner.drawn(&ctx, card));
            output.textures_delta.clear();
            output.viewport_output.values().any(|view| view.repaint_delay.is_zero())
        };
        // Whoever asks once is drawn twice.
        assert!((0..4).any(|_| !asks(80.0)), "as it was");
        assert!(asks(200.0), "it grew");
        assert!((0..4).any(|_| !asks(200.0)), "and rests");
    }

    #[test]
    fn card_that_has_no_room_beside_panels_lies_over_them() {
        let rect = |left, right| Rect::from_min_max(pos2(left, 10.0), pos2(right, 300.0));
        let window = rect(0.0, 700.0);
        for (free, wanted) in [
            (rect(264.0, 600.0), rect(264.0, 600.0)),
            (rect(264.0, 436.0), rect(200.0, 500.0)),
            (rect(0.0, 156.0), rect(0.0, 300.0)),
            (rect(564.0, 700.0), rect(400.0, 700.0)),
        ] {
            assert_eq!(wide_enough(free, 300.0, window), wanted, "{free:?}");
        }
        assert_eq!(
            wide_enough(rect(0.0, 156.0), 900.0, window),
            window,
            "no wider than the window"
        );
    }

    #[test]
    fn card_stays_until_something_comes_there() {
        let mut corner = CardCorner::default();
        let room = Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 300.0));
        let size = vec2(100.0, 80.0);
        let at = |place: [f32; 2]| move |card: Rect| usize::from(card.contains(place.into()));
        assert_eq!(corner.choose(size, room, |_| 0), Align2::RIGHT_BOTTOM, "the best");
        assert!(CardCorner::has_room(size, room, at([390.0, 290.0])), "three others");
        assert!(!CardCorner::has_room(size, room, |_| 1), "all are taken");
        assert!(!CardCorner::has_room(vec2(401.0, 80.0), room, |_| 0), "too wide");
        let chosen = corner.choose(size, room, at([390.0, 290.0]));
        assert_eq!(chosen, Align2::LEFT_BOTTOM, "it gives way");
        let chosen = corner.choose(size, room, at([390.0, 10.0]));
        assert_eq!(chosen, Align2::LEFT_BOTTOM, "and stays");
        assert_eq!(corner.choose(size, room, |_| 1), Align2::RIGHT_BOTTOM, "all are as bad");
    }
}
