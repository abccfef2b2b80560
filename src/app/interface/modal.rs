//! The frame that dialogs share.

use egui::{Color32, Id, Modal};

/// What darkens the picture below a dialog.
pub(super) const BACKDROP: Color32 = Color32::from_black_alpha(90);

/// A dialog in the middle of the window, over what is darkened; without fading, which takes frames.
pub(super) fn modal(name: &'static str) -> Modal {
    let id = Id::unique(name);
    Modal::new(id)
        .area(Modal::default_area(id).fade_in(false))
        .backdrop_color(BACKDROP)
}
