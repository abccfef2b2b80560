//! egui's shapes on the CPU: the interface is painted into a canvas of its own and laid over the scene's frame.
//!
//! egui hands out shapes in points, y down, and meshes with premultiplied sRGB-encoded colours that are to be mixed as
//! they are. The canvas is in device pixels and is repainted only where a shape changed.

mod canvas;
mod changes;
mod pixel;
mod quad;
mod texture;
mod triangle;

pub use canvas::{Canvas, CanvasRect};

use egui::Rect;
use egui::epaint::textures::TexturesDelta;
use egui::epaint::{ClippedPrimitive, ClippedShape, Mesh, Primitive};

use changes::{changed_bounds, joined, reach};
use quad::Quad;
use texture::Textures;
use triangle::Corner;

/// The painted interface.
#[derive(Debug, Default)]
pub struct Overlay {
    canvas: Canvas,
    textures: Textures,
    painted: Vec<ClippedShape>,
    pixels_per_point: f32,
}

/// What egui put out.
#[derive(Clone, Debug, Default)]
pub struct Output {
    /// The surface in device pixels.
    pub size: [u32; 2],
    /// Device pixels per point.
    pub pixels_per_point: f32,
    /// In painter's order.
    pub shapes: Vec<ClippedShape>,
}

impl Overlay {
    /// What was painted last, in device pixels.
    pub fn canvas(&self) -> &Canvas {
        &self.canvas
    }

    /// Brings the canvas up to what egui put out, and says which parts were painted anew; no two share a pixel.
    ///
    /// Takes everything out of `textures`. `tessellate` cuts the shapes that touch those parts into triangles; paint
    /// callbacks are skipped: nothing here makes any.
    pub fn paint(
        &mut self,
        output: Output,
        textures: &mut TexturesDelta,
        tessellate: impl FnOnce(Vec<ClippedShape>) -> Vec<ClippedPrimitive>,
    ) -> Vec<CanvasRect> {
        let Output {
            size,
            pixels_per_point,
            shapes,
        } = output;
        let changed_textures = self.textures.set(textures);
        let resized = [self.canvas.width(), self.canvas.height()] != size;
        if resized {
            self.canvas = Canvas::new(size[0], size[1]);
        }
        let same_scale = pixels_per_point.to_bits() == self.pixels_per_point.to_bits();
        self.pixels_per_point = pixels_per_point;
        let whole = CanvasRect::of_size(size[0], size[1]);
        let parts = if resized || !same_scale {
            vec![whole]
        } else {
            let bounds = changed_bounds(&self.painted, &shapes, &changed_textures);
            joined(bounds.into_iter().map(|bounds| self.around(bounds).intersect(whole)))
        };
        if !parts.is_empty() {
            self.repaint(&parts, &shapes, tessellate);
        }
        self.painted = shapes;
        self.textures.free(textures);
        parts
    }

    /// Clears `parts` and paints all shapes there.
    fn repaint(
        &mut self,
        parts: &[CanvasRect],
        shapes: &[ClippedShape],
        tessellate: impl FnOnce(Vec<ClippedShape>) -> Vec<ClippedPrimitive>,
    ) {
        let touches = |shape: &&ClippedShape| {
            let pixels = self.around(reach(shape));
            parts.iter().any(|part| !part.intersect(pixels).is_empty())
        };
        let primitives = tessellate(shapes.iter().filter(touches).cloned().collect());
        for part in parts {
            self.canvas.clear(*part);
            for primitive in &primitives {
                let clip = self.to_pixels(primitive.clip_rect).intersect(*part);
                if let Primitive::Mesh(mesh) = &primitive.primitive
                    && !clip.is_empty()
                {
                    self.paint_mesh(mesh, clip);
                }
            }
        }
    }

    /// The pixels that a rectangle in points touches.
    fn around(&self, points: Rect) -> CanvasRect {
        if !points.is_positive() {
            return CanvasRect::EMPTY;
        }
        self.to_pixels(points.expand(1.0 / self.pixels_per_point.max(0.1)))
    }

    /// A rectangle in points as the pixels inside; edges are rounded, as egui's own renderers do.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the longest side of a frame first; NaN becomes 0"
    )]
    fn to_pixels(&self, points: Rect) -> CanvasRect {
        let edge = |at: f32| (at * self.pixels_per_point).round().clamp(0.0, 65536.0) as u32;
        CanvasRect {
            left: edge(points.min.x),
            top: edge(points.min.y),
            right: edge(points.max.x).min(self.canvas.width()),
            bottom: edge(points.max.y).min(self.canvas.height()),
        }
    }

    fn paint_mesh(&mut self, mesh: &Mesh, clip: CanvasRect) {
        let Some(texture) = self.textures.get(mesh.texture_id) else {
            return;
        };
        let corner = |index: u32| {
            let vertex = mesh.vertices.get(index as usize)?;
            Some(Corner::new(vertex, self.pixels_per_point, texture))
        };
        let mut rest = mesh.indices.as_slice();
        while let [a, b, c, after @ ..] = rest {
            if let [c2, b2, d, after @ ..] = after
                && c2 == c
                && b2 == b
                && let [Some(a), Some(b), Some(c), Some(d)] = [a, b, c, d].map(|index| corner(*index))
                && let Some(quad) = Quad::recognise([a, b, c, d])
            {
                quad.paint(&mut self.canvas, clip, texture);
                rest = after;
                continue;
            }
            if let [Some(a), Some(b), Some(c)] = [a, b, c].map(|index| corner(*index)) {
                triangle::paint(&mut self.canvas, clip, [a, b, c], texture);
            }
            rest = after;
        }
    }
}
