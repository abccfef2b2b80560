//! Pictures made of frames: insets for now. Knows no window and no text; whoever shows a picture adds its words.

mod inset;
mod paint;
mod placement;
mod png;
mod rect;
mod samples;

pub use inset::Inset;
pub use placement::{Corner, place};
pub use png::{encode_png, save_png};
pub use rect::PixelRect;
pub use samples::{SampleMark, is_dark};
