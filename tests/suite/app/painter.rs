//! The overlay's painter against a slow reference that follows the GPU renderer's shader: every pixel, every triangle,
//! real numbers, and a target of 8 bits that each triangle rounds to.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::unwrap_used,
    reason = "numbers of a small picture; a test that cannot unwrap has failed"
)]

use std::sync::Arc;

use arbtest::arbitrary::{Result, Unstructured};
use egui::emath::TSTransform;
use egui::epaint::textures::{TextureOptions, TexturesDelta};
use egui::epaint::{ClippedPrimitive, ClippedShape, ImageDelta, Mesh, Primitive, Shape, Vertex};
use egui::{Color32, ColorImage, ImageData, Pos2, Rect, TextureId, pos2, vec2};
use rasterscope::app::overlay::{CanvasRect, Output, Overlay};

/// Sides of the canvas in pixels.
const SIZE: [u32; 2] = [48, 40];
/// Farthest that a channel may be from the reference, in 1/255.
const TOLERANCE: f64 = 2.0;

/// A texture with something different everywhere, and white in its corner as egui's font atlas has.
fn atlas() -> ColorImage {
    let texel = |i: usize| {
        let (x, y) = (i % 32, i / 32);
        let alpha = u8::try_from((x * 37 + y * 91) % 256).unwrap();
        Color32::from_rgba_unmultiplied(u8::try_from(x * 8).unwrap(), u8::try_from(y * 15).unwrap(), 200, alpha)
    };
    let mut image = ColorImage::new([32, 16], (0..32 * 16).map(texel).collect());
    image.pixels[0] = Color32::WHITE;
    image
}

fn textures(image: ColorImage, options: TextureOptions) -> TexturesDelta {
    let mut delta = TexturesDelta::default();
    delta.push(TextureId::default(), ImageDelta::full(image, options));
    delta
}

fn clipped(clip_rect: Rect, mesh: Mesh) -> ClippedShape {
    ClippedShape {
        clip_rect,
        shape: Shape::Mesh(Arc::new(mesh)),
        transform_after_tessellation: TSTransform::IDENTITY,
    }
}

/// Paints shapes that are meshes, and gives the parts that were painted anew.
fn paint(
    overlay: &mut Overlay,
    size: [u32; 2],
    pixels_per_point: f32,
    shapes: Vec<ClippedShape>,
    textures: &mut TexturesDelta,
) -> Vec<CanvasRect> {
    let output = Output {
        size,
        pixels_per_point,
        shapes,
    };
    let primitive = |shape: ClippedShape| match shape.shape {
        Shape::Mesh(mesh) => ClippedPrimitive {
            clip_rect: shape.clip_rect,
            primitive: Primitive::Mesh(Arc::unwrap_or_clone(mesh)),
        },
        other => panic!("{other:?} is no mesh"),
    };
    overlay.paint(output, textures, |shapes| shapes.into_iter().map(primitive).collect())
}

/// The mesh over `below`, as real numbers, channels r g b a in 0..=255.
fn reference(mesh: &Mesh, clip: Rect, scale: f32, image: &ColorImage, below: &mut [[f64; 4]]) {
    for triangle in mesh.triangles() {
        let corners = triangle.map(|index| mesh.vertices[index as usize]);
        let snapped = corners.map(|v| [v.pos.x, v.pos.y].map(|p| f64::from((p * scale * 256.0).round()) / 256.0));
        let [a, b, c] = snapped;
        let cross =
            |p: [f64; 2], q: [f64; 2], r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
        let area = cross(a, b, c);
        if area == 0.0 {
            continue;
        }
        for (index, pixel) in below.iter_mut().enumerate() {
            let (x, y) = (index as u32 % SIZE[0], index as u32 / SIZE[0]);
            let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let inside_clip = |at: u32, low: f32, high: f32| {
                (at as f32) >= (low * scale).round() && (at as f32) < (high * scale).round()
            };
            if !inside_clip(x, clip.min.x, clip.max.x) || !inside_clip(y, clip.min.y, clip.max.y) {
                continue;
            }
            let edges = [(b, c), (c, a), (a, b)].map(|(from, to)| {
                let value = cross(from, to, p) * area.signum();
                let (dx, dy) = ((to[0] - from[0]) * area.signum(), (to[1] - from[1]) * area.signum());
                let owns_edge = dy < 0.0 || (dy == 0.0 && dx > 0.0);
                (value > 0.0 || (value == 0.0 && owns_edge)).then_some(value / area.abs())
            });
            let [Some(u), Some(v), Some(w)] = edges else { continue };
            let weights = [u, v, w];
            let mut source = [0.0; 4];
            for (channel, value) in source.iter_mut().enumerate() {
                *value = weights
                    .iter()
                    .zip(&corners)
                    .map(|(w, v)| w * f64::from(v.color.to_array()[channel]))
                    .sum();
            }
            let uv = |pick: fn(&Vertex) -> f32| -> f64 {
                weights.iter().zip(&corners).map(|(w, v)| w * f64::from(pick(v))).sum()
            };
            let texel = sample(image, uv(|v| v.uv.x), uv(|v| v.uv.y));
            for (value, texel) in source.iter_mut().zip(texel) {
                *value *= texel / 255.0;
            }
            let alpha = source[3];
            for (under, over) in pixel.iter_mut().zip(source) {
                *under = (over + *under * (1.0 - alpha / 255.0)).min(255.0).round();
            }
        }
    }
}

/// Linear filtering, clamped to the edge.
fn sample(image: &ColorImage, u: f64, v: f64) -> [f64; 4] {
    let [width, height] = image.size;
    let (x, y) = (u * width as f64 - 0.5, v * height as f64 - 0.5);
    let mut sum = [0.0; 4];
    for (dx, dy) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
        let weight = |at: f64, d: f64| {
            if d > 0.5 {
                at - at.floor()
            } else {
                1.0 - (at - at.floor())
            }
        };
        let column = (x.floor() + dx).clamp(0.0, width as f64 - 1.0) as usize;
        let row = (y.floor() + dy).clamp(0.0, height as f64 - 1.0) as usize;
        let texel = image.pixels[row * width + column].to_array();
        for (sum, texel) in sum.iter_mut().zip(texel) {
            *sum += weight(x, dx) * weight(y, dy) * f64::from(texel);
        }
    }
    sum
}

/// The largest difference of a channel, and where.
fn worst(overlay: &Overlay, expected: &[[f64; 4]]) -> (f64, usize) {
    let mut worst = (0.0, 0);
    for (index, (got, expected)) in overlay.canvas().pixels().iter().zip(expected).enumerate() {
        let [a, r, g, b] = got.to_be_bytes().map(f64::from);
        for (got, expected) in [r, g, b, a].iter().zip(expected) {
            if (got - expected).abs() > worst.0 {
                worst = ((got - expected).abs(), index);
            }
        }
    }
    worst
}

fn color(u: &mut Unstructured<'_>) -> Result<Color32> {
    let [r, g, b, a]: [u8; 4] = u.arbitrary()?;
    Ok(match u.int_in_range(0..=3)? {
        0 => Color32::from_rgb(r, g, b),
        1 => Color32::TRANSPARENT,
        _ => Color32::from_rgba_unmultiplied(r, g, b, a),
    })
}

/// A coordinate: whole pixels and half pixels are common, so that ties are.
fn coordinate(u: &mut Unstructured<'_>) -> Result<f32> {
    let half_pixels: i16 = u.int_in_range(-20..=120)?;
    let nudge = if u.ratio(1, 2)? {
        f32::from(u.arbitrary::<i8>()?) / 256.0
    } else {
        0.0
    };
    Ok(f32::from(half_pixels) / 2.0 + nudge)
}

fn vertex(u: &mut Unstructured<'_>, textured: bool) -> Result<Vertex> {
    let unit = |u: &mut Unstructured<'_>| -> Result<f32> { Ok(f32::from(u.arbitrary::<u8>()?) / 255.0) };
    Ok(Vertex {
        pos: pos2(coordinate(u)?, coordinate(u)?),
        uv: if textured { pos2(unit(u)?, unit(u)?) } else { Pos2::ZERO },
        color: color(u)?,
    })
}

#[test]
fn overlay_triangles_match_the_reference() {
    arbtest::arbtest(|u| {
        let mut mesh = Mesh::default();
        let textured = u.ratio(1, 3)?;
        for _ in 0..u.int_in_range(1..=2)? {
            let first = u32::try_from(mesh.vertices.len()).unwrap();
            for _ in 0..3 {
                mesh.vertices.push(vertex(u, textured)?);
            }
            mesh.add_triangle(first, first + 1, first + 2);
        }
        let scale = *u.choose(&[1.0, 1.5, 2.0])?;
        let clip = Rect::from_two_pos(
            pos2(coordinate(u)?, coordinate(u)?),
            pos2(coordinate(u)?, coordinate(u)?),
        );
        let mut expected = vec![[0.0; 4]; (SIZE[0] * SIZE[1]) as usize];
        reference(&mesh, clip, scale, &atlas(), &mut expected);
        let mut overlay = Overlay::default();
        let count = mesh.triangles().count();
        paint(
            &mut overlay,
            SIZE,
            scale,
            vec![clipped(clip, mesh.clone())],
            &mut textures(atlas(), TextureOptions::LINEAR),
        );
        let (difference, at) = worst(&overlay, &expected);
        assert!(
            difference <= TOLERANCE,
            "{difference} at pixel {at} of {count} triangles: {mesh:?} scale {scale} clip {clip:?}"
        );
        Ok(())
    })
    .budget_ms(1500);
}

#[test]
fn overlay_rectangles_match_the_reference() {
    arbtest::arbtest(|u| {
        let mut mesh = Mesh::default();
        let tint = color(u)?;
        let (left, top) = (coordinate(u)?, coordinate(u)?);
        let (width, height): (u8, u8) = (u.int_in_range(0..=20)?, u.int_in_range(0..=12)?);
        let rect = Rect::from_min_size(pos2(left, top), vec2(f32::from(width), f32::from(height)));
        // Glyphs show a texel on a pixel; pictures and discs are stretched.
        let stretch = if u.ratio(1, 2)? { 1.0 } else { 0.7 };
        let uv = Rect::from_min_size(
            pos2(1.0 / 32.0, 2.0 / 16.0),
            vec2(f32::from(width) * stretch / 32.0, f32::from(height) * stretch / 16.0),
        );
        mesh.add_rect_with_uv(rect, uv, tint);
        let mut expected = vec![[0.0; 4]; (SIZE[0] * SIZE[1]) as usize];
        reference(&mesh, Rect::EVERYTHING, 1.0, &atlas(), &mut expected);
        let mut overlay = Overlay::default();
        let primitives = vec![clipped(Rect::EVERYTHING, mesh)];
        paint(
            &mut overlay,
            SIZE,
            1.0,
            primitives,
            &mut textures(atlas(), TextureOptions::LINEAR),
        );
        let (difference, at) = worst(&overlay, &expected);
        assert!(
            difference <= TOLERANCE,
            "{difference} at pixel {at}: {rect:?} {uv:?} {tint:?}"
        );
        Ok(())
    })
    .budget_ms(1000);
}

/// Two triangles of one colour that share an edge must neither leave a gap nor blend twice.
#[test]
fn overlay_shared_edges_blend_once() {
    arbtest::arbtest(|u| {
        let half = Color32::from_black_alpha(128);
        let mut points = Vec::new();
        for _ in 0..4 {
            points.push(pos2(coordinate(u)?, coordinate(u)?));
        }
        let side = |p: Pos2| {
            let (a, b) = (points[0], points[1]);
            (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)
        };
        if side(points[2]) * side(points[3]) >= 0.0 {
            return Ok(()); // both on one side: they overlap
        }
        let mut mesh = Mesh::default();
        for point in &points {
            mesh.colored_vertex(*point, half);
        }
        mesh.add_triangle(0, 1, 2);
        mesh.add_triangle(1, 0, 3);
        let mut overlay = Overlay::default();
        let primitives = vec![clipped(Rect::EVERYTHING, mesh)];
        paint(
            &mut overlay,
            SIZE,
            1.0,
            primitives,
            &mut textures(atlas(), TextureOptions::LINEAR),
        );
        for pixel in overlay.canvas().pixels() {
            assert!([0, 128].contains(&(pixel >> 24)), "alpha {}: {points:?}", pixel >> 24);
        }
        Ok(())
    })
    .budget_ms(500);
}

#[test]
fn overlay_survives_any_position() {
    let far = [
        0.0,
        1e30,
        -1e30,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
        1e-30,
        16_777_216.0,
    ];
    for x in far {
        for y in far {
            let mut mesh = Mesh::default();
            mesh.colored_vertex(pos2(x, y), Color32::RED);
            mesh.colored_vertex(pos2(10.0, y), Color32::RED);
            mesh.colored_vertex(pos2(x, 10.0), Color32::GREEN);
            mesh.add_triangle(0, 1, 2);
            mesh.indices.extend([0, 1, 99]); // outside: left out
            let mut overlay = Overlay::default();
            let primitives = vec![clipped(Rect::EVERYTHING, mesh)];
            paint(
                &mut overlay,
                SIZE,
                1.0,
                primitives,
                &mut textures(atlas(), TextureOptions::LINEAR),
            );
        }
    }
}

#[test]
fn overlay_repaints_only_what_changed() {
    let square = |at: Pos2, color: Color32| {
        let mut mesh = Mesh::default();
        mesh.add_colored_rect(Rect::from_min_size(at, vec2(4.0, 4.0)), color);
        clipped(Rect::EVERYTHING, mesh)
    };
    let mut overlay = Overlay::default();
    let mut delta = textures(atlas(), TextureOptions::LINEAR);
    let first = vec![
        square(pos2(2.0, 2.0), Color32::RED),
        square(pos2(20.0, 20.0), Color32::from_black_alpha(100)),
    ];
    let whole = CanvasRect::of_size(SIZE[0], SIZE[1]);
    assert_eq!(
        paint(&mut overlay, SIZE, 1.0, first.clone(), &mut delta),
        [whole],
        "the first time everything"
    );
    assert!(
        paint(&mut overlay, SIZE, 1.0, first.clone(), &mut delta).is_empty(),
        "nothing changed"
    );

    let moved = vec![
        first[0].clone(),
        square(pos2(22.0, 20.0), Color32::from_black_alpha(100)),
    ];
    let damage = paint(&mut overlay, SIZE, 1.0, moved.clone(), &mut delta);
    let near = |part: &CanvasRect| part.left >= 16 && part.right <= 30 && part.top >= 16 && part.bottom <= 28;
    assert!(
        !damage.is_empty() && damage.iter().all(near),
        "old and new place: {damage:?}"
    );
    let mut fresh = Overlay::default();
    paint(
        &mut fresh,
        SIZE,
        1.0,
        moved.clone(),
        &mut textures(atlas(), TextureOptions::LINEAR),
    );
    assert_eq!(overlay.canvas().pixels(), fresh.canvas().pixels(), "as if painted anew");

    delta.push(
        TextureId::default(),
        ImageDelta::partial(
            [0, 0],
            ColorImage::filled([1, 1], Color32::from_gray(128)),
            TextureOptions::LINEAR,
        ),
    );
    assert!(
        !paint(&mut overlay, SIZE, 1.0, moved, &mut delta).is_empty(),
        "a texture changed in part"
    );
    let pixel = overlay.canvas().pixels()[3 * SIZE[0] as usize + 3];
    assert_eq!(pixel, 0xff80_0000, "red through a grey texel");
    assert!(delta.is_empty(), "everything was taken in");
}

#[test]
fn overlay_pictures_are_copied_exactly() {
    let id = TextureId::User(7);
    let picture = ColorImage::new([8, 4], (0..32).map(|i| Color32::from_rgb(i * 7, 255 - i, i)).collect());
    let mut delta = textures(atlas(), TextureOptions::LINEAR);
    delta.push(
        id,
        ImageDelta::full(ImageData::Color(picture.clone().into()), TextureOptions::NEAREST),
    );
    let mut mesh = Mesh::with_texture(id);
    let unit = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
    mesh.add_rect_with_uv(
        Rect::from_min_size(pos2(4.0, 6.0), vec2(4.0, 2.0)),
        unit,
        Color32::WHITE,
    );
    let mut overlay = Overlay::default();
    paint(
        &mut overlay,
        SIZE,
        2.0,
        vec![clipped(Rect::EVERYTHING, mesh)],
        &mut delta,
    );
    for (i, texel) in picture.pixels.iter().enumerate() {
        let got = overlay.canvas().pixels()[(12 + i / 8) * SIZE[0] as usize + 8 + i % 8];
        let [r, g, b, a] = texel.to_array();
        assert_eq!(got.to_be_bytes(), [a, r, g, b], "texel {i}");
    }
}

#[test]
fn overlay_lies_over_the_frame() {
    let mut mesh = Mesh::default();
    let rect = Rect::from_min_max(pos2(1.0, 1.0), pos2(3.0, 2.0));
    mesh.add_colored_rect(rect, Color32::from_black_alpha(51));
    let mut overlay = Overlay::default();
    let primitives = vec![clipped(Rect::EVERYTHING, mesh)];
    paint(
        &mut overlay,
        [4, 3],
        1.0,
        primitives,
        &mut textures(atlas(), TextureOptions::LINEAR),
    );
    let mut frame = vec![0xffff_ffff_u32; 12];
    overlay.canvas().lay_over(&mut frame);
    let board: Vec<u32> = frame.iter().map(|pixel| pixel & 255).collect();
    assert_eq!(
        board,
        [255, 255, 255, 255, 255, 204, 204, 255, 255, 255, 255, 255],
        "a fifth darker"
    );
}
