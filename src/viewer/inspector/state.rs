//! What is inspected: the magnifier and its pin, and what was found out about the pixel.

use crate::figure::SampleMark;
use crate::inspect::{ContributedPixel, Explanation, TexelPlace};
use crate::raster::Region;
use crate::viewer::chrome::Chrome;
use crate::viewer::inspector::contributions::Contributing;
use crate::viewer::inspector::explanation::Explaining;
use crate::viewer::inspector::samples::{Hit, ProbedSample, Probing};
use crate::viewer::inspector::{AskedAt, Inspector, PlacedInset};
use crate::viewer::library::state::SceneList;
use crate::viewer::view::layout::WindowLayout;

/// The magnifier, and the answers about its pixel.
#[derive(Debug)]
pub struct Inspection {
    pub(in crate::viewer) magnifier: Inspector,
    /// Where the inset lies in the window.
    pub(in crate::viewer) inset: Option<PlacedInset>,
    /// B's, where both share the window.
    pub(in crate::viewer) other_inset: Option<PlacedInset>,
    /// Whether there would be one, but for panels that leave it no room.
    pub(in crate::viewer) lacks_room: bool,
    pub(in crate::viewer) samples: Probing,
    pub(in crate::viewer) explanation: Explaining,
    pub(in crate::viewer) contributions: Contributing,
    /// The texel of the explanation that the pointer is over.
    pub(in crate::viewer) pointed_texel: Option<TexelPlace>,
}

impl Inspection {
    pub(in crate::viewer) fn new(samples: Probing, explanation: Explaining, contributions: Contributing) -> Self {
        Self {
            magnifier: Inspector::default(),
            inset: None,
            other_inset: None,
            lacks_room: false,
            samples,
            explanation,
            contributions,
            pointed_texel: None,
        }
    }

    /// What magnifies a pixel.
    pub fn magnifier(&self) -> &Inspector {
        &self.magnifier
    }

    /// The inset in the window, where it is open and has room.
    pub fn inset(&self) -> Option<PlacedInset> {
        self.inset
    }

    /// The inset of the same pixel of B, where A and B share the window.
    pub fn other_inset(&self) -> Option<PlacedInset> {
        self.other_inset
    }

    /// Whether it is open, and hidden because panels leave it no room.
    pub fn lacks_room(&self) -> bool {
        self.lacks_room
    }

    /// Grows with every pixel that is pinned.
    pub fn pins(&self) -> u64 {
        self.magnifier.pins
    }

    /// Where in the window a hand asked about the pinned pixel; `None` where it was pinned otherwise.
    pub fn asked_at(&self) -> Option<AskedAt> {
        self.magnifier.pin.and(self.magnifier.asked_at)
    }

    /// Whether a hand asked why the pinned pixel has its colour, and not only a lesson's step.
    pub fn asks_about_pixel(&self) -> bool {
        self.magnifier.asked
    }

    /// Why the pinned pixel has its colour in the last frame that was finished; `None` until it was found out, and while
    /// no pixel is pinned or the explanation is closed.
    pub fn explanation(&self) -> Option<&Explanation> {
        Some(&self.explanation.answer()?.as_ref()?.own)
    }

    /// The same of B, where B is drawn by us too.
    pub fn other_explanation(&self) -> Option<&Explanation> {
        self.explanation.answer()?.as_ref()?.other.as_ref()
    }

    /// The samples of the pixel in the middle of the open inspector, in the order of the sample pattern; empty until
    /// they were found out.
    pub fn pixel_samples(&self) -> &[ProbedSample] {
        self.samples.answer().map_or(&[], Vec::as_slice)
    }

    /// What the samples of the inspected pixel hit, and how many each, in the order of the samples.
    pub fn hits(&self) -> Vec<(&Hit, usize)> {
        let mut hits: Vec<(&Hit, usize)> = Vec::new();
        for sample in self.pixel_samples() {
            match hits.iter_mut().find(|(hit, _)| **hit == sample.hit) {
                Some((_, count)) => *count += 1,
                None => hits.push((&sample.hit, 1)),
            }
        }
        hits
    }

    /// As the inset draws them.
    pub(in crate::viewer) fn sample_marks(&self) -> Vec<SampleMark> {
        self.pixel_samples().iter().map(|sample| sample.mark).collect()
    }

    /// The texel that is pointed at in the explanation.
    pub fn pointed_texel(&self) -> Option<TexelPlace> {
        self.pointed_texel
    }

    /// The pixels around the pinned one that read the texel pointed at; empty until they were found out.
    pub fn contributed_pixels(&self) -> &[ContributedPixel] {
        let found = self.contributions.answer().and_then(Option::as_ref);
        found
            .zip(self.pointed_texel)
            .map_or(&[], |(found, texel)| found.of(texel))
    }

    /// The pixels that were looked at for [`Inspection::contributed_pixels`]; `None` until they were.
    pub fn contributions_region(&self) -> Option<Region> {
        Some(self.contributions.answer()?.as_ref()?.searched)
    }

    /// Whether everything that is asked about the pixel was found out.
    pub(in crate::viewer) fn is_answered(&self) -> bool {
        self.samples.is_current() && self.explanation.is_current() && self.contributions.is_current()
    }

    /// The inset that lies over a window pixel, A's or B's.
    pub(in crate::viewer) fn inset_at(&self, at: [i64; 2]) -> Option<PlacedInset> {
        let mut insets = self.inset.into_iter().chain(self.other_inset);
        insets.find(|placed| placed.rect.contains(at))
    }

    /// The pinned pixel; `None` too while the pinned place of the scene is outside the frame.
    pub(in crate::viewer) fn pinned_pixel(&self, layout: &WindowLayout) -> Option<[u32; 2]> {
        layout.in_frame(self.magnifier.pin?.pixel)
    }

    /// The pixel in the middle of the inspector: the pinned one, else the one last under the pointer, else the one in
    /// the middle of the frame.
    pub(in crate::viewer) fn inspected_pixel(&self, layout: &WindowLayout) -> Option<[u32; 2]> {
        let middle = layout.frame_size().map(|side| i64::from(side / 2));
        let free = self.magnifier.last.map_or(middle, |pixel| pixel.map(i64::from));
        self.pinned_pixel(layout).or_else(|| layout.nearest_in_frame(free))
    }

    /// Whether there is to be an explanation in the window.
    pub(in crate::viewer) fn explains(&self, chrome: &Chrome, scenes: &SceneList, layout: &WindowLayout) -> bool {
        self.has_explanation_open(chrome, scenes) && self.pinned_pixel(layout).is_some()
    }

    /// The same, whether or not the pinned place is in sight.
    pub(in crate::viewer) fn has_explanation_open(&self, chrome: &Chrome, scenes: &SceneList) -> bool {
        let is_open = self.magnifier.open && !chrome.hidden && !scenes.has_no_picture();
        is_open && chrome.shown.explanation && self.magnifier.pin.is_some()
    }
}
