//! Which texels a sample read by an area, and what each weighs: the counterpart of `trace`, for explanations.

use glam::DVec2;

use super::area_filter::{AreaFilter, Kind, at};
use super::box_means::BoxFilter;
use super::ewa_filter::EwaFilter;
use super::ripmap_filter::ReadSamples;
use super::texel_blocks::EndlessLevel;
use super::{SampleGrid, TapRead, TexelRead, TextureReads};

impl AreaFilter<'_> {
    /// What the sample in column and row `point`, counted from the first sample of the grid's origin, reads. Levels of a ripmap
    /// have its numbers.
    pub fn reads(&self, grid: SampleGrid, point: [u16; 2]) -> TextureReads {
        match &self.0 {
            Kind::Ewa { place, filter } => {
                let plan = place.plan(grid);
                filter.reads(plan.finer.number, at(&plan, point))
            }
            Kind::Summed { place, filter, .. } => filter.reads(at(&place.plan(grid), point)),
            Kind::Ripmap(filter) => filter.reads(grid, point),
        }
    }
}

impl EwaFilter<'_> {
    fn reads(&self, level: usize, at: DVec2) -> TextureReads {
        let EndlessLevel { level: texels, wrap } = self.texels;
        let mut found = Vec::new();
        self.each(at, |[x, y], weight| {
            let inside = |at: i32, side: u32| wrap.texel(at, side).cast_unsigned();
            found.push(TexelRead {
                level,
                at: [inside(x, texels.width()), inside(y, texels.height())],
                color: texels.wrapped(wrap, [x, y]),
                weight,
            });
        });
        let reads = TextureReads {
            texels: found,
            taps: vec![TapRead { level, at: at + 0.5 }],
            wrap,
            summed: None,
        };
        reads.once()
    }
}

impl BoxFilter<'_> {
    fn reads(&self, at: DVec2) -> TextureReads {
        let at = at + 0.5;
        let Self { table, texels, area } = *self;
        let EndlessLevel { level: base, wrap } = texels;
        let texel = |(place, weight): ([u32; 2], f64)| TexelRead {
            level: area.level,
            at: place,
            color: base.texel(place[0].cast_signed(), place[1].cast_signed()),
            weight,
        };
        let found = table.texels(at, &area, wrap).unwrap_or_default();
        let reads = TextureReads {
            texels: found.into_iter().map(texel).collect(),
            taps: vec![TapRead { level: area.level, at }],
            wrap,
            summed: Some(table.read(at, &area, wrap)),
        };
        reads.once()
    }
}
