//! Why the value of a setting makes no difference, beside those of the other ones: what greys its control.
//!
//! A reason is true of every scene: whatever the setting is changed to, no byte of any picture moves.

use crate::post::PostProcess;
use crate::raster::SampleRate;
use crate::render::{RenderSettings, Visualisation};
use crate::texture::{Anisotropy, LevelSampling};

/// Where exact areas are covered.
const AREAS: &str = "exact areas are covered, without samples";
/// Where samples show something else than colours.
const NO_COLOURS: &str = "it is for pictures of colours";

/// Of what places samples or shades them.
pub(super) fn samples(now: &RenderSettings) -> Option<&'static str> {
    now.covers_areas().then_some(AREAS)
}

/// Of the seed.
pub(super) fn seed(now: &RenderSettings) -> Option<&'static str> {
    let is_fixed = !now.pattern.is_seeded();
    samples(now).or(is_fixed.then_some("this pattern has no chance in it"))
}

/// Of what only pictures of colours have, or what shows them besides something else.
pub(super) fn colours(now: &RenderSettings) -> Option<&'static str> {
    let has_colours = matches!(
        now.visualisation,
        Visualisation::Color | Visualisation::Clamped | Visualisation::Wireframe | Visualisation::MipLevels
    );
    (!has_colours).then_some(NO_COLOURS)
}

/// Of the values in which samples are averaged.
pub(super) fn resolve(now: &RenderSettings) -> Option<&'static str> {
    let is_single = now.in_effect().sample_rate == SampleRate::ONE && now.margin() < 1.0;
    let blends = now.covers_areas() || now.post_process != PostProcess::None;
    (is_single && !blends).then_some("one sample per pixel needs no mean")
}

/// Of what reads a texture at several points.
pub(super) fn taps(now: &RenderSettings) -> Option<&'static str> {
    (shows_colours(now) && now.level_sampling.weighs_area())
        .then_some("level sampling weighs an area of texels by itself")
}

/// Of what chooses a coarser level, or makes it.
pub(super) fn levels(now: &RenderSettings) -> Option<&'static str> {
    let reads_zero = now.level_sampling == LevelSampling::Zero && now.detail.fixed.is_none();
    (shows_colours(now) && reads_zero).then_some("only mip level zero is read")
}

/// Of whose footprint is measured.
pub(super) fn lod_per(now: &RenderSettings) -> Option<&'static str> {
    if now.in_effect().sample_rate == SampleRate::ONE {
        return Some("one sample's footprint is that of its pixel");
    }
    let is_off = now.anisotropy == Anisotropy::OFF;
    levels(now).filter(|_| is_off)
}

/// Of what of a footprint counts.
pub(super) fn lod_by(now: &RenderSettings) -> Option<&'static str> {
    let is_fixed = shows_colours(now) && now.detail.fixed.is_some();
    taps(now).or(levels(now)).or(is_fixed.then_some("the level is fixed"))
}

/// Whether nothing of a footprint is shown but what it reads.
fn shows_colours(now: &RenderSettings) -> bool {
    now.visualisation.resolves_pictures()
}
