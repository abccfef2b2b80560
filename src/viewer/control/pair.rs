//! B's frame beside A's: both show the same scene from the same place.

use std::sync::Arc;
use std::time::Instant;

use crate::raster::Framebuffer;
use crate::render::RenderSettings;
use crate::scene::DialectChoice;
use crate::viewer::ab::measuring::SharedPicture;
use crate::viewer::ab::other::Other;
use crate::viewer::frames::drawing::{Drawing, DrawingId};
use crate::viewer::frames::frame::Picture;
use crate::viewer::frames::request::FrameRequest;
use crate::viewer::library::SceneState;
use crate::viewer::state::Viewer;

impl Viewer {
    /// B's settings, where it is drawn.
    pub fn other_settings(&self) -> Option<RenderSettings> {
        match self.ab.other.as_ref()? {
            Other::Settings { render, .. } => Some(*render),
            Other::Truth(resolve) => {
                let own = self.settings.render;
                Some(RenderSettings {
                    resolve: resolve.unwrap_or(own.resolve),
                    ..own.truth()
                })
            }
            Other::Picture(_) => None,
        }
    }

    /// The dialect that B's scene is read in, where that is not A's.
    pub fn own_dialect_of_b(&self) -> Option<DialectChoice> {
        match self.ab.other.as_ref()? {
            Other::Settings { dialect, .. } => Some(*dialect).filter(|dialect| *dialect != self.settings.dialect),
            Other::Truth(_) | Other::Picture(_) => None,
        }
    }

    /// What B shows where A shows `own`; `None` unless B is drawn, and while its scene is being read.
    pub(in crate::viewer) fn other_picture(&self, own: &Picture) -> Option<Picture> {
        let settings = self.other_settings()?;
        let scene = match self.own_dialect_of_b() {
            None => Arc::clone(&own.scene),
            Some(_) => Arc::clone(self.current()?.other_state.scene()?),
        };
        let outline = settings.outline && own.settings.outline;
        Some(Picture {
            settings: RenderSettings { outline, ..settings },
            scene,
            ..own.clone()
        })
    }

    /// Both pictures on the screen, the one in front first; `None` while they cannot be compared.
    pub(in crate::viewer) fn pair(&self) -> Option<[&Framebuffer; 2]> {
        let [a, b] = match &self.ab.held {
            Some([a, b]) => [&a.pixels, &b.pixels],
            None => self.pair_in_step()?,
        };
        Some(if self.ab.swapped { [b, a] } else { [a, b] })
    }

    /// B's pixels as they are on the screen or would be; they may be a preview's.
    pub fn other_pixels(&self) -> Option<&Framebuffer> {
        match (self.ab.other.as_ref()?, &self.ab.held) {
            (Other::Picture(picture), _) => Some(&picture.pixels),
            (_, Some([_, b])) => Some(&b.pixels),
            (_, None) => Some(&self.ab.drawing.as_ref()?.frame()?.pixels),
        }
    }

    /// A pixel of B, straight `[r, g, b, a]`, if it is final.
    pub(in crate::viewer) fn other_final_rgba(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        match (self.ab.other.as_ref()?, &self.ab.held) {
            (Other::Picture(picture), _) => picture.pixels.rgba(x, y),
            (_, Some([_, b])) => b.final_rgba(x, y),
            (_, None) => self.ab.drawing.as_ref()?.frame()?.final_rgba(x, y),
        }
    }

    /// A's pixels and B's, where they show the scene from the same place.
    pub(in crate::viewer) fn pair_in_step(&self) -> Option<[&Framebuffer; 2]> {
        let a = self.frames.drawing.frame()?;
        if let Some(Other::Picture(picture)) = &self.ab.other {
            let size = [picture.pixels.width(), picture.pixels.height()];
            return (a.picture.size == size).then_some([&a.pixels, &picture.pixels]);
        }
        let b = self.ab.drawing.as_ref()?.frame()?;
        let in_step = match self.own_dialect_of_b() {
            None => a.picture.is_seen_as(&b.picture),
            Some(_) => a.picture.shows_document_of(&b.picture),
        };
        in_step.then_some([&a.pixels, &b.pixels])
    }

    /// The same for threads.
    pub(in crate::viewer) fn shared_pair(&self) -> Option<[SharedPicture; 2]> {
        self.pair_in_step()?;
        let a = Arc::clone(self.frames.drawing.shared_frame()?) as SharedPicture;
        let b = match self.ab.other.as_ref()? {
            Other::Picture(picture) => Arc::clone(picture) as SharedPicture,
            _ => Arc::clone(self.ab.drawing.as_ref()?.shared_frame()?) as SharedPicture,
        };
        Some([a, b])
    }

    /// To be called before another frame is taken in: both on the screen stay until both of the next are there.
    pub(in crate::viewer) fn hold_pair(&mut self) {
        if !self.ab.shows_both() || self.ab.held.is_some() || self.pair_in_step().is_none() {
            return;
        }
        let b = self.ab.drawn_other().and_then(Drawing::shared_frame);
        if let Some((a, b)) = self.frames.drawing.shared_frame().zip(b) {
            self.ab.held = Some([Arc::clone(a), Arc::clone(b)]);
        }
    }

    /// To be called after that: lets go of the frames before once they are not needed.
    pub(in crate::viewer) fn release_pair(&mut self) {
        let in_step = self.pair_in_step().is_some();
        // One that never comes is not waited for.
        let other = self.ab.drawn_other();
        let coming = !self.frames.drawing.has_arrived() || other.is_some_and(|drawing| !drawing.has_arrived());
        let needed = self.ab.shows_both() && self.frames.drawing.frame().is_some() && !in_step && coming;
        if self.ab.held.is_some() && !needed {
            self.ab.held = None;
            self.ab.touch();
        }
    }

    /// Whether `picture` must wait until both frames have come to the last view.
    pub(in crate::viewer) fn lags_behind(&self, picture: &Picture) -> bool {
        let Some(other) = self.ab.drawn_other().filter(|_| self.ab.shows_both()) else {
            return false;
        };
        let moves = self
            .frames
            .drawing
            .wanted()
            .is_some_and(|wanted| !wanted.is_seen_as(picture));
        let same_scene = self
            .frames
            .drawing
            .wanted()
            .is_some_and(|wanted| Arc::ptr_eq(&wanted.scene, &picture.scene) && wanted.size == picture.size);
        moves && same_scene && !(self.frames.drawing.has_arrived() && other.has_arrived())
    }

    /// Wants B's frame beside A's `request`.
    pub(in crate::viewer) fn want_other(&mut self, request: &FrameRequest) {
        let failed = self.own_dialect_of_b().is_some()
            && matches!(
                self.current().map(|entry| &entry.other_state),
                Some(SceneState::Failed { .. })
            );
        if self.other_settings().is_none() || failed {
            if let Some(drawing) = &mut self.ab.drawing {
                drawing.close();
            }
            return;
        }
        // While its scene is read, what is there of B stays.
        let Some(picture) = self.other_picture(&request.picture) else {
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

    /// A and B change places: settings and frames.
    pub(in crate::viewer) fn swap_frames(&mut self) {
        if let Some(drawing) = &mut self.ab.drawing {
            std::mem::swap(&mut self.frames.drawing, drawing);
        }
        if let Some([a, b]) = &mut self.ab.held {
            std::mem::swap(a, b);
        }
        self.ab.swaps += 1;
        self.ab.touch();
        self.wait_for_newest_frame();
    }

    /// The drawing that a result came from.
    pub(in crate::viewer) fn drawing_of(&mut self, id: DrawingId) -> Option<&mut Drawing> {
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
}
