//! Clip paths and masks: layers that take away from the layer below them.

use glam::{DAffine2, DVec2};
use usvg::{ClipPath, Group, Mask, filter};

use super::affine::affine;
use super::painter::{Painter, Place};
use super::values::WHITENS;
use crate::color::{BlendMode, Rgba};
use crate::geometry::{CurvedArea, FillRule, Path};
use crate::scene::build::{Edges, FilledArea};
use crate::scene::error::Fault;
use crate::scene::{Composite, Fill, MaskKind};

/// Clips the layer that was begun last; `false` where nothing of it is left.
pub(super) fn clip(painter: &mut Painter<'_, '_>, clip: &ClipPath, place: Place) -> Result<bool, Fault> {
    // A clip path of a clip path leaves what both leave.
    if let Some(outer) = clip.clip_path()
        && !self::clip(painter, outer, place)?
    {
        return Ok(false);
    }
    let shape = painter.definition(clip.id(), clip.root(), "clipPath", place.shape);
    let inside = Place {
        to_user: place.to_user * affine(clip.transform()),
        shape,
        opacity: 1.0,
    };
    painter.builder.begin_layer(shape)?;
    silhouettes(painter, clip.root(), inside)?;
    if painter.builder.is_empty_layer() {
        return Ok(false);
    }
    painter.builder.end_layer(shape, Composite::Clip)?;
    Ok(true)
}

/// The insides of all paths of a clip path, opaque.
fn silhouettes(painter: &mut Painter<'_, '_>, group: &Group, place: Place) -> Result<(), Fault> {
    for node in group.children() {
        match node {
            usvg::Node::Group(group) => {
                let place = Place {
                    to_user: place.to_user * affine(group.transform()),
                    shape: painter.owner(group, place.shape),
                    ..place
                };
                let is_using = painter.begin_use(group);
                let drawn = silhouettes_of_group(painter, group, place);
                if is_using {
                    painter.used.pop();
                }
                drawn?;
            }
            usvg::Node::Text(text) => {
                let shape = painter.leaf(text.id(), place.shape);
                silhouettes(painter, text.flattened(), Place { shape, ..place })?;
            }
            usvg::Node::Path(path) => {
                let shape = painter.leaf(path.id(), place.shape);
                if let Some(fill) = path.fill().filter(|_| path.is_visible()) {
                    let opaque = Fill::Solid(Rgba::BLACK);
                    painter.area(path, fill.rule(), opaque, Place { shape, ..place })?;
                }
            }
            usvg::Node::Image(_) => {}
        }
    }
    Ok(())
}

/// A child of a clip path, which may be clipped itself.
fn silhouettes_of_group(painter: &mut Painter<'_, '_>, group: &Group, place: Place) -> Result<(), Fault> {
    let Some(own) = group.clip_path() else {
        return silhouettes(painter, group, place);
    };
    let mark = painter.builder.mark();
    painter.builder.begin_layer(place.shape)?;
    silhouettes(painter, group, place)?;
    if painter.builder.is_empty_layer() || !clip(painter, own, place)? {
        painter.builder.take_back(mark);
        return Ok(());
    }
    let composite = Composite::Over {
        opacity: 1.0,
        blend: BlendMode::Normal,
    };
    painter.builder.end_layer(place.shape, composite)
}

/// Whether a mask is one group that a filter makes white, so that its luminance is its opacity: as cairo writes all its masks.
fn is_whitened(mask: &Group) -> bool {
    let [usvg::Node::Group(group)] = mask.children() else {
        return false;
    };
    let [filter] = group.filters() else {
        return false;
    };
    let [primitive] = filter.primitives() else {
        return false;
    };
    match primitive.kind() {
        filter::Kind::ColorMatrix(matrix) => {
            matches!(matrix.kind(), filter::ColorMatrixKind::Matrix(values) if values.as_slice() == WHITENS)
        }
        _ => false,
    }
}

/// Masks the layer that was begun last; `false` where nothing of it is left.
pub(super) fn mask(painter: &mut Painter<'_, '_>, mask: &Mask, place: Place) -> Result<bool, Fault> {
    if let Some(outer) = mask.mask()
        && !self::mask(painter, outer, place)?
    {
        return Ok(false);
    }
    let shape = painter.definition(mask.id(), mask.root(), "mask", place.shape);
    let inside = Place { shape, ..place };
    painter.builder.begin_layer(shape)?;
    painter.children(mask.root(), inside)?;
    if painter.builder.is_empty_layer() {
        return Ok(false);
    }
    let rect = mask.rect();
    to_box(painter, [rect.left(), rect.top(), rect.right(), rect.bottom()], inside)?;
    let kind = match mask.kind() {
        usvg::MaskType::Luminance if is_whitened(mask.root()) => MaskKind::Alpha,
        usvg::MaskType::Luminance => MaskKind::Luminance,
        usvg::MaskType::Alpha => MaskKind::Alpha,
    };
    painter.builder.end_layer(shape, Composite::Mask(kind))?;
    Ok(true)
}

/// Clips the layer that was begun last to a box: left, top, right, bottom.
pub(super) fn to_box(painter: &mut Painter<'_, '_>, sides: [f32; 4], place: Place) -> Result<(), Fault> {
    let [left, top, right, bottom] = sides.map(f64::from);
    let mut path = Path::default();
    path.move_to(DVec2::new(left, top));
    for (x, y) in [(right, top), (right, bottom), (left, bottom)] {
        path.line_to(DVec2::new(x, y));
    }
    path.close();
    let to_user: DAffine2 = place.to_user;
    let area = CurvedArea {
        path,
        stroke: None,
        to_user,
    };
    painter.builder.begin_layer(place.shape)?;
    let edges = Edges {
        scale: painter.scale,
        crisp: false,
    };
    let opaque = Fill::Solid(Rgba::BLACK);
    painter.builder.fill_curved(
        place.shape,
        FilledArea {
            area,
            rule: FillRule::NonZero,
        },
        opaque,
        edges,
    )?;
    painter.builder.end_layer(place.shape, Composite::Clip)
}
