//! Where the window looks: cameras, panes and the pointer. Nothing here knows of frames.

pub(in crate::viewer) mod camera;
pub(in crate::viewer) mod layout;
pub(in crate::viewer) mod panes;
pub(in crate::viewer) mod pointer;
