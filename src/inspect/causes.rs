//! What the distance of a pixel from the truth comes of: for each cause how far the truth's samples that show it account for it.

use std::collections::{BTreeMap, HashMap};

use super::advice::{distance, premultiplied};
use super::explanation::Question;
use super::model::{Causes, Explanation, Missed, MissedCause, Paint, Truth};
use super::resolve::levels;
use super::seen::seen_fragments;
use crate::color::Premultiplied16;
use crate::raster::{PaintedKind, PixelReplay, ShadingRate};
use crate::render::{self, Nearby, RenderSettings, Subject};
use crate::texture::Derivatives;

/// Levels by which colours differ so much that it can be seen.
const SEEN: u16 = 4;

/// The samples of the truth, and how they are averaged.
struct TrueSamples<'a> {
    nearby: &'a Nearby<'a>,
    settings: RenderSettings,
    replay: PixelReplay,
    shown: Vec<Premultiplied16>,
}

/// The samples of the truth, of which some show something.
struct Shown {
    /// These, as they are, and as they would be without it.
    with: Vec<Premultiplied16>,
    without: Vec<Premultiplied16>,
    others: Vec<Premultiplied16>,
}

impl<'a> TrueSamples<'a> {
    /// Those of the truth about what is drawn with these settings; `None` outside the picture.
    fn new(nearby: &'a Nearby<'a>, own: &RenderSettings) -> Option<Self> {
        let settings = own.truth();
        let replay = nearby.replay(&settings)?;
        Some(Self {
            nearby,
            settings,
            shown: replay.samples.iter().map(|sample| sample.color).collect(),
            replay,
        })
    }

    /// The colours that each primitive has where it is seen.
    fn shades(&self) -> BTreeMap<u32, Vec<[f64; 4]>> {
        let mut shades: BTreeMap<u32, Vec<[f64; 4]>> = BTreeMap::new();
        for (op, seen) in self.replay.painted.iter().zip(seen_fragments(&self.replay)) {
            if op.kind == PaintedKind::Primitive {
                let seen = op.fragments.iter().zip(seen).filter(|(_, seen)| *seen);
                let colors = seen.map(|(fragment, _)| levels(fragment.color));
                shades.entry(op.source).or_default().extend(colors);
            }
        }
        shades
    }

    /// Which of them show any of some primitives: differ to see without these. `None` where there are no primitives.
    fn showing(&self, primitives: &[u32]) -> Option<Shown> {
        if primitives.is_empty() {
            return None;
        }
        let without = self.nearby.without(primitives).samples(&self.settings)?;
        let mut found = Shown {
            with: Vec::new(),
            without: Vec::new(),
            others: Vec::new(),
        };
        for (with, without) in self.shown.iter().zip(without) {
            if are_apart(*with, without) {
                found.with.push(*with);
                found.without.push(without);
            } else {
                found.others.push(*with);
            }
        }
        Some(found)
    }

    /// The pixel that samples make, straight red, green, blue, alpha; `None` without any.
    fn pixel(&self, samples: &[Premultiplied16]) -> Option<[u8; 4]> {
        let pixel = || self.settings.resolve.resolve(samples, self.settings.rules);
        let [a, r, g, b] = (!samples.is_empty()).then(pixel)?.to_be_bytes();
        Some([r, g, b, a])
    }

    fn part(&self, samples: &[Premultiplied16]) -> f64 {
        samples.len() as f64 / self.shown.len().max(1) as f64
    }
}

impl Explanation {
    /// What accounts for how far the pixel is from the truth; `own` are its settings.
    pub(super) fn causes(&self, nearby: &Nearby<'_>, own: &RenderSettings, truth: &Truth) -> Causes {
        let Some(samples) = TrueSamples::new(nearby, own) else {
            return Causes::default();
        };
        let missed = |is_one: &dyn Fn(&Missed) -> bool| {
            let ones = self.missed.iter().filter(|missed| is_one(missed));
            self.missed_cause(&ones.collect::<Vec<_>>(), &samples, truth)
        };
        let once = RenderSettings {
            shading: ShadingRate::Centre,
            ..samples.settings
        };
        let sampled = RenderSettings {
            sample_rate: own.sample_rate,
            pattern: own.pattern,
            coverage: own.coverage,
            rules: own.rules,
            ..once
        };
        let (once, sampled) = (color(nearby, &once), color(nearby, &sampled));
        Causes {
            coverage: sampled.zip(once).map_or(0.0, |pair| self.nearer_by(pair, truth)),
            thin: missed(&|missed| self.is_thin(missed)).unwrap_or_default(),
            missed: missed(&|_| true).unwrap_or_default(),
            topmost: self.topmost_cause(&samples, truth).unwrap_or(0.0),
            textures: once.map_or(0.0, |once| distance(once, truth.color)),
            averaging: color(nearby, &read_as(own)).map_or(0.0, |often| distance(often, truth.color)),
            off_color: self.off_color(&samples, |_| true),
            off_texture: self.off_color(&samples, |paint| paint.texture.is_some()),
        }
    }

    /// By how many levels the pixel would be nearer to the truth if what changes one colour to another were changed in it.
    fn nearer_by(&self, (from, to): ([u8; 4], [u8; 4]), truth: &Truth) -> f64 {
        let [own, from, to, right] = [self.color, from, to, truth.color].map(premultiplied);
        let left = |channel: usize| (own[channel] + to[channel] - from[channel] - right[channel]).abs();
        truth.distance - [0, 1, 2, 3].map(left).into_iter().fold(0.0, f64::max)
    }

    /// The paint, of those that are one of these, whose colour is farthest from its true one, counted by the part of the pixel that
    /// shows it.
    fn off_color(&self, samples: &TrueSamples<'_>, is_one: fn(&Paint) -> bool) -> Option<usize> {
        /// Less is rounding.
        const LEAST: f64 = 1.0;
        let number = |primitive: u32| {
            let is_it = |paint: &Paint| paint.primitive == primitive && paint.is_seen() && is_one(paint);
            self.paints.iter().rposition(is_it)
        };
        let seen = |primitive: u32| {
            let paints = self
                .paints
                .iter()
                .filter(move |paint| paint.primitive == primitive && is_one(paint));
            let seen = paints
                .flat_map(|paint| &paint.fragments)
                .filter(|fragment| fragment.seen);
            seen.map(|fragment| fragment.color).collect::<Vec<_>>()
        };
        let off = |primitive: u32, shades: &[[f64; 4]]| {
            let (own, shown) = (mean(&seen(primitive))?, mean(shades)?);
            let apart = own.iter().zip(shown).map(|(own, shown)| (own - shown).abs());
            let part = shades.len() as f64 / samples.shown.len().max(1) as f64;
            Some(apart.fold(0.0, f64::max) * part)
        };
        let shades = samples.shades();
        let all = shades
            .iter()
            .filter_map(|(primitive, shades)| Some((*primitive, off(*primitive, shades)?)));
        let (primitive, most) = all.max_by(|(_, one), (_, other)| one.total_cmp(other))?;
        number(primitive).filter(|_| most >= LEAST)
    }

    /// What some primitives that no sample meets account for: the rest of the truth, if it is what the pixel shows. `None` where
    /// nothing shows them.
    fn missed_cause(&self, missed: &[&Missed], samples: &TrueSamples<'_>, truth: &Truth) -> Option<MissedCause> {
        /// So much of a part may come of where the samples lie.
        const COUNTED: f64 = 1.0 / 64.0;
        let counted = COUNTED + truth.unsure / 255.0;
        let primitives: Vec<u32> = missed.iter().map(|missed| missed.primitive).collect();
        let found = samples.showing(&primitives)?;
        let part = samples.part(&found.with);
        let rest = samples.pixel(&found.others)?;
        let area: f64 = missed.iter().map(|missed| missed.area).sum();
        (part > 0.0).then(|| MissedCause {
            levels: truth.distance - distance(self.color, rest),
            part,
            small: missed.iter().all(|missed| self.is_less_than_apart(missed.length)),
            area: ((area - part).abs() < counted).then_some(area),
        })
    }

    /// What the topmost primitive accounts for: that more, or fewer, of the pixel's samples show it than of the truth's.
    fn topmost_cause(&self, samples: &TrueSamples<'_>, truth: &Truth) -> Option<f64> {
        let primitive = self.topmost()?.primitive;
        let is_it = |paint: usize| self.paints[paint].primitive == primitive;
        let own = self.samples.iter().filter(|sample| sample.seen.is_some_and(is_it));
        let own = own.count() as f64 / self.samples.len().max(1) as f64;
        let found = samples.showing(&[primitive])?;
        let Some(shows) = samples.pixel(&found.with) else {
            return Some(truth.distance);
        };
        let wrong = (own - samples.part(&found.with)).abs();
        // Where most of what shows beside it looks like it, that is not what is wrong.
        let differs = |other: &&Premultiplied16| {
            let other = samples.pixel(std::slice::from_ref(*other));
            other.is_some_and(|other| distance(shows, other) > f64::from(SEEN))
        };
        let differing = found.others.iter().filter(differs).count() as f64 / samples.shown.len().max(1) as f64;
        if !found.others.is_empty() && differing < wrong / 2.0 {
            return Some(0.0);
        }
        // What shows beside it, and what would in its place.
        let others = [samples.pixel(&found.others), samples.pixel(&found.without)];
        let contrast = others.into_iter().flatten().map(|other| distance(shows, other));
        Some(wrong * contrast.fold(f64::INFINITY, f64::min))
    }

    /// Finds which part of the pixel shows each primitive that no sample meets: the part of the truth's samples.
    pub(super) fn find_shown(&mut self, question: &Question<'_>, nearby: &Nearby<'_>) {
        if self.missed.is_empty() {
            return;
        }
        let subject = Subject {
            settings: &question.subject.settings.truth(),
            ..question.subject
        };
        let Some(replay) = render::replay(&subject, question.size, question.pixel) else {
            return;
        };
        let mut shown: HashMap<u32, usize> = HashMap::new();
        for (op, seen) in replay.painted.iter().zip(seen_fragments(&replay)) {
            if !seen.is_empty() {
                *shown.entry(op.source).or_default() += seen.into_iter().filter(|seen| *seen).count();
            }
        }
        let samples = TrueSamples::new(nearby, question.subject.settings);
        for missed in &mut self.missed {
            if missed.in_mask {
                // Where nothing is masked, a mask is not painted.
                if nearby.meets(missed.primitive, question.subject.settings) {
                    continue;
                }
                let found = samples
                    .as_ref()
                    .and_then(|samples| samples.showing(&[missed.primitive]));
                missed.shown = samples
                    .as_ref()
                    .zip(found)
                    .map(|(samples, found)| samples.part(&found.with));
                continue;
            }
            // Nothing is known of what the truth's samples do not meet either.
            let count = shown.get(&missed.primitive);
            missed.shown = count.map(|count| (*count as f64 / replay.samples.len().max(1) as f64).min(1.0));
        }
    }
}

/// The truth, but for textures, of which each sample reads what the picture's samples do.
fn read_as(own: &RenderSettings) -> RenderSettings {
    let (rate, mut detail) = (own.in_effect().sample_rate, own.detail);
    if detail.derivatives == Derivatives::Sample {
        let finer = f64::from(own.pattern.nearest(rate).samples()).log2() / 2.0;
        detail.derivatives = Derivatives::Pixel;
        detail.bias = detail.bias.stepped(-finer);
    }
    RenderSettings {
        level_sampling: own.level_sampling,
        pyramid: own.pyramid,
        pyramid_filter: own.pyramid_filter,
        anisotropy: own.anisotropy,
        detail,
        ..own.truth()
    }
}

/// `None` of nothing.
fn mean(colors: &[[f64; 4]]) -> Option<[f64; 4]> {
    let sum = |channel: usize| colors.iter().map(|color| color[channel]).sum::<f64>();
    (!colors.is_empty()).then(|| [0, 1, 2, 3].map(|channel| sum(channel) / colors.len() as f64))
}

/// The pixel, straight red, green, blue, alpha.
fn color(nearby: &Nearby<'_>, settings: &RenderSettings) -> Option<[u8; 4]> {
    let [a, r, g, b] = nearby.pixel(settings)?.to_be_bytes();
    Some([r, g, b, a])
}

/// Whether two samples are so far apart that it can be seen.
fn are_apart(a: Premultiplied16, b: Premultiplied16) -> bool {
    let channels = a.0.iter().zip(b.0);
    { channels }.any(|(a, b)| a.abs_diff(b) > SEEN * Premultiplied16::PER_BYTE)
}
