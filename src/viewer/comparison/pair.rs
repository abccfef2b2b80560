//! Two frames that belong together: B is drawn beside A, and what is on the screen shows both from the same place.
//!
//! While the view moves, both are drawn in step: the next view is wanted once both have come to the last, so that a
//! slow B never makes a difference of two views. Where A alone is to be seen, B is drawn when A is finished.

use std::sync::Arc;
use std::time::Instant;

use super::super::drawing::{Changes, Drawing, DrawingId, Wish};
use super::super::{Frame, Picture, PixelRect, Viewer};
use super::composite::{Composite, Content, Pane};
use super::{Arrangement, Comparison, FLIP, Other, Paint};
use crate::compare::{Gain, Pair};
use crate::raster::Framebuffer;
use crate::render::RenderSettings;

/// Screen pixels between two pictures side by side.
const GAP: u32 = 2;

/// Where frames lie in the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) struct Panes {
    /// Width and height of every frame.
    pub(in super::super) frame: [u32; 2],
    /// Where the first lies.
    pub(in super::super) first: Pane,
    /// Where B lies, where it has a place of its own.
    pub(in super::super) second: Option<Pane>,
}

impl Panes {
    /// The pane that a screen pixel belongs to, the first where it belongs to none.
    pub(in super::super) fn at(&self, pixel: [i64; 2]) -> Pane {
        let in_second = self.second.filter(|pane| pane.area.contains(pixel));
        in_second.unwrap_or(self.first)
    }
}

impl Comparison {
    /// Whether both frames are needed on the screen.
    pub(in super::super) fn shows_both(&self) -> bool {
        self.other.is_some() && self.arrangement != Arrangement::Alone
    }

    pub(in super::super) fn drawing(&self) -> Option<&Drawing> {
        self.drawing.as_ref()
    }

    pub(in super::super) fn drawing_mut(&mut self) -> Option<&mut Drawing> {
        self.drawing.as_mut()
    }

    /// What tells B's frame and everything else about comparing from what was to be seen before.
    pub(in super::super) fn state(&self) -> [u64; 2] {
        [self.number, self.drawing.as_ref().map_or(0, Drawing::number)]
    }

    /// What changed of B's frame since this was asked last.
    pub(in super::super) fn take_changes(&mut self) -> Changes {
        let none = Changes::Regions(Vec::new());
        self.drawing.as_mut().map_or(none, Drawing::take_changes)
    }

    /// Whether B is there, or nothing of it is wanted: no scene, or no window to show it in.
    pub(in super::super) fn is_current(&self) -> bool {
        self.other.is_none() || self.drawing.as_ref().is_none_or(Drawing::is_current)
    }

    pub(in super::super) fn touch(&mut self) {
        self.number += 1;
    }
}

impl Viewer {
    /// Where frames lie in the screen: the window's pixels divided by the pixel zoom.
    pub(in super::super) fn panes(&self) -> Panes {
        let screen = self.settings.pixel_zoom.frame_size(self.screen.window);
        let whole = PixelRect::of_size(screen);
        let pane = |area: PixelRect| Pane {
            area,
            corner: [area.x, area.y],
        };
        let alone = Panes {
            frame: screen,
            first: pane(whole),
            second: None,
        };
        let halves = self.comparison.other.is_some() && self.comparison.arrangement == Arrangement::SideBySide;
        let Some([left, right]) = halves.then(|| self.halves()).flatten() else {
            return alone;
        };
        Panes {
            frame: [left.width, left.height],
            first: pane(left),
            second: Some(pane(right)),
        }
    }

    /// The free area's left and right half, of one size, in screen pixels; `None` where there is no room.
    fn halves(&self) -> Option<[PixelRect; 2]> {
        let window = PixelRect::of_size(self.screen.window);
        let free = self.screen.free_area.map_or(window, |free| free.intersection(&window));
        if free.width == 0 || free.height == 0 {
            return None;
        }
        let zoom = i64::from(self.settings.pixel_zoom.factor());
        let (left, top) = ((free.x + zoom - 1) / zoom, (free.y + zoom - 1) / zoom);
        let side = |from: i64, to: i64| u32::try_from(to / zoom - from).ok();
        let (width, height) = (side(left, free.right())?, side(top, free.bottom())?);
        let width = width.checked_sub(GAP)? / 2;
        let first = PixelRect {
            x: left,
            y: top,
            width,
            height,
        };
        let second = PixelRect {
            x: left + i64::from(width + GAP),
            ..first
        };
        (width > 0 && height > 0).then_some([first, second])
    }

    /// B's settings, where it is drawn.
    pub fn other_settings(&self) -> Option<RenderSettings> {
        match self.comparison.other.as_ref()? {
            Other::Settings(settings) => Some(*settings),
        }
    }

    /// Both frames on the screen, A's first; `None` while they cannot be compared.
    pub(in super::super) fn pair(&self) -> Option<[&Frame; 2]> {
        if let Some([a, b]) = &self.comparison.held {
            return Some([a, b]);
        }
        self.pair_in_step()
    }

    /// B's frame as it is on the screen or would be; it may be a preview.
    pub fn other_frame(&self) -> Option<&Frame> {
        self.comparison.other.as_ref()?;
        match &self.comparison.held {
            Some([_, b]) => Some(b),
            None => self.comparison.drawing.as_ref()?.frame(),
        }
    }

    pub(super) fn pair_in_step(&self) -> Option<[&Frame; 2]> {
        let b = self.comparison.drawing.as_ref()?.frame()?;
        let a = self.drawing.frame()?;
        a.picture.is_seen_as(&b.picture).then_some([a, b])
    }

    /// To be called before another frame is taken in: both on the screen stay until both of the next are there.
    pub(in super::super) fn hold_pair(&mut self) {
        if !self.comparison.shows_both() || self.comparison.held.is_some() || self.pair_in_step().is_none() {
            return;
        }
        let b = self.comparison.drawing.as_ref().and_then(Drawing::shared_frame);
        if let Some((a, b)) = self.drawing.shared_frame().zip(b) {
            self.comparison.held = Some([Arc::clone(a), Arc::clone(b)]);
        }
    }

    /// To be called after that: lets go of the frames before once they are not needed.
    pub(in super::super) fn release_pair(&mut self) {
        let in_step = self.pair_in_step().is_some();
        // One that never comes is not waited for.
        let other = self.comparison.drawing.as_ref();
        let coming = !self.drawing.has_arrived() || other.is_some_and(|drawing| !drawing.has_arrived());
        let needed = self.comparison.shows_both() && self.drawing.frame().is_some() && !in_step && coming;
        if self.comparison.held.is_some() && !needed {
            self.comparison.held = None;
            self.comparison.touch();
        }
    }

    /// Whether `picture` must wait until both frames have come to the last view.
    pub(in super::super) fn lags_behind(&self, picture: &Picture) -> bool {
        let Some(other) = self
            .comparison
            .drawing
            .as_ref()
            .filter(|_| self.comparison.shows_both())
        else {
            return false;
        };
        let moves = self.drawing.wanted().is_some_and(|wanted| !wanted.is_seen_as(picture));
        let same_scene = self
            .drawing
            .wanted()
            .is_some_and(|wanted| Arc::ptr_eq(&wanted.scene, &picture.scene) && wanted.size == picture.size);
        moves && same_scene && !(self.drawing.has_arrived() && other.has_arrived())
    }

    /// Wants B's frame beside A's `wish`.
    pub(in super::super) fn want_other(&mut self, wish: &Wish) {
        let Some(settings) = self.other_settings() else {
            if let Some(drawing) = &mut self.comparison.drawing {
                drawing.close();
            }
            return;
        };
        if !self.comparison.shows_both() && !self.drawing.is_current() {
            return;
        }
        if self.comparison.drawing.is_none() {
            match Drawing::start(&self.comparison.mailbox, DrawingId::Second) {
                Ok(mut drawing) => {
                    drawing.set_progressive(self.settings.progressive);
                    drawing.set_hurry(self.saver.is_waiting());
                    self.comparison.drawing = Some(drawing);
                }
                Err(error) => {
                    self.comparison.other = None;
                    self.messages.error(format!(
                        "cannot compare: no thread for B: {error}; close other programs"
                    ));
                    return;
                }
            }
        }
        let picture = Picture {
            settings: RenderSettings {
                outline: settings.outline && wish.picture.settings.outline,
                ..settings
            },
            ..wish.picture.clone()
        };
        if let Some(drawing) = &mut self.comparison.drawing {
            drawing.want(Wish::new(picture, wish.from, wish.focus));
        }
    }

    /// A and B change places: settings and frames.
    pub(super) fn swap_frames(&mut self) {
        if let Some(drawing) = &mut self.comparison.drawing {
            std::mem::swap(&mut self.drawing, drawing);
        }
        if let Some([a, b]) = &mut self.comparison.held {
            std::mem::swap(a, b);
        }
        self.comparison.touch();
        self.wait_for_newest_frame();
    }

    /// The drawing that a result came from.
    pub(in super::super) fn drawing_of(&mut self, id: DrawingId) -> Option<&mut Drawing> {
        if self.drawing.id() == id {
            return Some(&mut self.drawing);
        }
        self.comparison.drawing.as_mut().filter(|drawing| drawing.id() == id)
    }

    /// Whether somebody waits for final frames, of both.
    pub(in super::super) fn set_hurry(&mut self, hurry: bool) {
        self.drawing.set_hurry(hurry);
        if let Some(drawing) = &mut self.comparison.drawing {
            drawing.set_hurry(hurry);
        }
        self.comparison.measuring.set_hurry(hurry);
        self.want_measures();
    }

    /// Brings the colours of differences and the flipping up to date.
    pub(in super::super) fn update_comparison(&mut self) {
        self.flip_when_due();
        self.mix_paint();
        self.want_measures();
    }

    fn flip_when_due(&mut self) {
        let flips = self.comparison.other.is_some() && self.comparison.arrangement == Arrangement::Flip;
        let now = Instant::now();
        let next = now.checked_add(FLIP);
        let comparison = &mut self.comparison;
        match comparison.flip {
            _ if !flips => comparison.flip = None,
            None => comparison.flip = next.map(|next| (next, false)),
            Some((due, shows_b)) if due <= now => {
                comparison.flip = next.map(|next| (next, !shows_b));
                comparison.touch();
            }
            Some(_) => {}
        }
    }

    /// Whether B is to be seen of both that flip.
    pub fn flip_shows_b(&self) -> bool {
        matches!(self.comparison.flip, Some((_, true)))
    }

    /// When something about comparing is to be done: flipping, measuring, looking at B again.
    pub(in super::super) fn comparison_due(&self) -> Option<Instant> {
        let flip = self.comparison.flip.map(|(due, _)| due);
        let drawing = self.comparison.drawing.as_ref().and_then(Drawing::due);
        [flip, drawing, self.comparison.measuring.due()]
            .into_iter()
            .flatten()
            .min()
    }

    /// Normalised colours follow the frames once both are final: until then they stay as they are.
    fn mix_paint(&mut self) {
        let style = self.comparison.style;
        let shown = self.comparison.arrangement == Arrangement::Difference && self.comparison.other.is_some();
        if !shown {
            self.comparison.paint = None;
            return;
        }
        let normalized = style.gain == Gain::Normalize;
        let numbers = [self.drawing.number(), self.comparison.state()[1]];
        let frames = normalized.then_some(numbers);
        let known = self.comparison.paint.as_ref();
        let is_right = known.is_some_and(|paint| paint.style == style && paint.frames == frames);
        let settled = self.drawing.is_current() && self.comparison.is_current();
        if is_right || (normalized && !settled && known.is_some_and(|paint| paint.style == style)) {
            return;
        }
        let Some([a, b]) = self.pair() else { return };
        let Ok(pair) = Pair::new(&a.pixels, &b.pixels) else {
            return;
        };
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
        let pair = self.pair().filter(|_| comparison.shows_both());
        let Some([a, b]) = pair.map(|pair| pair.map(|frame| &frame.pixels)) else {
            return Composite::new(vec![(panes.first, Content::One(&frame.pixels))]);
        };
        let content = match comparison.arrangement {
            Arrangement::Alone | Arrangement::SideBySide => Content::One(a),
            Arrangement::Flip => Content::One(if self.flip_shows_b() { b } else { a }),
            Arrangement::Wipe => Content::Wipe([a, b], self.wipe_column(a)),
            Arrangement::Difference => match &comparison.paint {
                Some(paint) => Content::Difference([a, b], &paint.colors),
                None => Content::One(a),
            },
        };
        let second = panes.second.map(|pane| (pane, Content::One(b)));
        Composite::new(std::iter::once((panes.first, content)).chain(second).collect())
    }

    /// The first column of B's part.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and a frame's width"
    )]
    fn wipe_column(&self, frame: &Framebuffer) -> u32 {
        (self.comparison.wipe.clamp(0.0, 1.0) * f64::from(frame.width())).round() as u32
    }

    /// Where the line of the wipe is, in window pixels from the left; `None` where there is none.
    pub fn wipe_line(&self) -> Option<f64> {
        let wipes = self.comparison.other.is_some() && self.comparison.arrangement == Arrangement::Wipe;
        let frame = self.pair().filter(|_| wipes)?[0];
        let column = i64::from(self.wipe_column(&frame.pixels)) + self.panes().first.corner[0];
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        Some(column as f64 * zoom)
    }
}
