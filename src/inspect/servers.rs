//! What fills a primitive: a pattern, a gradient, a texture.

use glam::DVec2;

use super::area_use::AreaUse;
use super::explanation::Question;
use super::model::{GradientUse, Level, PatternUse, Texture};
use crate::raster::TextureUse;
use crate::render::RenderSettings;
use crate::scene::{Fill, PrimitiveKind};
use crate::texture::{Area, LevelChoice, Reading, Texture as SceneTexture};

impl Question<'_> {
    /// The pattern that fills a primitive.
    pub(super) fn pattern(&self, primitive: u32) -> Option<PatternUse> {
        let scene = self.subject.scene;
        let PrimitiveKind::Polygon {
            fill: Fill::Pattern(pattern),
            ..
        } = scene.primitives.get(primitive as usize)?.kind
        else {
            return None;
        };
        let pattern = scene.patterns.get(pattern.0 as usize)?;
        let shape = scene.shapes.get(pattern.shape.0 as usize)?;
        Some(PatternUse {
            source: self.source_of(shape, None),
            tile: pattern.tile.canvas.to_array(),
            opacity: f64::from(pattern.opacity),
        })
    }

    /// The gradient that fills a primitive.
    pub(super) fn gradient(&self, primitive: u32) -> Option<GradientUse> {
        let scene = self.subject.scene;
        let PrimitiveKind::Polygon {
            fill: Fill::Gradient(gradient),
            ..
        } = scene.primitives.get(primitive as usize)?.kind
        else {
            return None;
        };
        let gradient = scene.gradients.get(gradient.0 as usize)?;
        let shape = scene.shapes.get(gradient.shape.0 as usize)?;
        Some(GradientUse {
            source: self.source_of(shape, None),
            spread: gradient.ramp.spread().name(),
            stops: gradient.ramp.stops().len(),
        })
    }

    /// How a texture is read.
    pub(super) fn texture(&self, usage: &TextureUse) -> Texture {
        let RenderSettings {
            pixel_sampling,
            texture_wrap,
            level_sampling,
            pyramid,
            pyramid_filter,
            detail,
            ..
        } = self.subject.settings;
        let texture = &self.subject.scene.textures[usage.texture as usize];
        let levels = texture.pyramid.levels();
        let size = [levels[0].width(), levels[0].height()];
        let texels = DVec2::new(f64::from(size[0]), f64::from(size[1]));
        let reading = &usage.reading;
        let (right, down) = (reading.footprint.dx * texels, reading.footprint.dy * texels);
        Texture {
            name: texture.name.clone(),
            index: usage.texture,
            size,
            pixel_sampling: texture.asks.unwrap_or(*pixel_sampling).name(),
            wrap: texture_wrap.name(),
            asked: texture.asks.is_some(),
            level_sampling: level_sampling.name(),
            right: right.to_array(),
            down: down.to_array(),
            step: detail.derivatives.name(),
            major: right.length().max(down.length()),
            minor: right.length().min(down.length()),
            extent: detail.extent.name(),
            taps: reading.taps.count,
            level_of_detail: Some(reading.lod).filter(|lod| lod.is_finite()),
            bias: detail.bias.levels(),
            fixed: detail.fixed.is_some(),
            clamped: reading.lod.clamp(0.0, texture.pyramid.last_level() as f64),
            levels: levels_read(texture, reading),
            area: reading
                .area
                .as_ref()
                .map(|area| AreaUse::new(area, texture.ripmap_widths())),
            pyramid: pyramid.name(),
            pyramid_filter: pyramid_filter.name(),
            opacity: f64::from(usage.opacity),
        }
    }
}

/// The levels that a texture is read at: of its pyramid, or those that its ripmap mixes along both axes.
fn levels_read(texture: &SceneTexture, reading: &Reading) -> Vec<Level> {
    let both = |LevelChoice { level, next_weight }: LevelChoice| {
        let next = f64::from(next_weight);
        [(level, 1.0 - next), (level + 1, next)]
            .into_iter()
            .filter(|(_, part)| *part > 0.0)
    };
    if let Some(Area::Ripmap([along_u, along_v])) = reading.area {
        let widths = texture.ripmap_widths();
        let [width, height] = texture.tabled_size();
        let all = both(along_v).flat_map(|(j, low)| both(along_u).map(move |(i, narrow)| (i, j, low * narrow)));
        return all
            .map(|(i, j, weight)| Level {
                number: j * widths + i,
                size: [(width >> i).max(1), (height >> j).max(1)],
                weight,
            })
            .collect();
    }
    let levels = texture.pyramid.levels();
    let found = both(reading.levels).filter_map(|(number, weight)| {
        let level = levels.get(number)?;
        Some(Level {
            number,
            size: [level.width(), level.height()],
            weight,
        })
    });
    found.collect()
}
