//! The pinned pixel: where it is pinned, how it keeps its place in the scene, and where its inset goes.

use glam::DVec2;

use crate::render::{Nearby, RenderSettings, Subject};
use crate::viewer::PixelRect;
use crate::viewer::ab::other::Arrangement;
use crate::viewer::inspector::{Pin, RING_ROOM};
use crate::viewer::state::Viewer;
use crate::viewer::view::camera::ViewContext;
use crate::viewer::view::panes::Panes;
use crate::viewer::view::pointer::window_pixel;

/// What is said when the pinned place leaves the window, and with it its ring and its explanation.
pub(in crate::viewer) const PIN_OUTSIDE: &str =
    "the pinned pixel is outside the window now: it comes back with the view, or pin another one";

/// Levels by which two pixels differ at least where two colours meet.
const EDGE: u8 = 48;
/// Levels from the truth above which nobody takes a pixel for right.
const WRONG: u8 = 24;
/// Pixels at edges that are compared with the truth, which takes some milliseconds each in a large scene.
const MOST_EDGES: usize = 40;

/// Frame pixels that stay free beside a pinned one in a frame that becomes smaller.
const PIN_ROOM: i64 = 24;

impl Viewer {
    /// The pinned pixel; `None` too while the pinned place of the scene is outside the frame.
    pub fn pinned_pixel(&self) -> Option<[u32; 2]> {
        self.in_frame(self.inspector.magnifier.pin?.pixel)
    }

    /// Keeps the pin at its place in the scene, whatever the view and the window do. Another scene has other places: there
    /// it stays at its pixel.
    pub(in crate::viewer) fn keep_pin_in_place(&mut self) {
        let Some(mut pin) = self.inspector.magnifier.pin else {
            return;
        };
        let Some(context) = self.view_context().filter(|context| !context.frame.contains(&0)) else {
            return;
        };
        let Some(entry) = self.current() else { return };
        let scene = (self.scene_list.current, self.scene_list.generation);
        let view = entry.camera.transform(&context);
        match pin.place {
            Some((place, of)) if of == scene => {
                let before = self.in_frame(pin.pixel);
                pin.pixel = window_pixel(view.to_pixels(place));
                if before.is_some() && self.in_frame(pin.pixel).is_none() {
                    self.chrome.messages.done(PIN_OUTSIDE.to_owned());
                }
            }
            _ => {
                let centre = DVec2::new(pin.pixel[0] as f64, pin.pixel[1] as f64) + 0.5;
                pin.place = Some((view.to_scene(centre), scene));
            }
        }
        self.inspector.magnifier.pin = Some(pin);
    }

    /// The pixel in the middle of the inspector: the pinned one, else the one last under the pointer, else the one in
    /// the middle of the frame.
    pub fn inspected_pixel(&self) -> Option<[u32; 2]> {
        let middle = self.frame_size().map(|side| i64::from(side / 2));
        let free = self
            .inspector
            .magnifier
            .last
            .map_or(middle, |pixel| pixel.map(i64::from));
        self.pinned_pixel().or_else(|| self.nearest_in_frame(free))
    }

    /// Pins the hovered pixel; without one the pixel that the inspector shows. Whoever points at a pixel asks about it: the
    /// explanation opens, too, where it was closed. Only a pixel that is explained already is unpinned, and the inspector
    /// closes with it if the pin opened it.
    pub(in crate::viewer) fn pin_under_pointer(&mut self) {
        let Some(pixel) = self.hovered_pixel().or_else(|| self.inspected_pixel()) else {
            return;
        };
        if self.refuses_to_explain() {
            return;
        }
        let through_inset = self.pointer_over_inset();
        let same_click = self.pointer.pinned_through_inset.take() == Some(self.inspector.magnifier.pins);
        let is_pinned = self.pinned_pixel() == Some(pixel) || self.slid_away() || same_click;
        if is_pinned && self.explains() {
            self.inspector.magnifier.pin = None;
            self.inspector.magnifier.open &= !std::mem::take(&mut self.inspector.magnifier.came_with_pin);
        } else {
            self.chrome.shown.explanation = true;
            self.inspector.magnifier.asked = true;
            let asked_at = self.place_asked_about();
            self.pin(pixel.map(i64::from));
            self.inspector.magnifier.asked_at = asked_at;
            self.pointer.pinned_through_inset = through_inset.then_some(self.inspector.magnifier.pins);
        }
    }

    /// Another part of the window is free. Where frames change their size with it, the pixel that a hand asked about stays
    /// what it is, to the place of its samples, and where it is, if its half still reaches there; the view comes back when
    /// the explanation is closed.
    pub(in crate::viewer) fn set_free_area(&mut self, area: Option<PixelRect>) {
        let (before, panes) = (self.view_context(), self.panes());
        // Before: a smaller frame may leave its pixel outside.
        let asks = self.inspector.magnifier.asked && self.explains();
        self.chrome.free_area = area;
        if self.arrangement() == Arrangement::Wipe {
            // Its line gives way to panels.
            self.ab.touch();
        }
        self.keep_fixed_in_place(&panes, asks);
        let contexts = before.zip(self.view_context());
        if let Some((before, context)) = contexts.filter(|(before, context)| asks && before.frame != context.frame) {
            self.keep_view_of_pin((&before, &panes), &context);
        }
        if let Some([first, set]) = self.inspector.magnifier.kept_view.take_if(|_| !asks) {
            self.look(|camera, _| {
                if *camera == set {
                    *camera = first;
                }
            });
        }
    }

    /// Keeps pictures with a size of their own where they were `before`, while a hand asks about a pixel of theirs that is to be
    /// seen there; afterwards they go back to where they belong.
    fn keep_fixed_in_place(&mut self, before: &Panes, asks: bool) {
        let Some(frame) = self.fixed_size() else { return };
        if !asks {
            self.ab.moved.let_go();
            return;
        }
        let in_second = self.inspector.magnifier.asked_at.is_some_and(|asked| asked.in_second);
        let pane = |panes: &Panes| panes.second.filter(|_| in_second).unwrap_or(panes.first);
        let (old, now) = (pane(before), pane(&self.panes()));
        let seen = |[x, y]: [u32; 2]| {
            now.area
                .contains([i64::from(x) + old.corner[0], i64::from(y) + old.corner[1]])
        };
        if self.pinned_pixel().is_some_and(seen) {
            let by = DVec2::from([0, 1].map(|axis| (old.corner[axis] - now.corner[axis]) as f64));
            self.ab.moved.keep(by, &now.area, frame);
            self.ab.touch();
        } else if old.corner != now.corner {
            self.ab.moved.slide();
        }
    }

    /// Sets the view in which the pinned pixel shows what it showed `before`, at the same place of the window if its pane has
    /// that, else as near as may be.
    fn keep_view_of_pin(&mut self, (before, panes): (&ViewContext, &Panes), context: &ViewContext) {
        let Some(Pin {
            pixel,
            place: Some((place, _)),
            ..
        }) = self.inspector.magnifier.pin
        else {
            return;
        };
        let Some(camera) = self.current().map(|entry| entry.camera) else {
            return;
        };
        let in_second = self.inspector.magnifier.asked_at.is_some_and(|asked| asked.in_second);
        let corner = |panes: &Panes| panes.second.filter(|_| in_second).unwrap_or(panes.first).corner;
        let (old, new) = (corner(panes), corner(&self.panes()));
        let stays = |axis: usize| {
            let room = |beside: i64| beside.min(PIN_ROOM);
            let behind = i64::from(before.frame[axis]) - 1 - pixel[axis];
            let last = i64::from(context.frame[axis]) - 1 - room(behind);
            let wanted = pixel[axis] + old[axis] - new[axis];
            wanted.max(room(pixel[axis])).min(last).max(0) as f64 + 0.5
        };
        let at = DVec2::new(stays(0), stays(1));
        let mut kept = camera;
        kept.set(camera.numbers(before), context);
        let now = kept.transform(context).to_pixels(place);
        kept.pan(at - now, context);
        let first = match self.inspector.magnifier.kept_view {
            Some([first, set]) if set == camera => first,
            _ => camera,
        };
        self.inspector.magnifier.kept_view = Some([first, kept]);
        self.look(|camera, _| *camera = kept);
    }

    /// Moves the picture so that a pixel that was jumped to lies in the middle of what is free, where a panel covers it.
    pub(in crate::viewer) fn reveal_pin(&mut self) {
        let Some(pixel) = self.pinned_pixel().filter(|_| self.inspector.magnifier.revealed) else {
            return;
        };
        let window = PixelRect::of_size(self.chrome.window);
        let free = self.chrome.free_area.map_or(window, |free| free.intersection(&window));
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
    pub(in crate::viewer) fn pin(&mut self, pixel: [i64; 2]) {
        if let Some(pixel) = self.nearest_in_frame(pixel) {
            self.inspector.magnifier.pin = Some(Pin {
                pixel: pixel.map(i64::from),
                place: None,
            });
            self.inspector.magnifier.revealed = false;
            self.inspector.magnifier.asked_at = None;
            self.chrome.messages.retract(PIN_OUTSIDE);
            self.inspector.magnifier.pins += 1;
            self.inspector.magnifier.came_with_pin |= !self.inspector.magnifier.open;
            self.inspector.magnifier.open = true;
            self.chrome.hidden = false;
        }
    }

    /// Pins a pixel near the middle of the free picture that an edge makes wrong, and explains it; where none is, one that an
    /// edge goes through, one that differs from a neighbour, or the one in the middle.
    pub(in crate::viewer) fn pin_edge(&mut self) {
        if self.refuses_to_explain() {
            return;
        }
        let [corner, size] = self.free_part();
        let middle = corner + size / 2.0;
        let edges = self.edges_near(middle, [corner, corner + size]);
        let wrong = edges.iter().find(|pixel| self.is_wrong(**pixel));
        let mixed = || edges.iter().find(|pixel| self.is_mixed(**pixel));
        let edge = wrong.or_else(mixed).or(edges.first());
        let pixel = edge.map_or_else(|| window_pixel(middle), |edge| edge.map(i64::from));
        self.chrome.shown.explanation = true;
        self.inspector.magnifier.asked = true;
        self.pin(pixel);
    }

    /// Pixels on both sides of where neighbours differ, in a part of the frame given by two corners: some of those next to
    /// `middle`, the nearest first.
    fn edges_near(&self, middle: DVec2, [low, high]: [DVec2; 2]) -> Vec<[u32; 2]> {
        let Some(frame) = self.frame() else {
            return Vec::new();
        };
        let inside = |[x, y]: [u32; 2]| {
            let at = DVec2::new(f64::from(x), f64::from(y));
            at.cmpge(low).all() && at.cmplt(high).all()
        };
        let differ = |[x, y]: [u32; 2], [u, v]: [u32; 2]| {
            let colors = frame.final_rgba(x, y).zip(frame.final_rgba(u, v));
            colors.is_some_and(|(a, b)| a.iter().zip(b).any(|(a, b)| a.abs_diff(b) >= EDGE))
        };
        let (width, height) = (frame.pixels.width(), frame.pixels.height());
        let mut edges: Vec<[u32; 2]> = (0..height)
            .flat_map(|y| (0..width).map(move |x| [x, y]))
            .flat_map(|[x, y]| [[x + 1, y], [x, y + 1]].map(|beside| [[x, y], beside]))
            .filter(|&[pixel, beside]| inside(pixel) && inside(beside) && differ(pixel, beside))
            .flatten()
            .collect();
        let distance = |[x, y]: [u32; 2]| DVec2::new(f64::from(x), f64::from(y)).distance_squared(middle);
        edges.sort_by(|a, b| distance(*a).total_cmp(&distance(*b)).then(a.cmp(b)));
        edges.dedup();
        edges.truncate(MOST_EDGES);
        edges
    }

    /// Whether a pixel has another colour than the two beside it, or than those above and below: an edge that samples
    /// resolve goes through it.
    fn is_mixed(&self, [x, y]: [u32; 2]) -> bool {
        let Some(frame) = self.frame() else { return false };
        let beside = |dx: i64, dy: i64| {
            let [x, y] = [i64::from(x) + dx, i64::from(y) + dy].map(|at| u32::try_from(at).ok());
            frame.final_rgba(x?, y?)
        };
        let own = beside(0, 0);
        let differs = |other: Option<[u8; 4]>| other.is_some() && other != own;
        let between = |[dx, dy]: [i64; 2]| differs(beside(dx, dy)) && differs(beside(-dx, -dy));
        between([1, 0]) || between([0, 1])
    }

    /// Whether a pixel is as far from the truth as can be seen.
    fn is_wrong(&self, [x, y]: [u32; 2]) -> bool {
        let (Some(entry), Some(context), Some(frame)) = (self.current(), self.view_context(), self.frame()) else {
            return false;
        };
        let Some(scene) = entry.scene() else { return false };
        let view = entry.camera.transform(&context);
        let settings = &self.settings.render;
        let subject = Subject {
            scene,
            view: &view,
            settings,
        };
        let truth = RenderSettings {
            resolve: settings.resolve,
            ..settings.truth()
        };
        let color = frame.final_rgba(x, y);
        let true_color = Nearby::new(&subject, context.frame, [x, y]).pixel(&truth);
        color.zip(true_color).is_some_and(|([r, g, b, a], truth)| {
            let apart = |(a, b): (u8, u8)| a.abs_diff(b) >= WRONG;
            [a, r, g, b].into_iter().zip(truth.to_be_bytes()).any(apart)
        })
    }

    pub(in crate::viewer) fn nudge(&mut self, by: [i64; 2]) {
        if self.inspector.magnifier.pin.is_none() && !self.inspector.magnifier.open {
            return;
        }
        if let Some([x, y]) = self.inspected_pixel() {
            self.pin([i64::from(x).saturating_add(by[0]), i64::from(y).saturating_add(by[1])]);
        }
    }

    /// Where the inset goes now: nowhere while the pinned place is out of sight.
    pub(in crate::viewer) fn place_inset(&mut self) {
        let to_be_seen = self.inspector.magnifier.open && !self.chrome.hidden;
        let center = match self.inspector.magnifier.pin {
            Some(pin) => self.in_frame(pin.pixel),
            None => self.inspected_pixel(),
        };
        let center = center.filter(|_| to_be_seen);
        let window = PixelRect::of_size(self.chrome.window);
        let area = self.chrome.free_area.map_or(window, |free| free.intersection(&window));
        (self.inspector.inset, self.inspector.other_inset) = (None, None);
        let Some(center) = center else { return };
        let shown = self.shown_at(center);
        // The panels that draw the ring tell what area is free; pictures without them have none.
        let is_ringed = self.chrome.free_area.is_some() && self.pinned_pixel().is_some();
        self.inspector.magnifier.ring_room = if is_ringed { RING_ROOM } else { 0 };
        if self.ab.shows_both() {
            let both = self.place_magnifiers(center, &area);
            (self.inspector.inset, self.inspector.other_inset) = both.map_or((None, None), |[a, b]| (Some(a), Some(b)));
        } else {
            self.inspector.inset = self.inspector.magnifier.place(center, &shown, &area);
        }
    }
}
