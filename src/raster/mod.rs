//! Primitives to pixels: exact edges, sample patterns, tiles, shading, resolve.

mod framebuffer;
mod sample_rate;

pub use framebuffer::Framebuffer;
pub use sample_rate::SampleRate;
