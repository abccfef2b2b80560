//! Filtering fragments of one triangle by an area of its texture; the counterpart of [`Filter`], which reads around points.
//!
//! Texels stand where the standard rules say, whatever the rules: the course's know none of these filters.

use glam::DVec2;

use super::box_means::BoxFilter;
use super::ewa_filter::EwaFilter;
use super::filter_plan::Plan;
use super::fixed_point::MASS;
use super::pyramid::NumberedLevel;
use super::sample_places::{LANES, Places};
use super::{Area, Filter, LevelChoice, MipLevel, PixelList, PixelSampling, Reading, Ripmap};
use super::{SampleGrid, SamplingSettings, Taps, Texture, UvMap, bilinear};
use crate::color::Premultiplied16;
use crate::rules::Rules;
use crate::simd::Level;

/// One texture read at the fragments of one triangle, by an area around each.
#[derive(Debug)]
pub struct AreaFilter<'a>(pub(super) Kind<'a>);

#[derive(Debug)]
pub(super) enum Kind<'a> {
    /// The filter knows where samples lie in the ellipse's level.
    Ewa { place: Filter<'a>, filter: EwaFilter<'a> },
    /// The same of the level that was summed.
    Summed { place: Filter<'a>, read: Summed<'a> },
    /// Levels of one height, and of the next one with its part of [`MASS`].
    Ripmap {
        upper: Filter<'a>,
        lower: Option<(Filter<'a>, i32)>,
    },
}

/// A box of a table.
#[derive(Debug)]
pub(super) struct Summed<'a> {
    /// The level that was summed.
    pub(super) base: &'a MipLevel,
    pub(super) filter: BoxFilter<'a>,
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
            Area::Ellipse(ellipse) => Kind::Ewa {
                place: place(&levels[ellipse.level], ellipse.level),
                filter: EwaFilter {
                    level: &levels[ellipse.level],
                    wrap: settings.wrap,
                    quadratic: ellipse.quadratic(),
                    is_opaque: pyramid.is_opaque(),
                },
            },
            Area::Box(area) => Kind::Summed {
                place: place(&levels[area.level], area.level),
                read: Summed {
                    base: &levels[area.level],
                    filter: BoxFilter {
                        table: texture.summed_area(settings.pyramid),
                        area,
                        wrap: settings.wrap,
                    },
                },
            },
            Area::Ripmap(choices) => {
                let ripmap = texture.ripmap(settings.pyramid, settings.pyramid_filter);
                ripmap_kind(ripmap, map, settings, choices)
            }
        }))
    }

    /// As [`Filter::points`].
    pub fn points(&self, simd: Level, grid: SampleGrid, points: &[[u16; 2]], out: &mut [Premultiplied16]) {
        match &self.0 {
            Kind::Ripmap { upper, lower } => {
                upper.points(simd, grid, points, out);
                if let Some((lower, mass)) = lower {
                    let mut others = vec![Premultiplied16::TRANSPARENT; points.len()];
                    lower.points(simd, grid, points, &mut others);
                    for (color, other) in out.iter_mut().zip(others) {
                        *color = mixed(*color, other, *mass);
                    }
                }
            }
            Kind::Ewa { place, filter } => {
                let plan = place.plan(grid);
                let side = u16::try_from(grid.side).unwrap_or(1).max(1);
                let pixel = |point: &[u16; 2]| point.map(|at| at / side);
                let mut rest = out;
                for samples in points.chunk_by(|a, b| pixel(a) == pixel(b)) {
                    let (colors, others) = rest.split_at_mut(samples.len());
                    rest = others;
                    for (points, colors) in samples.chunks(LANES).zip(colors.chunks_mut(LANES)) {
                        let places = Places::of_points(&plan, points);
                        filter.colors(simd, &places, colors);
                    }
                }
            }
            Kind::Summed { place, read } => {
                let plan = place.plan(grid);
                for (points, out) in points.chunks(LANES).zip(out.chunks_mut(LANES)) {
                    let colors = read.filter.colors(simd, &Places::of_points(&plan, points));
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
            Kind::Ewa { place, filter } => filter.sums(simd, (&place.plan(grid), grid.side), list, sums),
            Kind::Summed { place, read } if read.filter.is_bilinear() => place.sums(simd, grid, list, sums),
            Kind::Summed { place, read } => read.filter.sums(simd, (&place.plan(grid), grid.side), list, sums),
            Kind::Ripmap { upper, lower } => {
                upper.sums(simd, grid, list, sums);
                if let Some((lower, mass)) = lower {
                    let mut others = vec![[0; 4]; sums.len()];
                    lower.sums(simd, grid, list, &mut others);
                    for (sum, other) in sums.iter_mut().zip(others) {
                        *sum = std::array::from_fn(|i| mixed_sum(sum[i], other[i], *mass));
                    }
                }
            }
        }
    }
}

fn ripmap_kind<'a>(
    ripmap: &'a Ripmap,
    map: &UvMap,
    settings: &SamplingSettings,
    [along_u, along_v]: [LevelChoice; 2],
) -> Kind<'a> {
    let mass = bilinear::mass(along_u.next_weight);
    let of_height = |height: usize| {
        let (wide, narrow) = ripmap.mixed(along_u, height);
        let read = match (mass, narrow) {
            (MASS, Some(narrow)) => (narrow, None),
            (0, _) | (_, None) => (wide, None),
            (_, Some(narrow)) => (wide, Some((narrow, mass))),
        };
        Filter::of_levels(map, settings, Taps::ONE, read)
    };
    let next = bilinear::mass(along_v.next_weight);
    Kind::Ripmap {
        upper: of_height(along_v.level),
        lower: (next > 0).then(|| (of_height(along_v.level + 1), next)),
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

/// Two colours mixed, `mass` of [`MASS`] of the second.
#[inline]
pub(super) fn mixed(first: Premultiplied16, second: Premultiplied16, mass: i32) -> Premultiplied16 {
    let channel = |i: usize| {
        let sum = mixed_sum(u32::from(first.0[i]), u32::from(second.0[i]), mass);
        u16::try_from(sum).unwrap_or(Premultiplied16::ONE)
    };
    Premultiplied16(std::array::from_fn(channel))
}

/// The same of sums of colours.
#[inline]
fn mixed_sum(first: u32, second: u32, mass: i32) -> u32 {
    let [mass, whole] = [mass, MASS].map(|mass| u64::from(mass.cast_unsigned()));
    let sum = u64::from(first) * (whole - mass) + u64::from(second) * mass + whole / 2;
    u32::try_from(sum / whole).unwrap_or(u32::MAX)
}
