//! The sheet that is being put together.

use crate::viewer::export::sheet::draft::SheetDraft;
use crate::viewer::export::sheet::preview::{Previews, SheetPreview};

/// The sheet that is being put together, and what is known of it.
#[derive(Debug)]
pub struct SheetDesk {
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

    /// What the next sheet will be.
    pub fn draft(&self) -> &SheetDraft {
        &self.draft
    }

    /// Whether this room for the preview is another one than before.
    pub fn room_changes(&self, room: [u32; 2]) -> bool {
        self.room != room
    }

    /// The preview of the sheet, or why there is none, in one line; that of an earlier state while the new one is drawn, which
    /// `true` tells.
    pub fn preview(&self) -> Option<(&Result<SheetPreview, String>, bool)> {
        Some((self.previews.newest()?, !self.previews.is_current()))
    }

    /// Grows with every other preview.
    pub fn preview_number(&self) -> u64 {
        self.previews.number()
    }

    /// A sheet is to be saved, once its scene was read.
    pub(in crate::viewer) fn ask(&mut self) {
        self.waiting = self.waiting.saturating_add(1);
    }
}
