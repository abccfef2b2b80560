//! The peers: other people's renderers on the CPU, which draw the same polygons into the same frame.
//!
//! Their paths are made before the clock starts, as our scene is read before; like ours, their frames transform the
//! geometry, start from white and end with finished pixels.

use resvg::usvg;
use tiny_skia::{Color, FillRule, Paint, PathBuilder, Pixmap, Transform};
use vello_cpu::kurbo::{Affine, BezPath};
use vello_cpu::peniko::color::AlphaColor;
use vello_cpu::{RasterizerSettings, RenderContext, RenderSettings, Resources, TargetInit};

use crate::race::Rival;
use crate::scenes::flat::FlatScene;

/// Pixels per user unit, right and down.
fn scale(scene: &FlatScene, size: [u32; 2]) -> [f64; 2] {
    [0, 1].map(|axis| f64::from(size[axis]) / scene.canvas[axis])
}

fn pixmap(size: [u32; 2]) -> Pixmap {
    Pixmap::new(size[0], size[1]).expect("a small frame")
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "tiny-skia's coordinates are 32-bit floats"
)]
fn single(value: f64) -> f32 {
    value as f32
}

/// tiny-skia, which draws on one thread.
pub(crate) fn tiny_skia(scene: &FlatScene, size: [u32; 2], anti_alias: bool) -> Rival<'static> {
    let shapes: Vec<_> = scene
        .polygons
        .iter()
        .filter_map(|polygon| {
            let mut path = PathBuilder::new();
            for (i, [x, y]) in polygon.corners.iter().enumerate() {
                let (x, y) = (single(*x), single(*y));
                if i == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
            }
            path.close();
            let [r, g, b, a] = polygon.color;
            let mut paint = Paint {
                anti_alias,
                ..Paint::default()
            };
            paint.set_color_rgba8(r, g, b, a);
            path.finish().map(|path| (path, paint))
        })
        .collect();
    let [x, y] = scale(scene, size);
    let transform = Transform::from_scale(single(x), single(y));
    let mut frame = pixmap(size);
    Rival::new(move || {
        frame.fill(Color::WHITE);
        for (path, paint) in &shapes {
            frame.fill_path(path, paint, FillRule::Winding, transform, None);
        }
    })
}

/// resvg, which draws with tiny-skia.
pub(crate) fn resvg(scene: &FlatScene, size: [u32; 2], anti_alias: bool) -> Rival<'static> {
    let edges = if anti_alias { "" } else { "shape-rendering='crispEdges'" };
    let tree = usvg::Tree::from_str(&scene.svg(edges), &usvg::Options::default()).expect("a good document");
    let [x, y] = scale(scene, size);
    let transform = Transform::from_scale(single(x), single(y));
    let mut frame = pixmap(size);
    Rival::new(move || {
        frame.fill(Color::WHITE);
        resvg::render(&tree, transform, &mut frame.as_mut());
    })
}

/// `vello_cpu` with analytic antialiasing; `workers` beside the thread that calls it, none for one thread in all.
pub(crate) fn vello(scene: &FlatScene, size: [u32; 2], workers: u16) -> Rival<'static> {
    let shapes: Vec<(BezPath, AlphaColor<_>)> = scene
        .polygons
        .iter()
        .map(|polygon| {
            let mut path = BezPath::new();
            for (i, [x, y]) in polygon.corners.iter().enumerate() {
                if i == 0 {
                    path.move_to((*x, *y));
                } else {
                    path.line_to((*x, *y));
                }
            }
            path.close_path();
            let [r, g, b, a] = polygon.color;
            (path, AlphaColor::from_rgba8(r, g, b, a))
        })
        .collect();
    let [x, y] = scale(scene, size);
    vello_by(size, workers, move |context| {
        context.set_transform(Affine::scale_non_uniform(x, y));
        for (path, color) in &shapes {
            context.set_paint(*color);
            context.fill_path(path);
        }
    })
}

/// `vello_cpu`, which draws what `draw` tells it, over white.
pub(crate) fn vello_by<'s>(size: [u32; 2], workers: u16, mut draw: impl FnMut(&mut RenderContext) + 's) -> Rival<'s> {
    let [width, height] = size.map(|side| u16::try_from(side).expect("a small frame"));
    let settings = RenderSettings {
        num_threads: workers,
        ..RenderSettings::default()
    };
    let mut context = RenderContext::new_with(width, height, settings);
    let mut resources = Resources::new();
    let mut frame = vello_cpu::Pixmap::new(width, height);
    Rival::new(move || {
        context.reset();
        draw(&mut context);
        context.flush();
        let onto_white = RasterizerSettings {
            target_init: TargetInit::Clear(AlphaColor::WHITE),
            ..RasterizerSettings::default()
        };
        context.render_with(&mut frame, &mut resources, onto_white);
    })
}
