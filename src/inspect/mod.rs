//! Why a pixel has its colour: samples, fragments, edges, weights, footprint, texels.
//!
//! Replays for one pixel the very functions that draw frames; it has no arithmetic of its own. [`Explanation`] is the
//! report, in numbers, with what would help where [`Explanation::advised`] made it; [`Explanation::text`] says it in words,
//! [`Explanation::markdown`] for a write-up. [`Contributions`] goes the other way: from a texel to the pixels around that
//! read it.

mod accumulation;
mod advice;
mod advice_words;
mod area_use;
mod areas;
mod around_words;
mod candidates;
mod causes;
mod contributions;
mod depth;
mod differences;
mod explanation;
mod interpolated_words;
mod level_in_use;
mod model;
mod numbers;
mod part_words;
mod pinholes;
mod resolve;
mod resolve_words;
mod samples;
mod seams;
mod seen;
mod servers;
mod siblings;
mod smoothing;
mod text;
mod texture_reasons;
mod tie;
mod ties;
mod triangle_views;
mod words;

pub use accumulation::Convergence;
pub use area_use::{AreaUse, SummedBox};
pub use contributions::{ContributedPixel, Contributions, TexelPlace};
pub use differences::Difference;
pub use explanation::Question;
pub use level_in_use::LevelInUse;
pub use model::{
    Around, Conflation, Cure, Edge, Explanation, Fragment, Interpolated, Level, Missed, NotDrawn, Paint, Pinhole,
    Resolve, Rounding, Sample, Setting, Shape, Source, Taken, Tap, Texel, Texture, Truth, VERSION, Verdict, View,
    Wrapped,
};
pub use numbers::counted;
pub use samples::{PixelSample, SampleHit, pixel_samples};
pub use smoothing::{Blended, EdgePattern, PixelSide, Smoothing};
pub use text::Detail;
pub use tie::{Tie, TieOwner, TieSide};
