//! What leaves the program: pictures with their records, names of files, sheets.

pub(in crate::viewer) mod naming;
pub(in crate::viewer) mod restored;
pub(in crate::viewer) mod saver;
pub(in crate::viewer) mod sheet;
pub(in crate::viewer) mod spec;
pub(in crate::viewer) mod state;
