//! Which legends are to be seen, and where there is room for them.

use std::sync::Arc;

use crate::render::{Legend, Visualisation};
use crate::viewer::PixelRect;
use crate::viewer::ab::other::Arrangement;
use crate::viewer::frames::legends::LegendRequest;
use crate::viewer::frames::present::{WindowPixels, paste};
use crate::viewer::inspector::with_ring;
use crate::viewer::state::Viewer;

impl Viewer {
    /// Where legends lie in the window, in window pixels.
    pub fn legend_places(&self) -> Vec<PixelRect> {
        self.frames.legends.placed.iter().map(|(rect, _)| *rect).collect()
    }

    /// What the picture on the screen shows: A, then B where that is seen and shows something else.
    fn visualisations(&self) -> Vec<Visualisation> {
        let Some(frame) = self.frame() else { return Vec::new() };
        let mut shown = vec![frame.picture.settings.visualisation];
        if self.arrangement() == Arrangement::Difference {
            // The difference has colours of its own.
            return Vec::new();
        }
        if self.ab.shows_both() {
            shown.extend(self.other_settings().map(|settings| settings.visualisation));
            shown.dedup();
        }
        shown.retain(|shown| *shown != Visualisation::Color);
        shown
    }

    /// Puts the legends where there is room now.
    pub(in crate::viewer) fn place_legends(&mut self) {
        let shown = if self.chrome.hidden {
            Vec::new()
        } else {
            self.visualisations()
        };
        let scene = self.frame().map(|frame| Arc::clone(&frame.picture.scene));
        let request = scene.filter(|_| !shown.is_empty()).map(|scene| {
            let window = PixelRect::of_size(self.chrome.window);
            let insets = [self.inspector.inset, self.inspector.other_inset].into_iter().flatten();
            let pixel = self
                .inspector
                .inset
                .and_then(|placed| self.in_frame(placed.inset.center))
                .map(|pixel| self.shown_at(pixel));
            let rings = self.pinned_places().into_iter();
            let rings = rings.map(|place| with_ring(&place, self.inspector.magnifier.ring_room));
            LegendRequest {
                scene,
                shown,
                window: self.chrome.window,
                area: self.chrome.free_area.map_or(window, |free| free.intersection(&window)),
                spared: insets.map(|placed| placed.rect).chain(pixel).chain(rings).collect(),
            }
        });
        if request == self.frames.legends.request {
            return;
        }
        self.frames.legends.placed = request.as_ref().map_or_else(Vec::new, LegendRequest::place);
        self.frames.legends.request = request;
        self.frames.legends.number += 1;
    }

    /// Draws the legends as far as they lie in `parts`.
    pub(in crate::viewer) fn draw_legends(&self, parts: &[PixelRect], window: &mut WindowPixels<'_>) {
        for (rect, picture) in &self.frames.legends.placed {
            for part in parts {
                paste(picture, [rect.x, rect.y], window, part);
            }
        }
    }

    /// The legends that a saved picture carries.
    pub(in crate::viewer) fn legends_of_picture(&self) -> Vec<Legend> {
        let Some(frame) = self.frame() else { return Vec::new() };
        let legends = self.visualisations().into_iter();
        legends.filter_map(|shown| shown.legend(&frame.picture.scene)).collect()
    }
}
