//! Pictures made of frames: insets and words on them, PNG files. Knows no window.

mod inset;
mod legend;
mod paint;
mod placement;
mod png;
mod record;
mod rect;
mod samples;
mod text;

pub use self::png::{encode_png, save_files, save_png, save_recorded_png};
pub use inset::Inset;
pub use legend::{add_legends, draw_legend, place_legends};
use placement::corners;
pub use placement::{Corner, place};
pub use record::{Record, RecordError, RecordedFile};
pub use rect::PixelRect;
pub use samples::{SampleMark, is_dark};
pub use text::{Anchor, TextBlock, TextStyle, Typeface};
