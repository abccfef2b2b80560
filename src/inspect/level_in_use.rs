//! The mip level that a pixel reads most of.

use glam::{DAffine2, DVec2};

use super::area_use::AreaUse;
use super::model::{Explanation, Interpolated, Level, Paint, Texture, View};
use crate::scene::Scene;
use crate::texture::MipLevel;

/// A mip level, and how the pixels around one lie on it.
#[derive(Clone, Copy, Debug)]
pub struct LevelInUse<'a> {
    /// The texture.
    pub texture: &'a Texture,
    /// The level.
    pub level: Level,
    /// From pixels of the frame to the level's texels: the map of the triangle that reads it.
    pub to_texels: DAffine2,
}

impl Texture {
    /// The texels of a level of this texture in the scene that it is of.
    pub fn texels<'s>(&self, scene: &'s Scene, level: &Level) -> Option<&'s MipLevel> {
        let texture = scene.textures.get(self.index as usize)?;
        let (space, filter) = (self.averaged_in(), self.filtered_by());
        if matches!(self.area, Some(AreaUse::Ripmap { .. })) {
            return texture.ripmap(space, filter).levels().get(level.number);
        }
        texture.pyramid_in(space, filter).levels().get(level.number)
    }

    /// The level that it is read most of.
    pub fn main_level(&self) -> Option<Level> {
        let heaviest = self.levels.iter().max_by(|a, b| a.weight.total_cmp(&b.weight));
        heaviest.copied()
    }
}

impl Explanation {
    /// The level that the topmost textured triangle in the pixel reads most of; `None` where the pixel shows no texture.
    pub fn level_in_use(&self) -> Option<LevelInUse<'_>> {
        let seen = self.paints.iter().rev().filter(|paint| paint.is_seen());
        let mut textured = seen.filter_map(|paint| self.level_of(paint));
        textured.next()
    }

    /// The level that a paint which is seen reads most of; `None` where it reads no texture.
    pub(super) fn level_of<'a>(&self, paint: &'a Paint) -> Option<LevelInUse<'a>> {
        let texture = paint.texture.as_ref()?;
        let level = texture.main_level()?;
        let fragment = paint.fragments.iter().find(|fragment| fragment.seen)?;
        let Some(View::Triangle {
            value: Interpolated::Texture { uv, .. },
            ..
        }) = paint.views.get(fragment.sample)
        else {
            return None;
        };
        let place = paint
            .shaded_at
            .or(self.samples.get(fragment.sample).map(|sample| sample.position))?;
        let at = DVec2::from(self.pixel.map(f64::from)) + DVec2::from(place);
        // A sample's step is that of a square grid of as many samples as the pixel has.
        let steps = if texture.step == "sample" {
            (self.samples.len() as f64).sqrt()
        } else {
            1.0
        };
        let size = DVec2::from(level.size.map(f64::from));
        let scale = size / DVec2::from(texture.size.map(f64::from)) * steps;
        let [right, down] = [texture.right, texture.down].map(|step| DVec2::from(step) * scale);
        let texel = DVec2::from(*uv) * size;
        let corner = texel - right * at.x - down * at.y;
        Some(LevelInUse {
            texture,
            level,
            to_texels: DAffine2::from_cols(right, down, corner),
        })
    }
}
