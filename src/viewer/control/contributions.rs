//! Which pixels the texel under the pointer contributes to.

use crate::inspect::{ContributedPixel, TexelPlace};
use crate::raster::Region;
use crate::viewer::inspector::samples::Target;
use crate::viewer::state::Viewer;

impl Viewer {
    /// The texel that is pointed at in the explanation.
    pub fn pointed_texel(&self) -> Option<TexelPlace> {
        self.inspector.pointed_texel
    }

    /// The pixels around the pinned one that read the texel pointed at; empty until they were found out.
    pub fn contributed_pixels(&self) -> &[ContributedPixel] {
        let found = self.inspector.contributions.answer().and_then(Option::as_ref);
        found
            .zip(self.inspector.pointed_texel)
            .map_or(&[], |(found, texel)| found.of(texel))
    }

    /// The pixels that were looked at for [`Viewer::contributed_pixels`]; `None` until they were.
    pub fn contributions_region(&self) -> Option<Region> {
        Some(self.inspector.contributions.answer()?.as_ref()?.searched)
    }

    /// Sees to it that what the texel pointed at contributes to is found out.
    pub(in crate::viewer) fn want_contributions(&mut self) {
        if !self.explains() {
            self.inspector.pointed_texel = None;
        }
        let pixel = self.pinned_pixel().filter(|_| self.inspector.pointed_texel.is_some());
        let target = pixel.zip(self.frame()).map(|(pixel, frame)| Target {
            picture: frame.picture.clone(),
            pixel,
        });
        self.inspector.contributions.want(target, |_| None);
    }
}
