//! Commands under "Sampling".

use crate::viewer::chrome::Dialog;
use crate::viewer::command::Command;
use crate::viewer::command::arguments;
use crate::viewer::command::parts::{ViewCommand, WindowCommand};
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
.argument(arguments::PROGRESSIVE),
spec(
    "pattern-view",
    "Sample pattern by itself",
    "Shows the points of the sample pattern, what vertical and level edges see of them, how even they are, and their spectrum",
    Group::Sampling,
)
.sought_as(&["points", "discrepancy"])
.more("Of the pinned pixel, where each has points of its own; the keys of pattern and sample rate work meanwhile")
.run(&Command::Window(WindowCommand::ToggleDialog(Dialog::Pattern))),
spec(
    "default-settings",
    "Default settings",
    "Brings every setting of sampling and textures back to what it is in the first session",
    Group::Sampling,
)
.more("Settings are remembered from one window to the next. The message about it brings back what they were before")
.run(&Command::SetDefaults)];
