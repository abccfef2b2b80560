//! Scripted sessions: text to steps, and steps to what a user would do, with or without a display.
//!
//! ```text
//! # one step per line, or several with `;` between them
//! key =; key Ctrl+Shift+P; type "rate"     press keys by the names that help shows; type text
//! move 200,100; click 200,100              window pixels; also right-click X,Y and leave
//! drag 100,100 180,140; wheel 3 200,100    wheel: clicks, above zero zooms in, where the pointer is or at X,Y
//! resize 1280x800; wait 200; wait          wait: milliseconds, or until the picture is finished
//! shot "my picture.png"                    saves the whole window, replacing the file
//! pin 512,300; rate 16; theme light        any command of the table, with its argument
//! ```
//!
//! A step starts when the picture of the step before is finished. Text with a `;`, a line break or blanks at its ends
//! stands in double quotes. A `#` at the start of a step makes the rest of the line a comment.

mod parse;
mod play;

pub use parse::{Script, ScriptError, ScriptStep, Step};
pub use play::{Stage, ViewerStage, perform, play, save_window};
