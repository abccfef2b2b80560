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

/// Of what only pictures of colours have.
pub(super) fn colours(now: &RenderSettings) -> Option<&'static str> {
    (now.visualisation != Visualisation::Color).then_some(NO_COLOURS)
}

/// Of the values in which samples are averaged.
pub(super) fn resolve(now: &RenderSettings) -> Option<&'static str> {
    let is_single = now.in_effect().sample_rate == SampleRate::ONE && now.margin() < 1.0;
    let blends = now.covers_areas() || now.post_process != PostProcess::None;
    (is_single && !blends).then_some("one sample per pixel needs no mean")
}

/// Of what reads texels around a point, or at several.
pub(super) fn point(now: &RenderSettings) -> Option<&'static str> {
    now.level_sampling
        .weighs_area()
        .then_some("level sampling weighs an area of texels by itself")
}

/// Of the bias.
pub(super) fn bias(now: &RenderSettings) -> Option<&'static str> {
    reads_level_zero(now).then_some(LEVEL_ZERO)
}

/// Of what levels are made by.
pub(super) fn pyramid(now: &RenderSettings) -> Option<&'static str> {
    bias(now)
}

/// Of whose footprint is measured.
pub(super) fn lod_per(now: &RenderSettings) -> Option<&'static str> {
    if now.in_effect().sample_rate == SampleRate::ONE {
        return Some("one sample's footprint is that of its pixel");
    }
    let is_off = now.anisotropy == Anisotropy::OFF;
    bias(now).filter(|_| is_off)
}

/// Of what of a footprint counts.
pub(super) fn lod_by(now: &RenderSettings) -> Option<&'static str> {
    let is_fixed = now.detail.fixed.is_some();
    point(now).or(bias(now)).or(is_fixed.then_some("the level is fixed"))
}

/// Where no coarser level is read.
const LEVEL_ZERO: &str = "only mip level zero is read";

fn reads_level_zero(now: &RenderSettings) -> bool {
    now.level_sampling == LevelSampling::Zero && now.detail.fixed.is_none()
}
