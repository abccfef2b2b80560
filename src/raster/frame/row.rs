//! A frame's pixels, cut into rows of tiles that threads paint at the same time.

/// A row of tiles.
#[derive(Debug)]
pub(in crate::raster) struct FrameRow<'f> {
    /// Counted from the top.
    pub(in crate::raster) number: u32,
    /// The frame's rows of pixels.
    pub(in crate::raster) pixels: &'f mut [u32],
    /// What gets the same pixels.
    kept: Option<&'f mut [u32]>,
}

impl<'f> FrameRow<'f> {
    /// All rows of tiles of a frame, `length` pixels each but for the last; `kept` has as many pixels.
    pub(in crate::raster) fn all(
        pixels: &'f mut [u32],
        kept: Option<&'f mut [u32]>,
        length: usize,
    ) -> impl Iterator<Item = Self> {
        let kept = kept.into_iter().flat_map(move |kept| kept.chunks_mut(length));
        let kept = kept.map(Some).chain(std::iter::repeat_with(|| None));
        let rows = (0..).zip(pixels.chunks_mut(length)).zip(kept);
        rows.map(|((number, pixels), kept)| Self { number, pixels, kept })
    }

    /// To be called when all of it is painted. One long copy: the processor need not read what it overwrites.
    pub(in crate::raster) fn keep(&mut self) {
        if let Some(kept) = &mut self.kept {
            kept.copy_from_slice(self.pixels);
        }
    }
}
