//! One pixel painted again, with everything noted that was done to it.
//!
//! The painters are those of frames. What the pixel becomes is painted as its tile is, and what each command does to each
//! sample by the painter that blends command by command: hidden fragments appear too, which frames leave out.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::color::{Premultiplied16, WeightedSum};
use crate::raster::DisplayList;
use crate::raster::binning::bins::{Bins, entries_of_tile};
use crate::raster::binning::tile_command::{TileCommand, Work};
use crate::raster::binning::visible::{first_visible, visible};
use crate::raster::display_list::Pass;
use crate::raster::frame::block::PixelBlock;
use crate::raster::list::chunk::Chunk;
use crate::raster::list::context::ListContext;
use crate::raster::paint::method::{Method, Rounding};
use crate::raster::paint::recorder::{PaintedCommand, PaintedKind};
use crate::raster::sampling::positions::Position;
use crate::raster::span::{Span, SpanRect};
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
    /// Where the pixel takes samples of its neighbours too: how it came of all of them.
    pub around: Option<Around>,
}

/// How a pixel came of its own samples and its neighbours'.
#[derive(Clone, Debug, PartialEq)]
pub struct Around {
    /// The pixels any of whose samples weigh something, row by row, the pixel itself among them.
    pub pixels: Vec<WeighedPixel>,
    /// All samples together, each times its weight.
    pub sum: WeightedSum,
    /// Whether the filter's weights add up to too little, so that the pixel is the mean of its own samples instead.
    pub is_own_mean: bool,
}

/// The samples of one pixel, and what they weigh in another.
#[derive(Clone, Debug, PartialEq)]
pub struct WeighedPixel {
    /// How many columns to the right of the other one and how many rows below it the pixel lies.
    pub beside: [i32; 2],
    /// In the order of the pattern: what each weighs, in parts of [`WeightedSum::weight`], and its colour.
    pub samples: Vec<(i64, Premultiplied16)>,
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
    /// What paints pixel `(x, y)`, as [`DisplayList::replay`] tells it; nothing outside the frame.
    pub fn painted(&self, x: u32, y: u32) -> Vec<PaintedCommand> {
        if !self.holds([x, y]) {
            return Vec::new();
        }
        let at = self.painted_at([x, y]);
        let mut painters = self.painters_at(at);
        self.own_samples(at, &self.bins_of_pixel(at, 0), &mut painters).0
    }

    fn holds(&self, [x, y]: [u32; 2]) -> bool {
        let [width, height] = self.context.frame_size;
        x < width && y < height
    }

    /// Painters of a single pixel.
    fn painters_at(&self, at: [i32; 2]) -> Painters<'_> {
        self.painters_of(Span {
            start: at[0],
            end: at[0] + 1,
        })
    }

    /// What paints a pixel, and what its samples hold then.
    fn own_samples(
        &self,
        at: [i32; 2],
        bins: &[Arc<Bins>],
        painters: &mut Painters<'_>,
    ) -> (Vec<PaintedCommand>, Vec<(Premultiplied16, usize)>) {
        let chunks: Vec<(&Chunk, &[TileCommand])> = self
            .chunks
            .iter()
            .zip(bins)
            .map(|(chunk, bins)| (chunk, bins.of_tile(0)))
            .collect();
        painters
            .per_sample
            .replay(&chunks, at, self.background(), &mut painters.shape_coverage)
    }

    /// Paints pixel `(x, y)` again; `None` outside the frame.
    pub fn replay(&self, x: u32, y: u32) -> Option<PixelReplay> {
        if !self.holds([x, y]) {
            return None;
        }
        let at = self.painted_at([x, y]);
        let bins = self.bins_of_pixel(at, 0);
        let mut painters = self.painters_at(at);
        let (painted, samples) = self.own_samples(at, &bins, &mut painters);
        let positions = self.positions(at);
        if !self.settings.filter.is_plain() {
            return Some(self.replay_around([x, y], painted, positions, samples));
        }
        let cancelled = AtomicBool::new(false);
        let pass = Pass {
            bins,
            first_row: y,
            cancelled: &cancelled,
            tally: SharedTally::default(),
        };
        let pixel = self.alone(&pass, &mut painters, one_pixel(at));
        let by_visibility = self.method(&pass, 0, first_visible(&pass.bins, 0)) == Method::Visibility(Rounding::Sums);
        let shaded = by_visibility.then(|| painters.visibility.shaded_sums()).flatten();
        let of_samples = sums(samples.iter().map(|(color, _)| color));
        // Where it makes no difference, the sum of what the samples show says more.
        let shaded = shaded.filter(|shaded| *shaded != of_samples || self.rounds_sums(&pass));
        let weight = 1.0 / samples.len() as f64;
        Some(PixelReplay {
            sums: shaded.unwrap_or(of_samples),
            summed_exactly: shaded.is_some(),
            samples: positions
                .into_iter()
                .zip(samples)
                .map(|(position, (color, fragments))| ReplayedSample {
                    position,
                    weight,
                    color,
                    fragments,
                })
                .collect(),
            painted,
            pixel,
            around: None,
        })
    }

    /// Whether anything in the one tile of a pass is summed up before it is rounded.
    fn rounds_sums(&self, pass: &Pass<'_>) -> bool {
        if self.context.shading.is_once() {
            return false;
        }
        let rounds = |work: &Work<'_>| matches!(work, Work::Shaded(_, _, paint) if !paint.rounds_each_sample());
        let mut commands = visible(&pass.bins, 0, first_visible(&pass.bins, 0));
        commands.any(|(chunk, commands)| {
            commands
                .iter()
                .any(|command| rounds(&command.work(&self.chunks[chunk])))
        })
    }

    /// The same where the pixel takes samples of its neighbours: these are its own, and where they lie.
    fn replay_around(
        &self,
        pixel: [u32; 2],
        painted: Vec<PaintedCommand>,
        positions: Vec<[f64; 2]>,
        samples: Vec<(Premultiplied16, usize)>,
    ) -> PixelReplay {
        let mut resolved = [0];
        let painters = self.paint_alone(pixel, |painters, pass, rect| {
            // Also where one colour is all there is, which tiles need not paint to know.
            self.paint_tile(pass, painters, 0, &mut PixelBlock::new(rect, &mut resolved, 1));
        });
        let weighed = painters.per_sample.neighbourhood();
        let pixels = weighed.iter().flat_map(|weighed| &weighed.pixels);
        let sum = weighed.as_ref().map(|weighed| weighed.sum).unwrap_or_default();
        let is_own_mean = weighed.as_ref().is_some_and(|weighed| weighed.is_own_mean);
        let around: Vec<WeighedPixel> = pixels
            .map(|(beside, samples)| WeighedPixel {
                beside: *beside,
                samples: samples.clone(),
            })
            .collect();
        let own = around.iter().find(|pixel| pixel.beside == [0, 0]);
        let weight = |sample: usize| {
            let weight = own.map_or(0, |own| own.samples[sample].0);
            weight as f64 / sum.weight as f64
        };
        PixelReplay {
            sums: sums(samples.iter().map(|(color, _)| color)),
            summed_exactly: false,
            samples: positions
                .into_iter()
                .zip(samples)
                .enumerate()
                .map(|(sample, (position, (color, fragments)))| ReplayedSample {
                    position,
                    weight: weight(sample),
                    color,
                    fragments,
                })
                .collect(),
            painted,
            pixel: resolved[0],
            around: Some(Around {
                pixels: around,
                sum,
                is_own_mean,
            }),
        }
    }

    /// What [`PixelReplay::pixel`] would be, without noting what paints it; `None` outside the frame.
    pub fn pixel(&self, x: u32, y: u32) -> Option<u32> {
        if !self.holds([x, y]) {
            return None;
        }
        let mut pixel = None;
        self.paint_alone([x, y], |painters, pass, rect| {
            pixel = Some(self.alone(pass, painters, rect));
        });
        pixel
    }

    /// Has a pixel painted as a tile of its own; the painters still hold what they painted for it.
    fn paint_alone<'s>(
        &'s self,
        [x, y]: [u32; 2],
        paint: impl FnOnce(&mut Painters<'s>, &Pass<'_>, SpanRect),
    ) -> Painters<'s> {
        let at = [x, y].map(u32::cast_signed);
        let cancelled = AtomicBool::new(false);
        let margin = self.context.margin;
        let pass = Pass {
            bins: self.bins_of_pixel(at, margin),
            first_row: y,
            cancelled: &cancelled,
            tally: SharedTally::default(),
        };
        let mut painters = self.painters_of(Span {
            start: at[0],
            end: at[0] + 1 + 2 * margin.cast_signed(),
        });
        paint(&mut painters, &pass, one_pixel(at));
        painters
    }

    /// Paints a pixel of the frame as a tile of its own, the first of the pass.
    fn alone<'s>(&'s self, pass: &Pass<'_>, painters: &mut Painters<'s>, rect: SpanRect) -> u32 {
        let mut pixel = [0];
        self.numbered_tile(pass, painters, 0, &mut PixelBlock::new(rect, &mut pixel, 1));
        pixel[0]
    }

    /// The column and row of a pixel of the frame in what is painted.
    pub(in crate::raster) fn painted_at(&self, pixel: [u32; 2]) -> [i32; 2] {
        pixel.map(|at| (at + self.context.margin).cast_signed())
    }

    /// The commands that touch a tile of one pixel, which begins there, and `margin` around it.
    pub(in crate::raster) fn bins_of_pixel(&self, pixel: [i32; 2], margin: u32) -> Vec<Arc<Bins>> {
        let context = ListContext {
            tiles: TileLayout::new([0, 0], self.context.size).with_margin(margin),
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

/// The rectangle of one pixel.
fn one_pixel([x, y]: [i32; 2]) -> SpanRect {
    let one = |start: i32| Span { start, end: start + 1 };
    SpanRect { x: one(x), y: one(y) }
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
