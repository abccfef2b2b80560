//! The sheet that is being put together.

use crate::viewer::export::sheet::draft::SheetDraft;

use crate::viewer::export::sheet::preview::Previews;

/// The sheet that is being put together, and what is known of it.
#[derive(Debug)]
pub(in crate::viewer) struct SheetDesk {
    pub(in crate::viewer) draft: SheetDraft,
    /// Device pixels that there are for the preview.
    pub(in crate::viewer) room: [u32; 2],
    pub(in crate::viewer) previews: Previews,
    /// Sheets that were asked for while their scene was being read.
    pub(in crate::viewer) waiting: u32,
}

impl SheetDesk {
    pub(in crate::viewer) fn new(previews: Previews) -> Self {
        Self {
            draft: SheetDraft::default(),
            room: [0, 0],
            previews,
            waiting: 0,
        }
    }

    /// Whether everything that was asked for is there or at work.
    pub(in crate::viewer) fn is_current(&self) -> bool {
        self.waiting == 0 && self.previews.is_current()
    }
}
