//! One pixel painted again, with everything noted that was done to it.
//!
//! The painters are those of frames. What the pixel becomes is painted as its tile is, and what each command does to each
//! sample by the painter that blends command by command: hidden fragments appear too, which frames leave out.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::color::Premultiplied16;
use crate::raster::DisplayList;
use crate::raster::binning::bins::{Bins, entries_of_tile};
use crate::raster::binning::tile_command::TileCommand;
use crate::raster::binning::visible::first_visible;
use crate::raster::display_list::Pass;
use crate::raster::frame::block::PixelBlock;
use crate::raster::list::chunk::Chunk;
use crate::raster::list::context::ListContext;
use crate::raster::paint::method::Method;
use crate::raster::paint::recorder::{PaintedCommand, PaintedKind};
use crate::raster::sampling::positions::Position;
use crate::raster::span::{PixelRect, Span};
use crate::raster::stats::SharedTally;
use crate::raster::tile_layout::TileLayout;
use crate::raster::tiles::Painters;

/// How a pixel came about.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelReplay {
    /// Its samples when everything is painted, in the order of the pattern.
    pub samples: Vec<ReplayedSample>,
    /// What painted it, in painter's order; commands that touch none of its samples may be among it.
    pub painted: Vec<PaintedCommand>,
    /// The sums of the samples' channels that are resolved.
    pub sums: [u32; 4],
    /// Whether the sums were taken before shaded samples were rounded to 16 bits, and so may differ from those of
    /// `samples` in the last bits.
    pub summed_exactly: bool,
    /// What they resolve to: `0xAARRGGBB`, as in the frame.
    pub pixel: u32,
}

/// What one sample of a pixel holds when everything is painted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReplayedSample {
    /// Its place in the pixel, `(0, 0)` the top left corner, `(1, 1)` the bottom right.
    pub position: [f64; 2],
    /// What it weighs in the pixel: all samples together 1.
    pub weight: f64,
    /// Its colour.
    pub color: Premultiplied16,
    /// How many fragments it got, those included that are hidden or forgotten.
    pub fragments: usize,
}

impl PixelReplay {
    /// What painted each sample last and was not taken away by a clip path or mask; `None` for the background.
    pub fn sources(&self) -> Vec<Option<u32>> {
        let nothing = vec![None; self.samples.len()];
        let mut layers = vec![nothing.clone()];
        for command in &self.painted {
            match command.kind {
                PaintedKind::Primitive => {
                    if let Some(top) = layers.last_mut() {
                        for fragment in &command.fragments {
                            top[fragment.sample] = Some(command.source);
                        }
                    }
                }
                PaintedKind::BeginLayer => layers.push(nothing.clone()),
                PaintedKind::EndLayer(compositing) => {
                    let layer = if layers.len() > 1 { layers.pop() } else { None };
                    let (Some(layer), Some(below)) = (layer, layers.last_mut()) else {
                        continue;
                    };
                    if compositing.keeps_below() {
                        for (below, above) in below.iter_mut().zip(layer) {
                            *below = above.or(*below);
                        }
                    } else {
                        for fragment in command
                            .fragments
                            .iter()
                            .filter(|fragment| compositing.hides(fragment.color))
                        {
                            below[fragment.sample] = None;
                        }
                    }
                }
            }
        }
        layers.swap_remove(0)
    }
}

impl DisplayList<'_> {
    /// Paints pixel `(x, y)` again; `None` outside the frame.
    pub fn replay(&self, x: u32, y: u32) -> Option<PixelReplay> {
        if x >= self.context.size[0] || y >= self.context.size[1] {
            return None;
        }
        let at = [x.cast_signed(), y.cast_signed()];
        let bins = self.bins_of_pixel(at);
        let chunks: Vec<(&Chunk, &[TileCommand])> = self
            .chunks
            .iter()
            .zip(&bins)
            .map(|(chunk, bins)| (chunk, bins.of_tile(0)))
            .collect();
        let mut painters = self.painters_of(Span {
            start: at[0],
            end: at[0] + 1,
        });
        let (painted, samples) =
            painters
                .per_sample
                .replay(&chunks, (at, self.background()), &mut painters.shape_coverage);
        let cancelled = AtomicBool::new(false);
        let pass = Pass {
            bins,
            first_row: y,
            cancelled: &cancelled,
            tally: SharedTally::default(),
        };
        let pixel = self.alone(&pass, &mut painters, at);
        let by_visibility = self.method(&pass, 0, first_visible(&pass.bins, 0)) == Method::Visibility;
        let shaded = by_visibility.then(|| painters.visibility.shaded_sums()).flatten();
        let positions = self.positions(at);
        let weights = self.shade_context().filter.weights(&positions);
        Some(PixelReplay {
            sums: shaded.unwrap_or_else(|| sums(samples.iter().map(|(color, _)| color))),
            summed_exactly: shaded.is_some(),
            samples: positions
                .into_iter()
                .zip(weights)
                .zip(samples)
                .map(|((position, weight), (color, fragments))| ReplayedSample {
                    position,
                    weight,
                    color,
                    fragments,
                })
                .collect(),
            painted,
            pixel,
        })
    }

    /// What [`PixelReplay::pixel`] would be, without noting what paints it; `None` outside the frame.
    pub fn pixel(&self, x: u32, y: u32) -> Option<u32> {
        if x >= self.context.size[0] || y >= self.context.size[1] {
            return None;
        }
        let at = [x.cast_signed(), y.cast_signed()];
        let cancelled = AtomicBool::new(false);
        let pass = Pass {
            bins: self.bins_of_pixel(at),
            first_row: y,
            cancelled: &cancelled,
            tally: SharedTally::default(),
        };
        let mut painters = self.painters_of(Span {
            start: at[0],
            end: at[0] + 1,
        });
        Some(self.alone(&pass, &mut painters, at))
    }

    /// Paints a pixel as a tile of its own, the first of the pass.
    fn alone<'s>(&'s self, pass: &Pass<'_>, painters: &mut Painters<'s>, at: [i32; 2]) -> u32 {
        let mut pixel = [0];
        let one = |start: i32| Span { start, end: start + 1 };
        let rect = PixelRect {
            x: one(at[0]),
            y: one(at[1]),
        };
        self.numbered_tile(pass, painters, 0, &mut PixelBlock::new(rect, &mut pixel, 1));
        pixel[0]
    }

    /// The commands that touch a pixel of the frame.
    pub(in crate::raster) fn bins_of_pixel(&self, pixel: [i32; 2]) -> Vec<Arc<Bins>> {
        let context = ListContext {
            tiles: TileLayout::new((0, 0), self.context.size),
            ..self.context
        };
        let bins = |chunk| {
            Arc::new(Bins::of_one_tile(entries_of_tile(
                chunk,
                &context,
                &self.sources,
                pixel,
            )))
        };
        self.chunks.iter().map(bins).collect()
    }

    /// Where samples lie in a pixel.
    fn positions(&self, pixel: [i32; 2]) -> Vec<[f64; 2]> {
        let grid = self.context.grid;
        let mut memory = Vec::new();
        let places = self.places();
        let position = |place: &Position| place.map(|at| grid.sample_position(at.into()));
        places.of_pixel(pixel, &mut memory).iter().map(position).collect()
    }
}

/// The sums of colours, channel by channel.
fn sums<'a>(samples: impl Iterator<Item = &'a Premultiplied16>) -> [u32; 4] {
    let mut sums = [0; 4];
    for sample in samples {
        for (sum, channel) in sums.iter_mut().zip(sample.0) {
            *sum += u32::from(channel);
        }
    }
    sums
}
