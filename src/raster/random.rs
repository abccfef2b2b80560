//! Random primitives on a frame of 70 x 50 pixels, for tests, and properties of what is random.

use arbtest::arbitrary::{Result, Unstructured};
use glam::DVec2;

use crate::color::Rgba;
use crate::geometry::{FillRule, Polygon};
use crate::raster::layers::Compositing;
use crate::raster::list::builder::ChunkBuilder;
use crate::raster::resolve::{FilterRadius, ResolveFilter, SizedFilter};
use crate::raster::shading::Paint;
use crate::texture::{MipLevel, MipPyramid, Texture};

/// Checks a property for so many milliseconds, and on until the cases that matter were met: slow machines take longer. Gives up
/// after twenty times as long.
pub(in crate::raster) fn check_until(
    milliseconds: u64,
    met: impl Fn() -> bool,
    mut property: impl FnMut(&mut Unstructured<'_>) -> Result<()>,
) {
    for _ in 0..20 {
        arbtest::arbtest(&mut property).budget_ms(milliseconds);
        if met() {
            return;
        }
    }
}

/// Adds some random primitives of every kind; textured ones read texture 0.
pub(in crate::raster) fn fill(builder: &mut ChunkBuilder<'_>, u: &mut Unstructured<'_>) -> Result<()> {
    fn unit(u: &mut Unstructured<'_>) -> Result<f32> {
        Ok(f32::from(u.arbitrary::<u8>()?) / 255.0)
    }
    fn color(u: &mut Unstructured<'_>) -> Result<Rgba> {
        let alpha = if u.arbitrary()? { 1.0 } else { unit(u)? };
        Ok(Rgba {
            r: unit(u)?,
            g: unit(u)?,
            b: unit(u)?,
            a: alpha,
        })
    }
    for _ in 0..u.int_in_range(1..=12)? {
        let mut point = || -> Result<DVec2> {
            let mut at = |side: i32| Ok(f64::from(u.int_in_range(-side..=3 * side)?) / 2.0);
            Ok(DVec2::new(at(70)?, at(50)?))
        };
        let points = [point()?, point()?, point()?];
        match u.int_in_range(0..=6)? {
            4 | 5 => {
                let scale = *u.choose(&[0.1, 1.0, 4.0])?;
                let mut contours = Vec::new();
                for _ in 0..u.int_in_range(1..=2)? {
                    let mut contour = Vec::new();
                    for _ in 0..u.int_in_range(3..=20)? {
                        let offset = DVec2::new(unit(u)?.into(), unit(u)?.into()) - 0.5;
                        contour.push(points[0] + offset * 60.0 * scale);
                    }
                    contours.push(contour);
                }
                let rule = *u.choose(&[FillRule::NonZero, FillRule::EvenOdd])?;
                builder.polygon(&Polygon::new(contours, rule), |point| point, &Paint::solid(color(u)?));
            }
            0 => builder.hairline([points[0], points[1]], color(u)?),
            1 => builder.triangle(points, &Paint::vertex([color(u)?, color(u)?, color(u)?])),
            2 => {
                let uv = [[0.0, 0.1], [unit(u)?, 1.0], [unit(u)?, unit(u)?]];
                builder.triangle(points, &Paint::texture(0, uv, unit(u)?));
            }
            3 => {
                builder.begin_layer();
                builder.triangle(points, &Paint::solid(color(u)?));
                builder.end_layer(Compositing::with_opacity(unit(u)?));
            }
            _ => builder.triangle(points, &Paint::solid(color(u)?)),
        }
    }
    Ok(())
}

/// Mostly the pixel's own samples; else any filter, by any radius.
pub(in crate::raster) fn any_filter(u: &mut Unstructured<'_>) -> Result<SizedFilter> {
    if u.ratio(2, 3)? {
        return Ok(SizedFilter::default());
    }
    let radius = f64::from(u.int_in_range(1..=16)?) / 4.0;
    Ok(u.choose(&ResolveFilter::ALL)?.sized(FilterRadius::new(radius)))
}

/// A texture in which every texel differs from its neighbours.
pub(in crate::raster) fn noise() -> Texture {
    let texels = (0..32 * 32_u32)
        .map(|i| {
            [
                (i * 7).to_le_bytes()[0],
                (i * 13).to_le_bytes()[0],
                (i / 4).to_le_bytes()[0],
                255,
            ]
        })
        .collect();
    Texture::new("noise", MipPyramid::build(MipLevel::new(32, 32, texels)))
}
