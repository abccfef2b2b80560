//! The pinned pixel while panels come and go: it stays what it is, and in sight.

use glam::DVec2;

use crate::viewer::InspectorCommand;
use crate::viewer::PixelRect;
use crate::viewer::ab::other::Arrangement;
use crate::viewer::control::hand::Hand;
use crate::viewer::inspector::pin::InsetSurroundings;
use crate::viewer::inspector::{Pin, Reveal};
use crate::viewer::settings::Toggle;
use crate::viewer::view::camera::ViewContext;
use crate::viewer::view::panes::Panes;

/// What is said about pixels of a scene that could not be read.
const NO_PICTURE: &str = "no picture to explain: this scene could not be read";

/// How words begin that say which pixel is pinned instead of one beside the picture.
const NO_PIXEL: &str = "no pixel";

/// Frame pixels that stay free beside a pinned one in a frame that becomes smaller.
const PIN_ROOM: i64 = 24;

/// Probing samples of a scene with this many primitives takes less than a millisecond: dots that come at once do not flicker.
const FEW: usize = 4000;

/// What a camera looks at, and where its frame lies.
struct FrameInWindow {
    context: ViewContext,
    panes: Panes,
}

impl Hand<'_> {
    pub(in crate::viewer) fn apply_inspector(&mut self, command: InspectorCommand) {
        let magnifier = &mut self.inspector.magnifier;
        match command {
            InspectorCommand::Show(toggle) => self.inspector.show(toggle, self.chrome),
            InspectorCommand::SetRegion(region) => magnifier.set_region(region),
            InspectorCommand::SetMagnification(magnification) => magnifier.set_magnification(magnification),
            InspectorCommand::StepMagnification(steps) => magnifier.step(steps),
            InspectorCommand::PinUnderPointer => self.pin_under_pointer(),
            InspectorCommand::Pin(pixel) => self.pin_or_nearest(pixel),
            InspectorCommand::PinEdge => self.pin_edge(),
            InspectorCommand::Nudge(by) => self.inspector.nudge(by, &self.layout(), self.chrome),
            InspectorCommand::Unpin => magnifier.pin = None,
            InspectorCommand::PointAtTexel(texel) => self.inspector.pointed_texel = texel,
            InspectorCommand::Explanation(toggle) => self.show_explanation(toggle),
        }
    }

    /// Places canvas, pin and insets where the window has them now. The steps of a lesson have views of their own.
    pub(in crate::viewer) fn place(&mut self, shows_step: bool) {
        let layout = self.layout();
        // A pinned pixel is to stay what it is: while there is one in this scene, no other scale comes.
        let scene = self.scene_list.identity();
        let rests = |pin: Pin| pin.place.is_none_or(|(_, of)| of == scene);
        if !self.inspector.magnifier.pin.is_some_and(rests) && !shows_step {
            self.scene_list.follow_free_part(&layout);
        }
        self.keep_pin_in_place();
        self.profiling.keep_in_place(self.scene_list, &layout);
        self.inspector.place_insets(&InsetSurroundings {
            ab: self.ab,
            scenes: self.scene_list,
            layout: &layout,
            hidden: self.chrome.hidden,
        });
    }

    /// Asks what is to be found out about the pixel in the inspector, for the frame on the screen.
    pub(in crate::viewer) fn want_answers(&mut self) {
        let pixels = self.pixels();
        let explains = pixels.explains();
        let center = self.inspector.inset.map(|placed| placed.inset.center);
        let center = center.and_then(|center| pixels.both.layout.in_frame(center));
        let probed = center.and_then(|pixel| pixels.target(pixel));
        // While the picture moves the last explanation stays: finding out others would only slow the picture down.
        let moves = explains && !self.frames.drawing.is_current();
        let pinned = pixels.pinned().filter(|_| explains);
        let asked = pinned.filter(|_| !moves).and_then(|pixel| pixels.question(pixel));
        let contributing = pinned.filter(|_| self.inspector.pointed_texel.is_some());
        let contributing = contributing.and_then(|pixel| pixels.target(pixel));
        self.inspector.samples.want(probed, |target| {
            (target.picture.scene.primitives.len() <= FEW).then(|| target.probe())
        });
        if !moves {
            self.inspector.explanation.want(asked, |_| None);
        }
        if !explains {
            self.inspector.pointed_texel = None;
        }
        self.inspector.contributions.want(contributing, |_| None);
    }

    /// Pins a pixel that was named; where the picture does not reach it, the nearest, and says so.
    fn pin_or_nearest(&mut self, pixel: [i64; 2]) {
        let layout = self.layout();
        self.pin(pixel);
        if let Some(nearest) = layout
            .nearest_in_frame(pixel)
            .filter(|_| layout.in_frame(pixel).is_none())
        {
            let [width, height] = layout.frame_size();
            let ([x, y], [near_x, near_y]) = (pixel, nearest);
            self.chrome.messages.done(format!(
                "{NO_PIXEL} ({x}, {y}) in a picture of {width} x {height}: pinned its nearest, ({near_x}, {near_y})"
            ));
        }
    }

    fn pin(&mut self, pixel: [i64; 2]) {
        self.chrome.messages.retract(NO_PIXEL);
        self.inspector.pin(pixel, &self.layout(), self.chrome);
    }

    /// The pinned place of the scene falls into another pixel where the view is another.
    pub(in crate::viewer) fn keep_pin_in_place(&mut self) {
        let layout = self.layout();
        self.inspector
            .keep_pin_in_place(self.scene_list, &layout, &mut self.chrome.messages);
    }

    /// Pins the hovered pixel; without one the pixel that the inspector shows, or the one in the middle. Whoever points at a pixel asks about it: the
    /// explanation opens, too, where it was closed. Only a pixel that is explained already is unpinned, and the inspector
    /// closes with it if the pin opened it.
    pub(in crate::viewer) fn pin_under_pointer(&mut self) {
        let hovered = self.pixels().hovered();
        if hovered.is_none() && self.pixels().over_inset() {
            // The magnifier's frame and its words show no pixel.
            return;
        }
        let Some(pixel) = self.pixels().asked_about() else {
            return;
        };
        if self.refuses_to_explain() {
            return;
        }
        let through_inset = self.pixels().over_inset();
        let same_click = self.pointer.pinned_through_inset.take() == Some(self.inspector.magnifier.pins);
        let is_pinned = self.pixels().pinned() == Some(pixel) || self.pixels().slid_away() || same_click;
        if is_pinned && self.pixels().explains() {
            self.inspector.magnifier.pin = None;
            self.inspector.magnifier.open &= !std::mem::take(&mut self.inspector.magnifier.came_with_pin);
        } else {
            self.chrome.shown.explanation = true;
            self.inspector.magnifier.asked = true;
            let asked_at = self.pixels().place_asked_about();
            self.pin(pixel.map(i64::from));
            self.inspector.magnifier.asked_at = asked_at;
            self.pointer.pinned_through_inset = through_inset.then_some(self.inspector.magnifier.pins);
        }
    }

    /// Pins a pixel near the middle of the free picture that an edge makes wrong, and explains it; where none is, one that
    /// differs from a neighbour, or the one in the middle.
    fn pin_edge(&mut self) {
        if self.refuses_to_explain() {
            return;
        }
        let pixel = self.both().edge();
        self.chrome.shown.explanation = true;
        self.inspector.magnifier.asked = true;
        self.pin(pixel);
    }

    /// Shows or hides the explanation. The switch goes by what is to be seen: it never closes what nobody sees, and where no
    /// pixel is pinned it pins one, since it would seem to do nothing otherwise.
    fn show_explanation(&mut self, toggle: Toggle) {
        let shown = toggle.of(self.pixels().has_explanation_open());
        if toggle == Toggle::Flip && self.refuses_to_explain() {
            return;
        }
        self.inspector.magnifier.asked |= shown;
        self.chrome.shown.explanation = shown;
        if !shown || toggle != Toggle::Flip {
            return;
        }
        if self.pixels().pinned().is_some() {
            (self.inspector.magnifier.open, self.chrome.hidden) = (true, false);
        } else if let Some(pixel) = self.pixels().asked_about() {
            self.pin(pixel.map(i64::from));
        }
    }

    /// Tells whoever asks about a pixel that there is no picture; false where there is one.
    fn refuses_to_explain(&mut self) -> bool {
        let has_none = self.scene_list.has_no_picture();
        if has_none {
            self.chrome.messages.error(NO_PICTURE.to_owned());
        }
        has_none
    }

    /// Another part of the window is free. Where frames change their size with it, the pixel that a hand asked about stays
    /// what it is, to the place of its samples, and where it is, if its half still reaches there; the view comes back when
    /// the explanation is closed.
    pub(in crate::viewer) fn set_free_area(&mut self, area: Option<PixelRect>) {
        let (before, panes) = (self.both().view_context(), self.layout().panes());
        // Before: a smaller frame may leave its pixel outside.
        let asks = self.inspector.magnifier.asked && self.pixels().explains();
        self.chrome.free_area = area;
        if self.ab.arrangement() == Arrangement::Wipe {
            // Its line gives way to panels.
            self.ab.touch();
        }
        self.keep_fixed_in_place(&panes, asks);
        let contexts = before.zip(self.both().view_context());
        if let Some((before, context)) = contexts.filter(|(before, context)| asks && before.frame != context.frame) {
            let before = FrameInWindow { context: before, panes };
            let now = FrameInWindow {
                context,
                panes: self.layout().panes(),
            };
            self.keep_view_of_pin(&before, &now);
        }
        if let Some(views) = self.inspector.magnifier.kept_view.take_if(|_| !asks) {
            let layout = self.layout();
            self.scene_list.look_back(layout.frame_size(), views);
            // The window may have another size than when the view was left.
            self.scene_list.follow_free_part(&layout);
        }
    }

    /// The window has another size. A view that no hand has moved rests while a hand asks about a pixel, and fits the window that
    /// there is then as soon as the explanation is closed.
    pub(in crate::viewer) fn rest_in_another_window(&mut self) {
        let asks = self.inspector.magnifier.asked && self.pixels().has_explanation_open();
        let Some(camera) = self.scene_list.camera().filter(|camera| asks && camera.is_untouched()) else {
            return;
        };
        let kept = &mut self.inspector.magnifier.kept_view;
        if kept.is_none_or(|[_, set]| set != camera) {
            *kept = Some([camera; 2]);
        }
    }

    /// Keeps pictures with a size of their own where they were `before`, while a hand asks about a pixel of theirs that is to be
    /// seen there; afterwards they go back to where they belong.
    fn keep_fixed_in_place(&mut self, before: &Panes, asks: bool) {
        let Some(frame) = self.ab.fixed_size() else { return };
        if !asks {
            self.ab.moved.let_go();
            return;
        }
        let in_second = self.inspector.magnifier.asked_at.is_some_and(|asked| asked.in_second);
        let pane = |panes: &Panes| panes.second.filter(|_| in_second).unwrap_or(panes.first);
        let (old, now) = (pane(before), pane(&self.layout().panes()));
        let seen = |[x, y]: [u32; 2]| {
            now.area
                .contains([i64::from(x) + old.corner[0], i64::from(y) + old.corner[1]])
        };
        if self.pixels().pinned().is_some_and(seen) {
            let by = DVec2::from([0, 1].map(|axis| (old.corner[axis] - now.corner[axis]) as f64));
            self.ab.moved.keep(by, &now.area, frame);
            self.ab.touch();
        } else if old.corner != now.corner {
            self.ab.moved.slide();
        }
    }

    /// Sets the view in which the pinned pixel shows what it showed `before`, at the same place of the window if its pane has
    /// that, else as near as may be.
    fn keep_view_of_pin(&mut self, before: &FrameInWindow, now: &FrameInWindow) {
        let Some(Pin {
            pixel,
            place: Some((place, _)),
            ..
        }) = self.inspector.magnifier.pin
        else {
            return;
        };
        let Some(camera) = self.scene_list.camera() else {
            return;
        };
        let context = &now.context;
        let in_second = self.inspector.magnifier.asked_at.is_some_and(|asked| asked.in_second);
        let corner = |panes: &Panes| panes.second.filter(|_| in_second).unwrap_or(panes.first).corner;
        let (old, new) = (corner(&before.panes), corner(&now.panes));
        let stays = |axis: usize| {
            let room = |beside: i64| beside.min(PIN_ROOM);
            let behind = i64::from(before.context.frame[axis]) - 1 - pixel[axis];
            let last = i64::from(context.frame[axis]) - 1 - room(behind);
            let wanted = pixel[axis] + old[axis] - new[axis];
            wanted.max(room(pixel[axis])).min(last).max(0) as f64 + 0.5
        };
        let at = DVec2::new(stays(0), stays(1));
        let mut kept = camera;
        kept.set(camera.numbers(&before.context), context);
        kept.pan(at - kept.transform(context).to_pixels(place), context);
        let first = match self.inspector.magnifier.kept_view {
            Some([first, set]) if set == camera => first,
            _ => camera,
        };
        self.inspector.magnifier.kept_view = Some([first, kept]);
        self.scene_list.look(context.frame, |camera, _| *camera = kept);
    }

    /// Moves the picture so that a pixel that was jumped to lies in the middle of what is free, where a panel covers it.
    pub(in crate::viewer) fn reveal_pin(&mut self) {
        let Some(pixel) = self
            .pixels()
            .pinned()
            .filter(|_| self.inspector.magnifier.reveal.is_some())
        else {
            return;
        };
        let layout = self.layout();
        let (free, shown) = (layout.free_window(), layout.shown_at(pixel));
        if free.width == 0 || free.height == 0 || free.contains([shown.x, shown.y]) {
            return;
        }
        let zoom = f64::from(layout.zoom());
        let middle =
            DVec2::new(free.x as f64, free.y as f64) + DVec2::new(f64::from(free.width), f64::from(free.height)) / 2.0;
        let by = middle - DVec2::new(shown.x as f64, shown.y as f64);
        // The place that was pinned moves along.
        self.keep_pin_in_place();
        // By whole frame pixels, so that the pinned one stays what it is.
        let before = self.scene_list.camera();
        self.viewing().pan((by / zoom).round() * zoom);
        self.keep_pin_in_place();
        let both = before.zip(self.scene_list.camera());
        let resized = self.inspector.magnifier.reveal == Some(Reveal::Resized);
        let comes_back = resized && self.inspector.magnifier.asked && self.pixels().explains();
        if let Some((before, now)) = both.filter(|_| comes_back) {
            // Nobody asked for another view: the one before comes back with the end of the explanation.
            let kept = self.inspector.magnifier.kept_view.filter(|[_, set]| *set == before);
            self.inspector.magnifier.kept_view = Some([kept.map_or(before, |[first, _]| first), now]);
        }
    }

    /// Goes to the pixel that differs most, or from there to the next, as soon as both are measured.
    pub(in crate::viewer) fn jump(&mut self) {
        if !self.ab.measuring.jumps {
            return;
        }
        let next = self.pixels().pinned_difference().map_or(0, |place| place + 1);
        let Some((measures, true)) = self.both().measures() else {
            return;
        };
        let place = measures.places.get(next).or(measures.places.first()).copied();
        self.ab.measuring.jumps = false;
        match place {
            Some(place) => {
                self.pin(place.at.map(i64::from));
                self.inspector.magnifier.reveal = Some(Reveal::Jumped);
                self.reveal_pin();
            }
            None => self
                .chrome
                .messages
                .done("A and B are equal in this view: no pixel differs".to_owned()),
        }
    }
}
