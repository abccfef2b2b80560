//! The frame that dialogs share.

use egui::{Color32, Id, Modal, Response};

/// What darkens the picture below a dialog.
pub(super) const BACKDROP: Color32 = Color32::from_black_alpha(90);

/// A dialog in the middle of the window, over what is darkened; without fading, which takes frames.
pub(super) fn modal(name: &'static str) -> Modal {
    let id = Id::unique(name);
    Modal::new(id)
        .area(Modal::default_area(id).fade_in(false))
        .backdrop_color(BACKDROP)
}

/// Whether a click beside a dialog closes it: the second half of a double click on what opened it does not.
pub(super) fn beside(backdrop: &Response) -> bool {
    backdrop.clicked() && !backdrop.double_clicked() && !backdrop.triple_clicked()
}
