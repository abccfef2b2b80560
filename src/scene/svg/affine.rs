//! usvg's transforms as ours.

use glam::DAffine2;

/// usvg's transform as ours.
pub(super) fn affine(transform: usvg::Transform) -> DAffine2 {
    let usvg::Transform { sx, kx, ky, sy, tx, ty } = transform;
    DAffine2::from_cols_array(&[sx, ky, kx, sy, tx, ty].map(f64::from))
}
