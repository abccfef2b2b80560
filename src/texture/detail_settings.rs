//! What a user may change about the level of detail: a bias, a fixed level, between which points footprints are measured, and what
//! of a footprint counts.
//!
//! ```text
//!        ____________
//!       /           /     longer: its longer step, so that nothing slips through, and what lies across is blurred
//!      /           /      area: the square root of its area, between both
//!     '-----------'       shorter: the minor axis of its ellipse, so that nothing is blurred, and what lies along is missed
//! ```

/// What a user may change about the level of detail.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LevelOfDetail {
    /// Added to it.
    pub bias: LodBias,
    /// Takes its place, whatever the footprint is.
    pub fixed: Option<FixedLevel>,
    /// Between which points `(u, v)` is compared.
    pub derivatives: Derivatives,
    /// What of the footprint counts.
    pub extent: FootprintExtent,
}

/// A number of levels that is added to the level of detail, `-16.0..=16.0`. Above zero it blurs, below it sharpens.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct LodBias(f64);

/// A level of detail that a user fixes, `0.0..=16.0`; a pyramid that ends before is read at its last level.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct FixedLevel(f64);

/// Between which points `(u, v)` is compared to find the footprint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Derivatives {
    /// From one pixel to the next: as GPUs do. The level does not change with the sample rate.
    #[default]
    Pixel,
    /// From one sample to the next: each sample reads no more than its own part of the pixel.
    Sample,
}

/// What of a footprint the level of detail follows, where no more than one tap is read: with more the taps decide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FootprintExtent {
    /// The longer step, to the right or down: as OpenGL and GPUs do.
    #[default]
    Longer,
    /// The square root of the area of the parallelogram of both steps (Heckbert, "Texture Mapping Polygons in Perspective", 1983).
    Area,
    /// The minor axis of the ellipse that a circle of a pixel becomes (Heckbert, "Fundamentals of Texture Mapping and Image
    /// Warping", 1989, section 3.5.8).
    Shorter,
}

impl LodBias {
    /// The greatest bias; the least is its opposite.
    pub const MAX: f64 = 16.0;

    /// A bias of so many levels, or `None` unless that is -16 to 16.
    pub fn new(levels: f64) -> Option<Self> {
        // Adding turns -0 into 0.
        (levels.abs() <= Self::MAX).then_some(Self(levels + 0.0))
    }

    /// So many levels more, kept within the limits; the same where `by` is no number.
    #[must_use]
    pub fn stepped(self, by: f64) -> Self {
        Self::new((self.0 + by).clamp(-Self::MAX, Self::MAX)).unwrap_or(self)
    }

    /// The next multiple of a step, upwards, or downwards where the step is below zero; kept within the limits.
    #[must_use]
    pub fn next_multiple(self, step: f64) -> Self {
        let size = step.abs();
        let past = if step < 0.0 {
            (self.0 / size).ceil()
        } else {
            (self.0 / size).floor()
        };
        let next = past + step.signum();
        Self::new((next * size).clamp(-Self::MAX, Self::MAX)).unwrap_or(self)
    }

    /// In levels.
    pub fn levels(self) -> f64 {
        self.0
    }
}

impl FixedLevel {
    /// The greatest level that can be asked for.
    pub const MAX: f64 = 16.0;
    /// The greatest level that keys go to.
    pub const LAST_STEP: f64 = 8.0;

    /// The level `level`, or `None` unless that is 0 to 16.
    pub fn new(level: f64) -> Option<Self> {
        (0.0..=Self::MAX).contains(&level).then_some(Self(level + 0.0))
    }

    /// What a key goes to: the whole level after this one, up to [`FixedLevel::LAST_STEP`], then none, then 0.
    pub fn after(current: Option<Self>) -> Option<Self> {
        match current {
            None => Some(Self(0.0)),
            Some(Self(level)) if level >= Self::LAST_STEP => None,
            Some(Self(level)) => Some(Self(level.floor() + 1.0)),
        }
    }

    /// Counted from the base, which is 0.
    pub fn level(self) -> f64 {
        self.0
    }
}

impl FootprintExtent {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Longer, Self::Area, Self::Shorter];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Longer => "longer",
            Self::Area => "area",
            Self::Shorter => "shorter",
        }
    }
}

impl Derivatives {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 2] = [Self::Pixel, Self::Sample];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pixel => "pixel",
            Self::Sample => "sample",
        }
    }

    /// How far apart the points are, in pixels, where samples are `sample_step` apart.
    pub fn step(self, sample_step: f64) -> f64 {
        match self {
            Self::Pixel => 1.0,
            Self::Sample => sample_step,
        }
    }
}
