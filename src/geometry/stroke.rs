//! How lines with a width look; what they cover is found in [`super::path`].

/// How an open line ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LineCap {
    /// At its end point.
    #[default]
    Butt,
    /// In a half circle around its end point.
    Round,
    /// Half a width past its end point.
    Square,
}

/// What fills the outer side of a corner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LineJoin {
    /// The edges prolonged until they meet, up to the miter limit; else as [`LineJoin::Bevel`].
    #[default]
    Miter,
    /// A circle around the corner.
    Round,
    /// A straight cut.
    Bevel,
}

/// What turns a line into an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrokeStyle {
    /// In the units of the line's points, finite and above zero.
    pub width: f64,
    /// Of both ends.
    pub cap: LineCap,
    /// Of all corners.
    pub join: LineJoin,
    /// How many widths long a miter may be, at least 1.
    pub miter_limit: f64,
}
