//! Which texels a sample read by an area, and what each weighs: the counterpart of `trace`, for explanations.

use glam::DVec2;

use super::area_filter::{AreaFilter, Kind, Summed, at};
use super::box_means::BoxFilter;
use super::ewa_filter::EwaFilter;
use super::fixed_point::MASS;
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
            Kind::Summed { place, read } => read.reads(at(&place.plan(grid), point)),
            Kind::Ripmap { upper, lower } => {
                let mut reads = upper.reads(grid, point);
                if let Some((lower, mass)) = lower {
                    let part = f64::from(*mass) / f64::from(MASS);
                    let mut others = lower.reads(grid, point);
                    reads.texels.iter_mut().for_each(|texel| texel.weight *= 1.0 - part);
                    others.texels.iter_mut().for_each(|texel| texel.weight *= part);
                    reads.texels.extend(others.texels);
                    reads.taps.extend(others.taps);
                }
                reads
            }
        }
    }
}

impl EwaFilter<'_> {
    fn reads(&self, level: usize, at: DVec2) -> TextureReads {
        let mut texels = Vec::new();
        self.each(at, |[x, y], weight| {
            let inside = |at: i32, side: u32| self.wrap.texel(at, side).cast_unsigned();
            texels.push(TexelRead {
                level,
                at: [inside(x, self.level.width()), inside(y, self.level.height())],
                color: self.level.wrapped(self.wrap, [x, y]),
                weight,
            });
        });
        let reads = TextureReads {
            texels,
            taps: vec![TapRead { level, at: at + 0.5 }],
            wrap: self.wrap,
            summed: None,
        };
        reads.once()
    }
}

impl Summed<'_> {
    fn reads(&self, at: DVec2) -> TextureReads {
        let at = at + 0.5;
        let BoxFilter { table, area, wrap } = self.filter;
        let texel = |(place, weight): ([u32; 2], f64)| TexelRead {
            level: area.level,
            at: place,
            color: self.base.texel(place[0].cast_signed(), place[1].cast_signed()),
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
