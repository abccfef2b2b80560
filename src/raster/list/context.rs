//! What filling a chunk needs to know about the drawing: the frame, its samples and tiles.

use glam::DVec2;

use crate::geometry::subpixel::{GridPoint, SubpixelGrid};
use crate::raster::sampling::pattern::{SamplePattern, Seed};
use crate::raster::sampling::pixel_coverage::PixelCoverage;
use crate::raster::sampling::positions::lattice;
use crate::raster::sampling::rate::SampleRate;
use crate::raster::sampling::shading_rate::ShadingRate;
use crate::raster::settings::RasterSettings;
use crate::raster::span::{Span, SpanRect};
use crate::raster::tile_layout::TileLayout;
use crate::rules::Rules;

/// What a chunk needs to know about the drawing.
#[derive(Clone, Copy, Debug)]
pub struct ListContext {
    /// Where vertices and samples may lie.
    pub(crate) grid: SubpixelGrid,
    /// Where samples do, and how many there are: a rate that the pattern takes.
    pub(crate) pattern: SamplePattern,
    pub(crate) seed: Seed,
    pub(crate) rate: SampleRate,
    pub(crate) rules: Rules,
    /// How often primitives are shaded in a pixel: at each sample where that is the same.
    pub(crate) shading: ShadingRate,
    /// What tells how much of a pixel a primitive covers.
    pub(crate) coverage: PixelCoverage,
    /// Pixels in a row, rows: of the frame.
    pub(crate) frame_size: [u32; 2],
    /// The same of what is painted, the frame and a margin around it, whose pixels are counted from the margin's first.
    pub(crate) size: [u32; 2],
    /// Pixels of the frame on each side of a pixel that it takes samples from.
    pub(crate) margin: u32,
    pub(crate) tiles: TileLayout,
}

impl ListContext {
    /// For a frame of `size` pixels.
    pub fn new(size: [u32; 2], settings: &RasterSettings) -> Self {
        Self::with_tiles(
            size,
            settings,
            TileLayout::for_rate(settings.sampled().0, settings.filter.margin(), size),
        )
    }

    pub(crate) fn with_tiles(size: [u32; 2], settings: &RasterSettings, tiles: TileLayout) -> Self {
        let (rate, pattern) = settings.sampled();
        let margin = settings.filter.margin();
        Self {
            grid: lattice(pattern, rate),
            pattern,
            seed: settings.seed,
            rate,
            rules: settings.sampling.rules,
            shading: if pattern == SamplePattern::Grid && rate == SampleRate::ONE {
                ShadingRate::Sample
            } else {
                settings.shading
            },
            coverage: settings.coverage,
            frame_size: size,
            size: size.map(|pixels| pixels + 2 * margin),
            margin,
            tiles: tiles.with_margin(margin),
        }
    }

    /// The box of the samples that a triangle may cover; of the pixels that it touches, where areas count.
    #[inline]
    pub(crate) fn samples_of(&self, corners: [GridPoint; 3]) -> SpanRect {
        if self.coverage.is_exact() {
            return SpanRect::of_touched(corners, self.grid);
        }
        SpanRect::of_samples(corners, self.grid, self.rules)
    }

    /// What a place in the frame, in pixels, has to be moved by to where it is painted.
    pub(crate) fn shift(&self) -> DVec2 {
        DVec2::splat(f64::from(self.margin))
    }

    /// Whether samples are all those of the grid.
    pub(crate) fn is_grid(&self) -> bool {
        self.pattern == SamplePattern::Grid
    }

    /// The samples that are painted.
    pub(crate) fn samples(&self) -> SpanRect {
        let all = |pixels: u32| Span {
            start: 0,
            end: pixels.cast_signed() * self.grid.side(),
        };
        SpanRect {
            x: all(self.size[0]),
            y: all(self.size[1]),
        }
    }

    /// The pixels that hold any sample of a box, clipped to what is painted; `None` when there are none.
    pub(crate) fn pixels_of(&self, samples: SpanRect) -> Option<SpanRect> {
        let side = self.grid.side();
        let frame = self.samples();
        let pixels = |span: Span, frame: Span| {
            let inside = span.intersection(frame);
            (!inside.is_empty()).then(|| Span {
                start: inside.start / side,
                end: (inside.end - 1) / side + 1,
            })
        };
        Some(SpanRect {
            x: pixels(samples.x, frame.x)?,
            y: pixels(samples.y, frame.y)?,
        })
    }
}
