//! The lines of the command table, but for those of the picture settings: a file for each heading of help and menus.

mod compare;
mod inspector;
mod sampling;
mod save;
mod scenes;
mod view;
mod window;

use crate::viewer::command::spec::{CommandSpec, Group};

/// The lines under a heading, in the order of help and menus.
pub(super) fn of(group: Group) -> &'static [CommandSpec] {
    match group {
        Group::View => view::VIEW,
        Group::Sampling => sampling::SAMPLING,
        // Settings only.
        Group::Textures => &[],
        Group::Compare => compare::COMPARE,
        Group::Scenes => scenes::SCENES,
        Group::Inspector => inspector::INSPECTOR,
        Group::Save => save::SAVE,
        Group::Window => window::WINDOW,
    }
}
