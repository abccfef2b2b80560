//! What the window shows of A and B: which of both flips to the front, in which colours differences come, where the line
//! of the wipe is.

use std::time::Instant;

use super::super::Viewer;
use super::super::drawing::Drawing;
use super::composite::{Composite, Content};
use super::{Arrangement, FLIP, Paint};
use crate::compare::{Gain, Pair};
use crate::raster::Framebuffer;

/// Window pixels between the line of a wipe and a panel at least.
const LINE_ROOM: f64 = 48.0;

impl Viewer {
    /// Brings the colours of differences and the flipping up to date.
    pub(in super::super) fn update_comparison(&mut self) {
        self.flip_when_due();
        self.mix_paint();
        self.want_measures();
    }

    fn flip_when_due(&mut self) {
        let flips = self.arrangement() == Arrangement::Flip;
        let now = Instant::now();
        let next = now.checked_add(FLIP);
        let comparison = &mut self.comparison;
        match comparison.flip {
            _ if !flips => comparison.flip = None,
            None => comparison.flip = Some((next, false)),
            Some((Some(due), shows_back)) if due <= now => {
                comparison.flip = Some((next, !shows_back));
                comparison.touch();
            }
            Some(_) => {}
        }
    }

    /// Shows the other of both, until it is asked for again.
    pub(super) fn flip_by_hand(&mut self) {
        let shows_back = self.flip_shows_back();
        if self.arrangement() != Arrangement::Flip {
            self.arrange(Arrangement::Flip);
        }
        self.comparison.flip = Some((None, !shows_back));
    }

    /// Whether the one in the back is to be seen of both that flip.
    fn flip_shows_back(&self) -> bool {
        matches!(self.comparison.flip, Some((_, true)))
    }

    /// Whether it is B of which all is to be seen, in place of A.
    pub fn shows_b(&self) -> bool {
        self.comparison.swapped != self.flip_shows_back()
    }

    /// When something about comparing is to be done: flipping, measuring, looking at B again.
    pub(in super::super) fn comparison_due(&self) -> Option<Instant> {
        let flip = self.comparison.flip.and_then(|(due, _)| due);
        let drawing = self.comparison.drawing.as_ref().and_then(Drawing::due);
        let other = self.comparison.postponed.filter(|_| self.comparison.other.is_some());
        [flip, drawing, other, self.comparison.measuring.due()]
            .into_iter()
            .flatten()
            .min()
    }

    /// Normalised colours follow the frames once both are final: until then they stay as they are.
    fn mix_paint(&mut self) {
        let style = self.comparison.style;
        if self.arrangement() != Arrangement::Difference {
            self.comparison.paint = None;
            return;
        }
        let normalized = style.gain == Gain::Normalize;
        let swaps = self.comparison.swaps;
        let frames = normalized.then(|| [self.drawing.number(), self.comparison.state()[1], swaps]);
        let known = self.comparison.paint.as_ref();
        let is_right = known.is_some_and(|paint| paint.style == style && paint.frames == frames);
        let settled = self.drawing.is_current() && self.comparison.is_current();
        if is_right || (normalized && !settled && known.is_some_and(|paint| paint.style == style)) {
            return;
        }
        let Some([a, b]) = self.pair() else { return };
        let Ok(pair) = Pair::new(a, b) else { return };
        let colors = pair.paint(style);
        self.comparison.paint = Some(Paint { colors, style, frames });
        self.comparison.touch();
    }

    /// What the window shows below the panels.
    pub(in super::super) fn composite(&self) -> Composite<'_> {
        let Some(frame) = self.frame() else {
            return Composite::default();
        };
        let panes = self.panes();
        let comparison = &self.comparison;
        let Some([front, back]) = self.pair().filter(|_| comparison.shows_both()) else {
            return Composite::new(vec![(panes.first, Content::One(&frame.pixels))]);
        };
        let content = match comparison.arrangement {
            Arrangement::Alone | Arrangement::SideBySide => Content::One(front),
            Arrangement::Flip => Content::One(if self.flip_shows_back() { back } else { front }),
            Arrangement::Wipe => Content::Wipe([front, back], self.wipe_column(front)),
            Arrangement::Difference => match &comparison.paint {
                Some(paint) => Content::Difference([front, back], &paint.colors),
                None => Content::One(front),
            },
        };
        let second = panes.second.map(|pane| (pane, Content::One(back)));
        Composite::new(std::iter::once((panes.first, content)).chain(second).collect())
    }

    /// The first column of the right part, where no panel covers the line.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and a frame's width"
    )]
    fn wipe_column(&self, frame: &Framebuffer) -> u32 {
        let width = f64::from(frame.width());
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        let corner = self.panes().first.corner[0] as f64;
        let wanted = (self.comparison.wipe.clamp(0.0, 1.0) * width).round();
        let free = self.in_sight_of_line((wanted + corner) * zoom) / zoom - corner;
        free.round().clamp(0.0, width) as u32
    }

    /// The nearest place for the line of the wipe that no panel covers, in window pixels from the left: its grip and its
    /// letters are to be seen beside panels. Without panels any place will do.
    pub(super) fn in_sight_of_line(&self, x: f64) -> f64 {
        let Some(free) = self.screen.free_area else { return x };
        let low = if free.x > 0 { free.x as f64 + LINE_ROOM } else { x };
        let window = i64::from(self.screen.window[0]);
        let high = if free.right() < window {
            free.right() as f64 - LINE_ROOM
        } else {
            x
        };
        let has_room = f64::from(free.width) > 2.0 * LINE_ROOM;
        if has_room { x.max(low).min(high.max(low)) } else { x }
    }

    /// Where the line of the wipe is, in window pixels from the left; `None` where there is none.
    pub fn wipe_line(&self) -> Option<f64> {
        let wipes = self.arrangement() == Arrangement::Wipe;
        let [front, _] = self.pair().filter(|_| wipes)?;
        let column = i64::from(self.wipe_column(front)) + self.panes().first.corner[0];
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        Some(column as f64 * zoom)
    }
}
