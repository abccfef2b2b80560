//! The suite that needs no display. One file per topic, test names topic first.
//!
//! Where a test goes: a pure function with exact numbers is tested beside its code in `src`; what several rooms do
//! together, properties, pictures and goldens go here; what needs a window goes to `tests/window`.

#![expect(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]

mod api;
mod architecture;
mod cli;
mod contributing;
mod coverage;
mod diff;
mod disk;
mod figures;
mod float_rules;
mod floors;
mod full_disk;
mod fuzzing;
mod gallery;
mod golden;
mod guess;
mod hostile_names;
mod inspect;
mod inspect_advice;
mod inspect_feeds;
mod inspect_seams;
mod instruction_guard;
mod interrupts;
mod lessons;
mod limits;
mod oracle;
mod outputs;
#[cfg(feature = "window")]
mod overlay_goldens;
#[cfg(feature = "window")]
mod overlay_painter;
#[cfg(feature = "window")]
mod overlay_repaints;
mod patterns;
mod readme;
mod records;
mod regions;
mod render;
mod robustness;
mod scene_course;
mod scene_svg;
mod scene_triangulation;
mod support;
mod sweep;
mod viewer_comparison;
mod viewer_dialects;
mod viewer_inspector;
mod viewer_random;
mod viewer_replay;
mod viewer_screenshots;
mod viewer_scripts;
mod viewer_sheets;
mod viewer_visualisation;
mod visualisation;
mod writeup;
