//! The options of the commands, each in a file of its name; several share [`sampling`], [`framing`] and [`lists`].
//!
//! They stand below the commands: a record, and with it `rerun`, reads the options of others.

pub(in crate::cli) mod bench;
pub(in crate::cli) mod board;
pub(in crate::cli) mod diff;
pub(in crate::cli) mod framing;
pub(in crate::cli) mod inspect;
pub(in crate::cli) mod lesson;
pub(in crate::cli) mod lists;
pub(in crate::cli) mod pattern;
pub(in crate::cli) mod profile;
pub(in crate::cli) mod render;
pub(in crate::cli) mod rerun;
pub(in crate::cli) mod sampling;
pub(in crate::cli) mod sheet;
pub(in crate::cli) mod spectrum;
pub(in crate::cli) mod sweep;
mod values;
pub(in crate::cli) mod view;
mod whole;
pub(in crate::cli) mod writeup;
