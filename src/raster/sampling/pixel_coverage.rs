//! What tells how much of a pixel a primitive covers: samples, or its area.
//!
//! ```text
//!     sampled         exact
//!    +-------/-+     +-------/-+
//!    | x   x/o |     |######/  |     x . covered, o not covered: 2 of 4 samples
//!    |     /   |     |#####/   |
//!    | x  /o   |     |####/    |     # . 57 % of the pixel
//!    +---/-----+     +---/-----+
//! ```

/// What tells how much of a pixel a primitive covers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PixelCoverage {
    /// Its samples, each of which holds what it shows.
    #[default]
    Sampled,
    /// The exact area that the primitive and the pixel have in common (Catmull, "A hidden-surface algorithm with anti-aliasing",
    /// 1978; Duff, "Polygon scan conversion by exact convolution", 1989). The pixel holds one colour, with which primitives are
    /// composited one after the other, source-over, by their alpha times that area: nothing tells which part of the pixel they
    /// covered, as in most renderers of vector graphics.
    Exact,
}

impl PixelCoverage {
    /// All, in the order of menus.
    pub const ALL: [Self; 2] = [Self::Sampled, Self::Exact];

    /// The name in the window, on the command line and in records.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sampled => "sampled",
            Self::Exact => "exact",
        }
    }

    /// Whether a pixel has no samples, but areas.
    pub const fn is_exact(self) -> bool {
        matches!(self, Self::Exact)
    }
}
