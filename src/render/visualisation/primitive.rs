//! Each primitive in a colour of its own.

use crate::color::Rgba;
use crate::render::visualisation::colors::{NONE, pixel, shade_of};
use crate::render::visualisation::show::{Show, Source, Target, repaint};
use crate::render::{Legend, LegendKey};
use crate::scene::{PrimitiveKind, Scene};

/// Colours for things without an order (P. Tol, "Colour Schemes", SRON/EPS/TN/09-002, 2021: "muted").
const MUTED: [u32; 9] = [
    0xFF33_2288,
    0xFFDD_CC77,
    0xFF88_CCEE,
    0xFFCC_6677,
    0xFF11_7733,
    0xFF88_2255,
    0xFF44_AA99,
    0xFF99_9933,
    0xFFAA_4499,
];

/// So many primitives are named in the legend.
const MOST: usize = 6;

pub(super) struct Primitives;

impl Show for Primitives {
    fn meaning(&self) -> &'static str {
        "each primitive in a colour of its own"
    }

    fn legend(&self, scene: &Scene) -> Option<Legend> {
        Some(Legend {
            title: "primitives, in painter's order",
            key: LegendKey::Swatches(swatches(scene)),
            others: Vec::new(),
        })
    }

    fn add(&self, source: &Source<'_>, target: Target<'_, '_>, index: usize) {
        repaint(target, source.kind(index), color(index));
    }
}

/// The colour of a primitive.
fn color(index: usize) -> Rgba {
    shade_of(&MUTED, index)
}

/// The first primitives that are there.
fn swatches(scene: &Scene) -> Vec<(u32, String)> {
    let all = scene.primitives.iter().enumerate();
    let masks = scene.parts_of_masks();
    let painted = all.filter(|(index, primitive)| {
        let is_mark = matches!(
            primitive.kind,
            PrimitiveKind::BeginLayer | PrimitiveKind::EndLayer { .. }
        );
        !is_mark && !masks.as_ref().is_some_and(|parts| parts[*index])
    });
    let (mut swatches, mut count) = (Vec::new(), 0);
    for (index, primitive) in painted {
        count += 1;
        if count <= MOST {
            let shape = &scene.shapes[primitive.shape.0 as usize];
            let name = shape.id.as_ref().map_or_else(
                || format!("{}, line {}", shape.element, shape.location.line),
                |id| format!("{} \"{id}\"", shape.element),
            );
            swatches.push((pixel(color(index)), name));
        }
    }
    if count > MOST {
        swatches.truncate(MOST - 1);
        let left = count - swatches.len();
        swatches.push((NONE, format!("and {left} more; colours repeat")));
    }
    swatches
}
