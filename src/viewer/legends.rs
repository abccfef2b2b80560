//! Legends of visualisations: in a corner of the window that panels and insets leave free, and on saved pictures.

use std::sync::Arc;

use super::present::paste;
use super::{Arrangement, PixelRect, Viewer, WindowPixels};
use crate::figure::place_legends;
use crate::raster::Framebuffer;
use crate::render::{Legend, Visualisation};
use crate::scene::Scene;

/// The legends on the screen: of A, and of B where that shows something else.
#[derive(Debug, Default)]
pub(super) struct Legends {
    wish: Option<Wish>,
    placed: Vec<(PixelRect, Framebuffer)>,
    number: u64,
}

/// Where the legends lie, and a number that grows with every change of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct PlacedLegends {
    pub(super) rects: [Option<PixelRect>; 2],
    number: u64,
}

/// What decides legends and their places.
#[derive(Debug)]
struct Wish {
    scene: Arc<Scene>,
    shown: Vec<Visualisation>,
    window: [u32; 2],
    area: PixelRect,
    spared: Vec<PixelRect>,
}

impl PartialEq for Wish {
    fn eq(&self, other: &Self) -> bool {
        let places = |wish: &Self| (wish.window, wish.area);
        Arc::ptr_eq(&self.scene, &other.scene)
            && self.shown == other.shown
            && places(self) == places(other)
            && self.spared == other.spared
    }
}

impl Legends {
    pub(super) fn places(&self) -> PlacedLegends {
        let rect = |index: usize| self.placed.get(index).map(|(rect, _)| *rect);
        PlacedLegends {
            rects: [rect(0), rect(1)],
            number: self.number,
        }
    }
}

impl Viewer {
    /// Where legends lie in the window, in window pixels.
    pub fn legend_places(&self) -> Vec<PixelRect> {
        self.legends.placed.iter().map(|(rect, _)| *rect).collect()
    }

    /// What the picture on the screen shows: A, then B where that is seen and shows something else.
    fn visualisations(&self) -> Vec<Visualisation> {
        let Some(frame) = self.frame() else { return Vec::new() };
        let mut shown = vec![frame.picture.settings.visualisation];
        if self.arrangement() == Arrangement::Difference {
            // The difference has colours of its own.
            return Vec::new();
        }
        if self.comparison.shows_both() {
            shown.extend(self.other_settings().map(|settings| settings.visualisation));
            shown.dedup();
        }
        shown.retain(|shown| *shown != Visualisation::Color);
        shown
    }

    /// Puts the legends where there is room now.
    pub(super) fn place_legends(&mut self) {
        let shown = if self.screen.hidden {
            Vec::new()
        } else {
            self.visualisations()
        };
        let scene = self.frame().map(|frame| Arc::clone(&frame.picture.scene));
        let wish = scene.filter(|_| !shown.is_empty()).map(|scene| {
            let window = PixelRect::of_size(self.screen.window);
            let insets = [self.inset, self.other_inset].into_iter().flatten();
            let pixel = self.inset.and_then(|placed| self.in_frame(placed.inset.center));
            Wish {
                scene,
                shown,
                window: self.screen.window,
                area: self.screen.free_area.map_or(window, |free| free.intersection(&window)),
                spared: insets
                    .map(|placed| placed.rect)
                    .chain(pixel.map(|pixel| self.shown_at(pixel)))
                    .collect(),
            }
        });
        if wish == self.legends.wish {
            return;
        }
        self.legends.placed = wish.as_ref().map_or_else(Vec::new, Wish::place);
        self.legends.wish = wish;
        self.legends.number += 1;
    }

    /// Draws the legends as far as they lie in `parts`.
    pub(super) fn draw_legends(&self, parts: &[PixelRect], window: &mut WindowPixels<'_>) {
        for (rect, picture) in &self.legends.placed {
            for part in parts {
                paste(picture, [rect.x, rect.y], window, part);
            }
        }
    }

    /// The legends that a saved picture carries.
    pub(super) fn legends_of_picture(&self) -> Vec<Legend> {
        let Some(frame) = self.frame() else { return Vec::new() };
        let legends = self.visualisations().into_iter();
        legends.filter_map(|shown| shown.legend(&frame.picture.scene)).collect()
    }
}

impl Wish {
    fn place(&self) -> Vec<(PixelRect, Framebuffer)> {
        let legends: Vec<Legend> = self
            .shown
            .iter()
            .filter_map(|shown| shown.legend(&self.scene))
            .collect();
        place_legends(&legends, self.window, &self.area, &self.spared)
    }
}
