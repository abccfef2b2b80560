//! egui's textures: the font atlas and pictures, kept as premultiplied pixels and changed in part or whole.

use std::collections::HashMap;

use egui::TextureId;
use egui::epaint::ImageDelta;
use egui::epaint::textures::{TextureFilter, TextureWrapMode, TexturesDelta};

use super::pixel;

/// One texture: premultiplied pixels, `0xAARRGGBB`, rows from the top.
#[derive(Clone, Debug, Default)]
pub(super) struct Bitmap {
    width: usize,
    height: usize,
    texels: Vec<u32>,
    linear: bool,
    wrap: TextureWrapMode,
}

impl Bitmap {
    /// Texels in a row.
    pub(super) fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub(super) fn height(&self) -> usize {
        self.height
    }

    /// `count` texels of row `y` from column `x` on, or `None` where the texture does not hold them all.
    pub(super) fn row(&self, x: i64, y: i64, count: usize) -> Option<&[u32]> {
        let (x, y) = (usize::try_from(x).ok()?, usize::try_from(y).ok()?);
        if y >= self.height || x + count > self.width {
            return None;
        }
        self.texels.get(y * self.width + x..y * self.width + x + count)
    }

    /// The colour at `(u, v)`, in 1/65536 texels from the texture's corner.
    pub(super) fn sample(&self, u: i64, v: i64) -> u32 {
        if !self.linear {
            return self.texel(u >> 16, v >> 16);
        }
        // Texel centres lie at +0.5.
        let (u, v) = (u - (1 << 15), v - (1 << 15));
        let (x, y) = (u >> 16, v >> 16);
        let top = [self.texel(x, y), self.texel(x + 1, y)];
        let bottom = [self.texel(x, y + 1), self.texel(x + 1, y + 1)];
        pixel::bilinear([top, bottom], fraction(u), fraction(v))
    }

    fn texel(&self, x: i64, y: i64) -> u32 {
        let (x, y) = (self.wrapped(x, self.width), self.wrapped(y, self.height));
        self.texels.get(y * self.width + x).copied().unwrap_or_default()
    }

    fn wrapped(&self, at: i64, size: usize) -> usize {
        let size = i64::try_from(size).unwrap_or(i64::MAX).max(1);
        let inside = match self.wrap {
            TextureWrapMode::ClampToEdge => at.clamp(0, size - 1),
            TextureWrapMode::Repeat => at.rem_euclid(size),
            TextureWrapMode::MirroredRepeat => {
                let twice = at.rem_euclid(2 * size);
                twice.min(2 * size - 1 - twice)
            }
        };
        usize::try_from(inside).unwrap_or_default()
    }

    /// Whether `grown` begins with the same rows, but for texels that were transparent: the font's texture grows so.
    fn is_part_of(&self, grown: &Self) -> bool {
        let alike = self.width == grown.width && self.linear == grown.linear && self.wrap == grown.wrap;
        let (old, new) = (&self.texels, &grown.texels);
        let stays = |(old, new): (&u32, &u32)| *old == 0 || old == new;
        alike && !old.is_empty() && old.len() <= new.len() && old.iter().zip(new).all(stays)
    }

    /// Takes new texels in. True if pixels that were painted with the old ones may look different: a letter that joins
    /// the font's texture, in a place that was transparent, changes nothing that anybody painted.
    fn apply(&mut self, delta: &ImageDelta) -> bool {
        let egui::ImageData::Color(image) = &delta.image;
        let [width, height] = image.size;
        let texels = image.pixels.iter().copied().map(pixel::from_color);
        let Some([left, top]) = delta.pos else {
            let new = Self {
                width,
                height,
                texels: texels.collect(),
                linear: delta.options.magnification == TextureFilter::Linear,
                wrap: delta.options.wrap_mode,
            };
            return !std::mem::replace(self, new).is_part_of(self);
        };
        if left + width > self.width || top + height > self.height {
            return false; // egui promises that this never happens
        }
        let mut any_seen = false;
        for (i, texel) in texels.enumerate() {
            let old = &mut self.texels[(top + i / width) * self.width + left + i % width];
            any_seen |= *old != 0 && *old != texel;
            *old = texel;
        }
        any_seen
    }
}

/// The fraction of a coordinate in 1/65536 texels.
fn fraction(coordinate: i64) -> u32 {
    u32::try_from(coordinate & 0xffff).unwrap_or_default()
}

/// Every texture that egui has handed out.
#[derive(Debug, Default)]
pub(super) struct Textures {
    bitmaps: HashMap<TextureId, Bitmap>,
}

impl Textures {
    /// Takes new and changed textures in, and names those that make a difference to what was painted with them. To be
    /// called before painting.
    pub(super) fn set(&mut self, delta: &mut TexturesDelta) -> Vec<TextureId> {
        let mut changed = Vec::with_capacity(delta.set.len());
        for (id, images) in delta.set.drain() {
            let bitmap = self.bitmaps.entry(id).or_default();
            let mut any_seen = false;
            for image in &images {
                any_seen |= bitmap.apply(image);
            }
            if any_seen {
                changed.push(id);
            }
        }
        changed
    }

    /// Drops what egui no longer needs. To be called after painting.
    pub(super) fn free(&mut self, delta: &mut TexturesDelta) {
        for id in delta.free.drain() {
            self.bitmaps.remove(&id);
        }
    }

    /// The texture of that name, if egui ever sent it.
    pub(super) fn get(&self, id: TextureId) -> Option<&Bitmap> {
        self.bitmaps.get(&id)
    }
}
