//! Sessions as hands and eyes meet them, without a window system: one file for each part of the panels or kind of window.
//! `hands` has what all of them do.

mod boards;
mod by_mouse;
mod choosing;
mod comparing;
mod explaining;
mod first_minute;
mod hands;
mod keyboard;
mod lessons;
mod low_windows;
mod magnifiers;
mod menus;
mod overlaps;
mod panel_edges;
mod partial_updates;
mod profiles;
mod scene_list;
mod small_windows;
mod spectra;

use super::*;
