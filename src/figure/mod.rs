//! Pictures made of frames: insets, legends, words, sheets, and the PNG files they are kept in. Knows no window.

#[cfg(feature = "cli")]
mod axis;
#[cfg(feature = "cli")]
mod beside;
mod callout;
mod inset;
mod leaders;
mod legend;
mod lines;
mod magnifiers;
mod magnify;
mod output;
mod paint;
mod pin_ring;
mod placement;
#[cfg(feature = "cli")]
mod plot;
mod png;
mod record;
mod rect;
mod samples;
mod sheet;
mod shrink;
mod snippets;
#[cfg(feature = "cli")]
mod spectrum;
mod table;
mod tag;
mod text;
#[cfg(feature = "cli")]
mod ticks;
mod vacancy;

pub use self::png::{encode_png, save_picture, save_png};
pub use callout::{InsetError, InsetPlace, InsetSpec, add_furniture};
pub use inset::Inset;
pub use legend::{add_legends, draw_legend, place_legends};
pub use magnifiers::{Magnifier, add_magnifiers};
pub use magnify::magnified;
pub use output::{Destination, Guard, Named, NewFile, TableOf, Unwritable, open_log, save_files, write_new, writing};
pub use pin_ring::PinRing;
pub use placement::{Corner, corners, place};
#[cfg(feature = "cli")]
pub use plot::{Plot, PlotSeries, draw_plot};
pub use record::{Record, RecordError, RecordedB, RecordedFile};
pub use rect::PixelRect;
pub use samples::{SampleMark, is_dark};
pub use sheet::{Ground, PAGE_WIDTH, SheetLayout, SheetPlan, draw_legends};
pub use shrink::shrunk;
pub use snippets::{Figure, html, in_markdown, latex, markdown};
#[cfg(feature = "cli")]
pub use spectrum::draw_spectrum;
pub use table::{Table, TableFormat};
pub use tag::{Tag, add_tags, tag_unit};
pub use text::{Anchor, TextBlock, TextStyle, Typeface};
