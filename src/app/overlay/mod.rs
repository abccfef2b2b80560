//! egui's triangles on the CPU: the interface is painted into a canvas of its own and laid over the scene's frame.
//!
//! egui hands out meshes in points, y down, with premultiplied sRGB-encoded colours that are to be mixed as they are.
//! The canvas is in device pixels and is repainted only where a mesh changed.

mod canvas;
mod pixel;
mod quad;
mod texture;
mod triangle;

pub use canvas::{Canvas, CanvasRect};

use egui::epaint::textures::TexturesDelta;
use egui::epaint::{ClippedPrimitive, Mesh, Primitive};
use egui::{Rect, TextureId};

use quad::Quad;
use texture::Textures;
use triangle::Corner;

/// The painted interface.
#[derive(Debug, Default)]
pub struct Overlay {
    canvas: Canvas,
    textures: Textures,
    painted: Vec<ClippedPrimitive>,
    pixels_per_point: f32,
}

impl Overlay {
    /// What was painted last, in device pixels.
    pub fn canvas(&self) -> &Canvas {
        &self.canvas
    }

    /// Brings the canvas up to what egui put out for a surface of `size` pixels, and says which part changed.
    ///
    /// Takes everything out of `textures`. Paint callbacks are skipped: nothing here makes any.
    pub fn paint(
        &mut self,
        size: [u32; 2],
        pixels_per_point: f32,
        primitives: Vec<ClippedPrimitive>,
        textures: &mut TexturesDelta,
    ) -> CanvasRect {
        let changed_textures = self.textures.set(textures);
        let resized = [self.canvas.width(), self.canvas.height()] != size;
        if resized {
            self.canvas = Canvas::new(size[0], size[1]);
        }
        let whole = CanvasRect::of_size(size[0], size[1]);
        let same_scale = pixels_per_point.to_bits() == self.pixels_per_point.to_bits();
        self.pixels_per_point = pixels_per_point;
        let damage = if resized || !same_scale {
            whole
        } else {
            self.damage(&primitives, &changed_textures).intersect(whole)
        };
        if !damage.is_empty() {
            self.canvas.clear(damage);
            for primitive in &primitives {
                let clip = self.to_pixels(primitive.clip_rect).intersect(damage);
                if let Primitive::Mesh(mesh) = &primitive.primitive
                    && !clip.is_empty()
                {
                    self.paint_mesh(mesh, clip);
                }
            }
        }
        self.painted = primitives;
        self.textures.free(textures);
        damage
    }

    /// The pixels that may differ between what was painted last and `primitives`.
    fn damage(&self, primitives: &[ClippedPrimitive], changed_textures: &[TextureId]) -> CanvasRect {
        let mut damage = CanvasRect::EMPTY;
        for index in 0..primitives.len().max(self.painted.len()) {
            let (old, new) = (self.painted.get(index), primitives.get(index));
            if let (Some(old), Some(new)) = (old, new)
                && is_same(old, new, changed_textures)
            {
                continue;
            }
            for primitive in [old, new].into_iter().flatten() {
                damage = damage.join(self.reach(primitive));
            }
        }
        damage
    }

    /// The pixels that a primitive can touch.
    fn reach(&self, primitive: &ClippedPrimitive) -> CanvasRect {
        let Primitive::Mesh(mesh) = &primitive.primitive else {
            return CanvasRect::EMPTY;
        };
        self.to_pixels(primitive.clip_rect.intersect(mesh.calc_bounds().expand(1.0)))
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

/// Whether both paint the same pixels.
fn is_same(old: &ClippedPrimitive, new: &ClippedPrimitive, changed_textures: &[TextureId]) -> bool {
    match (&old.primitive, &new.primitive) {
        (Primitive::Mesh(a), Primitive::Mesh(b)) => {
            old.clip_rect == new.clip_rect && !changed_textures.contains(&b.texture_id) && a == b
        }
        _ => false,
    }
}
