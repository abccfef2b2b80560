//! What every visualisation answers, and how it repaints primitives.

use glam::DVec2;

use crate::color::Rgba;
use crate::geometry::Polygon;
use crate::raster::{self, ChunkBuilder, RasterSettings};
use crate::render::visualisation::colors::{NONE, rgba};
use crate::render::{Legend, Screen, add};
use crate::scene::{Fill, Paint, PrimitiveKind, Scene};
use crate::texture::{MipPyramid, SamplingSettings, Texture};

/// What is visualised.
#[derive(Clone, Copy, Debug)]
pub(super) struct Source<'a> {
    pub(super) scene: &'a Scene,
    pub(super) sampling: SamplingSettings,
}

/// Where primitives go, and how they come to the screen.
pub(super) type Target<'t, 'b> = (&'t mut ChunkBuilder<'b>, &'t Screen<'t>);

/// A visualisation.
pub(super) trait Show: Sync {
    /// What a pixel's colour is, in Markdown: for the help.
    fn meaning(&self) -> &'static str;

    /// A name that it had once.
    fn former_name(&self) -> Option<&'static str> {
        None
    }

    /// What its colours mean.
    fn legend(&self, scene: &Scene) -> Option<Legend>;

    /// Whether the canvas' outline belongs into the picture.
    fn has_outline(&self) -> bool {
        true
    }

    /// What the rasterizer does otherwise than for the picture.
    fn change(&self, _: &mut RasterSettings) {}

    /// The texture that it reads in place of the scene's.
    fn texture(&self) -> Option<&'static Texture> {
        None
    }

    /// A builder that does with fragments what is shown.
    fn prepare<'b>(&self, builder: ChunkBuilder<'b>) -> ChunkBuilder<'b> {
        builder
    }

    /// Whether layers are the picture's, and not only clips are kept.
    fn keeps_layers(&self) -> bool {
        false
    }

    /// Adds primitive number `index`.
    fn add(&self, source: &Source<'_>, target: Target<'_, '_>, index: usize);

    /// Whether something comes on top of everything, once the picture is paled.
    fn has_overlay(&self) -> bool {
        false
    }

    /// Adds what comes on top of primitive number `index`.
    fn add_overlay(&self, _: &Source<'_>, _: Target<'_, '_>, _: usize) {}
}

/// A triangle with a texture, on the screen.
pub(super) struct Textured<'a> {
    pub(super) points: [DVec2; 3],
    pub(super) uv: [[f32; 2]; 3],
    pub(super) pyramid: &'a MipPyramid,
    pub(super) paint: raster::Paint,
}

impl Source<'_> {
    /// Primitive number `index`.
    pub(super) fn kind(&self, index: usize) -> &PrimitiveKind {
        &self.scene.primitives[index].kind
    }

    /// Adds primitive number `index` by `add_textured` where it has a texture; else in the colour of what has none.
    pub(super) fn each_textured(
        &self,
        (builder, screen): Target<'_, '_>,
        index: usize,
        add_textured: impl FnOnce(&mut ChunkBuilder<'_>, &Textured<'_>),
    ) {
        let kind = self.kind(index);
        let PrimitiveKind::Triangle {
            points,
            paint: own @ Paint::Texture { texture, uv, .. },
        } = kind
        else {
            return repaint((builder, screen), kind, rgba(NONE));
        };
        let textured = Textured {
            points: points.map(|point| screen.place(point)),
            uv: uv.map(|uv| uv.to_array()),
            pyramid: &self.scene.textures[texture.0 as usize].pyramid,
            paint: crate::render::paint(own),
        };
        add_textured(builder, &textured);
    }
}

/// Adds a primitive in one opaque colour; layers are left out.
pub(super) fn repaint((builder, screen): Target<'_, '_>, kind: &PrimitiveKind, color: Rgba) {
    match kind {
        PrimitiveKind::Triangle { points, .. } => {
            builder.triangle(points.map(|point| screen.place(point)), &raster::Paint::solid(color));
        }
        PrimitiveKind::Polygon { polygon, .. } => {
            let polygon = polygon.clone();
            let fill = Fill::Solid(color);
            add(builder, screen, &PrimitiveKind::Polygon { polygon, fill });
        }
        PrimitiveKind::Hairline { ends, .. } => {
            builder.hairline(ends.map(|end| screen.place(end)), color);
        }
        PrimitiveKind::Point { at, .. } => builder.point(screen.place(*at), color),
        PrimitiveKind::BeginLayer | PrimitiveKind::EndLayer { .. } => {}
    }
}

/// The triangles that a polygon is painted as, where it is.
pub(super) fn triangles_of<'p>(polygon: &'p Polygon, screen: &Screen<'_>) -> Option<&'p [[DVec2; 3]]> {
    screen.rules.cut_polygons().then(|| polygon.triangles()).flatten()
}
