//! End to end: the real program in a real window, real keys, real pixels.
//!
//! Every test has an X server of its own (Xvfb), so that tests neither see each other nor the desktop. Pixels are read
//! from the server, keys and pointer go through XTEST, and what is to be seen is compared with what the library makes
//! of the same commands. A machine without Xvfb fails these tests: they are never skipped.

#![expect(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]

mod clipboard;
mod compare;
mod desktop;
mod drop;
mod follow;
mod keyboard;
mod life;
mod pacing;
mod pointer;
mod program;
mod rest;
mod session_bus;
mod sheets;
mod wayland;
