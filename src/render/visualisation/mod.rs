//! What a picture shows in place of colours: by which paints those of a scene's primitives are replaced, and how numbers
//! become colours.
//!
//! Shapes and samples stay those of the picture: only paints change, so that a visualisation can be laid over the picture
//! pixel by pixel; and a pixel is the mean of its own samples, whatever filter the picture has, unless it is the filter that is
//! shown. All colours are told apart by people with any kind of colour vision.
//!
//! Each visualisation is a [`Show`] in a file of its own, with its legend. To add one, write its file and a line in the
//! table below.

mod anisotropy;
mod barycentric;
mod clamped;
mod clips;
mod colors;
mod coverage;
mod level_of_detail;
mod mip_levels;
mod overdraw;
mod picture;
mod primitive;
mod show;
mod uv;
mod wireframe;

pub use clamped::ClampedPixels;

use super::{Legend, RenderSettings, Screen, sources};
use crate::geometry::ViewTransform;
use crate::raster::{ChunkBuilder, PaintSources, RasterSettings, SizedFilter};
use crate::render::visualisation::clips::{Role, add_clip, roles};
use crate::render::visualisation::show::{Show, Source};
use crate::scene::Scene;
use crate::texture::SamplingSettings;

/// Makes the enum of all visualisations, with their names and what shows them.
macro_rules! visualisations {
    ($($(#[$doc:meta])* $kind:ident = $name:literal => $show:expr,)+) => {
        /// What the pixels of a picture show.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub enum Visualisation {
            $($(#[$doc])* $kind,)+
        }

        impl Visualisation {
            /// Every value, in the order of menus and of the key that steps through them.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$kind),+];

            /// The name used in the command line and the interface.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => $name,)+
                }
            }

            fn show(self) -> &'static dyn Show {
                match self {
                    $(Self::$kind => &$show,)+
                }
            }
        }
    };
}

// The table of visualisations: a line for each.
visualisations! {
    /// The picture itself.
    #[default]
    Color = "colour" => picture::Picture,
    /// The part of the pixel's samples that any primitive covers, however transparent it is.
    Coverage = "coverage" => coverage::Coverage,
    /// How many fragments the pixel's samples received, on average: what is painted, seen or not.
    Overdraw = "overdraw" => overdraw::Overdraw,
    /// Each primitive in a colour of its own.
    Primitive = "primitive" => primitive::Primitives,
    /// The edges of all primitives over the paled picture.
    Wireframe = "wireframe" => wireframe::Wireframe,
    /// Barycentric weights: a triangle's three corners in three colours.
    Barycentric = "barycentric" => barycentric::Barycentric,
    /// Texture coordinates, clamped to the texture.
    Uv = "uv" => uv::Uv,
    /// The level of detail with which a texture is read, before it is clamped to the levels that exist.
    LevelOfDetail = "lod" => level_of_detail::Lod,
    /// Which mip levels are read: the picture with a tint for each level.
    MipLevels = "mip" => mip_levels::MipLevels,
    /// Where the resolve filter made colours that no pixel can show, below 0 or above 1, over the paled picture.
    Clamped = "clamped" => clamped::Clamped,
    /// How many times as long as wide a pixel's footprint is, as anisotropic filtering measures it.
    Anisotropy = "anisotropy" => anisotropy::Lengths,
}

impl Visualisation {
    /// A name that it had once: scripts, and the records of pictures that were saved then, still have it.
    pub fn former_name(self) -> Option<&'static str> {
        self.show().former_name()
    }

    /// What a pixel's colour is, in few words of Markdown.
    pub fn meaning(self) -> &'static str {
        self.show().meaning()
    }

    /// As [`Visualisation::legend`], with what was counted in the picture.
    pub fn legend_of(self, scene: &Scene, clamped: Option<ClampedPixels>) -> Option<Legend> {
        match self {
            Self::Clamped => Some(clamped::legend(clamped)),
            _ => self.legend(scene),
        }
    }

    /// How many pixels of a picture were clamped, where that is what it shows.
    pub fn clamped(self, pixels: &[u32]) -> Option<ClampedPixels> {
        (self == Self::Clamped).then(|| ClampedPixels::of(pixels))
    }

    /// Whether its pixels are resolved as those of the picture are.
    pub fn resolves_pictures(self) -> bool {
        matches!(self, Self::Color | Self::Clamped)
    }

    /// What the colours of this visualisation of `scene` mean; nothing to say of the picture itself.
    pub fn legend(self, scene: &Scene) -> Option<Legend> {
        self.show().legend(scene)
    }

    /// Whether the canvas' outline belongs into the picture: it is not to be counted.
    pub(super) fn has_outline(self) -> bool {
        self.show().has_outline()
    }
}

/// Replaces the paints of primitives.
pub(super) struct Visualiser<'a> {
    show: &'static dyn Show,
    source: Source<'a>,
    /// What each primitive is, where any is clipped or masked.
    roles: Option<Vec<Role>>,
}

impl<'a> Visualiser<'a> {
    /// For the picture of a scene that is sampled like this.
    pub(super) fn new(kind: Visualisation, scene: &'a Scene, sampling: SamplingSettings) -> Self {
        Self {
            show: kind.show(),
            source: Source { scene, sampling },
            roles: roles(scene),
        }
    }

    /// What the rasterizer does otherwise than for the picture.
    pub(super) fn change(kind: Visualisation, settings: &mut RasterSettings) {
        // Numbers, and colours that stand for them, mean nothing beyond the pixel that they were found in.
        if !kind.resolves_pictures() {
            settings.filter = SizedFilter::default();
        }
        kind.show().change(settings);
    }

    /// What paints point to in a view.
    pub(super) fn sources(&self, view: &ViewTransform, settings: &RenderSettings) -> PaintSources<'a> {
        let mut sources = sources(self.source.scene, view, settings);
        if let Some(own) = self.show.texture() {
            sources.textures = vec![own];
        }
        sources
    }

    /// A builder that does with fragments what is shown.
    pub(super) fn prepare<'b>(&self, builder: ChunkBuilder<'b>) -> ChunkBuilder<'b> {
        self.show.prepare(builder)
    }

    /// Adds primitive number `index`.
    pub(super) fn add(&self, builder: &mut ChunkBuilder<'_>, screen: &Screen<'_>, index: usize) {
        let role = if self.show.keeps_layers() {
            Role::Shown
        } else {
            self.role(index)
        };
        match role {
            Role::Shown => self.show.add(&self.source, (builder, screen), index),
            Role::Clip => add_clip((builder, screen), self.source.kind(index)),
            Role::LeftOut => {}
        }
    }

    /// Whether something comes on top of everything.
    pub(super) fn has_overlay(&self) -> bool {
        self.show.has_overlay()
    }

    /// Pales what was painted so far.
    pub(super) fn add_veil(builder: &mut ChunkBuilder<'_>, size: [u32; 2], background: crate::color::Rgba) {
        wireframe::add_veil(builder, size, background);
    }

    /// Adds what comes on top of primitive number `index`.
    pub(super) fn add_overlay(&self, builder: &mut ChunkBuilder<'_>, screen: &Screen<'_>, index: usize) {
        match self.role(index) {
            Role::Shown => self.show.add_overlay(&self.source, (builder, screen), index),
            Role::Clip => add_clip((builder, screen), self.source.kind(index)),
            Role::LeftOut => {}
        }
    }

    fn role(&self, index: usize) -> Role {
        self.roles.as_ref().map_or(Role::Shown, |roles| roles[index])
    }
}
