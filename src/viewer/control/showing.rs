//! What the window shows of A and B: which of both flips to the front, in which colours differences come, where the line
//! of the wipe is.

use std::time::{Duration, Instant};

use crate::compare::{Gain, Pair};
use crate::viewer::ab::comparison::Paint;
use crate::viewer::ab::other::Arrangement;
use crate::viewer::frames::composite::{Composite, Content};
use crate::viewer::frames::drawing::Drawing;
use crate::viewer::state::Viewer;

/// How long each of both is to be seen while they flip.
pub(in crate::viewer) const FLIP: Duration = Duration::from_millis(700);

impl Viewer {
    /// Brings the colours of differences and the flipping up to date.
    pub(in crate::viewer) fn update_comparison(&mut self) {
        self.flip_when_due();
        self.mix_paint();
        self.want_measures();
    }

    fn flip_when_due(&mut self) {
        let flips = self.arrangement() == Arrangement::Flip;
        let now = Instant::now();
        let next = now.checked_add(FLIP);
        let comparison = &mut self.ab;
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
    pub(in crate::viewer) fn flip_by_hand(&mut self) {
        let shows_back = self.flip_shows_back();
        if self.arrangement() != Arrangement::Flip {
            self.arrange(Arrangement::Flip);
        }
        self.ab.flip = Some((None, !shows_back));
    }

    /// Whether the one in the back is to be seen of both that flip.
    fn flip_shows_back(&self) -> bool {
        matches!(self.ab.flip, Some((_, true)))
    }

    /// Whether it is B of which all is to be seen, in place of A.
    pub fn shows_b(&self) -> bool {
        self.ab.swapped != self.flip_shows_back()
    }

    /// When something about comparing is to be done: flipping, measuring, looking at B again.
    pub(in crate::viewer) fn comparison_due(&self) -> Option<Instant> {
        let flip = self.ab.flip.and_then(|(due, _)| due);
        let drawing = self.ab.drawing.as_ref().and_then(Drawing::due);
        let other = self.ab.postponed.filter(|_| self.ab.other.is_some());
        [flip, drawing, other, self.ab.measuring.due()]
            .into_iter()
            .flatten()
            .min()
    }

    /// Normalised colours follow the frames once both are final: until then they stay as they are.
    fn mix_paint(&mut self) {
        let style = self.ab.style;
        if self.arrangement() != Arrangement::Difference {
            self.ab.paint = None;
            return;
        }
        let normalized = style.gain == Gain::Normalize;
        let swaps = self.ab.swaps;
        let frames = normalized.then(|| [self.frames.drawing.number(), self.ab.state()[1], swaps]);
        let known = self.ab.paint.as_ref();
        let is_right = known.is_some_and(|paint| paint.style == style && paint.frames == frames);
        let settled = self.frames.drawing.is_current() && self.ab.is_current();
        if is_right || (normalized && !settled && known.is_some_and(|paint| paint.style == style)) {
            return;
        }
        let Some([a, b]) = self.pair() else { return };
        let Ok(pair) = Pair::new(a, b) else { return };
        let colors = pair.paint(style);
        self.ab.paint = Some(Paint { colors, style, frames });
        self.ab.touch();
    }

    /// What the window shows below the panels.
    pub(in crate::viewer) fn composite(&self) -> Composite<'_> {
        let Some(frame) = self.frame() else {
            return Composite::default();
        };
        let panes = self.panes();
        let comparison = &self.ab;
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
}
