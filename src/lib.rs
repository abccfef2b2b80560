//! Rasterscope: see how a picture is sampled.
//!
//! # The house
//!
//! One room per concern; doors open downwards only (`tests/suite/architecture.rs` holds the table).
//!
//! | room | turns | into |
//! |---|---|---|
//! | [`cli`] | arguments | a command and its exit status |
//! | `app` (feature `window`) | window events | [`viewer::Command`]s, and a frame into a presented surface |
//! | [`viewer`] | commands | state, a finished frame, saved files |
//! | [`figure`] | frames | insets and figures |
//! | [`compare`] | two frames | differences, error metrics, a guess at their cause |
//! | [`inspect`] | one pixel | why it has its colour: samples, fragments, edges, texels, and what would help |
//! | [`render`] | scene + view + settings | a [`raster::Framebuffer`] |
//! | [`scene`] | documents | a [`scene::Scene`] with nothing left to interpret |
//! | [`raster`] | screen-space primitives | resolved pixels |
//! | [`texture`] | images | colours at a footprint |
//! | [`geometry`], [`color`], [`rules`] | numbers | numbers |
//! | [`plain`] | text from outside | text that steers no terminal |
//! | [`memory`] | a number of bytes | whether the system has them |
//! | [`simd`] | the machine | the vector instructions that kernels use |
//!
//! # Conventions
//!
//! * **User space**: y down, the document's units, `f64`.
//! * **Screen space**: pixels, y down; pixel `(x, y)` covers `[x, x+1) x [y, y+1)`, its centre is at `+0.5`.
//! * **Texture space**: `(u, v)` in `[0, 1]`, `(0, 0)` is the corner of the first row's first texel.
//! * A *sample* is a point where coverage is tested; a *pixel* is the weighted mean of its samples; a *texel*
//!   is a texture's pixel. A *fragment* is a sample that a primitive covers, with its interpolated attributes.
//! * Colours are sRGB-encoded values unless a name says `linear`, and straight unless a name says `premultiplied`.
//! * Frames are in device pixels, always.

#[cfg(feature = "window")]
pub mod app;
pub mod cli;
pub mod color;
pub mod compare;
pub mod figure;
pub mod geometry;
pub mod inspect;
pub mod memory;
pub mod plain;
pub mod raster;
pub mod render;
pub mod rules;
pub mod scene;
pub mod simd;
pub mod texture;
pub mod viewer;
