//! What of a scene's layers a visualisation keeps: clip paths, since what they take away is not there.
//!
//! ```text
//!      BeginLayer             kept: what is clipped gathers here
//!        shapes               repainted
//!        BeginLayer, shapes   the clip path: painted opaque, whatever is shown
//!        EndLayer (clip)
//!      EndLayer (over)        kept, without its opacity and blend mode
//! ```
//!
//! All other layers are left out, with their opacities and blend modes; masks too, which have no edge.

use crate::color::Rgba;
use crate::raster::Compositing;
use crate::render::visualisation::show::{Target, repaint};
use crate::scene::{Composite, PrimitiveKind, Scene};

/// What a primitive is to a visualisation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// It is repainted.
    Shown,
    /// It belongs to a clip path, or to the layer that is clipped.
    Clip,
    /// It belongs to a mask, or to a layer that is left out.
    LeftOut,
}

/// The role of each primitive; `None` where all are shown, or layers that are left out.
pub(super) fn roles(scene: &Scene) -> Option<Vec<Role>> {
    scene.parts_of_masks()?;
    let mut roles = vec![Role::Shown; scene.primitives.len()];
    // Where each open layer begins, and whether it is clipped.
    let mut open: Vec<(usize, bool)> = Vec::new();
    for (index, primitive) in scene.primitives.iter().enumerate() {
        match &primitive.kind {
            PrimitiveKind::BeginLayer => open.push((index, false)),
            PrimitiveKind::EndLayer { composite } => {
                let (begin, is_clipped) = open.pop().unwrap_or((index, false));
                match composite {
                    Composite::Clip => {
                        mark_clip(&mut roles[begin..=index]);
                        if let Some((_, around)) = open.last_mut() {
                            *around = true;
                        }
                    }
                    Composite::Mask(_) => roles[begin..=index].fill(Role::LeftOut),
                    Composite::Over { .. } => {
                        let role = if is_clipped { Role::Clip } else { Role::LeftOut };
                        (roles[begin], roles[index]) = (role, role);
                    }
                }
            }
            _ => {}
        }
    }
    Some(roles)
}

/// The shapes of a clip path, and its layer. What is left out of it stays so.
fn mark_clip(roles: &mut [Role]) {
    for role in &mut *roles {
        if *role == Role::Shown {
            *role = Role::Clip;
        }
    }
}

/// Adds what belongs to a clip path, or the layer that it clips.
pub(super) fn add_clip((builder, screen): Target<'_, '_>, kind: &PrimitiveKind) {
    match kind {
        PrimitiveKind::BeginLayer => builder.begin_layer(),
        PrimitiveKind::EndLayer {
            composite: Composite::Clip,
        } => builder.end_layer(Compositing::mask(false)),
        PrimitiveKind::EndLayer { .. } => builder.end_layer(Compositing::with_opacity(1.0)),
        shape => builder.uncounted(|builder| repaint((builder, screen), shape, Rgba::WHITE)),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::Role::{Clip, LeftOut, Shown};
    use super::*;
    use crate::scene::{Dialect, MaskKind, Primitive, ShapeId};

    #[test]
    fn clips_are_kept_and_other_layers_left_out() {
        let point = || PrimitiveKind::Point {
            at: DVec2::ZERO,
            color: Rgba::BLACK,
        };
        let end = |composite| PrimitiveKind::EndLayer { composite };
        let mut scene = Scene::empty(DVec2::ONE, Dialect::Svg);
        let of = |scene: &mut Scene, kinds: Vec<PrimitiveKind>| {
            let shape = ShapeId(0);
            scene.primitives = kinds.into_iter().map(|kind| Primitive { shape, kind }).collect();
        };
        of(
            &mut scene,
            vec![PrimitiveKind::BeginLayer, point(), end(Composite::over(0.5))],
        );
        assert_eq!(roles(&scene), None, "nothing is clipped");
        let clipped = vec![
            PrimitiveKind::BeginLayer,
            PrimitiveKind::BeginLayer,
            point(),
            end(Composite::over(0.5)),
            PrimitiveKind::BeginLayer,
            point(),
            end(Composite::Clip),
            PrimitiveKind::BeginLayer,
            point(),
            end(Composite::Mask(MaskKind::Alpha)),
            end(Composite::over(0.5)),
        ];
        of(&mut scene, clipped);
        let expected = [
            Clip, LeftOut, Shown, LeftOut, Clip, Clip, Clip, LeftOut, LeftOut, LeftOut, Clip,
        ];
        assert_eq!(roles(&scene).expect("a clip"), expected);
    }
}
