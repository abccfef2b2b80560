//! Whether bytes were truncated where ours are rounded. That moves single bytes by one level, and which it moves is known:
//! those whose exact value lies in the upper half between two bytes. Some pixels are drawn again to know it.

use rayon::prelude::*;

use super::cause::{self, Cause};
use super::trial::{Trial, squared};
use crate::color::{Premultiplied16, ResolveSpace, WeightedSum};
use crate::raster::{Framebuffer, PixelReplay, Region};
use crate::render::Neighbourhood;
use crate::rules::Rules;

/// Most pixels that are drawn again of those that differ, and of those that do not.
const MOST: usize = 4096;
/// Fewest of them, and how often any of them may be compared with a primitive, so that large scenes do not take for ever.
const FEWEST: usize = 64;
const COMPARISONS: usize = 20_000_000;

/// The squared differences before and after bytes are truncated, for the picture under `causes`. They are estimates where
/// there are more pixels than can be drawn again. `None` when cancelled.
pub(super) fn truncated_errors(trial: &Trial<'_>, causes: &[Cause]) -> Option<[f64; 2]> {
    let drawn = trial.draw(causes)?;
    let size = [drawn.width(), drawn.height()];
    let finished = |frame: &Framebuffer| {
        let mut frame = frame.clone();
        for cause in causes {
            cause::apply(*cause, &mut frame);
        }
        frame
    };
    let before = finished(&drawn);
    let upside_down = causes.contains(&Cause::UpsideDown);
    // Where a pixel of the finished frame is in the drawn one.
    let drawn_at = |index: usize| {
        let width = size[0] as usize;
        let (x, y) = (index % width, index / width);
        let y = if upside_down { size[1] as usize - 1 - y } else { y };
        y * width + x
    };
    let variant = trial.variant(causes);
    let subject = variant.subject();
    let again = Neighbourhood::new(subject, size, Region::of_size(size));
    let most = (COMPARISONS / again.ops().max(1)).clamp(FEWEST, MOST);
    let pairs = || before.pixels().iter().zip(trial.other.pixels());
    let (differing, equal): (Vec<usize>, Vec<usize>) =
        (0..pairs().len()).partition(|index| before.pixels()[*index] != trial.other.pixels()[*index]);
    let truncated = |index: usize| {
        let at = drawn_at(index);
        let [x, y] = [at % size[0] as usize, at / size[0] as usize].map(|side| u32::try_from(side).unwrap_or(0));
        again
            .replay([x, y])
            .map(|pixel| (at, truncations(&pixel, subject.settings.resolve)))
    };
    // Truncated when all samples are averaged, or each sample, too.
    let mut after = [0.0; 2];
    for indices in [&differing, &equal] {
        let step = indices.len().div_ceil(most).max(1);
        let picked: Vec<usize> = indices.iter().copied().step_by(step).collect();
        let weight = indices.len() as f64 / picked.len().max(1) as f64;
        if trial.cancel.is_cancelled() {
            return None;
        }
        let found: Vec<(usize, [u32; 2])> = picked.par_iter().filter_map(|index| truncated(*index)).collect();
        for (way, sum) in after.iter_mut().enumerate() {
            let mut frame = drawn.clone();
            for (at, pixels) in &found {
                frame.pixels_mut()[*at] = pixels[way];
            }
            let frame = finished(&frame);
            let error = |index: &usize| squared(frame.pixels()[*index], trial.other.pixels()[*index]);
            *sum += weight * picked.iter().map(error).sum::<u64>() as f64;
        }
    }
    let before: u64 = pairs().map(|(a, b)| squared(*a, *b)).sum();
    Some([before as f64, after[0].min(after[1])])
}

/// What a pixel becomes when only the mean is truncated, and when its samples are, too.
fn truncations(pixel: &PixelReplay, space: ResolveSpace) -> [u32; 2] {
    if let Some(around) = &pixel.around {
        let mut whole = WeightedSum::default();
        for (weight, color) in around.pixels.iter().flat_map(|pixel| &pixel.samples) {
            whole.add(*weight, space.parts(truncated(*color)));
        }
        return [around.sum, whole].map(|sum| space.weighted_pixel(sum, Rules::Course));
    }
    let exact: Vec<Premultiplied16> = pixel.samples.iter().map(|sample| sample.color).collect();
    let whole: Vec<Premultiplied16> = exact.iter().copied().map(truncated).collect();
    let mean = match space {
        ResolveSpace::Stored => Premultiplied16::resolve(
            pixel.sums,
            u32::try_from(exact.len()).unwrap_or(u32::MAX),
            Rules::Course,
        ),
        ResolveSpace::Linear => space.resolve(&exact, Rules::Course),
    };
    [mean, space.resolve(&whole, Rules::Course)]
}

/// A sample whose channels are cut to bytes.
fn truncated(color: Premultiplied16) -> Premultiplied16 {
    let whole = |channel| channel / Premultiplied16::PER_BYTE * Premultiplied16::PER_BYTE;
    Premultiplied16(color.0.map(whole))
}
