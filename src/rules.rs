//! The rules of the picture: ours, the course's, or those of a first draft.
//!
//! One setting, so that a student sees what each rule does by comparing two pictures. The type lies at the bottom
//! of the house because most rooms read it: it decides who owns the samples on an edge (`geometry`), edges in 32-bit floats
//! and what painting nothing does (`raster`), bytes (`color`, and `post`, which mixes them again), texels (`texture`) and
//! screen positions (`render`). `compare` finds out which rules another picture follows, `inspect` says what they did.

/// Which conventions decide a pixel where renderers differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Rules {
    /// Edges by the top-left rule, bytes rounded to nearest, the texel that contains the point, positions as computed.
    #[default]
    Standard,
    /// As UC Berkeley's CS184 assignment: a sample on an edge belongs to every triangle that touches it, bytes are
    /// truncated, texels are addressed by `round(u (w - 1))`, screen positions are rounded to 32-bit floats.
    Course,
    /// As first drafts of a rasterizer: edge functions of triangles in 32-bit floats, and no rule for ties. A sample on an
    /// edge belongs to nobody, and rounding may give one to both neighbours or to none. All else is standard.
    Float,
}

impl Rules {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Standard, Self::Course, Self::Float];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::Course => "course",
            Self::Float => "float",
        }
    }

    /// Whether all that is filled is triangles: polygons are drawn as those that they are cut into.
    pub const fn cut_polygons(self) -> bool {
        match self {
            Self::Standard => false,
            Self::Course | Self::Float => true,
        }
    }
}
