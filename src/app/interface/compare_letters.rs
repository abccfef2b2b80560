//! The letters beside the magnifiers of A and B: which is whose.
//!
//! ```text
//!    +-------+ +-------+
//!   A|       | |       |B      outside, at sides that match where both have room there
//!    +-------+ +-------+
//! ```

use egui::{Align2, Color32, FontId, Rect, Ui, Vec2};

use super::floating::things;
use super::places::points;
use crate::viewer::{Arrangement, Viewer};

/// Side of a letter's ground, in points.
pub(super) const LETTER: f32 = 20.0;
/// How many of [`Lettered::sides`] match those of the other inset.
const MATCHING: usize = 3;

/// An inset with its letter.
struct Lettered {
    letter: &'static str,
    inset: Rect,
    /// What the letter stays inside: the half of its picture, where it has one.
    home: Rect,
    /// Whether the inset of the other picture lies to the right.
    is_left: bool,
}

impl Lettered {
    /// Where the letter may stand: outside, where no magnified pixel is, the best place first.
    fn sides(&self) -> [Rect; 6] {
        let Rect { min, max } = self.inset;
        let size = Vec2::splat(LETTER);
        let beside = |x: f32, y: f32| Rect::from_min_size(egui::pos2(x, y), size);
        let [left, right] = [min.x - LETTER, max.x];
        let [outer, inner] = if self.is_left { [left, right] } else { [right, left] };
        [
            beside(outer, min.y),
            // Above and below, where the inset is as wide as its half.
            beside(min.x, min.y - LETTER),
            beside(min.x, max.y),
            beside(inner, min.y),
            beside(outer, max.y - LETTER),
            beside(inner, max.y - LETTER),
        ]
    }

    fn suits(&self, place: Rect, taken: &[Rect]) -> bool {
        // Its own inset touches it.
        self.home.contains_rect(place) && taken.iter().all(|other| !other.shrink(0.5).intersects(place))
    }

    /// A place of its own: beside what is taken, or at least inside its half.
    fn alone(&self, taken: &[Rect]) -> Rect {
        let sides = self.sides();
        let free = sides.into_iter().find(|place| self.suits(*place, taken));
        let inside = || sides.into_iter().find(|place| self.home.contains_rect(*place));
        free.or_else(inside).unwrap_or(sides[0])
    }
}

/// Draws the letters inside `free`, beside what is taken: the line of a wipe, rings of pins, other insets. Returns where they
/// are; none while one picture has no inset.
pub(super) fn show(ui: &Ui, viewer: &Viewer, free: Rect, line: Option<Rect>) -> Vec<Rect> {
    let scale = ui.pixels_per_point();
    let inspector = viewer.inspector();
    let Some((own, other)) = inspector.inset().zip(inspector.other_inset()) else {
        return Vec::new();
    };
    let [own, other] = [own, other].map(|placed| points(&placed.rect, scale));
    let lettered = [("A", own, other), ("B", other, own)].map(|(letter, inset, beside)| {
        let middle = free.center().x;
        Lettered {
            letter,
            inset,
            home: match viewer.ab().arrangement() {
                Arrangement::SideBySide if inset.center().x < middle => free.with_max_x(middle),
                Arrangement::SideBySide => free.with_min_x(middle),
                _ => free,
            },
            is_left: inset.left() < beside.left(),
        }
    });
    let taken: Vec<Rect> = things(viewer, scale).into_iter().chain(line).collect();
    let matching = (0..MATCHING).find(|side| lettered.iter().all(|one| one.suits(one.sides()[*side], &taken)));
    let places = lettered.map(|one| {
        let place = matching.map_or_else(|| one.alone(&taken), |side| one.sides()[side]);
        ui.painter().rect_filled(place, 0.0, Color32::from_black_alpha(190));
        ui.painter().text(
            place.center(),
            Align2::CENTER_CENTER,
            one.letter,
            FontId::proportional(13.0),
            Color32::WHITE,
        );
        place
    });
    places.to_vec()
}
