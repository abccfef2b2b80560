//! The window: events to commands, the viewer's frame and egui's overlay to a presented surface.
//!
//! Decides nothing about the picture: whatever a user can do is a command of the viewer, so this room only translates.

pub mod overlay;
