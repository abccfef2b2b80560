//! Rasterscope: see how a picture is sampled.
//!
//! A software rasterizer for SVG scenes that can say of every pixel why it has its colour: which samples it has, which
//! shapes cover them, which texels they read, and which settings would bring it nearer to the truth. The program
//! `rasterscope` shows it in a window and on the command line; as a library it draws a file and explains a pixel like this:
//!
//! ```
//! use rasterscope::{SampleRate, Scene, Settings, draw, explain};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let scene = Scene::load("svg/basic/test4.svg")?;
//! let mut settings = Settings::default();
//! settings.render.sample_rate = SampleRate::new(16).ok_or("no such rate")?;
//! let picture = draw(&scene, &settings)?;
//! let explanation = explain(&scene, &settings, [525, 178])?;
//! assert_eq!(picture.rgba(525, 178), Some(explanation.color));
//! println!("{explanation}");
//! # Ok(())
//! # }
//! ```
//!
//! `examples/explain.rs` is this as a program, which saves the picture too.
//!
//! # What is promised
//!
//! The names at the root of the crate are its front door: [`Scene`], [`Settings`], [`draw`], [`explain`], [`save_png`], and
//! the types that they take and return. A version that changes their meaning says so in `CHANGELOG.md`. The modules are the
//! rooms of the house. They are public for the program, its tests and its benchmarks, they may change with every commit,
//! and promise nothing to others.
//!
//! # The house
//!
//! One room per concern; doors open downwards only (`tests/suite/house/architecture.rs` holds the table).
//!
//! | room | turns | into |
//! |---|---|---|
//! | `api` | a file and settings | a picture, and why a pixel has its colour: the front door |
//! | `cli` (feature `cli`) | arguments | a command and its exit status |
//! | `app` (feature `window`) | window events | [`viewer::Command`]s, and a frame into a presented surface |
//! | [`viewer`] | commands | state, a finished frame, saved files |
//! | [`figure`] | frames | insets and figures |
//! | [`compare`] | two frames | differences, error metrics, a guess at their cause; one by itself: an edge's profile, its spectrum |
//! | [`inspect`] | one pixel | why it has its colour: samples, fragments, edges, texels, and what would help |
//! | [`render`] | scene + view + settings | a [`raster::Framebuffer`] |
//! | [`post`] | finished pixels | pixels with smoother edges |
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
//! * **User space**: y down, canvas units, `f64`: those of the document's `width` and `height`. What SVG calls user space, inside of
//!   a `viewBox` or a transform, ends where a document is read.
//! * **Screen space**: pixels, y down; pixel `(x, y)` covers `[x, x+1) x [y, y+1)`, its centre is at `+0.5`.
//! * **Texture space**: `(u, v)` in `[0, 1]`, `(0, 0)` is the corner of the first row's first texel.
//! * A *sample* is a point where coverage is tested; a *pixel* is the weighted mean of its samples; a *texel*
//!   is a texture's pixel. A *fragment* is a sample that a primitive covers, with its interpolated attributes.
//! * Colours are sRGB-encoded values unless a name says `linear`, and straight unless a name says `premultiplied`.
//! * Frames are in device pixels, always.

mod api;
#[cfg(feature = "window")]
pub mod app;
#[cfg(feature = "cli")]
pub mod cli;
pub mod color;
pub mod compare;
pub mod figure;
pub mod geometry;
pub mod inspect;
pub mod memory;
pub mod plain;
pub mod post;
pub mod raster;
pub mod render;
pub mod rules;
pub mod scene;
pub mod simd;
pub mod texture;
pub mod viewer;

pub use api::{PictureError, Settings, draw, explain};
#[doc(inline)]
pub use figure::save_png;
#[doc(inline)]
pub use inspect::Explanation;
#[doc(inline)]
pub use raster::Framebuffer;
#[doc(inline)]
pub use scene::{Scene, SceneError};

// Whose vectors and affine maps views and geometry take; another version of it has other types.
#[doc(no_inline)]
pub use glam;

// What settings are made of.
#[doc(no_inline)]
pub use {
    color::{ResolveSpace, Rgba},
    geometry::View,
    raster::{FilterRadius, ResolveFilter, SamplePattern, SampleRate},
    render::{RenderSettings, Visualisation},
    rules::Rules,
    texture::{Anisotropy, LevelOfDetail, LevelSampling, PixelSampling},
};
