//! A's frame: what draws it, and what of it the window shows.

use crate::viewer::frames::drawing::Drawing;
use crate::viewer::frames::legends::Legends;

/// What draws A's frame, and what lies over it.
#[derive(Debug)]
pub(in crate::viewer) struct Frames {
    pub(in crate::viewer) drawing: Drawing,
    /// Draws quick frames for whoever shows them on a surface that it lends.
    pub(in crate::viewer) surface_pool: Option<rayon::ThreadPool>,
    pub(in crate::viewer) legends: Legends,
}

impl Frames {
    pub(in crate::viewer) fn new(drawing: Drawing) -> Self {
        Self {
            drawing,
            surface_pool: None,
            legends: Legends::default(),
        }
    }
}
