//! How often a primitive is shaded in a pixel: for each sample, or once.
//!
//! Coverage is always decided sample by sample. What costs most is the colour, and one for all samples of a pixel is enough for
//! smooth edges: that is multisampling. Inside a primitive nothing is averaged then, and textures alias as with one sample.
//!
//! ```text
//!     sample          centre          centroid
//!    +-------/-+     +-------/-+     +-------/-+
//!    | x   x/o |     | .   ./  |     | .   ./  |     x . covered, o not covered
//!    |     /   |     |    X/   |     |   X /   |     x X shaded
//!    | x  /o   |     | .  /    |     | .  /    |
//!    +---/-----+     +---/-----+     +---/-----+
//! ```

/// How often a primitive is shaded in a pixel.
///
/// Multisampling with its two places is that of the OpenGL 4.6 core specification, section 14.3.1, and of Direct3D 11.3's
/// functional specification, sections 3.5.4 to 3.5.6. Hardware may take any covered place for a centroid; here it is the mean of the
/// covered samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ShadingRate {
    /// At each sample: supersampling.
    #[default]
    Sample,
    /// Once per primitive, in the middle of the pixel, even where the primitive does not cover that.
    Centre,
    /// Once per primitive, in the mean of the samples that it covers.
    Centroid,
}

impl ShadingRate {
    /// All, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Sample, Self::Centre, Self::Centroid];

    /// The name in the window, on the command line and in records.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sample => "sample",
            Self::Centre => "centre",
            Self::Centroid => "centroid",
        }
    }

    /// Whether a primitive is shaded once for all samples of a pixel.
    pub fn is_once(self) -> bool {
        self != Self::Sample
    }
}
