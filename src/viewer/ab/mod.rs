//! A against B: what the picture that keys change (A) is compared with (B), and how both share the window.
//!
//! A and B show the same scene from the same place. A comparison that was closed costs nothing: B has no frame then, and
//! its thread sleeps.

pub(in crate::viewer) mod comparison;
pub(in crate::viewer) mod measuring;
pub(in crate::viewer) mod other;
pub(in crate::viewer) mod outside;
mod reading;
pub(in crate::viewer) mod requests;
pub(in crate::viewer) mod sides;
mod wipe;
