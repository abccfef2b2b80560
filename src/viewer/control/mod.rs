//! What commands and results do to several parts: every file is one concern.
//!
//! Parts know nothing of each other beyond the floors below them; here they meet. Who reads or changes several of them is a
//! small struct that borrows just those, such as [`both::Both`] or [`hand::Hand`]; `contexts` hands them out.

pub(in crate::viewer) mod apply;
pub(in crate::viewer) mod arranging;
pub(in crate::viewer) mod boarded;
pub(in crate::viewer) mod both;
pub(in crate::viewer) mod bringing_back;
pub(in crate::viewer) mod comparing;
pub(in crate::viewer) mod contexts;
pub(in crate::viewer) mod copy;
pub(in crate::viewer) mod drawings;
pub(in crate::viewer) mod edges;
pub(in crate::viewer) mod figure_of_both;
pub(in crate::viewer) mod hand;
pub(in crate::viewer) mod lesson;
pub(in crate::viewer) mod numbers;
pub(in crate::viewer) mod open;
pub(in crate::viewer) mod outlines;
pub(in crate::viewer) mod pins;
pub(in crate::viewer) mod pointing;
pub(in crate::viewer) mod profiled;
pub(in crate::viewer) mod recipes;
pub(in crate::viewer) mod reread;
pub(in crate::viewer) mod save;
pub(in crate::viewer) mod sheet;
pub(in crate::viewer) mod spectral;
pub(in crate::viewer) mod surface;
pub(in crate::viewer) mod update;
pub(in crate::viewer) mod viewing;
pub(in crate::viewer) mod window;
