//! What a kernel needs for the lists of one call: levels as they are counted from a list's origin, and taps.

use glam::DVec2;

use super::cubic::TexelWeights;
use super::wrap::Endless;
use super::{MipLevel, PixelSampling, Taps, Wrap};

/// Some pixels, and which of their samples count.
#[derive(Clone, Copy, Debug)]
pub struct PixelList<'a> {
    /// Column and row of each pixel, counted from the grid's origin.
    pub pixels: &'a [[u16; 2]],
    /// As many as pixels; bit `j` of `masks[i]` says whether sample `j` of `pixels[i]`, counted row by row, takes part.
    /// Samples from the 64th on do not, then. Without masks all take part.
    pub masks: Option<&'a [u64]>,
}

/// A level as the lists of one call see it: counted in samples from the origin of their grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct GridLevel<'a> {
    pub(super) level: &'a MipLevel,
    /// Its number in the pyramid.
    pub(super) number: usize,
    /// Its part of [`super::fixed_point::MASS`].
    pub(super) mass: i32,
    pub(super) x: Axis,
    pub(super) y: Axis,
}

/// One coordinate of a level, in texels, as an affine function of sample column and row relative to the pivot.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    pub(super) at_pivot: f64,
    /// Change per sample to the right, and down.
    pub(super) right: f64,
    pub(super) down: f64,
    /// The greatest coordinate, at the centre of the last texel.
    pub(super) last: f64,
}

/// The taps of each sample, as the lists of one call see them.
#[derive(Clone, Copy, Debug)]
pub(super) struct TapLine {
    pub(super) taps: Taps,
    /// Length of the line that they are spread over, in steps from sample to sample.
    pub(super) steps: f64,
}

/// All that a kernel needs for the lists of one call.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan<'a> {
    pub(super) pixel: PixelSampling,
    /// Beyond the border.
    pub(super) wrap: Wrap,
    /// Sample `[0, 0]` relative to the pivot, in samples.
    pub(super) first: DVec2,
    pub(super) line: TapLine,
    pub(super) finer: GridLevel<'a>,
    pub(super) coarser: Option<GridLevel<'a>>,
}

impl Plan<'_> {
    /// Whether blocks of texels are read: by cubic kernels, and across borders.
    pub(super) fn reads_blocks(&self) -> bool {
        self.pixel.cubic().is_some() || self.wrap != Wrap::Clamp
    }

    /// What texels are weighed by where blocks of them are read.
    // Not kept: plans are copied, and most need none.
    pub(super) fn block(&self) -> Option<TexelWeights> {
        self.reads_blocks().then(|| TexelWeights::new(self.pixel))
    }

    /// An axis as one that goes on for ever, where the texture does.
    pub(super) fn endless(&self, axis: &Axis) -> Option<Endless> {
        Endless::new(self.wrap, axis.last, self.pixel)
    }
}

impl Axis {
    /// How far tap `i` lies from its sample, in texels.
    pub(super) fn tap(&self, line: &TapLine, i: u32) -> f64 {
        let step = if line.taps.along_x { self.right } else { self.down };
        step * line.steps * line.taps.place(i)
    }
}
