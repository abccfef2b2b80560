//! Pictures made of frames: insets for now. Knows no window and no text; whoever shows a picture adds its words.

mod inset;
mod placement;
mod png;
mod rect;

pub use inset::{Inset, SampleMark, is_dark};
pub use placement::{Corner, place};
pub use png::{encode_png, save_png};
pub use rect::PixelRect;
