//! The pointer, the pixels under it, the pin, and what they say.

use glam::DVec2;

use super::comparison::Panes;
use super::inspector::{Pin, RING_ROOM};
use super::{Arrangement, PixelLabel, PixelRect, PlacedInset, PointerButton, Sight, Status, Viewer};
use crate::figure::is_dark;

/// What is said when the pinned place leaves the window, and with it its ring and its explanation.
pub(super) const PIN_OUTSIDE: &str =
    "the pinned pixel is outside the window now: it comes back with the view, or pin another one";

/// Frame pixels that stay free beside a pinned one in a frame that becomes smaller.
const PIN_ROOM: i64 = 24;

/// Where the pointer is and what it does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Pointer {
    /// Window pixels; `None` outside the window or over a panel.
    pub(super) at: Option<DVec2>,
    /// Whether a drag moves the picture.
    pub(super) dragging: bool,
}

impl Viewer {
    /// The pointer in window pixels; `None` outside the window or over a panel.
    pub fn pointer(&self) -> Option<DVec2> {
        self.pointer.at
    }

    /// Whether the pointer is over the inspector's inset.
    pub fn pointer_over_inset(&self) -> bool {
        self.pointer
            .at
            .is_some_and(|at| self.inset_at(window_pixel(at)).is_some())
    }

    /// The inset that lies over a window pixel, A's or B's.
    pub(super) fn inset_at(&self, at: [i64; 2]) -> Option<PlacedInset> {
        let mut insets = self.inset.into_iter().chain(self.other_inset);
        insets.find(|placed| placed.rect.contains(at))
    }

    /// Whether a drag is moving the picture.
    pub fn is_dragging(&self) -> bool {
        self.pointer.dragging
    }

    /// The frame pixel under the pointer: over the inset the magnified one.
    pub fn hovered_pixel(&self) -> Option<[u32; 2]> {
        let at = window_pixel(self.pointer.at?);
        let pixel = match self.inset_at(at) {
            Some(inset) => inset.pixel_at(at)?,
            None => self.frame_pixel(at),
        };
        self.in_frame(pixel)
    }

    /// The pinned pixel; `None` too while the pinned place of the scene is outside the frame.
    pub fn pinned_pixel(&self) -> Option<[u32; 2]> {
        self.in_frame(self.inspector.pin?.pixel)
    }

    /// Keeps the pin at its place in the scene, whatever the view and the window do. Another scene has other places: there
    /// it stays at its pixel.
    pub(super) fn keep_pin_in_place(&mut self) {
        let Some(mut pin) = self.inspector.pin else { return };
        let Some(sight) = self.sight().filter(|sight| !sight.frame.contains(&0)) else {
            return;
        };
        let Some(entry) = self.current() else { return };
        let scene = (self.current, self.generation);
        let view = entry.camera.transform(&sight);
        match pin.place {
            Some((place, of)) if of == scene => {
                let before = self.in_frame(pin.pixel);
                pin.pixel = window_pixel(view.to_pixels(place));
                if before.is_some() && self.in_frame(pin.pixel).is_none() {
                    self.messages.done(PIN_OUTSIDE.to_owned());
                }
            }
            _ => {
                let centre = DVec2::new(pin.pixel[0] as f64, pin.pixel[1] as f64) + 0.5;
                pin.place = Some((view.to_scene(centre), scene));
            }
        }
        self.inspector.pin = Some(pin);
    }

    /// The pixel in the middle of the inspector: the pinned one, else the one last under the pointer, else the one in
    /// the middle of the frame.
    pub fn inspected_pixel(&self) -> Option<[u32; 2]> {
        let middle = self.frame_size().map(|side| i64::from(side / 2));
        let free = self.inspector.last.map_or(middle, |pixel| pixel.map(i64::from));
        self.pinned_pixel().or_else(|| self.nearest_in_frame(free))
    }

    /// The pixel that the status line tells about: under the pointer, else pinned.
    pub fn status(&self) -> Option<Status> {
        self.status_of(self.hovered_pixel().or(self.pinned_pixel())?)
    }

    /// A frame pixel in numbers; `None` before the scene was read.
    pub fn status_of(&self, pixel: [u32; 2]) -> Option<Status> {
        let sight = self.sight()?;
        let camera = &self.current()?.camera;
        let centre = DVec2::from(pixel.map(f64::from)) + 0.5;
        Some(Status {
            pixel,
            user: camera.transform(&sight).to_scene(centre),
            rgba: self.frame().and_then(|frame| frame.final_rgba(pixel[0], pixel[1])),
            scale: camera.numbers(&sight).scale,
        })
    }

    /// The same pixel of B in numbers; `None` without B.
    pub fn other_status_of(&self, pixel: [u32; 2]) -> Option<Status> {
        let [x, y] = pixel;
        Some(Status {
            rgba: Some(self.other_final_rgba(x, y)?),
            ..self.status_of(pixel)?
        })
    }

    /// The numbers to write on the inset's pixels when a character is `[width, height]` window pixels; none where
    /// they do not fit, and none on the pixel in the middle where its samples are drawn there.
    pub fn pixel_labels(&self, character: [f32; 2]) -> Vec<PixelLabel> {
        let has_marks = !self.pixel_samples().is_empty();
        let own = self.inset.zip(self.frame());
        let labels = own.map(|(placed, frame)| {
            let has_marks = has_marks && !placed.inset.has_detail();
            self.labels_of(&placed, &|x, y| frame.final_rgba(x, y), (character, has_marks))
        });
        let other = |x, y| self.other_final_rgba(x, y);
        let others = self
            .other_inset
            .map(|placed| self.labels_of(&placed, &other, (character, false)));
        labels.into_iter().chain(others).flatten().collect()
    }

    /// The numbers on one inset's pixels, but on the pixel in the middle where it has marks.
    fn labels_of(
        &self,
        placed: &PlacedInset,
        rgba: &dyn Fn(u32, u32) -> Option<[u8; 4]>,
        (character, has_marks): ([f32; 2], bool),
    ) -> Vec<PixelLabel> {
        if !placed.labels_fit(character) {
            return Vec::new();
        }
        let source = placed.inset.source();
        let marked = Some(placed.inset.center).filter(|_| has_marks);
        let all = (source.y..source.bottom()).flat_map(|y| (source.x..source.right()).map(move |x| [x, y]));
        let label = |pixel: [i64; 2]| {
            let block = placed.block(pixel)?;
            let pixel = self.in_frame(pixel)?;
            let rgba = rgba(pixel[0], pixel[1])?;
            Some(PixelLabel {
                pixel,
                block,
                rgba,
                dark: is_dark(rgba),
            })
        };
        all.filter(|pixel| marked != Some(*pixel)).filter_map(label).collect()
    }

    pub(super) fn pointer_moved(&mut self, to: DVec2) {
        if !to.is_finite() {
            return;
        }
        let from = self.pointer.at.replace(to);
        if self.comparison.drags_line {
            self.drag_line(to.x);
        } else if let Some(from) = from.filter(|_| self.pointer.dragging) {
            self.pan(to - from);
        }
        self.follow_pointer();
    }

    /// Remembers the pixel under the pointer for the inspector. Unpinned, the inset gives way to the pointer, so what
    /// lies below the inset counts.
    pub(super) fn follow_pointer(&mut self) {
        if self.inspector.pin.is_some() && self.pointer_over_inset() {
            return;
        }
        let Some(at) = self.pointer.at else { return };
        let pixel = self.frame_pixel(window_pixel(at));
        self.inspector.last = self.in_frame(pixel).or(self.inspector.last);
    }

    /// The frame pixel at a window pixel; it may lie outside the frame.
    fn frame_pixel(&self, at: [i64; 2]) -> [i64; 2] {
        let zoom = i64::from(self.settings.pixel_zoom.factor());
        let screen = at.map(|side| side.div_euclid(zoom));
        let corner = self.panes().at(screen).corner;
        [screen[0] - corner[0], screen[1] - corner[1]]
    }

    /// The place in the frame, in frame pixels, of a place in the window.
    pub(super) fn frame_position(&self, at: DVec2) -> DVec2 {
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        let screen = at / zoom;
        let [x, y] = self.panes().at(window_pixel(screen)).corner;
        screen - DVec2::new(x as f64, y as f64)
    }

    pub(super) fn pointer_pressed(&mut self, button: PointerButton) {
        match button {
            PointerButton::Primary => {
                let on_line = self.take_line();
                self.pointer.dragging = self.pointer.at.is_some() && !on_line && !self.pointer_over_inset();
            }
            PointerButton::Secondary => self.pin_under_pointer(),
        }
    }

    /// Pins the hovered pixel; without one the pixel that the inspector shows. Whoever points at a pixel asks about it: the
    /// explanation opens, too, where it was closed. Only a pixel that is explained already is unpinned, and the inspector
    /// closes with it if the pin opened it.
    pub(super) fn pin_under_pointer(&mut self) {
        let Some(pixel) = self.hovered_pixel().or_else(|| self.inspected_pixel()) else {
            return;
        };
        if self.refuses_to_explain() {
            return;
        }
        let is_pinned = self.pinned_pixel() == Some(pixel) || self.slid_away();
        if is_pinned && self.explains() {
            self.inspector.pin = None;
            self.inspector.open &= !std::mem::take(&mut self.inspector.came_with_pin);
        } else {
            self.screen.shown.explanation = true;
            self.inspector.asked = true;
            let asked_at = self.place_asked_about();
            self.pin(pixel.map(i64::from));
            self.inspector.asked_at = asked_at;
        }
    }

    /// Another part of the window is free. Where frames change their size with it, the pixel that a hand asked about stays
    /// what it is, to the place of its samples, and where it is, if its half still reaches there; the view comes back when
    /// the explanation is closed.
    pub(super) fn set_free_area(&mut self, area: Option<PixelRect>) {
        let (before, panes) = (self.sight(), self.panes());
        // Before: a smaller frame may leave its pixel outside.
        let asks = self.inspector.asked && self.explains();
        self.screen.free_area = area;
        if self.arrangement() == Arrangement::Wipe {
            // Its line gives way to panels.
            self.comparison.touch();
        }
        let sights = before.zip(self.sight());
        if let Some((before, sight)) = sights.filter(|(before, sight)| asks && before.frame != sight.frame) {
            self.keep_view_of_pin((&before, &panes), &sight);
        }
        if let Some([first, set]) = self.inspector.kept_view.take_if(|_| !asks) {
            self.look(|camera, _| {
                if *camera == set {
                    *camera = first;
                }
            });
        }
    }

    /// Sets the view in which the pinned pixel shows what it showed `before`, at the same place of the window if its pane has
    /// that, else as near as may be.
    fn keep_view_of_pin(&mut self, (before, panes): (&Sight, &Panes), sight: &Sight) {
        let Some(Pin {
            pixel,
            place: Some((place, _)),
            ..
        }) = self.inspector.pin
        else {
            return;
        };
        let Some(camera) = self.current().map(|entry| entry.camera) else {
            return;
        };
        let in_second = self.inspector.asked_at.is_some_and(|asked| asked.in_second);
        let corner = |panes: &Panes| panes.second.filter(|_| in_second).unwrap_or(panes.first).corner;
        let (old, new) = (corner(panes), corner(&self.panes()));
        let stays = |axis: usize| {
            let room = |beside: i64| beside.min(PIN_ROOM);
            let behind = i64::from(before.frame[axis]) - 1 - pixel[axis];
            let last = i64::from(sight.frame[axis]) - 1 - room(behind);
            let wanted = pixel[axis] + old[axis] - new[axis];
            wanted.max(room(pixel[axis])).min(last).max(0) as f64 + 0.5
        };
        let at = DVec2::new(stays(0), stays(1));
        let mut kept = camera;
        kept.set(camera.numbers(before), sight);
        let now = kept.transform(sight).to_pixels(place);
        kept.pan(at - now, sight);
        let first = match self.inspector.kept_view {
            Some([first, set]) if set == camera => first,
            _ => camera,
        };
        self.inspector.kept_view = Some([first, kept]);
        self.look(|camera, _| *camera = kept);
    }

    /// Moves the picture so that a pixel that was jumped to lies in the middle of what is free, where a panel covers it.
    pub(super) fn reveal_pin(&mut self) {
        let Some(pixel) = self.pinned_pixel().filter(|_| self.inspector.revealed) else {
            return;
        };
        let window = PixelRect::of_size(self.screen.window);
        let free = self.screen.free_area.map_or(window, |free| free.intersection(&window));
        let shown = self.shown_at(pixel);
        if free.width == 0 || free.height == 0 || free.contains([shown.x, shown.y]) {
            return;
        }
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        let middle =
            DVec2::new(free.x as f64, free.y as f64) + DVec2::new(f64::from(free.width), f64::from(free.height)) / 2.0;
        let by = middle - DVec2::new(shown.x as f64, shown.y as f64);
        // The place that was pinned moves along.
        self.keep_pin_in_place();
        // By whole frame pixels, so that the pinned one stays what it is.
        self.pan((by / zoom).round() * zoom);
        self.keep_pin_in_place();
    }

    /// Pins the pixel, or the nearest in the frame, and shows the inspector.
    pub(super) fn pin(&mut self, pixel: [i64; 2]) {
        if let Some(pixel) = self.nearest_in_frame(pixel) {
            self.inspector.pin = Some(Pin {
                pixel: pixel.map(i64::from),
                place: None,
            });
            self.inspector.revealed = false;
            self.inspector.asked_at = None;
            self.inspector.pins += 1;
            self.inspector.came_with_pin |= !self.inspector.open;
            self.inspector.open = true;
            self.screen.hidden = false;
        }
    }

    pub(super) fn nudge(&mut self, by: [i64; 2]) {
        if self.inspector.pin.is_none() && !self.inspector.open {
            return;
        }
        if let Some([x, y]) = self.inspected_pixel() {
            self.pin([i64::from(x).saturating_add(by[0]), i64::from(y).saturating_add(by[1])]);
        }
    }

    /// Where the inset goes now: nowhere while the pinned place is out of sight.
    pub(super) fn place_inset(&mut self) {
        let to_be_seen = self.inspector.open && !self.screen.hidden;
        let center = match self.inspector.pin {
            Some(pin) => self.in_frame(pin.pixel),
            None => self.inspected_pixel(),
        };
        let center = center.filter(|_| to_be_seen);
        let window = PixelRect::of_size(self.screen.window);
        let area = self.screen.free_area.map_or(window, |free| free.intersection(&window));
        (self.inset, self.other_inset) = (None, None);
        let Some(center) = center else { return };
        let shown = self.shown_at(center);
        // The panels that draw the ring tell what area is free; pictures without them have none.
        let is_ringed = self.screen.free_area.is_some() && self.pinned_pixel().is_some();
        self.inspector.ring_room = if is_ringed { RING_ROOM } else { 0 };
        if self.comparison.shows_both() {
            let both = self.place_magnifiers(center, &area);
            (self.inset, self.other_inset) = both.map_or((None, None), |[a, b]| (Some(a), Some(b)));
        } else {
            self.inset = self.inspector.place(center, &shown, &area);
        }
    }

    /// Where a frame pixel is to be seen, in window pixels.
    pub fn shown_at(&self, pixel: [u32; 2]) -> PixelRect {
        let zoom = self.settings.pixel_zoom.factor();
        let [x, y] = pixel.map(i64::from);
        let [left, top] = self.panes().first.corner;
        PixelRect {
            x: (left + x) * i64::from(zoom),
            y: (top + y) * i64::from(zoom),
            width: zoom,
            height: zoom,
        }
    }

    /// The pixel, if the frame has it.
    pub(super) fn in_frame(&self, pixel: [i64; 2]) -> Option<[u32; 2]> {
        let [width, height] = self.frame_size();
        let inside = |value: i64, side: u32| u32::try_from(value).ok().filter(|value| *value < side);
        Some([inside(pixel[0], width)?, inside(pixel[1], height)?])
    }

    /// The frame's nearest pixel; `None` if it has no pixels.
    fn nearest_in_frame(&self, pixel: [i64; 2]) -> Option<[u32; 2]> {
        let [width, height] = self.frame_size();
        let last = [i64::from(width) - 1, i64::from(height) - 1];
        self.in_frame([pixel[0].min(last[0]).max(0), pixel[1].min(last[1]).max(0)])
    }
}

/// The window pixel that contains a position.
pub(super) fn window_pixel(at: DVec2) -> [i64; 2] {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "far positions saturate, which is as far outside"
    )]
    let floor = |value: f64| value.floor().clamp(-1e9, 1e9) as i64;
    [floor(at.x), floor(at.y)]
}
