//! Which pixel the user means: the one under the pointer, the pinned one, the one in the middle of the inspector.

use std::sync::Arc;

use glam::DVec2;

use crate::raster::Region;
use crate::viewer::PixelRect;
use crate::viewer::chrome::Chrome;
use crate::viewer::control::both::Both;
use crate::viewer::control::drawings::Attention;
use crate::viewer::frames::legends::LegendRequest;
use crate::viewer::inspector::explanation::Asked;
use crate::viewer::inspector::samples::Target;
use crate::viewer::inspector::state::Inspection;
use crate::viewer::inspector::{AskedAt, with_ring};
use crate::viewer::view::pointer::{Pointer, window_pixel};

/// Window pixels on either side of the line of a wipe where a press takes hold of it, at a pixel zoom of 1.
const GRIP: f64 = 6.0;

/// Where pointer, pin and inspector are, over A and B.
#[derive(Clone, Copy, Debug)]
pub struct Pointing<'a> {
    pub(in crate::viewer) both: Both<'a>,
    pub(in crate::viewer) chrome: &'a Chrome,
    pub(in crate::viewer) inspector: &'a Inspection,
    pub(in crate::viewer) pointer: &'a Pointer,
}

impl Pointing<'_> {
    /// The pointer in window pixels; `None` outside the window or over a panel.
    pub fn pointer(&self) -> Option<DVec2> {
        self.pointer.at
    }

    /// Whether a drag is moving the picture.
    pub fn is_dragging(&self) -> bool {
        self.pointer.dragging
    }

    /// Whether the pointer is over the inspector's inset.
    pub fn over_inset(&self) -> bool {
        let at = self.pointer.at.map(window_pixel);
        at.is_some_and(|at| self.inspector.inset_at(at).is_some())
    }

    /// Whether the pointer is on the line of the wipe, or drags it.
    pub fn over_line(&self) -> bool {
        let near = |(line, at): (f64, DVec2)| (at.x - line).abs() <= GRIP;
        let over = self.both.wipe_line().zip(self.pointer.at).is_some_and(near);
        self.both.ab.drags_line || (over && !self.over_inset())
    }

    /// The frame pixel under the pointer: over the inset the magnified one.
    pub fn hovered(&self) -> Option<[u32; 2]> {
        let at = window_pixel(self.pointer.at?);
        let pixel = match self.inspector.inset_at(at) {
            Some(inset) => inset.pixel_at(at)?,
            None => self.both.layout.frame_pixel(at),
        };
        self.both.layout.in_frame(pixel)
    }

    /// The pinned pixel; `None` too while the pinned place of the scene is outside the frame.
    pub fn pinned(&self) -> Option<[u32; 2]> {
        self.inspector.pinned_pixel(&self.both.layout)
    }

    /// The pixel in the middle of the inspector: the pinned one, else the one last under the pointer, else the one in
    /// the middle of the frame.
    pub fn inspected(&self) -> Option<[u32; 2]> {
        self.inspector.inspected_pixel(&self.both.layout)
    }

    /// The pixel in the middle of what is free of the picture.
    pub(in crate::viewer) fn middle(&self) -> Option<[u32; 2]> {
        let layout = &self.both.layout;
        let [corner, size] = layout.free_part();
        layout.nearest_in_frame(window_pixel(corner + size / 2.0))
    }

    /// The pixel that a key asks about: the one under the pointer, else the one that the magnifier shows, else the one in the
    /// middle. Where the pointer was last is nothing to be seen by itself.
    pub(in crate::viewer) fn asked_about(&self) -> Option<[u32; 2]> {
        let is_seen = self.inspector.inset.is_some() || self.pinned().is_some();
        let inspected = || self.inspected().filter(|_| is_seen);
        self.hovered().or_else(inspected).or_else(|| self.middle())
    }

    /// Where the pinned pixel is to be seen in the window: in every pane that shows it.
    pub fn pinned_places(&self) -> Vec<PixelRect> {
        let Some([x, y]) = self.pinned() else {
            return Vec::new();
        };
        let (width, height) = (1, 1);
        let places = self.both.layout.in_window(Region { x, y, width, height }).into_iter();
        places.filter(|place| place.width > 0 && place.height > 0).collect()
    }

    /// The place among those that differ most that is pinned, counted from 0.
    pub fn pinned_difference(&self) -> Option<usize> {
        let pinned = self.pinned()?;
        let (measures, _) = self.both.measures()?;
        measures.places.iter().position(|place| place.at == pinned)
    }

    /// Whether there is to be an explanation in the window.
    pub fn explains(&self) -> bool {
        let both = &self.both;
        self.inspector.explains(self.chrome, both.scene_list, &both.layout)
    }

    /// The same, whether or not the pinned place is in sight: the panel stays while a wheel turns, since it would come and
    /// go under the pointer.
    pub fn has_explanation_open(&self) -> bool {
        self.inspector.has_explanation_open(self.chrome, self.both.scene_list)
    }

    /// Whether there is a pinned pixel that the panels of a sheet can magnify.
    pub fn sheet_has_inset(&self) -> bool {
        self.inspector.magnifier.open && self.pinned().is_some()
    }

    /// What of a frame is to be final first: what the inspector shows, or the pixel under the pointer, or the middle.
    pub(in crate::viewer) fn attention(&self) -> Attention {
        let inset = self.inspector.inset;
        let inspected = inset.and_then(|_| self.inspected());
        let middle = self.both.layout.frame_size().map(|side| side / 2);
        Attention {
            at: inspected.or(self.hovered()).unwrap_or(middle),
            inset,
        }
    }

    /// The place of the picture under the pointer; `None` over the inset, too.
    pub(in crate::viewer) fn place_asked_about(&self) -> Option<AskedAt> {
        let at = window_pixel(self.pointer.at?);
        if self.inspector.inset_at(at).is_some() {
            return None;
        }
        let zoom = i64::from(self.both.layout.zoom());
        let second = self.both.layout.panes().second;
        let in_second = second.is_some_and(|pane| pane.area.contains(at.map(|side| side.div_euclid(zoom))));
        Some(AskedAt { at, in_second })
    }

    /// Whether the pointer rests where it asked about the pinned pixel, which the room for the explanation took away from
    /// under it: another click there means the pinned one.
    pub(in crate::viewer) fn slid_away(&self) -> bool {
        let Some((asked, at)) = self.inspector.magnifier.asked_at.zip(self.pointer.at) else {
            return false;
        };
        let both = &self.both;
        let camera = both.scene_list.camera();
        let has_slid = self
            .inspector
            .magnifier
            .kept_view
            .is_some_and(|[first, set]| first != set && Some(set) == camera);
        let has_slid = has_slid || (both.layout.fixed_size().is_some() && both.ab.moved.has_slid());
        has_slid && asked.at == window_pixel(at)
    }

    /// A pixel of the frame on the screen, as a question.
    pub(in crate::viewer) fn question(&self, pixel: [u32; 2]) -> Option<Asked> {
        let target = self.target(pixel)?;
        let entry = self.both.scene_list.current()?;
        // The frame of the scene before may still be on the screen: its shapes are in no line of this one's file.
        if !entry
            .scene()
            .is_some_and(|scene| Arc::ptr_eq(scene, &target.picture.scene))
        {
            return None;
        }
        let file = entry.label.clone();
        let own = &target.picture;
        let other = self.both.other_picture(own);
        Some(Asked { target, other, file })
    }

    /// A pixel of the frame on the screen.
    pub(in crate::viewer) fn target(&self, pixel: [u32; 2]) -> Option<Target> {
        let picture = self.both.frames.frame()?.picture.clone();
        Some(Target { picture, pixel })
    }

    /// The legends of what the picture shows, which spare insets and the pinned pixel; `None` where there are none.
    pub(in crate::viewer) fn legends(&self) -> Option<LegendRequest> {
        let (both, layout, inspector) = (&self.both, &self.both.layout, self.inspector);
        let shown = if self.chrome.hidden {
            Vec::new()
        } else {
            both.visualisations()
        };
        let scene = both.frames.frame().map(|frame| Arc::clone(&frame.picture.scene));
        let scene = scene.filter(|_| !shown.is_empty())?;
        let insets = [inspector.inset, inspector.other_inset].into_iter().flatten();
        let center = inspector.inset.and_then(|placed| layout.in_frame(placed.inset.center));
        let pixel = center.map(|pixel| layout.shown_at(pixel));
        let rings = self.pinned_places().into_iter();
        let rings = rings.map(|place| with_ring(&place, inspector.magnifier.ring_room));
        Some(LegendRequest {
            scene,
            shown,
            clamped: both.clamped_pixels(),
            window: layout.window(),
            area: layout.free_window(),
            spared: insets.map(|placed| placed.rect).chain(pixel).chain(rings).collect(),
        })
    }
}
