//! Sheets: one picture for each combination of settings, in a labelled grid; by the command line, and put together in the
//! window with a preview of what that command line makes.

pub(in crate::viewer) mod axes;
pub(in crate::viewer) mod captions;
pub(in crate::viewer) mod desk;
pub(in crate::viewer) mod draft;
pub(in crate::viewer) mod drawing;
pub(in crate::viewer) mod files;
pub(in crate::viewer) mod preview;
pub(in crate::viewer) mod saving;
