//! Pixels that have areas and no samples: what shows in them, and where neighbours let the background through.

use super::model::{Conflation, Explanation, Fragment, Interpolated, Paint, Truth, View};
use super::numbers::{counted, percent};
use crate::render::Explainer;

/// Parts of a pixel that are too small to be told from none.
const NOTHING: f64 = 0.002;
/// Neighbours in one pixel that are compared with each other at most.
const MOST_NEIGHBOURS: usize = 8;

/// What shows in a pixel of one colour, each `0.0..=1.0` of it.
pub(super) struct AreaShares {
    /// The paints that show, by number, from the topmost down.
    paints: Vec<(usize, f64)>,
    /// How many paints show less than is told each, and what they show together.
    small: (usize, f64),
    /// What is below all of them.
    pub(super) background: f64,
}

/// The primitives that cover a pixel together, each a part of it that no other covers.
pub(super) fn conflation(paints: &[Paint], explainer: &Explainer<'_>) -> Option<Conflation> {
    let mut parts: Vec<usize> = Vec::new();
    for (number, paint) in paints.iter().enumerate() {
        match paint.covered {
            Some(covered) if covered > 1.0 - NOTHING && paint.hides() => parts.clear(),
            Some(covered) if covered > NOTHING && covered < 1.0 - NOTHING && !paint.in_mask => parts.push(number),
            // What lies on different layers meets nobody; and what lies between neighbours, or above both, takes its part of what
            // shines through.
            None if paint.shape.is_layer_mark() => parts.clear(),
            Some(covered) if covered > NOTHING && !paint.in_mask => parts.clear(),
            _ => {}
        }
    }
    let part = |number: &usize| paints[*number].covered.unwrap_or(0.0);
    let all: f64 = parts.iter().map(part).sum();
    if !(2..=MOST_NEIGHBOURS).contains(&parts.len()) || (all - 1.0).abs() > NOTHING {
        return None;
    }
    let pairs = parts
        .iter()
        .enumerate()
        .flat_map(|(i, a)| parts[..i].iter().map(move |b| [*a, *b]));
    let are_apart = |pair: [usize; 2]| {
        let overlap = explainer.overlap(pair.map(|number| paints[number].primitive));
        overlap.is_some_and(|overlap| overlap < NOTHING)
    };
    if !{ pairs }.all(are_apart) {
        return None;
    }
    let through = parts
        .iter()
        .map(|number| 1.0 - part(number) * paints[*number].alpha() / 255.0);
    let through = through.product();
    let by_opacity = parts
        .iter()
        .map(|number| part(number) * (1.0 - paints[*number].alpha() / 255.0))
        .sum();
    (through - by_opacity > NOTHING).then_some(Conflation {
        through,
        by_opacity,
        paints: parts,
    })
}

impl Explanation {
    /// What shows by how much of a pixel that holds one colour; `None` where layers mix what paints it.
    pub(super) fn area_shares(&self) -> Option<AreaShares> {
        if self.paints.iter().any(|paint| paint.shape.is_layer_mark()) {
            return None;
        }
        let mut background = 1.0;
        let mut paints = Vec::new();
        let mut small = (0, 0.0);
        for (number, paint) in self.paints.iter().enumerate().rev() {
            let share = background * paint.covered.unwrap_or(1.0) * paint.alpha() / 255.0;
            background -= share;
            if share >= NOTHING {
                paints.push((number, share));
            } else if share > 0.0 {
                small = (small.0 + 1, small.1 + share);
            }
        }
        Some(AreaShares {
            paints,
            small,
            background,
        })
    }

    /// The same in one sentence.
    pub(super) fn area_words(&self) -> String {
        let Some(AreaShares {
            paints,
            small: (count, small),
            background,
        }) = self.area_shares()
        else {
            return "It holds one colour, made of all that paints it; nothing tells which part shows what.".to_owned();
        };
        let mut shares: Vec<String> = paints
            .iter()
            .filter_map(|(number, share)| {
                let paint = self.paints.get(*number)?;
                Some(format!("{} of {} ({})", percent(*share), number + 1, paint.name()))
            })
            .collect();
        if small >= NOTHING {
            shares.push(format!("{} of {}", percent(small), counted(count, "other")));
        }
        if background >= NOTHING || shares.is_empty() {
            shares.push(format!("{} of the background", percent(background)));
        }
        format!("It holds one colour: {}.", shares.join(", "))
    }

    /// Why the background shows between neighbours that cover the pixel together.
    pub(super) fn conflation_words(&self) -> Option<String> {
        let Conflation {
            paints,
            through,
            by_opacity,
        } = self.conflation.as_ref()?;
        if self.truth.as_ref().is_some_and(Truth::is_reached) {
            // What shines through has the colour that it should.
            return None;
        }
        let known = || {
            paints
                .iter()
                .filter_map(|number| Some((number, self.paints.get(*number)?)))
        };
        let names: Vec<String> = known()
            .map(|(number, paint)| format!("{} ({})", number + 1, paint.name()))
            .collect();
        let part = |paint: &Paint| paint.covered.unwrap_or(0.0) * paint.alpha() / 255.0;
        let factors: Vec<String> = known().map(|(_, paint)| format!("(1 - {:.4})", part(paint))).collect();
        let expected = if *by_opacity > 0.0 {
            format!(", where their opacity alone lets {} through", percent(*by_opacity))
        } else {
            String::new()
        };
        Some(format!(
            "{} cover all of this pixel together, without overlap, and yet {} = {} of what is below shows through{expected}: a seam. Source-over \
             takes each area as if it lay anywhere in the pixel (conflation). Samples know who covers them: supersampling has no \
             such seam.",
            names.join(" and "),
            factors.join(" x "),
            percent(*through),
        ))
    }

    /// Why areas make another colour than samples do, where nothing but flat colours is mixed and no seam is told of.
    pub(super) fn mixed_areas(&self) -> Option<String> {
        let is_flat = |paint: &Paint| {
            let of_view = |view: &View| match view {
                View::Triangle { value, .. } | View::Polygon { value, .. } => *value == Interpolated::Flat,
            };
            paint.texture.is_none() && paint.views.iter().all(of_view)
        };
        let is_part = |paint: &&Paint| {
            paint
                .covered
                .is_some_and(|part| (NOTHING..=1.0 - NOTHING).contains(&part))
        };
        let are_several = self.paints.iter().filter(is_part).nth(1).is_some();
        let is_reason = self.exact && self.resolve.around.is_none() && self.conflation.is_none();
        (is_reason && are_several && self.paints.iter().all(is_flat)).then(|| {
            "Several shapes cover parts of this pixel, and are mixed as if each lay anywhere in it (conflation)."
                .to_owned()
        })
    }

    /// The heading of [`Explanation::resolve_lines`].
    pub fn resolve_title(&self) -> &'static str {
        if self.exact {
            "How areas became the colour"
        } else {
            "How samples became the colour"
        }
    }
}

impl Fragment {
    /// A colour of less alpha than this, in levels, lets what is below shine through.
    const OPAQUE: f64 = 254.99;

    /// Whether what is below shines through its colour.
    pub(super) fn shines_through(&self) -> bool {
        self.color[3] < Self::OPAQUE
    }
}

impl Paint {
    /// The alpha of its colour, in levels.
    fn alpha(&self) -> f64 {
        self.fragments.first().map_or(0.0, |fragment| fragment.color[3])
    }

    /// Whether nothing shines through where it was painted.
    fn hides(&self) -> bool {
        self.fragments
            .first()
            .is_some_and(|fragment| !fragment.shines_through())
    }
}
