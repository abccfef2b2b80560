//! The samples of the inspected pixel, for the frame on the screen.

use crate::figure::SampleMark;
use crate::viewer::inspector::samples::{Hit, ProbedSample, Target};
use crate::viewer::state::Viewer;

/// Probing so many primitives takes less than a millisecond: dots that come at once do not flicker.
const FEW: usize = 4000;

impl Viewer {
    /// The samples of the pixel in the middle of the open inspector, in the order of the sample pattern; empty until
    /// they were found out.
    pub fn pixel_samples(&self) -> &[ProbedSample] {
        self.inspector.samples.answer().map_or(&[], Vec::as_slice)
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

    /// Sees to it that the samples of the pixel in the middle of the inset are found out, for the frame on the screen.
    pub(in crate::viewer) fn want_samples(&mut self) {
        let center = self.inspector.inset.map(|placed| placed.inset.center);
        let pixel = center.and_then(|center| self.in_frame(center));
        let target = pixel.zip(self.frame()).map(|(pixel, frame)| Target {
            picture: frame.picture.clone(),
            pixel,
        });
        self.inspector.samples.want(target, |target| {
            (target.picture.scene.primitives.len() <= FEW).then(|| target.probe())
        });
    }
}
