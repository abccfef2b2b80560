//! Filtering fragments of one triangle by an area of its texture; the counterpart of [`Filter`], which reads around points.
//!
//! Texels stand where the standard rules say, whatever the rules: the course's know none of these filters.

use fearless_simd::dispatch;
use glam::DVec2;

use super::box_means::BoxFilter;
use super::ewa_filter::EwaFilter;
use super::few_texels::FewTexels;
use super::filter_plan::Plan;
use super::pyramid::NumberedLevel;
use super::ripmap_filter::{ReadSamples, RipmapFilter};
use super::sample_places::{LANES, Places, WeighSamples};
use super::texel_blocks::EndlessLevel;
use super::{Area, Filter, MipLevel, PixelList, PixelSampling, Reading};
use super::{SampleGrid, SamplingSettings, Taps, Texture, UvMap};
use crate::color::Premultiplied16;
use crate::rules::Rules;
use crate::simd::Level;

/// One texture read at the fragments of one triangle, by an area around each.
#[derive(Debug)]
pub struct AreaFilter<'a>(pub(super) Kind<'a>);

#[derive(Debug)]
pub(super) enum Kind<'a> {
    /// The filter knows where samples lie in the ellipse's level.
    Ewa {
        place: Filter<'a>,
        filter: EwaFilter<'a>,
    },
    /// The same of the level that was summed.
    Summed {
        place: Filter<'a>,
        filter: BoxFilter<'a>,
        /// The same, where every box holds few texels.
        few: Option<FewTexels<'a>>,
    },
    Ripmap(Box<RipmapFilter<'a>>),
}

impl<'a> AreaFilter<'a> {
    /// Prepares reading `texture` through `map` as the settings say; `None` where they ask for no area.
    pub fn new(texture: &'a Texture, map: &UvMap, settings: &SamplingSettings) -> Option<Self> {
        let pyramid = texture.pyramid_in(settings.pyramid, settings.pyramid_filter);
        let area = Reading::new(&map.footprint(), pyramid, settings).area?;
        let place = |level: &'a MipLevel, number| {
            // Coordinates whose whole numbers are centres.
            let settings = SamplingSettings {
                pixel: PixelSampling::Bilinear,
                ..*settings
            };
            Filter::of_levels(map, &settings, Taps::ONE, (NumberedLevel { level, number }, None))
        };
        let levels = pyramid.levels();
        Some(Self(match area {
            Area::Ellipse(ellipse) => {
                let (line, quadratic) = ellipse.quadratic();
                Kind::Ewa {
                    place: place(&levels[ellipse.level], ellipse.level),
                    filter: EwaFilter {
                        texels: EndlessLevel {
                            level: &levels[ellipse.level],
                            wrap: settings.wrap,
                        },
                        quadratic,
                        line,
                        is_opaque: pyramid.is_opaque(),
                    },
                }
            }
            Area::Box(area) => {
                // What tables are made of, whatever filter makes the pyramid that is read elsewhere.
                let summed = &texture.pyramid;
                let filter = BoxFilter {
                    table: texture.summed_area(settings.pyramid),
                    texels: EndlessLevel {
                        level: &summed.levels()[area.level],
                        wrap: settings.wrap,
                    },
                    area,
                };
                Kind::Summed {
                    place: place(&summed.levels()[area.level], area.level),
                    few: filter.few_texels(map, summed.is_opaque()),
                    filter,
                }
            }
            Area::Ripmap(choices) => {
                let ripmap = texture.ripmap(settings.pyramid, settings.pyramid_filter);
                Kind::Ripmap(Box::new(RipmapFilter::new(ripmap, map, settings, choices)))
            }
        }))
    }

    /// As [`Filter::points`].
    pub fn points(&self, simd: Level, grid: SampleGrid, points: &[[u16; 2]], out: &mut [Premultiplied16]) {
        match &self.0 {
            Kind::Ripmap(filter) => filter.points(simd, grid, points, out),
            Kind::Ewa { place, filter } => weighed(filter, simd, &place.plan(grid), (grid.side, points), out),
            Kind::Summed {
                place,
                few: Some(filter),
                ..
            } => weighed(filter, simd, &place.plan(grid), (grid.side, points), out),
            Kind::Summed { place, filter, .. } => {
                let plan = place.plan(grid);
                for (points, out) in points.chunks(LANES).zip(out.chunks_mut(LANES)) {
                    let colors = filter.colors(simd, &Places::of_points(&plan, points));
                    out.copy_from_slice(&colors[..out.len()]);
                }
            }
        }
    }

    /// As [`Filter::pixels`].
    pub fn pixels(&self, simd: Level, grid: SampleGrid, points: &[[u16; 2]], out: &mut [u32]) {
        let mut colors = vec![Premultiplied16::TRANSPARENT; points.len()];
        self.points(simd, grid, points, &mut colors);
        for (color, out) in colors.iter().zip(out) {
            *out = color.to_pixel(Rules::Standard);
        }
    }

    /// As [`Filter::sums`].
    pub fn sums(&self, simd: Level, grid: SampleGrid, list: PixelList<'_>, sums: &mut [[u32; 4]]) {
        match &self.0 {
            Kind::Ewa { place, filter } => {
                dispatch!(simd, simd => filter.sums(simd, (&place.plan(grid), grid.side), list, sums));
            }
            Kind::Summed { place, filter, .. } if filter.is_bilinear() => place.sums(simd, grid, list, sums),
            Kind::Summed {
                place,
                few: Some(filter),
                ..
            } => dispatch!(simd, simd => filter.sums(simd, (&place.plan(grid), grid.side), list, sums)),
            Kind::Summed { place, filter, .. } => {
                filter.sums(simd, (&place.plan(grid), grid.side), list, sums);
            }
            Kind::Ripmap(filter) => filter.sums(simd, grid, list, sums),
        }
    }
}

/// The colours at points of a grid with so many to the side of a pixel; those of a pixel are found together.
fn weighed(
    filter: &impl WeighSamples,
    simd: Level,
    plan: &Plan<'_>,
    (side, points): (u32, &[[u16; 2]]),
    out: &mut [Premultiplied16],
) {
    let side = u16::try_from(side).unwrap_or(1).max(1);
    let pixel = |point: &[u16; 2]| point.map(|at| at / side);
    let mut rest = out;
    for samples in points.chunk_by(|a, b| pixel(a) == pixel(b)) {
        let (colors, others) = rest.split_at_mut(samples.len());
        rest = others;
        for (points, colors) in samples.chunks(LANES).zip(colors.chunks_mut(LANES)) {
            let places = Places::of_points(plan, points);
            dispatch!(simd, simd => filter.colors(simd, &places, colors));
        }
    }
}

/// Where a sample lies in the first level of a plan, in texels; whole coordinates are centres.
#[inline]
pub(super) fn at(plan: &Plan<'_>, point: [u16; 2]) -> DVec2 {
    let from_pivot = plan.first + DVec2::new(f64::from(point[0]), f64::from(point[1]));
    let [x, y] = [&plan.finer.x, &plan.finer.y]
        .map(|axis| (axis.at_pivot + from_pivot.x * axis.right) + from_pivot.y * axis.down);
    DVec2::new(x, y)
}
