//! Two frames that can be compared.

use crate::raster::Framebuffer;

/// Two frames of equal size: A, the reference, and B.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'f> {
    pub(super) a: &'f Framebuffer,
    pub(super) b: &'f Framebuffer,
}

/// Two frames cannot be compared, because their sizes differ. Width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{} x {} pixels against {} x {}", .a[0], .a[1], .b[0], .b[1])]
pub struct SizeMismatch {
    /// Size of A.
    pub a: [u32; 2],
    /// Size of B.
    pub b: [u32; 2],
}

impl<'f> Pair<'f> {
    /// A, the reference, against B.
    ///
    /// # Errors
    /// When their sizes differ.
    pub fn new(a: &'f Framebuffer, b: &'f Framebuffer) -> Result<Self, SizeMismatch> {
        let sizes = SizeMismatch {
            a: [a.width(), a.height()],
            b: [b.width(), b.height()],
        };
        if sizes.a == sizes.b {
            Ok(Self { a, b })
        } else {
            Err(sizes)
        }
    }

    /// Width and height in pixels.
    pub fn size(self) -> [u32; 2] {
        [self.a.width(), self.a.height()]
    }

    /// B itself.
    pub fn b(self) -> &'f Framebuffer {
        self.b
    }

    /// B against A.
    #[must_use]
    pub fn swapped(self) -> Self {
        Self { a: self.b, b: self.a }
    }
}
