//! The program without a window: commands, sessions, screenshots, sheets.

mod boards;
mod comparison;
mod dialects;
mod follow;
mod idle;
mod inspector;
mod profiles;
mod random;
mod replay;
mod screenshots;
mod scripts;
mod sheets;
mod spectra;
mod visualisation;
