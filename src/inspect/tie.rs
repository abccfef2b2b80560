//! A sample that lies exactly on an edge of a primitive and is not the primitive's: which edge, and whose it is then.

use serde::Serialize;

/// A sample exactly on an edge of a primitive that does not own it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Tie {
    /// Number of the sample.
    pub sample: usize,
    /// Which edge.
    pub side: TieSide,
    /// Whose the sample is.
    pub owner: TieOwner,
}

/// An edge that does not own its line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum TieSide {
    /// With the primitive on its left.
    Right,
    /// With the primitive above it.
    Bottom,
    /// A corner, with which the primitive ends below.
    Corner,
    /// A corner, from which the primitive goes down, between a left and a right edge.
    Peak,
}

/// Whose a sample on an edge is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum TieOwner {
    /// By the top-left rule.
    Neighbour,
    /// By the float rules, which have none for ties.
    Nobody,
}

impl TieSide {
    /// As explanations call it.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Right => "its right edge",
            Self::Bottom => "its bottom edge",
            Self::Corner => "its last corner",
            Self::Peak => "a corner that points up, where a right edge begins",
        }
    }
}
