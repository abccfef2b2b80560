//! What commands and results do to the whole viewer: every file is one concern that spans several parts.
//!
//! Parts know nothing of each other beyond the floors below them; here they meet.

pub(in crate::viewer) mod ab_words;
pub(in crate::viewer) mod apply;
pub(in crate::viewer) mod asked_pixel;
pub(in crate::viewer) mod compare;
pub(in crate::viewer) mod contributions;
pub(in crate::viewer) mod copy;
pub(in crate::viewer) mod dialects;
pub(in crate::viewer) mod explanation;
pub(in crate::viewer) mod frames;
pub(in crate::viewer) mod legends;
pub(in crate::viewer) mod lesson;
pub(in crate::viewer) mod magnifiers;
pub(in crate::viewer) mod measuring;
pub(in crate::viewer) mod open;
pub(in crate::viewer) mod outside;
pub(in crate::viewer) mod pair;
pub(in crate::viewer) mod panes;
pub(in crate::viewer) mod pins;
pub(in crate::viewer) mod pointer;
pub(in crate::viewer) mod restore;
pub(in crate::viewer) mod samples;
pub(in crate::viewer) mod save;
pub(in crate::viewer) mod scenes;
pub(in crate::viewer) mod sheet;
pub(in crate::viewer) mod showing;
pub(in crate::viewer) mod status;
pub(in crate::viewer) mod update;
pub(in crate::viewer) mod view;
pub(in crate::viewer) mod window;
pub(in crate::viewer) mod wipe;
