//! Pictures made of frames: insets and words on them, PNG files. Knows no window.

mod inset;
mod paint;
mod placement;
mod png;
mod rect;
mod samples;
mod text;

pub use inset::Inset;
pub use placement::{Corner, place};
pub use png::{encode_png, save_png};
pub use rect::PixelRect;
pub use samples::{SampleMark, is_dark};
pub use text::{Anchor, TextBlock, TextStyle, Typeface};
