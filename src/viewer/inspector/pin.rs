//! The pinned pixel: how it comes, how it keeps its place in the scene, and where its insets go.

use glam::DVec2;

use crate::figure::PixelRect;
use crate::viewer::ab::comparison::Comparison;
use crate::viewer::chrome::Chrome;
use crate::viewer::chrome::messages::Messages;
use crate::viewer::inspector::state::Inspection;
use crate::viewer::inspector::{Beside, ENOUGH, LEAST_PART, Pin, PlacedInset, RING_ROOM};
use crate::viewer::library::state::SceneList;
use crate::viewer::settings::Toggle;
use crate::viewer::view::layout::{WindowLayout, magnified};
use crate::viewer::view::panes::Pane;
use crate::viewer::view::pointer::window_pixel;

/// What is said when the pinned place leaves the window, and with it its ring and its explanation.
const PIN_OUTSIDE: &str = "the pinned pixel is outside the window now: it comes back with the view, or pin another one";

/// What decides where insets go.
#[derive(Debug)]
pub(in crate::viewer) struct InsetSurroundings<'a> {
    pub(in crate::viewer) ab: &'a Comparison,
    pub(in crate::viewer) scenes: &'a SceneList,
    pub(in crate::viewer) layout: &'a WindowLayout,
    /// Whether everything but the picture is hidden.
    pub(in crate::viewer) hidden: bool,
}

impl Inspection {
    /// Pins the pixel, or the nearest in the frame, and shows the inspector.
    pub(in crate::viewer) fn pin(&mut self, pixel: [i64; 2], layout: &WindowLayout, chrome: &mut Chrome) {
        let Some(pixel) = layout.nearest_in_frame(pixel) else {
            return;
        };
        let magnifier = &mut self.magnifier;
        magnifier.pin = Some(Pin {
            pixel: pixel.map(i64::from),
            place: None,
        });
        magnifier.reveal = None;
        magnifier.asked_at = None;
        magnifier.pins += 1;
        magnifier.came_with_pin |= !magnifier.open;
        magnifier.open = true;
        chrome.messages.retract(PIN_OUTSIDE);
        chrome.hidden = false;
    }

    /// Pins a place of the current scene, which need not have been read yet.
    pub(in crate::viewer) fn pin_place(&mut self, place: DVec2, scenes: &SceneList) {
        self.magnifier.pin = Some(Pin {
            pixel: [0, 0],
            place: Some((place, scenes.identity())),
        });
    }

    /// Moves the pin by frame pixels; pins first what the open inspector shows.
    pub(in crate::viewer) fn nudge(&mut self, by: [i64; 2], layout: &WindowLayout, chrome: &mut Chrome) {
        if self.magnifier.pin.is_none() && !self.magnifier.open {
            chrome
                .messages
                .done("no pixel is pinned that could move; Enter pins the one under the pointer".to_owned());
            return;
        }
        if let Some([x, y]) = self.inspected_pixel(layout) {
            let moved = [i64::from(x).saturating_add(by[0]), i64::from(y).saturating_add(by[1])];
            self.pin(moved, layout, chrome);
        }
    }

    /// Opens or closes the inspector.
    pub(in crate::viewer) fn show(&mut self, toggle: Toggle, chrome: &mut Chrome) {
        // What is hidden is not open to the eye: the key shows it again.
        self.magnifier.open = toggle.of(self.magnifier.open && !chrome.hidden);
        if self.magnifier.open {
            chrome.hidden = false;
        } else {
            self.magnifier.pin = None;
            self.magnifier.came_with_pin = false;
        }
    }

    /// Keeps the pin at its place in the scene, whatever the view and the window do. Another scene has other places: there
    /// it stays at its pixel.
    pub(in crate::viewer) fn keep_pin_in_place(
        &mut self,
        scenes: &SceneList,
        layout: &WindowLayout,
        messages: &mut Messages,
    ) {
        let Some(mut pin) = self.magnifier.pin else {
            messages.retract(PIN_OUTSIDE);
            return;
        };
        let context = scenes.view_context(layout.frame_size());
        let context = context.filter(|context| !context.frame.contains(&0));
        let Some((context, camera)) = context.zip(scenes.camera()) else {
            return;
        };
        let scene = scenes.identity();
        let view = camera.transform(&context);
        match pin.place {
            Some((place, of)) if of == scene => {
                let before = layout.in_frame(pin.pixel);
                pin.pixel = window_pixel(view.to_pixels(place));
                match (before, layout.in_frame(pin.pixel)) {
                    (Some(_), None) => messages.done(PIN_OUTSIDE.to_owned()),
                    (_, Some(_)) => messages.retract(PIN_OUTSIDE),
                    (None, None) => {}
                }
            }
            _ => {
                let centre = DVec2::new(pin.pixel[0] as f64, pin.pixel[1] as f64) + 0.5;
                pin.place = Some((view.to_scene(centre), scene));
                messages.retract(PIN_OUTSIDE);
            }
        }
        self.magnifier.pin = Some(pin);
    }

    /// Where the insets go now: nowhere while the pinned place is out of sight, or panels leave no room.
    pub(in crate::viewer) fn place_insets(&mut self, around: &InsetSurroundings<'_>) {
        let layout = around.layout;
        let to_be_seen = self.magnifier.open && !around.hidden;
        let center = match self.magnifier.pin {
            Some(pin) => layout.in_frame(pin.pixel),
            None => self.inspected_pixel(layout),
        };
        let center = center.filter(|_| to_be_seen);
        self.lacks_room = center.is_some() && is_crowded(layout);
        (self.inset, self.other_inset) = (None, None);
        let Some(center) = center.filter(|_| !self.lacks_room) else {
            return;
        };
        // The panels that draw the ring tell what area is free; pictures without them have none.
        let is_ringed = layout.free_area().is_some() && self.pinned_pixel(layout).is_some();
        self.magnifier.ring_room = if is_ringed { RING_ROOM } else { 0 };
        if around.ab.shows_both() {
            let both = self.place_magnifiers(center, around);
            (self.inset, self.other_inset) = both.map_or((None, None), |[a, b]| (Some(a), Some(b)));
        } else {
            self.inset = self
                .magnifier
                .place(center, &around.beside(center, &layout.panes().first));
        }
    }

    /// Where the magnifiers of a pixel of both go.
    fn place_magnifiers(&mut self, center: [u32; 2], around: &InsetSurroundings<'_>) -> Option<[PlacedInset; 2]> {
        let panes = around.layout.panes();
        let swapped = around.ab.swapped;
        let Some(second) = panes.second else {
            let beside = around.beside(center, &panes.first);
            return self.magnifier.place_both(center, &beside, swapped);
        };
        // The magnifier of A lies in A's half, whichever that is.
        let (own, other) = if swapped {
            (second, panes.first)
        } else {
            (panes.first, second)
        };
        let [half, other] = [own.area, other.area].map(|area| magnified(&area, around.layout.zoom()));
        let beside = Beside {
            area: half,
            ..around.beside(center, &own)
        };
        self.magnifier.place_in_halves(center, &beside, [other.x, other.y])
    }
}

/// Whether panels leave so little of the window that an inset there would be a picture without words.
fn is_crowded(layout: &WindowLayout) -> bool {
    let shorter = |[width, height]: [u32; 2]| width.min(height);
    let least = (shorter(layout.window()) / LEAST_PART).min(ENOUGH);
    layout
        .free_area()
        .is_some_and(|free| shorter([free.width, free.height]) < least)
}

impl InsetSurroundings<'_> {
    /// What insets of this frame pixel lie in and beside where a pane shows the picture.
    fn beside(&self, center: [u32; 2], pane: &Pane) -> Beside {
        let layout = self.layout;
        let picture = self.scenes.canvas_in_frame(layout).map(|canvas| {
            let [low, high] = canvas.map(|place| screen_place(place, pane.corner));
            let side = |axis: usize| u32::try_from(high[axis] - low[axis]).unwrap_or_default();
            let [x, y] = low;
            let rect = PixelRect {
                x,
                y,
                width: side(0),
                height: side(1),
            };
            magnified(&rect, layout.zoom())
        });
        Beside {
            area: layout.free_window(),
            shown: layout.shown_in(pane, center),
            picture: picture.unwrap_or_default(),
        }
    }
}

/// The screen pixel of a place in a frame whose corner lies at `corner`; far places are brought near.
fn screen_place(place: DVec2, corner: [i64; 2]) -> [i64; 2] {
    /// Farther away nothing is to be seen.
    const FAR: f64 = 1e6;
    #[expect(clippy::cast_possible_truncation, reason = "clamped")]
    let near = |at: f64| at.round().clamp(-FAR, FAR) as i64;
    [near(place.x) + corner[0], near(place.y) + corner[1]]
}
