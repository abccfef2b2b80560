//! How far two pictures of one size are apart: difference pictures, error metrics, the places that differ most, and
//! which known cause explains the rest. And one picture by itself: a [`Profile`] along a line across an edge, the waves that it
//! is made of by [`SpectrumAnalysis`].
//!
//! A [`Pair`] is the only way in to two pictures; it holds frames of equal size, A the reference and B the other. Its
//! functions run on the current rayon pool, and their answers do not depend on the number of threads. Channels are compared
//! as they are stored: straight sRGB-encoded bytes.

mod cause;
mod flip;
mod flip_lanes;
mod gaussian;
mod hypotheses;
mod levels;
mod line;
mod luma;
mod pair;
mod picture;
mod places;
mod plane;
mod powers;
mod profile;
mod region;
mod show;
mod spectrum;
mod ssim;
mod tiles;
mod trial;
mod truncation;

pub use cause::{Cause, CellCorner};
pub use hypotheses::{Guess, guess};
pub use levels::{Largest, Levels};
pub use line::{Line, LinePoint};
pub use luma::single_luma;
pub use pair::{Pair, SizeMismatch};
pub use picture::{count_different, decode_picture, encoded_size};
pub use places::Place;
pub use profile::{Edge, Profile, ProfileChannel};
pub use show::{DifferencePaint, DifferenceStyle, Gain, Measure};
pub use spectrum::{Band, DECIBELS, SpectrumAnalysis, SpectrumOf, SpectrumReading, Wave, scale_color};
