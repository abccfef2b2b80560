//! Commands under "Sampling".

use crate::viewer::command::Command;
use crate::viewer::command::arguments;
use crate::viewer::command::parts::ViewCommand;
use crate::viewer::command::spec::CommandSpec;
use crate::viewer::command::spec::Group;
use crate::viewer::command::spec::spec;
use crate::viewer::settings::Toggle;

/// The lines under this heading, in the order of help and menus.
pub(super) static SAMPLING: &[CommandSpec] = &[spec(
    "progressive",
    "Progressive drawing",
    "Draws coarsely while the view moves and refines the picture when it rests",
    Group::Sampling,
)
.run(&Command::View(ViewCommand::Progressive(Toggle::Flip)))
.argument(arguments::PROGRESSIVE)];
