//! Scripted sessions: text to steps, and steps to what a user would do, with or without a display.
//!
//! The language stands on the page that `rasterscope help scripts` prints.

mod parse;
mod play;

pub use parse::{Script, ScriptError, ScriptStep, Step};
pub use play::{Stage, ViewerStage, perform, play, save_window};
