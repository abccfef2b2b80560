//! Which frames are wanted, how results of the threads that draw and measure are taken in, how both sides stay in step.

use std::sync::Arc;
use std::time::Instant;

use crate::compare::{Gain, Pair};
use crate::geometry::View;
use crate::raster::Region;
use crate::render::RenderSettings;
use crate::viewer::PixelRect;
use crate::viewer::ab::comparison::{Comparison, Paint};
use crate::viewer::ab::measuring::{Job, REST};
use crate::viewer::ab::other::{Arrangement, Other};
use crate::viewer::chrome::Chrome;
use crate::viewer::control::both::Both;
use crate::viewer::frames::drawing::{Drawing, DrawingId};
use crate::viewer::frames::frame::Picture;
use crate::viewer::frames::job::Drawn;
use crate::viewer::frames::request::FrameRequest;
use crate::viewer::frames::state::Frames;
use crate::viewer::inspector::PlacedInset;
use crate::viewer::library::SceneState;
use crate::viewer::library::state::SceneList;
use crate::viewer::settings::Settings;

/// The part of a rectangle of frame pixels that a frame of `size` has.
fn in_frame(rect: &PixelRect, size: [u32; 2]) -> Region {
    let inside = rect.intersection(&PixelRect::of_size(size));
    Region {
        x: u32::try_from(inside.x).unwrap_or(0),
        y: u32::try_from(inside.y).unwrap_or(0),
        width: inside.width,
        height: inside.height,
    }
}

/// What of a frame is to be final first.
#[derive(Clone, Copy, Debug)]
pub(in crate::viewer) struct Attention {
    /// The frame pixel that somebody looks at.
    pub(in crate::viewer) at: [u32; 2],
    /// The inset that magnifies it.
    pub(in crate::viewer) inset: Option<PlacedInset>,
}

/// The drawings of A and B, and what decides which frames they draw.
#[derive(Debug)]
pub(in crate::viewer) struct Drawings<'a> {
    pub(in crate::viewer) settings: &'a Settings,
    pub(in crate::viewer) chrome: &'a mut Chrome,
    pub(in crate::viewer) scene_list: &'a SceneList,
    pub(in crate::viewer) frames: &'a mut Frames,
    pub(in crate::viewer) ab: &'a mut Comparison,
    pub(in crate::viewer) attention: Attention,
}

impl Drawings<'_> {
    fn both(&self) -> Both<'_> {
        Both::new(self.settings, self.chrome, self.scene_list, self.frames, self.ab)
    }

    /// Takes in what a drawing has to say.
    pub(in crate::viewer) fn take_in(&mut self, id: DrawingId, drawn: Drawn) {
        self.hold_pair();
        let drawing = self.drawing_of(id);
        let failed = drawing.is_some_and(|drawing| drawing.finished(drawn) && drawing.has_failed());
        self.release_pair();
        if failed {
            self.chrome.messages.error(format!(
                "{}: drawing this view failed inside the program; please report it with the file",
                self.scene_list.label()
            ));
        }
    }

    /// Whether coarse pictures may stand in for slow ones, as the settings say.
    pub(in crate::viewer) fn follow_settings(&mut self) {
        let progressive = self.settings.progressive;
        self.frames.drawing.set_progressive(progressive);
        if let Some(drawing) = self.ab.drawing_mut() {
            drawing.set_progressive(progressive);
        }
    }

    /// Starts what is due.
    pub(in crate::viewer) fn look(&mut self) {
        self.frames.drawing.look();
        if let Some(drawing) = self.ab.drawing_mut() {
            drawing.look();
        }
    }

    /// Asks for the frame of the current state. A minimised window keeps the one it has.
    pub(in crate::viewer) fn want_frame(&mut self) {
        self.ab.forget_postponed();
        let surface = self.frames.surface_pool.is_some() && self.both().shows_plain_frame();
        self.frames.drawing.lend_surface(surface);
        if let Some(other) = self.ab.drawing_mut() {
            other.lend_surface(false);
        }
        let both = self.both();
        let size = both.layout.frame_size();
        let Some(entry) = self.scene_list.current() else {
            return self.clear_frames();
        };
        if entry.has_no_picture() {
            return self.clear_frames();
        }
        let Some((scene, context)) = entry.scene().cloned().zip(both.view_context()) else {
            // Being read for the first time: the old picture stays until the new one is there.
            return;
        };
        if size.contains(&0) {
            return;
        }
        let picture = Picture {
            scene,
            document: entry.document,
            view: entry.camera.transform(&context),
            settings: RenderSettings {
                outline: self.settings.render.outline && entry.camera.view() != View::Canvas,
                ..self.settings.render
            },
            size,
        };
        if self.both().lags_behind(&picture) {
            return;
        }
        let inset = self.attention.inset;
        let focus = inset.map(|placed| in_frame(&placed.inset.source(), size));
        let request = FrameRequest::new(picture, self.attention.at, focus);
        self.frames.drawing.want(request.clone());
        self.want_other(&request);
        self.release_pair();
    }

    fn clear_frames(&mut self) {
        self.frames.drawing.clear();
        if let Some(drawing) = self.ab.drawing_mut() {
            drawing.clear();
        }
        self.release_pair();
    }

    /// Wants B's frame beside A's `request`.
    fn want_other(&mut self, request: &FrameRequest) {
        let failed = self.ab.own_dialect_of_b(self.settings).is_some()
            && matches!(
                self.scene_list.current().map(|entry| &entry.other_state),
                Some(SceneState::Failed { .. })
            );
        if self.ab.other_settings(self.settings).is_none() || failed {
            if let Some(drawing) = &mut self.ab.drawing {
                drawing.close();
            }
            return;
        }
        // While its scene is read, what is there of B stays.
        let Some(picture) = self.both().other_picture(&request.picture) else {
            return;
        };
        if !self.ab.shows_both() {
            if !self.frames.drawing.is_current() {
                return;
            }
            // What nobody sees must not slow down the hand.
            let rest = self.frames.drawing.rest().filter(|rest| *rest > Instant::now());
            if rest.is_some() && !self.ab.measuring.hurries() {
                self.ab.postponed = rest;
                return;
            }
        }
        if self.ab.drawing.is_none() {
            match Drawing::start(self.ab.drawn.clone(), DrawingId::Second) {
                Ok(mut drawing) => {
                    drawing.set_progressive(self.settings.progressive);
                    drawing.set_hurry(self.ab.measuring.hurries());
                    self.ab.drawing = Some(drawing);
                }
                Err(error) => {
                    self.ab.other = None;
                    self.chrome.messages.error(format!(
                        "cannot compare: no thread for B: {error}; close other programs"
                    ));
                    return;
                }
            }
        }
        if let Some(drawing) = &mut self.ab.drawing {
            drawing.want(FrameRequest::new(picture, request.from, request.focus));
        }
    }

    /// To be called before another frame is taken in: both on the screen stay until both of the next are there.
    fn hold_pair(&mut self) {
        if !self.ab.shows_both() || self.ab.held.is_some() || self.both().pair_in_step().is_none() {
            return;
        }
        let b = self.ab.drawn_other().and_then(Drawing::shared_frame);
        if let Some((a, b)) = self.frames.drawing.shared_frame().zip(b) {
            self.ab.held = Some([Arc::clone(a), Arc::clone(b)]);
        }
    }

    /// To be called after that: lets go of the frames before once they are not needed.
    fn release_pair(&mut self) {
        let in_step = self.both().pair_in_step().is_some();
        // One that never comes is not waited for.
        let other = self.ab.drawn_other();
        let coming = !self.frames.drawing.has_arrived() || other.is_some_and(|drawing| !drawing.has_arrived());
        let needed = self.ab.shows_both() && self.frames.drawing.frame().is_some() && !in_step && coming;
        if self.ab.held.is_some() && !needed {
            self.ab.held = None;
            self.ab.touch();
        }
    }

    /// The drawing that a result came from.
    fn drawing_of(&mut self, id: DrawingId) -> Option<&mut Drawing> {
        if self.frames.drawing.id() == id {
            return Some(&mut self.frames.drawing);
        }
        self.ab.drawing.as_mut().filter(|drawing| drawing.id() == id)
    }

    /// Whether somebody waits for final frames, of both.
    pub(in crate::viewer) fn set_hurry(&mut self, hurry: bool) {
        self.frames.drawing.set_hurry(hurry);
        if let Some(drawing) = &mut self.ab.drawing {
            drawing.set_hurry(hurry);
        }
        self.ab.measuring.set_hurry(hurry);
        if hurry && self.ab.postponed.is_some() {
            self.want_frame();
        }
        self.want_measures();
    }

    /// Brings the colours of differences and the flipping up to date.
    pub(in crate::viewer) fn update_comparison(&mut self) {
        self.ab.flip_when_due();
        self.mix_paint();
        self.note_stages();
        self.want_measures();
    }

    /// Where a frame becomes final, or begins to be drawn anew, the hatch of the difference may change everywhere.
    fn note_stages(&mut self) {
        let is_difference = self.ab.arrangement() == Arrangement::Difference;
        let stages = is_difference.then(|| self.both().refining().qualities());
        if self.ab.stages != stages {
            self.ab.stages = stages;
            self.ab.touch();
        }
    }

    /// Normalised colours follow the frames once both are final: until then they stay as they are.
    fn mix_paint(&mut self) {
        let style = self.ab.style;
        if self.ab.arrangement() != Arrangement::Difference {
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
        let Some([a, b]) = self.both().pair() else { return };
        let Ok(pair) = Pair::new(a, b) else { return };
        let colors = pair.paint(style);
        self.ab.paint = Some(Paint { colors, style, frames });
        self.ab.touch();
    }

    /// Finds out how far both are apart once they rest.
    fn want_measures(&mut self) {
        if self.ab.other.is_none() {
            return self.ab.measuring.close();
        }
        let which = self.both().measurable();
        let measuring = &mut self.ab.measuring;
        let Some(which) = which else {
            measuring.wanted = None;
            return measuring.cancel();
        };
        if measuring.running.as_ref().is_some_and(|(running, _)| *running != which) {
            measuring.cancel();
        }
        if measuring.wanted.is_none_or(|(wanted, _)| wanted != which) {
            measuring.wanted = Some((which, Instant::now()));
        }
        let waits = measuring.hurry || measuring.jumps;
        let rests = measuring.wanted.is_some_and(|(_, since)| since.elapsed() >= REST);
        if measuring.running.is_some() || measuring.complete == Some(which) || !(waits || rests) {
            return;
        }
        let Some(pictures) = self.both().shared_pair() else {
            return;
        };
        let is_outside = matches!(self.ab.other, Some(Other::Picture(_)));
        let job = Job {
            which,
            pictures,
            subject: self
                .frames
                .frame()
                .filter(|_| is_outside)
                .map(|frame| frame.picture.clone()),
            cancel: Arc::default(),
        };
        if let Err(error) = self.ab.measuring.start(job) {
            self.ab.measuring.complete = Some(which);
            self.chrome
                .messages
                .error(format!("cannot measure A against B: {error}; close other programs"));
        }
    }
}
