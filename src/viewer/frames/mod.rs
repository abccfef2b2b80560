//! Frames: what is asked for, how it is drawn in time, and how it comes to the window's pixels.

pub(in crate::viewer) mod budget;
pub(in crate::viewer) mod composite;
pub(in crate::viewer) mod drawing;
pub(in crate::viewer) mod frame;
pub(in crate::viewer) mod job;
pub(in crate::viewer) mod legends;
pub(in crate::viewer) mod present;
pub(in crate::viewer) mod preview;
pub(in crate::viewer) mod progress;
pub(in crate::viewer) mod refining;
pub(in crate::viewer) mod request;
pub(in crate::viewer) mod state;
pub(in crate::viewer) mod surface;
