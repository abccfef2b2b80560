//! Lessons: steps that a teacher wrote, each a scene with its settings and a text beside it.
//!
//! A lesson is a TOML file. Whoever walks through it only gives commands; every step sets all that it needs, so that steps
//! can be taken in any order.

pub(in crate::viewer) mod markdown;
pub(in crate::viewer) mod model;
pub(in crate::viewer) mod parse;
pub(in crate::viewer) mod source;
pub(in crate::viewer) mod walk;
