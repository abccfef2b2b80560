//! How samples became a pixel, in numbers: the mean of its own, or weighted ones of its neighbours too.

use super::model::{Around, Resolve, Rounding, Taken};
use crate::color::{Premultiplied16, ResolveSpace, WeightedSum, encoded};
use crate::raster::{self, PixelReplay, WeighedPixel};
use crate::render::RenderSettings;
use crate::rules::Rules;

/// How the samples of a replayed pixel were averaged.
pub(super) fn resolve(replay: &PixelReplay, settings: &RenderSettings) -> Resolve {
    let (rules, space) = (settings.rules, settings.resolve);
    let rounding = match rules {
        Rules::Standard | Rules::Float => Rounding::Nearest,
        Rules::Course => Rounding::Truncated,
    };
    if let Some(around) = &replay.around {
        let mean = space.weighted_mean(around.sum);
        return Resolve {
            space: space.name(),
            sums: mean,
            samples: around.pixels.iter().map(|pixel| pixel.samples.len()).sum(),
            weight: 1.0,
            mean,
            rounding,
            summed_exactly: false,
            around: Some(taken(around, settings)),
        };
    }
    let samples = replay.samples.len();
    let weight = replay.samples.first().map_or(1.0, |sample| sample.weight);
    let sums = match space {
        ResolveSpace::Stored => replay
            .sums
            .map(|sum| f64::from(sum) / f64::from(Premultiplied16::PER_BYTE)),
        ResolveSpace::Linear => replay.samples.iter().fold([0.0; 4], |sums, sample| {
            let light = sample.color.light();
            [0, 1, 2, 3].map(|k| sums[k] + light[k])
        }),
    };
    Resolve {
        space: space.name(),
        sums,
        samples,
        weight,
        mean: sums.map(|sum| sum * weight),
        rounding,
        summed_exactly: replay.summed_exactly,
        around: None,
    }
}

impl Resolve {
    /// The mean in stored values, weighted by alpha.
    pub(super) fn stored_mean(&self) -> [f64; 4] {
        let [r, g, b, alpha] = self.mean;
        if self.space == ResolveSpace::Stored.name() || alpha <= 0.0 {
            return self.mean;
        }
        let part = alpha / 255.0;
        let stored = |light: f64| encoded((light / part).clamp(0.0, 255.0)) * part;
        [stored(r), stored(g), stored(b), alpha]
    }
}

/// What is taken of which pixel.
fn taken(around: &raster::Around, settings: &RenderSettings) -> Around {
    let filter = settings.resolve_filter.sized(settings.filter_radius);
    let all = around.sum.weight as f64;
    let of_pixel = |pixel: &WeighedPixel| {
        let mut own = WeightedSum::default();
        for (weight, color) in &pixel.samples {
            own.add(*weight, settings.resolve.parts(*color));
        }
        Taken {
            beside: pixel.beside,
            weight: own.weight as f64 / all,
            adds: settings.resolve.weighted_mean(WeightedSum {
                weight: around.sum.weight,
                ..own
            }),
            weights: pixel.samples.iter().map(|(weight, _)| *weight as f64 / all).collect(),
            colors: pixel.samples.iter().map(|(_, color)| levels(*color)).collect(),
        }
    };
    Around {
        filter: filter.filter().name(),
        radius: filter.radius(),
        is_own_mean: around.is_own_mean,
        pixels: around.pixels.iter().map(of_pixel).collect(),
    }
}

/// A stored colour in levels of a byte.
pub(super) fn levels(color: Premultiplied16) -> [f64; 4] {
    color
        .0
        .map(|channel| f64::from(channel) / f64::from(Premultiplied16::PER_BYTE))
}
