//! Where in texture space a position of the screen lies: the affine map of one triangle.

use glam::DVec2;

use super::Footprint;

/// The affine map from screen positions in pixels to `(u, v)`.
///
/// Positions are taken relative to a pivot, best a corner of the triangle: then moving triangle and sample by whole
/// pixels gives the same `(u, v)` to the last bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvMap {
    /// A screen position, in pixels.
    pub pivot: DVec2,
    /// `(u, v)` there.
    pub uv: DVec2,
    /// Change of `(u, v)` from one pixel to the next on its right.
    pub dx: DVec2,
    /// Change of `(u, v)` from one pixel to the one below.
    pub dy: DVec2,
}

impl UvMap {
    /// The change of `(u, v)` per pixel.
    pub fn footprint(&self) -> Footprint {
        Footprint {
            dx: self.dx,
            dy: self.dy,
        }
    }
}
