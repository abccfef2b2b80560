//! What is to be drawn into a frame: chunks in painter's order, their textures and the settings.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::color::Premultiplied16;
use crate::raster::binning::bins::{Bins, Plan};
use crate::raster::coverage::area::shape_area::ShapeArea;
use crate::raster::coverage::free_positions::FreePositions;
use crate::raster::coverage::shape_coverage::ShapeCoverage;
use crate::raster::list::chunk::{Chunk, measure_layers};
use crate::raster::list::context::ListContext;
use crate::raster::paint::method::Kinds;
use crate::raster::sampling::positions::SamplePositions;
use crate::raster::settings::{RasterSettings, Recolor};
use crate::raster::shading::context::ShadeContext;
use crate::raster::shading::sources::PaintSources;
use crate::raster::span::Span;
use crate::raster::stats::SharedTally;

/// A display list ready to be drawn.
#[derive(Debug)]
pub struct DisplayList<'a> {
    pub(in crate::raster) context: ListContext,
    pub(in crate::raster) settings: RasterSettings,
    pub(in crate::raster) chunks: Vec<Chunk>,
    pub(in crate::raster) sources: PaintSources<'a>,
    pub(in crate::raster) kinds: Kinds,
    background: Premultiplied16,
}

/// One group of tile rows on its way to the frame.
pub(in crate::raster) struct Pass<'a> {
    /// The entries of each chunk.
    pub(in crate::raster) bins: Vec<Arc<Bins>>,
    pub(in crate::raster) first_row: u32,
    pub(in crate::raster) cancelled: &'a AtomicBool,
    pub(in crate::raster) tally: SharedTally,
}

impl<'a> DisplayList<'a> {
    /// Chunks in painter's order, built with `context`; [`crate::raster::Paint::texture`] points into `textures`.
    pub fn new(
        context: ListContext,
        settings: RasterSettings,
        mut chunks: Vec<Chunk>,
        mut sources: PaintSources<'a>,
    ) -> Self {
        sources.shift(context.shift());
        measure_layers(&mut chunks, &context);
        let mut outlines = 0;
        for chunk in &mut chunks {
            chunk.first_outline = outlines;
            outlines += chunk.outlines.len();
        }
        let rules = settings.sampling.rules;
        let background = Premultiplied16::from_straight(settings.background, rules);
        let kinds = Kinds::of(&chunks, &sources, rules, background);
        Self {
            context,
            settings,
            chunks,
            sources,
            kinds,
            background,
        }
    }

    /// Triangles in the list.
    pub fn triangles(&self) -> u64 {
        self.chunks.iter().map(|chunk| chunk.triangle_count).sum()
    }

    /// How many commands the list has.
    pub fn commands(&self) -> usize {
        self.chunks.iter().map(|chunk| chunk.commands.len()).sum()
    }

    /// Whether every tile is painted straight into the frame.
    pub(in crate::raster) fn is_direct(&self) -> bool {
        self.kinds.are_direct(&self.context, self.settings.filter)
    }

    pub(in crate::raster) fn background(&self) -> Premultiplied16 {
        self.background
    }

    /// Counts what each tile will hold.
    pub(in crate::raster) fn plan(&self) -> Plan {
        Plan::new(&self.chunks, &self.context, &self.sources)
    }

    /// Sorts everything into the tiles of some tile rows.
    pub(in crate::raster) fn pass<'p>(&self, plan: &Plan, rows: Span, cancelled: &'p AtomicBool) -> Pass<'p> {
        Pass {
            bins: plan.bins(&self.chunks, &self.context, &self.sources, rows),
            first_row: rows.start.cast_unsigned(),
            cancelled,
            tally: SharedTally::default(),
        }
    }

    pub(in crate::raster) fn shade_context(&self) -> ShadeContext<'_> {
        ShadeContext {
            grid: self.context.grid,
            rate: self.context.rate,
            filter: self.settings.filter,
            space: self.settings.space,
            shading: self.context.shading,
            sampling: self.settings.sampling,
            clamped: match self.settings.recolor {
                Some(Recolor::Clamped(color)) => Some(color),
                Some(Recolor::Palette(_)) | None => None,
            },
            sources: &self.sources,
        }
    }

    /// Whether the resolve of tiles says what it clamped.
    pub(in crate::raster) fn tells_clamped(&self) -> bool {
        matches!(self.settings.recolor, Some(Recolor::Clamped(_))) && !self.settings.filter.is_plain()
    }

    /// How many outlines there are.
    pub(in crate::raster) fn outlines(&self) -> usize {
        self.chunks.iter().map(|chunk| chunk.outlines.len()).sum()
    }

    /// Where samples lie, on the lattice of the grid.
    pub(in crate::raster) fn places(&self) -> SamplePositions {
        SamplePositions::new(self.context.pattern, self.context.rate, self.context.seed)
            .with_margin(self.context.margin)
    }

    /// What finds coverage, in these columns of pixels.
    pub(in crate::raster) fn shape_coverage(&self, columns: Span) -> ShapeCoverage {
        let rows = self.grid_rows();
        if self.context.coverage.is_exact() {
            let columns = self.context.size[0].cast_signed();
            return rows.with_area(ShapeArea::new(self.context.grid, columns, self.outlines()));
        }
        if self.context.is_grid() {
            rows
        } else {
            rows.with(self.free_positions(columns))
        }
    }

    /// As [`DisplayList::shape_coverage`] by spans, for samples that are those of the grid.
    fn grid_rows(&self) -> ShapeCoverage {
        let columns = self.context.samples().x.end;
        ShapeCoverage::new(self.context.grid, self.context.rules, columns, self.outlines())
    }

    /// What finds coverage in some columns of pixels sample by sample, wherever samples lie.
    pub(in crate::raster) fn free_positions(&self, columns: Span) -> FreePositions {
        FreePositions::new(
            self.context.grid,
            self.context.rules,
            self.places(),
            self.outlines(),
            columns,
        )
    }
}
