//! The suite that needs no display. One folder per room, one file per topic, test names topic
//! first.
//!
//! Where a test goes: a pure function with exact numbers is tested beside its code in `src`; what several rooms do
//! together, properties, pictures and goldens go here; what needs a window goes to `tests/window`.

#![expect(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]

#[cfg(feature = "window")]
mod app;
mod cli;
mod house;
mod inspect;
mod raster;
mod scene;
mod support;
mod viewer;
