//! Which fragments of a pixel are seen: painted over by nothing opaque, and not taken away by a clip path or mask.

use crate::color::Premultiplied16;
use crate::raster::{PaintedKind, PaintedSample, PixelReplay};

/// For each op and each of its fragments whether anything of it is seen. Of a clip path or mask nothing is.
pub(super) fn seen_fragments(replay: &PixelReplay) -> Vec<Vec<bool>> {
    let mut seen: Vec<Vec<bool>> = replay
        .painted
        .iter()
        .map(|op| vec![false; op.fragments.len()])
        .collect();
    // From the last to the first: which samples are hidden in each layer that is open there.
    let mut hidden = vec![vec![false; replay.samples.len()]];
    for (op, seen) in replay.painted.iter().zip(&mut seen).rev() {
        let above = hidden.last().cloned().unwrap_or_default();
        if let Some(hidden) = hidden.last_mut() {
            for (fragment, seen) in op.fragments.iter().zip(seen) {
                let sample = &mut hidden[fragment.sample];
                let color = fragment.color;
                *seen = match op.kind {
                    PaintedKind::EndLayer(compositing) if !compositing.keeps_below() => false,
                    PaintedKind::EndLayer(_) if is_neutral(fragment) => false,
                    _ => !*sample && color != Premultiplied16::TRANSPARENT,
                };
                *sample |= match op.kind {
                    PaintedKind::EndLayer(compositing) => compositing.hides(color),
                    PaintedKind::Primitive | PaintedKind::BeginLayer => color.is_opaque() && op.is_whole(),
                };
            }
        }
        match op.kind {
            PaintedKind::Primitive => {}
            PaintedKind::EndLayer(compositing) if !compositing.keeps_below() => {
                hidden.push(vec![true; replay.samples.len()]);
            }
            // What is hidden around a layer is hidden in it, and so is what changes nothing.
            PaintedKind::EndLayer(_) => {
                let mut inside = above;
                for fragment in op.fragments.iter().filter(|fragment| is_neutral(fragment)) {
                    inside[fragment.sample] = true;
                }
                hidden.push(inside);
            }
            PaintedKind::BeginLayer => {
                hidden.pop();
            }
        }
    }
    seen
}

/// Whether an opaque sample of a layer leaves what is below it as it is, as white does that is multiplied.
fn is_neutral(fragment: &PaintedSample) -> bool {
    fragment.color.is_opaque() && fragment.after == fragment.before && fragment.after != fragment.color
}
