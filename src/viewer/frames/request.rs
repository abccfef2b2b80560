//! What is asked of drawing: a picture, and where to begin.

use std::time::Instant;

use crate::raster::Region;
use crate::viewer::frames::frame::Picture;

/// What is wanted.
#[derive(Clone, Debug)]
pub(in crate::viewer) struct FrameRequest {
    pub(in crate::viewer) picture: Picture,
    /// Final tiles come nearest to this pixel first.
    pub(in crate::viewer) from: [u32; 2],
    /// What must be final in a preview, too: what the inspector reads.
    pub(in crate::viewer) focus: Option<Region>,
    pub(in crate::viewer) number: u64,
    pub(in crate::viewer) since: Instant,
}

impl FrameRequest {
    pub(in crate::viewer) fn new(picture: Picture, from: [u32; 2], focus: Option<Region>) -> Self {
        Self {
            picture,
            from,
            focus,
            number: 0,
            since: Instant::now(),
        }
    }
}
