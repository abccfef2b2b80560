//! Legends of visualisations as pictures, kept while they are the same.

use std::sync::Arc;

use crate::figure::place_legends;
use crate::raster::Framebuffer;
use crate::render::{ClampedPixels, Legend, Visualisation};
use crate::scene::Scene;
use crate::viewer::PixelRect;
use crate::viewer::frames::present::{WindowPixels, paste};

/// The legends on the screen: of A, and of B where that shows something else.
#[derive(Debug, Default)]
pub(in crate::viewer) struct Legends {
    request: Option<LegendRequest>,
    pub(in crate::viewer) placed: Vec<(PixelRect, Framebuffer)>,
    number: u64,
}

/// Where the legends lie, and a number that grows with every change of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::viewer) struct PlacedLegends {
    pub(in crate::viewer) rects: [Option<PixelRect>; 2],
    number: u64,
}

/// What decides legends and their places.
#[derive(Debug)]
pub(in crate::viewer) struct LegendRequest {
    pub(in crate::viewer) scene: Arc<Scene>,
    pub(in crate::viewer) shown: Vec<Visualisation>,
    /// How many pixels of the only picture were clamped, where that is shown.
    pub(in crate::viewer) clamped: Option<ClampedPixels>,
    pub(in crate::viewer) window: [u32; 2],
    pub(in crate::viewer) area: PixelRect,
    pub(in crate::viewer) spared: Vec<PixelRect>,
}

impl PartialEq for LegendRequest {
    fn eq(&self, other: &Self) -> bool {
        let places = |request: &Self| (request.window, request.area);
        Arc::ptr_eq(&self.scene, &other.scene)
            && self.shown == other.shown
            && self.clamped == other.clamped
            && places(self) == places(other)
            && self.spared == other.spared
    }
}

impl Legends {
    pub(in crate::viewer) fn places(&self) -> PlacedLegends {
        let rect = |index: usize| self.placed.get(index).map(|(rect, _)| *rect);
        PlacedLegends {
            rects: [rect(0), rect(1)],
            number: self.number,
        }
    }

    /// Puts the legends that are asked for where they have room now.
    pub(in crate::viewer) fn place(&mut self, request: Option<LegendRequest>) {
        if request == self.request {
            return;
        }
        self.placed = request.as_ref().map_or_else(Vec::new, LegendRequest::place);
        self.request = request;
        self.number += 1;
    }

    /// Draws the legends as far as they lie in `parts`.
    pub(in crate::viewer) fn draw(&self, parts: &[PixelRect], window: &mut WindowPixels<'_>) {
        for (rect, picture) in &self.placed {
            for part in parts {
                paste(picture, [rect.x, rect.y], window, part);
            }
        }
    }
}

impl LegendRequest {
    fn place(&self) -> Vec<(PixelRect, Framebuffer)> {
        let legends: Vec<Legend> = self
            .shown
            .iter()
            .filter_map(|shown| shown.legend_of(&self.scene, self.clamped))
            .collect();
        place_legends(&legends, self.window, &self.area, &self.spared)
    }
}
