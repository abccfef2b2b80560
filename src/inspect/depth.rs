//! Which paints of a pixel are listed one by one: of deep stacks some, and no viewport that takes nothing away.

use std::collections::HashSet;

use super::seen::seen_fragments;
use crate::color::Premultiplied16;
use crate::raster::{PaintedCommand, PaintedKind, PixelReplay};
use crate::scene::{Composite, PrimitiveKind, Scene};

/// Paints that are listed, from the last; what samples show is listed besides.
const MOST_PAINTS: usize = 300;

/// Leaves in `replay` what is listed: the last paints, those that samples show, and the layers that they lie on. Answers with
/// what of their fragments is seen, and with how many paints were left out.
pub(super) fn list(replay: &mut PixelReplay) -> (Vec<Vec<bool>>, usize) {
    let mut seen = seen_fragments(replay);
    let all = replay.painted.len();
    if all <= MOST_PAINTS {
        return (seen, 0);
    }
    let mut listed = listed(replay, &seen).into_iter();
    let mut also = listed.clone();
    replay.painted.retain(|_| listed.next().unwrap_or(true));
    seen.retain(|_| also.next().unwrap_or(true));
    let left = replay.painted.len();
    (seen, all - left)
}

/// Leaves out the edges of viewports that keep all samples: documents do not name them, and symbols, marks and masks have one
/// each.
pub(super) fn drop_idle_viewports(replay: &mut PixelReplay, scene: &Scene) {
    let all = replay.samples.len();
    let is_idle = |op: &PaintedCommand| {
        let whole = |alpha: u16| alpha == Premultiplied16::ONE;
        let keeps_all = op.fragments.len() == all && op.fragments.iter().all(|fragment| whole(fragment.color.0[3]));
        keeps_all
            && scene.primitives.get(op.source as usize).is_some_and(|primitive| {
                let is_clip = matches!(
                    primitive.kind,
                    PrimitiveKind::EndLayer {
                        composite: Composite::Clip
                    }
                );
                let shape = scene.shapes.get(primitive.shape.0 as usize);
                is_clip && shape.is_none_or(|shape| &*shape.element != "clipPath")
            })
    };
    let mut kept = vec![true; replay.painted.len()];
    let mut open = Vec::new();
    for (i, op) in replay.painted.iter().enumerate() {
        match op.kind {
            PaintedKind::BeginLayer => open.push(i),
            PaintedKind::EndLayer(_) => {
                let begin = open.pop().unwrap_or(i);
                if is_idle(op) {
                    kept[begin..=i].fill(false);
                }
            }
            PaintedKind::Primitive => {}
        }
    }
    let mut kept = kept.into_iter();
    replay.painted.retain(|_| kept.next().unwrap_or(true));
}

/// For each op whether it is listed. All ops of one primitive are, or none.
fn listed(replay: &PixelReplay, seen: &[Vec<bool>]) -> Vec<bool> {
    let ops = || replay.painted.iter().zip(seen);
    let mut shown = vec![None; replay.samples.len()];
    for (op, seen) in ops().filter(|(op, _)| op.kind == PaintedKind::Primitive) {
        for (fragment, _) in op.fragments.iter().zip(seen).filter(|(_, seen)| **seen) {
            shown[fragment.sample] = Some(op.source);
        }
    }
    let last = replay.painted.iter().rev().take(MOST_PAINTS).map(|op| op.source);
    let sources: HashSet<u32> = shown.into_iter().flatten().chain(last).collect();
    let mut listed = vec![false; replay.painted.len()];
    let mut open: Vec<(usize, bool)> = Vec::new();
    for (i, op) in replay.painted.iter().enumerate() {
        let is_used = match op.kind {
            PaintedKind::Primitive => sources.contains(&op.source),
            PaintedKind::BeginLayer => {
                open.push((i, false));
                continue;
            }
            PaintedKind::EndLayer(_) => {
                let (begin, is_used) = open.pop().unwrap_or((i, false));
                listed[begin] = is_used;
                is_used
            }
        };
        listed[i] = is_used;
        if let Some((_, any)) = open.last_mut() {
            *any |= is_used;
        }
    }
    listed
}
