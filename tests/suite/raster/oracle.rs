//! The engine against the brute-force renderer, on random scenes full of ties.

use rasterscope::color::ResolveSpace;
use rasterscope::raster::{FilterRadius, Framebuffer, PixelCoverage, ResolveFilter, SamplePattern, Seed, ShadingRate};
use rasterscope::render::RenderSettings;
use rasterscope::rules::Rules;
use rasterscope::texture::{
    Anisotropy, Derivatives, FixedLevel, FootprintExtent, LevelSampling, LodBias, PixelSampling, PyramidFilter, Wrap,
};

use crate::support::brute_force;
use crate::support::scenes::{Fills, at_rate, drawn, one_to_one, random};

const SIDE: i32 = 20;
const SIZE: [u32; 2] = [20, 20];

/// The largest difference of any channel, and how many pixels differ by more than `level`.
///
/// Colours are straight: they are quotients by the opacity. Where that is a byte or two, as where a filter's negative lobes
/// cancel what others add, the quotient magnifies the rounding of each blend, and where it is zero no colour is seen.
fn difference(a: &Framebuffer, b: &Framebuffer, level: u8) -> (u8, usize) {
    let of_pixel = |a: &u32, b: &u32| {
        let ([opacity, colors_a @ ..], [other, colors_b @ ..]) = (a.to_be_bytes(), b.to_be_bytes());
        let colors = colors_a.iter().zip(&colors_b).map(|(a, b)| a.abs_diff(*b)).max();
        let magnified = match opacity.min(other) {
            0 => u8::MAX,
            opacity @ 1..4 => 4 / opacity,
            _ => 0,
        };
        (opacity.abs_diff(other)).max(colors.unwrap_or(0).saturating_sub(magnified))
    };
    let all: Vec<u8> = a.pixels().iter().zip(b.pixels()).map(|(a, b)| of_pixel(a, b)).collect();
    (
        all.iter().copied().max().unwrap_or(0),
        all.iter().filter(|found| **found > level).count(),
    )
}

fn samples(u: &mut arbtest::arbitrary::Unstructured<'_>) -> arbtest::arbitrary::Result<RenderSettings> {
    // As often on the grid as off it.
    let scattered = *u.choose(&SamplePattern::ALL)?;
    let pattern = *u.choose(&[SamplePattern::Grid, scattered])?;
    let rates = [1, 4, 9, 16, 25, 2, 3, 5, 7, 17];
    let rates = if pattern.needs_square() { &rates[..5] } else { &rates };
    // Where the samples of pixels beyond the frame lie is unknown where each pixel has its own.
    let is_wide = !pattern.differs_by_pixel() && u.ratio(1, 3)?;
    let filters = if is_wide {
        &ResolveFilter::ALL[..]
    } else {
        &ResolveFilter::ALL[..1]
    };
    let radius = f64::from(u.int_in_range(2..=12)?) / 4.0;
    Ok(RenderSettings {
        pattern,
        seed: Seed::new(u.int_in_range(0..=3)?).expect("a seed"),
        resolve_filter: *u.choose(filters)?,
        filter_radius: FilterRadius::new(radius).filter(|_| is_wide && radius > 1.0),
        resolve: *u.choose(&[ResolveSpace::Stored, ResolveSpace::Stored, ResolveSpace::Linear])?,
        shading: *u.choose(&ShadingRate::ALL)?,
        ..at_rate(*u.choose(rates)?)
    })
}

/// Draws random scenes in both renderers for a while; `judge` looks at each pair.
fn compare(fills: Fills, budget_ms: u64, judge: impl FnMut(&Framebuffer, &Framebuffer, &(RenderSettings, String))) {
    compare_by(Rules::Standard, (fills, budget_ms), judge);
}

fn compare_by(
    rules: Rules,
    (fills, budget_ms): (Fills, u64),
    mut judge: impl FnMut(&Framebuffer, &Framebuffer, &(RenderSettings, String)),
) {
    arbtest::arbtest(|u| {
        let (scene, mut settings) = (random(u, SIDE, fills)?, samples(u)?);
        settings.rules = rules;
        if rules == Rules::Standard {
            settings.coverage = *u.choose(&[PixelCoverage::Sampled, PixelCoverage::Sampled, PixelCoverage::Exact])?;
        }
        settings.pixel_sampling = *u.choose(&PixelSampling::ALL)?;
        settings.texture_wrap = *u.choose(&Wrap::ALL)?;
        settings.level_sampling = *u.choose(&LevelSampling::ALL)?;
        settings.anisotropy = *u.choose(&Anisotropy::STEPS)?;
        // Sums of light are rounded to bytes at every sample.
        let spaces = usize::from(settings.level_sampling != LevelSampling::SummedArea) + 1;
        settings.detail.derivatives = *u.choose(&Derivatives::ALL)?;
        settings.detail.extent = *u.choose(&FootprintExtent::ALL)?;
        settings.pyramid = *u.choose(&ResolveSpace::ALL[..spaces])?;
        settings.pyramid_filter = *u.choose(&PyramidFilter::ALL)?;
        // Beside quarters: footprints of powers of two would lie on halves, where rounding decides about levels.
        let level = f64::from(u.int_in_range(-8..=8)?) / 4.0 + 0.1;
        match u.int_in_range(0..=3)? {
            0 => settings.detail.bias = LodBias::new(level).expect("a bias"),
            1 => settings.detail.fixed = FixedLevel::new(level),
            _ => {}
        }
        let view = one_to_one(SIZE);
        let (fast, slow) = (
            drawn(&scene, &view, &settings, SIZE),
            brute_force::draw(&scene, &view, &settings, SIZE),
        );
        judge(
            &fast,
            &slow,
            &(settings, format!("{settings:?}: {:#?}", scene.primitives)),
        );
        Ok(())
    })
    .budget_ms(budget_ms);
}

#[test]
fn oracle_agrees_on_flat_opaque_scenes_to_the_byte() {
    compare(Fills::Flat, 1500, |fast, slow, (settings, what)| {
        // The curve of light is a line in the dark: there means of bytes lie on halves, where the last bit decides.
        // Areas are rounded, too.
        let tie = u8::from(settings.resolve == ResolveSpace::Linear || settings.coverage == PixelCoverage::Exact);
        assert_eq!(difference(fast, slow, tie).1, 0, "{what}");
    });
}

#[test]
fn oracle_agrees_on_translucent_layers_within_one_level() {
    // Every blend of the engine rounds to 1/65280; several of them may carry a byte over a rounding boundary.
    compare(Fills::Translucent, 1500, |fast, slow, (_, what)| {
        assert_eq!(difference(fast, slow, 1).1, 0, "{what}");
    });
}

#[test]
fn oracle_agrees_on_colours_and_textures_within_one_level() {
    // 32-bit interpolation may land on the other side of a texel's border: a sample in thousands, never a pattern.
    let (mut pixels, mut different) = (0, 0);
    compare(Fills::Everything, 2500, |fast, slow, (settings, what)| {
        let (largest, count) = difference(fast, slow, 1);
        // Every tap may land there; it weighs less for that.
        let most = 8 * settings.anisotropy.taps().min(4);
        assert!(count < most as usize, "{count} pixels, largest {largest}, {what}");
        pixels += fast.pixels().len();
        different += count;
    });
    assert!(
        different * 2000 <= pixels,
        "{different} of {pixels} pixels differ by more than one level"
    );
}

#[test]
fn oracle_agrees_on_edges_in_32_bit_floats_to_the_byte() {
    compare_by(Rules::Float, (Fills::Flat, 1500), |fast, slow, (settings, what)| {
        let tie = u8::from(settings.resolve == ResolveSpace::Linear);
        assert_eq!(difference(fast, slow, tie).1, 0, "{what}");
    });
    compare_by(Rules::Float, (Fills::Translucent, 1000), |fast, slow, (_, what)| {
        assert_eq!(difference(fast, slow, 1).1, 0, "{what}");
    });
}
