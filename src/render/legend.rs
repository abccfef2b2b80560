//! What the colours of a visualisation mean: data for whoever draws it.

use super::visualisation::{
    CORNERS, EDGES, MOST_FRAGMENTS, MOST_LEVELS, NONE, UV, Visualisation, anisotropy_color, level_color,
    level_of_detail_color, logarithmic, overdraw_color, primitive_color,
};
use crate::color::{Colormap, Rgba, unit_to_byte};
use crate::rules::Rules;
use crate::scene::{Paint, PrimitiveKind, Scene};
use crate::texture::Anisotropy;

/// Steps of a scale.
const STEPS: u16 = 256;

/// The legend of a visualisation. Colours are opaque `0xAARRGGBB`.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// What the colours show, and in which unit.
    pub title: &'static str,
    /// How they show it.
    pub key: LegendKey,
    /// What has a colour outside the key, such as primitives without a texture.
    pub others: Vec<(u32, &'static str)>,
}

/// How colours stand for what is shown.
#[derive(Clone, Debug, PartialEq)]
pub enum LegendKey {
    /// A scale from left to right: its colours, and labels at parts `0.0..=1.0` of its length.
    Scale(Vec<u32>, Vec<(f32, String)>),
    /// Colours that stand for things.
    Swatches(Vec<(u32, String)>),
    /// A triangle's corners, between which colours are mixed.
    Triangle([(u32, &'static str); 3]),
    /// Two axes from the upper left corner, to the right and down, whose colours add up.
    Square([(u32, &'static str); 2]),
}

impl Visualisation {
    /// What the colours of this visualisation of `scene` mean; nothing to say of the picture itself.
    pub fn legend(self, scene: &Scene) -> Option<Legend> {
        let (title, key) = match self {
            Self::Color => return None,
            Self::Coverage => ("coverage: part of the pixel's samples", coverage()),
            Self::Overdraw => ("overdraw: fragments per sample", overdraw()),
            Self::Primitive => ("primitives, in painter's order", primitives(scene)),
            Self::Wireframe => ("wireframe", wireframe()),
            Self::Barycentric => (
                "barycentric weights",
                LegendKey::Triangle(std::array::from_fn(|i| {
                    (CORNERS[i], ["first corner", "second corner", "third corner"][i])
                })),
            ),
            Self::Uv => (
                "texture coordinates",
                LegendKey::Square([(UV[0], "u = 1"), (UV[1], "v = 1")]),
            ),
            Self::LevelOfDetail => (
                "level of detail: below 0 magnified, above 0 minified",
                level_of_detail(),
            ),
            Self::MipLevels => ("mip levels that are read", levels(scene)),
            Self::Anisotropy => ("anisotropy: length of the footprint over its width", anisotropy()),
        };
        let others = match self {
            Self::Barycentric => vec![(NONE, "no triangle")],
            Self::Uv | Self::LevelOfDetail | Self::MipLevels | Self::Anisotropy => vec![(NONE, "no texture")],
            _ => Vec::new(),
        };
        Some(Legend { title, key, others })
    }
}

/// A scale whose colour at a part `0.0..=1.0` of its length is `color`.
fn scale(color: impl Fn(f32) -> u32, ticks: impl IntoIterator<Item = (f32, String)>) -> LegendKey {
    let colors = (0..STEPS).map(|step| color(f32::from(step) / f32::from(STEPS - 1)));
    LegendKey::Scale(colors.collect(), ticks.into_iter().collect())
}

fn coverage() -> LegendKey {
    let labels = ["0", "1/4", "1/2", "3/4", "1"];
    let ticks = (0_u8..)
        .zip(labels)
        .map(|(i, label)| (f32::from(i) / 4.0, label.to_owned()));
    scale(|part| Colormap::Sequential.color(part), ticks)
}

fn overdraw() -> LegendKey {
    let most = f32::from(MOST_FRAGMENTS);
    let color = |part: f32| overdraw_color((part * (most + 1.0).log2()).exp2() - 1.0);
    let ticks = [0, 1, 2, 4, 8, 16, MOST_FRAGMENTS].map(|count| {
        let at = logarithmic(f32::from(count) + 1.0, most + 1.0);
        let more = if count == MOST_FRAGMENTS { "+" } else { "" };
        (at, format!("{count}{more}"))
    });
    scale(color, ticks)
}

fn level_of_detail() -> LegendKey {
    let color = |part: f32| level_of_detail_color(MOST_LEVELS * (2.0 * part - 1.0));
    let ticks = [-8_i8, -4, 0, 4, 8].map(|level| {
        let at = (f32::from(level) / MOST_LEVELS).midpoint(1.0);
        (at, level.to_string())
    });
    scale(color, ticks)
}

fn anisotropy() -> LegendKey {
    let most = Anisotropy::MAX as f32;
    let color = |part: f32| anisotropy_color((part * most.log2()).exp2());
    let ticks = [1_u8, 2, 4, 8, 16, 32, 64].map(|ratio| {
        let more = if u32::from(ratio) == Anisotropy::MAX { "+" } else { "" };
        (logarithmic(f32::from(ratio), most), format!("{ratio}{more}"))
    });
    scale(color, ticks)
}

/// The first primitives that are there.
fn primitives(scene: &Scene) -> LegendKey {
    const MOST: usize = 6;
    let all = scene.primitives.iter().enumerate();
    let painted = all.filter(|(_, primitive)| {
        !matches!(
            primitive.kind,
            PrimitiveKind::BeginLayer | PrimitiveKind::EndLayer { .. }
        )
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
            swatches.push((pixel(primitive_color(index)), name));
        }
    }
    if count > MOST {
        swatches.truncate(MOST - 1);
        let left = count - swatches.len();
        swatches.push((NONE, format!("and {left} more; colours repeat")));
    }
    LegendKey::Swatches(swatches)
}

fn wireframe() -> LegendKey {
    let labels = ["edges of triangles", "outlines of polygons", "hairlines and points"];
    LegendKey::Swatches(EDGES.into_iter().zip(labels.map(str::to_owned)).collect())
}

/// The levels that the scene's textures have.
fn levels(scene: &Scene) -> LegendKey {
    let used = scene.primitives.iter().filter_map(|primitive| match primitive.kind {
        PrimitiveKind::Triangle {
            paint: Paint::Texture { texture, .. },
            ..
        } => Some(texture.0 as usize),
        _ => None,
    });
    let last = used.map(|texture| scene.textures[texture].pyramid.last_level()).max();
    let levels = last.map_or(0..0, |last| 0..last + 1);
    LegendKey::Swatches(
        levels
            .map(|level| (pixel(level_color(level)), level.to_string()))
            .collect(),
    )
}

fn pixel(color: Rgba) -> u32 {
    let [r, g, b] = [color.r, color.g, color.b].map(|channel| unit_to_byte(channel, Rules::Standard));
    u32::from_be_bytes([0xFF, r, g, b])
}
