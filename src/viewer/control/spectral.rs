//! The spectrum at this moment: of what it is asked, what was found, where in the window its pixels lie.

use std::sync::Arc;

use glam::DVec2;

use crate::compare::{SpectrumAnalysis, SpectrumOf};
use crate::raster::Region;
use crate::viewer::PixelRect;
use crate::viewer::SpectrumCommand;
use crate::viewer::ab::other::Arrangement;
use crate::viewer::ab::sides::Filling;
use crate::viewer::chrome::Chrome;
use crate::viewer::control::hand::Hand;
use crate::viewer::control::pointing::Pointing;
use crate::viewer::spectrum::question::{SpectrumFound, SpectrumPlace, SpectrumQuestion};
use crate::viewer::spectrum::{SpectrumPart, SpectrumState};
use crate::viewer::view::layout::magnified;
use crate::viewer::view::panes::Pane;

/// The spectrum of the picture.
#[derive(Clone, Copy, Debug)]
pub struct Spectral<'a> {
    pub(in crate::viewer) pixels: Pointing<'a>,
    pub(in crate::viewer) chrome: &'a Chrome,
    pub(in crate::viewer) state: &'a SpectrumState,
}

/// Where the pixels of a spectrum are in a pane of the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectrumPane {
    /// Their upper left corner, in window pixels; it may lie outside the pane.
    pub corner: DVec2,
    /// Width and height of all of them, in window pixels.
    pub size: DVec2,
    /// The pane.
    pub area: PixelRect,
}

impl<'a> Spectral<'a> {
    /// Whether a spectrum is to be seen.
    pub fn is_open(&self) -> bool {
        self.state.open && !self.chrome.hidden
    }

    /// Of what.
    pub fn of(&self) -> SpectrumOf {
        self.state.of
    }

    /// Of which part of the picture.
    pub fn part(&self) -> SpectrumPart {
        self.state.part
    }

    /// The part of the frame that panels leave free, and whether that is all of the frame.
    pub fn free(&self) -> (Region, bool) {
        let layout = &self.pixels.both.layout;
        let free = layout.free_region();
        (free, free == Region::of_size(layout.frame_size()))
    }

    /// Whether a pixel is pinned that parts and textures can follow.
    pub fn has_pin(&self) -> bool {
        self.pixels.pinned().is_some()
    }

    /// The newest spectrum; `None` before the first, and where there is none.
    pub fn found(&self) -> Option<&'a Arc<SpectrumFound>> {
        self.state.spectra.newest().and_then(Option::as_ref)
    }

    /// Whether that is the one of this moment.
    pub fn is_current(&self) -> bool {
        self.pixels.both.frames.drawing.is_current() && self.state.spectra.is_current()
    }

    /// Whether it says of which picture it is: there is a B, and the spectrum is A's.
    pub fn is_of_a(&self) -> bool {
        self.pixels.both.ab.other().is_some()
    }

    /// Where the pixels of the newest spectrum are to be seen: wherever A is on the screen, and nowhere where it is not.
    pub fn panes(&self) -> Vec<SpectrumPane> {
        let Some(found) = self.found() else {
            return Vec::new();
        };
        let region = SpectrumAnalysis::middle_of(found.place.region);
        let layout = &self.pixels.both.layout;
        let zoom = f64::from(layout.zoom());
        let pixels = |[x, y]: [u32; 2]| DVec2::new(f64::from(x), f64::from(y));
        let place = self.panes_of_a().into_iter().map(|pane| SpectrumPane {
            corner: (pixels([region.x, region.y]) + DVec2::new(pane.corner[0] as f64, pane.corner[1] as f64)) * zoom,
            size: pixels([region.width, region.height]) * zoom,
            area: magnified(&pane.area, layout.zoom()),
        });
        place.collect()
    }

    /// The pane that shows A; of a wipe what lies on A's side of the line.
    fn panes_of_a(&self) -> Option<Pane> {
        let both = self.pixels.both;
        let panes = both.layout.panes();
        let swapped = both.ab.is_swapped();
        match both.ab.arrangement() {
            Arrangement::Difference => None,
            Arrangement::Alone | Arrangement::Flip => (both.ab.filling() == Filling::A).then_some(panes.first),
            Arrangement::SideBySide if swapped => panes.second,
            Arrangement::SideBySide => Some(panes.first),
            Arrangement::Wipe => {
                let Some(line) = both.wipe_column() else {
                    return Some(panes.first);
                };
                let Pane { corner, area } = panes.first;
                let line = line.clamp(area.x, area.right());
                let (from, to) = if swapped { (line, area.right()) } else { (area.x, line) };
                let area = PixelRect {
                    x: from,
                    width: u32::try_from(to - from).unwrap_or(0),
                    ..area
                };
                Some(Pane { area, corner })
            }
        }
    }

    /// What is asked; `None` while there is nothing to show.
    pub(in crate::viewer) fn question(&self) -> Option<SpectrumQuestion> {
        let picture = &self.pixels.both.frames.frame().filter(|_| self.is_open())?.picture;
        let size = picture.size;
        let pixel = self.pixels.pinned().or_else(|| self.pixels.middle())?;
        let free = self.pixels.both.layout.free_region();
        let place = SpectrumPlace {
            region: self.state.part.region(size, free, pixel),
            pixel,
        };
        (!size.contains(&0)).then(|| SpectrumQuestion {
            picture: picture.clone(),
            place,
            of: self.state.of,
        })
    }
}

impl Hand<'_> {
    pub(in crate::viewer) fn spectral(&self) -> Spectral<'_> {
        Spectral {
            pixels: self.pixels(),
            chrome: self.chrome,
            state: self.spectrum,
        }
    }

    pub(in crate::viewer) fn apply_spectrum(&mut self, command: SpectrumCommand) {
        // What is hidden is not open to the eye.
        let was_open = self.spectral().is_open();
        self.spectrum.open = match command {
            SpectrumCommand::Show(toggle) => toggle.of(was_open),
            SpectrumCommand::Of(of) => {
                self.spectrum.of = of;
                true
            }
            SpectrumCommand::Part(part) => {
                self.spectrum.part = part;
                true
            }
        };
        if self.spectrum.open {
            // Both cards would lie on each other in a small window.
            self.profiling.show(false);
            self.chrome.hidden = false;
        }
    }

    /// Asks for the spectrum. While the picture moves, the last one stays.
    pub(in crate::viewer) fn want_spectrum(&mut self) {
        if self.spectrum.open && !self.frames.drawing.is_current() {
            return;
        }
        let question = self.spectral().question();
        self.spectrum.spectra.want(question, |_| None);
    }
}
