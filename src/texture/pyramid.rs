//! The pyramid: an image at every resolution down to one texel.

/// One resolution of an image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MipLevel {
    width: u32,
    height: u32,
    texels: Vec<[u8; 4]>,
}

/// All resolutions of an image; level 0 is the image itself, the last level is a single texel.
#[derive(Clone, Debug)]
pub struct MipPyramid {
    levels: Vec<MipLevel>,
}

impl MipLevel {
    /// A level of `width` x `height` premultiplied RGBA texels in rows from the top.
    pub fn new(width: u32, height: u32, texels: Vec<[u8; 4]>) -> Self {
        assert!(width > 0 && height > 0, "a level has at least one texel");
        assert_eq!(texels.len(), width as usize * height as usize, "one colour per texel");
        Self { width, height, texels }
    }

    /// Texels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows of texels.
    pub fn height(&self) -> u32 {
        self.height
    }
}

impl MipPyramid {
    /// Builds every level from the base.
    pub fn build(base: MipLevel) -> Self {
        Self { levels: vec![base] }
    }

    /// The levels, finest first; never empty.
    pub fn levels(&self) -> &[MipLevel] {
        &self.levels
    }
}
