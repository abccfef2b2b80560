//! What is drawn: made by code from fixed seeds, the same on every machine.

pub(crate) mod chance;
pub(crate) mod documents;
pub(crate) mod flat;
pub(crate) mod mesh;
pub(crate) mod strokes;

/// The frames of every table.
pub(crate) const FRAMES: [[u32; 2]; 2] = [[1024, 1024], [1920, 1080]];
