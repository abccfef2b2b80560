//! The overlay, without a window.

mod goldens;
mod painter;
mod repaints;
